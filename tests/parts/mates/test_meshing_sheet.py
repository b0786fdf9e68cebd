"""The picture of meshing on paper: points, circles, arcs and words by the closed forms of the involute."""

from __future__ import annotations

import cmath
import math
from functools import cache
from typing import Any

import pytest

from exporters.production.plan import plan_build
from geometry.curves.line_arc import Arc, Line
from parts.drawing.labels import nearest
from parts.scene.load import scene_from_dict

ALPHA, M = math.radians(20), 5.0
CIRCLES = {"TIP": "a", "WORKING": "w", "REFERENCE": "", "BASE": "b", "ROOT": "f"}


class Pair:
    """An external pair of module 5 without shifts on its sheet, read in mm of the model with O1 at 0."""

    def __init__(self, teeth: tuple[int, int], asked: dict[str, str]) -> None:
        wheel = {"kind": "spur_gear", "module": M, "face_width": 10.0}
        raw: dict[str, Any] = {
            "parts": {f"p{k}": wheel | {"number_of_teeth": z} for k, z in enumerate(teeth)},
            "mates": [{"kind": "external_gear_pair", "first": "p0", "second": "p1"}],
            "exports": [{"format": "sheet", "tolerance": 1e-3, **asked}],
        }
        job = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets[0]
        self.canvas, self.scale = job.canvas, job.expected.paper.scale
        first, second = (s.curve for s in self.canvas.strokes if s.layer == "CIRCLE_TIP")
        self.zero = first.centre
        self.r = [M * z / 2 for z in teeth]
        self.base = [r * math.cos(ALPHA) for r in self.r]
        self.tip = [r + M for r in self.r]
        self.centres = [0j, self.model(second.centre)]
        up = self.centres[1] / abs(self.centres[1])
        self.pole = self.r[0] * up
        # of both common tangents that on which the active line lies
        # samples stand in the table, after the picture
        active = self.lines("ACTIVE_LINE")[0]
        for sense in (1, -1):
            turn = up * cmath.exp(1j * sense * ALPHA)
            self.tangents = [self.base[0] * turn, self.centres[1] - self.base[1] * turn]
            self.way = (self.tangents[1] - self.tangents[0]) / abs(self.tangents[1] - self.tangents[0])
            if abs(((active[0] - self.pole) / self.way).imag) < 1e-6:
                break
        before, after = (math.sqrt(self.tip[k] ** 2 - self.base[k] ** 2) - self.r[k] * math.sin(ALPHA) for k in (1, 0))
        self.ends = (self.pole - before * self.way, self.pole + after * self.way)
        # how the first turns: its pole goes along with the contact
        self.sense = math.copysign(1.0, (self.pole.conjugate() * self.way).imag)
        self.turns = [-self.sense * before / self.base[0], self.sense * after / self.base[0]]

    def model(self, point: complex) -> complex:
        return (point - self.zero) / self.scale

    def paper(self, point: complex) -> complex:
        return self.zero + self.scale * point

    def lines(self, layer: str) -> list[tuple[complex, complex]]:
        found = [s.curve for s in self.canvas.strokes if s.layer == layer and isinstance(s.curve, Line)]
        return [(self.model(c.start), self.model(c.end)) for c in found]

    def arcs(self, layer: str) -> list[Arc]:
        return [s.curve for s in self.canvas.strokes if s.layer == layer and isinstance(s.curve, Arc)]

    def named(self, text: str, point: complex) -> bool:
        """Whether a word stands beside a point, or is joined to it by a line."""
        at = self.paper(point)
        for box in (t.box for t in self.canvas.texts if t.text == text):
            near = nearest(box, at)
            leads = [s.curve for s in self.canvas.strokes if s.layer == "DIMENSION" and isinstance(s.curve, Line)]
            if abs(near - at) <= 3 or any(abs(c.start - at) + abs(c.end - near) < 1e-6 for c in leads):
                return True
        return False


@cache
def pair(teeth: tuple[int, int], scale: str = "") -> Pair:
    return Pair(teeth, {"paper": "A2", "scale": scale} if scale else {})


# whole with both axes; large enough that its axes stand beyond a break; with N2 out of the picture
SEEN, SMALL, LARGE = ((20, 30), "1:1"), ((20, 30), ""), ((20, 400), "")
PAIRS = pytest.mark.parametrize("made_of", [SEEN, SMALL, LARGE])


@PAIRS
def test_lines_and_arcs_lie_where_the_involute_has_them(made_of: tuple[tuple[int, int], str]) -> None:
    made = pair(*made_of)
    assert abs(made.centres[1]) == pytest.approx(sum(made.r), rel=1e-9)
    assert made.lines("ACTIVE_LINE")[0] == pytest.approx(made.ends, rel=1e-8)
    action = made.lines("LINE_OF_ACTION")[0]
    places = [((p - made.tangents[0]) / made.way) for p in action]
    assert max(abs(p.imag) for p in places) < 1e-8
    length = abs(made.tangents[1] - made.tangents[0])
    # from N1 to N2, or to the end of what the sheet shows
    assert places[0].real == pytest.approx(0, abs=1e-8)
    assert places[1].real == pytest.approx(length) if made_of != LARGE else places[1].real < length / 2
    arc, pitch = made.arcs("ARC_OF_ACTION")[0], made.arcs("WORKING_PITCH")[0]
    d = [made.pole * cmath.exp(1j * turn) for turn in made.turns]
    assert [made.model(arc.point(t)) for t in sorted(arc.domain)] == pytest.approx(d, rel=1e-8)
    assert made.model(pitch.centre) == pytest.approx(made.centres[1], rel=1e-9)
    assert pitch.radius / made.scale == pytest.approx(made.r[1], rel=1e-9)
    assert abs(pitch.sweep) * made.r[1] == pytest.approx(math.pi * M, rel=1e-9)
    # the working pressure angle, from the line of action to T-T
    angles = [a for a in made.arcs("DIMENSION") if abs(a.centre - made.paper(made.pole)) < 1e-6 and a.radius > 2]
    (angle,) = angles
    assert abs(angle.sweep) == pytest.approx(ALPHA, rel=1e-9)
    ends = [(angle.point(t) - angle.centre) / angle.radius for t in angle.domain]
    across = 1j * made.pole / abs(made.pole)
    assert min(abs(abs((e / across).real) - 1) for e in ends) < 1e-12
    assert min(abs(abs((e / made.way).real) - 1) for e in ends) < 1e-12
    tangent = made.lines("TANGENT")[0]
    assert [((p - made.pole) / across).imag for p in tangent] == pytest.approx([0, 0], abs=1e-9)
    # spokes to both tangent points, where these are shown
    spokes = [(made.centres[k], made.tangents[k]) for k in range(2)]
    for (start, end), shown in zip(spokes, (made_of == SEEN,) * 2, strict=True):
        found = any(abs(a - start) + abs(b - end) < 1e-6 for a, b in made.lines("DIMENSION"))
        assert found == shown
    # marks at all that are shown
    marks = [made.model(a.centre) for a in made.arcs("DIMENSION") if abs(a.sweep) == 2 * math.pi]
    points = [*made.ends, made.pole, *made.tangents[: 1 if made_of == LARGE else 2]]
    if made_of == SEEN:
        points += made.centres
    else:
        # axes beyond a break: on what is left of the line of centres, nearer than they are
        first, second, *marks = marks
        (low, high), *ends = made.lines("CENTRE")
        assert [z.real for z in (first, second)] == pytest.approx([0, 0], abs=1e-9)
        assert 0 < first.imag < low.imag < high.imag < second.imag < made.centres[1].imag
        for (start, end), at, edge, way in zip(ends, (first, second), (low, high), (-1j, 1j), strict=True):
            assert end == pytest.approx(at + 4 * way / made.scale, abs=1e-9)
            assert start == pytest.approx(edge + 4 * way / made.scale, abs=1e-9)
    assert marks == pytest.approx(points, abs=1e-6)


@PAIRS
def test_words_stand_beside_what_they_name(made_of: tuple[tuple[int, int], str]) -> None:
    made = pair(*made_of)
    action, tangent = made.lines("LINE_OF_ACTION")[0], made.lines("TANGENT")[0]
    places = {
        "P": made.pole,
        "a": made.ends[0],
        "b": made.ends[1],
        "d": made.pole * cmath.exp(1j * made.turns[0]),
        "d'": made.pole * cmath.exp(1j * made.turns[1]),
        "N1": made.tangents[0],
    }
    if made_of != LARGE:
        places |= {"N2": made.tangents[1]}
    else:
        places |= {"to N2": action[1]}
    marks = [made.model(a.centre) for a in made.arcs("DIMENSION") if abs(a.sweep) == 2 * math.pi]
    places |= dict(zip(("O1", "O2"), made.centres if made_of == SEEN else marks[:2], strict=True))
    for text, place in places.items():
        assert made.named(text, place), text
    assert all(made.named("T", end) for end in tangent)
    texts = {t.text for t in made.canvas.texts}
    assert ("N2" in texts) == (made_of != LARGE)
    reach = abs(made.ends[1] - made.ends[0]) / math.cos(ALPHA)
    assert f"dd' = {reach:.3f}" in texts
    assert f"pw = {math.pi * M:.3f}" in texts
    # each circle that is shown is told in its column, joined to its end; what is not stands in the table
    leads = [s.curve for s in made.canvas.strokes if s.layer == "DIMENSION" and isinstance(s.curve, Line)]
    for layer, symbol in CIRCLES.items():
        for k in range(2):
            radius = {"TIP": made.tip[k], "BASE": made.base[k], "ROOT": made.r[k] - 1.25 * M}.get(layer, made.r[k])
            arcs = [
                a
                for a in made.arcs(f"CIRCLE_{layer}")
                if abs(made.model(a.centre) - made.centres[k]) < 1e-6 * made.r[k]
            ]
            text = f"r{symbol}{k + 1} = {radius:.2f}"
            assert (text in texts) == bool(arcs)
            for arc in arcs:
                assert arc.radius / made.scale == pytest.approx(radius, rel=1e-9)
                (box,) = (t.box for t in made.canvas.texts if t.text == text)
                ends = [complex(arc.point(t)) for t in arc.domain]
                assert any(
                    min(abs(c.start - e) for e in ends) < 1e-6 and abs(nearest(box, c.end) - c.end) < 1.5 for c in leads
                )
            if not arcs:
                assert f"r{symbol}{k + 1}" in texts
                assert f"{radius:.3f}" in texts


def test_no_dimension_lies_where_a_line_of_centres_is_broken() -> None:
    """Of many teeth the base circle is far below the root: an arc within it lay on the zigzag."""
    wheel = {"module": 3.0, "face_width": 10.0}
    raw: dict[str, Any] = {
        "parts": {"p": wheel | {"kind": "spur_gear", "number_of_teeth": 96},
                  "r": wheel | {"kind": "ring_gear", "number_of_teeth": 144, "outer_diameter": 470.0}},
        "mates": [{"kind": "internal_gear_pair", "first": "r", "second": "p"}],
        "exports": [{"format": "sheet", "tolerance": 1e-3}],
    }  # fmt: skip
    canvas = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets[0].canvas
    drawn = {layer: [s.curve for s in canvas.strokes if s.layer == layer] for layer in ("DIMENSION", "ARC_OF_ACTION")}
    (action,) = (c for c in drawn["ARC_OF_ACTION"] if isinstance(c, Arc))
    (arc,) = (c for c in drawn["DIMENSION"] if isinstance(c, Arc) and abs(c.centre - action.centre) < 1e-6)
    middle = complex(arc.point(arc.sweep / 2))
    # a zigzag's own lines are the slanted ones about the line of centres
    bent = [c for c in drawn["DIMENSION"] if isinstance(c, Line) and 1 < abs(c.end.imag - c.start.imag) < 3
            and abs((c.start + c.end).real / 2 - action.centre.real) < 1.1]  # fmt: skip
    assert len(bent) == 2
    assert min(min(abs(p - middle) for p in (c.start, c.end)) for c in bent) > 5


def test_dimensions_of_the_arcs_run_inside_their_gears_with_arrows_at_both_ends() -> None:
    """Each end has its line from the arc; both sides of an arrow stand at 12 degrees, 3 mm long."""
    made = pair(*SMALL)
    strokes = [s.curve for s in made.canvas.strokes if s.layer == "DIMENSION" and isinstance(s.curve, Line)]
    arc, pitch = made.arcs("ARC_OF_ACTION")[0], made.arcs("WORKING_PITCH")[0]
    for shown, k in ((arc, 0), (pitch, 1)):
        inner = next(
            a
            for a in made.arcs("DIMENSION")
            if abs(a.centre - shown.centre) < 1e-6 and a.sweep == pytest.approx(shown.sweep, rel=1e-9)
        )
        assert inner.radius == pytest.approx(min(made.base[k], made.r[k] - 1.25 * M) * made.scale - 8, rel=1e-9)
        for t, away in ((0.0, -1), (inner.sweep, 1)):
            at, out = complex(inner.point(t)), complex(shown.point(t))
            assert any(abs(c.start - out) + abs(c.end - at) < 1e-6 for c in strokes)
            sides = [(c.end - at) for c in strokes if abs(c.start - at) < 1e-9]
            tangent = complex(inner.tangent(t)) * away
            wanted = [-3 * tangent * cmath.exp(1j * side * math.radians(12)) for side in (1, -1)]
            assert sides == pytest.approx(wanted, abs=1e-9)
