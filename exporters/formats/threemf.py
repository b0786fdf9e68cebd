"""3MF in mm through lib3mf: named objects, colours, one build item a part, the same bytes every time."""

from __future__ import annotations

import ctypes
import re
import uuid
import zipfile
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from geometry.base.placement import Placement3
from geometry.base.record import Record
from parts.base.part_keys import USUAL_COLOUR
from parts.solids.mesh import Mesh

if TYPE_CHECKING:
    from lib3mf.Lib3MF import BaseMaterialGroup, BuildItem, Color, MeshObject, Model, Transform

# decimals written for each coordinate: more than a float32 holds at any size that is printed
_DECIMALS = 9
_MODEL = "3D/3dmodel.model"


class MeshPart(Record):
    """A mesh by its id, with its colour, like "#c08040", what people call it, in a language, and what it is made of."""

    name: str
    mesh: Mesh
    colour: str | None
    title: str = ""
    material: str | None = None
    language: str = "en"


def write_3mf(file: Path, part: MeshPart) -> dict[str, int]:
    """Write one part as one build item."""
    name = part.name
    model = _model(part.title or name, part.language)
    item = _add_object(model, model.AddBaseMaterialGroup(), part, _uuid(name, "object"))
    _add_item(model, item, _home(), _uuid(name, "item"))
    file.write_bytes(_package(model, _uuid(name, "build")))
    return {"triangles": len(part.mesh.triangles), "vertices": len(part.mesh.vertices)}


def write_3mf_assembly(
    file: Path, name: str, parts: Sequence[MeshPart], occurrences: Sequence[tuple[str, str, Placement3]]
) -> dict[str, int]:
    """Write one object per part and a build item of it for each of ``occurrences``: its name, the part's, its place.

    The name of an occurrence is its item's part number.
    """
    model = _model(name, parts[0].language)
    materials = model.AddBaseMaterialGroup()
    objects = {p.name: _add_object(model, materials, p, _uuid(f"{name}/{p.name}", "object")) for p in parts}
    home = _home()
    for occurrence, part, _ in occurrences:
        _add_item(model, objects[part], home, _uuid(f"{name}/{occurrence}", "item")).SetPartNumber(occurrence)
    package = _package(model, _uuid(name, "build"))
    file.write_bytes(_with_places(package, {occurrence: place for occurrence, _, place in occurrences}))
    meshes = [p.mesh for p in parts]
    return {"triangles": sum(len(m.triangles) for m in meshes), "vertices": sum(len(m.vertices) for m in meshes)}


def _model(title: str, language: str) -> Model:
    import lib3mf
    from lib3mf import Lib3MF

    try:
        library = lib3mf.get_wrapper()
    except Lib3MF.ELib3MFException as error:
        # its own library is loaded here, not as it is imported
        raise ImportError(str(error), name="lib3mf") from error
    model = library.CreateModel()
    model.SetUnit(Lib3MF.ModelUnit.MilliMeter)
    model.SetLanguage(language)
    model.GetMetaDataGroup().AddMetaData("", "Title", title, "xs:string", True)
    return model


def _add_object(model: Model, materials: BaseMaterialGroup, part: MeshPart, identity: str) -> MeshObject:
    """A mesh object, its id the part number where it has a title; UUIDs from the ids, lib3mf would draw random ones."""
    from lib3mf import Lib3MF

    item = model.AddMeshObject()
    # slicers list objects by their names
    item.SetName(part.title or part.name)
    if part.title:
        item.SetPartNumber(part.name)
    item.SetGeometry(
        _structs(Lib3MF.Position, part.mesh.vertices.astype("<f4")),
        _structs(Lib3MF.Triangle, part.mesh.triangles.astype("<u4")),
    )
    shade = _colour(part.colour or USUAL_COLOUR)
    item.SetObjectLevelProperty(materials.GetResourceID(), materials.AddMaterial(part.material or part.name, shade))
    item.SetUUID(identity)
    return item


def _home() -> Transform:
    """No move; the library is loaded anew by each call of ``get_wrapper``."""
    import lib3mf

    return lib3mf.get_wrapper().GetIdentityTransform()


def _add_item(model: Model, item: MeshObject, home: Transform, identity: str) -> BuildItem:
    build = model.AddBuildItem(item, home)
    build.SetUUID(identity)
    return build


def _package(model: Model, identity: str) -> bytes:
    """The file's bytes; lib3mf's own writing of files ends the process where a disk is full."""
    model.SetBuildUUID(identity)
    writer = model.QueryWriter("3mf")
    writer.SetDecimalPrecision(_DECIMALS)
    return bytes(writer.WriteToBuffer())


def _with_places(data: bytes, places: dict[str, Placement3]) -> bytes:
    """A package with the places of its build items in all their digits: lib3mf would write six of them."""

    def placed(found: re.Match[str]) -> str:
        # row vectors are multiplied: four rows of three, the move last
        numbers = " ".join(repr(x) for x in places[found[2]].matrix().T.ravel().tolist())
        return f'{found[1]} transform="{numbers}"/>'

    with zipfile.ZipFile(BytesIO(data)) as package:
        content = {name: package.read(name) for name in package.namelist()}
    model = content[_MODEL].decode("utf-8")
    content[_MODEL] = re.sub(r'(<item [^>]*partnumber="([^"]*)"[^>]*?)\s*/>', placed, model).encode("utf-8")
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as package:
        for name, entry_data in content.items():
            # without a date of its own an entry gets the earliest one; the system is named as anywhere else
            entry = zipfile.ZipInfo(name)
            entry.create_system = 3
            package.writestr(entry, entry_data, zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def _structs(kind: type[ctypes.Structure], rows: np.ndarray) -> ctypes.Array[ctypes.Structure]:
    """A ctypes array of three-number structs over a numpy array."""
    return (kind * len(rows)).from_buffer_copy(np.ascontiguousarray(rows).data)


def _colour(text: str) -> Color:
    from lib3mf import Lib3MF

    shade = Lib3MF.Color()
    shade.Red, shade.Green, shade.Blue = (ctypes.c_ubyte(int(text[i : i + 2], 16)).value for i in (1, 3, 5))
    shade.Alpha = 255
    return shade


def _uuid(name: str, what: str) -> str:
    return str(uuid.uuid5(uuid.NAMESPACE_URL, f"higherpair/{what}/{name}"))
