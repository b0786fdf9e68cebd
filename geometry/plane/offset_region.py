"""A flat section moved out of its material."""

from __future__ import annotations

import math
from collections.abc import Callable

from geometry.base.errors import GeometryError, OffsetError
from geometry.base.findings import Finding
from geometry.base.nearest import last_that_holds
from geometry.base.record import Record
from geometry.plane.profile import Region


class OffsetRegion(Record):
    """The section of a part, every boundary moved outwards by ``offset`` mm, and what was noticed."""

    region: Region
    offset: float
    findings: tuple[Finding, ...]


def moved_teeth(section: Callable[[float], OffsetRegion], offset: float) -> OffsetRegion:
    """What ``section`` gives for an offset, mm, of a part with teeth.

    Raises
    ------
    ParameterError
        The part itself cannot exist.
    OffsetError
        The offset closes the spaces or leaves no tooth, or what else refuses it; names the nearest one that works.
    """
    if not math.isfinite(offset):
        raise OffsetError(offset, "not_finite", 0.0)
    try:
        return section(offset)
    except GeometryError as refusal:
        if offset == 0:
            raise
        section(0.0)
        word = "closes_tooth_spaces" if offset > 0 else "leaves_no_tooth"
        reason = refusal.reason if isinstance(refusal, OffsetError) else word
        raise OffsetError(offset, reason, last_that_holds(section, offset)) from refusal
