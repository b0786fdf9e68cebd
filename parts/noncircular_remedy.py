"""Refused noncircular gears: the key to change and a value of it that works."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import msgspec

from geometry.errors import GeometryError, ParameterError, at_least, at_most

if TYPE_CHECKING:
    from parts.noncircular_gear import NoncircularGearSpec

MOST_TEETH = 2000
_BISECTIONS = 24
NOT_CLOSED = "the mate closes where it has a whole number of lobes"
# numbers of teeth that are tried for a mate
_OFFERS = 6
# shares of an axis ratio's way from a circle that are tried for a rounder one
_FINE_STEPS = (0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.05)


def with_gear_remedy(spec: NoncircularGearSpec, refusal: ParameterError) -> ParameterError:
    """A refused gear in the key to change: amplitudes of a concave ratio, thinning, or the number of teeth."""
    if "works" in refusal.allowed:
        return refusal
    reason = refusal.allowed
    if spec.centrode == "ratio" and refusal.name == "centrode":
        share = largest(lambda v: builds(_with_amplitudes(spec, v)), 1.0)
        key = "ratio_cosines" if spec.ratio_cosines else "ratio_sines"
        smaller = _with_amplitudes(spec, math.floor(share * 1e4) / 1e4)
        if spec.ratio_cosines and spec.ratio_sines:
            # both lists shrink together
            lists = ", ".join(f"{k} = {_listed(getattr(smaller, k))}" for k in ("ratio_cosines", "ratio_sines"))
            return ParameterError(key, getattr(spec, key), f"{reason}; with {lists} it works")
        return ParameterError(key, getattr(spec, key), f"{reason}; {_listed(getattr(smaller, key))} works")
    if spec.circumferential_thinning > 0 and builds(msgspec.structs.replace(spec, circumferential_thinning=0.0)):
        most = largest(
            lambda v: builds(msgspec.structs.replace(spec, circumferential_thinning=v)), spec.circumferential_thinning
        )
        text = f"{reason}; at most {at_most(most, 4)} mm works"
        return ParameterError("circumferential_thinning", spec.circumferential_thinning, text)
    if spec.profile_shift_coefficient and builds(msgspec.structs.replace(spec, profile_shift_coefficient=0.0)):
        x = spec.profile_shift_coefficient
        most = largest(lambda v: builds(msgspec.structs.replace(spec, profile_shift_coefficient=v)), x)
        told = f"at most {at_most(most, 4)}" if x > 0 else f"at least {at_least(most, 4)}"
        return ParameterError("profile_shift_coefficient", x, f"{reason}; {told} works")
    z = spec.number_of_teeth
    other = spec.mate_number_of_teeth or z
    for times in range(2, 40):
        more = _teeth(spec, math.ceil(z * (1 + times / 8)), other / z)
        if more is None or more.number_of_teeth <= z:
            # the most teeth that there may be
            break
        if builds(more):
            text = f"{reason}; {more.number_of_teeth} teeth of the same centrode work"
            if spec.mate_number_of_teeth is not None:
                text += f" with mate_number_of_teeth = {more.mate_number_of_teeth}"
            return ParameterError("number_of_teeth", z, text)
    return _rounder(spec, reason) or ParameterError("number_of_teeth", z, f"{reason}; a rounder centrode works")


def _rounder(spec: NoncircularGearSpec, reason: str) -> ParameterError | None:
    """The least round of the centrodes that work, to a share of how far the refused one is from a circle."""
    key = "axis_ratio" if spec.eccentricity is None else "eccentricity"
    asked = getattr(spec, key)
    if spec.centrode == "ratio" or asked is None:
        return None
    round_one = 1.0 if key == "axis_ratio" else 0.0
    # 1 - e counts where e is near 1
    tried = [1 + (asked - 1) * k for k in _FINE_STEPS] if round_one else [1 - (1 - asked) * 2**k for k in range(16)]
    for value in tried:
        told = at_most(value, 5)
        if round_one < float(told) < asked and builds(msgspec.structs.replace(spec, **{key: float(told)})):
            return ParameterError(key, asked, f"{reason}; at most {told} works")
    return None


def _listed(values: list[float]) -> str:
    return f"[{', '.join(f'{v:.9g}' for v in values)}]"


def with_closing_mate(spec: NoncircularGearSpec, refusal: ParameterError) -> ParameterError:
    """A mate that does not close: the nearest number of teeth with which it does, and both gears can be cut."""
    mate = spec.role == "mate"
    other = spec.mate_number_of_teeth or spec.number_of_teeth
    asked, driver = (spec.number_of_teeth, other) if mate else (other, spec.number_of_teeth)
    lobes = spec.lobes or (2 if spec.centrode == "oval" else 1)
    step = driver // math.gcd(driver, lobes)
    offers = sorted((k * step for k in range(1, MOST_TEETH // step + 1)), key=lambda z: abs(z - asked))
    for teeth in (z for z in offers[:_OFFERS] if z >= 3):
        pair = (("driver", driver, teeth), ("mate", teeth, driver))
        keys = ({"role": r, "number_of_teeth": a, "mate_number_of_teeth": b} for r, a, b in pair)
        # a shift of one gear is the other's with its sign turned
        signs = (-1 if mate else 1, 1 if mate else -1)
        shifts = (sign * spec.profile_shift_coefficient for sign in signs)
        if all(
            builds(msgspec.structs.replace(spec, **k, profile_shift_coefficient=x))
            for k, x in zip(keys, shifts, strict=True)
        ):
            return ParameterError(refusal.name, refusal.value, f"{NOT_CLOSED}; {teeth} works")
    return ParameterError(refusal.name, refusal.value, f"{NOT_CLOSED}; a rounder centrode has one")


def _teeth(spec: NoncircularGearSpec, teeth: int, ratio: float) -> NoncircularGearSpec | None:
    """The same gear with more teeth, its mate's in proportion, and of the same kind for two equal ones."""
    if spec.mate_number_of_teeth is None:
        lobes = spec.lobes or (2 if spec.centrode == "oval" else 1)
        fitting = lobes * (2 * math.ceil((teeth / lobes - 1) / 2) + 1)
        return msgspec.structs.replace(spec, number_of_teeth=min(fitting, MOST_TEETH))
    step = spec.number_of_teeth // math.gcd(spec.number_of_teeth, spec.mate_number_of_teeth)
    teeth = math.ceil(teeth / step) * step
    mate = round(teeth * ratio)
    if max(teeth, mate) > MOST_TEETH:
        return None
    return msgspec.structs.replace(spec, number_of_teeth=teeth, mate_number_of_teeth=mate)


def _with_amplitudes(spec: NoncircularGearSpec, share: float) -> NoncircularGearSpec:
    return msgspec.structs.replace(
        spec,
        ratio_cosines=[share * x for x in spec.ratio_cosines or ()],
        ratio_sines=[share * x for x in spec.ratio_sines or ()],
    )


def largest(works: Callable[[float], bool], refused: float) -> float:
    """The value between 0, which is hoped to work, and a refused one that still works."""
    low, high = 0.0, refused
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if works(middle) else (low, middle)
    return low


def builds(spec: NoncircularGearSpec) -> bool:
    """Whether a gear of these keys can be cut."""
    from parts.noncircular_gear import gear_of

    try:
        gear_of(spec).outline  # noqa: B018
    except GeometryError:
        return False
    return True
