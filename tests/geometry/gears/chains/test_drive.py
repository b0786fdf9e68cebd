"""Chain drives: rigid links all round, hulls of shapely, textbooks, rollers against teeth."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from shapely.geometry import MultiPoint, Point, Polygon

from geometry.base.record import replace
from geometry.gears.chains.chain import chain_of
from geometry.gears.chains.drive import (
    ChainDrive,
    ChainMesh,
    exact_distance,
    links_for,
    pitch_radius,
    symmetric_phases,
    textbook_distance,
    textbook_links,
)
from geometry.gears.chains.sprocket import GostForm, IsoForm, Sprocket, sprocket_side
from geometry.plane.distance import Verdict
from geometry.plane.loop import Wheel

DRIVES = [((17, 38), 100), ((38, 17), 101), ((9, 9), 30), ((9, 9), 31), ((6, 25), 50), ((20, 63), 114), ((8, 60), 91)]


def meshed(teeth: tuple[int, int], links: int, form: IsoForm | GostForm | None = None, share: float = 1.0) -> ChainMesh:
    """A drive of chain 08B, ``share`` of its greatest distance apart."""
    chain = chain_of("08B")
    assert chain is not None
    one, two = (Sprocket(z, chain, form or IsoForm()) for z in teeth)
    mesh = ChainMesh((one, two), 1.0, links)
    distance = exact_distance(teeth, links, mesh.least_distance)
    assert distance is not None
    return replace(mesh, centre_distance=share * distance * chain.pitch)


@pytest.mark.parametrize(("teeth", "links"), DRIVES)
def test_taut_chains_are_hulls_of_both_polygons(teeth: tuple[int, int], links: int) -> None:
    drive = meshed(teeth, links).drive
    rng = np.random.default_rng(links)
    for first, second in rng.uniform(-1, 1, (20, 2)) * drive.steps + [math.pi, 0]:
        pins = [
            at + cmath.rect(radius, phase + k * step)
            for at, radius, phase, step, count in zip(
                (0.0, drive.distance), drive.radii, (first, second), drive.steps, teeth, strict=True
            )
            for k in range(count)
        ]
        hull = MultiPoint([(p.real, p.imag) for p in pins]).convex_hull
        assert drive.above(first, second) + drive.below(first, second) == pytest.approx(hull.length, rel=1e-12)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("teeth", "links"), DRIVES)
@pytest.mark.parametrize("share", [1.0, 0.995])
def test_every_link_is_a_pitch_long_at_every_phase(teeth: tuple[int, int], links: int, share: float) -> None:
    """Pins that stand so, as many as links, are a chain: it goes round at this distance whatever the phase."""
    mesh = meshed(teeth, links, share=share)
    for part in np.linspace(-0.5, 0.5, 11):
        first = math.pi + part * mesh.drive.steps[0]
        second, rollers = mesh.rollers(first)
        assert len(rollers) == links
        assert np.abs(rollers - np.roll(rollers, 1)) == pytest.approx(mesh.pitch, rel=1e-11)
        # once round, clockwise, and in the seats of both where they are wrapped
        ways = np.angle(np.roll(rollers, -2) - np.roll(rollers, -1)) - np.angle(np.roll(rollers, -1) - rollers)
        turns = (ways + math.pi) % (2 * math.pi) - math.pi
        assert turns.sum() == pytest.approx(-2 * math.pi)
        for at, radius, phase, step in zip(
            (0.0, mesh.centre_distance), mesh.drive.radii, (first, second), mesh.drive.steps, strict=True
        ):
            seated = rollers[np.abs(np.abs(rollers - at) - radius * mesh.pitch) < 1e-9 * mesh.pitch] - at
            assert len(seated) >= 3
            assert np.remainder(np.angle(seated) - phase + 1e-6, step) == pytest.approx(1e-6, abs=1e-9)


@pytest.mark.parametrize(("teeth", "links"), DRIVES)
def test_no_chain_goes_round_farther_apart(teeth: tuple[int, int], links: int) -> None:
    """A hair beyond, the hull of one stand is longer than the chain, which is taut there at the exact distance."""
    mesh = meshed(teeth, links)
    assert mesh.slack == pytest.approx(0.0, abs=1e-9)
    assert replace(mesh, shift=1e-6).slack < -1e-7
    lengths = [
        ChainDrive(teeth, mesh.drive.distance).above(*phases) + ChainDrive(teeth, mesh.drive.distance).below(*phases)
        for phases in (symmetric_phases(teeth, links, half) for half in (False, True))
    ]
    assert max(lengths) == pytest.approx(links, rel=1e-12)
    least = mesh.least_distance
    assert links_for(teeth, mesh.drive.distance, least) == links + links % 2
    assert links_for(teeth, mesh.drive.distance * (1 + 1e-6), least) == links + 2 - links % 2


def test_textbooks_are_as_near_as_their_circles() -> None:
    """A belt about circles of circumference z p, by the series of its length to the second order.

    The example of 20 and 63 teeth with 114 links has 35.6 pitches in Shigley's textbook; by the exact belt 35.590.
    """
    assert textbook_distance((20, 63), 114) == pytest.approx(35.6, abs=0.05)
    for teeth, links in DRIVES:
        exact = exact_distance(teeth, links, sum(teeth) / 6)
        assert exact is not None
        assert textbook_links(teeth, textbook_distance(teeth, links)) == pytest.approx(links, rel=1e-12)
        assert 0 <= textbook_distance(teeth, links) - exact < 0.025
    # equal sprockets, one with a pin and one with a link on the line of centres: both strands parallel, whole
    assert exact_distance((17, 17), 81, 6.0) == pytest.approx((81 - 17) / 2, rel=1e-12)
    # with a pin on it at both of 9: strands along a tangent of the polygon, 5 seats on each
    radius = 0.5 / math.sin(math.pi / 9)
    assert exact_distance((9, 9), 30, 4.0) == pytest.approx(11 - 2 * radius * math.cos(4 * math.pi / 9), rel=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("form", [IsoForm(), IsoForm(1.0), GostForm(), GostForm(displaced=True)], ids=repr)
def test_rollers_touch_and_cut_no_teeth(form: IsoForm | GostForm) -> None:
    mesh = meshed((11, 17), 44, form, share=0.998)
    found = mesh.contact()
    gap = 0.0 if isinstance(form, IsoForm) else 0.0025 * 8.51 + 0.05
    assert found.verdict is (Verdict.CLEAR if gap else Verdict.CONTACT)
    assert found.worst.gap == pytest.approx(gap, abs=1e-9)
    # the same by disks and polygons
    second, rollers = mesh.rollers(math.pi + 0.1)
    for sprocket, at, phase in zip(mesh.sprockets, (0.0, mesh.centre_distance), (math.pi + 0.1, second), strict=True):
        turn = cmath.rect(1.0, phase + sprocket.pitch_angle / 2)
        curves = [s.curve for s in sprocket_side(sprocket).profile().segments()]
        outline = at + turn * np.concatenate([c.point(np.linspace(*c.domain, 100)[:-1]) for c in curves])
        plate = Polygon(np.column_stack((outline.real, outline.imag)))
        near = rollers[np.abs(rollers - at) < sprocket.tip_radius + 8.51]
        gaps = [plate.distance(Point(p.real, p.imag)) - 8.51 / 2 for p in near]
        assert min(gaps) == pytest.approx(gap, abs=2e-3)


def test_six_teeth_of_the_minimum_form_are_in_the_way() -> None:
    assert meshed((6, 25), 50).contact().verdict is Verdict.OVERLAP
    assert [f.code for f in meshed((6, 60), 91).findings()] == ["odd_number_of_links"]
    assert [f.code for f in meshed((11, 100), 112).findings()] == ["small_wrap"]
    assert [f.code for f in meshed((17, 38), 100, share=0.95).findings()] == ["chain_hangs_loose"]


def about(*idlers: Wheel, teeth: tuple[int, int] = (17, 38), links: int = 0) -> ChainMesh:
    """A drive of chain 08B, 18.1 pitches apart, with idlers in pitches, as many links as go round, or more."""
    mesh = replace(meshed(teeth, 66), idlers=idlers)
    mesh = replace(mesh, centre_distance=18.1 * mesh.pitch)
    return replace(mesh, links=links or 2 * math.ceil(mesh.drive.longest() / 2))


INSIDE = Wheel(8.0 + 6.3j, pitch_radius(11))
OUTSIDE = Wheel(9.0 - 3.6j, pitch_radius(11), True)
SMOOTH = Wheel(8.5 + 3.6j, 1.7, True)


def test_taut_chains_about_an_idler_inside_are_hulls_of_three_polygons() -> None:
    drive, lengths = about(INSIDE).drive, []
    for first in math.pi + (np.arange(24) / 24 - 0.5) * drive.steps[0]:
        second, whole = drive.taut(first)
        phases, counts = drive.side(range(drive.loop.second), first, second)
        assert [len(phases), len(counts)] == [2, 1]
        links = [drive.links(0, *phases), drive.links(1, phases[1], second)]
        assert links == pytest.approx([round(x) for x in links], rel=1e-9)
        rows = zip((0j, INSIDE.centre, drive.distance + 0j), (17, 11, 38), (*phases, second), strict=True)
        pins = [c + cmath.rect(pitch_radius(z), at + 2 * math.pi * k / z) for c, z, at in rows for k in range(z)]
        hull = MultiPoint([(p.real, p.imag) for p in pins]).convex_hull
        assert drive.above(first, second) == pytest.approx(whole, abs=1e-12)
        assert whole + drive.below(first, second) == pytest.approx(hull.length, rel=1e-12)
        lengths.append(hull.length)
    assert drive.longest() == pytest.approx(max(lengths), rel=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("idlers", [(INSIDE,), (OUTSIDE,), (INSIDE, OUTSIDE), (SMOOTH,)])
def test_every_link_about_idlers_is_a_pitch_long_and_seated(idlers: tuple[Wheel, ...]) -> None:
    """So many links go round at every phase; with two fewer some strand would be longer than its links."""
    mesh = about(*idlers)
    assert mesh.drive.loop.missed() == ()
    assert 0 <= mesh.slack < 2 * mesh.pitch
    for part in np.linspace(-0.5, 0.5, 7):
        first = math.pi + part * mesh.drive.steps[0]
        second, rollers = mesh.rollers(first)
        assert len(rollers) == mesh.links
        assert np.abs(rollers - np.roll(rollers, 1)) == pytest.approx(mesh.pitch, rel=1e-11)
        ways = np.angle(np.roll(rollers, -2) - np.roll(rollers, -1)) - np.angle(np.roll(rollers, -1) - rollers)
        assert ((ways + math.pi) % (2 * math.pi) - math.pi).sum() == pytest.approx(-2 * math.pi)
        for at, radius, phase, step in zip(
            (0.0, mesh.centre_distance), mesh.drive.radii, (first, second), mesh.drive.steps, strict=True
        ):
            seated = rollers[np.abs(np.abs(rollers - at) - radius * mesh.pitch) < 1e-9 * mesh.pitch] - at
            assert len(seated) >= 6
            assert np.remainder(np.angle(seated) - phase + 1e-6, step) == pytest.approx(1e-6, abs=1e-9)
    # the same upside down, but for which strand is not whole
    other = about(*(replace(idler, centre=idler.centre.conjugate()) for idler in idlers))
    assert other.links == mesh.links
    assert other.drive.longest() == pytest.approx(mesh.drive.longest(), abs=0.01)


def test_the_last_idler_makes_the_chain_taut_where_it_is_told_to() -> None:
    mesh = about(INSIDE, OUTSIDE)
    assert mesh.slack > 1.0
    place = mesh.taut_idler
    assert place is not None
    moved = replace(mesh, idlers=(INSIDE, replace(OUTSIDE, centre=place / mesh.pitch)))
    assert abs(moved.slack) < 1e-3
    # all strands are taut: pins of the idlers stand on their circles
    rollers = moved.rollers(math.pi)[1] / mesh.pitch
    for idler in moved.idlers:
        assert np.abs(rollers - idler.centre).min() == pytest.approx(idler.radius, abs=0.02)
    assert mesh.contact().verdict is Verdict.CONTACT
