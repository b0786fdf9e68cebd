"""What was noticed about a legal but remarkable geometry: a code and the numbers behind it."""

from __future__ import annotations

from geometry.base.record import Record


class Finding(Record):
    """A remark with a stable code; ``value`` is what was found, ``limit`` what it is held against.

    The words for each code stand with the reports, in every language of the project.
    """

    code: str
    value: float
    limit: float
