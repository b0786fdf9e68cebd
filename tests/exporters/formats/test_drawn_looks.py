"""Entities of a drawing that ezdxf has in memory: curves at their shares, what hides or lifts them, dimensions."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing
from ezdxf.enums import TextEntityAlignment

from exporters.formats.read_drawing import DrawnArc, DrawnLine, DrawnSpline, dimensions, drawn, look_of
from parts.base.readback import ReadError

SHARES = np.array([0.0, 0.25, 1.0])


def document() -> Drawing:
    """A layer with a line, an arc, a circle, a spline and words; a layer for dashes."""
    made = ezdxf.new("R2010", setup=False)
    made.layers.add("OWN", color=3)
    made.layers.add("OTHER", color=1)
    space = made.modelspace()
    space.add_line((1, 2), (5, 8), dxfattribs={"layer": "OWN"})
    space.add_arc((3, 4), 2.5, 350, 20, dxfattribs={"layer": "OWN"})
    space.add_circle((3, 4), 1.5, dxfattribs={"layer": "OWN"})
    space.add_spline(dxfattribs={"layer": "OWN"}).apply_construction_tool(
        ezdxf.math.BSpline([(0, 0), (1, 3), (4, 3), (6, 0), (9, 1)], order=4)
    )
    text = space.add_text("Wheel", height=3.5, dxfattribs={"layer": "OWN"})
    text.set_placement((1, 1), (11, 1), align=TextEntityAlignment.FIT)
    return made


def test_curves_and_words_are_told_in_the_order_of_the_file() -> None:
    curves, words = drawn(document(), "sheet")
    line, arc, circle, spline = curves
    assert line == DrawnLine("OWN", 1 + 2j, 5 + 8j)
    assert arc == DrawnArc("OWN", 3 + 4j, 2.5, 350, 20)
    assert circle == DrawnArc("OWN", 3 + 4j, 1.5, 0, 360)
    assert (arc.sweep, circle.sweep) == (30, 360)
    assert isinstance(spline, DrawnSpline)
    assert (spline.layer, spline.dash) == ("OWN", False)
    (word,) = words
    assert (word.layer, word.text, word.left, word.right, word.height) == ("OWN", "Wheel", 1 + 1j, 11 + 1j, 3.5)


def test_lines_and_arcs_are_at_their_shares() -> None:
    """An arc from -10 to 20 degrees: six spans of 5; a circle of 72; of short ones 25 samples, of long ones 250."""
    line, arc, circle, _ = drawn(document(), "sheet")[0]
    assert line.spans(SHARES) == pytest.approx(np.array([[1 + 2j, 2 + 3.5j, 5 + 8j]]))
    assert line.samples() == pytest.approx((1 + 2j) + (4 + 6j) * np.linspace(0, 1, 25))

    def at(centre: complex, radius: float, degrees: np.ndarray) -> np.ndarray:
        return centre + radius * np.exp(1j * np.radians(degrees))

    assert arc.spans(SHARES) == pytest.approx(at(3 + 4j, 2.5, -10 + 5 * (np.arange(6)[:, None] + SHARES)), abs=1e-12)
    assert arc.samples() == pytest.approx(at(3 + 4j, 2.5, np.linspace(-10, 20, 25)), abs=1e-12)
    assert circle.spans(SHARES) == pytest.approx(at(3 + 4j, 1.5, 5 * (np.arange(72)[:, None] + SHARES)), abs=1e-12)
    assert circle.samples() == pytest.approx(at(3 + 4j, 1.5, np.linspace(0, 360, 250)), abs=1e-12)
    # two spans at least, so that an arc has a middle
    assert DrawnArc("OWN", 0j, 1.0, 0.0, 4.0).spans(SHARES).shape == (2, 3)
    assert DrawnArc("OWN", 0j, 1.0, 0.0, 10.1).spans(SHARES).shape == (3, 3)
    for degrees, count in ((89.9, 25), (90.0, 250)):
        assert len(DrawnArc("OWN", 0j, 1.0, 10.0, 10.0 + degrees).samples()) == count


def test_splines_are_those_of_scipy_span_by_span() -> None:
    from scipy.interpolate import BSpline

    *_, spline = drawn(document(), "sheet")[0]
    poles = np.array([0, 1 + 3j, 4 + 3j, 6, 9 + 1j])
    # order 4, uniform within: one inner knot, whatever the scale of the knots
    knots = np.array(spline.tool.knots())
    exact = BSpline(knots, np.column_stack([poles.real, poles.imag]), 3)
    breaks = np.unique(knots)
    assert len(breaks) == 3
    places = breaks[:-1, None] + np.diff(breaks)[:, None] * SHARES
    found = spline.spans(SHARES)
    assert found.real == pytest.approx(exact(places)[..., 0], abs=1e-12)
    assert found.imag == pytest.approx(exact(places)[..., 1], abs=1e-12)
    # its poles turn by atan(3) + atan(3 / 2) + (atan(3 / 2) + atan(1 / 3)), more than a quarter of a turn
    turn = math.atan(3) + math.atan(1.5) + math.atan(1.5) + math.atan(1 / 3)
    assert turn > math.pi / 2
    samples = spline.samples()
    assert len(samples) == 250
    assert samples.real == pytest.approx(exact(np.linspace(breaks[0], breaks[-1], 250))[:, 0], abs=1e-12)
    flat = ezdxf.math.BSpline([(0, 0), (1, 0.5), (4, 1), (6, 1), (9, 0.9)], order=4)
    assert len(DrawnSpline("OWN", flat, False).samples()) == 25


def entity(kind: str, change: Callable[[Any], object]) -> Callable[[Drawing], object]:
    return lambda made: change(next(e for e in made.modelspace() if e.dxftype() == kind))


def says(name: str, value: object, kind: str = "LINE") -> Callable[[Drawing], object]:
    return entity(kind, lambda one: one.dxf.set(name, value))


LOOKS: dict[str, tuple[object, object]] = {
    # what an entity may say, and what it may not
    "invisible": (0, 1), "color": (256, 5), "linetype": ("BYLAYER", "CONTINUOUS"), "lineweight": (-1, 50),
    "ltscale": (1.0, 2.0), "thickness": (0.0, 1.0), "extrusion": ((0, 0, 1), (0, 0, -1)), "paperspace": (0, 1),
}  # fmt: skip
WORDS: dict[str, tuple[object, object]] = {
    "rotation": (0.0, 10.0), "oblique": (0.0, 5.0), "text_generation_flag": (0, 2), "color": (256, 1)
}  # fmt: skip


@pytest.mark.parametrize("name", LOOKS)
def test_nothing_but_a_layer_says_how_a_line_looks(name: str) -> None:
    """What is as if it were not said hurts none."""
    same, other = LOOKS[name]
    for kind in ("LINE", "ARC", "CIRCLE"):
        made = document()
        says(name, same, kind)(made)
        assert len(drawn(made, "sheet")[0]) == 4
        says(name, other, kind)(made)
        with pytest.raises(ReadError, match=f"a {kind} on layer OWN has {name} = "):
            drawn(made, "sheet")


@pytest.mark.parametrize("name", WORDS)
def test_words_stand_as_they_are_written(name: str) -> None:
    same, other = WORDS[name]
    made = document()
    says(name, same, "TEXT")(made)
    assert len(drawn(made, "sheet")[1]) == 1
    says(name, other, "TEXT")(made)
    with pytest.raises(ReadError, match=f"a TEXT on layer OWN has {name} = "):
        drawn(made, "sheet")


FAULTS: dict[str, tuple[Callable[[Drawing], object], str]] = {
    "true colour": (says("true_color", 0xFF00), "a LINE on layer OWN has true_color"),
    "see-through": (says("transparency", 0x02000080), "a LINE on layer OWN has transparency"),
    "lifted end": (says("end", (5, 8, 1)), "a LINE on layer OWN is lifted out of its plane"),
    "lifted centre": (says("center", (3, 4, -1), "ARC"), "a ARC on layer OWN is lifted"),
    "lifted pole": (entity("SPLINE", lambda s: s.control_points.__setitem__(1, (1, 3, 0.5))), "a SPLINE on layer OWN"),
    "a point": (lambda made: made.modelspace().add_point((1, 1), dxfattribs={"layer": "OWN"}), "a POINT stands in the"),
    "no such layer": (says("layer", "NOWHERE"), "layer NOWHERE is not in the layer table"),
    "off": (lambda made: made.layers.get("OWN").off(), "layer OWN is off"),
    "frozen": (lambda made: made.layers.get("OWN").freeze(), "layer OWN is frozen"),
    "not plotted": (lambda made: made.layers.get("OWN").dxf.set("plot", 0), "layer OWN is not plotted"),
    "coloured": (lambda made: made.layers.get("OWN").dxf.set("true_color", 0xFF00), "layer OWN has a colour beside"),
    "pale": (lambda made: setattr(made.layers.get("OWN"), "transparency", 0.5), "layer OWN is transparent"),
}  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
def test_what_hides_or_lifts_is_told(name: str) -> None:
    change, said = FAULTS[name]
    made = document()
    change(made)
    with pytest.raises(ReadError, match=said):
        drawn(made, "sheet")


def test_what_other_layers_are_is_no_matter() -> None:
    made = document()
    made.layers.get("OTHER").off()
    made.layers.get("OWN").lock()
    assert len(drawn(made, "sheet")[0]) == 4
    assert look_of(made, "OWN") == (3, "CONTINUOUS")


def test_a_drawing_has_no_words_and_a_sheet_dashes_of_splines_alone() -> None:
    made = document()
    with pytest.raises(ReadError, match="a TEXT stands in the drawing"):
        drawn(made)
    next(iter(made.modelspace().query("TEXT"))).destroy()
    assert len(drawn(made)[0]) == 4
    says("linetype", "CONTINUOUS", "SPLINE")(made)
    assert drawn(made, "sheet")[0][3].dash
    with pytest.raises(ReadError, match="a SPLINE on layer OWN has linetype = CONTINUOUS"):
        drawn(made)


def measured(**attributes: Any) -> Drawing:
    """A drawing with a dimension of 40 mm at 1:2, as it is told, beside a line."""
    made = document()
    made.dimstyles.new("OF_PAPER", {"dimlfac": 2.0})
    block = made.blocks.new_anonymous_block(type_char="D")
    block.add_line((0, 5), (20, 5), dxfattribs={"layer": "OTHER"})
    told = {
        "layer": "OWN", "dimstyle": "OF_PAPER", "geometry": block.name, "text": "<>", "dimtype": 32,
        "defpoint": (20, 5, 0), "defpoint2": (0, 0, 0), "defpoint3": (20, 0, 0), "angle": 0.0,
        "actual_measurement": 40.0,
    }  # fmt: skip
    made.modelspace().new_entity("DIMENSION", told | attributes)
    return made


def test_dimensions_measure_their_own_points_by_the_scale_of_their_style() -> None:
    (found,) = dimensions(measured(text="%%c<>"))
    assert (found.value, found.text) == (pytest.approx(40.0), "%%c<>")
    # what it consists of is drawn too
    curves, _ = drawn(measured(), "sheet")
    assert DrawnLine("OTHER", 5j, 20 + 5j) in curves
    assert dimensions(document()) == []


@pytest.mark.parametrize(("attributes", "said"), [
    ({"actual_measurement": 40.0001}, "a DIMENSION of 40 mm says that it measures otherwise"),
    ({"actual_measurement": 39.9999}, "a DIMENSION of 40 mm says"), ({"dimstyle": "NONE"}, "has the style NONE"),
    ({"defpoint": (20, 5.001, 0)}, "a DIMENSION of 40 mm is told elsewhere than it is drawn"),
    ({"geometry": "*D9"}, "a DIMENSION has no block of lines"),
    ({"invisible": 1}, "a DIMENSION on layer OWN has invisible"),
])  # fmt: skip
def test_a_dimension_that_lies_or_hides_is_told(attributes: dict[str, Any], said: str) -> None:
    made = measured(**attributes)
    with pytest.raises(ReadError, match=said):
        [*dimensions(made), *drawn(made, "sheet")]


@pytest.mark.parametrize(("attributes", "said"), [
    ({}, ""),
    ({"actual_measurement": 0.9274}, "53.1301 degrees says that it measures otherwise"),
    ({"defpoint": (4.0, 6.01, 0)}, "degrees says that it measures otherwise"),
    ({"defpoint4": (1.0, 2.01, 0)}, "has lines that begin at two places"),
    ({"defpoint5": (11.0, 1.0, 0)}, "has its arc on the other side"),
    ({"defpoint5": (8.1, 7.1, 0)}, "is told elsewhere than it is drawn"),
    ({"defpoint3": (4, 6, 0), "defpoint": (5, 2, 0)}, "306.87 degrees has its arc on the other side"),
])  # fmt: skip
def test_an_angular_dimension_measures_its_own_lines(attributes: dict[str, Any], said: str) -> None:
    """Of the triangle 3, 4, 5, the angle whose tangent is 4/3."""
    made = document()
    made.dimstyles.new("OF_PAPER", {"dimlfac": 2.0})
    block = made.blocks.new_anonymous_block(type_char="D")
    block.add_arc((1, 2), math.hypot(7, 5), 0, 60, dxfattribs={"layer": "OTHER"})
    told = {
        "layer": "OWN", "dimstyle": "OF_PAPER", "geometry": block.name, "text": "53%%d", "dimtype": 34,
        "defpoint2": (1, 2, 0), "defpoint3": (5, 2, 0), "defpoint4": (1, 2, 0), "defpoint": (4, 6, 0),
        "defpoint5": (8, 7, 0), "actual_measurement": math.atan2(4, 3),
    }  # fmt: skip
    made.modelspace().new_entity("DIMENSION", told | attributes)
    if said:
        with pytest.raises(ReadError, match=said):
            dimensions(made)
    else:
        (found,) = dimensions(made)
        assert (found.value, found.text) == (pytest.approx(math.degrees(math.atan2(4, 3))), "53%%d")


@pytest.mark.parametrize("off", [3.9e-5, 4.1e-5])
def test_a_dimension_is_right_to_a_millionth_of_itself(off: float) -> None:
    made = measured(actual_measurement=40 + off)
    if off < 4e-5:
        assert len(dimensions(made)) == 1
    else:
        with pytest.raises(ReadError, match="measures otherwise"):
            dimensions(made)


def test_an_arc_turns_left_from_its_first_angle_to_its_last() -> None:
    """As ezdxf has its ends, whatever turn they are told in."""
    for first, last in ((10.0, 200.0), (300.0, 30.0), (-20.0, 20.0), (90.0, 90.0)):
        points = DrawnArc("OWN", 1 + 1j, 2.0, first, last).samples()
        assert points[0] == pytest.approx(1 + 1j + 2 * cmath.exp(1j * math.radians(first)), abs=1e-12)
        assert points[-1] == pytest.approx(1 + 1j + 2 * cmath.exp(1j * math.radians(last)), abs=1e-12)
        turns = np.diff(np.unwrap(np.angle(points - (1 + 1j))))
        assert (turns > 0).all()
        assert turns.sum() == pytest.approx(math.radians((last - first) % 360 or 360))
