"""Wrong scenes: each gives one refusal that names the key, the value and what would work."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from exporters.command.cli import main
from exporters.production.build import build
from exporters.production.plan import plan_build
from geometry.base.errors import Nearest
from parts.base.refusal import SceneError, meant, sentence
from parts.scene.files import built_in_scenes
from parts.scene.language import language_of
from parts.scene.load import load_scene, scene_from_dict, scene_from_toml

GEAR = {"kind": '"spur_gear"', "module": "2.0", "number_of_teeth": "23"}
Keys = dict[str, str | None]
EXPORT = {"format": '"dxf"'}


def scene_text(part: Keys | None = None, export: Keys | None = None, tail: str = "") -> str:
    """A scene of one gear; values are TOML already, None leaves a key out."""
    lines = ["[parts.gear]"]
    lines += [f"{k} = {v}" for k, v in (GEAR | (part or {})).items() if v is not None]
    lines += ["[[exports]]", *(f"{k} = {v}" for k, v in (EXPORT | (export or {})).items() if v is not None)]
    return "\n".join([*lines, tail, ""])


def _built(raw: bytes, folder: Path) -> None:
    build(plan_build(scene_from_toml(raw, "test.toml", "test"), "test.toml", [], []), folder)


def refusal(text: str | bytes) -> SceneError:
    """The one refusal that a scene gets on its way to files; none may be there afterwards."""
    raw = text if isinstance(text, bytes) else text.encode()
    with TemporaryDirectory() as folder:
        with pytest.raises(SceneError) as caught:
            _built(raw, Path(folder) / "new" / "out")
        assert not list(Path(folder).iterdir())
    message = str(caught.value)
    assert "\n" not in message
    assert message.startswith("test.toml")
    assert not re.search(r"Traceback|msgspec|Struct|<class|Meta\(", message), message
    return caught.value


# part keys to change, export keys to change: the key, the value and words of the remedy in the refusal
# fmt: off
WRONG_KEYS: dict[str, tuple[Keys, Keys, str, str, str]] = {
    "unknown key": ({"modul": "2"}, {}, "parts.gear.modul", "2", "did you mean module"),
    "unknown key beside the one that is most like it": (
        {"kind": '"bevel_gear"', "mate_teeth": "40"}, {}, "parts.gear.mate_teeth", "40",
        "did you mean mate_number_of_teeth"),
    "height of a wheel": ({"height": "8"}, {}, "parts.gear.height", "8", "did you mean face_width"),
    "height of a rack": ({"kind": '"rack"', "height": "8"}, {}, "parts.gear.height", "8", "did you mean body_height"),
    "height of a hub": (
        {"hub": "{ diameter = 14, height = 5 }"}, {}, "parts.gear.hub.height", "5", "did you mean above"),
    "outer diameter of a wheel": (
        {"outer_diameter": "50"}, {}, "parts.gear.outer_diameter", "50", "did you mean tip_diameter"),
    "shaft of a wheel": ({"shaft_diameter": "6"}, {}, "parts.gear.shaft_diameter", "6", "did you mean bore_diameter"),
    "bore as a number": ({"bore": "6"}, {}, "parts.gear.bore", "6", "did you mean bore_diameter"),
    "unknown export key": ({}, {"tolerence": "1"}, "exports[1].tolerence", "1", "did you mean tolerance"),
    "unknown key in a table": ({"tip_relief": "{ dept = 1 }"}, {}, "tip_relief.dept", "1", "depth_coefficient"),
    "text for a number": ({"module": '"two"'}, {}, "parts.gear.module", '"two"', "a number"),
    "number for text": ({"material": "3"}, {}, "parts.gear.material", "3", "text"),
    "bool for a whole number": ({"number_of_teeth": "true"}, {}, "number_of_teeth", "true", "whole number"),
    "bool for a number": ({"module": "true"}, {}, "parts.gear.module", "true", "a number"),
    "fraction of a tooth": ({"number_of_teeth": "23.5"}, {}, "number_of_teeth", "23.5", "whole number"),
    "list for a number": ({"module": "[2.0]"}, {}, "parts.gear.module", "[2.0]", "a number"),
    "date for a number": ({"module": "2024-01-01"}, {}, "parts.gear.module", "2024-01-01", "a number"),
    "negative module": ({"module": "-2.0"}, {}, "parts.gear.module", "-2", "at least 0.01"),
    "no module": ({"module": "0"}, {}, "parts.gear.module", "0", "at least 0.01"),
    "huge module": ({"module": "1e300"}, {}, "parts.gear.module", "1e+300", "at most 1000"),
    "two teeth": ({"number_of_teeth": "2"}, {}, "number_of_teeth", "2", "at least 3"),
    "1e12 teeth": ({"number_of_teeth": "1e12"}, {}, "number_of_teeth", "1e+12", "at most 10000"),
    "10^12 teeth": ({"number_of_teeth": "1000000000000"}, {}, "number_of_teeth", "1000000000000", "at most 10000"),
    "10^30 teeth": ({"number_of_teeth": "1" + 30 * "0"}, {}, "number_of_teeth", "1" + 30 * "0", "at most 10000"),
    "negative teeth": ({"number_of_teeth": "-23"}, {}, "number_of_teeth", "-23", "at least 3"),
    "bore larger than the root": ({"bore_diameter": "45.0"}, {}, "bore_diameter", "45", "41"),
    "nan": ({"module": "nan"}, {}, "parts.gear.module", "nan", "finite"),
    "minus infinity": ({"tip_chamfer": "-inf"}, {}, "parts.gear.tip_chamfer", "-inf", "finite"),
    "1e400": ({"face_width": "1e400"}, {}, "parts.gear.face_width", "inf", "finite"),
    "nan in a table": ({"tip_relief": "{ depth_coefficient = nan }"}, {}, "relief.depth_coefficient", "nan", "finite"),
    "infinite tolerance": ({}, {"tolerance": "inf"}, "exports[1].tolerance", "inf", "finite"),
    "splines for the laser": (
        {}, {"curves": '"splines"'}, "exports[1].curves", '"splines"', 'purpose = "drawing" has true splines'),
    "unknown kind": ({"kind": '"spur_gaer"'}, {}, "parts.gear.kind", '"spur_gaer"', "did you mean spur_gear"),
    "kind is a number": ({"kind": "7"}, {}, "parts.gear.kind", "7", "spur_gear"),
    "missing kind": ({"kind": None}, {}, "parts.gear.kind", "", "spur_gear"),
    "missing module": ({"module": None}, {}, "parts.gear.module", "", "missing"),
    "unknown format": ({}, {"format": '"dwg"'}, "exports[1].format", '"dwg"', '"dxf", "svg"'),
    "formats in one export": (
        {}, {"format": '["dxf", "stl"]'}, "exports[1].format", '["dxf", "stl"]', "write [[exports]] for each"),
    "missing format": ({}, {"format": None}, "exports[1].format", "", '"dxf"'),
    "unknown rack": ({"basic_rack": '"ISO 53 E"'}, {}, "basic_rack", '"ISO 53 E"', "ISO 53 A"),
    "rack is a number": ({"basic_rack": "53"}, {}, "basic_rack", "53", "table"),
    "colour by name": ({"colour": '"red"'}, {}, "colour", '"red"', "#c08040"),
    "kerf and offset": ({}, {"kerf": "0.1", "offset": "0.1"}, "exports[1].kerf", "0.1", "either kerf or offset"),
    "kerf closes the spaces": ({}, {"kerf": "9.0"}, "exports[1].kerf", "9", "at most"),
    "kerf closes the bore": ({"bore_diameter": "1"}, {"kerf": "1.5"}, "exports[1].kerf", "1.5", "at most"),
    "offset of nothing": ({}, {"offset": "1e-9"}, "exports[1].offset", "1e-09", "0 mm works"),
    "kerf of nothing": ({}, {"kerf": "1e-7"}, "exports[1].kerf", "1e-07", "0 mm works"),
    "offset leaves no tooth": ({}, {"offset": "-9.9"}, "exports[1].offset", "-9.9", "at least"),
    "chamfer and rounding": ({"tip_chamfer": "0.2", "tip_rounding": "0.2"}, {}, "tip_rounding", "0.2", "either"),
    "unknown part": ({}, {"parts": '["gaer"]'}, "exports[1].parts", "gaer", "did you mean gear"),
    "no part": ({}, {"parts": "[]"}, "exports[1].parts", "[]", ""),
    "parts is text": ({}, {"parts": '"gear"'}, "exports[1].parts", '"gear"', "list"),
    "tolerance 0": ({}, {"tolerance": "0"}, "exports[1].tolerance", "0", "at least 1e-07"),
    "tolerance 1e-12": ({}, {"tolerance": "1e-12"}, "exports[1].tolerance", "1e-12", "at least 1e-07"),
    "tolerance 1e9": ({}, {"tolerance": "1e9"}, "exports[1].tolerance", "1000000000", "at most 1"),
    "negative tolerance": ({}, {"tolerance": "-0.1"}, "exports[1].tolerance", "-0.1", "at least"),
    "plate of an stl": ({}, {"format": '"stl"', "purpose": '"plate"'}, "exports[1].purpose", "plate", 'format = "3mf"'),
    "R12 of an stl": ({}, {"format": '"stl"', "dxf_version": '"R12"'}, "exports[1].dxf_version", "R12", "remove"),
    "R12 of a drawing": (
        {}, {"purpose": '"drawing"', "dxf_version": '"R12"'}, "exports[1].dxf_version", "R12", "R2010"),
    "printing on a laser": ({}, {"purpose": '"print"'}, "exports[1].purpose", "print", "laser"),
    "a purpose of other formats, like none of its own": (
        {}, {"format": '"pdf"', "purpose": '"animation"'}, "exports[1].purpose", "animation", "part, assembly"),
    # before: assembly, which boards and beds have not, was to be removed, and only then this was told
    "beds of a format that lies on none": ({}, {"format": '"step"', "purpose": '"plate"', "assembly": "true"},
                                           "exports[1].purpose", "plate", "step is for model"),
    "path as export name": ({}, {"name": '"../x"'}, "exports[1].name", "../x", "letters"),
    "stl finer than its numbers": ({"module": "1000"}, {"format": '"stl"', "tolerance": "1e-6"},
                                   "exports[1].tolerance", "1e-06", "at least"),
}
# fmt: on


def test_an_offered_kerf_is_one_that_all_parts_survive() -> None:
    """Before: that of the first part that did not survive its own."""
    gear = {"kind": "spur_gear", "module": 2.0, "face_width": 3.0}
    parts = {key: gear | {"number_of_teeth": z} for key, z in (("a", 12), ("b", 16))}
    board = {"width": 200.0, "height": 100.0, "thickness": 3.0}
    for place, kerf, more in (
        ("boards.w.kerf", 10.0, {"boards": {"w": board}, "exports": [{"format": "svg", "purpose": "board"}]}),
        ("exports[1].kerf", 9.9, {"exports": [{"format": "dxf"}]}),
    ):

        def planned(value: float, more: dict[str, Any] = more) -> None:
            owner = "boards" if "boards" in more else "exports"
            own = {"w": board | {"kerf": value}} if owner == "boards" else [{"format": "dxf", "kerf": value}]
            raw = {"parts": parts, **more, owner: own}
            plan_build(scene_from_dict(raw, "test.toml", "test"), "test.toml", [], [])

        with pytest.raises(SceneError) as caught:
            planned(kerf)
        found = caught.value.nearest
        assert caught.value.key == place
        assert found is not None
        assert isinstance(found.value, float)
        assert found.side == "at_most"
        planned(found.value)
        with pytest.raises(SceneError):
            planned(1.001 * found.value)


@pytest.mark.parametrize(
    ("scene", "offset", "side"),
    [
        # before: -3.999999, at which the solid's keyway is gone
        ("barrel_cam", -9.99, "at_least"),
        # before: a key pointed_diameter, which no part has
        ("print_gear", -1.2249, "at_least"),
        ("print_gear", -9.0, "at_least"),
        ("groove_cam", 5.0, "at_most"),
    ],
)
def test_an_offered_offset_is_one_that_the_solids_of_all_parts_survive(scene: str, offset: float, side: str) -> None:
    raw = tomllib.loads(built_in_scenes()[scene].read_text("utf-8"))

    def planned(value: float) -> None:
        made = {**raw, "checks": {}, "exports": [{"format": "stl", "offset": value}]}
        plan_build(scene_from_dict(made, "test.toml", "test"), "test.toml", [], [])

    with pytest.raises(SceneError) as caught:
        planned(offset)
    assert caught.value.key == "exports[1].offset"
    assert not re.search(r"\d\.\d{7}", str(caught.value))
    found = caught.value.nearest
    assert found is not None
    assert isinstance(found.value, float)
    assert found.side == side
    planned(found.value)
    with pytest.raises(SceneError):
        planned(1.001 * found.value)


def test_a_tolerance_below_the_places_of_an_animation_is_refused(tmp_path: Path) -> None:
    """Before: the file failed its check."""
    drive = '[[drives]]\ninstance = "gear"\nturns = 1.0'
    found = refusal(scene_text({}, {"format": '"motion"', "tolerance": "1e-6"}, drive))
    assert (found.key, found.code) == ("exports[1].tolerance", "finer_than_motion")
    assert found.nearest is not None
    told = scene_text({}, {"format": '"motion"', "tolerance": str(found.nearest.value)}, drive)
    (tmp_path / "s.toml").write_text(told)
    assert main(["build", "-q", str(tmp_path / "s.toml"), "--out", str(tmp_path)]) == 0


@pytest.mark.parametrize("name", ["svg", "dxf", "step"])
def test_files_of_the_largest_offset_are_what_they_should_be(name: str, tmp_path: Path) -> None:
    """Before: a space so nearly closed that its ends were one vertex in the file, which failed its check."""
    export = {"format": f'"{name}"', "offset": "9.0"}
    found = refusal(scene_text({"number_of_teeth": "12"}, export)).nearest
    assert found is not None
    (tmp_path / "s.toml").write_text(scene_text({"number_of_teeth": "12"}, export | {"offset": str(found.value)}))
    assert main(["build", "-q", str(tmp_path / "s.toml"), "--out", str(tmp_path)]) == 0


@pytest.mark.parametrize("name", WRONG_KEYS)
def test_a_wrong_key_is_named_with_its_value_and_a_remedy(name: str) -> None:
    part, export, key, value, remedy = WRONG_KEYS[name]
    message = str(refusal(scene_text(part, export)))
    assert key in message
    assert f"{key} = " in message or not value
    for text in (value, remedy):
        assert text in message, message


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (b"", "at least one part"),
        (b"\n# only a comment\n", "at least one part"),
        (b"\x00\x01\x02\xff\xfe", "UTF-8"),
        (bytes(range(256)), "UTF-8"),
        (b"\x00" * 100, "not TOML"),
        (b"[parts.gear\nkind = 1", "line 1: write [parts.gear]"),
        (b"kind = spur_gear", "words stand in straight quotes"),
        (b'{"parts": {}}', "scenes are TOML, not JSON"),
        (b"a = " + b"[" * 5000 + b"]" * 5000, "nested too deeply"),
        # before: in Python's words, by which setting of its own it would be read
        (b"a = 1" + b"0" * 5000, "line 1: a number has 5001 digits, and no more than 4300 are read"),
        (b"#" * 5_000_000, "larger than"),
        (b"[parts]\n", "at least one part"),
        (b"parts = 3\n", "like [parts.gear]"),
        (b"[parts]\ngear = 3\n", "like [parts.gear]"),
        (b"[[parts.gear]]\nkind = 'spur_gear'\n", "like [parts.gear]"),
        (
            b"[boards]\nwidth = 600.0\n[parts.g]\nkind='spur_gear'\n",
            "boards.width = 600.0: its keys stand under a name",
        ),
        (b"[[beds]]\nwidth = 600.0\n[parts.g]\nkind='spur_gear'\n", "beds = [{ width = 600.0 }]: its keys stand under"),
        (
            b"[mates]\nkind = 'fixed'\n[parts.g]\nkind='spur_gear'\n",
            'mates = { kind = "fixed" }: write it as [[mates]]',
        ),
        (
            b"[parts.p]\nkind='plate'\nwidth=9\nheight=9\ncentre=[3,0,1,5]\n",
            "centre = [3, 0, 1, 5]: is not allowed; x, y of the middle: exactly 2 numbers, with a decimal point",
        ),
        (b"exports = 3\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "[[exports]]"),
        (b"exports = [3]\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "exports[1] = 3: write it as"),
        # beside one board, whose thickness its parts take before anything is checked
        (b"assemblies = [5]\n[boards.b]\nthickness = 3\n", "assemblies[1] = 5: write it as [[assemblies]]"),
        (
            b"[boards.b]\nthickness = 3\nparts = true\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n",
            "must be a list in brackets",
        ),
        (b"scene = 3\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "table"),
        (b"[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "has no exports"),
        (b"[scene]\nlanguage='de'\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", '"en", "uk"'),
        (b"[scene]\ntitel='x'\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "did you mean title"),
        # what is long in its own word is not sent to the defaults, where its gear has the other
        (
            b"[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n"
            b"[parts.p]\nkind='pin'\ndiameter=3\nface_width=9\n",
            "did you mean length?",
        ),
        (b"[sceen]\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "did you mean scene"),
        (b"[gears]\n[parts.g]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "unknown table"),
        # a part without parts before its name, or without a header
        (b"[gear]\nkind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "stand under [parts.gear]"),
        (b"kind='spur_gear'\nmodule=1\nnumber_of_teeth=20\n", "stand under [parts.gear]"),
    ],
    ids=lambda value: repr(value)[:25],
)
def test_what_is_no_scene_is_refused(raw: bytes, words: str) -> None:
    assert words in str(refusal(raw))


@pytest.mark.parametrize(
    "name",
    [
        "../up",
        "a/b",
        "a\\b",
        "/etc/x",
        ".",
        "..",
        "",
        "a b",
        "шестерня",
        "a.b",
        "-x",
        "x" * 65,
        "con:",
        "a\nb",
        "a\u0000b",
        "a\n",
    ],
)
def test_a_part_cannot_be_named_like_a_path(name: str) -> None:
    quoted = "".join(f"\\u{ord(c):04x}" for c in name)
    text = scene_text().replace("[parts.gear]", f'[parts."{quoted}"]')
    assert "letters, digits, _ and -" in str(refusal(text))


@pytest.mark.parametrize("name", ["a/b", "..", "", "a b", "x" * 65, "a\\u000a"])
def test_an_export_cannot_be_named_like_a_path(name: str) -> None:
    assert "exports[1].name" in str(refusal(scene_text(export={"name": f'"{name}"'})))


@pytest.mark.parametrize(
    "tail",
    [
        '[[exports]]\nformat = "dxf"',
        '[[exports]]\nformat = "dxf"\nname = "laser"',
        '[[exports]]\nformat = "dxf"\nname = "a"\n[[exports]]\nformat = "dxf"\nname = "a"',
        '[[exports]]\nformat = "dxf"\nparts = ["gear", "gear"]\nname = "b"',
        '[[exports]]\nformat = "svg"\nname = "preview"\n[[exports]]\nformat = "svg"',
    ],
    ids=["same defaults", "the default's name", "same name", "same part twice", "the preview's name"],
)
def test_two_exports_into_one_file_are_refused(tail: str) -> None:
    assert re.search(r"exports\[\d\]", str(refusal(scene_text(tail=tail))))


def test_a_missing_file_a_folder_and_a_hint(tmp_path: Path) -> None:
    for address, words in (
        ("laser_gaer", "did you mean laser_gear"),
        (str(tmp_path / "no.toml"), "no such file"),
        (str(tmp_path), "is a folder"),
        ("", ""),
        (str(tmp_path / "a\0b"), "not a path"),
        ("x" * 5000, ""),
    ):
        with pytest.raises(SceneError) as caught:
            load_scene(address)
        assert words in str(caught.value)
        assert "\n" not in str(caught.value)


def offered_by(error: SceneError) -> float:
    """The number that a refusal says works."""
    assert error.nearest is not None, str(error)
    assert isinstance(error.nearest.value, int | float)
    return error.nearest.value


def builds(text: str, folder: Path) -> bool:
    """Whether a scene gives all its files, each good."""
    plan = plan_build(scene_from_toml(text.encode(), "test.toml", "test"), "test.toml", [], [])
    written = build(plan, folder).written
    return not any(item.failures for item in written)


# changed keys of the part and of the export, and the key that is to blame
SMALL_RACK = {"addendum_coefficient": 0.9, "tip_clearance_coefficient": 0.1}
NEAREST: dict[str, tuple[dict[str, Any], dict[str, Any], str]] = {
    "kerf": ({"bore_diameter": 9.0}, {"kerf": 8.0}, "kerf"),
    "kerf in the bore": ({"bore_diameter": 0.5}, {"kerf": 0.7}, "kerf"),
    "offset out": ({"module": 0.5}, {"offset": 3.0}, "offset"),
    "offset in": ({"module": 0.5}, {"offset": -3.0}, "offset"),
    "offset in on a rim": ({"bore_diameter": 38.0}, {"offset": -1.0}, "offset"),
    "offset of a chamfered tooth": ({"tip_chamfer": 0.3}, {"offset": -9.0}, "offset"),
    "offset of a rounded tooth": ({"tip_rounding": 0.3}, {"offset": -9.0}, "offset"),
    "offset of a relieved tooth": ({"tip_relief": {"depth_coefficient": 0.02}}, {"offset": -9.0}, "offset"),
    "chamfer": ({"tip_chamfer": 3.0}, {}, "tip_chamfer"),
    "huge chamfer": ({"tip_chamfer": 1000.0}, {}, "tip_chamfer"),
    "rounding": ({"tip_rounding": 2.0}, {}, "tip_rounding"),
    "tip circle too large": ({"tip_diameter": 60.0}, {}, "tip_diameter"),
    "tip circle much too large": ({"tip_diameter": 1e5}, {}, "tip_diameter"),
    "tip circle too small": ({"tip_diameter": 30.0}, {}, "tip_diameter"),
    "tip circle much too small": ({"tip_diameter": 0.001, "number_of_teeth": 200}, {}, "tip_diameter"),
    "chamfer below the base circle": ({"tip_chamfer": 0.3, "tip_diameter": 42.0}, {}, "tip_"),
    "thinning": ({"circumferential_thinning": 3.0}, {}, "circumferential_thinning"),
    "deeper cut": ({"circumferential_thinning": 9.0, "thinning_method": "deeper_cut"}, {}, "circumferential_thinning"),
    "pointed by its shift": ({"profile_shift_coefficient": 3.0}, {}, "profile_shift_coefficient"),
    "far too much shift": ({"profile_shift_coefficient": 9.0, "number_of_teeth": 5}, {}, "profile_shift_coefficient"),
    "far too little shift": ({"profile_shift_coefficient": -9.0, "number_of_teeth": 5}, {}, "profile_shift"),
    "undercut by its shift": ({"profile_shift_coefficient": -3.0, "number_of_teeth": 9}, {}, "profile_shift"),
    "few teeth": ({"number_of_teeth": 3, "pressure_angle_deg": 5.0}, {}, ""),
    "steep flanks": ({"pressure_angle_deg": 40.0}, {}, ""),
    "clearance of a rack": ({"basic_rack": {"tip_clearance_coefficient": 1.0, "addendum_coefficient": 1.5}}, {},
                            "basic_rack.tip_clearance_coefficient"),
    "addendum of a rack": ({"basic_rack": {"addendum_coefficient": 3.0}}, {}, "basic_rack.addendum_coefficient"),
    "radius of a rack": ({"basic_rack": {"tip_radius_coefficient": 1.5}}, {}, "basic_rack.tip_radius_coefficient"),
    "depth of a relief": ({"pressure_angle_deg": 35.0, "basic_rack": SMALL_RACK,
                           "tip_relief": {"depth_coefficient": 0.29}}, {}, "tip_relief.depth_coefficient"),
    "depth that points the tooth": ({"pressure_angle_deg": 35.0, "basic_rack": SMALL_RACK,
                                     "tip_relief": {"depth_coefficient": 0.12}}, {}, "tip_relief.depth_coefficient"),
    "height of a relief": ({"tip_relief": {"depth_coefficient": 0.02, "height_coefficient": 2.5}}, {},
                           "tip_relief.height_coefficient"),
    "bore": ({"bore_diameter": 41.0}, {}, "bore_diameter"),
    "bore of a solid": ({"bore_diameter": 41.0}, {"format": "stl"}, "bore_diameter"),
    "stl tolerance": ({"module": 500.0}, {"format": "stl", "tolerance": 1e-5}, "tolerance"),
    "edges": ({"module": 1000.0, "number_of_teeth": 10000}, {"tolerance": 1e-7, "curves": "lines"}, "tolerance"),
}  # fmt: skip


def written_as_toml(value: Any) -> str:
    """A value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {written_as_toml(v)}" for k, v in value.items()) + " }"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def with_values(part: dict[str, Any], export: dict[str, Any]) -> str:
    """A scene with values changed."""
    keys, more = ({k: written_as_toml(v) for k, v in table.items()} for table in (part, export))
    return scene_text(keys, more)


Tables = tuple[dict[str, Any], dict[str, Any]]


def with_offer(part: dict[str, Any], export: dict[str, Any], error: SceneError) -> Tables:
    """Both tables with the offered number at the key that the refusal names."""
    number = offered_by(error)
    table, *keys = re.sub(r"^(parts\.gear|exports\[1\])\.", r"\1|", error.key).split("|")
    assert keys, error.key
    head, _, inner = keys[0].partition(".")
    target = part if table == "parts.gear" else export
    if inner:
        before = target.get(head, {})
        target = target | {head: (before if isinstance(before, dict) else {}) | {inner: number}}
    else:
        target = target | {head: int(number) if head == "number_of_teeth" else number}
    return (target, export) if table == "parts.gear" else (part, target)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.heavy] * (n == "edges")) for n in NEAREST])
def test_the_nearest_value_that_a_refusal_names_does_build(name: str, tmp_path: Path) -> None:
    part, export, key = NEAREST[name]
    error = refusal(with_values(part, export))
    assert key in error.key, str(error)
    changed = with_offer(part, export, error)
    assert changed != (part, export)
    assert builds(with_values(*changed), tmp_path / "out")


def test_the_nearest_kerf_is_near(tmp_path: Path) -> None:
    """A little more than the offered number is refused again: it is a limit, not just any number that works."""
    for key, value in (("kerf", 8.0), ("offset", 5.0), ("offset", -5.0)):
        offer = offered_by(refusal(with_values({}, {key: value})))
        assert "works" in str(refusal(with_values({}, {key: offer * 1.001})))


@pytest.mark.parametrize("name", ["CON.toml", "nul.v2.toml"])
def test_a_file_named_like_a_device_of_windows_is_no_scene(tmp_path: Path, name: str) -> None:
    """Its results would lie in a folder of that name, which Windows cannot make."""
    (tmp_path / name).write_text(scene_text({}, {}), "utf-8")
    with pytest.raises(SceneError, match="is a name that Windows reserves for a device"):
        load_scene(str(tmp_path / name))


@pytest.mark.parametrize(("part", "code", "told"), [
    ({"module": "3,5"}, "decimal_comma", "line 3: a number has a comma; write 3.5"),
    ({"title": '"a\\u0007b"'}, "control_character", "no file can show"),
    *(({"title": f'"{path}"'}, "backslash", r"line 5: a \ within double quotes begins a code: write \\, or")
      for path in (r"D:\U2\p", r"D:\temp\gear", r"D:\gears")),
])  # fmt: skip
def test_slips_of_the_keyboard_are_told_as_such(part: Keys, code: str, told: str) -> None:
    # before: the parser's English of the end of a statement; pictures that no browser opens
    found = refusal(scene_text(part))
    assert found.code == code
    assert told in str(found)


@pytest.mark.parametrize(("export", "told"), [
    ({"drawing": "{ teeth = 2 }"}, 'exports[1].drawing: only for purpose = "part"'),
    *(({"purpose": '"part"', "drawing": f'{{ bore = "{zone}" }}'}, "tolerance zone of bores, A to ZC with a grade of "
       '01 to 18, of J6 to J8 and up to K8 (ISO 286-1): like "H7"') for zone in ("H77", "h7", "Q7", "J9", "K9")),
    *(({"purpose": '"part"', "drawing": f'{{ tip = "{zone}" }}'}, "tolerance zone of the outer diameter, a to zc with "
       'a grade of 01 to 18, of j5 to j8 (ISO 286-1): like "h11"') for zone in ("H7", "j9", "j4")),
    ({"purpose": '"part"', "drawing": '{ requirements = [""] }'}, "words"),
    ({"purpose": '"part"', "drawing": '{ requirements = ["   "] }'}, "words"),
    ({"purpose": '"part"', "drawing": f'{{ requirements = ["{"a" * 301}"] }}'}, "at most 300 characters"),
    ({"purpose": '"part"', "drawing": f"{{ requirements = {['a'] * 13} }}"}, "at most 12"),
])  # fmt: skip
def test_a_working_drawing_is_told_the_form_that_its_keys_have(export: Keys, told: str) -> None:
    # before: a record of Python, neither form nor limit
    assert told in str(refusal(scene_text(export=export)))


@pytest.mark.parametrize(("typed", "told"), [
    ("mоdule = 4.0", "the letter «о» at place 2 of mоdule is Cyrillic"),
    ("[pаrts.wheel]", "the letter «а» at place 2 of pаrts is Cyrillic"),
    ("module = 1З", "the letter «З» at place 2 of 1З is Cyrillic"),
    ('[parts.p]\nkind = "рlаte"', "the letter «р» at place 1 of рlаte is Cyrillic; did you mean plate?"),
    ('[parts.p]\nkind = "plate"\n"widtһ" = 3', "the letter «һ» at place 5 of widtһ is Cyrillic; did you mean width?"),
])  # fmt: skip
def test_cyrillic_letters_that_look_like_latin_ones_are_named(typed: str, told: str) -> None:
    # before: only that no "=" stands after the key, or "did you mean plate?" of what looks like plate
    assert told in str(refusal(typed))


def test_words_in_cyrillic_are_no_slip() -> None:
    assert "Cyrillic" not in str(refusal('[parts.p]\nkind = "шестерня"'))
    # the key alone is to blame for being unknown, not its value
    assert "Cyrillic" not in str(refusal('[parts.p]\nkind = "plate"\n"модуль" = "Х"'))
    # a word of a letter that Latin has too
    assert "Cyrillic" not in str(refusal(f'[parts.p]\nkind = "plate"\nlabel = "довга і {"ш" * 60}"'))


def test_a_bed_too_low_is_told_by_its_height() -> None:
    bed = "[beds.b]\nwidth = 200\ndepth = 200\nheight = 2\n"
    found = refusal(scene_text(export={"format": '"3mf"', "purpose": '"plate"'}, tail=bed))
    assert (found.key, found.code) == ("beds.b.height", "too_small_for_parts")


def test_a_board_of_no_pieces_is_refused() -> None:
    # before: a traceback of an empty layout
    board = "[boards.b]\nwidth = 200\nheight = 200\nthickness = 3\ncopies = { gear = 0 }\n"
    found = refusal(scene_text({"face_width": "3.0"}, {"format": '"dxf"', "purpose": '"board"'}, board))
    assert (found.key, found.code) == ("boards.b.copies", "nothing_is_laid")


@pytest.mark.parametrize(("line", "kept"), [
    ("kind spur_gear", "'='"), ("module = *", ""), ('["parts".g', "']'"), ('[parts.g]\n[parts."g"]', "parts.g"),
    ("a = [1", ""), ("a = {b = 1", ""), ('a = "1" b', ""),
    ("a = 2026-13-01", ""), ('a = "\x01"', "'\\x01'"),
])  # fmt: skip
def test_what_is_no_toml_is_told_in_the_language_of_the_scene(
    line: str, kept: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the place; English is tomllib's own sentence, keys as they are typed."""
    file = tmp_path / "s.toml"
    for language in ("uk", "en"):
        text = f'[scene]\nlanguage = "{language}"\n{line}\n'
        file.write_text(text, encoding="utf-8")
        assert main(["check", str(file)]) == 2
        said = capsys.readouterr().err
        with pytest.raises(tomllib.TOMLDecodeError) as own:
            tomllib.loads(text)
        sentence = str(own.value).replace("('parts', 'g')", "parts.g")
        assert (sentence in said) is (language == "en"), said
        assert kept in said
        if language == "uk":
            rest = said.replace(str(file), "").replace(kept, "").replace("higherpair", "").partition(";")[0]
            assert not re.search("[A-Za-z]{5}", rest), said


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("kind = plate", 'line 2: words stand in straight quotes: kind = "plate"'),
        ("title = Моє колесо  # з отвором", 'line 2: words stand in straight quotes: title = "Моє колесо"'),
        ("kind = «plate»", 'line 2: words stand in straight quotes: kind = "plate"'),
        ("phases = [{ move = rise, angle_deg = 30.0 }]", 'line 2: words stand in straight quotes: move = "rise"'),
        ('title = "Moє', "line 2: the quotes of title are not closed"),
        ("label = True", "line 2: write label = true"),
        ("frame = так", "line 2: write frame = true"),
        ("frame = ні  # without", "line 2: write frame = false"),
        ("lift = 30 mm", "line 2: numbers stand without units: lift = 30"),
        ("lift = 0.1 мм # play", "line 2: numbers stand without units: lift = 0.1"),
        ("lift = 0.5 cm", "lengths in mm, angles in degrees: lift = 5"),
        ("lift = 1.25 см.  # twelve and a half", "lengths in mm, angles in degrees: lift = 12.5"),
        ("lift = 2 Inches", "lengths in mm, angles in degrees: lift = 50.8"),
        ('lift = 0.25"', "lengths in mm, angles in degrees: lift = 6.35"),
        ("lift = 0.25 \u2033  # of an inch", "lengths in mm, angles in degrees: lift = 6.35"),
        ("lift = 3 дюйми", "lengths in mm, angles in degrees: lift = 76.2"),
        ("lift = 250 \u00b5m", "lengths in mm, angles in degrees: lift = 0.25"),
        ("angle_deg = 0.5 рад", "lengths in mm, angles in degrees: angle_deg = 28.6478897565"),
        ('tools = "a", "b"', 'line 2: a list stands in brackets: tools = ["a", "b"]'),
        ("teeth = 24, 30, 84", "line 2: a list stands in brackets: teeth = [24, 30, 84]"),
        ("підйом = 30.0", "line 2: підйом is no key: keys are Latin"),
        ("[parts.колесо]", "line 2: колесо is no name: letters A to Z, digits, _ and -; what people"),
        ("[[ шестерня ]]  # one", "line 2: шестерня is no name"),
        ("[parts.my wheel]", "line 2: my wheel is no name"),
        ("[parts.wheel+]", "line 2: wheel+ is no name"),
        ('[exports]\nformat = "dxf"\n[[exports]]\nformat = "stl"', "line 2: write [[exports]]"),
        ("module = 2.0\nmodule = 3.0", "line 3: module stands there a second time; remove one"),
        (
            "[parts.g]\n[parts.g]  # too",
            "line 3: [parts.g] stands there a second time; give it another name",
        ),
        ("module =  # mm", "line 2: module has no value"),
        ("module", "line 2: module has no value"),
        ("module == 2", "line 2: write module = 2"),
        ("module := 2", "line 2: write module = 2"),
        ("module = 02", "line 2: write module = 2"),
        ("module = 007.50", "line 2: write module = 7.50"),
        ("kind = `plate`", 'line 2: words stand in straight quotes: kind = "plate"'),
        ("kind = 'plate\"", "line 2: the quotes of kind are not closed"),
        ("[checks]\n[[checks]]", "line 3: [checks] stands there a second time"),
        ("[mates]\n[[mates]]", "line 2: write [[mates]]"),
        ("module (mm) = 2.0", "line 2: write module = 2.0"),
        ("module[mm] = 2.0  # of all", "line 2: write module = 2.0"),
        ("module = (2.5)", "line 2: write module = 2.5"),
        ("[parts.wheel", "line 2: write [parts.wheel]"),
        ("parts.wheel]  # the second", "line 2: write [parts.wheel]"),
        ("(parts.wheel)", "line 2: write [parts.wheel]"),
        ("[parts.wheel]]", "line 2: write [parts.wheel]"),
        ("[[mates]", "line 2: write [[mates]]"),
        ("mates]]", "line 2: write [[mates]]"),
        ("[scene", "line 2: write [scene]"),
        ("share = 20%", "line 2: a share is written as a number, without %: share = 0.2"),
        ("speed = 0.5 м/с", "line 2: numbers stand without units: speed = 0.5"),
        ("area = 3 mm²  # of all", "line 2: numbers stand without units: area = 3"),
        ("at = (0, -1.5, 3)", "line 2: a list stands in brackets: at = [0, -1.5, 3]"),
        ("table = [[0, 1], [60; 4.5]]", "line 2: commas part the items of a list, not semicolons"),
        ("module = 2.0; bore_diameter = 3.0", "line 2: each key stands on a line of its own"),
        ('kind = "plate" width = 3.0', "line 2: each key stands on a line of its own"),
        ('title = "a" b  # c = 3', "is not TOML"),
        ("// a cam", "line 2: a comment begins with #"),
        ("; a cam", "line 2: a comment begins with #"),
        ("\u00a0module = 2.0", "line 2: has a character that nobody sees (U+00A0)"),
        ("\u00a0[scene]", "line 2: has a character that nobody sees (U+00A0)"),
        ("lift = 30,5", "line 2: a number has a comma; write 30.5 with a point"),
        ("lift = .5", "line 2: write lift = 0.5"),
        ("lift = -2.  # down", "line 2: write lift = -2.0"),
        ("x: 2.0", "line 2: write x = 2.0"),
        ('kind: "plate"', 'line 2: write kind = "plate"'),
        ("holes: [];", "line 2: write holes = []"),
        ("lift = 2.0;", "line 2: write lift = 2.0"),
        ("lift = 2.0 // mm", "line 2: write lift = 2.0"),
        ("start_deg = 20\u00b0", "line 2: write start_deg = 20"),
        ("x = \u22120.25", "line 2: write x = -0.25"),
        ("x\u00a0= 0.25", "line 2: write x = 0.25"),
        ("lift = 25.4/8  # inches", "line 2: nothing is calculated in a scene; write lift = 3.175"),
        ("module = (2 * 3)", "line 2: nothing is calculated in a scene; write module = 6"),
        ('title = ""Wheel""', 'line 2: write title = "Wheel"'),
        ("title = 'don't'", 'line 2: write title = "don\'t"'),
        ('title = "a "b" c"', "line 2: write title = 'a \"b\" c'"),
        ('"kind": "plate",', 'line 2: write kind = "plate"'),
        ("number of teeth = 20", "line 2: write number_of_teeth = 20"),
        ("bore = { diameter: 5 }", "line 2: between a key and its value stands =, not a colon"),
        ('phases = [{"move": "rise"}]', "line 2: between a key and its value stands =, not a colon"),
        ("phases = [\n  { move: 1 }\n]", "line 3: between a key and its value stands =, not a colon"),
        (
            "bore = {\n  diameter = 5,  # mm\n}",
            "line 2: a table in braces stands on one line, with no comma at its end: { diameter = 5 }",
        ),
        (
            "phases = [\n  { a = [1],\n    b = { c = 2, } },\n]",
            "line 3: a table in braces stands on one line, with no comma at its end: { a = [1], b = { c = 2 } }",
        ),
        ("bore = { a = {\n  b = 1 } }", "with no comma at its end: { a = { b = 1 } }"),
        ("bore = { diameter = 5, }", "with no comma at its end: { diameter = 5 }"),
        ("bore = { diameter = 5", "is not TOML: Unclosed inline table"),
        ("<scene>", "line 2: scenes are TOML, not XML"),
        ("gear:", "line 2: scenes are TOML, not YAML"),
        # what is wrong in another way is told as before
        ("a = [1\nlift = 2.0", "is not TOML"),
        ("lift = .", "is not TOML"),
        ("lift = 1/0", "is not TOML"),
        ("lift = 1/0 mm", "is not TOML"),
        ("kind = 3.5.6", "is not TOML"),
        ("kind = [plate", "is not TOML"),
        ('["parts".g', "is not TOML"),
        ("[parts.whееl]", "the letter «е» at place 3"),
    ],
)
def test_words_without_quotes_are_told_by_their_key(line: str, told: str) -> None:
    with pytest.raises(SceneError) as caught:
        scene_from_toml(f"[parts.p]\n{line}\n".encode(), "s.toml", "s")
    assert told in str(caught.value)


def test_a_language_that_is_none_is_refused_in_the_one_that_was_meant(tmp_path: Path) -> None:
    for asked, told in (("ua", "uk"), ("ukr", "uk"), ("eng", "en"), ("xx", "en")):
        (file := tmp_path / f"{asked}.toml").write_text(f'[scene]\nlanguage = "{asked}"\n', encoding="utf-8")
        assert language_of(str(file)) == told


@pytest.mark.parametrize(
    ("where", "table", "key"),
    [
        ("scene", {"title": {"en": "Pin", "uk": -1}}, "scene.title.uk"),
        ("scene", {"notes": {"en": ["Turn it."], "uk": "Оберніть."}}, "scene.notes.uk"),
        ("scene", {"notes": {"en": ["Turn it."], "uk": ["Оберніть.", 1]}}, "scene.notes.uk[2]"),
        ("pin", {"label": {"en": "P", "uk": 2.5}}, "parts.pin.label.uk"),
        ("pin", {"material": {"en": "steel", "uk": ["сталь"]}}, "parts.pin.material.uk"),
    ],
)
def test_words_of_the_language_that_is_not_told_are_words_too(where: str, table: dict[str, Any], key: str) -> None:
    pin = {"kind": "pin", "diameter": 3.0, "length": 5.0, **(table if where == "pin" else {})}
    scene = {"scene": {"language": "en", **(table if where == "scene" else {})}, "parts": {"pin": pin}}
    with pytest.raises(SceneError) as caught:
        scene_from_dict(scene, "s.toml", "s")
    assert (caught.value.key, caught.value.code) == (key, "wrong_type")


@pytest.mark.parametrize("asked", ["ua", "UA", "ukr", "Ukrainian"])
def test_a_language_of_a_command_that_is_none_is_refused_in_the_one_that_was_meant(
    asked: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build", "lesson_5", "--language", asked]) == 2
    assert "можливо, " in capsys.readouterr().err


def test_a_number_in_quotes_with_a_comma_is_told_how_to_write_it() -> None:
    with pytest.raises(SceneError) as caught:
        scene_from_toml(b'[parts.a]\nkind = "spur_gear"\nmodule = "2,5"\nnumber_of_teeth = 20\n', "s.toml", "s")
    assert (caught.value.key, caught.value.code) == ("parts.a.module", "comma_in_number")
    # a list in brackets was offered too, which is refused again
    assert str(caught.value).endswith("write 2.5 with a point")


def test_a_comma_in_a_whole_number_is_told_that_it_must_be_whole() -> None:
    # before: write 2.5 with a point, which is refused again
    with pytest.raises(SceneError) as caught:
        scene_from_toml(b'[parts.a]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = "2,5"\n', "s.toml", "s")
    assert (caught.value.key, caught.value.code) == ("parts.a.number_of_teeth", "wrong_type_of")
    assert "must be a whole number" in str(caught.value)


@pytest.mark.parametrize("value", [-0.0, -1e-300])
def test_a_default_that_rounding_makes_0_is_told_as_it_was_written(value: float) -> None:
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
    with pytest.raises(SceneError) as caught:
        scene_from_dict({"defaults": {"face_width": value}, "parts": {"a": gear}}, "s.toml", "s")
    assert caught.value.key == "parts.a: defaults.face_width"
    assert str(caught.value).startswith(f"s.toml: parts.a: defaults.face_width = {value}: is not allowed")


@pytest.mark.parametrize(("typed", "place", "ours"), [
    ('[parts.a]\ntype = "spur_gear"\nmodule = 2.0\n', "parts.a.type", "kind"),
    ('[parts.a]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 20\nbore = { type = "D" }\n',
     "parts.a.bore.type", "shape"),
    ('[parts.a]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 20\n[[exports]]\ntype = "dxf"\n',
     "exports[1].type", "format"),
])  # fmt: skip
def test_a_type_is_told_by_the_key_that_says_it(typed: str, place: str, ours: str) -> None:
    # before: that kind, shape or format is missing
    with pytest.raises(SceneError) as caught:
        scene_from_toml(typed.encode(), "s.toml", "s")
    assert (caught.value.key, caught.value.code) == (place, "unknown_key")
    assert caught.value.nearest == Nearest(ours, "meant")


def test_a_line_of_any_length_is_refused_in_a_short_one() -> None:
    text = '[parts.a]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 20\n'
    for long in (f"{text}{'x' * 100_000} = 1\n", text.replace("parts.a", f"parts.{'x' * 100_000}")):
        with pytest.raises(SceneError) as caught:
            scene_from_toml(long.encode(), "s.toml", "s")
        assert len(str(caught.value)) < 500


@pytest.mark.parametrize(
    ("keys", "place"),
    [
        ({"turns": 0.0}, "turns"),
        ({"material": "no such"}, "material"),
        ({"normal_backlash": 30.0}, "normal_backlash"),
        (
            {
                "scheme": "david",
                "teeth": [100, 101, 100, 99],
                "identical": False,
                "shifts": [0.3] * 4,
                "working_centre_distance": 200.0,
            },
            "working_centre_distance",
        ),
    ],
)
def test_a_key_that_an_assembly_hands_on_is_told_where_it_was_typed(keys: dict[str, Any], place: str) -> None:
    table = {"kind": "planetary_set", "teeth": [24, 24, 72], "module": 2.0, **keys}
    with pytest.raises(SceneError) as refused:
        plan_build(scene_from_dict({"assemblies": [table], "exports": [{"format": "svg"}]}, "t", "t"), "t", [], [])
    assert refused.value.key == f"assemblies[1].{place}"


@pytest.mark.parametrize(
    ("part", "key", "told"),
    [
        ({"kind": None, "knd": '"spur_gear"'}, "parts.gear.knd", "did you mean kind?"),
        ({"bore": '{ shpe = "round", diameter = 5.0 }'}, "parts.gear.bore.shpe", "did you mean shape?"),
        ({"label": '{ ku = "x" }'}, "parts.gear.label.ku", "known keys: en, uk; did you mean uk?"),
    ],
)
def test_a_misspelt_key_is_told_as_it_was_typed(part: Keys, key: str, told: str) -> None:
    found = refusal(scene_text(part))
    assert (found.key, found.code) == (key, "unknown_key")
    assert told in str(found)


@pytest.mark.parametrize(
    ("part", "key"),
    [
        # before: pin_diameter, which is there and known, was told to be no key and to mean pin_circle_diameter
        ({"kind": '"output_plate"', "number_of_pins": 6, "pin_diameter": 6.0, "module": None, "number_of_teeth": None},
         "parts.gear.pin_circle_diameter"),
        ({"holes": "{ count = 5, diameter = 3.0 }"}, "parts.gear.holes.pitch_circle_diameter"),
    ],
)  # fmt: skip
def test_a_missing_key_is_not_taken_for_one_like_it(part: Keys, key: str) -> None:
    found = refusal(scene_text(part))
    assert (found.key, found.value, found.code) == (key, None, "missing_key")


def test_of_a_long_list_what_is_like_the_word_is_told() -> None:
    few = str(refusal(scene_text({"modul": "2"})))
    assert re.search(r"known keys: module and \d+ more, see `higherpair new spur_gear`; did you mean module\?$", few)
    # no word of it is like this one
    assert "did you mean" not in str(refusal(scene_text({"material": '"nonsense"'})))


def test_a_range_has_its_unit_in_the_form_of_its_last_number() -> None:
    assert str(refusal(scene_text({"tip_relief": "{ depth_coefficient = 5.0 }"}))).endswith("modules")
    told = {"kind": '"bevel_gear"', "mate_number_of_teeth": "40", "tip_clearance_coefficient": "9.0"}
    found = refusal(scene_text(told))
    assert str(found).endswith("at most 1 module")
    assert sentence(found, "uk").endswith("щонайбільше 1 модуль")


@pytest.mark.parametrize(
    ("tables", "key", "where"),
    [
        ({"parts": {"a": {"kind": "planetary_set"}}}, "parts.a.kind", "[[assemblies]]"),
        ({"parts": {"a": {"kind": "chain_drive"}}}, "parts.a.kind", "[[mates]]"),
        ({"assemblies": [{"kind": "spur_gear"}]}, "assemblies[1].kind", "[parts.NAME]"),
    ],
)
def test_a_kind_of_other_tables_is_told_where_it_belongs(tables: dict[str, Any], key: str, where: str) -> None:
    with pytest.raises(SceneError, match=re.escape(f"belongs in a table {where}")) as refused:
        scene_from_dict(tables, "t", "t")
    assert refused.value.key == key


@pytest.mark.parametrize("key", ["hand", "module", "tip_relief", "face_width", "number_of_teeth"])
@pytest.mark.parametrize("value", ["1" + "0" * 400, '"1' + "0" * 400 + ' mm"', "inf", "nan"])
def test_a_number_beyond_all_is_refused_by_its_key(key: str, value: str) -> None:
    """Of a type that the key does not take it ended in a traceback."""
    assert refusal(scene_text({key: value})).key == f"parts.gear.{key}"


@pytest.mark.parametrize("kind", [["chain_drive"], {"chain_drive": 1}, 3])
def test_a_kind_that_is_no_text_is_unknown(kind: object) -> None:
    with pytest.raises(SceneError, match="unknown kind") as refused:
        scene_from_dict({"parts": {"a": {"kind": kind}}}, "t", "t")
    assert refused.value.key == "parts.a.kind"


@pytest.mark.parametrize(
    ("word", "known", "ours"),
    [
        ("модуль", ("module", "mode"), "module"),
        ("кількість_пазів", ("number_of_teeth", "number_of_slots", "face_width"), "number_of_slots"),
        ("зубців", ("number_of_teeth", "face_width"), "number_of_teeth"),
        ("ширина вінця", ("width", "face_width"), "face_width"),
        ("КУТ_НАХИЛУ", ("pressure_angle_deg", "helix_angle_deg"), "helix_angle_deg"),
        ("бочкоподібність", ("crowning", "module"), "crowning"),
        ("start_deg", ("angle_deg", "spacing_deg"), "angle_deg"),
        ("підйом", ("lift", "phases"), "lift"),
        ("черв’як", ("worm_wheel", "worm"), "worm"),
        ("черв'ячне колесо", ("worm", "worm_wheel"), "worm_wheel"),
        ("шестерня", ("ring_gear", "spur_gear"), "spur_gear"),
        ("конічне колесо", ("spur_gear", "bevel_gear"), "bevel_gear"),
        ("абищо", ("spur_gear", "bevel_gear"), None),
        # it stands amid what is told of diameters; and a number of teeth is no number
        ("підріз", ("diameter", "module"), None),
        ("ролик стола", ("role", "module"), None),
    ],
)
def test_words_of_other_languages_lead_to_ours(word: str, known: tuple[str, ...], ours: str | None) -> None:
    """A student's own word led nowhere: its translation does."""
    found = meant(word, known)
    assert (found and found.value) == ours


def test_a_key_in_other_letters_is_told_which_it_is() -> None:
    for typed in ("модуль = 2.0", '"модуль" = 2.0'):
        told = refusal(scene_text({"module": None}).replace("[parts.gear]", f"[parts.gear]\n{typed}"))
        assert told.nearest == Nearest("module", "meant")
