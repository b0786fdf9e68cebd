"""The rim of a pulley with flanges: its teeth between discs."""

from __future__ import annotations

from itertools import pairwise

from geometry.gears.belts.pulley import Pulley, pulley_side
from geometry.plane.profile import Label, circle
from geometry.solids.body import BodyBuilder


def flanged_teeth(pulley: Pulley, made: BodyBuilder, offset: float) -> tuple[int, int]:
    """The walls of teeth and discs, moved ``offset`` mm, and the faces between them; the loops at both ends.

    Raises
    ------
    GeometryError
        The offset leaves no teeth, or closes the grooves.
    """
    flanges, teeth = pulley.flanges, pulley_side(pulley, offset).profile()
    assert flanges is not None
    disc = circle(flanges.diameter / 2 + offset, Label.RIM)
    low, high = flanges.low, flanges.low + pulley.toothed_width
    layers = [(disc, 0.0, low)] * flanges.below + [(teeth, low, high)]
    layers += [(disc, high, pulley.total_width)] * flanges.above
    ends = [made.upright(*layer) for layer in layers]
    for (below, above), (one, two) in zip(pairwise(layers), pairwise(ends), strict=True):
        if below[0] is disc:
            made.cap(one[1], [two[0]], up=True)
        elif above[0] is disc:
            made.cap(two[0], [one[1]], up=False)
    return ends[0][0], ends[-1][1]
