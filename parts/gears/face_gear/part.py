"""The part kind ``face_gear``: a crown wheel whose teeth its spur pinion envelops, on an axis at 90 degrees."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta
from msgspec.structs import replace as changed

from geometry.base.errors import GeometryError, LateError, Nearest, ParameterError, limit
from geometry.base.nearest import kept, nearest
from geometry.base.record import replace
from geometry.gears.face.gear import FaceGear, form_length, sized, topped
from geometry.gears.teeth.cutter import CUTTER_ADDENDUM, CUTTER_ROUNDING, PinionCutter, checked_cutter
from geometry.solids.hub_holes import least_wall
from geometry.solids.wheel import check_wheel
from parts.base.kind import Kind, Others, Report
from parts.base.part_keys import MaterialKeys
from parts.base.schema import value_at
from parts.keys.base import MOST_LENGTH, BoreDiameter, degrees, in_modules, mm
from parts.keys.holes import (
    BoreTable,
    HolesTable,
    SpokesTable,
    check_holes,
    check_shape,
    holes_of,
    spoked,
    wide_bore,
)
from parts.keys.wheel import HubTable, WebTable, wheel_shape

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.teeth.spur import SpurGear
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.faced import FacedBody
    from geometry.solids.sketch import Sketch

# part of the largest rounding of a shaper's tooth that it has at most; the plate below the root, the least tip, modules
_ROUND, _USUAL_PLATE, _THIN = 0.9, 2.5, 0.3
# dedenda by default, the first that the shaper's tooth takes, modules
_DEDENDA = CUTTER_ADDENDUM, 1.2, 1.15, 1.1, 1.05
# addenda and dedenda that are tried where teeth have no width, part of the given one
_LOWER = (0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)
# what may be to blame for teeth that cannot be, and what takes it out of play; the least usual dedendum, modules
_THINNED = {"circumferential_thinning": 0.0}
_TYPED = {"pinion_profile_shift_coefficient": 0.0, "pressure_angle_deg": 20.0, "number_of_teeth": 10_000}
_USUAL = 1.0
# mm: how near pictures are to the edges of tips
_SEEN = 1e-7
# rounds after which both touch in the middle of the face
_SETTLED = 4
# how near to the greatest one a value is offered, modules
_NEAR = 1e-3

Module = Annotated[float, mm("module m, that of the pinion", least=0.01, most=1000, example=2.0)]
Teeth = Annotated[int, Meta(ge=8, le=10_000, description="number of teeth z2 of the face gear", examples=[60])]
PinionTeeth = Annotated[int, Meta(ge=3, le=10_000, description="number of teeth z1 of its pinion", examples=[20])]

_ADDENDUM_COEFFICIENT = in_modules(
    "addendum above the pitch plane; default: 1, or less where z1 is small", least=0.1, most=3, example=1.0
)
_DEDENDUM_COEFFICIENT = in_modules(
    "dedendum below it, the addendum of the shaper; default: 1.25, or what its tooth takes from 1.05 on",
    least=0.1,
    most=3,
    example=1.25,
)
_TIP_RADIUS_COEFFICIENT = in_modules(
    "rounding of the shaper's tip; default: 0.2, or what it takes", least=0, most=2, example=0.2
)
_SHAPER_NUMBER_OF_TEETH = Meta(
    ge=3,
    le=10_000,
    examples=[22],
    description="teeth z0 of the shaper; one to three more than the pinion's crown the flanks, which then "
    "touch at points in the middle of the face; default: the pinion's",
)
_INNER_DIAMETER = mm(
    "where the teeth begin; default: beyond the undercut and where the pinion still has its involute",
    above=0,
    most=MOST_LENGTH,
    example=121.0,
)
_OUTER_DIAMETER = mm(
    "where the teeth end; default: where their tips are 0.4 m thick", above=0, most=MOST_LENGTH, example=132.0
)
_PLATE_THICKNESS = mm("plate below the root; default: 2.5 m", least=0.01, most=10_000, example=5.0)


class FaceGearSpec(MaterialKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="face_gear"):
    """Keys of ``face_gear``."""

    module: Module
    number_of_teeth: Teeth
    pinion_number_of_teeth: PinionTeeth
    pressure_angle_deg: Annotated[float, degrees("pressure angle of the pinion", least=10, most=35)] = 20.0
    pinion_profile_shift_coefficient: Annotated[
        float, in_modules("profile shift x1 of its pinion, with which its own teeth go along", least=-2, most=3)
    ] = 0.0
    addendum_coefficient: Annotated[float, _ADDENDUM_COEFFICIENT] | None = None
    dedendum_coefficient: Annotated[float, _DEDENDUM_COEFFICIENT] | None = None
    tip_radius_coefficient: Annotated[float, _TIP_RADIUS_COEFFICIENT] | None = None
    shaper_number_of_teeth: Annotated[int, _SHAPER_NUMBER_OF_TEETH] | None = None
    inner_diameter: Annotated[float, _INNER_DIAMETER] | None = None
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None
    circumferential_thinning: Annotated[
        float, mm("thinning of the teeth along the pinion's reference circle, for backlash", least=0, most=1000)
    ] = 0.0
    plate_thickness: Annotated[float, _PLATE_THICKNESS] | None = None
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    spokes: SpokesTable | None = None
    web: WebTable | None = None
    hub: HubTable | None = None


# keys of the shaper as its owner has them
_SHAPER_KEYS = {
    "cutter.addendum": "dedendum_coefficient", "cutter.number_of_teeth": "pinion_number_of_teeth",
    "cutter.profile_shift_coefficient": "pinion_profile_shift_coefficient",
}  # fmt: skip


def shaper_of(keys: FaceGearSpec) -> PinionCutter:
    """The shaper, checked to exist."""
    alpha, rounding = math.radians(keys.pressure_angle_deg), keys.tip_radius_coefficient
    shift = keys.pinion_profile_shift_coefficient
    sharp = PinionCutter(keys.module, keys.pinion_number_of_teeth, alpha, shift, CUTTER_ADDENDUM, 0.0)

    def cut(dedendum: float) -> PinionCutter:
        shaper = replace(sharp, addendum=dedendum)
        checked_cutter(replace(shaper, widening=keys.circumferential_thinning / 2))
        return shaper

    dedenda = _DEDENDA if keys.dedendum_coefficient is None else (keys.dedendum_coefficient,)
    try:
        shaper = cut(next((one for one in dedenda if kept(lambda own: bool(cut(own)), one)), dedenda[0]))
    except ParameterError as error:
        raise error.renamed(_SHAPER_KEYS.get(error.name, error.name)) from error
    # the root keeps some width
    most = _ROUND * shaper.largest_rounding()
    if rounding is not None and rounding > most:
        raise ParameterError("tip_radius_coefficient", rounding, "cutter_rounding_does_not_fit", limit(most, rounding))
    return replace(shaper, tip_rounding=min(CUTTER_ROUNDING, most) if rounding is None else rounding)


def _made(keys: FaceGearSpec) -> FaceGear:
    """The gear of its keys, whose teeth can be."""
    m = keys.module
    plate = _USUAL_PLATE * m if keys.plate_thickness is None else keys.plate_thickness
    addendum, begins = keys.addendum_coefficient, _form_length(keys)
    bare = FaceGear(shaper_of(keys), keys.number_of_teeth, m if addendum is None else addendum * m, 0.0, 0.0,
                    plate, keys.circumferential_thinning)  # fmt: skip
    if addendum is None:
        bare = topped(bare, begins)
    inner, outer = (None if d is None else d / 2 for d in (keys.inner_diameter, keys.outer_diameter))
    plain = sized(bare, inner, outer, begins).checked()
    teeth = keys.pinion_number_of_teeth if keys.shaper_number_of_teeth is None else keys.shaper_number_of_teeth
    more = teeth - keys.pinion_number_of_teeth
    if more == 0:
        return plain

    def crowned(teeth: float) -> FaceGear:
        gear = plain
        for _ in range(_SETTLED):
            middle = (gear.inner_radius + gear.outer_radius) / 2
            gear = replace(gear, more_teeth=int(teeth) - keys.pinion_number_of_teeth, contact_plane=middle)
            gear = sized(gear, inner, outer, begins)
        return gear.checked()

    if more < 0:
        raise ParameterError("shaper_number_of_teeth", teeth, "shaper_below_pinion",
         Nearest(keys.pinion_number_of_teeth),
                             teeth=keys.pinion_number_of_teeth)  # fmt: skip
    try:
        return crowned(teeth)
    except ParameterError as refusal:
        cure = partial(nearest, lambda own: bool(crowned(own)), teeth, keys.pinion_number_of_teeth + 1)
        raise ParameterError("shaper_number_of_teeth", teeth, refusal.code, cure, **refusal.numbers) from refusal


def pinion_of(keys: FaceGearSpec) -> SpurGear:
    """The pinion that the rack of ISO 53 A cuts."""
    from geometry.gears.teeth.spur import SpurGear
    from parts.gears.spur_gear.part import basic_rack_of

    rack = basic_rack_of("ISO 53 A", math.radians(keys.pressure_angle_deg))
    return SpurGear(keys.module, keys.pinion_number_of_teeth, rack, keys.pinion_profile_shift_coefficient)


def _form_length(keys: FaceGearSpec) -> float:
    """Where its involute begins, along the line of action, mm."""
    try:
        return form_length(pinion_of(keys))
    except GeometryError:
        # of another rack only its own pinion may be
        return 0.0


def _cured(keys: FaceGearSpec, refusal: ParameterError) -> ParameterError:
    """A refusal of teeth that cannot be, of the thinning where that alone is too much, with what leaves some width."""

    def cured(key: str, given: float, ends: Sequence[float]) -> ParameterError:
        def builds(value: float) -> FaceGear:
            return _made(changed(keys, **{key: value}))

        def cure() -> Nearest | None:
            """With tips that leave something for a backlash, where there are such: a value of its own, no limit."""
            search = partial(nearest, given=given, toward=ends, enough=_NEAR * keys.module)
            roomy = search(lambda value: not face_gear_findings(builds(value)))
            return Nearest(roomy.value) if roomy else search(lambda v: bool(builds(v)))

        return refusal.told_of(key, given, cure)

    assert isinstance(refusal.value, float)
    own, suspects = cured(refusal.name, refusal.value, [refusal.value * s for s in _LOWER]), dict(_THINNED)
    if value_at(keys, refusal.name) is None and not (own.nearest and float(str(own.nearest.value)) >= _USUAL):
        # nobody typed what is refused, and none that is usual works
        suspects |= _TYPED
    for key, harmless in suspects.items():
        given = getattr(keys, key)
        if given != harmless and (found := cured(key, given, (harmless,))).nearest is not None:
            return found
    return own


class FaceGearKind(Kind[FaceGearSpec, FaceGear]):
    """A face gear: its lower face at z = 0, its teeth upwards, one on +x."""

    # what is parallel to its flanks no shaper of its pinion cuts
    name, keys, has_outline, unmoved = "face_gear", FaceGearSpec, False, "face_gear_not_moved"
    page = "parts.gears.face_gear.page"
    drawing = data_table = "parts.gears.face_gear.drawing"

    def thing(self, keys: FaceGearSpec, others: Others) -> FaceGear:
        """The gear, checked to exist."""
        try:
            gear = _made(keys)
        except ParameterError as error:
            if error.name not in ("addendum_coefficient", "dedendum_coefficient"):
                raise
            raise LateError(error.code, partial(_cured, keys, error)) from error
        inside = gear.inner_radius
        keys = spoked(keys, inside)
        holes = holes_of(keys)
        room = inside - least_wall(inside)
        check_shape(keys, holes_of, room)
        if holes.bore_reach > room:
            raise wide_bore(keys, room, "leaves_no_wall")
        check_holes(keys, holes_of, root_radius=inside)
        shape = wheel_shape(gear.thickness, keys.web, keys.hub, 0.0)
        check_wheel(shape, 2 * inside, holes)
        return replace(gear, holes=holes, hub=shape.hub, web=shape.web)

    def section(self, keys: FaceGearSpec, thing: FaceGear, offset: float) -> OffsetRegion:
        """As seen along the axis, for pictures, spaces of the teeth as marks: nothing flat is cut from it."""
        from geometry.gears.face.faces import seen_spaces
        from geometry.plane.offset_region import OffsetRegion
        from geometry.plane.profile import Label, Region, circle

        self.stays(offset)
        holes = thing.holes.profiles(0.0)
        # the circle first: it lies on the outline of the spaces
        marks = circle(thing.inner_radius, Label.BODY), seen_spaces(thing, _SEEN)
        return OffsetRegion(Region(circle(thing.outer_radius, Label.BODY), holes, marks), 0.0, ())

    def solid(self, keys: FaceGearSpec, thing: FaceGear, offset: float) -> FacedBody:
        """The gear."""
        from geometry.gears.face.faces import faced_face_gear

        return faced_face_gear(thing)

    def sketch(self, keys: FaceGearSpec, thing: FaceGear) -> Sketch:
        """Its plate and the ring of its teeth."""
        from geometry.gears.face.sketch import sketch_of_face_gear

        return sketch_of_face_gear(thing)

    def height(self, keys: FaceGearSpec, thing: FaceGear) -> float:
        """From the lower face to the tips."""
        return thing.height

    def middle(self, keys: FaceGearSpec, thing: FaceGear) -> float:
        """Half of the plate."""
        return thing.thickness / 2

    def report(self, keys: FaceGearSpec, thing: FaceGear) -> Report:
        """Diameters between which teeth can be, and where its pinion is mounted."""
        inner, outer = thing.tip_thickness([thing.inner_radius, thing.outer_radius]).tolist()
        circles = {
            "outer_diameter": 2 * thing.outer_radius,
            "inner_diameter": 2 * thing.inner_radius,
            "reference_diameter": 2 * thing.reference_radius,
            "undercut_diameter": 2 * thing.undercut_radius,
            "least_inner_diameter": 2 * thing.least_radius,
            "pointed_diameter": 2 * thing.pointed_radius,
        }
        quantities = {
            "radial_width": thing.face_width,
            "whole_depth": thing.whole_depth,
            "inner_tip_thickness": inner,
            "outer_tip_thickness": outer,
            "pinion_axis_height": thing.mounting_distance,
            **({"contact_plane": thing.contact_plane} if thing.more_teeth else {}),
        }
        return Report(face_gear_findings(thing), circles, quantities)


FACE_GEAR = FaceGearKind()


def face_gear_findings(gear: FaceGear) -> tuple[Finding, ...]:
    """Whether its tips are thin at the outer end."""
    from geometry.base.findings import short_of

    return short_of("thin_tip", float(gear.tip_thickness(gear.outer_radius)), _THIN * gear.module)
