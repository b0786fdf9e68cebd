"""What another package says to have its own kinds of parts and mates known: one call each, before a scene is read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from parts.base.kind import Kind
from parts.base.mate import MateKind
from parts.base.reasons import add_reasons, reason
from parts.base.registry import KINDS
from parts.base.schema import phrase_of, untold
from parts.base.texts import add_catalogue
from parts.mates.registry import MATES
from parts.texts.checks import MATES as TOLD_MATES
from parts.texts.checks import add_mates
from parts.texts.findings import FINDINGS, add_findings
from parts.texts.quantities import QUANTITIES, add_quantities

__all__ = ["add_catalogue", "add_kind", "add_mate"]


def add_kind(kind: Kind[Any, Any], called: str = "") -> None:
    """A kind of part, with the sentences of its refusals and remarks and the names of its quantities.

    ``list`` tells it by the first line of what its keys say of themselves; ``called``: what drawings call a part that
    has no title, in its catalogue in the context "name of a part"; without it they call it by its id.

    Raises
    ------
    ValueError
        Its name, a code or a quantity is another one's, or ``new`` could not tell a key; nothing is added.
    """
    _refuse(kind, KINDS, "of")
    _refuse_taken(kind.findings, FINDINGS)
    _refuse_taken(kind.quantities, QUANTITIES)
    KINDS.add(kind.name, kind, phrase_of(kind.keys), called)
    add_reasons(kind.reasons)
    add_findings(kind.findings)
    add_quantities(kind.quantities)


def add_mate(kind: MateKind[Any, Any, Any]) -> None:
    """A kind of mate, with the sentences of its refusals and how it is told; listed as ``add_kind`` says.

    Raises
    ------
    ValueError
        Its name or a code is another one's, or ``new`` could not tell a key; nothing is added.
    """
    _refuse(kind, MATES, "first", "second")
    told = {kind.name: kind.told} if kind.told else {}
    _refuse_taken(told, TOLD_MATES)
    MATES.add(kind.name, kind, phrase_of(kind.keys))
    add_reasons(kind.reasons)
    add_mates(told)


def _refuse(kind: Kind[Any, Any] | MateKind[Any, Any, Any], known: Mapping[str, object], *named: str) -> None:
    """Refuse keys of which ``new`` could tell nothing, ``named`` ones hold a name of the scene's; and names in use."""
    if found := next(untold(kind.keys, named), None):
        raise ValueError(f"kind {kind.name}: {found}")
    _refuse_taken({kind.name: kind}, known)
    # a code without a sentence is told as it is
    _refuse_taken(kind.reasons, {code: said for code in kind.reasons if (said := reason(code)) != code})


def _refuse_taken(own: Mapping[str, object], known: Mapping[str, object]) -> None:
    """Refuse names that stand for something else already: whoever has them would be told by these."""
    if taken := sorted(name for name, meant in own.items() if name in known and known[name] != meant):
        raise ValueError(f"names that are there already: {', '.join(taken)}")
