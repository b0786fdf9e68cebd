"""What a refusal of any kind of part or mate offers works at the first try, one key changed; read back by own means."""

from __future__ import annotations

import copy
import random
import re
import tomllib
from typing import Any

import pytest

from exporters.new import new_mate, new_scene
from exporters.words_errors import in_ukrainian
from geometry.errors import ParameterError
from parts.kinds import KINDS
from parts.mates import JOINS
from parts.offers import changed, offers_in, place_of, told_place
from parts.scene import scene_from_dict
from parts.schema import SceneError
from tests.offered import PHASES, TABLE, Raw, builds, cam, english_in, fault_of, offered, put, scenes, spoiled

SCENES = scenes()
QUICK = [
    name for name in SCENES if not re.search(r"cam|barrel|groove|conjugate|table|swing|yoke|oval|print|model", name)
]


def one(part: Raw) -> Raw:
    return {"parts": {"p": part}, "exports": [{"format": "svg"}]}


WEDGE = {"kind": "wedge_cam", "follower": "roller", "follower_radius": 6.0, "base_height": 15.0, "lift": 20.0,
         "phases": [{"move": "rise", "travel": 60.0, "law": "sine"}]}  # fmt: skip
# what strangers met as two steps, or as offers that were none
MET: dict[str, Raw] = {
    "table does not begin at 0": one(cam(phases=None, lift=None, motion_table=[[5.0, 0.0], *TABLE[1:]])),
    "table does not rise": one(cam(phases=None, lift=None, motion_table=[*TABLE[:2], [50.0, 10.0], *TABLE[3:]])),
    "table too steep": one(cam(phases=None, lift=None, motion_table=[[a, 20 * s] for a, s in TABLE])),
    "table and lift": one(cam(phases=None, motion_table=TABLE)),
    "wedge corner": one(WEDGE | {"corner_radius": 12.0}),
    "wedge low": one(WEDGE | {"base_height": 0.5, "corner_radius": 2.0}),
    "wedge run in": one(WEDGE | {"corner_radius": 3.0, "run_in": 2.0}),
    "swinging flat": one(cam(follower="flat", follower_radius=None, lift=None, swing_deg=60.0,
                             oscillating={"centre_distance": 90.0})),
    "thin helical gear by a small cutter": one({"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20,
                                                "helix_angle_deg": 20.0, "cutter": {"number_of_teeth": 3}}),
    "ring at 14.5 degrees": one({"kind": "ring_gear", "module": 2.0, "number_of_teeth": 25,
                                 "pressure_angle_deg": 14.5}),
    "ring of one tooth more": copy.deepcopy(SCENES["internal"]),
    "phases too long": one(cam(phases=[PHASES[0] | {"angle_deg": 200.0}, *PHASES[1:]])),
    "phases far too long": one(cam(phases=[p | {"angle_deg": 360.0} for p in PHASES])),
    "rise without a return": one(cam(phases=[PHASES[0], PHASES[1] | {"angle_deg": 240.0}])),
}  # fmt: skip
MET["ring of one tooth more"]["parts"]["b"]["number_of_teeth"] = 21


@pytest.mark.parametrize("raw", MET.values(), ids=MET.keys())
def test_what_strangers_met_is_cured_in_one_step(raw: Raw) -> None:
    assert fault_of(raw) == ""


@pytest.mark.parametrize("seed", range(24))
def test_any_offer_works_at_the_first_try(seed: int) -> None:
    choice = random.Random(seed)
    what, raw, several = spoiled(SCENES[choice.choice(QUICK)], choice)
    assert fault_of(raw, several=several) == "", what


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(700))
def test_any_offer_works_at_the_first_try_at_length(seed: int) -> None:
    choice = random.Random(1000 + seed)
    what, raw, several = spoiled(SCENES[choice.choice(sorted(SCENES))], choice)
    assert fault_of(raw, several=several) == "", what


@pytest.mark.heavy
@pytest.mark.parametrize("name", SCENES)
def test_every_scene_to_spoil_builds(name: str) -> None:
    assert builds(SCENES[name]) == ""


def test_an_offer_that_fails_is_seen() -> None:
    """The reader of offers itself: a wrong number, a wrong word and a missing offer are faults."""
    raw = one(cam())
    assert [t["parts"]["p"]["lift"] for t in offered(raw, "s: parts.p.lift = 20.0: why; at most 7.5 mm works")] == [7.5]
    assert offered(raw, "s: parts.p.lift = 20.0: why; less of it would do") == []
    assert builds(put(raw, ("parts", "p", "follower_radius"), -1.0))
    line = 's: parts.p.lift = 20.0: why; with no bore, phases.item 1.law = "sine" it works'
    with_bore = put(raw, ("parts", "p", "bore"), {"shape": "round", "diameter": 5.0})
    (made,) = offered(with_bore, line)
    assert "bore" not in made["parts"]["p"]


def test_places_and_offers_are_read_as_they_are_told() -> None:
    for key in ("parts.cam.phases.item 3.law", "mates[2].normal_backlash", "exports[1].kerf", "parts.a.tip_diameter"):
        assert told_place(place_of(key)) == key
    assert place_of("mates[1]: parts.b.module") == ("parts", "b", "module")
    raw = one(cam())
    refusal = SceneError("s", "parts.p.lift", 20.0, "too much; at most 12.5 mm works")
    (offer,) = offers_in(refusal, raw)
    assert changed(raw, offer)["parts"]["p"]["lift"] == 12.5
    assert raw["parts"]["p"]["lift"] == 20.0


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(300))
def test_no_english_is_left_in_a_ukrainian_refusal(seed: int) -> None:
    _ukrainian(random.Random(seed), sorted(SCENES))


@pytest.mark.parametrize("seed", range(20))
def test_no_english_is_left_in_a_ukrainian_refusal_of_quick_kinds(seed: int) -> None:
    _ukrainian(random.Random(5000 + seed), QUICK)


def _ukrainian(choice: random.Random, names: list[str]) -> None:
    raw = spoiled(SCENES[choice.choice(names)], choice)[1]
    try:
        from exporters.plan import plan_build

        plan_build(scene_from_dict(raw, "s", "s"), "s", [], [])
    except (SceneError, ParameterError) as refused:
        remedy = refused.remedy if isinstance(refused, SceneError) else refused.allowed
        told = in_ukrainian(remedy)
        assert english_in(told) == ""
        assert re.search("[а-яіїєґ]", told), remedy


@pytest.mark.heavy
@pytest.mark.parametrize("kind", KINDS)
def test_each_key_of_a_new_scene_alone_builds_or_is_refused_with_a_cure(kind: str) -> None:
    lines = new_scene(kind).splitlines()
    assert builds(_reduced("\n".join(lines))) == ""
    faults = []
    for index, line in enumerate(lines):
        # two of these are for whole tables
        if not re.match(r"# \w+ = ", line):
            continue
        try:
            raw = _reduced("\n".join([*lines[:index], line[2:], *lines[index + 1 :]]))
        except tomllib.TOMLDecodeError:
            # another value of a key that is set: in its place
            key = line[2:].split(" ")[0]
            rest = [one for one in lines[:index] if not one.startswith(f"{key} =")]
            raw = _reduced("\n".join([*rest, line[2:], *lines[index + 1 :]]))
        if fault := fault_of(raw):
            faults.append(f"{line[:70]}\n  {fault}")
    assert not faults, "\n".join(faults)


def _reduced(text: str) -> dict[str, Any]:
    raw = tomllib.loads(text)
    raw["exports"] = raw["exports"][:1]
    return raw


@pytest.mark.heavy
@pytest.mark.parametrize("mate", JOINS)
def test_each_mate_of_new_joins_two_new_parts(mate: str) -> None:
    table = tomllib.loads(new_mate(mate))["mates"][0]
    assert table["kind"] == mate
    for first, second in (JOINS[mate] or (("plate", "roller"),))[:1]:
        parts = {}
        for key, kind in (("gear", first), ("wheel", second)):
            raw = tomllib.loads(new_scene(kind))
            parts |= {k: v for k, v in raw["parts"].items() if k != "gear"} | {key: raw["parts"]["gear"]}
        if "of" in parts["wheel"]:
            parts.pop("source", None)
            parts["wheel"]["of"] = "gear"
        fault = fault_of({"parts": parts, "mates": [table], "exports": [{"format": "svg"}]}, several=True)
        assert fault == ""
