"""The default sample of a sweep: seeded, of the size asked for, every value shown where that is possible."""

from __future__ import annotations

from itertools import product

import pytest

from tests.sampling import chosen, some_of

GRID = [{"a": a, "b": b, "c": c} for a, b, c in product(range(5), range(4), range(3))]


def test_as_few_cases_as_the_longest_parameter_has_show_every_value() -> None:
    found = chosen(GRID, 5, "x")
    assert len(found) == 5
    for name, count in (("a", 5), ("b", 4), ("c", 3)):
        assert {GRID[k][name] for k in found} == set(range(count))


def test_later_cases_bring_pairs_that_none_before_had() -> None:
    found = chosen(GRID, 24, "x")
    pairs = {(GRID[k]["a"], GRID[k]["b"]) for k in found}
    assert len(pairs) == 20


@pytest.mark.parametrize("count", [0, 1, 60, 100])
def test_no_more_than_asked_and_no_more_than_there_are(count: int) -> None:
    found = chosen(GRID, count, "x")
    assert len(found) == min(count, len(GRID))
    assert found == sorted(set(found))


def test_the_seed_alone_decides() -> None:
    assert chosen(GRID, 10, "x") == chosen(GRID, 10, "x")
    assert chosen(GRID, 10, "x") != chosen(GRID, 10, "y")


def test_the_other_cases_are_heavy(pytestconfig: pytest.Config, request: pytest.FixtureRequest) -> None:
    """This very session holds the sample and not the rest; with the marker expression taken away both would run."""
    if pytestconfig.option.markexpr != "not heavy":
        pytest.skip("another choice of tests")
    kept = [item for item in request.session.items if getattr(item, "originalname", "") == "test_of_the_sample"]
    if len(kept) > 1:
        assert sorted(item.callspec.params["value"] for item in kept) == [
            list(range(40))[k] for k in chosen([{"value": v} for v in range(40)], 3, "test_of_the_sample")
        ]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("value", range(40))
def test_of_the_sample(value: int) -> None:
    assert 0 <= value < 40


def test_a_loop_takes_a_few_of_its_cases_and_all_among_the_heavy_ones(pytestconfig: pytest.Config) -> None:
    found = some_of(range(40), 3)
    assert len(found) == (40 if pytestconfig.option.markexpr == "heavy" else 3)
    assert found == sorted(set(found)) == some_of(range(40), 3)
    assert some_of("ab", 3) == ["a", "b"]
