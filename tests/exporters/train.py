"""A scene of several instances of one part, for the tests of assembly files."""

from __future__ import annotations

from pathlib import Path

from tests.exporters.making import Keys, run, table

GEARS = "".join(
    table(f"[parts.{key}]", {"kind": "spur_gear", "module": 2.0, "number_of_teeth": z, "bore_diameter": 6.0, **more})
    for key, z, more in (("sun", 13, {"colour": "#c08040"}), ("planet", 11, {"profile_shift_coefficient": 0.3}))
)
# two planets of one part, the second one higher by 1 mm, and a free one placed by hand
TRAIN = GEARS + "".join(
    [
        table("[instances.sun]", {"at": [1.5, -2.0, 0.25], "rotation_deg": 10.0}),
        table("[instances.left]", {"part": "planet"}),
        table("[instances.right]", {"part": "planet"}),
        table("[instances.free]", {"part": "planet", "at": [0.0, 60.0, 1.0], "rotation_deg": -33.0}),
        *(
            table("[[mates]]", {"kind": "external_gear_pair", "first": "sun", "second": s, "direction_deg": d})
            for s, d in (("left", 180.0), ("right", 25.0))
        ),
    ]
)
IDS = {"sun": "sun", "left": "planet", "right": "planet", "free": "planet"}
THREEMF, STEP = {"format": "3mf", "assembly": True}, {"format": "step", "assembly": True}


def made(folder: Path, *exports: Keys, name: str = "train", text: str = TRAIN, verify: bool = True) -> Path:
    """Build the scene; the folder of its results."""
    scene = folder / f"{name}.toml"
    scene.write_text(text + "".join(table("[[exports]]", e) for e in exports), encoding="utf-8")
    assert run("build", scene, "--out", folder / "out", *([] if verify else ["--no-verify"])) == 0
    return folder / "out" / name
