"""Tips of two gears that would reach a fillet, or the edge above an undercut one, are shortened, unless given.

The oracle turns polygons; the limits are held against the gap of both outlines, which knows nothing of them.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import affinity

from exporters.command.cli import main
from geometry.approximation.chords import approximate_profile
from geometry.plane.distance import Verdict
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from tests.exporters.making import write_scene

Pair = tuple[int, int, float, float, float, float]
# teeth, shifts, pressure and helix angle: tip on a fillet, corner within one, on an edge, on both; undercut or not
PAIRS: list[Pair] = [
    (37, 43, -0.56, -0.83, 20.0, 0.0),
    (25, 37, 0.07, -0.75, 20.0, 0.0),
    (31, 41, -0.53, -0.41, 20.0, 0.0),
    (25, 44, -0.63, -0.18, 17.5, 0.0),
    (34, 47, -0.11, -0.70, 14.5, 0.0),
    (18, 72, -0.40, -0.88, 20.0, 0.0),
    (24, 55, -0.26, -0.73, 20.0, 25.0),
    (35, 44, -0.62, -0.60, 25.0, 15.0),
]
TURNS = 24


def scene_of(pair: Pair, **more: float) -> dict[str, Any]:
    one, two, first, second, angle, helix = pair
    common = {"kind": "spur_gear", "module": 1.0, "pressure_angle_deg": angle, "face_width": 10.0}
    parts: dict[str, Any] = {
        name: common | {"number_of_teeth": teeth, "profile_shift_coefficient": shift}
        for name, teeth, shift in (("pinion", one, first), ("wheel", two, second))
    }
    for name, hand in (("pinion", "right"), ("wheel", "left")) if helix else ():
        parts[name] |= {"helix_angle_deg": helix, "hand": hand}
    mate = {"kind": "external_gear_pair", "first": "pinion", "second": "wheel"}
    for name, value in more.items():
        if name in parts:
            parts[name]["tip_diameter"] = value
        else:
            mate[name] = value
    return {"parts": parts, "instances": {name: {"part": name} for name in parts}, "mates": [mate]}


def tips_of(raw: dict[str, Any]) -> dict[str, float]:
    parts = make_parts(scene_from_dict(raw, "t", "t"), "t")[0]
    return {name: part.circles["tip_diameter"] for name, part in parts.items()}


def overlap(raw: dict[str, Any]) -> float:
    """The greatest area that both gears share over a pitch, mm2."""
    worst = 0.0
    for turn in range(TURNS):
        raw["instances"]["pinion"]["rotation_deg"] = 360 / raw["parts"]["pinion"]["number_of_teeth"] * turn / TURNS
        made = scene_from_dict(raw, "t", "t")
        parts, matings = make_parts(made, "t")
        shapes = []
        for stand in place(made.instances, made.drives, parts, matings, "t").instances:
            outline = parts[stand.part].section(0.0).region.outer
            points, _ = approximate_profile(outline, 1e-4, arcs=False).geometry.expanded()
            shape = shapely.Polygon(np.stack([points.real, points.imag], axis=1))
            shape = affinity.rotate(shape, stand.rotation, origin=(0, 0), use_radians=True)
            shapes.append(affinity.translate(shape, *stand.at[:2]))
        worst = max(worst, shapes[0].intersection(shapes[1]).area)
    return worst


@pytest.mark.sampled(1)
@pytest.mark.parametrize("pair", PAIRS, ids=str)
def test_default_tips_keep_off_fillets_and_given_ones_stay(pair: Pair) -> None:
    # chords of 1e-4 mm on two or three touching flanks
    assert overlap(scene_of(pair)) < 3e-4
    alone = {}
    for name, keys in scene_of(pair)["parts"].items():
        alone[name] = tips_of({"parts": {name: keys}})[name]
    assert overlap(scene_of(pair, **alone)) > 4e-4
    assert tips_of(scene_of(pair, **alone)) == pytest.approx(alone, rel=1e-12)
    made = tips_of(scene_of(pair))
    assert all(made[name] <= alone[name] for name in made)
    assert any(made[name] < alone[name] - 0.005 for name in made)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("backlash", [None, 0.03])
@pytest.mark.parametrize(
    ("pair", "part"),
    [
        ((37, 43, -0.56, -0.83, 20.0, 0.0), "pinion"), ((37, 43, -0.56, -0.83, 20.0, 0.0), "wheel"),
        ((28, 80, 0.12, -0.95, 20.0, 0.0), "wheel"), ((25, 44, -0.63, -0.18, 17.5, 0.0), "wheel"),
        ((25, 72, -0.47, -0.85, 20.0, 0.0), "wheel"), ((20, 63, 0.01, -0.88, 17.5, 0.0), "wheel"),
        ((38, 15, -0.31, -0.6, 25.0, 0.0), "pinion"),
    ],
    ids=str,
)  # fmt: skip
def test_the_limit_of_a_tip_is_where_its_corner_meets_the_mate(pair: Pair, part: str, backlash: float | None) -> None:
    """Half a micrometre on either side of it; with backlash where the flanks touch, half of it from the middle."""
    play = {} if backlash is None else {"normal_backlash": backlash}
    free = tips_of(scene_of(pair, **play))

    def made(tip: float) -> Any:
        return make_parts(scene_from_dict(scene_of(pair, **free | {part: tip}, **play), "t", "t"), "t")[1][0]

    # the edge is sought up to the tip that is there
    reach = made(free[part] + 0.3 if part == "wheel" else free[part] + 0.2)
    limit = reach.pair.tip_limits[["pinion", "wheel"].index(part)]
    code = f"fillet_interference_{'second' if part == 'pinion' else 'first'}"
    for off in (-0.001, 0.001):
        mating = made(limit + off)
        turn = 0.0 if backlash is None else backlash / 2 / mating.pair.second.base_radius
        verdicts = {mating.contact(sense * turn, 0.0, None).verdict for sense in (-1, 1)}
        assert (Verdict.OVERLAP in verdicts) == (off > 0)
        assert (code in {f.code for f in mating.findings()}) == (off > 0)


def test_tips_that_no_tooth_could_have_stay() -> None:
    """So short a tooth would have no flank below its chamfer: the pair is made, and tells what strikes."""
    raw = scene_of((35, 14, -0.62, -0.36, 20.0, 0.0))
    for keys in raw["parts"].values():
        keys["tip_chamfer"] = 0.1
    mating: Any = make_parts(scene_from_dict(raw, "t", "t"), "t")[1][0]
    assert mating.pair.second.tip_radius == mating.alone.second.tip_radius
    assert mating.contact(0.0, 0.0, None).verdict is Verdict.OVERLAP
    codes = {f.code for f in mating.findings()}
    assert {"fillet_interference_first", "tips_shortened_first"} <= codes
    assert not {"fillet_interference_second", "tips_shortened_second"} & codes


def test_a_build_and_its_page_tell_the_tips(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    raw = scene_of(PAIRS[0])
    head = '[[mates]]\nkind = "external_gear_pair"\nfirst = "pinion"\nsecond = "wheel"\n'
    scene = write_scene(tmp_path / "s.toml", raw["parts"], [{"format": "dxf"}], head)
    assert main(["build", str(scene), "--out", str(tmp_path / "out")]) == 0
    told = [line for line in capsys.readouterr().out.splitlines() if "tips are made shorter" in line]
    (mate,) = json.loads((tmp_path / "out" / "s" / "report.json").read_text("utf-8"))["checks"]["mates"]
    tips = tips_of(raw)
    assert len(told) == 2
    for name, role in (("pinion", "first"), ("wheel", "second")):
        (finding,) = (f for f in mate["findings"] if f["code"] == f"tips_shortened_{role}")
        assert finding["value"] == pytest.approx(tips[name], rel=1e-12)
    words = [f"{owner}.{key}={value}" for owner, name in (("first", "pinion"), ("second", "wheel"))
             for key, value in raw["parts"][name].items() if key != "kind"]  # fmt: skip

    def page_of(*arguments: str) -> tuple[list[float], float]:
        assert main(["calc", "gear-pair", *arguments, "--format", "json"]) == 0
        values = json.loads(capsys.readouterr().out)["values"]
        return [2 * values["tip_radius"][role] for role in ("first", "second")], values["contact_ratio"]

    (typed, long), (built, short) = page_of(*words), page_of(str(scene))
    assert built == pytest.approx(list(tips.values()), rel=1e-12)
    assert all(one > two for one, two in zip(typed, built, strict=True))
    assert page_of(*words, "shortened_tips=true") == (built, short)
    assert long > short == pytest.approx(mate["contact_ratio"], rel=1e-12)
