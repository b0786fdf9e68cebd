"""What a sheet is made of: words and their room, boxes, scales, curves that are fitted once, lines of the standard."""

from __future__ import annotations

import cmath
import colorsys
import math
from typing import Any

import numpy as np
import pytest

from geometry.approximation.splines import SplineFit, fit_spline
from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.cams.plane.shape import cam_shape
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Carried, Curve
from geometry.curves.ellipse import EllipticArc
from geometry.curves.line_arc import Arc, Line
from parts.drawing.canvas import (
    SCALES,
    STYLES,
    Box,
    Canvas,
    Paper,
    Stroke,
    draw,
    fitted,
    rising_text,
    scale_name,
    scale_text,
    standard_scale,
    text_of,
    text_width,
)
from parts.scene.load import make_parts, scene_from_dict


def test_a_shape_in_three_places_lies_in_each() -> None:
    long, short, tolerance = 30.0, 12.0, 1e-3
    shape = EllipticArc(Arc(0j, long, 0.2, 1.9), short / long, Placement2())
    placements = [Placement2(0.3, 5 + 2j), Placement2(-2.0, 40 - 7j), Placement2(math.pi, 0j)]
    canvas = Canvas(0.0, 0.0, "")
    found = fitted(canvas, [Carried(shape, one) for one in placements], 0.5, tolerance)
    for spline, one in zip(found, placements, strict=True):
        assert isinstance(spline, BSpline)
        back = (spline.point(np.linspace(*spline.domain, 50)) - one.translation) * cmath.exp(-1j * one.angle)
        # off the ellipse by its implicit equation, to first order
        x, y = back.real, back.imag
        slope = 2 * np.hypot(x / long**2, y / short**2)
        assert np.abs((x**2 / long**2 + y**2 / short**2 - 1) / slope).max() < 1.01 * tolerance / 0.5
        for end, angle in ((back[0], 0.2), (back[-1], 2.1)):
            assert abs(end - complex(long * math.cos(angle), short * math.sin(angle))) < 1e-12
        # the same fit: its knots
        assert spline.knots is found[0].knots
    assert 0 < canvas.max_error <= tolerance


@pytest.mark.parametrize(
    ("most", "height", "narrow"),
    # natural lengths are those of capitals: 7, 5, 3.5, 2.5, 1.8 mm high
    [(None, 5.0, 1.0), (1.0, 5.0, 1.0), (0.9, 5.0, 0.9), (0.89, 3.5, 1.0), (0.5, 2.5, 1.0), (0.46, 2.5, 0.92),
     (0.2, 1.8, 0.2 * 5 / 1.8)],
)  # fmt: skip
def test_letters_are_narrowed_made_smaller_or_narrowed_as_far_as_they_must(
    most: float | None, height: float, narrow: float
) -> None:
    natural = text_width("Gear z", 5.0)
    made = text_of("Gear z", 3 + 4j, 5.0, None if most is None else (most + 1e-9) * natural)
    (run,) = made.runs
    assert (run.height, run.at, run.way) == (height, 3 + 4j, 1.0)
    assert run.width == pytest.approx(narrow * text_width("Gear z", height), rel=1e-6)
    assert made.box.left == 3
    assert made.box.right == pytest.approx(3 + run.width)
    assert (made.box.low, made.box.high) == pytest.approx((4 - 0.3 * height, 4 + 1.05 * height))


def test_a_height_that_is_none_of_the_standard_is_the_next_lower_one() -> None:
    heights = {6.9: 5.0, 3.5: 3.5, 1.9: 1.8, 1.0: 1.8}
    assert {asked: text_of("x", 0j, asked).runs[0].height for asked in heights} == heights


def test_an_index_stands_lower_by_a_fifth_and_is_one_size_smaller() -> None:
    made = text_of("d_{f2} = 5", 10 + 1j, 5.0)
    assert made.text == "df2 = 5"
    assert [(r.text, r.height) for r in made.runs] == [("d", 5.0), ("f2", 3.5), ("= 5", 5.0)]
    d, low, rest = made.runs
    assert (d.at, low.at.imag, rest.at.imag) == (10 + 1j, 0.0, 1.0)
    assert low.at.real == pytest.approx(10 + text_width("d", 5.0))
    assert rest.at.real == pytest.approx(low.at.real + text_width("f2", 3.5) + text_width(" ", 5.0))
    assert made.box.right == pytest.approx(rest.at.real + text_width("= 5", 5.0))
    assert text_width("d_{f2} = 5", 5.0) == pytest.approx(made.box.right - 10)
    # an index hangs lower than what is not
    assert made.box.low == pytest.approx(1 - max(0.2 * 5 + 0.3 * 3.5, 0.3 * 5))
    # every second piece is one, a space between two of them is nothing to be written
    both = text_of("a_{1} _{2}b", 0j, 5.0)
    assert [(r.text, r.height, r.at.imag) for r in both.runs] == [
        ("a", 5.0, 0.0), ("1", 3.5, -1.0), ("2", 3.5, -1.0), ("b", 5.0, 0.0)]  # fmt: skip
    assert both.text == "a1 2b"
    # the least letters have none smaller
    assert [r.height for r in text_of("d_{a}", 0j, 1.8).runs] == [1.8, 1.8]


def test_signs_of_per_cent_stand_apart_and_spaces_take_their_room() -> None:
    assert [r.text for r in text_of("5%% and 1%", 0j, 5.0).runs] == ["5%", "% and 1%"]
    (run,) = text_of("  x ", 0j, 5.0).runs
    assert (run.text, run.at.real) == ("x", pytest.approx(text_width("  ", 5.0)))
    assert text_of("  x ", 0j, 5.0).box.right == pytest.approx(text_width("  x ", 5.0))
    squeezed = text_of("  xxxxx", 0j, 1.8, 4.0)
    share = text_width("  ", 1.8) / text_width("  xxxxx", 1.8)
    assert squeezed.runs[0].at.real == pytest.approx(4.0 * share)
    # what the font lacks is as wide as it is high
    assert text_width("\u6c34", 5.0) == 5.0
    empty = text_of("", 2 + 3j, 5.0, 10.0)
    assert (empty.runs, empty.box) == ((), Box(2.0, 3.0, 2.0, 3 + 1.05 * 5))


@pytest.mark.parametrize("way", [1j, -1, -1j, 1])
def test_turned_words_lie_as_they_would_turned_about_their_beginning(way: complex) -> None:
    plain, found = text_of("x_{12}y", 0j, 3.5), rising_text("x_{12}y", 7 - 2j, 3.5, way=way)
    assert found.text == plain.text
    for one, two in zip(found.runs, plain.runs, strict=True):
        assert (one.text, one.height, one.width, one.way) == (two.text, two.height, two.width, way)
        assert one.at == pytest.approx(7 - 2j + way * two.at)
    corners = [
        7 - 2j + way * complex(x, y) for x in (plain.box.left, plain.box.right) for y in (plain.box.low, plain.box.high)
    ]
    xs, ys = sorted(c.real for c in corners), sorted(c.imag for c in corners)
    assert [found.box.left, found.box.low, found.box.right, found.box.high] == pytest.approx(
        [xs[0], ys[0], xs[-1], ys[-1]]
    )


def test_students_see_of_a_size_its_name_alone() -> None:
    """As long as the name is; of what they find out nothing, all of anything else."""
    size = text_of("d_{a} = 5.00", 0j, 3.5)
    (asked,) = size.asked()
    assert asked.text == "da ="
    assert [r.text for r in asked.runs] == ["d", "a", "="]
    assert asked.runs[-1].width == pytest.approx(text_width("=", 3.5))
    (plain,) = text_of("r = -5", 0j, 3.5).asked()
    assert [(r.text, r.width) for r in plain.runs] == [("r =", pytest.approx(text_width("r =", 3.5)))]
    for told in ("speed is 5", "two words = 5", "r = x"):
        assert [t.text for t in text_of(told, 0j).asked()] == [told]
    assert list(replace(text_of("5.00", 0j), answer=True).asked()) == []
    given = replace(size, answer=False)
    assert list(given.asked()) == [given]


def test_boxes_overlap_in_inner_points_alone() -> None:
    box = Box(0.0, 0.0, 4.0, 2.0)
    assert box.grown(0.5) == Box(-0.5, -0.5, 4.5, 2.5)
    apart = [(4.0, 0.0, 5.0, 2.0), (-1.0, -1.0, 5.0, 0.0), (-2.0, 0.5, 0.0, 1.0), (0.0, 2.0, 4.0, 3.0)]
    across = [
        (3.9, 1.9, 5.0, 3.0),
        (-0.1, 0.0, 4.0, 2.0),
        (0.0, -0.1, 4.0, 2.0),
        (0.0, 0.0, 4.1, 2.0),
        (0.0, 0.0, 4.0, 2.1),
    ]
    within = [(1.0, 0.5, 2.0, 1.0), (0.0, 0.0, 4.0, 2.0)]
    for sides in (*apart, *across, *within):
        other = Box(*sides)
        assert box.overlaps(other) is other.overlaps(box) is (sides not in apart)
        assert other.within(box) is (sides in within)
    points = np.array([0j, 1 + 1j, 3.9 + 1.9j, 4 + 1j, 1 + 2j, -1 + 1j, 1 - 1j, 5 + 1j, 1 + 3j, 0.1 + 0.1j])
    assert box.holds(points) == 3


def test_a_canvas_has_its_frame_and_what_stands_about_it() -> None:
    """GOST 2.104: 20 mm free on the left, 5 mm elsewhere; a block takes a band, its columns stand outside."""
    canvas = Canvas(297.0, 210.0, "A4", band=55.0, columns=12.0, foot=3.0)
    assert canvas.frame == Box(20.0, 5.0, 292.0, 205.0)
    assert canvas.content == Box(20.0, 60.0, 292.0, 205.0)
    assert canvas.reach == Box(8.0, 2.0, 292.0, 205.0)
    assert Canvas(297.0, 210.0, "A4", margins=(8.0, 7.0)).frame == Box(8.0, 7.0, 290.0, 203.0)
    assert [Canvas(w, h, "").letters for w, h in ((420.0, 297.0), (297.0, 420.0), (421.0, 297.0), (297.0, 421.0))] == [
        2.5, 2.5, 3.5, 3.5]  # fmt: skip


def test_strokes_are_those_asked_for() -> None:
    canvas = Canvas(100.0, 100.0, "")
    canvas.box("TABLE", Box(1.0, 2.0, 5.0, 4.0))
    canvas.line("FRAME", 0j, 3 + 4j)
    canvas.add("TABLE", Arc(0j, 1.0, 0.0, 1.0))
    ends = [
        (s.layer, complex(s.curve.point(s.curve.domain[0])), complex(s.curve.point(s.curve.domain[1])))
        for s in canvas.strokes
    ]
    assert ends[:4] == [
        ("TABLE", a, b) for a, b in ((1 + 2j, 5 + 2j), (5 + 2j, 5 + 4j), (5 + 4j, 1 + 4j), (1 + 4j, 1 + 2j))
    ]
    assert ends[4] == ("FRAME", 0j, 3 + 4j)
    # in the order of styles, not in that of strokes
    assert canvas.layers == ["FRAME", "TABLE"]
    assert (
        canvas.write("x", 1 + 1j, 3.5, answer=True)
        == canvas.texts[0]
        == replace(text_of("x", 1 + 1j, 3.5), answer=True)
    )
    canvas.write_rising("y", 1 + 1j, 2.5, 100.0, -1)
    assert canvas.texts[1] == rising_text("y", 1 + 1j, 2.5, 100.0, -1)


def test_squared_paper_has_a_line_every_2_5_mm() -> None:
    canvas = Canvas(100.0, 100.0, "")
    canvas.squares(Box(10.0, 20.0, 21.0, 30.0))
    lines = [
        (complex(s.curve.point(s.curve.domain[0])), complex(s.curve.point(s.curve.domain[1]))) for s in canvas.strokes
    ]
    upright = [(complex(x, 20), complex(x, 30)) for x in (10.0, 12.5, 15.0, 17.5, 20.0)]
    level = [(complex(10, y), complex(21, y)) for y in (20.0, 22.5, 25.0, 27.5, 30.0)]
    assert lines == upright + level
    assert {s.layer for s in canvas.strokes} == {"ORDINATE"}
    # a whole number of squares ends with one
    whole = Canvas(100.0, 100.0, "")
    whole.squares(Box(0.1, 0.1, 7.6, 5.1))
    assert len(whole.strokes) == 4 + 3


def test_obstacles_are_points_of_all_strokes_half_a_millimetre_apart() -> None:
    canvas = Canvas(100.0, 100.0, "")
    assert canvas.obstacles().tolist() == []
    canvas.line("FRAME", 0j, 10 + 0j)
    canvas.line("FRAME", 5j, 0.1 + 5j)
    canvas.add("FRAME", Arc(50 + 50j, 10.0, 0.0, math.pi))
    canvas.line("FRAME", 0j, 3000j)
    found = canvas.obstacles()
    line, short, arc, long = np.split(found, [20, 22, 22 + 62])
    assert line == pytest.approx(np.linspace(0, 10, 20))
    assert short == pytest.approx(np.array([5j, 0.1 + 5j]))
    assert arc == pytest.approx(50 + 50j + 10 * np.exp(1j * np.linspace(0, math.pi, 62)))
    assert len(long) == 4000


@pytest.mark.parametrize("power", [-3, -1, 0, 2])
def test_a_scale_is_the_least_round_one_that_is_not_below(power: int) -> None:
    for needed, found in (
        (1.0, 1.0),
        (1.01, 2.0),
        (2.0, 2.0),
        (2.1, 2.5),
        (2.6, 4.0),
        (4.1, 5.0),
        (5.1, 10.0),
        (9.99, 10.0),
    ):
        assert standard_scale(needed * 10.0**power) == pytest.approx(found * 10.0**power, rel=1e-12)
    assert standard_scale(2.0 * 10.0**power * (1 + 5e-10)) == pytest.approx(2.0 * 10.0**power)
    assert standard_scale(2.0 * 10.0**power * (1 + 2e-9)) == pytest.approx(2.5 * 10.0**power)


@pytest.mark.parametrize("needed", [0.0, -1.0, math.inf, math.nan])
def test_no_scale_is_made_of_nothing(needed: float) -> None:
    with pytest.raises(ParameterError) as caught:
        standard_scale(needed)
    assert (caught.value.name, caught.value.code) == ("scale", "not_finite_above_zero")


def test_scales_are_told_as_the_standard_has_them() -> None:
    """GOST 2.302: enlarged and made smaller; 1:1 is as it is."""
    assert [scale_name(s) for s in (2.0, 2.5, 1.0, 0.5, 0.4, 100.0)] == ["2:1", "2.5:1", "1:1", "1:2", "1:2.5", "100:1"]
    assert [scale_text(0.4, language) for language in ("en", "uk")] == ["1:2.5", "1:2,5"]
    # the greatest first, each as large as its name says
    named = [100, 50, 40, 20, 10, 5, 4, 2.5, 2, 1]
    down = [2, 2.5, 4, 5, 10, 15, 20, 25, 40, 50, 75, 100, 200, 400, 500, 800, 1000]
    assert list(SCALES) == pytest.approx([*named, *(1 / x for x in down)])


def test_paper_enlarges_and_moves_every_curve() -> None:
    paper = Paper(2.5, 10 + 20j)
    assert paper.point(3 - 1j) == 17.5 + 17.5j
    spline = BSpline(2, np.array([0.0, 0, 0, 1, 1, 1]), np.array([0, 1 + 1j, 2]))
    for curve in (Line(1j, 4 + 0j), Arc(1 + 1j, 3.0, 0.5, -2.0), spline):
        t = np.linspace(*curve.domain, 5)
        assert paper.scaled(curve).point(t) == pytest.approx(10 + 20j + 2.5 * curve.point(t))
    canvas = Canvas(100.0, 100.0, "")
    draw(canvas, "CAM", [Line(1j, 4 + 0j)], paper)
    assert canvas.strokes == [Stroke("CAM", Line(10 + 22.5j, 20 + 20j))]


def test_mirror_images_share_one_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cubic, twice continuously differentiable; its error is told on paper."""
    fits: list[SplineFit] = []
    asked: list[float] = []

    def fit(curve: Curve, tolerance: float, **more: Any) -> SplineFit:
        asked.append(tolerance)
        fits.append(fit_spline(curve, tolerance, **more))
        return fits[-1]

    monkeypatch.setattr("parts.drawing.canvas.fit_spline", fit)
    shape = EllipticArc(Arc(0j, 30.0, 0.25, 1.75), 0.5, Placement2())
    canvas, line = Canvas(0.0, 0.0, ""), Line(0j, 1 + 0j)
    one, two, three = fitted(canvas, [shape, shape.mirrored(), line], 2.0, 1e-3)
    assert three is line
    assert isinstance(one, BSpline)
    assert isinstance(two, BSpline)
    (made,) = fits
    assert made.spline is one
    assert (asked, one.degree) == ([5e-4], 3)
    ends = [np.conj(two.point(np.array(two.domain))), one.point(np.array(one.domain))]
    assert sorted(ends[0], key=lambda z: z.imag) == pytest.approx(sorted(ends[1], key=lambda z: z.imag))
    inner = np.unique(one.knots, return_counts=True)[1][1:-1]
    assert len(inner) == 0 or inner.max() == 1
    assert canvas.max_error == pytest.approx(2 * made.max_error)
    assert canvas.sampled is (made.bound == "sampled")
    fitted(canvas, [EllipticArc(Arc(0j, 1.0, 0.2, 0.1), 0.4, Placement2())], 2.0, 1.0)
    assert canvas.max_error == pytest.approx(2 * made.max_error)


# what AutoCAD shows for an index: hue of a colour, or black and grey
HUES = {1: 0, 30: 30, 3: 120, 4: 180, 5: 240, 6: 300}


@pytest.mark.parametrize("layer", STYLES)
def test_a_layer_has_one_colour_in_both_formats_and_a_width_of_the_standard(layer: str) -> None:
    """Widths of ISO 128-20 or those a DXF file knows, dashes of GOST 2.303; index 7 is black, 8 grey."""
    style = STYLES[layer]
    red, green, blue = (int(style.colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    hue, _, _ = colorsys.rgb_to_hsv(red, green, blue)
    if style.aci in HUES:
        assert abs((360 * hue - HUES[style.aci] + 180) % 360 - 180) < 20
        assert max(red, green, blue) - min(red, green, blue) > 0.4
    else:
        assert red == green == blue
        assert style.aci == (7 if red < 0.3 else 8)
    assert round(100 * style.width, 6) in (13, 18, 25, 35, 50, 60, 70, 90, 100)
    if style.dashes:
        dash, gap, *rest = style.dashes
        if rest:
            # a dash and one dot, or two
            dots, gaps = rest[::2], [gap, *rest[1::2]]
            assert (len(dots), len(gaps)) in ((1, 2), (2, 3))
            assert (5 <= dash <= 30, set(gaps) == {gap}, max(dots) < 1) == (True, True, True)
            assert 2 + len(dots) <= sum(dots) + sum(gaps) <= 4 + len(dots)
        else:
            assert (2 <= dash <= 8, 1 <= gap <= 2) == (True, True)


def test_squares_are_whole_about_what_is_left_out_at_their_right_side() -> None:
    """Of 8 by 8 squares 2 by 2 beside the right end, two above the lowest: three lines end at them, none beside."""
    canvas = Canvas(0.0, 0.0, "")
    canvas.squares(Box(0.0, 0.0, 20.0, 20.0), Box(15.0, 5.0, 20.0, 10.0))
    lines = [(complex(s.curve.start), complex(s.curve.end)) for s in canvas.strokes if isinstance(s.curve, Line)]
    upright = [(k * 2.5 + 0j, k * 2.5 + 20j) for k in range(7)]
    parted = [(x + low, x + high) for x in (17.5, 20.0) for low, high in ((0j, 5j), (10j, 20j))]
    level = [(k * 2.5j, k * 2.5j + (15 if k == 3 else 20)) for k in range(9)]
    assert lines == [*upright, *parted, *level]


def test_a_curve_that_no_single_spline_follows_is_cut_at_its_knots() -> None:
    """Its DXF for CAD held 1e-6 mm, its sheet was refused: over all rows of a table 512 spans were not enough.

    What is drawn is held to rollers about the follower's places: the envelope is 6 mm from the nearest of them.
    """
    rows = [(0, 0), (30, 4), (60, 12), (90, 20), (150, 20), (180, 16), (210, 8), (240, 0), (300, 0)]
    keys = {"kind": "cam", "follower": "roller", "follower_radius": 6.0, "base_circle_radius": 30.0,
            "motion_table": [list(map(float, row)) for row in rows]}  # fmt: skip
    cam = make_parts(scene_from_dict({"parts": {"p": keys}}, "s", "s"), "s")[0]["p"].thing
    canvas = Canvas(297.0, 210.0, "A4")
    made = fitted(canvas, [segment.curve for segment in cam_shape(cam).profile.period], 1.0, 1e-6)
    assert len(made) == len(rows)
    assert canvas.max_error <= 1e-6
    for one, other in zip(made, (*made[1:], made[0]), strict=True):
        assert abs(one.point(one.domain[1]) - other.point(other.domain[0])) < 1e-9
    angles = np.linspace(0, math.tau, 40_001)
    centres = (36 + cam.motion.value(angles)) * np.exp(1j * (math.pi / 2 - angles))
    for one in made:
        drawn = one.point(np.linspace(*one.domain, 7))
        least = np.array([np.abs(centres - place).min() for place in drawn])
        assert np.abs(least - 6).max() < 2e-6
