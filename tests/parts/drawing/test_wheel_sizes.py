"""What is told of wheels: every size, radius, sign and axis of their views, worked out from the keys by hand."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest

from geometry.curves.line_arc import Arc
from parts.drawing.working import AXIS, THIN, VISIBLE, PartDrawing, View
from tests.parts.drawing.test_sections import drawing_of

SPUR = {"kind": "spur_gear", "module": 2.0}
# z 24 with all that a wheel has along its axis: hub from -3 to 16, web from 4 to 9, rim from 0 to 12; keyway at 20 deg
HUB = SPUR | {
    "number_of_teeth": 24, "face_width": 12.0, "hub": {"diameter": 24.0, "above": 4.0, "below": 3.0},
    "web": {"thickness": 5.0, "rim_diameter": 36.0, "shift": 0.5}, "face_chamfer": {"above": 0.5, "below": 0.3},
    "bore": {"shape": "keyway", "diameter": 12.0, "angle_deg": 20.0},
}  # fmt: skip
ONE_SIDED = SPUR | {
    "number_of_teeth": 30, "face_width": 10.0, "hub": {"diameter": 24.0, "above": 6.0}, "bore_diameter": 12.0,
    "face_chamfer": {"above": 0.5, "below": 0.5},
    "holes": [{"count": 4, "diameter": 6.0, "pitch_circle_diameter": 38.0, "start_deg": 30.0}],
}  # fmt: skip
SPOKED = SPUR | {
    "number_of_teeth": 50, "face_width": 10.0, "bore": {"shape": "D", "diameter": 10.0, "flat": 8.0},
    "spokes": {"count": 5, "width": 8.0, "inner_diameter": 30.0, "outer_diameter": 84.0, "corner_radius": 2.0},
}  # fmt: skip
HEXAGON = SPUR | {
    "number_of_teeth": 24, "face_width": 10.0, "bore": {"shape": "hexagon", "across_flats": 12.0, "corner_radius": 1.0},
    "holes": [{"count": 1, "diameter": 4.0, "pitch_circle_diameter": 28.0, "start_deg": 10.0},
              {"count": 1, "diameter": 4.0, "pitch_circle_diameter": 26.0, "start_deg": 100.0}],
}  # fmt: skip
RECESSED = SPUR | {
    "number_of_teeth": 30, "face_width": 10.0, "web": {"thickness": 4.0, "rim_diameter": 44.0, "shift": -3.0},
    "bore": {"shape": "double_D", "diameter": 10.0, "across_flats": 8.0}, "face_chamfer": {"below": 0.4},
}  # fmt: skip
WORM_WHEEL = {"kind": "worm_wheel", "module": 2.0, "number_of_teeth": 30, "face_width": 16.0, "bore_diameter": 14.0}
PARTS: dict[str, dict[str, Any]] = {
    "hub": HUB, "one sided": ONE_SIDED, "spoked": SPOKED, "hexagon": HEXAGON, "recessed": RECESSED,
    "worm wheel": WORM_WHEEL,
}  # fmt: skip
# of both holes of the hexagon, 10 and 100 degrees on
FAR, NEAR = cmath.rect(14.0, math.radians(10)), cmath.rect(13.0, math.radians(100))
# name, what stands before and after the number, its side, from where to where
Told = tuple[str, str, str, str, complex, complex]


def across(name: str, radius: float, z: float, side: str, after: str = "") -> Told:
    """A diameter at a place along the axis."""
    return name, "Ø", after, side, complex(z, -radius), complex(z, radius)


SIZES: dict[str, list[list[Told]]] = {
    "hub": [
        [
            across("tip_diameter", 26.0, 0.3, "left", "h11"), across("web.rim_diameter", 18.0, 0.0, "left"),
            ("web.thickness", "", "", "above", 4 + 18j, 9 + 18j), ("web.below", "", "", "above", 18j, 4 + 18j),
            across("hub.diameter", 12.0, 15.5, "right"), ("hub.length", "", "", "below", -3 - 12j, 16 - 12j),
            ("hub.below", "", "", "below", -3 - 12j, -26j), ("face_width", "", "h11", "below", -26j, 12 - 26j),
            # of bore, hub, rim and tips each on either side
            ("face_chamfer.above", "4 chamfers ", "×45°", "above", 11.5 + 26j, 12 + 26j),
            ("face_chamfer.below", "4 chamfers ", "×45°", "above", 0.3 + 26j, 26j),
        ],
        [],
        # DIN 6885: 4 wide, 1.8 deep, corners 0.16; limits of d + t2: +0.1
        [
            across("bore_diameter", 6.0, 0.0, "left", "H7"), ("bore.height", "", " +0.1", "right", -6j, 7.8j),
            ("bore.width", "", "Js9", "above", -2 + 7.64j, 2 + 7.64j),
        ],
    ],
    "one sided": [
        [
            across("tip_diameter", 32.0, 0.5, "left", "h11"),
            ("holes.1.pitch_circle_diameter", "Ø", "", "left", -19j, 19j), across("hub.diameter", 12.0, 15.5, "right"),
            ("hub.length", "", "", "below", -12j, 16 - 12j), across("bore_diameter", 6.0, 16.0, "right", "H7"),
            ("face_width", "", "h11", "below", -32j, 10 - 32j),
            # hub, bore twice, tips twice: all alike, told once
            ("face_chamfer.above", "5 chamfers ", "×45°", "above", 9.5 + 32j, 10 + 32j),
        ],
        [],
    ],
    "spoked": [
        [
            across("tip_diameter", 52.0, 0.0, "left", "h11"), across("spokes.inner_diameter", 15.0, 0.0, "left"),
            across("spokes.outer_diameter", 42.0, 0.0, "left"), ("face_width", "", "h11", "below", -52j, 10 - 52j),
        ],
        [],
        [across("bore_diameter", 5.0, 0.0, "left", "H7"), ("bore.height", "", "", "right", -5j, 3j)],
    ],
    "hexagon": [
        [across("tip_diameter", 26.0, 0.0, "left", "h11"), ("face_width", "", "h11", "below", -26j, 10 - 26j)],
        [
            ("x.1", "", "", "below", NEAR, -26j), ("x.2", "", "", "below", -26j, FAR),
            ("y.1", "", "", "left", -26 + 0j, FAR), ("y.2", "", "", "left", -26 + 0j, NEAR),
        ],
        [("bore.across_flats", "", "H7", "right", -6j, 6j)],
    ],
    "recessed": [
        [
            across("tip_diameter", 32.0, 0.4, "left", "h11"), across("web.rim_diameter", 22.0, 0.0, "left"),
            # flush with the lower face
            ("web.thickness", "", "", "above", 22j, 4 + 22j), ("face_width", "", "h11", "below", -32j, 10 - 32j),
            # tips and bore
            ("face_chamfer.below", "2 chamfers ", "×45°", "above", 0.4 + 32j, 32j),
        ],
        [],
        [across("bore_diameter", 5.0, 0.0, "left", "H7"), ("bore.height", "", "", "right", -4j, 4j)],
    ],
    # GOST 19650: throat d_a = m (z + 2), greatest m (z + 4); the worm q 10 stands off by m (z + q) / 2
    "worm wheel": [
        [
            across("tip_diameter", 34.0, 0.0, "left", "h11"), across("throat_diameter", 32.0, 8.0, "right"),
            ("throat_plane", "", "", "above", 34j, 8 + 32j), across("bore_diameter", 7.0, 16.0, "right", "H7"),
            ("face_width", "", "h11", "below", -34j, 16 - 34j),
        ],
        [],
    ],
}  # fmt: skip
# of each view: name, sign, radius or diameter, centre
ROUNDS: dict[str, list[list[tuple[str, str, float, complex]]]] = {
    "hub": [[], [], [("bore.corner_radius", "R", 0.16, 1.84 + 7.64j)]],
    # the one that is farthest up to the right
    "one sided": [[], [("holes.1.diameter", "4 holes Ø", 6.0, cmath.rect(19.0, math.pi / 6))]],
    "spoked": [[], [], []],
    # corners at 6 / cos 30 less what the rounding takes: it stands off by (6 - 1) / cos 30; the size on the left
    "hexagon": [
        [], [("holes.1.diameter", "2 holes Ø", 4.0, FAR)], [("bore.corner_radius", "R", 1.0, -10 / math.sqrt(3) + 0j)]
    ],
    "recessed": [[], [], []],
    "worm wheel": [[("throat_radius", "R", 8.0, 8 + 40j)], []],
}  # fmt: skip
# rough signs of the section: where the pitch line ends, and on the bore's wall at its upper end, or else
ROUGH: dict[str, tuple[complex, complex, tuple[complex, complex]]] = {
    "hub": (12 + 24j, 16 - 6j, (6.5 - 6j, -3 - 6j)), "one sided": (10 + 30j, 16 - 6j, (8 - 6j, -6j)),
    "spoked": (10 + 50j, 10 - 5j, (5 - 5j, -5j)), "hexagon": (10 + 24j, 10 - 6j, (5 - 6j, -6j)),
    "recessed": (10 + 30j, 4 - 4j, (2 - 4j, -4j)), "worm wheel": (16 + 30j, 16 - 7j, (8 - 7j, -7j)),
}  # fmt: skip


@pytest.fixture(scope="module")
def made() -> dict[str, PartDrawing]:
    return {name: drawing_of(keys) for name, keys in PARTS.items()}


@pytest.mark.parametrize("name", PARTS)
def test_sizes_are_those_of_the_keys(made: dict[str, PartDrawing], name: str) -> None:
    assert len(made[name].views) == len(SIZES[name])
    for view, expected in zip(made[name].views, SIZES[name], strict=True):
        assert [(s.name, s.before, s.after, s.side, s.places) for s in view.sizes] == [(*e[:4], "") for e in expected]
        for size, told in zip(view.sizes, expected, strict=True):
            assert [size.start, size.end] == [pytest.approx(x, abs=1e-9) for x in told[4:]], size.name


@pytest.mark.parametrize("name", PARTS)
def test_radii_and_diameters_stand_at_their_circles(made: dict[str, PartDrawing], name: str) -> None:
    for view, expected in zip(made[name].views, ROUNDS[name], strict=True):
        assert [(r.name, r.before, pytest.approx(r.value), r.is_radius) for r in view.rounds] == [
            (told, sign, value, sign == "R") for told, sign, value, _ in expected
        ]
        assert [r.centre for r in view.rounds] == [pytest.approx(e[3], abs=1e-9) for e in expected]
        for one in view.rounds:
            arcs = [c for _, c in view.strokes if isinstance(c, Arc)]
            assert any(abs(c.centre - one.centre) < 1e-9 and c.radius == pytest.approx(one.radius) for c in arcs)


@pytest.mark.parametrize("name", PARTS)
def test_signs_of_roughness_and_letters_stand_where_they_belong(made: dict[str, PartDrawing], name: str) -> None:
    """GOST 2.309: that of teeth on the pitch line, which goes on to it; the letter of the bore's view on its axis."""
    section, *rest = made[name].views
    pitch, wall, (inside, end) = ROUGH[name]
    teeth, bore, *letters = section.notes
    assert (teeth.at, teeth.text, teeth.is_rough, teeth.goes_on, teeth.also) == (pitch, "Ra 1.6", True, True, ())
    assert (bore.at, bore.text, bore.is_rough, bore.goes_on) == (wall, "Ra 1.6", True, False)
    # out of the material: towards the axis from within, along it at both ends
    assert (bore.free, bore.also) == (1, ((inside, complex(0, -wall.imag)), (end, -1)))
    assert [(n.at, n.text, n.looks, n.is_rough) for n in letters] == (
        [(complex(wall.real), "A", -1, False)] if rest[1:] else []
    )
    assert [view.title for view in made[name].views] == ["", "", "A"][: len(rest) + 1]
    assert [view.from_right for view in made[name].views] == [False, True, False][: len(rest) + 1]
    assert [view.least for view in made[name].views] == [0.0, 0.0, 25.0][: len(rest) + 1]


def ends(view: View) -> set[tuple[complex, complex]]:
    return {(complex(np.round(a.start, 6)) + 0, complex(np.round(a.end, 6)) + 0) for a in view.axes}


def test_axes_run_through_what_they_are_axes_of(made: dict[str, PartDrawing]) -> None:
    """Of sections from end to end of the part, pitch lines over the rim, holes through the web; crosses of faces."""
    along = {"hub": (-3, 16, 24, 12), "one sided": (0, 16, 30, 10), "spoked": (0, 10, 50, 10),
             "hexagon": (0, 10, 24, 10), "recessed": (0, 10, 30, 10), "worm wheel": (0, 16, 30, 16)}  # fmt: skip
    for name, (low, high, pitch, width) in along.items():
        expected = {(complex(low), complex(high))} | {(w * pitch * 1j, width + w * pitch * 1j) for w in (1, -1)}
        if name == "one sided":
            expected |= {(w * 19j, 10 + w * 19j) for w in (1, -1)}
        assert ends(made[name].views[0]) == expected
    spokes = made["spoked"].views[1]
    assert ends(spokes) == {(-52 + 0j, 52 + 0j), (-52j, 52j)}
    # of holes on a circle along the radius, of those alone along both axes
    turns = [cmath.rect(1.0, math.radians(30 + 90 * k)) for k in range(4)]
    radial = {(complex(np.round(16 * t, 6)) + 0, complex(np.round(22 * t, 6)) + 0) for t in turns}
    assert ends(made["one sided"].views[1]) == {(-32 + 0j, 32 + 0j), (-32j, 32j)} | radial
    crosses = {
        (complex(np.round(c - 2 * w, 6)) + 0, complex(np.round(c + 2 * w, 6)) + 0) for c in (NEAR, FAR) for w in (1, 1j)
    }
    assert ends(made["hexagon"].views[1]) == {(-26 + 0j, 26 + 0j), (-26j, 26j)} | crosses
    # of bores up to their walls
    assert ends(made["hub"].views[2]) == {(-6 + 0j, 6 + 0j), (-6j, 7.8j)}
    corner = 10 / math.sqrt(3) + 1
    assert ends(made["hexagon"].views[2]) == {(complex(-round(corner, 6)), complex(round(corner, 6))), (-6j, 6j)}


def circles(view: View, layer: str) -> list[float]:
    """Radii of whole circles about the axis, in however many arcs."""
    swept: dict[float, float] = {}
    for name, curve in view.strokes:
        if name == layer and isinstance(curve, Arc) and abs(curve.centre) < 1e-9:
            radius = round(curve.radius, 9)
            swept[radius] = swept.get(radius, 0.0) + abs(curve.sweep)
    return sorted(radius for radius, whole in swept.items() if whole == pytest.approx(math.tau))


def test_faces_have_the_circles_that_are_seen_from_there(made: dict[str, PartDrawing]) -> None:
    """Tips, hub, rim within, bore; the pitch circle, and circles of holes, as axes. A web on this side hides no rim."""
    expected = {
        "hub": ([12.0, 18.0, 26.0], [24.0]), "one sided": ([6.0, 12.0, 32.0], [19.0, 30.0]), "spoked": ([52.0], [50.0]),
        "hexagon": ([26.0], [24.0]), "recessed": ([22.0, 32.0], [30.0]), "worm wheel": ([7.0, 34.0], [30.0]),
    }  # fmt: skip
    for name, (seen, axes) in expected.items():
        assert circles(made[name].views[1], VISIBLE) == seen, name
        assert circles(made[name].views[1], AXIS) == axes, name
        assert circles(made[name].views[1], THIN) == []
    flush = drawing_of(RECESSED | {"web": {"thickness": 4.0, "rim_diameter": 44.0, "shift": 3.0}}).views[1]
    assert circles(flush, VISIBLE) == [32.0]
    low = drawing_of(ONE_SIDED | {"hub": {"diameter": 24.0, "below": 6.0}}).views[1]
    assert circles(low, VISIBLE) == [6.0, 32.0]


def test_directions_are_told_from_a_tooth_or_from_the_bore(made: dict[str, PartDrawing]) -> None:
    """A keyway 20 degrees on stands 5 from the tooth before it; spokes 90 before the flat, 72 a step, are 54 on."""
    told = {name: one.requirements[1:] for name, one in made.items()}
    assert told == {
        "hub": ("Keyway: its axis at 5° from the middle of a tooth, counter-clockwise as drawn.",),
        "one sided": ("Holes Ø6: the first at 30° from the middle of a tooth, counter-clockwise as drawn.",),
        "spoked": ("Spokes: the first at 54° from the middle of the bore's flat, counter-clockwise as drawn.",),
        "hexagon": (), "recessed": (), "worm wheel": (),
    }  # fmt: skip
    assert {one.requirements[0] for one in made.values()} == {"Unspecified limit deviations: H14, h14, ±IT14/2."}


def test_spokes_are_told_at_the_edge_of_the_first(made: dict[str, PartDrawing]) -> None:
    """Half of their width off its middle line, halfway out: the flat stands upright, the first spoke 0 degrees on."""
    (note,) = made["spoked"].views[1].notes
    assert note.text == "5 spokes 8 wide, corners R2"
    assert note.at == pytest.approx(complex(28.5, 4.0))
    plain = drawing_of(SPOKED | {"spokes": {"count": 5, "width": 8.0, "inner_diameter": 30.0, "outer_diameter": 84.0}})
    assert plain.views[1].notes[0].text == "5 spokes 8 wide"


@pytest.mark.parametrize(("count", "drawn"), [(0, 0), (1, 1), (3, 3), (4, 4), (30, 30), (99, 30)])
def test_so_many_teeth_are_drawn_exactly_about_the_upward_direction(count: int, drawn: int) -> None:
    """The rest is the tip circle, from the end of the last to the beginning of the first."""
    view = drawing_of(SPUR | {"number_of_teeth": 30, "face_width": 10.0}, teeth=count).views[1]
    curves = [c for layer, c in view.strokes if layer == VISIBLE]
    tips = [c for c in curves if isinstance(c, Arc) and c.radius == pytest.approx(32.0)]
    pitch = math.tau / 30
    if not drawn:
        assert [abs(c.sweep) for c in tips] == [pytest.approx(math.tau)]
        return
    # tooth k is centred on k pitches; the one nearest to the upward direction stands in the middle of an odd number
    rest = [c for c in tips if abs(c.sweep) > pitch * 0.6]
    lands = sorted((c.start_angle + c.sweep / 2) % math.tau for c in tips if c not in rest)
    assert len(lands) == drawn
    assert len(rest) == (drawn < 30)
    if drawn < 30:
        (arc,) = rest
        assert abs(arc.sweep) == pytest.approx(math.tau - drawn * pitch)
        first, last = (round(x / pitch) for x in (lands[0], lands[-1]))
        assert last - first == drawn - 1
        middle = (first + last) / 2
        assert abs(middle - 7.5) <= 0.5 + 1e-9
        # begins half a pitch beyond the last tooth
        ends_ = sorted((arc.start_angle % math.tau, (arc.start_angle + arc.sweep) % math.tau))
        assert ends_ == pytest.approx(sorted(((last + 0.5) * pitch, (first - 0.5) * pitch)))


def test_a_plain_round_part_has_the_sign_on_its_outside() -> None:
    """Seven tenths along its width; of a groove cam it is that of its outside where it runs."""
    pin = drawing_of(
        {"kind": "eccentric", "diameter": 40.0, "bore_diameter": 10.0, "eccentricity": 4.0, "face_width": 10.0}
    )
    rough = [n for n in pin.views[0].notes if n.is_rough]
    assert rough[0].at == pytest.approx(complex(7.0, rough[0].at.imag))
