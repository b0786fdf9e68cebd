"""Which part of the plane a picture of meshing shows, how large, and on what paper."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import Record
from geometry.curves.curve import end_point, start_point
from geometry.gears.pictures.meshing import Body, MeshingPicture
from parts.drawing.canvas import SCALES, Box, Canvas, Paper, text_width
from parts.drawing.choice import Asked, sheet_for
from parts.drawing.table import Row, Table

# teeth drawn in the main position
TEETH = 3
# the least module on paper, mm, below which a larger paper is better
_LEAST_MODULE = 8.0
# above the picture, for the title; around it; from the picture to the names of its circles; mm
_TITLE, GAP, LEAD = 14.0, 3.0, 7.0
# what a broken line of centres takes for each axis beyond the window, mm
BREAK = 15.0
# the longest name of a circle
_NAME = "r_{w2} = 1000.00"


class View(Record):
    """The part of the plane that is drawn (model mm), where it lies on paper, and where words may stand."""

    window: Box
    paper: Paper
    room: Box

    @property
    def seen(self) -> Box:
        """The window on paper, mm."""
        low, high = (self.paper.point(complex(x, y)) for x, y in (
            (self.window.left, self.window.low), (self.window.right, self.window.high)))  # fmt: skip
        return Box(low.real, low.imag, high.real, high.imag)

    def shows(self, body: Body, name: str) -> bool:
        """Whether a circle of a body crosses the line of centres in the window."""
        return self.crosses(body, body.radii[name])

    def crosses(self, body: Body, radius: float) -> bool:
        """The same of a circle about its axis, or of a rack's line at this height, mm."""
        height = radius
        if body.centre is not None:
            height = body.centre.imag + (1 if is_up(body, self.window) else -1) * radius
        return self.window.low <= height <= self.window.high

    def holds(self, point: complex) -> bool:
        """Whether a point of the plane is drawn."""
        window = self.window
        return window.left <= point.real <= window.right and window.low <= point.imag <= window.high

    def beyond(self, picture: MeshingPicture) -> tuple[list[int], list[int]]:
        """The bodies whose axes lie below and above the window, the nearest first."""
        return _beyond(picture, self.window)


def layout(picture: MeshingPicture, module: float, rows: Sequence[Row], asked: Asked) -> tuple[Canvas, View]:
    """The sheet with the teeth as large as it allows, and with as much of the axes as then still has room.

    Raises
    ------
    ParameterError
        The paper that is asked for is too small.
    """
    windows = [_window(picture, module, depth) for depth in (2, 1, 0)]

    def greatest(sheet: Canvas) -> float:
        return _most(picture, windows[-1], sheet, rows)

    canvas, scale = sheet_for(asked, greatest, _LEAST_MODULE / module)
    window = next(w for w in windows if _most(picture, w, canvas, rows) >= scale or w is windows[-1])
    field = _field(picture, window, canvas, rows)
    origin = field.middle - scale * window.middle
    names, (below, above) = _names(canvas), _beyond(picture, window)
    room = Box(field.left - names, field.low - BREAK * len(below), field.right + names, field.high + BREAK * len(above))
    return canvas, View(window, Paper(scale, origin), room)


def _names(canvas: Canvas) -> float:
    """What the names of circles take on each side of the picture, mm."""
    return text_width(_NAME, canvas.letters) + LEAD + 1.0


def _field(picture: MeshingPicture, window: Box, canvas: Canvas, rows: Sequence[Row]) -> Box:
    """Where the window itself may lie, mm; the table stands below it on upright paper, else on its right."""
    content, (wide, tall) = canvas.content.grown(-GAP), Table(tuple(rows), canvas.letters).size
    names, (below, above) = _names(canvas), _beyond(picture, window)
    upright = canvas.height > canvas.width
    return Box(
        content.left + names,
        content.low + (tall if upright else 0.0) + BREAK * len(below),
        content.right - names - (0.0 if upright else wide),
        content.high - _TITLE + GAP - BREAK * len(above),
    )


def _most(picture: MeshingPicture, window: Box, canvas: Canvas, rows: Sequence[Row]) -> float:
    """The greatest standard scale at which a window fits; 0 for none."""
    field = _field(picture, window, canvas, rows)
    most = min(field.wide / window.wide, field.tall / window.tall)
    return next((s for s in SCALES if s <= most), 0.0)


def _beyond(picture: MeshingPicture, window: Box) -> tuple[list[int], list[int]]:
    middle = window.middle.imag
    axes = [(b.centre.imag, k) for k, b in enumerate(picture.bodies) if b.centre is not None]
    axes.sort(key=lambda pair: abs(pair[0] - middle))
    return [k for y, k in axes if y < window.low], [k for y, k in axes if y > window.high]


def _window(picture: MeshingPicture, module: float, depth: int) -> Box:
    """What must be seen, model mm: teeth and contact; from depth 1 on N1 and N2, at depth 2 the axes too."""
    points: list[complex] = [picture.on_line(s) for s in (picture.start, picture.end, picture.pole)]
    for s in (picture.start, picture.end):
        for body in picture.bodies:
            points += [end(c) for c in body.tooth_at(s) for end in (start_point, end_point)]
    for body in picture.bodies:
        points += [end(c) for c in body.chain(picture.shown, TEETH) for end in (start_point, end_point)]
    arc = picture.arc_of_action
    points += [complex(arc.point(t)) for t in (0.0, arc.sweep / 2, arc.sweep)]
    # room for the dimension arcs inside the bodies
    points += [complex(0, p.imag + sign * 1.2 * module) for p in points for sign in (-1, 1)]
    if depth >= 1:
        points += [p for p in picture.tangent_points if p is not None]
    if depth >= 2:
        points += [b.centre for b in picture.bodies if b.centre is not None]
    return Box.of(points).grown(0.6 * module)


def is_up(body: Body, window: Box) -> bool:
    """Whether the mesh lies above the body's axis."""
    assert body.centre is not None
    return body.centre.imag < window.middle.imag or body.centre == 0
