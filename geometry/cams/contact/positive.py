"""Contact of positive drives over one turn, on the exact outlines: conjugate rollers, yokes of constant breadth."""

from __future__ import annotations

import cmath

import numpy as np

from geometry.base.distinct import distinct
from geometry.cams.contact.support import support
from geometry.cams.motion.follower_motion import TURN
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.positive import Conjugate
from geometry.cams.plane.shape import cam_shape
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import ContactPlace, PairContact
from geometry.plane.distance import Verdict
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Label

_ANGLES = 360


def between_rollers(first: DiskCam, pair: Conjugate) -> float:
    """Distance of both rollers' centres on a translating follower, mm, or angle between its arms, rad."""
    if first.swings:
        return TURN - first.swing.start_angle - pair.cam.swing.start_angle
    return first.slide.start_height + pair.cam.slide.start_height


def second_centres(first: DiskCam, pair: Conjugate, angles: Real) -> Complex:
    """Centres of the second roller in the fixed frame, mm, on the follower that the first cam moves by its law.

    Of the second cam only where its roller is mounted counts, not its motion.
    """
    centre, distance = first.reference_point(angles), between_rollers(first, pair)
    if not first.swings:
        return np.asarray(centre - 1j * distance)
    pivot, arm = first.swing.centre_distance, pair.cam.swing.arm_length / first.swing.arm_length
    return np.asarray(pivot + (centre - pivot) * cmath.rect(arm, -first.swing.sense * distance))


def conjugate_contact(first: DiskCam, pair: Conjugate, tolerance: float, *, second_turn: float = 0.0) -> PairContact:
    """The gaps under both rollers at 360 angles and at every joint of the motion, mm.

    ``second_turn``: rad by which the second disk is turned on the shaft from its place. OVERLAP: a gap below -tolerance
    somewhere; CONTACT: both within +-tolerance everywhere; else CLEAR.
    """
    angles = _angles(first)
    turns = np.exp(-1j * angles)
    one = distance_to_profile(first.reference_point(angles) * turns, cam_shape(first).profile) - first.radius
    own = second_centres(first, pair, angles) * turns * cmath.exp(-1j * (pair.turn + second_turn))
    two = distance_to_profile(own, cam_shape(pair.cam).profile) - pair.cam.radius
    return _judged(angles, one, two, first.contact(angles), tolerance)


def yoke_contact(cam: DiskCam, breadth: float, play: float, tolerance: float, *, out: float = 0.0) -> PairContact:
    """The gaps at the upper and lower face, or roller, of a yoke at 360 angles and at every joint, mm.

    ``breadth`` between faces or roller centres without the ``play``, half of which stands on either side; ``out``: mm
    by which the yoke stands farther out than its motion asks.
    """
    angles = _angles(cam)
    profile = cam_shape(cam).profile
    upper = cam.slide.start_height + cam.motion.value(angles) + play / 2 + out
    lower = upper - breadth - play
    if cam.is_flat:
        one = upper - support(profile, 1j * np.exp(-1j * angles))[0]
        two = -lower - support(profile, -1j * np.exp(-1j * angles))[0]
    else:
        one, two = (distance_to_profile(1j * y * np.exp(-1j * angles), profile) - cam.radius for y in (upper, lower))
    return _judged(angles, one, two, cam.contact(angles), tolerance)


def _angles(cam: DiskCam) -> Real:
    joints = [p.start for p in cam.motion.pieces]
    return distinct(np.concatenate([np.arange(_ANGLES) * TURN / _ANGLES, np.mod(joints, TURN)]))


def _judged(angles: Real, one: Real, two: Real, points: Complex, tolerance: float) -> PairContact:
    """The verdict on both gap curves."""
    gaps = np.minimum(one, two)
    worst, greatest = int(np.argmin(gaps)), float(max(one.max(), two.max()))
    if not (np.all(np.isfinite(one)) and np.all(np.isfinite(two))):
        verdict = Verdict.UNDECIDED
    elif gaps[worst] < -tolerance:
        verdict = Verdict.OVERLAP
    else:
        verdict = Verdict.CONTACT if greatest <= tolerance else Verdict.CLEAR
    place = ContactPlace(float(gaps[worst]), float(angles[worst]), complex(points[worst]), (Label.CAM, Label.BODY))
    curves = tuple(one.tolist()), tuple(two.tolist())
    return PairContact(verdict, tolerance, tuple(angles.tolist()), tuple(gaps.tolist()), curves, place, greatest)
