"""``higherpair calc worm``: a worm or a drive by GOST 19650, exact sections, speeds, forces, strength by the thesis."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from typing import Annotated, Any

from msgspec import Meta, Struct
from msgspec.structs import replace as changed

from geometry.base.errors import ParameterError, limit
from geometry.base.findings import beyond, short_of
from geometry.base.nearest import nearest
from geometry.gears.worms import strength
from geometry.gears.worms.contact import AxisErrors, contact_under
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.flank import InvoluteFlank
from geometry.gears.worms.measures import BALL, over_balls, reference_chord
from geometry.gears.worms.thread import Thread, thread_of
from geometry.gears.worms.worm import Worm
from parts.base.refusal import REMOVED, SceneError, explained
from parts.base.texts import N_, Told
from parts.gears.worm.part import WormSpec, told_worm
from parts.gears.worm_wheel.part import WORM_WHEEL, WormWheelSpec
from parts.keys.base import check_not_in_vain, mm, size
from parts.keys.worm import (
    Addendum,
    AngleError,
    AxialError,
    AxialModule,
    Clearance,
    DistanceError,
    Fillet,
    Form,
    GrindingWheel,
    HobQuotient,
    HobRounding,
    HobThinning,
    LeadAngle,
    Starts,
    TipRounding,
    WheelDistance,
    WheelShift,
    WormAngle,
    WormHand,
    WormQuotient,
    hob_quotient,
    in_degrees,
    quotient_of,
    shift_of,
    worm_of,
)  # fmt: skip
from parts.pages.force_steps import asked_torque, torque_steps
from parts.pages.inputs import SceneKeys, checked, chosen_part, given, keys_of, refusal
from parts.pages.misprints import printed_for_worm
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "worm"
_ERRORS = ("centre_distance_error", "axis_angle_error_deg", "wheel_axial_error")
# what a worm alone has not
_OF_DRIVE = (
    "speed_rpm", "torque", "wheel_torque", "power", "friction_coefficient", "form_factor", "face_width",
    "outer_diameter", "profile_shift_coefficient", "working_centre_distance", "hob_rounding_coefficient",
    "hob_diameter_quotient", "wheel_thinning", *_ERRORS,
)  # fmt: skip
# what the strength of the wheel takes, beside the form of its teeth
_OF_STRENGTH = ("width_factor", "speed_factor", "tensile_strength", "bending_life_factor", "contact_life_factor")
# keys each of which tells what the other does
_INSTEAD = (
    ("lead_angle_deg", "diameter_quotient"),
    ("working_centre_distance", "profile_shift_coefficient"),
    ("profile_shift_coefficient", "working_centre_distance"),
)
_GOST, _THESIS = "GOST 19650", "thesis, 2.2"
_Factor = Annotated[float, Meta(gt=0, le=100)]
_Life = Annotated[float, Meta(gt=0, le=10)]

_NUMBER_OF_TEETH = Meta(ge=8, le=10_000, description="teeth of the wheel, z2; without it a worm alone")
_BALL_DIAMETER = mm("balls or wires in its spaces; default: 1.67 m", above=0, most=10_000)
_WHEEL_TORQUE = size("N*m", "torque T2 on the wheel, in place of T1", above=0, most=1e9)
_FORM_FACTOR = Meta(gt=0, le=10, description="form factor Y_F2 of the wheel's teeth: adds their strength")
_FRICTION_COEFFICIENT = Meta(ge=0, le=1, description="friction of the flanks; without it no losses")


class WormKeys(Struct, kw_only=True, forbid_unknown_fields=True):
    """Keys of a worm drive and of what it carries."""

    module: AxialModule
    number_of_teeth: Annotated[int, _NUMBER_OF_TEETH] | None = None
    number_of_starts: Starts = 1
    diameter_quotient: WormQuotient | None = None
    lead_angle_deg: LeadAngle | None = None
    profile_shift_coefficient: WheelShift = 0.0
    working_centre_distance: WheelDistance | None = None
    form: Form = "ZI"
    pressure_angle_deg: WormAngle = 20.0
    hand: WormHand = "right"
    addendum_coefficient: Addendum = 1.0
    tip_clearance_coefficient: Clearance = 0.2
    fillet_coefficient: Fillet = 0.2
    grinding_wheel_diameter: GrindingWheel = 300.0
    axial_thinning: Annotated[float, mm("thinning of the thread, axial, for backlash", least=0, most=1000)] = 0.0
    tip_rounding: TipRounding = 0.0
    ball_diameter: Annotated[float, _BALL_DIAMETER] | None = None
    worm_length: Annotated[float, mm("threaded length b1", above=0, most=100_000)] | None = None
    face_width: Annotated[float, mm("width b2 of the wheel's rim", above=0, most=100_000)] | None = None
    outer_diameter: Annotated[float, mm("d_ae2, outside of the wheel's throat", above=0, most=200_000)] | None = None
    hob_rounding_coefficient: HobRounding = 0.2
    hob_diameter_quotient: HobQuotient | None = None
    wheel_thinning: HobThinning = 0.0
    centre_distance_error: DistanceError = 0.0
    axis_angle_error_deg: AngleError = 0.0
    wheel_axial_error: AxialError = 0.0
    speed_rpm: Annotated[float, size("rpm", "speed of the worm", above=0, most=1e6)] | None = None
    torque: Annotated[float, size("N*m", "torque T1 on the worm", above=0, most=1e9)] | None = None
    wheel_torque: Annotated[float, _WHEEL_TORQUE] | None = None
    power: Annotated[float, size("W", "power that the worm takes in, by its speed, in place of its torque", above=0,
                                 most=1e9)] | None = None  # fmt: skip
    friction_coefficient: Annotated[float, _FRICTION_COEFFICIENT] = 0.0
    form_factor: Annotated[float, _FORM_FACTOR] | None = None
    width_factor: Annotated[_Factor, Meta(description="K_beta: uneven load along the rim")] = 1.5
    speed_factor: Annotated[_Factor, Meta(description="K_v: load of the motion itself")] = 1.1
    tensile_strength: Annotated[float, size("MPa", "tensile strength of the wheel's rim", above=0, most=10_000)] = 200.0
    bending_life_factor: Annotated[_Life, Meta(description="K_FL: life in bending")] = 1.0
    contact_life_factor: Annotated[_Life, Meta(description="K_HL: life in contact")] = 1.0


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a scene's worm and of the wheel that it is mated with, changed by those of ``table``.

    ``part``: which worm, or which wheel, where there are several.
    """
    fitting = [key for key, spec in scene.parts.items() if isinstance(spec, WormSpec | WormWheelSpec)]
    mates = [mate for mate in scene.mates if mate.__struct_config__.tag == "worm_pair"]
    pairs = [tuple(scene.instances[getattr(mate, end)].part for end in ("first", "second")) for mate in mates]
    told = fitting[:1] if len(set(pairs)) == 1 and set(fitting) <= {*pairs[0]} else fitting
    chosen = chosen_part(TOPIC, fitting, told, source, table)
    both = next((pair for pair in pairs if chosen in pair), (chosen,))
    off = next((given(mate) for mate, pair in zip(mates, pairs, strict=True) if pair == both), {})
    errors = {key: off[key] for key in _ERRORS if key in off}
    own = drive_table([scene.parts[key] for key in both if key is not None])
    # what stands in place of the scene's
    for key, other in _INSTEAD:
        if key in table:
            own.pop(other, None)
    return own | errors | table


def drive_table(specs: Sequence[Struct]) -> dict[str, Any]:
    """The keys of this page that a worm and its wheel, or one of them, tell."""
    table: dict[str, Any] = {}
    for spec in specs:
        if isinstance(spec, WormSpec):
            table |= given(told_worm(spec)) | {"worm_length": spec.thread_length}
        else:
            told = given(spec)
            # the thinning of a wheel is that of its teeth
            thinning = {"wheel_thinning": told.pop("axial_thinning")} if "axial_thinning" in told else {}
            table |= told | thinning
    return {key: value for key, value in table.items() if key in keys_of(WormKeys)}


def sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of one worm, or of its drive."""
    return begun(table)()


def begun(table: dict[str, Any]) -> Callable[[], Sheet]:
    """The same, refused where it is before the teeth of the wheel are made, of which remarks alone are told."""
    asked: WormKeys = checked(table, WormKeys, TOPIC)
    if asked.number_of_teeth is None:
        for key in _OF_DRIVE:
            if table.get(key):
                raise SceneError("calc", f"{TOPIC}.number_of_teeth", None, "worm_wheel_missing", key=key)
    try:
        if asked.form_factor is None:
            check_not_in_vain(asked, _OF_STRENGTH, "form_factor")
        keys, worm, driving = _settled(asked)
        if driving is None and asked.wheel_torque is None:
            check_not_in_vain(asked, ("form_factor",), "torque")
    except ParameterError as error:
        raise refusal(TOPIC, in_degrees(error, asked), keys=asked) from error
    drive = keys.number_of_teeth and WormDrive(worm, keys.number_of_teeth, keys.profile_shift_coefficient)
    if drive and keys.outer_diameter is not None and keys.outer_diameter < (least := 2 * drive.tip_radius):
        within = limit(least, keys.outer_diameter)
        told = ParameterError("outer_diameter", keys.outer_diameter, "within_throat", within, diameter=least)
        raise refusal(TOPIC, told, keys=keys)
    page = Sheet(TOPIC, N_("Worm drive") if drive else N_("Worm"))
    if drive:
        on_worm = driving if keys.wheel_torque is None else keys.wheel_torque / drive.ratio
        page.printed = printed_for_worm(worm, drive.number_of_teeth, drive.profile_shift_coefficient, on_worm)
    _given(page, keys, worm.diameter_quotient)
    _dimensions(page, worm, drive or None, keys.worm_length)
    _sections(page, worm, keys)
    with suppress(ParameterError):
        # of a thread that has room for its corners
        thread = thread_of(worm, keys.tip_rounding)
        _measures(page, thread, keys)
    if drive:
        _at_work(page, drive, keys, driving)

    def finished() -> Sheet:
        if drive:
            _wheel_remarks(page, keys)
        return page

    return finished


def _settled(asked: WormKeys) -> tuple[WormKeys, Worm, float | None]:
    """The keys with a quotient and a shift, their worm, and the torque on it, N*m, where it is given.

    Raises
    ------
    ParameterError
        Keys that exclude each other, or of which there is no worm.
    """
    driving = asked_torque(asked)
    if driving is not None and asked.wheel_torque is not None:
        other = "torque" if asked.power is None else "power"
        raise ParameterError("wheel_torque", asked.wheel_torque, "other_is_given", REMOVED, other=other)
    keys = changed(asked, diameter_quotient=quotient_of(asked), lead_angle_deg=None)
    worm = worm_of(keys, keys.fillet_coefficient, keys.axial_thinning)
    hob_quotient(keys.hob_diameter_quotient, worm.diameter_quotient)
    if keys.number_of_teeth is not None:
        shift = shift_of(keys, worm.diameter_quotient, keys.number_of_teeth)
        keys = changed(keys, profile_shift_coefficient=shift, working_centre_distance=None)
    return keys, worm, driving


def _at_work(page: Sheet, drive: WormDrive, keys: WormKeys, driving: float | None) -> None:
    """Widths, places off the right ones, speeds, torques and strength of a drive, as far as they are asked for."""
    if any(x is not None for x in (keys.face_width, keys.worm_length, keys.outer_diameter)):
        _lengths(page, drive, keys)
    errors = AxisErrors(keys.centre_distance_error, math.radians(keys.axis_angle_error_deg), keys.wheel_axial_error)
    if errors.any:
        _off_places(page, drive, keys, errors)
    if keys.speed_rpm is not None:
        _speeds(page, drive, keys.speed_rpm)
    page.section("Torques and losses")
    # how the flank leans where it carries
    page.add("worm_pitch_axial_angle_deg", math.degrees(drive.pitch_axial_pressure_angle))
    formula = "arctan(tan({alpha_xw}) * cos({gamma_w}))"
    page.add("worm_pitch_normal_angle_deg", math.degrees(drive.pitch_normal_pressure_angle), formula)
    locks = math.tan(drive.pitch_lead_angle) * math.cos(drive.pitch_normal_pressure_angle)
    page.add("self_locking_friction", locks, "tan({gamma_w}) * cos({alpha_nw})")
    worth = _losses(page, drive, keys)
    torque = _torques(page, drive, keys, driving, worth)
    if torque is not None and keys.form_factor is not None:
        load = strength.Load(1e3 * torque, keys.form_factor, keys.width_factor, keys.speed_factor)
        _strength(page, drive, keys, load)


def _given(page: Sheet, keys: WormKeys, quotient: float) -> None:
    page.section("Given")
    page.told(axial_module=keys.module, diameter_quotient=quotient, number_of_starts=keys.number_of_starts)
    if keys.number_of_teeth is not None:
        page.told(worm_wheel_teeth=keys.number_of_teeth, profile_shift_coefficient=keys.profile_shift_coefficient)
    page.told(worm_form=keys.form, worm_pressure_angle_deg=keys.pressure_angle_deg)
    if keys.form == "ZK1":
        page.add("grinding_wheel_diameter", keys.grinding_wheel_diameter)
    page.told(addendum_coefficient=keys.addendum_coefficient, tip_clearance_coefficient=keys.tip_clearance_coefficient)
    page.add("worm_fillet_coefficient", keys.fillet_coefficient)
    page.told(axial_thinning=keys.axial_thinning or None)
    if keys.number_of_teeth is not None:
        page.add("hob_rounding_coefficient", keys.hob_rounding_coefficient)
        page.add("hob_diameter_quotient", hob_quotient(keys.hob_diameter_quotient, quotient))
        page.told(hob_thickening=keys.wheel_thinning or None)


def _dimensions(page: Sheet, worm: Worm, drive: WormDrive | None, worm_length: float | None) -> None:
    page.section(N_("Dimensions of worm and wheel") if drive else N_("Dimensions of the worm"))
    if drive:
        page.add("worm_ratio", drive.ratio, "{z2} / {z1}", _GOST)
        page.add("worm_centre_distance", drive.centre_distance, "0.5 * ({z2} + {q} + 2 * {x}) * {m}", _GOST)
    page.add("worm_reference_diameter", 2 * worm.reference_radius, "{q} * {m}", _GOST)
    if drive:
        page.add("wheel_reference_diameter", 2 * drive.reference_radius, "{z2} * {m}", _GOST)
        page.add("worm_pitch_diameter", 2 * drive.pitch_radius_of_worm, "({q} + 2 * {x}) * {m}", _GOST)
    page.add("lead_angle_deg", math.degrees(worm.lead_angle), "arctan({z1} / {q})", _GOST)
    if drive:
        formula = "arctan({z1} * {m} / {d_w1})"
        page.add("pitch_lead_angle_deg", math.degrees(drive.pitch_lead_angle), formula, _GOST)
    flank = worm.flank
    if isinstance(flank, InvoluteFlank):
        page.add("base_lead_cosine", math.cos(flank.base_lead_angle), "cos({alpha}) * cos({gamma})", _GOST)
        page.add("base_lead_angle_deg", math.degrees(flank.base_lead_angle), "arccos({cos_gamma_b})", _GOST)
        page.add("worm_base_diameter", 2 * flank.least_radius, "{z1} * {m} / tan({gamma_b})", _GOST)
    page.add("lead", worm.lead, "pi * {m} * {z1}", _GOST)
    page.add("thread_height", worm.tip_radius - worm.root_radius, "(2 * {h_a} + {c}) * {m}", _GOST)
    page.add("thread_addendum", worm.tip_radius - worm.reference_radius, "{h_a} * {m}", _GOST)
    page.add("worm_tip_diameter", 2 * worm.tip_radius, "{d1} + 2 * {h_a1}", _GOST)
    page.add("worm_root_diameter", 2 * worm.root_radius, "{d_a1} - 2 * {h1}", _GOST)
    page.add("worm_fillet_radius", worm.fillet_coefficient * worm.module, "{rho_f} * {m}", _GOST)
    if drive:
        _wheel(page, drive)
    else:
        page.told(worm_length=worm_length)


def _wheel(page: Sheet, drive: WormDrive) -> None:
    """Diameters of the wheel, and how wide and long both may be."""
    starts = drive.worm.number_of_starts
    page.add("throat_diameter", 2 * drive.tip_radius, "{d2} + 2 * ({h_a} + {x}) * {m}", _GOST)
    page.add("throat_radius", drive.throat_radius, "{a_w} - {d_a2} / 2", _GOST)
    page.add("wheel_root_diameter", 2 * drive.root_radius, "{d_a2} - 2 * {h1}", _GOST)
    page.add("most_outer_diameter", drive.most_outer_diameter, "{d_a2} + 6 * {m} / ({z1} + 2)", _GOST)
    number, of_starts, of_teeth = drive.least_worm_length_terms
    terms = [f"{share:g} * {{{symbol}}}" for share, symbol in ((of_starts, "z1"), (of_teeth, "z2")) if share]
    formula = " + ".join([f"{number:g}", *terms])
    page.add("least_worm_length", drive.least_worm_length, f"({formula}) * {{m}}", _GOST)
    if drive.worm.module < 10:
        page.add("ground_worm_length", drive.least_worm_length + 25, "{b1_min} + 25", _THESIS)
    share = 0.75 if starts <= 3 else 0.67
    page.add("most_face_width", drive.most_face_width, f"{share} * {{d_a1}}", _GOST)


def _sections(page: Sheet, worm: Worm, keys: WormKeys) -> None:
    """What follows from the exact surfaces."""
    page.section("Exact sections")
    page.add("axial_pressure_angle_deg", math.degrees(worm.axial_pressure_angle), "")
    less = " - {A}" if keys.axial_thinning else ""
    page.add("axial_thickness", 2 * worm.screw.half_thickness, f"pi * {{m}} / 2{less}")
    page.add("normal_thickness", 2 * worm.screw.half_thickness * math.cos(worm.lead_angle), "{s_x} * cos({gamma})")
    page.add("thread_tip_thickness", worm.tip_thickness, "")


def _measures(page: Sheet, thread: Thread, keys: WormKeys) -> None:
    """What is read on the thread: its chord, and over balls or wires."""
    chord, usual = reference_chord(thread), BALL * thread.worm.module
    page.section("Measured")
    page.told(thread_chord=chord.thickness, thread_chord_height=chord.height)
    ball = usual if keys.ball_diameter is None else keys.ball_diameter
    if (size := over_balls(thread, ball)) is not None:
        usual_told = ("", "") if keys.ball_diameter is not None else (f"{BALL} * {{m}}", _GOST)
        page.add("ball_diameter", ball, *usual_told, given=keys.ball_diameter is not None)
        page.add("over_balls", size)
    elif keys.ball_diameter is not None:
        cure = partial(nearest, lambda one: over_balls(thread, one) is not None, ball, usual)
        told = ParameterError("ball_diameter", ball, "no_pin_touches_there", cure)
        raise refusal(TOPIC, told, keys=keys)


def _lengths(page: Sheet, drive: WormDrive, keys: WormKeys) -> None:
    """How long the worm and how wide the wheel is, and what of it is used."""
    page.section("Length and width")
    if keys.face_width is not None:
        outer = drive.default_outer_diameter if keys.outer_diameter is None else keys.outer_diameter
        used = drive.worm_length_used(keys.face_width, outer / 2)
        if used is None:
            page.note("the wheel's corners do not touch the worm: its rim is wider than the mesh")
        else:
            page.add("worm_length_used", used, "")
    if keys.worm_length is not None:
        page.add("worm_length", keys.worm_length)
        for found in short_of("worm_length", keys.worm_length, drive.least_worm_length):
            page.note("the worm is shorter than {limit:.5g} mm", limit=Told(found.limit, up=True))
    if keys.face_width is not None:
        page.add("rim_width", keys.face_width)
        for found in beyond("face_width", keys.face_width, drive.most_face_width):
            page.note("the wheel's rim is wider than {limit:.5g} mm", limit=Told(found.limit, up=False))
    if keys.outer_diameter is not None:
        page.add("wheel_outer_diameter", keys.outer_diameter)
        for found in beyond("outer_diameter", keys.outer_diameter, drive.most_outer_diameter):
            page.note("the wheel's outer diameter is more than {limit:.5g} mm", limit=Told(found.limit, up=False))


def _wheel_keys(keys: WormKeys) -> WormWheelSpec:
    """The part that these keys tell; its hob is the worm without its thinning, and thicker by that of the wheel."""
    shared = {key: getattr(keys, key) for key in WormWheelSpec.__struct_fields__ if key in WormKeys.__struct_fields__}
    return WormWheelSpec(**shared | {"axial_thinning": keys.wheel_thinning})


def _wheel_remarks(page: Sheet, keys: WormKeys) -> None:
    """What the wheel's teeth had better not have, or why there are none."""
    spec = _wheel_keys(keys)
    try:
        found = WORM_WHEEL.report(spec, WORM_WHEEL.thing(spec, {})).findings
    except ParameterError as error:
        why = explained(refusal(TOPIC, error, keys=spec))
        page.note("such a wheel cannot be made, {key} = {value}: {why}", key=error.name, value=error.value, why=why)
    else:
        page.notes += [finding_message(finding) for finding in found]


def _off_places(page: Sheet, drive: WormDrive, keys: WormKeys, errors: AxisErrors) -> None:
    """The contact of the exact surfaces where the axes stand off their places."""
    try:
        thread = thread_of(drive.worm, keys.tip_rounding)
        found = contact_under(thread, WORM_WHEEL.thing(_wheel_keys(keys), {}).teeth, errors, None)
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error
    page.section("Axes off their places")
    for key in _ERRORS:
        page.add(key, getattr(keys, key))
    page.told(least_flank_gap=found.worst.gap, contact_verdict=found.verdict.value.upper())


def _speeds(page: Sheet, drive: WormDrive, speed_rpm: float) -> None:
    """Speeds of both shafts, and with which the flanks slide at the pitch point."""
    page.section("Speeds")
    page.add("worm_speed", speed_rpm, given=True)
    page.add("worm_wheel_speed", speed_rpm / drive.ratio, "{n1} / {u}")
    speed = math.pi * speed_rpm / 30 * drive.pitch_radius_of_worm
    page.add("worm_pitch_speed", speed, "pi * {n1} / 30 * {d_w1} / 2")
    page.add("worm_sliding_speed", speed / math.cos(drive.pitch_lead_angle), "{v_w} / cos({gamma_w})")


def _friction_angle(keys: WormKeys, drive: WormDrive) -> float:
    """Angle of friction in a thread of inclined flanks, rad."""
    return math.atan(keys.friction_coefficient / math.cos(drive.pitch_normal_pressure_angle))


def _losses(page: Sheet, drive: WormDrive, keys: WormKeys) -> float:
    """The efficiency, 1 where no friction is told."""
    if not keys.friction_coefficient:
        return 1.0
    friction = _friction_angle(keys, drive)
    page.add("friction_coefficient", keys.friction_coefficient)
    page.add("friction_angle_deg", math.degrees(friction), "arctan({f} / cos({alpha_nw}))")
    worth = strength.efficiency(drive, friction)
    page.add("worm_efficiency", worth, "tan({gamma_w}) / tan({gamma_w} + {rho_v})")
    page.add("back_driving_efficiency", strength.efficiency(drive, friction, back=True), "")
    if friction >= drive.pitch_lead_angle:
        page.note("the drive is self-locking: the wheel cannot turn the worm")
    return worth


def _torques(page: Sheet, drive: WormDrive, keys: WormKeys, driving: float | None, worth: float) -> float | None:
    """Torques and powers of both shafts, that of one given, and their forces; the torque on the wheel, N*m."""
    losses = " * {eta}" if worth < 1 else ""
    if keys.wheel_torque is not None:
        torque, driving = keys.wheel_torque, keys.wheel_torque / (drive.ratio * worth)
        page.add("wheel_torque", torque, given=True)
        page.add("worm_torque", driving, f"{{T2}} / ({{u}}{losses})")
        if keys.speed_rpm is not None:
            page.add("pair_power", driving * math.pi * keys.speed_rpm / 30, "{T1} * pi * {n1} / 30")
    elif driving is not None:
        torque = driving * drive.ratio * worth
        torque_steps(page, keys, driving, "worm_torque")
        page.add("wheel_torque", torque, "{T1} * {u}" + losses, _THESIS)
    else:
        return None
    if losses and keys.speed_rpm is not None:
        page.add("worm_power_out", driving * math.pi * keys.speed_rpm / 30 * worth, "{P} * {eta}")
    _forces(page, drive, keys, (driving, torque))
    return torque


def _forces(page: Sheet, drive: WormDrive, keys: WormKeys, torques: tuple[float, float]) -> None:
    """The forces between the flanks at the pitch point, by the torques on worm and wheel, N*m."""
    along = 2e3 * torques[1] / (2 * drive.reference_radius)
    page.add("worm_axial_force", along, "2000 * {T2} / {d2}")
    around = 2e3 * torques[0] / (2 * drive.pitch_radius_of_worm)
    page.add("worm_tangential_force", around, "2000 * {T1} / {d_w1}", _THESIS)
    # friction takes its share of the force along the worm, none of the radial one
    less = math.tan(_friction_angle(keys, drive)) * math.tan(drive.pitch_lead_angle)
    formula = "{F_a1} * tan({alpha_xw})" + (" / (1 - tan({rho_v}) * tan({gamma_w}))" if less else "")
    page.add("worm_radial_force", along * math.tan(drive.pitch_axial_pressure_angle) / (1 - less), formula)


def _strength(page: Sheet, drive: WormDrive, keys: WormKeys, load: strength.Load) -> None:
    """Bending and contact of the wheel's teeth; beside what the thesis prints."""
    worm = drive.worm
    page.section("Bending of the wheel's teeth")
    width = drive.most_face_width if keys.face_width is None else keys.face_width
    share = min(width / drive.most_face_width, 1.0)
    page.add("width_share", share, "{b2} / {b2_max}" if keys.face_width and share < 1 else "")
    page.told(
        form_factor=load.form_factor, width_factor=keys.width_factor, speed_factor=keys.speed_factor,
        tensile_strength=keys.tensile_strength, bending_life_factor=keys.bending_life_factor,
    )  # fmt: skip
    bending = 0.16 * keys.tensile_strength * keys.bending_life_factor
    page.add("allowed_bending_stress", bending, "0.16 * {sigma_b} * {K_FL}", _THESIS)
    acting = "{Y_F} * {K_b} * {K_v} * cos({gamma}) * 1000 * {T2} / ({q} * {z2} * {sigma_FP})"
    is_thesis = bool(page.printed)
    if is_thesis:
        printed = strength.least_module(drive, load, bending, 0.5)
        page.add("thesis_least_module", printed, f"cbrt(3 * {acting})", _THESIS)
    page.add("least_module", strength.least_module(drive, load, bending, share), f"cbrt(1.5 / {{psi}} * {acting})")
    page.section("Contact of the flanks")
    page.add("contact_life_factor", keys.contact_life_factor)
    contact = 0.75 * keys.tensile_strength * keys.contact_life_factor
    page.add("allowed_contact_stress", contact, "0.75 * {sigma_b} * {K_HL}", _THESIS)
    root = "170 * {q} / {z2} * sqrt((({z2} / {q} + 1) / {a_w})**3 * {K_b} * {K_v} * 1000 * {T2})"
    if is_thesis:
        page.add("thesis_contact_stress", 2 * strength.contact_stress(drive, load, 1.0), f"2 * {root}", _THESIS)
    stress = strength.contact_stress(drive, load, share)
    page.add("contact_stress", stress, f"{root} / sqrt({{psi}})")
    least = drive.most_face_width * (strength.contact_stress(drive, load, 1.0) / contact) ** 2
    page.add("least_rim_width", least, "{b2_max} * {psi} * ({sigma_H} / {sigma_HP})**2")
    if strength.least_module(drive, load, bending, share) > worm.module:
        page.note("the module is less than bending needs")
    if stress > contact:
        page.note("the contact stress is more than allowed")
