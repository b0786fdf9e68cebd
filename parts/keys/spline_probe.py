"""What the files of a spline must also do: take its mate, with the clearance that was told and no other."""

from __future__ import annotations

import numpy as np

from geometry.curves.curve import Complex
from geometry.plane.measure import distance_to_profile
from geometry.solids.splines import SplineBore
from parts.base.readback import Probe, Probed, ReadBack, ReadError, ReadLoop, outline_points, refuse_if
from parts.base.texts import unless

_ROUNDING = 1e-9
# reaches of the bore within which the outline about the axis is its own
_NEAR = 1.1
# points along each curve of a tooth, by which it is told what lies within it
_ALONG = 400


class SplineProbe(Probe):
    """The mate of the same sizes put to the bore, or to the ``teeth`` of its shaft.

    ``height``: where a solid is cut, mm; ``is_seen``: flat outlines have it.
    """

    bore: SplineBore
    height: float
    teeth: bool = False
    is_seen: bool = True

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """The least gap all round, below 0 where the mate would cut the file; see ``parts.base.readback.Probe``."""
        is_mesh = not file.is_flat and len(file.faces()) > 0
        try:
            around = [loop for loop in file.section(self.height) if _turns(loop.points)]
        except ReadError:
            # walls beside the bore have no flat feet: its faces are held against the exact ones one by one
            refuse_if(is_mesh, "there is no spline")
            return Probed()
        near = [loop for loop in around if _reach(loop) < _NEAR * self.bore.reach]
        if not (is_mesh or near) or (file.is_flat and not self.is_seen):
            # such a solid, or a cylinder that is unrolled
            return Probed()
        refuse_if(not near, "there is no spline")
        points = outline_points((max if self.teeth else min)(near, key=_reach)) * np.exp(-1j * self.bore.angle)
        joint = self.bore.joint
        mate = (joint.hub() if self.teeth else joint.shaft()).outline()
        # every tooth is the first one: the mate's is known between the middles of its spaces
        points *= np.exp(-1j * mate.pitch_angle * np.round(np.angle(points) / mate.pitch_angle))
        curves = [segment.curve for segment in mate.period]
        edge = np.concatenate([curve.point(np.linspace(*curve.domain, _ALONG)) for curve in curves])
        edge = np.concatenate([edge * np.exp(1j * mate.pitch_angle * k) for k in (-1, 0)])
        inside = np.abs(points) < np.interp(np.angle(points), np.maximum.accumulate(np.angle(edge)), np.abs(edge))
        distance = distance_to_profile(points, mate)
        gap = float(np.where(inside == self.teeth, distance, -distance).min())
        wanted, allowed = self.bore.clearance - offset, declared + _ROUNDING * self.bore.reach
        well = abs(gap - wanted) <= allowed
        failures = unless(well, "the mate of the spline has a clearance of {gap:.6g} mm", gap=gap)
        return Probed({"gap": gap}, tuple(failures))


def _reach(loop: ReadLoop) -> float:
    return float(np.abs(loop.points).max())


def _turns(points: Complex) -> bool:
    """Whether an outline runs round the axis."""
    turned = np.angle(np.roll(points, -1) / np.where(points == 0, 1.0, points))
    return abs(float(turned.sum())) > np.pi
