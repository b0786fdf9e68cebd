"""How the work of one command grows: rows of a motion table, phases of a plan, teeth of a rack, a wrong gear's check.

Run it with ``python -m tests.benchmarks.bench_scaling``. It prints seconds of processor time of whole cold commands on
one machine, and asserts nothing about time.
"""

from __future__ import annotations

import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import ezdxf

from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.laws.named import polynomial_345, sine

CAM = '[parts.cam]\nkind = "cam"\nfollower = "roller"\nfollower_radius = 8.0\nbase_circle_radius = 35.0\n'
FILES = '[[exports]]\nformat = "dxf"\n[[exports]]\nformat = "svg"\n'
LAW = """lift = 20.0
phases = [{ move = "rise", angle_deg = 120.0, law = "sine" }, { move = "dwell", angle_deg = 40.0 },
          { move = "return_", angle_deg = 130.0, law = "polynomial_345" }, { move = "dwell", angle_deg = 70.0 }]
"""
RACK = '[parts.rack]\nkind = "rack"\nmodule = 1.0\nbody_height = 3.0\ntip_chamfer = 0.01\n'
GEAR = """[parts.gear]
kind = "noncircular_gear"
centrode = "oval"
axis_ratio = 1.5
module = 2.0
number_of_teeth = 30
[[exports]]
format = "dxf"
"""


def seconds_of(*words: str) -> float:
    """Processor time of one command in a process of its own, children's and the system's included."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-m", "exporters", *words], check=False, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def built(folder: Path, name: str, text: str) -> float:
    """Seconds of the build of a scene, verified."""
    scene = folder / f"{name}.toml"
    scene.write_text(text, encoding="utf-8")
    return seconds_of("build", str(scene), "--out", str(folder))


def table(rows: int) -> str:
    """The motion of ``LAW`` as a table, to 4 decimals."""
    motion = follower_motion(
        [rise(math.radians(120), 20.0, sine()), dwell(math.radians(40)),
         return_(math.radians(130), 20.0, polynomial_345()), dwell(math.radians(70))]
    )  # fmt: skip
    lifts = (float(motion.value(2 * math.pi * k / rows)) for k in range(rows))
    return f"motion_table = [{', '.join(f'[{360 * k / rows!r}, {s:.4f}]' for k, s in enumerate(lifts))}]\n"


def plan(phases: int) -> str:
    """Rises and returns of 0.3 mm with dwells between them."""
    angle = 360.0 / phases
    moves = ("rise", "dwell", "return_", "dwell")
    rows = (
        f'{{ move = "{move}", angle_deg = {angle!r}' + ("" if move == "dwell" else ', law = "polynomial_345"') + " }"
        for move in moves * (phases // 4)
    )
    return f"lift = 0.3\nphases = [{', '.join(rows)}]\n"


def spoilt(folder: Path) -> None:
    """Make the gear's file larger by 1 %: no point of it lies within the tolerance."""
    file = folder / "gear" / "gear.dxf"
    drawing = ezdxf.readfile(file)
    outline = max(drawing.modelspace().query("LWPOLYLINE"), key=len)
    outline.set_points([(1.01 * x, 1.01 * y, *rest) for x, y, *rest in outline.get_points()])
    drawing.saveas(file)


def main() -> None:
    """Print everything."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        floor = built(folder, "law", CAM + LAW + FILES)
        print(f"cam by its law              {floor:7.2f} s of processor time")
        for rows in (36, 360, 2000):
            spent = built(folder, f"table_{rows}", CAM + table(rows) + FILES)
            print(f"its table of {rows:4d} rows      {spent:7.2f}   {spent / floor:5.2f} times the law's")
        for phases in (16, 32, 64):
            spent = built(folder, f"plan_{phases}", CAM + plan(phases) + FILES)
            print(f"plan of {phases:2d} phases          {spent:7.2f}")
        for teeth in (9, 18, 36, 72):
            text = f'{RACK}number_of_teeth = {teeth}\n[[exports]]\nformat = "dxf"\n'
            print(f"rack of {teeth:2d} teeth           {built(folder, f'rack_{teeth}', text):7.2f}")
        built(folder, "gear", GEAR)
        file = str(folder / "gear" / "gear.dxf")
        print(f"verify, noncircular gear    {seconds_of('verify', file):7.2f}")
        spoilt(folder)
        print(f"verify, the same, spoilt    {seconds_of('verify', file):7.2f}")


if __name__ == "__main__":
    main()
