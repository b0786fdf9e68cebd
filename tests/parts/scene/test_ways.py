"""Ways of parts to their places, each decided by what it can be decided by: boxes, sections, layers, solids, meshes."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
import pytest

from geometry.base.placement import Vector
from parts.base.part import Part
from parts.scene.assembly_order import FAR, HOWS, Leg, OrderFound, legs, order_found
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from parts.scene.standing import Instance
from parts.scene.steps import StepSpec
from tests.parts.scene.test_sections_apart import PARTS, RIGHT, at, tube, turned

DOWN, UP, LEFT = [0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]
OWN: dict[str, dict[str, Any]] = PARTS | {
    "snap": tube(5.05, 9, 2),
    # a shaft with a groove for it, 5 from 20 to 22.2, else 6
    "shaft": {"kind": "turned", "points": [
        {"r": r, "z": z} for r, z in
        ((0.0, 0.0), (6.0, 0.0), (6.0, 20.0), (5.0, 20.0), (5.0, 22.2), (6.0, 22.2), (6.0, 40.0), (0.0, 40.0))]},
    "hubbed": turned((0, 0), (30, 0), (30, 8), (12, 8), (12, 16), (0, 16)),
    "bar": {"kind": "plate", "width": 40.0, "height": 8.0, "face_width": 6.0},
}  # fmt: skip


@cache
def parts() -> dict[str, Part]:
    return make_parts(scene_from_dict({"parts": OWN}, "t", "t"), "t")[0]


def held(instances: Sequence[Instance], *steps: dict[str, Any]) -> OrderFound:
    """The first brings all but the last to that, straight down, unless steps say else."""
    last = instances[-1].id
    told = steps or ({"bring": [i.id for i in instances[:-1]], "to": last, "along": DOWN},)
    return order_found([StepSpec(**step) for step in told], Placing(tuple(instances)), parts())


def named(name: str, part: str, *where: float, axis: Vector = (0.0, 0.0, 1.0), turn: float = 0.0) -> Instance:
    x, y, z = (*where, 0.0, 0.0, 0.0)[:3]
    return Instance(name, part, (x, y, z), turn, axis=axis)


def told(found: OrderFound) -> tuple[dict[str, int], list[tuple[str, str]]]:
    assert list(found.pairs) == list(HOWS)
    return {how: n for how, n in found.pairs.items() if n}, [(h.coming, h.standing) for h in found.hindered]


def test_legs_of_a_way_end_where_things_stand() -> None:
    """Along, straight to the axis, or along and then out from it or in to it."""
    coming, to = at("rod", 13, 4, 5), at("tube", 10, 0)
    out = (0.6, 0.8, 0.0)
    bring = {"bring": ["rod"], "to": "tube"}
    assert legs(StepSpec(**bring, along=[0.0, 0.0, -4.0]), coming, to) == (Leg((0.0, 0.0, -1.0), FAR),)
    (straight,) = legs(StepSpec(**bring), coming, to)
    assert straight == Leg((-0.6, -0.8, 0.0), FAR)
    for way in (2.5, -2.5):
        first, second = legs(StepSpec(**bring, along=[3.0, 0.0, -4.0], outwards=way), coming, to)
        assert (first.way, first.length) == (pytest.approx((0.6, 0.0, -0.8)), FAR)
        assert first.left == pytest.approx(tuple(way * x for x in out))
        side = math.copysign(1, way)
        assert (second.way, second.length, second.left) == (pytest.approx(tuple(side * x for x in out)), 2.5, (0, 0, 0))
    # what stands on the axis itself comes along x
    assert legs(StepSpec(**bring), at("rod", 10, 0), to) == (Leg((-1.0, 0.0, 0.0), FAR),)


@pytest.mark.parametrize(
    ("instances", "hows", "hindered"),
    [
        # boxes are apart, or meet only beyond the way
        ([at("rod", 40, 0), at("tube")], {"boxes": 1}, False),
        ([at("rod", 0, 0, 25), at("pin", 0, 0, -30)], {"boxes": 1}, False),
        ([at("pin", 0, 0, -30), at("rod", 0, 0, 25)], {"sections": 0, "solids": 1}, True),
        # boxes overlap in their corners alone
        ([at("rod", 12, 12), at("tube")], {"sections": 1}, False),
        ([at("rod"), at("tube")], {"sections": 1}, False), ([at("thick"), at("tube")], {"solids": 1}, True),
        ([at("cap"), at("rod", 0, 0, -20)], {"sections": 1}, False),
        # beside the axis in a hole, in the wall
        ([at("pin", 20, 0), at("flange")], {"sections": 1}, False),
        ([at("pin", 22, 0), at("flange")], {"solids": 1}, True),
        # layers tell what no axis does: in the hole of a plate that is no ring
        ([at("pin", 15, 1), at("plate")], {"sections": 1}, False),
        ([at("bar", 0, 0, 7), at("plate")], {"solids": 1}, True),
        ([at("bar", 10.2, 0, 6), at("plate")], {"layers": 1}, False),
        ([at("bar", 9, 0, 6), at("plate")], {"solids": 1}, True),
    ],
)  # fmt: skip
def test_what_comes_from_above(instances: list[Instance], hows: dict[str, int], hindered: bool) -> None:
    found = told(held(instances))
    assert found[0] == {how: n for how, n in hows.items() if n}
    assert found[1] == ([(instances[0].id, instances[1].id)] if hindered else [])


def ring_of(inner: float, outer: float, half: float) -> float:
    """Area of the right half of a ring within so much of the x axis: by the primitive of the square root."""

    def under(r: float) -> float:
        return half * math.sqrt(r * r - half * half) + r * r * math.asin(half / r)

    return under(outer) - under(inner)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("coming", "standing", "along", "volume"),
    [
        # a rod of 7 into a tube of 6 to 10: from its lower end up to the tube's upper one, or from below
        (at("thick", 0, 0, 15), at("tube"), DOWN, math.pi * 13 * 5),
        (at("thick", 0, 0, -10), at("tube"), DOWN, math.pi * 13 * 20),
        (at("thick", 0, 0, -10), at("tube"), UP, math.pi * 13 * 20),
        (at("thick", 0, 0, -25), at("tube"), UP, math.pi * 13 * 5),
        # a pin beside its hole: all of it, from above through the whole
        (at("pin", 25, 0, 3), at("flange"), DOWN, math.pi * 4 * 5),
        # a rod sideways through the wall of a wide ring: as high as both have in common
        (at("rod", 0, 0, 4), at("wide"), LEFT, 8 * ring_of(20, 30, 5)),
        (at("rod", 0, 0, -25), at("wide"), [1.0, 0.0, 0.0], 5 * ring_of(20, 30, 5)),
        # a bar of 40 by 8 down on a plate's upper layer: 18 of its length, from -10 to -28
        (at("bar", -10, 0, 7), at("plate"), DOWN, 18 * 8 * 3),
        # one that lies: a pin along x through the ring's wall
        (at("pin", 5, 0, 6, RIGHT), at("wide"), LEFT, None),
    ],
)  # fmt: skip
def test_what_is_passed_is_measured(
    coming: Instance, standing: Instance, along: list[float], volume: float | None
) -> None:
    """What the part, drawn out along its way, has in common with what stands, mm^3."""
    if volume is None:
        # chords of the wall over the disk of the pin, 4 pi wide: all but even
        volume = 4 * math.pi * 10 * 1.0
    step = {"bring": [coming.id], "to": standing.id, "along": along}
    (one,) = held([coming, standing], step).hindered
    assert (one.step, one.coming, one.standing) == (1, coming.id, standing.id)
    assert one.volume == pytest.approx(volume, rel=0.02)


def test_a_way_from_the_side_is_told_by_sections_or_layers() -> None:
    """Into a recess that is open on one side, and past what stands beside the way."""
    bring = {"bring": ["bar"], "to": "plate"}
    for along, hows in ((LEFT, {"layers": 1}), ([1.0, 0.0, 0.0], {"solids": 1})):
        found = told(held([at("bar", 12, 0, 7), at("plate")], bring | {"along": along}))
        assert found[0] == hows
        assert bool(found[1]) is (along != LEFT)
    # straight to the axis, over a flange: clear at any turn; a way that does not go through the axis is told by layers
    for y, how in ((0.0, "sections"), (4.0, "layers")):
        pin = named("pin", "pin", 20, y, 9)
        step = {"bring": ["pin"], "to": "hubbed", "along": LEFT}
        assert told(held([pin, at("hubbed")], step)) == ({how: 1}, [])
    # what stands turned is met where it stands
    for turn, free in ((0.0, False), (math.pi, True)):
        step = bring | {"along": [1.0, 0.0, 0.0]}
        found = told(held([at("bar", -22, 0, 7), named("plate", "plate", turn=turn)], step))
        assert bool(found[1]) is not free


def test_what_comes_straight_to_the_axis_stops_there() -> None:
    """From the right, over the wall of a low ring into it: what stands beyond the axis is not on its way."""
    step = {"bring": ["rod"], "to": "wide"}
    free = [named("rod", "rod", 10, 0, 13), named("post", "rod", -20, 0, 13), at("wide")]
    join = {"bring": ["post"], "to": "wide", "along": DOWN}
    assert told(held(free, join, step)) == ({"boxes": 1, "sections": 2}, []) or told(held(free, join, step))[1] == []
    beside = [named("rod", "rod", 10, 0, 13), named("post", "rod", 40, 0, 13), at("wide")]
    found = held(beside, join, step)
    assert [(h.coming, h.standing) for h in found.hindered] == [("rod", "post")]
    low = [named("rod", "rod", 10, 0, 5), at("wide")]
    assert told(held(low, step))[1] == [("rod", "wide")]


def test_each_of_a_row_goes_its_own_way_past_the_rest() -> None:
    """Two pins from the same side, one behind the other: the one that stands nearer is in the way of the farther."""
    pins = [named("near", "pin", 10, 0), named("far", "pin", 3, 0)]
    step = {"bring": ["near", "far"], "to": "wide"}
    raised = [named(p.id, p.part, p.at[0], 0, 13) for p in pins]
    found = held([*raised, at("wide")], step)
    assert [(h.coming, h.standing) for h in found.hindered] == [("far", "near")]
    # all at once, along one direction, they stay as they are to each other
    assert told(held([*raised, at("wide")], step | {"along": LEFT}))[1] == []


def test_pins_are_told_by_their_own_holes() -> None:
    """At 0 and 60 degrees there are holes, at 30 and 90 none; the flange turned by 30 it is the other way round."""
    pins = [named(f"p{k}", "pin", *((c := cmath.rect(20.0, math.radians(30 * k))).real, c.imag)) for k in range(4)]
    for turn, blocked in ((0.0, ["p1", "p3"]), (math.pi / 6, ["p0", "p2"]), (math.pi / 3, ["p1", "p3"])):
        found = told(held([*pins, named("flange", "flange", turn=turn)]))
        assert found == ({"sections": 2, "solids": 2}, [(key, "flange") for key in blocked])


def test_outwards_into_a_groove_and_not_past_its_wall() -> None:
    """Down into the bore of a wide ring, then out under a lid: two legs, each held."""
    lid = named("lid", "tube", 0, 0, 13)
    rod = named("rod", "pin", 8, 0, -20)
    ring = at("wide")
    join = {"bring": ["lid"], "to": "wide", "along": DOWN}
    for outwards, free in ((6.0, True), (2.0, False)):
        step = {"bring": ["rod"], "to": "wide", "along": DOWN, "outwards": outwards}
        found = held([rod, lid, ring], join, step)
        assert (found.hindered == []) is free
    inwards = {"bring": ["rod"], "to": "wide", "along": DOWN, "outwards": -6.0}
    assert held([rod, lid, ring], join, inwards).hindered == []


def test_what_turns_on_through_one_hole_is_held_all_round() -> None:
    """Two pins in a ring: one stop on their circle, beside their height, is none; one at it hinders each."""
    pins = [named("p0", "pin", 15, 0), named("p1", "pin", -15, 0)]
    step = {"bring": ["p0", "p1"], "to": "wide", "along": DOWN, "outwards": 1.0, "one_hole": True}
    join = {"bring": ["stop"], "to": "wide", "along": DOWN}
    for z, x, strikes in (
        (0.0, 15.0, True),
        (31.0, 15.0, False),
        (-31.0, 15.0, False),
        (0.0, 6.0, False),
        (29.9, 15.0, True),
    ):
        found = held([*pins, named("stop", "pin", 0, x, z), at("wide")], join, step)
        hindered = [h for h in found.hindered if h.volume is None]
        # the ring itself turns with its row
        assert bool([h for h in hindered if h.standing == "stop"]) is strikes
        assert not [h for h in hindered if h.standing == "wide"]
        if strikes:
            assert {h.coming for h in hindered} == {"p0", "p1"}


@pytest.mark.parametrize(("opened", "free"), [(None, False), (0.5, False), (1.0, True), (1.5, True)])
def test_a_snap_ring_passes_when_it_is_opened_far_enough(opened: float | None, free: bool) -> None:
    """5.05 within, the shaft 6 beyond its groove."""
    step: dict[str, Any] = {"bring": ["snap"], "to": "shaft", "along": DOWN} | ({"opened": opened} if opened else {})
    found = held([named("snap", "snap", 0, 0, 20.1), at("shaft")], step)
    assert (found.hindered == []) is free


def test_gears_slide_into_each_other_along_their_teeth() -> None:
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 8.0}
    raw = {"parts": {"a": gear, "b": gear}, "mates": [{"kind": "external_gear_pair", "first": "a", "second": "b"}]}
    scene = scene_from_dict(raw, "t", "t")
    made, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, made, matings, "t")
    for along, how in ((DOWN, "mesh"), (UP, "mesh"), ([0.0, 1.0, 0.0], "solids"), (LEFT, "layers")):
        found = order_found([StepSpec(bring=["b"], to="a", along=along)], placing, made)
        assert told(found)[0] == {how: 1}, along
        assert bool(found.hindered) is (how == "solids")


WHEEL = {"kind": "worm_wheel", "module": 2.0, "number_of_teeth": 30}


def worm(above: list[dict[str, float]], below: list[dict[str, float]]) -> tuple[Placing, dict[str, Part]]:
    raw = {
        "parts": {"wheel": WHEEL, "worm": {"kind": "worm", "module": 2.0, "thread_length": 30.0,
                                           "shaft_above": above, "shaft_below": below}},
        "mates": [{"kind": "worm_pair", "first": "wheel", "second": "worm"}],
    }  # fmt: skip
    scene = scene_from_dict(raw, "t", "t")
    made, matings = make_parts(scene, "t")
    return place(scene.instances, scene.drives, made, matings, "t"), made


# q 10: roots at 2 (5 - 1.2) = 7.6; tips at 12
THIN, THICK = ([{"diameter": 14.0, "length": 2.0}, {"diameter": d, "length": 40.0}] for d in (14.0, 22.0))
FAR_THICK = [{"diameter": 14.0, "length": 40.0}, {"diameter": 30.0, "length": 10.0}]


@pytest.mark.parametrize(
    ("above", "below", "ahead", "screwed", "passes"),
    [
        (THIN, THIN, 1, True, True), (THIN, THIN, -1, True, True), (THIN, THIN, 1, False, False),
        # what goes before the thread may be no thicker than its roots; what follows may, beside the wheel
        (THICK, THIN, 1, True, False), (THIN, THICK, -1, True, False), (THIN, FAR_THICK, 1, True, True),
        (FAR_THICK, THIN, 1, True, False), (FAR_THICK, THIN, -1, True, True),
    ],
)  # fmt: skip
def test_a_worm_is_screwed_past_its_wheel(
    above: list[dict[str, float]],
    below: list[dict[str, float]],
    ahead: int,
    screwed: bool,
    passes: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # solids would tell the same a hundred times slower
    monkeypatch.setattr("parts.scene.assembly_order._Order._decided", lambda *_: ("solids", None))
    placing, made = worm(above, below)
    own = next(i for i in placing.instances if i.id == "worm")
    way = [ahead * x for x in own.axis]
    found = order_found([StepSpec(bring=["worm"], to="wheel", along=way, screwed=screwed)], placing, made)
    assert (told(found)[0] == {"mesh": 1}) is passes
    assert (found.hindered == []) is passes


@pytest.mark.parametrize("ahead", [1, -1])
@pytest.mark.parametrize("nearer", [0.2, -0.2])
def test_what_follows_the_thread_stays_beside_the_wheel(
    nearer: float, ahead: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A shaft of 22 begins so far behind the thread that it stands off the wheel's axis as far as that reaches."""
    monkeypatch.setattr("parts.scene.assembly_order._Order._decided", lambda *_: ("solids", None))
    # the worm's axis is m (z + q) / 2 = 40 off the wheel's, the thread ends 15 from the middle
    reach = worm(THIN, THIN)[1]["wheel"].body(0.0).section_reach()
    begin = math.sqrt(reach**2 - (40 - 11) ** 2) - 15 - nearer
    thick = [{"diameter": 14.0, "length": begin}, {"diameter": 22.0, "length": 20.0}]
    placing, made = worm(*((THIN, thick) if ahead > 0 else (thick, THIN)))
    own = next(i for i in placing.instances if i.id == "worm")
    way = [ahead * x for x in own.axis]
    found = order_found([StepSpec(bring=["worm"], to="wheel", along=way, screwed=True)], placing, made)
    assert (told(found)[0] == {"mesh": 1}) is (nearer < 0)


def test_pairs_are_counted_once_each() -> None:
    """Six instances, three steps: 15 pairs, each decided when the later of both comes."""
    instances = [named("a", "rod", 100, 0), named("b", "rod", 200, 0), named("c", "pin", 0, 0), named("d", "tube"),
                 named("e", "wide"), named("f", "flange", 0, 0, -9)]  # fmt: skip
    steps = [{"bring": ["d"], "to": "f", "along": DOWN}, {"bring": ["e"], "to": "f", "along": DOWN},
             {"bring": ["c"], "to": "f", "along": DOWN}, {"bring": ["a"], "to": "f", "along": DOWN},
             {"bring": ["b"], "to": "f", "along": DOWN}]  # fmt: skip
    found = held(instances, *steps)
    assert found.steps == 5
    assert sum(found.pairs.values()) == 15
    # what stands far off and below all else meets no box
    assert told(found)[0] == {"boxes": 12, "sections": 3}
    assert found.hindered == []
    assert np.isfinite(FAR)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("keys", "screwed", "how"),
    [
        ({}, False, "mesh"), ({"helix_angle_deg": 20.0}, True, "mesh"),
        # they slid straight through each other
        ({"helix_angle_deg": 20.0}, False, "solids"),
        ({"helix_angle_deg": 20.0, "double_helical": True}, True, "solids"),
    ],
)  # fmt: skip
def test_helical_wheels_are_screwed_past_each_other_and_herringbones_are_not(
    keys: dict[str, Any], screwed: bool, how: str
) -> None:
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 20.0} | keys
    raw = {"parts": {"a": gear, "b": gear | ({"hand": "left"} if keys else {})},
           "mates": [{"kind": "external_gear_pair", "first": "a", "second": "b"}]}  # fmt: skip
    scene = scene_from_dict(raw, "t", "t")
    made, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, made, matings, "t")
    found = order_found([StepSpec(bring=["b"], to="a", along=[0.0, 0.0, -1.0], screwed=screwed)], placing, made)
    assert told(found)[0] == {how: 1}
    assert bool(found.hindered) is (how == "solids")
