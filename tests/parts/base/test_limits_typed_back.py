"""A limit that a remark tells is typed back as it stands there: the remark is gone."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from typing import Any

import pytest

from parts.scene.load import make_parts, scene_from_dict
from parts.texts.findings import finding_text
from tests.offered import cam, put
from tests.parts.limits import scene_of

Keys = dict[str, Any]
Draw = random.Random


def remarks(part: Keys) -> dict[str, str]:
    """What is told of a part, by code."""
    found = make_parts(scene_from_dict(scene_of(part), "s", "s"), "s")[0]["p"].report.findings
    return {finding.code: finding_text("en", finding) for finding in found}


def undercut(draw: Draw) -> Keys:
    return {"kind": "spur_gear", "module": 2.0, "number_of_teeth": draw.randint(10, 15),
            "helix_angle_deg": round(draw.uniform(3, 20), 2)}  # fmt: skip


def wide(draw: Draw) -> Keys:
    return {"kind": "bevel_gear", "module": 2.0, "number_of_teeth": draw.randint(14, 25),
            "mate_number_of_teeth": draw.randint(25, 47), "face_width": 21.5}  # fmt: skip


def loose(draw: Draw) -> Keys:
    keys = cam(follower=None, base_circle_radius=40.0, follower_radius=round(draw.uniform(5, 9), 3))
    return keys | {"kind": "groove_cam", "groove_depth": 5.0, "roller_clearance": 2.0}


def chamfered(draw: Draw) -> Keys:
    return {"kind": "spur_gear", "module": 3.0, "number_of_teeth": 30, "face_chamfer": 0.45,
            "tip_rounding": round(draw.uniform(0.2, 0.4), 3)}  # fmt: skip


def hubbed(draw: Draw) -> Keys:
    teeth = draw.randint(15, 40)
    return {"kind": "sprocket", "chain": "08B", "number_of_teeth": teeth,
            "hub": {"diameter": 12.7 * teeth / 3.1416 - 10.0, "above": 5.0}}  # fmt: skip


@pytest.mark.parametrize(
    ("code", "make", "place", "told"),
    [
        ("undercut", undercut, ("profile_shift_coefficient",), r"x_min = (-?[\d.]+)"),
        ("bevel_wide_face", wide, ("face_width",), r"usual ([\d.]+) mm"),
        ("roller_play", loose, ("roller_clearance",), r"above ([\d.]+) mm it knocks"),
        ("tip_rounding_kept", chamfered, ("face_chamfer",), r"rounding \(([\d.]+) mm\)"),
        ("hub_in_way_of_plates", hubbed, ("hub", "diameter"), r"at most ([\d.]+) mm"),
    ],
)
def test_a_remark_is_gone_with_the_limit_that_it_tells(
    code: str, make: Callable[[Draw], Keys], place: tuple[str, ...], told: str
) -> None:
    """Rounded to the nearest digit every second limit was remarked on again."""
    draw = random.Random(code)
    for part in (make(draw) for _ in range(6)):
        found = re.search(told, remarks(part)[code])
        assert found is not None
        limit = float(found[1])
        kept = put(scene_of(part), ("parts", "p", *place), limit)["parts"]["p"]
        assert code not in remarks(kept)
        # two steps of the last digit beyond it, it is there again
        step = 2 * 10.0 ** -len(found[1].partition(".")[2]) * (-1 if code == "undercut" else 1)
        beyond = put(scene_of(part), ("parts", "p", *place), limit + step)["parts"]["p"]
        assert code in remarks(beyond)
