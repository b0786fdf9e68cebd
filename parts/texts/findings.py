"""What a build remarks on, by the codes of the findings: sentences with ``value`` and ``limit``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from geometry.base.findings import Finding
from parts.base.psv import sentences_of
from parts.base.texts import Message, Text, Told, filled, message, words

FINDINGS = sentences_of(__file__, "findings")


def add_findings(table: Mapping[str, Text]) -> None:
    """The sentences of a kind that is registered from outside, with ``value`` and ``limit``."""
    FINDINGS.update(table)


def finding_message(finding: Finding) -> Message:
    """A finding as a sentence that waits for its language; limits work as they are told, ``most``: a greatest one.

    ``exact``: one that is no limit.
    """
    value, limit = finding.value, finding.limit
    near, most = Told(limit, up=limit > value), Told(limit, up=False)
    numbers = {"value": value, "limit": near, "most": most, "exact": limit, "lack": limit - value}
    return filled(FINDINGS[finding.code], **numbers)


def finding_of(gear: int, finding: Finding) -> Message:
    """A finding of gear 1 or 2; of the pair where the number is 0."""
    told = finding_message(finding)
    return message("gear {number}: {finding}", number=gear, finding=told) if gear else told


def findings_told(language: str, findings: Iterable[Finding]) -> list[dict[str, Any]]:
    """Findings as plain data."""
    return [{"code": f.code, "value": f.value, "limit": f.limit, "text": finding_text(language, f)} for f in findings]


def finding_text(language: str, finding: Finding) -> str:
    """A finding as a sentence."""
    return words(language).say(finding_message(finding))
