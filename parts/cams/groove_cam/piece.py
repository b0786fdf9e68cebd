"""The part kind ``groove_piece``: a plate of a groove cam that is glued from three, cut by a laser."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta

from geometry.base.errors import OffsetError
from geometry.base.record import Record, replace
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Region, circle
from parts.base.kind import Kind, Others, Report
from parts.base.links import owner_of
from parts.base.part_keys import MaterialKeys
from parts.cams.groove_cam.part import GROOVE_CAM, GrooveCamSpec, GrooveDisk, groove_section
from parts.keys.base import mm
from parts.keys.cam import turn

if TYPE_CHECKING:
    from parts.base.readback import Probe


_GROOVE_CAM: dict[str, object] = {
    "kind": "groove_cam", "follower_radius": 8.0, "lift": 20.0, "base_circle_radius": 30.0, "phases": turn("sine"),
    "groove_depth": 5.0,
}  # fmt: skip

_THICKNESS = mm("of the plate; default: groove_depth, of the floor what is left", least=0.01, most=10_000, example=3.0)


class GroovePieceSpec(MaterialKeys, forbid_unknown_fields=True, tag_field="kind", tag="groove_piece"):
    """Keys of ``groove_piece``."""

    of: Annotated[str, Meta(description="the part of kind groove_cam that the plate is a layer of")]
    piece: Annotated[Literal["core", "ring", "floor"], Meta(description="which of the three plates", examples=["core"])]
    thickness: Annotated[float, _THICKNESS] | None = None


class GroovePiece(Record):
    """The groove cam of a plate, and the plate's thickness, mm."""

    disk: GrooveDisk
    thickness: float


class Piece(Kind[GroovePieceSpec, GroovePiece]):
    """A plate of a groove cam."""

    name, keys, made_from = "groove_piece", GroovePieceSpec, _GROOVE_CAM
    drawing = "parts.cams.drawings"
    data_table = "parts.cams.data_tables"

    def thing(self, keys: GroovePieceSpec, others: Others) -> GroovePiece:
        """The plate of another part's groove cam."""
        disk = GROOVE_CAM.thing(owner_of(keys.of, others, GrooveCamSpec), others)
        return GroovePiece(disk, keys.thickness or (disk.floor if keys.piece == "floor" else disk.depth))

    def section(self, keys: GroovePieceSpec, thing: GroovePiece, offset: float) -> OffsetRegion:
        """The plate's section with every boundary moved out of the material."""
        disk = thing.disk
        if keys.piece == "floor":
            rim = disk.outer_radius - disk.holes.reach
            if not -2 * offset < rim:
                raise OffsetError(offset, "leaves_no_rim", -rim / 2 * (1 - 1e-6))
            round_ = circle(disk.outer_radius + offset, Label.BODY)
            return OffsetRegion(Region(round_, disk.holes.profiles(offset)), offset, ())
        whole = groove_section(disk, offset)
        outer, inner = whole.region.marks
        region = Region(inner, whole.region.holes) if keys.piece == "core" else Region(whole.region.outer, (outer,))
        return OffsetRegion(region, offset, whole.findings)

    def height(self, keys: GroovePieceSpec, thing: GroovePiece) -> float:
        """The plate's thickness."""
        return thing.thickness

    def report(self, keys: GroovePieceSpec, thing: GroovePiece) -> Report:
        """The disk's edge."""
        return Report(circles={} if keys.piece == "core" else {"outer_diameter": 2 * thing.disk.outer_radius})

    def probes(self, keys: GroovePieceSpec, thing: GroovePiece) -> tuple[Probe, ...]:
        """A roller along the wall that the plate has."""
        if keys.piece == "floor":
            return ()
        inner, outer = thing.disk.wall_probes(thing.thickness / 2)
        return (replace(inner if keys.piece == "core" else outer, name=""),)


GROOVE_PIECE = Piece()
