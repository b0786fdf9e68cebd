"""Animated SVG: poses at many times by a reader of the tests' own, loops that close, spoiled files."""

from __future__ import annotations

import cmath
import math
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from exporters.formats.read_motion import read_motion
from exporters.production.build import build
from exporters.production.plan import Plan, plan_build
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, resolved, scene_from_resolved, scene_from_toml
from tests.exporters.making import run
from tests.parts.scene.test_followers import scene_text
from tests.parts.scene.test_trains import DRIVE, FREE, JAMES
from tests.sampling import some_of

MOTION = '[[exports]]\nformat = "motion"\n'
SVG = "{http://www.w3.org/2000/svg}"


def planned(text: str) -> Plan:
    return plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s", [], ["motion"])


def at(file: Path, name: str, share: float) -> tuple[complex, float]:
    """Place and turn (degrees, counter-clockwise) of an instance, y up: what SMIL says of linear values."""
    (group,) = (g for g in ElementTree.parse(file).getroot().iter(f"{SVG}g") if g.get("id") == name)
    found = []
    for element in (group, group.find(f"{SVG}g")):
        assert element is not None
        move = element.find(f"{SVG}animateTransform")
        stands = element.get("transform", "()").partition("(")[2].rpartition(")")[0]
        rows = [stands] if move is None else move.get("values", "").split(";")
        values = np.array([[float(x) for x in row.split(",")] for row in rows])
        times = None if move is None else move.get("keyTimes")
        where = np.linspace(0, 1, len(values)) if times is None else np.array([float(x) for x in times.split(";")])
        found.append([float(np.interp(share, where, column)) for column in values.T])
    return complex(found[0][0], -found[0][1]), -found[1][0]


def test_satellites_turn_as_the_formula_says(tmp_path: Path) -> None:
    """40/40/120: in four turns of the sun the carrier makes one, a satellite turns by -2; then the loop closes."""
    plan = planned(JAMES + DRIVE.format("sun", "turns = 4.0") + MOTION)
    built = build(plan, tmp_path)
    assert built.well
    file = tmp_path / "s.motion.svg"
    start = {i.id: i for i in plan.placing.instances}
    for share in (0.0, 0.037, 1 / 3, 0.71, 1.0):
        for name, turns in (("sun", 4), ("carrier", 1), ("planet_2", -2), ("ring", 0)):
            place, turn = at(file, name, share)
            assert turn == pytest.approx(math.degrees(start[name].rotation) + 360 * turns * share, abs=1e-7)
            around = cmath.exp(2j * math.pi * share) if name == "planet_2" else 1.0
            assert abs(place - start[name].centre * around) < 0.02
    # a renderer without animation shows the first pose
    for group in ElementTree.parse(file).getroot().iter(f"{SVG}g"):
        for move in group.findall(f"{SVG}animateTransform"):
            assert group.get("transform") == f"{move.get('type')}({move.get('values', '').split(';')[0]})"
    (written,) = built.written
    assert written.job.told["closes"] is True
    assert written.job.told["drive"] == pytest.approx(4.0)


def test_a_follower_is_shown_on_its_cam(tmp_path: Path) -> None:
    """The flat face of the laser model stands on its cam's law: heights against those of the placing."""
    kept = resolved(load_scene("laser_cam_model")) | {
        "drives": [{"instance": "cam"}],
        "exports": [{"format": "motion"}],
    }
    plan = plan_build(scene_from_resolved(kept, "m"), "m", [], [])
    assert build(plan, tmp_path).well
    (file,) = tmp_path.glob("*.motion.svg")
    for share in (0.1, 0.2, 0.45, 0.9):
        stand = {i.id: i for i in plan.placing.at([share])}
        assert abs(at(file, "follower", share)[0] - stand["follower"].centre) < 0.02
        assert at(file, "guide_left", share)[0] == pytest.approx(stand["guide_left"].centre, abs=1e-5)


def test_a_loop_that_would_take_too_long_is_cut_and_said() -> None:
    """97 and 101 teeth, both marked by the flat of their bore: as they were after 101 turns. One alone: after one."""
    keys = 'kind = "spur_gear"\nmodule = 1.0\nface_width = 5.0\n'
    mate = '[[mates]]\nkind = "external_gear_pair"\nfirst = "a"\nsecond = "b"\n[[drives]]\ninstance = "a"\n'
    flat = 'bore = { shape = "D", diameter = 9.0, flat = 8.0 }\n'

    def told(second: str) -> tuple[object, object]:
        parts = f"[parts.a]\nnumber_of_teeth = 97\n{keys}{flat}[parts.b]\nnumber_of_teeth = 101\n{keys}{second}"
        found = planned(parts + mate + MOTION).sheets[0].told
        return found["closes"], pytest.approx(found["drive"])

    assert told("bore_diameter = 9.0\n") == (True, 1.0)
    assert told(flat) == (False, 20.0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("turns", [65.0, -95.0])
def test_a_pinion_of_many_turns_goes_the_right_way_round(tmp_path: Path, turns: float) -> None:
    """A rack's whole way is one loop: more turns than values would be seen as fewer ones backwards."""
    kept = resolved(load_scene("rack_and_pinion")) | {
        "drives": [{"instance": "pinion", "turns": turns}],
        "exports": [{"format": "motion"}, {"format": "glb", "tolerance": 0.1}],
        "checks": {},
    }
    plan = plan_build(scene_from_resolved(kept, "m"), "m", [], [])
    assert build(plan, tmp_path).well
    (file,) = tmp_path.glob("*.motion.svg")
    starts = {i.id: i for i in plan.placing.instances}
    for share in (0.0, 0.003, 0.5, 1.0):
        assert at(file, "pinion", share)[1] == pytest.approx(
            math.degrees(starts["pinion"].rotation) + 360 * turns * share, abs=1e-6
        )
        way = abs(at(file, "rack", share)[0] - starts["rack"].centre)
        assert way == pytest.approx(abs(turns) * share * math.pi * 36, abs=1e-5)


SPOILED = (
    (r'values="[-\d.]+;', 'values="1.5;'),
    (r'(type="translate".*values="([-\d.]+,[-\d.]+;){7})[-\d.]+', r"\g<1>1.5"),
    (r'repeatCount="indefinite"', 'repeatCount="1"'),
    (r'<g id="planet_3"', '<g id="planet_9"'),
    (r"(;[-\d.]+,[-\d.]+){3}", ""),
    (r'id="ring" transform="translate\([-\d.]+', 'id="ring" transform="translate(0.1'),
    (r'transform="rotate\([-\d.]+', 'transform="rotate(1.5'),
    (r'transform="rotate\(', 'transform="scale(1)rotate('),
    (r"<title>", "<style>path{display:none}</style><title>"),
    (r"L[-\d.]+,", "L1,"),
)


def test_spoiled_motions_are_seen(tmp_path: Path) -> None:
    build(planned(JAMES + DRIVE.format("sun", "turns = 4.0") + MOTION), tmp_path)
    file = tmp_path / "s.motion.svg"
    text = file.read_text(encoding="utf-8")
    assert run("verify", str(file)) == 0
    for old, new in some_of(SPOILED, 3):
        spoiled = re.sub(old, new, text, count=1)
        assert spoiled != text
        file.write_text(spoiled, encoding="utf-8")
        assert run("verify", str(file)) == 1, new
    # a hole that is left out moves nothing
    less = re.sub(r'("[^"]*Z) ?M[^"Z]*Z', r"\1", text, count=1)
    assert less != text
    file.write_text(less, encoding="utf-8")
    assert run("verify", str(file)) == 1


def test_a_loop_of_any_length_is_good(tmp_path: Path) -> None:
    """How long it takes is written with so many digits, 22.260869565 s; another one is not the same."""
    build(planned(JAMES + DRIVE.format("sun", "turns = 4.0") + MOTION), tmp_path)
    file = tmp_path / "s.motion.svg"
    text = file.read_text(encoding="utf-8")
    for seconds, well in (("16.000000001", True), ("16.001", False)):
        file.write_text(text.replace('dur="16s"', f'dur="{seconds}s"'), encoding="utf-8")
        assert (run("verify", str(file)) == 0) is well


def test_a_scene_without_drives_has_no_motion() -> None:
    with pytest.raises(SceneError, match="shows what a drive moves"):
        planned(FREE + MOTION)


def swept(file: Path) -> tuple[np.ndarray, np.ndarray]:
    """Left, top, right and bottom of all corners over a loop; and of the page."""
    root = ElementTree.parse(file).getroot()
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for group in root.iter(f"{SVG}g"):
        if (name := group.get("id")) is None:
            continue
        (path,) = group.iter(f"{SVG}path")
        ends = re.findall(r"([-\d.]+),([-\d.]+)(?=\s*(?:[MLAZ]|$))", path.get("d", ""))
        corners = np.array([complex(float(x), -float(y)) for x, y in ends])
        for share in np.linspace(0, 1, 25):
            place, turn = at(file, name, share)
            placed = place + corners * cmath.rect(1.0, math.radians(turn))
            low = np.minimum(low, [placed.real.min(), -placed.imag.max()])
            high = np.maximum(high, [placed.real.max(), -placed.imag.min()])
    left, top, width, height = map(float, root.get("viewBox", "").split())
    for key, size in (("width", width), ("height", height)):
        assert float(root.get(key, "").removesuffix("mm")) == size
    return np.array([*low, *high]), np.array([left, top, left + width, top + height])


@pytest.fixture(scope="module")
def rocker(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Plan, float]:
    """A cam that swings an arm, unevenly about an axis that stays; and the error that is declared."""
    folder = tmp_path_factory.mktemp("rocker")
    text = scene_text("flat", "against").replace("{turned}", "0.0").replace("{direction}", "60.0")
    plan = planned(text.partition("[checks]")[0] + DRIVE.format("cam", "turns = 1.0") + MOTION)
    built = build(plan, folder)
    assert built.well
    return folder / "s.motion.svg", plan, built.written[0].max_error


def test_all_that_moves_stays_within_a_page_that_is_no_larger_than_it_needs(rocker: tuple[Path, Plan, float]) -> None:
    file, plan, _ = rocker
    drawn, page = swept(file)
    assert ((page - drawn) * [-1, -1, 1, 1] > 0).all()
    # about each place a circle of what is drawn there, and 3 hundredths of it
    reach = {i.id: 1.03 * plan.parts[i.part].section(0.0).region.outer.reach() for i in plan.placing.instances}
    poses = [(i.centre, reach[i.id]) for share in np.linspace(0, 1, 25) for i in plan.placing.at([share])]
    edges = [min(p.real - r for p, r in poses), min(-p.imag - r for p, r in poses),
             max(p.real + r for p, r in poses), max(r - p.imag for p, r in poses)]  # fmt: skip
    assert page == pytest.approx(edges, abs=0.05)


def test_an_uneven_turn_is_as_near_as_is_declared(rocker: tuple[Path, Plan, float]) -> None:
    """Straight between values: the arm's end is off by no more than is declared, and by no little share of it."""
    file, plan, declared = rocker
    reach = plan.parts["follower"].section(0.0).region.outer.reach()
    (group,) = (g for g in ElementTree.parse(file).getroot().iter(f"{SVG}g") if g.get("id") == "follower")
    move = group.findall(f".//{SVG}animateTransform")[-1]
    angles = -np.radians(np.array(list(map(float, move.get("values", "").split(";")))))
    assert move.get("keyTimes") is None
    shares = (np.arange(len(angles) - 1) + 0.5) / (len(angles) - 1)
    exact = np.array([next(i.rotation for i in plan.placing.at([s]) if i.id == "follower") for s in shares.tolist()])
    off = exact - (angles[:-1] + angles[1:]) / 2
    off = np.abs(np.angle(np.exp(1j * off))).max() * reach
    assert declared / 20 < off <= declared <= 0.05


@pytest.mark.sampled(1)
@pytest.mark.parametrize("turns", [38.0, -38.0])
def test_a_chain_runs_on_with_its_sprockets(tmp_path: Path, turns: float) -> None:
    """Pins one pitch apart throughout; those on the first sprocket lie on its pitch circle and turn as it does."""
    kept = resolved(load_scene("chain_drive")) | {
        "drives": [{"instance": "pinion", "turns": turns}],
        "exports": [{"format": "motion"}],
        "checks": {},
    }
    kept["mates"] = kept["mates"][:1]
    assert build(plan_build(scene_from_resolved(kept, "m"), "m", [], []), tmp_path).well
    (file,) = tmp_path.glob("*.motion.svg")
    track = read_motion(file)["chain.pinion.wheel"]
    assert track.forms is not None
    # outer corners one way round, inner ones the other, two a link; the seam twice
    count = (track.forms.shape[1] - 2) // 4
    outer, inner = track.forms[:, : 2 * count : 2], track.forms[:, : 2 * count + 1 : -1][:, ::2]
    pins = (outer + inner) / 2
    assert pins.shape[1] == 80
    assert np.abs(pins - np.roll(pins, 1, axis=1)) == pytest.approx(12.7, abs=0.01)
    radius = 12.7 / 2 / math.sin(math.pi / 17)
    for k in range(len(pins) - 1):
        (seated,) = np.nonzero(np.abs(pins[k].real + radius) < 0.4 * radius)
        assert len(seated) >= 3
        assert np.abs(pins[k : k + 2, seated]) == pytest.approx(radius, abs=2e-4)
        step = np.angle(pins[k + 1, seated] / pins[k, seated])
        assert step == pytest.approx(math.copysign(2 * math.pi / 17 / (len(pins) - 1), turns), abs=1e-5)
    # in the time of a pitch; another one is seen
    assert track.seconds * 17 * 20 == pytest.approx(60.0)
    text = file.read_text(encoding="utf-8")
    for old, new in (('dur="0.17', 'dur="0.18'), (r'(values="M[^;]*;M)[-\d.]+', r"\g<1>1.5")):
        spoiled = re.sub(old, new, text, count=1)
        assert spoiled != text
        file.write_text(spoiled, encoding="utf-8")
        assert run("verify", str(file)) == 1


WHOLE_GENEVA = """
[parts.cross]
kind = "geneva_wheel"
number_of_slots = 6
centre_distance = 60.0
[parts.driver]
kind = "geneva_driver"
of = "cross"
bore_diameter = 6.0
[[mates]]
kind = "geneva_pair"
first = "driver"
second = "cross"
[[drives]]
instance = "driver"
turns = 1.0
"""


def test_a_pin_of_one_piece_is_shown_in_its_slot(tmp_path: Path) -> None:
    """Of 3.75 mm on a circle of 60 sin(30) mm; seen from the cross it goes along a slot while that turns."""
    assert build(planned(WHOLE_GENEVA + MOTION), tmp_path).well
    file = tmp_path / "s.motion.svg"
    (group,) = (g for g in ElementTree.parse(file).getroot().iter(f"{SVG}g") if g.get("id") == "driver")
    paths = [path.get("d", "") for path in group.iter(f"{SVG}path")]
    assert len(paths) == 3
    disc, pin = (
        np.array([complex(float(x), -float(y)) for x, y in re.findall(r"([-\d.e]+),([-\d.e]+)(?: [MLAZ]|$)", data)])
        for data in paths[1:]
    )
    middle = pin[:-1].mean()
    assert abs(middle) == pytest.approx(30.0, abs=1e-5)
    assert np.abs(pin - middle) == pytest.approx(1.875, abs=1e-5)
    # the disc locks the cross: 60 less its tip circle, no more than the chords of a picture off
    assert np.abs(disc).max() == pytest.approx(24.375, abs=1e-3)
    for share in np.linspace(-0.16, 0.16, 9):
        (centre, turn), (axis, cross) = (at(file, name, float(share % 1.0)) for name in ("driver", "cross"))
        seen = (centre + middle * cmath.exp(1j * math.radians(turn)) - axis) * cmath.exp(-1j * math.radians(cross))
        assert abs(seen) * abs(math.sin(3 * cmath.phase(seen))) / 3 < 0.02
    text = file.read_text(encoding="utf-8")
    spoiled = [text.replace("max-width:100%", "opacity:0")]
    for line in (one for one in text.splitlines() if "evenodd" not in one and "<path" in one):
        spoiled += [text.replace(line, new) for new in ("", line.replace('d="M', 'd="M1'), f"{line}\n{line}")]
        spoiled += [text.replace(line, re.sub(r"(A[\d.]+,[\d.]+ 0 0 . |L)[-\d.]+", r"\g<1>25.5", line, count=1))]
        spoiled += [text.replace(line, line.replace("fill:", "display:none;fill:"))]
    assert len(spoiled) == 11
    for other in spoiled:
        assert other != text
        file.write_text(other, encoding="utf-8")
        assert run("verify", str(file)) == 1, other


def test_pins_of_an_output_plate_are_shown_in_the_holes_of_its_disc(tmp_path: Path) -> None:
    kept = resolved(load_scene("cycloidal_reducer")) | {"exports": [{"format": "motion"}], "checks": {}}
    assert build(plan_build(scene_from_resolved(kept, "m"), "m", [], []), tmp_path).well
    (file,) = tmp_path.glob("*.motion.svg")
    shown = {name: track.pins for name, track in read_motion(file).items() if track.pins}
    (pins,) = shown.values()
    assert {len(pins)} == {kept["parts"][next(iter(shown))]["number_of_pins"]}
