"""Two centrodes that roll on each other, scaled to whole teeth: the pair that a noncircular gear belongs to.

The perimeters are z_1 and z_2 pitches. A mate of another size closes where the driver's lobes times z_2 / z_1 is whole.
"""

from __future__ import annotations

import math
from functools import cached_property

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record, replace
from geometry.gears.noncircular.pitch_line import DriverShape, MateShape, PitchLine
from geometry.kinematics.centrodes import FourierRatio, LobedEllipse, RatioCentrode, closing_distance

Centrode = LobedEllipse | RatioCentrode
# two parts that are one pair by their keys agree this well
_ALIKE = 1e-9


class Pairing(Record, dict=True):
    """The driver's centrode, the numbers of teeth of driver and mate, and their centre distance, mm."""

    centrode: Centrode
    teeth: tuple[int, int]
    centre_distance: float

    @property
    def lobes(self) -> tuple[int, int]:
        """Lobes of driver and mate."""
        own = centrode_lobes(self.centrode)
        return own, own * self.teeth[1] // self.teeth[0]

    @cached_property
    def lines(self) -> tuple[PitchLine, PitchLine]:
        """Both centrodes by arc length, each in its own frame; contacts have opposite arc lengths."""
        period = 2 * math.pi * self.teeth[1] / self.teeth[0]
        mate = MateShape(self.centrode, self.centre_distance, period)
        even = isinstance(self.centrode, LobedEllipse) or not any(getattr(self.centrode.ratio, "sines", (1.0,)))
        return PitchLine(DriverShape(self.centrode), self.lobes[0], even), PitchLine(mate, self.lobes[1], even)

    @property
    def pitch(self) -> float:
        """p, mm."""
        return self.lines[0].length / self.teeth[0]

    def is_like(self, other: Pairing) -> bool:
        """Whether both are the same pair."""
        if self.teeth != other.teeth or type(self.centrode) is not type(other.centrode):
            return False
        mine, theirs = _numbers(self), _numbers(other)
        return len(mine) == len(theirs) and all(
            math.isclose(a, b, rel_tol=_ALIKE, abs_tol=_ALIKE) for a, b in zip(mine, theirs, strict=True)
        )

    @property
    def is_self_mating(self) -> bool:
        """Whether driver and mate have the same centrode: two focal ellipses, two ovals."""
        return isinstance(self.centrode, LobedEllipse) and self.teeth[0] == self.teeth[1]

    @property
    def twins_mesh(self) -> bool:
        """Whether two drivers mesh with each other: a tooth on the long radius meets a space on the short one."""
        return self.is_self_mating and self.teeth[0] % self.lobes[0] == 0 and self.teeth[0] // self.lobes[0] % 2 == 1


def _numbers(pairing: Pairing) -> tuple[float, ...]:
    one = pairing.centrode
    if isinstance(one, LobedEllipse):
        return (pairing.centre_distance, one.eccentricity, float(one.lobes))
    ratio = one.ratio
    assert isinstance(ratio, FourierRatio)
    return (pairing.centre_distance, float(ratio.lobes), *ratio.cosines, math.inf, *ratio.sines)


def centrode_lobes(centrode: Centrode) -> int:
    """After what part of a turn a centrode is the same again."""
    if isinstance(centrode, LobedEllipse):
        return centrode.lobes
    assert isinstance(centrode.ratio, FourierRatio)
    return centrode.ratio.lobes


def paired(centrode: Centrode, teeth: tuple[int, int], module: float | None, centre_distance: float | None) -> Pairing:
    """The pair of a centrode of any size, scaled to a module or to a centre distance, mm.

    Raises
    ------
    ParameterError
        The mate does not close, or the centres lie too near.
    """
    lobes = centrode_lobes(centrode)
    if lobes * teeth[1] % teeth[0]:
        step = teeth[0] // math.gcd(teeth[0], lobes)
        closing = Nearest(max(1, round(teeth[1] / step)) * step)
        raise ParameterError("mate_number_of_teeth", teeth[1], "mate_does_not_close", closing)
    if isinstance(centrode, RatioCentrode):
        distance = centrode.centre_distance
    elif teeth[0] == teeth[1]:
        distance = 2 * centrode.parameter / (1 - centrode.eccentricity**2)
    else:
        distance = closing_distance(centrode, teeth[0] / teeth[1])
    unit = Pairing(centrode, teeth, distance)
    if centre_distance is None:
        assert module is not None
        scale = math.pi * module * teeth[0] / unit.lines[0].length
    else:
        scale = centre_distance / distance
    if isinstance(centrode, RatioCentrode):
        scaled: Centrode = replace(centrode, centre_distance=distance * scale)
    else:
        scaled = replace(centrode, parameter=centrode.parameter * scale)
    return Pairing(scaled, teeth, distance * scale)
