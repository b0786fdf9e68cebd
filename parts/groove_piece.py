"""The part kind ``groove_piece``: a plate of a groove cam that is glued from three, cut by a laser."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Literal

from msgspec import Meta, Struct

from geometry.body import plate
from geometry.errors import OffsetError
from geometry.offset_region import OffsetRegion
from geometry.profile import Label, Region, circle
from parts.groove_cam import GrooveCamSpec, GrooveDisk, checked_groove, groove_section
from parts.keys import Colour, Density, Material, mm
from parts.links import owner_of
from parts.materials import density_of
from parts.part import Part


class GroovePieceSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="groove_piece"):
    """A plate of a groove cam: the core within the groove, the ring about it, or the disk under both."""

    of: Annotated[str, Meta(description="the part of kind groove_cam that the plate is a layer of")]
    piece: Annotated[Literal["core", "ring", "floor"], Meta(description="which of the three plates")]
    thickness: (
        Annotated[float, mm("of the plate; default: groove_depth, of the floor what is left", least=0.01, most=10_000)]
        | None
    ) = None
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


@dataclass(frozen=True, slots=True)
class GroovePiece:
    """The groove cam of a plate, and the plate's thickness, mm."""

    disk: GrooveDisk
    thickness: float


def checked_piece(spec: GroovePieceSpec, parts: dict[str, Struct]) -> GroovePiece:
    """The plate of another part's groove cam.

    Raises
    ------
    ParameterError
        No such groove cam.
    """
    disk = checked_groove(owner_of(spec.of, parts, GrooveCamSpec))
    return GroovePiece(disk, spec.thickness or (disk.floor if spec.piece == "floor" else disk.depth))


def piece_part(part_id: str, spec: GroovePieceSpec, piece: GroovePiece) -> Part:
    """The part of a plate."""
    from geometry.cams.walls import CamWall, wide_roller

    disk, section = piece.disk, lru_cache(maxsize=8)(lambda offset: _section(spec, piece.disk, offset))
    middle = piece.thickness / 2
    walls = {
        "core": (CamWall("inner", disk.cam, middle, disk.inner),),
        "ring": (CamWall("outer", wide_roller(disk.cam, disk.clearance), middle, disk.outer, below=False),),
        "floor": (),
    }
    return Part(
        part_id,
        "groove_piece",
        section,
        lru_cache(maxsize=2)(lambda offset: plate(section(offset).region, 0.0, piece.thickness)),
        piece.thickness,
        circles={} if spec.piece == "core" else {"outer_diameter": 2 * disk.outer_radius},
        material=spec.material,
        colour=spec.colour,
        density=spec.density or density_of(spec.material),
        cam=None if spec.piece == "floor" else disk.cam,
        walls=walls[spec.piece],
    )


def _section(spec: GroovePieceSpec, disk: GrooveDisk, offset: float) -> OffsetRegion:
    """The plate's section with every boundary moved out of the material."""
    if spec.piece == "floor":
        rim = disk.outer_radius - disk.holes.reach
        if not -2 * offset < rim:
            raise OffsetError(offset, "leaves no rim", -rim / 2 * (1 - 1e-6))
        return OffsetRegion(
            Region(circle(disk.outer_radius + offset, Label.BODY), disk.holes.profiles(offset)), offset, ()
        )
    whole = groove_section(disk, offset)
    outer, inner = whole.region.marks
    region = Region(inner, whole.region.holes) if spec.piece == "core" else Region(whole.region.outer, (outer,))
    return OffsetRegion(region, offset, whole.findings)
