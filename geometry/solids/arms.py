"""Outlines of a hub with arms: a carrier's plate."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from itertools import pairwise

from geometry.base.record import Record
from geometry.curves.line_arc import Arc, Line
from geometry.solids.plate import Edge


class ArmEnd(Record):
    """An arm with a round end: its direction (rad), the end's centre from the axis and its radius, mm."""

    angle: float
    distance: float
    radius: float

    @property
    def centre(self) -> complex:
        """The middle of its round end, mm."""
        return cmath.rect(self.distance, self.angle)


def least_hub(arms: Sequence[ArmEnd]) -> float:
    """The radius of the least hub on which all arms stand beside each other, mm."""
    least = max(arm.radius for arm in arms)
    for one, two in pairwise((*arms, *arms[:1])):
        between = (two.angle - one.angle) % (2 * math.pi) or 2 * math.pi
        low, high = sorted((one.radius, two.radius))
        if math.pi / 2 + math.asin(low / high) > between:
            # where the sides of both meet, by the law of cosines about that point
            square = low**2 + high**2 + 2 * low * high * math.cos(between)
            least = max(least, math.sqrt(square) / math.sin(between))
    return least


def armed_outline(hub: float, arms: Sequence[ArmEnd]) -> tuple[Edge, ...]:
    """The counter-clockwise outline of a hub (radius, mm) with arms in the order of their angles.

    The hub is at least ``least_hub``, and the arms' ends reach beyond it.
    """
    edges: list[Edge] = []
    for arm, following in zip(arms, (*arms[1:], arms[0]), strict=True):
        along = cmath.rect(1.0, arm.angle)
        foot = complex(math.sqrt(hub**2 - arm.radius**2), arm.radius)
        low, high = along * foot.conjugate(), along * foot
        side, end = along * arm.radius * 1j, arm.centre
        # in two, so that the point farthest out is the end of an edge
        edges += [
            Line(low, end - side),
            Arc(end, arm.radius, arm.angle - math.pi / 2, math.pi / 2),
            Arc(end, arm.radius, arm.angle, math.pi / 2),
            Line(end + side, high),
        ]
        start = arm.angle + math.asin(arm.radius / hub)
        stop = following.angle - math.asin(following.radius / hub)
        sweep = (stop - start) % (2 * math.pi)
        if 1e-9 < sweep < 2 * math.pi - 1e-9:
            edges.append(Arc(0j, hub, start, sweep))
    return tuple(edges)
