"""A body that is its faces: what a kind hands over whose solid no plane outlines sweep.

A kind's ``solid`` gives a ``FacedBody``; STL, 3MF, STEP, mass, read-back and interference follow. Where its surfaces
are planes and surfaces of revolution, the faces are exact, and ``exact_body(solid)`` is all. Where some are splines,
``within`` makes them for a tolerance with their declared error, and ``walls`` tell how far points lie from what they
approximate, by a way of their own: read-back holds files against that, and never against the splines.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from functools import cached_property
from typing import ClassVar, Literal

from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.base.tolerance import PRECISION
from geometry.curves.bounds import Bound
from geometry.curves.curve import Real
from geometry.solids.area import surface_area
from geometry.solids.charts import charts
from geometry.solids.extent import extent
from geometry.solids.face_moments import face_moments
from geometry.solids.faces import Extrusion, Solid, SplineSurface
from geometry.solids.mass import Moments
from geometry.solids.measured import Measured

# of triangles of every bundle of spline faces: how far they leave the exact walls at most, mm, this near to the truth
Proof = Callable[[list[Real], float], float]
# to which the splines are made whose moments and box are asked for, mm
_FINE = 1e-5
# and of a kind that knows both itself, for its other surfaces
_ROUGH = 1e-2


class FacedSolid(Record, eq=False):
    """The faces of a body, and how far they leave the exact one, mm, like an Approximation."""

    geometry: Solid
    max_error: float = 0.0
    bound: Bound = "exact"


class FacedBody(Record, dict=True):
    """A body told by its faces, closed for every tolerance.

    ``within``: the faces within a tolerance, mm; ``walls``: the exact surfaces that its splines stand for, in any
    number; ``own_moments``: where the kind knows them better than its faces do; ``proof``: where it can prove how far
    triangles (n, 3, 3) leave the walls, mm, bundle after bundle of its spline faces: its other surfaces are exact.
    ``own_ends``: its lowest and highest place and its greatest distance from the axis, mm, where the kind knows them.
    ``precision``: within which its edges lie on its faces and end at their vertices, mm. ``coarsest``: the greatest
    tolerance for which its mesh has triangles of every face, mm. ``whole``: its walls tell every surface, and may
    measure points up to ``sideways`` times as far off as they are.
    """

    within: Callable[[float], FacedSolid]
    walls: tuple[Measured, ...] = ()
    own_moments: Callable[[], Moments] | None = None
    proof: Proof | None = None
    own_ends: tuple[float, float, float] | None = None
    precision: float = PRECISION
    coarsest: float = math.inf
    whole: bool = False
    sideways: float = 1.0
    is_faced: ClassVar[Literal[True]] = True

    @cached_property
    def _fine(self) -> Solid:
        """Faces as near as they can be made, down to ``_FINE``."""
        for tolerance in (_FINE, 1e2 * _FINE):
            with suppress(ConvergenceError):
                return self.within(tolerance).geometry
        return self.within(1e4 * _FINE).geometry

    @cached_property
    def surfaces(self) -> tuple[Measured, ...]:
        """Every exact surface once."""
        if self.whole:
            return self.walls
        found: dict[object, Measured] = {}
        # those that are no splines are exact however near these are
        solid = self._fine if self.own_ends is None else self.within(_ROUGH).geometry
        for faces in solid.faces:
            if isinstance(faces.surface, SplineSurface | Extrusion):
                continue
            for chart in charts(solid, faces.surface, len(faces.loops[0][0])):
                found.setdefault(chart.alike, Measured(str(chart.alike[0]), chart.distance, int(not chart.is_central)))
        return (*self.walls, *found.values())

    @cached_property
    def moments(self) -> Moments:
        """Volume, centre and inertia: exact but for splines, whose volume is good to their error over their area."""
        return face_moments(self._fine) if self.own_moments is None else self.own_moments()

    @cached_property
    def slack(self) -> float:
        """How much the volume of ``moments`` may be off for each mm that a file's faces are, mm^2; 0: exact."""
        return surface_area(self._fine) if self.walls and self.own_moments is None else 0.0

    @cached_property
    def _ends(self) -> tuple[float, float, float]:
        if self.own_ends is not None:
            return self.own_ends
        found = extent(self._fine)
        return float(found.low[2]), float(found.high[2]), found.radius

    def levels(self) -> tuple[float, float]:
        """Its lowest and highest place, mm."""
        return self._ends[:2]

    def section_reach(self) -> float:
        """Greatest distance from the axis, mm."""
        return self._ends[2]

    def reach(self) -> float:
        """Greatest coordinate, mm."""
        return max(self.section_reach(), *map(abs, self.levels()))

    def steepness(self) -> float:
        """1: a step along the axis moves a surface by no more than itself."""
        return 1.0


def exact_body(solid: Solid | FacedSolid) -> FacedBody:
    """The body of a solid without spline surfaces, alike for every tolerance."""
    made = solid if isinstance(solid, FacedSolid) else FacedSolid(solid)
    return FacedBody(lambda _: made)
