"""Groups of links whose poses follow from those of others: a link on parallel cranks."""

from __future__ import annotations

from geometry.base.series import Series, exponential, product
from geometry.kinematics.mechanism import Group
from geometry.kinematics.motion import Pose


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
