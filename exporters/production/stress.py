"""``higherpair stress``: how many digits are left where a size is driven to its extreme.

Rounded inputs and a rounded result alone leave an error of u (sum |x df/dx| + |f|), u = 2^-53. What stays within ten
times that is stable: no other way of computing with these numbers does essentially better (N. J. Higham, Accuracy and
Stability of Numerical Algorithms, 1.6).
"""

from __future__ import annotations

import csv
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from exporters.production.plot import Series, write_loglog
from geometry.base.record import Record
from parts.base.refusal import SceneError
from parts.base.texts import Words

if TYPE_CHECKING:
    from exporters.production.atlas import Case, Number

_ROUNDING, _TIMES = 2.0**-53, 10.0
# of an input, for the differences that its sensitivity is told by: the truth has 50 digits
_STEP = 20
# an error below this is drawn as this
_LEAST = 1e-18


class Row(Record):
    """A case at one value: the result and its error in its own unit, ``condition``: sum |x df/dx| / |f|; the error
    that is allowed, as ten roundings of inputs and result make it.
    """

    case: str
    varied: str
    value: float
    result: complex
    error: float
    condition: float
    bound: float

    @property
    def is_stable(self) -> bool:
        """Whether it is within what rounding explains."""
        return self.error <= self.bound

    @property
    def relative(self) -> float:
        """The error in parts of the result."""
        return self.error / abs(self.result) if self.result else 0.0

    @property
    def numbers(self) -> tuple[float, ...]:
        """The result, of a complex one both parts."""
        return (self.result.real, self.result.imag) if self.result.imag else (self.result.real,)

    @property
    def told(self) -> dict[str, object]:
        """The row as CSV and JSON have it."""
        return {
            "case": self.case, "varied": self.varied, "value": self.value, "result": self.numbers, "error": self.error,
            "condition": self.condition, "allowed": self.bound, "stable": self.is_stable,
        }  # fmt: skip


def atlas() -> list[Row]:
    """Every case at every value.

    Raises
    ------
    SceneError
        mpmath, which the truth is computed by, is not installed.
    """
    if find_spec("mpmath") is None:
        raise SceneError("stress", "", None, "needs_mpmath")
    from exporters.production.atlas import CASES

    return [row_of(case, value) for case in CASES for value in case.values]


def row_of(case: Case, value: float) -> Row:
    """A case at one value."""
    from exporters.production.atlas import MP

    given = case.inputs(value)
    ours = complex(case.ours(*given))
    exact = [MP.mpf(x) if isinstance(x, float) else x for x in given]
    truth = case.truth(*exact)
    moved = sum(_sensitivity(case, exact, place) for place, x in enumerate(given) if isinstance(x, float))
    size = abs(truth)
    allowed = _TIMES * _ROUNDING * float(moved + max(size, case.size(*given)))
    condition = float(moved / size) if size else float("inf")
    return Row(case.name, case.varied, value, ours, float(abs(MP.mpmathify(ours) - truth)), condition, allowed)


def _sensitivity(case: Case, exact: list[Number], place: int) -> Number:
    """|x df/dx| of one input, by a central difference."""
    x = exact[place]
    if x == 0:
        return 0
    step = x * type(x)(10) ** -_STEP
    ahead, behind = ([*exact[:place], x + h, *exact[place + 1 :]] for h in (step, -step))
    return abs(case.truth(*ahead) - case.truth(*behind)) / (2 * abs(step)) * abs(x)


def write_stress(folder: Path, rows: list[Row], told: Words) -> list[str]:
    """The table as CSV and the error beside the condition number as a log-log picture; their names."""
    names = ["stress.csv", "stress.svg"]
    with (folder / names[0]).open("w", encoding="utf-8", newline="") as stream:
        out = csv.DictWriter(stream, list(rows[0].told), lineterminator="\n")
        out.writeheader()
        out.writerows({**row.told, "result": " ".join(map(repr, row.numbers))} for row in rows)
    series: list[Series] = []
    for name in dict.fromkeys(r.case for r in rows):
        own = sorted((r for r in rows if r.case == name and r.result), key=lambda r: r.condition)
        conditions = [max(r.condition, 1.0) for r in own]
        series.append((told.text(name), conditions, [max(r.relative, _LEAST) for r in own]))
    most = max(x for _, xs, _ in series for x in xs)
    bound = [(x, _TIMES * _ROUNDING * (1 + x)) for x in (1.0, most)]
    series.append((told.text("allowed"), [x for x, _ in bound], [y for _, y in bound]))
    axes = told.text("condition number"), told.text("relative error")
    write_loglog(folder / names[1], told.text("error beside condition number"), axes, series)
    return names
