"""How the CAD kernel is told to read STEP files: as they are, with no crossing of a wire mended for them.

The kernel's repair of self-crossing wires looks at every pair of edges, and walks through a linked list to fetch each:
cubic in the teeth, 160 of 170 s of a gear of 1 000. A read-back must not mend what it judges anyway: crossings are
found by ``BRepCheck_Analyzer`` and by our own test of the measured loops.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from exporters.readers import ReadError

_UNMENDED = ("FixShape.FixSelfIntersectionMode", "FixShape.FixIntersectingWiresMode")


_STRINGS = re.compile(rb"'[^']*'")
# what C's reader of numbers takes for one, and exponents beyond any length
_STRANGE = re.compile(rb"[(,]\s*([-+]?(?:nan|inf)[a-z]*|[-+]?[\d.]+e\+?0*[1-9]\d\d+)", re.IGNORECASE)


def check_numbers(file: Path) -> None:
    """Refuse a STEP file with a coordinate that is not a number, over which the kernel would not come to an end."""
    if found := _STRANGE.search(_STRINGS.sub(b"''", file.read_bytes())):
        raise ReadError(f"a number in the STEP file is {found[1].decode()}")


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
