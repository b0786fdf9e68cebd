"""The working drawing of an external gear."""

from __future__ import annotations

from geometry.gears.teeth.spur import SpurGear
from parts.drawing.wheel_views import Wheel, wheel_views
from parts.drawing.working import PartDrawing, Subject, requirements
from parts.keys.wheel import wheel_shape


def part_drawing(subject: Subject) -> PartDrawing:
    """Axial section, face view, bore."""
    part = subject.part
    gear, keys = part.thing, part.keys
    assert isinstance(gear, SpurGear)
    shape = wheel_shape(keys.face_width, keys.web, keys.hub, keys.face_chamfer)  # type: ignore[attr-defined]
    outline = part.section(0.0).region.outer
    tip, root, pitch = gear.tip_radius, gear.root_radius, gear.reference_radius
    views = wheel_views(Wheel(shape, gear.holes, (tip, tip), outline, root, pitch), subject)
    return PartDrawing(views, requirements(subject))
