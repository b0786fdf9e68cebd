"""The working drawing of the disc of a cycloidal reducer."""

from __future__ import annotations

from parts.drawing.disk_views import disk_drawing
from parts.drawing.working import PartDrawing, Subject
from parts.keys.wheel import wheel_shape
from parts.pins.cycloidal_disc import CycloidalDiscSpec


def part_drawing(subject: Subject) -> PartDrawing:
    """Section, the lobes as they are, holes."""
    keys = subject.part.keys
    assert isinstance(keys, CycloidalDiscSpec)
    shape = wheel_shape(keys.face_width, None, keys.hub, keys.face_chamfer)
    return disk_drawing(subject, shape, subject.part.thing.holes, "zero_lobe", ("tip_diameter", "root_diameter"))
