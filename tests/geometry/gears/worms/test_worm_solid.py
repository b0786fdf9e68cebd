"""A worm as faces: closed, its volume that of the exact integrals, in files as our reader and the kernel have them."""

from __future__ import annotations

import math
import re
from collections import Counter
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from exporters.formats.read_step import read_step
from exporters.verification.faces import verify_faced_solid
from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.worms.body import Step, WormBody, worm_moments
from geometry.gears.worms.faces import faced_worm, worm_solid
from geometry.gears.worms.thread import thread_of
from geometry.gears.worms.worm import Worm
from geometry.solids.bores import KeywayBore
from geometry.solids.extent import extent
from geometry.solids.face_moments import face_moments
from geometry.solids.faced import FacedSolid
from geometry.solids.faces import Solid
from parts.solids.kernel import solids_of
from parts.solids.step_text import StepForm, StepPart, step_text

SHAFT = (Step(30.0, 10.0), Step(20.0, 30.0, 1.0))
KEYED = KeywayBore(12.0, 4.0, 1.8, 0.2, 1, 0.7).profile(0.0)
STEEP = math.radians(20)


def body_of(worm: Worm, length: float, rounding: float = 0.3, angle: float = STEEP, **more: object) -> WormBody:
    return WormBody(thread_of(worm.checked(), rounding), length, angle, **more).checked()  # type: ignore[arg-type]


BODIES = {
    "thesis": body_of(Worm(5.0, 1, 10.0), 40.0, below=SHAFT),
    "left with a base above the root": body_of(Worm(5.0, 4, 8.0, hand="left"), 40.0, 0.2, above=(Step(28.0, 9.0),)),
    "plane ends and a keyway": body_of(Worm(5.0, 2, 10.0, "ZA", hand="left"), 40.0, 0.0, 0.0, bore=KEYED),
    "ten starts": body_of(Worm(3.0, 10, 30.0, "ZN2"), 30.0, below=SHAFT, above=SHAFT),
    "no whole step between the ends": body_of(Worm(1.0, 4, 43.0, "ZA"), 8.0, 0.0, math.radians(45)),
    "blunt": body_of(Worm(2.0, 2, 10.0, "ZN1", hand="left"), 20.0, 0.1, 0.0, below=(Step(12.0, 4.0),), ending="blunt"),
    "run out into a thicker shaft": body_of(
        Worm(2.0, 1, 10.0), 16.0, 0.2, 0.0, above=(Step(30.0, 4.0, 1.0),), ending="run_out", run_out=math.pi / 2
    ),
    "run out of four starts, without fillets": body_of(
        Worm(2.0, 4, 10.0, "ZA", hand="left", fillet_coefficient=0.0), 16.0, 0.0, 0.0, ending="run_out", run_out=0.6
    ),
    "slim": body_of(Worm(2.0, 1, 4.0, "ZA"), 16.0, 0.0, math.radians(45)),
}


@cache
def finely_made(name: str) -> FacedSolid:
    return worm_solid(BODIES[name], 1e-4)


@cache
def step_of(name: str) -> str:
    return step_text(StepPart("worm", finely_made(name).geometry), StepForm(10))


def assert_closed(solid: Solid) -> None:
    """Every edge is run once each way."""
    uses: Counter[tuple[int, bool]] = Counter()
    for faces in solid.faces:
        for edges, ways in faces.loops:
            for row in edges:
                uses.update(zip(row.tolist(), np.broadcast_to(ways, row.shape).tolist(), strict=True))
    count = sum(len(bundle.start) for bundle in solid.edges)
    assert uses == Counter({(edge, way): 1 for edge in range(count) for way in (True, False)})


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["blunt", *(name for name in BODIES if name != "blunt")])
def test_faces_hold_what_exact_integrals_say(name: str) -> None:
    """Volume, centre and inertia of the faces, splines, planes and cones, beside those of the thread's sections."""
    made = worm_solid(BODIES[name], 1e-2)
    assert_closed(made.geometry)
    found, exact = face_moments(made.geometry), worm_moments(BODIES[name])
    assert found.volume == pytest.approx(exact.volume, rel=1e-6)
    assert found.centre == pytest.approx(exact.centre, abs=1e-5)
    assert found.inertia == pytest.approx(exact.inertia, abs=1e-6 * float(np.abs(exact.inertia).max()))
    extents = extent(made.geometry)
    envelope = np.array(BODIES[name].envelope())
    assert [extents.low[2], extents.high[2]] == pytest.approx([envelope[:, 0].min(), envelope[:, 0].max()], abs=1e-6)
    assert extents.radius == pytest.approx(envelope[:, 1].max(), abs=1e-6)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", BODIES)
def test_the_faces_of_a_worm_are_closed_and_their_files_within_their_bound(name: str, tmp_path: Path) -> None:
    body = BODIES[name]
    made = finely_made(name)
    assert_closed(made.geometry)
    text = step_of(name)
    file = tmp_path / "worm.step"
    file.write_text(text)
    verdict = verify_faced_solid(read_step(file), faced_worm(body), made.max_error + 1e-9, 1e-4)
    assert verdict.failures == ()
    assert verdict.measured["max_deviation"] > 0
    assert abs(verdict.measured["volume_error"]) < 1e-9
    worm, cones = body.thread.worm, text.count("=CONICAL_SURFACE(")
    assert text.count("=TOROIDAL_SURFACE(") == 0
    # cylinders and cones are themselves
    assert cones >= (2 if body.end_angle else 0)
    radii = [float(radius) for radius in re.findall(r"=CYLINDRICAL_SURFACE\('',#\d+,([\d.E+-]+)\)", text)]
    assert min(abs(radius - worm.tip_radius) for radius in radii) < 1e-9


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    "name", ["left with a base above the root", "plane ends and a keyway", "run out into a thicker shaft", "blunt"]
)
def test_the_kernel_finds_the_worm_valid_and_of_its_volume(name: str) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    body = BODIES[name]
    (solid,) = solids_of(step_of(name))
    assert BRepCheck_Analyzer(solid).IsValid()
    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, found, 1e-9)
    assert found.Mass() == pytest.approx(worm_moments(body).volume, rel=1e-8)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("starts", [1, 2, 3])
def test_moments_are_those_of_the_thread_cut_into_cells(starts: int) -> None:
    worm = Worm(5.0, starts, 8.0, "ZA", hand="left", fillet_coefficient=0.0)
    body = body_of(worm, 40.0, 0.0, below=(Step(20.0, 7.0),))
    # the thread by its definition in cells of r, angle and z; the rest are cylinders
    r = np.linspace(worm.root_radius, worm.tip_radius, 41)
    r = (r[1:] + r[:-1]) / 2
    z = (np.arange(500) + 0.5) / 500 * 40.0 - 20.0
    angle = (np.arange(120) + 0.5) / 120 * math.tau
    ring, height = np.meshgrid(r, z, indexing="ij")
    inside = np.abs(height) < 20.0 - (ring - worm.root_radius) * math.tan(STEEP)
    share = math.pi * worm.module
    total = np.zeros(5)
    for phi in angle.tolist():
        away = height + worm.parameter * phi
        away = np.abs((away + share / 2) % share - share / 2)
        cell = (inside & (away < worm.half_thickness(ring))) * ring
        x, y = ring * math.cos(phi), ring * math.sin(phi)
        total += [float((cell * f).sum()) for f in (1.0, x, x * x, height**2, y * height)]
    total *= (r[1] - r[0]) * (z[1] - z[0]) * (angle[1] - angle[0])
    root, shaft = worm.root_radius, 10.0
    core = math.pi * (root**2 * 40.0 + shaft**2 * 7.0)
    found = worm_moments(body)
    volume = total[0] + core
    assert found.volume == pytest.approx(volume, rel=1e-3)
    assert found.centre[0] * volume == pytest.approx(total[1], abs=1e-3 * volume)
    assert found.centre[2] * volume == pytest.approx(-math.pi * shaft**2 * 7.0 * 23.5, rel=1e-3)
    xx = total[2] + math.pi * (root**4 * 40.0 + shaft**4 * 7.0) / 4
    zz = total[3] + math.pi * (root**2 * 40.0**3 / 12 + shaft**2 * (27.0**3 - 20.0**3) / 3)
    assert found.inertia[1, 1] == pytest.approx(xx + zz, rel=2e-3)
    assert found.inertia[1, 2] == pytest.approx(-total[4], abs=2e-3 * zz)


@pytest.mark.parametrize("name", ["blunt", "run out into a thicker shaft"])
def test_thread_ends_are_where_the_tool_leaves_them(name: str) -> None:
    body = BODIES[name]
    worm, band = body.thread.worm, body.band
    assert band is not None
    # the solid by its definition, at random places about the thread: inside the section that stands at their angle
    rng = np.random.default_rng(4)
    z = rng.uniform(-band.height(), band.height(), 30_000)
    r = rng.uniform(worm.root_radius, worm.tip_radius, len(z))
    phi = rng.uniform(-math.pi, math.pi, len(z))
    pitch, p = math.pi * worm.module, worm.parameter
    inside = np.zeros(len(z), dtype=bool)
    lines = [line for _, line in body.thread.lines]
    profile = np.concatenate([line.point(np.linspace(*line.domain, 400)) for line in lines])
    if name == "blunt":
        for k in range(-30, 31):
            angle = worm.sign * phi + math.tau * k / worm.number_of_starts
            # thread by thread, whole up to the angle at which its foot is 0.1 modules from the end
            last = (body.length / 2 - 0.1 * worm.module - body.thread.root_half) / p
            inside |= (np.abs(angle) < last) & (np.abs(z - p * angle) < np.interp(r, profile.real, profile.imag))
        # what drawings show of it; before, crests as long as the foot
        crest = max(z for z, r in body.envelope() if r == worm.tip_radius)
        high = np.abs(z[inside & (r > worm.tip_radius - 0.1)]).max()
        assert crest - 0.5 < high < crest
    else:
        inside[:] = True
        for k in range(-30, 31):
            angle = worm.sign * phi + math.tau * k / worm.number_of_starts
            away = np.abs(angle + math.pi / worm.number_of_starts) - body.length / 2 / p
            lifted = np.maximum(away, 0.0) / body.run_out * (worm.tip_radius - worm.root_radius)
            gap = pitch / 2 - np.interp(r - lifted, profile.real, profile.imag)
            inside &= ~(
                (np.abs(z - p * angle - pitch / 2) < gap) & (r - lifted > worm.root_radius) & (away < body.run_out)
            )
    shell = math.pi * (worm.tip_radius**2 - worm.root_radius**2) * 2 * band.height()
    # r is drawn evenly
    share = float(np.mean(inside * r)) / float(np.mean(r))
    added = worm_moments(replace(body, above=(), below=())).volume - math.pi * worm.root_radius**2 * 2 * band.height()
    assert added / shell == pytest.approx(share, abs=8e-3)


def test_a_file_whose_tool_leaves_at_another_angle_is_caught(tmp_path: Path) -> None:
    name = "run out into a thicker shaft"
    body, file = BODIES[name], tmp_path / "worm.step"
    file.write_text(step_of(name))
    held = verify_faced_solid(read_step(file), faced_worm(replace(body, run_out=body.run_out + 0.01)), 1e-4, 1e-4)
    assert any("deviates" in failure for failure in held.failures)


def test_a_thread_shorter_than_its_ends_is_refused_with_the_least_that_works() -> None:
    body = BODIES["thesis"]
    with pytest.raises(ParameterError) as caught:
        replace(body, length=10.0).checked()
    offered = caught.value.nearest
    assert offered is not None
    assert isinstance(offered.value, float)
    least = replace(body, length=offered.value).checked()
    assert worm_solid(least, 1e-3).max_error < 1e-6
