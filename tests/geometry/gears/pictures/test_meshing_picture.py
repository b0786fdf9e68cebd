"""The picture of meshing: flanks in contact where it says, teeth that do not overlap, arcs between the right points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from geometry.base.errors import ParameterError
from geometry.gears.pictures.meshing import MeshingPicture, meshing_picture
from geometry.plane.measure import distance_to_curves
from parts.scene.load import make_parts, scene_from_dict

EXTERNAL, INTERNAL, RACK = "external_gear_pair", "internal_gear_pair", "rack_pair"
KINDS = {EXTERNAL: ("spur_gear", "spur_gear"), INTERNAL: ("spur_gear", "ring_gear"), RACK: ("spur_gear", "rack")}
# kind, teeth, shifts, keys of the mate
CASES: dict[str, tuple[str, tuple[int, int], tuple[float, float], dict[str, float]]] = {
    "practicum": (EXTERNAL, (13, 21), (0.694, 0.384), {}),
    "backlash": (EXTERNAL, (17, 33), (0.0, 0.0), {"normal_backlash": 0.2}),
    "wider": (EXTERNAL, (17, 33), (0.0, 0.0), {"working_centre_distance": 50.8}),
    "undercut": (EXTERNAL, (9, 40), (0.1, -0.1), {}),
    "pole outside": (EXTERNAL, (12, 60), (0.8, -1.9), {}),
    "large": (EXTERNAL, (800, 900), (0.0, 0.0), {}),
    "internal": (INTERNAL, (16, 60), (0.0, 0.0), {}),
    "internal shifted": (INTERNAL, (20, 80), (0.5, 0.8), {"normal_backlash": 0.1}),
    "rack": (RACK, (12, 11), (0.5, 0.0), {}),
    "rack far": (RACK, (20, 9), (0.0, 0.0), {"working_centre_distance": 20.4}),
}


def pair_of(name: str) -> Any:
    kind, teeth, shifts, keys = CASES[name]
    parts: dict[str, Any] = {}
    for part, of, z, x in zip(("one", "two"), KINDS[kind], teeth, shifts, strict=True):
        parts[part] = {"kind": of, "module": 2.0, "number_of_teeth": z}
        if of != "rack":
            parts[part]["profile_shift_coefficient"] = x
    scene = scene_from_dict(
        {"parts": parts, "mates": [{"kind": kind, "first": "one", "second": "two", **keys}]}, "t", "t"
    )
    mating: Any = make_parts(scene, "t")[1][0]
    return mating.pair


def places(picture: MeshingPicture) -> list[float]:
    return [picture.start + (picture.end - picture.start) * k / 6 for k in range(7)]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CASES)
def test_both_working_flanks_touch_on_the_line_of_action(name: str) -> None:
    picture = meshing_picture(pair_of(name))
    for s in places(picture):
        point = np.array([picture.on_line(s)])
        for body in picture.bodies:
            # on the flank itself, and the flank square to the line of action
            assert distance_to_curves(point, body.active_at(s))[0] < 1e-9
            beside = np.array([picture.on_line(s) + 1e-4 * 1j * picture.direction * sign for sign in (1, -1)])
            assert distance_to_curves(beside, body.active_at(s)).min() < 1e-6


@pytest.mark.sampled(5)
@pytest.mark.parametrize("name", CASES)
def test_the_teeth_in_contact_do_not_overlap(name: str) -> None:
    picture = meshing_picture(pair_of(name))
    for s in places(picture):
        one, two = (outline(body.tooth_at(s)) for body in picture.bodies)
        assert one.intersection(two).area < 1e-3 * 2.0**2
        # a flank that lags is noticed
        off = outline(picture.bodies[0].tooth_at(s + 0.3))
        assert off.intersection(two).area > 1e-3 * 2.0**2


def outline(curves: list[Any]) -> shapely.Polygon:
    """The tooth as a polygon: its curves joined by their ends."""
    rows = [c.point(np.linspace(*c.domain, 60)) for c in curves]
    turned = min(abs(rows[0][0] - rows[1][k]) for k in (0, -1)) < min(abs(rows[0][-1] - rows[1][k]) for k in (0, -1))
    points = list(rows[0][::-1] if turned else rows[0])
    for row in rows[1:]:
        ends = abs(row[0] - points[-1]), abs(row[-1] - points[-1])
        points += list(row if ends[0] <= ends[1] else row[::-1])
    # joints that differ in the last digit cross themselves by that much
    return shapely.Polygon([(p.real, p.imag) for p in points]).buffer(0)


@pytest.mark.parametrize("name", CASES)
def test_the_line_touches_the_base_circles_and_its_length_is_the_contact_ratio(name: str) -> None:
    pair = pair_of(name)
    picture = meshing_picture(pair)
    for body, point in zip(picture.bodies, picture.tangent_points, strict=True):
        if point is None or body.centre is None:
            continue
        spoke = point - body.centre
        assert abs(spoke) == pytest.approx(body.radii["base"], rel=1e-12)
        assert abs((spoke * picture.direction.conjugate()).real) < 1e-9
        assert abs(((point - picture.tangent_points[0]) / picture.direction).imag) < 1e-9
    length = abs(picture.on_line(picture.end) - picture.on_line(picture.start))
    assert length / pair.base_pitch == pytest.approx(pair.effective_contact_ratio, rel=1e-12)
    arc = picture.arc_of_action
    assert arc.sweep * arc.radius / picture.working_pitch == pytest.approx(pair.effective_contact_ratio, rel=1e-12)
    # the pole: on the line of centres, as far as both working circles
    pole = picture.on_line(picture.pole)
    assert abs(pole - 1j * picture.bodies[0].radii["working"]) < 1e-9
    other = picture.bodies[1]
    reach = pole.imag if other.centre is None else abs(pole - other.centre)
    assert reach == pytest.approx(other.radii["working"], rel=1e-12)


@pytest.mark.parametrize("name", ["practicum", "internal", "rack"])
def test_the_arc_of_action_is_cut_off_by_the_flank_at_both_ends(name: str) -> None:
    picture = meshing_picture(pair_of(name))
    arc, body = picture.arc_of_action, picture.bodies[0]
    for t, s in ((0.0, picture.start), (arc.sweep, picture.end)):
        assert distance_to_curves(np.array([complex(arc.point(t))]), body.tooth_at(s))[0] < 1e-9


@pytest.mark.parametrize("name", CASES)
def test_a_chain_hangs_together_and_stays_between_root_and_tip(name: str) -> None:
    picture = meshing_picture(pair_of(name))
    for body in picture.bodies:
        curves = body.chain(picture.shown, 3)
        ends = np.array([c.point(np.array(c.domain)) for c in curves])
        # every end but the two outermost meets another
        flat = ends.ravel()
        alone = [p for i, p in enumerate(flat) if np.sort(np.abs(np.delete(flat, i) - p))[0] > 1e-9]
        assert len(alone) == 2
        low, high = sorted((body.radii["root"], body.radii["tip"]))
        points = np.concatenate([c.point(np.linspace(*c.domain, 9)) for c in curves])
        away = points.imag if body.centre is None else np.abs(points - body.centre)
        assert away.min() > low - 1e-9
        assert away.max() < high + 1e-9


def test_flanks_out_of_reach_are_refused() -> None:
    pair = pair_of("practicum")
    from geometry.gears.pairs.external import external_pair

    far = external_pair(pair.first, pair.second, pair.working_centre_distance + 5.0)
    with pytest.raises(ParameterError, match="flanks_do_not_reach") as caught:
        meshing_picture(far)
    # before, of a scene: ``mates[1] = -1.26564380837``, of a length that nobody typed
    assert caught.value.value is None
