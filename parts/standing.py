"""How two placed instances stand to each other against what their mate asks for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Standing:
    """How two placed instances stand to each other against what their mate asks for.

    The phase is ``phase_off`` from the middle of the backlash, ``play`` is half of it; both in rad at the arm (mm) of a
    base radius, or in mm along the way of a second that ``slides``.
    """

    direction: float
    distance: float
    phase_off: float
    play: float
    arm: float = 1.0
    slides: bool = False

    def slack(self, allowed: float) -> float:
        """What ``allowed`` mm along the flanks is in the unit of the phase."""
        return allowed / self.arm
