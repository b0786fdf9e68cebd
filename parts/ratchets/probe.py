"""What the files of ratchets must also do: edges and roots of a wheel's teeth, the seat of a pawl in its notch."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from parts.base.readback import Probe, Probed, outline_at
from parts.base.texts import unless

if TYPE_CHECKING:
    from geometry.curves.curve import Complex
    from geometry.gears.ratchets.pawl import PawlShape
    from geometry.gears.ratchets.wheel import RatchetWheel
    from parts.base.readback import ReadBack

# rounding, as a part of the wheel's size
_ROUNDING = 1e-9


def _outline(file: ReadBack, height: float, wheel: RatchetWheel, number: int = 1) -> Complex:
    """The outermost outline or the next one, of a pair that is free counter-clockwise."""
    points = outline_at(file, height, "there are no teeth", number)
    return points if wheel.ccw else points.conj()


class ToothProbe(Probe):
    """The edge of every tooth, and the rounding of every root; ``height``: where a solid is cut, mm."""

    wheel: RatchetWheel
    height: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """By the corners that the file has; see ``parts.base.readback.Probe``."""
        wheel = self.wheel
        points = _outline(file, self.height, wheel, 2 if wheel.internal else 1)
        normal, way = wheel.face_normal, wheel.face_way
        edge = wheel.tip_radius + offset * normal
        if offset < 0:
            # the face moved in ends on the tip circle moved in
            tip, across = wheel.tip_radius + wheel.side * offset, (edge * way.conjugate()).real
            edge += (-across - wheel.side * math.sqrt(across**2 - abs(edge) ** 2 + tip**2)) * way
        turns = np.exp(1j * wheel.pitch_angle * np.arange(wheel.number_of_teeth))
        off = max(float(np.abs(points - edge * turn).min()) for turn in turns)
        # about the middle of its rounding each root is as near as it must be, and nothing is nearer
        middle, rounding = wheel.notch.last, wheel.fillet_radius - offset
        roots = [float(np.abs(points - middle * turn).min()) for turn in turns]
        allowed = 2 * (declared + _ROUNDING * wheel.tip_radius)
        wrong = max(abs(root - rounding) for root in roots) if rounding > 0 else 0.0
        failures = [
            *unless(off <= allowed, "the edge of a tooth is {off:.6g} mm off its place", off=off),
            *unless(wrong <= allowed, "a root is {off:.6g} mm off its place", off=wrong),
        ]
        return Probed({"edge_off": off, "root_off": wrong}, tuple(failures))


class SeatProbe(Probe):
    """The outline of a pawl laid into the notch of its wheel; ``height``: where a solid is cut, mm."""

    pawl: PawlShape
    height: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """By the distances of the outline's points from the exact teeth; see ``parts.base.readback.Probe``."""
        from geometry.gears.ratchets.contact import RatchetContact

        pawl = self.pawl
        turn = cmath.exp(1j * cmath.phase(pawl.towards_pivot))
        placed = pawl.pivot - _outline(file, self.height, pawl.wheel) * turn
        gap = RatchetContact(pawl).seated(placed)
        allowed = declared + _ROUNDING * pawl.wheel.tip_radius
        failures = unless(abs(gap + offset) <= allowed, "seated, its gap to the teeth is {gap:.6g} mm", gap=gap)
        return Probed({"seat_gap": gap}, tuple(failures))
