"""What the readers of files of one part give: outlines and meshes; see parts/base/readback.py."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import signed_area
from parts.base.readback import ReadLoop, refuse_if

if TYPE_CHECKING:
    from geometry.cams.contact.rolled import Outline

# a file that is larger, or unpacks to more, is none of ours
MOST_READ_BYTES = 1_000_000_000


_Name = TypeVar("_Name")


def closed_chains(following: dict[_Name, _Name]) -> list[list[_Name]]:
    """The chains of what follows what in the outline of a wall, which is used up."""
    chains = []
    while following:
        first, at = following.popitem()
        chain = [first]
        while at != first:
            refuse_if(at not in following, "the outline of a wall is not closed")
            chain.append(at)
            at = following.pop(at)
        chains.append(chain)
    return chains


class Loop(Record):
    """A closed chain as found in a file: vertices (n,), bulges (n,), the layer or id it stood on."""

    vertices: Complex
    bulges: Real
    layer: str

    @property
    def points(self) -> Complex:
        """Its vertices."""
        return self.vertices

    @property
    def size(self) -> float:
        """The area inside, mm^2."""
        return abs(signed_area(self.vertices, self.bulges))

    def outline(self, turn: complex = 1.0, *, clockwise: bool = False) -> Outline:
        """Lines and arcs for a follower to touch."""
        from geometry.cams.contact.rolled import outline_of_loop

        return outline_of_loop(self.vertices * turn, self.bulges, clockwise=clockwise)


class SmoothLoop(Record):
    """A closed chain of polynomials, ``coefficients`` (n, degree + 1) of rising powers of t from 0 to 1."""

    coefficients: Complex

    @property
    def points(self) -> Complex:
        """Where each begins."""
        return np.asarray(self.coefficients[:, 0])

    @property
    def size(self) -> float:
        """Its width, mm."""
        return float(np.ptp(self.coefficients[:, 0].real))

    def outline(self, turn: complex = 1.0, *, clockwise: bool = False) -> Outline:
        """Polynomial edges for a follower to touch."""
        from geometry.cams.contact.rolled import outline_of_polynomials

        return outline_of_polynomials(self.coefficients * turn, clockwise=clockwise)


class ReadFlat(Record):
    """What files of outlines say alike: they tell no names and no colours, and hold no faces."""

    is_flat = True
    colour = None

    def names(self) -> None:
        """The format has none."""

    def faces(self) -> Real:
        """None."""
        return np.zeros((0, 3, 3))


class ReadOutlines(ReadFlat):
    """A flat file of lines and arcs; ``strokes``: points of open chains of lines, engraved."""

    loops: tuple[Loop, ...]
    strokes: tuple[Complex, ...] = ()
    has_arcs = True

    def section(self, z: float) -> tuple[ReadLoop, ...]:
        """All outlines."""
        return self.loops


class ReadMesh(Record):
    """Distinct vertices (n, 3) and triangles (k, 3); name, colour, title, material: where a format has such."""

    vertices: Real
    triangles: NDArray[np.int64]
    name: str | None = None
    colour: str | None = None
    title: str | None = None
    material: str | None = None
    has_arcs = False
    is_flat = False

    def names(self) -> tuple[str, ...] | None:
        """The one name."""
        return None if self.name is None else (self.name,)

    def faces(self) -> Real:
        """Corners of the triangles."""
        return np.asarray(self.vertices[self.triangles])

    def section(self, z: float) -> tuple[ReadLoop, ...]:
        """Closed polygons in which a plane cuts the mesh; corners that stand on a straight edge are left out."""
        above = self.vertices[:, 2] > z
        corners = self.triangles[above[self.triangles].any(axis=1) & ~above[self.triangles].all(axis=1)]
        ends = np.roll(corners, -1, axis=1)
        # each cut triangle is left through one edge that goes up and one that goes down
        up, down = (~above[corners] & above[ends]).argmax(axis=1), (above[corners] & ~above[ends]).argmax(axis=1)
        row = np.arange(len(corners))
        following = dict(
            zip(
                zip(corners[row, down].tolist(), ends[row, down].tolist(), strict=True),
                zip(ends[row, up].tolist(), corners[row, up].tolist(), strict=True),
                strict=True,
            )
        )
        points = [self._cut(np.array(chain), z) for chain in closed_chains(following)]
        return tuple(Loop(own, np.zeros(len(own)), "") for own in points)

    def _cut(self, keys: NDArray[np.int64], z: float) -> Complex:
        a, b = self.vertices[keys[:, 0]], self.vertices[keys[:, 1]]
        share = (z - a[:, 2]) / (b[:, 2] - a[:, 2])
        points = a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2])
        places = points[:, 0] + 1j * points[:, 1]
        # an edge between two upright ones has a corner on either: it is a diagonal of the plane wall between them
        upright = np.all(a[:, :2] == b[:, :2], axis=1)
        return np.asarray(places[upright | ~(np.roll(upright, 1) & np.roll(upright, -1))])
