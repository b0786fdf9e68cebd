"""Tables ``[boards.NAME]`` and ``[beds.NAME]``: sheets to be cut, beds to print on, and how many pieces lie on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated

from msgspec import Meta, Struct

from parts.base.refusal import REMOVED, SceneError, meant
from parts.keys.base import mm, part_mm, size

# the tables, and the purpose of exports that lay parts out on them
PURPOSES_LAID = {"boards": "board", "beds": "plate"}
# narrower ones are mistakes of the keyboard, mm
_LEAST = 1.0
# a class of forty with hundreds of pins each
_MOST_COPIES = 1000

_COPIES = Meta(
    description="pieces of a part, or of an instance, in a set; default: as many as it has instances",
    examples=[{"wheel": 2}],
)
_PARTS = Meta(min_length=1, description="the parts that are laid on it", examples=[["wheel"]])
_SETS = Meta(ge=1, le=_MOST_COPIES, description="number of sets laid out: one for each group of a class")


class LaidKeys(Struct, forbid_unknown_fields=True, kw_only=True):
    """Keys of boards and beds."""

    width: Annotated[float, part_mm("along x", least=_LEAST, example=600.0)]
    margin: Annotated[float, part_mm("left free along its edges", least=0)] = 5.0
    gap: Annotated[float, part_mm("least distance between two cuts; the web is less by the kerf", least=0)] = 2.0
    sets: Annotated[int, _SETS] = 1
    copies: Annotated[dict[str, Annotated[int, Meta(ge=0, le=_MOST_COPIES)]], _COPIES] = {}
    parts: Annotated[list[str], _PARTS] | None = None

    @property
    def across(self) -> float:
        """Size along y, mm."""
        raise NotImplementedError


_THICKNESS = mm(
    "parts of this thickness are cut from it; a single board gives its thickness to all flat parts that have none",
    above=0,
    most=10_000,
    example=3.0,
)
_FEED = size("mm/s", "speed of the cut, from which its time is computed", above=0, most=10_000, example=12.0)
_ENGRAVING = size("mm/s", "speed of engraving; default: feed", above=0, most=10_000, example=100.0)
Kerf = Annotated[
    float, mm("full width of the cut; the path runs half of it outside the part", least=0, most=10, length=False)
]
_GRAIN = Meta(description="its grain runs along x: parts lie as drawn, or turned by half a turn")


class BoardSpec(LaidKeys, kw_only=True):
    """Keys of ``[boards.NAME]``."""

    height: Annotated[float, part_mm("along y", least=_LEAST, example=400.0)]
    thickness: Annotated[float, _THICKNESS]
    kerf: Kerf = 0.0
    grain: Annotated[bool, _GRAIN] = False
    feed: Annotated[float, _FEED] | None = None
    engraving_feed: Annotated[float, _ENGRAVING] | None = None

    @property
    def across(self) -> float:
        """Size along y, mm."""
        return self.height


class BedSpec(LaidKeys, kw_only=True):
    """Keys of ``[beds.NAME]``."""

    depth: Annotated[float, part_mm("along y", least=_LEAST, example=220.0)]
    height: Annotated[float, part_mm("greatest height of a print", above=0, example=250.0)]

    @property
    def across(self) -> float:
        """Size along y, mm."""
        return self.depth


def check_parts(parts: Sequence[str], known: Mapping[str, object], source: str, place: str) -> None:
    """Refuse a part that is none of those ``known``, or stands in a list twice."""
    for part in parts:
        if part not in known:
            raise SceneError(source, place, part, "no_such_part", meant(part, known), known=list(known))
        if parts.count(part) > 1:
            raise SceneError(source, place, part, "listed_twice")


def check_laid(
    spec: LaidKeys, known: Mapping[str, object], names: Mapping[str, object], source: str, place: str
) -> None:
    """Refuse what names no part (``known``) or instance (``names``), and margins that leave no room.

    Raises
    ------
    SceneError
        With the key and what is allowed.
    """
    check_parts(spec.parts or (), known, source, f"{place}.parts")
    for name in spec.copies:
        if name not in known and name not in names:
            every = list({**known, **names})
            raise SceneError(source, f"{place}.copies", name, "no_such_part", meant(name, every), known=every)
    if isinstance(spec, BoardSpec) and spec.engraving_feed is not None and spec.feed is None:
        raise SceneError(source, f"{place}.engraving_feed", spec.engraving_feed, "needs_other", REMOVED, other="feed")
    least = min(spec.width, spec.across)
    if 2 * spec.margin >= least:
        raise SceneError(source, f"{place}.margin", spec.margin, "margins_leave_nothing", None, side=least)
    if spec.gap >= least:
        raise SceneError(source, f"{place}.gap", spec.gap, "gap_above_board", None, side=least)
