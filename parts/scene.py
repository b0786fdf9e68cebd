"""Scene files: read, validated key by key, every refusal with place, value and remedy."""

from __future__ import annotations

import math
import re
import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import msgspec
from msgspec import Meta, Struct

from geometry.errors import ParameterError
from parts.instances import DriveSpec, InstanceSpec, check_instance, drive_spec, instance_specs
from parts.keys import DEVICE_NAMES, IDENTIFIER, Identifier, mm
from parts.kinds import KINDS
from parts.part import Part
from parts.schema import SceneError, converted, near, refuse_infinite
from parts.sheet_keys import CamSpeed, Intervals, MateNumber, RackStep, check_sheet_keys
from parts.surely import offers_tried
from parts.title_keys import TitleBlockKey

if TYPE_CHECKING:
    from parts.mate_kinds import Mating

SCENE_FOLDER = Path(__file__).parent / "scenes"
# purposes of each format, the default first, and the tolerance (mm) of an export that names none
_DEFAULTS: dict[str, dict[str, float]] = {
    "dxf": {"laser": 0.005, "drawing": 1e-6},
    "svg": {"laser": 0.005},
    "stl": {"print": 0.01},
    "3mf": {"print": 0.01},
    "step": {"model": 1e-6},
    "sheet": {"meshing": 1e-6, "generating": 1e-6, "cam": 1e-6},
}
FORMATS = tuple(_DEFAULTS)
# formats that hold parts in their places
ASSEMBLY_FORMATS = ("step", "3mf")
# a scene that is larger than this is not one
_MAX_SCENE_BYTES = 4_000_000


class SceneInfo(Struct, forbid_unknown_fields=True):
    """Keys of ``[scene]``."""

    title: Annotated[str, Meta(max_length=500, description="what the scene shows")] = ""
    language: Annotated[Literal["en", "uk"], Meta(description="language of reports")] = "en"


class ExportSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[[exports]]``."""

    format: Annotated[Literal["dxf", "svg", "stl", "3mf", "step", "sheet"], Meta(description="file format")]
    purpose: (
        Annotated[
            Literal["laser", "print", "drawing", "model", "meshing", "generating", "cam"],
            Meta(
                description="dxf: laser (arcs) or drawing (splines); sheet: meshing (picture of each pair), "
                "generating (device TMM-42) or cam (diagrams, least radius, profile)"
            ),
        ]
        | None
    ) = None
    tolerance: Annotated[float, mm("largest deviation from the exact curve", least=1e-7, most=1.0)] | None = None
    kerf: Annotated[float, mm("full width of the cut; the path runs half of it outside the part", least=0, most=10)] = (
        0.0
    )
    offset: Annotated[
        float, mm("moves every outline: positive out of the material, negative into it", least=-10, most=10)
    ] = 0.0
    curves: Annotated[Literal["arcs", "lines"], Meta(description="dxf, svg: arcs, or straight lines only")] = "arcs"
    dxf_version: Annotated[Literal["R2000", "R12"], Meta(description="dxf only")] = "R2000"
    name: Annotated[Identifier, Meta(description="tells files of one part apart; default: the purpose")] | None = None
    parts: Annotated[list[str], Meta(min_length=1, description="parts to export; default: all")] | None = None
    assembly: Annotated[bool, Meta(description="step, 3mf: one file of all instances in their places")] = False
    rack_step: RackStep | None = None
    intervals: Intervals | None = None
    speed_rpm: CamSpeed | None = None
    title_block: TitleBlockKey = False
    mate: MateNumber | None = None


class ChecksSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[checks]``."""

    interference: Annotated[bool, Meta(description="contact and interference of every mate")] = False
    transmission_error: Annotated[
        bool, Meta(description="how unevenly each mate runs: peak to peak from the exact contact, without load")
    ] = False


class SceneFile(Struct, forbid_unknown_fields=True):
    """A scene as resolved: what ``report.json`` keeps and ``verify`` builds again."""

    name: str
    scene: SceneInfo
    parts: dict[str, Any]
    exports: list[ExportSpec]
    instances: dict[str, InstanceSpec] = {}
    mates: list[Any] = []
    drives: list[DriveSpec] = []
    checks: ChecksSpec = msgspec.field(default_factory=ChecksSpec)


def built_in_scenes() -> dict[str, Path]:
    """Names and files of the scenes that come with the package."""
    return {path.stem: path for path in sorted(SCENE_FOLDER.glob("*.toml"))}


def load_scene(address: str) -> SceneFile:
    """A scene by the name of a built-in one or by the path of a TOML file.

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
        raw_bytes = b"" if folder else _content(path)
    except FileNotFoundError:
        known = [*built_in, *([f"{address}.toml"] if Path(f"{address}.toml").is_file() else [])]
        remedy = f"no such file or built-in scene{near(address, known)}; built-in: {', '.join(built_in)}"
        raise SceneError(address, "", None, remedy) from None
    except OSError as error:
        raise SceneError(address, "", None, f"cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise SceneError(repr(address), "", None, f"is not a path: {error}") from None
    if folder:
        remedy = "is a folder; " if address else "is no scene; "
        raise SceneError(address, "", None, f"{remedy}give a scene file (.toml) or one of: {', '.join(built_in)}")
    name = path.stem.encode("utf-8", "replace").decode()
    if not name.strip(". ") or not name.isprintable():
        raise SceneError(
            address, "", None, "the file's name names the folder of the results; rename it, like gear.toml"
        )
    return scene_from_toml(raw_bytes, str(path), name)


def _content(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(_MAX_SCENE_BYTES + 1)


def scene_from_toml(raw_bytes: bytes, source: str, name: str) -> SceneFile:
    """Parse and validate a scene."""
    if len(raw_bytes) > _MAX_SCENE_BYTES:
        raise SceneError(source, "", None, f"is larger than {_MAX_SCENE_BYTES} bytes; not a scene file")
    try:
        raw = tomllib.loads(raw_bytes.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise SceneError(source, "", None, f"is not UTF-8 text (byte {error.start}); save it as UTF-8") from None
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        text = str(error) or "nested too deeply"
        raise SceneError(source, "", None, f"is not TOML: {text}; see `higherpair new spur_gear` for a start") from None
    try:
        return scene_from_dict(raw, source, name)
    except RecursionError:
        raise SceneError(source, "", None, "tables are nested too deeply; a scene needs three levels") from None


@offers_tried
def scene_from_dict(raw: dict[str, Any], source: str, name: str) -> SceneFile:
    """Validate the tables of a scene."""
    refuse_infinite(raw, source, "")
    tables: dict[str, type] = {key: dict for key in ("scene", "parts", "instances", "checks")}
    tables |= {key: list for key in ("mates", "drives", "exports")}
    for key, value in raw.items():
        if key not in tables:
            raise SceneError(source, key, None, f"unknown table{near(key, tables)}; known: {', '.join(tables)}")
        if not isinstance(value, tables[key]):
            remedy = f"write it as [[{key}]]" if tables[key] is list else f"write it as a table, [{key}]"
            raise SceneError(source, key, value, remedy)
    if not raw.get("parts"):
        raise SceneError(source, "parts", None, 'a scene needs at least one part, like [parts.gear] kind = "spur_gear"')
    info = converted(raw.get("scene", {}), SceneInfo, source, "scene")
    parts = {key: _part_spec(key, table, source) for key, table in raw["parts"].items()}
    for key in parts:
        twin = next((k for k in parts if k != key and k.lower() == key.lower()), None)
        if twin is not None:
            raise SceneError(
                source, f"parts.{key}", None, f"differs from {twin} only in case: one file for both; rename it"
            )
    exports = [
        _export_spec(table, parts, source, f"exports[{i + 1}]") for i, table in enumerate(raw.get("exports", []))
    ]
    instances = instance_specs(raw.get("instances", {}), parts, source)
    mates = [_mate_spec(t, instances, parts, source, f"mates[{i + 1}]") for i, t in enumerate(raw.get("mates", []))]
    drives = [drive_spec(t, instances, source, f"drives[{i + 1}]") for i, t in enumerate(raw.get("drives", []))]
    checks = converted(raw.get("checks", {}), ChecksSpec, source, "checks")
    return SceneFile(name, info, parts, exports, instances, mates, drives, checks)


def _mate_spec(
    table: Any, instances: dict[str, InstanceSpec], parts: dict[str, Struct], source: str, place: str
) -> Struct:
    from parts.mates import MATES

    if not isinstance(table, dict):
        raise SceneError(source, place, table, "write it as a table, [[mates]]")
    kind = table.get("kind")
    if not isinstance(kind, str) or kind not in MATES:
        remedy = "is missing" if kind is None else f"unknown kind of mate{near(str(kind), MATES)}"
        raise SceneError(source, f"{place}.kind", kind, f"{remedy}; known: {', '.join(MATES)}")
    mate = converted(table, MATES[kind], source, place)
    for key in ("first", "second"):
        check_instance(getattr(mate, key), instances, source, f"{place}.{key}")
    if mate.first == mate.second:
        raise SceneError(source, f"{place}.second", mate.second, "a part has no mate in itself; name another one")
    return mate


def _part_spec(key: str, table: Any, source: str) -> Struct:
    place = f"parts.{key}"
    if key.lower() in DEVICE_NAMES:
        remedy = f"is a name that Windows keeps for a device; {key}_1 works"
        raise SceneError(source, place, None, remedy)
    if not re.fullmatch(IDENTIFIER, key):
        remedy = "a part's name is made of letters, digits, _ and - (A to Z, at most 64); part_1 works"
        raise SceneError(source, place, None, remedy)
    if not isinstance(table, dict):
        raise SceneError(source, place, table, f"write it as a table, [parts.{key}]")
    kind = table.get("kind")
    if kind is None:
        raise SceneError(source, f"{place}.kind", None, f"is missing; known kinds: {', '.join(KINDS)}")
    if not isinstance(kind, str) or kind not in KINDS:
        remedy = f"unknown kind{near(str(kind), KINDS)}; known kinds: {', '.join(KINDS)}"
        raise SceneError(source, f"{place}.kind", kind, remedy)
    return converted(table, KINDS[kind][0], source, place)


def _export_spec(table: Any, parts: dict[str, Struct], source: str, place: str) -> ExportSpec:
    spec = converted(table, ExportSpec, source, place)
    for part in spec.parts or ():
        if (spec.parts or []).count(part) > 1:
            raise SceneError(source, f"{place}.parts", part, "is listed twice; once is enough")
        if part not in parts:
            raise SceneError(
                source, f"{place}.parts", part, f"no such part{near(part, parts)}; parts: {', '.join(parts)}"
            )
    if spec.kerf and spec.offset:
        raise SceneError(
            source, f"{place}.kerf", spec.kerf, "give either kerf or offset; an offset of half the kerf is the same"
        )
    if spec.format != "dxf" and spec.dxf_version != "R2000":
        raise SceneError(
            source, f"{place}.dxf_version", spec.dxf_version, f'only for format = "dxf", not {spec.format}; remove it'
        )
    if spec.assembly and spec.format not in ASSEMBLY_FORMATS:
        known = " or ".join(f'"{f}"' for f in ASSEMBLY_FORMATS)
        raise SceneError(
            source, f"{place}.assembly", spec.assembly, f"only for format = {known}, not {spec.format}; remove it"
        )
    purposes = _DEFAULTS[spec.format]
    if spec.purpose is None:
        spec.purpose = default_export(spec.format).purpose
    if spec.purpose not in purposes:
        raise SceneError(source, f"{place}.purpose", spec.purpose, f"{spec.format} is for {' or '.join(purposes)}")
    check_sheet_keys(spec, source, place)
    if spec.kerf and spec.format in ("stl", "3mf"):
        remedy = f"a print has no kerf; offset = {spec.kerf / 2:.12g} moves every outline by as much"
        raise SceneError(source, f"{place}.kerf", spec.kerf, remedy)
    if spec.format in ("step", "sheet") or spec.purpose == "drawing":
        who = {"step": "a STEP file", "sheet": "a sheet"}.get(spec.format, "a drawing")
        if spec.kerf:
            raise SceneError(source, f"{place}.kerf", spec.kerf, f"{who} shows the part, not the cut; remove it")
        if spec.curves != "arcs":
            raise SceneError(source, f"{place}.curves", spec.curves, f"{who} has true splines; remove it")
        if spec.dxf_version != "R2000":
            raise SceneError(source, f"{place}.dxf_version", spec.dxf_version, f"{who} is not for R12; remove it")
    if spec.tolerance is None:
        spec.tolerance = purposes[str(spec.purpose)]
    return spec


def default_export(name: str) -> ExportSpec:
    """An export of a format with its default purpose and tolerance."""
    purpose, tolerance = next(iter(_DEFAULTS[name].items()))
    return msgspec.convert({"format": name, "purpose": purpose, "tolerance": tolerance}, ExportSpec)


@offers_tried
def make_parts(scene: SceneFile, source: str) -> tuple[dict[str, Part], list[Mating]]:
    """The parts of a scene, each checked to exist, as its mates want them; and the mates."""
    gears = {}
    for key, spec in sorted(scene.parts.items(), key=lambda item: hasattr(item[1], "of")):
        try:
            checked = KINDS[spec.__struct_config__.tag][1]
            # what is made from another part's keys looks for it in the scene
            gears[key] = checked(spec, scene.parts) if hasattr(spec, "of") else checked(spec)
        except ParameterError as error:
            raise SceneError(source, f"parts.{key}.{error.name}", error.value, error.allowed) from error
    matings: list[Mating] = []
    if scene.mates:
        gears, matings = _mated(scene, gears, source)
    parts = {key: KINDS[spec.__struct_config__.tag][2](key, spec, gears[key]) for key, spec in scene.parts.items()}
    return parts, matings


def _mated(scene: SceneFile, gears: dict[str, Any], source: str) -> tuple[dict[str, Any], list[Mating]]:
    """What the parts are made from, as the scene's mates want it, and the mates."""
    from parts.mate_checks import check_helices, check_kinds, pair_refused
    from parts.mates import mated

    part_of = {key: str(spec.part) for key, spec in scene.instances.items()}
    helices = {key: math.radians(abs(getattr(spec, "helix_angle_deg", 0.0))) for key, spec in scene.parts.items()}
    for index, mate in enumerate(scene.mates):
        check_kinds(scene, mate, part_of, source, f"mates[{index + 1}]")
        check_helices(scene, mate, part_of, source, f"mates[{index + 1}]")
        try:
            mated(gears, [mate], part_of, helices)
        except ParameterError as refusal:
            raise pair_refused(scene, refusal, (gears, mate, part_of), source, f"mates[{index + 1}]") from refusal
    gears, matings = mated(gears, scene.mates, part_of, helices)
    for index, mating in enumerate(matings):
        if mating.pair is not None:
            from parts.common_face import with_face
            from parts.helix_keys import common_face

            owners = (scene.parts[part_of[i]] for i in (mating.first, mating.second))
            matings[index] = with_face(mating, common_face(*owners))
    return gears, matings


def resolved(scene: SceneFile) -> dict[str, Any]:
    """The scene as plain data with every default filled in."""
    return msgspec.to_builtins(scene)


def scene_from_resolved(data: dict[str, Any], source: str) -> SceneFile:
    """A scene from what a report has kept."""
    known = ("scene", "parts", "instances", "mates", "drives", "exports", "checks")
    tables: dict[str, Any] = {key: data[key] for key in known if key in data}
    tables["exports"] = [{k: v for k, v in e.items() if v is not None} for e in tables.get("exports", [])]
    for name in ("parts", "instances"):
        tables[name] = {k: _without_none(v) for k, v in tables.get(name, {}).items()}
    return scene_from_dict(tables, source, str(data.get("name", "scene")))


def _without_none(table: Any) -> Any:
    return {k: _without_none(v) for k, v in table.items() if v is not None} if isinstance(table, dict) else table
