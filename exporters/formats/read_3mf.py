"""Read-back of 3MF packages in mm: zipped XML, read without lib3mf. Shares no code with the writer."""

from __future__ import annotations

import zipfile
import zlib
from array import array
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from exporters.formats.read_assembly import Occurrence, Prototype, ReadAssembly
from exporters.formats.readback import MOST_READ_BYTES, ReadMesh
from geometry.curves.curve import Real
from parts.base.readback import ReadError, refuse_if

# numbers as text pack five to ten times; a small package may do as it likes
_DENSEST, _SMALL = 30, 4_000_000
_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


_UUID = "{http://schemas.microsoft.com/3dmanufacturing/production/2015/06}UUID"
_LANGUAGE = "{http://www.w3.org/XML/1998/namespace}lang"
# what stands in a file of ours, and the values that say no more than their absence; all else may hide, move or colour
_KNOWN: dict[str, dict[str, tuple[str, ...]]] = {
    "model": {"unit": (), _LANGUAGE: (), "requiredextensions": ("",), "recommendedextensions": ()},
    "metadata": {"name": (), "preserve": (), "type": ()},
    "resources": {},
    "basematerials": {"id": ()},
    "base": {"name": (), "displaycolor": ()},
    "object": {"id": (), "name": (), "partnumber": (), "type": ("model",), "pid": (), "pindex": (), _UUID: ()},
    "mesh": {},
    "vertices": {},
    "vertex": {"x": (), "y": (), "z": ()},
    "triangles": {},
    "triangle": {"v1": (), "v2": (), "v3": ()},
    "build": {_UUID: ()},
    "item": {"objectid": (), "transform": (), "partnumber": (), "printable": ("1", "true"), _UUID: ()},
}
# elements of which there are a million, and what stands for one
_MANY, _NOTHING, _AT_ONCE = ("vertex", "triangle"), ElementTree.Element(""), 1 << 16
_MODEL, _STARTS, _TYPES = "3D/3dmodel.model", "_rels/.rels", "[Content_Types].xml"
_START = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"


class _Numbers(NamedTuple):
    """Those of a mesh, one behind the other: places of vertices, and vertices of triangles."""

    places: array[float]
    corners: array[int]


class _Reader(ElementTree.TreeBuilder):
    """A model's tree but for the many elements of its meshes, of which the numbers alone are kept, by object.

    All that stands in the model is known, and says that the part is one to be made, as it is.
    """

    def __init__(self) -> None:
        super().__init__()
        self.meshes: dict[ElementTree.Element, _Numbers] = {}
        self.own: _Numbers | None = None

    def start(self, tag: str, attrs: dict[str, str]) -> ElementTree.Element:
        name = tag.removeprefix(_CORE)
        _check_known(name, attrs)
        if name not in _MANY:
            element = super().start(tag, attrs)
            if name == "object":
                self.own = self.meshes[element] = _Numbers(array("d"), array("q"))
            return element
        if self.own is None:
            raise ReadError(f"a <{name}> of the 3MF stands in no object")
        try:
            if name == "vertex":
                self.own.places.extend([float(attrs.get(k, "")) for k in "xyz"])
            else:
                self.own.corners.extend([int(attrs.get(k, "")) for k in ("v1", "v2", "v3")])
        except (ValueError, OverflowError) as error:
            raise ReadError(f"a broken number in the 3MF: {error}") from error
        return _NOTHING

    def end(self, tag: str) -> ElementTree.Element:
        name = tag.removeprefix(_CORE)
        if name in _MANY:
            return _NOTHING
        if name == "object":
            self.own = None
        return super().end(tag)


class _Base(NamedTuple):
    """A material: its name, and its colour, #rrggbb."""

    name: str | None = None
    colour: str | None = None


def read_3mf(file: Path) -> ReadMesh:
    """The single object of a 3MF package, built once where it stands."""
    root, meshes = _model(file)
    objects, items = root.findall(f".//{_CORE}object"), root.findall(f".//{_CORE}item")
    refuse_if(len(objects) != 1 or len(items) != 1, "the 3MF does not hold one object, built once")
    if items[0].get("transform") is not None:
        raise ReadError("the part of the 3MF has been moved out of its frame")
    return _mesh(objects[0], meshes[objects[0]], _base(objects[0], _bases(root)))


def read_3mf_assembly(file: Path) -> ReadAssembly:
    """Every object and build item of a 3MF package; components of components are refused."""
    root, meshes = _model(file)
    title = next((m.text or "" for m in root.findall(f"{_CORE}metadata") if m.get("name") == "Title"), "")
    bases = _bases(root)
    prototypes: list[Prototype] = []
    index: dict[str | None, int] = {}
    for item in root.iter(f"{_CORE}object"):
        if item.find(f"{_CORE}mesh") is None:
            raise ReadError("an object of the 3MF holds no mesh of its own")
        index[item.get("id")] = len(prototypes)
        mesh = _mesh(item, meshes[item], _base(item, bases))
        prototypes.append(Prototype(mesh.name or "", mesh, mesh.colour))
    occurrences = []
    for item in root.iter(f"{_CORE}item"):
        refuse_if(item.get("objectid") not in index, "a build item names an object that is not there")
        place = _transform(item)
        occurrences.append(Occurrence(item.get("partnumber", ""), index[item.get("objectid")], place))
    return ReadAssembly(title, prototypes, occurrences)


def _bases(root: ElementTree.Element) -> dict[str | None, list[_Base]]:
    """The materials of each group."""
    shades = [base.get("displaycolor", "").lower() for base in root.iter(f"{_CORE}base")]
    refuse_if(any(shade[7:] not in ("", "ff") for shade in shades), "a material of the 3MF can be seen through")
    return {
        group.get("id"): [
            _Base(base.get("name"), base.get("displaycolor", "")[:7].lower()) for base in group.iter(f"{_CORE}base")
        ]
        for group in root.iter(f"{_CORE}basematerials")
    }


def _base(item: ElementTree.Element, bases: dict[str | None, list[_Base]]) -> _Base:
    group, number = bases.get(item.get("pid"), []), item.get("pindex", "")
    return group[int(number)] if number.isdigit() and int(number) < len(group) else _Base()


def _transform(item: ElementTree.Element) -> Real:
    """(3, 4) of a build item; 3MF writes four rows of three that multiply row vectors."""
    text = item.get("transform")
    if text is None:
        return np.eye(3, 4)
    try:
        numbers = np.array([float(x) for x in text.split()])
    except ValueError as error:
        raise ReadError(f"a broken transform in the 3MF: {error}") from error
    refuse_if(numbers.size != 12 or not np.all(np.isfinite(numbers)), "a transform of the 3MF has not twelve numbers")
    return numbers.reshape(4, 3).T


def _model(file: Path) -> tuple[ElementTree.Element, dict[ElementTree.Element, _Numbers]]:
    """The root of the model in a whole package, in mm, and the numbers of each object's mesh."""
    try:
        with zipfile.ZipFile(file) as package:
            inside = sum(entry.file_size for entry in package.infolist())
            most = min(MOST_READ_BYTES, max(_SMALL, _DENSEST * file.stat().st_size))
            told = f"the 3MF package unpacks to {inside} bytes; at most {most} are read of one of its size"
            refuse_if(inside > most, told)
            if package.testzip() is not None:
                raise ReadError("the 3MF package is damaged")
            names = [name.lower() for name in package.namelist()]
            refuse_if(len(set(names)) < len(names), "the 3MF package holds a part twice")
            refuse_if(_TYPES not in package.namelist(), f"the 3MF package has no {_TYPES}")
            relations = ElementTree.fromstring(package.read(_STARTS))
            starts = [r.get("Target") for r in relations if r.get("Type") == _START]
            refuse_if(starts != [f"/{_MODEL}"], f"the 3MF package begins with {starts} instead of its model")
            reader = _Reader()
            parser = ElementTree.XMLParser(target=reader)
            with package.open(_MODEL) as model:
                while block := model.read(_AT_ONCE):
                    parser.feed(block)
            root: ElementTree.Element = parser.close()
    except (zipfile.BadZipFile, KeyError, ElementTree.ParseError, OSError, EOFError, zlib.error) as error:
        raise ReadError(f"not a readable 3MF: {error}") from error
    refuse_if(root.get("unit") != "millimeter", "the 3MF is not in mm")
    return root, reader.meshes


def _check_known(tag: str, values: dict[str, str]) -> None:
    known = _KNOWN.get(tag)
    if known is None:
        raise ReadError(f"the 3MF holds <{tag}>, which is not read here")
    for name, value in values.items():
        refuse_if(name not in known, f"a <{tag}> of the 3MF has {name}, which is not read here")
        if (allowed := known[name]) and value not in allowed:
            raise ReadError(f'a <{tag}> of the 3MF has {name} = "{value}"')


def _mesh(item: ElementTree.Element, numbers: _Numbers, base: _Base) -> ReadMesh:
    """The mesh of an object."""
    vertices = np.array(numbers.places).reshape(-1, 3)
    triangles = np.array(numbers.corners, dtype=np.int64).reshape(-1, 3)
    if not len(triangles) or triangles.min() < 0 or triangles.max() >= len(vertices):
        raise ReadError("a 3MF triangle names a vertex that is not there")
    # an object that has a part number is called by it, and its name is what people read
    name, number = item.get("name", ""), item.get("partnumber")
    return ReadMesh(vertices, triangles, number or name, base.colour, name if number else None, base.name)
