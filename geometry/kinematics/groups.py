"""Groups of links whose poses follow from those of others: what a law moves, and dyads of levers (Assur, class II)."""

from __future__ import annotations

import numpy as np

from geometry.base.series import Series, composed, derived, exponential, product, quotient
from geometry.kinematics.linkage import RockerGuide, SliderGuide
from geometry.kinematics.mechanism import FRAME, Group
from geometry.kinematics.motion import PlaneMotion, Pose


def prescribed(link: str, driver: str, motion: PlaneMotion, on: str = FRAME) -> Group:
    """A link that moves on another one as a motion says over the turn (rad) of its driver: a cam and its follower.

    The driver's turn and the motion are those that are seen from the frame of the link ``on``.
    """

    def poses(given: list[Pose]) -> list[Pose]:
        below, (_, turned) = given
        angle = [x - y for x, y in zip(turned, below[1], strict=True)]
        place, turn = motion.pose(angle[0], len(angle) - 1)
        return [_carried(below, (composed(place, angle), composed(turn, angle)))]

    return Group((link,), (on, driver), poses, (1, 1))


def dyad(
    links: tuple[str, str],
    joint: tuple[str, complex],
    guide: tuple[str, RockerGuide | SliderGuide],
    length: float,
) -> Group:
    """A coupler AB of ``length`` (mm) and the rocker or slider that guides its joint B.

    ``joint``: the link that carries A, and A in its frame. ``guide``: the link that carries the guide, and the guide in
    its frame. The coupler's frame has its origin in A and its x axis towards B; a rocker's has them in its pivot and
    towards B, a slider's in B and along its way. NaN where the dyad does not close; the bounds of its series are those
    of the guide.
    """
    rail = guide[1]

    def poses(given: list[Pose]) -> list[Pose]:
        carrier, base = given
        start = _carried(carrier, (_still(joint[1], carrier[0]), _still(0.0, carrier[1])))[0]
        back = exponential([-1j * x for x in base[1]])
        seen = product([a - b for a, b in zip(start, base[0], strict=True)], back)
        unit = rail.turn(seen, length)
        end = [a + length * u for a, u in zip(seen, unit, strict=True)]
        coupler = _carried(base, (seen, _angle(unit)))
        if isinstance(rail, SliderGuide):
            return [coupler, _carried(base, (end, _still(rail.direction, base[1])))]
        arm = [(end[0] - rail.pivot) / rail.length, *(x / rail.length for x in end[1:])]
        return [coupler, _carried(base, (_still(rail.pivot, base[0]), _angle(arm)))]

    return Group(links, (joint[0], guide[0]), poses, (3, 0))


def parallel_cranks(
    link: str, cranks: tuple[str, ...], on: tuple[str, tuple[complex, ...]], arm: tuple[str, complex]
) -> Group:
    """A link that turns as another one does: hung on it by cranks as long as the arm that carries its axis.

    ``on``: the other link, and the cranks' pivots from the arm's axis, in its frame. ``arm``: what carries the axis,
    and where, in its frame; its own axis is its frame's origin, and stands on that other link. Each crank alone leaves
    two turns of the link; three that do not stand in line have only this one in common, so there are no change points.
    """

    def poses(given: list[Pose]) -> list[Pose]:
        base, carrier = given
        end = _carried(carrier, (_still(arm[1], carrier[0]), _still(0.0, carrier[1])))[0]
        found: list[Pose] = [(end, base[1])]
        for pivot in on[1]:
            way = _carried(base, (_still(pivot, base[0]), _still(0.0, base[1])))[0]
            origin = [c + p - b for c, p, b in zip(carrier[0], way, base[0], strict=True)]
            found.append((origin, carrier[1]))
        return found

    return Group((link, *cranks), (on[0], arm[0]), poses, (2 * len(cranks) + 1, 0))


def _still(value: complex | float, like: Series) -> Series:
    return [value + 0.0 * like[0], *(0.0 * x for x in like[1:])]


def _carried(below: Pose, seen: Pose) -> Pose:
    """A pose seen from a frame, as the fixed frame has it."""
    turned = product(exponential([1j * x for x in below[1]]), seen[0])
    return [a + b for a, b in zip(below[0], turned, strict=True)], [
        a + b for a, b in zip(below[1], seen[1], strict=True)
    ]


def _angle(unit: Series) -> Series:
    """The angle of a series of unit vectors, from theta' = -i u' / u."""
    rate = quotient(derived(unit), unit)
    return [np.angle(unit[0]), *(x.imag / (k + 1) for k, x in enumerate(rate))]
