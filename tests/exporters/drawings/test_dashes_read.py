"""Dashes of splines read back: one goes on with the last where it starts a gap further on the same way."""

from __future__ import annotations

import cmath
from typing import Any, cast

import numpy as np
import pytest

from exporters.drawings.dashes import LONGEST
from exporters.drawings.read import _add_spline
from parts.base.readback import ReadError
from parts.drawing.canvas import STYLES
from parts.drawing.readback import ReadSheet

LAYER = "TOOTH_START"
DASH, GAP = STYLES[LAYER].dashes[:2]


def _pieces(gap: complex, step: float, *, after_another: bool = True, dash: bool = True) -> list[Any]:
    """Dashes of two steps along x, the second one from ``gap`` beyond the end of the first."""
    first = np.array([0, step, 2 * step], dtype=complex)
    sheet = ReadSheet()
    sheet.samples.append((LAYER, first))
    curve = cast("Any", type("Curve", (), {"layer": LAYER, "dash": dash}))
    _add_spline(sheet, curve, first[-1] + gap + first, after_another=after_another)
    assert {layer for layer, _ in sheet.samples} == {LAYER}
    return [points for _, points in sheet.samples]


@pytest.mark.parametrize("step", [0.002, 0.4 * DASH])
@pytest.mark.parametrize(("gap", "joined"), [
    (GAP, True), (GAP * 1.009, True), (GAP * 1.011, False), (GAP * 0.51, True), (GAP * 0.49, False), (-GAP, False),
    (GAP * cmath.exp(1.04j), True), (GAP * cmath.exp(-1.04j), True), (GAP * cmath.exp(1.055j), False),
])  # fmt: skip
def test_a_dash_goes_on_from_half_a_gap_to_one_and_within_60_degrees(gap: complex, joined: bool, step: float) -> None:
    pieces = _pieces(gap, step)
    assert len(pieces) == (1 if joined else 2)
    assert np.concatenate(pieces) == pytest.approx(np.array([0, 1, 2, 2, 3, 4]) * step + np.repeat([0, gap], 3))


def test_a_dash_after_something_else_begins_a_curve() -> None:
    assert len(_pieces(GAP + 0j, 0.1, after_another=False)) == 2


def test_what_is_no_dash_of_its_layer_is_refused() -> None:
    longest = LONGEST * DASH
    assert len(_pieces(GAP + 0j, longest * 0.4999)) == 1
    for step, dash in ((longest * 0.5001, True), (0.1, False)):
        with pytest.raises(ReadError, match="drawn otherwise than in its dashes"):
            _pieces(GAP + 0j, step, dash=dash)
