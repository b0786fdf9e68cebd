"""Scene keys of the holes in a wheel: ``bore``, ``holes`` and ``spokes``, and what would work where they do not fit."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta, Struct

from geometry.bores import Bore, FlatBore, KeywayBore, PolygonBore, RoundBore
from geometry.errors import GeometryError, ParameterError, at_least, at_most
from geometry.hub_holes import HubHoles
from geometry.keyway_tables import keyway_row
from geometry.trial import is_trial, trial
from geometry.windows import RoundHoles, Spokes
from parts.keys import mm

_MOST = 100_000.0
# part of the room for a bore that it takes at most
_WITHIN = 0.9999
Direction = Annotated[float, Meta(ge=-360, le=360, description="direction of the first one", extra={"unit": "degrees"})]
Diameter = Annotated[float, mm("diameter of the bore", above=0, most=_MOST)]
AcrossFlats = Annotated[float, mm("from a flat to the opposite one", above=0, most=_MOST)]
CornerRadius = Annotated[float, mm("rounding of the corners", least=0, most=_MOST)]


class RoundBoreTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="round"):
    """Round bore, the same as bore_diameter."""

    diameter: Diameter


class KeywayTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="keyway"):
    """Round bore with keyways by a standard, or of one's own width and depth."""

    diameter: Diameter
    standard: Literal["DIN 6885", "GOST 23360"] = "DIN 6885"
    keys: Annotated[int, Meta(ge=1, le=2, description="one keyway, or two opposite ones")] = 1
    angle_deg: Direction = 90.0
    width: Annotated[float, mm("width b; default: the standard's", above=0, most=_MOST)] | None = None
    depth: Annotated[float, mm("depth t2 in the hub; default: the standard's", above=0, most=_MOST)] | None = None
    corner_radius: (
        Annotated[float, mm("at the keyway's bottom; default: the standard's largest", least=0, most=_MOST)] | None
    ) = None


class FlatBoreTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="D"):
    """Round bore with one flat."""

    diameter: Diameter
    flat: Annotated[float, mm("from the flat to the opposite side", above=0, most=_MOST)]
    angle_deg: Direction = 90.0


class DoubleFlatBoreTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="double_D"):
    """Round bore with two opposite flats."""

    diameter: Diameter
    across_flats: AcrossFlats
    angle_deg: Direction = 90.0


class HexagonTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="hexagon"):
    """Hexagonal bore."""

    across_flats: AcrossFlats
    corner_radius: CornerRadius = 0.0
    angle_deg: Direction = 90.0


class SquareTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="square"):
    """Square bore."""

    across_flats: AcrossFlats
    corner_radius: CornerRadius = 0.0
    angle_deg: Direction = 90.0


BoreTable = RoundBoreTable | KeywayTable | FlatBoreTable | DoubleFlatBoreTable | HexagonTable | SquareTable


class HolesTable(Struct, forbid_unknown_fields=True):
    """Round holes on a pitch circle (lightening holes, bolt circle), or a list of such tables."""

    count: Annotated[int, Meta(ge=1, le=1000, description="number of holes")]
    diameter: Annotated[float, mm("diameter of each hole", above=0, most=_MOST)]
    pitch_circle_diameter: Annotated[float, mm("circle of their centres", above=0, most=_MOST)]
    start_deg: Direction = 0.0


class SpokesTable(Struct, forbid_unknown_fields=True):
    """Spokes between a hub ring and a rim: windows with rounded corners."""

    count: Annotated[int, Meta(ge=2, le=200, description="number of spokes")]
    inner_diameter: Annotated[float, mm("outside of the hub ring", above=0, most=_MOST)]
    outer_diameter: Annotated[float, mm("inside of the rim", above=0, most=_MOST)]
    width: Annotated[float, mm("width of a spoke", above=0, most=_MOST)]
    corner_radius: CornerRadius = 0.0
    start_deg: Direction = 0.0


HolesKey = HolesTable | Sequence[HolesTable] | None


def hub_holes(bore: BoreTable | None, holes: HolesKey, spokes: SpokesTable | None) -> HubHoles:
    """The holes that the keys describe.

    Raises
    ------
    ParameterError
        A keyway has no row in its standard, or one of its sizes is missing.
    """
    groups = [holes] if isinstance(holes, HolesTable) else holes or []
    windows = None
    if spokes is not None:
        windows = Spokes(
            spokes.count,
            spokes.inner_diameter,
            spokes.outer_diameter,
            spokes.width,
            spokes.corner_radius,
            math.radians(spokes.start_deg),
        )
    circles = tuple(RoundHoles(g.count, g.diameter, g.pitch_circle_diameter, math.radians(g.start_deg)) for g in groups)
    return HubHoles(None if bore is None else _bore_of(bore), circles, windows)


def _bore_of(table: BoreTable) -> Bore:
    if isinstance(table, RoundBoreTable):
        return RoundBore(table.diameter)
    angle = math.radians(table.angle_deg)
    if isinstance(table, KeywayTable):
        return _keyway_of(table, angle)
    if isinstance(table, FlatBoreTable):
        return FlatBore(table.diameter, table.flat - table.diameter / 2, 1, angle)
    if isinstance(table, DoubleFlatBoreTable):
        return FlatBore(table.diameter, table.across_flats / 2, 2, angle)
    sides = 6 if isinstance(table, HexagonTable) else 4
    return PolygonBore(sides, table.across_flats, table.corner_radius, angle)


def _keyway_of(table: KeywayTable, angle: float) -> KeywayBore:
    """The keyway of a standard, each size replaced by one that is given; of one's own where both are."""
    width, depth, radius = table.width, table.depth, table.corner_radius
    if width is None or depth is None:
        row = keyway_row(table.standard, table.diameter)
        width, depth = width or row.width, depth or row.hub_depth
        if radius is None:
            # a keyway of other sizes may have less room for it
            radius = min(row.most_radius, width / 4, depth / 4)
    return KeywayBore(table.diameter, width, depth, radius or 0.0, table.keys, angle)


def wide_bore(spec: Any, inside: float, reason: str) -> ParameterError:
    """A refusal of a bore that reaches ``inside`` mm from the axis: its size as typed, and one that stays within.

    ``spec``: with the keys ``bore_diameter`` and ``bore``.
    """
    if spec.bore is None or spec.bore_diameter:
        text = f"{reason}; at most {at_most(2 * inside * _WITHIN, 4)} mm works"
        return ParameterError("bore_diameter", spec.bore_diameter, text)
    name = "diameter" if hasattr(spec.bore, "diameter") else "across_flats"
    typed: float = getattr(spec.bore, name)

    def fits(size: float) -> bool:
        try:
            return hub_holes(msgspec.structs.replace(spec.bore, **{name: size}), None, None).bore_reach < inside
        except GeometryError:
            return False

    good = next((typed * k / 64 for k in range(63, 0, -1) if fits(typed * k / 64)), None)
    if good is None:
        return ParameterError(f"bore.{name}", typed, reason)
    high = typed
    for _ in range(30):
        middle = (good + high) / 2
        good, high = (middle, high) if fits(middle) else (good, middle)
    return ParameterError(f"bore.{name}", typed, f"{reason}; at most {at_most(good * _WITHIN, 4)} mm works")


def with_remedy(refusal: ParameterError, spec: Any, builds: Callable[[Any], bool]) -> ParameterError:
    """A refusal of ``bore``, ``holes`` or ``spokes`` with the nearest value of the key, or of another, that works.

    ``builds``: whether a changed spec gives a gear.
    """
    owner, _, rest = refusal.name.partition(".")
    if owner not in ("bore", "holes", "spokes") or "works" in refusal.allowed or is_trial():
        return refusal
    with trial():
        return _with_value(refusal, spec, builds, owner, rest)


def _with_value(
    refusal: ParameterError, spec: Any, builds: Callable[[Any], bool], owner: str, rest: str
) -> ParameterError:
    """The search for that value."""
    place, _, blamed = rest.rpartition(".")
    index = int(place.removeprefix("item ")) - 1 if place else None
    table = getattr(spec, owner) if index is None else getattr(spec, owner)[index]
    if isinstance(table, list):
        table = table[0]
    names = [f.name for f in msgspec.structs.fields(table) if not f.name.endswith("_deg")]

    def works_as(name: str, value: Any) -> bool:
        return builds(_changed(spec, owner, index, name, value))

    for name in [blamed, *(n for n in names if n != blamed)]:
        value = getattr(table, name)
        if value is None or isinstance(value, str):
            continue
        found = _nearest(value, partial(works_as, name))
        if found is not None:
            key = ".".join(filter(None, (owner, place, name)))
            unit = "" if isinstance(value, int) else " mm"
            return ParameterError(key, value, f"{refusal.allowed}; {_told(found, value)}{unit} works")
    return refusal if isinstance(table, BoreTable) else _with_other_table(refusal, spec, owner, index, table, builds)


def _with_other_table(
    refusal: ParameterError, spec: Any, owner: str, index: int | None, table: Any, builds: Callable[[Any], bool]
) -> ParameterError:
    """A refusal that no single key cures, with two diameters that work together, if any are found."""
    names = ("diameter", "pitch_circle_diameter") if owner == "holes" else ("inner_diameter", "outer_diameter")
    top = max(getattr(table, name) for name in names)
    # rings ever thinner, on circles from the outermost inwards
    for share, k in ((s, k) for s in (0.5, 0.25, 0.1, 0.03) for k in range(60)):
        size = float(f"{16 * top * 0.87**k:.4g}")
        pair = (float(f"{share * size:.4g}"), size) if owner == "holes" else (float(f"{(1 - share) * size:.4g}"), size)
        changed = spec
        for name, value in zip(names, pair, strict=True):
            changed = _changed(changed, owner, index, name, value)
        if builds(changed):
            told = " with ".join(f"{name} = {value:g}" for name, value in zip(names, pair, strict=True))
            return ParameterError(refusal.name, refusal.value, f"{refusal.allowed}; {told} mm works")
    return refusal


def _changed(spec: Any, owner: str, index: int | None, name: str, value: float) -> Any:
    """A spec with one key of one of its tables changed."""
    tables = getattr(spec, owner)
    if not isinstance(tables, list):
        return msgspec.structs.replace(spec, **{owner: msgspec.structs.replace(tables, **{name: value})})
    place = index or 0
    made = [*tables[:place], msgspec.structs.replace(tables[place], **{name: value}), *tables[place + 1 :]]
    return msgspec.structs.replace(spec, **{owner: made})


def _told(found: float, value: float) -> str:
    if isinstance(value, int):
        return f"at {'most' if found < value else 'least'} {found}"
    return f"at {'most' if found < value else 'least'} {_rounded(found, value)}"


def _rounded(found: float, value: float) -> str:
    """A limit as printed: 4 digits after the point, or 4 in all where it is small, away from the refused value."""
    digits = max(4, 3 - math.floor(math.log10(found)))
    return at_most(found, digits) if found < value else at_least(found, digits)


def _nearest(value: float, works: Callable[[float], bool]) -> float | None:
    """The value nearest to a refused one that works: from a coarse search near and far, by bisection.

    What is printed is rounded, so that must work too.
    """
    if isinstance(value, int):
        return next((n for n in range(value - 1, 0, -1) if works(n)), None)
    good = next((v for v in _trials(value) if works(v)), None)
    if good is None:
        return None
    bad = value
    for _ in range(40):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if works(middle) else (good, middle)
    return good if works(float(_rounded(good, value))) else None


def _trials(value: float) -> Iterator[float]:
    """Values ever farther from one: by 1/32 of it at first, then by halves and doubles; 0 at last."""
    for k in range(1, 32):
        yield value * (1 - k / 32)
        yield value * (1 + k / 32)
    for k in range(6, 20):
        yield value * 0.5**k
        yield value * 2.0 ** (k - 5)
