"""How far a roller slides on the walls of a cylindrical cam: its ends ask for different speeds of rolling.

The surface of the cam is faster outside than at the floor. A cylinder rolls without sliding at one radius only; a cone
whose apex lies on the cam's axis does so along the whole line while it rests (Rothbart, Cam Design Handbook).
"""

from __future__ import annotations

import numpy as np

from geometry.cams.barrel.cam import BarrelCam
from geometry.curves.curve import Real
from geometry.laws.piece import LawPiece

_ANGLES, _RADII = 65, 9


def rolling_speed(cam: BarrelCam, angle: Real, side: int, radius: Real, piece: LawPiece) -> Real:
    """Turns of the roller for one of the cam with which a point of a wall on a cylinder (mm) would not slide across."""
    place = cam.place(angle, 1, piece)
    rho = cam.distance_along(place, side, radius)
    away = cam.contact(place, side, rho) - place[0]
    # the cam's surface against the roller's axis, across it: (p' - rho) along i n
    return np.asarray(((place[1] - rho) * np.conj(1j * away)).real / np.abs(away) ** 2)


def cam_sliding(cam: BarrelCam) -> float:
    """Greatest share by which the wall's ends outrun the roller that turns with their mean: 0 is pure rolling."""
    radii = np.linspace(cam.inner, cam.outer, _RADII)
    worst = 0.0
    for piece in cam.motion.pieces:
        angles = np.linspace(*piece.domain, _ANGLES)[:, None]
        for side in cam.sides:
            speed = rolling_speed(cam, angles, side, radii, piece)
            spread = np.ptp(speed, axis=1) / np.abs(speed.max(axis=1) + speed.min(axis=1))
            worst = max(worst, float(spread.max()))
    return worst
