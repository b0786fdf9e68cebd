"""The part kinds ``turned`` (half a section about an axis: rings, balls, covers) and ``shaft`` (steps on an axis)."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, TypeVar

from msgspec import Meta, Struct, field

from geometry.base.errors import Nearest, OffsetError, ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.record import Record
from parts.base.kind import Kind, Others, Report
from parts.base.part_keys import MaterialKeys
from parts.base.texts import N_
from parts.keys.base import MOST_LENGTH, BoreDiameter, degrees, either, mm, part_mm, start
from parts.keys.holes import HolesTable, hub_holes
from parts.keys.pins import MARGIN, least_of, most_of, moved_region
from parts.keys.splines import SplineTable
from parts.keys.threads import Thread

if TYPE_CHECKING:
    from geometry.curves.curve import Complex
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile
    from geometry.solids.faced import FacedBody
    from geometry.solids.metric_threads import MetricThread
    from geometry.solids.sketch import Sketch
    from geometry.solids.turned import Corner, HalfSection, Pocket, Splined
    from parts.base.readback import Probe

# of a centre hole: half the angle of its cone, and of its tip; its mouth and depth in diameters, where none is given
_CONE, _TIP, _MOUTH, _DEPTH = math.radians(30), math.radians(60), 2.12, 1.0
# mm: what is one diameter
_SAME = 1e-6
_Chamfer = Annotated[float, part_mm("both legs of the chamfer of its outer edges", least=0)]
_Fillet = Annotated[float, part_mm("rounding where it meets what is thicker", least=0)]
_Radii = "above 0 bulges out of the material, below 0 into it; 0: a line"


class PointTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A corner of half the section."""

    r: Annotated[float, part_mm("distance from the axis", least=0)]
    z: Annotated[float, part_mm("height", least=-MOST_LENGTH)]
    arc: Annotated[float, part_mm(f"radius of the arc to the next point: {_Radii}", least=-MOST_LENGTH)] = 0.0
    chamfer: Annotated[float, part_mm("both legs of a chamfer between two lines", least=0)] = 0.0
    fillet: Annotated[float, part_mm("radius of a rounding between two lines", least=0)] = 0.0


_RING = [
    {"r": 10.0, "z": 0.0},
    {"r": 15.0, "z": 0.0, "chamfer": 0.5},
    {"r": 15.0, "z": 8.0},
    {"r": 10.0, "z": 8.0},
]

_BALL = [{"r": 0.0, "z": 0.0, "arc": 5.0}, {"r": 0.0, "z": 10.0}]

_POINTS = Meta(
    min_length=2,
    max_length=1000,
    description="the corners of half the section, one after the other; the last one is joined to the first",
)


class TurnedSpec(MaterialKeys, kw_only=True, tag_field="kind", tag="turned"):
    """Keys of ``turned``."""

    points: Annotated[
        list[PointTable], _POINTS, start(_RING, (_BALL, N_("a ball: half a circle, by the radius of its arc")))
    ]
    holes: HolesTable | list[HolesTable] | None = None


class GrooveTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A groove round a step, as for a ring that holds a bearing."""

    at: Annotated[float, part_mm("from the lower end of the step to the groove", least=0)]
    width: Annotated[float, part_mm("width of the groove", least=0.01)]
    diameter: Annotated[float, part_mm("at its bottom", above=0)]
    fillet: Annotated[float, part_mm("rounding of its bottom", least=0)] = 0.0


_SHAFT_KEYWAY_DEPTH = part_mm("depth t1 in the shaft; default: the standard's", above=0, example=3.5)


class ShaftKeywayTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A keyway by a standard, or of your own width and depth."""

    at: Annotated[float, part_mm("from the lower end of the step to the keyway", least=0)]
    length: Annotated[float, part_mm("length of the keyway, its round ends included", above=0)]
    standard: Literal["DIN 6885", "GOST 23360"] = "DIN 6885"
    width: Annotated[float, part_mm("width b; default: the standard's", above=0, example=6.0)] | None = None
    depth: Annotated[float, _SHAFT_KEYWAY_DEPTH] | None = None
    angle_deg: Annotated[float, degrees("direction of its middle", least=-360, most=360)] = 90.0
    ends: Annotated[Literal["round", "square"], Meta(description="as an end mill or a disk leaves them")] = "round"


_FLATS_LENGTH = part_mm("length from that end; default: the whole step", above=0, example=10.0)
_END = Meta(description="of the step, from which the flats run")


class FlatsTable(Struct, forbid_unknown_fields=True, kw_only=True, tag_field="shape"):
    """Flats of a step."""

    length: Annotated[float, _FLATS_LENGTH] | None = None
    end: Annotated[Literal["lower", "upper"], _END] = "lower"
    angle_deg: Annotated[float, degrees("direction of the first one", least=-360, most=360)] = 90.0
    count: ClassVar[int]
    size: ClassVar[str]

    def floor(self, diameter: float) -> float:
        """From the axis to a flat, mm."""
        one = self.told(diameter, 1.0) - (none := self.told(diameter, 0.0))
        return float((getattr(self, self.size) - none) / one)

    def told(self, diameter: float, floor: float) -> float:
        """What tells flats so far from the axis, mm."""
        raise NotImplementedError


class FlatTable(FlatsTable, tag="D"):
    """One flat, as a D bore takes it."""

    flat: Annotated[float, part_mm("from the flat to the opposite side", above=0, example=4.5)]
    count, size = 1, "flat"

    def told(self, diameter: float, floor: float) -> float:
        """See FlatsTable."""
        return floor + diameter / 2


class DoubleFlatTable(FlatsTable, tag="double_D"):
    """Two opposite flats, as a double D bore takes them."""

    across_flats: Annotated[float, part_mm("from a flat to the opposite one", above=0, example=4.0)]
    count, size = 2, "across_flats"

    def told(self, diameter: float, floor: float) -> float:
        """See FlatsTable."""
        return 2 * floor


_GROOVES = Meta(max_length=100, examples=[[{"at": 2.0, "width": 1.1, "diameter": 11.5}]])
_KEYWAYS = Meta(max_length=100, examples=[[{"at": 4.0, "length": 12.0}]])


class StepTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A step of a shaft."""

    diameter: Annotated[float, part_mm("diameter", above=0)]
    length: Annotated[float, part_mm("length along the axis", above=0)]
    chamfer: _Chamfer = 0.0
    fillet: _Fillet = 0.0
    grooves: Annotated[list[GrooveTable], _GROOVES] = field(default_factory=list)
    keyways: Annotated[list[ShaftKeywayTable], _KEYWAYS] = field(default_factory=list)
    spline: SplineTable | None = None
    flats: FlatTable | DoubleFlatTable | None = None
    thread: Thread | None = None


_CENTRE_HOLES_MOUTH = mm("of the cone at the end face; default: 2.12 diameters", above=0, most=1000, example=4.25)
_CENTRE_HOLES_DEPTH = mm("of the pilot behind the cone; default: one diameter", least=0, most=1000, example=2.0)


class CentreHolesTable(Struct, forbid_unknown_fields=True):
    """Centre holes in both ends: a pilot with a tip of 120 degrees behind a cone of 60 degrees."""

    diameter: Annotated[float, mm("diameter of the pilot", above=0, most=1000, example=2.0)]
    mouth: Annotated[float, _CENTRE_HOLES_MOUTH] | None = None
    depth: Annotated[float, _CENTRE_HOLES_DEPTH] | None = None


_STEPS = [{"diameter": 12.0, "length": 20.0, "chamfer": 0.5}, {"diameter": 20.0, "length": 30.0}]

_WHOLE = [
    {"diameter": 12.0, "length": 10.0, "chamfer": 1.5, "thread": "M12"},
    {"diameter": 17.0, "length": 22.0, "chamfer": 1.0, "fillet": 0.8, "keyways": [{"at": 3.0, "length": 16.0}]},
    {
        "diameter": 25.0,
        "length": 15.0,
        "grooves": [{"at": 6.0, "width": 1.3, "diameter": 23.9}],
        "flats": {"shape": "double_D", "across_flats": 22.0, "length": 5.0},
    },
    {"diameter": 20.0, "length": 30.0, "spline": {"shape": "spline", "size": "6x16x20"}},
]

_SHAFT_STEPS = Meta(min_length=1, max_length=200, description="from the lower end upwards")


class ShaftSpec(MaterialKeys, kw_only=True, tag_field="kind", tag="shaft"):
    """Keys of ``shaft``."""

    steps: Annotated[
        list[StepTable],
        _SHAFT_STEPS,
        start(_STEPS, (_WHOLE, N_("a thread, keyways, a fillet, a groove, flats, a spline"))),
    ]
    bore_diameter: BoreDiameter = 0.0
    centre_holes: CentreHolesTable | None = None


K = TypeVar("K", TurnedSpec, ShaftSpec)


class _Turned(Kind[K, "HalfSection"]):
    """A solid turned about its axis; its flat section is what is seen along it."""

    unmoved = "turned_as_it_is"

    def section(self, keys: K, thing: HalfSection, offset: float) -> OffsetRegion:
        """Its greatest circle, or its spline, with all that goes through."""
        from geometry.plane.profile import Label, Region, circle

        inner, outer = thing.radii()
        spline, flat = thing.seen_spline(), thing.seen_flat()
        through = [(0j, inner)] * (inner > 0) + [(hole.centre, hole.radius) for hole in thing.holes]

        def build(by: float) -> Region:
            for _, radius in through:
                if radius <= by:
                    raise OffsetError(by, "hole_closed", radius * (1 - 1e-6))
            if outer + by <= max((abs(at) + radius - by for at, radius in through), default=0.0):
                raise OffsetError(by, "leaves_no_wall")
            holes = tuple(
                circle(radius - by, Label.HOLE if at else Label.BORE, hole=True, centre=at) for at, radius in through
            )
            if spline is not None:
                return Region(spline.outline(by), holes)
            return Region(circle(outer + by, Label.BODY) if flat is None else _turned_about(flat.profile(-by)), holes)

        return moved_region(build, offset)

    def solid(self, keys: K, thing: HalfSection, offset: float) -> FacedBody:
        """Its faces, all of them exact."""
        from geometry.solids.turned import turned_body

        return turned_body(thing, _seam(thing.pockets))

    def sketch(self, keys: K, thing: HalfSection) -> Sketch:
        """It without its pockets; a shaft is not hatched along its axis."""
        from geometry.solids.sketch import sketch_of_turned

        return sketch_of_turned(thing, is_shaft=isinstance(keys, ShaftSpec))

    def axial_section(self, thing: HalfSection, chord: float) -> Complex:
        """It without its holes and pockets."""
        return thing.chords(chord)

    def height(self, keys: K, thing: HalfSection) -> float:
        """From its lowest to its highest place."""
        low, high = thing.heights()
        return high - low

    def probes(self, keys: K, thing: HalfSection) -> tuple[Probe, ...]:
        """The hub, put on every spline."""
        if not isinstance(keys, ShaftSpec) or not thing.splines:
            return ()
        from parts.keys.spline_probe import SplineProbe

        splined = [(k, step.spline.bore()) for k, step in enumerate(keys.steps, 1) if step.spline]
        names = ["spline"] if len(splined) == 1 else [f"spline_{k}" for k, _ in splined]
        seen = thing.seen_spline()
        return tuple(
            SplineProbe(bore, (s.low + s.high) / 2, True, s == seen, name=name)
            for (_, bore), s, name in zip(splined, thing.splines, names, strict=True)
        )

    def report(self, keys: K, thing: HalfSection) -> Report:
        """Its sizes."""
        inner, outer = thing.radii()
        bore = {"bore_diameter": 2 * inner} if inner > 0 else {}
        remarks = tuple(_remarks(keys)) if isinstance(keys, ShaftSpec) else ()
        return Report(remarks, quantities={"outer_diameter": 2 * outer, **bore, "length": self.height(keys, thing)})


def _remarks(keys: ShaftSpec) -> Iterator[Finding]:
    """What the solid leaves to drawings, and roundings and chamfers of steps that have no such corner."""
    for part in threaded(keys):
        yield Finding("cosmetic_thread", part.thread.diameter, part.thread.pitch)
    radii = [0.0, *map(_radius, keys.steps), 0.0]
    for k, step in enumerate(keys.steps, 1):
        beside = radii[k - 1], radii[k + 1]
        if step.fillet and max(beside) <= radii[k]:
            yield Finding("fillet_at_no_end", float(k), step.fillet)
        if step.chamfer and min(beside) >= radii[k]:
            yield Finding("chamfer_at_no_end", float(k), step.chamfer)


def _turned_about(profile: Profile) -> Profile:
    """The same boundary, run through the other way."""
    from geometry.plane.profile import Profile, Segment

    return Profile(tuple(Segment(s.curve.reversed(), s.label) for s in reversed([*profile.segments()])))


def _seam(pockets: tuple[Pocket, ...]) -> float:
    """An angle away from all pockets, rad.

    Raises
    ------
    ParameterError
        ``steps``: flats take all sides.
    """
    if not pockets:
        return 0.0

    def free(turn: float) -> float:
        return min(abs(math.remainder(turn - p.angle, math.tau)) - math.atan2(p.width / 2, p.floor) for p in pockets)

    found = max((math.tau * k / 360 for k in range(360)), key=free)
    if free(found) <= 0 and any(p.is_flat for p in pockets):
        raise ParameterError("steps", None, "flats_all_round")
    return found


class Turned(_Turned[TurnedSpec]):
    """Half a section, turned."""

    name, keys = "turned", TurnedSpec
    drawing = "parts.bodies.turned_drawing"
    data_table = "parts.bodies.turned_table"

    def thing(self, keys: TurnedSpec, others: Others) -> HalfSection:
        """The section, checked to enclose one body."""
        from geometry.solids.turned import Corner, HalfSection, Hole, half_section, turned_solid

        for k, p in enumerate(keys.points, 1):
            if p.chamfer and p.fillet:
                raise either(f"points[{k}].chamfer", p.chamfer, "fillet", 0.0)
        pieces = half_section([Corner(complex(p.r, p.z), p.arc, p.chamfer, p.fillet) for p in keys.points])
        groups = hub_holes(None, keys.holes, None).round_holes
        holes = [Hole(centre, group.diameter / 2) for group in groups for centre in group.centres()]
        for k, hole in enumerate(holes):
            if any(abs(hole.centre - other.centre) <= hole.radius + other.radius for other in holes[:k]):
                raise ParameterError("holes", None, "hole_reaches_edge")
        found = HalfSection(pieces, tuple(holes))
        turned_solid(found)
        return found


class Shaft(_Turned[ShaftSpec]):
    """A shaft, its lower end at z = 0."""

    name, keys = "shaft", ShaftSpec
    drawing = "parts.bodies.turned_drawing"
    data_table = "parts.bodies.turned_table"

    def thing(self, keys: ShaftSpec, others: Others) -> HalfSection:
        """The section of all steps, checked."""
        from geometry.solids.turned import HalfSection, half_section

        _check_shaft(keys)
        tuple(threaded(keys))
        splines = tuple(_splines(keys))
        corners, owners = zip(*_outline(keys), strict=True)
        try:
            pieces = half_section(corners)
        except ParameterError as refusal:
            place = re.match(r"points\[(\d+)\]", refusal.name)
            number = int(place[1]) if place else 1
            raise refusal.renamed(owners[number - 1]) from refusal
        pockets = tuple(_pockets(keys))
        _seam(pockets)
        return HalfSection(pieces, (), pockets, splines)


def _groove_beyond(name: str, groove: GrooveTable, place: float, room: float, length: float) -> ParameterError:
    """The refusal of a groove that does not lie between two places of its step, by its place or its width."""
    most, told = room - groove.width, {"least": place, "length": length}
    if most > place:
        end = most * (1 - 1e-6) if groove.at > place else place + 1e-6 * length
        cure = limit(end, groove.at, digits=6)
        return ParameterError(f"{name}.at", groove.at, "groove_beyond_step", cure, **told)
    left = (room - groove.at) * (1 - 1e-6)
    narrow = limit(left, groove.width, digits=6) if groove.at > place and left > 0 else None
    return ParameterError(f"{name}.width", groove.width, "groove_beyond_step", narrow, **told)


def _check_shaft(keys: ShaftSpec) -> None:
    """The bore leaves walls, grooves and centre holes fit.

    Raises
    ------
    ParameterError
        One does not.
    """
    z, whole = 0.0, sum(step.length for step in keys.steps)
    if keys.bore_diameter and keys.centre_holes is not None:
        raise either("bore_diameter", keys.bore_diameter, "centre_holes", 0.0)
    radii = [0.0, *map(_radius, keys.steps), 0.0]
    for k, step in enumerate(keys.steps, 1):
        if radii[k - 1] < radii[k] > radii[k + 1] and step.chamfer > step.length / 2:
            # of a step that stands out at both of its ends
            most = limit(step.length / 2, step.chamfer, digits=6)
            raise ParameterError(f"steps[{k}].chamfer", step.chamfer, "corner_longer_than_edge", most)
        least = min([step.diameter, *(g.diameter for g in step.grooves)])
        if keys.bore_diameter >= least:
            most = most_of(least, keys.bore_diameter)
            raise ParameterError("bore_diameter", keys.bore_diameter, "leaves_no_wall", most)
        _check_grooves(keys, k, z, whole)
        z += step.length
    _check_ends(keys, whole)


def _check_grooves(keys: ShaftSpec, k: int, z: float, whole: float) -> None:
    """Grooves of step ``k`` (from 1), which begins at ``z``, apart and clear of centre holes, or a ParameterError."""
    step = keys.steps[k - 1]
    place, room = step.chamfer, step.length - step.chamfer
    for number, groove in sorted(enumerate(step.grooves, 1), key=lambda pair: pair[1].at):
        name = f"steps[{k}].grooves[{number}]"
        if groove.diameter >= step.diameter:
            cure = most_of(step.diameter, groove.diameter)
            raise ParameterError(f"{name}.diameter", groove.diameter, "groove_not_in_step", cure)
        if groove.at <= place or groove.at + groove.width >= room:
            raise _groove_beyond(name, groove, place, room, step.length)
        # both of its corners, and its walls
        if groove.fillet > (widest := min(groove.width, step.diameter - groove.diameter) / 2):
            cure = limit(widest, groove.fillet, digits=6)
            raise ParameterError(f"{name}.fillet", groove.fillet, "corner_longer_than_edge", cure)
        place = groove.at + groove.width
        inside = 2 * _inside(keys, min(z + groove.at, whole - z - place))
        if groove.diameter <= inside:
            cure = least_of(inside, groove.diameter)
            raise ParameterError(f"{name}.diameter", groove.diameter, "groove_into_centre_hole", cure)


def _check_ends(keys: ShaftSpec, whole: float) -> None:
    """End faces keep a ring about the bore or the mouth of a centre hole, or a ParameterError."""
    mouth, centre = _mouth(keys), keys.centre_holes
    if centre is not None and mouth <= centre.diameter:
        cure = least_of(centre.diameter, mouth)
        raise ParameterError("centre_holes.mouth", mouth, "mouth_within_pilot", cure, diameter=centre.diameter)
    for k in (1, len(keys.steps)):
        step = keys.steps[k - 1]
        if step.chamfer >= (room := (step.diameter - keys.bore_diameter) / 2):
            most = most_of(room, step.chamfer)
            raise ParameterError(f"steps[{k}].chamfer", step.chamfer, "chamfer_leaves_nothing_of_step", most)
        if mouth >= step.diameter - 2 * step.chamfer:
            most = most_of(step.diameter - 2 * step.chamfer, mouth)
            raise ParameterError("centre_holes.mouth", mouth, "leaves_no_wall", most)
    if centre is not None:
        _check_centre_holes(keys, centre, mouth, whole)


def _check_centre_holes(keys: ShaftSpec, centre: CentreHolesTable, mouth: float, whole: float) -> None:
    """Holes that stay within every step and do not meet, or a ParameterError."""
    z, slope = 0.0, math.tan(_CONE)
    for step in keys.steps:
        z += step.length
        # where a step ends nearer to an end face a hole is widest in it
        for depth in (whole - z, z - step.length):
            most = step.diameter + 2 * slope * depth
            if 2 * _inside(keys, depth) >= step.diameter:
                cure = most_of(most, mouth) if most > centre.diameter < step.diameter else None
                raise ParameterError("centre_holes.mouth", mouth, "leaves_no_wall", cure)
    beyond = next(_end(keys)).imag - whole / 2
    if beyond < 0:
        return
    depth = _DEPTH * centre.diameter if centre.depth is None else centre.depth
    for key, value, most, least in (
        ("depth", depth, depth - beyond, 0.0), ("mouth", mouth, mouth - 2 * slope * beyond, centre.diameter),
    ):  # fmt: skip
        if most > least:
            cure = limit(most - 1e-6, value, digits=6)
            raise ParameterError(f"centre_holes.{key}", value, "centre_holes_meet", cure)
    raise ParameterError("centre_holes.diameter", centre.diameter, "centre_holes_meet")


def _radius(step: StepTable) -> float:
    """Of its outside, mm: a spline stands its clearance off."""
    return step.diameter / 2 - (step.spline.clearance if step.spline else 0.0)


def _splines(keys: ShaftSpec) -> Iterator[Splined]:
    """The splines of all steps.

    Raises
    ------
    ParameterError
        The step is not as thick as its teeth, has something beside them, or a neighbour ends amid them.
    """
    from geometry.solids.turned import Splined

    inside = max(keys.bore_diameter, _mouth(keys)) / 2
    steps, z = keys.steps, 0.0
    for k, step in enumerate(steps):
        name, z = f"steps[{k + 1}]", z + step.length
        if step.spline is None:
            continue
        made = step.spline.checked(f"{name}.spline")
        form = made.joint.shaft()
        if abs(2 * form.outer - step.diameter) > _SAME:
            cure = Nearest(round(2 * form.outer, 9))
            raise ParameterError(f"{name}.diameter", step.diameter, "not_over_spline", cure)
        root = form.inner - made.clearance
        if step.chamfer:
            code = "chamfer_of_spline"
            raise ParameterError(f"{name}.chamfer", step.chamfer, code, Nearest(None), root=2 * root)
        for key in ("fillet", "grooves", "keyways", "flats", "thread"):
            if given := getattr(step, key):
                raise ParameterError(f"{name}.{key}", given, "beside_spline", Nearest(None))
        if inside >= root:
            key = "bore_diameter" if keys.bore_diameter else "centre_holes.mouth"
            raise ParameterError(key, 2 * inside, "leaves_no_wall", most_of(2 * root, 2 * inside))
        for other in (k - 1, k + 1):
            if 0 <= other < len(steps):
                beside, own = steps[other], f"steps[{other + 1}]"
                told = {"root": 2 * root, "tip": 2 * _radius(step)}
                # of splines of both the larger one has the smaller one within its roots, as its own turn tells
                if _radius(beside) + beside.fillet < root:
                    continue
                if _radius(beside) - beside.chamfer > _radius(step):
                    continue
                raise ParameterError(f"{own}.diameter", beside.diameter, "ends_amid_spline", **told)
        yield Splined(z - step.length, z, form, made.clearance, made.angle)


class Threaded(Record):
    """A thread on a step of a shaft, between two heights, mm; the solid is a cylinder there."""

    low: float
    high: float
    thread: MetricThread


def threaded(keys: ShaftSpec) -> Iterator[Threaded]:
    """The threads of all steps.

    Raises
    ------
    ParameterError
        There is no such thread, the step is not as thick as it, or a hole leaves no wall.
    """
    from parts.keys.threads import thread_of

    z = 0.0
    for k, step in enumerate(keys.steps, 1):
        z += step.length
        if step.thread is None:
            continue
        try:
            thread = thread_of(step.thread)
        except ParameterError as refusal:
            raise refusal.renamed(f"steps[{k}].thread") from refusal
        if abs(thread.diameter - step.diameter) > _SAME:
            cure = Nearest(thread.diameter)
            raise ParameterError(f"steps[{k}].diameter", step.diameter, "not_of_thread", cure, thread=step.thread)
        mouth = _mouth(keys) if k in (1, len(keys.steps)) else 0.0
        for key, hole in (("bore_diameter", keys.bore_diameter), ("centre_holes.mouth", mouth)):
            if hole >= thread.root_diameter:
                raise ParameterError(key, hole, "leaves_no_wall", most_of(thread.root_diameter, hole))
        yield Threaded(z - step.length, z, thread)


def _mouth(keys: ShaftSpec) -> float:
    centre = keys.centre_holes
    return 0.0 if centre is None else centre.mouth or _MOUTH * centre.diameter


def _outline(keys: ShaftSpec) -> Iterator[tuple[Corner, str]]:
    """The corners of half the section from the lower end upwards, each with the key that shapes it."""
    from geometry.solids.turned import Corner

    low = list(_end(keys))
    yield from ((Corner(at), "centre_holes.diameter") for at in low)
    z, steps, before = 0.0, keys.steps, keys.bore_diameter / 2
    for k, step in enumerate(steps):
        radius, own = _radius(step), f"steps[{k + 1}]"
        if radius > before:
            if k:
                last = steps[k - 1]
                yield Corner(complex(before, z), fillet=last.fillet), f"steps[{k}].fillet"
            yield Corner(complex(radius, z), chamfer=step.chamfer), f"{own}.chamfer"
        elif radius < before:
            yield Corner(complex(before, z), chamfer=steps[k - 1].chamfer), f"steps[{k}].chamfer"
            yield Corner(complex(radius, z), fillet=step.fillet), f"{own}.fillet"
        for number, groove in sorted(enumerate(step.grooves, 1), key=lambda pair: pair[1].at):
            depth, ends, name = groove.diameter / 2, (z + groove.at, z + groove.at + groove.width), f"{own}.grooves"
            yield Corner(complex(radius, ends[0])), name
            yield Corner(complex(depth, ends[0]), fillet=groove.fillet), f"{name}[{number}].fillet"
            yield Corner(complex(depth, ends[1]), fillet=groove.fillet), f"{name}[{number}].fillet"
            yield Corner(complex(radius, ends[1])), name
        z, before = z + step.length, radius
    yield Corner(complex(before, z), chamfer=steps[-1].chamfer), f"steps[{len(steps)}].chamfer"
    yield from ((Corner(complex(at.real, z - at.imag)), "centre_holes.diameter") for at in low[::-1])


def _inside(keys: ShaftSpec, depth: float) -> float:
    """Radius of a centre hole so deep below its end face, mm."""
    for inner, outer in pairwise(_end(keys)):
        if outer.imag <= depth <= inner.imag and inner.imag > outer.imag:
            return inner.real + (outer.real - inner.real) * (inner.imag - depth) / (inner.imag - outer.imag)
    return 0.0


def _end(keys: ShaftSpec) -> Iterator[complex]:
    """What of an end face is nearest to the axis, from within outwards."""
    centre = keys.centre_holes
    if centre is None:
        yield complex(keys.bore_diameter / 2, 0.0)
        return
    radius, mouth = centre.diameter / 2, _mouth(keys) / 2
    cone = (mouth - radius) / math.tan(_CONE)
    depth = cone + (_DEPTH * centre.diameter if centre.depth is None else centre.depth)
    yield complex(0.0, depth + radius / math.tan(_TIP))
    if depth > cone:
        yield complex(radius, depth)
    yield complex(radius, cone)
    yield complex(mouth, 0.0)


def _pockets(keys: ShaftSpec) -> Iterator[Pocket]:
    """The flats and the keyways of all steps.

    Raises
    ------
    ParameterError
        One leaves its step, or meets another one or a centre hole.
    """
    from geometry.solids.keyways import keyway_row
    from geometry.solids.turned import Pocket

    z, whole = 0.0, sum(step.length for step in keys.steps)
    for k, step in enumerate(keys.steps, 1):
        made = [*_flats(keys, k, z)]
        yield from made
        for number, way in enumerate(step.keyways, 1):
            name, radius = f"steps[{k}].keyways[{number}]", step.diameter / 2
            width, depth = way.width, way.depth
            if width is None or depth is None:
                try:
                    row = keyway_row(way.standard, step.diameter)
                except ParameterError as refusal:
                    raise refusal.renamed(f"steps[{k}].diameter") from refusal
                width, depth = width or row.width, depth or row.shaft_depth
            floor = radius - depth
            ends = way.at, way.at + way.length
            # a centre hole is widest at that end of the keyway which is nearer to its end face
            inside = max(keys.bore_diameter / 2, _inside(keys, min(z + ends[0], whole - z - ends[1])))
            rim = math.sqrt(max(radius**2 - width**2 / 4, 0.0))
            if not inside < floor < rim:
                code = "groove_into_centre_hole" if keys.bore_diameter / 2 < floor < rim else "keyway_of_no_depth"
                near = most_of(radius - inside, depth) if floor < rim else least_of(radius - rim, depth)
                raise ParameterError(f"{name}.depth", depth, code, near if inside < rim else None)
            if width >= way.length and way.ends == "round":
                least = least_of(width, way.length)
                raise ParameterError(f"{name}.length", way.length, "keyway_shorter_than_wide", least, width=width)
            cuts = [(0.0, max(step.chamfer, step.fillet)), (step.length - max(step.chamfer, step.fillet), step.length)]
            cuts += [(g.at, g.at + g.width) for g in step.grooves]
            if any(ends[0] <= b and a <= ends[1] for a, b in cuts):
                raise _keyway_beyond(name, way, cuts, step.length)
            turn = math.radians(way.angle_deg)
            found = Pocket(z + ends[0], z + ends[1], width, floor, turn, way.ends == "round")
            if any(
                found.low <= other.high and other.low <= found.high and _meet(found, other, radius) for other in made
            ):
                raise ParameterError(f"{name}.angle_deg", way.angle_deg, "keyways_meet")
            made.append(found)
            yield found
        z += step.length


def _flats(keys: ShaftSpec, number: int, z: float) -> Iterator[Pocket]:
    """The flats of a step that begins at height z.

    Raises
    ------
    ParameterError
        They cut no step or its hole, leave it, or meet what else is cut from it or stands beside it.
    """
    from geometry.solids.turned import Pocket

    step, name = keys.steps[number - 1], f"steps[{number}].flats"
    if (flats := step.flats) is None:
        return
    radius, floor, whole = step.diameter / 2, flats.floor(step.diameter), sum(s.length for s in keys.steps)
    length = step.length if flats.length is None else flats.length
    ends = (0.0, length) if flats.end == "lower" else (step.length - length, step.length)
    inside = max(keys.bore_diameter / 2, _inside(keys, max(min(z + ends[0], whole - z - ends[1]), 0.0)))
    if not inside < floor < radius:
        code = "flat_outside_step" if floor >= radius else "flat_into_hole" if inside else "flat_beyond_axis"
        given, most, least = (getattr(flats, flats.size), *(flats.told(step.diameter, at) for at in (radius, inside)))
        cure = most_of(most, given) if floor >= radius else least_of(least, given)
        raise ParameterError(f"{name}.{flats.size}", given, code, cure)
    beside = [keys.steps[k] if 0 <= k < len(keys.steps) else None for k in (number - 2, number)]
    # at either end a chamfer of what stands out, or a fillet of what does not
    thicker = [other is not None and _radius(other) > radius for other in beside]
    edges = [step.fillet if is_thicker else step.chamfer if other is None or _radius(other) < radius else 0.0
             for is_thicker, other in zip(thicker, beside, strict=True)]  # fmt: skip
    own, far = edges if flats.end == "lower" else edges[::-1]
    grooves = [g.at if flats.end == "lower" else step.length - g.at - g.width for g in step.grooves]
    room = min([step.length - far, *grooves])
    may_be_whole = not grooves and not (thicker[flats.end == "lower"] and far) and step.length > sum(edges)
    if not (own < length < room or (length == step.length and may_be_whole)):
        margin = 1e-3 * MARGIN * step.length
        cure = limit(min(max(length, own + margin), room - margin), length, digits=6)
        if length > step.length and may_be_whole:
            cure = Nearest(step.length, "at_most")
        fits = own + margin < room - margin
        raise ParameterError(f"{name}.length", length, "flats_beyond_step", cure if fits else None, length=step.length)
    for k, other, reaches in zip((-1, 1), beside, (ends[0] <= 0, ends[1] >= step.length), strict=True):
        if not reaches or other is None:
            continue
        if step.fillet and _radius(other) > radius:
            raise ParameterError(f"steps[{number}].fillet", step.fillet, "fillet_beside_flats", Nearest(0.0))
        if _radius(other) == radius:
            if other.flats and (other.flats.length in (None, other.length) or (other.flats.end == "upper") == (k < 0)):
                raise ParameterError(f"steps[{number + k}].flats", None, "flats_meet")
        elif floor <= (inner := _radius(other) + other.fillet) < radius:
            given = getattr(flats, flats.size)
            cure = least_of(flats.told(step.diameter, inner), given)
            raise ParameterError(f"{name}.{flats.size}", given, "flat_within_step_beside", cure, diameter=2 * inner)
    width = 2 * math.sqrt((radius - floor) * (radius + floor))
    for turn in range(flats.count):
        angle = math.radians(flats.angle_deg) + math.pi * turn
        yield Pocket(z + ends[0], z + ends[1], width, floor, angle, round_ends=False, is_flat=True)


def _keyway_beyond(name: str, way: ShaftKeywayTable, cuts: list[tuple[float, float]], length: float) -> ParameterError:
    """The refusal of a keyway that meets what is cut from its step, by its place or its length; ``cuts``: from, to."""
    cuts, margin = sorted(cuts), 1e-3 * MARGIN * length
    ends = [max(b for _, b in cuts[: k + 1]) + margin for k in range(len(cuts) - 1)]
    rooms = [(low, after[0] - margin) for low, after in zip(ends, cuts[1:], strict=True)]
    places = [min(max(way.at, low), high - way.length) for low, high in rooms if high - low >= way.length]
    if places:
        place = min(places, key=lambda place: abs(place - way.at))
        cure = limit(place, way.at, digits=6)
        return ParameterError(f"{name}.at", way.at, "keyway_beyond_step", cure, length=length)
    room = next((high - way.at for low, high in rooms if low <= way.at < high), 0.0)
    most = limit(room, way.length, digits=6) if room > 0 else None
    return ParameterError(f"{name}.length", way.length, "keyway_beyond_step", most, length=length)


def _meet(one: Pocket, other: Pocket, radius: float) -> bool:
    """Whether the sections of two keyways or flats of a step, each as wide as at its floor, have a point in common."""
    corners = []
    for pocket in (one, other):
        half = pocket.width / 2
        # all beyond a flat is gone
        rim = radius if pocket.is_flat else math.sqrt(radius**2 - half**2)
        corners.append(
            [cmath.rect(1.0, pocket.angle) * complex(x, y) for x in (pocket.floor, rim) for y in (-half, half)]
        )
    # convex ones are apart where the normal of a side parts them; behind the chords of the rim they are apart then too
    for way in (cmath.rect(1.0, pocket.angle + turn) for pocket in (one, other) for turn in (0.0, math.pi / 2)):
        first, second = ([(point * way.conjugate()).real for point in points] for points in corners)
        if max(first) < min(second) or max(second) < min(first):
            return False
    return True


TURNED, SHAFT = Turned(), Shaft()
