"""Scene keys of the holes in a wheel: ``bore``, ``holes`` and ``spokes``, and what would work where they do not fit."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, Protocol, TypeVar

from msgspec import Meta, Struct
from msgspec.structs import replace

from geometry.base.errors import LateError, Nearest, ParameterError, limit
from geometry.base.findings import Finding, short_of
from geometry.base.nearest import kept, nearest
from geometry.solids.bores import Bore, FlatBore, KeywayBore, PolygonBore, RoundBore
from geometry.solids.hub_holes import HubHoles
from parts.base.schema import nearest_key, value_at
from parts.keys.base import BoreDiameter, MadeKeys, degrees, either, part_mm
from parts.keys.splines import Clearance, InvoluteSplineTable, StraightSplineTable

if TYPE_CHECKING:
    from geometry.solids.windows import RoundHoles

K = TypeVar("K", bound=Struct)
# part of the room for a bore that it takes at most
_WITHIN = 0.9999
# mm: a thinner wall of a roller or an eccentric breaks, cut or printed
_THIN = 1.0
Direction = Annotated[float, degrees("direction of the first one", least=-360, most=360)]
Diameter = Annotated[float, part_mm("diameter of the bore", above=0, example=8.0)]
AcrossFlats = Annotated[float, part_mm("from a flat to the opposite one", above=0, example=7.0)]
CornerRadius = Annotated[float, part_mm("rounding of the corners", least=0)]
PitchCircle = Annotated[float, part_mm("circle of their centres", above=0, example=28.0)]


def _widened(bore: Bore, clearance: float) -> Bore:
    """A bore whose every surface stands so far, mm, off that of its shaft."""
    return bore.widened(clearance) if clearance else bore


class RoundBoreTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="round"):
    """Round bore, the same as bore_diameter."""

    diameter: Diameter
    clearance: Clearance = 0.0

    def bore(self) -> Bore:
        """The bore of these sizes."""
        return _widened(RoundBore(self.diameter), self.clearance)


_CORNER_RADIUS = part_mm("at the keyway's bottom; default: the standard's largest", least=0, example=0.16)


class KeywayTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="keyway"):
    """Round bore with keyways by a standard, or of your own width and depth."""

    diameter: Diameter
    standard: Literal["DIN 6885", "GOST 23360"] = "DIN 6885"
    keys: Annotated[int, Meta(ge=1, le=2, description="one keyway, or two opposite ones")] = 1
    angle_deg: Direction = 90.0
    width: Annotated[float, part_mm("width b; default: the standard's", above=0, example=2.0)] | None = None
    depth: Annotated[float, part_mm("depth t2 in the hub; default: the standard's", above=0, example=1.0)] | None = None
    corner_radius: Annotated[float, _CORNER_RADIUS] | None = None
    clearance: Clearance = 0.0

    def bore(self) -> Bore:
        """The keyway of the standard, each size replaced by one that is given; of one's own where both are."""
        width, depth, radius = self.width, self.depth, self.corner_radius
        if width is None or depth is None:
            from geometry.solids.keyways import keyway_row

            row = keyway_row(self.standard, self.diameter)
            width, depth = width or row.width, depth or row.hub_depth
            if radius is None:
                # a keyway of other sizes may have less room for it
                radius = min(row.most_radius, width / 4, depth / 4)
        own = KeywayBore(self.diameter, width, depth, radius or 0.0, self.keys, math.radians(self.angle_deg))
        return _widened(own, self.clearance)


class FlatBoreTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="D"):
    """Round bore with one flat."""

    diameter: Diameter
    flat: Annotated[float, part_mm("from the flat to the opposite side", above=0, example=7.0)]
    clearance: Clearance = 0.0
    angle_deg: Direction = 90.0

    def bore(self) -> Bore:
        """The bore of these sizes."""
        own = FlatBore(self.diameter, self.flat - self.diameter / 2, 1, math.radians(self.angle_deg))
        return _widened(own, self.clearance)


class DoubleFlatBoreTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="double_D"):
    """Round bore with two opposite flats."""

    diameter: Diameter
    across_flats: AcrossFlats
    clearance: Clearance = 0.0
    angle_deg: Direction = 90.0

    def bore(self) -> Bore:
        """The bore of these sizes."""
        own = FlatBore(self.diameter, self.across_flats / 2, 2, math.radians(self.angle_deg))
        return _widened(own, self.clearance)


class PolygonTable(Struct, forbid_unknown_fields=True, tag_field="shape"):
    """Keys of a bore that is a regular polygon."""

    across_flats: AcrossFlats
    corner_radius: CornerRadius = 0.0
    clearance: Clearance = 0.0
    angle_deg: Direction = 90.0
    corners: ClassVar[int]

    def bore(self) -> Bore:
        """The bore of these sizes."""
        own = PolygonBore(self.corners, self.across_flats, self.corner_radius, math.radians(self.angle_deg))
        return _widened(own, self.clearance)


class HexagonTable(PolygonTable, tag="hexagon"):
    """Hexagonal bore."""

    corners = 6


class SquareTable(PolygonTable, tag="square"):
    """Square bore."""

    corners = 4


BoreTable = (
    RoundBoreTable
    | KeywayTable
    | FlatBoreTable
    | DoubleFlatBoreTable
    | HexagonTable
    | SquareTable
    | StraightSplineTable
    | InvoluteSplineTable
)
# the key of each that makes it larger
_SIZES = ("diameter", "across_flats", "outer_diameter")


class HolesTable(Struct, forbid_unknown_fields=True):
    """Round holes on a pitch circle (lightening holes, bolt circle), or a list of such tables."""

    count: Annotated[int, Meta(ge=1, le=1000, description="number of holes", examples=[5])]
    diameter: Annotated[float, part_mm("diameter of each hole", above=0, example=6.0)]
    pitch_circle_diameter: PitchCircle
    start_deg: Direction = 0.0


_HUB_RING = part_mm(
    "outer diameter of the hub ring; default: 1.05 of the hub's, or 1.6 of the bore's, and wide enough for the spokes",
    above=0,
    example=20.0,
)
_RIM = part_mm(
    "inner diameter of the rim; default: the web's rim by 1.05, or 2.5 modules (else a tenth) within the roots",
    above=0,
    example=36.0,
)


class SpokesTable(Struct, kw_only=True, forbid_unknown_fields=True):
    """Spokes between a hub ring and a rim: windows with rounded corners."""

    count: Annotated[int, Meta(ge=2, le=200, description="number of spokes", examples=[5])]
    inner_diameter: Annotated[float, _HUB_RING] | None = None
    outer_diameter: Annotated[float, _RIM] | None = None
    width: Annotated[float, part_mm("width of a spoke", above=0, example=4.0)]
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
    own = None if bore is None else bore.bore()
    if not groups and spokes is None:
        return HubHoles(own)
    from geometry.solids.windows import RoundHoles, Spokes

    windows = None
    # without both diameters they are none yet: ``spoked`` finds those
    if spokes is not None and spokes.inner_diameter is not None and spokes.outer_diameter is not None:
        windows = Spokes(
            spokes.count,
            spokes.inner_diameter,
            spokes.outer_diameter,
            spokes.width,
            spokes.corner_radius,
            math.radians(spokes.start_deg),
        )
    circles = tuple(RoundHoles(g.count, g.diameter, g.pitch_circle_diameter, math.radians(g.start_deg)) for g in groups)
    return HubHoles(own, circles, windows)


# shares of a value at which a search for one that fits begins, near ones first
_SHARES = (31 / 32, 33 / 32, 15 / 16, 17 / 16, 7 / 8, 9 / 8, 3 / 4, 5 / 4, 1 / 2, 3 / 2, 2 / 5, 2, 1 / 4, 3, 1 / 8, 5,
           1 / 64, 1e-4, 0)  # fmt: skip
# keys that only turn holes
_TURNS = ("angle_deg", "start_deg")


class Bored(Protocol):
    """A bore, given in short or in full."""

    @property
    def bore_diameter(self) -> float | None:
        """0: none; None: that of another part."""

    @property
    def bore(self) -> BoreTable | None:
        """Its shape."""


# of the bore's diameter, a hub ring; modules, a rim: as textbooks have them; windows keep off hub and web's rim
_HUB_SHARE, _RIM_MODULES, _OFF = 1.6, 2.5, 1.05


def bore_of(keys: Bored) -> BoreTable | None:
    """The bore in full.

    Raises
    ------
    ParameterError
        It is given in short too.
    """
    if keys.bore is not None and keys.bore_diameter:
        raise either("bore_diameter", keys.bore_diameter, "bore", 0.0)
    return RoundBoreTable(keys.bore_diameter) if keys.bore_diameter else keys.bore


def holes_of(keys: Bored, *own: RoundHoles) -> HubHoles:
    """Bore, holes and windows by the keys of a part, which need not have them all; ``own`` groups stand first.

    Raises
    ------
    ParameterError
        Both ``bore`` and ``bore_diameter`` are given, or a keyway has no row in its standard.
    """
    found = hub_holes(bore_of(keys), getattr(keys, "holes", None), getattr(keys, "spokes", None))
    return HubHoles(found.bore, (*own, *found.round_holes), found.spokes)


def spoked(keys: K, core: float) -> K:
    """The keys with both diameters of their spokes; ``core``: radius of what lies within the roots, mm."""
    spokes: SpokesTable | None = getattr(keys, "spokes", None)
    if spokes is None or (spokes.inner_diameter is not None and spokes.outer_diameter is not None):
        return keys
    inner, outer = spokes.inner_diameter, spokes.outer_diameter
    hub, web, module = (getattr(keys, key, None) for key in ("hub", "web", "module"))
    if outer is None:
        rim = _RIM_MODULES * module if module else core / 10
        outer = 2 * (core - rim) if web is None else web.rim_diameter / _OFF
    radius, sine = spokes.corner_radius, math.sin(math.pi / spokes.count)
    if inner is None:
        short: float = getattr(keys, "bore_diameter", None) or 0.0
        reach = hub_holes(getattr(keys, "bore", None), None, None).bore_reach or short / 2
        ring = _HUB_SHARE * 2 * reach if hub is None else _OFF * hub.diameter
        # between the roundings of neighbouring spokes a tenth is left
        inner = max(ring, 2.2 * ((spokes.width / 2 + radius) / sine - radius))
        widest = 2 * (((outer - 5 * radius) / 2.2 + radius) * sine - radius)
        if not inner < outer and ring < outer and widest > 0:
            most = limit(widest * _WITHIN, spokes.width)
            raise ParameterError("spokes.width", spokes.width, "no_room_for_spokes", most, ring=inner, rim=outer)
    if not inner < outer:
        raise ParameterError("spokes", None, "no_room_for_spokes", None, ring=inner, rim=max(outer, 0.0))
    return replace(keys, spokes=replace(spokes, inner_diameter=inner, outer_diameter=outer))


class BoredKeys(MadeKeys, kw_only=True):
    """Keys of a part with a bore."""

    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None


class HoledKeys(BoredKeys, kw_only=True):
    """Keys of a part with a bore and round holes about it."""

    holes: HolesTable | list[HolesTable] | None = None


def wide_bore(
    keys: Bored, inside: float, code: str, beside: Callable[[str, float], bool] = lambda _path, _size: True
) -> ParameterError:
    """A refusal of a bore that reaches ``inside`` mm from the axis: its size as typed, and one that stays within.

    ``beside`` judges a size, by its key, together with what else stands there: chamfers, a hub.
    """
    bore = keys.bore
    if bore is None or keys.bore_diameter:
        alone, widest = partial(beside, "bore_diameter"), 2 * inside * _WITHIN

        def cure() -> Nearest | None:
            """The limit itself, where nothing else stands there."""
            most = limit(widest, math.inf)
            return most if kept(alone, widest) else nearest(alone, widest, (widest * s for s in _SHARES if s < 1))

        return ParameterError("bore_diameter", keys.bore_diameter, code, cure, inside=inside)
    name = next((key for key in _SIZES if getattr(bore, key, None) is not None), "")
    if not name:
        return ParameterError(*bore.bore().size, code, inside=inside)
    given: float = getattr(bore, name)

    def fits(size: float) -> bool:
        reach = hub_holes(replace(bore, **{name: size}), None, None).bore_reach
        return reach < inside and beside(f"bore.{name}", size)

    cured = partial(nearest, fits, given, [given * s for s in _SHARES])
    return ParameterError(f"bore.{name}", given, code, cured, inside=inside)


def wide_holes(
    keys: K, holes_of: Callable[[K], HubHoles], inside: float, code: str, beside: Callable[[K], bool]
) -> ParameterError:
    """A refusal of the group of holes that reaches farthest, beyond ``inside`` mm, with a size that stays within.

    ``beside`` judges keys whose holes do that, together with what else stands there: a mark, a hub.
    """

    def fits(changed: K) -> bool:
        found = holes_of(changed)
        return found.reach < inside and found.fits(math.inf) and kept(beside, changed)

    key, group = max(holes_of(keys).groups(), key=lambda g: g[1].reach)
    beyond = ParameterError(f"{key}.pitch_circle_diameter", group.pitch_circle_diameter, code, inside=inside)
    return with_remedy(beyond, keys, fits)


def with_remedy(refusal: ParameterError, keys: K, fits: Callable[[K], bool]) -> ParameterError:
    """A refusal of ``bore``, ``holes`` or ``spokes`` told of the key of its table that alone can cure it.

    ``fits`` judges changed keys; the refused key is tried before the others. The refusal itself where none can.
    """
    return LateError(refusal.code, partial(_remedied, refusal, keys, fits))


def _remedied(refusal: ParameterError, keys: K, fits: Callable[[K], bool]) -> ParameterError:
    owner, _, key = refusal.name.rpartition(".")
    if isinstance(value_at(keys, owner), list):
        owner = f"{owner}[1]"
    table = value_at(keys, owner)
    if not owner.startswith(("bore", "holes", "spokes")) or not isinstance(table, Struct):
        return refusal
    sizes = {f: v for f in table.__struct_fields__ if isinstance(v := getattr(table, f), float) and f not in _TURNS}
    for name in sorted(sizes, key=lambda f: f != key):
        path, given = f"{owner}.{name}", sizes[name]
        found = nearest_key(keys, path, given, (given * s for s in _SHARES), fits)
        if found is not None:
            return refusal.told_of(path, given, found)
    return refusal


def check_shape(keys: K, holes_of: Callable[[K], HubHoles], inside: float = math.inf) -> None:
    """Refuse a bore whose sizes make no shape, told with one that does and ends ``inside`` mm of the axis.

    Raises
    ------
    ParameterError
        The flat of a D lies outside of its circle, a keyway is wider than the bore, a rounding has no room.
    """
    bore = holes_of(keys).bore
    if bore is None:
        return

    def fits(changed: K) -> bool:
        found = holes_of(changed).bore
        if found is None:
            return False
        found.check()
        return found.reach < inside

    try:
        bore.check()
    except ParameterError as refusal:
        raise with_remedy(refusal, keys, fits) from refusal


def check_holes(
    keys: K, holes_of: Callable[[K], HubHoles], inside: float = math.inf, root_radius: float = math.inf
) -> None:
    """Refuse holes that meet each other or the root circle, mm, told with a size that does not.

    What is told keeps all of them ``inside`` mm of the axis too.

    Raises
    ------
    ParameterError
        With the key of the size.
    """

    def fits(changed: K) -> bool:
        found = holes_of(changed)
        return found.fits(root_radius) and found.reach < inside

    try:
        holes_of(keys).check(root_radius)
    except ParameterError as refusal:
        raise with_remedy(refusal, keys, fits) from refusal


def thin_wall(radius: float, holes: HubHoles) -> tuple[Finding, ...]:
    """The remark on a wall between a bore and a circle about its axis that breaks; ``radius`` of that circle, mm."""
    return () if holes.bore is None else short_of("thin_roller_wall", radius - holes.bore_reach, _THIN)
