"""How a follower is guided: along a line or about a pivot. Everything the envelope formulas need, as Taylor series.

The frame is fixed: cam axis at the origin, the cam turns counter-clockwise by the cam angle. A series of S holds
S^(k)/k! over the cam angle, k = 0, 1, 2 ...
"""

from __future__ import annotations

import math

from geometry.base.errors import ParameterError, limit
from geometry.base.record import Record
from geometry.base.series import About, Series, affine, derived, exponential
from geometry.curves.curve import Complex
from geometry.laws.piece import Real


class Translating(Record):
    """Line of motion +y at x = ``offset`` (e, mm); ``start_height`` is the height s_0 at S = 0, mm.

    The height is that of the roller's centre, of the point, or of the flat face. e > 0 lowers the pressure angle of
    the rise.
    """

    offset: float
    start_height: float

    def centre(self, s: Series) -> Series:
        """Path of the reference point: e + i (s_0 + S)."""
        return [self.offset + 1j * (self.start_height + s[0]), *(1j * x for x in s[1:])]

    def centre_bound(self, s: Series, about: About | None = None) -> Series:
        """Bounds of the moduli of that series from those of S."""
        return [abs(self.offset) + abs(self.start_height) + s[0], *s[1:]]

    def face(self, s: Series) -> tuple[Series, Series]:
        """A flat face across the line of motion: its height over the axis and the angle of its upward normal, rad."""
        zero = 0.0 * s[0]
        return [self.start_height + s[0], *s[1:]], [math.pi / 2 + zero, *(zero for _ in s[1:])]

    def face_bound(self, s: Series, about: About | None = None) -> tuple[Series, Series]:
        """Bounds of the series of the face's height and of its normal's rate of turning (one shorter)."""
        return [abs(self.start_height) + s[0], *s[1:]], [0.0 * x for x in s[1:]]

    def velocity(self, rate: Real, point: Complex) -> Complex:
        """Velocity per rad of cam angle of the follower's material at ``point``, where S' is ``rate``."""
        return 1j * rate + 0 * point


class Oscillating(Record):
    """Pivot at +x, ``centre_distance`` d from the axis; psi = ``start_angle`` + S (rad) from the line of centres.

    ``sense`` +1: the follower stands above the line of centres and turns against the cam while it rises; -1: it
    stands below and turns with the cam. ``arm_length`` L reaches to the roller's centre or the point. A flat face
    runs parallel to the arm, ``face_offset`` f nearer to the axis than the pivot's parallel.
    """

    centre_distance: float
    arm_length: float
    start_angle: float
    sense: int = 1
    face_offset: float = 0.0

    def centre(self, s: Series) -> Series:
        """Path of the arm's end: d - L exp(-i sense psi)."""
        turn = exponential([-1j * self.sense * x for x in (self.start_angle + s[0], *s[1:])])
        return affine(self.centre_distance, -self.arm_length, turn)

    def centre_bound(self, s: Series, about: About | None = None) -> Series:
        """Bounds of the moduli of that series from those of S."""
        turn = exponential([0.0 * s[0], *s[1:]])
        return affine(self.centre_distance, self.arm_length, turn)

    def face(self, s: Series) -> tuple[Series, Series]:
        """Distance d sin psi - f of the face from the axis, and the angle of its normal away from the axis, rad."""
        psi = [self.start_angle + s[0], *s[1:]]
        turn = exponential([1j * x for x in psi])
        support = [self.centre_distance * x.imag for x in turn]
        support[0] = support[0] - self.face_offset
        angle = [-self.sense * x for x in psi]
        angle[0] = angle[0] + self.sense * math.pi / 2
        return support, angle

    def face_bound(self, s: Series, about: About | None = None) -> tuple[Series, Series]:
        """Bounds of the series of the face's distance and of its normal's rate of turning (one shorter)."""
        turn = exponential([0.0 * s[0], *s[1:]])
        height = [self.centre_distance * x for x in turn]
        height[0] = height[0] + abs(self.face_offset)
        return height, derived(s)

    def velocity(self, rate: Real, point: Complex) -> Complex:
        """Velocity per rad of cam angle of the follower's material at ``point``, where psi' is ``rate``."""
        return -1j * self.sense * rate * (point - self.centre_distance)


Mount = Translating | Oscillating


def oscillating_start_angle(
    base_circle_radius: float, centre_distance: float, arm_length: float, radius: float = 0.0
) -> float:
    """psi_0 at which the follower's centre stands on the prime circle (``radius`` beyond the base circle), rad.

    Raises
    ------
    ParameterError
        The arm does not reach that circle.
    """
    low, high = abs(centre_distance - arm_length), centre_distance + arm_length
    prime_radius = base_circle_radius + radius
    if not low < prime_radius < high:
        # an arm along the line of centres drives nothing
        margin = 1e-6 * (high - low)
        if base_circle_radius < high - margin <= radius:
            # no base circle brings the centre of so large a roller within reach
            raise ParameterError.beyond("radius", radius, "arm_does_not_reach", high - margin - base_circle_radius)
        nearest = limit((low + margin if prime_radius <= low else high - margin) - radius, base_circle_radius)
        raise ParameterError("base_circle_radius", base_circle_radius, "arm_does_not_reach", nearest)
    # law of cosines, half-angle form: no digits are lost where the arm is nearly along the line of centres
    half = math.sqrt((prime_radius - low) * (prime_radius + low) / (4 * centre_distance * arm_length))
    return 2 * math.asin(min(1.0, half))


def oscillating_prime_radius(start_angle: float, centre_distance: float, arm_length: float) -> float:
    """The prime circle on which the follower's centre stands at psi_0 (rad), mm: ``oscillating_start_angle`` back."""
    return math.hypot(
        centre_distance - arm_length, 2 * math.sqrt(centre_distance * arm_length) * math.sin(start_angle / 2)
    )
