"""Lines that a laser engraves in a plate: in its files as they are told, in its drawing, and not beyond its edges."""

from __future__ import annotations

from pathlib import Path

import ezdxf
import numpy as np
import pytest

from exporters.command.cli import main
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts

ZIGZAG, RING = [[-20.0, -30.0], [0.0, -20.0], [20.0, -30.0]], [[-5.0, 5.0], [5.0, 5.0], [0.0, 15.0], [-5.0, 5.0]]


def scene(folder: Path, strokes: object, more: str = "", size: tuple[float, float] = (60.0, 90.0)) -> Path:
    file = folder / "s.toml"
    width, height = size
    head = f'[parts.p]\nkind = "plate"\nwidth = {width}\nheight = {height}\ncorner_radius = 5.0\nstrokes = {strokes}\n'
    file.write_text(f'{head}{more}[[exports]]\nformat = "dxf"\nkerf = 0.4\n', encoding="utf-8")
    return file


def test_they_are_engraved_where_they_are_told_whatever_the_kerf(tmp_path: Path) -> None:
    drawn = '[[exports]]\nformat = "dxf"\npurpose = "part"\nname = "sheet"\n'
    assert main(["build", str(scene(tmp_path, [ZIGZAG, RING], drawn)), "--out", str(tmp_path), "-q"]) == 0
    found = [e for e in ezdxf.readfile(tmp_path / "s" / "p.laser.dxf").modelspace() if e.dxf.layer == "ENGRAVE"]
    assert len(found) == 2
    for entity, told in zip(found, (ZIGZAG, RING), strict=True):
        assert np.allclose(list(entity.get_points("xy")), told)
    lines = [e for e in ezdxf.readfile(tmp_path / "s" / "p.sheet.dxf").modelspace() if e.dxf.layer == "THIN"]
    # of the drawing in its scale: the lengths of all legs are there
    lengths = [(e.dxf.end - e.dxf.start).magnitude for e in lines if e.dxftype() == "LINE"]
    legs = [np.hypot(20, 10), 10.0, np.hypot(5, 10)]
    scale = max(lengths) / legs[0]
    assert all(any(abs(length - scale * leg) < 1e-6 for length in lengths) for leg in legs)


def test_a_name_keeps_clear_of_them(tmp_path: Path) -> None:
    """Of lines over all but an edge it stands there, of lines in one half in the other."""
    import shapely

    for lines in ([[[x, -42.0], [x, 42.0]] for x in range(-28, 29, 2)], [ZIGZAG], [[[-25.0, 0.0], [25.0, 0.0]]]):
        made = make_parts(load_scene(str(scene(tmp_path, lines, "label = true\n"))), "s")[0]["p"].cut(0.0)
        assert not made.region.apart
        told = shapely.MultiLineString(lines)
        letters = [s for s in made.region.strokes if [[p.real, p.imag] for p in s] not in lines]
        assert letters
        assert min(told.distance(shapely.LineString([(p.real, p.imag) for p in s])) for s in letters) > 0.5


@pytest.mark.parametrize("end", [[-30.1, 0.0], [0.0, 45.1], [-29.0, -44.0], [1e4, 0.0]])
def test_one_that_leaves_the_plate_is_refused(end: list[float], tmp_path: Path) -> None:
    """Beside its edges, and in the corner that the rounding cuts off."""
    file = scene(tmp_path, [ZIGZAG, [[0.0, 0.0], end]])
    with pytest.raises(SceneError) as found:
        make_parts(load_scene(str(file)), "s")
    assert (found.value.code, found.value.key) == ("stroke_leaves_plate", "parts.p.strokes[2]")
    make_parts(load_scene(str(scene(tmp_path, [ZIGZAG, [[0.0, 0.0], [-28.5, -43.5]]]))), "s")
