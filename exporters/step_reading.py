"""How the CAD kernel is told to read STEP files: as they are, with no crossing of a wire mended for them.

The kernel's repair of self-crossing wires looks at every pair of edges, and walks through a linked list to fetch each:
cubic in the teeth, 160 of 170 s of a gear of 1 000. A read-back must not mend what it judges anyway: crossings are
found by ``BRepCheck_Analyzer`` and by our own test of the measured loops.
"""

from __future__ import annotations

from typing import Any

_UNMENDED = ("FixShape.FixSelfIntersectionMode", "FixShape.FixIntersectingWiresMode")


def leave_crossings(reader: Any) -> None:
    """Tell a reader (STEPControl_Reader or STEPCAFControl_Reader) to mend no crossing; after its file is read.

    Before version 7.9 the kernel takes this from files of its own only: there it reads as it always did, slowly.
    """
    if not hasattr(reader, "SetShapeFixParameters"):
        return
    from OCP.Resource import Resource_DataMapOfAsciiStringAsciiString
    from OCP.TCollection import TCollection_AsciiString

    chosen = Resource_DataMapOfAsciiStringAsciiString()
    for key in _UNMENDED:
        chosen.Bind(TCollection_AsciiString(key), TCollection_AsciiString("0"))
    reader.SetShapeFixParameters(chosen)
