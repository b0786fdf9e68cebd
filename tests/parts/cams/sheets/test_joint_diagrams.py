"""Joint diagrams: where the axis may stand, by brute force, and each line, mark and word in its place."""

from __future__ import annotations

import cmath
import itertools
import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from geometry.curves.bspline import BSpline
from geometry.curves.line_arc import Arc, Line
from parts.cams.disk_cam.part import CAM
from parts.cams.sheets.joint import joint_of, joint_paper
from parts.cams.sheets.measures import distance_by_sections
from parts.cams.sheets.picture import CamPicture, cam_picture
from parts.cams.sheets.swing import swing_of
from parts.drawing.canvas import SMALL_TEXT, Box, Canvas
from parts.drawing.choice import Asked, blank
from parts.drawing.labels import Labeller, nearest
from parts.scene.load import scene_from_toml

AREA = Box(40.0, 60.0, 340.0, 360.0)
BASE = """
[parts.cam]
kind = "cam"
base_circle_radius = 40.0
{follower}
phases = [
    {{ move = "rise", angle_deg = 120.0, law = "polynomial_345" }},
    {{ move = "dwell", angle_deg = 30.0 }},
    {{ move = "return_", angle_deg = 90.0, law = "sine" }},
    {{ move = "dwell", angle_deg = 120.0 }},
]
"""
ROLLER = 'follower = "roller"\nfollower_radius = 8.0\nlift = 20.0\nfollower_offset = {offset}'
FLAT = 'follower = "flat"\nlift = 20.0'
ARM = ('follower = "roller"\nfollower_radius = 8.0\nswing_deg = 15.0\n'
       'oscillating = {{ centre_distance = 90.0, arm_length = 70.0, sense = "{sense}" }}')  # fmt: skip
# on the rise and on the return: dense places over the cam angle
RISE, RETURN = np.linspace(0, 2 * math.pi / 3, 4001), np.linspace(5 * math.pi / 6, 4 * math.pi / 3, 4001)


@cache
def cam(follower: str) -> Any:
    scene = scene_from_toml(BASE.format(follower=follower).encode(), "t", "t")
    return CAM.thing(scene.parts["cam"], {})


def picture(follower: str, gamma: float | None = 60.0) -> CamPicture:
    return cam_picture(cam(follower), 4, gamma, 5.0, "en")


class Drawn:
    """A joint diagram on an empty sheet, read in mm of the model."""

    def __init__(self, made: CamPicture, *, by_hand: bool = False, area: Box = AREA) -> None:
        self.canvas: Canvas = blank("A2", upright=True)
        asked = Asked("en", 1e-4, by_hand=by_hand)
        diagram = joint_of(made) or swing_of(made)
        assert diagram is not None
        self.box = diagram.window()
        self.paper, self.window = joint_paper(self.box, area)
        diagram.draw(self.canvas, self.paper, self.window, asked)
        self.strokes = list(self.canvas.strokes)
        diagram.name(Labeller(self.canvas, area), self.paper, self.window, by_hand=by_hand)

    def lines(self, layer: str) -> list[tuple[complex, complex]]:
        found = [s.curve for s in self.strokes if s.layer == layer and isinstance(s.curve, Line)]
        return [(self.model(c.start), self.model(c.end)) for c in found]

    def marks(self, layer: str) -> list[complex]:
        return [self.model(s.curve.centre) for s in self.strokes if s.layer == layer and whole(s.curve)]

    def angle(self) -> Arc:
        arcs = [s.curve for s in self.strokes if s.layer == "DIMENSION" and isinstance(s.curve, Arc)]
        return next(arc for arc in arcs if not whole(arc))

    def model(self, point: complex) -> complex:
        return (point - self.paper.origin) / self.paper.scale

    def named(self, text: str, point: complex) -> bool:
        """Whether the word stands beside the point, or is joined to it by a line."""
        (box,) = (t.box for t in self.canvas.texts if t.text == text)
        at = self.paper.point(point)
        near = nearest(box, at)
        if abs(near - at) <= 3.0:
            return True
        leads = self.canvas.strokes[len(self.strokes) :]
        return any(abs(s.curve.start - at) < 1e-9 and abs(s.curve.end - near) < 1e-9 for s in leads)

    def size(self, text: str) -> float:
        return next(t.runs[0].height for t in self.canvas.texts if t.text == text)


def whole(curve: Any) -> bool:
    return isinstance(curve, Arc) and abs(curve.sweep) == 2 * math.pi


def on_border(p: complex, box: Box) -> bool:
    sides = (p.real - box.left, box.right - p.real, p.imag - box.low, box.high - p.imag)
    return min(sides) == pytest.approx(0, abs=1e-9)


def motion(made: CamPicture, angles: np.ndarray, order: int) -> np.ndarray:
    return made.cam.motion.value(angles, order) + 1j * made.cam.motion.value(angles)


@pytest.mark.parametrize("offset", [0.0, 6.0])
def test_a_rollers_region_is_that_of_its_pressure_angles(offset: float) -> None:
    """tan nu = (S' - e) / (s_0 + S) for an axis at (e, -s_0): the highest axis of each abscissa by brute force."""
    made = picture(ROLLER.format(offset=offset))
    joint = joint_of(made)
    assert joint is not None
    assert (joint.order, joint.offset) == (1, offset)
    points, cot = motion(made, RISE, 1), 1 / math.tan(math.radians(30))
    for x in (-30.0, -5.0, offset, 9.0, 40.0):
        highest = (points.imag - np.abs(points.real - x) * cot).min()
        assert min(slope * x - a for a, slope in joint.borders) == pytest.approx(highest, abs=1e-4)
        if x == offset:
            assert joint.least == pytest.approx(complex(x, highest), abs=1e-4)
    back = motion(made, RETURN, 1)
    assert joint.return_line is not None
    a, slope = joint.return_line
    assert slope == pytest.approx(-cot, rel=1e-12)
    assert -a == pytest.approx((back.imag + back.real * cot).min(), abs=1e-4)
    prime = 40.0 + 8.0
    assert joint.centre == pytest.approx(complex(offset, -math.sqrt(prime**2 - offset**2)), rel=1e-12)


def test_a_flat_faces_axis_stands_below_the_tangent_at_45_degrees() -> None:
    made = picture(FLAT, None)
    joint = joint_of(made)
    assert joint is not None
    points = motion(made, np.linspace(0, 2 * math.pi, 20001), 2)
    radius = -(points.real + points.imag).min()
    assert joint.least == pytest.approx(complex(0, -radius), abs=1e-4)
    assert joint.borders == ((-joint.least.imag, -1.0),)
    assert (joint.order, joint.offset, joint.centre, joint.return_line) == (2, 0.0, -40j, None)


def once(places: Any) -> list[Any]:
    """What stands in one place is drawn once: both sides of no jump, a dwell."""
    return [at for k, at in enumerate(places) if all(np.abs(at - other).max() > 1e-6 for other in places[:k])]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("follower", "gamma"), [(ROLLER.format(offset=0.0), 60.0), (ROLLER.format(offset=6.0), None), (FLAT, None)]
)
def test_a_joint_diagram_is_drawn_where_its_numbers_have_it(follower: str, gamma: float | None) -> None:
    made = picture(follower, gamma)
    joint = joint_of(made)
    assert joint is not None
    drawn = Drawn(made)
    window, tall = drawn.window, drawn.box.high - drawn.box.low
    # all is seen, with a little room beside it
    turn = np.linspace(0, 2 * math.pi, 721)[:-1]
    seen = [*motion(made, turn, joint.order), 0j, joint.least, joint.centre]
    xs, ys = np.real(seen), np.imag(seen)
    for room in (xs.min() - drawn.box.left, drawn.box.right - xs.max()):
        assert 0.05 * np.ptp(xs) < room < 0.5 * tall
    for room in (ys.min() - drawn.box.low, drawn.box.high - ys.max()):
        assert 0.05 * np.ptp(ys) < room < 0.2 * np.ptp(ys)
    # in the middle of its area, the next larger scale of the standard does not fit
    assert drawn.paper.point(complex(window.left + window.right, window.low + window.high) / 2) == pytest.approx(
        complex(AREA.left + AREA.right, AREA.low + AREA.high) / 2, rel=1e-12
    )
    room = min(300 / (drawn.box.right - drawn.box.left), 300 / tall)
    standard = (1, 2, 2.5, 4, 5, 10)
    assert drawn.paper.scale == max(s for s in standard if s <= room)
    assert (window.low, window.high) == (drawn.box.low, drawn.box.high)
    assert window.left <= drawn.box.left
    assert window.right >= drawn.box.right
    # the axes, with arrows of equal sides at their ends
    upright, level, *heads = drawn.lines("AXIS")
    assert upright == pytest.approx((1j * window.low, 1j * window.high), abs=1e-9)
    assert level == pytest.approx((window.left, window.right), abs=1e-9)
    assert [abs(a - b) for a, b in heads] == pytest.approx([abs(heads[0][0] - heads[0][1])] * len(heads), rel=1e-9)
    # positions on both sides of the jumps: 4 parts of rise and return, one of each dwell
    places = np.radians([0, 30, 60, 90, 120, 150, 172.5, 195, 217.5, 240])
    marks = drawn.marks("JOINT_DIAGRAM")
    early = np.where(places == 0, 2 * math.pi, places) - 1e-12
    wanted = [*motion(made, places, joint.order), *motion(made, early, joint.order)]
    assert marks == pytest.approx(once(wanted), abs=1e-6)
    # the diagram itself: each of its curves runs through the points of its own phase
    curves = [s.curve for s in drawn.strokes if s.layer == "JOINT_DIAGRAM" and not isinstance(s.curve, Arc)]
    run = np.concatenate([drawn.model(c.point(np.linspace(*c.domain, 3001))) for c in curves])
    for some in (RISE[1:-1:100], RETURN[1:-1:100]):
        for point in motion(made, some, joint.order):
            assert np.abs(run - point).min() < 0.05
    # tangents reach across the window
    for (a, slope), (start, end) in zip(joint.borders, drawn.lines("GAMMA_TANGENT"), strict=True):
        for p in (start, end):
            assert p.imag == pytest.approx(slope * p.real - a, abs=1e-9)
            assert on_border(p, window)
        assert start.real < end.real
    back = drawn.lines("RETURN_TANGENT")
    assert len(back) == (joint.return_line is not None)
    for start, end in back:
        a, slope = joint.return_line or (0.0, 0.0)
        assert [p.imag - slope * p.real + a for p in (start, end)] == pytest.approx([0, 0], abs=1e-9)
        assert on_border(start, window)
        assert on_border(end, window)
    aside = drawn.lines("OFFSET_AXIS")
    assert aside == ([(complex(joint.offset, window.low), complex(joint.offset, window.high))] if joint.offset else [])
    assert drawn.marks("DIMENSION") == pytest.approx(once([0j, joint.least, joint.centre]), rel=1e-9)
    assert np.array(drawn.lines("DIMENSION")) == pytest.approx(np.array([(0j, joint.least)]), rel=1e-9)
    # strokes of 4 mm at 60 degrees into the region, 2.5 mm apart
    hatches, scale = drawn.lines("HATCH"), drawn.paper.scale
    feet: dict[float, list[float]] = {}
    for foot, tip in hatches:
        assert abs(tip - foot) * scale == pytest.approx(4, rel=1e-9)
        a, slope = next((a, s) for a, s in joint.borders if abs(foot.imag - s * foot.real + a) < 1e-9)
        along = (1 + 1j * slope) / abs(1 + 1j * slope)
        assert (tip - foot) / abs(tip - foot) / along == pytest.approx(cmath.rect(1, -math.pi / 3), rel=1e-9)
        assert all(tip.imag <= s * tip.real - b + 1e-9 for b, s in joint.borders)
        assert tip.imag >= window.low
        feet.setdefault(slope, []).append((foot / along).real * scale)
    for steps in feet.values():
        assert np.diff(steps) == pytest.approx(2.5, rel=1e-9)
    assert len(feet) == len(joint.borders)


def test_an_angle_is_drawn_between_the_tangents_and_the_axis_of_abscissae() -> None:
    """The rising tangent meets the abscissae at the transmission angle; a flat's falling one at 180 degrees less it."""
    for follower, gamma, start in ((ROLLER.format(offset=0.0), 60.0, 0.0), (FLAT, None, 135.0)):
        made = picture(follower, gamma)
        joint, drawn = joint_of(made), Drawn(made)
        assert joint is not None
        arc = drawn.angle()
        a, slope = joint.borders[0]
        assert drawn.model(arc.centre) == pytest.approx(a / slope, rel=1e-12)
        assert math.degrees(arc.start_angle) == pytest.approx(start, abs=1e-9)
        assert math.degrees(arc.sweep) == pytest.approx(gamma or 45.0, rel=1e-12)
        assert abs(math.tan(arc.sweep)) == pytest.approx(abs(slope), rel=1e-9)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("follower", "gamma", "told"),
    [
        (ROLLER.format(offset=0.0), 60.0, {"S', mm/rad", "γmin = 60°", "O1"}),
        (ROLLER.format(offset=6.0), 60.0, {"S', mm/rad", "γmin = 60°", "O'1", "E = 6.00"}),
        (ROLLER.format(offset=0.0), None, {"S', mm/rad", "O1"}),
        (FLAT, None, {"S'', mm/rad²", "γmin = 45°", "O1", "Rmin = 40.00"}),
    ],
)
def test_words_of_a_joint_diagram_stand_beside_what_they_name(
    follower: str, gamma: float | None, told: set[str]
) -> None:
    made = picture(follower, gamma)
    joint, drawn = joint_of(made), Drawn(made)
    assert joint is not None
    assert made.gamma is not None
    # without an angle of the scene the cam's own is told
    angle = f"γ = {math.degrees(made.gamma):.2f}°"
    own = set() if gamma or made.cam.is_flat else {angle}
    least = "O'1" if joint.offset else "O1"
    radius = f"r0 = {abs(joint.least):.2f}"
    alone = {"O"} if (joint.centre != joint.least and gamma) or made.cam.is_flat else set()
    numbers = {t.text for t in drawn.canvas.texts if t.text[0].isdigit()}
    words = {t.text for t in drawn.canvas.texts} - numbers
    assert words == told | own | {"S, mm", "S0", radius} | alone
    window = drawn.window
    places = {
        "S, mm": 1j * window.high,
        "S0": 0j,
        least: joint.least,
        radius: joint.least / 2,
        "S'', mm/rad²" if made.cam.is_flat else "S', mm/rad": complex(window.right),
        "O": joint.centre,
        "E = 6.00": complex(joint.offset, window.high),
        "Rmin = 40.00": (joint.centre + joint.least) / 2,
    }
    for text in words & set(places):
        assert drawn.named(text, places[text]), text
    asked = {t.text: t.answer for t in drawn.canvas.texts}
    for text in words:
        if text.startswith("γ"):
            # beside the middle of the angle's arc
            arc = drawn.angle()
            middle = arc.centre + cmath.rect(arc.radius, arc.start_angle + arc.sweep / 2)
            assert drawn.named(text, drawn.model(middle))
            assert asked[text] is (False if gamma else None)
    assert asked.get("E = 6.00") is (False if joint.offset else None)
    small = {"S0", "E = 6.00"} | numbers
    assert {t.runs[0].height for t in drawn.canvas.texts if t.text in small} == {SMALL_TEXT}
    assert {drawn.size(t) for t in words - small} == {drawn.canvas.letters}
    # numbers of the positions, those in one place together: S and its derivatives are 0 where the cam rests below
    at = motion(made, np.radians([0, 30, 60, 90, 120, 150, 172.5, 195, 217.5, 240]), joint.order)
    held = [int(n) for text in numbers for n in text.split(", ")]
    assert sorted(held) == list(range(10))
    for text in numbers:
        first, *others = map(int, text.split(", "))
        assert drawn.named(text, at[first])
        assert all(abs(at[k] - at[first]) * drawn.paper.scale < 0.7 for k in others)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("sense", "way"), [("against", 1), ("with", -1)])
def test_a_swing_is_drawn_about_its_pivot(sense: str, way: int) -> None:
    """Pivot at 90, arm 70: the roller starts 48 from the axis, by the law of cosines, on the side of its sense."""
    made = picture(ARM.format(sense=sense), 50.0)
    swing, drawn = swing_of(made), Drawn(made)
    assert swing is not None
    inner = math.acos((90**2 + 70**2 - 48**2) / (2 * 90 * 70))
    lowest = 90 - cmath.rect(70, -way * inner)
    assert swing.pivot == 90
    assert swing.lowest == pytest.approx(lowest, rel=1e-9)
    angles = np.radians([0, 30, 60, 90, 120, 150, 172.5, 195, 217.5, 240])
    turn, rate = made.cam.motion.value(angles), made.cam.motion.value(angles, 1)
    ends = 90 + (lowest - 90) * np.exp(-1j * way * turn)
    feet = 90 + (ends - 90) * (1 + way * rate)
    arms, rates = np.array(drawn.lines("CONSTRUCTION")), np.array(drawn.lines("ORDINATE"))
    assert arms == pytest.approx(np.array(once(np.column_stack([np.full(10, 90), ends]))), rel=1e-9)
    assert rates == pytest.approx(np.array(once(np.column_stack([ends, feet]))), rel=1e-9)
    assert drawn.marks("JOINT_DIAGRAM") == pytest.approx(once(feet), rel=1e-9)
    (path,) = (s.curve for s in drawn.strokes if s.layer == "CENTRE")
    assert drawn.model(path.centre) == pytest.approx(90)
    assert path.radius == pytest.approx(70 * drawn.paper.scale, rel=1e-12)
    assert [drawn.model(path.point(t)) for t in path.domain] == pytest.approx([ends[0], ends[4]], rel=1e-9)
    # the curves of rise and return hold the points of all angles
    curves = [s.curve for s in drawn.strokes if s.layer == "JOINT_DIAGRAM" and not isinstance(s.curve, Arc)]
    assert len(curves) == 2
    for some, curve in zip((RISE, RETURN), curves, strict=True):
        run = drawn.model(curve.point(np.linspace(*curve.domain, 4001)))
        value, speed = made.cam.motion.value(some[1:-1:200]), made.cam.motion.value(some[1:-1:200], 1)
        for point in 90 + (lowest - 90) * np.exp(-1j * way * value) * (1 + way * speed):
            assert np.abs(run - point).min() < 0.02
    assert np.array(drawn.lines("AXIS")) == pytest.approx(np.array([(0j, 90)]), rel=1e-9)
    assert np.array(drawn.lines("DIMENSION")) == pytest.approx(np.array([(swing.lowest, swing.least)]), rel=1e-9)
    assert drawn.marks("DIMENSION") == pytest.approx([0j, 90, swing.lowest, swing.least], rel=1e-9)
    seen = [*ends, *feet, 0, 90, swing.least]
    xs, ys, box = np.real(seen), np.imag(seen), drawn.box
    size = max(box.right - box.left, box.high - box.low) / 1.24
    for room in (xs.min() - box.left, box.right - xs.max(), ys.min() - box.low, box.high - ys.max()):
        assert 0.1 * size < room < 0.2 * size
    words = {t.text for t in drawn.canvas.texts if not t.text[0].isdigit()}
    radius = f"r0d = {swing.least_radius:.2f}"
    assert words == {"O", "C", "B0", "O1", radius, "γmin = 50°"}
    places = {"O": 0j, "C": 90, "B0": lowest, "O1": swing.least, radius: (lowest + swing.least) / 2,
              "γmin = 50°": swing.least + (lowest - swing.least) / 4}  # fmt: skip
    for text, place in places.items():
        assert drawn.named(text, place), text
    assert {t.answer for t in drawn.canvas.texts if t.text == "γmin = 50°"} == {False}
    assert {t.answer for t in drawn.canvas.texts if t.text == radius} == {None}


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("sense", "way"), [("against", 1), ("with", -1)])
def test_a_swings_region_is_that_of_its_pressure_angles(sense: str, way: int) -> None:
    """tan nu = (L (1 + way psi') - d cos psi) / (d sin psi) about an axis anywhere, on rise and return."""
    made = picture(ARM.format(sense=sense), 50.0)
    swing, drawn = swing_of(made), Drawn(made)
    assert swing is not None
    turn, rate = (np.concatenate([made.cam.motion.value(t, k) for t in (RISE, RETURN)]) for k in (0, 1))
    start = swing.lowest - 90

    def kept(axis: complex) -> bool:
        towards = axis - 90
        psi = (np.angle(start / towards) * -way + turn) % (2 * math.pi)
        away = abs(towards)
        slope = np.abs(70 * (1 + way * rate) - away * np.cos(psi)) / (away * np.sin(psi))
        return bool(((np.sin(psi) > 0) & (slope <= math.tan(math.radians(40)))).all())

    def inside(axis: complex, by: float) -> bool:
        return all(((axis - foot) * normal.conjugate()).real >= by for foot, normal in swing.planes)

    rng = np.random.default_rng(5)
    tried = 0
    for x, y in rng.uniform(-150, 150, (200, 2)):
        axis = 90 + complex(x, y)
        if inside(axis, 0.5):
            tried += 1
            assert kept(axis)
        elif not inside(axis, -0.5):
            assert not kept(axis)
    assert tried > 5
    assert [abs(n) for _, n in swing.planes] == pytest.approx([1.0] * len(swing.planes), rel=1e-9)
    # the smallest cam's axis lies in the region, and nothing nearer to the roller does
    assert inside(swing.least, -1e-6)
    assert abs(swing.least - swing.lowest) == pytest.approx(swing.least_radius, rel=1e-9)
    for a in np.linspace(0, 2 * math.pi, 25):
        assert not inside(swing.lowest + cmath.rect(0.98 * swing.least_radius, a), 0.0)
    # its border within the window, hatched inwards
    border, scale = drawn.lines("GAMMA_TANGENT"), drawn.paper.scale
    assert border
    for a, b in border:
        middle, across = (a + b) / 2, 1j * (b - a) / abs(b - a)
        assert inside(middle + 1e-6 * across, -1e-9)
        assert not inside(middle - 1e-3 * across, 0.0)
    hatches = drawn.lines("HATCH")
    for foot, tip in hatches:
        assert abs(tip - foot) * scale == pytest.approx(4, rel=1e-9)
        a, b = min(
            border,
            key=lambda edge: (
                abs(((foot - edge[0]) / (edge[1] - edge[0])).imag)
                + max(0.0, abs(((foot - edge[0]) / (edge[1] - edge[0])).real - 0.5) - 0.5)
            ),
        )
        assert (tip - foot) / abs(tip - foot) / (b - a) * abs(b - a) == pytest.approx(
            cmath.rect(1, math.pi / 3), rel=1e-6
        )
        assert 0 <= ((foot - a) / (b - a)).real <= 1
        assert abs(((foot - a) / (b - a)).imag) < 1e-9
        assert drawn.window.left < tip.real < drawn.window.right
        assert drawn.window.low < tip.imag < drawn.window.high
    gaps = [abs(a[0] - b[0]) * scale for a, b in itertools.pairwise(hatches)]
    assert sum(gap == pytest.approx(2.5, abs=0.03) for gap in gaps) > 0.8 * len(gaps)
    length = sum(abs(b - a) for a, b in border) * scale
    assert 0.6 * length / 2.5 < len(hatches) <= length / 2.5 + 1


@pytest.mark.parametrize("follower", [ROLLER.format(offset=6.0), FLAT])
def test_by_hand_squared_paper_lies_about_the_axes(follower: str) -> None:
    drawn = Drawn(picture(follower), by_hand=True)
    scale, lines = drawn.paper.scale, drawn.lines("ORDINATE")
    for upright in (False, True):
        # those that what is named parts are two in a line
        across = np.unique([round(a.real if upright else a.imag, 9) for a, b in lines if (a.real == b.real) is upright])
        assert len(across) > 15
        assert np.diff(across) * scale == pytest.approx(2.5)
        # one line in the axis, from which students measure
        assert min(np.abs(across)) * scale < 1e-9
    # all that the diagram reaches lies on squares
    most, tall = (max(abs(a.real) for a, _ in lines), max(a.imag for a, _ in lines))
    shown = Drawn(picture(follower))
    curves = [s.curve for s in shown.strokes if s.layer == "JOINT_DIAGRAM"]
    reach = np.concatenate([curve.point(np.linspace(*curve.domain, 33)) for curve in curves])
    reach = (reach - shown.paper.origin) / scale
    assert most >= np.abs(reach.real).max()
    assert tall >= reach.imag.max()
    assert all(drawn.window.holds(p) for line in lines for p in line)


@pytest.mark.parametrize("follower", [ROLLER.format(offset=6.0), FLAT])
def test_by_hand_names_stand_at_the_axis_where_the_paper_ends(follower: str) -> None:
    """Before: over all squares, on a line to the end of the axis, in lesson 4 as it is handed out."""
    made = picture(follower)
    diagram = joint_of(made)
    assert diagram is not None
    window = diagram.window()
    drawn = Drawn(made, by_hand=True, area=Box(40.0, 60.0, 41.0 + 2 * window.wide, 61.0 + 2 * window.tall))
    assert drawn.paper.scale == 2.0
    leads = [s.curve.end for s in drawn.canvas.strokes[len(drawn.strokes) :]]
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 400)) for s in drawn.strokes])
    for text in drawn.canvas.texts:
        assert not text.box.holds(points)
        assert text.text == "S, mm" or all(abs(nearest(text.box, end) - end) > 1e-6 for end in leads)


def test_by_hand_the_axes_stand_alone_with_what_is_given() -> None:
    drawn = Drawn(picture(ROLLER.format(offset=6.0)), by_hand=True)
    assert {s.layer for s in drawn.strokes} == {"AXIS", "ORDINATE"}
    assert {t.text for t in drawn.canvas.texts} == {"S, mm", "S', mm/rad", "γmin = 60°"}
    drawn = Drawn(picture(ARM.format(sense="with"), 50.0), by_hand=True)
    assert np.array(drawn.lines("AXIS")) == pytest.approx(np.array([(0j, 90)]), rel=1e-9)
    assert drawn.marks("DIMENSION") == pytest.approx([0j, 90], rel=1e-9)
    assert len([s for s in drawn.strokes if s.layer != "ORDINATE"]) == 3
    assert {t.text for t in drawn.canvas.texts} == {"O", "C", "γmin = 50°"}
    assert {t.answer for t in drawn.canvas.texts if t.text.startswith("γ")} == {False}
    drawn = Drawn(picture(ROLLER.format(offset=0.0), None), by_hand=True)
    assert {t.text for t in drawn.canvas.texts} == {"S, mm", "S', mm/rad"}


def test_a_point_of_a_curve_that_turns_back_lies_on_it() -> None:
    """x = (t - 0.3)^2, a hairpin of 1e-5 mm, as S' over S of a measured motion has them: its nearest sample may lie
    on the other side, whence a sheet was told to be off by that.
    """
    hairpin = BSpline(2, np.array([0.0, 0, 0, 1, 1, 1]), np.array([0.09, -0.21 + 5e-6j, 0.49 + 1e-5j]))
    points = hairpin.point(np.linspace(0.0, 0.6, 301))
    # between the samples beside the bend both sides are one dip
    assert distance_by_sections(points, hairpin).max() < 1e-7
