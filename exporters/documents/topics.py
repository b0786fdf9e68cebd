"""The topics of ``higherpair calc``: which file makes the sheet of each, and how it is asked for."""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from exporters.documents.render import FORMATS, render
from exporters.formats.whole import beside, check_free
from geometry.base.errors import TOLD, Nearest, ParameterError
from parts.base.fields import fields_of
from parts.base.offers import MOST_OFFERS
from parts.base.psv import rows_of
from parts.base.readback import ReadError
from parts.base.refusal import SceneError, Typed, meant, placed
from parts.base.registry import KINDS
from parts.base.schema import as_written, number_in, plain_numbers, steps_of
from parts.base.texts import Words, languages
from parts.base.texts import words as told
from parts.pages.inputs import GEARS, PLACE, table_of
from parts.pages.page import Picture, Sheet
from parts.scene.files import built_in_scenes

if TYPE_CHECKING:
    from parts.drawing.expected import Expected

# what is measured off sheets may be off by this, mm on paper
_PAPER_TOLERANCE = 0.001
# the module of each, and the name of its keys there
TOPICS = {topic: (module, keys) for topic, module, keys in rows_of(__file__, "topics")}


def keys_of_topic(topic: str) -> tuple[type[Struct], Sequence[tuple[str, str]]]:
    """The keys of a topic, each with its meaning; and what is typed for other kinds of part, with the kind.

    Raises
    ------
    SceneError
        A wrong topic.
    """
    module = importlib.import_module(_home(topic))
    keys: type[Struct] = getattr(module, TOPICS[topic][1]) if topic in TOPICS else KINDS[topic].keys
    return keys, getattr(module, "OTHER_KINDS", ())


def calculate(topic: str, words: Sequence[str], form: str, language: str | None, *, force: bool = False) -> str:
    """The rendered calculation of a topic; ``words`` are at most one scene and any number of key=value.

    ``force``: pictures and sheets may take the place of files.

    Raises
    ------
    SceneError
        A wrong topic, key or value, with the nearest that works.
    """
    _home(topic)
    for name, value, known in (("--format", form, FORMATS), ("--language", language, languages())):
        if value is not None and value not in known:
            raise SceneError(PLACE, name, value, "not_one_of", meant(value, known), known=known)
    sheet, spoken = sheet_of(topic, words, language)
    language = language or spoken
    for asked in (sheet.picture_file, sheet.paper_file):
        if asked is not None:
            check_free(Path(asked), force=force)
    if sheet.picture_file is not None and sheet.picture is not None:
        _write_picture(sheet.picture, Path(sheet.picture_file), told(language))
    if sheet.paper_file is not None and sheet.paper is not None:
        _write_paper(sheet.paper(language), Path(sheet.paper_file), told(language).say(sheet.title), topic, force=force)
    if form == "csv" and not sheet.tables:
        raise SceneError(PLACE, "--format", form, "no_tables", Nearest("json"))
    return render(sheet, form, language)


def _home(topic: str) -> str:
    """The module of a topic: one of ours, or the page of a kind of part that goes by its own name."""
    home = TOPICS[topic][0] if topic in TOPICS else KINDS[topic].page if topic in KINDS else None
    if home is None:
        see = "higherpair calc --help"
        raise SceneError(
            PLACE, Typed("TOPIC"), topic, "unknown_topic", meant(topic, TOPICS), known=list(TOPICS), see=see
        )
    return home


def _write_picture(picture: Picture, file: Path, words: Words) -> None:
    """Write a picture as the ending of its file says."""
    from parts.pages.contour_picture import ContourPicture

    with beside(file) as folder:
        if file.suffix.lower() == ".dxf" and isinstance(picture, ContourPicture):
            from exporters.documents.contour_dxf import write_contour_dxf

            write_contour_dxf(folder / file.name, picture.contour, picture.shown(words), words)
        else:
            (folder / file.name).write_text(picture.svg(words), encoding="utf-8", newline="\n")


def _write_paper(pages: Sequence[Expected], file: Path, title: str, topic: str, *, force: bool) -> None:
    """Write sheets, all into one PDF, else into files with their numbers; each is read back and measured.

    Raises
    ------
    SceneError
        What writes PDF is not installed.
    ReadError
        A file is not what it should be; none is left there.
    """
    from exporters.drawings.sheets import write_sheets
    from exporters.drawings.verify import verify_sheets

    if file.suffix.lower() == ".pdf":
        from exporters.drawings.pdf import check_pdf

        try:
            check_pdf(_PAPER_TOLERANCE)
        except ParameterError as error:
            raise placed(PLACE, topic, error.renamed("sheet")) from error
        parts = [(file, pages)]
    else:
        parts = [
            (file if k == 0 else file.with_suffix(f".{k + 1}{file.suffix}"), [page]) for k, page in enumerate(pages)
        ]
    for name, _ in parts:
        check_free(name, force=force)
    with beside(file) as folder:
        for name, shown in parts:
            write_sheets(folder / name.name, [page.canvas for page in shown], title)
            verdict = verify_sheets(folder / name.name, shown, _PAPER_TOLERANCE)
            if verdict.failures:
                raise ReadError(f"{name}: {'; '.join(map(str, verdict.failures))}")


def sheet_of(topic: str, words: Sequence[str], language: str | None = None) -> tuple[Sheet, str]:
    """The sheet of a topic and the language of its scene, which is told in another where one is asked for."""
    # an empty value ends a word as well, where another key follows
    signs = (
        k for k, word in enumerate(words)
        if word.startswith("=") or (word.endswith("=") and k + 1 < len(words) and "=" not in words[k + 1])
    )  # fmt: skip
    if (apart := next(signs, None)) is not None:
        # key = value, of which the shell makes three words
        raise SceneError(
            PLACE, " ".join(words[max(apart - words[apart].startswith("="), 0) : apart + 2]), None, "write_key_value"
        )
    addresses = [word for word in words if "=" not in word or os.path.isfile(word)]
    typed = table_of([word for word in words if word not in addresses])
    scenes = built_in_scenes()
    for word in addresses:
        if word in scenes or os.path.exists(word) or Path(word).suffix:
            continue
        # one alone that is like a scene and no key is told as one
        if (
            len(addresses) > 1
            or meant(word, scenes) is None
            or word in keys_of_topic(topic)[0].__struct_encode_fields__
        ):
            raise SceneError(PLACE, word, None, "neither_scene_nor_key", _value_of_only_key(word, topic))
    if len(addresses) > 1:
        raise SceneError(PLACE, addresses[1], None, "one_scene_only", None, other=addresses[0])

    def begun(table: Mapping[str, Any]) -> tuple[Callable[[], Sheet], str]:
        return _begun(topic, addresses, plain_numbers(table, PLACE, topic), language)

    with as_written({topic: typed}):
        try:
            finish, spoken = begun(typed)
            return finish(), spoken
        except SceneError as refusal:
            raise _as_typed(refusal, topic, typed, begun) from refusal


def _value_of_only_key(word: str, topic: str) -> Nearest | None:
    """A number that was typed without its key, where the topic asks for one key alone."""
    asked, number = [field.name for field in fields_of(keys_of_topic(topic)[0]) if field.required], number_in(word, "")
    return None if number is None or len(asked) != 1 else Nearest(f"{asked[0]}={number:.12g}", "meant")


def _as_typed(
    refusal: SceneError, topic: str, typed: Mapping[str, Any], begun: Callable[[Mapping[str, Any]], object]
) -> SceneError:
    """A refusal in the key as it was typed, maybe once for both bodies of a pair; what it offers has been tried."""
    path = steps_of(refusal.key.removeprefix(f"{topic}."))
    # of two keys at once nothing else was typed
    if path == steps_of(refusal.key) or not all(isinstance(step, int) or step.isidentifier() for step in path):
        return refusal
    key, of_gear = refusal.key, path[0] in GEARS and len(path) > 1
    if of_gear and path[1] in typed and path[1] not in typed.get(str(path[0]), {}):
        key = f"{topic}.{key.removeprefix(f'{topic}.{path.pop(0)}.')}"
    # nor of elements of a list that a scene has
    if _retyped(typed, path, refusal.value) is None:
        return refusal

    def cure() -> Nearest | None:
        found = refusal.nearest
        for _ in range(MOST_OFFERS):
            if found is None or found.side in TOLD:
                return found
            try:
                begun(_retyped(typed, path, found.value) or typed)
            except SceneError as again:
                found = again.nearest if again.key == refusal.key else None
            else:
                return found
        return None

    told = refusal.at(key)
    told.offer(cure)
    return told


def _retyped(typed: Mapping[str, Any], path: Sequence[str | int], value: object) -> dict[str, Any] | None:
    """What was typed with another value at a place, None: without it; no table where no such element was typed."""
    made = deepcopy(dict(typed))
    owner: Any = made
    for step in path[:-1]:
        if isinstance(step, str):
            owner = owner.setdefault(step, {})
        elif isinstance(owner, list):
            if step >= len(owner):
                return None
            owner = owner[step]
        # else one table stands for a list of one
        elif not owner:
            return None
    last = path[-1]
    if isinstance(last, int) and not (isinstance(owner, list) and last < len(owner)):
        return None
    if value is None:
        owner.pop(last, None)
    else:
        owner[last] = value
    return made


def _begun(
    topic: str, addresses: Sequence[str], table: dict[str, Any], language: str | None
) -> tuple[Callable[[], Sheet], str]:
    """What finishes the sheet, which is refused before where it can be, and the language of its scene."""
    if topic == "power-table" and isinstance(file := table.get("path"), str):
        from exporters.formats.read_path import read_path

        table["path"] = read_path(Path(file), f"{topic}.path")
    module = importlib.import_module(_home(topic))

    def of(keys: dict[str, Any]) -> Callable[[], Sheet]:
        if (start := getattr(module, "begun", None)) is not None:
            finish: Callable[[], Sheet] = start(keys)
            return finish
        sheet: Sheet = module.sheet(keys)
        return lambda: sheet

    if not addresses:
        return of(table), "en"
    from parts.scene.load import load_scene

    scene = load_scene(addresses[0], language)
    table_from = getattr(module, "table_from", None)
    if table_from is None:
        raise SceneError(addresses[0], Typed("TOPIC"), topic, "keys_not_a_scene")
    return of(table_from(scene, addresses[0], table)), scene.scene.language
