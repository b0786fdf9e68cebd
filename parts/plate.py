"""The part kind ``plate``: a flat body with holes and slots, and what every flat body of lines and arcs shares."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from geometry.errors import ParameterError, at_most
from parts.keys import Colour, Density, FaceWidth, Material, mm
from parts.materials import density_of
from parts.part import Part

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.plate_outline import Edge, PlateOutline

_MOST = 100_000.0
_Place = Annotated[float, mm("a coordinate", least=-_MOST, most=_MOST)]


class HoleAtTable(Struct, forbid_unknown_fields=True):
    """A round hole anywhere."""

    at: Annotated[tuple[_Place, _Place], Meta(description="x, y of its centre", extra={"unit": "mm"})]
    diameter: Annotated[float, mm("diameter of the hole", above=0, most=_MOST)]


class SlotTable(Struct, forbid_unknown_fields=True):
    """A slot with round ends, between the centres of its ends."""

    start: Annotated[tuple[_Place, _Place], Meta(description="x, y of one end's centre", extra={"unit": "mm"})]
    end: Annotated[tuple[_Place, _Place], Meta(description="x, y of the other end's centre", extra={"unit": "mm"})]
    width: Annotated[float, mm("width of the slot", above=0, most=_MOST)]


HolesAt = Annotated[list[HoleAtTable], Meta(max_length=1000)]
Slots = Annotated[list[SlotTable], Meta(max_length=1000)]


class FlatKeys(Struct, forbid_unknown_fields=True, kw_only=True):
    """Keys of every flat body of lines and arcs."""

    holes: HolesAt = []
    slots: Slots = []
    face_width: FaceWidth = 10.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


class PlateSpec(FlatKeys, forbid_unknown_fields=True, tag_field="kind", tag="plate"):
    """Rectangular plate with rounded corners, holes and slots: a frame, a guide, a cover."""

    width: Annotated[float, mm("along x", above=0, most=_MOST)]
    height: Annotated[float, mm("along y", above=0, most=_MOST)]
    centre: Annotated[tuple[_Place, _Place], Meta(description="x, y of the middle", extra={"unit": "mm"})] = (0.0, 0.0)
    corner_radius: Annotated[float, mm("rounding of the corners", least=0, most=_MOST)] = 0.0


def checked_plate(spec: PlateSpec) -> PlateOutline:
    """The outline of a plate, checked to exist.

    Raises
    ------
    ParameterError
        Roundings that the sides have no room for, or holes that meet each other or the edge.
    """
    from geometry.plate_outline import rounded

    most = min(spec.width, spec.height) / 2
    if spec.corner_radius > most:
        text = f"is more than half of the shorter side; at most {at_most(most)} mm works"
        raise ParameterError("corner_radius", spec.corner_radius, text)
    x, y = spec.centre
    half = complex(spec.width, spec.height) / 2
    corners = [complex(x, y) + c for c in (-half, half.conjugate(), half, -half.conjugate())]
    return checked_outline(rounded([(c, spec.corner_radius) for c in corners]), spec)


def checked_outline(
    edges: tuple[Edge, ...], keys: FlatKeys, own: Sequence[tuple[str, complex, float]] = ()
) -> PlateOutline:
    """Edges with the holes and slots of a part's keys, checked one after the other; ``own``: key, centre, diameter."""
    from geometry.plate_outline import PlateHole, PlateOutline, PlateSlot

    holes = (*(PlateHole(at, d) for _, at, d in own), *(PlateHole(complex(*h.at), h.diameter) for h in keys.holes))
    slots = tuple(PlateSlot(complex(*s.start), complex(*s.end), s.width) for s in keys.slots)
    for number, slot in enumerate(slots, 1):
        if slot.start == slot.end:
            text = "is where it starts; a hole of that diameter works"
            raise ParameterError(f"slots.item {number}.end", list(keys.slots[number - 1].end), text)
    outline = PlateOutline(edges, (*holes, *slots))
    names = [key for key, _, _ in own]
    names += [f"holes.item {i + 1}.diameter" for i in range(len(keys.holes))]
    outline.check_holes([*names, *(f"slots.item {i + 1}.width" for i in range(len(slots)))])
    return outline


def plate_part(part_id: str, spec: PlateSpec, outline: PlateOutline) -> Part:
    """The part of a plate."""
    return flat_part(part_id, "plate", spec, outline)


def flat_part(
    part_id: str,
    kind: str,
    keys: FlatKeys,
    outline: PlateOutline,
    circles: dict[str, float] | None = None,
    quantities: dict[str, float] | None = None,
) -> Part:
    """The part of an outline that is extruded as it is, lower face at z = 0."""
    from geometry.body import plate

    section = lru_cache(maxsize=8)(outline.region)

    def body(offset: float) -> Body:
        return plate(section(offset).region, 0.0, keys.face_width)

    return Part(
        part_id,
        kind,
        section,
        lru_cache(maxsize=2)(body),
        keys.face_width,
        circles=circles or {},
        quantities=quantities or {},
        material=keys.material,
        colour=keys.colour,
        density=keys.density or density_of(keys.material),
    )
