"""A flat section moved out of its material."""

from __future__ import annotations

from collections.abc import Callable

from geometry.base.findings import Finding
from geometry.base.nearest import moved
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
    return moved(section, offset, "closes_tooth_spaces" if offset > 0 else "leaves_no_tooth")
