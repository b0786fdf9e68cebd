"""Cams that a stranger typed: a rest for a whole turn, rounding taken for impacts, unknown words, what cannot swing."""

from __future__ import annotations

import math
import re
import warnings
from pathlib import Path

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.command.new import new_scene
from geometry.cams.motion.follower_motion import follower_motion, return_, rise
from geometry.cams.plane.graphical import graphical_hindrance
from geometry.laws.named import NAMED_LAWS
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_toml
from parts.texts.findings import finding_text
from tests.exporters.making import read_report, run, write_scene
from tests.sampling import some_of

_CAM = """
[parts.gear]
kind = "cam"
follower = "roller"
lift = 20.0
follower_radius = 8.0
base_circle_radius = 30.0
"""


def _built(tmp_path: Path, text: str, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    """The command's answer to a scene, and all that it prints."""
    scene = tmp_path / "scene.toml"
    scene.write_text(text)
    code = main(["build", str(scene), "--out", str(tmp_path)])
    told = capsys.readouterr()
    return code, told.out + told.err


def test_all_dwell_has_a_sheet(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    phases = 'phases = [{ move = "dwell", angle_deg = 360.0 }]\n'
    exports = '[[exports]]\nformat = "sheet"\npurpose = "cam"\n[[exports]]\nformat = "svg"\n'
    code, told = _built(tmp_path, _CAM + phases + exports, capsys)
    assert code == 0, told
    # nothing accelerates: no jump of S'' is told
    assert "jumps" not in told
    assert "the follower never moves" in told


@pytest.mark.parametrize(
    ("key", "meant"), [("eccentricity = 3.0", "follower_offset"), ("table = [[0, 0]]", "motion_table")]
)
def test_a_word_of_other_books_leads_to_ours(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], key: str, meant: str
) -> None:
    """No letters tell it; and no key is told for a word that is merely a little alike."""
    code, told = _built(tmp_path, _CAM + key, capsys)
    assert (code, told.count(f"did you mean {meant}?")) == (2, 1), told
    code, told = _built(tmp_path, '[parts.g]\nkind = "spur_gear"\neccentricity = 1.0\n', capsys)
    assert (code, told.count("did you mean")) == (2, 0), told


def test_rounding_is_no_impact() -> None:
    sine = NAMED_LAWS["sine"]()
    assert not follower_motion([rise(math.pi, 20.0, sine), return_(math.pi, 20.0, sine)]).impacts()
    cosine = NAMED_LAWS["cosine"]()
    unequal = follower_motion([rise(2.0, 20.0, cosine), return_(2 * math.pi - 2.0, 20.0, cosine)])
    assert {j.impact for j in unequal.impacts()} == {"soft"}
    assert graphical_hindrance(unequal) is None


def _swept(law: str = '"sine"', move: str = "return_", more: str = "") -> str:
    first = f'{{ move = "rise", angle_deg = 180.0, law = {law} }}'
    return _CAM + f'phases = [{first}, {{ move = "{move}", angle_deg = 180.0, law = "sine"{more} }}]\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (_swept('"sinus"'), ("[1].law", '"cosine"', "did you mean sine?")),
        (_swept(move="retrun"), ("[2].move", '"dwell"', "did you mean return?")),
        (_swept(more=", lawn = 1"), ("[2].lawn", "move, angle_deg, law, share")),
        (_swept("{ diagramm = [] }"), ("law.diagramm", "did you mean diagram?", "diagram and 12 more")),
        (_swept('{ diagram = [{ shape = "sine", width = 1.0 }] }'), ("[1].shape", "did you mean half_sine?")),
        (_swept('{ diagram = [{ shape = "linear", peak = 1.0 }] }'), ("[1].peak", "shape, width, first, last")),
        (_swept("3"), ("[1].law = 3", "must be a table or text in quotes")),
        (_swept(f"{{ poles = {[float(x) for x in range(61)]} }}"), ("law.poles", "at most 60")),
        (_CAM + "least_transmission_angle_deg = 95.0\n", ("= 95.0", "above 0, below 90 degrees")),
    ],
)
def test_unknown_words_are_answered_with_the_known_ones(text: str, words: tuple[str, ...]) -> None:
    with pytest.raises(SceneError) as refusal:
        scene_from_toml(text.encode(), "scene", "scene")
    for word in words:
        assert word in str(refusal.value)
    assert "null" not in str(refusal.value)


def test_calc_names_the_kind_that_works(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["calc", "gear-pair", "number_of_teeth=20", "module=2.0", "second.kind=bevel_gear"]) != 0
    told = capsys.readouterr().err
    assert all(word in told for word in ("gear-pair.second.kind", "spur_gear", "ring_gear", "rack"))


@pytest.mark.parametrize(
    ("rows", "key", "value", "code"),
    [
        ([(1.0, 0.0), (2.0, 1.0), (3.0, 2.0)], "[1][1]", 1.0, "table_not_from_zero"),
        ([(0.0, 0.0), (20.0, 1.0), (10.0, 2.0)], "[3][1]", 10.0, "angles_do_not_rise"),
        ([(0.0, 0.0), (20.0, 1.0), (400.0, 2.0)], "[3][1]", 400.0, "table_beyond_turn"),
        ([(0.0, 0.0), (20.0, 1.0), (360.0, 0.0)], "[3][1]", 360.0, "table_too_short"),
        ([(0.0, 2.0), (120.0, 2.0), (240.0, 2.0)], "", 3, "table_without_lift"),
        ([(0.0, 0.0), (120.0, 10.0), (240.0, 6.0), (360.0, 3.0)], "[4][2]", 3.0, "last_row_not_as_first"),
        # before: of a barrel 1e20 mm were made, and 1e300 ended in a traceback
        ([(0.0, 0.0), (120.0, 1e20), (240.0, 6.0)], "[2][2]", 1e20, "not_allowed"),
        ([(0.0, 0.0), (1e300, 2.0), (240.0, 6.0)], "[2][1]", 1e300, "not_allowed"),
    ],
)
def test_tables_are_refused_in_degrees(rows: list[tuple[float, float]], key: str, value: float, code: str) -> None:
    text = _CAM.replace("lift = 20.0\n", "") + f"motion_table = {[list(row) for row in rows]}\n"
    with pytest.raises(SceneError) as refusal:
        make_parts(scene_from_toml(text.encode(), "scene", "scene"), "scene")
    assert refusal.value.key == f"parts.gear.motion_table{key}"
    assert (refusal.value.value, refusal.value.code) == (pytest.approx(value), code)
    # the first row stands at 0, the last one as the first; the others are cured only where the cam stays whole
    if code in ("table_not_from_zero", "last_row_not_as_first"):
        assert refusal.value.nearest is not None
        assert refusal.value.nearest.value == 0


def test_a_table_by_which_an_arm_swings_too_far_is_refused_itself() -> None:
    """Before: swing_deg = 0.0, which nobody had typed."""
    rows = [[0.0, 0.0], [120.0, 181.0], [240.0, 6.0]]
    arm = "oscillating = { centre_distance = 90.0, arm_length = 70.0 }\n"
    text = _CAM.replace("lift = 20.0\n", "") + f"motion_table = {rows}\n{arm}"
    with pytest.raises(SceneError) as refusal:
        make_parts(scene_from_toml(text.encode(), "scene", "scene"), "scene")
    assert (refusal.value.key, refusal.value.code) == ("parts.gear.motion_table", "swings_beyond_centres")


def test_holes_at_one_place_are_refused_without_warnings(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    hole = "{ at = [0.0, 20.0], diameter = 3.0 }"
    plate = f'[parts.a]\nkind = "plate"\nwidth = 60.0\nheight = 90.0\nholes = [{hole}, {hole}]\n'
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        code, told = _built(tmp_path, plate, capsys)
    assert code != 0
    assert "another hole" in told


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ["cam", "groove_cam", "barrel_cam", "wedge_cam"])
def test_every_law_that_new_shows_makes_a_cam(kind: str) -> None:
    text = new_scene(kind)
    shown = re.findall(r"^# (phases = .*?)  # \.\.\. or this", text, re.MULTILINE)
    assert len({found for line in shown for found in re.findall(r"law = \{ (\w+)", line)}) == 6
    assert any('law = "join"' in line for line in shown)
    for line in some_of(shown, 2):
        used = re.sub(r"^phases = .*$", line.replace("\\", r"\\"), text, flags=re.MULTILINE)
        parts, _ = make_parts(scene_from_toml(used.encode(), "scene", "scene"), "scene")
        assert line in used
        assert parts[kind].quantities


def test_every_bore_that_new_shows_fits_a_roller() -> None:
    text = new_scene("roller").split("[[exports]]")[0]
    shown = re.findall(r"^# ((?:bore|hub) = .*?\})  ?#", text.replace("} #", "}  #"), re.MULTILINE)
    assert len(shown) == 9
    for line in shown:
        used = text + line + '\n[[exports]]\nformat = "svg"\n'
        make_parts(scene_from_toml(used.encode(), "scene", "scene"), "scene")
    assert "diameter = 16.0" in text


_FLAT = """
[parts.gear]
kind = "cam"
follower = "flat"
swing_deg = 30.0
base_circle_radius = 80.0
oscillating = { centre_distance = 90.0 }
phases = [{ move = "rise", angle_deg = 180.0, law = "sine" }, { move = "return_", angle_deg = 180.0, law = "sine" }]
[[exports]]
format = "svg"
"""


def test_a_flat_face_beyond_the_square_is_refused_and_both_offers_work() -> None:
    with pytest.raises(SceneError) as refusal:
        make_parts(scene_from_toml(_FLAT.encode(), "scene", "scene"), "scene")
    (degrees,) = re.findall(r"at most ([\d.]+)", str(refusal.value))
    for old, new in (("30.0", degrees),):
        parts, _ = make_parts(scene_from_toml(_FLAT.replace(old, new).encode(), "scene", "scene"), "scene")
        # the push of a flat face runs along its normal while its arm keeps its sign
        assert parts["gear"].quantities["pressure_angle_rise_deg"] < 90


def test_a_radius_of_curvature_that_is_not_kept_is_told() -> None:
    text = _swept() + 'least_curvature_radius = 35.0\n[[exports]]\nformat = "svg"\n'
    for base, told in (("30.0", True), ("90.0", False)):
        scene = scene_from_toml(text.replace("radius = 30.0", f"radius = {base}").encode(), "scene", "scene")
        parts, _ = make_parts(scene, "scene")
        found = [f for f in parts["gear"].findings if f.code == "curvature_radius_not_kept"]
        assert bool(found) == told
        assert (parts["gear"].quantities["least_curvature_radius"] < 35) == told
        for language in ("uk", "en"):
            assert all("35" in finding_text(language, f) for f in found)


def test_an_undercut_by_impacts_is_offered_what_works() -> None:
    text = _swept('"constant_velocity"') + '[[exports]]\nformat = "svg"\n'
    with pytest.raises(SceneError) as refusal:
        make_parts(scene_from_toml(text.encode(), "scene", "scene"), "scene")
    assert '.law = "constant_velocity"' in str(refusal.value)
    assert '"sine" works' in str(refusal.value)
    make_parts(scene_from_toml(text.replace("constant_velocity", "sine").encode(), "scene", "scene"), "scene")


@pytest.mark.sampled(1)
@pytest.mark.parametrize("arm", ["73.0", "75.0"])
def test_a_wedges_arm_near_the_upright_is_refused_at_once(arm: str) -> None:
    text = (
        '[parts.g]\nkind = "wedge_cam"\nfollower = "roller"\nbase_height = 15.0\nswing_deg = 30.0\n'
        f"follower_radius = 6.0\noscillating = {{ arm_length = {arm}, pivot_height = -50.0 }}\n"
        'phases = [{ move = "rise", travel = 60.0, law = "sine" }, { move = "dwell", travel = 20.0 }]\n'
        '[[exports]]\nformat = "svg"\n'
    )
    with pytest.raises(SceneError, match="beyond the upright") as refusal:
        make_parts(scene_from_toml(text.encode(), "scene", "scene"), "scene")
    degrees = re.findall(r"at most ([\d.]+) degrees", str(refusal.value))[0]
    scene = scene_from_toml(text.replace("swing_deg = 30.0", f"swing_deg = {degrees}").encode(), "scene", "scene")
    parts, _ = make_parts(scene, "scene")
    assert parts["g"].thing.motion


def test_a_flat_arm_of_defaults_builds_and_fits_a_cam_of_defaults() -> None:
    arm = '[parts.arm]\nkind = "follower_arm"\nend = "flat"\narm_length = 120.0\n'
    cam = _FLAT.replace("swing_deg = 30.0", "swing_deg = 10.0").replace("radius = 80.0", "radius = 40.0")
    mate = '[[mates]]\nkind = "cam_follower"\nfirst = "gear"\nsecond = "arm"\n'
    _, matings = make_parts(scene_from_toml((arm + cam + mate).encode(), "scene", "scene"), "scene")
    assert len(matings) == 1


@pytest.mark.sampled(1)
@pytest.mark.parametrize("face", [-6.0, -3.0, 0.0, 4.0, 8.0, 10.0, 12.0, 17.0])
@pytest.mark.parametrize("sense", ["with", "against"])
def test_a_flat_arms_outline_is_its_bar_and_its_boss(face: float, sense: str) -> None:
    """Against the union of a rectangle and a disc by shapely."""
    from shapely import Point, Polygon, box

    keys = f'end = "flat"\narm_length = 60.0\nsense = "{sense}"\nface_offset = {face}\nboss_diameter = 16.0\n'
    text = f'[parts.arm]\nkind = "follower_arm"\n{keys}width = 10.0\npivot_diameter = 0.0\n'
    parts, _ = make_parts(scene_from_toml(text.encode(), "scene", "scene"), "scene")
    outer = parts["arm"].section(0.0).region.outer
    sampled = [z for s in outer.segments() for z in s.curve.point(np.linspace(*s.curve.domain, 2000))[:-1]]
    near, far = (face, face - 10.0) if sense == "against" else (-face, 10.0 - face)
    bar = box(0.0, min(near, far), 60.0, max(near, far))
    boss = Point(0, 0).buffer(8.0, quad_segs=4000)
    made = Polygon([(z.real, z.imag) for z in sampled])
    assert made.is_valid
    assert boss.union(bar).difference(made).area < 2e-3
    # where the boss does not stand out, the bar ends square behind it
    square = box(-8.0, min(near, far, 0.0), 0.0, max(near, far, 0.0))
    assert made.difference(boss.union(bar).union(square)).area < 2e-3


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("base", "kept"), [(2.0, False), (40.0, True)])
def test_a_transmission_angle_that_a_given_base_does_not_keep_is_told(tmp_path: Path, base: float, kept: bool) -> None:
    """By tan nu = S'/(S + s_0) of a sine law, densely."""
    lift, rise = 20.0, np.pi / 2
    moves = [("rise", 90.0, "sine"), ("dwell", 60.0, None), ("return_", 150.0, "sine"), ("dwell", 60.0, None)]
    phases = [{"move": m, "angle_deg": a} | ({"law": law} if law else {}) for m, a, law in moves]
    cam = {"kind": "cam", "follower": "roller", "follower_radius": 5.0, "lift": lift, "base_circle_radius": base,
           "least_transmission_angle_deg": 60.0, "bore_diameter": 1.0, "phases": phases}  # fmt: skip
    scene = write_scene(tmp_path / "s.toml", {"c": cam}, [{"format": "svg"}])
    assert run("build", scene, "--out", tmp_path, "--no-verify") == 0
    told = [f for f in read_report(tmp_path / "s")["parts"]["c"]["findings"] if f["code"].startswith("transmission")]
    z = np.linspace(0, 1, 200_001)
    way = lift * (z - np.sin(2 * np.pi * z) / (2 * np.pi))
    slope = lift * (1 - np.cos(2 * np.pi * z)) / rise
    least = 90 - np.degrees(np.arctan(slope / (base + 5.0 + way))).max()
    assert kept is bool(least >= 60)
    assert [f["value"] for f in told] == ([] if kept else [pytest.approx(least, abs=1e-6)])
