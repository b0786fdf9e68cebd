"""Keys that several kinds share: what closes a motion, where marks and digits have room, boards, in closed form."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely

from geometry.base.errors import ParameterError
from geometry.kinematics.linkage import RockerDrive, RockerGuide, SliderDrive, SliderGuide
from parts.cams.wheel import marked_holes
from parts.keys.engraving import ToothMarkTable, tooth_mark
from parts.keys.helix import common_face, helix_of, helix_quantities, same_helix
from parts.keys.linkage import DrivenRocker, DrivenSlider, GuidingRocker, GuidingSlider, drive_of, guide_of
from parts.keys.mate import further
from parts.keys.working import told_sizes
from parts.keys.worm import quotient_of, worm_of
from parts.scene.load import make_parts, scene_from_dict
from tests.offered import GONE, PHASES, Raw, cam, scenes
from tests.parts.limits import check_limit, check_refused, refused, scene_of, with_key

ROLLER = cam(bore_diameter=10.0)
PLACE = "parts.p.phases"


def phases(*rows: tuple[Any, ...]) -> Raw:
    """A cam by rows of move, angle and share; laws where they move."""
    made = [{"move": m, "angle_deg": a, "share": s} | ({} if m == "dwell" else {"law": "sine"}) for m, a, s in rows]
    return scene_of(ROLLER | {"phases": made})


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("angles", "blamed", "fits"),
    [
        # the last phase makes up for what is too little or too much, where anything is left of it
        ((120.0, 60.0, 120.0, 40.0), 4, 60.0),
        ((120.0, 60.0, 120.0, 70.0), 4, 60.0),
        ((120.0, 60.0, 200.0, 60.0), 3, 120.0),
        ((200.0, 60.0, 120.0, 60.0), 3, 40.0),
        # one that is more than four times shorter than that was mistyped
        ((120.0, 6.0, 120.0, 60.0), 2, 60.0),
        ((120.0, 14.0, 120.0, 57.0), 2, 63.0),
        ((120.0, 15.0, 120.0, 60.0), 4, 105.0),
        # too much of it: a short phase is none to blame
        ((160.0, 60.0, 170.0, 2.0), 3, 138.0),
        # by so little that six digits show 360
        ((120.0, 60.0, 120.0, 59.99999), 4, 60.0),
    ],
)
def test_angles_that_are_no_turn_are_told_what_fits(angles: tuple[float, ...], blamed: int, fits: float) -> None:
    moves = ("rise", "dwell", "return_", "dwell")
    raw = phases(*((move, angle, 1.0) for move, angle in zip(moves, angles, strict=True)))
    refusal = refused(raw)
    assert refusal is not None
    key = f"{PLACE}[{blamed}].angle_deg"
    assert (refusal.key, refusal.code, refusal.value) == (key, "phases_not_a_turn", angles[blamed - 1])
    assert refusal.numbers["whole"] == pytest.approx(sum(angles))
    assert refusal.numbers["off"] == pytest.approx(abs(sum(angles) - 360), abs=1e-9)
    assert refusal.nearest is not None
    assert (refusal.nearest.value, refusal.nearest.side) == (pytest.approx(fits, abs=1e-9), "exactly")
    assert refused(with_key(raw, key, refusal.nearest.value)) is None


def test_angles_close_within_a_rounding_and_no_single_one_makes_up_for_turns() -> None:
    assert refused(phases(("rise", 180.0, 1.0), ("return_", 180.0 + 4e-8, 1.0))) is None
    assert refused(phases(("rise", 180.0, 1.0), ("return_", 180.0 - 4e-8, 1.0))) is None
    assert refused(phases(("rise", 180.0, 1.0), ("return_", 180.0 + 6e-8, 1.0))) is not None
    many = refused(phases(*([("rise", 100.0, 0.25), ("return_", 100.0, 0.25)] * 4)))
    assert many is not None
    assert (many.key, many.value, many.numbers["whole"]) == (f"{PLACE}[1].angle_deg", 100.0, 800.0)
    assert many.nearest is None


@pytest.mark.parametrize(
    ("rows", "key", "value", "works"),
    [
        # the last one whose share can make up for the rest
        ((("rise", 120.0, 1.0), ("dwell", 60.0, 1.0), ("return_", 180.0, 0.4)), "[3].share", 0.4, 1.0),
        ((("rise", 120.0, 0.5), ("rise", 60.0, 0.25), ("return_", 180.0, 1.0)), "[3].share", 1.0, 0.75),
        ((("rise", 120.0, 0.25), ("return_", 180.0, 1.0), ("rise", 60.0, 0.25)), "[3].share", 0.25, 0.75),
        ((("rise", 180.0, 1.0), ("return_", 90.0, 1.0), ("return_", 90.0, 1.0)), "[1].share", 1.0, ...),
        # a dwell could be a return; of moves of one way the last one has to go back
        ((("rise", 180.0, 1.0), ("dwell", 180.0, 1.0)), "[2].move", "dwell", ...),
        ((("rise", 180.0, 1.0), ("rise", 180.0, 1.0)), "[2].move", "rise", "return"),
        ((("return_", 180.0, 1.0), ("return_", 180.0, 1.0)), "[2].move", "return_", "rise"),
        ((("return", 180.0, 1.0), ("return_", 180.0, 1.0)), "[2].move", "return_", "rise"),
        ((("rise", 120.0, 0.5), ("rise", 60.0, 0.25), ("return", 180.0, 1.0)), "[3].share", 1.0, 0.75),
    ],
)
def test_a_motion_that_does_not_come_back_is_told_what_makes_it(
    rows: tuple[tuple[Any, ...], ...], key: str, value: object, works: object
) -> None:
    raw = phases(*rows)
    refusal = refused(raw)
    assert refusal is not None
    if key == "[1].share":
        # neither of two returns alone; both shares would have to change
        assert refusal.code == "does_not_come_back"
        assert refusal.key in (f"{PLACE}[2].move", f"{PLACE}[3].move")
        return
    assert (refusal.key, refusal.code, refusal.value) == (PLACE + key, "does_not_come_back", value)
    if works is ...:
        assert refusal.nearest is None
        return
    assert refusal.nearest is not None
    assert refusal.nearest.value == works
    assert refused(with_key(raw, PLACE + key, works)) is None


TABLE = [[0.0, 0.0], [60.0, 4.0], [120.0, 10.0], [200.0, 8.0], [300.0, 1.0]]
DWELL = f"{PLACE}[2]"
LAWS: list[tuple[Raw, dict[str, Any], str, str, object]] = [
    # a dwell has neither law nor share, of both it is no dwell
    (scene_of(ROLLER), {f"{DWELL}.law": "sine"}, f"{DWELL}.law", "dwell_with_law", None),
    (scene_of(ROLLER), {f"{DWELL}.share": 0.5}, f"{DWELL}.share", "dwell_with_law", 1.0),
    (scene_of(ROLLER), {f"{DWELL}.share": 0.5, f"{DWELL}.law": "sine"}, f"{DWELL}.move", "dwell_with_law", ...),
    (scene_of(ROLLER), {f"{PLACE}[1].law": GONE}, f"{PLACE}[1].law", "law_missing", "sine"),
    (scene_of(ROLLER), {"parts.p.motion_table": TABLE}, "parts.p.phases", "phases_or_table", ...),
    (scene_of(ROLLER), {"parts.p.motion_table": TABLE, "parts.p.lift": GONE}, "parts.p.phases", "phases_or_table",
     None),
    (scene_of(ROLLER), {"parts.p.motion_table": TABLE, "parts.p.phases": GONE}, "parts.p.lift", "lift_in_table", 0.0),
    (scene_of(ROLLER), {"parts.p.phases": GONE}, "parts.p.phases", "phases_or_table", ...),
    (scene_of(ROLLER), {"parts.p.lift": GONE}, "parts.p.lift", "no_lift", ...),
    # the stroke of the other kind of follower: left out where its own is there
    (scene_of(ROLLER), {"parts.p.swing_deg": 10.0}, "parts.p.swing_deg", "swing_without_arm", 0.0),
    (scene_of(ROLLER), {"parts.p.swing_deg": 10.0, "parts.p.lift": GONE}, "parts.p.swing_deg", "swing_without_arm",
     ...),
    (scenes()["swinging roller"], {"parts.p.lift": 10.0}, "parts.p.lift", "stroke_of_another", 0.0),
    (scenes()["swinging roller"], {"parts.p.lift": 10.0, "parts.p.swing_deg": GONE}, "parts.p.lift",
     "stroke_of_another", ...),
]  # fmt: skip


@pytest.mark.parametrize(("raw", "changes", "key", "code", "works"), LAWS)
def test_keys_of_a_motion_that_do_not_go_together_are_told(
    raw: Raw, changes: dict[str, Any], key: str, code: str, works: object
) -> None:
    for place, value in changes.items():
        raw = with_key(raw, place, value)
    refusal = refused(raw)
    assert refusal is not None
    assert (refusal.key, refusal.code) == (key, code)
    if works is ...:
        assert refusal.nearest is None
        return
    assert refusal.nearest is not None
    assert refusal.nearest.value == works
    assert refused(with_key(raw, key, GONE if works is None else works)) is None


def test_rows_of_a_table_are_refused_in_the_unit_of_their_lift() -> None:
    """Degrees of a swing, as they were typed."""
    swinging = with_key(scenes()["swinging roller"], "parts.p.phases", GONE)
    swinging = with_key(swinging, "parts.p.swing_deg", GONE)
    table = [[0.0, 2.0], [60.0, 4.0], [120.0, 9.0], [200.0, 8.0], [360.0, 3.0]]
    refusal = refused(with_key(swinging, "parts.p.motion_table", table))
    assert refusal is not None
    assert (refusal.key, refusal.code) == ("parts.p.motion_table[5][2]", "last_row_not_as_first")
    assert refusal.value == pytest.approx(3.0, rel=1e-12)
    assert refusal.nearest is not None
    assert refusal.nearest.value == pytest.approx(2.0, rel=1e-12)


# a cam of base circle 40 about a bore of 10: a mark stands best halfway, its rim half a tenth off either
MARKED = scene_of(ROLLER | {"timing_mark": {"diameter": 3.0}})
WALL = 0.05


def test_a_mark_has_room_between_bore_and_base_circle() -> None:
    made = make_parts(scene_from_dict(MARKED, "s", "s"), "s")[0]["p"]
    (mark,) = marked_holes(made.keys, made.thing).round_holes
    assert (mark.count, mark.diameter) == (1, 3.0)
    assert mark.pitch_circle_diameter == pytest.approx(45.0, abs=1e-9)
    # the roller's centre stands over the axis at cam angle 0
    assert mark.start == pytest.approx(math.pi / 2)
    check_limit(MARKED, "parts.p.timing_mark.diameter", "no_room_for_mark", 2 * (17.5 - WALL), "at_most", near=1e-5)
    placed = with_key(MARKED, "parts.p.timing_mark.distance", 20.0)
    check_limit(placed, "parts.p.timing_mark.distance", "mark_meets_hole", 40 - 1.5 - WALL, "at_most", near=1e-3)
    check_limit(placed, "parts.p.timing_mark.distance", "mark_meets_hole", 5 + 1.5 + WALL, "at_least", near=1e-3)
    wide = refused(with_key(placed, "parts.p.timing_mark.diameter", 36.0))
    assert wide is not None
    assert (wide.key, wide.code) == ("parts.p.timing_mark.diameter", "no_room_for_mark")
    assert wide.nearest is not None
    assert wide.nearest.value == pytest.approx(2 * (15 - WALL), abs=1e-4)
    beyond = refused(with_key(with_key(placed, "parts.p.timing_mark.diameter", 36.0),
                              "parts.p.timing_mark.distance", 40.0))  # fmt: skip
    assert beyond is not None
    assert (beyond.code, beyond.nearest) == ("no_room_for_mark", None)


def boxes(number: int, room: tuple[float, float], *, inside: bool, height: float | None) -> tuple[Any, Any]:
    """What is engraved: the mark, and the digits, as polygons."""
    made = tooth_mark(ToothMarkTable(0.4, height), number, room, 4.0, inside=inside)
    assert all(depth == 0.4 for _, depth in made)
    shapes = []
    for profile, _ in made:
        points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 65)) for s in profile.segments()])
        shapes.append(shapely.Polygon(np.column_stack((points.real, points.imag))))
    return shapes[0], shapely.union_all(shapes[1:])


@pytest.mark.parametrize("inside", [False, True])
@pytest.mark.parametrize(("number", "room"), [(88, (10.0, 40.0)), (8, (5.0, 15.0)), (8_888, (30.0, 60.0))])
def test_a_mark_stands_at_the_teeth_and_the_digits_beside_it(
    number: int, room: tuple[float, float], inside: bool
) -> None:
    """0.08 of the room at both ends and between, 0.3 for the mark; its width is an eighth of the digits' height.

    The digit 8 fills its box: the height, and a stroke of 0.13 of it.
    """
    low, high = room
    wide = high - low
    clear, length = 0.08 * wide, 0.3 * wide
    mark, digits = boxes(number, room, inside=inside, height=None)
    left, bottom, right, top = mark.bounds
    start = low + clear if inside else high - clear - length
    assert (left, right) == (pytest.approx(start, abs=1e-9), pytest.approx(start + length, abs=1e-9))
    assert top == pytest.approx(-bottom)
    height = (top - bottom) * 8
    assert height <= min(wide, 8.0) + 1e-9
    near, under, far, over = digits.bounds
    assert over == pytest.approx(-under, abs=1e-6)
    assert far - near == pytest.approx(height * 1.13, rel=1e-6)
    between = near - right if inside else left - far
    assert between == pytest.approx(clear, rel=1e-6)
    # all of it stays the clear width within the room
    assert abs(complex(far, over)) <= high - clear + 1e-9 or inside
    assert (near if not inside else left) >= low + clear - 1e-9 or inside
    # the next larger size, a ninth more, would not
    if height < min(wide, 8.0) - 1e-9:
        with pytest.raises(ParameterError) as caught:
            boxes(number, room, inside=inside, height=height / 0.9)
        assert caught.value.code == "no_room_for_digits"
        most = caught.value.nearest
        assert most is not None
        assert height <= float(str(most.value)) < height / 0.9
        boxes(number, room, inside=inside, height=float(str(most.value)))
        with pytest.raises(ParameterError):
            boxes(number, room, inside=inside, height=float(str(most.value)) * 1.001)


def test_what_is_engraved_leaves_half_of_the_thickness_and_needs_room() -> None:
    assert tooth_mark(None, 23, (10.0, 40.0), 4.0) == ()
    tooth_mark(ToothMarkTable(2.0), 23, (10.0, 40.0), 4.0)
    for table, room, code, works in ((ToothMarkTable(2.01), (10.0, 40.0), "engraved_too_deep", 2.0),
                                     (ToothMarkTable(0.4), (10.0, 10.0), "no_room_for_digits", None),
                                     # it would be less than a tenth of a millimetre high: its file failed its check
                                     (ToothMarkTable(0.4), (10.0, 10.001), "no_room_for_digits", None)):  # fmt: skip
        with pytest.raises(ParameterError) as caught:
            tooth_mark(table, 23, room, 4.0)
        assert (caught.value.name, caught.value.code, caught.value.value) == ("tooth_mark.depth", code, table.depth)
        assert caught.value.nearest is not None
        assert caught.value.nearest.value == works


def test_a_linkage_stands_as_its_keys_say() -> None:
    """Directions in rad, the sense of a clockwise rocker -1, the side of an assembly to the left or ahead +1."""
    assert drive_of(DrivenRocker((1.0, 2.0), 5.0, 30.0)) == RockerDrive(1 + 2j, 5.0, math.radians(30.0), -1)
    assert drive_of(DrivenRocker((1.0, 2.0), 5.0, 30.0, "counter_clockwise")) == RockerDrive(
        1 + 2j, 5.0, math.radians(30.0), 1
    )
    assert drive_of(DrivenSlider((3.0, 4.0))) == SliderDrive(3 + 4j, math.pi / 2)
    assert drive_of(DrivenSlider((3.0, 4.0), 30.0)) == SliderDrive(3 + 4j, math.radians(30.0))
    assert guide_of(GuidingRocker((1.0, 2.0), 5.0)) == RockerGuide(1 + 2j, 5.0, 1)
    assert guide_of(GuidingRocker((1.0, 2.0), 5.0, "right")) == RockerGuide(1 + 2j, 5.0, -1)
    assert guide_of(GuidingSlider((1.0, 2.0))) == SliderGuide(1 + 2j, 0.0, 1)
    assert guide_of(GuidingSlider((1.0, 2.0), 45.0, "backward")) == SliderGuide(1 + 2j, math.radians(45.0), -1)


GEAR: dict[str, Any] = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 10.0}


def keys_of(part: dict[str, Any]) -> Any:
    return make_parts(scene_from_dict(scene_of(part), "s", "s"), "s")[0]["p"].keys


def test_a_helix_of_keys_has_its_hand_and_its_lead() -> None:
    """A negative angle turns the hand; the lead of a screw is 2 pi r / tan(beta)."""
    hands = [helix_of(keys_of(GEAR | {"helix_angle_deg": angle, "hand": hand})).hand
             for angle in (20.0, -20.0) for hand in ("right", "left")]  # fmt: skip
    assert hands == ["right", "left", "left", "right"]
    plain, helical = keys_of(GEAR), keys_of(GEAR | {"helix_angle_deg": -20.0, "face_width": 14.0})
    assert helix_of(helical).angle == pytest.approx(math.radians(20.0))
    assert helix_of(keys_of({"kind": "pin", "diameter": 8.0, "length": 9.0})).angle == 0.0
    assert helix_quantities(plain, 20.0) == {}
    told = helix_quantities(helical, 20.0)
    assert told == {"normal_pitch": pytest.approx(2 * math.pi),
                    "lead": pytest.approx(2 * math.pi * 20 / math.tan(math.radians(20)))}  # fmt: skip
    face = common_face(helical, plain)
    assert (face.width, face.helix.angle) == (10.0, pytest.approx(math.radians(20.0)))
    assert common_face(plain, helical).helix.angle == 0.0
    with pytest.raises(ParameterError) as caught:
        same_helix(helical, plain)
    assert (caught.value.name, caught.value.value, caught.value.code) == ("helix_angle_deg", 0.0, "not_that_of_first")
    assert caught.value.nearest is not None
    assert caught.value.nearest.value == -20.0
    assert same_helix(helical, keys_of(GEAR | {"helix_angle_deg": 20.0})) == pytest.approx(math.radians(20.0))


def test_a_double_helix_has_an_angle_and_a_tip_one_kind_of_corner() -> None:
    check_refused(scene_of(GEAR), "parts.p.double_helical", True, "double_helical_without_angle", False)
    corner = scene_of(GEAR | {"tip_chamfer": 0.2})
    check_refused(corner, "parts.p.tip_rounding", 0.2, "either_key", 0.0)


@pytest.mark.parametrize("kind", ["spur_gear", "ring_gear", "rack"])
@pytest.mark.parametrize("angle", [1e-9, -3e-7])
def test_a_helix_that_no_file_tells_is_refused(kind: str, angle: float) -> None:
    """Walls that stand upright to the last digit of an STL failed their read-back as screws."""
    keys = GEAR | {"kind": kind, "number_of_teeth": 60, "helix_angle_deg": angle}
    check_refused(scene_of(keys), "parts.p.helix_angle_deg", angle, "helix_not_told", 0.0)


WORM: dict[str, Any] = {"kind": "worm", "module": 4.0, "thread_length": 50.0}


def test_a_worm_is_as_thick_as_its_quotient_or_its_lead_says() -> None:
    """tan(gamma) = z1 / q; 10 where neither is given."""
    assert quotient_of(keys_of(WORM)) == 10.0
    assert quotient_of(keys_of(WORM | {"diameter_quotient": 12.5})) == 12.5
    led = WORM | {"lead_angle_deg": 10.0, "number_of_starts": 2}
    wanted = 2 / math.tan(math.radians(10.0))
    assert quotient_of(keys_of(led)) == pytest.approx(wanted, rel=1e-12)
    # both where they agree
    assert refused(scene_of(led | {"diameter_quotient": wanted * (1 + 0.9e-9)})) is None
    check_refused(scene_of(led), "parts.p.diameter_quotient", wanted * (1 + 2e-9), "either_key", None,
                  one="lead_angle_deg", other="diameter_quotient")  # fmt: skip
    worm = worm_of(keys_of(WORM | {"hand": "left", "pressure_angle_deg": 25.0}), 0.3, 0.1)
    assert (worm.reference_radius, worm.tip_radius, worm.root_radius) == (20.0, 24.0, pytest.approx(15.2))
    assert (worm.hand, worm.pressure_angle) == ("left", pytest.approx(math.radians(25.0)))
    assert (worm.fillet_coefficient, worm.thinning) == (0.3, 0.1)


def test_a_thread_of_more_pitches_than_memory_holds_is_refused() -> None:
    """Of module 1e-6 mm and 40 mm, 13 million pitches filled 15 GB before anything was told."""
    check_limit(scene_of(WORM | {"module": 0.1}), "parts.p.thread_length", "worm_thread_too_long",
                1000 * math.pi * 0.1, "at_most", near=1e-4)  # fmt: skip


def test_directions_go_on_by_steps_and_stay_what_they_are_within_a_turn() -> None:
    for start, angle, wanted in ((10.0, 20.0, 30.0), (350.0, 10.0, 360.0), (350.0, 20.0, 10.0), (-350.0, -20.0, -10.0),
                                 (-10.0, -350.0, -360.0), (0.0, 725.0, 5.0)):  # fmt: skip
        assert further(start, angle) == pytest.approx(wanted)


@pytest.mark.parametrize(
    ("zone", "told"),
    [
        # ISO 286-1, tables 2 to 5: from which size to which a fundamental deviation is told, mm
        ("H7", (0.0, math.inf)), ("h11", (0.0, math.inf)), ("JS9", (0.0, math.inf)), ("C11", (0.0, 500.0)),
        ("j6", (0.0, 500.0)), ("X7", (0.0, 500.0)), ("zc8", (0.0, 500.0)), ("CD8", (0.0, 10.0)), ("ef9", (0.0, 10.0)),
        ("FG7", (0.0, 10.0)), ("A11", (1.0, 500.0)), ("b11", (1.0, 500.0)), ("T6", (24.0, 3150.0)),
        ("v7", (14.0, 500.0)), ("Y7", (18.0, 500.0)),
    ],
)  # fmt: skip
def test_a_tolerance_zone_is_told_for_its_sizes(zone: str, told: tuple[float, float]) -> None:
    assert told_sizes(zone) == told


BOARD: Raw = scene_of(GEAR) | {
    "boards": {"b": {"width": 300.0, "height": 200.0, "thickness": 3.0}}, "beds": {"d": {"width": 220.0, "depth": 180.0,
                                                                                        "height": 250.0}}}  # fmt: skip


@pytest.mark.parametrize(
    ("key", "value", "code", "numbers"),
    [
        # margins on both sides of the shorter side leave something, a gap is shorter than it
        ("boards.b.margin", 100.0, "margins_leave_nothing", {"side": 200.0}),
        ("beds.d.margin", 90.0, "margins_leave_nothing", {"side": 180.0}),
        ("boards.b.gap", 200.0, "gap_above_board", {"side": 200.0}),
        ("boards.b.parts", ["q"], "no_such_part", {"known": ["p"]}),
        ("boards.b.parts", ["p", "p"], "listed_twice", {}),
        ("boards.b.copies", {"q": 2}, "no_such_part", {"known": ["p"]}),
    ],
)
def test_a_board_has_room_and_parts_that_are_there(key: str, value: Any, code: str, numbers: dict[str, object]) -> None:
    refusal = refused(with_key(BOARD, key, value))
    assert refusal is not None
    assert (refusal.key, refusal.code) == (key, code)
    told = value if isinstance(value, float) else next(iter(value))
    assert (refusal.value, refusal.numbers) == (told, numbers)
    if isinstance(value, float):
        assert refused(with_key(BOARD, key, value - 1e-3)) is None


def test_a_speed_of_engraving_needs_that_of_the_cut() -> None:
    refusal = refused(with_key(BOARD, "boards.b.engraving_feed", 90.0))
    assert refusal is not None
    assert (refusal.key, refusal.code, refusal.numbers) == ("boards.b.engraving_feed", "needs_other", {"other": "feed"})
    assert refused(with_key(with_key(BOARD, "boards.b.feed", 9.0), "boards.b.engraving_feed", 90.0)) is None


def test_the_phases_to_start_from_are_a_turn() -> None:
    assert sum(phase["angle_deg"] for phase in PHASES) == 360.0
    assert refused(scene_of(ROLLER)) is None
