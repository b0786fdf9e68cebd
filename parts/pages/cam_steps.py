"""Steps that the calculations of all kinds of cams have in common: phases, coefficients, positions, impacts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import Annotated, Literal

import numpy as np
from msgspec import Meta

from geometry.base.errors import ParameterError, limit
from geometry.base.record import Record, replace
from geometry.cams.motion.follower_motion import TURN, FollowerMotion, Phase, PhaseKind
from geometry.cams.plane.disk import DiskCam, FollowerKind
from geometry.cams.plane.graphical import INTERVALS, LEAST_INTERVALS, MOST_INTERVALS
from geometry.cams.plane.synthesis import least_hollow_radius
from geometry.curves.curve import Complex, Real
from geometry.laws.law import AT_REST, REVERSED, Rates
from geometry.laws.piece import LawPiece
from parts.base.texts import N_, Message, Text, message
from parts.keys.base import degrees, size
from parts.pages.page import Head, Sheet, Table, table_of
from parts.pages.terms import TERMS

TOPIC = "cam"
LESSON_4, LESSON_5 = "practicum, lesson 4", "practicum, lesson 5"
# names of laws that are none of ``NAMED_LAWS``
_LAWS = (
    N_("sine-constant-cosine acceleration"),
    N_("polynomial of degree {degree}"),
    N_("B-spline of degree {degree}"),
    N_("straight flanks and nose"),
    N_("arc flanks and nose"),
    N_("eccentric circle"),
)
_RADII: dict[FollowerKind, Text] = {
    FollowerKind.ROLLER: N_("radius of the roller"),
    FollowerKind.MUSHROOM: N_("radius of the mushroom's face"),
}
_PHASES = {"rise": "rise", "far": "far_dwell", "return": "return", "near": "near_dwell"}

# radii of curvature beyond this many sizes of a cam are those of straight lines
_STRAIGHT = 1e9
# units of the last place that a sum of phases or a turn into radians and back may cost
_ROUNDING = 8

# keys that several of the calculations take
Step = Annotated[float, degrees("step of the table over the cam angle", least=0.1, most=90)]
Intervals = Annotated[
    int, Meta(ge=LEAST_INTERVALS, le=MOST_INTERVALS, description="of each phase in the graphical method")
]
DEFAULT_INTERVALS = INTERVALS
Drawing = Annotated[
    Literal["smooth", "chords"], Meta(description="S' of the graphical method: a smooth curve or a broken line")
]
Cutter = Annotated[
    float,
    Meta(
        gt=0,
        le=1000,
        description=(
            "of a cutter for the profile: adds the places of its centre to csv and json; only the curvature is checked"
        ),
        extra={"unit": "mm"},
    ),
]
Speed = Annotated[float, size("rpm", "of the cam: adds velocities", above=0, most=1e6)]


class Phases(Record):
    """The phases of a motion with its lift, mm (rad where it ``swings``), over the cam's angle or a plate's travel.

    ``left_rows``: of a smoothed table, how far its rows are left, mm or rad.
    """

    phases: tuple[Phase, ...]
    lift: float
    swings: bool = False
    slides: bool = False
    left_rows: float | None = None

    def named(self) -> list[tuple[str, Phase]]:
        """Every phase as rise, far, return or near; a dwell is far above the middle of where the follower goes."""
        heights = [0.0, *accumulate(phase.lift for phase in self.phases)]
        middle = (min(heights) + max(heights)) / 2
        names = {PhaseKind.RISE: "rise", PhaseKind.RETURN: "return"}
        return [
            (names.get(phase.kind, "far" if height > middle else "near"), phase)
            for phase, height in zip(self.phases, heights, strict=False)
        ]

    def jerks(self) -> list[float]:
        """C_j of each phase in this motion, 0 of dwells: finite where its neighbours go on with its acceleration."""
        ends = [(_rates(phase, 0.0), _rates(phase, 1.0)) for phase in self.phases]
        found = []
        for k, phase in enumerate(self.phases):
            if phase.law is None:
                found.append(0.0)
                continue
            # a plate slides on beyond its last phase, a cam begins anew
            before = AT_REST if self.slides and k == 0 else ends[k - 1][1]
            after = AT_REST if self.slides and k == len(ends) - 1 else ends[(k + 1) % len(ends)][0]
            one, two = phase.angle / phase.lift, phase.angle**2 / phase.lift
            found.append(phase.law.jerk((before[0] * one, before[1] * two), (after[0] * one, after[1] * two)))
        return found

    def term(self, name: str) -> str:
        """The term of a phase's angle or travel."""
        return f"{_PHASES[name]}_{'travel' if self.slides else 'angle_deg'}"

    def size(self, phase: Phase) -> float:
        """The phase's angle in degrees, or its travel in mm."""
        return phase.angle if self.slides else as_typed(math.degrees(phase.angle))

    def stroke(self, lift: float) -> float:
        """A lift or swing, in mm or degrees."""
        return as_typed(math.degrees(lift) if self.swings else lift)

    def data(self) -> list[dict[str, object]]:
        """For json."""
        key = "travel" if self.slides else "angle_deg"
        return [
            {"move": name, key: self.size(phase), "law": phase.law.name if phase.law else None}
            for name, phase in self.named()
        ]


def _rates(phase: Phase, share: float) -> Rates:
    """S' and S'' at a share of a phase, by its own law."""
    if phase.law is None:
        return AT_REST
    one, two = (float(phase.law.value(share, k)) * phase.lift / phase.angle**k for k in (1, 2))
    return one, two


def as_typed(value: float) -> float:
    """The number of few digits that rounding in sums and in radians has left by a few units of the last place."""
    short = float(f"{value:.14g}")
    return short if abs(short - value) <= _ROUNDING * math.ulp(value) else value


def phase_steps(page: Sheet, phases: Phases) -> None:
    """Under a heading lift or swing, and the angle or travel of every phase."""
    page.section("Characteristics")
    page.add("swing_deg" if phases.swings else "lift", phases.stroke(phases.lift))
    if phases.left_rows is not None:
        unit = math.degrees(1.0) if phases.swings else 1.0
        page.add("table_deviation_deg" if phases.swings else "table_deviation", phases.left_rows * unit)
    named = phases.named()
    index = dict.fromkeys(_PHASES, 0)
    for name, phase in named:
        index[name] += 1
        many = sum(other == name for other, _ in named) > 1
        term = phases.term(name)
        page.add(term, phases.size(phase), symbol=f"{TERMS[term].symbol}{index[name]}" if many else "")


def radius_step(page: Sheet, kind: FollowerKind, radius: float) -> None:
    """The radius of a roller or of a mushroom's face, mm, by its name; a point and a flat face have none."""
    if radius:
        page.add("follower_radius", radius, called=_RADII[kind])


def coefficient_steps(page: Sheet, phases: Phases) -> None:
    """Law, h and the peaks of each moving phase: S'_max = C_v h / phi, S''_max = C_a h / phi^2."""
    titles = {"rise": N_("Rise: {law}"), "return": N_("Return: {law}")}
    for (name, phase), jerk in zip(phases.named(), phases.jerks(), strict=True):
        if phase.law is None:
            continue
        law, h = phase.law.name, abs(phase.lift)
        page.section(titles[name], law=law_text(law))
        page.add(phases.term(name), phases.size(phase), key="phi")
        page.add("swing_of_phase_deg" if phases.swings else "lift_of_phase", phases.stroke(h))
        speed, bend = (max(map(abs, phase.law.peak(order))) for order in (1, 2))
        page.told(velocity_coefficient=speed, acceleration_coefficient=bend, jerk_coefficient=jerk)
        if phases.swings:
            continue
        terms = ("peak_slope", "peak_bend") if phases.slides else ("peak_velocity", "peak_acceleration")
        source = "" if phases.slides else LESSON_4
        page.add(terms[0], speed * h / phase.angle, "{c_v} * {h} / {phi}", source)
        page.add(terms[1], bend * h / phase.angle**2, "{c_a} * {h} / {phi}**2", source)


def law_text(name: str) -> Message:
    """A law by its name, which may end in a degree, and be run backwards."""
    if (forward := name.removesuffix(REVERSED)) != name:
        return message("{law}, reversed", law=law_text(forward))
    kind, _, last = name.rpartition(" ")
    return message(f"{kind} {{degree}}", degree=last) if last.isdigit() else message(name)


def grid(pieces: Sequence[LawPiece], step: float, end: float) -> Real:
    """Every ``step`` from 0 up to ``end``, and where a piece of the motion begins.

    A step that meets a joint but for rounding stands on it, and reads what follows.
    """
    starts = np.array([piece.start for piece in pieces])
    even = np.arange(math.ceil(end / step - 1e-9)) * step
    own = [a for a in starts if np.abs(even - a).min() > 1e-9 * max(end, 1.0)]
    found = np.sort(np.concatenate([even, own]))
    close = np.abs(found[:, None] - starts).argmin(axis=1)
    return np.where(np.abs(found - starts[close]) < 1e-9 * max(end, 1.0), starts[close], found)


def cam_angles(motion: FollowerMotion, step: float) -> tuple[Real, Real]:
    """The cam angles of a table in degrees and rad: every ``step`` degrees and where a phase begins.

    At an impact there are two rows, of both its sides; what jumps as the turn closes has its left side at 360 degrees.
    """
    told, angle = with_left_sides(
        grid(motion.pieces, math.radians(step), TURN), [j.angle or TURN for j in motion.impacts()]
    )
    # the steps as typed
    degrees = np.degrees(told)
    even = np.round(degrees / step) * step
    return np.where(np.abs(degrees - even) < 1e-9, even, degrees), angle


def with_left_sides(at: Real, jumps: Sequence[float]) -> tuple[Real, Real]:
    """Arguments with those of ``jumps`` before them, and the same for a motion, which reads the left side of a jump."""
    told, asked = np.append(at, jumps), np.append(at, np.nextafter(jumps, 0))
    order = np.argsort(asked)
    return told[order], asked[order]


def motion_columns(
    values: Sequence[Real], argument: Real, *, swings: bool, slides: bool = False, speed: float | None = None
) -> tuple[list[Real], list[Head]]:
    """The columns phi, S, S', S'' and their heads; ``argument`` in degrees, or mm of a plate that ``slides``.

    A ``speed``, rad/s (mm/s of a plate), adds the follower's velocity and acceleration.
    """
    scale, u = (180 / math.pi, "deg") if swings else (1.0, "mm")
    units = (f"{u}/rad", f"{u}/rad2")
    if slides:
        units = ("deg/mm", "deg/mm2") if swings else ("", "1/mm")
    heads = [("s", "mm") if slides else ("phi", "deg"), ("S", u), ("S'", units[0]), ("S''", units[1])]
    columns = [argument, *(v * scale for v in values)]
    if speed is not None:
        columns += [values[1] * speed, values[2] * speed**2 / (1 if swings else 1000)]
        heads += [("omega", "rad/s"), ("epsilon", "rad/s2")] if swings else [("v", "mm/s"), ("a", "m/s2")]
    return columns, heads


def angular_speed(speed_rpm: float | None) -> float | None:
    """rad/s of a cam whose speed is given."""
    return None if speed_rpm is None else math.pi * speed_rpm / 30


def positions(
    cam: DiskCam,
    step: float,
    name: str = "positions",
    whose: str = "",
    *,
    beyond: float | None = None,
    turn: float = 0.0,
    speed_rpm: float | None = None,
    cutter_diameter: float | None = None,
) -> Table:
    """phi, S, S', S'', pressure angle, radius of curvature, profile: at every step and where a phase begins.

    ``beyond``: mm from the roller's centre to the wall beyond it, whose table is then made; ``turn``: rad by which a
    disk is turned on its shaft; ``whose``: wall or disk. A speed adds the follower's velocity and acceleration. Only
    data have the profile's polar radius and angle, the pitch curve, and the centre of a cutter on the cam's profile.
    """
    degrees, angle = cam_angles(cam.motion, step)
    motion = [cam.motion.value(angle, k) for k in range(3)]
    columns, heads = motion_columns(motion, degrees, swings=cam.swings, speed=angular_speed(speed_rpm))
    slope = np.degrees(cam.pressure_angle(angle))
    if beyond is None:
        profile, bend = cam.profile_point(angle), straightened(cam.curvature_radius(angle), cam.base_radius)
    else:
        profile, bend = outer_points(cam, angle, beyond), -(cam.pitch_curvature_radius(angle) + beyond)
    turned = np.exp(1j * turn)
    profile = profile * turned
    columns += [slope, bend, profile.real, profile.imag]
    heads += [("nu", "deg"), ("rho", "mm"), ("x", "mm"), ("y", "mm")]
    shown = len(heads)
    columns += [np.abs(profile), np.degrees(np.angle(profile)) % 360]
    heads += [("r", "mm"), ("theta", "deg")]
    if cam.radius:
        columns += _coordinates(outer_points(cam, angle, 0.0) * turned)
        heads += [("x_p", "mm"), ("y_p", "mm")]
    if cutter_diameter is not None:
        columns += _coordinates(cutter_centres(cam, angle, cutter_diameter) * turned)
        heads += [("x_c", "mm"), ("y_c", "mm")]
    title = message("Positions: cam angle, motion, pressure angle, radius of curvature, profile")
    if whose:
        title = message("{title} ({whose})", title=title, whose=message(whose))
    return replace(table_of(name, title, heads, zip(*columns, strict=True)), shown=shown)


def _coordinates(points: Complex) -> list[Real]:
    return [points.real, points.imag]


def cutter_centres(cam: DiskCam, angle: Real, cutter_diameter: float) -> Complex:
    """Centres of a cutter that touches the cam's profile from outside, in the cam's frame, mm.

    Raises
    ------
    ParameterError
        The cutter is rounder than the profile where that is hollow.
    """
    most = 2 * (least_hollow_radius(cam).value + cam.radius)
    if cutter_diameter > most:
        raise ParameterError("cutter_diameter", cutter_diameter, "cutter_above_hollow", limit(most, cutter_diameter))
    return np.asarray((cam.contact(angle) + cutter_diameter / 2 * cam.normal(angle)) * np.exp(-1j * angle))


def outer_points(cam: DiskCam, angle: Real, beyond: float) -> Complex:
    """Points of the wall ``beyond`` mm past the roller's centre, in the cam's frame, mm."""
    return np.asarray((cam.reference_point(angle) + beyond * cam.normal(angle)) * np.exp(-1j * angle))


def straightened(radius: Real, size: float) -> Real:
    """Radii of curvature, those of what is straight but for rounding as infinity; ``size`` of the cam, mm."""
    return np.where(np.abs(radius) < _STRAIGHT * size, radius, np.inf)


def impact_notes(page: Sheet, motion: FollowerMotion) -> None:
    """Where joints are felt, and what the table holds there."""
    impacts = motion.impacts()
    if impacts:
        page.note("at an impact the table has two rows: what was before, and what begins")
    felt = {
        "rigid": N_("rigid impact at cam angle {angle} degrees"),
        "soft": N_("soft impact at cam angle {angle} degrees"),
    }
    for joint in impacts:
        if joint.impact is not None:
            page.note(felt[joint.impact], angle=f"{math.degrees(joint.angle):.6g}")
