"""Many spur gears (module 2, width 10, bore 4) beside cq_gears, py_gearworks and bd_warehouse: time and flank error.

Run it with ``python -m tests.benchmarks.bench_peers --peers PYTHON [--teeth 8,23,40,100,200]``; PYTHON is an
interpreter that has them. Everyone works through the sample twice in one process, the second time counts, CPU time.
``catalogue`` writes DXF, STL and STEP with report and preview and reads all of them back; the peers write STEP and STL
and read nothing. The flank error is that of bench_helical, by the kernel's own evaluation. Nothing is asserted.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tests.benchmarks.bench_helical import MODULE, flank_error, surfaces

SCENE = f"""[parts.gear]
kind = "spur_gear"
module = {MODULE}
number_of_teeth = 23
face_width = 10.0
bore_diameter = 4.0
[[exports]]
format = "dxf"
[[exports]]
format = "stl"
[[exports]]
format = "step"
"""
# what each makes of a number of teeth, and how it writes it
PEERS = {
    "cq_gears": """
import cadquery as cq
from cq_gears import SpurGear
def made(z, name):
    gear = cq.Workplane("XY").gear(SpurGear(module=2.0, teeth_number=z, width=10.0, bore_d=4.0))
    cq.exporters.export(gear, name + ".step")
    cq.exporters.export(gear, name + ".stl", tolerance=0.01, angularTolerance=0.1)
""",
    "py_gearworks": """
import py_gearworks as pgw
from build123d import export_step, export_stl
def made(z, name):
    gear = pgw.SpurGear(number_of_teeth=z, module=2.0, height=10.0, root_fillet=0.38).build_part()
    export_step(gear, name + ".step")
    export_stl(gear, name + ".stl", tolerance=0.01)
""",
    "bd_warehouse": """
from bd_warehouse.gear import SpurGear
from build123d import export_step, export_stl
def made(z, name):
    gear = SpurGear(module=2.0, tooth_count=z, pressure_angle=20, root_fillet=0.5, thickness=10.0)
    export_step(gear, name + ".step")
    export_stl(gear, name + ".stl", tolerance=0.01)
""",
}
OWN = """
import shutil
from exporters.command.cli import main
def made(z, name):
    shutil.rmtree(name, ignore_errors=True)
    main(["catalogue", "SCENE", "--vary", f"gear.number_of_teeth={z}", "--out", name])
    shutil.copy(f"{name}/s/gear.number_of_teeth={z}/gear.step", name + ".step")
"""
RUN = """
import json, sys, time
def told(z):
    start = time.process_time()
    try:
        made(z, f"{sys.argv[1]}{z}")
    except Exception as error:
        return f"{type(error).__name__}: {error}"[:60]
    return time.process_time() - start
sizes = json.loads(sys.argv[2])
found = [{z: told(z) for z in sizes} for _ in range(2)][1]
print("\\n" + json.dumps(found))
"""


def row(name: str, python: str, code: str, teeth: Sequence[int], folder: Path) -> None:
    """Print what one makes of the sample."""
    script, files = folder / f"run_{name}.py", folder / f"{name}_"
    script.write_text(code + RUN, encoding="utf-8")
    ran = subprocess.run([python, script, files, json.dumps(teeth)], capture_output=True, text=True, check=False)
    if ran.returncode:
        print(f"{name:14} {ran.stderr.strip().splitlines()[-1][:90]}")
        return
    spent = json.loads(ran.stdout.strip().splitlines()[-1])
    cells = []
    for z in teeth:
        taken, file = spent[str(z)], Path(f"{files}{z}.step")
        error = f"{1000 * flank_error(surfaces(file), z, 0.0):.2g} um" if not isinstance(taken, str) else "-"
        cells.append(f"z {z}: {taken if isinstance(taken, str) else f'{taken:.2f} s, {error}'}")
    done = [t for t in spent.values() if not isinstance(t, str)]
    mean = f"mean {statistics.mean(done):6.2f} s of {len(done)}" if done else "none"
    print(f"{name:14} {mean}  " + "; ".join(cells), flush=True)


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peers", help="an interpreter that has cq_gears, py_gearworks and bd_warehouse")
    parser.add_argument("--teeth", default="8,23,40,100,200", help="numbers of teeth of the sample")
    given = parser.parse_args()
    teeth = [int(z) for z in given.teeth.split(",")]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "s.toml").write_text(SCENE, encoding="utf-8")
        row("higherpair", sys.executable, OWN.replace("SCENE", str(folder / "s.toml")), teeth, folder)
        for peer, code in PEERS.items() if given.peers else ():
            row(peer, given.peers, code, teeth, folder)


if __name__ == "__main__":
    main()
