"""The working drawing of a flat body: its outline with the places of its corners and holes, its thickness."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from geometry.curves.curve import Curve, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile, Region
from parts.drawing.extent import farthest
from parts.drawing.wheel_views import circle_of
from parts.drawing.working import (
    VISIBLE,
    Note,
    PartDrawing,
    Round,
    Size,
    Stroke,
    Subject,
    View,
    arc_angles,
    requirements,
)
from parts.texts.sheets import sheet_words

_DIGITS, _SAME, _SAMPLES = 9, 1e-9, 9
# sine of the angle between two curves that make a corner
_SMOOTH = 1e-6


def part_drawing(subject: Subject, working: Sequence[Curve] = ()) -> PartDrawing:
    """One view, its thickness told, a sign on one of its ``working`` surfaces beside those of cams."""
    region = subject.part.section(0.0).region
    curves = [s.curve for s in region.outer.segments()]
    low, high = extent(region)
    strokes: list[Stroke] = [(VISIBLE, curve) for curve in curves]
    round_holes = [found for hole in region.holes if (found := _circle(hole)) is not None]
    strokes += [(VISIBLE, circle_of(radius, centre)) for centre, radius in round_holes]
    slots = [hole for hole in region.holes if _circle(hole) is None]
    for profile in (*slots, *region.marks):
        strokes += [(VISIBLE, s.curve) for s in profile.segments()]
    axes = [Line(centre - r * way, centre + r * way) for centre, r in round_holes for way in (1, 1j)]
    centres = [*_corners(curves), *(centre for centre, _ in round_holes)]
    chains = [[s.curve for s in profile.segments()] for profile in slots]
    for chain in chains:
        centres += [*_corners(chain), *(curve.centre for curve in chain if isinstance(curve, Arc))]
    whole = _circle(region.outer)
    sizes = [] if whole else [Size("width", low, complex(high.real, low.imag), "below"),
                              Size("height", low, complex(low.real, high.imag), "left")]  # fmt: skip
    for k, (x, at) in enumerate(sorted({round(c.real, _DIGITS): c for c in centres}.items()), 1):
        if low.real < x < high.real:
            sizes.append(Size(f"x.{k}", low, at, "below"))
    for k, (y, at) in enumerate(sorted({round(c.imag, _DIGITS): c for c in centres}.items()), 1):
        if low.imag < y < high.imag:
            sizes.append(Size(f"y.{k}", low, at, "left"))
    rounds = [*_diameters(round_holes, subject), *_radii([*([] if whole else [curves]), *chains], subject)]
    if whole:
        rounds.append(Round("diameter", *whole, angles=(-45.0, -135.0, 135.0)))
    # sizes stand below and on the left
    straight = (c for c in curves if isinstance(c, Line))
    edge = max(straight, key=lambda c: (round((c.end + c.start).real, 6), (c.end + c.start).imag), default=None)
    at = farthest(curves, 1) if edge is None else (edge.start + edge.end) / 2
    notes = [Note(at, f"s {subject.say(subject.part.face_width)}")]
    cams = [s.curve for profile in (region.outer, *slots) for s in profile.segments() if s.label is Label.CAM]
    if worked := [*working, *cams]:
        # in the middle of the longest piece
        curve = max(worked, key=_length)
        low, high = curve.domain
        places = [low + share * (high - low) for share in (0.5, 0.25, 0.75)]
        # the material lies on the left
        (at, free), *also = [(complex(curve.point(t)), -1j * complex(curve.tangent(t))) for t in places]
        words = f"Ra {subject.say(subject.wishes.flank_roughness)}"
        notes.append(Note(at, words, is_rough=True, free=free, also=tuple(also)))
    view = View(tuple(strokes), (), tuple(axes), tuple(sizes), tuple(rounds), tuple(notes))
    return PartDrawing((view,), requirements(subject))


def _length(curve: Curve) -> float:
    """About how long a curve is, mm."""
    return float(np.abs(np.diff(curve.point(np.linspace(*curve.domain, _SAMPLES)))).sum())


def extent(region: Region) -> tuple[complex, complex]:
    """The lower left and the upper right corner of the rectangle about a region."""
    curves = [s.curve for s in region.outer.segments()]
    left, right, low, high = (farthest(curves, way) for way in (-1, 1, -1j, 1j))
    return complex(left.real, low.imag), complex(right.real, high.imag)


def _corners(curves: Sequence[Curve]) -> Iterator[complex]:
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


def _circle(profile: Profile) -> tuple[complex, float] | None:
    """Centre and radius of a round hole; None: it is none."""
    arcs = [s.curve for s in profile.segments() if isinstance(s.curve, Arc)]
    whole = len({(a.centre, a.radius) for a in arcs}) == 1 and len(arcs) == len(list(profile.segments()))
    return (arcs[0].centre, arcs[0].radius) if whole else None


def _diameters(holes: list[tuple[complex, float]], subject: Subject) -> Iterator[Round]:
    """Each diameter once, with how many holes have it."""
    groups: dict[float, list[complex]] = {}
    for centre, radius in holes:
        groups.setdefault(round(radius, _DIGITS), []).append(centre)
    for k, (_, centres) in enumerate(sorted(groups.items()), 1):
        best = max(centres, key=lambda c: (round(c.real + c.imag, 6), c.real))
        radius = next(r for c, r in holes if c == best)
        words = sheet_words(subject.language, "holes_of", count=len(centres)) if len(centres) > 1 else ""
        yield Round(f"holes.{k}.diameter", best, radius, f"{words}Ø")


def _radii(chains: list[list[Curve]], subject: Subject) -> Iterator[Round]:
    """Each radius of an arc once, with how many arcs have it."""
    groups: dict[float, list[Arc]] = {}
    for curve in (c for chain in chains for c in chain if isinstance(c, Arc)):
        groups.setdefault(round(curve.radius, _DIGITS), []).append(curve)
    for k, arcs in enumerate(groups.values(), 1):
        arc, *others = sorted(arcs, key=_up_right, reverse=True)
        # what rounds the outline is told within it, which needs no more paper; arcs about one centre are one place
        count = len({complex(round(a.centre.real, 6), round(a.centre.imag, 6)) for a in arcs})
        after = sheet_words(subject.language, "places_of", count=count) if count > 1 else ""
        yield Round(f"radius.{k}", arc.centre, arc.radius, "R", after, is_radius=True, inward=arc.sweep > 0,
                    angles=arc_angles(arc), also=tuple((o.centre, arc_angles(o)) for o in others))  # fmt: skip


def _up_right(arc: Arc) -> float:
    """How far an arc's middle is where no sizes stand."""
    middle = complex(arc.point(abs(arc.sweep) / 2))
    return round(middle.real + middle.imag, 6)
