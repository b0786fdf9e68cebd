"""Where a flat part has room for its name: the highest letters inside clear material, else on a tag beside it."""

from __future__ import annotations

import math
from itertools import count, takewhile
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from geometry.approximation.chords import approximate_profile
from geometry.base.findings import Finding
from geometry.base.record import replace
from geometry.curves.curve import Real
from geometry.plane.letters import HELD, Stroke, lettered
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Profile, Region
from geometry.solids.plate import PlateOutline, rounded

if TYPE_CHECKING:
    import shapely

# width of an engraved line; of letters: least height (eight lines) and greatest, mm, part of the widest clear circle
STROKE = 0.25
_LEAST, _MOST, _SHARE = 8 * STROKE, 8.0, 0.4
# clear material about the lines, error of the chords that stand for the outline, mm
_CLEAR, _CHORDS = 0.5, 0.02
# heights that are tried, each a part of the one before, and places across the part
_STEP, _PLACES = 0.88, 41
# how much higher words must be that do not stand upright, and room about words that are not the least
_TURNED, _ROOM = 1.5, 1.2
# of a tag: its letters, what is about them, its corners, and how far it stands off the part, mm
_TAG, _RIM, _CORNER, _OFF = 3.0, 1.5, 1.0, 3.0


def named(section: OffsetRegion, exact: OffsetRegion, text: str, gap: float = 0.0) -> OffsetRegion:
    """A section with its name engraved; ``exact``: the material that is left, in which it must find room.

    A name without room stands on a tag, one more piece to the right, its cut ``gap`` mm or more off, and a finding
    tells so: the least height of letters, and the widest circle in the material, mm.
    """
    import shapely

    region = section.region
    clear = shapely.buffer(_material(exact.region), -(STROKE / 2 + _CLEAR))
    if region.strokes:
        drawn = [[(p.real, p.imag) for p in stroke] for stroke in region.strokes]
        clear = shapely.difference(clear, shapely.buffer(shapely.MultiLineString(drawn), STROKE + _CLEAR))
    middle, widest = _widest(clear)
    strokes = _inside(clear, middle, widest, text)
    if strokes is not None:
        return replace(section, region=replace(region, strokes=(*region.strokes, *strokes)))
    _, low, right, high = shapely.bounds(_polygon(region.outer)).tolist()
    for piece in region.apart:
        right = max(right, shapely.bounds(_polygon(piece))[2])
    letters = lettered(tuple(_layouts(text)[0]), _TAG)
    half = _half(letters) + (1 + 1j) * (_RIM + STROKE / 2)
    grown = max(section.offset, 0.0)
    middle = complex(right + max(_OFF + grown, gap) + grown + half.real, (low + high) / 2)
    corners = [(middle + c, _CORNER) for c in (-half, half.conjugate(), half, -half.conjugate())]
    tag = PlateOutline(rounded(corners)).region(section.offset).region.outer
    moved = tuple(tuple(p + middle for p in stroke) for stroke in letters)
    told = Finding("label_on_tag", 2 * max(widest, 0.0), _LEAST)
    made = replace(region, strokes=(*region.strokes, *moved), apart=(*region.apart, tag))
    return OffsetRegion(made, section.offset, (*section.findings, told))


def _widest(clear: shapely.Polygon) -> tuple[complex, float]:
    """Middle and radius of the widest circle in clear material, coarsely where the highest letters have room anyway."""
    import shapely

    if clear.is_empty:
        return 0j, 0.0
    circle = shapely.maximum_inscribed_circle(clear, _MOST / 4)
    if circle.length < _MOST / (2 * _SHARE):
        circle = shapely.maximum_inscribed_circle(clear, _CHORDS)
    return complex(*circle.coords[0]), circle.length


def _inside(clear: shapely.Polygon, middle: complex, widest: float, text: str) -> tuple[Stroke, ...] | None:
    """The strokes in clear material, as high as they can stand; None where there is no room."""
    import shapely

    if 2 * widest < _LEAST / 2:
        return None
    frame = np.array(shapely.minimum_rotated_rectangle(clear).exterior.coords) @ (1, 1j)
    sides = np.diff(frame[:3])
    along = math.remainder(float(np.angle(sides[np.argmax(np.abs(sides))])), math.pi)
    layouts = [lettered(lines, 1.0) for lines in _layouts(text)]
    most = min(_MOST, _SHARE * 2 * widest)
    heights = list(takewhile(lambda height: height > _LEAST, (most * _STEP**k for k in count())))
    best, found = 0.0, None
    # upright words first, others where they can be much higher
    for turn in dict.fromkeys((0.0, math.pi / 2, along)):
        if most <= _TURNED * best:
            break
        way = _Way(clear, middle, turn)
        least = way.placed(layouts, _LEAST)
        if least is not None:
            tried = ((height, way.placed(layouts, height)) for height in heights)
            made = next((one for one in tried if one[1] is not None), (_LEAST, least))
            if made[0] > _TURNED * best:
                best, found = made
    return found


class _Way:
    """Clear material turned so that words of one direction lie along x, and places in it, from its middle outwards.

    ``middle``: of its widest circle, before it is turned.
    """

    def __init__(self, clear: shapely.Polygon, middle: complex, turn: float) -> None:
        import shapely

        self.turn = turn
        spin = np.exp(-1j * turn)

        def turned(xy: Real) -> Real:
            plane = (xy[:, 0] + 1j * xy[:, 1]) * spin
            return np.column_stack([plane.real, plane.imag])

        self.clear = shapely.transform(clear, turned) if turn else clear
        shapely.prepare(self.clear)
        left, low, right, high = shapely.bounds(self.clear).tolist()
        x, y = np.meshgrid(np.linspace(left, right, _PLACES), np.linspace(low, high, _PLACES))
        spots = np.concatenate([[middle * spin], (x + 1j * y).ravel()])
        points = shapely.points(spots.real, spots.imag)
        inside = shapely.contains(self.clear, points)
        spots, points = spots[inside], points[inside]
        room = shapely.distance(shapely.boundary(self.clear), points)
        off = spots - complex(left + right, low + high) / 2
        ranks = (np.abs(off.real) / _CLEAR).round(), -(room / _CLEAR).round(), np.abs(off.imag).round(6), off.imag
        order = np.lexsort(ranks[::-1])
        self.spots, self.room = spots[order], room[order]

    def placed(self, layouts: list[tuple[Stroke, ...]], height: float) -> tuple[Stroke, ...] | None:
        """The first of some layouts that has room at a height of capitals, mm, there; None where none has."""
        import shapely

        back, about = np.exp(1j * self.turn), 1.0 if height == _LEAST else _ROOM
        for letters in layouts:
            half = _half(letters) * height * about
            spots = self.spots[self.room >= min(half.real, half.imag)]
            x, y = spots.real, spots.imag
            boxes = shapely.box(x - half.real, y - half.imag, x + half.real, y + half.imag)
            fit = np.flatnonzero(shapely.contains(self.clear, boxes))
            if len(fit):
                return tuple(tuple(complex((p * height + spots[fit[0]]) * back) for p in stroke) for stroke in letters)
        return None


def _layouts(text: str) -> list[tuple[str, ...]]:
    """A text in one line, two or three, as even as its words allow; words that no-break spaces join stay together."""
    found = [tuple(text.splitlines())]
    text = HELD.sub("\\1\N{NO-BREAK SPACE}", text)
    for most in (2, 3) if len(found[0]) == 1 else ():
        for width in range(1, len(text)):
            lines = wrap(text, width, break_long_words=False, break_on_hyphens=False)
            if len(lines) <= most:
                found.append(tuple(lines))
                break
    return list(dict.fromkeys(found))


def _half(strokes: tuple[Stroke, ...]) -> complex:
    """Half of the box of strokes about the origin."""
    return complex(max(p.real for s in strokes for p in s), max(p.imag for s in strokes for p in s))


def _material(region: Region) -> shapely.Polygon:
    """The outer boundary without holes and without what is engraved."""
    import shapely

    cut = shapely.union_all([_polygon(p) for p in (*region.holes, *region.marks)])
    return shapely.difference(_polygon(region.outer), cut)


def _polygon(profile: Profile) -> shapely.Polygon:
    import shapely

    tolerance = min(_CHORDS, _CHORDS * profile.reach())
    vertices = approximate_profile(profile, tolerance, arcs=False).geometry.expanded()[0]
    return shapely.Polygon(np.column_stack([vertices.real, vertices.imag]))
