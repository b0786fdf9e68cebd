"""One position of a cam whose follower sits on a connecting rod, in numbers: the linkage, then Savvin's equations.

The values come from the cam's own series; the formulas beside them are Savvin's, right where the source misprints.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.base.record import Record
from geometry.base.series import derived, quotient
from geometry.cams.plane.coupler import LinkageCam
from geometry.kinematics.linkage import RockerDrive, RockerGuide, SliderDrive, SliderGuide
from parts.pages.misprints import SAVVIN
from parts.pages.page import Sheet

# velocities below this share of the sizes, per rad, are those of a follower that stands still
_STILL = 1e-9
# alpha_2 - alpha_1, as the equations have it
_BETWEEN = "{alpha_2} - {alpha_1}"
# symbols of x and y of a complex quantity
Names = tuple[str, str]


class Position(Record):
    """A cam at one cam angle (rad): S and points with derivatives over the cam angle, complex, fixed frame, mm."""

    cam: LinkageCam
    angle: float
    lift: tuple[float, float, float]
    joint: tuple[complex, complex, complex]
    far: tuple[complex, complex, complex]
    centre: tuple[complex, complex, complex]
    turn: complex
    rates: tuple[float, float]

    @property
    def turned(self) -> tuple[complex, complex, complex]:
        """The reference point in the cam's frame with its derivatives: A + i B."""
        z, first, second = self.centre
        back = cmath.exp(-1j * self.angle)
        return z * back, (first - 1j * z) * back, (second - 2j * first - z) * back

    @property
    def axes(self) -> float:
        """alpha_2, rad: of the coupler; of a flat face its own."""
        return cmath.phase(self.turn) + (self.cam.mount.direction - math.pi / 2 if self.cam.is_flat else 0.0)


def position_at(cam: LinkageCam, angle: float) -> Position:
    """The position at a cam angle, rad; at a joint of the motion the one that follows."""
    at = np.float64(angle)
    lift = tuple(float(cam.motion.value(at, k)) for k in range(3))
    series = [np.float64(x) for x in (lift[0], lift[1], lift[2] / 2)]
    joint, turn = cam.mount.linkage.pose(series)
    rate = quotient(derived(turn), turn)

    def whole(point: complex) -> tuple[complex, complex, complex]:
        first, second, third = (complex(a + point * e) for a, e in zip(joint, turn, strict=True))
        return first, second, 2 * third

    return Position(
        cam,
        angle,
        (lift[0], lift[1], lift[2]),
        whole(0j),
        whole(complex(cam.mount.linkage.coupler_length)),
        whole(cam.mount.point),
        complex(turn[0]),
        (float(rate[0].imag), float(rate[1].imag)),
    )


def point(page: Sheet, names: Names, value: complex, formulas: Names = ("", ""), sources: Names = ("", "")) -> None:
    """x and y of a point or a velocity."""
    for name, part, formula, source in zip(names, (value.real, value.imag), formulas, sources, strict=True):
        page.add(name, part, formula, source)


def position_steps(page: Sheet, at: Position) -> None:
    """All of one position: motion, linkage, relative motion, contact, pressure angles, curvature."""
    degrees = math.degrees(at.angle)
    # as typed
    shown = f"{degrees:.9g}"
    page.section("Position at cam angle {angle} deg: the linkage", angle=shown)
    page.add("position_deg", degrees)
    _motion(page, at)
    _drive(page, at)
    _guide(page, at)
    _follower(page, at)
    page.section("Position at cam angle {angle} deg: the cam", angle=shown)
    _relative(page, at)
    _contact(page, at)
    _pressure(page, at)
    _curvature(page, at)


def _motion(page: Sheet, at: Position) -> None:
    """S, S', S'' of the driven member."""
    swings = at.cam.swings
    page.add(*(("position_swing_deg", math.degrees(at.lift[0])) if swings else ("position_lift", at.lift[0])))
    page.add("position_angular_velocity" if swings else "position_velocity", at.lift[1])
    page.add("position_angular_acceleration" if swings else "position_acceleration", at.lift[2])


def _drive(page: Sheet, at: Position) -> None:
    """Joint A with its derivatives."""
    drive = at.cam.mount.linkage.drive
    names = [(f"joint_a_x{k}", f"joint_a_y{k}") for k in ("", "1", "2")]
    if isinstance(drive, SliderDrive):
        for pair, value, start, order in zip(names, at.joint, ("{x_O} + ", "", ""), ("S", "S1", "S2"), strict=True):
            up = start.replace("x", "y")
            point(page, pair, value, (f"{start}{{{order}}} * cos({{delta_1}})", f"{up}{{{order}}} * sin({{delta_1}})"))
        return
    assert isinstance(drive, RockerDrive)
    sign, minus = ("+", "-") if drive.sense > 0 else ("-", "")
    plus = "-" if drive.sense < 0 else ""
    angle = math.degrees(drive.start_angle + drive.sense * at.lift[0])
    page.add("driven_angle_deg", angle, f"{{psi_0}} {sign} {{S}}")
    point(page, names[0], at.joint[0], ("{x_O} + {l_1} * cos({psi})", "{y_O} + {l_1} * sin({psi})"))
    first = (f"{minus}{{l_1}} * sin({{psi}}) * {{S1}}", f"{plus}{{l_1}} * cos({{psi}}) * {{S1}}")
    point(page, names[1], at.joint[1], first)
    other = "-" if drive.sense > 0 else "+"
    second = (
        f"-{{l_1}} * ({{S1}}**2 * cos({{psi}}) {sign} {{S2}} * sin({{psi}}))",
        f"-{{l_1}} * ({{S1}}**2 * sin({{psi}}) {other} {{S2}} * cos({{psi}}))",
    )
    point(page, names[2], at.joint[2], second)


def _guide(page: Sheet, at: Position) -> None:
    """The coupler's angle, the transmission angle, joint B and how the coupler turns."""
    linkage = at.cam.mount.linkage
    guide, arm = linkage.guide, linkage.coupler_length
    if isinstance(guide, RockerGuide):
        theta = _rocker_guide(page, at, guide, arm)
        formula = "{chi} + {beta}" if guide.side > 0 else "{chi} - {beta}"
        page.add("coupler_angle_deg", theta, formula)
        mu = "arccos(abs(({b}**2 + {c}**2 - {q}**2) / (2 * {b} * {c})))"
        across = abs((at.turn.conjugate() * (at.far[0] - guide.pivot)).imag) / guide.length
    else:
        assert isinstance(guide, SliderGuide)
        height = ((at.joint[0] - guide.point) * cmath.exp(-1j * guide.direction)).imag
        page.add("guide_height", height, "({y_A} - {y_C}) * cos({delta}) - ({x_A} - {x_C}) * sin({delta})")
        lean = math.degrees(math.asin(height / arm))
        page.add("rod_lean_deg", lean, "arctan({h} / sqrt({b}**2 - {h}**2))")
        ahead = guide.side > 0
        theta = math.degrees(guide.direction) + (-lean if ahead else 180 + lean)
        page.add("coupler_angle_deg", theta, "{delta} - {lam}" if ahead else "{delta} + {lam} + pi")
        mu = "arccos(abs({h}) / {b})"
        across = abs((at.turn * cmath.exp(-1j * guide.direction)).real)
    page.add("transmission_angle_deg", math.degrees(math.asin(min(1.0, across))), mu)
    point(page, ("joint_b_x", "joint_b_y"), at.far[0], ("{x_A} + {b} * cos({theta})", "{y_A} + {b} * sin({theta})"))
    _turning(page, at, rocks=isinstance(guide, RockerGuide))


def _rocker_guide(page: Sheet, at: Position, guide: RockerGuide, arm: float) -> float:
    """The triangle A, B, C; the coupler's angle, degrees."""
    way = guide.pivot - at.joint[0]
    page.add("guide_distance", abs(way), "sqrt(({x_C} - {x_A})**2 + ({y_C} - {y_A})**2)")
    # the half angle knows its quadrant, but not the direction of -x
    known = way.real + abs(way) > _STILL * abs(way)
    direction = math.degrees(cmath.phase(way))
    formula = "2 * arctan(({y_C} - {y_A}) / ({x_C} - {x_A} + {q}))"
    page.add("guide_line_angle_deg", direction, formula if known else "")
    cosine = (abs(way) ** 2 + arm**2 - guide.length**2) / (2 * abs(way) * arm)
    beta = math.degrees(math.acos(cosine))
    page.add("rod_angle_deg", beta, "arccos(({b}**2 + {q}**2 - {c}**2) / (2 * {b} * {q}))")
    return direction + guide.side * beta


def _turning(page: Sheet, at: Position, *, rocks: bool) -> None:
    """omega_2 and its change: B moves square to its rocker, or along its line."""
    if rocks:
        along, across = ("{x_B} - {x_C}", "{y_B} - {y_C}")
        down = f"({{b}} * (sin({{theta}}) * ({along}) - cos({{theta}}) * ({across})))"
        first = f"({{x_A1}} * ({along}) + {{y_A1}} * ({across})) / {down}"
    else:
        down = "({b} * cos({theta} - {delta}))"
        first = f"({{x_A1}} * sin({{delta}}) - {{y_A1}} * cos({{delta}})) / {down}"
    page.add("coupler_velocity", at.rates[0], first)
    point(
        page,
        ("joint_b_x1", "joint_b_y1"),
        at.far[1],
        ("{x_A1} - {omega_2} * ({y_B} - {y_A})", "{y_A1} + {omega_2} * ({x_B} - {x_A})"),
    )
    x2, y2 = "({x_A2} - {omega_2}**2 * ({x_B} - {x_A}))", "({y_A2} - {omega_2}**2 * ({y_B} - {y_A}))"
    if rocks:
        second = f"({x2} * ({along}) + {y2} * ({across}) + {{x_B1}}**2 + {{y_B1}}**2) / {down}"
    else:
        second = f"({x2} * sin({{delta}}) - {y2} * cos({{delta}})) / {down}"
    page.add("coupler_acceleration", at.rates[1], second)


def _follower(page: Sheet, at: Position) -> None:
    """The follower's reference point O_2 with its derivatives, and its axes."""
    x, y = "({x_02} - {x_A})", "({y_02} - {y_A})"
    first = (
        "{x_A} + {xi_p} * cos({theta}) - {eta_p} * sin({theta})",
        "{y_A} + {xi_p} * sin({theta}) + {eta_p} * cos({theta})",
    )
    point(page, ("reference_x", "reference_y"), at.centre[0], first)
    second = (f"{{x_A1}} - {{omega_2}} * {y}", f"{{y_A1}} + {{omega_2}} * {x}")
    point(page, ("reference_x1", "reference_y1"), at.centre[1], second)
    third = (
        f"{{x_A2}} - {{eps_2}} * {y} - {{omega_2}}**2 * {x}",
        f"{{y_A2}} + {{eps_2}} * {x} - {{omega_2}}**2 * {y}",
    )
    point(page, ("reference_x2", "reference_y2"), at.centre[2], third)
    theta = float(page.known["theta"].value)
    if at.cam.is_flat:
        page.add("follower_angle_deg", theta + math.degrees(at.cam.mount.direction) - 90, "{theta} + {tau} - pi / 2")
    else:
        page.add("follower_angle_deg", theta, "{theta}")
    page.add("relative_turning", at.rates[0] - 1, "{omega_2} - 1")


def _relative(page: Sheet, at: Position) -> None:
    """(6), (7) with derivatives; the cam's axis is both origins, alpha_1 its angle, omega_1 = 1."""
    cos, sin = "cos({alpha_1})", "sin({alpha_1})"
    rows = (
        ("", "{x_02}", "{y_02}", ("Savvin (6)", "Savvin (7)")),
        ("1", "({x_021} + {y_02})", "({y_021} - {x_02})", ("", "")),
        ("2", "({x_022} + 2 * {y_021} - {x_02})", "({y_022} - 2 * {x_021} - {y_02})", ("", "")),
    )
    for value, (order, x, y, sources) in zip(at.turned, rows, strict=True):
        formulas = (f"{y} * {sin} + {x} * {cos}", f"{y} * {cos} - {x} * {sin}")
        point(page, (f"savvin_a{order}", f"savvin_b{order}"), value, formulas, sources)


def _contact(page: Sheet, at: Position) -> None:
    """(11) to (22): the contact in both frames, and the sliding."""
    cam, kind = at.cam, str(at.cam.kind)
    profile = complex(cam.profile_point(at.angle))
    speed = abs(at.turned[1])
    if kind == "pointed":
        point(page, ("contact_x1", "contact_y1"), profile, ("{A}", "{B}"), ("Savvin (4)", "Savvin (5)"))
        page.add("path_speed", speed, "sqrt({A1}**2 + {B1}**2)")
        page.add("sliding_velocity", float(cam.sliding_velocity(at.angle)), "{w}")
        return
    seen = at.turned[1] * cmath.exp(1j * (at.angle - at.axes))
    for name, value, formula, key in (
        ("savvin_f", -seen.imag, f"{{A1}} * sin({_BETWEEN}) - {{B1}} * cos({_BETWEEN})", "12"),
        ("savvin_r", seen.real, f"{{A1}} * cos({_BETWEEN}) + {{B1}} * sin({_BETWEEN})", "13"),
    ):
        page.add(name, value, formula, f"Savvin ({key})")
        page.mark_misprint(SAVVIN[key])
    place = (complex(cam.contact(at.angle)) - at.centre[0]) * cmath.exp(-1j * at.axes)
    if cam.is_flat:
        page.add("contact_x2", place.real, "{F} / {W}", "Savvin (11)")
        formulas = (f"{{A}} + {{xi_2}} * cos({_BETWEEN})", f"{{B}} + {{xi_2}} * sin({_BETWEEN})")
        point(page, ("contact_x1", "contact_y1"), profile, formulas, ("Savvin (15)", "Savvin (16)"))
        page.add("sliding_velocity", float(cam.sliding_velocity(at.angle)), "{R}")
        return
    page.add("path_speed", speed, "sqrt({F}**2 + {R}**2)")
    for name, part, symbol, key in (("contact_x2", place.real, "F", "19"), ("contact_y2", place.imag, "R", "20")):
        page.add(name, part, f"-{{r}} * {{{symbol}}} / {{w}}", f"Savvin ({key})")
        page.mark_misprint(SAVVIN[key])
    page.add(
        "contact_x1",
        profile.real,
        f"{{A}} + {{xi_2}} * cos({_BETWEEN}) - {{eta_2}} * sin({_BETWEEN})",
        "Savvin (4), (21)",
    )
    page.mark_misprint(SAVVIN["21"])
    page.add(
        "contact_y1",
        profile.imag,
        f"{{B}} + {{xi_2}} * sin({_BETWEEN}) + {{eta_2}} * cos({_BETWEEN})",
        "Savvin (5), (22)",
    )
    name = "rolling_velocity" if kind == "roller" else "sliding_velocity"
    page.add(name, float(cam.sliding_velocity(at.angle)), "{w} + {r} * {W}")


def _pressure(page: Sheet, at: Position) -> None:
    """(23) to (28): velocity of the follower at the contact, normal, pressure angle; and that at the centre."""
    cam = at.cam
    contact = complex(cam.contact(at.angle))
    velocity = at.centre[1] + 1j * at.rates[0] * (contact - at.centre[0])
    relative = (velocity - 1j * contact) * cmath.exp(-1j * at.angle)
    pointed, moves = str(cam.kind) == "pointed", abs(at.lift[1]) > _STILL * abs(cam.motion.lift)
    if pointed:
        speeds, formula = ("x_021", "y_021"), "arctan(-{A1} / {B1})"
        relative = at.turned[1]
    else:
        speeds = ("x_t1", "y_t1")
        across = f"({{xi_2}} * sin({_BETWEEN}){'' if cam.is_flat else f' + {{eta_2}} * cos({_BETWEEN})'})"
        along = f"({{xi_2}} * cos({_BETWEEN}){'' if cam.is_flat else f' - {{eta_2}} * sin({_BETWEEN})'})"
        relatives = (f"{{A1}} - {{W}} * {across}", f"{{B1}} + {{W}} * {along}")
        point(page, ("relative_x1", "relative_y1"), relative, relatives, ("Savvin (4)", "Savvin (5)"))
        more = ("", "") if cam.is_flat else (
            " - {eta_2} * {omega_2} * cos({alpha_2})", " - {eta_2} * {omega_2} * sin({alpha_2})"
        )  # fmt: skip
        speed = (
            f"{{x_021}} - {{xi_2}} * {{omega_2}} * sin({{alpha_2}}){more[0]}",
            f"{{y_021}} + {{xi_2}} * {{omega_2}} * cos({{alpha_2}}){more[1]}",
        )
        point(page, ("contact_velocity_x", "contact_velocity_y"), velocity, speed, ("Savvin (23)", "Savvin (24)"))
        formula = "arctan(-{xi_21} / {eta_21})"
    normal = complex(cam.normal(at.angle)) * cmath.exp(-1j * at.angle)
    leaning = abs(relative.imag) > _STILL * abs(contact)
    page.add("frame_normal_angle_deg", _acute(normal), formula if leaning else "", "Savvin (26)")
    gamma = _acute(normal) + math.degrees(at.angle)
    page.add("normal_angle_deg", gamma, "{gamma_11} + {alpha_1}", "Savvin (27)")
    page.mark_misprint(SAVVIN["27"])
    found = math.degrees(float(cam.contact_pressure_angle(at.angle)))
    if moves:
        usable = abs(velocity.real) > _STILL * abs(velocity)
        page.add(
            "velocity_angle_deg",
            _acute(velocity),
            f"arctan({{{speeds[1]}}} / {{{speeds[0]}}})" if usable else "",
            "Savvin (25)",
        )
    page.add(
        "position_contact_pressure_angle_deg",
        found,
        "arctan(tan({gamma_1} - {gamma_2}))" if moves else "",
        "Savvin (28)",
    )
    page.mark_misprint(SAVVIN["28"])
    if cam.radius:
        _centre_pressure(page, at, moves=moves)


def _centre_pressure(page: Sheet, at: Position, *, moves: bool) -> None:
    """The pressure angle by the velocity of the centre of a roller, which turns freely, or of an arc."""
    velocity = at.centre[1]
    if moves:
        usable = abs(velocity.real) > _STILL * abs(velocity)
        page.add("centre_velocity_angle_deg", _acute(velocity), "arctan({y_021} / {x_021})" if usable else "")
    nu = math.degrees(float(at.cam.pressure_angle(at.angle)))
    page.add("position_pressure_angle_deg", nu, "arctan(tan({gamma_1} - {gamma_0}))" if moves else "")


def _acute(way: complex) -> float:
    """Angle of a line of that direction, degrees, within +-90."""
    return math.degrees(cmath.phase(way if way.real > 0 else -way))


def _curvature(page: Sheet, at: Position) -> None:
    """Radius of curvature of the cam, above 0 where it is convex."""
    radius = float(at.cam.curvature_radius(at.angle))
    if at.cam.is_flat:
        bend = f"{{A2}} * sin({_BETWEEN}) - {{B2}} * cos({_BETWEEN})"
        formula = f"-(2 * {{R}} * {{W}} + {bend} - {{xi_2}} * {{eps_2}}) / {{W}}**2"
    else:
        formula = "-{w}**3 / ({A1} * {B2} - {B1} * {A2})" + (" - {r}" if at.cam.radius else "")
    straight = not abs(radius) < 1 / _STILL * abs(at.centre[0])
    page.add("position_curvature_radius", math.inf if straight else radius, "" if straight else formula)
