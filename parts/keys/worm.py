"""Scene keys of a worm: its own, and those that a wheel tells of the worm that it is for."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Literal, Protocol

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError, limit, rounded
from geometry.base.nearest import kept, nearest
from parts.keys.base import degrees, in_modules, mm

if TYPE_CHECKING:
    from geometry.gears.worms.worm import Worm

AxialModule = Annotated[float, mm("axial module of the worm", above=0, most=1000, example=2.0)]
Starts = Annotated[int, Meta(ge=1, le=50, description="starts of the worm, z1")]
Quotient = Annotated[float, Meta(gt=0, le=1000, description="q = d1 / m")]
# of a worm that gives neither q nor a lead angle
USUAL_QUOTIENT = 10.0
# how much larger a q is tried than one that does not do
_WIDER = (1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 5.0, 10.0, 20.0)
# pressure angles that are tried, deg
_ANGLES = (45.0, 40.0, 35.0, 30.0, 25.0, 20.0, 15.0, 10.0)
# how near to the last one that holds a value of a wheel is found, modules or part of it
NEAR = 8e-4
WormQuotient = Annotated[
    float, Meta(gt=0, le=1000, description="q = d1 / m; default: 10", examples=[USUAL_QUOTIENT])
]  # fmt: skip
LeadAngle = Annotated[
    float, degrees("lead angle on the reference cylinder, in place of q", above=0, below=89, example=5.7)
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
WheelShift = Annotated[float, in_modules("profile shift of the wheel", least=-3, most=3)]


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
        They give both, and these do not agree.
    """
    given = keys.diameter_quotient
    if keys.lead_angle_deg is None:
        return given or USUAL_QUOTIENT
    wanted = keys.number_of_starts / math.tan(math.radians(keys.lead_angle_deg))
    if given is not None and not math.isclose(given, wanted, rel_tol=1e-9):
        told = {"one": "lead_angle_deg", "other": "diameter_quotient"}
        raise ParameterError("diameter_quotient", given, "either_key", Nearest(None), **told)
    return wanted


def larger_quotients(start: float, most: float = math.inf) -> list[float]:
    """Diameter quotients that are tried, larger and larger ones, ``most`` the last."""
    return [*(end for share in _WIDER if (end := start * share) < most), *([most] if most < math.inf else [])]


def smaller_angles(start: float) -> list[float]:
    """Pressure angles that are tried, smaller and smaller ones, deg."""
    return [angle for angle in _ANGLES if angle < start]


def wider(
    refusal: ParameterError,
    does: Callable[[float], bool],
    stands: Callable[[float], bool],
    most: float = math.inf,
) -> ParameterError:
    """A refusal of the diameter quotient with the least that does for the whole part, from its own limit on.

    ``does``: a margin of the part; ``stands``: the part itself, which is more and costly; ``most``: that may be.
    """
    if refusal.name != "diameter_quotient":
        return refusal

    def cure() -> Nearest | None:
        own = refusal.nearest
        start = float(str(refusal.value if own is None else own.value))
        if own is not None and kept(stands, start):
            return own
        ends = larger_quotients(start, most)
        found = nearest(does, start, ends, share=NEAR)
        if found is None or not isinstance(found.value, float) or kept(stands, found.value):
            return found
        # costly, so by a few trials
        return nearest(stands, found.value, [end for end in ends if end > found.value], share=NEAR)

    return ParameterError(refusal.name, refusal.value, refusal.code, cure, **refusal.numbers)


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


def worm_of(keys: Threaded, fillet_coefficient: float = 0.2, thinning: float = 0.0) -> Worm:
    """The worm that keys tell, checked to exist.

    Raises
    ------
    ParameterError
        Its root lies under its axis, or its thread is pointed.
    """
    from geometry.gears.worms.worm import Worm

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
