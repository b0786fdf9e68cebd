"""Where the CPU time of a cold build goes: the interpreter, numpy, other libraries, our modules, and the work itself.

Run it with ``python -m tests.benchmarks.bench_cold [--runs N]``: medians, ms, as CSV; one run's are in cold_start.csv.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.benchmarks.bench_commands import SCENE

IMPORTS = ("interpreter", "numpy", "other libraries", "standard library", "our modules")
WORK = ("command and scene", "approximate", "write", "read back", "preview and report")
FORMATS = {"laser DXF": ("dxf", 0.01), "SVG": ("svg", 0.01), "STL": ("stl", 0.01), "STEP": ("step", 1e-6)}
# in a process of its own: what the build loads, told by an earlier one, is imported group by group, then it runs
_RUN = """
import json, os, sys, time
stages, (scene, folder) = json.loads(sys.argv[1]), sys.argv[2:]
told = [time.process_time()]
for names in stages:
    for name in names:
        __import__(name)
    told.append(time.process_time())
from exporters.command.cli import main
main(["build", scene, "--out", folder])
told.append(time.process_time())
spent = [after - before for before, after in zip([0.0, *told], told)]
with open(folder + "/gear/report.json", encoding="utf-8") as report:
    run = json.load(report)["run"]
(stages,) = run["stages"].values()
parts = [stages[k] for k in ("approximate", "write", "verify")]
spent[-1:] = [spent[-1] - run["seconds"], *parts, run["seconds"] - sum(parts)]
loaded = [n for n in sys.modules if n != "__main__" and getattr(sys.modules[n], "__spec__", None)]
print("\\n" + json.dumps([spent, loaded]), flush=True)
os._exit(0)
"""


def once(groups: list[list[str]], scene: Path, folder: Path) -> tuple[list[float], list[str]]:
    """Seconds of every stage, and the modules that were loaded."""
    # bytecode is kept as an installed package has it
    env = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    env["PYTHONPYCACHEPREFIX"] = str(scene.parent / "bytecode")
    command = [sys.executable, "-c", _RUN, json.dumps(groups), str(scene), str(folder)]
    found = subprocess.run(command, capture_output=True, text=True, check=True, env=env).stdout
    spent, loaded = json.loads(found.splitlines()[-1])
    return spent, loaded


def grouped(loaded: list[str]) -> list[list[str]]:
    """The modules in the order of the stages: numpy, other libraries, the standard library, ours."""
    ours, groups = ("geometry", "parts", "exporters"), [list[str]() for _ in range(4)]
    for name in loaded:
        top = name.partition(".")[0]
        groups[0 if top == "numpy" else 3 if top in ours else 2 if top in sys.stdlib_module_names else 1].append(name)
    return [["numpy", *groups[0]], *groups[1:]]


def main() -> None:
    """Print the table."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--runs", type=int, default=15)
    runs = options.parse_args().runs
    print(",".join(("format", *IMPORTS, *WORK, "sum")))
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "gear.toml"
        for name, (form, tolerance) in FORMATS.items():
            scene.write_text(SCENE.format(module=2.0, teeth=23, format=form, tolerance=tolerance), encoding="utf-8")
            groups = grouped(once([], scene, Path(folder) / "out")[1])
            told = [once(groups, scene, Path(folder) / "out")[0] for _ in range(runs)]
            parts = [statistics.median(stage) for stage in zip(*told, strict=True)]
            print(",".join((name, *(f"{1e3 * x:.0f}" for x in (*parts, sum(parts))))), flush=True)


if __name__ == "__main__":
    main()
