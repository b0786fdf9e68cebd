"""Where the sentence of a refusal's code is found: the tables of ``parts/reasons``, read when one is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from parts.base.psv import sentences_of
from parts.base.texts import N_, Text

SUBJECTS = (
    "general", "gears", "cams", "wheels", "pins", "ratchets", "chains", "belts", "noncircular", "mates", "motion",
    "scene", "pages", "exports",
)  # fmt: skip
# what would work, by the side of the nearest value
REMEDIES = {
    "at_most": N_("at most {value} works"),
    "at_least": N_("at least {value} works"),
    "exactly": N_("{value} works"),
    "meant": N_("did you mean {value}?"),
    "same": N_("{value} is the same"),
    "like": N_("like {value}"),
    "without": N_("remove {key}"),
}
_MORE: dict[str, Text] = {}


def add_reasons(table: Mapping[str, Text]) -> None:
    """The sentences of a kind that is registered from outside."""
    _MORE.update(table)


@cache
def sentences(subject: str) -> dict[str, Text]:
    """Those of a subject by code."""
    return sentences_of(__file__, f"../reasons/{subject}")


def reason(code: str) -> Text:
    """The English sentence of a code, with ``{name}`` for its numbers; a code without one is told as it is."""
    return next((table[code] for table in (*map(sentences, SUBJECTS), _MORE) if code in table), code)
