"""What the files of ratchets must also do: edges and roots of a wheel's teeth, the seat of a pawl in its notch."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from geometry.base.record import Record
from parts.base.readback import Probed, outline_points, refuse_if
from parts.base.texts import unless

if TYPE_CHECKING:
    from geometry.gears.ratchets.pawl import PawlShape
    from geometry.gears.ratchets.wheel import RatchetWheel
    from parts.base.readback import ReadBack, ReadLoop

# rounding, as a part of the wheel's size
_ROUNDING = 1e-9


def _loop(file: ReadBack, height: float, number: int) -> ReadLoop:
    """The outermost outline; of a ring the next one."""
    loops = sorted(file.section(height), key=lambda loop: loop.size)
    refuse_if(len(loops) < number, "there are no teeth")
    return loops[-number]


class ToothProbe(Record):
    """The edge of every tooth, and the rounding of every root; ``height``: where a solid is cut, mm."""

    wheel: RatchetWheel
    height: float
    name: str = ""
    needs_whole: bool = False

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """By the corners that the file has; see ``parts.base.readback.Probe``."""
        wheel = self.wheel
        points = outline_points(_loop(file, self.height, 2 if wheel.internal else 1))
        if not wheel.ccw:
            points = points.conj()
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


class SeatProbe(Record):
    """The outline of a pawl laid into the notch of its wheel; ``height``: where a solid is cut, mm."""

    pawl: PawlShape
    height: float
    name: str = ""
    needs_whole: bool = False

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """By the distances of the outline's points from the exact teeth; see ``parts.base.readback.Probe``."""
        from geometry.gears.ratchets.contact import RatchetContact

        pawl = self.pawl
        points = outline_points(_loop(file, self.height, 1))
        if not pawl.wheel.ccw:
            points = points.conj()
        placed = pawl.pivot - points * cmath.exp(1j * cmath.phase(pawl.towards_pivot))
        gap = RatchetContact(pawl).seated(placed)
        allowed = declared + _ROUNDING * pawl.wheel.tip_radius
        failures = unless(abs(gap + offset) <= allowed, "seated, its gap to the teeth is {gap:.6g} mm", gap=gap)
        return Probed({"seat_gap": gap}, tuple(failures))
