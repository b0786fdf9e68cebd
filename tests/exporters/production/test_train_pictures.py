"""Trains as their sheets have them: links from the driver on, heights of axes, rims, by the numbers of their teeth."""

from __future__ import annotations

from fractions import Fraction

import pytest

from exporters.production.train_sheets import train_picture
from geometry.kinematics.mechanism import Rolling
from parts.mates.sheets.train_picture import Rim, TrainPicture
from tests.parts.scene.test_trains import DRIVE, GEAR, JAMES, placed


def picture(text: str) -> tuple[TrainPicture, list[str]]:
    placing = placed(text)
    assert placing.train is not None
    joints = placing.train.moving.stands.mechanism.joints
    return train_picture(placing.train, [j for j in joints if isinstance(j, Rolling)], placing.instances)


def links(found: TrainPicture) -> dict[str, tuple[float, Fraction, str | None]]:
    """By name: height of the axis to 1e-6 mm, rate, and the name of the carrier."""
    names = [link.name for link in found.links]
    return {
        link.name: (round(link.axis, 6) + 0.0, link.rate, None if link.carrier is None else names[link.carrier])
        for link in found.links
    }


def pair(first: str, second: str, kind: str = "external") -> str:
    return f'[[mates]]\nkind = "{kind}_gear_pair"\nfirst = "{first}"\nsecond = "{second}"\n'


ROW = "".join(GEAR.format(*row) for row in (("a", 20), ("b", 30), ("c", 40))) + pair("a", "b") + pair("b", "c")


@pytest.mark.parametrize(("driver", "order", "heights", "rates", "meshes"), [
    ("a", "abc", (0, 50, 120), (1, Fraction(-2, 3), Fraction(1, 2)), ((0, 1), (1, 2))),
    ("c", "cba", (0, 70, 120), (1, Fraction(-4, 3), 2), ((1, 0), (2, 1))),
    ("b", "bac", (0, 50, 70), (1, Fraction(-3, 2), Fraction(-3, 4)), ((1, 0), (0, 2))),
])  # fmt: skip
def test_a_row_is_told_from_its_driver_on(
    driver: str, order: str, heights: tuple[int, ...], rates: tuple[Fraction, ...], meshes: tuple[tuple[int, int], ...]
) -> None:
    """Axes m (z1 + z2) / 2 above those from which they are driven, whichever of a mate is named first."""
    found, rims = picture(ROW + DRIVE.format(driver, "turns = 1.0"))
    teeth = {"a": 20, "b": 30, "c": 40}
    assert rims == list(order)
    assert links(found) == {str(k + 1): (heights[k], rates[k], None) for k in range(3)}
    assert found.rims == tuple(Rim(str(k + 1), k, teeth[key]) for k, key in enumerate(order))
    assert (found.meshes, found.driver) == (meshes, 0)


@pytest.mark.parametrize("first", ["pinion", "ring"])
@pytest.mark.parametrize(("driver", "height"), [("pinion", -40.0), ("ring", 40.0)])
def test_a_ring_stands_below_its_pinion(first: str, driver: str, height: float) -> None:
    """m (60 - 20) / 2 below, in either order of the mate; a driven pinion as far above its ring."""
    text = GEAR.format("pinion", 20) + GEAR.format("ring", 60).replace("spur", "ring") + "outer_diameter = 140.0\n"
    second = "ring" if first == "pinion" else "pinion"
    found, rims = picture(text + pair(first, second, "internal") + DRIVE.format(driver, "turns = 1.0"))
    other = "ring" if driver == "pinion" else "pinion"
    assert rims == [driver, other]
    rate = Fraction(1, 3) if driver == "pinion" else Fraction(3)
    assert links(found) == {"1": (0.0, 1, None), "2": (height, rate, None)}
    assert {(rim.teeth, rim.internal) for rim in found.rims} == {(20, False), (60, True)}


@pytest.mark.parametrize(("driver", "rates"), [
    ("sun", (1, Fraction(-1, 2), 0, Fraction(1, 4))), ("carrier", (4, -2, 0, 1)),
])  # fmt: skip
def test_satellites_that_do_the_same_stand_there_once(driver: str, rates: tuple[Fraction, ...]) -> None:
    """James 40/40/120, four satellites: u_1H = 1 + 120/40; the ring is about the sun's axis."""
    found, rims = picture(JAMES + DRIVE.format(driver, "turns = 1.0"))
    assert rims == ["sun", "planet", "ring"]
    heights = (0.0, 80.0, 0.0, 0.0)
    names = ("1", "2", "3", "H")
    carriers = (None, "H", None, None)
    assert links(found) == dict(zip(names, zip(heights, rates, carriers, strict=True), strict=True))
    assert found.rims == (Rim("1", 0, 40), Rim("2", 1, 40), Rim("3", 2, 120, 0, True))
    assert found.meshes == ((0, 1), (1, 2))
    assert found.links[found.driver].name == {"sun": "1", "carrier": "H"}[driver]


DOUBLE = (
    GEAR.format("sun", 40) + GEAR.format("planet", 20) + GEAR.format("second", 30)
    + GEAR.format("ring", 90).replace("spur", "ring") + "outer_diameter = 200.0\n"
    + '[parts.carrier]\nkind = "plate"\nwidth = 160.0\nheight = 20.0\nface_width = 3.0\n'
    + "[instances.ring]\nheld = true\n" + pair("sun", "planet")
    + '[[mates]]\nkind = "fixed"\nfirst = "planet"\nsecond = "second"\noffset = [0.0, 0.0, {step}]\n'
    + pair("second", "ring", "internal") + "direction_deg = 180.0\n"
    + '[[mates]]\nkind = "coaxial"\nfirst = "sun"\nsecond = "carrier"\nheight = 20.0\n'
    '[[mates]]\nkind = "carried"\nfirst = "carrier"\nsecond = "planet"\n'
)  # fmt: skip


@pytest.mark.parametrize(("step", "levels"), [("-9.0", (1, 0)), ("9.0", (0, 1))])
def test_rims_of_one_body_have_primes_and_stand_in_columns_by_their_heights(step: str, levels: tuple[int, int]) -> None:
    """z 40, 20 - 30, 90: u_1H = 1 + 20 x 90 / (40 x 30) = 2.5; what meshes stands in one column."""
    found, rims = picture(DOUBLE.replace("{step}", step) + DRIVE.format("sun", "turns = 1.0"))
    assert rims == ["sun", "planet", "second", "ring"]
    assert links(found) == {
        "1": (0.0, 1, None), "2": (60.0, Fraction(-4, 5), "H"), "3": (0.0, 0, None), "H": (0.0, Fraction(2, 5), None)
    }  # fmt: skip
    one, two = levels
    assert found.rims == (Rim("1", 0, 40, one), Rim("2", 1, 20, one), Rim("2'", 1, 30, two), Rim("3", 2, 90, two, True))
    assert found.meshes == ((0, 1), (2, 3))


def test_two_bare_carriers_are_numbered() -> None:
    """Two stages of James one above the other: the carrier of the first turns the sun of the second."""
    stage = JAMES
    for name in ("sun", "planet", "ring", "carrier"):
        stage = stage.replace(f"parts.{name}", f"parts.{name}_b").replace(f"instances.{name}", f"instances.{name}_b")
        stage = stage.replace(f'"{name}"', f'"{name}_b"').replace(f'"{name}_1"', f'"{name}_b_1"')
        stage = stage.replace(f'"{name}_2"', f'"{name}_b_2"')
    joined = '[[mates]]\nkind = "fixed"\nfirst = "carrier"\nsecond = "sun_b"\noffset = [0.0, 0.0, 10.0]\n'
    head, mates = stage.split("[[mates]]", 1)
    first, own = JAMES.split("[[mates]]", 1)
    text = first + head + "[[mates]]" + own + joined + "[[mates]]" + mates + DRIVE.format("sun", "turns = 16.0")
    found, rims = picture(text)
    assert rims == ["sun", "planet", "ring", "sun_b", "planet_b", "ring_b"]
    told = links(found)
    # the carrier of the first is the body of the second's sun, and has its number; the last one is bare
    assert {name: rate for name, (_, rate, _) in told.items()} == {
        "1": 1, "2": Fraction(-1, 2), "3": 0, "4": Fraction(1, 4), "5": Fraction(-1, 8), "6": 0, "H": Fraction(1, 16)
    }  # fmt: skip
    assert [told[name][2] for name in ("2", "5")] == ["4", "H"]
    assert [told[name][0] for name in ("1", "2", "3", "4", "5", "6", "H")] == [0, 80, 0, 0, 80, 0, 0]
    assert [rim.level for rim in found.rims] == [0, 0, 0, 1, 1, 1]
