"""The part kind ``noncircular_gear`` and its mate: keys, refusals that name what works, placing, files."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import mpmath
import numpy as np
import pytest

from exporters.command.cli import main
from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines, has_bad_verdict
from parts.scene.load import SceneError, load_scene, make_parts, scene_from_toml
from parts.scene.placing import Placing, place
from tests.sampling import some_of

PART = """
[parts.one]
kind = "noncircular_gear"
{one}
face_width = 4.0
bore_diameter = 5.0
"""
OVAL = 'centrode = "oval"\naxis_ratio = 1.4\nmodule = 2.0\nnumber_of_teeth = 18'


def made(one: str, extra: str = "") -> tuple[dict, list]:
    # without a bore: nothing else is refused
    scene = scene_from_toml((PART.format(one=one).replace("bore_diameter = 5.0", "") + extra).encode(), "t", "t")
    return make_parts(scene, "t")


def mate(first: str, second: str, more: str = "") -> str:
    return f'\n[[mates]]\nkind = "noncircular_gear_pair"\nfirst = "{first}"\nsecond = "{second}"\n{more}\n'


def two(one: str, other: str, more: str = "") -> str:
    second = PART.format(one=other).replace("[parts.one]", "[parts.two]")
    return PART.format(one=one) + second + mate("one", "two", more)


def placed(text: str) -> tuple[Placing, dict]:
    scene = scene_from_toml(text.encode(), "t", "t")
    parts, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, parts, matings, "t")
    return placing, scene_checks(placing, parts, scene.drives, "uk", contact=scene.checks.interference)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("keys", "key", "pattern"), [
    ('centrode = "oval"\naxis_ratio = 2.5\nmodule = 2.0\nnumber_of_teeth = 50', "axis_ratio",
     r"at most ([\d.]+) works"),
    ('centrode = "oval"\nlobes = 3\neccentricity = 0.2\nmodule = 2.0\nnumber_of_teeth = 50', "eccentricity",
     r"at most ([\d.]+) works"),
    ('centrode = "focal_ellipse"\neccentricity = 0.8\nmodule = 2.0\nnumber_of_teeth = 7', "number_of_teeth",
     r"; at least (\d+) works"),
    ('centrode = "oval"\naxis_ratio = 1.4\nmodule = 2.0\nnumber_of_teeth = 18\ncircumferential_thinning = 2.5',
     "circumferential_thinning", r"at most ([\d.]+) mm works"),
    ('centrode = "oval"\naxis_ratio = 1.4\nmodule = 2.0\nnumber_of_teeth = 18\nmate_number_of_teeth = 20',
     "mate_number_of_teeth", r"; (\d+) works"),
])  # fmt: skip
def test_refusals_name_a_value_that_works(keys: str, key: str, pattern: str) -> None:
    with pytest.raises(SceneError) as refusal:
        made(keys)
    assert f"parts.one.{key}" in str(refusal.value)
    found = re.search(pattern, str(refusal.value))
    assert found, str(refusal.value)
    made(re.sub(rf"(?m)^{key} = .*", f"{key} = {found[1]}", keys))


def test_a_mate_of_a_convex_driver_that_is_hollow_is_told_the_greatest_eccentricity() -> None:
    """Three lobes in four: r^2 + 2 r'^2 - r r'' >= 0 of the mate's polar radius; no value was offered."""
    from scipy.optimize import brentq

    keys = 'centrode = "oval"\nlobes = 3\neccentricity = {}\nmodule = 2.0\nrole = "mate"\nnumber_of_teeth = 44\n'
    keys += "mate_number_of_teeth = 33"
    with pytest.raises(SceneError, match=r"eccentricity = 0.1.*at most ([\d.]+) works") as refused:
        made(keys.format(0.1))
    works = refused.value.nearest.value

    def least(e: float) -> float:
        """The least of it over the driver's lobe; a from the mate's whole turn, by means over a smooth period."""
        angle = np.linspace(0, 2 * math.pi / 3, 4001)
        radius = 1 / (1 - e * np.cos(3 * angle))
        slope, bend = -3 * e * np.sin(3 * angle) * radius**2, -9 * e * np.cos(3 * angle) * radius**2
        bend = bend + 2 * slope**2 / radius

        def turned(a: float) -> float:
            return float(np.mean((radius / (a - radius))[:-1]) - 0.75)

        a = brentq(turned, radius.max() * 1.01, 10)
        # the mate's polar radius a - r over its own angle, d phi_2 = r / (a - r) d phi_1
        own, rate = a - radius, radius / (a - radius)
        first = -slope / rate
        second = (-bend / rate + slope * (slope * a / own**2) / rate**2) / rate
        return float((own**2 + 2 * first**2 - own * second).min())

    assert least(works) > -1e-9
    assert least(works * 1.001) < 0


def test_a_concave_ratio_names_a_share_that_works() -> None:
    keys = 'centrode = "ratio"\nlobes = 2\nratio_cosines = [{}]\nmodule = 2.0\nnumber_of_teeth = 40'
    for amplitude in (1.5,):
        with pytest.raises(SceneError, match="ratio_cosines") as refusal:
            made(keys.format(amplitude))
        told = re.search(r"; \[([\d.]+)\] works", str(refusal.value))
        assert told, str(refusal.value)
        assert 0 < float(told[1]) < amplitude
        made(keys.format(told[1]))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("keys", "key"), [
    (OVAL + "\ncentre_distance = 40.0", "module"),
    (OVAL.replace("module = 2.0", ""), "module"),
    (OVAL + "\neccentricity = 0.1", "axis_ratio"),
    (OVAL.replace("axis_ratio = 1.4", ""), "axis_ratio"),
    (OVAL + "\nratio_cosines = [0.1]", "ratio_cosines"),
    (OVAL + '\nbore = { shape = "round", diameter = 3.0 }\nbore_diameter = 4.0', "bore_diameter"),
    (OVAL.replace("oval", "ratio"), "axis_ratio"),
    (OVAL.replace('"oval"', '"focal_ellipse"') + "\nlobes = 2", "lobes"),
])  # fmt: skip
def test_keys_that_exclude_each_other(keys: str, key: str) -> None:
    with pytest.raises(SceneError, match=rf"parts\.one\.{key}"):
        made(keys)


def test_a_bore_that_reaches_the_roots_is_told() -> None:
    text = PART.format(one=OVAL).replace("bore_diameter = 5.0", "bore_diameter = 60.0")
    scene = scene_from_toml(text.encode(), "t", "t")
    with pytest.raises(SceneError, match=r"bore_diameter.*at most ([\d.]+) mm works") as refusal:
        make_parts(scene, "t")
    found = re.search(r"at most ([\d.]+) mm", str(refusal.value))
    assert found
    text = PART.format(one=OVAL).replace("bore_diameter = 5.0", f"bore_diameter = {found[1]}")
    make_parts(scene_from_toml(text.encode(), "t", "t"), "t")


def test_the_scene_to_start_from_builds(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "noncircular_gear"]) == 0
    text = capsys.readouterr().out
    scene = scene_from_toml(text.encode(), "t", "t")
    parts, _ = make_parts(scene, "t")
    assert parts["noncircular_gear"].quantities["module"] == pytest.approx(2.0)
    # every key is told
    assert all(
        f"{key} = " in text for key in ("ratio_cosines", "mate_number_of_teeth", "role", "lobes", "centre_distance")
    )


def test_size_by_centre_distance() -> None:
    parts, _ = made(OVAL.replace("module = 2.0", "centre_distance = 50.0"))
    quantities = parts["one"].quantities
    assert quantities["centre_distance_of_pair"] == 50.0
    assert quantities["pitch"] == pytest.approx(math.pi * quantities["module"])
    # r_max + r_min of two equal ovals
    assert quantities["least_centrode_radius"] + quantities["greatest_centrode_radius"] == pytest.approx(50.0)


def test_equal_ovals_with_teeth_that_do_not_fit_are_told_the_role() -> None:
    wrong = OVAL.replace("18", "20")
    with pytest.raises(SceneError, match=r'role = "driver".*"mate" works') as refusal:
        placed(two(wrong, wrong))
    # both remedies work
    number = re.search(r"with (\d+) teeth", str(refusal.value))
    assert number
    placed(two(wrong, wrong + '\nrole = "mate"'))
    right = OVAL.replace("18", number[1])
    placed(two(right, right))


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("other", "key"), [
    (OVAL.replace("1.4", "1.3"), "axis_ratio"),
    (OVAL.replace("module = 2.0", "module = 2.5"), "module"),
    (OVAL + "\npressure_angle_deg = 25.0", "pressure_angle_deg"),
    (OVAL + "\nprofile_shift_coefficient = 0.1", "profile_shift_coefficient"),
])  # fmt: skip
def test_gears_that_are_no_pair_are_told(other: str, key: str) -> None:
    with pytest.raises(SceneError, match=rf"parts\.two\.{key}"):
        placed(two(OVAL, other))


def test_one_shifted_part_does_not_mesh_with_itself() -> None:
    text = (
        PART.format(one=OVAL + "\nprofile_shift_coefficient = 0.2")
        + '\n[instances.one]\n[instances.again]\npart = "one"\n'
    )
    with pytest.raises(SceneError, match=r"profile_shift_coefficient = 0\.2.*; 0 modules works"):
        placed(text + mate("one", "again"))


def test_one_oval_twice_meshes_and_carries_the_drive() -> None:
    text = PART.format(one=OVAL) + '\n[instances.one]\nrotation_deg = 25.0\n[instances.again]\npart = "one"\n'
    text += mate("one", "again", "direction_deg = 90.0\nnormal_backlash = 0.1")
    text += '\n[[drives]]\ninstance = "one"\nturns = 2.0\n[checks]\ninterference = true\n'
    placing, checks = placed(text)
    found = checks["mates"][0]
    assert found["verdict"] == "clear"
    assert found["gap"] == pytest.approx(0.05, abs=1e-8)
    assert found["normal_backlash"] == pytest.approx(0.1)
    assert placing.instances[1].at[:2] == pytest.approx((0.0, found["centre_distance"]), abs=1e-9)
    assert placing.turns[0] == pytest.approx({"one": 2.0, "again": -2.0})
    assert not has_bad_verdict(checks)
    assert "міжосьова" not in check_lines(checks, "uk")[0]
    assert "передаточне відношення" in check_lines(checks, "uk")[0]


def test_a_pair_driven_by_either_gear_stands_alike() -> None:
    """18 teeth and 27: what the first turns the second by, turns the first back where the second is driven."""
    pair = two(
        OVAL + "\nmate_number_of_teeth = 27", OVAL.replace("18", "27") + '\nmate_number_of_teeth = 18\nrole = "mate"'
    )
    by_first, by_second = (
        placed(f'{pair}\n[[drives]]\ninstance = "{key}"\nturns = 1.0\n')[0] for key in ("one", "two")
    )

    def turned(placing: Placing, which: int, turns: float) -> float:
        off = placing.at([turns])[which].rotation - placing.instances[which].rotation
        return math.remainder(off / (2 * math.pi), 1.0)

    for turns in (0.05, 0.21, 0.4):
        second = turned(by_first, 1, turns)
        assert abs(second + turns * 18 / 27) > 1e-3
        assert turned(by_second, 0, second) == pytest.approx(turns, abs=1e-9)


def test_a_pair_placed_by_hand_is_checked() -> None:
    base = two(OVAL, OVAL)
    placing, _ = placed(base)
    second = placing.instances[1]
    x, turn = second.at[0], math.degrees(second.rotation)
    for off, shift, broken in ((0.0, 0.0, set()), (5.0, 0.0, {"phase"}), (0.0, 0.2, {"centre_distance"})):
        at = f"\n[instances.one]\nat = [0.0, 0.0, 0.0]\n[instances.two]\nat = [{x + shift:.9f}, 0.0, 0.0]\n"
        found, _ = placed(base + at + f"rotation_deg = {turn + off:.9f}\n")
        assert {c.code for c in found.mates[0].conditions if not c.met} == broken


def test_files_read_back(tmp_path: Path) -> None:
    """Laser, print and an offset outline, the lower face chamfered, all verified by the build itself."""
    keys = OVAL.replace("18", "10").replace("1.4", "1.15") + "\nface_chamfer = { below = 0.3 }\n"
    keys += "holes = { count = 3, diameter = 1.0, pitch_circle_diameter = 8.0 }"
    asked = dict(some_of((("dxf", "kerf = 0.2"), ("svg", ""), ("stl", "offset = -0.05"))))
    exports = "".join(f'\n[[exports]]\nformat = "{f}"\n{more}\n' for f, more in asked.items())
    scene = tmp_path / "small.toml"
    scene.write_text(PART.format(one=keys) + exports, encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    report = json.loads((tmp_path / "small" / "report.json").read_text(encoding="utf-8"))
    assert {f["format"] for f in report["files"]} == asked.keys()
    assert not report["failed"]
    assert all(f["verified"] and f["max_error"] <= f["tolerance"] for f in report["files"])


def test_the_scene_is_one_of_the_built_in_ones() -> None:
    scene = load_scene("oval_gears")
    assert {m.__struct_config__.tag for m in scene.mates} == {"noncircular_gear_pair"}
    parts, matings = make_parts(scene, "t")
    # 2 a of the ellipse, from its perimeter by the elliptic integral
    assert matings[1].distance == pytest.approx(25 * math.pi / float(mpmath.ellipe(0.25)), rel=1e-12)
    assert parts["oval"].findings == ()


@pytest.mark.heavy
def test_cad_files_read_back(tmp_path: Path) -> None:
    scene = tmp_path / "small.toml"
    exports = '\n[[exports]]\nformat = "dxf"\npurpose = "drawing"\n\n[[exports]]\nformat = "step"\n'
    scene.write_text(PART.format(one=OVAL) + exports, encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("key", "value"), [("axis_ratio", 20.0), ("axis_ratio", 7.0), ("eccentricity", 0.99999)])
def test_slender_ellipses_are_refused_with_one_that_works(key: str, value: float) -> None:
    text = f'centrode = "focal_ellipse"\nmodule = 2.0\nnumber_of_teeth = 30\n{key} = '
    with pytest.raises(SceneError, match=f"{key} = .*at most ([\\d.]+) works") as refused:
        made(text + str(value))
    made(text + re.search(r"at most ([\d.]+)", str(refused.value)).group(1))


def test_an_eccentricity_of_one_is_told_its_limit() -> None:
    with pytest.raises(SceneError, match=r"eccentricity = .*below 1"):
        made('centrode = "oval"\nmodule = 2.0\nnumber_of_teeth = 30\neccentricity = 1.0')


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("change", "key"), [
    (("axis_ratio = 1.4", "axis_ratio = 1.5"), "axis_ratio"), (("module = 2.0", "module = 2.5"), "module"),
    (("teeth = 18", "teeth = 22"), "number_of_teeth"),
])  # fmt: skip
def test_two_gears_of_unlike_pairs_are_told_the_key_and_its_value(change: tuple[str, str], key: str) -> None:
    other = OVAL.replace(*change) + '\nrole = "mate"'
    with pytest.raises(SceneError, match=rf"two\.{key} = ") as refused:
        placed(two(OVAL, other))
    works = refused.value.nearest.value
    placed(two(OVAL, re.sub(rf"\b{key} = \S+", f"{key} = {works}", other)))


def test_a_mate_that_is_offered_can_be_cut() -> None:
    keys = 'centrode = "{}"\n{}\nmodule = 2.0\nnumber_of_teeth = {}\nmate_number_of_teeth = {}'
    for shape, value, teeth, mate_teeth in some_of(
        (("oval", "axis_ratio = 1.9", 30, 20), ("oval", "axis_ratio = 1.8", 42, 26))
    ):
        text = keys.format(shape, value, teeth, mate_teeth)
        with pytest.raises(SceneError, match=r"mate_number_of_teeth = .*lobes; (\d+) works") as refused:
            made(text)
        works = int(re.search(r"; (\d+) works", str(refused.value)).group(1))
        made(keys.format(shape, value, teeth, works))
        made(keys.format(shape, value, works, teeth) + '\nrole = "mate"')
