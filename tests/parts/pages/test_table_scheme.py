"""The scheme of a two-disk table, read back: circles about their joints, arms in both elbows' colours, their key."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable

import numpy as np
import pytest

from parts.base.texts import words
from parts.pages.table_scheme import TableScheme, scheme

SVG = "{http://www.w3.org/2000/svg}"
# L1 = 40, L2 = 30 and a ratio of 5: the pinion is 10, the ring 50; reached is what lies from 10 to 70 away
JOINTS = ((24 + 32j, 54 + 32j), (40 + 0j, 40 - 30j))
ALONG = TableScheme((10.0, 70.0), (50.0, 10.0), JOINTS, np.array([54 + 32j, 60 + 10j, 40 - 30j]))


def both_elbows() -> TableScheme:
    return scheme((40.0, 30.0), 5.0, JOINTS)


def along_a_path() -> TableScheme:
    return ALONG


class Read:
    """Entities with their places in mm, y up, by the greatest circle, of radius 70 about O1."""

    def __init__(self, made: TableScheme, far: float = 70.0) -> None:
        self.root = ET.fromstring(made.svg(words("en")))
        greatest = max(self.root.iter(f"{SVG}circle"), key=lambda c: float(c.attrib["r"]))
        self.scale = far / float(greatest.attrib["r"])
        self.x, self.y = float(greatest.attrib["cx"]), float(greatest.attrib["cy"])

    def at(self, x: str | float, y: str | float) -> complex:
        return complex(float(x) - self.x, self.y - float(y)) * self.scale

    def all(self, tag: str) -> list[ET.Element]:
        return list(self.root.iter(f"{SVG}{tag}"))

    def chain(self, line: ET.Element) -> list[complex]:
        return [self.at(*p.split(",")) for p in line.attrib["points"].split()]


def style(element: ET.Element) -> dict[str, str]:
    return dict(p.split(":") for p in element.attrib["style"].split(";"))


@pytest.mark.parametrize("make", [both_elbows, along_a_path])
def test_circles_and_arms_stand_where_the_linkage_has_them(make: Callable[[], TableScheme]) -> None:
    made = make()
    read = Read(made)
    circles = [
        (read.at(c.attrib["cx"], c.attrib["cy"]), float(c.attrib["r"]) * read.scale, style(c))
        for c in read.all("circle")
    ]
    plain = [c for c in circles if c[1] > 5]
    wanted = [(0j, 70), (0j, 10), (0j, 50), (24 + 32j, 10), (40 + 0j, 10)]
    for (centre, radius, _), (place, size) in zip(plain, wanted, strict=True):
        assert centre == pytest.approx(place, abs=0.01)
        assert radius == pytest.approx(size, abs=0.01)
    # the ring between the singular circles is filled, the pitch circles are chain lines
    assert [c[2]["fill"] for c in plain] == ["#eef4ea", "#ffffff", "none", "none", "none"]
    assert [("stroke-dasharray" in c[2]) for c in plain] == [False, False, True, True, True]
    lines = [(read.chain(line), style(line)) for line in read.all("polyline")]
    cross = [points for points, look in lines if look["stroke"] == "#c8ccd0"]
    over = abs(cross[0][0])
    assert 50 < over < 52
    for points, way in zip(cross, (1, 1j), strict=True):
        assert points == pytest.approx([-over * way, over * way], abs=0.01)
    arms = [(points, look) for points, look in lines if look["stroke-width"] == "3"]
    for (points, _), (second, third) in zip(arms, JOINTS, strict=True):
        assert points == pytest.approx([0j, second, third], abs=0.01)
    rings = [c for c in circles if c[1] < 5]
    places = [p for joints in JOINTS for p in (0j, *joints)]
    assert [c[0] for c in rings] == pytest.approx(places, abs=0.01)
    names = [t for t in read.all("text") if str(t.text).startswith("O")]
    shown = [0j, *JOINTS[0], JOINTS[1][0]]
    assert [t.text for t in names] == ["O1", "O2", "O3", "O2"]
    for text, place in zip(names, shown, strict=True):
        beside = (read.at(text.attrib["x"], text.attrib["y"]) - place) / read.scale
        assert 4 < beside.real < 10
        assert 4 < beside.imag < 10
    # one colour a elbow; along a path the arms are one pair at two places
    colours = [look["stroke"] for _, look in arms]
    assert (colours[0] == colours[1]) == (made.path is not None)
    assert [c[2]["stroke"] for c in rings] == [colours[0]] * 3 + [colours[1]] * 3
    paths = [(points, look) for points, look in lines if look["stroke-width"] == "2"]
    assert len(paths) == (made.path is not None)
    for points, _ in paths:
        assert points == pytest.approx([54 + 32j, 60 + 10j, 40 - 30j], abs=0.01)


@pytest.mark.parametrize("make", [both_elbows, along_a_path])
def test_the_key_names_each_stroke_below_another_beside_the_drawing(make: Callable[[], TableScheme]) -> None:
    made = make()
    read = Read(made)
    boxes = [r for r in read.all("rect") if "x" in r.attrib]
    texts = [t for t in read.all("text") if not str(t.text).startswith("O")]
    last = (["path", "arms at its start and end"] if made.path is not None
            else ["First elbow, beta > 0", "Second elbow, beta < 0"])  # fmt: skip
    assert [t.text for t in texts] == [
        "workspace, between the singular circles", "pitch circles of ring and pinion", *last,
    ]  # fmt: skip
    used = [style(c) for c in read.all("circle")] + [style(p) for p in read.all("polyline")]
    for box, text in zip(boxes, texts, strict=True):
        assert style(box)["stroke"] in {u["stroke"] for u in used}
        (x, y), (width, height) = ([float(box.attrib[k]) for k in pair] for pair in (("x", "y"), ("width", "height")))
        assert y < float(text.attrib["y"]) < y + height + 2
        assert x + width < float(text.attrib["x"]) < x + width + 12
    assert [style(b)["fill"] for b in boxes] == ["#eef4ea", "none", "none", "none"]
    assert len({style(b)["stroke"] for b in boxes}) == 4
    rows = [float(t.attrib["y"]) for t in texts]
    assert np.ptp(np.diff(rows)) == 0
    assert rows[1] - rows[0] > float(boxes[0].attrib["height"])
    # beside the drawing, which stands in the middle of its own square
    size = float(read.root.attrib["height"])
    assert (read.x, read.y) == (size / 2, size / 2)
    assert float(boxes[0].attrib["x"]) == size
    assert float(texts[0].attrib["y"]) > 0
    assert read.root.attrib["viewBox"].split() == ["0", "0", read.root.attrib["width"], read.root.attrib["height"]]
    assert float(read.root.attrib["width"]) > size + 34 + 0.5 * 12 * max(len(str(t.text)) for t in texts)


def test_the_drawing_is_as_large_as_its_greatest_circle_lets_it() -> None:
    """A ring beyond the workspace decides too; without an inner singular circle there is one circle less."""
    for made, far in ((both_elbows(), 70.0), (scheme((40.0, 40.0), 1.5, ()), 120.0)):
        read = Read(made, far)
        radius = far / read.scale
        assert radius < read.x - 30 < 1.05 * radius
    assert len(read.all("circle")) == 2
