"""The command ``higherpair``. Exit codes: 0 done, 1 a check failed, 2 wrong input (one clear line)."""

from __future__ import annotations

import errno
import gc
import os
import sys
from argparse import Namespace
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from itertools import pairwise
from pathlib import Path

from exporters.command.asked import DONE, WRONG_INPUT, language_among, language_of_command
from exporters.command.grammar import grammar
from exporters.command.parser import Misused, parsed, speaking
from exporters.command.process import nowhere, stoppable, whole_process
from parts.base.texts import ENGLISH, N_, languages, words

# so many things are made between two searches for circles of them
_MADE = 100_000
_OURS = {"geometry", "parts", "exporters"}
# what a system says of a disk most often
_OF_SYSTEM = (
    N_("No such file or directory"), N_("Permission denied"), N_("Is a directory"), N_("Not a directory"),
    N_("No space left on device"), N_("Read-only file system"), N_("File name too long"), N_("File exists"),
    N_("Operation not permitted"),
)  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    # numpy is not loaded yet: its threads would take longer to start than all that we compute
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # of a million things that a build makes hardly one is part of a circle: to look for those less often saves time
    gc.set_threshold(_MADE)
    asked = list(sys.argv[1:] if arguments is None else arguments)
    # cmd, and zsh where somebody types, hand on what other shells take for a comment
    asked = asked[: asked.index("#")] if "#" in asked else asked
    return stoppable(lambda: _ended(_parsed(asked)))


def run() -> int:
    """``main`` as a process of its own."""
    return whole_process(main)


def _ended(options: Namespace) -> int:
    """The exit code of a command; a refusal is told here, as the search for what would work may be stopped too."""
    try:
        code = import_module(f"exporters.command.{options.command}").run(options)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        # whoever read the output has left: nothing more can be said to it
        sys.stdout = nowhere()
        return DONE
    except (OSError, MemoryError, ImportError) as error:
        if (text := _outside(error, options)) is None:
            raise
        print(f"higherpair: {text}", file=sys.stderr)
        return WRONG_INPUT
    except ValueError as error:
        from parts.base.refusal import SceneError, sentence

        if not isinstance(error, SceneError):
            raise
        print(f"higherpair: {sentence(error, language_of_command(options))}", file=sys.stderr)
        return WRONG_INPUT


def _outside(error: OSError | MemoryError | ImportError, options: Namespace) -> str | None:
    """What a disk, a memory or an installation that is not enough is told by; None of an import of our own."""
    told = words(ENGLISH)
    # a memory that is full may hold no other language
    with suppress(OSError, MemoryError, ImportError):
        told = words(language_of_command(options))
    if isinstance(error, ImportError):
        library = _library(error)
        return library and told.text(
            "{library} cannot be loaded: it is not installed whole, or the memory does not suffice", library=library
        )
    if isinstance(error, MemoryError) or error.errno == errno.ENOMEM:
        return told.text("the memory does not suffice; a larger tolerance or fewer parts need less")
    why = told.text(error.strerror or str(error))
    why = f"{error.filename}: {why}" if error.filename else why
    if "out" in options:
        return told.text("{why}; choose another place with --out", why=why)
    return told.text("{why}; choose another place", why=why)


def _library(error: BaseException | None) -> str | None:
    """The library that could not be imported; None where it is one of our packages."""
    while error is not None:
        file, name = Path(getattr(error, "path", None) or ""), getattr(error, "name", None) or ""
        # a shared library tells its own name without that of its package
        beneath = [file.relative_to(place).parts for place in sys.path if place and file.is_relative_to(place)]
        library = min(beneath, key=len)[0] if beneath else name.partition(".")[0]
        if library and library not in _OURS:
            return library
        error = error.__cause__ or error.__context__
    return None


def _parsed(arguments: list[str]) -> Namespace:
    """The command line; what argparse says is told in ``--language``, else in the scene's, never the terminal's."""
    given = [one for flag, one in pairwise(arguments) if flag == "--language"]
    given += [one.partition("=")[2] for one in arguments if one.startswith("--language=")]
    if not given and not {"-h", "--help"} & {*arguments}:
        try:
            with speaking(words(ENGLISH)):
                return parsed(grammar(words(ENGLISH)), arguments)
        except Misused:
            # to be told again, in the language of the scene
            pass
    # the first is the command
    asked = given[-1] if given else language_among(arguments[1:])
    told = words(asked if asked in languages() else ENGLISH)
    with speaking(told):
        try:
            return parsed(grammar(told), arguments)
        except Misused as misused:
            print(misused, file=sys.stderr)
            sys.exit(WRONG_INPUT)
