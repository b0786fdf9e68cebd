"""The device TMM-42: contours that stay out of the tooth and close in on it, cut off at the disk."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.curves.line_arc import Arc, Line
from geometry.gears.pictures.generating import inside_disk, rack_contours, rack_positions, rack_tooth
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from tests.brute import works

GEARS = {
    "undercut": SpurGear(16.0, 10, iso_53("A")),
    "shifted": SpurGear(16.0, 10, iso_53("A"), 7 / 17),
    "relieved": SpurGear(2.0, 23, iso_53("B", relief=TipRelief(0.02)), 0.2),
    "thinned": SpurGear(2.0, 17, iso_53("C"), circumferential_thinning=0.1),
    "deeper": SpurGear(2.0, 17, iso_53("C"), circumferential_thinning=0.1, thinning_by_deeper_cut=True),
    "sharp": SpurGear(5.0, 12, replace(iso_53("A"), tip_radius=0.0), 0.3),
}


def material(gear: SpurGear) -> shapely.Polygon:
    """Tooth 1 and half of both spaces, closed over the axis."""
    period = tooth_side(gear).profile().period
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 400)) for s in period])
    return shapely.Polygon([(0.0, 0.0), *((p.real, p.imag) for p in points)])


def samples(gear: SpurGear, step: float) -> np.ndarray:
    rows = rack_contours(gear, gear.tip_radius, step, 3)
    return np.concatenate([c.point(np.linspace(*c.domain, 200)) for row in rows for c in row])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", GEARS)
def test_contours_stay_out_of_the_material_and_close_in_on_the_flanks(name: str) -> None:
    gear = GEARS[name]
    m = gear.module
    points = samples(gear, 0.02 * m)
    inner = material(gear).buffer(-2e-4 * m)
    shapely.prepare(inner)
    assert not shapely.contains_xy(inner, points.real, points.imag).any()
    # the envelope: no point of the tooth's side is farther from the contours than a fine step leaves
    for segment in tooth_side(gear).segments:
        for point in segment.curve.point(np.linspace(*segment.curve.domain, 12))[1:-1]:
            if segment.label.value != "tip_land":
                assert np.abs(points - point).min() < 0.05 * m, segment.label


def test_a_rack_at_another_shift_would_cut_the_tooth() -> None:
    gear = GEARS["shifted"]
    deeper = replace(gear, profile_shift_coefficient=7 / 17 - 0.02, given_tip_diameter=2 * gear.tip_radius)
    points = samples(deeper, 0.5)
    inner = material(gear).buffer(-2e-4 * gear.module)
    shapely.prepare(inner)
    assert shapely.contains_xy(inner, points.real, points.imag).any()


@pytest.mark.parametrize("name", GEARS)
def test_the_rack_tooth_is_the_basic_rack(name: str) -> None:
    gear = GEARS[name]
    curves = rack_tooth(gear)
    points = np.concatenate([c.point(np.linspace(*c.domain, 2001)) for c in curves])
    joints = [abs(complex(a.point(a.domain[1])) - complex(b.point(b.domain[0]))) for a, b in pairwise(curves)]
    assert max(joints) < 1e-9 * gear.module
    assert points.real.min() == pytest.approx(-gear.rack.dedendum * gear.module, rel=1e-12)
    widening = 0.0 if gear.thinning_by_deeper_cut else gear.circumferential_thinning
    flank = next(c for c in curves if isinstance(c, Line) and c.start.real > 0 > c.end.real)
    share = flank.start.real / (flank.start.real - flank.end.real)
    half = complex(flank.point(share)).imag
    if gear.rack.relief is None:
        assert 2 * half == pytest.approx(math.pi * gear.module / 2 + widening, rel=1e-12)


def test_positions_are_a_step_apart_and_cover_the_teeth() -> None:
    gear = GEARS["undercut"]
    angles = rack_positions(gear, 4.5, 3)
    assert np.allclose(np.diff(angles) * gear.reference_radius, 4.5)
    assert angles[-1] >= 2.5 * gear.pitch_angle
    assert 0.0 in angles
    with pytest.raises(ParameterError, match="too_many_positions") as caught:
        rack_positions(gear, 1e-3, 3)
    assert rack_positions(gear, works(caught.value), 3)


@pytest.mark.parametrize("seed", range(20))
def test_what_is_kept_is_what_lies_inside_the_disk(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b, c = rng.normal(size=3) + 1j * rng.normal(size=3)
    for curve in (Line(a, b), Arc(c, abs(a) + 0.1, float(b.real), 1.0 + abs(b.imag)), Arc(c, 0.7, 0.3, -4.0)):
        t = np.linspace(*curve.domain, 20_001)
        inside = np.abs(curve.point(t)) < 1.0
        length = np.abs(np.diff(curve.point(t)))[inside[1:]].sum()
        kept = inside_disk(curve, 1.0)
        found = sum(np.abs(np.diff(k.point(np.linspace(*k.domain, 20_001)))).sum() for k in kept)
        assert found == pytest.approx(length, abs=2e-3)
        assert all(np.abs(k.point(np.linspace(*k.domain, 50))).max() < 1 + 1e-9 for k in kept)
