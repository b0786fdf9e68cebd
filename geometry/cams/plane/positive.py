"""Cams that hold their follower from both sides: conjugate pair, yoke of constant breadth."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import Record
from geometry.cams.motion.follower_motion import TURN, FollowerMotion
from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.disk import DiskCam, FollowerKind

# a motion is of constant breadth where S(phi) + S(phi + pi) departs from H by less than this part of it
_BREADTH = 1e-9
_BREADTH_SAMPLES = 2049


class Conjugate(Record):
    """The second cam of a pair, as a disk cam of its own, and the angle by which it is turned on the shaft, rad.

    Its profile lies in the first cam's frame when it is turned by ``turn`` about the axis.
    """

    cam: DiskCam
    turn: float


def conjugate_cam(
    cam: DiskCam, roller_distance: float, *, radius: float | None = None, arm_length: float | None = None
) -> Conjugate:
    """The cam that moves the second roller of the same follower, so that the first one cannot lift off.

    Translating: the second roller's centre stands ``roller_distance`` mm below the first one on the same stem.
    Oscillating: ``roller_distance`` is the angle between both arms, rad; ``arm_length`` of the second one, default
    that of the first.

    Raises
    ------
    ParameterError
        No roller, or a second roller that does not stay beyond the axis.
    """
    if cam.kind is not FollowerKind.ROLLER:
        raise ParameterError("follower", str(cam.kind), "needs_roller")
    radius = cam.radius if radius is None else radius
    if not radius > 0:
        raise ParameterError("radius", radius, "not_above_zero")
    motion, mount = cam.motion.negated(), cam.mount
    highest = cam.motion.extremes()[1]
    if isinstance(mount, Translating):
        height = roller_distance - mount.start_height
        if not height - highest > radius:
            least = limit((mount.start_height + highest + radius) * (1 + 1e-9), roller_distance)
            raise ParameterError("roller_distance", roller_distance, "rollers_on_one_side", least)
        # seen from the other side of the axis: everything turned by half a turn
        second = DiskCam(motion, Translating(-mount.offset, height), FollowerKind.ROLLER, radius)
        return Conjugate(second, math.pi)
    mount = cam.swing
    start = TURN - mount.start_angle - roller_distance
    if not start - highest > 0 or not start - cam.motion.extremes()[0] < math.pi:
        low, high = math.pi - mount.start_angle - cam.motion.extremes()[0], TURN - mount.start_angle - highest
        nearest = limit(low * (1 + 1e-6) if roller_distance <= low else high * (1 - 1e-6), roller_distance, digits=9)
        raise ParameterError("roller_distance", roller_distance, "rollers_on_one_side", nearest)
    arm = mount.arm_length if arm_length is None else arm_length
    # below the line of centres with the other sense
    below = Oscillating(mount.centre_distance, arm, start, -mount.sense)
    return Conjugate(DiskCam(motion, below, FollowerKind.ROLLER, radius), 0.0)


def breadth_error(motion: FollowerMotion) -> float:
    """Greatest |S(phi) + S(phi + 180 degrees) - (least + greatest S)|: 0 of a motion of constant breadth."""
    angle = np.linspace(0, math.pi, _BREADTH_SAMPLES)
    low, high = motion.extremes()
    return float(np.abs(motion.value(angle) + motion.value(angle + math.pi) - low - high).max())


def yoke_breadth(cam: DiskCam) -> float:
    """Distance between the two parallel faces (2 R_b + H), or the two rollers' centres (2 R_p + H), of a yoke, mm.

    Raises
    ------
    ParameterError
        The motion is not of constant breadth, the follower swings, or a roller is offset.
    """
    if not isinstance(cam.mount, Translating):
        raise ParameterError("mount", "oscillating", "yoke_slides")
    if cam.kind in (FollowerKind.POINTED, FollowerKind.MUSHROOM):
        raise ParameterError("follower", str(cam.kind), "yoke_of_faces_or_rollers")
    if not cam.is_flat and cam.mount.offset != 0:
        raise ParameterError("follower_offset", cam.mount.offset, "yoke_without_offset", Nearest(0.0))
    error = breadth_error(cam.motion)
    low, high = cam.motion.extremes()
    if not error <= _BREADTH * cam.motion.lift:
        raise ParameterError("motion", cam.motion.lift, "breadth_not_constant", error=error)
    return 2 * cam.mount.start_height + low + high
