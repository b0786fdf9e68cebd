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
    "LinkageCamSpec": {"swing_deg": "24.0", "phases": f"[{_PHASES}]", "follower_radius": "6.0"},
    "WedgeCamSpec": {"lift": "20.0", "phases": f"[{_TRAVEL}]", "follower_radius": "6.0"},
}
# where a key has no default, or one of its own in a kind of part
EXAMPLES = {
    # bores that a roller of 16 mm has walls for
    **{
        (table, "diameter"): "8.0"
        for table in ("RoundBoreTable", "KeywayTable", "FlatBoreTable", "DoubleFlatBoreTable")
    },
    ("KeywayTable", "width"): "2.0",
    ("KeywayTable", "depth"): "1.0",
    # a four-bar linkage; the other tables fit in its place, a slider with lift
    ("LinkageCamSpec", "coupler_length"): "43.0",
    ("LinkageCamSpec", "coupler_point"): "[6.0, 16.0]",
    ("DrivenRocker", "pivot"): "[91.0, 26.0]",
    ("DrivenRocker", "length"): "58.0",
    ("DrivenRocker", "start_angle_deg"): "167.0",
    ("DrivenSlider", "start"): "[25.0, 30.0]",
    ("GuidingRocker", "pivot"): "[62.0, 124.0]",
    ("GuidingRocker", "length"): "68.0",
    ("GuidingSlider", "through"): "[0.0, 60.0]",
    ("LinkageMemberSpec", "member"): '"coupler"',
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
# laws of one's own in place of a name, each with what it is
LAWS = (
    (
        '{ diagram = [{ shape = "half_sine", width = 1.0, peak = 1.0 }, '
        '{ shape = "half_sine", width = 1.0, peak = -1.0 }] }',
        "law by its acceleration diagram; shapes: constant, linear, half_sine, quarter_sine, quarter_cosine, "
        "half_cosine, trapezoid, points",
    ),
    (
        '{ diagram = [{ shape = "linear", width = 3.0, first = 0.0, last = 2.0 }, '
        '{ shape = "linear", width = 5.0, first = -2.0, last = 0.0 }], balance = true }',
        "balance scales what lies below the axis so that the diagram closes",
    ),
    (
        '{ first_half = [{ shape = "trapezoid", width = 1.0, ordinate = 1.0, up = 0.25 }], '
        'second_half = [{ shape = "half_sine", width = 1.0, peak = 1.0 }], first_share = 0.5 }',
        "acceleration and deceleration as two halves, both above the axis",
    ),
    (
        "{ conditions = [[0.0, 0, 0.0], [0.0, 1, 0.0], [0.0, 2, 0.0], [1.0, 0, 1.0], [1.0, 1, 0.0], [1.0, 2, 0.0]] }",
        "polynomial by conditions [u, order, value of that derivative]",
    ),
    ("{ poles = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0], degree = 5 }", "B-spline by its poles"),
    ('{ name = "modified_trapezoid", ramp = 0.125, reverse = false }', "named law with ramps of one's own"),
)
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
