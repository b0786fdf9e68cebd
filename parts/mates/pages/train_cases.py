"""The trains of the sources: lesson 2 of the practicum with its exercises, and the examples of the guide on trains.

A figure that is lost leaves the kind of one mesh open, which decides the sign of the ratio: ``open``.
"""

from __future__ import annotations

from collections.abc import Mapping

from geometry.base.record import Record, field


class Case(Record):
    """A train in the words of the keys; ``open``: the mesh whose kind only the lost figure would show."""

    meshes: str
    driven: str
    teeth: Mapping[str, int] = field(default_factory=dict)
    shafts: str = ""
    carriers: Mapping[str, str] = field(default_factory=dict)
    held: str = ""
    speeds: Mapping[str, float] = field(default_factory=dict)
    module: float | None = None
    open: str = ""


def _numbered(*teeth: int) -> dict[str, int]:
    return {str(k): z for k, z in enumerate(teeth, 1)}


_JAMES = ({"H": "2"}, "3")
# z 440/240-20/220: two internal meshes, coaxial at 200 teeth
_TWO_RINGS = "1-2 internal, 3-4 internal"
_RINGS_HELD = ("2-3, H-5", {"H": "2"}, "4")
CASES: dict[str, Case] = {
    "practicum_1": Case(
        f"{_TWO_RINGS}, 5-6, 6-7 internal", "7", _numbered(88, 48, 4, 44, 25, 17, 100), *_RINGS_HELD
    ),
    "practicum_2": Case("1-2, 3-4, 5-6", "H", _numbered(13, 52, 15, 33, 11, 45), "2-3, 4-5", {"H": "4"}, "6"),
    "practicum_3": Case(
        "1-2 internal, 3-4, 4-5 internal", "H", _numbered(25, 100, 20, 30, 80), "2-3", {"H": "4"}, "5", open="1-2"
    ),
    "2.10.2": Case(f"{_TWO_RINGS}, 5-6", "6", _numbered(440, 240, 20, 220, 20, 80), *_RINGS_HELD, open="5-6"),
    "2.10.3": Case(
        "1-2, 2-3, 4-5, 5-6 internal", "H", _numbered(15, 19, 30, 40, 20, 80), "3-4", {"H": "5"}, "6", open="2-3"
    ),
    "2.10.4": Case(
        f"{_TWO_RINGS}, 5-6, 6-7", "7", _numbered(440, 240, 20, 220, 20, 19, 80), *_RINGS_HELD, open="6-7"
    ),
    "2.10.5": Case(
        "1-2, 3-4, 5-6 internal", "H", _numbered(20, 80, 30, 30, 20, 80), "2-3, 4-5", {"H": "4"}, "6", open="1-2"
    ),
    "2.10.6": Case(
        "1-2, 2-3, 4-5, 5-6 internal", "H", _numbered(20, 19, 80, 40, 20, 80), "3-4", {"H": "5"}, "6", open="2-3"
    ),
    "2.10.7": Case("1-2, 3-4, 4-5 internal", "H", _numbered(20, 90, 40, 20, 80), "2-3", {"H": "4"}, "5", open="1-2"),
    "2.10.8": Case(
        "1-2, 3-4 internal, 5-6, 6-7", "7", _numbered(30, 30, 20, 80, 20, 19, 80), *_RINGS_HELD, open="6-7"
    ),
    "2.10.9": Case(f"{_TWO_RINGS}, 5-6", "6", _numbered(440, 240, 20, 220, 20, 80), *_RINGS_HELD, open="5-6"),
    "trains_1": Case("1-2", "2", speeds={"1": 300, "2": 50}),
    "trains_2": Case("1-2 internal", "2", _numbered(20, 120)),
    "trains_3": Case("1-2 bevel", "2", _numbered(20, 120), speeds={"1": 300}),
    "trains_4": Case("1-2 worm", "2", {"1": 2}, speeds={"1": 300, "2": 5}),
    "trains_5": Case("1-2, 2-3", "3", _numbered(20, 60, 30), module=5),
    "trains_6": Case("1-2, 2'-3", "3", {"1": 20, "2": 80, "2'": 30, "3": 90}, module=5),
    "trains_7": Case("1-2, 2-3 internal", "H", _numbered(40, 20, 120), "", *_JAMES, {"1": 120}),
    "trains_8": Case("1-2, 2'-3", "H", {"1": 40, "2": 30, "2'": 20, "3": 60}, "", *_JAMES, {"1": 120}),
    "trains_9": Case(
        "1-2, 4-3', 3-5", "4", {"1": 70, "2": 70, "3": 45, "3'": 48, "4": 72, "5": 75}, "2-H", {"H": "3"}, "5"
    ),
    "trains_10": Case(
        "1-2, 2-3 internal, 4-5, 5-6 internal", "H2", _numbered(12, 15, 41, 10, 14, 38), "H1-4",
        {"H1": "2", "H2": "5"}, "3, 6",
    ),
}  # fmt: skip
