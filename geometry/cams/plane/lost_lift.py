"""How far a follower drops that rides on a corner: closed forms for every guide and shape."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.disk import DiskCam
from geometry.curves.curve import Complex, Real

_SAMPLES = 257
_REFINEMENTS = 6


def lost_lift(cam: DiskCam, angle: Real, corner: complex, distance: float) -> Real:
    """How far the follower leaves its motion where it rests on ``corner`` (cam's frame), at cam angles, mm or rad.

    ``distance`` of the outline from the centre's path, to the outside: negative for a cam or an inner wall, where the
    follower drops; positive for the outer wall of a groove, where it rises. For a flat face, of the outline from it.
    """
    own = getattr(cam, "lost_lift", None)
    if own is not None:
        return np.asarray(own(angle, corner, distance))
    fixed = corner * np.exp(1j * angle)
    if isinstance(cam.mount, Translating):
        return _translating(cam, cam.mount, angle, fixed, distance)
    return _oscillating(cam, cam.swing, angle, fixed, distance)


def _translating(cam: DiskCam, mount: Translating, angle: Real, corner: Complex, distance: float) -> Real:
    height = mount.start_height + cam.motion.value(angle)
    if cam.is_flat:
        return height + distance - corner.imag
    # the centre stands straight above (or below) the corner, a radius away from it
    across = corner.real - mount.offset
    side = 1.0 if distance <= 0 else -1.0
    return side * (height - corner.imag) - np.sqrt(np.maximum(distance**2 - across**2, 0))


def _oscillating(cam: DiskCam, mount: Oscillating, angle: Real, corner: Complex, distance: float) -> Real:
    psi = mount.start_angle + cam.motion.value(angle)
    arm = mount.centre_distance - corner
    length, phase = np.abs(arm), np.angle(arm)
    side = 1.0
    if cam.is_flat:
        # |u| sin(sense psi + arg u) = sense f, u from the corner to the pivot
        base = np.arcsin(np.clip(mount.sense * (mount.face_offset - distance) / length, -1, 1))
        found = [base - phase, np.pi - base - phase]
    else:
        # |u - L exp(-i sense psi)| = r
        cosine = (length**2 + mount.arm_length**2 - distance**2) / (2 * length * mount.arm_length)
        base = np.arccos(np.clip(cosine, -1, 1))
        found = [base - phase, -base - phase]
        side = 1.0 if distance <= 0 else -1.0
    drops = [np.angle(np.exp(1j * (psi - mount.sense * x))) for x in found]
    return side * np.where(np.abs(drops[0]) < np.abs(drops[1]), drops[0], drops[1])


def greatest_loss(cam: DiskCam, start: float, end: float, corner: complex, distance: float) -> float:
    """The most that is lost between two cam angles."""
    return greatest_value(lambda t: lost_lift(cam, t, corner, distance), start, end)


def greatest_value(function: Callable[[Real], Real], start: float, end: float) -> float:
    """Greatest value of a smooth function between two arguments: samples, refined about the largest."""
    low, high, best = start, end, -np.inf
    for _ in range(_REFINEMENTS):
        t = np.linspace(low, high, _SAMPLES)
        values = function(t)
        at = int(np.argmax(values))
        best = max(best, float(values[at]))
        low, high = t[max(at - 1, 0)], t[min(at + 1, _SAMPLES - 1)]
    return best
