"""Laser DXF: one closed polyline a boundary, arcs as bulges, inner contours first. No kernel, no spline."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import ezdxf
import numpy as np
from ezdxf.document import Drawing

from geometry.contour import Approximation, Contour

# ACI colours: engraving blue, first of all; inner contours green, cut before the outer ones, red
LAYER_COLOURS = {"ENGRAVE": 5, "CUT_INNER": 3, "CUT_OUTER": 1}
_MILLIMETRES = 4


def write_laser_dxf(
    file: Path, layers: tuple[str, ...], boundaries: tuple[Approximation, ...], *, version: str
) -> dict[str, int]:
    """Write closed polylines in mm; returns the number of entities of each kind."""
    with fixed_metadata():
        drawing = _new_drawing(version)
    drawing.header["$LUNITS"] = 2
    if version != "R12":
        drawing.header["$MEASUREMENT"] = 1
    for name in dict.fromkeys(layers):
        drawing.layers.add(name, color=LAYER_COLOURS[name])
    space = drawing.modelspace()
    corners = []
    for layer, boundary in zip(layers, boundaries, strict=True):
        contour = boundary.geometry
        corners.append(_extent(contour))
        _add_polyline(space, layer, contour, version)
    low, high = np.min([c[0] for c in corners], axis=0), np.max([c[1] for c in corners], axis=0)
    # ezdxf writes the header's extents from those of the layout
    space.reset_extents((*low, 0.0), (*high, 0.0))
    with fixed_metadata():
        save(drawing, file)
    kind = "POLYLINE" if version == "R12" else "LWPOLYLINE"
    vertices = sum(len(b.geometry) for b in boundaries)
    return {kind: len(boundaries), "vertices": vertices, "arcs": _arc_count(boundaries)}


def _new_drawing(version: str) -> Drawing:
    """An empty drawing in mm. R12 has no unit in its header, which ezdxf would complain about at every call."""
    logger = logging.getLogger("ezdxf")
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        return ezdxf.new(version, setup=False, units=_MILLIMETRES)
    finally:
        logger.setLevel(before)


def _add_polyline(space, layer: str, contour: Contour, version: str) -> None:
    vertices, bulges = contour.expanded()
    attributes = {"layer": layer}
    if version == "R12":
        rows = np.stack([vertices.real, vertices.imag, bulges], axis=1)
        space.add_polyline2d(rows.tolist(), format="xyb", close=True, dxfattribs=attributes)
        return
    polyline = space.add_lwpolyline([], dxfattribs=attributes)
    rows = np.zeros((len(vertices), 5))
    rows[:, 0], rows[:, 1], rows[:, 4] = vertices.real, vertices.imag, bulges
    # appending point by point is quadratic; the vertices' own array is not
    polyline.lwpoints.values = rows
    polyline.closed = True


def _extent(contour: Contour) -> tuple[tuple[float, float], tuple[float, float]]:
    """Corners of a box around a contour about the origin: its greatest radius each way."""
    reach = float(np.abs(contour.vertices).max())
    return (-reach, -reach), (reach, reach)


def _arc_count(boundaries: tuple[Approximation, ...]) -> int:
    return sum(int(np.count_nonzero(b.geometry.bulges)) * b.geometry.count for b in boundaries)


@contextmanager
def fixed_metadata() -> Iterator[None]:
    """The same bytes at every run: ezdxf's dates and ids fixed while a file is written."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def save(drawing: Drawing, file: Path) -> None:
    """Write a drawing with its own encoding."""
    # ezdxf takes the classes that a version needs out of a set, whose order differs from process to process
    drawing.classes.add_required_classes(drawing.dxfversion)
    drawing.classes.classes = dict(sorted(drawing.classes.classes.items()))
    # "\n" on every system, so that the bytes are the same there too
    with file.open("w", encoding=drawing.output_encoding, errors="dxfreplace", newline="\n") as stream:
        drawing.write(stream)
