"""Distances from outlines whose every tooth has curves of its own: right, and asked of all of a formula at once."""

from __future__ import annotations

import numpy as np
import pytest

from geometry.gears.noncircular.offset import moved_outline
from geometry.gears.noncircular.pitch_line import PitchLine
from geometry.plane.measure import distance_to_own, distance_to_profile
from tests.geometry.gears.noncircular.test_noncircular import OVAL, gear

_AWAY = (-0.01, 1e-7, 0.02)


def test_curves_of_all_teeth_and_heights_are_asked_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of 90 curves of each height was asked alone, up to 24 times: a read-back took two minutes."""
    made = gear(OVAL, 30)
    profiles = [moved_outline(made, -z) for z in (0.0, 0.1, 0.2, 0.3)]
    calls = []
    looked_up = PitchLine.frame_and_slope
    monkeypatch.setattr(PitchLine, "frame_and_slope", lambda line, s: (calls.append(1), looked_up(line, s))[1])
    places, known = [], []
    for profile in profiles:
        found = []
        for curve in (s.curve for s in profile.period):
            low, high = curve.domain
            t = low + (high - low) * np.array([0.3, 0.5, 0.7])
            found.append(curve.point(t) - 1j * np.array(_AWAY) * curve.tangent(t))
        places.append(np.concatenate(found) * np.exp(1j * profile.pitch_angle))
        known.append(np.tile(np.abs(_AWAY), len(found)))
    before = len(calls)
    together = distance_to_own(places, profiles)
    assert len(calls) - before < 500
    for mine, far, profile, points in zip(together, known, profiles, places, strict=True):
        assert np.abs(mine - far).max() < 1e-12
        assert np.abs(mine - distance_to_profile(points, profile)).max() < 1e-12
        # by chords between dense samples, far off the outline too
        dense = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 4000)) for s in profile.period])
        whole = np.concatenate([dense * np.exp(1j * profile.pitch_angle * k) for k in range(profile.count)])
        outside = points[:5] * np.array([0.3, 0.9, 1.05, 1.2, 3.0])
        brute = np.abs(outside[:, None] - whole).min(axis=1)
        assert np.abs(distance_to_profile(outside, profile) - brute).max() < 1e-5
