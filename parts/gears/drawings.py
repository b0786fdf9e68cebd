"""The working drawings of gears, rings, racks, worms and their wheels; images of teeth after GOST 2.402."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label, Profile
from geometry.solids.bores import RoundBore
from parts.drawing.breaks import Break, broken
from parts.drawing.directions import directions
from parts.drawing.disk_views import disk_drawing
from parts.drawing.revolved import below, block, closed, outlined, seen_edges
from parts.drawing.turned_sizes import Fits, turned_sizes
from parts.drawing.wheel_views import (
    Crown,
    Wheel,
    bore_note,
    bore_radii,
    circle_of,
    exact_teeth,
    hole_round,
    keyway_edges,
    level,
    pitch_arcs,
    ring_face,
    ring_section,
    spline_cut,
    spots,
    wheel_views,
    with_bore,
)
from parts.drawing.working import (
    AXIS,
    HIDDEN,
    THIN,
    VISIBLE,
    Cut,
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
from parts.gears.noncircular_gear.part import NoncircularGearSpec
from parts.gears.rack.part import RackSpec
from parts.gears.ring_gear.part import RingGearSpec, shape_of_ring
from parts.gears.spur_gear.part import SpurGearSpec
from parts.gears.worm.part import WormSpec
from parts.gears.worm_wheel.part import WheelThing, WormWheelSpec
from parts.keys.engraving import digits_height
from parts.keys.helix import ToothedKeys, helix_of
from parts.keys.holes import bore_of, holes_of, spoked
from parts.keys.wheel import shape_of, wheel_shape

# mm, what is no length; how long marks of the teeth's direction are, and how far apart: parts of what has room
_NONE, _MARK, _APART = 1e-9, 0.7, 0.3
# of a rack that is broken: what is kept at either end at least, and the gap, parts of that; what is kept at most, parts
# of the half
_LEAST_KEPT, _GAP, _KEPT = 4.0, 0.1, 0.6
# the section of a long rack is so high on paper at least, mm
_LEAST_SECTION = 20.0

if TYPE_CHECKING:
    from geometry.gears.teeth.rack import Rack
    from geometry.gears.teeth.rack_holes import RackHoles
    from geometry.gears.worms.body import WormBody
    from geometry.gears.worms.worm import Worm
    from parts.keys.working import WorkingTable


def part_drawing(subject: Subject) -> PartDrawing:
    """The drawing of any toothed part."""
    thing = subject.part.thing
    match subject.part.keys:
        case SpurGearSpec() as keys:
            views = wheel_views(_spur(keys, subject), subject)
            if thing.sector is not None:
                outline = subject.part.section(0.0).region.outer
                views = views[0], views[1].plus(rounds=_sector_rounds(thing, outline)), *views[2:]
            more = _requirements(keys, thing, subject, "zero_tooth")
        case NoncircularGearSpec() as keys:
            shape = shape_of(keys)
            circles = ("inner_root_diameter", "outer_tip_diameter")
            return disk_drawing(subject, shape, thing.holes, "zero_x", circles)
        case WormWheelSpec() as keys:
            views = wheel_views(_worm_wheel(keys, thing), subject)
            holes = holes_of(spoked(keys, thing.drive.root_radius))
            more = directions(holes, subject, "zero_tooth", keys.number_of_teeth)
        case RingGearSpec() as keys:
            views = _ring(keys, thing, subject)
            more = _requirements(keys, thing, subject, "zero_space")
        case RackSpec() as keys:
            views, more = _rack(keys, thing, subject), _ends(keys, subject)
        case WormSpec() as keys:
            views, more = _worm(keys, thing, subject), _thread_words(keys, subject)
        case keys:
            raise TypeError(type(keys))
    return PartDrawing(views, requirements(subject, *_edges(subject), *more))


def _edges(subject: Subject) -> tuple[str, ...]:
    """Chamfer or rounding of the tips of teeth, and in which section: of racks a rounding is one of the normal one."""
    keys = subject.part.keys
    if not isinstance(keys, ToothedKeys | WormSpec):
        return ()
    chamfer, where = 0.0, "thread_edges"
    if isinstance(keys, ToothedKeys):
        normal = isinstance(keys, RackSpec) and keys.tip_rounding
        section = "_normal" if normal else "_transverse"
        chamfer, where = keys.tip_chamfer, f"tip_edges{section if keys.helix_angle_deg else ''}"
    edges = subject.words(where)
    made = ("edges_chamfered", chamfer), ("edges_rounded", keys.tip_rounding)
    return tuple(subject.words(key, edges=edges, size=subject.say(size)) for key, size in made if size)


def _ends(keys: RackSpec, subject: Subject) -> tuple[str, ...]:
    """By how much the ends of a helical rack, which run along its teeth, lean: no view shows it."""
    if not keys.helix_angle_deg:
        return ()
    angle = subject.say(abs(keys.helix_angle_deg))
    return (subject.words("rack_ends", angle=angle),)


def _engraved(keys: SpurGearSpec | RingGearSpec, subject: Subject) -> tuple[str, ...]:
    """What is engraved in the upper face."""
    if keys.tooth_mark is None:
        return ()
    height = subject.say(digits_height(subject.part.section(0.0)))
    words = "tooth_marked" if isinstance(keys, SpurGearSpec) else "space_marked"
    depth = subject.say(keys.tooth_mark.depth)
    return (subject.words(words, teeth=keys.number_of_teeth, depth=depth, height=height),)


def _thread_words(keys: WormSpec, subject: Subject) -> tuple[str, ...]:
    """How the thread ends, and where a keyway stands beside it."""
    words = {"cut": "thread_ends", "blunt": "thread_ends_blunt", "run_out": "thread_run_out"}[keys.thread_ends]
    angle = (keys.run_out_deg if keys.thread_ends == "run_out" else keys.end_angle_deg) or 0.0
    ends = subject.words(words, angle=subject.say(angle), length=subject.say(keys.thread_length))
    found = directions(holes_of(keys), subject, "zero_thread", keys.number_of_starts)
    return (() if keys.thread_ends == "cut" and not keys.end_angle_deg else (ends,)) + found


def _spur(keys: SpurGearSpec, subject: Subject) -> Wheel:
    gear: SpurGear = subject.part.thing
    shape = shape_of(keys)
    tip, outline = gear.tip_radius, subject.part.section(0.0).region.outer
    kept = _kept(gear)
    # below the axis stands the rest, or another run of an even number
    low = tip if not kept or len(kept) % 2 == 0 else gear.core_radius
    return Wheel(shape, gear.holes, (tip, low), outline, gear.root_radius, gear.reference_radius, kept=kept)


def _kept(gear: SpurGear | RingGear) -> tuple[tuple[float, float], ...]:
    """Directions between which the teeth of a sector stand, run by run, half a pitch more on either side, rad."""
    sector, pitch = gear.sector, gear.pitch_angle
    if sector is None:
        return ()
    low, high = (sector.centre(k, pitch, gear.sign) for k in (0, sector.teeth - 1))
    step = math.tau / sector.runs
    return tuple((low - pitch / 2 + step * k, high + pitch / 2 + step * k) for k in range(sector.runs))


def _sector_rounds(gear: SpurGear | RingGear, toothed: Profile) -> list[Round]:
    """The sizes of a sector on its face, whose run of teeth stands upwards: diameters and corners.

    The section tells the tip diameter of an even number of runs.
    """
    sector, (low, high) = gear.sector, _kept(gear)[0]
    assert sector is not None
    half, pitch = math.degrees(high - low - gear.pitch_angle) / 2, math.degrees(gear.pitch_angle)
    on_teeth = tuple(90 + way * (half - pitch * k) for k in range((sector.teeth + 1) // 2) for way in (-1, 1))
    found = [Round("tip_diameter", 0j, gear.tip_radius, angles=on_teeth)] if sector.runs % 2 else []
    if sector.stands_off:
        name, rest = "sector.hub_diameter" if sector.is_cut else "sector.blank_diameter", 90 + 180 / sector.runs
        found.append(Round(name, 0j, gear.core_radius, angles=tuple(rest + k for k in (0, 10, -10, 20, -20))))
    if sector.corner_radius:
        turn = Placement2((math.pi - low - high) / 2)
        arcs = (s.curve for s in toothed.period if isinstance(s.curve, Arc) and s.label is Label.BODY)
        corner, name = next(arcs).placed(turn), "sector.corner_radius"
        found.append(Round(name, corner.centre, corner.radius, "R", is_radius=True, angles=arc_angles(corner)))
    return found


def _requirements(
    keys: SpurGearSpec | RingGearSpec, gear: SpurGear | RingGear, subject: Subject, zero: str
) -> tuple[str, ...]:
    """What is engraved, where the rim of a sector ends, which no size tells, and where holes stand from ``zero`` on."""
    sector = gear.sector
    alike = keys.number_of_teeth if sector is None else sector.runs
    rim = (subject.words("sector_rim"),) if sector is not None and sector.stands_off else ()
    return *_engraved(keys, subject), *rim, *directions(gear.holes, subject, zero, alike)


def _worm_wheel(keys: WormWheelSpec, thing: WheelThing) -> Wheel:
    drive, teeth = thing.drive, thing.teeth
    shape, a = wheel_shape(teeth.width, keys.web, keys.hub, 0.0), drive.centre_distance
    edge = float(teeth.tip_radius(teeth.width / 2))
    crown = Crown(a, drive.throat_radius, a - drive.root_radius)
    holes = holes_of(spoked(keys, drive.root_radius))
    return Wheel(shape, holes, (edge, edge), None, drive.root_radius, drive.reference_radius, crown)


def _ring(keys: RingGearSpec, ring: RingGear, subject: Subject) -> tuple[View, ...]:
    """Axial section and face of a ring."""
    shape, outer, root = shape_of_ring(keys), ring.outer_radius, ring.root_radius
    width, low, high = shape.face_width, shape.chamfer_below, shape.face_width - shape.chamfer_above
    tip, pitch, wishes = ring.tip_radius, ring.reference_radius, subject.wishes
    kept = _kept(ring)
    turn = math.pi / 2 - sum(kept[0]) / 2 if kept else 0.0
    holes = replace(ring.holes, round_holes=tuple(replace(g, start=g.start + turn) for g in ring.holes.round_holes))
    bare = len(kept) % 2 == 1
    section = ring_section(shape, (tip, root, outer), holes, subject, ring.core_radius if bare else None)
    axes = [level((0.0, width), way * pitch) for way in ((1,) if bare else (1, -1))]
    told = Size("tip_diameter", complex(high, -tip), complex(high, tip), "right", "Ø", wishes.inner)
    rough = subject.worked(complex(width, pitch if bare else -pitch), goes_on=True)
    sizes = section.sizes[0], *(() if bare else (told,)), *section.sizes[1:]
    section = replace(
        section, axes=(*section.axes, *axes), sizes=sizes, notes=(rough,),
        rim=() if bare else spots(complex(low, tip), complex(high, tip), -1j),
        face=spots(complex(width, outer - width + high), complex(width, root), 1 + 0j),
    )  # fmt: skip
    region = subject.part.section(0.0).region
    toothed = region.holes[0]
    count = min(wishes.teeth, ring.number_of_teeth)
    teeth = exact_teeth(toothed, count, 0.0, tip) if count else [(VISIBLE, circle_of(tip))]
    placed = Placement2(turn)
    if kept:
        teeth = [(VISIBLE, s.curve.placed(placed)) for s in toothed.segments()]
    marks = [(THIN, s.curve.placed(placed)) for mark in region.marks for s in mark.segments()]
    face = ring_face(outer, holes, subject)
    outside, *others = face.strokes
    pitches = [(AXIS, arc) for arc in pitch_arcs(pitch, kept, turn)]
    face = replace(face, strokes=(outside, *pitches, *teeth, *others, *marks))
    return section, face.plus(rounds=_sector_rounds(ring, toothed)) if kept else face


def _rack(keys: RackSpec, rack: Rack, subject: Subject) -> tuple[View, ...]:
    """The rack from its side, its end teeth and as many more as are wished exact, and its section."""
    length, pitch, wishes = rack.length, rack.pitch, subject.wishes
    tip, root, foot = rack.addendum, -rack.dedendum, -rack.dedendum - rack.body_height
    region, half = subject.part.section(0.0).region, length / 2
    shown = max(1, math.ceil(wishes.teeth / 2)) * pitch
    strokes: list[Stroke] = []
    kept = [s.curve for s in region.outer.segments() if _beside(s.curve, half, shown)]
    strokes += [(VISIBLE, curve) for curve in kept]
    if 2 * shown < length:
        tips = [p.real for c in kept for p in (start_point(c), end_point(c)) if abs(p.imag - tip) < 1e-6]
        left, right = max(x for x in tips if x < 0), min(x for x in tips if x > 0)
        strokes += [(VISIBLE, Line(complex(left, tip), complex(right, tip))),
                    (THIN, Line(complex(-half + shown, root), complex(half - shown, root)))]  # fmt: skip
    first = complex(-half + pitch / 2)
    sizes = [
        Size("length", complex(-half, foot), complex(half, foot), "below"),
        Size("first_tooth", complex(-half, root), first + 1j * tip, "above"),
    ]
    axes = Line(complex(-half), complex(half)), Line(first + 1j * root, first + 1j * tip)
    rough = subject.worked(complex(half), goes_on=True)
    cut = Cut(half - pitch / 2, subject.letter())
    notes = [rough]
    # what is behind the near face lies aslant of it
    line = _tooth_line(keys)
    aslant = max((point.real for point in line), key=abs)
    at = _rack_break(rack, shown + 2 * abs(aslant) + pitch, _LEAST_KEPT * (tip - foot))
    if aslant:
        notes.append(Note(1j * tip, subject.letter(1), looks=-1j))
        for end in (-half, half):
            corners = [complex(end, foot), complex(end + aslant, foot), complex(end + aslant, root), complex(end, root)]
            seen = VISIBLE if end * aslant > 0 else HIDDEN
            strokes += [(seen, Line(a, b)) for a, b in pairwise(corners)]
    front = View(tuple(strokes), (), axes, tuple(sizes), notes=tuple(notes), cuts=(cut,))
    if rack.holes is not None:
        front = _with_holes(front, rack.holes, complex(-half, foot), root - rack.holes.depth, subject)
    section = _rack_section(keys.face_width, (foot, root, tip), cut.letter, wishes)
    tips = sorted({round(p.real, 9) for c in kept for p in (start_point(c), end_point(c)) if abs(p.imag - tip) < 1e-6})
    views = (front, *([_rack_top(half, tips, line, subject.letter(1), at)] if aslant else []))
    front, *others = views if at is None else (broken(view, at) for view in views)
    return front, section, *others


def _with_holes(front: View, holes: RackHoles, corner: complex, height: float, subject: Subject) -> View:
    """The front view of a rack with its holes, at a ``height``, told from its left lower ``corner``."""
    centres = [complex((k - (holes.count - 1) / 2) * holes.spacing, height) for k in range(holes.count)]
    sizes = [Size("holes.depth", corner, centres[0], "left")]
    if len(centres) > 1:
        sizes.append(Size("holes.spacing", centres[0], centres[1], "below"))
    if len(centres) > 2:
        chain = f"{holes.count - 1}×{subject.say(holes.spacing)}="
        sizes.append(Size("holes.all", centres[0], centres[-1], "below", chain))
    sizes.append(Size("holes.first", corner, centres[0], "below"))
    return front.plus(
        strokes=[(VISIBLE, circle_of(holes.diameter / 2, centre)) for centre in centres], sizes=sizes,
        rounds=[hole_round("holes.diameter", centres, holes.diameter / 2, subject)],
    )  # fmt: skip


def _rack_section(width: float, levels: tuple[float, float, float], letter: str, wishes: WorkingTable) -> View:
    """A rack cut across; ``levels``: of its foot, the roots and the tips, mm over the datum line."""
    foot, root, tip = levels
    return View(
        (*((VISIBLE, line) for line in block(0.0, width, foot, tip)),
         (VISIBLE, Line(complex(0, root), complex(width, root)))),
        (block(0.0, width, foot, root),),
        (Line(0j, complex(width)),),
        (
            Size("face_width", complex(0, foot), complex(width, foot), "below", "", wishes.width),
            Size("height", complex(width, foot), complex(width, tip), "right", "", wishes.tip),
            Size("datum_height", complex(0, foot), 0j, "left"),
        ),
        title=f"{letter}-{letter}",
        least=_LEAST_SECTION,
    )  # fmt: skip


def _rack_break(rack: Rack, shown: float, least: float) -> Break | None:
    """The break of a rack so long that its teeth would be too small: beside what is ``shown`` at either end, mm, and
    two holes there.
    """
    kept, half, holes = max(shown, least), rack.length / 2, rack.holes
    if holes is not None:
        first = half - (holes.count - 1) / 2 * holes.spacing
        # the other one of two stands at the other end
        kept = max(kept, first + (holes.spacing if holes.count > 2 else 0.0) + holes.diameter)
    return Break(half - kept, _GAP * least) if kept < _KEPT * half else None


def _tooth_line(keys: RackSpec) -> list[complex]:
    """A tooth line of a rack as it is seen from the tips, the near face below: from that on, which is at 0."""
    shear, width = helix_of(keys).shear(), keys.face_width
    stations = [] if shear is None else [(z, shift) for z, _, shift in shear.stations(0.0, width)][::-1]
    return [complex((shift - stations[0][1]).real, width - z) for z, shift in stations] or [0j]


def _rack_top(half: float, tips: Sequence[float], line: Sequence[complex], title: str, at: Break | None) -> View:
    """A helical rack from above: its ends, the edges of its end teeth, marks of their direction after GOST 2.402.

    ``tips``: places of edges on the near face; ``line``: a tooth line; ``at``: where it will be broken.
    """
    near = (-half, *tips, half)
    strokes: list[Stroke] = [(VISIBLE, Line(a + x, b + x)) for x in near for a, b in pairwise(line)]
    strokes += [(VISIBLE, Line(p - half, p + half)) for p in (line[0], line[-1])]
    middle, free = (line[0] + line[-1]) / 2, min(map(abs, near))
    if at is not None:
        middle, free = middle - (free + at.at) / 2, (free - at.at) / 2
    marks = [
        middle + _MARK * (point - (line[0] + line[-1]) / 2) + _APART * k * free for k in (-1, 0, 1) for point in line
    ]
    strokes += [(THIN, Line(a, b)) for k in range(3) for a, b in pairwise(marks[k * len(line) : (k + 1) * len(line)])]
    return View(tuple(strokes), title=title)


def _beside(curve: Curve, half: float, shown: float) -> bool:
    """Whether a curve of a rack is drawn as it is: at an end of it, or longer than what is left out."""
    xs = curve.point(np.linspace(*curve.domain, 5)).real
    return bool(xs.max() <= -half + shown + 1e-6 or xs.min() >= half - shown - 1e-6 or np.ptp(xs) > half)


def _with_thread(sizes: Sequence[Size], half: float, ends: tuple[complex, complex], root: float) -> list[Size]:
    """Lengths with that of the thread, from ``-half`` to ``half``, for one from the end of the shaft (GOST 2.406).

    ``ends``: of the shaft, below the axis; where it goes on at the radius of the ``root``, it has no corner there.
    """
    found = [*sizes]

    def ends_at(place: float) -> Size | None:
        return next((s for s in found if s.side == "below" and abs(s.end.real - place) < _NONE), None)

    for place in (-half, half):
        if ends[0].real + _NONE < place < ends[1].real - _NONE and ends_at(place) is None:
            found.append(Size(f"thread_end.{len(found)}", ends[0], complex(place, -root), "below"))
    before, last = ends_at(-half), ends_at(half)
    if before is None or last is None:
        return found
    thread = replace(last, name="thread_length", start=before.end)
    told = before if abs(ends[1].real - half) < _NONE else last
    return [thread if size is told else size for size in found]


def _thread_marks(worm: Worm, half: float, way: float) -> Iterator[Stroke]:
    """Which way the thread runs as it is seen, three lines near the axis after GOST 2.402: a right-hand one to the left
    as it rises (``way`` -1).
    """
    end = _MARK * worm.root_radius * complex(way * math.tan(worm.lead_angle), 1.0) / 2
    # within the thread, however short or steep it is
    end *= min(1.0, half / 2 / abs(end.real)) if end.real else 1.0
    apart = min(_APART * half, _APART * worm.root_radius)
    yield from ((THIN, Line(k * apart - end, k * apart + end)) for k in (-1, 0, 1))


def _worm(keys: WormSpec, body: WormBody, subject: Subject) -> tuple[View, ...]:
    """The worm with its shaft from outside, and its bore where that is not round."""
    worm, half, wishes = body.thread.worm, body.length / 2, subject.wishes
    outside = [complex(z, r) for z, r in body.envelope()]
    loop = closed([complex(outside[0].real, 0), *outside, complex(outside[-1].real, 0)])
    strokes: list[Stroke] = []
    for way, side in ((1, loop), (-1, below(loop))):
        strokes += outlined(side)
        strokes += [(VISIBLE, edge if way > 0 else edge.mirrored()) for edge in seen_edges(loop, cut=False)]
        roots = [complex(z, way * r) for z, r in body.root_line()]
        strokes += [(THIN, Line(a, b)) for a, b in pairwise(roots)]
    strokes += _thread_marks(worm, half, -1.0 if keys.hand == "right" else 1.0)
    low, high = body.ends()
    # the requirements tell the angle of the cones at the thread's ends, the table its depth
    cones = [c for c in loop if abs(c.start.imag - c.end.imag) > _NONE and abs(c.start.real - c.end.real) > _NONE
             and max(c.start.imag, c.end.imag) == worm.tip_radius]  # fmt: skip
    fits = Fits(wishes.shaft, "", wishes.tip)
    sizes = [*turned_sizes(loop, fits, subject.language, lambda curve: curve not in cones, listed=False).sizes]
    if body.run_out:
        root = level((-half, half), -worm.root_radius)
        sizes.append(Size("thread_length", root.start, root.end, "below"))
    else:
        sizes = _with_thread(sizes, half, (outside[0].conjugate(), outside[-1].conjugate()), worm.root_radius)
    bore = bore_of(keys)
    made = None if bore is None else bore.bore()
    if made is not None:
        up, down = bore_radii(made)
        strokes += [(HIDDEN, level((low, high), y)) for y in (-down, up)]
        strokes += [(HIDDEN, edge) for edge in (*keyway_edges(made, low, high), *spline_cut(made, low, high).roots)]
        if isinstance(made, RoundBore):
            sizes.append(Size("bore_diameter", complex(high, -down), complex(high, up), "right", "Ø", wishes.bore))
    rough = [subject.worked(complex(half, worm.reference_radius), goes_on=True)]
    if made is not None:
        rough.append(bore_note((low, high), -down, subject.rough(wishes.bore_roughness)))
    axes = (level((low, high), 0), *(level((-half, half), way * worm.reference_radius) for way in (1, -1)))
    view = View(tuple(strokes), (), axes, tuple(sizes), notes=tuple(rough))
    return with_bore((view,), made, high, subject)
