"""Working drawings whose sizes have no room: told at once, before any is laid out."""

from __future__ import annotations

from typing import Any

import pytest

from geometry.base.errors import ParameterError
from parts.drawing import part_sheet
from parts.drawing.choice import Asked
from parts.drawing.dimensioning import ROWS, laid, least_rows
from parts.drawing.working import View
from tests.parts.drawing.test_sections import drawing_of

ASKED = Asked("en", 1e-6)


def slotted(columns: int, rows: int) -> dict[str, Any]:
    """A plate of many slots, no two of which have the same middle."""
    slots = [
        {"start": [10.0 * i - 95.0, 9.5 * j - 140.0], "end": [10.0 * i - 90.0, 9.5 * j - 140.0], "width": 2.0}
        for i in range(columns) for j in range(rows)
    ]  # fmt: skip
    frame = {"points": [[-110, -150], [110, -150], [110, 150], [-110, 150]]}
    return {"kind": "layered", "layers": [{"thickness": 4.0, "polygons": [frame], "slots": slots}]}


def test_more_sizes_over_one_place_than_there_are_rows_are_refused_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before: 7 s of layouts at six scales, and no number told."""
    drawing = drawing_of(slotted(20, 30))

    def tried(*_: object, **__: object) -> None:
        raise AssertionError("a layout was tried")

    monkeypatch.setattr(part_sheet, "laid", tried)
    with pytest.raises(ParameterError) as refused:
        part_sheet.part_sheet(drawing, (), 3.2, ASKED)
    assert (refused.value.code, refused.value.numbers) == ("sizes_fit_no_paper", {"count": 21, "most": ROWS})
    with pytest.raises(AssertionError):
        part_sheet.part_sheet(drawing_of(slotted(2, 3)), (), 3.2, ASKED)


@pytest.mark.parametrize("columns", [1, 3, 8])
def test_no_view_that_is_laid_out_takes_fewer_rows(columns: int) -> None:
    """What is told beforehand is never more than what the layout takes: rows as they are seen on paper."""
    view: View = drawing_of(slotted(columns, 2)).views[0]
    made = laid(view, 1.0, "en")
    assert made is not None
    found = made.canvas.dimensions
    upright = {round(one.line.real, 3) for one in found if one.angle}
    level = {round(one.line.imag, 3) for one in found if not one.angle}
    assert 1 <= least_rows(view) <= max(len(upright), len(level))
