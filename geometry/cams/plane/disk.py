"""Disk cams: what a follower of given shape and guide asks of the cam at every angle.

Frame: axis at the origin, the cam turns counter-clockwise, cam angle 0 at the start of the first phase. Formulas:
practicum, lessons 4 and 5; the general method behind them: tests/oracles/envelope.py, which the tests hold them
against.
"""

from __future__ import annotations

import math
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import Record
from geometry.base.series import Series, taylor
from geometry.cams.motion.follower_motion import TURN, FollowerMotion
from geometry.cams.motion.guides import Mount, Oscillating, Translating, oscillating_start_angle
from geometry.cams.plane.curves import CentreEnvelope, Faced, FaceEnvelope, Lift
from geometry.curves.curve import Complex, Real
from geometry.laws.piece import LawPiece


class FollowerKind(StrEnum):
    """Shape of the follower."""

    POINTED = "pointed"
    ROLLER = "roller"
    MUSHROOM = "mushroom"
    FLAT = "flat"


class DiskCam(Record):
    """A follower's motion, its guide and its shape; ``radius`` of the roller or mushroom, 0 of a point, mm.

    All methods take cam angles (rad) of any shape and are vectorised; at a joint the value from the right.
    """

    motion: FollowerMotion
    mount: Faced
    kind: FollowerKind
    radius: float = 0.0

    @property
    def is_flat(self) -> bool:
        """Whether the follower is a plane."""
        return self.kind is FollowerKind.FLAT

    @property
    def slide(self) -> Translating:
        """The guide of a translating follower; a TypeError of a rocker."""
        if not isinstance(self.mount, Translating):
            raise TypeError("the follower swings")
        return self.mount

    @property
    def swing(self) -> Oscillating:
        """The guide of an oscillating follower; a TypeError of one that translates."""
        if not isinstance(self.mount, Oscillating):
            raise TypeError("the follower translates")
        return self.mount

    @property
    def swings(self) -> bool:
        """Whether S is an angle."""
        return not isinstance(self.mount, Translating)

    @property
    def base_radius(self) -> float:
        """Radius of the base circle, on which the follower stands where S = 0, mm."""
        return float(abs(self._referred([np.zeros(())]))) - self.radius

    def way(self, angle: Real, point: Complex) -> Complex:
        """Velocity of the follower's material at ``point`` (fixed frame) per unit of S, at cam angles."""
        mount: Mount = self.swing if self.swings else self.slide
        return mount.velocity(np.ones(np.shape(angle)), point)

    def curve(self, piece: LawPiece, grow: float = 0.0) -> CentreEnvelope | FaceEnvelope:
        """The exact cam over one piece of the motion, over growing cam angle; ``grow`` mm out of the material."""
        return self._envelope(piece, piece.start, piece.end, grow)

    def table_curve(self, start: float, end: float, grow: float = 0.0) -> CentreEnvelope | FaceEnvelope:
        """The same over any rows of a motion that is a table."""
        return self._envelope(self.motion.stack, start, end, grow)

    def _envelope(self, lift: Lift, start: float, end: float, grow: float) -> CentreEnvelope | FaceEnvelope:
        if self.is_flat:
            return FaceEnvelope(lift, self.mount, start, end, grow)
        return CentreEnvelope(lift, self.mount, start, end, grow - self.radius)

    def reference_point(self, angle: ArrayLike) -> Complex:
        """Roller centre, point, or the foot of the axis on a flat face, in the fixed frame, mm."""
        return self._referred(taylor(self.motion.values(np.asarray(angle, dtype=float), 0)))

    def _referred(self, s: Series) -> Complex:
        """The same where S is given."""
        if not self.is_flat:
            return self.mount.centre(s)[0]
        height, normal = self.mount.face(s)
        return height[0] * np.exp(1j * normal[0])

    def normal(self, angle: ArrayLike) -> Complex:
        """Unit normal of the contact in the fixed frame, from the cam into the follower."""
        s = taylor(self.motion.values(np.asarray(angle, dtype=float), 1))
        if self.is_flat:
            return np.exp(1j * self.mount.face(s)[1][0])
        return _across(self.mount.centre(s))

    def contact(self, angle: ArrayLike) -> Complex:
        """Contact point in the fixed frame, mm."""
        return self.touched(taylor(self.motion.values(np.asarray(angle, dtype=float), 1)))

    def touched(self, s: Series) -> Complex:
        """The same where S and S' are given, mm."""
        if self.is_flat:
            height, normal = self.mount.face(s)
            return np.exp(1j * normal[0]) * (height[0] + 1j * height[1] / (normal[1] - 1.0))
        centre = self.mount.centre(s)
        return centre[0] - self.radius * _across(centre)

    def profile_point(self, angle: ArrayLike) -> Complex:
        """The same point in the cam's frame, mm."""
        at = np.asarray(angle, dtype=float)
        return self.contact(at) * np.exp(-1j * at)

    def pressure_angle(self, angle: ArrayLike) -> Real:
        """Signed pressure angle, rad: positive where tan nu = (S' - e)/(s_0 + S) is.

        Between the normal and the velocity of the roller's centre (the point, the flat face's contact) while it
        rises; of an oscillating roller tan nu = (L (1 + sense psi') - d cos psi)/(d sin psi).
        """
        at = np.asarray(angle, dtype=float)
        point = self.contact(at) if self.is_flat else self.reference_point(at)
        way = self.way(at, point)
        sense = getattr(self.mount, "sense", 1)
        return sense * np.angle(self.normal(at) / way)

    def pitch_curvature_radius(self, angle: ArrayLike) -> Real:
        """Radius of curvature of the centre's path, mm, positive where convex; of the cam itself for a flat face.

        Translating roller: (y^2 + (S' - e)^2)^(3/2) / (y^2 - y S'' + (S' - e)(2 S' - e)), y = s_0 + S. Flat:
        R_b + S + S''.
        """
        at = np.asarray(angle, dtype=float)
        if self.is_flat:
            whole = FaceEnvelope(self.motion, self.mount, 0.0, TURN)
            return whole.stretch(at) / whole.support(at, 1)[1][1]
        with np.errstate(divide="ignore"):
            return -1 / CentreEnvelope(self.motion, self.mount, 0.0, TURN).pitch_curvature(at)

    def curvature_radius(self, angle: ArrayLike) -> Real:
        """Radius of curvature of the cam, mm: positive where it is convex, negative where concave."""
        return self.pitch_curvature_radius(angle) - self.radius

    def face_reach(self) -> tuple[float, float]:
        """Least and greatest place of the contact on the follower's face, mm along it in its direction +x (or along
        the arm, towards the pivot): what a flat or mushroom face must at least cover.

        Translating, flat: S'_min and S'_max, from the axis' height line; the stem stands at x = e.
        """
        low, high = math.inf, -math.inf
        for piece in self.motion.pieces:
            values = self._reach_of(piece)
            low, high = min(low, float(values.min())), max(high, float(values.max()))
        return low, high

    def least_plate_diameter(self) -> float:
        """Least diameter of a round plate about the stem on which the contact of a translating face stays, mm.

        Beyond its edge the follower would ride on the edge and lose lift: the stem's offset counts here.
        """
        offset = self.mount.offset if isinstance(self.mount, Translating) and self.is_flat else 0.0
        low, high = self.face_reach()
        return 2 * max(abs(high - offset), abs(low - offset))

    def follower_pose(self, angle: float, *, on_arm: bool = False, turns: bool = True) -> tuple[complex, float]:
        """Where a follower's frame stands in the cam's fixed frame: its origin, mm, and its turn, rad."""
        if on_arm:
            swung = self.swing.start_angle + float(self.motion.value(angle))
            return complex(self.swing.centre_distance), math.pi - self.swing.sense * swung
        point = complex(self.reference_point(angle))
        # the stem of a flat follower stands on its own line, not over the axis
        return (complex(self.slide.offset, point.imag) if self.is_flat else point), 0.0

    def stop(self, point: Complex, normal: Complex, offset: float) -> tuple[Real, Real]:
        """Cam angle at which an outline's (p, n) touches the follower, and its S there; NaN where it never does."""
        mount = self.mount
        with np.errstate(invalid="ignore"):
            if self.is_flat:
                height, turned = (point * np.conj(normal)).real - offset, np.angle(normal)
                if isinstance(mount, Translating):
                    return np.pi / 2 - turned, height - mount.start_height
                mount = self.swing
                psi = np.arcsin((height + mount.face_offset) / mount.centre_distance)
                return mount.sense * (np.pi / 2 - psi) - turned, psi - mount.start_angle
            pitch = point + (self.radius - offset) * normal
            reach = np.abs(pitch)
            if isinstance(mount, Translating):
                height = np.sqrt((reach - mount.offset) * (reach + mount.offset))
                return np.angle((mount.offset + 1j * height) / pitch), height - mount.start_height
            mount = self.swing
            d, arm = mount.centre_distance, mount.arm_length
            # half-angle form of the law of cosines
            half = (reach - abs(d - arm)) * (reach + abs(d - arm)) / (4 * d * arm)
            psi = 2 * np.arcsin(np.sqrt(half))
            return np.angle((d - arm * np.exp(-1j * mount.sense * psi)) / pitch), psi - mount.start_angle

    def reach_margin(self, angle: Real) -> Real:
        """How far the outline may move, mm, before the follower's guide ends and the follower slips past it."""
        mount = self.mount
        if isinstance(mount, Translating):
            reach = np.full(np.shape(angle), np.inf) if self.is_flat else np.abs(self.reference_point(angle))
            return reach - abs(mount.offset)
        mount = self.swing
        d, arm = mount.centre_distance, mount.arm_length
        if self.is_flat:
            height = mount.face(taylor(self.motion.values(angle, 0)))[0][0] + mount.face_offset
            return d - np.abs(height)
        reach = np.abs(self.reference_point(angle))
        return np.minimum(reach - abs(d - arm), d + arm - reach)

    def slackened(self, angle: Real, bound: Real) -> Real:
        """A linear bound of the lift's error as it stands: the follower's rate does not change with S."""
        return bound

    def _reach_of(self, piece: LawPiece) -> Real:
        if self.is_flat and isinstance(self.mount, Translating):
            return piece.value(piece.extremes(1), 1)
        t = np.linspace(*piece.domain, 257)
        if self.is_flat:
            return -self.swing.sense * FaceEnvelope(piece, self.mount, *piece.domain).reach(t)
        return self.radius * np.sin(self.pressure_angle(np.clip(t, piece.start, np.nextafter(piece.end, 0))))


def _across(centre: Series) -> Complex:
    """Unit normal of a centre's path in the cam's frame, as the fixed frame has it."""
    path = centre[1] - 1j * centre[0]
    return 1j * path / np.abs(path)


def translating_cam(
    motion: FollowerMotion,
    kind: FollowerKind,
    base_circle_radius: float,
    *,
    radius: float = 0.0,
    follower_offset: float = 0.0,
) -> DiskCam:
    """A disk cam whose follower moves along +y at x = ``follower_offset``.

    The prime circle R_p = R_b + radius passes through the lowest roller centre: s_0 = sqrt(R_p^2 - e^2). A flat
    face stands at R_b, and its offset does not enter the profile.

    Raises
    ------
    ParameterError
        A radius that is not positive (of a point: not 0), or an offset beyond the prime circle.
    """
    _check_sizes(kind, base_circle_radius, radius)
    if kind is FollowerKind.FLAT:
        return DiskCam(motion, Translating(follower_offset, base_circle_radius), kind, 0.0)
    prime = base_circle_radius + radius
    if not abs(follower_offset) < prime:
        most = limit(math.copysign(prime * (1 - 1e-6), follower_offset), follower_offset)
        raise ParameterError("follower_offset", follower_offset, "offset_beyond_prime_circle", most)
    height = math.sqrt((prime - follower_offset) * (prime + follower_offset))
    lowest = motion.extremes()[0]
    if not height + lowest > 0:
        least = limit(math.hypot(follower_offset, -lowest) * (1 + 1e-9) - radius, base_circle_radius)
        raise ParameterError("base_circle_radius", base_circle_radius, "follower_passes_axis", least)
    return DiskCam(motion, Translating(follower_offset, height), kind, radius)


def oscillating_cam(
    motion: FollowerMotion,
    kind: FollowerKind,
    base_circle_radius: float,
    *,
    centre_distance: float,
    arm_length: float = 0.0,
    radius: float = 0.0,
    sense: int = 1,
    face_offset: float = 0.0,
) -> DiskCam:
    """A disk cam whose follower swings about a pivot at x = ``centre_distance``; S is psi - psi_0 in rad.

    ``sense``, ``face_offset``: geometry/cams/motion/guides.py. psi_0 follows from the base circle.

    Raises
    ------
    ParameterError
        Sizes that do not meet, a swing beyond the line of centres, or a flat follower that turns as fast as the
        cam or faster, for which no contact exists (1 + sense psi' <= 0).
    """
    _check_sizes(kind, base_circle_radius, radius)
    if sense not in (1, -1):
        raise ParameterError("sense", sense, "no_sense")
    if not centre_distance > 0:
        raise ParameterError("centre_distance", centre_distance, "not_above_zero")
    if kind is FollowerKind.FLAT:
        if not abs(base_circle_radius + face_offset) < centre_distance:
            most = math.copysign(centre_distance, base_circle_radius + face_offset) * (1 - 1e-6) - face_offset
            raise ParameterError.beyond("base_circle_radius", base_circle_radius, "face_beyond_pivot", most)
        start, low = math.asin((base_circle_radius + face_offset) / centre_distance), motion.extremes()[0]
        if not start + low > 0:
            # a face that begins farther from the line of centres does not come over it
            least = centre_distance * math.sin(1e-6 - low) - face_offset
            raise ParameterError.beyond("base_circle_radius", base_circle_radius, "swings_beyond_centres", least)
        slowest = slowest_turning(motion, sense)
        if not slowest > 0:
            # S' goes with the lift
            most = motion.lift / (1 - slowest) * (1 - 1e-6)
            raise ParameterError.beyond("lift", motion.lift, "flat_outruns_cam", most, digits=9)
    else:
        if not arm_length > 0:
            raise ParameterError("arm_length", arm_length, "not_above_zero")
        start = oscillating_start_angle(base_circle_radius, centre_distance, arm_length, radius)
    low, high = motion.extremes()
    if not (start + low > 0 and start + high < math.pi):
        room = min((math.pi - start) / high if high > 0 else math.inf, (start / -low if low < 0 else math.inf))
        raise ParameterError("lift", motion.lift, "swings_beyond_centres", _scaled(motion, room))
    if kind is FollowerKind.FLAT and not start + high < math.pi / 2:
        # the push's arm about the pivot, d cos psi / (1 + psi'), changes its sign there
        raise ParameterError("lift", motion.lift, "face_past_square", _scaled(motion, (math.pi / 2 - start) / high))
    return DiskCam(motion, Oscillating(centre_distance, arm_length, start, sense, face_offset), kind, radius)


def _scaled(motion: FollowerMotion, share: float) -> Nearest | None:
    """The greatest lift, rad, where ``share`` of every S is the most; none where nothing is left of it."""
    return limit(share * (1 - 1e-6) * motion.lift, motion.lift, digits=9) if share > 0 else None


def slowest_turning(motion: FollowerMotion, sense: int) -> float:
    """Least 1 + sense psi' over the turn."""
    low, high = motion.extremes(1)
    return 1 + min(sense * low, sense * high)


def _check_sizes(kind: FollowerKind, base_circle_radius: float, radius: float) -> None:
    if not base_circle_radius > 0 or not math.isfinite(base_circle_radius):
        raise ParameterError("base_circle_radius", base_circle_radius, "not_above_zero")
    check_radius(kind, radius)


def check_radius(kind: FollowerKind, radius: float) -> None:
    """A roller and a mushroom have a radius, mm; a point and a face have none.

    Raises
    ------
    ParameterError
        ``radius``.
    """
    if kind in (FollowerKind.ROLLER, FollowerKind.MUSHROOM):
        if not radius > 0 or not math.isfinite(radius):
            raise ParameterError("radius", radius, "follower_without_radius", end=str(kind))
    elif radius != 0:
        raise ParameterError("radius", radius, "follower_has_no_radius", Nearest(0.0), end=str(kind))
