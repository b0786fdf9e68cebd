"""STEP of the parts of scenes beside the CAD kernel's file of the same body: seconds of processor time, sizes, memory.

Run it with ``python -m tests.benchmarks.bench_step [--turns N] [SCENE ...]``. Both begin with the finished curves of a
body and end with the same content: name, colour, volume, area. Ours: area and text, and the file read by our own reader
with its topology, volume and area; the kernel's: the body by BRepBuilderAPI and ShapeFix, volume, area and XCAF's
writer, and the file read by XCAF, checked and measured. Medians; each part in two processes of its own, whose peak
memory counts. ``fit`` is what only we do, from keys to curves; ``judged`` our whole read-back, against the exact body.
Nothing is asserted about time.
"""

from __future__ import annotations

import argparse
import json
import pickle
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

TOLERANCE, COLOUR = 1e-6, "#c08040"
SCENES = ("shaft_set", "barrel_cam", "helical_gears", "print_gear", "rack_and_pinion", "worm", "worm_set_print",
          "groove_cam", "oval_gears", "cycloidal_reducer", "power_table_print")  # fmt: skip
COLUMNS = ("scene", "part", "fit s", "write s", "read s", "judged s", "kB", "MB",
           "kernel makes s", "writes s", "reads s", "kernel's kB", "MB", "behind")  # fmt: skip


def seconds(work: Callable[[], object], turns: int) -> float:
    """The median of so many turns after one that loads what is needed; of processor time."""
    taken = []
    for _ in range(turns + 1):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return statistics.median(taken[1:])


def ours(scene: str, name: str, file: Path, turns: int) -> None:
    """Print the seconds of all that we do, volume and area, and peak memory, MB; the solid is kept beside the file."""
    import resource

    from exporters.formats.read_step import read_step
    from exporters.verification.judge import verify_file
    from geometry.solids.area import surface_area
    from parts.scene.formats import FILE_KINDS
    from parts.scene.load import load_scene, make_parts
    from parts.solids.faces import solid_curves, solid_faces
    from parts.solids.step_text import StepForm, StepPart, step_text

    part = make_parts(load_scene(scene), scene)[0][name]
    start = time.process_time()
    body = part.body(0.0)
    volume = part.made_by.moments(body).volume
    solid = solid_faces(body, solid_curves(body, 0.98 * TOLERANCE))
    fit = time.process_time() - start

    def write() -> None:
        area = surface_area(solid)
        whole = StepPart(name, solid, COLOUR, volume=volume, area=area)
        file.write_text(step_text(whole, StepForm()), encoding="ascii")

    spent = [fit, seconds(write, turns), seconds(lambda: read_step(file), turns)]
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    start = time.process_time()
    failures = verify_file(file, FILE_KINDS["step"], body, TOLERANCE, TOLERANCE).failures
    judged = time.process_time() - start
    if failures:
        raise SystemExit(f"{scene} {name}: {failures[0]}")
    file.with_suffix(".pickle").write_bytes(pickle.dumps((solid, name, COLOUR)))
    print("\n" + json.dumps([[*spent, judged], [volume, surface_area(solid)], peak]))


def told_by(*words: object) -> Any:
    """What a process of its own says in its last line."""
    done = subprocess.run([sys.executable, "-m", *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stderr.strip()[-2000:])
    return json.loads(done.stdout.splitlines()[-1])


def main() -> None:
    """Print the table."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("scenes", nargs="*", default=SCENES)
    options.add_argument("--turns", type=int, default=5)
    options.add_argument("--ours", nargs=3, help=argparse.SUPPRESS)
    asked = options.parse_args()
    if asked.ours:
        scene, name, file = asked.ours
        ours(scene, name, Path(file), asked.turns)
        return
    from parts.scene.load import load_scene, make_parts

    print(",".join(COLUMNS))
    with tempfile.TemporaryDirectory() as folder:
        file, own = Path(folder) / "ours.step", Path(folder) / "kernel.step"
        for scene in asked.scenes:
            for name in make_parts(load_scene(scene), scene)[0]:
                spent, sizes, peak = told_by(
                    "tests.benchmarks.bench_step", "--turns", asked.turns, "--ours", scene, name, file
                )
                pickled = file.with_suffix(".pickle")
                kernel, (valid, *found), kernels_peak = told_by(
                    "tests.benchmarks.kernel_step", pickled, own, asked.turns
                )
                if not valid or any(abs(a / b - 1) > 1e-6 for a, b in zip(found, sizes, strict=True)):
                    raise SystemExit(f"{scene} {name}: the kernel made another body: {valid}, {found}, {sizes}")
                kilobytes = [one.stat().st_size / 1e3 for one in (file, own)]
                pairs = {"write": (spent[1], sum(kernel[:2])), "read": (spent[2], kernel[2]),
                         "bytes": (kilobytes[0], kilobytes[1]), "memory": (peak, kernels_peak)}  # fmt: skip
                behind = " ".join(what for what, (a, b) in pairs.items() if a >= b)
                cells = [
                    ",".join((*(f"{x:.4f}" for x in times), f"{size:.2f}", f"{memory:.0f}"))
                    for times, size, memory in zip((spent, kernel), kilobytes, (peak, kernels_peak), strict=True)
                ]
                print(",".join((scene, name, *cells, behind)), flush=True)


if __name__ == "__main__":
    main()
