"""Read-back of files that hold named parts in their places: STEP through the kernel's XCAF reader, 3MF as zipped XML.

Shares no code with the writers.
"""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from exporters.readers import ReadError, mesh_of_3mf


@dataclass(frozen=True, slots=True)
class ReadAssembly:
    """What a file holds: its title, prototypes (name, mesh or shape, colour), and occurrences.

    An occurrence is its name, the index of its prototype, and its placement as (3, 4): rotation and move, mm.
    """

    title: str
    prototypes: list[tuple[str, Any, str | None]]
    occurrences: list[tuple[str, int, NDArray[np.float64]]]


_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


def read_3mf_assembly(file: Path) -> ReadAssembly:
    """Every object and build item of a 3MF package in mm; components of components are refused."""
    try:
        with zipfile.ZipFile(file) as package:
            if package.testzip() is not None:
                raise ReadError("the 3MF package is damaged")
            root = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    except (zipfile.BadZipFile, KeyError, ElementTree.ParseError, OSError, EOFError, zlib.error) as error:
        raise ReadError(f"not a readable 3MF: {error}") from error
    if root.get("unit") != "millimeter":
        raise ReadError("the 3MF is not in mm")
    title = next((m.text or "" for m in root.findall(f"{_CORE}metadata") if m.get("name") == "Title"), "")
    bases = {
        group.get("id"): [base.get("displaycolor", "")[:7].lower() for base in group.iter(f"{_CORE}base")]
        for group in root.iter(f"{_CORE}basematerials")
    }
    prototypes: list[tuple[str, Any, str | None]] = []
    index: dict[str | None, int] = {}
    for item in root.iter(f"{_CORE}object"):
        if item.find(f"{_CORE}mesh") is None:
            raise ReadError("an object of the 3MF holds no mesh of its own")
        index[item.get("id")] = len(prototypes)
        prototypes.append((item.get("name", ""), mesh_of_3mf(item), _base_colour(item, bases)))
    occurrences = []
    for item in root.iter(f"{_CORE}item"):
        if item.get("objectid") not in index:
            raise ReadError("a build item names an object that is not there")
        occurrences.append((item.get("partnumber", ""), index[item.get("objectid")], _transform(item)))
    return ReadAssembly(title, prototypes, occurrences)


def _base_colour(item: ElementTree.Element, bases: dict[str | None, list[str]]) -> str | None:
    shades, number = bases.get(item.get("pid"), []), item.get("pindex", "")
    return shades[int(number)] if number.isdigit() and int(number) < len(shades) else None


def _transform(item: ElementTree.Element) -> NDArray[np.float64]:
    """(3, 4) of a build item; 3MF writes four rows of three that multiply row vectors."""
    text = item.get("transform")
    if text is None:
        return np.eye(3, 4)
    try:
        numbers = np.array([float(x) for x in text.split()])
    except ValueError as error:
        raise ReadError(f"a broken transform in the 3MF: {error}") from error
    if numbers.size != 12 or not np.all(np.isfinite(numbers)):
        raise ReadError("a transform of the 3MF has not twelve numbers")
    return numbers.reshape(4, 3).T


def read_step_assembly(file: Path) -> ReadAssembly:
    """The products of a STEP file: one level of occurrences, or a single product in its own place."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDF import TDF_LabelSequence
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

    from exporters.step import silent_kernel
    from exporters.step_reading import check_numbers, leave_crossings

    check_numbers(file)
    with silent_kernel():
        reader = STEPCAFControl_Reader()
        reader.SetNameMode(True)
        reader.SetColorMode(True)
        document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
        if reader.ReadFile(str(file)) != IFSelect_RetDone:
            raise ReadError("not a readable STEP file")
        leave_crossings(reader)
        if not reader.Transfer(document):
            raise ReadError("not a readable STEP file")
        roots = TDF_LabelSequence()
        XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).GetFreeShapes(roots)
        colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
        if roots.Length() != 1:
            raise ReadError(f"{roots.Length()} products stand alone in the STEP file instead of 1")
        root = roots.Value(1)
        if not XCAFDoc_ShapeTool.IsAssembly_s(root):
            shape = XCAFDoc_ShapeTool.GetShape_s(root)
            single = (_label_name(root), shape, _label_colour(colours, root))
            return ReadAssembly(single[0], [single], [(single[0], 0, _location(shape))])
        return _components(root, colours)


def _components(root: Any, colours: Any) -> ReadAssembly:
    from OCP.TDF import TDF_Label
    from OCP.XCAFDoc import XCAFDoc_ShapeTool

    labels: list[Any] = []
    prototypes: list[tuple[str, Any, str | None]] = []
    occurrences = []
    for component in _children(root):
        target = TDF_Label()
        if not XCAFDoc_ShapeTool.GetReferredShape_s(component, target):
            raise ReadError("a component of the STEP file refers to no product")
        known = next((i for i, label in enumerate(labels) if label.IsEqual(target)), None)
        if known is None:
            known = len(labels)
            labels.append(target)
            shape = XCAFDoc_ShapeTool.GetShape_s(target)
            if XCAFDoc_ShapeTool.IsAssembly_s(target):
                raise ReadError("an assembly stands inside the assembly")
            prototypes.append((_label_name(target), shape, _label_colour(colours, target)))
        occurrences.append((_label_name(component), known, _location(XCAFDoc_ShapeTool.GetShape_s(component))))
    return ReadAssembly(_label_name(root), prototypes, occurrences)


def _children(root: Any) -> Iterator[Any]:
    from OCP.TDF import TDF_LabelSequence
    from OCP.XCAFDoc import XCAFDoc_ShapeTool

    found = TDF_LabelSequence()
    XCAFDoc_ShapeTool.GetComponents_s(root, found, False)
    for index in range(1, found.Length() + 1):
        yield found.Value(index)


def _label_name(label: Any) -> str:
    from OCP.TDataStd import TDataStd_Name

    name = TDataStd_Name()
    return name.Get().ToExtString() if label.FindAttribute(TDataStd_Name.GetID_s(), name) else ""


def _label_colour(colours: Any, label: Any) -> str | None:
    """The colour of a product as #rrggbb."""
    from OCP.Quantity import Quantity_Color
    from OCP.XCAFDoc import XCAFDoc_ColorGen, XCAFDoc_ColorSurf

    shade = Quantity_Color()
    for kind in (XCAFDoc_ColorGen, XCAFDoc_ColorSurf):
        if colours.GetColor_s(label, kind, shade):
            return str(Quantity_Color.ColorToHex_s(shade, True).ToCString()).lower()
    return None


def _location(shape: Any) -> NDArray[np.float64]:
    transformation = shape.Location().Transformation()
    return np.array([[transformation.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
