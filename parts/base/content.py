"""Files of others: read only if they are files, and no further than what is allowed."""

from __future__ import annotations

import errno
import os
from pathlib import Path, PurePosixPath

from parts.base.texts import N_, Message


class NotAFileError(OSError):
    """A pipe, which might never begin, or a device, which might never end."""


def content(path: Path, most: int) -> bytes:
    """The bytes of a file; one more than ``most`` where it is larger.

    Raises
    ------
    OSError
        It cannot be read; ``NotAFileError``: it is none.
    """
    if path.exists() and not path.is_file() and not path.is_dir():
        raise NotAFileError(errno.EINVAL, N_("a pipe or a device, not a file"), str(path))
    with path.open("rb") as stream:
        return stream.read(min(most, os.fstat(stream.fileno()).st_size) + 1)


def content_beside(name: str, folder: Path, most: int) -> bytes:
    """The bytes of a file in a folder, or in one below it; one more than ``most`` where it is larger.

    Raises
    ------
    ParameterError
        ``file``: it lies elsewhere, or cannot be read.
    """
    # the language of a scene is read without it
    from geometry.base.errors import ParameterError

    told = PurePosixPath(name.replace("\\", "/"))
    if told.is_absolute() or ":" in name or ".." in told.parts:
        raise ParameterError("file", name, "file_elsewhere")
    try:
        path = (folder / told).resolve()
        if not path.is_relative_to(folder.resolve()):
            raise ParameterError("file", name, "file_elsewhere")
        return content(path, most)
    except FileNotFoundError:
        raise ParameterError("file", name, "no_such_file") from None
    except (NotAFileError, OSError, ValueError) as error:
        raise ParameterError(
            "file", name, "unreadable", None, why=Message(getattr(error, "strerror", None) or str(error))
        ) from None
