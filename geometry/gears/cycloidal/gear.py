"""A cycloidal gear, as clocks have it: flanks drawn by a circle that rolls outside and one that rolls inside.

Above the pitch circle a flank is the epicycloid of a point on a circle that rolls outside of it, below the hypocycloid
of one on a circle that rolls inside (Litvin, Fuentes, Gear Geometry and Applied Theory, chapter 13; A. L. Rawlings,
The Science of Clocks and Watches). The circle that draws the tips of one gear draws the roots of its mate: both flanks
touch where that circle, rolling on both pitch circles, carries its point. A circle of half the pitch diameter draws a
radius, the straight root flank of clockwork. At the pitch circle both curves begin in a cusp, where their curvature
has no bound: a parallel of the flank there is the crossing of both parallels.

Frame: tooth 1 is centred on +x.
"""

from __future__ import annotations

import cmath
import math
from functools import lru_cache, partial

from geometry.base.errors import (
    CuspError,
    OffsetError,
    ParameterError,
    PointedTipError,
    limit,
)
from geometry.base.findings import Finding, beyond, short_of
from geometry.base.nearest import kept, nearest
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.cycloid import CycloidParallel
from geometry.curves.intersect import crossing_circle
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.gears.teeth.moved_segments import corner_arc
from geometry.gears.teeth.round_teeth import RoundTeeth
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.profile import Label, Segment
from geometry.solids.hub_holes import HubHoles

_NO_HOLES = HubHoles()
# what is kept from every limit, as a part of it
_MARGIN = 1e-6
# of the module: roots that every gear has room for
_SHALLOW = 1e-3
# of the pitch circle: a circle that rolls outside and is larger has no digits left for the flank
_MOST_CIRCLE = 500.0
# of the module: rounding of the roots where they have room for it; a tip land and a rim below which a tooth is poor
_ROUNDING, _THIN_TIP, _THIN_RIM = 0.2, 0.3, 1.0


class CycloidalGear(RoundTeeth):
    """A gear of ``number_of_teeth``; lengths in mm, heights in modules.

    ``tip_rolling_radius``: of the circle that rolls outside and draws the flanks of the tips, ``root_rolling_radius``:
    of the one that rolls inside, at most half the pitch radius. ``given_root_rounding`` None: the least of a fifth of
    the module, half the depth of the roots and the full round of the space.
    """

    module: float
    tip_rolling_radius: float
    root_rolling_radius: float
    addendum_coefficient: float = 1.0
    dedendum_coefficient: float = 1.25
    circumferential_thinning: float = 0.0
    given_root_rounding: float | None = None
    holes: HubHoles = _NO_HOLES

    @property
    def pitch_radius(self) -> float:
        """r = m z / 2, mm."""
        return self.module * self.number_of_teeth / 2

    @property
    def pitch(self) -> float:
        """p = pi m: arc from tooth to tooth on the pitch circle, mm."""
        return math.pi * self.module

    @property
    def tooth_thickness(self) -> float:
        """s: arc of the pitch circle within a tooth, mm."""
        return self.pitch / 2 - self.circumferential_thinning

    @property
    def tip_radius(self) -> float:
        """r_a, mm."""
        return self.pitch_radius + self.addendum_coefficient * self.module

    @property
    def root_radius(self) -> float:
        """r_f, mm."""
        return self.pitch_radius - self.dedendum_coefficient * self.module

    @property
    def begins(self) -> float:
        """Polar angle of the lower flank of tooth 1 on the pitch circle, rad."""
        return -self.tooth_thickness / (2 * self.pitch_radius)

    def tip_flank(self, inset: float = 0.0) -> CycloidParallel:
        """The epicycloid of the lower flank over half a turn of its circle, moved ``inset`` mm into the tooth."""
        ratio = self.pitch_radius / self.tip_rolling_radius
        return CycloidParallel(self.tip_rolling_radius, 1 + ratio, inset, self.begins, 0.0, math.pi / ratio)

    def root_flank(self, inset: float = 0.0) -> CycloidParallel:
        """The hypocycloid below the pitch circle over half a turn, from within outwards, moved ``inset`` mm in."""
        ratio = self.pitch_radius / self.root_rolling_radius
        return CycloidParallel(-self.root_rolling_radius, 1 - ratio, inset, self.begins, -math.pi / ratio, 0.0)

    @property
    def pointed_radius(self) -> float:
        """Where both flanks of a tooth meet, or end where they do not, mm."""
        return _apex(self.tip_flank())[1]

    @property
    def tip_roll(self) -> float:
        """u: how far the gear turns while the contact runs from the pitch point to the tip, rad."""
        return crossing_circle(self.tip_flank(), self.tip_radius).value

    @property
    def tip_thickness(self) -> float:
        """Width of the tip land, mm (arc)."""
        return -2 * self.tip_radius * cmath.phase(complex(self.tip_flank().point(self.tip_roll)))

    @property
    def greatest_rounding(self) -> float:
        """Radius of the full round between two teeth, mm; 0 where the spaces have no bottom."""
        return _full_round(self)

    @property
    def root_rounding(self) -> float:
        """Radius of the fillet at the root, mm."""
        if self.given_root_rounding is not None:
            return self.given_root_rounding
        # the greatest one may leave nothing of a shallow root's flank
        return min(_ROUNDING * self.module, self.dedendum_coefficient * self.module / 2, self.greatest_rounding)

    @property
    def fillet_roll(self) -> float:
        """u where the root flank begins beyond the fillet, rad, below 0."""
        return _fillet(self, 0.0).touches

    @property
    def form_radius(self) -> float:
        """Where that is, mm."""
        return abs(complex(self.root_flank().point(self.fillet_roll)))


class _Fillet(Record):
    """The rounding of a root: centre, radius (0: a corner), and the parameter of the root flank where it ends."""

    centre: complex
    radius: float
    touches: float


def _apex(flank: CycloidParallel) -> tuple[float, float]:
    """Parameter and radius where a tip flank meets its mirror image, or its end."""

    def from_middle(u: float) -> float:
        """Polar angle from the middle of the tooth: what the line of centres has turned, less what lags behind."""
        turned = flank.angle + u
        return turned + cmath.phase(complex(flank.point(u)) * cmath.rect(1.0, -turned))

    if from_middle(flank.end) <= 0:
        return flank.end, abs(end_point(flank))
    found = bracketed_root(from_middle, flank.start, flank.end).value
    return found, abs(complex(flank.point(found)))


def _centre_of_fillet(gear: CycloidalGear, radius: float) -> tuple[float, complex] | None:
    """Parameter of the root flank beside which the fillet's centre lies, and that centre; None: it has no room."""
    beside = gear.root_flank(-radius)
    try:
        last = beside.cusp()
    except CuspError:
        return None
    low, high, level = beside.start, last, gear.root_radius + radius
    if not abs(complex(beside.point(low))) < level < abs(complex(beside.point(high))):
        return None
    at = bracketed_root(lambda u: abs(complex(beside.point(u))) - level, low, high).value
    centre = complex(beside.point(at))
    # the flank bends ever more towards the pitch circle: what a circle cuts first is its end there
    if abs(centre - end_point(gear.root_flank())) < radius:
        return None
    return at, centre


@lru_cache(maxsize=64)
def _full_round(gear: CycloidalGear) -> float:
    def room(radius: float) -> float:
        """Angle from the space's middle to the fillet's centre."""
        found = _centre_of_fillet(gear, radius)
        return -1.0 if found is None else cmath.phase(found[1]) + gear.pitch_angle / 2

    if not gear.root_radius > 0 or not room(0.0) > 0:
        return 0.0
    # a circle between two teeth is smaller than the space on the pitch circle
    most = gear.pitch - gear.tooth_thickness
    return bracketed_root(room, 0.0, most).value if room(most) < 0 else most


def _fillet(gear: CycloidalGear, offset: float) -> _Fillet:
    """The fillet after the outline has moved ``offset`` mm out: about the same centre while any of it is left."""
    rounding = gear.root_rounding
    if rounding >= offset:
        found = _centre_of_fillet(gear, rounding)
        if found is None:
            raise OffsetError(offset, "closes_tooth_spaces")
        return _Fillet(found[1], rounding - offset, found[0])
    flank, root = gear.root_flank(-offset), gear.root_radius + offset
    low, high = flank.start, flank.cusp()
    if not abs(complex(flank.point(low))) < root < abs(complex(flank.point(high))):
        raise OffsetError(offset, "closes_tooth_spaces")
    at = bracketed_root(lambda u: abs(complex(flank.point(u))) - root, low, high).value
    return _Fillet(complex(flank.point(at)), 0.0, at)


def _at_pitch_circle(low: CycloidParallel, high: CycloidParallel) -> tuple[float, float]:
    """Where the root flank ends and the tip flank begins: at the cusp, or where their parallels cross.

    The parallel of one of them runs back from its end to a cusp of its own; beyond that it crosses the other one.
    """
    runs_back, other = (high, low) if high.cusp() > 0 else (low, high)
    cusp = runs_back.cusp()
    if cusp == 0:
        return 0.0, 0.0
    outwards = runs_back is low
    far, rest = (runs_back.start, other.end) if outwards else (runs_back.end, other.start)
    level = abs(complex(runs_back.point(0.0)))
    last = bracketed_root(lambda u: abs(complex(runs_back.point(u))) - level, cusp, far).value

    def beside(radius: float) -> float:
        """Parameter of the other one at a radius, its end where rounding passes that."""
        if (radius <= level) if outwards else (radius >= level):
            return 0.0
        return bracketed_root(lambda u: abs(complex(other.point(u))) - radius, rest, 0.0).value

    def between(u: float) -> float:
        point = complex(runs_back.point(u))
        return cmath.phase(point / complex(other.point(beside(abs(point)))))

    here = bracketed_root(between, cusp, last).value
    there = beside(abs(complex(runs_back.point(here))))
    return (here, there) if outwards else (there, here)


def _straight(flank: CycloidParallel) -> Curve:
    """A root flank, a line where its circle is half the pitch circle."""
    return Line(start_point(flank), end_point(flank)) if flank.order == -1 else flank


@lru_cache(maxsize=32)
def cycloidal_side(gear: CycloidalGear, offset: float = 0.0) -> ToothSide:
    """The lower side of tooth 1, moved ``offset`` mm out of the material.

    Raises
    ------
    GeometryError
        The offset leaves no tooth, or closes the spaces.
    """
    low, high = gear.root_flank(-offset), gear.tip_flank(-offset)
    fillet = _fillet(gear, offset)
    ends, begins = _at_pitch_circle(low, high)
    half, root = gear.pitch_angle / 2, gear.root_radius + offset
    if not fillet.touches < ends:
        raise OffsetError(offset, "closes_tooth_spaces" if offset > 0 else "leaves_no_tooth")
    least = TOLERANCES.relative_length * gear.tip_radius
    land = cmath.phase(fillet.centre) + half
    if land * root < -least:
        raise OffsetError(offset, "closes_tooth_spaces")
    segments: list[Segment] = []
    if land * root > least:
        segments.append(Segment(Arc(0j, root, -half, land), Label.ROOT_LAND))
    flank = low.trimmed(fillet.touches, ends)
    if fillet.radius > least:
        foot = fillet.centre * (1 - fillet.radius / abs(fillet.centre))
        arc = arc_between(fillet.centre, foot, start_point(flank), turns_left=False)
        segments.append(Segment(arc, Label.ROOT_FILLET))
    segments.append(Segment(_straight(flank), Label.FLANK))
    tip, findings = _tip(gear, high, begins, offset)
    trimmed = beyond("fillet_cusp_trimmed", offset, gear.root_rounding) if offset > 0 else ()
    return ToothSide((*segments, *tip), gear.pitch_angle, (*trimmed, *findings))


def _tip(
    gear: CycloidalGear, flank: CycloidParallel, begins: float, offset: float
) -> tuple[tuple[Segment, ...], tuple[Finding, ...]]:
    """The tip flank from a parameter on, the corner that grows round, and the tip land; a pointed one ends there."""
    if offset > 0:
        roll = gear.tip_roll
        if not roll > begins:
            raise OffsetError(offset, "leaves_no_flank")
        whole, corner = gear.tip_flank(), cmath.phase(complex(gear.tip_flank().point(roll)))
        top = Arc(0j, gear.tip_radius, corner, -corner)
        round_corner = corner_arc(whole.trimmed(begins, roll), top, offset)
        land = Segment(top.offset(-offset), Label.TIP_LAND)
        return (Segment(flank.trimmed(begins, roll), Label.FLANK), *round_corner, land), ()
    last, apex = _apex(flank)
    radius = gear.tip_radius + offset
    if radius >= apex:
        if not last > begins:
            raise OffsetError(offset, "leaves_no_tooth")
        return (Segment(flank.trimmed(begins, last), Label.FLANK),), (Finding("tip_lost", radius - apex, 0.0),)
    if not radius > abs(complex(flank.point(begins))):
        raise OffsetError(offset, "leaves_no_tooth")
    roll = bracketed_root(lambda u: abs(complex(flank.point(u))) - radius, begins, last).value
    angle = cmath.phase(complex(flank.point(roll)))
    land = Segment(Arc(0j, radius, angle, -angle), Label.TIP_LAND)
    return (Segment(flank.trimmed(begins, roll), Label.FLANK), land), ()


def checked_cycloidal_gear(gear: CycloidalGear) -> CycloidalGear:
    """The same gear, if its teeth exist.

    Raises
    ------
    ParameterError
        A circle that rolls inside and is too large, pointed tips, roots without room; names the key and what works.
    """
    _check_root(checked_tips(gear))
    return gear


def checked_tips(gear: CycloidalGear) -> CycloidalGear:
    """The same gear, if its circles roll and its tips stand: of a mate no more is asked.

    Raises
    ------
    ParameterError
        As ``checked_cycloidal_gear``, but for the roots.
    """
    if gear.tip_rolling_radius > (most := _MOST_CIRCLE * gear.pitch_radius):
        given = 2 * gear.tip_rolling_radius
        raise ParameterError.beyond("tip_rolling_diameter", given, "circle_all_but_straight", 2 * most, digits=6)
    most = gear.pitch_radius / 2
    if gear.root_rolling_radius > most * (1 + _MARGIN):
        raise ParameterError.beyond(
            "root_rolling_diameter", 2 * gear.root_rolling_radius, "root_flanks_undercut", 2 * most, digits=6
        )
    _check_tip(gear)
    return gear


def _check_tip(gear: CycloidalGear) -> None:
    """Teeth that thinning leaves nothing of, or that are pointed below their tips."""

    def stands(thinning: float) -> bool:
        thinned = replace(gear, circumferential_thinning=thinning)
        return thinned.tooth_thickness > 0 and gear.tip_radius < thinned.pointed_radius * (1 - _MARGIN)

    thinning = gear.circumferential_thinning
    if stands(thinning):
        return
    cure = partial(nearest, stands, thinning, 0.0, digits=6)
    if not gear.tooth_thickness > 0:
        raise ParameterError("circumferential_thinning", thinning, "leaves_no_tooth", cure)
    apex = gear.pointed_radius
    if stands(0.0):
        raise PointedTipError("circumferential_thinning", thinning, "tooth_pointed", cure, diameter=2 * apex)
    given, most = gear.addendum_coefficient, (apex * (1 - _MARGIN) - gear.pitch_radius) / gear.module
    raise PointedTipError.beyond("addendum_coefficient", given, "tooth_pointed", most, diameter=2 * apex)


def _check_root(gear: CycloidalGear) -> None:
    """Roots deeper than the axis or the hypocycloid, that meet, or whose rounding has no room."""

    if _has_root(gear):
        return
    bare = replace(gear, given_root_rounding=None)
    if gear.given_root_rounding is not None and _has_root(bare):
        most = limit(bare.greatest_rounding * (1 - _MARGIN), gear.given_root_rounding, digits=6)
        raise ParameterError("root_rounding", gear.given_root_rounding, "space_rounding_does_not_fit", most)

    def stands(depth: float) -> bool:
        return _has_root(replace(gear, dedendum_coefficient=depth))

    given = gear.dedendum_coefficient
    raise ParameterError("dedendum_coefficient", given, "roots_have_no_room", partial(nearest, stands, given, _SHALLOW))


def _has_root(gear: CycloidalGear) -> bool:
    """Whether the roots lie beyond the axis, and their fillets end between root and pitch circle."""
    if not gear.root_radius > 0 or not gear.greatest_rounding > 0:
        return False
    if gear.root_rounding > gear.greatest_rounding * (1 + _MARGIN):
        return False
    return kept(cycloidal_side, gear)


def cycloidal_findings(gear: CycloidalGear) -> tuple[Finding, ...]:
    """A thin tip, and a thin rim between the holes and the roots."""
    tips = short_of("thin_tip", gear.tip_thickness, _THIN_TIP * gear.module)
    if not gear.holes.number:
        return tips
    return tips + short_of("thin_rim", gear.root_radius - gear.holes.reach, _THIN_RIM * gear.module)
