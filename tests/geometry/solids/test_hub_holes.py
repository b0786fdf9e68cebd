"""Holes beside one another: what lies inside a hole, the walls that are left, and what touches."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from geometry.base.errors import OffsetError, ParameterError
from geometry.plane.profile import Profile
from geometry.solids.bores import KeywayBore, PolygonBore, RoundBore
from geometry.solids.hub_holes import HubHoles, encloses
from geometry.solids.windows import RoundHoles, Spokes
from tests import brute
from tests.geometry.solids.test_bores import BORES, MAKERS, outline
from tests.sampling import some_of


def test_what_lies_inside_a_hole() -> None:
    """Winding by chords and arcs against shapely, the axis and far points among them."""
    rng = np.random.default_rng(3)
    for name, maker in MAKERS.items():
        for profile in maker(0.0)[:2]:
            ring = outline(profile, 500)
            polygon = shapely.Polygon([(z.real, z.imag) for z in ring])
            middle, size = complex(np.mean(ring)), float(np.ptp(ring.real))
            places = middle + size * (rng.random(30) - 0.5 + 1j * (rng.random(30) - 0.5)) * 1.5
            for z in some_of(places.tolist(), 12):
                if np.abs(ring - z).min() > 1e-3 * size:
                    assert encloses(profile, np.array([z])) == polygon.contains(shapely.Point(z.real, z.imag)), name


def least_wall(one: Profile, other: Profile) -> float:
    """Dense points of one hole that are about the nearest to such points of the other, from that one's curves."""
    points = outline(one, 200)
    away = np.abs(points[:, None] - outline(other, 100)).min(axis=1)
    return float(brute.distance_to_outline(points[away < away.min() + 1.0], other).min())


def test_walls_between_holes_against_brute_force() -> None:
    """The least wall, as the growth that is refused tells it, against dense points of all holes."""
    hubs = {
        "bore and holes": HubHoles(BORES["keyway"], (RoundHoles(5, 6.0, 26.0, math.pi / 2),)),
        "hole beside the keyway": HubHoles(BORES["keyway"], (RoundHoles(1, 4.0, 18.0, 0.0),)),
        "two groups": HubHoles(None, (RoundHoles(6, 3.0, 20.0), RoundHoles(6, 2.5, 27.0, math.pi / 6))),
        "hole in a spoke": HubHoles(None, (RoundHoles(4, 2.0, 30.0, 0.2),), Spokes(4, 16.0, 44.0, 6.0, 1.0, 0.2)),
        "spokes and bore": HubHoles(BORES["hexagon"], (), Spokes(4, 16.0, 44.0, 16.0 / 2, 1.0)),
    }
    for name, hub in hubs.items():
        hub.check(30.0)
        profiles = hub.profiles()
        least = min(least_wall(p, q) for i, p in enumerate(profiles) for q in profiles[:i])
        if name == "spokes and bore":
            # windows keep clear of the circle about the bore, not only of the bore itself
            assert least > 8.0 - 6.35 / math.sqrt(3)
            least = 8.0 - 6.35 / math.sqrt(3)
        with pytest.raises(OffsetError) as caught:
            hub.profiles(-25.0)
        assert -2 * caught.value.nearest_offset == pytest.approx(least, rel=1e-4), name
        hub.profiles(caught.value.nearest_offset)


TOUCHING: dict[str, tuple[HubHoles, str]] = {
    "holes in the root": (HubHoles(None, (RoundHoles(5, 8.0, 33.0),)), "holes.pitch_circle_diameter"),
    "holes in each other": (HubHoles(None, (RoundHoles(5, 8.0, 13.0),)), "holes.diameter"),
    "holes in the bore": (HubHoles(RoundBore(10.0), (RoundHoles(3, 8.0, 17.9),)), "holes.diameter"),
    "hole inside the bore": (HubHoles(RoundBore(30.0), (RoundHoles(1, 1.0, 10.0),)), "holes.diameter"),
    "hole round the bore": (HubHoles(RoundBore(1.0), (RoundHoles(1, 10.0, 3.0),)), "holes.diameter"),
    "hole in a window": (HubHoles(None, (RoundHoles(1, 1.0, 30.0),), Spokes(5, 20.0, 36.0, 3.0)), ""),
    "hole on a spoke": (HubHoles(None, (RoundHoles(5, 3.1, 30.0),), Spokes(5, 20.0, 36.0, 3.0)), "holes.diameter"),
    "groups": (HubHoles(None, (RoundHoles(3, 5.0, 20.0), RoundHoles(2, 5.0, 22.0))), "holes[2].diameter"),
    "bore in the root": (HubHoles(KeywayBore(40.0, 12.0, 3.3)), "bore.diameter"),
    "windows in the root": (HubHoles(None, (), Spokes(5, 20.0, 41.0, 3.0)), "spokes.outer_diameter"),
    "windows in the bore": (HubHoles(PolygonBore(6, 18.0), (), Spokes(5, 20.0, 36.0, 3.0)), "spokes.inner_diameter"),
}


@pytest.mark.parametrize("name", TOUCHING)
def test_holes_that_touch_are_refused(name: str) -> None:
    hub, key = TOUCHING[name]
    if not key:
        # on the first spoke, thinner than it
        assert hub.fits(20.5)
        return
    with pytest.raises(ParameterError) as caught:
        hub.check(20.5)
    assert caught.value.name == key
