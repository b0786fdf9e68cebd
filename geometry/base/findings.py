"""What was noticed about a legal but remarkable geometry: a code and the numbers behind it."""

from __future__ import annotations

from geometry.base.record import Record
from geometry.base.tolerance import is_told


class Finding(Record):
    """A remark with a stable code; ``value`` is what was found, ``limit`` what it is held against.

    The words for each code stand with the reports, in every language of the project.
    """

    code: str
    value: float
    limit: float


# of a limit above 0: what differences of sizes as they are typed lose to rounding
_ROUNDING = 1e-9


def short_of(code: str, value: float, limit: float) -> tuple[Finding, ...]:
    """The remark on a value that does not reach its limit; by rounding, or as the limit is told, it does."""
    return (Finding(code, value, limit),) if value < limit * (1 - _ROUNDING) and not is_told(value, limit) else ()


def beyond(code: str, value: float, limit: float) -> tuple[Finding, ...]:
    """The remark on a value beyond its limit; by rounding, or as the limit is told, it is not."""
    return (Finding(code, value, limit),) if value > limit * (1 + _ROUNDING) and not is_told(value, limit) else ()
