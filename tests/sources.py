"""What the guards read of a source: every file is parsed once for all of them, and only what they ask for is kept."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from geometry.curves.curve import Curve

CURVE_METHODS = {name for name in vars(Curve) if not name.startswith("_")}
# the marks of parts/base/texts.py and what their first words are: a context, a text, its plural
_MARKS = {
    "N_": "t",
    "NC_": "ct",
    "message": "t",
    "fault": "t",
    # behind what must hold
    "unless": "-t",
    "counted": "tp",
    "in_context": "ct",
    ".unless": "-t",
    ".text": "t",
    ".plural": "tp",
    ".term": "ct",
    ".note": "t",
    ".section": "t",
}
# what refuses, and which of its arguments is the code
REFUSE = {"SceneError": 3, "ParameterError": 2, "UndercutError": 2, "PointedTipError": 2, "OffsetError": 1}
_REFUSAL = re.compile(rf"\b({'|'.join(REFUSE)})(\.beyond)?\(")
_MARK = re.compile("|".join(rf"{re.escape(name)}\s*\(" for name in _MARKS))


@dataclass(frozen=True)
class Statement:
    """An import statement; ``runs`` at all, that is not for type checkers alone, and when the file is loaded."""

    node: ast.Import | ast.ImportFrom
    runs: bool
    at_top: bool


@dataclass(frozen=True)
class Told:
    """Import statements anywhere in a file; lines and names of what says nothing of itself, a module's line 0; texts
    that are marked for translation: context, text, plural or ""; refusals, each with its code."""

    statements: tuple[Statement, ...]
    undocumented: tuple[tuple[int, str], ...]
    marked: tuple[tuple[str | None, str, str], ...]
    refusals: tuple[tuple[ast.Call, ast.expr], ...]


@cache
def told(source: str) -> Told:
    """All four of one file."""
    tree = ast.parse(source)
    statements = tuple(_statements(tree, runs=True, at_top=True))
    # a file without the names of marks has none
    marked = tuple(_marked(tree)) if _MARK.search(source) else ()
    refusals = tuple(_refusals(tree)) if _REFUSAL.search(source) else ()
    return Told(statements, tuple(_undocumented(tree)), marked, refusals)


def _statements(node: ast.AST, *, runs: bool, at_top: bool) -> Iterator[Statement]:
    for name, value in ast.iter_fields(node):
        for_types = name == "body" and isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)
        for child in value if isinstance(value, list) else ():
            if isinstance(child, ast.Import | ast.ImportFrom):
                yield Statement(child, runs and not for_types, at_top)
            # expressions hold no statement
            elif isinstance(child, ast.stmt | ast.ExceptHandler | ast.match_case):
                inside = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
                yield from _statements(child, runs=runs and not for_types, at_top=at_top and not inside)


def _undocumented(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """The module, classes and functions that others may use.

    What begins with an underscore or stands inside a function is private; methods of the Curve protocol are told there.
    """
    if not ast.get_docstring(tree):
        yield 0, "module"
    queue: list[ast.stmt] = list(tree.body)
    while queue:
        node = queue.pop(0)
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) or node.name.startswith("_"):
            continue
        if isinstance(node, ast.ClassDef):
            queue += node.body
        if not ast.get_docstring(node) and node.name not in CURVE_METHODS:
            yield node.lineno, node.name


def _marked(tree: ast.Module) -> Iterator[tuple[str | None, str, str]]:
    """What the marks in the code name, where it is written out there."""
    for call in calls(tree):
        if shape := _MARKS.get(_called(call), ""):
            words = [a.value if isinstance(a, ast.Constant) else None for a in call.args[: len(shape)]]
            found = dict(zip(shape, words, strict=False))
            if isinstance(text := found.get("t"), str) and text:
                context, many = found.get("c"), found.get("p")
                yield context if isinstance(context, str) else None, text, many if isinstance(many, str) else ""


def _refusals(tree: ast.Module) -> Iterator[tuple[ast.Call, ast.expr]]:
    for call in calls(tree):
        # a bare name, or its ``beyond``
        func = call.func.value if isinstance(call.func, ast.Attribute) and call.func.attr == "beyond" else call.func
        at = REFUSE.get(func.id) if isinstance(func, ast.Name) else None
        if at is not None and len(call.args) > at:
            yield call, call.args[at]


def calls(tree: ast.AST) -> Iterator[ast.Call]:
    """Every call in a tree, as ``ast.walk`` has them, in a third of its time."""
    queue = [tree]
    while queue:
        node = queue.pop()
        if isinstance(node, ast.Call):
            yield node
        for value in vars(node).values():
            if isinstance(value, list):
                queue += [one for one in value if isinstance(one, ast.AST)]
            # names alone hold nothing
            elif isinstance(value, ast.AST) and not isinstance(value, ast.Name | ast.expr_context):
                queue.append(value)


def _called(call: ast.Call) -> str:
    """The name of what is called, with a point before that of a method."""
    if isinstance(call.func, ast.Attribute):
        return f".{call.func.attr}"
    return call.func.id if isinstance(call.func, ast.Name) else ""
