"""What sections show: hidden bores where they are, edges behind an end cam's track, holes once and without hatching."""

from __future__ import annotations

import cmath
import math
from importlib import import_module
from typing import Any

import numpy as np
import pytest

from geometry.base.placement import Placement3
from geometry.curves.line_arc import Line
from parts.drawing.assembly_views import Shown, cut, seen
from parts.drawing.dimensioning import laid
from parts.drawing.hatching import hatching
from parts.drawing.working import HIDDEN, VISIBLE, PartDrawing, Subject, View
from parts.keys.working import WorkingTable
from parts.scene.load import make_parts, scene_from_dict

WAVE = [{"move": "rise", "angle_deg": 180.0, "law": "sine"}, {"move": "return_", "angle_deg": 180.0, "law": "sine"}]
# a view along y
SIDE = Placement3(((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)))


def drawing_of(keys: dict[str, Any], **wishes: Any) -> PartDrawing:
    parts, _ = make_parts(scene_from_dict({"parts": {"p": keys}, "exports": [{"format": "svg"}]}, "t", "t"), "t")
    made = import_module(str(parts["p"].made_by.drawing)).part_drawing(
        Subject(parts["p"], WorkingTable(**wishes), "en")
    )
    assert isinstance(made, PartDrawing)
    return made


def levels(view: View, layer: str) -> set[float]:
    """Heights of lines along the axis."""
    ends = [curve.point(np.array(curve.domain)) for name, curve in view.strokes if name == layer]
    return {round(float(a.imag), 6) for a, b in ends if abs(a.imag - b.imag) < 1e-9 < abs(a.real - b.real)}


def test_hidden_lines_of_a_keyed_worm_stand_where_its_bore_is() -> None:
    """DIN 6885: the key of a bore of 12 is 4 wide, its way 1.8 deep; before, the keyway lay on both sides."""
    keyed = {"kind": "worm", "module": 4.0, "thread_length": 50.0, "bore": {"shape": "keyway", "diameter": 12.0}}
    assert levels(drawing_of(keyed).views[0], HIDDEN) == {-6.0, 7.8, round(math.sqrt(6**2 - 2**2), 6)}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("hub", [None, {"diameter": 30.0, "above": 8.0, "below": 4.0}])
def test_the_section_of_an_end_cam_has_the_edges_behind_it(hub: dict[str, float] | None) -> None:
    """Mouths of the bore, and both edges of the track, from which the roller's axis is never nearer than its radius."""
    lift, start, radius = 18.0, 10.0, 5.0
    made = {"kind": "barrel_cam", "form": "end", "outer_diameter": 70.0, "groove_depth": 10.0, "lift": lift,
            "roller_diameter": 2 * radius, "web_thickness": 4.0, "bore_diameter": 12.0, "phases": WAVE,
            **({"hub": hub} if hub else {})}  # fmt: skip
    view = drawing_of(made).views[0]
    ends = [(curve, curve.point(np.linspace(*curve.domain, 9))) for _, curve in view.strokes]
    mouths = {round(float(p[0].real), 6) for _, p in ends if np.ptp(p.real) < 1e-9 and np.abs(p.imag).min() < 1e-9}
    assert mouths == ({-4.0, 12.0} if hub else {0.0, 4.0})
    phi = np.linspace(0, 2 * math.pi, 3601)
    part = phi % math.pi / math.pi
    wave = part - np.sin(2 * math.pi * part) / (2 * math.pi)
    axis = start + lift * np.where(phi < math.pi, wave, 1 - wave)
    seen = 0
    for curve, points in ends:
        if type(curve).__name__ != "_TrackEdge":
            continue
        reach = curve.radius  # type: ignore[attr-defined]
        for point in points:
            polar = -math.acos(point.imag / reach)
            y, ahead = reach * np.sin(polar + phi), np.cos(polar + phi) > 0
            assert np.hypot(y, axis - point.real)[ahead].min() == pytest.approx(radius, abs=1e-3)
            # nothing is drawn over the hub that stands before it
            assert not hub or abs(point.imag) > 15 - 1e-3 or point.real > 12 - 1e-3
        seen += 1
    assert seen >= 2


RING = {"kind": "turned", "points": [{"r": 5.0, "z": 0.0}, {"r": 31.0, "z": 0.0}, {"r": 31.0, "z": 16.0},
                                     {"r": 5.0, "z": 16.0}]}  # fmt: skip
GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 40, "face_width": 16.0, "bore_diameter": 10.0}


@pytest.mark.parametrize("part", [RING, GEAR], ids=["turned", "gear"])
@pytest.mark.parametrize(("count", "start"), [(1, 90.0), (1, -90.0), (3, 90.0)])
def test_a_hole_alone_is_shown_once_and_no_hole_is_hatched(part: dict[str, Any], count: int, start: float) -> None:
    """One that stands off the axis alone was drawn in both halves; those of turned parts were hatched."""
    holes = {"count": count, "diameter": 6.0, "pitch_circle_diameter": 40.0, "start_deg": start}
    view = drawing_of(part | {"holes": holes}).views[0]
    sides = (1,) if count == 1 and start > 0 else (-1,) if count == 1 else (1, -1)
    walls = {level for level in levels(view, VISIBLE) if 16 < abs(level) < 24}
    assert walls == {way * level for way in sides for level in (17.0, 23.0)}
    assert {axis.start.imag for axis in view.axes} >= {way * 20.0 for way in sides}
    lines = [line.point(np.linspace(*line.domain, 65)) for line in hatching(view.hatched, 1.0)]
    inside = [p for points in lines for p in points if min(abs(p.imag - way * 20.0) for way in sides) < 2.99]
    assert lines
    assert inside == []
    (told,) = (size for size in view.sizes if "holes" in size.name)
    assert (told.value, told.before) == ((20.0, "") if count == 1 else (40.0, "Ø"))


@pytest.mark.parametrize("kind", ["groove", "wedge"])
def test_working_surfaces_of_cams_have_their_own_roughness(kind: str) -> None:
    groove = {"kind": "groove_cam", "follower_radius": 8.0, "base_circle_radius": 40.0, "lift": 20.0, "phases": WAVE,
              "face_width": 12.0, "groove_depth": 6.0, "outer_diameter": 160.0}  # fmt: skip
    wedge = {"kind": "wedge_cam", "follower": "roller", "follower_radius": 8.0, "base_height": 15.0, "lift": 20.0,
             "phases": [{"move": "rise", "travel": 60.0, "law": "sine"}]}  # fmt: skip
    views = drawing_of(groove if kind == "groove" else wedge, flank_roughness=0.8).views
    assert "Ra 0.8" in {note.text for note in views[0].notes if note.is_rough}


def square(side: float) -> dict[str, Any]:
    return {"points": [[-side, -side], [side, -side], [side, side], [-side, side]]}


def test_behind_the_section_of_layers_stands_what_is_seen_there() -> None:
    """A floor, four posts and one in the middle, a lid with a hole, through which nothing hides the post's wall."""
    posts = [{"diameter": 8.0, "at": [x, y]} for x in (-12.0, 12.0) for y in (-12.0, 12.0)]
    floor, lid = {"thickness": 6.0, "polygons": [square(20.0)]}, {"thickness": 4.0, "polygons": [square(20.0)]}
    layers = [
        floor,
        {"thickness": 20.0, "circles": [*posts, {"diameter": 4.0}]},
        lid | {"circles": [{"diameter": 3.0}]},
    ]
    view, *plans = drawing_of({"kind": "layered", "layers": layers}).views
    assert levels(view, VISIBLE) == {way * y for way in (1, -1) for y in (20.0, 16.0, 8.0, 2.0, 1.5)}
    ends = [curve.point(np.array(curve.domain)) for _, curve in view.strokes]
    faces = {(round(float(a.real), 6), *sorted((round(float(a.imag), 6), round(float(b.imag), 6))))
             for a, b in ends if abs(a.real - b.real) < 1e-9}  # fmt: skip
    # the lid's upper face beyond its hole; the floor's beside the post, which is cut: nothing is drawn across that
    assert faces >= {(0.0, -20.0, 20.0), (30.0, -20.0, 20.0), (6.0, 2.0, 20.0), (6.0, -20.0, -2.0)}
    # the lid's lower face beside the post, whose own end stands under the hole: between, both are one
    assert {(26.0, -20.0, -2.0), (26.0, -1.5, 1.5), (26.0, 2.0, 20.0)} == {face for face in faces if face[0] == 26.0}
    assert [plan.title for plan in plans] == ["B-B", "C-C", "D-D"]
    # of a layer of which nothing is new there is no other section
    again = drawing_of({"kind": "layered", "layers": [floor, layers[1], floor]}).views
    assert [plan.title for plan in again] == ["A-A", "B-B", "C-C"]
    assert [cut.letter for cut in again[0].cuts] == ["B", "C", "B"]


def test_what_stands_in_equal_steps_is_told_once_with_its_circle() -> None:
    """A slot on both sides of each ball; holes about another axis, one of twelve left out; a square by its places."""
    radius, about = 50.0, 10.0
    slots = [
        {"start": [radius * math.cos(a + s * 0.05), radius * math.sin(a + s * 0.05)],
         "end": [radius * math.cos(a + s * 0.15), radius * math.sin(a + s * 0.15)], "width": 1.0}
        for a in np.arange(9) * math.radians(40) for s in (-1, 1)
    ]  # fmt: skip
    ring = {"thickness": 5.0, "circles": [{"diameter": 102.0}, {"diameter": 98.0}]}
    cage = {"kind": "layered", "layers": [ring, {"thickness": 5.0, "slots": slots}]}
    posts = drawing_of(cage).views[2]
    told = sorted(size.value for size in posts.sizes)
    assert told == pytest.approx([2 * radius * math.sin(0.05), 2 * radius * math.sin(0.15)], abs=1e-9)
    assert {(one.before, round(one.value, 9), one.places) for one in posts.rounds} == {
        ("Ø", 2 * radius, " (step 360°/9)"), ("R", 0.5, " (36 places)")}  # fmt: skip
    turns = [math.radians(30 * k) for k in range(1, 12)]
    holes: list[dict[str, Any]] = [{"diameter": 4.0, "at": [about + 30 * math.cos(a), 30 * math.sin(a)]} for a in turns]
    square = [{"diameter": 6.0, "at": [x, y]} for x in (-55.0, 55.0) for y in (-55.0, 55.0)]
    outer = [{"diameter": 180.0}, {"diameter": 40.0, "at": [about, 0.0]}]
    plate = drawing_of({"kind": "layered", "layers": [{"thickness": 5.0, "circles": [*outer, *holes, *square]}]})
    assert sorted(size.value for size in plate.views[0].sizes) == pytest.approx([about, 15.0, 110.0, 110.0])
    assert (60.0, " (step 360°/12)") in {(round(one.value, 9), one.places) for one in plate.views[0].rounds}
    # a hole beside its step is told by its places
    holes[4]["at"][0] += 0.01
    moved = drawing_of({"kind": "layered", "layers": [{"thickness": 5.0, "circles": [*outer, *holes, *square]}]})
    assert 30 * math.cos(math.radians(30)) - 10.01 == pytest.approx(min(
        (size.value for size in moved.views[0].sizes), key=lambda value: abs(value - 15.97)))  # fmt: skip


@pytest.mark.parametrize("turn", [0.0, 30.0])
def test_a_hexagon_is_told_by_its_width_across_flats(turn: float) -> None:
    corners = [13 / math.sqrt(3) * complex(np.exp(1j * math.radians(turn + 60 * k))) for k in range(6)]
    nut: dict[str, Any] = {"thickness": 5.0, "polygons": [{"points": [[p.real, p.imag] for p in corners]}]}
    (view,) = drawing_of({"kind": "layered", "layers": [nut]}).views
    assert [size.value for size in view.sizes] == pytest.approx([13.0])
    corners[0] *= 1.01
    nut["polygons"] = [{"points": [[p.real, p.imag] for p in corners]}]
    assert len(drawing_of({"kind": "layered", "layers": [nut]}).views[0].sizes) > 1


def test_the_letter_of_a_detail_has_room_on_its_leader() -> None:
    """As it was: higher letters reached below the shelf that carries them, and no scale had room for the ring."""
    points = [{"r": r, "z": z} for r, z in ((250.0, 0.0), (262.0, 0.0), (262.0, 12.0), (250.0, 12.0), (250.0, 9.0))]
    ring = drawing_of({"kind": "turned", "points": [*points[:4], points[4] | {"arc": -3.2}, {"r": 250.0, "z": 3.0}]})
    assert any(note.is_letter for note in ring.views[0].notes)
    assert laid(ring.views[0], 0.25, "en") is not None


def bolt(length: float, hole: float | None = None) -> dict[str, Any]:
    """A hexagon bolt M8 of layers, its width across flats 13 mm."""
    bore = [] if hole is None else [{"diameter": hole}]
    head = [(13 / math.sqrt(3) * math.cos(k * math.pi / 3), 13 / math.sqrt(3) * math.sin(k * math.pi / 3))
            for k in range(6)]  # fmt: skip
    shank = {"thickness": length, "circles": [{"diameter": 8.0}, *bore]}
    return {"kind": "layered", "layers": [shank, {"thickness": 5.3, "polygons": [{"points": head}], "circles": bore}]}


def test_a_bolt_is_seen_along_its_axis_and_one_with_a_bore_is_cut() -> None:
    view, shank, head = drawing_of(bolt(30.0)).views
    assert (view.hatched, view.title, shank.title, head.title) == ((), "", "A-A", "B-B")
    # seen towards a corner: the shank, both flats beside the corner, and its edge
    assert levels(view, VISIBLE) == {-6.5, -4.0, 0.0, 4.0, 6.5}
    assert [(size.before, round(size.value, 6)) for size in head.sizes] == [("S ", 13.0)]
    hollow = drawing_of(bolt(30.0, 4.0)).views[0]
    assert hollow.hatched
    assert hollow.title == "A-A"


@pytest.mark.parametrize(("inside", "hollow"), [([], False), ([(3, 10), (3, 6), (0, 6)], True)])
def test_what_is_turned_and_has_nothing_inside_is_seen(inside: list[tuple[float, float]], hollow: bool) -> None:
    corners = [(0, 0), (5, 0), (5, 8), (9, 8), (9, 10), *(inside or [(0, 10)])]
    view = drawing_of({"kind": "turned", "points": [{"r": float(r), "z": float(z)} for r, z in corners]}).views[0]
    assert bool(view.hatched) == hollow


@pytest.mark.parametrize(("length", "hatched"), [(30.0, False), (4.0, True)])
def test_a_bolt_in_an_assembly_is_not_cut_but_what_is_wider_than_long_is(length: float, hatched: bool) -> None:
    parts, _ = make_parts(
        scene_from_dict({"parts": {"p": bolt(length)}, "exports": [{"format": "svg"}]}, "t", "t"), "t"
    )
    sketch = parts["p"].made_by.sketch(parts["p"].keys, parts["p"].thing)
    assert sketch is not None
    assert bool(cut([seen([Shown("p", "p", sketch, Placement3())], SIDE)[0]]).hatched) == hatched


@pytest.mark.sampled(1)
@pytest.mark.parametrize("start", [0.0, 10.0, 36.0])
def test_spokes_in_an_assembly_are_not_hatched_along_their_length_and_are_across_it(start: float) -> None:
    """A plane along a spoke, one through its side, one through a window: rim and hub ring alone are hatched."""
    spokes = {"count": 5, "width": 10.0, "inner_diameter": 60.0, "outer_diameter": 95.0, "start_deg": start}
    wheel = {"kind": "spur_gear", "module": 3.0, "number_of_teeth": 40, "face_width": 8.0, "bore_diameter": 32.0,
             "spokes": spokes}  # fmt: skip
    parts, _ = make_parts(scene_from_dict({"parts": {"p": wheel}, "exports": [{"format": "svg"}]}, "t", "t"), "t")
    sketch = parts["p"].made_by.sketch(parts["p"].keys, parts["p"].thing)
    assert sketch is not None
    shown = Shown("p", "p", sketch, Placement3())
    along = cut([seen([shown], SIDE)[0]])
    (loops,) = along.hatched
    root = 3 * 40 / 2 - 1.25 * 3
    spans = sorted(tuple(sorted({round(line.start.real, 6) for line in loop})) for loop in loops)
    assert spans == [(-root, -47.5), (-30.0, -16.0), (16.0, 30.0), (47.5, root)]
    # both ends of a spoke are lines
    upright = {round(c.start.real, 6) for _, c in along.strokes
               if isinstance(c, Line) and abs(c.start.real - c.end.real) < 1e-9}  # fmt: skip
    assert {-47.5, -30.0, 30.0, 47.5} <= upright
    across = cut([seen([shown], Placement3(translation=(0.0, 0.0, -4.0)))[0]])
    lines = [line.point(np.array(line.domain)) for line in hatching(across.hatched[0], 1.0)]
    spoke = 39.0 * np.exp(1j * math.radians(start))
    assert min(abs((a + (b - a) * t) - spoke) for a, b in lines for t in np.linspace(0, 1, 200)) < 1.0


@pytest.mark.parametrize("below", [True, False])
def test_the_section_of_a_pulley_with_one_flange_reaches_its_diameter_there_alone(below: bool) -> None:
    """As it was: a line ran up to it at the other face too. The sign of roughness stands on the teeth."""
    pulley = {"kind": "timing_pulley", "belt": "T5", "number_of_teeth": 18, "face_width": 10.0, "bore_diameter": 8.0,
              "flanges": {"diameter": 34.0, "thickness": 1.5, "below": below, "above": not below}}  # fmt: skip
    view, outer = drawing_of(pulley).views[0], 5.0 * 18 / math.pi - 0.85
    ends = np.concatenate([curve.point(np.array(curve.domain)) for _, curve in view.strokes])
    high = ends.real[np.abs(ends.imag) > outer / 2 + 1e-6]
    assert set(np.round(high, 9)) == ({0.0, 1.5} if below else {10.0, 11.5})
    assert next(note.at.imag for note in view.notes if note.is_rough) == pytest.approx(outer / 2)


CROSS = {"kind": "geneva_wheel", "number_of_slots": 6, "centre_distance": 120.0}
DRIVER = {"kind": "geneva_driver", "of": "cross", "plate_thickness": 3.0, "face_width": 10.0, "pin_length": 8.0,
          "plate_diameter": 130.0, "bore_diameter": 20.0}  # fmt: skip
LANTERN = {"kind": "lantern_wheel", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0,
           "face_width": 14.0, "plate_thickness": 3.0, "outer_diameter": 96.0, "bore_diameter": 20.0}  # fmt: skip
OUTPUT = {"kind": "output_plate", "number_of_pins": 6, "pin_circle_diameter": 60.0, "pin_diameter": 8.0,
          "pin_length": 10.0, "face_width": 5.0, "outer_diameter": 76.0, "bore_diameter": 14.0}  # fmt: skip
# of each its bore's end and radius, then what material the section has: z from and to, y from and to; the pin of a
# crank of 120 sin 30 degrees has an eighth of that; the locking disc reaches 48.75 and on the side of the pin 14.88
ONE_PIECE: dict[str, tuple[dict[str, Any], complex, list[tuple[float, float, float, float]]]] = {
    "lantern": (LANTERN, 20 - 10j,
                [(z, z + 3, *y) for z in (0, 17) for y in ((10, 48), (-48, -10))]
                + [(3, 17, 36, 44), (3, 17, -44, -36)]),
    "output plate": (OUTPUT, 5 - 7j,
                     [(0, 5, 7, 38), (0, 5, -38, -7), (5, 15, 26, 34), (5, 15, -34, -26)]),
    "one pin": (DRIVER, 13 - 10j,
                [(0, 3, 10, 65), (0, 3, -65, -10), (3, 11, 56.25, 63.75), (3, 13, 10, 14.88), (3, 13, -48.75, -10)]),
    "two pins": (DRIVER | {"number_of_pins": 2}, 13 - 10j,
                 [(*z, *sorted(way * y for y in ys)) for way in (1, -1)
                  for z, ys in (((0, 3), (10, 65)), ((3, 11), (56.25, 63.75)), ((3, 13), (10, 14.88)))]),
}  # fmt: skip


@pytest.mark.parametrize("name", ONE_PIECE)
def test_what_is_of_one_piece_has_no_edge_within_its_section(name: str) -> None:
    """Lines stand where material ends, or before none; there was one at each face on which a disc or a pin stands, and
    the sign of the bore stood at the plate's face, within the disc.
    """
    keys, end, material = ONE_PIECE[name]
    cross = {"cross": CROSS} if "of" in keys else {}
    scene = scene_from_dict({"parts": {**cross, "p": keys}, "exports": [{"format": "svg"}]}, "t", "t")
    part = make_parts(scene, "t")[0]["p"]
    view = import_module(str(part.made_by.drawing)).part_drawing(Subject(part, WorkingTable(), "en")).views[0]

    def inside(at: complex) -> bool:
        return any(a < at.real < b and c < at.imag < d for a, b, c, d in material)

    lines = [curve for layer, curve in view.strokes if layer == VISIBLE and isinstance(curve, Line)]
    for line in lines:
        way = (line.end - line.start) / abs(line.end - line.start)
        for share in np.linspace(0.01, 0.99, 99):
            at = line.start + share * (line.end - line.start)
            assert not (inside(at + 0.02j * way) and inside(at - 0.02j * way)), (line, at)
    # whatever ends is outlined, and the mouths of the bore are seen
    for z, y in [(z, y) for a, b, c, d in material for z in (a, b) for y in np.linspace(c, d, 41)[1:-1]]:
        if inside(complex(z - 0.02, y)) != inside(complex(z + 0.02, y)):
            assert any(abs(one.start.real - z) + abs(one.end.real - z) < 1e-9
                       and (one.start.imag - y) * (one.end.imag - y) <= 0 for one in lines), (z, y)  # fmt: skip
    mouths = {one.start.real for one in lines if one.start.real == one.end.real and one.start.imag * one.end.imag <= 0}
    assert mouths == ({0.0, 3.0, 17.0, 20.0} if name == "lantern" else {0.0, end.real})
    assert any(note.is_rough and note.at == end for note in view.notes)
    # lengths end at material
    for size in (one for one in view.sizes if one.side == "below"):
        assert any(inside(size.end + 0.01 * cmath.exp(1j * turn)) for turn in range(6)), size


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("view", "hatched"),
    [(Placement3(), False), (SIDE, False), (Placement3(((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))), True)],
    ids=["from above", "from its side", "from its end"],
)
@pytest.mark.parametrize("upright", [False, True])
def test_a_key_is_hatched_only_where_it_is_cut_across(view: Placement3, hatched: bool, upright: bool) -> None:
    """GOST 2.305: along its length it is shown uncut. ``upright``: as it lies in a shaft that stands."""
    raw = {"parts": {"p": {"kind": "key", "width": 6.0, "height": 6.0, "length": 20.0}}, "exports": [{"format": "svg"}]}
    part = make_parts(scene_from_dict(raw, "t", "t"), "t")[0]["p"]
    sketch = part.made_by.sketch(part.keys, part.thing)
    assert sketch is not None
    turned = Placement3(((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))) if upright else Placement3()
    middle = Placement3(translation=(0.0, 0.0, -3.0))
    section = cut(seen([Shown("p", "p", sketch, turned @ middle)], view @ turned.inverse()))
    assert bool(section.hatched) == hatched
    assert section.strokes
