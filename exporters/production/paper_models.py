"""Paper models of flat parts: their outlines as lines and arcs, 1:1, on sheets of a PDF."""

from __future__ import annotations

import numpy as np

from exporters.production.request import Request
from geometry.approximation.chords import approximate_profile
from geometry.curves.line_arc import Arc, Line
from geometry.plane.contour import Contour
from parts.drawing.choice import Asked
from parts.drawing.expected import Expected
from parts.drawing.names import caption_name
from parts.drawing.tiles import Edge, model_pages

# an arc as flat is half that share of its chord off it, and its centre lost in the rounding of its radius
_FLAT = 1e-8


def paper_models(wanted: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The sheets of the parts that are wanted, all of them by default."""
    outlines, exact, errors = {}, {}, {}
    for part in (wanted.parts[name] for name in wanted.wanted):
        called = caption_name(part)
        name = called if called not in outlines else f"{called} {part.id}"
        profiles = part.section(0.0).region.profiles()
        made = [approximate_profile(p, asked.tolerance, arcs=True) for p in profiles]
        exact[name] = profiles
        outlines[name] = [edge for one in made for edge in _edges(one.geometry)]
        errors[name] = max(one.max_error for one in made)
    pages = model_pages(wanted.title, outlines, exact, errors, asked.paper or "A4", asked.language)
    return [("", page) for page in pages]


def _edges(contour: Contour) -> list[Edge]:
    """The lines and arcs of a contour."""
    vertices, bulges = contour.expanded()
    return [
        Line(start, end) if abs(bulge) <= _FLAT else _arc(start, end, bulge)
        for start, end, bulge in zip(vertices.tolist(), np.roll(vertices, -1).tolist(), bulges.tolist(), strict=True)
    ]


def _arc(start: complex, end: complex, bulge: float) -> Arc:
    """An arc by its ends and its bulge, tan(sweep / 4)."""
    chord, sweep = end - start, 4 * float(np.arctan(bulge))
    # the centre stands off the chord's middle by chord / 2 cot(sweep / 2), to the left where the arc turns left
    spoke = chord / 2 * (-1 - 1j * (1 - bulge * bulge) / (2 * bulge))
    return Arc(start - spoke, abs(spoke), float(np.angle(spoke)), sweep)
