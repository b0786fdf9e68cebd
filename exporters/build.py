"""Making the files of a plan: written beside, read back, measured, then moved into place together."""

from __future__ import annotations

import errno
import math
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from exporters.assembly import AssemblyJob, declared_assembly_error, write_assembly
from exporters.job import Job, Shape, Written, declared_error, number_rounding, shape_of
from exporters.plan import Plan
from exporters.preview import part_preview, scene_preview
from exporters.report import NAME, read_report, write_report
from geometry.contour import Approximation
from geometry.errors import ConvergenceError, ParameterError, ThinWallError, at_most
from geometry.findings import Finding
from geometry.tolerance import LEAST_SEGMENT_MM
from parts.schema import SceneError

if TYPE_CHECKING:
    from exporters.sheets.job import SheetJob

# teeth lose their shape where the tolerance is a larger part of the module
_COARSE_SHARE = 0.05
_STAGING = ".building-"


def build(
    plan: Plan,
    folder: Path,
    *,
    verify: bool = True,
    partial: bool = False,
    progress: Callable[[str], None] = lambda path: None,
) -> tuple[list[Written], list[Path], dict[str, Any]]:
    """Write every job, a preview of every part and the report into ``folder``; what fails its read-back stays out.

    ``partial``: keep what the report in ``folder`` says of other files of the same scene. Returns what was
    written, the previews, and what the checks found. Nothing half-written is left behind: all is made in a
    folder beside and moved
    when all is done; on any exception, an interrupt too, that folder goes.
    """
    start = time.perf_counter()
    checks = _checks(plan)
    shapes = [_shapes(job, plan.source) for job in plan.jobs]
    made = {_shape_key(job): shape for job, (shape, _) in zip(plan.jobs, shapes, strict=True)}
    for job in (member for assembly in plan.assemblies for member in assembly.members):
        if _shape_key(job) not in made:
            made[_shape_key(job)] = _shapes(job, plan.source)[0]
    with staging_folder(folder) as staging:
        written = []
        for job, shape in zip(plan.jobs, shapes, strict=True):
            progress(job.path)
            written.append(_write(job, shape, staging / job.path, plan.source, verify=verify))
        for assembly in plan.assemblies:
            progress(assembly.path)
            members = {m.part.id: made[_shape_key(m)] for m in assembly.members}
            written.append(_write_assembly(assembly, members, staging / assembly.path, plan.source, verify=verify))
        for sheet in plan.sheets:
            progress(sheet.path)
            written.append(_write_sheet(sheet, staging / sheet.path, verify=verify))
        wanted = dict.fromkeys(j.part.id for j in (*plan.jobs, *(m for a in plan.assemblies for m in a.members)))
        previews = [part_preview(plan.parts[p], staging, plan.scene.scene.language) for p in wanted]
        if len(plan.placing.instances) > 1 and len(wanted) == len(plan.parts):
            previews.append(scene_preview(plan, checks, staging))
        before = read_report(folder) if partial or any(item.failures for item in written) else None
        spent = time.perf_counter() - start
        write_report(staging / NAME, plan, written, previews, checks, spent, folder, before, partial=partial)
        names = [item.job.path for item in written if not item.failures]
        move_into(folder, staging, [*names, *(p.name for p in previews), NAME])
    return written, [folder / p.name for p in previews], checks


def _checks(plan: Plan) -> dict[str, Any]:
    """The pairs of a scene: calculated always, held against each other where the scene asks for it."""
    scene = plan.scene
    if not plan.placing.needs_check and not scene.checks.interference:
        return {}
    from exporters.check import scene_checks

    asked, language = scene.checks, scene.scene.language
    contact, transmission = asked.interference, asked.transmission_error
    return scene_checks(plan.placing, plan.parts, scene.drives, language, contact=contact, transmission=transmission)


def move_into(folder: Path, staging: Path, names: list[str]) -> None:
    """Move finished files into their place; refused before the first move where a folder stands in the way."""
    for name in names:
        if (folder / name).is_dir():
            raise IsADirectoryError(errno.EISDIR, "a folder stands where a file should go", str(folder / name))
    for name in names:
        os.replace(staging / name, folder / name)


def _shape_key(job: Job) -> tuple[object, ...]:
    """What a job's boundaries depend on: a part's file and an assembly may share them."""
    export = job.export
    return (job.part.id, export.format, export.purpose, export.tolerance, export.curves, job.section.offset)


def _shapes(job: Job, source: str) -> tuple[Shape, float]:
    """Approximated boundaries and the seconds they took; refused in the scene's terms."""
    start = time.perf_counter()
    try:
        return shape_of(job), time.perf_counter() - start
    except ParameterError as error:
        raise SceneError(source, f"{job.place}.{error.name}", error.value, error.allowed) from error
    except ConvergenceError as error:
        remedy = f"cannot be met: {error}; make it larger"
        raise SceneError(source, f"{job.place}.tolerance", job.export.tolerance, remedy) from error


def _write(job: Job, shape: tuple[Shape, float], file: Path, source: str, *, verify: bool) -> Written:
    made, spent = shape
    seconds = {"approximate": spent}
    start = time.perf_counter()
    try:
        entities = WRITERS[job.export.format](job, made, file)
    except ThinWallError as error:
        raise _too_coarse(job, source) from error
    seconds["write"] = time.perf_counter() - start
    max_error, bound = declared_error(job, made)
    findings = (*job.part.findings, *job.section.findings, *_job_findings(job, made))
    if not verify:
        return Written(job, file, max_error, bound, entities, {}, findings, (), seconds)
    from exporters.verify import verify_file

    start = time.perf_counter()
    tolerance = float(job.export.tolerance or 0.0)
    verdict = verify_file(file, job.kind, job.exact, max_error, tolerance, job.part.id)
    if job.part.is_cam:
        from exporters.reroll import reroll

        verdict, found = reroll(file, job.kind, job.part, job.section.offset, max_error, verdict)
        findings = (*findings, *found)
    seconds["verify"] = time.perf_counter() - start
    return Written(job, file, max_error, bound, entities, verdict.measured, findings, verdict.failures, seconds)


def _write_assembly(job: AssemblyJob, members: dict[str, Shape], file: Path, source: str, *, verify: bool) -> Written:
    start = time.perf_counter()
    try:
        entities = write_assembly(job, members, file)
    except ThinWallError as error:
        raise next(_too_coarse(m, source) for m in job.members if _is_thin(m, members[m.part.id])) from error
    seconds = {"write": time.perf_counter() - start}
    max_error, bound = declared_assembly_error(job, members)
    found = dict.fromkeys(f for m in job.members for f in (*m.section.findings, *_job_findings(m, members[m.part.id])))
    if job.export.offset > 0 and len(job.instances) > 1:
        found[Finding("offset_in_mesh", job.export.offset, 2 * job.export.offset)] = None
    if not verify:
        return Written(job, file, max_error, bound, entities, {}, tuple(found), (), seconds)
    from exporters.verify_assembly import expected_of, verify_assembly

    start = time.perf_counter()
    offset = job.members[0].section.offset
    expected = expected_of(job.name, {m.part.id: m.part for m in job.members}, offset, job.instances)
    tolerance = float(job.export.tolerance or 0.0)
    verdict = verify_assembly(file, job.export.format, expected, max_error, tolerance)
    seconds["verify"] = time.perf_counter() - start
    return Written(job, file, max_error, bound, entities, verdict.measured, tuple(found), verdict.failures, seconds)


def _is_thin(job: Job, made: Any) -> bool:
    from parts.solids import body_mesh

    try:
        body_mesh(job.body, made)
    except ThinWallError:
        return True
    return False


def _too_coarse(job: Job, source: str) -> SceneError:
    """The refusal of a tolerance whose chords cross a thin wall, with the nearest one that works, if any does."""
    from parts.solids import body_mesh, mesh_outlines

    tolerance = float(job.export.tolerance or 0.0)
    place, why = f"{job.place}.tolerance", f"its chords cross a thin wall of {job.part.id}"
    finer = tolerance / 2
    while finer >= 8 * number_rounding(job):
        try:
            body_mesh(job.body, mesh_outlines(job.body, finer - number_rounding(job), 64 * number_rounding(job)))
        except ThinWallError:
            finer /= 2
            continue
        return SceneError(source, place, tolerance, f"{why}; at most {at_most(finer, 9)} mm works")
    text = f"{why}, too thin for the digits of a mesh file; make the wall thicker, or write STEP"
    return SceneError(source, place, tolerance, text)


def _write_sheet(job: SheetJob, file: Path, *, verify: bool) -> Written:
    start = time.perf_counter()
    entities = job.write(file)
    seconds = {"write": time.perf_counter() - start}
    max_error, bound = job.declared
    if not verify:
        return Written(job, file, max_error, bound, entities, {}, (), (), seconds)
    start = time.perf_counter()
    verdict = job.verify(file)
    seconds["verify"] = time.perf_counter() - start
    return Written(job, file, max_error, bound, entities, verdict.measured, (), verdict.failures, seconds)


def _write_dxf(job: Job, made: Any, file: Path) -> dict[str, int]:
    if job.is_cad:
        from exporters.drawing import write_drawing_dxf

        return write_drawing_dxf(file, made)
    from exporters.dxf import write_laser_dxf

    return write_laser_dxf(file, job.layer_order, made, version=job.export.dxf_version)


def _write_svg(job: Job, made: Any, file: Path) -> dict[str, int]:
    from exporters.svg import write_laser_svg

    return write_laser_svg(file, job.layer_order, made)


def _write_stl(job: Job, made: Any, file: Path) -> dict[str, int]:
    from exporters.stl import write_stl
    from parts.solids import body_mesh

    return write_stl(file, body_mesh(job.body, made))


def _write_3mf(job: Job, made: Any, file: Path) -> dict[str, int]:
    from exporters.threemf import write_3mf
    from parts.solids import body_mesh

    return write_3mf(file, job.part.id, body_mesh(job.body, made), job.part.colour)


def _write_step(job: Job, made: Any, file: Path) -> dict[str, int]:
    from exporters.step import write_step
    from parts.brep import body_solid

    return write_step(file, job.part.id, body_solid(job.body, made), job.part.colour)


WRITERS: dict[str, Callable[[Job, Any, Path], dict[str, int]]] = {
    "dxf": _write_dxf,
    "svg": _write_svg,
    "stl": _write_stl,
    "3mf": _write_3mf,
    "step": _write_step,
}


def _job_findings(job: Job, made: Shape) -> list[Finding]:
    """Remarks on one file: a tolerance too coarse for the teeth, edges too short for a laser."""
    # a part that says itself what its flat outline lacks needs no more
    says = job.is_solid or job.part.is_plate or any(f.code == "flat_pins" for f in job.part.flat_findings)
    found = [] if says else [Finding("flat_outline", 0.0, 0.0)]
    found += [] if job.is_solid else job.part.flat_findings
    # a part without teeth has none to lose
    limit = _COARSE_SHARE * job.part.quantities.get("pitch", math.inf) / math.pi
    if not job.is_cad and (job.export.tolerance or 0.0) > limit:
        found.append(Finding("coarse_tolerance", float(job.export.tolerance or 0.0), limit))
    if not job.is_mesh and not job.is_cad:
        short = sum(
            int(np.count_nonzero(np.abs(a.geometry.period_ends() - a.geometry.vertices) < LEAST_SEGMENT_MM))
            * a.geometry.count
            for a in made
            if isinstance(a, Approximation)
        )
        if short:
            found.append(Finding("short_edges", short, LEAST_SEGMENT_MM))
    return found


@contextmanager
def staging_folder(folder: Path) -> Iterator[Path]:
    """A folder beside ``folder`` that is gone afterwards; ``folder`` itself goes too if nothing came into it."""
    created = missing_folders(folder)
    staging = folder / f"{_STAGING}{os.getpid()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        remove_stale(folder)
        staging.mkdir()
        yield staging
    finally:
        _remove(staging)
        remove_empty(created)


def missing_folders(folder: Path) -> list[Path]:
    """A folder and those above it that do not exist yet, the innermost first."""
    return [p for p in (folder, *folder.parents) if not p.exists()]


def remove_stale(folder: Path) -> None:
    """Remove what builds that were killed have left half-written in a folder."""
    for stale in folder.glob(f"{_STAGING}*"):
        if not _is_running(stale.name.removeprefix(_STAGING)):
            _remove(stale)


def remove_empty(created: list[Path]) -> None:
    """Remove those folders, the innermost first, that nothing came into."""
    for place in created:
        if place.is_dir() and not any(place.iterdir()):
            place.rmdir()


def _remove(staging: Path) -> None:
    if staging.is_dir():
        for file in staging.iterdir():
            file.unlink()
        staging.rmdir()


def _is_running(process: str) -> bool:
    """Whether a process may still be at work; only a POSIX system can be asked without harm."""
    if os.name != "posix" or not process.isdigit():
        return True
    try:
        os.kill(int(process), 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return int(process) != os.getpid()
