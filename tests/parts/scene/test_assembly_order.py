"""The order of assembly: written in scenes, held step by step; steps exchanged and ways turned are found."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.command.new import plain_scene
from parts.base.refusal import SceneError
from parts.scene.files import built_in_scenes
from parts.scene.load import load_scene, scene_from_dict
from tests.oracles.clearances import solid_of
from tests.parts.recipes.test_power_table import placed

Changed = Callable[[list[str]], list[str]]


def checked(folder: Path, capsys: Any, name: str, changed: Changed | None = None) -> tuple[int, dict[str, Any]]:
    """What ``check`` says of the order of a built-in scene, its steps changed."""
    text = plain_scene(built_in_scenes()[name].read_text("utf-8"), name)
    # the module's solids through whole periods would take far longer than its order
    text = text.replace("workspace = 400", "workspace = 1" if name == "power_module" else "")
    head, *steps = re.split(r"(?=\[\[steps\]\])", text)
    *_, last = steps
    own, tail = re.split(r"\n\n(?=\[)", last, maxsplit=1) if "\n\n[" in last else (last, "")
    steps[-1] = own + "\n"
    steps = changed(steps) if changed else steps
    path = folder / "order.toml"
    path.write_text("\n\n".join([head, *(step.strip() for step in steps), tail]), "utf-8")
    code = main(["check", str(path), "--json"])
    out, error = capsys.readouterr()
    # a signal that stops the tests ends a command within them, which then has nothing to say but that
    assert code in (0, 1), error
    return code, json.loads(out)["order"]


def bringing(steps: list[str], word: str) -> int:
    return next(k for k, step in enumerate(steps) if f'bring = ["{word}"' in step)


def exchanged(one: str, two: str) -> Changed:
    def change(steps: list[str]) -> list[str]:
        a, b = bringing(steps, one), bringing(steps, two)
        steps[a], steps[b] = steps[b], steps[a]
        return steps

    return change


def turned(word: str, along: str) -> Changed:
    def change(steps: list[str]) -> list[str]:
        k = bringing(steps, word)
        steps[k] = re.sub(r"along = .*", f"along = {along}", steps[k])
        return steps

    return change


def without(word: str, key: str) -> Changed:
    """A snap ring that is not ``opened``; or each ball where it stands in the end, not all through ``one_hole``."""

    def change(steps: list[str]) -> list[str]:
        k = bringing(steps, word)
        steps[k] = re.sub(rf"{key} = .*", "", steps[k])
        return steps

    return change


def hindered(order: dict[str, Any]) -> set[tuple[str, str]]:
    return {(row["coming"], row["standing"]) for row in order["hindered"]}


def test_a_table_goes_together_in_its_order_and_tells_it(tmp_path: Path, capsys: Any) -> None:
    code, order = checked(tmp_path, capsys, "power_table_laser")
    assert code == 0
    assert order["hindered"] == []
    scene = load_scene("power_table_laser")
    # what one step brings stands to each other as it will in the end
    together = sum(math.comb(len(step.bring), 2) for step in scene.steps)
    assert sum(order["pairs"].values()) + together == math.comb(len(scene.instances), 2)
    assert main(["check", str(tmp_path / "order.toml"), "--steps", "--language", "uk"]) == 0
    told = capsys.readouterr().out
    assert "порядок складання, 25 кроків: кожна деталь прямо доходить до свого місця" in told
    assert re.search(r"^14\. .* → .*: зверху$", told, re.MULTILINE)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("changed", "pairs"),
    [
        # no crank goes under the flange that stands, no disk past the ring's teeth
        (exchanged("first_crank_1", "flange"), {("first_crank_1", "flange"), ("first_crank_2", "flange")}),
        (exchanged("disk_2", "pinion"), {("disk_2", "pinion")}),
        (turned("pinion", "[1.0, 0.0, 0.0]"), {("pinion", "ring"), ("pinion", "axle")}),
        (turned("tube", "[0.0, 0.0, -1.0]"), set()),
    ],
)
def test_steps_exchanged_and_ways_turned_are_found(
    changed: Changed, pairs: set[tuple[str, str]], tmp_path: Path, capsys: Any
) -> None:
    code, order = checked(tmp_path, capsys, "power_table_laser", changed)
    found = hindered(order)
    assert code == (1 if pairs else 0)
    assert pairs <= found
    assert bool(pairs) == bool(found)


WAY = """
[parts]
base = {{ kind = "plate", width = 60.0, height = 60.0, face_width = 4.0 }}
post = {{ kind = "plate", width = 40.0, height = 40.0, face_width = 6.0, holes = {holes} }}
collar = {{ kind = "pin", diameter = 18.0, length = 5.0, bore_diameter = 12.2 }}

[instances]
base = {{ at = [0.0, 0.0, 0.0], held = true }}
{name} = {{ part = "post", at = [0.0, 0.0, 24.5], axis = {axis}, held = true }}
collar = {{ at = {at}, axis = {axis}, held = true }}

[[steps]]
bring = ["{name}"]
to = "base"
along = [0.0, 0.0, -1.0]

[[steps]]
bring = ["collar"]
to = "{name}"
along = {axis}

[[exports]]
format = "stl"
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("axis", "at"), [([0.0, -1.0, 0.0], [0.0, -6.5, 24.5]), ([1.0, 0.0, 0.0], [6.5, 0.0, 24.5])])
@pytest.mark.parametrize("name", ["post", "first_post"])
@pytest.mark.parametrize(("bore", "passes"), [(None, False), (12.6, False), (18.6, True)])
def test_a_part_behind_a_wall_passes_only_by_a_hole_wide_enough(
    bore: float | None, passes: bool, name: str, axis: list[float], at: list[float], tmp_path: Path, capsys: Any
) -> None:
    """Also where what stands, brought by a step before, has the name of its part."""
    holes = "[]" if bore is None else f"[{{ at = [0.0, 0.0], diameter = {bore} }}]"
    path = tmp_path / "way.toml"
    path.write_text(WAY.format(name=name, holes=holes, axis=axis, at=at), "utf-8")
    assert main(["check", str(path), "--json"]) == (0 if passes else 1)
    order = json.loads(capsys.readouterr().out)["order"]
    assert hindered(order) == (set() if passes else {("collar", name)})
    if not passes:
        # a cylinder of 18 through a plate of 6, the bore off
        whole = 6 * math.pi / 4 * (18.0**2 - max(12.2, bore or 0.0) ** 2)
        assert order["hindered"][0]["volume"] == pytest.approx(whole, rel=0.02)


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["power_table_print", "power_module"])
def test_the_print_table_and_the_module_go_together(name: str, tmp_path: Path, capsys: Any) -> None:
    """Both worms past their wheels, the pinion into the ring, disk 3 into disk 2, each ball into its groove."""
    code, order = checked(tmp_path, capsys, name)
    assert code == 0
    assert order["hindered"] == []


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("changed", "pair"),
    [
        (exchanged("large_ball_1", "guide_5"), ("large_ball_1_1", "guide_5")),
        (exchanged("guide_6", "ring"), ("worm_wheel_25", "guide_6")),
        (exchanged("bearing_ring_1", "large_ball_2"), ("large_ball_2_1", "bearing_ring_1")),
        (turned("worm_1", "[0.0, 0.0, -1.0]"), ("worm_1", "body")),
        # guide 13 on the pinion is wider than the tips of the ring
        (turned("pinion", "[0.0, 0.0, -1.0]"), ("ring_guide", "ring")),
        # balls do not go through what a plug or a ring closes, nor past the edge of disk 3 but in the hole
        (exchanged("small_ball_1", "plug_1"), ("small_ball_1_1", "plug_1")),
        (exchanged("small_ball_2", "protective_ring_2"), ("small_ball_2_1", "protective_ring_2")),
        (exchanged("small_cage_2", "small_ball_2"), ("small_ball_2_1", "small_cage_2")),
        (without("small_ball_1", "one_hole"), ("small_ball_1_2", "disk_2")),
        (without("snap_ring_1", "opened"), ("snap_ring_1", "worm_1")),
    ],
)
def test_in_the_module_too(changed: Changed, pair: tuple[str, str], tmp_path: Path, capsys: Any) -> None:
    code, order = checked(tmp_path, capsys, "power_module", changed)
    assert code == 1
    assert pair in hindered(order)


@pytest.mark.heavy
@pytest.mark.parametrize(
    "part", ["large_ball_1_1", "worm_wheel_25", "guide_5", "small_ball_1_1", "disk_3", "ring_guide"]
)
def test_points_just_within_a_part_never_lie_in_what_stands(part: str) -> None:
    """By an oracle that has no sections: the part at places on its way, its points sought in all that stands."""
    from parts.scene.assembly_order import legs
    from parts.scene.steps import stages

    scene = scene_from_dict({"assemblies": [{"kind": "power_module"}]}, "t", "t")
    stand = {i.id: i for i in placed(scene)[0].instances}
    solids = {key: solid_of(spec) for key, spec in scene.parts.items()}
    for stage in stages(scene.steps, scene.instances):
        if part not in stage.moved:
            continue
        moved, others = stand[part], [stand[key] for key in stage.standing if stand[key].axis == (0.0, 0.0, 1.0)]
        points = solids[moved.part].points
        flat = (points[:, 0] + 1j * points[:, 1]) * np.exp(1j * moved.rotation) + moved.centre
        for leg in legs(stage.step, moved, stand[stage.step.to]):
            for far in np.linspace(0.0, min(leg.length, 300.0), 16):
                x, y, z = (-left - far * way for left, way in zip(leg.left, leg.way, strict=True))
                for other in others:
                    if {moved.id, other.id} == {"pinion", "ring"}:
                        continue
                    own = (flat + complex(x, y) - other.centre) * np.exp(-1j * other.rotation)
                    height = points[:, 2] + moved.at[2] + z - other.at[2]
                    near = (np.abs(own) < solids[other.part].reach) & (height > solids[other.part].low)
                    near &= height < solids[other.part].high
                    if near.any():
                        place = np.column_stack([own.real, own.imag, height])[near]
                        assert not solids[other.part].holds(place).any(), (other.id, far, leg)


_PLATE = {"kind": "plate", "width": 40.0, "height": 40.0, "face_width": 5.0}


@pytest.mark.parametrize(
    ("steps", "word"),
    [
        ([{"bring": ["a"], "to": "b"}], "leave c apart"),
        ([{"bring": ["a"], "to": "b"}, {"bring": ["b"], "to": "a"}], r"steps\[2\].bring.*already joined to a"),
        ([{"bring": ["a"], "to": "b", "along": [0.0, 0.0, 0.0]}], r"steps\[1\].along.*no direction"),
        ([{"bring": ["a"], "to": "b", "outwards": 3.0}], r"steps\[1\].outwards.*along"),
        ([{"bring": ["a"], "to": "b", "along": [0.0, 0.0, 1.0], "outwards": 0.0}], r"steps\[1\].outwards.*not be 0"),
        ([{"bring": ["a"], "to": "b", "along": [0.0, 0.0, 1.0], "one_hole": True}], r"steps\[1\].one_hole.*outwards"),
        ([{"bring": ["a"], "to": "b", "opened": 1.0}], r"steps\[1\].opened.*turned parts"),
        ([{"bring": ["d"], "to": "b"}], r'steps\[1\].bring = "d"'),
        ([{"bring": [], "to": "b"}], r"steps\[1\].bring"),
        ([{"bring": ["a"], "to": "b", "onto": "c"}], r"steps\[1\].*onto"),
    ],
)
def test_steps_that_are_none_are_refused_by_their_key(steps: list[dict[str, Any]], word: str) -> None:
    parts = {name: dict(_PLATE) for name in "abc"}
    with pytest.raises(SceneError) as refusal:
        scene_from_dict({"parts": parts, "steps": steps}, "t", "t")
    from parts.base.refusal import sentence

    assert re.search(word, sentence(refusal.value, "en"))


ALIKE = """
[parts]
base = {{ kind = "plate", width = 300.0, height = 60.0, face_width = 4.0 }}
wall = {{ kind = "plate", width = 40.0, height = 40.0, face_width = 5.0, holes = {hole} }}
rod = {{ kind = "pin", diameter = 8.0, length = 6.0 }}

[instances]
base = {{ at = [0.0, 0.0, {floor}], held = true }}
one = {{ part = "wall", at = [0.0, 0.0, 0.0], held = true }}
two = {{ part = "wall", at = [100.0, 0.0, {height}], rotation_deg = {turn}, held = true }}
first = {{ part = "rod", at = {first}, held = true }}
second = {{ part = "rod", at = {second}, held = true }}

[[steps]]
bring = ["one", "two"]
to = "base"
along = [0.0, 0.0, -1.0]

[[steps]]
bring = ["first"]
to = "one"
along = {along}

[[steps]]
bring = ["second"]
to = "two"
along = {along}

[[exports]]
format = "stl"
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("along", "turn", "height", "first", "second", "hit"),
    [
        # upwards through the hole; the second where a wall that is turned on has none, and where it has its own
        ([0.0, 0.0, 1.0], 90.0, 0.0, [10.0, 0.0, 8.0], [100.0, -10.0, 8.0], True),
        ([0.0, 0.0, 1.0], 90.0, 0.0, [10.0, 0.0, 8.0], [100.0, 10.0, 8.0], False),
        ([0.0, 0.0, 1.0], -30.0, 0.0, [10.0, 0.0, 8.0], [100.0 + 5 * 3**0.5, -5.0, 8.0], False),
        ([0.0, 0.0, 1.0], -30.0, 0.0, [10.0, 0.0, 8.0], [100.0 + 5 * 3**0.5, 5.0, 8.0], True),
        # over a wall from one side to the other; the second at the height of its own, as much higher as that is
        ([0.0, 1.0, 0.0], 0.0, 8.0, [0.0, 30.0, 18.0], [100.0, 30.0, 10.0], True),
        ([0.0, 1.0, 0.0], 0.0, 8.0, [0.0, 30.0, 18.0], [100.0, 30.0, 26.0], False),
    ],
)
def test_of_pairs_that_are_alike_each_is_held_where_it_stands(
    along: list[float], turn: float, height: float, first: list[float], second: list[float], hit: bool,
    tmp_path: Path, capsys: Any,
) -> None:  # fmt: skip
    """What is found of a pair is taken for others of the same parts, as often as they stand alike to each other."""
    path = tmp_path / "alike.toml"
    hole = "[{ at = [10.0, 0.0], diameter = 9.0 }]"
    floor = -40.0 if along[2] else -10.0
    path.write_text(
        ALIKE.format(along=along, turn=turn, height=height, first=first, second=second, floor=floor, hole=hole), "utf-8"
    )
    main(["check", str(path), "--json"])
    order = json.loads(capsys.readouterr().out)["order"]
    found = {pair for pair in hindered(order) if pair[1] in ("one", "two")}
    assert found == ({("second", "two")} if hit else set())
