"""Limits of a ring gear, each with its margin, and the search for the nearest ring that works."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from geometry.base.errors import LateError, Nearest, ParameterError
from geometry.base.findings import Finding, short_of
from geometry.base.nearest import Suspect, blamed, nearest
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import ISO_53_ANGLE
from geometry.gears.teeth.cutter import CUTTER_TOOTH, PinionCutter
from geometry.gears.teeth.limits import (
    LEAST_TIP_THICKNESS,
    Margin,
    building,
    check_dimensions,
    corner_suspects,
    in_normal_modules,
    more_teeth,
    refused_as,
    told_of_shift,
)
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_made import DEFAULT_CUTTER_TEETH, check_made, generation, makes, settled_ring
from geometry.gears.teeth.ring_tooth import RingCurves, apex_radius, ring_side
from geometry.gears.teeth.transverse_ring import transverse_ring
from geometry.solids.hub_holes import Wall

# mm of rim that a refused outside is offered: any rim will do
_LEAST_RIM = 1e-3


def tip_thickness(gear: RingGear) -> float:
    """s_a2: thickness of the ring's tooth on its tip circle before its corners are broken, mm (an arc)."""
    return gear.tip_radius * (gear.pitch_angle + 2 * gear.flank().polar_angle_at_radius(gear.tip_radius))


def thin_tip(gear: RingGear) -> Margin:
    """s_a2 against 0.3 m, mm; practicum, below (1.3)."""
    return Margin.above("thin_tip", tip_thickness(gear), LEAST_TIP_THICKNESS * gear.module)


def pointed_tip(gear: RingGear) -> Margin:
    """Tip diameter against the diameter at which the ring's tooth is pointed, mm; 0 where it never is."""
    apex = apex_radius(RingCurves.of(gear).flank, gear.pitch_angle / 2)
    return Margin.above("pointed_tip", 2 * gear.tip_radius, 2 * apex)


def tip_above_base(gear: RingGear) -> Margin:
    """Tip diameter against the base diameter, mm: the involute ends there."""
    return Margin.above("tip_above_base", 2 * gear.tip_radius, 2 * gear.base_radius)


def rim(gear: RingGear) -> Margin:
    """Rim outside the root circle against one module, mm; without any there is no ring."""
    return Margin.above("thin_ring_rim", gear.outer_radius - gear.root_radius, gear.module)


def root_form_diameter(gear: RingGear) -> float:
    """d_Ff2: diameter at which the fillet begins, mm."""
    return 2 * ring_side(gear).flank_radii()[0]


def margins(gear: RingGear) -> tuple[Margin, ...]:
    """All limits of a ring; those of its cutting are named ``cutter_…``."""
    mesh = generation(gear)
    cut = () if mesh is None else tuple(replace(m, name=f"cutter_{m.name}") for m in mesh.margins())
    return (*cut, tip_above_base(gear), pointed_tip(gear), thin_tip(gear), rim(gear))


def findings(gear: RingGear) -> tuple[Finding, ...]:
    """Remarks on a ring that is legal but poor: thin tip, thin rim."""
    return tuple(found for m in (thin_tip(gear), rim(gear)) for found in short_of(m.name, m.value, m.limit))


def checked_ring(gear: RingGear, normal: RingGear | None = None, helix_angle: float = 0.0) -> RingGear:
    """The ring itself if it can be made, else a refusal that names a parameter which alone cures it.

    ``normal``: the ring as it was given, which the refusals name, where ``gear`` is its settled transverse section;
    ``helix_angle`` in rad.

    Raises
    ------
    ParameterError
        It cannot be made: the parameter that cures it alone, its value, why, and the nearest value that works.
    """
    _check_numbers(gear)
    try:
        check_made(gear)
    except ParameterError as refusal:
        raise LateError(refusal.code, partial(_blamed, normal or gear, helix_angle, refusal)) from refusal
    if gear.sector is not None:
        from geometry.gears.teeth.sector_rim import check_sector

        check_sector(gear)
    check_rim(gear)
    return gear


def check_rim(gear: RingGear) -> None:
    """Refuse a rim without material, or holes in it that leave none."""
    _check_numbers(gear)
    least = 2 * gear.core_radius
    if gear.outer_diameter <= least:
        raise ParameterError.beyond("outer_diameter", gear.outer_diameter, "leaves_no_rim", least + _LEAST_RIM)
    gear.holes.check(math.inf)
    for wall in rim_walls(gear):
        if not wall.thickness > 0:
            raise wall.refusal()


def rim_walls(gear: RingGear) -> list[Wall]:
    """Material between each group of holes and the root circle, and the outside."""
    walls = []
    for key, group in gear.holes.groups():
        size, radius = group.pitch_circle_diameter, group.diameter / 2
        blamed_size = f"{key}.pitch_circle_diameter", size
        inner, outer = size / 2 - radius - gear.core_radius, gear.outer_radius - size / 2 - radius
        walls.append(Wall(inner, *blamed_size, "holes_reach_root_circle", {"diameter": 2 * gear.core_radius}))
        walls.append(Wall(outer, *blamed_size, "holes_reach_outside", {"diameter": gear.outer_diameter}))
    return walls


def _check_numbers(gear: RingGear) -> None:
    """Refuse what is no dimension at all."""
    if not gear.number_of_teeth >= 4:
        raise ParameterError("number_of_teeth", gear.number_of_teeth, "too_few", Nearest(4, "at_least"))
    if not 0 < gear.pressure_angle < math.pi / 2:
        raise ParameterError("pressure_angle", gear.pressure_angle, "not_below_right_angle")
    if not math.isfinite(gear.profile_shift_coefficient):
        raise ParameterError("profile_shift_coefficient", gear.profile_shift_coefficient, "not_finite", Nearest(0.0))
    check_dimensions(
        gear,
        ("module", "given_tip_diameter", "outer_diameter"),
        ("circumferential_thinning", "tip_chamfer", "tip_rounding"),
    )
    root = gear.root
    if isinstance(root, RoundedRoot):
        for key, value in (("dedendum", root.dedendum), ("radius", root.radius or 0.0)):
            if not 0 <= value < math.inf:
                raise ParameterError(f"root.{key}", value, "not_finite_or_negative")


def _blamed(gear: RingGear, helix_angle: float, refusal: ParameterError) -> ParameterError:
    """The refusal told of the parameter that can cure it alone: the most special one, then the shift, then teeth."""

    def builds(changed: RingGear) -> bool:
        return makes(transverse_ring(changed, helix_angle))

    if refusal.name == "cutter.number_of_teeth" and (teeth := _cutter_teeth(gear, builds)) is not None:
        return refusal.told_of(refusal.name, refusal.value, teeth)
    found = blamed(_suspects(gear, helix_angle, builds), refusal.name)
    if found is not None:
        return refused_as(refusal, found)
    root = gear.root
    if refusal.name in CUTTER_TOOTH and isinstance(root, PinionCutter) and (teeth := _cutter_teeth(gear, builds)):
        return ParameterError("cutter.number_of_teeth", root.number_of_teeth, refusal.code, teeth, **refusal.numbers)
    if (of_shift := told_of_shift(gear, builds, refusal)) is not None:
        return of_shift
    z = gear.number_of_teeth
    if (more := more_teeth(z, building(gear, builds, "number_of_teeth"))) is None:
        return in_normal_modules(refusal, helix_angle)
    return ParameterError("number_of_teeth", z, refusal.code, more, **refusal.numbers)


def _suspects(gear: RingGear, helix_angle: float, builds: Callable[[RingGear], bool]) -> list[Suspect]:
    """Parameters of a ring that could be changed alone, the most special first."""
    suspects, root = corner_suspects(gear, builds), gear.root

    own: list[tuple[str, str, float]] = []
    if isinstance(root, RoundedRoot):
        own = [("root.dedendum", "dedendum", 1.0)]
        if root.radius is not None:
            own.insert(0, ("root.radius", "radius", 0.0))
    elif not gear.any_cutter:
        fields = (("tip_rounding", 0.0), ("profile_shift_coefficient", 0.0), ("addendum", 1.0))
        own = [(f"cutter.{field}", field, harmless) for field, harmless in fields]
    suspects += [
        Suspect(name, getattr(root, f), harmless, building(gear, builds, f"root.{f}")) for name, f, harmless in own
    ]
    with_tip = building(gear, builds, "given_tip_diameter")

    def with_angle(angle: float) -> bool:
        made = root if isinstance(root, RoundedRoot) else replace(root, pressure_angle=angle)
        return builds(replace(gear, pressure_angle=angle, root=made))

    # the reference circle always leaves an involute; what is between is found by the search for the boundary
    section = settled_ring(transverse_ring(gear, helix_angle))
    suspects.append(Suspect("tip_diameter", 2 * section.tip_radius, _harmless_tip(section), with_tip))
    suspects.append(Suspect("pressure_angle", gear.pressure_angle, ISO_53_ANGLE, with_angle, digits=7))
    return suspects


def _harmless_tip(section: RingGear) -> float:
    """A tip diameter between the refused one and the root that works, where there is one; else the reference circle."""
    least = max(2 * section.tip_radius, 0.0)
    step = (2 * section.reference_radius + 2 * section.module - least) / 64
    tries = (least + k * step for k in range(1, 65))
    default = settled_ring(replace(section, given_tip_diameter=None))
    if section.given_tip_diameter is not None and makes(default):
        return 2 * default.tip_radius
    works = (d for d in tries if makes(replace(section, given_tip_diameter=d)))
    return next(works, 2 * section.reference_radius)


def _cutter_teeth(gear: RingGear, builds: Callable[[RingGear], bool]) -> Nearest | None:
    """The number of cutter teeth nearest to the ring's own cutter that works."""
    root = gear.root
    if not isinstance(root, PinionCutter) or gear.any_cutter:
        return None
    z, most = root.number_of_teeth, gear.number_of_teeth - 1
    usual = sorted((n for n in (*DEFAULT_CUTTER_TEETH, most) if n <= most), key=lambda n: abs(n - z))
    return nearest(lambda n: builds(replace(gear, root=replace(root, number_of_teeth=int(n)))), z, usual)
