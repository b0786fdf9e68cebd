"""The working drawing of a key: its outline, its height, its chamfers told."""

from __future__ import annotations

from parts.bodies.parallel_key import Key
from parts.bodies.plate_drawing import part_drawing as plate_drawing
from parts.drawing.working import PartDrawing, Subject


def part_drawing(subject: Subject) -> PartDrawing:
    """One view from above."""
    key = subject.part.thing
    assert isinstance(key, Key)
    edges = subject.words("key_edges")
    told = [subject.words("edges_chamfered", edges=edges, size=subject.say(key.chamfer))] if key.chamfer else []
    return plate_drawing(subject, (), (), *told)
