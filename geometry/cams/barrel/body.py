"""The solid of a cylindrical cam: cylinders, plane faces, a bore, and the walls that the roller runs on.

Every face lies between closed rings about the axis: circles, or the edges of walls on a cylinder. Meshes, B-reps,
read-back and mass integrals go through this description, like those of other parts through geometry/solids/body.py.
"""

from __future__ import annotations

import numpy as np

from geometry.base.gauss import panels
from geometry.base.record import Record
from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.curves.curve import Complex, Real
from geometry.laws.piece import LawPiece
from geometry.plane.profile import Label, Profile, circle
from geometry.solids.mass import Moments, column_integrals, moments_of, section_moments

# Gauss's rule over the cam angle (panels a piece) and across the walls, at first and at most; what is no change
_POINTS, _PANELS, _ACROSS = 20, 3, 12
_MOST_PANELS, _MOST_ACROSS, _SETTLED = 96, 48, 1e-12
# beyond its ends a wall is sought so far, part of the inner radius
_NEAR = 0.05


class Ring(Record):
    """A closed ring about the axis: a circle of ``radius`` at ``z``, or (``side`` not 0) a wall's edge there; mm."""

    radius: float
    z: float = 0.0
    side: int = 0


class Cylinder(Record):
    """The part of a cylinder about the axis between two rings; ``outward``: its material lies inside."""

    lower: Ring
    upper: Ring
    outward: bool = True


class Plane(Record):
    """A face across the axis within a circle; what is cut out of it: a circle, or the bore's profile."""

    outer: Ring
    inner: Ring | None
    bore: Profile | None
    up: bool


class Track(Record):
    """A wall between the cylinders: +1 above the roller, -1 below it."""

    side: int
    inner: Ring
    outer: Ring

    def distance(self, cam: BarrelCam, points: Real) -> Real:
        """Of points (n, 3), mm, also beyond its ends: by the roller's way where one is near it, else the way to there.

        The way knows nothing of how the wall was made.
        """
        size = np.hypot(points[:, 0], points[:, 1])
        beyond = np.maximum(0.0, np.maximum(cam.inner - size, size - cam.outer))
        found = np.full(len(points), np.inf)
        near = beyond <= _NEAR * cam.inner
        away, above = cam.nearest(points[near])
        # points on the other side of the roller belong to the other wall
        found[near] = np.where(above * self.side > 0, np.hypot(away, beyond[near]), np.inf)
        return found


class BoreWall(Record):
    """The upright wall of the bore's profile between two heights, mm."""

    profile: Profile
    low: float
    high: float


Face = Cylinder | Plane | Track | BoreWall


class BarrelBody(Record):
    """A cylindrical cam as a solid, z from 0 to ``length`` mm without its hub.

    ``hub``: its radius, and how far it stands out below and above; ``web``: thickness of the bottom of an end cam,
    0 leaves an open tube; ``bore``: its profile, clockwise.
    """

    cam: BarrelCam
    length: float
    bore: Profile | None = None
    hub: tuple[float, float, float] | None = None
    web: float = 0.0

    def faces(self) -> tuple[Face, ...]:
        """All faces, from the bottom to the top."""
        cam, below, above = self.cam, 0.0, self.length
        outer, inner = cam.outer, cam.inner
        found = self._end(0.0, outer, up=False)
        low = Ring(outer, 0.0, LOWER), Ring(inner, 0.0, LOWER)
        found += [Cylinder(Ring(outer, below), low[0]), Track(LOWER, low[1], low[0])]
        if cam.is_groove:
            high = Ring(outer, 0.0, UPPER), Ring(inner, 0.0, UPPER)
            found += [Cylinder(low[1], high[1]), Track(UPPER, high[1], high[0]), Cylinder(high[0], Ring(outer, above))]
            found += self._end(above, outer, up=True)
        else:
            found.append(Cylinder(Ring(inner, self.web), low[1], outward=False))
            if self.web > 0:
                found += self._end(self.web, inner, up=True)
        if self.bore is not None:
            found.append(BoreWall(self.bore, *self.bore_ends))
        return tuple(found)

    @property
    def bore_ends(self) -> tuple[float, float]:
        """The heights of both ends of its bore, mm."""
        below, above = (0.0, 0.0) if self.hub is None else self.hub[1:]
        return -below, (self.length if self.cam.is_groove else self.web) + above

    def _end(self, z: float, radius: float, *, up: bool) -> list[Face]:
        """The plane face at an end with the hub that stands out of it."""
        if not self.cam.is_groove and self.web == 0:
            return [Plane(Ring(radius, z), Ring(self.cam.inner, z), None, up)]
        out = 0.0 if self.hub is None else self.hub[2 if up else 1]
        if self.hub is None or out == 0:
            return [Plane(Ring(radius, z), None, self.bore, up)]
        hub = self.hub[0]
        root, top = Ring(hub, z), Ring(hub, z + out if up else z - out)
        wall = Cylinder(root, top) if up else Cylinder(top, root)
        return [Plane(Ring(radius, z), root, None, up), wall, Plane(top, None, self.bore, up)]

    def columns(self) -> list[tuple[Profile, float, float]]:
        """Upright columns whose signed sum is the solid but for what the walls bound."""
        top = self.length if self.cam.is_groove else self.web
        found = [(circle(self.cam.outer, Label.BODY), 0.0, top)] if top > 0 else []
        if self.hub is not None:
            radius, below, above = self.hub
            hub = circle(radius, Label.HUB)
            found += [(hub, -below, 0.0)] if below > 0 else []
            found += [(hub, top, top + above)] if above > 0 else []
        if self.bore is not None:
            found.append((self.bore, *self.bore_ends))
        return found


def barrel_moments(body: BarrelBody) -> Moments:
    """Volume, centre and inertia: exact columns and Gauss's rule over what the walls bound, to 1e-12 of themselves.

    Under a wall, the integral over the polar angle becomes one over the cam angle with the speed of the wall's edge.
    The integrands are analytic on each piece of the motion: the number of panels is doubled until nothing changes.
    """
    along, across = _PANELS, _ACROSS
    total = _integrals(body, along, across)
    while along < _MOST_PANELS:
        along, across = 2 * along, min(2 * across, _MOST_ACROSS)
        finer = _integrals(body, along, across)
        done = np.abs(finer - total).max(initial=0.0) <= _SETTLED * np.abs(finer).max()
        alike = abs(finer[0] - total[0]) <= _SETTLED * abs(finer[0])
        total = finer
        if done and alike:
            break
    return moments_of(total)


def _integrals(body: BarrelBody, along: int, across: int) -> Real:
    """Integrals of 1, x, y, z, xx, yy, xy, zz, xz, yz with so many panels a piece and nodes across the walls."""
    total = np.zeros(10)
    for profile, low, high in body.columns():
        total += column_integrals(section_moments(profile), low, high)
    cam = body.cam
    radii, weights = panels(np.array([cam.inner, cam.outer]), across)
    # a groove is what lies under its upper wall and not under its lower one; an end cam stands under its wall
    for side in cam.sides:
        sign = -side if cam.is_groove else 1
        base = 0.0 if cam.is_groove else body.web
        for piece in cam.motion.pieces:
            angles, share = panels(np.linspace(piece.start, piece.end, along + 1), _POINTS)
            polar, height, speed = _edges(cam, side, radii, angles, piece)
            measure = weights * radii * speed * share[:, None]
            total += sign * _under(radii * np.exp(1j * polar), base, height, measure)
    return total


def _edges(cam: BarrelCam, side: int, radii: Real, angles: Real, piece: LawPiece) -> tuple[Real, Real, Real]:
    """Polar angle, height and speed of a wall's edges, (angles, radii)."""
    points = cam.wall(angles[:, None], side, radii, piece)
    speed = cam.edge_speed(angles[:, None], side, radii, piece)
    return np.angle(points[..., 0] + 1j * points[..., 1]), points[..., 2], speed


def _under(plane: Complex, base: float, height: Real, measure: Real) -> Real:
    """The same integrals over what stands between a base and the heights at plane points with their areas."""
    h, h2, h3 = height - base, (height**2 - base**2) / 2, (height**3 - base**3) / 3
    x, y = plane.real, plane.imag
    terms = (h, x * h, y * h, h2, x * x * h, y * y * h, x * y * h, h3, x * h2, y * h2)
    return np.array([float(np.sum(t * measure)) for t in terms])
