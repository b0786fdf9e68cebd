"""The part kind ``bevel_gear``: a straight, skew or spiral bevel gear of spherical involutes, made for one mate."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta

from geometry.base.errors import ParameterError, limit
from geometry.base.findings import Finding, beyond, short_of
from geometry.base.record import replace
from geometry.base.tolerance import is_told
from geometry.gears.bevel.gear import BevelGear, Blank
from geometry.solids.wheel import check_wheel
from parts.base.kind import Kind, Others, Report
from parts.base.part_keys import MaterialKeys
from parts.keys.accuracy import AccuracyKey
from parts.keys.base import BoreDiameter, check_idle, degrees, either, in_modules, in_vain, mm
from parts.keys.helix import hand_finding, told_in_keys
from parts.keys.holes import BoreTable, HolesTable, check_holes, check_shape, holes_of, wide_bore

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.faced import FacedBody
    from geometry.solids.sketch import Sketch

_MOST = 100_000.0
# the usual face width: part of the cone distance, and modules; rim and wall in modules (GOST 19624-74, practice)
USUAL_SHARE, USUAL_FACE, _USUAL_RIM, _LEAST_RIM = 0.3, 10.0, 2.5, 0.05
# least thickness of a tip, in modules (the practicum's limit)
_THIN = 0.3

OuterModule = Annotated[
    float, mm("outer transverse module m_te, at the back cone", least=0.01, most=1000, example=2.0)
]  # fmt: skip
ShaftAngle = Annotated[float, degrees("angle between both axes", least=10, most=170)]
BevelAngle = Annotated[
    float,
    degrees("pressure angle; with spiral_angle_deg the normal one at the mean cone distance", least=10, most=35),
]
Teeth = Annotated[int, Meta(ge=3, le=10_000, description="number of teeth z", examples=[20])]
MateTeeth = Annotated[int, Meta(ge=3, le=10_000, description="number of teeth of its mate", examples=[40])]
Shift = Annotated[float, in_modules("shift coefficient x_e; that of the mate is -x_e", least=-1, most=1)]
ThicknessShift = Annotated[
    float, in_modules("change of the tooth's thickness x_tau; that of the mate is -x_tau", least=-1, most=1)
]
Addendum = Annotated[float, in_modules("addendum of the basic rack", least=0.1, most=3)]
TipClearance = Annotated[float, in_modules("tip clearance", least=0, most=1)]
TipRadius = Annotated[float, in_modules("tip rounding of the crown gear that cuts it", least=0.001, most=2)]

_FACE_WIDTH = mm(
    "length of the teeth b along the pitch cone; default: the lesser of 0.3 R_e and 10 m",
    least=0.01,
    most=10_000,
    example=12.0,
)
_SPIRAL_ANGLE = degrees(
    "spiral angle beta_m at the mean cone distance; 0 is zerol, without it teeth are straight",
    least=0,
    most=50,
    example=35.0,
)
_TOOTH_LINE = Meta(
    description="tooth line with spiral_angle_deg, on the crown gear: an arc of the cutter, or straight (skew)"
)
_CUTTER_RADIUS = mm(
    "radius of the tooth line's arc, r_c0; default: the mean cone distance R_m", above=0, most=_MOST, example=60.0
)
_TIP_CONE = Meta(
    description="tip cone: parallel to the mate's root cone, for one clearance along the face (GOST 19624, ISO "
    "23509, Gleason); or through the apex of the others"
)
_RIM_THICKNESS = mm("rim below the outer root, along the back cone; default: 2.5 m", above=0, most=_MOST, example=5.0)
_MOUNTING_DISTANCE = mm(
    "from the apex to the back face; it sets hub_length, or without a hub rim_thickness",
    above=0,
    most=_MOST,
    example=50.0,
)
_HAND = Meta(description="hand of the spiral: right where teeth run off clockwise outwards, seen from the apex")
_CIRCUMFERENTIAL_THINNING = mm("thinning of the tooth along the outer pitch circle, for backlash", least=0, most=1000)


class BevelGearSpec(MaterialKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="bevel_gear"):
    """Keys of ``bevel_gear``."""

    module: OuterModule
    number_of_teeth: Teeth
    mate_number_of_teeth: MateTeeth
    face_width: Annotated[float, _FACE_WIDTH] | None = None
    shaft_angle_deg: ShaftAngle = 90.0
    pressure_angle_deg: BevelAngle = 20.0
    profile_shift_coefficient: Shift = 0.0
    thickness_coefficient: ThicknessShift = 0.0
    addendum_coefficient: Addendum = 1.0
    tip_clearance_coefficient: TipClearance = 0.2
    tip_radius_coefficient: TipRadius = 0.2
    spiral_angle_deg: Annotated[float, _SPIRAL_ANGLE] | None = None
    hand: Annotated[Literal["right", "left"], _HAND] = "right"
    tooth_line: Annotated[Literal["arc", "straight"], _TOOTH_LINE] = "arc"
    cutter_radius: Annotated[float, _CUTTER_RADIUS] | None = None
    tip_cone: Annotated[Literal["parallel", "apex"], _TIP_CONE] = "parallel"
    circumferential_thinning: Annotated[float, _CIRCUMFERENTIAL_THINNING] = 0.0
    rim_thickness: Annotated[float, _RIM_THICKNESS] | None = None
    hub_diameter: Annotated[float, mm("hub behind the rim; 0 is none", least=0, most=_MOST)] = 0.0
    hub_length: Annotated[float, mm("length of the hub behind the rim", least=0, most=10_000)] = 0.0
    mounting_distance: Annotated[float, _MOUNTING_DISTANCE] | None = None
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    accuracy: AccuracyKey = None


def bevel_gear(keys: BevelGearSpec, blank: Blank) -> BevelGear:
    """The gear of its keys, not yet checked."""
    gear = BevelGear(
        keys.module, keys.number_of_teeth, keys.mate_number_of_teeth, 0.0, blank,
        math.radians(keys.shaft_angle_deg), math.radians(keys.pressure_angle_deg), keys.addendum_coefficient,
        keys.tip_clearance_coefficient, keys.tip_radius_coefficient, keys.profile_shift_coefficient,
        keys.thickness_coefficient, keys.circumferential_thinning, keys.tip_cone == "apex",
    )  # fmt: skip
    width = keys.face_width or min(USUAL_SHARE * gear.cone_distance, USUAL_FACE * keys.module)
    return _lined(keys, replace(gear, face_width=width))


def _idle(keys: BevelGearSpec) -> Iterator[ParameterError]:
    """What is of the tooth line of other teeth."""
    if keys.spiral_angle_deg is None or keys.tooth_line != "arc":
        yield from in_vain(keys, ("cutter_radius",), "bevel_cutter_without_arc")
    if keys.spiral_angle_deg is None:
        yield from in_vain(keys, ("tooth_line",), other="spiral_angle_deg")


def _lined(keys: BevelGearSpec, gear: BevelGear) -> BevelGear:
    """The gear with the tooth line of its keys, its section transverse to it."""
    check_idle(_idle(keys))
    arc = keys.tooth_line == "arc"
    if keys.spiral_angle_deg is None:
        return gear
    spiral = math.radians(keys.spiral_angle_deg)
    # a face all the way over the apex has no mean cone distance; it is refused
    radius = keys.cutter_radius or gear.mean_distance or math.inf
    return replace(
        gear, spiral_angle=spiral, cutter_radius=radius if arc else math.inf,
        hand=keys.hand, pressure_angle=math.atan(math.tan(gear.pressure_angle) / math.cos(spiral)),
    )  # fmt: skip


@told_in_keys
def _made(keys: BevelGearSpec) -> BevelGear:
    """The gear with its blank, checked to exist."""
    check_shape(keys, holes_of)
    holes = holes_of(keys)
    usual = _USUAL_RIM * keys.module
    rim = usual if keys.rim_thickness is None else keys.rim_thickness
    gear = bevel_gear(keys, Blank(rim, keys.hub_diameter, keys.hub_length, holes))
    if keys.rim_thickness is None:
        # half of what a hub or holes leave of it at most
        room = gear.rim_room - max(keys.hub_diameter / 2, holes.reach) / math.cos(gear.pitch_angle)
        rim = min(usual, max(room / 2, _LEAST_RIM * keys.module))
        gear = replace(gear, blank=replace(gear.blank, rim_thickness=rim))
    if keys.mounting_distance is not None:
        gear = _mounted(keys, gear, keys.mounting_distance, holes.reach)
    if bool(gear.blank.hub_diameter) != bool(gear.blank.hub_length):
        key = "hub_length" if keys.hub_diameter else "hub_diameter"
        raise ParameterError(key, getattr(keys, key), "bevel_hub_half_told")
    gear = gear.checked()
    if holes.bore_reach > gear.bore_room:
        raise wide_bore(keys, gear.bore_room, "leaves_no_wall")
    if holes.round_holes:
        check_holes(keys, holes_of, root_radius=gear.core_radius)
        try:
            check_wheel(gear.core_shape, 2 * gear.core_radius, holes)
        except ParameterError as refusal:
            raise refusal.renamed(refusal.name.replace("hub.", "hub_")) from refusal
    return gear


def _mounted(keys: BevelGearSpec, gear: BevelGear, distance: float, reach: float) -> BevelGear:
    """The gear whose back face lies so far from the apex, mm; ``reach``: of its bore."""
    key = "hub_length" if keys.hub_diameter else "rim_thickness"
    if getattr(keys, key):
        raise either("mounting_distance", distance, key)
    begins = gear.rim.imag if keys.hub_diameter else gear.outer(gear.root_angle).imag
    if distance <= begins:
        raise ParameterError("mounting_distance", distance, "bevel_mounted_in_teeth",
                             limit(begins + 1e-3 * keys.module, distance), least=begins)  # fmt: skip
    if keys.hub_diameter:
        return replace(gear, blank=replace(gear.blank, hub_length=distance - begins))
    sine = math.sin(gear.pitch_angle)
    room = gear.rim_room - 1.01 * reach / math.cos(gear.pitch_angle)
    if distance > (ends := begins + room * sine):
        raise ParameterError("mounting_distance", distance, "bevel_rim_over_axis", limit(ends, distance))
    return replace(gear, blank=replace(gear.blank, rim_thickness=(distance - begins) / sine))


class BevelGearKind(Kind[BevelGearSpec, BevelGear]):
    """A bevel gear: its back face at z = 0, the apex of its cones above, a tooth on +x."""

    # what is parallel to a cone over an involute meets its apex no more
    name, keys, has_outline, unmoved = "bevel_gear", BevelGearSpec, False, "bevel_not_moved"
    page = "parts.gears.bevel_gear.page"
    drawing = data_table = "parts.gears.bevel_gear.drawing"

    def idle(self, keys: BevelGearSpec, others: Others) -> Iterator[ParameterError]:
        """What is of the tooth line of other teeth."""
        return _idle(keys)

    def thing(self, keys: BevelGearSpec, others: Others) -> BevelGear:
        """The gear, checked to exist."""
        return _made(keys)

    def section(self, keys: BevelGearSpec, thing: BevelGear, offset: float) -> OffsetRegion:
        """Its outer end as seen along the axis, for pictures: nothing flat is cut from it."""
        from geometry.gears.bevel.faces import seen_profile
        from geometry.plane.offset_region import OffsetRegion
        from geometry.plane.profile import Region

        self.stays(offset)
        return OffsetRegion(Region(seen_profile(thing, 1e-6), thing.blank.holes.profiles()), 0.0, ())

    def solid(self, keys: BevelGearSpec, thing: BevelGear, offset: float) -> FacedBody:
        """The gear."""
        from geometry.gears.bevel.faces import faced_bevel

        return faced_bevel(thing)

    def sketch(self, keys: BevelGearSpec, thing: BevelGear) -> Sketch:
        """The cones of its tips and roots, its blank."""
        from geometry.gears.bevel.sketch import sketch_of_bevel

        return sketch_of_bevel(thing)

    def height(self, keys: BevelGearSpec, thing: BevelGear) -> float:
        """From the back face to the inner tip circle."""
        return thing.height

    def middle(self, keys: BevelGearSpec, thing: BevelGear) -> float:
        """Within its hub."""
        return thing.blank.hub_length / 3

    def report(self, keys: BevelGearSpec, thing: BevelGear) -> Report:
        """Diameters of the outer end, cones, and where it is mounted."""
        circles = {
            "tip_diameter": 2 * thing.outer(thing.tip_angle).real,
            "reference_diameter": 2 * thing.outer(thing.pitch_angle).real,
            "root_diameter": 2 * thing.outer(thing.root_angle).real,
        }
        quantities = {
            "face_width": thing.face_width,
            "outer_cone_distance": thing.cone_distance,
            "pitch_cone_angle_deg": math.degrees(thing.pitch_angle),
            "tip_cone_angle_deg": math.degrees(thing.tip_cone_angle),
            "root_cone_angle_deg": math.degrees(thing.root_angle),
            "base_cone_angle_deg": math.degrees(thing.involute.base),
            "virtual_teeth": thing.virtual_teeth,
            "outer_tip_thickness": thing.tip_land,
            **_spiral_quantities(thing),
            "mounting_distance": thing.mounting_distance,
            "tip_circle_to_apex": thing.outer(thing.tip_angle).imag,
        }
        return Report((*hand_finding(keys.hand, thing.is_straight), *bevel_findings(thing)), circles, quantities)


BEVEL_GEAR = BevelGearKind()


def _spiral_quantities(gear: BevelGear) -> dict[str, float]:
    """Normal module and spiral angles, deg, of teeth that are not straight."""
    if gear.is_straight:
        return {}
    inner, outer = (math.degrees(float(a)) for a in gear.line.spiral([gear.inner_distance, gear.cone_distance]))
    return {"mean_normal_module": gear.mean_normal_module, "inner_spiral_angle_deg": inner,
            "outer_spiral_angle_deg": outer}  # fmt: skip


def bevel_findings(gear: BevelGear) -> list[Finding]:
    """What a bevel gear had better not have: undercut, thin tips, a face too wide for its cones."""
    found = []
    if gear.is_undercut and not is_told(gear.profile_shift_coefficient, gear.least_shift):
        begins = gear.involute.angle(gear.joint[1])
        found.append(
            Finding("bevel_undercut", gear.outer(float(begins)).real * 2, gear.outer(gear.root_angle).real * 2)
        )
    found += short_of("thin_tip", gear.tip_land, _THIN * gear.module)
    most = min(USUAL_SHARE * gear.cone_distance, USUAL_FACE * gear.module)
    return [*found, *beyond("bevel_wide_face", gear.face_width, most)]
