"""How far outlines reach in a direction, against closed forms and their densest samples."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.cams.contact.positive import second_centres
from geometry.cams.contact.support import support
from geometry.cams.motion.follower_motion import motion_of_table
from geometry.cams.plane.disk import FollowerKind, translating_cam
from geometry.cams.plane.positive import conjugate_cam
from geometry.cams.plane.shape import cam_shape
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile, Segment
from tests.geometry.cams.plane.test_disk_cam import CAMS

DIRECTIONS = np.exp(1j * np.linspace(-3.1, 3.1, 41))
# a slot of 4 x 2 about the origin, and the same with one end bent inwards: a clockwise arc about its middle
SLOT = [Line(-2 - 1j, 2 - 1j), Arc(2 + 0j, 1.0, -math.pi / 2, math.pi), Line(2 + 1j, -2 + 1j)]
ENDS = {"slot": Arc(-2 + 0j, 1.0, math.pi / 2, math.pi), "bitten slot": Arc(-2 + 0j, 1.0, math.pi / 2, -math.pi)}


@pytest.mark.parametrize("name", ENDS)
def test_a_slot_reaches_as_far_as_its_axis_and_half_its_width(name: str) -> None:
    outline = Profile(tuple(Segment(c, Label.CAM) for c in (*SLOT, ENDS[name])))
    height, point = support(outline, DIRECTIONS)
    right = 2 * DIRECTIONS.real + 1
    left = -2 * DIRECTIONS.real + (1 if name == "slot" else np.abs(DIRECTIONS.imag))
    assert height == pytest.approx(np.maximum(right, left), rel=1e-14)
    assert (point * np.conj(DIRECTIONS)).real == pytest.approx(height, rel=1e-14)
    whole = np.where(
        right > left, 2 + DIRECTIONS, -2 + (DIRECTIONS if name == "slot" else 1j * np.sign(DIRECTIONS.imag))
    )
    assert point == pytest.approx(whole, rel=1e-14)


def test_a_circle_reaches_alike_all_round() -> None:
    height, point = support(Profile((Segment(Arc(3 - 4j, 2.5, 0.7, 2 * math.pi), Label.CAM),)), DIRECTIONS)
    assert height == pytest.approx((np.conj(DIRECTIONS) * (3 - 4j)).real + 2.5, rel=1e-14)
    assert point == pytest.approx(3 - 4j + 2.5 * DIRECTIONS, rel=1e-14)


@pytest.mark.parametrize("name", ["flat", "roller"])
def test_a_cam_reaches_to_the_highest_of_dense_samples(name: str) -> None:
    outline = cam_shape(CAMS[name]).profile
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 2001)) for s in outline.segments()])
    heights = (np.conj(DIRECTIONS)[:, None] * points).real
    height, point = support(outline, DIRECTIONS)
    assert np.all(height >= heights.max(axis=1) - 1e-12)
    assert height == pytest.approx(heights.max(axis=1), abs=1e-4)
    assert (point * np.conj(DIRECTIONS)).real == pytest.approx(height, rel=1e-14)
    assert np.abs(point - points[heights.argmax(axis=1)]).max() < 0.3


def test_a_cam_of_one_curve_reaches_as_far_on_both_sides_of_its_start() -> None:
    """A measured motion that runs through its start: just beside it the face stood 0.023 mm off the cam."""
    motion = motion_of_table(np.radians([0, 60, 150, 240]), [0.0, 3.0, 4.0, -1.0])
    assert abs(float(motion.value(0.0, 1))) > 1
    angles = np.radians(np.linspace(-6, 6, 25))
    cam = translating_cam(motion, FollowerKind.FLAT, 30.0)
    height, _ = support(cam_shape(cam).profile, 1j * np.exp(-1j * angles))
    assert height == pytest.approx(30 + motion.value(np.mod(angles, 2 * math.pi)), abs=1e-12)


@pytest.mark.parametrize("sense", ["above", "below"])
def test_the_second_roller_stands_on_its_own_arm(sense: str) -> None:
    """So long, and by the angle between the arms farther from the axis."""
    cam = CAMS[f"swinging roller {sense}"]
    pair = conjugate_cam(cam, math.radians(315.0), radius=9.0, arm_length=70.0)
    angles = np.array([0.2, 0.9, 1.7, 3.4])
    first, second = cam.reference_point(angles) - 95.0, second_centres(cam, pair, angles) - 95.0
    assert np.abs(second) == pytest.approx(70.0, rel=1e-12)
    turned = -1.0 if sense == "above" else 1.0
    assert second / 70.0 == pytest.approx(first / 80.0 * np.exp(1j * turned * math.radians(315.0)), rel=1e-12)
    # by the first cam's law alone
    assert second_centres(cam, replace(pair, turn=1.0), angles) - 95.0 == pytest.approx(second, rel=1e-12)
