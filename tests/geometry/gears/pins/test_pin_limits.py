"""Both sides of every limit of cycloidal discs and lantern gears, by closed forms written anew."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from geometry.base.errors import OffsetError, ParameterError, PointedTipError
from geometry.base.record import replace
from geometry.gears.pins.cycloidal import CycloidalDisc, checked_disc, disc_findings, disc_region
from geometry.gears.pins.lantern import LanternGear, checked_lantern_gear, lantern_side, limits_of
from geometry.gears.teeth.offset import toothed_region
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles

# R = 50, N = 11: pins of 8 mm
DISC = CycloidalDisc(10, 100.0, 8.0, 1.0)
# flat lobes, whose pins may be large
FLAT = replace(DISC, eccentricity=0.05)
TOUCHING = 100.0 * math.sin(math.pi / 11)


def refused(disc: CycloidalDisc) -> ParameterError:
    with pytest.raises(ParameterError) as caught:
        checked_disc(disc)
    return caught.value


# R' = 50 - 36 in the one, rho = 4 + 20 in the other: rho is 0.98 of R' at most
LIMITS: dict[str, tuple[CycloidalDisc, str, float, str, str]] = {
    "pins touch": (FLAT, "pin_diameter", TOUCHING * (1 - 1e-6), "at_most", "pins_touch"),
    "no pin": (FLAT, "pin_clearance", -4.0 * (1 - 1e-6), "at_least", "leaves_no_pin"),
    "clearance": (FLAT, "pin_clearance", 0.98 * 50 - 4, "at_most", "leaves_no_disc"),
    "clearance and a shift": (replace(FLAT, pin_circle_shift=36.0), "pin_clearance", 0.98 * 14 - 4, "at_most", ""),
    "clearance and a shift out": (replace(FLAT, pin_circle_shift=-10.0), "pin_clearance", 0.98 * 60 - 4, "at_most",
                                  "leaves_no_disc"),
    "shift": (FLAT, "pin_circle_shift", 50 - 4 / 0.98, "at_most", "leaves_no_disc"),
    "shift and a clearance": (replace(FLAT, pin_clearance=20.0), "pin_circle_shift", 50 - 24 / 0.98, "at_most",
                              "leaves_no_disc"),
}  # fmt: skip


@pytest.mark.parametrize("name", LIMITS)
def test_pins_and_their_circle_are_refused_from_their_limit_on(name: str) -> None:
    disc, key, at, side, code = LIMITS[name]
    if not code:
        # the clearance leaves a disc without the shift, so the shift is to blame
        told = refused(replace(disc, pin_clearance=at + 0.01))
        assert (told.name, told.code) == ("pin_circle_shift", "leaves_no_disc")
        return
    away = 1e-4 if side == "at_most" else -1e-4
    told = refused(replace(disc, **{key: at + away}))
    assert (told.name, told.code) == (key, code)
    if code == "pins_touch":
        assert told.numbers == {"pins": 11, "circle": 100.0}
    assert told.nearest is not None
    assert told.nearest.side == side
    # as far as the lobes allow, which are whole with what is told and refused for themselves beyond it
    value = told.nearest.value
    assert value <= at if side == "at_most" else value == pytest.approx(at, abs=1e-6)
    checked_disc(replace(disc, **{key: value}))
    if code == "leaves_no_disc":
        # before it, the lobes are what is refused
        told = refused(replace(disc, **{key: at - away}))
        assert (told.name, told.code) == ("eccentricity", "pins_undercut_lobes")


def test_lobes_are_higher_than_a_millionth_and_rounder_than_a_hundredth() -> None:
    least = 50e-6
    checked_disc(replace(DISC, eccentricity=least * 1.0001))
    told = refused(replace(DISC, eccentricity=least * 0.9999))
    assert (told.code, told.nearest.value) == ("leaves_no_lobes", pytest.approx(5e-5, abs=1e-6))
    # K at which the path's least convex radius is 1.01 of the pin's: by the curvature of R e^{is} - e e^{iNs} itself
    s = np.linspace(0.0, math.pi / 10, 2001)

    def sharpest(e: float) -> float:
        first = 1j * (50 * np.exp(1j * s) - 11 * e * np.exp(11j * s))
        second = -(50 * np.exp(1j * s) - 121 * e * np.exp(11j * s))
        bend = (np.conj(first) * second).imag / np.abs(first) ** 3
        return float(1 / bend.max())

    low, high = 0.5, 4.5
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if sharpest(middle) > 1.01 * 4 else (low, middle)
    told = refused(replace(DISC, eccentricity=low * 1.001))
    assert told.code == "pins_undercut_lobes"
    assert told.nearest.value == pytest.approx(low, rel=3e-6)
    assert told.numbers == {"path": pytest.approx(sharpest(low * 1.001), rel=2e-5), "least": pytest.approx(4.04)}
    # e N = R: loops
    assert refused(replace(DISC, eccentricity=50 / 11 * 1.0001)).code == "pin_paths_have_loops"
    assert refused(replace(DISC, eccentricity=50 / 11 * 0.9999)).code == "pins_undercut_lobes"


def test_discs_are_moved_up_to_where_rims_and_valleys_end() -> None:
    """A bore of 60: its rim is (50 - 1 - 4) - 30 = 15 wide; lobes whose parallel has no cusp reach 1 mm inwards."""
    bored = replace(DISC, holes=HubHoles(RoundBore(60.0)))
    assert bored.root_radius == 45.0
    # s = pi / z is a lobe's middle, s = 0 a valley's: R (1 - K)^2 / (N K - 1) and the pin itself fill it
    shortening = 11 / 50
    most = 4 + 50 * (1 - shortening) ** 2 / (11 * shortening - 1)
    least = -DISC.least_curvature_radius
    for disc, low in ((DISC, least), (bored, max(least, -7.5)), (replace(DISC, holes=HubHoles(RoundBore(88.0))), -0.5)):
        assert disc_region(disc, low * (1 - 1e-5))
        with pytest.raises(OffsetError) as told:
            disc_region(disc, low * (1 + 1e-5))
        assert told.value.reason == "leaves_no_lobes_or_rim"
        assert told.value.nearest_offset == pytest.approx(low, rel=2e-6)
    bare = DISC
    assert disc_region(bare, most * (1 - 1e-5))
    with pytest.raises(OffsetError) as told:
        disc_region(bare, most * (1 + 1e-5))
    assert told.value.reason == "closes_valleys"
    assert told.value.nearest_offset == pytest.approx(most, rel=2e-6)
    # K N <= 1: valleys are not hollow, and never close
    assert replace(DISC, eccentricity=50 / 121 * 0.999).offset_limits()[1] == math.inf
    assert math.isfinite(replace(DISC, eccentricity=50 / 121 * 1.001).offset_limits()[1])


def test_what_is_poor_of_a_disc_is_told_from_its_limit_on() -> None:
    for bore, thin in ((85.9, False), (86.1, True)):
        # 45 - 43 is a quarter of the pin
        found = disc_findings(replace(DISC, holes=HubHoles(RoundBore(bore))))
        wanted = [("cycloidal_thin_wall", pytest.approx(45 - bore / 2), 2.0)] if thin else []
        assert [(f.code, f.value, f.limit) for f in found] == wanted
    for e in np.linspace(2.0, 3.4, 29):
        disc = replace(DISC, eccentricity=float(e))
        sharp = disc.least_curvature_radius
        told = [(f.code, f.value, f.limit) for f in disc_findings(disc)]
        assert told == ([("cycloidal_near_cusp", sharp, 0.4)] if sharp < 0.4 else [])


GEAR = LanternGear(12, 10, 60.0, 9.0)


def flank_at(gear: LanternGear, u: float) -> complex:
    """a e^{iu} - R e^{imu}, and rho along the normal i e^{i (m + 1) u / 2} of its way towards the tooth, turned."""
    z, n, big = gear.number_of_teeth, gear.number_of_pins, gear.pin_circle_diameter / 2
    m, rho = 1 + z / n, gear.pin_diameter / 2 + gear.pin_clearance
    path = big * m * cmath.exp(1j * u) - big * cmath.exp(1j * m * u)
    return (path + 1j * rho * cmath.exp(1j * (m + 1) * u / 2)) * cmath.exp(-1j * math.pi / z)


def test_a_tooth_ends_where_its_flanks_meet_and_begins_at_its_root() -> None:
    found = limits_of(GEAR)
    for u, radius in ((found.start, found.start_radius), (found.pointed, found.pointed_radius)):
        assert abs(flank_at(GEAR, u)) == pytest.approx(radius, rel=1e-12)
    assert abs(cmath.phase(flank_at(GEAR, found.pointed))) < 1e-12
    # the root arc about the cusp, on the pitch circle r = 36 in the middle of the space
    assert abs(flank_at(GEAR, found.start) - cmath.rect(36.0, -math.pi / 12)) == pytest.approx(4.5, rel=1e-12)
    low, high = 2 * found.start_radius, 2 * found.pointed_radius
    room = 0.01 * (high - low)
    for tip, kind, code, cure, told in (
        (high - room + 1e-5, PointedTipError, "tooth_pointed_at", high - room, high),
        (low + room - 1e-5, ParameterError, "flank_begins_at", low + room, low),
    ):
        with pytest.raises(kind) as caught:
            checked_lantern_gear(replace(GEAR, given_tip_diameter=tip))
        assert (caught.value.name, caught.value.code) == ("tip_diameter", code)
        assert caught.value.numbers == {"diameter": pytest.approx(told, rel=1e-12)}
        assert caught.value.nearest is not None
        assert caught.value.nearest.value == pytest.approx(cure, abs=1.1e-6)
        given = checked_lantern_gear(replace(GEAR, given_tip_diameter=caught.value.nearest.value))
        assert 2 * given.tip_radius == caught.value.nearest.value
    # a tenth of the pitch is left at the tip, 2 pi 30 / 10
    assert GEAR.tip_thickness == pytest.approx(0.6 * math.pi, rel=1e-9)
    at = flank_at(GEAR, found.tip)
    assert -2 * abs(at) * cmath.phase(at) == pytest.approx(0.6 * math.pi, rel=1e-9)


def test_pins_of_a_lantern_leave_a_tooth() -> None:
    touching = 60 * math.sin(math.pi / 10) * (1 - 1e-6)
    with pytest.raises(ParameterError) as caught:
        checked_lantern_gear(replace(GEAR, pin_diameter=touching * 1.00001))
    assert (caught.value.name, caught.value.code) == ("pin_diameter", "pins_touch")
    assert caught.value.numbers == {"pins": 10, "circle": 60.0}
    # the neck between two root arcs, 36 sin 15 less their radius, is more than 0.005 of the pitch: so are they refused
    neck = 36 * math.sin(math.pi / 12) - 0.005 * 6 * math.pi
    most = neck - 4.5
    for key in ("root_clearance", "pin_clearance"):
        with pytest.raises(ParameterError) as caught:
            checked_lantern_gear(replace(GEAR, **{key: most + 1e-4}))
        assert (caught.value.name, caught.value.code) == (key, "leaves_no_tooth_between_pins")
        assert caught.value.nearest is not None
        assert caught.value.nearest.value <= most
        checked_lantern_gear(replace(GEAR, **{key: caught.value.nearest.value}))
        if key == "root_clearance":
            assert caught.value.nearest.value == pytest.approx(most, abs=2e-6)


def test_a_rim_is_left_about_the_holes() -> None:
    """The bottom of the spaces is 31.5: of a bore of 60 a rim of 1.5, which an offset takes from both sides."""
    bored = replace(GEAR, holes=HubHoles(RoundBore(60.0)))
    assert bored.root_radius == 31.5
    assert toothed_region(lantern_side, bored, -0.7499)
    with pytest.raises(OffsetError) as told:
        toothed_region(lantern_side, bored, -0.7501)
    assert told.value.reason == "leaves_no_rim"
    assert told.value.nearest_offset == pytest.approx(-0.75, abs=1e-5)
    assert toothed_region(lantern_side, bored, told.value.nearest_offset)
