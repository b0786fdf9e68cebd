"""The sheet of a disk cam, practicum, lessons 4 and 5: diagrams of motion, least radius, profile, tables."""

from __future__ import annotations

from geometry.base.record import Draft, Record, field
from geometry.curves.curve import Curve
from parts.cams.sheets.diagrams import LEFT, RIGHT, Drawn, draw_diagrams, heights_of
from parts.cams.sheets.joint import Joint, joint_of, joint_paper
from parts.cams.sheets.links import linkage_cam_of, position_grid
from parts.cams.sheets.measures import CamMeasures
from parts.cams.sheets.picture import CamPicture, scales_of
from parts.cams.sheets.profile import (
    draw_profile,
    name_profile,
    number_positions,
    profile_paper,
    profile_side,
    reach_of,
)
from parts.cams.sheets.swing import swing_of
from parts.cams.sheets.tables import ROW, WIDTH, Grid, characteristics, draw_grid, graphical_grid, legend, scale_rows
from parts.drawing.canvas import SMALL_TEXT, TEXT_HEIGHT, Box, Canvas, Paper, scale_text
from parts.drawing.choice import Asked, blank, sheet_for
from parts.drawing.expected import Circle, Expected
from parts.drawing.labels import Labeller
from parts.pages.page import Sheet
from parts.texts.sheets import sheet_words

# papers that hold all of a cam, each with the length of a turn on its axis of abscissae, mm
_TURNS = {"A2": 180.0, "A1": 360.0, "A0": 360.0}
_TITLE, _MARGIN, _CAPTION = 14.0, 4.0, 9.0
# between tables, mm; rows of the scales, and what those over time add
_GRID_GAP = 3.0
_SCALES, _TIMES = 10, 3
# width and height of the main inscription, GOST 2.104, form 1: the lower right corner stays free for it, mm
INSCRIPTION = (185.0, 55.0)
# least height of the joint diagram
_LEAST_JOINT = 95.0
# the least base circle on paper, mm, below which a larger paper is better
_LEAST_RADIUS = 25.0
# rows of a table on a page before it goes on
_LEAST_ROWS = 6


class _Page(Draft):
    """A sheet with all that is drawn on it and must be read back."""

    canvas: Canvas
    drawn: list[Drawn] = field(default_factory=list)
    circles: list[Circle] = field(default_factory=list)
    curves: dict[str, list[Curve]] = field(default_factory=dict)
    joint: Paper | None = None


class _Place(Record):
    """An area, mm, on a page."""

    page: _Page
    area: Box


class _Layout(Record):
    """Where everything goes: all on one page, or diagrams, constructions and tables on pages of their own.

    ``tables``: columns for them, in turn; what finds no room there goes onto further pages.
    """

    diagrams: _Place
    joint: _Place
    profile: _Place
    tables: tuple[_Place, ...]


def cam_sheet(name: str, picture: CamPicture, calculation: Sheet, asked: Asked) -> list[Expected]:
    """The sheets of a cam: one, or several where the paper that is asked for is small.

    ``calculation`` is that of ``higherpair calc cam``.

    Raises
    ------
    ParameterError
        The paper is too small for the scale that is asked for.
    """
    joint, linked = joint_of(picture), linkage_cam_of(picture)
    diagram = joint or swing_of(picture)
    first = characteristics(calculation, picture)
    graphical = graphical_grid(calculation, picture)
    places = None if linked is None else position_grid(picture, linked)
    lines = legend(picture, has_return=joint is not None and joint.return_line is not None)
    heights = [g.height for g in (first, lines, graphical, places) if g]
    tall = sum(heights) + len(heights) * _GRID_GAP + ROW * (_SCALES + (0 if picture.speed_rpm is None else _TIMES))
    layout, paper = _layout(picture, tall, asked, has_joint=diagram is not None)
    pages = [layout.diagrams.page, layout.profile.page][: 1 if layout.tables else 2]
    scales = scales_of(picture, layout.diagrams.area.wide - LEFT - RIGHT,
                       heights_of(layout.diagrams.area))  # fmt: skip
    page = layout.diagrams.page
    page.drawn.append(draw_diagrams(page.canvas, picture, layout.diagrams.area, scales, asked))
    page = layout.profile.page
    base_given = any(x.given and x.name.endswith("base_circle_radius") for s in calculation.sections for x in s.steps)
    made, circles, curves = draw_profile(page.canvas, picture, paper, asked, base_given=base_given)
    page.drawn.append(made)
    page.circles += circles
    page.curves |= curves
    page = layout.joint.page
    seen = None if diagram is None else joint_paper(diagram.window(), layout.joint.area)
    if diagram is not None and seen is not None:
        page.joint = seen[0]
        page.drawn.append(diagram.draw(page.canvas, *seen, asked))
    _captions(picture, layout, paper)
    scale = None if page.joint is None else page.joint.scale
    grids = [g for g in (first, scale_rows(picture, scales, scale, paper.scale), lines, graphical, places) if g]
    pages += _flow(grids, layout, asked)
    for number, one in enumerate(pages, 1):
        one.canvas.head(f"{_title(picture)}: {name}" + (f" ({number}/{len(pages)})" if len(pages) > 1 else ""), 6.0)
    if not asked.by_hand:
        number_positions(layout.profile.page.canvas, picture, paper)
    labels = Labeller(layout.profile.page.canvas, layout.profile.area.grown(2.0))
    name_profile(labels, picture, paper, by_hand=asked.by_hand, base_given=base_given)
    if diagram is not None and seen is not None:
        diagram.name(Labeller(page.canvas, layout.joint.area), *seen, by_hand=asked.by_hand)
    lift = scales.lift, picture.cam.motion.lift * picture.unit
    # what students draw cannot be measured yet
    return [
        Expected(one.canvas, paper, tuple(one.circles), one.curves,
                 measures=None if asked.by_hand else _measures(one, joint, lift),
                 has_view=one is layout.profile.page)
        for one in pages
    ]  # fmt: skip


def _measures(page: _Page, joint: Joint | None, lift: tuple[float, float]) -> CamMeasures:
    """What must be measured off one page; ``lift``: scale and stroke of the diagrams."""
    curves = {layer: found for part in page.drawn for layer, found in part.curves.items()}
    lines = tuple(line for part in page.drawn for line in part.lines)
    if joint is None or page.joint is None:
        return CamMeasures(curves, lines, *lift)
    return CamMeasures(curves, lines, *lift, page.joint, joint.offset if joint.order == 1 else 0.0, abs(joint.least))


def _title(picture: CamPicture) -> str:
    how = "swing" if picture.swings else "slide"
    if linkage_cam_of(picture) is not None:
        how = "linkage"
    return sheet_words(picture.language, f"cam_{picture.cam.kind.value}_{how}")


def _layout(picture: CamPicture, tables: float, asked: Asked, *, has_joint: bool) -> tuple[_Layout, Paper]:
    """Where all goes, ``tables`` mm of tables in one column, and the place of the profile.

    One sheet of the smallest paper that holds all of it; several where the paper asked for does not, or none does.
    """

    around = _TITLE + _MARGIN + INSCRIPTION[1]
    contents = {name: blank(name, upright=False).content for name in _TURNS}
    whole = [name for name, content in contents.items() if tables <= content.tall - around]

    def layout_on(sheet: Canvas) -> _Layout:
        make = _areas if sheet.paper in whole else _pages
        return make(sheet, picture, has_joint=has_joint)

    def greatest(sheet: Canvas) -> float:
        on_one = sheet.paper in whole
        if (sheet.width > sheet.height) != on_one or (whole and not asked.paper and not on_one):
            return 0.0
        return profile_paper(picture, layout_on(sheet).profile.area).scale

    least = min(1.0, _LEAST_RADIUS / reach_of(picture, 1.0).prime)
    canvas, scale = sheet_for(asked, greatest, least)
    layout = layout_on(canvas)
    return layout, Paper(scale, profile_paper(picture, layout.profile.area).origin)


def _areas(canvas: Canvas, picture: CamPicture, *, has_joint: bool) -> _Layout:
    """Diagrams on the left, tables on the right, in between the joint diagram over the profile, which gets its need."""
    page, frame = _Page(canvas), canvas.frame
    low, high = frame.low + _MARGIN, frame.high - _TITLE
    # a linkage needs the room
    linked = linkage_cam_of(picture) is not None
    split = frame.left + _MARGIN + LEFT + (_TURNS["A2"] if linked else _TURNS[canvas.paper]) + RIGHT
    right = frame.right - WIDTH
    middle = Box(split + _MARGIN, low + INSCRIPTION[1], right - _MARGIN, high)
    joint, profile = _split(page, middle, picture, has_joint=has_joint)
    diagrams = _Place(page, Box(frame.left + _MARGIN, low, split, high))
    return _Layout(diagrams, joint, profile, (_Place(page, Box(right, low + INSCRIPTION[1], frame.right, high)),))


def _pages(sheet: Canvas, picture: CamPicture, *, has_joint: bool) -> _Layout:
    """The diagrams on a page, the constructions on another."""
    first, second = (_Page(blank(sheet.paper, upright=True, band=sheet.band)) for _ in range(2))
    content = sheet.content
    area = Box(content.left + _MARGIN, content.low + _MARGIN, content.right - _MARGIN, content.high - _TITLE)
    joint, profile = _split(second, area, picture, has_joint=has_joint)
    return _Layout(_Place(first, area), joint, profile, ())


def _split(page: _Page, area: Box, picture: CamPicture, *, has_joint: bool) -> tuple[_Place, _Place]:
    """The joint diagram over the profile, each below its caption."""
    top = area.high - _CAPTION
    if linkage_cam_of(picture) is not None:
        top -= _CAPTION
    if has_joint:
        room = top - _LEAST_JOINT - _MARGIN - _CAPTION - area.low
        top = area.low + profile_side(picture, min(room, area.wide))
    joint = Box(area.left, top + _CAPTION + _MARGIN, area.right, area.high - _CAPTION)
    return _Place(page, joint), _Place(page, Box(area.left, area.low, area.right, top))


def _flow(grids: list[Grid], layout: _Layout, asked: Asked) -> list[_Page]:
    """Draw tables from column to column, and on as many new pages as they need."""
    columns, pages = list(layout.tables), list[_Page]()
    paper = layout.profile.page.canvas.paper
    at: _Place | None = None
    top = 0.0
    if not columns:
        pages.append(_Page(blank(paper, upright=True, band=asked.band)))
        columns = _columns(pages[-1])
        grids = [grid.on_page(columns[0].area.wide, by_hand=asked.by_hand) for grid in grids]
    while grids:
        grid = grids[0]
        rows = len(grid.rows) if at is None else int((top - at.area.low) / grid.row + 1e-9)
        # a table goes on where it would not fit a column of its own
        if at is None or (rows < len(grid.rows) and (rows < _LEAST_ROWS or grid.height <= at.area.tall)):
            if not columns:
                pages.append(_Page(blank(paper, upright=True, band=asked.band)))
                columns = _columns(pages[-1])
            at = columns.pop(0)
            top = at.area.high
            continue
        done, rest = grid.cut(rows)
        draw_grid(at.page.canvas, complex(at.area.left, top), done)
        top -= done.height + _GRID_GAP
        grids = [rest, *grids[1:]] if rest.rows else grids[1:]
    return pages


def _columns(page: _Page) -> list[_Place]:
    """Columns of a page of tables."""
    content = page.canvas.content
    count = int((content.wide - 2 * _MARGIN) / (WIDTH + _MARGIN))
    low, high, left = content.low + _MARGIN, content.high - _TITLE, content.left + _MARGIN
    step = (content.right - left) / count
    return [_Place(page, Box(left + k * step, low, left + (k + 1) * step - _MARGIN, high)) for k in range(count)]


def _captions(picture: CamPicture, layout: _Layout, profile: Paper) -> None:
    language, canvas = picture.language, layout.profile.page.canvas
    area, joint = layout.profile.area, layout.joint.page.joint
    if linkage_cam_of(picture) is not None:
        at, most = complex(area.left + 2.0, area.high + _CAPTION + 3.0), area.wide - 4.0
        canvas.write(sheet_words(language, "no_joint"), at, SMALL_TEXT, most)
    for key, box, place in (("cam_profile", area, profile), ("cam_joint", layout.joint.area, joint)):
        if place is None:
            continue
        text = f"{sheet_words(language, key)}, M {scale_text(place.scale, language)}"
        canvas.write(text, complex(box.left + 2.0, box.high + 3.0), TEXT_HEIGHT, box.wide - 4.0)
