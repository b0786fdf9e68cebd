"""The picture of a lever mechanism, of known places: every mark stands where its panel's own scale has it."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from exporters.documents.topics import calculate
from parts.base.texts import words
from parts.mates.pages.lever_picture import LeverPicture, Plan, Run, Vector

SVG = "{http://www.w3.org/2000/svg}"
ANGLE = np.linspace(0.0, 360.0, 361)
TURN = np.radians(ANGLE)
FIXED = {"O1": 0j, "O3": 1 - 2j}
POINTS = {"A": 1 + 0j, "B": 3 + 1j, "C": 2 + 4j}
# a circle through A and a point that swings: the drawing is from -1 to 3 wide and from -2 to 4 high
PATHS = {"A": np.exp(1j * TURN), "B": 3 + 1j * np.cos(TURN)}
# of the velocity plan: two vectors from the pole, the third between their ends, and one too short for an arrow
SPEEDS = Plan((Vector("a", 0j, 3 + 4j), Vector("b", 0j, -3 + 4j), Vector("ba", 3 + 4j, -3 + 4j),
               Vector("s", 0j, -0.02 + 0j)), 1.0)  # fmt: skip
TRAVEL = (20 + 10 * np.sin(TURN), 2 * np.cos(TURN) - 1, -3 - np.sin(TURN))
SERIES = tuple(zip(("S", "V", "a"), ("mm", "m/s", "m/s2"), TRAVEL, strict=True))
RUN = Run(ANGLE, 50 + 50 * np.cos(TURN), 50.0, 30 * np.sin(TURN), 10 * np.cos(TURN), np.sin(TURN) - 5)
COLOURS = ("#c03020", "#2060c0", "#209050", "#a06000", "#8030a0", "#008090", "#606060", "#d06090")


@cache
def drawn(stone: bool = False, run: bool = True) -> ET.Element:
    # the stone lies along O3A, the block at B along a guide at 30 degrees
    blocks = {"A": 2j, "B": np.exp(1j * np.pi / 6)} if stone else {}
    picture = LeverPicture(POINTS, PATHS, FIXED, blocks, SPEEDS, SPEEDS, ANGLE, SERIES, RUN if run else None)
    return ET.fromstring(picture.svg(words("en")))


def panel(name: str, root: ET.Element | None = None) -> ET.Element:
    found = drawn() if root is None else root
    return next(g for g in found.iter(f"{SVG}g") if str(next(iter(g)).text).startswith(name))


def chain(line: ET.Element) -> np.ndarray:
    """Points of a polyline or polygon, y up."""
    pairs = np.array([[float(n) for n in p.split(",")] for p in line.attrib["points"].split()])
    return pairs[:, 0] - 1j * pairs[:, 1]


def style(element: ET.Element) -> dict[str, str]:
    return dict(p.split(":") for p in element.attrib["style"].split(";"))


def centre(circle: ET.Element) -> complex:
    return complex(float(circle.attrib["cx"]), -float(circle.attrib["cy"]))


def side() -> float:
    """The width of a panel's field: that of its axis of angles."""
    return float(next(panel("Reduced").iter(f"{SVG}line")).attrib["x2"])


def corners(text: ET.Element) -> list[complex]:
    """Of the room that a name takes, letters of 13 px being hardly wider than 7.5 on the whole, y up."""
    assert style(text)["text-anchor"] == "middle"
    foot, half = complex(float(text.attrib["x"]), -float(text.attrib["y"])), 7.5 * len("".join(text.itertext())) / 2
    return [foot + x + 1j * y for x in (-half, half) for y in (-2.5, 9.5)]


def corner(group: ET.Element) -> complex:
    """Where a panel stands, y down."""
    return complex(*map(float, group.attrib["transform"][len("translate(") : -1].split()))


@pytest.mark.parametrize("run", [False, True])
def test_panels_stand_two_by_two_with_the_same_room_about_each(run: bool) -> None:
    root = drawn(run=run)
    groups = list(root.iter(f"{SVG}g"))
    assert len(groups) == (6 if run else 4)
    first, free = corner(groups[0]), corner(groups[0]).real
    across, down = side() + 2 * free, side() + free + first.imag
    for k, group in enumerate(groups):
        assert corner(group) == first + complex(k % 2 * across, k // 2 * down)
        title = next(iter(group))
        # the title's line lies in the room above its panel
        assert float(title.attrib["x"]) == 0
        assert -(first.imag - free) < float(title.attrib["y"]) < 0
    size = (2 * across, len(groups) // 2 * down)
    assert [float(n) for n in root.attrib["viewBox"].split()] == [0, 0, *size]
    assert (float(root.attrib["width"]), float(root.attrib["height"])) == size


def test_the_scheme_fills_its_panel_by_one_scale() -> None:
    """6 high and 4 wide: the height decides, (1, 1) lies in the middle."""

    def at(z: complex) -> complex:
        return (z - (1 + 1j)) * side() / 6 + side() * (0.5 - 0.5j)

    group = panel("Scheme")
    circles = list(group.iter(f"{SVG}circle"))
    known = {**FIXED, **POINTS}
    texts = [t for t in group.iter(f"{SVG}text") if "".join(t.itertext()) in known]
    for name, circle, text in zip(known, circles, texts, strict=True):
        assert "".join(text.itertext()) == name
        assert centre(circle) == pytest.approx(at(known[name]), abs=0.0071)
        assert style(circle)["fill"] == ("#202830" if name in FIXED else "#ffffff")
        # near its joint, clear of its ring: no corner of 8 px letters is within, and all are within 40 px
        assert 4 + 2 / 2 < min(abs(spot - centre(circle)) for spot in corners(text)) < 40
    lines = list(group.iter(f"{SVG}polyline"))
    for line, path in zip(lines, PATHS.values(), strict=False):
        # each tenth place, and back to the first
        assert chain(line) == pytest.approx(at(np.append(path[::10], path[0])), abs=0.0071)
        assert style(line)["stroke-width"] == "1"
    rods = [chain(line) for line in lines[2:]]
    wanted = [("O1", "A"), ("A", "B"), ("O3", "B"), ("O3", "C")]
    assert len(rods) == len(wanted)
    for rod, (one, two) in zip(rods, wanted, strict=True):
        assert rod == pytest.approx(at(np.array([known[one], known[two]])), abs=0.0071)


def test_a_stone_lies_along_its_guide_and_no_rod_joins_it_to_the_rocker() -> None:
    group = panel("Scheme", drawn(stone=True))
    assert len(list(group.iter(f"{SVG}polyline"))) == 2 + 3
    stone, block = group.iter(f"{SVG}rect")
    assert block.attrib["transform"].endswith("rotate(-30.000)")
    place = stone.attrib["transform"]
    x, y = map(float, place[len("translate(") : place.index(")")].split())
    joint = [centre(c) for c in group.iter(f"{SVG}circle")][2]
    assert complex(x, -y) == joint
    # from O3 = 1 - 2i to A = 1: straight up, which is -90 degrees where y runs down
    assert float(place[place.index("rotate(") + 7 : -1]) == -90
    middle = [float(stone.attrib[a]) + float(stone.attrib[b]) / 2 for a, b in (("x", "width"), ("y", "height"))]
    assert middle == [0, 0]
    assert float(stone.attrib["width"]) > float(stone.attrib["height"])
    assert not list(panel("Scheme").iter(f"{SVG}rect"))


def test_a_plan_shows_its_vectors_with_arrows_at_their_ends_and_names_beside_them() -> None:
    """6 wide and 4 high: the width decides, (0, 2) lies in the middle."""

    def at(z: complex) -> complex:
        return (z - 2j) * side() / 6 + side() * (0.5 - 0.5j)

    group = panel("Plan of velocities")
    lines = list(group.iter(f"{SVG}polyline"))
    for line, vector, colour in zip(lines, SPEEDS.vectors, COLOURS, strict=False):
        assert chain(line) == pytest.approx(at(np.array([vector.start, vector.end])), abs=0.0071)
        assert style(line)["stroke"] == colour
    assert len(lines) == 4
    (pole,) = group.iter(f"{SVG}circle")
    assert centre(pole) == pytest.approx(at(0j), abs=0.0071)
    arrows = list(group.iter(f"{SVG}polygon"))
    names = [t for t in group.iter(f"{SVG}text")][1:]
    assert [t.text for t in names] == ["a", "b", "ba"]
    for vector, arrow, name, colour in zip(SPEEDS.vectors, arrows, names, COLOURS, strict=False):
        along = (vector.end - vector.start) / abs(vector.end - vector.start)
        tip, *sides = (chain(arrow) - at(vector.end)) / along
        assert tip == pytest.approx(0, abs=0.0071)
        # 9 long and 6 wide, the same on both sides
        assert sides == pytest.approx([-9 + 3j, -9 - 3j], abs=0.015)
        assert style(arrow)["fill"] == style(name)["fill"] == colour
        seen = np.array([(spot - at(vector.start)) / along for spot in corners(name)])
        # on one side of it, near, between its ends
        assert (np.sign(seen.imag) == np.sign(seen.imag[0])).all()
        assert 1 < min(abs(seen.imag)) < 30
        assert 0 < seen.real.mean() < abs(at(vector.end) - at(vector.start))
    assert len(arrows) == 3


@pytest.mark.sampled(2)
@pytest.mark.parametrize("assignment", range(1, 11))
def test_names_stand_off_lines_and_off_each_other(assignment: int, tmp_path: Path) -> None:
    """Scheme and plans of a mechanism with all its loads: lines by many points of them, names by their rooms."""
    file, loads = tmp_path / "lever.svg", ["masses.1=5", "centres.1=20", "masses.2=3", "masses.3=20"]
    loads += ["resistance=1000"] if assignment < 10 else ["resisting_moment=100"]
    loads += [] if assignment in (8, 9) else ["masses.4=6", "masses.5=40"]
    calculate("lever", [f"assignment={assignment}", "variant=9", *loads, f"picture={file}"], "text", "en")
    seen = 0
    for group in ET.parse(file).getroot().iter(f"{SVG}g"):
        title, *texts = group.iter(f"{SVG}text")
        if not str(title.text).startswith(("Scheme", "Plan")):
            continue
        runs = [chain(line) for line in group.iter(f"{SVG}polyline")]
        steps = np.linspace(0, 1, 800)
        spots = np.concatenate([np.outer(1 - steps, run[:-1]) + np.outer(steps, run[1:]) for run in runs], axis=None)
        rooms = [(corners(text)[0], corners(text)[-1]) for text in texts]
        for k, (low, high) in enumerate(rooms):
            within = (
                (spots.real > low.real) & (spots.real < high.real) & (spots.imag > low.imag) & (spots.imag < high.imag)
            )
            assert not within.any(), (title.text, texts[k].text)
            for j, (other, end) in enumerate(rooms[:k]):
                apart = high.real < other.real or end.real < low.real or high.imag < other.imag or end.imag < low.imag
                assert apart, (title.text, texts[k].text, texts[j].text)
            for block in group.iter(f"{SVG}rect"):
                x, y = map(float, block.attrib["transform"][len("translate(") :].partition(")")[0].split())
                off = complex(max(low.real - x, x - high.real, 0), max(low.imag + y, -y - high.imag, 0))
                assert abs(off) > 10.8, texts[k].text
            # within the panel and the room about it
            assert -34 < low.real < high.real < side() + 34
            assert -side() - 34 < low.imag < high.imag < 11
        seen += len(rooms)
    assert seen > 15


def test_colours_of_a_plan_begin_anew_after_the_last() -> None:
    many = Plan(tuple(Vector(f"v{k}", 0j, np.exp(0.5j * k)) for k in range(10)), 1.0)
    picture = LeverPicture(POINTS, PATHS, FIXED, {}, many, SPEEDS, ANGLE, SERIES)
    lines = panel("Plan of velocities", ET.fromstring(picture.svg(words("en")))).iter(f"{SVG}polyline")
    assert [style(line)["stroke"] for line in lines] == [*COLOURS, *COLOURS[:2]]


def test_plans_of_forces_stand_behind_the_other_panels() -> None:
    """A triangle of forces, 4 wide and 3 high about (2, 1.5): as drawn it closes."""

    def at(z: complex) -> complex:
        return (z - (2 + 1.5j)) * side() / 4 + side() * (0.5 - 0.5j)

    chain_of = (Vector("R_12", 0j, 4 + 0j), Vector("G_2", 4 + 0j, 4 + 3j), Vector("R_32", 4 + 3j, 0j))
    picture = LeverPicture(
        POINTS, PATHS, FIXED, {}, SPEEDS, SPEEDS, ANGLE, SERIES, None, (("Links", Plan(chain_of, 1.0)),)
    )
    root = ET.fromstring(picture.svg(words("en")))
    groups = list(root.iter(f"{SVG}g"))
    assert [str(next(iter(g)).text) for g in groups][4:] == ["Links"]
    lines = [chain(line) for line in groups[4].iter(f"{SVG}polyline")]
    for line, vector in zip(lines, chain_of, strict=True):
        assert line == pytest.approx(at(np.array([vector.start, vector.end])), abs=0.0071)
    assert abs(lines[-1][-1] - lines[0][0]) < 0.0071
    # five panels take three rows
    first, free = corner(groups[0]), corner(groups[0]).real
    assert float(root.attrib["height"]) == 3 * (side() + free + first.imag)


def on_graph(line: ET.Element, values: np.ndarray, zero: float, unit: float) -> None:
    """A curve over the whole turn: each tenth place at its height above the axis, ``unit`` px for 1."""
    wanted = ANGLE[::10] / 360 * side() + 1j * (values[::10] * unit - zero)
    assert chain(line) == pytest.approx(wanted, abs=0.0151)


def test_diagrams_of_the_output_stand_one_under_another_about_their_own_axes() -> None:
    """Each holds 0: from 0 to 30, from -3 to 1, from -4 to 0."""
    group = panel("Output")
    lines, axes = list(group.iter(f"{SVG}polyline")), list(group.iter(f"{SVG}line"))
    texts = [t for t in group.iter(f"{SVG}text")][1:]
    tops = []
    for k, (low, high) in enumerate(((0, 30), (-3, 1), (-4, 0))):
        zero = float(axes[k].attrib["y1"])
        assert (axes[k].attrib["x1"], axes[k].attrib["y2"]) == ("0", axes[k].attrib["y1"])
        run = chain(lines[k]).imag
        values = TRAVEL[k][::10]
        unit = np.ptp(run) / np.ptp(values)
        on_graph(lines[k], TRAVEL[k], zero, unit)
        top, bottom = zero - high * unit, zero - low * unit
        tops.append((top, bottom))
        # its words stand above it, below the one before
        word = float(texts[k].attrib["y"])
        assert (tops[k - 1][1] if k else -5) < word - 8
        assert word < top
        assert style(lines[k])["stroke"] == style(texts[k])["fill"] == COLOURS[k]
    assert np.diff([t for t, _ in tops]) == pytest.approx([side() / 3] * 2, abs=0.1)
    assert np.diff([b for _, b in tops]) == pytest.approx([side() / 3] * 2, abs=0.1)
    assert tops[-1][1] < side()
    assert tops[0][1] - tops[0][0] > 0.7 * side() / 3
    assert [t.text for t in texts] == ["S, mm  0 … 30", "V, m/s  −3 … 1", "a, m/s²  −4 … 0"]


@pytest.mark.parametrize(
    ("name", "curves", "low", "high", "told"),
    [
        ("Reduced", (RUN.resisting, np.full(361, 50.0)), 0, 100, ("M_c  0 … 100", "M_d  50 … 50")),
        ("Gained", (RUN.gained, RUN.of_links, RUN.of_flywheel), -30, 30,
         ("ΔT  −30 … 30", "ΔT_l  −10 … 10", "ΔT_m  −6 … −4")),
    ],
)  # fmt: skip
def test_curves_in_one_field_have_one_scale(
    name: str, curves: tuple[np.ndarray, ...], low: float, high: float, told: tuple[str, ...]
) -> None:
    group = panel(name)
    lines, (axis,) = list(group.iter(f"{SVG}polyline")), group.iter(f"{SVG}line")
    texts = [t for t in group.iter(f"{SVG}text")][1:]
    zero, rows = float(axis.attrib["y1"]), [float(t.attrib["y"]) for t in texts]
    assert (axis.attrib["x1"], axis.attrib["y2"]) == ("0", axis.attrib["y1"])
    # the field reaches from below the words to the panel's foot; the first curve has both of its ends
    unit = np.ptp(chain(lines[0]).imag) / (high - low)
    top = zero - high * unit
    assert zero - low * unit == pytest.approx(side(), abs=0.02)
    assert rows[-1] < top < rows[-1] + 18
    assert min(rows) > 8
    assert np.ptp(np.diff([*rows, rows[-1] + 18])) == 0
    for line, values, text, row, colour in zip(lines, curves, texts, told, COLOURS, strict=False):
        on_graph(line, values, zero, unit)
        assert "".join(text.itertext()) == row.replace("_", "")
        assert style(line)["stroke"] == style(text)["fill"] == colour
    assert len(lines) == len(curves)


def test_what_rounding_leaves_of_nothing_is_told_as_0() -> None:
    resisting = np.maximum(RUN.resisting, 1e-14)
    run = Run(ANGLE, resisting, RUN.driving, RUN.gained, RUN.of_links, RUN.of_flywheel)
    picture = LeverPicture(POINTS, PATHS, FIXED, {}, SPEEDS, SPEEDS, ANGLE, SERIES, run)
    texts = [
        "".join(t.itertext()) for t in panel("Reduced", ET.fromstring(picture.svg(words("en")))).iter(f"{SVG}text")
    ]
    assert texts[1] == "Mc  0 … 100"


def test_an_output_that_rests_is_drawn_on_its_axis() -> None:
    still = np.zeros(361)
    rests = ("S", "mm", still), ("V", "m/s", still), ("a", "m/s2", still)
    run = Run(ANGLE + 30, still, 0.0, still, still, still)
    picture = LeverPicture({"A": 1j}, {"A": np.full(361, 1j)}, {"O1": 1j}, {}, Plan((), 1.0), Plan((), 1.0),
                           ANGLE + 30, rests, run)  # fmt: skip
    root = ET.fromstring(picture.svg(words("en")))
    for name in ("Output", "Reduced", "Gained"):
        group = panel(name, root)
        for line in group.iter(f"{SVG}polyline"):
            run_px = chain(line)
            assert any(np.ptp(run_px.imag + float(a.attrib["y1"])) == 0 and -run_px.imag[0] == float(a.attrib["y1"])
                       for a in group.iter(f"{SVG}line"))  # fmt: skip
            assert (run_px.real[0], run_px.real[-1]) == (0, side())
    # all of the scheme in one point: the middle of its panel
    assert {centre(c) for c in panel("Scheme", root).iter(f"{SVG}circle")} == {side() * (0.5 - 0.5j)}
    assert not list(panel("Plan of velocities", root).iter(f"{SVG}polyline"))
