"""Timing belts by designation, and the grooves of their pulleys: straight flanks, or arcs that follow one another.

ISO 5294 (MXL to XXH), ISO 17396 and DIN 7721 (T and AT), ISO 13050 (3M to 14M, HTD) and the arcs of 2GT to 5GT.
Frame of a groove: the pulley's axis is the origin, the groove's middle lies on +x; its upper half is told, from the
bottom to the outer circle, material on the left.
"""

from __future__ import annotations

import cmath
import math
import re
from difflib import get_close_matches
from functools import cache
from typing import NamedTuple

from geometry.base.record import Record
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Segment

# pitch, pitch line over the outer circle a, depth h_g, width at the floor b_w (ISO 5294, AT) or between the corners on
# the outer circle b_r (T, M), angle between the flanks 2 phi deg, root radius r_b (at most), tip radius r_t, mm;
# teeth up to which the row holds (0: all), least number of teeth. Of T pulleys 2a is that of makers' tables of these
# grooves, of AT ones what makers' outer diameters have
_STRAIGHT = """
MXL 2.032 0.254 0.69 floor 0.84 40 0.25 0.13 0 10
XL 5.08 0.254 1.65 floor 1.32 50 0.41 0.64 0 10
L 9.525 0.381 2.67 floor 3.05 40 1.19 1.17 0 10
H 12.7 0.686 3.05 floor 4.19 40 1.60 1.60 0 14
XH 22.225 1.397 7.14 floor 7.90 40 1.98 2.39 0 18
XXH 31.75 1.524 10.31 floor 12.17 40 3.96 3.18 0 18
T2.5 2.5 0.265 0.75 corners 1.75 50 0.2 0.3 20 10
T2.5 2.5 0.265 1.00 corners 1.83 50 0.2 0.3 0 10
T5 5 0.425 1.25 corners 2.96 50 0.4 0.6 20 10
T5 5 0.425 1.95 corners 3.32 50 0.4 0.6 0 10
T10 10 0.925 2.60 corners 6.02 50 0.6 0.8 20 12
T10 10 0.925 3.40 corners 6.57 50 0.6 0.8 0 12
T20 20 1.425 5.20 corners 11.65 50 0.8 1.2 20 15
T20 20 1.425 6.00 corners 12.60 50 0.8 1.2 0 15
AT5 5 0.615 1.10 floor 2.70 50 0.3 0.4 0 15
AT10 10 0.925 2.35 floor 5.40 50 0.4 0.7 0 15
3M 3 0.381 1.22 corners 1.90 14 0.91 0.30 0 10
5M 5 0.572 2.06 corners 3.25 14 1.56 0.48 0 12
8M 8 0.686 3.45 corners 5.35 14 2.57 0.80 0 22
14M 14 1.397 6.00 corners 9.80 14 4.65 1.40 0 28
"""
# pitch, a, depth, radii of floor and flank, how far the flank's centre stands beyond the middle, tip radius, mm, least
# number of teeth
_ARCS = """
2GT 2 0.254 0.75 0.555 1.00 0.40 0.15 10
3GT 3 0.381 1.14 0.85 1.52 0.61 0.25 10
5GT 5 0.5715 1.93 1.44 2.57 1.03 0.416 12
"""
# as people write them: the pitch before or after the name; GT2 with a pitch behind it is the series of its maker
_PITCH_NAMES = (
    (re.compile(r"HTD(\d+)M{0,2}|(\d+)M{0,2}HTD"), "M"),
    (re.compile(r"GT[23](\d)MM?R?|(\d)MM?GT[23]?|GT(\d)"), "GT"),
)
# of the way along the flank that the root fillet may take, beside the tip rounding
_FILLET_SHARE = 0.9


class Half(NamedTuple):
    """The upper half of a groove, ``land``: polar angle at which it ends on the outer circle, rad."""

    segments: tuple[Segment, ...]
    land: float


class StraightGroove(Record):
    """A groove with straight flanks ``half_angle`` (rad) off its middle, lengths in mm.

    ``width``: at the floor (``at_floor``), else between the corners of flanks and outer circle. ``root_radius``: at
    most, less where floor or flank are too short for it.
    """

    width: float
    depth: float
    half_angle: float
    root_radius: float
    tip_radius: float
    at_floor: bool = False

    def _flank(self, outer: float, moved: float) -> tuple[complex, complex]:
        """A place on the flank, moved into the material, and its direction outwards."""
        way, half = cmath.rect(1.0, self.half_angle), self.width / 2
        radius = outer - self.depth if self.at_floor else math.sqrt((outer - half) * (outer + half))
        return complex(radius, half) + moved * 1j * way, way

    def width_of(self, outer: float, walls: float) -> float:
        """At the floor, or between the corners, with its walls moved into the material, mm."""
        place, way = self._flank(outer, walls)
        if self.at_floor:
            end: float | None = (outer - self.depth - walls - place.real) / way.real
        else:
            end = _rounded_tip(place, way, outer, 0.0)
        assert end is not None
        return 2 * (place + end * way).imag

    def _fillet(self, outer: float) -> float:
        """The root radius, mm."""
        place, way = self._flank(outer, 0.0)
        foot = (outer - self.depth - place.real) / way.real
        tip = _rounded_tip(place, way, outer, self.tip_radius)
        room = (place + foot * way).imag
        if tip is not None:
            room = min(room, _FILLET_SHARE * (tip - foot))
        return min(self.root_radius, max(room, 0.0) / math.tan((math.pi / 2 - self.half_angle) / 2))

    def half(self, outer: float, walls: float = 0.0, inset: float = 0.0) -> Half | None:
        """With its walls moved into the material, the outer circle by ``inset``, mm; None: there is none."""
        if not self.width / 2 < outer:
            return None
        (place, way), floor = self._flank(outer, walls), outer - self.depth - walls
        foot, radius = (floor - place.real) / way.real, self._fillet(outer) + walls
        rounding = max(self.tip_radius - inset, 0.0)
        tip = _rounded_tip(place, way, outer - inset, rounding)
        taken = radius * math.tan((math.pi / 2 - self.half_angle) / 2)
        corner = place + foot * way
        flat = corner.imag - taken
        if tip is None or not floor > 0 or not flat > -_rounding(outer) or tip <= foot + taken:
            return None
        begins, ends = place + (foot + taken) * way, place + tip * way
        segments = list[Segment]()
        if flat > _rounding(outer):
            segments.append(Segment(Line(complex(floor), complex(floor, flat)), Label.ROOT_FILLET))
        if radius > 0:
            centre = complex(floor + radius, max(flat, 0.0))
            segments.append(Segment(Arc(centre, radius, math.pi, self.half_angle - math.pi / 2), Label.ROOT_FILLET))
        segments.append(Segment(Line(begins, ends), Label.FLANK))
        return _landed(segments, ends, ends + rounding * 1j * way, rounding)


class ArcGroove(Record):
    """A groove whose floor is an arc and whose flanks are wider ones, tangent to it, lengths in mm.

    ``flank_offset``: how far the centre of a flank stands on the other side of the middle.
    """

    depth: float
    floor_radius: float
    flank_radius: float
    flank_offset: float
    tip_radius: float

    def half(self, outer: float, walls: float = 0.0, inset: float = 0.0) -> Half | None:
        """With its walls moved into the material, the outer circle by ``inset``, mm; None: there is none."""
        floor, rise = outer - self.depth + self.floor_radius, self.flank_radius - self.floor_radius
        centre = complex(floor + math.sqrt((rise - self.flank_offset) * (rise + self.flank_offset)), -self.flank_offset)
        radius, rounding = self.flank_radius + walls, max(self.tip_radius - inset, 0.0)
        tip = _crossing(outer - inset - rounding, centre, radius + rounding)
        if tip is None or not outer - self.depth - walls > 0:
            return None
        low, high = cmath.phase(floor - centre), cmath.phase(tip - centre)
        if not high < low:
            return None
        segments = [Segment(Arc(complex(floor), self.floor_radius + walls, math.pi, low - math.pi), Label.ROOT_FILLET)]
        segments.append(Segment(Arc(centre, radius, low, high - low), Label.FLANK))
        return _landed(segments, centre + cmath.rect(radius, high), tip, rounding)


def _rounding(outer: float) -> float:
    """What is no length, mm."""
    return 1e-12 * outer


def _rounded_tip(place: complex, way: complex, outer: float, rounding: float) -> float | None:
    """How far along a flank its tip rounding begins, which is tangent to the outer circle; None: nowhere."""
    centre = (place + rounding * 1j * way) / way
    under = (outer - rounding) ** 2 - centre.imag**2
    return math.sqrt(under) - centre.real if under >= 0 else None


def _crossing(radius: float, centre: complex, other: float) -> complex | None:
    """The upper one of the places where a circle about the axis crosses another; None: they do not."""
    far = abs(centre)
    along = (far**2 + radius**2 - other**2) / (2 * far)
    if not radius > abs(along):
        return None
    return centre / far * complex(along, math.sqrt((radius - along) * (radius + along)))


def _landed(segments: list[Segment], end: complex, tip: complex, rounding: float) -> Half:
    """The half, with its tip rounding about ``tip``."""
    land = cmath.phase(tip)
    if rounding > 0:
        starts = cmath.phase(end - tip)
        # a convex corner turns to the left, from the flank to the outer circle
        segments.append(Segment(Arc(tip, rounding, starts, (land - starts) % (2 * math.pi)), Label.TIP_BREAK))
    return Half(tuple(segments), land)


class Belt(Record):
    """A timing belt: its pitch, how far its pitch line lies over the outer circle of a pulley, mm, and its grooves.

    ``few``: of pulleys up to ``few_teeth`` teeth. ``least_teeth``: fewer ones bend it too much.
    """

    pitch: float
    line_offset: float
    groove: StraightGroove | ArcGroove
    few: StraightGroove | None = None
    few_teeth: int = 0
    least_teeth: int = 0

    def groove_of(self, teeth: int) -> StraightGroove | ArcGroove:
        """The groove of a pulley with so many teeth."""
        return self.few if self.few is not None and teeth <= self.few_teeth else self.groove


@cache
def belts() -> dict[str, Belt]:
    """Every belt by its designation."""
    found: dict[str, Belt] = {}
    of_few: dict[str, tuple[StraightGroove, int]] = {}
    for name, *cells in (line.split() for line in _STRAIGHT.split("\n") if line):
        pitch, offset, depth, width, angle, root, tip = (float(cells[k]) for k in (0, 1, 2, 4, 5, 6, 7))
        groove = StraightGroove(width, depth, math.radians(angle / 2), root, tip, at_floor=cells[3] == "floor")
        if most := int(cells[8]):
            of_few[name] = groove, most
            continue
        few, most = of_few.get(name, (None, 0))
        found[name] = Belt(pitch, offset, groove, few, most, int(cells[9]))
    for name, *cells in (line.split() for line in _ARCS.split("\n") if line):
        pitch, offset, *sizes = map(float, cells[:-1])
        found[name] = Belt(pitch, offset, ArcGroove(*sizes), least_teeth=int(cells[-1]))
    return found


def belt_of(designation: str) -> Belt | None:
    """The belt of a designation as people write it: T5, HTD 5M, GT2, GT2-2M, 2MGT; None: there is none."""
    return belts().get(_plain(designation))


def _plain(designation: str) -> str:
    """As the table has it."""
    name = re.sub(r"[\s_-]|POWERGRIP", "", designation.upper().replace(",", "."))
    for pattern, letters in _PITCH_NAMES:
        if found := pattern.fullmatch(name):
            return next(pitch for pitch in found.groups() if pitch) + letters
    return name


def _pitch_told(name: str) -> str:
    """What of a plain designation tells the pitch: its number, or all its letters where it has none."""
    return re.sub(r"[^\d.]", "", name) or "".join(sorted(name))


def like_belt(designation: str) -> str | None:
    """The designation in the table that begins another one, else of that pitch is most like it; None: none is."""
    begins = (_plain(designation[:end]) for end in range(len(designation), 0, -1))
    alike = [name for name in belts() if _pitch_told(name) == _pitch_told(_plain(designation))]
    found = get_close_matches(_plain(designation), alike, 1, 0.5)
    return next((name for name in begins if name in belts()), found[0] if found else None)
