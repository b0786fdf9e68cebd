"""Wedge cams: the follower slides over the edge read back from a file, and its lift is held against the exact law."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from exporters.readers import ReadError
from exporters.reroll import Source, outline_of_file
from exporters.verify import Verdict
from geometry.cams.rolled import rolled_lift
from geometry.cams.wedge import Swinging, WedgeCam
from geometry.curve import Real
from geometry.findings import Finding
from parts.part import Part

PLACES = 3600
# jumps of S'' above this share of its peak are told; a second difference meets a joint between so many places
_JUMP_SHARE, _JUMP_WIDTH = 0.1, 3
# rounding of the rolling itself, part of the outline's size
_ROUNDING = 1e-12


def reroll_wedge(
    file: Source, kind: str, part: Part, offset: float, declared: float, verdict: Verdict
) -> tuple[Verdict, tuple[Finding, ...]]:
    """Add to a verdict what the follower does on the file: errors of lift, S' and S'' in mm (or degrees), per mm.

    See ``exporters.reroll.reroll``; the travel has 3600 steps.
    """
    cam = part.wedge
    if cam is None:
        return verdict, ()
    try:
        outline = outline_of_file(file, kind, part)
    except ReadError as refusal:
        return replace(verdict, failures=(*verdict.failures, str(refusal))), ()
    travel = np.linspace(0, cam.motion.travel, PLACES + 1)
    error = rolled_lift(cam, outline, 2 * PLACES, offset)[: PLACES + 1] - cam.motion.value(travel)
    if np.any(np.isnan(error)):
        text = f"the follower finds no edge at {travel[np.isnan(error)][0]:.6g} mm of travel"
        return replace(verdict, failures=(*verdict.failures, text)), ()
    swings = isinstance(cam.mount, Swinging)
    unit, suffix = (math.degrees(1.0), "_deg") if swings else (1.0, "")
    first, second = _differences(cam, error * unit)
    peak = float(np.abs(_differences(cam, cam.motion.value(travel) * unit)[1]).max())
    jump = float(np.abs(second[_JUMP_WIDTH:] - second[:-_JUMP_WIDTH]).max())
    measured = verdict.measured | {
        "swing_error_deg" if swings else "lift_error": float(np.abs(error).max() * unit),
        f"velocity_error{suffix}": float(np.abs(first).max()),
        f"acceleration_error{suffix}": float(np.abs(second).max()),
        f"acceleration_jump{suffix}": jump,
        f"acceleration_peak{suffix}": peak,
    }
    excess = np.abs(error) - travel_bound(cam, declared + _ROUNDING * float(np.abs(cam.centre(travel)).max()))
    worst = int(np.argmax(excess))
    failures = verdict.failures
    if not excess[worst] <= 0:
        found = f"{abs(error[worst]) * unit:.6g} {'degrees' if swings else 'mm'} at {travel[worst]:.6g} mm of travel"
        failures = (*failures, f"the follower's lift is wrong by {found}, more than the outline's error allows")
    told = kind in ("dxf", "svg") and jump > _JUMP_SHARE * peak > 0
    return Verdict(measured, failures), ((Finding("rolled_jumps", jump, peak),) if told else ())


def _differences(cam: WedgeCam, values: Real) -> tuple[Real, Real]:
    """Slope and bending of values over the travel, by central differences, without its two ends."""
    step = cam.motion.travel / PLACES
    return (values[2:] - values[:-2]) / (2 * step), (values[2:] - 2 * values[1:-1] + values[:-2]) / step**2


def travel_bound(cam: WedgeCam, error: float) -> Real:
    """How far S may be wrong at each place where the outline is within ``error`` mm: error / cos nu, second order.

    See ``geometry.cams.rolled.lift_bound``; the worst of three neighbouring places counts.
    """
    travel = np.linspace(0, cam.motion.travel, PLACES + 1)
    slope = np.abs(cam.pressure_angle(travel))
    cosine = np.maximum(np.cos(slope), 1e-9)
    first = error / cosine
    bound = first + np.abs(cam.pitch_curvature(travel)) * (first * np.sin(slope)) ** 2 / cosine
    if isinstance(cam.mount, Swinging):
        bound = bound / cam.mount.arm_length
    return np.maximum(np.maximum(np.roll(bound, 1), np.roll(bound, -1)), bound)
