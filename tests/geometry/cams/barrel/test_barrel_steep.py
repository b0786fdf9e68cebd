"""Edges of grooves many times steeper than round: bounds that hold, and are of use."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from geometry.approximation.chords import approximate_profile
from geometry.approximation.splines import fit_spline
from geometry.base.record import replace
from geometry.cams.barrel.bounds import edge_bounds
from geometry.cams.barrel.cam import LOWER, UPPER, AxialGuide, BarrelCam, SwingGuide
from geometry.cams.barrel.development import DevelopedEdge, development
from tests.geometry.cams.barrel.test_barrel import motion
from tests.sampling import some_of

STEEP = BarrelCam(motion(600.0), AxialGuide(10.0), 2.5, 35.0, 27.0)
TALL = BarrelCam(motion(20_000.0), AxialGuide(10.0), 0.05, 35.0, 27.0)
CONE = replace(STEEP, taper=2.5 / 35.0, reference=35.0)
ARM = BarrelCam(motion(1.0), SwingGuide(240.0, 130.0, 250.0, -0.5), 2.0, 60.0, 50.0)
# grooves four fifths as wide as the barrel
WIDE = BarrelCam(motion(5.0), AxialGuide(10.0), 6.0, 7.5, 7.45)
BLUNT = replace(WIDE, taper=0.05, reference=7.5)
CAMS = {"steep": STEEP, "tall": TALL, "cone": CONE, "arm": ARM}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CAMS)
def test_bounds_of_steep_edges_hold_and_are_sharp(name: str) -> None:
    """Against derivatives at many places; on intervals as long as arcs are, the second one is near the truth."""
    cam = CAMS[name]
    # the fall is the rise again
    piece = cam.motion.moving_pieces()[0]
    for side, parts in ((UPPER, 7), (LOWER, 120)):
        edge = DevelopedEdge(cam, piece, side, 0.0, piece.start, piece.end)
        sharpest = []
        for low, high in some_of(pairwise(np.linspace(*piece.domain, parts + 1).tolist()), 7):
            inside = np.linspace(low, high, 33)
            for order in (1, 2, 3):
                most = float(np.abs(edge.derivative(inside, order)).max())
                found = edge.derivative_bound(order, low, high)
                assert found is None or most <= found * (1 + 1e-12)
                if order == 2:
                    sharpest.append(math.inf if found is None else found / most)
        # before the slope itself was counted they were thousands of times too large
        assert parts == 7 or np.median(sharpest) < 3


def test_bounds_of_values_alone_hold() -> None:
    """Order 0: the heights."""
    piece = STEEP.motion.pieces[0]
    _, height = edge_bounds(STEEP, piece, STEEP.outer, 0, np.array([0.5]), np.array([0.7]))
    assert height[0][0] >= np.abs(STEEP.wall(np.linspace(0.5, 0.7, 9), UPPER, STEEP.outer)[:, 2]).max()


def test_bounds_hold_in_the_plane_across_an_arm() -> None:
    """What the arm to the contact adds to the polar angle's derivatives counts: by differences of the exact edge."""
    piece = ARM.motion.moving_pieces()[0]
    for side in (UPPER, LOWER):
        edge = DevelopedEdge(ARM, piece, side, 0.0, piece.start, piece.end)
        for low, high in pairwise(np.linspace(*piece.domain, 40).tolist()):
            polar, _ = edge_bounds(ARM, piece, ARM.outer, 2, np.array([low]), np.array([high]))
            inside = np.linspace(low, high, 9)
            for order in (1, 2):
                most = np.abs(edge.derivative(inside, order).real).max() / ARM.outer / math.factorial(order)
                assert most <= polar[order][0] * (1 + 1e-9)


def test_a_steep_groove_takes_few_arcs_and_is_proven() -> None:
    """As many as its own error asks for; 335 for one edge when the proof could not follow."""
    low, high = STEEP.height_range()
    made = approximate_profile(development(STEEP, high + low).region.outer, 0.01, arcs=True)
    assert made.bound == "certified"
    assert made.max_error <= 0.01
    assert len(made.geometry.bulges) < 120


def test_a_groove_nearly_as_wide_as_its_barrel_is_drawn() -> None:
    """Bounds that took the contact to lie wherever the roller is were 10^5 times too large: no tolerance was kept."""
    for cam in (WIDE, BLUNT):
        for piece in cam.motion.moving_pieces():
            edge = DevelopedEdge(cam, piece, LOWER, 0.0, *piece.domain)
            inside = edge.derivatives(np.linspace(*piece.domain, 60), 2)
            cuts = np.linspace(*piece.domain, 60)
            for order in (1, 2):
                most = np.maximum(np.abs(inside[order][1:]), np.abs(inside[order][:-1]))
                bounds = edge.derivative_bounds(cuts, (order,))[0]
                assert np.all(bounds >= most)
                assert bounds.max() < 200 * most.max()
    part = replace(DevelopedEdge(WIDE, piece, LOWER, 0.0, *piece.domain), end=piece.start + 0.5)
    assert fit_spline(part, 4.8e-7, degree=3, continuity=2).bound == "certified"
