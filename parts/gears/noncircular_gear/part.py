"""The part kind ``noncircular_gear``: teeth on an oval, an ellipse about a focus, or the centrode of a given ratio."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from msgspec import Meta
from msgspec.structs import replace

from geometry.base import record
from geometry.base.errors import ConvergenceError, GeometryError, LateError, Nearest, ParameterError, limit, rounded
from geometry.base.nearest import Suspect, blamed, nearest
from geometry.solids.wheel import check_wheel, wheel_body, wheel_sections
from parts.base.kind import Others, Report
from parts.base.schema import replaced
from parts.gears.spur_gear.part import RackTable, basic_rack_of, rounding_finding
from parts.keys.base import check_idle, either, in_modules, in_vain, mm, start
from parts.keys.cutter import PressureAngle, RackName
from parts.keys.holes import hub_holes, spoked, with_remedy
from parts.keys.wheel import WheelKeys, WheelKind, shape_of

if TYPE_CHECKING:
    from geometry.gears.noncircular.gear import NoncircularGear
    from geometry.gears.noncircular.pairing import Centrode
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile
    from geometry.solids.body import Body

_Amplitude = Annotated[float, Meta(ge=-10, le=10)]
_SAMPLES = 1025
MOST_TEETH = 2000
# numbers of teeth that are tried for a mate
_OFFERS = 6
# of ellipses that the table of the pitch line still holds (the ratio of axes 20 is at 0.99875, 200 at 0.9999875)
_MOST_SLENDER = {"axis_ratio": 20.0, "eccentricity": 0.9999}
_ROUND = {"axis_ratio": 1.0, "eccentricity": 0.0}

_CENTRODE = Meta(
    description="driver's centrode: oval about its middle, ellipse about a focus, or by its ratio", examples=["oval"]
)
_CENTRE_DISTANCE = mm("of the pair, in place of the module", above=0, most=100_000, example=90.0)
_MATE_NUMBER_OF_TEETH = Meta(ge=3, le=MOST_TEETH, description="of the other gear; default: as many", examples=[30])
_AXIS_RATIO = Meta(ge=1, le=20, description="oval: long over short radius; ellipse: of its axes")
_ECCENTRICITY = Meta(ge=0, lt=1, description="e of r = p/(1 - e cos n phi), in place of axis_ratio", examples=[0.2])
_LOBES = Meta(ge=1, le=20, description="lobes n; default: oval 2, else 1; for oval and ratio", examples=[2])
_RATIO_COSINES = Meta(
    max_length=20, description="ratio: a_k of 1 + sum a_k cos k n phi + b_k sin k n phi", examples=[[0.3]]
)
_RATIO_SINES = Meta(max_length=20, description="ratio: b_k", examples=[[0.1]])
_NUMBER_OF_TEETH = Meta(ge=3, le=MOST_TEETH, description="number of teeth of this gear", examples=[30])
_ROLE = Meta(description="driver: tooth 1 on +x; mate: the gear that rolls on the driver")
_PROFILE_SHIFT_COEFFICIENT = in_modules("shift x of the rack's datum line; its mate has -x", least=-1, most=1)
_CIRCUMFERENTIAL_THINNING = mm("thinning of each tooth for backlash, arc of the centrode", least=0, most=1000)


class NoncircularGearSpec(WheelKeys, kw_only=True, tag_field="kind", tag="noncircular_gear"):
    """Keys of ``noncircular_gear``."""

    centrode: Annotated[Literal["oval", "focal_ellipse", "ratio"], _CENTRODE]
    number_of_teeth: Annotated[int, _NUMBER_OF_TEETH]
    module: Annotated[float, mm("module m; or give centre_distance", least=0.01, most=1000), start(2.0)] | None = None
    centre_distance: Annotated[float, _CENTRE_DISTANCE] | None = None
    role: Annotated[Literal["driver", "mate"], _ROLE] = "driver"
    mate_number_of_teeth: Annotated[int, _MATE_NUMBER_OF_TEETH] | None = None
    axis_ratio: Annotated[float, _AXIS_RATIO, start(1.5)] | None = None
    eccentricity: Annotated[float, _ECCENTRICITY] | None = None
    lobes: Annotated[int, _LOBES] | None = None
    ratio_cosines: Annotated[list[_Amplitude], _RATIO_COSINES] | None = None
    ratio_sines: Annotated[list[_Amplitude], _RATIO_SINES] | None = None
    profile_shift_coefficient: Annotated[float, _PROFILE_SHIFT_COEFFICIENT] = 0.0
    pressure_angle_deg: PressureAngle = 20.0
    basic_rack: RackName | RackTable = "ISO 53 A"
    circumferential_thinning: Annotated[float, _CIRCUMFERENTIAL_THINNING] = 0.0

    @property
    def slender_key(self) -> str:
        """The key that tells how slender an ellipse or an oval is."""
        return "axis_ratio" if self.eccentricity is None else "eccentricity"

    @property
    def whole_lobes(self) -> int:
        """n of the driver."""
        return self.lobes or (2 if self.centrode == "oval" else 1)

    @property
    def pair_teeth(self) -> tuple[int, int]:
        """Teeth of driver and mate."""
        own, other = self.number_of_teeth, self.mate_number_of_teeth or self.number_of_teeth
        return (other, own) if self.role == "mate" else (own, other)


class NoncircularGearKind(WheelKind[NoncircularGearSpec, "NoncircularGear"]):
    """A noncircular gear, whose teeth a mate may have thinned."""

    name, keys = "noncircular_gear", NoncircularGearSpec
    drawing = "parts.gears.drawings"
    data_table = "parts.gears.data_tables"

    def idle(self, keys: NoncircularGearSpec, others: Others) -> Iterator[ParameterError]:
        """What is of another centrode."""
        return _idle(keys)

    def thing(self, keys: NoncircularGearSpec, others: Others) -> NoncircularGear:
        """The gear, checked to be cut whole, and to leave its holes a rim."""
        _check_slender(keys)
        try:
            gear = gear_of(keys)
            gear.outline  # noqa: B018
        except ConvergenceError as refusal:
            key = keys.slender_key
            most = limit(_MOST_SLENDER[key], math.inf)
            raise ParameterError(key, getattr(keys, key), "too_slender", most) from refusal
        except ParameterError as refusal:
            raise LateError(refusal.code, partial(_to_blame, keys, refusal)) from refusal
        root = gear.root_radius

        def fits(changed: NoncircularGearSpec) -> bool:
            return hub_holes(changed.bore, changed.holes, spoked(changed, root).spokes).fits(root)

        try:
            gear.holes.check(root)
            check_wheel(shape_of(keys), 2 * root, gear.holes)
        except ParameterError as refusal:
            if keys.bore_diameter > 0 and refusal.name == "bore.diameter":
                most = limit(2 * root * (1 - 1e-6), keys.bore_diameter)
                raise ParameterError("bore_diameter", keys.bore_diameter, "leaves_no_rim", most) from refusal
            raise with_remedy(refusal, keys, fits) from refusal
        return gear

    def section(self, keys: NoncircularGearSpec, thing: NoncircularGear, offset: float) -> OffsetRegion:
        """The exact section, moved."""
        from geometry.gears.noncircular.offset import noncircular_region

        return noncircular_region(thing, offset)

    def solid(self, keys: NoncircularGearSpec, thing: NoncircularGear, offset: float) -> Body:
        """The wheel with its web, hub and chamfers."""
        from geometry.gears.noncircular.offset import moved_outline, noncircular_region

        section = lru_cache(maxsize=8)(partial(noncircular_region, thing))

        def outline(offset: float, depth: float) -> Profile:
            return section(offset).region.outer if depth == 0 else moved_outline(thing, offset - depth)

        return wheel_body(shape_of(keys), wheel_sections(outline, thing.root_radius, thing.holes), offset)

    def report(self, keys: NoncircularGearSpec, thing: NoncircularGear) -> Report:
        """Radii of the centrode, pitch, what is poor."""
        from geometry.gears.noncircular.offset import findings_of

        circles = {"inner_root_diameter": 2 * thing.root_radius, "outer_tip_diameter": 2 * thing.tip_radius}
        least, greatest = thing.radii
        pair = {} if thing.pairing is None else {"centre_distance_of_pair": thing.pairing.centre_distance}
        quantities = {
            **pair,
            "module": thing.module,
            "pitch": thing.pitch,
            "centrode_perimeter": thing.line.length,
            "least_centrode_radius": least,
            "greatest_centrode_radius": greatest,
            "least_curvature_radius_of_centrode": 1 / thing.curvatures[1],
            "tip_tooth_thickness": thing.outline.tip_thickness,
        }
        return Report((*rounding_finding(keys), *findings_of(thing)), circles, quantities)


NONCIRCULAR_GEAR = NoncircularGearKind()


def gear_of(keys: NoncircularGearSpec) -> NoncircularGear:
    """The gear of a part as its keys say, not checked to exist.

    Raises
    ------
    ParameterError
        Its rack or its pair cannot exist, or two keys exclude each other.
    """
    from geometry.gears.noncircular.gear import NoncircularGear
    from geometry.gears.noncircular.pairing import paired

    _check_keys(keys)
    mate, teeth = keys.role == "mate", keys.pair_teeth
    pairing = paired(centrode_of(keys, teeth), teeth, keys.module, keys.centre_distance)
    gear = NoncircularGear(
        line=pairing.lines[1 if mate else 0],
        number_of_teeth=keys.number_of_teeth,
        rack=basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg)),
        first_tooth=0.5 if mate else 0.0,
        profile_shift_coefficient=keys.profile_shift_coefficient,
        circumferential_thinning=keys.circumferential_thinning,
        bore_diameter=keys.bore_diameter,
        hub=hub_holes(keys.bore, keys.holes, keys.spokes),
        pairing=pairing,
    )
    if keys.spokes is None or gear.hub.spokes is not None:
        return gear
    return record.replace(gear, hub=hub_holes(keys.bore, keys.holes, spoked(keys, gear.root_radius).spokes))


def _builds(keys: NoncircularGearSpec) -> bool:
    """Whether a gear of these keys can be cut."""
    try:
        gear_of(keys).outline  # noqa: B018
    except GeometryError:
        return False
    return True


def _idle(keys: NoncircularGearSpec) -> Iterator[ParameterError]:
    """What is of another centrode."""
    unused = ("axis_ratio", "eccentricity") if keys.centrode == "ratio" else ("ratio_cosines", "ratio_sines")
    given = [key for key in unused if getattr(keys, key) != []]
    yield from in_vain(keys, given, "not_of_this_centrode", centrode=keys.centrode)


def _check_keys(keys: NoncircularGearSpec) -> None:
    """Keys that exclude each other, or need each other."""
    if keys.bore is not None and keys.bore_diameter > 0:
        raise either("bore_diameter", keys.bore_diameter, "bore", 0.0)
    _check_one("module", keys.module, "centre_distance", keys.centre_distance)
    check_idle(_idle(keys))
    if keys.centrode == "focal_ellipse" and keys.lobes not in (None, 1):
        raise ParameterError("lobes", keys.lobes, "one_lobe_about_focus", Nearest(1))
    if keys.centrode != "ratio":
        _check_one("axis_ratio", keys.axis_ratio, "eccentricity", keys.eccentricity)


def _check_one(key: str, value: float | None, other: str, instead: float | None) -> None:
    """Refuse both of two keys, and neither of them."""
    if value is None and instead is None:
        raise ParameterError(key, None, "one_of_two_is_missing", other=other)
    if value is not None and instead is not None:
        raise ParameterError(key, value, "either_key", Nearest(None), one=key, other=other)


def centrode_of(keys: NoncircularGearSpec, teeth: tuple[int, int]) -> Centrode:
    """The driver's centrode, of no particular size.

    Raises
    ------
    ParameterError
        It is concave, which no rack rolls on, or its ratio is not positive.
    """
    from geometry.kinematics.centrodes import FourierRatio, LobedEllipse, RatioCentrode

    lobes = keys.whole_lobes
    if keys.centrode == "ratio":
        ratio = FourierRatio(teeth[0] / teeth[1], tuple(keys.ratio_cosines or ()), tuple(keys.ratio_sines or ()), lobes)
        if not float(ratio(np.linspace(0, 2 * math.pi, _SAMPLES), 0)[0].min()) > 0:
            raise ParameterError("centrode", keys.centrode, "ratio_not_positive")
        return RatioCentrode(ratio, 1.0)
    e = keys.eccentricity
    if e is None:
        q = float(keys.axis_ratio or 1.0)
        e = math.sqrt(1 - 1 / q**2) if keys.centrode == "focal_ellipse" else (q - 1) / (q + 1)
    most = 1 / (lobes**2 - 1) if lobes > 1 else 1.0
    if e > most * (1 + 1e-12):
        if keys.axis_ratio is not None:
            cure = limit((1 + most) / (1 - most), keys.axis_ratio, digits=6)
            raise ParameterError("axis_ratio", keys.axis_ratio, "centrode_concave", cure)
        raise ParameterError("eccentricity", e, "centrode_concave", limit(most, e, digits=6))
    return LobedEllipse(1.0, min(e, most), lobes)


def _to_blame(keys: NoncircularGearSpec, refusal: ParameterError) -> ParameterError:
    """A refused gear in the key to change: the mate's teeth, amplitudes, thinning, shift, teeth, or the centrode."""
    if refusal.code == "mate_does_not_close":
        # of the pair it is the mate's
        name = "number_of_teeth" if keys.role == "mate" else refusal.name
        return ParameterError(name, refusal.value, refusal.code, partial(_closing_teeth, keys))
    if refusal.name not in ("centrode", "undercut", "number_of_teeth", "profile_shift_coefficient"):
        return refusal

    def works(key: str, value: object) -> bool:
        return _builds(replaced(keys, key, value))

    if keys.centrode == "ratio" and refusal.name == "centrode":
        key = "ratio_cosines" if keys.ratio_cosines else "ratio_sines"
        return refusal.told_of(key, getattr(keys, key), partial(_smaller_amplitudes, keys, key))
    thinning, shift = keys.circumferential_thinning, keys.profile_shift_coefficient
    found = blamed(
        (
            Suspect("circumferential_thinning", thinning, 0.0, partial(works, "circumferential_thinning")),
            Suspect("profile_shift_coefficient", shift, 0.0, partial(works, "profile_shift_coefficient")),
        ),
        "circumferential_thinning",
    )
    if found is not None:
        return refusal.told_of(found.name, found.value, partial(nearest, found.works, found.value, found.harmless))
    z, key = keys.number_of_teeth, keys.slender_key
    slender = getattr(keys, key)
    # both gears of a pair would need more teeth
    more = None if keys.mate_number_of_teeth is not None else _more_teeth(keys)
    if more is None and keys.centrode != "ratio" and slender is not None:
        end = next((value for value in _rounder(key, slender) if works(key, value)), None)
        if end is not None:
            return refusal.told_of(key, slender, partial(nearest, partial(works, key), slender, end, digits=5))
    if more is None:
        return refusal.told_of("number_of_teeth", z, lambda: None)
    return refusal.told_of("number_of_teeth", z, partial(nearest, partial(works, "number_of_teeth"), z, more))


def _more_teeth(keys: NoncircularGearSpec) -> int | None:
    """A greater number of teeth with which the gear and its mate of as many can be cut on the same centrode."""
    offers = (times * keys.number_of_teeth for times in (2, 4, 6))
    return next((z for z in offers if z <= MOST_TEETH and _builds(replace(keys, number_of_teeth=z))), None)


def _rounder(key: str, asked: float) -> list[float]:
    """Ends of a search for a rounder ellipse: nearer ones first."""
    if key == "axis_ratio":
        return [1 + (asked - 1) * k for k in (0.95, 0.8, 0.6, 0.4, 0.2, 0.1, 0.05)]
    # 1 - e counts where e is near 1
    near_one = [1 - (1 - asked) * 2.0**k for k in range(1, 16) if (1 - asked) * 2.0**k <= 1]
    return [*near_one, *(asked * k for k in (0.95, 0.8, 0.6, 0.4, 0.2, 0.1, 0.05) if asked < 0.5)]


def _smaller_amplitudes(keys: NoncircularGearSpec, key: str) -> Nearest | None:
    """All amplitudes of one list by one share; None where there are two lists."""
    given: list[float] = getattr(keys, key)
    if keys.ratio_cosines and keys.ratio_sines:
        return None
    found = nearest(lambda share: _builds(replaced(keys, key, [share * x for x in given])), 1.0, 0.0)
    if found is None or not isinstance(found.value, float):
        return None
    return Nearest([round(found.value * x, 9) for x in given])


def _closing_teeth(keys: NoncircularGearSpec) -> Nearest | None:
    """The nearest number of the mate's teeth with which it closes and both gears can be cut."""
    driver, asked = keys.pair_teeth
    step = driver // math.gcd(driver, keys.whole_lobes)
    offers = sorted((k * step for k in range(1, MOST_TEETH // step + 1)), key=lambda z: abs(z - asked))
    # a shift of one gear is the other's with its sign turned
    x = keys.profile_shift_coefficient * (-1 if keys.role == "mate" else 1)

    def both(teeth: int) -> bool:
        return all(
            _builds(
                replace(
                    keys, role=role, number_of_teeth=own, mate_number_of_teeth=other, profile_shift_coefficient=shift
                )
            )
            for role, own, other, shift in (("driver", driver, teeth, x), ("mate", teeth, driver, -x))
        )

    found = next((z for z in offers[:_OFFERS] if z >= 3 and both(z)), None)
    return None if found is None else Nearest(found)


def _check_slender(keys: NoncircularGearSpec) -> None:
    """An ellipse about its focus whose roots reach the axis by far, told before its long table is made.

    Only where twice the teeth would not help: nearer ones are offered more teeth.
    """
    if keys.centrode == "ratio" or (keys.axis_ratio is None) == (keys.eccentricity is None) or keys.whole_lobes > 1:
        return
    from geometry.kinematics.centrodes import LobedEllipse

    key, teeth = keys.slender_key, keys.pair_teeth
    depth = basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg)).dedendum
    depth -= keys.profile_shift_coefficient

    def stands(number: int, value: float) -> bool:
        """Whether the least radius, a (1 - e) of an ellipse of perimeter 4 a E(e), exceeds the dedendum."""
        centrode = centrode_of(replaced(keys, key, value), teeth)
        assert isinstance(centrode, LobedEllipse)
        e = centrode.eccentricity
        quarter = np.sqrt(1 - (e * np.sin((np.arange(_SAMPLES) + 0.5) * math.pi / _SAMPLES)) ** 2).mean() * math.pi / 2
        return bool(number * math.pi / (4 * quarter) * (1 - e) > depth)

    asked, least = getattr(keys, key), _ROUND[key]
    if stands(min(2 * teeth[0], MOST_TEETH), asked):
        return

    def cure() -> Nearest | None:
        found = nearest(partial(stands, teeth[0]), asked, least)
        if found is None or not isinstance(found.value, float):
            return None
        high = found.value
        tried = (rounded(least + (high - least) * (1 - step / 16), up=False) for step in range(16))
        works = next((value for value in tried if _builds(replaced(keys, key, value))), None)
        return None if works is None else Nearest(works, "at_most")

    raise ParameterError(key, asked, "root_reaches_axis", cure)
