"""A gear as the device TMM-42 draws it: the rack's successive positions on a paper disk; practicum, lesson 1.

In the gear's frame the rack rolls on the reference circle. Its tooth k belongs to the middle gamma_k of a space; after
rolling to the polar angle theta that tooth is r (gamma_k - theta) away from the line of centres.
"""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.curves.line_arc import Arc, Line
from geometry.gears.teeth.spur import SpurGear

# rack positions of one wheel that a sheet can still show
_MOST_POSITIONS = 2000


def rack_tooth(gear: SpurGear) -> tuple[Line | Arc, ...]:
    """Contour of one tooth of the cutting rack, mm: x outwards from its datum line, y along it, centred on y = 0.

    From root to root: flank (and relief), rounding, tip, rounding, flank. A rack that thins is wider here too.
    """
    rack, m = gear.rack, gear.module
    alpha, wide = (
        rack.pressure_angle,
        gear.root_land_half_angle * gear.reference_radius / m - rack.rounding_half_distance,
    )
    base = math.pi / 4 + wide
    centre = complex(-rack.rounding_depth, rack.rounding_half_distance + wide)
    joint = complex(-rack.form_dedendum, base - rack.form_dedendum * math.tan(alpha))
    outer = rack.addendum + rack.tip_clearance
    corner = rack.addendum - (rack.relief.height if rack.relief else -rack.tip_clearance)
    points = [complex(corner, base + corner * math.tan(alpha)), joint]
    if rack.relief is not None:
        reach = (outer - corner) * math.tan(rack.relief_angle)
        points.insert(0, complex(outer, points[0].imag + reach))
    half: list[Line | Arc] = [Line(m * a, m * b) for a, b in pairwise(points)]
    if rack.tip_radius > 0:
        half.append(Arc(m * centre, m * rack.tip_radius, math.pi / 2 + alpha, math.pi / 2 - alpha))
    edge = complex(-rack.dedendum, centre.imag)
    middle = [Line(m * edge, m * edge.conjugate())] if centre.imag > 1e-12 else []
    return (*half, *middle, *(c.mirrored() for c in reversed(half)))


def rack_positions(gear: SpurGear, step: float, teeth: int) -> list[float]:
    """Polar angles of the line of centres, rad, a rack's step (mm) apart, that finish ``teeth`` teeth about tooth 1.

    Raises
    ------
    ParameterError
        The step asks for more positions than a sheet can show, or leaves no profile to be seen: it is more than half
        of the pitch. Names one that works.
    """
    most = math.pi * gear.module / 2
    if step > most:
        raise ParameterError.beyond("rack_step", step, "step_above_half_pitch", most)
    reach = (teeth / 2 + 1) * math.pi * gear.module
    if reach / step > _MOST_POSITIONS / 2:
        raise ParameterError.beyond("rack_step", step, "too_many_positions", 2 * reach / _MOST_POSITIONS)
    count = math.ceil(reach / step)
    return [k * step / gear.reference_radius for k in range(-count, count + 1)]


def rack_contours(gear: SpurGear, disk_radius: float, step: float, teeth: int) -> list[list[Line | Arc]]:
    """The rack's contours inside a disk, in the gear's frame, mm: a list of curves for each position that meets it.

    Only the rack teeth beside the ``teeth`` teeth about tooth 1 are drawn, as the device's rack has no more.
    """
    contour, radius = rack_tooth(gear), gear.reference_radius
    shift = gear.generating_shift_coefficient * gear.module
    # with an even number of teeth, tooth 1 is the one above the middle
    spaces = [(k - teeth // 2 - 0.5) * gear.pitch_angle for k in range(teeth + 1)]
    rows = []
    for theta in rack_positions(gear, step, teeth):
        curves: list[Line | Arc] = []
        for gamma in spaces:
            place = complex(radius + shift, radius * (gamma - theta))
            placement = Placement2(theta, cmath.exp(1j * theta) * place)
            for curve in contour:
                curves += inside_disk(curve.placed(placement), disk_radius)
        if curves:
            rows.append(curves)
    return rows


def inside_disk(curve: Line | Arc, radius: float) -> list[Line | Arc]:
    """The parts of a line or arc inside a circle about the origin, mm."""
    low, high = curve.domain
    cuts = sorted(t for t in _crossings(curve, radius) if low < t < high)
    parts = []
    for a, b in zip([low, *cuts], [*cuts, high], strict=True):
        if b - a > 1e-9 * (high - low) and abs(complex(curve.point((a + b) / 2))) < radius:
            parts.append(curve.trimmed(a, b))
    return parts


def _crossings(curve: Line | Arc, radius: float) -> list[float]:
    """Parameters at which a line or arc crosses a circle about the origin."""
    if isinstance(curve, Line):
        chord = curve.end - curve.start
        square, half = abs(chord) ** 2, (curve.start.conjugate() * chord).real
        root = half**2 - square * (abs(curve.start) ** 2 - radius**2)
        return [] if root <= 0 else [(-half - math.sqrt(root)) / square, (-half + math.sqrt(root)) / square]
    away = abs(curve.centre)
    cosine = (radius**2 - away**2 - curve.radius**2) / (2 * away * curve.radius) if away > 0 else math.inf
    if not -1 < cosine < 1:
        return []
    sense = math.copysign(1.0, curve.sweep)
    angles = [cmath.phase(curve.centre) + s * math.acos(cosine) for s in (1, -1)]
    return [float(np.mod(sense * (a - curve.start_angle), 2 * math.pi)) for a in angles]
