"""Hypothesis strategies: valid curves of every class, gears and racks, and parameters that must be refused."""

from __future__ import annotations

import math

from hypothesis import strategies as st

from geometry.base.errors import GeometryError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.curve import Curve, OffsetCurve, Reversed
from geometry.curves.cutter_fillet import CutterFillet
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from geometry.gears.teeth.basic_rack import ISO_53, BasicRack, TipRelief, full_round_radius, iso_53
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_made import DEFAULT_CUTTER_TEETH, settled_ring
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from tests.oracles.trochoid import Trochoid


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Finite floats in [low, high] without subnormals."""
    return st.floats(low, high, allow_nan=False, allow_infinity=False, allow_subnormal=False)


angles = numbers(-math.pi, math.pi)
points = st.builds(complex, numbers(-50, 50), numbers(-50, 50))
placements = st.builds(Placement2, angles, points)


@st.composite
def lines(draw: st.DrawFn) -> Line:
    """Lines at least a tenth of a millimetre long."""
    start, length, angle = draw(points), draw(numbers(0.1, 50)), draw(angles)
    return Line(start, start + length * complex(math.cos(angle), math.sin(angle)))


@st.composite
def arcs(draw: st.DrawFn) -> Arc:
    """Arcs of either sense, up to a full turn."""
    sense = draw(st.sampled_from((1.0, -1.0)))
    return Arc(draw(points), draw(numbers(0.05, 100)), draw(angles), sense * draw(numbers(0.01, 2 * math.pi)))


@st.composite
def involutes(draw: st.DrawFn) -> Involute:
    """Both branches, from the base circle itself on."""
    start = draw(st.one_of(st.just(0.0), numbers(1e-3, 1.5)))
    end = start + draw(numbers(0.02, 2.0))
    low, high = (start, end) if draw(st.booleans()) else (-end, -start)
    return Involute(draw(numbers(0.5, 200)), draw(angles), low, high, draw(points))


@st.composite
def trochoids(draw: st.DrawFn) -> Trochoid:
    """Paths of points inside (prolate) and outside the pitch line, away from their cusp at depth 0."""
    radius = draw(numbers(1, 200))
    depth = radius * draw(st.one_of(numbers(0.02, 0.6), numbers(-0.4, -0.02)))
    start = radius * draw(numbers(-0.8, 0.5))
    return Trochoid(radius, depth, draw(angles), start, start + radius * draw(numbers(0.05, 0.8)), draw(points))


@st.composite
def fillets(draw: st.DrawFn) -> TrochoidFillet:
    """Root fillets as racks cut them: depth 0 and slightly negative depth included."""
    radius, alpha = draw(numbers(1.5, 200)), math.radians(draw(numbers(14, 31)))
    rho = radius * draw(numbers(0.004, 0.2))
    # speed rho (1 + q/cos^2) + D q/cos^3 must stay positive at the rack's flank
    share = draw(st.one_of(st.just(0.0), numbers(1e-9, 0.8), numbers(-0.02, -1e-9)))
    end = math.pi / 2 - alpha
    start = draw(st.one_of(st.just(0.0), numbers(0, 0.5)))
    fillet = TrochoidFillet(radius, share * radius, rho, draw(angles), start, end, draw(points))
    if draw(st.booleans()):
        fillet = fillet.mirrored()
    return fillet


@st.composite
def cutter_fillets(draw: st.DrawFn) -> CutterFillet:
    """Fillets of pinion cutters inside rings and outside gears; the corner's centre on the pitch circle included."""
    radius, alpha = draw(numbers(2, 200)), math.radians(draw(numbers(17, 33)))
    rolling = radius * draw(st.one_of(numbers(0.05, 0.95), numbers(-3.0, -0.1)))
    share = draw(st.one_of(st.just(0.0), numbers(1e-9, 0.5), numbers(-0.01, -1e-9)))
    rho = abs(rolling) * draw(numbers(0.004, 0.2))
    start = draw(st.one_of(st.just(0.0), numbers(0, 0.5)))
    fillet = CutterFillet(
        radius, rolling, share * abs(rolling), rho, draw(angles), start, math.pi / 2 - alpha, draw(points)
    )
    return fillet.mirrored() if draw(st.booleans()) else fillet


@st.composite
def parallels(draw: st.DrawFn) -> OffsetCurve:
    """General parallel curves that do not turn back."""
    base = draw(st.one_of(trochoids(), arcs(), lines()))
    reach = _room(base)
    return OffsetCurve(base, draw(numbers(-0.7, 0.7)) * reach)


def _room(base: Curve) -> float:
    """The least radius of curvature over the domain, at most 10 mm."""
    low, high = base.domain
    bends = [abs(float(base.curvature(low + (high - low) * k / 64))) for k in range(65)]
    return min(10.0, 0.9 / max(*bends, 0.09))


plain_curves: st.SearchStrategy[Curve] = st.one_of(
    lines(), arcs(), involutes(), trochoids(), fillets(), cutter_fillets(), parallels()
)
curves: st.SearchStrategy[Curve] = st.one_of(plain_curves, plain_curves.map(Reversed))


@st.composite
def racks(draw: st.DrawFn) -> BasicRack:
    """ISO 53 profiles and free racks whose rounding fits, some with relief."""
    relief = draw(st.one_of(st.none(), st.builds(TipRelief, numbers(0.003, 0.03), numbers(0.2, 0.6))))
    if draw(st.booleans()):
        return iso_53(draw(st.sampled_from(sorted(ISO_53))), relief=relief)
    alpha, addendum = math.radians(draw(numbers(14, 28))), draw(numbers(0.8, 1.1))
    clearance = draw(numbers(0.1, 0.35))
    largest = max(full_round_radius(alpha, addendum + clearance), 0.0)
    return BasicRack(alpha, addendum, clearance, largest * draw(numbers(0.05, 1.0)), relief)


@st.composite
def gears(draw: st.DrawFn) -> SpurGear:
    """Gears of ordinary proportions; those that cannot exist are left out."""
    rack = draw(racks())
    gear = SpurGear(
        module=draw(st.sampled_from((0.1, 1.0, 2.0, 10.0))),
        number_of_teeth=draw(st.integers(6, 120)),
        rack=rack,
        profile_shift_coefficient=draw(numbers(-0.3, 0.8)),
    )
    thinning = gear.module * draw(st.sampled_from((0.0, 0.02, 0.1)))
    gear = SpurGear(
        gear.module,
        gear.number_of_teeth,
        rack,
        gear.profile_shift_coefficient,
        circumferential_thinning=thinning,
        thinning_by_deeper_cut=draw(st.booleans()),
    )
    if not _exists(gear):
        gear = SpurGear(gear.module, 30, iso_53())
    return gear


def _exists(gear: SpurGear) -> bool:
    try:
        tooth_side(gear)
    except GeometryError:
        return False
    return True


hostile_numbers = st.one_of(
    st.sampled_from((0.0, -0.0, -1.0, 1e-300, -1e-300, 1e300, math.inf, -math.inf, math.nan)), numbers(-1e6, 1e6)
)


@st.composite
def hostile_gears(draw: st.DrawFn) -> SpurGear:
    """A sound gear with one parameter replaced by a number that nobody has checked."""
    keys = (
        "module",
        "profile_shift_coefficient",
        "given_tip_diameter",
        "circumferential_thinning",
        "tip_chamfer",
        "tip_rounding",
        "bore_diameter",
    )
    values: dict[str, object] = {"module": 2.0, "number_of_teeth": draw(st.integers(-3, 30)), "rack": iso_53()}
    values[draw(st.sampled_from(keys))] = draw(hostile_numbers)
    return SpurGear(**values)  # type: ignore[arg-type]


@st.composite
def hostile_racks(draw: st.DrawFn) -> BasicRack:
    """A rack with one number that nobody has checked."""
    values = {"pressure_angle": math.radians(20), "addendum": 1.0, "tip_clearance": 0.25, "tip_radius": 0.38}
    values[draw(st.sampled_from(sorted(values)))] = draw(hostile_numbers)
    return BasicRack(**values)


def with_default_cutter(gear: RingGear) -> RingGear:
    """A ring as a scene that names no cutter has it: of one that is given only the heights stay."""
    cutter = gear.root if isinstance(gear.root, PinionCutter) else None
    cutter = cutter or PinionCutter(gear.module, DEFAULT_CUTTER_TEETH[0], gear.pressure_angle)
    return settled_ring(replace(gear, root=cutter, any_cutter=True))
