"""The blocking contour as a picture of a page: SVG for paper and browser, letters for a terminal."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

from geometry.base.record import Record
from geometry.curves.implicit import Box
from geometry.gears.shifts.external import BlockingContour, ContourLine
from geometry.gears.shifts.finder import AnyShiftPair, least_margin
from geometry.gears.shifts.internal import InternalRequirements
from geometry.gears.shifts.internal_shifts import InternalShiftPair
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.ring import RoundedRoot
from geometry.gears.teeth.transverse import normal_angle
from parts.base.psv import rows_of
from parts.base.texts import N_, Message, Text, Words, message
from parts.pages.svg import chain, circle, document, written

_SIZE, _LEFT, _TOP, _BOTTOM, _KEY = 560.0, 60.0, 40.0, 50.0, 430.0
_GRID = "stroke:#dde2e6;stroke-width:0.7"
# a choice of shifts x1, x2 with its words
Mark = tuple[Text, tuple[float, float]]


class ContourPicture(Record):
    """A blocking contour with the choices that are marked in it."""

    contour: BlockingContour
    marks: tuple[Mark, ...]

    def svg(self, words: Words) -> str:
        """The picture in a language."""
        return contour_svg(self.contour, self.shown(words), words)

    def letters(self, words: Words) -> str:
        """The picture in letters, with the numbers of a language."""
        return contour_text(self.contour, {f"{n}": at for n, (_, at) in enumerate(self.marks, 1)}, words)

    def shown(self, words: Words) -> dict[str, tuple[float, float]]:
        """The marks that lie in the picture, numbered, by their words in a language."""
        box = self.contour.box
        return {
            f"{n}: {words.say(told)}": at
            for n, (told, at) in enumerate(self.marks, 1)
            if box.left <= at[0] <= box.right and box.bottom <= at[1] <= box.top
        }


class Style(Record):
    """Colour and dashes of a line, its name."""

    colour: str
    dashes: str
    name: str


STYLES = {name: Style(*cells) for name, *cells in rows_of(__file__, "contour_lines")}
# the tighter the level the fainter the line
_OPACITY = {0.0: 1.0, 0.25: 0.75, 0.3: 0.6, 0.4: 0.4, 1.0: 1.0, 1.1: 0.7, 1.2: 0.45}


def line_name(name: str) -> Message:
    """A line of the contour, or a condition, in words."""
    return message(STYLES[name if name in STYLES else name.replace("active_flank", "fillet_interference")].name)


def line_title(name: str, level: float | None, words: Words) -> str:
    """A line of the contour in words, with its level."""
    unit = " m" if name.startswith("tip") and level else ""
    return words.say(line_name(name)) + ("" if level is None else words.decimal(f" = {level:g}{unit}"))


def grid_step(box: Box) -> float:
    """Modules between the grid lines of a picture."""
    size = max(box.right - box.left, box.top - box.bottom)
    return next(s for s in (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0) if size / s <= 14)


def clipped(points: Sequence[complex], box: Box) -> list[list[complex]]:
    """A chain of points cut off at a box, where it leaves it."""
    pieces = [list(points)]
    sides: tuple[Callable[[complex], float], ...] = (
        lambda p: p.real - box.left,
        lambda p: box.right - p.real,
        lambda p: p.imag - box.bottom,
        lambda p: box.top - p.imag,
    )
    for side in sides:
        pieces = [cut for piece in pieces for cut in _cut_off(piece, side)]
    return pieces


def _cut_off(points: list[complex], side: Callable[[complex], float]) -> list[list[complex]]:
    """The pieces of a chain on which ``side`` is not below a rounding of 0."""
    pieces: list[list[complex]] = []
    run: list[complex] = []
    for one, two in pairwise(points):
        a, b = side(one), side(two)
        if a >= -1e-9:
            run = run or [one]
        if (a >= -1e-9) != (b >= -1e-9):
            border = one + (two - one) * a / (a - b)
            run.append(border)
        if b >= -1e-9:
            run.append(two)
        elif run:
            pieces.append(run)
            run = []
    return [*pieces, run] if run else pieces


def contour_svg(contour: BlockingContour, marks: dict[str, tuple[float, float]], words: Words) -> str:
    """The contour with its legal region filled, ``marks`` (name: x1, x2) as points, and a key."""
    box = contour.box
    scale = _SIZE / max(box.right - box.left, box.top - box.bottom)
    width, height = (box.right - box.left) * scale, (box.top - box.bottom) * scale

    def at(point: complex) -> tuple[float, float]:
        return _LEFT + (point.real - box.left) * scale, _TOP + (box.top - point.imag) * scale

    lines = []
    rings = (" L ".join(f"{x:.2f},{y:.2f}" for x, y in map(at, ring)) for ring in contour.region)
    region = " ".join(f"M {ring} Z" for ring in rings)
    if region:
        lines.append(f'<path d="{region}" style="fill:#e4f2e4;fill-rule:evenodd;stroke:none"/>')
    lines += _axes(contour, scale, width, height, words)
    for line in contour.lines:
        style = STYLES[line.name]
        for piece in clipped(line.points, box):
            lines.append(chain(map(at, piece), f"fill:none;{_stroke(line, style)}"))
    lines += _key(contour, marks, _LEFT + width + 20, words)
    for name, (x1, x2) in marks.items():
        x, y = at(complex(x1, x2))
        lines.append(circle(x, y, 4, "fill:#d00060;stroke:#ffffff;stroke-width:1", "g"))
        lines.append(written(x + 6, y - 5, name.split(":")[0], "#d00060"))
    told = len(kinds_shown(contour)) + len(marks) + 6
    return document(_LEFT + width + _KEY, max(_TOP + height + _BOTTOM, 19.0 * told + _TOP), lines)


def _stroke(line: ContourLine, style: Style) -> str:
    opacity = 1.0 if line.level is None else _OPACITY.get(line.level, 1.0)
    dashes = f";stroke-dasharray:{style.dashes}" if style.dashes else ""
    return f"stroke:{style.colour};stroke-width:1.4;stroke-opacity:{opacity:g}{dashes}"


def kinds_shown(contour: BlockingContour) -> list[ContourLine]:
    """One line of each name and level that reaches into the box, in order."""
    found: dict[tuple[str, float | None], ContourLine] = {}
    for line in contour.lines:
        if clipped(line.points, contour.box):
            found.setdefault((line.name, line.level), line)
    return list(found.values())


def _key(contour: BlockingContour, marks: dict[str, tuple[float, float]], left: float, words: Words) -> list[str]:
    lines, y = [], _TOP + 4
    for line in kinds_shown(contour):
        style = STYLES[line.name]
        lines.append(
            f'<line x1="{left:.1f}" y1="{y:.1f}" x2="{left + 34:.1f}" y2="{y:.1f}" style="{_stroke(line, style)}"/>'
        )
        lines.append(written(left + 42, y + 4, line_title(line.name, line.level, words)))
        y += 19
    y += 8
    lines.append(f'<rect x="{left:.1f}" y="{y - 8:.1f}" width="34" height="12" style="fill:#e4f2e4;stroke:#a0c0a0"/>')
    lines.append(written(left + 42, y + 3, region_text(contour, words)))
    for text in tool_texts(contour.pair, words):
        y += 19
        lines.append(written(left, y + 3, text))
    y += 19
    for name, (x1, x2) in marks.items():
        lines.append(f'<circle cx="{left + 17:.1f}" cy="{y:.1f}" r="4" style="fill:#d00060"/>')
        lines.append(written(left + 42, y + 4, words.phrase(f"{name}: {x1:.4f} / {x2:.4f}")))
        y += 19
    return lines


def region_text(contour: BlockingContour, words: Words) -> str:
    """What the region keeps."""
    wish = contour.requirements
    asked = [f"ε ≥ {wish.contact_ratio:g}", f"S_a ≥ {wish.tip_thickness:g} m"]
    if isinstance(wish, InternalRequirements):
        asked.append(f"c ≥ {wish.tip_clearance:g} m")
    return words.printed(words.text("region: {conditions}", conditions=", ".join(asked)))


def tool_texts(pair: AnyShiftPair, words: Words) -> list[str]:
    """Rack, tip rule and cutter for which the contour holds."""
    rack = pair.rack
    # of the normal section, as scenes have it
    share = math.cos(pair.helix_angle)
    alpha, height = math.degrees(normal_angle(rack.pressure_angle, pair.helix_angle)), rack.addendum / share
    shape = f"α = {alpha:g}°, h_a* = {height:g}, c* = {rack.tip_clearance / share:g}"
    lines = [f"{shape}, ρ_f* = {rack.tip_radius / share:.4g}"]
    if pair.helix_angle:
        lines.append(f"β = {math.degrees(pair.helix_angle):g}°, ε_β = {pair.overlap_ratio:.4g}")
    if not isinstance(pair, InternalShiftPair):
        return [*map(words.printed, lines)]
    rule = "k_2 = 0" if pair.plain_tip else "k_2 = 0.25 - 0.125 x_2"
    lines.append(f"r_a2 = r_2 - ({pair.ring_addendum:g} - x_2 - k_2) m, {rule}")
    tools = ((N_("cutter of the ring: {sizes}"), pair.root), (N_("cutter of the pinion: {sizes}"), pair.pinion_cutter))
    for whose, tool in tools:
        if isinstance(tool, PinionCutter):
            sizes = (
                f"z_0 = {tool.number_of_teeth}, x_0 = {tool.profile_shift_coefficient / share:g}, "
                f"h_a0* = {tool.addendum / share:g}, ρ_0* = {tool.tip_rounding / share:.4g}"
            )
            lines.append(words.text(whose, sizes=sizes))
        elif isinstance(tool, RoundedRoot):
            radius = words.term("radius", "full") if tool.radius is None else f"{tool.radius / share:g} m"
            sizes = f"h_f2* = {tool.dedendum / share:g}, ρ = {radius}"
            lines.append(words.text("rounded root of the ring: {sizes}", sizes=sizes))
    return [*map(words.printed, lines)]


def _axes(contour: BlockingContour, scale: float, width: float, height: float, words: Words) -> list[str]:
    box, lines = contour.box, []
    step = grid_step(box)
    for k in range(math.ceil(box.left / step), math.floor(box.right / step) + 1):
        x = _LEFT + (k * step - box.left) * scale
        heavy = "stroke:#808890;stroke-width:1" if k == 0 else _GRID
        lines.append(f'<line x1="{x:.2f}" y1="{_TOP:g}" x2="{x:.2f}" y2="{_TOP + height:.2f}" style="{heavy}"/>')
        lines.append(written(x - 10, _TOP + height + 16, words.decimal(f"{k * step:g}"[:5])))
    for k in range(math.ceil(box.bottom / step), math.floor(box.top / step) + 1):
        y = _TOP + (box.top - k * step) * scale
        heavy = "stroke:#808890;stroke-width:1" if k == 0 else _GRID
        lines.append(f'<line x1="{_LEFT:g}" y1="{y:.2f}" x2="{_LEFT + width:.2f}" y2="{y:.2f}" style="{heavy}"/>')
        lines.append(written(_LEFT - 34, y + 4, words.decimal(f"{k * step:g}"[:5])))
    teeth = contour.pair.teeth
    lines.append(written(_LEFT, 22, f"z1 = {teeth[0]}, z2 = {teeth[1]}", size=15))
    lines.append(written(_LEFT + width - 20, _TOP + height + 34, "x1", size=14))
    lines.append(written(_LEFT - 34, _TOP - 12, "x2", size=14))
    return lines


def contour_text(
    contour: BlockingContour, marks: dict[str, tuple[float, float]], words: Words, columns: int = 61
) -> str:
    """The legal region in letters: # legal, . not; a proposal as its number; x1 to the right, x2 upwards."""
    box = contour.box
    rows = max(3, round(columns * (box.top - box.bottom) / (box.right - box.left) / 2))
    numbers = {}
    for index, (x1, x2) in enumerate(marks.values(), 1):
        column = round((x1 - box.left) / (box.right - box.left) * (columns - 1))
        row = round((x2 - box.bottom) / (box.top - box.bottom) * (rows - 1))
        numbers[column, row] = str(index)
    lines = []
    for row in reversed(range(rows)):
        x2 = box.bottom + (box.top - box.bottom) * row / (rows - 1)
        letters = ""
        for column in range(columns):
            x1 = box.left + (box.right - box.left) * column / (columns - 1)
            inside = least_margin(contour.pair, contour.requirements, x1, x2) >= 0
            letters += numbers.get((column, row), "#" if inside else ".")
        lines.append(f"{words.decimal(f'{x2:.2f}'):>6} {letters}")
    left, right = (words.decimal(f"{end:.2f}") for end in (box.left, box.right))
    foot = left.ljust(columns - 6) + right.rjust(6)
    return "\n".join([*lines, f"       {foot}  x1"])
