"""Registries whose entries are loaded one by one, when a scene has something of theirs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from typing import Generic, TypeVar

E = TypeVar("E")


class Registry(Mapping[str, E], Generic[E]):
    """Names, and for each the place of its entry, ``module:NAME``; of a class the one entry is made of it."""

    def __init__(self, homes: Mapping[str, str]) -> None:
        self._homes, self._loaded = dict(homes), dict[str, E]()

    def __getitem__(self, name: str) -> E:
        """The entry of a name."""
        if name not in self._loaded:
            module, _, attribute = self._homes[name].partition(":")
            found = getattr(import_module(module), attribute)
            self._loaded[name] = found() if isinstance(found, type) else found
        return self._loaded[name]

    def register(self, name: str, entry: E) -> None:
        """One more entry, from outside."""
        self._homes[name], self._loaded[name] = "", entry

    def __iter__(self) -> Iterator[str]:
        return iter(self._homes)

    def __len__(self) -> int:
        return len(self._homes)

    def __contains__(self, name: object) -> bool:
        return name in self._homes


class Index(Registry[E], Generic[E]):
    """A registry that says what each entry is before that is loaded: rows of its name, its place and a phrase.

    A fourth cell is what one is called.
    """

    def __init__(self, rows: Sequence[Sequence[str]]) -> None:
        super().__init__({name: home for name, home, *_ in rows})
        self.phrases = {name: phrase for name, _, phrase, *_ in rows}
        self.called = {name: called for name, _, _, *more in rows for called in more}

    def add(self, name: str, entry: E, phrase: str, called: str = "") -> None:
        """One more entry, from outside, what it is, and what one is called."""
        self.register(name, entry)
        self.phrases[name] = phrase
        if called:
            self.called[name] = called
