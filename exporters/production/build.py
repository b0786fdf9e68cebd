"""Making the files of a plan: written beside, read back, measured, then moved into place together."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from functools import partial
from pathlib import Path
from typing import Any

from exporters.formats.registry import Chords, Shape, least_tolerance, mesh_tolerance, number_rounding, shape_of
from exporters.production.check_lines import has_bad_verdict, names_of
from exporters.production.jobs import AssemblyJob, FileJob, Job, Made, ShapeKey, Written
from exporters.production.moving import alone_in, move_into, staging_folder
from exporters.production.plan import Plan
from exporters.production.preview import outlines_of, part_preview, scene_preview
from exporters.production.report import NAME, whole_report, write_report
from exporters.verification.verdict import Verdict
from geometry.base.errors import ConvergenceError, Nearest, ParameterError, ThinWallError, rounded
from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from geometry.plane.contour import Approximation
from parts.base.refusal import SceneError, placed
from parts.scene.formats import Form

# the least that an export may have, mm
_LEAST_TOLERANCE = 1e-7
# of a tolerance, in search of one that works
_MOST_HALVINGS = 8


class Built(Record):
    """What was written and found; ``left_behind``: files of earlier builds that this one does not make."""

    written: tuple[Written, ...]
    previews: tuple[Path, ...]
    checks: dict[str, Any]
    left_behind: tuple[Path, ...]

    @property
    def well(self) -> bool:
        """Whether every file passed its read-back, and no check failed."""
        return not has_bad_verdict(self.checks) and not any(item.failures for item in self.written)


def build(
    plan: Plan,
    folder: Path,
    *,
    verify: bool = True,
    kernel: bool = False,
    partial: bool = False,
    progress: Callable[[str], None] = lambda path: None,
) -> Built:
    """Write every job, a preview of every part and the report into ``folder``; what fails its read-back stays out.

    ``partial``: keep what the report in ``folder`` says of other files of the same scene. Nothing half-written is left
    behind: see ``moving.py``. ``kernel``: STEP files are held against the CAD kernel too.
    """
    start = time.perf_counter()
    progress(plan.scene.name)
    checks = _checks(plan)
    made: dict[ShapeKey, Shape] = {}
    spent: dict[str, float] = {}
    shapes = _shapes(plan)
    for key, job in shapes.items():
        progress(job.part.id)
        made[key], seconds = approximated(job, plan.source, shapes.values())
        spent.setdefault(job.path, seconds)
    with staging_folder(folder) as staging:
        written: list[Written] = []
        for file_job in plan.files:
            progress(file_job.path)
            written.append(_write(file_job, made, staging / file_job.path, plan.source, verify=verify))
            if kernel and verify:
                written[-1] = _by_kernel_too(written[-1])
            if file_job.path in spent:
                written[-1].seconds["approximate"] = spent[file_job.path]
        progress(plan.scene.name)
        previews = _previews(plan, checks, staging)
        names = [item.job.path for item in written if not item.failures]
        with alone_in(folder):
            before = whole_report(folder)
            seconds = time.perf_counter() - start
            report = staging / NAME
            left = write_report(report, plan, written, previews, checks, seconds, folder, before, partial=partial)
            move_into(folder, staging, [*names, *(p.name for p in previews), NAME])
    return Built(
        tuple(written), tuple(folder / p.name for p in previews), checks, tuple(folder / name for name in left)
    )


def _previews(plan: Plan, checks: dict[str, Any], staging: Path) -> list[Path]:
    """Pictures of every part that is made, of the whole, of boards and beds; how it is made and used."""
    wanted = dict.fromkeys(j.part.id for j in (*plan.jobs, *(m for a in plan.assemblies for m in a.members)))
    outlines = {p: outlines_of(plan.parts[p].section(0.0).region) for p in wanted}
    previews = [part_preview(plan.parts[p], o, staging, plan.scene.scene.language) for p, o in outlines.items()]
    laid = any(assembly.export.is_laid for assembly in plan.assemblies)
    others = {key: part for key, part in plan.parts.items() if key not in wanted}
    # rods that are cut to length, and what boards and plates have no room for, belong to the model all the same
    if len(plan.placing.instances) > 1 and (laid or all(part.stock for part in others.values())):
        rest = {key: outlines_of(part.section(0.0).region) for key, part in others.items()}
        previews.append(scene_preview(plan, {**outlines, **rest}, checks, staging))
        if plan.scene.steps:
            from exporters.production.exploded_preview import exploded_preview

            previews.append(exploded_preview(plan, staging))
    if laid:
        from exporters.production.laid_preview import laid_previews

        previews += laid_previews(plan, staging)
    if laid or plan.scene.scene.notes or plan.scene.steps:
        from exporters.production.notes import write_notes

        previews.append(write_notes(plan, staging))
    return previews


def _checks(plan: Plan) -> dict[str, Any]:
    """The pairs of a scene: calculated always, held against each other where the scene asks for it."""
    scene = plan.scene
    if not plan.placing.needs_check and not scene.checks.interference:
        return {}
    from exporters.production.check import scene_checks

    asked, language = scene.checks, scene.scene.language
    contact, transmission = asked.interference, asked.transmission_error
    return scene_checks(
        plan.placing,
        plan.parts,
        scene.drives,
        language,
        contact=contact,
        transmission=transmission,
        workspace=scene.checks.workspace,
        names=names_of(scene.instances, plan.parts),
    )


def steps(plan: Plan) -> int:
    """How many steps a build tells: its checks, every shape, every file, the pictures."""
    return 2 + len(_shapes(plan)) + len(plan.files)


def _shapes(plan: Plan) -> dict[ShapeKey, Job]:
    """The first job of each shape, those of files of their own before what only assemblies and films have."""
    jobs = (*plan.jobs, *(member for several in (*plan.assemblies, *plan.sheets) for member in several.members))
    found: dict[ShapeKey, Job] = {}
    for job in jobs:
        found.setdefault(job.shape_key, job)
    return found


def approximated(job: Job, source: str, beside: Collection[Job]) -> tuple[Shape, float]:
    """Approximated boundaries and the seconds they took; refused in the scene's terms, for all jobs ``beside`` it."""
    start = time.perf_counter()
    try:
        return shape_of(job), time.perf_counter() - start
    except ParameterError as error:
        raise placed(source, job.place, _for_every_part(error, job, beside), "mm") from error
    except ConvergenceError as error:
        place, said = f"{job.place}.tolerance", {"residual": error.residual, "steps": error.iterations}
        raise SceneError(source, place, job.asked, "tolerance_not_met", None, "", **said) from error
    except ThinWallError as error:
        raise _refused(job, source, "wall_too_thin_for_mesh") from error


def _for_every_part(refusal: ParameterError, job: Job, beside: Collection[Job]) -> ParameterError:
    """The refusal of a tolerance as the scene asks for it, with what serves every part that it is asked for."""
    if refusal.code != "finer_than_mesh_digits":
        return refusal
    every = [other for other in beside if other.place == job.place and other.kind.form is job.kind.form]
    try:
        least = max(least_tolerance(other) / other.share for other in every)
    except ParameterError:
        # another part has no solid at this offset, of which it tells when it is the first
        return refusal
    found = partial(mesh_tolerance, [(other, other.share) for other in every], least, job.asked)
    return ParameterError(refusal.name, job.asked, refusal.code, found)


def _write(job: FileJob, made: Made, file: Path, source: str, *, verify: bool) -> Written:
    start = time.perf_counter()
    try:
        entities = job.write(made, file)
    except ThinWallError as error:
        raise next(_too_coarse(m, source) for m in job.members if _is_thin(m, partial(m.chords, made))) from error
    seconds = {"write": time.perf_counter() - start}
    max_error, bound = job.declared(made)
    findings = job.findings(made)
    # numbers of films have few bits
    if max_error > job.tolerance:
        findings = (*findings, Finding("coarser_than_asked", max_error, job.tolerance))
    if not verify:
        return Written(job, file, max_error, bound, entities, {}, findings, (), seconds)
    start = time.perf_counter()
    verdict = job.verify(file, max_error)
    seconds["verify"] = time.perf_counter() - start
    if verdict.failures and (crossed := next((m for m in job.members if _is_crossed(m, made[m.shape_key])), None)):
        raise _crossing(crossed, source)
    findings = (*findings, *verdict.findings)
    return Written(job, file, max_error, bound, entities, verdict.measured, findings, verdict.failures, seconds)


def _by_kernel_too(item: Written) -> Written:
    """A good STEP file, held against the CAD kernel as well."""
    bodies = {m.part.id: m.body for m in item.job.members if m.kind.form is Form.FACES}
    if item.failures or not bodies:
        return item
    from exporters.verification.kernel import judged_by_kernel

    stood = item.job.instances if isinstance(item.job, AssemblyJob) else ()
    solids = [bodies[i.part] for i in stood] or list(bodies.values())
    verdict = judged_by_kernel(item.file, solids, Verdict(item.measured, ()))
    return replace(item, measured=verdict.measured, failures=verdict.failures)


def _is_thin(job: Job, made: Callable[[], Chords]) -> bool:
    from parts.solids.mesh import body_mesh

    try:
        body_mesh(job.body, made())
    except ThinWallError:
        return True
    return False


def _too_coarse(job: Job, source: str) -> SceneError:
    """The refusal of a tolerance whose chords cross a thin wall, with the nearest one that works, if any does."""
    from parts.solids.mesh import mesh_outlines

    def crosses(finer: float) -> bool:
        rounding = number_rounding(job)
        return _is_thin(job, lambda: mesh_outlines(job.body, finer - rounding, 64 * rounding))

    works = _finer(job, crosses)
    return _refused(job, source, "wall_too_thin_for_mesh" if works is None else "chords_cross_wall", works)


def _refused(job: Job, source: str, code: str, works: Nearest | None = None) -> SceneError:
    """The refusal of the tolerance that a part is asked for with."""
    return SceneError(source, f"{job.place}.tolerance", job.asked, code, works, "mm", part=job.part.id)


def _is_crossed(job: Job, made: Shape) -> bool:
    """Whether a flat outline of arcs and lines crosses itself before it is written."""
    from exporters.verification.outlines import is_crossed

    if job.kind.form is not Form.ARCS:
        return False
    return any(is_crossed(one.geometry) for one in made if isinstance(one, Approximation))


def _crossing(job: Job, source: str) -> SceneError:
    """The refusal of a tolerance at which an outline crosses itself: a part of it is smaller than that."""

    def crosses(finer: float) -> bool:
        tried = job.at(finer)
        return _is_crossed(tried, shape_of(tried))

    return _refused(job, source, "outline_crosses_itself", _finer(job, crosses))


def _finer(job: Job, fails: Callable[[float], bool]) -> Nearest | None:
    """The first half, quarter ... of the tolerance that does not fail, mm."""
    for halvings in range(1, _MOST_HALVINGS + 1):
        finer = job.tolerance / 2**halvings
        if finer < max(8 * number_rounding(job), _LEAST_TOLERANCE):
            return None
        if not fails(finer):
            return Nearest(rounded(finer / job.share, up=False, digits=9), "at_most")
    return None
