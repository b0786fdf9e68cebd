"""``higherpair calc cam`` of a cylindrical cam: motion, sizes, both walls on the unrolled outer cylinder and floor."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from geometry.cams.barrel.body import BarrelBody
from geometry.cams.barrel.cam import LOWER, UPPER, AxialGuide, BarrelCam, SwingGuide
from geometry.cams.motion.follower_motion import PhaseKind
from geometry.curves.curve import Real
from geometry.laws.piece import LawPiece
from parts.base.texts import N_, Message, filled, message
from parts.cams.barrel_cam.part import BARREL_CAM
from parts.cams.disk_cam.speed_page import speed_section
from parts.keys.barrel import BarrelCamSpec
from parts.pages.cam_steps import (
    TOPIC,
    Phases,
    Speed,
    Step,
    angular_speed,
    cam_angles,
    coefficient_steps,
    impact_notes,
    motion_columns,
    phase_steps,
    straightened,
)
from parts.pages.inputs import calculation
from parts.pages.page import Sheet, Table, table_of


class BarrelKeys(BarrelCamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a cylindrical cam, the step of its table, and its speed."""

    step: Step = 10.0
    speed_rpm: Speed | None = None


@calculation(TOPIC, BarrelKeys)
def sheet(keys: BarrelKeys) -> Sheet:
    """The calculation of a cylindrical cam."""
    body = BARREL_CAM.thing(keys, {})
    cam, swings = body.cam, keys.oscillating is not None
    phases = Phases(cam.motion.phases, cam.motion.lift, swings, left_rows=cam.motion.left_rows)
    page = Sheet(TOPIC, N_("Cylindrical cam"))
    phase_steps(page, phases)
    page.add("roller_diameter", keys.roller_diameter)
    if cam.taper:
        page.add("cone_angle_deg", math.degrees(2 * math.atan(cam.taper)))
    if isinstance(cam.guide, SwingGuide):
        page.told(arm_length=cam.guide.arm_length, pivot_offset=cam.guide.pivot_offset)
        page.told(pivot_height=cam.guide.pivot_height, start_angle_deg=math.degrees(cam.guide.start_angle))
    coefficient_steps(page, phases)
    _sizes(page, keys, body)
    page.data["phases"] = phases.data()
    page.tables += [_positions(cam, keys.step, keys.speed_rpm, swings=swings), *_walls(cam, keys.step)]
    if keys.speed_rpm is not None:
        speed_section(page, cam.motion, keys.speed_rpm, slides=not swings)
    impact_notes(page, cam.motion)
    page.note("x = R (polar angle + pi) on the unrolled cylinder, seen from outside, cam angle 0 at the right end")
    return page


def _sizes(page: Sheet, keys: BarrelKeys, body: BarrelBody) -> None:
    cam = body.cam
    page.section("Sizes")
    page.add("outer_diameter", 2 * cam.outer)
    page.add("groove_depth", keys.groove_depth, called="" if cam.is_groove else N_("width of the track"))
    page.add("floor_diameter" if cam.is_groove else "inner_diameter", 2 * cam.inner, "{D} - 2 * {t}")
    if cam.is_groove:
        page.add("clearance", keys.clearance)
        page.add("groove_width", 2 * cam.radius, "{d} + {c_r}")
    page.told(barrel_length=body.length, roller_height=float(cam.place(0.0, 0)[0].imag))
    for kind, name, called in (
        (PhaseKind.RISE, "rise", N_("greatest pressure angle {where}, rise")),
        (PhaseKind.RETURN, "return", N_("greatest pressure angle {where}, return")),
    ):
        pieces = cam.motion.moving_pieces(kind)
        if not pieces:
            continue
        steepest = math.degrees(cam.greatest_pressure_angle(kind)[0])
        page.add(f"pressure_angle_{name}_deg", steepest, called=filled(called, where=_steepest_at(cam)))
        if isinstance(cam.guide, AxialGuide):
            sign = 1 if kind is PhaseKind.RISE else -1
            steep = max(float((sign * p.value(p.extremes(1), 1)).max()) for p in pieces)
            page.add("peak_velocity", steep, symbol="|S'|_max", key="S1m")
            angle = math.degrees(math.atan(steep / cam.outer))
            page.add(f"outer_pressure_angle_{name}_deg", angle, "arctan({S1m} / ({D} / 2))")
    page.add("largest_roller_diameter", BARREL_CAM.report(keys, body).quantities["largest_roller_diameter"])


def _steepest_at(cam: BarrelCam) -> Message:
    """Where the pressure angle is greatest: nearest to the cam's axis."""
    return message("at the floor") if cam.is_groove else message("at the inner edge of the track")


def _positions(cam: BarrelCam, step: float, speed_rpm: float | None, *, swings: bool) -> Table:
    """phi, S, S', S'', the greater pressure angle of the walls where it is steepest, the roller's axis y, z."""
    degrees, angle = cam_angles(cam.motion, step)
    motion = [cam.motion.value(angle, k) for k in range(3)]
    columns, heads = motion_columns(motion, degrees, swings=swings, speed=angular_speed(speed_rpm))
    slope = np.max([_by_piece(cam, angle, lambda p, t, s=side: cam.pressure_angle(t, cam.inner, p, s))
                    for side in cam.sides], axis=0)  # fmt: skip
    place = np.asarray(cam.place(angle, 0)[0])
    title = message(
        "Positions: cam angle, motion, pressure angle {where}, the roller's axis across and along the cam",
        where=_steepest_at(cam),
    )
    heads += [("nu", "deg"), ("y", "mm"), ("z", "mm")]
    columns += [np.degrees(slope), place.real, place.imag]
    return table_of("positions", title, heads, zip(*columns, strict=True))


def _walls(cam: BarrelCam, step: float) -> list[Table]:
    """x, z and radius of curvature of every wall, unrolled on the outer cylinder and on the inner one."""
    degrees, angle = cam_angles(cam.motion, step)
    inner = message("Development of the floor") if cam.is_groove else message("Development of the inner cylinder")
    made = []
    for name, radius, title in (
        ("development", cam.outer, message("Development of the outer cylinder")),
        ("development_floor", cam.inner, inner),
    ):
        columns, heads = [degrees], [("phi", "deg")]
        for side in cam.sides:
            found = _by_piece(cam, angle, lambda p, t, s=side, r=radius: wall_line(cam, p, s, r, t))
            index = "" if not cam.is_groove else "_1" if side == UPPER else "_2"
            columns += [*found]
            heads += [(f"x{index}", "mm"), (f"z{index}", "mm"), (f"rho{index}", "mm")]
        if cam.is_groove:
            title = message("{title}: upper wall (1) and lower wall (2)", title=title)
        made.append(table_of(name, title, heads, zip(*columns, strict=True)))
    return made


def wall_line(cam: BarrelCam, piece: LawPiece, side: int, radius: float, angle: Real) -> Real:
    """A wall's line on an unrolled cylinder, (3, ...): x, z and its radius of curvature, mm, convex above 0."""
    polar, height = cam.edge_series(piece, side, radius, angle, 2)
    first = radius * polar[1] + 1j * height[1]
    second = 2 * (radius * polar[2] + 1j * height[2])
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = np.abs(first) ** 3 / (np.conj(first) * second).imag
    # the line runs to -x: it turns left over a crest, where a lower wall is convex
    bend = straightened(bend * (1 if side == LOWER else -1), radius)
    return np.stack([radius * (polar[0] + math.pi), height[0], bend])


def _by_piece(cam: BarrelCam, angle: Real, function: Callable[..., Real]) -> Real:
    """A function of a piece of the motion and its cam angles, at all cam angles; joints belong to what begins."""
    starts = np.array([p.start for p in cam.motion.pieces])
    index = np.searchsorted(starts, angle, side="right") - 1
    parts = [function(cam.motion.pieces[k], angle[index == k]) for k in range(len(starts))]
    return np.concatenate(parts, axis=-1)
