"""``higherpair new KIND``: a commented scene to start from, every key with unit, range and default."""

from __future__ import annotations

from typing import get_args

import msgspec
from msgspec import Struct

from exporters import new_examples
from exporters.new_several import several
from parts.kinds import KINDS
from parts.mates import JOINS, MATES
from parts.scene import ExportSpec, SceneInfo
from parts.schema import describe_type

# values to start from, for keys that have no default or whose default depends on others
_EXAMPLES = {
    "module": "2.0",
    "number_of_teeth": "23",
    "format": '"dxf"',
    "depth_coefficient": "0.02",
    "tip_diameter": "50.0",
    "tip_radius_coefficient": "0.38",
    "material": '"plywood 3 mm"',
    "colour": '"#c08040"',
    "first": '"gear"',
    "second": '"wheel"',
    "working_centre_distance": "60.5",
    "normal_backlash": "0.1",
    "purpose": '"laser"',
    "tolerance": "0.005",
    "name": '"laser"',
    "parts": '["gear"]',
    "thickness": "3.0",
    "rim_diameter": "36.0",
    "density": "0.65",
    "diameter": "12.0",
    "flat": "7.0",
    "across_flats": "7.0",
    "width": "4.0",
    "depth": "1.8",
    "corner_radius": "0.16",
    "count": "5",
    "pitch_circle_diameter": "28.0",
    "inner_diameter": "20.0",
    "outer_diameter": "36.0",
    "body_height": "6.0",
    "follower": '"roller"',
    "motion_table": "[[0.0, 0.0], [120.0, 10.0], [240.0, 5.0]]",
    "plate_diameter": "60.0",
    "base_circle_radius": "30.0",
    "least_transmission_angle_deg": "60.0",
    "centre_distance": "90.0",
    "form": '"groove"',
    "roller_diameter": "10.0",
    "groove_depth": "8.0",
    "length": "60.0",
    "end_margin": "8.0",
    "pivot_offset": "40.0",
    "start_angle_deg": "-10.0",
    "height": "0.0",
    "number_of_lobes": "11",
    "number_of_pins": "12",
    "pin_circle_diameter": "80.0",
    "pin_diameter": "8.0",
    "eccentricity": "2.5",
    "centrode": '"oval"',
    "mate_number_of_teeth": "30",
    "axis_ratio": "1.5",
    "lobes": "2",
    "pin_length": "10.0",
    "ratio_cosines": "[0.3]",
    "ratio_sines": "[0.1]",
}
_PHASES = (
    '{ move = "rise", angle_deg = 120.0, law = "sine" }',
    '{ move = "dwell", angle_deg = 60.0 }',
    '{ move = "return_", angle_deg = 120.0, law = "polynomial_345" }',
    '{ move = "dwell", angle_deg = 60.0 }',
)
# holes and slots of flat bodies
_AT_HOLE = "[{ at = [0.0, 20.0], diameter = 3.0 }]"
_AT_SLOT = "[{ start = [0.0, 28.0], end = [0.0, 36.0], width = 3.0 }]"
# keys with a default that a scene to start from sets nevertheless
_SET = {
    "CamSpec": {
        "lift": "20.0",
        "phases": f"[{', '.join(_PHASES)}]",
        "follower_radius": "8.0",
        "base_circle_radius": "30.0",
    },
    **new_examples.SET,
    "BarrelCamSpec": {"lift": "20.0", "phases": f"[{', '.join(_PHASES)}]"},
    "NoncircularGearSpec": {"module": "2.0", "axis_ratio": "1.5"},
}
# where the same key means another size
_TABLE_EXAMPLES = {
    ("HolesTable", "diameter"): "6.0",
    ("HubTable", "diameter"): "14.0",
    ("NoncircularGearSpec", "number_of_teeth"): "30",
    ("RingGearSpec", "number_of_teeth"): "60",
    ("RingGearSpec", "tip_diameter"): "117.0",
    ("RingGearSpec", "outer_diameter"): "140.0",
    ("BarrelCamSpec", "outer_diameter"): "60.0",
    ("BarrelCamSpec", "cone_angle_deg"): "20.0",
    ("SwingingTable", "arm_length"): "40.0",
    ("RimHolesTable", "diameter"): "6.0",
    ("RimHolesTable", "pitch_circle_diameter"): "140.0",
    ("RackHolesTable", "diameter"): "2.5",
    ("RackHolesTable", "depth"): "2.5",
    ("FollowerSpec", "end"): '"roller"',
    ("FollowerArmSpec", "end"): '"roller"',
    ("FollowerArmSpec", "arm_length"): "60.0",
    ("RollerSpec", "diameter"): "16.0",
    ("PlateSpec", "width"): "60.0",
    ("PlateSpec", "height"): "90.0",
    **{(owner, "holes"): _AT_HOLE for owner in ("PlateSpec", "FollowerSpec")},
    **{(owner, "slots"): _AT_SLOT for owner in ("PlateSpec", "FollowerSpec")},
    ("FollowerArmSpec", "holes"): "[{ at = [20.0, 0.0], diameter = 3.0 }]",
    ("FollowerArmSpec", "slots"): "[{ start = [28.0, 0.0], end = [36.0, 0.0], width = 3.0 }]",
    **new_examples.EXAMPLES,
    ("NoncircularGearSpec", "eccentricity"): "0.2",
    ("OutputHolesTable", "count"): "6",
    ("OutputHolesTable", "pitch_circle_diameter"): "44.0",
    ("OutputHolesTable", "pin_diameter"): "6.0",
    ("OutputPlateSpec", "number_of_pins"): "6",
    ("OutputPlateSpec", "pin_circle_diameter"): "44.0",
    ("OutputPlateSpec", "pin_diameter"): "6.0",
    ("OutputPlateSpec", "outer_diameter"): "60.0",
    ("EccentricSpec", "diameter"): "22.0",
    ("PinSpec", "diameter"): "8.0",
    ("PinRingSpec", "inner_diameter"): "83.0",
    ("PinRingSpec", "outer_diameter"): "110.0",
    ("LanternWheelSpec", "outer_diameter"): "100.0",
    ("LanternGearSpec", "number_of_teeth"): "30",
    ("LanternGearSpec", "tip_diameter"): "220.0",
}

# keys that only sheets have: they stand in the part for several parts
_SHEET_KEYS = ("mate", "rack_step", "intervals", "speed_rpm", "title_block")


def new_scene(kind: str) -> str:
    """The text of a scene with one part of a kind."""
    spec = KINDS[kind][0]
    lines = [
        "# A scene of higherpair: build it with  higherpair build THIS_FILE.toml",
        "# Lines that begin with # show defaults or examples; remove the # to set them.",
        "# Lengths in mm, angles in degrees.",
        "",
        "[scene]",
        *_keys(SceneInfo),
        "",
        *new_examples.OWNERS.get(kind, ()),
        "[parts.gear]",
        f'kind = "{kind}"',
        *_keys(spec),
        "",
        "[[exports]]",
        *_keys(ExportSpec, without=_SHEET_KEYS),
        "",
        "[[exports]]",
        'format = "svg"',
        "",
        "[[exports]]",
        'format = "stl"',
        *several(kind),
    ]
    return "\n".join(lines) + "\n"


def new_mate(kind: str) -> str:
    """The table of a kind of mate, to be put into a scene."""
    joined = JOINS[kind]
    who = "any two instances" if joined is None else " or ".join(f"{a} and {b}" for a, b in joined)
    lines = [
        f"# {(MATES[kind].__doc__ or '').splitlines()[0]}",
        "# A table to be added to a scene that has both parts; it is no scene by itself.",
        f"# Joins {who}; see higherpair new KIND for their keys.",
    ]
    return "\n".join([*lines, "[[mates]]", f'kind = "{kind}"', *_keys(MATES[kind])]) + "\n"


def _keys(owner: type[Struct], without: tuple[str, ...] = ()) -> list[str]:
    """One line a key; keys with a default stand commented out."""
    lines = []
    for field in (f for f in msgspec.structs.fields(owner) if f.encode_name not in without):
        value = _SET.get(owner.__name__, {}).get(field.encode_name)
        shown = value or _TABLE_EXAMPLES.get((owner.__name__, field.encode_name)) or _value(field)
        code = f"{field.encode_name} = {shown}"
        lines.append(_line(code if field.required or value else f"# {code}", describe_type(field.type)))
        if field.encode_name == "phases" and value:
            for law, meant in new_examples.LAWS:
                lines.append("# " + code.replace('"sine"', law, 1) + f"  # ... or this: {meant}")
        tables = _tables_of(field)
        for table in tables[1:] if field.required or field.default is None else tables:
            meant = describe_type(table).removeprefix("table: ")
            lines.append(f"# {field.encode_name} = {_table_value(table)}  # ... or this: {meant}")
    return lines


def _line(code: str, text: str) -> str:
    return f"{code:<44} # {text}" if text else code


def _value(field: msgspec.structs.FieldInfo) -> str:
    """The default of a key as TOML, or an example where it has none."""
    if field.required or field.default is None:
        tables = _tables_of(field)
        return _table_value(tables[0]) if tables else _EXAMPLES[field.encode_name]
    if isinstance(field.default, bool):
        return str(field.default).lower()
    if isinstance(field.default, tuple):
        return str(list(field.default))
    return f'"{field.default}"' if isinstance(field.default, str) else str(field.default)


def _tables_of(field: msgspec.structs.FieldInfo) -> list[type[Struct]]:
    """The kinds of table that a key takes."""
    return [a for a in get_args(field.type) if isinstance(a, type) and issubclass(a, Struct)]


def _table_value(table: type[Struct]) -> str:
    config = table.__struct_config__
    tag = [f'{config.tag_field} = "{config.tag}"'] if config.tag_field else []
    inner = (
        f"{f.encode_name} = {_TABLE_EXAMPLES.get((table.__name__, f.encode_name)) or _value(f)}"
        for f in msgspec.structs.fields(table)
    )
    return "{ " + ", ".join([*tag, *inner]) + " }"
