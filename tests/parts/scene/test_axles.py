"""Holes that know an axle: a frame follows its pair; what passes a hole off its centre is BROKEN."""

from __future__ import annotations

import math
import re
from pathlib import Path

import ezdxf
import pytest

from exporters.command.cli import main
from tests.exporters.making import dxf_chains

PAIR = """
[defaults]
face_width = 3.0
module = 2.0
bore_diameter = 6.0
[parts.pinion]
kind = "spur_gear"
number_of_teeth = 17
profile_shift_coefficient = {shift}
[parts.wheel]
kind = "spur_gear"
number_of_teeth = 30
[parts.frame]
kind = "plate"
width = 120.0
height = 60.0
centre = [24.0, 0.0]
holes = [{holes}]
[[mates]]
kind = "external_gear_pair"
first = "pinion"
second = "wheel"
direction_deg = 10.0
{more}
[[exports]]
format = "dxf"
"""
BOTH = '{ axis_of = "pinion", diameter = 6.0 }, { axis_of = "wheel", diameter = 6.2 }'


def _scene(folder: Path, shift: float = 0.1, holes: str = BOTH, more: str = "") -> str:
    file = folder / "s.toml"
    file.write_text(PAIR.format(shift=shift, holes=holes, more=more), encoding="utf-8")
    return str(file)


def test_a_frame_grows_with_its_pair(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A plate too short for the pair is refused; with a least distance to its edge it reaches so far, no farther."""
    short = Path(_scene(tmp_path))
    text = short.read_text("utf-8").replace("width = 120.0\n", "width = 60.0\n")
    short.write_text(text.replace("centre = [24.0, 0.0]\n", ""), encoding="utf-8")
    assert main(["build", str(short), "--out", str(tmp_path)]) == 2
    assert "parts.frame.width = 60.0" in capsys.readouterr().err
    short.write_text(short.read_text("utf-8").replace("width = 60.0\n", "width = 60.0\nbeyond_axles = 9.0\n"), "utf-8")
    assert main(["build", str(short), "--out", str(tmp_path), "-q"]) == 0
    (outer,) = ezdxf.readfile(tmp_path / "s" / "frame.dxf").query('LWPOLYLINE[layer=="CUT_OUTER"]')
    x, y = zip(*outer.get_points("xy"), strict=True)  # type: ignore[attr-defined]
    far = _working_distance(0.1) * math.cos(math.radians(10))
    assert (min(x), max(x)) == pytest.approx((-30.0, far + 9.0), abs=1e-5)
    assert (min(y), max(y)) == pytest.approx((-30.0, 30.0), abs=1e-5)


def _working_distance(shift: float) -> float:
    """inv alpha_w = inv alpha + 2 x tan alpha / (z1 + z2), by bisection."""
    alpha = math.radians(20)
    wanted = math.tan(alpha) - alpha + 2 * shift * math.tan(alpha) / 47
    low, high = alpha / 2, 1.0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if math.tan(middle) - middle < wanted else (low, middle)
    return 47.0 * math.cos(alpha) / math.cos(low)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("shift", [0.1, 0.55])
@pytest.mark.parametrize("turned", [None, 25.0])
def test_a_frame_follows_the_shifts_of_its_gears(shift: float, turned: float | None, tmp_path: Path) -> None:
    more = "" if turned is None else f"[instances.frame]\nat = [-3.0, 2.0, -3.0]\nrotation_deg = {turned}"
    assert main(["build", _scene(tmp_path, shift, more=more), "--out", str(tmp_path), "--part", "frame"]) == 0
    found = []
    for entity in ezdxf.readfile(tmp_path / "s" / "frame.dxf").modelspace():
        if entity.dxf.layer == "CUT_INNER":
            one, two = (complex(p[0], p[1]) for p in entity.get_points("xy"))
            found.append(((one + two) / 2, abs(one - two)))
    wheel = _working_distance(shift) * complex(math.cos(math.radians(10)), math.sin(math.radians(10)))
    turn = 1.0 if turned is None else complex(math.cos(math.radians(turned)), -math.sin(math.radians(turned)))
    shifted = 0j if turned is None else complex(-3, 2)
    for (centre, diameter), axle, wanted in zip(found, (0j, wheel), (6.0, 6.2), strict=True):
        assert abs(centre - (axle - shifted) * turn) <= 1e-5
        assert diameter == pytest.approx(wanted, abs=1e-5)


@pytest.mark.parametrize("turned", [None, 25.0])
def test_a_grid_stands_about_its_axle(turned: float | None, tmp_path: Path) -> None:
    """Four screws of a motor, 15.5 mm beside its axle each way along the plate, at the axle's own hole."""
    holes = BOTH + ', { axis_of = "pinion", diameter = 3.2, columns = 2, rows = 2, pitch = 31.0 }'
    more = "" if turned is None else f"[instances.frame]\nat = [-3.0, 2.0, -3.0]\nrotation_deg = {turned}"
    scene = _scene(
        tmp_path, holes=holes, more=more + '\n[[exports]]\nformat = "svg"\npurpose = "part"\nparts = ["frame"]'
    )
    assert main(["check", scene]) == 0
    assert main(["build", scene, "--out", str(tmp_path), "--part", "frame"]) == 0
    found = []
    for hole in dxf_chains(tmp_path / "s" / "frame.dxf"):
        one, two = hole.vertices[:2]
        if hole.layer == "CUT_INNER" and abs(one - two) < 5:
            found.append((one + two) / 2)
    turn = 1.0 if turned is None else complex(math.cos(math.radians(turned)), -math.sin(math.radians(turned)))
    axle = 0j if turned is None else complex(3, -2) * turn
    wanted = [axle + complex(x, y) for y in (-15.5, 15.5) for x in (-15.5, 15.5)]
    assert len(found) == 4
    assert all(min(abs(one - at) for one in found) < 1e-5 for at in wanted)


def test_an_axle_beside_its_grid_is_told_as_ever(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The middle one of three by three takes the axle: where that passes it off its centre, it is BROKEN."""
    grid = '{{ axis_of = "pinion", diameter = {}, columns = 3, rows = 3, pitch = 12.0 }}'
    more = '[instances.frame]\nat = [0.0, 0.0, -3.0]\n[instances.cover]\npart = "frame"\nat = [{}, 0.0, 3.0]'
    for diameter, off, code in ((6.0, 0.0, 0), (6.0, 0.05, 1), (6.2, 0.05, 0)):
        assert main(["check", _scene(tmp_path, holes=grid.format(diameter), more=more.format(off))]) == code
        assert ("BROKEN" in capsys.readouterr().out) == bool(code)


@pytest.mark.parametrize(
    ("holes", "more", "code", "told"),
    [
        (BOTH, "", 0, ""),
        (BOTH, '[instances.frame]\nat = [0.0, 0.0, -3.0]\n[instances.cover]\npart = "frame"\nat = [0.05, 0.0, 3.0]', 1,
         "the axle of pinion passes cover 0.05 mm off the centre of a hole, its clearance is 0 mm"),
        # 47.2 mm along 10 degrees is 46.5, 8.2
        ("{ at = [46.5, 8.2], diameter = 7.0 }", "[instances.frame]\nat = [0.0, 0.0, -3.0]", 0, ""),
        ("{ at = [46.5, 6.9], diameter = 7.0 }", "[instances.frame]\nat = [0.0, 0.0, -3.0]", 1, "the axle of wheel"),
        ("{ at = [46.5, 2.9], diameter = 7.0 }", "[instances.frame]\nat = [0.0, 0.0, -3.0]", 0, ""),
    ],
)  # fmt: skip
def test_an_axle_off_its_hole_is_broken(
    holes: str, more: str, code: int, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", _scene(tmp_path, holes=holes, more=more)]) == code
    said = capsys.readouterr().out
    assert ("BROKEN" in said) == bool(told)
    assert told in said


@pytest.mark.parametrize(("off", "hole", "clearance"), [
    (0.09, 6.2, None), (0.55, 7.2, None), (0.12, 6.2, "0.1"), (0.01, 6.0, "0"),
])  # fmt: skip
def test_the_pin_in_the_hole_is_the_axle_not_the_bore_about_it(
    off: float, hole: float, clearance: str | None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before: the wheel's bore of 6.2 mm counted, where a dowel of 6 mm stands."""
    at = f"{{ at = [{_working_distance(0.1) - off}, 0.0], diameter = {hole} }}"
    model = f"""
[[assemblies]]
kind = "gear_pair_model"
teeth = [17, 30]
module = 2.0
shifts = [0.1, 0.0]
[parts.frame]
width = 120.0
holes = [{{ axis_of = "pinion", diameter = 6.0 }}, {at}]
"""
    file = tmp_path / "s.toml"
    file.write_text(model, encoding="utf-8")
    assert main(["check", str(file)]) == (0 if clearance is None else 1)
    said = capsys.readouterr().out
    assert said.count("BROKEN") == (0 if clearance is None else 1)
    assert clearance is None or f"mm off the centre of a hole, its clearance is {clearance} mm" in said


@pytest.mark.parametrize(
    ("holes", "more", "key"),
    [
        ('{ axis_of = "whel", diameter = 6.0 }', "", "axis_of"),
        ('{ axis_of = "frame", diameter = 6.0 }', "", "axis_of"),
        ('{ axis_of = "wheel", at = [1.0, 2.0], diameter = 6.0 }', "", "axis_of"),
        ("{ diameter = 6.0 }", "", "at"),
        (BOTH, "[instances.frame]\nat = [0.0, 0.0, 0.0]\naxis = [1.0, 0.0, 0.0]", "axis_of"),
    ],
)
def test_an_axle_that_is_not_there_is_one_line(
    holes: str, more: str, key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build", _scene(tmp_path, holes=holes, more=more), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert f"parts.frame.holes[1].{key}" in said
    assert not (tmp_path / "out").exists()


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("frame", "holes", "key", "others"),
    [
        # 47.2 mm along 10 degrees is 46.5, 8.2: the wheel's hole is over the right edge, or beyond it
        ("width = 49.0\nheight = 60.0", BOTH, "width", "height = 60.0"),
        ("width = 30.0\nheight = 60.0", BOTH, "width", "height = 60.0"),
        ("width = 120.0\nheight = 18.0", BOTH, "height", "width = 120.0"),
        # neither side alone
        ("width = 30.0\nheight = 10.0", BOTH, None, ""),
    ],
)
def test_a_frame_too_short_for_its_axles_is_told_its_least_size(
    frame: str, holes: str, key: str | None, others: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = Path(_scene(tmp_path, holes=holes))
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("width = 120.0\nheight = 60.0", frame), encoding="utf-8")
    assert main(["check", str(file)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert re.search(r"falls at x [-\d.]+, y [-\d.]+ mm", said)
    assert "diameter" not in said
    if key is None:
        assert "axis_of" in said
        assert "at least" not in said
        return
    found = re.search(rf"parts\.frame\.{key} = .*at least ([\d.]+) mm", said)
    assert found
    for scale, code in ((1.0, 0), (0.999, 2)):
        file.write_text(
            text.replace("width = 120.0\nheight = 60.0", f"{others}\n{key} = {scale * float(found[1])}"),
            encoding="utf-8",
        )
        assert main(["check", str(file)]) == code


def test_an_axle_is_looked_for_among_other_instances(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", _scene(tmp_path, holes='{ axis_of = "pinon", diameter = 6.0 }')]) == 2
    said = capsys.readouterr().err
    assert "pinion, wheel" in said
    assert "wheel, frame" not in said
