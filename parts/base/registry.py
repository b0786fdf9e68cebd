"""The kinds of parts, a row of ``kinds.psv`` each: where the kind is found, what it is and what it is called."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from parts.base.lazy import Index
from parts.base.psv import rows_of

if TYPE_CHECKING:
    from parts.base.kind import Kind

KINDS: Index[Kind[Any, Any]] = Index(rows_of(__file__, "kinds"))
