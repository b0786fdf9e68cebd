"""The sheet of a train, seed 001, figure 5: its kinematic scheme to scale, the plans of velocities, the table."""

from __future__ import annotations

from parts.drawing.canvas import FRAME, FRAME_LEFT, PAPERS, SCALES, Box, Canvas, Paper, decimal, scale_text
from parts.drawing.expected import Expected
from parts.drawing.labels import Labeller
from parts.drawing.table import Row, draw_table, table_size
from parts.mates.sheets.scheme import Scheme, scheme_width
from parts.mates.sheets.train_picture import TrainPicture
from parts.mates.sheets.velocities import PlanMeasures, draw_plans, name_plans, plans_of
from parts.texts.sheets import sheet_words

_TITLE, _GAP = 14.0, 8.0
# least width of the plan of velocities, least height of that of angular velocities, mm
_PLAN, _ANGLES = 85.0, 80.0
_COLUMNS = (82.0, 14.0, 24.0)


def train_sheet(title: str, train: TrainPicture, told: list[str], language: str, band: float = 0.0) -> Expected:
    """The sheet; ``told``: the part of each rim; ``band``: height that a title block takes, mm."""
    rows = _rows(train, told, language)
    # two scales come below
    width, height = table_size([*rows, *[Row("")] * 3], _COLUMNS)
    name = next(
        (n for n in ("A3", "A2", "A1") if _fits(n, width, height, band, scheme_width(train))),
        "A0",
    )
    canvas = Canvas(PAPERS[name][1], PAPERS[name][0], name, band=band)
    canvas.box("FRAME", canvas.frame)
    content, right = canvas.content, canvas.frame.right - width
    heading = f"{sheet_words(language, 'train')}: {title}"
    most = content.right - content.left - 2 * _GAP
    canvas.write(heading, complex(content.left + _GAP, content.high - 9.0), 5.0, most)
    low, high = content.low + _GAP + 6.0, content.high - _TITLE - 8.0
    scale, base = _heights(train, low, high)
    scheme = Scheme(canvas, train, lambda h: base + scale * h, content.left + _GAP)
    scheme.draw()
    plan = Box(content.left + scheme_width(train) + 2 * _GAP, low - 4.0, right - 2 * _GAP, high + 4.0)
    angles = Box(right + _GAP, content.low + height + 2 * _GAP + 8.0, canvas.frame.right - _GAP, high - _GAP)
    plans = plans_of(train, scheme.y, scale, plan.grown(-_GAP), angles.grown(-4.0))
    _transfer(canvas, train, scheme, plans.line)
    draw_plans(canvas, plans, plan, angles)
    rows += [
        Row(sheet_words(language, "scheme_scale"), "", scale_text(scale, language)),
        Row(sheet_words(language, "velocity_scale"), "μ_{v}", decimal(f"{plans.velocity:g}", language)),
        Row(sheet_words(language, "angular_scale"), "μ_{ω}", decimal(f"{plans.angular:g}", language)),
    ]
    draw_table(canvas, complex(right, content.low), rows, _COLUMNS)
    labels = Labeller(canvas, Box(content.left, content.low, content.right, content.high - _TITLE))
    for mark, at in scheme.marks.items():
        teeth = {rim.name: rim.teeth for rim in train.rims}.get(mark)
        labels.name(mark if teeth is None else f"{mark} (z = {teeth})", at, prefer=1 + 0.3j)
    name_plans(labels, plans, plan, angles)
    return Expected(canvas, Paper(scale, 1j * base), (), measures=PlanMeasures(plans))


def _fits(name: str, width: float, height: float, band: float, scheme: float) -> bool:
    """Whether a sheet has room for the table below the plan of angular velocities, beside scheme and plan."""
    tall, wide = PAPERS[name]
    room = tall - 2 * FRAME - band - _TITLE - 2 * _GAP
    return height + _ANGLES <= room and wide - FRAME_LEFT - FRAME - width - scheme - 4 * _GAP >= _PLAN


def _heights(train: TrainPicture, low: float, high: float) -> tuple[float, float]:
    """The scale of the heights, and where on paper the height 0 lies, mm."""
    ends = [train.links[r.link].axis + s * train.radius(k) for k, r in enumerate(train.rims) for s in (1, -1)]
    # rings have a back, and a frame about it
    most = (high - low - 14.0) / (max(ends) - min(ends))
    scale = next((s for s in SCALES if s <= most), most)
    return scale, (low + high) / 2 - scale * (max(ends) + min(ends)) / 2


def _transfer(canvas: Canvas, train: TrainPicture, scheme: Scheme, line: float) -> None:
    """Thin lines that carry the heights of axes and pitch points over to the pole line."""
    heights = {h for link in range(len(train.links)) for h in train.heights(link)}
    for height in sorted(heights):
        y = scheme.y(height)
        layer = "CENTRE" if any(link.axis == height for link in train.links) else "CONSTRUCTION"
        canvas.line(layer, complex(scheme.left, y), complex(line, y))


def _rows(train: TrainPicture, told: list[str], language: str) -> list[Row]:
    teeth = sheet_words(language, "number_of_teeth")
    rows = [
        Row(f"{part}: {teeth}", f"z_{{{rim.name}}}", str(rim.teeth)) for part, rim in zip(told, train.rims, strict=True)
    ]
    driver = train.links[train.driver]
    for link in train.links:
        if link is driver:
            continue
        name = f"u_{{{driver.name}{link.name}}}"
        if link.rate:
            ratio = decimal(f"{float(1 / link.rate):.7g}", language)
            rows.append(Row(sheet_words(language, "train_ratio"), name, ratio))
        else:
            rows.append(Row(sheet_words(language, "held"), link.name))
    return rows
