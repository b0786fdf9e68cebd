"""What assembly drawings show of worms and worm wheels: the envelopes of their tips (GOST 2.402)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from geometry.base.record import replace
from geometry.gears.worms.body import WormBody
from geometry.gears.worms.wheel_measures import WormWheel
from geometry.solids.sketch import Layer, Ring, Sketch, alike, lathe, round_ring, sketch_of_body

# what is one height, mm; layers of the throat of a wheel
_SAME, _THROAT = 1e-7, 12


def sketch_of_worm(worm: WormBody) -> Sketch:
    """A worm as the cylinder of its tips, its shaft beside."""
    thread = worm.thread.worm
    outline = [complex(r, z) for z, r in worm.envelope()]
    end = max(p.imag for p in outline if p.real == thread.tip_radius and p.imag <= worm.start[0])
    layers = []
    for layer in lathe(list(pairwise(outline))):
        is_thread = abs(layer.low + end) < _SAME
        rings = [tuple(replace(r, root=thread.root_radius) if is_thread else r for r in side)
                 for side in (layer.lower, layer.upper)]  # fmt: skip
        bore = () if worm.bore is None else (Ring(tuple(s.curve for s in worm.bore.segments())),)
        layers.append(Layer(layer.low, layer.high, (*rings[0], *bore), (*rings[1], *bore)))
    return Sketch(tuple(layers), tuple(p.imag for p in outline), thread.reference_radius, is_shaft=True)


def sketch_of_worm_wheel(wheel: WormWheel, pitch: float) -> Sketch:
    """A worm wheel as the envelope of its tips about its core."""
    teeth, core, width = wheel.teeth, wheel.core, wheel.teeth.width
    throat = np.linspace(-1.0, 1.0, _THROAT + 1) * teeth.throat_height + wheel.middle
    levels = sorted({round(float(z), 9) for z in (*core.levels(), *throat, 0.0, width)})
    plain = sketch_of_body(core)

    def rings(inner: Sequence[Ring], z: float) -> tuple[Ring, ...]:
        height = np.array([min(max(z, 0.0), width) - wheel.middle])
        tip, root = (float(f(height)[0]) for f in (teeth.tip_radius, teeth.root_radius))
        rim = round_ring(wheel.rim.reach())
        return tuple(round_ring(tip, root) if alike(ring, rim) else ring for ring in inner)

    layers = []
    for low, high in pairwise(levels):
        whole = next(k for k in plain.layers if k.low <= low + _SAME and k.high >= high - _SAME)
        layers.append(Layer(low, high, rings(whole.lower, low), rings(whole.upper, high)))
    edges = (wheel.middle - teeth.throat_height, wheel.middle + teeth.throat_height)
    return Sketch(tuple(layers), (*plain.creases, *edges), pitch)
