"""A worm wheel (module 2, 1/30, q 10, ZA, width 14) beside wormgear's: flank in the mid plane, thickness, time, size.

Run it with ``python -m tests.benchmarks.bench_worm_wheel [--peer PYTHON]``; PYTHON is an interpreter that has wormgear.
Both write STEP and STL; CPU time within one process, after its imports. The mid section of a ZA worm's wheel is an
involute gear of the worm's module and angle (Savvin): that is what the STL, read by our reader and cut there, is held
against. Turn and thickness are fitted first, what is left is the form. Nothing is asserted.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from exporters.formats.read_stl import read_stl

MODULE, TEETH, WIDTH, ALPHA = 2.0, 30, 14.0, math.radians(20)
# of both meshes, mm, and points on what is cut of a triangle
NEAR, SAMPLES = 0.005, 9

SCENE = f"""[parts.wheel]
kind = "worm_wheel"
module = {MODULE}
number_of_teeth = {TEETH}
form = "ZA"
face_width = {WIDTH}
outer_diameter = 64.0
tip_clearance_coefficient = 0.25
[[exports]]
format = "step"
tolerance = 1e-4
[[exports]]
format = "stl"
tolerance = {NEAR}
"""
OWN = """
import shutil, sys
from exporters.command.cli import main
def made(folder):
    main(["build", f"{folder}/wheel.toml", "--out", folder])
    for name in ("step", "stl"):
        shutil.copy(f"{folder}/wheel/wheel.{name}", f"{folder}/made.{name}")
"""
PEER = f"""
import math, sys
from build123d import export_step, export_stl
from wormgear import WormWheel
def made(folder):
    wheel = WormWheel(module={MODULE}, num_teeth={TEETH}, face_width={WIDTH}, throated=True, profile="ZA",
                      worm_target_lead_angle=math.degrees(math.atan(0.1)))
    export_step(wheel, f"{{folder}}/made.step")
    export_stl(wheel, f"{{folder}}/made.stl", tolerance={NEAR})
"""
RUN = """
import time
start = time.process_time()
made(sys.argv[1])
print("\\n" + str(time.process_time() - start))
"""


def mid_section(file: Path) -> NDArray[np.complex128]:
    """Points of the lines in which the middle plane cuts the triangles of an STL, mm."""
    mesh = read_stl(file)
    corners = mesh.vertices[mesh.triangles]
    low, high = mesh.vertices[:, 2].min(), mesh.vertices[:, 2].max()
    # just off vertices
    away = corners[..., 2] - (low + high) / 2 - 1e-7
    ends: list[list[complex]] = [[] for _ in away]
    for first, second in ((0, 1), (1, 2), (2, 0)):
        for k in np.flatnonzero(away[:, first] * away[:, second] < 0).tolist():
            share = away[k, first] / (away[k, first] - away[k, second])
            x, y, _ = corners[k, first] * (1 - share) + corners[k, second] * share
            ends[k].append(complex(x, y))
    return np.concatenate([np.linspace(*pair, SAMPLES) for pair in ends if pair])


def errors(plane: NDArray[np.complex128]) -> tuple[float, float]:
    """How far flanks are off the involute along its normal, and by how much teeth are too thick on d, mm."""
    reference, pitch = MODULE * TEETH / 2, 2 * math.pi / TEETH
    base = reference * math.cos(ALPHA)
    radius = np.abs(plane)
    # above fillets and below the corners of the tips
    plane = plane[(radius > reference - 0.6 * MODULE) & (radius < reference + 0.85 * MODULE)]
    radius = np.abs(plane)
    outer = plane[radius > reference + 0.5 * MODULE]
    middle = np.angle(np.mean((outer / np.abs(outer)) ** TEETH)) / TEETH
    angle = np.remainder(np.angle(plane) - middle + pitch / 2, pitch) - pitch / 2
    pressure = np.arccos(base / radius)
    expected = math.pi / 2 / TEETH + math.tan(ALPHA) - ALPHA - np.tan(pressure) + pressure
    beyond = [(side * angle - expected)[side * angle > 0] for side in (1, -1)]
    form = max(float(np.ptp(own)) for own in beyond) / 2 * base
    thicker = sum(float(own.max() + own.min()) / 2 for own in beyond)
    return form, thicker * reference


def row(name: str, python: str, code: str) -> None:
    """Print what one makes of it."""
    with tempfile.TemporaryDirectory() as name_of_folder:
        folder = Path(name_of_folder)
        (folder / "wheel.toml").write_text(SCENE, encoding="utf-8")
        (folder / "run.py").write_text(code + RUN, encoding="utf-8")
        ran = subprocess.run([python, folder / "run.py", folder], capture_output=True, text=True, check=False)
        if ran.returncode:
            print(f"{name:12} {ran.stderr.strip().splitlines()[-1][:100]}")
            return
        form, thicker = errors(mid_section(folder / "made.stl"))
        sizes = [(folder / f"made.{kind}").stat().st_size / 1e6 for kind in ("step", "stl")]
        spent = float(ran.stdout.strip().splitlines()[-1])
        print(f"{name:12} flank {1e3 * form:7.2f} um, teeth {1e3 * thicker:+8.2f} um, {spent:5.1f} s, "
              f"STEP {sizes[0]:.2f} MB, STL {sizes[1]:.2f} MB", flush=True)  # fmt: skip


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peer", help="an interpreter that has wormgear")
    given = parser.parse_args()
    row("higherpair", sys.executable, OWN)
    if given.peer:
        row("wormgear", given.peer, PEER)


if __name__ == "__main__":
    main()
