"""Whole commands, cold, against their floors; and how time and memory grow with the number of teeth.

Run it with ``python -m tests.benchmarks.bench_commands [--runs N] [--quick]``. It prints medians and ratios of one
run on one machine and asserts nothing about time.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

SCENE = """[parts.gear]
kind = "spur_gear"
module = {module}
number_of_teeth = {teeth}
face_width = 10.0
bore_diameter = 8.0
[[exports]]
format = "{format}"
tolerance = {tolerance}
"""
BOSL2_SCENE = """include <BOSL2/std.scad>
include <BOSL2/gears.scad>
$fa = 2; $fs = 0.1;
spur_gear(mod=2, teeth=23, thickness=10, shaft_diam=8, pressure_angle=20);
"""


def seconds_of(command: Sequence[str], folder: Path, *, check: bool = True) -> float:
    """Wall time of one cold process."""
    start = time.perf_counter()
    subprocess.run(command, cwd=folder, check=check, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


def medians(commands: dict[str, list[str]], folder: Path, runs: int) -> dict[str, float]:
    """Median seconds of each command; the commands take turns, so that a busy moment falls on all of them."""
    taken: dict[str, list[float]] = {name: [] for name in commands}
    for command in commands.values():
        seconds_of(command, folder)
    for _ in range(runs):
        for name, command in commands.items():
            taken[name].append(seconds_of(command, folder))
    return {name: statistics.median(values) for name, values in taken.items()}


def write_scene(folder: Path, kind: str, tolerance: float, teeth: int = 23, module: float = 2.0) -> Path:
    """A scene of one gear in one format."""
    file = folder / f"{kind}_{teeth}.toml"
    file.write_text(SCENE.format(format=kind, tolerance=tolerance, teeth=teeth, module=module), encoding="utf-8")
    return file


def build_command(scene: Path, *more: str) -> list[str]:
    """The build of a scene in a process of its own."""
    return [sys.executable, "-m", "exporters", "build", str(scene), "--out", str(scene.parent / "out"), *more]


def openscad(folder: Path) -> list[str] | None:
    """The OpenSCAD command for the same gear; None where OpenSCAD or BOSL2 is not installed."""
    program = shutil.which("openscad")
    if program is None:
        return None
    scene = folder / "gear.scad"
    scene.write_text(BOSL2_SCENE, encoding="utf-8")
    command = [program, "-o", str(folder / "gear.stl"), "--export-format", "binstl", str(scene)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    return None if done.returncode or "Can't open" in done.stderr else command


def show(title: str, rows: list[list[str]]) -> None:
    """A table of plain columns."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    print(f"\n{title}")
    for row in rows:
        print("  " + row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:], widths[1:], strict=True)), sep="  ")


def against_floors(folder: Path, runs: int) -> None:
    """One gear, m 2, z 23: each command beside what it cannot go below."""
    stl, dxf = write_scene(folder, "stl", 0.001), write_scene(folder, "dxf", 0.005)
    svg, step = write_scene(folder, "svg", 0.005), write_scene(folder, "step", 1e-6)
    commands = {
        "python -c pass": [sys.executable, "-c", "pass"],
        "import numpy": [sys.executable, "-c", "import numpy"],
        "import ezdxf": [sys.executable, "-c", "import ezdxf"],
        "build STL at 0.001": build_command(stl),
        "build STL at 0.001, unverified": build_command(stl, "--no-verify"),
        "build DXF at 0.005": build_command(dxf),
        "build DXF at 0.005, unverified": build_command(dxf, "--no-verify"),
        "build SVG at 0.005": build_command(svg),
        "build STEP": build_command(step),
        "build STEP, unverified": build_command(step, "--no-verify"),
    }
    rival = openscad(folder)
    if rival is not None:
        commands["OpenSCAD + BOSL2, STL"] = rival
    found = medians(commands, folder, runs)
    rows = [["command", "s", "/ import numpy", "/ import ezdxf"]]
    rows += [[name, f"{s:.3f}", f"{s / found['import numpy']:.2f}", f"{s / found['import ezdxf']:.2f}"]
             for name, s in found.items()]  # fmt: skip
    show(f"whole commands, cold, medians of {runs}", rows)
    print(f"  STEP / laser DXF: {found['build STEP'] / found['build DXF at 0.005']:.2f}")
    print("  OpenSCAD + BOSL2: not found" if rival is None else
          f"  STL / OpenSCAD: {found['build STL at 0.001'] / found['OpenSCAD + BOSL2, STL']:.2f}")  # fmt: skip


def scaling(folder: Path, teeth: Sequence[int]) -> None:
    """Seconds, stages, peak memory and bytes as the number of teeth grows; the figures of each build's own report."""
    for kind, tolerance in (("dxf", 0.005), ("stl", 0.01), ("step", 1e-6)):
        rows = [["z", "s", "approximate", "write", "verify", "MB", "kB", "us a tooth"]]
        for z in teeth:
            scene = write_scene(folder, kind, tolerance, z, 1.0)
            spent = seconds_of(build_command(scene), folder)
            report = json.loads((folder / "out" / scene.stem / "report.json").read_text(encoding="utf-8"))
            stages = next(iter(report["run"]["stages"].values()))
            shares = [f"{stages.get(k, 0):.3f}" for k in ("approximate", "write", "verify")]
            memory, size = report["run"]["peak_memory_mb"] or 0, report["files"][0]["bytes"] / 1000
            rows.append([str(z), f"{spent:.2f}", *shares, f"{memory:.0f}", f"{size:.0f}", f"{1e6 * spent / z:.0f}"])
        show(f"{kind} at {tolerance} mm, m 1, whole commands", rows)


def many(folder: Path, count: int) -> None:
    """So many gears by one ``catalogue``, as DXF, STL and STEP, all read back, by one process and by two."""
    scene = write_scene(folder, "dxf", 0.005)
    scene.write_text(scene.read_text("utf-8") + '[[exports]]\nformat = "stl"\n[[exports]]\nformat = "step"\n', "utf-8")
    vary, spent = f"gear.number_of_teeth=20:{19 + count}", []
    for jobs in ("1", "2"):
        out = folder / f"jobs_{jobs}"
        command = [sys.executable, "-m", "exporters", "catalogue", str(scene), "--vary", vary, "--jobs", jobs]
        spent.append(seconds_of([*command, "--out", str(out)], folder))
    rows = [["processes", "s", "ms a gear", "one / this"]]
    rows += [[str(n), f"{s:.1f}", f"{1000 * s / count:.0f}", f"{spent[0] / s:.2f}"] for n, s in enumerate(spent, 1)]
    show(f"catalogue of {count} gears, m 2, z from 20, DXF, STL and STEP", rows)
    table = csv.DictReader((out / scene.stem / "catalogue.csv").read_text("utf-8").splitlines())
    worst: dict[str, float] = {}
    for row in table:
        share = float(row["measured_mm"]) / float(row["max_error_mm"])
        worst[row["format"]] = max(worst.get(row["format"], 0.0), share)
    print("  greatest measured error / declared: " + ", ".join(f"{k} {v:.3f}" for k, v in worst.items()))


def main() -> None:
    """Print everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=9, help="runs of each command (default: 9)")
    parser.add_argument("--quick", action="store_true", help="3 runs, at most 1000 teeth")
    options = parser.parse_args()
    print(f"{platform.platform()}, Python {platform.python_version()}, {os.cpu_count()} processors")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        against_floors(folder, 3 if options.quick else options.runs)
        many(folder, 20 if options.quick else 181)
        scaling(folder, (100, 300, 1000) if options.quick else (100, 300, 1000, 3000, 10_000))


if __name__ == "__main__":
    main()
