"""A set of files, made in a folder beside its place and moved into it as one: all of it, or nothing.

``.building-PID`` holds what is being made. To be moved it becomes ``.moving``: it lists its files, and what they
replace waits in it. Whoever finds it, alone in the folder, puts all of that back. The last file of a set, the report,
is the first to go away and the last to come: there is none beside other files than its own.
"""

from __future__ import annotations

import errno
import hashlib
import json
import os
import shutil
import signal
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

_STAGING = ".building-"
_MOVING = ".moving"
_NAMES, _REPLACED = ".names", ".replaced"


@contextmanager
def staging_folder(folder: Path) -> Iterator[Path]:
    """A folder within ``folder`` that is gone afterwards; ``folder`` itself goes too if nothing came into it."""
    created = missing_folders(folder)
    staging = folder / f"{_STAGING}{os.getpid()}"
    with ExitStack() as done:
        done.callback(remove_empty, created)
        folder.mkdir(parents=True, exist_ok=True)
        with alone_in(folder):
            _remove_abandoned(folder)
            staging.mkdir()
            done.enter_context(_locked(staging))
            done.callback(_remove, staging)
            done.callback(_settle, folder)
        try:
            yield staging
        except OSError as error:
            # a disk that is full says so where something is written, not where a file is opened
            if error.filename is None and error.strerror:
                error.filename = str(folder)
            raise


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """One process at a time, and no signal, gets here; what a killed one has half moved is put back first."""
    with _locked(folder), _unstopped():
        _put_back(folder)
        yield


def move_into(folder: Path, staging: Path, names: list[str]) -> None:
    """Move finished files into their place; called alone in ``folder``, and within its ``staging_folder``.

    Refused before the first move where a folder stands in the way. What an error leaves half moved is put back as
    ``staging_folder`` ends, after a kill by the next one. What was replaced is gone afterwards.
    """
    for name in names:
        if (folder / name).is_dir():
            raise IsADirectoryError(errno.EISDIR, "a folder stands where a file should go", str(folder / name))
    (staging / _REPLACED).mkdir()
    (staging / _NAMES).write_text(json.dumps(names), encoding="utf-8")
    moving = folder / _MOVING
    staging.rename(moving)
    _set_aside(folder, names[-1])
    for name in names:
        _set_aside(folder, name)
        os.replace(moving / name, folder / name)
    moving.rename(staging)
    # here, where no stop comes between
    _remove(staging)


def clear(folder: Path) -> None:
    """Put back, or remove, what builds that were killed have left half done in a folder."""
    if folder.is_dir():
        with alone_in(folder):
            _remove_abandoned(folder)


def missing_folders(folder: Path) -> list[Path]:
    """A folder and those above it that do not exist yet, the innermost first."""
    return [p for p in (folder, *folder.parents) if not p.exists()]


def remove_empty(created: list[Path]) -> None:
    """Remove those folders, the innermost first, that nothing came into."""
    for place in created:
        if place.is_dir() and not any(place.iterdir()):
            place.rmdir()


def is_half_moved(folder: Path) -> bool:
    """Whether files are on their way into a folder, or a build was killed while they were."""
    return _is_ours(folder / _MOVING)


def _settle(folder: Path) -> None:
    if is_half_moved(folder):
        with alone_in(folder):
            pass


def _set_aside(folder: Path, name: str) -> None:
    if os.path.lexists(folder / name):
        os.replace(folder / name, folder / _MOVING / _REPLACED / name)


def _put_back(folder: Path) -> None:
    """Undo a half-done move: each of its files is either in the moving folder still, or in its place."""
    if not is_half_moved(folder):
        return
    moving = folder / _MOVING
    names = _listed(moving / _NAMES)
    for name in reversed(names):
        if not (moving / name).exists():
            with suppress(FileNotFoundError):
                os.replace(folder / name, moving / name)
    for name in names:
        if os.path.lexists(moving / _REPLACED / name):
            os.replace(moving / _REPLACED / name, folder / name)
    # under a name that nobody puts back: its removal may be stopped too
    undone = folder / f"{_STAGING}{os.getpid()}-undone"
    moving.rename(undone)
    _remove(undone)


def _listed(file: Path) -> list[str]:
    """The files that a list names, without what leads out of their folder."""
    try:
        names = json.loads(file.read_text("utf-8"))
    except (ValueError, RecursionError):
        names = None
    if not (isinstance(names, list) and all(isinstance(name, str) and "\0" not in name for name in names)):
        raise OSError(errno.EINVAL, "a damaged list of files", str(file))
    return [name for name in names if name not in ("", "..") and Path(name).name == name]


def _remove(staging: Path) -> None:
    with _unstopped():
        if _is_ours(staging):
            shutil.rmtree(staging)


def _is_ours(place: Path) -> bool:
    """We make folders: a link of such a name leads to what is somebody else's."""
    return place.is_dir() and not place.is_symlink()


def _remove_abandoned(folder: Path) -> None:
    for place in folder.glob(f"{_STAGING}*"):
        if _is_ours(place) and _is_abandoned(place):
            _remove(place)


def _is_abandoned(place: Path) -> bool:
    """Whether nobody holds a folder; told by its lock: a dead process may keep its number."""
    if sys.platform == "win32":
        return False
    import fcntl

    handle = os.open(place, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    finally:
        os.close(handle)
    return True


@contextmanager
def _unstopped() -> Iterator[None]:
    """Signals that would stop the command wait: a second one must not stop the cleaning up after the first."""
    if sys.platform == "win32":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which the system takes back when its holder dies."""
    if sys.platform == "win32":
        # a folder cannot be locked there, and a file in it would stay
        import msvcrt
        import tempfile

        mark = hashlib.sha256(str(folder.resolve()).lower().encode("utf-8", "surrogatepass")).hexdigest()[:16]
        with (Path(tempfile.gettempdir()) / f"higherpair-{mark}.lock").open("ab") as stream:
            msvcrt.locking(stream.fileno(), msvcrt.LK_LOCK, 1)
            yield
        return
    import fcntl

    handle = os.open(folder, os.O_RDONLY)
    try:
        # some network disks lock nothing: two builds at once on them are the user's to avoid
        with suppress(OSError):
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def hash_of(file: Path) -> str:
    """The SHA-256 of a file's bytes, by which reports know it."""
    return hashlib.sha256(file.read_bytes()).hexdigest()
