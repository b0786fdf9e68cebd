"""Drawings of racks, worms and rings: their lines worked out from module and angles, words on what no size tells."""

from __future__ import annotations

import math
import re
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from exporters.production.plan import plan_build
from geometry.curves.line_arc import Arc, Line
from parts.drawing.working import AXIS, HIDDEN, THIN, VISIBLE, View
from parts.scene.load import scene_from_dict
from tests.parts.drawing.test_sections import drawing_of

RACK: dict[str, Any] = {"kind": "rack", "module": 2.0, "number_of_teeth": 9, "face_width": 15.0, "body_height": 12.0}
WORM: dict[str, Any] = {"kind": "worm", "module": 4.0, "thread_length": 50.0}
GEAR: dict[str, Any] = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 10.0}
RING: dict[str, Any] = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 50, "face_width": 15.0,
                        "outer_diameter": 130.0}  # fmt: skip
TAN = math.tan(math.radians(20.0))
Ends = frozenset[complex]


def near(*points: complex) -> Ends:
    return frozenset(complex(round(p.real, 6) + 0.0, round(p.imag, 6) + 0.0) for p in points)


def straight(view: View, layer: str) -> set[Ends]:
    """Both ends of each straight line of a layer."""
    return {near(c.start, c.end) for name, c in view.strokes if name == layer and isinstance(c, Line)}


def roots(view: View) -> set[Ends]:
    """Thin lines on one side of the axis: marks of the thread's direction stand over it."""
    return {ends for ends in straight(view, THIN) if math.prod(p.imag for p in ends) > 0}


def mirrored(lines: set[Ends], way: complex = 1) -> set[Ends]:
    """Lines and their image in the x axis; ``way`` -1: in the y axis."""
    return lines | {near(*(way * p.conjugate() for p in ends)) for ends in lines}


def sizes(view: View) -> dict[str, tuple[complex, complex, str, str, str]]:
    return {s.name: (s.start, s.end, s.side, s.before, s.after) for s in view.sizes}


def agree(view: View, wanted: dict[str, tuple[complex, complex, str, str, str]]) -> bool:
    found = sizes(view)
    assert found.keys() == wanted.keys()
    for name, (start, end, *words) in wanted.items():
        assert list(found[name][2:]) == words, name
        assert abs(found[name][0] - start) + abs(found[name][1] - end) < 1e-9, name
    return True


def rack_lines(teeth: list[int], pitch: float, tangent: float) -> set[Ends]:
    """Tips and flanks of teeth by their numbers from the middle, m = 2, rho = 0.38 m, alpha the angle of a tangent."""
    angle, found = math.atan(tangent), set[Ends]()
    # the rack's root is rounded: centre rho above it, the flank leaves it there by rho sin(alpha)
    foot = -2.5 + 0.76 * (1 - math.sin(angle))
    for k in teeth:
        tip, low = (pitch / 4 - y * tangent for y in (2.0, foot))
        corners = [k * pitch + x for x in (-low + 1j * foot, -tip + 2j, tip + 2j, low + 1j * foot)]
        found |= {near(a, b) for a, b in pairwise(corners)}
    return found


@pytest.mark.parametrize(
    ("number", "teeth", "shown"), [(9, 0, 1), (9, 2, 1), (9, 3, 2), (3, 0, 1), (3, 3, 3), (2, 9, 2)]
)
def test_a_rack_shows_its_end_teeth_and_as_many_as_are_wished(number: int, teeth: int, shown: int) -> None:
    """Half of those wished at either end, one at least; between them tips and roots are lines."""
    pitch = 2 * math.pi
    half, last = number * pitch / 2, (number - 1) / 2
    front, section = drawing_of(RACK | {"number_of_teeth": number}, teeth=teeth).views
    drawn = {way * (last - k) for k in range(shown) for way in (1, -1)}
    lines = rack_lines([*drawn], pitch, TAN)
    lines |= {near(-half - 2.5j, -half - 14.5j), near(-half - 14.5j, half - 14.5j), near(half - 14.5j, half - 2.5j)}
    inner, whole = (last - shown + 1) * pitch, 2 * shown >= number
    if not whole:
        lines.add(near(-inner + pitch / 4 - 2 * TAN + 2j, inner - pitch / 4 + 2 * TAN + 2j))
    # grounds between the rounded corners are shorter than a third of the pitch
    found = {ends for ends in straight(front, VISIBLE) if max(p.imag for p in ends) > min(p.imag for p in ends)
             or max(p.imag for p in ends) != -2.5}  # fmt: skip
    assert found == lines
    grounds = straight(front, VISIBLE) - found
    assert len(grounds) == 2 + (2 * shown - 2 if not whole else number - 1)
    width = pitch / 2 - 2 * (2.5 * TAN + 0.76 * math.tan(math.radians(35)))
    lengths = sorted(max(p.real for p in g) - min(p.real for p in g) for g in grounds)
    assert lengths == pytest.approx([width / 2] * 2 + [width] * (len(grounds) - 2), abs=2e-6)
    cut_off = set() if whole else {near(-half + shown * pitch - 2.5j, half - shown * pitch - 2.5j)}
    assert straight(front, THIN) == cut_off
    assert straight(front, HIDDEN) == set()
    axes = {near(a.start, a.end) for a in front.axes}
    assert axes == {near(-half, half), near(-last * pitch - 2.5j, -last * pitch + 2j)}
    assert agree(front, {"length": (-half - 14.5j, half - 14.5j, "below", "", ""),
                         "first_tooth": (-half - 2.5j, -last * pitch + 2j, "above", "", "")})  # fmt: skip
    assert [(cut.at, cut.letter, cut.from_right) for cut in front.cuts] == [(pytest.approx(last * pitch), "A", False)]
    (note,) = front.notes
    assert (note.text, note.goes_on, note.is_rough) == ("Ra 1.6", True, True)
    assert abs(note.at - half) < 1e-9
    box = [0j - 14.5j, 15 - 14.5j, 15 + 2j, 2j]
    assert straight(section, VISIBLE) == {near(a, b) for a, b in zip(box, (*box[1:], box[0]), strict=True)} | {
        near(-2.5j, 15 - 2.5j)}  # fmt: skip
    (loop,) = section.hatched
    solid = [0j - 14.5j, 15 - 14.5j, 15 - 2.5j, -2.5j]
    assert {near(c.start, c.end) for c in loop if isinstance(c, Line)} == {
        near(a, b) for a, b in zip(solid, (*solid[1:], solid[0]), strict=True)}  # fmt: skip
    assert agree(section, {"face_width": (-14.5j, 15 - 14.5j, "below", "", "h11"),
                           "height": (15 - 14.5j, 15 + 2j, "right", "", "h11"),
                           "datum_height": (-14.5j, 0j, "left", "", "")})  # fmt: skip
    assert section.title == "A-A"
    assert [(a.start, a.end) for a in section.axes] == [(0j, 15 + 0j)]


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_holes_of_a_rack_are_told_to_their_last_one(count: int) -> None:
    """In a row about the middle; their depth and the first one from the lower left corner."""
    holes = {"count": count, "diameter": 4.0, "spacing": 10.0, "depth": 5.0}
    front, _ = drawing_of(RACK | {"holes": holes}).views
    half, first = 9 * math.pi, -5.0 * (count - 1)
    y = -2.5 - 5.0
    wanted = [complex(first + 10.0 * k, y) for k in range(count)]
    circles = [c for name, c in front.strokes if name == VISIBLE and isinstance(c, Arc) and abs(c.sweep) > 6.28]
    assert [(c.centre, c.radius) for c in circles] == [(pytest.approx(p), 2.0) for p in wanted]
    rows: dict[str, tuple[complex, complex, str, str, str]] = {
        "length": (-half - 14.5j, half - 14.5j, "below", "", ""),
        "first_tooth": (-half - 2.5j, -8 * math.pi + 2j, "above", "", ""),
        "holes.depth": (-half - 14.5j, wanted[0], "left", "", ""),
        "holes.first": (-half - 14.5j, wanted[0], "below", "", ""),
    }
    if count > 1:
        rows["holes.spacing"] = (wanted[0], wanted[1], "below", "", "")
    if count > 2:
        rows["holes.all"] = (wanted[0], wanted[-1], "below", f"{count - 1}×10=", "")
    assert agree(front, rows)
    (told,) = front.rounds
    assert (told.centre, told.radius) == (wanted[-1], 2.0)
    assert told.before == ("Ø" if count == 1 else f"{count} holes Ø")
    # without a word they stand in the middle of the body
    plain = drawing_of(RACK | {"holes": {"count": 1, "diameter": 4.0}}).views[0]
    assert plain.rounds[0].centre == pytest.approx(-2.5j - 6.0j)


@pytest.mark.parametrize(("angle", "double"), [(10.0, False), (-10.0, False), (25.0, True)])
def test_what_is_behind_the_face_of_a_helical_rack_lies_aslant(angle: float, double: bool) -> None:
    """By b tan(beta); of a double one both faces are alike, and its middle lies aslant by b / 2 tan(beta)."""
    keys = RACK | {"helix_angle_deg": angle, "double_helical": double}
    front, section, top = drawing_of(keys).views
    beta = math.radians(angle)
    pitch = 2 * math.pi / math.cos(beta)
    half = 4.5 * pitch
    # the near face is the upper one, from which a right-hand tooth goes down to the right; the upper half is of the
    # other hand where there are two
    lean = 15.0 * math.tan(beta) * (-0.5 if double else 1)
    tips = [way * (4 * pitch + side * (pitch / 4 - 2 * TAN / math.cos(beta))) for way in (1, -1) for side in (1, -1)]
    line = [0j, lean + 7.5j, 15j] if double else [0j, lean + 15j]
    behind = {end: {near(*pair) for pair in
                    ((end - 14.5j, end + lean - 14.5j), (end + lean - 14.5j, end + lean - 2.5j),
                     (end + lean - 2.5j, end - 2.5j))} for end in (half, -half)}  # fmt: skip
    seen, hid = (half, -half) if lean > 0 else (-half, half)
    assert behind[seen] <= straight(front, VISIBLE)
    assert straight(front, HIDDEN) == behind[hid]
    assert [(n.text, n.at, n.looks) for n in front.notes if n.looks] == [("B", pytest.approx(2j), -1j)]
    assert (section.title, top.title) == ("A-A", "B")
    wanted = {near(x + a, x + b) for x in (half, -half, *tips) for a, b in pairwise(line)}
    wanted |= {near(p - half, p + half) for p in (0j, line[-1])}
    assert {frozenset(e) for e in straight(top, VISIBLE)} == wanted
    # three marks along the teeth after GOST 2.402, 0.7 of their way, 0.3 of the free length apart
    middle, free = line[-1] / 2, min(map(abs, tips))
    marks = {near(*(middle + 0.7 * (p - middle) + 0.3 * k * free for p in pair))
             for k in (-1, 0, 1) for pair in pairwise(line)}  # fmt: skip
    assert straight(top, THIN) == marks


def test_only_the_ring_and_its_teeth_are_seen_of_a_ring() -> None:
    """A circle outside, teeth as circles of tip and root, the reference circle as an axis; the tip with its zone."""
    section, face = drawing_of(RING).views
    circles = {(name, round(c.radius, 6)) for name, c in face.strokes if isinstance(c, Arc)}
    # d_a2 = d_2 - 2 (1 - k_2) m, k_2 = 0.25 (GOST 19274)
    assert circles >= {(VISIBLE, 65.0), (VISIBLE, 48.5), (AXIS, 50.0)}
    assert {a.start.imag for a in section.axes} == {0.0, 50.0, -50.0}
    assert {(a.start.real, a.end.real) for a in section.axes if a.start.imag} == {(0.0, 15.0)}
    tip = sizes(section)["tip_diameter"]
    assert tip == (pytest.approx(15 - 48.5j), pytest.approx(15 + 48.5j), "right", "Ø", "H11")
    assert [s.name for s in section.sizes][:2] == ["outer_diameter", "tip_diameter"]
    (rough,) = section.notes
    assert (rough.text, rough.goes_on) == ("Ra 1.6", True)
    assert abs(rough.at - (15 - 50j)) < 1e-9


def test_chamfers_of_a_ring_are_drawn_and_told_by_how_many_there_are() -> None:
    """Two lines at 45 degrees for each face in either half: at the tips and at the outside; sizes end beside them."""
    section = drawing_of(RING | {"face_chamfer": {"below": 0.5, "above": 1.0}}).views[0]
    aslant = {near(0.5 + 48.5j, 49j), near(14 + 48.5j, 15 + 49.5j), near(0.5 + 65j, 64.5j), near(14 + 65j, 15 + 64j)}
    lines = straight(section, VISIBLE)
    assert {e for e in lines if len({p.real for p in e}) == len({p.imag for p in e}) == 2} == mirrored(aslant)
    found = sizes(section)
    assert found["face_chamfer.above"] == (14 + 65j, 15 + 65j, "above", "2 chamfers ", "×45°")
    assert found["face_chamfer.below"] == (0.5 + 65j, 65j, "above", "2 chamfers ", "×45°")
    assert found["tip_diameter"][:2] == (14 - 48.5j, 14 + 48.5j)
    assert found["outer_diameter"][:2] == (0.5 - 65j, 0.5 + 65j)
    both = sizes(drawing_of(RING | {"face_chamfer": 0.8}).views[0])
    assert [both[name][3] for name in both if name.startswith("face")] == ["", "4 chamfers "]


@pytest.mark.parametrize("teeth", [1, 7, 60])
def test_as_many_teeth_of_a_ring_are_exact_as_are_wished(teeth: int) -> None:
    """The wished ones between tip and root, their roots two modules and a half wide of the pitch circle."""
    face = drawing_of(RING, teeth=teeth).views[1]
    curves = [c for name, c in face.strokes if name == VISIBLE and not isinstance(c, Arc)]
    spaces = {round(float(np.angle(c.point(sum(c.domain) / 2)) / (2 * math.pi / 50) * 2)) for c in curves}
    assert len(curves) >= 2 * min(teeth, 50)
    assert len(spaces) >= min(teeth, 50)
    assert max(abs(complex(p)) for c in curves for p in c.point(np.array(c.domain))) < 53.0 + 1e-6
    assert min(abs(complex(p)) for c in curves for p in c.point(np.array(c.domain))) > 48.5 - 1e-6


SHAFTS: dict[str, Any] = {"shaft_below": [{"diameter": 28.0, "length": 20.0}],
                          "shaft_above": [{"diameter": 25.0, "length": 15.0, "chamfer": 1.0}]}  # fmt: skip


@pytest.mark.parametrize("bore", [None, 8.0, "keyway"])
def test_a_worm_is_seen_with_its_shaft_and_its_bore_hidden(bore: Any) -> None:
    """m 4, q 10: d 40, tips 48, roots 30.4; its ends cut at 20 degrees: 8.8 tan(20) nearer at the tips."""
    keys = {} if bore is None else {"bore": {"shape": "keyway", "diameter": 12.0}} if bore == "keyway" else {
        "bore_diameter": bore}  # fmt: skip
    view, *others = drawing_of(WORM | SHAFTS | keys).views
    edge = 25.0 - 8.8 * TAN
    outside = [
        -45 + 14j,
        -25 + 14j,
        -25 + 15.2j,
        -edge + 24j,
        edge + 24j,
        25 + 15.2j,
        25 + 12.5j,
        39 + 12.5j,
        40 + 11.5j,
    ]
    lines = {near(a, b) for a, b in pairwise(outside)}
    lines |= {near(-45, -45 + 14j), near(40, 40 + 11.5j)}
    lines |= {near(x, x + 1j * y) for x, y in ((-25.0, 14.0), (-edge, 24.0), (edge, 24.0), (25.0, 12.5), (39.0, 12.5))}
    assert straight(view, VISIBLE) == mirrored(lines)
    assert roots(view) == mirrored({near(-25 + 15.2j, 25 + 15.2j)})
    assert straight(view, AXIS) == set()
    assert [(a.start, a.end) for a in view.axes] == [(-45, 40), (-25 + 20j, 25 + 20j), (-25 - 20j, 25 - 20j)]
    # the key of a bore of 12 is 4 wide, its way 1.8 deep (DIN 6885)
    walls = {None: set[float](), 8.0: {4.0, -4.0}, "keyway": {7.8, -6.0, math.sqrt(6**2 - 2**2)}}[bore]
    assert straight(view, HIDDEN) == {near(-45 + 1j * y, 40 + 1j * y) for y in walls}
    rows: dict[str, tuple[complex, complex, str, str, str]] = {
        "outer_diameter.1": (-45 - 14j, -45 + 14j, "left", "Ø", "h11"),
        "outer_diameter.2": (edge - 24j, edge + 24j, "right", "Ø", "h11"),
        "outer_diameter.3": (40 - 12.5j, 40 + 12.5j, "right", "Ø", "h11"),
        "length": (-45 - 14j, 40 - 11.5j, "below", "", ""),
        "length.2": (-45 - 14j, -25 - 14j, "below", "", ""),
        "thread_length": (-25 - 14j, 25 - 12.5j, "below", "", ""),
        "chamfer.1": (39 + 12.5j, 40 + 12.5j, "above", "", "×45°"),
    }
    if bore == 8.0:
        rows["bore_diameter"] = (40 - 4j, 40 + 4j, "right", "Ø", "H7")
    found = sizes(view)
    assert found.keys() == rows.keys()
    for name, (start, end, side, *words) in rows.items():
        assert list(found[name][2:]) == [side, *words], name
        way = (lambda p: p.imag) if side in ("left", "right") else (lambda p: p.real)
        assert abs(way(found[name][0]) - way(start)) + abs(way(found[name][1]) - way(end)) < 1e-9, name
    assert (len(others), [v.title for v in others]) == ((1, ["A"]) if bore == "keyway" else (0, []))
    looks = [(n.text, n.at, n.looks) for n in view.notes if n.looks]
    assert looks == ([("A", 40 + 0j, -1)] if bore == "keyway" else [])
    rough = [n for n in view.notes if n.is_rough]
    # on the extension of the pitch line; at the bore's lower wall
    assert len(rough) == 1 + (bore is not None)
    assert (rough[0].at, rough[0].goes_on) == (25 + 20j, True)
    if bore is not None:
        assert rough[1].at.imag == pytest.approx(-4.0 if bore == 8.0 else -6.0)


STEP: list[dict[str, float]] = [{"diameter": 25.0, "length": 15.0}]


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        # a thread from end to end is as long as the worm; of a shaft on one side the way to the thread follows
        ({}, {"length": (-25.0, 25.0)}),
        ({"shaft_above": STEP}, {"length.2": (-25.0, 25.0), "length": (-25.0, 40.0)}),
        ({"shaft_below": STEP}, {"thread_length": (-25.0, 25.0), "length": (-40.0, 25.0)}),
    ],
)  # fmt: skip
def test_the_length_of_a_thread_is_told_from_end_to_end(keys: dict[str, Any], told: dict[str, Any]) -> None:
    (view,) = drawing_of(WORM | keys).views
    lengths = {s.name: (s.start.real, s.end.real) for s in view.sizes if s.side == "below"}
    assert lengths == {name: pytest.approx(ends) for name, ends in told.items()}


def test_a_thread_that_runs_out_is_told_as_far_as_it_is_whole() -> None:
    """A quarter of a turn, pitch / 4, on until the tool has left: from the root of 15.2 to the tips at 24."""
    (view,) = drawing_of(WORM | {"thread_ends": "run_out"}).views
    quarter = 4 * math.pi / 4
    wanted = [(-25 - quarter + 24j, -25 + 15.2j), (-25 + 15.2j, 25 + 15.2j), (25 + 15.2j, 25 + quarter + 24j)]
    assert roots(view) == mirrored({near(*ends) for ends in wanted})
    thread = sizes(view)["thread_length"]
    assert thread == (pytest.approx(-25 - 15.2j), pytest.approx(25 - 15.2j), "below", "", "")


def test_a_thread_cut_off_straight_is_told_by_its_end_faces() -> None:
    """No cones: the cylinder of the tips from end to end, both faces from the axis to the root and on to the tips."""
    (view,) = drawing_of(WORM | {"end_angle_deg": 0.0}).views
    outside = [-25 + 0j, -25 + 15.2j, -25 + 24j, 25 + 24j, 25 + 15.2j, 25 + 0j]
    assert straight(view, VISIBLE) == mirrored({near(a, b) for a, b in pairwise(outside)})
    told = {name: (row[0], row[1]) for name, row in sizes(view).items()}
    assert told == {"outer_diameter.1": (-25 - 24j, -25 + 24j), "length": (-25 - 24j, 25 - 24j)}


def test_the_rim_of_a_worm_wheel_is_hollow_about_its_worm() -> None:
    """m 4, q 10, z 30: axes 80 apart, throat at 64, roots at 55.2: arcs of 16 and 24.8 mm about the worm's axis."""
    wheel = {"kind": "worm_wheel", "module": 4.0, "number_of_teeth": 30, "face_width": 20.0, "bore_diameter": 25.0}
    section = drawing_of(wheel).views[0]
    arcs = {(round(abs(c.centre.imag), 6), round(c.centre.real, 6), round(c.radius, 6))
            for _, c in section.strokes if isinstance(c, Arc)}  # fmt: skip
    assert arcs == {(80.0, 10.0, 16.0), (80.0, 10.0, 24.8)}
    hatched = {round(c.radius, 6) for loop in section.hatched for c in loop if isinstance(c, Arc)}
    assert hatched == {24.8}
    assert {abs(a.start.imag) for a in section.axes} == {0.0, 60.0}


def words_of(keys: dict[str, Any]) -> tuple[str, ...]:
    return drawing_of(keys).requirements[1:]


HELICAL: dict[str, Any] = {"helix_angle_deg": 10.0}
MARK: dict[str, Any] = {"tooth_mark": {"depth": 0.3}}


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        (GEAR, ()),
        (GEAR | {"tip_chamfer": 0.2}, ("Tip edges of the teeth: chamfer 0.2×45°.",)),
        (GEAR | {"tip_rounding": 0.3}, ("Tip edges of the teeth: rounded R0.3.",)),
        (GEAR | HELICAL | {"tip_rounding": 0.3}, ("Tip edges of the teeth in the transverse section: rounded R0.3.",)),
        (RACK | {"tip_rounding": 0.3}, ("Tip edges of the teeth: rounded R0.3.",)),
        (RACK | HELICAL | {"tip_rounding": 0.3},
         ("Tip edges of the teeth in the normal section: rounded R0.3.", "Ends along the teeth, 10° off square.")),
        (RACK | {"helix_angle_deg": -12.5, "tip_chamfer": 0.2},
         ("Tip edges of the teeth in the transverse section: chamfer 0.2×45°.",
          "Ends along the teeth, 12.5° off square.")),
        (WORM, ("Ends of the thread: cut by cones at 20° to the end planes.",)),
        (WORM | {"end_angle_deg": 0.0}, ()),
        (WORM | {"end_angle_deg": 35.0, "tip_rounding": 0.3},
         ("Tip edges of the thread in the axial section: rounded R0.3.",
          "Ends of the thread: cut by cones at 35° to the end planes.")),
        (WORM | {"thread_ends": "blunt"}, ("Ends of the thread: its thin part cut off by an axial plane.",)),
        (WORM | {"thread_ends": "run_out", "run_out_deg": 60.0},
         ("Spaces of the thread: whole over 50, the tool leaves within 60° of turn.",)),
        (WORM | {"end_angle_deg": 0.0, "number_of_starts": 2,
                 "bore": {"shape": "keyway", "diameter": 12.0, "angle_deg": 200.0}},
         # two threads, half a turn apart
         ("Keyway: its axis at 20° from the thread in the middle of its length, counter-clockwise as drawn.",)),
        (WORM | {"end_angle_deg": 0.0, "bore": {"shape": "keyway", "diameter": 12.0, "angle_deg": 30.0}},
         ("Keyway: its axis at 30° from the thread in the middle of its length, counter-clockwise as drawn.",)),
        # 20 teeth 18 degrees apart
        (GEAR | {"bore": {"shape": "keyway", "diameter": 12.0, "angle_deg": 40.0}},
         ("Keyway: its axis at 4° from the middle of a tooth, counter-clockwise as drawn.",)),
        (GEAR | {"bore": {"shape": "D", "diameter": 10.0, "flat": 8.0, "angle_deg": 36.0}},
         ("Bore: the middle of its flat in the direction of the middle of a tooth.",)),
        # 50 spaces 7.2 degrees apart, six holes 60
        (RING | {"holes": {"count": 6, "diameter": 5.0, "pitch_circle_diameter": 118.0, "start_deg": 128.2}},
         ("Holes Ø5: the first at 8.2° from the middle of a space, counter-clockwise as drawn.",)),
    ],
)  # fmt: skip
def test_words_tell_what_no_size_does(keys: dict[str, Any], told: tuple[str, ...]) -> None:
    assert words_of(keys) == told


def test_marks_and_numbers_of_teeth_are_told() -> None:
    (told,) = words_of(GEAR | {"number_of_teeth": 40} | MARK)
    assert re.fullmatch(r"A mark at a tooth and the number 40 engraved 0\.3 deep, digits \S+ high\.", told)
    (told,) = words_of(RING | {"tooth_mark": {"depth": 0.5}})
    assert re.fullmatch(r"A mark at a space and the number 50 engraved 0\.5 deep, digits \S+ high\.", told)


@pytest.mark.parametrize("keys", [GEAR | {"bore_diameter": 8.0}, RING, RACK, WORM | {"bore_diameter": 8.0}])
def test_the_wishes_of_an_export_stand_beside_the_sizes(keys: dict[str, Any]) -> None:
    """Zones of ISO 286 at the outside, the inside, the width and the bore, roughness of flanks and bores."""
    wishes = {"tip": "h8", "inner": "H9", "bore": "F8", "width": "js12", "shaft": "k6",
              "flank_roughness": 0.8, "bore_roughness": 3.2}  # fmt: skip
    views = drawing_of(keys, **wishes).views
    zones = {s.name: s.after for view in views for s in view.sizes if s.after}
    kind = str(keys["kind"])
    assert (
        zones
        == {
            "spur_gear": {"tip_diameter": "h8", "face_width": "js12", "bore_diameter": "F8"},
            "ring_gear": {"outer_diameter": zones.get("outer_diameter"), "tip_diameter": "H9", "face_width": "js12"},
            "rack": {"face_width": "js12", "height": "h8"},
            "worm": {"outer_diameter.1": "h8", "bore_diameter": "F8"},
        }[kind]
    )
    rough = [note.text for view in views for note in view.notes if note.is_rough]
    assert rough == ["Ra 0.8"] + ["Ra 3.2"] * (kind in ("spur_gear", "worm"))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("teeth", [100, 4])
def test_the_section_of_a_long_rack_is_large_enough_to_be_read(teeth: int) -> None:
    """At the 1:20 of its view one of 80 x 78 mm was 4 x 4 mm on paper."""
    rack = {"kind": "rack", "module": 8.0, "number_of_teeth": teeth, "face_width": 80.0, "body_height": 60.0}
    raw = {"parts": {"p": rack}, "exports": [{"format": "svg", "purpose": "part"}]}
    canvas = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets[0].canvas
    assert any(re.match("A-A", text.text) for text in canvas.texts)
    (width,) = (one for one in canvas.dimensions if one.name == "face_width")
    assert 80.0 * width.scale >= 20.0


@pytest.mark.parametrize(("hand", "starts", "length"), [("right", 1, 50.0), ("left", 4, 50.0), ("right", 6, 12.0)])
def test_three_lines_show_which_way_the_thread_of_a_worm_runs(hand: str, starts: int, length: float) -> None:
    """GOST 2.402: as the near side of its helix is seen, its axis to the right, y upwards: from -x."""
    keys = WORM | {"hand": hand, "number_of_starts": starts, "thread_length": length, "diameter_quotient": 10.0}
    (view,) = drawing_of(keys).views
    marks = sorted((sorted(ends, key=lambda p: p.imag) for ends in straight(view, THIN)
                    if len({p.imag for p in ends}) == 2), key=lambda ends: ends[0].real)  # fmt: skip
    # r = 20, lead 4 pi z_1: of (r cos t, r sin t, p t / 2 pi) at t = pi
    turn = 1.0 if hand == "right" else -1.0
    seen = complex(4.0 * math.pi * starts / (2 * math.pi), turn * 20.0 * math.cos(math.pi))
    assert len(marks) == 3
    for low, high in marks:
        assert ((high - low) * seen.conjugate()).imag == pytest.approx(0.0, abs=1e-4)
        assert max(abs(low.real), abs(high.real)) < length / 2
        assert abs(low.imag + high.imag) < 1e-6
    steps = [b[0] - a[0] for a, b in pairwise(marks)]
    assert steps[0] == pytest.approx(steps[1], abs=1e-5)
    assert steps[0].real > 0.5


@pytest.mark.parametrize("first", [-4, 0, 7])
def test_a_sector_is_drawn_with_its_teeth_upwards(first: int) -> None:
    """The face has its outline as the files have it, turned, wherever the run stands there; the section has teeth above
    and the hub below.
    """
    sector = {"teeth": 9, "rest": "cut", "corner_radius": 1.0, "first_tooth": first}
    keys = GEAR | {"number_of_teeth": 40, "bore_diameter": 8.0, "sector": sector}
    section, face = drawing_of(keys).views
    assert {r.name: r.value for r in face.rounds} == pytest.approx(
        {"tip_diameter": 84.0, "sector.hub_diameter": 18.75, "sector.corner_radius": 1.0}
    )
    assert "tip_diameter" not in sizes(section)
    heights = {round(y, 6) for ends in straight(section, VISIBLE) for y in (p.imag for p in ends)}
    # tips, roots and bore above; bore and hub below, half of the pitch circle's line
    assert heights - {0.0} == {42.0, 37.5, 4.0, -4.0, -9.375}
    axes = {near(line.start, line.end) for line in section.axes if isinstance(line, Line)}
    assert near(40j, 10 + 40j) in axes
    assert near(-40j, 10 - 40j) not in axes
    (pitch,) = (c for layer, c in face.strokes if layer == AXIS and isinstance(c, Arc))
    assert (pitch.radius, math.degrees(pitch.start_angle), math.degrees(pitch.sweep)) == pytest.approx((40, 49.5, 81))
    tips = [c for layer, c in face.strokes if layer == VISIBLE and isinstance(c, Arc) and abs(c.radius - 42) < 1e-9]
    middles = sorted(math.degrees(t.start_angle + t.sweep / 2) for t in tips)
    assert middles == pytest.approx([90 + 9 * k for k in range(-4, 5)])


def test_a_sector_of_a_ring_is_drawn_upwards_too() -> None:
    """Below the axis its section has the blank alone."""
    section, face = drawing_of(RING | {"sector": {"teeth": 7, "blank_diameter": 112.0}}).views
    assert {r.name for r in face.rounds} == {"tip_diameter", "sector.blank_diameter"}
    low = {round(p.imag, 6) for ends in straight(section, VISIBLE) for p in ends if p.imag < 0}
    assert low == {-56.0, -65.0}
