"""A helical gear as STEP (module 2, 23 teeth, 30 degrees): time, size and flank error beside py_gearworks.

Run it with ``python -m tests.benchmarks.bench_helical [--peer PYTHON] [--runs N]``; PYTHON is an interpreter that has
py_gearworks. Cold processes, medians. The flank error is that of the kernel's own evaluation of the file read
back, against the involute helicoid, normal to the section. Nothing is asserted.
"""

from __future__ import annotations

import argparse
import math
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

TEETH, MODULE, BETA, ALPHA, WIDTH = 23, 2.0, math.radians(30.0), math.radians(20.0), 20.0
SCENE = f"""[parts.gear]
kind = "spur_gear"
module = {MODULE}
number_of_teeth = {TEETH}
helix_angle_deg = 30.0
face_width = {WIDTH}
[[exports]]
format = "step"
"""
PEER = f"""
import sys, py_gearworks as pgw
from build123d import export_step
gear = pgw.HelicalGear(number_of_teeth={TEETH}, module={MODULE}, height={WIDTH}, helix_angle={BETA}, root_fillet=0.38)
export_step(gear.build_part(), sys.argv[1])
"""


def seconds(command: list[str], runs: int) -> float:
    """Median wall time of cold processes."""
    taken = []
    for _ in range(runs + 1):
        start = time.perf_counter()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        taken.append(time.perf_counter() - start)
    return statistics.median(taken[1:])


def surfaces(file: Path) -> list[Any]:
    """The surfaces of a STEP file's faces."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    from parts.solids.kernel import silent_kernel

    with silent_kernel():
        reader = STEPControl_Reader()
        reader.ReadFile(str(file))
        reader.TransferRoots()
        shape = reader.OneShape()
    found, explorer = [], TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        found.append(BRepAdaptor_Surface(TopoDS.Face_s(explorer.Current())))
        explorer.Next()
    return found


def flank_error(faces: list[Any], teeth: int = TEETH, beta: float = BETA) -> float:
    """Greatest distance of points between form and tip circle from the involute helicoid, normal to the section, mm.

    The teeth's angle and the direction of their turn are fitted: files may begin elsewhere.
    """
    from OCP.GeomAbs import GeomAbs_SurfaceType

    points = []
    for surface in faces:
        if surface.GetType() in (GeomAbs_SurfaceType.GeomAbs_Plane, GeomAbs_SurfaceType.GeomAbs_Cylinder):
            continue
        u = np.linspace(surface.FirstUParameter(), surface.LastUParameter(), 25).tolist()
        v = np.linspace(surface.FirstVParameter(), surface.LastVParameter(), 25).tolist()
        points += [(p.X(), p.Y(), p.Z()) for a in u for b in v for p in [surface.Value(a, b)]]
    x, y, z = np.array(points).T
    transverse = math.atan(math.tan(ALPHA) / math.cos(beta))
    reference = MODULE * teeth / math.cos(beta) / 2
    base, pitch = reference * math.cos(transverse), 2 * math.pi / teeth
    radius = np.hypot(x, y)
    # well above any root fillet, or undercut, and below any tip rounding
    kept = (radius > reference - (0.3 * MODULE if teeth > 17 else 0.0)) & (radius < reference + 0.7 * MODULE)
    radius = radius[kept]
    half = math.pi / 2 / teeth + math.tan(transverse) - transverse
    pressure = np.arccos(base / radius)
    expected = half - (np.tan(pressure) - pressure)
    best = math.inf
    for sense in (1, -1):
        angle = np.arctan2(y, x)[kept] - sense * z[kept] * math.tan(beta) / reference
        start = np.angle(np.exp(1j * teeth * angle).mean()) / teeth
        for phase in (start, start + pitch / 2):
            away = angle - phase
            away -= pitch * np.round(away / pitch)
            found = base * (np.abs(away) - expected)
            upper, lower = np.median(found[away > 0]), np.median(found[away < 0])
            turned = away - (upper - lower) / 2 / base
            best = min(best, float(np.abs(base * (np.abs(turned) - expected)).max()))
    return best


def line(name: str, file: Path, taken: float) -> str:
    """One row of the table."""
    from OCP.GeomAbs import GeomAbs_SurfaceType

    faces = surfaces(file)
    cylinders = sum(s.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder for s in faces)
    size = file.stat().st_size / 1000
    return f"{name:14} {taken:8.2f} s {size:9.0f} kB {cylinders:4d} cylinders  flank error {flank_error(faces):.2e} mm"


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peer", help="an interpreter that has py_gearworks")
    parser.add_argument("--runs", type=int, default=3)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = folder / "s.toml"
        scene.write_text(SCENE)
        command = [sys.executable, "-m", "exporters", "build", str(scene), "--out", name]
        own = folder / "s" / "gear.step"
        taken = seconds([*command, "--no-verify"], given.runs)
        print(line("higherpair", own, taken))
        taken = seconds(command, given.runs)
        print(line("  read back", own, taken))
        if given.peer:
            script, made = folder / "peer.py", folder / "peer.step"
            script.write_text(PEER)
            taken = seconds([given.peer, str(script), str(made)], given.runs)
            print(line("py_gearworks", made, taken))


if __name__ == "__main__":
    main()
