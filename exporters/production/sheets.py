"""Sheets among the files of a build: which are asked for, what is on them, how they are written and held to account."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

from msgspec.structs import asdict, replace

from exporters.drawings.sheets import sheet_rounding, write_sheets
from exporters.drawings.verify import verify_sheets
from exporters.production.jobs import FileJob, Made
from exporters.production.request import Request
from exporters.verification.verdict import Verdict
from geometry.base.errors import ConvergenceError, Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.gears.pictures.meshing import MeshingPicture, meshing_picture
from geometry.gears.teeth.limits import practicum_undercut
from geometry.gears.teeth.transverse import overlap_ratio
from parts.base.lazy import Registry
from parts.base.mate import Toothed
from parts.base.materials import material_told
from parts.base.part import Part
from parts.base.refusal import REMOVED, SceneError, placed
from parts.base.schema import unit_of
from parts.base.texts import told_in, words
from parts.cams.coupler_cam.part import LinkageCamSpec
from parts.cams.disk_cam.part import CamSpec
from parts.drawing.canvas import Canvas, decimal, scale_text
from parts.drawing.choice import Asked
from parts.drawing.expected import Circle, Expected, Meshing
from parts.drawing.font import missing_letters
from parts.drawing.names import drawn_names
from parts.drawing.parts_list import form_of, mass_text
from parts.drawing.table import Row
from parts.drawing.title_block import FORM_1, TITLE_BLOCK, check_held, draw_title_block, draw_turned, title_block_of
from parts.drawing.view import TEETH
from parts.gears.spur_gear.part import SpurGearSpec, checked_spur_gear
from parts.keys.sheet import WORKING
from parts.keys.title import TitleBlockTable
from parts.mates.sheets.meshing import Facts, meshing_canvas
from parts.mates.worm import WormMating
from parts.scene.scene_file import ExportSpec, SceneFile
from parts.texts.sheets import sheet_words

# by how much the device moves its rack at each press of the key, mm: 4 to 5 in practicum, lesson 1; on wheels that are
# much smaller or larger than its own no more and no less than these parts of the pitch
RACK_STEP, _MOST_STEP, _LEAST_STEP = 4.5, 1 / 6, 1 / 60
ENDINGS = ("dxf", "svg")
# purposes whose sheets always have their title block
_WITH_BLOCK = ("parts_list", *WORKING)


class SheetJob(Record, FileJob):
    """One file of sheets, of several in a PDF only."""

    export: ExportSpec
    title: str
    pages: tuple[Expected, ...]
    path: str
    place: str

    @property
    def expected(self) -> Expected:
        """What the first sheet must hold."""
        return self.pages[0]

    @property
    def canvas(self) -> Canvas:
        """What is drawn on the first sheet."""
        return self.expected.canvas

    @property
    def told(self) -> dict[str, Any]:
        """The size of its paper, and how many sheets it has where there are several."""
        pages = {"pages": len(self.pages)} if len(self.pages) > 1 else {}
        return {"part": None, "paper": self.canvas.paper, **pages}

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write the file; counts of what is in it."""
        return write_sheets(file, [page.canvas for page in self.pages], self.title)

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back and measure."""
        return verify_sheets(file, self.pages, self.tolerance)

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """What the drawings remark on."""
        return tuple(dict.fromkeys(f for page in self.pages for f in page.findings))

    def declared(self, made: Made) -> tuple[float, str]:
        """Bound of its splines, mm on paper, and what kind of bound that is."""
        canvases = [page.canvas for page in self.pages]
        worst = max(canvas.max_error for canvas in canvases) + sheet_rounding(Path(self.path))
        return worst, "sampled" if any(canvas.sampled for canvas in canvases) else "certified"


_HERE = "exporters.production"
# what makes the sheets of a purpose: each with the word of its name
_MAKERS: Registry[Callable[[Request, Asked], list[tuple[str, Expected]]]] = Registry(
    {
        "model": f"{_HERE}.paper_models:paper_models",
        "generating": f"{_HERE}.sheets:generating_sheets",
        "cam": f"{_HERE}.cam_sheets:cam_sheets",
        "parts_list": f"{_HERE}.parts_lists:list_pages",
        "part": f"{_HERE}.part_drawings:part_drawings",
        "assembly": f"{_HERE}.assembly_drawings:assembly_drawings",
        "train": f"{_HERE}.train_sheets:train_sheets",
        "meshing": f"{_HERE}.sheets:meshing_sheets",
    }
)


def sheet_jobs(wanted: Request) -> list[SheetJob]:
    """The files of one export.

    Raises
    ------
    SceneError
        The scene has no such pair, there is nothing to draw of it, the paper is too small, or no spline of a curve is
        proven to keep the tolerance.
    """
    export, parts, language = wanted.export, wanted.parts, wanted.language
    tolerance = float(export.tolerance or 0.0)
    # the rounding of the file's numbers takes its share first
    share = sheet_rounding(Path(f"sheet.{export.format}"))
    asked = Asked(language, tolerance - share, _band(export), export.paper, export.scale, export.cells == "empty")
    try:
        if export.format == "pdf":
            from exporters.drawings.pdf import check_pdf

            check_pdf(tolerance)
        made = _MAKERS[export.purpose or "meshing"](wanted, asked)
    except ParameterError as error:
        raise placed(wanted.source, wanted.where, error, unit_of(ExportSpec, error.name)) from error
    except ConvergenceError as error:
        raise wanted.refused(
            "tolerance", tolerance, "tolerance_not_met", residual=error.residual, steps=error.iterations
        ) from error
    for number, (word, expected) in enumerate(made, 1):
        shown = [word.partition(".")[0]] if export.purpose in ("cam", "part") else export.parts or []
        part = parts[shown[0]] if len(shown) == 1 and export.purpose not in ("parts_list", "assembly") else None
        # each part's drawing is a document of its own
        count = (1, 1) if export.purpose == "part" else (number, len(made))
        weighed = [part] if part is not None else []
        if export.purpose == "assembly":
            weighed = [parts[i.part] for i in wanted.placing.instances if i.part in wanted.wanted]
        _add_title_block(expected, wanted, part, _mass(weighed, language), count)
        if export.cells == "empty":
            expected.canvas.texts[:] = [seen for text in expected.canvas.texts for seen in text.asked()]
    endings = ENDINGS if export.format == "sheet" else (export.format,)
    if export.format == "pdf":
        _check_letters([expected.canvas for _, expected in made], wanted)
        pages = tuple(expected for _, expected in made)
        return [SheetJob(export, wanted.title, pages, f"{wanted.stem}.pdf", wanted.where)]

    def stem(word: str) -> str:
        # a part's drawing is named as all files of a part are
        own = [word, export.name or export.purpose] if export.purpose == "part" else [wanted.stem, word]
        return ".".join(filter(None, own))

    return [
        SheetJob(export, wanted.title, (expected,), f"{stem(word)}.{ending}", wanted.where)
        for word, expected in made
        for ending in endings
    ]


def _check_letters(canvases: list[Canvas], wanted: Request) -> None:
    """Refuse words of the scene that the font of a PDF cannot write."""
    if not missing_letters("".join(run.text for canvas in canvases for text in canvas.texts for run in text.runs)):
        return
    scene, block = wanted.scene, wanted.export.title_block
    given: dict[str, str | None] = {"scene.title": scene.scene.title}
    given |= {f"parts.{key}.title": told_in(wanted.language, spec.title or "") for key, spec in scene.parts.items()}
    for key, spec in scene.parts.items():
        given |= {f"parts.{key}.{name}": getattr(spec, name) for name in ("material", "designation", "standard")}
    if (told := wanted.export.drawing) is not None:
        given |= {f"{wanted.where}.drawing.requirements[{k}]": text for k, text in enumerate(told.requirements, 1)}
    if isinstance(block, TitleBlockTable):
        given |= {f"{wanted.where}.title_block.{key}": str(text) for key, text in asdict(block).items()}
    for place, text in given.items():
        if letters := missing_letters(text or ""):
            raise SceneError(wanted.source, place, text, "no_such_letter_on_paper", REMOVED, letters=letters)


def meshing_sheets(wanted: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The sheets of the pairs that an export names, by their numbers.

    Raises
    ------
    SceneError
        The scene has no such pair, or what it has cannot be drawn.
    """
    scene, export, source = wanted.scene, wanted.export, wanted.source
    matings = [mate.mating for mate in wanted.placing.mates]
    gears = {
        n: m
        for n, m in enumerate(matings, 1)
        if isinstance(m, WormMating) or (isinstance(m, Toothed) and m.pair is not None)
    }
    if not gears:
        has_cam = any(isinstance(spec, CamSpec | LinkageCamSpec) for spec in scene.parts.values())
        code = "shows_gear_pairs" if matings or has_cam else "shows_gear_pairs_of_mates"
        raise wanted.refused("purpose", export.purpose, code, Nearest("cam") if has_cam else None)
    if export.mate is not None and export.mate not in gears:
        given = export.mate
        works = Nearest(min(gears, key=lambda number: abs(number - given)))
        if 1 <= given <= len(matings):
            kind = matings[given - 1].kind
            raise wanted.refused("mate", given, "mate_of_no_gears", works, kind=kind)
        raise wanted.refused("mate", given, "no_such_mate", works)
    found = []
    for index, mating in gears.items():
        if export.mate not in (None, index):
            continue
        if isinstance(mating, WormMating):
            found.append((str(index), _worm(mating, scene, asked, f"mates[{index}]", source)))
            continue
        try:
            assert mating.pair is not None
            picture = meshing_picture(mating.pair)
        except ParameterError as error:
            raise SceneError(source, f"mates[{index}]", error.value, error.code, None, "", **error.numbers) from error
        found.append((str(index), _meshing(mating, picture, wanted, asked)))
    return found


def _worm(mating: WormMating, scene: SceneFile, asked: Asked, place: str, source: str) -> Expected:
    """The sheet of a worm in its wheel, where they touch along lines."""
    from parts.mates.sheets.worm_contact import worm_sheet

    field = mating.field
    if field is None:
        raise SceneError(source, place, None, "worm_touches_at_points")
    if field.is_empty() or not field.goes_on():
        raise SceneError(source, place, None, "worm_touches_nowhere" if field.is_empty() else "worm_contact_turns")
    return worm_sheet(mating, field, scene.scene.title or f"{mating.first}, {mating.second}", asked)


def generating_sheets(wanted: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The sheet of the device TMM-42 for one or two wheels of a scene.

    Raises
    ------
    SceneError
        The scene has none, or one that the device does not cut.
    """
    from parts.gears.spur_gear import device_page as tmm42
    from parts.gears.spur_gear.device_sheet import generating_sheet

    scene, export, source = wanted.scene, wanted.export, wanted.source
    ids = export.parts or [key for key, spec in scene.parts.items() if isinstance(spec, SpurGearSpec)]
    for part in ids:
        if not isinstance(scene.parts[part], SpurGearSpec):
            raise wanted.refused("parts", part, "device_draws_external_gears")
        _check_wheel(scene.parts[part], f"parts.{part}", source)
    if not ids:
        raise wanted.refused("purpose", export.purpose, "shows_external_gears")
    gears = [checked_spur_gear(scene.parts[part]) for part in ids]
    # the wheel of table 1.2
    most = max(range(len(ids)), key=lambda k: abs(gears[k].profile_shift_coefficient))
    table = tmm42.table_from(scene, source, {"part": ids[most]})
    if abs(table.get("profile_shift_coefficient", math.inf) - practicum_undercut(gears[0]).limit) < 1e-12:
        # the very shift of (1.2), which the table then derives
        table.pop("profile_shift_coefficient")
    tables = tmm42.sheet(table, zero_only=all(g.profile_shift_coefficient == 0 for g in gears))
    pitch = math.pi * gears[0].module
    step = export.rack_step or min(max(RACK_STEP, _LEAST_STEP * pitch), _MOST_STEP * pitch)
    pages = generating_sheet(gears, step, tables, asked)
    return [(str(n) if len(pages) > 1 else "", page) for n, page in enumerate(pages, 1)]


def _band(export: ExportSpec) -> float:
    """Height that the title block takes, mm."""
    return TITLE_BLOCK[1] if export.title_block and export.purpose != "part" else 0.0


def _add_title_block(
    expected: Expected, wanted: Request, part: Part | None, mass: str, number: tuple[int, int]
) -> None:
    """The title block on a sheet, where the export asks for one; of a single ``part`` with its material."""
    export, language = wanted.export, wanted.language
    if not export.title_block and export.purpose not in _WITH_BLOCK:
        return
    given = export.title_block if isinstance(export.title_block, TitleBlockTable) else TitleBlockTable()
    more = {"name": given.name or (part and part.title) or wanted.title}
    more["mass"] = given.mass or mass
    if part is not None:
        known = material_told(part.material, words(language))
        # a cell of the form begins with a capital, a scene's key need not
        more["material"] = given.material or known[:1].upper() + known[1:]
        if export.purpose == "part":
            name, designation = drawn_names(part, language)
            more |= {"name": given.name or name, "designation": given.designation or designation}
    scale = scale_text(expected.paper.scale, language) if expected.has_view else ""
    form = form_of(number[0]) if export.purpose == "parts_list" else FORM_1
    block = title_block_of(replace(given, **more), scale, *number)
    try:
        check_held(block, form, turned=export.purpose in WORKING)
    except ParameterError as error:
        # what the block does not say itself is the part's or the scene's
        owner = f"parts.{part.id}" if part is not None and (error.name != "name" or part.title) else "scene"
        key = f"{owner}.{'title' if error.name == 'name' else error.name}"
        place = f"{wanted.where}.title_block.{error.name}" if getattr(given, error.name) else key
        raise SceneError(wanted.source, place, error.value, error.code, None, most=error.numbers["most"]) from error
    draw_title_block(expected.canvas, block, language, form)
    if export.purpose in WORKING:
        draw_turned(expected.canvas, block.designation)


def _mass(weighed: Iterable[Part], language: str) -> str:
    """The mass of all in kg, as GOST 2.104 has it; nothing where a density is not known."""
    masses = [part.mass for part in weighed]
    known = [mass for mass in masses if mass is not None]
    return decimal(mass_text(sum(known)), language) if known and len(known) == len(masses) else ""


def _check_wheel(spec: SpurGearSpec, place: str, source: str) -> None:
    """The device cuts straight teeth with a rack."""
    if spec.cutter is not None:
        teeth = spec.cutter.number_of_teeth
        raise SceneError(source, f"{place}.cutter.number_of_teeth", teeth, "device_cuts_with_rack")
    if spec.helix_angle_deg:
        place, given = f"{place}.helix_angle_deg", spec.helix_angle_deg
        raise SceneError(source, place, given, "device_cuts_straight_teeth", Nearest(0.0), "degrees")


def _meshing(mating: Toothed, picture: MeshingPicture, wanted: Request, asked: Asked) -> Expected:
    pair, language = mating.pair, asked.language
    assert pair is not None
    parts = [wanted.parts[str(wanted.scene.instances[name].part)] for name in (mating.first, mating.second)]
    facts = _facts(mating, picture, language, parts)
    canvas, view = meshing_canvas(picture, mating.module, facts, asked)
    if asked.by_hand:
        return Expected(canvas, view.paper, ())
    circles, paper = [], view.paper
    for body, name in ((one, name) for one in picture.bodies for name in one.radii if view.shows(one, name)):
        centre, size = None, paper.point(1j * body.radii[name]).imag
        if body.centre is not None:
            centre, size = paper.point(body.centre), paper.scale * body.radii[name]
        circles.append(Circle(f"CIRCLE_{name.upper()}", centre, size))
    wheels = [(body.centre, body.radii["base"]) for body in picture.bodies if body.centre is not None]
    tangents = tuple((paper.point(centre), paper.scale * radius) for centre, radius in wheels)
    teeth = {
        "OUTLINE": [c for b in picture.bodies for c in b.chain(picture.shown, TEETH)],
        "TOOTH_START": [c for b in picture.bodies for c in b.tooth_at(picture.start)],
        "TOOTH_END": [c for b in picture.bodies for c in b.tooth_at(picture.end)],
        "ACTIVE_FLANK": [c for b in picture.bodies for c in b.active_at(picture.shown)],
    }
    ratio, gear = pair.effective_contact_ratio, pair.gears[0]
    pitch = paper.scale * 2 * math.pi * picture.bodies[0].radii["working"] / gear.number_of_teeth
    length = paper.scale * ratio * 2 * math.pi * gear.base_radius / gear.number_of_teeth
    meshing = Meshing(tangents, gear.number_of_teeth, length, ratio * pitch, pitch, ratio)
    return Expected(canvas, paper, tuple(circles), teeth, meshing)


def _facts(mating: Toothed, picture: MeshingPicture, language: str, parts: list[Part]) -> Facts:
    """Title and table of the sheet; of helical parts the normal data too."""
    pair: Any = mating.pair
    specs: list[Any] = [part.keys for part in parts]

    word = partial(sheet_words, language)

    def say(value: float, digits: int) -> str:
        return decimal(f"{value:.{digits}f}", language)

    helix = abs(getattr(specs[0], "helix_angle_deg", 0.0))
    rows = [Row(word("module"), "m", decimal(f"{mating.module:g}", language), answers=0)]
    if helix:
        rows = [
            Row(word("normal_module"), "m_{n}", decimal(f"{specs[0].module:g}", language), answers=0),
            Row(word("helix_angle"), "β", f"{say(helix, 4)}°", answers=0),
            Row(word("transverse_module"), "m_{t}", decimal(f"{mating.module:.6g}", language)),
        ]
    teeth = [(f"z_{{{index}}}", str(gear.number_of_teeth)) for index, gear in enumerate(pair.gears, 1)]
    rows += [Row(word("number_of_teeth"), symbol, count, answers=0) for symbol, count in teeth]
    for index, gear in enumerate(pair.gears, 1):
        shift = gear.profile_shift_coefficient / math.cos(math.radians(helix))
        name, symbol = ("normal_shift", f"x_{{n{index}}}") if helix else ("shift", f"x_{{{index}}}")
        rows.append(Row(word(name), symbol, decimal(f"{shift:.6g}", language)))
    distance = "rack_distance" if picture.kind == "rack" else "centre_distance"
    arc = picture.arc_of_action
    rows += [
        Row(word(distance), "a_{w}", f"{say(mating.distance, 3)}"),
        Row(word("working_angle"), "α_{w}", f"{say(math.degrees(picture.angle), 4)}°"),
    ]
    if picture.tangent_points[1] is not None:
        length = abs(picture.tangent_points[1] - picture.tangent_points[0])
        rows.append(Row(word("line"), "N_{1}N_{2}", say(length, 3)))
    rows += [
        Row(word("active"), "ab", say(picture.end - picture.start, 3)),
        Row(word("arc"), "dd'", say(arc.radius * arc.sweep, 3)),
        Row(word("pitch"), "p_{w}", say(picture.working_pitch, 3)),
        Row(word("ratio"), "ε_{α}", say(picture.contact_ratio, 4)),
    ]
    if helix:
        width = min(s.face_width for s in specs)
        overlap = overlap_ratio(width, math.radians(helix), specs[0].module)
        rows.append(Row(word("face_width"), "b", decimal(f"{width:g}", language)))
        rows.append(Row(word("overlap"), "ε_{β}", say(overlap, 4)))
    rows += [
        # what a file's numbers do not show is none
        *([Row(word("normal_backlash"), "j_{n}", say(play, 3))] if (play := mating.normal_backlash) >= 5e-4 else []),
        Row(word("start"), sample="TOOTH_START"),
        Row(word("end"), sample="TOOTH_END"),
        Row(word("flank"), sample="ACTIVE_FLANK"),
        Row(word("active"), sample="ACTIVE_LINE"),
        Row(word("arc"), sample="ARC_OF_ACTION"),
        Row(word("pitch"), sample="WORKING_PITCH"),
    ]
    # what kinds of gears they are the kind of the picture says
    section = f" ({word('transverse_section')})" if helix else ""
    return Facts(f"{word(picture.kind)}{section}: {_both(mating, parts)}", tuple(rows))


def _both(mating: Toothed, parts: list[Part]) -> str:
    """What both parts are called, as the picture counts them: the pinion of a ring first."""
    first, second = (part.title or part.id for part in parts)
    if getattr(mating, "ring_first", False):
        first, second = second, first
    return f"{first} (1), {second} (2)"
