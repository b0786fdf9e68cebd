"""The part kind ``ring_gear``: an internal spur gear cut by a pinion cutter, or with rounded roots."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from parts.base.kind import Others, Report
from parts.gears.face_chamfers import chamfer_finding, check_face_chamfer
from parts.gears.quantities import circles, tooth_quantities
from parts.gears.toothed_kind import ToothedKind
from parts.keys.base import degrees, either, in_modules, mm
from parts.keys.cutter import CutterTable, cutter_of
from parts.keys.engraving import Marks, ToothMarkTable, marked, tooth_mark
from parts.keys.helix import (
    ToothedKeys,
    checked_teeth,
    helix_of,
    idle_findings,
    section_finding,
    told_in_keys,
)
from parts.keys.holes import HolesTable, PitchCircle, hub_holes, with_remedy
from parts.keys.sector import RingSectorTable, sector_of
from parts.keys.wheel import FaceChamfer, FaceChamferTable, wheel_shape

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.teeth.ring import RingGear
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.body import Body
    from geometry.solids.wheel import WheelShape

# modules outside the root circle where no rim was asked for
_RIM = 2.5
# modules between a default cutter's addendum and the ring's: the tip clearance of ISO 53 A
_CLEARANCE = 0.25

_DEDENDUM_COEFFICIENT = in_modules("depth of the root below the reference", least=0.1, most=3)


class RoundedRootTable(Struct, forbid_unknown_fields=True):
    """A root that no cutter made, for laser and printer: arcs tangent to flanks and root circle."""

    dedendum_coefficient: Annotated[float, _DEDENDUM_COEFFICIENT] = 1.25
    radius_coefficient: Annotated[float, in_modules("radius of the arcs; 0 with full_round", least=0, most=2)] = 0.0
    full_round: Annotated[bool, Meta(description="one arc from flank to flank, the largest there is")] = True


class RimHolesTable(HolesTable, forbid_unknown_fields=True):
    """Round holes in the rim (bolt circle), or a list of such tables."""

    pitch_circle_diameter: Annotated[PitchCircle, Meta(examples=[140.0])]


_TIP_DIAMETER = mm(
    "tip diameter; default: d - 2 (h_a - x - k) m, k of tip_rule (KHK: 0), no deeper than can be cut",
    above=0,
    most=100_000,
    example=117.0,
)
_OUTER_DIAMETER = mm(
    "outside of the rim; default: root diameter + 5 m, or holes + 2 m", above=0, most=200_000, example=140.0
)
_PROFILE_SHIFT_COEFFICIENT = in_modules("profile shift x_2, positive away from the axis", least=-10, most=10)


class RingGearSpec(ToothedKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="ring_gear"):
    """Keys of ``ring_gear``."""

    number_of_teeth: Annotated[int, Meta(ge=4, le=10_000, description="number of teeth z_2", examples=[60])]
    profile_shift_coefficient: Annotated[float, _PROFILE_SHIFT_COEFFICIENT] = 0.0
    pressure_angle_deg: Annotated[float, degrees("pressure angle of the cutter", least=5, most=45)] = 20.0
    addendum_coefficient: Annotated[float, in_modules("addendum h_a", least=0.1, most=3)] = 1.0
    cutter: CutterTable | None = None
    rounded_root: RoundedRootTable | None = None
    tip_rule: Literal["GOST 19274", "KHK"] = "GOST 19274"
    tip_diameter: Annotated[float, _TIP_DIAMETER] | None = None
    thinning_method: Literal["wider_cutter_tooth", "deeper_cut"] = "wider_cutter_tooth"
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None
    holes: RimHolesTable | list[RimHolesTable] | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    tooth_mark: ToothMarkTable | None = None
    sector: RingSectorTable | None = None


@told_in_keys
def checked_ring_gear(keys: RingGearSpec) -> RingGear:
    """The ring of a part, checked to exist: its transverse section, where it is helical.

    Raises
    ------
    ParameterError
        The ring cannot exist or its cutter cannot make it; names the key and the nearest value that works.
    """
    from geometry.base.errors import ParameterError
    from geometry.base.record import replace
    from geometry.gears.teeth.ring_limits import check_rim, checked_ring

    normal, section = _ring_of(keys), settled_section(keys)

    def keeps_rim(changed: RingGearSpec) -> bool:
        check_rim(_with_rim(changed, replace(section, holes=hub_holes(None, changed.holes, None))))
        return True

    try:
        helix = checked_teeth(keys, keys.number_of_teeth)
        gear = _with_rim(keys, checked_ring(section, normal, helix.angle))
        check_face_chamfer(keys.face_chamfer, helix, gear)
    except ParameterError as refusal:
        raise with_remedy(refusal, keys, keeps_rim) from refusal
    _marks(keys, gear)
    return gear


def _marks(keys: RingGearSpec, gear: RingGear) -> Marks:
    """What is engraved in the rim, where a hole does not stand on +x too."""
    outer = gear.outer_radius
    for group in gear.holes.round_holes:
        if any(abs(c.imag) < group.diameter and c.real > 0 for c in group.centres()):
            outer = min(outer, (group.pitch_circle_diameter - group.diameter) / 2)
    chamfer = shape_of_ring(keys).chamfer_above
    room = gear.core_radius + chamfer, outer - chamfer
    return tooth_mark(keys.tooth_mark, gear.number_of_teeth, room, keys.face_width, inside=True)


def shape_of_ring(keys: RingGearSpec) -> WheelShape:
    """Thickness and chamfers."""
    return wheel_shape(keys.face_width, None, None, keys.face_chamfer)


@told_in_keys
def settled_section(keys: RingGearSpec) -> RingGear:
    """The transverse section with the cutter and the default tip that a build takes, not checked to exist.

    Raises
    ------
    ParameterError
        Keys that exclude each other; names one of them.
    """
    from geometry.gears.teeth.ring_made import settled_ring
    from geometry.gears.teeth.transverse_ring import transverse_ring

    return settled_ring(transverse_ring(_ring_of(keys), checked_teeth(keys, keys.number_of_teeth).angle))


def _with_rim(keys: RingGearSpec, gear: RingGear) -> RingGear:
    """The ring with the outside that follows from root and holes, where nobody gave one."""
    from geometry.base.record import replace

    if keys.outer_diameter is not None:
        return gear
    # holes keep a module to the outside
    radius = max(gear.core_radius + _RIM * keys.module, *(g.reach + keys.module for g in gear.holes.round_holes), 0.0)
    return replace(gear, outer_diameter=2 * radius)


def _ring_of(keys: RingGearSpec) -> RingGear:
    """The ring that the keys describe, in normal data, with any cutter where none is named, not checked to exist."""
    from geometry.gears.teeth.cutter import PinionCutter
    from geometry.gears.teeth.ring import RingGear, RoundedRoot

    if keys.cutter is not None and keys.rounded_root is not None:
        raise either("rounded_root", keys.rounded_root, "cutter")
    angle, rim = math.radians(keys.pressure_angle_deg), keys.outer_diameter
    height = keys.addendum_coefficient + _CLEARANCE
    root: PinionCutter | RoundedRoot = PinionCutter(keys.module, 25, angle, addendum=height)
    if keys.cutter is not None:
        root = cutter_of(keys.cutter, keys.module, angle)
    if (table := keys.rounded_root) is not None:
        root = RoundedRoot(table.dedendum_coefficient, None if table.full_round else table.radius_coefficient)
    return RingGear(
        module=keys.module,
        number_of_teeth=keys.number_of_teeth,
        pressure_angle=angle,
        # larger than any ring, until the root diameter is known
        outer_diameter=rim if rim is not None else 1e9,
        root=root,
        profile_shift_coefficient=keys.profile_shift_coefficient,
        addendum=keys.addendum_coefficient,
        plain_tip=keys.tip_rule == "KHK",
        given_tip_diameter=keys.tip_diameter,
        circumferential_thinning=keys.circumferential_thinning,
        thinning_by_deeper_cut=keys.thinning_method == "deeper_cut",
        tip_chamfer=keys.tip_chamfer,
        tip_rounding=keys.tip_rounding,
        any_cutter=keys.cutter is None and isinstance(root, PinionCutter),
        holes=hub_holes(None, keys.holes, None),
        sector=sector_of(keys.sector, -1),
    )


class RingGearKind(ToothedKind[RingGearSpec, "RingGear"]):
    """An internal gear: a toothed hole in a round rim."""

    name, keys = "ring_gear", RingGearSpec

    def thing(self, keys: RingGearSpec, others: Others) -> RingGear:
        """The transverse section of the ring."""
        return checked_ring_gear(keys)

    def section(self, keys: RingGearSpec, thing: RingGear, offset: float) -> OffsetRegion:
        """The exact section, moved."""
        from geometry.gears.teeth.ring_offset import ring_region

        return marked(ring_region(thing, offset), _marks(keys, thing))

    def solid(self, keys: RingGearSpec, thing: RingGear, offset: float) -> Body:
        """The section along the helix, with its chamfers."""
        from geometry.base.record import replace
        from geometry.gears.teeth.ring_offset import ring_sections
        from geometry.solids.engraving import engraved
        from geometry.solids.wheel import wheel_body

        shape = replace(shape_of_ring(keys), twist=helix_of(keys).twist(thing.reference_radius))
        sections = ring_sections(thing, max(shape.chamfer_below, shape.chamfer_above))
        return engraved(wheel_body(shape, sections, offset), _marks(keys, thing), keys.face_width)

    def is_plate(self, keys: RingGearSpec, thing: RingGear) -> bool:
        """Whether there is nothing but the section."""
        return shape_of_ring(keys).is_plate

    def report(self, keys: RingGearSpec, thing: RingGear) -> Report:
        """Diameters and thicknesses, the cutter, what is poor."""
        from geometry.gears.teeth.ring_limits import findings, root_form_diameter, tip_thickness

        quantities = {**tooth_quantities(keys, thing, tip_thickness(thing)), **_cutter_quantities(keys, thing)}
        tip = tip_finding(thing, keys.module)
        chamfer = chamfer_finding(keys.face_chamfer, keys.tip_rounding)
        found = (
            *(() if tip is None else (tip,)),
            *idle_findings(keys, thing.circumferential_thinning),
            *chamfer,
            *findings(thing),
        )
        return Report(found, circles(thing, root_form_diameter(thing)), quantities, section_finding(keys))


RING_GEAR = RingGearKind()


def _cutter_quantities(keys: RingGearSpec, gear: RingGear) -> dict[str, float]:
    """The cutter that makes the ring, its heights in normal modules; nothing for rounded roots."""
    cutter, normal = gear.cutter, gear.module / keys.module
    if cutter is None:
        return {}
    return {
        "cutter_number_of_teeth": cutter.number_of_teeth,
        "cutter_addendum_coefficient": cutter.addendum * normal,
        "cutter_tip_rounding_coefficient": cutter.tip_rounding * normal,
    }


def tip_finding(gear: RingGear, normal_module: float | None = None) -> Finding | None:
    """The remark that a default tip was made shallower: addendum taken and asked, from the shifted reference circle.

    ``normal_module``: that of the keys, mm, where ``gear`` is the transverse section of a helical ring.
    """
    from geometry.base.findings import Finding

    if gear.given_tip_diameter is not None or gear.tip_radius <= gear.default_tip_radius:
        return None
    shifted = gear.reference_radius + gear.profile_shift_coefficient * gear.module
    taken, asked = ((shifted - r) / (normal_module or gear.module) for r in (gear.tip_radius, gear.default_tip_radius))
    return Finding("ring_tip_limited", taken, asked)
