"""The part kind ``worm_wheel``: the wheel that a worm, or a hob of another diameter, envelops."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta
from msgspec.structs import replace as changed

from geometry.base.errors import Nearest, OffsetError, ParameterError, limit
from geometry.base.nearest import kept, nearest
from geometry.base.record import Record, replace
from geometry.solids.hub_holes import least_wall
from parts.base.kind import Kind, Others, Report
from parts.keys.accuracy import AccuracyKey
from parts.keys.base import mm
from parts.keys.holes import HoledKeys, SpokesTable, bore_of, hub_holes, wide_bore
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
    WheelShift,
    WormAngle,
    WormHand,
    hob_quotient,
    larger_quotients,
    smaller_angles,
    wider,
    worm_of,
)  # fmt: skip

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.worms.drive import WormDrive
    from geometry.gears.worms.wheel import WormTeeth
    from geometry.gears.worms.wheel_measures import WormWheel
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.faced import FacedBody
    from geometry.solids.hub_holes import HubHoles
    from geometry.solids.sketch import Sketch

# part of the root's radius at which the core ends whose place the teeth take
_CORE = 0.5
_LEAST_TEETH = 8
# heights at which a ridge is looked at
_SEEN = 33
# part of the usual width that a wheel is of use with; its tip in the middle, modules
_USEFUL, _TIP = 0.25, 0.02
# addenda that are tried, and that leave next to nothing, modules
_ADDENDA, _LOW = (0.8, 0.6, 0.4, 0.2, 0.1), (0.05, 0.02)
# parts of a shift that are tried
_LESS_SHIFT = (0.75, 0.5, 0.25, 0.0)
# keys in whose refusals others may take the teeth away as well
_TEETH = (
    "addendum_coefficient",
    "axial_thinning",
    "hob_rounding_coefficient",
    "number_of_starts",
    "tip_clearance_coefficient",
)
# an outside is reached that near, mm; below so many degrees a corner is sharp: a throat wraps a third of the worm
_REACHED, _SHARP = 1e-3, 29.9


class WormWheelSpec(HoledKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="worm_wheel"):
    """Keys of ``worm_wheel``: those of its worm first."""

    module: AxialModule
    number_of_teeth: Annotated[
        int, Meta(ge=_LEAST_TEETH, le=10_000, description="teeth of the wheel, z2", examples=[30])
    ]
    number_of_starts: Starts = 1
    diameter_quotient: Quotient = 10.0
    profile_shift_coefficient: WheelShift = 0.0
    form: Form = "ZI"
    pressure_angle_deg: WormAngle = 20.0
    hand: WormHand = "right"
    addendum_coefficient: Addendum = 1.0
    tip_clearance_coefficient: Clearance = 0.2
    grinding_wheel_diameter: GrindingWheel = 300.0
    hob_rounding_coefficient: HobRounding = 0.2
    hob_diameter_quotient: HobQuotient | None = None
    axial_thinning: HobThinning = 0.0
    face_width: (
        Annotated[
            float,
            mm(
                "width b2 of the rim; default: the largest by GOST 19650 that has whole teeth",
                least=0.01,
                most=10_000,
                example=14.0,
            ),
        ]
        | None
    ) = None  # type: ignore[assignment]
    outer_diameter: (
        Annotated[
            float,
            mm("d_ae2, outside of the throat; default: the largest by GOST 19650", above=0, most=200_000, example=66.0),
        ]
        | None
    ) = None
    spokes: SpokesTable | None = None
    web: WebTable | None = None
    hub: HubTable | None = None
    accuracy: AccuracyKey = None

    def hub_holes(self) -> HubHoles:
        """Bore, holes and windows."""
        return hub_holes(bore_of(self), self.holes, self.spokes)


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

    return WormDrive(worm_of(keys), keys.number_of_teeth, keys.profile_shift_coefficient)


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
    """Whether teeth are whole, of some thickness, and bend nowhere over a part of the width that is of use.

    Where a width is asked for, whether they stand over all of it.
    """
    if keys.face_width is not None:
        return _stands(keys)
    teeth = _asked_teeth(keys, drive_of(keys)).glanced
    teeth = replace(teeth, width=_USEFUL * teeth.width)
    # what is not whole anywhere has no tip to ask for
    return teeth.is_even and float((teeth.thickness(0.0) * teeth.tip_radius(0.0))[0]) > _TIP * keys.module


def _stands(keys: WormWheelSpec) -> bool:
    """Whether some width has whole teeth that bend nowhere, or all of one that is asked for has any, at a glance."""
    teeth = _asked_teeth(keys, drive_of(keys)).glanced
    return not teeth.sliver.is_creased if keys.face_width is None else teeth.ended is None


def _is_made(keys: WormWheelSpec) -> bool:
    """Whether there are teeth of some width, or of the one that is asked for, that splines follow."""
    from geometry.gears.worms.wheel_faces import is_fitting

    teeth = _asked_teeth(keys, drive_of(keys)).tried
    if keys.face_width is not None:
        return is_fitting(teeth)
    return not teeth.sliver.is_creased and is_fitting(teeth.sliver)


def teeth_of(keys: WormWheelSpec, drive: WormDrive) -> WormTeeth:
    """The teeth of the whole width, or where none is given of as much of it as has some."""
    from geometry.gears.worms.wheel_faces import fitting, is_fitting

    teeth = _asked_teeth(keys, drive)
    if keys.face_width is None:
        even = teeth.narrowed(even=True)
        whole = even if even.is_even and even.width >= _USEFUL * teeth.width else teeth.narrowed()
        # faces may break off where none of the known ends is
        found = fitting(whole)
        if found is not None:
            return found
        code = "worm_wheel_below_base" if whole.is_creased else "worm_wheel_faces_break"
        raise ParameterError("addendum_coefficient", keys.addendum_coefficient, code)
    try:
        teeth = teeth.checked()
    except ParameterError as wide:
        raise ParameterError(wide.name, wide.value, wide.code, partial(_narrower, teeth)) from wide
    if is_fitting(teeth):
        return teeth
    if teeth.is_creased and fitting(teeth) is None:
        raise ParameterError("addendum_coefficient", keys.addendum_coefficient, "worm_wheel_below_base")
    raise ParameterError("face_width", teeth.width, "worm_wheel_faces_break", partial(_narrower, teeth))


def _narrower(teeth: WormTeeth) -> Nearest | None:
    """The widest of their faces that stands and that splines follow."""
    from geometry.gears.worms.wheel_faces import fitting

    standing = teeth.standing()
    found = standing and fitting(standing)
    return limit(found.width, teeth.width) if found else None


def _left_by(keys: WormWheelSpec, does: Callable[[WormWheelSpec], bool], key: str) -> Callable[[float], bool]:
    """Whether a margin holds of the same keys but for one."""
    return lambda value: does(changed(keys, **{key: value}))


def _toothless(keys: WormWheelSpec, refusal: ParameterError) -> ParameterError:
    """No tooth is left that splines follow: in the key that takes it away, with the value that leaves some."""

    def cure() -> Nearest | None:
        # all others are told to a share of their own
        near = NEAR if key == "profile_shift_coefficient" else 0.0
        made = _left_by(keys, _is_made, key)
        found = nearest(_left_by(keys, _stands, key), given, ends, enough=near, share=NEAR)
        if found is None or not isinstance(found.value, int | float) or kept(made, found.value):
            return found
        # splines do not follow some that run all but along the contact's way to infinity
        less = _LOW if key == "addendum_coefficient" else ()
        beyond = [end for end in (*ends, *less) if (end - found.value) * (found.value - given) > 0]
        return nearest(made, found.value, beyond, enough=near, share=NEAR)

    for does, key, values in _suspects(keys, refusal):
        margins = [_left_by(keys, holds, key) for holds in (does, _is_made)]
        least = next((k for k, value in enumerate(values) if all(kept(holds, value) for holds in margins)), None)
        if least is not None:
            ends, given = values[least:], getattr(keys, key)
            return ParameterError(key, given, refusal.code, cure)
    return refusal


def _suspects(
    keys: WormWheelSpec, refusal: ParameterError
) -> Iterator[tuple[Callable[[WormWheelSpec], bool], str, Sequence[float]]]:
    """Margins, keys that may take the teeth away, the least missed first, and values of each, less and less wrong."""
    quotient, larger = keys.diameter_quotient, keys.hob_diameter_quotient or 0.0
    if keys.axial_thinning:
        yield _of_use, "axial_thinning", (0.0,)
    elif refusal.name == "hob_rounding_coefficient" and (found := refusal.nearest) and isinstance(found.value, float):
        yield _is_made, refusal.name, (found.value, found.value / 2, 0.0)
    if keys.profile_shift_coefficient:
        yield _of_use, "profile_shift_coefficient", (0.0,)
    yield _of_use, "addendum_coefficient", _ADDENDA
    if larger > quotient:
        yield _stands, "hob_diameter_quotient", (quotient,)
    # teeth of less than is of use are more than none
    yield _stands, "addendum_coefficient", _ADDENDA[-1:]
    yield _of_use, "diameter_quotient", larger_quotients(quotient, larger if larger > quotient else math.inf)
    yield _stands, "number_of_starts", range(keys.number_of_starts - 1, 0, -1)
    yield _stands, "addendum_coefficient", (*_ADDENDA, *_LOW)
    if shift := keys.profile_shift_coefficient:
        yield _stands, "profile_shift_coefficient", [share * shift for share in _LESS_SHIFT]
    yield _stands, "pressure_angle_deg", smaller_angles(keys.pressure_angle_deg)


def _cured(keys: WormWheelSpec, refusal: ParameterError) -> ParameterError:
    """A refusal of worm, hob or teeth with the value that leaves a wheel."""

    if refusal.name in _TEETH:
        return _toothless(keys, refusal)
    does, stands = (_left_by(keys, margin, "diameter_quotient") for margin in (_stands, _is_made))
    most = keys.hob_diameter_quotient or math.inf
    quotients = larger_quotients(keys.diameter_quotient, most) if refusal.name == "diameter_quotient" else ()
    if quotients and not any(kept(does, quotient) for quotient in reversed(quotients)):
        return _toothless(keys, refusal)
    return wider(refusal, does, stands, most)


def _about(keys: WormWheelSpec, drive: WormDrive, teeth: WormTeeth) -> WheelThing:
    """The wheel that has such teeth, checked to exist."""
    from geometry.gears.worms.wheel_measures import WormWheel
    from geometry.plane.profile import Label, circle
    from geometry.solids.wheel import check_wheel, wheel_body, wheel_sections

    holes = keys.hub_holes()
    shape = wheel_shape(teeth.width, keys.web, keys.hub, 0.0)
    room = drive.root_radius - least_wall(drive.root_radius)
    if holes.bore_reach > room:
        raise wide_bore(keys, room, "leaves_no_wall")
    holes.check(drive.root_radius)
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

    name, keys, has_outline = "worm_wheel", WormWheelSpec, False
    drawing = "parts.gears.drawings"
    data_table = "parts.gears.data_tables"

    def thing(self, keys: WormWheelSpec, others: Others) -> WheelThing:
        """The wheel, checked to exist."""
        try:
            drive = drive_of(keys)
            teeth = teeth_of(keys, drive)
        except ParameterError as refusal:
            raise _cured(keys, refusal) from refusal
        return _about(keys, drive, teeth)

    def section(self, keys: WormWheelSpec, thing: WheelThing, offset: float) -> OffsetRegion:
        """Its mid plane, near enough for pictures."""
        from geometry.plane.offset_region import OffsetRegion
        from geometry.plane.profile import Region

        outline = thing.teeth.outline(0.0)
        return OffsetRegion(Region(outline, keys.hub_holes().profiles(0.0)), 0.0, ())

    def solid(self, keys: WormWheelSpec, thing: WheelThing, offset: float) -> FacedBody:
        """The teeth about their core."""
        from geometry.gears.worms.wheel_faces import wheel_body

        if offset != 0:
            raise OffsetError(offset, "worm_wheel_not_moved")
        return wheel_body(thing.wheel)

    def sketch(self, keys: WormWheelSpec, thing: WheelThing) -> Sketch:
        """The envelope of its tips about its core."""
        from geometry.gears.worms.sketch import sketch_of_worm_wheel

        return sketch_of_worm_wheel(thing.wheel, thing.drive.reference_radius)

    def height(self, keys: WormWheelSpec, thing: WheelThing) -> float:
        """Width of the rim."""
        return thing.teeth.width

    def is_plate(self, keys: WormWheelSpec, thing: WheelThing) -> bool:
        """Never."""
        return False

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
    """Where the throat ends below the outside that is asked for, and where teeth have no tip or no flank."""
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
    if teeth.flank_ends:
        found.append(Finding("worm_wheel_no_flank", min(map(abs, teeth.flank_ends)), teeth.width / 2))
    return tuple(found)
