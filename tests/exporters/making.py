"""Scenes as text, builds through the command, and the files read by readers of the tests' own."""

from __future__ import annotations

import json
import math
import re
import struct
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
from numpy.typing import NDArray

from exporters.command.cli import main
from tests.exporters.outside import Chain, Gear, deviations

NUMBER = r"[-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?"


def toml(value: object) -> str:
    """A value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def table(head: str, keys: dict[str, Any]) -> str:
    """A table of a scene."""
    return "\n".join([head, *(f"{k} = {toml(v)}" for k, v in keys.items())]) + "\n\n"


def part_keys(gear: Gear, face_width: float = 5.0) -> dict[str, Any]:
    """The scene keys of a gear."""
    keys: dict[str, Any] = {
        "kind": "spur_gear",
        "module": gear.module,
        "number_of_teeth": gear.teeth,
        "profile_shift_coefficient": gear.shift,
        "bore_diameter": gear.bore,
        "circumferential_thinning": gear.thinning,
        "face_width": face_width,
    }
    if gear.tip_diameter is not None:
        keys["tip_diameter"] = gear.tip_diameter
    if gear.relief_depth:
        keys["tip_relief"] = {"depth_coefficient": gear.relief_depth, "height_coefficient": gear.relief_height}
    return keys


Keys = dict[str, Any]


def write_scene(file: Path, parts: dict[str, Keys], exports: Iterable[Keys], head: str = "") -> Path:
    """A scene file."""
    text = head + "".join(table(f"[parts.{k}]", v) for k, v in parts.items())
    file.write_text(text + "".join(table("[[exports]]", e) for e in exports), encoding="utf-8")
    return file


def run(*arguments: object) -> int:
    """The command in this process; its exit code."""
    try:
        return main([str(a) for a in arguments])
    except SystemExit as end:
        return int(end.code or 0)


def build_gear(folder: Path, gear: Gear, *exports: dict[str, Any], face_width: float = 5.0) -> dict[str, Any]:
    """Build one gear named ``g``; the report, its files in ``folder/out/s``.

    The same gear with the same exports is built once: every test has a copy of its own.
    """
    text = write_scene(folder / "s.toml", {"g": part_keys(gear, face_width)}, exports).read_text(encoding="utf-8")
    (folder / "out" / "s").mkdir(parents=True, exist_ok=True)
    for name, data in _built(text).items():
        (folder / "out" / "s" / name).write_bytes(data)
    return read_report(folder / "out" / "s")


@cache
def _built(text: str) -> dict[str, bytes]:
    """The files of a scene, by name."""
    with tempfile.TemporaryDirectory() as place:
        scene = Path(place) / "s.toml"
        scene.write_text(text, encoding="utf-8")
        assert run("build", scene, "--out", Path(place) / "out") == 0
        return {file.name: file.read_bytes() for file in (Path(place) / "out" / "s").iterdir()}


def read_report(folder: Path) -> dict[str, Any]:
    """The report of a build."""
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


def dxf_chains(file: Path) -> list[Chain]:
    """Polylines of a DXF in the order of the file."""
    chains = []
    for entity in ezdxf.readfile(file).modelspace():
        if entity.dxftype() == "LWPOLYLINE":
            rows = np.array(entity.get_points("xyb"), dtype=float)
        else:
            rows = np.array([(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0)) for v in entity.vertices])
        chains.append(Chain(rows[:, 0] + 1j * rows[:, 1], 4 * np.arctan(rows[:, 2]), entity.dxf.layer))
    return chains


def svg_shapes(file: Path) -> tuple[ElementTree.Element, list[ElementTree.Element]]:
    """The root of an SVG and everything in it."""
    root = ElementTree.parse(file).getroot()
    return root, [e for e in root.iter() if e is not root]


def svg_layer(shape: ElementTree.Element) -> str:
    """What an outline's id says of it; ids differ, so that a second one of a layer has a number."""
    return re.sub(r"-\d+$", "", shape.attrib["id"])


def svg_chains(file: Path) -> list[Chain]:
    """Outlines of an SVG about the middle of its view box, y up."""
    root, shapes = svg_shapes(file)
    left, top, width, height = map(float, root.attrib["viewBox"].split())
    middle = complex(left + width / 2, -(top + height / 2))
    chains = []
    for shape in shapes:
        if shape.tag.endswith("circle"):
            centre = complex(float(shape.attrib["cx"]), -float(shape.attrib["cy"])) - middle
            radius = float(shape.attrib["r"])
            chains.append(Chain(centre + radius * np.array([1, -1]), np.full(2, math.pi), svg_layer(shape)))
        else:
            chains.append(_svg_path(shape, middle))
    return chains


def _svg_path(shape: ElementTree.Element, middle: complex) -> Chain:
    """One closed path of M, L and A, read token by token; arcs by SVG 1.1, F.6.5."""
    tokens = re.findall(rf"[A-Za-z]|{NUMBER}", shape.attrib["d"])
    assert tokens[0] == "M"
    assert tokens[-1] == "Z"
    points, sweeps, at = [complex(float(tokens[1]), -float(tokens[2]))], [], 3
    while tokens[at] != "Z":
        if tokens[at] == "L":
            points.append(complex(float(tokens[at + 1]), -float(tokens[at + 2])))
            sweeps.append(0.0)
            at += 3
        else:
            assert tokens[at] == "A"
            rx, ry, turn, large, clockwise, x, y = map(float, tokens[at + 1 : at + 8])
            assert rx == ry
            assert turn == 0
            points.append(complex(x, -y))
            half = math.asin(min(1.0, abs(points[-1] - points[-2]) / 2 / rx))
            sweep = 2 * (math.pi - half if large else half)
            # flag 1: angles grow with y down, which is clockwise once y is up
            sweeps.append(-sweep if clockwise else sweep)
            at += 8
    assert abs(points[-1] - points[0]) < 1e-9
    return Chain(np.array(points[:-1]) - middle, np.array(sweeps), svg_layer(shape))


@dataclass(frozen=True)
class Triangles:
    """An STL as it lies in the file: header, normals (n, 3) and corners (n, 3, 3) in float32."""

    header: bytes
    normals: NDArray[np.float32]
    corners: NDArray[np.float32]


def stl_triangles(file: Path) -> Triangles:
    """Records of a binary STL, taken apart with struct."""
    data = file.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    rows = np.array([r[:12] for r in struct.iter_unpack("<12fH", data[84:])], dtype=np.float32)
    return Triangles(data[:80], rows[:, :3], rows[:, 3:].reshape(-1, 3, 3))


def face_chains(mesh: Triangles, height: float) -> list[Chain]:
    """Borders of the face at a height, as chains of straight edges, the innermost first."""
    flat = mesh.corners[np.all(mesh.corners[:, :, 2] == np.float32(height), axis=1)]
    corner = [[(float(x), float(y)) for x, y, _ in triangle] for triangle in flat]
    edges = {(t[i], t[(i + 1) % 3]) for t in corner for i in range(3)}
    following = {a: b for a, b in edges if (b, a) not in edges}
    chains = []
    while following:
        start, here = following.popitem()
        chain = [start]
        while here != start:
            chain.append(here)
            here = following.pop(here)
        points = np.array([complex(*p) for p in chain])
        chains.append(Chain(points, np.zeros(len(points)), ""))
    return sorted(chains, key=lambda c: float(np.abs(c.vertices).max()))


def chains_of(file: Path, height: float = 0.0) -> list[Chain]:
    """Outlines of any file, the bore first."""
    if file.suffix == ".stl":
        return face_chains(stl_triangles(file), height)
    return dxf_chains(file) if file.suffix == ".dxf" else svg_chains(file)


def check_deviation(file: Path, gear: Gear, entry: dict[str, Any], height: float = 0.0) -> dict[str, float]:
    """Hold a file against the outline: within its tolerance, and its declared error neither too small nor too large.

    The share of the tolerance allowed on top is what the straight pieces of the outside outline may be off.
    """
    own = 3e-7 + (3e-6 if gear.relief_depth else 0.0)
    worst = deviations(chains_of(file, height), gear, entry["offset"])
    assert {"fillet", "flank", "tip"} <= set(worst), worst
    for name, value in worst.items():
        assert value <= entry["tolerance"] + own, (name, value)
        assert value <= entry["max_error"] + own, (name, value, entry["max_error"])
    assert entry["max_error"] <= 2 * max(worst.values()) + own, (entry["max_error"], worst)
    return worst
