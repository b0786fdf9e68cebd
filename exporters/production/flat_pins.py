"""Pins of one piece with their plate, which a flat outline of it has as holes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geometry.plane.contour import Contour
from parts.base.part import Part

# mm: to which a file's digits tell where a hole stands
_SAME = 1e-5


def solid_pins(part: Part, contours: Sequence[Contour]) -> list[Contour]:
    """Where a flat outline has holes in place of pins of one piece: the holes on the pin circle; its outer one last."""
    if not any(f.code == "flat_pins" for f in part.flat_findings):
        return []
    radius = part.circles["pin_circle_diameter"] / 2
    centres = [complex(np.mean(c.expanded()[0])) for c in contours[:-1]]
    return [c for c, at in zip(contours, centres, strict=False) if abs(abs(at) - radius) < 1e-6 * radius + _SAME]
