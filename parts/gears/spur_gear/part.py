"""The part kind ``spur_gear``: an external spur gear cut by a rack."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Annotated, Literal, Protocol

from msgspec import Meta, Struct

from geometry.base.errors import LateError, Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.base.nearest import kept, nearest
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import (
    ISO_53,
    ISO_53_ANGLE,
    BasicRack,
    TipRelief,
    checked_rack,
    default_tip_radius,
    iso_53,
)
from geometry.gears.teeth.limits import checked_gear, exists, findings, root_form_diameter, tip_thickness
from geometry.gears.teeth.offset import chamfered_outline, gear_region, moved_outline
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import Rim, WheelShape, check_wheel, wheel_body, wheel_sections
from parts.base.kind import Others, Report
from parts.base.schema import replaced
from parts.base.texts import N_
from parts.gears.face_chamfers import chamfer_finding, check_face_chamfer
from parts.gears.quantities import circles, tooth_quantities
from parts.gears.toothed_kind import ToothedKind
from parts.keys.base import BoreDiameter, check_idle, in_modules, in_vain, mm
from parts.keys.cutter import CutterTable, PressureAngle, RackName, cutter_of
from parts.keys.engraving import Marks, ToothMarkTable, marked, tooth_mark
from parts.keys.helix import (
    ToothedKeys,
    checked_teeth,
    helix_of,
    idle_findings,
    section_finding,
    told_in_keys,
)
from parts.keys.holes import BoreTable, HolesTable, SpokesTable, bore_of, hub_holes, spoked, with_remedy
from parts.keys.sector import GearSectorTable, sector_of
from parts.keys.wheel import FaceChamfer, FaceChamferTable, ScrewedHubTable, WebTable, cross_holes, shape_of

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile
    from geometry.solids.body import Body
    from geometry.solids.cross_holes import CrossHole

# the radius that ISO 53 gives at the usual clearance; the default for racks given as a table
_TABLE_TIP_RADIUS = 0.38

_TIP_RADIUS_COEFFICIENT = in_modules(
    "tip rounding; default: the least of 0.38, c/(1 - sin a), full round", least=0, most=2, example=0.38
)


class RackTable(Struct, forbid_unknown_fields=True):
    """A cutting rack of your own, in modules."""

    addendum_coefficient: Annotated[float, in_modules("addendum of the basic rack", least=0.1, most=3)] = 1.0
    tip_clearance_coefficient: Annotated[float, in_modules("tip clearance", least=0, most=1)] = 0.25
    tip_radius_coefficient: Annotated[float, _TIP_RADIUS_COEFFICIENT] | None = None


_DEPTH_COEFFICIENT = in_modules("depth normal to the flank at the rack's tip line", least=0, most=0.3, example=0.02)


class ReliefTable(Struct, forbid_unknown_fields=True):
    """Flanking of the tooth tip (practicum, figure 1.4; GOST 13755), in modules."""

    depth_coefficient: Annotated[float, _DEPTH_COEFFICIENT]
    height_coefficient: Annotated[float, in_modules("height of the relieved part", least=0.01, most=3)] = 0.45


_TIP_DIAMETER = mm("tip diameter; default: d + 2 (h_a + x) m", above=0, most=2e6, example=50.0)
# mm, crowning that leaves every tooth its form
_LEAST_CROWNING = 1e-6
_CROWNING = mm("relief of each flank at both faces along the base tangent of the section, none in the middle (C_beta): "
               "teeth are barrels, double helical ones in either half", least=0, most=10)  # fmt: skip
_PROFILE_SHIFT_COEFFICIENT = in_modules("profile shift x (xi in the sources)", least=-10, most=10)


class SpurGearSpec(ToothedKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="spur_gear"):
    """Keys of ``spur_gear``."""

    number_of_teeth: Annotated[int, Meta(ge=3, le=10_000, description="number of teeth z", examples=[23])]
    profile_shift_coefficient: Annotated[float, _PROFILE_SHIFT_COEFFICIENT] = 0.0
    pressure_angle_deg: PressureAngle = 20.0
    basic_rack: RackName | RackTable = "ISO 53 A"
    cutter: CutterTable | None = None
    tip_diameter: Annotated[float, _TIP_DIAMETER] | None = None
    crowning: Annotated[float, _CROWNING] = 0.0
    thinning_method: Literal["wider_rack_tooth", "deeper_cut"] = "wider_rack_tooth"
    tip_relief: ReliefTable | None = None
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    spokes: SpokesTable | None = None
    web: WebTable | None = None
    hub: ScrewedHubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    tooth_mark: ToothMarkTable | None = None
    sector: GearSectorTable | None = None


@told_in_keys
def checked_spur_gear(keys: SpurGearSpec) -> SpurGear:
    """The gear of a part, checked to exist: its transverse section, where it is helical.

    Raises
    ------
    ParameterError
        The gear cannot exist; names the key and the nearest value that works.
    """
    helix = checked_teeth(keys, keys.number_of_teeth)

    def holes_fit(changed: SpurGearSpec) -> bool:
        section = transverse_gear(gear_of(changed), helix.angle)
        return section.holes.fits(section.root_radius)

    try:
        gear = checked_gear(gear_of(keys), helix.angle)
        check_face_chamfer(keys.face_chamfer, helix_of(keys), gear)
        tips = math.inf if gear.sector is not None else 2 * gear.tip_radius
        check_wheel(shape_of(keys), 2 * gear.core_radius, _about_axis(gear), tip_diameter=tips)
        _check_crowning(keys, gear)
    except ParameterError as refusal:
        whole = LateError(refusal.code, partial(_whole, keys, refusal))
        raise with_remedy(whole, keys, holes_fit) from refusal
    _marks(keys, gear)
    return gear


def _idle(keys: SpurGearSpec) -> Iterator[ParameterError]:
    """Crowning of teeth that are cut deeper."""
    if keys.thinning_method != "wider_rack_tooth":
        yield from in_vain(keys, ("crowning",), "not_crowned", key="thinning_method", given=keys.thinning_method)


def _check_crowning(keys: SpurGearSpec, gear: SpurGear) -> None:
    """Refuse crowning of teeth that are cut deeper, and one that leaves the faces no such tooth."""
    if not keys.crowning:
        return
    from geometry.gears.teeth.crowning import has_form

    check_idle(_idle(keys))

    def outline(one: SpurGear) -> Profile:
        return moved_outline(one, 0.0)[0]

    fits = partial(has_form, outline, gear)
    if not fits(_LEAST_CROWNING):
        raise ParameterError("crowning", keys.crowning, "crowned_full_round", Nearest(0.0))
    if not fits(keys.crowning):
        raise ParameterError("crowning", keys.crowning, "crowned_away", partial(nearest, fits, keys.crowning, 0.0))


def _about_axis(gear: SpurGear) -> HubHoles:
    """The holes within the largest circle about the axis: of a cut sector, whose others stand beyond, the bore."""
    cut = gear.sector is not None and gear.sector.is_cut
    return HubHoles(gear.holes.bore) if cut else gear.holes


def _marks(keys: SpurGearSpec, gear: SpurGear) -> Marks:
    """What is engraved between the root circle and all that is within it."""
    shape = shape_of(keys)
    hub = 0.0 if shape.hub is None else shape.hub.diameter / 2
    inner = max(_about_axis(gear).reach, hub, 0.0 if shape.web is None else shape.web.rim_diameter / 2)
    room = inner + shape.chamfer_above, gear.core_radius - shape.chamfer_above
    return tooth_mark(keys.tooth_mark, gear.number_of_teeth, room, keys.face_width)


def _whole(keys: SpurGearSpec, refusal: ParameterError) -> ParameterError:
    """A refused key of one's own rack or relief with the nearest value that gives a gear, not only a rack."""
    if not refusal.name.startswith(("basic_rack.", "tip_relief.")):
        return refusal

    def builds(value: float) -> bool:
        changed = replaced(keys, refusal.name, value)
        return exists(gear_of(changed), helix_of(changed).angle)

    def cure() -> Nearest | None:
        own, given = refusal.nearest, refusal.value
        if own is not None and (not isinstance(own.value, float) or kept(builds, own.value)):
            return own
        return nearest(builds, given, (0.5, 0.0)) if isinstance(given, float) else None

    return refusal.told_of(refusal.name, refusal.value, cure)


@told_in_keys
def bare_section(keys: SpurGearSpec) -> SpurGear:
    """The transverse section of a part's gear, not checked to exist."""
    return transverse_gear(gear_of(keys), helix_of(keys).angle)


class SpurGearKind(ToothedKind[SpurGearSpec, SpurGear]):
    """An external gear; a mate may have shortened its tip."""

    name, keys = "spur_gear", SpurGearSpec
    sheet_shown = "generating", N_('; purpose = "generating": device TMM-42')

    def idle(self, keys: SpurGearSpec, others: Others) -> Iterator[ParameterError]:
        """Two helices without an angle, crowning of teeth that have none."""
        yield from super().idle(keys, others)
        yield from _idle(keys)

    def thing(self, keys: SpurGearSpec, others: Others) -> SpurGear:
        """The transverse section of the gear."""
        return checked_spur_gear(keys)

    def section(self, keys: SpurGearSpec, thing: SpurGear, offset: float) -> OffsetRegion:
        """The exact section, moved."""
        return marked(gear_region(thing, offset), _marks(keys, thing))

    def cross_holes(self, keys: SpurGearSpec, thing: SpurGear) -> tuple[CrossHole, ...]:
        """For set screws."""
        return cross_holes(shape_of(keys))

    def solid(self, keys: SpurGearSpec, thing: SpurGear, offset: float) -> Body:
        """The wheel with its web, hub and chamfers."""
        from geometry.solids.engraving import engraved

        shape = replace(shape_of(keys), twist=helix_of(keys).twist(thing.reference_radius))
        deepest = max(shape.chamfer_below, shape.chamfer_above)

        def outline(moved: float, depth: float) -> Profile:
            if depth == 0 and (moved > 0 or deepest == 0):
                return moved_outline(thing, moved)[0]
            return chamfered_outline(thing, -moved, depth, max(deepest, depth))

        sections = wheel_sections(lru_cache(maxsize=8)(outline), thing.core_radius, thing.holes)
        sections = replace(sections, core=_about_axis(thing), rim=self._crowned(keys, thing, shape),
                           tip_radius=thing.tip_radius)  # fmt: skip
        body = wheel_body(shape, sections, offset)
        return engraved(body, _marks(keys, thing), keys.face_width)

    def _crowned(self, keys: SpurGearSpec, thing: SpurGear, shape: WheelShape) -> Rim | None:
        """Teeth with crowning; None where one section goes from face to face."""
        if not keys.crowning:
            return None
        from geometry.gears.teeth.crowning import crowned_teeth

        chamfers = shape.rim_chamfers(thing.tip_radius)

        def outline(gear: SpurGear, moved: float, depth: float) -> Profile:
            if max(chamfers) == 0:
                return moved_outline(gear, moved)[0]
            return chamfered_outline(gear, -moved, depth, max(chamfers))

        return crowned_teeth(outline, thing, keys.crowning, keys.face_width, chamfers, shape.twist)

    def is_plate(self, keys: SpurGearSpec, thing: SpurGear) -> bool:
        """Whether there is nothing but the section."""
        return shape_of(keys).is_plate and not keys.crowning

    def report(self, keys: SpurGearSpec, thing: SpurGear) -> Report:
        """Diameters and thicknesses, what is poor."""
        helix = math.radians(keys.helix_angle_deg)
        chamfer = chamfer_finding(keys.face_chamfer, keys.tip_rounding)
        found = (
            *rack_findings(keys, thing),
            *idle_findings(keys, thing.circumferential_thinning),
            *chamfer,
            *findings(thing, helix),
        )
        quantities = tooth_quantities(keys, thing, tip_thickness(thing))
        return Report(found, circles(thing, root_form_diameter(thing)), quantities, section_finding(keys))


SPUR_GEAR = SpurGearKind()


@told_in_keys
def gear_of(keys: SpurGearSpec) -> SpurGear:
    """The gear of a part as its keys say, not checked to exist: in normal data where it is helical.

    Raises
    ------
    ParameterError
        Its rack cannot exist, or two keys exclude each other.
    """
    helix = checked_teeth(keys, keys.number_of_teeth)
    bore_of(keys)
    _check_unused(keys)
    cutter = None if keys.cutter is None else cutter_of(keys.cutter, keys.module, math.radians(keys.pressure_angle_deg))
    gear = SpurGear(
        module=keys.module,
        number_of_teeth=keys.number_of_teeth,
        rack=_rack_of(keys),
        profile_shift_coefficient=keys.profile_shift_coefficient,
        given_tip_diameter=keys.tip_diameter,
        circumferential_thinning=keys.circumferential_thinning,
        thinning_by_deeper_cut=keys.thinning_method == "deeper_cut",
        tip_chamfer=keys.tip_chamfer,
        tip_rounding=keys.tip_rounding,
        bore_diameter=keys.bore_diameter,
        hub=hub_holes(keys.bore, keys.holes, keys.spokes),
        cutter=cutter,
    )
    if keys.sector is not None:
        root = transverse_gear(gear, helix.angle).root_radius
        gear = replace(gear, sector=sector_of(keys.sector, 1, root, gear.bore_radius))
        for key in ("web", "spokes") if keys.sector.rest == "cut" else ():
            if getattr(keys, key) is not None:
                raise ParameterError(key, None, "not_of_cut_sector", Nearest(None))
    if keys.spokes is None or gear.hub.spokes is not None:
        return gear
    core = transverse_gear(gear, helix.angle).core_radius
    return replace(gear, hub=hub_holes(keys.bore, keys.holes, spoked(keys, core).spokes))


def _check_unused(keys: SpurGearSpec) -> None:
    """A cutter leaves of a basic rack the addendum alone: what it would do to the root is refused, not passed over."""
    rack, default = keys.basic_rack, RackTable()
    if keys.cutter is None or not isinstance(rack, RackTable):
        return
    for key in ("tip_clearance_coefficient", "tip_radius_coefficient"):
        given, usual = getattr(rack, key), getattr(default, key)
        if given != usual:
            raise ParameterError(f"basic_rack.{key}", given, "made_by_cutter", Nearest(usual))


class Racked(Protocol):
    """Keys of a part that a rack cuts, or that is one."""

    pressure_angle_deg: float
    basic_rack: RackName | RackTable


def rounding_finding(keys: Racked) -> tuple[Finding, ...]:
    """The remark that a standard rack's tip rounding is less at this pressure angle: both, in modules."""
    if isinstance(keys.basic_rack, RackTable):
        return ()
    radius = basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg)).tip_radius
    standard = ISO_53[_profile(keys.basic_rack)][2]
    return (Finding("rack_rounding_reduced", radius, standard),) if radius < standard else ()


def rack_findings(keys: SpurGearSpec, gear: SpurGear) -> tuple[Finding, ...]:
    """What a gear does not take as it stands from its basic rack; beside a cutter only the addendum counts."""
    if keys.cutter is None:
        return rounding_finding(keys)
    if keys.basic_rack == "ISO 53 A":
        return ()
    addendum = gear.rack.addendum * gear.module / keys.module
    return (Finding("cutter_makes_root", addendum, 2 * gear.root_radius),)


def _rack_of(keys: SpurGearSpec) -> BasicRack:
    given = keys.tip_relief
    relief = None if given is None else TipRelief(given.depth_coefficient, given.height_coefficient)
    return basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg), relief)


@told_in_keys
def basic_rack_of(table: RackName | RackTable, angle: float, relief: TipRelief | None = None) -> BasicRack:
    """The basic rack that a key names or describes; ``angle`` in rad.

    Raises
    ------
    ParameterError
        The rack cannot exist; names the key and the nearest value that works.
    """
    if isinstance(table, str):
        return _standard_rack(_profile(table), angle, relief)
    addendum, clearance, radius = (
        table.addendum_coefficient,
        table.tip_clearance_coefficient,
        table.tip_radius_coefficient,
    )
    if radius is None:
        radius = default_tip_radius(angle, addendum, clearance, _TABLE_TIP_RADIUS)
    return checked_rack(BasicRack(angle, addendum, clearance, radius, relief))


def _profile(name: RackName) -> str:
    """The ISO 53 profile of a standard rack."""
    return "A" if name == "GOST 13755" else name[-1]


def _standard_rack(profile: str, angle: float, relief: TipRelief | None) -> BasicRack:
    """An ISO 53 rack; one that is pointed at this angle is refused with the largest angle that works."""
    try:
        return iso_53(profile, angle, relief)
    except ParameterError as refusal:
        if refusal.name.startswith("relief"):
            raise

        def whole(tried: float) -> bool:
            return iso_53(profile, tried) is not None

        cure = partial(nearest, whole, angle, ISO_53_ANGLE, digits=7)
        raise ParameterError("pressure_angle", angle, "standard_rack_pointed", cure, profile=profile) from refusal
