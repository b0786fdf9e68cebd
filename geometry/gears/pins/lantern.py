"""The wheel that drives a lantern: flanks parallel to the epicycloid of a pin's centre, rounded roots, and its limits.

N pins of radius rho stand on a circle of radius R, the lantern's pitch circle; the gear of z teeth has the pitch radius
r = R z / N. Rolling on it, a pin's centre draws the ordinary epicycloid a e^{iu} - R e^{imu}, a = r + R, m = 1 + z / N,
with a cusp in the middle of each space; u is the gear's rotation from the pin's stand on the line of centres. The
flank is its parallel, rho towards the tooth (Litvin, Fuentes, Gear Geometry and Applied Theory, chapter 13). Below the
pitch circle nothing touches: there the root is an arc about the cusp.

Frame: tooth 1 is centred on +x.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from functools import lru_cache, partial

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import Nearest, ParameterError, PointedTipError, limit
from geometry.base.findings import Finding
from geometry.base.nearest import last_that_holds, nearest
from geometry.base.record import Record, replace, with_value
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Real, end_point, start_point
from geometry.curves.cycloid import CycloidParallel
from geometry.curves.line_arc import Arc
from geometry.gears.teeth.offset import grown_side
from geometry.gears.teeth.round_teeth import RoundTeeth
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.profile import Label, Segment
from geometry.solids.hub_holes import HubHoles

_NO_HOLES = HubHoles()
_MARGIN = 1e-6
# width of the tip land by default, in pitches, and of what is left of the tooth where it is thin already
_TIP_LAND, _TIP_SHARE = 0.1, 0.5
_SAMPLES, _BISECTIONS = 129, 40
# of the height from root arc to pointed tip: shorter flanks, and lands nearer to the point, are none
_LEAST_FLANK = 0.01
# of the pitch: thinner necks and bottoms are none
_LEAST_NECK = 0.005


class LanternGear(RoundTeeth):
    """A gear of ``number_of_teeth`` for a lantern of ``number_of_pins`` pins; lengths in mm.

    ``pin_clearance`` is the gap between a flank and its pin along the normal, ``root_clearance`` what the root arc's
    radius is more than that. ``given_tip_diameter`` None: a tip land of a tenth of the pitch.
    """

    number_of_pins: int
    pin_circle_diameter: float
    pin_diameter: float
    pin_clearance: float = 0.0
    root_clearance: float = 0.0
    given_tip_diameter: float | None = None
    holes: HubHoles = _NO_HOLES
    face_width: float = 0.0

    @property
    def lantern_radius(self) -> float:
        """R: radius of the circle of pins, mm."""
        return self.pin_circle_diameter / 2

    @property
    def pitch_radius(self) -> float:
        """r = R z / N, mm."""
        return self.lantern_radius * self.number_of_teeth / self.number_of_pins

    @property
    def centre_distance(self) -> float:
        """a = r + R, mm."""
        return self.pitch_radius + self.lantern_radius

    @property
    def pitch(self) -> float:
        """Arc from pin to pin on both pitch circles, mm."""
        return 2 * math.pi * self.lantern_radius / self.number_of_pins

    @property
    def generating_pin_radius(self) -> float:
        """rho with the clearance, mm."""
        return self.pin_diameter / 2 + self.pin_clearance

    @property
    def root_arc_radius(self) -> float:
        """Radius of the root about the cusp, mm."""
        return self.generating_pin_radius + self.root_clearance

    @property
    def root_radius(self) -> float:
        """Bottom of the spaces, mm."""
        return self.pitch_radius - self.root_arc_radius

    @property
    def tip_radius(self) -> float:
        """r_a, mm."""
        return limits_of(self).tip_radius

    @property
    def cusp(self) -> complex:
        """Where a pin's centre stands on the line of centres: in the middle of the lower space, on the pitch circle."""
        return cmath.rect(self.pitch_radius, -self.pitch_angle / 2)

    def flank(self, start: float = 0.0, end: float | None = None) -> CycloidParallel:
        """The lower flank of tooth 1 over u; all of it without arguments, the part that runs back too."""
        order = 1 + self.number_of_teeth / self.number_of_pins
        last = math.pi / (order - 1) if end is None else end
        return CycloidParallel(
            self.lantern_radius, order, self.generating_pin_radius, -self.pitch_angle / 2, start, last
        )

    @property
    def contact_ratio(self) -> float:
        """Way of a pin along one flank over the pitch, in turns of the gear; above 1 the drive is not interrupted."""
        found = limits_of(self)
        return (found.tip - found.start) / self.pitch_angle

    @property
    def tip_thickness(self) -> float:
        """Width of the tip land, mm (arc)."""
        return -2 * self.tip_radius * cmath.phase(complex(self.flank().point(limits_of(self).tip)))


class FlankLimits(Record):
    """Where a flank begins (at the root arc), ends (at the tip) and would be pointed: u in rad, and radii in mm."""

    start: float
    tip: float
    pointed: float
    start_radius: float
    tip_radius: float
    pointed_radius: float


@lru_cache(maxsize=64)
def limits_of(gear: LanternGear) -> FlankLimits:
    """The ends of the flank.

    Raises
    ------
    ParameterError
        The tooth has no flank, or its tip is pointed or below the flank; names the key and what works.
    """
    ends = _flank_ends(gear)
    if ends is None:
        raise _too_thick(gear)
    (begin, pointed), flank = ends, gear.flank()
    low, high = (abs(complex(flank.point(u))) for u in (begin, pointed))
    if gear.given_tip_diameter is None:
        whole = 2 * low * float(_half_width(flank, begin))
        land = min(_TIP_LAND * gear.pitch, _TIP_SHARE * whole)

        def wider(u: float) -> float:
            return 2 * abs(complex(flank.point(u))) * float(_half_width(flank, u)) - land

        tip = bracketed_root(wider, begin, pointed).value
        return FlankLimits(begin, tip, pointed, low, abs(complex(flank.point(tip))), high)
    radius = gear.given_tip_diameter / 2
    room = _LEAST_FLANK * (high - low)
    if radius > high - room:
        most = limit(2 * (high - room), gear.given_tip_diameter, digits=6)
        raise PointedTipError("tip_diameter", gear.given_tip_diameter, "tooth_pointed_at", most, diameter=2 * high)
    if radius < low + room:
        least = limit(2 * (low + room), gear.given_tip_diameter, digits=6)
        raise ParameterError("tip_diameter", gear.given_tip_diameter, "flank_begins_at", least, diameter=2 * low)
    tip = bracketed_root(lambda u: abs(complex(flank.point(u))) - radius, begin, pointed).value
    return FlankLimits(begin, tip, pointed, low, radius, high)


def _half_width(flank: CycloidParallel, u: ArrayLike) -> Real:
    """Angle from the flank to the middle of the tooth, rad."""
    return -np.angle(flank.point(u))


def _flank_ends(gear: LanternGear) -> tuple[float, float] | None:
    """u at which the flank leaves the root arc, and at which it meets the opposite one; None: there is no tooth."""
    # the root arcs on both sides of a tooth leave a neck, the bottom something about the axis
    neck = gear.pitch_radius * math.sin(gear.pitch_angle / 2) - gear.root_arc_radius
    if not neck > _LEAST_NECK * gear.pitch or not gear.root_radius > _LEAST_NECK * gear.pitch:
        return None
    begin, flank = _flank_start(gear), gear.flank()
    if begin is None or float(_half_width(flank, begin)) * gear.pitch_radius <= _LEAST_NECK * gear.pitch:
        return None
    pointed = _first_root(lambda u: _half_width(flank, u), begin, flank.end)
    return None if pointed is None else (begin, pointed)


def _flank_start(gear: LanternGear) -> float | None:
    """u at which the flank leaves the root arc, beyond the cusp of the parallel; None where it never does."""
    flank = gear.flank()
    # pins between which a neck is left are smaller than the path's bend in its middle: their parallel has a cusp
    begin = flank.cusp()
    return _first_root(lambda u: np.abs(flank.point(u) - gear.cusp) - gear.root_arc_radius, begin, flank.end)


def _first_root(function: Callable[[ArrayLike], Real], low: float, high: float) -> float | None:
    """First change of sign, seen on even samples."""
    places = np.linspace(low, high, _SAMPLES)
    signs = np.sign(function(places))
    changes = np.flatnonzero((signs[1:] != signs[:-1]) & (signs[:-1] != 0))
    if not changes.size:
        return None
    k = int(changes[0])
    return bracketed_root(lambda u: float(function(u)), float(places[k]), float(places[k + 1])).value


def _too_thick(gear: LanternGear) -> ParameterError:
    """No tooth is left between two pins: the first key that alone leaves one is to blame, else the pins."""

    def fits(key: str, value: float) -> bool:
        return _flank_ends(with_value(gear, key, value)) is not None

    least = {"root_clearance": 0.0, "pin_clearance": 0.0, "pin_diameter": gear.pin_diameter * 1e-3}
    found = next((k for k, low in least.items() if getattr(gear, k) > low and fits(k, low)), None)
    if found is None:
        return ParameterError("pin_diameter", gear.pin_diameter, "leaves_no_tooth_with_clearances")
    given: float = getattr(gear, found)
    cure = partial(nearest, partial(fits, found), given, least[found], digits=6)
    return ParameterError(found, given, "leaves_no_tooth_between_pins", cure)


def checked_lantern_gear(gear: LanternGear) -> LanternGear:
    """The same gear, if its teeth exist.

    Raises
    ------
    ParameterError
        Pins that touch, no tooth between two pins, a tip that is pointed or too low.
    """
    room = gear.pin_circle_diameter * math.sin(math.pi / gear.number_of_pins) * (1 - _MARGIN)
    if gear.pin_diameter > room:

        def fits(diameter: float) -> bool:
            """Apart, and with a tooth between them."""
            return diameter <= room and _flank_ends(with_value(gear, "pin_diameter", diameter)) is not None

        def cure() -> Nearest:
            """Pins that leave a tooth; where no pins do, those that do not touch."""
            given = gear.pin_diameter
            return nearest(fits, given, room * 1e-3, digits=6) or limit(room, given, digits=6)

        raise ParameterError(
            "pin_diameter",
            gear.pin_diameter,
            "pins_touch",
            cure,
            pins=gear.number_of_pins,
            circle=gear.pin_circle_diameter,
        )
    limits_of(gear)
    return gear


def greatest_pin_diameter(gear: LanternGear) -> float:
    """Of pins between which a tooth is left, and that do not touch, mm."""

    def whole(diameter: float) -> object:
        return checked_lantern_gear(with_value(gear, "pin_diameter", diameter))

    touching = gear.pin_circle_diameter * math.sin(math.pi / gear.number_of_pins)
    return last_that_holds(whole, touching, gear.pin_diameter, steps=48)


@lru_cache(maxsize=32)
def lantern_side(gear: LanternGear, offset: float = 0.0) -> ToothSide:
    """The lower side of tooth 1, moved ``offset`` mm out of the material.

    Raises
    ------
    GeometryError
        The offset leaves no tooth, or closes the spaces.
    """
    if offset > 0:
        return grown_side(lantern_side(gear), offset)
    tip = 2 * (limits_of(gear).tip_radius + offset)
    if offset < 0:
        gear = replace(gear, pin_clearance=gear.pin_clearance - offset, given_tip_diameter=tip)
    found, centre = limits_of(gear), gear.cusp
    flank = gear.flank(found.start, found.tip)
    inwards = cmath.phase(-centre)
    foot = (start_point(flank) - centre) * cmath.exp(-1j * inwards)
    root = Arc(centre, gear.root_arc_radius, inwards, cmath.phase(foot))
    angle = cmath.phase(end_point(flank))
    land = Arc(0j, abs(end_point(flank)), angle, -angle)
    segments = (Segment(root, Label.ROOT_FILLET), Segment(flank, Label.FLANK), Segment(land, Label.TIP_LAND))
    return ToothSide(segments, gear.pitch_angle)


def lantern_findings(gear: LanternGear) -> tuple[Finding, ...]:
    """A drive that is interrupted from tooth to tooth, and whether the root's clearance alone is the cause."""
    ratio = gear.contact_ratio
    if not ratio < 1:
        return ()
    cut = gear.root_clearance > 0 and not with_value(gear, "root_clearance", 0.0).contact_ratio < 1
    return (Finding("contact_ratio_by_root" if cut else "contact_ratio", ratio, 1.0),)
