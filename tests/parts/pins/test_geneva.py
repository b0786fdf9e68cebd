"""Geneva wheels and drivers in scenes: pieces, mates, motion, refusals that name what works."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from exporters.production.check import scene_checks
from geometry.curves.line_arc import Arc
from geometry.solids.mass import body_moments
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from tests.parts.drawing.test_sections import drawing_of
from tests.sampling import some_of

Keys = dict[str, Any]
WHEEL: Keys = {"kind": "geneva_wheel", "number_of_slots": 6, "centre_distance": 60.0, "pin_diameter": 5.0}
RING: Keys = WHEEL | {"internal": True}
DRIVER: Keys = {"kind": "geneva_driver", "of": "wheel", "bore_diameter": 6.0}
UNBORED: Keys = DRIVER | {"bore_diameter": 0.0}
MATE: Keys = {"kind": "geneva_pair", "first": "driver", "second": "wheel"}
DRIVE: Keys = {"instance": "driver", "turns": 3.0}


def placed(wheel: Keys, driver: Keys, mates: list[Keys] | None = None, **more: Any) -> tuple[Placing, dict[str, Any]]:
    """Where both stand, and what the checks say."""
    tables = {"parts": {"wheel": wheel, "driver": driver}, "mates": mates or [MATE], "drives": [DRIVE], **more}
    made = scene_from_dict(tables, "t", "t")
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    return placing, scene_checks(placing, parts, made.drives, "en", contact=True)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("wheel", "pins", "turns"), [(WHEEL, 1, -0.5), (WHEEL, 2, -1.0), (RING, 1, 0.5)], ids=["one", "two", "internal"]
)
def test_a_driver_turns_its_wheel_step_by_step(wheel: Keys, pins: int, turns: float) -> None:
    placing, checks = placed(wheel, DRIVER | {"number_of_pins": pins}, [MATE | {"direction_deg": 20.0}])
    assert [mate["verdict"] for mate in checks["mates"]] == ["contact"]
    assert placing.turns[0] == pytest.approx({"driver": 3.0, "wheel": turns})
    train = placing.train
    assert train is not None
    # the pin on the line of centres, then a slot's step later for each, and in the dwell between no way at all
    poses = [train.poses([at / 24])["wheel"][1] for at in range(25)]
    step = math.copysign(2 * math.pi / 6, turns) * pins
    assert math.remainder(poses[-1] - poses[0] - step, 2 * math.pi) == pytest.approx(0.0, abs=1e-12)
    # the driver begins with its pin on +x, which in a ring is half a turn on
    middle = 0.0 if wheel is RING else 0.5 / pins
    still = [train.poses([middle + share])["wheel"][1] for share in np.linspace(-0.02, 0.02, 5)]
    assert np.ptp(still) < 1e-12


def test_a_loose_pin_is_held_against_every_slot() -> None:
    """The wheel looks alike after each of its slots, so that one turn of the crank is seen as finely as it wants."""
    pieces = {piece: DRIVER | {"piece": piece} for piece in ("plate", "disc")}
    pin = {"kind": "pin", "diameter": 5.0, "length": 13.0}
    loose = {"parts": {"wheel": WHEEL | {"slot_clearance": 0.2, "locking_clearance": 0.1}, "pin": pin} | pieces}
    mates = [
        {"kind": "fixed", "first": "plate", "second": "disc", "offset": [0.0, 0.0, 3.0]},
        MATE | {"first": "disc"},
        {"kind": "pin_seat", "first": "plate", "second": "pin"},
    ]
    _, checks = placed(WHEEL, DRIVER, mates, drives=[{"instance": "plate", "turns": 6.0}], **loose)
    motion = checks["motion"]
    assert motion["tested"] > 0
    assert motion["uncovered"] == []


def test_a_wheel_drives_nothing() -> None:
    with pytest.raises(SceneError) as refused:
        placed(WHEEL, DRIVER, drives=[{"instance": "wheel", "turns": 1.0}])
    assert (refused.value.key, refused.value.code) == ("drives[1].instance", "moves_by_law")


def test_pieces_make_the_whole() -> None:
    """Plate, disc and pins have the volume of the driver of one piece; its bore goes through all of it."""
    own = {"face_width": 4.0, "plate_thickness": 3.0}
    parts = {"wheel": WHEEL} | {piece: DRIVER | own | {"piece": piece} for piece in ("whole", "plate", "disc")}
    made, _ = make_parts(scene_from_dict({"parts": parts}, "t", "t"), "t")
    whole, plate, disc = (body_moments(made[name].body(0.0)).volume for name in ("whole", "plate", "disc"))
    pin = math.pi * 2.5**2
    assert whole == pytest.approx(plate + 3.0 * pin + disc + 4.0 * pin, rel=1e-9)
    for length in (6.0, 1.0):
        other = DRIVER | own | {"pin_length": length}
        made, _ = make_parts(scene_from_dict({"parts": {"wheel": WHEEL, "other": other}}, "t", "t"), "t")
        assert body_moments(made["other"].body(0.0)).volume == pytest.approx(whole + (length - 4.0) * pin, rel=1e-9)


def test_plates_hold_pins_thinner_than_their_walls() -> None:
    parts = {"wheel": WHEEL | {"pin_diameter": 0.06}, "driver": UNBORED}
    make_parts(scene_from_dict({"parts": parts}, "t", "t"), "t")


REFUSED: dict[str, tuple[Keys, Keys, str, str]] = {
    "no distance": (WHEEL | {"centre_distance": None}, DRIVER, "centre_distance", "needs_distance_or_crank"),
    "both": (WHEEL | {"crank_radius": 30.0}, DRIVER, "crank_radius", "either_key"),
    "thick pin": (WHEEL | {"pin_diameter": 25.0}, DRIVER, "pin_diameter", "tips_leave_no_disc"),
    "small disc": (WHEEL | {"locking_diameter": 8.0}, DRIVER, "locking_diameter", "leaves_no_arcs"),
    "disc that the tips cut": (WHEEL | {"number_of_slots": 12, "locking_diameter": 13.0},
                               UNBORED, "locking_diameter", "tips_leave_no_disc"),
    "wide disc": (WHEEL | {"locking_diameter": 56.0}, DRIVER, "locking_diameter", "leaves_no_tip"),
    "disc about the wheel": (WHEEL | {"locking_diameter": 1000.0}, DRIVER, "locking_diameter", "leaves_no_tip"),
    "wide bore": (WHEEL | {"bore_diameter": 56.0}, DRIVER, "bore_diameter", "no_wall_around_bore"),
    "thin pin": (WHEEL | {"pin_diameter": 0.016}, DRIVER, "pin_diameter", "leaves_no_tip"),
    "round tips": (WHEEL | {"tip_rounding": 9.0}, UNBORED, "tip_rounding", "leaves_no_tip"),
    "rounder tips": (RING | {"tip_rounding": 140.0}, DRIVER, "tip_rounding", "leaves_no_arcs"),
    "loose disc": (WHEEL | {"locking_clearance": 28.0}, UNBORED, "locking_clearance", "leaves_no_arcs"),
    "wide slots": (WHEEL | {"slot_clearance": 50.0}, DRIVER, "slot_clearance", "slots_meet"),
    "rim": (WHEEL | {"outer_diameter": 200.0}, DRIVER, "outer_diameter", "only_of_internal"),
    "bore of a ring": (RING | {"bore_diameter": 6.0}, DRIVER, "bore_diameter", "only_of_external"),
    "thin ring": (RING | {"outer_diameter": 180.0}, DRIVER, "outer_diameter", "leaves_no_rim"),
    "three pins": (WHEEL, DRIVER | {"number_of_pins": 3}, "number_of_pins", "leaves_no_dwell"),
    "two in a ring": (RING, DRIVER | {"number_of_pins": 2}, "number_of_pins", "leaves_no_dwell"),
    "deep relief": (WHEEL, DRIVER | {"relief_clearance": 30.0}, "relief_clearance", "leaves_no_disc"),
    "bored relief": (WHEEL, DRIVER | {"bore_diameter": 16.0}, "bore_diameter", "bore_reaches_relief"),
    "small plate": (WHEEL, DRIVER | {"plate_diameter": 60.0}, "plate_diameter", "pins_reach_edge"),
    "tiny plate": (WHEEL, DRIVER | {"plate_diameter": 0.03}, "plate_diameter", "pins_reach_edge"),
    "pins of a disc": (WHEEL, DRIVER | {"piece": "disc", "pin_length": 5.0}, "pin_length", "not_of_this_piece"),
}  # fmt: skip


@pytest.mark.parametrize(("wheel", "driver", "key", "code"), REFUSED.values(), ids=REFUSED.keys())
def test_what_cannot_be_is_refused_with_what_can(wheel: Keys, driver: Keys, key: str, code: str) -> None:
    parts = {"wheel": {k: v for k, v in wheel.items() if v is not None}, "driver": driver}
    with pytest.raises(SceneError) as refused:
        make_parts(scene_from_dict({"parts": parts}, "t", "t"), "t")
    owner, _, name = refused.value.key.removeprefix("parts.").partition(".")
    assert (name, refused.value.code) == (key, code)
    if code == "needs_distance_or_crank":
        return
    found = refused.value.nearest
    assert found is not None
    parts[owner] = {k: v for k, v in (parts[owner] | {key: found.value}).items() if v is not None}
    make_parts(scene_from_dict({"parts": parts}, "t", "t"), "t")


def test_a_bore_that_is_a_table_is_refused_by_its_own_size() -> None:
    """What is offered builds."""

    def refusal(driver: Keys) -> SceneError | None:
        try:
            make_parts(scene_from_dict({"parts": {"wheel": WHEEL, "driver": driver}}, "t", "t"), "t")
        except SceneError as error:
            return error
        return None

    refused = refusal(UNBORED | {"bore": {"shape": "square", "across_flats": 40.0}})
    assert refused is not None
    assert refused.nearest is not None
    assert (refused.key, refused.value) == ("parts.driver.bore.across_flats", 40.0)
    assert refusal(UNBORED | {"bore": {"shape": "square", "across_flats": refused.nearest.value}}) is None
    designated = refusal(UNBORED | {"bore": {"shape": "spline", "size": "6x28x34"}})
    assert designated is not None
    assert (designated.key, designated.value) == ("parts.driver.bore.size", "6x28x34")


@pytest.mark.parametrize("internal", [False, True], ids=["external", "internal"])
def test_any_number_of_slots_makes_a_drive_from_two_keys(internal: bool) -> None:
    """Its contact is clear or touches; thick pins build too, or are refused with thinner ones that do."""
    for slots in some_of((3, 5, 12, 24, 100)):
        wheel = {"kind": "geneva_wheel", "number_of_slots": slots, "centre_distance": 60.0, "internal": internal}
        _, checks = placed(wheel, {"kind": "geneva_driver", "of": "wheel"})
        assert [mate["verdict"] for mate in checks["mates"]] == ["contact"]
    for slots in some_of((12, 24, 40), 2):
        wheel = {"kind": "geneva_wheel", "number_of_slots": slots, "centre_distance": 60.0, "internal": internal}
        parts = {"wheel": wheel | {"pin_diameter": 6.0}, "driver": {"kind": "geneva_driver", "of": "wheel"}}
        if slots > (24 if internal else 12):
            with pytest.raises(SceneError) as refused:
                make_parts(scene_from_dict({"parts": parts}, "t", "t"), "t")
            found = refused.value.nearest
            assert (refused.value.key, found is None) == ("parts.wheel.pin_diameter", False)
            assert found is not None
            parts["wheel"] |= {"pin_diameter": found.value}
        make_parts(scene_from_dict({"parts": parts}, "t", "t"), "t")


def test_a_plate_that_reaches_under_the_axle_of_the_wheel_is_told() -> None:
    for diameter, told in ((114.1, 1), (113.9, 0)):
        parts = {"wheel": WHEEL | {"bore_diameter": 6.0}, "driver": DRIVER | {"plate_diameter": diameter}}
        made, _ = make_parts(scene_from_dict({"parts": parts}, "t", "t"), "t")
        found = [f for f in made["driver"].findings if f.code == "plate_reaches_axle"]
        assert [(f.value, f.limit) for f in found] == [(diameter, 114.0)] * told


def test_a_driver_is_for_one_wheel() -> None:
    parts = {"wheel": WHEEL, "other": WHEEL | {"number_of_slots": 5}, "driver": DRIVER | {"of": "other"}}
    made = scene_from_dict({"parts": parts, "mates": [MATE]}, "t", "t")
    with pytest.raises(SceneError) as refused:
        make_parts(made, "t")
    assert (refused.value.key, refused.value.code) == ("mates[1]: parts.driver.of", "made_for_another_wheel")


@pytest.mark.parametrize("keys", [WHEEL, RING], ids=["external", "internal"])
def test_a_drawing_counts_the_arcs_that_the_outline_has(keys: Keys) -> None:
    rounded = keys | {"tip_rounding": 0.4}
    made, _ = make_parts(scene_from_dict({"parts": {"wheel": rounded}}, "t", "t"), "t")
    arcs = [edge for edge in made["wheel"].thing.outline() if isinstance(edge, Arc)]
    told = {one.name: one for one in drawing_of(rounded).views[-1].rounds}
    for one in (told["tip_rounding"], told["locking_arc"]):
        centres = {f"{arc.centre:.6f}" for arc in arcs if math.isclose(arc.radius, one.radius)}
        assert one.places == f" ({len(centres)} places)"


def test_a_driver_of_one_piece_has_no_bore_of_involutes() -> None:
    """Its layers are bounded by lines and arcs: the file was refused after it was written."""
    bore = {"bore": {"shape": "involute_spline", "size": "8x0.5"}}
    with pytest.raises(SceneError) as caught:
        make_parts(scene_from_dict({"parts": {"wheel": WHEEL, "other": UNBORED | bore}}, "t", "t"), "t")
    assert (caught.value.key, caught.value.code) == ("parts.other.bore.shape", "not_of_this_piece")
