"""The form every record takes: a frozen msgspec struct, which costs a fiftieth of a dataclass when it is imported."""

from __future__ import annotations

from typing import TYPE_CHECKING, dataclass_transform

from msgspec import Struct, field

if TYPE_CHECKING:
    # mypy checks the changes of a dataclass only
    from dataclasses import replace
else:
    from msgspec.structs import replace

__all__ = ["Draft", "Record", "field", "replace"]


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
class Record(Struct, frozen=True):
    """A frozen record with slots, compared and hashed by its fields; ``dict=True`` where it has cached properties."""


class Draft(Struct):
    """A record with slots that is filled as the work goes on; not hashed."""
