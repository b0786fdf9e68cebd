"""Scene keys of the working drawing of a part: fits, roughness, teeth that are drawn, technical requirements."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec import Meta, Struct

# fundamental deviations by tables 2 to 5 of ISO 286-1, JS as GOST writes it too: J and K of holes, j of shafts have one
# in some grades alone
_ALL, _GRADES = "A|B|CD?|D|EF?|FG?|G|H|J[Ss]|[MNPR-VXY]|Z[ABC]?", "(01|[0-9]|1[0-8])"


# mm: for sizes above the first and up to the second a fundamental deviation is told (the same tables)
_TOLD = {
    **dict.fromkeys(("c", "j", "x", "z", "za", "zb", "zc"), (0.0, 500.0)),
    **dict.fromkeys(("cd", "ef", "fg"), (0.0, 10.0)), "a": (1.0, 500.0), "b": (1.0, 500.0),
    "t": (24.0, 3150.0), "v": (14.0, 500.0), "y": (18.0, 500.0),
}  # fmt: skip


def told_sizes(zone: str) -> tuple[float, float]:
    """Above and up to which size, mm, a tolerance zone is told."""
    return _TOLD.get(zone.rstrip("0123456789").lower(), (0.0, math.inf))


def _hole(meaning: str) -> Meta:
    told = f"tolerance zone of {meaning}, A to ZC with a grade of 01 to 18, of J6 to J8 and up to K8 (ISO 286-1)"
    return Meta(pattern=f"^(({_ALL}){_GRADES}|J[678]|K(01|[0-8]))$", description=told)


def _shaft(meaning: str) -> Meta:
    told = f"tolerance zone of {meaning}, a to zc with a grade of 01 to 18, of j5 to j8 (ISO 286-1)"
    return Meta(pattern=f"^(({_ALL.lower()}|k){_GRADES}|j[5-8])$", description=told)


def _rough(meaning: str) -> Meta:
    return Meta(ge=0.012, le=100, description=f"roughness Ra of {meaning}", extra={"unit": "um"})


def _runout(meaning: str) -> Meta:
    told = f"runout of {meaning}, in the frame of GOST 2.308, its datum marked"
    return Meta(ge=1e-4, le=10, description=told, extra={"unit": "mm"}, examples=[0.05])


_Requirement = Annotated[str, Meta(pattern=r"\S", max_length=300, description="words")]
_REQUIREMENTS = Meta(max_length=12, description="technical requirements, a line each, before those of the drawing")


class WorkingTable(Struct, forbid_unknown_fields=True, frozen=True):
    """What a working drawing says beside the part's own sizes."""

    tip: Annotated[str, _shaft("the outer diameter")] = "h11"
    inner: Annotated[str, _hole("the inner diameter of a ring's teeth")] = "H11"
    bore: Annotated[str, _hole("bores")] = "H7"
    keyway: Annotated[str, _hole("the width of keyways in bores")] = "Js9"
    shaft: Annotated[str, _shaft("steps of a shaft")] = "h11"
    shaft_keyway: Annotated[str, _hole("the width of keyways in shafts")] = "N9"
    width: Annotated[str, _shaft("the face width")] = "h11"
    roughness: Annotated[float, _rough("all surfaces that have no sign of their own")] = 6.3
    flank_roughness: Annotated[float, _rough("working surfaces: flanks of teeth and cams")] = 1.6
    bore_roughness: Annotated[float, _rough("bores")] = 1.6
    shaft_roughness: Annotated[float, _rough("steps of a shaft, where it is not that of all surfaces")] | None = None
    tip_runout: Annotated[float, _runout("the tip circle about the bore, of inner teeth about the outside")] | None = (
        None
    )
    face_runout: Annotated[float, _runout("the upper face (of a bevel gear the back) about the same")] | None = None
    teeth: Annotated[int, Meta(ge=0, le=10_000, description="teeth drawn exactly; the others are circles")] = 0
    requirements: Annotated[list[_Requirement], _REQUIREMENTS] = []


# the keys of tolerance zones
ZONES = ("tip", "inner", "bore", "keyway", "shaft", "shaft_keyway", "width")
# those of runouts
RUNOUTS = ("tip_runout", "face_runout")
