"""Helical gears against a rack prism swept in space, meshes of screw surfaces against the surfaces, hands that mesh."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest

from geometry.approximation.twisted import approximate_twisted
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.helix import Helix, mesh_fault
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.rack import Rack, rack_region
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_limits import root_form_diameter
from geometry.gears.teeth.ring_offset import ring_region
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear, transverse_rack
from geometry.gears.teeth.transverse_ring import transverse_ring
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Label, Profile
from geometry.solids.body import Body, Twist, plate
from geometry.solids.mass import body_moments
from geometry.solids.screw import cut_twists, heights, turn_error, turn_spans, turn_spline
from parts.solids.mesh import Mesh, body_mesh, mesh_outlines
from tests.oracles.rack_sweep import RackTool
from tests.oracles.space_rack import space_penetration
from tests.strategies import with_default_cutter

GEARS = {
    "m 2 z 23, 30 degrees": (SpurGear(2.0, 23, iso_53("A")), 30.0),
    "undercut": (SpurGear(1.0, 9, iso_53("A")), 15.0),
    "shifted, 45 degrees": (SpurGear(3.0, 17, iso_53("B"), 0.4), 45.0),
    "relieved": (SpurGear(2.0, 30, iso_53("A", relief=TipRelief(0.02)), -0.1), 25.0),
    "full round, 60 degrees": (SpurGear(1.0, 20, replace(iso_53("A"), tip_radius=0.4719)), 60.0),
    "thinned": (SpurGear(2.0, 40, iso_53("D"), 0.2, circumferential_thinning=0.1), 10.0),
}
EACH_GEAR = pytest.mark.parametrize(("normal", "degrees"), GEARS.values(), ids=GEARS.keys())


def tool_of(normal: SpurGear, helix: float) -> RackTool:
    """The normal rack; a transverse thinning widens its tooth by cos(beta) of it."""
    rack, relief = normal.rack, normal.rack.relief or TipRelief(0.0)
    return RackTool(
        normal.module, rack.pressure_angle, rack.addendum, rack.tip_clearance, rack.tip_radius,
        normal.profile_shift_coefficient, normal.circumferential_thinning * math.cos(helix), relief.depth,
        relief.height,
    )  # fmt: skip


def outline_points(profile: Profile, count: int = 9) -> np.ndarray:
    """Points inside all segments but the tip's, of one period."""
    share = (np.arange(count) + 0.5) / count
    kept = [s.curve for s in profile.period if s.label not in (Label.TIP_LAND, Label.TIP_BREAK)]
    return np.concatenate([c.point(c.domain[0] + (c.domain[1] - c.domain[0]) * share) for c in kept])


@EACH_GEAR
def test_a_rack_prism_in_space_cuts_the_screw_surface(normal: SpurGear, degrees: float) -> None:
    """Points of the wall at any height touch the swept normal rack and are never inside it."""
    helix = math.radians(degrees)
    gear = transverse_gear(normal, helix)
    for hand in ("right", "left"):
        signed = helix if hand == "right" else -helix
        twist = Helix(helix, hand).twist(gear.reference_radius)
        assert twist is not None
        region = gear_region(gear).region
        body = plate(region, 0.0, 12.0, twist, toothed=region.outer)
        wall = next(w for w in body.walls if body.is_screw(w))
        points = outline_points(body.loop_profile(wall.lower))
        z = np.linspace(0.0, 12.0, len(points))
        placed = points * np.exp(1j * body.turn_at(wall, z))
        found = space_penetration(placed, z, tool_of(normal, helix), normal.number_of_teeth, signed)
        assert np.abs(found).max() < 2e-11 * gear.tip_radius
    # the other hand's rack does not touch there: the oracle knows hands
    wrong = space_penetration(placed, z, tool_of(normal, helix), normal.number_of_teeth, -signed)
    assert np.abs(wrong).max() > 0.05 * normal.module


def test_the_circle_of_the_former_stand_in_is_seen() -> None:
    """A circular rounding of the transverse rack, to the same form height, is off by hundredths of a module."""
    normal, helix = SpurGear(2.0, 23, iso_53("A")), math.radians(30.0)
    gear = transverse_gear(normal, helix)
    rack, cosine = gear.rack, math.cos(helix)
    radius = normal.rack.tip_radius * cosine * (1 - math.sin(normal.rack.pressure_angle))
    circular = replace(rack, stretch=1.0, tip_radius=radius / (1 - math.sin(rack.pressure_angle)))
    assert circular.form_dedendum == pytest.approx(rack.form_dedendum, rel=1e-14)
    points = outline_points(gear_region(replace(gear, rack=circular)).region.outer)
    found = space_penetration(points, np.zeros(len(points)), tool_of(normal, helix), 23, helix)
    assert 1e-3 < np.abs(found).max() < 0.05


@pytest.mark.sampled(2)
@EACH_GEAR
@pytest.mark.parametrize("offset", [-0.1, 0.1])
def test_an_offset_moves_the_section_by_it(normal: SpurGear, degrees: float, offset: float) -> None:
    gear = transverse_gear(normal, math.radians(degrees))
    moved = outline_points(gear_region(gear, offset).region.outer)
    found = distance_to_profile(moved, gear_region(gear).region.outer)
    assert found == pytest.approx(np.full(len(moved), abs(offset)), abs=1e-9) or offset > 0
    assert found.max() <= abs(offset) + 1e-9


def test_a_normal_ring_keeps_its_normal_heights() -> None:
    """GOST 19274: h = (h_a - x - k) m_n below the reference circle; the cutter's depth in normal modules above it."""
    helix = math.radians(25.0)
    normal = RingGear(2.0, 60, math.radians(20.0), 1e9, with_default_cutter(
        RingGear(2.0, 60, math.radians(20.0), 1e9, None)).root, 0.3)  # type: ignore[arg-type]  # fmt: skip
    ring = transverse_ring(normal, helix)
    assert ring.reference_radius == pytest.approx(60.0 / math.cos(helix), rel=1e-14)
    shortening = 0.25 - 0.125 * 0.3
    assert ring.reference_radius - ring.tip_radius == pytest.approx(2.0 * (1 - 0.3 - shortening), rel=1e-12)
    assert root_form_diameter(ring) < 2 * ring.root_radius
    assert transverse_ring(normal, 0.0) is normal


@pytest.mark.parametrize("twist", [0.3, -1.0, 2.0])
@pytest.mark.parametrize("spans", [1, 2, 5])
def test_a_turn_is_off_by_less_than_its_bound(twist: float, spans: int) -> None:
    spline = turn_spline(twist, spans)
    v = np.linspace(0.0, 1.0, 4001)
    error = np.abs(spline.point(v) - np.exp(1j * twist * v)).max()
    bound = (abs(twist) / spans) ** 8 / (math.factorial(8) * 2**8)
    assert error <= bound + 1e-14
    assert error >= 0.9 * bound - 1e-14
    rise = np.interp(v, [0, 1], [2.0, 5.0])
    lifted = replace(spline, poles=heights(spline, 2.0, 5.0).astype(complex))
    assert np.abs(lifted.point(v) - rise).max() < 1e-13


@pytest.mark.parametrize("reach", [0.5, 30.0, 5e4])
def test_spans_keep_the_error_of_a_turn(reach: float) -> None:
    for twist in (1e-9, 0.4, 2.0):
        spline = turn_spline(twist, turn_spans(twist, reach))
        v = np.linspace(0.0, 1.0, 999)
        assert reach * np.abs(spline.point(v) - np.exp(1j * twist * v)).max() <= turn_error(reach)


def gear_body(degrees: float = 30.0, width: float = 20.0, *, double: bool = False, teeth: int = 23) -> Body:
    gear = transverse_gear(SpurGear(2.0, teeth, iso_53("A"), bore_diameter=8.0), math.radians(degrees))
    twist = Helix(math.radians(degrees), "right", double).twist(gear.reference_radius)
    region = gear_region(gear).region
    return plate(region, 0.0, width, twist, toothed=region.outer)


def measured(mesh: Mesh, body: Body, declared: float, samples: int = 5) -> float:
    """Greatest distance within its own height of a mesh's twisted walls from the exact sections."""
    places = [(i, j, samples - i - j) for i in range(samples + 1) for j in range(samples + 1 - i)]
    shares = np.array(places) / samples
    corners = mesh.vertices[mesh.triangles]
    worst = 0.0
    for wall in (w for w in body.walls if body.is_screw(w)):
        low, high = body.height(wall)
        z = corners[:, :, 2]
        outside = np.abs(corners[:, :, 0] + 1j * corners[:, :, 1]).min(axis=1) > 10.0
        mine = corners[outside & (np.ptp(z, axis=1) > 0) & (z.min(axis=1) >= low) & (z.max(axis=1) <= high)]
        # all teeth are alike, and so are all slices: a thousand triangles have every kind among them
        points = np.einsum("pk,nkc->npc", shares, mine[:: max(1, len(mine) // 997)]).reshape(-1, 3)
        turn = body.loops[wall.lower].turn + (points[:, 2] - low) / (high - low) * body.twist(wall)
        back = (points[:, 0] + 1j * points[:, 1]) * np.exp(-1j * turn)
        worst = max(worst, float(distance_to_profile(back, body.loop_profile(wall.lower), trusted=declared).max()))
    return worst


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("degrees", "teeth"), [(30.0, 23), (8.0, 60), (45.0, 12)])
@pytest.mark.parametrize("tolerance", [0.05, 0.01])
def test_meshes_keep_their_bound_and_the_bound_is_tight(degrees: float, teeth: int, tolerance: float) -> None:
    body = gear_body(degrees, 10.0, teeth=teeth)
    made = mesh_outlines(body, tolerance, 1e-4)
    found = measured(body_mesh(body, made), body, made[0].max_error)
    assert made[0].max_error <= tolerance
    assert found <= made[0].max_error <= 2 * found


def test_a_step_that_is_too_wide_breaks_the_bound() -> None:
    """Control: the same chords with slices half as many again are seen to be off by more."""
    body = gear_body()
    made = list(mesh_outlines(body, 0.01, 1e-4))
    made[0] = replace(made[0], turn_step=1.5 * made[0].turn_step)
    assert measured(body_mesh(body, tuple(made)), body, 0.01) > 0.01


def test_mirrored_hands_get_the_same_mesh() -> None:
    profile = gear_body().loop_profile(0)
    made = approximate_twisted(profile, 0.01)
    assert np.allclose(np.sort(np.abs(made.geometry.vertices)), np.sort(np.abs(np.conj(made.geometry.vertices))))
    assert made.bound == "certified"


def test_mass_of_moved_walls_against_a_fine_mesh() -> None:
    """Volume, centre and inertia of a double helical rack, whose sections move, by sums over tetrahedra."""
    basic = transverse_rack(iso_53("A"), math.radians(20.0))
    region = rack_region(Rack(2.0 / math.cos(math.radians(20.0)), 5, basic, 5.0)).region
    for twist in (Twist(slope=-0.36 + 0j), Twist(slope=0.36 + 0j, double=True)):
        body = plate(region, 1.0, 21.0, twist, toothed=region.outer)
        mesh = body_mesh(body, mesh_outlines(body, 2e-5, 0.0))
        volume, first, second = _tetrahedra(mesh)
        exact = body_moments(body)
        assert volume == pytest.approx(exact.volume, rel=1e-5)
        assert first / volume == pytest.approx(exact.centre, abs=1e-4)
        inertia = np.trace(second) * np.eye(3) - second
        assert inertia == pytest.approx(exact.inertia, rel=1e-5, abs=1e-5 * np.trace(second))


def _tetrahedra(mesh: Mesh) -> tuple[float, np.ndarray, np.ndarray]:
    """Integrals of 1, r and r r^T over a mesh, from tetrahedra with their tips at the origin."""
    corners = mesh.vertices[mesh.triangles]
    volume = np.linalg.det(corners) / 6
    total = corners.sum(axis=1)
    second = np.einsum("n,nki,nkj->ij", volume, corners, corners) + np.einsum("n,ni,nj->ij", volume, total, total)
    return float(volume.sum()), np.einsum("n,ni->i", volume, total) / 4, second / 20


def test_mass_of_a_turned_section_without_symmetry() -> None:
    """A bore's keyway does not turn, but a body may: moments of one period turn with the section."""
    region = rack_region(Rack(2.0, 3, iso_53("A"), 5.0)).region
    body = plate(region, 0.0, 10.0, Twist(0.05), toothed=region.outer)
    mesh = body_mesh(body, mesh_outlines(body, 1e-3, 0.0))
    volume, first, _ = _tetrahedra(mesh)
    exact = body_moments(body)
    assert volume == pytest.approx(exact.volume, rel=1e-4)
    assert first / volume == pytest.approx(exact.centre, abs=1e-3)


def test_cut_twists_leave_the_surface_alone() -> None:
    body = gear_body(45.0, 200.0)
    cut = cut_twists(body)
    assert len(cut.walls) > len(body.walls)
    assert max(abs(cut.twist(w)) for w in cut.walls) <= 2.0
    rates = {round(cut.twist(w) / (cut.height(w)[1] - cut.height(w)[0]), 12) for w in cut.walls if cut.is_screw(w)}
    assert len(rates) == 1
    assert body_moments(cut).volume == pytest.approx(body_moments(body).volume, rel=1e-13)


@pytest.mark.parametrize(
    ("first", "second", "internal"), list(product(("right", "left"), ("right", "left"), (False, True)))
)
def test_hands_mesh_where_the_pitch_lines_move_alike(first: str, second: str, internal: bool) -> None:
    """On the pitch line both sections must move alike with the height: r_1 w_1 = -r_2 w_2, or + for a ring."""
    helices = [Helix(0.3, hand) for hand in (first, second)]  # type: ignore[arg-type]
    moves = [h.twist(r).rate * r for h, r in zip(helices, (20.0, 55.0), strict=True)]  # type: ignore[union-attr]
    alike = moves[0] == pytest.approx(moves[1] if internal else -moves[1])
    fault = mesh_fault(*helices, internal=internal)
    assert (fault is None) == alike
    if fault is not None:
        key, value, _, nearest = fault
        assert (key, value) == ("hand", second)
        works = replace(helices[1], hand=nearest.value)
        assert mesh_fault(helices[0], works, internal=internal) is None


def test_what_else_keeps_helices_apart() -> None:
    one = Helix(0.3)
    assert mesh_fault(Helix(), Helix()) is None
    assert mesh_fault(one, Helix())[0] == "helix_angle_deg"  # type: ignore[index]
    assert mesh_fault(one, Helix(0.3, "left", True))[0] == "double_helical"  # type: ignore[index]
    assert mesh_fault(replace(one, double=True), Helix(0.3, "left", True)) is None


@pytest.mark.parametrize("offset", [0.0, -0.1, 0.1])
def test_a_helical_rack_is_the_normal_rack_across_its_teeth(offset: float) -> None:
    """The root fillet of the transverse section, seen along the teeth, is the circle of the normal rack."""
    helix, normal = math.radians(30.0), iso_53("A")
    rack = Rack(2.0 / math.cos(helix), 3, transverse_rack(normal, helix), 5.0)
    profile = rack_region(rack, offset).region.outer
    whole = rack_region(rack).region.outer
    fillets = [s.curve for s in profile.period if s.label is Label.ROOT_FILLET]
    assert len(fillets) == 6
    for curve in fillets:
        points = curve.point(np.linspace(*curve.domain, 11))
        if offset:
            assert distance_to_profile(points, whole) == pytest.approx(np.full(11, abs(offset)), abs=1e-10)
            continue
        seen = points.real * math.cos(helix) + 1j * points.imag
        a, b, c = seen[[0, 5, 10]]
        middle = _circumcentre(a, b, c)
        assert np.abs(seen - middle) == pytest.approx(np.full(11, normal.tip_radius * 2.0), rel=1e-12)


def _circumcentre(a: complex, b: complex, c: complex) -> complex:
    u, v = b - a, c - a
    return a + (abs(u) ** 2 * v - abs(v) ** 2 * u) / (u.conjugate() * v - u * v.conjugate())


def test_ring_sections_are_rings() -> None:
    ring = transverse_ring(with_default_cutter(RingGear(2.0, 60, math.radians(20.0), 200.0, None)), 0.4)  # type: ignore[arg-type]
    assert ring_region(ring).region.holes[0].count == 60
