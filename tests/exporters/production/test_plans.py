"""What a build plans: files by their names, and what is left out with why, whatever is asked for."""

from __future__ import annotations

import re
from typing import Any

import pytest

from exporters.production.plan import Plan, plan_build
from parts.base.refusal import SceneError
from parts.base.texts import words
from parts.scene.load import scene_from_toml

GEAR = '[parts.{}]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = {}\nface_width = 4.0\nbore_diameter = 5.0\n'
SLAB = '[parts.slab]\nkind = "plate"\nwidth = 30.0\nheight = 20.0\nface_width = 4.0\n'
BALL = '[parts.ball]\nkind = "turned"\npoints = [{ r = 0.0, z = -3.0 }, { r = 3.0, z = 0.0 }, { r = 0.0, z = 3.0 }]\n'
PAIR = '[[mates]]\nkind = "external_gear_pair"\nfirst = "a"\nsecond = "b"\n[[drives]]\ninstance = "a"\n'
PARTS = GEAR.format("a", 12) + GEAR.format("b", 15) + SLAB
BOARD = "[boards.wood]\nwidth = 200.0\nheight = 200.0\nthickness = 4.0\ncopies = { a = 1 }\nparts = ['a', 'b']\n"
BED = "[beds.printer]\nwidth = 200.0\ndepth = 200.0\nheight = 100.0\nparts = ['b']\n"
NAMES = {
    "dxf": 'format = "dxf"', "drawing": 'format = "dxf"\npurpose = "drawing"', "stl": 'format = "stl"',
    "3mf": 'format = "3mf"', "assembly": 'format = "3mf"\nassembly = true', "step": 'format = "step"',
    "all": 'format = "step"\nassembly = true', "meshing": 'format = "sheet"',
    "board": 'format = "dxf"\npurpose = "board"', "plate": 'format = "3mf"\npurpose = "plate"',
    "film": 'format = "motion"', "part": 'format = "pdf"\npurpose = "part"',
    "list": 'format = "csv"', "dxf of a": 'format = "dxf"\nparts = ["a"]', "named": 'format = "dxf"\nname = "own"',
    "only a": 'format = "stl"\nparts = ["a"]', "svg": 'format = "svg"', "rounded": 'format = "stl"\noffset = 0.1',
    "balls": 'format = "svg"\nparts = ["ball"]', "model": 'format = "pdf"',
    "step ball": 'format = "step"\nparts = ["ball"]',
    "paper balls": 'format = "pdf"\nparts = ["ball", "a"]',
}  # fmt: skip


def plan(*exports: str, parts: list[str] | None = None, formats: list[str] | None = None, text: str = PARTS + PAIR,
         name: str = "s") -> Plan:  # fmt: skip
    whole = text + "".join(f"[[exports]]\n{NAMES[one]}\n" for one in exports)
    return plan_build(scene_from_toml(whole.encode(), "s.toml", name), "s.toml", parts or [], formats or [])


def paths(made: Plan) -> list[str]:
    return [job.path for job in (*made.jobs, *made.assemblies, *made.sheets) if job.path]


def left(made: Plan) -> list[tuple[str, str, bool]]:
    return [(one.what, words("en").say(one.why), one.as_asked) for one in made.left_out]


ABS = ("a", "b", "slab")
UNUSED = [("parts.b", "no export asks for it"), ("parts.slab", "no export asks for it")]
UNASKED = [("parts.b", "was not asked for", True), ("parts.slab", "was not asked for", True)]


@pytest.mark.parametrize(("exports", "wanted"), [
    (("dxf",), [f"{p}.dxf" for p in ABS]),
    # two of one ending: by their purposes, or names
    (("dxf", "drawing"), [f"{p}.{w}.dxf" for w in ("laser", "drawing") for p in ABS]),
    (("dxf", "named"), [f"{p}.{w}.dxf" for w in ("laser", "own") for p in ABS]),
    # where both make one of the part
    (("drawing", "dxf of a"), ["a.drawing.dxf", "b.dxf", "slab.dxf", "a.laser.dxf"]),
    # files of several parts do not count
    (("dxf", "board"), [*(f"{p}.dxf" for p in ABS), "s.board.1.dxf"]),
    (("3mf", "assembly"), [*(f"{p}.3mf" for p in ABS), "s.3mf"]),
    (("all", "step"), [*(f"{p}.step" for p in ABS), "s.step"]),
    (("assembly", "plate"), ["s.3mf", "s.plate.1.3mf"]),
    (("meshing", "film", "list"), ["s.meshing.1.dxf", "s.meshing.1.svg", "s.motion.svg", "s.parts_list.csv"]),
])  # fmt: skip
def test_files_are_named_by_parts_and_by_what_else_ends_alike(exports: tuple[str, ...], wanted: list[str]) -> None:
    assert sorted(paths(plan(*exports, text=PARTS + PAIR + BOARD + BED))) == sorted(wanted)


def test_an_assembly_steps_aside_for_a_part_of_its_name() -> None:
    """In any capitals; where such a file is made, and in a scene of another name not."""
    assert "A.assembly.3mf" in paths(plan("3mf", "assembly", name="A"))
    assert "A.3mf" in paths(plan("assembly", name="A"))
    assert "s.3mf" in paths(plan("3mf", "assembly"))
    both = PARTS + PAIR + f"[[exports]]\n{NAMES['assembly']}\nname = 'one'\n"
    assert {"s.one.3mf", "s.print.3mf"} <= set(paths(plan("assembly", text=both)))


@pytest.mark.parametrize(("exports", "parts", "formats", "wanted"), [
    (("dxf",), [], [], []),
    (("dxf",), ["a"], [], UNASKED),
    (("dxf", "stl"), [], ["stl"], [("exports[1]", "format dxf was not asked for", True)]),
    (("dxf of a",), [], [], [(*row, False) for row in UNUSED]),
    (("only a", "dxf"), [], ["stl"], [
        ("exports[2]", "format dxf was not asked for", True), *((*row, True) for row in UNUSED)]),
    (("dxf", "assembly", "meshing"), ["a"], [], [
        *UNASKED,
        ("exports[2]", "an assembly of all its parts was not asked for", False),
        ("exports[3]", "a sheet of several parts was not asked for", False)]),
])  # fmt: skip
def test_what_is_left_out_is_told_with_why(
    exports: tuple[str, ...], parts: list[str], formats: list[str], wanted: list[tuple[str, str, bool]]
) -> None:
    assert left(plan(*exports, parts=parts, formats=formats)) == wanted


def test_boards_and_beds_that_nothing_asks_for_and_parts_that_lie_on_none_are_told() -> None:
    text = PARTS.replace("[parts.slab]\n", '[parts.slab]\ntitle = "Slab"\n') + PAIR + BOARD + BED
    assert left(plan("dxf", text=text)) == [
        ("boards.wood", "no export asks for it", False), ("beds.printer", "no export asks for it", False)
    ]  # fmt: skip
    assert left(plan("board", "dxf", text=text)) == [
        ("beds.printer", "no export asks for it", False),
        ("exports[1]: Slab", "lies on none of its boards, which take flat parts of their thickness", False),
    ]
    assert left(plan("plate", "dxf", text=text))[1:] == [("exports[1]: a, Slab", "lies on none of its beds", False)]


def test_a_name_that_no_file_for_a_laser_engraves_is_told() -> None:
    """The picture of the part shows it, its STL has none."""
    text = PARTS.replace("[parts.a]\n", "[parts.a]\nlabel = true\n") + PAIR
    assert text != PARTS + PAIR
    untold = ("parts.a.label", "no export asks for it", False)
    assert left(plan("stl", text=text)) == left(plan("drawing", text=text)) == [untold]
    assert left(plan("dxf", "stl", text=text)) == []
    assert untold not in left(plan("board", "stl", text=text + BOARD))
    # nobody asked for the one that a recipe gives
    assert left(plan("stl", text='[[assemblies]]\nkind = "gear_pair_model"\nteeth = [13, 21]\nmodule = 4.0\n')) == []


def test_what_is_bought_lies_on_no_board_and_no_bed_unless_they_name_it() -> None:
    """A bearing by its standard is not to be printed, however it lies in the scene."""
    bought = PARTS.replace("[parts.b]\n", '[parts.b]\nstandard = "ISO 15"\n') + PAIR
    assert bought != PARTS + PAIR

    def lying(text: str, export: str) -> set[str]:
        return {member.part.id for job in plan(export, text=text).assemblies for member in job.members}

    for export, laid in (("board", BOARD), ("plate", BED)):
        where = re.sub("parts = .*\n", "", laid)
        assert "b" in lying(PARTS + PAIR + where, export)
        assert "b" not in lying(bought + where, export)
        assert ("exports[1]: b", "is bought by its standard", False) in left(plan(export, text=bought + where))
        assert "b" in lying(bought + where + 'parts = ["b"]\n', export)


def test_a_format_that_the_scene_does_not_have_is_made_as_it_usually_is() -> None:
    made = plan("dxf", formats=["stl", "svg"])
    assert sorted(paths(made)) == sorted(f"{p}.{f}" for p in ABS for f in ("stl", "svg"))
    assert {job.place for job in made.jobs} == {"--format stl", "--format svg"}
    assert {(job.export.format, job.export.tolerance) for job in made.jobs} == {("stl", 0.01), ("svg", 0.005)}
    with pytest.raises(SceneError) as refused:
        plan(formats=[])
    assert (refused.value.key, refused.value.code) == ("exports", "no_exports")


LAYERS = '[parts.ball]\nkind = "layered"\nlayers = [{ circles = [{ diameter = 8.0 }], thickness = 3.0 }'
LAYERS += ", { circles = [{ diameter = 6.0 }], thickness = 1.0 }]\n"


def test_what_has_no_outline_is_left_out_of_flat_files_and_refused_where_it_is_named() -> None:
    made = plan("svg", "stl", text=PARTS + PAIR + LAYERS)
    assert sorted(paths(made)) == sorted([*(f"{p}.{f}" for p in ABS for f in ("svg", "stl")), "ball.stl"])
    assert left(made) == [("exports[1]", "ball has no flat outline", False)]
    # nor do paper models hold it: the section of a bevel gear at its back was to be cut out
    made = plan("model", text=PARTS + PAIR + LAYERS)
    assert left(made) == [("exports[1]", "ball has no flat outline", False)]
    assert [file.export.parts for file in made.files] == [[*ABS]]
    # the purpose of STEP is called model too
    assert paths(plan("step ball", text=PARTS + PAIR + LAYERS)) == ["ball.step"]
    assert left(plan("step", text=PARTS + PAIR + LAYERS)) == []
    for named in ("balls", "paper balls"):
        with pytest.raises(SceneError) as refused:
            plan(named, text=PARTS + PAIR + LAYERS)
        found = (refused.value.key, refused.value.value, refused.value.code)
        assert found == ("exports[1].parts", "ball", "no_flat_outline")


@pytest.mark.parametrize(("parts", "formats", "key", "code", "works"), [
    (["c"], [], "--part", "no_such_part", None), (["slap"], [], "--part", "no_such_part", "slab"),
    ([], ["dxff"], "--format", "unknown_format", "dxf"),
])  # fmt: skip
def test_parts_and_formats_that_are_not_known_are_refused_with_what_is_meant(
    parts: list[str], formats: list[str], key: str, code: str, works: str | None
) -> None:
    with pytest.raises(SceneError) as refused:
        plan("dxf", parts=parts, formats=formats)
    assert (refused.value.key, refused.value.code) == (key, code)
    given: Any = refused.value.nearest
    assert (given and given.value) == works or works is None


def test_a_format_that_the_scene_cannot_have_is_refused_as_it_was_typed() -> None:
    """Before: ``--format glb.format``, which nobody wrote."""
    with pytest.raises(SceneError) as refused:
        plan(formats=["glb"], text=BALL)
    assert (refused.value.key, refused.value.value, refused.value.code) == ("--format", "glb", "shows_what_moves")


def test_an_offset_of_a_turned_part_is_refused_in_its_export() -> None:
    with pytest.raises(SceneError) as refused:
        plan("rounded", text=BALL)
    assert (refused.value.key, refused.value.value) == ("exports[1].offset", 0.1)
    # of many parts on a plate it says which one
    assert "ball: is not for a turned solid" in str(refused.value)
    assert paths(plan("stl", text=BALL)) == ["ball.stl"]


@pytest.mark.parametrize(("keys", "key", "value", "code"), [
    ("helix_angle_deg = 12.5\n", "parts.a.helix_angle_deg", 12.5, "device_cuts_straight_teeth"),
    ("cutter = { number_of_teeth = 25 }\n", "parts.a.cutter.number_of_teeth", 25, "device_cuts_with_rack"),
])  # fmt: skip
def test_the_device_cuts_straight_teeth_with_a_rack(keys: str, key: str, value: float, code: str) -> None:
    text = GEAR.format("a", 12) + keys + '[[exports]]\nformat = "sheet"\npurpose = "generating"\n'
    with pytest.raises(SceneError) as refused:
        plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s.toml", [], [])
    assert (refused.value.key, refused.value.value, refused.value.code) == (key, value, code)
    if code == "device_cuts_straight_teeth":
        assert refused.value.nearest is not None
        assert refused.value.nearest.value == 0.0
