"""The force analysis of ``higherpair calc lever``: forces given, of inertia, group by group, driving link, the check.

Guidelines on coursework, 4.17 to 4.20: the forces are named, each group is in balance with its forces of inertia, the
balancing force follows from the drive, and Zhukovsky's lever tells the same without asking any joint.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.base.roots import crests, tops
from geometry.curves.curve import Real
from geometry.kinematics.flywheel import travelled
from geometry.kinematics.kinetostatics import (
    Acting,
    Body,
    Frame,
    Reactions,
    Toothed,
    by_zhukovsky,
    frames,
    inertial,
    most_power,
    power,
    reactions,
    weight,
)
from geometry.kinematics.levers import Levers, Moved, Rods, Slider, Stone
from parts.base.refusal import REMOVED
from parts.base.texts import N_, Text, message
from parts.mates.pages.lever_keys import LeverKeys, room_of
from parts.mates.pages.lever_picture import Plan, Vector, plan_of
from parts.pages.page import Sheet

Mask = NDArray[np.bool_]
_SOURCE = "guidelines, 4.19"
# keys that are tables of links
_OF_LINKS = ("masses", "inertias", "centres", "centre_offsets")
# a group whose rods meet at a smaller sine holds nothing that a number could tell
_DEAD = 1e-3
# parts of the crank's speed at which an output stands, its resistance being about to turn round
_STANDS = 1e-9
# what counts for a force or a moment of a position that holds none, below all numbers that are
_NOT_HELD = -1e300


class Loaded(Record, eq=False):
    """A mechanism in some positions with all that acts on it, by name, and what that asks of its joints."""

    moving: dict[str, Frame]
    acting: dict[str, Acting]
    found: Reactions

    @property
    def held(self) -> Mask:
        """Whether each position is one in which the groups hold their loads."""
        return np.asarray(self.found.bite >= _DEAD)


class LeverForce(Record):
    """What acts on Zhukovsky's lever: a force (N) with the velocity of its point (m/s), a couple (N m) with the
    angular velocity of its link (1/s).
    """

    name: str
    velocity: complex
    force: complex
    couple: float = 0.0
    turning: float = 0.0


class Turn(Record, eq=False):
    """A whole turn of the crank: equidistant ``angles``, and the ``dead`` points where the output turns back, rad."""

    angles: Real
    dead: Real

    @property
    def step(self) -> float:
        """Between neighbouring angles, rad."""
        return 2 * math.pi / len(self.angles)

    @property
    def marks(self) -> Real:
        """All of them, from the first position to the first one again."""
        return np.sort(np.concatenate([self.angles, self.dead, self.angles[:1] + 2 * math.pi]))


class Forces:
    """The loads that keys name, on the mechanism of the same keys.

    Raises
    ------
    ParameterError
        A key of a link, a point or an output that the mechanism has not.
    """

    def __init__(self, keys: LeverKeys, levers: Levers) -> None:
        self.keys, self.levers = keys, levers
        self.links = [str(k + 1) for k in range(levers.links)]
        self.output = self.links[-1]
        self.slides = isinstance(levers.second or levers.first, Slider)
        self.named = _bodies(keys, levers, self.links)
        self.teeth = None
        if keys.drive_radius is not None:
            angles = (math.radians(keys.drive_pressure_angle_deg), math.radians(keys.drive_angle_deg))
            self.teeth = Toothed(keys.drive_radius, *angles)
        for name, wrong in (("resistance", not self.slides), ("resisting_moment", self.slides)):
            if getattr(keys, name) is not None and wrong:
                code = "needs_slider" if name == "resistance" else "needs_rocker"
                raise ParameterError(name, getattr(keys, name), code, REMOVED)

    @property
    def bodies(self) -> list[Body]:
        """All masses: of links, and at points."""
        return [body for _, body in self.named]

    def at(self, at: Moved, going: Real | None = None) -> Loaded:
        """The loads in the positions of ``at``; ``going``: the sense of the output, unless it is that there."""
        moving = frames(self.levers, at)
        gravity = cmath.rect(self.keys.gravity, math.radians(self.keys.gravity_angle_deg))
        acting: dict[str, Acting] = {}
        for name, body in self.named:
            if gravity and body.mass:
                acting[f"G_{name}"] = weight(body, gravity, moving[body.link])
            acting[f"F_i{name}"] = inertial(body, moving[body.link])
        opposed = self._opposed(self.going(moving) if going is None else going)
        if self.keys.resistance is not None:
            force = self.keys.resistance * opposed * moving[self.output].way[0]
            acting["F_c"] = Acting(self.output, 0j, force, np.zeros(np.shape(force)))
        if self.keys.resisting_moment is not None:
            couple = 1000 * self.keys.resisting_moment * opposed
            acting[f"M_c{self.output}"] = Acting(self.output, 0j, np.zeros(np.shape(couple), complex), couple)
        return Loaded(moving, acting, reactions(self.levers, at, acting.values(), self.teeth))

    def way(self, moving: dict[str, Frame]) -> Real:
        """How fast the output goes forward: mm/s along its guide, or rad/s."""
        frame = moving[self.output]
        return np.asarray(np.real(np.conj(frame.way[0]) * frame.origin[1]) if self.slides else frame.turning()[0])

    def stands(self, moving: dict[str, Frame]) -> Mask:
        """Whether the output stands, so that no resistance against its motion has a sense."""
        fast = self.levers.speed * (self.levers.crank if self.slides else 1.0)
        return np.asarray(np.abs(self.way(moving)) <= _STANDS * fast)

    def going(self, moving: dict[str, Frame]) -> Real:
        """The sense in which the output goes: 1 forward, -1 backward, 0 where it stands."""
        return np.where(self.stands(moving), 0.0, np.sign(self.way(moving)))

    def work(self, at: Moved) -> Real:
        """What is done against the resistance since the first position, J; between them no output turns round."""
        frame, force = frames(self.levers, at)[self.output], self.keys.resistance
        place = np.real(np.conj(frame.way[0]) * frame.origin[0]) / 1000
        if not self.slides:
            place, force = np.unwrap(np.angle(frame.way[0])), self.keys.resisting_moment
        ways = {"forward": (True,), "backward": (False,), "both": (True, False)}[self.keys.resisted]
        gone = sum((travelled(place, forward=forward) for forward in ways), np.zeros(len(place)))
        return (force or 0.0) * gone

    def against(self, loaded: Loaded) -> Real:
        """What the resistance asks of the crank, N m."""
        acting = loaded.acting.get("F_c" if self.slides else f"M_c{self.output}")
        if acting is None:
            return np.zeros(len(loaded.found.moment))
        return -power(acting, loaded.moving[self.output]) / self.levers.speed

    def _opposed(self, sense: Real) -> Real:
        """The sense of the resistance: -1, 1, or 0 where it does not act."""
        idle = {"forward": sense < 0, "backward": sense > 0, "both": np.zeros(np.shape(sense), bool)}
        return np.where(idle[self.keys.resisted], 0.0, -sense)


def _bodies(keys: LeverKeys, levers: Levers, links: list[str]) -> list[tuple[str, Body]]:
    """Masses by the link or the point that they are named after."""
    first, second = levers.first, levers.second
    lengths = {"1": levers.crank, "3": levers.lever}
    if not isinstance(first, Stone):
        lengths["2"] = first.rod
    if second is not None:
        lengths["4"] = second.rod
        if not isinstance(second, Slider):
            lengths["5"] = second.rocker
    masses, inertias, centres, offsets = _given(keys, links, slides=isinstance(second or first, Slider))
    shares = {"1": 0.0} | ({} if keys.mass_point is None else {"2": keys.mass_point})
    found = []
    for link in links:
        if link in masses or link in inertias:
            along = centres.get(link, shares.get(link, 0.5) * lengths.get(link, 0.0))
            place = complex(along, offsets.get(link, 0.0))
            found.append((link, Body(link, masses.get(link, 0.0), inertias.get(link, 0.0), place)))
    places = {"A": ("1", complex(levers.crank)), "B": ("3", complex(levers.lever))}
    if second is not None:
        places |= {"C": ("3", levers.arm), "D": ("5", complex(lengths.get("5", 0.0)))}
    for point, mass in (keys.point_masses or {}).items():
        if point not in places:
            raise ParameterError(f"point_masses.{point}", mass, "no_such_point", None, known=list(places))
        link, place = places[point]
        found.append((point, Body(link, mass, 0.0, place)))
    return found


def _given(keys: LeverKeys, links: list[str], *, slides: bool) -> list[dict[str, float]]:
    """What keys give of links, in the order of ``_OF_LINKS``, or a ParameterError; ``slides``: the last one does."""
    masses, _, centres, _ = tables = [getattr(keys, name) or {} for name in _OF_LINKS]
    for name, given in zip(_OF_LINKS, tables, strict=True):
        for link, value in given.items():
            if link not in links:
                raise ParameterError(f"{name}.{link}", value, "no_such_link", None, known=links)
            if name == "inertias" and link == links[-1] and slides:
                raise ParameterError(f"{name}.{link}", value, "does_not_turn", REMOVED)
            if name.startswith("centre") and link not in masses:
                raise ParameterError(f"{name}.{link}", value, "needs_other", REMOVED, other=f"masses.{link}")
    if keys.mass_point is not None and "2" in centres:
        raise ParameterError("centres.2", centres["2"], "other_is_given", REMOVED, other="mass_point")
    return tables


def asked(keys: LeverKeys) -> bool:
    """Whether any load is given."""
    return weighs(keys) or any((keys.inertias, keys.resistance, keys.resisting_moment))


def weighs(keys: LeverKeys) -> bool:
    """Whether any mass is given."""
    return bool(keys.masses or keys.point_masses)


class ForcePage:
    """The sections and tables of the force analysis; ``plans``: those of forces, for the picture.

    ``angles``: the crank's positions of the table; ``turn``: None where it does not turn round.
    """

    def __init__(self, page: Sheet, forces: Forces, at: Moved, angles: Real, turn: Turn | None) -> None:
        self.page, self.forces, self.keys, self.levers = page, forces, forces.keys, forces.levers
        self.turn = turn
        self.rows = forces.at(self.levers.moved(angles))
        self.one = forces.at(at)
        self.degrees = np.degrees(angles)
        self.plans: list[tuple[Text, Plan]] = []

    def add(self) -> None:
        """All of it."""
        self._given()
        self._inertia()
        if self.one.held:
            if self.levers.second is not None:
                self._group("3", "4", "5")
            self._group("1", "2", "3")
            self._driving()
            self._check()
        self._over_a_turn()
        self._notes()

    def lever(self) -> Iterator[LeverForce]:
        """What acts on Zhukovsky's lever in the first position."""
        for name, one in self.one.acting.items():
            frame = self.one.moving[one.link]
            speed, rate = complex(frame.point(one.at)[1]) / 1000, float(frame.turning()[0])
            yield LeverForce(name, speed, complex(one.force), float(one.couple) / 1000, rate)

    def _given(self) -> None:
        page, keys = self.page, self.keys
        page.section("Forces given")
        page.add("force_equations", 3 * self.levers.links, "3 * {n}")
        page.add("force_unknowns", 2 * self.levers.lower_pairs + 1, "2 * {p_5} + 1", "guidelines, 4.18")
        if keys.gravity and weighs(keys):
            page.given(gravity=keys.gravity, gravity_angle_deg=keys.gravity_angle_deg)
        for name, body in self.forces.named:
            of: Text = message(N_("point {name}") if name.isalpha() else N_("link {name}"), name=name)
            if self._heavy(name):
                term = "point_mass" if name.isalpha() else "link_mass"
                page.add(term, body.mass, symbol=f"m_{name}", of=of, given=True)
            if name.isdigit() and not (self.forces.slides and name == self.forces.output):
                page.add("link_inertia", body.inertia, symbol=f"J_{name}", of=of, given=True)
            if name.isdigit() and self._heavy(name):
                page.add("centre_along", body.centre.real, symbol=f"x_S{name}", of=of, given=True)
                if body.centre.imag:
                    page.add("centre_across", body.centre.imag, symbol=f"y_S{name}", of=of, given=True)
            if keys.gravity and self._heavy(name):
                page.add("link_weight", body.mass * keys.gravity, f"{{m_{name}}} * {{g}}", symbol=f"G_{name}", of=of)
        page.given(resisting_force=keys.resistance)
        if keys.resisting_moment is not None:
            page.add("resisting_moment", keys.resisting_moment, symbol=f"M_c{self.forces.output}", given=True)
        if keys.drive_radius is not None:
            page.given(drive_radius=keys.drive_radius, drive_pressure_angle_deg=keys.drive_pressure_angle_deg)
            page.given(drive_angle_deg=keys.drive_angle_deg)

    def _heavy(self, name: str) -> bool:
        """Whether a mass is given, not a moment of inertia alone."""
        return name.isalpha() or name in (self.keys.masses or {})

    def _inertia(self) -> None:
        page = self.page
        if not self.forces.bodies:
            return
        page.section("Forces of inertia")
        for name, body in self.forces.named:
            frame, acting = self.one.moving[body.link], self.one.acting[f"F_i{name}"]
            if self._heavy(name):
                change = 2 * abs(complex(frame.point(body.centre)[2])) / 1000
                at = f"S{name}" if name.isdigit() else name
                of = message("point {name}", name=at)
                page.add("point_acceleration", change, symbol=f"a_{at}", of=of)
                size, formula = abs(complex(acting.force)), f"{{m_{name}}} * {{a_{at}}}"
                page.add("inertia_force", size, formula, symbol=f"F_i{name}", of=of)
            if body.inertia:
                link = "3" if name == "2" and isinstance(self.levers.first, Stone) else name
                formula = f"{{J_{name}}} * {{ε_{link}}}" if f"ε_{link}" in page.by_symbol else ""
                of = message("link {name}", name=name)
                size = abs(float(acting.couple)) / 1000
                page.add("inertia_moment", size, formula, symbol=f"M_i{name}", of=of)

    def _force(self, pair: str) -> complex:
        """The force of a joint in the position of the plans."""
        return complex(self.one.found.forces[pair])

    def _joint(self, pair: str, formula: str = "", source: str = "") -> None:
        before = N_("the frame on link {two}") if pair[0] == "0" else N_("link {one} on link {two}")
        of = message(before, one=pair[0], two=pair[1])
        size = abs(self._force(pair))
        self.page.add("joint_force", size, formula, source, symbol=f"R_{pair}", of=of)

    def _group(self, before: str, rod: str, last: str) -> None:
        page, found = self.page, self.one.found
        page.section("Structural group of links {one} and {two}", one=rod, two=last)
        outer, inner, frame = before + rod, rod + last, "0" + last
        way = complex(self.one.moving[rod].way[0])
        seen = self._force(outer) / way
        of = message("link {one} on link {two}", one=before, two=rod)
        formula = self._moment_across(rod, last)
        page.add("joint_force_across", abs(seen.imag), formula, symbol=f"R_{outer}t", of=of)
        page.add("joint_force_along", abs(seen.real), symbol=f"R_{outer}n", of=of)
        self._joint(outer, f"sqrt({{R_{outer}t}}**2 + {{R_{outer}n}}**2)", _SOURCE)
        self._joint(inner)
        self._joint(frame)
        for pair in (inner, frame):
            if pair in found.couples:
                couple = float(found.couples[pair]) / 1000
                sliding = message("link {one} and link {two}", one=pair[0], two=pair[1])
                if pair[0] == "0":
                    sliding = message("link {two} in its guide", two=pair[1])
                page.add("guide_moment", couple, symbol=f"M_{pair}", of=sliding)
                across = (self._force(pair) / complex(self.one.moving[pair[1]].way[0])).imag
                if across:
                    formula = f"{'-' if across < 0 else ''}1000 * {{M_{pair}}} / {{R_{pair}}}"
                    page.add("guide_place", 1000 * couple / across, formula, symbol=f"x_{pair}", of=sliding)
        chain = [(f"R_{outer}n", seen.real * way), (f"R_{outer}t", 1j * seen.imag * way)]
        chain += self._of_links(rod)
        upto = len(chain)
        chain += self._of_links(last)
        if last == "3" and self.levers.second is not None:
            chain.append(("R_43", -self._force("34")))
        chain.append((f"R_{frame}", self._force(frame)))
        title = message("Plan of forces of links {one} and {two}", one=rod, two=last)
        # the rod passes on all that has come together up to its end
        passed = Vector(f"R_{inner}", 0j, sum((force for _, force in chain[:upto]), 0j))
        self._plan(inner, title, chain, passed)

    def _moment_across(self, rod: str, last: str) -> str:
        """The moment that the reaction across a link balances, as a step; the formula of that reaction."""
        stone = rod == "2" and isinstance(self.levers.first, Stone)
        if stone:
            links, joint, length = [rod, last], "O3", "r_A"
            of = message("links {one} and {two} about {joint}", one=rod, two=last, joint=joint)
            pivot = complex(self.one.moving[last].origin[0])
        else:
            group = self.levers.first if rod == "2" else self.levers.second
            assert isinstance(group, Rods | Slider)
            links, joint, length = [rod], "B" if rod == "2" else "D", f"l_{rod}"
            of = message("link {link} about {joint}", link=rod, joint=joint)
            pivot = complex(self.one.moving[rod].point(group.rod)[0])
        total = 0.0
        for one in self.one.acting.values():
            if one.link in links:
                arm = complex(self.one.moving[one.link].point(one.at)[0]) - pivot
                total += (arm.conjugate() * complex(one.force)).imag + float(one.couple)
        if stone and self.levers.second is not None:
            arm = complex(self.one.moving["4"].origin[0]) - pivot
            total -= (arm.conjugate() * self._force("34")).imag
        key = f"M_{joint}"
        self.page.add("moment_of_loads", total / 1000, symbol=key, of=of)
        return f"1000 * abs({{{key}}}) / {{{length}}}"

    def _of_links(self, *links: str) -> list[tuple[str, complex]]:
        """The forces on links that are no joint's, by name."""
        found = ((name, one.link, complex(one.force)) for name, one in self.one.acting.items())
        return [(name, force) for name, link, force in found if link in links and force]

    def _plan(self, key: str, title: Text, chain: list[tuple[str, complex]], *across: Vector) -> None:
        """A polygon of forces as a table, and for the picture; it closes. ``across``: vectors between its corners."""
        spots = np.cumsum([0j, *(force for _, force in chain)])
        vectors = (
            Vector(name, complex(start), complex(start + force))
            for (name, force), start in zip(chain, spots, strict=False)
        )
        plan = plan_of((*vectors, *across), self.keys.force_scale, room_of(self.keys))
        told = message("{plan}, {scale:g} N for 1 mm", plan=title, scale=plan.scale)
        self.page.tables.append(plan.table(f"force_plan_{key}", told, "N"))
        self.plans.append((title, plan))

    def _driving(self) -> None:
        page, found = self.page, self.one.found
        page.section("Driving link")
        end, force = complex(self.one.moving["2"].origin[0]), -self._force("12")
        turn = (end.conjugate() * force).imag
        of = N_("link 2 on link 1")
        page.add("joint_force", abs(force), "{R_12}", symbol="R_21", of=of)
        # the crank's own part, by weight and inertia off its axis
        way, of_crank = complex(self.one.moving["1"].way[0]), [a for a in self.one.acting.values() if a.link == "1"]
        own = sum(((a.at * way).conjugate() * complex(a.force)).imag + float(a.couple) for a in of_crank) / 1000
        terms = []
        if own:
            page.add("crank_moment", own)
            terms.append("-{M_1}")
        if turn:
            page.add("joint_arm", abs(turn) / abs(force), symbol="h_21", of=of)
            # against what the reaction turns
            terms.append(f"{'-' if turn > 0 else '+'} {{R_21}} * {{h_21}} / 1000")
        formula = " ".join(terms).removeprefix("+ ")
        page.add("balancing_moment", float(found.moment) / 1000, formula, _SOURCE)
        if self.forces.teeth is not None:
            formula = "1000 * abs({M_b}) / ({r_w} * cos({alpha_w}))"
            page.add("balancing_force", abs(complex(found.driving)), formula, "guidelines, 4.20")
        self._joint("01")
        chain = [("R_21", force), *self._of_links("1")]
        if self.forces.teeth is not None:
            chain.append(("F_b", complex(found.driving)))
        chain.append(("R_01", self._force("01")))
        self._plan("1", message("Plan of forces of the driving link"), chain)

    def _check(self) -> None:
        page, loaded, speed = self.page, self.one, self.levers.speed
        page.section("Check by Zhukovsky's lever")
        powers = {name: float(power(one, loaded.moving[one.link])) for name, one in loaded.acting.items()}
        moment = float(by_zhukovsky(loaded.acting.values(), loaded.moving, speed)) / 1000
        page.add("powers", sum(powers.values()))
        page.add("lever_balancing_moment", moment, "-{P_sum} / {omega_1}")
        sizes = sum(float(most_power(one, loaded.moving[one.link])) for one in loaded.acting.values()) / speed
        if sizes:
            page.add("lever_moments", sizes)
            difference = 100 * abs(float(loaded.found.moment) / 1000 - moment) / sizes
            page.add("balance_difference", difference, "100 * abs({M_b} - {M_bZ}) / {M_sum}")
        heads = ((N_("force"), ""), (N_("value"), "N"), (N_("moment"), "N*m"), (N_("power"), "W"))
        rows = [(n, abs(complex(one.force)), float(one.couple) / 1000, powers[n]) for n, one in loaded.acting.items()]
        driving, balancing = abs(complex(loaded.found.driving)), float(loaded.found.moment) / 1000
        name, couple = ("F_b", 0.0) if self.forces.teeth else ("M_b", balancing)
        rows.append((name, driving, couple, balancing * speed))
        page.table("powers", N_("Powers of all forces: their sum is zero"), heads, rows)

    def _over_a_turn(self) -> None:
        """Balancing moment and reactions in the joints in all positions, and the greatest of the turn."""
        page, rows, turn = self.page, self.rows, self.turn
        held = rows.held
        heads, columns = [("φ_1", "deg"), ("M_b", "N*m")], [self.degrees, rows.found.moment / 1000]
        if self.forces.teeth is not None:
            heads.append(("F_b", "N"))
            columns.append(np.abs(rows.found.driving))
        pairs = sorted(rows.found.forces)
        heads += [(f"R_{pair}", "N") for pair in pairs]
        columns += [np.abs(rows.found.forces[pair]) for pair in pairs]
        page.table("forces", N_("Balancing moment and reactions in the joints"), heads, np.array(columns)[:, held].T)
        if turn is None:
            return
        fine = self.forces.at(self.levers.moved(turn.angles))
        if not fine.held.any():
            return
        *most, (up, _), (down, _) = self._most(fine, turn, pairs)
        greatest = [(f"R_{pair}", value, math.degrees(at) % 360) for pair, (value, at) in zip(pairs, most, strict=True)]
        heads = [(N_("force"), ""), (N_("value"), "N"), ("φ_1", "deg")]
        page.table("greatest_forces", N_("Greatest reactions in the joints over the turn"), heads, greatest)
        page.section("Forces over a turn")
        page.told(greatest_balancing_moment=up / 1000, least_balancing_moment=-down / 1000)
        # what the resistance asks has corners at the dead points; its work has not
        smooth = (fine.found.moment / 1000 - self.forces.against(fine))[fine.held]
        work = self.forces.work(self.levers.moved(turn.marks))[-1]
        page.add("mean_balancing_moment", float(smooth.mean() + work / (2 * math.pi)))

    def _most(self, fine: Loaded, turn: Turn, pairs: list[str]) -> list[tuple[float, float]]:
        """The greatest over the turn, and where, rad: of reactions in joints, N, of the balancing moment, N mm, and of
        that with the other sign.

        At a dead point the resistance turns round, and a reaction jumps: there both ends of the jump count.
        """

        def values(angles: Real, going: Real | None = None) -> Real:
            return of(self.forces.at(self.levers.moved(angles), going))

        def of(loaded: Loaded) -> Real:
            moment, forces = loaded.found.moment, loaded.found.forces
            return np.where(loaded.held, [*(np.abs(forces[pair]) for pair in pairs), moment, -moment], _NOT_HELD)

        found = of(fine)
        mine = [tops(row) for row in found]
        rows, near = np.repeat(np.arange(len(mine)), [len(row) for row in mine]), np.concatenate(mine)
        going, each = self.forces.going(fine.moving)[near], np.arange(len(near))
        beside = crests(lambda angles: values(angles, going)[rows, each], turn.angles[near], turn.step)
        ends = [values(turn.dead, np.full(len(turn.dead), way)) for way in (1.0, -1.0)]
        reached = values(beside)[rows, each]
        most = []
        for row, sampled in enumerate(found):
            sizes = np.concatenate([sampled, reached[rows == row], *(end[row] for end in ends)])
            places = np.concatenate([turn.angles, beside[rows == row], turn.dead, turn.dead])
            best = int(np.argmax(sizes))
            most.append((float(sizes[best]), float(places[best])))
        return most

    def _notes(self) -> None:
        page = self.page
        if self.levers.change:
            page.note("speed and acceleration of the crank are taken as the same in all of its positions")
        page.note("friction in the joints is left out of the forces")
        if self.keys.resistance is not None or self.keys.resisting_moment is not None:
            stands = self.forces.stands(self.rows.moving)
            if stands.any():
                text = N_(
                    "the output stands at φ_1 = {angles}: the resistance changes its sense there, and is taken as 0"
                )
                page.note(text, angles=_told(self.degrees[stands]))
        if not self.rows.held.all():
            text = N_(
                "dead positions, φ_1 = {angles}: the links of a group stand in one line, or a rod across its guide, "
                "and hold no load; no forces are told there"
            )
            page.note(text, angles=_told(self.degrees[~self.rows.held]))


def _told(angles: Iterable[float]) -> str:
    return ", ".join(f"{angle:.6g}°" for angle in angles)
