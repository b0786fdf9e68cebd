"""Transmission error against dense polylines turned until they touch; none of involutes, relief where it meshes."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely

from geometry.base.record import replace
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.mesh.rack import RackMesh
from geometry.gears.mesh.transmission_error import TransmissionError, transmission_errors
from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.pairs.internal import InternalPair, internal_pair
from geometry.gears.pairs.rack import RackPair, rack_pair
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.rack import Rack
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.spur import SpurGear
from tests import brute
from tests.oracles.contact_ratio import main_flank_contact_ratio
from tests.sampling import some_of

RACK, ALPHA = iso_53(), math.radians(20.0)


def spur(teeth: int, x: float = 0.0, **keys: Any) -> SpurGear:
    """Module 2."""
    return SpurGear(2.0, teeth, keys.pop("rack", RACK), x, **keys)


def external(z1: int, z2: int, **keys: Any) -> ExternalPair:
    """Both gears with the same keys."""
    return external_pair(spur(z1, 0.1, **keys), spur(z2, 0.1, **keys))


def inside(z1: int, z2: int, x2: float = 0.0, **keys: Any) -> InternalPair:
    """A pinion with these keys in a plain ring."""
    return internal_pair(spur(z1, **keys), RingGear(2.0, z2, ALPHA, 2.0 * z2 + 40, RoundedRoot(), x2))


def on_rack(teeth: int, **keys: Any) -> RackPair:
    """A gear with these keys on a plain rack."""
    return rack_pair(spur(teeth, **keys), Rack(2.0, 14, RACK, 4.0))


def errors_of(pair: Any, **keys: Any) -> tuple[TransmissionError, TransmissionError]:
    """Both senses."""
    return transmission_errors((RackMesh if isinstance(pair, RackPair) else GearMesh)(pair, **keys))


NOMINAL = {
    "external": external(20, 33),
    "thinned": external(20, 33, circumferential_thinning=0.1),
    "internal": inside(20, 60),
    "rack": on_rack(24, tip_chamfer=0.05),
    "shifted ring": inside(17, 50, 0.4),
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", NOMINAL)
def test_involutes_run_evenly(name: str) -> None:
    pair = NOMINAL[name]
    for sense, error in zip((1, -1), errors_of(pair), strict=True):
        assert error.sense == sense
        assert max(map(abs, error.errors)) < 1e-8


@pytest.mark.sampled(1)
@pytest.mark.parametrize("shift", [0.05, 0.4])
def test_involutes_run_evenly_at_any_centre_distance(shift: float) -> None:
    """As long as contact is not interrupted; apart so far that it is, they do not."""
    pair = external(20, 33)
    assert max(e.peak_to_peak for e in transmission_errors(GearMesh(pair, distance_shift=shift))) < 1e-9
    assert min(e.peak_to_peak for e in transmission_errors(GearMesh(pair, distance_shift=3.0))) > 0.05


def test_relief_counts_from_where_the_contact_ratio_needs_it() -> None:
    """Main flanks with a contact ratio above 1 hand over before the relief; below 1 the relief is what drives."""
    for height, needed in ((0.3, False), (0.6, True), (0.9, True)):
        pair = external(20, 40, rack=iso_53(relief=TipRelief(0.02, height)))
        assert (main_flank_contact_ratio(pair) < 1) == needed
        for error in transmission_errors(GearMesh(pair)):
            if needed:
                # never more than the relief of one tooth, 0.02 modules along the normal
                assert 1e-4 < error.peak_to_peak < 0.04
            else:
                assert error.peak_to_peak < 1e-9


def far(points: np.ndarray, centre: complex, reach: float) -> shapely.Geometry:
    """A closed outline, cut to a square about a point."""
    ring = shapely.LinearRing(np.column_stack([points.real, points.imag]))
    x, y = centre.real, centre.imag
    return shapely.clip_by_rect(ring, x - reach, y - reach, x + reach, y + reach)


def touching(apart: Callable[[float], bool], free: float, struck: float) -> float:
    """Bisection between a place where bodies are apart and one where they are not."""
    assert apart(free)
    assert not apart(struck)
    for _ in range(24):
        middle = (free + struck) / 2
        free, struck = (middle, struck) if apart(middle) else (free, middle)
    return (free + struck) / 2


class Brute:
    """A mesh of polylines; ``touch(drive)``: the second's motion from the middle until it meets the driving flanks."""

    def __init__(self, pair: Any, sense: int, shift: float = 0.0) -> None:
        self.pair, self.sense, self.shift = pair, sense, shift
        if isinstance(pair, ExternalPair):
            self.at, self.centre, self.closing = pair.working_radii[0], pair.working_centre_distance + shift + 0j, 1
            self.arm, self.middle = pair.second.base_radius, pair.second_rotation
            profiles = [s.profile() for s in pair.sides]
        elif isinstance(pair, InternalPair):
            self.at = pair.pinion.reference_radius
            self.centre, self.closing = -pair.working_centre_distance - shift + 0j, -1
            self.arm, self.middle = pair.ring.base_radius, pair.second_rotation
            profiles = [s.profile() for s in pair.sides]
        else:
            self.at, self.centre, self.closing = pair.gear.reference_radius, pair.distance + shift + 0j, -1
            self.arm = math.cos(pair.rack.rack.pressure_angle)
            self.middle = lambda d: pair.rack_position(d) + pair.rack.pitch / 2
            profiles = [pair.sides[0].profile()]
        self.outlines = [brute.polygon(p, 150) for p in profiles]
        if isinstance(pair, InternalPair):
            # a hole runs clockwise, period after period
            one, z = brute.polygon(profiles[1], 150, 1), profiles[1].count
            self.outlines[1] = (np.exp(-2j * math.pi / z * np.arange(z))[:, None] * one).ravel()
        if isinstance(pair, RackPair):
            half = np.concatenate([brute.dense(s.curve, 151)[:-1] for s in pair.sides[1].segments])
            # teeth point to -x; from the space below a tooth to the one above it
            half = half if abs(half[0].imag) > abs(half[-1].imag) else half[::-1]
            half = half if half[0].imag < 0 else np.conj(half)
            tooth = np.concatenate([half, np.conj(half)[::-1]])
            self.outlines.append(np.concatenate([tooth + 1j * k * pair.rack.pitch for k in range(-4, 5)]))

    def placed(self, drive: float, turn: float) -> tuple[shapely.Geometry, shapely.Geometry]:
        """Both, cut to the mesh."""
        one = far(self.outlines[0] * np.exp(1j * drive), self.at + 0j, 9.0)
        motion = self.middle(drive) + turn
        moved = (
            1j * motion + self.outlines[1]
            if isinstance(self.pair, RackPair)
            else self.outlines[1] * np.exp(1j * motion)
        )
        return one, far(moved + self.centre, self.at + 0j, 9.0)

    def touch(self, drive: float) -> float:
        """mm of closing along the line of action beyond the middle."""
        way = self.closing * self.sense / self.arm

        def apart(x: float) -> bool:
            one, two = self.placed(drive, way * x)
            return not shapely.intersects(one, two)

        play = self.pair.normal_backlash / 2 + 0.35 * self.shift
        return touching(apart, play - 0.1 - 0.1 * self.shift, play + 0.3 + 0.2 * self.shift)


# backlash leaves room for the other flanks while one side is opened
THIN = {"circumferential_thinning": 0.3}
SPOILT: dict[str, tuple[Any, float]] = {
    "relief": (external(20, 40, rack=iso_53(relief=TipRelief(0.02, 0.9)), **THIN), 0.0),
    "short tips": (external_pair(spur(13, 0.3, given_tip_diameter=29.0, **THIN),
                                 spur(17, 0.3, given_tip_diameter=37.0, **THIN)), 0.0),
    "pulled apart": (external(20, 33, **THIN), 2.2),
    "rounded": (external(13, 15, tip_rounding=0.6, rack=replace(RACK, addendum=0.7), **THIN), 0.0),
    "rack": (on_rack(17, given_tip_diameter=33.4, **THIN), 0.0),
    "ring": (inside(20, 60, given_tip_diameter=39.8, **THIN), 0.0),
}  # fmt: skip


@cache
def spoilt_errors(name: str) -> tuple[TransmissionError, TransmissionError]:
    pair, shift = SPOILT[name]
    return errors_of(pair, **({"distance_shift": shift} if shift else {}))


BOTH = [(name, 1) for name in SPOILT] + [("short tips", -1)]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("name", "sense"), BOTH + [pytest.param(n, -1, marks=pytest.mark.heavy) for n in SPOILT])
def test_errors_against_polylines_turned_until_they_touch(name: str, sense: int) -> None:
    pair, shift = SPOILT[name]
    error = spoilt_errors(name)[0 if sense > 0 else 1]
    assert error.peak_to_peak > 1e-3
    slow = Brute(pair, sense, shift)
    chosen = range(0, len(error.errors), max(1, len(error.errors) // 8))
    found = np.array([error.errors[k] for k in chosen])
    wanted = -np.array([slow.touch(error.drive_angles[k]) for k in chosen])
    # the ideal is common to all drive angles
    assert found - found.mean() == pytest.approx(wanted - wanted.mean(), abs=2e-4)
    assert np.ptp(wanted) > 0.3 * error.peak_to_peak


_WALK = np.arange(0.0, 4.0, 0.01)


def _closed_gap(pair: ExternalPair, sense: int, shift: float) -> float:
    """Of the main flanks, mm."""
    mesh = GearMesh(pair, distance_shift=shift)
    found = mesh.closed_form(mesh.drive_angles())[:, 1 if sense > 0 else 0]
    return float(found[np.isfinite(found)].min())


@pytest.mark.heavy
@pytest.mark.parametrize(("z1", "z2", "shift"), [(4, 7, 1.0), (4, 7, 1.6), (5, 5, 0.8), (5, 5, 1.3), (4, 12, 1.4)])
def test_corners_of_undercut_teeth_that_graze(z1: int, z2: int, shift: float) -> None:
    """Where tip passes tip the gap hardly changes as the second turns; polylines walk from the middle till they meet.

    Beside a graze less deep than they are coarse one of two near drive angles meets as soon as the search says.
    """
    pair = external_pair(spur(z1), spur(z2))
    for sense, error in zip((1, -1), errors_of(pair, distance_shift=shift), strict=True):
        slow = Brute(pair, sense, shift)
        way, ideal = slow.closing * sense / slow.arm, _closed_gap(pair, sense, shift)
        for k in some_of(range(0, len(error.errors), max(1, len(error.errors) // 12)), 4):
            near = error.drive_angles[k] + np.array([-5e-3, 0.0, 5e-3])
            met = [next(x for x in _WALK if shapely.intersects(*slow.placed(drive, way * x))) for drive in near]
            assert min(met) - 0.03 < ideal - error.errors[k] < max(met) + 0.02
        assert error.peak_to_peak > 0.1


@pytest.mark.heavy
def test_a_rack_with_short_tips() -> None:
    pair = on_rack(17, given_tip_diameter=33.4, **THIN)
    assert pair.contact_ratio < 1
    one, two = transmission_errors(RackMesh(pair))
    # where main flanks meet the rack is where they would have it, whatever its play; corners only hold it back
    assert max(one.errors) == pytest.approx(0, abs=1e-8)
    assert one.peak_to_peak > 1e-3
    assert one.peak_to_peak == pytest.approx(two.peak_to_peak, rel=1e-3)


def test_a_face_that_overlaps_by_a_pitch_evens_out() -> None:
    pair, _ = SPOILT["short tips"]
    spurs, _ = spoilt_errors("short tips")
    assert spurs.over_face(0.5).peak_to_peak < 1e-6 < spurs.peak_to_peak
    assert transmission_errors(GearMesh(pair), overlap_ratio=1.0)[0].peak_to_peak == 0.0
    # contact ratio 0.69 and an overlap of 0.31 and a little: some section is always on its main flanks
    carried = spurs.over_face(1.02 - pair.contact_ratio)
    assert carried.peak_to_peak < 3e-3 * spurs.peak_to_peak


def test_the_larger_obstacle_rules() -> None:
    """Negative control: the section farthest behind in its place would make a face worse than one section."""
    error = TransmissionError(1, (0.0, 0.25, 0.5, 0.75), (0.0, -1.0, -3.0, -1.0), 1.0, 1.0)
    wide = error.over_face(0.25)
    assert max(wide.errors) == 0.0
    assert min(wide.errors) == pytest.approx(-2.0)


@pytest.mark.parametrize("overlap", [1.0, 1.3, 7.0])
def test_a_face_of_a_pitch_and_more_is_ruled_by_the_greatest_of_all(overlap: float) -> None:
    error = TransmissionError(1, (0.1, 0.25, 0.5, 0.75), (0.0, -1.0, -3.0, 0.25), 1.0, 1.0)
    assert set(error.over_face(overlap).errors) == {0.25}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("overlap", [0.07, 0.31, 0.8])
def test_a_face_is_ruled_by_its_section_that_is_farthest_ahead(overlap: float) -> None:
    """Against the greatest of a fine row of sections of the same broken line, wherever the face begins."""
    rng, pitch = np.random.default_rng(round(100 * overlap)), 0.4
    along = overlap * pitch * np.linspace(0, 1, 801)
    for _ in range(4):
        angles, errors = np.sort(rng.uniform(0, pitch, 7)), rng.uniform(-0.03, 0.02, 7)
        wide = TransmissionError(1, tuple(angles), tuple(errors), 30.0, pitch).over_face(overlap)

        def ahead(starts: np.ndarray, angles: np.ndarray = angles, errors: np.ndarray = errors) -> np.ndarray:
            return np.interp(starts[:, None] + along, angles, errors, period=pitch).max(axis=1)

        # what the line may gain between two sections of the row
        step = np.diff(np.append(errors, errors[0])) / np.diff(np.append(angles, angles[0] + pitch))
        near = np.abs(step).max() * overlap * pitch / 800
        assert wide.errors == pytest.approx(ahead(np.array(wide.drive_angles)), abs=near)
        row = ahead(np.linspace(0, pitch, 801))
        assert (max(wide.errors), min(wide.errors)) == pytest.approx((row.max(), row.min()), abs=2 * near / overlap)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("distance", "expected"), [(49.2, 0.0), (49.31, 1.45e-5), (49.33, 7.8e-5), (49.36, 2.67e-4), (49.5, 2.55e-3)]
)
def test_short_interruptions_are_found(distance: float, expected: float) -> None:
    """z 17 / 31, m 2: contact ratios from just above 1 down to 0.915; a user's own solution for corner contact."""
    pair = external_pair(SpurGear(2.0, 17, iso_53("A")), SpurGear(2.0, 31, iso_53("A")), distance)
    for found in transmission_errors(GearMesh(pair)):
        assert found.peak_to_peak == pytest.approx(expected, rel=0.005, abs=1e-6 if expected else 1e-9)
