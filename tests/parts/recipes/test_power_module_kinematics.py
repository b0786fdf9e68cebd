"""Disks and wheels of the power module: in contact, free everywhere, the platform parallel or as the thesis has it."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.formats.read_step import read_step_assembly
from geometry.kinematics.two_disk import TwoDisk
from parts.base.refusal import SceneError
from parts.base.texts import told_in
from parts.scene.load import scene_from_dict
from parts.scene.scene_file import SceneFile
from tests.parts.recipes.test_power_table import placed, runs, struck
from tests.sampling import some_of

THESIS = TwoDisk()
# meshes without the two of the worms, which are not in it
MESHES = {"cranks": 1, "thesis": 3, "idlers": 5}
SCENE = Path(__file__).parents[3] / "parts" / "scenes" / "power_module_kinematics.toml"


def module(**keys: Any) -> SceneFile:
    return scene_from_dict({"assemblies": [{"kind": "power_module_kinematics", **keys}]}, "t", "t")


@pytest.mark.heavy
@pytest.mark.parametrize("orientation", [pytest.param("cranks", marks=pytest.mark.heavy), "thesis", "idlers"])
def test_every_mesh_is_in_contact_and_nothing_overlaps_in_motion(orientation: str, tmp_path: Path, capsys: Any) -> None:
    text = SCENE.read_text(encoding="utf-8").replace('orientation = "cranks"', f'orientation = "{orientation}"')
    (tmp_path / "module.toml").write_text(text, encoding="utf-8")
    assert main(["check", "--json", str(tmp_path / "module.toml")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert "solids" not in found
    assert not found["motion"]["uncovered"]
    meshes = [m for m in found["mates"] if "gear_pair" in m["kind"]]
    assert [m["verdict"] for m in meshes] == ["contact"] * MESHES[orientation]
    assert all(c["met"] for m in found["mates"] for c in m.get("conditions", ()))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("orientation", list(MESHES))
def test_the_platform_over_a_square_a_circle_and_a_thousand_points(orientation: str) -> None:
    """Measured on the placed instances: where it stands, and its turn, 2 (phi3 - phi2) with the thesis's wheels."""
    train = placed(module(orientation=orientation))[0].train
    assert train is not None
    rng, home = np.random.default_rng(3), train.poses([Fraction(0), Fraction(0)])["platform"][1]
    side, around = np.linspace(-60, 60, 40), np.exp(1j * np.linspace(0, 2 * math.pi, 60))
    square = np.concatenate([side - 60j, 60 + 1j * side, side[::-1] + 60j, -60 + 1j * side[::-1]])
    points = np.sqrt(rng.uniform(0, 144**2, 100)) * np.exp(1j * rng.uniform(-math.pi, math.pi, 100))
    for point in np.concatenate([square, 20 + 30j + 50 * around, points]):
        # the scene has O2 at first on +x, and counts counter-clockwise
        delta, beta = (float(a) for a in THESIS.inverse(complex(point) * 1j))
        ring = delta - (beta - math.pi) / THESIS.ratio
        poses = train.poses([Fraction(-angle / (2 * math.pi)) for angle in (delta, ring)])
        place, turn = poses["platform"]
        assert abs(place - point) < 1e-9
        wanted = 2 * (beta - math.pi) if orientation == "thesis" else 0.0
        # the drives have the digits of turns
        assert abs(math.remainder(turn - home - wanted, 2 * math.pi)) < (1e-12 if orientation != "thesis" else 1e-11)


@pytest.mark.parametrize("orientation", list(MESHES))
def test_sixty_degrees_for_thirty_of_disk_3(orientation: str) -> None:
    train = placed(module(orientation=orientation))[0].train
    assert train is not None
    before, after = (train.poses([Fraction(0), run]) for run in (Fraction(0), Fraction(20, 360)))
    turned = {key: math.degrees(after[key][1] - before[key][1]) for key in ("disk_2", "disk_3", "platform")}
    assert turned == pytest.approx({"disk_2": 0, "disk_3": 30, "platform": 60 if orientation == "thesis" else 0})


@pytest.mark.heavy
@pytest.mark.parametrize("orientation", list(MESHES))
def test_the_platform_turns_so_in_written_assemblies(orientation: str, tmp_path: Path, capsys: Any) -> None:
    """Three poses, each a STEP assembly read back: disk 3 turned in disk 2 by 0, 30, 30 degrees, at last on its way."""
    (tmp_path / "s.toml").write_text(f'[[assemblies]]\nkind = "power_module_kinematics"\norientation = "{orientation}"')
    assert main(["new", str(tmp_path / "s.toml"), "--expand"]) == 0
    parts = capsys.readouterr().out.split("[instances.")[0]
    placing = placed(module(orientation=orientation))[0]
    found = []
    for number, values in enumerate(((0, 0), (0, Fraction(1, 18)), (Fraction(1, 8), Fraction(1, 8) + Fraction(1, 18)))):
        rows = [
            f'[instances.{i.id}]\npart = "{i.part}"\nat = {list(i.at)}\nrotation_deg = {math.degrees(i.rotation)}'
            for i in placing.at(values)
        ]
        file = tmp_path / f"p{number}.toml"
        text = parts + "\n".join(rows) + '\n[[exports]]\nformat = "step"\nassembly = true\ntolerance = 0.01\n'
        file.write_text(text, encoding="utf-8")
        assert main(["build", str(file), "--no-verify", "--out", str(tmp_path), "-q"]) == 0
        read = read_step_assembly(tmp_path / f"p{number}" / f"p{number}.step")
        axes = {name: complex(matrix[0, 0], matrix[1, 0]) for name, _, matrix, _ in read.occurrences}
        found.append([axes["disk_2"], axes["disk_3"] / axes["disk_2"], axes["platform"]])
    turns = np.degrees(np.angle(np.array(found) / found[0]))
    wanted = 60 if orientation == "thesis" else 0
    assert turns == pytest.approx(np.array([[0, 0, 0], [0, 30, wanted], [45, 30, wanted]]), abs=1e-9)


# how drivers that do not fit are refused
ALLOWED = {"axle_beyond_pinion", "axle_in_the_teeth", "axles_meet", "wheels_do_not_span_arm"}
MESHED = [
    {"central_wheel", "idler_1"}, {"idler_1", "satellite_wheel"}, {"satellite_front", "idler_2"},
    {"idler_2", "platform_wheel"}, {"central_wheel", "satellite_wheel"}, {"satellite_wheel", "platform_wheel"},
]  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("orientation", list(MESHES))
def test_nothing_is_in_the_way_over_the_whole_workspace(orientation: str) -> None:
    placing, parts = placed(module(orientation=orientation))
    found = struck(placing, parts, list(runs(30)), least=16)
    assert [set(pair) for pair in found if set(pair) not in MESHED] == []


@pytest.mark.heavy
@pytest.mark.parametrize("orientation", list(MESHES))
@pytest.mark.parametrize("keys", [{}, {"module": 4.0, "teeth": [72, 108], "wheel_width": 8.0}])
def test_nothing_is_in_the_way_anywhere(orientation: str, keys: dict[str, Any]) -> None:
    placing, parts = placed(module(orientation=orientation, **keys))
    found = struck(placing, parts, list(runs(2000)), least=16)
    assert [set(pair) for pair in found if set(pair) not in MESHED] == []


def test_wheels_of_the_thesis_in_one_plane_run_into_each_other() -> None:
    # where O1O3 is below 76 mm: 16 and 11 of z 36, m 2
    made = module(orientation="thesis")
    for mate in made.mates:
        if getattr(mate, "second", "") == "platform_wheel" and hasattr(mate, "offset"):
            x, y, z = mate.offset
            mate.offset = (x, y, z - 20.0)
    placing, parts = placed(made)
    assert frozenset({"central_wheel", "platform_wheel"}) in struck(placing, parts, list(runs(30)), least=16)


def test_names_of_the_parts_list_stand_in_step_files(tmp_path: Path) -> None:
    items = json.loads((Path(__file__).parents[2] / "published" / "power_module_list.json").read_text("utf-8"))["items"]
    table = {"kind": "power_module_kinematics", "orientation": "thesis"}
    for language in some_of(("en", "uk")):
        made = scene_from_dict({"assemblies": [table]}, "t", "t", language)
        titles = {(p.position, told_in(language, p.title)) for p in made.parts.values() if p.position}
        known = {(item["pos"], item[f"name_{language}"]) for item in items}
        assert titles <= known
        assert len(titles) == 11
    scene = tmp_path / "named.toml"
    keys = 'orientation = "thesis"'
    text = SCENE.read_text(encoding="utf-8").replace('orientation = "cranks"', keys)
    text = text.replace("[scene]", '[scene]\nlanguage = "uk"') + '\n[[exports]]\nformat = "step"\nname = "alone"\n'
    scene.write_text(text, encoding="utf-8")
    assert main(["build", str(scene), "--format", "step", "--part", "central_wheel", "--out", str(tmp_path), "-q"]) == 0
    (file,) = tmp_path.rglob("*.step")
    name = next(item["name_uk"] for item in items if item["name_en"] == "Central gear wheel")
    assert "".join(f"{ord(letter):04X}" for letter in name.split()[0]) in file.read_text("ascii")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("seed", range(200))
def test_random_drivers_stand_free_or_are_refused(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pinion = int(rng.integers(30, 110))
    keys = {
        "orientation": str(rng.choice(list(MESHES))), "teeth": [pinion, pinion + 2 * int(rng.integers(8, 30))],
        "module": float(rng.choice([1.5, 2.0, 3.0, 4.0])), "wheel_module": float(rng.choice([1.0, 1.5, 2.0])),
        "platform_axle_diameter": float(rng.uniform(6, 40)), "satellite_axle_diameter": float(rng.uniform(6, 30)),
        "pin_diameter": float(rng.uniform(3, 14)), "wheel_width": float(rng.uniform(4, 20)),
    }  # fmt: skip
    try:
        placing, parts = placed(module(**keys))
        told = "axles_meet"
        found = struck(placing, parts, list(runs(20)), least=16)
    except SceneError as refused:
        told, found = refused.code, set()
    assert told in ALLOWED
    assert [set(pair) for pair in found if set(pair) not in MESHED] == [], keys


@pytest.mark.parametrize(
    ("keys", "code", "name"),
    [
        ({"teeth": [144, 96]}, "ring_as_its_wheel", "teeth"),
        ({"teeth": [40, 144]}, "axle_beyond_pinion", "teeth"),
        # 72 mm of arm in a root circle of 46.75 modules, with half of the axle and of a wall
        ({"platform_axle_diameter": 140.0}, "axle_beyond_pinion", "platform_axle_diameter"),
        ({"module": 0.3}, "axle_beyond_pinion", "module"),
        ({"orientation": "thesis", "wheel_module": 2.5}, "wheels_do_not_span_arm", "wheel_module"),
        ({"orientation": "idlers", "wheel_module": 4.0}, "wheels_do_not_span_arm", "wheel_module"),
        ({"orientation": "idlers", "platform_axle_diameter": 45.0}, "axle_in_the_teeth", "platform_axle_diameter"),
        ({"orientation": "idlers", "pin_diameter": 18.0}, "axle_in_the_teeth", "pin_diameter"),
    ],
)
def test_what_cannot_be_is_refused_by_its_driver(keys: dict[str, Any], code: str, name: str) -> None:
    with pytest.raises(SceneError) as refused:
        placed(module(**keys))
    assert refused.value.code == code
    assert name in refused.value.key
    near = refused.value.nearest
    # some module always spans the arm
    assert near is not None or code != "wheels_do_not_span_arm"
    assert all(value >= 0 for value in refused.value.numbers.values() if isinstance(value, float))
    if near is not None:
        placed(module(**keys | {name: near.value}))
