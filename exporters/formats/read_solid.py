"""What is known of the solids of a STEP file: curves, faces, which edges bound them, and what was measured on them."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from exporters.formats.read_curves import Curves, Frames, Patches, lobatto, spans_of
from exporters.formats.read_part21 import Index
from geometry.base.record import Record, replace
from geometry.curves.curve import Flags, Real
from parts.base.readback import ReadError

# axes are upright, and heights are one, so well: 1 - cosine, mm
SQUARE, LEVEL = 1e-12, 1e-7
_OF_FACES = ("faces", "kind", "solid", "sizes", "normal", "moved", "flux", "area", "gap")
PLANE, ROUND, SPHERE, TORUS, EXTRUSION, SPLINE = range(6)
# edges lie on their surfaces and end at their vertices as well as a file itself says, mm: this well, or worse by this
GAP, LOOSEST = 1e-7, 1e-6


class Uses(Record, eq=False):
    """Edges as the bounds of faces use them, (u,) each, loop after loop: edge, loop, face, and the way.

    ``along``: whether the loop runs along the edge; ``left``: whether the face lies on its left, seen from its normal.
    """

    edge: Index
    loop: Index
    face: Index
    along: Flags
    left: Flags


class Model(Record, eq=False, dict=True):
    """The solids of a file, measured.

    Edges (e,) are the first of ``curves``; those after them are the ones that extrusions move. Of all spans ``points``
    and ``slopes`` (n, 12, 3) at ``lobatto()``. Of faces (f,) ``kind``, ``solid``, ``frames``, ``sizes`` (f, 2),
    whether the ``normal`` is the surface's, and the curve that an extrusion has ``moved``; ``flux``: the share of the
    volume, ``area``, mm^2, and ``gap``, mm, between it and its edges. ``faces``, ``edges``, ``solids``: ids.
    """

    solids: Index
    edges: Index
    straight: Flags
    curves: Curves
    points: Real
    slopes: Real
    uses: Uses
    faces: Index
    kind: Index
    solid: Index
    frames: Frames
    sizes: Real
    normal: Flags
    moved: Index
    patches: tuple[Patches, ...]
    flux: Real
    area: Real
    gap: Real

    @cached_property
    def spans(self) -> tuple[Index, Index]:
        """The spans of all uses, and the use that each belongs to."""
        return spans_of(self.curves, self.uses.edge)

    @cached_property
    def owners(self) -> Index:
        """Which of ``patches`` each face is of; -1: of none."""
        found = np.full(len(self.faces), -1)
        for number, patches in enumerate(self.patches):
            found[patches.faces] = number
        return found

    @property
    def bounds(self) -> float:
        """The length of the bounds of all faces, mm."""
        sizes = np.linalg.norm(self.slopes, axis=2) @ lobatto()[1]
        return float(sizes[self.spans[0]].sum())

    @cached_property
    def heights(self) -> tuple[Real, Real]:
        """The least and the greatest z on the edges of each face, mm."""
        span, use = self.spans
        face, z = self.uses.face[use], self.points[span, :, 2]
        low, high = np.full(len(self.faces), np.inf), np.full(len(self.faces), -np.inf)
        np.minimum.at(low, face, z.min(axis=1))
        np.maximum.at(high, face, z.max(axis=1))
        return low, high

    @property
    def is_upright(self) -> Flags:
        """Which faces stand upright."""
        along = np.abs(self.frames.axes[:, 2, 2])
        swept = (self.kind == EXTRUSION) | ((self.kind == ROUND) & (self.sizes[:, 1] == 0))
        return np.where(swept, along > 1 - SQUARE, (self.kind == PLANE) & (along < SQUARE))

    def feet(self, walls: Index) -> tuple[Index, Index]:
        """The spans on which upright walls stand, and the wall of each.

        Raises
        ------
        ReadError
            A wall has no edge across the axis at its lower end.
        """
        span, use = self.spans
        face, low = self.uses.face[use], self.heights[0]
        mine = np.isin(face, walls) & (np.abs(self.points[span, :, 2] - low[face][:, None]).max(axis=1) <= LEVEL)
        lost = ~np.isin(walls, face[mine])
        if np.any(lost):
            raise ReadError(f"#{self.faces[walls[lost][0]]} of the STEP file does not stand across the axis")
        return span[mine], face[mine]

    def only(self, number: int) -> Model:
        """One of the solids, with all edges of the file."""
        if len(self.solids) == 1:
            return self
        mine, uses = self.solid == number, self.uses
        place, used = np.cumsum(mine) - 1, mine[uses.face]
        return replace(
            self,
            solids=self.solids[[number]],
            uses=Uses(uses.edge[used], uses.loop[used], place[uses.face[used]], uses.along[used], uses.left[used]),
            frames=Frames(self.frames.origins[mine], self.frames.axes[mine]),
            patches=tuple(
                replace(p, faces=place[p.faces[own]], poles=p.poles[own])
                for p in self.patches
                if (own := mine[p.faces]).any()
            ),
            **{name: getattr(self, name)[mine] for name in _OF_FACES},
        )


def refuse(wrong: Flags, who: Index, what: str) -> None:
    """A file in which something is wrong with one of the entities ``who``, both (n,); the first is named.

    Raises
    ------
    ReadError
        That is so.
    """
    if wrong.any():
        raise ReadError(f"#{who[int(np.argmax(wrong))]} of the STEP file {what}")
