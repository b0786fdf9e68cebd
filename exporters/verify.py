"""Every file is held against the exact section: closed, simple, in its place, within its tolerance.

Measured densely and between the writer's own nodes. A check that fails names what was found.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from exporters.read_dxf import read_dxf
from exporters.readers import Loop, ReadError, read_3mf, read_stl, read_svg, step_names
from geometry.body import Body
from geometry.contour import edge_points, signed_area
from geometry.curve import Complex
from geometry.measure import distance_to_profile, profile_area
from geometry.profile import Profile, Region

if TYPE_CHECKING:
    from geometry.cams.barrel_body import BarrelBody

# how many points of a file are measured: all edges get at least 3 between their ends
_POINTS = 10_000
# rounding of the measurement itself, as a part of the section's size
_ROUNDING = 1e-13


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was measured on a file, and what is wrong with it (nothing: it is good)."""

    measured: dict[str, float]
    failures: tuple[str, ...]


def verify_file(
    file: Path, kind: str, exact: Region | Body | BarrelBody, declared: float, tolerance: float, name: str | None = None
) -> Verdict:
    """Read a file back and hold it against its exact section or, for STL, 3MF and STEP, its exact solid.

    ``declared``: the error that its report states, mm; the measured one must not exceed it or ``tolerance``.
    ``name``: what the part must be called where the format has names.
    """
    try:
        if not isinstance(exact, Body | Region):
            from exporters.verify_barrel import verify_barrel

            return verify_barrel(file, kind, exact, declared, tolerance, name)
        if isinstance(exact, Body):
            if kind == "step":
                from exporters.verify_step import verify_step

                if name is not None and (found := step_names(file)) != [name]:
                    raise ReadError(f"the file names its parts {', '.join(found) or 'nothing'} instead of {name}")
                return verify_step(file, exact, declared, tolerance)
            from exporters.verify_mesh import verify_mesh

            mesh = read_stl(file) if kind == "stl" else read_3mf(file, name)
            return verify_mesh(mesh, exact, declared, tolerance)
        if kind == "drawing":
            from exporters.verify_cad import verify_drawing

            return verify_drawing(file, exact, declared, tolerance)
        loops = read_dxf(file) if kind == "dxf" else read_svg(file)
        return verify_loops(loops, exact.profiles(), exact.layers(), declared, tolerance)
    except (ReadError, OSError) as error:
        return Verdict({}, (str(error),))


def verify_loops(
    loops: list[Loop],
    profiles: Sequence[Profile],
    layers: Sequence[str],
    declared: float,
    tolerance: float,
    *,
    known_simple: bool = False,
) -> Verdict:
    """Closed loops against exact profiles; ``layers``: where each profile's loop must stand (empty: anywhere)."""
    if len(loops) != len(profiles):
        return Verdict({"contours": len(loops)}, (f"{len(loops)} contours instead of {len(profiles)}",))
    failures: list[str] = []
    worst, shortest = 0.0, float("inf")
    unmatched = list(loops)
    for profile, layer in zip(profiles, layers, strict=True):
        distances = [_rough_distance(loop, profile) for loop in unmatched]
        loop = unmatched.pop(int(np.argmin(distances)))
        if loop.layer and loop.layer.upper() != layer:
            failures.append(f"a contour stands on {loop.layer} instead of {layer}")
        deviation, found = _check_loop(loop, profile, declared, known_simple)
        worst = max(worst, deviation)
        shortest = min(shortest, float(np.abs(np.roll(loop.vertices, -1) - loop.vertices).min()))
        failures += found
    failures += deviation_failures(worst, declared, tolerance, max(p.reach() for p in profiles))
    return Verdict({"contours": len(loops), "max_deviation": worst, "shortest_edge": shortest}, tuple(failures))


def deviation_failures(worst: float, declared: float, tolerance: float, reach: float) -> list[str]:
    """What is wrong with a deviation, mm: more than the tolerance, or more than was declared."""
    allowed = _ROUNDING * reach
    failures = []
    if not worst <= tolerance + allowed:
        failures.append(f"deviates by {worst:.6g} mm from the exact outline; the tolerance is {tolerance:g} mm")
    elif not worst <= declared + allowed:
        failures.append(f"deviates by {worst:.6g} mm, more than the declared {declared:.6g} mm")
    return failures


def _rough_distance(loop: Loop, profile: Profile) -> float:
    step = max(1, len(loop.vertices) // 16)
    return float(distance_to_profile(loop.vertices[::step], profile, trusted=float("inf")).max())


def _check_loop(loop: Loop, profile: Profile, declared: float, known_simple: bool) -> tuple[float, list[str]]:
    """Greatest deviation of a loop, and what is wrong with its shape."""
    starts, ends = loop.vertices, np.roll(loop.vertices, -1)
    if len(starts) < 2 or not (np.all(np.isfinite(starts)) and np.all(np.isfinite(loop.bulges))):
        return float("inf"), ["a contour holds no shape or a coordinate that is not a number"]
    failures = []
    if np.any(starts == ends):
        failures.append("a contour repeats a vertex")
    inner = int(np.clip(_POINTS // len(starts), 3, 24))
    points = edge_points(starts, ends, loop.bulges, np.linspace(0, 1, inner + 2)[:-1])
    deviation = float(distance_to_profile(points.ravel(), profile, trusted=declared).max())
    length = float(np.abs(np.diff(points, axis=1)).sum())
    exact, found = profile_area(profile), signed_area(starts, loop.bulges)
    if abs(abs(found) - abs(exact)) > max(deviation, declared) * length + 1e-12 * abs(exact):
        failures.append(f"encloses {abs(found):.9g} mm^2 instead of {abs(exact):.9g} mm^2")
    if not known_simple and not is_simple(points[:, :: max(1, (inner + 1) // 4)].ravel()):
        failures.append("a contour crosses itself")
    return deviation, failures


def is_simple(points: Complex) -> bool:
    """Whether a closed polygon does not cross itself: one seen whole from the origin cannot, others by GEOS."""
    turns = (np.conj(points) * np.roll(points, -1)).imag
    # all edges turn about the origin alike, by less than half a turn each and by one turn together
    if np.all(turns > 0) or np.all(turns < 0):
        whole = np.angle(np.roll(points, -1) * np.conj(points)).sum()
        if abs(whole) < 3 * np.pi:
            return True
    import shapely

    ring = shapely.linearrings(np.stack([points.real, points.imag], axis=1))
    return bool(shapely.is_simple(ring))
