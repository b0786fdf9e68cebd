"""The tables of a scene file that are of no kind, and a scene as resolved."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

import msgspec
from msgspec import Meta, Struct

from parts.base.texts import ENGLISH, languages
from parts.keys.base import Identifier, mm
from parts.keys.boards import PURPOSES_LAID, BedSpec, BoardSpec, Kerf
from parts.keys.sheet import CamSpeed, CellsKey, Intervals, MateNumber, PaperKey, RackStep, ScaleKey
from parts.keys.title import TitleBlockKey
from parts.keys.working import WorkingTable
from parts.scene.formats import FORMATS, PURPOSES, FileKind, file_kind, tolerances_of
from parts.scene.instances import DriveSpec, InstanceSpec
from parts.scene.steps import StepSpec

# the languages that have a catalogue, and what exports may be
if TYPE_CHECKING:
    Language = str
    Format = str
    Purpose = str
else:
    Language, Format, Purpose = Literal[languages()], Literal[FORMATS], Literal[PURPOSES]


_NOTES = Meta(
    max_length=50,
    description="how to put together and use what is made, a paragraph each: SCENE.notes.txt",
    examples=[["Glue the crank to the shaft."]],
)


class SceneInfo(Struct, forbid_unknown_fields=True):
    """Keys of ``[scene]``."""

    title: Annotated[str, Meta(max_length=500, description="what the scene shows")] = ""
    language: Annotated[Language, Meta(description="language of reports")] = ENGLISH
    notes: Annotated[list[Annotated[str, Meta(pattern=r"\S", max_length=2000)]], _NOTES] = []


_FORMAT = Meta(
    description="file format; sheet: DXF and SVG of a drawing; motion, glb: what the drives move, as an "
    "animated SVG, and its solids as glTF; csv: the parts list",
    examples=["dxf"],
)
_PURPOSE = Meta(
    description="dxf: laser (arcs) or drawing (splines); dxf, svg: board (all flat parts laid on boards); "
    "3mf: plate (all parts laid on beds); sheet, pdf: meshing (picture of each pair), "
    "generating (device TMM-42), cam (diagrams, least radius, profile), train (scheme, plans of "
    "velocities) or parts_list (GOST 2.106); pdf: model (outlines 1:1 on sheets to be glued together); "
    "dxf, svg, pdf: part (working drawing of each part) or assembly (drawing of the whole scene)",
    examples=["laser"],
)
_TOLERANCE = mm("largest deviation from the exact curve", least=1e-7, most=1.0, example=0.005)
_PARTS = Meta(min_length=1, description="parts to export; default: all", examples=[["gear"]])
_PITCH_CURVE = Meta(
    description='dxf with purpose = "drawing": the path of the follower\'s centre too, on the layer PITCH_CURVE'
)
_OFFSET = mm("moves every outline: positive out of the material, negative into it", least=-10, most=10)
_DXF_VERSION = Meta(description="dxf for a laser; drawings are always R2010")
_CURVES = Meta(description='dxf, svg: arcs, or straight lines only; purpose = "drawing" has true splines')


class ExportSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[[exports]]``."""

    format: Annotated[Format, _FORMAT]
    purpose: Annotated[Purpose, _PURPOSE] | None = None
    tolerance: Annotated[float, _TOLERANCE] | None = None
    kerf: Kerf = 0.0
    offset: Annotated[float, _OFFSET] = 0.0
    curves: Annotated[Literal["arcs", "lines"], _CURVES] = "arcs"
    dxf_version: Annotated[Literal["R2000", "R12"], _DXF_VERSION] = "R2000"
    name: Annotated[Identifier, Meta(examples=["laser"])] | None = None
    parts: Annotated[list[str], _PARTS] | None = None
    assembly: Annotated[bool, Meta(description="step, 3mf: one file of all instances in their places")] = False
    pitch_curve: Annotated[bool, _PITCH_CURVE] = False
    author: Annotated[str, Meta(max_length=200, description="step: the author, for its header")] = ""
    organisation: Annotated[str, Meta(max_length=200, description="step: school, group or firm, for its header")] = ""
    shared: Annotated[bool, Meta(description="step: equal surfaces are written once; false: one for each face")] = True
    rack_step: RackStep | None = None
    intervals: Intervals | None = None
    speed_rpm: CamSpeed | None = None
    cells: CellsKey = "numbers"
    title_block: TitleBlockKey = False
    mate: MateNumber | None = None
    paper: PaperKey | None = None
    scale: ScaleKey | None = None
    drawing: WorkingTable | None = None

    @property
    def kind(self) -> FileKind:
        """The kind of file that its format and purpose ask for."""
        return file_kind(self.format, self.purpose)

    @property
    def is_laid(self) -> bool:
        """Whether the parts lie on boards or beds in its files."""
        return self.purpose in PURPOSES_LAID.values()


_WORKSPACE = Meta(
    ge=1,
    le=100_000,
    description=(
        "with interference: checks the solids at all positions of each drive by itself, in at most "
        "this many poses a pair"
    ),
    examples=[400],
)


class ChecksSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[checks]``."""

    interference: Annotated[bool, Meta(description="contact and interference of every mate")] = False
    workspace: Annotated[int, _WORKSPACE] | None = None
    transmission_error: Annotated[
        bool, Meta(description="transmission error of each mate: peak to peak from the exact contact, without load")
    ] = False


class SceneFile(Struct, forbid_unknown_fields=True):
    """A scene as resolved: what ``report.json`` keeps and ``verify`` builds again.

    ``origins``: for places that the file does not have, since a group was told out, those that it has; ``typed``: the
    tables of a scene with assemblies before these were told out.
    """

    name: str
    scene: SceneInfo
    parts: dict[str, Any]
    exports: list[ExportSpec]
    instances: dict[str, InstanceSpec] = {}
    mates: list[Any] = []
    drives: list[DriveSpec] = []
    checks: ChecksSpec = msgspec.field(default_factory=ChecksSpec)
    boards: dict[str, BoardSpec] = {}
    beds: dict[str, BedSpec] = {}
    steps: list[StepSpec] = []
    origins: dict[str, str] = {}
    typed: dict[str, Any] = {}


def default_export(name: str) -> ExportSpec:
    """An export of a format with its default purpose and tolerance."""
    purpose, tolerance = next(iter(tolerances_of(name).items()))
    return msgspec.convert({"format": name, "purpose": purpose, "tolerance": tolerance}, ExportSpec)
