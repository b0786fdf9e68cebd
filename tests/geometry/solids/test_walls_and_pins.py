"""Walls between holes on both sides of a refusal; plates and rings with pins by plain geometry; engraved letters."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from geometry.base.errors import GeometryError, OffsetError, ParameterError
from geometry.plane.letters import lettered, unknown_letters
from geometry.plane.measure import profile_area
from geometry.solids.bores import PolygonBore, RoundBore
from geometry.solids.hub_holes import HubHoles, least_wall
from geometry.solids.mass import body_moments
from geometry.solids.pin_plates import PinPlate
from geometry.solids.pin_ring import PinRing
from geometry.solids.windows import RoundHoles, Spokes

ROOT = 40.0
LEAST = least_wall(ROOT)
BORE = RoundBore(20.0)
HEXAGON = PolygonBore(6, 18.0)
# of each wall a wheel that has it, by its thickness, and the code and the key of the refusal
WALLS: dict[str, tuple[Callable[[float], HubHoles], str, str]] = {
    "rim beyond holes": (
        lambda wall: HubHoles(None, (RoundHoles(5, 6.0, 2 * (ROOT - wall) - 6.0),)),
        "holes_reach_root_circle", "holes.pitch_circle_diameter"),
    "rim beyond windows": (
        lambda wall: HubHoles(None, (), Spokes(5, 30.0, 2 * (ROOT - wall), 8.0)),
        "windows_reach_root_circle", "spokes.outer_diameter"),
    "rim beyond a hexagon": (
        lambda wall: HubHoles(PolygonBore(6, 2 * (ROOT - wall) * math.cos(math.pi / 6))),
        "bore_reaches_root_circle", "bore.across_flats"),
    "between neighbours": (
        lambda wall: HubHoles(None, (RoundHoles(5, 50.0 * math.sin(math.pi / 5) - wall, 50.0),)),
        "holes_touch_each_other", "holes.diameter"),
    "between bore and holes": (
        lambda wall: HubHoles(BORE, (RoundHoles(3, 6.0, 20.0 + 6.0 + 2 * wall),)),
        "holes_touch_bore", "holes.diameter"),
    "between a flat and a hole": (
        lambda wall: HubHoles(HEXAGON, (RoundHoles(1, 4.0, 18.0 + 4.0 + 2 * wall, 0.0),)),
        "holes_touch_bore", "holes.diameter"),
    "between two groups": (
        lambda wall: HubHoles(None, (RoundHoles(4, 5.0, 30.0), RoundHoles(4, 3.0, 30.0 + 2 * (4.0 + wall)))),
        "holes_touch_another_group", "holes[2].diameter"),
    "spoke": (lambda wall: HubHoles(None, (), Spokes(5, 30.0, 60.0, wall)), "leaves_no_spoke", "spokes.width"),
    "between windows and bore": (
        lambda wall: HubHoles(BORE, (), Spokes(5, 20.0 + 2 * wall, 60.0, 4.0)),
        "windows_touch_bore", "spokes.inner_diameter"),
    "between a window and a hole in its spoke": (
        lambda wall: HubHoles(None, (RoundHoles(5, 6.0, 45.0),), Spokes(5, 30.0, 60.0, 6.0 + 2 * wall)),
        "holes_touch_window", "holes.diameter"),
}  # fmt: skip


@pytest.mark.parametrize("name", WALLS)
def test_a_wall_is_refused_below_the_least_one_alone(name: str) -> None:
    make, code, key = WALLS[name]
    try:
        make(LEAST * (1 + 1e-3)).check(ROOT)
        blamed = key
    except ParameterError as refusal:
        pytest.fail(f"{refusal.code} of {refusal.name}")
    for thickness, told in ((LEAST * (1 - 1e-3), f"{code}_nearly"), (-0.5, code)):
        if name == "spoke" and thickness < 0:
            continue
        with pytest.raises(ParameterError) as refused:
            make(thickness).check(ROOT)
        assert refused.value.code == told
        assert refused.value.name == blamed
    assert make(LEAST * (1 + 1e-3)).fits(ROOT)
    assert not make(LEAST * (1 - 1e-3)).fits(ROOT)


def test_a_round_bore_may_leave_as_thin_a_rim_as_it_likes() -> None:
    HubHoles(RoundBore(2 * ROOT - 1e-6)).check(ROOT)
    with pytest.raises(ParameterError, match="bore_reaches_root_circle"):
        HubHoles(RoundBore(2 * ROOT)).check(ROOT)


def test_the_least_wall_is_small_on_small_wheels() -> None:
    assert least_wall(1e-3) < least_wall(1.0) <= least_wall(1e3) == least_wall(1e4)
    assert least_wall(2e-3) == pytest.approx(2 * least_wall(1e-3))


def test_what_a_wheel_tells_of_its_holes() -> None:
    hub = HubHoles(BORE, (RoundHoles(3, 6.0, 40.0), RoundHoles(4, 2.0, 60.0)), Spokes(5, 24.0, 66.0, 8.0))
    assert (hub.number, hub.reach, hub.bore_reach) == (1 + 3 + 4 + 5, 33.0, 10.0)
    assert hub.beside_bore() == (12.0, 33.0)
    assert HubHoles(BORE, (RoundHoles(3, 6.0, 40.0),)).beside_bore() == (17.0, 23.0)
    assert HubHoles().beside_bore() == (math.inf, 0.0)
    assert (HubHoles().number, HubHoles().reach) == (0, 0.0)


@pytest.mark.parametrize("offset", [0.4, -0.4, 1.3])
def test_windows_have_the_area_that_their_four_sides_leave(offset: float) -> None:
    """Sharp windows a sector less the halves of two spokes; a rounded corner takes about (4 - pi) / 4 r^2."""
    spokes = Spokes(5, 30.0, 66.0, 8.0, 0.0, 0.3)
    inner, outer, half = 15.0 + offset, 33.0 - offset, 4.0 + offset

    def beside(radius: float) -> float:
        # area of the strip of a spoke's half width within a radius, of one side
        return (half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)) / 2

    exact = math.pi / 5 * (outer**2 - inner**2) - 2 * (beside(outer) - beside(inner))
    found = spokes.profiles(offset)
    assert len(found) == 5
    # sharp corners of a hole that grows are rounded
    lost = exact + np.array([profile_area(p) for p in found])
    assert lost == pytest.approx([(4 - math.pi) * min(offset, 0.0) ** 2] * 5, rel=0.2, abs=1e-9)
    rounded = Spokes(5, 30.0, 66.0, 8.0, 2.0, 0.3).profiles(offset)[0]
    radius = max(2.0 - offset, 0.0)
    # two corners are wider than a right angle, two narrower
    assert exact + profile_area(rounded) == pytest.approx((4 - math.pi) * radius**2, rel=0.2)
    # the first window stands between the first two spokes, symmetrically
    points = np.array([complex(s.curve.point(0.0)) for s in found[0].period])
    beside_ = np.sort(np.angle(points * np.exp(-1j * (0.3 + math.pi / 5))))
    assert beside_ == pytest.approx(-beside_[::-1], abs=1e-9)


SPOKES: dict[str, tuple[str, float, str]] = {
    "width": ("width", 2 * 15.0 * math.sin(math.pi / 3), "spokes_fill_hub_ring"),
    "corner in its ring": ("corner_radius", (66.0 - 30.0) / 4, "no_room_in_window"),
}


@pytest.mark.parametrize("name", SPOKES)
def test_spokes_are_refused_from_a_limit_on(name: str) -> None:
    key, limit, code = SPOKES[name]
    keys = {"count": 3, "inner_diameter": 30.0, "outer_diameter": 66.0, "width": 1.0, "corner_radius": 0.0}
    Spokes(**keys | {key: limit * (1 - 1e-3)}).check("spokes")
    with pytest.raises(ParameterError, match=code):
        Spokes(**keys | {key: limit * (1 + 1e-3)}).check("spokes")


def test_a_corner_has_room_beside_its_spoke() -> None:
    """w / 2 + r reaches (R_i + r) sin(pi / n)."""
    sine = math.sin(math.pi / 5)
    limit = (15.0 * sine - 6.0) / (1 - sine)
    assert limit < (90.0 - 30.0) / 4
    Spokes(5, 30.0, 90.0, 12.0, limit * (1 - 1e-3)).check("spokes")
    with pytest.raises(ParameterError, match=r"spokes.corner_radius = .*: no_room_in_window"):
        Spokes(5, 30.0, 90.0, 12.0, limit * (1 + 1e-3)).check("spokes")
    Spokes(5, 65.999, 66.0, 8.0).check("spokes")
    with pytest.raises(ParameterError, match="reaches_outer_diameter"):
        Spokes(5, 66.0, 66.0, 8.0).check("spokes")


def test_windows_close_where_the_sides_of_two_spokes_meet() -> None:
    """w / 2 + d = (R_i + d) sin(pi / n), or half of the ring; and spokes vanish at half of their width."""
    sine = math.sin(math.pi / 5)
    for spokes, limit in ((Spokes(5, 30.0, 90.0, 12.0), (15.0 * sine - 6.0) / (1 - sine)),
                          (Spokes(5, 60.0, 66.0, 8.0), 1.5), (Spokes(2, 10.0, 30.0, 4.0), 5.0)):  # fmt: skip
        with pytest.raises(OffsetError) as refused:
            spokes.profiles(limit * (1 + 1e-3))
        assert refused.value.nearest_offset == pytest.approx(limit, rel=2e-6)
        assert refused.value.nearest_offset < limit
        spokes.profiles(limit * (1 - 1e-3))
    for spokes, limit in ((Spokes(5, 30.0, 66.0, 8.0), -4.0), (Spokes(5, 10.0, 66.0, 4.0), -2.0)):
        spokes.profiles(limit * (1 - 1e-3))
        with pytest.raises(OffsetError) as refused:
            spokes.profiles(limit * (1 + 1e-3))
        assert refused.value.nearest_offset == pytest.approx(limit, rel=2e-6)


def test_wider_holes_are_wider_on_all_sides() -> None:
    hub = HubHoles(BORE, (RoundHoles(3, 6.0, 50.0, 0.1),), Spokes(5, 26.0, 70.0, 14.0, 2.0))
    wider = HubHoles(BORE, (RoundHoles(3, 6.0, 50.0, 0.1),)).widened(0.5)
    for sharp, moved in zip(wider.profiles(), HubHoles(BORE, hub.round_holes).profiles(-0.5), strict=True):
        assert profile_area(sharp) == pytest.approx(profile_area(moved), rel=1e-12)
    windows = hub.spokes
    assert windows is not None
    assert profile_area(windows.widened(0.5).profiles()[0]) == pytest.approx(profile_area(windows.profiles(-0.5)[0]))
    between = 50.0 * math.sin(math.pi / 30) - 3.0
    thin = HubHoles(None, (RoundHoles(30, 3.0, 50.0),))
    thin.widened(between / 2 * (1 - 1e-3))
    with pytest.raises(OffsetError, match="no_wall_between_holes"):
        thin.widened(between / 2 * (1 + 1e-3))


PINS = RoundHoles(6, 6.0, 56.0, 0.2)


@pytest.mark.parametrize("offset", [0.0, 0.2, -0.2])
@pytest.mark.parametrize("between", [False, True])
def test_a_plate_with_pins_of_one_piece_holds_plates_and_pins(offset: float, between: bool) -> None:
    plate = PinPlate(PINS, 35.0, HubHoles(RoundBore(10.0)), True, 0.1, 5.0, 12.0)
    body = plate.body(offset, between=between)
    disc = math.pi * ((35.0 + offset) ** 2 - (5.0 - offset) ** 2) * 5.0
    pins = 6 * math.pi * (3.0 + offset) ** 2 * 12.0
    plates = 1 + between
    found = body_moments(body)
    assert found.volume == pytest.approx(plates * disc + pins, rel=1e-12)
    height = plates * disc * (11.0 if between else 2.5) + pins * 11.0
    assert found.centre == pytest.approx([0, 0, height / found.volume], abs=1e-9)
    assert tuple(body.levels()) == ((0.0, 5.0, 17.0, 22.0) if between else (0.0, 5.0, 17.0))
    # about the axis: discs, pins about their own axes, and these round the plate's
    turning = plates * disc * ((35.0 + offset) ** 2 + (5.0 - offset) ** 2) / 2
    turning += pins * ((3.0 + offset) ** 2 / 2 + 28.0**2)
    assert found.inertia[2, 2] == pytest.approx(turning, rel=1e-12)


def test_a_plate_with_seats_is_one_plate() -> None:
    plate = PinPlate(PINS, 35.0, HubHoles(RoundBore(10.0)), False, 0.1, 5.0, 12.0)
    found = body_moments(plate.body(0.0))
    assert found.volume == pytest.approx(math.pi * (35.0**2 - 5.0**2 - 6 * 3.1**2) * 5.0, rel=1e-12)
    assert (plate.seats.diameter, plate.takes_loose_pins, plate.pin_radius) == (6.2, True, 3.0)
    assert plate.pin_centres() == pytest.approx([28 * np.exp(1j * (0.2 + k * math.pi / 3)) for k in range(6)])


@pytest.mark.parametrize(("solid", "reach"), [(True, 31.0), (False, 31.1)])
def test_a_plate_without_a_rim_is_refused(solid: bool, reach: float) -> None:
    """Holes of pins of one piece are of their size, those of loose ones of their seats'."""
    plate = PinPlate(PINS, 35.0, HubHoles(RoundBore(10.0)), solid, 0.1, 5.0, 12.0)
    limit = -(35.0 - reach) / 2
    plate.region(limit * (1 - 1e-3), seats=not solid)
    with pytest.raises(OffsetError, match="leaves_no_rim"):
        plate.region(limit * (1 + 1e-3), seats=not solid)


def test_pins_vanish_or_touch() -> None:
    plate = PinPlate(PINS, 35.0, HubHoles(RoundBore(10.0)), True)
    between = 56.0 * math.sin(math.pi / 6) - 6.0
    for limit in (-3.0, between / 2):
        assert len(plate.pin_profiles(limit * (1 - 1e-3))) == 6
        with pytest.raises(OffsetError, match="leaves_no_pins"):
            plate.pin_profiles(limit * (1 + 1e-3))
    (area, *_) = (profile_area(p) for p in plate.pin_profiles(0.25))
    assert area == pytest.approx(math.pi * 3.25**2)


def ring(pins: str, inner: float = 64.0, seat: float = 4.1) -> PinRing:
    return PinRing(12, 40.0, 4.0, seat, inner / 2, 50.0, pins, HubHoles(None, (RoundHoles(6, 2.0, 95.0, 0.1),)))


def lens(r: float, s: float, distance: float) -> float:
    """What two circles have in common."""
    a, b = (math.acos((distance**2 + p * p - q * q) / (2 * distance * p)) for p, q in ((r, s), (s, r)))
    return r * r * (a - math.sin(2 * a) / 2) + s * s * (b - math.sin(2 * b) / 2)


@pytest.mark.parametrize("offset", [0.0, 0.3, -0.3])
def test_rings_of_pins_have_the_area_that_circles_leave(offset: float) -> None:
    """Holes; seats that cross the bore; pins of one piece that stand into it. Corners that open have arcs."""
    outer = math.pi * ((50.0 + offset) ** 2 - 6 * (1.0 - offset) ** 2)
    bore, seat = 32.0 - offset, 4.1 - offset

    def area(made: PinRing) -> float:
        region = made.region(offset)
        return sum(map(profile_area, (region.outer, *region.holes)))

    assert area(ring("holes")) == pytest.approx(outer - math.pi * (bore**2 + 12 * seat**2), rel=1e-12)
    half = 40.0 - offset
    common = 12 * (math.pi * seat**2 - lens(half, seat, 40.0))
    # growing makes seats meet the bore anew in their convex corners
    if offset <= 0:
        exact = outer - math.pi * half**2 - common
        assert area(ring("half_round", 80.0)) == pytest.approx(exact, rel=1e-12 if offset == 0 else 1e-3)
    pin = 4.0 + offset
    if offset >= 0:
        exact = outer - math.pi * half**2 + 12 * lens(half, pin, 40.0)
        assert area(ring("fixed", 80.0)) == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize(
    ("made", "limit", "code"),
    [
        (ring("holes"), -(50.0 - 48.5) / 2, "leaves_no_rim"),
        (ring("holes", 69.0), -(40.0 - 4.1 - 34.5) / 2, "leaves_no_rim"),
        (PinRing(12, 40.0, 4.0, 4.1, 1.0, 50.0, "holes", HubHoles()), 1.0, "closes_ring"),
        (
            PinRing(29, 40.0, 4.0, 4.1, 0.0, 50.0, "holes", HubHoles()),
            4.1 - 40 * math.sin(math.pi / 29),
            "leaves_no_rim",
        ),
    ],
)
def test_a_ring_is_refused_from_a_limit_on(made: PinRing, limit: float, code: str) -> None:
    made.region(limit * (1 - 1e-3))
    with pytest.raises(OffsetError, match=code):
        made.region(limit * (1 + 1e-3))


def test_seats_are_whole_between_two_sizes_of_the_bore() -> None:
    for inner in (ring("half_round").seats.least_inner_radius(), ring("half_round").seats.greatest_inner_radius()):
        inwards = inner > 40.0
        for share, whole in ((1 + 1e-3, not inwards), (1 - 1e-3, inwards)):
            seats = ring("half_round", 2 * inner * share).seats
            assert seats.is_whole == whole
            if whole:
                assert len(seats.profile().period) > 1
    # seats as wide as half a step: the bore has to clear where neighbours meet
    wide = ring("half_round", seat=11.0).seats
    half = math.pi / 12
    assert wide.least_inner_radius() == pytest.approx(
        40 * math.cos(half) + math.sqrt(121 - (40 * math.sin(half)) ** 2), rel=1e-12)  # fmt: skip
    assert ring("half_round").seats.least_inner_radius() == pytest.approx(35.9)
    assert ring("half_round").seats.greatest_inner_radius() == pytest.approx(44.1)
    assert (ring("fixed").rim_radius, ring("holes").rim_radius) == (32.0, 44.1)


def test_letters_stand_about_the_origin_at_their_height() -> None:
    for text in ("HEX", "Д І", "z 23"):
        points = np.concatenate([np.array(s) for s in lettered((text,), 6.0)])
        assert points.real.max() == pytest.approx(-points.real.min())
        assert points.imag.max() == pytest.approx(-points.imag.min())
    tall = np.concatenate([np.array(s) for s in lettered(("HEX",), 6.0)])
    assert np.ptp(tall.imag) == pytest.approx(6.0)
    double = np.concatenate([np.array(s) for s in lettered(("HEX",), 12.0)])
    assert double == pytest.approx(2 * tall)
    # a space is 5 of 12 heights wide, and no letter touches the next one
    one, two = (lettered((text,), 12.0) for text in ("HH", "H H"))
    spans = [[(min(p.real for p in s), max(p.real for p in s)) for s in strokes] for strokes in (one, two)]
    # H is 8 wide, 3.5 between letters
    assert np.ptp([x for s in spans[0] for x in s]) == pytest.approx(8 + 3.5 + 8)
    assert np.ptp([x for s in spans[1] for x in s]) == pytest.approx(8 + 3.5 + 5 + 8)
    # lines stand 20 apart, each in the middle
    rows = lettered(("HHH", "H"), 12.0)
    upper, lower = (np.concatenate([np.array(s) for s in row]) for row in (rows[:9], rows[9:]))
    assert upper.imag.min() - lower.imag.max() == pytest.approx(20 - 12)
    assert upper.real.max() + upper.real.min() == pytest.approx(lower.real.max() + lower.real.min(), abs=1e-9)
    assert unknown_letters("Щітка №1 漢漢Ω") == "漢Ω"
    assert not unknown_letters("−–—’ ")


def test_a_round_letter_is_the_spline_of_its_points() -> None:
    """O by de Boor's rule: the middles of its hull's edges, and halfway between them a quarter of each leg inwards."""
    (ring_,) = lettered(("O",), 12.0)
    points = np.array(ring_)
    hull = np.array([4 + 12j, 0 + 12j, 0 + 6j, 0 + 0j, 4 + 0j, 8 + 0j, 8 + 6j, 8 + 12j])
    middles = (hull + np.roll(hull, -1)) / 2
    peaks = (np.roll(middles, 1) + 2 * hull + middles) / 4
    for exact in (middles, peaks):
        assert np.abs(points[:, None] - (exact - 4 - 6j)).min(axis=0).max() < 1e-9


def test_no_error_hides_another() -> None:
    """Of two refusals the one that works for both is told."""
    hub = HubHoles(RoundBore(4.0), (RoundHoles(3, 2.0, 30.0),))
    with pytest.raises(GeometryError) as refused:
        hub.profiles(3.0)
    nearest = refused.value.nearest_offset  # type: ignore[attr-defined]
    assert nearest == pytest.approx(1.0, rel=2e-6)
    hub.profiles(nearest)
