"""STEP of the parts of scenes beside the CAD kernel's file of the same body: seconds of processor time and sizes.

Run it with ``python -m tests.benchmarks.bench_step [--turns N] SCENE ...``. Ours: faces, area and text, and the whole
read-back by our own reader; the kernel's: writing, reading back, its check of the solid. In turns, medians, as CSV;
nothing is asserted.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
import time
from itertools import pairwise
from pathlib import Path

from exporters.verification.judge import verify_file
from geometry.solids.area import surface_area
from parts.base.part import Part
from parts.scene.formats import FILE_KINDS
from parts.scene.load import load_scene, make_parts
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.kernel import silent_kernel, solids_of
from parts.solids.step_text import StepForm, StepPart, step_text

TOLERANCE = 1e-6


def seconds(told: list[float]) -> list[float]:
    """Between moments."""
    return [after - before for before, after in pairwise(told)]


def ours(part: Part, file: Path) -> list[float]:
    """Seconds of writing and of reading back."""
    body, told = part.body(0.0), [time.process_time()]
    volume = part.made_by.moments(body).volume
    solid = solid_faces(body, solid_curves(body, 0.98 * TOLERANCE))
    whole = StepPart(part.id, solid, volume=volume, area=surface_area(solid))
    file.write_text(step_text(whole, StepForm()), encoding="ascii")
    told.append(time.process_time())
    failures = verify_file(file, FILE_KINDS["step"], body, TOLERANCE, TOLERANCE).failures
    if failures:
        raise SystemExit(f"{part.id}: {failures[0]}")
    return seconds([*told, time.process_time()])


def kernels(file: Path, own: Path) -> list[float]:
    """The same of the kernel, of the solid of a file."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    (solid,) = solids_of(file.read_text(encoding="ascii"))
    told = [time.process_time()]
    with silent_kernel():
        writer = STEPControl_Writer()
        writer.Transfer(solid, STEPControl_StepModelType.STEPControl_AsIs)
        writer.Write(str(own))
    told.append(time.process_time())
    if not all(BRepCheck_Analyzer(found).IsValid() for found in solids_of(own.read_text(encoding="ascii"))):
        raise SystemExit(f"{own}: invalid")
    return seconds([*told, time.process_time()])


def main() -> None:
    """Print the table."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("scenes", nargs="+")
    options.add_argument("--turns", type=int, default=3)
    asked = options.parse_args()
    print("scene,part,write s,read back s,kB,kernel writes s,kernel reads back s,kernel's kB")
    with tempfile.TemporaryDirectory() as folder:
        file, own = Path(folder) / "ours.step", Path(folder) / "kernel.step"
        for scene in asked.scenes:
            for name in make_parts(load_scene(scene), scene)[0]:
                rows = []
                for _ in range(asked.turns):
                    # a body keeps what it has measured
                    part = make_parts(load_scene(scene), scene)[0][name]
                    rows.append([*ours(part, file), *kernels(file, own)])
                a, b, c, d = (f"{statistics.median(column):.3f}" for column in zip(*rows, strict=True))
                sizes = [f"{f.stat().st_size / 1e3:.0f}" for f in (file, own)]
                print(",".join((scene, name, a, b, sizes[0], c, d, sizes[1])), flush=True)


if __name__ == "__main__":
    main()
