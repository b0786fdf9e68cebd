"""The model of a cam: whatever its lift and board, its pins stay in the slot, by polygons of the board's file alone."""

from __future__ import annotations

import json
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate, translate

from exporters.command.cli import main
from parts.scene.files import SCENE_FOLDER
from tests.exporters.production.test_boards import bodies_of

# of a board of one set, without a kerf: what lies there is what the keys say
BOARD = '[[exports]]\nformat = "dxf"\npurpose = "board"\n'


def changed(lesson: str, folder: Path, **keys: object) -> Path:
    """A lesson as a teacher changes it, its board alone."""
    text = (SCENE_FOLDER / f"{lesson}.toml").read_text("utf-8").partition("[[exports]]")[0]
    for key, value in {"kerf": 0.0, "sets": 1, **keys}.items():
        text, found = re.subn(rf"(?m)^{key} = \S+", f"{key} = {value}", text)
        assert found == 1, key
    file = folder / "model.toml"
    file.write_text(text + BOARD, encoding="utf-8")
    return file


def holes(body: shapely.Polygon) -> list[tuple[float, complex, shapely.Polygon]]:
    """Diameter or width, middle and outline of each hole."""
    found = []
    for ring in map(shapely.Polygon, body.interiors):
        width = 2 * shapely.maximum_inscribed_circle(ring, tolerance=1e-3).length
        found.append((width, complex(ring.centroid.x, ring.centroid.y), ring))
    return found


def below_the_cam(bodies: list[shapely.Polygon]) -> float:
    """How far the frame reaches below all that the cam sweeps, mm."""
    frame = max(bodies, key=lambda body: body.convex_hull.area)
    axle, *pins = (at for _, at, _ in sorted(holes(frame), key=lambda hole: hole[0], reverse=True))
    near, far = sorted(pins, key=lambda at: abs(at - axle))
    turned = rotate(translate(frame, -axle.real, -axle.imag), -np.angle(far - near), origin=(0, 0), use_radians=True)
    ((cam, bore),) = [(b, at) for b in bodies for width, at, _ in holes(b) if abs(width - 6.2) < 0.01]
    return float(-turned.bounds[0] - shapely.Point(bore.real, bore.imag).hausdorff_distance(cam.exterior))


def least_slack(bodies: list[shapely.Polygon], roller: float, offset: float) -> float:
    """How far the pins stay within the slot's ends over a turn, mm; below 0 they do not.

    The follower stands where the cam's polygon lifts it: on its outermost point, or on its outline grown by the roller.
    """
    frame = max(bodies, key=lambda body: body.convex_hull.area)
    axle = max(holes(frame), key=lambda hole: hole[0])[1]
    pins = sorted(
        np.sqrt(abs(at - axle) ** 2 - offset**2) for width, at, _ in holes(frame) if width == pytest.approx(4, abs=0.01)
    )
    assert len(pins) == 2
    (cam, bore), *others = [(b, at) for b in bodies for width, at, _ in holes(b) if abs(width - 6.2) < 0.01]
    assert not others
    grown = translate(cam, -bore.real, -bore.imag).buffer(roller, quad_segs=32)
    heights = []
    for angle in range(0, 360, 5):
        turned = rotate(grown, angle, origin=(0, 0))
        line = shapely.LineString([(offset, 0), (offset, 500)])
        heights.append((turned.intersection(line) if roller else turned).bounds[3])
    wide = [(b, ring) for b in bodies for width, _, ring in holes(b) if abs(width - 4.2) < 0.01]
    # bores of the spacers on the pins are as wide, and round
    (stem, slot), *others = [(b, ring) for b, ring in wide if ring.length > 20]
    assert not others
    # from the roller's centre, or the face, to the slot's ends
    if roller:
        (pin,) = [at for width, at, _ in holes(stem) if abs(width - 3) < 0.01]
        foot = shapely.Point(pin.real, pin.imag)
    else:
        corners = list(stem.minimum_rotated_rectangle.exterior.coords)
        foot = max(map(shapely.LineString, pairwise(corners)), key=slot.distance)
    start = foot.distance(slot)
    end = start + slot.minimum_rotated_rectangle.length / 2 - 4.2
    return float(min(pins[0] - max(heights) - 2 - start, end - (pins[1] - min(heights) + 2)))


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("lesson", "keys", "roller", "offset"),
    [
        pytest.param("lesson_5", {"lift": 20.0}, 8, 3, marks=pytest.mark.heavy),
        ("lesson_5", {"lift": 40.0, "thickness": 4.0}, 8, 3),
        ("lesson_4", {"lift": 14.0}, 0, 0),
    ],
)
def test_pins_stay_in_the_slot_over_a_turn(
    lesson: str, keys: dict[str, float], roller: float, offset: float, tmp_path: Path
) -> None:
    assert main(["build", str(changed(lesson, tmp_path, **keys)), "--out", str(tmp_path), "-q", "--no-verify"]) == 0
    bodies = bodies_of(tmp_path / "model" / "model.board.1.dxf", sag=5e-3)
    assert len(bodies) == (9 if roller else 3)
    assert 0.9 < least_slack(bodies, roller, offset) < 2.2
    assert 2.9 < below_the_cam(bodies) < 4.1
    # all that lies behind each other follows the board
    thick = keys.get("thickness", 3.0)
    notes = (tmp_path / "model" / "model.notes.txt").read_text("utf-8")
    assert f"2 × Ø4 × {4 * thick:g} " in notes
    assert f"1 × Ø6 × {4 * thick:g} " in notes
    assert (f"1 × Ø3 × {3 * thick - 1:g} " in notes) == bool(roller)
    stands = json.loads((tmp_path / "model" / "report.json").read_text("utf-8"))["instances"]
    assert stands["frame"]["at"][2] == -thick
    assert stands["follower"]["at"][2] == pytest.approx(2 * thick if roller else 0.0)


@pytest.mark.heavy
def test_a_slot_of_another_lift_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """That of lift 30 where the lift is 40: a pin goes through its end; and our polygons see it too."""
    file = changed("lesson_5", tmp_path, lift=40.0)
    slots = "[parts.follower]\nslots = [{ start = [0.0, 36.0], end = [0.0, 78.0], width = 4.2 }]\n"
    file.write_text(slots + file.read_text("utf-8"), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "-q", "--no-verify", "--format", "dxf"]) == 0
    assert least_slack(bodies_of(tmp_path / "model" / "model.board.1.dxf", sag=5e-3), 8, 3) < -5
    capsys.readouterr()
    file.write_text(file.read_text("utf-8") + "[checks]\ninterference = true\n", encoding="utf-8")
    assert main(["check", str(file)]) == 1
    said = capsys.readouterr()
    assert re.search("Follower.*Guide pin|Guide pin.*Follower", said.out + said.err)


def test_an_axle_too_thick_for_a_small_cam_is_refused_by_its_own_key(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What is offered builds: its mark is smaller than that of a large cam."""
    small = {"lift": 12.5, "follower_radius": 5.0}
    assert main(["build", str(changed("lesson_5", tmp_path, **small)), "--out", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "assemblies[1].axle_diameter = 6.0" in said
    most = re.search(r"at most ([\d.]+) mm", said)
    assert most
    file = changed("lesson_5", tmp_path, **small)
    text = file.read_text("utf-8").replace("lift = 12.5", f"lift = 12.5\naxle_diameter = {most[1]}")
    file.write_text(text, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "-q", "--no-verify"]) == 0


def test_a_guide_that_meets_the_cam_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", str(changed("lesson_5", tmp_path, slot_start=9.0)), "--out", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "assemblies[1].slot_start = 9.0" in said
    assert "at least 15" in said


MODELS = {
    "flat": ('kind = "cam_model"\nfollower = "flat"\nbase_circle_radius = 45.0\n', 4),
    "roller": ('kind = "cam_model"\nfollower = "roller"\nfollower_radius = 8.0\nbase_circle_radius = 35.0\n', 8),
    # pins so near each other that no rings go about them
    "bare": (
        'kind = "cam_model"\nfollower = "roller"\nfollower_radius = 8.0\nbase_circle_radius = 35.0\n'
        "guide_pin_spacing = 6.5\n", 6,
    ),
    "pair": ('kind = "gear_pair_model"\nteeth = [16, 29]\n', 3),
}  # fmt: skip
PHASES = """lift = 20.0
phases = [
    { move = "rise", angle_deg = 120.0, law = "sine" },
    { move = "return_", angle_deg = 120.0, law = "sine" },
    { move = "dwell", angle_deg = 120.0 },
]
"""


@pytest.mark.sampled(1)
@pytest.mark.parametrize("model", MODELS)
def test_a_model_goes_together_in_the_order_told(
    model: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every part comes straight to its place; what turns is not told to be held fast."""
    keys, steps = MODELS[model]
    file = tmp_path / "s.toml"
    text = f'[[assemblies]]\n{keys}{"" if model == "pair" else PHASES}[[exports]]\nformat = "stl"\n'
    file.write_text(text, encoding="utf-8")
    assert main(["check", str(file)]) == 0
    assert f"order of assembly, {steps} steps: each part reaches its place straight" in capsys.readouterr().out
    assert main(["build", str(file), "--out", str(tmp_path), "--no-verify"]) == 0
    told = (tmp_path / "s" / "s.notes.txt").read_text(encoding="utf-8")
    assert len(re.findall(r"(?m)^\d+\. ", told)) == steps
    held = re.findall(r"(?m)^\d+\. (.*) to .*held fast$", told)
    assert not re.search("Roller|Cam$|Pinion|Wheel|Follower", ", ".join(held))
    assert ("Axle of the cam" in held) == (model != "pair")
