"""Cams that hold their follower from both sides: groove, conjugate pair, yoke of constant breadth."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from geometry.cams.disk import DiskCam, FollowerKind
from geometry.cams.follower_motion import TURN, FollowerMotion
from geometry.cams.mounts import Oscillating, Translating
from geometry.cams.shape import CamShape, cam_shape
from geometry.errors import ParameterError, at_least

# a motion is of constant breadth where S(phi) + S(phi + pi) departs from H by less than this part of it
_BREADTH = 1e-9
_BREADTH_SAMPLES = 2049


@dataclass(frozen=True, slots=True)
class Groove:
    """Both walls of a groove, each a counter-clockwise outline in the cam's frame, and its width, mm."""

    inner: CamShape
    outer: CamShape
    width: float


def groove(cam: DiskCam, clearance: float = 0.0) -> Groove:
    """The groove in which a roller runs: the outer wall stands ``clearance`` mm farther than the roller reaches.

    The inner wall is the disk cam; the outer one is undercut where a concave arc of the path is sharper than the
    roller, which a disk cam does not mind.

    Raises
    ------
    ParameterError
        No roller, or a clearance below 0.
    UndercutError
        A wall does not hang together.
    """
    if cam.kind is not FollowerKind.ROLLER:
        raise ParameterError("follower", str(cam.kind), "a groove needs a roller")
    if not clearance >= 0:
        raise ParameterError("clearance", clearance, "must be at least 0")
    width = 2 * cam.radius + clearance
    return Groove(cam_shape(cam), cam_shape(cam, width), width)


@dataclass(frozen=True, slots=True)
class Conjugate:
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
        raise ParameterError("follower", str(cam.kind), "a conjugate cam needs rollers")
    radius = cam.radius if radius is None else radius
    if not radius > 0:
        raise ParameterError("radius", radius, "must be above 0")
    motion, mount = cam.motion.negated(), cam.mount
    highest = cam.motion.extremes()[1]
    if isinstance(mount, Translating):
        height = roller_distance - mount.start_height
        if not height - highest > radius:
            least = mount.start_height + highest + radius
            remedy = f"the second roller runs over the axis; more than {at_least(least)} mm works"
            raise ParameterError("roller_distance", roller_distance, remedy)
        # seen from the other side of the axis: everything turned by half a turn
        second = DiskCam(motion, Translating(-mount.offset, height), FollowerKind.ROLLER, radius)
        return Conjugate(second, math.pi)
    start = TURN - mount.start_angle - roller_distance
    if not start - highest > 0 or not start - cam.motion.extremes()[0] < math.pi:
        low = math.pi - mount.start_angle - cam.motion.extremes()[0]
        remedy = (
            f"both arms must embrace the axis: from {low:.6g} to {TURN - mount.start_angle - highest:.6g} rad works"
        )
        raise ParameterError("roller_distance", roller_distance, remedy)
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
        raise ParameterError("mount", "oscillating", "a yoke slides")
    if cam.kind in (FollowerKind.POINTED, FollowerKind.MUSHROOM):
        raise ParameterError("follower", str(cam.kind), "a yoke has two flat faces or two rollers and slides")
    if not cam.is_flat and cam.mount.offset != 0:
        raise ParameterError("follower_offset", cam.mount.offset, "a yoke with rollers works at 0 only")
    error = breadth_error(cam.motion)
    low, high = cam.motion.extremes()
    if not error <= _BREADTH * (high - low):
        remedy = (
            f"S(phi) + S(phi + 180) departs from H by {error:.6g}; 180 degrees of the motion follow from the others"
        )
        raise ParameterError("motion", high - low, remedy)
    return 2 * cam.mount.start_height + low + high
