"""What a STEP file tells of its solid, volume, area and precision, against what is measured on it, bounds too."""

from __future__ import annotations

import numpy as np

from exporters.formats.read_solid import ROUND, Model
from exporters.formats.read_step import ReadSolid
from exporters.formats.read_surfaces import area_of
from exporters.verification.planes import plane_failures
from exporters.verification.verdict import Verdict, precision_failures, volume_failures
from parts.base.texts import fault

# into how many pieces spans of splines are cut, one after the other, until their area is the one that is told
_PIECES = 1, 2, 4, 8
# what an area is good to, part of it, and how far a file's rounding moves the bounds of faces, mm
_AREA, _LAST_DECIMAL = 1e-9, 1e-9


def told_verdict(found: ReadSolid, exact: float, bound: float, precision: float) -> Verdict:
    """What a file tells of its solid, and its cylinders; ``exact`` volume, ``bound`` by which it may differ, mm^3."""
    model, said = found.model, found.said
    volume = float(model.flux.sum())
    failures = (
        *volume_failures(volume, exact, bound, said.get("volume")),
        *precision_failures(found.precision, precision),
        *area_failures(model, said.get("surface area")),
        *plane_failures(model),
    )
    cylinders = np.count_nonzero((model.kind == ROUND) & (model.sizes[:, 1] == 0))
    measured = {"volume": volume, "volume_error": volume / exact - 1, "volume_bound": bound / exact}
    return Verdict(measured | {"cylinders": float(cylinders)}, failures)


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
