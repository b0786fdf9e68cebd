"""Parts around round pins: every limit of their keys by circles and chords, at both its sides, and what they report."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import pytest

from exporters.production.plan import plan_build
from geometry.base.errors import Nearest, ParameterError
from geometry.gears.pins.cycloidal import CycloidalDisc, checked_disc
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.parts.limits import check_limit, check_offer, check_refused, offset_limits, refused, scene_of, with_key
from tests.parts.scene.test_offers import judged

# the thinnest wall: 0.05 mm, of parts below 10 mm in radius half a hundredth of that
WALL = 0.05
RING: dict[str, Any] = {"kind": "pin_ring", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0}
HOLES = RING | {"pins": "holes"}
FIXED = RING | {"pins": "fixed"}
PLATE: dict[str, Any] = {"kind": "output_plate", "number_of_pins": 6, "pin_diameter": 6.0, "pin_circle_diameter": 56.0}
SMALL: dict[str, Any] = {"kind": "output_plate", "number_of_pins": 6, "pin_diameter": 1.0, "pin_circle_diameter": 8.0}
LOOSE = PLATE | {"pins": "holes"}
LANTERN: dict[str, Any] = {"kind": "lantern_wheel", "number_of_pins": 12, "pin_circle_diameter": 80.0,
                           "pin_diameter": 8.0}  # fmt: skip
GEAR: dict[str, Any] = {"kind": "lantern_gear", "number_of_teeth": 30, "number_of_pins": 12,
                        "pin_circle_diameter": 80.0, "pin_diameter": 8.0}  # fmt: skip
DISC: dict[str, Any] = {"kind": "cycloidal_disc", "number_of_lobes": 11, "pin_circle_diameter": 80.0,
                        "pin_diameter": 6.0, "eccentricity": 1.5}  # fmt: skip
PIN: dict[str, Any] = {"kind": "pin", "diameter": 8.0, "length": 60.0}
ECCENTRIC: dict[str, Any] = {"kind": "eccentric", "diameter": 32.0, "eccentricity": 4.0, "bore_diameter": 10.0}


def output(count: int = 6, circle: float = 45.0, pin: float = 6.0, **more: float) -> dict[str, Any]:
    """A disc of valleys at 40 - 1.5 - 3 with output holes, each as wide as its pin and 2 e = 3."""
    table = {"count": count, "pitch_circle_diameter": circle, "pin_diameter": pin, **more}
    return DISC | {"bore_diameter": 20.0, "output_holes": table}


# part, key, code, limit, side, what is told besides
LIMITS: list[tuple[dict[str, Any], str, str, float, str, dict[str, float]]] = [
    # pins and seats beside each other: half of the chord of a step, half a wall left
    (HOLES, "pin_diameter", "pins_touch", 80 * math.sin(math.pi / 12) - WALL, "at_most", {"pins": 12, "circle": 80.0}),
    (HOLES, "seat_clearance", "seats_touch", 40 * math.sin(math.pi / 12) - WALL / 2 - 4, "at_most", {}),
    (RING, "seat_clearance", "leaves_no_seat", -2.0, "at_least", {}),
    # the plate inside its holes; seats and hole cross from 40 - 4 to 40 + 4, a fiftieth of that is kept
    (HOLES, "inner_diameter", "inside_reaches_pin_holes", 2 * (40 - 4 - WALL), "at_most", {}),
    (HOLES | {"seat_clearance": 0.5}, "inner_diameter", "inside_reaches_pin_holes", 2 * (35.5 - WALL), "at_most", {}),
    (RING, "inner_diameter", "inside_beyond_pins", 2 * (44 - 0.16), "at_most", {}),
    (RING, "inner_diameter", "inside_buries_pins", 2 * (36 + 0.16), "at_least", {}),
    (FIXED, "inner_diameter", "inside_beyond_pins", 2 * (44 - 0.16), "at_most", {}),
    (RING, "outer_diameter", "leaves_no_rim", 2 * (44 + WALL), "at_least", {}),
    (FIXED, "outer_diameter", "leaves_no_rim", 2 * (40 + WALL), "at_least", {}),
    (RING | {"holes": {"count": 6, "diameter": 5.0, "pitch_circle_diameter": 100.0}}, "outer_diameter",
     "leaves_no_rim", 2 * (52.5 + WALL), "at_least", {}),
    (RING | {"holes": {"count": 6, "diameter": 5.0, "pitch_circle_diameter": 100.0}}, "holes.pitch_circle_diameter",
     "holes_reach_pins", 2 * (44 + WALL) + 5, "at_least", {}),
    (RING | {"holes": [{"count": 4, "diameter": 4.0, "pitch_circle_diameter": 104.0, "start_deg": 20.0},
                       {"count": 4, "diameter": 5.0, "pitch_circle_diameter": 100.0}]},
     "holes[2].pitch_circle_diameter", "holes_reach_pins", 2 * (44 + WALL) + 5, "at_least", {}),
    # a plate of pins
    (PLATE, "outer_diameter", "pins_reach_edge", 2 * (28 + 3 + WALL), "at_least", {"diameter": 62.0}),
    (LOOSE | {"seat_clearance": 0.5}, "outer_diameter", "pins_reach_edge", 2 * (31.5 + WALL), "at_least",
     {"diameter": 63.0}),
    (PLATE, "pin_diameter", "pins_touch", 2 * (28 * math.sin(math.pi / 6) - WALL / 2), "at_most",
     {"pins": 6, "circle": 56.0}),
    (LOOSE, "seat_clearance", "leaves_no_hole", -1.5, "at_least", {}),
    (LOOSE, "seat_clearance", "holes_touch_each_other", 28 * math.sin(math.pi / 6) - WALL / 2 - 3, "at_most", {}),
    # the wall of a small plate is 0.005 of its radius, 4 mm with a pin and the clearance beyond: d = 4 - 0.005 (4 + d)
    (SMALL, "pin_diameter", "pins_touch", 3.98 / 1.005, "at_most", {"pins": 6, "circle": 8.0}),
    (SMALL | {"pins": "holes"}, "seat_clearance", "holes_touch_each_other", 1.4875 / 1.0025, "at_most", {}),
    (PLATE, "bore_diameter", "bore_reaches_pins", 2 * (28 - 3 - WALL), "at_most", {}),
    (LOOSE | {"seat_clearance": 0.5}, "bore_diameter", "bore_reaches_pins", 2 * (24.5 - WALL), "at_most", {}),
    # 4 + 1 mm in radius: a wall of 0.025
    (SMALL, "bore_diameter", "bore_reaches_pins", 2 * (3.5 - 0.025), "at_most", {}),
    (LANTERN, "bore_diameter", "bore_reaches_pins", 2 * (36 - WALL), "at_most", {}),
    # output holes between bore and valleys, at 35.5, and beside each other; holes are 9 wide
    (output(), "output_holes.pitch_circle_diameter", "output_holes_do_not_fit", 71 - 2 * WALL - 9, "at_most",
     {"diameter": 9.0}),
    (output(), "output_holes.pitch_circle_diameter", "output_holes_do_not_fit", 20 + 2 * WALL + 9, "at_least",
     {"diameter": 9.0}),
    (output(12, pin=5.0) | {"bore_diameter": 0.0}, "output_holes.pitch_circle_diameter", "output_holes_do_not_fit",
     (8 + WALL) / math.sin(math.pi / 12), "at_least", {"diameter": 8.0}),
    (output(1) | {"bore_diameter": 0.0}, "output_holes.pitch_circle_diameter", "output_holes_do_not_fit",
     71 - 2 * WALL - 9, "at_most", {"diameter": 9.0}),
    (DISC, "bore_diameter", "no_wall_around_bore", 2 * (35.5 - WALL), "at_most", {}),
    (GEAR, "bore_diameter", "no_wall_around_bore", 2 * (100 - 4 - WALL), "at_most", {}),
    (PIN, "bore_diameter", "leaves_no_wall", 8 - 2 * 0.02, "at_most", {}),
    (PIN | {"diameter": 30.0}, "bore_diameter", "leaves_no_wall", 30 - 2 * WALL, "at_most", {}),
    (ECCENTRIC, "bore_diameter", "no_wall_around_bore", 2 * (16 - 4 - WALL), "at_most", {}),
]  # fmt: skip


@pytest.mark.parametrize(
    ("part", "key", "code", "limit", "side", "numbers"), LIMITS, ids=[f"{r[0]['kind']} {r[1]} {r[2]}" for r in LIMITS]
)
def test_a_limit_is_told_and_holds(
    part: dict[str, Any], key: str, code: str, limit: float, side: str, numbers: dict[str, float]
) -> None:
    check_limit(scene_of(part), f"parts.p.{key}", code, limit, side, **numbers)


# the same where beyond the limit another key is blamed, with a value from far off
OFFERED: list[tuple[dict[str, Any], str, float, str, float]] = [
    # no circle has room for pins of 25 mm, this one for some; holes of three are stopped by the bore or the valleys
    (output(), "output_holes.pin_diameter", 25.0, "output_holes_do_not_fit", 45 * 0.5 - WALL - 3),
    (output(3), "output_holes.pin_diameter", 25.0, "output_holes_do_not_fit", 45 - 20 - 2 * WALL - 3),
    (output(3, 47.0, clearance=0.5), "output_holes.pin_diameter", 25.0, "output_holes_do_not_fit",
     71 - 2 * WALL - 47 - 3.5),
    (ECCENTRIC | {"bore_diameter": 0.5}, "eccentricity", 15.91, "bore_axis_leaves_disc", 16 - 0.25 - WALL),
    # as far as the corners of a hexagon go: a bore of a shape stood 0.03 mm farther out than was told
    (ECCENTRIC | {"bore_diameter": 0.0, "bore": {"shape": "hexagon", "across_flats": 8.0}}, "eccentricity", 15.91,
     "bore_axis_leaves_disc", 16 - 8 / math.sqrt(3) - WALL),
]  # fmt: skip


@pytest.mark.parametrize(("part", "key", "value", "code", "limit"), OFFERED)
def test_what_is_far_too_large_is_told_the_most_that_works(
    part: dict[str, Any], key: str, value: float, code: str, limit: float
) -> None:
    check_offer(scene_of(part), f"parts.p.{key}", value, code, limit, "at_most")


def test_more_output_holes_than_there_is_room_for_are_told_how_many_there_is_room_for() -> None:
    """Before: ``no room between bore and valleys; leave output_holes out``, where 15 of them fit.

    Two neighbours of n holes 9 mm wide on a circle of 45 mm leave a wall of 0.05 where 45 sin(pi / n) >= 9.05.
    """
    raw = scene_of(output(100))
    found = refused(raw)
    assert found is not None
    assert (found.key, found.code) == ("parts.p.output_holes.count", "output_holes_do_not_fit")
    assert found.nearest == Nearest(math.floor(math.pi / math.asin((9 + WALL) / 45)), "at_most")
    assert judged(raw, found) == []


def test_an_axis_beside_its_disc_is_told_from_the_rim_on() -> None:
    """Two walls from the rim the axis leaves the disc; before, its bore is blamed."""
    for value, key in ((16 - 2 * WALL - 1e-6, "bore_diameter"), (16 - 2 * WALL + 1e-6, "eccentricity")):
        found = refused(scene_of(ECCENTRIC | {"bore_diameter": 0.5, "eccentricity": value}))
        assert found is not None
        assert found.key == f"parts.p.{key}"


def test_a_disc_beside_its_axis_has_no_drawing_but_files() -> None:
    """Its drawing was a traceback; a section stands in the plane of the axis."""
    raw = scene_of({"kind": "eccentric", "diameter": 32.0, "eccentricity": 16.5})
    assert refused(raw) is None
    for value, drawn in ((16.5, False), (15.999, True)):
        part = raw["parts"]["p"] | {"eccentricity": value}
        asked = {"parts": {"p": part}, "exports": [{"format": "svg", "purpose": "part"}]}
        plan = partial(plan_build, scene_from_dict(asked, "s", "s"), "s", [], [])
        if drawn:
            assert plan().sheets
            continue
        with pytest.raises(SceneError) as found:
            plan()
        assert (found.value.key, found.value.code) == ("parts.p.eccentricity", "axis_leaves_section")
        assert found.value.nearest is not None
        assert 15.99 < found.value.nearest.value < 16  # type: ignore[operator]


REFUSED: list[tuple[dict[str, Any], str, object, str, object]] = [
    (FIXED, "seat_clearance", 0.1, "fixed_pins_have_no_seats", 0.0),
    (LOOSE, "pin_length", 5.0, "only_of_solid_pins", None),
]


@pytest.mark.parametrize(("part", "key", "value", "code", "works"), REFUSED)
def test_a_key_that_does_not_belong_is_told(
    part: dict[str, Any], key: str, value: object, code: str, works: object
) -> None:
    check_refused(scene_of(part), f"parts.p.{key}", value, code, works)


def test_output_pins_without_room_on_their_circle_or_on_any() -> None:
    """The circle with the most room: between bore and valleys, or where outer edge and chord meet."""
    elsewhere = refused(scene_of(output(circle=22.0, pin=25.0)))
    assert elsewhere is not None
    assert (elsewhere.key, elsewhere.code) == ("parts.p.output_holes.pin_diameter", "output_holes_fit_elsewhere")
    best = (71 - 2 * WALL + WALL) / 1.5
    assert elsewhere.numbers["circle"] == pytest.approx(best, rel=1e-6)
    assert elsewhere.numbers["diameter"] == pytest.approx(28.0)
    assert elsewhere.nearest is None
    few = refused(scene_of(output(3, circle=22.0, pin=30.0)))
    assert few is not None
    assert few.numbers["circle"] == pytest.approx((71 + 20) / 2, rel=1e-6)
    # a bore of 50 leaves a ring 10.5 wide, less than 2 e and a clearance of 8 alone
    none = refused(scene_of(output(circle=22.0, clearance=8.0) | {"bore_diameter": 50.0}))
    assert none is not None
    assert (none.key, none.code) == ("parts.p.output_holes.count", "output_holes_have_no_room")
    assert none.numbers["diameter"] == pytest.approx(17.0)


def test_a_bore_beside_output_holes_is_blamed_where_it_leaves_no_circle_for_them() -> None:
    """Both holes and four walls beside a bore of 53 are more than 71; of one below that another circle has room."""
    raw, key = scene_of(output()), "parts.p.bore_diameter"
    least = 71 - 2 * 9 - 4 * WALL
    check = refused(with_key(raw, key, least + 1e-3))
    assert check is not None
    assert (check.key, check.code) == (key, "bore_reaches_output_holes")
    assert check.nearest is not None
    assert check.nearest.value == pytest.approx(45 - 9 - 2 * WALL, abs=1e-4)
    assert check.nearest.value < 45 - 9 - 2 * WALL  # type: ignore[operator]
    assert refused(with_key(raw, key, check.nearest.value)) is None
    other = refused(with_key(raw, key, least - 1e-3))
    assert other is not None
    assert other.key == "parts.p.output_holes.pitch_circle_diameter"


def test_pins_of_a_disc_that_is_made_never_fill_its_valleys() -> None:
    """The path of a pin's centre turns at least so sharply that pins undercut lobes before they reach the axis."""
    rng, made = np.random.default_rng(3), 0
    for _ in range(400):
        lobes, radius = int(rng.integers(2, 30)), 40.0
        disc = CycloidalDisc(lobes, 2 * radius, float(rng.uniform(0.1, 79)), float(rng.uniform(0, radius / lobes)))
        try:
            checked_disc(disc)
        except ParameterError:
            continue
        made += 1
        assert disc.root_radius > 0
    assert made > 20


def part_of(part: dict[str, Any]) -> Any:
    return make_parts(scene_from_dict(scene_of(part), "s", "s"), "s")[0]["p"]


def lantern_sizes(teeth: int, pins: int, radius: float, pin: float, foot: float, tip: float) -> dict[str, float]:
    """What a lantern's gear tells, by the path of a pin's centre: an epicycloid about it, the flank beside that.

    The pin touches on the line to the pitch point; ``foot``: radius of the space's ground about the pitch circle.
    """
    own = radius * teeth / pins

    def centre(t: float) -> complex:
        return (own + radius) * np.exp(1j * t) - radius * np.exp(1j * t * (1 + own / radius))

    def flank(t: float) -> complex:
        way = own * np.exp(1j * t) - centre(t)
        return complex(centre(t) + pin * way / abs(way))

    half = math.pi / teeth
    start = bisected(lambda t: abs(flank(t) - own) - foot, 1e-4, 0.6)
    pointed = bisected(lambda t: np.angle(flank(t)) - half, 1e-4, 0.6)
    end = bisected(lambda t: abs(flank(t)) - tip, 1e-4, 0.6)
    # contact from the flank's start to the tip, in angles of the gear, over a pitch
    return {
        "pitch": 2 * math.pi * radius / pins,
        "tip_tooth_thickness": 2 * tip * (half - float(np.angle(flank(end)))),
        "pointed_tip_diameter": 2 * abs(flank(pointed)),
        "flank_start_diameter": 2 * abs(flank(start)),
        "lantern_contact_ratio": (end - start) / (2 * half),
    }


def bisected(function: Any, low: float, high: float) -> float:
    assert function(low) < 0 < function(high)
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return low


def test_parts_around_pins_report_their_sizes() -> None:
    disc = part_of(DISC | {"pin_clearance": 0.1, "pin_circle_shift": 0.2})
    rho, big = 3.1, 39.8
    lam = 1.5 * 12 / big
    assert disc.circles == pytest.approx(
        {"tip_diameter": 2 * (big + 1.5 - rho), "root_diameter": 2 * (big - 1.5 - rho), "pin_circle_diameter": 80.0}
    )
    # of a shortened epicycloid: beyond lambda = (N - 2) / (2 N - 1) its least radius is not at the top
    path = big * math.sqrt(27 * 11 * (1 - lam**2) / 13**3)
    assert lam > 10 / 23
    assert disc.quantities == pytest.approx(
        {"reduction": 11.0, "number_of_pins": 12.0, "eccentricity": 1.5, "shortening_coefficient": lam,
         "least_path_radius": path, "least_convex_curvature_radius": path - rho}
    )  # fmt: skip
    gear = part_of(GEAR | {"root_clearance": 0.5, "tip_diameter": 212.0})
    assert gear.circles == pytest.approx({"tip_diameter": 212.0, "pitch_diameter": 200.0, "root_diameter": 191.0})
    assert gear.quantities == pytest.approx(lantern_sizes(30, 12, 40.0, 4.0, 4.5, 106.0))
    plate = part_of(PLATE)
    assert plate.circles == {"pin_circle_diameter": 56.0}
    assert plate.quantities == {"number_of_pins": 6.0, "pin_diameter": 6.0}
    ring = part_of(RING)
    assert ring.circles == {"pin_circle_diameter": 80.0, "inner_diameter": 80.0}
    assert part_of(HOLES | {"inner_diameter": 0.0}).circles == {"pin_circle_diameter": 80.0}
    assert ring.quantities == {"number_of_pins": 12.0, "pin_diameter": 8.0}
    assert part_of(PIN).quantities == {"diameter": 8.0}
    assert part_of(ECCENTRIC).quantities == {"diameter": 32.0, "eccentricity": 4.0}
    assert part_of(ECCENTRIC).findings == ()
    # in a bearing of 8 mm about the shaft of 5 mm of a motor; it was made without a word
    thin = part_of(ECCENTRIC | {"diameter": 8.0, "eccentricity": 1.0, "bore_diameter": 5.0})
    assert [(one.code, one.value, one.limit) for one in thin.findings] == [("thin_roller_wall", 0.5, 1.0)]


@pytest.mark.parametrize(
    ("part", "inner", "outer"),
    [
        # three half pins beyond the circle, or half a one beyond holes or the inside
        (RING, 80.0, 2 * (40 + 12)),
        (RING | {"seat_clearance": 0.5}, 80.0, 2 * (40 + 12.5)),
        (RING | {"seat_clearance": -0.5}, 80.0, 2 * (40 + 12)),
        (RING | {"holes": {"count": 6, "diameter": 5.0, "pitch_circle_diameter": 110.0}}, 80.0, 2 * (57.5 + 4)),
        (HOLES, 2 * (40 - 8), 2 * (40 + 12)),
        (HOLES | {"seat_clearance": 0.5}, 2 * (40 - 8.5), 2 * (40 + 12.5)),
        (HOLES | {"seat_clearance": -0.5}, 2 * (40 - 8), 2 * (40 + 12)),
        (HOLES | {"number_of_pins": 3, "pin_diameter": 45.0}, 0.0, 2 * (40 + 67.5)),
        (RING | {"inner_diameter": 83.0}, 83.0, 2 * (40 + 12)),
        (RING | {"outer_diameter": 120.0}, 80.0, 120.0),
    ],
)
def test_a_ring_that_is_told_nothing_has_a_rim_of_pins(part: dict[str, Any], inner: float, outer: float) -> None:
    ring = part_of(part).thing
    assert 2 * ring.inner_radius == pytest.approx(inner)
    assert 2 * ring.outer_radius == pytest.approx(outer)


@pytest.mark.parametrize(
    ("part", "height", "outer", "holds"),
    [
        (PLATE, 10.0 + 10.0, 68.0, False),
        (PLATE | {"face_width": 4.0, "pin_length": 7.0}, 11.0, 68.0, False),
        (LOOSE | {"face_width": 4.0}, 4.0, 68.0, True),
        (LOOSE | {"seat_clearance": 0.5, "face_width": 4.0}, 4.0, 69.0, True),
        (LOOSE | {"seat_clearance": -0.5, "outer_diameter": 90.0}, 10.0, 90.0, True),
        (LANTERN, 2 * 3.0 + 10.0, 96.0, False),
        (LANTERN | {"face_width": 12.0, "plate_thickness": 2.0}, 16.0, 96.0, False),
        (LANTERN | {"pins": "holes", "plate_thickness": 2.0}, 2.0, 96.0, True),
        (PIN, 60.0, 8.0, True),
    ],
)
def test_plates_and_pins_are_as_high_as_they_stand(
    part: dict[str, Any], height: float, outer: float, holds: bool
) -> None:
    made = part_of(part)
    assert made.made_by.height(made.keys, made.thing) == pytest.approx(height)
    assert 2 * made.section(0.0).region.outer.reach() == pytest.approx(outer)
    assert made.is_plate is holds
    area = math.pi * outer**2 / 4
    moments = made.made_by.moments(made.body(0.0))
    if part["kind"] == "pin":
        assert moments.volume == pytest.approx(area * height)
        return
    size = part.get("seat_clearance", 0.0) + part["pin_diameter"] / 2
    if holds:
        wanted = (area - part["number_of_pins"] * math.pi * size**2) * height
    else:
        length = part.get("pin_length", 10.0) if part["kind"] == "output_plate" else part.get("face_width", 10.0)
        wanted = area * (height - length) + part["number_of_pins"] * math.pi * size**2 * length
    assert moments.volume == pytest.approx(wanted, rel=1e-9)
    assert (made.flat_findings != ()) is not holds


def test_a_pin_of_stock_tells_its_rod() -> None:
    made = part_of(PIN | {"bore_diameter": 3.0})
    assert made.made_by.stock(made.keys) == type(made.made_by.stock(made.keys))(8.0, 3.0, 60.0)
    assert made.section(0.0).region.holes[0].reach() == pytest.approx(1.5)


def test_sections_bear_offsets_up_to_their_walls() -> None:
    """Half of the thinnest wall inwards, outwards as far as holes stay open."""
    offset_limits(PIN | {"bore_diameter": 3.0}, -1.25, 1.5)
    offset_limits(ECCENTRIC, -(16 - 4 - 5) / 2, 5.0)
    # between holes of 8 on a circle of 80, 30 degrees apart: 20.7 - 8; to the inside and to the rim 4 and 8
    offset_limits(HOLES, -2.0, 4.0)
