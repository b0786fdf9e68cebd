"""The table of a picture of meshing, cell by cell, by the formulas of ISO 21771 for gears without shift."""

from __future__ import annotations

import math
from typing import Any

import pytest

from exporters.production.plan import plan_build
from parts.scene.load import scene_from_dict

ALPHA = math.radians(20)
M, WIDTH = 2.0, 12.0


def gear(teeth: int, **more: Any) -> dict[str, Any]:
    return {"kind": "spur_gear", "module": M, "number_of_teeth": teeth, "face_width": WIDTH} | more


def cells(first: dict[str, Any], second: dict[str, Any], mate: dict[str, Any]) -> dict[str, tuple[str, str]]:
    """Names with symbol and value as the table has them, the title under an empty name."""
    raw = {
        "parts": {"one": first, "two": second | {"title": "Second"}},
        "mates": [{"first": "one", "second": "two"} | mate],
        "exports": [{"format": "sheet", "tolerance": 1e-3}],
    }
    job = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets[0]
    texts = [text.text for text in job.canvas.texts]
    title = next(text for text in texts if "(1)" in text)
    table = {"": (title, "")}
    for name in NAMES:
        if name in texts:
            at = texts.index(name)
            table[name] = texts[at + 1], texts[at + 2]
    # both of a pair
    for symbol in ("z1", "z2", "x1", "x2", "xn1", "xn2"):
        if symbol in texts:
            table[symbol] = symbol, texts[texts.index(symbol) + 1]
    return table


NAMES = ("module", "normal module", "transverse module", "helix angle", "centre distance", "axis to datum line",
         "working pressure angle", "line of action", "active line of action", "arc of action", "working pitch",
         "contact ratio", "common face width", "overlap ratio", "normal backlash")  # fmt: skip


def ratio(m: float, alpha: float, z1: int, z2: int, ha: float = M) -> float:
    """Contact ratio of external gears without shift."""
    r1, r2 = m * z1 / 2, m * z2 / 2
    ends = [math.sqrt((r + ha) ** 2 - (r * math.cos(alpha)) ** 2) for r in (r1, r2)]
    return (sum(ends) - (r1 + r2) * math.sin(alpha)) / (math.pi * m * math.cos(alpha))


def test_an_external_pair_is_told_by_its_numbers() -> None:
    z1, z2 = 20, 30
    found = cells(gear(z1), gear(z2), {"kind": "external_gear_pair"})
    a, e = M * (z1 + z2) / 2, ratio(M, ALPHA, z1, z2)
    p = math.pi * M
    assert found == {
        "": ("Picture of external involute meshing: one (1), Second (2)", ""), "module": ("m", "2"),
        "z1": ("z1", "20"), "z2": ("z2", "30"), "x1": ("x1", "0"), "x2": ("x2", "0"),
        "centre distance": ("aw", f"{a:.3f}"), "working pressure angle": ("αw", "20.0000°"),
        "line of action": ("N1N2", f"{a * math.sin(ALPHA):.3f}"),
        "active line of action": ("ab", f"{e * p * math.cos(ALPHA):.3f}"), "arc of action": ("dd'", f"{e * p:.3f}"),
        "working pitch": ("pw", f"{p:.3f}"), "contact ratio": ("εα", f"{e:.4f}"),
    }  # fmt: skip


@pytest.mark.parametrize(("backlash", "told"), [(0.12, "0.120"), (5.1e-4, "0.001"), (4.9e-4, None)])
def test_a_backlash_is_told_where_a_file_s_numbers_show_it(backlash: float, told: str | None) -> None:
    found = cells(gear(20), gear(30), {"kind": "external_gear_pair", "normal_backlash": backlash})
    assert found.get("normal backlash", (None, None))[1] == told


def test_a_helical_pair_is_told_by_its_normal_and_its_transverse_section() -> None:
    """m_t = m / cos beta, tan alpha_t = tan alpha / cos beta; overlap b sin beta / (pi m)."""
    z1, z2, beta = 20, 30, math.radians(15)
    helix = {"helix_angle_deg": 15.0}
    found = cells(gear(z1, **helix), gear(z2, face_width=9.5, hand="left", **helix), {"kind": "external_gear_pair"})
    mt, at = M / math.cos(beta), math.atan(math.tan(ALPHA) / math.cos(beta))
    a, e = mt * (z1 + z2) / 2, ratio(mt, at, z1, z2)
    assert found[""][0] == "Picture of external involute meshing (transverse section): one (1), Second (2)"
    assert "module" not in found
    assert {name: found[name] for name in ("normal module", "helix angle", "transverse module")} == {
        "normal module": ("mn", "2"), "helix angle": ("β", "15.0000°"), "transverse module": ("mt", f"{mt:.6g}")
    }  # fmt: skip
    assert (found["xn1"], found["xn2"]) == (("xn1", "0"), ("xn2", "0"))
    assert found["centre distance"] == ("aw", f"{a:.3f}")
    assert found["working pressure angle"] == ("αw", f"{math.degrees(at):.4f}°")
    assert found["contact ratio"] == ("εα", f"{e:.4f}")
    assert found["working pitch"] == ("pw", f"{math.pi * mt:.3f}")
    assert found["common face width"] == ("b", "9.5")
    assert found["overlap ratio"] == ("εβ", f"{9.5 * math.sin(beta) / (math.pi * M):.4f}")


def test_normal_shifts_of_helical_gears_are_those_that_were_asked_for() -> None:
    helix = {"helix_angle_deg": 15.0}
    first, second = gear(20, profile_shift_coefficient=0.25, **helix), gear(30, hand="left", **helix)
    found = cells(first, second, {"kind": "external_gear_pair"})
    assert (found["xn1"], found["xn2"]) == (("xn1", "0.25"), ("xn2", "0"))


def test_a_pinion_on_a_rack_has_no_line_between_base_circles() -> None:
    """Axis to datum line m z / 2; the rack's addendum ends the line of action at m / sin alpha."""
    z = 20
    found = cells(
        gear(z), {"kind": "rack", "module": M, "number_of_teeth": 12, "face_width": WIDTH}, {"kind": "rack_pair"}
    )
    r = M * z / 2
    e = (math.sqrt((r + M) ** 2 - (r * math.cos(ALPHA)) ** 2) - r * math.sin(ALPHA) + M / math.sin(ALPHA)) / (
        math.pi * M * math.cos(ALPHA)
    )
    assert found[""][0] == "Picture of rack meshing: one (1), Second (2)"
    assert found["axis to datum line"] == ("aw", f"{r:.3f}")
    assert found["contact ratio"] == ("εα", f"{e:.4f}")
    assert "line of action" not in found
    assert "centre distance" not in found


@pytest.mark.parametrize("turned", [False, True])
def test_a_ring_is_the_second_in_its_picture_whatever_the_mate_says(turned: bool) -> None:
    """N1N2 = a sin alpha, with a = m (z2 - z1) / 2."""
    ring = {"kind": "ring_gear", "module": M, "number_of_teeth": 60, "face_width": WIDTH, "outer_diameter": 140.0}
    first, second = (ring, gear(24)) if turned else (gear(24), ring)
    found = cells(first, second, {"kind": "internal_gear_pair"})
    names = "Second (1), one (2)" if turned else "one (1), Second (2)"
    assert found[""][0] == f"Picture of internal involute meshing: {names}"
    a = M * (60 - 24) / 2
    assert (found["z1"], found["z2"]) == (("z1", "24"), ("z2", "60"))
    assert found["centre distance"] == ("aw", f"{a:.3f}")
    assert found["line of action"] == ("N1N2", f"{a * math.sin(ALPHA):.3f}")
