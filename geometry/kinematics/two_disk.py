"""The power module of the thesis: disk 3 turns in disk 2 off its axis, the platform in disk 3 off its.

O1 is the axis of disk 2 and the origin, O2 that of disk 3, O3 the platform's. As in the thesis delta is counted from
+y towards +x to O1O2, beta between O2O1 and O2O3, here with a sign: that of the elbow. With u = exp(-i delta) i along
O1O2, O3 = u (L1 - L2 exp(i beta)); disk 2 turns by -delta, disk 3 by beta - delta, counter-clockwise.

::

    table = TwoDisk()
    delta, beta = table.inverse(50 + 80j)         # rad; elbow=-1 for the other one
    table.drives(delta, beta)                     # turns of the worms I and II

The motion itself is the layer's: ``TwoDisk.mechanism`` gives links, joints and gear equations.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.kinematics.groups import parallel_cranks
from geometry.kinematics.mechanism import FRAME, Fixed, Joint, Mechanism, Revolute, Rolling

# how far beyond the rim a point is taken for one on it: share of the reach
_RIM = 1e-13
# sin beta below which no finite turning gives a velocity across the singular circle
_SINGULAR = 1e-12
Orientation = Literal["thesis", "idlers", "cranks"]


class TwoDisk(Record):
    """``arms``: L1 = O1O2 and L2 = O2O3, mm; ``teeth`` of disk 3's pinion 11 and of the ring 12; ``worm_ratios``:
    teeth of the worm wheels I (disk 2) and II (the ring) for one start.
    """

    arms: tuple[float, float] = (72.0, 72.0)
    teeth: tuple[int, int] = (96, 144)
    worm_ratios: tuple[int, int] = (128, 106)

    @property
    def reach(self) -> tuple[float, float]:
        """Radii of the singular circles, between which O3 stands; 0: the singular centre."""
        return abs(self.arms[0] - self.arms[1]), self.arms[0] + self.arms[1]

    @property
    def ratio(self) -> float:
        """Turns of disk 3 against disk 2 for one of the ring against disk 2."""
        return self.teeth[1] / self.teeth[0]

    def inverse(self, point: Complex | complex, elbow: int = 1, keep: float = 0.0) -> tuple[Real, Real]:
        """delta and beta (rad) that bring O3 to points (mm); at O1 itself delta is ``keep``.

        beta = 2 atan2(sqrt(r² - (L1 - L2)²), sqrt((L1 + L2)² - r²)), no difference of near numbers in it.

        Raises
        ------
        ParameterError
            The first point that is not finite, or out of reach, with the nearest one that is not.
        """
        point = np.asarray(point, dtype=complex)
        (one, two), (least, most) = self.arms, self.reach
        far = np.hypot(point.real, point.imag)
        self._check_reach(point, far)
        # on a rim within rounding
        inner, outer = np.maximum((far - least) * (far + least), 0), np.maximum((most - far) * (most + far), 0)
        sine, cosine = np.sqrt(inner), np.sqrt(outer)
        half = np.arctan2(sine, cosine)
        # the angle at O1 by the law of tangents: as large as that at O3 where the arms are alike
        at_1 = math.pi / 2 - half
        if one != two:
            at_1 += np.arctan((two - one) / most * (cosine / np.maximum(sine, 1e-300)))
        beta, delta = 2 * half, np.arctan2(point.real, point.imag) - elbow * at_1
        if least == 0 and not far.all():
            delta = np.where(far == 0, keep, delta)
        return delta, elbow * beta

    def _check_reach(self, point: Complex, far: Real) -> None:
        least, most = self.reach
        if not np.isfinite(far).all():
            at = complex(point[~np.isfinite(far)][0])
            raise ParameterError("x, y", [at.real, at.imag], "not_finite")
        outside = (far > most * (1 + _RIM)) | (far < least - most * _RIM)
        if outside.any():
            index = np.unravel_index(int(np.argmax(outside)), outside.shape)
            at = complex(point[index])
            way = at / abs(at) if at else 1j
            near = way * min(max(abs(at), least), most)
            # by six digits, on the side of what is in reach
            inwards = math.floor if abs(at) > most else math.ceil
            near_to = [math.copysign(inwards(round(abs(v) * 1e6, 3)) / 1e6, v) for v in (near.real, near.imag)]
            raise ParameterError(
                "x, y", [at.real, at.imag], "out_of_reach", Nearest(near_to),
                least=least, most=most, distance=abs(at),
            )  # fmt: skip

    def forward(self, delta: Real | float, beta: Real | float) -> Complex:
        """O3, mm."""
        one, two = self.arms
        half = np.asarray(beta) / 2
        sine, cosine = np.sin(half), np.cos(half)
        # L1 - L2 exp(i beta), no digits lost where it is small
        arm = one - two + 2 * two * sine * (sine - 1j * cosine)
        return np.asarray(1j * np.exp(-1j * np.asarray(delta)) * arm)

    def drives(self, delta: Real | float, beta: Real | float) -> tuple[Real, Real]:
        """Turns of the worms: I turns disk 2 by delta, II the ring by delta - beta / ratio, both from +y towards +x."""
        turns = np.asarray(delta) / (2 * math.pi), (np.asarray(delta) - np.asarray(beta) / self.ratio) / (2 * math.pi)
        return turns[0] * self.worm_ratios[0], turns[1] * self.worm_ratios[1]

    def angles(self, first: Real | float, second: Real | float) -> tuple[Real, Real]:
        """delta and beta (rad) by the turns of both worms."""
        delta = 2 * math.pi * np.asarray(first) / self.worm_ratios[0]
        return delta, self.ratio * (delta - 2 * math.pi * np.asarray(second) / self.worm_ratios[1])

    def jacobian(self, delta: Real | float, beta: Real | float) -> tuple[Complex, Complex]:
        """d O3 / d delta with beta held, and d O3 / d beta, mm/rad; their cross product is L1 L2 sin beta."""
        turned = np.exp(1j * (np.asarray(beta) - np.asarray(delta)))
        return -1j * self.forward(delta, beta), self.arms[1] * turned

    def drive_jacobian(self, delta: Real | float, beta: Real | float) -> tuple[Complex, Complex]:
        """d O3 for the turn of disk 2 with the ring held, and of the ring with disk 2 held, mm/rad."""
        both, own = self.jacobian(delta, beta)
        return both + self.ratio * own, -self.ratio * own

    def motion(
        self, delta: Real | float, beta: Real | float, rates: tuple[float, float], second: tuple[float, float]
    ) -> tuple[Complex, Complex]:
        """Velocity and acceleration of O3 by rates of delta and beta, rad/s, and their own, rad/s²."""
        both, own = self.jacobian(delta, beta)
        turn_2, turn_3 = -rates[0], rates[1] - rates[0]
        velocity = both * rates[0] + own * rates[1]
        # O1O2 and O2O3 are (both + own) i and -own i
        towards = -1j * ((both + own) * turn_2**2 - own * turn_3**2)
        return velocity, both * second[0] + own * second[1] + towards

    def rates(
        self, delta: float, beta: float, velocity: complex, acceleration: complex = 0j
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Rates of delta and beta, and their own, for a velocity (mm/s) and an acceleration (mm/s²) of O3.

        Raises
        ------
        ParameterError
            On a singular circle or at the centre O3 moves along one line only.
        """
        both, own = (complex(x) for x in self.jacobian(delta, beta))
        across = (both.conjugate() * own).imag
        if abs(across) < _SINGULAR * self.arms[0] * self.arms[1]:
            raise ParameterError("point", abs(complex(self.forward(delta, beta))), "singular_point")

        def solved(wanted: complex) -> tuple[float, float]:
            return (wanted.conjugate() * own).imag / across, (both.conjugate() * wanted).imag / across

        first = solved(velocity)
        return first, solved(acceleration - complex(self.motion(delta, beta, first, (0.0, 0.0))[1]))

    def platform_turn(self, beta: Real | float, wheels: tuple[int, int] = (36, 36)) -> Real:
        """What the thesis's wheels 6, 7, 8 turn the platform by, counter-clockwise, since beta = 0, rad.

        phi6 = (1 + r8 / r6) (phi3 - phi2), ``wheels``: teeth of 6 (and 7) and of 8.
        """
        return (1 + wheels[1] / wheels[0]) * np.asarray(beta)

    def torques(self, delta: Real | float, beta: Real | float, force: Complex | complex) -> tuple[Real, Real]:
        """By what torques, N mm, in the sense of delta, disk 2 and ring hold a force (N) on O3: by virtual work."""
        one, two = self.drive_jacobian(delta, beta)
        force = np.conj(force)
        return -np.real(one * force), -np.real(two * force)

    def mesh_force(self, along: Complex, moment: Real, pressure_angle: float) -> tuple[Complex, Complex]:
        """What the ring does to the pinion against a moment (N mm) about O2, and where, without friction.

        ``along``: unit vectors from O1 to O2. The mesh is at the pitch point, r_1 = L1 / (ratio - 1) beyond O2; its
        radial part pushes the pinion to O1.
        """
        radius = self.arms[0] / (self.ratio - 1)
        across = -np.asarray(moment) / radius
        force = (1j * across - np.abs(across) * math.tan(pressure_angle)) * along
        return np.asarray(force), np.asarray((self.arms[0] + radius) * along)

    def mechanism(self, orientation: Orientation = "cranks", wheels: tuple[int, int] = (36, 36)) -> Mechanism:
        """The links as they stand at delta = 0, beta = pi (O3 farthest, on +y); drives are worm_1 and worm_2.

        Worms turn counter-clockwise about -y and x as delta and the ring's turn grow. ``wheels``: teeth of 6 and 8 of
        the thesis; of the other orientations all have 24, 12 of them idlers.
        """
        second, third = 1j * self.arms[0], 1j * sum(self.arms)
        first_ratio, second_ratio = self.worm_ratios
        joints: tuple[Joint, ...] = (
            Revolute("disk_2"),
            Revolute("ring"),
            Revolute("disk_3", on="disk_2", at=second),
            Revolute("worm_1", at=1j, axis=(1.0, 0.0, 0.0)),
            Revolute("worm_2", at=1j, axis=(1.0, 0.0, 0.0)),
            Rolling("worm", "worm_1", "disk_2", (1, first_ratio), sense=-1),
            Rolling("worm", "worm_2", "ring", (1, second_ratio), sense=-1),
            Rolling("internal", "disk_3", "ring", self.teeth, on="disk_2"),
        )
        return Mechanism(joints + _platform(orientation, wheels, second, third))


def _platform(orientation: Orientation, wheels: tuple[int, int], second: complex, third: complex) -> tuple[Joint, ...]:
    """What turns the platform, whose axis stands on disk 3."""
    platform = Revolute("platform", on="disk_3", at=third)
    if orientation == "cranks":
        pivots = tuple(51.0 * np.exp(2j * math.pi * k / 3) for k in range(3))
        return (
            parallel_cranks("flange", ("crank_1", "crank_2", "crank_3"), (FRAME, pivots), ("disk_2", second)),
            parallel_cranks(
                "platform", ("crank_4", "crank_5", "crank_6"), ("flange", pivots), ("disk_3", third - second)
            ),
        )
    central = Fixed("wheel_7")
    satellite = Revolute("wheel_8", on="disk_2", at=second)
    if orientation == "thesis":
        return (
            central, satellite, platform,
            Rolling("external", "wheel_7", "wheel_8", wheels, on="disk_2"),
            Rolling("external", "wheel_8", "platform", wheels[::-1], on="disk_3"),
        )  # fmt: skip
    idlers = (
        Revolute("idler_1", on="disk_2", at=second / 2),
        Revolute("idler_2", on="disk_3", at=(second + third) / 2),
    )
    return (
        central, satellite, platform, *idlers,
        Rolling("external", "wheel_7", "idler_1", (24, 12), on="disk_2"),
        Rolling("external", "idler_1", "wheel_8", (12, 24), on="disk_2"),
        Rolling("external", "wheel_8", "idler_2", (24, 12), on="disk_3"),
        Rolling("external", "idler_2", "platform", (12, 24), on="disk_3"),
    )  # fmt: skip
