"""Laser DXF: one closed polyline a boundary, arcs as bulges, inner contours first, names in open ones before all else.

Header, tables and objects are those that ezdxf writes for an empty drawing; they lie in ``frames`` as ezdxf wrote
them, since importing ezdxf takes longer than all else a laser file needs. Layers and polylines are put in here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count
from pathlib import Path

import numpy as np

from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Approximation

# ACI colours: engraving blue, first of all; inner contours green, cut before the outer ones, red
LAYER_COLOURS = {"ENGRAVE": 5, "CUT_INNER": 3, "CUT_OUTER": 1}
_FRAMES = Path(__file__).parent / "frames"
VERSIONS = ("R2000", "R12")
# handles of the frames: their model space, table of layers and plot style
_MODEL_SPACE, _LAYERS, _PLOT_STYLE = "17", "1", "13"
# layers that every drawing has: 0 and Defpoints
_OWN_LAYERS = 2
# of the box about everything, mm
_EXTENT_DECIMALS = 12
SLOTS = ("<<left>>", "<<low>>", "<<right>>", "<<high>>", "<<seed>>", "<<layer count>>", "<<layers>>", "<<entities>>")


def write_laser_dxf(
    file: Path,
    layers: tuple[str, ...],
    boundaries: tuple[Approximation, ...],
    *,
    version: str,
    strokes: Sequence[Complex] = (),
) -> dict[str, int]:
    """Write closed polylines in mm, and open ones to be engraved; returns the number of entities of each kind."""
    # "\n" on every system, so that the bytes are the same there too
    file.write_text(laser_dxf(layers, boundaries, version=version, strokes=strokes), encoding="ascii", newline="\n")
    kind = "POLYLINE" if version == "R12" else "LWPOLYLINE"
    arcs = sum(int(np.count_nonzero(b.geometry.bulges)) * b.geometry.count for b in boundaries)
    counts = {kind: len(boundaries) + len(strokes), **({"strokes": len(strokes)} if strokes else {})}
    return {**counts, "vertices": sum(len(b.geometry) for b in boundaries), "arcs": arcs}


def laser_dxf(
    layers: tuple[str, ...], boundaries: tuple[Approximation, ...], *, version: str, strokes: Sequence[Complex] = ()
) -> str:
    """The text of a DXF of closed polylines in mm; ``layers``: where each boundary stands; version R2000 or R12.

    ``strokes``: points of open ones, which stand on ENGRAVE before all else.
    """
    seed, frame = (_FRAMES / f"{version}.dxf").read_text("ascii").split("\n", 1)
    # fresh ones, in capital hexadecimal digits
    handles = (f"{number:X}" for number in count(int(seed, 16)))
    names = tuple(dict.fromkeys((*(["ENGRAVE"] if strokes else []), *layers)))
    rows = [_layer(name, next(handles), version) for name in names]
    drawn = [_polyline(stroke, np.zeros(len(stroke)), "ENGRAVE", handles, version, closed=0) for stroke in strokes]
    outlines = zip(layers, (a.geometry.expanded() for a in boundaries), strict=True)
    drawn += [_polyline(*corners, layer, handles, version) for layer, corners in outlines]
    boxes = [boundary.geometry.box() for boundary in boundaries]
    left, low = min(a.real for a, _ in boxes), min(a.imag for a, _ in boxes)
    right, high = max(b.real for _, b in boxes), max(b.imag for _, b in boxes)
    extents = (repr(round(edge, _EXTENT_DECIMALS)) for edge in (left, low, right, high))
    texts = (*extents, next(handles), str(_OWN_LAYERS + len(names)), "".join(rows), "".join(drawn))
    for slot, text in zip(SLOTS, texts, strict=True):
        frame = frame.replace(slot, text)
    return frame


def _rows(*pairs: tuple[int, object]) -> str:
    """Group codes and values, a line each."""
    return "".join(f"{code:>3}\n{value}\n" for code, value in pairs)


def _layer(name: str, handle: str, version: str) -> str:
    looks = ((2, name), (70, 0), (62, LAYER_COLOURS[name]), (6, "Continuous"))
    if version == "R12":
        return _rows((0, "LAYER"), (5, handle), *looks)
    record = ((330, _LAYERS), (100, "AcDbSymbolTableRecord"), (100, "AcDbLayerTableRecord"))
    # line weight by default
    return _rows((0, "LAYER"), (5, handle), *record, *looks, (370, -3), (390, _PLOT_STYLE))


def _polyline(
    vertices: Complex, bulges: Real, layer: str, handles: Iterator[str], version: str, closed: int = 1
) -> str:
    """One polyline; flag 1 closes it, a bulge of 0 is left out."""
    corners = zip(vertices.real.tolist(), vertices.imag.tolist(), bulges.tolist(), strict=True)
    if version != "R12":
        owner = ((330, _MODEL_SPACE), (100, "AcDbEntity"), (8, layer), (100, "AcDbPolyline"))
        head = _rows((0, "LWPOLYLINE"), (5, next(handles)), *owner, (90, len(vertices)), (70, closed))
        return head + "".join(f" 10\n{x!r}\n 20\n{y!r}\n{_bulge(b)}" for x, y, b in corners)
    own = ((8, layer), (66, 1), (10, 0.0), (20, 0.0), (30, 0.0), (70, closed))
    head = _rows((0, "POLYLINE"), (5, next(handles)), *own)
    points = (
        f"  0\nVERTEX\n  5\n{next(handles)}\n  8\n{layer}\n 10\n{x!r}\n 20\n{y!r}\n 30\n0.0\n{_bulge(b)} 70\n0\n"
        for x, y, b in corners
    )
    return head + "".join(points) + _rows((0, "SEQEND"), (5, next(handles)), (8, layer))


def _bulge(value: float) -> str:
    return f" 42\n{value!r}\n" if value else ""
