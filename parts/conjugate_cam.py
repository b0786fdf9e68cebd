"""The part kind ``conjugate_cam``: the second disk of a pair, which moves the same follower by a second roller."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct
from msgspec.structs import replace

from geometry.errors import GeometryError, OffsetError, ParameterError, UndercutError, at_least, at_most
from geometry.findings import Finding
from geometry.hub_holes import HubHoles
from geometry.offset_region import OffsetRegion
from geometry.placement import Placement2
from geometry.profile import Profile, Region
from geometry.trial import is_trial
from geometry.wheel import WheelShape, check_wheel, wheel_body, wheel_sections
from parts.cam import CamSpec, base_radius, cam_findings, cam_of, cam_quantities, inner_radius, nearest_offset
from parts.hole_keys import BoreTable, HolesTable, RoundBoreTable, hub_holes, wide_bore
from parts.keys import Colour, Density, Material, mm
from parts.links import owner_of
from parts.materials import density_of
from parts.part import Part
from parts.timing_mark import TimingMarkTable, with_timing_mark
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, wheel_shape

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam
    from geometry.cams.positive import Conjugate

_MOST = 100_000.0
_BISECTIONS = 40


class ConjugateCamSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="conjugate_cam"):
    """Second cam of a pair, turned as it sits on the shaft of the first: both have rotation_deg = 0."""

    of: Annotated[str, Meta(description="the first cam: a part of kind cam with a roller")]
    roller_distance: (
        Annotated[
            float, mm("between the rollers of a translating follower; default: by the base circle", above=0, most=_MOST)
        ]
        | None
    ) = None
    roller_angle_deg: (
        Annotated[
            float,
            Meta(
                gt=0,
                lt=360,
                description="between the arms of a swinging follower; default: by the base circle",
                extra={"unit": "degrees"},
            ),
        ]
        | None
    ) = None
    base_circle_radius: Annotated[float, mm("of this cam; default: that of the first", above=0, most=_MOST)] | None = (
        None
    )
    follower_radius: Annotated[float, mm("second roller; default: the first", above=0, most=_MOST)] | None = None
    arm_length: Annotated[float, mm("second arm; default: the first", above=0, most=_MOST)] | None = None
    face_width: Annotated[float, mm("thickness; default: that of the first", least=0.01, most=10_000)] | None = None
    bore_diameter: Annotated[float, mm("round bore; default: that of the first", least=0, most=_MOST)] | None = None
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    timing_mark: TimingMarkTable | None = None
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


@dataclass(frozen=True, slots=True)
class SecondCam:
    """A second cam that exists: how it is turned on the shaft, the first cam and its keys, its body and holes."""

    pair: Conjugate
    first: DiskCam
    keys: CamSpec
    shape: WheelShape
    holes: HubHoles

    @property
    def cam(self) -> DiskCam:
        """The cam in its own frame."""
        return self.pair.cam

    def outline(self, offset: float = 0.0) -> Profile:
        """The profile as it sits on the shaft, moved ``offset`` mm out of the material."""
        from geometry.cams.shape import cam_shape

        return cam_shape(self.cam, offset).profile.placed(Placement2(self.pair.turn))


def checked_conjugate(spec: ConjugateCamSpec, parts: dict[str, Struct]) -> SecondCam:
    """The second cam of a pair, checked to exist and to move its roller all the way.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    owner = owner_of(spec.of, parts, CamSpec)
    first = cam_of(owner)
    if owner.follower != "roller":
        raise ParameterError("of", spec.of, f'has follower = "{owner.follower}"; a conjugate pair needs a roller')
    pair = _pair(spec, owner, first)
    _check_whole(spec, owner, first, pair)
    width = owner.face_width if spec.face_width is None else spec.face_width
    shape = wheel_shape(width, None, spec.hub, spec.face_chamfer)
    holes, inside = _holes_of(spec, owner), inner_radius(pair.cam)
    if not holes.reach < inside:
        if not holes.bore_reach < inside:
            raise wide_bore(spec, inside, "leaves no wall to the base circle")
        raise ParameterError(
            "holes",
            2 * holes.reach,
            f"leaves no wall to the base circle; at most {at_most(2 * inside * 0.9999, 4)} mm works",
        )
    # where the first cam has its mark
    holes = with_timing_mark(holes, spec.timing_mark, first, inside)
    check_wheel(shape, 2 * inside, holes)
    keys = replace(
        owner, follower_radius=pair.cam.radius, follower_offset=-owner.follower_offset, base_circle_radius=None
    )
    return SecondCam(pair, first, keys, shape, holes)


def conjugate_part(part_id: str, spec: ConjugateCamSpec, second: SecondCam) -> Part:
    """The part of a second cam; sections are computed when an export asks."""
    from geometry.cams.walls import CamWall

    shape, section = second.shape, lru_cache(maxsize=8)(lambda offset: _section(second, offset))

    def outline(offset: float, depth: float) -> Profile:
        return section(offset).region.outer if depth == 0 else second.outline(offset - depth)

    sections = wheel_sections(outline, inner_radius(second.cam), second.holes)
    return Part(
        part_id,
        "conjugate_cam",
        section,
        lru_cache(maxsize=2)(lambda offset: wheel_body(shape, sections, offset)),
        shape.face_width,
        shape.is_plate,
        cam_findings(second.keys, second.cam),
        _circles(second),
        cam_quantities(second.keys, second.cam) | _between_rollers(second),
        spec.material,
        spec.colour,
        spec.density or density_of(spec.material),
        cam=second.cam,
        walls=(CamWall("cam", second.cam, shape.face_width / 2, second.outline, turn=second.pair.turn),),
    )


def _circles(second: SecondCam) -> dict[str, float]:
    """The roller is nearest to the axis where the first one is farthest from it, not at cam angle 0."""
    base = inner_radius(second.cam)
    return {"base_circle_diameter": 2 * base, "prime_circle_diameter": 2 * (base + second.cam.radius)}


def _between_rollers(second: SecondCam) -> dict[str, float]:
    """How both rollers stand on their follower."""
    if second.keys.oscillating is None:
        return {"roller_distance": second.first.slide.start_height + second.cam.slide.start_height}
    two = second.cam.swing.start_angle
    between = 2 * math.pi - second.first.swing.start_angle - two
    lowest = two + second.cam.motion.extremes()[0]
    return {"roller_angle_deg": math.degrees(between), "start_angle_deg": math.degrees(lowest)}


def _pair(spec: ConjugateCamSpec, owner: CamSpec, first: DiskCam) -> Conjugate:
    """The second cam; refusals in the keys of this part."""
    from geometry.cams.positive import conjugate_cam

    swings = owner.oscillating is not None
    key, other = ("roller_angle_deg", "roller_distance") if swings else ("roller_distance", "roller_angle_deg")
    if (wrong := getattr(spec, other)) is not None:
        kind = "swinging" if swings else "translating"
        raise ParameterError(other, wrong, f"a {kind} follower has {key} instead; remove it")
    given = getattr(spec, key)
    if given is not None and spec.base_circle_radius is not None:
        text = f"follows from {key}; remove one of both"
        raise ParameterError("base_circle_radius", spec.base_circle_radius, text)
    if spec.arm_length is not None and not swings:
        raise ParameterError("arm_length", spec.arm_length, "a translating follower has none; remove it")
    radius = owner.follower_radius if spec.follower_radius is None else spec.follower_radius
    if given is None:
        base = base_radius(first) if spec.base_circle_radius is None else spec.base_circle_radius
        distance = _distance_of_base(first, base + radius, spec.arm_length)
    else:
        distance = math.radians(given) if swings else given
    try:
        return conjugate_cam(first, distance, radius=radius, arm_length=spec.arm_length)
    except ParameterError as refusal:
        raise _in_keys(spec, first, refusal, key, radius) from refusal


def _in_keys(
    spec: ConjugateCamSpec, first: DiskCam, refusal: ParameterError, key: str, radius: float
) -> ParameterError:
    """A refusal of the mathematics under the name of this part's key, in degrees where that has them."""
    if refusal.name != "roller_distance":
        return ParameterError(
            {"radius": "follower_radius"}.get(refusal.name, refusal.name), refusal.value, refusal.allowed
        )
    value = getattr(spec, key)
    if value is None:
        key, value = "base_circle_radius", spec.base_circle_radius
    works = _distance_of_base(first, base_radius(first) + radius, spec.arm_length)
    told = f"{math.degrees(works):.9g} degrees" if key == "roller_angle_deg" else f"{works:.9g} mm"
    return ParameterError(key, value, f"the rollers must stand on both sides of the axis; {told} works")


def _distance_of_base(first: DiskCam, prime: float, arm_length: float | None) -> float:
    """Distance (mm) or angle (rad) between the rollers at which the second one comes ``prime`` mm near to the axis.

    It does so where the first stands highest.
    """
    from geometry.cams.mounts import Translating, oscillating_start_angle

    mount, highest = first.mount, first.motion.extremes()[1]
    if isinstance(mount, Translating):
        if not prime > abs(mount.offset):
            least = at_least(abs(mount.offset) - first.radius + 1e-3, 4)
            raise ParameterError("base_circle_radius", prime, f"lies within the follower's offset; {least} mm works")
        return mount.start_height + highest + math.sqrt((prime - mount.offset) * (prime + mount.offset))
    arm = mount.arm_length if arm_length is None else arm_length
    try:
        nearest = oscillating_start_angle(prime, mount.centre_distance, arm)
    except ParameterError as refusal:
        low, high = abs(mount.centre_distance - arm), mount.centre_distance + arm
        key = "base_circle_radius" if arm_length is None else "arm_length"
        text = f"the arm does not reach the cam: base circle and roller together must be {low:.6g} to {high:.6g} mm"
        raise ParameterError(key, prime if arm_length is None else arm, text) from refusal
    return 2 * math.pi - mount.start_angle - highest - nearest


def _check_whole(spec: ConjugateCamSpec, owner: CamSpec, first: DiskCam, pair: Conjugate) -> None:
    """No undercut; else what base circle of this cam is large enough."""
    from geometry.cams.undercut import is_whole, kept_arcs

    try:
        if not kept_arcs(pair.cam).gaps:
            return
    except UndercutError:
        pass
    found = inner_radius(pair.cam)

    def works(base: float) -> bool:
        try:
            other = replace(spec, base_circle_radius=base, roller_distance=None, roller_angle_deg=None)
            return is_whole(_pair(other, owner, first).cam)
        except GeometryError:
            return False

    high = None if is_trial() else next((found * 1.5**k for k in range(1, 13) if works(found * 1.5**k)), None)
    remedy = "a smaller follower_radius or longer phases work"
    if high is not None:
        low = found
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            low, high = (low, middle) if works(middle) else (middle, high)
        remedy = f"at least {at_least(high, 4)} mm works"
        if spec.roller_distance is not None or spec.roller_angle_deg is not None:
            remedy += " in place of the distance of the rollers"
    raise UndercutError("base_circle_radius", found, f"the second cam is undercut; {remedy}")


def _holes_of(spec: ConjugateCamSpec, owner: CamSpec) -> HubHoles:
    if spec.bore is not None and spec.bore_diameter:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    bore = spec.bore
    if spec.bore_diameter is not None and bore is None:
        bore = RoundBoreTable(spec.bore_diameter) if spec.bore_diameter > 0 else None
    elif bore is None:
        # one shaft goes through both
        bore = RoundBoreTable(owner.bore_diameter) if owner.bore_diameter > 0 else owner.bore
    return hub_holes(bore, spec.holes, None)


def _section(second: SecondCam, offset: float) -> OffsetRegion:
    """The exact section with every boundary moved out of the material."""
    from geometry.cams.undercut import kept_arcs

    inside, holes = inner_radius(second.cam), second.holes
    if not inside + offset > (holes.reach - offset if holes.number else 0.0):
        least = (holes.reach - inside) / 2 if holes.number else -inside
        raise OffsetError(offset, "leaves no rim", least * (1 - 1e-9))
    try:
        outline, gaps = second.outline(offset), len(kept_arcs(second.cam, offset).gaps)
    except GeometryError as refusal:
        raise OffsetError(offset, "leaves no outline", nearest_offset(second.cam, offset)) from refusal
    found = (Finding("outline_trimmed", float(gaps), offset),) if gaps else ()
    return OffsetRegion(Region(outline, holes.profiles(offset)), offset, found)
