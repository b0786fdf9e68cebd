"""``higherpair calc train``: lesson 2 step by step: mobility, stages, inversion, ratio, speeds, torques, power."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from fractions import Fraction
from itertools import pairwise
from typing import Annotated, Any

from msgspec import Meta, Struct

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.planetary.sets import coaxial_modules
from geometry.kinematics.mechanism import FRAME, Mobility, Rolling, Turns, mobility, turns
from geometry.kinematics.statics import Statics, statics
from parts.base.refusal import REMOVED, SceneError, meant
from parts.base.texts import N_, Message, Text, listed, message
from parts.keys.base import mm
from parts.mates.pages.train_cases import CASES, Case
from parts.mates.pages.train_model import ACROSS, Leg, Mesh, Stage, Train, central_ways, parsed, satellites, stages
from parts.pages.inputs import PLACE, checked, exact, refusal
from parts.pages.misprints import printed_for
from parts.pages.page import Printed, Sheet

TOPIC = "train"
Name = str | int
# what the practicum prints before (2.5)
_DERIVATION = N_("before (2.5) the practicum prints -ω_H/ω_H - ω_1/ω_H: the first term has a plus")
_PRIME = Printed("(4): 1 - z_2·z_3/(z_1·z_2)", N_("the prime of z_2' is lost, with it z_2 would cancel"))
_KINDS = {
    "external": N_("external"),
    "internal": N_("internal"),
    "bevel": N_("bevel"),
    "worm": N_("worm"),
    "crossed": N_("crossed helical"),
}
_PAIRS_TOLD = 4
# rad/s
_RPM = Fraction(math.pi) / 30
_BLANK = "________"


_TEETH = "numbers of teeth: of wheels 1, 2, … in a list, or by name, as teeth.2'=20; a worm's starts"
_COUNTED = "turns of the driven link counted for one of the driver, below 0 the other way"
_CARRIERS = Meta(description="wheels that are satellites of each carrier: wheel 2 of H is carriers.H=2")
_MESHES = "wheels in mesh, as 1-2, 2'-3 internal 3.5: kind and module where they differ, + or - of bevels"
_Teeth = Annotated[int, Meta(ge=1)]

_CASE = Meta(description="a train of the sources to start from, as practicum_1, 2.10.2, trains_7")
_SPEEDS = Meta(description="angular velocities of the driving links in rad/s, as speeds.1=120")
_TORQUES = Meta(description="torques of the loads in N m, counter-clockwise above 0, as torques.H=-4")


class TrainKeys(Struct, forbid_unknown_fields=True):
    """Keys of the topic."""

    case: Annotated[str, _CASE] | None = None
    teeth: Annotated[list[_Teeth] | dict[str, _Teeth], Meta(description=_TEETH)] | None = None
    meshes: Annotated[str, Meta(description=_MESHES)] = ""
    shafts: Annotated[str, Meta(description="wheels of one shaft, as 2-3, H-5; 2 and 2' need no such word")] = ""
    carriers: Annotated[dict[str, Name], _CARRIERS] = {}
    held: Annotated[Name, Meta(description="held wheels or carriers, with commas between them")] = ""
    driver: Annotated[Name, Meta(description="driving link; default: the first wheel")] = ""
    driven: Annotated[Name, Meta(description="driven link; default: the last one that is not held")] = ""
    speeds: Annotated[dict[str, float], _SPEEDS] = {}
    speeds_rpm: Annotated[dict[str, float], Meta(description="the same in rpm, as speeds_rpm.1=1150")] = {}
    torques: Annotated[dict[str, float], _TORQUES] = {}
    mesh_efficiency: Annotated[float, Meta(gt=0, le=1, description="efficiency of every mesh")] = 1.0
    module: Annotated[float, mm("module, for distances and forces", least=0.01, most=1000)] | None = None
    counted_turns: Annotated[float, Meta(ge=-1e6, le=1e6, description=_COUNTED)] | None = None


def sheet(table: dict[str, Any]) -> Sheet:
    """The analysis of one train; ``names`` of the table: which instance of a scene each name stands for."""
    names = table.pop("names", {})
    keys: TrainKeys = checked(table, TrainKeys, TOPIC)
    try:
        return _Page(keys, names).made()
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error


def _teeth(ends: Leg | Stage, ratio: Fraction) -> str:
    """The formula of a ratio by the teeth of the last wheel and the first."""
    return f"{'-' if ratio < 0 else ''}{{z_{ends.end}}} / {{z_{ends.start}}}"


class _Page:
    """The sheet of one train; formulas know stages as s_1."""

    def __init__(self, keys: TrainKeys, names: Mapping[str, str]) -> None:
        if keys.case is not None and keys.case not in CASES:
            place, known = f"{TOPIC}.case", list(CASES)
            raise SceneError(PLACE, place, keys.case, "not_one_of", meant(keys.case, known), known=known)
        case = Case("", "") if keys.case is None else CASES[keys.case]
        given = keys.teeth or {}
        teeth = given if isinstance(given, dict) else {str(k): z for k, z in enumerate(given, 1)}
        self.teeth = {**case.teeth, **teeth}
        self.words = keys.meshes or case.meshes
        if not self.words:
            what = message("wheels in mesh, as 1-2, 2'-3 internal")
            raise ParameterError("meshes", None, "missing_key", None, what=what)
        for name in keys.speeds.keys() & keys.speeds_rpm.keys():
            rpm = keys.speeds_rpm[name]
            raise ParameterError(f"speeds_rpm.{name}", rpm, "other_is_given", REMOVED, other=f"speeds.{name}")
        self.speeds = {name: exact(w) for name, w in {**case.speeds, **keys.speeds}.items()}
        # ratios of them stay exact
        self.speeds |= {name: exact(n) * _RPM for name, n in keys.speeds_rpm.items()}
        # which instance of a scene a name stands for
        self.instances = names
        self.keys, self.open, self.module = keys, case.open, keys.module or case.module
        self.shafts, self.held = keys.shafts or case.shafts, str(keys.held) or case.held
        self.carriers = {**case.carriers, **{c: str(names) for c, names in keys.carriers.items()}}
        self.driven = str(keys.driven) or case.driven
        printed = printed_for(" ".join(map(str, ("train", *self.teeth.values()))))
        self.page = Sheet(TOPIC, N_("Kinematic analysis of a gear train"), printed=printed)

    def made(self) -> Sheet:
        """Scheme, mobility, ratios, speeds, statics and the check by experiment: the practicum's form of report."""
        self._missing_teeth()
        self.train = train = parsed(self.teeth, self.words, self.shafts, self.carriers, self.held)
        if self.keys.module is not None and all(mesh.module for mesh in train.meshes):
            raise ParameterError("module", self.keys.module, "follows_from", REMOVED, key="meshes")
        self._links()
        mechanism = train.mechanism()
        self.drives = [train.bodies[name] for name in self.inputs]
        freedom = mobility(mechanism)
        if freedom.degrees < 1 and train.held and mobility(replace(mechanism, held=())).degrees > 0:
            raise ParameterError("held", ", ".join(train.held), "held_too_many")
        if freedom.degrees < 1:
            raise ParameterError("meshes", self.words, "train_is_locked", None, w=freedom.degrees)
        try:
            self.moved: Turns = turns(mechanism, self.drives)
        except ParameterError as error:
            raise error.renamed(self._speed_key(self.inputs[0]) if self.speeds else "driver") from error
        self._scheme()
        self._mobility(freedom)
        self._distances()
        if self.moved.free:
            names = list(dict.fromkeys(self._name(train.bodies[link]) for link in self.moved.free))
            raise ParameterError(self._speed_key(self.inputs[0]), names[0], "left_free", None, free=names)
        found = stages(train, self.inputs[0], self.driven) if len(self.inputs) == 1 else None
        if found:
            self._stages(found)
        else:
            self._equations()
        if len(self.inputs) == 1:
            self._whole(found)
        if self.speeds:
            self._speeds(found or ())
        if self.keys.mesh_efficiency < 1 or self.keys.torques:
            self._statics()
        self._experiment()
        return self.page

    def _missing_teeth(self) -> None:
        """Of a lone pair with both speeds: its ratio, and the teeth that one of its wheels must have; guide, (1)."""
        names = re.match(r"\s*(\S+?)\s*-\s*([^\s,]+)(\s+\w+)?\s*$", self.words)
        missing = [name for name in (names[1], names[2]) if name not in self.teeth] if names else []
        if not names or not missing or any(not self.speeds.get(name) for name in (names[1], names[2])):
            return
        page, one, two = self.page, names[1], names[2]
        page.section("What the speeds ask for")
        for name in (one, two):
            self._tell_speed(name, self.speeds[name], [name])
        u, ratio = self.speeds[one] / self.speeds[two], f"u_{one}{two}"
        external = (names[3] or "external").strip() == "external"
        sign = "-" if external and u > 0 else ""
        self.speeds = {one: self.speeds[one]}
        formula = f"{sign}{{ω_{one}}} / {{ω_{two}}}"
        page.add("mesh_ratio", float(-u if sign else u), formula, "trains (1)", symbol=ratio)
        if len(missing) == 2:
            # any teeth of that ratio
            self.teeth[one], self.teeth[two] = abs(u).denominator, abs(u).numerator
            page.note("no number of teeth is known: the least with that ratio are taken")
            return
        wheel = missing[0]
        other, operation = (one, "*") if wheel == two else (two, "/")
        known = self.teeth[other]
        wanted = known * abs(u) if wheel == two else known / abs(u)
        if wanted.denominator != 1:
            key = self._speed_key(one)
            given, teeth = getattr(self.keys, key).get(one, float(self.speeds[one])), float(wanted)
            raise ParameterError(key, given, "no_whole_teeth", None, wheel=wheel, teeth=teeth)
        self.teeth = {one: self.teeth.get(one, int(wanted)), two: self.teeth.get(two, int(wanted))}
        page.add("number_of_teeth", known, symbol=f"z_{other}")
        formula = f"{{z_{other}}} {operation} abs({{{ratio}}})"
        page.add("number_of_teeth", int(wanted), formula, "trains (1)", symbol=f"z_{wheel}")

    def _links(self) -> None:
        """Who drives and who is driven, by their names."""
        bodies = self.train.bodies
        wheels = [name for name in self.teeth if name in bodies]
        driver = str(self.keys.driver)
        self.inputs = list(self.speeds) or [driver or wheels[0]]
        if driver and self.speeds and driver not in self.speeds:
            raise ParameterError("driver", driver, "driver_without_speed", None, known=list(self.speeds))
        self.driven = self.driven or self._last(bodies.get(self.inputs[0], ""))
        places = [("driver", name) for name in [driver] if name] + [("driven", self.driven)]
        places += [(self._speed_key(name), name) for name in self.inputs]
        for key, name in (*places, *(("torques", name) for name in self.keys.torques)):
            if name not in bodies:
                raise ParameterError(key, name, "no_such_link", meant(name, bodies), known=list(bodies))
        for name in self.inputs:
            if self.train.still(bodies[name]):
                raise ParameterError(self._speed_key(name) if self.speeds else "driver", name, "driver_is_held")
        if len(self.inputs) == 1 and bodies[self.driven] == bodies[self.inputs[0]]:
            raise ParameterError("driven", self.driven, "driven_is_driver")

    def _last(self, start: str) -> str:
        """The last link on a fixed axis, neither held nor the driver, that leads to as few others as possible."""
        train = self.train
        ends = [train.bodies[w] for mesh in train.meshes for w in (mesh.first, mesh.second)]
        leads = {body: ends.count(body) + (body in train.carried.values()) for body in train.bodies.values()}
        moving = [n for n, b in train.bodies.items() if b != start and b not in train.carried and not train.still(b)]
        return min(reversed(moving or list(self.teeth)), key=lambda name: leads[train.bodies[name]])

    def _scheme(self) -> None:
        page, train = self.page, self.train
        page.section("1. Scheme of the mechanism")
        for name, z in train.teeth.items():
            page.add("number_of_teeth", z, symbol=f"z_{name}")
        rows = []
        for mesh in train.meshes:
            carrier = train.carrier(mesh)
            on = "-" if carrier == FRAME else self._name(carrier)
            teeth = float(train.teeth[mesh.first]), float(train.teeth[mesh.second])
            rows.append((mesh.first, mesh.second, _KINDS[mesh.kind], on, *teeth))
        heads = (("1", ""), ("2", ""), (N_("kind"), ""), ("H", ""), ("z_1", ""), ("z_2", ""))
        page.table("meshes", N_("Meshes: first and second wheel, kind, carrier, teeth"), heads, rows)
        if self.instances:
            told = ", ".join(f"{name} {instance}" for name, instance in self.instances.items())
            page.note("names in the scene: {names}", names=told)
        shafts = [names for body in dict.fromkeys(train.bodies.values()) if len(names := self._names(body)) > 1]
        if shafts:
            told = ", ".join("-".join(names) for names in shafts)
            page.note("on one shaft: {shafts}", shafts=told)
        if train.held:
            page.note("held: {links}", links=", ".join(train.held))

    def _names(self, body: str) -> list[str]:
        return [name for name, own in self.train.bodies.items() if own == body]

    def _name(self, body: str) -> str:
        """A body's name as formulas have it: a carrier's own, else the first wheel's."""
        names = self._names(body)
        return next((n for n in names if n not in self.teeth), names[0])

    def _mobility(self, found: Mobility) -> None:
        """(2.1) with n, p5, p4 as the sources count them, and the exact rank."""
        page = self.page
        page.section("2. Degree of freedom")
        page.told(moving_links=found.links, lower_pairs=found.lower_pairs, higher_pairs=found.higher_pairs)
        formula = "3 * {n} - 2 * {p_5} - {p_4}"
        page.add("degree_of_freedom", found.chebyshev, formula, "practicum (2.1)")
        if found.redundant or found.degrees != found.chebyshev:
            page.add("exact_degree_of_freedom", found.degrees)
            told = [f"{s.first}-{s.second}" for r in found.redundant if isinstance(s := r.source, Rolling)]
            page.note("redundant, since they follow from the others: {meshes}", meshes=", ".join(told))
        train = self.train
        moving = [carrier for carrier in train.carried.values() if not train.still(carrier)]
        kind: Text = N_("all axes stand still: an ordinary train")
        if moving:
            kind = N_("satellites turn about moving axes and W = 1: a planetary mechanism")
            if not train.held:
                kind = N_("satellites turn about moving axes, no wheel is held, and W = 1: a closed differential")
            if found.degrees > 1:
                kind = message("satellites turn about moving axes and W = {w}: a differential", w=found.degrees)
        page.note(kind)
        if train.across:
            names = ", ".join(dict.fromkeys(map(self._name, (body for body in train.carried if body in train.across))))
            text = N_("bevel satellites: turns of {links} are told against their carrier, of the others about its axis")
            page.note(text, links=names)
        if any(mesh.sense and train.carrier(mesh) == FRAME for mesh in train.meshes):
            page.note("signs of bevel, worm and crossed pairs tell of turns about axes as they are laid")

    def _module(self, mesh: Mesh) -> Fraction | None:
        return mesh.module or (None if self.module is None else exact(self.module))

    def _span(self, mesh: Mesh) -> int:
        """Teeth of both wheels together, or their difference."""
        one, two = self.teeth[mesh.first], self.teeth[mesh.second]
        return abs(one - two) if mesh.kind == "internal" else one + two

    def _distances(self) -> None:
        """Centre distances, where a module is known, and the coaxiality of every satellite's meshes."""
        page = self.page
        plane = [mesh for mesh in self.train.meshes if mesh.kind in ("external", "internal")]
        if any(self._module(mesh) for mesh in plane):
            page.section("Centre distances")
        for mesh in plane:
            if (module := self._module(mesh)) is None:
                continue
            page.add("module", float(module), of=message("mesh {wheels}", wheels=mesh.name))
            one, two, symbol = f"{{z_{mesh.first}}}", f"{{z_{mesh.second}}}", f"a_{mesh.first}{mesh.second}"
            formula = f"{{m}} * abs({one} - {two}) / 2" if mesh.kind == "internal" else f"{{m}} * ({one} + {two}) / 2"
            distance = float(module * self._span(mesh) / 2)
            page.add("reference_centre_distance", distance, formula, "trains (3)", symbol=symbol)
        for body in dict.fromkeys(self.train.carried):
            own = [m for m in plane if body in (self.train.bodies[m.first], self.train.bodies[m.second])]
            central = [m for m in own if self._central(m, body) not in self.train.carried]
            if len(central) > 1:
                self._coaxial(central)

    def _central(self, mesh: Mesh, body: str) -> str:
        """The body that a satellite meshes."""
        one, two = self.train.bodies[mesh.first], self.train.bodies[mesh.second]
        return two if one == body else one

    def _coaxial(self, meshes: list[Mesh]) -> None:
        """Whether the meshes of one satellite have one centre distance, without shifts."""
        spans = [self._span(mesh) for mesh in meshes]
        distances = [(self._module(mesh) or 1) * span for mesh, span in zip(meshes, spans, strict=True)]
        if len(set(distances)) == 1:
            return
        wheels = " / ".join(mesh.name for mesh in meshes)
        teeth = " / ".join(map(str, spans))
        text = N_("{wheels}: {teeth} teeth, not coaxial with one module and no shifts")
        self.page.note(text, wheels=wheels, teeth=teeth)
        if len(meshes) == 2 and (pairs := coaxial_modules(spans[0], spans[1])):
            shown = ", ".join(f"{float(a):g} / {float(b):g}" for a, b in pairs[:_PAIRS_TOLD])
            self.page.note("coaxial in modules m / m' of {pairs}", pairs=shown)
        kinds = {mesh.kind: mesh for mesh in meshes}
        if len(meshes) != 2 or len(kinds) != 2:
            return
        outer, inner = kinds["external"], kinds["internal"]
        shared = {outer.first, outer.second} & {inner.first, inner.second}
        if len(shared) != 1:
            return
        rim = shared.pop()
        sun, ring = (m.second if m.first == rim else m.first for m in (outer, inner))
        z1, z2, z3 = (self.teeth[name] for name in (sun, rim, ring))
        text = N_(
            "by the plan of velocities of wheels {sun} and {rim} the ratio would be {plan:g}, by the teeth {ratio:g}"
        )
        self.page.note(text, sun=sun, rim=rim, plan=2 * (z1 + z2) / z1, ratio=1 + z3 / z1)
        fitting = {ring: z1 + 2 * z2}
        if (z3 - z1) % 2 == 0:
            fitting[rim] = (z3 - z1) // 2
        for wheel, fits in fitting.items():
            ratio = self._with({wheel: fits})
            self.page.note("z_{ring} = {fits} is coaxial, with {ratio:g}", ring=wheel, fits=fits, ratio=ratio)

    def _with(self, teeth: Mapping[str, int]) -> float:
        """The whole ratio with other teeth; 0 where there is none, but several drivers."""
        if len(self.inputs) != 1:
            return 0.0
        return float(self._ratio(replace(self.train, teeth={**self.train.teeth, **teeth})))

    def _ratio(self, train: Train) -> Fraction:
        """w_driver / w_driven by the exact solution of all equations."""
        moved = turns(train.mechanism(), [train.bodies[self.inputs[0]]])
        return moved.ratio(train.bodies[self.inputs[0]], train.bodies[self.driven])

    def _stages(self, found: tuple[Stage, ...]) -> None:
        """The recipe of 2.2.4: the stages, the ratio of each, their product."""
        page = self.page
        page.section("3. Ratios")
        page.add("number_of_stages", len(found))
        for number, stage in enumerate(found, 1):
            ends = f"{stage.start}-{stage.end}"
            if stage.carrier:
                page.section("Stage {number}: planetary, {ends}", number=number, ends=ends)
                self._planetary(stage)
            else:
                page.section("Stage {number}: fixed axes, {ends}", number=number, ends=ends)
                self._fixed(stage)
            page.name(f"s_{number}", page.sections[-1].steps[-1].symbol)

    def _mesh(self, leg: Leg, source: str) -> str:
        """(2.2) of a pair; its symbol."""
        symbol = f"u_{leg.start}{leg.end}"
        self.page.add("mesh_ratio", float(leg.ratio), _teeth(leg, leg.ratio), source, symbol=symbol)
        return symbol

    def _fixed(self, stage: Stage) -> None:
        """(2.2) of each pair, (2.3) of their product, (2.4) where every shaft between has one wheel."""
        page, legs, ratio = self.page, stage.legs, float(stage.ratio)
        whole, plane = f"u_{stage.start}{stage.end}", ("external", "internal")
        symbols = [self._mesh(leg, "practicum (2.2)" if leg.mesh.kind in plane else "trains (1)") for leg in legs]
        if len(legs) == 1:
            return
        product = " * ".join(f"{{{symbol}}}" for symbol in symbols)
        page.add("stage_ratio", ratio, product, "practicum (2.3)", symbol=whole)
        if all(one.end == two.start for one, two in pairwise(legs)):
            page.add("row_ratio", ratio, _teeth(stage, stage.ratio), "practicum (2.4)", symbol=whole)

    def _carried(self, legs: tuple[Leg, ...], carrier: str) -> str:
        """The ratio with the carrier stopped, as the product of its meshes; its symbol."""
        symbol = f"u_{legs[0].start}{legs[-1].end}^{carrier}"
        factors = " * ".join(f"({_teeth(leg, leg.ratio)})" for leg in legs)
        ratio = math.prod(leg.ratio for leg in legs)
        self.page.add("carried_ratio", float(ratio), factors, "practicum (2.3)", symbol=symbol)
        return symbol

    def _planetary(self, stage: Stage) -> None:
        """The stopped carrier, table 2.1, and Willis's (2.5)."""
        carrier, start = stage.carrier, stage.legs[0].start
        willis = f"1 - {{{self._carried(stage.legs, carrier)}}}"
        self._inversion(stage)
        inverse = stage.start == carrier
        ends = f"{carrier}{start}" if inverse else f"{start}{carrier}"
        alike = all(leg.mesh.kind == "external" for leg in stage.legs)
        source = f"practicum (2.5), trains ({4 if alike else 3})"
        formula = f"1 / ({willis})" if inverse else willis
        self.page.add("planetary_ratio", float(stage.ratio), formula, source, symbol=f"u_{ends}^{stage.held}")
        if alike and len(stage.legs) == 2 and self.page.sections[-1].steps[-1].printed is None:
            self.page.mark_misprint(_PRIME)

    def _inversion(self, stage: Stage) -> None:
        """Table 2.1: turns of every link for one of the stage's first, before and after the carrier is stopped."""
        train, bodies = self.train, self.train.bodies
        links = dict.fromkeys([bodies[stage.legs[0].start], bodies[stage.carrier]])
        links |= dict.fromkeys(bodies[name] for leg in stage.legs for name in (leg.start, leg.end))
        links = {body: None for body in links if body not in train.across}
        unit = turns(train.mechanism(), [bodies[stage.start]])
        before = {body: sum(unit.of(body).values(), Fraction()) for body in links}
        stop = before[bodies[stage.carrier]]
        rows = [(self._name(body), float(n), float(n - stop)) for body, n in before.items()]
        heads = ((N_("link"), ""), ("n", ""), (f"n - n_{stage.carrier}", ""))
        title = message("Inversion (table 2.1), turns for one of {link}", link=self._name(bodies[stage.start]))
        self.page.table(f"inversion_{stage.carrier}", title, heads, rows)
        if _DERIVATION not in self.page.notes:
            self.page.note(_DERIVATION)

    def _equations(self) -> None:
        """Willis's equation of every carrier, and what they give together."""
        page, train = self.page, self.train
        page.section("3. Ratios")
        for carrier in dict.fromkeys(train.carried.values()):
            name = self._name(carrier)
            for way in central_ways(train, carrier):
                self._carried(way, name)
                one, two = way[0].start, way[-1].end
                text = N_("Willis: w_{one} - w_{carrier} = u_{symbol}^{carrier} (w_{two} - w_{carrier})")
                page.note(text, one=one, two=two, carrier=name, symbol=f"{one}{two}")
        for mesh in train.meshes:
            if train.carrier(mesh) == FRAME:
                self._mesh(Leg(mesh, mesh.first, mesh.second, train.ratio(mesh)), "practicum (2.2)")
        moved = {
            name: {self._name(d): self.moved.of(body).get(d, Fraction()) for d in self.drives}
            for name, body in train.bodies.items()
        }
        heads = ((N_("link"), ""), *((self._name(d), "") for d in self.drives))
        title = N_("Turns of every link for one turn of each driving link, all equations solved")
        page.table("turns", title, heads, ((name, *map(float, own.values())) for name, own in moved.items()))
        page.data["exact_turns"] = {name: {d: str(n) for d, n in own.items()} for name, own in moved.items()}

    def _whole(self, found: tuple[Stage, ...] | None) -> None:
        """The product of the stages, which is the solution of all equations, and the directions."""
        page, ratio = self.page, self._ratio(self.train)
        page.section("Whole mechanism")
        symbol = f"u_{self.inputs[0]}{self.driven}"
        formula = " * ".join(f"{{s_{k}}}" for k in range(1, len(found) + 1)) if found else ""
        page.add("total_ratio", float(ratio), formula, "practicum (2.3)" if formula else "", symbol=symbol)
        page.add("exact_ratio", str(ratio), symbol=symbol)
        if any(m.kind in ACROSS and not m.sense and self.train.carrier(m) == FRAME for m in self.train.meshes):
            same = N_(
                "the ratio of a bevel, worm or crossed pair has no sign, so that of the whole tells no directions"
            )
        elif ratio > 0:
            same = N_("driver and driven link turn the same way")
        else:
            same = N_("driver and driven link turn in opposite ways")
        page.note(same)
        if self.open:
            self._lost_figure(ratio)

    def _lost_figure(self, ratio: Fraction) -> None:
        """Both signs where only a figure would show one mesh."""
        train = self.train
        mesh = next(m for m in train.meshes if m.name == self.open)
        other = replace(mesh, kind="external" if mesh.kind == "internal" else "internal")
        changed = tuple(other if m == mesh else m for m in train.meshes)
        text = N_("the figure is lost, and with it the kind of the mesh {mesh}: {one} gives {u:g}, {two} gives {v:g}")
        kinds = {"external": N_("an external one"), "internal": N_("an internal one")}
        one, two = Message(kinds[mesh.kind]), Message(kinds[other.kind])
        u, v = float(ratio), float(self._ratio(replace(train, meshes=changed)))
        self.page.note(text, mesh=mesh.name, one=one, two=two, u=u, v=v)

    def _speed(self, body: str) -> Fraction:
        speeds = {self.train.bodies[name]: w for name, w in self.speeds.items()}
        return sum((share * speeds[d] for d, share in self.moved.of(body).items()), Fraction())

    def _speed_key(self, name: str) -> str:
        """The key that gives the speed of a link."""
        return "speeds_rpm" if name in self.keys.speeds_rpm else "speeds"

    def _tell_speed(
        self, link: str, speed: Fraction, names: Iterable[str], formula: str = "", source: str = ""
    ) -> None:
        """In rad/s and in rpm, that one first which is given to one of its names."""
        given = [self.keys.speeds_rpm[name] for name in names if name in self.speeds and name in self.keys.speeds_rpm]
        if given:
            self.page.add("rotational_speed", given[0], symbol=f"N_{link}", given=True)
            formula, source = f"pi * {{N_{link}}} / 30", ""
        self.page.add("angular_velocity", float(speed), formula, source, symbol=f"ω_{link}")
        if not given:
            self.page.add("rotational_speed", float(speed / _RPM), f"30 * {{ω_{link}}} / pi", symbol=f"N_{link}")

    def _speeds(self, found: tuple[Stage, ...]) -> None:
        """Angular velocities, stage by stage, of satellites by their own inversion; of differentials as solved."""
        page, train = self.page, self.train
        page.section("Angular velocities")
        known: set[str] = set()

        def tell(name: str, formula: str = "", source: str = "") -> None:
            body = train.bodies[name]
            if body not in known:
                known.add(body)
                self._tell_speed(self._name(body), self._speed(body), self._names(body), formula, source)

        for name in self.inputs:
            tell(name)
        for number, stage in enumerate(found, 1):
            tell(stage.end, f"{{ω_{self._name(train.bodies[stage.start])}}} / {{s_{number}}}", "practicum (2.2)")
        for stage in satellites(train):
            body, carrier = train.bodies[stage.start], train.bodies[stage.carrier]
            if body in known or carrier not in known:
                continue
            formula, symbol = (
                f"1 - {{{self._carried(stage.legs, stage.carrier)}}}",
                f"u_{stage.start}{stage.carrier}^{stage.held}",
            )
            page.add("planetary_ratio", float(stage.ratio), formula, "practicum (2.5)", symbol=symbol)
            tell(stage.start, f"{{ω_{self._name(carrier)}}} * {{{symbol}}}", "practicum (2.2)")
        for body in dict.fromkeys(train.bodies.values()):
            if body not in known and not train.still(body):
                tell(body)

    def _statics(self) -> None:
        """Torques, mesh forces, power and efficiency, and whether it can be driven back."""
        page, train = self.page, self.train
        page.section("Torques and power")
        efficiency = exact(self.keys.mesh_efficiency)
        page.add("mesh_efficiency", self.keys.mesh_efficiency)
        mechanism = train.mechanism()
        speeds = {train.bodies[n]: w for n, w in self.speeds.items()} or dict.fromkeys(self.drives, Fraction(1))
        self.speeds = self.speeds or {self.inputs[0]: Fraction(1)}
        driven = train.bodies[self.driven]
        loads = {train.bodies[name]: exact(t) for name, t in self.keys.torques.items()}
        if not loads:
            way = self._speed(driven)
            loads = {driven: Fraction(-1 if way > 0 else 1)}
            page.note("no load is given: 1 N m against {link} is taken", link=self.driven)
        for name, torque in self.keys.torques.items():
            if train.bodies[name] not in self.drives and torque * self._speed(train.bodies[name]) > 0:
                page.note("the load on {link} acts along its turning: it puts power in", link=name)
        found = statics(mechanism, speeds, loads, efficiency)
        if not found:
            page.note("self-locking: under this load no mesh can drive the next, whatever the drive does")
        for number, state in enumerate(found, 1):
            if len(found) > 1:
                page.section("Torques and power, state {number} of {states}", number=number, states=len(found))
            self._state(state, f"{number}")
        if len(found) > 1:
            page.note("more than one state agrees with its losses: it may run in any of them")
        if len(self.inputs) == 1 and len(loads) == 1 and driven in loads:
            self._driven_back(driven, efficiency)

    def _state(self, state: Statics, number: str) -> None:
        page, train = self.page, self.train
        for body, torque in state.torques.items():
            page.add("torque", float(torque), symbol=f"T_{self._name(body)}")
        efficiency = None if state.efficiency is None else float(state.efficiency)
        page.told(power_in=float(state.power_in), efficiency=efficiency, circulation=float(state.circulation))
        if state.circulation > 1:
            page.note("power goes round: a mesh carries more than is put in")
        modules = {(mesh.first, mesh.second): self._module(mesh) for mesh in train.meshes}
        forces = all(modules.values())
        rows = list[tuple[str | float, ...]]()
        for flow in state.flows:
            module = modules[flow.mesh.first, flow.mesh.second] or Fraction(1)
            pull = 2000 * abs(flow.torques[0]) / (module * flow.mesh.teeth[0])
            numbers = [*flow.torques, *([pull] if forces else []), flow.power, flow.loss]
            rows.append((f"{flow.mesh.first}-{flow.mesh.second}", *map(float, numbers)))
        heads = [(N_("mesh"), ""), ("T_1", "N*m"), ("T_2", "N*m"), ("P^H", "W"), ("ΔP", "W")]
        if forces:
            heads.insert(3, ("F_t", "N"))
        title = N_("Meshes: torques of both wheels, power as their carrier sees it, from first to second, its loss")
        page.table(f"flows_{number}", title, heads, rows)
        if state.idle:
            told = ", ".join(f"{r.first}-{r.second}" for r in state.idle)
            page.note("statics alone does not say what these carry; the others carry all: {meshes}", meshes=told)

    def _driven_back(self, driven: str, efficiency: Fraction) -> None:
        """The driven link drives, 1 N m against the driver."""
        mechanism, start = self.train.mechanism(), self.train.bodies[self.inputs[0]]
        back = turns(mechanism, [driven])
        way = sum(back.of(start).values(), Fraction())
        states = statics(mechanism, {driven: Fraction(1)}, {start: Fraction(-1 if way > 0 else 1)}, efficiency)
        if not states:
            self.page.note("driven back, from {link}, it is self-locking", link=self.driven)
            return
        told = [message("{eta:.4g}", eta=float(s.efficiency or 0)) for s in states]
        text = N_("driven back, from {link}, its efficiency is {efficiency}")
        self.page.note(text, link=self.driven, efficiency=listed(told))

    def _experiment(self) -> None:
        """Practicum 3.2, 4: what to count, and the place for it."""
        counted = self.keys.counted_turns
        if len(self.inputs) != 1:
            if counted is not None:
                raise ParameterError("counted_turns", counted, "of_one_driver", REMOVED)
            return
        page, ratio = self.page, self._ratio(self.train)
        page.section("4. Check by experiment")
        page.add("turns_of_driven", float(1 / ratio), "1 / {u_whole}", "practicum 3.2", symbol=f"n_{self.driven}")
        if counted is None:
            page.add("turns_counted", _BLANK, symbol=f"n_{self.driven}")
        else:
            page.add("turns_counted", counted, symbol=f"n'_{self.driven}", given=True)
            off = abs(counted * ratio - 1) * 100
            page.add("counted_difference_percent", float(off), "abs({n_counted} / {n} - 1) * 100", "practicum 3.2")
        page.data["exact"] = {"ratio": str(ratio), "driver": self.inputs[0], "driven": self.driven}
        page.signed = message("done by {blank} date {blank} signature of the teacher {blank}", blank=_BLANK)
