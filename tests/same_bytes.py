"""``python -m tests.same_bytes [SCENE ...]``: the hash of every file of built-in scenes, a line each.

``python -m tests.same_bytes ONE TWO`` of two folders: which of their files are not alike. Two machines, two versions of
numpy or two kernels of its BLAS make files that are alike; ``.ci/checks`` compares.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import re
import sys
import tempfile
import zipfile
from pathlib import Path

import numpy as np

import parts
from exporters.command.cli import main

SCENES = Path(parts.__file__).parent / "scenes"
_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("colour", "<u2")])
_TRIANGLE = re.compile(rb' v[123]="\d+"')
_NUMBER = re.compile(rb"-?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")


def hashes(names: list[str], folder: Path) -> dict[str, str]:
    """The hash of each file by its path, of scenes built in an empty folder."""
    build(names, folder)
    return {path: hashlib.sha256((folder / path).read_bytes()).hexdigest() for path in files_of(folder)}


def build(names: list[str], folder: Path) -> None:
    """Build scenes in a folder, unread."""
    with contextlib.redirect_stdout(io.StringIO()):
        status = main(["build", *names, "--out", str(folder), "--no-verify", "-q"])
    if status:
        raise SystemExit(f"exit code {status}")


def files_of(folder: Path) -> list[str]:
    """The files below a folder by their paths in it; reports tell versions and are left out."""
    files = sorted(f for f in folder.rglob("*") if f.is_file() and f.suffix != ".json")
    return [f.relative_to(folder).as_posix() for f in files]


def are_alike(one: bytes, two: bytes, within: float = 1.01e-9) -> bool:
    """Whether two files have the same bytes, or the same text but for the last digits of its numbers.

    STEP has nine decimals, knots of a DXF and places in a 3MF have all digits: the last one of a few in a million hangs
    on the processor. So does the diagonal of four points on one circle in a flat face: meshes have the same corners.
    """
    if one == two:
        return True
    if one.startswith(b"PK") and two.startswith(b"PK"):
        packs = [zipfile.ZipFile(io.BytesIO(pack)) for pack in (one, two)]
        names = packs[0].namelist()
        return names == packs[1].namelist() and all(are_alike(*(p.read(name) for p in packs)) for name in names)
    if len(one) == len(two) == 84 + 50 * int.from_bytes(one[80:84], "little"):
        return np.array_equal(*(np.unique(np.frombuffer(stl[84:], _STL)["corners"].reshape(-1, 3), axis=0)
                                for stl in (one, two)))  # fmt: skip
    one, two = (_TRIANGLE.sub(b"", text) for text in (one, two))
    if _NUMBER.sub(b"", one) != _NUMBER.sub(b"", two):
        return False
    first, second = (np.array([float(number) for number in _NUMBER.findall(text)]) for text in (one, two))
    return bool(np.allclose(first, second, rtol=1e-12, atol=within))


def unlike(one: Path, two: Path) -> list[str]:
    """The paths of files that one of two folders lacks, or that are not alike.

    Previews are for the eye: their numbers to 1e-3 mm, what is seen of all parts apart not at all.
    """
    names = [set(files_of(folder)) for folder in (one, two)]
    return sorted(names[0] ^ names[1]) + [
        name
        for name in sorted(names[0] & names[1])
        if ".exploded." not in name
        and not are_alike(*((f / name).read_bytes() for f in (one, two)), 1e-3 if ".preview." in name else 1.01e-9)
    ]


if __name__ == "__main__":
    asked = sys.argv[1:] or sorted(f.stem for f in SCENES.glob("*.toml"))
    if len(asked) == 2 and all(Path(one).is_dir() for one in asked):
        sys.exit("\n".join(unlike(*map(Path, asked))) or 0)
    with tempfile.TemporaryDirectory() as made:
        for path, found in hashes(asked, Path(made)).items():
            print(found, path)
