"""The part kind ``worm``: a cylindrical worm with its shaft."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct, field
from msgspec.structs import replace as changed

from geometry.base.errors import LateError, Nearest, ParameterError, limit
from geometry.base.findings import Finding
from geometry.solids.hub_holes import HubHoles, least_wall
from parts.base.kind import Kind, Others, Report, diameters
from parts.base.part_keys import MaterialKeys
from parts.keys.accuracy import AccuracyKey
from parts.keys.base import BoreDiameter, check_idle, degrees, in_vain, mm
from parts.keys.holes import BoreTable, check_shape, holes_of, wide_bore
from parts.keys.worm import (
    Addendum,
    AxialModule,
    Clearance,
    Fillet,
    Form,
    GrindingWheel,
    LeadAngle,
    Starts,
    TipRounding,
    WormAngle,
    WormHand,
    WormQuotient,
    cured,
    idle_of_worm,
    in_degrees,
    quotient_of,
    ways_out,
    worm_of,
)  # fmt: skip

if TYPE_CHECKING:
    from pathlib import Path

    from geometry.gears.worms.body import WormBody
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.faced import FacedBody
    from geometry.solids.sketch import Sketch

_MOST = 100_000.0
# keys of which less may do
_LESSENED = ("tip_rounding", "axial_thinning", "fillet_coefficient", "tip_clearance_coefficient")
# of a diameter, what rounding leaves
_ROUNDING = 1e-12
# of the ends of a thread, degrees
_USUAL_ANGLES = {"end_angle_deg": 20.0, "run_out_deg": 90.0}


class StepTable(Struct, forbid_unknown_fields=True):
    """One step of the shaft beside the thread, from the thread outwards."""

    diameter: Annotated[float, mm("diameter of the step", above=0, most=_MOST, example=12.0)]
    length: Annotated[float, mm("length of the step", above=0, most=_MOST, example=15.0)]
    chamfer: Annotated[float, mm("45 degree chamfer of its outer edge", least=0, most=_MOST)] = 0.0


Steps = Annotated[
    list[StepTable],
    Meta(
        max_length=50,
        description="the shaft, step by step from the thread outwards",
        examples=[[{"diameter": 12.0, "length": 15.0, "chamfer": 0.5}]],
    ),
]

_END_ANGLE = degrees(
    "cone that cuts the thread at both ends, from the end's plane; 0 cuts it plainly; default: 20",
    least=0,
    most=60,
    example=20.0,
)
_THREAD_ENDS = Meta(
    description="how the thread ends: cut by a cone (end_angle_deg), thin in the end; blunt, by an axial plane "
    "where it is whole; run_out, where the tool leaves the spaces: then the shaft may be of any diameter"
)
_RUN_OUT = degrees(
    "turn of the worm within which the tool leaves, of thread_ends run_out; default: 90",
    least=10,
    most=120,
    example=90.0,
)


class WormSpec(MaterialKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="worm"):
    """Keys of ``worm``."""

    module: AxialModule
    thread_length: Annotated[float, mm("threaded length b1, at the root", above=0, most=10_000, example=40.0)]
    number_of_starts: Starts = 1
    diameter_quotient: WormQuotient | None = None
    lead_angle_deg: LeadAngle | None = None
    form: Form = "ZI"
    pressure_angle_deg: WormAngle = 20.0
    hand: WormHand = "right"
    addendum_coefficient: Addendum = 1.0
    tip_clearance_coefficient: Clearance = 0.2
    fillet_coefficient: Fillet = 0.2
    grinding_wheel_diameter: GrindingWheel = 300.0
    axial_thinning: Annotated[float, mm("thinning of the thread, axial, for backlash", least=0, most=1000)] = 0.0
    tip_rounding: TipRounding = 0.0
    end_angle_deg: Annotated[float, _END_ANGLE] | None = None
    thread_ends: Annotated[Literal["cut", "blunt", "run_out"], _THREAD_ENDS] = "cut"
    run_out_deg: Annotated[float, _RUN_OUT] | None = None
    shaft_below: Steps = field(default_factory=list)
    shaft_above: Steps = field(default_factory=list)
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    accuracy: AccuracyKey = None


def _idle(keys: WormSpec) -> Iterator[ParameterError]:
    """The angle of other ends than the thread has."""
    yield from idle_of_worm(keys)
    for key, ends in (("end_angle_deg", "cut"), ("run_out_deg", "run_out")):
        if keys.thread_ends != ends:
            yield from in_vain(keys, (key,), "only_of_thread_ends", ends=ends)


def told_worm(keys: WormSpec) -> WormSpec:
    """The keys with a diameter quotient in place of a lead angle.

    Raises
    ------
    ParameterError
        They give both, and these do not agree.
    """
    return changed(keys, diameter_quotient=quotient_of(keys), lead_angle_deg=None)


def _made(keys: WormSpec) -> WormBody:
    """The solid of a worm with a quotient, checked to exist."""
    from geometry.gears.worms.body import Step, WormBody
    from geometry.gears.worms.thread import thread_of

    check_idle(_idle(keys))
    thread = thread_of(worm_of(keys, keys.fillet_coefficient, keys.axial_thinning), keys.tip_rounding)
    root = thread.worm.root_radius
    holes = holes_of(keys)
    check_shape(keys, holes_of, root)
    _check_shaft(keys, root)
    _check_bore(keys, holes, root)
    bores = holes.profiles(0.0)
    below, above = (
        tuple(Step(s.diameter, s.length, s.chamfer) for s in steps) for steps in (keys.shaft_below, keys.shaft_above)
    )
    angle, run_out = math.radians(keys.end_angle_deg or 0.0), math.radians(keys.run_out_deg or 0.0)
    bore = bores[0] if bores else None
    body = WormBody(thread, keys.thread_length, angle, below, above, bore, keys.thread_ends, run_out)
    return body.checked()


def _check_shaft(keys: WormSpec, root: float) -> None:
    """The first step within the root, each chamfer within its step and beside no thicker one."""
    for key in ("shaft_below", "shaft_above"):
        steps: list[StepTable] = getattr(keys, key)
        for number, step in enumerate(steps, 1):
            place = f"{key}[{number}]"
            if number == 1 and step.diameter > 2 * root * (1 + _ROUNDING) and keys.thread_ends != "run_out":
                most = limit(2 * root, step.diameter)
                raise ParameterError(f"{place}.diameter", step.diameter, "worm_shaft_over_root", most, root=2 * root)
            if number < len(steps) and step.chamfer > (free := max((step.diameter - steps[number].diameter) / 2, 0.0)):
                cure = limit(free, step.chamfer) if free else Nearest(0.0)
                raise ParameterError(f"{place}.chamfer", step.chamfer, "worm_step_groove", cure)
            most_chamfer = min(step.length, step.diameter / 2 - least_wall(step.diameter / 2))
            if step.chamfer > most_chamfer:
                cure = limit(most_chamfer, step.chamfer)
                raise ParameterError(f"{place}.chamfer", step.chamfer, "chamfer_leaves_nothing_of_step", cure)


def _check_bore(keys: WormSpec, holes: HubHoles, root: float) -> None:
    """The bore leaves a wall in the thread and in every step."""
    steps = [*keys.shaft_below, *keys.shaft_above]
    least = min([root, *(step.diameter / 2 - step.chamfer for step in steps)])
    room = least - least_wall(least)
    if holes.bore_reach > room:
        raise wide_bore(keys, room, "leaves_no_wall")


def _cured(keys: WormSpec, told: WormSpec, refusal: ParameterError) -> ParameterError:
    """The refusal in the key that alone cures it, as typed."""
    return in_degrees(cured(refusal, told, ways_out(told, _LESSENED), [lambda worm: _made(worm) is not None]), keys)


class WormKind(Kind[WormSpec, "WormBody"]):
    """A worm; the middle of its thread lies at z = 0, and its flat outline is the section there."""

    # parallel surfaces of a thread are of no form of flank
    name, keys, unmoved = "worm", WormSpec, "worm_not_moved"
    drawing = "parts.gears.drawings"
    data_table = "parts.gears.data_tables"

    def idle(self, keys: WormSpec, others: Others) -> Iterator[ParameterError]:
        """What is of another form, or of other ends."""
        return _idle(keys)

    def gathered(self, keys: WormSpec, folder: Path) -> WormSpec:
        """The keys with the usual angle of their ends, and quotient where neither it nor a lead angle is given."""
        angle = {"cut": "end_angle_deg", "run_out": "run_out_deg"}.get(keys.thread_ends)
        if angle is not None and getattr(keys, angle) is None:
            keys = changed(keys, **{angle: _USUAL_ANGLES[angle]})
        if keys.lead_angle_deg is not None:
            return keys
        return told_worm(keys)

    def thing(self, keys: WormSpec, others: Others) -> WormBody:
        """The worm's solid, checked to exist."""
        told = told_worm(keys)
        try:
            return _made(told)
        except ParameterError as refusal:
            raise LateError(refusal.code, partial(_cured, keys, told, refusal)) from refusal

    def section(self, keys: WormSpec, thing: WormBody, offset: float) -> OffsetRegion:
        """The section across the axis in the middle of the thread."""
        from geometry.gears.worms.section import transverse_profile
        from geometry.plane.offset_region import OffsetRegion
        from geometry.plane.profile import Region

        self.stays(offset)
        holes = () if thing.bore is None else (thing.bore,)
        return OffsetRegion(Region(transverse_profile(thing.thread), holes), 0.0, ())

    def solid(self, keys: WormSpec, thing: WormBody, offset: float) -> FacedBody:
        """The worm."""
        from geometry.gears.worms.faces import faced_worm

        return faced_worm(thing)

    def sketch(self, keys: WormSpec, thing: WormBody) -> Sketch:
        """The cylinder of its tips, its shaft."""
        from geometry.gears.worms.sketch import sketch_of_worm

        return sketch_of_worm(thing)

    def height(self, keys: WormSpec, thing: WormBody) -> float:
        """Its whole length."""
        low, high = thing.ends()
        return high - low

    def middle(self, keys: WormSpec, thing: WormBody) -> float:
        """The middle of the thread."""
        return 0.0

    def report(self, keys: WormSpec, thing: WormBody) -> Report:
        """Diameters, angles, and what is measured."""
        from geometry.gears.worms.measures import BALL, over_balls, reference_chord

        thread, worm = thing.thread, thing.thread.worm
        circles, flank = diameters(worm, "tip", "reference", "root"), dict(thread.lines)["flank"]
        circles["root_form_diameter"] = 2 * flank.point(flank.domain[0]).real.item()
        if worm.form == "ZI":
            circles["base_diameter"] = 2 * worm.flank.least_radius
        chord, balls = reference_chord(thread), over_balls(thread, BALL * worm.module)
        quantities = {
            "length": self.height(keys, thing),
            "lead_angle_deg": math.degrees(worm.lead_angle),
            "axial_pressure_angle_deg": math.degrees(worm.axial_pressure_angle),
            "pitch": math.pi * worm.module,
            "lead": worm.lead,
            "axial_thickness": 2 * worm.screw.half_thickness,
            "thread_chord": chord.thickness,
            "thread_chord_height": chord.height,
            "axial_tip_land": 2 * thread.tip_half,
            **({} if balls is None else {"ball_diameter": BALL * worm.module, "over_balls": balls}),
        }
        flat = (Finding("worm_section", 2 * worm.tip_radius, 0.0),)
        return Report((), circles, quantities, flat)


WORM = WormKind()
