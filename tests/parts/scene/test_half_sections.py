"""Pairs decided by half sections: against sampled solids, and on spoiled parts of the power module."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.production.check import check_pair
from geometry.base.record import replace
from parts.scene.interference import solid_overlaps
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from parts.scene.scene_file import SceneFile
from tests.exporters.making import table

# a race of radius 4 at 56 from the axis, its screw holes 14 farther out
GROOVE = {
    "kind": "turned",
    "points": [{"r": 56.0, "z": 0.0}, {"r": 80.0, "z": 0.0}, {"r": 80.0, "z": 10.0}, {"r": 56.0, "z": 10.0},
               {"r": 56.0, "z": 9.0, "arc": -4.0}, {"r": 56.0, "z": 1.0}],
    "holes": {"count": 6, "diameter": 5.0, "pitch_circle_diameter": 140.0},
}  # fmt: skip


def ball(diameter: float) -> dict[str, Any]:
    return {"kind": "turned", "points": [{"r": 0.0, "z": 0.0, "arc": diameter / 2}, {"r": 0.0, "z": diameter}]}


def checked(
    parts: dict[str, Any], at: dict[str, tuple[float, float, float]], folder: Path, capsys: Any
) -> dict[str, Any]:
    text = "".join(table(f"[parts.{key}]", keys) for key, keys in parts.items())
    text += "".join(table(f"[instances.{key}]", {"at": list(place)}) for key, place in at.items())
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    main(["check", str(file), "--json"])
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize("diameter", [8.0, 8.1, 8.02])
def test_a_ball_too_large_for_its_groove_is_found(diameter: float, tmp_path: Path, capsys: Any) -> None:
    places = {"race": (0.0, 0.0, 0.0), "ball": (56.0 * math.cos(2), 56.0 * math.sin(2), 5.0 - diameter / 2)}
    solids = checked({"race": GROOVE, "ball": ball(diameter)}, places, tmp_path, capsys).get("solids", [])
    if diameter == 8.0:
        assert solids == []
        return
    # points of the ball that lie outside the groove's torus, where the race has material
    (found,) = solids
    radius, rng = diameter / 2, np.random.default_rng(1)
    p = rng.uniform(-radius, radius, (300_000, 3))
    p = p[(np.linalg.norm(p, axis=1) < radius)]
    r = np.hypot(p[:, 0] + 56.0, p[:, 1])
    # as deep as touch counts, both bodies are taken smaller
    struck = (r > 56.0) & (np.hypot(r - 56.0, p[:, 2]) > 4.0)
    assert found["volume"] == pytest.approx((2 * radius) ** 3 * struck.sum() / 300_000, rel=0.25)


@pytest.mark.parametrize(("longer", "strikes"), [(0.0, False), (0.9, False), (2.0, True)])
def test_a_bolt_too_long_for_its_blind_hole_is_found(longer: float, strikes: bool, tmp_path: Path, capsys: Any) -> None:
    hole = {"circles": [{"diameter": 200.0}, {"diameter": 8.0, "at": [90.0, 0.0]}], "thickness": 15.0}
    block = {"kind": "layered", "layers": [hole, {"circles": [{"diameter": 200.0}], "thickness": 20.0}]}
    bolt = {"kind": "pin", "diameter": 8.0, "length": 40.0 + longer}
    places = {"block": (0.0, 0.0, 0.0), "bolt": (90.0, 0.0, -26.0)}
    solids = checked({"block": block, "bolt": bolt}, places, tmp_path, capsys).get("solids", [])
    assert bool(solids) is strikes


def module(orientation: str = "thesis") -> SceneFile:
    return scene_from_dict({"assemblies": [{"kind": "power_module", "orientation": orientation}]}, "t", "t")


def placed(scene: SceneFile) -> tuple[Placing, dict[str, Any]]:
    parts, matings = make_parts(scene, "t")
    return place(scene.instances, scene.drives, parts, matings, "t"), parts


def shifted_bore(parts: Any) -> None:
    for layer in parts["disk_2"].layers:
        for circle in layer.circles:
            if circle.at == (72.0, 0.0):
                circle.at = (72.5, 0.0)
        for outline in layer.outlines:
            for point in outline.points:
                point.x += 0.5


def longer_bolt(parts: Any) -> None:
    parts["bolt_41"].layers[-1].thickness += 2.0


def larger_ball(parts: Any) -> None:
    parts["ball"].points[0].arc, parts["ball"].points[1].z = 4.05, 8.1


@pytest.mark.heavy
@pytest.mark.parametrize("orientation", ["thesis", "cranks", "idlers"])
@pytest.mark.parametrize(
    ("spoil", "pair"),
    [(shifted_bore, {"disk_2", "ball"}), (longer_bolt, {"spacer_24", "bolt_41"}),
     (larger_ball, {"ball", "bearing_ring"})],
)  # fmt: skip
def test_a_spoiled_part_of_the_power_module_is_found(
    spoil: Callable[[Any], None], pair: set[str], orientation: str
) -> None:
    scene = module(orientation)
    spoil(scene.parts)
    placing, parts = placed(scene)
    of = {i.id: i.part for i in placing.instances}
    assert pair in [{of[x.first], of[x.second]} for x in solid_overlaps(placing, parts)]


# the wheel that is turned by a quarter of its pitch, its mate, their numbers of teeth and of meshes
_TURNED = {
    "thesis": ("central_wheel", "satellite_wheel", 36, 5), "cranks": ("ring", "pinion", 96, 3),
    "idlers": ("idler_1", "satellite_wheel", 24, 7),
}  # fmt: skip


@pytest.mark.heavy
@pytest.mark.parametrize("orientation", _TURNED)
def test_meshes_of_the_power_module_are_in_touch_and_a_worm_or_wheel_out_of_place_is_found(orientation: str) -> None:
    placing, parts = placed(module(orientation))
    mate, wheel, teeth, count = _TURNED[orientation]
    meshes = {(m.first.id, m.second.id): m.mating for m in placing.mates if m.mating.has_contact}
    assert len(meshes) == count
    for (first, _), mating in meshes.items():
        assert check_pair(mating, "en")["verdict"] == "contact"
        if first.startswith("worm_wheel"):
            assert check_pair(mating, "en", centre_shift=-0.05)["verdict"] == "overlap"
    assert check_pair(meshes[mate, wheel], "en", second_turn=math.tau / teeth / 4)["verdict"] == "overlap"
    # by its solid too, where no mate leaves it to its contact
    turned = [
        replace(i, rotation=i.rotation + math.tau / teeth / 4) if i.id == wheel else i
        for i in placing.instances
        if i.id in (mate, wheel)
    ]
    found = solid_overlaps(replace(placing, instances=tuple(turned), mates=()), parts)
    assert {mate, wheel} in [{x.first, x.second} for x in found]


@pytest.mark.heavy
def test_the_power_module_is_clear_all_over_its_workspace(capsys: Any) -> None:
    assert main(["check", "power_module", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert "solids" not in found
    told = found["workspace"]
    count = len(module("cranks").instances)
    assert sum(len(pairs) for pairs in (told["tested"], *told["rest"].values())) == count * (count - 1) // 2
    assert told["uncovered"] == []
    # balls roll in their grooves, in touch, one row for two parts
    fits = {tuple(sorted(fit["parts"])): fit for fit in told["fits"]}
    for races, pairs in (
        ("bearing_ring", 116), ("disk_3", 64), ("guide_5", 58), ("guide_6", 58), ("spacer_22", 58),
    ):  # fmt: skip
        fit = fits[tuple(sorted(("ball", races)))]
        assert (fit["pairs"], fit["touching"]) == (pairs, pairs)
    # all but the one before each plug run on the bore; disk 2 stands below the balls of the housing
    fit = fits["ball", "disk_2"]
    assert (fit["pairs"], fit["touching"]) == (120, 62)
    assert fits["ball", "plug"]["least"] == pytest.approx(0.1, abs=1e-4)
    assert fits["end_cover", "worm"]["least"] == pytest.approx(0.05, abs=1e-6)
