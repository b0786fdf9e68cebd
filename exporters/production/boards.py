"""Boards among the files of a build: flat parts laid out on them, cut in order, held to account."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec.structs import replace as with_keys

from exporters.boards.cuts import in_order
from exporters.boards.nest import HALVES, QUARTERS, DoesNotFitError, Laid, Room, lacking, least_side, nest
from exporters.formats.registry import strokes_of, write_outlines
from exporters.production.jobs import Job, Made, PartsJob, several
from exporters.production.request import Request
from exporters.verification.board import BoardPiece, ExpectedBoard, verify_board
from exporters.verification.verdict import Verdict
from geometry.approximation.chords import approximate_profile
from geometry.base.errors import Nearest, rounded
from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from geometry.plane.contour import Approximation, Contour
from geometry.plane.profile import Profile, Region
from parts.base.refusal import SceneError
from parts.keys.boards import BoardSpec
from parts.scene.boards import parts_of_board, pieces_of
from parts.scene.scene_file import ExportSpec

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# outlines are laid as chords so near to them, mm; places are told to so many decimals
_CHORDS, _DECIMALS = 0.02, 4
# of numbers on a board: what is turned and moved keeps the digits of the part's own file
_FILE_DECIMALS = 12
_MORE = 1 + 1e-12


class BoardJob(Record, PartsJob):
    """One board in one file."""

    export: ExportSpec
    name: str
    board: BoardSpec
    members: tuple[Job, ...]
    pieces: tuple[BoardPiece, ...]
    times: int
    path: str
    place: str

    @property
    def sizes(self) -> tuple[float, float, float]:
        """Width, height and thickness of the board, mm."""
        return self.board.width, self.board.height, self.board.thickness

    @property
    def told(self) -> dict[str, Any]:
        """The board, and where each piece lies: its part, the place of its origin, mm, and its turn, degrees."""
        return {"part": None, "board": self.name, "times": self.times, "pieces": {p.id: p.told for p in self.pieces}}

    def cuts(self, made: Made) -> tuple[tuple[str, ...], tuple[Approximation, ...]]:
        """The layers and boundaries of all pieces in their places, in the order in which they are cut."""
        rows = []
        of_part = {m.part.id: m for m in self.members}
        for piece in self.pieces:
            job = of_part[piece.part]
            for layer, boundary in zip(job.section.region.layers(), job.chords(made), strict=True):
                vertices, bulges = boundary.geometry.expanded()
                moved = Contour(piece.moved(vertices), bulges, decimals=_FILE_DECIMALS)
                rows.append((layer, replace(boundary, geometry=moved)))
        return in_order(rows)

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write all pieces in their places; counts of what is in the file."""
        layers, boundaries = self.cuts(made)
        own = {m.part.id: strokes_of(m) for m in self.members}
        strokes = [np.round(p.moved(stroke), _FILE_DECIMALS) + 0.0 for p in self.pieces for stroke in own[p.part]]
        size = complex(self.board.width, self.board.height)
        counts = write_outlines(file, self.export, layers, boundaries, strokes, size)
        return {**counts, "pieces": len(self.pieces)}

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """Those on its parts, and how often it is cut."""
        return (*super().findings(made), *several(self.export, self.times))

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back: every piece whole and in its place, on the board, clear of the others."""
        expected = ExpectedBoard(self.board, self.parts, self.pieces, self.offset)
        return verify_board(file, self.export.kind, expected, declared, self.tolerance)


def board_jobs(asked: Request, layouts: dict[object, list[Laid]]) -> list[BoardJob]:
    """The files of one export: every board of every table, counted through.

    ``layouts``: those that are made already, which exports of one scene share.

    Raises
    ------
    SceneError
        A board has no part, or a part is larger than its board; or a kerf that an outline does not survive.
    """
    found: list[BoardJob] = []
    parts, export, source = asked.parts, asked.export, asked.source
    for name, board in asked.scene.boards.items():
        place = f"boards.{name}"
        own = replace(asked, export=with_keys(export, kerf=board.kerf), where=place)
        wanted = [p for p in parts_of_board(board, parts, source, place) if p in asked.wanted]
        counts = pieces_of(board, wanted, asked.scene.instances, source, place)
        lying = replace(own, export=with_keys(own.export, parts=[*counts]))
        jobs = {p: Job(parts[p], own.export, lying.section(parts[p], board.gap), "", asked.where) for p in counts}
        key = (name, tuple(counts), export.tolerance)
        if key not in layouts:
            layouts[key] = _laid_out(board, jobs, counts, source, place)
        laid = layouts[key]
        for pieces, times in different_boards(laid):
            members = tuple(jobs[p] for p in dict.fromkeys(piece.part for piece in pieces))
            path = f"{asked.stem}.{len(found) + 1}.{export.format}"
            found.append(BoardJob(own.export, name, board, members, pieces, times, path, asked.where))
    return found


def different_boards(laid: Sequence[Laid]) -> list[tuple[tuple[BoardPiece, ...], int]]:
    """The boards that differ, each with how many there are of it; pieces are counted through by their parts."""
    boards: dict[int, list[Laid]] = {}
    for one in laid:
        boards.setdefault(one.board, []).append(one)
    times = Counter(tuple((one.shape, one.turn, one.at) for one in here) for here in boards.values())
    named: Counter[str] = Counter()
    found = []
    for places, count in times.items():
        pieces = []
        for shape, turn, at in places:
            named[shape] += 1
            pieces.append(BoardPiece(f"{shape}_{named[shape]}", shape, 90 * turn, at))
        found.append((tuple(pieces), count))
    return found


def _laid_out(
    board: BoardSpec, jobs: Mapping[str, Job], counts: Mapping[str, int], source: str, place: str
) -> list[Laid]:
    tolerance = max((job.tolerance for job in jobs.values()), default=0.0)
    # both outlines may come nearer by what their chords and files leave of them
    more = 2 * (_CHORDS + tolerance) + 2 * 10.0**-_DECIMALS
    room = Room(
        board.width, board.height, board.margin + more / 2, board.gap + more, HALVES if board.grain else QUARTERS
    )
    shapes = {p: (material(job.section.region), counts[p]) for p, job in jobs.items()}
    try:
        laid = nest(shapes, room)
    except DoesNotFitError as refusal:
        side, part, size = lacking(room, *refusal.size), refusal.shape, refusal.size
        boxes = {p: (box[2] - box[0], box[3] - box[1]) for p, box in ((p, s.bounds) for p, (s, _) in shapes.items())}
        needs = {p: least_side(room, side, *box) for p, box in boxes.items()}
        offer = None
        if math.isfinite(most := max(needs.values())):
            part = max(needs, key=lambda p: needs[p])
            size = boxes[part]
            # margins that are taken off again may round the last digit down
            offer = Nearest(rounded(most * _MORE, up=True), "at_least")
        raise SceneError(
            source, f"{place}.{side}", getattr(board, side), "too_small_for_part", offer, "mm",
            part=part, width=round(size[0], 3), height=round(size[1], 3), margin=board.margin,
        ) from refusal  # fmt: skip
    return [replace(one, at=complex(round(one.at.real, _DECIMALS), round(one.at.imag, _DECIMALS))) for one in laid]


def material(region: Region) -> BaseGeometry:
    """The material of a section as polygons, near enough to be laid out, mm."""
    import shapely

    def ring(profile: Profile) -> BaseGeometry:
        vertices, _ = approximate_profile(profile, _CHORDS, arcs=False).geometry.expanded()
        return shapely.Polygon(np.stack([vertices.real, vertices.imag], axis=1))

    outer = shapely.union_all([ring(p) for p in (region.outer, *region.apart)])
    return shapely.difference(outer, shapely.union_all([ring(p) for p in region.holes]))
