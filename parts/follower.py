"""The part kinds ``follower`` (a translating stem), ``follower_arm`` (an oscillating one) and ``roller``."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeVar

from msgspec import Meta, Struct

from geometry.errors import GeometryError, ParameterError, at_least, at_most
from geometry.trial import is_trial
from parts.hole_keys import BoreTable, RoundBoreTable, hub_holes, wide_bore
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.materials import density_of
from parts.part import Part
from parts.plate import FlatKeys, checked_outline, flat_part
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, wheel_shape

if TYPE_CHECKING:
    from geometry.cams.follower_shape import FollowerEnd
    from geometry.plate_outline import Edge
    from geometry.profile import Profile

_MOST = 100_000.0
_BISECTIONS, _LEAST = 40, 1e-3
EndName = Literal["pointed", "roller", "mushroom", "flat"]
End = Annotated[EndName, Meta(description="what touches the cam; a roller is a part of its own")]
Tip = Annotated[float, Meta(ge=5, le=170, description="angle of a pointed tip", extra={"unit": "degrees"})]
Pin = Annotated[float, mm("hole for the roller's pin; 0 is none", least=0, most=_MOST)]
Radius = Annotated[float, mm("radius of a mushroom's face", least=0, most=_MOST)]


class FollowerSpec(FlatKeys, forbid_unknown_fields=True, tag_field="kind", tag="follower"):
    """Translating follower: its reference point is the origin, the stem runs along +y."""

    end: End
    stem_width: Annotated[float, mm("width of the stem", above=0, most=_MOST)] = 10.0
    stem_length: Annotated[float, mm("from the reference point to the far end", above=0, most=_MOST)] = 80.0
    follower_radius: Radius = 0.0
    plate_diameter: Annotated[float, mm("width of a flat or mushroom plate", least=0, most=_MOST)] = 0.0
    plate_thickness: Annotated[float, mm("thickness of that plate at its edge", above=0, most=_MOST)] = 5.0
    corner_radius: Annotated[float, mm("rounding between plate and stem", least=0, most=_MOST)] = 0.0
    tip_angle_deg: Tip = 60.0
    pin_diameter: Pin = 0.0


class FollowerArmSpec(FlatKeys, forbid_unknown_fields=True, tag_field="kind", tag="follower_arm"):
    """Oscillating follower: its pivot is the origin, the arm runs along +x."""

    end: End
    arm_length: Annotated[
        float, mm("to the roller's centre, tip, arc's centre or a flat bar's end", above=0, most=_MOST)
    ]
    sense: Annotated[
        Literal["against", "with"], Meta(description="as the cam's: which side of the arm looks at the cam")
    ] = "against"
    width: Annotated[float, mm("width of the arm; of a roller's arm its round end", above=0, most=_MOST)] = 10.0
    boss_diameter: Annotated[float, mm("of the round end about the pivot", above=0, most=_MOST)] = 16.0
    pivot_diameter: Annotated[float, mm("hole for the pivot", least=0, most=_MOST)] = 6.0
    follower_radius: Radius = 0.0
    face_offset: Annotated[float, mm("flat face nearer to the cam than the pivot", least=-_MOST, most=_MOST)] = 0.0
    tip_angle_deg: Tip = 60.0
    tip_height: Annotated[
        float, mm("height of a tip, or of a mushroom's centre, over the arm", least=0, most=_MOST)
    ] = 10.0
    pin_diameter: Pin = 0.0


AnyFollower = TypeVar("AnyFollower", FollowerSpec, FollowerArmSpec)


class RollerSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="roller"):
    """Roller of a cam follower."""

    diameter: Annotated[float, mm("outer diameter", above=0, most=_MOST)]
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_follower(spec: FollowerSpec) -> FollowerEnd:
    """What of a stem touches the cam, and its outline, checked to exist.

    Raises
    ------
    ParameterError
        Sizes that do not fit, or keys that this end has no use for.
    """
    from geometry.cams.disk import FollowerKind
    from geometry.cams.follower_shape import FollowerEnd

    _check_end(spec, {"plate_diameter": ("flat", "mushroom"), "corner_radius": ("flat", "mushroom")})
    if spec.end in ("flat", "mushroom") and spec.plate_diameter == 0:
        text = f"a {spec.end} follower has a plate; {2 * spec.stem_width:.6g} mm works"
        raise ParameterError("plate_diameter", 0.0, text)
    _check_pin(spec.pin_diameter, spec.stem_width)
    edges = _whole(spec, _stem_edges, ("corner_radius", "plate_thickness"))
    outline = checked_outline(edges, spec, [("pin_diameter", 0j, spec.pin_diameter)] if spec.pin_diameter else ())
    radius = spec.follower_radius if spec.end == "mushroom" else 0.0
    reach = (-spec.plate_diameter / 2, spec.plate_diameter / 2) if spec.plate_diameter else None
    return FollowerEnd(FollowerKind(spec.end), radius, reach, outline=outline)


def _stem_edges(spec: FollowerSpec) -> tuple[Edge, ...]:
    from geometry.cams import follower_shape as shape

    width, length = spec.stem_width, spec.stem_length
    if spec.end == "pointed":
        return shape.pointed_stem(width, length, math.radians(spec.tip_angle_deg))
    if spec.end == "roller":
        if not length > width / 2:
            text = f"must be longer than half its width; at least {at_least(width)} mm works"
            raise ParameterError("stem_length", length, text)
        return shape.roller_stem(width, length)
    radius = spec.follower_radius if spec.end == "mushroom" else None
    return shape.plate_stem(width, length, (spec.plate_diameter, spec.plate_thickness), radius, spec.corner_radius)


def checked_arm(spec: FollowerArmSpec) -> FollowerEnd:
    """The same of an arm."""
    from geometry.cams.disk import FollowerKind
    from geometry.cams.follower_shape import FollowerEnd

    _check_end(spec, {"face_offset": ("flat",)})
    if not spec.pivot_diameter < spec.boss_diameter:
        text = f"leaves no wall in the boss; below {at_most(spec.boss_diameter * 0.999, 4)} mm works"
        raise ParameterError("pivot_diameter", spec.pivot_diameter, text)
    _check_pin(spec.pin_diameter, spec.width)
    edges = _whole(spec, _arm_edges, ("tip_height", "width", "boss_diameter"))
    own = [("pivot_diameter", 0j, spec.pivot_diameter), ("pin_diameter", spec.arm_length + 0j, spec.pin_diameter)]
    outline = checked_outline(edges, spec, [hole for hole in own if hole[2] > 0])
    return FollowerEnd(
        FollowerKind(spec.end),
        spec.follower_radius if spec.end == "mushroom" else 0.0,
        (0.0, spec.arm_length) if spec.end == "flat" else None,
        spec.arm_length,
        spec.face_offset,
        1 if spec.sense == "against" else -1,
        outline,
    )


def _arm_edges(spec: FollowerArmSpec) -> tuple[Edge, ...]:
    from geometry.cams import follower_shape as shape

    sense, boss, length = 1 if spec.sense == "against" else -1, spec.boss_diameter, spec.arm_length
    if spec.end == "flat":
        return shape.flat_arm(length, spec.width, spec.face_offset, boss, sense)
    if spec.end == "pointed":
        tip = math.radians(spec.tip_angle_deg), spec.tip_height
        return shape.pointed_arm(length, spec.width, boss, tip, sense)
    if spec.end == "mushroom":
        return shape.mushroom_arm(length, spec.width, boss, (spec.follower_radius, spec.tip_height), sense)
    return shape.round_arm(length, boss, spec.width)


def _whole(spec: AnyFollower, edges_of: Callable[[AnyFollower], tuple[Edge, ...]], keys: Sequence[str]) -> Any:
    """The edges of a spec where they make an outline; else refused by the first key whose lesser value does."""
    from msgspec.structs import replace

    from geometry.plate_outline import PlateOutline

    def whole(trial: AnyFollower) -> bool:
        try:
            return PlateOutline(edges_of(trial)).exists()
        except (GeometryError, ArithmeticError, ValueError):
            return False

    if whole(spec):
        return edges_of(spec)
    # what names its own key comes first
    refusal: ParameterError | None = None
    try:
        edges_of(spec)
    except ParameterError as found:
        refusal = found
    except (GeometryError, ArithmeticError, ValueError):
        pass
    if refusal is not None:
        raise refusal
    for key in () if is_trial() else keys:
        low, high = 0.0, float(getattr(spec, key))
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            low, high = (middle, high) if whole(replace(spec, **{key: middle})) else (low, middle)
        if low > _LEAST:
            text = f"leaves no whole outline; at most {at_most(low * (1 - 1e-3), 4)} mm works"
            raise ParameterError(key, getattr(spec, key), text)
    raise ParameterError(keys[0], getattr(spec, keys[0]), "leaves no whole outline with the other sizes; change them")


def _check_pin(diameter: float, width: float) -> None:
    if not diameter < width:
        raise ParameterError("pin_diameter", diameter, f"leaves no wall; below {at_most(width * 0.999, 4)} mm works")


def _check_end(spec: FollowerSpec | FollowerArmSpec, more: dict[str, tuple[str, ...]]) -> None:
    """Keys that belong to other ends are refused, and a mushroom has a radius."""
    owners = {"follower_radius": ("mushroom",), "pin_diameter": ("roller",), **more}
    for key, ends in owners.items():
        value = getattr(spec, key)
        if value and spec.end not in ends:
            hint = " (a roller is a part of its own)" if (key, spec.end) == ("follower_radius", "roller") else ""
            raise ParameterError(key, value, f"is for {' and '.join(ends)} followers{hint}; 0 works")
    if spec.end == "mushroom" and not spec.follower_radius:
        raise ParameterError("follower_radius", 0.0, "a mushroom has a radius above 0; 20 works")


def checked_roller(spec: RollerSpec) -> FollowerEnd:
    """A roller by its radius, its bore checked."""
    from geometry.cams.disk import FollowerKind
    from geometry.cams.follower_shape import FollowerEnd
    from geometry.wheel import check_wheel

    holes = hub_holes(_bore_of(spec), None, None)
    if not holes.bore_reach < spec.diameter / 2:
        raise wide_bore(spec, spec.diameter / 2, "leaves no wall in the roller")
    check_wheel(wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer), spec.diameter, holes)
    return FollowerEnd(FollowerKind.ROLLER, spec.diameter / 2)


def _bore_of(spec: RollerSpec) -> BoreTable | None:
    if spec.bore is not None and spec.bore_diameter > 0:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    return RoundBoreTable(spec.bore_diameter) if spec.bore_diameter > 0 else spec.bore


def follower_part(part_id: str, spec: FollowerSpec | FollowerArmSpec, end: FollowerEnd) -> Part:
    """The part of a stem or an arm."""
    assert end.outline is not None
    return flat_part(part_id, "follower" if end.arm_length is None else "follower_arm", spec, end.outline)


def roller_part(part_id: str, spec: RollerSpec, end: FollowerEnd) -> Part:
    """The part of a roller."""
    from geometry.errors import OffsetError
    from geometry.offset_region import OffsetRegion
    from geometry.profile import Label, Region, circle
    from geometry.wheel import wheel_body, wheel_sections

    holes = hub_holes(_bore_of(spec), None, None)
    shape = wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer)

    def outline(offset: float, depth: float) -> Profile:
        radius = end.radius + offset - depth
        if not radius > holes.bore_reach:
            least = holes.bore_reach - end.radius
            raise OffsetError(offset, "leaves nothing of the roller", least * (1 - 1e-6))
        return circle(radius, Label.BODY)

    def section(offset: float) -> OffsetRegion:
        if holes.bore is not None and end.radius + offset <= holes.bore_reach - offset:
            raise OffsetError(offset, "leaves no wall", (holes.bore_reach - end.radius) / 2 * (1 - 1e-6))
        return OffsetRegion(Region(outline(offset, 0.0), holes.profiles(offset)), offset, ())

    sections = wheel_sections(outline, end.radius, holes)
    return Part(
        part_id,
        "roller",
        lru_cache(maxsize=8)(section),
        lru_cache(maxsize=2)(lambda offset: wheel_body(shape, sections, offset)),
        spec.face_width,
        shape.is_plate,
        circles={"roller_diameter": spec.diameter},
        material=spec.material,
        colour=spec.colour,
        density=spec.density or density_of(spec.material),
    )
