"""Bodies and mass integrals against closed forms, revolved sections and meshes judged by trimesh."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label, Region, circle
from geometry.solids.body import Body, plate
from geometry.solids.bores import Bore, FlatBore, KeywayBore, PolygonBore, RoundBore
from geometry.solids.hub_holes import HubHoles, least_wall
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
    "all chamfer": WheelShape(0.5, chamfer_below=0.2495, chamfer_above=0.2495),
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


def judged(body, tolerance: float = 0.002):
    """The mesh of a body as trimesh has it, sound in every respect."""
    import trimesh

    mesh = body_mesh(body, mesh_outlines(body, tolerance, 1e-5))
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert solid.body_count == 1
    assert solid.area_faces.min() > 0
    return solid


@pytest.mark.sampled(1)
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
        (WheelShape(8.0, chamfer_below=5.0, chamfer_above=4.0), "face_chamfer.below", 3.999),
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


def test_chamfers_leave_a_wall_between_them() -> None:
    """At least 0.001 mm of it; the larger one is named where they leave less, with what works.

    Before, they could meet: the files of a cam had no outline for its follower, and of a wheel whose chamfers
    left 1e-6 mm the STEP and meshes failed.
    """

    def levels(below: float, above: float) -> tuple[float, ...]:
        keys = {"kind": "spur_gear", "module": 4.0, "number_of_teeth": 20, "face_width": 1.2,
                "face_chamfer": {"below": below, "above": above}}  # fmt: skip
        return tuple(make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0).levels())

    assert levels(0.6, 0.599) == pytest.approx((0.0, 0.6, 0.601, 1.2))
    assert levels(0.5, 0.4) == pytest.approx((0.0, 0.5, 0.8, 1.2))
    for below, above, key, most in (
        (0.6, 0.6, "below", 0.599),
        (0.6, 0.599999, "below", 0.599001),
        (0.6, 0.6001, "above", 0.599),
        (0.7, 0.5001, "below", 0.6989),
        (0.3, 1.0, "above", 0.899),
    ):
        with pytest.raises(SceneError) as refused:
            levels(below, above)
        assert (refused.value.key, refused.value.code) == (f"parts.p.face_chamfer.{key}", "chamfers_meet")
        assert refused.value.nearest is not None
        offered = float(refused.value.nearest.value)
        assert most - 2.1e-4 < offered <= most
        assert levels(*((offered, above) if key == "below" else (below, offered)))


def round_wheel(shape: WheelShape, holes: HubHoles, offset: float = 0.0) -> Body:
    """A disk of radius 20 mm as a wheel."""
    return wheel_body(shape, wheel_sections(lambda d, c: circle(20.0 + d - c, Label.HUB), 20.0, holes), offset)


# what is left between two edges of an end face, and how much of it an offset and the depth of a chamfer take
_L = least_wall(20.0)
FACES: dict[str, tuple[WheelShape, HubHoles, float, float]] = {
    "rim beside a bore": (WheelShape(8.0), HubHoles(RoundBore(36.0)), 2.0, -2.0),
    "rim beside holes": (WheelShape(8.0), HubHoles(None, (RoundHoles(4, 6.0, 30.0),)), 2.0, -2.0),
    "hub about its bore": (WheelShape(8.0, None, Hub(16.0, 1.0, 1.0)), HubHoles(RoundBore(12.0)), 2.0, -2.0),
    "floor beside a hub": (
        WheelShape(8.0, None, Hub(16.0, 1.0, 1.0)), HubHoles(RoundBore(5.0), (RoundHoles(4, 4.0, 23.0),)), 1.5, 1.0),
    "rim beside a web": (WheelShape(8.0, Web(4.0, 36.0)), HubHoles(RoundBore(5.0)), 2.0, -2.0),
    "web about a bore": (WheelShape(8.0, Web(4.0, 16.0)), HubHoles(RoundBore(12.0)), 2.0, 1.0),
    "web about a hub": (WheelShape(8.0, Web(4.0, 19.0), Hub(16.0, 1.0, 1.0)), HubHoles(RoundBore(5.0)), 1.5, 2.0),
    "web about holes": (WheelShape(8.0, Web(4.0, 30.0)), HubHoles(None, (RoundHoles(4, 5.0, 22.0),)), 1.5, 1.0),
}  # fmt: skip


@pytest.mark.parametrize("name", FACES)
def test_an_offset_leaves_a_face_between_every_two_edges(name: str) -> None:
    """``taken``: mm of the face's width for each mm outwards, below 0 for each mm inwards; holes count as they are."""
    shape, holes, width, taken = FACES[name]
    if shape.is_plate:
        # a plain plate asks for no end face: a chamfer lower than any that is made asks for one
        shape = replace(shape, chamfer_below=1e-9)
    limit = (width - _L) / taken
    round_wheel(shape, holes, limit * (1 - 1e-3))
    with pytest.raises(ParameterError) as refused:
        round_wheel(shape, holes, limit * (1 + 1e-3))
    assert refused.value.code == "leaves_no_face_between_edges"
    if shape.chamfer_below == 0:
        assert refused.value.name == "offset"
        # the nearest that works, to a thousandth
        assert works(refused.value) == pytest.approx(limit, rel=2e-3)
        assert abs(works(refused.value)) <= abs(limit)


@pytest.mark.parametrize(
    ("holes", "key"),
    [(HubHoles(None, (RoundHoles(4, 6.0, 34.0),)), "holes"), (HubHoles(None, (), Spokes(4, 20.0, 40.0, 3.0)), "spokes"),
     (HubHoles(RoundBore(40.0)), "bore_diameter")],
)  # fmt: skip
def test_holes_up_to_the_root_circle_leave_no_face(holes: HubHoles, key: str) -> None:
    with pytest.raises(ParameterError) as refused:
        check_wheel(WheelShape(8.0), 40.0, holes)
    assert (refused.value.name, refused.value.value) == (key, None)
    assert refused.value.code == "leaves_no_face_between_edges"
    check_wheel(WheelShape(8.0), 40.001, holes)


@pytest.mark.parametrize(
    ("shape", "holes", "key", "code", "remedy", "told"),
    [
        (WheelShape(8.0, None, Hub(39.96)), HubHoles(), "hub.diameter", "reaches_root_circle", 39.95, 40.0),
        (WheelShape(8.0, None, Hub(10.04)), HubHoles(RoundBore(10.0)), "hub.diameter", "within_bore", 10.05, 10.0),
        (WheelShape(8.0, None, Hub(17.96)), HubHoles(None, (RoundHoles(4, 4.0, 22.0),)), "hub.diameter",
         "reaches_holes", 17.95, 18.0),
        (WheelShape(8.0, Web(4.0, 39.96)), HubHoles(), "web.rim_diameter", "reaches_root_circle", 39.95, 40.0),
        (WheelShape(8.0, Web(4.0, 10.04)), HubHoles(RoundBore(10.0)), "web.rim_diameter", "within_bore", 10.05, 10.0),
        (WheelShape(8.0, Web(4.0, 16.04), Hub(16.0)), HubHoles(RoundBore(9.0)), "web.rim_diameter", "within_hub", 16.05,
         16.0),
        (WheelShape(8.0, Web(4.0, 26.04)), HubHoles(None, (RoundHoles(4, 4.0, 22.0),)), "web.rim_diameter",
         "within_holes", 26.05, 26.0),
    ],
)  # fmt: skip
def test_diameters_are_a_step_apart(
    shape: WheelShape, holes: HubHoles, key: str, code: str, remedy: float, told: float
) -> None:
    with pytest.raises(ParameterError) as refused:
        check_wheel(shape, 40.0, holes)
    assert (refused.value.name, refused.value.code) == (key, code)
    assert refused.value.numbers == {"diameter": told}
    assert works(refused.value) == pytest.approx(remedy, abs=1e-9)
    if key == "hub.diameter":
        check_wheel(replace(shape, hub=Hub(remedy)), 40.0, holes)
    else:
        assert shape.web is not None
        check_wheel(replace(shape, web=replace(shape.web, rim_diameter=remedy)), 40.0, holes)


def test_a_web_is_no_thicker_than_its_rim_and_stays_in_it() -> None:
    for shape, key, remedy in ((WheelShape(8.0, Web(8.01, 36.0)), "web.thickness", 8.0),
                               (WheelShape(8.0, Web(5.0, 36.0, 1.51)), "web.shift", 1.5),
                               (WheelShape(8.0, Web(5.0, 36.0, -1.51)), "web.shift", -1.5)):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            round_wheel(shape, HubHoles())
        assert refused.value.name == key
        assert works(refused.value) == remedy
    round_wheel(WheelShape(8.0, Web(8.0, 36.0)), HubHoles())
    round_wheel(WheelShape(8.0, Web(5.0, 36.0, -1.5)), HubHoles())


@pytest.mark.parametrize(
    ("shape", "holes", "key", "who", "most"),
    [
        # hub, rim and holes lower than both chamfers, or than one
        (WheelShape(8.0, None, Hub(16.0, 0.0, 0.7), 0.0, 0.8), HubHoles(), "above", "hub", 0.699),
        (WheelShape(8.0, None, Hub(16.0, 0.7, 0.0), 0.8, 0.0), HubHoles(), "below", "hub", 0.699),
        (WheelShape(8.0, Web(6.9, 30.0), None, 0.0, 0.6), HubHoles(), "above", "rim", 0.549),
        (WheelShape(8.0, Web(0.5, 30.0, 3.75), None, 0.0, 0.6), HubHoles(RoundBore(6.0)), "above", "bore", 0.499),
        (WheelShape(8.0, Web(0.5, 30.0, -3.75), None, 0.6, 0.0), HubHoles(None, (RoundHoles(4, 3.0, 18.0),)), "below",
         "hole", 0.499),
    ],
)  # fmt: skip
def test_a_chamfer_is_no_higher_than_what_it_runs_along(
    shape: WheelShape, holes: HubHoles, key: str, who: str, most: float
) -> None:
    with pytest.raises(ParameterError) as refused:
        round_wheel(shape, holes)
    assert (refused.value.name, refused.value.code) == (f"face_chamfer.{key}", f"chamfer_higher_than_{who}")
    assert most - 1.01e-4 <= works(refused.value) <= most
    round_wheel(replace(shape, **{f"chamfer_{key}": works(refused.value)}), holes)


def frustum(low: float, high: float, height: float) -> float:
    return math.pi * height / 3 * (low * low + low * high + high * high)


def test_every_edge_of_a_wheel_is_chamfered_where_it_is_an_end() -> None:
    """Volumes by Pappus: web 4 thick off the middle by 0.5, hub out on one side, so that holes and bore end in floors.

    Heights: rim 0 to 10, web 3.5 to 7.5, hub 3.5 to 12; chamfers 0.3 below and 0.4 above. The bore's lower end and all
    holes end in the floors of recesses, which have no chamfer.
    """
    shape = WheelShape(10.0, Web(4.0, 30.0, 0.5), Hub(12.0, -3.5, 2.0), 0.3, 0.4)
    body = round_wheel(shape, HubHoles(RoundBore(6.0), (RoundHoles(4, 5.0, 21.0),)))
    pi = math.pi
    rim = frustum(19.7, 20, 0.3) + pi * 400 * 9.3 + frustum(20, 19.6, 0.4)
    below = frustum(15.3, 15, 0.3) + pi * 225 * 3.2
    above = pi * 225 * 2.1 + frustum(15, 15.4, 0.4)
    hub = pi * 36 * 4.1 + frustum(6, 5.6, 0.4)
    bore = pi * 9 * 8.1 + frustum(3, 3.4, 0.4)
    holes = 4 * pi * 2.5**2 * 4
    assert body.levels() == pytest.approx((0.0, 0.3, 3.5, 7.5, 9.6, 10.0, 11.6, 12.0))
    assert body_moments(body).volume == pytest.approx(rim - below - above + hub - bore - holes, rel=1e-12)


def test_holes_of_a_plate_are_chamfered_at_both_ends() -> None:
    shape = WheelShape(6.0, None, None, 0.3, 0.4)
    body = round_wheel(shape, HubHoles(RoundBore(6.0), (RoundHoles(4, 5.0, 21.0),)))
    holes = frustum(3.3, 3, 0.3) + math.pi * 9 * 5.3 + frustum(3, 3.4, 0.4)
    holes += 4 * (frustum(2.8, 2.5, 0.3) + math.pi * 6.25 * 5.3 + frustum(2.5, 2.9, 0.4))
    rim = frustum(19.7, 20, 0.3) + math.pi * 400 * 5.3 + frustum(20, 19.6, 0.4)
    assert body_moments(body).volume == pytest.approx(rim - holes, rel=1e-12)
    # steps and chamfers lower than a thousandth are none
    assert round_wheel(WheelShape(6.0, None, Hub(9.0, 0.9e-3, 1.1e-3), 0.9e-3), HubHoles()).levels() == (
        0.0,
        6.0,
        6.0011,
    )


def test_a_wheel_moves_with_its_offset() -> None:
    """Outwards by 0.2: rim and hub grow, recess and holes shrink; heights stay."""
    shape = WheelShape(10.0, Web(4.0, 30.0, 0.5), Hub(12.0, 1.0, 2.0))
    holes = HubHoles(RoundBore(6.0), (RoundHoles(4, 5.0, 21.0),))
    for offset in (0.2, -0.2):
        d = offset
        pi = math.pi
        wanted = pi * (20 + d) ** 2 * 10 - pi * (15 - d) ** 2 * 6 + pi * (6 + d) ** 2 * 9
        wanted -= pi * (3 - d) ** 2 * 13 + 4 * pi * (2.5 - d) ** 2 * 4
        assert body_moments(round_wheel(shape, holes, offset)).volume == pytest.approx(wanted, rel=1e-12)
