"""The two oracles against each other, against elementary facts, and with negative controls."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from tests.oracles import exact_gear as exact
from tests.oracles.exact_gear import MP, GearParameters, Segment
from tests.oracles.rack_sweep import RackTool, clearance_error, outline_error, penetration


def gear(z: int, degrees: str, x: str, rho: str, tip: str = "0.8", **more: str) -> GearParameters:
    """Gear of module 2, rack 1/0.25, tip circle at r + (tip + x) m."""
    radius = MP.mpf(z) + 2 * (MP.mpf(tip) + MP.mpf(x))
    return GearParameters(z, 2, exact.radians(degrees), 1, "0.25", rho, x, tip_radius=radius, **more)


def tool_of(p: GearParameters) -> RackTool:
    """The brute-force tool of the same data."""
    names = ("m", "alpha", "ha", "c", "rho", "x", "thinning", "relief_depth", "relief_height")
    return RackTool(**{name: float(getattr(p, name)) for name in names})


RELIEF = {"relief_depth": "0.02"}
CASES = {
    "z23": gear(23, "20", "0", "0.38", tip="1"),
    "z23 relief": gear(23, "20", "0.1", "0.38", tip="1", **RELIEF),
    "z23 relief deep, thin": gear(23, "25", "0.3", "0.3", relief_depth="0.05", thinning="0.07"),
    "z23 x1 past the limit": gear(23, "20", "1", "0.38"),
    "rounding centre on pitch line": gear(23, "20", "0.87", "0.38"),
    "rounding centre on pitch line, 25": gear(17, "25", "0.95", "0.3"),
    "z23 sharp tool": gear(23, "20", "0", "0"),
    "z23 14.5 x-0.5 relief": gear(23, "14.5", "-0.5", "0.3", tip="1", **RELIEF),
    "z23 30": gear(23, "30", "0.5", "0.11"),
    "z17 barely undercut": gear(17, "20", "0", "0.38", tip="1"),
    "z17 at the limit": gear(17, "20", "0.0056", "0.38", tip="1"),
    "z17 25 x-0.5": gear(17, "25", "-0.5", "0.3"),
    "z8 undercut": gear(8, "20", "0", "0.38", thinning="0.05"),
    "z8 x0.5": gear(8, "20", "0.5", "0.38"),
    "z6 undercut": gear(6, "20", "0.1", "0.38"),
    "z6 14.5 undercut": gear(6, "14.5", "0.4", "0.38"),
    "z3": gear(3, "20", "0.9", "0.38", tip="0.2"),
    "z1000 x-0.5": gear(1000, "20", "-0.5", "0.38", tip="1"),
    "z1000 x1 relief": gear(1000, "20", "1", "0.38", tip="0.9", **RELIEF),
}
UNDERCUT = ["z23 14.5 x-0.5 relief", "z17 barely undercut", "z17 at the limit", "z17 25 x-0.5", "z8 undercut",
            "z8 x0.5", "z6 undercut", "z6 14.5 undercut"]  # fmt: skip
every_case = pytest.mark.parametrize("name", CASES)


@cache
def outline(name: str) -> dict[str, np.ndarray]:
    """15 points of every piece of the exact half tooth."""
    pieces = exact.half_tooth(CASES[name])
    return {s.kind: np.array([complex(v) for v in exact.sample(s, 15)]) for s in pieces}


def middle(piece: Segment, share: float = 0.5) -> tuple[complex, complex]:
    """Point and normal into the space of a piece."""
    where, normal = piece.curve(piece.lo + (piece.hi - piece.lo) * MP.mpf(share))
    return complex(where), complex(normal)


@pytest.mark.sampled(2)
@every_case
def test_exact_outline_has_no_penetration(name: str) -> None:
    p = CASES[name]
    radius = float(p.tip_radius)
    for kind, points in outline(name).items():
        error = outline_error(points, tool_of(p), p.z, radius)
        assert error.max() < 2e-15 * radius, kind


@pytest.mark.sampled(1)
@every_case
def test_every_tooth_and_both_flanks_are_alike(name: str) -> None:
    p = CASES[name]
    points = np.concatenate(list(outline(name).values()))
    turns = np.exp(2j * np.pi / p.z * np.array([1, p.z // 2, p.z - 1]))
    copies = np.concatenate([np.conj(points) * turn for turn in turns])
    assert outline_error(copies, tool_of(p), p.z, float(p.tip_radius)).max() < 4e-15 * float(p.tip_radius)


@pytest.mark.sampled(1)
@every_case
@pytest.mark.parametrize("sign", [1, -1])
def test_negative_control_one_billionth_is_seen(name: str, sign: int) -> None:
    """Root, fillet, flank (start, middle, end) moved by 1e-9 of the radius: seen, by both oracles."""
    p = CASES[name]
    radius = float(p.tip_radius)
    move = sign * 1e-9 * radius
    for piece in exact.half_tooth(p):
        for share in (0.01, 0.5, 0.99):
            where, normal = middle(piece, share)
            moved = where + move * normal
            distance = float(exact.normal_distance(moved, p))
            assert distance == pytest.approx(move, abs=1e-15 * radius)
            error = outline_error(moved, tool_of(p), p.z, radius)[0]
            assert error == pytest.approx(abs(move), rel=0.02 if p.rho else 0.9)
            if piece.kind != "tip":
                assert np.sign(penetration(moved, tool_of(p), p.z)[0]) == sign


@pytest.mark.parametrize("change", [{"rho": "0.380001"}, {"x": "0.000001"}, {"thinning": "0.000004"}])
def test_negative_control_other_tool_is_seen(change: dict[str, str]) -> None:
    p = CASES["z23"]
    other = tool_of(replace(p, **{name: MP.mpf(value) for name, value in change.items()}))
    points = np.concatenate([outline("z23")[kind] for kind in ("fillet", "flank")])
    assert outline_error(points, other, p.z, float(p.tip_radius)).max() > 1e-7


@pytest.mark.sampled(1)
@every_case
def test_penetration_is_the_distance_in_the_metal(name: str) -> None:
    """True maximum over the rolling: brute force and the 50-digit distance agree at random metal points."""
    p = CASES[name]
    rng = np.random.default_rng(7)
    ra, root = float(p.tip_radius), float(abs(exact.fillet_point(p, 0)))
    cloud = rng.uniform(0.9 * root, ra, 36) * np.exp(1j * rng.uniform(-np.pi / p.z, np.pi / p.z, 36))
    depth = np.maximum(penetration(cloud, tool_of(p), p.z), np.abs(cloud) - ra)
    distance = np.array([float(exact.normal_distance(q, p)) for q in cloud])
    assert np.array_equal(depth > 0, distance > 0)
    metal = depth < 0
    assert metal.sum() > 10
    assert np.abs(depth - distance)[metal].max() < 1e-14 * ra
    assert np.all(depth[~metal] <= distance[~metal] + 1e-14 * ra)


@pytest.mark.sampled(2)
@every_case
def test_grid_does_not_matter(name: str) -> None:
    p = CASES[name]
    rng = np.random.default_rng(3)
    cloud = rng.uniform(0.5, 1, 80) * float(p.tip_radius) * np.exp(1j * rng.uniform(-4, 4, 80))
    coarse, dense = (penetration(cloud, tool_of(p), p.z, grid=n) for n in (513, 6001))
    assert np.abs(coarse - dense).max() < 2e-15 * float(p.tip_radius)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("rho", [0.0, 0.2])
@pytest.mark.parametrize("z", [3, 5, 8])
def test_grid_does_not_matter_in_deep_undercut(z: int, rho: float) -> None:
    """There the greatest depth is often found at the very end of the range the tool can reach."""
    tool = RackTool(1, np.radians(14.5), 1, 0.25, rho, -0.4)
    rng = np.random.default_rng(5)
    cloud = z / 2 + rng.uniform(-1.2, 0.6, 150)
    cloud = cloud * np.exp(1j * rng.uniform(-4, 4, 150))
    coarse, dense = (penetration(cloud, tool, z, grid=n) for n in (513, 6001))
    assert np.abs(coarse - dense).max() < 4e-15 * z


def test_gear_axis_and_far_points() -> None:
    p = CASES["z23"]
    root = 23 - 2.5
    assert penetration([0, 1e-3], tool_of(p), 23) == pytest.approx([-root, 1e-3 - root], abs=1e-3)
    assert penetration([40, 30j], tool_of(p), 23).min() > 0
    assert penetration([], tool_of(p), 23).shape == (0,)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", UNDERCUT)
def test_undercut_crossing(name: str) -> None:
    """Both curves pass through the junction; what each has beyond it is cut away."""
    p, joint = CASES[name], exact.junction(CASES[name])
    assert abs(exact.fillet_point(p, joint.angle) - joint.point) < MP.mpf(10) ** -50
    start, end = exact.straight_start(p), exact.rounding_end(p)
    lost = [exact.flank_point(p, start + (joint.rack_y - start) * k / 5) for k in range(1, 5)]
    lost += [exact.fillet_point(p, joint.angle + (end - joint.angle) * k / 5) for k in range(1, 5)]
    assert penetration([complex(q) for q in lost], tool_of(p), p.z).min() > -1e-15 * p.z
    assert min(exact.normal_distance(q, p) for q in lost) > 0
    assert not exact.junction(replace(p, x=p.x + 2)).undercut


def test_undercut_list() -> None:
    assert [name for name in CASES if exact.junction(CASES[name]).undercut] == UNDERCUT
    assert {name for name in CASES if "undercut" in name} < set(UNDERCUT)
    assert "z17 at the limit" in UNDERCUT
    assert "z23" not in UNDERCUT


@pytest.mark.sampled(1)
@pytest.mark.parametrize("z", [3, 6, 8, 17, 23, 1000])
@pytest.mark.parametrize("degrees", ["14.5", "20", "25", "30"])
def test_undercut_limit_formula(z: int, degrees: str) -> None:
    alpha, hf, rho = exact.radians(degrees), MP.mpf("1.25"), MP.mpf("0.38")
    formula = hf - rho * (1 - MP.sin(alpha)) - z * MP.sin(alpha) ** 2 / 2
    assert abs(exact.undercut_limit_shift(z, alpha, hf, rho) - formula) < MP.mpf(10) ** -32 * z


@pytest.mark.sampled(1)
@pytest.mark.parametrize("z", [8, 17])
def test_undercut_limit_by_brute_force(z: int) -> None:
    """Below the limit the flank's first point is in the tool at some other position, above it is not."""
    limit = exact.undercut_limit_shift(z, exact.radians(20), "1.25", "0.38")
    for step, cut in ((-0.05, True), (0.05, False)):
        p = GearParameters(z, 1, exact.radians(20), 1, "0.25", "0.38", limit + step)
        first = complex(exact.flank_point(p, exact.straight_start(p)))
        depth = penetration(first, tool_of(p), z)[0]
        assert depth > 1e-6 if cut else abs(depth) < 1e-15 * z


@pytest.mark.sampled(8)
@every_case
def test_flank_normals_touch_the_base_circle(name: str) -> None:
    """An involute's defining property, nowhere used in the generation; with relief a second base circle."""
    p = CASES[name]
    for piece in exact.half_tooth(p):
        angle = {"flank": p.alpha, "relief": p.relief_angle}.get(piece.kind)
        if angle is not None:
            where, normal = piece.curve((piece.lo + piece.hi) / 2)
            assert abs(abs((MP.conj(normal) * where).imag) - p.r * MP.cos(angle)) < MP.mpf(10) ** -50


@pytest.mark.sampled(6)
@every_case
def test_thickness(name: str) -> None:
    """On the reference circle: space = rack tooth there, so s = pi m/2 + 2 x m tan(alpha) - thinning."""
    p, joint = CASES[name], exact.junction(CASES[name])
    pieces = {s.kind: s for s in exact.half_tooth(p)}
    if abs(joint.point) < p.r < abs(pieces["flank"].curve(pieces["flank"].hi)[0]):
        expected = MP.pi * p.m / 2 + 2 * p.x * p.m * MP.tan(p.alpha) - p.thinning
        assert abs(exact.tooth_thickness(p, p.r) - expected) < MP.mpf(10) ** -48
    assert 0 < exact.tip_thickness(p) < exact.tooth_thickness(p, (abs(joint.point) + p.tip_radius) / 2)


def test_fillet_is_an_arc_when_the_rounding_centre_is_on_the_pitch_line() -> None:
    p = CASES["rounding centre on pitch line"]
    a, b, *rest = exact.sample(exact.half_tooth(p)[1], 9)
    centres = [
        q + p.rho * p.m * exact.half_tooth(p)[1].curve(exact.junction(p).angle * k / 8)[1]
        for k, q in enumerate([a, b, *rest])
    ]
    assert max(abs(c - centres[0]) for c in centres) < MP.mpf(10) ** -50


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", ["z23", "rounding centre on pitch line", "z1000 x-0.5", "z8 x0.5"])
@pytest.mark.parametrize("distance", [0.1, 0.75, -0.1])
def test_kerf_path(name: str, distance: float) -> None:
    p = CASES[name]
    pieces = [s for s in exact.half_tooth(p) if s.kind != "tip"]
    path = [where + distance * normal for where, normal in (middle(s, t) for s in pieces for t in (0.2, 0.5))]
    assert clearance_error(path, distance, tool_of(p), p.z).max() < 4e-15 * p.z
    assert clearance_error(path, distance + 1e-9, tool_of(p), p.z).min() > 0.9e-9


@pytest.mark.sampled(1)
@pytest.mark.parametrize("relief", [0.0, 0.05])
def test_signed_depth_against_a_dense_boundary(relief: float) -> None:
    """The tool's distance function against nearest points of a sampled boundary."""
    tool = RackTool(1, np.radians(20), 1, 0.25, 0.3, 0, thinning=0.1, relief_depth=relief)
    (hc, uc), (h0, u0) = tool.centre, tool.relief_corner
    turn = np.linspace(0, np.pi / 2 - tool.alpha, 4001)
    straight = np.linspace(tool.straight_from, h0, 8001)
    above = np.linspace(h0, 3, 20001)
    half = np.concatenate(
        [
            -tool.depth_mm + 1j * np.linspace(0, uc, 2001),
            hc + 1j * uc - 0.3 * np.exp(-1j * turn),
            straight + 1j * (tool.half + straight * np.tan(tool.alpha)),
            above + 1j * (u0 + (above - h0) * np.tan(tool.relief_angle)),
        ]
    )
    boundary = np.concatenate([half, np.conj(half)])
    rng = np.random.default_rng(1)
    q = rng.uniform(-1.8, 1.2, 150) + 1j * rng.uniform(-1.6, 1.6, 150)
    nearest = np.abs(q[:, None] - boundary).min(axis=1)
    depth = tool.signed_depth(q)
    assert np.abs(tool.signed_depth(boundary)).max() < 1e-15
    outside = depth < 0
    # the nearest sample is too far by no more than half a spacing across the distance
    error = np.hypot(np.abs(depth), np.abs(np.diff(half)).max() / 2) - np.abs(depth) + 1e-8
    assert np.all((nearest + depth <= error)[outside])
    assert np.all((nearest + depth >= -1e-12)[outside])
    inside = ~outside
    assert np.all(depth[inside] <= nearest[inside] + 1e-12)
    near = inside & (nearest < 0.3)
    assert near.sum() > 10
    assert np.all((nearest - depth <= error)[near])


def test_refusals() -> None:
    with pytest.raises(ValueError, match="fit"):
        RackTool(1, np.radians(30), 1, 0.25, 0.38, 0)
    with pytest.raises(ValueError, match="fit"):
        exact.half_tooth(gear(23, "30", "0", "0.38"))
    with pytest.raises(ValueError, match="pointed"):
        exact.half_tooth(gear(8, "20", "0.9", "0.38", tip="1.2"))
