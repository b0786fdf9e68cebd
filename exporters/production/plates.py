"""Plates among the files of a build: parts laid out on the beds of a printer, a file each."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from exporters.boards.nest import QUARTERS, Laid, Room, lacking, largest_scale, nest
from exporters.formats.registry import number_rounding
from exporters.production.boards import different_boards
from exporters.production.jobs import AssemblyJob, Job, Made, assembly_name, several
from exporters.production.request import Request
from exporters.verification.assembly import ExpectedAssembly
from exporters.verification.board import BoardPiece
from geometry.base.errors import ThinWallError, rounded
from geometry.base.findings import Finding
from geometry.base.record import replace
from parts.base.refusal import SceneError
from parts.base.texts import Message, listed
from parts.keys.boards import BedSpec
from parts.scene.boards import pieces_of
from parts.scene.standing import Instance

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# footprints are those of chords so near to the solids, mm, the first that cut through no wall
_CHORDS = (0.02, 0.002, 0.0002)


class PlateJob(AssemblyJob):
    """One bed in one file: pieces as instances, each standing on z = 0."""

    bed_name: str
    bed: BedSpec
    times: int
    feet: Mapping[str, BaseGeometry]

    @property
    def sizes(self) -> tuple[float, float, float]:
        """Width, depth and height of its bed, mm."""
        return self.bed.width, self.bed.depth, self.bed.height

    @property
    def pieces(self) -> tuple[BoardPiece, ...]:
        """Its pieces as they are seen from above."""
        return tuple(BoardPiece(i.id, i.part, round(math.degrees(i.rotation)), i.centre) for i in self.instances)

    @property
    def told(self) -> dict[str, Any]:
        """The bed, and where each piece stands: its part, the place of its origin, mm, and its turn, degrees."""
        pieces = {
            i.id: {"part": i.part, "at": list(i.at), "turn_deg": round(math.degrees(i.rotation))}
            for i in self.instances
        }
        return {"part": None, "bed": self.bed_name, "times": self.times, "pieces": pieces}

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """Remarks on what is on it."""
        return (*super().findings(made), *several(self.export, self.times))

    @property
    def expected(self) -> ExpectedAssembly:
        """What its file must hold: all of it on the bed, each piece clear of the others."""
        return replace(super().expected, bed=self.bed)


def plate_jobs(asked: Request) -> list[PlateJob]:
    """The files of one export: every plate of every bed, counted through.

    Raises
    ------
    SceneError
        Parts are larger than their bed.
    """
    found: list[PlateJob] = []
    scene, export = asked.scene, asked.export
    for name, bed in scene.beds.items():
        place = f"beds.{name}"
        made = [p for p, part in asked.parts.items() if export.parts or not part.is_bought]
        wanted = [p for p in bed.parts or made if p in asked.wanted]
        counts = pieces_of(bed, wanted, scene.instances, asked.source, place)
        jobs = {p: asked.job(asked.parts[p]) for p in counts}
        feet = {p: _footprint(job, asked.source) for p, job in jobs.items()}
        laid = _laid_out(bed, feet, counts, asked.source, place)
        for pieces, times in different_boards(laid):
            stand = tuple(
                Instance(p.id, p.part, (p.at.real, p.at.imag, -feet[p.part][1]), math.radians(p.turn_deg), "plate")
                for p in pieces
            )
            members = tuple(jobs[p] for p in dict.fromkeys(piece.part for piece in pieces))
            path = f"{asked.stem}.{len(found) + 1}.{export.format}"
            hulls = {p: feet[p][0] for p in counts}
            of_scene = assembly_name(scene), export, members, stand, path, asked.where
            found.append(PlateJob(*of_scene, name, bed, times, hulls))
    return found


def instances_of(pieces: Mapping[str, Mapping[str, Any]]) -> list[Instance]:
    """The pieces of a plate as a report has them."""
    return [
        Instance(name, told["part"], tuple(told["at"]), math.radians(told["turn_deg"]), "plate")
        for name, told in pieces.items()
    ]


def _footprint(job: Job, source: str) -> tuple[BaseGeometry, float, float]:
    """The hull of a solid seen from above, and its lowest and highest z, mm; refused where no chords keep its walls."""
    import shapely

    from parts.solids.mesh import body_mesh, mesh_outlines

    for chords in _CHORDS:
        with suppress(ThinWallError):
            outlines = mesh_outlines(job.body, chords, 64 * number_rounding(job))
            vertices = body_mesh(job.body, outlines).vertices
            hull = shapely.MultiPoint(vertices[:, :2]).convex_hull.buffer(_CHORDS[0])
            return hull, float(vertices[:, 2].min()), float(vertices[:, 2].max())
    place, told = f"{job.place}.tolerance", {"part": job.part.id}
    raise SceneError(source, place, job.asked, "wall_too_thin_for_mesh", None, "mm", **told)


def _laid_out(
    bed: BedSpec,
    feet: Mapping[str, tuple[BaseGeometry, float, float]],
    counts: Mapping[str, int],
    source: str,
    place: str,
) -> list[Laid]:
    room = Room(bed.width, bed.depth, bed.margin, bed.gap, QUARTERS)
    every = {p: min(largest_scale(foot, room), bed.height / (high - low)) for p, (foot, low, high) in feet.items()}
    scales = {part: scale for part, scale in every.items() if scale < 1}
    if scales:
        told = [
            Message("{part} ({scale})", {"part": p, "scale": f"{rounded(s, up=False):g}"}) for p, s in scales.items()
        ]
        # the height is to blame where it alone is
        wide = any(largest_scale(feet[part][0], room) < 1 for part in scales)
        boxes = [sorted((e - a, f - b)) for a, b, e, f in (foot.bounds for foot, _, _ in feet.values())]
        short, long = (max(side) for side in zip(*boxes, strict=True))
        side = "width" if lacking(room, long, short) == "width" else "depth"
        key, size = (side, getattr(bed, side)) if wide else ("height", bed.height)
        sides = [math.ceil(one + 2 * bed.margin) for one in (short, long)]
        high = math.ceil(max(top - low for _, low, top in feet.values()))
        raise SceneError(
            source, f"{place}.{key}", size, "too_small_for_parts", None, "mm",
            parts=listed(told), width=sides[1], depth=sides[0], height=high,
        )  # fmt: skip
    return nest({p: (feet[p][0], counts[p]) for p in counts}, room)
