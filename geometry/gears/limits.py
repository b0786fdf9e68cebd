"""Limits of a spur gear, each a function with its margin, and the search for the nearest gear that works."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from geometry.curve import start_point
from geometry.errors import GeometryError, ParameterError, UndercutError, at_least, at_most
from geometry.findings import Finding
from geometry.gears.joints import pointed_radius
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
    """x_min = h_Ff - z sin^2(alpha) / 2: exact for a rack with a rounded tip."""
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
    """Bore diameter against the root diameter, mm."""
    value, limit = gear.bore_diameter, 2 * gear.root_radius
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
    rim = root_below_bore(gear)
    if gear.root_radius > 0 and gear.bore_diameter > 0 and rim.margin <= 0:
        raise ParameterError("bore_diameter", rim.value, f"must be below the root diameter, {at_most(rim.limit)} mm")
    try:
        tooth_side(gear)
    except ParameterError as refusal:
        raise _with_remedy(gear, refusal) from refusal
    return gear


def _builds(gear: SpurGear) -> bool:
    try:
        tooth_side(gear)
    except GeometryError:
        return False
    return gear.root_radius > gear.bore_radius


def _with_remedy(gear: SpurGear, refusal: ParameterError) -> ParameterError:
    """The refusal told in the user's keys, with the nearest value that works."""
    kind, x = type(refusal), gear.profile_shift_coefficient
    for name, value, changed, unit in _reducible(gear):
        if refusal.name == name and _builds(changed(1e-9)):
            largest = _largest_that_builds(changed, value)
            return kind(name, value, f"{refusal.allowed}; at most {at_most(largest, 4)}{unit} works")
    if gear.given_tip_diameter is not None:
        given = gear.given_tip_diameter
        near = _nearest(lambda v: _builds(replace(gear, given_tip_diameter=v)), given, gear.module)
        if near is not None:
            word = at_most if near < given else at_least
            return kind("tip_diameter", given, f"{refusal.allowed}; {word(near, 4)} mm works")
    if gear.circumferential_thinning > 0 and _builds(replace(gear, circumferential_thinning=0.0)):
        value = gear.circumferential_thinning
        largest = _boundary(lambda v: _builds(replace(gear, circumferential_thinning=v)), 0.0, value)
        return kind("circumferential_thinning", value, f"{refusal.allowed}; at most {at_most(largest, 4)} mm works")
    nearest = _nearest(lambda v: _builds(replace(gear, profile_shift_coefficient=v)), x, 0.05)
    if nearest is not None:
        word = at_least if nearest > x else at_most
        return kind("profile_shift_coefficient", x, f"{refusal.allowed}; the nearest that works is {word(nearest, 4)}")
    z = gear.number_of_teeth
    teeth = next((n for n in range(z + 1, z + 60) if _builds(replace(gear, number_of_teeth=n))), None)
    remedy = f"; {teeth} teeth work" if teeth is not None else ""
    return UndercutError("number_of_teeth", z, f"{refusal.name}: {refusal.allowed}{remedy}")


def _largest_that_builds(changed: Callable[[float], SpurGear], refused: float) -> float:
    """The value nearest below a refused one with which a gear can be built."""
    return _boundary(lambda value: _builds(changed(value)), 1e-9, refused)


def _reducible(gear: SpurGear) -> list[tuple[str, float, Callable[[float], SpurGear], str]]:
    """Keys that may simply be too large: name, value, the gear with another value, unit."""
    keys: list[tuple[str, float, Callable[[float], SpurGear], str]] = [
        ("tip_chamfer", gear.tip_chamfer, lambda v: replace(gear, tip_chamfer=v), " mm"),
        ("tip_rounding", gear.tip_rounding, lambda v: replace(gear, tip_rounding=v), " mm"),
    ]
    rack, relief = gear.rack, gear.rack.relief
    if relief is not None:
        keys.append(
            (
                "tip_relief.height_coefficient",
                relief.height,
                lambda v: replace(gear, rack=replace(rack, relief=replace(relief, height=v))),
                "",
            )
        )
    return keys


def _boundary(works: Callable[[float], bool], good: float, bad: float) -> float:
    """The last value from ``good`` towards ``bad`` that works, by bisection."""
    for _ in range(40):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if works(middle) else (good, middle)
    return good


def _nearest(works: Callable[[float], bool], value: float, step: float) -> float | None:
    """The value nearest to a refused one that works, within 60 steps either way."""
    for k in range(1, 61):
        for side in (1, -1):
            if works(value + side * k * step):
                return _boundary(works, value + side * k * step, value + side * (k - 1) * step)
    return None
