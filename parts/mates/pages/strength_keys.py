"""What ``higherpair calc strength`` is given: a pair of gears, its load, and what its materials bear."""

from __future__ import annotations

import math
from functools import cached_property
from typing import Annotated, Any, Literal, TypeAlias, TypeVar, cast, get_type_hints

import msgspec
from msgspec import Meta, Struct

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.strength import iso6336
from geometry.gears.strength.materials import GROUPS, Group, Quality
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import base_helix_angle
from parts.base.fields import fields_of, given_keys
from parts.base.refusal import REMOVED
from parts.keys.base import mm, size
from parts.mates.pages.external import PairKeys
from parts.mates.pages.internal import InternalKeys
from parts.pages.contact_steps import Helical
from parts.pages.force_steps import DrivenKeys
from parts.pages.page import Sheet
from parts.pages.terms import TERMS

T = TypeVar("T")
K = TypeVar("K", bound=Struct)
Pair = ExternalPair | InternalPair
# steel
_MODULUS, _RATIO = 206_000.0, 0.3

_Factor = Annotated[float, Meta(gt=0, le=100)]
_Stress = Annotated[float, size("MPa", "", above=0, most=10_000)]
_Roughness = Annotated[float, size("um", "", above=0, most=1000)]
_Hardness = Annotated[float, Meta(gt=0, le=2000)]
_Modulus = Annotated[float, size("MPa", "", above=0, most=1e7)]
_Poisson = Annotated[float, Meta(ge=0, le=0.5)]
_Rim = Annotated[float, mm("", above=0, most=10_000)]
GroupName = Literal[
    "St", "V", "V alloy", "Eh", "IF", "NT", "NV", "NV nitrocarburized", "GTS", "GGG", "GGG ferritic", "GG"
]
Method = Literal["ISO 6336", "ISO 6336:2006", "GOST 21354"]
# msgspec 0.23 crashes where a union has a tuple of two
_Both: TypeAlias = T | Annotated[list[T], Meta(min_length=2, max_length=2)]


def _both(text: str, unit: str = "") -> Meta:
    """The meaning of a key that both gears have."""
    extra = {"unit": unit} if unit else None
    return Meta(description=f"{text}; one for both gears, or [first, second]", extra=extra)


_METHOD = Meta(description="the standard; ISO 6336 is its edition of 2019")
_DYNAMIC = Meta(description="K_v; default: by accuracy_grade and speed, else 1")
_PROFILE = Meta(ge=1, le=1.2, description="f_ZCa of ISO 6336-2:2019, helical teeth")
_CYCLES = Meta(ge=1, le=1e15, description="load cycles of the first gear's teeth")
_LONG = Meta(ge=0.85, le=1, description="Z_NT and Y_NT at 10^10 cycles")
_VISCOSITY = size("mm2/s", "of the oil at 40 degrees, for Z_L", above=0, most=1e5)
_YIELD = _both("of St, V, GTS and GGG, for Y_deltarelT", "MPa")
_SURFACE = _both("Y_RrelT, by GOST Y_R; default: by root_roughness")
_HARDENING = _both("Z_W; default: on a hard mate by hardness, and by flank_roughness with oil_viscosity and speed_rpm")
_GRADIENT = _both("Y_deltarelT, by GOST Y_delta; default: by material or module")


class LoadKeys(DrivenKeys, kw_only=True):
    """Keys of the load and of the materials; those of one gear are given once for both, or as a list of two."""

    method: Annotated[Method, _METHOD] = "ISO 6336"
    application_factor: Annotated[_Factor, Meta(description="K_A")] = 1.0
    dynamic_factor: Annotated[_Factor, _DYNAMIC] | None = None
    accuracy_grade: Annotated[int, Meta(ge=3, le=12, description="grade of ISO 1328, for K_v and Y_DT")] | None = None
    face_load_factor: Annotated[_Factor, Meta(description="K_Hbeta")] = 1.0
    root_face_load_factor: Annotated[_Factor, Meta(description="K_Fbeta; default: K_Hbeta^N_F")] | None = None
    transverse_load_factor: Annotated[_Factor, Meta(description="K_Halpha")] = 1.0
    root_transverse_load_factor: Annotated[_Factor, Meta(description="K_Falpha; default: K_Halpha")] | None = None
    profile_factor: Annotated[float, _PROFILE] = 1.0
    load_cycles: Annotated[float, _CYCLES] | None = None
    life_hours: Annotated[float, Meta(gt=0, le=1e9, description="life in hours, by speed_rpm")] | None = None
    long_life_factor: Annotated[float, _LONG] = 0.85
    pits_allowed: Annotated[bool, Meta(description="some pits are allowed: another line of Z_NT")] = False
    oil_viscosity: Annotated[float, _VISCOSITY] | None = None
    least_contact_safety: Annotated[_Factor, Meta(description="S_Hmin")] = 1.0
    least_bending_safety: Annotated[_Factor, Meta(description="S_Fmin")] = 1.0
    material_group: Annotated[_Both[GroupName], _both("group of ISO 6336-5")] | None = None
    material_quality: Annotated[_Both[Quality], _both("quality of ISO 6336-5")] = "MQ"
    hardness: Annotated[_Both[_Hardness], _both("HBW of St and of iron, HV of others, HB by GOST")] | None = None
    contact_limit: Annotated[_Both[_Stress], _both("sigma_Hlim; default: by group and hardness", "MPa")] | None = None
    bending_limit: Annotated[_Both[_Stress], _both("sigma_Flim; default: by group and hardness", "MPa")] | None = None
    yield_strength: Annotated[_Both[_Stress], _YIELD] | None = None
    elastic_modulus: Annotated[_Both[_Modulus], _both("E")] = _MODULUS
    poisson_ratio: Annotated[_Both[_Poisson], _both("nu")] = _RATIO
    flank_roughness: Annotated[_Both[_Roughness], _both("R_z of the flanks, for Z_R and Z_W")] | None = None
    root_roughness: Annotated[_Both[_Roughness], _both("R_z of the fillets, for Y_RrelT")] | None = None
    rim_thickness: Annotated[_Both[_Rim], _both("s_R, for Y_B")] | None = None
    flank_factor: Annotated[_Both[_Factor], _both("Z_L Z_v Z_R as one; by GOST Z_R Z_v")] | None = None
    contact_size_factor: Annotated[_Both[_Factor], _both("Z_X of ISO 6336-2")] = 1.0
    hardening_factor: Annotated[_Both[_Factor], _HARDENING] | None = None
    surface_factor: Annotated[_Both[_Factor], _SURFACE] | None = None
    gradient_factor: Annotated[_Both[_Factor], _GRADIENT] | None = None
    reversing_factor: Annotated[_Both[_Factor], _both("Y_M, 0.7 of idlers; by GOST K_R")] = 1.0
    form_factor: Annotated[_Both[_Factor], _both("Y_FS by GOST, which has none of a ring")] | None = None


_ISO: tuple[Method, ...] = ("ISO 6336", "ISO 6336:2006")
# of keys that not every method has
METHODS: dict[str, tuple[Method, ...]] = {
    "accuracy_grade": _ISO, "profile_factor": ("ISO 6336",), "long_life_factor": _ISO, "pits_allowed": _ISO,
    "oil_viscosity": _ISO, "material_quality": _ISO, "yield_strength": _ISO, "elastic_modulus": _ISO,
    "poisson_ratio": _ISO, "flank_roughness": _ISO, "root_roughness": _ISO, "rim_thickness": _ISO,
    "contact_size_factor": _ISO, "hardening_factor": _ISO, "form_factor": ("GOST 21354",),
}  # fmt: skip


def _loaded(pair: type[K]) -> type[K]:
    """The keys of a pair with those of its load: no struct has two tables of keys for bases."""
    hints = get_type_hints(LoadKeys, include_extras=True)
    own = [f for f in fields_of(LoadKeys) if f.name not in {f.name for f in fields_of(pair)}]
    made = msgspec.defstruct(
        f"Loaded{pair.__name__}",
        [(f.name, hints[f.name], f.default) for f in own],
        bases=(pair,),
        namespace={"__doc__": "Keys of a pair, its load and its materials."},
        module=__name__,
        kw_only=True,
        forbid_unknown_fields=True,
    )
    return cast("type[K]", made)


LoadedPairKeys, LoadedInternalKeys = _loaded(PairKeys), _loaded(InternalKeys)


def each(value: T | list[Any]) -> tuple[T, T]:
    """What a key says of both gears."""
    return (value[0], value[1]) if isinstance(value, list) else (value, value)


def given_once(page: Sheet, name: str, value: float, gear: int = 0) -> None:
    """What is given, where the page has not told it yet."""
    if f"{TERMS[name].key}{gear or ''}" not in page.known:
        page.add(name, value, gear=gear, given=True)


class Rated(Record, dict=True):
    """A pair with the load and the materials that its keys give it; ``width``: the face in common, mm."""

    pair: Pair
    keys: LoadKeys
    helical: Helical
    width: float

    @property
    def helix(self) -> float:
        """Beta, rad; 0 of straight teeth."""
        return self.helical.angle

    @property
    def overlap(self) -> float:
        """eps_beta, of each half of double helical teeth."""
        return self.helical.face.overlap_ratio if self.helix else 0.0

    @property
    def groups(self) -> tuple[Group | None, Group | None]:
        """The groups of both materials, where they are given."""
        one, two = (None if name is None else GROUPS[name] for name in each(self.keys.material_group))
        return one, two

    @property
    def cycles(self) -> tuple[float, float] | None:
        """Load cycles of both gears' teeth, one contact in a turn; None: none is asked for.

        Raises
        ------
        ParameterError
            They are given twice, or hours without a speed.
        """
        keys = self.keys
        first = keys.load_cycles
        if keys.life_hours is not None:
            if first is not None:
                raise ParameterError("life_hours", keys.life_hours, "other_is_given", REMOVED, other="load_cycles")
            if keys.speed_rpm is None:
                raise ParameterError("life_hours", keys.life_hours, "needs_other", REMOVED, other="speed_rpm")
            first = 60 * keys.speed_rpm * keys.life_hours
        return None if first is None else (first, first / self.pair.gear_ratio)

    @property
    def speed(self) -> float | None:
        """v on the reference circles, m/s."""
        rpm = self.keys.speed_rpm
        return None if rpm is None else math.pi * rpm * self.pair.first.reference_radius / 30_000

    @property
    def speed_parameter(self) -> float | None:
        """(v z_1 / 100) sqrt(u^2 / (1 + u^2)), where K_v is by method C; None: it is given, or no grade or speed is."""
        keys, speed = self.keys, self.speed
        graded = keys.accuracy_grade is not None and "accuracy_grade" not in self.unused
        if keys.dynamic_factor is not None or not graded or speed is None:
            return None
        return iso6336.speed_parameter(speed, self.gears[0].number_of_teeth, self.pair.gear_ratio)

    @property
    def dynamic_parts(self) -> tuple[float, float] | None:
        """K_v0 and w_0 of K_v by method C."""
        grade, parameter = self.keys.accuracy_grade, self.speed_parameter
        if grade is None or parameter is None:
            return None
        return iso6336.dynamic_parts(grade, parameter, self.overlap, helical=self.helix > 0)

    def line_load(self, torque: float) -> float:
        """K_A F_t / b, N/mm, of a torque on the first gear, N m."""
        return self.keys.application_factor * self.force(torque) / self.width

    @property
    def gears(self) -> tuple[SpurGear | RingGear, SpurGear | RingGear]:
        """Both gears in their transverse sections, as the pair has them."""
        return self.pair.first, self.pair.second

    @property
    def normal_module(self) -> float:
        """m_n, mm."""
        return self.helical.normal.module

    @property
    def base_helix(self) -> float:
        """beta_b, rad."""
        return base_helix_angle(self.pair.first.rack.pressure_angle, self.helix) if self.helix else 0.0

    @property
    def profile_factor(self) -> float:
        """f_ZCa, which the edition of 2006 has not."""
        return 1.0 if self.keys.method == "ISO 6336:2006" else self.keys.profile_factor

    @cached_property
    def active_tips(self) -> tuple[float, float]:
        """r_Na of both gears, mm: where contact ends towards the tips."""
        (_, first), second = self.pair.active_profile_radii
        return first, second[1] if self.pair.sign > 0 else second[0]

    def force(self, torque: float) -> float:
        """F_t, N, of a torque on the first gear, N m."""
        return 1000 * torque / self.pair.first.reference_radius

    @property
    def unused(self) -> list[str]:
        """Keys that are given and that the method has not."""
        given = given_keys(self.keys)
        return [name for name, methods in METHODS.items() if self.keys.method not in methods and name in given]

    def contact_parameter(self, index: int) -> float | None:
        """M_1 or M_2: the stress where single contact of a gear begins against that at the pole, by the curvatures.

        None where contact there would lie beyond a base circle.
        """
        pair, base = self.pair, self.pair.first.base_radius
        line = pair.working_centre_distance * math.sin(pair.working_pressure_angle)
        pole = base * math.tan(pair.working_pressure_angle)
        low, high = pair.active_line
        at = high - pair.base_pitch if index == 0 else low + pair.base_pitch
        product, mate = at * (line - pair.sign * at), line - pair.sign * pole
        return math.sqrt(pole * mate / product) if at > 0 and product > 0 else None

    @property
    def reduced_curvature(self) -> float:
        """rho_red at the pole, mm."""
        one, two = (g.base_radius * math.tan(self.pair.working_pressure_angle) for g in self.gears)
        return one * two / (two + self.pair.sign * one)

    def is_hard(self, index: int) -> bool:
        """Whether the flanks of a gear are hardened, by its group."""
        group = self.groups[index - 1]
        return group is not None and group.is_hard

    def value(self, page: Sheet, key: str) -> float:
        """A number that the page knows already."""
        return float(page.value_of(key).value)
