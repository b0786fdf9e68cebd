"""Face gears through scenes: how the pinion stands, files, meshes of both in motion, refusals and what they offer."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest

from exporters.command.cli import main
from exporters.documents.topics import calculate
from geometry.base.errors import GeometryError
from geometry.plane.measure import profile_area
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from parts.solids.mesh import body_mesh, mesh_outlines
from tests.exporters.making import table

GEAR: dict[str, Any] = {"kind": "face_gear", "module": 2.0, "number_of_teeth": 21, "pinion_number_of_teeth": 14}
PINION: dict[str, Any] = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 14, "face_width": 9.0}
HUB: dict[str, Any] = {"diameter": 18.0, "below": 4.0, "above": 2.0}
HOLES: dict[str, Any] = {"count": 5, "diameter": 5.0, "pitch_circle_diameter": 27.0}


def scene(gear: dict[str, Any], pinion: dict[str, Any], **mate: Any) -> dict[str, Any]:
    """A pair, the face gear first, which lies askew."""
    return {
        "parts": {"wheel": GEAR | gear, "pinion": PINION | pinion},
        "instances": {
            "wheel": {"part": "wheel", "rotation_deg": 13.0, "at": [1.0, 2.0, 3.0], "axis": [0.3, -0.4, 0.86]}
        },
        "mates": [{"kind": "face_gear_pair", "first": "wheel", "second": "pinion", "direction_deg": 40.0, **mate}],
        "exports": [{"format": "step", "assembly": True}],
        "checks": {"interference": True},
    }


def made(raw: dict[str, Any]) -> tuple[Any, Any, Any]:
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    return parts, matings, {i.id: i for i in place(file.instances, [], parts, matings, "s").instances}


def turned(parts: Any, stand: Any, *shares: float) -> list[Any]:
    """Meshes of pinion and face gear where they stand, turned on by shares of their pitches."""
    solids = []
    for name, way, share in zip(("pinion", "wheel"), (1, -1), shares, strict=True):
        body = parts[name].body(0.0)
        mesh = body_mesh(body, mesh_outlines(body, 0.003, 0.0))
        angle = way * share * math.tau / parts[name].keys.number_of_teeth
        c, s = math.cos(angle), math.sin(angle)
        vertices = mesh.vertices @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]).T
        vertices = stand[name].scene_from_part.apply(vertices)
        mesh3 = manifold3d.Mesh(vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
        solids.append(manifold3d.Manifold(mesh3))
    return solids


@pytest.mark.sampled(1)
@pytest.mark.parametrize("shaper", [14, 16])
def test_meshes_of_both_keep_half_of_the_backlash_all_over_a_pitch(shaper: int) -> None:
    """By meshes alone, turned step by step in their ratio; beside it they clash."""
    parts, _, stand = made(scene({"shaper_number_of_teeth": shaper}, {}, normal_backlash=0.2))
    for share in (0.0, 0.37, 0.71):
        pinion, wheel = turned(parts, stand, share, share)
        assert (pinion ^ wheel).volume() < 1e-6
        assert pinion.min_gap(wheel, 1.0) == pytest.approx(0.1, abs=0.0065)
    pinion, wheel = turned(parts, stand, 0.4, 0.0)
    assert (pinion ^ wheel).volume() > 1.0


def test_axes_meet_at_a_right_angle_where_the_keys_have_it() -> None:
    parts, matings, stand = made(scene({}, {}, pinion_offset=0.5))
    gear, wheel, pinion = (parts["wheel"].thing, *(stand[name].scene_from_part for name in ("wheel", "pinion")))
    assert np.dot(wheel.z, pinion.z) == pytest.approx(0.0, abs=1e-12)
    middle = pinion.apply(np.array([0.0, 0.0, 4.5])) - wheel.apply(np.array([0.0, 0.0, gear.mounting_distance]))
    assert middle == pytest.approx(-np.array(pinion.z) * ((gear.inner_radius + gear.outer_radius) / 2 + 0.5), abs=1e-9)
    # the pitch planes: m z / 2 below the pinion's axis, an addendum below the tips
    assert gear.mounting_distance - 14.0 == pytest.approx(gear.height - gear.addendum, abs=1e-12)
    (mating,) = matings
    assert mating.quantities()["ratio"] == pytest.approx(21 / 14, rel=1e-15)
    assert [joint.ratio for joint in mating.joints] == [Fraction(-21, 14)]


PAIR = """
[parts.wheel]
kind = "face_gear"
module = 2.0
number_of_teeth = 21
pinion_number_of_teeth = 14
bore = {{ shape = "keyway", diameter = 10.0 }}
hub = {{ diameter = 18.0, below = 4.0, above = 2.0 }}
holes = {{ count = 5, diameter = 5.0, pitch_circle_diameter = 27.0 }}

[parts.pinion]
kind = "spur_gear"
module = 2.0
number_of_teeth = 14
face_width = 9.0
{placed}
[[mates]]
kind = "face_gear_pair"
first = "wheel"
second = "pinion"
normal_backlash = 0.1

[[exports]]
format = "step"
assembly = true

[[exports]]
format = "stl"
tolerance = 0.05
parts = ["wheel"]
"""


@pytest.mark.parametrize(("up", "turned", "code"), [(0.0, 0.0, 0), (0.02, 0.0, 1), (0.0, 3.0, 1)])
def test_a_pinion_that_stands_already_is_held_to_its_place(up: float, turned: float, code: int, tmp_path: Path) -> None:
    """Phase and the place of its axis are looked at; along its axis it may be moved."""
    raw = scene({}, {}, normal_backlash=0.1) | {"instances": {"wheel": {"part": "wheel"}}}
    raw["mates"][0]["direction_deg"] = 0.0
    pinion = made(raw)[2]["pinion"]
    x, y, z = (float(c) for c in pinion.scene_from_part.apply(np.zeros(3)))
    # z is laid on -x about y: of what the turn about z makes of x, its y is left
    sine, cosine = (float(pinion.scene_from_part.rotation[1][k]) for k in (0, 1))
    placed = (
        "[instances.wheel]\npart = 'wheel'\n[instances.pinion]\npart = 'pinion'\n"
        f"at = [{x + 0.3}, {y}, {z + up}]\naxis = [-1.0, 0.0, 0.0]\n"
        f"rotation_deg = {math.degrees(math.atan2(sine, cosine)) + turned}\n"
    )
    file = tmp_path / "s.toml"
    file.write_text(PAIR.format(placed=placed), encoding="utf-8")
    assert main(["check", str(file)]) == code


def test_files_are_read_back(tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    file.write_text(PAIR.format(placed=""), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--quiet"]) == 0
    found = json.loads((tmp_path / "s" / "report.json").read_text(encoding="utf-8"))
    assert {Path(file["path"]).suffix for file in found["files"]} == {".step", ".stl"}
    assert all(file["max_error"] <= file["tolerance"] for file in found["files"])


def test_a_pinion_that_the_gear_is_not_for_is_refused() -> None:
    for key, value, right in (
        ("helix_angle_deg", 10.0, 0.0), ("profile_shift_coefficient", 0.2, 0.0), ("number_of_teeth", 19, 14),
        ("module", 2.5, 2.0), ("pressure_angle_deg", 25.0, 20.0),
    ):  # fmt: skip
        with pytest.raises(SceneError) as refusal:
            made(scene({}, {key: value}))
        assert f"parts.pinion.{key}" in str(refusal.value)
        made(scene({}, {key: right}))
    made(scene({"pinion_profile_shift_coefficient": 0.2}, {"profile_shift_coefficient": 0.2}))


@pytest.mark.parametrize(
    ("keys", "key"),
    [
        ({"inner_diameter": 55.0}, "inner_diameter"), ({"outer_diameter": 90.0}, "outer_diameter"),
        ({"inner_diameter": 80.0}, "inner_diameter"), ({"outer_diameter": 55.0}, "outer_diameter"),
        ({"tip_radius_coefficient": 1.0}, "tip_radius_coefficient"),
        ({"dedendum_coefficient": 2.0}, "dedendum_coefficient"),
        ({"addendum_coefficient": 2.5}, "addendum_coefficient"),
        ({"shaper_number_of_teeth": 13}, "shaper_number_of_teeth"),
        ({"shaper_number_of_teeth": 60}, "shaper_number_of_teeth"),
        ({"pinion_number_of_teeth": 5, "dedendum_coefficient": 1.25}, "dedendum_coefficient"),
        ({"pinion_number_of_teeth": 8, "pinion_profile_shift_coefficient": 0.5}, "dedendum_coefficient"),
        # of the usual addenda, which nobody types, none is low enough: before, the lowest was refused without an offer
        ({"number_of_teeth": 8, "pinion_number_of_teeth": 20}, "number_of_teeth"),
        ({"number_of_teeth": 60, "pinion_number_of_teeth": 10_000}, "number_of_teeth"),
        ({"pinion_number_of_teeth": 3, "dedendum_coefficient": 0.9, "addendum_coefficient": 1.0},
         "addendum_coefficient"),
        ({"pinion_number_of_teeth": 3, "dedendum_coefficient": 0.9, "addendum_coefficient": 1.5},
         "addendum_coefficient"),
        ({"bore_diameter": 70.0}, "bore_diameter"), ({"hub": HUB | {"diameter": 60.0}}, "hub.diameter"),
        ({"holes": HOLES | {"pitch_circle_diameter": 40.0}}, "holes.pitch_circle_diameter"),
        ({"hub": HUB, "holes": HOLES | {"pitch_circle_diameter": 22.0}}, "hub.diameter"),
        ({"web": {"thickness": 6.0, "rim_diameter": 30.0}}, "web.thickness"),
        ({"circumferential_thinning": 4.0}, "circumferential_thinning"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_with_a_value_that_builds(keys: dict[str, Any], key: str) -> None:
    with pytest.raises(SceneError) as refusal:
        made({"parts": {"wheel": GEAR | keys}})
    nearest = refusal.value.nearest
    assert f"parts.wheel.{key}" in str(refusal.value)
    assert nearest is not None
    table, _, inner = key.rpartition(".")
    cured = {key: nearest.value} if not table else {table: keys[table] | {inner: nearest.value}}
    try:
        made({"parts": {"wheel": GEAR | keys | cured}})
    except (SceneError, GeometryError) as error:
        pytest.fail(f"{key} = {nearest.value}: {error}")


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "others"), [(7, 60), (8, 17), (10, 200), (13, 26)])
def test_pinions_of_few_teeth_mesh_by_default(teeth: int, others: int) -> None:
    """Undercut begins their involute late: the gear's teeth are low enough to be wide, and to be thinned, beyond it."""
    few = {"number_of_teeth": teeth}
    parts, (mating,), _ = made(
        scene({"number_of_teeth": others, "pinion_number_of_teeth": teeth}, few, normal_backlash=0.4)
    )
    gear = parts["wheel"].thing
    assert gear.face_width >= 2.0
    assert mating.contact(0.0, 0.0, None).verdict.name == "CLEAR"
    assert [found.code for found in mating.findings() if found.code != "contact_ratio"] == []


@pytest.mark.parametrize("width", [1e-2, 1e-1, 1.0])
def test_a_narrow_pinion_touches_as_long_as_a_rack_in_its_plane(width: float) -> None:
    """Before, a traceback where none of the radii that were looked at lay on its face.

    In its plane, of pressure angle alpha, the gear is a rack whose addendum the pinion's line of action ends at.
    """
    _, (mating,), _ = made(scene({}, {"face_width": width}))
    pair = mating.pair
    x = (pair.low + pair.high) / 2
    alpha = math.acos(pair.gear.reference_radius * math.cos(math.radians(20)) / x)
    base, tip = pair.pinion.base_radius, pair.pinion.tip_radius
    begins = (pair.gear.tip_depth - base * math.cos(alpha)) / math.sin(alpha)
    path = math.sqrt(tip**2 - base**2) - max(begins, pair.form_length)
    assert mating.quantities()["contact_ratio"] == pytest.approx(path / (math.tau * base / 14), abs=0.12 * width + 1e-9)


def test_a_pinion_beside_whose_face_all_contact_lies_has_none() -> None:
    """Before, a traceback: a pinion of far more teeth touches the gear far from the plane of its axis."""
    assert calculate("face-gear", ["module=2", "number_of_teeth=60", "pinion_number_of_teeth=200"], "text", None)


def test_an_offer_leaves_tips_that_a_backlash_may_thin() -> None:
    with pytest.raises(SceneError) as refusal:
        made(scene({"addendum_coefficient": 2.5}, {}, normal_backlash=0.1))
    assert refusal.value.nearest is not None
    made(scene({"addendum_coefficient": refusal.value.nearest.value}, {}, normal_backlash=0.1))


@pytest.mark.parametrize(("addendum", "codes"), [(1.1, []), (1.24, ["contact_below_flank_second"])])
def test_tips_in_the_pinions_fillet_are_told(addendum: float, codes: list[str]) -> None:
    """Of tips off the pinion's root and on its involute whose corners cut into its fillet: so do the meshes."""
    gear = {"pinion_number_of_teeth": 20, "number_of_teeth": 60, "addendum_coefficient": addendum}
    parts, (mating,), stand = made(scene(gear, {"number_of_teeth": 20}, normal_backlash=0.1))
    assert mating.contact(0.0, 0.0, None).verdict.name == ("OVERLAP" if codes else "CLEAR")
    found = mating.findings()
    assert [one.code for one in found] == codes
    # between the root and where the involute begins
    assert all(20.0 - 2.5 < one.value < one.limit < 20.0 for one in found)
    shared = [pinion ^ wheel for pinion, wheel in (turned(parts, stand, share, share) for share in (0.2, 0.8))]
    assert (max(one.volume() for one in shared) > 1e-4) == bool(codes)


def test_hub_web_and_holes_weigh_what_they_are() -> None:
    """Cylinders added to a plain gear and taken from it; its mesh, as high as the hub is long, has that volume."""
    web = {"thickness": 3.0, "rim_diameter": 36.0, "shift": 0.5}
    keys = {"hub": HUB, "holes": HOLES, "web": web, "bore_diameter": 10.0, "material": "steel"}
    bodies = [made({"parts": {"wheel": GEAR | more}})[0]["wheel"].body(0.0) for more in ({}, keys)]
    plain, whole = (body.moments.volume for body in bodies)
    thin = (36.0**2 - 18.0**2) * 2.0 + 5 * 5.0**2 * 3.0 + 10.0**2 * 11.0
    assert whole - plain == pytest.approx(math.pi / 4 * (18.0**2 * 6.0 - thin), rel=1e-9)
    mesh = body_mesh(bodies[1], mesh_outlines(bodies[1], 0.002, 0.0))
    solid = manifold3d.Manifold(manifold3d.Mesh(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32)))
    assert solid.volume() == pytest.approx(whole, rel=1e-3)
    assert solid.bounding_box()[2::3] == pytest.approx((-4.0, bodies[0].levels()[1]), abs=1e-5)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("diameter", "above", "pinion_hub", "code"),
    [pytest.param(34.0, 0.3, 0.0, 0, marks=pytest.mark.heavy), (34.0, 8.0, 0.0, 1),
     pytest.param(34.0, 8.0, 6.0, 1, marks=pytest.mark.heavy), (34.0, 0.3, 6.0, 0), (24.0, 8.0, 6.0, 1)],
)  # fmt: skip
def test_a_hub_beside_the_pinion_is_kept_off_it(diameter: float, above: float, pinion_hub: float, code: int) -> None:
    """As meshes of both have it; a hub of the pinion may reach over it, and alone may meet it."""
    gear = {"hub": {"diameter": diameter, "above": above}}
    pinion = {"face_width": 14.0} | ({"hub": {"diameter": 20.0, "above": pinion_hub}} if pinion_hub else {})
    parts, (mating,), stand = made(scene(gear, pinion, normal_backlash=0.2))
    one, other = turned(parts, stand, 0.0, 0.0)
    clearance = mating.pair.hub_clearance
    if code:
        assert (one ^ other).volume() > 1e-3
        assert clearance < 0
        assert "hub_clearance_first" in [found.code for found in mating.findings()]
    else:
        assert (one ^ other).volume() < 1e-6
        assert clearance > 0
    assert (mating.contact(0.0, 0.0, None).verdict.name == "OVERLAP") == bool(code)


def test_pictures_show_the_spaces_between_tips(tmp_path: Path) -> None:
    """Area between root and tip circles less that of all tips, by their thickness; a film of it is read back."""
    raw = scene({}, {}, normal_backlash=0.1)
    parts, _, _ = made(raw)
    gear = parts["wheel"].thing
    region = parts["wheel"].section(0.0).region
    inner, spaces = (profile_area(profile) for profile in region.marks)
    radii, weights = np.polynomial.legendre.leggauss(12)
    radii = (gear.inner_radius + gear.outer_radius) / 2 + gear.face_width / 2 * radii
    tips = 21 * float((gear.tip_thickness(radii) * weights).sum()) * gear.face_width / 2
    assert spaces == pytest.approx(math.pi * gear.outer_radius**2 - tips, rel=1e-9)
    assert inner == pytest.approx(math.pi * gear.inner_radius**2, rel=1e-12)
    assert region.outer.reach() == pytest.approx(gear.outer_radius, rel=1e-15)
    file = tmp_path / "s.toml"
    film = '[[drives]]\ninstance = "pinion"\nturns = 3.0\n[[exports]]\nformat = "motion"\n'
    file.write_text(PAIR.format(placed="").split("[[exports]]")[0] + film, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--quiet"]) == 0


@pytest.mark.parametrize(("more", "plane"), [((), "middle_plane"), (("shaper_number_of_teeth=22",), "contact_plane")])
def test_forces_of_the_calculation_balance_both_torques(more: tuple[str, ...], plane: str) -> None:
    """About the gear's axis the force along it turns the gear as the ratio has it; its parts make up the normal one."""
    values = json.loads(calculate("face-gear", ("face_gear_pair", "torque=12", *more), "json", "en"))["values"]
    along, across = values["circumferential_force"], values["radial_force"]["first"]
    assert along * values[plane] / 1000 == pytest.approx(36.0, rel=1e-9)
    assert math.hypot(along, across) == pytest.approx(values["normal_force"], rel=1e-12)
    assert values["normal_force"] * values["base_diameter"]["first"] / 2000 == pytest.approx(12.0, rel=1e-12)


def test_how_far_crowned_flanks_stay_off_is_told_of_a_narrower_pinion_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It was told as infinite. In a plane a pinion and its shaper are involutes with one direction of their lines of
    action: those are as far apart as the base circles, turned with it, and the axes' heights leave them.
    """
    z1, z0, z2, m, alpha, width = 12, 15, 90, 2.0, math.radians(25.0), 6.0
    gear = {"module": m, "number_of_teeth": z2, "pinion_number_of_teeth": z1, "pressure_angle_deg": 25.0,
            "pinion_profile_shift_coefficient": 0.35, "shaper_number_of_teeth": z0}  # fmt: skip
    own = {"module": m, "number_of_teeth": z1, "pressure_angle_deg": 25.0, "profile_shift_coefficient": 0.35}
    pinion = PINION | own | {"face_width": width}
    file = tmp_path / "s.toml"
    mate = {"kind": "face_gear_pair", "first": "wheel", "second": "pinion"}
    file.write_text(
        table("[parts.wheel]", GEAR | gear) + table("[parts.pinion]", pinion) + table("[[mates]]", mate), "utf-8"
    )
    assert main(["check", str(file), "--json"]) == 0
    told = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)["mates"][0]["end_gap"]
    values = json.loads(calculate("face-gear", (str(file),), "json", "en"))["values"]
    middle = (values["face_inner_diameter"] + values["face_outer_diameter"]) / 4

    def lines(plane: float) -> float:
        angle = math.acos(m * z2 * math.cos(alpha) / 2 / plane)
        return m / 2 * math.cos(alpha) * (z1 - z0) * angle + values["contact_plane"] * (z0 - z1) / z2 * math.sin(angle)

    ends = [abs(lines(middle + way * width / 2) - lines(values["contact_plane"])) for way in (-1, 1)]
    assert told == pytest.approx(max(ends), rel=0.05)
    assert told < values["end_gap"] / 2


def test_the_shaper_of_a_face_gear_has_the_corner_that_its_key_tells_where_none_is_given() -> None:
    """0.2 of a module, in what `new` prints too; the undercut goes by it."""

    def undercut(**more: float) -> float:
        file = scene_from_dict({"parts": {"p": GEAR | more}}, "s", "s")
        return float(make_parts(file, "s")[0]["p"].circles["undercut_diameter"])

    assert undercut() == undercut(tip_radius_coefficient=0.2) > undercut(tip_radius_coefficient=0.201)
