"""Drawing DXF: R2010 with true splines (knots and control points), arcs and circles as themselves, mm."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from exporters.formats.dxf_file import new_drawing, save
from geometry.approximation.outline import CadCurve, Outline
from geometry.base.tolerance import DRAWN_DECIMALS
from geometry.curves.line_arc import Arc, Line
from geometry.plane.contour import edge_box

_LAYER, _PITCH = "OUTLINE", "PITCH_CURVE"


def write_drawing_dxf(file: Path, boundaries: Sequence[Outline], paths: Sequence[Outline] = ()) -> dict[str, int]:
    """Write every boundary curve by curve on one layer, and paths of a follower's centre on another one, thin and grey.

    Returns the number of entities of each kind.
    """
    drawing = new_drawing()
    drawing.layers.add(_LAYER, color=7, lineweight=50)
    space = drawing.modelspace()
    counts = Counter[str]()
    corners: list[complex] = []
    if paths:
        drawing.layers.add(_PITCH, color=8, lineweight=25)
    for layer, outlines in ((_LAYER, boundaries), (_PITCH, paths)):
        for curve in (one for outline in outlines for one in outline.curves()):
            counts[add_curve(space, curve, layer)] += 1
            corners += _box(curve)
    x, y = [c.real for c in corners], [c.imag for c in corners]
    space.reset_extents((min(x), min(y), 0.0), (max(x), max(y), 0.0))
    save(drawing, file)
    return counts


def _box(curve: CadCurve) -> list[complex]:
    """Corners of a box that holds a curve: of a spline that of its poles."""
    if isinstance(curve, Line):
        return [curve.start, curve.end]
    if isinstance(curve, Arc):
        parts = max(2, math.ceil(abs(curve.sweep)))
        points = curve.point(np.linspace(*curve.domain, parts + 1))
        bulges = np.full(parts, math.tan(curve.sweep / parts / 4))
        return list(edge_box(points[:-1], points[1:], bulges))
    return [complex(p) for p in curve.poles]


def add_curve(space, curve: CadCurve, layer: str, line_type: str = "BYLAYER") -> str:
    """One curve on a layer as the DXF entity that it is; returns that entity's name."""
    attributes = {"layer": layer, **({} if line_type == "BYLAYER" else {"linetype": line_type})}
    if isinstance(curve, Line):
        space.add_line(place_of(curve.start), place_of(curve.end), dxfattribs=attributes)
        return "LINE"
    if isinstance(curve, Arc):
        if abs(curve.sweep) >= 2 * math.pi:
            space.add_circle(place_of(curve.centre), round(curve.radius, DRAWN_DECIMALS), dxfattribs=attributes)
            return "CIRCLE"
        # DXF arcs always turn left
        ends = sorted((curve.start_angle, curve.start_angle + curve.sweep))
        radius, more = round(curve.radius, DRAWN_DECIMALS), max(0, math.ceil(math.log10(curve.radius)) - 1)
        low, high = (round(math.degrees(end), DRAWN_DECIMALS + more) for end in ends)
        space.add_arc(place_of(curve.centre), radius, low, high, dxfattribs=attributes)
        return "ARC"
    spline = space.add_spline(dxfattribs=attributes, degree=curve.degree)
    spline.control_points = [(*place_of(p), 0.0) for p in curve.poles.tolist()]
    spline.knots = curve.knots.tolist()
    return "SPLINE"


def place_of(point: complex) -> tuple[float, float]:
    """A point as a drawing holds it."""
    return round(point.real, DRAWN_DECIMALS) + 0.0, round(point.imag, DRAWN_DECIMALS) + 0.0
