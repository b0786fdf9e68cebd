"""The table ``[defaults]``: keys said once, for every part, assembly, mate, board and export that takes them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any

from msgspec import Struct

from geometry.base.errors import ParameterError
from parts.base.part_keys import MaterialKeys
from parts.base.refusal import SceneError, meant
from parts.base.registry import KINDS
from parts.base.schema import converted
from parts.keys.boards import BedSpec, BoardSpec
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES

Table = dict[str, Any]
# whether a table of ``[[exports]]`` takes a key with a value
Takes = Callable[[Table, str, object], bool]
# tables that say their kind, and others
_KINDS: dict[str, Mapping[str, Any]] = {"parts": KINDS, "assemblies": RECIPES, "mates": MATES}
_PLAIN: dict[str, type[Struct]] = {"boards": BoardSpec, "beds": BedSpec}
# keys of which a table has one
_EITHER = (
    ("bore_diameter", "bore"), ("bore_diameter", "centre_holes"), ("kerf", "offset"), ("lift", "swing_deg"),
    ("normal_backlash", "circumferential_backlash"), ("phases", "motion_table"), ("phases", "contour"),
    ("motion_table", "contour"), ("diameter_quotient", "lead_angle_deg"), ("tip_chamfer", "tip_rounding"),
    ("axis_ratio", "eccentricity"), ("centre_distance", "module"), ("centre_distance", "crank_radius"),
    ("profile_shift_coefficient", "working_centre_distance"), ("rounded_root", "cutter"), ("end_margin", "length"),
    ("width", "shaft_diameter"), ("height", "shaft_diameter"),
)  # fmt: skip
# keys that stand in another one of a table too
_WITHIN = {
    "density": "material", "lift": "motion_table", "swing_deg": "motion_table", "chain": "pitch",
    "pitch": "chain", "roller_diameter": "chain", "inner_width": "chain", "plate_height": "chain",
    "transverse_pitch": "chain", "strands": "chain",
}  # fmt: skip
# keys that a table has already in another form
INSTEAD: dict[str, set[str]] = {}
for _one, _other in (*_EITHER, *(pair[::-1] for pair in _EITHER), *_WITHIN.items()):
    INSTEAD.setdefault(_one, set()).add(_other)
# keys that say how thick a flat part is
_THICK = {"parts": ("face_width",), "assemblies": ("face_width", "plate_thickness")}
# keys that are not one for all
_OWN = {"kind", "first", "second", "of", "name", "title", "format", "purpose", "parts", "copies", "position"}


def filled_in(raw: Table, source: str, export_keys: type[Struct], takes: Takes) -> tuple[Table, dict[str, str]]:
    """The tables of a scene with its defaults where they have no key of their own; for each, where it has come from.

    Raises
    ------
    SceneError
        Nothing in the scene takes a key, or each table has its own.
    """
    tables = {key: value for key, value in raw.items() if key != "defaults"}
    origins: dict[str, str] = {}
    known: set[str] = set()
    used: set[str] = set()

    def filled(name: str, place: str, table: Table) -> Table:
        keys = _keys_of(name, table, export_keys)
        if keys is None:
            return table
        names, made = _names(keys), dict(table)
        known.update(names)
        for key, value in raw["defaults"].items():
            if key not in names or (name == "exports" and key not in table and not takes(made, key, value)):
                continue
            used.add(key)
            if not any(k in table for k in (key, *INSTEAD.get(key, ()))):
                made[key] = value
                origins[f"{place}.{key}"] = f"{place}: defaults.{key}"
        return made

    for name in [name for name in (*_KINDS, *_PLAIN, "exports") if name in raw]:
        if isinstance(raw[name], list):
            tables[name] = [filled(name, f"{name}[{k}]", table) for k, table in enumerate(raw[name], 1)]
        else:
            tables[name] = {key: filled(name, f"{name}.{key}", table) for key, table in raw[name].items()}
    for part, key in _idle(tables.get("parts", {}), source):
        if origins.pop(f"parts.{part}.{key}", None):
            del tables["parts"][part][key]
    for key, value in raw["defaults"].items():
        if key in _OWN:
            raise SceneError(source, f"defaults.{key}", value, "not_one_for_all")
        if key not in used:
            # of exports that have the key none takes it: laser files alone have a kerf
            others = known - {key}
            raise SceneError(
                source, f"defaults.{key}", value, "nothing_takes_it", meant(key, others), known=sorted(others)
            )
    return tables, origins


def _idle(parts: Mapping[str, Table], source: str) -> Iterator[tuple[str, str]]:
    """Parts, and keys that do nothing beside their other ones; of parts that are wrong the loader tells."""
    specs: dict[str, MaterialKeys] = {}
    for part, table in parts.items():
        if keys := _keys_of("parts", table, MaterialKeys):
            with suppress(SceneError):
                specs[part] = converted(table, keys, source, part)
    for part, spec in specs.items():
        with suppress(ParameterError):
            for refusal in KINDS[parts[part]["kind"]].idle(spec, specs):
                yield part, refusal.name


def as_thick_as_board(raw: Table) -> tuple[Table, dict[str, str]]:
    """The tables of a scene with one board: what does not say how thick it is, is as thick; and where that is said."""
    ((name, board),) = raw["boards"].items()
    tables, origins = dict(raw), dict[str, str]()
    if "thickness" not in board:
        return raw, origins

    def filled(of: str, place: str, table: Table) -> Table:
        made = dict(table)
        for key in _THICK[of]:
            if key in _names(_keys_of(of, table, BoardSpec) or BoardSpec) and key not in table:
                made[key] = board["thickness"]
                origins[f"{place}.{key}"] = f"boards.{name}.thickness"
        return made

    # what is no list is refused when the board is read
    wanted = named if isinstance(named := board.get("parts"), list) else []
    tables["parts"] = {
        key: filled("parts", f"parts.{key}", table) if not wanted or key in wanted else table
        for key, table in raw.get("parts", {}).items()
    }
    if not wanted and (rows := raw.get("assemblies")):
        tables["assemblies"] = [filled("assemblies", f"assemblies[{k}]", table) for k, table in enumerate(rows, 1)]
    return tables, origins


def default_names(export_keys: type[Struct]) -> list[str]:
    """Every key that may stand in ``[defaults]`` of some scene."""
    kinds: list[type[Struct]] = [kind.keys for found in _KINDS.values() for kind in found.values()]
    return sorted({name for keys in (*kinds, *_PLAIN.values(), export_keys) for name in _names(keys)})


def defaults_take(name: str, raw: Table, export_keys: type[Struct]) -> bool:
    """Whether some table of a scene would take a key of its ``[defaults]``; the scene may be wrong in any way."""
    for table in (*_KINDS, *_PLAIN, "exports"):
        held = raw.get(table)
        rows = held.values() if isinstance(held, dict) else held if isinstance(held, list) else ()
        for row in rows:
            keys = _keys_of(table, row, export_keys) if isinstance(row, dict) else None
            if keys is not None and name in _names(keys):
                return True
    return False


def _names(keys: type[Struct]) -> set[str]:
    return set(keys.__struct_encode_fields__) - _OWN


def _keys_of(name: str, table: Table, export_keys: type[Struct]) -> type[Struct] | None:
    """The keys of a table; None of one whose kind there is not, of which the loader tells."""
    if name not in _KINDS:
        return _PLAIN.get(name, export_keys)
    kind = table.get("kind")
    keys: type[Struct] | None = _KINDS[name][kind].keys if isinstance(kind, str) and kind in _KINDS[name] else None
    return keys
