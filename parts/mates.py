"""From the mates of a scene to pairs. A mate may change a part only in its tip diameter and its thinning.

Both happen before any region is built: the shortest tip and the largest thinning that any mate asks for win.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from geometry.errors import GeometryError, ParameterError, at_least, at_most
from parts.joints import JOINTS
from parts.lazy import LazyTable
from parts.mate_keys import ExternalGearPairSpec, InternalGearPairSpec, RackPairSpec
from parts.mate_kinds import ExternalMating, InternalMating, Mating, RackMating

# the keys of every kind of mate
MATES = LazyTable(
    {
        "external_gear_pair": ("parts.mate_keys", "ExternalGearPairSpec"),
        "internal_gear_pair": ("parts.mate_keys", "InternalGearPairSpec"),
        "rack_pair": ("parts.mate_keys", "RackPairSpec"),
        **{kind: joint.spec_at for kind, joint in JOINTS.items()},
    }
)
# what each kind of mate joins, first and second in every order that works; None: anything
JOINS: dict[str, tuple[tuple[str, str], ...] | None] = {
    "external_gear_pair": (("spur_gear", "spur_gear"),),
    "internal_gear_pair": (("ring_gear", "spur_gear"), ("spur_gear", "ring_gear")),
    "rack_pair": (("spur_gear", "rack"),),
    **{kind: joint.joins for kind, joint in JOINTS.items()},
}
# mates that change their gears' tips and thinning
GEAR_PAIRS = (ExternalGearPairSpec, InternalGearPairSpec, RackPairSpec)


def mated(
    gears: dict[str, Any], mates: list[Any], part_of: dict[str, str], helices: Mapping[str, float] | None = None
) -> tuple[dict[str, Any], list[Mating]]:
    """The gears as their mates want them, and the pairs of them.

    ``gears`` by part, ``part_of`` the part of every instance that ``mates`` name; ``helices`` the helix angle of parts
    whose gears are transverse sections, rad.

    Raises
    ------
    ParameterError
        Two gears cannot mesh; names the key of the second gear, or of the mate as ``mate.KEY``, and what would work.
    """
    toothed = [m for m in mates if isinstance(m, GEAR_PAIRS)]
    shares = [_normal_share(gears[part_of[m.first]], (helices or {}).get(part_of[m.first], 0.0)) for m in toothed]
    thinning = [m for m in mates if m in toothed or JOINTS[m.__struct_config__.tag].thins]
    share_of = {id(m): share for m, share in zip(toothed, shares, strict=True)}
    final = _thinned(gears, thinning, part_of, [share_of.get(id(m), 1.0) for m in thinning])
    pairs = [_pair(m, final[part_of[m.first]], final[part_of[m.second]]) for m in toothed]
    for mate, pair in zip(toothed, pairs, strict=True):
        if isinstance(mate, ExternalGearPairSpec):
            for name, gear in ((part_of[mate.first], pair.first), (part_of[mate.second], pair.second)):
                if gear.tip_radius < final[name].tip_radius:
                    final[name] = replace(final[name], given_tip_diameter=2 * gear.tip_radius)
                    _check_shortened(final[name], (pair.first, pair.second), mate.working_centre_distance)
    left = iter(zip(pairs, shares, strict=True))
    matings: list[Mating] = []
    for mate in mates:
        first, second = final[part_of[mate.first]], final[part_of[mate.second]]
        if isinstance(mate, GEAR_PAIRS):
            pair, share = next(left)
            matings.append(replace(_mating(mate, pair, first, second), normal_share=share))
        else:
            matings.append(JOINTS[mate.__struct_config__.tag].mating(mate, first, second))
    return final, matings


def _check_shortened(gear: Any, pair: tuple[Any, Any], distance: float | None) -> None:
    """Refuse a pair whose tip shortening leaves nothing of the involute, with the second's shift that would do."""
    from geometry.gears.pair import external_pair
    from parts.helix_keys import nearest_working

    def works(shift: float) -> bool:
        tried = external_pair(pair[0], replace(pair[1], profile_shift_coefficient=shift), distance)
        for one in (tried.first, tried.second):
            _build(one)
        return tried.contact_ratio > 0

    try:
        _build(gear)
    except GeometryError as fault:
        given = pair[1].profile_shift_coefficient
        found, text = nearest_working(works, given, 0.05), "other shifts of both gears work"
        if found is not None:
            text = (
                f"at {'most' if found < given else 'least'} {(at_most if found < given else at_least)(found, 4)} works"
            )
        reason = "the tips that the pair shortens keep no involute"
        raise ParameterError("profile_shift_coefficient", given, f"{reason}; {text}") from fault


def _normal_share(gear: Any, helix: float) -> float:
    """j_bn over the backlash that a pair of transverse sections has."""
    if not helix:
        return 1.0
    from geometry.gears.transverse import normal_share

    return normal_share(_pressure_angle(gear), helix)


def _pair(mate: Any, first: Any, second: Any) -> Any:
    """The pair of a mate, the mathematics loaded only for the kinds that a scene has."""
    distance, reason = mate.working_centre_distance, "the teeth do not reach each other"
    try:
        pair = _pair_at(mate, first, second, distance)
        if distance is None or pair.contact_ratio > 0:
            return pair
    except ParameterError as refusal:
        if distance is None or refusal.name != "mate.working_centre_distance":
            raise
        reason = refusal.allowed.partition(";")[0]
    nominal = _pair_at(mate, first, second, None)
    wanted = min(1.0, nominal.contact_ratio)

    def reaches(at: float) -> bool:
        try:
            return bool(_pair_at(mate, first, second, at).contact_ratio >= wanted)
        except ParameterError:
            return False

    low, high = nominal.distance if hasattr(nominal, "distance") else nominal.working_centre_distance, distance
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if reaches(middle) else (low, middle)
    limit = f"at most {at_most(low, 4)}" if distance > low else f"at least {at_least(low, 4)}"
    raise ParameterError("mate.working_centre_distance", distance, f"{reason}; {limit} mm works")


def _pair_at(mate: Any, first: Any, second: Any, distance: float | None) -> Any:
    try:
        if isinstance(mate, ExternalGearPairSpec):
            from geometry.gears.pair import external_pair

            return external_pair(first, second, distance)
        if isinstance(mate, InternalGearPairSpec):
            from geometry.gears.internal_pair import internal_pair

            pinion, ring = _pinion_and_ring(first, second)
            return internal_pair(pinion, ring, distance)
        from geometry.gears.rack_pair import rack_pair

        return rack_pair(first, second, distance)
    except ParameterError as error:
        if error.name == "working_centre_distance":
            raise ParameterError("mate.working_centre_distance", error.value, error.allowed) from error
        raise


def _mating(mate: Any, pair: Any, first: Any, second: Any) -> ExternalMating | InternalMating | RackMating:
    """The mate with its gears as they are built at last."""
    if isinstance(mate, ExternalGearPairSpec):
        return ExternalMating(mate.first, mate.second, mate.direction_deg, replace(pair, first=first, second=second))
    if isinstance(mate, InternalGearPairSpec):
        pinion, ring = _pinion_and_ring(first, second)
        whole = replace(pair, pinion=pinion, ring=ring)
        return InternalMating(mate.first, mate.second, mate.direction_deg, whole, ring is first)
    return RackMating(mate.first, mate.second, mate.direction_deg, replace(pair, gear=first, rack=second))


def _pinion_and_ring(first: Any, second: Any) -> tuple[Any, Any]:
    from geometry.gears.ring import RingGear

    return (second, first) if isinstance(first, RingGear) else (first, second)


def _thinned(gears: dict[str, Any], mates: list[Any], part_of: dict[str, str], shares: list[float]) -> dict[str, Any]:
    """The gears with the thinning that their mates' backlash asks for: half each, unless a part sets its own."""
    asked: dict[str, float] = {}
    for mate, normal_share in zip(mates, shares, strict=True):
        if mate.normal_backlash is None:
            continue
        names = part_of[mate.first], part_of[mate.second]
        bare = [replace(gears[n], circumferential_thinning=0.0) for n in names]
        angle = _pressure_angle(bare[0])
        # backlash that the distance alone gives goes before thinning
        given = _backlash_at(mate, bare[0], bare[1])
        total = (mate.normal_backlash / normal_share - given) / math.cos(angle)
        own = [gears[n].circumferential_thinning for n in names]
        free = [n for n, thinning in zip(names, own, strict=True) if thinning == 0]
        rest = total - sum(own)
        if rest < -1e-12 * gears[names[0]].module:
            least = ((sum(own) * math.cos(angle)) + given) * normal_share
            text = f"the gears' own thinning and distance give more; at least {at_least(least)} mm works"
            raise ParameterError("mate.normal_backlash", mate.normal_backlash, text)
        if not free:
            continue
        terms = (sum(own), len(free), given, math.cos(angle), normal_share)
        share = _possible([gears[n] for n in free], rest / len(free), mate, terms)
        for name in free:
            asked[name] = max(asked.get(name, 0.0), share)
    return {n: replace(g, circumferential_thinning=asked[n]) if asked.get(n) else g for n, g in gears.items()}


def _possible(free: list[Any], share: float, mate: Any, terms: tuple[float, int, float, float, float]) -> float:
    """A thinning of each gear that leaves whole teeth, mm; else refused with the largest backlash that does."""

    def whole(thinning: float) -> bool:
        try:
            for gear in free:
                _build(replace(gear, circumferential_thinning=thinning))
        except GeometryError:
            return False
        return True

    if share <= 0 or whole(share):
        return share
    low, high = 0.0, share
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if whole(middle) else (low, middle)
    own, number, given, cosine, normal_share = terms
    most = ((own + number * low) * cosine + given) * normal_share
    text = f"leaves no whole teeth; at most {at_most(most, 4)} mm works"
    raise ParameterError("mate.normal_backlash", mate.normal_backlash, text)


def _build(gear: Any) -> None:
    """Build a tooth of any kind of gear."""
    from geometry.gears.rack import Rack
    from geometry.gears.spur import SpurGear

    if isinstance(gear, SpurGear):
        from geometry.gears.tooth import tooth_side

        tooth_side(gear)
    elif isinstance(gear, Rack):
        from geometry.gears.rack import checked_part_rack

        checked_part_rack(gear)
    elif hasattr(gear, "outline"):
        gear.outline  # noqa: B018
    else:
        from geometry.gears.ring_limits import checked_ring

        checked_ring(gear)


def _backlash_at(mate: Any, first: Any, second: Any) -> float:
    """Backlash of two gears without thinning at the mate's centre distance, mm; negative distances are refused."""
    asked = getattr(mate, "working_centre_distance", None)
    return _pair(mate, first, second).normal_backlash if asked is not None else 0.0


def _pressure_angle(gear: Any) -> float:
    return gear.rack.pressure_angle if hasattr(gear, "rack") else gear.pressure_angle
