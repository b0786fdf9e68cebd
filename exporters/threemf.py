"""3MF in mm through lib3mf: named objects, colours, one build item a part, the same bytes every time."""

from __future__ import annotations

import ctypes
import uuid
from pathlib import Path
from typing import Any

import numpy as np

from parts.solids import Mesh

# decimals written for each coordinate: more than a float32 holds at any size that is printed
_DECIMALS = 9
_DEFAULT_COLOUR = "#b8c4d0"


def write_3mf(file: Path, name: str, mesh: Mesh, colour: str | None) -> dict[str, int]:
    """Write one part as one build item."""
    import lib3mf
    from lib3mf import Lib3MF

    model = lib3mf.get_wrapper().CreateModel()
    model.SetUnit(Lib3MF.ModelUnit.MilliMeter)
    materials = model.AddBaseMaterialGroup()
    item = model.AddMeshObject()
    item.SetName(name)
    item.SetGeometry(
        _structs(Lib3MF.Position, mesh.vertices.astype("<f4")), _structs(Lib3MF.Triangle, mesh.triangles.astype("<u4"))
    )
    shade = _colour(Lib3MF, colour or _DEFAULT_COLOUR)
    item.SetObjectLevelProperty(materials.GetResourceID(), materials.AddMaterial(name, shade))
    build = model.AddBuildItem(item, lib3mf.get_wrapper().GetIdentityTransform())
    # ids from the names, for lib3mf would draw random ones
    item.SetUUID(_uuid(name, "object"))
    build.SetUUID(_uuid(name, "item"))
    model.SetBuildUUID(_uuid(name, "build"))
    writer = model.QueryWriter("3mf")
    writer.SetDecimalPrecision(_DECIMALS)
    writer.WriteToFile(str(file))
    return {"triangles": len(mesh.triangles), "vertices": len(mesh.vertices)}


def _structs(kind: Any, rows: np.ndarray) -> Any:
    """A ctypes array of three-number structs over a numpy array."""
    return (kind * len(rows)).from_buffer_copy(np.ascontiguousarray(rows))


def _colour(library: Any, text: str) -> Any:
    shade = library.Color()
    shade.Red, shade.Green, shade.Blue = (ctypes.c_ubyte(int(text[i : i + 2], 16)).value for i in (1, 3, 5))
    shade.Alpha = 255
    return shade


def _uuid(name: str, what: str) -> str:
    return str(uuid.uuid5(uuid.NAMESPACE_URL, f"higherpair/{what}/{name}"))
