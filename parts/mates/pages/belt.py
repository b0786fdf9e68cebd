"""``higherpair calc belt``: pulleys, belt length and centre distance, speeds and forces of a timing belt drive."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec import Meta, field

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.belts.drive import BeltMesh, textbook_distance, textbook_length
from geometry.gears.belts.pulley import Pulley, checked_pulley
from parts.base.texts import N_
from parts.belts.pulley import TIMING_PULLEY, TimingPulleySpec
from parts.belts.steps import belt_steps, circle_steps
from parts.keys.base import MOST_LENGTH, mm, size
from parts.mates.belt import BeltDriveSpec, BeltTeeth, belt_mesh
from parts.mates.pages.drive_keys import drive_of_kind, idler_steps
from parts.mates.wrapped import Idlers
from parts.pages.force_steps import both_speeds, driving_torque
from parts.pages.inputs import calculation
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "belt"
_SPEED = "speed of the driving pulley: adds the speed of the belt"
_TORQUE = "torque on the driving pulley: adds the pull of the belt"
_POWER = "power that the driving pulley takes in, by its speed: in place of its torque"

_MATE_NUMBER_OF_TEETH = Meta(ge=6, le=500, description="number of teeth of the driven pulley", examples=[40])
_MATE_OUTER_DIAMETER = mm(
    "outer diameter of the driven pulley; default: that of the belt's pitch line",
    above=0,
    most=2 * MOST_LENGTH,
    example=63.0,
)


class BeltKeys(TimingPulleySpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the driving pulley, the teeth of the other one, the belt's length and what it carries."""

    mate_number_of_teeth: Annotated[int, _MATE_NUMBER_OF_TEETH]
    mate_outer_diameter: Annotated[float, _MATE_OUTER_DIAMETER] | None = None
    number_of_belt_teeth: BeltTeeth | None = None
    idlers: Idlers = field(default_factory=list)
    centre_distance: Annotated[float, mm("centre distance", above=0, most=1e6, example=150.0)] | None = None
    speed_rpm: Annotated[float, size("rpm", _SPEED, above=0, most=1e6)] | None = None
    torque: Annotated[float, size("N*m", _TORQUE, above=0, most=1e9)] | None = None
    power: Annotated[float, size("W", _POWER, above=0, most=1e9)] | None = None


table_from = drive_of_kind(
    "timing_pulley", BeltDriveSpec, ["outer_diameter"], "number_of_belt_teeth", "centre_distance", "idlers"
)


@calculation(TOPIC, BeltKeys)
def sheet(keys: BeltKeys) -> Sheet:
    """The calculation of a timing belt drive."""
    one = TIMING_PULLEY.thing(keys, {})
    two = _driven(keys, one)
    mesh = belt_mesh((one, two), keys.number_of_belt_teeth, keys.centre_distance, keys.idlers, "")
    page = Sheet(TOPIC, N_("Timing belt drive"))
    page.section("Given")
    page.both("number_of_teeth", (one.number_of_teeth, two.number_of_teeth))
    belt_steps(page, one.belt)
    page.section(N_("Pulleys"))
    page.add("gear_ratio", two.number_of_teeth / one.number_of_teeth, "{z2} / {z1}")
    for gear, pulley in ((1, one), (2, two)):
        circle_steps(page, pulley, gear)
    _length(page, mesh, keys.centre_distance)
    if keys.speed_rpm is not None:
        driven = keys.speed_rpm * one.number_of_teeth / two.number_of_teeth
        both_speeds(page, (keys.speed_rpm, driven), "{n1} * {z1} / {z2}")
        speed = one.number_of_teeth * keys.speed_rpm * mesh.pitch / 60_000
        page.add("belt_speed", speed, "{z1} * {n1} * {p} / 60000")
    torque = driving_torque(page, keys)
    if torque is not None:
        force = 1000 * torque / one.pitch_radius
        page.add("belt_force", force, "2000 * {T1} / {d1}")
        page.add("force_on_tooth", force / mesh.in_mesh, "{F_t} / {z_m}")
    page.notes += [finding_message(found) for found in mesh.findings()]
    return page


def _driven(keys: BeltKeys, one: Pulley) -> Pulley:
    """The other pulley, of which no flanges are known.

    Raises
    ------
    ParameterError
        It has no lands between its grooves; names its own key.
    """
    teeth, diameter = keys.mate_number_of_teeth, keys.mate_outer_diameter
    try:
        return checked_pulley(replace(one, number_of_teeth=teeth, given_outer_diameter=diameter, flanges=None))
    except ParameterError as refusal:
        own = refusal.name in ("number_of_teeth", "outer_diameter")
        raise refusal.renamed(f"mate_{refusal.name}" if own else refusal.name) from refusal


def _length(page: Sheet, mesh: BeltMesh, distance: float | None) -> None:
    """Teeth and length of the belt, and its centre distance, of textbooks and exact."""
    page.section(N_("Belt and centre distance"))
    drive = mesh.drive
    if distance is not None:
        page.add("belt_distance", distance, given=True)
    if distance is not None and not mesh.idlers:
        formula = "2 * {a} + pi / 2 * ({d1} + {d2}) + ({d2} - {d1})**2 / (4 * {a})"
        page.add("textbook_belt_length", textbook_length(drive.radii, distance), formula)
    page.add("number_of_belt_teeth", mesh.belt_teeth)
    length = mesh.belt_teeth * mesh.pitch
    page.add("belt_length", length, "{z_b} * {p}")
    if mesh.idlers:
        page.add("taut_loop_length", drive.length)
        page.add("belt_slack", max(mesh.slack, 0.0), "{L_b} - {L_0}")
        page.both("loop_wrap_deg", [math.degrees(wrap) for wrap in drive.loop.both_wraps])
        idler_steps(page, drive.loop.idler_wraps, mesh.taut_idler)
        page.add("teeth_in_mesh", mesh.in_mesh)
        return
    near = textbook_distance(drive.radii, length)
    if near is not None:
        free = "(2 * {L_b} - pi * ({d1} + {d2}))"
        page.add("textbook_belt_distance", near, f"({free} + sqrt({free}**2 - 8 * ({{d2}} - {{d1}})**2)) / 8")
    exact = belt_mesh(mesh.pulleys, mesh.belt_teeth, None, prefix="").centre_distance
    page.add("exact_belt_distance", exact)
    if distance is not None:
        page.add("belt_slack", max(mesh.slack, 0.0))
    nearest = "{a}" if distance is not None else "{a_0}"
    wrap = f"pi - 2 * arcsin(abs({{d2}} - {{d1}}) / (2 * {nearest}))"
    page.add("belt_wrap_deg", math.degrees(min(drive.loop.both_wraps)), wrap)
    least = "{z1}" if mesh.pulleys[0].number_of_teeth <= mesh.pulleys[1].number_of_teeth else "{z2}"
    page.add("teeth_in_mesh", mesh.in_mesh, f"{least} * {{alpha_1}} / (2 * pi)")
