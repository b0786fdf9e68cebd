"""Worms and worm wheels as drawings show them: envelopes of their tips, hatched as far as their roots."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.gears.worms.body import Step, WormBody
from geometry.gears.worms.sketch import sketch_of_worm, sketch_of_worm_wheel
from geometry.gears.worms.thread import thread_of
from geometry.gears.worms.worm import Worm
from geometry.plane.profile import Label, circle
from geometry.solids.bores import KeywayBore
from geometry.solids.sketch import Layer, Ring
from tests.geometry.gears.worms.test_wheel_solid import STEEP, _wheel

# d_a 30, d_f 19 of m 5 q 10: root 5 x (10 / 2 - 1.2), tip 5 x (10 / 2 + 1)
WORM = Worm(5.0, 2, 10.0)


def circle_of(ring: Ring) -> tuple[float, float | None]:
    """Radius, and the radius of its root."""
    assert ring.circle is not None
    assert ring.circle[0] == 0
    return ring.circle[1], ring.root


def ends(layer: Layer, k: int = 0) -> tuple[tuple[float, float | None], tuple[float, float | None]]:
    return circle_of(layer.lower[k]), circle_of(layer.upper[k])


def test_a_worm_is_the_cylinder_of_its_tips() -> None:
    """Thread of 40 whose ends lean by 45 degrees, 11 mm from root to tip; steps below of 10 mm with a chamfer of 1."""
    body = WormBody(thread_of(WORM, 0.3), 40.0, math.pi / 4, below=(Step(30.0, 10.0), Step(20.0, 30.0, 1.0))).checked()
    sketch = sketch_of_worm(body)
    assert sketch.is_shaft
    assert sketch.pitch == 25.0
    assert sketch.creases == pytest.approx((-60.0, -59.0, -30.0, -30.0, -20.0, -20.0, -9.0, 9.0, 20.0))
    heights = [-60.0, -59.0, -30.0, -20.0, -9.0, 9.0, 20.0]
    assert [k.low for k in sketch.layers] == pytest.approx(heights[:-1])
    assert [k.high for k in sketch.layers] == pytest.approx(heights[1:])
    wanted = [(9.0, 10.0), (10.0, 10.0), (15.0, 15.0), (19.0, 30.0), (30.0, 30.0), (30.0, 19.0)]
    for layer, (low, high) in zip(sketch.layers, wanted, strict=True):
        (lower, own), (upper, other) = ends(layer)
        assert (lower, upper) == (pytest.approx(low), pytest.approx(high))
        # the whole thread alone is hatched as far as its roots
        assert own == other == (19.0 if low == high == 30.0 else None)
        assert len(layer.lower) == len(layer.upper) == 1


def test_its_bore_goes_through_all_of_it() -> None:
    bore = KeywayBore(12.0, 4.0, 1.8, 0.2).profile(0.0)
    body = WormBody(thread_of(WORM), 40.0, 0.0, above=(Step(40.0, 5.0),), bore=bore).checked()
    sketch = sketch_of_worm(body)
    assert [(k.low, k.high) for k in sketch.layers] == [(-20.0, 20.0), (20.0, 25.0)]
    assert [ends(k) for k in sketch.layers] == [((30.0, 19.0), (30.0, 19.0)), ((20.0, None), (20.0, None))]
    for layer in sketch.layers:
        for side in (layer.lower, layer.upper):
            assert side[1].circle is None
            assert side[1].points == pytest.approx(Ring(tuple(s.curve for s in bore.segments())).points)


def test_a_wheel_is_the_envelope_of_its_tips_about_its_core() -> None:
    wheel = _wheel(STEEP, 13.5, 65.25 / 2)
    teeth = wheel.teeth
    sketch = sketch_of_worm_wheel(wheel, 30.0)
    throat = teeth.throat_height
    assert sketch.pitch == 30.0
    assert not sketch.is_shaft
    assert sketch.creases == pytest.approx((wheel.middle - throat, wheel.middle + throat))
    levels = [k.low for k in sketch.layers] + [sketch.layers[-1].high]
    assert levels == pytest.approx([0.0, *(6.75 + throat * (k / 6 - 1) for k in range(13)), 13.5], abs=1e-8)
    for layer in sketch.layers:
        for z, (rim, bore) in ((layer.low, layer.lower), (layer.high, layer.upper)):
            radius, root = circle_of(rim)
            # of the throat about the worm's axis, a - sqrt(r^2 - z^2), at most the outside
            away = abs(z - 6.75)
            tip = teeth.centre_distance - math.sqrt(max(teeth.throat_radius**2 - away**2, 0.0))
            assert radius == pytest.approx(min(tip, 65.25 / 2), abs=1e-7)
            assert root == pytest.approx(float(teeth.root_radius(away)), abs=1e-7)
            assert circle_of(bore) == (pytest.approx(0.2 * STEEP.root_radius), None)


def test_a_hub_beyond_the_teeth_stays_what_it_is() -> None:
    """Of a core that is longer than the rim the teeth are drawn over the rim alone, beyond it as at its ends."""
    from geometry.gears.worms.wheel_measures import WormWheel
    from geometry.solids.body import BodyBuilder

    own = _wheel(STEEP, 13.5, 65.25 / 2)
    made = BodyBuilder()
    rim, hub = circle(0.9 * STEEP.root_radius, Label.BODY), circle(8.0, Label.HUB)
    foot = made.upright(rim, 0.0, 13.5)
    step = made.upright(hub, 13.5, 20.0)
    made.cap(foot[0], [], up=False)
    made.cap(foot[1], [step[0]], up=True)
    made.cap(step[1], [], up=True)
    sketch = sketch_of_worm_wheel(WormWheel(own.teeth, made.body(), rim), 30.0)
    assert (sketch.layers[-1].low, sketch.layers[-1].high) == (13.5, 20.0)
    assert ends(sketch.layers[-1]) == ((8.0, None), (8.0, None))
    assert circle_of(sketch.layers[0].lower[0])[0] == pytest.approx(65.25 / 2)
    assert np.isfinite([x for k in sketch.layers for x in (k.low, k.high)]).all()
