"""Files of Geneva wheels: the pin passes their slots and the disc their arcs, and what is too tight is caught."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from exporters.formats.read_dxf import read_dxf
from geometry.base.record import replace
from parts.pins.geneva_probe import SlotProbe
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import read_report, run, write_scene

WHEEL: dict[str, Any] = {
    "kind": "geneva_wheel", "number_of_slots": 6, "centre_distance": 60.0, "pin_diameter": 5.0, "slot_clearance": 0.3,
    "locking_clearance": 0.12, "face_width": 4.0,
}  # fmt: skip
RING = WHEEL | {"number_of_slots": 5, "internal": True, "tip_rounding": 0.5}
PARTS = {"wheel": WHEEL, "ring": RING}
EXPORTS = ({"format": "dxf"}, {"format": "dxf", "name": "cut", "kerf": 0.2}, {"format": "svg"}, {"format": "stl"})


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the files of both."""
    root = tmp_path_factory.mktemp("geneva")
    assert run("build", write_scene(root / "s.toml", PARTS, EXPORTS), "--out", root / "out") == 0
    return root / "out" / "s"


def test_pin_and_disc_have_the_gaps_that_were_asked_for(built: Path) -> None:
    files = read_report(built)["files"]
    assert len(files) == 8
    for entry in files:
        found, off = entry["measured"], entry["max_error"] + 1e-6
        assert found["slot_gap"] == pytest.approx(0.15 - entry["offset"], abs=off)
        assert found["locking_gap"] == pytest.approx(0.12 - entry["offset"], abs=off)


@pytest.mark.parametrize("name", PARTS)
def test_what_is_too_tight_is_caught(built: Path, name: str) -> None:
    parts, _ = make_parts(scene_from_dict({"parts": PARTS}, "t", "t"), "t")
    wheel, file = parts[name].thing, read_dxf(built / f"{name}.laser.dxf")
    assert SlotProbe(wheel, 2.0).run(file, 0.0, 1e-6).failures == ()
    for tight, word in (
        (replace(wheel, pin_diameter=5.001), "pin"),
        (replace(wheel, locking_radius=wheel.locking_radius + 0.001), "disc"),
    ):
        (failure,) = SlotProbe(tight, 2.0).run(file, 0.0, 1e-6).failures
        assert word in failure
