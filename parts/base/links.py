"""Parts made from another part's keys: ``of`` names it."""

from __future__ import annotations

import difflib
from typing import TypeVar

from msgspec import Struct

from geometry.base.errors import Nearest, ParameterError
from parts.base.kind import Others

Owner = TypeVar("Owner", bound=Struct)


def owner_of(name: str, others: Others, kind: type[Owner]) -> Owner:
    """The keys of the part that ``of`` names; it must be of a kind.

    Raises
    ------
    ParameterError
        No such part, or one of another kind; names one that works.
    """
    found, tag = others.get(name), kind.__struct_config__.tag
    if isinstance(found, kind):
        return found
    fitting = [key for key, keys in others.items() if isinstance(keys, kind)]
    if not fitting:
        raise ParameterError("of", name, "none_of_kind", kind=tag)
    works = Nearest(next(iter(difflib.get_close_matches(name, fitting, 1, 0.5)), fitting[0]))
    if found is None:
        raise ParameterError("of", name, "no_such_part", works, known=fitting)
    raise ParameterError("of", name, "of_another_kind", works, found=found.__struct_config__.tag, kind=tag)
