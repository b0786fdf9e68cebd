"""The working drawing of a flat body: its outline with the places of its corners and holes, its thickness."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from operator import attrgetter

import numpy as np

from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile, Region
from geometry.solids.windows import HoleCircle
from parts.base.part import Part
from parts.base.texts import N_
from parts.bodies.plate import FlatKeys, HoleAtTable
from parts.drawing.extent import farthest
from parts.drawing.wheel_views import axis_along, circle_of
from parts.drawing.working import (
    AXIS,
    THIN,
    VISIBLE,
    Note,
    PartDrawing,
    Round,
    Side,
    Size,
    Stroke,
    Subject,
    View,
    arc_angles,
    requirements,
)
from parts.texts.sheets import counted_words

# digits of places, mm that are none, mm that are one place
_DIGITS, _SAME, _SAMPLES, _NEAR = 9, 1e-9, 9, 1e-6
FROM_EDGES, _FROM_AXES = N_("x and y from the left and the lower edge"), N_("x and y from the axes")
# places that sizes tell, along both axes: holes at more have a table
_MOST = 16
# sine of the angle between two curves that make a corner
_SMOOTH = 1e-6


def part_drawing(
    subject: Subject, working: Sequence[Curve] = (), circles: Sequence[HoleCircle] = (), *words: str
) -> PartDrawing:
    """One view, its thickness told, a sign on one of its ``working`` surfaces beside those of cams.

    Places are told from the left and the lower edge. Where holes stand on ``circles``, they are told from the origin,
    and radii alone tell the outline; ``words``: on what no size tells.
    """
    region = subject.part.section(0.0).region
    curves = [s.curve for s in region.outer.segments()]
    low, high = extent(region)
    strokes: list[Stroke] = [(VISIBLE, curve) for curve in curves]
    round_holes = _round_holes(region)
    strokes += [(VISIBLE, circle_of(radius, centre)) for centre, radius in round_holes]
    slots = [hole for hole in region.holes if circle_from(hole) is None]
    for profile in (*slots, *region.marks):
        strokes += [(VISIBLE, s.curve) for s in profile.segments()]
    strokes += [(THIN, Line(a, b)) for line in region.strokes for a, b in pairwise(line)]
    strokes += [(AXIS, circle_of(one.circle / 2)) for one in circles]
    loose, grids = _loose(round_holes, circles), _grids(subject.part)
    gridded = [at for one in grids for at in one.centres()]
    loose = [one for one in loose if not _is_among(one[0], gridded)]
    axes = [Line(centre - r * way, centre + r * way) for centre, r in loose for way in (1, 1j)]
    listed = listed_holes(subject.part, circles)
    loose, round_holes = ([one for one in some if one not in listed] for some in (loose, round_holes))
    axes += [line for one in grids for line in _grid_axes(one)]
    axes += [axis_along(centre, one.diameter / 2) for one in circles for centre in one.centres()]
    chains = [[s.curve for s in profile.segments()] for profile in slots]
    whole = circle_from(region.outer)
    centres = [*(() if circles else corners(curves)), *(centre for centre, _ in loose)]
    centres += [one.centres()[0] for one in grids]
    for chain in chains:
        centres += [*corners(chain), *(curve.centre for curve in chain if isinstance(curve, Arc))]
    left, right, foot, top = (edge(curves, *ways) for ways in ((-1, -1j), (1, -1j), (-1j, -1), (1j, -1)))
    sizes = [] if whole or circles else [Size("width", left, right, "below"), Size("height", foot, top, "left")]
    if circles or whole:
        middle = whole[0] if whole else 0j
        axes += [Line(complex(low.real, middle.imag), complex(high.real, middle.imag)),
                 Line(complex(middle.real, low.imag), complex(middle.real, high.imag))]  # fmt: skip
    datum = datum_of(region, circles)[0]
    starts = (datum, datum) if whole or circles else (left, foot)
    sizes += place_sizes(datum, starts, centres, (low, high))
    sizes += [size for k, one in enumerate(grids, 1) for size in _grid_sizes(one, f"grid.{k}", subject)]
    rounds = [
        *diameters(round_holes, subject.language),
        *radii([*([] if whole else [curves]), *chains], subject.language),
    ]
    if whole:
        rounds.append(Round("diameter", *whole, angles=(-45.0, -135.0, 135.0)))
    for k, one in enumerate(circles, 1):
        rounds.append(Round(f"circle.{k}", 0j, one.circle / 2))
    numbers = [Note(centre, str(k), about=radius) for k, (centre, radius) in enumerate(listed, 1)]
    cams = [s.curve for profile in (region.outer, *slots) for s in profile.segments() if s.label is Label.CAM]
    notes = _thickness(curves, subject), *_working_sign([*working, *cams], subject), *numbers
    return PartDrawing(
        (View(tuple(strokes), (), tuple(axes), tuple(sizes), tuple(rounds), notes),), requirements(subject, *words)
    )


def _thickness(curves: Sequence[Curve], subject: Subject) -> Note:
    """The thickness, on the right: sizes stand below and on the left."""
    straight = (c for c in curves if isinstance(c, Line))
    wall = max(straight, key=lambda c: (round((c.end + c.start).real, 6), (c.end + c.start).imag), default=None)
    at = farthest(curves, 1) if wall is None else (wall.start + wall.end) / 2
    return Note(at, f"s {subject.say(subject.part.face_width)}")


def _working_sign(surfaces: Sequence[Curve], subject: Subject) -> Iterator[Note]:
    """The sign of working surfaces, where there are some, in the middle of the longest piece."""
    if surfaces:
        curve = max(surfaces, key=_length)
        first, last = curve.domain
        places = [first + share * (last - first) for share in (0.5, 0.25, 0.75)]
        # the material lies on the left
        (at, free), *also = [(complex(curve.point(t)), -1j * complex(curve.tangent(t))) for t in places]
        yield subject.worked(at, free=free, also=tuple(also))


def datum_of(region: Region, circles: Sequence[HoleCircle] = ()) -> tuple[complex, str]:
    """From where places are told, and its words."""
    if circles:
        return 0j, _FROM_AXES
    whole = circle_from(region.outer)
    return (extent(region)[0], FROM_EDGES) if whole is None else (whole[0], _FROM_AXES)


def _round_holes(region: Region) -> list[tuple[complex, float]]:
    """Centre and radius of each."""
    return [found for hole in region.holes if (found := circle_from(hole)) is not None]


def _loose(holes: Sequence[tuple[complex, float]], circles: Sequence[HoleCircle]) -> list[tuple[complex, float]]:
    """Those of some holes that stand on no circle."""
    circled = [centre for one in circles for centre in one.centres()]
    return [(c, r) for c, r in holes if not _is_among(c, circled)]


def _is_among(place: complex, others: Sequence[complex]) -> bool:
    """Whether a place is one of others."""
    return any(abs(place - other) <= _NEAR for other in others)


def _grids(part: Part) -> list[HoleAtTable]:
    """Its grids of holes."""
    return [one for one in part.keys.holes if one.count > 1] if isinstance(part.keys, FlatKeys) else []


def _grid_axes(grid: HoleAtTable) -> Iterator[Line]:
    """An axis through each column and each row."""
    centres, radius = grid.centres(), grid.diameter / 2
    for low, high, way in (
        (centres[: grid.columns], centres[-grid.columns :], 1j),
        (centres[:: grid.columns], centres[grid.columns - 1 :: grid.columns], 1),
    ):
        yield from (Line(a - radius * way, b + radius * way) for a, b in zip(low, high, strict=True))


def _grid_sizes(grid: HoleAtTable, name: str, subject: Subject) -> Iterator[Size]:
    """Along both axes from the first hole to the next, and to the last as so many steps of it; GOST 2.307."""
    first = grid.centres()[0]
    ways: tuple[tuple[str, int, complex, Side], ...] = (
        ("columns", grid.columns, complex(grid.steps[0]), "below"),
        ("rows", grid.rows, 1j * grid.steps[1], "left"),
    )
    for key, count, step, side in ways:
        if count > 1:
            yield Size(f"{name}.{key}.pitch", first, first + step, side)
        if count > 2:
            before = f"{count - 1}×{subject.say(abs(step))}="
            yield Size(f"{name}.{key}", first, first + (count - 1) * step, side, before)


def listed_holes(part: Part, circles: Sequence[HoleCircle] = ()) -> list[tuple[complex, float]]:
    """The round holes that a table tells, from the left: where they stand at more places than sizes show well."""
    keys, gridded = part.keys, [at for one in _grids(part) for at in one.centres()]
    loose = _loose(_round_holes(part.section(0.0).region), circles)
    loose = [one for one in loose if not _is_among(one[0], gridded)]
    places = {round(c.real, _DIGITS) for c, _ in loose}, {round(c.imag, _DIGITS) for c, _ in loose}
    # engraved slots have a table of their own
    if sum(map(len, places)) <= _MOST or (isinstance(keys, FlatKeys) and keys.engraved):
        return []
    return sorted(loose, key=lambda one: (round(one[0].real, _DIGITS), one[0].imag))


def place_sizes(
    datum: complex, starts: tuple[complex, complex], places: Iterable[complex], bounds: tuple[complex, complex]
) -> Iterator[Size]:
    """Each distance of places from the datum once, across and upwards; none of what has its own within ``bounds``.

    ``starts``: from where the lines of both leave the outline; those of a place leave it where it is nearest to them.
    """
    places, sides = list(places), dict[str, Side](x="below", y="left")
    real, imag = attrgetter("real"), attrgetter("imag")
    for (name, side), of, other, start in zip(sides.items(), (real, imag), (imag, real), starts, strict=True):
        low, high = map(of, bounds)
        nearest = {round(of(p), _DIGITS): p for p in sorted(places, key=other, reverse=True)}
        for k, (value, at) in enumerate(sorted(nearest.items()), 1):
            if low + _NEAR < value < high - _NEAR and abs(value - of(datum)) > _NEAR:
                yield Size(f"{name}.{k}", start, at, side)


def _length(curve: Curve) -> float:
    """About how long a curve is, mm."""
    return float(np.abs(np.diff(curve.point(np.linspace(*curve.domain, _SAMPLES)))).sum())


def extent(region: Region) -> tuple[complex, complex]:
    """The lower left and the upper right corner of the rectangle about a region."""
    curves = [s.curve for s in region.outer.segments()]
    left, right, low, high = (farthest(curves, way) for way in (-1, 1, -1j, 1j))
    return complex(left.real, low.imag), complex(right.real, high.imag)


def edge(curves: Sequence[Curve], way: complex, towards: complex) -> complex:
    """Of the places of an outline that are farthest one way, that which is farthest another."""
    best = farthest(curves, way)
    tops = [best, *(at for c in curves for at in (start_point(c), end_point(c)))]
    return max((at for at in tops if ((best - at) / way).real < _NEAR), key=lambda at: (at / towards).real)


def corners(curves: Sequence[Curve]) -> Iterator[complex]:
    """Sharp corners, and those of upright and level lines where an arc rounds them."""
    for k, curve in enumerate(curves):
        before = curves[k - 1]
        ways = complex(before.tangent(before.domain[1])), complex(curve.tangent(curve.domain[0]))
        if abs((ways[0].conjugate() * ways[1]).imag) > _SMOOTH:
            yield start_point(curve)
        after = curves[(k + 1) % len(curves)]
        if isinstance(curve, Arc) and isinstance(before, Line) and isinstance(after, Line):
            ways = before.end - before.start, after.end - after.start
            if abs(ways[0].real) < _SAME and abs(ways[1].imag) < _SAME:
                yield complex(before.end.real, after.start.imag)
            if abs(ways[0].imag) < _SAME and abs(ways[1].real) < _SAME:
                yield complex(after.start.real, before.end.imag)


def circle_from(profile: Profile) -> tuple[complex, float] | None:
    """Centre and radius of a round hole; None: it is none."""
    arcs = [s.curve for s in profile.segments() if isinstance(s.curve, Arc)]
    whole = len({(a.centre, a.radius) for a in arcs}) == 1 and len(arcs) == len(list(profile.segments()))
    return (arcs[0].centre, arcs[0].radius) if whole else None


def diameters(circles: Sequence[tuple[complex, float]], language: str, *, solid: bool = False) -> Iterator[Round]:
    """Each diameter once, with how many holes, or ``solid`` circles, have it."""
    groups: dict[float, list[tuple[complex, float]]] = {}
    for centre, radius in circles:
        groups.setdefault(round(radius, _DIGITS), []).append((centre, radius))
    for k, (_, group) in enumerate(sorted(groups.items()), 1):
        best, radius = max(group, key=lambda one: (round(one[0].real + one[0].imag, 6), one[0].real))
        words = counted_words(language, "places_of" if solid else "holes_of", len(group))
        before, places = ("Ø", words) if solid else (f"{words}Ø", "")
        yield Round(f"{'circles' if solid else 'holes'}.{k}.diameter", best, radius, before, places=places)


def radii(chains: Sequence[Sequence[Curve]], language: str) -> Iterator[Round]:
    """Each radius of an arc once, with how many arcs have it."""
    groups: dict[float, list[Arc]] = {}
    for curve in (c for chain in chains for c in chain if isinstance(c, Arc)):
        groups.setdefault(round(curve.radius, _DIGITS), []).append(curve)
    for k, arcs in enumerate(groups.values(), 1):
        arc, *others = sorted(arcs, key=_up_right, reverse=True)
        # what rounds the outline is told within it, which needs no more paper; arcs about one centre are one place
        count = len({complex(round(a.centre.real, 6), round(a.centre.imag, 6)) for a in arcs})
        also = tuple((o.centre, arc_angles(o)) for o in others)
        yield Round(f"radius.{k}", arc.centre, arc.radius, "R", is_radius=True, inward=arc.sweep > 0,
                    angles=arc_angles(arc), also=also, places=counted_words(language, "places_of", count))  # fmt: skip


def _up_right(arc: Arc) -> float:
    """How far an arc's middle is where no sizes stand."""
    middle = complex(arc.point(abs(arc.sweep) / 2))
    return round(middle.real + middle.imag, 6)
