"""Which way faces, bounds and edges run by a STEP file's own text: a kernel turns what is wrong, and does not say so.

ISO 10303-42: in a closed shell every edge is used twice, once each way; a face's normal is its surface's, or against
it; an edge runs along its curve, or against it.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from parts.base.readback import ReadError

_HEAD = rb"#(\d+)\s*=\s*"
_REFERENCE = re.compile(rb"#(\d+)")
_SHELL = re.compile(rb"=\s*CLOSED_SHELL\s*\(\s*''\s*,\s*\(([^)]*)\)")
_FACE = re.compile(_HEAD + rb"ADVANCED_FACE\s*\(\s*''\s*,\s*\(([^)]*)\)\s*,\s*#\d+\s*,\s*\.([TF])\.")
_BOUND = re.compile(_HEAD + rb"FACE_(?:OUTER_)?BOUND\s*\(\s*''\s*,\s*#(\d+)\s*,\s*\.([TF])\.")
_LOOP = re.compile(_HEAD + rb"EDGE_LOOP\s*\(\s*''\s*,\s*\(([^)]*)\)")
_USE = re.compile(_HEAD + rb"ORIENTED_EDGE\s*\(\s*''\s*,\s*\*\s*,\s*\*\s*,\s*#(\d+)\s*,\s*\.([TF])\.")
_EDGE = re.compile(_HEAD + rb"EDGE_CURVE\s*\(\s*''\s*,\s*#(\d+)\s*,\s*#(\d+)\s*,\s*#(\d+)\s*,\s*\.([TF])\.")
_VERTEX = re.compile(_HEAD + rb"VERTEX_POINT\s*\(\s*''\s*,\s*#(\d+)")
_LINE = re.compile(_HEAD + rb"LINE\s*\(\s*''\s*,\s*#\d+\s*,\s*#(\d+)")
_VECTOR = re.compile(_HEAD + rb"VECTOR\s*\(\s*''\s*,\s*#(\d+)")
_SPLINE = re.compile(_HEAD + rb"B_SPLINE_CURVE_WITH_KNOTS\s*\(\s*''\s*,\s*\d+\s*,\s*\(([^)]*)\)")
_PLACE = re.compile(_HEAD + rb"(?:CARTESIAN_POINT|DIRECTION)\s*\(\s*''\s*,\s*\(([^)]*)\)")

Place = tuple[float, ...]


def face_senses(data: bytes) -> list[tuple[bool, ...]]:
    """Of every closed shell, whether its faces' normals are those of their surfaces; ``data``: no words in strings.

    Raises
    ------
    ReadError
        An edge is not used once each way, or runs against its curve.
    """
    faces = {m[1]: (m[2], m[3] == b"T") for m in _FACE.finditer(data)}
    bounds = {m[1]: (m[2], m[3] == b"T") for m in _BOUND.finditer(data)}
    loops = {m[1]: m[2] for m in _LOOP.finditer(data)}
    uses = {m[1]: (m[2], m[3] == b"T") for m in _USE.finditer(data)}
    found = []
    try:
        for shell in _SHELL.finditer(data):
            members = [faces[name] for name in _REFERENCE.findall(shell[1])]
            ways: Counter[tuple[bytes, bool]] = Counter()
            for listed, _ in members:
                for loop, along in (bounds[name] for name in _REFERENCE.findall(listed)):
                    ways.update(
                        (edge, way == along) for edge, way in map(uses.__getitem__, _REFERENCE.findall(loops[loop]))
                    )
            if any(times != 1 or (edge, not way) not in ways for (edge, way), times in ways.items()):
                raise ReadError("an edge of the STEP file is not used once each way")
            found.append(tuple(sense for _, sense in members))
    except KeyError as error:
        raise ReadError(f"the STEP file refers to #{error.args[0].decode()}, which is not what it should be") from error
    if any(_against(data)):
        raise ReadError("an edge of the STEP file runs against its curve")
    return found


def _against(data: bytes) -> Iterator[bool]:
    """Whether each straight edge or spline runs another way than it says."""
    places = {m[1]: tuple(map(float, m[2].split(b","))) for m in _PLACE.finditer(data)}
    vertices = {m[1]: places.get(m[2], ()) for m in _VERTEX.finditer(data)}
    vectors = {m[1]: places.get(m[2], ()) for m in _VECTOR.finditer(data)}
    lines = {m[1]: vectors.get(m[2], ()) for m in _LINE.finditer(data)}
    splines = {m[1]: _REFERENCE.findall(m[2]) for m in _SPLINE.finditer(data)}
    for edge in _EDGE.finditer(data):
        start, end = vertices.get(edge[2], ()), vertices.get(edge[3], ())
        if start == end:
            continue
        if edge[4] in lines:
            along = sum((b - a) * d for a, b, d in zip(start, end, lines[edge[4]], strict=False))
            yield (along > 0) != (edge[5] == b"T")
        elif edge[4] in splines:
            first = places.get(splines[edge[4]][0], ())
            yield (_apart(first, start) < _apart(first, end)) != (edge[5] == b"T")


def _apart(a: Place, b: Place) -> float:
    return sum((x - y) ** 2 for x, y in zip(a, b, strict=False))
