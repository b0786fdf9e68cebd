"""``higherpair verify``: files on disk against the part that the report beside them names."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from exporters.formats.readback import MOST_READ_BYTES
from exporters.production.jobs import assembly_name
from exporters.production.kept import failure_of
from exporters.production.moving import hash_of, is_half_moved
from exporters.production.report import NAME, whole_report
from exporters.verification.judge import signed, verify_part
from exporters.verification.verdict import Verdict, judges
from geometry.base.errors import GeometryError
from geometry.base.record import Record
from parts.base.refusal import SceneError
from parts.base.texts import Message, fault
from parts.keys.sheet import on_sheet
from parts.scene.formats import OF_SCENES, Form, file_kind
from parts.scene.load import make_parts, scene_from_resolved
from parts.scene.placing import place
from parts.scene.scene_file import SceneFile
from parts.solids.kernel import has_kernel

if TYPE_CHECKING:
    from exporters.production.plan import Film, ListJob, SheetJob
    from parts.base.mate import Mating
    from parts.base.part import Part


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
        raise SceneError(str(file), "", None, "unreadable", None, why=Message(error.strerror or str(error))) from error


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
        digest = hash_of(file)
        previews = {entry["path"]: entry["sha256"] for entry in report["previews"]}
        if file.name in previews:
            same = digest == previews[file.name]
            return Recheck(file, Verdict({}, () if same else (fault("the preview has been changed"),)), 0.0, 0.0, same)
        entries = {entry["path"]: entry for entry in report["files"]}
        if file.name in entries:
            return _against(file, source, report, entries[file.name], digest)
        failure = failure_of(report, file.name)
    except SceneError:
        raise
    except (KeyError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError, GeometryError) as error:
        raise SceneError(source, "", None, "damaged_report", None, why=str(error)) from error
    if failure is not None:
        why, fits = failure
        code = "last_build_failed" if fits else "last_build_failed_otherwise"
        raise SceneError(str(file), "", None, code, None, why=why)
    code = "not_in_report" if entries else "not_in_empty_report"
    raise SceneError(str(file), "", None, code, None, name=NAME, known=[str(path) for path in entries])


def _against(file: Path, source: str, report: dict[str, Any], entry: dict[str, Any], digest: str) -> Recheck:
    told = json.dumps(report["scene"])
    declared, tolerance = float(entry["max_error"]), float(entry["tolerance"])
    if on_sheet(entry["format"], entry["purpose"]) or entry["format"] in OF_SCENES:
        # drawn again from the scene, and the file measured against that
        job = _sheets_of(told, source, entry["format"])[entry["path"]]
        verdict = job.verify(file, declared)
    else:
        verdict = _held(file, source, told, entry, declared, tolerance)
    return Recheck(file, verdict, declared, tolerance, digest == entry["sha256"])


def _held(file: Path, source: str, told: str, entry: dict[str, Any], declared: float, tolerance: float) -> Verdict:
    """A file of parts: pieces where the report says that they lie, instances in places that are worked out again.

    STEP files are held against the CAD kernel as well, where that is installed.
    """
    kind, offset = file_kind(entry["format"], entry["purpose"]), float(entry["offset"])
    scene, parts, matings = _made_of(told, source)
    if "board" in entry:
        from exporters.verification.board import BoardPiece, ExpectedBoard, verify_board

        pieces = tuple(
            BoardPiece(name, piece["part"], float(piece["turn_deg"]), complex(*piece["at"]))
            for name, piece in entry["pieces"].items()
        )
        board = ExpectedBoard(scene.boards[entry["board"]], parts, pieces, offset)
        return verify_board(file, kind, board, declared, tolerance)
    if entry["part"] is not None:
        used = [parts[entry["part"]]]
        also = audited if kind.form is Form.ARCS and kind.format == "dxf" else None
        path = used[0].pitch_curve if entry.get("pitch_curve") else None
        verdict = verify_part(file, kind, used[0], offset, declared, tolerance, also, path)
    else:
        from exporters.production.plates import instances_of
        from exporters.verification.assembly import ExpectedAssembly, verify_assembly

        bed = scene.beds[entry["bed"]] if "bed" in entry else None
        if bed is not None:
            stand = instances_of(entry["pieces"])
        else:
            placed = {i.id: i for i in place(scene.instances, scene.drives, parts, matings, source).instances}
            stand = [placed[name] for name in entry["instances"]]
        if not kind.assembly or not stand:
            raise KeyError(f"an assembly of {len(stand)} instances, format {kind.format}")
        used = [parts[i.part] for i in stand]
        expected = ExpectedAssembly(assembly_name(scene), {part.id: part for part in used}, offset, stand, bed)
        verdict = verify_assembly(file, kind, expected, declared, tolerance)
    verdict = signed(file, kind, str(entry.get("author", "")), str(entry.get("organisation", "")), verdict)
    if kind.form is not Form.FACES or verdict.failures or not has_kernel():
        return verdict
    from exporters.verification.kernel import judged_by_kernel

    return judged_by_kernel(file, [part.body(offset) for part in used], verdict)


def audited(file: Path) -> None:
    """What ezdxf finds wrong with a laser DXF that our own reader found good is an error."""
    from exporters.formats.read_drawing import opened

    opened(file)


# files of one folder are verified one behind the other
@lru_cache(maxsize=1)
def _made_of(told: str, source: str) -> tuple[SceneFile, dict[str, Part], list[Mating]]:
    """A report's scene, given as json, with its parts and mates; made once for all files."""
    scene = scene_from_resolved(json.loads(told), source)
    return scene, *make_parts(scene, source)


@lru_cache(maxsize=1)
def _sheets_of(told: str, source: str, form: str) -> dict[str, SheetJob | Film | ListJob]:
    """The sheets of a format by their names, from a report's scene as json; drawn once for all of them."""
    from exporters.production.plan import plan_build

    plan = plan_build(scene_from_resolved(json.loads(told), source), source, [], [form])
    return {sheet.path: sheet for sheet in plan.sheets}
