"""Contact of a cam with its follower over one turn, on the exact outlines: the gap at every cam angle.

The cam's outline is its profile as cut, corners and fillings included; the follower is a point, an arc about its
centre, or a straight face. That the contact stays on a plate is for the mate to tell (``least_plate_diameter``).
"""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np

from geometry.cams.disk import DiskCam
from geometry.cams.follower_motion import TURN
from geometry.cams.follower_shape import FollowerEnd
from geometry.cams.shape import cam_shape
from geometry.contact import Verdict
from geometry.curve import Complex, Curve, Real
from geometry.distinct import distinct
from geometry.gears.mesh_search import ContactPlace, PairContact
from geometry.line_arc import Arc, Line
from geometry.measure import distance_to_profile
from geometry.profile import Label, Profile

# |gap| up to this part of the follower's distance from the axis is contact
CONTACT_TOLERANCE = 1e-8
_ANGLES, _SAMPLES, _STEPS, _REACH_SAMPLES = 360, 65, 30, 4097
# samples of each edge of a follower's body, and every how many angles it is looked at
_BODY_SAMPLES, _BODY_STEP = 33, 5


def follower_contact(cam: DiskCam, end: FollowerEnd, tolerance: float, *, out: float = 0.0) -> PairContact:
    """The gap between cam and follower at 360 angles and at every joint of the motion, mm.

    ``out``: mm by which the follower stands farther out than its motion asks. OVERLAP: a gap below -tolerance
    somewhere; CONTACT: within +-tolerance everywhere; else CLEAR. The rest of the follower's body is held against
    the cam every 5 degrees: where it runs into it, the gap is minus the depth.
    """
    joints = [p.start for p in cam.motion.pieces]
    angles = distinct(np.concatenate([np.arange(_ANGLES) * TURN / _ANGLES, np.mod(joints, TURN)]))
    profile = cam_shape(cam).profile
    gaps, points = (_face_gaps if cam.is_flat else _round_gaps)(cam, profile, angles, out)
    if end.outline is not None:
        for index, depth, point in _body_overlaps(cam, end, profile, angles, tolerance, out):
            if -depth < gaps[index]:
                gaps[index], points[index] = -depth, point
    worst = int(np.argmin(gaps))
    if not np.all(np.isfinite(gaps)):
        verdict = Verdict.UNDECIDED
    elif gaps[worst] < -tolerance:
        verdict = Verdict.OVERLAP
    else:
        verdict = Verdict.CONTACT if gaps.max() <= tolerance else Verdict.CLEAR
    place = ContactPlace(float(gaps[worst]), float(angles[worst]), complex(points[worst]), (Label.CAM, Label.BODY))
    curve = tuple(gaps.tolist())
    return PairContact(verdict, tolerance, tuple(angles.tolist()), curve, (curve, curve), place, float(gaps.max()))


def follower_pose(cam: DiskCam, end: FollowerEnd, angle: float) -> tuple[complex, float]:
    """Where a follower's frame stands at a cam angle, in the cam's fixed frame: its origin, mm, and its turn, rad."""
    mount: Any = cam.mount
    angle = angle % TURN
    if end.arm_length is not None:
        swung = mount.start_angle + float(cam.motion.value(angle))
        return complex(mount.centre_distance), math.pi - mount.sense * swung
    point = complex(cam.reference_point(angle))
    # the stem of a flat follower stands on its own line, not over the axis
    return (complex(mount.offset, point.imag) if cam.is_flat else point), 0.0


def _body_overlaps(
    cam: DiskCam, end: FollowerEnd, profile: Profile, angles: Real, tolerance: float, out: float
) -> list[tuple[int, float, complex]]:
    """Angles (index) at which a point of the follower's outline lies in the cam: the depth there, mm, and the point."""
    assert end.outline is not None
    body = np.concatenate([e.point(np.linspace(*e.domain, _BODY_SAMPLES)) for e in end.outline.edges])
    found = []
    for index in range(0, len(angles), _BODY_STEP):
        origin, turn = follower_pose(cam, end, float(angles[index]))
        fixed = origin + body * cmath.exp(1j * turn) + out * _outwards(cam, angles[index : index + 1])
        here = fixed * cmath.exp(-1j * angles[index])
        near = np.flatnonzero(np.abs(here) < profile.reach())
        near = near[_inside(here[near], profile)]
        if near.size:
            depth = distance_to_profile(here[near], profile)
            deepest = int(np.argmax(depth))
            if depth[deepest] > tolerance:
                found.append((index, float(depth[deepest]), complex(fixed[near[deepest]])))
    return found


def reach_from_pivot(cam: DiskCam) -> float:
    """Greatest distance along a flat arm at which the cam touches it, from the pivot, mm (4 097 angles)."""
    mount: Any = cam.mount
    angles = np.linspace(0, TURN, _REACH_SAMPLES)[:-1]
    swung = mount.start_angle + cam.motion.value(angles)
    local = (cam.contact(angles) - mount.centre_distance) * np.exp(-1j * (math.pi - mount.sense * swung))
    return float(local.real.max())


def _round_gaps(cam: DiskCam, profile: Profile, angles: Real, out: float) -> tuple[Real, Complex]:
    """Gaps of a point or an arc about the reference point: its distance from the outline less its radius."""
    centre = cam.reference_point(angles) + out * _outwards(cam, angles)
    here = centre * np.exp(-1j * angles)
    signed = distance_to_profile(here, profile) * np.where(_inside(here, profile), -1.0, 1.0)
    return signed - cam.radius, centre - cam.radius * cam.normal(angles)


def _outwards(cam: DiskCam, angles: Real) -> Complex:
    """Unit vectors of the follower's way out."""
    way = cam.mount.velocity(np.ones(angles.shape), cam.reference_point(angles))
    return np.asarray(way / np.abs(way))


def _face_gaps(cam: DiskCam, profile: Profile, angles: Real, out: float) -> tuple[Real, Complex]:
    """Gaps of a straight face: its distance from the axis less the outline's support in its direction."""
    normal = cam.normal(angles)
    height = (cam.reference_point(angles) * np.conj(normal)).real + out
    local = normal * np.exp(-1j * angles)
    best, where = np.full(angles.shape, -np.inf), np.zeros(angles.shape, dtype=complex)
    for segment in profile.period:
        support, point = _support(segment.curve, local)
        better = support > best
        best, where = np.where(better, support, best), np.where(better, point, where)
    return height - best, where * np.exp(1j * angles)


def _support(curve: Curve, direction: Complex) -> tuple[Real, Complex]:
    """The greatest height of a curve in each direction (n,), and the point that has it."""
    if isinstance(curve, Arc):
        # the arc's own point in that direction, where it has one
        spoke = curve.radius * direction * math.copysign(1.0, curve.sweep)
        swept = np.mod(math.copysign(1.0, curve.sweep) * (np.angle(spoke) - curve.start_angle), 2 * math.pi)
        inner = np.where(swept <= abs(curve.sweep), swept, 0.0)
        points = np.stack(
            [curve.point(inner), *(np.full(direction.shape, p) for p in curve.point(np.array(curve.domain)))]
        )
    else:
        t = np.linspace(*curve.domain, _SAMPLES)
        heights = (np.conj(direction)[:, None] * curve.point(t)).real
        at = np.argmax(heights, axis=1)
        parameter = t[at]
        if not isinstance(curve, Line):
            parameter = _climbed(curve, direction, t, at)
        points = np.stack([curve.point(parameter), curve.point(t[at])])
    heights = (np.conj(direction) * points).real
    chosen = np.argmax(heights, axis=0)
    lanes = np.arange(len(direction))
    return heights[chosen, lanes], points[chosen, lanes]


def _climbed(curve: Curve, direction: Complex, t: Real, at: Any) -> Real:
    """Parameters of greatest height beside samples: bisection of the slope between the neighbours."""
    low, high = t[np.maximum(at - 1, 0)], t[np.minimum(at + 1, len(t) - 1)]
    for _ in range(_STEPS):
        middle = (low + high) / 2
        rising = (np.conj(direction) * curve.derivative(middle)).real > 0
        low, high = np.where(rising, middle, low), np.where(rising, high, middle)
    return np.asarray((low + high) / 2)


def _inside(points: Complex, profile: Profile) -> Any:
    """Whether points lie within an outline, by the winding of a fine polygon."""
    polygon = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, _SAMPLES)[:-1]) for s in profile.period])
    spokes = polygon - points[:, None]
    # a point on a corner of the outline is not inside
    spokes[spokes == 0] = 1.0
    return np.abs(np.angle(np.roll(spokes, -1, axis=1) / spokes).sum(axis=1)) > math.pi
