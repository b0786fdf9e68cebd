"""The house rules on docstrings and the top level, each with a negative control."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from tests.sources import told
from tests.test_architecture import product_files

ROOT = Path(__file__).resolve().parent.parent
# DESIGN, section 3: what the card names, five pages, a licence, and dot-files
TOP_LEVEL = {
    "pyproject.toml", "geometry", "exporters", "parts", "tests", "out", "README.md", "README.uk.md", "LICENSE",
    "MANIFEST.in", "CHANGELOG.md", "CONTRIBUTING.md", "CONVENTIONS.md", "DERIVATIONS.md",
}  # fmt: skip
TEXT = {".py", ".md", ".toml", ".svg", ".txt", ".cfg", ".yml", ".yaml"}


def undocumented(place: str, source: str) -> list[str]:
    """Modules, classes and functions that others may use and that say nothing of themselves."""
    return [f"{place}: {name}" if line == 0 else f"{place}:{line}: {name}" for line, name in told(source).undocumented]


def tracked() -> list[str]:
    """Files of the repository; skipped where there is none, as in an unpacked archive."""
    done = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode or not done.stdout:
        pytest.skip("not a git repository")
    return done.stdout.splitlines()


def strangers(paths: list[str]) -> set[str]:
    """Top-level names that the design does not know."""
    names = {p.split("/", maxsplit=1)[0] for p in paths}
    return {n for n in names if n not in TOP_LEVEL and not n.startswith(".")}


def test_every_file_says_what_it_is() -> None:
    found: list[str] = []
    for place, path in product_files().items():
        source = path.read_text(encoding="utf-8")
        found += undocumented(place, source)
    assert found == []


def test_test_files_say_what_they_test() -> None:
    for path in sorted((ROOT / "tests").rglob("*.py")):
        assert path.read_text(encoding="utf-8").startswith('"""'), path


def test_every_test_folder_is_a_package() -> None:
    folders = {p.parent for p in (ROOT / "tests").rglob("*.py")}
    assert {f for f in folders if not (f / "__init__.py").is_file()} == set()


def test_the_top_level_holds_only_what_the_design_names() -> None:
    paths = tracked()
    assert strangers(paths) == set()
    assert {"pyproject.toml", "README.md", "LICENSE", "geometry", "exporters", "parts", "tests", "out"} <= {
        p.split("/", maxsplit=1)[0] for p in paths
    }
    assert [p for p in paths if p.startswith("out/")] == ["out/.gitignore"]


def test_no_file_names_a_place_on_somebodys_machine() -> None:
    pattern = re.compile(r"/(?:home|Users|work|root)/\w|[A-Z]:\\\\?Users")
    for name in tracked():
        path = ROOT / name
        if path.suffix in TEXT and path.is_file() and path != Path(__file__):
            found = pattern.search(path.read_text(encoding="utf-8"))
            assert not found, f"{name}: {found}"


def test_the_checks_notice_what_is_wrong() -> None:
    assert undocumented("x.py", "a = 1") == ["x.py: module"]
    assert undocumented("x.py", '"""M."""\ndef f():\n    pass') == ["x.py:2: f"]
    assert undocumented("x.py", '"""M."""\nclass A:\n    """C."""\n    def f(self):\n        pass') == ["x.py:4: f"]
    assert undocumented("x.py", '"""M."""\ndef _f():\n    pass\nclass _A:\n    def f(self): ...') == []
    assert strangers(["docs/a.md", "setup.py", "geometry/x.py", ".ci/run"]) == {"docs", "setup.py"}
