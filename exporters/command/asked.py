"""What the commands have in common: their scenes and language, lines on a terminal, pages and results."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

from parts.base.texts import ENGLISH, languages, words

if TYPE_CHECKING:
    from parts.scene.scene_file import SceneFile

# exit codes: done, a check failed, wrong input
DONE, FAILED, WRONG_INPUT = 0, 1, 2
S = TypeVar("S")
T = TypeVar("T")


def language_among(addresses: Sequence[str]) -> str:
    """The language of the first of some words that names a scene."""
    named = [one for one in addresses if one and "=" not in one and not one.startswith("-")]
    if not named:
        return ENGLISH
    from parts.scene.language import language_of

    return next((one for one in map(language_of, named) if one != ENGLISH), ENGLISH)


def language_of_command(options: Namespace) -> str:
    """The language of a command: that of --language or nearest to it, of the scene, or of one among words of calc."""
    from parts.scene.language import language_meant

    if options.language in languages():
        return str(options.language)
    asked = vars(options)
    if options.language and (close := language_meant(options.language)):
        return close
    return language_among([*asked.get("scenes", []), *filter(None, [asked.get("scene")]), *asked.get("words", [])])


def check_language(options: Namespace) -> None:
    """Refuse a language without a catalogue."""
    if options.language not in (None, *languages()):
        from parts.base.refusal import SceneError, meant

        known = languages()
        given = options.language
        raise SceneError(options.command, "--language", given, "not_one_of", meant(given, known), known=known)


def scene_of(address: str, options: Namespace) -> SceneFile:
    """A scene of a command, in its language."""
    from parts.scene.load import load_scene

    check_language(options)
    return load_scene(address, options.language)


def each(asked: Sequence[S], run: Callable[[S], T], language: Callable[[], str]) -> tuple[list[T], bool]:
    """Something of everything that is asked for, and whether one was refused, which is told in a language."""
    from parts.base.refusal import SceneError, sentence

    found, refused = [], False
    for one in asked:
        try:
            found.append(run(one))
        except SceneError as error:
            print(f"higherpair: {sentence(error, language())}", file=sys.stderr)
            refused = True
    return found, refused


def quoted(scenes: Sequence[str]) -> Sequence[str]:
    """The scenes that are asked for.

    Raises
    ------
    SceneError
        None is there, but the one that they name together: a name with blanks, without quotes.
    """
    from geometry.base.errors import Nearest
    from parts.base.refusal import SceneError
    from parts.scene.files import built_in_scenes

    built_in, whole = built_in_scenes(), " ".join(scenes)
    if len(scenes) < 2 or any(one in built_in or os.path.exists(one) for one in scenes):
        return scenes
    if (name := "_".join(scenes)) not in built_in and not os.path.isfile(whole):
        return scenes
    found = name if name in built_in else f'"{whole}"'
    raise SceneError(whole, "", None, "name_without_quotes", Nearest(found, "meant"))


def print_json(asked: Sequence[object], found: Sequence[object]) -> None:
    """One result as it is, several as a list; nothing where the only one was refused."""
    import json

    if found or len(asked) > 1:
        print(json.dumps(found[0] if len(asked) == 1 else found, indent=1, ensure_ascii=False))


@contextmanager
def progress_of(options: Namespace, name: str, total: int) -> Iterator[Callable[[str], None]]:
    """A bar on a terminal that wants one; what moves it on by one step, and says which."""
    if not sys.stdout.isatty() or options.quiet or options.json:
        yield lambda step: None
        return
    from rich.progress import Progress

    with Progress(transient=True) as bar:
        task = bar.add_task(name, total=total)
        yield lambda step: bar.update(task, advance=1, description=step)


def show_page(text: str, options: Namespace) -> None:
    """A text to the file that was asked for, or to the terminal."""
    if options.out is None:
        print(text, end="")
    else:
        from exporters.formats.whole import write_whole

        check_free_place(options)
        write_whole(options.out, text)
        print(words(language_of_command(options)).text("written: {file}", file=options.out))


def check_free_place(options: Namespace) -> None:
    """Refuse a file that exists already: before a page is made, which may take a while, and before it is written."""
    if options.out is not None:
        from exporters.formats.whole import check_free

        check_free(options.out, force=options.force)
