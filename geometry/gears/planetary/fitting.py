"""The shifts that bring both meshes of a planetary set to one centre distance, and what keeps them from working.

Conditions are those of the blocking contours of external and internal pairs; rings are judged with a root that is
rounded as usual cutters do it, so that no cutter decides, but for the contact ratio of sets that are built. Helical
teeth are judged in their transverse section. Lengths in mm, shifts in (normal) modules of their own mesh.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property

from geometry.base.nearest import kept
from geometry.base.record import Record, replace
from geometry.gears.pairs.involute import off_root
from geometry.gears.planetary.sets import PlanetarySet, sine_of
from geometry.gears.shifts import external as blocking_contour
from geometry.gears.shifts.external import PairState, Requirements, ShiftPair
from geometry.gears.shifts.finder import AnyShiftPair, least_margin, margins, state_of
from geometry.gears.shifts.internal_shifts import (
    InternalShiftPair,
    InternalState,
    interferences,
    internal_state,
    ring_numbers,
)
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.cutter import CUTTER_ROUNDING, PinionCutter
from geometry.gears.teeth.limits import Margin
from geometry.gears.teeth.ring import RoundedRoot
from geometry.gears.teeth.ring_made import settled_ring
from geometry.gears.teeth.transverse import normal_angle, transverse_cutter, transverse_rack
from geometry.gears.teeth.transverse_ring import transverse_root

# modules: how far the distance is moved and the rims are shifted, in which steps
_FARTHEST, _MOST_SHIFT, _STEP = 1.5, 1.0, 0.05
# the rack of sets that are built; rings of others are made by cutters of their own
_BUILT = iso_53("A")
# of a margin of 0, what rounding leaves
_ROUNDING = 1e-9


class RimMesh(Record, dict=True):
    """One mesh of a set: a rim of the satellite with its central wheel, a ring where it is internal.

    ``module`` and ``reference``, the reference distance, in mm, of helical teeth the normal module; ``rack`` is that of
    their transverse section, the angle in rad.
    """

    central: int
    rim: int
    internal: bool
    module: float
    reference: float
    rack: BasicRack
    helix_angle: float = 0.0

    @property
    def span(self) -> int:
        """Sum or difference of the teeth: twice the reference distance in modules."""
        return self.central - self.rim if self.internal else self.central + self.rim

    @property
    def _share(self) -> float:
        return math.cos(self.helix_angle)

    def _in_ring(self, rounding: float | None) -> InternalShiftPair:
        root = transverse_root(RoundedRoot(radius=rounding), self.helix_angle)
        return InternalShiftPair(self.rim, self.central, self.rack, root, helix_angle=self.helix_angle)

    @cached_property
    def _rounded(self) -> tuple[InternalShiftPair, InternalShiftPair]:
        """In a ring whose root is rounded as a cutter does it, and in one of full rounds."""
        return self._in_ring(CUTTER_ROUNDING), self._in_ring(None)

    @cached_property
    def _external(self) -> ShiftPair:
        return ShiftPair(self.rim, self.central, self.rack, helix_angle=self.helix_angle)

    def _pair(self, central_shift: float) -> AnyShiftPair:
        if not self.internal:
            return self._external
        usual, full = self._rounded
        # a full round is less than usual where spaces are narrow
        return usual if ring_numbers(usual, central_shift).room >= 0 else full

    def shift_total(self, distance: float) -> float | None:
        """x_central + x_rim of an external mesh, x_central - x_rim of an internal one; None: below the base circles."""
        alpha = self.rack.pressure_angle
        cosine = self.reference / distance * math.cos(alpha)
        if cosine > 1:
            return None
        working = math.acos(cosine)
        # their cosines' difference is that of the distances: none at the reference distance, not even of rounding
        sine = (distance - self.reference) / distance * math.cos(alpha) / (2 * math.sin((working + alpha) / 2))
        apart = 2 * math.asin(sine)
        turned = math.sin(apart) / (cosine * math.cos(alpha)) - apart
        return turned * self.span / (2 * math.tan(alpha) * self._share)

    def central_shift(self, distance: float, rim_shift: float) -> float | None:
        """The central wheel's shift for a distance, mm, and the rim's shift."""
        total = self.shift_total(distance)
        if total is None:
            return None
        return total + rim_shift if self.internal else total - rim_shift

    def state(self, rim_shift: float, central_shift: float) -> PairState | InternalState:
        """The pair, rim first, in modules."""
        return state_of(self._pair(central_shift), rim_shift, central_shift)

    def margins(self, wish: Requirements, rim_shift: float, central_shift: float) -> tuple[Margin, ...]:
        """Every condition: the rim is the first, the central wheel the second."""
        return margins(self._pair(central_shift), wish, rim_shift, central_shift)

    def least_margin(self, wish: Requirements, rim_shift: float, central_shift: float) -> float:
        """The least margin of all conditions."""
        return least_margin(self._pair(central_shift), wish, rim_shift, central_shift)

    def rim_end(self, rim_shift: float, central_shift: float) -> float:
        """Where the rim's tips end, from its base circle along the line of action, in modules.

        In a ring as the cutter makes it that one without any named gets they keep off its fillets, which may begin
        sooner than those of a rounded root, as tips that nobody gave are made to.
        """
        if not self.internal:
            return blocking_contour.state_of(self._external, rim_shift, central_shift).tips[0]
        state = internal_state(self._rounded[0], rim_shift, central_shift)
        base = self.rim * math.cos(self.rack.pressure_angle) / (2 * self._share)
        most = self._made_reach(central_shift) - state.line
        if state.end <= most:
            return state.end
        tip = off_root(self.module * math.hypot(base, most), self.module / self._share) / self.module
        return math.sqrt(max(tip**2 - base**2, 0.0))

    def ratio_to(self, rim_shift: float, central_shift: float, end: float) -> float:
        """The contact ratio with the rim's tips cut down to ``end``, modules from its base circle."""
        state = self.state(rim_shift, central_shift)
        tip = state.end if isinstance(state, InternalState) else state.tips[0]
        return state.contact_ratio - max(tip - end, 0.0) * self._share / (math.pi * math.cos(self.rack.pressure_angle))

    def _made_reach(self, central_shift: float) -> float:
        """How far the ring's involute reaches as it is made, from the base circle along the line of action."""
        ring = self._rounded[0].ring(central_shift)
        usual = PinionCutter(1.0, 25, normal_angle(ring.pressure_angle, self.helix_angle))
        cutter = transverse_cutter(usual, self.helix_angle)
        return settled_ring(replace(ring, root=cutter, any_cutter=True)).cut_form_length

    def tips(self, rim_shift: float, central_shift: float) -> tuple[float, float]:
        """Radii, mm, that the rim's and the central wheel's teeth reach outwards: a ring's root, else tips."""
        state = self.state(rim_shift, central_shift)
        if isinstance(state, InternalState):
            return self.module * state.pinion.tip_radius, self.module * state.ring.root_radius
        height = self.rack.addendum / self._share - max(state.tip_shortening, 0.0)
        rim, central = (z / (2 * self._share) + height for z in (self.rim, self.central))
        return self.module * (rim + rim_shift), self.module * (central + central_shift)

    @cached_property
    def least_rim_shift(self) -> float:
        """x_min of the rim, cut by the rack, rounded up to four digits."""
        sine = math.sin(self.rack.pressure_angle)
        return math.ceil((self.rack.form_dedendum - self.rim * sine**2 / 2) / self._share * 1e4) / 1e4

    def clearing_shift(self) -> float | None:
        """The least equal shift of rim and ring, in hundredths, that clears the ring's tips of the rim's involutes."""
        pair, tried = self._rounded[0], (k / 100 for k in range(200))
        return next((x for x in tried if min(interferences(pair, x, x)[:2]) >= -_ROUNDING), None)

    @property
    def allowed_ring_addendum(self) -> float:
        """The most that an unshifted ring's teeth may stand inwards without involute interference, modules."""
        alpha, ring = self.rack.pressure_angle, self.central / 2
        return (ring - math.hypot(ring * math.cos(alpha), self.span / 2 * math.sin(alpha))) / self._share


class Fit(Record):
    """Both meshes at one distance, mm; ``shifts`` of z1, z2, z2', z3; ``gap`` between satellites' tips, mm."""

    meshes: tuple[RimMesh, RimMesh]
    distance: float
    shifts: tuple[float, float, float, float]
    gap: float
    least_gap: float
    wish: Requirements

    def states(self) -> tuple[PairState | InternalState, PairState | InternalState]:
        """Both pairs, rim first."""
        x1, x2, x2p, x3 = self.shifts
        return self.meshes[0].state(x2, x1), self.meshes[1].state(x2p, x3)

    def broken(self) -> tuple[tuple[Margin, ...], tuple[Margin, ...]]:
        """The conditions that each mesh does not keep, and with the first the neighbours' gap.

        Without a working pressure angle there is nothing else to judge.
        """
        x1, x2, x2p, x3 = self.shifts
        one, two = self.meshes

        def broken(mesh: RimMesh, rim: float, central: float) -> tuple[Margin, ...]:
            found = tuple(m for m in mesh.margins(self.wish, rim, central) if not m.margin >= -_ROUNDING)
            return found[:1] if found and found[0].name == "working_angle" else found

        first, second = broken(one, x2, x1), broken(two, x2p, x3)
        if self.gap < self.least_gap - _ROUNDING:
            return (*first, Margin.above("neighbours", self.gap, self.least_gap)), second
        return first, second

    @property
    def diameter(self) -> float:
        """What the set takes, mm: rings' root circles, and the circle that the satellites' tips reach."""
        (rim1, first), (rim2, second) = self._tips()
        return 2 * max(self.distance + rim1, self.distance + rim2, first, second)

    @property
    def most_satellites(self) -> int:
        """The most equally spaced satellites whose tips keep the least gap."""
        sine = (max(rim for rim, _ in self._tips()) + self.least_gap / 2) / self.distance
        return 1 if sine > 1 else math.floor(math.pi / math.asin(sine) + _ROUNDING)

    def _tips(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Of the rim and the central wheel of both meshes, as ``RimMesh.tips``."""
        x1, x2, x2p, x3 = self.shifts
        return self.meshes[0].tips(x2, x1), self.meshes[1].tips(x2p, x3)


class Fitting(Record):
    """How a set is fitted: normal rack and helix angle (rad), what its meshes keep, the distance wanted, if any, mm.

    ``apart``: the least angle between two satellites, parts of a turn, None where there is one only; their tips keep
    ``least_gap``, mm.
    """

    rack: BasicRack
    wish: Requirements
    apart: Fraction | None
    least_gap: float = 0.0
    distance: float | None = None
    helix_angle: float = 0.0

    def fit(self, teeth: PlanetarySet) -> Fit | None:
        """The fit with the least change of distance, then of shifts, that keeps everything; None: there is none."""
        meshes = self._meshes(teeth)
        return next((fit for a in self._distances(teeth) if (fit := self._at(teeth, meshes, a)) is not None), None)

    def plain(self, teeth: PlanetarySet, distance: float | None = None) -> Fit:
        """The fit at the distance that needs least, rims not shifted, whether it works or not."""
        meshes = self._meshes(teeth)
        a = next(self._distances(teeth)) if distance is None else distance
        one, two = (mesh.central_shift(a, 0.0) for mesh in meshes)
        nan = math.nan
        return self._made(meshes, a, (nan if one is None else one, 0.0, 0.0, nan if two is None else two))

    def made_ratios(self, fit: Fit, double: bool) -> tuple[float, ...] | None:
        """Contact ratios of both meshes of a fit as a scene makes them, which makes none of other racks."""
        if self.rack != _BUILT:
            return None
        rims = zip(_by_rim(fit.meshes, double), fit.shifts[1:3], strict=False)
        return tuple(ratio for meshes, x in rims for ratio in made_ratios(meshes, fit.distance, x))

    def _meshes(self, teeth: PlanetarySet) -> tuple[RimMesh, RimMesh]:
        z1, z2, z2p, z3 = teeth.teeth
        (one, two), beta = teeth.scheme.internal, self.helix_angle
        rack = transverse_rack(self.rack, beta)
        (m1, m2), (a1, a2) = map(float, teeth.modules), map(float, teeth.distances)
        return RimMesh(z1, z2, one, m1, a1, rack, beta), RimMesh(z3, z2p, two, m2, a2, rack, beta)

    def _distances(self, teeth: PlanetarySet) -> Iterator[float]:
        """From between both reference distances outwards, mm."""
        if self.distance is not None:
            yield self.distance
            return
        middle, step = float(sum(teeth.distances)) / 2, _STEP * float(max(teeth.modules))
        yield middle
        for k in range(1, round(_FARTHEST / _STEP) + 1):
            yield middle + k * step
            # of wheels hardly larger than their satellites it comes down to none
            if middle > k * step:
                yield middle - k * step

    def _at(self, teeth: PlanetarySet, meshes: tuple[RimMesh, RimMesh], distance: float) -> Fit | None:
        if any(mesh.shift_total(distance) is None for mesh in meshes):
            return None
        # tips reach the least at the least shift
        if not all(self._clear(mesh, distance, min(self._rim_shifts(mesh))) for mesh in meshes):
            return None
        rims = []
        for own in _by_rim(meshes, teeth.scheme.double):
            good = (x for x in self._rim_shifts(own[0]) if all(self._keeps(m, distance, x) for m in own))
            x = next((x for x in good if self._made_keep(own, distance, x)), None)
            if x is None:
                return None
            rims.append(x)
        return self._with(meshes, distance, (rims[0], rims[-1]))

    def _rim_shifts(self, mesh: RimMesh) -> list[float]:
        """The shifts of a rim that are tried, the least first; that at which it is no longer undercut among them."""
        least = -_MOST_SHIFT if self.wish.allow_undercut else mesh.least_rim_shift
        steps = range(1, round(_MOST_SHIFT / _STEP) + 1)
        tried = [0.0, *(sign * round(k * _STEP, 10) for k in steps for sign in (1, -1)), mesh.least_rim_shift]
        return sorted((x for x in tried if least <= x <= _MOST_SHIFT), key=lambda x: (abs(x), x))

    def _keeps(self, mesh: RimMesh, distance: float, rim_shift: float) -> bool:
        central = mesh.central_shift(distance, rim_shift)
        assert central is not None
        if abs(central) > 2 * _MOST_SHIFT or mesh.least_margin(self.wish, rim_shift, central) < -_ROUNDING:
            return False
        return self._clear(mesh, distance, rim_shift)

    def _made_keep(self, meshes: Sequence[RimMesh], distance: float, rim_shift: float) -> bool:
        """Whether the meshes of one rim keep the contact ratio as they are made."""
        if self.rack != _BUILT:
            return True
        least = self.wish.contact_ratio - _ROUNDING
        return kept(lambda x: min(made_ratios(meshes, distance, x)) >= least, rim_shift)

    def _clear(self, mesh: RimMesh, distance: float, rim_shift: float) -> bool:
        """Whether the tips of neighbours keep apart."""
        central = mesh.central_shift(distance, rim_shift)
        assert central is not None
        tip, _ = mesh.tips(rim_shift, central)
        return gap_between(distance, tip, self.apart) >= self.least_gap - _ROUNDING

    def _with(self, meshes: tuple[RimMesh, RimMesh], distance: float, rims: tuple[float, float]) -> Fit:
        one, two = (mesh.central_shift(distance, x) for mesh, x in zip(meshes, rims, strict=True))
        assert one is not None
        assert two is not None
        return self._made(meshes, distance, (one, rims[0], rims[1], two))

    def _made(self, meshes: tuple[RimMesh, RimMesh], distance: float, shifts: tuple[float, float, float, float]) -> Fit:
        x1, x2, x2p, x3 = shifts
        fit = Fit(meshes, distance, shifts, 0.0, self.least_gap, self.wish)
        tip = max(meshes[0].tips(x2, x1)[0], meshes[1].tips(x2p, x3)[0])
        return replace(fit, gap=gap_between(distance, tip, self.apart))


def _by_rim(meshes: tuple[RimMesh, RimMesh], double: bool) -> tuple[tuple[RimMesh, ...], ...]:
    """The meshes that share a rim: of double satellites each has its own."""
    return (meshes[:1], meshes[1:]) if double else (meshes,)


def made_ratios(meshes: Sequence[RimMesh], distance: float, rim_shift: float) -> tuple[float, ...]:
    """Contact ratios of all meshes of one rim as they are made, its tips cut by the mesh that leaves them least."""
    centrals = [mesh.central_shift(distance, rim_shift) or 0.0 for mesh in meshes]
    end = min(mesh.rim_end(rim_shift, x) for mesh, x in zip(meshes, centrals, strict=True))
    return tuple(mesh.ratio_to(rim_shift, x, end) for mesh, x in zip(meshes, centrals, strict=True))


def gap_between(distance: float, tip: float, apart: Fraction | None) -> float:
    """Between the tips of neighbours, mm; inf of one satellite alone."""
    return math.inf if apart is None else 2 * (distance * float(sine_of(apart)) - tip)
