"""Worm wheels as solids: their volume by polygons, their splines against the envelope found point by point."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import shapely

from geometry.approximation.tensor import basis_matrix
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.hob import Hob, oversized_hob
from geometry.gears.worms.wheel import WormTeeth
from geometry.gears.worms.wheel_faces import wheel_solid, wheel_splines
from geometry.gears.worms.wheel_measures import FILLET, FLANK, WormWheel
from geometry.gears.worms.worm import Worm
from geometry.plane.profile import Label, Region, circle
from geometry.solids.body import plate

THESIS = WormDrive(Worm(5.0, 1, 10.0), 128)
STEEP = WormDrive(Worm(1.5, 2, 10.0), 40)


def _wheel(drive: WormDrive, width: float, outer: float, hob: Hob | None = None, *, rounding: float = 0.1) -> WormWheel:
    hob = hob or oversized_hob(drive, rounding, drive.worm.diameter_quotient)
    teeth = WormTeeth(hob, drive.centre_distance, drive.throat_radius, outer, width)
    rim = circle(0.9 * drive.root_radius, Label.BODY)
    bore = circle(0.2 * drive.root_radius, Label.BORE, hole=True)
    assert teeth.ended is None
    return WormWheel(teeth, plate(Region(rim, (bore,)), 0.0, width), rim)


# contact that runs far beside the mid plane
THIN = WormDrive(Worm(5.0, 2, 4.12, hand="left"), 11, 0.3)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("drive", "width", "outer"), [(THESIS, 26.0, 330.0), (STEEP, 13.5, 65.25 / 2), (THIN, 8.2, 38.5)]
)
def test_volume_and_inertia_are_those_of_polygons(drive: WormDrive, width: float, outer: float) -> None:
    wheel = _wheel(drive, width, outer)
    teeth, share = wheel.teeth, np.linspace(0.0, 1.0, 400)[:, None]
    nodes, weights = np.polynomial.legendre.leggauss(12)
    areas, centres = [], []
    for low, high in zip(teeth.breaks, teeth.breaks[1:], strict=False):
        z = (low + high) / 2 + (high - low) / 2 * nodes
        lower, upper = (
            np.concatenate([part(teeth.side(h), share).plane for part in (teeth.fillet, teeth.flank)]) for h in (z, -z)
        )
        for k, weight in enumerate(weights * (high - low) / 2):
            # tip and root are arcs about the axis
            tip = _arc(lower[-1, k], np.conj(upper[-1, k]))
            after = lower[0, k] * np.exp(2j * np.pi / teeth.number_of_teeth)
            around = [lower[:, k], tip, np.conj(upper[::-1, k]), _arc(np.conj(upper[0, k]), after), [0.0]]
            section = shapely.Polygon([(p.real, p.imag) for p in np.concatenate(around)])
            areas.append(weight * section.area * teeth.number_of_teeth)
            centres.append(z[k])
    bore = 0.2 * drive.root_radius
    expected = sum(areas) - np.pi * bore**2 * width
    moments = wheel.moments()
    assert moments.volume == pytest.approx(expected, rel=1e-6)
    assert moments.centre == pytest.approx([0.0, 0.0, width / 2], abs=1e-9 * width)
    assert moments.inertia[0, 0] == pytest.approx(moments.inertia[1, 1], rel=1e-12)


def _arc(start: complex, end: complex) -> np.ndarray:
    return start * np.exp(1j * np.linspace(0.0, np.angle(end / start), 50))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("oversized", [False, True])
def test_splines_lie_on_the_envelope_and_their_edges_on_throat_and_root(oversized: bool) -> None:
    hob = oversized_hob(THESIS, 0.2, 10.5) if oversized else None
    wheel = _wheel(THESIS, 26.0, 328.0, hob)
    splines = wheel_splines(wheel, 1e-4)
    assert splines.max_error < 1e-4
    assert len(splines.strips) == 3
    for strip in splines.strips:
        for which in (FILLET, FLANK):
            u, v = np.linspace(0.0, 1.0, 23), np.linspace(strip.low, strip.high, 19)
            for tooth, poles in ((0, strip.lower[which]), (5, strip.upper[which])):
                plane = basis_matrix(7, strip.u_knots[which], u) @ poles @ basis_matrix(7, strip.v_knots, v).T
                plane = plane * np.exp(2j * np.pi * tooth / 128)
                height = np.broadcast_to(v + wheel.middle, plane.shape)
                points = np.stack([plane.real, plane.imag, height], axis=-1)
                assert float(wheel.from_side(which, points.reshape(-1, 3)).max()) <= splines.max_error
                if which == FILLET:
                    assert float(wheel.from_root(points[0]).max()) <= splines.max_error
                else:
                    assert np.abs(plane[-1]) == pytest.approx(wheel.teeth.tip_radius(v), abs=splines.max_error)
    # what is off is told as that
    off = points.reshape(-1, 3) + np.array([0.0, 0.01, 0.0])
    assert float(wheel.from_side(FLANK, off).max()) > 5e-3


def test_the_thesis_wheel_has_a_face_for_each_flank_and_fillet() -> None:
    wheel = _wheel(THESIS, 26.0, 330.0)
    solid = wheel_solid(wheel, wheel_splines(wheel, 1e-4))
    kinds: dict[str, int] = {}
    for faces in solid.faces:
        kind = type(faces.surface).__name__
        kinds[kind] = kinds.get(kind, 0) + len(faces.loops[0][0])
    assert kinds == {"SplineSurface": 512, "Torus": 256, "Cylinder": 1, "Plane": 2}
    # every edge is run once each way
    uses = np.concatenate([loop[0].ravel() for faces in solid.faces for loop in faces.loops])
    assert (np.bincount(uses) == 2).all()


@pytest.mark.parametrize(
    ("worm", "teeth", "width", "outer"),
    [
        (Worm(2.5, 4, 2.769, form="ZA"), 15, 1.0083, 21.730625),
        (Worm(2.0, 9, 11.76, form="ZN1", hand="left"), 128, 15.562, 130.545),
    ],
)
def test_points_of_a_side_measure_nothing_where_it_bends_much(
    worm: Worm, teeth: int, width: float, outer: float
) -> None:
    wheel = _wheel(WormDrive(worm, teeth), width, outer, rounding=0.2)
    share = np.linspace(0.0, 1.0, 201)[:, None]
    for low, high in pairwise(wheel.teeth.breaks):
        heights = low + (high - low) * np.linspace(0.9, 1.0, 11)
        side = wheel.teeth.side(heights)
        for part in (wheel.teeth.fillet, wheel.teeth.flank):
            plane = part(side, share).plane
            points = np.stack([plane.real, plane.imag, np.broadcast_to(heights + wheel.middle, plane.shape)], axis=-1)
            assert float(wheel.from_sides(points.reshape(-1, 3)).max()) < 1e-9
