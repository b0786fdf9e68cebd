"""Export keys that only sheets have, and what a sheet does not take."""

from __future__ import annotations

from typing import Annotated, Any

from msgspec import Meta

from parts.base.refusal import REMOVED, SceneError
from parts.keys.base import mm

RackStep = Annotated[float, mm("sheet, generating: way of the rack from position to position", least=0.01, most=1000)]
Intervals = Annotated[int, Meta(ge=2, le=72, description="sheet, cam: parts of each phase on paper; default: 8")]
CamSpeed = Annotated[float, Meta(gt=0, le=1e6, description="sheet, cam: adds velocities", extra={"unit": "rpm"})]
MateNumber = Annotated[int, Meta(ge=1, description="sheet: the pair that is shown, by number; default: all")]
# the purpose that each key is for
_PURPOSES = {"mate": "meshing", "rack_step": "generating", "intervals": "cam", "speed_rpm": "cam"}
SHEET_KEYS = (*_PURPOSES, "title_block")


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
    if spec.title_block and spec.format != "sheet":
        given = spec.title_block is not False
        raise SceneError(
            source, f"{place}.title_block", given, "only_for_format", REMOVED, formats='"sheet"', format=spec.format
        )
    if spec.format in ("sheet", "motion", "glb") and spec.offset:
        raise SceneError(source, f"{place}.offset", spec.offset, "sheet_shows_exact_profile", REMOVED)
    if spec.format == "sheet" and spec.parts is not None and spec.purpose == "meshing":
        raise SceneError(source, f"{place}.parts", None, "sheet_shows_a_pair", REMOVED)
