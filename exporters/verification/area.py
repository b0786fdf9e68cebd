"""The area that a STEP file tells of its faces, against what is measured on them."""

from __future__ import annotations

from exporters.formats.read_solid import Model
from exporters.formats.read_surfaces import area_of
from parts.base.texts import fault

# into how many pieces spans of splines are cut, one after the other, until their area is the one that is told
_PIECES = 1, 2, 4, 8
# what an area is good to, part of it, and how far a file's rounding moves the bounds of faces, mm
_AREA, _LAST_DECIMAL = 1e-9, 1e-9


def area_failures(model: Model, said: str | float | None) -> list[str]:
    """What is wrong with the area, mm^2, that a file tells, if it does."""
    if said is None:
        return []
    bounds, before = model.bounds, None
    for pieces in _PIECES:
        area = area_of(model, pieces)
        # where a surface has all but an edge within, finer pieces change what is measured
        change = 0.0 if before is None else abs(area - before)
        if abs(float(said) - area) <= _AREA * area + _LAST_DECIMAL * bounds + change:
            return []
        before = area
    return [fault("says that its surface area is {said} mm^2 instead of {area:.12g} mm^2", said=said, area=area)]
