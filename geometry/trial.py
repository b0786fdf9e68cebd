"""Trials: a refusal that is raised only to be counted needs no remedy, and the search for one is what takes time."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_TRYING: ContextVar[bool] = ContextVar("_TRYING", default=False)
_FOLLOWING: ContextVar[bool] = ContextVar("_FOLLOWING", default=False)


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


@contextmanager
def following() -> Iterator[None]:
    """Within it refusals say what would work by themselves; nobody searches for more."""
    token = _FOLLOWING.set(True)
    try:
        yield
    finally:
        _FOLLOWING.reset(token)


def is_followed() -> bool:
    """Whether somebody reads the remedy of a refusal to search on."""
    return _FOLLOWING.get()
