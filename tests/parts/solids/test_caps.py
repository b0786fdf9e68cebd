"""Triangles of plane regions: they fill them to the last corner, teeth by themselves, rings by their middle angles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from exporters.command.cli import main
from geometry.base.errors import ThinWallError
from geometry.base.record import replace
from geometry.curves.curve import Complex
from geometry.plane.contour import Contour
from parts.solids.caps import aligned_bore, begun_at, cap_triangles, is_round, start_in_space
from tests.parts.solids.filling import Three, filled, sides_of, turned


def polar(*corners: tuple[float, float]) -> Complex:
    """Points at radii and angles, degrees."""
    return np.array([r * np.exp(1j * math.radians(a)) for r, a in corners])


def contour(vertices: Complex, count: int = 1, *, clockwise: bool = False) -> Contour:
    return Contour(vertices, np.arange(len(vertices)) / 100, count, clockwise)


def polygon(count: int, radius: float, start: float = 0.0, middle: complex = 0j) -> Contour:
    """A clockwise hole of even chords."""
    return contour(middle + radius * np.exp(1j * (start - 2 * np.pi * np.arange(count) / count)))


# four teeth that lean, 5 corners of one above its root and 3 of the land behind it
TOOTH = ((10.0, -15.0), (11.0, -13.0), (12.5, -11.0), (13.0, 4.0), (12.0, 9.0), (11.2, 12.0), (10.0, 14.0))
LAND = ((10.0, 30.0), (10.0, 50.0))
WHEEL = contour(polar(*TOOTH, *LAND), 4)
# its land is one corner
SHARP = contour(polar((10.0, -45.0), (13.0, -5.0), (13.0, 5.0)), 4)
# the rim of a toothed recess, clockwise: its root stands inside
RECESS = contour(polar((10.0, 15.0), (12.0, 8.0), (12.0, -8.0), (10.0, -15.0), (10.0, -40.0)), 4, clockwise=True)
HOOKED = contour(
    polar(
        (10.0, -15.0), (12.0, -5.0), (13.0, 10.0), (11.5, 36.0), (10.6, 34.0), (11.4, 20.0), (10.0, 12.0), (10.0, 40.0)
    ),
    4,
)
PLATE = contour(np.array([-15 - 14j, 15 - 14j, 15 + 14j, 2 - 3j, -15 + 14j]))
REGIONS: dict[str, tuple[Contour, tuple[Contour, ...]]] = {
    "wheel": (WHEEL, ()),
    "sharp wheel": (SHARP, ()),
    "bored": (WHEEL, (polygon(12, 4.0),)),
    "bored anyhow": (WHEEL, (polygon(7, 6.5, 0.3),)),
    "bored the other way": (WHEEL, (contour(polygon(9, 5.0).vertices[::-1]),)),
    "finely bored": (SHARP, (polygon(40, 3.0, 0.1),)),
    "bored in step": (SHARP, (polygon(4, 4.0, np.pi / 4),)),
    "off its middle": (WHEEL, (polygon(8, 1.5, 0.2, 3 + 1j),)),
    "windows": (WHEEL, tuple(polygon(6, 2.0, 0.1, 5 * 1j**k) for k in range(4))),
    # corners of many holes in one line
    "holes in rows": (
        contour(100 * np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])),
        tuple(polygon(4, 2.0, 0.0, complex(x, y)) for x in range(-20, 21, 10) for y in range(-20, 21, 10)),
    ),
    # teeth that are no ladders: they hook over the land
    "hooked": (HOOKED, (polygon(6, 3.0),)),
    # cuts the chord between the roots of a tooth
    "bored into a tooth": (WHEEL, (polygon(6, 3.0, 0.0, 8 + 0j),)),
    "recess": (RECESS, (polygon(10, 3.0),)),
    "two teeth": (contour(polar((10.0, -20.0), (12.0, 20.0), (10.0, 80.0)), 2), ()),
    "bent": (PLATE, ()),
    "bent, bored": (PLATE, (polygon(5, 2.0, 0.0, -4 - 9j), polygon(5, 2.0, 0.0, 5 - 9j))),
}


def filled_caps(outer: Contour, holes: Sequence[Contour]) -> tuple[list[Three], list[complex]]:
    """Triangles that fill a region, and the corners of its bounds with those that were added."""
    found, added = cap_triangles(outer, holes)
    loops = [c.expanded()[0] for c in (outer, *holes)]
    points = np.concatenate([*loops, added]).tolist()
    ends = np.cumsum([0, *(len(x) for x in loops)]).tolist()
    return filled(points, found.tolist(), [range(a, b) for a, b in pairwise(ends)]), points


@pytest.mark.parametrize("name", REGIONS)
def test_triangles_fill_the_region(name: str) -> None:
    filled_caps(*REGIONS[name])


@pytest.mark.parametrize("name", REGIONS)
def test_a_region_1024_times_as_small_has_the_same_triangles(name: str) -> None:
    outer, holes = (
        tuple(replace(c, vertices=c.vertices / 1024) for c in cs) for cs in ((REGIONS[name][0],), REGIONS[name][1])
    )
    assert cap_triangles(outer[0], holes)[0].tolist() == cap_triangles(*REGIONS[name])[0].tolist()


@pytest.mark.parametrize("name", ["wheel", "sharp wheel", "bored", "recess", "hooked"])
def test_every_tooth_is_alike(name: str) -> None:
    """Turned by a pitch, triangles come upon triangles: corner k upon the corner a period on."""
    outer, holes = REGIONS[name]
    holes = tuple(polygon(12, 3.0) for _ in holes)
    triangles, points = filled_caps(outer, holes)
    whole, turn = len(outer), 1j
    places = {(round(p.real, 6), round(p.imag, 6)): k for k, p in enumerate(points)}
    after = [places[round((p * turn).real, 6), round((p * turn).imag, 6)] for p in points]
    assert len(places) == len(points) > whole or not holes
    apart = {frozenset(x) for x in triangles}
    assert {frozenset(after[k] for k in x) for x in triangles} == apart


@pytest.mark.parametrize("name", ["wheel", "bored", "bored anyhow", "off its middle", "windows"])
def test_a_tooth_is_cut_off_at_its_root(name: str) -> None:
    """What has a corner above the root has all of them in that tooth, and there are two fewer than its corners."""
    triangles, _ = filled_caps(*REGIONS[name])
    size = len(WHEEL.vertices)
    for k in range(4):
        above = set(range(k * size + 1, k * size + 6))
        own = [x for x in triangles if above & set(x)]
        assert {c for x in own for c in x} == above | {k * size, k * size + 6}
        assert len(own) == 5


def test_a_tooth_that_hooks_over_is_cut_off_at_its_root_too() -> None:
    triangles, _ = filled_caps(*REGIONS["hooked"])
    for k in range(4):
        above = set(range(k * 8 + 1, k * 8 + 6))
        own = [x for x in triangles if above & set(x)]
        assert {c for x in own for c in x} == above | {k * 8, k * 8 + 6}
        assert len(own) == 5


def test_a_tooth_is_a_ladder() -> None:
    """Rungs go up: what lies beyond one is no lower, from the chord between the roots, than either of its ends."""
    triangles, points = filled_caps(WHEEL, ())
    tooth = {0, 1, 2, 3, 4, 5, 6}
    base = points[6] - points[0]
    height = [-turned(points[0], points[6], points[k]) / abs(base) for k in range(7)]
    rungs = {(min(a, b), max(a, b)) for x in triangles if set(x) <= tooth for a, b, _ in sides_of(x) if abs(a - b) > 1}
    assert len(rungs) == 5
    for low, high in rungs:
        assert min(height[low + 1 : high]) >= max(height[low], height[high]) - 1e-9


@pytest.mark.parametrize("name", ["bored", "bored anyhow", "finely bored", "bored in step"])
def test_edges_of_a_ring_take_the_corner_across_at_their_middle_angle(name: str) -> None:
    """The corner between those two edges of the other side whose middles are next to the edge's own, before and after.

    Where the middles of both are one angle, the inner edge is taken first.
    """
    outer, holes = REGIONS[name]
    triangles, points = filled_caps(outer, holes)
    whole, bore = len(outer), len(holes[0])
    land = [k for k in range(whole) if abs(abs(points[k]) - 10) < 1e-9]
    inner = list(range(whole + bore - 1, whole - 1, -1))
    for ring, other in ((land, inner), (inner, land)):
        apex = {
            frozenset((a, b)): c for x in triangles for a, b, c in (x, (x[1], x[2], x[0]), (x[2], x[0], x[1]))
            if {a, b} <= set(ring) and c in other
        }  # fmt: skip
        assert len(apex) == len(ring)
        for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
            middle = angle(points[a] / abs(points[a]) + points[b] / abs(points[b]))
            across = []
            for k, c in enumerate(other):
                around = other[k - 1], other[(k + 1) % len(other)]
                low, high = (angle(points[c] / abs(points[c]) + points[x] / abs(points[x])) for x in around)
                first, last = (middle - low + 1e-9) % math.tau, (high - low) % math.tau
                # middles that are one: the inner edge comes before the outer one
                tied = min(first, abs(first - last)) < 2e-9
                if first < last - 1e-9 if not tied else (first < 2e-9) is (ring is inner):
                    across.append(c)
            assert [apex[frozenset((a, b))]] == across


def angle(way: complex) -> float:
    return math.atan2(way.imag, way.real)


def test_a_wheel_without_a_bore_has_one_corner_more_in_its_middle() -> None:
    for outer in (WHEEL, SHARP):
        triangles, points = filled_caps(outer, ())
        assert points[len(outer) :] == [0]
        rim = 16 if outer is WHEEL else 4
        assert sum(len(outer) in x for x in triangles) == rim
    assert len(cap_triangles(*REGIONS["bored"])[1]) == len(cap_triangles(*REGIONS["bent"])[1]) == 0
    # the axis does not see every edge: no corner there
    far = replace(PLATE, vertices=PLATE.vertices + 40)
    assert len(filled_caps(far, ())[1]) == len(far)


def thin(bore: float, teeth: int = 12) -> tuple[Contour, Contour]:
    """A rim of teeth whose chords across their roots cut a bore; a period begins 8 / 30 of it before its tooth."""
    corners = ((10.0, -8.0), (12.0, -4.0), (12.0, 4.0), *((10.0, a) for a in (8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0)))
    rim = contour(polar(*((r, a * 12 / teeth) for r, a in corners)), teeth)
    return rim, aligned_bore(rim, polygon(70, bore))


def test_a_bore_is_aligned_with_corners_behind_every_tooth() -> None:
    """As many as it had or more, a multiple of the teeth, on its circle, one where each period begins; clockwise."""
    rim, bore = thin(9.95)
    assert len(bore) == 72
    assert np.abs(bore.vertices) == pytest.approx(np.full(72, 9.95), rel=1e-12)
    steps = np.angle(np.roll(bore.vertices, -1) / bore.vertices)
    assert steps == pytest.approx(np.full(72, -math.tau / 72), abs=1e-12)
    assert np.degrees(np.angle(bore.vertices[0])) == pytest.approx(-8.0)
    assert len(aligned_bore(rim, polygon(72, 9.0))) == 72
    assert len(aligned_bore(rim, polygon(73, 9.0))) == 84
    assert not bore.bulges.any()


@pytest.mark.parametrize("teeth", [3, 12])
def test_a_rim_thinner_than_its_chords_is_cut_by_sectors(teeth: int) -> None:
    """Chords across the teeth pass the bore; so each tooth keeps what stands behind it, one sector like the other."""
    rim, bore = thin(9.95, teeth)
    assert 10 * math.cos(math.radians(8 * 12 / teeth)) < 9.95 * math.cos(math.pi / 72)
    triangles, points = filled_caps(rim, (bore,))
    pitch = 360 / teeth
    for x in triangles:
        turns = [(math.degrees(angle(points[k])) / pitch + 8 / 30) % teeth for k in x]
        sector = math.floor((math.degrees(angle(sum(points[k] for k in x))) / pitch + 8 / 30) % teeth)
        assert all(
            min((t - sector) % teeth, (sector - t) % teeth) < 1e-9 or (t - sector) % teeth < 1 + 1e-9 for t in turns
        )
    places = {(round(p.real, 6) + 0.0, round(p.imag, 6) + 0.0): k for k, p in enumerate(points)}
    moved = [p * np.exp(1j * math.tau / teeth) for p in points]
    after = [places[round(p.real, 6) + 0.0, round(p.imag, 6) + 0.0] for p in moved]
    assert {frozenset(after[k] for k in x) for x in triangles} == {frozenset(x) for x in triangles}


def test_outlines_that_touch_or_cross_are_refused() -> None:
    for holes in (
        (polygon(12, 10.5),),
        (polygon(30, 13.5),),
        (polygon(6, 3.0, 0.0, 10 + 0j),),
        (polygon(6, 2.0), polygon(6, 3.0, 0.0, 1 + 1j)),
    ):
        with pytest.raises(ThinWallError, match="touch or cross"):
            cap_triangles(WHEEL, holes)
    rim, bore = thin(10.05)
    with pytest.raises(ThinWallError, match="touch or cross"):
        cap_triangles(rim, (bore,))


@pytest.mark.parametrize(
    ("corners", "index"),
    [
        # a tooth on +x, its land begins at 20 degrees and goes over the limit of the period at 45
        (((12.0, -10.0), (12.0, 10.0), (10.0, 20.0), (10.0, 40.0), (10.0, 50.0), (10.0, 65.0)), 5),
        # the land's corners before the tooth are those of the period before
        (((10.0, -44.0), (10.0, -20.0), (12.0, -10.0), (12.0, 10.0), (10.0, 20.0), (10.0, 44.0)), 1),
        # begun on a flank, and with one corner in the space
        (((12.0, 10.0), (10.0, 20.0), (10.0, 45.0), (10.0, 70.0), (12.0, 80.0)), 3),
        (((12.0, -10.0), (12.0, 10.0), (10.0, 45.0)), 2),
        # corners off by rounding stand on the root circle, those off by more do not
        (((10.0, -45.0), (10.0 + 5e-9, -30.0), (12.0, 0.0)), 1),
        (((10.0, -45.0), (10.0 + 2e-8, -30.0), (12.0, 0.0)), 0),
        # the first in the space stands higher than the root: it is not on the land
        (((12.0, 0.0), (10.5, 46.0), (10.0, 50.0), (10.5, 60.0)), 1),
        # no tooth at all
        (((10.0, -30.0), (10.0, 0.0), (10.0, 30.0), (10.0, 44.0)), 3),
    ],
)
def test_a_contour_begins_where_a_tooth_leaves_the_root_circle(
    corners: tuple[tuple[float, float], ...], index: int
) -> None:
    assert start_in_space(contour(polar(*corners), 4)) == index


@pytest.mark.parametrize("clockwise", [False, True])
@pytest.mark.parametrize("index", [0, 1, 4])
def test_a_contour_begun_elsewhere_is_the_same(clockwise: bool, index: int) -> None:
    own = contour(polar(*TOOTH) if not clockwise else polar(*TOOTH)[::-1], 4, clockwise=clockwise)
    found = begun_at(own, index)
    assert (found.count, found.clockwise) == (4, clockwise)
    for one, two in zip(found.expanded(), own.expanded(), strict=True):
        assert one == pytest.approx(np.roll(two, -index), abs=1e-12)


def test_round_is_what_has_all_corners_on_one_circle() -> None:
    even = polygon(9, 5.0)
    assert is_round(even)
    assert is_round(replace(even, vertices=even.vertices * np.exp(1j * np.arange(9) ** 2 / 50)))
    for off, found in ((4e-12, True), (6e-12, False)):
        moved = even.vertices.copy()
        moved[4] *= 1 + off / 5
        assert is_round(replace(even, vertices=moved)) is found
    assert not is_round(replace(even, vertices=even.vertices + 1e-9))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("teeth", [35, 50])
def test_no_triangle_between_digits_is_turned_over_by_the_numbers_of_a_file(teeth: int, tmp_path: Path) -> None:
    """Corners of three strokes in one line: by fractions of the float32 numbers that the STL has."""
    (tmp_path / "s.toml").write_text(
        f'[parts.p]\nkind = "ring_gear"\nmodule = 0.5\nnumber_of_teeth = {teeth}\nface_width = 5.0\ntooth_mark = {{}}\n'
        '[[exports]]\nformat = "stl"\n'
    )
    assert main(["build", str(tmp_path / "s.toml"), "--out", str(tmp_path), "-q"]) == 0
    data = (tmp_path / "s" / "p.stl").read_bytes()
    rows = np.frombuffer(data[84:], np.dtype([("n", "<3f4"), ("v", "<3,3f4"), ("a", "<u2")]))["v"]
    tops = [row for row in rows.tolist() if all(z == 5.0 for _, _, z in row)]
    areas = [(b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
             for a, b, c in ([[Fraction(x) for x in place] for place in row] for row in tops)]  # fmt: skip
    assert len(areas) > 300
    assert min(areas) > 0
