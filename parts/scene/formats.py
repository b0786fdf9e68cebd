"""The kinds of files that an export may ask for, a row each: what they hold, what for, how near to the exact curve.

How they are written and read stands in exporters/formats/registry.py, a row each likewise.
"""

from __future__ import annotations

from enum import Enum

from geometry.base.record import Record
from parts.keys.sheet import WORKING


class Form(Enum):
    """What the geometry of a file is made of."""

    ARCS = "lines and arcs"
    SPLINES = "curves of a drawing"
    TRIANGLES = "a mesh, with coordinates as float32"
    FACES = "faces between shared edges"
    SHEET = "a drawing on paper, with words"


class FileKind(Record):
    """One kind of file; ``format``: its word in scenes, and its ending.

    ``tolerances``: the purposes, the default first, each with the tolerance (mm) of an export that names none.
    ``assembly``: it can hold parts in their places.
    """

    name: str
    format: str
    form: Form
    tolerances: dict[str, float]
    assembly: bool = False

    @property
    def is_solid(self) -> bool:
        """Whether it holds a solid, not a flat outline."""
        return self.form in (Form.TRIANGLES, Form.FACES)

    @property
    def is_cad(self) -> bool:
        """Whether it holds the curves themselves, as splines: it is for looking at, not for cutting or printing."""
        return self.form in (Form.SPLINES, Form.FACES, Form.SHEET)


# purposes of sheets, the default first
_SHEETS = ("meshing", "generating", "cam", "train", "parts_list")
FILE_KINDS = {
    kind.name: kind
    for kind in (
        FileKind("dxf", "dxf", Form.ARCS, {"laser": 0.005, "board": 0.005}),
        FileKind("svg", "svg", Form.ARCS, {"laser": 0.005, "board": 0.005}),
        FileKind("stl", "stl", Form.TRIANGLES, {"print": 0.01}),
        FileKind("3mf", "3mf", Form.TRIANGLES, {"print": 0.01, "plate": 0.01}, assembly=True),
        FileKind("drawing", "dxf", Form.SPLINES, {"drawing": 1e-6}),
        FileKind("step", "step", Form.FACES, {"model": 1e-6}, assembly=True),
        FileKind("sheet", "sheet", Form.SHEET, dict.fromkeys(_SHEETS, 1e-6)),
        FileKind("part_dxf", "dxf", Form.SHEET, dict.fromkeys(WORKING, 1e-6)),
        FileKind("part_svg", "svg", Form.SHEET, dict.fromkeys(WORKING, 1e-6)),
        FileKind("pdf", "pdf", Form.SHEET, {"model": 1e-3, **dict.fromkeys((*_SHEETS, *WORKING), 2e-4)}),
        FileKind("motion", "motion", Form.SHEET, {"animation": 0.02}),
        FileKind("glb", "glb", Form.SHEET, {"animation": 0.02}),
        FileKind("csv", "csv", Form.SHEET, {"parts_list": 1e-6}),
    )
}
# of a whole scene: what drives move, in a plane and in space; its parts list
OF_SCENES = ("motion", "glb", "csv")
# the words of scenes
FORMATS = tuple(dict.fromkeys(kind.format for kind in FILE_KINDS.values()))
PURPOSES = tuple(dict.fromkeys(purpose for kind in FILE_KINDS.values() for purpose in kind.tolerances))
ASSEMBLY_FORMATS = tuple(sorted((kind.format for kind in FILE_KINDS.values() if kind.assembly), reverse=True))


def tolerances_of(name: str) -> dict[str, float]:
    """The purposes of a format, the default first, and their tolerances, mm."""
    return {p: t for kind in FILE_KINDS.values() if kind.format == name for p, t in kind.tolerances.items()}


def file_kind(name: str, purpose: str | None) -> FileKind:
    """The kind of file that a format and a purpose (None: the default one) ask for; KeyError where there is none."""
    for kind in FILE_KINDS.values():
        if kind.format == name and (purpose is None or purpose in kind.tolerances):
            return kind
    raise KeyError(f"format {name} for {purpose}")
