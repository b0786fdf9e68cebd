"""Oracles for cams: an eccentric disk gives every follower its lift in closed form, and brute-force sweeps.

The lift of a follower that rides on an eccentric disk follows from the triangle of disk centre, follower and guide
alone. A cam synthesised from that lift has to be the disk.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

import mpmath
import numpy as np

from geometry.cams.motion.follower_motion import FollowerMotion
from geometry.cams.motion.guides import Mount, Oscillating, Translating
from geometry.cams.plane.disk import DiskCam, FollowerKind

MP = mpmath.mp.clone()
MP.dps = 40


@dataclass(frozen=True)
class Eccentric:
    """A disk of radius ``size`` about a point ``arm`` from the axis (both mm; arm along +x at cam angle 0)."""

    size: float
    arm: float

    def lift(self, kind: FollowerKind, mount: Mount, radius: float, angle):
        """Height or swing angle of the follower at a cam angle, mpmath."""
        centre = self.arm * MP.expj(angle)
        reach = MP.mpf(self.size) + MP.mpf(radius)
        if isinstance(mount, Translating):
            if kind is FollowerKind.FLAT:
                return centre.imag + self.size
            return centre.imag + MP.sqrt(reach**2 - (MP.mpf(mount.offset) - centre.real) ** 2)
        arm = MP.mpf(mount.centre_distance) - centre
        if kind is FollowerKind.FLAT:
            return MP.asin((MP.mpf(self.size) + MP.mpf(mount.face_offset)) / abs(arm)) - mount.sense * MP.arg(arm)
        length = MP.mpf(mount.arm_length)
        cosine = (abs(arm) ** 2 + length**2 - reach**2) / (2 * abs(arm) * length)
        return MP.acos(cosine) - mount.sense * MP.arg(arm)


@dataclass(frozen=True)
class RiddenPiece:
    """The lift over an eccentric disk as a piece of motion: Taylor coefficients at chosen angles by 40-digit mpmath.

    Only the angles of ``nodes`` can be asked for.
    """

    disk: Eccentric
    kind: FollowerKind
    mount: Mount
    radius: float
    nodes: tuple[float, ...]
    start: float = 0.0
    end: float = 2 * math.pi
    is_constant: bool = False

    @cached_property
    def _table(self) -> dict[float, list[float]]:
        def function(angle):
            return self.disk.lift(self.kind, self.mount, self.radius, angle)

        zero = function(MP.mpf(0))
        found = {}
        for node in self.nodes:
            values = [float(MP.diff(function, MP.mpf(node), k)) for k in range(1, 4)]
            found[node] = [float(function(MP.mpf(node)) - zero), *values]
        return found

    def value(self, t, order: int = 0):
        """S^(order) at nodes."""
        t = np.asarray(t, dtype=float)
        return np.array([self._table[float(x)][order] for x in t.ravel()]).reshape(t.shape)

    def values(self, t, order: int):
        """S, S' ... S^(order) at nodes."""
        return [self.value(t, k) for k in range(order + 1)]


def ridden_cam(disk: Eccentric, kind: FollowerKind, mount: Mount, radius: float, nodes: np.ndarray) -> DiskCam:
    """The cam of the lift over a disk; the mount's start height or angle is set to the disk's own."""
    start = float(disk.lift(kind, mount, radius, MP.mpf(0)))
    if isinstance(mount, Translating):
        mount = Translating(mount.offset, start)
    else:
        mount = Oscillating(mount.centre_distance, mount.arm_length, start, mount.sense, mount.face_offset)
    piece = RiddenPiece(disk, kind, mount, radius, tuple(float(x) for x in nodes))
    return DiskCam(FollowerMotion((cast("Any", piece),)), mount, kind, radius)


def followed(cam: DiskCam, outline: np.ndarray, angle: float) -> float:
    """Height or swing angle at which a follower comes to rest on a polygon (cam's frame, vertices only).

    Each vertex alone stops the follower somewhere; the highest stop holds it. Dense vertices are needed.
    """
    points = outline * cmath.exp(1j * angle)
    mount = cam.mount
    if isinstance(mount, Translating):
        if cam.is_flat:
            return float(points.imag.max())
        across = points.real - mount.offset
        near = np.abs(across) <= cam.radius
        return float((points.imag[near] + np.sqrt(cam.radius**2 - across[near] ** 2)).max())
    arm = mount.centre_distance - points
    if cam.is_flat:
        # distance of the vertex over the pivot's parallel, seen along the face
        stops = np.arcsin(np.clip(-mount.face_offset / np.abs(arm), -1, 1))
        return float(np.max(-mount.sense * np.angle(arm) - stops))
    cosine = (np.abs(arm) ** 2 + mount.arm_length**2 - cam.radius**2) / (2 * np.abs(arm) * mount.arm_length)
    near = np.abs(cosine) <= 1
    return float(np.max(np.arccos(cosine[near]) - mount.sense * np.angle(arm[near])))
