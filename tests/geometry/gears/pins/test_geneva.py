"""Geneva drives: the law by 50 digits and by printed tables, the outlines by polygons that are turned and moved."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from shapely import affinity
from shapely.geometry import Point, Polygon

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.curves.line_arc import Arc
from geometry.gears.pins.geneva import Geneva, GenevaDisc, GenevaWheel, checked_disc, checked_wheel, most_pins
from geometry.gears.pins.geneva_contact import GenevaContact
from geometry.plane.distance import Verdict
from geometry.solids.plate import Edge

PRINTED = json.loads((Path(__file__).parents[3] / "published" / "geneva_drives.json").read_text(encoding="utf-8"))
BOTH = pytest.mark.parametrize("internal", [False, True])


def turned(slots: int, alpha: mpmath.mpf, *, internal: bool) -> mpmath.mpf:
    """By the triangle of both axes and the pin: how far the wheel stands from the line of centres, a = 1."""
    pin = mpmath.sin(mpmath.pi / slots) * mpmath.expj(alpha)
    return mpmath.arg(1 + pin) if internal else mpmath.arg(mpmath.conj(1 - pin))


@BOTH
def test_the_law_is_that_of_the_triangle_of_axes_and_pin(internal: bool) -> None:
    with mpmath.workdps(50):
        for slots in (3, 4, 7, 20):
            drive = Geneva(slots, 60.0, internal=internal)
            for share in (-1.0, -0.6, 0.0, 0.35, 0.99):
                alpha = share * drive.half_motion_angle
                wanted = [
                    mpmath.diff(lambda x, n=slots: turned(n, x, internal=internal), mpmath.mpf(alpha), order)
                    for order in range(4)
                ]
                found = [float(value) for value in drive.motion(alpha)]
                assert found == pytest.approx([float(value) for value in wanted], rel=1e-12, abs=1e-12)
            # it begins and ends where it stands, with half a slot's angle
            assert float(drive.motion(drive.half_motion_angle)[1]) == pytest.approx(0.0, abs=1e-15)
            assert float(drive.motion(drive.half_motion_angle)[0]) == pytest.approx(math.pi / slots, abs=1e-15)


@pytest.mark.parametrize("row", PRINTED["external"], ids=lambda row: str(row["slots"]))
def test_printed_tables(row: dict[str, Any]) -> None:
    slots = int(row["slots"])
    drive = Geneva(slots, 60.0)
    alpha = np.linspace(0, drive.half_motion_angle, 200_001)
    _, velocity, acceleration, _ = drive.motion(alpha)
    place = int(np.argmax(np.abs(acceleration)))
    assert velocity.max() == pytest.approx(row["velocity"], abs=0.005)
    assert abs(acceleration[place]) == pytest.approx(row["acceleration"], abs=0.05 if slots == 3 else 0.005)
    degrees, minutes = row["angle"]
    assert math.degrees(alpha[place]) == pytest.approx(degrees + minutes / 60, abs=0.6 / 60)
    assert abs(acceleration[-1]) == pytest.approx(row["entry"], abs=5e-4)
    assert drive.half_motion_angle / math.pi == pytest.approx(row["motion_share"], abs=5e-5)
    # with the most pins that print names there may be no dwell any more
    assert most_pins(slots, internal=False) in (row["most_pins"], row["most_pins"] - 1)
    assert replace(drive, number_of_pins=most_pins(slots, internal=False)).dwell_angle > 0
    assert replace(drive, number_of_pins=most_pins(slots, internal=False) + 1).dwell_angle < 1e-9


@pytest.mark.sampled(3)
@pytest.mark.parametrize("slots", range(3, 13))
def test_the_greatest_acceleration_is_where_the_jerk_of_the_triangle_vanishes(slots: int) -> None:
    """With 30 digits; in a ring the acceleration grows until the pin leaves, where it is tan(pi / n)."""
    drive, ring = Geneva(slots, 60.0), Geneva(slots, 60.0, internal=True)
    with mpmath.workdps(30):

        def derived(alpha: mpmath.mpf, order: int) -> mpmath.mpf:
            return mpmath.diff(lambda x: turned(slots, x, internal=False), alpha, order)

        start = mpmath.mpf(drive.acceleration_angle)
        place = mpmath.findroot(lambda x: derived(x, 3), (0.9 * start, 1.1 * start), solver="anderson")
        most = abs(derived(place, 2))
        assert drive.acceleration_angle == pytest.approx(float(place), rel=1e-13)
        assert drive.greatest_acceleration == pytest.approx(float(most), rel=1e-13)
        beside = [abs(derived(k * mpmath.mpf(drive.half_motion_angle) / 24, 2)) for k in range(25)]
        assert max(beside) <= most
    found = np.abs(ring.motion(np.linspace(0, ring.half_motion_angle, 2001))[2])
    assert np.all(np.diff(found) > 0)
    assert ring.greatest_acceleration == pytest.approx(math.tan(math.pi / slots), rel=1e-13)


@pytest.mark.sampled(1)
@BOTH
def test_the_wheel_goes_on_by_a_slot_for_each_pin_and_stands_between(internal: bool) -> None:
    drive = Geneva(5, 60.0, 1 if internal else 3, internal)
    turns = np.linspace(-1.0, 8.0, 40_001)
    found = drive.wheel_turn(turns)
    assert np.abs(np.diff(found)).max() <= 4.0 * (turns[1] - turns[0])
    whole = drive.wheel_turn(turns + 2 * math.pi) - found
    assert whole == pytest.approx(np.full(len(turns), drive.number_of_pins * 2 * math.pi / 5))
    middle = drive.half_motion_angle + drive.dwell_angle / 2 + np.linspace(-0.5, 0.5, 9) * drive.dwell_angle
    assert np.ptp(drive.wheel_turn(middle)) < 1e-12


def polygon(edges: tuple[Edge, ...]) -> Polygon:
    """Chords that leave 1e-3 mm of an arc."""
    counts = [math.ceil(abs(e.sweep) * math.sqrt(e.radius / 8e-3)) if isinstance(e, Arc) else 1 for e in edges]
    whole = np.concatenate([e.point(np.linspace(*e.domain, n + 1)[:-1]) for e, n in zip(edges, counts, strict=True)])
    return Polygon(np.column_stack([whole.real, whole.imag]))


def swept(disc: GenevaDisc, turns: int = 49) -> tuple[float, float]:
    """Greatest common area, and least distance, of the driver's parts and the wheel through a cycle of one pin."""
    drive, wheel = disc.drive, disc.wheel
    body = polygon(wheel.outline())
    if drive.internal:
        body = Point(0, 0).buffer(wheel.outer_radius, quad_segs=40).difference(body)
    centres = [(c.real, c.imag) for c in disc.pin_centres()]
    parts = [polygon(disc.outline()), *(Point(c).buffer(wheel.pin_diameter / 2, quad_segs=40) for c in centres)]
    area, apart = 0.0, math.inf
    pitch = 2 * math.pi / disc.number_of_pins
    for angle in (np.linspace(-0.5, 0.5, turns) * pitch).tolist():
        rotation = angle + (math.pi if drive.internal else 0.0)
        # the triangle of axes and pin once more, the wheel standing beyond its slot's angle
        pin = drive.crank_radius * np.exp(1j * rotation) - drive.centre_distance
        slot = math.pi - drive.sense * math.pi / drive.number_of_slots * np.sign(-angle)
        if abs(angle) < drive.half_motion_angle:
            slot = float(np.angle(pin))
        there = affinity.translate(affinity.rotate(body, slot, (0, 0), use_radians=True), drive.centre_distance, 0)
        for part in parts:
            here = affinity.rotate(part, rotation, (0, 0), use_radians=True)
            off = here.distance(there)
            area, apart = max(area, 0.0 if off else here.intersection(there).area), min(apart, off)
    return area, apart


WHEEL = GenevaWheel(Geneva(6, 60.0), 5.0, 21.0, 0.3, 0.5, 0.1)
SMALL = GenevaWheel(Geneva(4, 60.0), 6.0, 30.0, 0.2, 0.6, 0.15, 0.5)
RING = GenevaWheel(Geneva(5, 60.0, internal=True), 5.0, 26.0, 0.3, 0.5, 0.1, 0.4, 130.0)
DISCS = {
    "6 slots": GenevaDisc(WHEEL, 1, 0.4),
    "6 slots, 2 pins": GenevaDisc(WHEEL, 2, 0.4),
    "4 slots, 3 pins, rounded tips": GenevaDisc(SMALL, 3, 0.4),
    "3 slots": GenevaDisc(GenevaWheel(Geneva(3, 60.0), 3.0, 44.0, 0.3, 0.3, 0.1), 2, 0.4),
    "8 slots": GenevaDisc(GenevaWheel(Geneva(8, 60.0), 4.0, 15.0, 0.3, 0.3, 0.1), 2, 0.2),
    "internal": GenevaDisc(RING, 1, 0.4),
}
EVERY = pytest.mark.parametrize("disc", DISCS.values(), ids=DISCS.keys())


@pytest.mark.sampled(1)
@EVERY
def test_nothing_of_the_driver_runs_into_the_wheel(disc: GenevaDisc) -> None:
    """By polygons; the least gap is the one that the exact search finds, and so is a relief that is too shallow."""
    checked_disc(GenevaDisc(checked_wheel(disc.wheel), disc.number_of_pins, disc.relief_clearance))
    area, apart = swept(disc)
    found = GenevaContact(disc).result()
    assert area == 0
    assert found.verdict is Verdict.CLEAR
    assert apart == pytest.approx(found.worst.gap, abs=4e-3)
    shallow = replace(disc, relief_clearance=-0.2)
    assert swept(shallow)[0] > 0
    assert GenevaContact(shallow).result().verdict is Verdict.OVERLAP


@EVERY
def test_a_relief_without_clearance_touches_what_is_swept(disc: GenevaDisc) -> None:
    assert GenevaContact(replace(disc, relief_clearance=0.0)).result().worst.gap == pytest.approx(0.0, abs=1e-7)


@pytest.mark.sampled(1)
@EVERY
def test_without_clearances_pin_or_disc_touch_all_the_time(disc: GenevaDisc) -> None:
    tight = replace(disc, wheel=replace(disc.wheel, slot_clearance=0.0, locking_clearance=0.0))
    assert GenevaContact(tight).result().verdict is Verdict.CONTACT
    for off in ({"turn": 1e-4}, {"turn": -1e-4}, {"shift": -1e-3}):
        assert GenevaContact(tight, **off).result().verdict is Verdict.OVERLAP


def test_refusals_name_what_works() -> None:
    """A wheel's by its keys: tests/parts/pins/test_geneva.py."""
    for wheel, name in ((replace(WHEEL, pin_diameter=30.0), "pin_diameter"),
                        (replace(WHEEL, locking_radius=27.4), "locking_diameter"),
                        (replace(WHEEL, tip_rounding=9.0), "locking_diameter")):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            checked_wheel(wheel)
        assert refused.value.name == name
    for disc, name in ((GenevaDisc(WHEEL, 3, 0.4), "number_of_pins"), (GenevaDisc(RING, 2, 0.4), "number_of_pins"),
                       (GenevaDisc(WHEEL, 1, 40.0), "relief_clearance")):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            checked_disc(disc)
        assert refused.value.name == name
        assert refused.value.nearest is not None
        checked_disc(replace(disc, **{name: refused.value.nearest.value}))
