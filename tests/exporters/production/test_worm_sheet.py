"""The sheet of a worm in its wheel, read from its files: lines of contact, their field, and how much worm is used."""

from __future__ import annotations

import math
import re
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from exporters.command.cli import main
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.worm import Worm

PAIR = """
[scene]
language = "{language}"

[parts.wheel]
kind = "worm_wheel"
module = 5.0
number_of_teeth = 128
face_width = 26.0
outer_diameter = 660.0
{hob}

[parts.worm]
kind = "worm"
module = 5.0
thread_length = {length}
end_angle_deg = 0.0

[[mates]]
kind = "worm_pair"
first = "wheel"
second = "worm"

[[exports]]
format = "sheet"
purpose = "meshing"
tolerance = 1e-3
"""


def _scene(folder: Path, *, length: float = 120.0, language: str = "en", hob: str = "") -> Path:
    file = folder / "pair.toml"
    file.write_text(PAIR.format(length=length, language=language, hob=hob))
    return file


def test_lines_of_contact_lie_where_sections_of_the_worm_touch(tmp_path: Path) -> None:
    assert main(["build", str(_scene(tmp_path, language="uk")), "--out", str(tmp_path), "--no-verify"]) == 0
    drawing = ezdxf.readfile(tmp_path / "pair" / "pair.meshing.1.dxf").modelspace()
    axis = next(x for x in drawing.query("LINE") if x.dxf.layer == "CENTRE").dxf
    middle = complex(axis.start.x + axis.end.x, axis.start.y + axis.end.y) / 2
    left, right = (
        x.dxf.start.x
        for x in drawing.query("LINE")
        if x.dxf.layer == "DIMENSION" and abs(x.dxf.start.y - middle.imag) < 1e-6
    )
    texts = [t.dxf.text for t in drawing.query("TEXT")]
    assert "лінії контакту в один момент" in texts
    assert any(t.startswith("Лінії контакту черв'яка й колеса") for t in texts)
    scale = float(next(t for t in texts if t.endswith(":1")).partition(":")[0])
    # issue 15: 35.99 mm from the middle on one side, rounded up
    assert (right - left) / scale == pytest.approx(2 * 35.99, abs=0.03)
    drive = WormDrive(Worm(5.0, 1, 10.0, "ZI"), 128)
    pitch, seen, zones = math.pi * 5, 0, []
    radii = np.linspace(19.7, 30.0, 10_001)
    for spline in drawing.query("SPLINE"):
        points = np.array([complex(p[0], p[1]) for p in spline.construction_tool().approximate(40)])
        if np.abs(points.imag - middle.imag).max() > 13.1 * scale:
            # of the wheel
            continue
        model = (points - middle) / scale
        zones.append(model.real)
        if spline.dxf.layer != "ACTIVE_LINE":
            continue
        off = []
        for z, height in [(p.real, p.imag) for p in model[:: max(len(model) // 3, 1)]]:
            inside = radii[radii > abs(height) + 0.1]
            found = []
            for upper in (True, False):
                slid = drive.section(inside, -height, upper=upper)[1]
                touched = drive.worm.axial(inside, -height)[0 if upper else 1] + slid
                # at this moment threads stand a whole number of pitches from the middle
                for whole in np.arange(-4, 5) * pitch:
                    if slid.min() <= whole <= slid.max():
                        order = np.argsort(slid)
                        found.append(abs(float(np.interp(whole, slid[order], touched[order])) - z))
            off.append(min(found))
        assert max(off) < 3e-3
        seen += 1
    # three teeth or four touch at once, on either side
    assert seen in (6, 8)
    farthest = [max(abs(z.min()), abs(z.max())) for z in zones]
    assert max(farthest) == pytest.approx(35.99, abs=0.02)


@pytest.mark.parametrize(("length", "told"), [pytest.param(72.0, False, marks=pytest.mark.heavy), (71.8, True)])
def test_a_thread_that_ends_within_the_contact_is_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], length: float, told: bool
) -> None:
    main(["check", str(_scene(tmp_path, length=length))])
    assert ("the thread is 71.8 mm long, the wheel touches it over 71.959 mm" in capsys.readouterr().out) is told


def test_a_wheel_of_a_larger_hob_has_no_lines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = _scene(tmp_path, hob="hob_diameter_quotient = 10.5")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 2
    assert "touches its worm at points" in capsys.readouterr().err


def test_corners_beyond_the_throat_count(capsys: pytest.CaptureFixture[str]) -> None:
    main(["check", "worm_set_print", "--json"])
    told = [float(x) for x in re.findall(r'"worm_length_used": ([0-9.]+)', capsys.readouterr().out)]
    # the lower flank at the corner, where the outer cylinder ends the tooth, by a scan of the worm's section
    drive, radii = WormDrive(Worm(2.0, 2, 10.0, "ZI"), 30), np.linspace(8.0, 12.0, 400_001)
    corners = []
    for height in (-7.0, 7.0):
        points, slid = drive.section(radii, height, upper=False)
        at = np.abs(np.abs(points) - 32.5).argmin()
        corners.append(abs(drive.worm.axial(radii[at], height)[1] + slid[at]))
    assert told
    assert told[0] == pytest.approx(2 * max(corners), abs=1e-3)


@pytest.mark.heavy
def test_a_face_whose_ends_the_worm_does_not_reach_is_drawn(tmp_path: Path) -> None:
    scene = PAIR.format(length=60.0, language="en", hob="number_of_starts = 2")
    for old, new in (("module = 5.0", "module = 1.5"), ("= 128", "= 40"), ("26.0", "13.3"), ("660.0", "65.25"),
                     ("thread_length", "number_of_starts = 2\nthread_length")):  # fmt: skip
        scene = scene.replace(old, new)
    file = tmp_path / "pair.toml"
    file.write_text(scene)
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0


@pytest.mark.heavy
def test_a_thread_that_runs_out_stays_on_its_sheet(tmp_path: Path) -> None:
    scene, ends = PAIR.format(length=45.0, language="en", hob="number_of_starts = 2"), 'thread_ends = "run_out"'
    for old, new in (("module = 5.0", "module = 2.0"), ("= 128", "= 36"), ("26.0", "16.0"), ("660.0", "82.0"),
                     ("end_angle_deg = 0.0", f"number_of_starts = 2\n{ends}")):  # fmt: skip
        scene = scene.replace(old, new)
    (tmp_path / "runs_out.toml").write_text(scene, encoding="utf-8")
    assert main(["build", str(tmp_path / "runs_out.toml"), "--out", str(tmp_path)]) == 0
