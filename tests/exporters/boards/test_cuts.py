"""The order of cutting worked out by hand: engraved first, then what lies deepest, then by the shortest way."""

from __future__ import annotations

import numpy as np
import pytest

from exporters.boards import cuts
from exporters.boards.cuts import in_order
from geometry.plane.contour import Approximation, Contour


def outline(points: list[complex], bulges: list[float] | None = None) -> Approximation:
    contour = Contour(np.array(points, dtype=complex), np.array(bulges or [0.0] * len(points)))
    return Approximation(contour, 0.0, "exact", 0.01)


def square(x: float, y: float, side: float) -> Approximation:
    return outline([complex(x, y), complex(x + side, y), complex(x + side, y + side), complex(x, y + side)])


def circle(x: float, y: float, radius: float) -> Approximation:
    """Two half turns, from its right end on."""
    return outline([complex(x + radius, y), complex(x - radius, y)], [1.0, 1.0])


def order(rows: dict[str, tuple[str, Approximation]]) -> list[tuple[str, str]]:
    """Names and layers as they are cut."""
    layers, boundaries = in_order(rows.values())
    names = {id(boundary): name for name, (_, boundary) in rows.items()}
    return [(names[id(b)], layer) for layer, b in zip(layers, boundaries, strict=True)]


def test_what_lies_within_is_cut_before_and_among_inner_contours() -> None:
    """A frame, in its hole a plate with a hole of its own; a plate beside the frame, and names on both."""
    rows = {
        "frame": ("CUT_OUTER", square(0, 0, 100)), "beside": ("CUT_OUTER", square(110, 0, 40)),
        "hole": ("CUT_INNER", square(10, 10, 80)), "plate": ("CUT_OUTER", square(20, 20, 60)),
        "bore": ("CUT_INNER", circle(50, 50, 8)), "mark": ("ENGRAVE", square(120, 10, 5)),
        "name": ("ENGRAVE", square(22, 22, 5)),
    }  # fmt: skip
    wanted = [
        # from the corner of the board the nearer name first
        ("name", "ENGRAVE"), ("mark", "ENGRAVE"),
        ("bore", "CUT_INNER"), ("plate", "CUT_INNER"), ("hole", "CUT_INNER"),
        # from where the last contour began, 10, 10
        ("frame", "CUT_OUTER"), ("beside", "CUT_OUTER"),
    ]  # fmt: skip
    assert order(rows) == wanted
    assert order(dict(reversed(rows.items()))) == wanted


def test_of_one_depth_the_nearest_is_next() -> None:
    """Three plates in a row, each with a bore; from the last bore back along the row."""
    rows = {f"plate {k}": ("CUT_OUTER", square(50 * k, 0, 40)) for k in range(3)}
    rows |= {f"bore {k}": ("CUT_INNER", circle(50 * k + 20, 20, 5)) for k in (2, 0, 1)}
    assert [name for name, _ in order(rows)] == [
        "bore 0", "bore 1", "bore 2", "plate 2", "plate 1", "plate 0"
    ]  # fmt: skip


@pytest.mark.parametrize(("outer", "inside"), [
    # within the box of an L, not in it; in the foot of the L
    (outline([0j, 60, 60 + 20j, 20 + 20j, 20 + 60j, 60j]), False),
    (outline([0j, 60, 60 + 60j, 38 + 60j, 38 + 20j, 20j]), True),
    # in the belly of a half turn, past its chord; over the chord of one that bulges inwards
    (outline([60j + 30, 30], [1.0, 0.0]), False), (outline([30, 60j + 30], [1.0, 0.0]), True),
    # three quarters of a turn, beyond its ends
    (outline([20 + 10j, 20 + 50j], [2.0, 0.0]), True),
    # its side in line with that of the square: not within it
    (outline([0j, 45, 45 + 60j, 60j]), False), (outline([0j, 45.1, 45.1 + 60j, 60j]), True),
    (outline([41j, 60 + 41j, 60 + 60j, 60j]), False), (outline([39.9j, 60 + 39.9j, 60 + 60j, 60j]), True),
])  # fmt: skip
def test_what_lies_in_what_goes_by_outlines_with_their_arcs(outer: Approximation, inside: bool) -> None:
    """A square between 40 and 45 mm both ways."""
    found = order({"outer": ("CUT_OUTER", outer), "own": ("CUT_OUTER", square(40, 40, 5))})
    assert ("own", "CUT_INNER" if inside else "CUT_OUTER") in found
    assert ("outer", "CUT_OUTER") in found


@pytest.mark.parametrize("turn", [1, 1j, -1, -1j])
def test_what_lies_in_the_bulge_of_an_arc_lies_within(turn: complex) -> None:
    """A square of 40 mm whose right side is half a circle, with a bore in it that no corner reaches round."""
    plate = outline([turn * p for p in (0, 40, 40 + 40j, 40j)], [0.0, 1.0, 0.0, 0.0])
    at = turn * (50 + 20j)
    rows = {"plate": ("CUT_INNER", plate), "bore": ("CUT_INNER", circle(at.real, at.imag, 4))}
    assert [name for name, _ in order(rows)] == ["bore", "plate"]


def test_only_what_holds_others_becomes_a_polygon(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before, every contour of a board did: 285 of each board of lesson_2, most of them holes that hold nothing."""
    made: list[Contour] = []
    monkeypatch.setattr(cuts, "_polygon", lambda ring, own=cuts._polygon: made.append(ring) or own(ring))
    rows = [("CUT_OUTER", square(0, 0, 100)), *(("CUT_INNER", circle(10 + 15 * k, 50, 5)) for k in range(5))]
    in_order(rows)
    assert len(made) == 1
