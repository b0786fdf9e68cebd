"""The shifts of planetary sets against exact contact of the wheels that a build makes of them."""

from __future__ import annotations

import itertools
import math
import random
from fractions import Fraction

import mpmath
import pytest

from geometry.base.both import both
from geometry.base.record import replace
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.pairs.external import external_pair
from geometry.gears.pairs.internal import internal_pair
from geometry.gears.planetary.fitting import Fitting
from geometry.gears.planetary.sets import SCHEMES, PlanetarySet, Search, found_sets
from geometry.gears.shifts.external import Requirements
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.ring_limits import root_form_diameter
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear
from parts.gears.ring_gear.part import RingGearSpec, settled_section

RACK = BasicRack(math.radians(20), 1.0, 0.25, 0.38)
WISHES = [("james", "2.5", 3), ("james", "12", 3), ("david", "-4", 3), ("david", "0.1", 1), ("two_internal", "-0.8", 1),
          ("one_external_one_internal", "7", 2), ("one_external_one_internal", "20", 3), ("james", "4", 2)]  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("scheme", "ratio", "satellites"), WISHES)
@pytest.mark.parametrize(("seed", "helix_deg"), [(0, 0.0), (1, 0.0), (2, 0.0), (3, 0.0), (0, 22.0), (1, 35.0)])
def test_fitted_sets_are_in_contact_without_overlap(
    scheme: str, ratio: str, satellites: int, seed: int, helix_deg: float
) -> None:
    """Helical sets too: contact in the transverse section of the wheels that the normal shifts make."""
    u, beta = Fraction(ratio), math.radians(helix_deg)
    bounds = u - abs(u) / 100, u + abs(u) / 100
    wish = Search(SCHEMES[scheme], bounds, satellites=satellites, cosine=Fraction(math.cos(beta)))
    found = found_sets(wish)
    apart = Fraction(1, satellites) if satellites > 1 else None
    one = random.Random(seed).choice(found)
    fit = Fitting(RACK, Requirements(0.25, 1.1), apart, helix_angle=beta).fit(one)
    assert fit is not None
    x1, x2, x2p, x3 = fit.shifts
    for mesh, x_rim, x_central in ((fit.meshes[0], x2, x1), (fit.meshes[1], x2p, x3)):
        rim = transverse_gear(SpurGear(1.0, mesh.rim, RACK, x_rim), beta)
        if mesh.internal:
            keys = RingGearSpec(
                module=1.0,
                number_of_teeth=mesh.central,
                profile_shift_coefficient=x_central,
                helix_angle_deg=helix_deg,
            )
            pair = internal_pair(rim, settled_section(keys))
            # tips end before the fillets that the ring's cutter leaves
            tip = min(2 * rim.tip_radius, pair.tip_limits[0])
            pair = internal_pair(replace(rim, given_tip_diameter=tip), pair.ring)
            assert pair.contact_ratio > 1.1
        else:
            pair = external_pair(rim, transverse_gear(SpurGear(1.0, mesh.central, RACK, x_central), beta))
        assert pair.working_centre_distance == pytest.approx(fit.distance, abs=1e-9)
        assert GearMesh(pair).contact().verdict.name == "CONTACT"
        # tips of neighbours, by the rim as it is built
        if apart is not None:
            reach = 2 * fit.distance * math.sin(math.pi / satellites) - 2 * pair.first.tip_radius
            assert reach >= fit.gap - 1e-9
            assert fit.gap >= 0


def test_where_the_first_mesh_has_no_shifts_the_second_is_not_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before, both meshes were searched at every distance."""
    asked: list[bool] = []
    monkeypatch.setattr(Fitting, "_keeps", lambda own, mesh, distance, shift: asked.append(mesh.internal) or False)
    wish = Search(SCHEMES["one_external_one_internal"], (Fraction(7), Fraction(71, 10)), satellites=2)
    fit = Fitting(RACK, Requirements(0.25, 1.1), Fraction(1, 2))
    assert fit.fit(found_sets(wish)[0]) is None
    assert asked
    assert not any(asked)


@pytest.mark.parametrize("teeth", [(100, 100, 300), (501, 501, 1503), (702, 600, 1902)])
def test_sets_of_many_teeth_need_no_shifts(teeth: tuple[int, int, int]) -> None:
    """A ring was judged as if its roots were full rounds: -1.75, 1, 1, 0.25 for 501/501/1503, none for 702/600/1902.

    The satellite's tips end on the ring at hypot(r_b3, sqrt(r_a2^2 - r_b2^2) + a sin(alpha)), before its fillets.
    """
    z1, z2, z3 = teeth
    fit = Fitting(RACK, Requirements(0.25, 1.1), Fraction(1, 3)).fit(PlanetarySet(SCHEMES["james"], (z1, z2, z2, z3)))
    assert fit is not None
    assert fit.shifts == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-9)
    base, sine = math.cos(RACK.pressure_angle) / 2, math.sin(RACK.pressure_angle)
    end = math.sqrt((z2 / 2 + 1) ** 2 - (z2 * base) ** 2) + (z3 - z2) / 2 * sine
    ring = settled_section(RingGearSpec(module=1.0, number_of_teeth=z3))
    assert 2 * math.hypot(z3 * base, end) < root_form_diameter(ring)


@pytest.mark.parametrize(
    ("teeth", "shifts"), [((20, 29, 11, 38), (0.0, 0.0, 1.0, -1.0)), ((18, 23, 11, 30), (0.0, 0.0, 1.0, -1.0))]
)
def test_each_rim_of_double_satellites_has_a_shift_of_its_own(
    teeth: tuple[int, ...], shifts: tuple[float, ...]
) -> None:
    """11 teeth are not undercut from x = 1 - 11 sin(20 deg)^2 / 2 on, the other rim needs none."""
    z1, z2, z2p, z3 = teeth
    fit = Fitting(RACK, Requirements(0.25, 1.1), Fraction(1, 3)).fit(PlanetarySet(SCHEMES["david"], (z1, z2, z2p, z3)))
    assert fit is not None
    least = 1 - 11 * math.sin(math.radians(20)) ** 2 / 2
    assert fit.shifts == pytest.approx([share * least for share in shifts], abs=1e-4)


def test_shifts_are_told_to_rounding_and_none_at_the_reference_distance() -> None:
    """By 50 digits; before: 2.7e-15 of wheels 18, 18, 54 at 25 degrees, which their names had in notes and pictures."""
    mp = mpmath.mp.clone()
    mp.dps = 50
    for degrees, teeth, modules in itertools.product(
        (0, 11, 25, 33), ((18, 18, 18, 54), (20, 22, 28, 76)), (("0.7", "0.7"), ("0.8", "0.7"), ("1.5", "1.5"))
    ):
        beta = math.radians(degrees)
        one = PlanetarySet(
            SCHEMES["one_external_one_internal"], teeth, both(map(Fraction, modules)), Fraction(math.cos(beta))
        )
        fitting = Fitting(iso_53("A"), Requirements(0.25, 1.1), Fraction(1, 3), helix_angle=beta)
        plain = fitting.plain(one)
        coaxial = one.distances[0] == one.distances[1]
        assert coaxial is (plain.shifts == (0.0, 0.0, 0.0, 0.0))
        for mesh in plain.meshes:
            for share in (0.0, -1e-3, -1e-9, 1e-12, 1e-4, 0.03):
                distance = mesh.reference * (1 + share)
                alpha = mp.mpf(mesh.rack.pressure_angle)
                working = mp.acos(mp.mpf(mesh.reference) / distance * mp.cos(alpha))
                turned = mp.tan(working) - working - mp.tan(alpha) + alpha
                exact = turned * mesh.span / (2 * mp.tan(alpha) * math.cos(beta))
                assert mesh.shift_total(distance) == pytest.approx(float(exact), rel=1e-12, abs=1e-40)
