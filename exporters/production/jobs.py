"""The files of a build, each with all that is done to it: written, held to account, told of in the report."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import numpy as np
from msgspec.structs import replace as with_keys

from exporters.formats.registry import BOUNDS, REGISTRY, Chords, Content, Shape, declared_error
from geometry.base.findings import Finding
from geometry.base.record import Record, field, replace
from geometry.base.tolerance import LEAST_SEGMENT_MM
from parts.scene.formats import Form
from parts.scene.scene_file import ExportSpec
from parts.scene.standing import Instance

if TYPE_CHECKING:
    from exporters.verification.assembly import ExpectedAssembly
    from exporters.verification.verdict import Verdict
    from geometry.solids.body import Body
    from geometry.solids.faced import FacedBody
    from parts.base.part import Part
    from parts.scene.scene_file import SceneFile

# teeth lose their shape where the tolerance is a larger part of the module
_COARSE_SHARE = 0.05
# Open CASCADE 7.9 takes 2.5 s to read 1 200 faces of a gear, 12 s for 2 400, whoever wrote them
_MANY_FACES = 2000
# what boundaries depend on: a part's file and an assembly may share them
ShapeKey: TypeAlias = tuple[object, ...]
Made: TypeAlias = Mapping[ShapeKey, Shape]


class FileJob:
    """One file of a build: the table of the scene that asks for it, its name; what most files answer stands here.

    ``members``: the jobs of the parts in it, ``made``: their approximated boundaries.
    """

    __slots__ = ()
    export: ExportSpec
    path: str
    place: str

    @property
    def members(self) -> tuple[Job, ...]:
        """None."""
        return ()

    @property
    def tolerance(self) -> float:
        """Of all that is in it together, mm."""
        return float(self.export.tolerance or 0.0)

    @property
    def label(self) -> str:
        """What remarks on it begin with: the file."""
        return self.path

    def about(self, finding: Finding) -> Sequence[str]:
        """What a remark begins with."""
        return (self.label,)

    @property
    def told(self) -> dict[str, Any]:
        """What the report says of its content, the part first."""
        raise NotImplementedError

    @property
    def offset(self) -> float:
        """How far its boundaries are moved out of the material, mm."""
        return 0.0

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write it; counts of what is in it."""
        raise NotImplementedError

    def declared(self, made: Made) -> tuple[float, str]:
        """The bound of all that is in it, mm, and what kind of bound that is."""
        raise NotImplementedError

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """Remarks on it."""
        return ()

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back and measure; ``declared``: its bound, mm."""
        raise NotImplementedError


class PartsJob(FileJob):
    """Several parts in one file; the paths of its members' own files are not used."""

    __slots__ = ()

    @property
    def parts(self) -> dict[str, Part]:
        """Those in it, by their ids."""
        return {m.part.id: m.part for m in self.members}

    @property
    def offset(self) -> float:
        """Of every section, mm."""
        return self.members[0].section.offset

    def declared(self, made: Made) -> tuple[float, str]:
        """The worst bound of its parts, mm, and the weakest kind of bound."""
        found = [m.declared(made) for m in self.members]
        return max(error for error, _ in found), max((bound for _, bound in found), key=BOUNDS.index)

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """Remarks on the sections and meshes in it."""
        return tuple(dict.fromkeys(f for m in self.members for f in (*m.section.findings, *m.remarks(made))))

    def about(self, finding: Finding) -> Sequence[str]:
        """Of a remark on sections the parts that have them, by their names."""
        return [m.part.name for m in self.members if finding in m.section.findings] or (self.label,)


class Written(Record):
    """A file that was written and read back, with what was measured on it."""

    job: FileJob
    file: Path
    max_error: float
    bound: str
    entities: dict[str, int]
    measured: dict[str, float]
    findings: tuple[Finding, ...]
    failures: tuple[str, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)


class Job(Content, FileJob):
    """One part in one file, and where the scene asks for it; ``share``: what it may take of the tolerance there."""

    path: str
    place: str
    share: float = 1.0

    @property
    def asked(self) -> float:
        """The tolerance that the scene asks for, mm."""
        return self.tolerance / self.share

    def at(self, tolerance: float) -> Job:
        """The job at another tolerance."""
        return replace(self, export=with_keys(self.export, tolerance=tolerance))

    @property
    def label(self) -> str:
        """The part."""
        return self.part.id

    @property
    def members(self) -> tuple[Job, ...]:
        """Itself."""
        return (self,)

    @property
    def told(self) -> dict[str, Any]:
        """The part, and whether its pitch curve is there."""
        return {"part": self.part.id, **({} if self.pitch_curve is None else {"pitch_curve": True})}

    @property
    def offset(self) -> float:
        """Of the section, mm."""
        return self.section.offset

    @property
    def shape_key(self) -> ShapeKey:
        """What its boundaries depend on."""
        export, section = self.export, self.section
        # a tag beside it on a board is one more of them
        boundaries = section.region.layers()
        # of a body told by its faces every format has the same mesh
        shared = self.kind.form is Form.TRIANGLES and self.body.is_faced
        form = Form.TRIANGLES if shared else self.kind.name
        return (self.part.id, form, export.tolerance, export.curves, section.offset, boundaries, export.pitch_curve)

    def chords(self, made: Made) -> Chords:
        """Its boundaries, of a laser file or a mesh."""
        return cast("Chords", made[self.shape_key])

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write the file; counts of what is in it."""
        return REGISTRY[self.kind.name].write(self, made[self.shape_key], file)

    def declared(self, made: Made) -> tuple[float, str]:
        """The worst boundary plus the rounding of numbers, mm, and what kind of bound that is."""
        return declared_error(self, made[self.shape_key])

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """Remarks on the part, on its section, and on this file of it."""
        return tuple(dict.fromkeys((*self.part.findings, *self.section.findings, *self.remarks(made))))

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back, measure, and put it to the part's probes."""
        from exporters.verification import judge

        verdict = judge.verify_part(
            file, self.kind, self.part, self.offset, declared, self.tolerance, pitch_curve=self.pitch_curve
        )
        return judge.signed(file, self.kind, self.export.author, self.export.organisation, verdict)

    def remarks(self, made: Made) -> list[Finding]:
        """Remarks on one file: a tolerance too coarse for the teeth, edges too short for a laser."""
        part, kind = self.part, self.kind
        # a part that says itself what its flat outline lacks needs no more
        says = kind.is_solid or part.is_plate or any(f.code in ("flat_pins", "development") for f in part.flat_findings)
        found = [] if says else [Finding("flat_outline", 0.0, 0.0)]
        found += [] if kind.is_solid else part.flat_findings
        # a part without teeth has none to lose
        limit = _COARSE_SHARE * part.quantities.get("pitch", math.inf) / math.pi
        if not kind.is_cad and self.tolerance > limit:
            found.append(Finding("coarse_tolerance", self.tolerance, limit))
        if kind.form is Form.ARCS and (short := _short_edges(self.chords(made))):
            found.append(Finding("short_edges", short, LEAST_SEGMENT_MM))
        if kind.form is Form.FACES and (faces := _side_faces(self.body)) > _MANY_FACES:
            found.append(Finding("many_faces", faces, _MANY_FACES))
        return found


def _side_faces(body: Body | FacedBody) -> int:
    """How many faces stand between the end faces of a body, those of round holes apart; a barrel's are few."""
    if body.is_faced:
        return 0
    sides = [body.loop_profile(wall.lower) for wall in body.walls]
    return sum(len(p.period) * p.count for p in sides if len(p.period) > 2)


def _short_edges(chords: Chords) -> int:
    """How many edges of a laser file are too short for it."""
    contours = [a.geometry for a in chords]
    lengths = [np.abs(c.period_ends() - c.vertices) for c in contours]
    return sum(int(np.count_nonzero(x < LEAST_SEGMENT_MM)) * c.count for x, c in zip(lengths, contours, strict=True))


class AssemblyJob(Record, PartsJob):
    """All instances of some parts in one file."""

    name: str
    export: ExportSpec
    members: tuple[Job, ...]
    instances: tuple[Instance, ...]
    path: str
    place: str

    @property
    def told(self) -> dict[str, Any]:
        """The instances."""
        return {"part": None, "instances": [instance.id for instance in self.instances]}

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write one prototype per part and an occurrence of it for every instance; counts of what is in the file."""
        write = REGISTRY[self.export.kind.name].write_assembly
        assert write is not None
        places = [(i.id, i.part, i.scene_from_part, i.subassembly) for i in self.instances]
        shapes = {m.part.id: made[m.shape_key] for m in self.members}
        counts = write(self.name, self.members, shapes, places, file)
        return {**counts, "parts": len(self.members), "instances": len(self.instances)}

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """Those on its parts, and on offset parts that stand in mesh."""
        meets = self.export.offset > 0 and len(self.instances) > 1
        more = (Finding("offset_in_mesh", self.export.offset, 2 * self.export.offset),) if meets else ()
        return (*super().findings(made), *more)

    @property
    def expected(self) -> ExpectedAssembly:
        """What its file must hold."""
        from exporters.verification.assembly import ExpectedAssembly

        return ExpectedAssembly(self.name, self.parts, self.offset, self.instances)

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back and measure every part in its place."""
        from exporters.verification import judge
        from exporters.verification.assembly import verify_assembly

        kind = self.export.kind
        verdict = verify_assembly(file, kind, self.expected, declared, self.tolerance)
        return judge.signed(file, kind, self.export.author, self.export.organisation, verdict)


def several(export: ExportSpec, times: int) -> tuple[Finding, ...]:
    """What there is to tell of a board or bed that is made so many times."""
    code = "cut_several_times" if export.purpose == "board" else "printed_several_times"
    return (Finding(code, float(times), 1.0),) if times > 1 else ()


def assembly_name(scene: SceneFile) -> str:
    """A scene's name in the letters that every program reads, for the title of its assembly; no part has the same."""
    text = re.sub(r"[^A-Za-z0-9._-]", "_", scene.name)
    text = text if re.search("[A-Za-z0-9]", text) else "assembly"
    return f"{text}.assembly" if text.lower() in {part.lower() for part in scene.parts} else text
