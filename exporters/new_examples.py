"""Values from which ``higherpair new`` starts positive-drive and sliding cams, and the parts that these belong to."""

from __future__ import annotations

_PHASES = (
    '{ move = "rise", angle_deg = 120.0, law = "sine" }, { move = "dwell", angle_deg = 60.0 }, '
    '{ move = "return_", angle_deg = 120.0, law = "sine" }, { move = "dwell", angle_deg = 60.0 }'
)
_TRAVEL = '{ move = "rise", travel = 60.0, law = "sine" }, { move = "dwell", travel = 20.0 }'
# keys with a default that a scene to start from sets nevertheless
SET = {
    "GrooveCamSpec": {"lift": "20.0", "phases": f"[{_PHASES}]", "base_circle_radius": "30.0"},
    "WedgeCamSpec": {"lift": "20.0", "phases": f"[{_TRAVEL}]", "follower_radius": "6.0"},
}
# where a key has no default, or one of its own in a kind of part
EXAMPLES = {
    ("GrooveCamSpec", "follower_radius"): "8.0",
    ("GrooveCamSpec", "groove_depth"): "5.0",
    ("GrooveCamSpec", "outer_diameter"): "160.0",
    ("GroovePieceSpec", "of"): '"source"',
    ("GroovePieceSpec", "piece"): '"core"',
    ("ConjugateCamSpec", "of"): '"source"',
    ("ConjugateCamSpec", "roller_distance"): "96.0",
    ("ConjugateCamSpec", "roller_angle_deg"): "300.0",
    ("ConjugateCamSpec", "follower_radius"): "7.0",
    ("ConjugateCamSpec", "arm_length"): "80.0",
    ("ConjugateCamSpec", "face_width"): "8.0",
    ("ConjugateCamSpec", "bore_diameter"): "12.0",
    ("YokeFrameSpec", "of"): '"source"',
    ("WedgeCamSpec", "base_height"): "15.0",
    ("WedgeArmTable", "arm_length"): "80.0",
    ("WedgeArmTable", "pivot_height"): "50.0",
    ("WedgeHoleTable", "diameter"): "5.0",
    ("WedgeHoleTable", "x"): "20.0",
    ("WedgeHoleTable", "y"): "8.0",
    ("TimingMarkTable", "diameter"): "3.0",
    ("TimingMarkTable", "distance"): "22.0",
}
_CAM = (
    "# the cam that the part below belongs to",
    "[parts.source]",
    'kind = "cam"',
    'follower = "roller"',
    "follower_radius = 8.0",
    "lift = 20.0",
    "base_circle_radius = 30.0",
    f"phases = [{_PHASES}]",
    "bore_diameter = 12.0",
    "",
)
_GROOVE = (*(line.replace('"cam"', '"groove_cam"') for line in _CAM if not line.startswith(("follower =", "bore"))),)
# lines of the part that a kind of part is made from
OWNERS: dict[str, tuple[str, ...]] = {
    "groove_piece": (*_GROOVE[:-1], "groove_depth = 5.0", ""),
    "conjugate_cam": _CAM,
    "yoke_frame": _CAM,
}
