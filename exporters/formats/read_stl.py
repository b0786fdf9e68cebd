"""Read-back of binary STL. Shares no code with the writer."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from exporters.formats.readback import ReadMesh
from geometry.curves.curve import Real
from parts.base.readback import ReadError, refuse_if

# triangles whose normals are checked together
_AT_ONCE = 1 << 15


def read_stl(file: Path) -> ReadMesh:
    """A binary STL; equal corners become one vertex."""
    data = file.read_bytes()
    refuse_if(len(data) < 84, "too short for a binary STL")
    if data[:80].lstrip().lower().startswith(b"solid"):
        raise ReadError('the STL begins with "solid", by which programs know an STL of text')
    count = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * count or count == 0:
        raise ReadError(f"{len(data)} bytes do not hold the {count} triangles that the STL announces")
    rows = np.frombuffer(data, dtype=np.uint8, offset=84).reshape(count, 50)
    refuse_if(np.any(rows[:, 48:]), "an STL triangle has an attribute, which programs take for a colour")
    corners = rows[:, 12:48].copy().view("<f4").reshape(-1, 3)
    refuse_if(not np.all(np.isfinite(corners)), "an STL coordinate is not a number")
    for k in range(0, count, _AT_ONCE):
        normals = rows[k : k + _AT_ONCE, :12].copy().view("<f4").astype(float)
        _check_normals(corners[3 * k : 3 * (k + _AT_ONCE)].reshape(-1, 3, 3).astype(float), normals)
    del rows, data
    # + 0 makes one number of the two zeros
    keys = (corners + np.float32(0.0)).view("<u4")
    order = np.lexsort((keys[:, 2], keys[:, 1], keys[:, 0]))
    rising = keys[order]
    fresh = np.any(rising[1:] != rising[:-1], axis=1)
    group = np.concatenate([[0], np.cumsum(fresh)])
    vertex = np.zeros(len(order), dtype=np.int64)
    vertex[order] = group
    first = order[np.concatenate([[True], fresh])]
    return ReadMesh(corners[first].astype(float), vertex.reshape(-1, 3))


def _check_normals(corners: Real, normals: Real) -> None:
    """Normals must agree with their corners; STL allows zero for "not given"."""
    true = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(true, axis=1) * np.linalg.norm(normals, axis=1)
    refuse_if(np.any(np.einsum("ij,ij->i", true, normals) < 0.99 * size), "an STL normal contradicts its triangle")
