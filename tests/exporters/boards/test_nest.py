"""Layouts held by shapely: every piece whole in the room and clear of the others, boards counted by hand."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate, scale, translate

from exporters.boards import nest as nest_module
from exporters.boards.nest import HALVES, QUARTERS, DoesNotFitError, Laid, Room, lacking, largest_scale, nest

Shapes = dict[str, tuple[shapely.Geometry, int]]
TILE = shapely.box(0, 0, 20, 10)


def checked(shapes: Shapes, room: Room) -> list[list[tuple[Laid, shapely.Geometry]]]:
    """What lies on each board, after all that a layout has to keep."""
    laid = nest(shapes, room)
    assert Counter(one.shape for one in laid) == {name: count for name, (_, count) in shapes.items()}
    assert {one.turn for one in laid} <= {*room.turns}
    assert [one.board for one in laid] == sorted(one.board for one in laid)
    boards: list[list[tuple[Laid, shapely.Geometry]]] = [[] for _ in {one.board for one in laid}]
    for one in laid:
        turned = rotate(shapes[one.shape][0], 90 * one.turn, origin=(0, 0))
        boards[one.board].append((one, translate(turned, one.at.real, one.at.imag)))
    inner = shapely.box(room.margin, room.margin, room.width - room.margin, room.height - room.margin).buffer(1e-9)
    for pieces in boards:
        assert all(inner.covers(piece) for _, piece in pieces)
        for k, (_, piece) in enumerate(pieces):
            assert all(piece.distance(other) >= room.gap - 1e-9 for _, other in pieces[:k])
    return boards


def test_along_the_grain_tiles_stand_in_rows() -> None:
    """Four columns of three in a room of 88 x 36 mm, which they fill to 2 mm each way; the next one on a new board."""
    made = checked({"tile": (TILE, 13)}, Room(88 + 8, 36 + 8, 4, 2, HALVES))
    assert [len(pieces) for pieces in made] == [12, 1]
    # the last board alone is pushed into its corner
    low = shapely.union_all([piece for _, piece in made[-1]]).bounds
    assert low[:2] == pytest.approx((4, 4), abs=2e-3)


def test_boards_that_are_full_alike_are_repeated() -> None:
    """Six a board: of 100 sixteen full ones and four on the last, more than are laid one by one."""
    made = checked({"tile": (TILE, 100)}, Room(66 + 4, 23 + 4, 2, 2, HALVES))
    assert [len(pieces) for pieces in made] == [6] * 16 + [4]
    places = [{(one.turn, one.at) for one, _ in pieces} for pieces in made]
    assert all(own == places[0] for own in places[1:8])


def test_repeated_boards_leave_what_they_do_not_hold() -> None:
    """Two kinds, whose boards cannot all be alike: none is lost or made up, on few boards more than full ones."""
    shapes: Shapes = {"tile": (TILE, 61), "long": (shapely.box(-20, -5, 20, 5), 30)}
    made = checked(shapes, Room(66 + 4, 23 + 4, 2, 2, HALVES))
    # by area with their gaps: a tile takes 22 x 12, a long one 42 x 12, of 68 x 25
    assert 17 <= len(made) <= 26


def test_small_ones_lie_in_holes_where_they_have_room() -> None:
    """Rings with a hole of 64 mm: a disc of 58 goes in with its gaps, one of 62 does not; copies stand elsewhere."""
    ring = shapely.Point(0, 0).buffer(40, 8).difference(shapely.Point(0, 0).buffer(32))
    room = Room(84, 84, 1, 2)
    for radius, boards in ((29.0, 2), (31.0, 4)):
        disc = shapely.Point(100, -50).buffer(radius, 8)
        made = checked({"ring": (ring, 2), "disc": (disc, 1), "copy": (translate(disc, 7, -3), 1)}, room)
        assert len(made) == boards
        assert sorted(one.shape for pieces in made for one, _ in pieces if one.shape != "ring") == ["copy", "disc"]


def test_pieces_are_turned_where_that_saves_room() -> None:
    """An L and its hook through a quarter turn; against the grain alone it lies in a narrow room."""
    hook = shapely.union(shapely.box(3, 1, 33, 7), shapely.box(3, 1, 9, 21))
    made = checked({"hook": (hook, 4)}, Room(60, 60, 2, 1))
    assert len(made) == 1
    assert len({one.turn for one, _ in made[0]}) > 1
    for turns, wide in ((QUARTERS, True), (HALVES, False)):
        room = Room(24, 40, 1, 1, turns)
        if wide:
            ((piece,),) = checked({"hook": (hook, 1)}, room)
            assert piece[0].turn % 2 == 1
        else:
            with pytest.raises(DoesNotFitError):
                nest({"hook": (hook, 1)}, room)


def test_what_is_larger_than_the_room_is_named_with_its_box() -> None:
    room = Room(96, 46, 3, 2, HALVES)
    for wide, high in ((90.001, 40.0), (90.0, 40.001)):
        with pytest.raises(DoesNotFitError) as refused:
            nest({"fits": (TILE, 1), "large": (shapely.box(-7, 3, wide - 7, high + 3), 1)}, room)
        assert (refused.value.shape, refused.value.size) == ("large", pytest.approx((wide, high), abs=1e-9))


@pytest.mark.parametrize(("sides", "turns", "scale"), [
    # of a room of 90 x 40 mm within its margins
    ((30.0, 10.0), QUARTERS, 3.0), ((30.0, 10.0), HALVES, 3.0), ((10.0, 30.0), QUARTERS, 3.0),
    ((10.0, 30.0), HALVES, 4 / 3), ((45.0, 40.0), QUARTERS, 1.0), ((45.0, 45.0), QUARTERS, 40 / 45),
])  # fmt: skip
def test_the_largest_scale_fills_the_room_one_way(
    sides: tuple[float, float], turns: tuple[int, ...], scale: float
) -> None:
    shape = shapely.box(-4, 9, sides[0] - 4, sides[1] + 9)
    assert largest_scale(shape, Room(100, 50, 5, 2, turns)) == pytest.approx(scale, rel=1e-12)


@pytest.mark.parametrize(("room", "turn"), [(Room(220, 60, 5, 2), 1), (Room(60, 220, 5, 2), 0)])
def test_what_is_all_but_round_is_turned_where_its_chords_leave_no_room_otherwise(room: Room, turn: int) -> None:
    """A box of 49.9 x 50.1 mm in a room of 210 x 50 mm: across the long side in one turn alone."""
    egg = scale(shapely.Point(3, 4).buffer(1, quad_segs=64), 24.95, 25.05)
    assert largest_scale(egg, room) >= 1
    (laid,) = nest({"egg": (egg, 1)}, room)
    assert laid.turn % 2 == turn


@pytest.mark.parametrize(("box", "room", "side"), [
    # a room of 90 x 40 mm: 95 x 30 lacks width; 30 x 45 stands in it if it lies; 45 x 42 lacks 2 mm of height
    ((95.0, 30.0), Room(100, 50, 5, 2), "width"), ((30.0, 95.0), Room(100, 50, 5, 2), "width"),
    ((45.0, 42.0), Room(100, 50, 5, 2), "height"), ((30.0, 45.0), Room(100, 50, 5, 2, HALVES), "height"),
    ((95.0, 30.0), Room(50, 100, 5, 2), "height"),
    # turned, 55 mm of height do; no side alone
    ((95.0, 42.0), Room(100, 50, 5, 2), "height"), ((95.0, 92.0), Room(100, 50, 5, 2), "width"),
])  # fmt: skip
def test_the_side_that_lacks_least_is_named(box: tuple[float, float], room: Room, side: str) -> None:
    assert lacking(room, *box) == side


@pytest.mark.parametrize("pairs", [0, 1e9])
def test_tables_hold_every_sum_of_two_cells(monkeypatch: pytest.MonkeyPatch, pairs: float) -> None:
    """By a transform and by runs: of covers full of holes, against all pairs of their cells."""
    monkeypatch.setattr(nest_module, "_PAIRS", pairs)
    chance = np.random.default_rng(7)
    for share in (0.01, 0.3, 0.97):
        first, second = chance.random((9, 23)) < share, chance.random((14, 6)) < share
        wanted = np.zeros((22, 28), dtype=bool)
        for x, y in np.argwhere(first):
            wanted[x : x + 14, y : y + 6] |= second
        assert (nest_module._sums(first, second) == wanted).all()
