"""A part: parameters turned into exact sections, ready for every exporter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from geometry.findings import Finding
from geometry.gears.offset_tooth import OffsetRegion


@dataclass(frozen=True, slots=True)
class Part:
    """A plate of one exact section, ``face_width`` mm thick, lower face at z = 0.

    ``section(offset)`` gives the exact region with every boundary moved ``offset`` mm out of the material.
    ``circles`` are named diameters in mm for drawings and reports, ``quantities`` all other named results.
    """

    id: str
    kind: str
    face_width: float
    section: Callable[[float], OffsetRegion]
    findings: tuple[Finding, ...] = ()
    circles: dict[str, float] = field(default_factory=dict)
    quantities: dict[str, float] = field(default_factory=dict)
    material: str | None = None
    colour: str | None = None
