"""Sections of crowned teeth against the involute's own formula: a mesh tells them to 0.01 mm only."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.plane.profile import Label
from geometry.solids.body import Body
from geometry.solids.chamfer import cut_chamfers, level_pieces, openings
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import Keys

WIDTH, CROWNING = 12.0, 0.06
GEAR: Keys = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "face_width": WIDTH, "crowning": CROWNING}


def body_of(offset: float = 0.0, **keys: object) -> Body:
    body = make_parts(scene_from_dict({"parts": {"p": GEAR | keys}}, "s", "s"), "s")[0]["p"].body(offset)
    assert isinstance(body, Body)
    return body


@pytest.mark.parametrize("offset", [0.0, 0.03])
@pytest.mark.parametrize(("below", "above"), [(0.0, 0.0), (0.3, 0.8)])
@pytest.mark.parametrize(("helix", "double"), [(0.0, False), (-28.0, False), (-28.0, True)])
def test_flanks_go_back_along_their_normals(
    below: float, above: float, offset: float, helix: float, double: bool
) -> None:
    """By c = C (2 z / b - 1)^2: each turns by c / r_b about the axis; a chamfer lowers the tips at its own end.

    A helix turns the section by tan(beta) / r for each mm, but for its chamfers; that of double helical teeth goes back
    from the middle on, and each half is crowned by itself.
    """
    left: Keys = {"helix_angle_deg": -helix, "hand": "left", "double_helical": double} if helix else {}
    body = body_of(offset, face_chamfer={"below": below, "above": above}, **left)
    turn, radius = math.radians(helix), 23.0 / math.cos(math.radians(helix))
    alpha = math.atan(math.tan(math.radians(20)) / math.cos(turn))
    base = radius * math.cos(alpha)
    for z in (0.1, 2.0, 6.0, 11.4):
        there = [wall for wall in body.walls if body.height(wall)[0] <= z <= body.height(wall)[1]]
        profile = max((body.standing(wall, z) for wall in there), key=lambda p: p.reach())
        depth = max(below - z, z - (WIDTH - above), 0.0)
        assert profile.reach() == pytest.approx(radius + 2 + offset - depth, abs=0.01)
        flanks = [s.curve for s in profile.segments() if s.label == Label.FLANK]
        points = np.concatenate([curve.point(np.linspace(curve.domain[0], curve.domain[1], 5)) for curve in flanks])
        between, width = min(max(z, below), WIDTH - above), WIDTH / 2 if double else WIDTH
        points *= np.exp(-1j * math.tan(turn) / radius * (min(between, WIDTH - between) if double else between))
        pressed = np.arccos(base / np.abs(points))
        half = math.pi / 46 + math.tan(alpha) - alpha - np.tan(pressed) + pressed
        moved = CROWNING * (2 * (z % width) / width - 1) ** 2 + depth - offset
        pitch = math.tau / 23
        aside = np.abs(np.angle(points) - pitch * np.round(np.angle(points) / pitch))
        assert aside == pytest.approx(half - moved / base, abs=1e-9)


@pytest.mark.parametrize(
    "more",
    [{}, {"helix_angle_deg": 28.0}, {"number_of_teeth": 9, "crowning": 0.01},
     {"crowning": 0.0, "profile_shift_coefficient": 0.4, "face_chamfer": 0.7,
      "basic_rack": {"tip_radius_coefficient": 0.01}}],
)  # fmt: skip
def test_no_edge_opens_in_teeth_without_cusps(more: Keys) -> None:
    """Neither at the joint of two teeth, where curves are smooth, nor by a corner of undercut that goes in by 0.01."""
    body = body_of(**more)
    chamfers = list(body.chamfers())
    assert len(chamfers) == 2
    assert [openings(body, *chamfer) for chamfer in chamfers] == [(), ()]


def test_slices_are_no_lower_than_a_file_tells() -> None:
    """Undercut teeth of a helix, whose edges open in the chamfers: the lowest slice of a sector had 3e-6 mm."""
    body = body_of(number_of_teeth=9, helix_angle_deg=39.8, crowning=0.003, face_chamfer=0.8)
    assert any(openings(body, *chamfer) for chamfer in body.chamfers())
    levels = cut_chamfers(body, level_pieces(body, 1e-4)).levels()
    assert len(levels) > 50
    assert min(np.diff(levels)) > 1e-4 / 17
