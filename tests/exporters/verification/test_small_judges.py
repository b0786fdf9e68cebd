"""Judges at both sides of their limits, by hand: areas told, quarter turns, circles among lines."""

from __future__ import annotations

import cmath
import math
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from exporters.drawings.verify import _check_circles
from exporters.formats.read_solid import Model
from exporters.formats.readback import ReadMesh
from exporters.verification import area
from exporters.verification.board import BoardPiece
from exporters.verification.topology import areas, chains, pieces, volume_in
from parts.base.readback import ReadError
from parts.drawing.readback import ReadSheet, Taken


@pytest.mark.parametrize("turn_deg", [-90, 0, 90, 180, 270, 360, 450])
def test_a_piece_is_turned_by_what_it_says(turn_deg: int) -> None:
    piece = BoardPiece("a", "p", turn_deg, 5 - 2j)
    (moved,) = piece.moved(np.array([3 + 1j]))
    assert moved == pytest.approx((3 + 1j) * cmath.exp(1j * math.radians(turn_deg)) + 5 - 2j, abs=1e-14)
    assert piece.moved_back(np.array(moved)) == pytest.approx(3 + 1j, abs=1e-14)


def _model(monkeypatch: pytest.MonkeyPatch, measured: list[float]) -> Model:
    """A solid with bounds of 50 mm, whose area comes out as this in 1, 2, 4, 8 pieces."""
    found = dict(zip((1, 2, 4, 8), measured, strict=True))
    monkeypatch.setattr(area, "area_of", lambda model, pieces: found[pieces])
    return cast("Model", SimpleNamespace(bounds=50.0))


@pytest.mark.parametrize("side", [-1, 1])
def test_an_area_is_borne_up_to_its_rounding(monkeypatch: pytest.MonkeyPatch, side: int) -> None:
    """1e-9 of it and 1e-9 mm times the bounds: 200 mm^2 are good to 2.5e-7 mm^2."""
    model = _model(monkeypatch, [200.0] * 4)
    assert area.area_failures(model, 200 + side * 2.45e-7) == []
    assert len(area.area_failures(model, 200 + side * 2.55e-7)) == 1
    assert area.area_failures(model, None) == []


@pytest.mark.parametrize(("told", "good"), [
    (199.6999, False), (199.7001, True), (201.2999, True), (201.3001, False),
])  # fmt: skip
def test_an_area_is_borne_by_what_finer_pieces_still_change(
    monkeypatch: pytest.MonkeyPatch, told: float, good: bool
) -> None:
    """Pieces that are halved bring it by 0.8, 0.4, 0.1 to its last value: from 200.1 - 0.4 to 200.5 + 0.8."""
    model = _model(monkeypatch, [201.3, 200.5, 200.1, 200.0])
    assert (area.area_failures(model, told) == []) == good


@pytest.mark.parametrize(("radius", "found"), [(10.0, True), (10.002, False)])
def test_a_pitch_line_is_one_of_the_lines_of_its_layer(radius: float, found: bool) -> None:
    """What has no centre is a line at that height, among others; a slanting one is none."""
    sheet = ReadSheet()
    for start, end in ((0 + 4j, 9 + 4j), (0 + 10j, 9 + 10.0005j), (0 + 10j, 9 + 12j), (0 + 30j, 9 + 30j)):
        sheet.add_line("AXES", start, end)
    sheet.add_line("THIN", 0 + 10.002j, 9 + 10.002j)
    circles = [SimpleNamespace(layer="AXES", radius=radius, centre=None)]
    taken = Taken(1e-3)
    _check_circles(sheet, cast("Any", SimpleNamespace(circles=circles)), taken)
    assert len(taken.failures) == (not found)
    assert taken.measured == {"circles": 1, "circle_deviation": pytest.approx(5e-4 if found else 2e-3)}


def test_a_corner_of_a_block_has_its_areas_and_volume() -> None:
    """Three edges of 2, 3 and 4 mm that stand across each other."""
    corners = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]])
    mesh = ReadMesh(corners, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    assert areas(mesh) == pytest.approx([3.0, 4.0, 6.0, math.sqrt(61.0)])
    assert volume_in(mesh) == pytest.approx(4.0)


def test_pieces_are_those_that_hang_together_however_they_are_numbered() -> None:
    """Two strips of a hundred triangles and a single one, in any order; the ends of a strip meet in no corner."""
    shuffled = np.random.default_rng(1).permutation(210)
    strips = [start + np.arange(100)[:, None] + np.arange(3) for start in (0, 102)]
    order = np.random.default_rng(2).permutation(201)
    own = np.repeat([0, 1, 2], [100, 100, 1])[order]
    found = pieces(shuffled[np.concatenate([*strips, [[204, 205, 206]]])[order]])
    assert len({*zip(own.tolist(), found.tolist(), strict=True)}) == len(set(found.tolist())) == 3


def test_outlines_that_meet_in_a_point_are_no_chains() -> None:
    """Two triangles on one level have a corner in common, from which an edge of either starts."""
    apart, meeting = np.array([[0, 1, 2], [3, 4, 5]]), np.array([[0, 1, 2], [0, 3, 4]])
    assert sorted(map(sorted, chains(apart, np.zeros(6), 0.0))) == [[0, 1, 2], [3, 4, 5]]
    with pytest.raises(ReadError, match="touches itself"):
        chains(meeting, np.zeros(5), 0.0)
