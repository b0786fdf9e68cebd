"""No import goes round in a circle, none goes up the house, no private name is taken across files.

Imports within functions and those for type checkers count like any other. Each rule has a negative control.
"""

from __future__ import annotations

import ast
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import exporters
import geometry
import parts
from tests.sources import told

# from the ground up: a room may import its own package's rooms below it, and what it holds itself
STOREYS = (
    "geometry.base", "geometry.curves", "geometry.laws", "geometry.kinematics", "geometry.plane",
    "geometry.approximation", "geometry.solids", "geometry.gears", "geometry.cams",
    "parts.locale", "parts.solids", "parts.base", "parts.reasons", "parts.texts", "parts.keys", "parts.drawing",
    "parts.pages", "parts.bodies", "parts.gears", "parts.pins", "parts.ratchets", "parts.chains", "parts.belts",
    "parts.cams", "parts.mates",
    "parts.recipes", "parts.scene", "parts.outside",
    "exporters.formats", "exporters.verification", "exporters.drawings", "exporters.documents", "exporters.boards",
    "exporters.production", "exporters.command", "exporters.__main__",
)  # fmt: skip
Source = dict[str, str]


def sources() -> Source:
    """Every module of the product by its full name, with its text."""
    found = {}
    for package in (geometry, parts, exporters):
        folder = Path(package.__file__ or "").parent
        for file in sorted(folder.rglob("*.py")):
            words = (package.__name__, *file.relative_to(folder).with_suffix("").parts)
            found[".".join(w for w in words if w != "__init__")] = file.read_text(encoding="utf-8")
    return found


def imports(text: str, modules: Source) -> Iterator[tuple[str, str]]:
    """Every module of the house that a text imports, anywhere in it, with the name that is taken of it or ""."""
    for node in (statement.node for statement in told(text).statements):
        if isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                if whole in modules:
                    yield whole, ""
                elif node.module in modules:
                    yield node.module, alias.name
        elif isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name in modules:
                    yield alias.name, ""


def circles(modules: Source) -> list[list[str]]:
    """The groups of modules that import each other in a circle (Tarjan's strongly connected components)."""
    edges = {name: sorted({m for m, _ in imports(text, modules)}) for name, text in modules.items()}
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found = []

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in edges[name]:
            if other not in index:
                visit(other)
            if other in stack:
                low[name] = min(low[name], low[other])
        if low[name] == index[name]:
            at = stack.index(name)
            group = stack[at:]
            del stack[at:]
            if len(group) > 1 or name in edges[name]:
                found.append(sorted(group))

    for name in edges:
        if name not in index:
            visit(name)
    return found


def room_of(module: str) -> str:
    """The room that a module stands in: the first two words of its name."""
    return ".".join(module.split(".")[:2])


def upward(modules: Source) -> list[str]:
    """Imports of a room above."""
    height = {room: number for number, room in enumerate(STOREYS)}
    found = []
    for name, text in modules.items():
        for other, _ in imports(text, modules):
            here, there = room_of(name), room_of(other)
            if "." not in there or here == there:
                continue
            if here not in height or there not in height or height[there] > height[here]:
                found.append(f"{name} imports {other}")
    return sorted(set(found))


def privates(modules: Source) -> list[str]:
    """Names with a leading underscore that are taken from another file."""
    return sorted(
        f"{name} takes {taken} of {other}"
        for name, text in modules.items()
        for other, taken in imports(text, modules)
        if taken.startswith("_") and not taken.startswith("__") and other != name
    )


def test_no_import_goes_round() -> None:
    assert circles(sources()) == []


def test_no_import_goes_up() -> None:
    assert upward(sources()) == []


def test_no_private_name_is_taken() -> None:
    assert privates(sources()) == []


def test_every_room_has_its_storey() -> None:
    rooms = {room_of(name) for name in sources() if name.count(".") > 1}
    assert rooms <= set(STOREYS), sorted(rooms - set(STOREYS))


def test_a_circle_is_noticed() -> None:
    lazy = {
        "geometry.base.a": "def f():\n    from geometry.base.b import x",
        "geometry.base.b": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import geometry.base.a",
        "geometry.base.c": "from geometry.base.a import f",
    }
    assert circles(lazy) == [["geometry.base.a", "geometry.base.b"]]
    assert circles(lazy | {"geometry.base.b": ""}) == []
    chain = {"x.a": "import x.b", "x.b": "from x import c", "x.c": "from x.a import y"}
    assert circles(chain) == [["x.a", "x.b", "x.c"]]


def test_a_way_up_is_noticed() -> None:
    up = {"geometry.base.a": "def f():\n    from geometry.curves.b import x", "geometry.curves.b": ""}
    assert upward(up) == ["geometry.base.a imports geometry.curves.b"]
    assert upward({"geometry.base.a": "", "geometry.curves.b": "from geometry.base.a import x"}) == []
    assert upward({"parts.cellar.a": "import geometry.base.b", "geometry.base.b": ""}) != []


def test_a_private_name_is_noticed() -> None:
    taken = {"geometry.base.a": "_x = 1", "geometry.base.b": "from geometry.base.a import _x, y"}
    assert privates(taken) == ["geometry.base.b takes _x of geometry.base.a"]


def test_every_import_is_seen() -> None:
    seen = defaultdict(set)
    modules = sources()
    for name, text in modules.items():
        for other, _ in imports(text, modules):
            seen[name].add(other)
    assert {"geometry.base.errors", "parts.base.refusal"} <= seen["parts.base.kind"]
