"""What is told of scenes around round pins: heights, turned rings, keys and files of the other form of pins."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines, has_bad_verdict
from exporters.production.preview import outlines_of, part_preview
from parts.base.refusal import SceneError
from parts.scene.load import make_parts
from parts.scene.placing import place
from tests.parts.scene.test_round_pins import DISC, GEAR, LANTERN, PARTS, PLATE, REDUCER, RING, Keys, checked, scene


@pytest.mark.parametrize(("parts", "mate", "height"), [
    ({"ring": RING, "disc": DISC}, "cycloidal_pair", 50.0), ({"lantern": LANTERN, "gear": GEAR}, "lantern_pair", 40.0),
])  # fmt: skip
def test_a_height_without_a_common_face_is_told(parts: dict[str, Keys], mate: str, height: float) -> None:
    first, second = parts
    for z, met in ((height, False), (1.0, True)):
        found = checked(parts, [{"kind": mate, "first": first, "second": second, "height": z}])[1]
        assert all(c["met"] for c in found["mates"][0]["conditions"]) is met
        assert has_bad_verdict(found) or met
        assert ("BROKEN" in "\n".join(check_lines(found, "en"))) is not met


def test_transmission_error_of_others_than_involutes_is_told() -> None:
    made = scene({"lantern": LANTERN, "gear": GEAR}, [{"kind": "lantern_pair", "first": "lantern", "second": "gear"}])
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    for language, told in (("en", "involute gears only"), ("uk", "евольвентних")):
        found = scene_checks(placing, parts, made.drives, language, contact=False, transmission=True)
        assert told in "\n".join(check_lines(found, language))


def test_a_length_of_loose_pins_is_refused() -> None:
    with pytest.raises(SceneError, match=r"plate\.pin_length = 5.*remove pin_length"):
        make_parts(scene({"plate": PLATE | {"pins": "holes", "pin_length": 5.0}}), "t")


@pytest.mark.parametrize(("drive", "joined", "told"), [
    ("ring", [], r"drives\[1\].instance = .*turns the ring ring, which is held"),
    ("eccentric", [{"kind": "fixed", "first": "ring", "second": "eccentric"}], r"mates\[1\].first = .*is held"),
    ("eccentric", [], None),
])  # fmt: skip
def test_a_held_ring_is_not_turned(drive: str, joined: list[Keys], told: str | None) -> None:
    parts = {k: PARTS[k] for k in ("ring", "disc", "eccentric", "plate")}
    drives = [{"instance": drive, "turns": 1.0}]
    if told is None:
        train = checked(parts, REDUCER, drives=drives)[1]["drives"][0]["train"]
        assert train["disc"] == pytest.approx(-1 / 11)
    else:
        with pytest.raises(SceneError, match=told):
            checked(parts, [*REDUCER, *joined], drives=drives)


def test_the_flat_file_of_solid_pins_says_so() -> None:
    from parts.texts.findings import finding_text

    made = scene({"plate": PLATE, "gear": GEAR})
    plate = make_parts(made, "t")[0]["plate"]
    (found,) = plate.flat_findings
    assert "pins" in finding_text("en", found)
    assert "пальц" in finding_text("uk", found)
    assert plate.is_plate is False


def test_pictures_show_solid_pins_filled(tmp_path: Path) -> None:
    for pins, filled in (("solid", True), ("holes", False)):
        part = make_parts(scene({"plate": PLATE | {"pins": pins, "bore_diameter": 8.0}}), "t")[0]["plate"]
        text = part_preview(part, outlines_of(part.section(0.0).region), tmp_path, "en").read_text(encoding="utf-8")
        found = re.findall(r'<path d="([^"]*)" style="fill:#7f8c99', text)
        assert bool(found) is filled
        assert not filled or found[0].count("M") == PLATE["number_of_pins"]
