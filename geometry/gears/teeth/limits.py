"""Limits of a spur gear, each a function with its margin, and the search for the nearest gear that works."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from geometry.base.errors import LateError, Nearest, ParameterError, UndercutError, limit
from geometry.base.findings import Finding, short_of
from geometry.base.nearest import Suspect, blamed, kept, nearest
from geometry.base.record import Record, replace, with_value
from geometry.base.tolerance import TOLERANCES, is_told
from geometry.curves.involute import Involute
from geometry.gears.teeth.basic_rack import ISO_53_ANGLE
from geometry.gears.teeth.joints import pointed_radius
from geometry.gears.teeth.shaping import check_shaping, least_shift_with_cutter
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.gears.teeth.transverse import transverse_gear

if TYPE_CHECKING:
    from geometry.gears.teeth.ring import RingGear

G = TypeVar("G", "SpurGear", "RingGear")

# practicum, condition below (1.3): S_a >= 0.3 m
LEAST_TIP_THICKNESS = 0.3
# contact ratio of a pair at least, by the same page
LEAST_CONTACT_RATIO = 1.1
# modules: shorter chamfers, roundings and thinnings are not offered
_LEAST_OFFERED = 1e-6


class Margin(Record):
    """How far a gear is from a limit; ``margin`` >= 0 where the limit is kept."""

    name: str
    value: float
    limit: float
    margin: float

    @classmethod
    def above(cls, name: str, value: float, limit: float) -> Margin:
        """Of a value that is to keep above a limit."""
        return cls(name, value, limit, value - limit)

    @classmethod
    def below(cls, name: str, value: float, limit: float) -> Margin:
        """Of a value that is to keep below a limit."""
        return cls(name, value, limit, limit - value)


def not_kept(margins: Iterable[Margin], size: float) -> tuple[Finding, ...]:
    """The limits that are not kept, as remarks; a margin within rounding of a size, mm, counts as kept."""
    rounding = 1e3 * TOLERANCES.relative_rounding * size
    return tuple(Finding(m.name, m.value, m.limit) for m in margins if m.margin < -rounding)


def least_shift_without_undercut(gear: SpurGear) -> float:
    """x_min = h_Ff - z sin^2(alpha) / 2: exact for a rack with a rounded tip; with a cutter see ``shaping``."""
    if gear.cutter is not None:
        return least_shift_with_cutter(gear)
    return gear.rack.form_dedendum - gear.number_of_teeth * math.sin(gear.pressure_angle) ** 2 / 2


def undercut(gear: SpurGear) -> Margin:
    """Undercut, exactly: the generating shift against x_min."""
    return Margin.above("undercut", gear.generating_shift_coefficient, least_shift_without_undercut(gear))


def rule_teeth(gear: SpurGear) -> int:
    """z_0 of the rule, 2 h_a / sin^2(alpha) rounded: 17 at 20 degrees and h_a = 1, 32 at 14.5 degrees."""
    return max(round(2 * gear.rack.addendum / math.sin(gear.pressure_angle) ** 2), 1)


def undercut_shifts(gear: SpurGear, helix_angle: float = 0.0) -> tuple[float, float] | None:
    """The shift of an undercut gear and the least one, in normal modules; None: the least, as it is told, is kept.

    ``helix_angle``: where ``gear`` is the transverse section of such teeth, rad.
    """
    margin, cosine = undercut(gear), math.cos(helix_angle)
    shift, least = margin.value / cosine, margin.limit / cosine
    return (shift, least) if margin.margin < 0 and not is_told(round(shift, 12), least) else None


def practicum_undercut(gear: SpurGear) -> Margin:
    """Undercut by the rule xi_min = h_a (z_0 - z) / z_0 of textbooks, (1.2) of the practicum."""
    least = gear.rack.addendum * (rule_teeth(gear) - gear.number_of_teeth) / rule_teeth(gear)
    return Margin.above("practicum_undercut", gear.profile_shift_coefficient, least)


def pointed_diameter(gear: SpurGear) -> float:
    """Diameter at which both flanks of a tooth meet, mm."""
    return 2 * min(map(pointed_radius, _flanks(gear)))


def _flanks(gear: SpurGear) -> list[Involute]:
    """The main flank, and the relieved one."""
    return [gear.flank()] if gear.rack.relief is None else [gear.flank(), gear.relief_flank()]


def pointed_tip(gear: SpurGear) -> Margin:
    """Tip diameter against the diameter at which the tooth is pointed, mm."""
    return Margin.below("pointed_tip", 2 * gear.tip_radius, pointed_diameter(gear))


def least_teeth_in_pair(ratio: float, addendum: float, pressure_angle: float) -> float:
    """Teeth of the smaller gear below which the greater one's tip passes where its line of action begins; no shifts.

    ``ratio`` >= 1; of helical gears the transverse angle and the addendum in transverse modules (Shigley 13-11, 13-22).
    """
    sine = math.sin(pressure_angle) ** 2
    return 2 * addendum * (ratio + math.sqrt(ratio**2 + (1 + 2 * ratio) * sine)) / ((1 + 2 * ratio) * sine)


def most_teeth_of_mate(number_of_teeth: int, addendum: float, pressure_angle: float) -> float | None:
    """Teeth of the greatest mate of a gear by that limit; None: even a rack goes with it (Shigley 13-12, 13-23)."""
    sine = math.sin(pressure_angle) ** 2
    room = 2 * addendum - number_of_teeth * sine
    return (number_of_teeth**2 * sine - 4 * addendum**2) / (2 * room) if room > 0 else None


def tip_thickness(gear: SpurGear) -> float:
    """s_a: thickness of the tooth on the tip circle before its corners are broken, mm (an arc)."""
    angle = max(flank.polar_angle_at_radius(gear.tip_radius) for flank in _flanks(gear))
    return -2 * gear.tip_radius * angle


def thin_tip(gear: SpurGear) -> Margin:
    """s_a against 0.3 m, mm; practicum, below (1.3)."""
    return Margin.above("thin_tip", tip_thickness(gear), LEAST_TIP_THICKNESS * gear.module)


def thin_tips(gear: SpurGear) -> tuple[Finding, ...]:
    """The remark on a tip that is thinner."""
    tip = thin_tip(gear)
    return short_of(tip.name, tip.value, tip.limit)


def root_below_bore(gear: SpurGear) -> Margin:
    """Diameter that the bore reaches against the root diameter, mm."""
    return Margin.below("root_below_bore", 2 * gear.bore_radius, 2 * gear.root_radius)


def root_form_diameter(gear: SpurGear) -> float:
    """d_Ff: diameter at which the involute begins, mm."""
    return 2 * tooth_side(gear).flank_radii()[0]


def margins(gear: SpurGear) -> tuple[Margin, ...]:
    """All limits of a gear."""
    return undercut(gear), practicum_undercut(gear), pointed_tip(gear), thin_tip(gear), root_below_bore(gear)


def findings(gear: SpurGear, helix_angle: float = 0.0) -> tuple[Finding, ...]:
    """Remarks on a gear that is legal but poor: undercut, thin tip, tip circle above the rack's root.

    ``gear``: the transverse section where ``helix_angle`` is not 0, rad; shifts are told in normal modules then.
    """
    cut = undercut_shifts(gear, helix_angle)
    found = [] if cut is None else [Finding("undercut", *cut)]
    found += thin_tips(gear)
    if gear.bore_radius > 0:
        found += short_of("thin_rim", gear.root_radius - gear.bore_radius, gear.module)
    return tuple(found)


def checked_gear(gear: SpurGear, helix_angle: float = 0.0) -> SpurGear:
    """The gear if it can be built, else a refusal that names a parameter which alone cures it.

    ``gear``: in normal data, which the refusals name, where ``helix_angle`` is not 0, rad; returned is its transverse
    section then.

    Raises
    ------
    ParameterError
        The gear cannot be built: the parameter, its value, why, and the nearest value that works.
    """
    _check_numbers(gear)
    section = transverse_gear(gear, helix_angle)
    rim = root_below_bore(section)
    if section.root_radius > 0 and section.bore_diameter > 0 and rim.margin <= 0:
        most = limit(rim.limit * (1 - 1e-6), rim.value)
        raise ParameterError("bore_diameter", rim.value, "reaches_root_circle", most, diameter=rim.limit)
    try:
        check_shaping(section)
    except ParameterError as refusal:
        told = in_normal_modules(refusal, helix_angle)
        raise LateError(told.code, partial(_told_of_cutter, gear, helix_angle, told)) from refusal
    try:
        tooth_side(section)
    except ParameterError as refusal:
        raise LateError(refusal.code, partial(_blamed, gear, helix_angle, refusal)) from refusal
    section.holes.check(section.root_radius)
    if section.sector is not None:
        from geometry.gears.teeth.sector_rim import check_gear_sector

        check_gear_sector(section)
    return section


def exists(gear: SpurGear, helix_angle: float = 0.0) -> bool:
    """Whether ``checked_gear`` has nothing to say, without its search for what is to blame."""
    if not kept(_check_numbers, gear):
        return False
    section = transverse_gear(gear, helix_angle)
    return (gear.bore_diameter <= 0 or root_below_bore(section).margin > 0) and _builds(section)


def _builds(section: SpurGear) -> bool:
    makes = kept(check_shaping, section) and kept(tooth_side, section)
    return makes and section.holes.fits(section.root_radius)


def in_normal_modules(refusal: ParameterError, helix_angle: float) -> ParameterError:
    """A refusal of a transverse section's coefficient as one of the normal coefficient."""
    if helix_angle == 0 or refusal.name not in _COEFFICIENTS:
        return refusal
    return refusal.renamed(refusal.name, 1 / math.cos(helix_angle))


def check_dimensions(gear: object, positive: Iterable[str], least_zero: Iterable[str]) -> None:
    """Refuse fields that are no finite numbers above 0 (where given), or at least 0."""
    for name in positive:
        value = getattr(gear, name)
        if value is not None and not 0 < value < math.inf:
            raise ParameterError(_NAMES.get(name, name), value, "not_finite_above_zero")
    for name in least_zero:
        if not 0 <= getattr(gear, name) < math.inf:
            raise ParameterError(name, getattr(gear, name), "not_finite_or_negative", Nearest(0.0))


def _check_numbers(gear: SpurGear) -> None:
    """Refuse what is no dimension at all."""
    if not gear.number_of_teeth >= 1:
        raise ParameterError("number_of_teeth", gear.number_of_teeth, "too_few", Nearest(1, "at_least"))
    if not math.isfinite(gear.profile_shift_coefficient):
        raise ParameterError("profile_shift_coefficient", gear.profile_shift_coefficient, "not_finite", Nearest(0.0))
    check_dimensions(
        gear,
        ("module", "given_tip_diameter"),
        ("circumferential_thinning", "tip_chamfer", "tip_rounding", "bore_diameter"),
    )


# coefficients in modules, and fields that stand for a parameter
_COEFFICIENTS = frozenset(
    {"profile_shift_coefficient", "cutter.profile_shift_coefficient", "cutter.addendum", "cutter.tip_rounding"}
)
_NAMES = {"given_tip_diameter": "tip_diameter"}


def corner_suspects(gear: G, builds: Callable[[G], bool]) -> list[Suspect]:
    """Parameters of any toothed part that may be to blame: broken tip corners and thinning.

    A length within rounding of 0 is none: where only such a chamfer reaches a flank, 0 is offered.
    """
    least = _LEAST_OFFERED * gear.module

    def holds(name: str, value: float) -> bool:
        return (value == 0 or value >= least) and builds(with_value(gear, name, value))

    names = ("tip_chamfer", "tip_rounding", "circumferential_thinning")
    return [Suspect(name, getattr(gear, name), 0.0, partial(holds, name)) for name in names]


def building(gear: G, builds: Callable[[G], bool], path: str) -> Callable[[float], bool]:
    """Whether a toothed part can be built with another value of the field at a path, by that value."""
    return lambda value: builds(with_value(gear, path, value))


def told_of_shift(gear: G, builds: Callable[[G], bool], refusal: ParameterError) -> ParameterError | None:
    """A refusal told of the shift, where one from -3 to 3 in steps of 0.05 works: the nearest to the refused one."""
    name, given = "profile_shift_coefficient", gear.profile_shift_coefficient
    works = building(gear, builds, name)
    grid = sorted((k / 20 for k in range(-60, 61)), key=lambda v: abs(v - given))
    found = next((v for v in grid if works(v)), None)
    return None if found is None else refused_as(refusal, Suspect(name, given, found, works))


def more_teeth(given: int, works: Callable[[int], bool]) -> Nearest | None:
    """The number of teeth above a refused one that works."""
    found = next((n for n in range(given + 1, given + 80) if works(n)), None)
    return None if found is None else Nearest(found, "at_least")


def refused_as(refusal: ParameterError, suspect: Suspect) -> ParameterError:
    """A refusal told of the suspect that can cure it, with the value that does."""
    cure = partial(nearest, suspect.works, suspect.value, suspect.harmless, digits=suspect.digits)
    return refusal.told_of(suspect.name, suspect.value, cure)


def _blamed(gear: SpurGear, helix_angle: float, refusal: ParameterError) -> ParameterError:
    """The refusal told of the parameter that can cure it alone: the most special one, then shift, tip and teeth."""

    def builds(changed: SpurGear) -> bool:
        return _builds(transverse_gear(changed, helix_angle))

    found = blamed(_suspects(gear, helix_angle, builds), refusal.name)
    if found is not None:
        return refused_as(refusal, found)
    if (of_shift := told_of_shift(gear, builds, refusal)) is not None:
        return of_shift
    with_tip = building(gear, builds, "given_tip_diameter")
    diameter = 2 * transverse_gear(gear, helix_angle).tip_radius
    lower = next((d for k in range(1, 160) if with_tip(d := diameter * (1 - k / 200))), None)
    if lower is not None:
        return refused_as(refusal, Suspect("tip_diameter", diameter, lower, with_tip))
    z = gear.number_of_teeth
    teeth = more_teeth(z, building(gear, builds, "number_of_teeth"))
    return UndercutError("number_of_teeth", z, refusal.code, teeth, **refusal.numbers)


def _told_of_cutter(gear: SpurGear, helix_angle: float, refusal: ParameterError) -> ParameterError:
    """The refusal of a cutter's tooth; where its own cure leaves another fault, told of the cutter's teeth."""
    from geometry.gears.teeth.cutter import CUTTER_ADDENDUM, CUTTER_TOOTH

    cutter, own = gear.cutter, refusal.nearest
    if cutter is None or refusal.name not in CUTTER_TOOTH:
        return refusal

    def works(path: str, value: object) -> bool:
        return _builds(transverse_gear(with_value(gear, path, value), helix_angle))

    def works_at(angle: float) -> bool:
        cut = with_value(gear, "cutter.pressure_angle", angle)
        return _builds(transverse_gear(with_value(cut, "rack.pressure_angle", angle), helix_angle))

    angle = Suspect("pressure_angle", gear.pressure_angle, ISO_53_ANGLE, works_at, digits=7)
    if cutter.addendum == CUTTER_ADDENDUM and angle.value > angle.harmless and blamed([angle], angle.name):
        # the usual height is not to blame
        return refused_as(refusal, angle)
    if own is not None and works(refusal.name, own.value):
        return refusal
    name, z = "cutter.number_of_teeth", cutter.number_of_teeth
    more = more_teeth(z, partial(works, name))
    return refusal if more is None else ParameterError(name, z, refusal.code, more, **refusal.numbers)


def _suspects(gear: SpurGear, helix_angle: float, builds: Callable[[SpurGear], bool]) -> list[Suspect]:
    """Parameters of a gear that could be changed alone, the most special first."""
    suspects = corner_suspects(gear, builds)
    if (relief := gear.rack.relief) is not None:
        depth, height = (building(gear, builds, f"rack.relief.{name}") for name in ("depth", "height"))
        suspects.append(Suspect("relief.depth", relief.depth, 0.0, depth))
        suspects.append(Suspect("relief.height", relief.height, 1e-6, height))
    given = 2 * transverse_gear(gear, helix_angle).tip_radius
    default = 2 * transverse_gear(replace(gear, given_tip_diameter=None), helix_angle).tip_radius
    suspects.append(Suspect("tip_diameter", given, default, building(gear, builds, "given_tip_diameter")))
    return suspects
