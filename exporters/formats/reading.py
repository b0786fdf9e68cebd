"""The reader of each kind of file (parts/scene/formats.py), imported when a file of its kind is there.

None of them shares code with a writer.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from parts.base.lazy import Registry

if TYPE_CHECKING:
    from exporters.formats.read_assembly import ReadAssembly
    from parts.base.readback import ReadBack

_HERE = "exporters.formats"
READERS: Registry[Callable[[Path], ReadBack]] = Registry(
    {
        "dxf": f"{_HERE}.read_dxf:read_dxf",
        "drawing": f"{_HERE}.read_drawing:read_drawing",
        "svg": f"{_HERE}.read_svg:read_svg",
        "stl": f"{_HERE}.read_stl:read_stl",
        "3mf": f"{_HERE}.read_3mf:read_3mf",
        "step": f"{_HERE}.read_step:read_step",
    }
)
ASSEMBLY_READERS: Registry[Callable[[Path], ReadAssembly]] = Registry(
    {"3mf": f"{_HERE}.read_3mf:read_3mf_assembly", "step": f"{_HERE}.read_step:read_step_assembly"}
)
