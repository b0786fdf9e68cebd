"""Tool paths from DXF: pieces chained by their ends, turned where they must be; what is no path is refused."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.layouts import Modelspace

from exporters.formats.read_path import read_path
from parts.base.refusal import SceneError


def made(folder: Path, draw: Callable[[Modelspace], object]) -> list[list[float]]:
    drawing = ezdxf.new()
    draw(drawing.modelspace())
    drawing.saveas(folder / "p.dxf")
    return read_path(folder / "p.dxf", "path")


def swept(piece: list[float]) -> np.ndarray:
    """Points of a piece by its bulge: the tangent of a quarter of its sweep, to the left above 0."""
    start, end = complex(*piece[:2]), complex(*piece[2:4])
    if not piece[4]:
        return start + np.linspace(0, 1, 9) * (end - start)
    sweep = 4 * math.atan(piece[4])
    centre = (start + end) / 2 + 1j * (end - start) / 2 / math.tan(sweep / 2)
    return centre + (start - centre) * np.exp(1j * np.linspace(0, sweep, 9))


def test_lines_and_arcs_are_chained_and_turned(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        space.add_line((0, 0), (10, 0))
        # from (10, 10) down to (10, 0) clockwise when it is run that way: drawn from below, about (10, 5)
        space.add_arc((10, 5), 5, 270, 90)
        space.add_line((0, 20), (10, 10))
        space.add_lwpolyline([(0, 20, 0.5), (-10, 20, 0.0), (-10, 25, 0.0)], format="xyb")

    path = made(tmp_path, draw)
    ends = [complex(*p[:2]) for p in path] + [complex(*path[-1][2:4])]
    assert ends == pytest.approx([0, 10, 10 + 10j, 20j, -10 + 20j, -10 + 25j], abs=1e-12)
    for one, two in pairwise(path):
        assert one[2:4] == pytest.approx(two[:2], abs=1e-6)
    # half a turn about (10, 5) to the left
    assert path[1][4] == pytest.approx(1.0)
    assert np.abs(swept(path[1]) - (10 + 5j)) == pytest.approx(np.full(9, 5.0))
    assert swept(path[1])[4] == pytest.approx(15 + 5j)
    assert path[3][4] == 0.5


def test_a_chain_that_is_met_at_its_end_is_run_backwards(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        space.add_line((0, 0), (10, 0))
        space.add_lwpolyline([(20, 8, 0.25), (15, 5, 0.0), (10, 0, 0.0)], format="xyb")

    path = made(tmp_path, draw)
    assert path == [[0, 0, 10, 0, 0], [10, 0, 15, 5, -0.0], [15, 5, 20, 8, -0.25]]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("angles", "count"), [((10, 100), 1), ((10, 190), 1), ((10, 191), 2), ((300, 60), 1), ((60, 300), 2)]
)
def test_arcs_of_more_than_half_a_turn_are_two_pieces(angles: tuple[float, float], count: int, tmp_path: Path) -> None:
    path = made(tmp_path, lambda space: space.add_arc((3, 4), 2, *angles))
    assert len(path) == count
    points = np.concatenate([swept(piece) for piece in path]) - (3 + 4j)
    assert np.abs(points) == pytest.approx(np.full(len(points), 2.0))
    turns = np.unwrap(np.angle(points))
    assert (np.diff(turns) >= -1e-12).all()
    assert math.degrees(turns[-1] - turns[0]) == pytest.approx((angles[1] - angles[0]) % 360)
    assert math.degrees(turns[0]) % 360 == pytest.approx(angles[0])
    assert all(0 < piece[4] <= 1 + 1e-12 for piece in path)


def test_circles_and_closed_polylines_end_where_they_begin(tmp_path: Path) -> None:
    circle = made(tmp_path, lambda space: space.add_circle((1, 2), 3))
    assert [p[4] for p in circle] == pytest.approx([1.0, 1.0])
    assert circle[-1][2:4] == circle[0][:2] == pytest.approx([4, 2])
    corners = [(0, 0, 0.0), (5, 0, 0.2), (5, 5, 0.0), (5, 5, 0.3)]
    closed = made(tmp_path, lambda space: space.add_lwpolyline(corners, format="xyb", close=True))
    assert closed == [[0, 0, 5, 0, 0], [5, 0, 5, 5, 0.2], [5, 5, 0, 0, 0.3]]
    opened = made(tmp_path, lambda space: space.add_lwpolyline(corners[:3], format="xyb"))
    assert opened == [[0, 0, 5, 0, 0], [5, 0, 5, 5, 0.2]]


@pytest.mark.parametrize(("gap", "joined"), [(0.9e-6, True), (1.1e-6, False)])
@pytest.mark.parametrize("turned", [False, True])
def test_ends_as_near_as_a_micrometre_s_thousandth_are_one(
    gap: float, joined: bool, turned: bool, tmp_path: Path
) -> None:
    def draw(space: Modelspace) -> None:
        space.add_line((0, 0), (10, 0))
        ends = [(10, gap), (10, 9)]
        space.add_line(*(ends[::-1] if turned else ends))

    if joined:
        assert len(made(tmp_path, draw)) == 2
        return
    with pytest.raises(SceneError, match="path") as refused:
        made(tmp_path, draw)
    assert refused.value.code == "path_is_open"
    assert refused.value.numbers == {"x": 10.0, "y": 0.0, "left": 1}


def test_what_is_no_path_is_refused_by_its_key(tmp_path: Path) -> None:
    (tmp_path / "text.dxf").write_text("words", encoding="utf-8")
    for file, code in (
        (tmp_path / "none.dxf", "no_such_file"),
        (tmp_path, "no_such_file"),
        (tmp_path / "text.dxf", "no_dxf"),
    ):
        with pytest.raises(SceneError) as refused:
            read_path(file, "path")
        assert (refused.value.key, refused.value.value, refused.value.code) == ("path", str(file), code)

    def nothing(space: Modelspace) -> None:
        space.add_lwpolyline([(5, 5), (5, 5)])

    for draw, code in ((nothing, "no_path"), (lambda s: s.add_point((1, 1)), "no_path_entity"),
                       (lambda s: s.add_spline([(0, 0), (1, 1), (2, 0)]), "no_path_entity")):  # fmt: skip
        with pytest.raises(SceneError) as refused:
            made(tmp_path, draw)
        assert (refused.value.key, refused.value.code) == ("path", code)
