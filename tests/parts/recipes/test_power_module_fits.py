"""The power module put together: what lies on what, what goes through which hole, how far apart what turns stands.

Contacts are found from the tables of the parts alone; what is expected follows from how the module is built, holes of
screws from ISO 273 (medium), heads from GOST 11738 and 17473.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter
from functools import cache
from typing import Any

import numpy as np
import pytest

from parts.scene.scene_file import SceneFile
from tests.oracles.clearances import solid_of
from tests.oracles.contacts import Contacts
from tests.parts.recipes.test_power_module import module

ORIENTATIONS = ("cranks", "thesis", "idlers")
# running play and axial gap as they are by default, mm
CLEARANCE, GAP = 0.1, 5.0


@cache
def contacts(orientation: str) -> Contacts:
    return Contacts(scene_of(orientation))


@cache
def scene_of(orientation: str) -> SceneFile:
    return module(orientation=orientation)


# by part: how many of its instances stand between what is below (that they lie on) and what is above
Rests = dict[str, list[tuple[int, str, str]]]
COMMON: Rests = {
    # the housing on its bed, guide 6 on its lip, ring 18 on its boss
    "guide_6": [(1, "body", "screw_51")], "screw_51": [(20, "guide_6", "")],
    "bolt_42": [(8, "body", "")], "nut_44": [(8, "", "body")],
    # disk 2 between shields, rings 33 in both faces of it, guide 5 on its flange, ring 24 with worm wheel 25 behind it
    "disk_2": [(1, "spacer_24 protective_ring", "shield_7 shield_8 guide_5 protective_ring")],
    "shield_7": [(1, "disk_2", "screw_59")], "shield_8": [(1, "disk_2", "screw_59")],
    "protective_ring": [(1, "disk_2", "screw_59"), (1, "screw_59_down", "disk_2")],
    "screw_59": [(16, "shield_7", ""), (16, "shield_8", ""), (12, "protective_ring", "")],
    "screw_59_down": [(12, "", "protective_ring")],
    "guide_5": [(1, "disk_2", "screw_52")], "screw_52": [(32, "guide_5", "")],
    "spacer_24": [(1, "worm_wheel_25 screw_53_down", "disk_2")],
    "worm_wheel_25": [(1, "bearing_ring bolt_41", "spacer_24")], "bolt_41": [(24, "", "worm_wheel_25")],
    "bearing_ring": [(1, "bearing_ring", "worm_wheel_25"), (1, "screw_53_down", "bearing_ring")],
    # wheel 21 on ring 22 on worm wheel 23
    "spacer_22": [(1, "worm_wheel_23", "ring")], "worm_wheel_23": [(1, "screw_53_down", "spacer_22")],
    "screw_53": [(12, "ring", "")],
    "screw_53_down": [(12, "", "spacer_24"), (24, "", "bearing_ring"), (12, "", "worm_wheel_23")],
    # the pinion under sleeve 17 under disk 3
    "sleeve_17": [(1, "pinion", "disk_3")], "disk_3": [(1, "sleeve_17", "screw_56")], "screw_56": [(6, "disk_3", "")],
    "cover_12": [(1, "screw_51_down", "pinion")], "screw_51_down": [(4, "", "cover_12")], "nut_46": [(1, "pinion", "")],
    "platform": [(1, "platform_axle", "screw_55")], "screw_55": [(6, "platform", "")],
    # in holes, grooves and windows, not on faces
    "plug": [(2, "", "")], "ball": [(180, "", "")], "small_cage": [(2, "", "")], "large_cage": [(2, "", "")],
    "screw_49": [(2, "", "")], "screw_49_up": [(2, "", "")],
}  # fmt: skip


def on_axle(holder: str) -> Rests:
    """Nut 47 clamps what turns the platform to the shoulder of its axle, with ring 10 about that."""
    return {"platform_axle": [(1, holder, "platform")], "nut_47": [(1, "", holder)], "spacer_10": [(1, holder, "")]}


SATELLITE: Rests = {
    "ring": [(1, "spacer_22", "screw_53")], "pinion": [(1, "cover_12 satellite_axle", "nut_46 sleeve_17")],
    "satellite_axle": [(1, "spacer_15", "pinion")], "spacer_15": [(1, "screw_57", "satellite_axle")],
    "screw_57": [(1, "", "spacer_15")], "satellite_wheel": [(1, "", "")],
}  # fmt: skip
RESTS: dict[str, Rests] = {
    "cranks": {
        "body": [(1, "nut_44", "guide_6 bolt_42 spacer_18 screw_54")], "spacer_18": [(1, "body", "body_plate")],
        # the ends of the screws stand on the floor under the boss
        "body_plate": [(1, "spacer_18", "screw_54 crank_pin")], "screw_54": [(6, "body body_plate", "")],
        "ring": [(1, "spacer_22", "screw_53")], "pinion": [(1, "cover_12 ring_guide", "nut_46 sleeve_17")],
        "ring_guide": [(1, "", "pinion")],
        # pins with their collars on both faces of ring 14, before plate 16 and behind plate 11
        "free_ring": [(1, "crank_pin", "crank_pin")],
        "crank_pin": [(3, "body_plate", ""), (3, "", "free_ring"), (3, "free_ring", ""), (3, "", "platform_plate")],
        "crank": [(6, "", "")],
        "platform_plate": [(1, "nut_47 crank_pin", "platform_axle spacer_10")],
        **on_axle("platform_plate"),
    },
    "thesis": {
        "body": [(1, "nut_44", "guide_6 bolt_42 spacer_18")], "spacer_18": [(1, "body", "central_wheel")],
        "central_wheel": [(1, "spacer_18", "screw_54")], "screw_54": [(6, "central_wheel", "")], **SATELLITE,
        "platform_wheel": [(1, "nut_47", "platform_axle spacer_10")],
        **on_axle("platform_wheel"),
    },
    "idlers": {
        "body": [(1, "nut_44", "guide_6 bolt_42 spacer_18 screw_54")], "spacer_18": [(1, "body", "post")],
        "post": [(1, "spacer_18", "screw_54 central_wheel")], "screw_54": [(6, "body post", "")],
        "central_wheel": [(1, "post", "")], **SATELLITE,
        # nut 47 holds the axle with ring 10 alone; wheel 11 sits on the end of its neck
        "platform_wheel": [(1, "", "platform_axle")], "platform_axle": [(1, "nut_47 platform_wheel", "platform")],
        "nut_47": [(1, "", "platform_axle spacer_10")], "spacer_10": [(1, "nut_47", "")],
        "idler": [(2, "", "")], "idler_pin": [(1, "", "")], "idler_pin_down": [(1, "", "")], "link": [(2, "", "")],
    },
}  # fmt: skip


@pytest.mark.sampled(2)
@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_everything_lies_on_what_it_is_held_by(orientation: str) -> None:
    own = contacts(orientation)
    found: dict[str, Counter[tuple[frozenset[str], frozenset[str]]]] = {}
    for key, touched in own.planes.items():
        sides = tuple(frozenset(part for part, up in touched if up is above) for above in (False, True))
        found.setdefault(str(own.scene.instances[key].part), Counter())[sides[0], sides[1]] += 1
    expected = {
        part: Counter({(frozenset(low.split()), frozenset(high.split())): count for count, low, high in rows})
        for part, rows in (COMMON | RESTS[orientation]).items()
    }
    assert found == expected


# by what is inside: what it is screwed into, or sits in without play
TIGHT = {
    "bolt_41": "spacer_24", "bolt_42": "nut_44", "screw_49": "body", "screw_49_up": "body", "screw_51": "body",
    "screw_51_down": "pinion", "screw_52": "spacer_24", "screw_53": "spacer_22",
    "screw_53_down": "disk_2 spacer_22 worm_wheel_25", "screw_54": "body spacer_18", "screw_55": "platform_axle",
    "screw_56": "pinion", "screw_59": "disk_2", "screw_59_down": "disk_2", "disk_2": "guide_5",
    "protective_ring": "disk_2", "platform_axle": "nut_47 platform spacer_10",
}  # fmt: skip
TIGHT_BY = {
    "cranks": {"crank_pin": "body_plate free_ring platform_plate", "platform_axle": "platform_plate",
               "ring_guide": "nut_46 pinion"},
    "thesis": {"satellite_axle": "nut_46 pinion", "screw_57": "satellite_axle spacer_15",
               "platform_axle": "platform_wheel"},
    "idlers": {"satellite_axle": "nut_46 pinion", "screw_57": "satellite_axle spacer_15",
               "platform_axle": "platform_wheel", "idler_pin": "link",
               "idler_pin_down": "link platform_axle", "post": "central_wheel"},
}  # fmt: skip
# screws by their nominal diameter, what they pass through
PASSED = {
    8: {"bolt_41": "worm_wheel_25", "screw_51": "guide_6", "screw_51_down": "cover_12", "screw_52": "disk_2 guide_5",
        "screw_53": "ring", "screw_53_down": "bearing_ring spacer_24 worm_wheel_23"},
    4: {"screw_59": "protective_ring shield_7 shield_8", "screw_59_down": "protective_ring"},
    10: {"screw_55": "platform"}, 12: {"bolt_42": "body", "screw_56": "disk_3 sleeve_17"},
}  # fmt: skip
HELD = {"cranks": "body_plate", "thesis": "central_wheel", "idlers": "post"}
ISO_273 = {4: 4.5, 8: 9.0, 10: 11.0, 12: 13.5}
# what turns in what, with the running play
RUNNING = {"guide_6": "body", "platform_axle": "disk_3 pinion sleeve_17"}
RUNNING_BY = {
    "cranks": {"crank_pin": "crank", "free_ring": "ring_guide"}, "thesis": {"satellite_axle": "satellite_wheel"},
    "idlers": {"idler_pin": "idler", "idler_pin_down": "idler", "platform_axle": "link", "post": "link",
               "satellite_axle": "link satellite_wheel"},
}  # fmt: skip
# cages run clear of both races by a twentieth of a ball; ring 10 stands in cover 12, and that in the guide's window
CLEAR = {("disk_2", "large_cage"): 0.4, ("spacer_22", "large_cage"): 0.4, ("disk_3", "small_cage"): 0.4,
         ("small_cage", "protective_ring"): 0.4, ("spacer_10", "cover_12"): 1.0}  # fmt: skip


@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_holes_are_as_wide_as_their_screws_axles_and_rings_ask_for(orientation: str) -> None:
    expected: dict[tuple[str, str], float] = {}

    def told(table: dict[str, str], play: float) -> None:
        expected.update({(inner, outer): play for inner, outers in table.items() for outer in outers.split()})

    for table in (TIGHT, TIGHT_BY[orientation]):
        told(table, 0.0)
    for table in (RUNNING, RUNNING_BY[orientation]):
        told(table, CLEARANCE)
    for diameter, passed in PASSED.items():
        told(passed, (ISO_273[diameter] - diameter) / 2)
    told({"screw_54": HELD[orientation]}, 0.5)
    expected |= CLEAR | ({("cover_12", "ring_guide"): 1.0} if orientation == "cranks" else {})
    found = contacts(orientation).fits
    assert set(found) == set(expected)
    assert {pair: [pytest.approx(play, abs=1e-6)] for pair, play in expected.items()} == {
        pair: sorted(plays) for pair, plays in found.items()
    }


# lower and upper part, how far apart planes stand that turn against each other or keep clear of heads
APART = {
    ("spacer_22", "worm_wheel_25"): 6.0, ("sleeve_17", "disk_2"): 5.5, ("disk_3", "shield_8"): 0.5,
    ("plug", "plug"): 0.2, ("body", "screw_53_down"): GAP, ("spacer_24", "guide_5"): 4.0,
    # disk 2 is 30 mm thick, guides end at twice a ball of 8
    ("guide_5", "shield_7"): 30.0 - 2 * 8.0,
}  # fmt: skip
APART_BY: dict[str, dict[tuple[str, str], float]] = {
    "cranks": {
        ("body_plate", "crank"): GAP, ("crank", "free_ring"): GAP, ("free_ring", "crank"): GAP,
        ("crank", "platform_plate"): GAP, ("ring_guide", "ring"): GAP,
        # collars leave a play of half a millimetre
        ("crank", "crank_pin"): 0.5, ("crank_pin", "crank"): 0.5, ("spacer_10", "pinion"): 1.0,
        ("platform_plate", "screw_51_down"): 2.0,
    },
    "thesis": {("platform_wheel", "screw_51_down"): 2.0, ("spacer_10", "pinion"): 1.0},
    "idlers": {
        ("link", "nut_47"): GAP, ("idler", "link"): 0.5, ("link", "idler"): 0.5, ("platform_wheel", "link"): 0.5,
    },
}  # fmt: skip


@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_what_turns_stands_clear_by_the_axial_gap(orientation: str) -> None:
    own = contacts(orientation)
    for (low, high), gap in (APART | APART_BY[orientation]).items():
        assert own.gap(low, high) == pytest.approx(gap, abs=1e-5), (low, high)


def grooves(part: str) -> list[tuple[complex, float]]:
    """Centres (r + i z) and radii of the arcs that bulge into the section of a turned part."""
    points: Any = scene_of("cranks").parts[part].points
    ends = list(zip(points, [*points[1:], points[0]], strict=True))
    turn = math.copysign(1.0, sum(a.r * b.z - a.z * b.r for a, b in ends))
    found = []
    for one, two in ends:
        if one.arc < 0:
            a, b = complex(one.r, one.z), complex(two.r, two.z)
            # on the side away from the material, which lies left of the points where they run counter-clockwise
            away = math.sqrt(one.arc**2 - abs(b - a) ** 2 / 4) * -1j * turn * (b - a) / abs(b - a)
            found.append(((a + b) / 2 + away, -one.arc))
    return found


# by part with a groove for balls: which row runs there, how far the groove is set out both ways of the ball, mm
RACES = {"disk_3": "small", "spacer_22": "large", "guide_6": "large", "guide_5": "large", "bearing_ring": "large"}


@pytest.mark.parametrize("part", RACES)
def test_a_ball_touches_its_grooves_in_one_point(part: str) -> None:
    """Their radius is 0.52 of a ball's diameter: so far the middle of the groove stands off that of the ball."""
    own = contacts("cranks")
    rows = {f"{RACES[part]}_ball_{k}_1" for k in (1, 2)}
    balls = [own.stands[key][1] + np.array([0, 0, 4.0]) for key in rows]
    for key in (key for key in own.keys if own.scene.instances[key].part == part):
        place = own.stands[key][1]
        middles = [complex(math.hypot(*(ball - place)[:2]), (ball - place)[2]) for ball in balls]
        offs = [min((middle - centre for middle in middles), key=abs) for centre, _ in grooves(part)]
        assert {radius for _, radius in grooves(part)} == {0.52 * 8.0}
        # both ends of a bearing ring are alike, and one of them is at the balls
        if part == "bearing_ring":
            assert offs[0].real == pytest.approx(offs[1].real)
            offs = [min(offs, key=abs)]
        for off in offs:
            assert abs(off) == pytest.approx(0.02 * 8.0, abs=1e-5)
            # a whole groove lies level with its ball, a quarter of one at 45 degrees
            slope = math.degrees(cmath.phase(off)) % 90
            quarter = part in ("bearing_ring", "guide_5")
            assert min(slope, 90 - slope) == pytest.approx(45.0 if quarter else 0.0, abs=1e-2)


def test_balls_of_disk_3_run_on_the_bore_of_disk_2_between_rings_33() -> None:
    own = contacts("cranks")
    scene: Any = own.scene
    arm = 72.0
    bore: Any = scene.parts["disk_2"].layers[-3].outlines[0]
    # the far end of the outline about the axis of disk 3
    reach = arm - min(p.x for p in bore.points)
    ball = own.stands["small_ball_1_1"][1]
    assert math.hypot(ball[0] - arm, ball[1]) + 4.0 == pytest.approx(reach, abs=1e-6)
    assert ball[2] + 8.0 == pytest.approx(own.stands["protective_ring_1"][1][2])
    rear = own.stands["protective_ring_2"][1][2] + scene.parts["protective_ring"].points[2].z
    assert own.stands["small_ball_2_1"][1][2] == pytest.approx(rear)
    counts = Counter(i.part for i in scene.instances.values())
    assert counts["ball"] == 180


@pytest.mark.parametrize("worm", [1, 2])
def test_a_worm_runs_between_its_cover_and_its_far_seat(worm: int) -> None:
    """Along its axis: ring 28 with a millimetre on both sides, the cover, the snap ring in the middle of its groove."""
    scene: Any = scene_of("cranks")
    own = contacts("cranks")
    side = 1 if worm == 1 else -1
    shaft = scene.parts["worm"]
    at = own.stands[f"worm_{worm}"][1]

    def along(name: str) -> float:
        place = own.stands[f"{name}_{worm}"][1]
        assert place[1:] == pytest.approx(at[1:])
        assert scene.instances[f"{name}_{worm}"].axis == pytest.approx((side, 0.0, 0.0))
        return float(side * (place - at)[0])

    journal, groove, collar, end = shaft.shaft_above
    starts = np.cumsum([shaft.thread_length / 2, *(step.length for step in shaft.shaft_above)])
    ring, cover, snap = (scene.parts[name].points for name in ("spacer_28", "end_cover", "snap_ring"))
    assert along("spacer_28") == pytest.approx(60.0 + 1.0)
    assert along("end_cover") - along("spacer_28") - ring[2].z == pytest.approx(1.0)
    assert along("snap_ring") - starts[1] == pytest.approx(0.1)
    assert starts[2] - along("snap_ring") - snap[2].z == pytest.approx(0.1)
    out = along("end_cover") + max(p.z for p in cover)
    assert starts[1] - out == pytest.approx(0.2)
    # turned by hand: 0.05 mm; the groove 1.5 mm deep
    assert [min(p.r for p in rows) - journal.diameter / 2 for rows in (ring, cover)] == pytest.approx([0.05, 0.05])
    assert min(p.r for p in snap) - groove.diameter / 2 == pytest.approx(0.05)
    assert (journal.diameter - groove.diameter) / 2 == pytest.approx(1.5)
    assert (journal.diameter, collar.diameter - end.diameter) == (collar.diameter, 8.0)
    assert (collar.length, end.length) == (5.0, 40.0)
    # both journals in what closes their seats: the far one ends 2 mm beyond a seat of 25 mm
    far = shaft.shaft_below[0]
    assert far.diameter == journal.diameter
    seat = max(p.r for p in cover[:3])
    body = solid_of(scene.parts["body"])
    place = own.stands["body"][1]

    def solid(x: float, y: float, z: float) -> bool:
        """Whether the housing has material there: along the worm, across it, upwards, about its axis."""
        point = at + np.array([side * x, y, z]) - place
        return bool(body.holds(point[None])[0])

    near, back = along("end_cover"), 60.0 + far.length - 2.0
    # the tunnels of the seats, square, as wide as the cover and as the journal, with walls of 8
    for low, high, half, roof in (
        (near, near + 30.0, seat, 4.0 if worm == 1 else 8.0),
        (back - 25.0, back, journal.diameter / 2 + 0.05, 8.0),
    ):
        sense = 1 if low == near else -1
        for x in (low + 1.2, high - 1.2):
            assert not solid(sense * x, 0.0, 0.0)
            assert [solid(sense * x, y, 0.0) for y in (half - 0.1, half + 0.1, half + 6.9)] == [False, True, True]
            assert [solid(sense * x, -y, 0.0) for y in (half - 0.1, half + 0.1, half + 6.9)] == [False, True, True]
            assert [solid(sense * x, 0.0, z) for z in (half - 0.1, half + 0.1, half + roof - 0.1)] == [
                False,
                True,
                True,
            ]
        assert not solid(sense * (low - 1.0), half + 4.0, 0.0)
        assert not solid(sense * (high + 0.5), half + 4.0, 0.0)
    # set screws stand on the cover from above, under it from below
    for k in (1, 2):
        screw = own.stands[f"set_screw_{worm}_{k}"][1]
        assert side * (screw - at)[0] - near == pytest.approx((6.0, 16.0)[k - 1])
        assert screw[1] == pytest.approx(at[1])
        tip = screw[2] - at[2]
        assert tip == pytest.approx(seat if worm == 1 else -seat - 12.0)
    # the wall is open where the worm comes in, 4 mm wider than the seat on every side
    wall = scene.parts["platform"]
    assert wall
    window = seat + 4.0
    half_wall = max(p[0] for p in scene.parts["body"].layers[1].polygons[0].points)
    assert not solid(half_wall - 6.0, window - 0.2, 0.0)
    assert solid(half_wall - 6.0, window + 0.2, 0.0)
    assert solid(half_wall - 6.0, -window - 0.2, 0.0)
    assert not solid(half_wall - 6.0, 0.0, window - 0.2)


def test_the_housing_is_a_box_with_a_flange_a_boss_and_a_lip() -> None:
    """Square: 12 mm of wall; a flange 40 mm wider on each side with eight holes, a boss under ring 18, a round lip."""
    scene: Any = scene_of("thesis")
    layers, low = scene.parts["body"].layers, Contacts(scene).stands["body"][1][2]
    levels = np.cumsum([low, *(layer.thickness for layer in layers)])
    halves = [max(max(abs(c) for p in poly.points for c in p) for poly in layer.polygons) for layer in layers]
    half = max(halves[1:])
    assert halves[0] == half + 40.0
    assert set(halves[1:]) <= {half, half - 1.0}
    assert layers[0].thickness == 30.0
    assert sorted((abs(c.at[0]), abs(c.at[1])) for c in layers[0].circles if c.diameter == 13.5) == sorted(
        (abs(x), abs(y)) for x in (-half - 20, 0, half + 20) for y in (-half - 20, 0, half + 20) if x or y
    )
    # in the boss a hole for the head of the screw under axle 13 and what of it turns
    boss = [k for k, layer in enumerate(layers) if any(c.diameter == 72.0 + 6 for c in layer.circles)]
    ring = Contacts(scene).stands["spacer_18"][1][2]
    assert levels[boss[-1] + 1] == pytest.approx(ring)
    assert boss[0] == 1
    for k in boss:
        assert sum(c.diameter == 8.0 for c in layers[k].circles) >= 6
    guide = scene.parts["guide_6"]
    lip = [k for k, layer in enumerate(layers) if any(c.diameter > 300 for c in layer.circles)]
    assert lip[-1] == len(layers) - 1
    opening = {c.diameter for k in lip for c in layers[k].circles if c.diameter > 300}
    assert opening == {2 * (max(p.r for p in guide.points[:2]) + 0.1)}
    # tapped 10 mm deep for the screws of guide 6, whose flange of 8 mm lies on it
    assert levels[-1] == pytest.approx(Contacts(scene).stands["guide_6"][1][2] + max(p.z for p in guide.points) - 8.0)
    tapped = [k for k in lip if sum(c.diameter == 8.0 for c in layers[k].circles) >= 20]
    assert levels[-1] - levels[tapped[0]] == pytest.approx(10.0)
    # the room within: a wall of 12 all round where nothing comes in
    squares = [[max(abs(c) for p in poly.points for c in p) for poly in layer.polygons[:2] if len(poly.points) == 4]
               for layer in layers[1:]]  # fmt: skip
    assert {tuple(both) for both in squares if both[:1] == [half] and len(both) == 2} == {(half, half - 12.0)}
