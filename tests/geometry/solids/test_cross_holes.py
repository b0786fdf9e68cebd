"""Holes across hubs: what they take of a wheel counted on a grid, and where they find no place."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from geometry.base.errors import OffsetError, ParameterError
from geometry.curves.curve import Real
from geometry.plane.profile import Label, circle
from geometry.solids.body import Body
from geometry.solids.bores import Bore, FlatBore, KeywayBore, PolygonBore, RoundBore
from geometry.solids.cross_holes import CrossHole, Mouth, mouth_in_bore
from geometry.solids.crossed import crossed
from geometry.solids.hub_holes import HubHoles
from geometry.solids.mass import body_moments
from geometry.solids.wheel import Hub, WheelShape, check_wheel, wheel_body, wheel_sections

UP = math.pi / 2
ROUND, FLAT, KEYED = RoundBore(5.0), FlatBore(5.0, 2.0, 1, UP), KeywayBore(6.0, 3.0, 1.0, 0.1, 1, UP)
# how far a bore is from the axis, above its middle
NEAR = {ROUND: lambda x: np.sqrt(2.5**2 - x**2), FLAT: lambda x: 0 * x + 2.0, KEYED: lambda x: 0 * x + 4.0}


def blank_of(bore: Bore, *holes: CrossHole, chamfer: float = 0.0, below: float = 0.0) -> tuple[WheelShape, Body]:
    """A disk of 20 mm, 5 mm high, with a hub of 12 mm, which stands out by 7 mm."""
    shape = WheelShape(5.0, None, Hub(12.0, below, 7.0 - below, holes), chamfer, chamfer)
    sections = wheel_sections(lambda offset, depth: circle(10 + offset - depth, Label.BODY), 10.0, HubHoles(bore))
    return shape, wheel_body(shape, sections)


def counted(hole: CrossHole, bore: Bore) -> tuple[float, Real, Real]:
    """Volume, first and second moments of a hole between bore and hub, cell by cell."""
    steps = np.linspace(-1, 1, 401)
    middles = (steps[1:] + steps[:-1]) / 2 * hole.radius
    x, z = (v.ravel() for v in np.meshgrid(middles, middles))
    inside = x**2 + z**2 < hole.radius**2
    x, z = x[inside], z[inside]
    low, high = NEAR[bore](x), np.sqrt(36 - x**2)
    y = low + (high - low) * ((np.arange(16) + 0.5) / 16)[:, None]
    weight = (high - low) / 16 * (middles[1] - middles[0]) ** 2 + 0 * y
    place = (x + 1j * y) * cmath.rect(1.0, hole.angle - UP)
    at = np.stack([place.real, place.imag, hole.height + z + 0 * y]).reshape(3, -1)
    mass = weight.ravel()
    return float(mass.sum()), at @ mass, (at * mass) @ at.T


@pytest.mark.parametrize(("bore", "angle"), [(ROUND, 0.3), (ROUND, -2.0), (FLAT, UP), (KEYED, UP)])
@pytest.mark.parametrize("chamfer", [0.0, 0.4])
def test_a_hole_takes_what_a_grid_counts(bore: Bore, angle: float, chamfer: float) -> None:
    hole = CrossHole(8.2, 1.2, angle)
    _, blank = blank_of(bore, hole, chamfer=chamfer)
    before, after = body_moments(blank), crossed(blank, [hole]).moments
    volume, first, second = counted(hole, bore)
    assert before.volume - after.volume == pytest.approx(volume, rel=1e-4)
    assert before.volume * before.centre - after.volume * after.centre == pytest.approx(first, rel=2e-4, abs=1e-9)
    lost = np.trace(second) * np.eye(3) - second
    assert before.inertia - after.inertia == pytest.approx(lost, rel=2e-4, abs=1e-6)


def test_two_holes_take_twice_as_much() -> None:
    one, other = (CrossHole(8.2, 1.2, angle) for angle in (0.3, 2.5))
    _, blank = blank_of(ROUND)
    lost = [body_moments(blank).volume - crossed(blank, holes).moments.volume for holes in ([one], [one, other])]
    assert lost[1] == pytest.approx(2 * lost[0], rel=1e-12)


def test_a_hole_takes_of_a_flat_what_its_edges_are_seen_under() -> None:
    assert Mouth(0, 0, 2.0, is_round=False).half_angle(1.0) == pytest.approx(math.atan2(1.0, 2.0), rel=1e-12)
    assert Mouth(0, 0, 2.0, is_round=True).half_angle(1.0) == pytest.approx(math.pi / 6, rel=1e-12)


HEXAGON = PolygonBore(6, 5.0, 0.0, UP)


@pytest.mark.parametrize(
    ("bore", "angle_deg", "away", "is_round"),
    [(ROUND, 10, 2.5, True), (FLAT, 90, 2.0, False), (FLAT, 270, 2.5, True), (KEYED, 90, 4.0, False),
     (KEYED, 200, 3.0, True), (HEXAGON, 90, 2.5, False), (HEXAGON, 150, 2.5, False)],
)  # fmt: skip
def test_holes_open_in_one_face_of_a_bore(bore: Bore, angle_deg: float, away: float, is_round: bool) -> None:
    found = mouth_in_bore(bore, CrossHole(0.0, 1.0, math.radians(angle_deg)))
    assert found is not None
    assert (found.away, found.is_round) == (pytest.approx(away, rel=1e-12), is_round)


@pytest.mark.parametrize(("bore", "angle_deg"), [(FLAT, 120), (FLAT, 45), (KEYED, 115), (HEXAGON, 100), (HEXAGON, 120)])
def test_holes_over_an_edge_of_a_bore_open_nowhere(bore: Bore, angle_deg: float) -> None:
    assert mouth_in_bore(bore, CrossHole(0.0, 1.0, math.radians(angle_deg))) is None


@pytest.mark.parametrize(
    ("bore", "below", "holes", "code"),
    [
        (None, 0.0, [CrossHole(8.5, 1.2, 0.0)], "set_screws_without_bore"),
        (ROUND, 0.0, [CrossHole(8.5, 3.3, 0.0)], "set_screws_wider_than_hub"),
        (ROUND, 0.0, [CrossHole(8.5, 2.4, 0.0)], "set_screws_wider_than_bore"),
        (FLAT, 0.0, [CrossHole(8.5, 1.6, UP)], "set_screws_wider_than_bore"),
        (FLAT, 0.0, [CrossHole(8.5, 1.2, 1.0)], "set_screw_beside_flat"),
        (ROUND, 0.0, [CrossHole(10.4, 1.2, 0.0)], "set_screws_out_of_hub"),
        (ROUND, 0.0, [CrossHole(6.2, 1.2, 0.0)], "set_screws_out_of_hub"),
        (ROUND, 7.0, [CrossHole(-0.9, 1.2, 0.0)], "set_screws_out_of_hub"),
        (ROUND, 0.0, [CrossHole(8.5, 1.2, a) for a in (0.0, 1.0)], "set_screws_meet"),
        (ROUND, 0.0, [CrossHole(8.5, 1.2, a) for a in (3.1, -2.3)], "set_screws_meet"),
    ],
)
def test_holes_without_room_are_refused(bore: Bore | None, below: float, holes: list[CrossHole], code: str) -> None:
    shape = WheelShape(5.0, None, Hub(12.0, below, 7.0 - below, tuple(holes)), 0.5, 0.5)
    with pytest.raises(ParameterError) as refused:
        check_wheel(shape, 20.0, HubHoles(bore))
    assert refused.value.code == code
    assert refused.value.name.startswith("hub.set_screws")


@pytest.mark.parametrize(("below", "height"), [(0.0, 8.5), (0.0, 10.2), (0.0, 6.3), (7.0, -1.3), (7.0, -5.2)])
def test_holes_with_room_are_not_refused(below: float, height: float) -> None:
    shape, _ = blank_of(ROUND, *(CrossHole(height, 1.2, a) for a in (0.0, 1.1)), chamfer=0.5, below=below)
    check_wheel(shape, 20.0, HubHoles(ROUND))


def test_an_offset_narrows_holes_until_it_closes_them() -> None:
    hole = CrossHole(8.5, 1.2, 0.0)
    assert hole.moved(0.1) == CrossHole(8.5, pytest.approx(1.1), 0.0)  # type: ignore[arg-type]
    with pytest.raises(OffsetError):
        hole.moved(1.2)
