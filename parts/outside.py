"""What another package says to have its own kinds of parts and mates known: one call each, before a scene is read."""

from __future__ import annotations

from typing import Any

from parts.base.kind import Kind
from parts.base.mate import MateKind
from parts.base.reasons import add_reasons
from parts.base.registry import KINDS
from parts.base.schema import phrase_of
from parts.base.texts import add_catalogue
from parts.mates.registry import MATES
from parts.texts.checks import add_mates
from parts.texts.findings import add_findings
from parts.texts.quantities import add_quantities

__all__ = ["add_catalogue", "add_kind", "add_mate"]


def add_kind(kind: Kind[Any, Any]) -> None:
    """A kind of part, with the sentences of its refusals and remarks and the names of its quantities.

    ``list`` tells it by the first line of what its keys say of themselves.
    """
    KINDS.add(kind.name, kind, phrase_of(kind.keys))
    add_reasons(kind.reasons)
    add_findings(kind.findings)
    add_quantities(kind.quantities)


def add_mate(kind: MateKind[Any, Any, Any]) -> None:
    """A kind of mate, with the sentences of its refusals and how it is told; listed as ``add_kind`` says."""
    MATES.add(kind.name, kind, phrase_of(kind.keys))
    add_reasons(kind.reasons)
    if kind.told:
        add_mates({kind.name: kind.told})
