"""The part kind ``cam``: a disk cam for a pointed, roller, mushroom or flat follower."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal, Protocol, TypeVar

from msgspec import Meta, Struct

from geometry.base.errors import ConvergenceError, Cure, Nearest, ParameterError, UndercutError, limit
from geometry.base.findings import Finding, beyond
from geometry.base.nearest import kept, nearest
from geometry.plane.profile import Profile
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelShape
from parts.base.kind import Others, Report
from parts.base.schema import nearest_key, replaced
from parts.base.texts import N_
from parts.cams.disk_cam.contour import ContourTable, contour_motion
from parts.cams.wheel import DiskKeys, Turned, check_disk, inner_radius, marked_holes
from parts.keys.base import MOST_LENGTH, check_idle, in_vain, part_mm, start
from parts.keys.cam import (
    LAW_AT_REST,
    USUAL_PRESSURE_ANGLE,
    BaseCircle,
    Follower,
    FollowerOffset,
    FollowerRadius,
    LeastCurvature,
    LeastReturn,
    LeastTransmission,
    Lift,
    MotionTable,
    Moved,
    Phases,
    Swing,
    TableTolerance,
    idle_motion,
    idle_stroke,
    motion_of,
    rough_law,
    steep,
    stroke_quantity,
    table_quantities,
    turn,
)
from parts.keys.law import with_own_laws
from parts.keys.wheel import shape_of

if TYPE_CHECKING:
    from geometry.cams.motion.follower_motion import FollowerMotion
    from geometry.cams.plane.disk import DiskCam
    from geometry.cams.plane.synthesis import OscillatingAxis
    from parts.base.readback import Probe

M = TypeVar("M", bound=Moved)

# of a base circle, by which it is larger than the one whose cam has a cusp: no file holds a radius of curvature of 0
_SPARE = 1e-9
# an angle that is less short of the one asked for is kept: bases are rounded up
_KEPT_DEG = 1e-6
# transmission angles, degrees, that are tried where one asks for a huge cam
_EASIER = (89.9, 89.0, 85.0, 80.0, 60.0, 45.0, 30.0, 10.0, 1.0)
# shares of a limit, and of the way to it, at which a size is tried that gives a whole cam
_SMALLER = (0.9, 0.75, 0.5, 0.25, 0.1, 0.03)
_FARTHER = (0.01, 0.1, 0.3, 1.0)
# shares of the way to a face that stands upright at which a base circle is tried
_TOWARDS_PIVOT = (1 / 2, 1 / 4, 3 / 4, 1 / 8, 7 / 8, 3 / 8, 5 / 8, 1 / 16, 15 / 16, 1 / 64, 1 / 256, 1 / 1024, 1 / 4096)

_CENTRE_DISTANCE = part_mm(
    "from the cam's axis to the pivot; default: of the smallest cam by least_transmission_angle_deg",
    above=0,
    example=90.0,
)
_ARM_LENGTH = part_mm("from the pivot to the roller's centre; not for flat", above=0, example=80.0)
_SENSE = Meta(description="how the follower rises: against or with the cam's turning")


class OscillatingTable(Struct, forbid_unknown_fields=True):
    """A follower that swings about a pivot on +x."""

    centre_distance: Annotated[float, _CENTRE_DISTANCE] | None = None
    arm_length: Annotated[float, _ARM_LENGTH, start(80.0)] | None = None
    sense: Annotated[Literal["against", "with"], _SENSE] = "against"
    face_offset: Annotated[float, part_mm("flat face nearer to the axis than the pivot", least=-MOST_LENGTH)] = 0.0

    @property
    def turning(self) -> int:
        """+1: against the cam, -1: with it, while the follower rises."""
        return 1 if self.sense == "against" else -1


_PLATE_DIAMETER = part_mm("round plate of a translating flat or mushroom follower", above=0, example=60.0)


class CamSpec(DiskKeys, forbid_unknown_fields=True, tag_field="kind", tag="cam"):
    """Keys of ``cam``."""

    follower: Follower
    lift: Lift = 0.0
    swing_deg: Swing = 0.0
    phases: Annotated[Phases, with_own_laws(turn("polynomial_345"))] | None = None
    motion_table: MotionTable | None = None
    table_tolerance: TableTolerance = 0.0
    contour: ContourTable | None = None
    follower_radius: FollowerRadius = 0.0
    follower_offset: FollowerOffset = 0.0
    plate_diameter: Annotated[float, _PLATE_DIAMETER] | None = None
    oscillating: OscillatingTable | None = None
    base_circle_radius: BaseCircle | None = None
    least_transmission_angle_deg: LeastTransmission | None = None
    least_return_transmission_angle_deg: LeastReturn | None = None
    least_curvature_radius: LeastCurvature = 0.0


# of constant breadth, for what is made from a cam
EVEN_CAM: dict[str, object] = {
    "kind": "cam", "follower": "roller", "follower_radius": 8.0, "lift": 20.0, "base_circle_radius": 30.0,
    "phases": turn("sine"), "bore_diameter": 12.0,
}  # fmt: skip


# lifts beyond all rows that are told, part of the lift
_TOLD_OVERSHOOT = 1e-3


class FacedKeys(Protocol):
    """Keys of a cam whose follower may have a plate."""

    follower: Follower
    plate_diameter: float | None


def idle_follower(keys: CamSpec) -> Iterator[ParameterError]:
    """What another follower has: a radius, an offset, an angle of its return."""
    if keys.follower in ("pointed", "flat"):
        yield from in_vain(keys, ("follower_radius",), "follower_has_no_radius", end=keys.follower)
    if keys.oscillating is not None:
        yield from in_vain(keys, ("follower_offset",), "arm_has_no_offset")
    elif keys.contour is not None and keys.follower != "flat":
        yield from in_vain(keys, ("follower_offset",), "contour_is_centric")
    elif keys.follower == "flat" and keys.base_circle_radius is None:
        yield from in_vain(keys, ("least_return_transmission_angle_deg",), "flat_has_no_return_angle")


def cam_of(keys: CamSpec) -> DiskCam:
    """The cam of the keys, not yet checked for undercut; refusals speak in the scene's keys."""
    from geometry.cams.plane.disk import FollowerKind, translating_cam

    swing, base = keys.oscillating, keys.base_circle_radius
    check_idle(idle_stroke(keys, swing is not None, tabled=keys.motion_table is not None))
    check_idle(idle_follower(keys))
    kind = FollowerKind(keys.follower)
    motion = motion_of(keys, swing is not None) if keys.contour is None else contour_motion(keys)
    try:
        if swing is None:
            base = _least_base(keys, motion) if base is None else base
            return translating_cam(
                motion, kind, base, radius=keys.follower_radius, follower_offset=keys.follower_offset
            )
        if swing.face_offset and keys.follower != "flat":
            raise ParameterError("face_offset", swing.face_offset, "for_flat_only", Nearest(0.0))
        if swing.arm_length is None and keys.follower != "flat":
            raise ParameterError("arm_length", None, "arm_missing")
        if base is None:
            return _least_rocker(keys, swing, motion)
        if swing.centre_distance is None:
            raise ParameterError("centre_distance", None, "distance_missing")
        return _rocker(keys, swing, motion, swing.centre_distance, base)
    except ParameterError as refusal:
        if refusal.name == "lift" and keys.motion_table is not None:
            raise refusal.told_of("motion_table", None, None) from refusal
        name, factor = _IN_KEYS[swing is not None].get(refusal.name, (refusal.name, None))
        raise _fitted(keys, refusal.renamed(name, factor)) from refusal


def _rocker(keys: CamSpec, swing: OscillatingTable, motion: FollowerMotion, distance: float, base: float) -> DiskCam:
    """The cam of a swinging follower by its two sizes, mm."""
    from geometry.cams.plane.disk import FollowerKind, oscillating_cam

    return oscillating_cam(
        motion,
        FollowerKind(keys.follower),
        base,
        centre_distance=distance,
        arm_length=swing.arm_length or 0.0,
        radius=keys.follower_radius,
        sense=swing.turning,
        face_offset=swing.face_offset,
    )


# parameters of the mathematics as keys of a follower that slides and of one that swings, and their units
_IN_KEYS: dict[bool, dict[str, tuple[str, float | None]]] = {
    False: {"radius": ("follower_radius", None)},
    True: {
        "radius": ("follower_radius", None),
        "lift": ("swing_deg", math.degrees(1.0)),
        **{key: (f"oscillating.{key}", None) for key in ("centre_distance", "arm_length", "face_offset", "sense")},
    },
}


def _fits(keys: CamSpec) -> bool:
    """Whether the cam is whole and has room for its holes."""
    from geometry.cams.plane.undercut import is_uncut

    cam = cam_of(keys)
    if not is_uncut(cam):
        return False
    check_disk(keys, cam)
    return True


def _fitted(keys: CamSpec, refusal: ParameterError) -> ParameterError:
    """The refusal of a size with the nearest one that gives a whole cam too, from its own limit on."""

    def cure() -> Nearest | None:
        own = refusal.nearest
        if own is None or not isinstance(own.value, float) or own.side == "exactly":
            return own
        end, given = own.value, float(str(refusal.value))
        farther = [end * share for share in _SMALLER] if own.side == "at_most" else []
        ends = [end, *farther, *(end + (end - given) * share for share in _FARTHER)]
        return nearest_key(keys, refusal.name, given, ends, _fits)

    return refusal.told_of(refusal.name, refusal.value, cure)


def pressure_limits(keys: CamSpec, rise_deg: float) -> tuple[float, float | None]:
    """The greatest pressure angles on rises and on returns, rad, by the transmission angle of the rise; None: any."""
    back = keys.least_return_transmission_angle_deg
    if back is None:
        back = 0.0 if keys.oscillating is None else rise_deg
    return math.radians(90 - rise_deg), math.radians(90 - back) if back else None


def _steep_for(keys: CamSpec, code: str, fits: Callable[[CamSpec], bool], **numbers: float) -> ParameterError:
    """The refusal of the transmission angle that asks for too much: of the return where the rise's alone would do."""
    key, back = "least_transmission_angle_deg", "least_return_transmission_angle_deg"
    if getattr(keys, back) and kept(fits, replaced(keys, back, 0.0)):
        key = back
    given = getattr(keys, key)
    cure = partial(nearest, lambda tried: fits(replaced(keys, key, tried)), given, _EASIER)
    return ParameterError(key, given, code, cure, **numbers)


def _least_base(keys: CamSpec, motion: FollowerMotion) -> float:
    """The base circle by the textbook's condition: r_0 + rho of a flat face, r_0 - r of a roller."""
    from geometry.cams.plane.disk import FollowerKind, check_radius
    from geometry.cams.plane.synthesis import convex_roller_base_radius, flat_base_radius, roller_prime_radius

    angle, radius = keys.least_transmission_angle_deg, keys.follower_radius
    check_radius(FollowerKind(keys.follower), radius)
    spare = 1.0 if keys.least_curvature_radius else 1 + _SPARE
    if keys.follower == "flat":
        if angle is None and not keys.least_curvature_radius:
            raise ParameterError("base_circle_radius", None, "base_circle_missing_flat")
        if angle not in (None, 45):
            raise ParameterError("least_transmission_angle_deg", angle, "flat_angle_is_45", Nearest(45.0))
        least = flat_base_radius(motion, keys.least_curvature_radius).value
        return max(least * spare, 1e-3 * motion.lift)
    if angle is None:
        raise ParameterError("base_circle_radius", None, "base_circle_missing")

    def prime_of(tried: CamSpec) -> float:
        steepest = pressure_limits(tried, tried.least_transmission_angle_deg or 0.0)
        return roller_prime_radius(motion, keys.follower_offset, *steepest)

    base = _base_within(keys, prime_of(keys), prime_of)
    if keys.follower == "pointed":
        return base
    rho = keys.least_curvature_radius
    return max(base, spare * convex_roller_base_radius(motion, radius, rho, follower_offset=keys.follower_offset))


def _base_within(keys: CamSpec, prime: float, prime_of: Callable[[CamSpec], float]) -> float:
    """The base circle in a prime circle; refused where it is too large for a file, or no larger than the roller."""
    radius = keys.follower_radius
    if prime > MOST_LENGTH:
        numbers = {"prime": prime, "most": MOST_LENGTH}
        raise _steep_for(keys, "prime_circle_too_large", lambda tried: prime_of(tried) <= MOST_LENGTH, **numbers)
    if not prime - radius > 0:
        most = limit(prime * 0.9999, radius) if prime > 0 else None
        raise ParameterError("follower_radius", radius, "fills_prime_circle", most, prime=prime)
    return prime - radius


def _least_rocker(keys: CamSpec, swing: OscillatingTable, motion: FollowerMotion) -> DiskCam:
    """The smallest cam that keeps its transmission angles: at the pivot's distance, or at the best one."""
    from geometry.cams.motion.guides import oscillating_prime_radius
    from geometry.cams.plane.synthesis import convex_rocker_base_radius, oscillating_axis, oscillating_start_angles

    angle, arm, distance = keys.least_transmission_angle_deg, swing.arm_length or 0.0, swing.centre_distance
    if keys.follower == "flat":
        raise ParameterError("base_circle_radius", None, "base_circle_missing_of_arm")
    if angle is None:
        raise ParameterError("base_circle_radius", None, "base_circle_missing")

    def limits(tried: CamSpec) -> tuple[float, float | None]:
        return pressure_limits(tried, tried.least_transmission_angle_deg or 0.0)

    def best(tried: CamSpec) -> OscillatingAxis:
        return oscillating_axis(motion, arm, swing.turning, *limits(tried))

    def ends(away: float, tried: CamSpec = keys) -> tuple[float, float]:
        return oscillating_start_angles(motion, arm, away, swing.turning, *limits(tried))

    no_axis = partial(_steep_for, keys, "no_axis_keeps_angle")
    if distance is None:
        try:
            found = best(keys)
        except ConvergenceError as error:
            raise no_axis(lambda tried: best(tried).prime_radius <= MOST_LENGTH) from error
        distance, start = found.centre_distance, found.start_angle
        end = max(start, ends(distance)[1])
    else:
        start, end = ends(distance)
        if not start < end:
            away = distance
            try:
                # the distance of the smallest cam serves, where any does
                far = best(keys).centre_distance
            except ConvergenceError as error:
                raise no_axis(lambda tried: operator.lt(*ends(away, tried))) from error

            def cured() -> Nearest | None:
                return nearest(lambda x: operator.lt(*ends(x)), away, [far * 1.000001, far * 1.01, far * 1.5])

            raise ParameterError("centre_distance", distance, "pivot_keeps_no_angle", cured)
    prime, most = (oscillating_prime_radius(psi, distance, arm) for psi in (start, end))
    base = _base_within(keys, prime, lambda tried: best(tried).prime_radius)
    if keys.follower != "pointed":
        rho = keys.least_curvature_radius
        most = min(most, MOST_LENGTH) - keys.follower_radius
        least = convex_rocker_base_radius(lambda x: _rocker(keys, swing, motion, distance, x), base, most, rho)
        base = least if rho or least == base else least * (1 + _SPARE)
    return _rocker(keys, swing, motion, distance, base)


def undercut(cam: DiskCam, key: str, value: float, lost: float, cure: Cure) -> UndercutError:
    """The refusal of a cam that loses so much lift, mm or rad."""
    if lost == 0:
        return UndercutError(key, value, "profile_folds", cure)
    if math.isinf(lost):
        return UndercutError(key, value, "undercut_all", cure)
    if cam.swings:
        return UndercutError(key, value, "undercut_swing", cure, lost=math.degrees(lost))
    return UndercutError(key, value, "undercut", cure, lost=lost)


def by_impact(
    keys: M, motion: FollowerMotion, whole: Callable[[M], bool], *, swings: bool, both: bool
) -> UndercutError | None:
    """The refusal of a cam that is undercut where the velocity drops (``both``: or rises), of whatever size.

    ``whole``: whether other keys make a cam that is not undercut.
    """

    def at_jumps(tried: FollowerMotion) -> list[float]:
        rigid = (j for j in tried.impacts() if j.impact == "rigid")
        return [math.degrees(j.angle) for j in rigid if both or j.jumps[1] < 0]

    if not (found := at_jumps(motion)):
        return None

    def calm(key: str) -> bool:
        return not at_jumps(motion_of(replaced(keys, key, LAW_AT_REST), swings))

    if (rough := rough_law(keys.phases or [], motion.phases, calm)) is None:
        return None
    code = "undercut_by_impact" if rough.alone else "undercut_by_impacts"
    cure = rough.cure(lambda law: whole(replaced(keys, rough.key, law)))
    return UndercutError(rough.key, rough.law, code, cure, at=found[0])


def larger_bases(base: float, cam: DiskCam | None = None) -> list[float]:
    """Base circles that are tried for a whole cam, mm: ever larger ones, then some between.

    Of a flat face that swings, whose base circle has a greatest size too, those up to where the face stands upright.
    """
    if cam is not None and cam.is_flat and cam.swings:
        room = cam.swing.centre_distance - cam.swing.face_offset - base
        return [base + room * share for share in _TOWARDS_PIVOT] if room > 0 else []
    return [*(base * 2 * 1.5**k for k in range(12)), *(base * (1 + k / 16) for k in range(1, 16))]


def idle_plate(keys: FacedKeys, *, plain: bool = True) -> Iterator[ParameterError]:
    """The plate of a follower that has none; ``plain``: its follower may have one."""
    if not plain or keys.follower not in ("flat", "mushroom"):
        yield from in_vain(keys, ("plate_diameter",), "for_faces_only")


def check_face(keys: FacedKeys, cam: DiskCam) -> None:
    """The contact stays on the plate of the follower."""
    if keys.plate_diameter is None:
        return
    least = cam.least_plate_diameter()
    if not keys.plate_diameter >= least:
        raise ParameterError(
            "plate_diameter", keys.plate_diameter, "contact_over_edge", limit(least, keys.plate_diameter)
        )


def cam_circles(cam: DiskCam) -> dict[str, float]:
    """Named diameters of a cam, mm."""
    circles = {"base_circle_diameter": 2 * cam.base_radius}
    if cam.radius > 0:
        circles["prime_circle_diameter"] = 2 * (cam.base_radius + cam.radius)
    return circles


K = TypeVar("K", bound=DiskKeys)
T = TypeVar("T", bound="DiskCam")


class DiskKind(Turned[K, T]):
    """A kind whose thing is a disk cam and nothing else."""

    def body(self, keys: K, thing: T) -> WheelShape:
        """By the keys."""
        return shape_of(keys)

    def holes(self, keys: K, thing: T) -> HubHoles:
        """Within the base circle."""
        return marked_holes(keys, thing)

    def inside(self, thing: T) -> float:
        """The lowest follower's circle."""
        return inner_radius(thing)

    def outline(self, thing: T, offset: float) -> tuple[Profile, tuple[object, ...]]:
        """The profile."""
        from geometry.cams.plane.shape import cam_shape

        shape = cam_shape(thing, offset)
        return shape.profile, shape.gaps

    def pitch_curve(self, keys: K, thing: T) -> Profile | None:
        """The profile, moved out by the follower's radius."""
        return self.outline(thing, thing.radius)[0] if thing.radius > 0 else None

    def probes(self, keys: K, thing: T) -> tuple[Probe, ...]:
        """The follower, rolled over every file."""
        from parts.cams.probes import TurningProbe

        return (TurningProbe(thing, self.middle(keys, thing)),)


# rollers are kept below this share of the least convex radius of the pitch curve
USUAL_ROLLER_SHARE = 0.8
# cam angles at which the greatest radius is looked for: off by a part in a million
_SAMPLES = 3601


def largest_roller_radius(cam: DiskCam, least_curvature_radius: float) -> float:
    """The largest roller for the pitch curve, mm: by the usual share, and so that the cam keeps a convex radius.

    0 where no roller leaves that radius.
    """
    from geometry.cams.plane.synthesis import least_pitch_radius

    pitch = least_pitch_radius(cam)
    return max(0.0, min(USUAL_ROLLER_SHARE * pitch, pitch - least_curvature_radius))


def pressure_angles(cam: DiskCam) -> dict[str, float]:
    """The greatest pressure angles of rise and return, degrees, where there are such."""
    from geometry.cams.motion.follower_motion import PhaseKind
    from geometry.cams.plane.synthesis import greatest_pressure_angle

    return {
        f"pressure_angle_{name}_deg": math.degrees(greatest_pressure_angle(cam, kind).value)
        for kind, name in ((PhaseKind.RISE, "rise"), (PhaseKind.RETURN, "return"))
        if cam.motion.moving_pieces(kind)
    }


def motion_findings(motion: FollowerMotion, *, swings: bool) -> list[Finding]:
    """What a motion does that its phases or rows do not tell: impacts, and lifts beyond all of them."""
    return [*_impacts(motion, swings=swings), *_overshoot(motion, swings=swings)]


def _overshoot(motion: FollowerMotion, *, swings: bool) -> Iterator[Finding]:
    """How far the motion goes beyond all ends of its pieces, in mm or degrees, and where, degrees."""
    ends = [float(piece.value(piece.start, 0)) for piece in motion.pieces]
    middle = (max(ends) + min(ends)) / 2
    places = [float(at) for piece in motion.pieces for at in piece.extremes(0)]
    far = max(places, key=lambda at: abs(float(motion.value(at)) - middle))
    beyond = abs(float(motion.value(far)) - middle) - (max(ends) - middle)
    if beyond > _TOLD_OVERSHOOT * motion.lift:
        unit, code = (math.degrees(1.0), "swing_overshoots") if swings else (1.0, "lift_overshoots")
        yield Finding(code, beyond * unit, math.degrees(far))


def _impacts(motion: FollowerMotion, *, swings: bool) -> list[Finding]:
    """The greatest rigid and the greatest soft impact of a motion, in mm or degrees, with its cam angle, degrees."""
    code, unit = ("swung_{}_impact", math.degrees(1.0)) if swings else ("{}_impact", 1.0)
    found = []
    for impact, order in (("rigid", 1), ("soft", 2)):
        jumps = [(abs(j.jumps[order]) * unit, math.degrees(j.angle)) for j in motion.impacts() if j.impact == impact]
        if jumps:
            found.append(Finding(code.format(impact), *max(jumps)))
    return found


def cam_quantities(spec: CamSpec, cam: DiskCam) -> dict[str, float]:
    """Named results of a cam: sizes in mm, angles in degrees."""
    from geometry.cams.plane.synthesis import least_convex_radius

    found = stroke_quantity(cam.motion.lift, swings=cam.swings)
    if cam.swings:
        found["start_angle_deg"] = math.degrees(cam.swing.start_angle)
    found |= table_quantities(cam.motion, swings=cam.swings)
    if cam.radius > 0:
        found["follower_radius"] = cam.radius
    if spec.oscillating is None and not cam.is_flat:
        found["follower_offset"] = spec.follower_offset
    found |= pressure_angles(cam)
    found["least_curvature_radius"] = least_convex_radius(cam).value
    if cam.kind == "roller":
        found["largest_roller_radius"] = largest_roller_radius(cam, spec.least_curvature_radius)
    if cam.kind in ("flat", "mushroom"):
        found["face_from"], found["face_to"] = cam.face_reach()
        if spec.oscillating is None:
            found["least_plate_diameter"] = cam.least_plate_diameter()
    return found


def cam_findings(spec: CamSpec, cam: DiskCam) -> tuple[Finding, ...]:
    """Impacts, steep pressure angles and large rollers of a cam."""
    from geometry.cams.motion.follower_motion import PhaseKind
    from geometry.cams.plane.synthesis import greatest_pressure_angle, least_convex_radius

    found = []
    if all(piece.is_constant for piece in cam.motion.pieces):
        found.append(Finding("never_moves", 0.0, spec.lift or spec.swing_deg))
    swings = spec.oscillating is not None
    found += motion_findings(cam.motion, swings=swings)
    steepest = math.degrees(greatest_pressure_angle(cam, PhaseKind.RISE).value)
    found += steep(steepest, USUAL_PRESSURE_ANGLE[swings])
    back = math.degrees(greatest_pressure_angle(cam, PhaseKind.RETURN).value)
    asked, told = spec.least_transmission_angle_deg, spec.least_return_transmission_angle_deg
    # a swinging follower's is kept both ways, a sliding one's on the rise, unless the return has its own
    worst = max(steepest, back) if swings and told is None else steepest
    found += (*not_kept("", asked, worst), *not_kept("return_", told, back))
    pitch = least_convex_radius(cam).value + cam.radius
    if cam.kind == "roller":
        found += beyond("large_roller", cam.radius, USUAL_ROLLER_SHARE * pitch)
    if spec.oscillating is None and cam.is_flat and spec.follower_offset != 0:
        found.append(Finding("flat_offset", spec.follower_offset, cam.least_plate_diameter()))
    if swings and (within := greatest_radius(cam) - cam.swing.centre_distance) > 0:
        found.append(Finding("pivot_within_cam", within, cam.swing.centre_distance))
    if pitch - cam.radius < (least := spec.least_curvature_radius) * (1 - 1e-6):
        found.append(Finding("curvature_radius_not_kept", pitch - cam.radius, least))
    return tuple(found)


def not_kept(way: str, least: float | None, steepest: float) -> tuple[Finding, ...]:
    """The remark that a base circle does not keep a transmission angle; ``way``: of the return or "", degrees."""
    if least is None or 90 - steepest >= least - _KEPT_DEG:
        return ()
    return (Finding(f"{way}transmission_angle_not_kept", 90 - steepest, least),)


def greatest_radius(cam: DiskCam) -> float:
    """Greatest distance of the profile from the axis, mm."""
    import numpy as np

    return float(np.abs(cam.profile_point(np.linspace(0, 2 * math.pi, _SAMPLES))).max())


class Cam(DiskKind[CamSpec, "DiskCam"]):
    """A disk cam."""

    name, keys = "cam", CamSpec
    data_table = "parts.cams.data_tables"
    sheet_shown = "cam", N_("diagrams and profile of the cam, DXF and SVG")

    def idle(self, keys: CamSpec, others: Others) -> Iterator[ParameterError]:
        """Angles of a flat face, which pushes along its normal, where they give no base circle; what others have."""
        if keys.follower == "flat" and keys.base_circle_radius is not None:
            names = "least_transmission_angle_deg", "least_return_transmission_angle_deg"
            yield from in_vain(keys, names, other='follower = "roller"')
        yield from idle_motion(keys, keys.oscillating is not None)
        yield from idle_follower(keys)
        yield from idle_plate(keys, plain=keys.oscillating is None)

    def thing(self, keys: CamSpec, others: Others) -> DiskCam:
        """The cam, checked to move its follower all the way: an undercut one is told a large enough base circle."""
        from geometry.cams.plane.undercut import lost_to_undercut

        check_idle(self.idle(keys, others))
        cam, base, least = cam_of(keys), keys.base_circle_radius, 0.0
        if cam.is_flat and not cam.swings and base is not None:
            from geometry.cams.plane.synthesis import flat_base_radius

            least = flat_base_radius(cam.motion).value
        lost, hollow = lost_to_undercut(cam), base is not None and base < least * (1 + _SPARE)
        if lost is not None or hollow:
            if (refusal := by_impact(keys, cam.motion, _fits, swings=cam.swings, both=False)) is not None:
                raise refusal
            base = cam.base_radius if base is None else base
            if hollow and lost is None:
                cure = limit(least * (1 + _SPARE), base)
                raise UndercutError("base_circle_radius", base, "undercut_hollow", cure, radius=base - least)
            assert lost is not None
            larger = partial(nearest_key, keys, "base_circle_radius", base, larger_bases(base, cam), _fits)
            raise undercut(
                cam, "base_circle_radius", base, lost, limit(least * (1 + _SPARE), base) if hollow else larger
            )
        check_face(keys, cam)
        check_disk(keys, cam)
        return cam

    def report(self, keys: CamSpec, thing: DiskCam) -> Report:
        """Impacts, pressure angles, curvature."""
        return Report(cam_findings(keys, thing), cam_circles(thing), cam_quantities(keys, thing))


CAM = Cam()
