"""Files of parts that are very long and thin are read back as what they are."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from exporters.command.cli import main

ARM = """[parts.arm]
kind = "follower_arm"
end = "flat"
arm_length = {length}
boss_diameter = 8.0
pivot_diameter = 4.0
[[exports]]
format = "step"
[[exports]]
format = "stl"
"""


@pytest.mark.parametrize("length", [60.0, 1000.0])
def test_the_hole_of_a_long_arm_is_not_taken_for_its_outline(tmp_path: Path, length: float) -> None:
    """From rough samples of two long edges side by side the hole seemed nearer to the outline than the outline."""
    scene = tmp_path / "long.toml"
    scene.write_text(ARM.format(length=length), "utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    files = json.loads((tmp_path / "long" / "report.json").read_text("utf-8"))["files"]
    assert len(files) == 2
    assert all(file["verified"] for file in files)
