"""Read-back of drawings: splines evaluated by the library that reads them, never by ours; loops of samples."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from exporters.readers import ReadError
from exporters.verify import Verdict, deviation_failures, is_simple
from geometry.curve import Complex
from geometry.measure import distance_to_profile, profile_area
from geometry.profile import Profile, Region

_LAYER = "OUTLINE"
_PER_CURVE = 25
# ends of neighbouring curves in one file meet this well, mm
_JOINT = 1e-9


def verify_drawing(file: Path, region: Region, declared: float, tolerance: float) -> Verdict:
    """Hold a drawing file against its exact section; see exporters/verify.py."""
    return verify_samples(chained(_read_drawing(file)), region.profiles(), declared, tolerance)


def verify_samples(loops: list[Complex], profiles: Sequence[Profile], declared: float, tolerance: float) -> Verdict:
    """Densely sampled loops against exact profiles."""
    if len(loops) != len(profiles):
        return Verdict({"contours": float(len(loops))}, (f"{len(loops)} contours instead of {len(profiles)}",))
    failures: list[str] = []
    worst, left = 0.0, list(loops)
    for profile in profiles:
        rough = [float(distance_to_profile(x[:: max(1, len(x) // 16)], profile, trusted=np.inf).max()) for x in left]
        loop = left.pop(int(np.argmin(rough)))
        worst = max(worst, float(distance_to_profile(loop, profile, trusted=declared).max()))
        failures += _loop_failures(loop, profile)
    failures += deviation_failures(worst, declared, tolerance, max(p.reach() for p in profiles))
    return Verdict({"contours": float(len(loops)), "max_deviation": worst}, tuple(failures))


def _loop_failures(loop: Complex, profile: Profile) -> list[str]:
    """Self-crossing, and an area that is not the profile's (the samples' polygon knows it to a part in 500)."""
    failures = [] if is_simple(loop) else ["a contour crosses itself"]
    found, exact = 0.5 * abs(np.sum((np.conj(loop) * np.roll(loop, -1)).imag)), abs(profile_area(profile))
    if abs(found / exact - 1) > 2e-3:
        failures.append(f"encloses {found:.6g} mm^2 instead of {exact:.6g} mm^2")
    return failures


def chained(pieces: list[Complex]) -> list[Complex]:
    """Sampled curves (each from its first to its last point) chained by their ends into closed loops."""
    if not pieces:
        return []
    # files carry 15 digits: the joints of large parts are that much wider
    joint = _JOINT + 1e-11 * max(float(np.abs(piece).max()) for piece in pieces)
    ends = np.array([[piece[0], piece[-1]] for piece in pieces]).ravel()
    order = np.argsort(ends.real)
    places = ends.real[order]
    left = dict.fromkeys(range(len(pieces)))
    loops = []
    while left:
        index, _ = left.popitem()
        chain = [pieces[index]]
        while abs(chain[-1][-1] - chain[0][0]) > joint:
            last = chain[-1][-1]
            low, high = np.searchsorted(places, (last.real - joint, last.real + joint))
            near = [int(i) for i in order[low:high] if int(i) // 2 in left and abs(ends[i] - last) <= joint]
            if not near:
                raise ReadError(f"a contour is open at ({last.real:.6g}, {last.imag:.6g})")
            index, side = divmod(min(near, key=lambda i: abs(ends[i] - last)), 2)
            del left[index]
            chain.append(pieces[index] if side == 0 else pieces[index][::-1])
        loops.append(np.concatenate([piece[:-1] for piece in chain]))
    return loops


def _read_drawing(file: Path) -> list[Complex]:
    """Samples of every curve of a drawing DXF, evaluated by ezdxf."""
    import ezdxf

    try:
        drawing = ezdxf.readfile(str(file))
    except (ezdxf.DXFError, OSError, ValueError, LookupError, StopIteration, TypeError, AttributeError) as error:
        raise ReadError(f"not a readable DXF: {error or 'it ends too early'}") from error
    auditor = drawing.audit()
    if auditor.errors or auditor.fixes:
        raise ReadError(f"the DXF audit finds fault: {(auditor.errors + auditor.fixes)[0].message}")
    if drawing.header.get("$INSUNITS") != 4:
        raise ReadError("the DXF is not in mm ($INSUNITS is not 4)")
    for entity in drawing.modelspace():
        if entity.dxf.layer.upper() != _LAYER:
            raise ReadError(f"a {entity.dxftype()} stands on layer {entity.dxf.layer} instead of {_LAYER}")
    return [_drawn(entity) for entity in drawing.modelspace()]


def _drawn(entity: Any) -> Complex:
    share = np.linspace(0, 1, _PER_CURVE)
    kind = entity.dxftype()
    if kind == "LINE":
        ends = [complex(p.x, p.y) for p in (entity.dxf.start, entity.dxf.end)]
        return np.asarray(ends[0] + share * (ends[1] - ends[0]), dtype=np.complex128)
    if kind in ("ARC", "CIRCLE"):
        centre, radius = complex(entity.dxf.center.x, entity.dxf.center.y), entity.dxf.radius
        low, high = (0.0, 360.0) if kind == "CIRCLE" else (entity.dxf.start_angle, entity.dxf.end_angle)
        sweep = (high - low) % 360 or 360
        share = share if sweep < 90 else np.linspace(0, 1, 10 * _PER_CURVE)
        turned = np.radians(low + share * sweep)
        return np.asarray(centre + radius * np.exp(1j * turned), dtype=np.complex128)
    if kind == "SPLINE":
        tool = entity.construction_tool()
        knots = np.asarray(tool.knots())
        return np.array([complex(p.x, p.y) for p in tool.points(knots[0] + share * (knots[-1] - knots[0]))])
    raise ReadError(f"a {kind} stands in the drawing; only lines, arcs, circles and splines belong there")
