"""Export keys that only sheets have, and what a sheet does not take."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta

from parts.base.refusal import REMOVED, SceneError
from parts.keys.base import mm, size

RackStep = Annotated[float, mm("sheet, generating: way of the rack from position to position", least=0.01, most=1000)]
Intervals = Annotated[int, Meta(ge=2, le=72, description="sheet, cam: parts of each phase on paper; default: 8")]
CamSpeed = Annotated[float, size("rpm", "sheet, cam: adds velocities", above=0, most=1e6)]
MateNumber = Annotated[int, Meta(ge=1, description="sheet: the pair that is shown, by number; default: all")]
# GOST 2.301, 2.302
PaperName = Literal["A4", "A3", "A2", "A1", "A0"]
Scale = Literal[
    "100:1", "50:1", "40:1", "20:1", "10:1", "5:1", "4:1", "2.5:1", "2:1", "1:1", "1:2", "1:2.5", "1:4", "1:5", "1:10",
    "1:15", "1:20", "1:25", "1:40", "1:50", "1:75", "1:100", "1:200", "1:400", "1:500", "1:800", "1:1000"
]  # fmt: skip
PaperKey = Annotated[PaperName, Meta(description="sheet, pdf: size of the paper; default: the smallest that holds it")]
ScaleKey = Annotated[
    Scale, Meta(description="sheet, pdf: scale by GOST 2.302; default: the greatest that the paper allows")
]


def scale_value(text: str) -> float:
    """2.5:1 as a number."""
    paper, model = text.split(":")
    return float(paper) / float(model)


CellsKey = Annotated[
    Literal["numbers", "empty"], Meta(description="sheet, pdf: what is to be found out, in numbers or left to students")
]
# the purpose that each key is for
_PURPOSES = {"mate": "meshing", "rack_step": "generating", "intervals": "cam", "speed_rpm": "cam", "drawing": "part"}
SHEET_FORMATS = ("sheet", "pdf")
# purposes of drawings for the workshop, each a file of its own
WORKING = ("part", "assembly")
SHEET_KEYS = (*_PURPOSES, "title_block", "paper", "scale", "cells")


def on_sheet(format_name: str, purpose: str | None) -> bool:
    """Whether an export is a drawing on paper."""
    return format_name in SHEET_FORMATS or purpose in WORKING


def check_sheet_keys(spec: Any, source: str, place: str) -> None:
    """Refuse a sheet's key on another export, and on a sheet what its picture cannot show.

    Raises
    ------
    SceneError
        With the key and what to do.
    """
    for key, purpose in _PURPOSES.items():
        value = getattr(spec, key)
        if value is not None and spec.purpose != purpose:
            raise SceneError(source, f"{place}.{key}", value, "only_for_purpose", REMOVED, purpose=purpose)
    for key in ("title_block", "paper", "scale"):
        given = getattr(spec, key)
        if given and not on_sheet(spec.format, spec.purpose):
            formats, given = [f'"{name}"' for name in SHEET_FORMATS], given if key != "title_block" else True
            raise SceneError(
                source, f"{place}.{key}", given, "only_for_format", REMOVED, formats=formats, format=spec.format
            )
        if given and key != "paper" and spec.format == "pdf" and spec.purpose == "model":
            given = given if key == "scale" else True
            raise SceneError(source, f"{place}.{key}", given, "model_is_full_size", REMOVED)
        if given and key != "title_block" and spec.purpose == "parts_list":
            raise SceneError(source, f"{place}.{key}", given, "list_has_its_form", REMOVED)
    is_sheet = on_sheet(spec.format, spec.purpose)
    if spec.cells != "numbers" and (not is_sheet or spec.purpose in ("model", "parts_list", *WORKING)):
        formats = [f'"{name}"' for name in SHEET_FORMATS]
        raise SceneError(
            source, f"{place}.cells", spec.cells, "only_for_format", REMOVED, formats=formats, format=spec.format
        )
    if (is_sheet or spec.format in ("motion", "glb", "csv")) and spec.offset:
        raise SceneError(source, f"{place}.offset", spec.offset, "sheet_shows_exact_profile", REMOVED)
    if is_sheet and spec.parts is not None and spec.purpose == "meshing":
        raise SceneError(source, f"{place}.parts", None, "sheet_shows_a_pair", REMOVED)
