"""Files of others: read only if they are files, and no further than what is allowed."""

from __future__ import annotations

import errno
import os
from pathlib import Path


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
        raise NotAFileError(errno.EINVAL, "a pipe or a device, not a file", str(path))
    with path.open("rb") as stream:
        return stream.read(min(most, os.fstat(stream.fileno()).st_size) + 1)
