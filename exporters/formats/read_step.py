"""Read-back of STEP files by the CAD kernel: as they are, with no crossing of a wire mended for them.

The kernel's repair of self-crossing wires looks at every pair of edges, and walks through a linked list to fetch each:
cubic in the teeth, 160 of 170 s of a gear of 1 000. A read-back must not mend what it judges anyway: crossings are
found by ``BRepCheck_Analyzer`` and by our own test of the measured loops.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from exporters.formats.chains import nodes, smooth_loops
from exporters.formats.read_assembly import Occurrence, Prototype, ReadAssembly
from exporters.formats.readback import SmoothLoop
from exporters.formats.step_senses import face_senses
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from parts.base.readback import ReadError
from parts.solids.kernel import faces_of, silent_kernel

if TYPE_CHECKING:
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TDF import TDF_Label
    from OCP.TopoDS import TopoDS_Shape
    from OCP.XCAFDoc import XCAFDoc_ColorTool

# the kernel wants a name for what it reads, and takes none that is not UTF-8
_STREAM = "part.step"
_UNMENDED = ("FixShape.FixSelfIntersectionMode", "FixShape.FixIntersectingWiresMode")
_STRINGS = re.compile(rb"'[^']*'")
# what C's reader of numbers takes for one, and exponents beyond any length
_STRANGE = re.compile(rb"[(,]\s*([-+]?(?:nan|inf)[a-z]*|[-+]?[\d.]+e\+?0*[1-9]\d\d+)", re.IGNORECASE)
_PRODUCT = re.compile(r"=\s*PRODUCT\s*\(\s*'((?:[^']|'')*)'")
_SHADE = re.compile(r"=\s*COLOUR_RGB\s*\(\s*'[^']*'\s*,([-+\d.E,\s]+)\)")
_NAMED_SHADE = re.compile(r"=\s*DRAUGHTING_PRE_DEFINED_COLOUR\s*\(\s*'(\w+)'")
_NAMED_SHADES = {
    "red": "#ff0000", "green": "#00ff00", "blue": "#0000ff", "yellow": "#ffff00", "magenta": "#ff00ff",
    "cyan": "#00ffff", "black": "#000000", "white": "#ffffff",
}  # fmt: skip
_HIDDEN = re.compile(rb"=\s*\(?\s*(\w*INVISIBILITY|SURFACE_STYLE_TRANSPARENT)\s*\(")
# walls stand upright, and knots lie apart, by this, mm
_UPRIGHT = 1e-9
# a cylinder is one smooth span for so long, rad
_SPAN = math.radians(5)


class ReadSolid(Record):
    """A solid as the kernel has read it, the names of the products in its file, and its colour, where it has one."""

    shape: TopoDS_Shape
    products: tuple[str, ...]
    colour: str | None = None
    has_arcs = False
    is_flat = False

    def names(self) -> tuple[str, ...]:
        """The products."""
        return self.products

    def section(self, z: float) -> tuple[SmoothLoop, ...]:
        """The upright walls at a height, evaluated by the kernel."""
        from OCP.BRepAdaptor import BRepAdaptor_Surface

        share, pieces = nodes(), list[Complex]()
        for face in faces_of(self.shape):
            surface = BRepAdaptor_Surface(face)
            low, high = surface.FirstVParameter(), surface.LastVParameter()
            bottom, top = (surface.Value(surface.FirstUParameter(), v) for v in (low, high))
            between = min(bottom.Z(), top.Z()) < z < max(bottom.Z(), top.Z())
            if not between or abs(bottom.X() - top.X()) > _UPRIGHT:
                continue
            for a, b in pairwise(_smooth_spans(surface)):
                places = [surface.Value(u, low) for u in (a + share * (b - a)).tolist()]
                pieces.append(np.array([complex(p.X(), p.Y()) for p in places]))
        return smooth_loops(pieces)

    def faces(self) -> Real:
        """None: its faces are not triangles."""
        return np.zeros((0, 3, 3))


def _smooth_spans(surface: BRepAdaptor_Surface) -> Real:
    """Parameters between which a wall is smooth: knots of its spline (the kernel's intervals pass over simple ones)."""
    from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_SurfaceType

    low, high = surface.FirstUParameter(), surface.LastUParameter()
    kind = surface.GetType()
    if kind == GeomAbs_SurfaceType.GeomAbs_Cylinder:
        return np.linspace(low, high, max(2, math.ceil((high - low) / _SPAN)) + 1)
    if kind == GeomAbs_SurfaceType.GeomAbs_SurfaceOfExtrusion:
        basis = surface.BasisCurve()
        if basis.GetType() == GeomAbs_CurveType.GeomAbs_BSplineCurve:
            spline = basis.BSpline()
            knots = np.array([spline.Knot(k) for k in range(1, spline.NbKnots() + 1)])
            return np.array([low, *knots[(knots > low + _UPRIGHT) & (knots < high - _UPRIGHT)], high])
    return np.array([low, high])


def read_step(file: Path) -> ReadSolid:
    """The single shape of a STEP file."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPControl import STEPControl_Reader

    data, senses = _content(file)
    with silent_kernel():
        reader = STEPControl_Reader()
        if reader.ReadStream(_STREAM, BytesIO(data)) != IFSelect_RetDone:
            raise ReadError("not a readable STEP file")
        leave_crossings(reader)
        reader.TransferRoots()
        shape = reader.OneShape()
    _check_senses(senses, [shape])
    text = data.decode("utf-8", errors="replace")
    return ReadSolid(shape, tuple(name.replace("''", "'") for name in _PRODUCT.findall(text)), _colour(text))


def _colour(text: str) -> str | None:
    """The one colour of a file; None where it has none or several."""
    found = {f"#{''.join(f'{round(255 * float(x)):02x}' for x in shade.split(','))}" for shade in _SHADE.findall(text)}
    found |= {_NAMED_SHADES.get(name, "") for name in _NAMED_SHADE.findall(text)}
    return found.pop() if len(found) == 1 else None


def read_step_assembly(file: Path) -> ReadAssembly:
    """The products of a STEP file: one level of occurrences, or a single product in its own place."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDF import TDF_LabelSequence
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

    data, senses = _content(file)
    with silent_kernel():
        reader = STEPCAFControl_Reader()
        reader.SetNameMode(True)
        reader.SetColorMode(True)
        document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
        if reader.ReadStream(_STREAM, BytesIO(data)) != IFSelect_RetDone:
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
            single = _prototype(root, colours)
            place = _location(XCAFDoc_ShapeTool.GetShape_s(root))
            read = ReadAssembly(single.name, [single], [Occurrence(single.name, 0, place)])
        else:
            read = _components(root, colours)
        _check_senses(senses, [p.part.shape for p in read.prototypes if isinstance(p.part, ReadSolid)])
        return read


def _check_senses(told: list[tuple[bool, ...]], shapes: list[TopoDS_Shape]) -> None:
    """The kernel's faces, which it has turned where it must, are those of the file's text, in its order."""
    from OCP.TopAbs import TopAbs_Orientation

    forward = TopAbs_Orientation.TopAbs_FORWARD
    found = [tuple(face.Orientation() == forward for face in faces_of(shape)) for shape in shapes]
    if sorted(told) != sorted(found):
        raise ReadError("a face of the STEP file is turned inside out")


def _components(root: TDF_Label, colours: XCAFDoc_ColorTool) -> ReadAssembly:
    from OCP.TDF import TDF_Label
    from OCP.XCAFDoc import XCAFDoc_ShapeTool

    labels: list[TDF_Label] = []
    prototypes: list[Prototype] = []
    occurrences = []
    for component in _children(root):
        target = TDF_Label()
        if not XCAFDoc_ShapeTool.GetReferredShape_s(component, target):
            raise ReadError("a component of the STEP file refers to no product")
        known = next((i for i, label in enumerate(labels) if label.IsEqual(target)), None)
        if known is None:
            known = len(labels)
            labels.append(target)
            if XCAFDoc_ShapeTool.IsAssembly_s(target):
                raise ReadError("an assembly stands inside the assembly")
            prototypes.append(_prototype(target, colours))
        place = _location(XCAFDoc_ShapeTool.GetShape_s(component))
        occurrences.append(Occurrence(_label_name(component), known, place))
    return ReadAssembly(_label_name(root), prototypes, occurrences)


def _children(root: TDF_Label) -> Iterator[TDF_Label]:
    from OCP.TDF import TDF_LabelSequence
    from OCP.XCAFDoc import XCAFDoc_ShapeTool

    found = TDF_LabelSequence()
    XCAFDoc_ShapeTool.GetComponents_s(root, found, False)
    for index in range(1, found.Length() + 1):
        yield found.Value(index)


def _prototype(label: TDF_Label, colours: XCAFDoc_ColorTool) -> Prototype:
    """A product with its colour as #rrggbb."""
    from OCP.Quantity import Quantity_Color
    from OCP.XCAFDoc import XCAFDoc_ColorGen, XCAFDoc_ColorSurf, XCAFDoc_ShapeTool

    name, shade, colour = _label_name(label), Quantity_Color(), None
    if any(colours.GetColor_s(label, kind, shade) for kind in (XCAFDoc_ColorGen, XCAFDoc_ColorSurf)):
        colour = str(Quantity_Color.ColorToHex_s(shade, True).ToCString()).lower()
    return Prototype(name, ReadSolid(XCAFDoc_ShapeTool.GetShape_s(label), (name,)), colour)


def _label_name(label: TDF_Label) -> str:
    from OCP.TDataStd import TDataStd_Name

    name = TDataStd_Name()
    return name.Get().ToExtString() if label.FindAttribute(TDataStd_Name.GetID_s(), name) else ""


def _location(shape: TopoDS_Shape) -> NDArray[np.float64]:
    transformation = shape.Location().Transformation()
    return np.array([[transformation.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])


def _content(file: Path) -> tuple[bytes, list[tuple[bool, ...]]]:
    """A STEP file and the senses of its faces.

    Over a coordinate that is not a number the kernel would not come to an end.
    """
    data = file.read_bytes()
    wordless = _STRINGS.sub(b"''", data)
    if found := _STRANGE.search(wordless):
        raise ReadError(f"a number in the STEP file is {found[1].decode()}")
    if hidden := _HIDDEN.search(wordless):
        raise ReadError(f"the STEP file holds {hidden[1].decode()}: something in it is not seen")
    return data, face_senses(wordless)


def leave_crossings(reader: STEPControl_Reader | STEPCAFControl_Reader) -> None:
    """Tell a reader to mend no crossing; after its file is read.

    Before version 7.9 the kernel takes this from files of its own only: there it reads as it always did, slowly.
    """
    choose = getattr(reader, "SetShapeFixParameters", None)
    if choose is None:
        return
    from OCP.Resource import Resource_DataMapOfAsciiStringAsciiString
    from OCP.TCollection import TCollection_AsciiString

    chosen = Resource_DataMapOfAsciiStringAsciiString()
    for key in _UNMENDED:
        chosen.Bind(TCollection_AsciiString(key), TCollection_AsciiString("0"))
    choose(chosen)
