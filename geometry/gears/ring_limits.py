"""Limits of a ring gear, each with its margin, and the search for the nearest ring that works."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from geometry.errors import ParameterError, at_least, at_most
from geometry.findings import Finding
from geometry.gears.cutter import PinionCutter
from geometry.gears.limits import LEAST_TIP_THICKNESS, Margin
from geometry.gears.ring import RingGear, RoundedRoot
from geometry.gears.ring_made import LEAST_CUTTER_TEETH, check_made, generation, makes, settled_ring
from geometry.gears.ring_tooth import RingCurves, apex_radius, flank_ends, ring_side


def tip_thickness(gear: RingGear) -> float:
    """s_a2: thickness of the ring's tooth on its tip circle before its corners are broken, mm (an arc)."""
    return gear.tip_radius * (gear.pitch_angle + 2 * float(gear.flank().polar_angle_at_radius(gear.tip_radius)))


def thin_tip(gear: RingGear) -> Margin:
    """s_a2 against 0.3 m, mm; practicum, below (1.3)."""
    value, limit = tip_thickness(gear), LEAST_TIP_THICKNESS * gear.module
    return Margin("thin_tip", value, limit, value - limit)


def pointed_tip(gear: RingGear) -> Margin:
    """Tip diameter against the diameter at which the ring's tooth is pointed, mm; 0 where it never is."""
    limit, value = 2 * apex_radius(RingCurves.of(gear).flank, gear.pitch_angle / 2), 2 * gear.tip_radius
    return Margin("pointed_tip", value, limit, value - limit)


def tip_above_base(gear: RingGear) -> Margin:
    """Tip diameter against the base diameter, mm: the involute ends there."""
    value, limit = 2 * gear.tip_radius, 2 * gear.base_radius
    return Margin("tip_above_base", value, limit, value - limit)


def rim(gear: RingGear) -> Margin:
    """Rim outside the root circle against one module, mm; without any there is no ring."""
    value = gear.outer_radius - gear.root_radius
    return Margin("thin_ring_rim", value, gear.module, value - gear.module)


def root_form_diameter(gear: RingGear) -> float:
    """d_Ff2: diameter at which the fillet begins, mm."""
    return 2 * flank_ends(ring_side(gear))[1]


def margins(gear: RingGear) -> tuple[Margin, ...]:
    """All limits of a ring; those of its cutting are named ``cutter_…``."""
    mesh = generation(gear)
    cut = () if mesh is None else tuple(replace(m, name=f"cutter_{m.name}") for m in mesh.margins())
    return (*cut, tip_above_base(gear), pointed_tip(gear), thin_tip(gear), rim(gear))


def findings(gear: RingGear) -> tuple[Finding, ...]:
    """Remarks on a ring that is legal but poor: thin tip, thin rim."""
    return tuple(Finding(m.name, m.value, m.limit) for m in (thin_tip(gear), rim(gear)) if m.margin < 0)


def checked_ring(gear: RingGear) -> RingGear:
    """The ring itself if it can be made, else a refusal that names the nearest value that works.

    Raises
    ------
    ParameterError
        With the key, its value and the nearest value of that or another key that gives a ring.
    """
    _check_numbers(gear)
    try:
        check_made(gear)
    except ParameterError as refusal:
        raise _with_remedy(gear, refusal) from refusal
    check_rim(gear)
    return gear


def check_rim(gear: RingGear) -> None:
    """Refuse a rim without material, or holes in it that leave none."""
    _check_numbers(gear)
    least = 2 * gear.root_radius
    if gear.outer_diameter <= least:
        text = f"must be above the root diameter; at least {at_least(least + gear.module, 4)} mm leaves a rim"
        raise ParameterError("outer_diameter", gear.outer_diameter, text)
    gear.holes.check(math.inf)
    for wall, key, value, why in rim_walls(gear):
        if not wall > 0:
            raise ParameterError(key, value, why)


def rim_walls(gear: RingGear) -> list[tuple[float, str, float, str]]:
    """Material, mm, between each group of holes and the root circle, and the outside; key, value, reason where none."""
    walls = []
    groups = gear.holes.round_holes
    for index, group in enumerate(groups):
        key = "holes" if len(groups) == 1 else f"holes.item {index + 1}"
        size, radius = group.pitch_circle_diameter, group.diameter / 2
        blamed = f"{key}.pitch_circle_diameter"
        inside = f"the holes reach the root circle, {2 * gear.root_radius:.6g} mm"
        outside = f"the holes reach the outside of the rim, {gear.outer_diameter:.6g} mm"
        walls.append((size / 2 - radius - gear.root_radius, blamed, size, inside))
        walls.append((gear.outer_radius - size / 2 - radius, blamed, size, outside))
    return walls


def _check_numbers(gear: RingGear) -> None:
    """Refuse what is no dimension at all."""
    if not gear.number_of_teeth >= 4:
        raise ParameterError("number_of_teeth", gear.number_of_teeth, "must be at least 4")
    if not 0 < gear.module < math.inf:
        raise ParameterError("module", gear.module, "must be a finite number above 0")
    if not 0 < gear.pressure_angle < math.pi / 2:
        angle = math.degrees(gear.pressure_angle)
        raise ParameterError("pressure_angle_deg", angle, "must be above 0 and below 90 degrees")
    if not math.isfinite(gear.profile_shift_coefficient):
        raise ParameterError("profile_shift_coefficient", gear.profile_shift_coefficient, "must be a finite number")
    if gear.given_tip_diameter is not None and not 0 < gear.given_tip_diameter < math.inf:
        raise ParameterError("tip_diameter", gear.given_tip_diameter, "must be a finite number above 0")
    if not 0 < gear.outer_diameter < math.inf:
        raise ParameterError("outer_diameter", gear.outer_diameter, "must be a finite number above 0")
    for name in ("circumferential_thinning", "tip_chamfer", "tip_rounding"):
        if not 0 <= getattr(gear, name) < math.inf:
            raise ParameterError(name, getattr(gear, name), "must be a finite number, at least 0; 0 works")
    root = gear.root
    if isinstance(root, RoundedRoot):
        for key, value in (("dedendum", root.dedendum), ("radius", root.radius or 0.0)):
            if not 0 <= value < math.inf:
                raise ParameterError(f"rounded_root.{key}_coefficient", value, "must be a finite number, at least 0")


@dataclass(frozen=True, slots=True)
class _Key:
    """A key that may be to blame: its value, one that takes it out of play, and the ring with another value."""

    name: str
    value: float
    harmless: float
    gear_with: Callable[[float], RingGear]
    unit: str = " mm"


def _with_remedy(gear: RingGear, refusal: ParameterError) -> ParameterError:
    """The refusal told in the user's keys, with the nearest value that works; the most special key first."""
    kind = type(refusal)
    reason = refusal.allowed.partition("; at ")[0]
    teeth = _cutter_teeth(gear) if refusal.name == "cutter.number_of_teeth" else None
    if teeth is not None:
        return kind(refusal.name, refusal.value, f"{reason}; {teeth} works")

    def builds_with(key: _Key, value: float) -> bool:
        return makes(key.gear_with(value))

    for key in sorted(_suspects(gear), key=lambda k: k.name != refusal.name):
        if makes(key.gear_with(key.harmless)):
            works = _boundary(partial(builds_with, key), key.harmless, key.value)
            text = f"at most {at_most(works, 4)}" if works < key.value else f"at least {at_least(works, 4)}"
            return kind(key.name, key.value, f"{reason}; {text}{key.unit} works")
    x = gear.profile_shift_coefficient
    nearest = _nearest(lambda v: makes(replace(gear, profile_shift_coefficient=v)), x)
    if nearest is not None:
        text = f"at least {at_least(nearest, 4)}" if nearest > x else f"at most {at_most(nearest, 4)}"
        return kind("profile_shift_coefficient", x, f"{reason}; {text} works")
    z = gear.number_of_teeth
    more = next((n for n in range(z + 1, z + 80) if makes(replace(gear, number_of_teeth=n))), None)
    if more is None:
        return refusal
    return ParameterError("number_of_teeth", z, f"{refusal.name}: {reason}; {more} teeth work")


def _suspects(gear: RingGear) -> list[_Key]:
    """Keys of a ring that could be changed alone, the most special first."""
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
    root = gear.root
    if isinstance(root, PinionCutter) and not gear.any_cutter:
        names = ("tip_rounding", "profile_shift", "addendum")
        fields = ("tip_rounding", "profile_shift_coefficient", "addendum")
        for name, field, harmless in zip(names, fields, (0.0, 0.0, 1.0), strict=True):
            keys.append(
                _Key(
                    f"cutter.{name}_coefficient",
                    getattr(root, field),
                    harmless,
                    lambda v, n=field: replace(gear, root=replace(root, **{n: v})),  # type: ignore[misc]
                    "",
                )
            )
    elif isinstance(root, RoundedRoot) and root.radius is not None:
        keys.append(
            _Key(
                "rounded_root.radius_coefficient",
                root.radius,
                0.0,
                lambda v: replace(gear, root=replace(root, radius=v)),
                "",
            )
        )
    if isinstance(root, RoundedRoot):
        keys.append(
            _Key(
                "rounded_root.dedendum_coefficient",
                root.dedendum,
                1.0,
                lambda v: replace(gear, root=replace(root, dedendum=v)),
                "",
            )
        )
    # the reference circle always leaves an involute; what is between is found by the search for the boundary
    given = 2 * gear.tip_radius
    keys.append(_Key("tip_diameter", given, _harmless_tip(gear), lambda v: replace(gear, given_tip_diameter=v)))
    keys.append(_Key("pressure_angle_deg", math.degrees(gear.pressure_angle), 20.0, _at_angle(gear), " degrees"))
    return [k for k in keys if k.value != k.harmless]


def _at_angle(gear: RingGear) -> Callable[[float], RingGear]:
    """The ring, and its cutter, with another pressure angle in degrees."""

    def made(degrees: float) -> RingGear:
        angle, root = math.radians(degrees), gear.root
        root = replace(root, pressure_angle=angle) if isinstance(root, PinionCutter) else root
        return replace(gear, pressure_angle=angle, root=root)

    return made


def _harmless_tip(gear: RingGear) -> float:
    """A tip diameter between the refused one and the root that works, where there is one; else the reference circle."""
    least = max(2 * gear.tip_radius, 0.0)
    step = (2 * gear.reference_radius + 2 * gear.module - least) / 64
    tries = (least + k * step for k in range(1, 65))
    default = settled_ring(replace(gear, given_tip_diameter=None))
    if gear.given_tip_diameter is not None and makes(default):
        return 2 * default.tip_radius
    return next((d for d in tries if makes(replace(gear, given_tip_diameter=d))), 2 * gear.reference_radius)


def _cutter_teeth(gear: RingGear) -> int | None:
    """The number of cutter teeth nearest to the ring's own cutter that works."""
    root = gear.root
    if not isinstance(root, PinionCutter) or gear.any_cutter:
        return None
    z = root.number_of_teeth
    near = sorted(range(LEAST_CUTTER_TEETH, gear.number_of_teeth), key=lambda n: (abs(n - z), n))
    return next((n for n in near if makes(replace(gear, root=replace(root, number_of_teeth=n)))), None)


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
