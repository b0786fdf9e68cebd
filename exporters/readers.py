"""Read-back: files into loops of lines and arcs, or triangles. Shares no code with the writers."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from geometry.curve import Complex, Real

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element


class ReadError(ValueError):
    """A file is not what its ending says, or holds something that its receivers refuse."""


@dataclass(frozen=True, slots=True)
class Loop:
    """A closed chain as found in a file: vertices (n,), bulges (n,), the layer or id it stood on."""

    vertices: Complex
    bulges: Real
    layer: str


_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_COMMAND = rf"([MLAZ])((?:[\s,]*{_NUMBER})*)"


def read_svg(file: Path) -> list[Loop]:
    """The closed paths and circles of an SVG in mm, y turned up again."""
    from xml.etree import ElementTree

    try:
        root = ElementTree.parse(file).getroot()
        width, height = (_millimetres(root.get(key, "")) for key in ("width", "height"))
        box = [float(x) for x in root.get("viewBox", "").split()]
    except (ElementTree.ParseError, ValueError, OSError) as error:
        raise ReadError(f"not a readable SVG in mm: {error}") from error
    if len(box) != 4 or max(abs(box[2] - width), abs(box[3] - height), abs(box[0]), abs(box[1])) > 1e-9 * width:
        raise ReadError("one unit of the SVG's view box is not one mm")
    loops = []
    for element in root.iter():
        tag = element.tag.rsplit("}", 1)[-1]
        if moved := {"transform", "class"} & set(element.keys()):
            raise ReadError(f"an SVG {tag} has a {moved.pop()}, which laser programs pass over")
        try:
            if tag == "path":
                loops.append(_svg_path(element.get("d", ""), element.get("id", "")))
            elif tag == "circle":
                x, y, r = (float(element.get(k, "nan")) for k in ("cx", "cy", "r"))
                ends = np.array([complex(x + r, -y), complex(x - r, -y)])
                loops.append(Loop(ends, np.ones(2), element.get("id", "")))
            elif tag != "svg":
                raise ReadError(f"an element <{tag}> stands among the outlines")
        except ValueError as error:
            raise ReadError(f"broken {tag}: {error}") from error
    middle = complex(width / 2, -height / 2)
    return [Loop(loop.vertices - middle, loop.bulges, loop.layer) for loop in loops]


def _millimetres(text: str) -> float:
    if not text.endswith("mm"):
        raise ValueError(f'a width or height of "{text}" is not in mm')
    return float(text.removesuffix("mm"))


def _svg_path(data: str, layer: str) -> Loop:
    """One closed subpath of absolute M, L, A and Z."""
    if re.sub(_COMMAND, "", data).strip():
        raise ReadError("an SVG path holds more than M, L, A and Z")
    points: list[complex] = []
    bulges: list[float] = []
    closed = False
    for command, text in re.findall(_COMMAND, data):
        numbers = [float(x) for x in re.findall(_NUMBER, text)]
        if command == "Z":
            closed = True
        elif command == "A":
            if len(numbers) != 7 or not points or numbers[0] != numbers[1]:
                raise ReadError("an SVG arc is not a circular arc of seven numbers")
            end = complex(numbers[5], -numbers[6])
            bulges.append(_svg_bulge(end - points[-1], numbers[0], bool(numbers[3]), bool(numbers[4])))
            points.append(end)
        else:
            if len(numbers) != 2 or closed:
                raise ReadError("an SVG path has more than one part")
            if points:
                bulges.append(0.0)
            points.append(complex(numbers[0], -numbers[1]))
    if not closed or not points or abs(points[-1] - points[0]) > 1e-9:
        raise ReadError("an SVG path is not closed on its first point")
    return Loop(np.array(points[:-1]), np.array(bulges), layer)


def _svg_bulge(chord: complex, radius: float, large: bool, sweep: bool) -> float:
    """Bulge of an SVG arc; sweep flag 1 turns right once y is up."""
    half = math.asin(min(1.0, abs(chord) / (2 * radius)))
    quarter = (math.pi - half if large else half) / 2
    return math.tan(quarter) * (-1 if sweep else 1)


@dataclass(frozen=True, slots=True)
class ReadMesh:
    """Distinct vertices (n, 3) and triangles (k, 3) of an STL file."""

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]


def read_stl(file: Path) -> ReadMesh:
    """A binary STL; equal corners become one vertex."""
    data = file.read_bytes()
    if len(data) < 84:
        raise ReadError("too short for a binary STL")
    count = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * count or count == 0:
        raise ReadError(f"{len(data)} bytes do not hold the {count} triangles that the STL announces")
    rows = np.frombuffer(data, dtype=np.uint8, offset=84).reshape(count, 50)
    corners = rows[:, 12:48].copy().view("<f4").reshape(-1, 3)
    if not np.all(np.isfinite(corners)):
        raise ReadError("an STL coordinate is not a number")
    _check_normals(corners.reshape(-1, 3, 3).astype(float), rows[:, :12].copy().view("<f4").astype(float))
    # + 0 makes one number of the two zeros
    keys = (corners + np.float32(0.0)).view("<u4")
    order = np.lexsort((keys[:, 2], keys[:, 1], keys[:, 0]))
    fresh = np.any(keys[order[1:]] != keys[order[:-1]], axis=1)
    group = np.concatenate([[0], np.cumsum(fresh)])
    vertex = np.zeros(len(order), dtype=np.int64)
    vertex[order] = group
    first = order[np.concatenate([[True], fresh])]
    return ReadMesh(corners[first].astype(float), vertex.reshape(-1, 3))


def _check_normals(corners: NDArray[np.float64], normals: NDArray[np.float64]) -> None:
    """Normals must agree with their corners; STL allows zero for "not given"."""
    true = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(true, axis=1) * np.linalg.norm(normals, axis=1)
    if np.any(np.einsum("ij,ij->i", true, normals) < 0.99 * size):
        raise ReadError("an STL normal contradicts its triangle")


_3MF_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


def read_3mf(file: Path, name: str | None = None) -> ReadMesh:
    """The single object of a 3MF file, in mm; read with zipfile and an XML parser, without lib3mf.

    ``name``: what the object must be called.
    """
    import zipfile
    from xml.etree import ElementTree

    try:
        with zipfile.ZipFile(file) as package:
            root = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    except (zipfile.BadZipFile, KeyError, ElementTree.ParseError, OSError) as error:
        raise ReadError(f"not a readable 3MF: {error}") from error
    objects, items = root.findall(f".//{_3MF_CORE}object"), root.findall(f".//{_3MF_CORE}item")
    if root.get("unit") != "millimeter" or len(objects) != 1 or len(items) != 1:
        raise ReadError("the 3MF does not hold one object in mm, built once")
    if name is not None and objects[0].get("name") != name:
        raise ReadError(f'the part is named "{objects[0].get("name")}" instead of "{name}"')
    if items[0].get("transform") is not None:
        raise ReadError("the part of the 3MF has been moved out of its frame")
    return mesh_of_3mf(objects[0])


def mesh_of_3mf(item: Element) -> ReadMesh:
    """The mesh of an object of a 3MF file."""
    try:
        corners = [[float(v.get(k, "")) for k in "xyz"] for v in item.iter(f"{_3MF_CORE}vertex")]
        rows = [[int(t.get(k, "")) for k in ("v1", "v2", "v3")] for t in item.iter(f"{_3MF_CORE}triangle")]
    except ValueError as error:
        raise ReadError(f"a broken number in the 3MF: {error}") from error
    vertices, triangles = np.array(corners).reshape(-1, 3), np.array(rows, dtype=np.int64).reshape(-1, 3)
    if not len(triangles) or triangles.min() < 0 or triangles.max() >= len(vertices):
        raise ReadError("a 3MF triangle names a vertex that is not there")
    return ReadMesh(vertices, triangles)


def step_names(file: Path) -> list[str]:
    """Names of the products of a STEP file, from its text alone."""
    text = file.read_text(encoding="utf-8", errors="replace")
    return [name.replace("''", "'") for name in re.findall(r"=\s*PRODUCT\s*\(\s*'((?:[^']|'')*)'", text)]
