"""``higherpair calc power-module``: sections 2.2 to 2.4 of the thesis, the load it holds, and what play does to it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated

import numpy as np
from msgspec import Meta

from geometry.base import hertz
from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.curves.curve import Complex, Real
from geometry.gears.strength.gost21354 import ELASTICITY_FACTOR, contact_stress
from geometry.gears.strength.iso6336 import contact_ratio_factor, zone_factor
from geometry.kinematics.two_disk import TwoDisk
from parts.base.texts import N_, filled, message, words
from parts.gears.worm import page as worm_page
from parts.keys.base import mm, size
from parts.mates.pages.contour_marks import checked_picture
from parts.mates.pages.module_load import MODULUS, Carried, LoadKeys, load_sections
from parts.mates.pages.power_table import DRIVES, given
from parts.pages.error_map import ErrorMap
from parts.pages.inputs import calculation
from parts.pages.misprints import printed_for
from parts.pages.module_rules import CONDITIONS, DRIVERS, RULES, of_orientation, sizes, valued
from parts.pages.page import Section, Sheet, pretty

TOPIC = "power-module"
_GEAR, _BALLS = "thesis, 2.3", "thesis, 2.4"
_STRENGTH = Meta(description="factor of the strength calculation", gt=0, le=100)
_Factor = Annotated[float, _STRENGTH]
_Stress = Annotated[float, size("MPa", "stress", above=0, most=100_000)]
_Play = Annotated[float, mm("play", least=0, most=10)]
# what changes nothing in the thesis's own calculations
_BESIDE_THE_THESIS = (
    "picture", "orientation", "force_z", "moment", "load_height", "x", "y", "elbow", "ball_pressure_limit",
)  # fmt: skip
_MAP_BANDS, _MAP_POINTS = 48, ((0.0, 1), (0.35, 6), (0.65, 10), (0.92, 14))

_PIVOT_CIRCLE = mm(
    "radius of the circle of the cranks' pivots; default: r_pivots of the assembly", above=0, most=1e4, example=51.0
)


class PowerModuleKeys(LoadKeys, kw_only=True):
    """Keys of the topic; defaults are the thesis's."""

    rim_width: Annotated[float, mm("width of the worm wheels' rims", above=0, most=10_000)] = 26.0
    rim_strength: Annotated[_Stress, Meta(description="tensile strength of the rims")] = 200.0
    form_factors: Annotated[tuple[_Factor, _Factor], Meta(description="Y_F2 of both wheels")] = (1.26, 1.27)
    module: Annotated[float, mm("module of the pair 11-12", above=0, most=1000)] = 3.0
    face_width: Annotated[float, mm("width of the pair 11-12", above=0, most=10_000)] = 25.0
    bending_limit: Annotated[_Stress, Meta(description="sigma_Flim of the pair's teeth")] = 580.0
    contact_limit: Annotated[_Stress, Meta(description="sigma_Hlim of the pair's teeth")] = 850.0
    balls: Annotated[int, Meta(ge=3, le=10_000, description="balls in one turn")] = 180
    loaded_turns: Annotated[int, Meta(ge=0, le=1, description="i2, turns of balls that work against i1 = 1")] = 0
    radial_factor: Annotated[float, Meta(gt=0, le=10, description="k4 of the radial stiffness")] = 0.1
    worm_backlash: Annotated[_Play, Meta(description="play on the reference circle of either worm wheel")] = 0.05
    pair_backlash: Annotated[_Play, Meta(description="play on the pitch circles of the pair 11-12")] = 0.05
    pitch_error: Annotated[_Play, Meta(description="total pitch error of each of the three wheels")] = 0.0
    wheel_backlash: Annotated[_Play, Meta(description="play of each mesh of the idlers")] = 0.05
    pin_clearance: Annotated[_Play, Meta(description="play of each pin of a crank, diametral")] = 0.02
    pivot_circle: Annotated[float, _PIVOT_CIRCLE] | None = None
    picture: Annotated[str, Meta(description="SVG file of the error map to write")] | None = None

    @property
    def lengths(self) -> tuple[float, float]:
        """L1, which ring and pinion give, and L2, as long where none is given, mm."""
        arm = self.module * (self.pair_teeth[1] - self.pair_teeth[0]) / 2
        first, second = self.arms or (arm, arm)
        if abs(first - arm) > 1e-9:
            raise ParameterError(
                "arms", [first, second], "arm_of_ring_and_pinion", Nearest([arm, second]), arm=arm
            )  # fmt: skip
        return first, second


@calculation(TOPIC, PowerModuleKeys)
def sheet(keys: PowerModuleKeys) -> Sheet:
    """The calculation of one module."""
    checked_picture(TOPIC, keys.picture, (".svg",))
    page = Sheet(TOPIC, N_("Two-disk power module"))
    if keys == PowerModuleKeys(**{name: getattr(keys, name) for name in _BESIDE_THE_THESIS}):
        page.printed = printed_for("power module")
    keys.table  # noqa: B018 - the ring is the larger one
    least = keys.ball_diameter / 2
    if keys.groove_radius is not None and not least < keys.groove_radius:
        raise ParameterError("groove_radius", keys.groove_radius, "groove_below_ball", None, least=least)
    given(page, keys)
    found = _found(keys, keys.orientation)
    carried = load_sections(page, keys, found)
    _worms(page, keys, carried.torques)
    _pair(page, keys, carried.torques[1])
    _ball_ring(page, keys, carried, found)
    _orientation(page, keys)
    _play(page, keys)
    _sizes(page, keys, found)
    return page


def _found(keys: PowerModuleKeys, orientation: str) -> dict[str, float]:
    """Sizes of the assembly ``power_module`` with these drivers."""
    own = {
        "module": keys.module, "teeth_19": keys.pair_teeth[0], "teeth_21": keys.pair_teeth[1],
        "worm_module": keys.worm_module, "worm_quotient": keys.diameter_quotient, "worm_teeth_25": keys.worm_ratios[0],
        "worm_teeth_23": keys.worm_ratios[1], "worm_wheel_width": keys.rim_width, "face_width": keys.face_width,
        "balls": keys.balls, "ball": keys.ball_diameter,
    }  # fmt: skip
    found = sizes({**DRIVERS, **own}, orientation)
    return found | ({} if keys.groove_radius is None else {"r_groove": keys.groove_radius})


def _sizes(page: Sheet, keys: PowerModuleKeys, found: dict[str, float]) -> None:
    """Every rule by which the assembly ``power_module`` is sized, and its limits; what lacks as notes."""
    rules = of_orientation(RULES, keys.orientation)
    heads = ((N_("size"), ""), (N_("positions"), ""), (N_("rule"), ""), (N_("reason"), ""), (N_("value"), "mm"))
    rows = ((r.name, ", ".join(map(str, r.positions)), _printed(r.made_of), r.reason, found[r.name]) for r in rules)
    page.table("sizes", N_("Sizes of the assembly power_module, by rules"), heads, rows)
    _limits(page, keys, found)


def _printed(made_of: str) -> str:
    """A rule as formulas are printed; it has no function that languages write otherwise."""
    return pretty(made_of, words("en"))


def _limits(page: Sheet, keys: PowerModuleKeys, found: dict[str, float]) -> None:
    """What must be left between and within parts, and how much is."""
    limits = of_orientation(CONDITIONS, keys.orientation)
    left = [valued(condition.made_of, found) for condition in limits]
    heads = ((N_("driving size"), ""), (N_("what must be left"), ""), (N_("rule"), ""), (N_("left"), "mm"))
    counts = {"teeth": keys.pair_teeth, "worm_teeth": keys.worm_ratios}
    known: dict[str, float | str] = found | {name: "{:g}, {:g}".format(*pair) for name, pair in counts.items()}
    rows = [
        (f"{c.driver} = {known[c.driver]}", c.reason, _printed(c.made_of), a) for c, a in zip(limits, left, strict=True)
    ]
    page.table("limits", N_("Limits of the assembly power_module"), heads, rows)
    for condition, length in zip(limits, left, strict=True):
        if length < 0:
            told = message("lacks {lacks} mm: {what}", lacks=f"{-length:.6g}", what=filled(condition.reason))
            page.note("assembly power_module, {driver}: {what}", driver=condition.driver, what=told)


def _worms(page: Sheet, keys: PowerModuleKeys, torques: tuple[float, float]) -> None:
    """Both drives as ``calc worm`` has them."""
    for name, ratio, form, torque in zip(DRIVES, keys.worm_ratios, keys.form_factors, torques, strict=True):
        table = {"module": keys.worm_module, "diameter_quotient": keys.diameter_quotient, "number_of_teeth": ratio,
                 "torque": torque / ratio / keys.efficiency, "form_factor": form, "face_width": keys.rim_width,
                 "tensile_strength": keys.rim_strength, "friction_coefficient": keys.friction_coefficient}  # fmt: skip
        own = worm_page.sheet(table)
        for section in own.sections[1:]:
            title = message("{drive}: {what}", drive=filled(DRIVES[name]), what=filled(section.title))
            page.sections.append(Section(title, [replace(step, of=DRIVES[name]) for step in section.steps]))
        page.known |= {f"{key}_{name}": known for key, known in own.known.items()}
        page.notes += [note for note in own.notes if note not in page.notes]


def _pair(page: Sheet, keys: PowerModuleKeys, torque: float) -> None:
    """Section 2.3: bending gives the module, contact the width."""
    pinion, ratio = keys.pair_teeth[0], keys.table.ratio
    page.section("Pair 11-12: bending")
    page.name("T2_ring", "T2_II" if keys.held else "T_FII")
    own = torque / ratio
    page.add("pair_torque", own, "{T2_ring} / {u}", _GEAR)
    page.told(
        fatigue_limit_bending=keys.bending_limit, life_factor=1.0, roughness_factor=1.05, size_factor=1.0,
        gradient_factor=0.98, bending_safety=1.7, reversing_factor=0.75,
    )  # fmt: skip
    allowed = keys.bending_limit / 1.7 * 1.05 * 0.98 * 0.75
    page.add("pair_allowed_bending", allowed,
             "{sigma_Flim} * {Y_N} / {S_F} * {Y_R} * {Y_X} * {Y_d} * {K_R}", _GEAR)  # fmt: skip
    page.told(module_factor=14.0, pair_width_factor=1.05, pair_form_factor=3.55, width_ratio=0.05)
    least = 14 * (own * 1.05 * 3.55 * ratio / (keys.pair_teeth[1] ** 2 * 0.05 * allowed)) ** (1 / 3)
    formula = "{K_m} * cbrt({T_11} * {K_Fb} * {Y_FS} * {u} / ({z_12}**2 * {psi_bd} * {sigma_FP1}))"
    page.add("pair_least_module", least, formula, _GEAR)
    page.add("module", keys.module)
    page.section("Pair 11-12: contact")
    diameter = keys.module * pinion
    page.add("reference_diameter", diameter, "{m} * {z_11}", _GEAR, symbol="d_11")
    page.add("face_width", keys.face_width)
    along = 2000 * own / diameter
    page.add("circumferential_force", along, "2000 * {T_11} / {d_11}", _GEAR)
    rough = 1.88 - 3.2 * (1 / pinion - 1 / keys.pair_teeth[1])
    page.add("approximate_contact_ratio", rough, "1.88 - 3.2 * (1 / {z_11} - 1 / {z_12})", _GEAR)
    page.add("helix_angle_deg", 0.0)
    page.add("overlap_ratio", 0.0, "{b} * sin({beta}) / (pi * {m})", _GEAR)
    page.told(
        elasticity_factor=ELASTICITY_FACTOR,
        zone_factor=2.49,
        overlap_factor=0.84,
        outer_load_factor=1.0,
        pair_speed_factor=1.01,
    )
    alpha = math.radians(20)
    page.add("exact_zone_factor", zone_factor(alpha, alpha, 0.0), "sqrt(4 / sin(2 * 20 * pi / 180))")
    page.add("exact_overlap_factor", contact_ratio_factor(rough, 0.0), "sqrt((4 - {eps_r}) / 3)")
    factors, load = ELASTICITY_FACTOR * 2.49 * 0.84, along * 1.01 * 1.05
    stress = contact_stress(factors, load, keys.face_width, diameter, ratio, -1)
    root = "sqrt({F_t} * {K_A} * {K_Hv} * {K_Fb} / ({b} * {d_11}) * ({u} - 1) / {u})"
    page.add("pair_contact_stress", stress, "{Z_E} * {Z_H} * {Z_eps} * " + root, _GEAR)
    page.told(
        contact_limit=keys.contact_limit, contact_safety=1.2, contact_roughness_factor=0.95,
        circumferential_speed_factor=0.99,
    )  # fmt: skip
    bearable = keys.contact_limit / 1.2 * 0.95 * 0.99
    page.add("pair_allowed_contact", bearable, "{sigma_Hlim} / {S_H} * {Z_R} * {Z_v}", _GEAR)
    width = keys.face_width * (stress / bearable) ** 2
    page.add("pair_least_width", width, "{b} * ({sigma_Hp} / {sigma_HPp})**2")
    if least > keys.module:
        page.note("the module of the pair 11-12 is less than bending needs")
    if stress > bearable:
        page.note("the contact stress of the pair 11-12 is more than allowed")


def _ball_ring(page: Sheet, keys: PowerModuleKeys, carried: Carried, found: Mapping[str, float]) -> None:
    """Section 2.4 as the thesis has it, with the right radial force of the worm, and with all forces as vectors where
    they are most; then Hertz for the groove.
    """
    page.section("Ring of balls: forces")
    page.name("F_a", "F_t1_II")
    page.name("F_RC_right", "F_r_II")
    axial, right, along_pitch = (page.known[name].value for name in ("F_a", "F_RC_right", "F_t"))
    assert isinstance(axial, float)
    assert isinstance(right, float)
    assert isinstance(along_pitch, float)
    gear = along_pitch * math.tan(math.radians(20))
    page.add("pair_radial_force", gear, "{F_t} * tan(20 * pi / 180)", _BALLS)
    page.add("thesis_worm_radial_force", axial * math.tan(math.radians(20)), "{F_a} * tan(20 * pi / 180)", _BALLS)
    turns = keys.loaded_turns
    share = 1 + turns ** (2 / 3) if turns else 1.0
    page.add("loaded_turns", turns)
    page.add("preload", axial / (1.5 * share), f"{{F_a}} / {1.5 * share:g}", _BALLS)
    page.told(balls=keys.balls, guide_ball_diameter=keys.ball_diameter, radial_factor=keys.radial_factor)
    cases = [("thesis", N_("by the thesis"), gear + axial * math.tan(math.radians(20)), "{F_RZ} + {F_RC}"),
             ("right", N_("right"), gear + right, "{F_RZ} + {F_RC_right}")]  # fmt: skip
    if carried.ring_radial:
        cases.append(("most", N_("under all forces where they are most"), carried.ring_radial, ""))
    hold, balls, row = axial / (1.5 * share), keys.balls, "z_b"
    for key, title, force, formula in cases:
        page.section("Ring of balls: stiffness, {what}", what=filled(title))
        if key == "most":
            page.add("lifting_force", carried.ring_lift)
            hold = carried.ring_lift / (1.5 * share)
            page.add("preload", hold, f"{{F_l}} / {1.5 * share:g}")
            # as many as the assembly has in this row
            balls, row = int(found["large_balls"]), "z_r"
            page.add("balls", balls, symbol="z_r", key=row)
        angle = math.atan(axial / force)
        source = _BALLS if key == "thesis" else ""
        page.add("bearing_radial_force", force, formula, source)
        page.add("contact_angle_deg", math.degrees(angle), "arctan({F_a} / {F_R})", source)
        load = 1e5 * balls * math.sin(angle) ** 2.5 * math.sqrt(1.25 * keys.ball_diameter)
        formula = f"100000 * {{{row}}} * sin({{alpha_b}})**2 * sqrt(sin({{alpha_b}}) * 1.25 * {{d_b}})"
        page.add("turn_capacity", load, formula, source)
        along = 1.5 * load ** (2 / 3) * hold ** (1 / 3) * share
        page.add("axial_stiffness", along, f"{1.5 * share:g} * cbrt({{C}}**2 * {{F_H}})", source)
        page.add("preload_ratio", hold / (force * math.tan(angle)), "{F_H} / ({F_R} * tan({alpha_b}))", source)
        across = keys.radial_factor * along / (1.5 * math.tan(angle) ** 2 * share)
        page.add("radial_stiffness", across, f"{{k4}} * {{j_a}} / ({1.5 * share:g} * tan({{alpha_b}})**2)", source)
    page.section("Ring of balls: Hertz, and its place")
    least = keys.ball_diameter / math.sin(math.pi / keys.balls)
    page.add("least_ball_circle", least, "{d_b} / sin(pi / {z_b})")
    root = keys.module * (keys.pair_teeth[1] + 2.5)
    page.add("ring_root_diameter", root, "{m} * ({z_12} + 2.5)")
    page.add("ball_wall", (least - root) / 2 - keys.ball_diameter / 2, "({D_b} - {d_f12} - {d_b}) / 2")
    page.add("groove_radius", found["r_groove"])
    ball = keys.ball_diameter / 2
    flat = 1 / ball - 1 / found["r_groove"]
    inner, outer = (1 / ball + sense / (found["r_large"] - sense * ball) for sense in (1, -1))
    both = [hertz.stiffness((flat, sharp), MODULUS) for sharp in (inner, outer)]
    # two contacts one behind the other under the same load
    hertzian = sum(k ** (-2 / 3) for k in both) ** -1.5
    page.add("ball_stiffness", 1e5 * math.sqrt(1.25 * keys.ball_diameter), "100000 * sqrt(1.25 * {d_b})", _BALLS)
    page.add("hertz_stiffness", hertzian)
    if (least - root) / 2 < keys.ball_diameter / 2:
        page.note("there is no room for so many balls outside the ring's teeth")


def _orientation(page: Sheet, keys: PowerModuleKeys) -> None:
    """By how much the platform can turn in its play, with idlers and with cranks: why cranks are the default."""
    page.section("Play of the platform's turn")
    page.add("wheel_backlash", keys.wheel_backlash)
    # each mesh at half an arm, the idler half as large as the wheels beside it
    play = 6 * keys.wheel_backlash * sum(1 / arm for arm in keys.lengths)
    page.add("platform_play_deg", math.degrees(play), "6 * {j_6} * (1 / {L1} + 1 / {L2})", of=N_("idlers"))
    page.add("crank_pin_clearance", keys.pin_clearance)
    circle = keys.pivot_circle or _found(keys, "cranks")["r_pivots"]
    page.add("pivot_circle", circle)
    play = 4 * keys.pin_clearance / (math.cos(math.pi / 6) * circle)
    page.add("platform_play_deg", math.degrees(play), "4 * {c_p} / ({r_p} * cos(pi / 6))", of=N_("cranks"))


def _play(page: Sheet, keys: PowerModuleKeys) -> None:
    """What play in the three meshes does to O3, over the workspace; or the turn of the thesis's platform."""
    table = keys.table
    wheels = [keys.worm_module * ratio / 2 for ratio in keys.worm_ratios]
    slack = [(keys.worm_backlash + keys.pitch_error) / radius for radius in wheels]
    slack.append((keys.pair_backlash + keys.pitch_error) / (keys.module * keys.pair_teeth[0] / 2))
    least, most = table.reach
    radii = np.linspace(least, most, _MAP_BANDS + 1)
    delta, beta = table.inverse(np.asarray(1j * radii, dtype=complex))
    parts, worst = _reached(table, delta, beta, slack)
    heads = ((name, "mm") for name in ("r", "I", "II", "11-12", "Σ"))
    rows = np.stack([radii, *(np.abs(p) for p in parts), worst], 1)
    title = N_("Error of the platform's axis by the play of drive I, drive II and the pair, and of all, at most")
    page.table("errors", title, heads, rows[::4])
    page.picture_file = keys.picture
    if keys.orientation == "thesis":
        turn = np.degrees(table.platform_turn(beta, keys.orientation_teeth))
        page.picture = ErrorMap(N_("Turn of the platform by the wheels 6, 7, 8 of the thesis"), "°",
                                tuple(map(float, radii)), tuple(map(float, turn[1:])))  # fmt: skip
        return
    reached = []
    for share, count in _MAP_POINTS:
        for k in range(count):
            place = complex((least + (most - least) * share) * np.exp(2j * math.pi * k / count))
            corners = []
            for elbow in (1, -1):
                at = table.inverse(place, elbow)
                corners.append(_zonotope([complex(p) for p in _reached(table, *at, slack)[0]]))
            reached.append((place, (corners[0], corners[1])))
    largest = float(worst.max())
    magnified = max(
        (step * 10.0**k for k in range(6) for step in (1, 2, 5) if step * 10**k * largest < most / 9), default=1.0
    )
    page.picture = ErrorMap(
        N_("Error of the platform's axis by play, at most"), "mm", tuple(map(float, radii)),
        tuple(map(float, np.maximum(worst[1:], worst[:-1]))), tuple(reached),
        (N_("First elbow, beta > 0"), N_("Second elbow, beta < 0")), magnified,
    )  # fmt: skip


def _reached(table: TwoDisk, delta: Real, beta: Real, slack: list[float]) -> tuple[list[Complex], Real]:
    """What the play of drive I, drive II and the pair moves O3 by, and the most that all of them do, mm."""
    first, second = table.drive_jacobian(delta, beta)
    parts = [first * slack[0], second * slack[1], table.jacobian(delta, beta)[1] * slack[2]]
    sums = [np.abs(parts[0] + a * parts[1] + b * parts[2]) for a in (1, -1) for b in (1, -1)]
    return parts, np.max(sums, axis=0)


def _zonotope(parts: list[complex]) -> Complex:
    """Corners of all sums of shares (-1/2 to 1/2) of vectors, counter-clockwise."""
    ways = sorted((p if p.imag > 0 or (p.imag == 0 and p.real > 0) else -p for p in parts), key=np.angle)
    corner = -sum(ways) / 2
    found = []
    for way in [*ways, *(-w for w in ways)]:
        found.append(corner)
        corner += way
    return np.array(found)
