"""``python -m tests.same_bytes [SCENE ...]``: the hash of every file of built-in scenes, a line each.

Two machines, two versions of numpy or two kernels of its BLAS print the same; ``.ci/lowest`` compares.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import sys
import tempfile
from pathlib import Path

import parts
from exporters.command.cli import main

SCENES = Path(parts.__file__).parent / "scenes"


def hashes(names: list[str], folder: Path) -> dict[str, str]:
    """The hash of each file by its path, of scenes built in an empty folder; reports tell versions and are left out."""
    with contextlib.redirect_stdout(io.StringIO()):
        status = main(["build", *names, "--out", str(folder), "--no-verify", "-q"])
    if status:
        raise SystemExit(f"exit code {status}")
    files = sorted(f for f in folder.rglob("*") if f.is_file() and f.suffix != ".json")
    return {f.relative_to(folder).as_posix(): hashlib.sha256(f.read_bytes()).hexdigest() for f in files}


if __name__ == "__main__":
    asked = sys.argv[1:] or sorted(f.stem for f in SCENES.glob("*.toml"))
    with tempfile.TemporaryDirectory() as made:
        for path, found in hashes(asked, Path(made)).items():
            print(found, path)
