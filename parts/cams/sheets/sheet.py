"""The sheet of a disk cam, practicum, lessons 4 and 5: diagrams of motion, least radius, profile, tables."""

from __future__ import annotations

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record
from geometry.cams.plane.graphical import LEAST_INTERVALS
from parts.cams.sheets.diagrams import LEFT, RIGHT, Drawn, draw_diagrams, heights_of
from parts.cams.sheets.joint import Joint, draw_joint, joint_of, joint_paper, joint_window, name_joint
from parts.cams.sheets.links import intervals_beside, linkage_cam_of, position_grid
from parts.cams.sheets.measures import CamMeasures
from parts.cams.sheets.picture import CamPicture, Scales, scales_of
from parts.cams.sheets.profile import draw_profile, name_profile, number_positions, profile_paper, profile_side
from parts.cams.sheets.swing import draw_swing, name_swing, swing_of, swing_window
from parts.cams.sheets.tables import ROW, WIDTH, Grid, characteristics, draw_grid, graphical_grid, legend, scale_rows
from parts.drawing.canvas import FRAME, FRAME_LEFT, PAPERS, SMALL_TEXT, TEXT_HEIGHT, Box, Canvas, Paper, scale_text
from parts.drawing.expected import Expected
from parts.drawing.labels import Labeller
from parts.pages.page import Sheet
from parts.texts.sheets import sheet_words

# a turn on the axis of abscissae, mm, on each paper
_TURNS = {"A2": 180.0, "A1": 360.0, "A0": 360.0}
_TITLE, _MARGIN, _CAPTION = 14.0, 4.0, 9.0
# between tables; rows of the scales and the meaning of lines with the gaps around them, mm
_GRID_GAP = 3.0
_SMALL_GRIDS = 17 * ROW + 3 * _GRID_GAP
# width and height of the main inscription, GOST 2.104, form 1: the lower right corner stays free for it, mm
INSCRIPTION = (185.0, 55.0)
# what tables may not use of a paper's height
_AROUND = 2 * FRAME + _TITLE + _MARGIN + INSCRIPTION[1]
# least height of the joint diagram
_LEAST_JOINT = 95.0


class _Layout(Record):
    """A sheet's paper and the areas on it, mm."""

    canvas: Canvas
    diagrams: Box
    joint: Box
    profile: Box
    tables: complex


def cam_sheet(name: str, picture: CamPicture, calculation: Sheet, tolerance: float) -> Expected:
    """The sheet of a cam; ``calculation`` is that of ``higherpair calc cam``, ``tolerance`` in mm on paper.

    Raises
    ------
    ParameterError
        The tables of so many intervals fit no paper.
    """
    joint, swing = joint_of(picture), swing_of(picture)
    first = characteristics(calculation, picture)
    graphical = graphical_grid(calculation, picture)
    linked = linkage_cam_of(picture)
    places = None if linked is None else position_grid(picture, linked)
    layout = _layout(picture, (first, graphical, places), has_joint=joint is not None or swing is not None)
    canvas = layout.canvas
    canvas.box("FRAME", canvas.frame)
    left = canvas.frame.left + 6.0
    canvas.write(
        f"{_title(picture)}: {name}", complex(left, canvas.frame.high - 9.0), 5.0, canvas.frame.right - left - 6.0
    )
    scales = scales_of(
        picture, layout.diagrams.right - layout.diagrams.left - LEFT - RIGHT, heights_of(layout.diagrams)
    )
    drawn = [draw_diagrams(canvas, picture, layout.diagrams, scales, tolerance)]
    paper = profile_paper(picture, layout.profile)
    made, circles, curves = draw_profile(canvas, picture, paper, tolerance)
    drawn.append(made)
    window, joint_place = None, None
    if joint is not None:
        joint_place, window = joint_paper(joint_window(picture, joint), layout.joint)
        drawn.append(draw_joint(canvas, picture, joint, joint_place, window, tolerance))
    elif swing is not None:
        joint_place, window = joint_paper(swing_window(picture, swing), layout.joint)
        drawn.append(draw_swing(canvas, picture, swing, joint_place, window, tolerance))
    _captions(canvas, picture, layout, joint_place, paper)
    corner = layout.tables
    scale = None if joint_place is None else joint_place.scale
    lines = legend(picture, has_return=joint is not None and joint.return_line is not None)
    for grid in (first, scale_rows(picture, scales, scale, paper.scale), lines, graphical, places):
        if grid is not None:
            draw_grid(canvas, corner, grid)
            corner -= 1j * (grid.height + _GRID_GAP)
    number_positions(canvas, picture, paper)
    name_profile(Labeller(canvas, layout.profile.grown(2.0)), picture, paper)
    if joint is not None and joint_place is not None and window is not None:
        name_joint(Labeller(canvas, layout.joint), picture, joint, joint_place, window)
    elif swing is not None and joint_place is not None:
        name_swing(Labeller(canvas, layout.joint), picture, swing, joint_place)
    measures = _measures(picture, scales, joint, joint_place, drawn)
    return Expected(canvas, paper, tuple(circles), curves, measures=measures)


def _measures(
    picture: CamPicture, scales: Scales, joint: Joint | None, place: Paper | None, drawn: list[Drawn]
) -> CamMeasures:
    curves = {layer: found for part in drawn for layer, found in part.curves.items()}
    lines = tuple(line for part in drawn for line in part.lines)
    low, high = picture.cam.motion.extremes(0)
    lift = (high - low) * picture.unit
    if joint is None or place is None:
        return CamMeasures(curves, lines, scales.lift, lift)
    return CamMeasures(
        curves, lines, scales.lift, lift, place, joint.offset if joint.order == 1 else 0.0, abs(joint.least)
    )


def _title(picture: CamPicture) -> str:
    how = "swing" if picture.swings else "slide"
    if linkage_cam_of(picture) is not None:
        how = "linkage"
    return sheet_words(picture.language, f"cam_{picture.cam.kind.value}_{how}")


def _layout(picture: CamPicture, grids: tuple[Grid | None, ...], *, has_joint: bool) -> _Layout:
    """The smallest paper that holds the tables and the profile in full size; A1 for a larger cam."""
    first, _, places = grids
    tables = sum(grid.height for grid in grids if grid) + _SMALL_GRIDS + (_GRID_GAP if places else 0.0)
    fitting = [name for name in _TURNS if tables <= PAPERS[name][0] - _AROUND]
    if not fitting:
        room = PAPERS["A0"][0] - _AROUND - _SMALL_GRIDS - (first.height if first else 0.0)
        phases = max(len(picture.drawn.phases) if picture.drawn else 1, 1)
        most = (int(room / ROW) - 2) // phases - 1
        if places:
            most = intervals_beside(picture, int((room - _GRID_GAP) / ROW))
        if most < LEAST_INTERVALS:
            raise ParameterError("parts", len(picture.cam.motion.phases), "more_phases_than_paper")
        raise ParameterError("intervals", picture.intervals, "table_fits_no_paper", Nearest(most, "at_most"))
    layouts = [_areas(name, picture, has_joint=has_joint) for name in fitting]
    for layout in layouts[:2]:
        if profile_paper(picture, layout.profile).scale >= 1:
            return layout
    return next((x for x in layouts if x.canvas.paper == "A1"), layouts[0])


def _areas(name: str, picture: CamPicture, *, has_joint: bool) -> _Layout:
    """Diagrams on the left, tables on the right, in between the joint diagram over the profile, which gets its need."""
    height, width = PAPERS[name]
    canvas = Canvas(width, height, name)
    low, high = FRAME + _MARGIN, height - FRAME - _TITLE
    # a linkage needs the room
    linked = linkage_cam_of(picture) is not None
    split = FRAME_LEFT + _MARGIN + LEFT + (_TURNS["A2"] if linked else _TURNS[name]) + RIGHT
    right = width - FRAME - WIDTH
    diagrams = Box(FRAME_LEFT + _MARGIN, low, split, high)
    foot, near, far = low + INSCRIPTION[1], split + _MARGIN, right - _MARGIN
    top = high - _CAPTION
    if linked:
        top -= _CAPTION
    if has_joint:
        room = top - _LEAST_JOINT - _MARGIN - _CAPTION - foot
        top = foot + profile_side(picture, min(room, far - near))
    profile = Box(near, foot, far, top)
    joint = Box(near, top + _CAPTION + _MARGIN, far, high - _CAPTION)
    return _Layout(canvas, diagrams, joint, profile, complex(right, high))


def _captions(canvas: Canvas, picture: CamPicture, layout: _Layout, joint: Paper | None, profile: Paper) -> None:
    language = picture.language
    if linkage_cam_of(picture) is not None:
        area, text = layout.profile, sheet_words(language, "no_joint")
        canvas.write(
            text, complex(area.left + 2.0, area.high + _CAPTION + 3.0), SMALL_TEXT, area.right - area.left - 4.0
        )
    for key, area, place in (("cam_profile", layout.profile, profile), ("cam_joint", layout.joint, joint)):
        if place is None:
            continue
        text = f"{sheet_words(language, key)}, M {scale_text(place.scale, language)}"
        canvas.write(text, complex(area.left + 2.0, area.high + 3.0), TEXT_HEIGHT, area.right - area.left - 4.0)
