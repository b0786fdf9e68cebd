"""Scene keys of motion laws: by name, by acceleration diagram or its halves, polynomials, B-splines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct
from msgspec.json import decode
from msgspec.structs import astuple

from geometry.base.errors import Nearest, ParameterError
from parts.base.psv import rows_of
from parts.base.texts import N_
from parts.keys.base import start

if TYPE_CHECKING:
    from geometry.laws.diagram import Stretch
    from geometry.laws.law import Law

LawName = Literal[
    "constant_velocity",
    "constant_acceleration",
    "linearly_decreasing",
    "cosine",
    "sine",
    "trapezoid",
    "triangle",
    "modified_trapezoid",
    "modified_sine",
    "modified_sine_cv20",
    "modified_sine_cv33",
    "modified_sine_cv50",
    "polynomial_345",
    "polynomial_4567",
    "gutman_13",
    "double_harmonic",
    "half_cycloidal",
    "half_harmonic",
]
# a phase of a motion may leave its law to its neighbours
PhaseLaw = Literal[LawName, "join"]
Width = Annotated[float, Meta(gt=0, le=1e6, description="width, any scale")]
Ordinate = Annotated[float, Meta(ge=-1e6, le=1e6, description="ordinate, any scale; below the axis negative")]
# beyond, powers of it are no numbers any more
Plain = Annotated[float, Meta(ge=-1e6, le=1e6)]
Share = Annotated[float, Meta(ge=0, le=1, description="share of the width")]


class ConstantTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="constant"):
    """Horizontal segment of the acceleration diagram."""

    width: Width
    ordinate: Ordinate


class _EndsTable(Struct, forbid_unknown_fields=True, tag_field="shape"):
    """Keys of a segment between two ordinates."""

    width: Width
    first: Ordinate
    last: Ordinate


class _PeakTable(Struct, forbid_unknown_fields=True, tag_field="shape"):
    """Keys of a segment with one peak."""

    width: Width
    peak: Ordinate


class LinearTable(_EndsTable, tag="linear"):
    """Sloping segment."""


class HalfSineTable(_PeakTable, tag="half_sine"):
    """0, the peak, 0."""


class QuarterSineTable(_PeakTable, tag="quarter_sine"):
    """0 to the peak, where it is horizontal."""


class QuarterCosineTable(_PeakTable, tag="quarter_cosine"):
    """Horizontal at the peak, down to 0."""


class HalfCosineTable(_EndsTable, tag="half_cosine"):
    """Horizontal at both ends."""


class TrapezoidTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="trapezoid"):
    """0, ramp, level, ramp, 0."""

    width: Width
    ordinate: Ordinate
    up: Share
    down: Share | None = None


class PointsTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="points"):
    """A cubic spline through points (place, ordinate)."""

    width: Width
    points: Annotated[list[tuple[Plain, Plain]], Meta(min_length=2, max_length=2000, description="[place, ordinate]")]


StretchTable = (
    ConstantTable
    | LinearTable
    | HalfSineTable
    | QuarterSineTable
    | QuarterCosineTable
    | HalfCosineTable
    | TrapezoidTable
    | PointsTable
)

_DIAGRAM = Meta(min_length=1, max_length=200, description="its acceleration, in any scale")
_FIRST_HALF = Meta(min_length=1, max_length=100, description="acceleration up to the greatest velocity, above the axis")
_SECOND_HALF = Meta(min_length=1, max_length=100, description="deceleration after it, drawn above the axis too")
_CONDITIONS = Meta(min_length=2, max_length=32, description="polynomial: [place u from 0 to 1, order, s^(order)(u)]")
_POLES = Meta(min_length=4, max_length=60, description="of a B-spline, from 0 to the lift")
_KNOTS = Meta(max_length=56, description="inner knots, 0 to 1; default: equal spans")
_SINE_CONSTANT_COSINE = Meta(description="SCCA: shares of the phase, 0 to 1; the rest of it is at constant velocity")
_RAMP = Meta(ge=0, lt=0.5, description="trapezoid, modified ones: share of each ramp, usual 0.125")


class LawTable(Struct, forbid_unknown_fields=True):
    """A law of your own: diagram, first_half with second_half, conditions, poles, sine_constant_cosine or name."""

    diagram: Annotated[list[StretchTable], _DIAGRAM] | None = None
    balance: Annotated[bool, Meta(description="scale what lies below the axis so that the diagram closes")] = False
    first_half: Annotated[list[StretchTable], _FIRST_HALF] | None = None
    second_half: Annotated[list[StretchTable], _SECOND_HALF] | None = None
    first_share: Annotated[float, Meta(gt=0, lt=1, description="of the phase that the first half takes")] = 0.5
    conditions: Annotated[list[tuple[Plain, int, Plain]], _CONDITIONS] | None = None
    poles: Annotated[list[Plain], _POLES] | None = None
    degree: Annotated[int, Meta(ge=3, le=9, description="of the B-spline")] = 5
    knots: Annotated[list[Plain], _KNOTS] | None = None
    sine_constant_cosine: Annotated[tuple[Plain, Plain, Plain], _SINE_CONSTANT_COSINE] | None = None
    name: LawName | None = None
    ramp: Annotated[float, _RAMP] | None = None
    reverse: Annotated[bool, Meta(description="run backwards: first and second half exchanged")] = False


# which keys belong to which kind of law, the one that names it first
_KINDS = {
    "diagram": ("balance",),
    "first_half": ("second_half", "first_share"),
    "conditions": (),
    "poles": ("degree", "knots"),
    "sine_constant_cosine": (),
    "name": ("ramp",),
}


# laws of one's own in place of a name, each with what it is
EXAMPLES: list[tuple[dict[str, object], str]] = [
    (decode(law), meant) for law, meant in rows_of(__file__, "law_examples")
]


def with_own_laws(phases: list[dict[str, object]]) -> Meta:
    """Phases to start from, these with a first one in parts that join, and with laws of one's own in it."""
    size = "travel" if "travel" in phases[0] else "angle_deg"
    parts = [
        {**phases[0], size: share * float(str(phases[0][size])), "law": law, "share": share}
        for law, share in (("join", 0.25), ("constant_velocity", 0.5), ("join", 0.25))
    ]
    meant = N_("join takes velocity and acceleration of the phases beside it (VDI 2143)")
    return start(
        phases,
        ([*parts, *phases[1:]], meant),
        *(([{**phases[0], "law": law}, *phases[1:]], meant) for law, meant in EXAMPLES),
    )


def law_of(law: PhaseLaw | LawTable | None, place: str) -> Law:
    """The law of a phase, refusals under ``place``.

    Raises
    ------
    ParameterError
        No law, none or several kinds of law in one table, or a law that cannot be.
    """
    from geometry.cams.motion.joins import JOIN
    from geometry.laws.named import NAMED_LAWS

    if law is None:
        raise ParameterError(place, None, "law_missing", Nearest("sine"), names=[*NAMED_LAWS, "join"])
    if law == "join":
        return JOIN
    if isinstance(law, str):
        return NAMED_LAWS[law]()
    kinds = [kind for kind in _KINDS if getattr(law, kind) is not None]
    if len(kinds) != 1:
        raise ParameterError(place, None, "several_laws" if kinds else "empty_law", given=kinds, names=[*_KINDS])
    allowed = {kinds[0], *_KINDS[kinds[0]], "reverse"}
    plain = LawTable()
    for field in LawTable.__struct_fields__:
        if field not in allowed and getattr(law, field) != getattr(plain, field):
            owner = next(kind for kind, keys in _KINDS.items() if field in keys)
            given, rest = getattr(law, field), getattr(plain, field)
            numbers = {"owner": owner, "other": kinds[0]}
            raise ParameterError(f"{place}.{field}", given, "key_of_another_law", Nearest(rest), **numbers)
    try:
        made = _made(kinds[0], law)
    except ParameterError as refusal:
        raise refusal.renamed(f"{place}.{refusal.name}") from refusal
    return made.reversed_in_time() if law.reverse else made


def _made(kind: str, law: LawTable) -> Law:
    """The law of a table of one kind."""
    from geometry.laws import diagram
    from geometry.laws.named import polynomial_law, sine_constant_cosine
    from geometry.laws.splines import bspline_law

    if kind == "diagram":
        return diagram.law_of_diagram(N_("own diagram"), _drawn(law.diagram), balance=law.balance)
    if kind == "first_half":
        if law.second_half is None:
            raise ParameterError("second_half", None, "second_half_missing")
        halves = _drawn(law.first_half), _drawn(law.second_half)
        return diagram.law_of_halves(N_("own halves"), *halves, share=law.first_share)
    if kind == "conditions":
        return polynomial_law(law.conditions or [])
    if kind == "poles":
        return bspline_law(law.poles or [], degree=law.degree, knots=law.knots)
    if law.sine_constant_cosine is not None:
        return sine_constant_cosine(*law.sine_constant_cosine)
    return _ramped(law)


def _ramped(law: LawTable) -> Law:
    """A named law with ramps of one's own."""
    from geometry.laws.named import NAMED_LAWS, modified_sine, modified_trapezoid, trapezoidal

    if law.ramp is None:
        return NAMED_LAWS[str(law.name)]()
    with_ramps = {"trapezoid": trapezoidal, "modified_trapezoid": modified_trapezoid, "modified_sine": modified_sine}
    if law.name not in with_ramps:
        raise ParameterError("ramp", law.ramp, "law_without_ramps", Nearest(None), law=law.name, names=[*with_ramps])
    return with_ramps[law.name](law.ramp)


def _drawn(tables: list[StretchTable] | None) -> list[Stretch]:
    return [s for table in tables or () for s in _stretches(table)]


def _stretches(table: StretchTable) -> Sequence[Stretch]:
    from geometry.laws import diagram

    if isinstance(table, PointsTable):
        return diagram.tabulated(table.width, *zip(*table.points, strict=True))
    # the shape is the name of what makes it of its sizes
    made: Stretch | list[Stretch] = getattr(diagram, str(table.__struct_config__.tag))(*astuple(table))
    return made if isinstance(made, list) else [made]
