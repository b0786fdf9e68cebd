"""An animated glTF read back: its solids, and where they stand at any time. Shares no code with the writer."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exporters.formats.readback import ReadMesh
from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.base.readback import ReadError, refuse_if

_WIDTH = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
_KIND = {5125: "<u4", 5126: "<f4"}
_HALF_TURN = np.sqrt(0.5)
_KNOWN = {
    "asset", "scene", "scenes", "nodes", "meshes", "materials", "animations", "accessors", "bufferViews", "buffers",
}  # fmt: skip
# how far a quaternion of float32 numbers may be off its length; nearer ones, rad, are mixed evenly
_UNIT, _SAME = 1e-6, 1e-9


class ReadSolidTrack(Record):
    """An instance: its solid, places (k, 3) mm and quaternions (m, 4) at times (k,), (m,) s; one row where it stays."""

    solid: str
    places: tuple[Real, Real]
    turns: tuple[Real, Real]

    def stand(self, times: Real, points: Real) -> Real:
        """Points (n, 3) of the solid at times (t,), s, (t, n, 3) mm: linear and spherically linear between values, as
        glTF says.
        """
        (one, two, share), (at, other, part) = (_around(*values, times) for values in (self.places, self.turns))
        cosine = np.sum(at * other, axis=-1, keepdims=True)
        other, angle = np.where(cosine < 0, -other, other), np.arccos(np.minimum(np.abs(cosine), 1.0))
        # what both weights have in common is lost as the turn gets its length
        weights = [np.where(angle > _SAME, np.sin(k * angle), k) for k in (1 - part, part)]
        turn = weights[0] * at + weights[1] * other
        turn = (turn / np.linalg.norm(turn, axis=-1, keepdims=True))[:, None]
        axis, w = turn[..., :3], turn[..., 3:]
        turned = points + 2 * np.cross(axis, np.cross(axis, points) + w * points)
        return np.asarray(turned + (one + share * (two - one))[:, None])


class ReadGlb(Record):
    """Solids by name, instances by name, and how long a loop takes, seconds (0: nothing moves)."""

    solids: dict[str, ReadMesh]
    tracks: dict[str, ReadSolidTrack]
    seconds: float


def read_glb(file: Path) -> ReadGlb:
    """Read a binary glTF.

    Raises
    ------
    ReadError
        It is damaged, or holds what our files do not.
    """
    try:
        return _read(file.read_bytes())
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise ReadError(f"is not a sound glTF: {type(error).__name__} {error}") from error


def _read(data: bytes) -> ReadGlb:
    scene, blob = _chunks(data)
    array = partial(_array, scene, blob)
    solids: dict[str, ReadMesh] = {}
    for mesh in scene["meshes"]:
        refuse_if(mesh["name"] in solids, f"has two solids {mesh['name']}")
        solids[mesh["name"]] = _solid(mesh, array)
    root, *nodes = scene["nodes"]
    if (
        scene["scenes"] != [{"nodes": [0]}]
        or root["children"] != list(range(1, len(nodes) + 1))
        or root["scale"] != [0.001] * 3
        or not np.allclose(root["rotation"], [-_HALF_TURN, 0, 0, _HALF_TURN], atol=1e-15)
        or set(root) != {"name", "scale", "rotation", "children"}
    ):
        raise ReadError("its root does not stand millimetres upright in metres")
    moved, seconds = _moved(scene, array)
    names, tracks = list(solids), {}
    for number, node in enumerate(nodes, 1):
        ways = {p: moved.pop((number, p), None) for p in ("translation", "rotation")}
        refuse_if(node["name"] in tracks, f"has two instances {node['name']}")
        tracks[node["name"]] = _track(node, ways, names)
    refuse_if(moved, "moves what is not there")
    return ReadGlb(solids, tracks, seconds)


def _chunks(data: bytes) -> tuple[dict[str, Any], bytes]:
    """What it says of itself, and its numbers."""
    words = np.frombuffer(data[:20], "<u4")
    if data[:4] != b"glTF" or words[1] != 2 or words[2] != len(data) or data[16:20] != b"JSON":
        raise ReadError("does not begin as a binary glTF 2.0 of its length")
    end = 20 + int(words[3])
    scene = json.loads(data[20:end])
    size = int(np.frombuffer(data[end : end + 4], "<u4")[0])
    blob = data[end + 8 :]
    if data[end + 4 : end + 8] != b"BIN\0" or len(blob) != size or scene["buffers"] != [{"byteLength": size}]:
        raise ReadError("its binary part is not as long as it says")
    if set(scene) - _KNOWN or scene["asset"]["version"] != "2.0" or scene["scene"] != 0:
        raise ReadError(f"holds {sorted(set(scene) - _KNOWN)}, which our files do not")
    return scene, blob


def _array(scene: dict[str, Any], blob: bytes, number: int) -> NDArray[Any]:
    """The numbers of an accessor, a row for each of its items."""
    told = scene["accessors"][number]
    view = scene["bufferViews"][told["bufferView"]]
    width, kind = _WIDTH[told["type"]], _KIND[told["componentType"]]
    start, length = view["byteOffset"], view["byteLength"]
    if length != 4 * width * told["count"] or start < 0 or start + length > len(blob):
        raise ReadError(f"accessor {number} does not fit its bytes")
    values = np.frombuffer(blob[start : start + length], kind).reshape(-1, width)
    refuse_if(kind == "<f4" and not np.isfinite(values).all(), f"a number of accessor {number} is none")
    for key, bound in (("min", values.min(axis=0)), ("max", values.max(axis=0))):
        if key in told and told[key] != bound.tolist():
            raise ReadError(f"accessor {number} says another {key} than its numbers have")
    return values.astype(np.float64 if kind == "<f4" else np.int64)


def _solid(mesh: dict[str, Any], array: Callable[[int], NDArray[Any]]) -> ReadMesh:
    (primitive,) = mesh["primitives"]
    if set(primitive) != {"attributes", "indices", "material"} or set(primitive["attributes"]) != {"POSITION"}:
        raise ReadError(f"solid {mesh['name']} is not a mesh of triangles alone")
    vertices, triangles = array(primitive["attributes"]["POSITION"]), array(primitive["indices"]).reshape(-1, 3)
    refuse_if(triangles.max() >= len(vertices), f"solid {mesh['name']} has corners that are not there")
    return ReadMesh(vertices, triangles)


def _track(node: dict[str, Any], ways: dict[str, tuple[Real, Real] | None], solids: list[str]) -> ReadSolidTrack:
    """Where an instance stands, or how it moves; ``ways``: what of it moves, by times and values."""
    if set(node) != {"name", "mesh", *(p for p, way in ways.items() if way is None)}:
        raise ReadError(f"instance {node.get('name')} is not one solid with one place and one turn")
    places, turns = ((np.zeros(1), np.array([node[p]], dtype=float)) if way is None else way for p, way in ways.items())
    if places[1].shape[1] != 3 or turns[1].shape[1] != 4:
        raise ReadError(f"instance {node['name']} has a place or turn of the wrong width")
    if np.abs(np.linalg.norm(turns[1], axis=1) - 1).max() > _UNIT:
        raise ReadError(f"instance {node['name']} has a turn that is none")
    return ReadSolidTrack(solids[node["mesh"]], places, turns)


def _moved(
    scene: dict[str, Any], array: Callable[[int], NDArray[Any]]
) -> tuple[dict[tuple[int, str], tuple[Real, Real]], float]:
    """Times and values of each node and what of it moves; how long it lasts."""
    found: dict[tuple[int, str], tuple[Real, Real]] = {}
    ends = set()
    for animation in scene.get("animations", ()):
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            key = channel["target"]["node"], channel["target"]["path"]
            times, values = array(sampler["input"])[:, 0], array(sampler["output"])
            if key in found or set(sampler) != {"input", "output"} or len(times) != len(values):
                raise ReadError(f"node {key[0]} has more than one {key[1]}, or another one than linear")
            refuse_if(times[0] != 0 or not np.all(np.diff(times) > 0), "times do not rise from 0")
            found[key] = times, values
            ends.add(float(times[-1]))
    refuse_if(len(ends) > 1 or len(scene.get("animations", ())) > 1, "instances take unlike times for their loop")
    return found, ends.pop() if ends else 0.0


def _around(at: Real, values: Real, times: Real) -> tuple[Real, Real, Real]:
    """The values before and behind each time, and its share (t, 1) between them."""
    if len(at) == 1:
        return values, values, np.zeros((len(times), 1))
    k = np.clip(np.searchsorted(at, times, side="right") - 1, 0, len(at) - 2)
    return values[k], values[k + 1], np.clip((times - at[k]) / (at[k + 1] - at[k]), 0, 1)[:, None]
