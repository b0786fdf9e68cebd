"""The part kind ``barrel_cam``: a cylindrical cam with a groove, or with its track on the end of a tube."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from geometry.errors import OffsetError, ParameterError, UndercutError, at_least, at_most
from geometry.findings import Finding
from geometry.hub_holes import HubHoles, least_wall
from geometry.trial import is_trial
from parts.barrel_keys import BarrelCamSpec, SwingingTable
from parts.barrel_roller import (
    INSIDE,
    check_cone,
    end_height,
    guides,
    kept_apex,
    largest_radius,
    least_offset,
    moved_cam,
    taper,
    thinnest,
    told,
)
from parts.cam_keys import check_stroke, in_degrees, motion_of
from parts.hole_keys import RoundBoreTable, hub_holes
from parts.materials import density_of
from parts.part import Part

if TYPE_CHECKING:
    from geometry.cams.barrel import BarrelCam, Guide
    from geometry.cams.barrel_body import BarrelBody
    from geometry.cams.follower_motion import FollowerMotion

# usual limits of the pressure angle: translating 30, swinging 45 degrees (practicum: 30 to 35, 40 to 50)
_USUAL_PRESSURE_ANGLE = {False: 30.0, True: 45.0}
# rollers are kept below this share of the one that undercuts
_USUAL_ROLLER_SHARE = 0.8


def checked_barrel_cam(spec: BarrelCamSpec) -> BarrelBody:
    """The solid of a part, checked to exist and to guide its roller all the way.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    _check_keys(spec)
    motion = _motion(spec)
    inner = spec.outer_diameter / 2 - spec.groove_depth
    radius = (spec.roller_diameter + spec.clearance) / 2
    cam = _placed(spec, motion, radius, inner)
    _check_roller(spec, cam)
    body = _body_of(spec, cam)
    _check_hub(spec, body)
    return body


def barrel_cam_part(part_id: str, spec: BarrelCamSpec, body: BarrelBody) -> Part:
    """The part of a cylindrical cam; its flat outline is the development of its outer cylinder."""
    from geometry.cams.development import development

    return Part(
        part_id,
        "barrel_cam",
        lru_cache(maxsize=8)(lambda offset: development(body.cam, body.length, offset)),
        lru_cache(maxsize=4)(lambda offset: _moved(spec, body, offset)),
        body.length,
        True,
        _findings(spec, body.cam),
        {},
        _quantities(spec, body),
        spec.material,
        spec.colour,
        spec.density or density_of(spec.material),
        flat_findings=(Finding("development", 2 * math.pi * body.cam.outer, 2 * body.cam.outer),),
        barrel=body,
    )


def _check_keys(spec: BarrelCamSpec) -> None:
    """Keys that exclude each other."""
    check_stroke(spec, spec.oscillating is not None)
    if spec.bore is not None and spec.bore_diameter > 0:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    if spec.length is not None and spec.end_margin is not None:
        raise ParameterError("end_margin", spec.end_margin, "follows from length; give only one of them")
    if spec.form == "groove" and spec.web_thickness > 0:
        raise ParameterError("web_thickness", spec.web_thickness, 'is for form = "end" only; 0 works')
    if spec.roller_form == "cylindrical" and spec.cone_angle_deg is not None:
        raise ParameterError("cone_angle_deg", spec.cone_angle_deg, 'is for roller_form = "conical" only')
    if spec.form == "end" and spec.clearance > 0:
        raise ParameterError("clearance", spec.clearance, "a roller on an end has no play; 0 works")


def _motion(spec: BarrelCamSpec) -> FollowerMotion:
    scale = math.radians(1.0) if spec.oscillating else 1.0
    table = None if spec.motion_table is None else [(a, s * scale) for a, s in spec.motion_table]
    lift = math.radians(spec.swing_deg) if spec.oscillating else spec.lift
    key = "swing_deg" if spec.oscillating else "lift"
    try:
        motion = motion_of(spec.phases, table, lift, key)
    except ParameterError as refusal:
        value = in_degrees(refusal.value) if refusal.name == key and spec.oscillating else refusal.value
        raise ParameterError(refusal.name, value, refusal.allowed) from refusal
    rigid = [j for j in motion.impacts() if j.impact == "rigid"]
    if rigid:
        at = math.degrees(rigid[0].angle)
        remedy = "the groove would have a corner that no roller follows; sine or polynomial_345 works"
        raise ParameterError("phases", None, f"the velocity jumps at cam angle {at:.6g} degrees: {remedy}")
    return motion


def _placed(spec: BarrelCamSpec, motion: FollowerMotion, radius: float, inner: float) -> BarrelCam:
    """The cam with its guide at the height that leaves the margins."""
    from geometry.cams.barrel import AxialGuide, BarrelCam, SwingGuide

    outer = spec.outer_diameter / 2
    table = spec.oscillating
    guide: Guide
    if table is None:
        guide = AxialGuide(0.0)
    else:
        low, high = motion.extremes()
        start = -(low + high) / 2 if table.start_angle_deg is None else math.radians(table.start_angle_deg)
        if not max(abs(start + low), abs(start + high)) < math.radians(89):
            value = spec.swing_deg if table.start_angle_deg is None else table.start_angle_deg
            key = "swing_deg" if table.start_angle_deg is None else "oscillating.start_angle_deg"
            raise ParameterError(key, value, "turns the arm along the cam's axis; a smaller one works")
        flat = 1.0 if (start + low) * (start + high) < 0 else max(math.cos(start + low), math.cos(start + high))
        least = min(math.cos(start + low), math.cos(start + high))
        offset = table.arm_length * (flat + least) / 2 if table.pivot_offset is None else table.pivot_offset
        guide = SwingGuide(offset, 0.0, table.arm_length, start)
    cam = BarrelCam(motion, guide, radius, outer, inner, spec.form == "groove", taper(spec, radius), outer)
    stray = max(map(abs, cam.side_range()))
    if not stray + radius < INSIDE * inner:
        room = outer - (stray + radius) / INSIDE
        if table is not None and room <= 0 and stray > radius:
            raise _straying(spec, table, stray)
        if room <= 0:
            least_diameter = at_least(2 * (stray + radius) / INSIDE + 2 * spec.groove_depth, 3)
            raise ParameterError(
                "outer_diameter", spec.outer_diameter, f"the roller is too big for it; {least_diameter} mm works"
            )
        remedy = f"the roller needs a wider floor; at most {told(room * (1 - 1e-9))} mm works"
        raise ParameterError("groove_depth", spec.groove_depth, remedy)
    check_cone(spec, cam, stray)
    return _raised(spec, cam)


def _straying(spec: BarrelCamSpec, table: SwingingTable, stray: float) -> ParameterError:
    """The refusal of a roller that its arm carries past the side of the barrel."""
    reason = f"the roller strays {stray:.6g} mm from the cam's axis, past its side"
    if table.pivot_offset is not None:
        middle = table.arm_length * (1 + math.cos(math.radians(spec.swing_deg / 2))) / 2
        return ParameterError("oscillating.pivot_offset", table.pivot_offset, f"{reason}; {middle:.4f} mm works")
    # of a swing to both sides the stray goes with its square
    works = table.arm_length * (spec.outer_diameter / 2 - spec.groove_depth) / stray * INSIDE / 2
    return ParameterError("oscillating.arm_length", table.arm_length, f"{reason}; at most {told(works)} mm works")


def _raised(spec: BarrelCamSpec, cam: BarrelCam) -> BarrelCam:
    """The cam with its roller so high that the groove has its margins."""
    low, high = cam.height_range()
    reach = high - low + 2 * cam.radius if cam.is_groove else high - low
    margin = spec.roller_diameter / 2 if spec.end_margin is None else spec.end_margin
    if spec.length is not None:
        margin = (spec.length - reach) / (2 if cam.is_groove else 1)
        wall = least_wall(cam.outer)
        if not margin >= wall:
            least = at_least(reach + (2 if cam.is_groove else 1) * wall, 4)
            raise ParameterError("length", spec.length, f"the groove needs more; at least {least} mm works")
    return replace(cam, guide=cam.guide.raised(margin + cam.radius - low))


def _check_roller(spec: BarrelCamSpec, cam: BarrelCam) -> None:
    """The roller is small enough for every bend of its way."""
    from geometry.cams.barrel import LEAST_SPEED

    speed, at = cam.least_edge_speed()
    if speed >= LEAST_SPEED:
        return
    where = f"undercuts the wall at cam angle {math.degrees(at):.4g} degrees"
    if is_trial():
        raise UndercutError("roller_diameter", spec.roller_diameter, where)
    most = 2 * largest_radius(cam, kept_apex(spec)) * (1 - 1e-6)
    if most > 1.01 * spec.clearance and float(told(most - spec.clearance)) > 0:
        remedy = f"{where}; at most {told(most - spec.clearance)} mm works"
        raise UndercutError("roller_diameter", spec.roller_diameter, remedy)
    if most > 0 and spec.clearance > 0:
        raise UndercutError("clearance", spec.clearance, f"{where}; 0 works with a small roller")
    outruns = f"the roller outruns the cam's surface and {where}"
    if not spec.swing_deg:
        raise UndercutError("motion_table", None, f"{outruns}; a smaller swing works")
    works = next((v for v in (spec.swing_deg * 0.9**k for k in range(1, 60)) if _swings(spec, cam, v)), 0.0)
    text = f"at most {told(works)} degrees works" if works else "a shorter arm_length or longer phases work"
    raise UndercutError("swing_deg", spec.swing_deg, f"{outruns}; {text}")


def _swings(spec: BarrelCamSpec, cam: BarrelCam, swing_deg: float) -> bool:
    """Whether the roller goes its way with another swing."""
    from msgspec.structs import replace as changed

    from geometry.cams.barrel import LEAST_SPEED

    other = changed(spec, swing_deg=float(told(swing_deg)))
    try:
        return _placed(other, _motion(other), cam.radius, cam.inner).least_edge_speed()[0] >= LEAST_SPEED
    except ParameterError:
        return False


def _holes_of(spec: BarrelCamSpec) -> HubHoles:
    return hub_holes(RoundBoreTable(spec.bore_diameter) if spec.bore_diameter > 0 else spec.bore, None, None)


def _body_of(spec: BarrelCamSpec, cam: BarrelCam) -> BarrelBody:
    from geometry.cams.barrel_body import BarrelBody

    low, high = cam.height_range()
    margin = low - cam.radius
    length = high + cam.radius + margin if cam.is_groove else end_height(cam)
    bores = _holes_of(spec).profiles(0.0)
    hub = None if spec.hub is None else (spec.hub.diameter / 2, spec.hub.below, spec.hub.above)
    return BarrelBody(cam, length, bores[0] if bores else None, hub, spec.web_thickness)


def _check_hub(spec: BarrelCamSpec, body: BarrelBody) -> None:
    """Bore, hub and web fit each other and the barrel."""
    cam, reach, wall = body.cam, _holes_of(spec).bore_reach, least_wall(body.cam.outer)
    key = "bore_diameter" if spec.bore_diameter > 0 else "bore.diameter"
    if reach > 0 and not reach + wall <= cam.inner:
        remedy = f"leaves no wall to the floor; at most {at_most(2 * (cam.inner - wall), 4)} mm works"
        raise ParameterError(key, 2 * reach, remedy)
    low = cam.height_range()[0] - cam.radius
    needy = next((name for name in ("bore_diameter", "bore", "hub") if getattr(spec, name)), None)
    if not cam.is_groove and body.web == 0 and needy:
        remedy = f"an open tube has only its inner cylinder, {needy} needs a bottom; {told(low / 2)} mm works"
        raise ParameterError("web_thickness", body.web, remedy)
    if body.web > 0 and not body.web + wall <= low:
        remedy = f"reaches the track; at most {at_most(low - wall, 4)} mm works"
        raise ParameterError("web_thickness", body.web, remedy)
    if spec.hub is None:
        return
    # inside a tube the hub stands within its inner cylinder
    most = 2 * ((cam.inner if not cam.is_groove and spec.hub.above > 0 else cam.outer) - wall)
    if not 2 * (reach + wall) <= most:
        remedy = f"leaves no room for the hub; at most {told(most - 2 * wall)} mm works"
        raise ParameterError(key, 2 * reach, remedy)
    if not spec.hub.diameter <= most:
        remedy = f"must stay inside; at most {at_most(most, 4)} mm works"
        raise ParameterError("hub.diameter", spec.hub.diameter, remedy)
    if not spec.hub.diameter >= 2 * (reach + wall):
        remedy = f"leaves no wall around the bore; at least {at_least(2 * (reach + wall), 4)} mm works"
        raise ParameterError("hub.diameter", spec.hub.diameter, remedy)


def _moved(spec: BarrelCamSpec, body: BarrelBody, offset: float) -> BarrelBody:
    """The solid with every boundary but its end faces moved out of the material."""
    if offset == 0:
        return body
    cam = body.cam
    moved = moved_cam(cam, offset)
    most = thinnest(cam) * cam.upright
    if not offset < most:
        raise OffsetError(offset, "closes the groove", most * (1 - 1e-9))
    wall = least_wall(cam.outer)
    thin = (cam.outer - cam.inner - wall) / 2
    if not cam.is_groove and not offset > -thin:
        raise OffsetError(offset, "leaves no wall", -thin * (1 - 1e-9))
    if offset < 0 and not guides(moved):
        raise OffsetError(offset, "undercuts the walls", least_offset(cam, offset))
    bores = _holes_of(spec).profiles(offset)
    bore_reach = _holes_of(spec).bore_reach
    if bores and not bore_reach - offset + wall <= moved.inner:
        raise OffsetError(offset, "leaves no wall to the floor", (bore_reach + wall - cam.inner) / 2)
    hub = None if body.hub is None else (body.hub[0] + offset, *body.hub[1:])
    return replace(body, cam=moved, bore=bores[0] if bores else None, hub=hub)


def _quantities(spec: BarrelCamSpec, body: BarrelBody) -> dict[str, float]:
    from geometry.cams.barrel import SwingGuide
    from geometry.cams.barrel_sliding import cam_sliding
    from geometry.cams.follower_motion import PhaseKind

    cam = body.cam
    found = {
        "outer_diameter": 2 * cam.outer,
        "floor_diameter": 2 * cam.inner,
        "length": body.length,
        "roller_diameter": spec.roller_diameter,
    }
    if cam.is_groove:
        found["groove_width"] = 2 * cam.radius
    if cam.taper:
        found["cone_angle_deg"] = math.degrees(2 * math.atan(cam.taper))
        found["roller_floor_diameter"] = spec.roller_diameter - 2 * cam.taper * (cam.outer - cam.inner)
    found["roller_sliding"] = cam_sliding(cam)
    if isinstance(cam.guide, SwingGuide):
        found["swing_deg"] = math.degrees(cam.motion.lift)
        found["arm_length"] = cam.guide.arm_length
        found["pivot_offset"] = cam.guide.pivot_offset
        found["pivot_height"] = cam.guide.pivot_height
        found["start_angle_deg"] = math.degrees(cam.guide.start_angle)
    else:
        found["lift"] = cam.motion.lift
    found["start_height"] = float(cam.place(0.0, 0)[0].imag)
    for kind in (PhaseKind.RISE, PhaseKind.RETURN):
        if cam.motion.moving_pieces(kind):
            name = f"pressure_angle_{'rise' if kind is PhaseKind.RISE else 'return'}_deg"
            found[name] = math.degrees(cam.greatest_pressure_angle(kind)[0])
    found["largest_roller_diameter"] = 2 * largest_radius(cam, kept_apex(spec)) - spec.clearance
    return found


def _findings(spec: BarrelCamSpec, cam: BarrelCam) -> tuple[Finding, ...]:
    from geometry.cams.follower_motion import PhaseKind

    found = []
    soft = [(abs(j.jumps[2]), math.degrees(j.angle)) for j in cam.motion.impacts()]
    if soft:
        found.append(Finding("soft_impact", *max(soft)))
    usual = _USUAL_PRESSURE_ANGLE[spec.oscillating is not None]
    # a groove pushes both ways, a spring takes the return of an end cam
    kinds = (PhaseKind.RISE, PhaseKind.RETURN) if cam.is_groove else (PhaseKind.RISE,)
    steepest = math.degrees(max(cam.greatest_pressure_angle(kind)[0] for kind in kinds))
    if steepest > usual + 1e-9:
        found.append(Finding("steep_groove", steepest, usual))
    limit = _USUAL_ROLLER_SHARE * largest_radius(cam, kept_apex(spec))
    if cam.radius > limit:
        found.append(Finding("large_groove_roller", cam.radius, limit))
    return tuple(found)
