"""Timing belt drives: length and distance by polygons of shapely, places of the belt's teeth, textbooks."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from shapely.geometry import Point, Polygon
from shapely.ops import unary_union

from geometry.gears.belts.belt import belt_of
from geometry.gears.belts.drive import BeltDrive, BeltMesh, exact_distance, textbook_distance
from geometry.gears.belts.pulley import Pulley

DRIVES = [((20, 60), 100, 2.0), ((60, 20), 101, 2.0), ((16, 16), 80, 2.0), ((10, 72), 90, 5.0), ((72, 10), 91, 5.0)]


def made(teeth: tuple[int, int], count: int, pitch: float) -> BeltDrive:
    """A drive with a taut belt."""
    one, two = (z * pitch / (2 * math.pi) for z in teeth)
    distance = exact_distance((one, two), count * pitch, one + two)
    assert distance is not None
    return BeltDrive((one, two), distance)


@pytest.mark.parametrize(("teeth", "count", "pitch"), DRIVES)
def test_a_taut_belt_is_the_hull_of_both_circles(teeth: tuple[int, int], count: int, pitch: float) -> None:
    drive = made(teeth, count, pitch)
    discs = [Point(x, 0).buffer(r, 4_000) for x, r in zip((0.0, drive.distance), drive.radii, strict=True)]
    assert unary_union(discs).convex_hull.length == pytest.approx(count * pitch, rel=1e-6)
    assert drive.length == pytest.approx(count * pitch, rel=1e-14)
    near = textbook_distance(drive.radii, count * pitch)
    assert near == pytest.approx(drive.distance, rel=2e-3)
    if teeth[0] == teeth[1]:
        assert near == pytest.approx((count - teeth[0]) * pitch / 2)
        assert drive.distance == pytest.approx((count - teeth[0]) * pitch / 2)


@pytest.mark.parametrize(("teeth", "count", "pitch"), DRIVES)
def test_teeth_of_the_belt_stand_in_grooves_of_both(teeth: tuple[int, int], count: int, pitch: float) -> None:
    """Places one pitch apart along the hull; those on a pitch circle at whole pitches from a groove."""
    drive = made(teeth, count, pitch)
    for first in math.pi + np.linspace(-0.5, 0.5, 7) * 2 * math.pi / teeth[0]:
        places = drive.teeth(first, pitch, count)
        assert abs(places[0] - cmath.rect(drive.radii[0], first)) < 1e-9
        steps = np.abs(np.diff(np.append(places, places[0])))
        assert steps.max() <= pitch * (1 + 1e-12)
        assert steps.min() >= 2 * min(drive.radii) * math.sin(pitch / 2 / min(drive.radii)) - 1e-9
        # clockwise
        assert Polygon(np.column_stack((places.real, places.imag))).exterior.is_ccw is False
        phases = first, drive.second_phase(first, pitch)
        for axis, radius, phase, z in zip((0.0, drive.distance), drive.radii, phases, teeth, strict=True):
            seated = places[np.abs(np.abs(places - axis) - radius) < 1e-9]
            share = (np.angle(seated - axis) - phase) * z / (2 * math.pi)
            assert len(seated) >= min(drive.loop.both_wraps) / (2 * math.pi) * z - 1
            assert np.abs(share - np.round(share)).max() < 1e-7


def test_loose_belts_and_few_teeth_in_mesh_are_told() -> None:
    belt = belt_of("5M")
    assert belt is not None
    one, two = Pulley(12, belt), Pulley(72, belt)
    taut = exact_distance((one.pitch_radius, two.pitch_radius), 500.0, 60.0)
    assert taut is not None
    assert [f.code for f in BeltMesh((one, two), taut, 100).findings()] == ["few_belt_teeth_in_mesh"]
    # half of twelve are enough
    assert BeltMesh((one, one), 5.0 * (50 - 12) / 2, 50).findings() == ()
    loose = BeltMesh((two, two), 60.0, 100)
    assert loose.slack == pytest.approx(500 - 120 - 360)
    assert [f.code for f in loose.findings()] == ["belt_hangs_loose"]
    # a fiftieth of a millimetre too
    assert [f.code for f in BeltMesh((two, two), 69.99, 100).findings()] == ["belt_hangs_loose"]
    assert BeltMesh((two, two), 70.0, 100).findings() == ()
    assert exact_distance((one.pitch_radius, two.pitch_radius), 200.0, 70.0) is None
    assert textbook_distance((one.pitch_radius, two.pitch_radius), 200.0) is None
    assert textbook_distance((10.0, 10.0), 30.0) is None
