"""Refusals whose offer surely works: what a scene's refusal offers is tried before it is told."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

from geometry.trial import is_followed, is_trial
from parts.schema import SceneError

Read = TypeVar("Read", bound=Callable[..., Any])


def offers_tried(read: Read) -> Read:
    """Of ``scene_from_dict`` and ``make_parts``: their refusals, with an offer that was fed back and worked."""

    @wraps(read)
    def wrapped(scene: Any, source: str, *rest: Any) -> Any:
        try:
            return read(scene, source, *rest)
        except SceneError as refusal:
            if is_trial() or is_followed():
                raise
            from parts.offer_search import sure_refusal

            sure = sure_refusal(scene, refusal)
            if sure is refusal:
                raise
            raise sure from refusal

    return wrapped  # type: ignore[return-value]
