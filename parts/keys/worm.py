"""Scene keys of a worm: its own, and those that a wheel tells of the worm that it is for."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, partial
from typing import TYPE_CHECKING, Annotated, Literal, Protocol, TypeVar

from msgspec import Meta, Struct
from msgspec.structs import replace as changed

from geometry.base.errors import Nearest, ParameterError, limit, rounded
from geometry.base.nearest import kept, nearest
from parts.keys.base import check_idle, degrees, either, in_modules, in_vain, mm

if TYPE_CHECKING:
    from geometry.gears.worms.worm import Worm

K = TypeVar("K", bound=Struct)
AxialModule = Annotated[float, mm("axial module of the worm", above=0, most=1000, example=2.0)]
Starts = Annotated[int, Meta(ge=1, le=50, description="starts of the worm, z1")]
TipRounding = Annotated[float, mm("radius of the thread's tip edges in the axial section", least=0, most=1000)]
_MOST_QUOTIENT = 1000
Quotient = Annotated[float, Meta(gt=0, le=_MOST_QUOTIENT, description="q = d1 / m")]
# of a worm that gives neither q nor a lead angle
USUAL_QUOTIENT = 10.0
# values that are tried of keys that may take thread or teeth away: of addenda lower ones leave a rounding no room,
# higher ones grinding wheels no foot; how much larger a q; angles, deg; parts of what is given
_ADDENDA = (1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1, 0.05, 0.02)
_WIDER = (1.1, 1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0)
_ANGLES = (45.0, 40.0, 35.0, 30.0, 25.0, 20.0, 15.0, 10.0)
_LESS = (0.9, 0.75, 0.5, 0.25, 0.1, 0.0)
# how near to the last one that holds a value of a wheel is found, modules or part of it
NEAR = 8e-4
WormQuotient = Annotated[
    float, Meta(gt=0, le=_MOST_QUOTIENT, description="q = d1 / m; default: 10", examples=[USUAL_QUOTIENT])
]  # fmt: skip
_MOST_LEAD = 89
LeadAngle = Annotated[
    float, degrees("lead angle on the reference cylinder, in place of q", above=0, below=_MOST_LEAD, example=5.7)
]
Form = Annotated[Literal["ZA", "ZI", "ZN1", "ZN2", "ZK1"], Meta(description="form of the flanks, GOST 18498")]
WormAngle = Annotated[
    float, degrees("in the axial section (ZA), in the normal one, or of the grinding wheel (ZK1)", above=0, below=60)
]
WormHand = Annotated[Literal["right", "left"], Meta(description="hand of the worm")]
Addendum = Annotated[float, in_modules("addendum of the worm", above=0, most=5)]
Clearance = Annotated[float, in_modules("tip clearance", least=0, most=2)]
Fillet = Annotated[float, in_modules("fillet at the worm's root", least=0, most=2)]
GrindingWheel = Annotated[float, mm("mean diameter of the grinding wheel of ZK1", above=0, most=1e6)]
DistanceError = Annotated[float, mm("by how much the axes stand too far apart", least=-10, most=10)]
AngleError = Annotated[
    float, degrees("by how much the worm's axis rises about the line of centres", least=-10, most=10)
]
AxialError = Annotated[float, mm("by how much the wheel's middle stands above the worm's axis", least=-100, most=100)]
HobRounding = Annotated[float, in_modules("rounding of the hob's tip, in its axial section", least=0, most=2)]
HobQuotient = Annotated[
    float,
    Meta(
        gt=0, le=1000, description="q of the hob, more than the worm's for a crowned wheel; default: the worm's",
        examples=[10.5],
    ),
]  # fmt: skip
HobThinning = Annotated[
    float, mm("by how much the hob's threads are thicker than the worm's, along its axis", least=0, most=100)
]
_MOST_SHIFT = 3
WheelShift = Annotated[float, in_modules("profile shift of the wheel", least=-_MOST_SHIFT, most=_MOST_SHIFT)]
WheelDistance = Annotated[
    float, mm("centre distance, in place of the profile shift", above=0, most=1e6, example=41.0)
]  # fmt: skip


class Threaded(Protocol):
    """Keys that tell a worm, which other worms and their wheels have too."""

    module: float
    number_of_starts: int
    form: Literal["ZA", "ZI", "ZN1", "ZN2", "ZK1"]
    pressure_angle_deg: float
    hand: Literal["right", "left"]
    addendum_coefficient: float
    tip_clearance_coefficient: float
    grinding_wheel_diameter: float

    @property
    def diameter_quotient(self) -> float | None:
        """d1 / m; the usual one where it is not given."""


class Led(Protocol):
    """Keys that tell a worm's size by its quotient, or by its lead angle."""

    number_of_starts: int
    diameter_quotient: float | None
    lead_angle_deg: float | None


def quotient_of(keys: Led) -> float:
    """d1 / m: given, of the lead angle, or the usual one.

    Raises
    ------
    ParameterError
        They give both, and these do not agree, or an angle whose quotient is more than any may be.
    """
    given, angle = keys.diameter_quotient, keys.lead_angle_deg
    if angle is None:
        return given or USUAL_QUOTIENT
    least = math.degrees(math.atan(keys.number_of_starts / _MOST_QUOTIENT))
    if angle < least * (1 - 1e-9):
        raise ParameterError.beyond("lead_angle_deg", angle, "out_of_range", least, least=least, most=_MOST_LEAD)
    wanted = keys.number_of_starts / math.tan(math.radians(angle))
    if given is not None and not math.isclose(given, wanted, rel_tol=1e-9):
        raise either("diameter_quotient", given, "lead_angle_deg")
    return wanted


class Shifted(Protocol):
    """Keys that tell how far a wheel stands off its worm, by its profile shift or by the distance."""

    module: float
    profile_shift_coefficient: float
    working_centre_distance: float | None


def shift_of(keys: Shifted, quotient: float, number_of_teeth: int) -> float:
    """The wheel's profile shift, modules: given, or a_w / m - (q + z2) / 2.

    Raises
    ------
    ParameterError
        They give both, or a distance for which the wheel would be shifted too far.
    """
    distance, shift = keys.working_centre_distance, keys.profile_shift_coefficient
    if distance is None:
        return shift
    if shift:
        raise either("profile_shift_coefficient", shift, "working_centre_distance")
    middle = (quotient + number_of_teeth) / 2
    shift = distance / keys.module - middle
    if abs(shift) > _MOST_SHIFT:
        last = keys.module * (middle + math.copysign(_MOST_SHIFT, shift))
        within = limit(last, distance)
        raise ParameterError(
            "working_centre_distance", distance, "asks_for_shift", within, shift=shift, most=_MOST_SHIFT
        )
    return shift


def ways_out(
    keys: Threaded, before: Iterable[str], after: Iterable[str] = (), most: float = math.inf
) -> dict[str, Sequence[float]]:
    """Keys that alone may leave thread or teeth, and values of each, less and less wrong.

    ``before`` and ``after`` all others: keys of which less may do; ``most``: that the diameter quotient may be.
    """
    first, last = (
        {key: [share * value for share in _LESS] for key in names if (value := getattr(keys, key))}
        for names in (before, after)
    )
    quotient = keys.diameter_quotient or USUAL_QUOTIENT
    larger = [value for share in _WIDER if (value := share * quotient) < most]
    return {
        **first,
        "addendum_coefficient": [value for value in _ADDENDA if value < keys.addendum_coefficient],
        "diameter_quotient": [*larger, *([most] if quotient < most < math.inf else [])],
        "number_of_starts": range(keys.number_of_starts - 1, 0, -1),
        "pressure_angle_deg": [angle for angle in _ANGLES if angle < keys.pressure_angle_deg],
        **last,
    }


def cured(
    refusal: ParameterError,
    keys: K,
    ways: Mapping[str, Sequence[float]],
    looks: Sequence[Callable[[K], bool]],
    useful: Callable[[K], bool] | None = None,
    share: float = 0.0,
) -> ParameterError:
    """A refusal in a key that alone cures it, with the value nearest to the given one that is made, to a ``share``.

    Its own key is the first where it has a limit, then those of ``ways`` in turn; of these the first of which a value
    is ``useful``, else made. ``looks``: whether a part is made; each is closer than that before it, the last decides.
    """
    if refusal.name not in ways:
        return refusal
    own, fallback = refusal.nearest, None
    # what is cured by its absence has no better value
    if own == Nearest(None):
        return refusal
    limits = {} if own is None or not isinstance(own.value, int | float) else {refusal.name: own.value}

    @cache
    def works(look: Callable[[K], bool], key: str, value: float) -> bool:
        return kept(look, changed(keys, **{key: value}))

    def stays(key: str, value: float) -> bool:
        return works(looks[0], key, value) and works(looks[-1], key, value)

    def cure(key: str, start: float, ends: Sequence[float]) -> Nearest | None:
        place = start
        for look in looks:
            beyond = [end for end in ends if (end - place) * (place - start) >= 0]
            found = nearest(partial(works, look, key), place, beyond, share=share)
            if found is None or not isinstance(found.value, int | float):
                return None
            if works(looks[-1], key, place := found.value):
                return found
        return None

    for key in dict.fromkeys((*limits, *ways)):
        given: float = getattr(keys, key)
        if (start := limits.get(key, given)) != given and stays(key, start):
            return refusal
        ends = [end for end in ways[key] if end != start and (end - start) * (start - given) >= 0]
        told = ParameterError(key, given, refusal.code, partial(cure, key, start, ends), **refusal.numbers)
        for end in filter(partial(stays, key), ends):
            if useful is None or kept(useful, changed(keys, **{key: end})):
                return told
            fallback = fallback or told
    return fallback or ParameterError(refusal.name, refusal.value, refusal.code, None, **refusal.numbers)


def in_degrees(refusal: ParameterError, keys: Led) -> ParameterError:
    """A refusal of the diameter quotient in the lead angle that it stands for, where that is given."""
    if refusal.name != "diameter_quotient" or refusal.code == "either_key" or keys.lead_angle_deg is None:
        return refusal

    def cure() -> Nearest | None:
        found = refusal.nearest
        if found is None or not isinstance(found.value, float):
            return None
        return Nearest(rounded(math.degrees(math.atan2(keys.number_of_starts, found.value)), up=False), "at_most")

    return ParameterError("lead_angle_deg", keys.lead_angle_deg, refusal.code, cure, **refusal.numbers)


def hob_quotient(given: float | None, worm: float) -> float:
    """q of the hob: the worm's where none is given.

    Raises
    ------
    ParameterError
        It is less than the worm's.
    """
    if given is not None and given < worm:
        raise ParameterError("hob_diameter_quotient", given, "hob_smaller_than_worm", limit(worm, given))
    return given or worm


def idle_of_worm(keys: Threaded) -> Iterator[ParameterError]:
    """The size of a grinding wheel, which cuts one form alone."""
    if keys.form != "ZK1":
        yield from in_vain(keys, ("grinding_wheel_diameter",), other='form = "ZK1"')


def worm_of(keys: Threaded, fillet_coefficient: float = 0.2, thinning: float = 0.0) -> Worm:
    """The worm that keys tell, checked to exist.

    Raises
    ------
    ParameterError
        Its root lies under its axis, or its thread is pointed.
    """
    from geometry.gears.worms.worm import Worm

    check_idle(idle_of_worm(keys))
    return Worm(
        keys.module,
        keys.number_of_starts,
        keys.diameter_quotient or USUAL_QUOTIENT,
        keys.form,
        math.radians(keys.pressure_angle_deg),
        keys.hand,
        keys.addendum_coefficient,
        keys.tip_clearance_coefficient,
        fillet_coefficient,
        keys.grinding_wheel_diameter,
        thinning,
    ).checked()
