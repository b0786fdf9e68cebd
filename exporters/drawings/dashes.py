"""Dashed splines: LibreCAD draws every spline solid, so each dash is a spline of its own, cut from the exact curve."""

from __future__ import annotations

import numpy as np

from geometry.curves.bspline import BSpline

# points of each span by which its length is known
_PER_SPAN = 33
# no dash is longer than so many of its style: one or two of them fill what is left of a curve
LONGEST = 1.7


def dashes_of(spline: BSpline, style: tuple[float, ...]) -> list[BSpline]:
    """A spline as dashes (mm: dash, gap, dot, gap); gaps and dots are as they are told, dashes stand at both ends."""
    breaks = spline.breaks
    share = np.arange(_PER_SPAN) / _PER_SPAN
    places = np.append((breaks[:-1, None] + np.diff(breaks)[:, None] * share).ravel(), breaks[-1])
    way = np.append(0.0, np.abs(np.diff(spline.point(places))).cumsum())
    dash, *rest = style
    count = max(0, round((float(way[-1]) - dash) / sum(style)))
    dash = (float(way[-1]) - count * sum(rest)) / (count + 1)
    steps = np.append(np.tile([dash, *rest], count), dash).cumsum()
    cuts = np.append(places[0], np.interp(steps, way, places))
    cuts[-1] = places[-1]
    return [spline.trimmed(float(a), float(b)) for a, b in zip(cuts[:-1:2], cuts[1::2], strict=True)]
