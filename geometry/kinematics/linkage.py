"""Linkages that carry a follower on their connecting rod: where joints and coupler stand, in closed form.

Joint A is driven: on a rocker whose angle, or on a slider whose way, is the prescribed motion S. Joint B of the
coupler AB moves on a second rocker or slider: the second dyad of an assembly of class II, its position the
intersection of two circles, or of a circle and a line. One of both is the assembly. Series of S hold S^(k)/k!, as
in geometry/cams/motion/guides.py, so that every derivative is exact.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.base.record import Record, replace
from geometry.base.series import (
    About,
    Series,
    affine,
    exponential,
    majorant_power,
    modulus_square,
    power,
    product,
    quotient,
    sharpened,
)
from geometry.laws.piece import Real

# nearer to a dead point than this, rad, a linkage stands in line: the root loses half of its digits there
_IN_LINE = 1e-4


# joint A at the middles of intervals, and half their widths
Middle = tuple[Series, Real]


def _root_bound(radicand: Series, least: Real) -> Series:
    """Bounds of the coefficients of a root where the radicand is at least ``least`` > 0; ``radicand``: their bounds.

    All binomials of (least - P)^(1/2) but the first are negative.
    """
    root = power([least, *(-x for x in radicand[1:])], 0.5)
    return [np.sqrt(radicand[0]), *(-x for x in root[1:])]


def cosine_range(first: float, last: float) -> tuple[float, float]:
    """Least and greatest cosine of the angles from ``first`` to ``last``, rad, in either order."""
    low, high = min(first, last), max(first, last)
    values = (math.cos(low), math.cos(high))
    turn = 2 * math.pi
    least = -1.0 if math.ceil((low - math.pi) / turn) * turn + math.pi <= high else min(values)
    most = 1.0 if math.ceil(low / turn) * turn <= high else max(values)
    return least, most


class RockerDrive(Record):
    """A = pivot + length exp(i (start_angle + sense S)), S in rad; ``sense`` +1: counter-clockwise as S grows."""

    pivot: complex
    length: float
    start_angle: float
    sense: int = 1

    def joint(self, s: Series) -> Series:
        """Joint A, complex, mm."""
        turn = exponential([1j * (self.start_angle + self.sense * s[0]), *(1j * self.sense * x for x in s[1:])])
        return affine(self.pivot, self.length, turn)

    def joint_bound(self, s: Series) -> Series:
        """Bounds of the moduli of that series from those of S."""
        turn = exponential([0.0 * s[0], *s[1:]])
        return affine(abs(self.pivot), self.length, turn)

    def _angles(self, low: float, high: float, direction: float) -> tuple[float, float]:
        return self.start_angle + self.sense * low - direction, self.start_angle + self.sense * high - direction

    def distances(self, point: complex, low: float, high: float) -> tuple[float, float]:
        """Least and greatest |A - point| while S goes from ``low`` to ``high``, mm: law of cosines."""
        away = point - self.pivot
        least, most = cosine_range(*self._angles(low, high, cmath.phase(away)))
        # in squares of the half angle no digits are lost where A comes near the point
        gap, twice = (abs(away) - self.length) ** 2, 2 * abs(away) * self.length
        return math.sqrt(gap + twice * (1 - most)), math.sqrt(gap + twice * (1 - least))

    def heights(self, point: complex, direction: float, low: float, high: float) -> tuple[float, float]:
        """Least and greatest distance of A to the left of a line, mm."""
        middle = ((self.pivot - point) * cmath.exp(-1j * direction)).imag
        least, most = cosine_range(*self._angles(low, high, direction + math.pi / 2))
        return middle + self.length * least, middle + self.length * most


class SliderDrive(Record):
    """A = start + S exp(i direction), S in mm."""

    start: complex
    direction: float

    def joint(self, s: Series) -> Series:
        """Joint A, complex, mm."""
        way = cmath.exp(1j * self.direction)
        return affine(self.start, way, s)

    def joint_bound(self, s: Series) -> Series:
        """Bounds of the moduli of that series from those of S."""
        return [abs(self.start) + s[0], *s[1:]]

    def distances(self, point: complex, low: float, high: float) -> tuple[float, float]:
        """Least and greatest |A - point|: the foot of the point on the way, or the ends."""
        seen = (point - self.start) * cmath.exp(-1j * self.direction)
        nearest = min(max(seen.real, low), high)
        return abs(seen - nearest), max(abs(seen - low), abs(seen - high))

    def heights(self, point: complex, direction: float, low: float, high: float) -> tuple[float, float]:
        """Least and greatest distance of A to the left of a line, mm."""
        back = cmath.exp(-1j * direction)
        ends = [((self.start + cmath.exp(1j * self.direction) * x - point) * back).imag for x in (low, high)]
        return min(ends), max(ends)


# what moves joint A
Drive = RockerDrive | SliderDrive


class RockerGuide(Record):
    """B on a circle of ``length`` about ``pivot``; ``side`` +1: to the left of the line from A to the pivot.

    With q = pivot - A, b the coupler and c the rocker:
    exp(i theta) = q (|q|^2 + b^2 - c^2 + i side sqrt(((b + c)^2 - |q|^2) (|q|^2 - (b - c)^2))) / (2 b |q|^2).
    """

    pivot: complex
    length: float
    side: int = 1

    def turn(self, joint: Series, length: float) -> Series:
        """exp(i theta) of the coupler of ``length`` mm, theta its angle from A to B; NaN where it does not close."""
        way = self._way(joint)
        square = modulus_square(way)
        with np.errstate(invalid="ignore"):
            root = power(self._radicand(square, length), 0.5)
        far = square[0] + (length - self.length) * (length + self.length)
        beside = [far + 1j * self.side * root[0]]
        beside += [x + 1j * self.side * y for x, y in zip(square[1:], root[1:], strict=True)]
        whole = product(way, beside)
        with np.errstate(invalid="ignore"):
            return quotient(whole, [2 * length * x for x in square])

    def _way(self, joint: Series) -> Series:
        """q from joint A to the pivot."""
        return [self.pivot - joint[0], *(-x for x in joint[1:])]

    def _radicand(self, square: Series, length: float) -> Series:
        outer: Series = [(length + self.length) ** 2 - square[0], *(-x for x in square[1:])]
        inner: Series = [square[0] - (length - self.length) ** 2, *square[1:]]
        # beyond its reach the linkage stands nowhere
        outer[0] = np.where((outer[0] > 0) & (inner[0] > 0), outer[0], np.nan)
        return product(outer, inner)

    def turn_bound(self, joint: Series, length: float, room: tuple[float, float], at: Middle) -> Series:
        """Bounds of the moduli of that series from those of A, from ``room`` and from A at the middles.

        The root's binomials alternate but for its first term.
        """
        middle, half = at
        here = self._way(middle)
        way = sharpened([abs(self.pivot) + joint[0], *joint[1:]], here, half)
        square_here = modulus_square(here)
        square = sharpened(product(way, way), square_here, half)
        outer: Series = [(length + self.length) ** 2 + square[0], *square[1:]]
        inner: Series = [(length - self.length) ** 2 + square[0], *square[1:]]
        radicand_here = self._radicand(square_here, length)
        radicand = sharpened(product(outer, inner), radicand_here, half)
        root = _root_bound(radicand, np.maximum(room[0], radicand_here[0] - half * radicand[1]))
        far = abs(length - self.length) * (length + self.length)
        beside = [square[0] + far + root[0], *(x + y for x, y in zip(square[1:], root[1:], strict=True))]
        least = np.maximum(room[1], square_here[0] - half * square[1])
        whole = product(product(way, beside), majorant_power(least, square[1:], -1.0))
        return sharpened(
            [np.ones(np.shape(half)), *(x / (2 * length) for x in whole[1:])], self.turn(middle, length), half
        )

    def room(self, drive: Drive, length: float, low: float, high: float) -> tuple[float, float]:
        """Least value under the root, mm^4, above 0 where the linkage closes all the way; least |q|^2, mm^2.

        The square under the root is concave in |q|^2: least at an end of its range.
        """
        near, far = drive.distances(self.pivot, low, high)
        outer, inner = length + self.length, abs(length - self.length)
        return min((outer - d) * (outer + d) * (d - inner) * (d + inner) for d in (near, far)), near**2

    def transmission_angle(self, room: float, length: float) -> float:
        """Least acute angle between coupler and rocker for that room, rad: sin mu = sqrt(room) / (2 b c)."""
        return math.asin(min(1.0, math.sqrt(max(room, 0.0)) / (2 * length * self.length)))

    def lengths(self, drive: Drive, low: float, high: float) -> tuple[float, float]:
        """Between which lengths a coupler closes all the way, mm, where the first is below the second.

        |b - c| < |q| < b + c.
        """
        near, far = drive.distances(self.pivot, low, high)
        return max(far - self.length, self.length - near, 0.0), self.length + near


class SliderGuide(Record):
    """B on a line through ``point``; ``side`` +1: ahead of A's foot in ``direction`` (rad), -1: behind it.

    With h the distance of A to the left of the line: exp(i theta) = exp(i direction) (side sqrt(b^2 - h^2) - i h) / b.
    """

    point: complex
    direction: float
    side: int = 1

    def turn(self, joint: Series, length: float) -> Series:
        """exp(i theta) of the coupler of ``length`` mm, theta its angle from A to B; NaN where it does not close."""
        height = self._height(joint)
        outer: Series = [length - height[0], *(-x for x in height[1:])]
        inner: Series = [length + height[0], *height[1:]]
        outer[0] = np.where((outer[0] > 0) & (inner[0] > 0), outer[0], np.nan)
        root = power(product(outer, inner), 0.5)
        way = cmath.exp(1j * self.direction) / length
        return [way * (self.side * x - 1j * y) for x, y in zip(root, height, strict=True)]

    def turn_bound(self, joint: Series, length: float, room: tuple[float, float], at: Middle) -> Series:
        """Bounds of the moduli of that series."""
        middle, half = at
        here = self._height(middle)
        height = sharpened([abs(self.point) + joint[0], *joint[1:]], here, half)
        square_here = product(here, here)
        square = sharpened(product(height, height), square_here, half)
        root = _root_bound(square, np.maximum(room[0], length**2 - square_here[0] - half * square[1]))
        rest = [(y + x) / length for x, y in zip(root[1:], height[1:], strict=True)]
        return sharpened([np.ones(np.shape(half)), *rest], self.turn(middle, length), half)

    def _height(self, joint: Series) -> Series:
        """Distance of A to the left of the line."""
        back = cmath.exp(-1j * self.direction)
        return [((joint[0] - self.point) * back).imag, *((x * back).imag for x in joint[1:])]

    def room(self, drive: Drive, length: float, low: float, high: float) -> tuple[float, float]:
        """The same: b^2 - h^2 at the greatest |h|, mm^2; 1, as no line runs from A to a pivot."""
        far = max(abs(h) for h in drive.heights(self.point, self.direction, low, high))
        return (length - far) * (length + far), 1.0

    def transmission_angle(self, room: float, length: float) -> float:
        """Least acute angle between coupler and the guide's normal for that room, rad: sin mu = sqrt(room) / b."""
        return math.asin(min(1.0, math.sqrt(max(room, 0.0)) / length))

    def lengths(self, drive: Drive, low: float, high: float) -> tuple[float, float]:
        """The same: b > |h|."""
        return max(abs(h) for h in drive.heights(self.point, self.direction, low, high)), math.inf


# what guides joint B
Guide = RockerGuide | SliderGuide


class Linkage(Record):
    """Driven joint A, coupler AB of ``coupler_length`` b (mm) and what guides joint B; the frame is the cam's, fixed.

    The coupler's frame has its origin in A and its x axis towards B. ``room``: what ``closed`` proves of the motion.
    """

    drive: Drive
    coupler_length: float
    guide: Guide
    room: tuple[float, float] = (0.0, 0.0)

    def pose(self, s: Series) -> tuple[Series, Series]:
        """Joint A and exp(i theta) of the coupler, complex."""
        joint = self.drive.joint(s)
        return joint, self.guide.turn(joint, self.coupler_length)

    def pose_bound(self, s: Series, about: About) -> tuple[Series, Series]:
        """Bounds of the moduli of both series from those of S and from its series at the middles."""
        middle, half = about
        here = self.drive.joint(middle)
        joint = sharpened(self.drive.joint_bound(s), here, half)
        return joint, self.guide.turn_bound(joint, self.coupler_length, self.room, (here, half))

    def closed(self, low: float, high: float) -> Linkage | None:
        """The linkage with its room for S from ``low`` to ``high``; None where it comes apart or stands in line."""
        room = self.guide.room(self.drive, self.coupler_length, low, high)
        moved = replace(self, room=room)
        return moved if moved.transmission_angle() > _IN_LINE else None

    def coupler_lengths(self, low: float, high: float) -> tuple[float, float]:
        """Between which lengths a coupler closes for S from ``low`` to ``high``, mm."""
        return self.guide.lengths(self.drive, low, high)

    def transmission_angle(self) -> float:
        """Least acute angle at joint B over the motion, rad."""
        return self.guide.transmission_angle(self.room[0], self.coupler_length)

    def member(self, name: str, lift: float) -> tuple[complex, float]:
        """Frame of the driven member, the coupler or the guiding one at S: origin, mm, and angle of its x axis, rad.

        A rocker's origin is its pivot, its x axis runs to its joint; a slider's is its joint.
        """
        joint, turn = (complex(x[0]) for x in self.pose([np.float64(lift)]))
        far = joint + self.coupler_length * turn
        if name == "coupler":
            return joint, cmath.phase(turn)
        of = self.drive if name == "driven" else self.guide
        at = joint if name == "driven" else far
        if isinstance(of, RockerDrive | RockerGuide):
            return of.pivot, cmath.phase(at - of.pivot)
        return at, of.direction

    def length(self, name: str) -> float | None:
        """Length of a member between its joints, mm; None of a slider."""
        if name == "coupler":
            return self.coupler_length
        length: float | None = getattr(self.drive if name == "driven" else self.guide, "length", None)
        return length
