"""How a ring is made: by its cutter, by a usual one where none is named, with a tip that this cutter leaves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache, partial

from geometry.base.errors import GeometryError, ParameterError
from geometry.base.nearest import last_that_holds
from geometry.base.record import replace
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import TOLERANCES
from geometry.gears.teeth.cutter import PinionCutter, checked_cutter
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_tooth import ring_side, rounded_root_plug

# teeth of a cutter that nobody named, in the order in which they are tried; then any number from the most downwards
DEFAULT_CUTTER_TEETH = (100, 80, 64, 50, 40, 32, 25, 20, 16, 12, 10, 8)
LEAST_CUTTER_TEETH = 8
# modules; a cutter whose tooth is thinner at its tip is made shorter until it has this
_CUTTER_TIP_LAND = 0.1
# modules; a default tip yields to what a cutter leaves as long as so much stays inside the shifted reference circle
LEAST_RING_ADDENDUM = 0.25


def generation(gear: RingGear) -> InternalMesh | None:
    """The mesh of ring and cutter at full depth; None for a rounded root."""
    cutter = gear.cutter
    if cutter is None:
        return None
    return InternalMesh(
        (cutter.number_of_teeth, gear.number_of_teeth),
        (cutter.base_radius, gear.base_radius),
        (cutter.tip_radius, gear.tip_radius),
        gear.generating_distance,
        gear.generating_angle,
    )


def check_made(gear: RingGear) -> None:
    """Refuse a ring that its cutter cannot make, or whose teeth cannot exist; the rim is another matter."""
    if isinstance(gear.root, RoundedRoot):
        _check_rounded(gear)
    else:
        checked_cutter(gear.cutter or gear.root)
    mesh = generation(gear)
    ring_side(gear)
    if mesh is None:
        return
    rounding = 1e3 * TOLERANCES.relative_rounding * gear.root_radius
    for margin in mesh.margins():
        if margin.margin < -rounding:
            cutter = gear.root
            assert isinstance(cutter, PinionCutter)
            raise ParameterError("cutter.number_of_teeth", cutter.number_of_teeth, f"cutter_{margin.name}")


def _check_rounded(gear: RingGear) -> None:
    """The space as a tooth of its own must take its root rounding."""
    try:
        plug = rounded_root_plug(gear)
        checked_cutter(plug)
    except ParameterError as refusal:
        name = "root.radius" if refusal.name == "cutter.tip_rounding" else "root.dedendum"
        told = refusal.renamed(name)
        told.code = refusal.code.replace("cutter_", "space_")
        raise told from refusal


def makes(gear: RingGear) -> bool:
    """Whether the ring can be made, by any cutter and with a shallower default tip where nobody named them."""
    return next(_made(gear), None) is not None or _with_yielding_tip(gear) is not None


def settled_ring(gear: RingGear) -> RingGear:
    """The ring with a cutter where nobody named one, and with a default tip that its cutter leaves.

    The cutter is the largest usual one that can make the ring, else the largest that can: the larger, the farther out
    the involute reaches, and the fewer pinions touch the fillets. Where no cutter at all can make the default tip, the
    tip is the deepest that can be made (``least_tip_diameter``). A ring that nothing can make keeps any cutter, which
    then tells what is in the way.
    """
    if not (0 < gear.pressure_angle < math.pi / 2 and 0 < gear.module < math.inf):
        return gear
    return next(_made(gear), None) or _with_yielding_tip(gear) or next(_with_cutters(gear), gear)


def _made(gear: RingGear) -> Iterator[RingGear]:
    """The ring with each cutter that can make it."""
    for tried in _with_cutters(gear):
        try:
            check_made(tried)
        except GeometryError:
            continue
        yield tried


def _with_cutters(gear: RingGear) -> Iterator[RingGear]:
    """The ring itself, or with every cutter that may be tried where nobody named one: usual ones, then the others."""
    if not gear.any_cutter or not isinstance(gear.root, PinionCutter):
        yield gear
        return
    usual = [tried for teeth in DEFAULT_CUTTER_TEETH if (tried := _with_teeth(gear, teeth)) is not None]
    yield from usual
    if any(_clears(tried, tried.tip_radius) for tried in usual):
        # what is wrong then is no matter of the cutter
        return
    for teeth in range(min(gear.number_of_teeth - 1, DEFAULT_CUTTER_TEETH[0]), LEAST_CUTTER_TEETH - 1, -1):
        tried = None if teeth in DEFAULT_CUTTER_TEETH else _with_teeth(gear, teeth)
        if tried is not None and _clears(tried, tried.tip_radius):
            yield tried


def _with_teeth(gear: RingGear, teeth: int) -> RingGear | None:
    """The ring with its cutter of another number of teeth; None where that is none."""
    assert isinstance(gear.root, PinionCutter)
    cutter = _fitted(gear.root, teeth) if teeth < gear.number_of_teeth else None
    return None if cutter is None else replace(gear, root=cutter)


@lru_cache(maxsize=1024)
def _fitted(cutter: PinionCutter, teeth: int) -> PinionCutter | None:
    """A cutter with another number of teeth, as high as its tooth can be, the rounding made to fit."""
    sharp = replace(cutter, number_of_teeth=teeth, tip_rounding=0.0)

    def spare(addendum: float) -> float:
        high = replace(sharp, addendum=addendum)
        return 2 * high.corner_angle * high.tip_radius - _CUTTER_TIP_LAND * high.module

    low = (sharp.base_radius - sharp.reference_radius) / sharp.module - sharp.profile_shift_coefficient
    low = max(low, 0.0)
    if low >= sharp.addendum or spare(low) <= 0:
        return None
    if spare(sharp.addendum) < 0:
        sharp = replace(sharp, addendum=bracketed_root(spare, low, sharp.addendum).value)
    room = sharp.largest_rounding()
    return replace(sharp, tip_rounding=min(cutter.tip_rounding, room)) if room > 0 else None


def _clears(gear: RingGear, tip_radius: float) -> bool:
    """Whether the ring's cutter clears tips of a radius, mm; what has no cutter only needs an involute there."""
    try:
        mesh = generation(gear)
    except GeometryError:
        return False
    if mesh is None:
        return tip_radius >= gear.base_radius
    mesh = replace(mesh, tip_radii=(mesh.tip_radii[0], tip_radius))
    return tip_radius >= gear.base_radius and min(m.margin for m in mesh.margins()) >= 0


def _with_yielding_tip(gear: RingGear) -> RingGear | None:
    """The ring with the deepest tip that can be made, if its default one cannot; None where that does not help."""
    if gear.given_tip_diameter is not None or not gear.default_tip_radius > 0:
        return None
    cutters, others = [gear], [gear]
    if isinstance(gear.root, PinionCutter):
        # a named cutter that trims tips which a usual one leaves is to blame itself
        root = PinionCutter(gear.module, 25, gear.pressure_angle, addendum=gear.root.addendum)
        plain = gear if gear.any_cutter else replace(gear, root=root)
        others = [g for t in DEFAULT_CUTTER_TEETH if (g := _with_teeth(plain, t)) is not None]
        cutters = others if gear.any_cutter else cutters
    if any(_clears(cut, gear.default_tip_radius) for cut in (*cutters, *others)):
        # what is wrong then is no matter of the tip
        return None
    shallowest = gear.reference_radius + (gear.profile_shift_coefficient - LEAST_RING_ADDENDUM) * gear.module
    tried = _deepest_tips(cutters, shallowest)
    if tried and len(cutters) > 1:
        best = min(tried, key=lambda pair: pair[0])[1].root
        assert isinstance(best, PinionCutter)
        teeth = range(max(best.number_of_teeth - 8, LEAST_CUTTER_TEETH), best.number_of_teeth + 9)
        tried = _deepest_tips([g for t in teeth if (g := _with_teeth(gear, t)) is not None], shallowest)
    for tip, cut in sorted(tried, key=lambda pair: pair[0]):
        shallower = replace(cut, least_tip_diameter=2 * tip)
        try:
            check_made(shallower)
        except GeometryError:
            continue
        return shallower
    return None


def _deepest_tips(cutters: list[RingGear], shallowest: float) -> list[tuple[float, RingGear]]:
    """The least tip radius, mm, that each ring's cutter clears, where there is one."""
    return [(tip, cut) for cut in cutters if (tip := _deepest_tip(cut, shallowest)) is not None]


def _deepest_tip(gear: RingGear, shallowest: float) -> float | None:
    """The least tip radius, mm, that the ring's cutter clears, not beyond ``shallowest``; None: not even that."""
    good, bad = shallowest, gear.default_tip_radius
    if bad >= good or not _clears(gear, good):
        return None
    return last_that_holds(partial(_clears, gear), bad, good, 40)
