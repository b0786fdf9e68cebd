"""The greatest gap that ``check`` tells of gears: against the outlines of their files, turned by brute force."""

from __future__ import annotations

import json
import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely

from tests.exporters.making import run, write_scene


def outline(file: Path, facing: float) -> np.ndarray:
    """Complex vertices of a gear's teeth within a radian of where they face the mate, and its middle."""
    chain = max(ezdxf.readfile(file).modelspace().query("LWPOLYLINE"), key=len)
    points = np.array([complex(x, y) for x, y in chain.get_points("xy")])
    turned = np.angle(points * np.exp(-1j * facing))
    order = np.argsort(turned, kind="stable")
    near = np.sort(order[np.abs(turned[order]) < 1.0])
    start = int(np.argmax(np.diff(np.append(near, near[0] + len(points))))) + 1
    return np.append(0j, points[np.roll(near, -start)])


def polygon(points: np.ndarray, turn: float, at: float = 0.0) -> shapely.Polygon:
    placed = points * np.exp(1j * turn) + at
    return shapely.Polygon(np.column_stack([placed.real, placed.imag]))


@pytest.mark.heavy
def test_the_greatest_gap_is_where_teeth_part_that_others_do_not_follow_yet(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of a drive that is interrupted; it was told as 0.065 mm, the greatest of the drive angles that were looked at."""
    teeth, distance, stand = (7, 64), 35.5, 177.1875 + 0.055
    parts = {
        name: {"kind": "cycloidal_gear", "module": 1.0, "number_of_teeth": teeth[k], "face_width": 5.0,
               "mate_number_of_teeth": teeth[1 - k], "addendum_coefficient": high, "dedendum_coefficient": deep}
        for k, (name, high, deep) in enumerate((("a", 0.266, 0.386), ("b", 0.272, 0.662)))
    }  # fmt: skip
    mates = (
        f"[instances.a]\nat = [0.0, 0.0, 0.0]\n[instances.b]\nat = [{distance}, 0.0, 0.0]\nrotation_deg = {stand}\n"
        '[[mates]]\nkind = "cycloidal_gear_pair"\nfirst = "a"\nsecond = "b"\nnormal_backlash = 0.136\n'
    )
    file = write_scene(
        tmp_path / "s.toml", parts, [{"format": "dxf", "curves": "lines", "tolerance": 1e-5}], head=mates
    )
    assert run("build", file, "--out", tmp_path, "--quiet") == 0
    capsys.readouterr()
    run("check", file, "--json")
    told = json.loads(capsys.readouterr().out)["mates"][0]
    turn = math.radians(stand)
    one, two = outline(tmp_path / "s" / "a.dxf", 0.0), outline(tmp_path / "s" / "b.dxf", math.pi - turn)

    def gap(drive: float) -> float:
        first, second = polygon(one, drive), polygon(two, turn - drive * teeth[0] / teeth[1], distance)
        shapely.prepare(first.exterior)
        return float(shapely.distance(first.exterior, second.exterior))

    drives = np.linspace(-math.pi, math.pi, 97) / teeth[0]
    for _ in range(3):
        at = int(np.argmax([gap(x) for x in drives]))
        drives = np.linspace(drives[max(at - 1, 0)], drives[min(at + 1, len(drives) - 1)], 17)
    assert told["greatest_gap"] == pytest.approx(max(map(gap, drives)), abs=3e-5)
    assert told["gap"] > 0.03
