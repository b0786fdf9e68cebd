"""What mates of two gears have in common: the backlash that they are asked for thins the teeth of both."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from geometry.base.errors import Nearest
from geometry.base.nearest import kept, nearest
from geometry.base.record import replace
from parts.base.mate import End, LaidStanding, MateKeys, MateKind, Touching

if TYPE_CHECKING:
    from geometry.base.placement import Placement3
    from geometry.gears.mesh.search import PairContact
    from geometry.kinematics.mechanism import Kind

K = TypeVar("K", bound=MateKeys)
A = TypeVar("A")
B = TypeVar("B")
# one step of a value, of its size or of a largest one: a longer one may pass over all that runs with interruptions
_STEP = 1e-3


def as_far_as_teeth_follow(
    ratio: Callable[[float], float], wanted: float, given: float, toward: float, step: float
) -> Nearest | None:
    """The value nearest to the given one at which the contact ratio is the wanted one; ``step``: a small one there."""
    found = nearest(lambda at: ratio(at) >= wanted, given, toward)
    if found is None or not isinstance(found.value, float):
        return found
    beyond = found.value + math.copysign(_STEP * min(found.value, step), given - found.value)
    # where nearer ones run too, with interruptions, this is no limit, but what to take
    return Nearest(found.value) if kept(lambda at: ratio(at) > 0, beyond) else found


class Meeting(Touching, kw_only=True):
    """Two gears whose axes meet, made for each other; seen from where they do, both turn in opposite senses."""

    rolls: Kind | None = "bevel"
    sense: int = -1
    pair: Any

    # flanks touch along lines: meshes cannot tell
    decides_solids = True
    lies = True
    asks_height = False

    def seen_standing(self, seen: Placement3, apart: float, angle: float, arm: float, reach: float) -> LaidStanding:
        """Of the second as the first sees it, whose tooth is on +x: ``apart`` mm, its axes at ``angle`` if right."""
        from geometry.base.placement import Placement3

        x, y, z = seen.z
        direction = cmath.phase(complex(-x, -y))
        right = self.second_rotation(0.0, direction)
        off = Placement3.towards(self.second_axis(direction), right).inverse() @ seen
        turned = math.remainder(off.turn, math.tau / self.teeth[1])
        play = self.normal_backlash / 2 / arm
        return LaidStanding(apart, math.atan2(math.hypot(x, y), z), angle, turned, play, arm, reach)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch: on the sphere about the apex, or in planes across the pinion's axis."""
        contact: PairContact = self.pair.contact(phase_off, tolerance)
        return contact


class GearPair(MateKind[K, A, B]):
    """Two gears whose teeth ``normal_backlash`` of the keys thins by half of it each."""

    def build(self, end: End[Any]) -> object:
        """A tooth of either, its flank and its ends; raises ``GeometryError`` where there is none."""
        raise NotImplementedError

    def cosine(self, first: End[A], second: End[B]) -> float:
        """Which share of an arc of thinning the backlash of their section is: cos(alpha)."""
        return 1.0

    def normal_share(self, first: End[A], second: End[B]) -> float:
        """j_bn over the backlash of their section."""
        return 1.0

    def there(self, keys: K, first: End[A], second: End[B]) -> float | None:
        """Backlash of their section before it is asked for, mm; None: by their own thinning alone."""
        return None

    def thinning(self, keys: K, first: End[A], second: End[B]) -> tuple[float, float]:
        """What the backlash asks for beyond what is there."""
        wanted: float | None = getattr(keys, "normal_backlash", None)
        if wanted is None:
            return 0.0, 0.0
        from parts.gears.thinning import shared_thinning

        ends: tuple[End[Any], End[Any]] = (first, second)

        def build(index: int, thinning: float) -> object:
            return self.build(replace(ends[index], thing=replace(ends[index].thing, circumferential_thinning=thinning)))

        there, cosine = self.there(keys, first, second), self.cosine(first, second)
        share = self.normal_share(first, second)
        return shared_thinning(wanted, [end.thing for end in ends], build, cosine, there, share)
