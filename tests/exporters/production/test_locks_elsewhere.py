"""Locks where a folder cannot be locked: a file of its own among the temporary ones; nothing is cleaned away."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from exporters.production.moving import alone_in, clear, staging_folder


class Console:
    """msvcrt, as far as it is used: who locks how much of which file."""

    LK_LOCK = 1

    def __init__(self) -> None:
        self.locked: list[tuple[str, int, int]] = []

    def locking(self, handle: int, mode: int, count: int) -> None:
        self.locked.append((Path(f"/proc/self/fd/{handle}").resolve().name, mode, count))


@pytest.fixture
def windows(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Console:
    """Windows, told so to the one file that asks."""
    console = Console()
    monkeypatch.setitem(sys.modules, "msvcrt", console)
    monkeypatch.setattr("exporters.production.moving.sys", SimpleNamespace(platform="win32"))
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    return console


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="names of open files come from /proc")
def test_each_folder_has_a_lock_of_its_own(windows: Console, tmp_path: Path) -> None:
    """One byte, waited for; the same folder however it is written, in any capitals."""
    one, two = tmp_path / "One", tmp_path / "two"
    one.mkdir()
    two.mkdir()
    for folder in (one, two, tmp_path / "two" / ".." / "One"):
        with alone_in(folder):
            pass
    names = [name for name, *_ in windows.locked]
    assert names[0] == names[2] != names[1]
    assert all(name.startswith("higherpair-") and name.endswith(".lock") for name in names)
    assert {row[1:] for row in windows.locked} == {(Console.LK_LOCK, 1)}
    assert {file.name for file in (tmp_path / "temporary").iterdir()} == set(names)


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="names of open files come from /proc")
def test_what_nobody_can_be_asked_about_stays(windows: Console, tmp_path: Path) -> None:
    """A folder of another process may be in use: none can tell without its lock."""
    folder = tmp_path / "o"
    (folder / ".building-1").mkdir(parents=True)
    clear(folder)
    with staging_folder(folder) as staging:
        assert staging.is_dir()
    assert (folder / ".building-1").is_dir()
    assert not staging.exists()


def test_elsewhere_what_nobody_holds_is_cleaned_away(tmp_path: Path) -> None:
    (tmp_path / ".building-1").mkdir()
    clear(tmp_path)
    assert not (tmp_path / ".building-1").exists()
