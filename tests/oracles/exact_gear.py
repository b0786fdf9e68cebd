"""Fifty-digit oracle of a rack-cut spur gear, from the law of enveloping alone.

Derivation (Willis/Savary common normal, in Shishkov's form n.v = 0). Fixed frame: gear axis 0, pitch point
P = r = m z/2, datum line of the rack at Re = r + x m, rack moves by s along +i while the gear turns by s/r. A
rack point Q then moves against the gear with v = i - i Q/r; it lies on the envelope where n.v = 0, n the
rack's normal there. Q = Q0 + i s makes n.v affine in s, so that its root is one division: no involute
or trochoid equation is used anywhere. The gear point is Q exp(-i s/r).

Upper half of tooth 1 (polar angles 0 ... pi/z, the rest by symmetry), cut by the lower flank of the rack
tooth centred at +pi m/2. Everything is mpmath with its own 60-digit context (`MP`), good to 50 digits.
Precondition of the outline functions: the tooth is not pointed below the tip circle.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property, lru_cache, partial
from typing import Any

import mpmath

MP: Any = mpmath.mp.clone()
MP.dps = 60

Mpf = Any  # MP.mpf
Mpc = Any  # MP.mpc
Curve = Callable[[Mpf], tuple[Mpc, Mpc]]  # parameter -> (gear point, unit normal into the space)

_SAMPLES = 32


@dataclass(frozen=True)
class GearParameters:
    """Tool and gear. alpha in radians; m, thinning, tip_radius in mm; ha ... relief_height in modules.

    Fields may be int, float, str or mpf; they are stored as 60-digit MP.mpf. tip_radius 0 means
    r + (ha + x) m.
    """

    z: int
    m: Mpf
    alpha: Mpf
    ha: Mpf
    c: Mpf
    rho: Mpf
    x: Mpf
    thinning: Mpf = 0
    tip_radius: Mpf = 0
    relief_depth: Mpf = 0
    relief_height: Mpf = "0.45"

    def __post_init__(self) -> None:
        """Bring every field to 60 digits."""
        for field in fields(self):
            if field.name != "z":
                object.__setattr__(self, field.name, MP.mpf(getattr(self, field.name)))
        if not self.tip_radius:
            object.__setattr__(self, "tip_radius", self.r + (self.ha + self.x) * self.m)

    @cached_property
    def r(self) -> Mpf:
        """Rolling (reference) radius."""
        return self.m * self.z / 2

    @cached_property
    def hf(self) -> Mpf:
        """Reach of the rack tooth below its datum line, mm."""
        return (self.ha + self.c) * self.m

    @cached_property
    def relief_from(self) -> Mpf:
        """Height over the datum line at which the tool's relieved flank begins, mm."""
        return (self.ha - self.relief_height) * self.m

    @cached_property
    def relief_angle(self) -> Mpf:
        """Angle of the relieved flank: Delta m off the main flank after h_g m/cos(alpha) along it."""
        return self.alpha + MP.atan(self.relief_depth / (self.relief_height / MP.cos(self.alpha)))

    @cached_property
    def space(self) -> Mpf:
        """Where the lower flank of the rack tooth crosses the datum line, mm over the middle of the gear's tooth."""
        half = (MP.pi * self.m / 2 + self.thinning) / 2
        return MP.pi * self.m / 2 - half

    @cached_property
    def rounding_centre(self) -> Mpc:
        """Centre of the rounding: rho inside the flank and rho inside the tip line."""
        y = straight_start(self)
        touch = MP.mpc(self.r + self.x * self.m + y, self.space - y * MP.tan(self.alpha))
        return touch + self.rho * self.m * 1j * _unit(-self.alpha)


@dataclass(frozen=True)
class Junction:
    """Where the fillet ends and the flank begins: gear point, rack height, angle on the rounding."""

    point: Mpc
    rack_y: Mpf
    angle: Mpf
    undercut: bool


@dataclass(frozen=True)
class Segment:
    """One smooth piece of the half tooth, lo <= parameter <= hi, from root to tip."""

    kind: str
    curve: Curve
    lo: Mpf
    hi: Mpf


def radians(degrees: float | str) -> Mpf:
    """Degrees to radians at 60 digits."""
    return MP.mpf(degrees) * MP.pi / 180


def _unit(angle: Mpf) -> Mpc:
    """exp(i angle), without MP.expj, which refuses to work inside MP.findroot."""
    return MP.mpc(*MP.cos_sin(angle))


@lru_cache(maxsize=256)
def _straight(angle: Mpf) -> tuple[Mpf, Mpc]:
    """Tangent of a straight flank's angle, and its normal into the rack."""
    return MP.tan(angle), 1j * _unit(-angle)


def _generate(parameters: GearParameters, rack: Mpc, inward: Mpc) -> tuple[Mpc, Mpc]:
    """Gear point and normal made by the rack point `rack` (fixed frame, s = 0), from n.v = 0."""
    r = parameters.r

    # v = i (1 - rack / r) + s / r: n.v is affine in s
    at_0 = (MP.conj(inward) * (1j * (1 - rack / r))).real
    s = -r * at_0 / inward.real
    turn = _unit(-s / r)
    return (rack + 1j * s) * turn, inward * turn


def _line(parameters: GearParameters, y: Mpf, y0: Mpf, angle: Mpf) -> tuple[Mpc, Mpc]:
    """Gear point made by the straight flank that leaves the main flank at y0 under `angle`."""
    p, y, (slope, inward) = parameters, MP.mpf(y), _straight(angle)
    t = p.space - y0 * _straight(p.alpha)[0] - (y - y0) * slope
    return _generate(p, MP.mpc(p.r + p.x * p.m + y, t), inward)


def _flank(parameters: GearParameters, y: Mpf) -> tuple[Mpc, Mpc]:
    return _line(parameters, y, MP.mpf(0), parameters.alpha)


def _relief(parameters: GearParameters, y: Mpf) -> tuple[Mpc, Mpc]:
    return _line(parameters, y, parameters.relief_from, parameters.relief_angle)


def _fillet(parameters: GearParameters, angle: Mpf) -> tuple[Mpc, Mpc]:
    """Gear point made by the rounding."""
    p, inward = parameters, _unit(MP.mpf(angle))
    return _generate(p, p.rounding_centre - p.rho * p.m * inward, inward)


def straight_start(parameters: GearParameters) -> Mpf:
    """Height over the datum line where the rounding ends: rho along its inner normal is rho over the tip."""
    p = parameters
    normal = 1j * _unit(-p.alpha)
    return p.rho * p.m - p.hf - (p.rho * p.m * normal).real


def rounding_end(parameters: GearParameters) -> Mpf:
    """Angle of the rounding, from the tip line (0) to the flank."""
    return MP.pi / 2 - parameters.alpha


def flank_point(parameters: GearParameters, rack_y: Mpf) -> Mpc:
    """Upper flank of tooth 1: gear point made by the main rack flank at rack_y mm over the datum line."""
    return _flank(parameters, rack_y)[0]


def relief_point(parameters: GearParameters, rack_y: Mpf) -> Mpc:
    """Gear point made by the relieved rack flank at height rack_y (mm) over the datum line."""
    return _relief(parameters, rack_y)[0]


def fillet_point(parameters: GearParameters, angle_on_rounding: Mpf) -> Mpc:
    """Upper fillet of tooth 1; the angle runs from 0 (tip line, root land) to pi/2 - alpha (flank)."""
    return _fillet(parameters, angle_on_rounding)[0]


def flank_speed(parameters: GearParameters, rack_y: Mpf) -> Mpf:
    """d(gear point)/d(rack_y) along the flank's direction root -> tip; < 0 where the envelope runs back."""
    tangent = -1j * _flank(parameters, rack_y)[1]
    step = MP.mpf(10) ** -20 * parameters.m
    ahead, behind = (flank_point(parameters, rack_y + d) for d in (step, -step))
    return (MP.conj(tangent) * (ahead - behind)).real / (2 * step)


def _at_radius(curve: Curve, lo: Mpf, radius: Mpf, step: Mpf) -> Mpf:
    """Parameter >= lo at which a curve of growing radius reaches `radius` (lo if it is there at once)."""

    def off(value: Mpf) -> Mpf:
        return abs(curve(value)[0]) - radius

    if off(lo) >= 0:
        return lo
    hi = lo + step
    while off(hi) < 0:
        hi += step
    return MP.findroot(off, (lo, hi), solver="anderson", verify=False, maxsteps=200)


@lru_cache(maxsize=256)
def junction(parameters: GearParameters) -> Junction:
    """The tangent point of fillet and flank or, when undercut, their true crossing.

    Undercut is read off the shape: the flank's envelope starts by running backwards. Then the crossing is
    where both curves have one radius and one polar angle, beyond the cusp of the flank's envelope. (They also
    touch at the rounding's end, on the part of the flank that runs back: that is not the junction.)
    """
    p = parameters
    start, end = straight_start(p), rounding_end(p)
    if flank_speed(p, start) >= 0:
        return Junction(flank_point(p, start), start, end, undercut=False)
    cusp = MP.findroot(lambda y: flank_speed(p, y), (start, start + p.m), solver="secant", verify=False)
    base = abs(flank_point(p, cusp))

    def flank_at(angle: Mpf) -> Mpf:
        return _at_radius(partial(_flank, p), cusp, abs(fillet_point(p, angle)), p.m)

    def gap(angle: Mpf) -> Mpf:
        return MP.arg(flank_point(p, flank_at(angle))) - MP.arg(fillet_point(p, angle))

    low = _at_radius(partial(_fillet, p), MP.mpf(0), base, end / 8)
    for _ in range(10):  # bisect, then polish both parameters together
        for _ in range(16):
            middle = (low + end) / 2
            low, end = (middle, end) if gap(middle) > 0 else (low, middle)
        angle, y = _meet(partial(_fillet, p), partial(_flank, p), low, flank_at(low))
        if low <= angle <= end and y > cusp:
            return Junction(flank_point(p, y), y, angle, undercut=True)
    raise ArithmeticError("no crossing of fillet and flank found")


def _meet(one: Curve, other: Curve, u: Mpf, v: Mpf) -> tuple[Mpf, Mpf]:
    """Parameters of the crossing of two curves near (u, v)."""

    def apart(a: Mpf, b: Mpf) -> list[Mpf]:
        gap = one(a)[0] - other(b)[0]
        return [gap.real, gap.imag]

    first, second = MP.findroot(apart, (u, v), verify=False, maxsteps=50)
    return first, second


@lru_cache(maxsize=256)
def relief_corner(parameters: GearParameters) -> tuple[Mpf, Mpf, Mpc]:
    """Crossing of main flank and relief: (height on the main, height on the relieved tool flank, point).

    The tool's corner is re-entrant, so that it touches nothing; the two envelopes cross.
    """
    p, y0 = parameters, parameters.relief_from
    main, relief = _meet(partial(_flank, p), partial(_relief, p), y0, y0)
    return main, relief, flank_point(p, main)


@lru_cache(maxsize=256)
def half_tooth(parameters: GearParameters) -> tuple[Segment, ...]:
    """Pieces of the upper half of tooth 1 from the middle of the root land to the middle of the tip land."""
    p, joint = parameters, junction(parameters)
    ra, root = p.tip_radius, fillet_point(p, 0)
    if MP.arg(root) > MP.pi / p.z * (1 + MP.mpf(10) ** -12):
        raise ValueError("tip rounding does not fit the rack tooth")
    if abs(joint.point) >= ra or joint.point.imag <= 0:
        raise ValueError("no flank is left below the tip circle")

    def circle(radius: Mpf) -> Curve:
        return lambda angle: (radius * _unit(angle), _unit(angle))

    fillet = Segment("fillet", partial(_fillet, p), MP.mpf(0), joint.angle)
    pieces = [Segment("root", circle(abs(root)), MP.arg(root), MP.pi / p.z), fillet]
    flank, relief = partial(_flank, p), partial(_relief, p)
    if p.relief_depth and abs(relief_corner(p)[2]) < ra:
        main, start, _ = relief_corner(p)
        pieces.append(Segment("flank", flank, joint.rack_y, main))
        pieces.append(Segment("relief", relief, start, _at_radius(relief, start, ra, p.m)))
    else:
        pieces.append(Segment("flank", flank, joint.rack_y, _at_radius(flank, joint.rack_y, ra, p.m)))
    tip = pieces[-1].curve(pieces[-1].hi)[0]
    if tip.imag < 0:
        raise ValueError("tooth is pointed below the tip circle")
    pieces.append(Segment("tip", circle(ra), MP.mpf(0), MP.arg(tip)))
    return tuple(s for s in pieces if s.hi > s.lo)


def sample(segment: Segment, count: int) -> list[Mpc]:
    """`count` points of a piece, ends included, equally spaced in its parameter."""
    return [segment.curve(segment.lo + (segment.hi - segment.lo) * k / (count - 1))[0] for k in range(count)]


@lru_cache(maxsize=2048)
def _coarse(parameters: GearParameters, index: int) -> tuple[complex, ...]:
    return tuple(complex(p) for p in sample(half_tooth(parameters)[index], _SAMPLES + 1))


def _foot(segment: Segment, coarse: tuple[complex, ...], point: Mpc) -> tuple[Mpf, Mpf]:
    """(distance, signed normal part) of a piece's nearest point: bracketed root of (p - c).tangent = 0."""

    def along(value: Mpf) -> Mpf:
        where, normal = segment.curve(value)
        return (MP.conj(normal) * (point - where)).imag

    near = complex(point)
    k = min(range(len(coarse)), key=lambda i: abs(coarse[i] - near))
    lo, hi = (
        segment.lo + (segment.hi - segment.lo) * MP.mpf(j) / _SAMPLES for j in (max(k - 1, 0), min(k + 1, _SAMPLES))
    )
    candidates = [lo, hi]
    if along(lo) * along(hi) < 0:
        candidates = [MP.findroot(along, (lo, hi), solver="anderson", verify=False, maxsteps=200)]
    best = min((segment.curve(v) for v in candidates), key=lambda found: abs(point - found[0]))
    return abs(point - best[0]), (MP.conj(best[1]) * (point - best[0])).real


def normal_distance(point: complex | Mpc, parameters: GearParameters) -> Mpf:
    """Signed distance (mm) of a point to the finished outline: > 0 in the space, < 0 in the metal.

    Least distance over root land, fillet, flank, relief and tip arc, each trimmed at its crossings. At a
    corner (all corners of the metal are convex) a point is in the space if it lies before either normal.
    """
    p = MP.mpc(point)
    pitch = 2 * MP.pi / parameters.z
    angle = MP.arg(p) if p else MP.mpf(0)
    p = abs(p) * _unit(abs(angle - pitch * MP.nint(angle / pitch)))
    found = [_foot(s, _coarse(parameters, i), p) for i, s in enumerate(half_tooth(parameters))]
    least = min(distance for distance, _ in found)
    tie = least * (1 + MP.mpf(10) ** -30) + parameters.m * MP.mpf(10) ** -48
    sign = max(normal for distance, normal in found if distance <= tie)
    return least if sign > 0 else -least


def tooth_thickness(parameters: GearParameters, radius: Mpf) -> Mpf:
    """Arc thickness of the tooth on the circle `radius`, on whichever piece meets that circle."""
    radius = MP.mpf(radius)
    root = abs(fillet_point(parameters, 0))
    if not root <= radius <= parameters.tip_radius:
        raise ValueError("radius outside the tooth")
    for piece in half_tooth(parameters):
        if piece.kind in ("fillet", "flank", "relief") and abs(piece.curve(piece.hi)[0]) >= radius:
            value = _at_radius(piece.curve, piece.lo, radius, piece.hi - piece.lo)
            return 2 * radius * MP.arg(piece.curve(value)[0])
    return 2 * radius * half_tooth(parameters)[-1].hi


def tip_thickness(parameters: GearParameters) -> Mpf:
    """Arc thickness of the tooth on its tip circle."""
    return tooth_thickness(parameters, parameters.tip_radius)


def undercut_limit_shift(z: int, alpha: Mpf, hf: Mpf, rho: Mpf) -> Mpf:
    """Least shift x without undercut, in modules: bisection on the sign of the flank's first step.

    Shape only: at the limit the flank's envelope starts with speed 0 (its cusp). hf, rho in modules.
    """

    def runs_back(x: Mpf) -> bool:
        p = GearParameters(z=z, m=1, alpha=alpha, ha=hf, c=0, rho=rho, x=x, tip_radius=1)
        return flank_speed(p, straight_start(p)) < 0

    lo, hi = MP.mpf(-z), MP.mpf(z) + 10
    for _ in range(120 + z.bit_length()):
        middle = (lo + hi) / 2
        lo, hi = (middle, hi) if runs_back(middle) else (lo, middle)
    return (lo + hi) / 2
