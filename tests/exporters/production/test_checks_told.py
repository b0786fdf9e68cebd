"""What checks found, in the lines that tell it; and exports that may not stand beside each other."""

from __future__ import annotations

from typing import Any

import pytest

from exporters.production.check_lines import caption_lines, check_lines, has_bad_verdict
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.scene.load import scene_from_toml
from parts.texts.checks import in_rows

NAMES = {"a": "Gear A", "b": "Gear B", "pin_1": "Pin 1", "pin_2": "Pin 2", "pin_3": "Pin 3"}
PAIR: dict[str, Any] = {
    "kind": "external_gear_pair", "first": "a", "second": "b", "working_centre_distance": 40.0,
    "working_pressure_angle_deg": 21.5, "contact_ratio": 1.6, "effective_contact_ratio": 1.25, "verdict": "contact",
    "gap": 2e-10, "tolerance": 1e-8,
}  # fmt: skip
SEAT: dict[str, Any] = {"kind": "pin_seat", "first": "a", "second": "pin_1", "clearance": 0.1, "distance": 10.0}


def one(**checks: Any) -> str:
    (line,) = check_lines(checks, "en", NAMES)
    return line


def test_a_pair_of_gears_is_told_by_its_numbers() -> None:
    line = one(mates=[PAIR])
    # what undercut leaves of the contact ratio, and a gap that is rounding as none
    for words in ("Gear A", "Gear B", "40", "21.5", "1.25", "least gap 0 mm"):
        assert words in line
    assert "1.6" not in line
    assert "part on their way" not in line
    assert ", total 2.1000" in one(mates=[PAIR | {"total_contact_ratio": 2.1}])
    assert "least gap -2e-09 mm" in one(mates=[PAIR | {"gap": -2e-9}])
    clear = PAIR | {"verdict": "clear", "gap": 1e-8}
    assert "both part on their way" in one(mates=[clear])
    assert "both part on their way" not in one(mates=[clear | {"gap": 2e-8}])
    walls = {"inner": [0.0, 0.01], "outer": [0.05, 0.2]}
    line = one(mates=[PAIR | {"walls": walls, "roller_clearance": 0.2}])
    assert "inner wall 0 to 0.01 mm, at the outer wall 0.05 to 0.2 mm, clearance 0.2 mm" in line
    noise = {"inner": [-2.13e-14, 3.1e-14], "outer": [-2e-9, 0.2]}
    assert "inner wall 0 to 0 mm, at the outer wall -2e-09 to 0.2 mm" in one(
        mates=[PAIR | {"walls": noise, "roller_clearance": 0.2}]
    )


def test_what_is_noted_and_broken_is_told_below_its_mate() -> None:
    far = {"met": False, "code": "height", "value": 3.0, "required": 2.0, "tolerance": 0.1}
    mate = PAIR | {"findings": [{"text": "thin"}, {"text": "small"}], "conditions": [far | {"met": True}, far]}
    axle = {"axle": "pin_1", "frame": "b", "distance": 0.5, "clearance": 0.1}
    lines = check_lines({"mates": [mate], "axles": [axle]}, "en", NAMES)
    assert lines[1:3] == ["note: thin", "note: small"]
    assert lines[3:] == [
        "BROKEN: Gear B stands 3 mm above Gear A, 2 mm is required",
        "BROKEN: the axle of Pin 1 passes Gear B 0.5 mm off the centre of a hole, its clearance is 0.1 mm",
    ]
    assert has_bad_verdict({"mates": [mate]})
    assert has_bad_verdict({"axles": [{"text": "no axle"}]})
    assert not has_bad_verdict({"mates": [PAIR]})
    for verdict in ("overlap", "undecided"):
        assert has_bad_verdict({"mates": [PAIR | {"verdict": verdict}]})
        assert has_bad_verdict({"solids": [{"verdict": verdict}]})
        assert has_bad_verdict({"order": {"hindered": [{"verdict": verdict}]}})
    found = {
        "in_a_row": ["a", "x"],
        "neighbours": [{"first": "a", "second": "x", "distance": 3.0, "sum_of_tip_radii": 4.0}],
        "solids": [{"verdict": "overlap", "first": "a", "second": "b", "volume": 2.0}],
    }
    lines = check_lines(found, "en", NAMES)
    assert len(lines) == 3
    assert lines[0].endswith("so they stand in a row: Gear A, x")
    assert lines[1] == "note: Gear A and x may touch: 3 mm apart, their tips reach 4 mm, no mate joins them"
    assert lines[2].lower().startswith("overlap")
    assert lines[2].endswith(": Gear A and Gear B run into each other: 2 mm^3 in common as they stand")
    # in Ukrainian the volume seemed to be that of every pose
    assert check_lines(found, "uk", NAMES)[2].endswith("положенні")


def test_transmission_errors_are_told_for_each_sense() -> None:
    found = {"clockwise": {"line_of_action": 0.0123, "second_arcsec": 45.6},
             "counter_clockwise": {"line_of_action": 0.001, "second_travel": 0.0042}}  # fmt: skip
    lines = check_lines({"mates": [PAIR | {"transmission_error": found}]}, "en", NAMES)
    assert len(lines) == 3
    assert 'first turns clockwise): 0.0123 mm on the line of action, 45.6" of Gear B' in lines[1]
    assert "first turns counter-clockwise): 0.001 mm on the line of action, 0.0042 mm of Gear B" in lines[2]
    assert "involute gears only" in check_lines({"mates": [PAIR | {"transmission_error": None}]}, "en")[1]
    slip = PAIR | {"transmission_error": {}}
    assert "slip past each other" in check_lines({"mates": [slip]}, "en")[1]
    assert "slip past each other" in check_lines({"mates": [slip | {"total_contact_ratio": 0.99}]}, "en")[1]
    assert len(check_lines({"mates": [slip | {"total_contact_ratio": 1.0}]}, "en")) == 1
    assert len(check_lines({"mates": [PAIR]}, "en")) == 1


def test_drives_tell_what_turns_alike_once() -> None:
    train = {"a": 1.0, "b": -0.5, "pin_1": -2.0, "pin_2": -2.0, "pin_3": -2.0}
    drive = {"instance": "a", "train": train}
    told = "drive Gear A, turns: Gear A = 1, Gear B = -0.5, "
    assert one(drives=[drive]) == told + "Pin 1 ... Pin 3 = -2"
    fixed = {"kind": "fixed", "first": "a", "second": "pin_3"}
    lines = check_lines({"drives": [drive], "mates": [fixed | {"distance": 1.0}]}, "en", NAMES)
    assert lines[-1] == told + "Pin 1 = -2, Pin 2 = -2"


MOTION: dict[str, Any] = {"pairs": 3, "poses": 120, "tested": 2, "uncovered": []}


def test_motion_is_told_with_all_that_it_did_not_hold() -> None:
    assert "checked only as they stand" in one(motion={"one_pose": True})
    line = one(motion=MOTION)
    assert "3 pairs over the period of each; 120 poses checked" in line
    assert "3 pairs; none can meet the other" in one(motion=MOTION | {"tested": 0})
    assert check_lines({"motion": MOTION | {"pairs": 0}}, "en") == []
    worst = [{"first": "a", "second": "b", "share": 0.25, "depth": 0.01},
             {"first": "a", "second": "pin_1", "share": 1, "depth": 0.5}]  # fmt: skip
    lines = check_lines({"motion": MOTION | {"uncovered": worst}}, "en", NAMES)
    assert len(lines) == 3
    assert lines[1] == "note: Gear A and Gear B were checked over 0.25 of their period"
    assert "Gear A and Pin 1 may overlap by up to 0.5 mm, the most of 2 pairs" in lines[2]


def test_a_workspace_is_told_by_why_pairs_cannot_meet() -> None:
    found = {"tested": [("a", "b", ("a", "b")), ("a", "x", ("a", "b")), ("b", "x", ())], "poses": 50,
             "rest": {"fixed": [1, 2], "height": [], "round": [1]}, "uncovered": [],
             "fits": [{"pairs": 5, "touching": 2}]}  # fmt: skip
    lines = check_lines({"workspace": found}, "en", NAMES)
    assert lines[0] == ("solids wherever drives may stand: 2 pairs over Gear A, Gear B, 1 pair as they stand; 50 poses")
    assert lines[1] == "cannot meet: 2 pairs fixed to each other, 1 pair round about a common axis"
    assert lines[2] == "seats by half sections: 2 pairs in touch, 3 pairs with a clearance"
    empty = found | {"tested": [], "rest": {}, "fits": []}
    assert check_lines({"workspace": empty}, "en") == ["solids wherever drives may stand: none can meet another"]
    assert check_lines({"workspace": found, "motion": MOTION}, "en", brief=True) == []


def test_seats_of_one_part_are_told_in_one_line() -> None:
    mates = [SEAT | {"second": f"pin_{k}"} for k in (1, 2, 3)] + [SEAT | {"first": "b"}]
    lines = check_lines({"mates": mates}, "en", NAMES)
    assert len(lines) == 2
    assert "Pin 1 ... Pin 3" in lines[0]
    # brief: only what has a verdict, is noted or broken
    assert check_lines({"mates": mates}, "en", NAMES, brief=True) == []
    noted = SEAT | {"findings": [{"text": "loose"}]}
    assert len(check_lines({"mates": [*mates, noted]}, "en", NAMES)) == 4
    assert check_lines({"mates": [*mates, noted]}, "en", NAMES, brief=True)[1:] == ["note: loose"]


def test_a_caption_tells_what_is_not_well_first() -> None:
    mates = [PAIR | {"first": f"gear number {k}"} for k in range(9)] + [PAIR | {"verdict": "overlap", "gap": -0.1}]
    checks = {"mates": mates, "drives": [{"instance": "a", "train": {"a": 1.0}}], "motion": MOTION}
    whole = check_lines(checks, "en", NAMES, brief=True)
    size = sum(map(len, whole))
    assert caption_lines(checks, "en", NAMES, size) == whole
    short = caption_lines(checks, "en", NAMES, size - 1)
    assert len(short) == 3
    assert "least gap -0.1 mm" in short[0]
    assert short[1].endswith(": 9 pairs")
    assert short[2] == "drive Gear A, turns: Gear A = 1"
    least = sum(map(len, short))
    assert caption_lines(checks, "en", NAMES, least) == short
    assert caption_lines(checks, "en", NAMES, least - 1) == short[:2]


@pytest.mark.parametrize(("names", "told"), [
    (["p_1", "p_2", "p_3", "q"], ["p_1 ... p_3", "q"]), (["p_1", "p_2"], ["p_1", "p_2"]),
    (["p_1", "p_3", "p_2"], ["p_1", "p_2", "p_3"]), (["a", "b", "c"], ["a", "b", "c"]),
    (["x9", "x10", "x11"], ["x9 ... x11"]), (["x01", "x02", "x03"], ["x01", "x02", "x03"]),
])  # fmt: skip
def test_names_that_count_on_are_one_row(names: list[str], told: list[str]) -> None:
    assert sorted(in_rows(names)) == sorted(told)


PARTS = """
[parts.a]
kind = "spur_gear"
module = 2.0
number_of_teeth = 12
face_width = 4.0
bore_diameter = 5.0
[parts.b]
kind = "spur_gear"
module = 2.0
number_of_teeth = 15
face_width = 4.0
[parts.slab]
kind = "plate"
width = 30.0
height = 20.0
face_width = 4.0
[[mates]]
kind = "external_gear_pair"
first = "a"
second = "b"
[[drives]]
instance = "a"
[boards.wood]
width = 200.0
height = 200.0
thickness = 4.0
kerf = 0.1
copies = { a = 1 }
[beds.printer]
width = 200.0
depth = 200.0
height = 100.0
copies = { b = 1 }
"""
EXPORTS = {
    "dxf": 'format = "dxf"', "svg": 'format = "svg"', "drawing": 'format = "dxf"\npurpose = "drawing"',
    "stl": 'format = "stl"', "3mf": 'format = "3mf"', "assembly": 'format = "3mf"\nassembly = true',
    "meshing": 'format = "sheet"\ntolerance = 1e-2',
    "pdf": 'format = "pdf"', "part": 'format = "pdf"\npurpose = "part"',
    "board": 'format = "dxf"\npurpose = "board"', "plate": 'format = "3mf"\npurpose = "plate"',
    "motion": 'format = "motion"', "glb": 'format = "glb"', "list": 'format = "csv"',
}  # fmt: skip


def plan(*exports: str) -> Any:
    text = PARTS + "".join(f"[[exports]]\n{one}\n" for one in exports)
    return plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s.toml", [], [])


def paths(made: Any) -> list[str]:
    return [job.path for job in (*made.jobs, *made.assemblies, *made.sheets)]


@pytest.mark.sampled(7)
@pytest.mark.parametrize("name", EXPORTS)
def test_two_exports_into_one_file_are_refused(name: str) -> None:
    """Twice the same name, and names that differ in capitals only, as some disks hold them to be one."""
    own = EXPORTS[name]
    both = paths(plan(own + '\nname = "one"', own + '\nname = "two"'))
    once = [path for path in both if "two" not in path]
    assert once
    assert len(set(both)) == len(both) == 2 * len(once)
    # what differs in nothing is the same in capitals too: once is enough
    for other in ("one", "ONE") if name == "dxf" else ("ONE",):
        with pytest.raises(SceneError) as refused:
            plan(own + '\nname = "one"', own + f'\nname = "{other}"')
        assert (refused.value.key, refused.value.code) == ("exports[2].name", "same_file")
        assert str(refused.value.value).lower() in [path.lower() for path in both]


def test_the_nearest_pair_of_gears_is_offered() -> None:
    more = '[parts.c]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 20\nface_width = 4.0\n'
    mate = '[[mates]]\nkind = "external_gear_pair"\nfirst = "b"\nsecond = "c"\n'
    fixed = '[[mates]]\nkind = "fixed"\nfirst = "a"\nsecond = "slab"\n'
    text = PARTS.replace("[parts.b]", more + "[parts.b]").replace("[[drives]]", f"{fixed}{mate}[[drives]]")

    def sheets(number: int) -> list[str]:
        asked = f'{text}[[exports]]\nformat = "sheet"\nmate = {number}\n'
        return paths(plan_build(scene_from_toml(asked.encode(), "s.toml", "s"), "s.toml", [], []))

    for number in (1, 3):
        assert all(f".{number}." in path for path in sheets(number))
    # the second mate joins no gears, beyond the third there is none
    for number, code, works in ((2, "mate_of_no_gears", 1), (4, "no_such_mate", 3), (9, "no_such_mate", 3)):
        with pytest.raises(SceneError) as refused:
            sheets(number)
        assert refused.value.code == code
        assert refused.value.nearest is not None
        assert refused.value.nearest.value == works


@pytest.mark.parametrize(("place", "keys"), [
    ("parts.slab.designation", '[parts.slab]\ndesignation = "漢"\n'),
    ("parts.slab.material", '[parts.slab]\nmaterial = "漢"\ndensity = 1.0\n'),
    ("parts.slab.title", '[parts.slab]\ntitle = "漢"\n'),
    ("exports[1].title_block.organisation", 'title_block = { organisation = "漢" }\n'),
    ("exports[1].drawing.requirements[2]", 'drawing = { requirements = ["fine", "漢"] }\n'),
])  # fmt: skip
def test_words_that_a_pdf_cannot_write_are_named_by_their_key(place: str, keys: str) -> None:
    slab = 'kind = "plate"\nwidth = 30.0\nheight = 20.0\nface_width = 4.0\n'
    export = '[[exports]]\nformat = "pdf"\npurpose = "part"\n'
    parts = f"{keys}{slab}" if keys.startswith("[parts") else f"[parts.slab]\n{slab}"
    text = parts + export + (keys if not keys.startswith("[") else "")
    with pytest.raises(SceneError) as refused:
        plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s.toml", [], [])
    assert (refused.value.key, refused.value.code) == (place, "no_such_letter_on_paper")


def test_of_many_pairs_the_nearest_are_told_and_how_many_more_there_are() -> None:
    """A thousand gears in one place made half a million lines; the report has them all."""
    neighbours = [
        {"first": "a", "second": f"x{k}", "distance": 4.0 - 0.01 * k, "sum_of_tip_radii": 4.0} for k in range(30)
    ]
    solids = [{"verdict": "overlap", "first": "a", "second": f"x{k}", "volume": 2.0} for k in range(21)]
    lines = check_lines({"neighbours": neighbours, "solids": solids}, "en", NAMES)
    assert len(lines) == 20 + 1 + 20 + 1
    assert lines[0] == "note: Gear A and x29 may touch: 3.71 mm apart, their tips reach 4 mm, no mate joins them"
    assert lines[20] == "note: 10 pairs more may touch"
    assert lines[-1].lower() == "overlap: 1 pair more"
