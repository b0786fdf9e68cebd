"""Scene files: read, validated key by key, every refusal with place, value and remedy."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import msgspec
from msgspec import Struct

from geometry.base.errors import GeometryError, Nearest, ParameterError
from parts.base.content import NotAFileError, content
from parts.base.materials import check_material
from parts.base.part import Part
from parts.base.refusal import REMOVED, SceneError, meant, placed
from parts.base.registry import KINDS
from parts.base.schema import as_written, converted, plain_numbers, tried, value_at, without_none
from parts.base.texts import Message
from parts.keys.base import DEVICE_NAMES, IDENTIFIER
from parts.keys.boards import PURPOSES_LAID, BedSpec, BoardSpec, LaidKeys, check_laid, check_parts
from parts.keys.sheet import check_sheet_keys
from parts.scene.files import MOST_BYTES, built_in_scenes, tables_of, text_of
from parts.scene.formats import ASSEMBLY_FORMATS, FORMATS, Form, tolerances_of
from parts.scene.instances import (
    DriveSpec,
    Group,
    InstanceSpec,
    InstanceTable,
    check_instance,
    drive_spec,
    instance_specs,
    members,
)
from parts.scene.kinds import mate_kind, part_kind
from parts.scene.language import in_language
from parts.scene.scene_file import ChecksSpec, ExportSpec, SceneFile, SceneInfo, default_export
from parts.scene.steps import StepSpec, step_specs
from parts.scene.told_files import has_files, with_files

if TYPE_CHECKING:
    from parts.base.mate import MateKeys, Mating
    from parts.base.part_keys import MaterialKeys


L = TypeVar("L", bound=LaidKeys)


@contextmanager
def in_keys_of_file(origins: Mapping[str, str]) -> Iterator[None]:
    """Refusals of what was told out are told at the place that the file has."""
    try:
        yield
    except SceneError as refusal:
        there = refusal.at(_in_file(refusal.key, origins))
        row, _, key = refusal.key.rpartition(".")
        if key == "number" and (more := _other_members(row, origins)):
            there.offer(partial(_with_room, refusal, more))
        raise there from refusal


def _other_members(row: str, origins: Mapping[str, str]) -> int:
    """How many mates more a mate of a group of instances was told out into beside this one."""
    return sum(place == origins.get(row) for there, place in origins.items() if there.startswith("mates[")) - 1


def _with_room(refusal: SceneError, more: int) -> Nearest | None:
    """The greatest seat of a group's first member that leaves seats for all, which are counted on from it."""
    found = refusal.nearest
    if found is None or not isinstance(found.value, int):
        return found
    return Nearest(found.value - more, found.side) if found.value > more else None


def _in_file(key: str, origins: Mapping[str, str]) -> str:
    """A key where the file has it; of two, the one of a part, where that has come from somewhere."""
    first, _, rest = key.partition(": ")
    for told in (rest, first):
        head = next((h for h in _heads(told) if h in origins), "")
        if head:
            there = origins[head] + told.removeprefix(head)
            return there if told is rest or not rest else f"{there}: {rest}"
    return key


def _heads(key: str) -> Iterator[str]:
    """A key, and all that it belongs to, the nearest first."""
    while key:
        yield key
        key = key[: max(key.rfind("."), key.rfind("["), 0)]


def load_scene(address: str, language: str | None = None) -> SceneFile:
    """A scene by the name of a built-in one or by the path of a TOML file, in its own ``language`` or this one.

    Raises
    ------
    SceneError
        With the key, its value and what is allowed.
    """
    built_in = built_in_scenes()
    path = Path(address)
    try:
        if address in built_in and not path.is_file():
            path = built_in[address]
        folder = not address or path.is_dir()
        raw_bytes = b"" if folder else content(path, MOST_BYTES)
    except NotAFileError:
        raise SceneError(address, "", None, "not_a_file", None, most=MOST_BYTES) from None
    except FileNotFoundError:
        if _is_kind(address):
            raise SceneError(address, "", None, "kind_no_scene", None, kind=address) from None
        found = _meant_scene(path, address, built_in)
        raise SceneError(address, "", None, "no_such_scene", found, known=list(built_in)) from None
    except OSError as error:
        raise SceneError(address, "", None, "unreadable", None, why=Message(error.strerror or str(error))) from None
    except ValueError as error:
        raise SceneError(repr(address), "", None, "not_a_path", None, why=str(error)) from None
    if folder:
        raise SceneError(address, "", None, "a_folder" if address else "no_scene", None, known=list(built_in))
    # a text beside a scene of its name has a folder of its own
    twin = path.suffix.lower() != ".toml" and path.with_suffix(".toml").is_file()
    name = (path.name if twin else path.stem).encode("utf-8", "replace").decode()
    if not name.strip(". ") or not name.isprintable():
        raise SceneError(address, "", None, "nameless_file")
    if name.rstrip(". ") != name:
        raise SceneError(address, "", None, "name_ends_in_dot")
    if name.partition(".")[0].lower() in DEVICE_NAMES:
        raise SceneError(address, "", None, "device_name")
    return scene_from_toml(raw_bytes, str(path), name, language)


def _is_kind(address: str) -> bool:
    """Whether a kind of part, mate or assembly is asked for as a scene."""
    from parts.mates.registry import MATES
    from parts.recipes.registry import RECIPES

    return address in (*KINDS, *MATES, *RECIPES)


def _meant_scene(path: Path, address: str, built_in: Collection[str]) -> Nearest | None:
    """The file without whose ending it was typed, one of nearly that name beside it, or a built-in scene."""
    if whole := next((name for name in (f"{address}.toml", f"{address}.txt") if os.path.isfile(name)), None):
        return Nearest(whole, "meant")
    if near := meant(path.stem, [file.stem for file in path.parent.glob("*.toml")]):
        return Nearest(str(path.with_name(f"{near.value}.toml")), "meant")
    return meant(address, built_in)


def scene_from_toml(raw_bytes: bytes, source: str, name: str, language: str | None = None) -> SceneFile:
    """Parse and validate a scene."""
    if len(raw_bytes) > MOST_BYTES:
        raise SceneError(source, "", None, "too_large_file", None, most=MOST_BYTES)
    try:
        raw = tables_of(raw_bytes)
    except UnicodeDecodeError as error:
        raise SceneError(source, "", None, "not_utf8", None, byte=error.start) from None
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        from parts.scene.toml_errors import slip, told_toml

        if not isinstance(error, RecursionError) and (found := slip(text_of(raw_bytes), str(error))):
            raise SceneError(source, "", None, found[0], partial(_key_meant, found[1]), **found[1]) from None
        code = "too_deep" if isinstance(error, RecursionError) else "not_toml"
        raise SceneError(source, "", None, code, None, why=told_toml(text_of(raw_bytes), str(error))) from None
    try:
        return scene_from_dict(raw, source, name, language)
    except RecursionError:
        raise SceneError(source, "", None, "too_deep") from None


def _key_meant(told: Mapping[str, Any]) -> Nearest | None:
    """The key of some scene that one in other letters translates to."""
    from parts.scene.defaults import default_names

    key = str(told.get("key", ""))
    return None if key.isascii() else meant(key, default_names(ExportSpec))


def scene_from_dict(raw: dict[str, Any], source: str, name: str, language: str | None = None) -> SceneFile:
    """Validate the tables of a scene, its assemblies told out."""
    try:
        with as_written(raw):
            return _validated(plain_numbers(raw, source, ""), source, name, language)
    except SceneError as refusal:
        if refusal.code not in ("unknown_key", "unknown_table", "nothing_takes_it"):
            raise
        from parts.scene.homes import at_home

        raise at_home(refusal, raw, PLAIN) from refusal


# the tables of a scene that are of no kind: their headers and keys
PLAIN: dict[str, type[Struct]] = {
    "[scene]": SceneInfo, "[checks]": ChecksSpec, "[[exports]]": ExportSpec, "[instances.NAME]": InstanceTable,
    "[[drives]]": DriveSpec, "[[steps]]": StepSpec, "[boards.NAME]": BoardSpec, "[beds.NAME]": BedSpec,
}  # fmt: skip


def _validated(raw: dict[str, Any], source: str, name: str, language: str | None = None) -> SceneFile:
    _check_tables(raw, source)
    if has_files(raw):
        raw = with_files(raw, source)
    if language is not None:
        raw = {**raw, "scene": {**raw.get("scene", {}), "language": language}}
    raw, origins, typed = plain_tables(raw, source)
    with in_keys_of_file(origins), _with_rulers(typed, origins, source):
        scene = _scene_of(in_language(raw, source), source, name, origins)
    scene.typed = typed
    return scene


@contextmanager
def _with_rulers(typed: dict[str, Any], origins: Mapping[str, str], source: str) -> Iterator[None]:
    """Refusals of what a recipe has made tell the keys that it follows from."""
    try:
        yield
    except SceneError as refusal:
        if typed:
            from parts.scene.ruled import rulers

            refusal.rulers = rulers(refusal.key, _in_file(refusal.key, origins), typed, source)
        raise


def plain_tables(raw: dict[str, Any], source: str) -> tuple[dict[str, Any], dict[str, str], dict[str, Any]]:
    """The tables of a scene, defaults filled in and assemblies told out; for places in them those of the file; and,
    where there are assemblies, the tables before these were told out.
    """
    origins: dict[str, str] = {}
    if "defaults" in raw:
        from parts.scene.defaults import filled_in

        raw, origins = filled_in(raw, source, ExportSpec, partial(_takes, source))
    if len(raw.get("boards", ())) == 1:
        from parts.scene.defaults import as_thick_as_board

        raw, thick = as_thick_as_board(raw)
        origins |= thick
    typed: dict[str, Any] = {}
    if "assemblies" in raw:
        from parts.scene.recipes import told_out

        typed = raw
        with in_keys_of_file(origins):
            raw, told = told_out(raw, source)
        origins |= {place: _in_file(there, origins) for place, there in told.items()}
    return raw, origins, typed


def _takes(source: str, table: dict[str, Any], key: str, value: object) -> bool:
    """Whether an export that is well without a key is so with it; tolerances of CAD are their own.

    Raises
    ------
    SceneError
        No export may have that value.
    """
    converted({"format": "dxf", key: value}, ExportSpec, source, "defaults")
    own = {k: v for k, v in table.items() if k != "parts"}
    try:
        spec = _export_spec(own, {}, source, "exports")
    except SceneError:
        return False
    if key == "tolerance" and spec.kind.is_cad:
        return False
    try:
        _export_spec({**own, key: value}, {}, source, "exports")
    except SceneError as refusal:
        # another value of it is taken
        if refusal.nearest is not None and isinstance(refusal.nearest.value, float):
            raise refusal.at(f"defaults.{key}") from refusal
        return False
    return True


# tables that stand under names of their own, and such a name
_NAMED = {"parts": "gear", "instances": "left", "boards": "plywood", "beds": "printer"}


def _check_tables(raw: dict[str, Any], source: str) -> None:
    """Only tables that a scene has, each of its form."""
    tables: dict[str, type] = {
        key: dict for key in ("scene", "defaults", "parts", "instances", "boards", "beds", "checks")
    }
    tables |= {key: list for key in ("assemblies", "mates", "drives", "steps", "exports")}
    for key, value in raw.items():
        if key not in tables:
            told = None if isinstance(value, dict | list) else value
            near = meant(key, tables)
            if near is None and (key == "kind" or (isinstance(value, dict) and "kind" in value)):
                name = _NAMED["parts"] if key == "kind" else key
                raise SceneError(source, key, told, "part_outside_parts", None, name=name)
            raise SceneError(source, key, told, "unknown_table", near, known=list(tables))
        if not isinstance(value, tables[key]):
            code = "not_a_list" if tables[key] is list else "not_a_named_table" if key in _NAMED else "not_a_table"
            raise SceneError(source, key, value, code, None, key=key, example=_NAMED.get(key))
        for name, own in raw[key].items() if key in _NAMED else ():
            if not isinstance(own, dict):
                raise SceneError(source, f"{key}.{name}", own, "not_a_named_table", None, key=key, example=_NAMED[key])
        for number, own in enumerate(value if isinstance(value, list) else (), 1):
            if not isinstance(own, dict):
                raise SceneError(source, f"{key}[{number}]", own, "not_a_list", None, key=key)
    if not (raw.get("parts") or raw.get("assemblies")):
        raise SceneError(source, "parts", None, "no_parts")


def _scene_of(raw: dict[str, Any], source: str, name: str, origins: dict[str, str]) -> SceneFile:
    """The scene of plain tables; ``origins`` gets the places of what groups are told out into."""
    info = converted(raw.get("scene", {}), SceneInfo, source, "scene")
    parts = {key: _part_spec(key, table, source) for key, table in raw["parts"].items()}
    for key in parts:
        twin = next((k for k in parts if k != key and k.lower() == key.lower()), None)
        if twin is not None:
            raise SceneError(source, f"parts.{key}", None, "same_but_for_case", None, twin=twin)
    exports = [
        _export_spec(table, parts, source, f"exports[{i + 1}]") for i, table in enumerate(raw.get("exports", []))
    ]
    instances, groups = instance_specs(raw.get("instances", {}), parts, source)
    mates: list[MateKeys] = []
    numbers: list[int] = []
    for number, table in enumerate(raw.get("mates", []), 1):
        place = f"mates[{number}]"
        with _of_a_part(parts, instances, table):
            spec = _mate_spec(table, instances, groups, source, place)
        for mate in members(spec, groups, source, place):
            if mate in mates:
                raise SceneError(source, place, None, "listed_twice")
            mates.append(mate)
            numbers.append(number)
    _renumber(origins, numbers)
    drives = [drive_spec(t, instances, source, f"drives[{i + 1}]") for i, t in enumerate(raw.get("drives", []))]
    steps = step_specs(raw.get("steps", []), parts, instances, groups, mates, source)
    checks = converted(raw.get("checks", {}), ChecksSpec, source, "checks")
    boards = _laid(raw, "boards", BoardSpec, exports, parts, instances, source)
    beds = _laid(raw, "beds", BedSpec, exports, parts, instances, source)
    return SceneFile(name, info, parts, exports, instances, mates, drives, checks, boards, beds, steps, origins)


def _laid(
    raw: dict[str, Any], key: str, kind: type[L], exports: list[ExportSpec], parts: dict[str, MaterialKeys],
    instances: dict[str, InstanceSpec], source: str,
) -> dict[str, L]:  # fmt: skip
    """The boards or beds of a scene; exports that lay parts out need one."""
    purpose = PURPOSES_LAID[key]
    wanted = next((i for i, e in enumerate(exports, 1) if e.purpose == purpose), 0)
    if wanted and not raw.get(key):
        raise SceneError(source, f"exports[{wanted}].purpose", purpose, "no_boards", None, table=f"[{key}.NAME]")
    found = {}
    for name, table in raw.get(key, {}).items():
        if not re.fullmatch(IDENTIFIER, name):
            raise SceneError(source, f"{key}.{name}", None, "not_a_name", Nearest(f"{purpose}_1"))
        found[name] = converted(table, kind, source, f"{key}.{name}")
        check_laid(found[name], parts, instances, source, f"{key}.{name}")
    return found


@contextmanager
def _of_a_part(
    parts: Mapping[str, MaterialKeys], instances: Mapping[str, InstanceSpec], mate: Mapping[str, Any]
) -> Iterator[None]:
    """A key that a mate has not, but a part that it joins, is told to belong there."""
    try:
        yield
    except SceneError as refusal:
        key = refusal.key.rpartition(".")[2]
        names = (str(mate.get(end)) for end in ("first", "second"))
        ends = [instances[name].part for name in names if name in instances]
        owner = next((str(end) for end in ends if key in parts[str(end)].__struct_fields__), None)
        if refusal.code != "unknown_key" or owner is None:
            raise
        told = {"place": f"parts.{owner}"}
        raise SceneError(refusal.source, refusal.key, refusal.value, "key_of_a_part", None, "", **told) from refusal


def _mate_spec(
    table: dict[str, Any], instances: dict[str, InstanceSpec], groups: Mapping[str, Group], source: str, place: str
) -> MateKeys:
    from parts.mates.registry import MATES

    kind = mate_kind(table, source, place)
    mate: MateKeys = converted(table, MATES[kind].keys, source, place)
    for key in ("first", "second"):
        if getattr(mate, key) not in groups:
            check_instance(getattr(mate, key), instances, source, f"{place}.{key}")
    if mate.first == mate.second:
        raise SceneError(source, f"{place}.second", mate.second, "mate_in_itself")
    return mate


def _part_spec(key: str, table: dict[str, Any], source: str) -> MaterialKeys:
    place = f"parts.{key}"
    if key.lower() in DEVICE_NAMES:
        raise SceneError(source, place, None, "device_name", Nearest(f"{key}_1"))
    if not re.fullmatch(IDENTIFIER, key):
        raise SceneError(source, place, None, "not_a_name", Nearest("part_1"))
    kind = part_kind(table, source, place)
    try:
        spec: MaterialKeys = KINDS[kind].gathered(
            converted(table, KINDS[kind].keys, source, place), Path(source).parent
        )
    except ParameterError as refusal:
        raise placed(source, place, refusal) from None
    if isinstance(spec.title, str) and not spec.title.strip():
        raise SceneError(source, f"{place}.title", spec.title, "blank_title", REMOVED)
    if spec.density is None and spec.material is not None:
        check_material(spec.material, source, f"{place}.material")
    if isinstance(label := spec.label, str):
        from geometry.plane.letters import unknown_letters

        if strange := unknown_letters(label):
            raise SceneError(source, f"{place}.label", label, "no_such_letter", REMOVED, letters=strange)
    return spec


# keys of exports: what they are where nobody asks, and the only format that takes them, or why CAD or a board does not
_OF_ONE_FORMAT = (
    ("dxf_version", "R2000", "dxf"), ("author", "", "step"), ("organisation", "", "step"), ("shared", True, "step"),
)  # fmt: skip
_NOT_OF_CAD = (
    ("kerf", 0.0, "shows_the_part"), ("curves", "arcs", "has_true_splines"), ("dxf_version", "R2000", "drawn_in_r2010"),
)  # fmt: skip
_NOT_OF_BOARDS = (("kerf", "key_of_board"), ("offset", "not_of_boards"), ("assembly", "not_of_boards"))


# mm: an outline that moves less stays as files tell it
_LEAST_MOVE = 1e-6


def _export_spec(table: object, parts: dict[str, MaterialKeys], source: str, place: str) -> ExportSpec:
    spec = converted(table, ExportSpec, source, place)
    check_parts(spec.parts or (), parts, source, f"{place}.parts")
    purposes = tolerances_of(spec.format)
    if spec.purpose is None:
        spec.purpose = default_export(spec.format).purpose
    if spec.purpose not in purposes:
        # a word that is none at all is refused as it is read: this one is of another format
        others = [f'"{name}"' for name in FORMATS if spec.purpose in tolerances_of(name)]
        told = {"format": spec.format, "known": list(purposes), "formats": others}
        raise SceneError(source, f"{place}.purpose", spec.purpose, "wrong_purpose", None, **told)
    if spec.kerf and spec.offset:
        raise SceneError(source, f"{place}.kerf", spec.kerf, "kerf_and_offset", REMOVED)
    for key in ("kerf", "offset"):
        if 0 < abs(moved := getattr(spec, key)) < _LEAST_MOVE:
            raise SceneError(
                source, f"{place}.{key}", moved, "hardly_moves", Nearest(0.0), unit="mm", least=_LEAST_MOVE
            )
    for key, code, numbers in _of_others(spec):
        raise SceneError(source, f"{place}.{key}", getattr(spec, key), code, REMOVED, **numbers)
    check_sheet_keys(spec, source, place)
    if spec.tolerance is None:
        spec.tolerance = purposes[str(spec.purpose)]
    return spec


def _of_others(spec: ExportSpec) -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Keys that are set, but only exports of other formats or purposes take: which, why, and the numbers of that."""
    for key, usual, only in _OF_ONE_FORMAT:
        if spec.format != only and getattr(spec, key) != usual:
            yield key, "only_for_format", {"formats": f'"{only}"', "format": spec.format}
    if spec.assembly and spec.format not in ASSEMBLY_FORMATS:
        yield "assembly", "only_for_format", {"formats": [f'"{f}"' for f in ASSEMBLY_FORMATS], "format": spec.format}
    for key, code in _NOT_OF_BOARDS if spec.is_laid else ():
        # a plate of prints is moved like each of them
        if getattr(spec, key) and not (key == "offset" and spec.format == "3mf"):
            yield key, code, {}
    kind = spec.kind
    if spec.kerf and kind.form is Form.TRIANGLES:
        yield "kerf", "kerf_of_a_print", {"offset": spec.kerf / 2}
    if spec.pitch_curve and kind.form is not Form.SPLINES:
        yield "pitch_curve", "only_for_purpose", {"purpose": "drawing"}
    for key, plain, code in _NOT_OF_CAD if kind.is_cad else ():
        if getattr(spec, key) != plain:
            yield key, code, {}


def _renumber(origins: dict[str, str], numbers: list[int]) -> None:
    """The places of mates that groups are told out into; ``numbers``: which mate of the file each one is."""
    if numbers == [*range(1, len(numbers) + 1)]:
        return
    told: dict[str, dict[str, str]] = {}
    for there in [there for there in origins if there.startswith("mates[")]:
        row = there[: there.index("]") + 1]
        told.setdefault(row, {})[there.removeprefix(row)] = origins.pop(there)
    for k, number in enumerate(numbers, 1):
        row = f"mates[{number}]"
        origins |= {f"mates[{k}]{rest}": place for rest, place in ({"": row} | told.get(row, {})).items()}


def make_parts(scene: SceneFile, source: str) -> tuple[dict[str, Part], list[Mating]]:
    """The parts of a scene, each checked to exist, as its mates want them; and the mates."""
    with _with_rulers(scene.typed, scene.origins, source):
        return _made_parts(scene, source)


def _made_parts(scene: SceneFile, source: str) -> tuple[dict[str, Part], list[Mating]]:
    parts, matings = _bored(scene, source)
    # what a chamfer leaves of the edges only the solid tells, and flat files must not show what cannot be made
    if chamfered := {key: part for key, part in parts.items() if value_at(part.keys, "face_chamfer")}:
        from parts.scene.checks import check_solids

        check_solids(chamfered, source)
    if any(value_at(part.keys, "position") for part in parts.values()):
        from parts.scene.parts_list import check_positions

        check_positions(parts, scene.scene.language, source)
    return parts, matings


def _bored(scene: SceneFile, source: str) -> tuple[dict[str, Part], list[Mating]]:
    """The parts with the holes of their axles, and the mates."""
    if not any(KINDS[str(keys.__struct_config__.tag)].holes_at(keys) for keys in scene.parts.values()):
        return _made(scene, scene.parts, source)
    from parts.scene.axles import waits_for_axles, with_axle_holes

    waits = waits_for_axles(scene.parts, scene.instances, source)
    parts, matings = _made(scene, scene.parts, source)
    if not waits:
        return parts, matings
    from parts.scene.placing import place

    placing = place(scene.instances, [], parts, matings, source)
    return _made(scene, with_axle_holes(parts, placing, source), source)


def _made(scene: SceneFile, specs: dict[str, MaterialKeys], source: str) -> tuple[dict[str, Part], list[Mating]]:
    """The parts of these keys, and the mates."""
    gears, part_of = {}, {key: str(spec.part) for key, spec in scene.instances.items()}
    # what is made from another part's keys looks for it in the scene
    for key, spec in sorted(specs.items(), key=lambda item: "of" in item[1].__struct_fields__):
        kind = KINDS[str(spec.__struct_config__.tag)]
        make = partial(_thing, scene, specs, part_of, key)
        try:
            gears[key] = make(spec)
        except ParameterError as refusal:
            from parts.scene.checks import unlike

            if found := unlike(key, specs, scene.mates, part_of, source):
                raise found from refusal
            fits = partial(_check_fit, scene, specs, key)
            raise kind.refused(spec, refusal, source, f"parts.{key}", make, fits) from refusal
        except GeometryError as error:
            raise SceneError(source, f"parts.{key}", None, "no_outline", None, why=str(error)) from error
    matings: list[Mating] = []
    if scene.mates:
        from parts.scene.checks import joined

        gears, matings = joined(specs, gears, scene.mates, part_of, source)
    language = scene.scene.language
    parts = {
        key: Part(key, KINDS[str(spec.__struct_config__.tag)], spec, gears[key], language)
        for key, spec in specs.items()
    }
    return parts, matings


def _thing(
    scene: SceneFile, specs: dict[str, MaterialKeys], part_of: Mapping[str, str], part: str, keys: MaterialKeys
) -> Any:
    """What a part's keys make, beside its mates where there are any."""
    if not scene.mates:
        return KINDS[str(keys.__struct_config__.tag)].thing(keys, specs)
    from parts.scene.checks import thing_of

    return thing_of(part, keys, specs, scene.mates, part_of)


def _check_fit(
    scene: SceneFile, specs: dict[str, MaterialKeys], part: str, keys: MaterialKeys, thing: object
) -> Iterable[str]:
    """Refuse other keys of a part that what hangs on it does not take; names the parts that must change with it."""
    from parts.base.mate import End
    from parts.scene.checks import check_fit

    part_of = {key: str(spec.part) for key, spec in scene.instances.items()}
    ends, changed = {part: End(keys, thing)}, _changed(scene.origins, specs, part, keys)
    try:
        check_fit(part, ends, changed, scene.mates, part_of)
    except (GeometryError, SceneError):
        alike = _alike(scene, changed, specs, part, part_of)
        if not alike:
            raise
        for name in (part, *alike):
            check_fit(name, ends, changed | alike, scene.mates, part_of)
        return alike
    return ()


def _alike(
    scene: SceneFile, changed: dict[str, MaterialKeys], specs: dict[str, MaterialKeys], part: str,
    part_of: Mapping[str, str],
) -> dict[str, MaterialKeys]:  # fmt: skip
    """Parts that mates join to one whose keys have changed, with its new values where they had the same as it."""
    old, new = specs[part], changed[part]
    values = {key: getattr(new, key) for key in new.__struct_fields__ if getattr(new, key) != getattr(old, key)}
    found: dict[str, MaterialKeys] = {}
    joined = [part]
    for name in joined:
        for mate in scene.mates:
            pair = part_of[mate.first], part_of[mate.second]
            for other in pair if name in pair else ():
                spec = specs[other]
                if other not in joined and (
                    had := {key: v for key, v in values.items() if getattr(spec, key, None) == getattr(old, key)}
                ):
                    for key, value in had.items():
                        # what is left out has the other's own default
                        spec = tried(spec, key, value)
                    found[other] = spec
                    joined.append(other)
    return found


def _changed(
    origins: Mapping[str, str], specs: dict[str, MaterialKeys], part: str, keys: MaterialKeys
) -> dict[str, MaterialKeys]:
    """The keys of all parts with other ones of one: what it has from ``[defaults]`` changes for all that have it."""
    made = {**specs, part: keys}
    for name in keys.__struct_fields__:
        value, given = getattr(keys, name), f": defaults.{name}"
        if value != getattr(specs[part], name) and origins.get(f"parts.{part}.{name}", "").endswith(given):
            for other in [p for p in specs if p != part and origins.get(f"parts.{p}.{name}", "").endswith(given)]:
                made[other] = msgspec.structs.replace(made[other], **{name: value})
    return made


# keys of parts, instances and drives that are told where they are given
_SELDOM = (
    "axis", "held", "travel", "along", "outwards", "opened", "title", "label", "position", "designation", "standard",
    "subassembly",
)  # fmt: skip


def resolved(scene: SceneFile) -> dict[str, Any]:
    """The scene as JSON has it, pairs as lists too, with every default filled in and every group told out."""
    data: dict[str, Any] = msgspec.json.decode(msgspec.json.encode(scene))
    del data["origins"], data["typed"]
    # told where there are some
    for key in [key for key in (*PURPOSES_LAID, "steps") if not data[key]]:
        del data[key]
    for spec in (*data["parts"].values(), *data["instances"].values(), *data["drives"], *data.get("steps", ())):
        for key in [key for key in _SELDOM if spec.get(key, 0) is None]:
            del spec[key]
    return data


def scene_from_resolved(data: dict[str, Any], source: str) -> SceneFile:
    """A scene from what a report has kept."""
    known = ("scene", "parts", "instances", "mates", "drives", "steps", "exports", "checks", *PURPOSES_LAID)
    tables = without_none({key: data[key] for key in known if key in data})
    # copies about an axis leave what is nearly 0, which is kept as it was made
    return _validated(plain_numbers(tables, source, "", 0.0), source, str(data.get("name", "scene")))
