"""Scene keys of helical teeth, shared by gears, rings and racks, and what a part says of its helix."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta

from geometry.errors import GeometryError, ParameterError, at_least, at_most
from geometry.findings import Finding
from geometry.gears.helix import Hand, Helix
from parts.common_face import STRAIGHT, CommonFace

HelixAngle = Annotated[
    float,
    Meta(
        ge=-60,
        le=60,
        description="helix angle on the reference cylinder, all else is then normal; negative turns the hand",
        extra={"unit": "degrees"},
    ),
]
HandName = Annotated[Literal["right", "left"], Meta(description="hand of the helix; of the lower half of a double one")]
Double = Annotated[bool, Meta(description="two helices of opposite hands that meet in the middle of the face width")]


def helix_of(spec: Any) -> Helix:
    """The helix of a part's keys; that of spur gears for parts without such keys."""
    angle = math.radians(getattr(spec, "helix_angle_deg", 0.0))
    hand: Hand = getattr(spec, "hand", "right")
    if angle < 0:
        hand = "left" if hand == "right" else "right"
    return Helix(abs(angle), hand, getattr(spec, "double_helical", False))


def checked_helix(spec: Any) -> Helix:
    """The helix of a part's keys, which belong together.

    Raises
    ------
    ParameterError
        Two helices without an angle.
    """
    helix = helix_of(spec)
    if helix.double and helix.angle == 0:
        raise ParameterError("double_helical", True, "needs helix_angle_deg above 0; false works")
    return helix


def common_face(first: Any, second: Any) -> CommonFace:
    """The face that two mates' keys give them, both at one height; that of straight teeth for other parts."""
    if helix_of(first).angle == 0:
        return STRAIGHT
    return CommonFace(helix_of(first), first.module, min(first.face_width, second.face_width))


def helix_quantities(spec: Any, reference_radius: float) -> dict[str, float]:
    """Normal pitch and lead of helical teeth, mm; nothing for straight ones."""
    helix = helix_of(spec)
    if helix.angle == 0:
        return {}
    return {"normal_pitch": math.pi * spec.module, "lead": helix.lead(reference_radius)}


def section_finding(spec: Any) -> tuple[Finding, ...]:
    """The remark that a flat outline of helical teeth is their transverse section."""
    return (Finding("transverse_section", spec.helix_angle_deg, 0.0),) if spec.helix_angle_deg else ()


# keys whose refusals speak of the transverse section until they are said in normal terms, and the steps of the search
_STEPS = {"coefficient": 0.05, "pressure_angle_deg": 0.5}


def in_normal_terms(spec: Any, refusal: ParameterError, builds: Callable[[Any], bool]) -> ParameterError:
    """A refusal of the transverse section told with the normal value that the scene gives, and one that works."""
    cosine = math.cos(helix_of(spec).angle)
    owner, _, key = refusal.name.rpartition(".")
    table = getattr(spec, owner, None) if owner else spec
    step = next((size for ending, size in _STEPS.items() if key.endswith(ending)), None)
    if cosine == 1 or step is None or not isinstance(table, msgspec.Struct) or getattr(table, key, None) is None:
        return refusal
    given = float(getattr(table, key))

    def works(value: float) -> bool:
        changed = msgspec.structs.replace(table, **{key: value})
        return builds(msgspec.structs.replace(spec, **{owner: changed}) if owner else changed)

    reason = refusal.allowed.partition(";")[0]
    found = nearest_working(works, given, step)
    text = "" if found is None else f"; at least {at_least(found, 4)} works"
    if found is not None and found < given:
        text = f"; at most {at_most(found, 4)} works"
    return type(refusal)(refusal.name, given, f"{reason}{text}")


def nearest_working(works: Callable[[float], bool], given: float, step: float) -> float | None:
    """The value nearest to a refused one that works, found by steps and bisection; None where none is found."""

    def safe(value: float) -> bool:
        try:
            return works(value)
        except GeometryError:
            return False

    tried = (given + sign * step * 1.4**k for k in range(13) for sign in (1, -1))
    good = next((value for value in tried if safe(value)), None)
    if good is None:
        return None
    bad = given
    for _ in range(24):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if safe(middle) else (good, middle)
    return good
