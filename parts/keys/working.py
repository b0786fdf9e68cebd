"""Scene keys of the working drawing of a part: fits, roughness, teeth that are drawn, technical requirements."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

_FIT = r"^[A-Za-z][A-Za-z]?([1-9]|1[0-8])?$"


def _fit(meaning: str) -> Meta:
    return Meta(pattern=_FIT, description=f"tolerance zone of {meaning}")


def _rough(meaning: str) -> Meta:
    return Meta(ge=0.012, le=100, description=f"roughness Ra of {meaning}", extra={"unit": "um"})


class WorkingTable(Struct, forbid_unknown_fields=True, frozen=True):
    """What a working drawing says beside the part's own sizes."""

    tip: Annotated[str, _fit("the outer diameter")] = "h11"
    inner: Annotated[str, _fit("the inner diameter of a ring's teeth")] = "H11"
    bore: Annotated[str, _fit("bores")] = "H7"
    keyway: Annotated[str, _fit("the width of keyways in bores")] = "Js9"
    shaft: Annotated[str, _fit("steps of a shaft")] = "h11"
    shaft_keyway: Annotated[str, _fit("the width of keyways in shafts")] = "P9"
    width: Annotated[str, _fit("the face width")] = "h11"
    roughness: Annotated[float, _rough("all surfaces that have no sign of their own")] = 6.3
    flank_roughness: Annotated[float, _rough("working surfaces: flanks of teeth and cams")] = 1.6
    bore_roughness: Annotated[float, _rough("bores")] = 1.6
    teeth: Annotated[int, Meta(ge=0, le=10_000, description="teeth drawn exactly; the others are circles")] = 0
    requirements: Annotated[
        list[Annotated[str, Meta(min_length=1, max_length=300)]],
        Meta(max_length=12, description="technical requirements, a line each, beside those of the drawing"),
    ] = []
