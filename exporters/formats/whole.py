"""Files written where the command was told to: what is there already is refused; all of them come, or nothing."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def check_free(file: Path, *, force: bool = False) -> None:
    """Refuse a file that exists already: what it holds may be somebody's work. ``force``: only what is no plain file.

    Raises
    ------
    SceneError
        It exists, or is a folder.
    """
    is_plain = file.is_file() and not file.is_symlink()
    if (file.exists() or file.is_symlink()) and not (force and is_plain):
        from parts.base.refusal import SceneError

        code = "folder_for_file" if file.is_dir() else "file_exists" if is_plain else "no_plain_file"
        raise SceneError(str(file), "", None, code)


@contextmanager
def beside(file: Path) -> Iterator[Path]:
    """A folder whose files come to stand beside a file once all are made; where one fails, what was there stays."""
    folder = file.with_name(f".writing-{os.getpid()}-{file.name}")
    try:
        folder.mkdir()
        yield folder
        for made in sorted(folder.iterdir()):
            os.replace(made, file.parent / made.name)
    except OSError as error:
        raise type(error)(error.errno, error.strerror, str(file)) from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def write_whole(file: Path, text: str) -> None:
    """Write a text in UTF-8: all of it, or nothing and what was there stays."""
    with beside(file) as folder:
        (folder / file.name).write_text(text, encoding="utf-8", newline="\n")
