"""Short edges of racks: merged alike on every tooth, within the error told, at a cost that goes with the teeth."""

from __future__ import annotations

import json
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from exporters.command.cli import main
from geometry.curves.curve import Complex
from geometry.curves.line_arc import Line

SCENE = """[parts.rack]
kind = "rack"
module = 1.0
number_of_teeth = {teeth}
body_height = 3.0
{corner} = {size}
[[exports]]
format = "dxf"
"""


def outline(folder: Path, teeth: int, corner: str, size: float) -> tuple[Complex, float]:
    """Vertices of a rack's laser file, and its declared error."""
    folder.mkdir()
    (folder / "s.toml").write_text(SCENE.format(teeth=teeth, corner=corner, size=size))
    assert main(["build", str(folder / "s.toml"), "--out", str(folder)]) == 0
    (told,) = json.loads((folder / "s" / "report.json").read_text())["files"]
    (loop,) = ezdxf.readfile(folder / "s" / "rack.dxf").modelspace().query("LWPOLYLINE")
    return np.array([complex(x, y) for x, y in loop.get_points("xy")]), float(told["max_error"])


def test_every_tooth_is_merged_alike(tmp_path: Path) -> None:
    """An arc of 0.004 mm at each corner goes; what is left lies within the error of the rack with sharp corners."""
    merged, error = outline(tmp_path / "merged", 7, "tip_rounding", 0.004)
    sharp, _ = outline(tmp_path / "sharp", 7, "tip_rounding", 0.0)
    assert 0 < error <= 0.005
    assert np.abs(np.roll(merged, -1) - merged).min() >= 0.02
    tips = merged[merged.imag > merged.imag.max() - 0.1]
    pitches = np.sort(tips.real).reshape(7, -1)
    # alike but for the digits that are written
    assert np.abs(np.diff(pitches, axis=0) - np.pi).max() <= 1e-7
    # a rounded corner of radius r leaves less than r of a sharp one
    far = [np.abs(sharp - corner).min() for corner in merged]
    assert max(far) <= error + 0.004


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("corner", "size"), [("tip_rounding", 0.004), ("tip_chamfer", 0.01)])
def test_what_is_measured_goes_with_the_teeth(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, corner: str, size: float
) -> None:
    """All curves were measured anew for every edge: nine times the points for three times the teeth."""
    asked = [0]
    point = Line.point

    def counted(self: Line, t):
        asked[0] += np.size(t)
        return point(self, t)

    monkeypatch.setattr(Line, "point", counted)
    found = []
    for teeth in (5, 15):
        asked[0] = 0
        outline(tmp_path / str(teeth), teeth, corner, size)
        found.append(asked[0])
    assert found[1] < 4 * found[0]
