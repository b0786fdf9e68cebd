"""Refusals that one key alone does not cure: what they offer together works at once and is near to what was typed."""

from __future__ import annotations

import copy
import re
from typing import Any

import pytest

from parts.offer_several import followed, together
from parts.offers import REMOVED, Change, changed
from parts.schema import SceneError
from tests.offered import PHASES, Raw, at, builds, cam, fault_of, offered, put


def one(part: Raw) -> Raw:
    return {"parts": {"p": part}, "exports": [{"format": "svg"}]}


def phases(*angles: float) -> list[Raw]:
    return [p | {"angle_deg": a} for p, a in zip(copy.deepcopy(PHASES), angles, strict=True)]


DWELL_FIRST = [PHASES[1] | {"angle_deg": 0.0}, *(p | {"angle_deg": 120.0} for p in copy.deepcopy(PHASES[:3]))]
EVEN = [PHASES[k] | {"law": "constant_velocity"} if k in (0, 2) else PHASES[k] for k in range(4)]
BARREL = {"kind": "barrel_cam", "form": "end", "outer_diameter": 60.0, "groove_depth": 29.0, "roller_diameter": 10.0,
          "lift": 20.0, "bore_diameter": 5.0, "phases": copy.deepcopy(PHASES)}  # fmt: skip
WEDGE = {"kind": "wedge_cam", "follower": "roller", "follower_radius": 6.0, "base_height": 15.0, "swing_deg": 20.0,
         "phases": [{"move": "rise", "travel": 60.0, "law": "sine"}]}  # fmt: skip
SPUR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 12, "profile_shift_coefficient": 1.6,
        "bore_diameter": 40.0}  # fmt: skip
MET: dict[str, Raw] = {
    "deep track on an open tube": one(BARREL),
    "deep track": one(BARREL | {"web_thickness": 2.0, "end_margin": 12.0}),
    "phase of no angle": one(cam(phases=phases(0.0, 120.0, 120.0, 120.0))),
    "dwell of no angle": one(cam(phases=DWELL_FIRST)),
    "table of two rows": one(cam(phases=None, lift=None, motion_table=[[0.0, 0.0], [120.0, 10.0]])),
    "table of one row": one(cam(phases=None, lift=None, motion_table=[[0.0, 0.0]])),
    "swing of a wedge without its arm": one(WEDGE),
    "swing of a cam without its arm": one(cam(lift=None, swing_deg=20.0)),
    "swing of a barrel without its arm": one({k: v for k, v in BARREL.items() if k not in ("lift", "bore_diameter")}
                                             | {"groove_depth": 8.0, "swing_deg": 20.0}),
    "lift beside an arm": one(cam(oscillating={"centre_distance": 90.0, "arm_length": 70.0})),
    "constant velocity": one(cam(phases=EVEN, base_circle_radius=80.0)),
    "two faults of a gear": one(SPUR),
}  # fmt: skip


@pytest.mark.parametrize("raw", MET.values(), ids=MET.keys())
def test_what_one_key_does_not_cure_is_cured_at_once(raw: Raw) -> None:
    assert fault_of(raw) == ""


def test_offers_are_near_to_what_was_typed() -> None:
    """Neither zeros for two keys, nor a base circle of metres where another law does."""
    (gear,) = offered(MET["two faults of a gear"], builds(MET["two faults of a gear"]))
    # a shift of 0.9 and a bore of 24 mm are refused: the tip is pointed, the root is 25.3 mm or less
    assert 0.6 < gear["parts"]["p"]["profile_shift_coefficient"] < 0.9
    assert 20 < gear["parts"]["p"]["bore_diameter"] < 24
    for base in (40.0, 80.0):
        line = builds(put(MET["constant velocity"], ("parts", "p", "base_circle_radius"), base))
        (made,) = offered(MET["constant velocity"], line)
        assert made["parts"]["p"]["phases"][0]["law"] == "sine", line
    (table,) = offered(MET["table of two rows"], builds(MET["table of two rows"]))
    assert table["parts"]["p"]["motion_table"][:2] == [[0.0, 0.0], [120.0, 10.0]]


def test_a_swing_without_an_arm_names_the_arm() -> None:
    for name in ("wedge", "cam", "barrel"):
        line = builds(MET[f"swing of a {name} without its arm"])
        assert re.search(r"swing_deg belongs to the table oscillating; with swing_deg = 0, lift = 20 it works", line)


def _sum_at_most(limit: float, raw: Any) -> Any:
    """A check of two made-up keys and its refusal, which blames the other key in turn."""

    def builds(changes: list[Change]) -> bool:
        held = at(changed(raw, changes), ("parts", "p"))
        return float(held.get("lift", 0.0)) + float(held.get("length", 0.0)) <= limit

    return builds


def test_changes_that_none_needs_are_dropped_and_the_others_come_near() -> None:
    raw = one({"kind": "barrel_cam", "lift": 30.0, "length": 50.0, "clearance": 1.0})
    place = ("parts", "p")
    changes = [Change((*place, "lift"), 1.0), Change((*place, "length"), 1.0), Change((*place, "clearance"), 0.0)]
    found = together(raw, changes, _sum_at_most(40.0, raw))
    (length,) = found
    assert length.place[-1] == "length"
    assert float(length.value) == pytest.approx(10, rel=2e-3)
    assert _sum_at_most(40.0, raw)(found)


def test_refusals_are_followed_to_the_end_and_no_further() -> None:
    raw = one({"kind": "barrel_cam", "lift": 30.0, "length": 50.0})

    def left(changes: list[Change]) -> SceneError | None:
        held = at(changed(raw, changes), ("parts", "p"))
        if held.get("lift", 0.0) > 5:
            return SceneError("s", "parts.p.lift", held["lift"], "too much; at most 5 mm works")
        if held.get("length", 0.0) > 7:
            return SceneError("s", "parts.p.length", held["length"], "too long; at most 7 mm works")
        return None

    start = [Change(("parts", "p", "lift"), 5.0)]
    found = followed(raw, ("parts", "p", "lift"), [start], left)
    assert found == [*start, Change(("parts", "p", "length"), 7.0)]
    # two that blame each other for ever lead nowhere
    endless = SceneError("s", "parts.p.length", 1.0, "no; 2 mm works")
    assert followed(raw, ("parts", "p", "lift"), [[Change(("parts", "p", "lift"), REMOVED)]], lambda _: endless) is None


@pytest.mark.parametrize("knots", [[0.7, 0.3], [0.5], [0.3, 0.3], [0.3, 1.2]])
def test_refused_knots_stand_as_they_were_typed(knots: list[float]) -> None:
    law = {"poles": [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0], "degree": 5, "knots": knots}
    raw = one(cam(phases=[PHASES[0] | {"law": law}, *PHASES[1:]]))
    assert f"law.knots = {knots}: " in builds(raw)
    assert fault_of(raw) == ""


GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
PAIR = one(GEAR) | {"mates": [{"kind": "external_gear_pair", "first": "p", "second": "q"}]}
PAIR["parts"]["q"] = GEAR | {"number_of_teeth": 31}
PLACED = [
    ({"instances": {"x": {"part": "zz"}}, "mates": []}, 'x.part = "zz": no such part; parts: p, q; "p" works'),
    ({"instances": {"x": {"part": "p", "rotation_deg": 1e6}}, "mates": []}, "36000.0 degrees works"),
    ({"instances": {"x": {"part": "p", "at": [1.0]}}, "mates": []}, "remove it"),
    ({"drives": [{"instance": "zz"}]}, 'no such instance; instances: p, q; "p" works'),
    ({"drives": [{"instance": "p", "turns": 0.0}]}, "turns nothing; 1.0 is one turn; 1.0 works"),
    ({"drives": [{"instance": "p", "speed": 5.0}]}, "remove it"),
]  # fmt: skip


@pytest.mark.parametrize(("tables", "told"), PLACED)
def test_instances_and_drives_offer_what_works(tables: Raw, told: str) -> None:
    line = builds(PAIR | tables)
    assert told in line
    assert offered(PAIR | tables, line)
    assert all(builds(made) == "" for made in offered(PAIR | tables, line))
