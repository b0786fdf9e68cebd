"""Limits of a spur gear, each a function with its margin, and the search for the nearest gear that works."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from geometry.curve import start_point
from geometry.errors import GeometryError, ParameterError, UndercutError, at_least, at_most
from geometry.findings import Finding
from geometry.gears.joints import pointed_radius
from geometry.gears.shaping import check_shaping, least_shift_with_cutter
from geometry.gears.spur import SpurGear
from geometry.gears.tooth import tooth_side
from geometry.profile import Label

# practicum, condition below (1.3): S_a >= 0.3 m
LEAST_TIP_THICKNESS = 0.3
# practicum (1.2): xi_min = (17 - z) / 17
PRACTICUM_LEAST_TEETH = 17


@dataclass(frozen=True, slots=True)
class Margin:
    """How far a gear is from a limit; ``margin`` >= 0 where the limit is kept."""

    name: str
    value: float
    limit: float
    margin: float


def least_shift_without_undercut(gear: SpurGear) -> float:
    """x_min = h_Ff - z sin^2(alpha) / 2: exact for a rack with a rounded tip; with a cutter see ``shaping``."""
    if gear.cutter is not None:
        return least_shift_with_cutter(gear)
    return gear.rack.form_dedendum - gear.number_of_teeth * math.sin(gear.rack.pressure_angle) ** 2 / 2


def undercut(gear: SpurGear) -> Margin:
    """Undercut, exactly: the generating shift against x_min."""
    limit = least_shift_without_undercut(gear)
    value = gear.generating_shift_coefficient
    return Margin("undercut", value, limit, value - limit)


def practicum_undercut(gear: SpurGear) -> Margin:
    """Undercut by the practicum's rule (1.2), xi_min = (17 - z) / 17, meant for 20 degrees and h_a = 1."""
    limit = (PRACTICUM_LEAST_TEETH - gear.number_of_teeth) / PRACTICUM_LEAST_TEETH
    value = gear.profile_shift_coefficient
    return Margin("practicum_undercut", value, limit, value - limit)


def pointed_diameter(gear: SpurGear) -> float:
    """Diameter at which both flanks of a tooth meet, mm."""
    flanks = [gear.flank()]
    if gear.rack.relief is not None:
        flanks.append(gear.relief_flank())
    return 2 * min(pointed_radius(f) for f in flanks)


def pointed_tip(gear: SpurGear) -> Margin:
    """Tip diameter against the diameter at which the tooth is pointed, mm."""
    limit, value = pointed_diameter(gear), 2 * gear.tip_radius
    return Margin("pointed_tip", value, limit, limit - value)


def tip_thickness(gear: SpurGear) -> float:
    """s_a: thickness of the tooth on the tip circle before its corners are broken, mm (an arc)."""
    flanks = [gear.flank()]
    if gear.rack.relief is not None:
        flanks.append(gear.relief_flank())
    angle = max(float(f.polar_angle_at_radius(gear.tip_radius)) for f in flanks)
    return -2 * gear.tip_radius * angle


def thin_tip(gear: SpurGear) -> Margin:
    """s_a against 0.3 m, mm; practicum, below (1.3)."""
    value, limit = tip_thickness(gear), LEAST_TIP_THICKNESS * gear.module
    return Margin("thin_tip", value, limit, value - limit)


def root_below_bore(gear: SpurGear) -> Margin:
    """Diameter that the bore reaches against the root diameter, mm."""
    value, limit = 2 * gear.bore_radius, 2 * gear.root_radius
    return Margin("root_below_bore", value, limit, limit - value)


def root_form_diameter(gear: SpurGear) -> float:
    """d_Ff: diameter at which the involute begins, mm."""
    flank = next(s for s in tooth_side(gear).segments if s.label is Label.FLANK)
    return 2 * abs(start_point(flank.curve))


def margins(gear: SpurGear) -> tuple[Margin, ...]:
    """All limits of a gear."""
    return undercut(gear), practicum_undercut(gear), pointed_tip(gear), thin_tip(gear), root_below_bore(gear)


def findings(gear: SpurGear) -> tuple[Finding, ...]:
    """Remarks on a gear that is legal but poor: undercut, thin tip, tip circle above the rack's root."""
    found = [Finding(m.name, m.value, m.limit) for m in (undercut(gear), thin_tip(gear)) if m.margin < 0]
    if gear.bore_radius > 0 and gear.root_radius - gear.bore_radius < gear.module:
        found.append(Finding("thin_rim", gear.root_radius - gear.bore_radius, gear.module))
    return tuple(found)


def checked_gear(gear: SpurGear) -> SpurGear:
    """The gear itself if it can be built, else a refusal that names the nearest value that works.

    Raises
    ------
    ParameterError
        With the key, its value and the nearest value of that or another key that gives a gear.
    """
    _check_numbers(gear)
    rim = root_below_bore(gear)
    if gear.root_radius > 0 and gear.bore_diameter > 0 and rim.margin <= 0:
        text = f"reaches the root circle, {at_most(rim.limit)} mm; at most {at_most(rim.limit - 1.5e-4, 5)} mm works"
        raise ParameterError("bore_diameter", rim.value, text)
    check_shaping(gear)
    try:
        tooth_side(gear)
    except ParameterError as refusal:
        raise _with_remedy(gear, refusal) from refusal
    gear.holes.check(gear.root_radius)
    return gear


def exists(gear: SpurGear) -> bool:
    """Whether ``checked_gear`` has nothing to say, without its search for what would work."""
    try:
        _check_numbers(gear)
    except ParameterError:
        return False
    return (gear.bore_diameter <= 0 or root_below_bore(gear).margin > 0) and _builds(gear)


def _builds(gear: SpurGear) -> bool:
    try:
        check_shaping(gear)
        tooth_side(gear)
    except GeometryError:
        return False
    return gear.holes.fits(gear.root_radius)


def _check_numbers(gear: SpurGear) -> None:
    """Refuse what is no dimension at all."""
    if not gear.number_of_teeth >= 1:
        raise ParameterError("number_of_teeth", gear.number_of_teeth, "must be at least 1")
    if not 0 < gear.module < math.inf:
        raise ParameterError("module", gear.module, "must be a finite number above 0")
    if not math.isfinite(gear.profile_shift_coefficient):
        raise ParameterError("profile_shift_coefficient", gear.profile_shift_coefficient, "must be a finite number")
    if gear.given_tip_diameter is not None and not 0 < gear.given_tip_diameter < math.inf:
        raise ParameterError("tip_diameter", gear.given_tip_diameter, "must be a finite number above 0")
    for name in ("circumferential_thinning", "tip_chamfer", "tip_rounding", "bore_diameter"):
        if not 0 <= getattr(gear, name) < math.inf:
            raise ParameterError(name, getattr(gear, name), "must be a finite number, at least 0; 0 works")


@dataclass(frozen=True, slots=True)
class _Key:
    """A key that may be to blame: its value, one that takes it out of play, and the gear with another value."""

    name: str
    value: float
    harmless: float
    gear_with: Callable[[float], SpurGear]
    unit: str = " mm"


def _suspects(gear: SpurGear) -> list[_Key]:
    """Keys of a gear that could be changed alone, the most special first."""
    keys = [
        _Key("tip_chamfer", gear.tip_chamfer, 0.0, lambda v: replace(gear, tip_chamfer=v)),
        _Key("tip_rounding", gear.tip_rounding, 0.0, lambda v: replace(gear, tip_rounding=v)),
        _Key(
            "circumferential_thinning",
            gear.circumferential_thinning,
            0.0,
            lambda v: replace(gear, circumferential_thinning=v),
        ),
    ]
    if (relief := gear.rack.relief) is not None:
        keys.append(
            _Key(
                "tip_relief.depth_coefficient",
                relief.depth,
                0.0,
                lambda v: replace(gear, rack=replace(gear.rack, relief=replace(relief, depth=v))),
                "",
            )
        )
        keys.append(
            _Key(
                "tip_relief.height_coefficient",
                relief.height,
                1e-6,
                lambda v: replace(gear, rack=replace(gear.rack, relief=replace(relief, height=v))),
                "",
            )
        )
    # lower than any tip that leaves a flank: what is between is found by the search for the boundary
    given = 2 * gear.tip_radius
    default = 2 * replace(gear, given_tip_diameter=None).tip_radius
    keys.append(_Key("tip_diameter", given, default, lambda v: replace(gear, given_tip_diameter=v)))
    return [k for k in keys if k.value != k.harmless]


def _with_remedy(gear: SpurGear, refusal: ParameterError) -> ParameterError:
    """The refusal told in the user's keys, with the nearest value that works."""
    kind = type(refusal)

    def builds_with(key: _Key, value: float) -> bool:
        return _builds(key.gear_with(value))

    for key in sorted(_suspects(gear), key=lambda k: k.name != refusal.name):
        if _builds(key.gear_with(key.harmless)):
            works = _boundary(partial(builds_with, key), key.harmless, key.value)
            text = f"at most {at_most(works, 4)}" if works < key.value else f"at least {at_least(works, 4)}"
            return kind(key.name, key.value, f"{refusal.allowed}; {text}{key.unit} works")
    x = gear.profile_shift_coefficient
    nearest = _nearest(lambda v: _builds(replace(gear, profile_shift_coefficient=v)), x)
    if nearest is not None:
        text = f"at least {at_least(nearest, 4)}" if nearest > x else f"at most {at_most(nearest, 4)}"
        return kind("profile_shift_coefficient", x, f"{refusal.allowed}; {text} works")
    diameter = 2 * gear.tip_radius
    lower = (diameter * (1 - k / 200) for k in range(1, 160))
    good = next((d for d in lower if _builds(replace(gear, given_tip_diameter=d))), None)
    if good is not None:
        works = _boundary(lambda v: _builds(replace(gear, given_tip_diameter=v)), good, diameter)
        return kind("tip_diameter", diameter, f"{refusal.allowed}; at most {at_most(works, 4)} mm works")
    z = gear.number_of_teeth
    teeth = next((n for n in range(z + 1, z + 60) if _builds(replace(gear, number_of_teeth=n))), None)
    remedy = f"; {teeth} teeth work" if teeth is not None else ""
    return UndercutError("number_of_teeth", z, f"{refusal.name}: {refusal.allowed}{remedy}")


def _boundary(works: Callable[[float], bool], good: float, bad: float) -> float:
    """The last value from ``good`` towards ``bad`` that works, by bisection."""
    for _ in range(40):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if works(middle) else (good, middle)
    return good


def _nearest(works: Callable[[float], bool], value: float) -> float | None:
    """The shift nearest to a refused one that works, sought from -3 to 3 in steps of 0.05."""
    grid = sorted((k / 20 for k in range(-60, 61)), key=lambda v: abs(v - value))
    good = next((v for v in grid if works(v)), None)
    return None if good is None else _boundary(works, good, value)
