"""Sheets as a PDF: vector paths and words in an embedded font, a page each, the same bytes every time."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from contextlib import nullcontext
from datetime import UTC, datetime
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from exporters.drawings.write import beziers
from geometry.approximation.outline import CadCurve
from geometry.base.errors import Nearest, ParameterError
from geometry.base.tolerance import PDF_ROUNDING
from geometry.curves.line_arc import Arc, Line
from parts.drawing.canvas import STYLES, Canvas
from parts.drawing.font import CAPITAL, FONT

if TYPE_CHECKING:
    from fpdf.drawing import PaintedPath

POINT = 72 / 25.4
# an arc as a cubic of this sweep is off by 6e-9 of its radius, which grows with the sixth power of it
_SWEEP = math.radians(15)
_DATE = datetime(2000, 1, 1, tzinfo=UTC)


def check_pdf(tolerance: float) -> None:
    """Refuse to plan what cannot be written.

    Raises
    ------
    ParameterError
        What writes PDF is not installed, or does not write places so exactly.
    """
    if find_spec("fpdf") is None:
        raise ParameterError("format", "pdf", "needs_pdf")
    if tolerance < 2 * PDF_ROUNDING:
        raise ParameterError("tolerance", tolerance, "finer_than_pdf", Nearest(2 * PDF_ROUNDING, "at_least"))


def write_pdf(file: Path, pages: Sequence[Canvas], title: str) -> dict[str, int]:
    """Write sheets; counts of what is in them."""
    from fpdf import FPDF
    from fpdf.drawing import PaintedPath

    # in points: a scale of the page would be rounded to four decimals
    pdf = FPDF(unit="pt")
    pdf.set_creation_date(_DATE)
    pdf.set_title(title)
    pdf.add_font("sheet", fname=FONT)
    for canvas in pages:
        pdf.add_page(format=(canvas.width * POINT, canvas.height * POINT))
        pdf.set_auto_page_break(False)
        with pdf.drawing_context() as context:
            for name in canvas.layers:
                curves, style = [s.curve for s in canvas.strokes if s.layer == name], STYLES[name]
                path = PaintedPath()
                path.style.auto_close = False
                path.style.fill_color = None
                path.style.stroke_color = style.colour
                path.style.stroke_width = style.width * POINT
                path.style.stroke_dash_pattern = [d * POINT for d in style.dashes]
                for curve in curves:
                    _add(path, curve, canvas.height)
                # not a deep copy of it: nobody else has it
                context.add_item(path, False)
        for run in (run for text in canvas.texts for run in text.runs):
            pdf.set_font("sheet", size=run.height * POINT / CAPITAL)
            pdf.set_stretching(100.0)
            natural = pdf.get_string_width(run.text)
            pdf.set_stretching(100 * run.width * POINT / natural)
            x, y = run.at.real * POINT, (canvas.height - run.at.imag) * POINT
            with pdf.rotation(math.degrees(cmath.phase(run.way)), x, y) if run.way != 1 else nullcontext():
                pdf.text(x, y, run.text)
    pdf.output(str(file))
    strokes, texts = (sum(map(len, rows)) for rows in ([p.strokes for p in pages], [p.texts for p in pages]))
    return {"pages": len(pages), "paths": strokes, "texts": texts}


def _add(path: PaintedPath, curve: CadCurve, height: float) -> None:
    """A curve on paper, whose y runs down from the upper edge in PDF's writer."""

    def at(point: complex) -> tuple[float, float]:
        return point.real * POINT, (height - point.imag) * POINT

    if isinstance(curve, Line):
        path.move_to(*at(curve.start))
        path.line_to(*at(curve.end))
        return
    poles = _of_arc(curve) if isinstance(curve, Arc) else beziers(curve)
    path.move_to(*at(complex(curve.point(curve.domain[0]))))
    for a, b, c in poles:
        path.curve_to(*at(a), *at(b), *at(c))


def _of_arc(arc: Arc) -> list[tuple[complex, complex, complex]]:
    """The last three control points of each cubic of an arc."""
    count = max(math.ceil(abs(arc.sweep) / _SWEEP), 1)
    step = arc.sweep / count
    reach = 4 / 3 * math.tan(step / 4)
    found = []
    for k in range(count):
        first, last = (cmath.rect(arc.radius, arc.start_angle + step * (k + n)) for n in (0, 1))
        poles = (first * (1 + 1j * reach), last * (1 - 1j * reach), last)
        found.append((arc.centre + poles[0], arc.centre + poles[1], arc.centre + poles[2]))
    return found
