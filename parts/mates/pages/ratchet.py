"""``higherpair calc ratchet``: teeth and pawl of a ratchet, its idle turn, how it pulls in, its forces."""

from __future__ import annotations

import cmath
import math
from typing import Annotated, Any

import numpy as np
from msgspec import Meta

from geometry.gears.ratchets.pawl import PawlShape
from geometry.gears.ratchets.wheel import RatchetWheel
from parts.base.texts import N_
from parts.keys.base import size
from parts.mates.ratchet import Friction, RatchetPairSpec
from parts.pages.inputs import SceneKeys, calculation, chosen_part, given
from parts.pages.page import Sheet
from parts.ratchets.pawl import (
    PAWL,
    BossDiameter,
    Clearance,
    ClearanceAngle,
    Length,
    LineAngle,
    NoseHeight,
    NoseRadius,
    PawlSpec,
    PivotDiameter,
)
from parts.ratchets.wheel import RATCHET_WHEEL, RatchetWheelSpec

TOPIC = "ratchet"
# the keys of a pawl that the page takes over: all that say how it stands and rides
_OF_PAWL = ("length", "line_angle_deg", "nose_radius", "nose_height", "clearance_angle_deg", "clearance",
            "boss_diameter", "pivot_diameter")  # fmt: skip
_PAWLS_AT = Meta(
    min_length=1,
    max_length=100,
    description="the teeth that the pawls hold where the wheel stands at rotation 0, as `tooth` of ratchet_pair",
    examples=[[1.0, 8.5]],
)
_TORQUE = size("N*m", "torque that the wheel holds", above=0, most=1e9, example=20.0)
_ROWS = Meta(ge=3, le=2000, description="rows of the table of the ride")


class RatchetKeys(RatchetWheelSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the wheel, of its pawl and of the load."""

    length: Length = None
    line_angle_deg: LineAngle = None
    nose_radius: NoseRadius = None
    nose_height: NoseHeight = None
    clearance_angle_deg: ClearanceAngle = 10.0
    clearance: Clearance = None
    boss_diameter: BossDiameter = None
    pivot_diameter: PivotDiameter = None
    pawls_at: Annotated[list[float], _PAWLS_AT] | None = None
    friction: Friction = 0.15
    torque: Annotated[float, _TORQUE] | None = None
    rows: Annotated[int, _ROWS] = 13


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of the one wheel of a scene, or of the one that ``part`` names, of its first pawl and of its mates."""
    fitting = [key for key, spec in scene.parts.items() if isinstance(spec, RatchetWheelSpec)]
    name = chosen_part("ratchet_wheel", fitting, fitting, source, table)
    found, wheel = given(scene.parts[name]), scene.parts[name]
    pawls = {key: spec for key, spec in scene.parts.items() if isinstance(spec, PawlSpec) and spec.of == name}
    for spec in list(pawls.values())[:1]:
        found |= {key: value for key, value in given(spec).items() if key in _OF_PAWL}
    places = []
    for mate in scene.mates:
        if isinstance(mate, RatchetPairSpec) and scene.instances[mate.first].part == name:
            found["friction"] = mate.friction
            pawl = scene.instances[mate.second].part
            assert isinstance(wheel, RatchetWheelSpec)
            assert pawl is not None
            places.append(_place(mate, PAWL.thing(pawls[pawl], {name: wheel}).shape))
    return found | ({"pawls_at": places} if places else {}) | table


def _place(mate: RatchetPairSpec, pawl: PawlShape) -> float:
    """The tooth that a pawl holds, by its direction where the mate has one."""
    if mate.direction_deg is None:
        return 1.0 if mate.tooth is None else mate.tooth
    towards = math.radians(mate.direction_deg) * (1 if pawl.wheel.ccw else -1)
    return round(1 + (towards - cmath.phase(pawl.pivot)) / pawl.wheel.pitch_angle, 9)


@calculation(TOPIC, RatchetKeys)
def sheet(keys: RatchetKeys) -> Sheet:
    """The calculation of a ratchet."""
    wheel = RATCHET_WHEEL.thing(keys, {})
    own = PawlSpec(of="wheel", **{key: getattr(keys, key) for key in _OF_PAWL})
    pawl = PAWL.thing(own, {"wheel": keys}).shape
    page = Sheet(TOPIC, N_("Ratchet"))
    page.section(N_("Given"))
    page.given(
        number_of_teeth=wheel.number_of_teeth, module=keys.module, ratchet_tooth_depth=wheel.depth,
        front_angle_deg=keys.front_angle_deg, ratchet_fillet_radius=wheel.fillet_radius, pawl_length=pawl.length,
        line_angle_deg=math.degrees(pawl.line_angle), nose_radius=pawl.nose_radius, friction_coefficient=keys.friction,
    )  # fmt: skip
    _teeth(page, wheel)
    _pawl(page, pawl, keys)
    if keys.torque is not None:
        _forces(page, pawl, keys.torque, keys.face_width)
    _ride(page, pawl, keys.rows)
    return page


def _teeth(page: Sheet, wheel: RatchetWheel) -> None:
    sign = "+" if wheel.internal else "-"
    page.section(N_("Teeth"))
    page.add("ratchet_pitch_deg", math.degrees(wheel.pitch_angle), "2 * pi / {z}")
    page.add("tip_circle_diameter", 2 * wheel.tip_radius, "{m} * {z}")
    page.add("root_diameter", 2 * wheel.root_radius, f"{{D}} {sign} 2 * {{h}}", symbol="d_f", key="d_f")
    page.told(ratchet_land=wheel.tip_land, notch_angle_deg=math.degrees(wheel.cut_angle))
    page.add("face_circle_radius", wheel.face_circle_radius, "{D} / 2 * abs(sin({alpha}))")
    page.told(root_thickness=wheel.root_thickness)


def _pawl(page: Sheet, pawl: PawlShape, keys: RatchetKeys) -> None:
    sign = "-" if pawl.wheel.internal else "+"
    page.section(N_("Pawl"))
    square = f"({{D}} / 2)**2 + {{l}}**2 {sign} {{D}} * {{l}} * sin({{gamma}})"
    page.add("pivot_distance", pawl.pivot_distance, f"sqrt({square})")
    page.told(contact_depth=pawl.contact_depth, pawl_swing_deg=math.degrees(pawl.swing))
    page.told(overrun_deg=math.degrees(pawl.overrun))
    page.add("pull_in_angle_deg", math.degrees(pawl.pull_in_angle), "{alpha} + {gamma}")
    page.add("pawl_friction_angle_deg", math.degrees(math.atan(keys.friction)), "arctan({f})")
    if keys.friction > 0:
        page.add("pull_in_margin", math.tan(pawl.pull_in_angle) / keys.friction, "tan({delta}) / {f}")
    if pawl.pull_in_angle <= math.atan(keys.friction):
        page.note(N_("friction may hold the pawl out: δ must be above ρ"))
    places = [1.0] if keys.pawls_at is None else keys.pawls_at
    shares = np.unique(np.round(np.mod(places, 1.0), 9))
    gaps = np.diff([*shares, shares[0] + 1])
    page.section(N_("Idle turn"))
    page.told(number_of_pawls=len(places))
    even = len(places) == len(shares) and float(np.ptp(gaps)) < 1e-6
    page.add("idle_turn_deg", float(gaps.max()) * math.degrees(pawl.wheel.pitch_angle), "{tau} / {n}" if even else "")
    if not even:
        page.note(N_("pawls evenly between the teeth would leave 360 / (z n) = {even:.4g} deg"),
                  even=360 / (pawl.wheel.number_of_teeth * len(places)))  # fmt: skip


def _forces(page: Sheet, pawl: PawlShape, torque: float, width: float) -> None:
    page.section(N_("Forces"))
    tip, depth, root = 2 * pawl.wheel.tip_radius, pawl.wheel.depth, pawl.wheel.root_thickness
    page.given(ratchet_torque=torque, ratchet_width=width)
    force = 2000 * torque / tip
    page.add("ratchet_force", force, "2000 * {T} / {D}")
    page.add("pawl_force", force / math.cos(pawl.wheel.front_angle), "{F} / cos({alpha})")
    page.add("line_load", force / width, "{F} / {b}")
    page.add("root_bending_stress", 6 * force * depth / (width * root**2), "6 * {F} * {h} / ({b} * {s}**2)")
    page.note(N_("one pawl bears it; the tooth is a cantilever as thick as on its root circle, loaded at its edge"))


def _ride(page: Sheet, pawl: PawlShape, rows: int) -> None:
    turns = np.linspace(0.0, pawl.wheel.pitch_angle, rows)
    lifts = [pawl.stands(turn) for turn in turns.tolist()]
    title = N_("The ride over a tooth: turn of the wheel since the pawl was seated, swing of the pawl")
    page.table("ride", title, (("φ", "deg"), ("ψ", "deg")), zip(np.degrees(turns), np.degrees(lifts), strict=True))
