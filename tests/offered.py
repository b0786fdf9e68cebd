"""Scenes with something wrong in them, of every kind of part and of mate."""

from __future__ import annotations

import copy
import math
import random
import tomllib
from collections.abc import Iterator
from functools import cache
from typing import Any, get_args

import msgspec

from exporters.command.new import new_scene
from parts.base.fields import fields_of
from parts.base.registry import KINDS
from parts.mates.registry import MATES
from parts.scene.files import built_in_scenes

Raw = dict[str, Any]
Place = tuple[Any, ...]
GONE = object()


def at(raw: Any, place: Place) -> Any:
    for word in place:
        try:
            raw = raw[word]
        except (KeyError, IndexError, TypeError):
            return GONE
    return raw


def put(raw: Raw, place: Place, value: Any) -> Raw:
    """A copy of the scene with one key changed."""
    made = copy.deepcopy(raw)
    owner: Any = made
    for word in place[:-1]:
        owner = owner.setdefault(word, {}) if isinstance(owner, dict) else owner[word]
    if value is GONE:
        del owner[place[-1]]
    else:
        owner[place[-1]] = value
    return made


def _plain(raw: Raw) -> Raw:
    raw = copy.deepcopy(raw)
    raw["exports"] = [{"format": "svg"}]
    raw.pop("checks", None)
    return raw


PHASES = [
    {"move": "rise", "angle_deg": 120.0, "law": "sine"},
    {"move": "dwell", "angle_deg": 60.0},
    {"move": "return_", "angle_deg": 120.0, "law": "polynomial_345"},
    {"move": "dwell", "angle_deg": 60.0},
]
SWING = {"centre_distance": 90.0, "arm_length": 70.0}
# measured at every degree, to hundredths
ROWS = [[float(a), round(10 - 10 * math.cos(math.radians(a)) + (7 * a % 5 - 2) / 100, 2)] for a in range(360)]
TABLE = [[0.0, 0.0], [60.0, 4.0], [120.0, 10.0], [200.0, 8.0], [300.0, 1.0]]
SLIDERS = {"kind": "linkage_cam", "follower": "roller", "follower_radius": 6.0, "lift": 20.0,
           "driven": {"member": "slider", "start": [25.0, 30.0], "direction_deg": 90.0},
           "guide": {"member": "slider", "through": [0.0, 60.0], "assembly": "forward"},
           "coupler_length": 43.0, "coupler_point": [0.0, 16.0], "phases": PHASES}  # fmt: skip


def cam(**keys: Any) -> Raw:
    made = {"kind": "cam", "follower": "roller", "lift": 20.0, "follower_radius": 8.0, "base_circle_radius": 40.0,
            "phases": copy.deepcopy(PHASES)} | keys  # fmt: skip
    return {k: v for k, v in made.items() if v is not None}


def _one(part: Raw) -> Raw:
    return {"parts": {"p": part}, "exports": [{"format": "svg"}]}


def _pair(mate: str, first: Raw, second: Raw, **keys: Any) -> Raw:
    return {"parts": {"a": first, "b": second}, "mates": [{"kind": mate, "first": "a", "second": "b"} | keys],
            "exports": [{"format": "svg"}]}  # fmt: skip


def _spur(**keys: Any) -> Raw:
    return {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20} | keys


# kinds whose new scene builds without a file of the user's
ALONE = tuple(kind for kind in KINDS if kind != "step_part")


@cache
def scenes() -> dict[str, Raw]:
    """Scenes that build, of every kind of part and of mate."""
    found = {f"new {kind}": _plain(tomllib.loads(new_scene(kind))) for kind in ALONE}
    built_in = {name: _plain(tomllib.loads(path.read_text("utf-8"))) for name, path in built_in_scenes().items()}
    # what recipes make and defaults fill in is not all of it in the scene's own keys
    found |= {name: raw for name, raw in built_in.items() if not {"assemblies", "defaults"} & raw.keys()}
    swing = {"lift": None, "swing_deg": 20.0, "oscillating": SWING}
    wedge = {"kind": "wedge_cam", "follower": "roller", "follower_radius": 6.0, "base_height": 15.0,
             "phases": [{"move": "rise", "travel": 60.0, "law": "sine"}]}  # fmt: skip
    barrel = {"kind": "barrel_cam", "form": "groove", "outer_diameter": 70.0, "groove_depth": 8.0,
              "roller_diameter": 10.0, "phases": copy.deepcopy(PHASES)}  # fmt: skip
    groove = {k: v for k, v in cam().items() if k != "follower"} | {"kind": "groove_cam", "groove_depth": 5.0}
    arm = {"kind": "follower_arm", "end": "roller", "arm_length": 70.0}
    helical = {"helix_angle_deg": 20.0}
    found |= {
        "pointed": _one(cam(follower="pointed", follower_radius=None)),
        "flat": _one(cam(follower="flat", follower_radius=None, plate_diameter=80.0)),
        "mushroom": _one(cam(follower="mushroom", follower_radius=60.0)),
        "offset roller": _one(cam(follower_offset=10.0, bore_diameter=10.0, timing_mark={"diameter": 2.0})),
        "least angle": _one(cam(base_circle_radius=None, least_transmission_angle_deg=60.0)),
        "table": _one(cam(phases=None, lift=None, motion_table=TABLE)),
        "measured": _one(cam(phases=None, lift=None, motion_table=ROWS, table_tolerance=0.05)),
        "swinging roller": _one(cam(**swing)),
        "least return": _one(cam(
            base_circle_radius=None, least_transmission_angle_deg=60.0, least_return_transmission_angle_deg=50.0,
        )),
        "least swing": _one(cam(**swing, base_circle_radius=None, least_transmission_angle_deg=50.0)),
        "swinging pointed": _one(cam(**swing, follower="pointed", follower_radius=None)),
        "swinging flat": _one(cam(follower="flat", follower_radius=None, lift=None, swing_deg=10.0,
                                  oscillating={"centre_distance": 90.0})),
        "swinging mushroom": _one(cam(**swing, follower="mushroom", follower_radius=50.0)),
        "cam with holes": _one(cam(bore={"shape": "keyway", "diameter": 12.0}, hub={"diameter": 24.0, "above": 5.0},
                                   holes=[{"count": 4, "diameter": 5.0, "pitch_circle_diameter": 50.0}])),
        "groove": _one(groove | {"outer_diameter": 170.0, "roller_clearance": 0.1}),
        "swinging groove": _one({k: v for k, v in groove.items() if k != "lift"}
                                | {"swing_deg": 20.0, "oscillating": SWING}),
        "wedge": _one(wedge | {"lift": 20.0, "corner_radius": 2.0, "run_in": 12.0,
                               "holes": [{"diameter": 5.0, "x": 5.0, "y": 7.0}]}),
        "wedge arm": _one(wedge | {"swing_deg": 15.0, "oscillating": {"arm_length": 80.0, "pivot_height": 40.0}}),
        "barrel": _one(barrel | {"lift": 18.0, "clearance": 0.1, "length": 60.0, "bore_diameter": 10.0}),
        "swinging barrel": _one(barrel | {"swing_deg": 20.0, "oscillating": {"arm_length": 50.0}}),
        "end barrel": _one(barrel | {"form": "end", "lift": 12.0, "web_thickness": 4.0, "end_margin": 12.0,
                                     "hub": {"diameter": 30.0}, "bore_diameter": 8.0}),
        "barrel table": _one({k: v for k, v in barrel.items() if k != "phases"} | {"motion_table": TABLE}),
        "two sliders": _one(SLIDERS),
        "own law": _one(cam(phases=[PHASES[0] | {"law": {"first_half": [{"shape": "constant", "width": 1.0,
            "ordinate": 1.0}], "second_half": [{"shape": "half_sine", "width": 1.0, "peak": 1.0}]}}, *PHASES[1:]])),
        "flat arm": _one({"kind": "follower_arm", "end": "flat", "arm_length": 90.0, "boss_diameter": 8.0,
                          "pivot_diameter": 4.0}),
        "plate follower": _one({"kind": "follower", "end": "flat", "plate_diameter": 60.0}),
        "cut sector": _one(_spur(
            number_of_teeth=40, bore_diameter=8.0, holes={"count": 1, "diameter": 6.0, "pitch_circle_diameter": 44.0},
            sector={"teeth": 9, "rest": "cut", "hub_diameter": 20.0, "corner_radius": 1.0})),
        "mutilated gear": _one(_spur(number_of_teeth=24, bore_diameter=8.0, sector={
            "teeth": 4, "runs": 2, "first_tooth": 1, "blank_diameter": 36.0, "corner_radius": 0.5})),
        "ring sector": _one({"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60, "sector": {"teeth": 12}}),
        "intermittent": _pair("external_gear_pair", _spur(number_of_teeth=24, sector={"teeth": 4, "runs": 2}),
                              _spur(number_of_teeth=18), intermittent="clockwise", normal_backlash=0.1),
        "mushroom stem": _one({"kind": "follower", "end": "mushroom", "plate_diameter": 40.0, "follower_radius": 60.0}),
    }  # fmt: skip
    return found | _mated(swing, arm, helical)


def _mated(swing: Raw, arm: Raw, helical: Raw) -> dict[str, Raw]:
    """Scenes of two parts that belong together."""
    return {
        "conjugate": {"parts": {"a": cam(), "b": {"kind": "conjugate_cam", "of": "a", "roller_distance": 130.0}},
                      "mates": [{"kind": "conjugate_cams", "first": "a", "second": "b", "height": 12.0}],
                      "exports": [{"format": "svg"}]},
        "drawing cams": {"parts": {"a": cam(), "b": cam()},
                         "mates": [{"kind": "drawing_cams", "first": "a", "second": "b", "height": 10.0,
                                    "line": [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0]]}],
                         "exports": [{"format": "svg"}]},
        "cam and stem": _pair("cam_follower", cam(follower="flat", follower_radius=None),
                              {"kind": "follower", "end": "flat", "plate_diameter": 80.0}),
        "cam and roller": _pair("cam_follower", cam(), {"kind": "roller", "diameter": 16.0}),
        "cam and arm": _pair("cam_follower", cam(**swing), arm),
        "external": _pair("external_gear_pair", _spur(), _spur(number_of_teeth=31), working_centre_distance=51.2,
                          normal_backlash=0.5),
        "helical pair": _pair("external_gear_pair", _spur(**helical),
                              _spur(number_of_teeth=31, hand="left", **helical)),
        "internal": _pair("internal_gear_pair", _spur(), {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60}),
        "rack": _pair("rack_pair", _spur(), {"kind": "rack", "module": 2.0, "number_of_teeth": 20}),
        "cut gear": _one(_spur(cutter={"number_of_teeth": 25}, helix_angle_deg=15.0)),
        "cut ring": _one({"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60,
                          "cutter": {"number_of_teeth": 20}}),
    }  # fmt: skip


# --- what may be wrong


def _leaves(table: Any, place: Place) -> Iterator[Place]:
    if isinstance(table, dict):
        for name, value in table.items():
            yield from _leaves(value, (*place, name))
    elif isinstance(table, list):
        for index, value in enumerate(table):
            yield from _leaves(value, (*place, index))
    else:
        yield place


def _keys(raw: Raw) -> list[Place]:
    """Everything that the parts and mates of a scene say, and what more they could say."""
    found: list[Place] = []
    for owner in [("parts", p) for p in raw["parts"]] + [("mates", i) for i in range(len(raw.get("mates", [])))]:
        table = at(raw, owner)
        found += list(_leaves(table, owner))
        spec = KINDS[table["kind"]].keys if owner[0] == "parts" else MATES[table["kind"]].keys
        found += [(*owner, key) for key in spec.__struct_encode_fields__ if key not in table]
    return [p for p in found if p[-1] not in ("material", "colour", "title", "kind")]


def _limits(raw: Raw, place: Place) -> list[float]:
    """The ends of a key's range, and beyond them."""
    owner = at(raw, place[:2])
    spec = KINDS[owner["kind"]].keys if place[0] == "parts" else MATES[owner["kind"]].keys
    field = next((f for f in fields_of(spec) if f.encode_name == place[2]), None)
    ends: list[float] = []
    stack = [field.type] if field is not None and len(place) == 3 else []
    while stack:
        kind = stack.pop()
        for meta in (m for m in getattr(kind, "__metadata__", ()) if isinstance(m, msgspec.Meta)):
            low, high = next((v for v in (meta.ge, meta.gt) if v is not None), None), meta.le or meta.lt
            ends += [low, low - 1, low + 1e-3] if low is not None else []
            ends += [high, high * 1.01 + 1] if high is not None else []
        stack += [a for a in get_args(kind) if get_args(a)]
    return ends


def spoiled(raw: Raw, choice: random.Random) -> tuple[str, Raw]:
    """A scene with one wrong value, and what was done to it."""
    places = _keys(raw)
    place = choice.choice(places)
    old = at(raw, place)
    values: list[Any] = [0.0, -1.0, 1e9, 1e-6, "abc", True, [1.0], *_limits(raw, place) * 2]
    if isinstance(old, int | float):
        values += [old * f for f in (0.1, 0.5, 1.5, 3.0, 10.0, 30.0, -1.0)] * 2
    if isinstance(old, str):
        values = ["nonsense", old[:-1], 5.0, *[w for w in ("flat", "pointed", "mushroom", "constant_velocity", "end")]]
    value = choice.choice(values)
    if isinstance(old, int) and isinstance(value, float) and choice.random() < 0.8:
        value = round(value)
    return f"{'.'.join(map(str, place))} = {value!r}", put(raw, place, value)
