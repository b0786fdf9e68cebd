"""Pieces on a bed, by boxes whose places are known: margins, gaps and height, at both sides of what is borne."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from exporters.formats.read_assembly import Occurrence
from exporters.verification import plate
from exporters.verification.verdict import Verdict
from parts.base.texts import words

BED = SimpleNamespace(width=100.0, depth=80.0, height=30.0, margin=5.0, gap=4.0)
DECLARED = 0.01
# a box of 10 x 20 x 8 mm over its corner; one turned by a quarter reaches 20 mm to the left of it
CORNERS = np.array([[x, y, z] for x in (0.0, 10.0) for y in (0.0, 20.0) for z in (0.0, 8.0)])
FACES = CORNERS[[[0, 1, 2], [3, 4, 5], [6, 7, 0]]]
PLAIN = np.eye(3)
QUARTER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
Places = list[tuple[float, float, float]]


def judged(places: Places, turn: Any = PLAIN) -> tuple[dict[str, Any], list[str]]:
    """What is measured of boxes at these places, and what is wrong with them."""
    part = SimpleNamespace(part=SimpleNamespace(faces=lambda: FACES))
    rows = [Occurrence(f"p{k}", 0, np.column_stack([turn, at])) for k, at in enumerate(places)]
    found = cast("Any", SimpleNamespace(prototypes=[part], occurrences=rows))
    verdict = plate.on_bed(found, cast("Any", BED), DECLARED, Verdict({"before": 1.0}, ()))
    assert verdict.measured["before"] == 1.0
    return dict(verdict.measured), [words("en").say(one) for one in verdict.failures]


@pytest.mark.parametrize(("at", "margin"), [
    ((5.0, 30.0, 0.0), 5.0), ((30.0, 5.0, 0.0), 5.0), ((85.0, 30.0, 0.0), 5.0), ((30.0, 55.0, 22.0), 5.0),
    ((17.0, 20.0, 3.0), 17.0), ((40.0, 49.0, 3.0), 11.0),
])  # fmt: skip
def test_a_box_stands_on_the_bed_up_to_its_margins(at: tuple[float, float, float], margin: float) -> None:
    measured, failures = judged([at])
    assert measured == {"before": 1.0, "least_margin": pytest.approx(margin), "height": pytest.approx(at[2] + 8)}
    assert failures == []


@pytest.mark.parametrize(("at", "way"), [
    ((5.0, 30.0, 0.0), (-1, 0, 0)), ((30.0, 5.0, 0.0), (0, -1, 0)), ((85.0, 30.0, 0.0), (1, 0, 0)),
    ((30.0, 55.0, 0.0), (0, 1, 0)), ((30.0, 30.0, 0.0), (0, 0, -1)), ((30.0, 30.0, 22.0), (0, 0, 1)),
])  # fmt: skip
def test_what_leaves_the_bed_by_more_than_is_declared_is_told(
    at: tuple[float, float, float], way: tuple[int, int, int]
) -> None:
    for off, said in ((0.0099, []), (0.0101, ["p1 does not lie on the bed"])):
        x, y, z = (a + off * w for a, w in zip(at, way, strict=True))
        assert judged([(50.0, 20.0, 0.0) if at[0] != 30 else (60.0, 25.0, 0.0), (x, y, z)])[1] == said


def test_a_turned_box_stands_where_it_is_turned_to() -> None:
    """Its 20 mm lie along x, from 30 to 50; its 10 mm along y."""
    measured, failures = judged([(50.0, 63.0, 1.0)], QUARTER)
    assert (measured["least_margin"], measured["height"]) == (pytest.approx(80 - 73), pytest.approx(9.0))
    assert failures == []
    assert judged([(24.9, 30.0, 0.0)], QUARTER)[1] == ["p0 does not lie on the bed"]


@pytest.mark.parametrize("way", [(1.0, 0.0), (0.0, 1.0), (0.6, 0.8)])
def test_boxes_that_stand_too_near_are_told_with_their_gap(way: tuple[float, float]) -> None:
    """10 x 20 mm and a gap in this direction, over the corner where both ways count."""
    for gap, good in ((4.5, True), (3.9901, True), (3.9899, False), (0.5, False)):
        x = 10 + gap * way[0] if way[0] else 0.0
        y = 20 + gap * way[1] if way[1] else 0.0
        measured, failures = judged([(6.0, 6.0, 0.0), (6 + x, 6 + y, 0.0), (80.0, 50.0, 0.0)])
        assert measured["least_gap"] == pytest.approx(gap, rel=1e-9)
        told = f"p0 and p1 stand {gap:.6g} mm apart instead of 4"
        assert failures == ([] if good else [told])


def test_the_least_of_all_gaps_is_measured() -> None:
    """Of three in a row the second gap is the less; what is more than a millimetre beyond the gap is none."""
    row: Places = [(6.0, 6.0, 0.0), (20.5, 6.0, 0.0), (34.6, 6.0, 0.0)]
    measured, failures = judged(row)
    assert measured["least_gap"] == pytest.approx(4.1, rel=1e-9)
    assert judged(row[::-1])[0]["least_gap"] == pytest.approx(4.1, rel=1e-9)
    assert failures == []
    assert "least_gap" not in judged([(6.0, 6.0, 0.0), (21.1, 6.0, 0.0)])[0]
    assert judged([(6.0, 6.0, 0.0), (20.9, 6.0, 0.0)])[0]["least_gap"] == pytest.approx(4.9)
