"""Scenes with rings, racks and shaped gears: built, read back, refused with a value that works."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from exporters.command.cli import main
from exporters.production.report import read_report
from geometry.base.errors import OffsetError
from geometry.base.findings import Finding
from parts.base.refusal import SceneError
from parts.base.registry import KINDS
from parts.scene.load import make_parts, scene_from_toml
from parts.texts.findings import finding_text

RING = 'kind = "ring_gear"\nmodule = 2.0\nnumber_of_teeth = 48\n'
RACK = 'kind = "rack"\nmodule = 2.0\nnumber_of_teeth = 5\n'
SHAPED = 'kind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 20\ncutter = { number_of_teeth = 25 }\n'
EXPORTS = "".join(
    f'[[exports]]\nformat = "{name}"\n{more}'
    for name, more in (
        ("dxf", "kerf = 0.2\n"),
        ("dxf", 'purpose = "drawing"\n'),
        ("svg", "offset = -0.1\n"),
        ("stl", ""),
        ("3mf", ""),
    )
)


def made(text: str) -> dict[str, object]:
    """The parts of a scene with one part."""
    scene = scene_from_toml(f"[parts.p]\n{text}".encode(), "scene.toml", "scene")
    return make_parts(scene, "scene.toml")[0]["p"].quantities | {"circles": make_parts(scene, "")[0]["p"].circles}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("text", [
    RING + "cutter = { number_of_teeth = 25, full_round = true }\n", RING + "rounded_root = { full_round = true }\n",
    RING + "holes = { count = 4, diameter = 4.0, pitch_circle_diameter = 112.0 }\ntip_chamfer = 0.2\n", SHAPED,
    RACK + "tip_rounding = 0.3\nholes = { count = 2, diameter = 2.0 }\n",
])  # fmt: skip
def test_every_plane_format_and_mesh_is_built_and_read_back(text: str, tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    file.write_text(f"[parts.p]\n{text}{EXPORTS}", encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
    report = read_report(tmp_path / "s")
    assert report is not None
    assert not report["failed"]
    assert len(report["files"]) == 5
    for entry in report["files"]:
        assert entry["verified"]
        assert entry["measured"]["max_deviation"] <= entry["max_error"] * (1 + 1e-9)
        assert entry["bound"] in ("certified", "exact", "sampled")


@pytest.mark.sampled(1)
@pytest.mark.parametrize("text", [RING, RACK, SHAPED])
def test_step_is_built_and_read_back(text: str, tmp_path: Path) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    file = tmp_path / "s.toml"
    file.write_text(f'[parts.p]\n{text}[[exports]]\nformat = "step"\n', encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0


@pytest.mark.heavy
@pytest.mark.parametrize("kind", ["spur_gear", "ring_gear", "rack"])
def test_the_scene_to_start_from_builds(kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", kind]) == 0
    text = capsys.readouterr().out
    file = tmp_path / "mine.toml"
    file.write_text(text, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--format", "svg"]) == 0
    lines = text.splitlines()
    keys = [i for i, line in enumerate(lines) if re.match(r"# [a-z_]+ = \S", line)]
    for index in keys[: len(keys) if kind != "spur_gear" else 0]:
        alone = [line.removeprefix("# ") if i == index else line for i, line in enumerate(lines)]
        file.write_text("\n".join(alone), encoding="utf-8")
        assert main(["build", str(file), "--out", str(tmp_path), "--format", "svg", "--no-verify"]) == 0, lines[index]


REFUSED = {
    "cutter.number_of_teeth": RING + "cutter = { number_of_teeth = 45 }\n",
    "cutter.tip_rounding_coefficient": RING + "cutter = { number_of_teeth = 25, tip_rounding_coefficient = 0.9 }\n",
    "tip_diameter": RING + "tip_diameter = 80.0\n",
    "tip_chamfer": RING + "tip_chamfer = 3.0\n",
    "outer_diameter": RING + "outer_diameter = 100.0\n",
    "circumferential_thinning": RACK + "circumferential_thinning = 2.5\n",
    "holes.pitch_circle_diameter": RING + "holes = { count = 4, diameter = 4.0, pitch_circle_diameter = 104.0 }\n",
    "holes.diameter": RACK + "holes = { count = 1, diameter = 7.0 }\n",
    "holes.depth": RACK + "holes = { count = 1, diameter = 3.0, depth = 1.0 }\n",
    "holes.count": RACK + "holes = { count = 9, diameter = 2.0, spacing = 20.0 }\n",
    "holes.spacing": RACK + "holes = { count = 3, diameter = 2.0, spacing = 1.0 }\n",
    "tip_rounding": RACK + "tip_rounding = 2.0\n",
}


@pytest.mark.parametrize(("key", "text"), REFUSED.items(), ids=REFUSED.keys())
def test_refusals_name_a_value_that_works(key: str, text: str) -> None:
    with pytest.raises(SceneError) as refusal:
        made(text)
    error = refusal.value
    assert error.key == f"parts.p.{key}"
    assert error.nearest is not None
    name = key.rpartition(".")[2]
    head, _, tail = text.rpartition(f"{name} = ")
    mended = f"{head}{name} = {error.nearest.value}" + re.sub(r"^[\d.]+", "", tail) if tail else text
    assert mended != text
    made(mended)


@pytest.mark.parametrize("text", [
    RING + "tip_chamfer = 0.2\ntip_rounding = 0.2\n", RACK + "tip_chamfer = 0.2\ntip_rounding = 0.2\n",
    RING + "cutter = { number_of_teeth = 25 }\nrounded_root = { full_round = true }\n",
])  # fmt: skip
def test_keys_that_exclude_each_other(text: str) -> None:
    with pytest.raises(SceneError, match="give either"):
        made(text)


def test_the_rim_follows_the_root_where_nobody_asks() -> None:
    scene = scene_from_toml(f"[parts.p]\n{RING}".encode(), "scene.toml", "scene")
    part = make_parts(scene, "scene.toml")[0]["p"]
    assert part.section(0.0).region.outer.reach() == pytest.approx(part.circles["root_diameter"] / 2 + 5.0)


@pytest.mark.parametrize("text", [
    RING + "outer_diameter = 130.0\nholes = { count = 4, diameter = 4.0, pitch_circle_diameter = 112.0 }\n",
    RACK + "holes = { count = 2, diameter = 2.0 }\n",
])  # fmt: skip
def test_offsets_that_use_up_a_wall_or_close_the_holes_are_refused(text: str) -> None:
    scene = scene_from_toml(f"[parts.p]\n{text}".encode(), "scene.toml", "scene")
    section = make_parts(scene, "scene.toml")[0]["p"].section
    holes = section(0.0).region.holes
    small = [h for h in holes if h.count == 1]
    for offset, word in ((-2.9, "leaves_no|no_wall"), (2.1, "closes_")):
        with pytest.raises(OffsetError, match=word) as refusal:
            section(offset)
        assert len(section(refusal.value.nearest_offset * (1 - 1e-6)).region.holes) == len(holes)
    moved = [h for h in section(0.1).region.holes if h.count == 1]
    for before, after in zip(small, moved, strict=True):
        radii = [abs(h.period[0].curve.point(0.0) - h.period[0].curve.centre) for h in (before, after)]  # type: ignore[attr-defined]
        assert radii[0] - radii[1] == pytest.approx(0.1)


def test_an_external_pair_refuses_a_ring() -> None:
    text = f'[parts.a]\n{RING}[parts.b]\n{SHAPED}[[mates]]\nkind = "external_gear_pair"\nfirst = "b"\nsecond = "a"\n'
    scene = scene_from_toml(text.encode(), "scene.toml", "scene")
    with pytest.raises(SceneError, match="ring_gear"):
        make_parts(scene, "scene.toml")


def test_every_finding_of_rings_and_their_pairs_has_words() -> None:
    from geometry.gears.pairs.internal import internal_pair
    from geometry.gears.pairs.rack import rack_pair

    text = f"[parts.a]\n{RING}outer_diameter = 103.0\n[parts.b]\n{SHAPED}[parts.c]\n{RACK}"
    scene = scene_from_toml(text.encode(), "scene.toml", "scene")
    ring, gear, rack = (KINDS[s.__struct_config__.tag].thing(s, scene.parts) for s in scene.parts.values())
    margins = [*internal_pair(gear, ring).margins(), *rack_pair(gear, rack).margins()]
    found = [Finding(m.name, m.value, m.limit) for m in margins]
    found += make_parts(scene, "scene.toml")[0]["a"].findings
    assert "thin_ring_rim" in {f.code for f in found}
    for language in ("en", "uk"):
        assert all(finding_text(language, f) for f in found)


@pytest.mark.heavy
@pytest.mark.parametrize("text", [RING, RACK])
def test_converge_measures_rings_and_racks(text: str, tmp_path: Path) -> None:
    """The curves of a ring stand in its hole; a rack has none but lines and arcs."""
    file = tmp_path / "s.toml"
    file.write_text(f'[parts.p]\n{text}[[exports]]\nformat = "dxf"\n', encoding="utf-8")
    assert main(["converge", str(file), "--out", str(tmp_path)]) == 0
    table = tmp_path / "s" / "converge.pieces.csv"
    assert table.exists() == (text is RING)
    assert text is RACK or "root_fillet" in table.read_text(encoding="utf-8")


def test_a_default_tip_that_yields_is_told_and_a_given_one_is_refused() -> None:
    small = RING.replace("48", "30")
    scene = scene_from_toml(f"[parts.p]\n{small}".encode(), "scene.toml", "scene")
    part = make_parts(scene, "scene.toml")[0]["p"]
    found = next(f for f in part.findings if f.code == "ring_tip_limited")
    assert found.limit == pytest.approx(0.75)
    assert found.value == pytest.approx((60.0 - part.circles["tip_diameter"]) / 4)
    assert "0.673" in finding_text("en", found)
    assert "0.673" in finding_text("uk", found)
    assert part.quantities["cutter_number_of_teeth"] == 15
    with pytest.raises(SceneError, match=r"tip_diameter = 57\.0.*at least 57\.3[\d.]* mm works"):
        made(small + "tip_diameter = 57.0\n")
    helical = scene_from_toml(f"[parts.p]\n{small}helix_angle_deg = 20.0\n".encode(), "scene.toml", "scene")
    part = make_parts(helical, "scene.toml")[0]["p"]
    assert part.quantities["cutter_addendum_coefficient"] == pytest.approx(1.25)
    assert part.quantities["cutter_tip_rounding_coefficient"] == pytest.approx(0.2)


@pytest.mark.parametrize("text", [RING.replace("48", "30"), RING.replace("48", "40").replace("2.0", "0.8")
                                  + "pressure_angle_deg = 32.0\n"])  # fmt: skip
def test_rings_that_were_refused_for_want_of_a_cutter_are_built(text: str, tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    file.write_text(f'[parts.p]\n{text}[[exports]]\nformat = "dxf"\n', encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
