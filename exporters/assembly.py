"""Assembly files: one prototype per part, one occurrence of it for every instance, in its place."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from exporters.job import Job, Shape, declared_error
from parts.placing import Instance
from parts.scene import ExportSpec


@dataclass(frozen=True, slots=True)
class AssemblyJob:
    """All instances of some parts in one file; ``members`` are the jobs of its parts, whose own paths are not used."""

    name: str
    export: ExportSpec
    members: tuple[Job, ...]
    instances: tuple[Instance, ...]
    path: str
    place: str


def assembly_name(scene: str) -> str:
    """A scene's name in the letters that every program reads, for the title of its assembly."""
    text = re.sub(r"[^A-Za-z0-9._-]", "_", scene)
    return text if re.search("[A-Za-z0-9]", text) else "assembly"


def write_assembly(job: AssemblyJob, shapes: dict[str, Shape], file: Path) -> dict[str, int]:
    """Write an assembly from the approximated boundaries of its parts, by part; counts of what is in the file."""
    places = [(i.id, i.part, i.scene_from_part) for i in job.instances]
    if job.export.format == "step":
        from exporters.step import StepPart, write_step_assembly
        from parts.brep import body_solid

        outlines: Any = shapes
        solids = [StepPart(m.part.id, body_solid(m.body, outlines[m.part.id]), m.part.colour) for m in job.members]
        counts = write_step_assembly(file, job.name, solids, places)
    else:
        from exporters.threemf import MeshPart, write_3mf_assembly
        from parts.solids import body_mesh

        chords: Any = shapes
        meshes = [MeshPart(m.part.id, body_mesh(m.body, chords[m.part.id]), m.part.colour) for m in job.members]
        counts = write_3mf_assembly(file, job.name, meshes, places)
    return {**counts, "parts": len(job.members), "instances": len(job.instances)}


def declared_assembly_error(job: AssemblyJob, shapes: dict[str, Shape]) -> tuple[float, str]:
    """The worst bound of its parts, mm, and the weakest kind of bound."""
    found = [declared_error(m, shapes[m.part.id]) for m in job.members]
    order = ("exact", "certified", "sampled")
    return max(error for error, _ in found), max((bound for _, bound in found), key=order.index)
