"""The field of action of a worm on its wheel against what a fine net of places on the thread tells."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.field import Field
from geometry.gears.worms.hob import oversized_hob
from geometry.gears.worms.wheel import WormTeeth
from geometry.gears.worms.worm import Worm

DRIVE = WormDrive(Worm(5.0, 2, 10.0), 40)
WORM = DRIVE.worm
# radii between which the thread is there: all of it, less of its tip, less of its foot, a ring that ends off the middle
RADII = {"whole": (19.0, 30.0), "no tip": (19.0, 27.0), "no foot": (25.0, 30.0), "narrow": (19.0, 21.2)}


@cache
def field(name: str) -> Field:
    hob = oversized_hob(DRIVE, 0.2, WORM.diameter_quotient).checked()
    teeth = WormTeeth(hob, DRIVE.centre_distance, DRIVE.throat_radius, DRIVE.most_outer_diameter / 2, 30.0)
    return Field(teeth, *RADII[name])


def borders(name: str, heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Radii at the wheel's root and at its tip as the words say them: on the tooth, and on the thread."""
    one = field(name)
    side = one.teeth.side(heights)
    least, most = RADII[name]
    return np.array([min(r, most) for r in side.inner]), np.array([min(max(r, least), most) for r in side.outer])


@pytest.mark.parametrize("name", RADII)
def test_a_line_of_contact_has_its_slide_or_ends_at_the_border(name: str) -> None:
    one = field(name)
    heights = np.linspace(-15.0, 15.0, 31)
    root, tip = one.edges(heights)
    low, high = borders(name, heights)
    assert root == pytest.approx(low)
    assert tip == pytest.approx(high)
    at_root, at_tip = (one.touching(heights, r).slid for r in (root, tip))
    for slide in (-8.0, 0.0, 6.0, 14.0):
        found = one.line(heights, slide)
        slid = one.touching(heights, found).slid
        for k in range(len(heights)):
            # the contact moves from root to tip while the worm slides on
            if at_root[k] <= slide <= at_tip[k]:
                assert slid[k] == pytest.approx(slide, abs=1e-9)
                assert tip[k] - 1e-9 <= found[k] <= root[k] + 1e-9
            elif slide < at_root[k] < at_tip[k]:
                assert found[k] == root[k]
            elif at_tip[k] < slide and at_root[k] < at_tip[k]:
                assert found[k] == tip[k]


@pytest.mark.parametrize("name", RADII)
def test_the_field_is_where_the_thread_reaches_beyond_the_tip(name: str) -> None:
    one = field(name)
    spans = one.spans()
    fine = np.linspace(-15.0, 15.0, 601)
    low, high = borders(name, fine)
    there = low > high
    inside = np.zeros(len(fine), dtype=bool)
    for a, b in spans:
        inside |= (fine > a + 1e-9) & (fine < b - 1e-9)
    ends = np.array([x for span in spans for x in span])
    beside = np.abs(fine[:, None] - ends).min(axis=1) < 0.026
    assert np.array_equal(inside[~beside], there[~beside])
    # where it begins off the ends both borders are one
    for end in ends:
        if 15.0 - abs(end) > 1e-6 and not any(abs(end - x) < 1e-9 for x in one.teeth.breaks):
            root, tip = one.edges(np.array([end - 1e-7, end + 1e-7]))
            assert (root > tip).sum() == 1
    if name == "narrow":
        assert len(spans) >= 1
        assert spans[0][0] > -15.0
        assert spans[-1][1] < 15.0
    else:
        assert [spans[0][0], spans[-1][1]] == [-15.0, 15.0]
        assert sorted({x for span in spans for x in span}) == list(one.teeth.breaks)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["whole", "no tip", "no foot"])
def test_lines_go_on_between_the_heights_at_which_they_reach_a_border(name: str) -> None:
    one = field(name)
    first, last = one.slides()
    fine = np.linspace(-15.0, 15.0, 601)
    at_root, at_tip = (one.touching(fine, r).slid for r in one.edges(fine))
    assert first == pytest.approx(at_root.min(), abs=2e-3)
    assert last == pytest.approx(at_tip.max(), abs=2e-3)
    assert one.goes_on()
    slides = first + (last - first) * np.array([0.08, 0.25, 0.5, 0.75, 0.93])
    found = one.lines(slides)
    for k, slide in enumerate(slides.tolist()):
        on = (at_root <= slide) & (slide <= at_tip)
        mine = [(a, b) for number, a, b in found if number == k]
        inside = np.zeros(len(fine), dtype=bool)
        for a, b in mine:
            inside |= (fine >= a) & (fine <= b)
            for end in (a, b):
                if abs(end) < 15.0:
                    both = [float(one.touching(np.array([end]), r).slid[0]) for r in one.edges(np.array([end]))]
                    assert min(abs(slid - slide) for slid in both) < 1e-6
        assert mine
        ends = np.array([x for pair in mine for x in pair])
        beside = np.abs(fine[:, None] - ends).min(axis=1) < 0.03
        assert np.array_equal(inside[~beside], on[~beside])


def test_the_worm_is_used_as_far_as_it_is_touched() -> None:
    """Along its axis, on a net of 101 heights and radii; a conical end takes more for every mm above the foot."""
    one = field("whole")
    heights = np.linspace(-15.0, 15.0, 101)
    root, tip = one.edges(heights)
    radii = tip + (root - tip) * np.linspace(0, 1, 101)[:, None]
    along = np.abs(one.touching(heights, radii).touching.imag)
    assert one.length_used() == pytest.approx(2 * along.max(), rel=1e-6)
    slope = math.tan(math.radians(30))
    wanted = 2 * (along + slope * (radii - WORM.root_radius)).max()
    assert one.length_used(slope) == pytest.approx(wanted, rel=1e-6)
