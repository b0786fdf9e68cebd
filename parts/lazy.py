"""A table whose modules are loaded one by one, when a scene has something of theirs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any


class LazyTable(Mapping[str, Any]):
    """Names, and for each the things of one module: a single one, or a tuple of several."""

    def __init__(self, homes: dict[str, tuple[str, ...]]) -> None:
        self._homes, self._loaded = homes, dict[str, Any]()

    def __getitem__(self, name: str) -> Any:
        """What stands under a name: the module (the first word of its home), and the names in it."""
        if name not in self._loaded:
            module, *names = self._homes[name]
            things = tuple(getattr(import_module(module), n) for n in names)
            self._loaded[name] = things if len(things) > 1 else things[0]
        return self._loaded[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._homes)

    def __len__(self) -> int:
        return len(self._homes)

    def __contains__(self, name: object) -> bool:
        return name in self._homes
