"""The sheet of a train (guidelines, figure 5): its kinematic scheme to scale, the plans of velocities, the table."""

from __future__ import annotations

from geometry.base.record import Record, replace
from parts.drawing.canvas import Box, Canvas, Paper, decimal, scale_text
from parts.drawing.choice import Asked, sheet_for
from parts.drawing.expected import Expected
from parts.drawing.labels import Labeller
from parts.drawing.table import Row, Table
from parts.mates.sheets.scheme import Scheme, scheme_width
from parts.mates.sheets.train_picture import TrainPicture
from parts.mates.sheets.velocities import PlanMeasures, draw_plans, name_plans, plans_of
from parts.texts.sheets import sheet_words

_TITLE, _GAP = 14.0, 6.0
# least width of the plan of velocities, least sides of that of angular velocities, mm
_PLAN, _ANGLES = 70.0, 60.0
# the least wheel on paper, mm, below which larger paper is better; rings have a back, and a frame about it
_LEAST_WHEEL, _BACKS = 10.0, 14.0


class _Areas(Record):
    """Where the scheme, both plans and the table's lower left corner lie."""

    scheme: Box
    plan: Box
    angles: Box
    table: complex


def _areas(sheet: Canvas, table: Table, scheme: float) -> _Areas:
    """On upright paper the table and the plan of angular velocities stand below, else on the right."""
    content, (wide, tall) = sheet.content.grown(-_GAP), table.size
    corner = complex(sheet.content.right - wide, sheet.content.low)
    high, low = sheet.content.high - _TITLE, content.low
    if sheet.height > sheet.width:
        angles = Box(content.left, low, corner.real - _GAP, low + max(tall, _ANGLES))
        low, right = angles.high + 2 * _GAP, content.right
    else:
        angles = Box(corner.real + _GAP, low + tall + _GAP, content.right, high - _GAP)
        right = corner.real - _GAP
    split = content.left + scheme
    return _Areas(Box(content.left, low, split, high), Box(split + _GAP, low, right, high), angles, corner)


def train_sheet(title: str, train: TrainPicture, told: list[str], asked: Asked) -> Expected:
    """The sheet; ``told``: the part of each rim.

    Raises
    ------
    ParameterError
        The paper that is asked for is too small, or none is large enough.
    """
    language, wide = asked.language, scheme_width(train)
    rows = _rows(train, told, language)
    low, high = train.reach()
    later = [Row(sheet_words(language, "velocity_scale"), "μ_{v}", "0.0025")] * 3

    def areas_on(sheet: Canvas) -> _Areas:
        return _areas(sheet, Table((*rows, *later), sheet.letters), wide)

    def greatest(sheet: Canvas) -> float:
        areas = areas_on(sheet)
        if areas.plan.wide < _PLAN or min(areas.angles.wide, areas.angles.tall) < _ANGLES:
            return 0.0
        return max(areas.scheme.tall - _BACKS, 0.0) / (high - low)

    smallest = min(2 * train.radius(k) for k in range(len(train.rims)))
    canvas, scale = sheet_for(asked, greatest, _LEAST_WHEEL / smallest)
    areas = areas_on(canvas)
    base = areas.scheme.middle.imag - scale * (high + low) / 2
    canvas.head(f"{sheet_words(language, 'train')}: {title}", _GAP)
    scheme = Scheme(canvas, train, lambda h: base + scale * h, areas.scheme.left)
    scheme.draw()
    plans = plans_of(train, scheme.y, scale, areas.plan.grown(-_GAP), areas.angles.grown(-_GAP))
    _transfer(canvas, train, scheme, plans.line)
    draw_plans(canvas, plans, areas.plan, areas.angles, by_hand=asked.by_hand)
    rows += [
        Row(sheet_words(language, "scheme_scale"), "", scale_text(scale, language), answers=0),
        Row(sheet_words(language, "velocity_scale"), "μ_{v}", decimal(f"{plans.velocity:g}", language), answers=0),
        Row(sheet_words(language, "angular_scale"), "μ_{ω}", decimal(f"{plans.angular:g}", language), answers=0),
    ]
    table = Table(tuple(rows), canvas.letters)
    table.draw(canvas, complex(canvas.content.right - table.size[0], canvas.content.low))
    labels = Labeller(canvas, replace(canvas.content, high=canvas.content.high - _TITLE))
    for mark, at in scheme.marks.items():
        teeth = {rim.name: rim.teeth for rim in train.rims}.get(mark)
        labels.name(mark if teeth is None else f"{mark} (z = {teeth})", at, prefer=1 + 0.3j)
    name_plans(labels, plans, areas.plan, areas.angles, by_hand=asked.by_hand)
    # what students draw cannot be measured yet
    return Expected(canvas, Paper(scale, 1j * base), (), measures=None if asked.by_hand else PlanMeasures(plans))


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
        Row(f"{part}: {teeth}", f"z_{{{rim.name}}}", str(rim.teeth), answers=0)
        for part, rim in zip(told, train.rims, strict=True)
    ]
    driver = train.links[train.driver]
    others = [link for link in train.links if link is not driver]
    rows += [Row(sheet_words(language, "held"), "", link.name, answers=0) for link in others if not link.rate]
    # practicum (2.1): each moving link has one axis; where meshes follow from others it counts too few
    freedom = sum(bool(link.rate) or link.carrier is not None for link in train.links) - len(train.meshes)
    if freedom > 0:
        rows.append(Row(sheet_words(language, "mobility"), "W", str(freedom)))
    for link in others:
        if link.rate:
            ratio = decimal(f"{float(1 / link.rate):.7g}", language)
            rows.append(Row(sheet_words(language, "train_ratio"), f"u_{{{driver.name}{link.name}}}", ratio))
    return rows
