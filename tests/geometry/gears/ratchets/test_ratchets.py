"""Ratchet wheels and pawls: teeth by their own circles and lines, the ride against polygons laid on each other."""

from __future__ import annotations

import cmath
import itertools
import math

import numpy as np
import pytest
from shapely import affinity
from shapely.geometry import Point, Polygon

from geometry.base.record import replace
from geometry.curves.line_arc import Arc
from geometry.gears.ratchets.contact import RatchetContact
from geometry.gears.ratchets.pawl import PawlShape, checked_pawl
from geometry.gears.ratchets.wheel import RatchetWheel, checked_wheel
from geometry.plane.distance import Verdict
from geometry.solids.plate import Edge
from tests.sampling import some_of

# chords of an arc; what they leave of a swing, rad; an area that is none, mm^2
_CHORDS, _NEAR, _NOTHING = 160, 2e-4, 1e-7

STRAIGHT = RatchetWheel(16, 40.0, 3.75, math.radians(15), 0.5, land=5.0)
WHEELS = {
    "straight back": STRAIGHT,
    "notch of 60": replace(STRAIGHT, land=None, notch_angle=math.radians(60)),
    "root land": replace(STRAIGHT, notch_angle=math.radians(56)),
    "sharp": replace(STRAIGHT, fillet_radius=0.0),
    "six": RatchetWheel(6, 30.0, 6.0, math.radians(12), 1.0, notch_angle=math.radians(60)),
    "ring": RatchetWheel(24, 60.0, 3.75, math.radians(15), 0.5, land=5.0, internal=True, outer_radius=72.0),
    "radial": replace(STRAIGHT, front_angle=0.0),
    "clockwise": replace(STRAIGHT, ccw=False),
}


def pawl_for(wheel: RatchetWheel, *, clearance_deg: float = 10.0, line_deg: float | None = None) -> PawlShape:
    """A pawl that stands clear of the teeth."""
    line = math.radians((45.0 if wheel.internal else 0.0) if line_deg is None else line_deg)
    length = wheel.tip_radius * (math.sin(line) if wheel.internal else 0.8)
    nose = max(1.2 * wheel.fillet_radius, 0.3)
    return checked_pawl(PawlShape(wheel, length, line, nose, math.radians(clearance_deg), 0.5, 3.0, 4.0))


def polygon(edges: tuple[Edge, ...]) -> Polygon:
    """Chords of an outline."""
    parts = [e.point(np.linspace(*e.domain, _CHORDS if isinstance(e, Arc) else 2))[:-1] for e in edges]
    return Polygon([(p.real, p.imag) for p in np.concatenate(parts)])


def wheel_polygon(wheel: RatchetWheel) -> Polygon:
    found = polygon(replace(wheel, ccw=True).outline())
    return Point(0, 0).buffer(wheel.outer_radius, 256).difference(found) if wheel.internal else found


@pytest.mark.parametrize("name", WHEELS)
def test_teeth_have_the_sizes_that_were_asked_for(name: str) -> None:
    """By the vertices of the outline alone: circles, land, front angle, rounding, number, sense."""
    wheel = checked_wheel(WHEELS[name])
    edges = wheel.outline()
    teeth, side = wheel.number_of_teeth, wheel.side
    places = np.concatenate([e.point(np.linspace(*e.domain, 2001)) for e in edges])
    tip, root = (np.abs(places).max(), np.abs(places).min())[::side]
    assert tip == pytest.approx(wheel.tip_radius, abs=1e-9)
    # a root is touched within a step of 1/2000 of its rounding
    assert side * (tip - root) == pytest.approx(wheel.depth, abs=1e-6)
    lands = [e for e in edges if isinstance(e, Arc) and e.centre == 0 and math.isclose(e.radius, wheel.tip_radius)]
    assert len(lands) == teeth
    if wheel.land is not None:
        assert [abs(e.sweep) * e.radius for e in lands] == pytest.approx([wheel.land] * teeth)
    rounds = [e for e in edges if isinstance(e, Arc) and e.centre != 0]
    assert len(rounds) == (0 if name == "sharp" else 2 * teeth if name == "root land" else teeth)
    assert all(e.radius == pytest.approx(wheel.fillet_radius) for e in rounds)
    # the line of each face passes the axis at the radius of the circle that all of them touch, on one side
    turn = 1 if wheel.ccw else -1
    for k in range(teeth):
        edge = cmath.rect(wheel.tip_radius, 2 * math.pi * k / teeth)
        faces = [
            e for e in edges if not isinstance(e, Arc)
            and min(abs(e.start - edge), abs(e.end - edge)) < 1e-9
        ]  # fmt: skip
        (face,) = faces
        low = face.start if abs(face.end - edge) < 1e-9 else face.end
        way = (edge - low) / abs(edge - low) * side
        across = (way.conjugate() * edge).imag
        assert turn * side * across == pytest.approx(wheel.tip_radius * math.sin(wheel.front_angle), abs=1e-9)


def test_the_back_and_the_face_make_the_notch_angle() -> None:
    for name in ("notch of 60", "root land"):
        wheel = WHEELS[name]
        notch, edge = wheel.notch, complex(wheel.tip_radius)
        back, face = notch.back_start - notch.back_end, edge - notch.face_end
        assert abs(cmath.phase(back / face)) == pytest.approx(wheel.notch_angle)


def test_a_tooth_is_as_thick_as_its_roots_stand_apart() -> None:
    """From the end of one arc of the root circle to the start of the next one, along the outline."""
    wheel = WHEELS["root land"]
    lands = [e for e in wheel.outline() if isinstance(e, Arc) and e.centre == 0 and e.radius < wheel.tip_radius - 1]
    one, two = lands[:2]
    gap = abs(complex(two.point(two.domain[0])) - complex(one.point(one.domain[1])))
    assert len(lands) == wheel.number_of_teeth
    assert wheel.root_thickness == pytest.approx(gap, rel=1e-9)


def ridden(pawl: PawlShape, turn: float) -> tuple[float, float]:
    """By bisection of polygons: where the pawl comes to rest from above, and how deep it overlaps a little lower."""
    fixed = affinity.rotate(wheel_polygon(pawl.wheel), turn, (0, 0), use_radians=True)
    own, pivot = polygon(pawl.edges()), (pawl.pivot.real, pawl.pivot.imag)

    def common(lift: float) -> float:
        swung = affinity.rotate(own, -pawl.wheel.side * lift, pivot, use_radians=True)
        return float(swung.intersection(fixed).area)

    high = pawl.swing + 0.02
    steps = np.linspace(high, -0.01, 60).tolist()
    free, held = next(((a, b) for a, b in itertools.pairwise(steps) if common(b) > _NOTHING), (0.0, 0.0))
    for _ in range(24):
        middle = (free + held) / 2
        free, held = (free, middle) if common(middle) > _NOTHING else (middle, held)
    return free, common(free - 0.01)


RIDES = [(name, 10.0, None) for name in WHEELS if name != "clockwise"]
RIDES += [("straight back", 1.0, None), ("straight back", 30.0, 10.0), ("ring", 25.0, 60.0), ("notch of 60", 4.0, -5.0)]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("name", "clearance", "line"), RIDES)
def test_a_pawl_rides_where_polygons_first_meet(name: str, clearance: float, line: float | None) -> None:
    """From where the tooth before it has let it drop to where the next one does."""
    pawl = pawl_for(WHEELS[name], clearance_deg=clearance, line_deg=line)
    pitch = pawl.wheel.pitch_angle
    for share in some_of([0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97], 5):
        turn = pawl.overrun + share * pitch
        found, below = ridden(pawl, turn)
        assert pawl.stands(turn) == pytest.approx(found, abs=_NEAR)
        assert below > _NOTHING


def blocked(pawl: PawlShape, turn: float) -> float:
    """By polygons: the most that is in the way, mm^2, as a pawl comes down from a land to where it stands."""
    fixed = affinity.rotate(wheel_polygon(pawl.wheel), turn, (0, 0), use_radians=True)
    own, pivot = polygon(pawl.edges()), (pawl.pivot.real, pawl.pivot.imag)
    lifts = np.linspace(pawl.swing, pawl.stands(turn) + 1e-3, 60)
    swung = [affinity.rotate(own, -pawl.wheel.side * x, pivot, use_radians=True) for x in lifts.tolist()]
    return max(float(one.intersection(fixed).area) for one in swung)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", WHEELS)
def test_a_pawl_drops_where_the_edge_is_beyond_its_reach(name: str) -> None:
    """A little later all of its way down is free, a little earlier not; seated it overlaps nothing."""
    pawl = pawl_for(WHEELS[name])
    assert polygon(pawl.edges()).intersection(wheel_polygon(pawl.wheel)).area < 1e-3
    assert pawl.overrun > 0
    assert blocked(pawl, pawl.overrun * 1.01) < 1e-5
    assert blocked(pawl, pawl.overrun * 0.8) > 1e-5


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", WHEELS)
def test_contact_is_seen_and_what_is_off_is_not_taken_for_it(name: str) -> None:
    pawl = pawl_for(WHEELS[name])
    whole = RatchetContact(pawl).result()
    assert whole.verdict is Verdict.CONTACT
    assert abs(whole.worst.gap) < 1e-9 * pawl.wheel.tip_radius
    # lifted off a back it is clear, pressed in it overlaps; nearer to the teeth it does too
    lifted, middle = -pawl.wheel.side * 1e-4, pawl.wheel.pitch_angle / 2
    for sign in (1, -1):
        gap, _ = RatchetContact(pawl, turn=sign * lifted).gap(middle)
        assert 0.2 < sign * gap / (1e-4 * pawl.length) < 1.1
    assert RatchetContact(pawl, turn=-lifted).result().verdict is Verdict.OVERLAP
    assert RatchetContact(pawl, shift=-0.01 * pawl.wheel.side).result().verdict is Verdict.OVERLAP


def test_motion_begins_seated_and_never_enters_a_tooth() -> None:
    """Over three pitches, dropping pawls included: it is never below where it would touch, and jumps nowhere."""
    pawl = pawl_for(STRAIGHT)
    pitch = pawl.wheel.pitch_angle
    turns = np.linspace(0, 3 * pitch, 3001)
    lifts = np.array([pawl.lift(t) for t in turns.tolist()])
    assert lifts[0] == 0
    assert pawl.lift(-0.1) == 0
    assert np.abs(np.diff(lifts)).max() < 0.05 * pawl.swing
    assert lifts.max() == pytest.approx(pawl.swing)
    later = turns > pitch + pawl.overrun
    least = [pawl.stands(pawl.overrun + math.fmod(t - pawl.overrun, pitch)) for t in turns[later].tolist()]
    assert (lifts[later] >= np.array(least) - 1e-12).all()


def test_the_push_turns_the_pawl_in_where_the_angle_says_so() -> None:
    """Moment of the tooth's push about the pivot, in vectors: its sign is that of the angle, on either side of 0."""
    for name, front, line in itertools.product(("straight back", "ring"), (-10.0, 5.0, 20.0), (-3.0, 7.0, 50.0)):
        if name == "straight back" and line > 10:
            continue
        pawl = replace(pawl_for(WHEELS[name]), line_angle=math.radians(line))
        pawl = replace(pawl, wheel=replace(pawl.wheel, front_angle=math.radians(front)))
        arm, push = pawl.edge - pawl.pivot, pawl.wheel.face_normal
        moment = (arm.conjugate() * push).imag
        # towards an external wheel is counter-clockwise about the pivot
        assert pawl.wheel.side * moment == pytest.approx(pawl.length * math.sin(pawl.pull_in_angle))
