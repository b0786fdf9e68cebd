"""Contact of a cam with its follower over one turn, on the exact outlines: the gap at every cam angle.

The cam's outline is its profile as cut, corners and fillings included; the follower is a point, an arc about its
centre, or a straight face. That the contact stays on a plate is for the mate to tell (``least_plate_diameter``).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable

import numpy as np

from geometry.base.distinct import distinct
from geometry.cams.contact.outlines import FollowerEnd
from geometry.cams.contact.support import support
from geometry.cams.motion.follower_motion import TURN
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.fence import Fence
from geometry.cams.plane.shape import cam_shape
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import ContactPlace, PairContact, first_least
from geometry.plane.distance import Verdict
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Label, Profile

# |gap| up to this part of the follower's distance from the axis is contact
CONTACT_TOLERANCE = 1e-8
_ANGLES, _REACH_SAMPLES = 360, 4097
# samples of each edge of a follower's body; about the deepest of them as many places to each side, and halvings of that
_BODY_SAMPLES, _BESIDE, _HALVINGS = 33, 4, 16


def follower_contact(
    cam: DiskCam, end: FollowerEnd, tolerance: float, *, out: float = 0.0, beyond: Profile | None = None
) -> PairContact:
    """The gap between cam and follower at 360 angles and at every joint of the motion, mm.

    ``out``: mm by which the follower stands farther out than its motion asks; ``beyond``: the outer wall of a groove,
    whose gaps are the second curve of ``side_gaps``. OVERLAP: a gap below -tolerance somewhere; CONTACT: within
    +-tolerance everywhere, of a groove at one of its walls; else CLEAR. The rest of the follower's body is held
    against the cam too: where it runs into it, the gap is minus the depth, and the angle of the greatest is added.
    """
    angles = contact_angles(cam)
    fence = Fence(cam_shape(cam).profile)
    gaps, points = (_face_gaps if cam.is_flat else _round_gaps)(cam, fence, angles, out)
    if end.outline is not None:

        def pose(angle: float) -> tuple[complex, complex]:
            origin, turn = follower_pose(cam, end, angle)
            lifted = origin + out * complex(_outwards(cam, np.asarray(angle)))
            return lifted * cmath.exp(-1j * angle), cmath.exp(1j * (turn - angle))

        angles, gaps, points = press_in(angles, gaps, points * np.exp(-1j * angles), fence, end, pose, tolerance)
        points = points * np.exp(1j * angles)
    outer = gaps
    if beyond is not None:
        centre = cam.reference_point(angles) + out * _outwards(cam, angles)
        outer = -Fence(beyond).signed_distance(centre * np.exp(-1j * angles)) - cam.radius
        points = np.where(outer < gaps, centre + cam.radius * cam.normal(angles), points)
    return judged(angles, (gaps, outer), points, tolerance)


def contact_angles(cam: DiskCam) -> Real:
    """Cam angles at which contact is looked at, rad: 360, and every joint of the motion."""
    joints = [p.start for p in cam.motion.pieces]
    return distinct(np.concatenate([np.arange(_ANGLES) * TURN / _ANGLES, np.mod(joints, TURN)]))


def body_points(end: FollowerEnd, along: Real) -> Complex:
    """Points of a follower's outline in its own frame, mm: ``along`` counts edges and parts of them.

    Those of its round end are not a number: its centre's gap tells of them.
    """
    assert end.outline is not None
    points, edges = np.empty(along.shape, dtype=complex), end.outline.edges
    which = np.minimum(np.floor(np.mod(along, len(edges))).astype(int), len(edges) - 1)
    for index in np.unique(which):
        (low, high), mine = edges[index].domain, which == index
        points[mine] = edges[index].point(low + (high - low) * (np.mod(along[mine], len(edges)) - index))
    return np.where(np.abs(points - (end.arm_length or 0.0)) > end.radius * (1 + 1e-9), points, np.nan)


def press_in(
    places: Real,
    gaps: Real,
    points: Complex,
    fence: Fence,
    end: FollowerEnd,
    pose: Callable[[float], tuple[complex, complex]],
    tolerance: float,
) -> tuple[Real, Real, Complex]:
    """Places, gaps and their points where the rest of a follower runs deeper into a cam than its end: minus the depth.

    ``pose`` gives origin and direction of the follower's frame in that of the profile at a place. Where it runs in
    deepest between the places is one more of them.
    """
    assert end.outline is not None

    def depths(at: Real, along: Real) -> tuple[Real, Complex]:
        """How deep the outline's points stand in the cam, all at each place; 0 outside."""
        poses = np.array([pose(place) for place in at.tolist()])
        here = poses[:, :1] + body_points(end, along) * poses[:, 1:]
        depth, (rows, columns) = np.zeros(here.shape), np.nonzero(np.isfinite(here))
        held = fence.holds(here[rows, columns])
        rows, columns = rows[held], columns[held]
        depth[rows, columns] = distance_to_profile(here[rows, columns], fence.profile)
        return depth, here

    along = np.linspace(0, len(end.outline.edges), len(end.outline.edges) * (_BODY_SAMPLES - 1), endpoint=False)
    depth, here = depths(places, along)
    rows, deepest = np.arange(len(places)), depth.argmax(axis=1)
    deeper = depth[rows, deepest] > np.maximum(tolerance, -gaps)
    gaps = np.where(deeper, -depth[rows, deepest], gaps)
    points = np.where(deeper, here[rows, deepest], points)
    worst = int(gaps.argmin())
    if not deeper[worst]:
        return places, gaps, points
    at, on, reach = places[worst], along[deepest[worst]], np.array([np.diff(places).max(), 1 / (_BODY_SAMPLES - 1)])
    beside = np.linspace(-1.0, 1.0, 2 * _BESIDE + 1)
    for _ in range(_HALVINGS):
        near = np.clip(at + reach[0] * beside, places[0], places[-1]), on + reach[1] * beside
        depth, here = depths(*near)
        row, column = np.unravel_index(depth.argmax(), depth.shape)
        at, on, reach = near[0][row], near[1][column], reach / 2
    spot = int(np.searchsorted(places, at))
    if not depth[row, column] > -gaps[worst]:
        return places, gaps, points
    return (
        np.insert(places, spot, at), np.insert(gaps, spot, -depth[row, column]),
        np.insert(points, spot, here[row, column]),
    )  # fmt: skip


def judged(
    places: Real, walls: tuple[Real, Real], points: Complex, tolerance: float, *, both: bool = False
) -> PairContact:
    """The verdict on the gaps at one wall or two: CONTACT where one of them, or ``both``, touch at every place.

    ``greatest_gap`` is that of both walls.
    """
    nearer = np.minimum(*walls)
    worst, greatest = first_least(nearer), float(max(w.max() for w in walls))
    if not all(np.all(np.isfinite(w)) for w in walls):
        verdict = Verdict.UNDECIDED
    elif nearer.min() < -tolerance:
        verdict = Verdict.OVERLAP
    else:
        farthest = greatest if both else nearer.max()
        verdict = Verdict.CONTACT if farthest <= tolerance else Verdict.CLEAR
    place = ContactPlace(float(nearer.min()), float(places[worst]), complex(points[worst]), (Label.CAM, Label.BODY))
    curves = tuple(walls[0].tolist()), tuple(walls[1].tolist())
    return PairContact(verdict, tolerance, tuple(places.tolist()), tuple(nearer.tolist()), curves, place, greatest)


def follower_pose(cam: DiskCam, end: FollowerEnd, angle: float) -> tuple[complex, float]:
    """Where a follower's frame stands at a cam angle, in the cam's fixed frame: its origin, mm, and its turn, rad."""
    return cam.follower_pose(angle % TURN, on_arm=end.arm_length is not None, turns=end.outline is not None)


def reach_from_pivot(cam: DiskCam) -> float:
    """Greatest distance along a flat arm at which the cam touches it, from the pivot, mm (4 097 angles)."""
    mount = cam.swing
    angles = np.linspace(0, TURN, _REACH_SAMPLES)[:-1]
    swung = mount.start_angle + cam.motion.value(angles)
    local = (cam.contact(angles) - mount.centre_distance) * np.exp(-1j * (math.pi - mount.sense * swung))
    return float(local.real.max())


def _round_gaps(cam: DiskCam, fence: Fence, angles: Real, out: float) -> tuple[Real, Complex]:
    """Gaps of a point or an arc about the reference point: its distance from the outline less its radius."""
    centre = cam.reference_point(angles) + out * _outwards(cam, angles)
    here = centre * np.exp(-1j * angles)
    return fence.signed_distance(here) - cam.radius, centre - cam.radius * cam.normal(angles)


def _outwards(cam: DiskCam, angles: Real) -> Complex:
    """Unit vectors of the follower's way out."""
    way = cam.way(angles, cam.reference_point(angles))
    return np.asarray(way / np.abs(way))


def _face_gaps(cam: DiskCam, fence: Fence, angles: Real, out: float) -> tuple[Real, Complex]:
    """Gaps of a straight face: its distance from the axis less the outline's support in its direction."""
    normal = cam.normal(angles)
    height = (cam.reference_point(angles) * np.conj(normal)).real + out
    local = normal * np.exp(-1j * angles)
    best, where = support(fence.profile, local)
    return height - best, where * np.exp(1j * angles)
