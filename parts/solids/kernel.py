"""What reading and measuring with the CAD kernel have in common."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from importlib.util import find_spec
from io import BytesIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS_Edge, TopoDS_Face, TopoDS_Shape


@cache
def has_kernel() -> bool:
    """Whether it is installed and loads: where the system has no OpenGL it does not."""
    if find_spec("OCP") is None:
        return False
    try:
        import OCP  # noqa: F401
    except ImportError:
        return False
    return True


def faces_of(shape: TopoDS_Shape) -> Iterator[TopoDS_Face]:
    """The faces of a shape."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    return (TopoDS.Face_s(face) for face in explored(shape, TopAbs_ShapeEnum.TopAbs_FACE))


def edges_of(shape: TopoDS_Shape) -> Iterator[TopoDS_Edge]:
    """The edges of a shape; one between two faces of it comes twice."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    return (TopoDS.Edge_s(edge) for edge in explored(shape, TopAbs_ShapeEnum.TopAbs_EDGE))


def explored(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> Iterator[TopoDS_Shape]:
    """What a shape has of a kind, one after the other."""
    from OCP.TopExp import TopExp_Explorer

    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


class KernelError(Exception):
    """What the kernel says of what it cannot do."""


@contextmanager
def kernel_errors() -> Iterator[None]:
    """The kernel's own errors, which have no type in common.

    Raises
    ------
    KernelError
        In place of each.
    """
    try:
        yield
    except Exception as error:
        if type(error).__module__.partition(".")[0] != "OCP":
            raise
        raise KernelError(str(error)) from error


def solids_of(text: str) -> list[TopoDS_Shape]:
    """The solids of a STEP file's text, each in its place; none of what is no STEP file."""
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_ShapeEnum

    with silent_kernel():
        reader = STEPControl_Reader()
        status = reader.ReadStream("part.step", BytesIO(text.encode("ascii")))
        if status != IFSelect_ReturnStatus.IFSelect_RetDone or not reader.TransferRoots():
            return []
        return list(explored(reader.OneShape(), TopAbs_ShapeEnum.TopAbs_SOLID))


def volume_of(solids: Sequence[TopoDS_Shape], exact: float, share: float) -> float:
    """The volume of solids, mm^3: by the kernel's quick rule, or where that is off ``exact`` by a share, its slow one.

    That halves its pieces until a tenth of the share is left, and takes minutes for leaning splines.
    """
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    found = 0.0
    for measure in (
        BRepGProp.VolumeProperties_s,
        lambda solid, properties: BRepGProp.VolumePropertiesGK_s(solid, properties, share / 10),
    ):
        properties = [GProp_GProps() for _ in solids]
        for solid, own in zip(solids, properties, strict=True):
            measure(solid, own)
        found = sum(float(own.Mass()) for own in properties)
        if abs(found / exact - 1) <= share:
            break
    return found


@contextmanager
def silent_kernel() -> Iterator[None]:
    """The kernel prints what it thinks of a file; its printers are taken away while it works."""
    from OCP.Message import Message

    messenger = Message.DefaultMessenger_s()
    printers = list(messenger.Printers())
    messenger.ChangePrinters().Clear()
    try:
        yield
    finally:
        for printer in printers:
            messenger.AddPrinter(printer)
