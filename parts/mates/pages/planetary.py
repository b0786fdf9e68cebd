"""``higherpair calc planetary``: sets of teeth for a wanted ratio, or one given set: conditions, shifts, clocking."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Annotated, Literal

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.gears.planetary.assembly import Satellites, given_set, least_angle
from geometry.gears.planetary.fitting import Fit, Fitting, RimMesh
from geometry.gears.planetary.sets import (
    LINKS,
    SCHEMES,
    Link,
    PlanetarySet,
    Search,
    coaxial_modules,
    found_sets,
    nearest_ratio,
    ratio_of,
    sine_of,
)
from geometry.gears.shifts.external import Requirements
from geometry.gears.shifts.internal_shifts import InternalState
from parts.base.texts import N_, Message, listed, message
from parts.gears.spur_gear.part import RackTable, basic_rack_of
from parts.keys.base import check_not_in_vain, degrees, in_modules, mm
from parts.keys.cutter import RackName
from parts.keys.helix import HelixAngle
from parts.pages.inputs import calculation, exact
from parts.pages.page import Sheet
from parts.texts.planetary import fault_told, meshes_of

TOPIC = "planetary"
SchemeName = Literal["james", "one_external_one_internal", "two_internal", "david"]
Place = Literal["first", "second", "carrier"]
_TITLES = {
    "james": N_("Planetary set of James: external and internal mesh, satellites with one rim"),
    "one_external_one_internal": N_("Planetary set: external and internal mesh, satellites with two rims"),
    "two_internal": N_("Planetary set: two internal meshes, satellites with two rims"),
    "david": N_("Planetary set of David: two external meshes, satellites with two rims"),
}
# how formulas call the links
_LETTERS: dict[Link, str] = {"first": "1", "second": "3", "carrier": "H"}
_WHEELS = ("1", "2", "2'", "3")
_PAIRS_TOLD = 4
_MOST_TEETH_OFF = 3


_TEETH = Meta(description="a set to judge: z1, z2, z3, or z1, z2, z2', z3")
_SPACING = Meta(description="satellites equally spaced, or as equally as alike ones can be")
_TEETH_OFF = Meta(ge=0, le=_MOST_TEETH_OFF, description="teeth that coaxiality may be off, made up by shifts")


# what sets are sought by, not what one is judged by
_OF_SEARCH = ("ratio_tolerance_percent", "least_teeth", "most_teeth", "largest_diameter", "teeth_off", "rows")


class PlanetaryKeys(Struct, forbid_unknown_fields=True):
    """Keys of the topic."""

    scheme: Annotated[SchemeName, Meta(description="scheme of the practicum's figure 2.1")] = "james"
    ratio: Annotated[float, Meta(ge=-1e9, le=1e9, description="wanted ratio, driver to driven")] | None = None
    ratio_tolerance_percent: Annotated[float, Meta(ge=0, le=50, description="how far the ratio may be off")] = 0.5
    teeth: Annotated[list[Annotated[int, Meta(ge=3, le=100_000)]], _TEETH] | None = None
    satellites: Annotated[int, Meta(ge=1, le=10_000, description="number of satellites")] = 3
    driver: Annotated[Place, Meta(description="the driving link: wheel 1, wheel 3 or the carrier")] = "first"
    held: Annotated[Place, Meta(description="the held link: wheel 1, wheel 3 or the carrier")] = "second"
    spacing: Annotated[Literal["equal", "unequal"], _SPACING] = "equal"
    identical: Annotated[bool, Meta(description="both rims of all satellites are clocked alike")] = True
    module: Annotated[float, mm("module of the mesh 1-2", least=0.01, most=1000)] = 1.0
    second_module: Annotated[float, mm("module of the mesh 2'-3", least=0.01, most=1000)] | None = None
    least_teeth: Annotated[int, Meta(ge=3, le=1000, description="least number of teeth of any wheel")] = 11
    most_teeth: Annotated[int, Meta(ge=3, le=1000, description="greatest number of teeth of any wheel")] = 150
    largest_diameter: Annotated[float, mm("what the whole set may take across", above=0)] | None = None
    teeth_off: Annotated[int, _TEETH_OFF] = 1
    least_gap: Annotated[float, mm("gap to keep between satellites' tips", least=0, most=10_000)] = 0.0
    working_centre_distance: Annotated[float, mm("wanted centre distance", above=0, most=100_000)] | None = None
    pressure_angle_deg: Annotated[float, degrees("pressure angle", least=5, most=45)] = 20.0
    basic_rack: RackName | RackTable = "ISO 53 A"
    helix_angle_deg: HelixAngle = 0.0
    least_contact_ratio: Annotated[
        float, Meta(ge=0.5, le=3, description="contact ratio to keep, of helical teeth that of the transverse section")
    ] = 1.1
    least_tip_thickness: Annotated[float, in_modules("tip thickness to keep", least=0, most=1)] = 0.25
    rows: Annotated[int, Meta(ge=1, le=1000, description="how many of the sets found are shown")] = 20


@calculation(TOPIC, PlanetaryKeys)
def begun(keys: PlanetaryKeys) -> Callable[[], Sheet]:
    """What finishes the sheet of the sets found, or of the one that is given: refused before shifts are sought."""
    return _Page(keys).begun()


class _Page:
    """The sheet of one wish."""

    def __init__(self, keys: PlanetaryKeys) -> None:
        self.keys, self.scheme = keys, SCHEMES[keys.scheme]
        if keys.driver == keys.held:
            other: Link = next(link for link in LINKS if link != keys.held)
            raise ParameterError("driver", keys.driver, "driver_is_held", Nearest(other))
        self.driver: Link = keys.driver
        self.driven: Link = next(link for link in LINKS if link not in (keys.driver, keys.held))
        if keys.second_module is not None and not self.scheme.double:
            raise ParameterError("second_module", keys.second_module, "one_rim_one_module", Nearest(None))
        self.rim = "2'" if self.scheme.double else "2"
        # those of the scheme, by their place among all
        self.wheels = {k: wheel for k, wheel in enumerate(_WHEELS) if self.scheme.double or wheel != "2'"}
        self.meshes = meshes_of(self.scheme)
        self.modules = exact(keys.module), exact(keys.second_module or keys.module)
        rack = basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg))
        self.helix = math.radians(abs(keys.helix_angle_deg))
        self.cosine = Fraction(math.cos(self.helix))
        wish = Requirements(keys.least_tip_thickness, keys.least_contact_ratio)
        apart = Fraction(1, keys.satellites) if keys.satellites > 1 else None
        self.fitting = Fitting(rack, wish, apart, keys.least_gap, keys.working_centre_distance, self.helix)
        self.page = Sheet(TOPIC, _TITLES[keys.scheme])

    def begun(self) -> Callable[[], Sheet]:
        """What finishes the whole sheet."""
        keys = self.keys
        if (keys.teeth is None) == (keys.ratio is None):
            code = "give_it_or" if keys.ratio is None else "either_of"
            raise ParameterError("ratio", keys.ratio, code, other="teeth")
        equal = tuple(Fraction(k, keys.satellites) for k in range(keys.satellites))
        if keys.teeth is not None:
            check_not_in_vain(keys, _OF_SEARCH, "ratio")
            one = self._given(keys.teeth)
            places = self._assembled(one) if self._coaxial_enough(one) else equal
            return partial(self._of_one, one, places)
        check_not_in_vain(keys, ("spacing",), "teeth")
        return partial(self._of_several, self._sought(), equal)

    def _of_one(self, one: PlanetarySet, places: tuple[Fraction, ...]) -> Sheet:
        self._set(one, self._fitted(one), places, N_("The set"))
        return self.page

    def _of_several(self, sets: list[PlanetarySet], equal: tuple[Fraction, ...]) -> Sheet:
        page, keys = self.page, self.keys
        page.section("Wanted")
        page.add("wanted_ratio", keys.ratio or 0.0, symbol=self._symbol)
        page.told(ratio_tolerance_percent=keys.ratio_tolerance_percent, number_of_satellites=keys.satellites)
        page.told(least_teeth=keys.least_teeth, most_teeth=keys.most_teeth)
        page.add("sets_found", len(sets))
        fits = [(one, self._fitted(one)) for one in sets[: keys.rows]]
        self._table(fits)
        best, fit = next(((one, fit) for one, fit in fits if fit is not None), fits[0])
        self._set(best, fit, equal, N_("The smallest set that works"))
        if any(fit is None for _, fit in fits):
            page.note(
                "a set without shifts in the table: no shifts keep least_tip_thickness and "
                "least_contact_ratio without undercut"
            )
        return page

    @property
    def _symbol(self) -> str:
        """u_1H^3: from the driver to the driven link, the held one above."""
        return f"u_{_LETTERS[self.driver]}{_LETTERS[self.driven]}^{_LETTERS[self.keys.held]}"

    def _sought(self) -> list[PlanetarySet]:
        keys = self.keys
        assert keys.ratio is not None
        if keys.ratio == 0:
            raise ParameterError("ratio", keys.ratio, "ratio_not_zero")
        if keys.least_teeth > keys.most_teeth:
            raise ParameterError(
                "least_teeth", keys.least_teeth, "above_most_teeth", Nearest(keys.most_teeth, "at_most")
            )
        ratio = exact(keys.ratio)
        wish = Search(
            self.scheme,
            (ratio, ratio),
            self.driver,
            self.driven,
            keys.satellites,
            (keys.least_teeth, keys.most_teeth),
            keys.teeth_off,
            self.modules,
            exact(keys.least_gap),
            None if keys.largest_diameter is None else exact(keys.largest_diameter),
            keys.identical,
            self.cosine,
        )

        def within(percent: Fraction) -> Search:
            room = abs(ratio) * percent / 100
            return replace(wish, ratios=(ratio - room, ratio + room))

        def cure() -> Nearest | None:
            """The ratio nearest to the wanted one that has sets, in six digits where the tolerance takes these."""
            tried = (nearest_ratio(within(Fraction(percent))) for percent in (1, 3, 10, 40, 99))
            found = next((one for one in tried if one is not None), None)
            if found is None:
                return None
            short = float(f"{float(found):.6g}")
            off = abs(exact(short) - found) * 100
            return Nearest(short if off <= exact(keys.ratio_tolerance_percent) * abs(found) / 2 else float(found))

        asked = within(exact(keys.ratio_tolerance_percent))
        if sets := found_sets(asked):
            return sets
        if other := self._elsewhere(asked):
            raise ParameterError("ratio", keys.ratio, "planetary_set_elsewhere", cure, other=other)
        raise ParameterError("ratio", keys.ratio, "no_planetary_set", cure)

    def _elsewhere(self, asked: Search) -> str | None:
        """Other keys by which sets keep the wish: another scheme, other links, or both with the carrier driving."""
        keys = self.keys
        links = [(driver, held) for driver in LINKS for held in LINKS if driver != held]
        tried = [(scheme, keys.driver, keys.held) for scheme in SCHEMES]
        tried += [(keys.scheme, *pair) for pair in links]
        tried += [(scheme, "carrier", "second") for scheme in SCHEMES]
        for scheme, driver, held in tried:
            if keys.second_module is not None and not SCHEMES[scheme].double:
                continue
            driven = next(link for link in LINKS if link not in (driver, held))
            if found_sets(replace(asked, scheme=SCHEMES[scheme], driver=driver, driven=driven)):
                words = {"scheme": scheme, "driver": driver, "held": held}
                return ", ".join(f'{key} = "{word}"' for key, word in words.items() if word != getattr(keys, key))
        return None

    def _given(self, teeth: list[int]) -> PlanetarySet:
        """The set that was typed."""
        one = given_set(self.scheme, teeth, self.modules, self.cosine)
        if not ratio_of(one.carried_ratio, self.driver, self.driven):
            raise ParameterError("teeth", teeth, "transmits_nothing")
        return one

    def _assembled(self, one: PlanetarySet) -> tuple[Fraction, ...]:
        """Where the satellites of a given set stand; refused where they do not fit."""
        gap = exact(self.keys.least_gap)

        def works(other: PlanetarySet, apart: Fraction) -> bool:
            return other.fits(apart, gap) or replace(self.fitting, apart=apart).fit(other) is not None

        places = Satellites(self.keys.satellites, self.keys.spacing, self.keys.identical, gap).places(one, works)
        self.fitting = replace(self.fitting, apart=least_angle(places))
        return places

    def _coaxial_enough(self, one: PlanetarySet) -> bool:
        """Whether shifts may make up for what the distances differ by."""
        d1, d2 = one.distances
        off = self.keys.teeth_off if self.keys.teeth is None else _MOST_TEETH_OFF
        return 2 * abs(d1 - d2) <= off * max(self.modules)

    def _fitted(self, one: PlanetarySet) -> Fit | None:
        return self.fitting.fit(one) if self._coaxial_enough(one) else None

    def _table(self, fits: list[tuple[PlanetarySet, Fit | None]]) -> None:
        """The sets in their order, with the shifts that make them work."""
        rows = []
        for one, fit in fits:
            ratio = ratio_of(one.carried_ratio, self.driver, self.driven)
            assert ratio is not None
            assert self.keys.ratio is not None
            off = float(100 * (ratio / exact(self.keys.ratio) - 1))
            nan = math.nan
            shifts = (nan,) * 4 if fit is None else fit.shifts
            sizes = (float(one.diameter), nan, nan) if fit is None else (fit.diameter, fit.distance, fit.gap)
            most = float(self._most_satellites(one) if fit is None else fit.most_satellites)
            teeth, x = (tuple(float(own[k]) for k in self.wheels) for own in (one.teeth, shifts))
            rows.append((*teeth, float(ratio), off, *sizes, most, *x))
        z, x_of = ([(f"{letter}_{wheel}", "") for wheel in self.wheels.values()] for letter in "zx")
        sizes_of = [("D", "mm"), ("a_w", "mm"), ("g_s", "mm"), ("n_max", "")]
        heads = [*z, (self._symbol, ""), ("δu", "%"), *sizes_of, *x_of]
        title = N_("Sets, the smallest first: ratio, size, distance, gap of neighbours, most satellites, shifts")
        self.page.table("sets", title, heads, rows)

    def _set(self, one: PlanetarySet, fit: Fit | None, places: tuple[Fraction, ...], title: str) -> None:
        """All about one set."""
        page = self.page
        page.section("{title}: {teeth}", title=Message(title), teeth=one.name)
        for k, wheel in self.wheels.items():
            of = message("wheel {wheel}", wheel=wheel)
            page.add("number_of_teeth", one.teeth[k], symbol=f"z_{wheel}", of=of)
        self._ratio(one)
        self._conditions(one, places)
        if fit is None:
            self._not_fitted(one)
        else:
            self._fit(one, fit)
        self._satellites(one, places)
        page.data["set"] = {
            "teeth": list(one.teeth),
            "ratio": str(ratio_of(one.carried_ratio, self.driver, self.driven)),
            "places": one.places,
            "satellites_at": [str(p) for p in places],
            "works": fit is not None,
        }

    def _ratio(self, one: PlanetarySet) -> None:
        page = self.page
        first, second = ("" if internal else "-" for internal in self.scheme.internal)
        formula = f"({first}{{z_2}} / {{z_1}}) * ({second}{{z_3}} / {{z_{self.rim}}})"
        page.add("carried_ratio", float(one.carried_ratio), formula, "practicum (2.3)")
        ratio = ratio_of(one.carried_ratio, self.driver, self.driven)
        assert ratio is not None
        pair = {self.driver, self.driven}
        formula = "{p}" if "carrier" not in pair else "1 - {p}" if "first" in pair else "1 - 1 / {p}"
        if (self.driver == "carrier") or (self.driver, self.driven) == ("second", "first"):
            formula = f"1 / {formula}" if formula == "{p}" else f"1 / ({formula})"
        page.add("planetary_ratio", float(ratio), formula, "practicum (2.5)", symbol=self._symbol)
        page.add("exact_ratio", str(ratio), symbol=self._symbol)

    def _conditions(self, one: PlanetarySet, places: tuple[Fraction, ...]) -> None:
        """Coaxiality, assembly and neighbours, by the teeth."""
        page, keys = self.page, self.keys
        page.section("Conditions, by the teeth")
        self._modules()
        module = "{m_2}" if self.scheme.double else "{m}"
        one_sign, two_sign = ("-" if internal else "+" for internal in self.scheme.internal)
        d1, d2 = map(float, one.distances)
        one_of, two_of = (message("mesh {wheels}", wheels=wheels) for wheels in self.meshes)
        formula = f"{{m}} * ({{z_1}} {one_sign} {{z_2}}) / 2"
        page.add("reference_centre_distance", d1, formula, "trains (3)", symbol="a_12", of=one_of)
        formula = f"{module} * ({{z_3}} {two_sign} {{z_{self.rim}}}) / 2"
        page.add("reference_centre_distance", d2, formula, "trains (3)", symbol=f"a_{self.rim}3", of=two_of)
        if self.scheme.double:
            page.add("greatest_common_divisor", math.gcd(*one.teeth[1:3]), symbol="g")
            sign = "-" if self.scheme.alike else "+"
            formula = f"abs({{z_1}} * {{z_2'}} {sign} {{z_2}} * {{z_3}}) / {{g}}"
        else:
            formula = "{z_1} + {z_3}"
        page.add("satellite_places", one.places, formula)
        page.add("number_of_satellites", keys.satellites)
        if (apart := least_angle(places)) is None:
            return
        page.told(least_satellite_angle_deg=360 * float(apart), rim_tip_diameter=float(one.rim_reach))
        chord = float(2 * one.distances[0] * sine_of(apart))
        page.add("neighbour_distance", chord, "2 * {a_12} * sin({theta_s} / 2)")
        page.add("most_satellites", self._most_satellites(one))

    def _modules(self) -> None:
        """Of each mesh, ``{m}`` and ``{m_2}`` in formulas; of helical teeth the normal and the transverse."""
        page, meshes = self.page, self.meshes if self.scheme.double else ("",)
        if self.helix:
            page.add("helix_angle_deg", math.degrees(self.helix))
        for wheels, module, mark, key in zip(meshes, self.modules, ("", "'"), ("", "_2"), strict=False):
            of = message("mesh {wheels}", wheels=wheels) if wheels else ""
            if not self.helix:
                page.add("module", float(module), of=of, symbol=f"m{mark}", key=f"m{key}")
                continue
            page.add("module", float(module), of=of, symbol=f"m_n{mark}", key=f"m_n{key}")
            value, formula = float(module / self.cosine), f"{{m_n{key}}} / cos({{beta}})"
            page.add("transverse_module", value, formula, "ISO 21771", of=of, symbol=f"m_t{mark}", key=f"m{key}")

    def _most_satellites(self, one: PlanetarySet) -> int:
        """How many fit, by the teeth."""
        return one.most_satellites(exact(self.keys.least_gap))

    def _fit(self, one: PlanetarySet, fit: Fit) -> None:
        """Distance, shifts and what they give."""
        page, x = self.page, fit.shifts
        page.section("Shifts for one centre distance")
        page.add("working_centre_distance", fit.distance)
        for k, wheel in self.wheels.items():
            shift, of = 0.0 if abs(x[k]) < 1e-12 else x[k], message("wheel {wheel}", wheel=wheel)
            symbol = f"x_n{wheel}" if self.helix else f"x_{wheel}"
            page.add("profile_shift_coefficient", shift, symbol=symbol, of=of)
        for wheels, mesh, state, made in zip(self.meshes, fit.meshes, fit.states(), self._made(fit), strict=True):
            of = message("mesh {wheels}", wheels=wheels)
            page.add("working_pressure_angle_deg", math.degrees(state.working_pressure_angle), of=of)
            page.add("contact_ratio", state.contact_ratio, "", "practicum (3.20)", of=of)
            if made < state.contact_ratio:
                page.add("made_contact_ratio", made, of=of)
            if isinstance(state, InternalState):
                page.add("ring_tip_addendum", self._ring_addendum(mesh, state), of=of)
        if math.isfinite(fit.gap):
            page.add("satellite_gap", fit.gap)
            if fit.most_satellites != self._most_satellites(one):
                page.add("made_most_satellites", fit.most_satellites)
        page.add("set_diameter", fit.diameter)
        for wheels, mesh, broken in self._plain(one):
            self._interference(wheels, mesh, broken)

    def _made(self, fit: Fit) -> tuple[float, ...]:
        """Contact ratios of both meshes as a scene makes them, inf where it makes none of this rack."""
        return self.fitting.made_ratios(fit, self.scheme.double) or (math.inf, math.inf)

    def _plain(self, one: PlanetarySet) -> list[tuple[str, RimMesh, list[str]]]:
        """Each mesh without shifts of the rims, with the names of what it breaks."""
        plain = self.fitting.plain(one)
        meshes = zip(self.meshes, plain.meshes, plain.broken(), strict=True)
        return [(wheels, mesh, [m.name for m in broken]) for wheels, mesh, broken in meshes]

    def _ring_addendum(self, mesh: RimMesh, state: InternalState) -> float:
        """How far a ring's teeth stand inside its reference circle, normal modules."""
        return mesh.central / (2 * math.cos(self.helix)) - state.ring.tip_radius

    def _interference(self, wheels: str, mesh: RimMesh, broken: list[str]) -> None:
        """What an unshifted ring and its satellite break, the verdict by exact contact, and the shift that cures it."""
        state = mesh.state(0.0, 0.0)
        name = next((n for n in broken if n in ("involute_interference", "trochoid_interference")), None)
        if name is None or not isinstance(state, InternalState):
            return
        page, addendum, allowed = self.page, self._ring_addendum(mesh, state), mesh.allowed_ring_addendum
        text = N_(
            "mesh {wheels} without shifts: {what}: the ring's addendum is {addendum:.4g}, at most {allowed:.4g} is "
            "clear of whole involutes"
        )
        page.note(text, wheels=wheels, what=fault_told(name), addendum=addendum, allowed=allowed)
        # a search for sets is not to wait for a search for contact
        if self.keys.teeth is not None and (verdict := _exact_verdict(mesh, self.keys)) is not None:
            text = N_("mesh {wheels} without shifts, teeth as cut, by exact contact: {verdict}")
            page.note(text, wheels=wheels, verdict=verdict)
        if (shift := mesh.clearing_shift()) is not None:
            text = N_("mesh {wheels}: x = {shift:.2f} of both wheels removes the interference")
            page.note(text, wheels=wheels, shift=shift)

    def _not_fitted(self, one: PlanetarySet) -> None:
        """Why no shifts were found, and what else may work."""
        page = self.page
        if not self._coaxial_enough(one):
            s1, s2 = one.spans
            if self.scheme.double:
                text = N_("not coaxial in these modules: {first} teeth against {second}; m'/m = {share} would be")
                page.note(text, first=s1, second=s2, share=str(Fraction(s1, s2)))
                if pairs := coaxial_modules(s1, s2):
                    shown = ", ".join(f"{float(a):g} / {float(b):g}" for a, b in pairs[:_PAIRS_TOLD])
                    page.note("coaxial in modules m / m' of {pairs}", pairs=shown)
            else:
                text = N_("not coaxial: z_1 + 2 z_2 = {first}, z_3 = {second}; z_2 = {fits:g} fits")
                fits = (one.teeth[3] - one.teeth[0]) / 2
                page.note(text, first=one.teeth[0] + 2 * one.teeth[1], second=one.teeth[3], fits=fits)
            return
        page.note("no shifts keep everything: less least_contact_ratio or least_tip_thickness, or other teeth may work")
        for wheels, mesh, broken in self._plain(one):
            if broken:
                told = listed([fault_told(name) for name in broken])
                page.note("mesh {wheels} without shifts of the rims: {names}", wheels=wheels, names=told)
            self._interference(wheels, mesh, broken)
        unseen = replace(self.fitting, wish=replace(self.fitting.wish, allow_undercut=True)).fit(one)
        if unseen is not None:
            shown = ", ".join(f"{unseen.shifts[k]:.4f}" for k in self.wheels)
            text = N_("with undercut below the active flank: a_w = {distance:.4f} mm, shifts {shifts}")
            page.note(text, distance=unseen.distance, shifts=shown)

    def _satellites(self, one: PlanetarySet, places: tuple[Fraction, ...]) -> None:
        """Where satellites stand that are not alike or not equally spaced."""
        n = len(places)
        clocking = one.clocking(n) if self.keys.spacing == "equal" and self.scheme.double else (Fraction(0),) * n
        equal = places == tuple(Fraction(k, n) for k in range(n))
        if equal and not any(clocking):
            if self.scheme.double and n > 1:
                self.page.note("all satellites are alike: both rims clocked in one and the same way")
            return
        heads, pairs = (("k", ""), ("θ", "deg"), ("γ", "deg")), zip(places, clocking, strict=True)
        rows = ((float(k), 360 * float(p), 360 * float(c)) for k, (p, c) in enumerate(pairs, 1))
        title = N_("Satellites: place on the carrier; rim 2' against rim 2, beyond that of the first satellite")
        self.page.table("satellites", title, heads, rows)
        if any(clocking):
            self.page.data["clocking"] = [str(c) for c in clocking]
            self.page.note("the satellites are not alike: each has its own clocking of both rims")


def _exact_verdict(mesh: RimMesh, keys: PlanetaryKeys) -> str | None:
    """The verdict of exact contact of an unshifted rim in its ring as a build makes both; None: it cannot be built."""
    from geometry.gears.mesh.gears import GearMesh
    from geometry.gears.pairs.internal import internal_pair
    from geometry.gears.teeth.spur import SpurGear
    from geometry.gears.teeth.transverse import transverse_gear
    from parts.gears.ring_gear.part import RingGearSpec, settled_section

    beta, rack = keys.helix_angle_deg, basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg))
    try:
        ring = RingGearSpec(
            module=1.0, number_of_teeth=mesh.central, pressure_angle_deg=keys.pressure_angle_deg, helix_angle_deg=beta
        )
        pinion = transverse_gear(SpurGear(1.0, mesh.rim, rack), math.radians(abs(beta)))
        return GearMesh(internal_pair(pinion, settled_section(ring))).contact().verdict.name
    except ParameterError:
        return None
