"""A flat section moved out of its material."""

from __future__ import annotations

from dataclasses import dataclass

from geometry.base.findings import Finding
from geometry.plane.profile import Region


@dataclass(frozen=True, slots=True)
class OffsetRegion:
    """The section of a part, every boundary moved outwards by ``offset`` mm, and what was noticed."""

    region: Region
    offset: float
    findings: tuple[Finding, ...]
