"""Solids turned from half a section, laid anywhere: area, moments and reach against integrals along the section."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.curves.curve import Complex, Real
from geometry.solids.area import surface_area
from geometry.solids.charts import Chart, charts
from geometry.solids.extent import extent
from geometry.solids.face_moments import face_moments
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Extrusion,
    Frame,
    Plane,
    Solid,
    Sphere,
    SplineSurface,
    Straight,
    Torus,
)  # fmt: skip
from geometry.solids.mass import Moments
from geometry.solids.rings import AHEAD, UP
from geometry.solids.turned import Corner, HalfSection, Hole, half_section, turned_solid

# shares of the nodes of Gauss's rule on (0, 1), and their weights
NODES, WEIGHTS = (x / 2 for x in np.polynomial.legendre.leggauss(24))
NODES = NODES + 0.5

SECTIONS: dict[str, tuple[Corner, ...]] = {
    "frustum": (Corner(0j), Corner(5 + 0j), Corner(3 + 4j), Corner(4j)),
    "cone upwards": (Corner(0j), Corner(5 + 0j), Corner(6j)),
    "funnel": (Corner(0j), Corner(5 + 5j), Corner(5 + 8j), Corner(2j)),
    "ball": (Corner(-5j, arc=5.0), Corner(5j)),
    "lens": (Corner(0j), Corner(5 + 0j, arc=7.25), Corner(2j)),
    "zone of a ball": (Corner(-3j), Corner(4 - 3j, arc=5.0), Corner(3 + 4j), Corner(4j)),
    "bowl": (Corner(0j), Corner(4 + 0j), Corner(4 + 6j, arc=-4.0), Corner(2j)),
    "ring": (Corner(10 - 1.5j, arc=1.5), Corner(10 + 1.5j, arc=1.5)),
    "grooved and rounded": (
        Corner(3 + 0j, chamfer=0.5), Corner(9 + 0j), Corner(9 + 2j, arc=-1.5), Corner(9 + 4j),
        Corner(9 + 8j, fillet=2.0), Corner(3 + 8j)),
    "bulging": (
        Corner(2 + 0j), Corner(6 + 0j, arc=3.0), Corner(6 + 5j), Corner(4 + 5j), Corner(4 + 7j), Corner(2 + 7j)),
    "hollow": (Corner(2 + 0j), Corner(8 + 0j), Corner(8 + 9j), Corner(5 + 9j, arc=2.5), Corner(5 + 4j), Corner(2 + 1j)),
}  # fmt: skip
RING = (Corner(2 + 0j), Corner(6 + 0j), Corner(6 + 5j), Corner(2 + 5j))
HOLES = Hole(4 * np.exp(0.4j), 0.7), Hole(4.5 * np.exp(2.9j), 0.4)


def motion(axis: Sequence[float], angle: float) -> Real:
    """The matrix of a turn about an axis, by Rodrigues."""
    k = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


PLACES = [
    (np.eye(3), np.zeros(3)),
    (np.eye(3), np.array([3.0, -7.0, 11.0])),
    (motion([1, 0, 0], math.pi), np.array([0.0, 0.0, 2.0])),
    (motion([1, 2, -0.5], 1.1), np.array([4.0, -2.0, 5.0])),
    (motion([-1, 0.3, 2], 2.6), np.array([-30.0, 1.0, -0.5])),
]


def frame_moved(frame: Frame, turn: Real) -> Frame:
    return Frame(frame.origin, frame.axis @ turn.T, frame.zero @ turn.T)


def moved(solid: Solid, turn: Real, shift: Real) -> Solid:
    """The solid turned about the origin and shifted: its points, frames and directions."""
    edges = []
    for edge in solid.edges:
        curve = edge.curve
        if isinstance(curve, Circular):
            curve = replace(curve, frame=frame_moved(curve.frame, turn))
        elif isinstance(curve, Straight):
            curve = Straight(curve.direction @ turn.T)
        edges.append(replace(edge, curve=curve))
    faces = []
    for face in solid.faces:
        surface = face.surface
        assert not isinstance(surface, SplineSurface | Extrusion)
        faces.append(replace(face, surface=replace(surface, frame=frame_moved(surface.frame, turn))))
    return Solid(solid.points @ turn.T + shift, solid.vertices, tuple(edges), tuple(faces))


@cache
def solid_of(name: str, seam: float = 0.0, scale: float = 1.0) -> Solid:
    section = HalfSection(half_section([_scaled(c, scale) for c in SECTIONS[name]]))
    made = turned_solid(section, seam)
    assert (made.max_error, made.bound) == (0.0, "exact")
    return made.geometry


def _scaled(corner: Corner, scale: float) -> Corner:
    return Corner(corner.at * scale, corner.arc * scale, corner.chamfer * scale, corner.fillet * scale)


@cache
def outline(name: str, samples: int = 0) -> tuple[Complex, Complex, Real]:
    """Of a section its places, steps and weights, edge by edge; with ``samples`` evenly instead of by Gauss's rule.

    Written anew from what corners say: chamfers and fillets are put where tangents of lines touch.
    """
    corners: list[Corner] = []
    told = SECTIONS[name]
    for k, corner in enumerate(told):
        if not (corner.chamfer or corner.fillet):
            corners.append(corner)
            continue
        back, ahead = (x - corner.at for x in (told[k - 1].at, told[(k + 1) % len(told)].at))
        back, ahead = back / abs(back), ahead / abs(ahead)
        half = abs(np.angle(ahead / back)) / 2
        leg = corner.chamfer or corner.fillet / math.tan(half)
        corners += [Corner(corner.at + leg * back, arc=corner.fillet), Corner(corner.at + leg * ahead)]
    shares = np.linspace(0, 1, samples) if samples else NODES
    weights = np.zeros(len(shares)) if samples else WEIGHTS
    places, steps = [], []
    for one, two in zip(corners, [*corners[1:], corners[0]], strict=True):
        chord = two.at - one.at
        if not one.arc:
            places.append(one.at + chord * shares)
            steps.append(np.full(len(shares), chord))
            continue
        # seen from its centre the chord of an arc that bulges to the right of the way is twice asin(c / 2 r) wide
        half = math.asin(abs(chord) / 2 / abs(one.arc))
        side = math.copysign(1.0, one.arc)
        centre = (one.at + two.at) / 2 + 1j * side * chord / abs(chord) * abs(one.arc) * math.cos(half)
        spoke = (one.at - centre) * np.exp(2j * side * half * shares)
        places.append(centre + spoke)
        steps.append(2j * side * half * spoke)
    return np.concatenate(places), np.concatenate(steps), np.tile(weights, len(places))


def area_of(name: str) -> float:
    """Guldin's first rule."""
    p, d, w = outline(name)
    return float(2 * math.pi * (p.real * np.abs(d)) @ w)


def moments_of(name: str) -> Moments:
    """Of the turned section, by Green's theorem: integrals of r^(k+1) z^m over it, along its outline."""
    p, d, w = outline(name)
    r, z, dz = p.real, p.imag, d.imag

    def inside(k: int, m: int) -> float:
        return float((r ** (k + 1) / (k + 1) * z**m * dz) @ w)

    volume, height = 2 * math.pi * inside(1, 0), 2 * math.pi * inside(1, 1)
    across, along = math.pi * inside(3, 0), 2 * math.pi * inside(1, 2)
    inertia = np.diag([across + along, across + along, 2 * across])
    return Moments(volume, np.array([0, 0, height / volume]), inertia)


def parallel(volume: float, at: Real) -> Real:
    """What Steiner's rule adds to the tensor about the centre."""
    return volume * (at @ at * np.eye(3) - np.outer(at, at))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", SECTIONS)
def test_area_and_moments_do_not_hang_on_where_a_solid_lies(name: str) -> None:
    own = moments_of(name)
    about = own.inertia - parallel(own.volume, own.centre)
    for k, (turn, shift) in enumerate(PLACES):
        solid = moved(solid_of(name, seam=0.7 * k), turn, shift)
        assert surface_area(solid) == pytest.approx(area_of(name), rel=1e-11)
        found, centre = face_moments(solid), turn @ own.centre + shift
        assert found.volume == pytest.approx(own.volume, rel=1e-11)
        assert found.centre == pytest.approx(centre, abs=1e-9)
        wanted = turn @ about @ turn.T + parallel(own.volume, centre)
        assert found.inertia == pytest.approx(wanted, abs=1e-10 * np.abs(wanted).max())


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", SECTIONS)
def test_a_solid_reaches_as_far_as_its_circles(name: str) -> None:
    """A circle about an axis a reaches z (a d) + r |a x d| along d: the most of it over the section."""
    places = outline(name, 2001)[0]
    for turn, shift in PLACES[3:]:
        found = extent(moved(solid_of(name), turn, shift))
        along = turn[:, 2]
        across = np.sqrt(1 - along**2)
        for sense, got in ((1, found.high), (-1, -found.low)):
            reach = (sense * np.outer(places.imag, along) + np.outer(places.real, across)).max(axis=0)
            assert got == pytest.approx(reach + sense * shift, abs=2e-6)
        some, angles = outline(name, 81)[0], np.exp(1j * np.linspace(0, 2 * math.pi, 361))
        rim = np.stack([*(np.outer(some.real, x) for x in (angles.real, angles.imag)),
                        np.broadcast_to(some.imag[:, None], (len(some), len(angles)))], axis=-1)  # fmt: skip
        x, y, _ = np.moveaxis(rim @ turn.T + shift, -1, 0)
        most = float(np.hypot(x, y).max())
        assert most - 1e-9 < found.radius < most * (1 + 5e-4)


def test_twice_the_size_is_four_times_the_area_and_eight_times_the_volume() -> None:
    for name in ("bowl", "grooved and rounded"):
        one, two = solid_of(name), solid_of(name, scale=2.0)
        assert surface_area(two) == pytest.approx(4 * surface_area(one), rel=1e-12)
        first, second = face_moments(one), face_moments(two)
        assert second.volume == pytest.approx(8 * first.volume, rel=1e-12)
        assert second.inertia == pytest.approx(32 * first.inertia, rel=1e-10, abs=1e-8)


@pytest.mark.parametrize("seam", [0.0, 2.1])
def test_holes_take_away_what_their_cylinders_hold(seam: float) -> None:
    """Area: two round ends less, a wall more; inertia by Steiner."""
    plain, drilled = (turned_solid(HalfSection(half_section(RING), own), seam).geometry for own in ((), HOLES))
    for turn, shift in PLACES[:4:3]:
        one, two = (moved(s, turn, shift) for s in (plain, drilled))
        sizes = [h.radius for h in HOLES]
        more = sum(2 * math.pi * r * 5 - 2 * math.pi * r**2 for r in sizes)
        assert surface_area(two) - surface_area(one) == pytest.approx(more, abs=1e-9)
        first, second = face_moments(one), face_moments(two)
        lost, inertia = 0.0, np.zeros((3, 3))
        for hole in HOLES:
            volume = math.pi * hole.radius**2 * 5
            centre = turn @ np.array([hole.centre.real, hole.centre.imag, 2.5]) + shift
            side = volume * (hole.radius**2 / 4 + 25 / 12)
            own = np.diag([side, side, volume * hole.radius**2 / 2])
            lost += volume
            inertia += turn @ own @ turn.T + parallel(volume, centre)
        assert first.volume - second.volume == pytest.approx(lost, rel=1e-10)
        assert first.inertia - second.inertia == pytest.approx(inertia, abs=1e-8 * np.abs(first.inertia).max())
        assert extent(one).radius == pytest.approx(extent(two).radius, abs=1e-9)


@pytest.mark.parametrize("name", ["frustum", "zone of a ball", "grooved and rounded", "hollow"])
def test_charts_lead_to_points_and_back(name: str) -> None:
    """u x v as difference quotients tell, places a height above a surface at that distance from it."""
    rng = np.random.default_rng(7)
    turn, shift = PLACES[3]
    solid = moved(solid_of(name), turn, shift)
    step, seen = 1e-6, set()
    for faces in solid.faces:
        surface = faces.surface
        for chart in charts(solid, surface, 1):
            seen.add(type(surface).__name__)
            u, v = rng.uniform(-3, 3, 40), rng.uniform(0.1, 1.2, 40)
            points, normals = chart.with_normal(u, v)
            assert chart.spatial(u, v) == pytest.approx(points)
            du, dv = ((chart.spatial(u + a, v + b) - chart.spatial(u - a, v - b)) / (2 * step)
                      for a, b in ((step, 0.0), (0.0, step)))  # fmt: skip
            assert normals == pytest.approx(np.cross(du, dv), abs=1e-7)
            back = chart.flat(points)
            assert back[0] == pytest.approx(u)
            assert back[1] == pytest.approx(v)
            size = np.linalg.norm(normals, axis=1, keepdims=True)
            for height in (0.0, 0.05, -0.05):
                assert chart.distance(points + height * normals / size) == pytest.approx(abs(height), abs=1e-12)
            angle = 0.9
            if not chart.is_plane:
                assert chart.turned(chart, chart.spatial(u - angle, v), angle) == pytest.approx(points)
    assert seen


def chart_at(surface: str, origin: Real, turn: Real, size: float = 3.0, other: float = 1.0) -> Chart:
    frame = Frame(np.zeros(1, dtype=int), UP, AHEAD)
    made = {"plane": Plane(frame), "cylinder": Cylinder(frame, size), "cone": Cone(frame, size, other),
            "sphere": Sphere(frame, size), "torus": Torus(frame, size, other)}  # fmt: skip
    return Chart(made[surface], origin, turn.T)


def test_surfaces_are_one_where_turns_and_shifts_along_them_say_so() -> None:
    """A plane, its other side, shifted within it; a cylinder shifted along its axis, a cone where it is wider, ..."""
    turn, at = PLACES[3]
    about = turn @ motion([0, 0, 1], 1.3)
    over = turn @ motion([1, 0, 0], math.pi)
    axis, aside = turn[:, 2], turn[:, 0]
    step = 2.0 * math.tan(0.3)
    same = {
        "plane": [chart_at("plane", at + 5 * aside, about), chart_at("plane", at, over)],
        "cylinder": [chart_at("cylinder", at + 4 * axis, about), chart_at("cylinder", at - axis, over)],
        "cone": [chart_at("cone", at + 2 * axis, about, 3.0 + step, 0.3)],
        "sphere": [chart_at("sphere", at, over)],
        "torus": [chart_at("torus", at, about), chart_at("torus", at, over)],
    }
    others = {
        "plane": [chart_at("plane", at + 1e-6 * axis, turn)],
        "cylinder": [chart_at("cylinder", at, turn, 3.001), chart_at("cylinder", at + 1e-6 * aside, turn)],
        "cone": [chart_at("cone", at, turn, 3.0, 0.31), chart_at("cone", at + axis, turn, 3.0, 0.3),
                 chart_at("cone", at, over, 3.0, 0.3)],
        "sphere": [chart_at("sphere", at + 1e-6 * axis, turn), chart_at("sphere", at, turn, 3.001)],
        "torus": [chart_at("torus", at + 1e-6 * axis, turn), chart_at("torus", at, turn, 3.001),
                  chart_at("torus", at, turn, 3.0, 1.001)],
    }  # fmt: skip
    for kind, charts_ in same.items():
        first = chart_at(kind, at, turn, 3.0, 0.3) if kind == "cone" else chart_at(kind, at, turn)
        assert first.alike[0] == kind
        for other in charts_:
            assert other.alike == pytest.approx(first.alike) if kind == "cone" else other.alike == first.alike
        for other in others[kind]:
            assert other.alike != first.alike
    # about the z axis, anywhere on it, upside down too; planes across it wherever they begin
    upside = np.diag([1.0, -1.0, -1.0])
    for kind in same:
        for central in (chart_at(kind, np.array([0.0, 0.0, 7.0]), np.eye(3)), chart_at(kind, np.zeros(3), upside)):
            assert central.is_central
        assert not chart_at(kind, np.zeros(3), motion([1, 0, 0], 0.1)).is_central
        assert not chart_at(kind, np.zeros(3), motion([0, 1, 0], 0.1)).is_central
        for beside in ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]):
            assert chart_at(kind, np.array(beside), np.eye(3)).is_central == (kind == "plane")
