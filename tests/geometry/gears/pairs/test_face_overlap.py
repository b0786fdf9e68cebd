"""A face that bridges interruptions of contact: against intervals of which it is known where they touch."""

from __future__ import annotations

import numpy as np
import pytest

from geometry.gears.pairs.face_overlap import is_bridged

PITCH = 0.3
# places within a pitch where nothing touches, and the longest of them
GAPS = {
    "one": [(0.1003, 0.1497)],
    "two": [(0.05, 0.0612), (0.2, 0.2333)],
    "over the end of the pitch": [(0.2801, 0.3417)],
    "two, the longer one over the end": [(0.11, 0.1251), (0.2901, 0.3221)],
    "narrow beside wide": [(0.0107, 0.0215), (0.0301, 0.0702)],
}


@pytest.mark.parametrize("name", GAPS)
@pytest.mark.parametrize("count", [24, 60])
def test_a_face_covers_gaps_that_are_no_wider(name: str, count: int) -> None:
    """To the ninth refinement of a step, beside both ends of the longest gap, wherever it lies."""

    def touches(angles: np.ndarray) -> np.ndarray:
        found = np.ones(len(angles), dtype=bool)
        for low, high in GAPS[name]:
            for shift in (-PITCH, 0.0, PITCH):
                found &= ~((angles + shift > low) & (angles + shift < high))
        return found

    angles = np.arange(count) * PITCH / count
    longest = max(high - low for low, high in GAPS[name])
    assert is_bridged(angles, touches(angles), PITCH, longest * (1 + 1e-6), touches)
    assert not is_bridged(angles, touches(angles), PITCH, longest * (1 - 1e-6), touches)
    assert is_bridged(angles, touches(angles), PITCH, PITCH, touches)
    assert not is_bridged(angles, touches(angles), PITCH, 0.0, touches)


def test_whole_contact_wants_no_face_and_none_takes_any() -> None:
    angles = np.arange(12) * PITCH / 12

    def never(_: np.ndarray) -> np.ndarray:
        raise AssertionError

    assert is_bridged(angles, np.ones(12, dtype=bool), PITCH, 0.0, never)
    assert not is_bridged(angles, np.zeros(12, dtype=bool), PITCH, 10.0, never)


def test_a_single_place_of_contact_is_enough_for_a_face_of_a_pitch() -> None:
    """One place touches alone: a face as wide as a pitch always has it."""
    angles = np.arange(12) * PITCH / 12
    touching = np.zeros(12, dtype=bool)
    touching[5] = True

    def touches(at: np.ndarray) -> np.ndarray:
        return np.abs((at - angles[5] + PITCH / 2) % PITCH - PITCH / 2) < 1e-12

    assert is_bridged(angles, touching, PITCH, PITCH * (1 + 1e-9), touches)
    assert not is_bridged(angles, touching, PITCH, 0.99 * PITCH, touches)
