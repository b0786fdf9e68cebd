"""The least gap of two meshing bodies at given drive angles: teeth near the line of centres, and others as they matter.

The gap is the least signed distance of all points of the second body's outline from the first gear's, and of the first
gear's convex corners from the second's. Each drive angle has two groups, 2 k + side: 0 at the lower sides of the first
gear's teeth, 1 at the upper ones.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geometry.contact import Flags, Indices
from geometry.curve import Complex, Real
from geometry.gears.far_teeth import Measured, promising_places
from geometry.gears.least_gap import Copies, Gaps

if TYPE_CHECKING:
    from geometry.gears.mesh_search import MeshSearch

# teeth on either side of the line of centres that are measured at once where there are more than _MOST_NEAR
_NEAR_TEETH, _MOST_NEAR = 2, 4
# far teeth are excluded by gaps that are known to this part of the module
_ROUGH = 5e-4


class FarTeeth(NamedTuple):
    """What earlier searches of a mesh, at one turn of its second body, have learned of far teeth."""

    second: Measured
    corners: Measured

    @classmethod
    def unknown(cls) -> FarTeeth:
        """Nothing yet."""
        return cls(Measured(), Measured())


def least_gaps(mesh: MeshSearch, drive: Real, turn: Real | float = 0.0, far: FarTeeth | None = None) -> Gaps:
    """Least gaps at drive angles (n,), rad, for both sides: groups 2 k + side.

    ``turn``: the second body's motion beyond ``mesh.second_position``, rad or mm: (n,) or one number for all.
    ``far``: what is known of far teeth at that turn, and learns more.
    """
    offset = np.broadcast_to(np.asarray(turn, dtype=float), drive.shape)
    found, far = Gaps.unknown(2 * len(drive)), far or FarTeeth.unknown()
    _Second(mesh, drive, offset, mesh.second_position(drive) + offset, found, far.second).search()
    if mesh.outlines[0].convex_corners:
        _Corners(mesh, drive, offset, found, far.corners).search()
    return found


def _near(teeth: int) -> int:
    return teeth if teeth <= _MOST_NEAR else _NEAR_TEETH


def _slack(mesh: MeshSearch, offset: Real) -> float:
    """mm that teeth at one drive angle stand off the way that they take at another."""
    return float(np.ptp(offset)) * mesh.reach


@dataclass(frozen=True, slots=True)
class _Second:
    """The second body's teeth at the drive angles, measured on the first gear's outline."""

    mesh: MeshSearch
    drive: Real
    offset: Real
    position: Real
    found: Gaps
    known: Measured

    def search(self) -> None:
        """Teeth near the line of centres first: they tell how little a far one must have to matter."""
        mesh, half = self.mesh, self.mesh.half
        number = np.arange(-mesh.second_teeth, mesh.second_teeth + 1)
        inner = np.abs(number) <= _near(mesh.second_teeth)
        angle, copy = self._teeth(number[inner])
        copies = self._copies(np.repeat(angle, 2), np.repeat(copy, 2), np.tile([0, 1], len(angle)))
        radii = half.radii(copies)
        # the outline lies between root and tip circle: what is farther out than this cannot hold the least
        closest = np.full(len(self.drive), mesh.radii[0])
        nearest = np.min(radii, axis=0).reshape(len(self.drive), -1).min(axis=1)
        closest = np.maximum(closest, nearest)
        limit = closest + (mesh.radii[1] - mesh.radii[0]) + half.longest
        half.search(copies, [r <= limit[copies.group // 2] for r in radii], self.found)
        if not inner.all():
            self._far(*self._teeth(number[~inner]), closest, limit)

    def _teeth(self, number: Indices) -> tuple[Indices, Real]:
        """Index of the drive angle and number of the tooth for each tooth that many places from the facing one."""
        facing = self.mesh.facing_copy(self.position)
        return np.repeat(np.arange(len(self.drive)), len(number)), (facing[:, None] + number).ravel()

    def _far(self, angle: Indices, copy: Real, closest: Real, limit: Real) -> None:
        mesh, half = self.mesh, self.mesh.half
        way = self.drive[angle] + copy * mesh.pitches[1] / mesh.rate
        order = np.argsort(way, kind="stable")
        way, angle, copy = way[order], angle[order], copy[order]

        def placed(rows: Indices, sides: Indices) -> tuple[Copies, list[Flags]]:
            own = self._copies(angle[rows], copy[rows], sides)
            return own, [r <= limit[angle[rows]] for r in half.radii(own)]

        def measure(rows: Indices, sides: Indices) -> Real:
            (own, within), single = placed(rows, sides), Gaps.unknown(len(rows))
            half.search(own._replace(group=np.arange(len(rows))), within, single, _ROUGH)
            return np.minimum(single.gap - _ROUGH * mesh.module, closest[angle[rows]] - mesh.radii[0])

        least = self.found.gap.reshape(-1, 2)[angle]
        slack = _slack(mesh, self.offset)
        rows, sides = promising_places(way, self._speed, mesh.module, measure, least, self.known, slack)
        half.search(*placed(rows, sides), self.found)

    def _copies(self, angle: Indices, copy: Real, side: Indices) -> Copies:
        """Halves of the second body's teeth in the first gear's frame."""
        turn, shift = self.mesh.placing(self.position[angle], copy)
        back = np.exp(-1j * self.drive[angle])
        return Copies(2 * angle + side, turn * back, shift * back, side == 1)

    def _speed(self, way: Real) -> Real:
        """No point of a tooth at ``way`` moves faster against the first gear, mm per rad of the drive."""
        points = np.concatenate([s.points for s in self.mesh.half.samples])
        middle = complex(points.real.mean())
        centre, rate = self.mesh.to_fixed(np.full(way.shape, middle), way)
        return np.abs(rate - 1j * centre) + self.mesh.relative_turning * float(np.abs(points - middle).max())


@dataclass(frozen=True, slots=True)
class _Corners:
    """The first gear's convex corners at the drive angles, measured on the second body's outline."""

    mesh: MeshSearch
    drive: Real
    offset: Real
    found: Gaps
    known: Measured

    @property
    def _points(self) -> Complex:
        """Corners and their mirror images in turn: the sides of a tooth."""
        return np.array([p for c in self.mesh.outlines[0].convex_corners for p in (c, c.conjugate())])

    def search(self) -> None:
        """All corners near the line of centres, and those of the rest that may matter."""
        mesh, columns = self.mesh, len(self._points)
        facing = np.round(-self.drive / mesh.pitches[0])
        number = np.arange(-mesh.first_teeth, mesh.first_teeth + 1)
        inner = np.abs(number) <= _near(mesh.first_teeth)
        for chosen in (inner, ~inner):
            angle = np.repeat(np.arange(len(self.drive)), int(chosen.sum()))
            tooth = (facing[:, None] + number[chosen]).ravel()
            if chosen is inner:
                which = np.tile(np.arange(columns), len(angle))
                self._measured(np.repeat(angle, columns), np.repeat(tooth, columns), which)
            elif angle.size:
                self._far(angle, tooth)

    def _far(self, angle: Indices, tooth: Real) -> None:
        way = self.drive[angle] + tooth * self.mesh.pitches[0]
        order = np.argsort(way, kind="stable")
        way, angle, tooth = way[order], angle[order], tooth[order]
        points = self._points
        least = self.found.gap[2 * angle[:, None] + np.arange(len(points)) % 2]
        slack = _slack(self.mesh, self.offset)

        def speed(at: Real) -> Real:
            return np.asarray(
                np.max([np.abs(self.mesh.to_second(np.full(at.shape, p), at)[1]) for p in points], axis=0)
            )

        def measure(rows: Indices, columns: Indices) -> Real:
            return self._measured(angle[rows], tooth[rows], columns)

        measure(*promising_places(way, speed, self.mesh.module, measure, least, self.known, slack))

    def _measured(self, angle: Indices, tooth: Real, column: Indices) -> Real:
        """Gaps of corners, mm, entered into what is found."""
        mesh = self.mesh
        local = self._points[column] * np.exp(1j * tooth * mesh.pitches[0])
        feet = mesh.outlines[1].feet(
            mesh.second_folded(*mesh.to_second(local, self.drive[angle], self.offset[angle]))[0]
        )
        segment = np.repeat([self._segment(c) for c in mesh.outlines[0].convex_corners], 2)
        self.found.keep(2 * angle + column % 2, feet.distance, local, segment[column], feet.curve_index)
        return feet.distance

    def _segment(self, corner: complex) -> int:
        """The segment of the first gear that a corner ends."""
        ends = [abs(complex(s.curve.point(s.curve.domain[1])) - corner) for s in self.mesh.first_segments]
        return int(np.argmin(ends))
