"""Contact of positive drives over one turn, on the exact outlines: conjugate rollers, yokes of constant breadth."""

from __future__ import annotations

import cmath

import numpy as np

from geometry.cams.contact.follower import contact_angles, judged
from geometry.cams.contact.support import support
from geometry.cams.motion.follower_motion import TURN
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.positive import Conjugate
from geometry.cams.plane.shape import cam_shape
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import PairContact
from geometry.plane.measure import distance_to_profile


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
    angles = contact_angles(first)
    turns = np.exp(-1j * angles)
    one = distance_to_profile(first.reference_point(angles) * turns, cam_shape(first).profile) - first.radius
    own = second_centres(first, pair, angles) * turns * cmath.exp(-1j * (pair.turn + second_turn))
    two = distance_to_profile(own, cam_shape(pair.cam).profile) - pair.cam.radius
    return judged(angles, (one, two), first.contact(angles), tolerance, both=True)


def yoke_contact(cam: DiskCam, breadth: float, play: float, tolerance: float, *, out: float = 0.0) -> PairContact:
    """The gaps at the upper and lower face, or roller, of a yoke at 360 angles and at every joint, mm.

    ``breadth`` between faces or roller centres without the ``play``, half of which stands on either side; ``out``: mm
    by which the yoke stands farther out than its motion asks.
    """
    angles = contact_angles(cam)
    profile = cam_shape(cam).profile
    upper = cam.slide.start_height + cam.motion.value(angles) + play / 2 + out
    lower = upper - breadth - play
    if cam.is_flat:
        one = upper - support(profile, 1j * np.exp(-1j * angles))[0]
        two = -lower - support(profile, -1j * np.exp(-1j * angles))[0]
    else:
        one, two = (distance_to_profile(1j * y * np.exp(-1j * angles), profile) - cam.radius for y in (upper, lower))
    return judged(angles, (one, two), cam.contact(angles), tolerance, both=True)
