"""What drawings call a part: by its title, else by what its kind is, its id as the designation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from parts.base.psv import sentences_of
from parts.base.texts import words

if TYPE_CHECKING:
    from parts.base.part import Part

KIND_NAMES = sentences_of(__file__, "names")


def drawn_names(part: Part, language: str) -> tuple[str, str]:
    """Its name and its designation, empty where it has none; one of a kind without a name is called by its id."""
    kind = KIND_NAMES.get(part.kind)
    if part.title is not None or kind is None:
        return part.title or part.id, part.designation or ""
    return words(language).say(kind), part.designation or part.id
