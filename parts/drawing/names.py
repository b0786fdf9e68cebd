"""What drawings call a part: by its title, else by what its kind is, its id as the designation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from parts.base.registry import KINDS
from parts.base.texts import in_context, words

if TYPE_CHECKING:
    from parts.base.part import Part

# which of the meanings of a word like "Cam" is told
NAME_OF_PART = "name of a part"


def drawn_names(part: Part, language: str) -> tuple[str, str]:
    """Its name and its designation, empty where it has none; one of a kind without a name is called by its id."""
    called = KINDS.called.get(part.kind)
    if part.title is not None or called is None:
        return part.title or part.id, part.designation or ""
    return words(language).say(in_context(NAME_OF_PART, called)), part.designation or part.id


def caption_name(part: Part) -> str:
    """What captions call it: its title, else what its kind is and its id, where that says more."""
    name, _ = drawn_names(part, part.language)
    known = part.kind, KINDS.called.get(part.kind, part.id).lower().replace(" ", "_"), name
    says_no_more = any(f"_{one}".endswith(f"_{part.id}") for one in known)
    return name if part.title is not None or says_no_more else f"{name} {part.id}"
