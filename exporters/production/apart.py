"""Work in a process apart: a long call into the CAD kernel answers no signal, the process that waits for it does.

Python runs a signal handler between two of its own instructions only, and one call of the kernel may last many seconds.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Sequence
from pathlib import Path

# show the cursor again, which a progress bar hides, and clear the bar's line
_SHOW_CURSOR = "\x1b[?25h\r\x1b[K"
_DIE_WITH_PARENT = 1


def work_apart(stops: list[signal.Signals], folders: Sequence[Path], failed: int) -> None:
    """Return in a child process, where ``stops`` are ignored; the caller waits for it and ends as it does.

    A child that is killed or crashes leaves nothing half-written in ``folders``; the caller then ends with ``failed``.
    On macOS, where a fork is not safe, on Windows, and where threads run, the caller itself returns: there a signal
    waits until the kernel's call is over.

    Raises
    ------
    KeyboardInterrupt
        In the waiting process: one of ``stops`` came. The child is killed and cleaned up after.
    """
    if not hasattr(os, "fork") or sys.platform == "darwin" or threading.active_count() > 1:
        return
    from exporters.production.moving import missing_folders

    missing = [gone for folder in folders for gone in missing_folders(folder)]
    sys.stdout.flush()
    sys.stderr.flush()
    parent = os.getpid()
    signal.pthread_sigmask(signal.SIG_BLOCK, stops)
    child = os.fork()
    if child == 0:
        for stop in stops:
            signal.signal(stop, signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, stops)
        _end_with(parent)
        return
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, stops)
        _, status = os.waitpid(child, 0)
    except BaseException:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        _clean_up(folders, missing)
        raise
    code = os.waitstatus_to_exitcode(status)
    if code < 0:
        _clean_up(folders, missing)
        crash = f"the CAD kernel has crashed (signal {-code})"
        sys.stderr.write(f"higherpair: {crash}; nothing half-written is left\n")
        sys.stderr.flush()
        code = failed
    os._exit(code)


def _clean_up(folders: Sequence[Path], missing: list[Path]) -> None:
    """Remove what a dead child was writing, and folders that it made and left empty."""
    from exporters.production.moving import clear, remove_empty

    if sys.stdout.isatty():
        sys.stdout.write(_SHOW_CURSOR)
        sys.stdout.flush()
    for folder in folders:
        clear(folder)
    remove_empty(missing)


def _end_with(parent: int) -> None:
    """Ask the system to kill this process when its parent is killed; only Linux can."""
    if sys.platform != "linux":
        return
    import ctypes

    try:
        ctypes.CDLL(None).prctl(_DIE_WITH_PARENT, signal.SIGKILL)
    except (OSError, AttributeError):
        return
    if os.getppid() != parent:
        os._exit(1)
