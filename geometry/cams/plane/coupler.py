"""Disk cams whose follower is in general plane motion: fixed to the connecting rod of a linkage.

Savvin's synthesis of plane cams: the follower turns while it moves, so normal, velocity and curvature follow from the
pose of the coupler, z(S) and theta(S), geometry/kinematics/linkage.py. Path, parallel curve and face envelope are those
of every disk cam (geometry/cams/plane/curves.py); what differs stands here.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.base.roots import halved
from geometry.base.series import About, Series, argument, conjugate, derived, product, sharpened
from geometry.cams.motion.follower_motion import FollowerMotion
from geometry.cams.plane.disk import DiskCam, FollowerKind, check_radius
from geometry.cams.plane.lost_lift import greatest_value
from geometry.curves.curve import Complex, Real
from geometry.kinematics.linkage import Linkage, RockerDrive
from geometry.laws.piece import LawPiece

_TABLE, _NEWTON_STEPS = 513, 4
_DROP_SAMPLES, _BISECTIONS = 129, 50
# outlines that are off ask for an S this far beyond the motion: part of the lift, and at least this many mm
_BEYOND, _BEYOND_LENGTH = 0.02, 2.0
# an outline that is this far off, mm, may change the follower's rate by at most this share of it
_OFF, _BENT = 0.05, 0.5
# least transmission angle, rad: nearer to its dead point an assembly is held by the play of its joints
_LEAST_TRANSMISSION = math.radians(2)
# steps of the bound's search, and how far a lift may exceed its linear bound
_SLACK_STEPS, _MOST_SLACK = 6, 4.0
_REACH_SAMPLES = 257


class LinkageError(ParameterError):
    """A linkage that cannot carry its follower all the way; another member may be to blame than the one named."""


class CouplerMount(Record):
    """A follower on a coupler: ``point`` of its centre, tip or face in the coupler's frame, mm.

    ``direction``: of the stem, or of a flat face's normal, away from the cam, from the coupler's x axis, rad.
    """

    linkage: Linkage
    point: complex
    direction: float = 0.0

    def centre(self, s: Series) -> Series:
        """Path of the reference point, z = A + p exp(i theta)."""
        joint, turn = self.linkage.pose(s)
        return [a + self.point * e for a, e in zip(joint, turn, strict=True)]

    def centre_bound(self, s: Series, about: About | None = None) -> Series:
        """Bounds of the moduli of that series from those of S; inf where nothing is known of the middles."""
        if about is None:
            return [np.full(np.shape(x), np.inf) for x in s]
        joint, turn = self.linkage.pose_bound(s, about)
        return [a + abs(self.point) * e for a, e in zip(joint, turn, strict=True)]

    def angle(self, s: Series) -> Series:
        """theta, the coupler's angle, rad."""
        turn = self.linkage.pose(s)[1]
        with np.errstate(invalid="ignore"):
            return argument(turn)

    def face(self, s: Series) -> tuple[Series, Series]:
        """Distance of the face from the axis, Re(z conj(N)), and the angle of its normal N, rad."""
        joint, turn = self.linkage.pose(s)
        normal = [cmath.exp(1j * self.direction) * e for e in turn]
        centre = [a + self.point * e for a, e in zip(joint, turn, strict=True)]
        with np.errstate(invalid="ignore"):
            angle = [np.angle(normal[0]), *argument(turn)[1:]]
        return [x.real for x in product(centre, conjugate(normal))], angle

    def face_bound(self, s: Series, about: About | None = None) -> tuple[Series, Series]:
        """Bounds of the series of the face's distance and of its normal's rate of turning (one shorter)."""
        if about is None:
            return [np.full(np.shape(x), np.inf) for x in s], [np.full(np.shape(x), np.inf) for x in s[1:]]
        joint, turn = self.linkage.pose_bound(s, about)
        centre = [a + abs(self.point) * e for a, e in zip(joint, turn, strict=True)]
        height, angle = self.face(about[0])
        return sharpened(product(centre, turn), height, about[1]), sharpened(
            product(derived(turn), turn), derived(angle), about[1]
        )

    def velocity(self, rate: Real, point: Complex, s: Series) -> Complex:
        """Velocity per rad of cam angle of the follower's material at ``point``, where S' is ``rate``."""
        one = [s[0], np.ones(np.shape(s[0]))]
        joint, turn = self.linkage.pose(one)
        return rate * (joint[1] + (turn[1] / turn[0]) * (point - joint[0]))


class LinkageCam(DiskCam):
    """A disk cam whose follower is carried by a coupler; S drives the linkage, in mm of a slider or rad of a rocker."""

    mount: CouplerMount

    @property
    def swings(self) -> bool:
        """Whether S is an angle."""
        return isinstance(self.mount.linkage.drive, RockerDrive)

    def way(self, angle: Real, point: Complex) -> Complex:
        """Velocity of the follower's material at ``point`` (fixed frame) per unit of S."""
        return self.mount.velocity(np.ones(np.shape(angle)), point, [self.motion.value(angle)])

    def coupler_angle(self, angle: ArrayLike) -> Real:
        """theta of the coupler in the fixed frame, rad, within +-pi."""
        return self.mount.angle([self.motion.value(np.asarray(angle, dtype=float))])[0]

    def place(self, angle: ArrayLike) -> Complex:
        """Roller's centre, tip, arc's centre or the face's given point, fixed frame, mm."""
        return self.mount.centre([self.motion.value(np.asarray(angle, dtype=float))])[0]

    def follower_pose(self, angle: float, *, on_arm: bool = False, turns: bool = True) -> tuple[complex, float]:
        """Where a stem's frame stands: origin in the reference point, +y along ``direction``; rollers need not turn."""
        turned = float(self.coupler_angle(angle)) + self.mount.direction - math.pi / 2 if turns else 0.0
        return complex(self.place(angle)), turned

    def contact_pressure_angle(self, angle: ArrayLike) -> Real:
        """Savvin's (28), signed, rad: between the normal and the velocity of the follower's material at the contact.

        ``pressure_angle`` goes by the centre of a roller, which turns freely; of a face both are the same.
        """
        at = np.asarray(angle, dtype=float)
        return np.angle(self.normal(at) / self.way(at, self.contact(at)))

    def sliding_velocity(self, angle: ArrayLike) -> Real:
        """Velocity of a follower that does not roll against the cam, to the right of the normal, mm per rad."""
        at = np.asarray(angle, dtype=float)
        point = self.contact(at)
        between = self.motion.value(at, 1) * self.way(at, point) - 1j * point
        return (between * np.conj(-1j * self.normal(at))).real

    def reach_margin(self, angle: Real) -> Real:
        """None is near: a linkage within 90 degrees has room."""
        return np.full(np.shape(angle), np.inf)

    def slackened(self, angle: Real, bound: Real) -> Real:
        """A linear bound of the lift's error, made greater where the follower's rate falls within it."""
        normal, at = self.normal(angle), self.motion.value(angle)
        point = self.contact(angle) if self.is_flat else None

        def rate(lift: Real) -> Real:
            one = np.ones(np.shape(lift))
            way = self.mount.centre([lift, one])[1] if point is None else self.mount.velocity(one, point, [lift])
            return (way * np.conj(normal)).real

        here, wide = rate(at), bound
        for _ in range(_SLACK_STEPS):
            least = np.fmin(np.fmin(rate(at - wide), rate(at + wide)), here)
            wide = bound * np.where(_MOST_SLACK * least > here, here / least, _MOST_SLACK)
        return wide

    def greatest(self, function: Callable[[Real], Real]) -> float:
        """Greatest modulus over the turn of a function of the cam angle that is smooth between joints."""
        ends = [(p.start, np.nextafter(p.end, p.start)) for p in self.motion.pieces]
        return -min(least_value(lambda t: -np.abs(function(t)), a, b) for a, b in ends)

    def member_swing(self, name: str) -> float:
        """By how much the driven member, the coupler or the guiding one turns between its extreme positions, rad."""
        low, high = self.motion.extremes()
        linkage = self.mount.linkage
        if linkage.length(name) is None:
            return 0.0

        def way(lift: Real) -> Complex:
            """Along the member."""
            joint, turn = (x[0] for x in linkage.pose([np.asarray(lift, dtype=float)]))
            if name == "coupler":
                return turn
            ends = joint if name == "driven" else joint + linkage.coupler_length * turn
            return ends - linkage.member(name, low)[0]

        def turned(lift: Real) -> Real:
            return np.angle(way(lift) / way(np.asarray(low)))

        return -least_value(lambda x: -turned(x), low, high) - least_value(turned, low, high)

    def _reach_of(self, piece: LawPiece) -> Real:
        """Places of the contact on the follower, to the right of its direction from the reference point, mm."""
        t = np.linspace(piece.start, np.nextafter(piece.end, piece.start), _REACH_SAMPLES)
        across = np.exp(1j * (self.coupler_angle(t) + self.mount.direction - np.pi / 2))
        return ((self.contact(t) - self.place(t)) * np.conj(across)).real

    def stop(self, point: Complex, normal: Complex, offset: float) -> tuple[Real, Real]:
        """Cam angle at which an outline's (p, n) touches the follower, and its S there; NaN beyond the motion."""
        if self.is_flat:
            wanted, turned = (point * np.conj(normal)).real - offset, np.angle(normal)
            lift = self._lift_at(wanted)
            return self.mount.face([lift])[1][0] - turned, lift
        pitch = point + (self.radius - offset) * normal
        lift = self._lift_at(np.abs(pitch))
        return np.angle(self.mount.centre([lift])[0] / pitch), lift

    def _lift_at(self, wanted: Real) -> Real:
        """S at which the reference point, or the face, stands ``wanted`` mm from the axis."""
        lift, away = self._table()
        with np.errstate(invalid="ignore"):
            found = np.interp(wanted, away, lift, left=np.nan, right=np.nan)
            for _ in range(_NEWTON_STEPS):
                distance, rate = departure(self.mount, self.is_flat, found)
                found = found - (distance - wanted) / rate
        return found

    def _table(self) -> tuple[Real, Real]:
        """S over and a little beyond the motion, as far as the follower moves away, and its distance from the axis."""
        low, high = self.motion.extremes()
        ends = departure(self.mount, self.is_flat, np.array([low, high]))[1]
        under, over = np.maximum(_BEYOND * (high - low), _BEYOND_LENGTH / ends)
        lift = np.linspace(low - under, high + over, _TABLE)
        away, rate = departure(self.mount, self.is_flat, lift)
        with np.errstate(invalid="ignore"):
            good = rate > 0
        middle = int(np.searchsorted(lift, (low + high) / 2))
        stops = np.flatnonzero(~good)
        first = int(stops[stops < middle].max(initial=-1)) + 1
        last = int(stops[stops > middle].min(initial=_TABLE))
        return lift[first:last], away[first:last]

    def lost_lift(self, angle: Real, corner: complex, distance: float) -> Real:
        """How far the follower drops at cam angles where it rests on ``corner`` (cam's frame), mm or rad.

        The first S below its motion's at which it touches; 0 where there is none.
        """
        fixed = (corner * np.exp(1j * angle))[..., None]
        top, low = self.motion.value(angle)[..., None], self._table()[0][0]

        def gap(lift: Real) -> Real:
            if self.is_flat:
                height, normal = self.mount.face([lift])
                return height[0] + distance - (fixed * np.exp(-1j * normal[0])).real
            return np.abs(self.mount.centre([lift])[0] - fixed) - abs(distance)

        share = np.linspace(0.0, 1.0, _DROP_SAMPLES)
        lift = top + (low - top) * share
        with np.errstate(invalid="ignore"):
            under = gap(lift) <= 0
        # where the corner is touched at the motion's own S nothing is lost
        first = np.where(under.any(axis=-1), under.argmax(axis=-1), 0)[..., None]
        below = np.take_along_axis(lift, first, axis=-1)
        above = np.take_along_axis(lift, np.maximum(first - 1, 0), axis=-1)
        above, _ = halved(lambda lift: ~(gap(lift) <= 0), above, below, _BISECTIONS)
        return (top - above)[..., 0]


def departure(mount: CouplerMount, flat: bool, lift: Real) -> tuple[Real, Real]:
    """Distance of the reference point (or face) from the axis at S, mm, and its rate over S; NaN where it cannot be."""
    s = [np.asarray(lift, dtype=float), np.ones(np.shape(lift))]
    if flat:
        height = mount.face(s)[0]
        return height[0], height[1]
    centre = mount.centre(s)
    distance = np.abs(centre[0])
    with np.errstate(invalid="ignore", divide="ignore"):
        return distance, (np.conj(centre[0]) * centre[1]).real / distance


def linkage_cam(
    motion: FollowerMotion,
    kind: FollowerKind,
    linkage: Linkage,
    point: complex,
    *,
    direction: float = 0.0,
    radius: float = 0.0,
) -> LinkageCam:
    """A disk cam about the origin for a follower on a coupler.

    Raises
    ------
    LinkageError
        ``coupler_length``: the linkage does not close all the way; ``lift``: the follower does not move away from the
        axis while S grows (a pressure angle of 90 degrees), or a flat face turns as fast as the cam; ``sense``: it
        comes nearer; ``point``: it reaches the axis; ``direction``: a face that looks away from the axis.
    ParameterError
        ``radius``: none where one is needed, or the other way round.
    """
    low, high = motion.extremes()
    closed = linkage.closed(low, high)
    if closed is None:
        least, most = linkage.coupler_lengths(low, high)
        code = "linkage_comes_apart" if least < most else "linkage_never_closes"
        raise LinkageError("coupler_length", linkage.coupler_length, code, least=least, most=most)
    check_radius(kind, radius)
    cam = LinkageCam(motion, CouplerMount(closed, point, direction), kind, radius)
    _check_way(cam, low, high)
    return cam


def _check_way(cam: LinkageCam, low: float, high: float) -> None:
    """The follower stands off the axis and goes away from it while S grows."""
    flat = cam.is_flat

    def away(lift: Real) -> Real:
        return departure(cam.mount, flat, lift)[0]

    def rate(lift: Real) -> Real:
        return departure(cam.mount, flat, lift)[1]

    if not least_value(away, low, high) > cam.radius:
        if flat and least_value(lambda x: -away(x), low, high) > 0:
            raise LinkageError("direction", cam.mount.direction, "face_looks_away")
        raise LinkageError("point", abs(cam.mount.point), "face_passes_axis" if flat else "follower_reaches_axis")
    if not least_value(rate, low, high) > 0:
        if least_value(lambda x: -rate(x), low, high) > 0:
            raise LinkageError("sense", cam.motion.lift, "follower_comes_nearer")
        raise LinkageError("lift", cam.motion.lift, "pressure_angle_of_90")
    if not flat:
        return
    for piece in cam.motion.pieces:

        def slower(t: Real, piece: LawPiece = piece) -> Real:
            s = [piece.value(t), piece.value(t, 1)]
            return 1 - cam.mount.face(s)[1][1]

        if not piece.is_constant and not least_value(slower, piece.start, piece.end) > 0:
            raise LinkageError("lift", cam.motion.lift, "flat_outruns_cam")


def check_holds(cam: LinkageCam) -> None:
    """A follower on an outline that is a little off still stands near where it should.

    The rate D' of its distance over S changes by |D''| _OFF / D' where the outline is _OFF mm off.

    Raises
    ------
    LinkageError
        ``near``: the linkage nearly stands in line, or the follower nearly stands still while S grows.
    """
    low, high = cam.motion.extremes()
    ends = departure(cam.mount, cam.is_flat, np.array([low, high]))[1]

    def spare(lift: Real) -> Real:
        s = [lift, np.ones(np.shape(lift)), np.zeros(np.shape(lift))]
        if cam.is_flat:
            height = cam.mount.face(s)[0]
            rate, bend = height[1], 2 * height[2]
        else:
            centre = cam.mount.centre(s)
            size = np.abs(centre[0])
            rate = (np.conj(centre[0]) * centre[1]).real / size
            bend = (np.abs(centre[1]) ** 2 + 2 * (np.conj(centre[0]) * centre[2]).real - rate**2) / size
        return np.where(rate > 0, rate, np.nan) ** 2 * _BENT - np.abs(bend) * _OFF

    in_line = cam.mount.linkage.transmission_angle() < _LEAST_TRANSMISSION
    if in_line or not least_value(spare, low - _OFF / ends[0], high + _OFF / ends[1]) > 0:
        raise LinkageError("near", cam.motion.lift, "dead_point_near")


def least_value(function: Callable[[Real], Real], low: float, high: float) -> float:
    """Least value of a smooth function, zoomed in about the least; -inf where it is no number."""
    return -greatest_value(lambda t: -np.nan_to_num(function(t), nan=-np.inf), low, high)
