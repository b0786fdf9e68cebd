"""The part kinds ``follower`` (a translating stem), ``follower_arm`` (an oscillating one) and ``roller``."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Annotated, Literal, TypeVar

from msgspec import Meta, field
from msgspec.structs import replace

from geometry.base.errors import GeometryError, Nearest, OffsetError, ParameterError
from geometry.base.nearest import nearest
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, circle
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelShape, check_wheel
from parts.base.kind import Others, Report
from parts.base.schema import nearest_key
from parts.bodies.plate import Extruded, FlatKeys, HolesAt, Slots, checked_outline
from parts.cams.wheel import Turned
from parts.keys.base import MOST_LENGTH, check_idle, degrees, in_vain, part_mm
from parts.keys.holes import BoredKeys, check_shape, holes_of, thin_wall, wide_bore
from parts.keys.wheel import FaceChamfer, FaceChamferTable, HubTable, shape_of

if TYPE_CHECKING:
    from geometry.cams.contact.outlines import FollowerEnd
    from geometry.solids.plate import Edge, PlateOutline

# sizes of which a lesser one is tried where an outline is none, and shares that are tried
_STEM_SIZES = ("corner_radius", "plate_thickness")
_ARM_SIZES = ("tip_height", "width", "boss_diameter")
_SMALLER = (0.75, 0.5, 0.25, 0.1, 0.03, 0.01, 0.001, 1e-4)
EndName = Literal["pointed", "roller", "mushroom", "flat"]
End = Annotated[EndName, Meta(description="what touches the cam; a roller is a part of its own", examples=["roller"])]
Tip = Annotated[float, degrees("angle of a pointed tip", least=5, most=170)]
Pin = Annotated[float, part_mm("hole for the roller's pin; 0 is none", least=0)]
Radius = Annotated[float, part_mm("radius of a mushroom's face", least=0)]


class FollowerSpec(FlatKeys, forbid_unknown_fields=True, tag_field="kind", tag="follower"):
    """Keys of ``follower``."""

    end: End
    stem_width: Annotated[float, part_mm("width of the stem", above=0)] = 10.0
    stem_length: Annotated[float, part_mm("from the reference point to the far end", above=0)] = 80.0
    follower_radius: Radius = 0.0
    plate_diameter: Annotated[float, part_mm("width of a flat or mushroom plate", least=0)] = 0.0
    plate_thickness: Annotated[float, part_mm("thickness of that plate at its edge", above=0)] = 5.0
    corner_radius: Annotated[float, part_mm("rounding between plate and stem", least=0)] = 0.0
    tip_angle_deg: Tip = 60.0
    pin_diameter: Pin = 0.0


_ARM_LENGTH = part_mm("to the roller's centre, tip, arc's centre or a flat bar's end", above=0, example=60.0)
_SENSE = Meta(description="as the cam's: which side of the arm looks at the cam")
_SLOTS = Meta(examples=[[{"start": [28.0, 0.0], "end": [36.0, 0.0], "width": 3.0}]])


class FollowerArmSpec(FlatKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="follower_arm"):
    """Keys of ``follower_arm``."""

    end: End
    arm_length: Annotated[float, _ARM_LENGTH]
    sense: Annotated[Literal["against", "with"], _SENSE] = "against"
    width: Annotated[float, part_mm("width of the arm; of a roller's arm its round end", above=0)] = 10.0
    boss_diameter: Annotated[float, part_mm("of the round end about the pivot", above=0)] = 16.0
    pivot_diameter: Annotated[float, part_mm("hole for the pivot", least=0)] = 6.0
    follower_radius: Radius = 0.0
    face_offset: Annotated[float, part_mm("flat face nearer to the cam than the pivot", least=-MOST_LENGTH)] = 0.0
    tip_angle_deg: Tip = 60.0
    tip_height: Annotated[float, part_mm("height of a tip, or of a mushroom's centre, over the arm", least=0)] = 10.0
    pin_diameter: Pin = 0.0
    holes: Annotated[HolesAt, Meta(examples=[[{"at": [20.0, 0.0], "diameter": 3.0}]])] = field(default_factory=list)
    slots: Annotated[Slots, _SLOTS] = field(default_factory=list)


class RollerSpec(BoredKeys, forbid_unknown_fields=True, tag_field="kind", tag="roller"):
    """Keys of ``roller``."""

    diameter: Annotated[float, part_mm("outer diameter", above=0, example=16.0)]
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0


F = TypeVar("F", FollowerSpec, FollowerArmSpec)


def _stem_edges(keys: FollowerSpec) -> tuple[Edge, ...]:
    from geometry.cams.contact import outlines as shape

    width, length = keys.stem_width, keys.stem_length
    if keys.end == "pointed":
        return shape.pointed_stem(width, length, math.radians(keys.tip_angle_deg))
    if keys.end == "roller":
        if not length > width / 2:
            if length == FollowerSpec(keys.end).stem_length:
                raise ParameterError.beyond(
                    "stem_width", width, "wider_than_twice_length", 2 * length * (1 - 1e-6), length=length
                )
            raise ParameterError.beyond("stem_length", length, "shorter_than_half_width", width / 2 * (1 + 1e-6))
        return shape.roller_stem(width, length)
    radius = keys.follower_radius if keys.end == "mushroom" else None
    return shape.plate_stem(width, length, (keys.plate_diameter, keys.plate_thickness), radius, keys.corner_radius)


def _arm_edges(keys: FollowerArmSpec) -> tuple[Edge, ...]:
    from geometry.cams.contact import outlines as shape

    sense, boss, length = 1 if keys.sense == "against" else -1, keys.boss_diameter, keys.arm_length
    if keys.end == "flat":
        return shape.flat_arm(length, keys.width, keys.face_offset, boss, sense)
    if keys.end == "pointed":
        tip = math.radians(keys.tip_angle_deg), keys.tip_height
        return shape.pointed_arm(length, keys.width, boss, tip, sense)
    if keys.end == "mushroom":
        return shape.mushroom_arm(length, keys.width, boss, (keys.follower_radius, keys.tip_height), sense)
    return shape.round_arm(length, boss, keys.width)


def _edges(keys: F, edges_of: Callable[[F], tuple[Edge, ...]], sizes: Iterable[str]) -> tuple[Edge, ...]:
    """The edges where they make an outline; else refused by the first of ``sizes`` whose lesser value does."""

    def whole(changed: F) -> bool:
        from geometry.solids.plate import PlateOutline

        try:
            return PlateOutline(edges_of(changed)).exists()
        except (ArithmeticError, ValueError):
            return False

    def lesser(name: str) -> Nearest | None:
        given: float = getattr(keys, name)
        return nearest_key(keys, name, given, [given * share for share in _SMALLER], whole)

    try:
        edges = edges_of(keys)
    except ParameterError as refusal:
        raise _tried(keys, refusal, whole) from refusal
    except (GeometryError, ArithmeticError):
        edges = ()
    if edges and whole(keys):
        return edges
    found = {name: lesser(name) for name in sizes}
    name = next((name for name, works in found.items() if works is not None), next(iter(found)))
    raise ParameterError(name, getattr(keys, name), "no_whole_outline", found[name])


def _tried(keys: F, refusal: ParameterError, whole: Callable[[F], bool]) -> ParameterError:
    """The refusal of one size; where the outline asks for more than that size alone, what it asks for."""

    def works(value: float) -> bool:
        return whole(replace(keys, **{refusal.name: value}))

    def cure() -> Nearest | None:
        own = refusal.nearest
        if own is None or not isinstance(own.value, float) or works(own.value):
            return own
        farther: tuple[float, ...] = _SMALLER if own.side == "at_most" else (1.01, 1.1, 1.5, 2.0, 4.0)
        limit = own.value
        return nearest(works, getattr(keys, refusal.name), [limit * share for share in (0.99, *farther)])

    return ParameterError(refusal.name, refusal.value, refusal.code, cure, **refusal.numbers)


# the ends that a key is of
_OF_ENDS: dict[str, tuple[str, ...]] = {
    "follower_radius": ("mushroom",), "pin_diameter": ("roller",), "tip_angle_deg": ("pointed",),
    **dict.fromkeys(("plate_diameter", "plate_thickness", "corner_radius"), ("flat", "mushroom")),
    "face_offset": ("flat",), "tip_height": ("pointed", "mushroom"),
}  # fmt: skip


def _check_radius(keys: FollowerSpec | FollowerArmSpec) -> None:
    """A mushroom has a radius."""
    if keys.end == "mushroom" and not keys.follower_radius:
        raise ParameterError("follower_radius", 0.0, "follower_without_radius", end="mushroom")


class Ended(Extruded[F, "FollowerEnd"]):
    """A stem or an arm, by what of it touches the cam."""

    drawing = "parts.cams.drawings"

    def idle(self, keys: F, others: Others) -> Iterator[ParameterError]:
        """Sizes of other ends."""
        for key, ends in _OF_ENDS.items():
            if keys.end not in ends and key in keys.__struct_fields__:
                code = "roller_is_a_part" if (key, keys.end) == ("follower_radius", "roller") else "for_other_ends"
                yield from in_vain(keys, (key,), code, ends=ends)

    def flat(self, thing: FollowerEnd) -> PlateOutline:
        """Its outline."""
        assert thing.outline is not None
        return thing.outline


class Follower(Ended[FollowerSpec]):
    """A translating follower."""

    name, keys = "follower", FollowerSpec

    def thing(self, keys: FollowerSpec, others: Others) -> FollowerEnd:
        """What of a stem touches the cam, and its outline, checked to exist."""
        from geometry.cams.contact.outlines import FollowerEnd
        from geometry.cams.plane.disk import FollowerKind

        check_idle(self.idle(keys, others))
        _check_radius(keys)
        if keys.end in ("flat", "mushroom") and keys.plate_diameter == 0:
            works = Nearest(2 * keys.stem_width)
            raise ParameterError("plate_diameter", 0.0, "follower_without_plate", works, end=keys.end)
        edges = _edges(keys, _stem_edges, _STEM_SIZES)
        outline = checked_outline(edges, keys, [("pin_diameter", 0j, keys.pin_diameter)] if keys.pin_diameter else ())
        radius = keys.follower_radius if keys.end == "mushroom" else 0.0
        reach = (-keys.plate_diameter / 2, keys.plate_diameter / 2) if keys.plate_diameter else None
        return FollowerEnd(FollowerKind(keys.end), radius, reach, outline=outline)


class FollowerArm(Ended[FollowerArmSpec]):
    """An oscillating follower."""

    name, keys = "follower_arm", FollowerArmSpec

    def thing(self, keys: FollowerArmSpec, others: Others) -> FollowerEnd:
        """What of an arm touches the cam, and its outline, checked to exist."""
        from geometry.cams.contact.outlines import FollowerEnd
        from geometry.cams.plane.disk import FollowerKind

        check_idle(self.idle(keys, others))
        _check_radius(keys)
        edges = _edges(keys, _arm_edges, _ARM_SIZES)
        own = [("pivot_diameter", 0j, keys.pivot_diameter), ("pin_diameter", keys.arm_length + 0j, keys.pin_diameter)]
        outline = checked_outline(edges, keys, [hole for hole in own if hole[2] > 0])
        return FollowerEnd(
            FollowerKind(keys.end),
            keys.follower_radius if keys.end == "mushroom" else 0.0,
            (0.0, keys.arm_length) if keys.end == "flat" else None,
            keys.arm_length,
            keys.face_offset,
            1 if keys.sense == "against" else -1,
            outline,
        )


class Roller(Turned[RollerSpec, "FollowerEnd"]):
    """A roller of a cam follower."""

    name, keys = "roller", RollerSpec

    def thing(self, keys: RollerSpec, others: Others) -> FollowerEnd:
        """A roller by its radius, its bore checked."""
        from geometry.cams.contact.outlines import FollowerEnd
        from geometry.cams.plane.disk import FollowerKind

        end = FollowerEnd(FollowerKind.ROLLER, keys.diameter / 2)
        check_shape(keys, holes_of, end.radius)
        holes = self.holes(keys, end)
        if not holes.bore_reach < end.radius:
            raise wide_bore(keys, end.radius, "no_wall_in_roller")
        check_wheel(shape_of(keys), keys.diameter, holes)
        return end

    def body(self, keys: RollerSpec, thing: FollowerEnd) -> WheelShape:
        """By the keys."""
        return shape_of(keys)

    def holes(self, keys: RollerSpec, thing: FollowerEnd) -> HubHoles:
        """The bore."""
        return holes_of(keys)

    def inside(self, thing: FollowerEnd) -> float:
        """All of it."""
        return thing.radius

    def outline(self, thing: FollowerEnd, offset: float) -> tuple[Profile, tuple[object, ...]]:
        """The circle."""
        if not thing.radius + offset > 0:
            raise OffsetError(offset, "leaves_no_rim", -thing.radius * (1 - 1e-6))
        return circle(thing.radius + offset, Label.BODY), ()

    def section(self, keys: RollerSpec, thing: FollowerEnd, offset: float) -> OffsetRegion:
        """The circle with its bore."""
        reach = self.holes(keys, thing).bore_reach
        if reach > 0 and thing.radius + offset <= reach - offset:
            raise OffsetError(offset, "leaves_no_wall", (reach - thing.radius) / 2 * (1 - 1e-6))
        outer = self.outline(thing, offset)[0]
        return OffsetRegion(Region(outer, self.holes(keys, thing).profiles(offset)), offset, ())

    def report(self, keys: RollerSpec, thing: FollowerEnd) -> Report:
        """Its diameter, and a wall about its bore that breaks."""
        return Report(
            findings=thin_wall(thing.radius, self.holes(keys, thing)), circles={"roller_diameter": keys.diameter}
        )


FOLLOWER, FOLLOWER_ARM, ROLLER = Follower(), FollowerArm(), Roller()
