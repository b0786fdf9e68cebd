"""Junk in every place of a scene: refused in one line or built, never anything else, and soon."""

from __future__ import annotations

import contextlib
import datetime
import json
from html import escape
from typing import Any
from xml.etree import ElementTree

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from exporters.command.cli import main
from exporters.formats.registry import shape_of
from exporters.production.plan import plan_build
from geometry.base.errors import GeometryError
from parts.base.refusal import SceneError
from parts.base.schema import plain_numbers
from parts.gears.spur_gear.part import RackTable, ReliefTable, SpurGearSpec
from parts.scene.load import scene_from_dict, scene_from_resolved, scene_from_toml
from parts.scene.scene_file import ExportSpec, SceneInfo
from tests.sampling import examples

# long enough for any machine under load; what hangs takes for ever
PATIENCE = datetime.timedelta(seconds=60)


def keys_of(*owners: Any) -> list[str]:
    """All keys that a user may write."""
    return ["kind", *(key for owner in owners for key in owner.__struct_encode_fields__)]


PART_KEYS = keys_of(SpurGearSpec, RackTable, ReliefTable)
EXPORT_KEYS = keys_of(ExportSpec)[1:]
KEYS = ["scene", "parts", "exports", "gear", *PART_KEYS, *EXPORT_KEYS, *keys_of(SceneInfo)]
numbers = st.one_of(
    st.floats(),
    st.floats(-10, 60),
    st.integers(),
    st.integers(-5, 60),
    st.just(10**400),
    st.sampled_from([0.0, -0.0, 5e-324, 1.8e308, 2**63, -(2**63) - 1, 1e-7, 1e12, 3, 10_000, 1000, 100_000]),
)
words = st.one_of(
    st.text(max_size=12),
    st.sampled_from(["dxf", "svg", "stl", "laser", "print", "arcs", "lines", "R12", "ISO 53 D", "GOST 13755", "gear"]),
    st.sampled_from(["spur_gear", "uk", "deeper_cut", "#c08040", "../x", "`$.a`", " - at `$.a`", "unknown field `x`"]),
)
dates = st.one_of(st.dates(), st.times(), st.datetimes())
scalars = st.one_of(numbers, words, st.booleans(), dates)
keys = st.one_of(st.sampled_from(KEYS), st.text(max_size=8))
values = st.recursive(
    scalars, lambda part: st.one_of(st.lists(part, max_size=3), st.dictionaries(keys, part, max_size=4)), max_leaves=8
)


def survives(raw: dict[str, Any]) -> bool:
    """Whether a scene is accepted; everything but a one-line refusal is an error of the test."""
    try:
        plan = plan_build(scene_from_dict(raw, "junk.toml", "junk"), "junk.toml", [], [])
    except SceneError as error:
        text = str(error)
    else:
        assert plan.jobs
        return True
    assert "\n" not in text, text
    assert len(text) < 2000
    return False


def sound() -> dict[str, Any]:
    """A scene that builds, to put junk into."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23}
    return {"scene": {"title": "t"}, "parts": {"gear": gear}, "exports": [{"format": "dxf"}]}


def test_the_sound_scene_is_sound() -> None:
    assert survives(sound())


@examples(20, deadline=PATIENCE)
@given(st.sampled_from(["", "scene", "parts", "gear", "exports"]), keys, values)
def test_junk_at_one_key(table: str, key: str, value: Any) -> None:
    raw = sound()
    places = {
        "": raw,
        "scene": raw["scene"],
        "parts": raw["parts"],
        "gear": raw["parts"]["gear"],
        "exports": raw["exports"][0],
    }
    places[table][key] = value
    survives(raw)


@examples(200, deadline=PATIENCE)
@given(
    st.dictionaries(st.sampled_from(PART_KEYS), values, max_size=6),
    st.lists(st.dictionaries(st.sampled_from(EXPORT_KEYS), values, max_size=4), max_size=3),
)
def test_junk_at_many_known_keys(gear: dict[str, Any], exports: list[dict[str, Any]]) -> None:
    raw = sound()
    raw["parts"]["gear"] |= gear
    raw["exports"] += exports
    survives(raw)


@examples(100, deadline=PATIENCE)
@given(st.dictionaries(keys, values, max_size=4))
def test_junk_instead_of_a_scene(raw: dict[str, Any]) -> None:
    survives(raw)


@examples(200, deadline=PATIENCE)
@given(st.binary(max_size=200))
@example(b"\xef\xbb\xbf")
def test_bytes_instead_of_a_file(data: bytes) -> None:
    with pytest.raises(SceneError):
        scene_from_toml(data, "junk.toml", "junk")


legal_gears = st.fixed_dictionaries(
    {"kind": st.just("spur_gear"), "module": st.floats(1e-6, 1000), "number_of_teeth": st.integers(3, 10_000)},
    optional={
        "profile_shift_coefficient": st.floats(-10, 10),
        "pressure_angle_deg": st.floats(5, 45),
        "basic_rack": st.one_of(
            st.sampled_from(["ISO 53 A", "ISO 53 D"]),
            st.fixed_dictionaries(
                {},
                optional={
                    "addendum_coefficient": st.floats(0.1, 3),
                    "tip_clearance_coefficient": st.floats(0, 1),
                    "tip_radius_coefficient": st.floats(0, 2),
                },
            ),
        ),
        "tip_diameter": st.floats(1e-9, 100_000),
        "circumferential_thinning": st.floats(0, 1000),
        "thinning_method": st.sampled_from(["wider_rack_tooth", "deeper_cut"]),
        "tip_relief": st.fixed_dictionaries(
            {"depth_coefficient": st.floats(0, 0.3)}, optional={"height_coefficient": st.floats(0.01, 3)}
        ),
        "tip_chamfer": st.floats(0, 1000),
        "tip_rounding": st.floats(0, 1000),
        "bore_diameter": st.floats(0, 100_000),
        "face_width": st.floats(0.01, 10_000),
    },
)
legal_exports = st.fixed_dictionaries(
    {"format": st.sampled_from(["dxf", "svg", "stl"])},
    optional={"tolerance": st.floats(1e-7, 1), "kerf": st.floats(0, 10), "curves": st.sampled_from(["arcs", "lines"])},
)


@examples(150, deadline=PATIENCE)
@given(legal_gears, legal_exports)
def test_every_key_in_its_range_but_together_impossible(gear: dict[str, Any], export: dict[str, Any]) -> None:
    survives({"parts": {"g": gear}, "exports": [export]})


@examples(150, deadline=PATIENCE)
@given(st.floats(0.05, 50), st.integers(3, 60), st.data())
def test_ordinary_gears_with_one_key_anywhere_in_its_range(module: float, teeth: int, data: st.DataObject) -> None:
    gear = {"kind": "spur_gear", "module": module, "number_of_teeth": teeth}
    drawn = data.draw(legal_gears)
    for key in data.draw(st.lists(st.sampled_from(sorted(drawn)), max_size=2)):
        gear.setdefault(key, drawn[key])
    survives({"parts": {"g": gear}, "exports": [data.draw(legal_exports)]})


SMALL = {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 20}


@pytest.mark.heavy
@settings(max_examples=1500, deadline=PATIENCE)
@given(legal_gears, legal_exports)
@example(SMALL | {"tip_chamfer": 1e-20}, {"format": "dxf"})
def test_what_is_planned_can_be_approximated_or_is_refused(gear: dict[str, Any], export: dict[str, Any]) -> None:
    """The step after the plan, still before any byte is written."""
    from exporters.production.build import approximated

    gear["number_of_teeth"] = 3 + gear["number_of_teeth"] % 200
    raw = {"parts": {"g": gear}, "exports": [export]}
    if survives(raw):
        plan = plan_build(scene_from_dict(raw, "junk.toml", "junk"), "junk.toml", [], [])
        try:
            made, _ = approximated(plan.jobs[0], "junk.toml", plan.jobs)
        except SceneError as error:
            if "tolerance" not in error.key:
                raise
        else:
            assert all(a.max_error <= plan.jobs[0].export.tolerance for a in made)


@examples(150, deadline=PATIENCE)
@given(st.dictionaries(keys, values, max_size=3), st.lists(values, max_size=2))
def test_a_tampered_report_is_refused_like_a_scene(parts: dict[str, Any], exports: list[Any]) -> None:
    """What a report keeps is data like any other; its tables may hold null for keys that were not given."""
    data = {"name": "s", "parts": parts, "exports": [e for e in exports if isinstance(e, dict)]}
    with contextlib.suppress(SceneError):
        assert scene_from_resolved(data, "report.json").parts


def test_what_rounding_leaves_of_nothing_is_nothing() -> None:
    read = {"a": [1e-13, -5e-324, -1e-12, 3], "b": {"c": -0.0, "d": "1e-20", "e": True}}
    told = plain_numbers(read, "s", "")
    assert told == {"a": [0.0, 0.0, -1e-12, 3], "b": {"c": 0.0, "d": "1e-20", "e": True}}
    assert json.dumps(told).count("-") == 3
    with pytest.raises(SceneError, match=r"b\.c\[2\] = inf"):
        plain_numbers({"b": {"c": [0.0, float("inf")]}}, "s", "")


def test_words_that_xml_cannot_hold_are_refused() -> None:
    """By a parser of XML, which pictures, 3MF and readers of SVG go through; letters and ends of lines are kept."""
    for code in (*range(0x180), 0x44F, 0xFFFD, 0xFFFE, 0xFFFF, 0x1F600):
        word = f"a{chr(code)}b"
        try:
            ElementTree.fromstring(f"<t>{escape(word)}</t>")
        except ElementTree.ParseError:
            with pytest.raises(SceneError, match=r"scene\.title = .*: has a character that no file can show"):
                plain_numbers({"scene": {"title": word}}, "s", "")
        else:
            # what steers a terminal is refused too
            if not 0x7F <= code <= 0x9F:
                assert plain_numbers({"scene": {"title": word}}, "s", "") == {"scene": {"title": word}}


def test_a_refusal_tells_what_rounding_left_out_as_it_was_written(capsys: pytest.CaptureFixture[str]) -> None:
    raw = sound()
    raw["parts"]["gear"]["module"] = -1e-20
    with pytest.raises(SceneError, match="module = -1e-20: "):
        scene_from_dict(raw, "s", "s")
    raw["parts"]["gear"] |= {"module": 2.0, "holes": [{"count": 3, "diameter": 1e-20, "pitch_circle_diameter": 20.0}]}
    with pytest.raises(SceneError, match=r"holes\[1\].diameter = 1e-20: "):
        scene_from_dict(raw, "s", "s")
    assert main(["calc", "spur", "module=1e-20", "number_of_teeth=20"]) == 2
    assert "spur.module = 1e-20: " in capsys.readouterr().err


@pytest.mark.sampled(1)
@pytest.mark.parametrize("keys", ["working_centre_distance=1.5", "pressure_angle_deg=5"])
def test_sets_whose_shifts_leave_no_tooth_are_told_without_shifts(
    keys: str, capsys: pytest.CaptureFixture[str]
) -> None:
    # before: a traceback of the fillet of a tooth that is none
    assert main(["calc", "planetary", "ratio=2.5", keys]) == 0
    assert "no shifts keep least_tip_thickness and least_contact_ratio" in capsys.readouterr().out


@pytest.mark.parametrize(("pin", "offer", "beyond"), [(0.5, 0.5863, 0.5862), (5.0, 4.8551, 4.8552)])
def test_pins_that_touch_no_spline_tell_the_least_and_the_most(
    pin: float, offer: float, beyond: float, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of the shaft and of the hub; before, neither."""
    for value, code in ((pin, 2), (offer, 0), (beyond, 2)):
        assert main(["calc", "involute-spline", "size=50x2", f"pin_diameter={value}"]) == code
    assert f"at {'least' if pin < offer else 'most'} {offer} mm works" in capsys.readouterr().err


@pytest.mark.parametrize(("key", "value"), [("chamfer", 1.5), ("chamfer", 50.0), ("clearance", 2.0)])
def test_small_sizes_of_a_spline_are_told_by_their_own_key(
    key: str, value: float, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before, a traceback of a rounding that nobody typed, the designation blamed, no offer."""
    asked = ["calc", "spline", "size=d-6x23x26"]
    assert main([*asked, f"{key}={value}"]) == 2
    line = capsys.readouterr().err
    assert f"spline.{key} = {value}: " in line
    offer = float(line.split("at most ")[1].split()[0])
    assert [main([*asked, f"{key}={own}"]) for own in (offer, offer + 1e-3)] == [0, 2]


@pytest.mark.parametrize(("words", "told"), [
    # before: tracebacks of a number that Python does not read, and of a file without a name
    (["spur", f"module=1{'0' * 5000}", "number_of_teeth=20"], "must be a number; module m"),
    (["shift-choice", "practicum_pair", "picture="], 'ending of such a file: .svg, .dxf; "contour.svg" works'),
    # before: what it is, not what one looks like
    (["spur", "module=2", "number_of_teeth=20", "accuracy={}"], 'is missing: grade and kind of mate: like "8-B"'),
    (["spur", "module=2", "number_of_teeth=20", "title={}"], "name for people, in any script: at least 1"),
])  # fmt: skip
def test_junk_for_a_calculation_is_refused_in_one_line(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["calc", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert told in line


@pytest.mark.parametrize("depth", [100, 900, 5000])
def test_the_deepest_table_is_no_trouble(depth: int) -> None:
    """Dotted keys nest without brackets, so that no parser stops them."""
    for head in ("parts.gear.tip_relief", "parts.gear", "scene", "deep"):
        text = f"[{head}{'.a' * depth}]\nb = 1\n"
        with pytest.raises(SceneError) as caught:
            scene_from_toml(text.encode(), "junk.toml", "junk")
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize("key", ["tip_chamfer", "tip_rounding", "bore_diameter", "circumferential_thinning"])
@pytest.mark.parametrize("value", [5e-324, 1e-132, 1e-20, 1e-15, 1e-9])
def test_a_length_of_almost_nothing(key: str, value: float) -> None:
    """It has an outline or is refused; nothing divides by it."""
    outlined(sound(), key, value)


@pytest.mark.parametrize("key", ["tip_chamfer", "tip_rounding"])
@pytest.mark.parametrize("value", [1e-308, 1e-16, 2e-12])
def test_a_corner_of_a_rack_of_almost_nothing(key: str, value: float) -> None:
    outlined({"parts": {"gear": {"kind": "rack", "module": 2.0}}, "exports": [{"format": "dxf"}]}, key, value)


def outlined(raw: dict[str, Any], key: str, value: float) -> None:
    """The outline is made, or refused."""
    raw["parts"]["gear"][key] = value
    if survives(raw):
        plan = plan_build(scene_from_dict(raw, "s", "s"), "s", [], [])
        with contextlib.suppress(GeometryError):
            assert shape_of(plan.jobs[0])
