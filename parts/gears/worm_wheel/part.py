"""The part kind ``worm_wheel``: the wheel that a worm, or a hob of another diameter, envelops."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta

from geometry.base.errors import LateError, Nearest, ParameterError, limit
from geometry.base.record import Record, replace
from geometry.solids.hub_holes import least_wall
from parts.base.kind import Kind, Others, Report
from parts.keys.accuracy import AccuracyKey
from parts.keys.base import mm
from parts.keys.holes import HoledKeys, SpokesTable, check_holes, check_shape, holes_of, spoked, wide_bore
from parts.keys.wheel import HubTable, WebTable, wheel_shape
from parts.keys.worm import (
    NEAR,
    Addendum,
    AxialModule,
    Clearance,
    Form,
    GrindingWheel,
    HobQuotient,
    HobRounding,
    HobThinning,
    Quotient,
    Starts,
    WheelDistance,
    WheelShift,
    WormAngle,
    WormHand,
    cured,
    hob_quotient,
    idle_of_worm,
    shift_of,
    ways_out,
    worm_of,
)  # fmt: skip

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.worms.drive import WormDrive
    from geometry.gears.worms.wheel import WormTeeth
    from geometry.gears.worms.wheel_measures import WormWheel
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.faced import FacedBody
    from geometry.solids.sketch import Sketch

# part of the root's radius at which the core ends whose place the teeth take
_CORE = 0.5
_LEAST_TEETH = 8
# heights at which a ridge is looked at
_SEEN = 33
# part of the usual width that a wheel is of use with; its tip in the middle, modules
_USEFUL, _TIP = 0.25, 0.02
# how near to the widest a default width is, part of it
_NEAR = 5e-3
# distances that are tried: shares of the way from the last one that a shift reaches to the one without shift
_NEARER = (1 / 8, 1 / 4, 1 / 2, 3 / 4, 1.0)
# more teeth that are tried
_MORE_TEETH = (1.1, 1.25, 1.5, 2.0, 3.0)
# an outside is reached that near, mm; below so many degrees a corner is sharp: a throat wraps a third of the worm
_REACHED, _SHARP = 1e-3, 29.9

_OUTER_DIAMETER = mm(
    "d_ae2, outside of the throat; default: the largest by GOST 19650", above=0, most=200_000, example=66.0
)
_FACE_WIDTH = mm(
    "width b2 of the rim; default: the largest by GOST 19650 that has whole teeth",
    least=0.01,
    most=10_000,
    example=14.0,
)
_NUMBER_OF_TEETH = Meta(ge=_LEAST_TEETH, le=10_000, description="teeth of the wheel, z2", examples=[30])


class WormWheelSpec(HoledKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="worm_wheel"):
    """Keys of ``worm_wheel``: those of its worm first."""

    module: AxialModule
    number_of_teeth: Annotated[int, _NUMBER_OF_TEETH]
    number_of_starts: Starts = 1
    diameter_quotient: Quotient = 10.0
    profile_shift_coefficient: WheelShift = 0.0
    working_centre_distance: WheelDistance | None = None
    form: Form = "ZI"
    pressure_angle_deg: WormAngle = 20.0
    hand: WormHand = "right"
    addendum_coefficient: Addendum = 1.0
    tip_clearance_coefficient: Clearance = 0.2
    grinding_wheel_diameter: GrindingWheel = 300.0
    hob_rounding_coefficient: HobRounding = 0.2
    hob_diameter_quotient: HobQuotient | None = None
    axial_thinning: HobThinning = 0.0
    face_width: Annotated[float, _FACE_WIDTH] | None = None  # type: ignore[assignment]
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None
    spokes: SpokesTable | None = None
    web: WebTable | None = None
    hub: HubTable | None = None
    accuracy: AccuracyKey = None


class WheelThing(Record):
    """A worm wheel with the drive that it is for."""

    drive: WormDrive
    wheel: WormWheel

    @property
    def teeth(self) -> WormTeeth:
        """Its teeth."""
        return self.wheel.teeth


def drive_of(keys: WormWheelSpec) -> WormDrive:
    """The worm that a wheel is for, and both together."""
    from geometry.gears.worms.drive import WormDrive

    shift = shift_of(keys, keys.diameter_quotient, keys.number_of_teeth)
    return WormDrive(worm_of(keys), keys.number_of_teeth, shift)


def _asked_teeth(keys: WormWheelSpec, drive: WormDrive) -> WormTeeth:
    """The teeth as asked for, of which some stand in the middle at least."""
    from geometry.gears.worms.hob import oversized_hob
    from geometry.gears.worms.wheel import WormTeeth

    quotient = hob_quotient(keys.hob_diameter_quotient, keys.diameter_quotient)
    hob = oversized_hob(drive, keys.hob_rounding_coefficient, quotient)
    # a hob with thicker threads leaves thinner teeth
    hob = replace(hob, worm=replace(hob.worm, thinning=-keys.axial_thinning)).checked()
    width = drive.most_face_width if keys.face_width is None else keys.face_width
    least = 2 * drive.tip_radius
    outer = drive.default_outer_diameter if keys.outer_diameter is None else keys.outer_diameter
    if outer < least:
        raise ParameterError("outer_diameter", outer, "within_throat", limit(least, outer), diameter=least)
    teeth = WormTeeth(hob, drive.centre_distance, drive.throat_radius, outer / 2, width)
    ended = teeth.glanced.sliver.lessened
    if ended is not None:
        # at any width
        raise ParameterError("addendum_coefficient", keys.addendum_coefficient, ended)
    return teeth


def _of_use(keys: WormWheelSpec) -> bool:
    """Whether teeth are whole, of some thickness, and bend nowhere over a part of the width that is of use."""
    if keys.face_width is not None:
        return True
    teeth = _asked_teeth(keys, drive_of(keys)).glanced
    teeth = replace(teeth, width=_USEFUL * teeth.width)
    # what is not whole anywhere has no tip to ask for
    return teeth.is_even() and float((teeth.thickness(0.0) * teeth.tip_radius(0.0))[0]) > _TIP * keys.module


def _least(keys: WormWheelSpec) -> WormTeeth:
    """The teeth of the least width, or of the one that is asked for."""
    teeth = _asked_teeth(keys, drive_of(keys))
    return teeth.sliver if keys.face_width is None else teeth


def _stands(keys: WormWheelSpec) -> bool:
    """Whether there are such teeth, a glance first, and by default they bend nowhere."""
    least = _least(keys)
    looks = least.glanced, least.tried
    return all(look.is_smooth() if keys.face_width is None else look.stands() for look in looks)


def _begins(keys: WormWheelSpec) -> bool:
    """Whether splines follow the ends of such teeth, which are the first that they leave."""
    from geometry.gears.worms.wheel_faces import is_fitting

    return is_fitting(_least(keys).tried, outermost=True)


def _is_made(keys: WormWheelSpec) -> bool:
    """Whether there are such teeth, and splines follow all of them."""
    from geometry.gears.worms.wheel_faces import is_fitting

    return is_fitting(_least(keys))


def teeth_of(keys: WormWheelSpec, drive: WormDrive) -> WormTeeth:
    """The teeth of the whole width, or where none is given of as much of it as has some."""
    from geometry.gears.worms.wheel import WormTeeth
    from geometry.gears.worms.wheel_faces import fitting, is_fitting

    def narrower() -> Nearest | None:
        found = fitting(teeth, WormTeeth.stands)
        return limit(found.width, teeth.width) if found else None

    teeth = _asked_teeth(keys, drive)
    least = teeth.sliver
    if keys.face_width is None:
        found = fitting(teeth, WormTeeth.is_even, _NEAR) or fitting(teeth, WormTeeth.is_smooth, _NEAR)
        if found is not None:
            return found
    elif is_fitting(teeth):
        return teeth
    elif is_fitting(least.tried):
        raise ParameterError("face_width", teeth.width, teeth.ended or "worm_wheel_faces_break", narrower)
    code = "worm_wheel_below_base" if least.is_creased else least.ended or "worm_wheel_faces_break"
    raise ParameterError("addendum_coefficient", keys.addendum_coefficient, code)


def _cured(keys: WormWheelSpec, refusal: ParameterError) -> ParameterError:
    """A refusal of worm, hob or teeth in the key and with the value that leaves a wheel."""
    quotient, hob = keys.diameter_quotient, keys.hob_diameter_quotient or math.inf
    less = ("axial_thinning", "profile_shift_coefficient"), ("hob_rounding_coefficient", "tip_clearance_coefficient")
    more = [round(share * keys.number_of_teeth) for share in _MORE_TEETH]
    # its own limit alone may do of an outside within the throat
    ways = {**ways_out(keys, *less, hob), "number_of_teeth": more, "outer_diameter": ()}
    if quotient < hob < math.inf:
        ways = {"hob_diameter_quotient": (quotient,), **ways}
    if refusal.code == "asks_for_shift" and refusal.nearest is not None:
        last, middle = float(str(refusal.nearest.value)), keys.module * (quotient + keys.number_of_teeth) / 2
        ways["working_centre_distance"] = [last + share * (middle - last) for share in _NEARER]
    return cured(refusal, keys, ways, (_stands, _begins, _is_made), _of_use, NEAR)


def _about(keys: WormWheelSpec, drive: WormDrive, teeth: WormTeeth) -> WheelThing:
    """The wheel that has such teeth, checked to exist."""
    from geometry.gears.worms.wheel_measures import WormWheel
    from geometry.plane.profile import Label, circle
    from geometry.solids.wheel import check_wheel, wheel_body, wheel_sections

    keys = spoked(keys, drive.root_radius)
    holes = holes_of(keys)
    shape = wheel_shape(teeth.width, keys.web, keys.hub, 0.0)
    room = drive.root_radius - least_wall(drive.root_radius)
    check_shape(keys, holes_of, room)
    if holes.bore_reach > room:
        raise wide_bore(keys, room, "leaves_no_wall")
    check_holes(keys, holes_of, root_radius=drive.root_radius)
    check_wheel(shape, 2 * drive.root_radius, holes)
    reach = max(holes.bore_reach, holes.beside_bore()[1], *(t.diameter / 2 for t in (keys.hub,) if t), *(
        t.rim_diameter / 2 for t in (keys.web,) if t
    ))  # fmt: skip
    # between all that is cut and the teeth
    rim = circle(reach + _CORE * (drive.root_radius - reach), Label.BODY)
    core = wheel_body(shape, wheel_sections(lambda *_: rim, drive.root_radius, holes))
    return WheelThing(drive, WormWheel(teeth, core, rim))


class WormWheelKind(Kind[WormWheelSpec, WheelThing]):
    """A worm wheel, which has another section at every height."""

    name, keys, has_outline, unmoved = "worm_wheel", WormWheelSpec, False, "worm_wheel_not_moved"
    drawing = "parts.gears.drawings"
    data_table = "parts.gears.data_tables"

    def idle(self, keys: WormWheelSpec, others: Others) -> Iterator[ParameterError]:
        """What is of a worm of another form."""
        return idle_of_worm(keys)

    def thing(self, keys: WormWheelSpec, others: Others) -> WheelThing:
        """The wheel, checked to exist."""
        try:
            drive = drive_of(keys)
            teeth = teeth_of(keys, drive)
        except ParameterError as refusal:
            raise LateError(refusal.code, partial(_cured, keys, refusal)) from refusal
        return _about(keys, drive, teeth)

    def section(self, keys: WormWheelSpec, thing: WheelThing, offset: float) -> OffsetRegion:
        """Its mid plane, near enough for pictures."""
        from geometry.plane.offset_region import OffsetRegion
        from geometry.plane.profile import Region

        outline = thing.teeth.outline(0.0)
        return OffsetRegion(Region(outline, holes_of(spoked(keys, thing.drive.root_radius)).profiles(0.0)), 0.0, ())

    def solid(self, keys: WormWheelSpec, thing: WheelThing, offset: float) -> FacedBody:
        """The teeth about their core."""
        from geometry.gears.worms.wheel_faces import wheel_body

        return wheel_body(thing.wheel)

    def sketch(self, keys: WormWheelSpec, thing: WheelThing) -> Sketch:
        """The envelope of its tips about its core."""
        from geometry.gears.worms.sketch import sketch_of_worm_wheel

        return sketch_of_worm_wheel(thing.wheel, thing.drive.reference_radius)

    def height(self, keys: WormWheelSpec, thing: WheelThing) -> float:
        """Width of the rim."""
        return thing.teeth.width

    def report(self, keys: WormWheelSpec, thing: WheelThing) -> Report:
        """Its sizes, and how long the worm is where it touches them."""
        import numpy as np

        from geometry.base.findings import Finding
        from geometry.gears.worms.field import Field

        drive, teeth = thing.drive, thing.teeth
        circles = {
            "outer_diameter": 2 * float(teeth.tip_radius(teeth.width / 2)),
            "throat_diameter": 2 * drive.tip_radius,
            "reference_diameter": 2 * drive.reference_radius,
            "root_diameter": 2 * drive.root_radius,
        }
        heights = np.array([0.0, teeth.width / 2])
        tips = teeth.thickness(heights) * teeth.tip_radius(heights)
        sizes = {
            "worm_centre_distance": drive.centre_distance,
            "throat_radius": drive.throat_radius,
            "tip_tooth_thickness": float(tips[0]),
            "end_tip_thickness": float(tips[1]),
        }
        if teeth.hob.swivel:
            # it touches its worm at points
            sizes["hob_swivel_deg"] = math.degrees(teeth.hob.swivel)
        else:
            sizes["worm_length_used"] = Field(teeth, drive.worm.form_radius, drive.worm.tip_radius).length_used()
        found = _findings(teeth, keys.outer_diameter)
        if keys.face_width is None and teeth.width < _USEFUL * drive.most_face_width:
            found = (*found, Finding("worm_wheel_narrow", teeth.width, drive.most_face_width))
        return Report(found, circles, sizes)


WORM_WHEEL = WormWheelKind()


def _findings(teeth: WormTeeth, asked: float | None) -> tuple[Finding, ...]:
    """Where the throat ends below the outside that is asked for, where teeth are undercut, have no tip or no flank."""
    import numpy as np

    from geometry.base.findings import Finding

    found = []
    reached = 2 * float(teeth.tip_radius(teeth.width / 2))
    if asked is not None and reached < asked - _REACHED:
        found.append(Finding("worm_wheel_outer_not_reached", reached, asked))
    corner = 90 - math.degrees(math.asin(min(teeth.throat_height / teeth.throat_radius, 1.0)))
    if reached < 2 * teeth.outer_radius and corner < _SHARP:
        found.append(Finding("worm_wheel_sharp_corner", corner, 2 * teeth.centre_distance - teeth.throat_radius))
    for low, high in (ridge for ridge in teeth.ridges if ridge[1] > 0):
        heights = np.linspace(low, high, _SEEN)
        less = teeth.tip_radius(heights) - teeth.top(heights)
        found.append(Finding("worm_wheel_ridge", max(low, 0.0), float(less.max())))
    if teeth.undercut_width:
        found.append(Finding("worm_wheel_undercut", teeth.undercut_width, teeth.width))
    if teeth.flank_ends:
        found.append(Finding("worm_wheel_no_flank", min(map(abs, teeth.flank_ends)), teeth.width / 2))
    return tuple(found)
