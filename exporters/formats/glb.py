"""glTF 2.0 in one binary file: solids that turn and move over one loop, again and again, in any viewer of 3D scenes."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.solids.mesh import Mesh

_MAGIC, _JSON, _BIN = b"glTF", b"JSON", b"BIN\0"
_FLOAT, _UNSIGNED, _VERTICES, _INDICES = 5126, 5125, 34962, 34963
# glTF counts in metres, and up is y
_ROOT = {"scale": [0.001] * 3, "rotation": [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]}
# of places and turns: far below single numbers
_DECIMALS = 12
_TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}


class SolidTrack(Record):
    """How an instance of a solid moves: shares of the loop with places (k, 3) mm, and with quaternions (m, 4), x y z w.

    One row where it stays.
    """

    name: str
    solid: str
    places: tuple[Real, Real]
    turns: tuple[Real, Real]


def write_glb(
    file: Path, title: str, solids: Mapping[str, tuple[Mesh, str]], tracks: Sequence[SolidTrack], seconds: float
) -> None:
    """Write meshes (mm) with their colours (#rrggbb) and what moves them."""
    data = _Data()
    meshes = []
    for number, (name, (mesh, _)) in enumerate(solids.items()):
        attributes = {"POSITION": data.add(mesh.vertices.astype("<f4"), _VERTICES)}
        indices = data.add(mesh.triangles.astype("<u4").reshape(-1, 1), _INDICES)
        meshes.append(
            {"name": name, "primitives": [{"attributes": attributes, "indices": indices, "material": number}]}
        )
    materials = [
        {"pbrMetallicRoughness": {"baseColorFactor": _linear(colour), "metallicFactor": 0.1, "roughnessFactor": 0.6}}
        for _, colour in solids.values()
    ]
    nodes: list[dict[str, Any]] = [{"name": title, **_ROOT, "children": list(range(1, len(tracks) + 1))}]
    channels: list[dict[str, Any]] = []
    samplers: list[dict[str, int]] = []
    times: dict[bytes, int] = {}
    numbers = {name: number for number, name in enumerate(solids)}
    for track in tracks:
        node: dict[str, Any] = {"name": track.name, "mesh": numbers[track.solid]}
        for path, (shares, exact) in (("translation", track.places), ("rotation", track.turns)):
            # what is left of a nought is not the same on any processor
            values = np.round(exact, _DECIMALS) + 0.0
            if len(values) == 1:
                node[path] = values[0].tolist()
                continue
            at = (seconds * shares).astype("<f4")
            if at.tobytes() not in times:
                times[at.tobytes()] = data.add(at[:, None])
            channels.append({"sampler": len(samplers), "target": {"node": len(nodes), "path": path}})
            samplers.append({"input": times[at.tobytes()], "output": data.add(values.astype("<f4"))})
        nodes.append(node)
    scene = {
        "asset": {"version": "2.0", "generator": "higherpair"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        **({"animations": [{"channels": channels, "samplers": samplers}]} if channels else {}),
        "accessors": data.accessors,
        "bufferViews": data.views,
        "buffers": [{"byteLength": data.size}],
    }
    text = json.dumps(scene, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    whole = 12 + 8 + len(text) + 8 + data.size
    with file.open("wb") as stream:
        stream.write(_MAGIC + _words(2, whole) + _words(len(text)) + _JSON + text + _words(data.size) + _BIN)
        stream.writelines(data.pieces)


class _Data:
    """The binary part of a file: arrays one after the other, each with its view and its accessor."""

    def __init__(self) -> None:
        self.pieces: list[bytes] = []
        self.size = 0
        self.views: list[dict[str, int]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: NDArray[Any], target: int | None = None) -> int:
        """Add rows of numbers of four bytes; the number of their accessor."""
        piece = values.tobytes()
        self.pieces.append(piece)
        view = {"buffer": 0, "byteOffset": self.size, "byteLength": len(piece)}
        self.views.append(view if target is None else {**view, "target": target})
        self.size += len(piece)
        kind = _UNSIGNED if target == _INDICES else _FLOAT
        told: dict[str, Any] = {"bufferView": len(self.accessors), "componentType": kind, "count": len(values)}
        told["type"] = _TYPES[values.shape[1]]
        # readers ask for the bounds of places and of times
        if kind == _FLOAT and values.shape[1] != 4:
            told |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        self.accessors.append(told)
        return len(self.accessors) - 1


def _words(*values: int) -> bytes:
    return np.array(values, dtype="<u4").tobytes()


def _linear(colour: str) -> list[float]:
    """A colour as glTF has it: without the screen's curve (IEC 61966-2-1)."""
    shades = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    return [round(s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4, 6) for s in shades] + [1.0]
