"""Who reads a file back shares no code with who wrote it, nor with what approximated its curves."""

from __future__ import annotations

from pathlib import Path

import pytest

import exporters
from tests.test_rooms import Source, imports, sources

ROOM = Path(exporters.__file__).parent
READERS = [
    ".".join(("exporters", *file.relative_to(ROOM).with_suffix("").parts))
    for file in (*ROOM.glob("verification/[!_]*.py"), *ROOM.glob("formats/read*.py"), ROOM / "formats/chains.py")
]
# what writes: approximation, builders of solids and templates of text, writers, build
WRITERS = (
    "geometry.approximation", "geometry.solids.faces", "geometry.solids.body_faces", "geometry.solids.rings",
    "geometry.solids.screw", "parts.solids", "exporters.production", "exporters.drawings.write",
    *(f"exporters.formats.{name}" for name in ("laser_dxf", "drawing_dxf", "dxf_file", "svg", "stl", "threemf", "step",
                                               "registry")),
)  # fmt: skip
# the exact part may also make solids of itself, which no reader asks for; the kernel is nobody's writer
ENDS = ("parts.base.part", "parts.solids.kernel")


def shared(reader: str, modules: Source) -> set[str]:
    """What of the writers' modules a reader imports, lazily too, or imports of what it imports."""
    found, left = {reader}, [reader]
    while left:
        name = left.pop()
        new = {module for module, _ in imports(modules[name], modules)} - found if name not in ENDS else set()
        found |= new
        left += new
    return {m for m in found - set(ENDS) if any(m == w or m.startswith(f"{w}.") for w in WRITERS)}


@pytest.fixture(scope="module")
def modules() -> Source:
    return sources()


@pytest.mark.sampled(12)
@pytest.mark.parametrize("reader", READERS)
def test_a_reader_imports_no_writer(reader: str, modules: Source) -> None:
    assert shared(reader, modules) == set()


@pytest.mark.parametrize("source", ["from exporters.formats.svg import number", "import geometry.approximation.chords",
                                    "def f():\n    from parts.solids.mesh import body_mesh",
                                    "from geometry.cams.barrel import splines"])  # fmt: skip
def test_a_shared_writer_is_noticed(source: str, modules: Source) -> None:
    spoiled = modules | {"exporters.formats.read_step": modules["exporters.formats.read_step"] + source}
    assert shared("exporters.formats.read_step", spoiled)
    # also where it stands behind another module
    assert shared("exporters.verification.solid", spoiled)
    assert len(READERS) > 15


def test_the_reader_of_step_evaluates_splines_itself(modules: Source) -> None:
    for name in ("part21", "curves", "surfaces", "solid", "brep", "step"):
        taken = {m for m, _ in imports(modules[f"exporters.formats.read_{name}"], modules)}
        assert not any(m.startswith("geometry.curves.bspline") for m in taken)
