"""Spline designations as drawings have them, after the examples of GOST 1139, GOST 6033, DIN 5480 and ISO 4156."""

from __future__ import annotations

import math
import re
from random import Random
from typing import Any

import pytest
from msgspec.structs import replace as changed

from geometry.base.errors import Nearest, ParameterError
from geometry.solids.spline_standards import STRAIGHT_JOINTS
from parts.keys.splines import InvoluteSplineTable, StraightSplineTable

CYRILLIC = "d-8\u00d736\u041d7/\u04358\u00d740\u041d12/\u043011\u00d77D9/f8 \u0413\u041e\u0421\u0422 1139-80"
DIN: dict[str, Any] = {"standard": "DIN 5480"}
ISO: dict[str, Any] = {"standard": "ISO 4156"}
STANDARDS = ("GOST 6033", "DIN 5480", "ISO 4156")


@pytest.mark.parametrize(
    ("size", "joint"),
    [
        ("d-8x36H7/e8x40H12/a11x7D9/f8", ("inner", 8, 36.0, 40.0, 7.0)),
        ("D-8x36x40H8/h7x7F10/h9 GOST 1139-80", ("outer", 8, 36.0, 40.0, 7.0)),
        ("b \u2013 8 \u00d7 36 \u00d7 40H12/a11 \u00d7 7D9/f8", ("sides", 8, 36.0, 40.0, 7.0)),
        (CYRILLIC, ("inner", 8, 36.0, 40.0, 7.0)),
        ("ISO 14 - 6 x 23 x 26", ("inner", 6, 23.0, 26.0, 6.0)),
    ],
)
def test_straight_splines_are_read_from_their_drawings(size: str, joint: tuple[object, ...]) -> None:
    made = StraightSplineTable(size).joint()
    assert (made.centring, *made.sizes) == joint


@pytest.mark.parametrize(
    ("size", "whole", "hub", "shaft"),
    [
        ("d-8x36H7/e8x40H12/a11x7D9/f8", "d-8x36H7/e8x40H12/a11x7D9/f8", "d-8x36H7x40H12x7D9", "d-8x36e8x40a11x7f8"),
        (CYRILLIC, "d-8x36H7/e8x40H12/a11x7D9/f8", "d-8x36H7x40H12x7D9", "d-8x36e8x40a11x7f8"),
        ("D-8x36x40H8/h7x7F10/h9", "D-8x36x40H8/h7x7F10/h9", "D-8x36x40H8x7F10", "D-8x36x40h7x7h9"),
        ("b-8x36x40H12x7D9", "b-8x36x40H12x7D9", "b-8x36x40H12x7D9", "b-8x36x40x7"),
        ("8 x 36 x js6 x 40", "d-8x36js6x40x7", "d-8x36x40x7", "d-8x36js6x40x7"),
        ("D-8x36x40", "D-8x36x40", "D-8x36x40", "D-8x36x40"),
        # Js, or JS, is a hub's, as all holes' letters are capital
        ("b-8x36x40x7Js10/f9", "b-8x36x40x7Js10/f9", "b-8x36x40x7Js10", "b-8x36x40x7f9"),
        ("b-8x36x40x7JS10/js7", "b-8x36x40x7JS10/js7", "b-8x36x40x7JS10", "b-8x36x40x7js7"),
    ],
)
def test_zones_of_straight_splines_are_told_as_gost_1139_writes_them(
    size: str, whole: str, hub: str, shaft: str
) -> None:
    made = StraightSplineTable(size).joint()
    told = made.named(), made.named(is_shaft=False), made.named(is_shaft=True)
    assert tuple(name.replace("\u00d7", "x") for name in told) == (whole, hub, shaft)
    # they move nothing
    plain = StraightSplineTable(made.name).joint()
    assert (plain.shaft().outline(), plain.hub().outline()) == (made.shaft().outline(), made.hub().outline())


@pytest.mark.parametrize(
    ("size", "code", "right"),
    [
        ("d-8x36f7/H7x40", "spline_hub_first", "d-8x36H7/f7x40"),
        ("d-8x36H7/c7x40", "no_such_spline_zone", None),
        ("d-8x36H7/H7x40", "no_such_spline_zone", None),
        ("d-8x36H13x40", "no_such_spline_zone", None),
        ("d-8x36G7x40", "no_such_spline_zone", None),
        ("D-8x36H11/a11x40H8/h7", "zone_of_free_root", None),
        ("8H7x36x40", "no_such_spline", "d-8x36x40"),
        ("8x36H07x40", "no_such_spline", None),
    ],
)
def test_other_zones_of_straight_splines_are_refused(size: str, code: str, right: str | None) -> None:
    with pytest.raises(ParameterError) as caught:
        StraightSplineTable(size).joint()
    assert (caught.value.name, caught.value.code) == ("bore.size", code)
    assert (caught.value.nearest.value if caught.value.nearest else None) == right
    if right:
        assert StraightSplineTable(right).joint().inner == 36.0


def test_zones_and_a_clearance_are_not_told_both() -> None:
    for table in (StraightSplineTable("8x36H7x40", clearance=0.1), InvoluteSplineTable("50xH7x2", clearance=0.1)):
        with pytest.raises(ParameterError) as caught:
            table.joint()
        assert (caught.value.name, caught.value.code) == ("bore.clearance", "clearance_of_class")
        assert caught.value.nearest == Nearest(0.0)


@pytest.mark.parametrize(
    ("size", "code"),
    [("50xg6/H7x2", "spline_hub_first"), ("50xP7/g6x2", "no_such_spline_zone"), ("50x2xH7/g6", "no_such_spline"),
     ("505xH7x8", "spline_zones_end")],
)  # fmt: skip
def test_zones_of_the_outer_diameter_stand_beside_it(size: str, code: str) -> None:
    """GOST 6033: 50xH7/g6x2, with the classes of the teeth at the end where they are told."""
    made = InvoluteSplineTable("50xH7/g6x2x9H/9h").joint()
    assert made.named() == "50\u00d7H7/g6\u00d72\u00d79H/9h"
    assert (made.named(is_shaft=True), made.named(is_shaft=False)) == (
        "50\u00d7g6\u00d72\u00d79h",
        "50\u00d7H7\u00d72\u00d79H",
    )
    with pytest.raises(ParameterError) as caught:
        InvoluteSplineTable(size).joint()
    assert (caught.value.name, caught.value.code) == ("bore.size", code)


@pytest.mark.parametrize(
    ("size", "keys", "name", "rounded"),
    [
        ("50x2x9H/9g GOST 6033-80", {}, "50\u00d72", False),
        ("50\u04452\u04459\u041d/9g \u0413\u041e\u0421\u0422 6033-80", {}, "50\u00d72", False),
        # the fit beside D: the outer diameter centres, the tips have a rounding
        ("50xH7/h6x2 GOST 6033-80", {}, "50\u00d72", True),
        ("DIN 5480 - N 120 x 3 x 38 x 9H", DIN, "120\u00d73\u00d738", False),
        ("W 120 x 3 x 30 x 38 x 9H 8f", DIN, "120\u00d73\u00d738", False),
        ("INT/EXT 24z x 2,5m x 30R x 5H/5f", ISO, "24z\u00d72.5m\u00d730R", False),
        ("EXT 24Z X 2.5M X 30P X 5f ISO 4156", ISO, "24z\u00d72.5m\u00d730P", False),
        # these angles have one form of the root, so their designation needs no letter
        ("INT 24z x 2,5m x 37,5 x 6H", ISO, "24z\u00d72.5m\u00d737.5R", False),
        ("INT/EXT 24z\u00d72.5m\u00d745\u00d76H/7h", ISO, "24z\u00d72.5m\u00d745R", False),
    ],
)
def test_involute_splines_are_read_from_their_drawings(
    size: str, keys: dict[str, Any], name: str, rounded: bool
) -> None:
    made = InvoluteSplineTable(size, **keys).joint()
    assert (made.name, made.roundings[1] > 0) == (name, rounded)


@pytest.mark.parametrize(
    ("size", "given", "meant"),
    [
        ("30x1x28x8f", "GOST 6033", "DIN 5480"),
        ("24z x 2m x 30R x 5H", "DIN 5480", "ISO 4156"),
        ("50x2", "ISO 4156", "GOST 6033"),
    ],
)
def test_a_designation_of_another_standard_is_told_so(size: str, given: Any, meant: str) -> None:
    with pytest.raises(ParameterError) as caught:
        InvoluteSplineTable(size, standard=given).joint()
    assert (caught.value.name, caught.value.code) == ("bore.standard", "size_of_other_standard")
    assert caught.value.nearest == Nearest(meant)
    made: Any = meant
    assert InvoluteSplineTable(size, standard=made).joint().standard == meant


@pytest.mark.parametrize(
    ("size", "keys"),
    [
        ("50x2 DIN 5480", {}),
        # of four numbers the third is the pressure angle, and DIN 5480 has one
        ("W 120 x 3 x 20 x 38", DIN),
        ("24z x 0m x 30P", ISO),
        ("201z x 2m x 30P", ISO),
        ("24z x 2m x 30", ISO),
        ("24z x 2m x 45P", ISO),
        ("24z x 2m x 37.5P x 5H", ISO),
    ],
)
def test_no_other_splines_are_read(size: str, keys: dict[str, Any]) -> None:
    with pytest.raises(ParameterError) as caught:
        InvoluteSplineTable(size, **keys).joint()
    assert caught.value.code == "no_such_spline"


@pytest.mark.parametrize(
    ("size", "keys", "classes"),
    [
        ("INT/EXT 24z x 2,5m x 30R x 5H/5f", ISO, ("5H", "5f")),
        ("EXT 24z x 2,5m x 37.5R x 5js", ISO, ("", "5js")),
        ("24z x 2,5m x 30P", ISO, ("", "")),
        ("INT/EXT 24z x 2,5m x 45 x 6H/7h", ISO, ("6H", "7h")),
        ("DIN 5480 - N 120 x 3 x 38 x 9H", DIN, ("9H", "")),
        ("W 120 x 3 x 30 x 38 x 8f", DIN, ("", "8f")),
        ("120 x 3 x 38 x 9H 8f", DIN, ("9H", "8f")),
        ("50x2x9H/9g GOST 6033-80", {}, ("9H", "9g")),
        # a blank stands for the sign before them
        ("120x3x38 9H/8f", DIN, ("9H", "8f")),
        ("DIN 5480 - N 120 x 3 x 38 9H", DIN, ("9H", "")),
        ("W 120 x 3 x 38 8f", DIN, ("", "8f")),
        ("120x3x38 9H 8f", DIN, ("9H", "8f")),
        ("50x2 9H/9g GOST 6033-80", {}, ("9H", "9g")),
        ("ISO 4156 INT/EXT 24z x 2,5m x 30R 5H/5f", ISO, ("5H", "5f")),
        ("50xH7/g6x2 GOST 6033-80", {}, ("", "")),
    ],
)
def test_classes_of_tolerance_end_a_designation(size: str, keys: dict[str, Any], classes: tuple[str, str]) -> None:
    made = InvoluteSplineTable(size, **keys).joint()
    assert (made.hub_class, made.shaft_class) == classes
    plain = InvoluteSplineTable(re.sub(r"(?: x)? \d+(H|f|js).*", "", size), **keys).joint()
    # they move nothing
    assert (plain.shaft().outline(), plain.hub().outline()) == (made.shaft().outline(), made.hub().outline())


@pytest.mark.parametrize(
    ("size", "keys", "code"),
    [
        ("25z x 1m x 30P x 9H", ISO, "no_such_spline_class"),
        ("25z x 1m x 30P x 5F", ISO, "no_such_spline_class"),
        ("25z x 1m x 30P x 5f/5h", ISO, "no_such_spline_class"),
        ("120x3x38x4H", DIN, "no_such_spline_class"),
        ("120x3x38x8js", DIN, "no_such_spline_class"),
        ("200z x 10m x 30P x 5h", ISO, "spline_classes_end"),
        ("50x2x6H", {}, "no_such_spline_class"),
        ("50x2x9e", {}, "no_such_spline_class"),
        ("50x2x7H/7n", {}, "spline_class_unheld"),
        ("50x2x9H", {"clearance": 0.1}, "clearance_of_class"),
        ("25z x 1m x 30P x 5h", ISO | {"clearance": 0.1}, "clearance_of_class"),
    ],
)
def test_other_classes_are_refused(size: str, keys: dict[str, Any], code: str) -> None:
    with pytest.raises(ParameterError) as caught:
        InvoluteSplineTable(size, **keys).joint()
    assert caught.value.code == code


@pytest.mark.parametrize(
    ("size", "keys", "right"),
    [
        ("50x2x8f/9H", {}, "50x2x9H/8f"),
        ("50 x 2 x 7p", {}, "50x2"),
        ("W 120 x 3 x 38 x 8f 9H", DIN, "W120x3x38x9H/8f"),
        ("24z x 2m x 30R x 5f/5H", ISO, "24zx2mx30Rx5H/5f"),
    ],
)
def test_what_is_told_instead_of_classes_is_read(size: str, keys: dict[str, Any], right: str) -> None:
    with pytest.raises(ParameterError) as caught:
        InvoluteSplineTable(size, **keys).joint()
    assert caught.value.nearest == Nearest(right)
    assert InvoluteSplineTable(right, **keys).joint().module > 0


def test_centring_on_the_inner_diameter_is_told_as_such() -> None:
    with pytest.raises(ParameterError) as caught:
        InvoluteSplineTable("i 50x2xH7/g6").joint()
    assert caught.value.code == "spline_centred_inside"


@pytest.mark.parametrize(
    "size", [{"size": "6x23x26"}, {"teeth": 6, "inner_diameter": 23.0, "outer_diameter": 26.0, "width": 6.0}]
)
def test_a_rounding_without_room_is_blamed_itself(size: dict[str, Any]) -> None:
    """Before: the outer diameter where sizes were told, and on a shaft no limit."""
    with pytest.raises(ParameterError) as caught:
        StraightSplineTable(root_rounding=5.0, **size).checked("spline")
    assert (caught.value.name, caught.value.value) == ("spline.root_rounding", 5.0)
    limit = caught.value.nearest
    assert limit is not None
    assert limit.side == "at_most"
    most = limit.value
    assert isinstance(most, float)
    StraightSplineTable(root_rounding=most, **size).checked("spline")
    with pytest.raises(ParameterError):
        StraightSplineTable(root_rounding=most + 2e-4, **size).checked("spline")


@pytest.mark.parametrize(
    ("keys", "name", "fits"),
    # the rounding r of the shaft ends sqrt((d / 2 + r)^2 - (b / 2 + r)^2) from the middle, the chamfer c begins at
    # sqrt(d^2 - b^2) / 2 + c
    [
        ({"size": "8x32x36", "chamfer": 0.2}, "chamfer", math.sqrt(16.3**2 - 3.3**2) - math.sqrt(16**2 - 9)),
        ({"size": "6x23x26", "chamfer": 0.1}, "chamfer", math.sqrt(11.7**2 - 3.2**2) - math.sqrt(11.5**2 - 9)),
    ],
)
def test_a_chamfer_that_lets_no_rounded_root_in_is_refused(keys: dict[str, Any], name: str, fits: float) -> None:
    """Files were made that failed their own read-back: the mate of the spline has a clearance of -0.0035 mm."""
    with pytest.raises(ParameterError) as caught:
        StraightSplineTable(**keys).checked("bore")
    assert (caught.value.code, caught.value.name) == ("spline_mouth_narrow", f"bore.{name}")
    limit = caught.value.nearest
    assert limit is not None
    assert (limit.side, limit.value) == ("at_least", pytest.approx(fits, abs=2e-4))
    StraightSplineTable(**keys | {name: limit.value}).checked("bore")
    with pytest.raises(ParameterError):
        StraightSplineTable(**keys | {name: fits - 1e-4}).checked("bore")
    # the sides of a shaft that does not centre on its root begin within the hub
    StraightSplineTable(size="D-8x36x40", chamfer=0.0).checked("bore")


def test_round_roots_do_not_centre_by_the_fit_of_the_outer_diameter() -> None:
    with pytest.raises(ParameterError) as caught:
        InvoluteSplineTable("50xH7/h6x2", root="fillet").joint()
    assert caught.value.code == "centred_by_flat_roots"


ZONES = ["H7", "H8", "H12", "D9", "F10", "f7", "f8", "a11", "h7", "js6", "Js7", "k7", "n6", "G7", "c9", "H13",
         "H7/f7", "f7/H7", "H7/H7", "f7/f7", "D9/f8", "H07", "H7/", "H7/f7/g6", "ZC8"]  # fmt: skip
CLASSES = ["9H", "8f", "9H/9g", "9g/9H", "7n", "7H/7n", "12H", "9h9H", "9H8f", "5H/5f", "5js", "8js", "9H/9H",
           "10d", "07H", "9I"]  # fmt: skip


def drawn(random: Random) -> StraightSplineTable | InvoluteSplineTable:
    """A designation with any zones and classes."""

    def beside(size: str) -> str:
        return size + random.choice(("", "x")) + random.choice(ZONES) if random.random() < 0.4 else size

    if random.random() < 0.5:
        first, *sizes = (f"{x:g}" for x in random.choice(STRAIGHT_JOINTS).sizes)
        parts = [first, *map(beside, sizes)]
        return StraightSplineTable(random.choice(("", "d-", "D-", "b-", "D")) + random.choice("x*").join(parts))
    tail = random.choice(("", *(f"x{one}" for one in CLASSES)))
    diameter, module, teeth = random.choice((("50", "2", 24), ("20", "1", 18), ("600", "10", 58), ("120", "3", 38)))
    match random.choice(STANDARDS):
        case "ISO 4156":
            return InvoluteSplineTable(f"{teeth}zx{module}mx30{random.choice('PR')}{tail}", "ISO 4156")
        case "DIN 5480":
            return InvoluteSplineTable(f"{diameter}x{module}x{teeth}{tail}", "DIN 5480")
    return InvoluteSplineTable(f"{beside(diameter)}x{module}{tail}")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("seed", range(4))
def test_any_designation_is_read_back_by_its_name_or_refused_with_what_is_read(seed: int) -> None:
    random, made, cures = Random(seed), 0, list[StraightSplineTable | InvoluteSplineTable]()
    for table in (drawn(random) for _ in range(400)):
        try:
            joint = table.joint()
        except ParameterError as refusal:
            if refusal.name == "bore.size" and refusal.nearest is not None:
                cures.append(changed(table, size=refusal.nearest.value))
            continue
        made += 1
        assert changed(table, size=joint.named()).joint() == joint
        assert all(changed(table, size=joint.named(is_shaft=one)).joint().name == joint.name for one in (True, False))
    assert made > 40
    assert len(cures) > 5
    assert all(table.joint() for table in cures)
