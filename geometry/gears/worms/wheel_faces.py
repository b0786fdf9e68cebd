"""The faces of a worm wheel: flanks and fillets as splines over heights, throat and root as tori, all else as its core.

Between two breaks of the teeth every face is one spline, whose poles stand at even heights: both ends lie in planes.
Where fillets begin to reach the tip flanks come to a point, where teeth begin to end in a ridge their tips do.
Poles interpolate the exact envelope at Greville's places; the error is that of samples, along the normal.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import lru_cache
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import CadCurve, Outline
from geometry.approximation.tensor import clamped, greville, tensor_poles
from geometry.base.errors import ConvergenceError, GeometryError
from geometry.base.record import Record, replace
from geometry.curves.bspline import BSpline, basis_matrix
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.gears.worms.hob import Cut
from geometry.gears.worms.wheel import NEAR_WIDTH, NoTooth, WormTeeth
from geometry.gears.worms.wheel_measures import FILLET, FLANK, WormWheel
from geometry.solids.body_faces import BodyFaces, body_outlines
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import Cylinder, Frame, Solid, SplineSurface, Surface, Torus
from geometry.solids.measured import Measured
from geometry.solids.rings import AHEAD, UP, Ring
from geometry.solids.splines import involute_walls

_DEGREE = 7
# what is added to sampled errors; the kernel joins curves and surfaces within 1e-7 mm: edges are kept below that, mm
_MARGIN, _EDGES = 2.0, 5e-8
# the least error of faces that is asked for, mm
_FINEST, _SHARE = 2e-8, 0.5
# spans at most, and lines of a family on which they are chosen
_MOST_SPANS, _LINES = 64, 9
# the tolerance that files have by default, mm, and spans by which easy ones and all are near enough
_WANTED, _ENOUGH = 1e-6, (12, 48)
# by which power of what is left to the tip of a swivelled hob's flank its spans come closer there
_CLOSER = 2
# so many spans are one more when they are too few
_SLOW = 6
# of the curves of a ring
_ROOT, _TIP = 0, 3
# where between two places of interpolation errors are greatest
_BETWEEN = (0.35, 0.65)
# rounding of the envelope and of its fit, part of the size
_ROUNDING = 4e-15


class Strip(Record, eq=False):
    """Teeth between two heights: poles of the lower and the upper side's fillet and flank, (u, v), from root to tip.

    Where a fillet reaches the tip there is no flank; ``pointed``: both sides meet in a ridge.
    """

    low: float
    high: float
    u_knots: tuple[Real, ...]
    v_knots: Real
    lower: tuple[Complex, ...]
    upper: tuple[Complex, ...]
    pointed: bool

    @property
    def present(self) -> tuple[bool, ...]:
        """Which of the six faces of a tooth there are: root, fillet, flank, tip, flank, fillet."""
        return True, True, len(self.lower) > 1, not self.pointed, len(self.upper) > 1, True


class WheelSplines(Record, eq=False):
    """The teeth as splines, the outlines of the core, and the worst error, mm."""

    strips: tuple[Strip, ...]
    core: tuple[Outline, ...]
    max_error: float


def wheel_splines(wheel: WormWheel, tolerance: float) -> WheelSplines:
    """Splines within ``tolerance`` mm of the teeth, and within what the kernel calls one point of throat and root.

    Raises
    ------
    ConvergenceError
        64 spans are not enough.
    """
    teeth = wheel.teeth
    made = _fits(teeth, tolerance)
    worst = max(max(fit.error, fit.edge) for fits in made.values() for fit in fits)
    strips = []
    for low, high in made:
        lower, mirrored = ([fit.poles for fit in made[band]] for band in ((low, high), (-high, -low)))
        knots = [fit.u_knots for fit in max(made.values(), key=len)]
        upper = [np.conj(grid[:, ::-1]) for grid in mirrored]
        pointed = _is_pointed(teeth, (low, high))
        strips.append(Strip(low, high, tuple(knots), made[low, high][0].v_knots, tuple(lower), tuple(upper), pointed))
    core = body_outlines(wheel.core, tolerance)
    return WheelSplines(tuple(strips), core, max(_MARGIN * worst, *(o.max_error for o in core)))


# what a refusal offers is asked for again by whoever judges the offer
@lru_cache(maxsize=4)
def fitting(
    teeth: WormTeeth, stands: Callable[[WormTeeth], bool] = WormTeeth.is_smooth, share: float = NEAR_WIDTH
) -> WormTeeth | None:
    """The widest narrower teeth, to a share, themselves first, that stand and that splines come near; or None."""

    def ends(narrower: WormTeeth) -> bool:
        return is_fitting(narrower.tried, outermost=True)

    def fits(narrower: WormTeeth) -> bool:
        return stands(narrower) and is_fitting(narrower)

    if fits(teeth):
        return teeth
    found = teeth.widest(
        lambda narrower: stands(narrower.glanced), lambda narrower: stands(narrower.tried), share=share
    )
    if found is None:
        return None
    # what breaks a face breaks every wider one
    found = replace(found, width=min(found.width, 2 * _broken(found.tried)))
    return replace(found, width=min(found.width, 2 * _broken(found))).widest(ends, fits, share=share)


def is_fitting(teeth: WormTeeth, *, outermost: bool = False) -> bool:
    """Whether teeth stand over their whole width, and splines come near; ``outermost``: at their ends at least."""
    return teeth.stands() and _broken(teeth, outermost=outermost) == math.inf


@lru_cache(maxsize=16)
def _broken(teeth: WormTeeth, *, outermost: bool = False) -> float:
    """Where the innermost band ends to which somewhat less than the most spans do not come near, mm; else infinite."""
    least = _ROUNDING * teeth.outer_radius
    target, edges = max(_SHARE * _WANTED / _MARGIN, least), max(_EDGES, least)

    def breaks(part: int, band: tuple[float, float], spans: int) -> bool:
        try:
            away, edge = _along(teeth, part, band, spans)
            return not (away <= target and edge <= edges and _across(teeth, part, band, spans) <= target)
        except NoTooth:
            return True

    try:
        bands = sorted(pairwise(teeth.breaks), key=lambda band: abs(sum(band)))
        bands = bands[-2:] if outermost else bands
        teeth.seek(np.array([sum(band) / 2]) for band in bands)
        left = [(part, band) for band in bands for part in ((FILLET, FLANK) if _has_flank(teeth, band) else (FILLET,))]
    except (GeometryError, NoTooth):
        return teeth.width / 2
    for spans in _ENOUGH:
        # a side that is none is found again in its band
        with suppress(NoTooth):
            teeth.seek(z for _, band in left for z in (np.linspace(*band, _LINES), *_places(band, spans)))
        left = [(part, band) for part, band in left if breaks(part, band, spans)]
    return max(map(abs, left[0][1])) if left else math.inf


def _fits(teeth: WormTeeth, tolerance: float) -> dict[tuple[float, float], list[_Fit]]:
    """The lower fillet and flank between each two breaks."""
    least = _ROUNDING * teeth.outer_radius
    target = max(min(tolerance, max(_FINEST, _SHARE * tolerance)) / _MARGIN, least)
    edges = max(min(target, _EDGES), least)
    bands = list(pairwise(teeth.breaks))
    parts = {band: (FILLET, FLANK) if _has_flank(teeth, band) else (FILLET,) for band in bands}
    # tip and root are edges of exact surfaces: along them more is asked for
    # across: of fillet and flank, alike in all bands, which share the edges between them; then along each band
    across = [
        max((_spans(teeth, part, band, target) for band in bands if part in parts[band]), default=1)
        for part in (FILLET, FLANK)
    ]
    along = {band: max(_spans_along(teeth, part, band, target, edges) for part in parts[band]) for band in bands}
    along = {(low, high): max(n, along[-high, -low]) for (low, high), n in along.items()}
    while True:
        made = {band: [_fitted(teeth, p, band, (across[p], n)) for p in parts[band]] for band, n in along.items()}
        error = [max((fits[p].error for fits in made.values() if p < len(fits)), default=0.0) for p in (FILLET, FLANK)]
        off = {band for band, fits in made.items() for fit in fits if fit.error > target or fit.edge > edges}
        if not off:
            return made
        wider = [_more(n, e > target) for n, e in zip(across, error, strict=True)]
        longer = {(low, high): _more(n, bool(off & {(low, high), (-high, -low)})) for (low, high), n in along.items()}
        # which of both ways wants more the errors do not tell
        if (wider, longer) == (across, along):
            raise ConvergenceError("spline surfaces of the teeth", max(error), _MOST_SPANS)
        across, along = wider, longer


def _more(spans: int, wanted: bool) -> int:
    """So many spans, or some more, about the most at most."""
    return spans + wanted * (1 + spans // _SLOW) if spans <= _MOST_SPANS else spans


def _has_flank(teeth: WormTeeth, band: tuple[float, float]) -> bool:
    """Whether the lower side has one between two breaks."""
    return not teeth.side(sum(band) / 2).all_fillet[0]


def _is_pointed(teeth: WormTeeth, band: tuple[float, float]) -> bool:
    """Whether the teeth end in a ridge between two breaks."""
    return any(low < sum(band) / 2 < high for low, high in teeth.ridges)


def _points(teeth: WormTeeth, part: int, shares: Real, heights: Real) -> Cut:
    """The lower fillet (0) or flank (1) at shares and heights, (m, n)."""
    return (teeth.fillet, teeth.flank)[part](teeth.side(heights), shares[:, None])


def _spans(teeth: WormTeeth, part: int, band: tuple[float, float], target: float) -> int:
    """Least spans across a part with which its lines in planes are near enough."""
    for spans in range(1, _MOST_SPANS):
        if _across(teeth, part, band, spans) <= target / 2:
            break
    return spans


def _across(teeth: WormTeeth, part: int, band: tuple[float, float], spans: int) -> float:
    """How far lines of a part in planes are off on so many spans, mm."""
    heights = np.linspace(*band, _LINES)
    places, between, weights = _interpolation(spans, _closer(teeth, part))
    found = weights @ _points(teeth, part, places, heights).plane
    return float(_away(found, _points(teeth, part, between, heights)).max())


def _spans_along(teeth: WormTeeth, part: int, band: tuple[float, float], target: float, edges: float) -> int:
    """Least spans along a band with which its lines from end to end are near enough, and root and tip nearer."""
    for spans in range(1, _MOST_SPANS):
        away, edge = _along(teeth, part, band, spans)
        if away <= target / 2 and edge <= edges / 2:
            break
    return spans


def _along(teeth: WormTeeth, part: int, band: tuple[float, float], spans: int) -> tuple[float, float]:
    """How far lines of a part from end to end of a band are off on so many spans, and its edge, mm."""
    shares = np.linspace(0.0, 1.0, _LINES)
    (places, between), weights = _places(band, spans), _interpolation(spans)[2]
    found = _points(teeth, part, shares, places).plane @ weights.T
    away = float(_away(found, _points(teeth, part, shares, between)).max())
    return away, _edge_error(teeth, part, band, found, between)


def _closer(teeth: WormTeeth, part: int) -> int:
    """By which power spans across a part come closer at its tip than at its root."""
    # beyond the tip the contact of a swivelled hob turns back in the plane
    return _CLOSER if part == FLANK and teeth.hob.swivel else 1


def _ends(spans: int, power: int = 1, *, inwards: bool = False) -> Real:
    """Shares at the ends of spans that come closer by a power at the last of them, ``inwards`` at the first."""
    even = np.linspace(0.0, 1.0, spans + 1)
    return np.asarray(even**power if inwards or power == 1 else 1 - (1 - even) ** power)


def _between(places: Real) -> Real:
    """Where the errors of what is interpolated at places are greatest."""
    return np.concatenate([places[:-1] + share * np.diff(places) for share in _BETWEEN])


@lru_cache(maxsize=128)
def _interpolation(spans: int, closer: int = 1) -> tuple[Real, Real, Real]:
    """Shares of interpolation on spans, shares between them, and what gives the values there, (m, n)."""
    knots = clamped(_DEGREE, _ends(spans, closer))
    places = greville(_DEGREE, knots)
    between = _between(places)
    return places, between, basis_matrix(_DEGREE, knots, between) @ np.linalg.inv(basis_matrix(_DEGREE, knots, places))


def _places(band: tuple[float, float], spans: int) -> tuple[Real, Real]:
    """Heights of interpolation on spans along a band, and between them, mm."""
    low, high = band
    places, between, _ = _interpolation(spans)
    return low + (high - low) * places, low + (high - low) * between


def _edge_error(teeth: WormTeeth, part: int, band: tuple[float, float], found: Complex, heights: Real) -> float:
    """How far the first or the last line of a part in a band lies from the surface of root or tip beside it, mm."""
    off = [np.abs(found[0]) - teeth.root_radius(heights)] if part == FILLET else []
    if (part == FLANK or not _has_flank(teeth, band)) and not _is_pointed(teeth, band):
        off.append(np.abs(found[-1]) - teeth.tip_radius(heights))
    return max((float(np.abs(x).max()) for x in off), default=0.0)


def _away(points: Complex, exact: Cut) -> Real:
    """How far points are from the surface along its normal, mm."""
    return np.abs((np.conj(exact.normal) * (points - exact.plane)).real)


class _Fit(Record, eq=False):
    """A lower fillet or flank: knots both ways, poles (u, v) in the plane, errors of surface and of edge, mm."""

    u_knots: Real
    v_knots: Real
    poles: Complex
    error: float
    edge: float


def _fitted(teeth: WormTeeth, part: int, band: tuple[float, float], spans: tuple[int, int]) -> _Fit:
    """The spline of a lower fillet or flank."""
    u_knots = clamped(_DEGREE, _ends(spans[0], _closer(teeth, part)))
    v_knots = clamped(_DEGREE, np.linspace(*band, spans[1] + 1))
    places = greville(_DEGREE, u_knots), greville(_DEGREE, v_knots)
    exact = _points(teeth, part, *places)
    poles = tensor_poles(_DEGREE, u_knots, v_knots, exact.plane)
    # lines through places are off by the other way's errors alone, those of both ends the most
    u, v = (np.sort(np.concatenate([at, _between(at)])) for at in places)
    found = basis_matrix(_DEGREE, u_knots, u) @ poles @ basis_matrix(_DEGREE, v_knots, v).T
    error = float(_away(found, _points(teeth, part, u, v)).max())
    edge = _edge_error(teeth, part, band, found, v)
    return _Fit(u_knots, v_knots, poles, error, edge)


def wheel_solid(wheel: WormWheel, splines: WheelSplines) -> Solid:
    """The closed shell of a worm wheel over its splines."""
    made = BodyFaces(wheel.core, splines.core)
    teeth, middle = wheel.teeth, wheel.middle
    strips = splines.strips
    beside = [(strips[0],), *pairwise(strips), (strips[-1],)]
    rings = [_ring(made, teeth, pair, -1 if pair[-1] is pair[0] and k else 0, middle) for k, pair in enumerate(beside)]
    origin = made.on_axis(middle)
    tubes = teeth.hob.tip_radius, teeth.throat_radius
    root, throat = (Torus(Frame(origin, UP, AHEAD), teeth.centre_distance, r) for r in tubes)
    rim = Cylinder(Frame(origin, UP, AHEAD), teeth.outer_radius)
    for strip, (lower, upper) in zip(splines.strips, pairwise(rings), strict=True):
        within = abs(strip.low + strip.high) / 2 < teeth.throat_height
        tip: tuple[Surface, bool] = (throat, False) if within else (rim, True)
        along = BSpline(_DEGREE, strip.v_knots, np.zeros(len(strip.v_knots) - _DEGREE - 1, complex))
        rise = middle + greville(_DEGREE, strip.v_knots)
        land = root if teeth.hob.swivel == 0 else _land(made, teeth, strip, lower.turns, rise)
        below = (land, land is not root)
        made.ruled(lower, upper, (0.0, 1.0), along, rise, _grids(strip, teeth), {_ROOT: below, _TIP: tip})
    rim_wall = next(w for w in wheel.core.walls if wheel.core.loop_profile(w.lower) is wheel.rim)
    made.known |= {rim_wall.lower: rings[0], rim_wall.upper: rings[-1]}
    for wall in wheel.core.walls:
        if wall is not rim_wall:
            made.wall(wall)
    for cap in wheel.core.caps:
        made.face(cap)
    return made.solid()


def _land(made: BodyFaces, teeth: WormTeeth, strip: Strip, turns: Complex, rise: Real) -> SplineSurface:
    """The root of a swivelled hob, a surface of revolution that is no torus."""
    knots = clamped(_DEGREE, np.array([0.0, 1.0]))
    v = greville(_DEGREE, strip.v_knots)
    ends = [np.angle(teeth.fillet(teeth.side(z), 0.0).plane) for z in (v, -v)]
    first, last = -ends[1] - 2 * np.pi / teeth.number_of_teeth, ends[0]
    angles = first + (last - first) * greville(_DEGREE, knots)[:, None]
    poles = tensor_poles(_DEGREE, knots, strip.v_knots, teeth.root_radius(v) * np.exp(1j * angles))
    points = made.add_points(turns[:, None, None] * poles, rise)
    return SplineSurface((_DEGREE, _DEGREE), knots, strip.v_knots, points)


def _grids(strip: Strip, teeth: WormTeeth) -> list[Complex]:
    """Poles over the curves of a ring; of arcs those of their starts, of what is not there those of what comes next."""
    pitch = np.exp(-2j * np.pi / teeth.number_of_teeth)
    (fillet, *flank), (upper_fillet, *upper_flank) = strip.lower, strip.upper
    tip, other_tip = strip.lower[-1][-1:], strip.upper[-1][-1:]
    turned = [grid[::-1] for grid in upper_flank] or [other_tip]
    return [upper_fillet[:1] * pitch, fillet, *(flank or [tip]), tip, *turned, upper_fillet[::-1]]


def _ring(made: BodyFaces, teeth: WormTeeth, strips: Sequence[Strip], end: int, middle: float) -> Ring:
    """The edges of all teeth between two strips, or at an end, the lower (0) or the upper (-1) one of the last."""
    strip = strips[-1]
    before, fillet, flank, tip, upper_flank, upper_fillet = (grid[:, end] for grid in _grids(strip, teeth))
    fillet_knots, *flank_knots = strip.u_knots
    present = tuple(map(all, zip(*(s.present for s in strips), strict=True)))
    top = complex(upper_flank[0])
    period: list[CadCurve] = [_arc(complex(before[0]), complex(fillet[0])), BSpline(_DEGREE, fillet_knots, fillet)]
    if present[2]:
        period.append(BSpline(_DEGREE, flank_knots[0], flank))
    if present[3]:
        period.append(_arc(complex(tip[0]), top))
    if present[4]:
        inwards = clamped(_DEGREE, _ends(len(flank_knots[0]) - 2 * _DEGREE - 1, _closer(teeth, FLANK), inwards=True))
        period.append(BSpline(_DEGREE, inwards, upper_flank))
    period.append(BSpline(_DEGREE, fillet_knots, upper_fillet))
    outline = Outline(tuple(period), teeth.number_of_teeth, 0.0, "sampled")
    return replace(made.ring(outline, middle + float(strip.v_knots[end])), present=present)


def _arc(start: complex, end: complex) -> Arc:
    """About the axis, mm."""
    return Arc(0j, abs(start), cmath.phase(start), cmath.phase(end / start))


def wheel_body(wheel: WormWheel) -> FacedBody:
    """The wheel as files, mass and checks want it; splines are held against the envelope itself."""

    def within(tolerance: float) -> FacedSolid:
        splines = wheel_splines(wheel, tolerance)
        return FacedSolid(wheel_solid(wheel, splines), splines.max_error, "sampled")

    walls = [Measured("flank", wheel.from_sides, wheel.teeth.number_of_teeth)]
    if wheel.teeth.hob.swivel:
        walls.append(Measured("root", wheel.from_root, 0))
    walls += involute_walls(*wheel.core.profiles)
    levels = wheel.core.levels()
    ends = levels[0], levels[-1], wheel.teeth.reach()
    # a mesh much coarser than a module leaves the throat to its neighbours
    return FacedBody(within, tuple(walls), wheel.moments, own_ends=ends, coarsest=wheel.teeth.hob.worm.module)
