"""A path for a machine's tool from a DXF: lines, arcs, circles and polylines, chained by their ends."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from parts.base.refusal import SceneError
from parts.pages.inputs import PLACE

if TYPE_CHECKING:
    from ezdxf.entities import DXFEntity

# x1, y1, x2, y2 and the bulge: the tangent of a quarter of the swept angle
Piece = list[float]
# ends that are as near as this, mm, are one
_JOINT = 1e-6


def read_path(file: Path, key: str) -> list[Piece]:
    """The pieces of a DXF in mm, one behind the other from the first entity on.

    Raises
    ------
    SceneError
        The file is no DXF, or holds something else, or its entities are not one path; names ``key``.
    """
    import ezdxf
    from ezdxf.lldxf.const import DXFError

    if not file.is_file():
        raise SceneError(PLACE, key, str(file), "no_such_file")
    try:
        drawing = ezdxf.readfile(file)
    except (DXFError, OSError, UnicodeDecodeError) as error:
        raise SceneError(PLACE, key, str(file), "no_dxf") from error
    runs = [
        [[float(number) for number in piece] for piece in run]
        for entity in drawing.modelspace()
        for run in _pieces(entity, key, file)
    ]
    if not runs:
        raise SceneError(PLACE, key, str(file), "no_path")
    path, left = runs[0], runs[1:]
    while left:
        end = complex(*path[-1][2:4])
        # as they run, or turned round
        ways = [*((run, run) for run in left), *((run, _turned(run)) for run in left)]
        found = next((row for row in ways if abs(complex(*row[1][0][:2]) - end) <= _JOINT), None)
        if found is None:
            raise SceneError(PLACE, key, str(file), "path_is_open", None, x=end.real, y=end.imag, left=len(left))
        left.remove(found[0])
        path = path + found[1]
    return path


def _turned(run: list[Piece]) -> list[Piece]:
    return [[x2, y2, x1, y1, -bulge] for x1, y1, x2, y2, bulge in reversed(run)]


def _pieces(entity: DXFEntity, key: str, file: Path) -> list[list[Piece]]:
    """What one entity draws: a chain."""
    from ezdxf.entities import LWPolyline

    kind, at = entity.dxftype(), entity.dxf
    if kind == "LINE":
        return [[[at.start.x, at.start.y, at.end.x, at.end.y, 0.0]]]
    if kind in ("CIRCLE", "ARC"):
        start, sweep = (0.0, 360.0) if kind == "CIRCLE" else (at.start_angle, (at.end_angle - at.start_angle) % 360)
        # at most a half turn each, so that the bulge is at most 1
        count = 2 if sweep > 180 else 1
        ends = [math.radians(start + sweep * k / count) for k in range(count + 1)]
        places = [(at.center.x + at.radius * math.cos(a), at.center.y + at.radius * math.sin(a)) for a in ends]
        if kind == "CIRCLE":
            places[-1] = places[0]
        bulge = math.tan(math.radians(sweep / count) / 4)
        return [[[*places[k], *places[k + 1], bulge] for k in range(count)]]
    if isinstance(entity, LWPolyline):
        points = list(entity.get_points("xyb"))
        points += points[:1] if entity.closed else []
        chain = [[p[0], p[1], q[0], q[1], p[2]] for p, q in pairwise(points) if p[:2] != q[:2]]
        return [chain] if chain else []
    raise SceneError(PLACE, key, str(file), "no_path_entity", None, kind=kind)
