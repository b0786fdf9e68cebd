"""Names of drawings: what they hide is measured by points of lines, and where they have room they hide nothing."""

from __future__ import annotations

import numpy as np
import pytest

from parts.pages.beside import FREE, Name, beside_line, beside_point, box, hidden, settled

FIELD = (-500 - 500j, 500 + 500j)


def test_what_a_box_hides_is_what_points_of_the_lines_tell() -> None:
    random = np.random.default_rng(3)
    steps = (np.arange(20000) + 0.5) / 20000
    for _ in range(20):
        starts, ends = (random.uniform(-60, 60, (2, 5)).T @ [1, 1j] for _ in range(2))
        # two of them run along the axes
        ends[0], ends[1] = complex(starts[0].real, ends[0].imag), complex(ends[1].real, starts[1].imag)
        middle, size = complex(*random.uniform(-30, 30, 2)), complex(*random.uniform(5, 60, 2))
        spots = np.outer(1 - steps, starts) + np.outer(steps, ends) - middle
        inside = (abs(spots.real) < size.real / 2 + FREE) & (abs(spots.imag) < size.imag / 2 + FREE)
        assert hidden(starts, ends, middle, size) == pytest.approx(
            (inside.mean(axis=0) * abs(ends - starts)).sum(), abs=0.1
        )


def test_two_vectors_on_one_line_have_their_names_on_both_sides() -> None:
    start, end = 0j, 100 - 200j
    names = [beside_line(text, start, end) for text in ("pb", "pc")]
    one, other = ((at - start) / (end - start) for at in settled(names, [(start, end)], FIELD))
    assert one.real == pytest.approx(0.5)
    # y runs down: the left side is that of negative turns
    assert one.imag < 0 < other.imag


def test_a_name_leaves_its_side_where_another_line_runs() -> None:
    start, end = 0j, 200 + 0j
    (free,) = settled([beside_line("F_c", start, end)], [(start, end)], FIELD)
    assert free.real == 100
    assert free.imag + box("F_c").imag / 2 == pytest.approx(-FREE - 1)
    (moved,) = settled([beside_line("F_c", start, end)], [(start, end), (-10j, 200 - 10j)], FIELD)
    assert moved == free.conjugate()
    # nor does it go beyond its field
    (kept,) = settled([beside_line("F_c", start, end)], [(start, end)], (0j, 500 + 500j))
    assert kept == free.conjugate()


def test_a_name_makes_room_for_one_that_has_no_other_place() -> None:
    one, other = settled([Name("B", (0j, 50 + 0j)), Name("C", (0j,))], [], FIELD)
    assert (one, other) == (50, 0)


def test_a_name_on_a_line_is_better_than_one_on_another_name() -> None:
    names = [Name("B", (0j,)), Name("C", (0j, 100 + 0j))]
    assert settled(names, [(100 - 50j, 100 + 50j)], FIELD) == [0, 100]


def test_two_joints_in_one_place_have_both_names() -> None:
    names = [beside_point(text, 10 + 10j, 5.0) for text in ("B", "C")]
    one, other = settled(names, [], FIELD)
    assert one.real > 10 > one.imag
    apart = one - other
    assert abs(apart.real) > box("B").real or abs(apart.imag) > box("B").imag
    assert settled([], [], FIELD) == []
