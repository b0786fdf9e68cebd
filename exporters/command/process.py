"""A command as a process: streams that cannot fail, signals that stop it at any place, and its quick end."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from types import FrameType
from typing import Any, NoReturn, TextIO

INTERRUPTED = 130


def stoppable(run: Callable[[], int]) -> int:
    """Run a command, which signals may stop; returns its exit code."""
    _prepare_streams()
    previous: dict[signal.Signals, Any] = {}
    told_lost, sys.unraisablehook = sys.unraisablehook, _lost
    try:
        for stop in _stops():
            previous[stop] = signal.signal(stop, _stop)
        return run()
    except KeyboardInterrupt:
        return interrupted()
    finally:
        for stop, handler in previous.items():
            signal.signal(stop, handler)
        sys.unraisablehook = told_lost


def whole_process(main: Callable[[], int]) -> int:
    """A command that ends its process at once: to take apart what was loaded costs a tenth of a build."""
    try:
        code = main()
    except SystemExit as told:
        # help, the version, or a command line that means nothing
        code = int(told.code or 0)
    # what other processes need at the end is told by them
    if "multiprocessing" not in sys.modules:
        with suppress(OSError):
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    return code


def _prepare_streams() -> None:
    """Output that cannot fail: what a terminal lacks becomes ?, a file or a pipe gets UTF-8, a closed stream none."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, nowhere())
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding=None if stream.isatty() else "utf-8", errors="replace")


def nowhere() -> TextIO:
    """A stream that takes all and keeps nothing."""
    return open(os.devnull, "w", encoding="utf-8")


def _stops() -> list[signal.Signals]:
    """The signals that stop a command; a hang-up that somebody has turned off (nohup) stays off."""
    names = ("SIGINT", "SIGTERM", "SIGHUP")
    found = [getattr(signal, name) for name in names if hasattr(signal, name)]
    return [s for s in found if s.name != "SIGHUP" or signal.getsignal(s) != signal.SIG_IGN]


def _stop(number: int, frame: FrameType | None) -> None:
    """A signal handler that stops the command; within an import, as soon as that is over.

    A library that is stopped while it loads may do without what it was loading, and the stop would be lost.
    """
    importer = _outermost_import(frame)
    if importer is None:
        raise KeyboardInterrupt
    importer.f_trace = _stop_traced
    sys.settrace(lambda *_: None)


def _outermost_import(frame: FrameType | None) -> FrameType | None:
    """Who within ``stoppable`` has asked for the import that ``frame`` is a part of; None outside of imports."""
    importer = None
    while frame is not None and frame.f_code is not stoppable.__code__:
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            importer = frame.f_back
        frame = frame.f_back
    return importer


def _lost(found: sys.UnraisableHookArgs) -> None:
    """What Python cannot raise where it stands: a stop within a destructor is raised where that was called."""
    if not issubclass(found.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(found)
    elif (caller := sys._getframe().f_back) is not None:
        caller.f_trace = _stop_traced
        sys.settrace(lambda *_: None)


def _stop_traced(frame: FrameType, event: str, value: object) -> NoReturn:
    frame.f_trace = None
    sys.settrace(None)
    raise KeyboardInterrupt


def interrupted() -> int:
    """Tell that a command was stopped; its exit code."""
    # Python remembers a stop that came within exec(), which libraries use, and would end itself by SIGINT in place of
    # with our code; the next exec makes it forget
    exec("")
    print("higherpair: interrupted; nothing half-written is left", file=sys.stderr)
    return INTERRUPTED
