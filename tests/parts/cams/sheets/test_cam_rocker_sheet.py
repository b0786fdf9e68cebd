"""The sheet of a flat rocker's cam: its joint diagram tells the least base circle of a convex cam, by brute force."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from exporters.documents.topics import sheet_of
from exporters.production.plan import plan_build
from geometry.cams.plane.disk import oscillating_cam
from parts.cams.disk_cam.part import CAM
from parts.scene.load import scene_from_toml

PART = """
[parts.cam]
kind = "cam"
follower = "flat"
swing_deg = 10.0
base_circle_radius = {base}
least_curvature_radius = {rho}
oscillating = {{ centre_distance = 100.0, face_offset = 8.0, sense = "{sense}" }}
phases = [
    {{ move = "rise", angle_deg = 120.0, law = "polynomial_345" }},
    {{ move = "return_", angle_deg = 120.0, law = "sine" }},
    {{ move = "dwell", angle_deg = 120.0 }},
]
[[exports]]
format = "sheet"
purpose = "cam"
"""


def scene(base: float = 40.0, rho: float = 5.0, sense: str = "against") -> Any:
    return scene_from_toml(PART.format(base=base, rho=rho, sense=sense).encode(), "t", "t")


def least_by_bisection(rho: float, sense: str) -> float:
    """The smallest base circle whose cam keeps the radius at 7 200 angles."""
    cam = CAM.thing(scene(sense=sense).parts["cam"], {})
    low, high = 5.0, 60.0
    for _ in range(40):
        middle = (low + high) / 2
        made = oscillating_cam(cam.motion, cam.kind, middle, centre_distance=100.0, face_offset=8.0,
                               sense=1 if sense == "against" else -1)  # fmt: skip
        fine = made.curvature_radius(np.linspace(0, 2 * math.pi, 7201)).min() >= rho
        low, high = (low, middle) if fine else (middle, high)
    return high


@pytest.mark.sampled(1)
@pytest.mark.parametrize("sense", ["against", "with"])
def test_the_diagram_tells_the_least_base_circle(sense: str) -> None:
    canvas = plan_build(scene(sense=sense), "t", [], []).sheets[0].canvas
    texts = [t.text for t in canvas.texts]
    least = least_by_bisection(5.0, sense)
    assert f"r0 = {least:.2f}" in texts
    assert f"r0 = {least_by_bisection(9.0, sense):.2f}" not in texts
    assert {"O", "C", "O1"} <= set(texts)
    layers = {s.layer for s in canvas.strokes}
    assert {"GAMMA_TANGENT", "HATCH", "CONSTRUCTION"} <= layers
    values = {s.name: s.value for s in sheet_of("cam", ("kind=cam", *keys(sense)))[0].steps()}
    assert values["least_prime_circle_radius"] == pytest.approx(least, abs=1e-4)


def keys(sense: str) -> list[str]:
    return ["follower=flat", "swing_deg=10", "base_circle_radius=40", "least_curvature_radius=5",
            "oscillating.centre_distance=100", "oscillating.face_offset=8", f"oscillating.sense={sense}",
            'phases=[{move="rise",angle_deg=120,law="polynomial_345"},{move="return_",angle_deg=120,law="sine"},'
            '{move="dwell",angle_deg=120}]']  # fmt: skip


def test_the_cams_own_axis_stands_in_the_region_only_where_it_keeps_the_radius() -> None:
    """The control: with a larger radius asked for than the cam has, its axis falls out of the region."""
    from parts.cams.sheets.picture import cam_picture
    from parts.cams.sheets.swing import swing_of

    cam = CAM.thing(scene().parts["cam"], {})
    has = float(cam.curvature_radius(np.linspace(0, 2 * math.pi, 7201)).min())
    for asked, inside in ((has - 0.1, True), (has + 0.1, False)):
        swing = swing_of(cam_picture(cam, 8, None, asked, "en"))
        assert swing is not None
        slack = min(((0j - foot) * normal.conjugate()).real for foot, normal in swing.planes)
        assert (slack > 0) is inside


@pytest.mark.heavy
def test_a_rollers_diagram_tells_the_smallest_cam_of_its_table() -> None:
    """Of a return that is steeper than the rise: kept both ways, where the diagram looked at the rise alone before."""
    text = PART.format(base=40.0, rho=0.0, sense="with").replace("face_offset = 8.0", "arm_length = 80.0")
    for old, new in (('"flat"', '"roller"\nfollower_radius = 5.0\nleast_transmission_angle_deg = 55.0'),
                     ('"return_", angle_deg = 120.0', '"return_", angle_deg = 60.0'),
                     ('"dwell", angle_deg = 120.0', '"dwell", angle_deg = 180.0')):  # fmt: skip
        text = text.replace(old, new)
    made = scene_from_toml(text.encode(), "t", "t")
    texts = {t.text for t in plan_build(made, "t", [], []).sheets[0].canvas.texts}
    # the least circle about the lowest roller centre that meets an axis at which tan nu is small enough all the turn
    motion = CAM.thing(made.parts["cam"], {}).motion
    angle = np.concatenate([np.linspace(p.start, p.end - 1e-9, 201) for p in motion.moving_pieces()])
    turn, rate = motion.value(angle), motion.value(angle, 1)

    def some(radius: float) -> bool:
        axes = 80 + radius * np.exp(1j * np.linspace(1e-3, math.pi, 361))
        psi = np.angle(axes)[:, None] + turn
        away = np.abs(axes)[:, None]
        slope = np.abs(80 * (1 - rate) - away * np.cos(psi)) / (away * np.sin(psi))
        return bool((slope.max(axis=1) <= math.tan(math.radians(35.0))).any())

    low, high = 1.0, 80.0
    for _ in range(24):
        middle = (low + high) / 2
        low, high = (low, middle) if some(middle) else (middle, high)
    (told,) = (float(t.removeprefix("r0d = ")) for t in texts if t.startswith("r0d = "))
    assert told == pytest.approx(high, rel=1e-3)
