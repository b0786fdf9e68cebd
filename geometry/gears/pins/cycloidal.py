"""The cycloidal disc of a reducer: the exact parallel of a shortened epitrochoid, its limits and its offsets.

N = z + 1 pins of radius rho stand on a circle of radius R about the fixed axis; the disc of z lobes is moved round it
at the eccentricity e and turns by -phi / z while the eccentric turns by phi. A pin's centre then draws
R e^{is} - e e^{iNs} in the disc, s = phi / z, and the disc's outline is its parallel, rho inwards. The same curve in
coordinates: J.-H. Shin, S.-M. Kwon, Mechanism and Machine Theory 41 (2006) 596-616.

Frame: lobe 1 is centred on +x.
"""

from __future__ import annotations

import math
from functools import partial
from itertools import pairwise

import numpy as np

from geometry.base.errors import Nearest, OffsetError, ParameterError, UndercutError, limit
from geometry.base.findings import Finding, short_of
from geometry.base.nearest import nearest
from geometry.base.record import Record, replace, with_value
from geometry.curves.cycloid import ShortTrochoid, greatest_shortening, least_convex_radius
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, Segment
from geometry.solids.hub_holes import HubHoles
from geometry.solids.windows import RoundHoles

_NO_HOLES = HubHoles()
# what is kept from every limit, as a part of it: curves that end in a cusp are no outline
_MARGIN = 1e-6
# lobes lower than this part of the pin circle are rounding; pieces shorter than this share of a lobe are not split off
_LEAST_SHARE, _LEAST_SPLIT = 1e-6, 1e-5
# a pin is smaller than its circle by this part of it at least
_LEAST_RING = 0.02
# lobes are rounded by this part of the generating pin's radius at least: sharper ones are cusps in every file
_SHARPEST = 0.01
# a radius of curvature below this part of the pin's is told
_SHARP = 0.1


class CycloidalDisc(Record):
    """A disc of ``number_of_lobes`` lobes that rolls inside number_of_lobes + 1 pins; lengths in mm.

    ``pin_clearance`` moves the outline into the disc along its normals; ``pin_circle_shift`` is what the radius of the
    generating pin circle is less than the true one. ``holes``: bore and all other
    holes, ``output`` those of the output pins among them.
    """

    number_of_lobes: int
    pin_circle_diameter: float
    pin_diameter: float
    eccentricity: float
    pin_clearance: float = 0.0
    pin_circle_shift: float = 0.0
    holes: HubHoles = _NO_HOLES
    output: RoundHoles | None = None

    @property
    def number_of_pins(self) -> int:
        """N = z + 1."""
        return self.number_of_lobes + 1

    @property
    def pitch_angle(self) -> float:
        """Angle from lobe to lobe, rad."""
        return 2 * math.pi / self.number_of_lobes

    @property
    def generating_radius(self) -> float:
        """R: radius of the pin circle that draws the outline, mm."""
        return self.pin_circle_diameter / 2 - self.pin_circle_shift

    @property
    def generating_pin_radius(self) -> float:
        """rho: how far the outline runs inside the path of a pin's centre, mm."""
        return self.pin_diameter / 2 + self.pin_clearance

    @property
    def shortening(self) -> float:
        """lambda = e N / R (K_1 of the Chinese and Japanese texts): below 1 the path has no loops."""
        return self.eccentricity * self.number_of_pins / self.generating_radius

    @property
    def root_radius(self) -> float:
        """Bottom of the valleys, mm: R - e - rho."""
        return self.generating_radius - self.eccentricity - self.generating_pin_radius

    @property
    def tip_radius(self) -> float:
        """Top of the lobes, mm: R + e - rho."""
        return self.generating_radius + self.eccentricity - self.generating_pin_radius

    @property
    def least_path_radius(self) -> float:
        """Least convex radius of curvature of the path of a pin's centre, mm."""
        return least_convex_radius(self.generating_radius, self.shortening, self.number_of_pins)

    @property
    def least_curvature_radius(self) -> float:
        """Least convex radius of curvature of the outline, mm."""
        return self.least_path_radius - self.generating_pin_radius

    @property
    def pitch_radius(self) -> float:
        """Radius of the disc's centrode, mm: e z."""
        return self.eccentricity * self.number_of_lobes

    def rotation(self, drive: float) -> float:
        """Rotation of the disc while the eccentric stands at ``drive``, rad: a valley at the pin on +x for drive 0."""
        return (math.pi - drive) / self.number_of_lobes

    def half_lobe(self, offset: float = 0.0) -> ShortTrochoid:
        """The curve of the lower half of lobe 1 over s = phi / z, from a valley's middle, moved ``offset`` mm out."""
        half = math.pi / self.number_of_lobes
        return ShortTrochoid(
            self.generating_radius, self.eccentricity, self.number_of_pins, self.generating_pin_radius - offset,
            -half, 0.0, half,
        )  # fmt: skip

    def side(self, offset: float = 0.0) -> ToothSide:
        """The lower half of lobe 1 from a valley's middle, moved ``offset`` mm out of the material."""
        half, whole = math.pi / self.number_of_lobes, self.half_lobe(offset)
        edges, least = [0.0], _LEAST_SPLIT * half * self.generating_radius
        for at in whole.graded_splits():
            # near the limit of shortening a valley takes little of the parameter, but some of the length
            before, here, end = np.asarray(whole.point(np.array([edges[-1], at, half])))
            if min(abs(here - before), abs(end - here)) > least:
                edges.append(at)
        pieces = [Segment(whole.trimmed(a, b), Label.LOBE) for a, b in pairwise([*edges, half])]
        return ToothSide(tuple(pieces), self.pitch_angle)

    def profile(self, offset: float = 0.0) -> Profile:
        """The closed outline, moved ``offset`` mm out of the material; within ``offset_limits``."""
        return self.side(offset).profile()

    def offset_limits(self) -> tuple[float, float]:
        """Least and greatest offset whose outline has no cusp, mm; the greatest closes the valleys (inf: never)."""
        least = -self.least_curvature_radius * (1 - _MARGIN)
        hollow = self.number_of_pins * self.shortening - 1
        if hollow <= 0:
            return least, math.inf
        valley = self.generating_radius * (1 - self.shortening) ** 2 / hollow
        return least, (self.generating_pin_radius + valley) * (1 - _MARGIN)


def checked_disc(disc: CycloidalDisc) -> CycloidalDisc:
    """The same disc, if its outline exists: path without loops, parallel without cusps, pins that do not touch.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works; ``UndercutError`` where pins would cut the lobes away.
    """
    _check_pins(disc)
    least, most = eccentricities(disc)
    if disc.eccentricity < least:
        raise ParameterError("eccentricity", disc.eccentricity, "leaves_no_lobes", _told(least, disc.eccentricity))
    if disc.eccentricity > most:
        given, cure = disc.eccentricity, _told(most, disc.eccentricity)
        if disc.shortening >= 1 - _MARGIN:
            raise UndercutError("eccentricity", given, "pin_paths_have_loops", cure)
        sizes = {"path": disc.least_path_radius, "least": disc.generating_pin_radius * (1 + _SHARPEST)}
        raise UndercutError("eccentricity", given, "pins_undercut_lobes", cure, **sizes)
    return disc


def eccentricities(disc: CycloidalDisc) -> tuple[float, float]:
    """Least and greatest eccentricity for these pins, mm; the circle of pins must be larger than a pin."""
    big, pins = disc.generating_radius, disc.number_of_pins
    most = greatest_shortening(big, pins, disc.generating_pin_radius * (1 + _SHARPEST)) * (1 - _MARGIN)
    return _LEAST_SHARE * big, most * big / pins


def _told(value: float, given: float) -> Nearest:
    return limit(value, given, digits=6)


def _is_whole(disc: CycloidalDisc) -> bool:
    """Whether an outline exists, whatever the pins do to each other."""
    if not disc.generating_pin_radius > 0 or not _leaves_disc(disc):
        return False
    least, most = eccentricities(disc)
    return least <= disc.eccentricity <= most


def _check_pins(disc: CycloidalDisc) -> None:
    """Pins beside each other, and a generating pin circle that leaves some eccentricity."""
    true, pins = disc.pin_circle_diameter / 2, disc.number_of_pins
    touching = 2 * true * math.sin(math.pi / pins) * (1 - _MARGIN)
    if disc.pin_diameter > touching:
        cure = partial(_nearest, disc, "pin_diameter", touching * 1e-3, touching)
        raise ParameterError("pin_diameter", disc.pin_diameter, "pins_touch", cure, pins=pins, circle=2 * true)
    if not disc.generating_pin_radius > 0:
        least = -disc.pin_diameter / 2 * (1 - _MARGIN)
        raise ParameterError("pin_clearance", disc.pin_clearance, "leaves_no_pin", _told(least, disc.pin_clearance))
    if _leaves_disc(disc):
        return
    # pins that do not touch leave a disc themselves: what takes more than they do is to blame
    if disc.pin_circle_shift > 0 and _leaves_disc(replace(disc, pin_circle_shift=0.0)):
        key, room = "pin_circle_shift", true - disc.generating_pin_radius / (1 - _LEAST_RING)
    else:
        key, room = "pin_clearance", disc.generating_radius * (1 - _LEAST_RING) - disc.pin_diameter / 2
    raise ParameterError(key, getattr(disc, key), "leaves_no_disc", partial(_nearest, disc, key, 0.0, room))


def _leaves_disc(disc: CycloidalDisc) -> bool:
    """Whether a pin is smaller than the circle that draws the outline."""
    return disc.generating_pin_radius <= disc.generating_radius * (1 - _LEAST_RING)


def _nearest(disc: CycloidalDisc, key: str, good: float, most: float) -> Nearest | None:
    """The value up to ``most`` with which the disc is whole, where ``good`` gives one; else ``most`` itself."""
    given: float = getattr(disc, key)

    def whole(value: float) -> bool:
        return value <= most and _is_whole(with_value(disc, key, value))

    return nearest(whole, given, (most, good), digits=6) or _told(most, given)


def disc_region(disc: CycloidalDisc, offset: float = 0.0) -> OffsetRegion:
    """The exact section of a disc; ``offset`` > 0 moves every boundary out of the material, mm.

    Raises
    ------
    OffsetError
        The outline would have cusps, or a hole or a wall does not survive; names the nearest offset that works.
    """
    if not math.isfinite(offset):
        raise OffsetError(offset, "not_finite")
    least, most = disc.offset_limits()
    if disc.holes.number:
        least = max(least, (disc.holes.reach - disc.root_radius) / 2 * (1 - _MARGIN))
    if not least <= offset <= most:
        reason = "closes_valleys" if offset > 0 else "leaves_no_lobes_or_rim"
        raise OffsetError(offset, reason, most if offset > 0 else least)
    return OffsetRegion(Region(disc.profile(offset), disc.holes.profiles(offset)), offset, ())


def disc_findings(disc: CycloidalDisc) -> tuple[Finding, ...]:
    """A lobe that is nearly sharp, and walls between the holes and the valleys that are thin."""
    sharp = short_of("cycloidal_near_cusp", disc.least_curvature_radius, _SHARP * disc.pin_diameter / 2)
    if not disc.holes.number:
        return sharp
    return sharp + short_of("cycloidal_thin_wall", disc.root_radius - disc.holes.reach, disc.pin_diameter / 4)
