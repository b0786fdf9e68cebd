"""What assembly drawings show of bevel gears: the cone of their tips, hatched to that of their roots (GOST 2.402)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from geometry.base.record import replace
from geometry.gears.bevel.gear import BevelGear
from geometry.solids.sketch import NOTHING, Layer, Ring, Sketch, lathe, round_ring

# what is one height, mm
_SAME = 1e-7


def sketch_of_bevel(gear: BevelGear) -> Sketch:
    """A bevel gear with its teeth whole; beyond its front they stand alone."""

    def place(at: complex) -> complex:
        # radius and height above the back face
        return complex(at.real, gear.mounting_distance - at.imag)

    hub, front = gear.blank, place(gear.front)
    back = [complex(hub.hub_diameter / 2, z) for z in (0.0, hub.hub_length)] if hub.hub_length else []
    tips = [place(gear.outer(gear.tip_angle)), place(gear.inner(gear.inner_tip_angle))]
    roots = [place(gear.outer(gear.root_angle)), place(gear.inner(gear.root_angle))]
    begins = [0j, *back, place(gear.rim)]
    ends = [front, complex(0.0, front.imag)]
    levels = sorted({p.imag for p in (*begins, *roots, *tips, *ends)})
    solid = list(lathe(_cut([*begins, *roots, *ends], levels)))
    profiles = hub.holes.profiles()
    bore, holes = (
        [Ring(tuple(s.curve for s in profile.segments())) for profile in own]
        for own in ((profiles[:1], profiles[1:]) if hub.holes.bore is not None else ((), profiles))
    )
    layers = []
    for layer in lathe(_cut([*begins, *tips, *ends], levels)):
        own = next((k for k in solid if abs(k.low - layer.low) < _SAME), None)
        if own is None:
            sides = [[replace(ring, root=NOTHING) for ring in side] for side in (layer.lower, layer.upper)]
        else:
            roots_of = [_radius(side) for side in (own.lower, own.upper)]
            outer = [_radius(side) for side in (layer.lower, layer.upper)]
            toothed = any(tip - root > _SAME for tip, root in zip(outer, roots_of, strict=True))
            through = bore if layer.low < hub.hub_length - _SAME else [*bore, *holes]
            sides = [[round_ring(tip, root if toothed else None), *through]
                     for tip, root in zip(outer, roots_of, strict=True)]  # fmt: skip
        layers.append(Layer(layer.low, layer.high, tuple(sides[0]), tuple(sides[1])))
    cone = place(gear.outer(gear.pitch_angle)), place(gear.inner(gear.pitch_angle))
    return Sketch(tuple(layers), tuple(levels), cone[0].real, pitch_cone=cone)


def _cut(points: Sequence[complex], levels: Sequence[float]) -> list[tuple[complex, complex]]:
    """The lines of half a section, each cut where it passes a level; those along the axis left out."""
    found: list[tuple[complex, complex]] = []
    for a, b in pairwise(points):
        low, high = sorted((a.imag, b.imag))
        inner = sorted((z for z in levels if low + _SAME < z < high - _SAME), reverse=a.imag > b.imag)
        places = [a, *(a + (b - a) * ((z - a.imag) / (b.imag - a.imag)) for z in inner), b]
        found += pairwise(places)
    return found


def _radius(side: Sequence[Ring]) -> float:
    """Of the outermost boundary, mm."""
    return max(ring.circle[1] for ring in side if ring.circle is not None)
