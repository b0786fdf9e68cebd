"""Cylindrical cams: the roller is put into the groove of every file read back, and its way held against the exact law.

Into triangles at every depth; along flat outlines on the outer cylinder that they unroll.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from geometry.base.record import replace
from geometry.cams.barrel.body import BarrelBody, Plane
from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.cams.barrel.rolling import UnrolledWall, rolled_places, wall_height
from geometry.cams.contact.rolled import rolled_lift
from geometry.cams.motion.follower_motion import TURN
from geometry.curves.curve import Real
from parts.base.readback import Probe, Probed, ReadBack, ReadError
from parts.base.texts import N_, fault
from parts.cams.probes import ANGLES, at_angle, lift_errors, lift_failure, lift_jumps

# triangles of one radius or one height are no walls: this part of the size is rounding
_FLAT = 1e-5
# coordinates are rounded to this part of the size: slivers that stand upright by it may look either way
_SLIVER = 1e-6
# what bends of the way add to the shift of a wall along the axis, and the rounding of it all
_BEND, _ROUNDING = 1.1, 1e-9
# how near to the truth the greatest error is sought, part of the declared one
_SLACK = 0.02


class GrooveRoller(Probe):
    """The roller in the groove of a cylindrical cam, ``body(offset)``; its diameter, mm."""

    body: Callable[[float], BarrelBody]
    diameter: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """Errors of its place along the axis, and its play; see ``parts.base.readback.Probe``.

        A roller that is smaller by the ``offset`` is put into triangles; ``lift_error`` bounds its error at every depth
        and cam angle. It is rolled at 3600 angles along flat outlines. A STEP's faces are not asked.
        """
        if file.is_flat:
            return self._on_outlines(file, offset, declared)
        corners = file.faces()
        return self._in_triangles(corners, offset, declared) if len(corners) else Probed()

    def _in_triangles(self, corners: Real, offset: float, declared: float) -> Probed:
        body = self.body(offset)
        cam, walls = body.cam, walls_of(corners, body)
        place = rolled_places(replace(cam, radius=self.diameter / 2 - offset / cam.upright), walls, ANGLES)
        lost = ~np.isfinite(np.array([place[side] for side in cam.sides])).all(axis=0)
        if lost.any():
            at = 360 * int(np.argmax(lost)) / ANGLES
            return Probed(failures=(fault("the roller finds no wall at cam angle {at:.6g} degrees", at=at),))
        worst = wall_height(cam, walls, _SLACK * declared)
        measured = {"lift_error": worst.bound}
        if cam.is_groove:
            play = place[UPPER] - place[LOWER]
            measured |= {"least_play": float(play.min()), "greatest_play": float(play.max())}
        allowed = _allowed(cam, worst.angle, worst.depth, worst.upright, declared)
        if worst.found <= allowed + _ROUNDING * max(cam.outer, body.length):
            return Probed(measured)
        text = N_("the roller's place is wrong by {found:.6g} mm {place}, more than the walls allow")
        return Probed(measured, (fault(text, found=worst.found, place=at_angle(math.degrees(worst.angle))),))

    def _on_outlines(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """Along the edges of the jackets, the upper one above the groove."""
        body, loops = self.body(0.0), file.section(0.0)
        cam = body.cam
        if len(loops) != len(cam.sides):
            raise ReadError(f"there are {len(loops)} jackets for the roller instead of {len(cam.sides)}")
        angle = np.arange(ANGLES, dtype=np.float64) * (TURN / ANGLES)
        law = cam.place(angle, 0)[0].imag
        measured: dict[str, float] = {}
        failures: tuple[str, ...] = ()
        for side, loop in zip(sorted(cam.sides), sorted(loops, key=lambda x: float(x.points.imag.mean())), strict=True):
            wall = UnrolledWall(cam, side, body.length / 2)
            cosine, away = wall.upright(angle)
            # where the sheet is trimmed, its ends are not there to be touched
            kept = away >= (2 * abs(offset) + declared if offset < 0 else 0.0)
            error = (rolled_lift(wall, loop.outline(), ANGLES, offset, below=side == LOWER) - law)[kept]
            if np.any(np.isnan(error)):
                lost = math.degrees(angle[kept][np.isnan(error)][0])
                return Probed(failures=(fault("the roller finds no wall at cam angle {at:.6g} degrees", at=lost),))
            found = lift_errors(error, law[kept], TURN / ANGLES, swings=False, round_about=offset >= 0)
            measured = {key: max(value, measured.get(key, 0.0)) for key, value in found.items()}
            bound = _allowed(cam, angle, cam.outer, cosine, declared) + _ROUNDING * max(cam.outer, body.length)
            bound = np.maximum(np.maximum(np.roll(bound, 1), np.roll(bound, -1)), bound)[kept]
            at = np.degrees(angle[kept])
            place = lambda k, at=at: at_angle(at[k])  # noqa: E731
            failures += lift_failure(error, bound, place, swings=False)
        return Probed(measured, failures, lift_jumps(measured, swings=False) if file.has_arcs else ())


def _allowed(cam: BarrelCam, angle: Real | float, depth: float, upright: Real | float, declared: float) -> Real:
    """How far a wall that is off by so much may shift the roller along the cam's axis, mm.

    ``upright``: the cosine between both ways. As the path of the axis bends too, it is a little more than their ratio.
    """
    place = cam.place(angle, 2)
    bend = depth * np.abs(2 * place[2]) / np.hypot(depth, np.abs(place[1])) ** 3
    first = declared / upright
    return np.asarray(_BEND * (first + bend * first**2 * (1 - np.square(upright)) / upright))


def walls_of(corners: Real, body: BarrelBody) -> dict[int, Real]:
    """Those of some triangles (n, 3, 3) that go across a wall, by its side: the lower wall looks up.

    Triangles of one radius are no walls, nor those in the plane faces; slivers whose way is rounding are left out.
    """
    cam = body.cam
    radius, flat = np.hypot(corners[..., 0], corners[..., 1]), _FLAT * cam.outer
    kept = (np.ptp(radius, axis=1) > flat) & (radius.max(axis=1) <= cam.outer + flat)
    kept &= radius.min(axis=1) >= cam.inner * (1 - 0.05)
    for level in {face.outer.z for face in body.faces() if isinstance(face, Plane)}:
        kept &= np.abs(corners[..., 2] - level).max(axis=1) > flat
    edges = corners[:, 1:] - corners[:, :1]
    up = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]
    kept &= np.abs(up) > _SLIVER * cam.outer * np.abs(edges).max(axis=(1, 2))
    return {side: corners[kept & (up * side < 0)] for side in cam.sides}
