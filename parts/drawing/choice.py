"""Which paper a picture gets, and its scale there: what the scene asks for, else the smallest that holds it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record
from parts.drawing.canvas import FRAME, FRAME_LEFT, SCALES, Canvas, scale_name
from parts.keys.sheet import scale_value

# width and height of the upright sheet, mm; GOST 2.301, whose A4 stands upright only
PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0), "A0": (841.0, 1189.0)}


class Asked(Record):
    """What a scene asks of a sheet: the words on it, how exact (mm on paper), paper and scale (None: as it fits).

    ``band``: height that a title block takes, mm; ``by_hand``: cells of answers are empty, to be filled with a pen.
    """

    language: str
    tolerance: float
    band: float = 0.0
    paper: str | None = None
    scale: str | None = None
    by_hand: bool = False


def blank(name: str, *, upright: bool, band: float = 0.0, margins: tuple[float, float] = (FRAME_LEFT, FRAME)) -> Canvas:
    """An empty sheet."""
    width, height = PAPERS[name] if upright else PAPERS[name][::-1]
    return Canvas(width, height, name, band=band, margins=margins)


def sheet_for(
    asked: Asked,
    greatest: Callable[[Canvas], float],
    least: float,
    holds: Callable[[Canvas, float], bool] | None = None,
) -> tuple[Canvas, float]:
    """The sheet of a picture and its scale.

    ``greatest``: the greatest scale at which a sheet holds the picture, 0 where it holds none; ``least``: the scale
    below which a larger paper is better, where the scene leaves both open; ``holds``: whether a sheet holds it at a
    scale, where it may hold none at a smaller one than the greatest: words do not shrink.

    Raises
    ------
    ParameterError
        The paper is too small, no paper is large enough, or no scale.
    """
    given = None if asked.scale is None else scale_value(asked.scale)

    def most_on(sheet: Canvas) -> float:
        if given is None or holds is None:
            return greatest(sheet)
        return given if holds(sheet, given) else 0.0

    def sheets(name: str) -> list[Canvas]:
        """Both ways in which a paper may lie."""
        return [
            blank(name, upright=upright, band=asked.band) for upright in ((True, False) if name != "A4" else (True,))
        ]

    @cache
    def best(name: str) -> tuple[float, Canvas]:
        """The greatest scale on a paper, and how it lies."""
        mosts = ((most_on(sheet), sheet) for sheet in sheets(name))
        found = [(next((s for s in SCALES if s <= most * (1 + 1e-9)), 0.0), sheet) for most, sheet in mosts]
        return max(found, key=lambda pair: pair[0])

    def holding(scale: float) -> Iterator[str]:
        return (name for name in PAPERS if best(name)[0] >= scale)

    def other_scale() -> float:
        """The scale that some paper holds, the nearest to the one that none does; 0 where there is none."""
        if given is None or holds is None:
            return max(best(name)[0] for name in PAPERS)
        near = sorted(SCALES, key=lambda scale: abs(math.log(scale / given)))
        blanks = [sheet for name in PAPERS for sheet in sheets(name)]
        return next((scale for scale in near if any(holds(sheet, scale) for sheet in blanks)), 0.0)

    lowest = given or SCALES[-1]
    # larger papers are tried only where no smaller one does
    name = asked.paper or next(holding(max(lowest, given or least)), None)
    if name is None or best(name)[0] < lowest:
        large = list(holding(lowest))
        if not large:
            scale = other_scale()
            if given is not None and scale:
                small = scale > given
                nearest = Nearest(scale_name(scale), "at_least" if small else "at_most")
                code = "fits_no_scale_so_small" if small else "fits_no_paper_so_large"
                raise ParameterError("scale", asked.scale, code, nearest)
            raise ParameterError("paper", asked.paper, "fits_no_paper")
        if asked.paper is not None:
            code = "paper_too_small" if given is None else "paper_too_small_for_scale"
            raise ParameterError("paper", asked.paper, code, Nearest(large[0], "at_least"), scale=asked.scale)
        name = max(large, key=lambda n: best(n)[0])
    scale, sheet = best(name)
    return sheet, given or scale
