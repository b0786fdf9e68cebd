"""Tables of working drawings: every cell against ``calc --format json``, their words on no line and no other word."""

from __future__ import annotations

import json
import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
from parts.base.texts import Message, words
from parts.drawing.canvas import Canvas
from parts.pages.data_table import (
    DataRow,
    DataTable,
    draw_data_table,
    position_texts,
    sexagesimal,
    table_sizes,
    value_text,
)
from parts.pages.symbols import symbol_text
from parts.scene.data_tables import part_table
from parts.scene.load import load_scene, make_parts, scene_from_toml
from parts.scene.placing import place

TOPICS = {"spur_gear": "spur", "ring_gear": "ring", "rack": "rack", "worm": "worm", "worm_wheel": "worm",
          "bevel_gear": "bevel", "face_gear": "face-gear",
          "noncircular_gear": "noncircular", "cycloidal_disc": "cycloidal", "lantern_gear": "lantern",
          "cycloidal_gear": "cycloidal-gear", "timing_pulley": "pulley", "sprocket": "sprocket"}  # fmt: skip
CAMS = (
    "practicum_roller_cam",
    "practicum_flat_cam",
    "groove_cam",
    "linkage_cam",
    "wedge_cam",
    "barrel_cam",
    "conjugate_cams",
)
TOOTHED = ("practicum_pair", "helical_pair", "rack_and_pinion", "thesis_internal_pair", "worm_set_print", "bevel_pair",
           "spiral_bevel_pair", "face_gear_pair")  # fmt: skip
ROUND = ("oval_gears", "cycloidal_reducer", "lantern_pair", "clock_gears", "belt_drive", "chain_drive")
# what drawings call by other names than calculations do, which have the seeds'
CALLED = {
    "profile shift coefficient": "profile shift coefficient (xi)",
    "pressure angle of the basic rack": "pressure angle of the rack",
    "fillet radius of the basic rack, in modules": "rounding of the rack's tip, in modules",
    "pitch": "pitch of the rack",
}
# and by other symbols, those of GOST 2.403 and 2.406
SYMBOLS = {"s_a1": "s_c1", "h_a1": "h_c1", "s_c": "S_c"}
# what of a mate, and of the scene's keys, stands in a table, and is no step of the part's own calculation
BESIDE = {"number of teeth of the face gear", "teeth of the mate", "drawing of the mate", "centre distance",
          "teeth of the other sprocket", "teeth of the other pulley", "chain",
          "number of starts of the worm", "left end of the plate", "its lower edge"}  # fmt: skip


@pytest.mark.sampled(3)
@pytest.mark.parametrize("law", ["cosine", "constant_acceleration", "sine"])
@pytest.mark.parametrize("kind", ["cam", "groove_cam", "barrel_cam"])
def test_no_cam_angle_stands_twice_where_the_acceleration_leaps(kind: str, law: str) -> None:
    """Steps of 10 degrees; the ends of phases stood in the table twice, alike in all that it tells."""
    own = {
        "cam": 'base_circle_radius = 40.0\nfollower = "roller"\nfollower_radius = 8.0',
        "groove_cam": "base_circle_radius = 40.0\nfollower_radius = 8.0\ngroove_depth = 5.0\nface_width = 12.0",
        "barrel_cam": 'form = "groove"\nouter_diameter = 70.0\ngroove_depth = 8.0\nroller_diameter = 10.0',
    }[kind]
    moves = (("rise", 120, law), ("dwell", 60, ""), ("return_", 100, law), ("dwell", 80, ""))
    phases = ", ".join(f'{{ move = "{m}", angle_deg = {a}.0{f", law = {chr(34)}{w}{chr(34)}" if w else ""} }}'
                       for m, a, w in moves)  # fmt: skip
    (_, table, _) = tables("scene", f'[parts.p]\nkind = "{kind}"\nlift = 15.0\nphases = [{phases}]\n{own}\n')["p"]
    assert table.positions is not None
    rows = table.positions.rows
    # where it leaps at 0 too, 360 ends the table
    assert len(rows) in (36, 37)
    assert [row[0] for row in rows] == pytest.approx([10.0 * k for k in range(len(rows))], abs=1e-9)


@cache
def tables(address: str, text: str = "") -> dict[str, tuple[str, DataTable, Any]]:
    """The tables of a scene by part: the topic of its calculation, the table, the part as the mates leave it."""
    scene = scene_from_toml(text.encode(), address, address) if text else load_scene(address)
    parts, matings = make_parts(scene, address)
    placing = place(scene.instances, scene.drives, parts, matings, address)
    found = {key: part_table(part, scene, placing, parts) for key, part in parts.items()}
    return {key: (TOPICS.get(parts[key].kind, "cam"), table, parts[key]) for key, table in found.items() if table}


def calculated(topic: str, address: str, key: str, part: Any) -> dict[str, Any]:
    """The JSON of the same part; gears with the tip and the thinning that the mates have left, as the report has it."""
    more = []
    if topic in ("spur", "ring"):
        more.append(f"tip_diameter={part.circles['tip_diameter']!r}")
    if topic == "cycloidal-gear":
        more.append("rows=6")
    if topic in ("spur", "ring", "rack", "noncircular", "bevel", "face-gear", "cycloidal-gear"):
        more.append(f"circumferential_thinning={part.thing.circumferential_thinning!r}")
    elif part.kind == "worm":
        more.append(f"axial_thinning={part.thing.thread.worm.thinning!r}")
    found: dict[str, Any] = json.loads(calculate(topic, [address, f"part={key}", *more], "json", "en"))
    return found


@pytest.mark.parametrize(
    ("module", "more", "standard"),
    [(1.0, "", True), (0.9, "", False), (2.0, "tip_clearance_coefficient = 0.25", False)],
)
def test_a_bevel_rack_is_that_of_the_standard_where_it_has_it(module: float, more: str, standard: bool) -> None:
    """GOST 13754-81 is for modules from 1 mm on; else its numbers stand there."""
    part = (
        f'[parts.a]\nkind = "bevel_gear"\nmodule = {module}\nnumber_of_teeth = 20\nmate_number_of_teeth = 30\n{more}\n'
    )
    ((_, table, _),) = tables(f"m{module}{more}", f'{part}[[exports]]\nformat = "dxf"\npurpose = "part"\n').values()
    names = {words("en").say(row.name) for rows in table.parts for row in rows}
    assert ("basic rack" in names) is standard
    assert ("fillet radius of the basic rack, in modules" in names) is not standard


def test_a_face_gear_tells_how_its_own_teeth_are_thinned_and_no_backlash_of_half_the_pair() -> None:
    """Both gears give half of 0.1 mm: the table had 0.05 mm as if it were the backlash to be measured."""
    _, table, _ = tables("face_gear_pair")["wheel"]
    rows = {words("en").say(row.name): row.value for part in table.parts for row in part}
    assert "normal backlash" not in rows
    thinning = rows["thinning of the tooth, arc"]
    assert isinstance(thinning, float)
    assert 2 * thinning * math.cos(math.radians(20)) == pytest.approx(0.1, abs=1e-12)


@pytest.mark.parametrize(
    ("address", "rows"),
    [("chain_drive", {"centre distance": 208.0, "teeth of the other sprocket": 21}),
     ("belt_drive", {"teeth of the other pulley": 60}),
     ("bevel_pair", {"teeth of the mate": 40, "drawing of the mate": "wheel"}),
     ("face_gear_pair", {"teeth of the mate": 60, "drawing of the mate": "wheel"}),
     ("crossed_helical_pair", {"teeth of the mate": 24, "drawing of the mate": "wheel"})],
)  # fmt: skip
def test_the_other_part_of_every_drive_stands_in_the_table(address: str, rows: dict[str, Any]) -> None:
    """Of gears on parallel axes and of worms alone it did; axes that meet have no distance."""
    found = tables(address)
    _, table, _ = found.get("printed_pinion") or found["pinion"]
    said = {words("en").say(row.name): row.value for part in table.parts for row in part}
    told = {name: value if isinstance(value, int | float) else words("en").say(value) for name, value in said.items()}
    for name, value in rows.items():
        assert told[name] == (pytest.approx(value, abs=1e-9) if isinstance(value, float) else value)
    assert ("centre distance" in told) == (address not in ("bevel_pair", "face_gear_pair"))


def named(step: dict[str, Any]) -> tuple[str, str]:
    """Name and symbol of a step, on the page of a pair those of its first gear without the gear's number."""
    own = step.get("gear") == "first"
    return step["text"].removesuffix(", gear 1"), step["symbol"].removesuffix("1") if own else step["symbol"]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("address", [*TOOTHED, *CAMS, *ROUND])
def test_every_cell_is_what_the_calculation_prints(address: str) -> None:
    seen = 0
    for key, (topic, table, part) in tables(address).items():
        # a plate of a groove cam has the table of its cam
        owner = part.keys.of if part.kind == "groove_piece" else key
        data = calculated(topic, address, owner, part)
        steps = {named(s): s for s in data["steps"]}
        for row in (row for rows in table.parts for row in rows):
            name = words("en").say(row.name)
            name = name.partition(": ")[0] if isinstance(row.name, Message) else name
            found = CALLED.get(name, name), symbol_text(SYMBOLS.get(row.symbol, row.symbol), words("en"))
            if found not in steps:
                assert isinstance(row.value, str | Message) or name in BESIDE, name
                continue
            step = steps[found]
            is_word = isinstance(row.value, str)
            assert row.value == (step["value"] if is_word else pytest.approx(step["value"], rel=1e-13, abs=1e-13))
            assert row.unit == step["unit"]
            seen += 1
            text = value_text(row, words("en"))
            if row.unit != "deg" and not is_word:
                number = float(text.replace("\N{MINUS SIGN}", "-"))
                assert number == pytest.approx(step["value"], abs=5.01e-4 if row.unit else 5.01e-5)
        if table.positions is not None:
            name = table.positions.name
            heads = [symbol for symbol, _ in table.positions.heads]
            if name == "tip_flank":
                # one flank from the fillet to the tip
                data[name] = data["root_flank"] + data[name][1:]
            every = [[r[h] for h in heads] for r in data[name]]
            # what leaps has two rows of the calculation, and one where a drawing does not tell it
            wanted = [row for k, row in enumerate(every) if not k or row != pytest.approx(every[k - 1], abs=1e-9)]
            assert [list(r) for r in table.positions.rows] == [pytest.approx(row, abs=1e-12) for row in wanted]
            texts = [list(map(float, position_texts(row))) for row in table.positions.rows]
            assert texts == [pytest.approx(row, abs=5.01e-4) for row in wanted]
    assert seen >= 5


def values(text: str) -> dict[str, dict[str, Any]]:
    """What stands in the tables of a scene, by part and row."""
    return {
        key: {words("en").say(row.name): row.value for rows in table.parts for row in rows}
        for key, (_, table, _) in tables("scene", text).items()
    }


PAIR = """
[parts.pinion]
kind = "spur_gear"
module = 2.0
number_of_teeth = 20
designation = "AB.01"
[parts.wheel]
kind = "spur_gear"
module = 2.0
number_of_teeth = 33
helix_angle_deg = 0.0
[[mates]]
kind = "external_gear_pair"
first = "pinion"
second = "wheel"
"""


def test_the_table_of_a_gear_takes_the_tip_that_its_mate_leaves_however_large() -> None:
    """What the mate leaves of m 50, z 1927 is typed into its calculation: 125 884 mm were more than the key took."""
    gear = 'kind = "spur_gear"\nmodule = 50.0\nface_width = 250.0\nhelix_angle_deg = 40.0\n'
    one, two = "number_of_teeth = 1927\nprofile_shift_coefficient = 0.08\n", 'number_of_teeth = 1019\nhand = "left"\n'
    pair = f"[parts.a]\n{gear}{one}[parts.b]\n{gear}{two}"
    mate = '[[mates]]\nkind = "external_gear_pair"\nfirst = "a"\nsecond = "b"\n'
    assert set(tables("large", pair + mate)) == {"a", "b"}


@pytest.mark.parametrize(("width", "symbols"), [(30.0, ["k", "W"]), (20.0, ["D", "M"])])
def test_a_span_is_told_that_one_helix_of_two_holds(width: float, symbols: list[str]) -> None:
    """W sin beta_b of z 25, m 2, 30 degrees is 12.98 mm: half of 20 mm does not hold it, the whole face would."""
    gear = f'[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 25\nface_width = {width}\n'
    more = "helix_angle_deg = 30.0\ndouble_helical = true\n"
    ((_, table, _),) = tables(f"double {width}", gear + more).values()
    assert [row.symbol for row in table.parts[1]] == symbols
    page = json.loads(calculate("spur", ["module=2", "number_of_teeth=25", f"face_width={width}",
                                         "helix_angle_deg=30", "double_helical=true"], "json", "en"))  # fmt: skip
    told = {step["symbol"]: step["value"] for step in page["steps"]}
    assert (told["b_B"], "b" in told) == (width / 2, False)
    assert (told["b_B"] > told["b_s"]) is (symbols[0] == "k")


@pytest.mark.parametrize("form", ["ZI", "ZA"])
def test_the_table_of_an_involute_worm_tells_its_base_cylinder(form: str) -> None:
    """GOST 19650: cos gamma_b = cos alpha cos gamma, d_b = z1 m / tan gamma_b; of m 5, z1 2, q 10."""
    worm = f'[parts.w]\nkind = "worm"\nmodule = 5.0\nnumber_of_starts = 2\nthread_length = 60.0\nform = "{form}"\n'
    ((_, table, _),) = tables(f"worm {form}", worm).values()
    rows = {row.symbol: row.value for part in table.parts for row in part}
    lead = math.acos(math.cos(math.radians(20)) * math.cos(math.atan(0.2)))
    told = {"γ_b": math.degrees(lead), "d_b": 10 / math.tan(lead)} if form == "ZI" else {}
    assert {name: rows[name] for name in ("γ_b", "d_b") if name in rows} == pytest.approx(told, rel=1e-12)


SPROCKET = """
[parts.p]
kind = "sprocket"
chain = "08B-1"
number_of_teeth = 21
tooth_form = "GOST 591"
accuracy = { grade = "B", source = "GOST 591-69", deviations = [-0.25, 0.0] }
"""


def test_a_sprocket_tells_its_grade_and_the_limits_of_what_is_measured() -> None:
    """GOST 2.408; a seat that is deeper by 0.125 mm makes both sizes less by 0.25 mm."""
    ((_, table, _),) = tables("sprocket", SPROCKET).values()
    rows = {words("en").say(row.name): row for part in table.parts for row in part}
    assert value_text(rows["accuracy grade"], words("en")) == "B GOST 591-69"
    limits = {row.symbol: row.deviations for row in rows.values() if row.deviations}
    assert limits == {"M_R": (0.0, -0.25), "L_x": (0.0, -0.25)}
    # height of the inner plates of the chain, and what is between them
    chain = {row.symbol: row.value for row in table.parts[2]}
    assert (chain["h_2"], chain["b_1"]) == (11.81, 7.75)


@pytest.mark.parametrize(
    ("key", "of_pinion", "of_wheel"),
    [
        ("bore_diameter = 8.0", set(), set()),
        ("face_width = 12.0", set(), set()),
        (
            "profile_shift_coefficient = 0.3",
            {"profile shift coefficient", "span over k teeth", "centre distance"},
            {"centre distance"},
        ),
    ],
)
def test_a_change_changes_the_cells_that_depend_on_it_alone(key: str, of_pinion: set[str], of_wheel: set[str]) -> None:
    before, after = values(PAIR), values(PAIR.replace('designation = "AB.01"', f'designation = "AB.01"\n{key}'))
    for part, changed in (("pinion", of_pinion), ("wheel", of_wheel)):
        assert before[part].keys() == after[part].keys()
        assert {name for name, value in before[part].items() if after[part][name] != value} == changed
    assert words("en").say(after["wheel"]["drawing of the mate"]) == "AB.01"
    assert after["pinion"]["teeth of the mate"] == 33


ALONE = {
    "rack": {"module": 2.0, "number_of_teeth": 15, "face_width": 15.0},
    "ring_gear": {"module": 2.0, "number_of_teeth": 60, "outer_diameter": 150.0, "face_width": 15.0},
    "worm": {"module": 4.0, "thread_length": 50.0, "number_of_starts": 1},
    "cam": {"follower": '"roller"', "follower_radius": 8.0, "base_circle_radius": 40.0, "lift": 20.0, "phases":
            '[{ move = "rise", angle_deg = 180.0, law = "sine" }, '
            '{ move = "return_", angle_deg = 180.0, law = "sine" }]'},
}  # fmt: skip
THREAD = {"height to the thread's chord", "chord of the thread on the reference cylinder", "lead of the thread",
          "number of starts of the worm", "lead angle", "base lead angle", "base diameter of the worm"}  # fmt: skip
SPAN = {"spaces in the span", "span over k spaces", "profile shift coefficient"}


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("kind", "key", "value", "cells", "columns"),
    [
        ("rack", "body_height", 20.0, set(), set()),
        ("rack", "face_width", 20.0, set(), set()),
        ("rack", "number_of_teeth", 16, {"number of teeth"}, set()),
        ("ring_gear", "outer_diameter", 160.0, set(), set()),
        ("ring_gear", "face_width", 20.0, set(), set()),
        ("ring_gear", "profile_shift_coefficient", 0.2, SPAN, set()),
        ("worm", "bore_diameter", 8.0, set(), set()),
        ("worm", "thread_length", 60.0, set(), set()),
        ("worm", "number_of_starts", 2, THREAD, set()),
        ("cam", "bore_diameter", 12.0, set(), set()),
        ("cam", "base_circle_radius", 44.0, set(), {"r", "theta"}),
        ("cam", "follower_radius", 9.0, {"radius of the roller"}, {"r", "theta"}),
        ("cam", "lift", 24.0, {"lift"}, {"S", "r", "theta"}),
    ],
)
def test_a_change_of_a_part_alone_changes_what_depends_on_it_alone(
    kind: str, key: str, value: float, cells: set[str], columns: set[str]
) -> None:
    seen: list[tuple[dict[str, Any], dict[str, Any]]] = []
    for keys in (ALONE[kind], ALONE[kind] | {key: value}):
        text = f'[parts.p]\nkind = "{kind}"\n' + "".join(f"{k} = {v}\n" for k, v in keys.items())
        places = tables("scene", text)["p"][1].positions
        heads = [] if places is None else [head for head, _ in places.heads]
        rows = () if places is None else places.rows
        seen.append((values(text)["p"], {head: [row[k] for row in rows] for k, head in enumerate(heads)}))
    for old, new, changed in zip(*seen, (cells, columns), strict=True):
        assert old.keys() == new.keys()
        assert {name for name in old if old[name] != new[name]} == changed


GRADE = '[parts.pinion.accuracy]\ngrade = "8-B"\nsource = "GOST 1643-81"\ndeviations = [-0.2, -0.1]\n[parts.wheel]'


def test_a_grade_stands_with_its_source_and_deviations_on_what_is_measured() -> None:
    _, table, _ = tables("scene", PAIR.replace("[parts.wheel]", GRADE))["pinion"]
    rows = {words("en").say(row.name): row for part in table.parts for row in part}
    assert value_text(rows["accuracy grade"], words("en")) == "8-B GOST 1643-81"
    # kinds of mate are Latin letters in the standard
    assert value_text(rows["accuracy grade"], words("uk")) == "8-B ГОСТ 1643-81"
    assert {name: row.deviations for name, row in rows.items() if row.deviations} == {"span over k teeth": (-0.1, -0.2)}
    canvas = Canvas(120.0, 297.0, "")
    draw_data_table(canvas, 115 + 290j, table, "uk")
    # a minus as printers have it
    assert {"\N{MINUS SIGN}0,100", "\N{MINUS SIGN}0,200"} <= {text.text for text in canvas.texts}


def test_a_grade_without_a_source_is_told_by_key() -> None:
    with pytest.raises(SceneError, match=r"parts\.pinion\.accuracy.*source"):
        tables("scene", PAIR.replace("[parts.wheel]", GRADE.replace('source = "GOST 1643-81"\n', "")))


@pytest.mark.parametrize(
    ("keys", "control"),
    [
        ("", "span over k teeth"),
        ("helix_angle_deg = 30.0\nface_width = 3.0", "size over balls"),
        # stubs, whose flanks no two faces find
        ("number_of_teeth = 10\ntip_diameter = 19.0", "size over pins"),
    ],
)
def test_what_is_measured_touches_the_teeth(keys: str, control: str) -> None:
    teeth = "" if "number_of_teeth" in keys else "number_of_teeth = 31\n"
    found = tables("scene", f'[parts.gear]\nkind = "spur_gear"\nmodule = 2.0\n{teeth}{keys}\n')["gear"][1]
    assert words("en").say(found.parts[1][-1].name) == control


@pytest.mark.parametrize("degrees", [0.0, 15.0, 5.710593137499643, -12.5, 29.99999999, 0.0002])
def test_an_angle_in_minutes_and_seconds_is_the_angle(degrees: float) -> None:
    text = sexagesimal(degrees)
    parts = text.lstrip("-").replace("′", "°").replace("″", "°").split("°")[:-1]
    told = sum(float(part) / 60**k for k, part in enumerate(parts)) * (-1 if text.startswith("-") else 1)
    assert abs(told - degrees) <= 0.5 / 3600 + 1e-12
    assert all(float(part) < 60 for part in parts[1:])


def crossings(canvas: Canvas) -> list[str]:
    """Words that stand over another word or over a line of a table."""
    words_at = np.array([(t.box.left, t.box.low, t.box.right, t.box.high) for t in canvas.texts])
    ends = np.array([[complex(s.curve.point(t)) for t in s.curve.domain] for s in canvas.strokes])
    lines = np.stack([ends.real.min(1), ends.imag.min(1), ends.real.max(1), ends.imag.max(1)], axis=1)

    def over(one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Which boxes have more than a rounding in common."""
        low, high = np.maximum(one[:, None, :2], other[:, :2]), np.minimum(one[:, None, 2:], other[:, 2:])
        return np.all(low < high - 1e-6, axis=2)

    thick = lines + np.array([-1e-5, -1e-5, 1e-5, 1e-5])
    pairs = np.argwhere(np.tril(over(words_at, words_at), -1))
    found = [f"{canvas.texts[i].text} over {canvas.texts[j].text}" for i, j in pairs]
    return [*found, *(f"{canvas.texts[i].text} over a line" for i, _ in np.argwhere(over(words_at, thick)))]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("address", [*TOOTHED, *CAMS])
def test_words_stand_over_no_word_and_no_line(address: str) -> None:
    for language in ("en", "uk"):
        for key, (_, table, _) in tables(address).items():
            for beside, wide, tall in table_sizes(table, language):
                canvas = Canvas(wide + 10.0, 2 * 297.0, "")
                room = draw_data_table(canvas, complex(wide + 5.0, 590.0), table, language, beside)
                assert (room.right - room.left, room.high - room.low) == pytest.approx((wide, tall))
                assert crossings(canvas) == [], key
                assert all(text.box.within(room) for text in canvas.texts)
                assert all(run.height >= 1.8 for text in canvas.texts for run in text.runs)


def test_a_word_over_a_line_is_found() -> None:
    canvas = Canvas(100.0, 100.0, "")
    canvas.write("word", 10 + 10j)
    canvas.line("TABLE", 0 + 11j, 50 + 11j)
    assert crossings(canvas) == ["word over a line"]


def test_rows_without_a_symbol_have_a_dash() -> None:
    table = DataTable(((DataRow("module", "", math.pi, "mm"),),))
    canvas = Canvas(120.0, 50.0, "")
    draw_data_table(canvas, 115 + 40j, table, "en")
    assert [text.text for text in canvas.texts] == ["Module", "—", "3.142"]


def test_a_mate_is_called_in_every_language_as_its_own_drawing_is() -> None:
    # before: "worm" is a word of the catalogue too, and stood there in its translation
    table = tables("thesis_worm_1")["wheel"][1]
    (cell,) = (row for group in table.parts for row in group if row.name == "drawing of the mate")
    assert value_text(cell, words("uk")) == "worm"


END_CAM = """[parts.a]
kind = "barrel_cam"
form = "end"
outer_diameter = 60.0
roller_diameter = 10.0
groove_depth = 8.0
lift = 10.0
phases = [{ move = "rise", angle_deg = 180.0, law = "sine" }, { move = "return_", angle_deg = 180.0, law = "sine" }]
"""


@pytest.mark.parametrize("belt", ["XL", "T5", "HTD 8M", "GT2"])
def test_a_pulley_tells_every_size_of_its_groove(belt: str) -> None:
    """The radius of the roots was missing, which is nearly all of an HTD groove."""
    part = f'[parts.a]\nkind = "timing_pulley"\nbelt = "{belt}"\nnumber_of_teeth = 30\n'
    ((_, table, _),) = tables(belt, part + '[[exports]]\nformat = "dxf"\n').values()
    page = json.loads(calculate("pulley", [f"belt={belt}", "number_of_teeth=30"], "json", "en"))
    names = list(page["values"])
    groove = set(names[names.index("pulley_groove_depth") :]) - {"land_width"}
    symbols = {step["symbol"] for step in page["steps"] if step["name"] in groove}
    assert len(symbols) == len(groove) > 4
    assert symbols <= {row.symbol for rows in table.parts for row in rows}


def test_a_sprocket_names_its_chain_and_a_plate_of_a_groove_cam_what_its_columns_are() -> None:
    """GOST 2.408; the plate had the polar angle of a profile over columns of the roller's centre."""
    made = [table for _, table, _ in tables("chain_drive").values()]
    assert {row.value for table in made for row in table.parts[0] if row.name == "chain"} == {"08B-1", "2ПР-12,7-31,8"}
    assert "x_p" in {row.symbol for row in tables("groove_cam")["ring"][1].parts[2]}


@pytest.mark.parametrize("address", ["lantern_pair", "groove_cam"])
def test_numbers_of_positions_are_not_squeezed_where_their_table_has_room(address: str) -> None:
    """A first column of a fixed width had 196,25 in letters of 1.8 mm beside columns that were half empty."""
    for _, table, _ in tables(address).values():
        if table.positions is not None:
            canvas = Canvas(420.0, 297.0, "A3")
            draw_data_table(canvas, 400 + 290j, table, "uk")
            written = [text for text in canvas.texts if text.text[:1].isdigit() and "," in text.text]
            assert {run.height for text in written for run in text.runs} <= {2.5, 3.5}


def test_symbols_of_one_table_are_of_one_size() -> None:
    """h_xmn of a spiral bevel gear was in letters of 2.5 mm beside s_xmn in 3.5 mm."""
    for _, table, _ in tables("spiral_bevel_pair").values():
        canvas = Canvas(420.0, 297.0, "A3")
        draw_data_table(canvas, 400 + 290j, table, "uk")
        columns = [text for text in canvas.texts if 355.0 < text.box.middle.real < 365.0]
        assert {max(run.height for run in text.runs) for text in columns} == {3.5}


def test_a_table_names_what_its_own_cam_has() -> None:
    # before: a roller "or mushroom", the groove of an end cam, a minus before nothing
    both = tables("end", END_CAM)["a"][1], next(iter(tables("groove_cam").values()))[1]
    end, grooved = ({str(row.name) for part in table.parts for row in part} for table in both)
    assert not any("groove" in name for name in end)
    assert {"radius of the roller", "width of the groove"} <= grooved
    # what the drawing has a size of is told once
    assert not any(word in name for word in ("outer diameter", "depth", "track") for name in end | grooved)
    assert position_texts([0.0, -1e-9, -0.0006]) == ["0", "0.000", "-0.001"]


def test_a_worm_of_two_wheels_tells_each_centre_distance_before_its_wheel() -> None:
    """a_w = m (q + z_2) / 2, the designation of each wheel after its own."""
    wheel = 'kind="worm_wheel"\nmodule=4.0\nface_width=30.0\nbore_diameter=20.0\n'
    text = f"""
[parts.worm]
kind = "worm"
module = 4.0
thread_length = 70.0
[parts.one]
{wheel}number_of_teeth = 40
outer_diameter = 174.0
designation = "ONE"
[parts.two]
{wheel}number_of_teeth = 30
outer_diameter = 134.0
designation = "TWO"
[[mates]]
kind = "worm_pair"
first = "one"
second = "left"
[[mates]]
kind = "worm_pair"
first = "two"
second = "right"
[instances.left]
part = "worm"
[instances.right]
part = "worm"
[instances.two]
part = "two"
at = [500.0, 0.0, 0.0]
[[exports]]
format = "svg"
"""
    _, table, part = tables("two", text)["worm"]
    told = [words("en").say(row.value) if isinstance(row.value, Message) else row.value
            for row in table.parts[-1] if row.symbol in ("a_w", "z") or isinstance(row.value, Message)]  # fmt: skip
    quotient = part.keys.diameter_quotient
    assert told == [2 * (quotient + 40), 40, "ONE", 2 * (quotient + 30), 30, "TWO"]
