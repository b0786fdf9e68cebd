"""Where the corner of a tip runs into its mate's fillet, or into the edge that undercut leaves at its end.

A point of the fillet is touched where its normal passes through the pitch point (Willis), and all that touch it are a
curve of the mate. It begins on the mate's flank where fillet and flank are tangent; where it crosses that flank is the
longest tip that passes. The edge above an undercut fillet describes an epitrochoid in the mate, tangent to the flank
where both touch on the line of action: where it comes back to the flank, nearer to the tip, is another limit.
"""

from __future__ import annotations

import cmath
import math

from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Curve, start_point
from geometry.curves.involute import Involute
from geometry.gears.teeth.side import Side
from geometry.plane.profile import Label

# share of a fillet at its joint with the flank, or of an edge's way from it, where what is touched lies on the flank
_JOINT = 1e-3


class Passing(Record):
    """A gear at rest about which its mate rolls, flank on flank; lengths in mm, angles in rad.

    ``side`` is the gear's and ``flank`` the mate's that comes to it; the mate's axis lies at ``axis`` on the line of
    centres (below 0: a ring's, beyond the gear's own), and it turns by ``turn`` for each radian of that line, from
    ``start`` on. ``inwards``: to which side of its flank the mate's material lies.
    """

    side: Side
    flank: Involute
    pitch_radius: float
    axis: float
    turn: float
    start: float
    inwards: int

    def corner(self, tip_radius: float, *, undercut: bool) -> float | None:
        """The radius of the mate's tip from which on its corner does not pass; None: any does.

        Of the edge only those before ``tip_radius`` are sought.
        """
        found = [r for r in (self._at_fillet(), self._at_edge(tip_radius) if undercut else None) if r is not None]
        return min(found, key=lambda radius: self.inwards * radius, default=None)

    def _seen(self, point: complex, direction: float) -> complex:
        """A point of the gear in the mate, the line of centres in a direction."""
        return (point - cmath.rect(self.axis, direction)) * cmath.exp(-1j * (self.turn * direction + self.start))

    def _within(self, place: complex) -> float:
        """By what angle a place of the mate lies in its material, beyond its flank."""
        beyond = cmath.phase(place) - self.flank.polar_angle_at_radius(abs(place))
        return self.inwards * math.remainder(beyond, 2 * math.pi)

    def _direction(self, curve: Curve, at: float) -> float:
        """Of the line of centres where a point of a curve of the gear is touched."""
        point, normal = complex(curve.point(at)), 1j * complex(curve.tangent(at))
        along = -(point.conjugate() * normal).real
        beside = math.sqrt(max(along**2 - (abs(point) - self.pitch_radius) * (abs(point) + self.pitch_radius), 0.0))
        return cmath.phase(point + min(along - beside, along + beside, key=abs) * normal)

    def _at_fillet(self) -> float | None:
        fillet = next((s.curve for s in self.side.segments if s.label is Label.ROOT_FILLET), None)
        if fillet is None:
            return None
        root, joint = fillet.domain

        def touched(at: float) -> complex:
            return self._seen(complex(fillet.point(at)), self._direction(fillet, at))

        def within(at: float) -> float:
            return self._within(touched(at))

        last = joint - _JOINT * (joint - root)
        return abs(touched(bracketed_root(within, root, last).value)) if within(root) > 0 > within(last) else None

    def _at_edge(self, tip_radius: float) -> float | None:
        flank = self.side.flanks()[0]
        edge = start_point(flank)
        own, cosine = cmath.phase(edge), (abs(edge) ** 2 + self.axis**2 - tip_radius**2) / (2 * abs(edge) * self.axis)
        if not -1 < cosine < 1:
            return None
        meets = self._direction(flank, flank.domain[0])

        def within(direction: float) -> float:
            return self._within(self._seen(edge, direction))

        found = []
        # where the edge comes to the mate's tip circle and leaves it
        for end in (own - math.acos(cosine), own + math.acos(cosine)):
            near = meets + _JOINT * (end - meets)
            if within(end) > 0 > within(near):
                found.append(abs(self._seen(edge, bracketed_root(within, near, end).value)))
        return min(found, default=None)
