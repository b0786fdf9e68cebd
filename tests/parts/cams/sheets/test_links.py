"""The linkage of a cam's sheet: joints keep their lengths and lines, the follower sits where it should on the rod."""

from __future__ import annotations

import cmath
import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from geometry.cams.plane.coupler import LinkageCam
from geometry.curves.line_arc import Arc, Line
from parts.cams.sheets.diagrams import Drawn
from parts.cams.sheets.links import draw_links, frame_ray, joints_at, linkage_cam_of, links_reach, name_links
from parts.cams.sheets.picture import cam_picture
from parts.drawing.canvas import Box, Canvas, Paper
from parts.drawing.choice import blank
from parts.drawing.labels import Labeller, nearest
from tests.parts.cams.coupler_cam.test_linkage_cam import FOUR, SLID, cam_of

PAPER = Paper(2.0, 250 + 300j)
# of the rocker: both pivots; the point on the rod, from A along it and to its left
PIVOTS = (91 + 26j, 62 + 124j)
POINTS = {"rocker": 6 + 16j, "slider": 6 + 9j}


@cache
def cam(name: str) -> LinkageCam:
    return cam_of({"rocker": FOUR, "slider": SLID}[name])


@pytest.mark.parametrize("name", ["rocker", "slider"])
def test_joints_keep_their_lengths_and_lines(name: str) -> None:
    made, coupler = cam(name), {"rocker": 43.0, "slider": 50.0}[name]
    for angle in np.linspace(0, 2 * math.pi, 25):
        joint, far, place = joints_at(made, float(angle))
        along = (far - joint) / coupler
        assert abs(along) == pytest.approx(1, rel=1e-12)
        assert place == pytest.approx(joint + POINTS[name] * along, rel=1e-12)
        assert place == pytest.approx(complex(made.place(angle)), rel=1e-12)
        moved = float(made.motion.value(angle))
        if name == "rocker":
            # 167 degrees at the start, clockwise from there unless it is told otherwise
            turned = cmath.phase((joint - PIVOTS[0]) / cmath.rect(58, math.radians(167)))
            assert (abs(joint - PIVOTS[0]), abs(far - PIVOTS[1])) == (pytest.approx(58), pytest.approx(68))
            assert abs(turned) == pytest.approx(moved, abs=1e-12)
        else:
            assert joint == pytest.approx(25 + 30j + cmath.rect(moved, math.radians(70)), rel=1e-12)
            assert ((far - 50j) / cmath.rect(1, math.radians(10))).imag == pytest.approx(0, abs=1e-9)


def test_the_frames_ray_ends_in_the_driven_pivot_or_farther() -> None:
    rocker, slider = cam("rocker"), cam("slider")
    assert frame_ray(rocker, 10.0) == pytest.approx(PIVOTS[0])
    far = frame_ray(rocker, 150.0)
    assert abs(far) == pytest.approx(150.0)
    assert cmath.phase(far) == pytest.approx(cmath.phase(PIVOTS[0]))
    assert frame_ray(slider, 10.0) == pytest.approx(25 + 30j)


def drawn(name: str) -> tuple[Canvas, Any]:
    canvas, picture = blank("A1", upright=True), cam_picture(cam(name), 4, None, 5.0, "en")
    draw_links(canvas, Drawn(), picture, cam(name), PAPER, 120.0)
    return canvas, picture


@pytest.mark.parametrize("name", ["rocker", "slider"])
def test_all_positions_have_a_ray_and_a_rod_and_four_of_them_all_links(name: str) -> None:
    canvas, picture = drawn(name)
    made, count = cam(name), len(picture.positions)
    angles = [p.angle for p in picture.positions]
    thin = [s.curve for s in canvas.strokes if s.layer == "CONSTRUCTION"]
    thick = [s.curve for s in canvas.strokes if s.layer == "FOLLOWER"]

    def has(curves: list[Any], start: complex, end: complex) -> bool:
        ends = PAPER.point(start), PAPER.point(end)
        return any(
            isinstance(c, Line) and abs(c.start - ends[0]) + abs(c.end - ends[1]) < 1e-9 for c in curves
        )  # fmt: skip

    whole = {int(np.argmin([abs(a - k * math.pi / 2) for a in angles])) for k in range(4)}
    assert len(whole) == 4
    for k, angle in enumerate(angles):
        back = cmath.exp(-1j * angle)
        joint, far, place = (p * back for p in joints_at(made, angle))
        assert has(thin, 0j, frame_ray(made, 120.0) * back)
        own = thick if k in whole else thin
        assert has(own, joint, place)
        assert has(thick, joint, far) == has(thick, far, place) == (k in whole)
        if name == "rocker":
            assert has(own, PIVOTS[0] * back, joint)
            assert has(thick, far, PIVOTS[1] * back) == (k in whole)
    circles = [c for c in thick if isinstance(c, Arc)]
    joints = 4 if name == "rocker" else 2
    assert len(circles) == 4 * joints
    assert len({round(c.radius, 9) for c in circles}) == 1
    for k in whole:
        back = cmath.exp(-1j * angles[k])
        points = list(joints_at(made, angles[k])[:2]) + (list(PIVOTS) if name == "rocker" else [])
        for point in points:
            assert min(abs(c.centre - PAPER.point(point * back)) for c in circles) < 1e-9
        if name == "slider":
            # a line and a rectangle along the way of each, about its joint
            for point, way in zip(points, (70.0, 10.0), strict=True):
                along, at = cmath.rect(1, math.radians(way)) * back, PAPER.point(point * back)
                own = [c for c in thick if isinstance(c, Line)]
                inside = [((c.start - at) / along, (c.end - at) / along) for c in own]
                guide = [(a, b) for a, b in inside if abs(a + b) < 1e-9 and abs(a.imag) + abs(b.imag) < 1e-9]
                assert len(guide) == 1
                assert guide[0][0].real < 0 < guide[0][1].real
                sides = [(a, b) for a, b in inside if abs(abs(a) - abs(b)) < 1e-9 and 4 < abs(a) < 5]
                assert [b for _, b in sides] == pytest.approx([a for a, _ in (*sides[1:], sides[0])], abs=1e-9)
                assert [a for a, _ in sides] == pytest.approx([4 + 2j, -4 + 2j, -4 - 2j, 4 - 2j], abs=1e-9)
    # the rays, the rods that are thin, and the driven rockers
    assert len(thin) == count + (count - 4) * (2 if name == "rocker" else 1)
    # nothing goes farther from the axis than is told
    reach = links_reach(picture, made, PAPER.scale)
    ends = [p for c in thick for p in c.point(np.linspace(*c.domain, 9))]
    farthest = max(abs(p - PAPER.origin) for p in ends) / PAPER.scale
    assert farthest <= reach * (1 + 1e-9)
    if name == "rocker":
        assert farthest == pytest.approx(reach, rel=1e-3)


def test_words_stand_by_joints_pivots_and_the_middles_of_links() -> None:
    canvas, picture = drawn("rocker")
    made, before = cam("rocker"), len(canvas.strokes)
    assert linkage_cam_of(picture) is made
    joint, far, place = joints_at(made, 0.0)
    name_links(Labeller(canvas, Box(20.0, 5.0, 580.0, 830.0)), picture, made, PAPER)
    places = {"A": joint, "B": far, "O2": place, "O1": PIVOTS[0], "C": PIVOTS[1], "b = 43.00": (joint + far) / 2,
              "l1 = 58.00": (PIVOTS[0] + joint) / 2, "c = 68.00": (PIVOTS[1] + far) / 2}  # fmt: skip
    assert {t.text for t in canvas.texts} == set(places)
    for text in canvas.texts:
        at = PAPER.point(places[text.text])
        near = nearest(text.box, at)
        leads = [s.curve for s in canvas.strokes[before:] if isinstance(s.curve, Line)]
        assert abs(near - at) <= 3 or any(abs(c.start - at) + abs(c.end - near) < 1e-9 for c in leads)
        # lengths are given, joints are names
        assert text.answer is (False if "=" in text.text else None)
