"""What assembly drawings show of face gears: the plate, and on it the ring of the teeth, not hatched (GOST 2.402)."""

from __future__ import annotations

from geometry.base.record import replace
from geometry.gears.face.gear import FaceGear
from geometry.solids.sketch import NOTHING, Layer, Ring, Sketch, round_ring


def sketch_of_face_gear(gear: FaceGear) -> Sketch:
    """A face gear with its teeth whole, which stand alone on the plate."""
    outer, inner = round_ring(gear.outer_radius), round_ring(gear.inner_radius)
    bore = () if gear.bore is None else (Ring(tuple(s.curve for s in gear.bore.segments())),)
    plate, teeth = (outer, *bore), tuple(replace(ring, root=NOTHING) for ring in (outer, inner))
    layers = Layer(0.0, gear.thickness, plate, plate), Layer(gear.thickness, gear.height, teeth, teeth)
    return Sketch(layers, (gear.thickness,), gear.reference_radius)
