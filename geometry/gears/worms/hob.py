"""The hob that leaves a worm wheel, and in closed form what its flanks and their rounded tips envelop.

Frame of the drive (``drive.py``): the hob's axis crosses the line of centres x at x = a - a_0, swivelled about it from
z towards y. Where the hob stands, a turn of it is a slide along its axis; the condition n v = 0 is linear in that
slide, so each point of the hob, at a radius and a polar angle, has its point of the wheel in closed form, at any angle
of the axes. What is described is the lower flank of a thread; half a turn about x makes the upper one of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ParameterError
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Flags, Real
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.worm import Worm

# half the tip between its roundings is no narrower, modules: faces less wide are turned over by rounding
_LEAST_LAND = 1e-3
# steps to a plane across the wheel's axis, and the last of them, rad; from which on they are no longer than that where
# there is a point at all; when they have got there, part of the hob's tip
_STEPS, _LEAST_STEP, _CALM, _NEAR, _THERE = 24, 1e-8, 5, 0.03, 1e-12
# steps to the hob's pressure angle, each of which leaves a tenth of what it is off
_ANGLE_STEPS = 16


class Meridian(Record, eq=False, dict=True):
    """Points of a thread's lower flank in the axial half plane: radius, mm, and a tangent there.

    ``axial`` gives their z, mm: how far from the wheel's axis they leave something does not ask for it.
    """

    radius: Real
    axial: Callable[[], Real]
    outwards: Real | float
    upwards: Real

    @cached_property
    def z(self) -> Real:
        """Along the thread's axis, mm."""
        return self.axial()


class Cut(Record, eq=False, dict=True):
    """What the hob leaves: points about the wheel's axis in the frame of its tooth 1, and when they are left.

    ``along``: how far along the hob's axis the ``meridian`` is touched, mm, at sine and cosine, ``side`` and ``out``,
    of its polar angle there; ``touching``: the point in the frame of the drive, x - a + iz, mm, ``into``: the normal
    into the thread. Of a swivelled hob the contact leaves the plane across the wheel's axis before it runs off to
    infinity: then no point is ``found`` in it. All else is worked out when it is asked for.
    """

    hob: Hob
    meridian: Meridian
    side: Real
    out: Real
    along: Real
    touching: Complex
    into: tuple[Real, Real, Real]
    found: Flags

    @property
    def distance(self) -> Real:
        """From the wheel's axis, mm."""
        return np.abs(self.touching)

    @property
    def runs_off(self) -> Flags:
        """Where the contact has run off to infinity: ``steepness`` is not below 0."""
        return ~(self.into[0] < 0)

    @cached_property
    def slid(self) -> Real:
        """How far the hob has slid along its axis, mm."""
        worm = self.hob.worm
        return self.along - self.meridian.z - worm.sign * worm.parameter * np.arctan2(self.side, self.out)

    @cached_property
    def _turned(self) -> Complex:
        with np.errstate(invalid="ignore"):
            return -np.exp(-1j * (self.hob.rate * self.slid + math.pi / self.hob.number_of_teeth))

    @cached_property
    def plane(self) -> Complex:
        """x + iy of the lower side of tooth 1, mm."""
        return self.touching * self._turned

    @cached_property
    def _size(self) -> Real:
        x, y, z = self.into
        return np.sqrt(x * x + y * y + z * z)

    @property
    def normal(self) -> Complex:
        """That of the wheel's surface in the plane, out of its material."""
        return (self.into[0] + 1j * self.into[2]) * self._turned / self._size

    @property
    def steepness(self) -> Real:
        """The normal's part along the line of centres; where it goes through 0 the contact has run off to infinity."""
        return self.into[0] / self._size


class Hob(Record, dict=True):
    """A hob with the threads of ``worm`` up to ``tip_radius``, rounded by ``rounding`` (in the axial section), mm.

    ``number_of_teeth``: of the wheel; ``centre_distance`` a_0, mm; ``swivel`` of its axis about the line of centres,
    rad.
    """

    worm: Worm
    number_of_teeth: int
    centre_distance: float
    tip_radius: float
    rounding: float
    swivel: float = 0.0

    @cached_property
    def rate(self) -> float:
        """By how much the wheel turns for a slide of the hob along its axis, rad/mm."""
        return -self.worm.number_of_starts / (self.number_of_teeth * self.worm.parameter)

    @cached_property
    def form_radius(self) -> float:
        """Where the flank touches the rounding of the tip, mm."""
        flank, centre = self.worm.flank, self.tip_radius - self.rounding

        def beyond(radius: float) -> float:
            slope = float(flank.slope(radius))
            return radius - self.rounding * slope / math.hypot(1.0, slope) - centre

        if self.rounding == 0:
            return self.tip_radius
        return bracketed_root(beyond, centre, self.tip_radius).value

    @cached_property
    def least_normal(self) -> float:
        """Angle of the rounding's normal from the axis where it touches the flank, rad; a right angle at the tip."""
        return math.atan(float(self.worm.flank.slope(self.form_radius)))

    @cached_property
    def half_land(self) -> float:
        """Half the width of the tip between both roundings, axial, mm."""
        return float(self.worm.half_thickness(self.form_radius)) - self.rounding * math.cos(self.least_normal)

    def checked(self) -> Hob:
        """The hob itself, where its thread has a tip.

        Raises
        ------
        ParameterError
            The roundings of its tip all but meet.
        """
        least = _LEAST_LAND * self.worm.module
        if self.half_land > least:
            return self

        def left(rounding: float) -> float:
            return replace(self, rounding=rounding).half_land - least

        if left(0.0) <= 0:
            raise ParameterError("tip_clearance_coefficient", self.worm.tip_clearance_coefficient, "hob_pointed")
        most = bracketed_root(left, 0.0, self.rounding).value / self.worm.module
        given = self.rounding / self.worm.module
        raise ParameterError.beyond("hob_rounding_coefficient", given, "hob_rounding_too_large", most)

    def flank(self, radius: ArrayLike) -> Meridian:
        """The flank at radii, mm."""
        r = np.asarray(radius, float)
        return Meridian(r, lambda: -self.worm.half_thickness(r), 1.0, self.worm.flank.slope(r))

    def round(self, normal: ArrayLike) -> Meridian:
        """The rounding of the tip at angles of its normal, from ``least_normal`` to a right angle, rad."""
        angle = np.asarray(normal, float)
        sine, cosine = np.sin(angle), np.cos(angle)
        radius = self.tip_radius - self.rounding * (1 - sine)
        return Meridian(radius, lambda: -self.half_land - self.rounding * cosine, cosine, sine)

    def land(self, share: ArrayLike) -> Meridian:
        """The tip between its roundings, from the lower one (0) to the upper one (1)."""
        z = self.half_land * (2 * np.asarray(share, float) - 1)
        return Meridian(np.full_like(z, self.tip_radius), lambda: z, 0.0, np.ones_like(z))

    def cut(self, meridian: Meridian, height: ArrayLike) -> Cut:
        """What points of the thread leave in planes across the wheel's axis, ``height`` mm above its middle."""
        y = -np.asarray(height, float)
        worm, r = self.worm, meridian.radius
        sine, cosine, screw = math.sin(self.swivel), math.cos(self.swivel), worm.sign * worm.parameter
        with np.errstate(invalid="ignore", divide="ignore"):
            side = y / r
            if self.swivel:
                turn = self._turned(meridian, np.arcsin(side), y)
                side, out = np.sin(turn), np.cos(turn)
            else:
                out = np.sqrt((1 - side) * (1 + side))
            # normal of the thread, into it: tangent of the meridian x tangent of the turn, in the hob's frame
            rise, lift = screw * meridian.outwards, meridian.upwards * r
            n_x, n_y, n_z = rise * side - lift * out, -lift * side - rise * out, r * meridian.outwards
            x = r * out - self.centre_distance
            # the hob slides along its axis, the wheel turns by ``rate``: n v = 0
            if not self.swivel:
                z = along = n_z * (self.rate * x - 1) / (n_x * self.rate)
                there = np.isfinite(z)
            else:
                n_y, n_z = n_y * cosine - n_z * sine, n_y * sine + n_z * cosine
                z = (n_y * sine - n_z * (cosine - self.rate * x)) / (n_x * self.rate)
                along = (z - r * side * sine) / cosine
                there = np.abs(r * side * cosine - along * sine - y) <= _THERE * self.tip_radius
                there &= np.abs(turn) <= math.pi / 2
            return Cut(self, meridian, side, out, along, x + 1j * z, (n_x, n_y, n_z), there)

    def _turned(self, meridian: Meridian, turn: Real, y: Real) -> Real:
        """Polar angles at which points of a swivelled thread touch the wheel in their planes, rad; from near ones.

        The swivel moves them from there by a little: Halley's steps on n v = 0 in the plane, without its denominator,
        which is p sin^2 - q sin cos + c cos + s sin + k of the angle.
        """
        sine, cosine = math.sin(self.swivel), math.cos(self.swivel)
        screw, sunk = self.worm.sign * self.worm.parameter, self.centre_distance * sine * sine
        r, rise, lift = meridian.radius, screw * meridian.outwards, meridian.upwards * meridian.radius
        wanted, along, across = y * cosine, sine * r * meridian.outwards, 1 / self.rate + self.centre_distance * cosine
        terms = np.empty((5, *turn.shape))
        terms[0] = rise * r * cosine**2
        terms[1] = lift * r * cosine**2
        terms[2] = lift * wanted - cosine * r * along - sunk * rise
        terms[3] = -rise * wanted - sunk * lift
        terms[4] = rise * r * sine**2 + along * across
        p, q, c, s, k = terms = terms.reshape(5, -1)
        found, at = turn.ravel(), np.arange(turn.size)
        for number in range(_STEPS):
            here = found[at]
            out, side = np.cos(here), np.sin(here)
            less, more, wave = q * out - p * side, q * side + p * out, c * out + s * side
            fall = side * less
            left, slope = wave - fall + k, side * (more - c) - out * (less - s)
            step = 2 * left * slope / (2 * slope * slope - left * (2 * (fall + out * more) - wave))
            here -= step
            found[at] = here
            size = np.abs(step)
            goes = (size > _LEAST_STEP) & (np.abs(here) < math.pi)
            if number >= _CALM:
                # nothing is near
                goes &= size < _NEAR
            if not goes.any():
                break
            if not goes.all():
                at = at[goes]
                p, q, c, s, k = terms = terms[:, goes]
        return found.reshape(turn.shape)


def oversized_hob(drive: WormDrive, rounding_coefficient: float, quotient: float) -> Hob:
    """A hob of the worm's normal module with a quotient, swivelled by the difference of both lead angles.

    With the worm's own quotient it is the worm, higher by the clearance of the wheel's root. Its flank has the worm's
    pressure angle in the normal of the reference helix, so that both touch in the mid plane.
    """
    worm = drive.worm
    made, swivel = worm, 0.0
    if quotient != worm.diameter_quotient:
        lead = math.atan2(worm.number_of_starts, quotient)
        module = worm.module * math.cos(worm.lead_angle) / math.cos(lead)
        made = replace(worm, module=module, diameter_quotient=quotient)
        for _ in range(_ANGLE_STEPS):
            off = worm.normal_pressure_angle - made.normal_pressure_angle
            made = replace(made, pressure_angle=made.pressure_angle + off)
        swivel = worm.sign * (worm.lead_angle - lead)
    more = made.reference_radius - worm.reference_radius
    tip = drive.centre_distance - drive.root_radius + more
    rounding = rounding_coefficient * made.module
    return Hob(made, drive.number_of_teeth, drive.centre_distance + more, tip, rounding, swivel)
