"""From a validated scene to jobs: which part goes into which file, and every refusal before a byte is written."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
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
from parts.scene.load import in_keys_of_file, make_parts
from parts.scene.placing import Placing, place
from parts.scene.scene_file import ExportSpec, SceneFile, default_export

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
    _check_known(scene, source, only_parts, only_formats)
    parts, matings = make_parts(scene, source)
    placing = place(scene.instances, scene.drives, parts, matings, source)
    if scene.checks.interference and len(placing.instances) > 1:
        from parts.scene.checks import check_solids, check_workspace

        check_solids(parts, source)
        check_workspace(scene.checks.workspace, placing, source)
    exports = _wanted_exports(scene, source, only_formats)
    planning = _Planning(scene, source, parts, placing, exports, only_parts)
    planning.left_out += _unasked(scene, parts, exports, only_parts, only_formats, planning.rods)
    for where, export in exports:
        planning.add(where, export)
    return planning.plan(only_formats)


def _check_known(scene: SceneFile, source: str, only_parts: list[str], only_formats: list[str]) -> None:
    """Refuse parts and formats of the command line that there are not."""
    for option, asked, known, code in (
        ("--part", only_parts, list(scene.parts), "no_such_part"),
        ("--format", only_formats, list(FORMATS), "unknown_format"),
    ):
        for name in asked:
            if name not in known:
                several = [one for one in re.split(r"[\s,;]+", name) if one in known]
                if len(several) > 1:
                    each = " ".join(f"{option} {one}" for one in several)
                    raise SceneError(source, option, name, "one_at_a_time", None, asked=each)
                raise SceneError(source, option, name, code, meant(name, known), known=known)


def _unasked(
    scene: SceneFile, parts: dict[str, Part], exports: list[tuple[str, ExportSpec]], only_parts: list[str],
    only_formats: list[str], rods: Collection[str],
) -> Iterator[LeftOut]:  # fmt: skip
    """What of a scene no file is asked of."""
    for number, one in enumerate(scene.exports, 1):
        if only_formats and one.format not in only_formats:
            why = message("format {format} was not asked for", format=one.format)
            yield LeftOut(f"exports[{number}]", why, as_asked=True)
    for name in parts:
        if only_parts and name not in only_parts:
            yield LeftOut(f"parts.{name}", N_("was not asked for"), as_asked=True)
    used = {p for _, e in exports for p in e.parts or parts}
    purposes = {e.purpose for _, e in exports}
    # a name is engraved where a laser cuts; parts of an assembly have theirs for boards to come
    engraved = {p for _, e in exports if e.kind.form is Form.ARCS for p in e.parts or parts}
    unused = [f"parts.{p}" for p in parts if p not in used and p not in rods]
    unused += [f"{key}.{n}" for key, word in PURPOSES_LAID.items() for n in getattr(scene, key) if word not in purposes]
    unused += [f"parts.{p}.label" for p, part in parts.items()
               if p in used - engraved and part.keys.label and f"parts.{p}" not in scene.origins]  # fmt: skip
    yield from (LeftOut(what, N_("no export asks for it"), as_asked=bool(only_formats)) for what in unused)


class _Planning:
    """A plan in the making: each export adds its files, or tells why there is none."""

    def __init__(
        self, scene: SceneFile, source: str, parts: dict[str, Part], placing: Placing,
        exports: list[tuple[str, ExportSpec]], only_parts: list[str],
    ) -> None:  # fmt: skip
        self.scene, self.source, self.parts, self.placing, self.only_parts = scene, source, parts, placing, only_parts
        self.exports = [export for _, export in exports]
        self.left_out: list[LeftOut] = []
        self.jobs: list[Job] = []
        self.assemblies: list[AssemblyJob | BoardJob] = []
        self.sheets: list[SheetJob | Film | ListJob] = []
        # exports of flat files that leave a solid out, and formats that show several parts where one alone is asked for
        self._flat: list[str] = []
        self._of_several: list[str] = []
        self._layouts: dict[object, list[Any]] = {}
        preview = Message(N_("the preview of the part"))
        self._taken: dict[str, Text] = {f"{part}.preview.svg".lower(): preview for part in parts}
        noted = scene.scene.notes or scene.steps or {e.purpose for e in self.exports} & {*PURPOSES_LAID.values()}
        # the notes tell how long they are to be cut
        self.rods = {p for p, part in parts.items() if noted and part.stock is not None}

    def plan(self, only_formats: list[str]) -> Plan:
        """All that was added; nothing at all is refused where files were asked for that none of the parts can have."""
        if not (self.jobs or self.assemblies or self.sheets):
            if self._flat:
                key = "--format" if only_formats else f"{self._flat[0]}.format"
                asked = ", ".join(dict.fromkeys(e.format for e in self.exports))
                raise SceneError(self.source, key, asked, "nothing_flat")
            if only_formats and self._of_several:
                asked = ", ".join(dict.fromkeys(self._of_several))
                raise SceneError(self.source, "--format", asked, "nothing_of_part_alone")
        return Plan(
            self.source, self.scene, self.parts, self.placing, tuple(self.jobs), tuple(self.assemblies),
            tuple(self.left_out), tuple(self.sheets),
        )  # fmt: skip

    def add(self, where: str, export: ExportSpec) -> None:
        """The files of an export."""
        if self.only_parts and (export.assembly or _of_several(export)):
            alone = N_("an assembly of all its parts was not asked for")
            why = alone if export.assembly else N_("a sheet of several parts was not asked for")
            self.left_out.append(LeftOut(where, why))
            self._of_several.append(export.format)
            return
        asked = Request(self.scene, self.placing, self.parts, export, where, self.source, not self.only_parts)
        if on_sheet(export.format, export.purpose):
            self._draw(asked)
        elif export.is_laid:
            self._lay(asked)
        elif export.format in OF_SCENES:
            self.sheets.append(_of_scene(asked))
            self._take(self.sheets[-1].path, where)
        elif export.assembly:
            self._assemble(asked)
        else:
            self.jobs += self._made(asked)

    def _draw(self, asked: Request) -> None:
        """Sheets; of paper models those parts are left out that are not flat."""
        if asked.export.purpose == "model":
            bodies = [p for p in asked.wanted if not is_flat(self.parts[p])]
            if bodies and asked.export.parts:
                raise asked.refused("parts", bodies[0], "no_flat_outline")
            for body in bodies:
                self._leave_body(asked.where, body)
            # no rod is cut out of paper
            told = set[str]() if asked.export.parts else self.rods
            if bodies or told:
                kept = [p for p in asked.wanted if p not in bodies and p not in told]
                kept = kept or [p for p in self.parts if p not in bodies]
                asked = replace(asked, export=with_keys(asked.export, parts=kept))
        asked = replace(asked, export=_of_cams(asked.export, self.parts, self.only_parts))
        if asked.export.parts != []:
            from exporters.production.sheets import sheet_jobs

            found = sheet_jobs(asked)
            self._take_all(found, asked.where)
            self.sheets += found

    def _lay(self, asked: Request) -> None:
        """Boards or beds, and the parts that lie on none."""
        laid = _laid(asked, self._layouts)
        self._take_all(laid, asked.where)
        self.assemblies += laid
        lying = {m.part.id for one in laid for m in one.members}
        over = [self.parts[p] for p in asked.wanted if p not in lying and (p not in self.rods or asked.export.parts)]
        on_none = _ON_NO_BOARD if asked.export.purpose == "board" else N_("lies on none of its beds")
        for bought, why in ((False, on_none), (True, N_("is bought by its standard"))):
            if names := ", ".join(part.title or part.id for part in over if part.is_bought == bought):
                self.left_out.append(LeftOut(f"{asked.where}: {names}", why))

    def _assemble(self, asked: Request) -> None:
        """One file of all instances in their places."""
        members = self._made(asked)
        path = _assembly_path(self.scene, asked.export, self.exports)
        self._take(path, asked.where)
        stand = tuple(i for i in self.placing.instances if i.part in asked.wanted)
        name = assembly_name(self.scene)
        self.assemblies.append(AssemblyJob(name, asked.export, tuple(members), stand, path, asked.where))

    def _made(self, asked: Request) -> list[Job]:
        """A file of each part that is asked for, or a member of their assembly."""
        export = asked.export
        if export.pitch_curve and not any(self.parts[p].pitch_curve for p in asked.wanted):
            raise asked.refused("pitch_curve", True, "no_pitch_curve", REMOVED)
        made: list[Job] = []
        for name in asked.wanted:
            if self.only_parts and name not in self.only_parts:
                continue
            if not (export.parts or export.kind.is_solid or is_flat(self.parts[name])):
                self._leave_body(asked.where, name)
                continue
            path = "" if export.assembly else _file_name(name, export, self.exports)
            self._take(path, asked.where)
            try:
                made.append(asked.job(self.parts[name], path))
            except SceneError as refusal:
                others = [p for p in asked.wanted if not self.parts[p].made_by.unmoved]
                if refusal.code != "of_part" or not others or name in others:
                    raise
                told = {**refusal.numbers, "others": [format_value(p) for p in others]}
                raise SceneError(
                    self.source, refusal.key, refusal.value, "of_part_alone", None, "", **told
                ) from refusal
        return made

    def _leave_body(self, where: str, part: str) -> None:
        """A part that flat files cannot hold."""
        self.left_out.append(LeftOut(where, message(N_("{part} has no flat outline"), part=part)))
        self._flat.append(where)

    def _take_all(self, files: Iterable[FileJob], where: str) -> None:
        for one in files:
            self._take(one.path, where)

    def _take(self, path: str, where: str) -> None:
        """Note the name of a file; two exports into one file are refused."""
        if not path:
            return
        if path.lower() in self._taken:
            raise SceneError(self.source, f"{where}.name", path, "same_file", None, other=self._taken[path.lower()])
        self._taken[path.lower()] = where


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
