"""Refusals of noncircular gears with what works, and their table, by the closed forms of ellipses and ovals."""

from __future__ import annotations

import math
from typing import Any

import pytest

from parts.gears.data_tables import data_table
from parts.scene.load import make_parts, scene_from_dict
from tests.offered import GONE
from tests.parts.limits import check_limit, check_refused, refused, scene_of, with_key

Keys = dict[str, Any]
OVAL: Keys = {"kind": "noncircular_gear", "centrode": "oval", "axis_ratio": 1.4, "module": 2.0,
              "number_of_teeth": 18, "face_width": 4.0}  # fmt: skip
ELLIPSE: Keys = OVAL | {"centrode": "focal_ellipse", "number_of_teeth": 30, "axis_ratio": 1.2}
RATIO: Keys = {"kind": "noncircular_gear", "centrode": "ratio", "ratio_cosines": [0.2], "module": 2.0,
               "number_of_teeth": 30, "face_width": 4.0}  # fmt: skip


def test_keys_that_do_not_go_together_are_told_what_does() -> None:
    check_refused(scene_of(ELLIPSE), "parts.p.lobes", 2, "one_lobe_about_focus", 1)
    bare = {k: v for k, v in OVAL.items() if k not in ("axis_ratio", "module")}
    by_e, by_distance = bare | {"eccentricity": 0.1, "module": 2.0}, bare | {"axis_ratio": 1.4, "centre_distance": 40.0}
    check_refused(scene_of(by_e), "parts.p.axis_ratio", 1.4, "either_key", None, one="axis_ratio", other="eccentricity")
    check_refused(scene_of(by_distance), "parts.p.module", 2.0, "either_key", None, other="centre_distance")
    check_refused(scene_of(OVAL), "parts.p.ratio_cosines", [0.1], "not_of_this_centrode", None, centrode="oval")
    check_refused(scene_of(OVAL), "parts.p.ratio_sines", [0.1], "not_of_this_centrode", None)
    for key in ("axis_ratio", "eccentricity"):
        check_refused(
            scene_of(RATIO), f"parts.p.{key}", 1.1 if key == "axis_ratio" else 0.1, "not_of_this_centrode", None
        )
    check_refused(scene_of(OVAL), "parts.p.module", GONE, "one_of_two_is_missing", ..., other="centre_distance")
    check_refused(scene_of(OVAL), "parts.p.axis_ratio", GONE, "one_of_two_is_missing", ..., other="eccentricity")
    both = OVAL | {"bore": {"shape": "round", "diameter": 5.0}}
    check_refused(scene_of(both), "parts.p.bore_diameter", 5.0, "either_key", 0.0)
    # an empty list is no amplitude, one lobe is what an ellipse has
    assert refused(scene_of(OVAL | {"ratio_cosines": []})) is None
    assert refused(scene_of(ELLIPSE | {"lobes": 1})) is None


def test_an_oval_of_n_lobes_is_convex_up_to_an_eccentricity_of_1_over_n_squared_less_1() -> None:
    """r = p / (1 - e cos n phi) has no curvature at phi = 180 degrees / n from e = 1 / (n^2 - 1) on."""
    for lobes, most in ((2, 1 / 3), (3, 1 / 8)):
        keys = OVAL | {"lobes": lobes, "number_of_teeth": 120}
        by_e = {k: v for k, v in keys.items() if k != "axis_ratio"}
        assert refused(scene_of(by_e | {"eccentricity": most * (1 - 1e-6)})) is None
        found = refused(scene_of(by_e | {"eccentricity": most * 1.01}))
        assert found is not None
        assert (found.key, found.code) == ("parts.p.eccentricity", "centrode_concave")
        assert found.nearest is not None
        assert found.nearest.side == "at_most"
        assert found.nearest.value == pytest.approx(most, abs=1e-6)
        assert found.nearest.value <= most
        check_limit(scene_of(keys), "parts.p.axis_ratio", "centrode_concave", (1 + most) / (1 - most), "at_most")


def test_a_ratio_stays_above_zero() -> None:
    found = refused(scene_of(RATIO | {"ratio_cosines": [1.2]}))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.ratio_cosines", "ratio_not_positive")
    found = refused(scene_of(RATIO | {"ratio_cosines": [0.9]}))
    assert found is not None
    assert (found.key, found.nearest is None) == ("parts.p.ratio_cosines", False)
    assert found.nearest is not None
    assert isinstance(found.nearest.value, list)
    (share,) = (x / 0.9 for x in found.nearest.value)
    assert 0 < share < 1
    assert refused(scene_of(RATIO | {"ratio_cosines": [0.9 * share]})) is None
    assert refused(scene_of(RATIO | {"ratio_cosines": [0.9 * (share + 0.002)]})) is not None
    # of two lists none is told
    found = refused(scene_of(RATIO | {"ratio_cosines": [0.6], "ratio_sines": [0.6]}))
    assert found is not None
    assert (found.key, found.nearest) == ("parts.p.ratio_cosines", None)
    found = refused(scene_of({k: v for k, v in RATIO.items() if k != "ratio_cosines"} | {"ratio_sines": [0.9]}))
    assert found is not None
    assert found.key == "parts.p.ratio_sines"


def test_a_mate_closes_on_whole_lobes_of_the_driver() -> None:
    """18 teeth of 2 lobes: a lobe has 9, its mate 9, 18, 27 ..; 7 does not close, nearest of those that can be cut."""
    found = refused(scene_of(OVAL | {"mate_number_of_teeth": 25}))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.mate_number_of_teeth", "mate_does_not_close")
    assert found.nearest is not None
    assert found.nearest.value == 27
    assert refused(scene_of(OVAL | {"mate_number_of_teeth": 27})) is None
    mate = OVAL | {"role": "mate", "mate_number_of_teeth": 18}
    found = refused(scene_of(mate | {"number_of_teeth": 35}))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.number_of_teeth", "mate_does_not_close")
    assert found.nearest is not None
    offered = found.nearest.value
    assert refused(scene_of(mate | {"number_of_teeth": offered})) is None
    # what is nearer cannot be cut
    assert isinstance(offered, int)
    nearer = [z for z in (9, 18, 27, 36, 45, 54) if abs(z - 35) < abs(offered - 35)]
    assert all(refused(scene_of(mate | {"number_of_teeth": z})) is not None for z in nearer)


def test_a_bore_leaves_a_rim_to_the_roots() -> None:
    """The least radius of an ellipse about its focus is a (1 - e), perimeter 4 a E(e) = pi m z; less 1.25 modules."""
    from scipy.special import ellipe

    e = math.sqrt(1 - 1 / 1.2**2)
    a = math.pi * 2 * 30 / (4 * ellipe(e * e))
    part = make_parts(scene_from_dict(scene_of(ELLIPSE), "s", "s"), "s")[0]["p"]
    report = part.made_by.report(part.keys, part.thing)
    told = report.quantities
    assert told["least_centrode_radius"] == pytest.approx(a * (1 - e), rel=1e-9)
    assert told["greatest_centrode_radius"] == pytest.approx(a * (1 + e), rel=1e-9)
    assert told["centrode_perimeter"] == pytest.approx(60 * math.pi, rel=1e-12)
    assert told["centre_distance_of_pair"] == pytest.approx(2 * a, rel=1e-9)
    # of an ellipse b^2 / a at the ends of its long axis
    assert told["least_curvature_radius_of_centrode"] == pytest.approx(a * (1 - e * e), rel=1e-7)
    assert told["pitch"] == pytest.approx(2 * math.pi, rel=1e-12)
    root = report.circles["inner_root_diameter"]
    assert root == pytest.approx(2 * (a * (1 - e) - 2.5), rel=1e-2)
    found = refused(scene_of(ELLIPSE | {"bore_diameter": root + 1}))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.bore_diameter", "leaves_no_rim")
    assert found.nearest is not None
    assert found.nearest.value == pytest.approx(root, rel=5e-6)
    assert refused(with_key(scene_of(ELLIPSE), "parts.p.bore_diameter", root * (1 - 1e-4))) is None


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("key", "given", "told", "works"),
    [
        ("a.ratio_cosines", [0.3], "b.ratio_cosines", [0.3]),
        ("b.ratio_cosines", [0.3], "b.ratio_cosines", [0.2]),
        ("b.ratio_cosines", [0.2, 0.0], "b.ratio_cosines", [0.2]),
        ("b.ratio_sines", [0.1], "b.ratio_sines", None),
        # no rack rolls on it, nor is there such a ratio: what its mate has is told
        ("a.ratio_cosines", [0.9], "a.ratio_cosines", [0.2]),
        ("b.ratio_cosines", [1.5], "b.ratio_cosines", [0.2]),
    ],
)
def test_a_ratio_is_that_of_the_mate(key: str, given: list[float], told: str, works: list[float] | None) -> None:
    """As it was: told by the centrode, which follows, and without what works."""
    raw = {"parts": {"a": RATIO, "b": RATIO | {"role": "mate"}},
           "mates": [{"kind": "noncircular_gear_pair", "first": "a", "second": "b"}], "exports": []}  # fmt: skip
    assert refused(raw) is None
    wrong = with_key(raw, f"parts.{key}", given)
    found = refused(wrong)
    assert found is not None
    assert (found.key, found.code) == (f"mates[1]: parts.{told}", "other_centrode_shape")
    assert found.nearest is not None
    assert found.nearest.value == works
    assert refused(with_key(wrong, found.key, works or GONE)) is None


@pytest.mark.sampled(1)
@pytest.mark.parametrize("role", ["driver", "mate"])
def test_the_table_of_a_gear_follows_its_own_angle(role: str) -> None:
    """About its focus an ellipse has r = p / (1 - e cos phi), its like r_2 = 2 a - r_1, with i = r_1 / r_2."""
    from scipy.special import ellipe

    keys = ELLIPSE | {"role": role}
    part = make_parts(scene_from_dict(scene_of(keys), "s", "s"), "s")[0]["p"]
    table = data_table(part, scene_from_dict(scene_of(keys), "s", "s"), [])
    drives = role == "driver"
    words = [str(row.value) for group in table.parts for row in group]
    assert ("driver" in words) == drives
    assert ("driven gear" in words) == (not drives)
    assert ("middle of a tooth" in words) == drives
    assert ("middle of a space" in words) == (not drives)
    e = math.sqrt(1 - 1 / 1.2**2)
    a = math.pi * 2 * 30 / (4 * ellipe(e * e))
    columns = table.positions
    assert columns is not None
    names = [head[0] for head in columns.heads]
    assert names == (["phi_1", "r_1", "i"] if drives else ["phi_2", "r_2", "i"])
    for angle, radius, ratio in columns.rows:
        own = a * (1 - e * e) / (1 - e * math.cos(math.radians(angle) + (0 if drives else math.pi)))
        assert radius == pytest.approx(own, rel=1e-6)
        assert ratio == pytest.approx(radius / (2 * a - radius) if drives else (2 * a - radius) / radius, rel=1e-6)
