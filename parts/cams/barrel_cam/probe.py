"""Cylindrical cams: the roller is put into the groove of a mesh read back, and its way held against the exact law."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from geometry.cams.barrel.body import BarrelBody
from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.cams.motion.follower_motion import TURN, PhaseKind
from geometry.curves.curve import Complex, Real
from parts.base.readback import Probed, ReadBack

ANGLES = 3600
# planes across the roller's axis in which it is put into the groove, as shares of the walls' width
_PLANES = (0.02, 0.5, 0.98)
# triangles of one radius or one height are no walls: this part of the size is rounding
_FLAT = 1e-5
# what bends of the way add to the shift of a wall along the axis, and the rounding of it all
_BEND, _ROUNDING = 1.1, 1e-9


@dataclass(frozen=True, slots=True)
class GrooveRoller:
    """The roller in the groove of a cylindrical cam, ``body(offset)``; its diameter, mm."""

    body: Callable[[float], BarrelBody]
    diameter: float
    name: str = ""
    needs_whole = False

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """Errors of its place along the axis, and its play; see ``parts.base.readback.Probe``.

        A roller that is smaller by the ``offset`` is put in. Only what a file has of triangles is asked.
        """
        corners = file.faces()
        if not len(corners):
            return Probed()
        body = self.body(offset)
        cam = body.cam
        found, played = rolled_places(corners, cam, (cam.radius, self.diameter / 2 - offset / cam.upright))
        axis = cam.place(np.arange(ANGLES) * (TURN / ANGLES), 0)[0].imag
        error = np.array([found[side] - axis for side in cam.sides])
        if not np.all(np.isfinite(error)):
            at = math.degrees(float(np.flatnonzero(~np.isfinite(error).all(axis=0))[0]) * TURN / ANGLES)
            return Probed(failures=(f"the roller finds no wall at cam angle {at:.6g} degrees",))
        measured = {"lift_error": float(np.abs(error).max())}
        if cam.is_groove:
            play = played[UPPER] - played[LOWER]
            measured |= {"least_play": float(play.min()), "greatest_play": float(play.max())}
        worst = int(np.argmax(np.abs(error).max(axis=0)))
        if measured["lift_error"] <= _allowed(cam, declared) + _ROUNDING * body.reach():
            return Probed(measured)
        place = f"cam angle {360 * worst / ANGLES:.6g} degrees"
        text = f"the roller's place is wrong by {measured['lift_error']:.6g} mm at {place}, more than the walls allow"
        return Probed(measured, (text,))


def _allowed(cam: BarrelCam, declared: float) -> float:
    """How far a wall that is off by so much may shift the roller along the cam's axis, mm."""
    kinds = (PhaseKind.RISE, PhaseKind.RETURN)
    steepest = max(cam.greatest_pressure_angle(kind)[0] for kind in kinds)
    return _BEND * declared / math.cos(steepest)


def rolled_places(faces: Real, cam: BarrelCam, radii: Sequence[float], count: int = ANGLES) -> list[dict[int, Real]]:
    """For each radius of a roller, the heights (count,) of its axis where it touches the wall below, and the one above.

    ``faces``: corners (n, 3, 3) of triangles, mm.

    In planes across its axis, against every edge of the mesh's section: exact for triangles. inf where there is none.
    """
    corners = _wall_corners(faces, cam)
    plane = corners[:, :, 0] + 1j * corners[:, :, 1]
    middle = np.angle(plane.sum(axis=1))
    spread = np.abs(np.angle(plane / np.exp(1j * middle)[:, None])).max() if len(middle) else 0.0
    order = np.argsort(middle)
    middle, corners = middle[order], corners[order]
    aside = max(map(abs, cam.side_range()))
    window = math.asin(min(1.0, (max(radii) + aside) / cam.inner)) + spread
    planes = cam.inner + (cam.outer - cam.inner) * np.array(_PLANES)
    angles = np.arange(count) * (TURN / count)
    place = cam.place(angles, 0)[0]
    found = [{side: np.zeros(count) for side in cam.sides} for _ in radii]
    # what a cone's radius is off at each plane
    thinner = cam.taper * (planes - cam.reference)
    doubled = np.concatenate([middle - TURN, middle, middle + TURN])
    for k, angle in enumerate(angles.tolist()):
        polar = math.remainder(-angle, TURN)
        first, last = np.searchsorted(doubled, [polar - window, polar + window])
        near = corners[np.arange(first, last) % len(corners)]
        turned = (near[:, :, 0] + 1j * near[:, :, 1]) * np.exp(1j * angle)
        starts, ends, at = _sections(turned, near[:, :, 2], planes)
        starts, ends = starts - place[k], ends - place[k]
        thin = thinner[at]
        for side in cam.sides:
            for of_radius, touched in zip(found, _touched(starts, ends, side, radii, thin), strict=True):
                # below, the highest place counts; above, the lowest
                of_radius[side][k] = place[k].imag + (-touched if side == UPPER else touched)
    return found


def _wall_corners(corners: Real, cam: BarrelCam) -> Real:
    """Corners (n, 3, 3) of the triangles that go across a wall: those of one radius or one height are none."""
    radius = np.hypot(corners[:, :, 0], corners[:, :, 1])
    across = np.ptp(radius, axis=1) > _FLAT * cam.outer
    inside = (radius.max(axis=1) <= cam.outer * (1 + _FLAT)) & (radius.min(axis=1) >= cam.inner * (1 - 0.05))
    return np.asarray(corners[across & inside])


def _sections(turned: Complex, heights: Real, planes: Real) -> tuple[Complex, Complex, NDArray[np.int64]]:
    """Ends y + iz of the segments in which triangles are cut by planes x = const, and the number of its plane."""
    above = turned.real > planes[:, None, None]
    number = above.sum(axis=2)
    plane, row = np.nonzero((number == 1) | (number == 2))
    # the corner that stands alone on its side
    alone = (above[plane, row] == (number[plane, row] == 1)[:, None]).argmax(axis=1)
    x, a, low = planes[plane], turned[row, alone], heights[row, alone]
    points = []
    for step in (1, 2):
        other = (alone + step) % 3
        b = turned[row, other]
        share = (x - a.real) / (b.real - a.real)
        y = a.imag + share * (b.imag - a.imag)
        points.append(y + 1j * (low + share * (heights[row, other] - low)))
    return points[0], points[1], plane


def _touched(starts: Complex, ends: Complex, side: int, radii: Sequence[float], thin: Real) -> list[float]:
    """Heights of circles' centres over the segments below that they rest on; mirrored for those above.

    ``thin``: what is added to the radii over each segment.
    """
    mine = (starts.imag + ends.imag) * side > 0
    a, b = starts[mine], ends[mine]
    if side == UPPER:
        a, b = np.conj(a), np.conj(b)
    turned = a.real > b.real
    left, right = np.where(turned, b, a), np.where(turned, a, b)
    kept = (right.real > -max(radii)) & (left.real < max(radii)) & (right.real > left.real)
    left, right, thin = left[kept], right[kept], thin[mine][kept]
    if not len(left):
        return [-math.inf] * len(radii)
    slope = (right.imag - left.imag) / (right.real - left.real)
    lean = slope / np.hypot(1.0, slope)
    heights = []
    for radius in (r + thin for r in radii):
        # z + sqrt(r^2 - y^2) along a segment is greatest where the circle is as steep
        y = np.clip(radius * lean, np.maximum(left.real, -radius), np.minimum(right.real, radius))
        z = left.imag + slope * (y - left.real) + np.sqrt(np.maximum(0.0, radius**2 - y**2))
        heights.append(float(z[(right.real > -radius) & (left.real < radius)].max(initial=-math.inf)))
    return heights
