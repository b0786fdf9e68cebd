"""Parts made from another part's keys: ``of`` names it."""

from __future__ import annotations

from typing import TypeVar

from msgspec import Struct

from geometry.errors import ParameterError
from parts.schema import near

Owner = TypeVar("Owner", bound=Struct)


def owner_of(name: str, parts: dict[str, Struct], kind: type[Owner]) -> Owner:
    """The keys of the part that ``of`` names; it must be of a kind.

    Raises
    ------
    ParameterError
        No such part, or one of another kind; names those that work.
    """
    fitting = [key for key, spec in parts.items() if isinstance(spec, kind)]
    tag = kind.__struct_config__.tag
    works = f'"{fitting[0]}" works' if fitting else f'the scene has no part of kind = "{tag}"; add one'
    if name not in parts:
        raise ParameterError("of", name, f"no such part{near(name, parts)}; {works}")
    found = parts[name]
    if not isinstance(found, kind):
        raise ParameterError("of", name, f"is a {found.__struct_config__.tag}, not a {tag}; {works}")
    return found
