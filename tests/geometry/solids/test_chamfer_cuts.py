"""Chamfers cut into pieces: where an edge opens, how far straight lines bow, and what the pieces hold."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from geometry.curves.line_arc import Arc
from geometry.plane.profile import Label, Profile, Segment, circle
from geometry.solids.body import Body, BodyBuilder
from geometry.solids.body_faces import cut_for_faces
from geometry.solids.chamfer import chamfer_bow, cut_chamfers, even_shares, level_pieces, openings
from geometry.solids.mass import body_moments
from geometry.solids.plate import rounded
from parts.scene.load import make_parts, scene_from_dict


def square(half: float, radius: float) -> Profile:
    """A square of this half width with round corners."""
    corners = [complex(x, y) * half for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    edges = rounded([(c, max(radius, 0.0)) for c in corners])
    return Profile(tuple(Segment(e, Label.BODY) for e in edges))


def chamfered(section: Callable[[float], Profile], low: float, high: float) -> Body:
    """Upright from ``low`` - 1 to ``low``, and from there a chamfer to ``high``, with this section at a depth."""
    made = BodyBuilder()
    whole, end = section(0.0), section(high - low)
    foot, middle = made.upright(whole, low - 1, low)
    top = made.loop(end, high)
    made.wall(middle, top, lambda z: section(z - low))
    made.cap(foot, [], up=False)
    made.cap(top, [], up=True)
    return made.body()


def test_shares_of_pieces() -> None:
    assert even_shares(3) == pytest.approx((1 / 3, 2 / 3, 1.0))
    # two pieces up to where an edge opens are four, and as many from there on, the n-th up to (n / 4)^4 of the rest
    rest = [0.2 + 0.8 * (k / 4) ** 4 for k in (1, 2, 3, 4)]
    assert even_shares(2, 0.2) == pytest.approx((0.05, 0.1, 0.15, 0.2, *rest))
    assert even_shares(2, 0.0) == pytest.approx([(k / 4) ** 4 for k in (1, 2, 3, 4)])


@pytest.mark.parametrize("radius", [0.5, 2.0, 3.9])
def test_an_edge_opens_where_a_rounding_is_used_up(radius: float) -> None:
    body = chamfered(lambda depth: square(10.0 - depth, radius - depth), 0.0, 4.0)
    ((wall, whole, end),) = body.chamfers()
    (found,) = openings(body, wall, whole, end)
    assert radius / 4 - 1e-4 <= found <= radius / 4
    # upside down alike: shares count from the whole boundary
    made = BodyBuilder()
    top, bottom = made.loop(body.loop_profile(whole), 4.0), made.loop(body.loop_profile(end), 0.0)
    made.wall(bottom, top, lambda z: square(6.0 + z, radius - 4.0 + z))
    turned = made.body()
    ((wall, whole, end),) = turned.chamfers()
    assert openings(turned, wall, whole, end) == pytest.approx((found,), abs=1e-9)


def test_edges_open_one_after_the_other() -> None:
    """Where roundings of 0.5, 2 and 3 mm are used up; what opens within the same share of the depth is told once."""
    corners = [complex(x, y) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    def section(depth: float) -> Profile:
        radii = [max(radius - depth, 0.0) for radius in (0.5, 2.0, 3.0, 2.0)]
        edges = rounded([(c * (10.0 - depth), radius) for c, radius in zip(corners, radii, strict=True)])
        return Profile(tuple(Segment(e, Label.BODY) for e in edges))

    body = chamfered(section, 0.0, 4.0)
    found = openings(body, *next(iter(body.chamfers())))
    assert found == pytest.approx([radius / 4 for radius in (0.5, 2.0, 3.0)], abs=1e-4)


def test_no_edge_opens_where_none_is_new() -> None:
    for radius in (0.0, 4.5):
        body = chamfered(lambda depth, radius=radius: square(10.0 - depth, radius - depth if radius else 0.0), 0.0, 4.0)
        ((wall, whole, end),) = body.chamfers()
        assert openings(body, wall, whole, end) == ()
    # from the first on
    body = chamfered(lambda depth: square(10.0 - depth, 1e-5 - depth), 0.0, 4.0)
    assert openings(body, *next(iter(body.chamfers()))) == (0.0,)


@pytest.mark.parametrize("bow", [0.3, -0.3, 0.0])
def test_lines_bow_as_sections_do(bow: float) -> None:
    """A round chamfer from 10 to 8 whose radius runs 4 h s (1 - s) beside the line: h in its middle."""

    def section(depth: float) -> Profile:
        share = depth / 4
        return circle(10.0 - 2 * share + 4 * bow * share * (1 - share), Label.BODY)

    body = chamfered(section, 1.0, 5.0)
    ((wall, whole, end),) = body.chamfers()
    assert chamfer_bow(body, [(wall, whole, end)]) == pytest.approx(1.1 * abs(bow), rel=1e-9)
    count = math.ceil(math.sqrt(1.1 * abs(bow) / (0.25 * 0.01))) or 1
    assert level_pieces(body, 0.01)(wall, whole, end) == pytest.approx([k / count for k in range(1, count + 1)])


def test_pieces_hold_what_the_chamfer_holds() -> None:
    """Cut where it is told, above and below, profiles once each: the volume stays."""
    body = chamfered(lambda depth: square(10.0 - depth, 3.0 - depth), 0.0, 2.0)
    asked: list[tuple[int, int]] = []

    def pieces(wall: object, whole: int, end: int) -> tuple[float, ...]:
        asked.append((whole, end))
        return 0.25, 0.5, 1.0

    cut = cut_chamfers(body, pieces)
    assert len(asked) == 1
    assert cut.levels() == pytest.approx((-1.0, 0.0, 0.5, 1.0, 2.0))
    assert len(cut.walls) == 1 + 3
    assert cut.caps == body.caps
    assert body_moments(cut).volume == pytest.approx(body_moments(body).volume, rel=1e-12)
    # sides of 20 - 2 s with corners of 3 - s: (4 - pi) (3 - s)^2 is cut off
    chamfer = (20**3 - 16**3) / 6 - (4 - math.pi) * (27 - 1) / 3
    assert body_moments(body).volume == pytest.approx(400 - (4 - math.pi) * 9 + chamfer, rel=1e-12)
    assert cut_chamfers(body, lambda *_: (1.0,)) is body
    assert isinstance(body.profiles[0].period[1].curve, Arc)


def test_teeth_that_open_one_after_the_other_are_cut_where_each_does() -> None:
    """Those of an oval do at 0.43 and 0.87 of the depth: cut alike for all they took 32 pieces of 180 faces."""
    keys = {"kind": "noncircular_gear", "centrode": "oval", "number_of_teeth": 30, "module": 2.0, "axis_ratio": 1.5}
    scene = {"parts": {"p": keys | {"face_width": 10.0, "bore_diameter": 8.0, "face_chamfer": {"above": 0.5}}}}
    body = make_parts(scene_from_dict(scene, "t", "t"), "t")[0]["p"].body(0.0)
    assert isinstance(body, Body)
    levels = np.unique(cut_for_faces(body).levels())
    assert levels == pytest.approx([0.0, 9.5, 9.5 + 0.5 * 0.433, 9.5 + 0.5 * 0.873, 10.0], abs=1e-3)
