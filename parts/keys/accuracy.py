"""Scene keys of a toothed part's accuracy, for the table of its drawing."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

from parts.keys.base import mm

_Deviation = Annotated[float, mm("", least=-100, most=100)]
_DEVIATIONS = Meta(
    description="drawing: limits of what is measured on the teeth, from the size in the table, read there",
    examples=[[-0.1, -0.2]],
    extra={"unit": "mm"},
)
_SOURCE = Meta(pattern=r"\S", max_length=40, description="the standard that it is read in", examples=["GOST 1643-81"])


class AccuracyTable(Struct, forbid_unknown_fields=True):
    """An accuracy grade on a drawing. The program holds no tables of standards: give the source with the grade."""

    grade: Annotated[str, Meta(pattern=r"\S", max_length=20, description="grade and kind of mate", examples=["8-B"])]
    source: Annotated[str, _SOURCE]
    deviations: Annotated[tuple[_Deviation, _Deviation], _DEVIATIONS] | None = None


AccuracyKey = AccuracyTable | None
