"""What the files of a splined bore must also do: take the shaft, with the clearance that was told and no other."""

from __future__ import annotations

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex
from geometry.plane.measure import distance_to_profile
from geometry.solids.splines import SplineBore
from parts.base.readback import Probed, ReadBack, ReadLoop, outline_points, refuse_if
from parts.base.texts import unless

_ROUNDING = 1e-9
# reaches of the bore within which the outline about the axis is its own
_NEAR = 1.1
# points along each curve of a tooth, by which it is told what lies within it
_ALONG = 400


class SplineProbe(Record):
    """The shaft of the same sizes put into the bore; ``height``: where a solid is cut, mm."""

    bore: SplineBore
    height: float
    name: str = "spline"
    needs_whole: bool = False

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """The least gap all round, below 0 where the shaft would cut the file; see ``parts.base.readback.Probe``."""
        around = [loop for loop in file.section(self.height) if _turns(loop.points)]
        near = [loop for loop in around if _reach(loop) < _NEAR * self.bore.reach]
        if file.is_flat and not near:
            # of a cylinder that is unrolled
            return Probed()
        refuse_if(not near, "there is no splined bore")
        points = outline_points(min(near, key=_reach)) * np.exp(-1j * self.bore.angle)
        shaft = self.bore.joint.shaft().outline()
        # every tooth is the first one: the shaft's is known between the middles of its spaces
        points *= np.exp(-1j * shaft.pitch_angle * np.round(np.angle(points) / shaft.pitch_angle))
        curves = [segment.curve for segment in shaft.period]
        edge = np.concatenate([curve.point(np.linspace(*curve.domain, _ALONG)) for curve in curves])
        edge = np.concatenate([edge * np.exp(1j * shaft.pitch_angle * k) for k in (-1, 0)])
        inside = np.abs(points) < np.interp(np.angle(points), np.maximum.accumulate(np.angle(edge)), np.abs(edge))
        distance = distance_to_profile(points, shaft)
        gap = float(np.where(inside, -distance, distance).min())
        wanted, allowed = self.bore.clearance - offset, declared + _ROUNDING * self.bore.reach
        return Probed(
            {"gap": gap},
            tuple(
                unless(abs(gap - wanted) <= allowed, "the shaft has a clearance of {gap:.6g} mm in its bore", gap=gap)
            ),
        )


def _reach(loop: ReadLoop) -> float:
    return float(np.abs(loop.points).max())


def _turns(points: Complex) -> bool:
    """Whether an outline runs round the axis."""
    turned = np.angle(np.roll(points, -1) / np.where(points == 0, 1.0, points))
    return abs(float(turned.sum())) > np.pi
