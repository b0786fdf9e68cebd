"""Laws of one's own against closed forms, through the scene's keys; the timing mark of a cam."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest

from geometry.plane.measure import distance_to_profile
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import GROOVE, PHASES, ROLLER, SWING, Keys, parts_of

U = np.linspace(0, 1, 101)
FLAT = {"shape": "constant", "width": 1.0, "ordinate": 3.0}
SHAPE = {"shape": "half_sine", "width": 1.0, "peak": 1.0}


def with_law(law: Any) -> Keys:
    """The cam whose rise of 120 degrees, 20 mm has a law."""
    return ROLLER | {"phases": [PHASES[0] | {"law": law}, *PHASES[1:]]}


def rise_of(law: Any) -> np.ndarray:
    """s(u) of the rise."""
    cam = parts_of({"cam": with_law(law)})["cam"].thing
    assert cam is not None
    return np.asarray(cam.motion.value(U * math.radians(120)) / 20)


def closed_345(u: np.ndarray) -> np.ndarray:
    return 10 * u**3 - 15 * u**4 + 6 * u**5


ENDS = [[0.0, 0, 0.0], [0.0, 1, 0.0], [0.0, 2, 0.0], [1.0, 0, 1.0], [1.0, 1, 0.0], [1.0, 2, 0.0]]
# what a law's keys give, in closed form
LAWS: dict[str, tuple[Any, Any]] = {
    "conditions": ({"conditions": ENDS}, closed_345),
    "inner condition": ({"conditions": [*ENDS[:2], [0.5, 0, 0.55], *ENDS[3:5]]},
                        lambda u: u**2 * (3 - 2 * u) + 0.8 * u**2 * (1 - u) ** 2),
    "Bernstein": ({"poles": [0.0, 0.0, 0.0, 20.0, 20.0, 20.0]}, closed_345),
    "cubic with a knot": ({"poles": [0.0, 0.0, 0.5, 1.0, 1.0], "degree": 3, "knots": [0.5]},
                          lambda u: np.where(u < 0.5, 2 * u**2 * (3 - 2 * u) / 2, 1 - (1 - u) ** 2 * (1 + 2 * u))),
    "halves": ({"first_half": [FLAT], "second_half": [FLAT], "first_share": 0.3},
               lambda u: np.where(u < 0.3, u**2 / 0.3, 1 - (1 - u) ** 2 / 0.7)),
    "reversed halves": ({"first_half": [FLAT], "second_half": [FLAT], "first_share": 0.3, "reverse": True},
                        lambda u: np.where(u < 0.7, u**2 / 0.7, 1 - (1 - u) ** 2 / 0.3)),
    "no ramps": ({"name": "trapezoid", "ramp": 0.0}, lambda u: np.where(u < 0.5, 2 * u**2, 1 - 2 * (1 - u) ** 2)),
    "name": ({"name": "cosine"}, lambda u: (1 - np.cos(np.pi * u)) / 2),
    "sine halves": ({"first_half": [SHAPE], "second_half": [SHAPE]}, lambda u: u - np.sin(2 * np.pi * u) / (2 * np.pi)),
}  # fmt: skip


@pytest.mark.parametrize("name", LAWS)
def test_laws_of_ones_own(name: str) -> None:
    law, exact = LAWS[name]
    assert np.abs(rise_of(law) - exact(U)).max() < 1e-12


WRONG: dict[str, tuple[Any, str, str]] = {
    "empty": ({}, "law", "empty_law"),
    "two kinds": ({"poles": [0.0, 0.0, 1.0, 1.0], "name": "sine"}, "law", "several_laws"),
    "key of another": ({"name": "sine", "degree": 4}, "law.degree", "key_of_another_law"),
    "one half": ({"first_half": [FLAT]}, "law.second_half", "second_half_missing"),
    "ramp of a sine": ({"name": "sine", "ramp": 0.1}, "law.ramp", "law_without_ramps"),
    "wide ramp": ({"name": "trapezoid", "ramp": 0.3}, "law.ramp", "not_within"),
    "narrow stretch": ({"first_half": [{"shape": "trapezoid", "width": 1.0, "ordinate": 1.0, "up": 1e-10}],
                        "second_half": [FLAT]}, "law.first_half", "narrow_stretch"),
    "few poles": ({"poles": [0.0, 0.0, 1.0, 1.0]}, "law.poles", "too_few_poles"),
    "huge pole": ({"poles": [0.0, 0.0, 1e308, 1.0, 1.0]}, "law.poles[3]", "not_allowed"),
    "huge condition": ({"conditions": [*ENDS[:2], [0.5, 0, -1e308]]}, "law.conditions[3][3]", "not_allowed"),
    "no start": ({"conditions": [[0.5, 0, 0.5], [1.0, 0, 1.0]]}, "law.conditions", "conditions_without_ends"),
    "order left out": ({"conditions": [*ENDS[:1], ENDS[2], ENDS[3]]}, "law.conditions", "orders_with_gap"),
    "knots": ({"poles": [0.0, 0.0, 0.5, 1.0, 1.0], "degree": 3, "knots": [1.5]}, "law.knots", "knots_do_not_rise"),
}  # fmt: skip
CURED = {"key of another", "ramp of a sine", "wide ramp", "knots"}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_law_is_refused_in_its_place(name: str) -> None:
    law, blamed, code = WRONG[name]
    refusal = refused({"cam": with_law(law)})
    assert (refusal.key, refusal.code) == (f"parts.cam.phases[1].{blamed}", code)
    assert (refusal.nearest is not None) == (name in CURED)
    if name in CURED:
        cured({"cam": with_law(law)}, refusal)


CAMS: dict[str, Keys] = {
    "offset roller": ROLLER | {"follower_offset": 6.0},
    "flat": ROLLER | {"follower": "flat", "follower_radius": 0.0, "base_circle_radius": 42.0},
    "swinging": ROLLER | {"lift": 0.0, "swing_deg": 18.0, "oscillating": SWING},
    "groove": GROOVE,
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CAMS)
def test_the_mark_points_to_the_follower_at_cam_angle_0(name: str) -> None:
    made = parts_of({"cam": CAMS[name] | {"timing_mark": {"diameter": 3.0, "distance": 22.0}}})["cam"]
    holes = made.section(0.0).region.holes
    mark = min(holes, key=lambda p: float(distance_to_profile(np.array([0j]), p)[0]) * -1)
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 9)) for s in mark.segments()])
    middle = complex((points.max() + points.min()) / 2)
    cam = made.thing.cam if name == "groove" else made.thing
    towards = complex(cam.reference_point(0.0))
    assert abs(middle - 22 * towards / abs(towards)) < 1e-9
    direction = {"flat": 90.0, "offset roller": math.degrees(math.acos(6 / 43)),
                 "groove": math.degrees(math.acos(5 / 43))}  # fmt: skip
    if name in direction:
        assert math.degrees(cmath.phase(middle)) == pytest.approx(direction[name], abs=1e-9)
    assert made.to_trimesh(0.05).is_watertight


@pytest.mark.parametrize(("mark", "key"), [
    ({"diameter": 3.0, "distance": 6.5}, "distance"),
    ({"diameter": 3.0, "distance": 34.0}, "distance"),
    ({"diameter": 40.0}, "diameter"),
    ({"diameter": 40.0, "distance": 20.0}, "diameter"),
])  # fmt: skip
def test_a_mark_without_room_is_told_what_works(mark: Keys, key: str) -> None:
    parts = {"cam": ROLLER | {"timing_mark": mark}}
    refusal = refused(parts)
    assert refusal.key == f"parts.cam.timing_mark.{key}"
    cured(parts, refusal)
