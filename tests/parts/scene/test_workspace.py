"""Solids wherever two drives may stand: against GEOS on a grid of both, pair by pair."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import affinity

from exporters.command.cli import main
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from parts.scene.train import Train
from tests.exporters.making import table

# an arm on the frame, on it a second one, both 60 x 10 with their pivots in the origin; posts in the way of the second
LINK = {"kind": "plate", "width": 60.0, "height": 10.0, "centre": [25.0, 0.0], "face_width": 4.0}
POST = {"kind": "pin", "diameter": 6.0, "length": 4.0}
DRIVES = [{"instance": "one", "turns": 1.0}, {"instance": "two", "turns": 2.0}]
MATES = [{"kind": "carried", "first": "one", "second": "two", "offset": [50.0, 0.0, 4.5]}]


def scene(post: tuple[float, float, float], poses: int = 400) -> dict[str, Any]:
    at = {"one": {"at": [0.0, 0.0, 0.0]}, "post": {"at": list(post)}, "two": {}}
    parts = {"one": LINK, "two": LINK, "post": POST}
    return {"parts": parts, "instances": at, "mates": MATES, "drives": DRIVES, "checks": {"workspace": poses}}


def checked(raw: dict[str, Any], folder: Path, capsys: Any) -> dict[str, Any]:
    text = "".join(table(f"[{n}.{key}]", keys) for n in ("parts", "instances") for key, keys in raw[n].items())
    text += "".join(table(f"[[{name}]]", row) for name in ("mates", "drives") for row in raw[name])
    file = folder / "scene.toml"
    file.write_text(text + table("[checks]", raw["checks"]), encoding="utf-8")
    main(["check", str(file), "--json"])
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def train_of(raw: dict[str, Any]) -> Train:
    made = scene_from_dict(raw, "t", "t")
    parts, matings = make_parts(made, "t")
    train = place(made.instances, made.drives, parts, matings, "t").train
    assert train is not None
    return train


def area(raw: dict[str, Any], turns: tuple[float, ...]) -> float:
    """What the second arm and the post have in common, by GEOS."""
    at, angle = train_of(raw).poses(turns)["two"]
    arm = affinity.rotate(shapely.box(-5, -5, 55, 5), angle, origin=(0, 0), use_radians=True)
    x, y, _ = raw["instances"]["post"]["at"]
    return float(affinity.translate(arm, at.real, at.imag).intersection(shapely.Point(x, y).buffer(3, 64)).area)


@pytest.mark.parametrize(
    ("post", "strikes"),
    [
        # the second arm reaches from 50 - 55.2 to 50 + 55.2 from the middle; its pivot's end 7.1 beyond the pivot
        ((0.0, -95.0, 4.5), True), ((-70.0, 70.0, 4.5), True), ((0.0, 107.9, 4.5), True), ((0.0, 108.4, 4.5), False),
        ((3.0, 2.0, 4.5), True),
    ],
)  # fmt: skip
def test_what_meets_where_both_drives_stand_for_themselves_is_found(
    post: tuple[float, float, float], strikes: bool, tmp_path: Path, capsys: Any
) -> None:
    raw = scene(post)
    found = checked(raw, tmp_path, capsys)
    solids = found.get("solids", [])
    assert [(x["first"], x["second"]) for x in solids] == [("two", "post")] * strikes
    if strikes:
        (struck,) = solids
        turns = tuple(struck["drive_turns_deg"][name] / 360 for name in ("one", "two"))
        assert struck["volume"] == pytest.approx(4 * area(raw, turns), rel=0.05, abs=0.15)
    # of all pairs it is told why they were held, or need not be
    told = found["workspace"]
    pairs = [tuple(pair[:2]) for pair in (*told["tested"], *(p for found in told["rest"].values() for p in found))]
    assert sorted(map(sorted, pairs)) == [["one", "post"], ["one", "two"], ["post", "two"]]
    assert ["one", "two"] in told["rest"]["height"]


def test_the_way_of_the_drives_alone_does_not_show_it(tmp_path: Path, capsys: Any) -> None:
    raw = scene((-70.0, 70.0, 4.5))
    way = [area(raw, (t, 2 * t)) for t in np.linspace(0, 1, 721)]
    raw["checks"] = {}
    assert bool(max(way)) is bool(checked(raw, tmp_path, capsys).get("solids"))


def test_a_pair_hangs_on_as_many_drives_as_move_it(tmp_path: Path, capsys: Any) -> None:
    raw = scene((0.0, -120.0, 0.0))
    # a stop on the first arm meets the second wherever that is turned against the first: either drive shows it
    raw["parts"]["stop"] = {**POST, "length": 4.0}
    raw["instances"]["post"]["at"] = [60.0, 60.0, 0.0]
    raw["instances"]["stop"] = {}
    raw["mates"] = [*MATES, {"kind": "fixed", "first": "one", "second": "stop", "offset": [30.0, 15.0, 4.5]}]
    found = checked(raw, tmp_path, capsys)
    hung = {frozenset(pair[:2]): pair[2] for pair in found["workspace"]["tested"]}
    assert hung[frozenset(("two", "stop"))] == ["one"]
    assert [x["first"] for x in found["solids"]] == ["two"]


def test_cells_that_too_few_poses_leave_open_are_told(tmp_path: Path, capsys: Any) -> None:
    # a corner of the arm reaches the post by 0.03 mm
    (told,) = checked(scene((0.0, 108.2, 4.5), poses=3), tmp_path, capsys)["workspace"]["uncovered"]
    assert told["depth"] > 0.03
    assert told["poses"] <= 3 + 2


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"drives": []}, "workspace_needs_drives"),
        ({"parts": {"one": {"kind": "rack", "module": 2.0, "number_of_teeth": 9, "face_width": 4.0},
                    "two": {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 4.0}},
          "instances": {}, "mates": [{"kind": "rack_pair", "first": "two", "second": "one"}],
          "drives": [{"instance": "two"}]}, "workspace_of_turns"),
    ],
)  # fmt: skip
def test_where_drives_tell_no_workspace_the_key_is_refused(changes: dict[str, Any], code: str) -> None:
    from parts.scene.checks import check_workspace

    made = scene_from_dict(scene((0.0, 0.0, 9.0)) | changes, "t", "t")
    parts, matings = make_parts(made, "t")
    with pytest.raises(SceneError) as refused:
        check_workspace(400, place(made.instances, made.drives, parts, matings, "t"), "t")
    assert (refused.value.code, refused.value.key) == (code, "checks.workspace")
