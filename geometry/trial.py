"""Trials: a refusal that is raised only to be counted needs no remedy, and the search for one is what takes time."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_TRYING: ContextVar[bool] = ContextVar("_TRYING", default=False)


@contextmanager
def trial() -> Iterator[None]:
    """Within it refusals need not say what would work."""
    token = _TRYING.set(True)
    try:
        yield
    finally:
        _TRYING.reset(token)


def is_trial() -> bool:
    """Whether nobody will read the remedy of a refusal."""
    return _TRYING.get()
