"""``higherpair new KIND``: a commented scene to start from, every key with unit, range and default."""

from __future__ import annotations

from typing import get_args

import msgspec
from msgspec import Struct

from parts.scene import KINDS, ExportSpec, SceneInfo
from parts.schema import describe_type

# the keys without a default need a value to start from
_STARTING_VALUES = {"module": "2.0", "number_of_teeth": "23", "format": '"dxf"', "depth_coefficient": "0.02"}


def new_scene(kind: str) -> str:
    """The text of a scene with one part of a kind."""
    spec = KINDS[kind][0]
    lines = [
        "# A scene of higherpair: build it with  higherpair build THIS_FILE.toml",
        "# Lines that begin with # are defaults; remove the # to change them. Lengths in mm, angles in degrees.",
        "",
        "[scene]",
        *_keys(SceneInfo),
        "",
        "[parts.gear]",
        f'kind = "{kind}"',
        *_keys(spec),
        "",
        "[[exports]]",
        *_keys(ExportSpec),
        "",
        "[[exports]]",
        'format = "svg"',
        "",
        "[[exports]]",
        'format = "stl"',
    ]
    return "\n".join(lines) + "\n"


def _keys(owner: type[Struct]) -> list[str]:
    lines = []
    for field in msgspec.structs.fields(owner):
        name, text = field.encode_name, describe_type(field.type)
        if field.required:
            lines.append(_line(f"{name} = {_STARTING_VALUES[name]}", text))
        elif (table := _table_of(field.type)) is not None and field.default is None:
            inner = ", ".join(f"{f.encode_name} = {_start(f)}" for f in msgspec.structs.fields(table) if _start(f))
            lines.append(_line(f"# {name} = {{ {inner} }}", text))
        else:
            lines.append(_line(f"# {name} = {_toml(field.default)}", text))
    return lines


def _line(code: str, text: str) -> str:
    return f"{code:<44} # {text}" if text else code


def _start(field: msgspec.structs.FieldInfo) -> str:
    return _STARTING_VALUES[field.encode_name] if field.required else _toml(field.default)


def _table_of(kind: object) -> type[Struct] | None:
    return next((a for a in get_args(kind) if isinstance(a, type) and issubclass(a, Struct)), None)


def _toml(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else str(value)
