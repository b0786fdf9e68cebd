"""STEP AP214 in mm through the kernel's XCAF document: names, colours, a fixed header, the same bytes every time."""

from __future__ import annotations

import re
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from geometry.base.errors import GeometryError
from geometry.base.placement import Placement3
from geometry.base.record import Record
from parts.solids.kernel import silent_kernel

if TYPE_CHECKING:
    from OCP.gp import gp_Trsf
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.TCollection import TCollection_HAsciiString
    from OCP.TDF import TDF_Label
    from OCP.TDocStd import TDocStd_Document
    from OCP.TopoDS import TopoDS_Solid
    from OCP.XCAFDoc import XCAFDoc_ShapeTool

_HEADER_TIME = "2000-01-01T00:00:00"
_SETTINGS = {
    "write.step.schema": "AP214IS",
    "write.step.unit": "MM",
    "write.surfacecurve.mode": 0,
    "write.precision.mode": 0,
    "write.step.assembly": 1,
}


class StepPart(Record):
    """A named solid (TopoDS_Solid) with its colour, like "#c08040"."""

    name: str
    solid: TopoDS_Solid
    colour: str | None


def write_step(file: Path, name: str, solid: TopoDS_Solid, colour: str | None) -> dict[str, int]:
    """Write one named solid; counts entities of the file by kind."""
    with silent_kernel():
        document, shapes = _document()
        _add_part(document, shapes, StepPart(name, solid, colour))
        return _written(file, document, name)


def write_step_assembly(
    file: Path, name: str, parts: Sequence[StepPart], occurrences: Sequence[tuple[str, str, Placement3]]
) -> dict[str, int]:
    """Write one product per part and an occurrence of it for each of ``occurrences``: its name, the part's, its place.

    Counts entities of the file by kind.
    """
    from OCP.TopLoc import TopLoc_Location

    with silent_kernel():
        document, shapes = _document()
        labels = {part.name: _add_part(document, shapes, part) for part in parts}
        root = shapes.NewShape()
        _name(root, name)
        for occurrence, part, scene_from_part in occurrences:
            place = TopLoc_Location(_transformation(scene_from_part))
            _name(shapes.AddComponent(root, labels[part], place), occurrence)
        shapes.UpdateAssemblies()
        return _written(file, document, name)


def _written(file: Path, document: TDocStd_Document, name: str) -> dict[str, int]:
    """Translate and write a document; called with the kernel silent."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.STEPControl import STEPControl_StepModelType

    # the controller must exist before its settings do
    writer = STEPCAFControl_Writer()
    _apply_settings()
    writer.SetNameMode(True)
    writer.SetColorMode(True)
    if not writer.Transfer(document, STEPControl_StepModelType.STEPControl_AsIs):
        raise GeometryError("the kernel cannot translate the solid to STEP")
    _fix_header(writer, name)
    stream = BytesIO()
    if writer.WriteStream(stream) != IFSelect_RetDone:
        raise GeometryError("the kernel cannot write the solid as STEP")
    # we write it ourselves: the kernel takes no name that is not UTF-8, and does not say why a file cannot be written
    data = _tidied(stream.getvalue())
    file.write_bytes(data)
    kinds = ("CYLINDRICAL_SURFACE", "SURFACE_OF_LINEAR_EXTRUSION", "PLANE", "MANIFOLD_SOLID_BREP")
    return {kind: data.count(f"={kind}(".encode()) + data.count(f"= {kind}(".encode()) for kind in kinds}


def _document() -> tuple[TDocStd_Document, XCAFDoc_ShapeTool]:
    """An empty document and its tool for shapes."""
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    return document, XCAFDoc_DocumentTool.ShapeTool_s(document.Main())


def _add_part(document: TDocStd_Document, shapes: XCAFDoc_ShapeTool, part: StepPart) -> TDF_Label:
    """The label of a part that was added to a document."""
    from OCP.Quantity import Quantity_Color, Quantity_TOC_sRGB
    from OCP.XCAFDoc import XCAFDoc_ColorGen, XCAFDoc_DocumentTool

    label = shapes.AddShape(part.solid, False)
    _name(label, part.name)
    if part.colour is not None:
        red, green, blue = (int(part.colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
        shade = Quantity_Color(red, green, blue, Quantity_TOC_sRGB)
        XCAFDoc_DocumentTool.ColorTool_s(document.Main()).SetColor(label, shade, XCAFDoc_ColorGen)
    return label


def _name(label: TDF_Label, name: str) -> None:
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name

    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name, True))


def _transformation(placement: Placement3) -> gp_Trsf:
    from OCP.gp import gp_Trsf

    transformation = gp_Trsf()
    transformation.SetValues(*(float(x) for x in placement.matrix().ravel()))
    return transformation


def _apply_settings() -> None:
    """The kernel's settings are global to the process: all of them are set before each write."""
    from OCP.Interface import Interface_Static

    for key, value in _SETTINGS.items():
        done = (
            Interface_Static.SetCVal_s(key, value) if isinstance(value, str) else Interface_Static.SetIVal_s(key, value)
        )
        if not done:
            raise GeometryError(f"the kernel does not take {key} = {value}")


def _fix_header(writer: STEPCAFControl_Writer, name: str) -> None:
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
    from OCP.TCollection import TCollection_HAsciiString

    def text(value: str) -> TCollection_HAsciiString:
        return TCollection_HAsciiString(value)

    header = APIHeaderSection_MakeHeader(writer.ChangeWriter().Model())
    header.SetName(text(f"{name}.step"))
    header.SetTimeStamp(text(_HEADER_TIME))
    header.SetAuthorValue(1, text(""))
    header.SetOrganizationValue(1, text(""))
    header.SetOriginatingSystem(text("higherpair"))
    header.SetAuthorisation(text(""))


_STYLES = re.compile(rb"#\d+ ?= ?MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION\(")
_STATEMENT = re.compile(rb"#(\d+) ?= ?([^;]*;)\s*")
_REFERENCE = re.compile(rb"#(\d+)")
_OCCURRENCE = re.compile(rb"(NEXT_ASSEMBLY_USAGE_OCCURRENCE\(')\d+('[^;]*;)")


def _tidied(data: bytes) -> bytes:
    """Renumber the occurrence ids, which count on through the process and shift line ends.

    The colours at the end come in the order of the kernel's addresses, and are put in that of what they colour.
    """
    numbers = iter(range(1, data.count(b"NEXT_ASSEMBLY_USAGE_OCCURRENCE(") + 1))
    fixed = _OCCURRENCE.sub(lambda m: m[1] + str(next(numbers)).encode() + re.sub(rb"\s*\n\s*", b"", m[2]), data)
    return _styles_in_order(fixed)


def _styles_in_order(data: bytes) -> bytes:
    """A file whose last statements, the colours, stand and are numbered in the order of the solids they belong to."""
    first = _STYLES.search(data)
    if first is None:
        return data
    end = data.index(b"ENDSEC;", first.start())
    texts = {int(m[1]): re.sub(rb"\s*\n\s*", b"", m[2]) for m in _STATEMENT.finditer(data, first.start(), end)}

    def references(number: int) -> list[int]:
        return [int(m[1]) for m in _REFERENCE.finditer(texts[number])]

    def coloured(root: int) -> list[int]:
        """What a root's styled items belong to: references that lead out of the colours."""
        items = [item for item in references(root) if item in texts]
        return [r for item in items for r in references(item) if r not in texts]

    order: dict[int, int] = {}
    start = min(texts)
    waiting = sorted((n for n, text in texts.items() if _STYLES.match(b"#1=" + text)), key=coloured, reverse=True)
    while waiting:
        number = waiting.pop()
        if number in texts and number not in order:
            order[number] = start + len(order)
            waiting += reversed(references(number))
    if len(order) != len(texts):
        return data
    lines = []
    for number, fresh in order.items():
        text = _REFERENCE.sub(lambda m: b"#%d" % order.get(int(m[1]), int(m[1])), texts[number])
        lines.append(b"#%d = %s\n" % (fresh, text))
    return data[: first.start()] + b"".join(lines) + data[end:]
