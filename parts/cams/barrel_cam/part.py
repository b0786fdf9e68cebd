"""The part kind ``barrel_cam``: a cylindrical cam with a groove, or with its track on the end of a tube."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from geometry.base.errors import LateError, Nearest, OffsetError, ParameterError, UndercutError, limit, rounded
from geometry.base.findings import Finding, beyond
from geometry.base.nearest import last_that_holds
from geometry.base.record import replace
from geometry.plane.offset_region import OffsetRegion
from geometry.solids.hub_holes import least_wall
from parts.base.kind import Kind, Others, Report
from parts.base.schema import nearest_key, replaced
from parts.cams.barrel_cam.roller import (
    INSIDE,
    check_cone,
    end_height,
    guides,
    kept_apex,
    largest_radius,
    moved_cam,
    takes_a_roller,
    taper,
    thinnest,
)
from parts.cams.disk_cam.part import motion_findings
from parts.keys.barrel import BarrelCamSpec, SwingingTable
from parts.keys.base import check_idle, in_vain
from parts.keys.cam import (
    LAW_AT_REST,
    USUAL_PRESSURE_ANGLE,
    idle_motion,
    motion_of,
    rough_law,
    steep,
    stroke_quantity,
    table_quantities,
)
from parts.keys.holes import bore_of, check_shape, holes_of, wide_bore

if TYPE_CHECKING:
    from geometry.cams.barrel.body import BarrelBody
    from geometry.cams.barrel.cam import BarrelCam, Guide
    from geometry.cams.motion.follower_motion import FollowerMotion
    from geometry.solids.faced import FacedBody
    from parts.base.readback import Probe

# rollers are kept below this share of the one that undercuts
_USUAL_ROLLER_SHARE = 0.8
# a roller in its diameters: no end mill reaches farther, and what proves the walls goes by pieces as small as it
_SLENDER = 10
# an arm stays this far from the cam's axis, degrees
_STEEPEST = 89.0
# shares of a swing or an arm that are tried
_SMALLER = (0.9, 0.75, 0.5, 0.25, 0.1, 0.03, 0.01, 0.001)


def _idle(keys: BarrelCamSpec) -> Iterator[ParameterError]:
    """What is of another motion, form or roller."""
    yield from idle_motion(keys, keys.oscillating is not None)
    if keys.form == "groove":
        yield from in_vain(keys, ("web_thickness",), "for_end_only")
    else:
        yield from in_vain(keys, ("clearance",), "end_without_play")
    if keys.roller_form == "cylindrical":
        yield from in_vain(keys, ("cone_angle_deg",), "for_conical_only")


def _check_keys(keys: BarrelCamSpec) -> None:
    """Keys that exclude each other."""
    check_idle(_idle(keys))
    bore_of(keys)
    if keys.length is not None and keys.end_margin is not None:
        raise ParameterError("end_margin", keys.end_margin, "follows_from", Nearest(None), key="length")


def _motion(keys: BarrelCamSpec) -> FollowerMotion:
    motion = motion_of(keys, keys.oscillating is not None)
    if not (jumps := _jumps(motion)):
        return motion

    def calm(key: str) -> bool:
        return not _jumps(motion_of(replaced(keys, key, LAW_AT_REST), keys.oscillating is not None))

    code, rough = "velocity_jumps_in_groove", rough_law(keys.phases or [], motion.phases, calm)
    if rough is None:
        raise ParameterError("phases", None, code, at=jumps[0])
    cure = rough.cure(lambda law: _is_guided(replaced(keys, rough.key, law)))
    raise ParameterError(rough.key, rough.law, code, cure, at=jumps[0])


def _jumps(motion: FollowerMotion) -> list[float]:
    """Cam angles at which the velocity jumps, degrees."""
    return [math.degrees(j.angle) for j in motion.impacts() if j.impact == "rigid"]


def _cam_of(keys: BarrelCamSpec) -> BarrelCam:
    """The cam with its guide at the height that leaves the margins, not yet checked for undercut."""
    from geometry.cams.barrel.cam import AxialGuide, BarrelCam, SwingGuide

    motion, table, outer = _motion(keys), keys.oscillating, keys.outer_diameter / 2
    if keys.groove_depth > _SLENDER * keys.roller_diameter:
        works = limit(keys.groove_depth / _SLENDER, keys.roller_diameter)
        raise ParameterError("roller_diameter", keys.roller_diameter, "roller_too_slender", works, most=_SLENDER)
    radius, inner = (keys.roller_diameter + keys.clearance) / 2, keys.outer_diameter / 2 - keys.groove_depth
    guide: Guide
    if table is None:
        guide = AxialGuide(0.0)
    else:
        low, high = motion.extremes()
        start = -(low + high) / 2 if table.start_angle_deg is None else math.radians(table.start_angle_deg)
        if not max(abs(start + low), abs(start + high)) < math.radians(_STEEPEST):
            raise _along_axis(keys, table, math.degrees(low), math.degrees(high))
        flat = 1.0 if (start + low) * (start + high) < 0 else max(math.cos(start + low), math.cos(start + high))
        least = min(math.cos(start + low), math.cos(start + high))
        offset = table.arm_length * (flat + least) / 2 if table.pivot_offset is None else table.pivot_offset
        guide = SwingGuide(offset, 0.0, table.arm_length, start)
    cam = BarrelCam(motion, guide, radius, outer, inner, keys.form == "groove", taper(keys, radius), outer)
    stray = max(map(abs, cam.side_range()))
    if not stray + radius < INSIDE * inner:
        room = outer - (stray + radius) / INSIDE
        if table is not None and room <= 0 and stray > radius:
            raise _straying(keys, table, stray, INSIDE * inner - radius)
        if room <= 0:
            most = limit((2 * (stray + radius) / INSIDE + 2 * keys.groove_depth) * (1 + 1e-9), keys.outer_diameter)
            raise ParameterError("outer_diameter", keys.outer_diameter, "roller_too_big", most)
        ends = [room * share for share in (1 - 1e-9, *_SMALLER)]
        cure = partial(nearest_key, keys, "groove_depth", keys.groove_depth, ends, _is_guided)
        raise ParameterError("groove_depth", keys.groove_depth, "floor_too_narrow", cure)
    check_cone(keys, cam, stray)
    return _raised(keys, cam)


def _along_axis(keys: BarrelCamSpec, table: SwingingTable, low: float, high: float) -> ParameterError:
    """The refusal of an arm that turns along the cam's axis; lowest and highest S, degrees."""
    given = table.start_angle_deg
    if given is None:
        most = limit(2 * _STEEPEST * (1 - 1e-9), keys.swing_deg) if keys.motion_table is None else None
        return ParameterError("swing_deg", keys.swing_deg, "arm_along_axis", most)
    least, most_angle = -_STEEPEST - low, _STEEPEST - high
    works = limit((most_angle - 1e-6 if given >= most_angle else least + 1e-6), given) if least < most_angle else None
    return ParameterError("oscillating.start_angle_deg", given, "arm_along_axis", works)


def _straying(keys: BarrelCamSpec, table: SwingingTable, stray: float, room: float) -> ParameterError:
    """The refusal of a roller that its arm carries past the side of the barrel; ``room``: for its centre, mm."""
    key = "arm_length" if table.pivot_offset is None else "pivot_offset"
    given: float = getattr(table, key)
    # half the way between the ends of the swing
    middle = table.arm_length * (1 + math.cos(math.radians(keys.swing_deg / 2))) / 2
    if key == "pivot_offset":
        bad, ends = given, [middle]
    else:
        # how far it strays grows with the arm
        bad = given * room / stray
        ends = [bad * share for share in (1 - 1e-6, *_SMALLER)]
    place = f"oscillating.{key}"
    cure = partial(nearest_key, keys, place, bad, ends, _cam_of)
    return ParameterError(place, given, "roller_strays", cure, stray=stray)


def _raised(keys: BarrelCamSpec, cam: BarrelCam) -> BarrelCam:
    """The cam with its roller so high that the groove has its margins."""
    low, high = cam.height_range()
    reach = high - low + 2 * cam.radius if cam.is_groove else high - low
    margin = keys.roller_diameter / 2 if keys.end_margin is None else keys.end_margin
    if keys.length is not None:
        sides = 2 if cam.is_groove else 1
        margin = (keys.length - reach) / sides
        wall = least_wall(cam.outer)
        if not margin >= wall:
            raise ParameterError("length", keys.length, "groove_needs_length", limit(reach + sides * wall, keys.length))
    return replace(cam, guide=cam.guide.raised(margin + cam.radius - low))


def _is_guided(keys: BarrelCamSpec) -> bool:
    from geometry.cams.barrel.cam import LEAST_SPEED

    return _cam_of(keys).least_edge_speed()[0] >= LEAST_SPEED


def _check_roller(keys: BarrelCamSpec, cam: BarrelCam) -> None:
    """The roller is small enough for every bend of its way."""
    from geometry.cams.barrel.cam import LEAST_SPEED

    speed, angle = cam.least_edge_speed()
    if speed >= LEAST_SPEED:
        return
    code = "wall_undercut" if takes_a_roller(cam, kept_apex(keys)) else "roller_outruns_surface"
    raise LateError(code, partial(_undercut, keys, cam, code, math.degrees(angle)))


def _undercut(keys: BarrelCamSpec, cam: BarrelCam, code: str, at: float) -> ParameterError:
    """The refusal of a cam whose walls are undercut at a cam angle, degrees."""
    play = keys.clearance
    if code == "wall_undercut":
        most, given = 2 * largest_radius(cam, kept_apex(keys)) * (1 - 1e-6), keys.roller_diameter
        if most > 1.01 * play and rounded(most - play, up=False) > 0:
            return UndercutError("roller_diameter", given, code, limit(most - play, given), at=at)
        return UndercutError("clearance", play, code, at=at)
    if not keys.swing_deg:
        return UndercutError("motion_table", None, code, at=at)
    ends = [keys.swing_deg * share for share in _SMALLER]
    cure = partial(nearest_key, keys, "swing_deg", keys.swing_deg, ends, _is_guided)
    return UndercutError("swing_deg", keys.swing_deg, code, cure, at=at)


def _body_of(keys: BarrelCamSpec, cam: BarrelCam) -> BarrelBody:
    from geometry.cams.barrel.body import BarrelBody

    check_shape(keys, holes_of, cam.inner)
    low, high = cam.height_range()
    margin = low - cam.radius
    length = high + cam.radius + margin if cam.is_groove else end_height(cam)
    bores = holes_of(keys).profiles(0.0)
    hub = None if keys.hub is None else (keys.hub.diameter / 2, keys.hub.below, keys.hub.above)
    return BarrelBody(cam, length, bores[0] if bores else None, hub, keys.web_thickness)


def _check_hub(keys: BarrelCamSpec, body: BarrelBody) -> None:
    """Bore, hub and web fit each other and the barrel."""
    cam, reach, wall = body.cam, holes_of(keys).bore_reach, least_wall(body.cam.outer)
    if reach > 0 and not reach + wall <= cam.inner:
        raise _wide(keys, reach, cam.inner - wall, "no_wall_to_floor")
    low = cam.height_range()[0] - cam.radius
    needy = next((name for name in ("bore_diameter", "bore", "hub") if getattr(keys, name)), None)
    if not cam.is_groove and body.web == 0 and needy:
        half = Nearest(rounded(low / 2, up=False))
        raise ParameterError("web_thickness", body.web, "bottom_missing", half, key=needy)
    if body.web > 0 and not body.web + wall <= low:
        raise ParameterError("web_thickness", body.web, "web_reaches_track", limit(low - wall, body.web))
    if keys.hub is None:
        return
    # inside a tube the hub stands within its inner cylinder
    hub, most = keys.hub.diameter, 2 * ((cam.inner if not cam.is_groove and keys.hub.above > 0 else cam.outer) - wall)
    if not 2 * (reach + wall) <= most:
        raise _wide(keys, reach, most / 2 - wall, "no_room_for_hub")
    if not hub <= most:
        raise ParameterError("hub.diameter", hub, "hub_beyond_barrel", limit(most, hub))
    if not hub >= 2 * (reach + wall):
        raise ParameterError("hub.diameter", hub, "no_wall_around_bore", limit(2 * (reach + wall), hub))


def _wide(keys: BarrelCamSpec, reach: float, inside: float, code: str) -> ParameterError:
    """The refusal of a bore that may reach so far, mm."""
    if keys.bore_diameter > 0:
        return ParameterError("bore_diameter", 2 * reach, code, limit(2 * inside, 2 * reach))
    return wide_bore(keys, inside, code)


def _moved(keys: BarrelCamSpec, body: BarrelBody, offset: float) -> BarrelBody:
    """The solid with every boundary but its end faces moved out of the material."""
    if offset == 0:
        return body
    cam = body.cam
    moved = moved_cam(cam, offset)
    most = thinnest(cam) * cam.upright
    if not offset < most:
        raise OffsetError(offset, "groove_closed", most * (1 - 1e-9))
    wall = least_wall(cam.outer)
    thin = (cam.outer - cam.inner - wall) / 2
    if not cam.is_groove and not offset > -thin:
        raise OffsetError(offset, "leaves_no_wall", -thin * (1 - 1e-9))
    if offset < 0 and not guides(moved):
        raise OffsetError(
            offset, "walls_undercut", last_that_holds(lambda moved: guides(moved_cam(cam, moved)), offset)
        )
    bores = holes_of(keys).profiles(offset)
    bore_reach = holes_of(keys).bore_reach
    if bores and not bore_reach - offset + wall <= moved.inner:
        raise OffsetError(offset, "no_wall_to_floor", (bore_reach + wall - cam.inner) / 2 * (1 - 1e-9))
    hub = None if body.hub is None else (body.hub[0] + offset, *body.hub[1:])
    return replace(body, cam=moved, bore=bores[0] if bores else None, hub=hub)


def _quantities(keys: BarrelCamSpec, body: BarrelBody) -> dict[str, float]:
    from geometry.cams.barrel.cam import SwingGuide
    from geometry.cams.barrel.sliding import cam_sliding
    from geometry.cams.motion.follower_motion import PhaseKind

    cam = body.cam
    found = {
        "outer_diameter": 2 * cam.outer,
        "floor_diameter" if cam.is_groove else "inner_diameter": 2 * cam.inner,
        "length": body.length,
        "roller_diameter": keys.roller_diameter,
    }
    if cam.is_groove:
        found["groove_width"] = 2 * cam.radius
    if cam.taper:
        found["cone_angle_deg"] = math.degrees(2 * math.atan(cam.taper))
        found["roller_floor_diameter"] = keys.roller_diameter - 2 * cam.taper * (cam.outer - cam.inner)
    found["roller_sliding"] = cam_sliding(cam)
    found |= stroke_quantity(cam.motion.lift, swings=isinstance(cam.guide, SwingGuide))
    if isinstance(cam.guide, SwingGuide):
        found["arm_length"] = cam.guide.arm_length
        found["pivot_offset"] = cam.guide.pivot_offset
        found["pivot_height"] = cam.guide.pivot_height
        found["start_inclination_deg"] = math.degrees(cam.guide.start_angle)
    found |= table_quantities(cam.motion, swings=isinstance(cam.guide, SwingGuide))
    found["start_height"] = float(cam.place(0.0, 0)[0].imag)
    for kind in (PhaseKind.RISE, PhaseKind.RETURN):
        if cam.motion.moving_pieces(kind):
            name = f"pressure_angle_{'rise' if kind is PhaseKind.RISE else 'return'}_deg"
            found[name] = math.degrees(cam.greatest_pressure_angle(kind)[0])
    found["largest_roller_diameter"] = 2 * largest_radius(cam, kept_apex(keys)) - keys.clearance
    return found


def _findings(keys: BarrelCamSpec, cam: BarrelCam) -> tuple[Finding, ...]:
    from geometry.cams.motion.follower_motion import PhaseKind

    swings = keys.oscillating is not None
    found = motion_findings(cam.motion, swings=swings)
    usual = USUAL_PRESSURE_ANGLE[swings]
    # a groove pushes both ways, a spring takes the return of an end cam
    kinds = (PhaseKind.RISE, PhaseKind.RETURN) if cam.is_groove else (PhaseKind.RISE,)
    steepest = math.degrees(max(cam.greatest_pressure_angle(kind)[0] for kind in kinds))
    found += steep(steepest, usual, "steep_groove" if cam.is_groove else "steep_track")
    limit = _USUAL_ROLLER_SHARE * largest_radius(cam, kept_apex(keys))
    return (*found, *beyond("large_groove_roller", cam.radius, limit))


class Barrel(Kind[BarrelCamSpec, "BarrelBody"]):
    """A cylindrical cam; its flat outline is the development of its outer cylinder."""

    name, keys = "barrel_cam", BarrelCamSpec
    drawing = "parts.cams.barrel_cam.drawing"
    data_table = "parts.cams.data_tables"

    def idle(self, keys: BarrelCamSpec, others: Others) -> Iterator[ParameterError]:
        """What is of another motion, form or roller."""
        return _idle(keys)

    def thing(self, keys: BarrelCamSpec, others: Others) -> BarrelBody:
        """The solid, checked to guide its roller all the way."""
        _check_keys(keys)
        cam = _cam_of(keys)
        _check_roller(keys, cam)
        body = _body_of(keys, cam)
        _check_hub(keys, body)
        return body

    def section(self, keys: BarrelCamSpec, thing: BarrelBody, offset: float) -> OffsetRegion:
        """The jackets of the outer cylinder, unrolled."""
        from geometry.cams.barrel.development import development

        return development(thing.cam, thing.length, offset)

    def solid(self, keys: BarrelCamSpec, thing: BarrelBody, offset: float) -> FacedBody:
        """The barrel by its faces: its walls are no plane's."""
        from geometry.cams.barrel.faces import barrel_faces

        return barrel_faces(_moved(keys, thing, offset))

    def height(self, keys: BarrelCamSpec, thing: BarrelBody) -> float:
        """The barrel's length."""
        return thing.length

    def is_plate(self, keys: BarrelCamSpec, thing: BarrelBody) -> bool:
        """Its flat outline is no section of it."""
        return False

    def report(self, keys: BarrelCamSpec, thing: BarrelBody) -> Report:
        """Sizes, pressure angles, the largest roller."""
        unrolled = (Finding("development", 2 * math.pi * thing.cam.outer, 2 * thing.cam.outer),)
        found = _findings(keys, thing.cam)
        return Report(found, quantities=_quantities(keys, thing), flat_findings=unrolled)

    def probes(self, keys: BarrelCamSpec, thing: BarrelBody) -> tuple[Probe, ...]:
        """The roller, put into the groove of every mesh and rolled along every flat outline."""
        from parts.cams.barrel_cam.probe import GrooveRoller

        roller = self.report(keys, thing).quantities["roller_diameter"]
        return (GrooveRoller(lambda offset: _moved(keys, thing, offset), roller),)


BARREL_CAM = Barrel()
