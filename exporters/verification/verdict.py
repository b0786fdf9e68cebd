"""What a read-back says of a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from types import MappingProxyType
from typing import ParamSpec

from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from parts.base.readback import ReadError
from parts.base.texts import N_, unless

# rounding of the measurement itself, as a part of the section's size
_ROUNDING = 1e-13
# what volumes are good to, part of them, and how far a file's rounding moves a surface, mm
_VOLUME, _LAST_DECIMAL = 1e-9, 1e-9


class Verdict(Record):
    """What was measured on a file, and what is wrong with it (nothing: it is good); ``findings``: worth a remark."""

    measured: dict[str, float]
    failures: tuple[str, ...]
    findings: tuple[Finding, ...] = ()

    def also(self, failures: Iterable[str], measured: Mapping[str, float] = MappingProxyType({})) -> Verdict:
        """With what else is wrong, and was measured."""
        return replace(self, measured={**self.measured, **measured}, failures=(*self.failures, *failures))


P = ParamSpec("P")


def of_readable(verify: Callable[P, Verdict]) -> Callable[P, Verdict]:
    """What holds a file to account; of one that cannot be read its verdict is why."""

    @wraps(verify)
    def held(*told: P.args, **named: P.kwargs) -> Verdict:
        try:
            return verify(*told, **named)
        except (ReadError, OSError) as error:
            return Verdict({}, (str(error),))

    return held


def judges(measured: Mapping[str, float]) -> list[str]:
    """Who has judged a file, by what was measured on it: our own reader, and the CAD kernel."""
    return [*(["reader"] if measured else []), *(["kernel"] if "kernel_volume_error" in measured else [])]


def deviation_failures(worst: float, declared: float, tolerance: float, reach: float) -> list[str]:
    """What is wrong with a deviation, mm: more than the tolerance, or more than was declared."""
    allowed = _ROUNDING * reach
    told = N_("deviates by {worst:.6g} mm from the exact outline; the tolerance is {tolerance:g} mm")
    beyond = unless(worst <= tolerance + allowed, told, worst=worst, tolerance=tolerance)
    told = N_("deviates by {worst:.6g} mm, more than the declared {declared:.6g} mm")
    return beyond or unless(worst <= declared + allowed, told, worst=worst, declared=declared)


def precision_failures(said: float, precision: float) -> list[str]:
    """What is wrong with the distance within which a file calls points one, mm."""
    told = N_("calls points one within {said:g} mm instead of {precision:g} mm")
    return unless(said == precision, told, said=said, precision=precision)


def volume_bound(exact: float, area: float, walls: float, declared: float) -> float:
    """How much the volume of a file may differ at most, mm^3, whose ``walls`` are off by up to what is ``declared``.

    ``area``: of all faces, which rounding moves; ``walls``: mm^2 that a mm on all walls changes of the volume.
    """
    return _VOLUME * exact + _LAST_DECIMAL * area + declared * walls


def volume_failures(volume: float, exact: float, bound: float, said: str | float | None) -> list[str]:
    """What is wrong with a volume, mm^3: measured off by more than a bound, or told in the file as another."""
    told = N_("volume {volume:.12g} mm^3 instead of {exact:.12g} mm^3")
    failures = unless(abs(volume - exact) <= bound, told, volume=volume, exact=exact)
    near = said is None or abs(float(said) - exact) <= bound
    told = N_("says that its volume is {said} mm^3 instead of {exact:.12g} mm^3")
    return failures + unless(near, told, said=said, exact=exact)
