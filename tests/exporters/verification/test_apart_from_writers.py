"""Who reads a file back shares no code with who wrote it, nor with what approximated its curves."""

from __future__ import annotations

from pathlib import Path

import pytest

import exporters
from tests.test_architecture import imports_of

ROOM = Path(exporters.__file__).parent
READERS = [*ROOM.glob("verification/*.py"), *ROOM.glob("formats/read*.py"), ROOM / "formats/chains.py"]
WRITERS = ("laser_dxf", "drawing_dxf", "dxf_file", "svg", "stl", "threemf", "step", "registry")


def shared(source: str) -> list[str]:
    """Imports, lazy ones too, of what writes: approximation, builders of solids, writers, build."""
    forbidden = ("geometry.approximation", "parts.solids", "exporters.production", "exporters.drawings.write")
    forbidden += tuple(f"exporters.formats.{name}" for name in WRITERS)
    allowed = ("parts.solids.kernel",)
    names = {item.name for item in imports_of(source)} - set(allowed)
    return sorted(n for n in names if any(n == f or n.startswith(f"{f}.") for f in forbidden))


@pytest.mark.parametrize("file", READERS, ids=lambda f: f.name)
def test_a_reader_imports_no_writer(file: Path) -> None:
    assert shared(file.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("source", ["from exporters.formats.svg import number", "import geometry.approximation.chords",
                                    "def f():\n    from parts.solids.mesh import body_mesh"])  # fmt: skip
def test_a_shared_writer_is_noticed(source: str) -> None:
    assert len(shared(source)) == 1
    assert len(READERS) > 15
