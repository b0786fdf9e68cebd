"""Transmission error of a mate as it stands, by its kind; both senses in which the first instance may drive."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from geometry.errors import ConvergenceError
from parts.common_face import face_of
from parts.mate_kinds import ExternalMating, InternalMating, Mating, RackMating

if TYPE_CHECKING:
    from geometry.gears.transmission_error import TransmissionError


def transmission_error(mating: Mating, distance_off: float = 0.0) -> dict[str, Any]:
    """Peak to peak over a pitch, for each sense of the first's rotation; ``distance_off``: mm beyond the distance.

    ``line_of_action`` mm; and of the second: ``second_arcsec``, or ``second_travel`` mm where it is a rack. Empty where
    teeth slip past each other at some drive angle.
    """
    try:
        forward, backward, arm = _errors(mating, distance_off)
    except ConvergenceError:
        return {}
    return {"counter_clockwise": _numbers(forward, arm, mating), "clockwise": _numbers(backward, arm, mating)}


def _errors(mating: Mating, distance_off: float) -> tuple[TransmissionError, TransmissionError, float]:
    """Errors where the first turns counter-clockwise and clockwise, and the second's arm on the line of action, mm."""
    overlap = face_of(mating).overlap_ratio
    if isinstance(mating, ExternalMating):
        from geometry.gears.pair_contact import pair_transmission

        found = pair_transmission(mating.pair, centre_shift=distance_off, overlap_ratio=overlap)
        return *found, found[0].arm
    if isinstance(mating, InternalMating):
        from geometry.gears.internal_contact import internal_transmission

        found = internal_transmission(mating.pair, centre_shift=distance_off, overlap_ratio=overlap)
        if mating.ring_first:
            # a ring that drives counter-clockwise pushes the flanks with which a pinion would drive clockwise
            return found[1], found[0], mating.pair.pinion.base_radius
        return *found, found[0].arm
    if isinstance(mating, RackMating):
        from geometry.gears.rack_contact import rack_transmission

        found = rack_transmission(mating.pair, distance_shift=distance_off, overlap_ratio=overlap)
        return *found, found[0].arm
    raise TypeError(f"no transmission error of a {mating.kind}")


def _numbers(error: TransmissionError, arm: float, mating: Mating) -> dict[str, float]:
    motion = error.peak_to_peak / arm
    if mating.ratio is None:
        return {"line_of_action": error.peak_to_peak, "second_travel": motion}
    return {"line_of_action": error.peak_to_peak, "second_arcsec": math.degrees(motion) * 3600}
