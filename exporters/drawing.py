"""Drawing DXF: R2010 with true splines (knots and control points), arcs and circles as themselves, mm."""

from __future__ import annotations

import math
from pathlib import Path

import ezdxf

from exporters.dxf_file import fixed_metadata, save
from geometry.line_arc import Arc, Line
from geometry.outline import CadCurve, Outline

_LAYER = "OUTLINE"
_MILLIMETRES = 4


def write_drawing_dxf(file: Path, boundaries: tuple[Outline, ...]) -> dict[str, int]:
    """Write every boundary curve by curve on one layer; returns the number of entities of each kind."""
    with fixed_metadata():
        drawing = ezdxf.new("R2010", setup=False, units=_MILLIMETRES)
    drawing.header["$LUNITS"] = 2
    drawing.header["$MEASUREMENT"] = 1
    drawing.layers.add(_LAYER, color=7, lineweight=50)
    space = drawing.modelspace()
    counts: dict[str, int] = {}
    reach = 0.0
    for boundary in boundaries:
        for curve in boundary.curves():
            kind = add_curve(space, curve, _LAYER)
            counts[kind] = counts.get(kind, 0) + 1
        reach = max(reach, *(abs(complex(c.point(c.domain[0]))) for c in boundary.period))
    space.reset_extents((-reach, -reach, 0.0), (reach, reach, 0.0))
    with fixed_metadata():
        save(drawing, file)
    return counts


def add_curve(space, curve: CadCurve, layer: str) -> str:
    """One curve on a layer as the DXF entity that it is; returns that entity's name."""
    attributes = {"layer": layer}
    if isinstance(curve, Line):
        space.add_line(_xy(curve.start), _xy(curve.end), dxfattribs=attributes)
        return "LINE"
    if isinstance(curve, Arc):
        if abs(curve.sweep) >= 2 * math.pi:
            space.add_circle(_xy(curve.centre), curve.radius, dxfattribs=attributes)
            return "CIRCLE"
        # DXF arcs always turn left
        low, high = sorted((curve.start_angle, curve.start_angle + curve.sweep))
        space.add_arc(_xy(curve.centre), curve.radius, math.degrees(low), math.degrees(high), dxfattribs=attributes)
        return "ARC"
    spline = space.add_spline(dxfattribs=attributes, degree=curve.degree)
    spline.control_points = [(*_xy(p), 0.0) for p in curve.poles.tolist()]
    spline.knots = curve.knots.tolist()
    return "SPLINE"


def _xy(point: complex) -> tuple[float, float]:
    return point.real, point.imag
