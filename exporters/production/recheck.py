"""``higherpair verify``: files on disk against the part that the report beside them names."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from exporters.formats.readback import MOST_READ_BYTES
from exporters.production.jobs import assembly_name
from exporters.production.kept import failure_of
from exporters.production.moving import is_half_moved
from exporters.production.report import NAME, whole_report
from exporters.verification.judge import signed, verify_part
from exporters.verification.verdict import Verdict, judges
from geometry.base.errors import GeometryError
from geometry.base.record import Record
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.base.texts import fault
from parts.keys.sheet import on_sheet
from parts.scene.formats import OF_SCENES, FileKind, Form, file_kind
from parts.scene.load import SceneFile, make_parts, scene_from_resolved
from parts.scene.placing import place

if TYPE_CHECKING:
    from exporters.production.plan import Film, ListJob, SheetJob


class Recheck(Record):
    """The verdict on one file; ``same_bytes``: it is the very file that was reported."""

    file: Path
    verdict: Verdict
    declared: float
    tolerance: float
    same_bytes: bool

    @property
    def told(self) -> dict[str, Any]:
        """As plain data."""
        return {
            "file": str(self.file),
            "ok": not self.verdict.failures,
            "failures": list(self.verdict.failures),
            "measured": self.verdict.measured,
            "judges": judges(self.verdict.measured),
            "declared": self.declared,
            "tolerance": self.tolerance,
            "same_bytes": self.same_bytes,
        }


def recheck(file: Path) -> Recheck:
    """Hold one file against its report; a preview is only compared byte by byte.

    Raises
    ------
    SceneError
        There is no such file, it cannot be read, or no report knows it.
    """
    try:
        return _rechecked(file)
    except OSError as error:
        raise SceneError(str(file), "", None, "unreadable", None, why=error.strerror or str(error)) from error


def _rechecked(file: Path) -> Recheck:
    if is_half_moved(file.parent):
        raise SceneError(str(file), "", None, "stopped_while_moving")
    if not file.is_file():
        code = "folder_of_files" if file.is_dir() else "not_a_file_to_read" if file.exists() else "no_such_file"
        raise SceneError(str(file), "", None, code)
    if file.stat().st_size > MOST_READ_BYTES:
        raise SceneError(str(file), "", None, "too_large_to_read_back", None, most=MOST_READ_BYTES)
    source = str(file.parent / NAME)
    if not (file.parent / NAME).is_file():
        raise SceneError(str(file), "", None, "no_report_beside", None, name=NAME)
    report = whole_report(file.parent)
    try:
        if report is None:
            raise SceneError(source, "", None, "no_report")
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        previews = {entry["path"]: entry["sha256"] for entry in report["previews"]}
        if file.name in previews:
            same = digest == previews[file.name]
            return Recheck(file, Verdict({}, () if same else (fault("the preview has been changed"),)), 0.0, 0.0, same)
        entries = {entry["path"]: entry for entry in report["files"]}
        if file.name in entries:
            return _against(file, source, report, entries[file.name], digest)
        failure = failure_of(report, file.name)
    except (KeyError, TypeError, AttributeError, ArithmeticError, RecursionError, GeometryError) as error:
        raise SceneError(source, "", None, "damaged_report", None, why=str(error)) from error
    except ValueError as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(source, "", None, "damaged_report", None, why=str(error)) from error
    if failure is not None:
        code = "last_build_failed" if failure.fits else "last_build_failed_otherwise"
        raise SceneError(str(file), "", None, code, None, why=failure.why)
    code = "not_in_report" if entries else "not_in_empty_report"
    raise SceneError(str(file), "", None, code, None, name=NAME, known=[str(path) for path in entries])


def _against(file: Path, source: str, report: dict[str, Any], entry: dict[str, Any], digest: str) -> Recheck:
    scene = scene_from_resolved(report["scene"], source)
    if on_sheet(entry["format"], entry["purpose"]) or entry["format"] in OF_SCENES:
        return _against_sheet(file, source, report["scene"], entry, digest)
    if "board" in entry:
        return _against_board(file, source, scene, entry, digest)
    if "bed" in entry:
        return _against_plate(file, source, scene, entry, digest)
    if entry["part"] is None:
        return _against_assembly(file, source, scene, entry, digest)
    part = make_parts(scene, source)[0][entry["part"]]
    declared, tolerance = float(entry["max_error"]), float(entry["tolerance"])
    kind = file_kind(entry["format"], entry["purpose"])
    also = audited if kind.form is Form.ARCS and kind.format == "dxf" else None
    offset = float(entry["offset"])
    path = part.pitch_curve if entry.get("pitch_curve") else None
    verdict = verify_part(file, kind, part, offset, declared, tolerance, also, path)
    verdict = _signed(file, kind, entry, verdict)
    verdict = _by_kernel_too(file, kind, [part], offset, verdict)
    return Recheck(file, verdict, declared, tolerance, digest == entry["sha256"])


def _signed(file: Path, kind: FileKind, entry: dict[str, Any], verdict: Verdict) -> Verdict:
    """A verdict that counts whom the header must name too."""
    return signed(file, kind, str(entry.get("author", "")), str(entry.get("organisation", "")), verdict)


def _by_kernel_too(file: Path, kind: FileKind, parts: Sequence[Part], offset: float, verdict: Verdict) -> Verdict:
    """A good STEP file is held against the CAD kernel as well, where that is installed."""
    if kind.form is not Form.FACES or verdict.failures or find_spec("OCP") is None:
        return verdict
    from exporters.verification.kernel import judged_by_kernel

    return judged_by_kernel(file, [part.body(offset) for part in parts], verdict)


def audited(file: Path) -> None:
    """What ezdxf finds wrong with a laser DXF that our own reader found good is an error."""
    from exporters.formats.read_drawing import opened

    opened(file)


def _against_sheet(file: Path, source: str, told: dict[str, Any], entry: dict[str, Any], digest: str) -> Recheck:
    """A sheet: drawn again from the scene, and the file measured against that."""
    job = _sheets_of(json.dumps(told), source, entry["format"])[entry["path"]]
    declared, tolerance = float(entry["max_error"]), float(entry["tolerance"])
    return Recheck(file, job.verify(file, declared), declared, tolerance, digest == entry["sha256"])


# files of one folder are verified one behind the other
@lru_cache(maxsize=1)
def _sheets_of(told: str, source: str, form: str) -> dict[str, SheetJob | Film | ListJob]:
    """The sheets of a format by their names, from a report's scene as json; drawn once for all of them."""
    from exporters.production.plan import plan_build

    plan = plan_build(scene_from_resolved(json.loads(told), source), source, [], [form])
    return {sheet.path: sheet for sheet in plan.sheets}


def _against_board(file: Path, source: str, scene: SceneFile, entry: dict[str, Any], digest: str) -> Recheck:
    """A board: its pieces where the report says that they lie."""
    from exporters.verification.board import BoardPiece, ExpectedBoard, verify_board

    pieces = tuple(
        BoardPiece(name, told["part"], float(told["turn_deg"]), complex(*told["at"]))
        for name, told in entry["pieces"].items()
    )
    expected = ExpectedBoard(scene.boards[entry["board"]], make_parts(scene, source)[0], pieces, float(entry["offset"]))
    declared, tolerance = float(entry["max_error"]), float(entry["tolerance"])
    verdict = verify_board(file, file_kind(entry["format"], entry["purpose"]), expected, declared, tolerance)
    return Recheck(file, verdict, declared, tolerance, digest == entry["sha256"])


def _against_plate(file: Path, source: str, scene: SceneFile, entry: dict[str, Any], digest: str) -> Recheck:
    """A plate: its pieces where the report says that they stand."""
    from exporters.production.plates import instances_of
    from exporters.verification.assembly import expected_of
    from exporters.verification.plate import ExpectedPlate, verify_plate

    made, stand = make_parts(scene, source)[0], instances_of(entry["pieces"])
    used = {i.part: made[i.part] for i in stand}
    expected = expected_of(assembly_name(scene.name), used, float(entry["offset"]), stand)
    declared, tolerance = float(entry["max_error"]), float(entry["tolerance"])
    kind, plate = file_kind(entry["format"], entry["purpose"]), ExpectedPlate(scene.beds[entry["bed"]], expected)
    return Recheck(file, verify_plate(file, kind, plate, declared, tolerance), declared, tolerance,
                   digest == entry["sha256"])  # fmt: skip


def _against_assembly(file: Path, source: str, scene: SceneFile, entry: dict[str, Any], digest: str) -> Recheck:
    """An assembly file: its instances by the report, their places worked out again."""
    from exporters.verification.assembly import expected_of, verify_assembly

    made, matings = make_parts(scene, source)
    stand = {i.id: i for i in place(scene.instances, scene.drives, made, matings, source).instances}
    instances = [stand[name] for name in entry["instances"]]
    declared, tolerance = float(entry["max_error"]), float(entry["tolerance"])
    kind = file_kind(entry["format"], entry["purpose"])
    if not kind.assembly or not instances:
        raise KeyError(f"an assembly of {len(instances)} instances, format {kind.format}")
    used = {i.part: made[i.part] for i in instances}
    expected = expected_of(assembly_name(scene.name), used, float(entry["offset"]), instances)
    verdict = _signed(file, kind, entry, verify_assembly(file, kind, expected, declared, tolerance))
    stood = [made[i.part] for i in instances]
    verdict = _by_kernel_too(file, kind, stood, expected.offset, verdict)
    return Recheck(file, verdict, declared, tolerance, digest == entry["sha256"])
