"""The part kind ``spur_gear``: an external spur gear cut by a rack."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

from geometry.errors import GeometryError, ParameterError, at_most
from geometry.findings import Finding
from geometry.gears.basic_rack import BasicRack, TipRelief, checked_rack, default_tip_radius, iso_53
from geometry.gears.limits import checked_gear, exists, findings, root_form_diameter, tip_thickness
from geometry.gears.offset_tooth import chamfered_outline, gear_region
from geometry.gears.spur import SpurGear
from geometry.gears.transverse import transverse_gear
from geometry.profile import Profile
from geometry.wheel import WheelShape, check_wheel, wheel_body, wheel_sections
from parts.cutter_keys import CutterTable, PressureAngle, RackName, cutter_of
from parts.helix_keys import (
    Double,
    HandName,
    HelixAngle,
    checked_helix,
    helix_of,
    helix_quantities,
    in_normal_terms,
    section_finding,
)
from parts.hole_keys import BoreTable, HolesTable, SpokesTable, hub_holes, with_remedy
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, in_modules, mm
from parts.materials import density_of
from parts.part import Part
from parts.remedies import sure_remedy
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, WebTable, as_typed, wheel_shape

# the radius that ISO 53 gives at the usual clearance; the default for racks given as a table
_TABLE_TIP_RADIUS = 0.38


class RackTable(Struct, forbid_unknown_fields=True):
    """A cutting rack of one's own, in modules."""

    addendum_coefficient: Annotated[float, in_modules("addendum of the basic rack", least=0.1, most=3)] = 1.0
    tip_clearance_coefficient: Annotated[float, in_modules("tip clearance", least=0, most=1)] = 0.25
    tip_radius_coefficient: (
        Annotated[
            float, in_modules("tip rounding; default: the least of 0.38, c/(1 - sin a), full round", least=0, most=2)
        ]
        | None
    ) = None


class ReliefTable(Struct, forbid_unknown_fields=True):
    """Flanking of the tooth tip (practicum, figure 1.4; GOST 13755), in modules."""

    depth_coefficient: Annotated[
        float, in_modules("depth normal to the flank at the rack's tip line", least=0, most=0.3)
    ]
    height_coefficient: Annotated[float, in_modules("height of the relieved part", least=0.01, most=3)] = 0.45


class SpurGearSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="spur_gear"):
    """External gear, spur or helical, cut by a rack or by a pinion cutter."""

    module: Annotated[float, mm("module m; the normal module where helix_angle_deg is not 0", least=0.01, most=1000)]
    number_of_teeth: Annotated[int, Meta(ge=3, le=10_000, description="number of teeth z")]
    profile_shift_coefficient: Annotated[float, in_modules("profile shift x (the seeds' xi)", least=-10, most=10)] = 0.0
    pressure_angle_deg: PressureAngle = 20.0
    basic_rack: RackName | RackTable = "ISO 53 A"
    cutter: CutterTable | None = None
    tip_diameter: Annotated[float, mm("tip diameter; default: d + 2 (h_a + x) m", above=0, most=100_000)] | None = None
    circumferential_thinning: Annotated[
        float, mm("thinning of each tooth for backlash, arc on the reference circle", least=0, most=1000)
    ] = 0.0
    thinning_method: Literal["wider_rack_tooth", "deeper_cut"] = "wider_rack_tooth"
    tip_relief: ReliefTable | None = None
    tip_chamfer: Annotated[float, mm("radial height of a 45 degree tip chamfer", least=0, most=1000)] = 0.0
    tip_rounding: Annotated[float, mm("radius of the tip corner", least=0, most=1000)] = 0.0
    helix_angle_deg: HelixAngle = 0.0
    hand: HandName = "right"
    double_helical: Double = False
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    spokes: SpokesTable | None = None
    web: WebTable | None = None
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_spur_gear(spec: SpurGearSpec) -> SpurGear:
    """The gear of a part, checked to exist: its transverse section, where it is helical.

    Raises
    ------
    ParameterError
        The gear cannot exist; names the key and the nearest value that works.
    """
    try:
        return _checked(spec)
    except ParameterError as refusal:
        raise sure_remedy(spec, refusal, _makes) from refusal


def _checked(spec: SpurGearSpec) -> SpurGear:
    """The same with remedies that look at one key each."""
    checked_helix(spec)
    _check_face_chamfer(spec)
    try:
        gear = checked_gear(_section_of(spec))
    except ParameterError as refusal:
        refusal = in_normal_terms(spec, refusal, _builds)
        raise with_remedy(_with_rack_remedy(spec, refusal), spec, _builds) from refusal
    try:
        check_wheel(_shape_of(spec), 2 * gear.root_radius, gear.holes)
    except ParameterError as refusal:
        raise as_typed(spec, refusal) from refusal
    return gear


def _makes(spec: SpurGearSpec) -> bool:
    """Whether the keys give a whole wheel, without a search for what would."""
    checked_helix(spec)
    _check_face_chamfer(spec)
    gear = _section_of(spec)
    if not exists(gear):
        return False
    gear.holes.check(gear.root_radius)
    check_wheel(_shape_of(spec), 2 * gear.root_radius, gear.holes)
    return True


def spur_gear_part(part_id: str, spec: SpurGearSpec, gear: SpurGear) -> Part:
    """The part of a gear, whose tip a mate may have shortened; sections are computed when an export asks."""
    circles = {
        "tip_diameter": 2 * gear.tip_radius,
        "reference_diameter": 2 * gear.reference_radius,
        "base_diameter": 2 * gear.base_radius,
        "root_form_diameter": root_form_diameter(gear),
        "root_diameter": 2 * gear.root_radius,
    }
    quantities = {
        "pitch": math.pi * gear.module,
        "tooth_thickness": gear.reference_thickness,
        "tip_tooth_thickness": tip_thickness(gear),
        **helix_quantities(spec, gear.reference_radius),
    }
    section = lru_cache(maxsize=8)(lambda offset: gear_region(gear, offset))

    def outline(offset: float, depth: float) -> Profile:
        return section(offset).region.outer if depth == 0 else chamfered_outline(gear, depth - offset)

    shape = replace(_shape_of(spec), twist=helix_of(spec).twist(gear.reference_radius))
    sections = wheel_sections(outline, gear.root_radius, gear.holes)
    return Part(
        part_id,
        "spur_gear",
        section,
        lru_cache(maxsize=2)(lambda offset: wheel_body(shape, sections, offset)),
        spec.face_width,
        shape.is_plate,
        (*_rack_finding(spec, gear), *findings(gear)),
        circles,
        quantities,
        spec.material,
        spec.colour,
        spec.density or density_of(spec.material),
        section_finding(spec),
    )


def _shape_of(spec: SpurGearSpec) -> WheelShape:
    return wheel_shape(spec.face_width, spec.web, spec.hub, spec.face_chamfer)


def _check_face_chamfer(spec: SpurGearSpec) -> None:
    """A plane chamfer of a screw surface is no ruled wall between parallel outlines."""
    given = spec.face_chamfer
    both = {"": given} if not isinstance(given, FaceChamferTable) else {".below": given.below, ".above": given.above}
    for key, value in both.items():
        if spec.helix_angle_deg and value > 0:
            raise ParameterError(f"face_chamfer{key}", value, "is not made on helical teeth; 0 works")


def _with_rack_remedy(spec: SpurGearSpec, refusal: ParameterError) -> ParameterError:
    """A refused key of one's own rack or relief with the largest value that gives a whole gear, not only a rack."""
    owner, _, key = refusal.name.partition(".")
    table = getattr(spec, owner, None) if owner in ("basic_rack", "tip_relief") else None
    if not isinstance(table, Struct) or getattr(table, key) is None:
        return refusal

    def builds(value: float) -> bool:
        changed = msgspec.structs.replace(table, **{key: value})
        return _builds(msgspec.structs.replace(spec, **{owner: changed}))

    low, high = (0.5 if key == "addendum_coefficient" else 0.0), float(getattr(table, key))
    if builds(high) or not builds(low):
        return refusal
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if builds(middle) else (low, middle)
    reason = refusal.allowed.partition("; at most")[0]
    return ParameterError(refusal.name, getattr(table, key), f"{reason}; at most {at_most(low, 4)} works")


def _builds(spec: SpurGearSpec) -> bool:
    try:
        return exists(_section_of(spec))
    except GeometryError:
        return False


def gear_of(spec: SpurGearSpec) -> SpurGear:
    """The gear of a part as its keys say, not checked to exist: in normal data where it is helical.

    Raises
    ------
    ParameterError
        Its rack cannot exist, or two keys exclude each other.
    """
    if spec.tip_chamfer > 0 and spec.tip_rounding > 0:
        raise ParameterError("tip_rounding", spec.tip_rounding, "give either tip_chamfer or tip_rounding; 0 works")
    if spec.bore is not None and spec.bore_diameter > 0:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    _check_unused(spec)
    cutter = None if spec.cutter is None else cutter_of(spec.cutter, spec.module, math.radians(spec.pressure_angle_deg))
    return SpurGear(
        module=spec.module,
        number_of_teeth=spec.number_of_teeth,
        rack=_rack_of(spec),
        profile_shift_coefficient=spec.profile_shift_coefficient,
        given_tip_diameter=spec.tip_diameter,
        circumferential_thinning=spec.circumferential_thinning,
        thinning_by_deeper_cut=spec.thinning_method == "deeper_cut",
        tip_chamfer=spec.tip_chamfer,
        tip_rounding=spec.tip_rounding,
        bore_diameter=spec.bore_diameter,
        hub=hub_holes(spec.bore, spec.holes, spec.spokes),
        cutter=cutter,
    )


def _check_unused(spec: SpurGearSpec) -> None:
    """A cutter leaves of a basic rack the addendum alone: what it would do to the root is refused, not passed over."""
    rack, default = spec.basic_rack, RackTable()
    if spec.cutter is None or not isinstance(rack, RackTable):
        return
    for key in ("tip_clearance_coefficient", "tip_radius_coefficient"):
        given, usual = getattr(rack, key), getattr(default, key)
        if given != usual:
            why = "the cutter makes the root, by its own addendum and tip rounding"
            cure = f"{usual:g} works" if usual is not None else "remove it"
            raise ParameterError(f"basic_rack.{key}", given, f"{why}; {cure}")


def _rack_finding(spec: SpurGearSpec, gear: SpurGear) -> tuple[Finding, ...]:
    """The remark that only the addendum of a basic rack counts beside a cutter: it, and the root diameter."""
    if spec.cutter is None or spec.basic_rack == "ISO 53 A":
        return ()
    addendum = gear.rack.addendum * gear.module / spec.module
    return (Finding("cutter_makes_root", addendum, 2 * gear.root_radius),)


def _section_of(spec: SpurGearSpec) -> SpurGear:
    """The transverse section of the gear of a part: the gear itself where it is not helical."""
    return transverse_gear(gear_of(spec), math.radians(spec.helix_angle_deg))


def _rack_of(spec: SpurGearSpec) -> BasicRack:
    given = spec.tip_relief
    relief = None if given is None else TipRelief(given.depth_coefficient, given.height_coefficient)
    return basic_rack_of(spec.basic_rack, math.radians(spec.pressure_angle_deg), relief)


def basic_rack_of(table: RackName | RackTable, angle: float, relief: TipRelief | None = None) -> BasicRack:
    """The basic rack that a key names or describes; ``angle`` in rad.

    Raises
    ------
    ParameterError
        The rack cannot exist; names the key and the nearest value that works.
    """
    if isinstance(table, str):
        return _standard_rack("A" if table == "GOST 13755" else table[-1], angle, relief)
    addendum, clearance, radius = (
        table.addendum_coefficient,
        table.tip_clearance_coefficient,
        table.tip_radius_coefficient,
    )
    if radius is None:
        radius = default_tip_radius(angle, addendum, clearance, _TABLE_TIP_RADIUS)
    return checked_rack(BasicRack(angle, addendum, clearance, radius, relief))


def _standard_rack(profile: str, angle: float, relief: TipRelief | None) -> BasicRack:
    """An ISO 53 rack; one that is pointed at this angle is refused with the largest angle that works."""
    try:
        return iso_53(profile, angle, relief)
    except ParameterError as refusal:
        if refusal.name.startswith("tip_relief"):
            raise
        low, high = math.radians(20.0), angle
        for _ in range(40):
            middle = (low + high) / 2
            try:
                iso_53(profile, middle)
                low = middle
            except ParameterError:
                high = middle
        reason = f"the tooth of rack {profile} is pointed before it reaches its tip line"
        remedy = f"{reason}; at most {at_most(math.degrees(low), 4)} works"
        raise ParameterError("pressure_angle_deg", math.degrees(angle), remedy) from refusal
