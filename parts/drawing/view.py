"""Which part of the plane a picture of meshing shows, how large, and on what paper."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import Record
from geometry.curves.curve import Curve
from geometry.gears.pictures.meshing import Body, MeshingPicture
from parts.drawing.canvas import FRAME, FRAME_LEFT, PAPERS, SCALES, Box, Canvas, Paper
from parts.drawing.table import Row, table_size

# teeth drawn in the main position
TEETH = 3
# on both sides of the picture, for the names of circles, mm
NAMES = 34.0
# the least module on paper, mm, below which more of the axes is left off the sheet
_LEAST_MODULE = 12.0
# above the picture, for the title; around it; mm
_TITLE, GAP = 14.0, 6.0


class View(Record):
    """The part of the plane that is drawn (model mm), where it lies on paper, and what of the axes it holds."""

    window: Box
    paper: Paper
    room: Box

    def shows(self, body: Body, name: str) -> bool:
        """Whether a circle of a body crosses the line of centres in the window."""
        if body.centre is None:
            return self.window.low <= body.radii[name] <= self.window.high
        height = body.centre.imag + (1 if is_up(body, self.window) else -1) * body.radii[name]
        return self.window.low <= height <= self.window.high


def layout(picture: MeshingPicture, module: float, rows: Sequence[Row], band: float = 0.0) -> tuple[Canvas, View]:
    """The smallest sheet on which the teeth can be seen, with as much of the axes as they leave room for.

    ``band``: height that a title block takes, mm.
    """
    # the scale, and base circles that lie off the sheet
    table = table_size([*rows, *[Row("")] * 3])
    best: tuple[float, str, bool, Box] | None = None
    for depth in (2, 1, 0):
        window = _window(picture, module, depth)
        for name in ("A3", "A2", "A1"):
            for upright in (False, True):
                scale = _greatest_scale(window, _field(name, upright, table, band))
                enough = scale * module >= _LEAST_MODULE
                better = best is None or scale > best[0] * 1.01
                if (enough or (depth == 0 and name == "A1")) and better:
                    best = scale, name, upright, window
            if best is not None and best[0] * module >= _LEAST_MODULE:
                break
        if best is not None and best[0] * module >= _LEAST_MODULE:
            break
    assert best is not None
    scale, name, upright, window = best
    size = PAPERS[name]
    width, height = size if upright else size[::-1]
    canvas = Canvas(width, height, name, band=band)
    left, low, right, high = _field(name, upright, table, band)
    middle = complex(left + right, low + high) / 2
    origin = middle - scale * complex(window.left + window.right, window.low + window.high) / 2
    room = Box(left - NAMES, low, right + NAMES, high)
    return canvas, View(window, Paper(scale, origin), room)


def _field(name: str, upright: bool, table: tuple[float, float], band: float) -> tuple[float, float, float, float]:
    """Where the picture itself may lie: left, low, right, high, mm; the table stands below it or on its right."""
    size = PAPERS[name]
    width, height = size if upright else size[::-1]
    left, right = FRAME_LEFT + NAMES + 2, width - FRAME - NAMES - 2
    low, high = FRAME + GAP + band, height - FRAME - _TITLE
    if upright:
        return left, low + table[1], right, high
    return left, low, right - table[0], high


def _greatest_scale(window: Box, field: tuple[float, float, float, float]) -> float:
    left, low, right, high = field
    most = min((right - left) / (window.right - window.left), (high - low) / (window.high - window.low))
    return next((s for s in SCALES if s <= most), most)


def _window(picture: MeshingPicture, module: float, depth: int) -> Box:
    """What must be seen, model mm: teeth and contact; from depth 1 on N1 and N2, at depth 2 the axes too."""
    points: list[complex] = [picture.on_line(s) for s in (picture.start, picture.end, picture.pole)]
    for s in (picture.start, picture.end):
        for body in picture.bodies:
            points += [ends_of(c)[k] for c in body.tooth_at(s) for k in (0, 1)]
    for body in picture.bodies:
        points += [ends_of(c)[k] for c in body.chain(picture.shown, TEETH) for k in (0, 1)]
    arc = picture.arc_of_action
    points += [complex(arc.point(t)) for t in (0.0, arc.sweep / 2, arc.sweep)]
    # room for the dimension arcs inside the bodies
    points += [complex(0, p.imag + sign * 1.2 * module) for p in points for sign in (-1, 1)]
    if depth >= 1:
        points += [p for p in picture.tangent_points if p is not None]
    if depth >= 2:
        points += [b.centre for b in picture.bodies if b.centre is not None]
    xs, ys = [p.real for p in points], [p.imag for p in points]
    pad = 0.6 * module
    return Box(min(xs) - pad, min(ys) - pad, max(xs) + pad, max(ys) + pad)


def ends_of(curve: Curve) -> tuple[complex, complex]:
    """First and last point of a curve."""
    a, b = curve.domain
    return complex(curve.point(a)), complex(curve.point(b))


def is_up(body: Body, window: Box) -> bool:
    """Whether the mesh lies above the body's axis."""
    assert body.centre is not None
    return body.centre.imag < (window.low + window.high) / 2 or body.centre == 0
