"""``higherpair calc train``: lesson 2 step by step: mobility, stages, inversion, ratio, speeds, torques, power."""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise
from typing import Annotated, Any

from msgspec import Meta, Struct

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.planetary.sets import coaxial_modules
from geometry.kinematics.mechanism import FRAME, Mobility, Rolling, Turns, mobility, turns
from geometry.kinematics.statics import Statics, statics
from parts.base.refusal import SceneError, meant
from parts.base.texts import N_, Message, Text, listed, message
from parts.keys.base import mm
from parts.mates.pages.train_cases import CASES
from parts.mates.pages.train_model import ACROSS, Leg, Mesh, Stage, Train, central_ways, parsed, satellites, stages
from parts.pages.inputs import PLACE, checked, refusal
from parts.pages.misprints import printed_for_train
from parts.pages.page import Printed, Sheet, Table

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
_BLANK = "________"


class TrainKeys(Struct, forbid_unknown_fields=True):
    """Keys of the topic."""

    case: (
        Annotated[str, Meta(description="a train of the sources to start from, as practicum_1, 2.10.2, trains_7")]
        | None
    ) = None
    teeth: (
        Annotated[
            list[Annotated[int, Meta(ge=1)]] | dict[str, Annotated[int, Meta(ge=1)]],
            Meta(
                description="numbers of teeth: of wheels 1, 2, … in a list, or by name, as teeth.2'=20; a worm's starts"
            ),
        ]
        | None
    ) = None
    meshes: Annotated[
        str,
        Meta(
            description="wheels in mesh, as 1-2, 2'-3 internal 3.5: kind and module where they differ, + or - of bevels"
        ),
    ] = ""
    shafts: Annotated[str, Meta(description="wheels of one shaft, as 2-3, H-5; 2 and 2' need no such word")] = ""
    carriers: Annotated[dict[str, Name], Meta(description="satellites of each carrier, as carriers.H=2")] = {}
    held: Annotated[Name, Meta(description="held wheels or carriers, with commas between them")] = ""
    driver: Annotated[Name, Meta(description="driving link; default: the first wheel")] = ""
    driven: Annotated[Name, Meta(description="driven link; default: the last one that is not held")] = ""
    speeds: Annotated[
        dict[str, float], Meta(description="angular velocities of the driving links in rad/s, as speeds.1=120")
    ] = {}
    torques: Annotated[
        dict[str, float], Meta(description="torques of the loads in N m, counter-clockwise above 0, as torques.H=-4")
    ] = {}
    mesh_efficiency: Annotated[float, Meta(gt=0, le=1, description="efficiency of every mesh")] = 1.0
    module: Annotated[float, mm("module, for distances and forces", least=0.01, most=1000)] | None = None


def sheet(table: dict[str, Any]) -> Sheet:
    """The analysis of one train; ``names`` of the table: which instance of a scene each name stands for."""
    names = table.pop("names", {})
    keys: TrainKeys = checked(table, TrainKeys, TOPIC)
    try:
        return _Page(keys, names).made()
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error


def _exact(value: float) -> Fraction:
    return Fraction(str(value))


def _key(name: str) -> str:
    """A name within a key of a formula."""
    return re.sub(r"\W", "p", name)


class _Page:
    """The sheet of one train; formulas know wheels as z_1, stages as u_s1, speeds as omega_1."""

    def __init__(self, keys: TrainKeys, names: Mapping[str, str]) -> None:
        case = None if keys.case is None else CASES.get(keys.case)
        if keys.case is not None and case is None:
            raise SceneError(
                PLACE, f"{TOPIC}.case", keys.case, "not_one_of", meant(keys.case, CASES), known=list(CASES)
            )
        given = keys.teeth if keys.teeth is not None else {}
        teeth = given if isinstance(given, dict) else {str(k): z for k, z in enumerate(given, 1)}
        self.teeth = {**(case.teeth if case else {}), **teeth}
        words = keys.meshes or (case.meshes if case else "")
        if not words:
            raise ParameterError(
                "meshes", None, "missing_key", None, what=message("wheels in mesh, as 1-2, 2'-3 internal")
            )
        self.speeds = {name: _exact(w) for name, w in ({**(case.speeds if case else {}), **keys.speeds}).items()}
        # which instance of a scene a name stands for
        self.instances = names
        self.keys, self.words, self.open = keys, words, case.open if case else ""
        self.module = keys.module if keys.module is not None or case is None else case.module
        self.shafts = keys.shafts or (case.shafts if case else "")
        self.carriers = {**(case.carriers if case else {}), **{c: str(names) for c, names in keys.carriers.items()}}
        self.held = str(keys.held) or (case.held if case else "")
        self.sheet = Sheet(TOPIC, N_("Kinematic analysis of a gear train"))
        self.driven = str(keys.driven) or (case.driven if case else "")
        # each is told once
        self.printed = dict(printed_for_train(tuple(self.teeth.values())))

    def made(self) -> Sheet:
        """Scheme, mobility, ratios, speeds, statics and the check by experiment: the practicum's form of report."""
        self._missing_teeth()
        self.train = train = parsed(self.teeth, self.words, self.shafts, self.carriers, self.held)
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
            raise error.renamed("speeds" if self.speeds else "driver") from error
        self._scheme()
        self._mobility(freedom)
        self._distances()
        if self.moved.free:
            names = list(dict.fromkeys(self._name(train.bodies[link]) for link in self.moved.free))
            raise ParameterError("speeds", names[0], "left_free", None, free=names)
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
        return self.sheet

    def _add(self, name: str, value: float | int | str, formula: str = "", source: str = "", *,
             symbol: str, key: str = "", of: Text = "") -> None:  # fmt: skip
        """A step, with what its source misprints beside it."""
        self.sheet.add(name, value, formula, source, symbol=symbol, key=key or _key(symbol), of=of)
        if (printed := self.printed.pop(symbol, None)) is not None:
            self.sheet.mark_misprint(printed)

    def _missing_teeth(self) -> None:
        """Of a lone pair with both speeds: its ratio, and the teeth that one of its wheels must have; guide, (1)."""
        names = re.match(r"\s*(\S+?)\s*-\s*([^\s,]+)(\s+\w+)?\s*$", self.words)
        missing = [name for name in (names[1], names[2]) if name not in self.teeth] if names else []
        if not names or not missing or any(not self.speeds.get(name) for name in (names[1], names[2])):
            return
        one, two = names[1], names[2]
        self.sheet.section(N_("What the speeds ask for"))
        for name in (one, two):
            speed = float(self.speeds[name])
            self._add("angular_velocity", speed, symbol=f"ω_{name}", key=f"given_{_key(name)}")
        u = self.speeds[one] / self.speeds[two]
        external = (names[3] or "external").strip() == "external"
        sign = "-" if external and u > 0 else ""
        self.speeds = {one: self.speeds[one]}
        formula = f"{sign}{{given_{_key(one)}}} / {{given_{_key(two)}}}"
        self._add("mesh_ratio", float(-u if sign else u), formula, "trains (1)", symbol=f"u_{one}{two}", key="u_wanted")
        if len(missing) == 2:
            # any teeth of that ratio
            self.teeth[one], self.teeth[two] = abs(u).denominator, abs(u).numerator
            self.sheet.notes.append(N_("no number of teeth is known: the least with that ratio are taken"))
            return
        known = self.teeth[one if missing == [two] else two]
        wanted = known * abs(u) if missing == [two] else known / abs(u)
        if wanted.denominator != 1:
            raise ParameterError(
                "speeds", float(self.speeds[one]), "no_whole_teeth", None, wheel=missing[0], teeth=float(wanted)
            )
        self.teeth = {one: self.teeth.get(one, int(wanted)), two: self.teeth.get(two, int(wanted))}
        operation = "*" if missing == [two] else "/"
        other = one if missing == [two] else two
        self._add("number_of_teeth", known, symbol=f"z_{other}", key="z_known")
        formula = f"{{z_known}} {operation} abs({{u_wanted}})"
        self._add("number_of_teeth", int(wanted), formula, "trains (1)", symbol=f"z_{missing[0]}", key="z_wanted")

    def _links(self) -> None:
        """Who drives and who is driven, by their names."""
        bodies = self.train.bodies
        wheels = [name for name in self.teeth if name in bodies]
        driver = str(self.keys.driver)
        self.inputs = list(self.speeds) or [driver or wheels[0]]
        if driver and self.speeds and driver not in self.speeds:
            raise ParameterError("driver", driver, "driver_without_speed", None, known=list(self.speeds))
        self.driven = self.driven or self._last(bodies.get(self.inputs[0], ""))
        places = {"driver": [driver] if driver else [], "driven": [self.driven], "speeds": self.inputs}
        for key, names in {**places, "torques": list(self.keys.torques)}.items():
            for name in names:
                if name not in bodies:
                    raise ParameterError(key, name, "no_such_link", meant(name, bodies), known=list(bodies))
        for name in self.inputs:
            if self.train.still(bodies[name]):
                raise ParameterError("speeds" if self.speeds else "driver", name, "driver_is_held")
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
        page, train = self.sheet, self.train
        page.section(N_("1. Scheme of the mechanism"))
        for name, z in train.teeth.items():
            self._add("number_of_teeth", z, symbol=f"z_{name}")
        labels, rows = [], []
        for mesh in train.meshes:
            carrier = train.carrier(mesh)
            on = "-" if carrier == FRAME else self._name(carrier)
            labels.append((mesh.first, mesh.second, _KINDS[mesh.kind], on))
            rows.append((float(train.teeth[mesh.first]), float(train.teeth[mesh.second])))
        heads = (("1", ""), ("2", ""), (N_("kind"), ""), ("H", ""), ("z_1", ""), ("z_2", ""))
        title = N_("Meshes: first and second wheel, kind, carrier, teeth")
        page.tables.append(Table("meshes", title, heads, tuple(rows), labels=tuple(labels)))
        if self.instances:
            told = ", ".join(f"{name} {instance}" for name, instance in self.instances.items())
            page.notes.append(message("names in the scene: {names}", names=told))
        shafts = [names for body in dict.fromkeys(train.bodies.values()) if len(names := self._names(body)) > 1]
        if shafts:
            told = ", ".join("-".join(names) for names in shafts)
            page.notes.append(message("on one shaft: {shafts}", shafts=told))
        if train.held:
            page.notes.append(message("held: {links}", links=", ".join(train.held)))

    def _names(self, body: str) -> list[str]:
        return [name for name, own in self.train.bodies.items() if own == body]

    def _name(self, body: str) -> str:
        """A body's name as formulas have it: a carrier's own, else the first wheel's."""
        names = self._names(body)
        return next((n for n in names if n not in self.teeth), names[0])

    def _mobility(self, found: Mobility) -> None:
        """(2.1) with n, p5, p4 as the sources count them, and the exact rank."""
        page = self.sheet
        page.section(N_("2. Degree of freedom"))
        self._add("moving_links", found.links, symbol="n")
        self._add("lower_pairs", found.lower_pairs, symbol="p_5")
        self._add("higher_pairs", found.higher_pairs, symbol="p_4")
        formula = "3 * {n} - 2 * {p_5} - {p_4}"
        self._add("degree_of_freedom", found.chebyshev, formula, "practicum (2.1)", symbol="W")
        if found.redundant or found.degrees != found.chebyshev:
            self._add("exact_degree_of_freedom", found.degrees, symbol="W_r")
            told = [f"{s.first}-{s.second}" for r in found.redundant if isinstance(s := r.source, Rolling)]
            text = N_("redundant, since they follow from the others: {meshes}")
            page.notes.append(message(text, meshes=", ".join(told)))
        train = self.train
        moving = [carrier for carrier in train.carried.values() if not train.still(carrier)]
        kind: Text = N_("all axes stand still: an ordinary train")
        if moving:
            kind = N_("satellites turn about moving axes and W = 1: a planetary mechanism")
            if not train.held:
                kind = N_("satellites turn about moving axes, no wheel is held, and W = 1: a closed differential")
            if found.degrees > 1:
                kind = message("satellites turn about moving axes and W = {w}: a differential", w=found.degrees)
        page.notes.append(kind)
        if train.across:
            names = ", ".join(dict.fromkeys(map(self._name, (body for body in train.carried if body in train.across))))
            text = N_("bevel satellites: turns of {links} are told against their carrier, of the others about its axis")
            page.notes.append(message(text, links=names))
        if any(mesh.sense and train.carrier(mesh) == FRAME for mesh in train.meshes):
            page.notes.append(N_("signs of bevel, worm and crossed pairs tell of turns about axes as they are laid"))

    def _module(self, mesh: Mesh) -> Fraction | None:
        return mesh.module or (None if self.module is None else _exact(self.module))

    def _span(self, mesh: Mesh) -> int:
        """Teeth of both wheels together, or their difference."""
        one, two = self.teeth[mesh.first], self.teeth[mesh.second]
        return abs(one - two) if mesh.kind == "internal" else one + two

    def _distances(self) -> None:
        """Centre distances, where a module is known, and the coaxiality of every satellite's meshes."""
        page = self.sheet
        plane = [mesh for mesh in self.train.meshes if mesh.kind in ("external", "internal")]
        if any(self._module(mesh) for mesh in plane):
            page.section(N_("Centre distances"))
        for mesh in plane:
            if (module := self._module(mesh)) is None:
                continue
            key = f"m_{_key(mesh.name)}"
            self._add("module", float(module), symbol="m", key=key, of=message("mesh {wheels}", wheels=mesh.name))
            one, two = f"{{z_{_key(mesh.first)}}}", f"{{z_{_key(mesh.second)}}}"
            if mesh.kind == "internal":
                formula = f"{{{key}}} * abs({one} - {two}) / 2"
            else:
                formula = f"{{{key}}} * ({one} + {two}) / 2"
            distance = float(module * self._span(mesh) / 2)
            self._add(
                "reference_centre_distance", distance, formula, "trains (3)", symbol=f"a_{mesh.first}{mesh.second}"
            )
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
        self.sheet.notes.append(message(text, wheels=wheels, teeth=teeth))
        if len(meshes) == 2 and (pairs := coaxial_modules(spans[0], spans[1])):
            shown = ", ".join(f"{float(a):g} / {float(b):g}" for a, b in pairs[:_PAIRS_TOLD])
            self.sheet.notes.append(message("coaxial in modules m / m' of {pairs}", pairs=shown))
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
        self.sheet.notes.append(message(text, sun=sun, rim=rim, plan=2 * (z1 + z2) / z1, ratio=1 + z3 / z1))
        fits = z1 + 2 * z2
        text = N_("z_{ring} = {fits} is coaxial, with {ratio:g}")
        self.sheet.notes.append(message(text, ring=ring, fits=fits, ratio=self._with({ring: fits}) or 0.0))
        if (z3 - z1) % 2 == 0:
            text = N_("z_{ring} = {fits} is coaxial, with {ratio:g}")
            fits = (z3 - z1) // 2
            self.sheet.notes.append(message(text, ring=rim, fits=fits, ratio=self._with({rim: fits}) or 0.0))

    def _with(self, teeth: Mapping[str, int]) -> float | None:
        """The whole ratio with other teeth."""
        if len(self.inputs) != 1:
            return None
        return float(self._ratio(replace(self.train, teeth={**self.train.teeth, **teeth})))

    def _ratio(self, train: Train) -> Fraction:
        """w_driver / w_driven by the exact solution of all equations."""
        moved = turns(train.mechanism(), [train.bodies[self.inputs[0]]])
        return moved.ratio(train.bodies[self.inputs[0]], train.bodies[self.driven])

    def _stages(self, found: tuple[Stage, ...]) -> None:
        """The recipe of 2.2.4: the stages, the ratio of each, their product."""
        page = self.sheet
        page.section(N_("3. Ratios"))
        self._add("number_of_stages", len(found), symbol="k")
        for number, stage in enumerate(found, 1):
            ends = f"{stage.start}-{stage.end}"
            if stage.carrier:
                page.section(message("Stage {number}: planetary, {ends}", number=number, ends=ends))
                self._planetary(stage, f"s_{number}")
            else:
                page.section(message("Stage {number}: fixed axes, {ends}", number=number, ends=ends))
                self._fixed(stage, f"s_{number}")

    def _leg_formula(self, leg: Leg) -> str:
        sign = "-" if leg.ratio < 0 else ""
        return f"{sign}{{z_{_key(leg.end)}}} / {{z_{_key(leg.start)}}}"

    def _fixed(self, stage: Stage, key: str) -> None:
        """(2.2) of each pair, (2.3) of their product, (2.4) where every shaft between has one wheel."""
        legs = stage.legs
        whole = f"u_{stage.start}{stage.end}"
        for k, leg in enumerate(legs):
            own = key if len(legs) == 1 else f"{key}_{k}"
            source = "practicum (2.2)" if leg.mesh.kind in ("external", "internal") else "trains (1)"
            self._add(
                "mesh_ratio",
                float(leg.ratio),
                self._leg_formula(leg),
                source,
                symbol=f"u_{leg.start}{leg.end}",
                key=own,
            )
        if len(legs) == 1:
            return
        product = " * ".join(f"{{{key}_{k}}}" for k in range(len(legs)))
        self._add("stage_ratio", float(stage.ratio), product, "practicum (2.3)", symbol=whole, key=key)
        if all(one.end == two.start for one, two in pairwise(legs)):
            sign = "-" if stage.ratio < 0 else ""
            formula = f"{sign}{{z_{_key(stage.end)}}} / {{z_{_key(stage.start)}}}"
            self._add("row_ratio", float(stage.ratio), formula, "practicum (2.4)", symbol=whole, key=f"{key}_row")

    def _carried(self, legs: tuple[Leg, ...], carrier: str, key: str) -> Fraction:
        """The ratio with the carrier stopped, as the product of its meshes."""
        ratio, factors = Fraction(1), []
        for leg in legs:
            ratio *= leg.ratio
            factors.append(f"({self._leg_formula(leg)})")
        symbol = f"u_{legs[0].start}{legs[-1].end}^{carrier}"
        self._add("carried_ratio", float(ratio), " * ".join(factors), "practicum (2.3)", symbol=symbol, key=key)
        return ratio

    def _planetary(self, stage: Stage, key: str) -> None:
        """The stopped carrier, table 2.1, and Willis's (2.5)."""
        carrier, start = stage.carrier, stage.legs[0].start
        self._carried(stage.legs, carrier, f"{key}_p")
        self._inversion(stage)
        inverse = stage.start == carrier
        ends = f"{carrier}{start}" if inverse else f"{start}{carrier}"
        willis = f"1 - {{{key}_p}}"
        alike = all(leg.mesh.kind == "external" for leg in stage.legs)
        source = f"practicum (2.5), trains ({4 if alike else 3})"
        formula = f"1 / ({willis})" if inverse else willis
        self._add("planetary_ratio", float(stage.ratio), formula, source, symbol=f"u_{ends}^{stage.held}", key=key)
        if alike and len(stage.legs) == 2 and self.sheet.sections[-1].steps[-1].printed is None:
            self.sheet.mark_misprint(_PRIME)

    def _inversion(self, stage: Stage) -> None:
        """Table 2.1: turns of every link for one of the stage's first, before and after the carrier is stopped."""
        train, bodies = self.train, self.train.bodies
        links = dict.fromkeys([bodies[stage.legs[0].start], bodies[stage.carrier]])
        links |= dict.fromkeys(bodies[name] for leg in stage.legs for name in (leg.start, leg.end))
        links = {body: None for body in links if body not in train.across}
        unit = turns(train.mechanism(), [bodies[stage.start]])
        before = {body: sum(unit.of(body).values(), Fraction()) for body in links}
        stop = before[bodies[stage.carrier]]
        rows = tuple((float(n), float(n - stop)) for n in before.values())
        labels = tuple((self._name(body),) for body in before)
        heads = ((N_("link"), ""), ("n", ""), (f"n - n_{stage.carrier}", ""))
        title = message("Inversion (table 2.1), turns for one of {link}", link=stage.start)
        self.sheet.tables.append(Table(f"inversion_{stage.carrier}", title, heads, rows, labels=labels))
        if _DERIVATION not in self.sheet.notes:
            self.sheet.notes.append(_DERIVATION)

    def _equations(self) -> None:
        """Willis's equation of every carrier, and what they give together."""
        page, train = self.sheet, self.train
        page.section(N_("3. Ratios"))
        for carrier in dict.fromkeys(train.carried.values()):
            name = self._name(carrier)
            for way in central_ways(train, carrier):
                symbol = f"{way[0].start}{way[-1].end}"
                self._carried(way, name, f"p_{_key(name)}_{_key(symbol)}")
                text = N_("Willis: w_{one} - w_{carrier} = u_{symbol}^{carrier} (w_{two} - w_{carrier})")
                told = message(text, one=way[0].start, two=way[-1].end, carrier=name, symbol=symbol)
                page.notes.append(told)
        for mesh in train.meshes:
            if train.carrier(mesh) == FRAME:
                leg = Leg(mesh, mesh.first, mesh.second, train.ratio(mesh))
                symbol = f"u_{leg.start}{leg.end}"
                self._add("mesh_ratio", float(leg.ratio), self._leg_formula(leg), "practicum (2.2)", symbol=symbol)
        bodies = dict.fromkeys(train.bodies.values())
        heads = ((N_("link"), ""), *((self._name(d), "") for d in self.drives))
        rows = tuple(tuple(float(self.moved.of(b).get(d, Fraction())) for d in self.drives) for b in bodies)
        labels = tuple((self._name(body),) for body in bodies)
        title = N_("Turns of every link for one turn of each driving link, all equations solved")
        page.tables.append(Table("turns", title, heads, rows, labels=labels))
        page.data["exact_turns"] = {
            self._name(b): {self._name(d): str(self.moved.of(b).get(d, 0)) for d in self.drives} for b in bodies
        }

    def _whole(self, found: tuple[Stage, ...] | None) -> None:
        """The product of the stages, which is the solution of all equations, and the directions."""
        page, ratio = self.sheet, self._ratio(self.train)
        page.section(N_("Whole mechanism"))
        symbol = f"u_{self.inputs[0]}{self.driven}"
        formula = " * ".join(f"{{s_{k}}}" for k in range(1, len(found) + 1)) if found else ""
        self._add(
            "total_ratio", float(ratio), formula, "practicum (2.3)" if formula else "", symbol=symbol, key="u_whole"
        )
        self._add("exact_ratio", str(ratio), symbol=symbol, key="u_exact")
        if any(m.kind in ACROSS and not m.sense and self.train.carrier(m) == FRAME for m in self.train.meshes):
            same = N_(
                "the ratio of a bevel, worm or crossed pair has no sign, so that of the whole tells no directions"
            )
        elif ratio > 0:
            same = N_("driver and driven link turn the same way")
        else:
            same = N_("driver and driven link turn in opposite ways")
        page.notes.append(same)
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
        self.sheet.notes.append(message(text, mesh=mesh.name, one=one, two=two, u=u, v=v))

    def _speed(self, body: str) -> Fraction:
        speeds = {self.train.bodies[name]: w for name, w in self.speeds.items()}
        return sum((share * speeds[d] for d, share in self.moved.of(body).items()), Fraction())

    def _speeds(self, found: tuple[Stage, ...]) -> None:
        """Angular velocities, stage by stage, of satellites by their own inversion; of differentials as solved."""
        page, train = self.sheet, self.train
        page.section(N_("Angular velocities"))
        known: set[str] = set()

        def tell(name: str, formula: str = "", source: str = "") -> None:
            body = train.bodies[name]
            if body not in known:
                known.add(body)
                shown = self._name(body)
                self._add(
                    "angular_velocity",
                    float(self._speed(body)),
                    formula,
                    source,
                    symbol=f"ω_{shown}",
                    key=f"w_{_key(body)}",
                )

        for name in self.inputs:
            tell(name)
        for number, stage in enumerate(found, 1):
            tell(stage.end, f"{{w_{_key(train.bodies[stage.start])}}} / {{s_{number}}}", "practicum (2.2)")
        for number, stage in enumerate(satellites(train), 1):
            body, carrier = train.bodies[stage.start], train.bodies[stage.carrier]
            if body in known or carrier not in known:
                continue
            key = f"q_{number}"
            self._carried(stage.legs, stage.carrier, f"{key}_p")
            symbol = f"u_{stage.start}{stage.carrier}^{stage.held}"
            self._add(
                "planetary_ratio", float(stage.ratio), f"1 - {{{key}_p}}", "practicum (2.5)", symbol=symbol, key=key
            )
            tell(stage.start, f"{{w_{_key(carrier)}}} * {{{key}}}", "practicum (2.2)")
        for body in dict.fromkeys(train.bodies.values()):
            if body not in known and not train.still(body):
                tell(body)

    def _statics(self) -> None:
        """Torques, mesh forces, power and efficiency, and whether it can be driven back."""
        page, train = self.sheet, self.train
        page.section(N_("Torques and power"))
        efficiency = _exact(self.keys.mesh_efficiency)
        self._add("mesh_efficiency", self.keys.mesh_efficiency, symbol="η_z")
        mechanism = train.mechanism()
        speeds = {train.bodies[n]: w for n, w in self.speeds.items()} or dict.fromkeys(self.drives, Fraction(1))
        self.speeds = self.speeds or {self.inputs[0]: Fraction(1)}
        driven = train.bodies[self.driven]
        loads = {train.bodies[name]: _exact(t) for name, t in self.keys.torques.items()}
        if not loads:
            way = self._speed(driven)
            loads = {driven: Fraction(-1 if way > 0 else 1)}
            page.notes.append(message("no load is given: 1 N m against {link} is taken", link=self.driven))
        for name, torque in self.keys.torques.items():
            if train.bodies[name] not in self.drives and torque * self._speed(train.bodies[name]) > 0:
                page.notes.append(message("the load on {link} acts along its turning: it puts power in", link=name))
        found = statics(mechanism, speeds, loads, efficiency)
        if not found:
            page.notes.append(N_("self-locking: under this load no mesh can drive the next, whatever the drive does"))
        for number, state in enumerate(found, 1):
            if len(found) > 1:
                page.section(message("Torques and power, state {number} of {states}", number=number, states=len(found)))
            self._state(state, f"{number}")
        if len(found) > 1:
            page.notes.append(N_("more than one state agrees with its losses: it may run in any of them"))
        if len(self.inputs) == 1 and len(loads) == 1 and driven in loads:
            self._driven_back(driven, efficiency)

    def _state(self, state: Statics, number: str) -> None:
        page, train = self.sheet, self.train
        for body, torque in state.torques.items():
            self._add("torque", float(torque), symbol=f"T_{self._name(body)}", key=f"T_{_key(body)}_{number}")
        self._add("power_in", float(state.power_in), symbol="P")
        if state.efficiency is not None:
            self._add("efficiency", float(state.efficiency), symbol="η")
        self._add("circulation", float(state.circulation), symbol="c_P")
        if state.circulation > 1:
            page.notes.append(N_("power goes round: a mesh carries more than is put in"))
        modules = {(mesh.first, mesh.second): self._module(mesh) for mesh in train.meshes}
        forces = all(modules.values())
        rows = []
        for flow in state.flows:
            module = modules[flow.mesh.first, flow.mesh.second] or Fraction(1)
            pull = 2000 * abs(flow.torques[0]) / (module * flow.mesh.teeth[0])
            rows.append(
                [*map(float, flow.torques), *([float(pull)] if forces else []), float(flow.power), float(flow.loss)]
            )
        heads = (
            (N_("mesh"), ""),
            ("T_1", "N*m"),
            ("T_2", "N*m"),
            *([("F_t", "N")] if forces else []),
            ("P^H", "W"),
            ("ΔP", "W"),
        )
        title = N_("Meshes: torques of both wheels, power as their carrier sees it, from first to second, its loss")
        labels = tuple((f"{flow.mesh.first}-{flow.mesh.second}",) for flow in state.flows)
        page.tables.append(Table(f"flows_{number}", title, heads, tuple(map(tuple, rows)), labels=labels))
        if state.idle:
            told = ", ".join(f"{r.first}-{r.second}" for r in state.idle)
            page.notes.append(
                message("statics alone does not say what these carry; the others carry all: {meshes}", meshes=told)
            )

    def _driven_back(self, driven: str, efficiency: Fraction) -> None:
        """The driven link drives, 1 N m against the driver."""
        mechanism, start = self.train.mechanism(), self.train.bodies[self.inputs[0]]
        back = turns(mechanism, [driven])
        way = sum(back.of(start).values(), Fraction())
        states = statics(mechanism, {driven: Fraction(1)}, {start: Fraction(-1 if way > 0 else 1)}, efficiency)
        if not states:
            text = N_("driven back, from {link}, it is self-locking")
            self.sheet.notes.append(message(text, link=self.driven))
            return
        told = [message("{eta:.4g}", eta=float(s.efficiency or 0)) for s in states]
        text = N_("driven back, from {link}, its efficiency is {efficiency}")
        self.sheet.notes.append(message(text, link=self.driven, efficiency=listed(told)))

    def _experiment(self) -> None:
        """Practicum 3.2, 4: what to count, and the place for it."""
        if len(self.inputs) != 1:
            return
        page, ratio = self.sheet, self._ratio(self.train)
        page.section(N_("4. Check by experiment"))
        self._add("turns_of_driven", float(1 / ratio), "1 / {u_whole}", "practicum 3.2", symbol=f"n_{self.driven}")
        self._add("turns_counted", _BLANK, symbol=f"n_{self.driven}", key="n_counted")
        page.data["exact"] = {"ratio": str(ratio), "driver": self.inputs[0], "driven": self.driven}
        page.signed = message("done by {blank} date {blank} signature of the teacher {blank}", blank=_BLANK)
