"""Teeth on a closed convex centrode: the exact outline that a rack cuts whose pitch line rolls on it.

All teeth differ; those of one lobe are computed at once. Gear frame: axis at the origin, centrode angle 0 on +x, tooth
k at the arc length (k + first_tooth) pitches. A lower tooth side faces smaller arc lengths.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple

import numpy as np

from geometry.base.errors import ParameterError, PointedTipError, UndercutError
from geometry.base.record import Record, field, replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Complex, Curve, Real
from geometry.gears.noncircular.curves import RolledFillet, RolledFlank, RolledLand
from geometry.gears.noncircular.pairing import Pairing
from geometry.gears.noncircular.pitch_line import PitchLine
from geometry.gears.noncircular.undercut import Flanks, flank_starts
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.sector import centred
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles

_SHAPE_SAMPLES = 1025
_STEPS = 60


class NoncircularGear(Record, dict=True):
    """A gear on a closed centrode, its rack and the shift of the rack's datum line.

    ``first_tooth`` in pitches from the centrode's angle 0; ``circumferential_thinning`` is an arc of the centrode, mm,
    cut by a wider rack tooth. ``pairing``: the pair that it belongs to.
    """

    line: PitchLine
    number_of_teeth: int
    rack: BasicRack
    first_tooth: float = 0.0
    profile_shift_coefficient: float = 0.0
    circumferential_thinning: float = 0.0
    bore_diameter: float = 0.0
    hub: HubHoles = field(default_factory=HubHoles)
    pairing: Pairing | None = None

    @property
    def pitch(self) -> float:
        """p: the perimeter over the number of teeth, mm."""
        return self.line.length / self.number_of_teeth

    @property
    def module(self) -> float:
        """m = p / pi, mm."""
        return self.pitch / math.pi

    @property
    def count(self) -> int:
        """Periods of the outline in one turn: lobes that have teeth alike."""
        return math.gcd(self.line.lobes, self.number_of_teeth)

    @property
    def tip_height(self) -> float:
        """Of the tips over the centrode, mm."""
        return (self.rack.addendum + self.profile_shift_coefficient) * self.module

    @property
    def root_depth(self) -> float:
        """Of the roots below the centrode, mm."""
        return (self.rack.dedendum - self.profile_shift_coefficient) * self.module

    @cached_property
    def radii(self) -> tuple[float, float]:
        """Least and greatest radius of the centrode, mm."""
        return _extremes(lambda s: np.abs(self.line.frame(s)[0]), self.line.length)

    @cached_property
    def curvatures(self) -> tuple[float, float]:
        """Least and greatest curvature of the centrode, 1/mm."""
        return _extremes(self.line.curvature, self.line.length)

    @property
    def root_radius(self) -> float:
        """Of the largest circle about the axis within all roots, mm: a convex centrode's parallel is nearest there."""
        return self.radii[0] - self.root_depth

    @property
    def tip_radius(self) -> float:
        """Of the circle about the axis around all tips, mm."""
        return self.radii[1] + self.tip_height

    @cached_property
    def holes(self) -> HubHoles:
        """All holes; ``bore_diameter`` above 0 is the short form of a round bore in ``hub``."""
        return replace(self.hub, bore=RoundBore(self.bore_diameter)) if self.bore_diameter > 0 else self.hub

    @cached_property
    def outline(self) -> Outline:
        """The outline as cut."""
        return cut_outline(self)


class Sides(NamedTuple):
    """Tooth sides of one period, (2, teeth), lower ones first; arc lengths in mm, angles in rad.

    ``crossing`` of the rack's flanks with the pitch line, ``centre`` of its roundings; ``start`` and ``at_tip``: at
    which the rack touches a flank's ends; ``contact``: where the fillets end; ``land``: of the tip land's ends.
    """

    crossing: Real
    centre: Real
    start: Real
    at_tip: Real
    contact: Real
    land: Real


class Cut(NamedTuple):
    """A rack's cut: pressure angle (rad), depth and radius of its rounding, height of the tips over the centrode, mm;
    half of its flat tip."""

    alpha: float
    depth: float
    radius: float
    tip: float
    flat: float


class Outline(NamedTuple):
    """One period: segments of tooth after tooth, six of each (fewer without root lands); what was found on the way.

    ``first``: number of its first tooth; ``owners``: index of the tooth of each segment and its side, 0 the lower one
    with the tip, 1 the upper one with the root land after it. ``undercut`` sides; ``tip_thickness``: the least, mm.
    """

    segments: tuple[Segment, ...]
    owners: tuple[tuple[int, int], ...]
    first: int
    undercut: int
    tip_thickness: float
    sides: Sides
    cut: Cut

    def profile(self, count: int) -> Profile:
        """Closed and checked."""
        return Profile(self.segments, count)


def _extremes(function: Callable[[Real], Real], length: float) -> tuple[float, float]:
    """Least and greatest value of a smooth periodic function of the arc length: samples, refined by thirds."""
    s = np.linspace(0.0, length, _SHAPE_SAMPLES)
    values = function(s)
    found = []
    for sense in (1.0, -1.0):
        at = s[int(np.argmin(sense * values))]
        low, high = at - s[1], at + s[1]
        for _ in range(_STEPS):
            left, right = (2 * low + high) / 3, (low + 2 * high) / 3
            a, b = function(np.array([left, right]))
            low, high = (low, right) if sense * a < sense * b else (left, high)
        found.append(sense * min(sense * float(function(np.array([at]))[0]), sense * a, sense * b))
    return float(found[0]), float(found[1])


def cut_outline(gear: NoncircularGear, inset: float = 0.0) -> Outline:
    """One period of the outline, every boundary moved ``inset`` >= 0 mm into the material: a rack as much larger.

    Raises
    ------
    PointedTipError, UndercutError, ParameterError
        Some tooth cannot exist.
    """
    rack, m, p = gear.rack, gear.module, gear.pitch
    alpha = rack.pressure_angle
    teeth = gear.number_of_teeth // gear.count
    _check_rolling(gear, inset)
    widening = gear.circumferential_thinning / 2
    half = m * (math.pi / 4 - gear.profile_shift_coefficient * math.tan(alpha)) + widening + inset / math.cos(alpha)
    cut = Cut(
        alpha,
        (rack.rounding_depth - gear.profile_shift_coefficient) * m,
        rack.tip_radius * m + inset,
        gear.tip_height - inset,
        rack.rounding_half_distance * m + widening,
    )
    # evenly about the angle 0, so that mirror images fall into the period
    first = centred(teeth, 1 if gear.first_tooth == 0 else -1)
    middle = (np.arange(first, first + teeth) + gear.first_tooth) * p
    sign = np.repeat([1.0, -1.0], teeth)
    space = np.concatenate([middle - p / 2, middle + p / 2])
    crossing, centre = space + sign * half, space + sign * cut.flat
    at_tip, land = tip_places(gear.line, crossing, sign * alpha, cut.tip)
    thickness = land[teeth:] - land[:teeth]
    if not float(thickness.min()) > TOLERANCES.relative_length * m:
        raise PointedTipError(
            "number_of_teeth", gear.number_of_teeth, "teeth_of_lobe_pointed", number=int(np.sum(thickness <= 0))
        )
    flanks = Flanks(gear.line, crossing, sign, alpha, centre, cut.depth, cut.radius, at_tip)
    start, contact, undercut = flank_starts(flanks)
    both = (2, teeth)
    sides = Sides(*(x.reshape(both) for x in (crossing, centre, start, at_tip, contact, land)))
    segments, owners = _segments(gear, sides, cut, first)
    thinnest = _least_thickness(gear.line, land, cut.tip)
    return Outline(tuple(segments), tuple(owners), first, undercut, thinnest, sides, cut)


def _segments(gear: NoncircularGear, sides: Sides, cut: Cut, first: int) -> tuple[list[Segment], list[tuple[int, int]]]:
    """The curves of a period, tooth by tooth. What is a mirror image in the x axis is made as one."""
    line, teeth = gear.line, sides.crossing.shape[1]
    crossing, centre, start, at_tip, contact, land = sides
    turned = round(2 * gear.first_tooth)

    def image(k: int) -> int:
        """Index of the tooth's mirror image."""
        return -(k + first) - turned - first

    lower: list[list[Curve]] = []
    upper: list[list[Curve]] = []
    tips: list[Curve] = []
    roots: list[Curve] = []
    segments: list[Segment] = []
    owners: list[tuple[int, int]] = []
    for k in range(teeth):
        j = image(k) if line.mirrored else -1
        if 0 <= j < k:
            lower.append([c.mirrored() for c in reversed(upper[j])])
        else:
            lower.append([
                RolledFillet(line, centre[0, k], cut.depth, cut.radius, 0.0, contact[0, k]),
                RolledFlank(line, crossing[0, k], cut.alpha, start[0, k], at_tip[0, k]),
            ])  # fmt: skip
        if 0 <= j <= k:
            upper.append([c.mirrored() for c in reversed(lower[j])])
        else:
            upper.append([
                RolledFlank(line, crossing[1, k], -cut.alpha, at_tip[1, k], start[1, k]),
                RolledFillet(line, centre[1, k], cut.depth, cut.radius, contact[1, k], 0.0),
            ])  # fmt: skip
        tips.append(tips[j].mirrored() if 0 <= j < k else RolledLand(line, cut.tip, land[0, k], land[1, k]))
        made = [
            Segment(lower[k][0], Label.ROOT_FILLET),
            Segment(lower[k][1], Label.FLANK),
            Segment(tips[k], Label.TIP_LAND),
            Segment(upper[k][0], Label.FLANK),
            Segment(upper[k][1], Label.ROOT_FILLET),
        ]
        if cut.flat > TOLERANCES.relative_length * gear.module:
            # the space after a tooth is the image of that before its image
            j = image(k) - 1 if line.mirrored else -1
            root = RolledLand(line, -cut.depth - cut.radius, centre[1, k], centre[1, k] + 2 * cut.flat)
            roots.append(roots[j].mirrored() if 0 <= j < k else root)
            made.append(Segment(roots[k], Label.ROOT_LAND))
        # a sharp rack tip on a straight place of the centrode leaves a point
        least = TOLERANCES.relative_length * gear.module
        kept = [i for i, s in enumerate(made) if cut.radius > 0 or abs(_chord(s)) > least]
        segments += [made[i] for i in kept]
        owners += [(k, 0 if i < 3 else 1) for i in kept]
    return segments, owners


def _chord(segment: Segment) -> complex:
    ends = segment.curve.point(np.array(segment.curve.domain))
    return complex(ends[1] - ends[0])


def _least_thickness(line: PitchLine, land: Real, tip: float) -> float:
    """Least length of a tip land, mm: that of the centrode and the turning times the height."""
    teeth = len(land) // 2
    low, high = land[:teeth], land[teeth:]
    turned = np.angle(line.frame(high)[1] / line.frame(low)[1])
    return float(np.min(high - low + tip * turned))


def _check_rolling(gear: NoncircularGear, inset: float) -> None:
    """A rack's pitch line rolls on convex centrodes; its tips stay off the axis and its rounding leaves an arc."""
    least, greatest = gear.curvatures
    if least < -1e-9 * greatest:
        raise ParameterError("centrode", least, "centrode_concave")
    if not gear.root_radius > inset:
        raise ParameterError("number_of_teeth", gear.number_of_teeth, "root_reaches_axis")
    if gear.tip_height - inset <= -gear.root_depth:
        raise UndercutError("undercut", inset, "leaves_no_tooth")
    depth = (gear.rack.rounding_depth - gear.profile_shift_coefficient) * gear.module
    bend = 1 + greatest * depth / math.sin(gear.rack.pressure_angle) ** 2
    if depth < 0 and not bend > 0:
        raise ParameterError("profile_shift_coefficient", gear.profile_shift_coefficient, "rounding_leaves_no_fillet")


def tip_places(line: PitchLine, crossing: Real, angle: Real, height: float) -> tuple[Real, Real]:
    """Where flanks meet the parallel ``height`` mm outside the centrode: their own arc lengths, and those of its feet.

    The height of a flank's point over the centrode is 0 at its crossing s = x, and no less than that over the tangent,
    (s - x) sin(a) cos(a), which brackets it; both grow to the tip.
    """
    lean = np.cos(angle) * np.exp(1j * angle)
    reach = height / (np.sin(angle) * np.cos(angle))
    # below the centrode the tangent's height is a bound on the other side only
    near, far = (crossing + 0.0, crossing + reach) if height >= 0 else (crossing + 2 * reach, crossing + 0.0)
    # from the crossing, which is its own foot
    s, foot = crossing.copy(), crossing.copy()
    for _ in range(_STEPS):
        base, tangent, _ = line.frame(s)
        points = base + (crossing - s) * lean * tangent
        foot = _feet(line, points, foot)
        at, along, _ = line.frame(foot)
        over = (np.conj(-1j * along) * (points - at)).real - height
        far, near = np.where(over >= 0, s, far), np.where(over < 0, s, near)
        rate = (np.conj(-1j * along) * 1j * np.exp(1j * angle) * tangent).real
        kappa = line.curvature(s)
        speed = (crossing - s) * kappa * np.cos(angle) - np.sin(angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = s - over / (rate * speed)
        inside = (step - near) * (step - far) <= 0
        following = np.where(inside & np.isfinite(step), step, (near + far) / 2)
        if float(np.max(np.abs(following - s))) <= 1e-15 * line.length:
            break
        s = following
    base, tangent, _ = line.frame(s)
    return s, _feet(line, base + (crossing - s) * lean * tangent, foot)


def _feet(line: PitchLine, points: Complex, guess: Real) -> Real:
    """Arc lengths of the feet of perpendiculars from points outside or near a convex centrode, by Newton's method.

    Before its foot a point lies ahead of the tangent's point, after it behind: a bracket, bisected where Newton's steps
    leave it, as they do at the sharp ends of a slender ellipse.
    """
    s = guess
    # an eighth of the centrode on either side has no other foot
    low, high = guess - line.length / 8, guess + line.length / 8
    for _ in range(_STEPS):
        base, tangent, kappa = line.frame(s)
        gap = np.conj(tangent) * (points - base)
        low, high = np.where(gap.real > 0, s, low), np.where(gap.real < 0, s, high)
        # outside, 1 + kappa height > 0
        following = s + gap.real / np.maximum(1 - kappa * gap.imag, 0.1)
        following = np.where((following >= low) & (following <= high), following, (low + high) / 2)
        moved = float(np.max(np.abs(following - s)))
        s = following
        if moved <= 1e-15 * line.length:
            break
    return s
