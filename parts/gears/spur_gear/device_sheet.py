"""The sheet of the device TMM-42: the paper disk with the rack's positions, and tables 1.1 and 1.2 beside it."""

from __future__ import annotations

import cmath
import math
import re
from functools import partial

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc
from geometry.gears.pictures.generating import rack_contours
from geometry.gears.teeth.limits import root_form_diameter, undercut
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from parts.base.texts import words
from parts.drawing.canvas import SMALL_TEXT, Box, Canvas, Paper, draw, fitted, scale_text
from parts.drawing.choice import Asked, blank, sheet_for
from parts.drawing.expected import Circle, Expected
from parts.drawing.labels import Labeller
from parts.drawing.table import Row, Table
from parts.pages.page import Sheet, formula_text, numbers_text
from parts.pages.symbols import symbol_text
from parts.pages.text import result_text, step_name
from parts.texts.sheets import sheet_words

TEETH = 3
# the least module on paper, below which a larger paper is better
_LEAST_MODULE = 6.0
# an undercut is named where it takes more than this of the involute, in modules
_SEEN_UNDERCUT = 0.01
# around the picture, above it for the title, for the names of circles on either side; mm
_MARGIN, _TITLE, _NAMES = 5.0, 14.0, 13.0
_CIRCLES = ("tip", "reference", "base", "root")
_SYMBOLS = {"tip": "a", "reference": "", "base": "b", "root": "f"}


def generating_sheet(gears: list[SpurGear], step: float, tables: Sheet, asked: Asked) -> list[Expected]:
    """The sheet of one or two wheels on a disk: the first at the top, the second below.

    On small paper that is asked for the tables have a sheet of their own.

    Raises
    ------
    ParameterError
        The wheels do not fit one disk and rack, the step asks for too many positions, or the paper is too small.
    """
    _check(gears)
    language = asked.language
    rows = [*_rows(tables, language), Row(sheet_words(language, "scale"), "", "1:1", answers=0)]
    disk = max(g.tip_radius for g in gears)

    def greatest(beside: list[Row], sheet: Canvas) -> float:
        field, _ = _areas(sheet, beside)
        return min(field.wide - 2 * _NAMES, field.tall) / (2.1 * disk)

    least, alone = _LEAST_MODULE / gears[0].module, False
    try:
        canvas, scale = sheet_for(asked, partial(greatest, rows), least)
        alone = asked.paper is not None and asked.scale is None and scale < least
    except ParameterError:
        if asked.paper is None:
            raise
        alone = True
    if alone:
        canvas, scale = sheet_for(asked, partial(greatest, []), least)
    room, _ = _areas(canvas, [] if alone else rows)
    rows[-1] = replace(rows[-1], value=scale_text(scale, language))
    pages = [canvas, blank(canvas.paper, upright=canvas.height > canvas.width, band=asked.band)] if alone else [canvas]
    paper = Paper(scale, room.middle)
    for number, page in enumerate(pages, 1):
        page.head(sheet_words(language, "generating") + (f" ({number}/{len(pages)})" if alone else ""), _MARGIN)
    canvas.add("DISK", _circle(paper, Arc(0j, disk, 0.0, 2 * math.pi)))
    for way in (1, 1j):
        canvas.line("CENTRE", paper.point(-1.04 * disk * way), paper.point(1.04 * disk * way))
    circles = [Circle("DISK", paper.origin, paper.scale * disk)]
    curves: dict[str, list[Curve]] = {"RACK": [], "OUTLINE": []}
    names = []
    for index, gear in enumerate(gears):
        turn = math.pi / 2 + math.pi * index
        place = Placement2(turn)
        if not asked.by_hand:
            curves["RACK"] += [c.placed(place) for row in rack_contours(gear, disk, step, TEETH) for c in row]
            curves["OUTLINE"] += _teeth(gear, place)
        # what students calculate they draw themselves
        for name in ("reference",) if asked.by_hand else _CIRCLES:
            layer, radius = f"CIRCLE_{name.upper()}", float(getattr(gear, f"{name}_radius"))
            whole = len(gears) == 1
            arc = Arc(0j, radius, 0.0 if whole else turn - 1.5, 2 * math.pi if whole else 3.0)
            canvas.add(layer, _circle(paper, arc))
            circles.append(Circle(layer, paper.origin, paper.scale * radius))
            names.append((gear, index, name, paper.scale * radius, turn))
    for layer in ("RACK", "OUTLINE"):
        draw(canvas, layer, fitted(canvas, curves[layer], paper.scale, asked.tolerance), paper)
    _, table = _areas(pages[-1], rows)
    corner = complex(pages[-1].frame.right - table.size[0], pages[-1].content.low)
    table.draw(pages[-1], corner + 1j * max(0.0, pages[-1].content.high - _TITLE - table.size[1] - corner.imag) * alone)
    _label(canvas, paper, room, gears, names, asked)
    beside = [Expected(page, paper, (), has_view=False) for page in pages[1:]]
    return [Expected(canvas, paper, tuple(circles), curves), *beside]


def _check(gears: list[SpurGear]) -> None:
    first = gears[0]
    if len(gears) > 2:
        raise ParameterError("parts", None, "disk_holds_two_wheels", count=len(gears))
    for gear in gears:
        if (gear.module, gear.number_of_teeth) != (first.module, first.number_of_teeth):
            sizes = {"module": first.module, "teeth": first.number_of_teeth}
            other = {"other_module": gear.module, "other_teeth": gear.number_of_teeth}
            raise ParameterError("parts", None, "one_disk_one_size", **sizes, **other)


def _teeth(gear: SpurGear, place: Placement2) -> list[Curve]:
    """The exact outline of the teeth that the rack has finished."""
    period = [s.curve for s in tooth_side(gear).profile().period]
    middle = TEETH // 2
    return [c.placed(place @ Placement2(k * gear.pitch_angle)) for k in range(-middle, TEETH - middle) for c in period]


def _rows(tables: Sheet, language: str) -> list[Row]:
    """The calculation as rows: a heading for each section, formula with numbers, result."""
    told = words(language)
    rows = []
    for section in tables.sections:
        rows.append(Row(told.say(section.title)))
        for step in section.steps:
            formula = f"{formula_text(step, told)} = {numbers_text(step, told)}" if step.formula else ""
            symbol = symbol_text(step.symbol, told)
            name = _lowered(told.decimal(f"{step_name(step, told)}, {symbol}"))
            formula, result = (_lowered(told.printed(cell)) for cell in (formula, result_text(step, told)))
            # the data of the device are given
            rows.append(Row(name, formula, result, answers=0 if section is tables.sections[0] else 2))
    return rows


def _lowered(text: str) -> str:
    """S_t1 and S1 with their indices lowered."""
    return re.sub(r"_(\w(?:[\w,]|\.(?=\d))*)|(?<=\b[^\W\d_])(\d)\b", lambda m: f"_{{{m[1] or m[2]}}}", text)


def _areas(sheet: Canvas, rows: list[Row]) -> tuple[Box, Table]:
    """Where disk and names may lie, mm, and the table: below it on upright paper, else on its right."""
    content = sheet.content
    upright = sheet.height > sheet.width
    most = content.wide if upright else content.wide / 2
    table = Table(tuple(rows), SMALL_TEXT, most)
    wide, tall = table.size
    low, right = (content.low + tall, content.right) if upright else (content.low, content.right - wide)
    return Box(content.left, low, right, content.high - _TITLE).grown(-_MARGIN), table


def _circle(paper: Paper, arc: Arc) -> Arc:
    made = paper.scaled(arc)
    assert isinstance(made, Arc)
    return made


def _label(
    canvas: Canvas,
    paper: Paper,
    room: Box,
    gears: list[SpurGear],
    names: list[tuple[SpurGear, int, str, float, float]],
    asked: Asked,
) -> None:
    labels = Labeller(canvas, room)
    labels.name("O", paper.origin, prefer=1 + 1j)
    for index, gear in enumerate(gears):
        key = "zero_wheel" if gear.profile_shift_coefficient == 0 else "shifted_wheel"
        way = 1j if index == 0 else -1j
        # on its own side of the axis
        labels.name(
            sheet_words(asked.language, key), paper.origin + 0.35 * paper.scale * gear.root_radius * way, prefer=1 + 0j
        )
        form, side = root_form_diameter(gear) / 2, tooth_side(gear)
        if not asked.by_hand and undercut(gear).margin < 0 and form - gear.base_radius > _SEEN_UNDERCUT * gear.module:
            at = next(
                complex(s.curve.point(t)) for s in side.segments for t in s.curve.domain
                if abs(abs(complex(s.curve.point(t))) - form) < 1e-9 * form
            )  # fmt: skip
            point = paper.point(at * cmath.exp(1j * (math.pi / 2 + math.pi * index)))
            labels.name(sheet_words(asked.language, "undercut"), point, prefer=point - paper.origin - 30)
    for _, index, name, radius, turn in names:
        suffix = str(index + 1) if len(gears) > 1 and name in ("tip", "root") else ""
        if index and not suffix:
            continue
        # names stand left of the disk for the wheel at the top, right for the one below
        spoke = cmath.exp(1j * (turn + (1.05 + 0.1 * _CIRCLES.index(name))))
        text = f"r_{{{_SYMBOLS[name]}{suffix}}}" if _SYMBOLS[name] + suffix else "r"
        labels.name(text, paper.origin + radius * spoke, prefer=-spoke)
