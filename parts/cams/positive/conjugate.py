"""The part kind ``conjugate_cam``: the second disk of a pair, which moves the same follower by a second roller."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta
from msgspec.structs import replace

from geometry.base.errors import Nearest, ParameterError, UndercutError, limit, rounded
from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.plane.profile import Profile
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelShape, check_wheel
from parts.base.kind import Others, Report
from parts.base.links import owner_of
from parts.base.part_keys import MaterialKeys
from parts.base.schema import nearest_key
from parts.cams.disk_cam.part import EVEN_CAM, CamSpec, cam_findings, cam_of, cam_quantities, larger_bases
from parts.cams.wheel import Turned, inner_radius
from parts.keys.base import check_idle, degrees, in_vain, mm, part_mm
from parts.keys.holes import (
    BoreTable,
    HolesTable,
    RoundBoreTable,
    bore_of,
    check_holes,
    check_shape,
    hub_holes,
    wide_bore,
    wide_holes,
)
from parts.keys.timing_mark import TimingMarkTable, with_timing_mark
from parts.keys.wheel import FaceChamfer, FaceChamferTable, ScrewedHubTable, wheel_shape

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam
    from geometry.cams.plane.positive import Conjugate
    from parts.base.readback import Probe


_ROLLER_DISTANCE = part_mm(
    "between the rollers of a translating follower; default: by the base circle", above=0, example=96.0
)
_ROLLER_ANGLE = degrees(
    "between the arms of a swinging follower; default: by the base circle", above=0, below=360, example=300.0
)
_BASE_CIRCLE_RADIUS = part_mm("of this cam; default: that of the first", above=0, example=30.0)
_FACE_WIDTH = mm("thickness; default: that of the first", least=0.01, most=10_000, example=8.0)
_BORE_DIAMETER = part_mm("round bore; default: that of the first", least=0, example=12.0)


class ConjugateCamSpec(MaterialKeys, forbid_unknown_fields=True, tag_field="kind", tag="conjugate_cam"):
    """Keys of ``conjugate_cam``."""

    of: Annotated[str, Meta(description="the first cam: a part of kind cam with a roller")]
    roller_distance: Annotated[float, _ROLLER_DISTANCE] | None = None
    roller_angle_deg: Annotated[float, _ROLLER_ANGLE] | None = None
    base_circle_radius: Annotated[float, _BASE_CIRCLE_RADIUS] | None = None
    follower_radius: Annotated[float, part_mm("second roller; default: the first", above=0, example=7.0)] | None = None
    arm_length: Annotated[float, part_mm("second arm; default: the first", above=0, example=80.0)] | None = None
    face_width: Annotated[float, _FACE_WIDTH] | None = None
    bore_diameter: Annotated[float, _BORE_DIAMETER] | None = None
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    timing_mark: TimingMarkTable | None = None
    hub: ScrewedHubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0


class SecondCam(Record):
    """A second cam that exists: how it is turned on the shaft, the first cam, its keys, width in mm and holes."""

    pair: Conjugate
    first: DiskCam
    keys: CamSpec
    width: float
    holes: HubHoles

    @property
    def cam(self) -> DiskCam:
        """The cam in its own frame."""
        return self.pair.cam


def _circles(second: SecondCam) -> dict[str, float]:
    """The roller is nearest to the axis where the first one is farthest from it, not at cam angle 0."""
    base = inner_radius(second.cam)
    return {"base_circle_diameter": 2 * base, "prime_circle_diameter": 2 * (base + second.cam.radius)}


def _between_rollers(second: SecondCam) -> dict[str, float]:
    """How both rollers stand on their follower."""
    from geometry.cams.contact.positive import between_rollers

    between = between_rollers(second.first, second.pair)
    if second.keys.oscillating is None:
        return {"roller_distance": between}
    lowest = second.cam.swing.start_angle + second.cam.motion.extremes()[0]
    return {"roller_angle_deg": math.degrees(between), "lowest_angle_deg": math.degrees(lowest)}


def _idle(keys: ConjugateCamSpec, swings: bool) -> Iterator[ParameterError]:
    """What is of the other follower."""
    if swings:
        yield from in_vain(keys, ("roller_distance",), "arms_stand_by_angle")
    else:
        yield from in_vain(keys, ("roller_angle_deg",), "rollers_stand_by_distance")
        yield from in_vain(keys, ("arm_length",), "stem_has_no_arm")


def _pair(keys: ConjugateCamSpec, owner: CamSpec, first: DiskCam) -> Conjugate:
    """The second cam; refusals in the keys of this part."""
    from geometry.cams.plane.positive import conjugate_cam

    swings = owner.oscillating is not None
    check_idle(_idle(keys, swings))
    key = "roller_angle_deg" if swings else "roller_distance"
    given = getattr(keys, key)
    if given is not None and keys.base_circle_radius is not None:
        raise ParameterError("base_circle_radius", keys.base_circle_radius, "follows_from", Nearest(None), key=key)
    radius = owner.follower_radius if keys.follower_radius is None else keys.follower_radius
    if given is None:
        base = first.base_radius if keys.base_circle_radius is None else keys.base_circle_radius
        distance = _distance_of_base(first, base, radius, keys.arm_length)
    else:
        distance = math.radians(given) if swings else given
    try:
        return conjugate_cam(first, distance, radius=radius, arm_length=keys.arm_length)
    except ParameterError as refusal:
        if refusal.name != "roller_distance":
            raise refusal.renamed({"radius": "follower_radius"}.get(refusal.name, refusal.name)) from refusal
        if given is None:
            # the base circle stands for the distance
            raise ParameterError("base_circle_radius", keys.base_circle_radius, refusal.code) from refusal
        raise ParameterError(key, given, refusal.code, lambda: _nearest_distance(keys, owner, first, key)) from refusal


def _nearest_distance(keys: ConjugateCamSpec, owner: CamSpec, first: DiskCam, key: str) -> Nearest | None:
    """The distance (mm) or angle (degrees) of the rollers nearest to the given one with which the cam is whole."""
    from geometry.cams.plane.undercut import is_uncut

    radius = owner.follower_radius if keys.follower_radius is None else keys.follower_radius
    usual = _distance_of_base(first, first.base_radius, radius, keys.arm_length)
    end = math.degrees(usual) if key == "roller_angle_deg" else usual

    def whole(changed: ConjugateCamSpec) -> bool:
        cam = _pair(changed, owner, first).cam
        _checked_holes(changed, owner, first, inner_radius(cam))
        return is_uncut(cam)

    return nearest_key(keys, key, getattr(keys, key), end, whole)


def _distance_of_base(first: DiskCam, base: float, radius: float, arm_length: float | None) -> float:
    """Distance (mm) or angle (rad) between the rollers, the second of ``radius`` mm, by the base circle of its cam.

    It is the nearest to the axis where the first stands highest.
    """
    from geometry.cams.motion.guides import Translating, oscillating_start_angle

    mount, highest = first.mount, first.motion.extremes()[1]
    if isinstance(mount, Translating):
        prime, offset = base + radius, abs(mount.offset)
        if not prime > offset:
            least = limit(offset * (1 + 1e-9) - radius, base)
            raise ParameterError("base_circle_radius", base, "base_circle_within_offset", least)
        return mount.start_height + highest + math.sqrt((prime - mount.offset) * (prime + mount.offset))
    mount = first.swing
    arm = mount.arm_length if arm_length is None else arm_length
    try:
        nearest_angle = oscillating_start_angle(base, mount.centre_distance, arm, radius)
    except ParameterError as refusal:
        if arm_length is None:
            raise
        short = arm < mount.centre_distance
        reach = abs(mount.centre_distance - base - radius) if short else mount.centre_distance + base + radius
        raise ParameterError(
            "arm_length", arm, "arm_does_not_reach", limit(reach * (1 + 1e-6 if short else 1 - 1e-6), arm)
        ) from refusal
    return 2 * math.pi - mount.start_angle - highest - nearest_angle


def _check_whole(keys: ConjugateCamSpec, owner: CamSpec, first: DiskCam, pair: Conjugate) -> None:
    """No undercut; else what base circle of this cam is large enough, where none follows from the rollers."""
    from geometry.cams.plane.undercut import is_uncut, lost_to_undercut

    if lost_to_undercut(pair.cam) is None:
        return
    found = inner_radius(pair.cam)

    def whole(changed: ConjugateCamSpec) -> bool:
        return is_uncut(_pair(changed, owner, first).cam)

    cure = partial(nearest_key, keys, "base_circle_radius", found, larger_bases(found), whole)
    raise UndercutError("base_circle_radius", found, "undercut_second", cure)


def _holes_of(keys: ConjugateCamSpec, owner: CamSpec) -> HubHoles:
    bore = bore_of(keys)
    if bore is None and keys.bore_diameter is None:
        # one shaft goes through both
        bore = RoundBoreTable(owner.bore_diameter) if owner.bore_diameter > 0 else owner.bore
    return hub_holes(bore, keys.holes, None)


def _checked_holes(keys: ConjugateCamSpec, owner: CamSpec, first: DiskCam, inside: float) -> HubHoles:
    """The holes, within the circle that is surely material; the mark stands where the first cam has its own."""
    check_shape(keys, lambda changed: _holes_of(changed, owner), inside)
    holes = _holes_of(keys, owner)
    if not holes.bore_reach < inside:
        if keys.bore is None and keys.bore_diameter is None:
            most = Nearest(rounded(2 * inside * 0.9999, up=False), "at_most")
            raise ParameterError("bore_diameter", None, "no_wall_to_base_circle", most, inside=inside)
        raise wide_bore(replace(keys, bore_diameter=keys.bore_diameter or 0.0), inside, "no_wall_to_base_circle")
    if not holes.reach < inside:
        raise wide_holes(
            keys, lambda k: _holes_of(k, owner), inside, "holes_beyond_base_circle",
            lambda k: bool(_checked_holes(k, owner, first, inside).number),
        )  # fmt: skip
    check_holes(keys, lambda changed: _holes_of(changed, owner), inside)
    return with_timing_mark(holes, keys.timing_mark, first, inside)


def _shape(keys: ConjugateCamSpec, width: float) -> WheelShape:
    """Hub and chamfers about a disk of ``width`` mm."""
    return wheel_shape(width, None, keys.hub, keys.face_chamfer)


class ConjugateCam(Turned[ConjugateCamSpec, SecondCam]):
    """The second disk of a pair."""

    name, keys, made_from = "conjugate_cam", ConjugateCamSpec, EVEN_CAM
    data_table = "parts.cams.data_tables"

    def idle(self, keys: ConjugateCamSpec, others: Others) -> Iterator[ParameterError]:
        """What is of the other follower."""
        return _idle(keys, owner_of(keys.of, others, CamSpec).oscillating is not None)

    def thing(self, keys: ConjugateCamSpec, others: Others) -> SecondCam:
        """The second cam, checked to move its roller all the way."""
        owner = owner_of(keys.of, others, CamSpec)
        first = cam_of(owner)
        if owner.follower != "roller":
            raise ParameterError("of", keys.of, "pair_without_roller", follower=owner.follower)
        pair = _pair(keys, owner, first)
        _check_whole(keys, owner, first, pair)
        width = owner.face_width if keys.face_width is None else keys.face_width
        inside = inner_radius(pair.cam)
        holes = _checked_holes(keys, owner, first, inside)
        check_wheel(_shape(keys, width), 2 * inside, holes)
        as_cam = replace(
            owner, follower_radius=pair.cam.radius, follower_offset=-owner.follower_offset, base_circle_radius=None
        )
        return SecondCam(pair, first, as_cam, width, holes)

    def body(self, keys: ConjugateCamSpec, thing: SecondCam) -> WheelShape:
        """Its own, as thick as the first where nothing is said."""
        return _shape(keys, thing.width)

    def holes(self, keys: ConjugateCamSpec, thing: SecondCam) -> HubHoles:
        """Its own, the bore of the first where nothing is said."""
        return thing.holes

    def inside(self, thing: SecondCam) -> float:
        """The lowest roller's circle."""
        return inner_radius(thing.cam)

    def outline(self, thing: SecondCam, offset: float) -> tuple[Profile, tuple[object, ...]]:
        """The profile as it sits on the shaft."""
        from geometry.cams.plane.shape import cam_shape

        shape = cam_shape(thing.cam, offset)
        return shape.profile.placed(Placement2(thing.pair.turn)), shape.gaps

    def pitch_curve(self, keys: ConjugateCamSpec, thing: SecondCam) -> Profile:
        """The profile, moved out by the roller's radius."""
        return self.outline(thing, thing.cam.radius)[0]

    def report(self, keys: ConjugateCamSpec, thing: SecondCam) -> Report:
        """Those of a disk cam, and how both rollers stand."""
        quantities = cam_quantities(thing.keys, thing.cam) | _between_rollers(thing)
        return Report(cam_findings(thing.keys, thing.cam), _circles(thing), quantities)

    def probes(self, keys: ConjugateCamSpec, thing: SecondCam) -> tuple[Probe, ...]:
        """The roller, rolled over the outline as it is turned."""
        from parts.cams.probes import TurningProbe

        def profile(offset: float) -> Profile:
            return self.outline(thing, offset)[0]

        return (TurningProbe(thing.cam, self.middle(keys, thing), profile, thing.pair.turn),)


CONJUGATE_CAM = ConjugateCam()
