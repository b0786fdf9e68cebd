"""A file against the part it was made of, and against parts that differ in one size: told by what differs."""

from __future__ import annotations

import math
import re
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.formats.read_step import ReadSolid, read_step
from exporters.formats.readback import Loop, ReadMesh
from exporters.verification.faces import verify_faced_mesh, verify_faced_solid
from exporters.verification.mesh import verify_mesh
from exporters.verification.outlines import is_simple, stroke_failures, verify_loops, verify_samples
from exporters.verification.solid import verify_solid
from exporters.verification.topology import topology_failures
from exporters.verification.verdict import Verdict, deviation_failures, precision_failures, volume_failures
from geometry.approximation.chords import approximate_profile
from geometry.base.record import replace
from geometry.plane.profile import Label, circle
from geometry.solids.body import Body
from geometry.solids.mass import body_moments
from parts.base.readback import ReadError
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.mesh import body_mesh, mesh_outlines
from parts.solids.step_text import StepForm, StepPart, step_text
from tests.exporters.formats.test_step_spoiled import pole
from tests.exporters.making import read_report, run, write_scene
from tests.sampling import some_of

PLATE: dict[str, Any] = {"kind": "plate", "width": 20.0, "height": 12.0, "face_width": 3.0,
                         "holes": [{"diameter": 4.0, "at": [3.0, 1.0]}]}  # fmt: skip
GEAR: dict[str, Any] = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 9, "face_width": 1.5,
                        "bore_diameter": 5.0}  # fmt: skip
KEYS = {
    "plate": PLATE,
    "screw": GEAR | {"helix_angle_deg": 20.0},
    "chevron": GEAR | {"helix_angle_deg": 20.0, "double_helical": True},
    "chamfered": GEAR | {"face_chamfer": 0.3},
    "ring": {
        "kind": "ring_gear",
        "module": 2.0,
        "number_of_teeth": 18,
        "face_width": 1.5,
        "outer_diameter": 56.0,
        "face_chamfer": {"below": 0.3},
    },
    "hub": GEAR | {"hub": {"diameter": 9.0, "above": 1.0}},
}
NEAR = 0.01


@cache
def body_of(name: str, *changes: tuple[str, Any]) -> Body:
    keys = KEYS[name] | dict(changes)
    body = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0)
    assert isinstance(body, Body)
    return body


@cache
def mesh_of(name: str) -> ReadMesh:
    made = body_mesh(body_of(name), mesh_outlines(body_of(name), NEAR, 0.0))
    return ReadMesh(made.vertices, made.triangles)


@cache
def solid_of(name: str) -> ReadSolid:
    body = body_of(name)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "p.step"
        file.write_text(step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm()), "ascii")
        return read_step(file)


def told(verdict: Verdict) -> str:
    return "; ".join(verdict.failures)


def said_of(judge: Callable[..., Verdict], found: ReadMesh | ReadSolid, body: Body, near: float) -> str:
    """What is wrong with a file, as its judge tells it."""
    try:
        return told(judge(found, body, near, near))
    except ReadError as error:
        return str(error)


HOLE = PLATE["holes"][0]
# what differs in the part that the file is held against; what is said of meshes, and of solids
OTHERS: dict[str, tuple[str, tuple[str, Any], str, str]] = {
    "wider": ("plate", ("width", 20.1), "deviates .*face at z = 0 |face at z = 0 .*deviates", "volume .*deviates"),
    "higher": ("plate", ("height", 12.1), "deviates", "volume .*deviates"),
    "thicker": ("plate", ("face_width", 3.01), "off every face", "plane faces at"),
    "another hole": ("plate", ("holes", (HOLE | {"diameter": 4.1},)), "deviates", "deviates"),
    "a hole elsewhere": ("plate", ("holes", (HOLE | {"at": [3.1, 1.0]},)), "deviates", "deviates"),
    "no hole": ("plate", ("holes", ()), "contours instead of|face at z|caps", "cylinders instead of"),
    "two holes": ("plate", ("holes", (HOLE, HOLE | {"at": [-3.0, 1.0]})), "contours instead of", "cylinders instead"),
    "another helix": ("screw", ("helix_angle_deg", 21.0), "deviates", "deviates"),
    "another hand": ("screw", ("hand", "left"), "deviates", "deviates"),
    "no helix": ("screw", ("helix_angle_deg", 0.0), "off every face", "deviates|wall|cylinders"),
    "a wider bore": ("screw", ("bore_diameter", 5.1), "deviates", "deviates"),
    "one hand": ("chevron", ("double_helical", False), "", ""),
    "a deeper chamfer": ("chamfered", ("face_chamfer", 0.4), "no edge at one of its ends", "deviates|plane faces"),
    "no chamfer": ("chamfered", ("face_chamfer", 0.0), "", ""),
    "a ring's deeper chamfer": (
        "ring",
        ("face_chamfer", {"below": 0.4}),
        "no edge at one of its ends",
        "deviates|plane faces",
    ),
    "a ring's other chamfer": ("ring", ("face_chamfer", {"above": 0.3}), "", ""),
    "a wider hub": ("hub", ("hub", {"diameter": 9.1, "above": 1.0}), "deviates", "deviates"),
    "a higher hub": ("hub", ("hub", {"diameter": 9.0, "above": 1.1}), "off every face", "plane faces at"),
    "another tooth": ("hub", ("number_of_teeth", 10), "", ""),
    "a shift": ("hub", ("profile_shift_coefficient", 0.1), "deviates", "deviates"),
}


@cache
def other(change: str) -> Body:
    name, (key, value), *_ = OTHERS[change]
    keys = KEYS[name] | {key: list(value) if isinstance(value, tuple) else value}
    body = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0)
    assert isinstance(body, Body)
    return body


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", KEYS)
def test_a_mesh_is_its_part_s_and_no_neighbour_s(name: str) -> None:
    mesh, body = mesh_of(name), body_of(name)
    own = verify_mesh(mesh, body, NEAR, NEAR)
    assert own.failures == ()
    corners = mesh.vertices[mesh.triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    volume = float(np.einsum("ij,ij->", corners[:, 0], cross) / 6)
    assert own.measured["triangles"] == len(mesh.triangles)
    assert own.measured["volume"] == pytest.approx(volume, rel=1e-12)
    assert own.measured["volume_error"] == pytest.approx(volume / body_moments(body).volume - 1, abs=1e-12)
    assert own.measured["least_triangle_area"] == pytest.approx(np.linalg.norm(cross, axis=1).min() / 2, rel=1e-9)
    assert 0 < own.measured["max_deviation"] <= NEAR
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    assert edges.min() - 1e-9 <= own.measured["shortest_edge"] < 3 * edges.min() + 0.2
    # declared by less than it is off
    less = verify_mesh(mesh, body, own.measured["max_deviation"] * 0.99, NEAR)
    assert "more than the declared" in told(less)
    small = own.measured["max_deviation"] * 0.99
    assert "the tolerance is" in told(verify_mesh(mesh, body, small, small))
    for change in some_of(change for change, (of, *_) in OTHERS.items() if of == name):
        found = said_of(verify_mesh, mesh, other(change), NEAR)
        assert found, change
        assert re.search(OTHERS[change][2], found), (change, found)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", KEYS)
def test_a_solid_is_its_part_s_and_no_neighbour_s(name: str) -> None:
    solid, body = solid_of(name), body_of(name)
    own = verify_solid(solid, body, 1e-6, 1e-6)
    assert own.failures == ()
    exact = body_moments(body).volume
    assert own.measured["volume"] == pytest.approx(exact, rel=1e-8)
    assert own.measured["volume_error"] == pytest.approx(own.measured["volume"] / exact - 1, abs=1e-15)
    assert 0 < own.measured["volume_bound"] < 1e-6
    if name == "chevron":
        # declared by a little less than its worst place is off, which lies between its ends
        less = verify_solid(solid, body, own.measured["max_deviation"] * (1 - 1e-4), 1e-6)
        assert re.fullmatch("deviates by .*, more than the declared [^;]*", told(less))
    for change in some_of(change for change, (of, *_) in OTHERS.items() if of == name):
        found = said_of(verify_solid, solid, other(change), 1e-6)
        assert found, change
        assert re.search(OTHERS[change][3], found), (change, found)


def moved(name: str, where: np.ndarray, by: tuple[float, float, float]) -> ReadMesh:
    mesh = mesh_of(name)
    return ReadMesh(mesh.vertices + where[:, None] * np.array(by), mesh.triangles)


def test_what_is_wrong_with_a_mesh_is_told_by_its_own_words() -> None:
    mesh, body = mesh_of("plate"), body_of("plate")
    x, y, z = mesh.vertices.T
    corner = (x > 9.9) & (y > 5.9)
    t = mesh.triangles

    def said(wrong: ReadMesh) -> str:
        return told(verify_mesh(wrong, body, NEAR, NEAR))

    assert said(moved("plate", corner, (0.5, 0.0, 0.0))).startswith("the face at z = 0 has ")
    assert "the face at z = 3 has" in said(moved("plate", corner, (0.5, 0.0, 0.0)))
    assert "volume" in said(moved("plate", corner, (0.5, 0.0, 0.0)))
    assert "do not stand upright" in said(moved("plate", corner & (z > 1), (0.002, 0.0, 0.0)))
    assert said(moved("plate", corner & (z > 1), (0.0, 0.0, 0.002))) == "a vertex stands off every face"
    assert said(ReadMesh(mesh.vertices, t[1:])) == "the mesh is not closed: an edge has a triangle on one side only"
    assert said(ReadMesh(mesh.vertices, np.vstack([t, t[:1]]))) == "two triangles run along one edge the same way"
    assert said(ReadMesh(mesh.vertices, np.vstack([t, [[0, 0, 1]]]))) == "a triangle has two equal corners"
    flat = np.vstack([mesh.vertices, (mesh.vertices[t[0, 0]] + mesh.vertices[t[0, 1]]) / 2])
    assert said(ReadMesh(flat, np.vstack([t, [[t[0, 0], t[0, 1], len(x)]]]))) == "a triangle has no area"
    assert topology_failures(mesh) == []
    # inside out: faces look the other way
    assert "overlap" in said(ReadMesh(mesh.vertices, t[:, ::-1]))
    # a wall that goes up halfway only
    tall = ReadMesh(mesh.vertices * [1, 1, 2], t)
    assert said(tall) == "a vertex stands off every face"
    # a face folded over itself: an inner point of it beyond its edge
    caps = [k for k in range(len(t)) if np.all(z[t[k]] == 0)]
    a, b, c = t[caps[0]]
    beyond = mesh.vertices[a] + 3 * (mesh.vertices[b] - mesh.vertices[a]) + 2 * (mesh.vertices[c] - mesh.vertices[a])
    more = np.delete(t, caps[0], axis=0)
    folded = np.vstack([more, [[a, b, len(x)], [b, c, len(x)], [c, a, len(x)]]])
    assert "face at z = 0" in said(ReadMesh(np.vstack([mesh.vertices, beyond]), folded))


def test_screw_surfaces_and_chamfers_are_told_by_their_own_words() -> None:
    mesh, body = mesh_of("screw"), body_of("screw")
    z = mesh.vertices[:, 2]
    between = (z > 0.1) & (z < 1.4)
    assert between.any()
    for name, mark in (("screw", "slice at z ="), ("chamfered", "slice to slice|off every face|deviates")):
        whole, own = mesh_of(name), body_of(name)
        heights = whole.vertices[:, 2]
        inner = np.unique(heights[(heights > 1e-3) & (heights < heights.max() - 1e-3)])
        level = inner[0]
        out = np.abs(heights - level) < 1e-9
        far = np.hypot(whole.vertices[:, 0], whole.vertices[:, 1]) > 5
        grown = whole.vertices * np.where(out & far, 1.01, 1.0)[:, None] ** np.array([1, 1, 0])
        said = said_of(verify_mesh, ReadMesh(grown, whole.triangles), own, NEAR)
        assert any(word in said for word in mark.split("|")), (name, said)
        assert "deviates" in said or "slice" in said
    # one vertex of a slice at another height
    lone = np.flatnonzero(between)[0]
    lifted = mesh.vertices.copy()
    lifted[lone, 2] += 0.01
    said = said_of(verify_mesh, ReadMesh(lifted, mesh.triangles), body, NEAR)
    assert re.search("from slice to slice|is not closed", said)


SQUARE = np.array([0, 10, 10 + 10j, 10j])


def test_chains_are_held_against_profiles_one_by_one() -> None:
    disc, hole = circle(5.0, Label.BODY), circle(2.0, Label.HOLE, hole=True)
    turn = np.exp(2j * np.pi * np.arange(4) / 4)
    bulge = math.tan(math.pi / 8)
    outer, inner = Loop(5 * turn, np.full(4, bulge), "CUT_OUTER"), Loop(2 * turn[::-1], np.full(4, -bulge), "CUT_INNER")
    layers = ["CUT_OUTER", "CUT_INNER"]

    def verdict(loops: list[Loop], declared: float = 1e-6, tolerance: float = 1e-3) -> Verdict:
        return verify_loops(loops, [disc, hole], layers, declared, tolerance)

    good = verdict([inner, outer])
    assert good.failures == ()
    assert good.measured["contours"] == 2
    assert good.measured["max_deviation"] < 1e-12
    assert good.measured["shortest_edge"] == pytest.approx(2 * math.sqrt(2))
    assert told(verdict([outer])) == "1 contours instead of 2"
    assert told(verdict([outer, inner])) == "a contour on CUT_INNER comes after one that lets it fall"
    assert "stands on CUT_INNER instead of CUT_OUTER" in told(
        verdict([inner, Loop(5 * turn, outer.bulges, "CUT_INNER")])
    )
    grown = Loop(outer.vertices * (1 + 1e-6), outer.bulges, "CUT_OUTER")
    assert verdict([inner, grown]).measured["max_deviation"] == pytest.approx(5e-6, rel=1e-3)
    assert "more than the declared 1e-06 mm" in told(verdict([inner, grown]))
    assert told(verdict([inner, grown], 5.1e-6)) == ""
    assert "the tolerance is 4e-06 mm" in told(verdict([inner, grown], 5.1e-6, 4e-6))
    twice = Loop(np.insert(outer.vertices, 1, outer.vertices[1]), np.insert(outer.bulges, 1, 0.0), "CUT_OUTER")
    assert "repeats a vertex" in told(verdict([inner, twice]))
    for bad in (Loop(outer.vertices[:1], outer.bulges[:1], ""), Loop(outer.vertices * np.nan, outer.bulges, ""),
                Loop(outer.vertices, outer.bulges * np.inf, "")):  # fmt: skip
        assert "holds no shape" in told(verdict([inner, bad]))
    flat = Loop(outer.vertices, np.array([bulge, bulge, bulge, 0.0]), "CUT_OUTER")
    # what a chord takes away lies within its deviation
    assert told(verdict([inner, flat])).startswith("deviates by ")
    assert "encloses" not in told(verdict([inner, flat]))
    # two quarters there and back lie nowhere off it
    half = Loop(np.append(outer.vertices[:3], outer.vertices[1]), bulge * np.array([1.0, 1, -1, -1]), "CUT_OUTER")
    said = re.search(r"encloses (.*) mm\^2 instead of (.*) mm\^2", told(verdict([inner, half])))
    assert said
    assert [float(one) for one in said.groups()] == pytest.approx([0.0, 25 * math.pi], rel=1e-8, abs=1e-12)
    assert verdict([inner, half]).measured["max_deviation"] < 1e-12
    there_and_back = np.concatenate([outer.vertices, outer.vertices[1:3]])
    assert "crosses itself" in told(verdict([inner, Loop(there_and_back, np.full(6, bulge), "CUT_OUTER")]))


def test_samples_are_held_against_profiles() -> None:
    disc = circle(5.0, Label.BODY)
    turn = np.exp(2j * np.pi * np.arange(400) / 400)
    good = verify_samples([5 * turn], [disc], 1e-6, 1e-3)
    assert good.failures == ()
    assert good.measured == {"contours": 1.0, "max_deviation": pytest.approx(0.0, abs=1e-12)}
    assert told(verify_samples([], [disc], 1e-6, 1e-3)) == "0 contours instead of 1"
    assert "more than the declared" in told(verify_samples([(5 + 2e-6) * turn], [disc], 1e-6, 1e-3))
    # the same points, some of them left out: the area is another
    assert "encloses" in told(verify_samples([5 * turn[:300]], [disc], 1e-6, 1e-3))
    assert told(verify_samples([5 * turn], [disc], 1e-6, 1e-3, [78.0])).startswith(
        "encloses 78 mm^2 instead of 78.5398"
    )
    assert told(verify_samples([5 * turn], [disc], 1e-6, 1e-3, [78.5])) == ""
    crossed = 5 * np.concatenate([turn, turn[::-1][5:-5], turn])
    assert "crosses itself" in told(verify_samples([crossed], [disc], 1e-6, 1e-3))


def test_what_a_coarse_drawing_encloses_is_borne_as_its_error_is(tmp_path: Path) -> None:
    """Module 0.01 mm within 1e-4 mm: 0.6 % too much area failed, which that error makes."""
    rack = {"addendum_coefficient": 1.0, "tip_clearance_coefficient": 0.25, "tip_radius_coefficient": 0.1}
    gear = {"kind": "spur_gear", "module": 0.01, "number_of_teeth": 6, "pressure_angle_deg": 10.0,
            "profile_shift_coefficient": -0.3461, "face_width": 0.01, "basic_rack": rack}  # fmt: skip
    drawing = {"format": "dxf", "purpose": "drawing", "tolerance": 1e-4}
    assert run("build", write_scene(tmp_path / "s.toml", {"g": gear}, [drawing]), "--out", tmp_path) == 0
    assert read_report(tmp_path / "s")["failed"] == []
    # a disc whose points lie as near encloses as much more, and no more than that
    disc, turn = circle(5.0, Label.BODY), np.exp(2j * np.pi * np.arange(400) / 400)
    assert told(verify_samples([5.04 * turn], [disc], 0.05, 0.1)) == ""
    assert "encloses" in told(verify_samples([5 * turn], [disc], 0.05, 0.1, [76.7]))


def test_strokes_stand_where_they_are_engraved() -> None:
    one, two = SQUARE[:3], SQUARE[1:] * 2
    assert stroke_failures([one, two], [one, two], 1e-3) == ()
    assert stroke_failures([one + 0.9e-3, two], [one, two], 1e-3) == ()
    assert stroke_failures([one + 1.1e-3, two], [one, two], 1e-3) == ("an engraved stroke is not where it should be",)
    assert stroke_failures([one, two[:2]], [one, two], 1e-3) == ("an engraved stroke is not where it should be",)
    assert stroke_failures([one], [one, two], 1e-3) == ("1 engraved strokes instead of 2",)


def test_polygons_that_cross_themselves_are_seen() -> None:
    star = np.exp(2j * np.pi * 2 * np.arange(5) / 5)
    ring = np.exp(2j * np.pi * np.arange(7) / 7)
    assert is_simple(ring)
    assert is_simple(ring[::-1])
    assert is_simple(ring + 3)
    # twice round the origin, all of it one way
    assert not is_simple(star)
    assert not is_simple(np.array([0, 1 + 1j, 1, 1j]))
    assert is_simple(SQUARE)


def test_bounds_of_a_verdict_are_kept_from_both_sides() -> None:
    assert deviation_failures(1e-3, 1e-3, 1e-3, 10.0) == []
    assert "the tolerance is" in deviation_failures(1.001e-3, 1e-2, 1e-3, 10.0)[0]
    assert "more than the declared" in deviation_failures(1.001e-3, 1e-3, 1e-2, 10.0)[0]
    assert deviation_failures(math.nan, 1e-3, 1e-3, 10.0)
    assert precision_failures(1e-7, 1e-7) == []
    assert precision_failures(2e-7, 1e-7) == ["calls points one within 2e-07 mm instead of 1e-07 mm"]
    assert volume_failures(100.0, 100.0005, 1e-3, None) == []
    assert volume_failures(100.0, 100.002, 1e-3, None) == ["volume 100 mm^3 instead of 100.002 mm^3"]
    assert volume_failures(100.0, 100.0, 1e-3, 100.0005) == []
    assert volume_failures(100.0, 100.0, 1e-3, "100.002") == [
        "says that its volume is 100.002 mm^3 instead of 100 mm^3"
    ]


def test_every_edge_of_a_period_is_measured_and_every_period() -> None:
    """One corner of a tooth off in each tooth alike, whichever it is; and one corner of one tooth alone."""
    profile = next(p for p in body_of("hub").profiles if p.count == 9)
    loop = approximate_profile(profile, 1e-3, arcs=True).geometry
    vertices, bulges = loop.expanded()
    period = len(vertices) // 9
    for places in (range(0, period, 3), [period - 1]):
        for at in places:
            for teeth in (range(9), [4], [8]):
                moved = vertices.copy()
                moved[[k * period + at for k in teeth]] *= 1 + 1e-3
                off = float(np.abs(moved - vertices).max())
                found = verify_loops([Loop(moved, bulges, "")], [profile], [""], 1e-3, 1.0)
                assert any("more than the declared" in f for f in found.failures), (at, teeth)
                assert found.measured["max_deviation"] <= off + 1e-3
    good = verify_loops([Loop(vertices, bulges, "")], [profile], [""], 1e-3, 1.0)
    assert good.failures == ()


def ring_of(radius: float = 35.0, high: float = 6.0, bore: float = 20.0) -> Any:
    points = [(bore, 0.0), (radius, 0.0), (radius, high / 2), (radius - 5, high), (bore, high)]
    keys = {"kind": "turned", "points": [{"r": r, "z": z} for r, z in points]}
    body = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0)
    assert body.is_faced
    return body


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "change", [{"radius": 35.002}, {"high": 6.002}, {"bore": 19.998}, {"bore": 0.0}, {"radius": 36.0, "bore": 18.9}]
)
def test_a_turned_part_is_no_neighbour_of_its_own(change: dict[str, float], tmp_path: Path) -> None:
    """Its faces in STEP and its mesh, which differ by less than a chord does, and more."""
    body, other_ = ring_of(), ring_of(**change)
    made = body_mesh(body, mesh_outlines(body, 1e-3, 0.0))
    mesh = ReadMesh(made.vertices, made.triangles)
    assert verify_faced_mesh(mesh, body, 1e-3, 1e-3).failures == ()
    assert "deviates by" in told(verify_faced_mesh(mesh, other_, 1e-3, 1e-3))
    file = tmp_path / "p.step"
    file.write_text(step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm()), "ascii")
    solid = read_step(file)
    assert verify_faced_solid(solid, body, 1e-6, 1e-6).failures == ()
    wrong = told(verify_faced_solid(solid, other_, 1e-6, 1e-6))
    assert "deviates by" in wrong
    assert "mm^3 instead of" in wrong


@pytest.mark.parametrize("name", ["plate", "ring"])
def test_what_a_step_says_of_itself_is_held_on_its_own(name: str, tmp_path: Path) -> None:
    body, judge = (body_of("plate"), verify_solid) if name == "plate" else (ring_of(), verify_faced_solid)
    file = tmp_path / "p.step"
    part = StepPart("p", solid_faces(body, solid_curves(body, 1e-6)))
    file.write_text(step_text(part, StepForm()), "ascii")
    solid = read_step(file)
    volume, area = float(solid.model.flux.sum()), float(solid.model.area.sum())
    good = replace(solid, said={"volume": volume, "surface area": area})
    assert judge(good, body, 1e-6, 1e-6).failures == ()
    for key, value, word in (("volume", volume, "its volume is"), ("surface area", area, "its surface area is")):
        for share, well in ((1e-10, True), (1e-5, False), (-1e-5, False)):
            wrong = told(judge(replace(good, said=dict(good.said) | {key: value * (1 + share)}), body, 1e-6, 1e-6))
            assert (wrong == "") is well, (key, share)
            assert well or word in wrong
    assert "calls points one within 2e-07" in told(judge(replace(good, precision=2e-7), body, 1e-6, 1e-6))


def test_a_wall_in_two_pieces_where_it_is_one_is_told() -> None:
    """The bore of a gear with a hub, cut across at the height of its face: no cap is there."""
    mesh, body = mesh_of("hub"), body_of("hub")
    bore = np.hypot(*mesh.vertices[:, :2].T) < 2.6
    wall = bore[mesh.triangles].all(axis=1) & (np.ptp(mesh.vertices[mesh.triangles][:, :, 2], axis=1) > 0)
    foot = np.flatnonzero(bore & (mesh.vertices[:, 2] == 0))
    head = np.flatnonzero(bore & (mesh.vertices[:, 2] == mesh.vertices[:, 2].max()))
    around = [ring[np.argsort(np.angle(mesh.vertices[ring, 0] + 1j * mesh.vertices[ring, 1]))] for ring in (foot, head)]
    middle = mesh.vertices[around[0]].copy()
    middle[:, 2] = 1.5
    count = len(foot)
    rows = [around[0], len(mesh.vertices) + np.arange(count), around[1]]
    made = []
    for low, high in ((rows[0], rows[1]), (rows[1], rows[2])):
        for k in range(count):
            a, b, c, d = low[k], low[(k + 1) % count], high[k], high[(k + 1) % count]
            made += [[a, c, b], [b, c, d]]
    cut = ReadMesh(np.vstack([mesh.vertices, middle]), np.vstack([mesh.triangles[~wall], np.array(made)]))
    assert topology_failures(cut) == []
    assert re.search("does not end at the faces|no edge at one", said_of(verify_mesh, cut, body, NEAR))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_a_tooth_that_is_no_copy_of_the_others_is_told(share: float, tmp_path: Path) -> None:
    """A pole moved along its own edge by twice the tolerance: all of it still lies on the part."""
    body, file = body_of("hub"), tmp_path / "p.step"
    text = step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm())
    # a file that calls points one within so much may have edges beside their faces
    file.write_text(pole(text, share, 1.0).replace("1.E-07", "1.E-06"), "ascii")
    assert "off its copies" in told(verify_solid(read_step(file), body, 1.0, 1.0))
    file.write_text(text, "ascii")
    assert verify_solid(read_step(file), body, 1e-6, 1e-6).failures == ()


def test_teeth_that_only_look_alike_are_no_copies(tmp_path: Path) -> None:
    """Of a round oval all teeth are alike, but those of one lobe have splines of their own."""
    keys = {"kind": "noncircular_gear", "centrode": "oval", "number_of_teeth": 12, "module": 2.0, "axis_ratio": 1.0}
    body = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0)
    file = tmp_path / "p.step"
    text = step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm())
    file.write_text(text, "ascii")
    assert verify_solid(read_step(file), body, 1e-6, 1e-6).failures == ()
    file.write_text(pole(text, 0.5, 1.0).replace("1.E-07", "1.E-06"), "ascii")
    assert "off its copies" in told(verify_solid(read_step(file), body, 1.0, 1.0))


def test_the_area_of_a_cone_to_its_apex_is_that_of_the_formula(tmp_path: Path) -> None:
    """pi r (r + sqrt(r^2 + h^2)), and a flat one."""
    for high in (12.0, 0.5):
        keys = {"kind": "turned", "points": [{"r": 0.0, "z": 0.0}, {"r": 5.0, "z": 0.0}, {"r": 0.0, "z": high}]}
        body = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0)
        file = tmp_path / "c.step"
        file.write_text(step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm()), "ascii")
        model = read_step(file).model
        assert model.area.sum() == pytest.approx(math.pi * 5 * (5 + math.hypot(5, high)), rel=1e-9)
        assert model.flux.sum() == pytest.approx(math.pi * 25 * high / 3, rel=1e-9)
