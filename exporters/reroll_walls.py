"""Parts with several walls for a roller, or a turned one: the roller is rolled over each as read from a file."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from exporters.read_dxf import read_dxf
from exporters.readers import Loop, ReadError, read_svg
from exporters.reroll import ANGLES, Source, mesh_of, mesh_slices, rolled_differences, rolled_failure, smooth_loops
from exporters.verify import Verdict
from geometry.cams.follower_motion import TURN
from geometry.cams.rolled import Outline, lift_bound, outline_of_loop, outline_of_polynomials, rolled_lift
from geometry.cams.walls import CamWall
from geometry.curve import Complex
from geometry.findings import Finding
from geometry.measure import distance_to_profile
from geometry.profile import Profile
from parts.part import Part

# jumps of S'' above this share of its peak are told
_JUMP_SHARE = 0.1
# samples of a loop by which it is told from others
_ROUGH = 16


def reroll_walls(
    file: Source, kind: str, part: Part, offset: float, declared: float, verdict: Verdict
) -> tuple[Verdict, tuple[Finding, ...]]:
    """Add to a verdict what the roller does on each wall of the file; see ``exporters.reroll.reroll``.

    Names of measured errors begin with the wall's where a part has more than one. On the outer wall of a groove runs
    the roller that fills it: its lift is the law's, and what a smaller one has beyond that is the play.
    """
    if part.section(offset).findings:
        return verdict, ()
    told: dict[str, Finding] = {}
    for wall in part.walls:
        try:
            outline = _wall_outline(file, kind, part, wall, wall.profile(offset))
        except ReadError as refusal:
            verdict = replace(verdict, failures=(*verdict.failures, f"{wall.name} wall: {refusal}"))
            continue
        verdict, jumps = _rolled(outline, wall, offset, declared, verdict, alone=len(part.walls) == 1)
        if jumps is not None and kind in ("dxf", "svg"):
            told[wall.name] = jumps
    worst = max(told.values(), key=lambda f: f.value / f.limit, default=None)
    return verdict, () if worst is None else (worst,)


def _rolled(
    outline: Outline, wall: CamWall, offset: float, declared: float, verdict: Verdict, *, alone: bool
) -> tuple[Verdict, Finding | None]:
    """The verdict with one wall's errors, and its jumps of S'' where they are large."""
    cam, angle = wall.cam, np.arange(ANGLES) * (TURN / ANGLES)
    error = rolled_lift(cam, outline, ANGLES, offset, below=wall.below) - cam.motion.value(angle)
    head = "" if alone else f"{wall.name}_"
    who = "" if alone else f"{wall.name} wall: "
    if np.any(np.isnan(error)):
        text = f"{who}the follower finds no outline at cam angle {math.degrees(angle[np.isnan(error)][0]):.6g} degrees"
        return replace(verdict, failures=(*verdict.failures, text)), None
    measured, jump, peak = rolled_differences(cam, error)
    failure = rolled_failure(cam, error, lift_bound(cam, ANGLES, declared + _rounding(cam.contact(angle))))
    failures = verdict.failures if failure is None else (*verdict.failures, who + failure)
    found = Finding("rolled_jumps", jump, peak) if jump > _JUMP_SHARE * peak > 0 else None
    return Verdict(verdict.measured | {head + k: v for k, v in measured.items()}, failures), found


def _rounding(points: Complex) -> float:
    return 1e-12 * float(np.abs(points).max())


def _wall_outline(file: Source, kind: str, part: Part, wall: CamWall, exact: Profile) -> Outline:
    """The loop of a file that lies nearest to a wall, in the cam's frame.

    Raises
    ------
    ReadError
        The file holds no closed outline.
    """
    back = np.exp(-1j * wall.turn)
    if kind in ("dxf", "svg", "stl", "3mf"):
        loops = read_dxf(file) if kind == "dxf" else read_svg(file) if kind == "svg" else []
        if kind in ("stl", "3mf"):
            mesh = mesh_of(file, kind, part)
            loops = [Loop(x, np.zeros(len(x)), "") for x in mesh_slices(mesh, wall.height)]
        loop = loops[_nearest([x.vertices for x in loops], exact)]
        return outline_of_loop(loop.vertices * back, loop.bulges, clockwise=not wall.below)
    coefficients = smooth_loops(file, kind, wall.height)
    return outline_of_polynomials(
        coefficients[_nearest([c[:, 0] for c in coefficients], exact)] * back, clockwise=not wall.below
    )


def _nearest(loops: list[Complex], exact: Profile) -> int:
    """Which loop stays nearest to a profile at all of its points."""
    if not loops:
        raise ReadError("there is no outline for the follower to touch")
    rough = [distance_to_profile(x[:: max(1, len(x) // _ROUGH)], exact, trusted=np.inf).max() for x in loops]
    return int(np.argmin(rough))
