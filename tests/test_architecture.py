"""The house rules on imports, read off the syntax trees, each with a negative control."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

import exporters
import geometry
import parts
from tests.sources import told

ROOMS = {module.__name__: Path(module.__file__ or "").parent for module in (geometry, parts, exporters)}
# what each room may import of the house, itself included
MAY_IMPORT = {"geometry": {"geometry"}, "parts": {"geometry", "parts"}, "exporters": {"geometry", "parts", "exporters"}}
# mathematics only: no files, no file format, no words for users
NOT_IN_GEOMETRY = {"os", "pathlib", "io", "sys", "shutil", "tempfile", "json", "tomllib", "ezdxf", "shapely", "msgspec",
                   "rich", "argparse", "trimesh", "manifold3d", "cadquery", "OCP", "lib3mf", "scipy"}  # fmt: skip
HEAVY = {"ezdxf", "shapely", "rich", "trimesh", "manifold3d", "cadquery", "OCP", "lib3mf", "scipy", "matplotlib",
         "distributed", "fpdf", "mpmath"}  # fmt: skip
# a writer is itself imported only where its format is written
HEAVY_AT_TOP = {
    "exporters/formats/dxf_file.py": {"ezdxf"},
    "exporters/formats/drawing_dxf.py": {"ezdxf"},
    "exporters/production/atlas.py": {"mpmath"},
}
# nothing else may be needed to install and run
LIGHT = {"numpy", "msgspec"}
# what every record is made of; a dataclass costs fifty times as much when it is imported
RECORDS = "geometry/base/record.py"


@dataclass(frozen=True)
class Import:
    """One import statement: the module's full name, the line, whether it runs when the file is loaded."""

    name: str
    line: int
    at_top: bool
    star: bool


def imports_of(source: str) -> Iterator[Import]:
    """Every import of a file; those under TYPE_CHECKING are left out, since they never run."""
    for found in (statement for statement in told(source).statements if statement.runs):
        node = found.node
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield Import(alias.name, node.lineno, found.at_top, star=False)
        else:
            star = any(alias.name == "*" for alias in node.names)
            yield Import("." * node.level + (node.module or ""), node.lineno, found.at_top, star)


def faults(place: str, source: str) -> list[str]:
    """What is wrong with the imports of a file; ``place`` is its path, the room first."""
    room = place.split("/", maxsplit=1)[0]
    found = []
    for item in imports_of(source):
        top = item.name.split(".")[0]
        where = f"{place}:{item.line}: {item.name}"
        if not top:
            found.append(f"{where}: a relative import hides the room")
        elif top in ROOMS and top not in MAY_IMPORT[room]:
            found.append(f"{where}: imports run geometry <- parts <- exporters")
        elif top == "tests":
            found.append(f"{where}: nobody imports tests")
        elif top == "dataclasses":
            found.append(f"{where}: records are those of {RECORDS}")
        elif room == "geometry" and top in NOT_IN_GEOMETRY and (place, top) != (RECORDS, "msgspec"):
            found.append(f"{where}: geometry is mathematics only")
        elif item.at_top and top in HEAVY - HEAVY_AT_TOP.get(place, set()):
            found.append(f"{where}: heavy; import it in the function that needs it")
        elif top not in ROOMS and top not in sys.stdlib_module_names | LIGHT | HEAVY:
            found.append(f"{where}: not a library of this project")
        if item.star:
            found.append(f"{where}: import *")
    return found


def product_files() -> dict[str, Path]:
    """Every source file of the product by its place in the house."""
    return {f"{room}/{path.relative_to(folder).as_posix()}": path
            for room, folder in ROOMS.items() for path in sorted(folder.rglob("*.py"))}  # fmt: skip


def test_imports_run_one_way_and_late() -> None:
    found = [f for place, path in product_files().items() for f in faults(place, path.read_text(encoding="utf-8"))]
    assert found == []


def test_every_room_is_looked_at() -> None:
    places = product_files()
    assert {p.split("/", maxsplit=1)[0] for p in places} == set(ROOMS)
    assert {"geometry/gears/teeth/tooth.py", "parts/scene/load.py", "exporters/command/cli.py"} <= set(places)


@pytest.mark.parametrize(("place", "source"), [
    ("geometry/new.py", "from parts.base.part import Part"),
    ("geometry/new.py", "import exporters"),
    ("geometry/gears/new.py", "def f():\n    from parts import part"),
    ("parts/new.py", "from exporters.formats.job import Job"),
    ("parts/new.py", "class A:\n    def f(self):\n        import exporters.command.cli"),
    ("geometry/new.py", "import os"),
    ("geometry/new.py", "from pathlib import Path"),
    ("geometry/new.py", "def f():\n    import shapely"),
    ("geometry/new.py", "import math, json"),
    ("geometry/new.py", "from dataclasses import dataclass"),
    ("exporters/new.py", "def f():\n    from dataclasses import replace"),
    ("exporters/command/new.py", "import ezdxf"),
    ("exporters/command/new.py", "try:\n    import shapely\nexcept ImportError:\n    shapely = None"),
    ("exporters/command/new.py", "class A:\n    from rich.table import Table"),
    ("exporters/formats/dxf_file.py", "import shapely"),
    ("exporters/formats/laser_dxf.py", "import ezdxf"),
    ("parts/new.py", "from tests.laws import check"),
    ("parts/new.py", "from geometry.base.errors import *"),
    ("parts/new.py", "from . import keys"),
    ("parts/new.py", "import pydantic"),
])  # fmt: skip
def test_a_forbidden_import_is_noticed(place: str, source: str) -> None:
    assert len(faults(place, source)) == 1


@pytest.mark.parametrize(("place", "source"), [
    ("exporters/new.py", "from geometry.base.errors import GeometryError\nfrom parts.scene import load\nimport os"),
    ("exporters/command/new.py", "def f():\n    import ezdxf\n    import shapely"),
    ("exporters/command/new.py", "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import ezdxf"),
    ("exporters/formats/dxf_file.py", "import ezdxf\nfrom ezdxf.document import Drawing"),
    ("geometry/new.py", "import math\nimport numpy as np\nfrom geometry.errors import GeometryError"),
])  # fmt: skip
def test_an_allowed_import_is_allowed(place: str, source: str) -> None:
    assert faults(place, source) == []
