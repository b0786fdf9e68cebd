"""Tips of a pinion and its ring that would reach a fillet or a root are shortened, unless given: by turned polygons."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import affinity

from exporters.command.cli import main
from geometry.approximation.chords import approximate_profile
from geometry.plane.distance import Verdict
from parts.base.part import Part
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from tests.exporters.making import write_scene

# teeth, shifts, pressure and helix angle; with the tips that they have alone twelve per cent of random pairs overlap
PAIRS = [
    (14, 44, -0.3, -0.3, 14.5, 0.0),
    (39, 59, -0.3, -0.3, 14.5, 0.0),
    (26, 36, -0.3, -0.3, 17.5, 0.0),
    (40, 55, 0.5, 0.8, 20.0, 15.0),
    (24, 39, -0.3, -0.3, 20.0, 0.0),
    # a much shifted pinion's root
    (14, 40, 0.88, 0.96, 14.5, 0.0),
    (13, 29, 0.73, 0.92, 14.5, 0.0),
    # corners that run into the fillet above where it begins
    (10, 36, 0.4151, 0.917897, 20.0, 0.0),
    (18, 42, 0.71, 1.25, 14.5, 0.0),
    (31, 73, 0.72, 0.88, 14.5, 0.0),
]
TURNS = 16


def scene_of(pair: tuple[int, int, float, float, float, float], **tips: float) -> dict[str, Any]:
    one, two, first, second, angle, helix = pair
    common = {"module": 1.0, "pressure_angle_deg": angle, "face_width": 10.0, "helix_angle_deg": helix}
    gears = {
        "pinion": {"kind": "spur_gear", "number_of_teeth": one, "profile_shift_coefficient": first},
        "ring": {"kind": "ring_gear", "number_of_teeth": two, "profile_shift_coefficient": second},
    }
    parts = {name: common | keys for name, keys in gears.items()}
    for name, tip in tips.items():
        parts[name]["tip_diameter"] = tip
    return {
        "parts": parts,
        "instances": {name: {"part": name} for name in parts},
        "mates": [{"kind": "internal_gear_pair", "first": "ring", "second": "pinion"}],
    }


def deepest(raw: dict[str, Any]) -> tuple[float, dict[str, Part]]:
    """How far a corner of the pinion goes into the ring over a pitch, mm, and both parts."""
    worst, parts = 0.0, dict[str, Part]()
    for turn in range(TURNS):
        raw["instances"]["ring"]["rotation_deg"] = 360 / raw["parts"]["ring"]["number_of_teeth"] * turn / TURNS
        made = scene_from_dict(raw, "t", "t")
        parts, matings = make_parts(made, "t")
        stand = {i.id: i for i in place(made.instances, made.drives, parts, matings, "t").instances}
        shapes = {}
        for name, part in parts.items():
            outline = part.section(0.0).region
            toothed = outline.holes[0] if name == "ring" else outline.outer
            points, _ = approximate_profile(toothed, 1e-4, arcs=False).geometry.expanded()
            shape = shapely.Polygon(np.stack([points.real, points.imag], axis=1))
            turned = affinity.rotate(shape, stand[name].rotation, origin=(0, 0), use_radians=True)
            shapes[name] = affinity.translate(turned, *stand[name].at[:2])
        pinion, space = shapes["pinion"], shapes["ring"]
        shapely.prepare([pinion, space])
        corners = shapely.points(np.array(pinion.exterior.coords))
        stray = corners[~shapely.covers(space, corners)]
        worst = max([worst, *shapely.distance(stray, space)])
        # of the ring's own corners too
        corners = shapely.points(np.array(space.exterior.coords))
        stray = corners[shapely.contains(pinion, corners)]
        worst = max([worst, *shapely.distance(stray, pinion.exterior)])
    return worst, parts


@pytest.mark.sampled(1)
@pytest.mark.parametrize("pair", PAIRS, ids=str)
def test_default_tips_keep_off_fillets_and_roots_and_given_ones_stay(
    pair: tuple[int, int, float, float, float, float],
) -> None:
    free, parts = deepest(scene_of(pair))
    assert free < 3e-4
    alone = {name: {"parts": {name: keys}} for name, keys in scene_of(pair)["parts"].items()}
    tips = {name: make_parts(scene_from_dict(raw, "t", "t"), "t")[0][name].circles["tip_diameter"]
            for name, raw in alone.items()}  # fmt: skip
    held, whole = deepest(scene_of(pair, **tips))
    assert held > 0.004
    for name, tip in tips.items():
        assert whole[name].circles["tip_diameter"] == pytest.approx(tip, rel=1e-12)
    # teeth become shorter, not longer
    assert parts["pinion"].circles["tip_diameter"] <= tips["pinion"]
    assert parts["ring"].circles["tip_diameter"] >= tips["ring"]
    assert any(abs(parts[name].circles["tip_diameter"] - tip) > 0.01 for name, tip in tips.items())


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("pair", "part"),
    [
        ((10, 36, 0.4151, 0.917897, 20.0, 0.0), "pinion"), ((24, 75, 0.78, 1.25, 20.0, 0.0), "pinion"),
        ((28, 72, 0.88, 1.01, 20.0, 15.0), "pinion"), ((34, 89, 0.5, 0.84, 14.5, 0.0), "pinion"),
        ((32, 49, 0.27, 1.06, 20.0, 0.0), "ring"), ((24, 45, 0.66, 1.22, 14.5, 0.0), "ring"),
        ((33, 51, 0.88, 1.56, 14.5, 15.0), "ring"),
    ],
    ids=str,
)  # fmt: skip
def test_the_limit_of_a_tip_is_where_its_corner_touches_the_mates_fillet(
    pair: tuple[int, int, float, float, float, float], part: str
) -> None:
    """The gap of both outlines over a pitch knows nothing of that limit: 0.5 um on either side of it."""

    def made(**tips: float) -> Any:
        scene = scene_from_dict(scene_of(pair, **tips), "t", "t")
        return make_parts(scene, "t")[1][0]

    limits = dict(zip(("pinion", "ring"), made().pair.tip_limits, strict=True))
    off = 0.001 if part == "pinion" else -0.001
    inside, beyond = (made(**{part: limits[part] + sign * off}).contact(0.0, 0.0, None) for sign in (-1, 1))
    assert inside.verdict is Verdict.CONTACT
    assert beyond.verdict is Verdict.OVERLAP
    assert beyond.worst.gap > -0.001


@pytest.mark.parametrize("checked", [False, True])
def test_a_build_tells_it_with_and_without_its_checks(
    checked: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    raw = scene_of(PAIRS[0])
    head = '[[mates]]\nkind = "internal_gear_pair"\nfirst = "ring"\nsecond = "pinion"\n'
    head += f"[checks]\ninterference = {str(checked).lower()}\n"
    scene = write_scene(tmp_path / "s.toml", raw["parts"], [{"format": "dxf"}], head)
    assert main(["build", str(scene), "--out", str(tmp_path / "out")]) == 0
    (told,) = (line for line in capsys.readouterr().out.splitlines() if "the ring's tips are made shorter" in line)
    (mate,) = json.loads((tmp_path / "out" / "s" / "report.json").read_text("utf-8"))["checks"]["mates"]
    (finding,) = (f for f in mate["findings"] if f["code"] == "tips_shortened_ring")
    tip = deepest(raw)[1]["ring"].circles["tip_diameter"]
    assert finding["value"] == pytest.approx(tip, rel=1e-12)
    assert f"{tip:.4f} mm" in told


def test_a_page_takes_the_tips_that_are_typed_and_those_of_a_scene_as_built(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A textbook's numbers stand, with the limit beside them; of a scene they are those of its files."""
    raw = scene_of(PAIRS[0])
    head = '[[mates]]\nkind = "internal_gear_pair"\nfirst = "ring"\nsecond = "pinion"\n'
    scene = write_scene(tmp_path / "s.toml", raw["parts"], [{"format": "dxf"}], head)
    words = ["kind=internal_gear_pair"]
    for name, part in (("first", raw["parts"]["pinion"]), ("second", raw["parts"]["ring"])):
        words += [f"{name}.{key}={value}" for key, value in part.items() if key != "kind"]

    def ring_of(*arguments: str) -> tuple[float, float]:
        assert main(["calc", "gear-pair", *arguments, "--format", "json"]) == 0
        values = json.loads(capsys.readouterr().out)["values"]
        return 2 * values["tip_radius"]["second"], values["least_tip_diameter_ring"]

    (typed, least), (built, _) = ring_of(*words), ring_of(str(scene))
    assert typed < least < built
    assert built == pytest.approx(deepest(raw)[1]["ring"].circles["tip_diameter"], rel=1e-12)
    assert ring_of(*words, "shortened_tips=true")[0] == built
    assert ring_of(str(scene), "shortened_tips=false")[0] == typed
