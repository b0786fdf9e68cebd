"""``higherpair calc chain``: sprockets, links and centre distance, speeds, irregularity and forces of a chain drive."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec import Meta, field
from msgspec.structs import replace as changed

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.chains.drive import ChainMesh, textbook_distance, textbook_links
from geometry.gears.chains.sprocket import IsoForm, SeatedForm, checked_sprocket
from parts.base.texts import N_
from parts.chains.sprocket import SPROCKET, SprocketSpec, ToothForm, tooth_gap
from parts.chains.steps import chain_steps, circle_steps
from parts.keys.base import MOST_LENGTH, mm, size
from parts.mates.chain import ChainDriveSpec, chain_mesh
from parts.mates.pages.drive_keys import drive_of_kind, idler_steps
from parts.mates.wrapped import Idlers
from parts.pages.force_steps import both_speeds, driving_torque
from parts.pages.inputs import calculation
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "chain"
_SHIGLEY, _BHANDARI, _DUNAEV, _SHEINBLIT = "Shigley", "Bhandari", "Dunaev, Lelikov", "Sheinblit"
_SPEED = "speed of the driving sprocket: adds the speeds of the chain and how unevenly it runs"
_TORQUE = "torque on the driving sprocket: adds the pull of the chain and the load of the shafts"
_POWER = "power that the driving sprocket takes in, by its speed: in place of its torque"
# textbooks: the shaft's load by the force of a drive that lies, and how much nearer it is mounted for the slack strand
_LOAD, _MOUNTED = 1.15, 0.995

_NUMBER_OF_LINKS = Meta(ge=6, le=10_000, description="links of the chain", examples=[100])
_MATE_NUMBER_OF_TEETH = Meta(ge=6, le=200, description="number of teeth of the driven sprocket", examples=[38])
_MATE_TIP_DIAMETER = mm(
    "tip diameter of the driven sprocket; default: by its tooth form",
    above=0,
    most=2 * MOST_LENGTH,
    example=160.0,
)


_MATE_TOOTH_FORM = Meta(description="standard of the driven sprocket's tooth form; default: that of the driving one")
_MATE_FORM = Meta(ge=0, le=1, description="`form` of the driven sprocket; default: that of the driving one")
_MATE_DISPLACED = Meta(description="`displaced` of the driven sprocket; default: that of the driving one")


class ChainKeys(SprocketSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the driving sprocket, the teeth of the other one, the chain's length and what it carries."""

    mate_number_of_teeth: Annotated[int, _MATE_NUMBER_OF_TEETH]
    mate_tip_diameter: Annotated[float, _MATE_TIP_DIAMETER] | None = None
    mate_tooth_form: Annotated[ToothForm, _MATE_TOOTH_FORM] | None = None
    mate_form: Annotated[float, _MATE_FORM] | None = None
    mate_displaced: Annotated[bool, _MATE_DISPLACED] | None = None
    number_of_links: Annotated[int, _NUMBER_OF_LINKS] | None = None
    idlers: Idlers = field(default_factory=list)
    centre_distance: Annotated[float, mm("centre distance", above=0, most=1e6, example=458.0)] | None = None
    speed_rpm: Annotated[float, size("rpm", _SPEED, above=0, most=1e6)] | None = None
    torque: Annotated[float, size("N*m", _TORQUE, above=0, most=1e9)] | None = None
    power: Annotated[float, size("W", _POWER, above=0, most=1e9)] | None = None


_OWN = "tip_diameter", "tooth_form", "form", "displaced"

table_from = drive_of_kind("sprocket", ChainDriveSpec, _OWN, "number_of_links", "centre_distance", "idlers")


@calculation(TOPIC, ChainKeys)
def sheet(keys: ChainKeys) -> Sheet:
    """The calculation of a chain drive."""
    one = SPROCKET.thing(keys, {})
    teeth, diameter = keys.mate_number_of_teeth, keys.mate_tip_diameter
    try:
        form = _mate_form(keys)
        two = checked_sprocket(replace(one, number_of_teeth=teeth, given_tip_diameter=diameter, form=form))
    except ParameterError as refusal:
        raise refusal.renamed(f"mate_{refusal.name}" if refusal.name in _OWN else refusal.name) from refusal
    mesh = chain_mesh((one, two), keys.number_of_links, keys.centre_distance, keys.idlers, "")
    page = Sheet(TOPIC, N_("Chain drive"))
    page.section(N_("Given"))
    page.both("number_of_teeth", mesh.teeth)
    chain_steps(page, one.chain)
    page.section(N_("Sprockets"))
    page.add("gear_ratio", mesh.teeth[1] / mesh.teeth[0], "{z2} / {z1}")
    for gear, sprocket in ((1, one), (2, two)):
        circle_steps(page, sprocket, gear, alike=gear == 2 and two.form == one.form)
        page.add("sprocket_over_pins", sprocket.over_pins, gear=gear)
    _links(page, mesh, keys.centre_distance)
    if keys.speed_rpm is not None:
        _speeds(page, mesh, keys.speed_rpm)
    torque = driving_torque(page, keys)
    if torque is not None:
        _forces(page, mesh, torque)
    page.note(N_("a taut chain is the hull of both polygons of pins at its tightest stand; "
                 "textbooks have a belt in its place, about circles as long as both sprockets have teeth"))  # fmt: skip
    page.notes += [finding_message(found) for found in mesh.findings()]
    return page


def _mate_form(keys: ChainKeys) -> IsoForm | SeatedForm:
    """That of the driven sprocket; what only one standard has goes with that."""
    alike = keys.mate_tooth_form in (None, keys.tooth_form)
    form, displaced = (keys.form, keys.displaced) if alike else (0.0, False)
    mate = changed(
        keys,
        tooth_form=keys.mate_tooth_form or keys.tooth_form,
        form=form if keys.mate_form is None else keys.mate_form,
        displaced=displaced if keys.mate_displaced is None else keys.mate_displaced,
    )
    return tooth_gap(mate)


def _links(page: Sheet, mesh: ChainMesh, distance: float | None) -> None:
    """Links by the distance that is asked for, and the distance of whole links, of textbooks and exact."""
    page.section(N_("Links and centre distance"))
    square = "(({z2} - {z1}) / (2 * pi))**2"
    if distance is not None:
        page.add("chain_distance", distance, given=True)
    if mesh.idlers:
        page.add("number_of_links", mesh.links)
        page.add("taut_loop_length", mesh.drive.longest() * mesh.pitch)
        page.add("chain_slack", mesh.slack, "{L} * {p} - {L_0}")
        page.both("loop_wrap_deg", [math.degrees(wrap) for wrap in mesh.drive.loop.both_wraps])
        idler_steps(page, mesh.drive.loop.idler_wraps, mesh.taut_idler)
        return
    if distance is not None:
        formula = f"2 * {{a}} / {{p}} + ({{z1}} + {{z2}}) / 2 + {square} * {{p}} / {{a}}"
        page.add("textbook_links", textbook_links(mesh.teeth, distance / mesh.pitch), formula, _SHIGLEY)
    page.add("number_of_links", mesh.links)
    belt = textbook_distance(mesh.teeth, mesh.links) * mesh.pitch
    free = "({L} - ({z1} + {z2}) / 2)"
    formula = f"{{p}} / 4 * ({free} + sqrt({free}**2 - 8 * {square}))"
    page.add("textbook_chain_distance", belt, formula, _SHIGLEY)
    taut = chain_mesh(mesh.sprockets, mesh.links, None, prefix="").centre_distance
    page.add("exact_chain_distance", taut)
    page.add("chain_distance_difference", belt - taut, "{a_t} - {a_0}")
    if distance is None:
        page.add("mounting_chain_distance", _MOUNTED * taut, f"{_MOUNTED} * {{a_0}}", _SHEINBLIT)
    else:
        page.add("chain_slack", mesh.slack)
    nearest = "{a}" if distance is not None else "{a_0}"
    wrap = f"pi - 2 * arcsin(abs({{d2}} - {{d1}}) / (2 * {nearest}))"
    page.add("wrap_deg", math.degrees(min(mesh.drive.loop.both_wraps)), wrap)


def _speeds(page: Sheet, mesh: ChainMesh, speed: float) -> None:
    """Of both shafts and of the chain, and how unevenly it runs while the driver turns evenly."""
    one, two = mesh.teeth
    both_speeds(page, (speed, speed * one / two), "{n1} * {z1} / {z2}")
    page.add("chain_speed", one * speed * mesh.pitch / 60_000, "{z1} * {n1} * {p} / 60000", _SHIGLEY)
    tip = math.pi * speed / 30 * mesh.sprockets[0].pitch_radius / 1000
    page.add("greatest_chain_speed", tip, "pi * {n1} * {d1} / 60000", _SHIGLEY)
    page.add("least_chain_speed", tip * math.cos(math.pi / one), "{v_g} * cos(pi / {z1})", _SHIGLEY)
    uneven = math.pi / one * (1 / math.sin(math.pi / one) - 1 / math.tan(math.pi / one))
    page.add("chain_irregularity", uneven, "({v_g} - {v_l}) / {v}", _SHIGLEY)


def _forces(page: Sheet, mesh: ChainMesh, torque: float) -> None:
    """In the chain, on the shafts, and how often it is carried by the chain."""
    # the mean: work of a turn by the chain it moves, as textbooks divide the power by the mean speed
    chain, force = mesh.sprockets[0].chain, 2000 * math.pi * torque / (mesh.teeth[0] * mesh.pitch)
    page.add("chain_force", force, "2000 * pi * {T1} / ({z1} * {p})", _BHANDARI)
    page.add("chain_shaft_load", _LOAD * force, f"{_LOAD} * {{F_t}}", _DUNAEV)
    if chain.breaking_load:
        page.add("chain_breaking_load", 1000 * chain.breaking_load)
        page.add("chain_safety", 1000 * chain.breaking_load / force, "{F_u} / {F_t}")
