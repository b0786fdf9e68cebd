"""Splined shafts and bores: straight and involute sides between two circles, with exact parallel curves of either sign.

The slots of a hub are the teeth of a shaft, so one form is both: teeth about the axis, tooth 1 on +x, which a bore runs
round clockwise. A form moved d mm outwards keeps the fixed point of each corner, as all bores do (``bores.py``).
"""

from __future__ import annotations

import cmath
import math
from contextlib import suppress
from functools import cached_property, partial
from typing import Literal, Protocol

import numpy as np

from geometry.base.angles import inverse_involute, involute_function, roll_minus_polar, tangent_length
from geometry.base.errors import OffsetError, ParameterError
from geometry.base.nearest import last_that_holds
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Curve, Real, Reversed, end_point, start_point
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.bores import widened_corner
from geometry.solids.measured import Measured

Centring = Literal["inner", "outer", "sides"]
Root = Literal["flat", "fillet"]
_LETTERS: dict[Centring, str] = {"inner": "d", "outer": "D", "sides": "b"}
_DIAGONAL = cmath.rect(1.0, math.pi / 4)
# mm, of the diameters of pins
_PIN_STEP = 0.05
# halvings of a reach, to the last digit of a limit
_STEPS = 52
# rad: lands narrower than this are none
_NONE = 1e-9
# mm: 0.2 * 1.5 - 0.3 is no radius
_SHARP = 1e-12


class Flank(Protocol):
    """The upper side of tooth 1, whose material is below it."""

    def shifted(self, distance: float) -> Flank:
        """Its parallel curve, ``distance`` mm out of the tooth."""

    def at(self, radius: float) -> complex:
        """Its point at a distance from the axis, mm; OffsetError where it has none."""

    def foot(self, point: complex, distance: float) -> complex:
        """Of a point of its parallel curve ``distance`` mm out of the tooth the one of its own."""

    def inwards(self, start: complex, end: complex) -> tuple[Curve, ...]:
        """It between two of its points, towards the axis."""


class StraightFlank(Record):
    """A side parallel to the middle of its tooth, ``half`` mm beside it."""

    half: float

    def shifted(self, distance: float) -> StraightFlank:
        """See Flank."""
        return StraightFlank(self.half + distance)

    def at(self, radius: float) -> complex:
        """See Flank."""
        if not radius > abs(self.half):
            raise OffsetError(radius, "spline_sides_meet")
        return complex(math.sqrt((radius - self.half) * (radius + self.half)), self.half)

    def foot(self, point: complex, distance: float) -> complex:
        """See Flank."""
        return point - 1j * distance

    def inwards(self, start: complex, end: complex) -> tuple[Line, ...]:
        """See Flank."""
        return (Line(start, end),)


class InvoluteFlank(Record, dict=True):
    """An involute of the circle of ``base_radius`` mm, and towards the axis the radius along which it leaves it.

    ``base_half_angle``: half of the tooth on that circle, rad. Parallel curves are the same involute, turned, and a
    line ``moved`` mm beside that radius.
    """

    base_radius: float
    base_half_angle: float
    moved: float = 0.0

    def shifted(self, distance: float) -> InvoluteFlank:
        """See Flank."""
        turned = self.base_half_angle + distance / self.base_radius
        return InvoluteFlank(self.base_radius, turned, self.moved + distance)

    def _roll(self, radius: float) -> float:
        return tangent_length(radius, self.base_radius) / self.base_radius

    def _rolled(self, roll: float) -> complex:
        return cmath.rect(self.base_radius * math.hypot(1.0, roll), self.base_half_angle - roll_minus_polar(roll))

    @property
    def _line_direction(self) -> complex:
        return cmath.rect(1.0, self.base_half_angle - self.moved / self.base_radius)

    @cached_property
    def joint_roll(self) -> float:
        """Where the line ends: it touches the involute out of the tooth, and cuts it within."""
        off = self.moved / self.base_radius
        if off >= 0:
            return off
        # below the involute's point that far from the line there is only line
        return bracketed_root(
            lambda roll: math.hypot(1.0, roll) * math.sin(off - roll_minus_polar(roll)) - off, 0.0, -off
        ).value

    def at(self, radius: float) -> complex:
        """See Flank."""
        roll = self._roll(radius)
        if radius >= self.base_radius and roll >= self.joint_roll:
            return self._rolled(roll)
        if not radius > abs(self.moved):
            raise OffsetError(radius, "spline_sides_meet")
        return self._line_direction * complex(math.sqrt((radius - self.moved) * (radius + self.moved)), self.moved)

    def foot(self, point: complex, distance: float) -> complex:
        """See Flank: both lie on one tangent of the base circle, or on one normal of the line."""
        roll = self._roll(abs(point))
        if abs(point) >= self.base_radius and roll >= self.shifted(distance).joint_roll:
            return self._rolled(max(roll - distance / self.base_radius, 0.0))
        return point - 1j * distance * self._line_direction

    def inwards(self, start: complex, end: complex) -> tuple[Curve, ...]:
        """See Flank."""
        first, last, joint = self._roll(abs(start)), self._roll(abs(end)), self.joint_roll
        if last >= joint and abs(end) >= self.base_radius:
            return (Involute(self.base_radius, self.base_half_angle, -first, -last),)
        if first <= joint:
            return (Line(start, end),)
        return Involute(self.base_radius, self.base_half_angle, -first, -joint), Line(self._rolled(joint), end)

    def rounding(self, radius: float, circle: float) -> float:
        """Radius of the arc that leaves it there and touches a circle about the axis, within or beyond, mm."""
        along = tangent_length(radius, self.base_radius)
        return (radius - circle) * (radius + circle) / (2 * (circle - along)) if circle > along else math.inf


class SplineForm(Record):
    """The teeth of a shaft, or the slots of a hub, between the radii ``inner`` and ``outer``; mm.

    Roundings of the corners between a side and both circles, or chamfers: the legs of those at 45 degrees to a straight
    side.
    """

    teeth: int
    flank: Flank
    inner: float
    outer: float
    root_rounding: float = 0.0
    crest_rounding: float = 0.0
    root_chamfer: float = 0.0
    crest_chamfer: float = 0.0

    @property
    def side_diameters(self) -> tuple[float, float]:
        """Between which its sides lie, without roundings and chamfers, mm."""
        return 2 * abs(self._root(0.0)[1]), 2 * abs(self._crest(0.0)[1])

    def widened(self, depth: float) -> SplineForm:
        """The form ``depth`` mm larger on all sides, sharp corners kept.

        The line of a chamfer at the root moves by sqrt(2) of that, so that it keeps its length all but for the circle's
        bend, and sweeps a plane.
        """
        crest, leg = widened_corner(self.crest_rounding, depth), self.root_chamfer
        flank, inner, outer = self.flank.shifted(depth), self.inner + depth, self.outer + depth
        if leg:
            leg += self.flank.at(self.inner).real + depth - flank.at(inner).real
        return replace(self, flank=flank, inner=inner, outer=outer, crest_rounding=crest, root_chamfer=leg)

    def outline(self, distance: float = 0.0) -> Profile:
        """The counter-clockwise boundary, moved ``distance`` mm outwards.

        Raises
        ------
        OffsetError
            No side, tooth or space is left.
        """
        if not self.inner + distance > 0:
            raise OffsetError(distance, "spline_sides_meet")
        half, turn = math.pi / self.teeth, Placement2(2 * math.pi / self.teeth)
        flank = self.flank.shifted(distance)
        crest, start = self._crest(distance)
        root, bottom = self._root(distance)
        low = cmath.phase(start_point(crest[0]) if crest else start)
        high = cmath.phase(end_point(root[-1]) if root else bottom)
        if abs(bottom) >= abs(start) or low < -_NONE or high > half + _NONE:
            raise OffsetError(distance, "spline_sides_meet")
        side = [Segment(curve, Label.TIP_BREAK) for curve in crest]
        side += [Segment(curve, Label.FLANK) for curve in flank.inwards(start, bottom)]
        side += [Segment(curve, Label.ROOT_FILLET) for curve in root]
        land = [Segment(Arc(0j, self.outer + distance, -low, 2 * low), Label.TIP_LAND)] if low > _NONE else []
        bed = [Segment(Arc(0j, self.inner + distance, high, 2 * (half - high)), Label.ROOT_LAND)]
        back = [Segment(s.curve.mirrored().placed(turn), s.label) for s in reversed(side)]
        return Profile((*land, *side, *(bed if half - high > _NONE else ()), *back), self.teeth)

    def _crest(self, distance: float) -> tuple[list[Curve], complex]:
        """What lies between the outer circle and the upper side of tooth 1, and where that begins."""
        outer, radius = self.outer + distance, self.crest_rounding + distance
        if self.crest_chamfer:
            pieces, start = self._chamfer(distance, self.outer, -self.crest_chamfer)
            return [piece.reversed() for piece in reversed(pieces)], start
        if radius <= _SHARP:
            return [], self.flank.shifted(distance).at(outer)
        centre = self.flank.shifted(-self.crest_rounding).at(self.outer - self.crest_rounding)
        start = self.flank.shifted(distance).foot(centre, -radius)
        return [arc_between(centre, centre * outer / abs(centre), start, True)], start

    def _root(self, distance: float) -> tuple[list[Curve], complex]:
        """What lies between the upper side of tooth 1 and the inner circle, and where that side ends."""
        inner, radius = self.inner + distance, self.root_rounding - distance
        if self.root_chamfer:
            return self._chamfer(distance, self.inner, self.root_chamfer)
        if radius <= _SHARP:
            return [], self.flank.shifted(distance).at(inner)
        centre = self.flank.shifted(self.root_rounding).at(self.inner + self.root_rounding)
        bottom = self.flank.shifted(distance).foot(centre, radius)
        return [arc_between(centre, bottom, centre * inner / abs(centre), False)], bottom

    def _chamfer(self, distance: float, circle: float, leg: float) -> tuple[list[Curve], complex]:
        """From the upper side, ``leg`` mm beyond its corner with a circle, at 45 degrees to it, and where that begins.

        Its ends are convex at the crest, concave at the root: there an arc stands about each of them once the form has
        grown, or shrunk.
        """
        near = self.flank.at(circle) + leg
        along = (near / _DIAGONAL).real
        if near.real <= 0 or along >= circle:
            raise OffsetError(distance, "spline_sides_meet")
        far = _DIAGONAL * complex(along, -math.sqrt((circle - along) * (circle + along)))
        shift, turn = distance * _DIAGONAL, cmath.phase(far) - math.pi / 4
        if distance * leg < 0:
            begin = 0.0 if distance > 0 else -math.pi
            first = Arc(near, abs(distance), begin + math.pi / 2, -math.pi / 4)
            last = Arc(far, abs(distance), begin + math.pi / 4, turn)
            return [first, Line(near + shift, far + shift), last], near + 1j * distance
        along, circle = along + distance, circle + distance
        height = near.imag + distance
        near = _DIAGONAL * complex(along, height * math.sqrt(2) - along)
        if along >= circle:
            raise OffsetError(distance, "spline_sides_meet")
        if leg * (abs(near) - circle) <= 0:
            return [], self.flank.shifted(distance).at(circle)
        return [Line(near, _DIAGONAL * complex(along, -math.sqrt((circle - along) * (circle + along))))], near


class Fit(Record):
    """Tolerance zones of a hub and of its shaft, H7 and f7, empty where none is told: of a size d, D or b, mm."""

    symbol: str
    size: float
    hub: str = ""
    shaft: str = ""

    def zone(self, is_shaft: bool | None) -> str:
        """That of one of them, or of both."""
        return _both(self.hub, self.shaft, is_shaft)


def _both(hub: str, shaft: str, is_shaft: bool | None) -> str:
    return "/".join(filter(None, (hub, shaft))) if is_shaft is None else shaft if is_shaft else hub


class StraightJoint(Record):
    """z x d x D with teeth ``width`` (b) wide; ``root``: d1, the inner diameter of a shaft that does not centre there.

    ``chamfer`` (c x 45 degrees): at the tips of the shaft and where the slots of the hub open; ``rounding`` (r): at its
    root.
    """

    teeth: int
    inner: float
    outer: float
    width: float
    root: float
    chamfer: float = 0.0
    rounding: float = 0.0
    centring: Centring = "inner"
    standard: str = ""
    fits: tuple[Fit, ...] = ()

    @property
    def sizes(self) -> tuple[float, float, float, float]:
        """z, d, D and b."""
        return self.teeth, self.inner, self.outer, self.width

    @property
    def hub_reach(self) -> float:
        """How far from the axis its slots go, mm."""
        return self.outer / 2

    @property
    def reference_radius(self) -> float:
        """None, 0."""
        return 0.0

    @property
    def name(self) -> str:
        """Its designation, with the teeth's width where no standard has it."""
        sizes = "×".join(f"{size:g}" for size in self.sizes[: 3 if self.standard else 4])
        return f"{_LETTERS[self.centring]}-{sizes}" if self.standard else sizes

    def named(self, *, is_shaft: bool | None = None) -> str:
        """The same with the zones of its shaft, of its hub or of both, where it has some."""
        if not self.fits:
            return self.name
        zones = {fit.symbol: fit.zone(is_shaft) for fit in self.fits}
        told = zip(self.sizes, ("", *_LETTERS.values()), strict=True)
        return f"{_LETTERS[self.centring]}-" + "×".join(f"{size:g}{zones.get(symbol, '')}" for size, symbol in told)

    def shaft(self) -> SplineForm:
        """Its teeth: form 3 of GOST 1139, its root at d, where that centres, else form 2, its root at d1."""
        inner = self.inner if self.centring == "inner" else self.root
        flank = StraightFlank(self.width / 2)
        return SplineForm(self.teeth, flank, inner / 2, self.outer / 2, self.rounding, crest_chamfer=self.chamfer)

    def hub(self) -> SplineForm:
        """Its slots."""
        flank = StraightFlank(self.width / 2)
        return SplineForm(self.teeth, flank, self.inner / 2, self.outer / 2, root_chamfer=self.chamfer)


class SplineMeasures(Record):
    """What is measured on involute teeth, or in the space of a hub's slots, mm.

    ``thickness`` on the reference circle, ``over_pins`` (between them in a hub) two of ``pin_diameter``, ``span`` over
    ``teeth_spanned``, 0 in a hub.
    """

    thickness: float
    pin_diameter: float
    over_pins: float
    teeth_spanned: int = 0
    span: float = 0.0


class InvoluteJoint(Record):
    """Teeth ``thickness`` mm thick on the reference circle m z, the slots of the hub as wide.

    ``shaft_diameters`` and ``hub_diameters``: of the inner and the outer circle; ``roundings``: of the corners at the
    root and the tips of the shaft and at the bottom of the hub's slots; inf: one arc from side to side; less where it
    would reach beyond a form diameter. Those lie ``form_clearance`` (c_F) mm beyond the tips of the mate.
    ``hub_class`` and ``shaft_class``: of tolerance, 5H and 5f, ``fits``: of the outer diameter; they move nothing.
    """

    module: float
    teeth: int
    pressure_angle: float
    thickness: float
    shaft_diameters: tuple[float, float]
    hub_diameters: tuple[float, float]
    roundings: tuple[float, float, float]
    standard: str
    name: str
    form_clearance: float = 0.0
    hub_class: str = ""
    shaft_class: str = ""
    fits: tuple[Fit, ...] = ()

    def named(self, *, is_shaft: bool | None = None) -> str:
        """The designation of its shaft, of its hub or of both, with the tolerances that has."""
        size, *more = self.name.split("×")
        zones = (fit.zone(is_shaft) for fit in self.fits)
        return "×".join(filter(None, (size, *zones, *more, _both(self.hub_class, self.shaft_class, is_shaft))))

    @property
    def hub_reach(self) -> float:
        """How far from the axis the slots of its hub go, mm."""
        return self.hub_diameters[1] / 2

    @property
    def form_diameters(self) -> tuple[float, float]:
        """From which to which the sides of shaft and hub are true at least: D_Fe and D_Fi of ISO 4156-1, mm."""
        return self.hub_diameters[0] - 2 * self.form_clearance, self.shaft_diameters[1] + 2 * self.form_clearance

    @property
    def reference_radius(self) -> float:
        """m z / 2, mm."""
        return self.module * self.teeth / 2

    def _flank(self) -> InvoluteFlank:
        reference = self.reference_radius
        half = self.thickness / (2 * reference) + involute_function(self.pressure_angle)
        return InvoluteFlank(reference * math.cos(self.pressure_angle), half)

    def measured(self, play: float, *, is_shaft: bool, pin_diameter: float = 0.0) -> SplineMeasures:
        """What a calliper reads on sides that stand ``play`` mm outside of the nominal ones.

        Pins by default touch them in the middle of their contact, all but for a step of 0.05 mm. They stand at
        inv(alpha_M) = psi_b - pi / z + D / d_b on a shaft, psi_b - D / d_b in a hub (ISO 4156-1); W is as on gears.

        Raises
        ------
        ParameterError
            ``pin_diameter``: such a pin touches no involute.
        """
        flank, angle, way = self._flank().shifted(play), math.pi / self.teeth, 1 if is_shaft else -1
        base, begins = flank.base_radius, flank.base_half_angle - (angle if is_shaft else 0.0)
        middle = math.acos(min(4 * base / (self.hub_diameters[0] + self.shaft_diameters[1]), 1.0))

        def beside(pin: float) -> float:
            return begins + way * pin / 2 / base - roll_minus_polar(math.tan(middle) + way * pin / 2 / base)

        if not pin_diameter:
            best = bracketed_root(beside, 0.0, 2 * base * (1.0 if is_shaft else math.tan(middle))).value
            pin_diameter = max(1, round(best / _PIN_STEP)) / round(1 / _PIN_STEP)
        involute = begins + way * pin_diameter / 2 / base
        if not involute > 0:
            # there both touch on the base circle
            raise ParameterError.beyond("pin_diameter", pin_diameter, "pin_touches_no_side", 2 * base * abs(begins))
        centre = base / math.cos(inverse_involute(involute))
        over = 2 * centre * (math.cos(angle / 2) if self.teeth % 2 else 1.0) + way * pin_diameter
        thickness = self.thickness + 2 * play / math.cos(self.pressure_angle)
        if not is_shaft:
            return SplineMeasures(thickness, pin_diameter, over)
        # faces touch the sides in the middle of their contact, too
        spanned = max(1, round((math.tan(middle) - flank.base_half_angle) / angle + 1))
        span = 2 * base * (angle * (spanned - 1) + flank.base_half_angle)
        return SplineMeasures(thickness, pin_diameter, over, spanned, span)

    def of_width(self, width: float, *, is_shaft: bool, pin_diameter: float) -> SplineMeasures:
        """What is measured where teeth, or spaces, are so wide on the reference circle, mm."""
        play = (width - self.thickness) / 2 * math.cos(self.pressure_angle)
        return self.measured(play, is_shaft=is_shaft, pin_diameter=pin_diameter)

    def _form(self, diameters: tuple[float, float], root: float, crest: float) -> SplineForm:
        flank, (inner, outer) = self._flank(), (diameter / 2 for diameter in diameters)
        low, high = (diameter / 2 for diameter in self.form_diameters)
        if root:
            root = min(root, _full(flank, inner, math.pi / self.teeth, 1), flank.rounding(low, inner))
        if crest:
            # tips of a shaft that centres there are as round as the bottom of the slots
            reach = -flank.rounding(high, outer) if high < outer else math.inf
            crest = min(crest, _full(flank, outer, 0.0, -1), reach)
        return SplineForm(self.teeth, flank, inner, outer, root, crest)

    def shaft(self) -> SplineForm:
        """Its teeth."""
        return self._form(self.shaft_diameters, *self.roundings[:2])

    def hub(self) -> SplineForm:
        """Its slots."""
        return self._form(self.hub_diameters, 0.0, self.roundings[2])


def _full(flank: InvoluteFlank, radius: float, middle: float, way: int) -> float:
    """Radius of the arc that touches both sides, and a circle in the middle of a space (``way`` 1) or a tooth, mm.

    inf: none does in a wide tooth.
    """

    def beside(rounding: float) -> float:
        centre = flank.shifted(way * rounding).at(radius + way * rounding)
        return way * (cmath.phase(centre) - middle)

    most = radius if way > 0 else radius - flank.base_radius
    if beside(0.0) >= 0:
        raise OffsetError(0.0, "spline_sides_meet")
    return bracketed_root(beside, 0.0, most).value if beside(most) >= 0 else math.inf


def involute_walls(*outlines: Profile) -> tuple[Measured, ...]:
    """The upright walls over the involutes of outlines about the axis, those of each hand as one; exact normals."""
    found: dict[tuple[float, bool], list[float]] = {}
    for segment in (segment for outline in outlines for segment in outline.segments()):
        curve = segment.curve.base if isinstance(segment.curve, Reversed) else segment.curve
        if isinstance(curve, Involute):
            found.setdefault((curve.base_radius, curve.start_roll < 0), []).append(curve.base_angle)
    return tuple(
        Measured("spline", partial(_to_involutes, base, upper, np.array(angles)), len(angles))
        for (base, upper), angles in found.items()
    )


def _to_involutes(base: float, upper: bool, angles: Real, points: Real) -> Real:
    """How far points (n, 3) lie from the nearest of the involutes that leave a circle at some angles, mm."""
    places = points[:, 0] + 1j * points[:, 1]
    roll = np.sqrt(np.maximum((np.abs(places) / base) ** 2 - 1, 0.0))
    gained = roll - np.arctan(roll)
    leaves = np.angle(places) + (gained if upper else -gained)
    apart = (leaves[:, None] - angles + np.pi) % (2 * np.pi) - np.pi
    return base * np.abs(apart).min(axis=1) + np.maximum(base - np.abs(places), 0.0)


def _check_outlines(joint: StraightJoint | InvoluteJoint, clearance: float) -> None:
    """Refuse a joint whose hub or shaft has no outline within its clearance, mm, or that do not fit: an OffsetError."""
    hub, shaft = joint.hub(), joint.shaft()
    hub.widened(clearance).outline()
    shaft.outline(-clearance)
    # the mouth of a slot is as wide as its chamfer, where the sides of the shaft begin beyond its rounding
    if isinstance(joint, StraightJoint) and shaft.side_diameters[0] > hub.side_diameters[0]:
        raise OffsetError(clearance, "spline_mouth_narrow")


def _of_root(joint: StraightJoint | InvoluteJoint, blamed: tuple[str, object], clearance: float) -> tuple[str, object]:
    """The rounding at the root, with its value, where a joint has an outline without it; else what is blamed."""
    if isinstance(joint, StraightJoint) and joint.rounding > 0:
        with suppress(OffsetError):
            _check_outlines(replace(joint, rounding=0.0), clearance)
            return "bore.root_rounding", joint.rounding
    return blamed


class SplineBore(Record, dict=True):
    """The slots of a hub; mm, rad.

    ``size``: the key and the value that make it larger; ``clearance``: how far every surface stands off that of the
    shaft, along its normal; ``angle``: direction of the middle of the first slot; ``depth``: that of a chamfer there.
    """

    joint: StraightJoint | InvoluteJoint
    size: tuple[str, object]
    clearance: float = 0.0
    angle: float = 0.0
    depth: float = 0.0

    @cached_property
    def form(self) -> SplineForm:
        """Its slots, sharp corners kept."""
        return self.joint.hub().widened(self.clearance + self.depth)

    @property
    def reach(self) -> float:
        """See Bore."""
        return self.joint.hub_reach + self.clearance + self.depth

    def check(self) -> None:
        """See Bore."""
        for clearance, blamed in ((0.0, self.size), (self.clearance, ("bore.clearance", self.clearance))):
            try:
                _check_outlines(self.joint, clearance)
            except OffsetError as refusal:
                raise ParameterError(*_of_root(self.joint, blamed, clearance), refusal.reason) from refusal

    def widened(self, depth: float) -> SplineBore:
        """Its slots with a chamfer."""
        return replace(self, depth=self.depth + depth)

    def profile(self, offset: float = 0.0) -> Profile:
        """See Bore."""

        def outline(by: float) -> Profile:
            return self.form.outline(-by)

        if not math.isfinite(offset):
            raise OffsetError(offset, "not_finite")
        try:
            made = outline(offset)
        except OffsetError as refusal:
            beyond = math.copysign(min(abs(offset), self.reach), offset)
            raise OffsetError(offset, refusal.reason, last_that_holds(outline, beyond, steps=_STEPS)) from refusal
        turned = made.placed(Placement2(self.angle))
        return Profile(tuple(Segment(s.curve.reversed(), s.label) for s in reversed(tuple(turned.segments()))))
