"""Scene keys of helical teeth, shared by gears, rings and racks, and what a part says of its helix."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial, wraps
from typing import TYPE_CHECKING, Annotated, Literal, ParamSpec, TypeVar

from msgspec import Meta, Struct

from geometry.base.errors import LateError, Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.gears.teeth.helix import Hand, Helix
from parts.keys.accuracy import AccuracyKey
from parts.keys.base import MadeKeys, check_idle, degrees, either, in_vain, mm

if TYPE_CHECKING:
    from geometry.gears.pairs.common_face import CommonFace

# what STEP calls one height or one place, ten times, mm
_FINEST = 1e-6
HelixAngle = Annotated[
    float,
    degrees(
        (
            "helix angle on the reference cylinder; module, coefficients and pressure angle are then those "
            "of the normal section; negative turns the hand"
        ),
        least=-60,
        most=60,
    ),
]
HandName = Annotated[
    Literal["right", "left"], Meta(description=("hand of the teeth; of double helical teeth: of the lower half"))
]
Double = Annotated[bool, Meta(description="two helices of opposite hands that meet in the middle of the face width")]
Module = Annotated[
    float, mm("module m; the normal module where helix_angle_deg is not 0", least=0.01, most=1000, example=2.0)
]

_CIRCUMFERENTIAL_THINNING = mm("thinning of each tooth for backlash, arc on the reference circle", least=0, most=1000)


class ToothedKeys(MadeKeys, forbid_unknown_fields=True, kw_only=True):
    """Keys of everything with involute teeth on parallel axes, straight or helical."""

    module: Module
    circumferential_thinning: Annotated[float, _CIRCUMFERENTIAL_THINNING] = 0.0
    tip_chamfer: Annotated[float, mm("radial height of a 45 degree tip chamfer", least=0, most=1000)] = 0.0
    tip_rounding: Annotated[float, mm("radius of the tip corner", least=0, most=1000)] = 0.0
    helix_angle_deg: HelixAngle = 0.0
    hand: HandName = "right"
    double_helical: Double = False
    accuracy: AccuracyKey = None


def helix_of(keys: Struct) -> Helix:
    """The helix of a part's keys; that of spur gears for parts without such keys."""
    if not isinstance(keys, ToothedKeys):
        return Helix()
    hand: Hand = keys.hand
    if keys.helix_angle_deg < 0:
        hand = "left" if hand == "right" else "right"
    return Helix(math.radians(abs(keys.helix_angle_deg)), hand, keys.double_helical)


def same_helix(first: ToothedKeys, second: ToothedKeys) -> float:
    """The helix angle of two mates, rad, whatever their hands: no number of a pair depends on those.

    Raises
    ------
    ParameterError
        They differ, or one of both gears alone is double helical.
    """
    one, two = helix_of(first), helix_of(second)
    if one.angle != two.angle:
        raise ParameterError(
            "helix_angle_deg", second.helix_angle_deg, "not_that_of_first", Nearest(first.helix_angle_deg)
        )
    if one.angle and one.double != two.double:
        raise ParameterError("double_helical", two.double, "one_double_helix", Nearest(one.double))
    return one.angle


def idle_helix(keys: ToothedKeys) -> Iterator[ParameterError]:
    """Two helices without an angle."""
    if not keys.helix_angle_deg:
        yield from in_vain(keys, ("double_helical",), "double_helical_without_angle")


def checked_teeth(keys: ToothedKeys, number_of_teeth: int) -> Helix:
    """The helix of a part's keys, which belong together.

    Raises
    ------
    ParameterError
        Two helices without an angle, one that no file could tell, or a tip corner that is broken twice.
    """
    if keys.tip_chamfer > 0 and keys.tip_rounding > 0:
        raise either("tip_rounding", keys.tip_rounding, "tip_chamfer", 0.0)
    helix = helix_of(keys)
    check_idle(idle_helix(keys))
    # how far a helix moves teeth, mm, and the least that each file tells: four steps of an STL's float32
    moved = keys.face_width / (2 if helix.double else 1) * math.tan(helix.angle)
    told = max(_FINEST, 2.0**-22 * math.pi * keys.module * (number_of_teeth + 4))
    if 0 < moved < told:
        raise ParameterError(
            "helix_angle_deg", keys.helix_angle_deg, "helix_not_told", Nearest(0.0), by=moved, told=told
        )
    return helix


def common_face(first: Struct, second: Struct) -> CommonFace:
    """The face that two mates' keys give them, both at one height; that of straight teeth for other parts."""
    from geometry.gears.pairs.common_face import STRAIGHT, CommonFace

    if not (isinstance(first, ToothedKeys) and first.helix_angle_deg and isinstance(second, MadeKeys)):
        return STRAIGHT
    return CommonFace(helix_of(first), first.module, min(first.face_width, second.face_width))


def helix_quantities(keys: ToothedKeys, reference_radius: float) -> dict[str, float]:
    """Normal pitch and lead of helical teeth, mm; nothing for straight ones."""
    helix = helix_of(keys)
    if helix.angle == 0:
        return {}
    return {"normal_pitch": math.pi * keys.module, "lead": helix.lead(reference_radius)}


def idle_findings(keys: ToothedKeys, thinning: float) -> Iterator[Finding]:
    """The remarks that straight teeth have no hand, and that nothing is cut deeper where nothing is thinned, mm."""
    yield from hand_finding(keys.hand, not keys.helix_angle_deg)
    if getattr(keys, "thinning_method", "") == "deeper_cut" and not thinning:
        yield Finding("deeper_cut_of_nothing", 0.0, 0.0)


def hand_finding(hand: Hand, straight: bool) -> tuple[Finding, ...]:
    """The remark that straight teeth have no hand."""
    return (Finding("hand_of_straight_teeth", 0.0, 0.0),) if hand != "right" and straight else ()


def section_finding(keys: ToothedKeys) -> tuple[Finding, ...]:
    """The remark that a flat outline of helical teeth is their transverse section."""
    return (Finding("transverse_section", keys.helix_angle_deg, 0.0),) if keys.helix_angle_deg else ()


# parameters of teeth as scenes have them, and in which unit
_KEYS: dict[str, tuple[str, float | None]] = {
    "pressure_angle": ("pressure_angle_deg", math.degrees(1)),
    "helix_angle": ("helix_angle_deg", math.degrees(1)),
    "spiral_angle": ("spiral_angle_deg", math.degrees(1)),
    "rack.addendum": ("basic_rack.addendum_coefficient", None),
    "rack.tip_clearance": ("basic_rack.tip_clearance_coefficient", None),
    "rack.tip_radius": ("basic_rack.tip_radius_coefficient", None),
    "relief.depth": ("tip_relief.depth_coefficient", None),
    "relief.height": ("tip_relief.height_coefficient", None),
    "cutter.addendum": ("cutter.addendum_coefficient", None),
    "cutter.tip_rounding": ("cutter.tip_rounding_coefficient", None),
    "root.dedendum": ("rounded_root.dedendum_coefficient", None),
    "root.radius": ("rounded_root.radius_coefficient", None),
}
P = ParamSpec("P")
T = TypeVar("T")


def in_keys(refusal: ParameterError) -> ParameterError:
    """A refusal of teeth in the key and the unit that scenes have for the parameter."""
    name, factor = _KEYS.get(refusal.name, (refusal.name, None))
    return refusal if name == refusal.name else refusal.renamed(name, factor)


def in_normal_terms(refusal: ParameterError, own: Struct, other: Struct) -> ParameterError:
    """A refusal of transverse sections with the normal value that the blamed one's ``own`` keys give."""
    cosine, key = math.cos(helix_of(own).angle), refusal.name
    if cosine == 1 or key not in ("profile_shift_coefficient", "pressure_angle_deg"):
        return refusal

    def cure() -> Nearest | None:
        if key == "pressure_angle_deg":
            return Nearest(getattr(other, key))
        return refusal.nearest and refusal.nearest.scaled(1 / cosine)

    return refusal.told_of(key, getattr(own, key), cure)


def told_in_keys(made: Callable[P, T]) -> Callable[P, T]:
    """Of what makes teeth from keys: its refusals are told ``in_keys``."""

    @wraps(made)
    def wrapper(*args: P.args, **kwargs: P.kwargs) -> T:
        try:
            return made(*args, **kwargs)
        except ParameterError as refusal:
            raise LateError(refusal.code, partial(in_keys, refusal)) from refusal

    return wrapper
