"""Oracles for followers on connecting rods: poses by the law of cosines at 40 digits, lifts over an eccentric disk."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from geometry.cams.motion.follower_motion import FollowerMotion
from geometry.cams.plane.coupler import CouplerMount, LinkageCam
from geometry.cams.plane.disk import FollowerKind
from geometry.kinematics.linkage import Linkage, RockerDrive, RockerGuide, SliderDrive, SliderGuide
from tests.geometry.cams.oracle import MP

D = math.radians


@dataclass(frozen=True)
class Case:
    """A linkage, the follower's place on its coupler, and the direction of a stem or of a face's normal."""

    linkage: Linkage
    point: complex
    direction: float


CASES = {
    "four-bar": Case(
        Linkage(RockerDrive(91 + 26j, 58.0, D(167), -1), 43.0, RockerGuide(62 + 124j, 68.0, 1)), 2 + 11j, D(-60)
    ),
    "crossed four-bar": Case(
        Linkage(RockerDrive(69 + 1j, 58.0, D(162), -1), 64.0, RockerGuide(94 + 44j, 28.0, -1)), 26 + 6j, D(80)
    ),
    "crank and slider": Case(
        Linkage(RockerDrive(85 + 15j, 55.0, D(160), -1), 60.0, SliderGuide(0 + 80j, D(10), 1)), 5 + 12j, D(20)
    ),
    "slider and rocker": Case(
        Linkage(SliderDrive(25 + 30j, D(70)), 50.0, RockerGuide(90 + 30j, 40.0, 1)), 6 + 9j, D(60)
    ),
    "two sliders": Case(
        Linkage(SliderDrive(20 + 32j, D(75)), 55.0, SliderGuide(0 + 50j, D(-15), -1)), -6 + 8j, D(-110)
    ),
}


def pose(linkage: Linkage, lift: Any) -> tuple[Any, Any]:
    """Joint A and the coupler's angle at 40 digits: directions and the law of cosines, no roots of squares."""
    drive, guide, length = linkage.drive, linkage.guide, MP.mpf(linkage.coupler_length)
    if isinstance(drive, RockerDrive):
        joint = MP.mpc(drive.pivot) + drive.length * MP.expj(MP.mpf(drive.start_angle) + drive.sense * lift)
    else:
        assert isinstance(drive, SliderDrive)
        joint = MP.mpc(drive.start) + lift * MP.expj(MP.mpf(drive.direction))
    if isinstance(guide, RockerGuide):
        way = MP.mpc(guide.pivot) - joint
        far = abs(way)
        return joint, MP.arg(way) + guide.side * MP.acos(
            (far**2 + length**2 - MP.mpf(guide.length) ** 2) / (2 * far * length)
        )
    assert isinstance(guide, SliderGuide)
    direction = MP.mpf(guide.direction)
    lean = MP.asin(((joint - MP.mpc(guide.point)) * MP.expj(-direction)).imag / length)
    return joint, direction - lean if guide.side > 0 else direction + MP.pi + lean


def centre(case: Case, lift: Any) -> Any:
    """The follower's reference point."""
    joint, angle = pose(case.linkage, lift)
    return joint + MP.mpc(case.point) * MP.expj(angle)


def normal(case: Case, lift: Any) -> Any:
    """Direction of the stem, or the face's normal."""
    return MP.expj(pose(case.linkage, lift)[1] + MP.mpf(case.direction))


@dataclass(frozen=True)
class Ridden:
    """S over an eccentric disk (size: radius, arm: eccentricity, mm) with derivatives to order 3, at nodes only."""

    case: Case
    flat: bool
    radius: float
    arm: float
    nodes: tuple[float, ...]
    start: float = 0.0
    end: float = 2 * math.pi
    is_constant: bool = False

    def off(self, lift: Any, disk: Any) -> Any:
        """Distance of the follower from a disk's centre."""
        away = centre(self.case, lift) - disk
        if self.flat:
            return (away * MP.conj(normal(self.case, lift))).real
        return abs(away) - self.radius

    @property
    def size(self) -> Any:
        """Radius of the disk that is touched at S = 0."""
        return self.off(MP.mpf(0), MP.mpc(self.arm))

    @cached_property
    def _table(self) -> dict[float, list[float]]:
        size = self.size

        def lift(angle: Any) -> Any:
            disk = self.arm * MP.expj(angle)
            return MP.findroot(lambda s: self.off(s, disk) - size, MP.mpf("0.001"))

        found = {}
        for node in self.nodes:
            rates = [MP.diff(lift, MP.mpf(node), k, h=MP.mpf("1e-9")) for k in (1, 2, 3)]
            found[node] = [float(lift(MP.mpf(node))), *(float(x) for x in rates)]
        return found

    def value(self, t: Any, order: int = 0) -> Any:
        """S^(order) at nodes."""
        t = np.asarray(t, dtype=float)
        return np.array([self._table[float(x)][order] for x in t.ravel()]).reshape(t.shape)

    def values(self, t: Any, order: int) -> list[Any]:
        """S, S' ... S^(order) at nodes."""
        return [self.value(t, k) for k in range(order + 1)]


def ridden_cam(case: Case, kind: FollowerKind, radius: float, arm: float, nodes: np.ndarray) -> LinkageCam:
    """The cam of the lift over an eccentric disk."""
    piece: Any = Ridden(case, kind is FollowerKind.FLAT, radius, arm, tuple(nodes.tolist()))
    mount = CouplerMount(case.linkage, case.point, case.direction)
    return LinkageCam(FollowerMotion((piece,)), mount, kind, radius)
