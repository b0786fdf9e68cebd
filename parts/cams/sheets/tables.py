"""Tables of a cam's sheet: the calculation's own numbers, scales, and the graphical method beside the exact motion."""

from __future__ import annotations

import math
import re

from geometry.base.record import Record, replace
from geometry.cams.plane.coupler import LinkageCam
from parts.base.texts import words
from parts.cams.sheets.picture import CamPicture, Scales
from parts.drawing.canvas import SMALL_TEXT, Box, Canvas, decimal, scale_text, text_width
from parts.pages.page import Section, Sheet, unit_text
from parts.pages.symbols import lowered, symbol_text
from parts.pages.text import result_text, step_name
from parts.texts.sheets import sheet_words

# height of a row, and of one that is filled with a pen, mm
ROW, PEN_ROW = 4.5, 7.0
WIDTH = 126.0
_COLUMNS = (82.0, 12.0, 32.0)
_INDENT = 1.2
# steps of the calculation that the sheet's other rows say already
_PHASES = {"rise_angle_deg", "return_angle_deg"}
# sizes that a scene gives, beside the characteristics
_GIVEN = re.compile("curvature_reserve|(driven|guide|coupler|follower)_(?!swing).*")
_LEFT_OUT = {
    "working_angle_deg", "lift_of_phase", "swing_of_phase_deg", "jerk_coefficient", "graphical_intervals",
    "greatest_cam_radius",
}  # fmt: skip


class Grid(Record):
    """Columns (mm) and rows of cells; a row of one cell is a heading; ``samples``: layers whose line a row shows.

    ``heads``: rows that stand above what is cut off too.
    """

    columns: tuple[float, ...]
    rows: tuple[tuple[str, ...], ...]
    samples: tuple[tuple[int, str], ...] = ()
    answers: tuple[int, ...] = ()
    row: float = ROW
    heads: int = 1

    @property
    def height(self) -> float:
        """mm."""
        return self.row * len(self.rows)

    def on_page(self, width: float, *, by_hand: bool) -> Grid:
        """As wide as a page of tables has room for; with rows for a pen where there is something to find."""
        share = width / sum(self.columns)
        high = PEN_ROW if by_hand and any(self.answers) else ROW
        return replace(self, columns=tuple(share * column for column in self.columns), row=high)

    def cut(self, rows: int) -> tuple[Grid, Grid]:
        """The first ``rows`` and the rest, under the same heads."""
        rest = (*self.rows[: self.heads], *self.rows[rows:]) if rows < len(self.rows) else ()
        left = (*self.answers[: self.heads], *self.answers[rows:]) if rest else ()
        return (
            replace(self, rows=self.rows[:rows], answers=self.answers[:rows]),
            replace(self, rows=rest, answers=left),
        )


def characteristics(calculation: Sheet, picture: CamPicture) -> Grid:
    """The steps of ``higherpair calc cam``, section by section."""
    told = words(picture.language)
    rows: list[tuple[str, ...]] = []
    answers: list[int] = []
    for section in calculation.sections:
        rows.append((told.say(section.title),))
        answers.append(0)
        for step in section.steps:
            # an angle of a phase stands among the characteristics
            if step.name in _LEFT_OUT or (step.name in _PHASES and _is_law(section)):
                continue
            cells = lowered(symbol_text(step.symbol, told)), result_text(step, told)
            rows.append((step_name(step, told), *(told.decimal(cell) for cell in cells)))
            # the characteristics are given, the sizes of the scene, and the coefficients of the laws
            given = section is calculation.sections[0] or step.given or _GIVEN.fullmatch(step.name)
            answers.append(1 if not given and (step.formula or not _is_law(section)) else 0)
    return Grid(_COLUMNS, tuple(rows), answers=tuple(answers))


def _is_law(section: Section) -> bool:
    return any(step.name == "velocity_coefficient" for step in section.steps)


def scale_rows(picture: CamPicture, scales: Scales, joint: float | None, profile: float) -> Grid:
    """Scales of all pictures, and the pole distances that follow by (4.3) and (4.4)."""
    language, told = picture.language, words(picture.language)

    def word(key: str) -> str:
        return sheet_words(language, key)

    unit = "deg" if picture.swings else "mm"
    name = "ψ" if picture.swings else "S"
    rows: list[tuple[str, ...]] = [(word("scales"),)]
    mm = unit_text("mm", told)
    degrees = decimal(f"{scales.phi_deg:g} °/{mm}", language)
    rows.append((word("scale_phi"), "μ_{φ}", decimal(f"{scales.phi:.6f} {unit_text('rad', told)}/{mm}", language)))
    rows.append((word("scale_phi_deg"), "μ_{φ}", degrees))
    for order in range(3):
        u = unit_text(unit + ("", "/rad", "/rad2")[order], told)
        text = f"{scales.of(order):g} {f'({u})' if '/' in u else u}/{mm}"
        rows.append((word(f"scale_{order}"), f"μ_{{{name}{order * chr(39)}}}", decimal(text, language)))
    for k, pole in enumerate(scales.poles, 1):
        rows.append((word(f"pole_{k}"), f"H_{{{k}}}", f"{picture.say(pole, 3)} {mm}"))
    if picture.speed_rpm is not None:
        rows += _time_rows(picture, scales)
    if joint is not None:
        rows.append((word("scale_joint"), "M", scale_text(joint, language)))
    rows.append((word("scale_profile"), "M", scale_text(profile, language)))
    return Grid(_COLUMNS, tuple(rows))


def _time_rows(picture: CamPicture, scales: Scales) -> list[tuple[str, ...]]:
    """Scales that make the same diagrams those of S(t), v(t) and a(t): mu_phi / omega, mu_S' omega, mu_S'' omega^2."""
    assert picture.speed_rpm is not None
    omega, language = math.pi * picture.speed_rpm / 30, picture.language
    # mm to m for accelerations, degrees to rad for a rocker
    small, large = (math.radians(1.0),) * 2 if picture.swings else (1.0, 1e-3)
    units = ("rad/s", "rad/s2") if picture.swings else ("mm/s", "m/s2")
    rows: list[tuple[str, ...]] = []
    for key, symbol, value, unit in (
        ("scale_time", "μ_{t}", scales.phi / omega, "s"),
        ("scale_velocity", "μ_{v}", scales.rate * omega * small, units[0]),
        ("scale_acceleration", "μ_{a}", scales.bend * omega**2 * large, units[1]),
    ):
        shown = unit_text(unit, words(language))
        text = f"{value:.6g} {f'({shown})' if '/' in shown else shown}/{unit_text('mm', words(language))}"
        rows.append((sheet_words(language, key), symbol, decimal(text, language)))
    return rows


def legend(picture: CamPicture, *, has_return: bool) -> Grid:
    """What the lines mean that have no name of their own."""
    layers = ["CAM"] + ["PITCH_CURVE"] * bool(picture.cam.radius) + ["GRAPHICAL"] * (picture.drawn is not None)
    layers += ["RETURN_TANGENT"] * has_return + ["FOLLOWER"] * isinstance(picture.cam, LinkageCam)
    rows = tuple((sheet_words(picture.language, layer.lower()), "") for layer in layers)
    return Grid((_COLUMNS[0], sum(_COLUMNS[1:])), rows, tuple(enumerate(layers)))


def graphical_grid(calculation: Sheet, picture: CamPicture) -> Grid | None:
    """The calculation's table of the graphical method, with the errors of S' and S."""
    table = next((t for t in calculation.tables if t.name == "graphical"), None)
    if table is None:
        return None
    name, told = "ψ" if picture.swings else "S", words(picture.language)
    bends, rates, lifts = (unit_text(table.heads[k][1], told) for k in (2, 3, 5))
    heads = ("№", "φ", f"{name}''_{{g}}", f"{name}'_{{g}}", f"{name}'", f"Δ{name}'", f"{name}_{{g}}", name, f"Δ{name}")
    units = ("", "°", bends, rates, rates, rates, lifts, lifts, lifts)
    rows: list[tuple[str, ...]] = [(told.say(table.title),), heads, units]
    say = picture.say
    for number, phi, bend, rate, exact_rate, lift, exact in table.rows:
        rows.append((f"{number:.0f}", say(phi), say(bend), say(rate), say(exact_rate), say(rate - exact_rate, 3),
                     say(lift), say(exact), say(lift - exact, 3)))  # fmt: skip
    columns = (9.0, 15.0, 15.0, 14.0, 14.0, 16.0, 14.0, 14.0, 15.0)
    return Grid(columns, tuple(rows), answers=(0, 0, 0, *[7] * len(table.rows)), heads=3)


def draw_grid(canvas: Canvas, corner: complex, grid: Grid) -> None:
    """A grid with its upper left corner at ``corner``; columns of numbers flush right."""
    width, top = sum(grid.columns), corner.imag
    canvas.box("TABLE", Box(corner.real, top - grid.height, corner.real + width, top))
    many = len(grid.columns) > 3
    for index, row in enumerate(grid.rows):
        y = top - grid.row * (index + 1)
        if index:
            canvas.line("TABLE", complex(corner.real, y + grid.row), complex(corner.real + width, y + grid.row))
        x = corner.real
        for k, (cell, wide) in enumerate(zip(row, grid.columns, strict=False)):
            room = (width if len(row) == 1 else wide) - 2 * _INDENT
            length = min(text_width(cell, SMALL_TEXT), room)
            at = x + wide - _INDENT - length if many and len(row) > 1 else x + _INDENT
            if cell:
                answer = bool(grid.answers) and k >= len(row) - grid.answers[index]
                canvas.write(cell, complex(at, y + (grid.row - SMALL_TEXT) / 2 + 0.1), SMALL_TEXT, room, answer=answer)
            if k:
                canvas.line("TABLE", complex(x, y), complex(x, y + grid.row))
            x += wide
    for index, layer in grid.samples:
        y = top - grid.row * (index + 0.5)
        canvas.line(layer, complex(corner.real + grid.columns[0] + 3.0, y), complex(corner.real + width - 3.0, y))
