"""``higherpair calc lever``: structure, velocities and accelerations of a lever mechanism, as plans and over a turn."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec.structs import replace as changed

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.nearest import nearer
from geometry.base.record import replace
from geometry.base.roots import bracketed_roots, crests, tops
from geometry.curves.curve import Complex, Real
from geometry.kinematics.flywheel import Cycle, mertsalov
from geometry.kinematics.kinetostatics import by_zhukovsky, frames, reduced_inertia, weights_work
from geometry.kinematics.levers import Levers, Moved, Rods, Slider, Stone, closed, ranges, swing
from parts.base.fields import given_keys
from parts.base.refusal import REMOVED
from parts.base.texts import N_, Text, message
from parts.bodies.lever_crank import LeverCrankSpec
from parts.keys.base import either
from parts.keys.levers import NAMES, MechanismTable, levers_of, unused
from parts.keys.title import TitleBlockTable
from parts.mates.pages.contour_marks import checked_picture
from parts.mates.pages.lever_forces import ForcePage, Forces, LeverForce, Turn, asked, weighs
from parts.mates.pages.lever_keys import LeverKeys, room_of
from parts.mates.pages.lever_picture import LeverPicture, Plan, Run, Vector, plan_of
from parts.mates.pages.lever_tasks import EXAMPLE, MACHINES, chosen
from parts.pages.inputs import SceneKeys, checked, chosen_part, refusal
from parts.pages.misprints import printed_for
from parts.pages.page import Sheet
from parts.pages.terms import TERMS

if TYPE_CHECKING:
    from parts.drawing.expected import Expected

TOPIC = "lever"
_GUIDELINES, _MERTSALOV = "guidelines, 3.4", "guidelines, 2.2.5"
_KINDS = {Stone: 3, Rods: 1, Slider: 2}
# positions over which the greatest values of a turn are sought
_FINE = 3600
# parts of its way by which a crank that does not turn all round is kept off its limits, and degrees in what is offered
_LEFT, _ASIDE = 1e-6, 1e-3
# lengths that are told as they are drawn too
_DRAWN = ("first_rod_length", "frame_length", "lever_length", "lever_arm_length", "second_rod_length",
          "second_rocker_length", "second_frame_length")  # fmt: skip
# what the directions of links are called
_DIRECTIONS = {"2": "first_rod_angle_deg", "3": "lever_angle_deg", "4": "second_rod_angle_deg",
               "5": "second_rocker_angle_deg"}  # fmt: skip
# keys by which an assignment's links may be made to stand otherwise
_STANDING = ("frame_angle_deg", "first_side", "arm_angle_deg", "pivot_angle_deg", "guide_height", "guide_angle_deg",
             "second_side")  # fmt: skip
# length of the crank on a drawing, mm; shares of a sheet that the scheme takes, along and across
_DRAWN_CRANK, _SHARE = 30.0, 0.5 + 0.5j
# keys that choose the others
_CHOICE = ("code", "assignment", "variant")
# keys of the sheet alone
_OF_SHEET = ("sheet", "paper", "title_block", "second_position")
_OF_DRIVE = ("drive_pressure_angle_deg", "drive_angle_deg")
# percent that a plan may be off (guidelines, 2.2.2, 7), and how finely it is read, mm
_TOLERANCE, _READ = 3.0, 0.1


def sheet(table: dict[str, Any]) -> Sheet:
    """The page of one mechanism."""
    keys: LeverKeys = checked(table, LeverKeys, TOPIC)
    checked_picture(TOPIC, keys.picture, (".svg",))
    checked_picture(TOPIC, keys.sheet, (".dxf", ".svg", ".pdf"), "sheet")
    try:
        given, number, rows = chosen(keys.code, keys.assignment, keys.variant)
        if number is not None:
            given |= {k: v for k, v in EXAMPLE.items() if k != "code"} if _is_example(table) else {}
            keys = checked(given | {k: v for k, v in table.items() if k not in _CHOICE}, LeverKeys, TOPIC)
        _refuse_idle(keys, table)
        if keys.speed_rpm is not None:
            if "speed" in table:
                raise ParameterError("speed_rpm", keys.speed_rpm, "other_is_given", REMOVED, other="speed")
            keys = changed(keys, speed=math.pi * keys.speed_rpm / 30)
        return _Page(keys, number, rows, is_example=_is_example(table)).made()
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The mechanism of a scene's one lever crank, or of the one that ``part`` names, turned as it is placed."""
    cranks = {key: spec for key, spec in scene.parts.items() if isinstance(spec, LeverCrankSpec)}
    part = chosen_part("lever_crank", [*cranks], [*cranks], source, table)
    instances = {key: spec for key, spec in scene.instances.items() if spec.part == part}
    placed = [*instances.values(), *(mate for mate in scene.mates if getattr(mate, "second", None) in instances)]
    turn = next((found for one in placed if (found := getattr(one, "rotation_deg", None))), 0.0)
    return given_keys(cranks[part].mechanism) | {"start_angle_deg": turn} | table


def _is_example(table: Mapping[str, Any]) -> bool:
    digits = "".join(filter(str.isdigit, str(table.get("code", ""))))
    return digits == EXAMPLE["code"] and set(table) <= {"code", "picture", "positions", "measured", *_OF_SHEET}


def _refuse_idle(keys: LeverKeys, table: Mapping[str, Any]) -> None:
    """Refuse keys that a user gave and that no link of the mechanism takes."""
    taken = {
        "mass_point": keys.first != "stone", "second_guide_angle_deg": keys.first == "slider",
        "resisted": keys.resistance is not None or keys.resisting_moment is not None,
        "gravity": weighs(keys), "gravity_angle_deg": weighs(keys) and keys.gravity > 0, "force_scale": asked(keys),
        "drive_radius": asked(keys), "centres": asked(keys), "centre_offsets": asked(keys),
    }  # fmt: skip
    owners = dict.fromkeys(_OF_SHEET[1:], "sheet") | dict.fromkeys(_OF_DRIVE, "drive_radius")
    for name, other in owners.items():
        if name in table and getattr(keys, other) is None:
            raise ParameterError(name, table[name], "needs_other", REMOVED, other=other)
    if keys.second_position is not None and keys.second_position >= keys.positions:
        works = Nearest(keys.positions - 1, "at_most")
        raise ParameterError(
            "second_position", keys.second_position, "no_such_position", works, last=keys.positions - 1
        )
    if keys.second_guide_angle_deg is not None and asked(keys):
        loads = next(name for name in ("masses", "point_masses", "inertias", "resistance", "resisting_moment")
                     if getattr(keys, name))  # fmt: skip
        raise ParameterError(loads, table[loads], "other_is_given", REMOVED, other="second_guide_angle_deg")
    for name in [*MechanismTable.__struct_fields__, *taken]:
        if name in table and (name in unused(keys) or not taken.get(name, True)):
            raise ParameterError(name, table[name], "of_no_link", REMOVED)


def _levers(keys: LeverKeys) -> Levers:
    levers = levers_of(keys, keys.speed, keys.acceleration)
    if keys.second_guide_angle_deg is None or not isinstance(levers.first, Slider):
        return levers
    turn = math.radians(keys.second_guide_angle_deg - keys.guide_angle_deg)
    on, angle = levers.first.on * cmath.exp(1j * turn), levers.first.angle + turn
    return replace(levers, second=replace(levers.first, on=on, angle=angle))


def _metres(vector: complex | np.ndarray) -> float:
    """The size in metres of a vector in millimetres."""
    return abs(complex(vector)) / 1000


def _about(levers: Levers, start: float) -> tuple[list[tuple[float, float]], tuple[float, float] | None]:
    """Between which angles the crank can move, rad, each as it lies about a given one; those about that one."""
    turn = 2 * math.pi
    found = ranges(levers)
    shifts = [turn * round((start - (low + high) / 2) / turn) for low, high in found]
    about = [(low + shift, high + shift) for (low, high), shift in zip(found, shifts, strict=True)]
    return about, next(((low, high) for low, high in about if low < start < high), None)


class _Page:
    """The page while it grows: ``at`` is the mechanism in the first position, in mm and s."""

    def __init__(self, keys: LeverKeys, number: int | None, rows: tuple[int, ...], *, is_example: bool) -> None:
        self.keys, self.number, self.rows = keys, number, rows
        self.levers = _levers(keys)
        self.is_example = is_example
        printed = printed_for("lever example") if is_example else {}
        self.page = Sheet(TOPIC, N_("Lever mechanism"), picture_file=keys.picture, printed=printed)
        self.forces = Forces(keys, self.levers) if asked(keys) else None
        self.lever: tuple[LeverForce, ...] = ()
        self.start, self.way = math.radians(keys.start_angle_deg), cmath.exp(1j * math.radians(keys.guide_angle_deg))
        # as many places to each position of the table
        self.fine = keys.positions * math.ceil(_FINE / keys.positions)
        turn = 2 * math.pi * np.arange(self.fine) / self.fine
        self.between, self.hindered = self._driven()
        if self.between is None:
            self.angles = self.start + 2 * math.pi * np.arange(keys.positions) / keys.positions
            self.turn = self.levers.moved(self.start + turn)
        else:
            # to and fro, the limits left out, where nothing has a velocity
            low, high = self.between
            self.angles = np.array([self.start])
            self.turn = self.levers.moved((low + high) / 2 - (1 - _LEFT) * (high - low) / 2 * np.cos(turn))
        self.at = self.levers.moved(self.start)
        self.over = Turn(self.start + turn, self._dead_points()[0] if self.between is None else np.array([]))
        self.drawn = keys.drawn_crank or (_DRAWN_CRANK if keys.sheet is None else self._round_crank())

    def _driven(self) -> tuple[tuple[float, float] | None, ParameterError | None]:
        """Between which angles the crank moves, rad, and what hinders it; None: it turns all round."""
        keys = self.keys
        try:
            closed(self.levers)
        except ParameterError as error:
            hindered = error.renamed(NAMES.get(error.name, error.name))
        else:
            return None, None
        if keys.unevenness is not None or keys.sheet is not None:
            raise hindered
        about, here = _about(self.levers, self.start)
        if not about:

            def moves(length: float) -> bool:
                levers = _levers(changed(keys, **{hindered.name: length}))
                try:
                    closed(levers)
                except ParameterError:
                    return _about(levers, self.start)[1] is not None
                return True

            raise nearer(hindered, moves)
        if here is None:
            low, high = min(about, key=lambda ends: min(abs(self.start - end) for end in ends))
            ends = math.degrees(low), math.degrees(high)
            aside = min(_ASIDE, (ends[1] - ends[0]) / 4)
            works = limit(min(max(keys.start_angle_deg, ends[0] + aside), ends[1] - aside), keys.start_angle_deg)
            code = "links_do_not_meet"
            raise ParameterError("start_angle_deg", keys.start_angle_deg, code, works, low=ends[0], high=ends[1])
        return here, hindered

    def _round_crank(self) -> float:
        """The crank on a sheet, mm, so that the scheme has a round scale and its share of the paper."""
        from parts.drawing.canvas import standard_scale
        from parts.drawing.choice import PAPERS

        spots = np.concatenate([np.zeros(1), *map(self.turn.place, self.turn.points)])
        tall, wide = PAPERS[self.keys.paper or "A1"]
        needed = max(np.ptp(spots.real) / (_SHARE.real * wide), np.ptp(spots.imag) / (_SHARE.imag * tall))
        return self.levers.crank / (1000 * standard_scale(float(needed) / 1000))

    def made(self) -> Sheet:
        """The whole page."""
        self._given()
        self._structure()
        self._place()
        self._velocities()
        self._accelerations()
        self._over_a_turn()
        plans = self._plans()
        self._measured(plans)
        forces = self._forces()
        run = self._flywheel()
        self._picture(plans, run, forces)
        if self.keys.sheet is not None:
            self._sheet(self.keys.sheet)
        self._notes()
        return self.page

    def _given(self) -> None:
        page, keys = self.page, self.keys
        page.section("Given")
        page.given(crank_angle_deg=keys.start_angle_deg, crank_speed_rpm=keys.speed_rpm)
        formula = "" if keys.speed_rpm is None else "pi * {n_1} / 30"
        page.add("crank_speed", keys.speed, formula, given=keys.speed_rpm is None)
        page.given(crank_acceleration=keys.acceleration or None)
        page.add("crank_length", self.levers.crank, given=True)
        rod = None if keys.first == "stone" else keys.coupler_length
        lengths: list[tuple[str, float | None]] = [("first_rod_length", rod)]
        if keys.first != "slider":
            lengths += [("frame_length", keys.frame_length), ("frame_angle_deg", keys.frame_angle_deg)]
            lengths += [("lever_length", keys.lever_length)]
        if keys.second != "none":
            lengths += [("lever_arm_length", keys.arm_length or keys.lever_length)]
            lengths += [("lever_arm_angle_deg", keys.arm_angle_deg), ("second_rod_length", keys.rod_length)]
        if keys.second == "rocker":
            lengths += [("second_rocker_length", keys.rocker_length), ("second_frame_length", keys.pivot_distance)]
            lengths += [("second_frame_angle_deg", keys.pivot_angle_deg)]
        if "slider" in (keys.first, keys.second):
            lengths += [("guide_offset", keys.guide_height), ("slider_guide_angle_deg", keys.guide_angle_deg or None)]
            lengths += [("second_guide_angle_deg", keys.second_guide_angle_deg)]
        for name, value in lengths:
            if value is not None:
                page.add(name, value, given=True)
        scale = self.levers.crank / self.drawn
        heads = ((N_("length"), ""), (N_("real"), "mm"), (N_("on the drawing"), "mm"))
        named = [("l_AO1", self.levers.crank)]
        named += [(TERMS[name].symbol, value) for name, value in lengths if value is not None and name in _DRAWN]
        title = message("Lengths on the drawing, {scale:g} m for 1 mm", scale=scale / 1000)
        page.table("lengths", title, heads, ((symbol, value, value / scale) for symbol, value in named))

    def _structure(self) -> None:
        page, levers = self.page, self.levers
        page.section("Structure")
        page.add("moving_links", levers.links)
        page.add("lower_pairs", levers.lower_pairs, called=N_("lower kinematic pairs (turning and sliding)"))
        page.add("higher_pairs", 0, called=N_("higher kinematic pairs"))
        page.add("degree_of_freedom", 1, "3 * {n} - 2 * {p_5} - {p_4}", _GUIDELINES)
        for left in range(levers.links - 2, 0, -2):
            # the group farthest from the crank is taken off; what is left goes on as a mechanism
            of = message("links {first} and {second}", first=left + 1, second=left + 2)
            page.add("group_freedom", 0, "3 * 2 - 2 * 3", _GUIDELINES, of=of)
            pairs = levers.lower_pairs - 3 * (levers.links - left) // 2
            page.add("rest_freedom", 3 * left - 2 * pairs, f"3 * {left} - 2 * {pairs}", _GUIDELINES)
        first, second = _KINDS[type(levers.first)], levers.second
        if second is None:
            page.note("class II: the crank (class I) and one group of class 2, order 2, kind {kind}", kind=first)
            return
        text = N_(
            "class II: the crank (class I), links 2 and 3 as a group of class 2, order 2, kind {first}, and "
            "links 4 and 5 as a group of class 2, order 2, kind {second}"
        )
        page.note(text, first=first, second=_KINDS[type(second)])

    def _place(self) -> None:
        at = self.at
        self.page.section("Position")
        if at.reach is not None:
            formula = "sqrt({l_0}**2 + {l_1}**2 - 2 * {l_0} * {l_1} * cos({phi_1} - {gamma_0}))"
            self.page.add("stone_distance", float(at.reach[0]), formula)
        for link, name in _DIRECTIONS.items():
            if link in at.links:
                called = N_("direction of the rod AD") if link == "4" and self._is_twin else ""
                self.page.add(name, math.degrees(at.angle(link)), called=called)
        if self.between is not None:
            for end, name in zip(self.between, ("least_crank_angle_deg", "greatest_crank_angle_deg"), strict=True):
                self.page.add(name, math.degrees(end), self._limit(end))
        self._transmission()

    def _limit(self, end: float) -> str:
        """The formula of a limit of the crank at which rod and rocker are in line; none of others."""
        group, crank, turn = self.levers.first, self.levers.crank, 2 * math.pi
        if not isinstance(group, Rods):
            return ""
        frame, home = abs(group.pivot), math.radians(self.keys.frame_angle_deg)
        for sign, apart in (("+", group.rod + group.rocker), ("-", group.rod - group.rocker)):
            cosine = (frame**2 + crank**2 - apart**2) / (2 * frame * crank)
            for side, way in (("+", 1), ("-", -1)):
                value = home + way * math.acos(max(-1.0, min(1.0, cosine)))
                turns = round((end - value) / turn)
                if abs(cosine) <= 1 and abs(value + turns * turn - end) < _LEFT:
                    cosines = f"({{l_0}}**2 + {{l_1}}**2 - ({{l_2}} {sign} {{l_3}})**2) / (2 * {{l_0}} * {{l_1}})"
                    more = f" {'+' if turns > 0 else '-'} {abs(2 * turns)} * pi" if turns else ""
                    return f"{{gamma_0}} {side} arccos({cosines}){more}"
        return ""

    def _transmission(self) -> None:
        """The angle between the rod AB and the lever, or the normal of its guide, here and where it is the least."""
        levers, keys, page = self.levers, self.keys, self.page
        group, crank = levers.first, levers.crank
        if isinstance(group, Stone):
            return
        if isinstance(group, Slider):
            height, cosines = keys.guide_height, "abs({h} - {l_1} * sin({phi_1})) / {l_2}"
            here, least = height - crank * math.sin(self.start - group.angle), abs(height) + crank
            unit, formula = group.rod, "" if keys.guide_angle_deg else cosines
            worst = "(abs({h}) + {l_1}) / {l_2}"
        else:
            frame, links, unit = abs(group.pivot), group.rod**2 + group.rocker**2, 2 * group.rod * group.rocker
            aside = math.cos(self.start - cmath.phase(group.pivot))
            here = links - frame**2 - crank**2 + 2 * frame * crank * aside
            ends = [links - (frame + sign * crank) ** 2 for sign in (-1, 1)]
            sign, least = max(zip("-+", map(abs, ends), strict=True), key=lambda end: end[1])
            squares, sides = "{l_2}**2 + {l_3}**2", "(2 * {l_2} * {l_3})"
            turned = "2 * {l_0} * {l_1} * cos({phi_1} - {gamma_0})"
            formula = f"abs({squares} - {{l_0}}**2 - {{l_1}}**2 + {turned}) / {sides}"
            worst = f"abs({squares} - ({{l_0}} {sign} {{l_1}})**2) / {sides}"
        angles = [math.degrees(math.acos(min(abs(x) / unit, 1.0))) for x in (here, least)]
        page.add("transmission_angle_deg", angles[0], f"arccos({formula})" if formula else "")
        if self.between is None:
            page.add("joint_transmission_angle_deg", angles[1], f"arccos({worst})")

    def _velocities(self) -> None:
        page, at = self.page, self.at
        page.section("Velocities")
        self._point("A", "{omega_1} * {l_1} / 1000")
        if at.reach is not None:
            across, along = self._turning("3")[0] * float(at.reach[0]) / 1000, abs(float(at.reach[1])) / 1000
            formula = "{V_A} * abs(%s({phi_1} - {phi_3}))"
            of = N_("A on the lever")
            page.add("point_velocity", across, formula % "cos", _GUIDELINES, symbol="V_A3", of=of)
            of = N_("the stone along the lever")
            page.add("relative_velocity", along, formula % "sin", _GUIDELINES, symbol="V_A3A2", of=of)
            self._link("3", "1000 * {V_A3} / {r_A}")
            self._point("B", "{ω_3} * {l_3} / 1000")
        else:
            self._relative("2", "B", "A", "l_2")
            self._point("B")
            if "3" in at.links:
                self._link("3", "1000 * {V_B} / {l_3}")
        if "C" in at.points:
            self._point("C", "{ω_3} * {l_C} / 1000")
            self._point("D")
            self._relative("4", "D", "C", "l_4")
            if "5" in at.links:
                self._link("5", "1000 * {V_D} / {l_5}")
        elif self._is_twin:
            self._point("D")
            self._relative("4", "D", "A", "l_2")
        self._of_centres("point_velocity", "V", 1)

    def _of_centres(self, name: str, symbol: str, order: int) -> None:
        """A rate of the centre of mass of the rod AB, or of any other point of it, as the user tells it."""
        if self.keys.mass_point is None:
            return
        moving = frames(self.levers, self.at)
        for link in ("2", "4") if self._is_twin else ("2",):
            series = moving[link].point(complex(self.keys.mass_point * self._rod))
            of = message("point {name}", name=f"S{link}")
            self.page.add(name, _metres(order * series[order]), symbol=f"{symbol}_S{link}", of=of)

    @property
    def _rod(self) -> float:
        """The rod AB, mm; none goes to a stone."""
        assert not isinstance(self.levers.first, Stone)
        return self.levers.first.rod

    def _turning(self, link: str) -> tuple[float, float]:
        """Sizes of a link's angular velocity, rad/s, and acceleration, rad/s^2."""
        speed, change = self.at.turning(link)
        return abs(float(speed)), abs(float(change))

    def _point(self, name: str, formula: str = "") -> None:
        speed, of = _metres(self.at.velocity(name)), message("point {name}", name=name)
        self.page.add("point_velocity", speed, formula, symbol=f"V_{name}", of=of)

    def _link(self, link: str, formula: str) -> None:
        of = message("link {name}", name=link)
        self.page.add("link_speed", self._turning(link)[0], formula, symbol=f"ω_{link}", of=of)

    def _relative(self, link: str, of: str, against: str, length: str) -> None:
        symbol, told = f"V_{of}{against}", message("{of} about {against}", of=of, against=against)
        speed = _metres(self.at.velocity(of) - self.at.velocity(against))
        self.page.add("relative_velocity", speed, symbol=symbol, of=told)
        self._link(link, f"1000 * {{{symbol}}} / {{{length}}}")

    def _accelerations(self) -> None:
        page, at = self.page, self.at
        page.section("Accelerations")
        turned = "{l_1} * sqrt({omega_1}**4 + {eps_1}**2) / 1000"
        self._accelerated("A", turned if self.levers.change else "{omega_1}**2 * {l_1} / 1000")
        if at.reach is not None:
            size, of = 2 * abs(float(at.turning("3")[0] * at.reach[1])) / 1000, N_("the stone in the lever")
            formula = "2 * {ω_3} * {V_A3A2}"
            page.add("coriolis_acceleration", size, formula, _GUIDELINES, symbol="a_A3A2_k", of=of)
            self._about("3", N_("A about O3"), float(at.reach[0]), "r_A")
        else:
            self._about("2", N_("B about A"), abs(complex(at.place("B") - at.place("A"))), "l_2")
            if "3" in at.links:
                self._about("3", N_("B about O3"), self.levers.lever, "l_3")
        turned = "sqrt({ω_3}**4 + {ε_3}**2)"
        self._accelerated("B", f"{{l_3}} * {turned} / 1000" if "3" in at.links else "")
        if "C" in at.points:
            self._accelerated("C", f"{{l_C}} * {turned} / 1000")
            self._about("4", N_("D about C"), abs(complex(at.place("D") - at.place("C"))), "l_4")
            if isinstance(self.levers.second, Rods):
                self._about("5", N_("D about O5"), self.levers.second.rocker, "l_5")
            self._accelerated("D")
        elif self._is_twin:
            self._about("4", N_("D about A"), self._rod, "l_2")
            self._accelerated("D")
        if self.forces is None:
            # forces have it beside the mass
            self._of_centres("point_acceleration", "a", 2)

    def _accelerated(self, name: str, formula: str = "") -> None:
        size, of = _metres(self.at.acceleration(name)), message("point {name}", name=name)
        self.page.add("point_acceleration", size, formula, symbol=f"a_{name}", of=of)

    def _about(self, link: str, of: str, length: float, key: str) -> None:
        """Normal and tangential part of a turn with a link, and its angular acceleration."""
        page, (speed, change) = self.page, self._turning(link)
        normal, formula = speed**2 * length / 1000, f"{{ω_{link}}}**2 * {{{key}}} / 1000"
        page.add("normal_acceleration", normal, formula, _GUIDELINES, symbol=f"a_{link}n", of=of)
        page.add("tangential_acceleration", change * length / 1000, symbol=f"a_{link}t", of=of)
        formula, told = f"1000 * {{a_{link}t}} / {{{key}}}", message("link {name}", name=link)
        page.add("link_acceleration", change, formula, _GUIDELINES, symbol=f"ε_{link}", of=told)

    @property
    def _output(self) -> str:
        return "D" if "C" in self.at.points else "B"

    @property
    def _is_twin(self) -> bool:
        """Whether a second slider hangs on the crank."""
        return self.keys.first == "slider" and self.levers.second is not None

    def _over_a_turn(self) -> None:
        """The table of equidistant positions, and what is greatest over the turn."""
        page, name = self.page, self._output
        travel, of = self._along(self.turn.place(name)), message("point {name}", name=name)
        title: Text = N_("The position, with signs")
        if self.between is None:
            title = N_("Positions of the crank over one turn")
            page.section("Over a turn")
            if self._slides:
                # positions stand beside the dead points
                travel = np.append(travel, self._along(self.levers.moved(self.over.dead).place(name)))
                page.add("output_stroke", float(np.ptp(travel)), of=of)
            most = self._most(lambda at: np.abs(at.velocity(name)))
            page.add("greatest_output_velocity", most / 1000, of=of)
            most = self._most(lambda at: np.abs(at.acceleration(name)))
            page.add("greatest_output_acceleration", most / 1000, of=of)
            self._ways()
        at = self.levers.moved(self.angles)
        heads, columns = [("φ_1", "deg")], [np.degrees(self.angles)]
        for link in at.links:
            heads += [(f"φ_{link}", "deg"), (f"ω_{link}", "rad/s"), (f"ε_{link}", "rad/s2")]
            columns += [np.degrees(at.angle(link)), *at.turning(link)]
        place, speeds, changes = at.place(name), at.velocity(name), at.acceleration(name)
        if self._slides and self.between is None:
            heads.append((f"S_{name}", "mm"))
            columns.append(self._along(place) - travel.min())
        else:
            heads += [(f"x_{name}", "mm"), (f"y_{name}", "mm")]
            columns += [place.real, place.imag]
        heads += [(f"V_{name}", "m/s"), (f"a_{name}", "m/s2")]
        size = self._along if self._slides else np.abs
        columns += [size(speeds / 1000), size(changes / 1000)]
        if isinstance(second := self.levers.second, Slider) and self._is_twin:
            back = cmath.exp(-1j * second.angle)
            # seen along its guide it goes as the first one does
            heads += [("S_D", "mm"), ("V_D", "m/s"), ("a_D", "m/s2")]
            columns += [np.real(at.place("D") * back) - travel.min(), np.real(at.velocity("D") * back) / 1000,
                        np.real(at.acceleration("D") * back) / 1000]  # fmt: skip
        page.table("positions", title, heads, zip(*columns, strict=True))

    def _most(self, of: Callable[[Moved], Real]) -> float:
        """The greatest over the turn of what the mechanism has in each position."""

        def at(angles: Real) -> Real:
            return of(self.levers.moved(angles))

        values = of(self.turn)
        found = crests(at, self.over.angles[tops(values)], self.over.step)
        return float(np.append(values, at(found)).max())

    def _along(self, vectors: Complex) -> Real:
        """What of vectors lies along the guide."""
        return np.real(vectors * self.way.conjugate())

    def _going(self, at: Moved) -> Real:
        """The speed of the output with its sense: along the guide, or as its lever turns."""
        return self._along(at.velocity(self._output)) if self._slides else at.turning(list(at.links)[-1])[0]

    def _dead_points(self) -> tuple[Real, Real]:
        """Angles of the crank at which the output turns back, rad, and speeds of it behind them."""
        speeds, step = self._going(self.turn), 2 * math.pi / self.fine
        after = np.roll(speeds, -1)
        (turns,) = np.nonzero((speeds > 0) != (after > 0))
        before = np.asarray(self.start + step * turns, float)
        found = bracketed_roots(
            lambda angles: self._going(self.levers.moved(angles)), before, before + step, speeds[turns], after[turns]
        )
        return found, after[turns]

    def _ways(self) -> None:
        """The dead points of an output that goes to and fro, the crank's angles of both ways, and their ratio."""
        page, (found, after) = self.page, self._dead_points()
        if len(found) != 2:
            # an output that goes round, or stops more often
            return
        low, high = np.mod(found, 2 * math.pi)[:: 1 if after[0] > 0 else -1]
        forward = float((high - low) % (2 * math.pi))
        backward = 2 * math.pi - forward
        page.told(rear_dead_point_deg=math.degrees(low), front_dead_point_deg=math.degrees(high))
        page.add("forward_angle_deg", math.degrees(forward), "{phi_h} - {phi_l}" + (" + 2 * pi" if high < low else ""))
        page.add("backward_angle_deg", math.degrees(backward), "2 * pi - {phi_f}")
        ratio = "{phi_f} / {phi_b}" if forward > backward else "{phi_b} / {phi_f}"
        page.add("ratio_of_ways", max(forward, backward) / min(forward, backward), ratio)

    @property
    def _slides(self) -> bool:
        return "slider" in (self.keys.first, self.keys.second)

    def _forces(self) -> list[tuple[Text, Plan]]:
        """The force analysis, where loads are given: its plans."""
        if self.forces is None:
            return []
        part = ForcePage(self.page, self.forces, self.at, self.angles, self.over if self.between is None else None)
        part.add()
        self.lever = tuple(part.lever())
        return part.plans

    def _flywheel(self) -> Run | None:
        """The flywheel for an unevenness, from the resistance and the masses of the links; None: not asked for."""
        keys, page = self.keys, self.page
        if keys.unevenness is None:
            return None
        resists, forces, over = "resistance" if self._slides else "resisting_moment", self.forces, self.over
        if getattr(keys, resists) is None or forces is None:
            raise ParameterError("unevenness", keys.unevenness, "needs_other", REMOVED, other=resists)
        if keys.acceleration:
            raise ParameterError("acceleration", keys.acceleration, "other_is_given", REMOVED, other="unevenness")
        weights = bool(weighs(keys) and keys.gravity)
        marks = np.sort(np.concatenate([over.marks, *(self._balanced(weighed) for weighed in {False, weights})]))
        at, bodies = self.levers.moved(marks), forces.bodies
        work, moving = forces.work(at), frames(self.levers, at)

        def inertia(at: Moved) -> Real:
            return reduced_inertia(bodies, frames(self.levers, at), keys.speed)

        try:
            wheel = mertsalov(Cycle(marks, work, inertia(at)), keys.speed, keys.unevenness)
        except ParameterError as error:
            raise error.renamed(resists) from error
        page.section("Flywheel, by Mertsalov")
        page.add("unevenness", keys.unevenness, given=True)
        page.add("resisting_work", float(work[-1]))
        page.add("driving_moment", wheel.driving, "{A_c} / (2 * pi)")
        if bodies:
            page.told(least_reduced_inertia=-self._most(lambda at: -inertia(at)))
            page.told(greatest_reduced_inertia=self._most(inertia))
        page.add("flywheel_energy", wheel.swing)
        page.add("flywheel_inertia", wheel.moment, "{dT} / ({omega_1}**2 * {delta})", _MERTSALOV)
        if weights:
            page.note("weights, which do no work over a turn, are left out of the flywheel's diagrams")
            fallen = weights_work(bodies, cmath.rect(keys.gravity, math.radians(keys.gravity_angle_deg)), moving)
            swing_of_all = float(np.ptp(wheel.of_flywheel + fallen))
            page.add("weighed_flywheel_energy", swing_of_all)
            page.add("weighed_flywheel_inertia", swing_of_all / (keys.speed**2 * keys.unevenness),
                     "{dT_G} / ({omega_1}**2 * {delta})")  # fmt: skip
        angle = np.append(over.angles, over.angles[0] + 2 * math.pi)
        shown = np.searchsorted(marks, angle)
        loaded = forces.at(self.levers.moved(angle))
        resisting, gained, of_links, of_flywheel = (
            forces.against(loaded), *(x[shown] for x in (wheel.gained, wheel.of_links, wheel.of_flywheel))
        )  # fmt: skip
        columns = (np.degrees(angle), resisting, inertia(at)[shown], work[shown], wheel.driving * (angle - angle[0]),
                   gained, of_links, of_flywheel)  # fmt: skip
        heads = (("φ_1", "deg"), ("M_c", "N*m"), ("J", "kg*m2"), ("A_c", "J"), ("A_d", "J"), ("ΔT", "J"), ("ΔT_l", "J"),
                 ("ΔT_m", "J"))  # fmt: skip
        rows = zip(*(values[:: self.fine // keys.positions] for values in columns), strict=True)
        page.table("cycle", N_("Moments, works and energies over the turn"), heads, rows)
        return Run(np.degrees(angle), resisting, wheel.driving, gained, of_links, of_flywheel)

    def _balanced(self, weighed: bool) -> Real:
        """Angles of the crank at which what it is asked for is what drives it, rad: extremes of a flywheel's energy."""
        forces, over = self.forces, self.over
        assert forces is not None
        mean = forces.work(self.levers.moved(over.marks))[-1] / (2 * math.pi)

        def lacking(angles: Real) -> Real:
            loaded = forces.at(self.levers.moved(angles))
            acting = [one for name, one in loaded.acting.items() if weighed or not name.startswith("G_")]
            return by_zhukovsky(acting, loaded.moving, self.keys.speed) / 1000 - mean

        values = lacking(over.angles)
        after = np.roll(values, -1)
        (turns,) = np.nonzero((values > 0) != (after > 0))
        before = over.angles[turns]
        return bracketed_roots(lacking, before, before + over.step, values[turns], after[turns])

    def _plans_at(self, at: Moved) -> tuple[Plan, Plan]:
        """Plans of velocities and of accelerations in a position."""
        return (
            plan_of(self._velocity_vectors(at), self.keys.velocity_scale, room_of(self.keys)),
            plan_of(self._acceleration_vectors(at), self.keys.acceleration_scale, room_of(self.keys)),
        )

    def _plans(self) -> tuple[Plan, Plan]:
        """Plans of velocities and of accelerations, as tables too."""
        speeds, changes = self._plans_at(self.at)
        for key, title, unit, plan in (
            ("velocity_plan", N_("Plan of velocities, {scale:g} m/s for 1 mm"), "m/s", speeds),
            ("acceleration_plan", N_("Plan of accelerations, {scale:g} m/s² for 1 mm"), "m/s2", changes),
        ):
            self.page.tables.append(plan.table(key, message(title, scale=plan.scale), unit))
        return speeds, changes

    def _measured(self, plans: tuple[Plan, Plan]) -> None:
        """Lengths that were measured on a student's own plans beside the exact ones."""
        given, known = self.keys.measured or {}, [v.name for plan in plans for v in plan.vectors]
        typed_as = dict[str, str]()
        for typed, length in given.items():
            name = re.sub("^pi", "π", typed)
            if name not in known:
                raise ParameterError(f"measured.{typed}", length, "no_such_name", None, known=known)
            if name in typed_as:
                raise either(f"measured.{typed}", length, f"measured.{typed_as[name]}")
            typed_as[name] = typed
        lengths = {name: given[typed] for name, typed in typed_as.items()}
        if not lengths:
            return
        beyond = [
            self._compared(plans[0], lengths, "measured_velocities", N_("Measured on the plan of velocities"), "m/s"),
            self._compared(
                plans[1], lengths, "measured_accelerations", N_("Measured on the plan of accelerations"), "m/s2"
            ),
        ]
        if not any(beyond):
            self.page.note("what was measured is within the {most:g} % that the guidelines allow", most=_TOLERANCE)

    def _compared(self, plan: Plan, lengths: Mapping[str, float], key: str, title: Text, unit: str) -> bool:
        """A table of one plan's vectors, and whether any is off by more than the guidelines allow."""
        rows, beyond = [], False
        for vector in (v for v in plan.vectors if v.name in lengths):
            exact, length = abs(vector.end - vector.start), lengths[vector.name]
            right, read = exact / plan.scale, length * plan.scale
            off = 100 * (read / exact - 1) if exact else math.inf
            rows.append((vector.name, length, right, read, exact, off))
            if abs(off) <= _TOLERANCE:
                continue
            beyond = True
            if abs(length - right) <= _READ:
                text = N_(
                    "{vector}: {read:g} mm, to which a plan is read, is more than {most:g} % of its {right:.3g} mm"
                )
                self.page.note(text, vector=vector.name, read=_READ, most=_TOLERANCE, right=right)
            else:
                text = N_("{vector} is off by {off:.2g} %, more than the {most:g} % that the guidelines allow")
                self.page.note(text, vector=vector.name, off=off, most=_TOLERANCE)
        heads = ((N_("vector"), ""), (N_("measured"), "mm"), (N_("on the plan"), "mm"), (N_("value measured"), unit),
                 (N_("value"), unit), (N_("difference"), "%"))  # fmt: skip
        if rows:
            self.page.table(key, title, heads, rows)
        return beyond

    def _picture(self, plans: tuple[Plan, Plan], run: Run | None, forces: list[tuple[Text, Plan]]) -> None:
        fixed = {"O1": 0j}
        if not isinstance(self.levers.first, Slider):
            fixed["O3"] = self.levers.first.pivot
        if isinstance(self.levers.second, Rods):
            fixed["O5"] = self.levers.second.pivot
        shown = [{name: at.place(name) for name in at.points} | self._centres(at) for at in (self.at, self.turn)]
        blocks = {"A": complex(self.at.links["3"][0])} if self.at.reach is not None else {}
        if self._slides:
            blocks[self._output] = self.way
        if isinstance(second := self.levers.second, Slider) and self._is_twin:
            blocks["D"] = cmath.exp(1j * second.angle)
        points = {name: complex(place) for name, place in shown[0].items()}
        angles = self.keys.start_angle_deg + 360 * np.arange(self.fine) / self.fine
        self.page.picture = LeverPicture(
            points, shown[1], fixed, blocks, *plans, angles, self._series(), run, tuple(forces), len(self.angles)
        )

    def _centres(self, at: Moved) -> dict[str, Complex]:
        """Centres of mass of the rods, as far as they are told."""
        told = (
            {}
            if self.forces is None
            else {body.link: body.centre for name, body in self.forces.named if name.isdigit()}
        )
        if self.keys.mass_point is not None:
            told["2"] = complex(self.keys.mass_point * self._rod)
            if self._is_twin:
                told["4"] = told["2"]
        moving = frames(self.levers, at)
        return {
            f"S{link}": moving[link].point(told[link])[0] for link in ("2", "4") if link in at.links and link in told
        }

    def _sheet(self, file: str) -> None:
        """The sheets for coursework, drawn when their language is known."""
        from parts.mates.sheets.lever_sheet import LeverDrawing

        keys, picture = self.keys, self.page.picture
        assert isinstance(picture, LeverPicture)
        second = None
        if keys.second_position is not None:
            angle = self.start + 2 * math.pi * keys.second_position / keys.positions
            second = (keys.second_position, *self._plans_at(self.levers.moved(angle)))
        block = keys.title_block if isinstance(keys.title_block, TitleBlockTable) else TitleBlockTable()
        given = {name: value for name in ("velocity_scale", "acceleration_scale", "force_scale")
                 if (value := getattr(keys, name)) is not None}  # fmt: skip
        title: Text = N_("Kinematic study of the mechanism")
        if self.number is not None:
            title = message(N_("Kinematic study of the mechanism: {machine}"), machine=message(MACHINES[self.number]))
        drawing = LeverDrawing(
            title, picture, self.drawn, self.levers.crank / self.drawn, self._output, second,
            self.lever, keys.speed, given, keys.paper, block if keys.title_block else None,
        )  # fmt: skip

        def pages(language: str) -> list[Expected]:
            try:
                return drawing.pages(language)
            except ParameterError as error:
                own = error.name in TitleBlockTable.__struct_fields__
                raise refusal(TOPIC, error, "title_block" if own else "", keys) from error

        self.page.paper_file, self.page.paper = file, pages

    def _series(self) -> tuple[tuple[str, str, Real], ...]:
        """Travel, velocity and acceleration of the output over the turn, along its guide or about its pivot."""
        if self.between is not None:
            return ()
        turn, name = self.turn, self._output
        if self._slides:
            place, *rates = (self._along(x) for x in (turn.place(name), turn.velocity(name), turn.acceleration(name)))
            return ("S", "mm", place - place.min()), ("V", "m/s", rates[0] / 1000), ("a", "m/s2", rates[1] / 1000)
        link = "3" if self.levers.second is None else "5"
        place, rates = np.unwrap(turn.angle(link)), list(turn.turning(link))
        return ("ψ", "deg", np.degrees(place - place.min())), ("ω", "rad/s", rates[0]), ("ε", "rad/s2", rates[1])

    def _velocity_vectors(self, at: Moved) -> list[Vector]:
        ends = {name: complex(at.velocity(name)) / 1000 for name in at.points}
        found = [Vector("pa", 0j, ends["A"])]
        if at.reach is not None:
            rate, lever = float(at.turning("3")[0]), complex(at.links["3"][0])
            own = 1j * rate * lever * float(at.reach[0]) / 1000
            found += [Vector("pa3", 0j, own), Vector("a3a2", ends["A"], own)]
        found += [Vector(f"p{name.lower()}", 0j, ends[name]) for name in ends if name != "A"]
        if "2" in at.links:
            found.append(Vector("ab", ends["A"], ends["B"]))
        if "D" in ends:
            joint = "A" if self._is_twin else "C"
            found.append(Vector(f"{joint.lower()}d", ends[joint], ends["D"]))
        return found

    def _acceleration_vectors(self, at: Moved) -> list[Vector]:
        ends = {name: complex(at.acceleration(name)) / 1000 for name in at.points}
        found = [Vector("πa", 0j, ends["A"])]
        if self.levers.change:
            normal = -(self.levers.speed**2) * complex(at.place("A")) / 1000
            found += [Vector("πn1", 0j, normal), Vector("n1a", normal, ends["A"])]
        if at.reach is not None:
            rate, change = map(float, at.turning("3"))
            lever, far = complex(at.links["3"][0]), float(at.reach[0]) / 1000
            normal = -(rate**2) * far * lever
            coriolis = ends["A"] - 2j * rate * float(at.reach[1]) / 1000 * lever
            own = normal + 1j * change * far * lever
            found += [Vector("a2k", ends["A"], coriolis), Vector("ka3", coriolis, own)]
            found += [Vector("πn3", 0j, normal), Vector("n3a3", normal, own)]
        found += [Vector(f"π{name.lower()}", 0j, ends[name]) for name in ends if name != "A"]
        for link, one, two in (("2", "A", "B"), ("4", "A" if self._is_twin else "C", "D")):
            if link in at.links:
                rate = float(at.turning(link)[0])
                rod = complex(at.place(two) - at.place(one)) / 1000
                normal = ends[one] - rate**2 * rod
                found += [Vector(f"{one.lower()}n{link}", ends[one], normal)]
                found += [Vector(f"n{link}{two.lower()}", normal, ends[two])]
        for link, group, end in (("3", self.levers.first, "B"), ("5", self.levers.second, "D")):
            if isinstance(group, Rods):
                normal = -(float(at.turning(link)[0]) ** 2) * complex(at.place(end) - group.pivot) / 1000
                found += [Vector(f"πn{link}", 0j, normal), Vector(f"n{link}{end.lower()}", normal, ends[end])]
        return found

    def _notes(self) -> None:
        page, levers = self.page, self.levers
        if self.number is not None:
            machine = message(MACHINES[self.number])
            one, *more = self.rows
            rows = message("row {one}", one=one)
            if more:
                # the record-book number chooses the rows of three groups of columns
                rows = message("rows {a}, {b}, {c} of columns a, b, v", a=one, b=more[0], c=more[1])
            page.note("assignment {number}, {rows}: {machine}", number=self.number, rows=rows, machine=machine)
            if self.number != 1:
                free = ", ".join(name for name in _STANDING if name not in unused(self.keys))
                page.note(
                    "the figure of this assignment is lost: how its links stand is the usual scheme of such a "
                    "machine, assumed; what may be told otherwise: {keys}",
                    keys=free,
                )
            if levers.second is None:
                page.note(
                    "the machine has a second cylinder, links 4 and 5 as 2 and 3 on the same crank: n = 5, p_5 = 7, "
                    "W = 1; second_guide_angle_deg adds it; forces and flywheel are those of one cylinder"
                )
        if isinstance(levers.first, Stone):
            assert self.turn.reach is not None
            most = abs(levers.first.pivot) + levers.crank if self.between is None else float(self.turn.reach[0].max())
            if levers.lever < most:
                text = N_("the stone leaves the lever: it goes to {most:g} mm from O3, the lever ends at {length:g} mm")
                page.note(text, most=most, length=levers.lever)
        if self.between is not None:
            low, high = (math.degrees(end) for end in self.between)
            page.note(_PARTLY, low=low, high=high)
            if self.hindered is not None and self.hindered.nearest is not None:
                page.note(_ROUND, key=self.hindered.name, value=self.hindered.nearest.value)
        elif not isinstance(levers.first, Slider):
            low, high = swing(levers)
            if high - low < 2 * math.pi:
                page.note("the lever swings by {angle:.4g}°", angle=math.degrees(high - low))
            else:
                page.note("the lever goes all the way round")
        if self.is_example:
            page.notes += _SLIPS


_PARTLY = N_(
    "the crank does not turn all round: as its links are joined it moves between φ_1 = {low:.6g}° and {high:.6g}°; "
    "what needs a whole turn (its table, diagrams, greatest values, dead points, a flywheel, the sheet) is left out"
)
_ROUND = N_("it would turn all round with {key} = {value:g}")
_SLIPS = (
    N_("the guidelines' conclusion on the structure names the knotter; this is the screen"),
    N_("the guidelines write l_CD = l_CO3·3.5, and reckon with the 2.8 of row 7, which is right"),
)
