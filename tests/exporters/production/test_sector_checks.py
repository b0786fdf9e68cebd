"""What checks tell of sectors in mesh: where they leave it, what they move, whether their first tooth jams."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shapely.affinity import rotate, translate

from tests.exporters.making import run, table
from tests.exporters.production.test_checks_found import checked, made
from tests.geometry.gears.teeth.test_sector import polygon

Raw = dict[str, Any]
GEAR: Raw = {"kind": "spur_gear", "module": 2.0, "face_width": 5.0}
SECTOR = GEAR | {"number_of_teeth": 40, "sector": {"teeth": 9}}
PINION = GEAR | {"number_of_teeth": 20}
RING: Raw = {"kind": "ring_gear", "module": 2.0, "face_width": 5.0, "number_of_teeth": 60}
RACK: Raw = {"kind": "rack", "module": 2.0, "number_of_teeth": 20, "face_width": 5.0}


def pair(kind: str, first: Raw, second: Raw, turns: float | None, *, start: float = 0.0, **mate: Any) -> Raw:
    """Two instances, the first turned so far, deg, and driven."""
    return {
        "parts": {"a": first, "b": second},
        "instances": {"a": {"rotation_deg": start}, "b": {}},
        "mates": [{"kind": kind, "first": "a", "second": "b", **mate}],
        "drives": [] if turns is None else [{"instance": "a", "turns": turns}],
    }


def found_of(raw: Raw, folder: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, Raw]:
    code, found = checked(raw, folder, capsys)
    return code, found["mates"][0]


def codes(mate: Raw) -> dict[str, float]:
    return {f["code"]: f["value"] for f in mate["findings"]}


@pytest.mark.parametrize(
    ("kind", "first", "second", "direction"),
    [
        ("external_gear_pair", SECTOR, PINION, 0.0),
        ("external_gear_pair", PINION | {"sector": {"teeth": 6, "first_tooth": -5}}, SECTOR | {"sector": None}, 30.0),
        ("internal_gear_pair", RING | {"sector": {"teeth": 10}}, PINION, 0.0),
        ("internal_gear_pair", PINION | {"sector": {"teeth": 7}}, RING, 180.0),
        ("rack_pair", SECTOR, RACK, 0.0),
    ],
)
def test_a_drive_that_leaves_the_mesh_is_told_by_how_much(
    kind: str, first: Raw, second: Raw, direction: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As far beyond the end of contact as it is driven; up to there nothing is said."""
    first, second = ({k: v for k, v in keys.items() if v is not None} for keys in (first, second))
    # a pinion sees the mesh away from the ring's axis
    start = 0.0 if kind == "internal_gear_pair" else direction
    base = pair(kind, first, second, 0.01, start=start, direction_deg=direction, normal_backlash=0.1)
    _, mate = found_of(base, tmp_path, capsys)
    (sector,) = mate["sectors"]
    low, high = sector["mesh_from_deg"], sector["mesh_to_deg"]
    # turned the other way it leaves with its other flanks: the widest of both counts
    last = max(high, -low - 2 * _middle(first))
    # two turns too far is no less
    for beyond in (-1.0, 2.5, 722.5):
        turned = (last + beyond) / 360
        code, mate = found_of({**base, "drives": [{"instance": "a", "turns": turned}]}, tmp_path, capsys)
        told = codes(mate).get("sector_leaves_mesh")
        assert code == 0
        assert (told is not None) is (beyond > 0)
        if told is not None:
            assert told == pytest.approx(beyond, abs=1e-6)


def _middle(keys: Raw) -> float:
    """The direction of the middle of a run, deg, counted tooth by tooth."""
    n, ring = keys["sector"]["teeth"], keys["kind"] == "ring_gear"
    first = keys["sector"].get("first_tooth", -(n // 2) if ring else -((n - 1) // 2))
    return (first + (n - 1) / 2 + 0.5 * ring) * 360 / keys["number_of_teeth"]


def test_a_sector_whose_runs_follow_each_other_in_mesh_never_leaves_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One tooth of twenty is left out: the last one is in mesh as the first one comes."""
    raw = pair("external_gear_pair", PINION | {"sector": {"teeth": 19}}, SECTOR | {"sector": {"teeth": 39}}, 3.0)
    assert "sector_leaves_mesh" not in codes(found_of(raw, tmp_path, capsys)[1])


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("kind", "second", "place"),
    [
        ("external_gear_pair", SECTOR | {"sector": None}, 0),
        ("external_gear_pair", SECTOR | {"sector": None}, 1),
        ("internal_gear_pair", RING, 0),
        ("internal_gear_pair", RING, 1),
        ("rack_pair", RACK, 0),
    ],
)
def test_helical_teeth_are_in_mesh_earlier_or_later_by_their_lead(
    kind: str, second: Raw, place: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Right-handed ones stand ahead at the top, by b tan(beta) / r: they are in mesh earlier, left-handed later."""
    found = {}
    for hand, other in (("right", "left"), ("left", "right")):
        mate = hand if kind == "internal_gear_pair" else other
        ends = [keys | {"helix_angle_deg": 20.0, "hand": mate} for keys in (PINION, second)]
        ends[place] |= {"hand": hand, "sector": {"teeth": 7}}
        first, last = ({k: v for k, v in keys.items() if v is not None} for keys in ends)
        (found[hand],) = found_of(pair(kind, first, last, None), tmp_path, capsys)[1]["sectors"]
    lead = math.degrees(5.0 * math.sin(math.radians(20)) / (PINION, second)[place]["number_of_teeth"])
    for end in ("mesh_from_deg", "mesh_to_deg"):
        assert found["left"][end] - found["right"][end] == pytest.approx(lead, rel=1e-9)
    one = found["right"]
    assert one["mesh_to_deg"] - one["mesh_from_deg"] == pytest.approx(one["mesh_angle_deg"], rel=1e-9)


def test_a_sector_that_stands_out_of_mesh_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without a drive too: a rack below it, its teeth to the right."""
    wrong = pair("rack_pair", SECTOR, RACK, None, direction_deg=-90.0)
    assert "sector_leaves_mesh" in codes(found_of(wrong, tmp_path, capsys)[1])
    right = pair("rack_pair", SECTOR, RACK, None, start=-90.0, direction_deg=-90.0)
    assert "sector_leaves_mesh" not in codes(found_of(right, tmp_path, capsys)[1])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("way", ["counter_clockwise", "clockwise"])
def test_an_intermittent_pair_turns_by_whole_teeth_and_is_clear(way: str) -> None:
    """Poses of the drives, as films show them: no outline is in the other through a turn."""
    sense = 1 if way == "counter_clockwise" else -1
    first = GEAR | {"number_of_teeth": 24, "sector": {"teeth": 4, "runs": 2}}
    raw = pair("external_gear_pair", first, GEAR | {"number_of_teeth": 18}, float(sense), intermittent=way,
               normal_backlash=0.2)  # fmt: skip
    _, parts, placing = made(raw)
    shapes = {name: polygon(part.section(0.0).region.outer) for name, part in parts.items()}
    turned = []
    for share in np.linspace(0.0, 1.0, 90):
        where = {i.id: i for i in placing.at([float(sense * share)])}
        a, b = (
            translate(rotate(shapes[k], math.degrees(i.rotation), origin=(0, 0)), i.centre.real, i.centre.imag)
            for k, i in where.items()
        )
        # the second stands in the middle of its backlash: half of it is left
        assert a.intersection(b).area < 1e-6
        turned.append(where["b"].rotation)
    steps = np.diff(np.unwrap(turned))
    # two runs of 4 + 1 teeth of 18; more than half of the time it stands
    assert np.sum(steps) == pytest.approx(-sense * 2 * 5 / 18 * math.tau, abs=1e-9)
    assert np.count_nonzero(np.abs(steps) < 1e-12) > 45


@pytest.mark.parametrize(("teeth", "jams"), [(18, False), (20, True)])
def test_a_first_tooth_that_jams_is_told(
    teeth: int, jams: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A broken condition, with the turn of the first at which it jams and the tips that come in."""
    first = GEAR | {"number_of_teeth": 24, "sector": {"teeth": 4, "runs": 2}}
    raw = pair("external_gear_pair", first, GEAR | {"number_of_teeth": teeth}, 1.0, intermittent="clockwise")
    code, mate = found_of(raw, tmp_path, capsys)
    assert code == int(jams)
    assert (mate["sectors"][0]["entry_margin"] < 0) is jams
    assert ("conditions" in mate) is jams
    # how it enters is said of what does
    assert run("check", tmp_path / "s.toml") == int(jams)
    assert ("its first tooth enters a standing b" in capsys.readouterr().out) is not jams
    if not jams:
        return
    (found,) = mate["conditions"]
    # the tip corner of the last tooth, which comes first, where the tip circles of 26 m and 22 m cross
    crossing = math.acos((44**2 + 26**2 - 22**2) / (2 * 44 * 26))
    half = math.pi / 48 + _involute(math.radians(20)) - _involute(math.acos(24 * math.cos(math.radians(20)) / 26))
    # tooth -1 stands first of -1 to 2
    asked = math.degrees(crossing + half) + 360 / 24
    assert found["angle_deg"] == pytest.approx(asked, abs=1e-3)
    assert found["value"] == mate["sectors"][0]["entry_margin"]
    for tip, comes_in in ((found["tip_diameter"], True), (found["tip_diameter"] + 1e-3, False)):
        shorter = {**raw, "parts": {**raw["parts"], "a": first | {"tip_diameter": tip}}}
        assert (found_of(shorter, tmp_path, capsys)[0] == 0) is comes_in


def _involute(angle: float) -> float:
    return math.tan(angle) - angle


@pytest.mark.parametrize(
    ("first", "second", "code"),
    [
        (PINION, PINION, "intermittent_needs_sector"),
        (PINION | {"helix_angle_deg": 20.0, "sector": {"teeth": 4}},
         PINION | {"helix_angle_deg": 20.0, "hand": "left"}, "intermittent_needs_straight_teeth"),
        # films had it go on by itself where its teeth are missing
        (GEAR | {"number_of_teeth": 27, "sector": {"teeth": 2, "runs": 3}}, PINION | {"sector": {"teeth": 6}},
         "intermittent_needs_whole_mate"),
        (PINION | {"sector": {"teeth": 19}}, PINION, "intermittent_never_stands"),
    ],
)  # fmt: skip
def test_what_cannot_stand_between_runs_is_refused(
    first: Raw, second: Raw, code: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from tests.exporters.making import run

    raw = pair("external_gear_pair", first, second, None, intermittent="clockwise")
    text = "".join(table(f"[parts.{key}]", keys) for key, keys in raw["parts"].items())
    (tmp_path / "s.toml").write_text(text + table("[[mates]]", raw["mates"][0]), encoding="utf-8")
    assert run("check", tmp_path / "s.toml") == 2
    told = capsys.readouterr().err
    words = {"needs_sector": "with a sector", "needs_straight_teeth": "straight teeth", "never_stands": "never stand",
             "needs_whole_mate": "all its teeth"}  # fmt: skip
    assert words[code.removeprefix("intermittent_")] in told
    assert "remove intermittent" in told
