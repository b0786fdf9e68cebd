"""How far an exploded view moves things: clear of what they are joined to, units as a whole."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from geometry.curves.curve import Real
from parts.scene.exploded import apart
from parts.scene.steps import StepSpec, stages


def box(low: Sequence[float], high: Sequence[float]) -> Real:
    return np.array([low, high], dtype=float)


BOXES = {
    "base": box((-50, -50, 0), (50, 50, 10)),
    "disk": box((-20, -20, 5), (20, 20, 15)),
    "lid": box((-20, -20, 15), (20, 20, 18)),
    "screw": box((8, 8, 8), (12, 12, 20)),
    "bolt": box((45, -2, 4), (70, 2, 8)),
    "ball": box((20, 0, 10), (24, 4, 14)),
}
DOWN, UP, LEFT = [0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]
STEPS = [
    StepSpec(bring=["lid"], to="disk", along=DOWN),
    StepSpec(bring=["screw"], to="disk", along=DOWN),
    StepSpec(bring=["ball"], to="lid"),
    StepSpec(bring=["disk"], to="base", along=DOWN),
    StepSpec(bring=["bolt"], to="base", along=LEFT),
]


def test_what_comes_from_above_stands_above_and_units_stay_together() -> None:
    moved = apart(stages(STEPS, BOXES), BOXES)
    stand = {key: BOXES[key] + moved[key] for key in BOXES}
    assert not moved["base"].any()
    for below, above in (("base", "disk"), ("disk", "lid"), ("lid", "screw")):
        assert stand[below][1, 2] < stand[above][0, 2]
    # from the right, past the edge of the base
    assert stand["bolt"][0, 0] > 50
    assert moved["bolt"][1:].tolist() == [0, 0]
    # what comes one by one stays beside what it is brought to
    assert moved["ball"] == pytest.approx(moved["lid"])
    # the unit was put apart before it came in
    assert moved["lid"][2] - moved["disk"][2] == pytest.approx(apart(stages(STEPS[:1], BOXES), BOXES)["lid"][2])


def test_what_stands_beside_the_way_does_not_lift() -> None:
    boxes = BOXES | {"pin": box((30, 30, 5), (34, 34, 40))}
    tall = [StepSpec(bring=["pin"], to="base", along=DOWN), StepSpec(bring=["disk"], to="base", along=DOWN)]
    low = apart(stages(tall, boxes), boxes)["disk"][2]
    # in its way it does
    boxes["pin"] = box((10, 10, 5), (14, 14, 40))
    assert apart(stages(tall, boxes), boxes)["disk"][2] > low + 20
