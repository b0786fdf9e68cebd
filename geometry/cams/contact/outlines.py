"""Outlines of followers: stems with a tip, a roller's pin, a mushroom or a plate, and arms with the same ends.

A stem's reference point (tip, roller's centre, centre of the mushroom's arc, middle of the plate) is the origin, its
stem runs along +y. An arm's pivot is the origin, the arm runs along +x, and the cam lies to its left (``sense`` 1) or
right (-1), as in geometry/cams/motion/guides.py.
"""

from __future__ import annotations

import cmath
import itertools
import math

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.cams.plane.disk import FollowerKind
from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.solids.plate import Edge, PlateOutline, belt, rounded

# the middle of a flat arm's boss stands at most this part of its radius outside of the bar
_BOSS_IN_BAR = 0.9


class FollowerEnd(Record):
    """What of a follower touches the cam; lengths in mm.

    ``radius`` of the roller or mushroom; ``reach``: to both sides of the reference point (a stem's plate), or from the
    pivot (an arm's face). ``arm_length`` and ``face_offset`` of an arm, None of a stem; ``outline`` None of a roller.
    """

    kind: FollowerKind
    radius: float = 0.0
    reach: tuple[float, float] | None = None
    arm_length: float | None = None
    face_offset: float = 0.0
    sense: int = 1
    outline: PlateOutline | None = None


def pointed_stem(width: float, length: float, tip_angle: float) -> tuple[Edge, ...]:
    """A wedge of ``tip_angle`` rad at the end of a stem.

    Raises
    ------
    ParameterError
        The wedge is longer than the stem.
    """
    height = width / 2 / math.tan(tip_angle / 2)
    if not height < length:
        raise ParameterError.beyond("stem_length", length, "tip_longer_than_stem", height * (1 + 1e-6), height=height)
    half = width / 2
    corners = [0j, complex(half, height), complex(half, length), complex(-half, length), complex(-half, height)]
    return rounded([(c, 0.0) for c in corners])


def roller_stem(width: float, length: float) -> tuple[Edge, ...]:
    """A stem with a round end about the roller's pin."""
    half = width / 2
    return (
        Arc(0j, half, math.pi, math.pi),
        Line(half + 0j, complex(half, length)),
        Line(complex(half, length), complex(-half, length)),
        Line(complex(-half, length), -half + 0j),
    )


def plate_stem(
    width: float, length: float, plate: tuple[float, float], radius: float | None, corner: float
) -> tuple[Edge, ...]:
    """A stem on a plate (diameter, thickness): flat, or a mushroom whose face has ``radius`` mm about the origin.

    ``corner`` rounds the inner corners between plate and stem.

    Raises
    ------
    ParameterError
        Sizes that do not fit.
    """
    diameter, thickness = plate
    half, stem = diameter / 2, width / 2
    if radius is not None and not width < 2 * radius:
        raise ParameterError.beyond("follower_radius", radius, "narrower_than_stem", width / 2 * (1 + 1e-6))
    if not diameter >= width:
        raise ParameterError.beyond("plate_diameter", diameter, "below_stem_width", width)
    if radius is not None and not diameter < 2 * radius:
        raise ParameterError.beyond("plate_diameter", diameter, "arc_ends_at_its_diameter", 2 * radius * (1 - 1e-6))
    edge = 0.0 if radius is None else -math.sqrt((radius - half) * (radius + half))
    back = edge + thickness
    if not length > back + corner:
        raise ParameterError.beyond("stem_length", length, "plate_takes_stem", (back + corner) * (1 + 1e-6))
    if diameter - width < 2 * corner * (1 + 1e-9) and corner > 0:
        raise ParameterError.beyond("corner_radius", corner, "plate_has_no_room", (diameter - width) * 0.4999999)
    corners = [(complex(half, edge), 0.0)]
    if diameter > width:
        corners += [(complex(half, back), 0.0), (complex(stem, back), corner)]
    corners += [(complex(stem, length), 0.0), (complex(-stem, length), 0.0)]
    if diameter > width:
        corners += [(complex(-stem, back), corner), (complex(-half, back), 0.0)]
    corners.append((complex(-half, edge), 0.0))
    edges = rounded(corners)
    if radius is None:
        return edges
    first, last = complex(-half, edge), complex(half, edge)
    sweep = cmath.phase(last / first)
    # the chord under the arc is what ``rounded`` closes with
    return (*(e for e in edges if not _joins(e, first, last)), Arc(0j, radius, cmath.phase(first), sweep))


def _joins(edge: Edge, first: complex, last: complex) -> bool:
    return isinstance(edge, Line) and abs(edge.start - first) + abs(edge.end - last) < 1e-9 * abs(first)


def round_arm(length: float, pivot: float, end: float) -> tuple[Edge, ...]:
    """An arm between a boss of diameter ``pivot`` and a round end of diameter ``end`` about the roller's pin.

    Raises
    ------
    ParameterError
        One lies within the other.
    """
    if not length > abs(pivot - end) / 2:
        raise ParameterError.beyond("arm_length", length, "end_within_the_other", abs(pivot - end) / 2 * (1 + 1e-6))
    return belt((0j, pivot / 2), (length + 0j, end / 2))


def flat_arm(length: float, width: float, face_offset: float, boss: float, sense: int) -> tuple[Edge, ...]:
    """A bar whose face is ``face_offset`` mm nearer to the cam than the pivot, and a round boss where it is too narrow.

    Raises
    ------
    ParameterError
        The boss about the pivot (``boss``: its diameter) does not stand in the bar.
    """
    radius, far = boss / 2, face_offset - width
    _reaches(length, boss)
    low, high = -_BOSS_IN_BAR * radius, width + _BOSS_IN_BAR * radius
    if not low <= face_offset <= high:
        raise ParameterError.beyond("face_offset", face_offset, "pivot_outside_bar", low if face_offset < low else high)
    slack = TOLERANCES.relative_join * (width + boss)
    heel, toe = complex(length, far), complex(length, face_offset)
    above, below = face_offset < radius - slack, far > slack - radius
    # where the boss leaves the bar, towards the cam and away from it; its edge runs from the one to the other
    leaves = complex(math.sqrt((radius - face_offset) * (radius + face_offset)), face_offset) if above else None
    returns = complex(math.sqrt((radius - far) * (radius + far)), far) if below else None
    start = -radius + 0j if leaves is None else leaves
    around: tuple[Edge, ...] = ()
    if leaves is not None or returns is not None:
        begin = math.pi if leaves is None else cmath.phase(leaves)
        end = math.pi if returns is None else cmath.phase(returns) + 2 * math.pi
        around = (Arc(0j, radius, begin, end - begin),)
    top = (toe, complex(-radius, face_offset), start) if leaves is None else (toe, start)
    stop = -radius + 0j if returns is None else returns
    bottom = (stop, complex(-radius, far), heel) if returns is None else (stop, heel)
    if not around:
        top, bottom = (toe, top[1]), (top[1], *bottom[1:])
    edges = (*_lines(top), *around, *_lines((*bottom, toe)))
    return edges if sense > 0 else tuple(e.mirrored() for e in reversed(edges))


def _lines(points: tuple[complex, ...]) -> tuple[Edge, ...]:
    return tuple(Line(a, b) for a, b in itertools.pairwise(points) if a != b)


def pointed_arm(length: float, width: float, boss: float, tip: tuple[float, float], sense: int) -> tuple[Edge, ...]:
    """An arm with a hook whose tip (opening angle rad, height mm) stands across it, at (``length``, 0).

    Raises
    ------
    ParameterError
        The hook does not fit on the arm.
    """
    _reaches(length, boss)
    angle, height = tip
    half = height * math.tan(angle / 2)
    if not length - half > boss / 2:
        most = (length - boss / 2) * (1 - 1e-6) / math.tan(angle / 2)
        raise ParameterError.beyond("tip_height", height, "hook_reaches_pivot", most)
    shoulder = complex(length - half, -height)
    front = complex(length + half, -height)
    hook = (Line(front, length + 0j), Line(length + 0j, shoulder))
    return _hooked(shoulder, front, width, boss, hook, sense)


def mushroom_arm(length: float, width: float, boss: float, cap: tuple[float, float], sense: int) -> tuple[Edge, ...]:
    """An arm with a cap of a circle (radius, height of its centre over the arm, mm) about (``length``, 0).

    Raises
    ------
    ParameterError
        The cap does not fit on the arm.
    """
    _reaches(length, boss)
    radius, height = cap
    if not height < radius:
        raise ParameterError.beyond("tip_height", height, "no_cap", radius * (1 - 1e-6))
    half = math.sqrt((radius - height) * (radius + height))
    if not length - radius > boss / 2:
        raise ParameterError.beyond("follower_radius", radius, "cap_reaches_pivot", (length - boss / 2) * (1 - 1e-6))
    shoulder, front = complex(length - half, -height), complex(length + half, -height)
    return _hooked(shoulder, front, width, boss, (arc_between(length + 0j, front, shoulder, turns_left=True),), sense)


def _reaches(length: float, boss: float) -> None:
    if not length > boss / 2:
        raise ParameterError.beyond("arm_length", length, "ends_within_boss", boss / 2 * (1 + 1e-6))


def _hooked(
    shoulder: complex, front: complex, width: float, boss: float, hook: tuple[Edge, ...], sense: int
) -> tuple[Edge, ...]:
    """An arm from the boss about the pivot to a hook that stands on its upper side, for a cam on the left or right."""
    heel, toe = shoulder - 1j * width, front - 1j * width
    # where tangents from both touch the boss, above and below
    upper, lower = (
        cmath.rect(boss / 2, cmath.phase(point) + side * math.acos(boss / 2 / abs(point)))
        for point, side in ((shoulder, 1), (heel, -1))
    )
    turn = cmath.phase(lower / upper)
    around = Arc(0j, boss / 2, cmath.phase(upper), turn if turn > 0 else turn + 2 * math.pi)
    lines = (Line(lower, heel), Line(heel, toe), Line(toe, front))
    # a tip of no height is no edge
    edges = tuple(e for e in (*hook, Line(shoulder, upper), around, *lines) if end_point(e) != start_point(e))
    return edges if sense > 0 else tuple(e.mirrored() for e in reversed(edges))
