"""The part kind ``ring_gear``: an internal spur gear cut by a pinion cutter, or with rounded roots."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from parts.cutter_keys import CutterTable, cutter_of
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
from parts.hole_keys import HolesTable, hub_holes, with_remedy
from parts.keys import Colour, Density, FaceWidth, Material, in_modules, mm
from parts.materials import density_of
from parts.part import Part

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.findings import Finding
    from geometry.gears.ring import RingGear

# modules outside the root circle where no rim was asked for
_RIM = 2.5
# modules between a default cutter's addendum and the ring's: the tip clearance of ISO 53 A
_CLEARANCE = 0.25


class RoundedRootTable(Struct, forbid_unknown_fields=True):
    """A root that no cutter made, for laser and printer: arcs tangent to flanks and root circle."""

    dedendum_coefficient: Annotated[float, in_modules("depth of the root below the reference", least=0.1, most=3)] = (
        1.25
    )
    radius_coefficient: Annotated[float, in_modules("radius of the arcs; 0 with full_round", least=0, most=2)] = 0.0
    full_round: Annotated[bool, Meta(description="one arc from flank to flank, the largest there is")] = True


class RimHolesTable(HolesTable, forbid_unknown_fields=True):
    """Round holes in the rim (bolt circle), or a list of such tables."""


class RingGearSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="ring_gear"):
    """Ring gear (internal teeth), spur or helical, cut by a pinion cutter."""

    module: Annotated[float, mm("module m; the normal module where helix_angle_deg is not 0", least=0.01, most=1000)]
    number_of_teeth: Annotated[int, Meta(ge=4, le=10_000, description="number of teeth z_2")]
    profile_shift_coefficient: Annotated[
        float, in_modules("profile shift x_2, positive away from the axis", least=-10, most=10)
    ] = 0.0
    pressure_angle_deg: Annotated[
        float, Meta(ge=5, le=45, description="pressure angle of the cutter", extra={"unit": "degrees"})
    ] = 20.0
    addendum_coefficient: Annotated[float, in_modules("addendum h_a", least=0.1, most=3)] = 1.0
    cutter: CutterTable | None = None
    rounded_root: RoundedRootTable | None = None
    tip_rule: Literal["GOST 19274", "KHK"] = "GOST 19274"
    tip_diameter: (
        Annotated[
            float,
            mm(
                "tip diameter; default: d - 2 (h_a - x - k) m, k of tip_rule (KHK: 0), no deeper than can be cut",
                above=0,
                most=100_000,
            ),
        ]
        | None
    ) = None
    circumferential_thinning: Annotated[
        float, mm("thinning of each tooth for backlash, arc on the reference circle", least=0, most=1000)
    ] = 0.0
    thinning_method: Literal["wider_cutter_tooth", "deeper_cut"] = "wider_cutter_tooth"
    tip_chamfer: Annotated[float, mm("radial height of a 45 degree tip chamfer", least=0, most=1000)] = 0.0
    tip_rounding: Annotated[float, mm("radius of the tip corner", least=0, most=1000)] = 0.0
    helix_angle_deg: HelixAngle = 0.0
    hand: HandName = "right"
    double_helical: Double = False
    outer_diameter: (
        Annotated[float, mm("outside of the rim; default: root diameter + 5 m, or holes + 2 m", above=0, most=200_000)]
        | None
    ) = None
    face_width: FaceWidth = 10.0
    holes: RimHolesTable | list[RimHolesTable] | None = None
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_ring_gear(spec: RingGearSpec) -> RingGear:
    """The ring of a part, checked to exist: its transverse section, where it is helical.

    Raises
    ------
    ParameterError
        The ring cannot exist or its cutter cannot make it; names the key and the nearest value that works.
    """
    from geometry.errors import ParameterError
    from geometry.gears.ring_made import makes
    from parts.remedies import sure_remedy

    try:
        return _ring_of(spec)
    except ParameterError as refusal:
        refusal = in_normal_terms(spec, refusal, lambda changed: makes(_section_of(changed)))
        refusal = with_remedy(refusal, spec, _builds)
        raise sure_remedy(spec, refusal, _makes) from refusal


def _builds(spec: RingGearSpec) -> bool:
    from geometry.errors import GeometryError

    try:
        _ring_of(spec)
    except GeometryError:
        return False
    return True


def _makes(spec: RingGearSpec) -> bool:
    """Whether the keys give a ring, without a search for what would."""
    from geometry.gears.ring_limits import check_rim
    from geometry.gears.ring_made import makes

    if not makes(_section_of(spec)):
        return False
    check_rim(_with_rim(spec, settled_section(spec)))
    return True


def _ring_of(spec: RingGearSpec) -> RingGear:
    from geometry.gears.ring_limits import checked_ring

    return _with_rim(spec, checked_ring(settled_section(spec)))


def settled_section(spec: RingGearSpec) -> RingGear:
    """The transverse section with the cutter and the default tip that a build takes, not checked to exist.

    Raises
    ------
    ParameterError
        Keys that exclude each other; names one of them.
    """
    from geometry.gears.ring_made import settled_ring

    return settled_ring(_section_of(spec))


def _with_rim(spec: RingGearSpec, gear: RingGear) -> RingGear:
    """The ring with the outside that follows from root and holes, where nobody gave one."""
    from dataclasses import replace

    if spec.outer_diameter is not None:
        return gear
    # holes keep a module to the outside
    radius = max(gear.root_radius + _RIM * spec.module, *(g.reach + spec.module for g in gear.holes.round_holes), 0.0)
    return replace(gear, outer_diameter=2 * radius)


def _section_of(spec: RingGearSpec) -> RingGear:
    """The transverse section that the keys describe, with any cutter where none is named, not checked to exist."""
    from geometry.errors import ParameterError
    from geometry.gears.cutter import PinionCutter
    from geometry.gears.ring import RingGear, RoundedRoot
    from geometry.gears.transverse_ring import transverse_ring

    if spec.tip_chamfer > 0 and spec.tip_rounding > 0:
        raise ParameterError("tip_rounding", spec.tip_rounding, "give either tip_chamfer or tip_rounding; 0 works")
    if spec.cutter is not None and spec.rounded_root is not None:
        text = "give either cutter or rounded_root; remove one of them"
        raise ParameterError("rounded_root.dedendum_coefficient", spec.rounded_root.dedendum_coefficient, text)
    angle, rim = math.radians(spec.pressure_angle_deg), spec.outer_diameter
    height = spec.addendum_coefficient + _CLEARANCE
    root: PinionCutter | RoundedRoot = PinionCutter(spec.module, 25, angle, addendum=height)
    if spec.cutter is not None:
        root = cutter_of(spec.cutter, spec.module, angle)
    if (table := spec.rounded_root) is not None:
        root = RoundedRoot(table.dedendum_coefficient, None if table.full_round else table.radius_coefficient)
    gear = RingGear(
        module=spec.module,
        number_of_teeth=spec.number_of_teeth,
        pressure_angle=angle,
        # larger than any ring, until the root diameter is known
        outer_diameter=rim if rim is not None else 1e9,
        root=root,
        profile_shift_coefficient=spec.profile_shift_coefficient,
        addendum=spec.addendum_coefficient,
        plain_tip=spec.tip_rule == "KHK",
        given_tip_diameter=spec.tip_diameter,
        circumferential_thinning=spec.circumferential_thinning,
        thinning_by_deeper_cut=spec.thinning_method == "deeper_cut",
        tip_chamfer=spec.tip_chamfer,
        tip_rounding=spec.tip_rounding,
        any_cutter=spec.cutter is None and isinstance(root, PinionCutter),
        holes=hub_holes(None, spec.holes, None),
    )
    return transverse_ring(gear, checked_helix(spec).angle)


def ring_gear_part(part_id: str, spec: RingGearSpec, gear: RingGear) -> Part:
    """The part of a ring; sections are computed when an export asks."""
    from geometry.body import plate
    from geometry.gears.ring_limits import findings, root_form_diameter, tip_thickness
    from geometry.gears.ring_offset import ring_region

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
        **_cutter_quantities(spec, gear),
    }
    section = lru_cache(maxsize=8)(lambda offset: ring_region(gear, offset))
    twist = helix_of(spec).twist(gear.reference_radius)

    def body(offset: float) -> Body:
        region = section(offset).region
        return plate(region, 0.0, spec.face_width, twist, toothed=region.holes[0])

    return Part(
        part_id,
        "ring_gear",
        section=section,
        body=lru_cache(maxsize=2)(body),
        face_width=spec.face_width,
        findings=(*((tip,) if (tip := tip_finding(gear, spec.module)) is not None else ()), *findings(gear)),
        flat_findings=section_finding(spec),
        circles=circles,
        quantities=quantities,
        material=spec.material,
        colour=spec.colour,
        density=spec.density or density_of(spec.material),
    )


def _cutter_quantities(spec: RingGearSpec, gear: RingGear) -> dict[str, float]:
    """The cutter that makes the ring, its heights in normal modules; nothing for rounded roots."""
    cutter, normal = gear.cutter, gear.module / spec.module
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
    from geometry.findings import Finding

    if gear.given_tip_diameter is not None or gear.tip_radius <= gear.default_tip_radius:
        return None
    shifted = gear.reference_radius + gear.profile_shift_coefficient * gear.module
    taken, asked = ((shifted - r) / (normal_module or gear.module) for r in (gear.tip_radius, gear.default_tip_radius))
    return Finding("ring_tip_limited", taken, asked)
