"""What a wedge cam is told of itself: its sizes, its angles, and where it is poor."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geometry.findings import Finding

if TYPE_CHECKING:
    from geometry.cams.wedge import WedgeCam
    from parts.wedge_cam import WedgeCamSpec

# usual limits of the pressure angle, degrees: sliding and swinging followers
_USUAL_PRESSURE_ANGLE = {False: 30.0, True: 45.0}
# jumps below this part of lift / travel^k are rounding
_JUMP = 1e-9


def wedge_quantities(spec: WedgeCamSpec, cam: WedgeCam) -> dict[str, float]:
    """Named results of a wedge: sizes in mm, angles in degrees."""
    import numpy as np

    from geometry.cams.wedge import sharpest_crest

    low, high = cam.motion.extremes()
    found = {"swing_deg": math.degrees(high - low)} if spec.oscillating else {"lift": high - low}
    found["travel"] = cam.motion.travel
    if cam.radius > 0:
        found["follower_radius"] = cam.radius
    found["pressure_angle_deg"] = math.degrees(_steepest(cam))
    crest = sharpest_crest(cam)
    if np.isfinite(crest):
        found["least_curvature_radius"] = crest - cam.radius
    return found


def _steepest(cam: WedgeCam) -> float:
    """Greatest pressure angle, rad; upright at the greatest |S'|."""
    import numpy as np

    found = [0.0]
    for piece in cam.motion.pieces:
        if piece.is_constant:
            continue
        travel = np.union1d(np.linspace(*piece.domain, 257), piece.extremes(1))
        found.append(float(np.abs(cam.pressure_angle(np.minimum(travel, np.nextafter(piece.end, 0)))).max()))
    return max(found)


def wedge_findings(spec: WedgeCamSpec, cam: WedgeCam) -> tuple[Finding, ...]:
    """Impacts where the velocity or the acceleration jumps, and a steep pressure angle."""
    found, pieces = [], cam.motion.pieces
    low, high = cam.motion.extremes()
    for order, name in ((1, "rigid"), (2, "soft")):
        # the follower rests before and after the travel
        sides = [(float(p.value(p.start, order)), float(p.value(p.end, order))) for p in pieces]
        ends = [0.0, *(end for _, end in sides)]
        starts = [*(start for start, _ in sides), 0.0]
        places = [*(p.start for p in pieces), cam.motion.travel]
        jumps = [(abs(b - a), at) for a, b, at in zip(ends, starts, places, strict=True)]
        size, at = max(jumps)
        if size > _JUMP * (high - low) / cam.motion.travel**order:
            found.append(Finding(f"wedge_{name}_impact", size, at))
            break
    usual, steepest = _USUAL_PRESSURE_ANGLE[spec.oscillating is not None], math.degrees(_steepest(cam))
    if steepest > usual + 1e-9:
        found.append(Finding("steep_pressure_angle", steepest, usual))
    return tuple(found)
