"""Binary STL in mm."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from parts.solids.mesh import Mesh

RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
HEADER_BYTES = 80
# triangles written together: all of a large mesh would fill the memory
_AT_ONCE = 1 << 15


def write_stl(file: Path, mesh: Mesh) -> dict[str, int]:
    """Write a mesh; normals follow from the rounded corners."""
    vertices, triangles = mesh.vertices.astype("<f4"), mesh.triangles
    with file.open("wb") as stream:
        stream.write(b"higherpair binary STL, mm".ljust(HEADER_BYTES, b" "))
        stream.write(np.uint32(len(triangles)).tobytes())
        for k in range(0, len(triangles), _AT_ONCE):
            corners = vertices[triangles[k : k + _AT_ONCE]]
            exact = corners.astype(float)
            normals = np.cross(exact[:, 1] - exact[:, 0], exact[:, 2] - exact[:, 0])
            lengths = np.linalg.norm(normals, axis=1, keepdims=True)
            records = np.zeros(len(corners), dtype=RECORD)
            records["normal"] = normals / np.where(lengths > 0, lengths, 1.0)
            records["corners"] = corners
            stream.write(records.tobytes())
    return {"triangles": len(triangles), "vertices": len(vertices)}
