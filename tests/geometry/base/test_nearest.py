"""The nearest value that works: at the boundary, on the side that works, in a counted number of trials."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import GeometryError, LateError, Nearest, ParameterError, limit, rounded
from geometry.base.nearest import MOST_TRIALS, Suspect, blamed, nearest
from tests.sampling import examples

SIZES = st.floats(min_value=1e-3, max_value=1e4)


class Counted:
    """Whether a value holds, and how often that was asked; at the first wrong one it raises, later it says no."""

    def __init__(self, edge: float, *, below: bool) -> None:
        self.edge, self.below, self.asked = edge, below, 0

    def __call__(self, value: float) -> bool:
        self.asked += 1
        good = value <= self.edge if self.below else value >= self.edge
        if not good and self.asked % 2:
            raise GeometryError
        return good


@examples(100)
@given(edge=SIZES, share=st.floats(min_value=0.01, max_value=50), below=st.booleans())
def test_it_ends_at_the_boundary_on_the_side_that_holds(edge: float, share: float, below: bool) -> None:
    asked = Counted(edge, below=below)
    wrong = edge * (1 + share) if below else edge / (1 + share)
    found = nearest(asked, wrong, 0.0 if below else edge * 7)
    assert found is not None
    assert asked.asked <= MOST_TRIALS
    assert isinstance(found.value, float)
    assert (found.value <= edge) is below or found.value == edge
    assert found.side == ("at_most" if below else "at_least")
    # one step further does not hold: one in the last place that is told
    assert abs(found.value - edge) <= max(1e-4, 2e-3 * edge)
    further = found.value + (1 if below else -1) * max(2e-4, 2e-3 * edge)
    assert further > edge if below else further < edge


@pytest.mark.parametrize("ends", [(21.0, 18.9, 0.42, 19.1), (19.1,), (0.0, 20.0), (41.0, 21.0, 5.0, 20.0)])
def test_ends_that_failed_beyond_one_that_holds_are_no_limit(ends: tuple[float, ...]) -> None:
    """Before: 19.0001 as the most, of what holds from 19 to 20.94."""
    assert nearest(lambda value: 19.0 <= value <= 20.94, 40.0, ends) == Nearest(20.94, "at_most")
    lower = [40.0 - end for end in ends]
    assert nearest(lambda value: 19.06 <= value <= 21.0, 0.0, lower) == Nearest(19.06, "at_least")


@given(edge=st.integers(4, 10_000), more=st.integers(1, 5_000))
def test_whole_numbers_stay_whole(edge: int, more: int) -> None:
    asked = Counted(edge, below=True)
    assert nearest(asked, edge + more, 1) == Nearest(edge, "at_most")
    assert asked.asked <= MOST_TRIALS
    upwards = Counted(edge, below=False)
    assert nearest(upwards, max(1, edge - more), 20_000) == Nearest(edge, "at_least")


@examples(100)
@given(edge=st.floats(1.0, 99.0), wishes=st.tuples(*[st.floats(100.0, 1e4)] * 2), way=st.sampled_from([1.0, -1.0]))
def test_a_rough_offer_is_the_same_whatever_is_asked(edge: float, wishes: tuple[float, float], way: float) -> None:
    def offer(wish: float, **rough: float) -> float:
        found = nearest(lambda value: abs(value) <= edge, way * wish, 0.0, **rough)
        assert found is not None
        assert isinstance(found.value, float)
        return abs(found.value)

    # before: by as much as the search may end short
    assert offer(wishes[0], share=0.05) == offer(wishes[1], share=0.05)
    assert 0.94 * edge <= offer(wishes[0], share=0.05) <= edge
    assert offer(wishes[0], enough=0.5) == offer(wishes[1], enough=0.5)
    assert edge - 0.501 <= offer(wishes[0], enough=0.5) <= edge


def test_the_first_end_that_holds_is_the_goal() -> None:
    asked = Counted(30.0, below=False)
    found = nearest(asked, 2.0, (4.0, 8.0, 16.0, 32.0, 64.0))
    assert found is not None
    assert found.side == "at_least"
    assert found.value == pytest.approx(30.0, abs=2e-4)
    assert asked.asked <= MOST_TRIALS


@pytest.mark.parametrize("ends", [0.0, (3.0, 2.0, 1.0), [1.0] * 100])
def test_where_no_end_holds_there_is_nothing_to_offer(ends: float | list[float]) -> None:
    asked = Counted(-1.0, below=True)
    assert nearest(asked, 5.0, ends) is None
    assert asked.asked <= MOST_TRIALS


def test_where_rounding_decides_at_the_edge_the_one_before_is_told() -> None:
    # before: nothing was offered
    assert nearest(lambda v: v <= 1 or v == 1.03125, 2.0, 0.0, enough=0.02) is not None
    flickers = nearest(lambda v: v <= 45.9 or v in (45.9375, 45.96875), 53.37, 1.0, share=1e-3)
    assert flickers == Nearest(45.9375, "at_most")
    # neither of the last two holds as it is told
    twice = nearest(lambda v: v <= 0.348 or v in (0.349609375, 0.35009765625), 0.3722, 0.3418, share=8e-4)
    assert twice == Nearest(0.3476, "at_most")


def test_what_would_be_told_must_hold_itself() -> None:
    """A hair's breadth that no printed number meets is not offered."""
    assert nearest(lambda v: v == 1 / 3, 0.5, 1 / 3) is None


@given(value=st.floats(min_value=-1e6, max_value=1e6), digits=st.integers(2, 9))
def test_limits_are_rounded_to_their_side(value: float, digits: int) -> None:
    up, down = rounded(value, up=True, digits=digits), rounded(value, up=False, digits=digits)
    assert down <= value <= up
    assert up - down <= 1.01 * 10.0**-digits + 4e-16 * abs(value)
    assert limit(value, value + 1).side == "at_most"
    assert limit(value, value - 1).side == "at_least"


def test_a_limit_a_hair_beside_a_round_number_stays_on_its_side() -> None:
    """As it was: the product with a power of ten was rounded onto the number, and what was offered did not work."""
    assert rounded(18 + 10.1 + 2 * 0.05, up=True) == 28.2001
    assert rounded(13.899999999999999, up=False) == 13.8999


def test_a_limit_in_another_unit_keeps_its_side() -> None:
    told = limit(0.5, 0.6, digits=9).scaled(180 / math.pi)
    assert told.side == "at_most"
    assert isinstance(told.value, float)
    assert 28.6478 <= told.value <= math.degrees(0.5)
    assert Nearest("ISO 53 A").scaled(2.0) == Nearest("ISO 53 A")


def test_a_refusal_looks_for_its_cure_once_and_only_when_asked() -> None:
    asked = []

    def cure() -> Nearest:
        asked.append(1)
        return Nearest(3.0, "at_most")

    refusal = ParameterError("radius", 0.1, "too_large", cure, most=3)
    told = refusal.renamed("corner_radius").renamed("angle_deg", 180 / math.pi)
    assert asked == []
    assert refusal.nearest == Nearest(3.0, "at_most")
    assert refusal.nearest is refusal.nearest
    assert told.nearest is not None
    assert (told.name, told.code, told.numbers) == ("angle_deg", "too_large", {"most": 3})
    assert told.value == pytest.approx(math.degrees(0.1))
    assert asked == [1]


def test_whom_a_late_refusal_blames_is_sought_once_and_only_when_asked() -> None:
    sought = []

    def seek() -> ParameterError:
        sought.append(1)
        return ParameterError("tip", 2.0, "too_large", Nearest(1.0, "at_most"), most=1)

    refusal = LateError("too_large", seek)
    with pytest.raises(ParameterError) as caught:
        raise refusal
    assert refusal.code == "too_large"
    assert sought == []
    assert (caught.value.name, caught.value.value, caught.value.code) == ("tip", 2.0, "too_large")
    assert refusal.nearest == Nearest(1.0, "at_most")
    assert str(refusal.renamed("tip_angle", 2.0)) == "tip_angle = 4.0: too_large, most 1"
    assert refusal.told_of("shift", 0.5, None).numbers == {"most": 1}
    assert sought == [1]


def test_the_blamed_one_is_the_first_that_cures() -> None:
    def suspect(name: str, *, cures: bool) -> Suspect:
        return Suspect(name, 1.0, 0.0, lambda value: cures and value == 0)

    one, two = suspect("one", cures=True), suspect("two", cures=True)
    assert blamed([one, two], "two") is two
    assert blamed([one, two], "other") is one
    assert blamed([suspect("one", cures=False), two], "one") is two
    assert blamed([suspect("one", cures=False)], "one") is None
    assert blamed([Suspect("one", 0.0, 0.0, lambda value: True)], "one") is None
