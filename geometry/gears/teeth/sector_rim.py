"""Teeth on a part of the rim: sector gears, and mutilated ones, whose equal runs of teeth move a mate step by step.

The rim, an arc of the root circle, ends a whole pitch beyond the centre lines of the outer teeth of a run, whose outer
flanks and fillets are as those of all. Between two runs stands the blank, an arc of the root circle or of one farther
from the teeth; or the rest is cut away along tangents of a hub circle.

Runs are built as they are travelled, with material on the left: counter-clockwise about a gear, clockwise in a ring,
where the plane is seen in the mirror.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from geometry.base.errors import GeometryError, Nearest, OffsetError, ParameterError, limit
from geometry.base.nearest import nearest
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.base.tolerance import LEAST_SEGMENT_MM, TOLERANCES
from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.gears.teeth.sector import Sector
from geometry.gears.teeth.side import Side, whole_land
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.hub_holes import least_wall
from geometry.solids.plate import Edge, PlateHole, PlateOutline, moved_edges

if TYPE_CHECKING:
    from geometry.gears.teeth.ring import RingGear
    from geometry.gears.teeth.spur import SpurGear

# arcs of more than this are written as two, rad
_MOST_SWEEP = 3.0


class _Run(Record):
    """One run as it is travelled: directions of the centre lines of its outer teeth, and to the next run, rad."""

    low: float
    high: float
    pitch: float
    turn: float
    root: float

    @classmethod
    def of(cls, gear: SpurGear | RingGear) -> _Run:
        """That of a gear's sector; in a ring seen in the mirror."""
        sector = gear.sector
        assert sector is not None
        ends = [gear.sign * sector.centre(k, gear.pitch_angle, gear.sign) for k in (0, sector.teeth - 1)]
        return cls(min(ends), max(ends), gear.pitch_angle, 2 * math.pi / sector.runs, gear.root_radius)

    @property
    def ends(self) -> tuple[float, float]:
        """Where the rim ends, and where that of the next run begins, rad."""
        return self.high + self.pitch, self.low - self.pitch + self.turn


def core_edges(gear: SpurGear | RingGear) -> tuple[Edge, ...]:
    """The outline without its teeth, run by run from the rim on; a rest on the root circle has none.

    Raises
    ------
    GeometryError
        Its corners have no room for their rounding, or the rest none at all.
    """
    sector, run, sign = gear.sector, _Run.of(gear), gear.sign
    assert sector is not None
    before = _end(sector, run, sign)
    middle = sum(run.ends) / 2
    # the other end is the image of this one in the middle of the rest
    image = [_mirrored(edge, middle) for edge in reversed(before)]
    start = cmath.phase(end_point(image[-1])) - run.turn
    rim = (cmath.phase(start_point(before[0])) - start) % (2 * math.pi)
    radius, first = sector.core_radius(run.root), cmath.phase(end_point(before[-1]))
    rest = 2 * math.remainder(middle - first, 2 * math.pi)
    # of the rim too what its corners leave beyond the middle of the run
    left = math.remainder(cmath.phase(start_point(before[0])) - (run.low + run.high) / 2, 2 * math.pi)
    if min(left, rest) <= 0:
        raise GeometryError("edge_consumed")
    count = math.ceil(rest / _MOST_SWEEP)
    arcs = [Arc(0j, radius, first + rest * k / count, rest / count) for k in range(count)]
    period = [Arc(0j, run.root, start, rim), *before, *arcs, *image]
    turned = [e.placed(Placement2(run.turn * k)) for k in range(sector.runs) for e in period]
    return tuple(turned) if sign > 0 else tuple(_seen(edge) for edge in turned)


def _end(sector: Sector, run: _Run, sign: int) -> list[Edge]:
    """From the rim to the rest: a corner, a straight line, and a corner where the line is no tangent."""
    radius, root, q = sector.core_radius(run.root), run.root, sector.corner_radius
    edge, _ = run.ends
    if sector.is_cut:
        # out from where the tangent touches the hub
        spoke = cmath.rect(1.0, edge + math.acos(radius / root))
        if not root > q:
            raise GeometryError("edge_consumed")
        touch = spoke * complex(radius, -math.sqrt(max((root - radius) * (root + radius - 2 * q), 0.0)))
        side = Line(touch, spoke * radius)
        if not q:
            return [side]
        centre = touch - spoke * q
        return [arc_between(centre, centre * root / abs(centre), touch, turns_left=True), side]
    spoke = cmath.rect(1.0, edge)
    near, far = root - sign * q, radius + sign * q
    if not (near > q and far > q) or sign * (root - radius) <= 0:
        raise GeometryError("edge_consumed")
    outer, inner = (math.sqrt((r - q) * (r + q)) for r in (near, far))
    if sign * (outer - inner) <= 0:
        raise GeometryError("edge_consumed")
    line: list[Edge] = [Line(outer * spoke, inner * spoke)]
    if not q:
        return line
    one, two = complex(outer, -q) * spoke, complex(inner, q) * spoke
    return [
        arc_between(one, one * root / abs(one), outer * spoke, turns_left=sign > 0),
        *line,
        arc_between(two, inner * spoke, two * radius / abs(two), turns_left=sign < 0),
    ]


def _mirrored(edge: Edge, middle: float) -> Edge:
    """The image in the line through the axis in a direction, rad, travelled the other way."""
    return edge.placed(Placement2(-middle)).mirrored().placed(Placement2(middle))


def _seen(edge: Edge) -> Edge:
    """The image in the x axis, travelled the same way: of a run of a ring as it is."""
    return edge.mirrored().reversed()


def sector_profile(gear: SpurGear | RingGear, side: Side, end: Side, offset: float, depth: float = 0.0) -> Profile:
    """The toothed boundary, moved ``offset`` mm out of the material, and ``depth`` mm into it for a face chamfer.

    ``side``: of its teeth moved so far, ``end``: the outer one of a run, without a tooth beyond it.

    Raises
    ------
    OffsetError
        A corner of the rest closes, or the outer spaces do.
    """
    sector, run, sign = gear.sector, _Run.of(gear), gear.sign
    assert sector is not None
    root = run.root + sign * (offset - depth)
    chain = _teeth(sector, run, sign, (side, end))
    feet = start_point(chain[0].curve), end_point(chain[-1].curve)
    if max(abs(abs(foot) - root) for foot in feet) > TOLERANCES.relative_join * root:
        # the fillet of an outer tooth would go on beyond what its space has of it
        raise OffsetError(offset, "closes_tooth_spaces")
    first, last = (sign * cmath.phase(foot) for foot in feet)
    if not sector.stands_off:
        rest = (first - last) % run.turn
        count = math.ceil(rest / _MOST_SWEEP)
        arcs = [Arc(0j, root, sign * (last + rest * k / count), sign * rest / count) for k in range(count)]
        return Profile((*chain, *(Segment(a, Label.ROOT_LAND) for a in arcs)), sector.runs, sign < 0)
    moved = moved_edges(moved_edges(core_edges(gear), offset), -depth, sharp=True)
    rim, *edges = moved[: len(moved) // sector.runs]
    lands = []
    for start, stop in ((start_point(rim), feet[0]), (feet[1], end_point(rim))):
        sweep = math.remainder(sign * cmath.phase(stop / start), 2 * math.pi)
        if not sweep * root > LEAST_SEGMENT_MM / 2:
            raise OffsetError(offset, "closes_tooth_spaces")
        lands.append(Segment(Arc(0j, root, cmath.phase(start), sign * sweep), Label.ROOT_LAND))
    round_ = Label.HUB if sector.is_cut else Label.RIM
    beyond = [Segment(e, round_ if isinstance(e, Arc) and e.centre == 0 else Label.BODY) for e in edges]
    return Profile((lands[0], *chain, lands[1], *beyond), sector.runs, sign < 0)


def _teeth(sector: Sector, run: _Run, sign: int, sides: tuple[Side, Side]) -> list[Segment]:
    """All teeth of the first run from foot to foot, as they are travelled."""
    side, end = (list(s.segments) for s in sides)
    lands = [s.pop(0) if s[0].label is Label.ROOT_LAND else None for s in (side, end)]
    tips = [s.pop() if s[-1].label is Label.TIP_LAND else None for s in (side, end)]
    half = run.pitch / 2
    # a gear's side is that of a tooth on +x, a ring's that of the space there
    middle = 0.0 if sign > 0 else -half
    tip = [] if tips[0] is None else [whole_land(tips[0], middle, sign)]
    space = [] if lands[0] is None else [whole_land(lands[0], middle - sign * half, sign)]
    back = Placement2(2 * middle)

    def falling(pieces: Sequence[Segment]) -> list[Segment]:
        return [Segment(s.curve.mirrored().placed(back), s.label) for s in reversed(pieces)]

    found: list[Segment] = []
    for number in range(sector.teeth):
        rising = end if number == 0 else [*space, *side]
        tooth = [*rising, *tip, *falling(end if number == sector.teeth - 1 else side)]
        turn = Placement2(sign * (run.low + number * run.pitch) - middle)
        found += [Segment(s.curve.placed(turn), s.label) for s in tooth]
    return found


def check_sector(gear: SpurGear | RingGear) -> None:
    """Refuse a sector that its gear, which exists with all teeth, has no room for.

    Raises
    ------
    ParameterError
        Names the key of the sector, or of the holes that lie outside.
    """
    sector = gear.sector
    if sector is None:
        return
    number, spare = gear.number_of_teeth, 2 if sector.blank_diameter is not None else 1
    if number % sector.runs:
        # the nearest number of runs that divides the teeth, fewer before more
        fits = (n for by in range(number) for n in (sector.runs - by, sector.runs + by) if n > 0 and number % n == 0)
        raise ParameterError("sector.runs", sector.runs, "runs_do_not_divide", Nearest(next(fits)), teeth=number)
    most = number // sector.runs - spare
    if sector.teeth > most:
        cure = Nearest(most, "at_most") if most >= 1 else None
        raise ParameterError("sector.teeth", sector.teeth, "sector_of_all_teeth", cure, most=most)
    _check_rest(gear, sector)
    if sector.corner_radius and not sector.stands_off:
        raise ParameterError("sector.corner_radius", sector.corner_radius, "blank_without_corners", Nearest(0.0))
    try:
        _check_round(gear)
    except GeometryError:

        def fits_round(radius: float) -> bool:
            _check_round(replace(gear, sector=replace(sector, corner_radius=radius)))
            return True

        cure_round = partial(nearest, fits_round, sector.corner_radius, 0.0)
        raise ParameterError("sector.corner_radius", sector.corner_radius, "corner_has_no_room", cure_round) from None


def _check_rest(gear: SpurGear | RingGear, sector: Sector) -> None:
    """The circle of the rest lies on the right side of the root circle, and its bore or rim has room."""
    root, sign = gear.root_radius, gear.sign
    if sector.blank_diameter is not None and sign * (root - sector.blank_diameter / 2) < LEAST_SEGMENT_MM:
        told = limit(2 * root - 3 * sign * LEAST_SEGMENT_MM, sector.blank_diameter)
        code = "blank_above_roots" if sign > 0 else "blank_below_roots"
        raise ParameterError("sector.blank_diameter", sector.blank_diameter, code, told, diameter=2 * root)
    if (hub := sector.hub_diameter) is None:
        return
    if hub / 2 > root - LEAST_SEGMENT_MM:
        most = limit(2 * root - 3 * LEAST_SEGMENT_MM, hub)
        raise ParameterError("sector.hub_diameter", hub, "reaches_root_circle", most, diameter=2 * root)

    def leaves(teeth: int) -> bool:
        return (teeth + 1) * gear.pitch_angle / 2 + math.acos(hub / 2 / root) < math.pi - 1e-9

    if not leaves(sector.teeth):
        # a wider hub leans the sides outwards
        most_teeth = next((n for n in range(sector.teeth, 0, -1) if leaves(n)), None)
        cure = None if most_teeth is None else Nearest(most_teeth, "at_most")
        raise ParameterError("sector.teeth", sector.teeth, "sides_of_sector_meet", cure)


def _check_round(gear: SpurGear | RingGear) -> None:
    """The corners of the rest have room beside the outer teeth; raises ``GeometryError``."""
    sector = gear.sector
    assert sector is not None
    if not sector.stands_off:
        return
    run, rim = _Run.of(gear), core_edges(gear)[0]
    assert isinstance(rim, Arc)
    # what the outer teeth take of the rim: their feet stand within half a pitch of their centre lines
    if abs(rim.sweep) < run.high - run.low + run.pitch + LEAST_SEGMENT_MM / run.root:
        raise GeometryError("arc_consumed")


def check_gear_sector(gear: SpurGear) -> None:
    """The same of an external gear, whose holes lie within what is left.

    Raises
    ------
    ParameterError
        Names the key of the sector, or of the holes that lie outside.
    """
    check_sector(gear)
    sector, core, holes = gear.sector, gear.core_radius, gear.holes
    assert sector is not None
    key, given = "sector.blank_diameter", sector.blank_diameter
    reach, most = holes.reach, 2 * gear.root_radius
    if sector.is_cut:
        key, given, reach = "sector.hub_diameter", sector.hub_diameter, holes.bore_reach
    least = 2 * (reach + least_wall(gear.root_radius))
    if given is not None and core < least / 2:
        raise ParameterError(key, given, "rest_within_holes", limit(least, given) if least < most else None)
    if sector.is_cut and holes.round_holes:
        keys = [f"{name}.diameter" for name, group in holes.groups() for _ in range(group.count)]
        core_plate(gear).check_holes(keys)


def core_plate(gear: SpurGear) -> PlateOutline:
    """What is left of a cut sector without its teeth, with the round holes beside the bore."""
    holes = [PlateHole(at, g.diameter) for g in gear.holes.round_holes for at in g.centres()]
    return PlateOutline(core_edges(gear), tuple(holes))
