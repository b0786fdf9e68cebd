"""The pictures of the README that builds of its scenes make: ``python -m tests.pictures`` makes them anew.

``OF`` names each one's scene and file. Those that are no picture of a build (views by other programs, sheets with keys
of their own, times of a machine) are made by hand.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from exporters.command.cli import main

FOLDER = Path(__file__).parent.parent / ".pictures"
# scenes whose picture has their name
_ALIKE = (
    "belt_drive", "chain_drive", "clock_gears", "contour_cams", "cycloidal_reducer", "drawing_machine", "geneva_drive",
    "idler_train", "james", "laser_cam_model", "linkage_cam", "oval_gears", "practicum_pair", "ratchet", "sector_gears",
    "shaft_set", "six_link_model", "thesis_internal_pair", "worm",
)  # fmt: skip
OF: dict[str, tuple[str, str]] = {name: (name, f"{name}.preview.svg") for name in _ALIKE} | {
    "cam_sheet": ("practicum_roller_cam", "practicum_roller_cam.cam.cam.svg"),
    "laser_wheel": ("laser_gear", "wheel.preview.svg"),
    "lesson_5_board": ("lesson_5", "lesson_5.board.1.preview.svg"),
    "part_drawing": ("working_drawings", "gear.part.svg"),
    "power_table_board": ("power_table_laser", "power_table_laser.board.1.preview.svg"),
    "power_table_exploded": ("power_table_laser", "power_table_laser.exploded.preview.svg"),
    "power_table_laser": ("power_table_laser", "power_table_laser.motion.svg"),
    "practicum_meshing": ("practicum_pair", "practicum_pair.meshing.1.svg"),
    "roller_cam": ("practicum_roller_cam", "cam.preview.svg"),
    "six_link_model_exploded": ("six_link_model", "six_link_model.exploded.preview.svg"),
    "train_sheet": ("james", "james.train.svg"),
}


def made(scene: str, folder: Path) -> dict[str, str]:
    """The pictures that a scene makes, by their names in the README; of a film the first frame."""
    if main(["build", scene, "--no-verify", "--out", str(folder)]):
        sys.exit(f"{scene} is not built")
    files = {name: folder / scene / file for name, (own, file) in OF.items() if own == scene}
    return {name: re.sub(r"<animate\w* .*?/>\n?", "", file.read_text("utf-8")) for name, file in files.items()}


if __name__ == "__main__":
    with TemporaryDirectory() as place:
        for scene in dict.fromkeys(scene for scene, _ in OF.values()):
            for name, text in made(scene, Path(place)).items():
                (FOLDER / f"{name}.svg").write_text(text, "utf-8")
