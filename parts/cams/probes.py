"""Cams: the follower is rolled over the outline read back from a file, and its lift held against the exact law."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from geometry.base.findings import Finding
from geometry.cams.contact.rolled import lift_bound, rolled_lift
from geometry.cams.motion.follower_motion import TURN
from geometry.curves.curve import Real
from geometry.plane.measure import distance_to_profile
from parts.base.readback import Probe, Probed, ReadBack, ReadLoop, refuse_if
from parts.base.texts import N_, fault, fault_of

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam
    from geometry.cams.plane.wedge import WedgeCam
    from geometry.plane.profile import Profile

# steps of a turn, and of the travel of a plate
ANGLES = 3600
# jumps of S'' above this share of its peak are told
_JUMP_SHARE = 0.1
# a second difference meets a joint between these many places
_JUMP_WIDTH = 3
# rounding of the rolling itself, part of the outline's size
_ROUNDING = 1e-12
# points of a loop by which it is told from others
_ROUGH = 16


class TurningProbe(Probe):
    """A follower rolled over a cam that turns; ``height``: where a solid is cut, mm.

    ``profile(offset)``: the exact wall in the part's frame, moved out of the material, next to which its loop lies;
    without one it is the outermost. ``turn`` rad: how the wall is turned about the axis from the cam's frame.
    ``below``: the wall holds the follower up; else it stands beyond the roller, as the outer wall of a groove, where
    the roller runs that fills it: its lift is the law's, and what a smaller one has beyond that is the play. ``name``:
    of the wall, where the part has more of them.
    """

    cam: DiskCam
    height: float
    profile: Callable[[float], Profile] | None = None
    turn: float = 0.0
    below: bool = True
    needs_whole = True

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """Roll the follower through 3600 angles, smaller by the ``offset``; see ``parts.base.readback.Probe``."""
        cam, loops = self.cam, file.section(self.height)
        loop = outermost(loops) if self.profile is None else _nearest(loops, self.profile(offset))
        outline = loop.outline(np.exp(-1j * self.turn), clockwise=not self.below)
        angle = np.arange(ANGLES) * (TURN / ANGLES)
        law = cam.motion.value(angle)
        error = rolled_lift(cam, outline, ANGLES, offset, below=self.below) - law
        allowed = declared + _ROUNDING * float(np.abs(cam.contact(angle)).max())
        bound = lift_bound(cam, ANGLES, allowed)
        lost = np.isnan(error) & np.isfinite(bound)
        if np.any(lost):
            at = math.degrees(angle[lost][0])
            failure = fault("the follower finds no outline at cam angle {at:.6g} degrees", at=at)
            return Probed(failures=self._named((failure,)))
        loose = np.isinf(bound)
        found = {} if np.any(loose) else lift_errors(error, law, TURN / ANGLES, swings=cam.swings, round_about=True)
        error, bound = np.where(loose, 0.0, error), np.where(loose, 0.0, bound)
        wrong = lift_failure(error, bound, lambda k: at_angle(k * 360 / ANGLES), swings=cam.swings)
        failures = self._named(wrong)
        if np.any(loose):
            # at a pressure angle of nearly 90 degrees an outline that is as good as it says does not hold a follower
            slips = Finding("follower_may_slip", math.degrees(angle[loose][0]), allowed)
            return Probed(failures=failures, findings=(slips,))
        return Probed(found, failures, lift_jumps(found, swings=cam.swings) if file.has_arcs else ())

    def _named(self, failures: tuple[str, ...]) -> tuple[str, ...]:
        walls = {"inner": N_("inner wall"), "outer": N_("outer wall")}
        return (
            tuple(fault_of(fault(walls.get(self.name, self.name)), one) for one in failures) if self.name else failures
        )


class SlidingProbe(Probe):
    """A follower on a plate that slides; ``height``: where a solid is cut, mm."""

    cam: WedgeCam
    height: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """Slide the follower over 3600 steps of the travel; see ``parts.base.readback.Probe``."""
        cam = self.cam
        outline = outermost(file.section(self.height)).outline()
        travel = np.linspace(0, cam.motion.travel, ANGLES + 1)
        law = cam.motion.value(travel)
        error = rolled_lift(cam, outline, 2 * ANGLES, offset)[: ANGLES + 1] - law
        if np.any(np.isnan(error)):
            text = fault("the follower finds no edge at {error:.6g} mm of travel", error=travel[np.isnan(error)][0])
            return Probed(failures=(text,))
        bound = travel_bound(cam, declared + _ROUNDING * float(np.abs(cam.centre(travel)).max()))
        found = lift_errors(error, law, cam.motion.travel / ANGLES, swings=cam.swings, round_about=False)
        failure = lift_failure(
            error, bound, lambda k: fault("at {travel:.6g} mm of travel", travel=travel[k]), swings=cam.swings
        )
        return Probed(found, failure, lift_jumps(found, swings=cam.swings) if file.has_arcs else ())


def outermost(loops: Sequence[ReadLoop]) -> ReadLoop:
    """The largest of some outlines."""
    refuse_if(not loops, "there is no outline for the follower to touch")
    return max(loops, key=lambda loop: loop.size)


def _nearest(loops: Sequence[ReadLoop], exact: Profile) -> ReadLoop:
    """The loop that stays nearest to a profile at all of its points."""
    refuse_if(not loops, "there is no outline for the follower to touch")
    rough = [x.points[:: max(1, len(x.points) // _ROUGH)] for x in loops]
    return loops[int(np.argmin([distance_to_profile(x, exact, trusted=np.inf).max() for x in rough]))]


def lift_errors(error: Real, law: Real, step: float, *, swings: bool, round_about: bool) -> dict[str, float]:
    """Errors of S, S' and S'' (mm or rad) in mm or degrees, the jump and the peak of S''; ``step`` of the angle, rad,
    or of the travel, mm. Not ``round_about``: the ends of the travel have no neighbours.
    """
    unit = math.degrees(1.0) if swings else 1.0
    name, suffix = ("swing_error_deg", "_deg") if swings else ("lift_error", "")
    inner = slice(None) if round_about else slice(1, -1)

    def bending(values: Real) -> Real:
        return ((np.roll(values, -1) - 2 * values + np.roll(values, 1)) / step**2)[inner]

    first = ((np.roll(error * unit, -1) - np.roll(error * unit, 1)) / (2 * step))[inner]
    second = bending(error * unit)
    jumps = np.roll(second, -_JUMP_WIDTH) - second
    return {
        name: float(np.abs(error).max() * unit),
        f"velocity_error{suffix}": float(np.abs(first).max()),
        f"acceleration_error{suffix}": float(np.abs(second).max()),
        f"acceleration_jump{suffix}": float(np.abs(jumps if round_about else jumps[:-_JUMP_WIDTH]).max()),
        f"acceleration_peak{suffix}": float(np.abs(bending(law * unit)).max()),
    }


def lift_failure(error: Real, bound: Real, place: Callable[[int], str], *, swings: bool) -> tuple[str, ...]:
    """What is wrong with a lift whose errors (mm or rad) exceed their bound somewhere."""
    excess = np.abs(error) - bound
    worst = int(np.argmax(excess))
    if excess[worst] <= 0:
        return ()
    if swings:
        size = fault("{size:.6g} degrees", size=math.degrees(abs(error[worst])))
    else:
        size = fault("{size:.6g} mm", size=abs(error[worst]))
    text = N_("the follower's lift is wrong by {size} {place}, more than the outline's error allows")
    return (fault(text, size=size, place=place(worst)),)


def at_angle(degrees: float) -> str:
    """A place of the cam."""
    return fault("at cam angle {degrees:.6g} degrees", degrees=degrees)


def lift_jumps(found: dict[str, float], *, swings: bool) -> tuple[Finding, ...]:
    """The remark about jumps of S'' at joints, from ``lift_errors``; none where they are small."""
    suffix = "_deg" if swings else ""
    jump, peak = found[f"acceleration_jump{suffix}"], found[f"acceleration_peak{suffix}"]
    return (Finding("rolled_jumps", jump, peak),) if jump > _JUMP_SHARE * peak > 0 else ()


def travel_bound(cam: WedgeCam, error: float) -> Real:
    """How far S may be wrong at each place where the outline is within ``error`` mm: error / cos nu, second order.

    See ``geometry.cams.contact.rolled.lift_bound``; the worst of three neighbouring places counts.
    """
    travel = np.linspace(0, cam.motion.travel, ANGLES + 1)
    slope = np.abs(cam.pressure_angle(travel))
    cosine = np.maximum(np.cos(slope), 1e-9)
    first = error / cosine
    bound = first + np.abs(cam.pitch_curvature(travel)) * (first * np.sin(slope)) ** 2 / cosine
    bound = bound / cam.mount.lever
    return np.maximum(np.maximum(np.roll(bound, 1), np.roll(bound, -1)), bound)
