"""The form every record takes: a frozen msgspec struct, which costs a fiftieth of a dataclass when it is imported."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar, cast, dataclass_transform

from msgspec import Struct, field

if TYPE_CHECKING:
    from collections.abc import Callable

    # mypy checks the changes of a dataclass only
    from dataclasses import replace
else:
    from msgspec.structs import replace

__all__ = ["Draft", "Record", "field", "made_once", "replace", "with_value"]


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
class Record(Struct, frozen=True):
    """A frozen record with slots, compared and hashed by its fields; ``dict=True`` where it has cached properties."""


R = TypeVar("R", bound=Record)
T = TypeVar("T")


def made_once(record: Record, name: str, make: Callable[[], T]) -> T:
    """What rooms above a record (``dict=True``) make of it, made once and kept with it like a cached property."""
    held = vars(record)
    if name not in held:
        held[name] = make()
    return cast("T", held[name])


def with_value(record: R, path: str, value: object) -> R:
    """The record with another value of the field at a path (``rack.relief.depth``)."""
    name, _, rest = path.partition(".")
    made: R = replace(record, **{name: with_value(getattr(record, name), rest, value) if rest else value})
    return made


class Draft(Struct):
    """A record with slots that is filled as the work goes on; not hashed."""
