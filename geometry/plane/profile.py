"""Closed chains of exact curves: one period of a profile, placed ``count`` times, and regions of them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from enum import StrEnum
from functools import cached_property

import numpy as np

from geometry.base.errors import DisconnectedProfileError
from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.line_arc import Arc


class Label(StrEnum):
    """What a segment is for: layers, findings and measurements go by it."""

    ROOT_LAND = "root_land"
    ROOT_FILLET = "root_fillet"
    FLANK = "flank"
    RELIEF = "tip_relief"
    TIP_BREAK = "tip_break"
    TIP_LAND = "tip_land"
    CORNER = "corner_arc"
    BORE = "bore"
    HUB = "hub"
    RIM = "rim"
    KEYWAY = "keyway"
    FLAT = "bore_flat"
    HOLE = "lightening_hole"
    WINDOW = "spoke_window"
    BODY = "body"
    CAM = "cam"
    DWELL = "dwell"
    LOBE = "lobe"
    PIN = "pin"


class Segment(Record):
    """One exact curve with its meaning."""

    curve: Curve
    label: Label


class Profile(Record, dict=True):
    """A closed chain: the segments of one period, repeated ``count`` times about the origin.

    Period k is period 0 turned by 2 pi k / count, the other way round where ``clockwise`` (a toothed hole). The joins
    are checked when the profile is made.
    """

    period: tuple[Segment, ...]
    count: int = 1
    clockwise: bool = False

    def __post_init__(self) -> None:
        starts = [start_point(s.curve) for s in self.period]
        ends = [end_point(s.curve) for s in self.period]
        starts.append(starts[0] * cmath.exp(1j * self.pitch_angle))
        allowed = TOLERANCES.relative_join * max(map(abs, starts))
        for index, end in enumerate(ends):
            gap = abs(end - starts[index + 1])
            if not gap <= allowed:
                raise DisconnectedProfileError(index + 1, gap)

    @property
    def pitch_angle(self) -> float:
        """Angle from one period to the next, rad; negative where clockwise."""
        return (-2 if self.clockwise else 2) * math.pi / self.count

    def segments(self) -> Iterator[Segment]:
        """All segments in order of travel."""
        for k in range(self.count):
            placement = Placement2(self.pitch_angle * k)
            for segment in self.period:
                yield segment if k == 0 else Segment(segment.curve.placed(placement), segment.label)

    def placed(self, placement: Placement2) -> Profile:
        """The profile turned about the origin; one of a single period may be moved too."""
        return Profile(
            tuple(Segment(s.curve.placed(placement), s.label) for s in self.period), self.count, self.clockwise
        )

    def reach(self) -> float:
        """Greatest distance of a segment end from the origin, mm."""
        return self._reach

    @cached_property
    def _reach(self) -> float:
        return max(abs(start_point(s.curve)) for s in self.period)


class Region(Record):
    """Material of a plane section: outer boundary counter-clockwise, holes clockwise (material on the left).

    ``marks``: boundaries that do not go through, like the walls of a groove with a floor; engraved, not cut.
    ``apart``: outer boundaries of further pieces that lie beside the first, without holes.
    ``strokes``: open chains of straight lines, a name in single strokes; engraved, and first of all.
    """

    outer: Profile
    holes: tuple[Profile, ...] = ()
    marks: tuple[Profile, ...] = ()
    apart: tuple[Profile, ...] = ()
    strokes: tuple[tuple[complex, ...], ...] = ()

    def profiles(self) -> tuple[Profile, ...]:
        """Marks, then holes, then the outer boundaries: the order in which they are cut."""
        return (*self.marks, *self.holes, *self.apart, self.outer)

    def layers(self) -> tuple[str, ...]:
        """The layer of each of these in a cutting file."""
        inner = (*("ENGRAVE" for _ in self.marks), *("CUT_INNER" for _ in self.holes))
        return (*inner, *("CUT_OUTER" for _ in (*self.apart, self.outer)))


def circle(radius: float, label: Label, *, hole: bool = False, centre: complex = 0j) -> Profile:
    """A full circle about ``centre``; a hole runs clockwise."""
    half = math.pi if not hole else -math.pi
    upper, lower = Arc(centre, radius, 0.0, half), Arc(centre, radius, half, half)
    return Profile((Segment(upper, label), Segment(lower, label)))


def joint_turn(before: Curve, after: Curve) -> float:
    """Angle by which the tangent turns at a joint, rad; positive is a convex corner of the material."""
    arriving = complex(before.tangent(before.domain[1]))
    leaving = complex(after.tangent(after.domain[0]))
    return float(np.angle(leaving / arriving))
