"""Scenes of positive-drive cams as text."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

from parts.base.part import Part
from parts.scene.load import make_parts, scene_from_toml

Keys = dict[str, Any]
PHASES = [
    {"move": "rise", "angle_deg": 120.0, "law": "sine"},
    {"move": "dwell", "angle_deg": 40.0},
    {"move": "return_", "angle_deg": 130.0, "law": "polynomial_345"},
    {"move": "dwell", "angle_deg": 70.0},
]
ROLLER: Keys = {"kind": "cam", "follower": "roller", "lift": 20.0, "phases": PHASES, "follower_radius": 8.0,
                "base_circle_radius": 35.0, "bore_diameter": 12.0}  # fmt: skip
SWING: Keys = {"centre_distance": 95.0, "arm_length": 80.0}
GROOVE: Keys = {k: v for k, v in ROLLER.items() if k != "follower"} | {
    "kind": "groove_cam", "groove_depth": 5.0, "roller_clearance": 0.1, "follower_offset": 5.0}  # fmt: skip
GROOVES: dict[str, Keys] = {
    "translating": GROOVE,
    "against": GROOVE | {"lift": 0.0, "swing_deg": 18.0, "follower_offset": 0.0, "oscillating": SWING},
    "with": GROOVE | {"lift": 0.0, "swing_deg": 18.0, "follower_offset": 0.0,
                      "oscillating": SWING | {"sense": "with"}},
}  # fmt: skip


def value(x: Any) -> str:
    """A value as TOML, tables in lists too."""
    if isinstance(x, list):
        return f"[{', '.join(map(value, x))}]"
    if isinstance(x, dict):
        return "{ " + ", ".join(f"{k} = {value(v)}" for k, v in x.items()) + " }"
    return json.dumps(x)


def scene(parts: dict[str, Keys], *formats: str) -> str:
    """A scene of parts and exports: formats, or lines of an export."""
    lines: list[str] = []
    for name, keys in parts.items():
        lines += [f"[parts.{name}]", *(f"{k} = {value(v)}" for k, v in keys.items())]
    for export in formats or ("dxf",):
        lines += ["[[exports]]", export if "=" in export else f'format = "{export}"']
    return "\n".join([*lines, ""])


def parts_of(parts: dict[str, Keys]) -> dict[str, Part]:
    """The parts of a scene, made once."""
    return dict(_made(scene(parts)))


@cache
def _made(text: str) -> dict[str, Part]:
    return make_parts(scene_from_toml(text.encode(), "s.toml", "s"), "s.toml")[0]


def without(keys: Keys, *names: str) -> Keys:
    """Keys without some."""
    return {k: v for k, v in keys.items() if k not in names}
