"""Bodies and mass integrals against closed forms, revolved sections and meshes judged by trimesh."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label, Region, circle
from geometry.solids.body import Body, plate
from geometry.solids.bores import Bore, FlatBore, KeywayBore, PolygonBore, RoundBore
from geometry.solids.hub_holes import HubHoles
from geometry.solids.mass import body_moments
from geometry.solids.wheel import Hub, Web, WheelShape, check_wheel, wheel_body, wheel_sections
from geometry.solids.windows import RoundHoles, Spokes
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.mesh import body_mesh, mesh_outlines
from tests.brute import works
from tests.sampling import examples

BORES: dict[str, Bore | None] = {
    "none": None,
    "round": RoundBore(8.0),
    "keyway": KeywayBore(10.0, 3.0, 1.4, 0.16),
    "sharp keyways": KeywayBore(10.0, 3.0, 1.4, 0.0, keys=2, angle=0.3),
    "D": FlatBore(8.0, 3.0),
    "double D": FlatBore(8.0, 3.0, flats=2),
    "hexagon": PolygonBore(6, 8.0),
    "round square": PolygonBore(4, 8.0, 1.0),
}
SHAPES = {
    "plate": WheelShape(8.0),
    "chamfers": WheelShape(8.0, chamfer_below=0.3, chamfer_above=0.2),
    "foot": WheelShape(8.0, chamfer_below=0.3),
    "all chamfer": WheelShape(0.5, chamfer_below=0.25, chamfer_above=0.25),
    "web and hub": WheelShape(8.0, Web(3.0, 36.0, 0.5), Hub(16.0, 0.0, 4.0), 0.3, 0.3),
    "web at the face": WheelShape(8.0, Web(3.0, 36.0, 2.5), Hub(16.0, 1.0, 4.0), 0.2, 0.2),
    "hub on both sides": WheelShape(8.0, None, Hub(16.0, 1.0, 4.0), 0.2, 0.3),
    "web without hub": WheelShape(8.0, Web(3.0, 36.0), None, 0.2, 0.0),
}


def wheel(shape: WheelShape, holes: HubHoles, offset: float = 0.0) -> Body:
    gear = SpurGear(2.0, 23, iso_53("A"), hub=holes)
    return wheel_body(shape, wheel_sections(lambda d, c: gear_region(gear, d - c).region.outer, 20.5, holes), offset)


def checked(shape: WheelShape, holes: HubHoles, offset: float = 0.0) -> Body:
    """The wheel, its diameters held against each other first."""
    check_wheel(shape, 41.0, holes)
    return wheel(shape, holes, offset)


def judged(body, tolerance: float = 0.002):  # type: ignore[no-untyped-def]
    """The mesh of a body as trimesh has it, sound in every respect."""
    import trimesh

    mesh = body_mesh(body, mesh_outlines(body, tolerance, 1e-5))
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert solid.body_count == 1
    assert solid.area_faces.min() > 0
    return solid


@pytest.mark.sampled(2)
@pytest.mark.parametrize("bore", BORES)
@pytest.mark.parametrize("shape", SHAPES)
def test_mass_and_mesh_agree(shape: str, bore: str) -> None:
    """Two ways that share no integral: exact curves by Green, triangles by trimesh."""
    body = wheel(SHAPES[shape], HubHoles(BORES[bore]))
    moments, solid = body_moments(body), judged(body)
    assert solid.volume == pytest.approx(moments.volume, rel=4e-4)
    assert np.allclose(solid.center_mass, moments.centre, atol=2e-3)
    c = moments.centre
    about_centre = moments.inertia - moments.volume * (np.dot(c, c) * np.eye(3) - np.outer(c, c))
    assert np.allclose(solid.moment_inertia, about_centre, rtol=1e-3, atol=1e-3 * about_centre[2, 2])


def test_a_disk_with_a_hole_has_the_textbook_moments() -> None:
    region = Region(circle(10.0, Label.HUB), (circle(1.0, Label.HOLE, hole=True, centre=5 + 2j),))
    found = body_moments(plate(region, -1.0, 3.0))
    big, small = 4 * math.pi * 100, 4 * math.pi
    assert found.volume == pytest.approx(big - small, rel=1e-14)
    centre = np.array([-5 * small, -2 * small, 0.0]) / (big - small) + [0, 0, 1.0]
    assert found.centre == pytest.approx(centre, rel=1e-12)
    axial = big * 100 / 2 - small * (1 / 2 + 29)
    assert found.inertia[2, 2] == pytest.approx(axial, rel=1e-13)
    assert found.inertia[0, 1] == pytest.approx(small * 10, rel=1e-11)
    # about x: disk r^2/4 + h^2/12 + the distance of the middle; the hole's own and its distance off
    height = 16 / 12 + 1
    assert found.inertia[0, 0] == pytest.approx(big * (25 + height) - small * (0.25 + height + 4), rel=1e-13)


def test_a_chamfered_disk_is_a_cylinder_and_two_frustums() -> None:
    """Pappus: frustum volume pi h (R^2 + R r + r^2) / 3."""
    body = wheel_body(
        WheelShape(5.0, chamfer_below=0.5, chamfer_above=1.0),
        wheel_sections(lambda d, c: circle(10.0 + d - c, Label.HUB), 10.0, HubHoles()),
    )

    def frustum(h: float) -> float:
        return math.pi * h / 3 * (100 + 10 * (10 - h) + (10 - h) ** 2)

    expected = math.pi * 100 * 3.5 + frustum(0.5) + frustum(1.0)
    assert body_moments(body).volume == pytest.approx(expected, rel=1e-14)


def test_a_turned_wheel_is_the_sum_of_its_rings() -> None:
    """Rim, web and hub of a wheel without teeth, each an annulus."""
    shape = WheelShape(10.0, Web(4.0, 30.0, 1.0), Hub(12.0, 2.0, 3.0))
    holes = HubHoles(RoundBore(6.0), (RoundHoles(4, 5.0, 21.0),))
    body = wheel_body(shape, wheel_sections(lambda d, c: circle(20.0 + d - c, Label.HUB), 20.0, holes))

    def ring(outer: float, inner: float, height: float) -> float:
        return math.pi / 4 * (outer**2 - inner**2) * height

    expected = ring(40, 30, 10) + ring(30, 12, 4) - 4 * ring(5, 0, 4) + ring(12, 6, 15)
    assert body_moments(body).volume == pytest.approx(expected, rel=1e-13)
    assert body.levels() == (-2.0, 0.0, 4.0, 8.0, 10.0, 13.0)
    judged(body)


@examples(20)
@given(
    width=st.floats(0.5, 30),
    web=st.one_of(st.none(), st.tuples(st.floats(0.1, 1), st.floats(18, 40), st.floats(-1, 1))),
    hub=st.one_of(st.none(), st.tuples(st.floats(11, 35), st.floats(0, 5), st.floats(0, 5))),
    chamfers=st.tuples(st.floats(0, 0.6), st.floats(0, 0.6)),
    bore=st.sampled_from(list(BORES)),
    spoked=st.booleans(),
    offset=st.sampled_from([0.0, -0.05, -0.2]),
)
def test_any_wheel_is_refused_or_sound(
    width: float,
    web: tuple[float, float, float] | None,
    hub: tuple[float, float, float] | None,
    chamfers: tuple[float, float],
    bore: str,
    spoked: bool,
    offset: float,
) -> None:
    shape = WheelShape(
        width,
        None if web is None else Web(web[0] * width, web[1], web[2] * width * (1 - web[0]) / 2),
        None if hub is None else Hub(*hub),
        *chamfers,
    )
    holes = HubHoles(BORES[bore], spokes=Spokes(5, 18, 34, 4))
    if not spoked:
        holes = HubHoles(BORES[bore], (RoundHoles(5, 4.0, 25.0),))
    refusal: ParameterError | None = None
    body = None
    try:
        body = checked(shape, holes, offset)
    except ParameterError as error:
        refusal = error
    if body is not None:
        assert judged(body, 0.05).volume == pytest.approx(body_moments(body).volume, rel=5e-3)
    else:
        assert refusal is not None
        assert refusal.nearest is not None


@pytest.mark.parametrize(
    ("shape", "key", "remedy"),
    [
        (WheelShape(8.0, Web(9.0, 36.0)), "web.thickness", 8.0),
        (WheelShape(8.0, Web(4.0, 36.0, 3.0)), "web.shift", 2.0),
        (WheelShape(8.0, chamfer_below=5.0, chamfer_above=4.0), "face_chamfer.below", 4.0),
        (WheelShape(8.0, None, Hub(41.5)), "hub.diameter", 40.95),
        (WheelShape(8.0, None, Hub(8.0)), "hub.diameter", 8.05),
        (WheelShape(8.0, Web(4.0, 12.0), Hub(14.0)), "web.rim_diameter", 14.05),
    ],
    ids=lambda v: v if isinstance(v, str) else "",
)
def test_what_does_not_fit_is_refused_with_what_does(shape: WheelShape, key: str, remedy: float) -> None:
    with pytest.raises(ParameterError) as caught:
        checked(shape, HubHoles(RoundBore(8.0)))
    assert caught.value.name == key
    assert works(caught.value) == remedy


def test_a_chamfer_that_eats_the_tip_names_the_largest_that_does_not() -> None:
    with pytest.raises(ParameterError) as caught:
        wheel(WheelShape(20.0, chamfer_below=3.0), HubHoles())
    assert caught.value.name == "face_chamfer.below"
    limit = works(caught.value)
    judged(wheel(WheelShape(20.0, chamfer_below=limit), HubHoles()))
    with pytest.raises(ParameterError):
        wheel(WheelShape(20.0, chamfer_below=limit * 1.01), HubHoles())


def test_chamfers_may_meet_but_not_cross() -> None:
    """Together as wide as the face: an edge is left; the larger one is named where they are more, with what works."""

    def levels(below: float, above: float) -> tuple[float, ...]:
        keys = {"kind": "spur_gear", "module": 4.0, "number_of_teeth": 20, "face_width": 1.2,
                "face_chamfer": {"below": below, "above": above}}  # fmt: skip
        return tuple(make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0).levels())

    assert levels(0.6, 0.6) == (0.0, 0.6, 1.2)
    assert levels(0.5, 0.4) == pytest.approx((0.0, 0.5, 0.8, 1.2))
    for below, above, key, most in (
        (0.6, 0.6001, "above", 0.6),
        (0.7, 0.5001, "below", 0.6999),
        (0.3, 1.0, "above", 0.9),
    ):
        with pytest.raises(SceneError) as refused:
            levels(below, above)
        assert (refused.value.key, refused.value.code) == (f"parts.p.face_chamfer.{key}", "chamfers_meet")
        assert refused.value.nearest is not None
        offered = float(refused.value.nearest.value)
        assert most - 2.1e-4 < offered <= most
        assert levels(*((offered, above) if key == "below" else (below, offered)))
