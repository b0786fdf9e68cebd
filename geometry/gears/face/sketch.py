"""What assembly drawings show of face gears: plate and hub, and the ring of the teeth, not hatched (GOST 2.402)."""

from __future__ import annotations

from itertools import pairwise

from geometry.base.record import replace
from geometry.gears.face.gear import FaceGear
from geometry.solids.sketch import NOTHING, Layer, Ring, Sketch, alike, round_ring, sketch_of_body


def sketch_of_face_gear(gear: FaceGear) -> Sketch:
    """A face gear with its teeth whole, which stand alone on the plate."""
    outer, inner = round_ring(gear.outer_radius), round_ring(gear.inner_radius)
    teeth = tuple(replace(ring, root=NOTHING) for ring in (outer, inner))
    plain = sketch_of_body(gear.core)
    layers = []
    for low, high in pairwise(sorted({*gear.core.levels(), gear.height})):
        rings: list[Ring] = []
        for own in plain.layers:
            if own.low <= low < own.high:
                rings += [outer if alike(ring, inner) else ring for ring in own.lower]
        if gear.thickness <= low < gear.height:
            rings += teeth
        layers.append(Layer(low, high, tuple(rings), tuple(rings)))
    return Sketch(tuple(layers), (gear.thickness,), gear.reference_radius)
