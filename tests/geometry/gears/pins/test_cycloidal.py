"""Cycloidal discs: swept pins, the published equation, limits, contact with its negative controls, offsets."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.approximation.chords import approximate_profile
from geometry.approximation.outline import spline_outline
from geometry.base.errors import GeometryError, OffsetError, ParameterError, UndercutError
from geometry.base.record import replace
from geometry.gears.mesh.search import gear_outline
from geometry.gears.pins.contact import DiscMotion, lost_motion, pin_contact, pin_gaps, pins_in_contact
from geometry.gears.pins.cycloidal import CycloidalDisc, checked_disc, disc_findings, disc_region
from geometry.plane.distance import Boundary, Verdict, folded
from geometry.plane.measure import profile_area
from tests.oracles.pin_sweep import disc_pins, least_distance
from tests.sampling import examples, some_of
from tests.strategies import numbers

PUBLISHED = json.loads((Path(__file__).parents[3] / "published" / "cycloidal_discs.json").read_text())
DISC = CycloidalDisc(11, 80.0, 8.0, 2.5)
DISCS = {
    "11 lobes": DISC,
    "2 lobes": CycloidalDisc(2, 80.0, 30.0, 5.0),
    "3 lobes, near the cusp": CycloidalDisc(3, 40.0, 4.0, 4.9),
    "29 lobes": CycloidalDisc(29, 100.0, 5.0, 0.85),
    "100 lobes": CycloidalDisc(100, 200.0, 4.0, 0.8),
}
EVERY = pytest.mark.parametrize("disc", DISCS.values(), ids=DISCS.keys())


def contact(disc: CycloidalDisc, turn: float = 0.0, shift: float = 0.0, cut: CycloidalDisc | None = None):
    """The contact of a disc's pins with its own outline, or with that of another disc."""
    return pin_contact((cut or disc).side(), DiscMotion(disc, turn, shift))


@EVERY
def test_outline_is_what_the_swept_pins_leave(disc: CycloidalDisc) -> None:
    """Every point of the outline is a pin's radius from the pins' ways, to 1e-10 of it: none cuts deeper."""
    drive = np.linspace(0, 2 * math.pi * disc.number_of_lobes, 400 * disc.number_of_lobes + 1)
    radius, pin = disc.pin_circle_diameter / 2, disc.pin_diameter / 2
    # one pin passes everything in as many turns as there are lobes
    centres = disc_pins(disc.number_of_pins, radius, disc.eccentricity)[:1]
    turn = cmath.exp(1j * math.pi / disc.number_of_lobes)
    for segment in disc.side().segments:
        low, high = segment.curve.domain
        for share in (0.0, 0.37, 0.81):
            point = complex(segment.curve.point(low + share * (high - low))) * turn
            assert abs(least_distance(point, centres, drive) - pin) <= 1e-10 * pin


@pytest.mark.sampled(1)
@pytest.mark.parametrize("case", PUBLISHED["cases"], ids=str)
def test_published_equation(case: list[float]) -> None:
    radius, pin, e, pins = case
    number = int(pins)
    disc = checked_disc(CycloidalDisc(number - 1, 2 * radius, 2 * pin, e))
    t = np.linspace(0, 2 * math.pi, 24 * number, endpoint=False)
    psi = np.arctan(np.sin((1 - pins) * t) / (radius / (e * pins) - np.cos((1 - pins) * t)))
    x = radius * np.cos(t) - pin * np.cos(t + psi) - e * np.cos(pins * t)
    y = -radius * np.sin(t) + pin * np.sin(t + psi) + e * np.sin(pins * t)
    # theirs begins in a valley on +x
    points = (x + 1j * y) * cmath.exp(1j * math.pi / (number - 1))
    boundary = Boundary(tuple(s.curve for s in disc.profile().segments()), closed=True)
    assert np.abs(boundary.feet(points).distance).max() <= 1e-12 * radius


@pytest.mark.sampled(1)
@EVERY
def test_all_pins_touch_at_every_angle(disc: CycloidalDisc) -> None:
    found = contact(disc)
    assert found.verdict is Verdict.CONTACT
    assert abs(found.worst.gap) <= 1e-12 * disc.pin_diameter
    _, gaps = pin_gaps(disc.side(), DiscMotion(disc))
    assert np.abs(gaps).max() <= 1e-12 * disc.pin_diameter
    assert pins_in_contact(disc.side(), DiscMotion(disc)) == disc.number_of_pins
    assert lost_motion(disc.side(), DiscMotion(disc)) <= 1e-12


def test_the_contact_check_notices_what_is_wrong() -> None:
    allowed = 1e-8 * 4.0
    for turn, shift in some_of(((1e-6, 0.0), (-1e-6, 0.0), (0.0, 1e-6), (0.0, -1e-6)), 2):
        found = contact(DISC, turn, shift)
        assert found.verdict is Verdict.OVERLAP, (turn, shift)
        assert found.worst.gap < -allowed
    # a shift is seen in full by the pin that it points to
    assert contact(DISC, 0.0, 1e-3).worst.gap == pytest.approx(-1e-3, rel=1e-6)
    # a disc for thicker, thinner or wider pins
    assert contact(DISC, cut=replace(DISC, pin_diameter=8.001)).verdict is Verdict.CLEAR
    assert contact(DISC, cut=replace(DISC, pin_diameter=7.999)).verdict is Verdict.OVERLAP
    assert contact(DISC, cut=replace(DISC, pin_circle_diameter=80.001)).verdict is Verdict.OVERLAP
    assert contact(DISC, cut=replace(DISC, eccentricity=2.5001)).verdict is Verdict.OVERLAP


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("clearance", "shift"), [(0.1, 0.0), (0.0, 0.1), (0.02, 0.05), (0.3, -0.1)])
def test_clearance(clearance: float, shift: float) -> None:
    disc = checked_disc(replace(DISC, pin_clearance=clearance, pin_circle_shift=shift))
    found = contact(disc)
    assert found.verdict is Verdict.CLEAR
    if shift == 0:
        # an equidistant leaves the same gap at every pin
        assert found.worst.gap == pytest.approx(clearance, abs=1e-12)
        assert found.greatest_gap == pytest.approx(clearance, abs=1e-12)
    assert pins_in_contact(disc.side(), DiscMotion(disc)) == 0
    # to the first order in the gaps
    assert lost_motion(disc.side(), DiscMotion(disc)) == pytest.approx(played(disc), rel=0.02)


def played(disc: CycloidalDisc) -> float:
    """How far the disc turns from stop to stop at the freest of 24 drive angles, rad: by halving, gap by gap."""
    pins, outline = disc.number_of_pins, gear_outline(disc.side())
    drives = (np.arange(24) + 0.5) * 2 * math.pi / pins / 24
    angles = drives[:, None] - 2 * math.pi * np.arange(pins) / pins
    centres = disc.pin_circle_diameter / 2 - disc.eccentricity * np.exp(1j * angles)
    centres = centres * np.exp(1j * (angles - math.pi) / disc.number_of_lobes)
    total = np.zeros(24)
    for sense in (-1, 1):
        low, high = np.zeros(24), np.full(24, math.pi / disc.number_of_lobes)
        for _ in range(24):
            middle = (low + high) / 2
            points = (centres * np.exp(-1j * sense * middle)[:, None]).ravel()
            distance = outline.feet(folded(points, points, disc.pitch_angle)[0]).distance.reshape(24, pins).min(axis=1)
            free = distance > disc.pin_diameter / 2
            low, high = np.where(free, middle, low), np.where(free, high, middle)
        total += low
    return float(total.max())


def refused(disc: CycloidalDisc) -> ParameterError:
    with pytest.raises(ParameterError) as caught:
        checked_disc(disc)
    return caught.value


@pytest.mark.parametrize(
    ("change", "key", "kind"),
    [
        ({"eccentricity": 3.4}, "eccentricity", UndercutError),
        ({"eccentricity": 3.3}, "eccentricity", UndercutError),
        ({"eccentricity": 30.0}, "eccentricity", UndercutError),
        ({"eccentricity": 1e-6}, "eccentricity", ParameterError),
        ({"pin_diameter": 21.0}, "pin_diameter", ParameterError),
        ({"pin_clearance": 36.0}, "pin_clearance", ParameterError),
        ({"pin_clearance": -4.0}, "pin_clearance", ParameterError),
        ({"pin_circle_shift": 36.5}, "pin_circle_shift", ParameterError),
    ],
)
def test_limits_name_what_works(change: dict[str, float], key: str, kind: type[ParameterError]) -> None:
    error = refused(replace(DISC, **change))
    assert error.name == key
    assert isinstance(error, kind)
    assert error.nearest is not None
    named = error.nearest.value
    assert isinstance(named, float)
    changed = replace(DISC, **{**change, key: named})
    made = checked_disc(changed)
    assert made.profile()
    if key == "eccentricity":
        beyond = replace(changed, eccentricity=named * (1.0001 if change["eccentricity"] > 1 else 0.99))
        assert refused(beyond).name == key


def most_eccentricity() -> float:
    cure = refused(replace(DISC, eccentricity=3.3)).nearest
    assert cure is not None
    assert cure.side == "at_most"
    assert isinstance(cure.value, float)
    return cure.value


def test_the_limit_is_where_the_lobes_get_cusps() -> None:
    most = most_eccentricity()
    for e, regular in ((most, True), (most * 1.001, False)):
        disc = replace(DISC, eccentricity=e)
        curve = replace(disc.side().segments[0].curve, start=0.0, end=math.pi / 11)
        speeds = 1 - disc.generating_pin_radius * curve.path_curvature(np.linspace(0, math.pi / 11, 100_001))
        assert bool(speeds.min() > 0) is regular


discs = st.builds(
    CycloidalDisc,
    st.integers(2, 60),
    numbers(5, 300),
    numbers(0.05, 80),
    numbers(1e-3, 40),
    st.one_of(st.just(0.0), numbers(-0.5, 2)),
    st.one_of(st.just(0.0), numbers(-1, 2)),
)


@examples(50)
@given(discs)
def test_any_disc_is_built_or_refused_with_what_works(disc: CycloidalDisc) -> None:
    for _ in range(4):
        try:
            made = checked_disc(disc)
            break
        except ParameterError as error:
            if error.nearest is None:
                pytest.fail(f"no remedy: {error}")
            changed: dict[str, Any] = {error.name: error.nearest.value}
            disc = replace(disc, **changed)
    else:
        pytest.fail(f"{disc}: every remedy was refused")
    assert made.root_radius > 0
    assert made.least_curvature_radius > 0
    area = profile_area(made.profile())
    assert math.pi * made.root_radius**2 < area < math.pi * made.tip_radius**2
    if disc.pin_clearance == disc.pin_circle_shift == 0:
        assert contact(made).verdict is Verdict.CONTACT


@pytest.mark.sampled(2)
@EVERY
def test_offsets_are_parallel_and_end_where_they_are_told(disc: CycloidalDisc) -> None:
    boundary = gear_outline(disc.side())
    least, most = disc.offset_limits()
    for offset in (0.9 * least, 0.1, min(0.9 * most, 5.0)):
        if not least < offset < most:
            continue
        moved = disc_region(disc, offset).region.outer
        points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 7)) for s in moved.period])
        points = folded(points, points, disc.pitch_angle)[0]
        assert np.allclose(boundary.feet(points).distance, offset, rtol=0, atol=1e-10 * disc.pin_circle_diameter)
    with pytest.raises(OffsetError) as caught:
        disc_region(disc, 1.01 * least)
    assert disc_region(disc, caught.value.nearest_offset)
    if math.isfinite(most):
        with pytest.raises(OffsetError, match="closes_valleys"):
            disc_region(disc, 1.01 * most)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("args", [(11, 80.0, 0.02, 3.3333), (2, 80.0, 0.5, 13.3), (40, 80.0, 1.0, 0.001)])
def test_extreme_discs_are_drawn_within_their_bounds(args: tuple[int, float, float, float]) -> None:
    """Shortening coefficients of 0.99999 and 0.001: arcs and splines that a file can carry, near the exact outline."""
    profile = checked_disc(CycloidalDisc(*args)).profile()
    outline = Boundary(tuple(s.curve for s in profile.period), closed=False)
    arcs = approximate_profile(profile, 0.005, arcs=True)
    assert arcs.max_error <= 0.005
    assert len(arcs.geometry) <= 40 * args[0]
    spline = spline_outline(profile, 1e-6, degree=7, continuity=6)
    assert spline.max_error <= 1e-6
    for curve in list(spline.curves())[: len(profile.period)]:
        points = curve.point(np.linspace(*curve.domain, 41))
        assert np.abs(outline.feet(points).distance).max() <= 1.01e-6


def test_findings() -> None:
    assert disc_findings(DISC) == ()
    most = most_eccentricity()
    near = checked_disc(replace(DISC, eccentricity=most))
    assert [f.code for f in disc_findings(near)] == ["cycloidal_near_cusp"]


def test_bodies_that_are_no_number_are_refused() -> None:
    with pytest.raises(GeometryError):
        disc_region(DISC, math.nan)
