"""Conjugate cams: both rollers touch at once, files rolled in the frame of the shaft, a turned file, refusals."""

from __future__ import annotations

import cmath
import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from exporters.production.recheck import recheck
from geometry.plane.measure import distance_to_profile
from parts.base.part import Part
from parts.texts.quantities import QUANTITIES
from tests.exporters.making import read_report, run
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import PHASES, ROLLER, SWING, Keys, parts_of, scene, without

FIRST: dict[str, Keys] = {
    "translating": ROLLER | {"follower_offset": 5.0},
    "against": ROLLER | {"lift": 0.0, "swing_deg": 18.0, "oscillating": SWING},
    "with": ROLLER | {"lift": 0.0, "swing_deg": 18.0, "oscillating": SWING | {"sense": "with"}},
}
SECOND: Keys = {"kind": "conjugate_cam", "of": "cam", "follower_radius": 9.0}


def pair(name: str, **second: object) -> tuple[Part, Part]:
    made = parts_of({"cam": FIRST[name], "two": SECOND | second})
    return made["cam"], made["two"]


def second_centres(first: Part, two: Part, angle: np.ndarray) -> np.ndarray:
    """The second roller's centres on the follower that the first one's law moves; the second cam is not asked."""
    assert first.thing is not None
    centre = first.thing.reference_point(angle)
    if "roller_distance" in two.quantities:
        return np.asarray(centre - 1j * two.quantities["roller_distance"])
    mount = first.thing.mount
    turn = cmath.exp(-1j * mount.sense * math.radians(two.quantities["roller_angle_deg"]))
    pivot = mount.centre_distance
    return np.asarray(pivot + (centre - pivot) * turn)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", FIRST)
def test_both_rollers_touch_at_every_angle(name: str) -> None:
    """Breadth over a full turn: neither lifts off nor cuts in by 1e-9 mm, on the section as it sits on the shaft."""
    first, two = pair(name)
    angle = np.linspace(0, 2 * math.pi, 361)
    gap = distance_to_profile(second_centres(first, two, angle) * np.exp(-1j * angle), two.section(0.0).region.outer)
    assert np.abs(gap - 9.0).max() < 1e-9
    assert first.thing is not None
    other = first.thing.reference_point(angle) * np.exp(-1j * angle)
    assert np.abs(distance_to_profile(other, first.section(0.0).region.outer) - 8.0).max() < 1e-9
    if name != "translating":
        # the nearest that the second arm comes to the line of centres
        pivot, arm = SWING["centre_distance"], SWING["arm_length"]
        nearest = np.abs(np.angle((second_centres(first, two, angle) - pivot) / -arm)).min()
        assert two.quantities["lowest_angle_deg"] == pytest.approx(math.degrees(nearest), rel=1e-9)
        assert "lowest" in QUANTITIES["lowest_angle_deg"]
    # a second cam turned on the shaft by a hundredth of a degree does not
    turned = second_centres(first, two, angle) * np.exp(-1j * (angle + math.radians(0.01)))
    assert np.abs(distance_to_profile(turned, two.section(0.0).region.outer) - 9.0).max() > 1e-3


@pytest.mark.parametrize(
    "name",
    ["translating", pytest.param("against", marks=pytest.mark.heavy), pytest.param("with", marks=pytest.mark.heavy)],
)
def test_files_are_rolled_as_they_sit_on_the_shaft(name: str, tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    drawing = 'format = "dxf"\npurpose = "drawing"'
    file.write_text(scene({"cam": FIRST[name], "two": SECOND}, "dxf", "stl", drawing), encoding="utf-8")
    assert run("build", file, "--out", tmp_path / "o") == 0
    folder = tmp_path / "o" / "s"
    key = "lift_error" if name == "translating" else "swing_error_deg"
    for entry in read_report(folder)["files"]:
        assert 0 < entry["measured"][key] < 3 * entry["tolerance"]
    path = folder / "two.laser.dxf"
    assert not recheck(path).verdict.failures
    drawing_file = ezdxf.readfile(path)
    outline = next(e for e in drawing_file.modelspace() if e.dxf.layer == "CUT_OUTER")
    outline.transform(ezdxf.math.Matrix44.z_rotate(0.002))
    drawing_file.saveas(path)
    assert recheck(path).verdict.failures
    part = pair(name)[1]
    from exporters.formats.read_dxf import read_dxf
    from exporters.verification.judge import probed
    from exporters.verification.verdict import Verdict

    verdict = probed(read_dxf(path), part, 0.0, 0.005, Verdict({}, ()))
    assert any("lift is wrong" in f for f in verdict.failures)


def test_one_shaft_goes_through_both() -> None:
    bore = {"shape": "keyway", "diameter": 14.0}
    parts = {"cam": without(FIRST["against"], "bore_diameter") | {"bore": bore}, "two": SECOND}
    made = parts_of(parts)
    one, two = (made[p].section(0.0).region.holes[0] for p in ("cam", "two"))
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 9)) for s in one.segments()])
    assert distance_to_profile(points, two).max() < 1e-12
    # by default the second cam is as large as the first
    assert made["two"].circles["base_circle_diameter"] == pytest.approx(70.0, abs=1e-9)


@pytest.mark.parametrize(("name", "key"), [("translating", "roller_distance"), ("with", "roller_angle_deg")])
def test_the_distance_of_the_rollers_or_the_base_circle(name: str, key: str) -> None:
    plain = pair(name, base_circle_radius=33.0)[1]
    again = pair(name, **{key: plain.quantities[key]})[1]
    assert again.circles["base_circle_diameter"] == pytest.approx(66.0, abs=1e-9)


# the first cam, keys of the second, the key that is blamed, why
WRONG: dict[str, tuple[str, Keys, str, str]] = {
    "near rollers": ("translating", {"roller_distance": 60.0}, "roller_distance", "rollers_on_one_side"),
    "narrow arms": ("against", {"roller_angle_deg": 20.0}, "roller_angle_deg", "rollers_on_one_side"),
    "angle of a stem": ("translating", {"roller_angle_deg": 20.0}, "roller_angle_deg", "rollers_stand_by_distance"),
    "arm of a stem": ("translating", {"arm_length": 20.0}, "arm_length", "stem_has_no_arm"),
    "both": ("translating", {"roller_distance": 150.0, "base_circle_radius": 30.0},
             "base_circle_radius", "follows_from"),
    "short arm": ("against", {"arm_length": 20.0}, "arm_length", "arm_does_not_reach"),
    "unknown": ("against", {"of": "cma"}, "of", "no_such_part"),
    "itself": ("against", {"of": "two"}, "of", "of_another_kind"),
    "wide bore": ("against", {"bore_diameter": 90.0}, "bore_diameter", "no_wall_to_base_circle"),
}  # fmt: skip


# not every one is cured by one key
NOT_CURED = {"short arm"}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_keys_are_refused_in_the_users_terms(name: str) -> None:
    first, keys, blamed, code = WRONG[name]
    parts = {"cam": FIRST[first], "two": SECOND | keys}
    refusal = refused(parts)
    assert (refusal.key, refusal.code) == (f"parts.two.{blamed}", code)
    if name not in NOT_CURED:
        cured(parts, refusal)


def test_a_flat_first_cam_and_an_undercut_second_one_are_refused() -> None:
    flat = without(ROLLER, "follower_radius") | {"follower": "flat", "base_circle_radius": 42.0}
    assert refused({"cam": flat, "two": SECOND}).code == "pair_without_roller"
    steep = [
        PHASES[0] | {"angle_deg": 60.0},
        PHASES[1],
        PHASES[2] | {"angle_deg": 60.0},
        PHASES[3] | {"angle_deg": 200},
    ]
    keys = {"cam": ROLLER | {"phases": steep}, "two": SECOND | {"base_circle_radius": 14.0, "follower_radius": 30.0}}
    refusal = refused(keys)
    assert (refusal.key, refusal.code) == ("parts.two.base_circle_radius", "undercut_second")
    cured(keys, refusal)
