"""Groove cams: walls against an eccentric disk, the roller rolled on both in every file, spoiled files, refusals."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely

from exporters.production.recheck import recheck
from geometry.base.errors import OffsetError
from geometry.cams.contact.rolled import lift_bound, outline_of_loop, rolled_lift
from geometry.cams.motion.guides import Mount, Oscillating, Translating
from geometry.cams.plane.curves import CentreEnvelope
from geometry.cams.plane.disk import FollowerKind
from geometry.cams.plane.walls import wide_roller
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile
from parts.base.refusal import SceneError
from parts.cams.probes import ANGLES
from tests.exporters.making import read_report, run
from tests.geometry.cams.oracle import MP, Eccentric, ridden_cam
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import GROOVE, GROOVES, PHASES, Keys, parts_of, scene, without

FORMATS = ("dxf", 'format = "dxf"\npurpose = "drawing"', "svg", "stl", "3mf")
STEEP = [PHASES[0] | {"angle_deg": 45.0}, PHASES[1], PHASES[2] | {"angle_deg": 50.0}, PHASES[3] | {"angle_deg": 225.0}]
MOUNTS: dict[str, Mount] = {
    "translating": Translating(5.0, 0.0),
    "against": Oscillating(95.0, 80.0, 0.0, 1),
    "with": Oscillating(95.0, 80.0, 0.0, -1),
}

HEAVY_BUT_ONE = [
    "against",
    pytest.param("translating", marks=pytest.mark.heavy),
    pytest.param("with", marks=pytest.mark.heavy),
]


def dense(profile: Profile) -> np.ndarray:
    return np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 400)) for s in profile.segments()])


def built(folder: Path, keys: Keys, *formats: str) -> tuple[Path, dict[str, Any]]:
    file = folder / "s.toml"
    file.write_text(scene({"cam": keys}, *formats), encoding="utf-8")
    assert run("build", file, "--out", folder / "o") == 0
    return folder / "o" / "s", read_report(folder / "o" / "s")


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", MOUNTS)
def test_walls_of_an_eccentric_disk_are_circles(name: str) -> None:
    """The lift over a disk about a point 9 mm off the axis, at 40 digits: both walls are circles about that point."""
    disk, radius, clearance = Eccentric(40.0, 9.0), 6.0, 0.3
    nodes = np.linspace(0.1, 6.2, 25)
    cam = ridden_cam(disk, FollowerKind.ROLLER, MOUNTS[name], radius, nodes)

    class Lift:
        values = staticmethod(lambda t, order: [cam.motion.pieces[0].value(t, k) for k in range(order + 1)])

    for grow in (0.0, 2 * radius + clearance):
        points = CentreEnvelope(Lift(), cam.mount, 0.0, 2 * math.pi, grow - radius).point(nodes)
        assert np.abs(np.abs(points - 9.0) - (40.0 + grow)).max() < 1e-12 * 50


@pytest.mark.parametrize("name", GROOVES)
def test_a_roller_in_a_round_groove_moves_as_its_triangle_says(name: str) -> None:
    """A circle about a point off the axis holds a roller from outside; the cam's own law does not enter."""
    cam = wide_roller(parts_of({"cam": GROOVES[name]})["cam"].thing.cam, 0.2)
    size, arm = 60.0, 9.0
    circle = outline_of_loop(np.array([size + arm, arm - size]) + 0j, np.ones(2), clockwise=True)
    found = rolled_lift(cam, circle, 72, below=False)
    mount = cam.mount
    start = mount.start_height if isinstance(mount, Translating) else mount.start_angle
    inside = Eccentric(size - 2 * cam.radius, arm)
    exact = [float(inside.lift(FollowerKind.ROLLER, mount, cam.radius, 2 * MP.pi * k / 72)) - start for k in range(72)]
    assert np.abs(found - exact).max() < 1e-12 * 95


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", GROOVES)
def test_the_roller_has_its_play_everywhere(name: str) -> None:
    part = parts_of({"cam": GROOVES[name]})["cam"]
    assert part.thing.cam is not None
    angle = np.linspace(0, 2 * math.pi, 181)
    centres = part.thing.cam.reference_point(angle) * np.exp(-1j * angle)
    for wall, radius in zip(part.probes, (8.0, 8.1), strict=True):
        for offset in (0.0, 0.2, -0.2):
            gap = distance_to_profile(centres, wall.profile(offset))
            assert np.abs(gap - (radius - offset)).max() < 1e-9


@pytest.mark.heavy
@pytest.mark.parametrize("name", HEAVY_BUT_ONE)
def test_both_walls_of_every_file_are_rolled(name: str, tmp_path: Path) -> None:
    report = built(tmp_path, GROOVES[name] | {"face_width": 12.0}, *FORMATS)[1]
    part = parts_of({"cam": GROOVES[name]})["cam"]
    swings = name != "translating"
    key, unit = ("swing_error_deg", 180 / math.pi) if swings else ("lift_error", 1.0)
    assert len(report["files"]) == len(FORMATS)
    for file in report["files"]:
        for wall in part.probes:
            bound = lift_bound(wall.cam, ANGLES, file["max_error"] + 1e-10).max() * unit
            error = file["measured"][f"{wall.name}_{key}"]
            assert 0.1 * file["max_error"] * unit / (120 if swings else 1) <= error <= bound
    drawing = next(f for f in report["files"] if f["purpose"] == "drawing")["measured"]
    suffix = "_deg" if swings else ""
    for wall in ("inner", "outer"):
        assert drawing[f"{wall}_acceleration_jump{suffix}"] < 0.01 * drawing[f"{wall}_acceleration_peak{suffix}"]


def test_a_step_file_is_rolled_and_the_solid_has_its_floor(tmp_path: Path) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    keys = GROOVE | {"face_width": 12.0, "face_chamfer": 0.5, "hub": {"diameter": 30.0, "above": 4.0}}
    step = built(tmp_path, keys, "step")[1]["files"][0]["measured"]
    for wall in ("inner", "outer"):
        assert 1e-9 < step[f"{wall}_lift_error"] < 2e-6


def test_the_solid_is_the_disk_less_the_groove() -> None:
    part = parts_of({"cam": GROOVE | {"face_width": 12.0}})["cam"]
    inner, outer = (shapely.Polygon(np.c_[d.real, d.imag]) for d in (dense(w.profile(0.0)) for w in part.probes))
    disk = math.pi * (part.circles["outer_diameter"] ** 2 - 12.0**2) / 4
    mesh = part.to_trimesh(0.002)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(disk * 12 - (outer.area - inner.area) * 5, rel=1e-4)


SPOILED = [
    pytest.param(w, p, marks=() if (w, p) in (("inner", 0.5), ("outer", 1.0)) else pytest.mark.heavy)
    for w in ("inner", "outer")
    for p in (0.0, 0.5, 1.0)
]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("wall", "place"), SPOILED)
def test_one_spoiled_wall_is_found_by_its_lift(wall: str, place: float, tmp_path: Path) -> None:
    """A vertex of one wall is moved towards the roller; the distance to the outline is not asked."""
    from exporters.formats.read_dxf import read_dxf
    from exporters.verification.judge import probed
    from exporters.verification.verdict import Verdict

    folder, report = built(tmp_path, GROOVE)
    drawing = ezdxf.readfile(folder / "cam.dxf")
    walls = sorted((e for e in drawing.modelspace() if e.dxf.layer == "ENGRAVE"), key=lambda e: e.get_points()[0][0])
    loops = sorted(walls, key=lambda e: max(math.hypot(*p[:2]) for p in e.get_points("xy")))
    outline = loops[0 if wall == "inner" else 1]
    points = outline.get_points("xyb")
    at = round(place * (len(points) - 1))
    x, y, bulge = points[at]
    share = 1 + (0.02 if wall == "inner" else -0.02) / math.hypot(x, y)
    points[at] = (x * share, y * share, bulge)
    outline.set_points(points, format="xyb")
    drawing.saveas(folder / "cam.dxf")
    part, declared = parts_of({"cam": GROOVE})["cam"], report["files"][0]["max_error"]
    verdict = probed(read_dxf(folder / "cam.dxf"), part, 0.0, declared, Verdict({}, ()))
    assert [f.split(":")[0] for f in verdict.failures] == [f"{wall} wall"]
    assert "lift is wrong" in verdict.failures[0]
    assert recheck(folder / "cam.dxf").verdict.failures


def test_walls_stand_on_their_own_layer_and_nowhere_else(tmp_path: Path) -> None:
    folder, _ = built(tmp_path, GROOVE)
    drawing = ezdxf.readfile(folder / "cam.dxf")
    layers = [e.dxf.layer for e in drawing.modelspace()]
    assert layers == ["ENGRAVE", "ENGRAVE", "CUT_INNER", "CUT_OUTER"]
    assert not recheck(folder / "cam.dxf").verdict.failures
    drawing.modelspace()[0].dxf.layer = "CUT_INNER"
    drawing.saveas(folder / "cam.dxf")
    assert any("instead of ENGRAVE" in f for f in recheck(folder / "cam.dxf").verdict.failures)


def test_pieces_are_the_layers_of_the_disk(tmp_path: Path) -> None:
    parts = {"cam": GROOVE | {"face_width": 12.0, "roller_clearance": 0.1}}
    parts |= {p: {"kind": "groove_piece", "of": "cam", "piece": p} for p in ("core", "ring", "floor")}
    file = tmp_path / "s.toml"
    file.write_text(scene(parts, "dxf", "stl"), encoding="utf-8")
    pieces = (word for p in ("core", "ring", "floor") for word in ("--part", p))
    assert run("build", file, "--out", tmp_path / "o", *pieces) == 0
    made = parts_of(parts)
    volume = sum(made[p].to_trimesh(0.002).volume for p in ("core", "ring", "floor"))
    assert volume == pytest.approx(made["cam"].to_trimesh(0.002).volume, rel=1e-5)
    measured = {f["path"]: f["measured"] for f in read_report(tmp_path / "o" / "s")["files"]}
    for path in ("core.dxf", "ring.dxf", "core.stl", "ring.stl"):
        assert 0 < measured[path]["lift_error"] < 0.02
    # a ring turned round by a hair
    drawing = ezdxf.readfile(tmp_path / "o" / "s" / "ring.dxf")
    wall = next(e for e in drawing.modelspace() if e.dxf.layer == "CUT_INNER")
    wall.transform(ezdxf.math.Matrix44.z_rotate(0.01))
    drawing.saveas(tmp_path / "o" / "s" / "ring.dxf")
    assert recheck(tmp_path / "o" / "s" / "ring.dxf").verdict.failures


# keys, the key that is blamed, why; the last ones are refused as they are read
WRONG: dict[str, tuple[Keys, str, str]] = {
    "through": (GROOVE | {"groove_depth": 10.0}, "groove_depth", "groove_goes_through"),
    "thin": (GROOVE | {"face_width": 0.05, "groove_depth": 2.0}, "face_width", "no_room_for_groove"),
    "no rim": (GROOVE | {"outer_diameter": 140.0}, "outer_diameter", "no_rim_beyond_groove"),
    "wide bore": (GROOVE | {"bore_diameter": 71.0}, "bore_diameter", "no_wall_to_groove"),
    "far holes": (GROOVE | {"holes": {"count": 3, "diameter": 8.0, "pitch_circle_diameter": 70.0}},
                  "holes.pitch_circle_diameter", "holes_beyond_groove"),
    "no base": (without(GROOVE, "base_circle_radius"), "base_circle_radius", "base_circle_missing"),
    "two bores": (GROOVE | {"bore": {"shape": "round", "diameter": 9.0}}, "bore_diameter", "either_key"),
    "wide": (GROOVE | {"phases": STEEP, "lift": 30.0, "follower_radius": 12.0, "base_circle_radius": 30.0},
             "base_circle_radius", "undercut_outer_wall"),
    "small": (GROOVE | {"phases": STEEP, "base_circle_radius": 12.0, "follower_radius": 10.0, "bore_diameter": 0.0},
              "base_circle_radius", "undercut_outer_wall"),
    "impact": (GROOVE | {"phases": [PHASES[0] | {"law": "constant_velocity"}, *PHASES[1:]]}, "phases[1].law",
               "undercut_by_impact"),
}  # fmt: skip
READ: dict[str, tuple[Keys, str]] = {
    "no groove depth": (without(GROOVE, "groove_depth"), "groove_depth"),
    "no roller": (GROOVE | {"follower_radius": 0.0}, "follower_radius"),
    "play below 0": (GROOVE | {"roller_clearance": -0.1}, "roller_clearance"),
    "wide hub": (GROOVE | {"hub": {"diameter": 80.0, "above": 3.0}}, "hub.diameter"),
}


@pytest.mark.sampled(5)
@pytest.mark.parametrize("name", WRONG)
def test_wrong_keys_are_refused_in_the_users_terms(name: str) -> None:
    keys, blamed, code = WRONG[name]
    refusal = refused({"cam": keys})
    assert (refusal.key, refusal.code) == (f"parts.cam.{blamed}", code)
    if name == "no base":
        assert refusal.nearest is None
    else:
        cured({"cam": keys}, refusal)


@pytest.mark.parametrize("name", READ)
def test_wrong_keys_are_refused_where_they_stand(name: str) -> None:
    keys, blamed = READ[name]
    with pytest.raises(SceneError) as caught:
        parts_of({"cam": keys})
    assert caught.value.key == f"parts.cam.{blamed}"
    assert "\n" not in str(caught.value)


def test_a_closing_offset_names_one_that_works() -> None:
    part = parts_of({"cam": GROOVE})["cam"]
    for offset in (9.0, -20.0):
        with pytest.raises(OffsetError) as refused_offset:
            part.section(offset)
        part.section(refused_offset.value.nearest_offset)


@pytest.mark.parametrize(("of", "code"), [("cam", "of_another_kind"), ("cma", "no_such_part")])
def test_a_piece_needs_its_groove(of: str, code: str) -> None:
    plain = {"kind": "cam", "follower": "roller"} | without(GROOVE, "kind", "groove_depth", "roller_clearance")
    parts = {"cam": plain, "core": {"kind": "groove_piece", "of": of, "piece": "core"}}
    alone = refused(parts)
    assert (alone.key, alone.code, alone.nearest) == ("parts.core.of", "none_of_kind", None)
    parts |= {"groove": GROOVE}
    refusal = refused(parts)
    assert (refusal.key, refusal.code) == ("parts.core.of", code)
    cured(parts, refusal)


def test_the_least_base_circle_serves_both_ways() -> None:
    keys = without(GROOVE, "base_circle_radius") | {"least_transmission_angle_deg": 60.0, "follower_offset": 6.0}
    quantities = parts_of({"cam": keys})["cam"].quantities
    both = [quantities[f"pressure_angle_{way}_deg"] for way in ("rise", "return")]
    assert max(both) == pytest.approx(30.0, abs=1e-6)
    assert min(both) < 30.0


def test_a_given_base_circle_that_keeps_no_transmission_angle_is_noted_both_ways() -> None:
    """Pressure angles by the lift's table: tan nu = (S' - e) / (s_0 + S); before, the key did nothing."""
    part = parts_of({"cam": GROOVE | {"least_transmission_angle_deg": 89.0}})["cam"]
    cam, angles = part.thing.cam, np.linspace(0.0, 2 * math.pi, 200_001)
    lift = cam.motion.value(angles)
    prime = GROOVE["base_circle_radius"] + GROOVE["follower_radius"]
    offset = GROOVE.get("follower_offset", 0.0)
    nu = np.degrees(np.arctan((np.gradient(lift, angles) - offset) / (math.sqrt(prime**2 - offset**2) + lift)))
    told = {finding.code: (finding.value, finding.limit) for finding in part.findings}
    assert told["transmission_angle_not_kept"] == (pytest.approx(90 - nu.max(), abs=1e-4), 89.0)
    assert told["return_transmission_angle_not_kept"] == (pytest.approx(90 + nu.min(), abs=1e-4), 89.0)
    kept = parts_of({"cam": GROOVE | {"least_transmission_angle_deg": 90 - np.abs(nu).max() - 1e-3}})["cam"]
    assert not [finding for finding in kept.findings if finding.code.endswith("transmission_angle_not_kept")]


# the farthest of the groove: the roller's centre at a height of sqrt(43^2 - 5^2) + 20 mm, 5 mm aside, and its play
OUTERMOST = math.hypot(5.0, math.sqrt(43.0**2 - 25.0) + 20.0) + 8.1
HOLES = {"holes": {"count": 3, "diameter": 8.0, "pitch_circle_diameter": 40.0}}


@pytest.mark.parametrize(("more", "code", "edge"), [
    ({"bore_diameter": 30.0}, "groove_closed", (2 * 8.0 + 0.1) / 2),
    ({"outer_diameter": 2 * (OUTERMOST + 2.0)}, "leaves_no_rim", -1.0),
    # between the groove, 35 mm from the axis, and the holes, which reach 24 mm
    ({"outer_diameter": 220.0, "bore_diameter": 0.0} | HOLES, "no_wall_inside_groove", -5.5),
])  # fmt: skip
def test_an_offset_ends_where_a_wall_or_the_groove_does(more: Keys, code: str, edge: float) -> None:
    part = parts_of({"cam": GROOVE | more})["cam"]
    with pytest.raises(OffsetError) as caught:
        part.section(edge * (1 + 1e-3))
    assert caught.value.code == code
    assert caught.value.nearest_offset == pytest.approx(edge, rel=1e-5)
    assert part.section(caught.value.nearest_offset).region.marks


def test_a_default_rim_is_half_the_groove_wide_in_whole_millimetres() -> None:
    part = parts_of({"cam": GROOVE})["cam"]
    assert part.circles["outer_diameter"] == math.ceil(2 * (OUTERMOST + 16.1 / 2))


def test_the_places_that_an_offset_trims_are_counted() -> None:
    """Corners of both walls, told by the jumps of their tangents."""
    part = parts_of({"cam": GROOVE | {"phases": STEEP, "outer_diameter": 220.0}})["cam"]
    for offset in (-5.0, -7.0, -10.0):
        section, corners = part.section(offset), 0
        for wall in section.region.marks:
            curves = [s.curve for s in wall.segments()]
            for before, after in zip(curves, curves[1:] + curves[:1], strict=True):
                bend = complex(after.tangent(after.domain[0])) / complex(before.tangent(before.domain[1]))
                corners += abs(np.angle(bend)) > 1e-3
        assert [f.value for f in section.findings] == ([float(corners)] if corners else [])
        assert bool(corners) is (offset < -6)


def test_what_is_told_of_a_groove_by_hand() -> None:
    """A cosine's jump H pi^2 / 2 phi^2 at the end of its rise, the greater one; play beyond 2 % of the roller."""
    cosines = [p | ({"law": "cosine"} if "law" in p else {}) for p in PHASES]
    (soft,) = (f for f in parts_of({"cam": GROOVE | {"phases": cosines}})["cam"].findings if f.code == "soft_impact")
    assert (soft.value, soft.limit) == pytest.approx((20 * math.pi**2 / 2 / math.radians(120) ** 2, 120.0))
    for play, told in ((0.319, []), (0.321, [(0.321, pytest.approx(0.32))]), (0.0, [(0.0, pytest.approx(0.32))])):
        found = parts_of({"cam": GROOVE | {"roller_clearance": play}})["cam"].findings
        assert [(f.value, f.limit) for f in found if f.code == "roller_play"] == told


def test_a_groove_leaves_a_floor() -> None:
    parts_of({"cam": GROOVE | {"face_width": 10.0, "groove_depth": 9.94}})
    told = refused({"cam": GROOVE | {"face_width": 10.0, "groove_depth": 9.96}})
    assert told.code == "groove_goes_through"
    assert told.nearest is not None
    assert told.nearest.value == pytest.approx(9.95)
