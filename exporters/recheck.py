"""``higherpair verify``: files on disk against the part that the report beside them names."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from exporters.assembly import assembly_name
from exporters.job import SOLID_FORMATS
from exporters.kept import refusal_of
from exporters.read_dxf import audited
from exporters.readers import ReadError
from exporters.report import NAME, read_report
from exporters.verify import Verdict, verify_file
from geometry.errors import GeometryError
from parts.placing import place
from parts.scene import ASSEMBLY_FORMATS, FORMATS, SceneFile, make_parts, scene_from_resolved
from parts.schema import SceneError


@dataclass(frozen=True, slots=True)
class Recheck:
    """The verdict on one file; ``same_bytes``: it is the very file that was reported."""

    file: Path
    verdict: Verdict
    declared: float
    tolerance: float
    same_bytes: bool


def recheck(file: Path) -> Recheck:
    """Hold one file against its report; a preview is only compared byte by byte.

    Raises
    ------
    SceneError
        There is no such file, or no report that knows it.
    """
    if not file.is_file():
        raise SceneError(
            str(file),
            "",
            None,
            "no such file: it is a folder; name the files in it" if file.is_dir() else "no such file",
        )
    source = str(file.parent / NAME)
    if not (file.parent / NAME).is_file():
        raise SceneError(str(file), "", None, f"no {NAME} beside it; build the scene again to get one")
    report = read_report(file.parent)
    try:
        if report is None:
            raise TypeError("it is not the JSON of a report")
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        previews = {entry["path"]: entry["sha256"] for entry in report["previews"]}
        if file.name in previews:
            same = digest == previews[file.name]
            return Recheck(file, Verdict({}, () if same else ("the preview has been changed",)), 0.0, 0.0, same)
        entries = {entry["path"]: entry for entry in report["files"]}
        if file.name in entries:
            return _against(file, source, report, entries[file.name], digest)
        refusal = refusal_of(report, file.name)
    except (KeyError, TypeError, AttributeError, ArithmeticError, RecursionError, GeometryError) as error:
        raise SceneError(source, "", None, f"is damaged ({error}); build the scene again") from error
    except ValueError as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(source, "", None, f"is damaged ({error}); build the scene again") from error
    if refusal is not None:
        raise SceneError(str(file), "", None, refusal)
    raise SceneError(str(file), "", None, f"not named in {NAME}; it knows: {', '.join(map(str, entries)) or 'no file'}")


def _against(file: Path, source: str, report: dict[str, Any], entry: dict[str, Any], digest: str) -> Recheck:
    scene = scene_from_resolved(report["scene"], source)
    if entry["format"] == "sheet":
        return _against_sheet(file, source, scene, entry, digest)
    if entry["part"] is None:
        return _against_assembly(file, source, scene, entry, digest)
    part = make_parts(scene, source)[0][entry["part"]]
    offset = float(entry["offset"])
    declared, tolerance, kind = float(entry["max_error"]), float(entry["tolerance"]), entry["format"]
    if kind not in FORMATS:
        raise KeyError(f"format {kind}")
    _needs_kernel(file, kind)
    exact = part.body(offset) if kind in SOLID_FORMATS else part.section(offset).region
    kind = "drawing" if entry["purpose"] == "drawing" else kind
    verdict = verify_file(file, kind, exact, declared, tolerance, part.id)
    if kind == "dxf" and not verdict.failures:
        verdict = _audited(file, verdict)
    if part.is_cam:
        from exporters.reroll import reroll

        verdict, _ = reroll(file, kind, part, offset, declared, verdict)
    return Recheck(file, verdict, declared, tolerance, digest == entry["sha256"])


def _audited(file: Path, verdict: Verdict) -> Verdict:
    """A laser DXF that our own reader found good, as ezdxf finds it."""
    try:
        audited(file)
    except ReadError as refusal:
        return replace(verdict, failures=(*verdict.failures, str(refusal)))
    return verdict


def _against_sheet(file: Path, source: str, scene: SceneFile, entry: dict[str, Any], digest: str) -> Recheck:
    """A sheet: drawn again from the scene, and the file measured against that."""
    from exporters.plan import plan_build

    plan = plan_build(scene, source, [], ["sheet"])
    job = {sheet.path: sheet for sheet in plan.sheets}[entry["path"]]
    declared, tolerance = float(entry["max_error"]), float(entry["tolerance"])
    return Recheck(file, job.verify(file), declared, tolerance, digest == entry["sha256"])


def _against_assembly(file: Path, source: str, scene: SceneFile, entry: dict[str, Any], digest: str) -> Recheck:
    """An assembly file: its instances by the report, their places worked out again."""
    from exporters.verify_assembly import expected_of, verify_assembly

    made, matings = make_parts(scene, source)
    stand = {i.id: i for i in place(scene.instances, scene.drives, made, matings, source).instances}
    instances = [stand[name] for name in entry["instances"]]
    declared, tolerance, kind = float(entry["max_error"]), float(entry["tolerance"]), entry["format"]
    if kind not in ASSEMBLY_FORMATS or not instances:
        raise KeyError(f"an assembly of {len(instances)} instances, format {kind}")
    _needs_kernel(file, kind)
    used = {i.part: made[i.part] for i in instances}
    expected = expected_of(assembly_name(scene.name), used, float(entry["offset"]), instances)
    verdict = verify_assembly(file, kind, expected, declared, tolerance)
    return Recheck(file, verdict, declared, tolerance, digest == entry["sha256"])


def _needs_kernel(file: Path, kind: str) -> None:
    if kind == "step" and find_spec("OCP") is None:
        raise SceneError(str(file), "", None, 'needs the CAD kernel to be read: pip install "cadquery-ocp-novtk<8"')
