"""Of each key that is a size: which dimensions and cells of the drawing depend on it; all others stay as they are."""

from __future__ import annotations

import copy
import math
import re
from collections import Counter
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import ezdxf
import pytest

from tests.exporters.production.test_part_drawings import PARTS, drawn

ROOT, _20 = math.sqrt(3), math.radians(20.0)
SPAN = 2 * math.cos(_20) * (4.5 * math.pi + 40 * (math.tan(_20) - _20)) + math.sin(_20)
VIEW = re.compile(r"(.* )?([A-K](-[A-K])?|Centre holes)?( ?\([\d.]+:[\d.]+\))?")
# words of a table that depend on it too: None: positions of a cam, of which there are many
CELLS: dict[tuple[str, str], set[str] | None] = {
    ("cam", "base_circle_radius"): None, ("cam", "lift"): None, ("groove", "base_circle_radius"): None,
    ("groove", "groove_depth"): set(), ("barrel", "outer_diameter"): None, ("barrel", "lift"): None,
    ("barrel", "groove_depth"): set(),
    # x, and W over 5 teeth: m cos(alpha) (4.5 pi + z inv(alpha)) + 2 x m sin(alpha)
    ("gear", "profile_shift_coefficient"): {"0.25", f"{SPAN:.3f}"},
}  # fmt: skip
# part, changed keys, and what each measures before and after, mm
CASES: list[tuple[str, dict[str, Any], dict[float, float]]] = [
    ("bearing", {"points.1.r": 32.0, "points.2.r": 32.0}, {62.0: 64.0}),
    ("bearing", {f"points.{k}.r": 21.0 for k in (0, 3, 4, 5)}, {40.0: 42.0}),
    ("bearing", {"points.2.z": 18.0, "points.3.z": 18.0}, {16.0: 18.0}),
    ("bearing", {"points.4.arc": -4.0}, {3.5: 4.0}),
    ("bearing", {"points.4.z": 12.0, "points.5.z": 6.0}, {5.0: 6.0}),
    ("bearing", {"points.4.z": 11.5}, {6.0: 6.5}),
    ("bearing", {"points.1.chamfer": 1.6}, {1.0: 1.6}),
    ("shaft", {"steps.1.diameter": 32.0}, {30.0: 32.0}),
    # DIN 6885: of 17 to 22 mm the way is 3.5 deep
    ("shaft", {"steps.0.diameter": 22.0}, {20.0: 22.0, 16.5: 18.5}),
    ("shaft", {"steps.0.length": 33.0}, {30.0: 33.0, 70.0: 73.0}),
    ("shaft", {"steps.1.length": 45.0}, {70.0: 75.0}),
    ("shaft", {"steps.0.chamfer": 1.6}, {1.0: 1.6}),
    ("shaft", {"steps.0.keyways.0.at": 6.0}, {5.0: 6.0}),
    ("shaft", {"steps.0.keyways.0.length": 18.0}, {20.0: 18.0}),
    # cone of 60 degrees to 2.12 d, cylinder, tip of 120 degrees
    ("shaft", {"centre_holes.diameter": 2.5}, {k * 2.0: k * 2.5 for k in (
        1, 2.12, 0.56 * ROOT, 0.56 * ROOT + 1, 0.56 * ROOT + 1 + 0.5 / ROOT)}),
    ("thin", {"steps.1.length": 2.2}, {932.5: 932.7, 902.5: 902.7, 2.5: 2.7}),
    ("thin", {"steps.2.length": 0.6}, {932.5: 932.6, 902.5: 902.6, 2.5: 2.6, 0.5: 0.6}),
    ("thin", {"steps.3.length": 31.0}, {932.5: 933.5}),
    ("thin", {"steps.2.fillet": 0.04}, {0.05: 0.04}),
    ("long", {"steps.0.grooves.0.at": 210.0}, {200.0: 210.0}),
    ("long", {"steps.0.grooves.0.width": 1.6}, {1.3: 1.6}),
    ("long", {"steps.0.grooves.0.diameter": 28.0}, {28.6: 28.0}),
    ("gear", {"bore.diameter": 22.0}, {20.0: 22.0, 22.8: 24.8}),
    # where the web stands follows from the width
    ("gear", {"face_width": 24.0}, {20.0: 24.0, 25.0: 29.0, 6.0: 8.0}),
    ("gear", {"hub.diameter": 36.0}, {34.0: 36.0}),
    ("gear", {"hub.above": 6.0}, {25.0: 26.0}),
    ("gear", {"web.thickness": 7.0}, {8.0: 7.0, 6.0: 6.5}),
    ("gear", {"web.rim_diameter": 66.0}, {64.0: 66.0}),
    ("gear", {"holes.diameter": 10.0}, {9.0: 10.0}),
    ("gear", {"holes.pitch_circle_diameter": 50.0}, {49.0: 50.0}),
    ("gear", {"face_chamfer": 0.8}, {1.0: 0.8}),
    ("gear", {"profile_shift_coefficient": 0.25}, {84.0: 85.0}),
    ("helical", {"bore_diameter": 15.0}, {14.0: 15.0}),
    ("helical", {"face_width": 20.0}, {18.0: 20.0}),
    ("ring", {"outer_diameter": 114.0}, {112.0: 114.0}),
    ("ring", {"face_width": 16.0}, {15.0: 16.0}),
    ("ring", {"holes.pitch_circle_diameter": 101.0}, {100.0: 101.0}),
    ("ring", {"holes.diameter": 6.0}, {5.0: 6.0}),
    ("rack", {"face_width": 16.0}, {15.0: 16.0}),
    ("rack", {"body_height": 13.0}, {16.5: 17.5, 14.5: 15.5}),
    ("worm", {"shaft_above.0.length": 22.0}, {70.0: 72.0}),
    ("worm", {"shaft_above.0.diameter": 26.0}, {25.0: 26.0}),
    ("worm", {"shaft_above.0.chamfer": 1.6}, {1.0: 1.6}),
    ("worm", {"thread_length": 55.0}, {50.0: 55.0, 70.0: 75.0}),
    ("worm", {"bore_diameter": 9.0}, {8.0: 9.0}),
    ("wheel", {"face_width": 28.0}, {30.0: 28.0, 15.0: 14.0}),
    ("wheel", {"bore_diameter": 26.0}, {25.0: 26.0}),
    ("cam", {"base_circle_radius": 41.0}, {80.0: 82.0}),
    ("cam", {"lift": 21.0}, {}),
    ("cam", {"bore.across_flats": 13.0}, {12.0: 13.0}),
    ("cam", {"hub.diameter": 31.0}, {30.0: 31.0}),
    ("cam", {"hub.above": 9.0}, {18.0: 19.0}),
    ("groove", {"outer_diameter": 162.0}, {160.0: 162.0}),
    ("groove", {"groove_depth": 5.0}, {6.0: 5.0}),
    ("groove", {"face_width": 13.0}, {12.0: 13.0}),
    ("barrel", {"outer_diameter": 72.0}, {70.0: 72.0, 70 * math.pi: 72 * math.pi}),
    ("barrel", {"groove_depth": 7.0}, {8.0: 7.0}),
    ("barrel", {"bore_diameter": 13.0}, {12.0: 13.0}),
    ("barrel", {"lift": 19.0}, {38.0: 39.0}),
    ("plate", {"width": 122.0}, {120.0: 122.0, 15.0: 16.0, 60.0: 61.0, 105.0: 106.0}),
    ("plate", {"holes.2.diameter": 21.0}, {20.0: 21.0}),
    ("plate", {"holes.2.at": [0.0, 11.0]}, {50.0: 51.0}),
    ("plate", {"corner_radius": 9.0}, {8.0: 9.0}),
    ("pin", {"length": 61.0}, {60.0: 61.0}),
    ("eccentric", {"eccentricity": 5.0}, {4.0: 5.0}),
    ("lantern", {"bore_diameter": 16.0}, {15.0: 16.0}),
    # two pins of rim
    ("lantern", {"pin_circle_diameter": 82.0}, {80.0: 82.0, 96.0: 98.0}),
    ("pin ring", {"face_width": 12.0}, {10.0: 12.0}),
    ("box", {"layers.0.thickness": 5.0}, {4.0: 5.0, 12.0: 13.0}),
    ("box", {"layers.1.thickness": 9.0}, {12.0: 13.0}),
    ("box", {"layers.1.circles.0.diameter": 31.0}, {30.0: 31.0}),
    ("box", {"layers.0.circles.0.at": [-25.0, -14.0], "layers.0.circles.1.at": [25.0, 14.0]}, {48.0: 50.0}),
    ("carrier", {"pin_circle_diameter": 82.0}, {80.0: 82.0}),
    ("carrier", {"boss_diameter": 16.0}, {7.5: 8.0}),
    ("carrier", {"hub_diameter": 42.0}, {20.0: 21.0}),
    ("carrier", {"bore_diameter": 12.0}, {10.0: 12.0}),
]  # fmt: skip


def changed(part: Mapping[str, Any], keys: Mapping[str, Any]) -> dict[str, Any]:
    """A part with other values at some places."""
    found = copy.deepcopy(dict(part))
    for place, value in keys.items():
        *steps, last = place.split(".")
        table: Any = found
        for step in steps:
            table = table[int(step) if step.isdigit() else step]
        table[last] = value
    return found


def told(part: dict[str, Any]) -> tuple[Counter[float], set[str]]:
    """What the dimensions of a drawing measure, and its other words, off its DXF by ezdxf."""
    with TemporaryDirectory() as folder:
        document = ezdxf.readfile(drawn(Path(folder), part))
    factors = {style.dxf.name: style.dxf.dimlfac for style in document.dimstyles}
    space = document.modelspace()
    measured = [one.get_measurement() * factors[one.dxf.dimstyle] for one in space.query("DIMENSION")]
    return Counter(round(float(value), 5) for value in measured), {text.dxf.text for text in space.query("TEXT")}


@cache
def before(name: str) -> tuple[Counter[float], set[str]]:
    return told(PARTS[name])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("number", range(len(CASES)), ids=[f"{name}-{','.join(keys)}" for name, keys, _ in CASES])
def test_what_depends_on_a_size_changes_and_nothing_else(number: int) -> None:
    name, keys, wanted = CASES[number]
    (old, old_words), (new, new_words) = before(name), told(changed(PARTS[name], keys))
    gone, come = Counter(round(a, 5) for a in wanted), Counter(round(b, 5) for b in wanted.values())
    # what one size loses another may have been
    assert (old - new, new - old) == (gone - come, come - gone)
    cells = CELLS.get((name, next(iter(keys))), set())
    if cells is not None:
        # letters and scales of views aside, which what is larger or smaller may change, the mass is left
        others = {word for word in new_words - old_words - cells if not VIEW.fullmatch(word)}
        assert len(others) <= 1, others
        assert all(re.fullmatch(r"[\d.]+", word) for word in others), others
        assert cells <= new_words
