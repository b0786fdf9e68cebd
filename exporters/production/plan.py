"""From a validated scene to jobs: which part goes into which file, and every refusal before a byte is written."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace as with_keys

from exporters.production.jobs import AssemblyJob, FileJob, Job, assembly_name
from exporters.production.request import Request, is_flat
from geometry.base.errors import Nearest, format_value
from geometry.base.record import Record, replace
from parts.base.part import Part
from parts.base.refusal import REMOVED, SceneError, meant
from parts.base.texts import N_, Message, Text, message
from parts.keys.boards import PURPOSES_LAID
from parts.keys.sheet import on_sheet
from parts.scene.formats import FORMATS, OF_SCENES, Form
from parts.scene.load import ExportSpec, SceneFile, default_export, in_keys_of_file, make_parts
from parts.scene.placing import Placing, place

if TYPE_CHECKING:
    from exporters.production.boards import BoardJob
    from exporters.production.film import Film
    from exporters.production.parts_lists import ListJob
    from exporters.production.plates import PlateJob
    from exporters.production.sheets import SheetJob


_ON_NO_BOARD = N_("lies on none of its boards, which take flat parts of their thickness")


class LeftOut(Record):
    """What a build does not make, and why; ``as_asked``: the command itself left it out."""

    what: str
    why: Text
    as_asked: bool = False


class Plan(Record):
    """The files of a build, the parts they need, where these stand, and what was left out and why."""

    source: str
    scene: SceneFile
    parts: dict[str, Part]
    placing: Placing
    jobs: tuple[Job, ...]
    assemblies: tuple[AssemblyJob | BoardJob, ...]
    left_out: tuple[LeftOut, ...]
    sheets: tuple[SheetJob | Film | ListJob, ...] = ()

    @property
    def files(self) -> tuple[FileJob, ...]:
        """Every file of the build."""
        return (*self.jobs, *self.assemblies, *self.sheets)


def plan_build(scene: SceneFile, source: str, only_parts: list[str], only_formats: list[str]) -> Plan:
    """Jobs in the order of the scene file; ``only_…`` (empty: all) leave the rest out.

    Raises
    ------
    SceneError
        An unknown part or format, two exports into one file, or an outline that does not survive its offset.
    """
    typed = {f"--format {name}.format": "--format" for name in only_formats}
    with in_keys_of_file({**scene.origins, **typed}):
        return _planned(scene, source, only_parts, only_formats)


def _planned(scene: SceneFile, source: str, only_parts: list[str], only_formats: list[str]) -> Plan:
    for name in only_parts:
        if name not in scene.parts:
            known = list(scene.parts)
            raise SceneError(source, "--part", name, "no_such_part", meant(name, known), known=known)
    for name in only_formats:
        if name not in FORMATS:
            raise SceneError(source, "--format", name, "unknown_format", meant(name, FORMATS), known=list(FORMATS))
    parts, matings = make_parts(scene, source)
    placing = place(scene.instances, scene.drives, parts, matings, source)
    if scene.checks.interference and len(placing.instances) > 1:
        from parts.scene.checks import check_solids, check_workspace

        check_solids(parts, source)
        check_workspace(scene.checks.workspace, placing, source)
    exports = _wanted_exports(scene, source, only_formats)
    left_out = [
        LeftOut(f"exports[{i + 1}]", message("format {format} was not asked for", format=e.format), as_asked=True)
        for i, e in enumerate(scene.exports)
        if only_formats and e.format not in only_formats
    ]
    unasked = [p for p in parts if only_parts and p not in only_parts]
    left_out += [LeftOut(f"parts.{p}", N_("was not asked for"), as_asked=True) for p in unasked]
    used = {p for _, e in exports for p in e.parts or parts}
    purposes = {e.purpose for _, e in exports}
    noted = scene.scene.notes or scene.steps or purposes & {*PURPOSES_LAID.values()}
    # the notes tell how long they are to be cut
    rods = {p for p, part in parts.items() if noted and part.stock is not None}
    unused = [f"parts.{p}" for p in parts if p not in used | rods]
    unused += [f"{key}.{n}" for key, word in PURPOSES_LAID.items() for n in getattr(scene, key) if word not in purposes]
    # a name is engraved where a laser cuts; parts of an assembly have theirs for boards to come
    engraved = {p for _, e in exports if e.kind.form is Form.ARCS for p in e.parts or parts}
    unused += [f"parts.{p}.label" for p, part in parts.items()
               if p in used - engraved and part.keys.label and f"parts.{p}" not in scene.origins]  # fmt: skip
    left_out += [LeftOut(what, N_("no export asks for it"), as_asked=bool(only_formats)) for what in unused]
    # exports of flat files that leave a solid out
    flat: list[str] = []
    # and those that show several parts where one alone is asked for
    of_several: list[str] = []
    jobs: list[Job] = []
    assemblies: list[AssemblyJob | BoardJob] = []
    sheets: list[SheetJob | Film | ListJob] = []
    layouts: dict[object, list[Any]] = {}
    taken: dict[str, Text] = {f"{part}.preview.svg".lower(): Message(N_("the preview of the part")) for part in parts}
    for where, export in exports:
        if only_parts and (export.assembly or _of_several(export)):
            alone = N_("an assembly of all its parts was not asked for")
            why = alone if export.assembly else N_("a sheet of several parts was not asked for")
            left_out.append(LeftOut(where, why))
            of_several.append(export.format)
            continue
        asked = Request(scene, placing, parts, export, where, source)
        if on_sheet(export.format, export.purpose):
            bodies = [p for p in asked.wanted if export.purpose == "model" and not is_flat(parts[p])]
            if bodies and export.parts:
                raise asked.refused("parts", bodies[0], "no_flat_outline")
            left_out += [_no_outline(where, p) for p in bodies]
            flat += [where] * len(bodies)
            # no rod is cut out of paper
            told = rods if export.purpose == "model" and not export.parts else set[str]()
            if bodies or told:
                kept = [p for p in asked.wanted if p not in bodies and p not in told]
                asked = replace(asked, export=with_keys(export, parts=kept or [p for p in parts if p not in bodies]))
            sheets += _sheets(replace(asked, export=_of_cams(asked.export, parts, only_parts)), taken)
            continue
        if export.is_laid:
            laid = _laid(asked, layouts)
            for one in laid:
                _take(one.path, where, taken, source)
            assemblies += laid
            lying = {m.part.id for one in laid for m in one.members}
            over = [parts[p] for p in asked.wanted if p not in lying and (p not in rods or export.parts)]
            on_none = _ON_NO_BOARD if export.purpose == "board" else N_("lies on none of its beds")
            for bought, why in ((False, on_none), (True, N_("is bought by its standard"))):
                if names := ", ".join(part.title or part.id for part in over if part.is_bought == bought):
                    left_out.append(LeftOut(f"{where}: {names}", why))
            continue
        if export.format in OF_SCENES:
            sheets.append(_of_scene(asked))
            _take(sheets[-1].path, where, taken, source)
            continue
        if export.pitch_curve and not any(parts[p].pitch_curve for p in asked.wanted):
            raise asked.refused("pitch_curve", True, "no_pitch_curve", REMOVED)
        made = []
        for part_id in asked.wanted:
            if only_parts and part_id not in only_parts:
                continue
            if not (export.parts or export.kind.is_solid or is_flat(parts[part_id])):
                left_out.append(_no_outline(where, part_id))
                flat.append(where)
                continue
            path = "" if export.assembly else _file_name(part_id, export, [e for _, e in exports])
            _take(path, where, taken, source)
            try:
                made.append(asked.job(parts[part_id], path))
            except SceneError as refusal:
                others = [p for p in asked.wanted if not parts[p].made_by.unmoved]
                if refusal.code != "of_part" or not others or part_id in others:
                    raise
                numbers = {**refusal.numbers, "others": [format_value(p) for p in others]}
                raise SceneError(source, refusal.key, refusal.value, "of_part_alone", None, "", **numbers) from refusal
        if not export.assembly:
            jobs += made
        else:
            path = _assembly_path(scene, export, [e for _, e in exports])
            _take(path, where, taken, source)
            stand = tuple(i for i in placing.instances if i.part in asked.wanted)
            assemblies.append(AssemblyJob(assembly_name(scene.name), export, tuple(made), stand, path, where))
    if flat and not (jobs or assemblies or sheets):
        key = "--format" if only_formats else f"{flat[0]}.format"
        raise SceneError(source, key, ", ".join(dict.fromkeys(e.format for _, e in exports)), "nothing_flat")
    if only_formats and of_several and not (jobs or assemblies or sheets):
        raise SceneError(source, "--format", ", ".join(dict.fromkeys(of_several)), "nothing_of_part_alone")
    return Plan(source, scene, parts, placing, tuple(jobs), tuple(assemblies), tuple(left_out), tuple(sheets))


def _of_scene(asked: Request) -> Film | ListJob:
    """The parts list, or what drives move, as the format shows it."""
    if asked.export.format == "csv":
        from exporters.production.parts_lists import list_job

        return list_job(asked)
    from exporters.production.film import film

    made: type[Film]
    if asked.export.format == "glb":
        from exporters.production.motion_solids import SolidFilm as made
    else:
        from exporters.production.motion import LEAST_TOLERANCE
        from exporters.production.motion import MotionJob as made

        if (given := asked.export.tolerance or LEAST_TOLERANCE) < LEAST_TOLERANCE:
            raise asked.refused("tolerance", given, "finer_than_motion", Nearest(LEAST_TOLERANCE, "at_least"), "mm")
    return film(made, asked)


def _laid(asked: Request, layouts: dict[object, list[Any]]) -> Sequence[BoardJob | PlateJob]:
    """The boards or plates of an export; ``layouts``: of boards, which exports share."""
    if asked.export.purpose == "board":
        from exporters.production.boards import board_jobs

        return board_jobs(asked, layouts)
    from exporters.production.plates import plate_jobs

    return plate_jobs(asked)


# the purposes of sheets that show one part each
_OF_ONE = ("cam", "model", "part")


def _no_outline(where: str, part: str) -> LeftOut:
    """A part that flat files cannot hold."""
    return LeftOut(where, message(N_("{part} has no flat outline"), part=part))


def _of_several(export: ExportSpec) -> bool:
    """Whether a picture shows parts together; that of a cam, a paper model and a working drawing show one."""
    sheet_of_several = on_sheet(export.format, export.purpose) and export.purpose not in _OF_ONE
    return export.is_laid or export.format in OF_SCENES or sheet_of_several


def _of_cams(export: ExportSpec, parts: dict[str, Part], only_parts: list[str]) -> ExportSpec:
    """The export of the parts that were asked for by name, of a sheet of cams those that are cams."""
    if not only_parts:
        return export
    asked = [p for p in export.parts or parts if p in only_parts]
    return with_keys(export, parts=[p for p in asked if export.purpose in ("model", "part") or parts[p].kind == "cam"])


def _sheets(asked: Request, taken: dict[str, Text]) -> list[SheetJob]:
    if asked.export.parts == []:
        return []
    from exporters.production.sheets import sheet_jobs

    found = sheet_jobs(asked)
    for job in found:
        _take(job.path, asked.where, taken, asked.source)
    return found


def _take(path: str, where: str, taken: dict[str, Text], source: str) -> None:
    """Note the name of a file; two exports into one file are refused."""
    if not path:
        return
    if path.lower() in taken:
        raise SceneError(source, f"{where}.name", path, "same_file", None, other=taken[path.lower()])
    taken[path.lower()] = where


def _wanted_exports(scene: SceneFile, source: str, only_formats: list[str]) -> list[tuple[str, ExportSpec]]:
    """The scene's exports with their places; formats asked for on the command line alone get their defaults."""
    exports = [(f"exports[{i + 1}]", e) for i, e in enumerate(scene.exports)]
    for name in only_formats:
        if not any(e.format == name for _, e in exports):
            exports.append((f"--format {name}", default_export(name)))
    exports = [(where, e) for where, e in exports if not only_formats or e.format in only_formats]
    if not exports:
        raise SceneError(source, "exports", None, "no_exports")
    return exports


def _file_name(part_id: str, export: ExportSpec, exports: list[ExportSpec]) -> str:
    """``<part>.<ext>``; with the export's name (default: its purpose) in between where two exports share an ending."""
    sharing = [
        e
        for e in exports
        if e.format == export.format and not _of_several(e) and not e.assembly and part_id in (e.parts or [part_id])
    ]
    if len(sharing) > 1:
        return f"{part_id}.{export.name or export.purpose}.{export.format}"
    return f"{part_id}.{export.format}"


def _assembly_path(scene: SceneFile, export: ExportSpec, exports: list[ExportSpec]) -> str:
    """``<scene>.<ext>``; with a word in between where the export has a name, or another file would be the same."""
    alike = [e for e in exports if e.format == export.format and not _of_several(e)]
    if export.name or sum(e.assembly for e in alike) > 1:
        return f"{scene.name}.{export.name or export.purpose}.{export.format}"
    parts = {p.lower() for e in alike if not e.assembly for p in e.parts or scene.parts}
    word = ".assembly" if scene.name.lower() in parts else ""
    return f"{scene.name}{word}.{export.format}"
