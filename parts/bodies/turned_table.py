"""The table of what is turned and has more corners than sizes can tell: where each is, how far from the axis."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.errors import Nearest, ParameterError
from geometry.solids.turned import HalfSection
from parts.base.part import Part
from parts.base.texts import N_
from parts.bodies.turned_drawing import told_corners
from parts.pages.data_table import DataRow, DataTable, Mated
from parts.pages.inputs import SceneKeys
from parts.pages.page import Table

# rows for which the largest paper has room
_MOST = 400


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable | None:
    """Place along the axis, diameter, radius of the arc to the next corner; None where sizes tell all.

    Raises
    ------
    ParameterError
        No paper has room for so many.
    """
    half = part.thing
    assert isinstance(half, HalfSection)
    corners = told_corners(part)
    if not corners:
        return None
    if len(corners) > _MOST:
        key = "steps" if part.kind == "shaft" else "points"
        raise ParameterError(key, len(corners), "corners_fit_no_paper", Nearest(_MOST, "at_most"))
    low, _ = half.heights()
    rows = [(float(k), corner.at.real - low, 2 * corner.at.imag, corner.arc) for k, corner in enumerate(corners, 1)]
    heads = [("n", ""), ("z", "mm"), ("d", "mm"), ("R", "mm")]
    told = [DataRow(N_("corners of the section"), "z", N_("from the left end"))]
    if any(corner.arc for corner in corners):
        told.append(DataRow(N_("arc to the next corner, below 0 into the material"), "R", N_("by the table")))
    count = 2 + len(told)
    return DataTable((tuple(told),), Table("corners", "", tuple(heads[:count]), tuple(row[:count] for row in rows)))
