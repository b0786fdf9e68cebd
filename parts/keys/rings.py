"""What wheels have in common that are external, or with ``internal`` a ring: holes, section, solid."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Protocol, TypeVar

from geometry.base.errors import OffsetError, ParameterError
from geometry.base.nearest import moved
from geometry.solids.hub_holes import HubHoles, least_wall
from parts.base.kind import Others
from parts.keys.base import check_idle, in_vain
from parts.keys.holes import holes_of
from parts.keys.pins import MARGIN, least_of, moved_region, wheel_holes
from parts.keys.wheel import WheelKeys, WheelKind

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile, Region
    from geometry.solids.body import Body

_ONLY_EXTERNAL = ("bore_diameter", "bore", "spokes", "web", "hub", "face_chamfer")


class SidedKeys(WheelKeys, kw_only=True):
    """Keys of such a wheel, as far as they are asked here; each kind says what its own mean."""

    internal: bool = False
    outer_diameter: float | None = None


class Sided(Protocol):
    """A wheel that knows its outline, mm."""

    @property
    def internal(self) -> bool:
        """Whether it is a ring."""

    @property
    def root_radius(self) -> float:
        """An external wheel is whole within it, a ring beyond it."""

    @property
    def outer_radius(self) -> float:
        """Of a ring."""

    @property
    def holes(self) -> HubHoles:
        """Bore and holes."""

    def profile(self, offset: float) -> Profile:
        """The outline, moved out of the material."""


K = TypeVar("K", bound=SidedKeys)
T = TypeVar("T", bound=Sided)


class SidedKind(WheelKind[K, T]):
    """A kind of wheel that may be a ring."""

    def idle(self, keys: K, others: Others) -> Iterator[ParameterError]:
        """What a ring has not, or a wheel that is none."""
        return _idle(keys)

    def outline(self, thing: T, offset: float) -> Profile:
        """The outline, moved."""
        return moved(thing.profile, offset)

    def section(self, keys: K, thing: T, offset: float) -> OffsetRegion:
        """The exact section, moved."""
        return moved_region(lambda by: _region(thing, by), offset)

    def solid(self, keys: K, thing: T, offset: float) -> Body:
        """The wheel with its web, hub and chamfers, or the ring, which has none."""
        from geometry.solids.body import plate

        if keys.internal:
            return plate(self.section(keys, thing, offset).region, 0.0, keys.face_width)
        return super().solid(keys, thing, offset)


def _idle(keys: SidedKeys) -> Iterator[ParameterError]:
    """What a ring has not, or a wheel that is none."""
    if keys.internal:
        yield from in_vain(keys, _ONLY_EXTERNAL, "only_of_external")
    else:
        yield from in_vain(keys, ("outer_diameter",), "only_of_internal")


def sided_holes(keys: SidedKeys, wheel: Sided, reached: str) -> HubHoles:
    """Bore and holes of a wheel, or those in the rim of a ring; ``reached``: the code where holes come to its outline.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    check_idle(_idle(keys))
    if keys.internal:
        return _ring_holes(keys, wheel, reached)
    return wheel_holes(keys, wheel.root_radius)


def _ring_holes(keys: SidedKeys, wheel: Sided, reached: str) -> HubHoles:
    holes = holes_of(keys)
    least = least_wall(wheel.root_radius) * (1 + MARGIN)
    for key, group in holes.groups():
        group.check(key)
        circle, needed = group.pitch_circle_diameter, 2 * (wheel.root_radius + least) + group.diameter
        if circle < needed:
            raise ParameterError(f"{key}.pitch_circle_diameter", circle, reached, least_of(needed, circle))
    HubHoles(None, holes.round_holes).check(max(wheel.outer_radius, holes.reach * 2 + least))
    beyond = max(wheel.root_radius, holes.reach) + least
    if wheel.outer_radius < beyond:
        wide = least_of(2 * beyond, 2 * wheel.outer_radius)
        raise ParameterError("outer_diameter", keys.outer_diameter, "leaves_no_rim", wide)
    return holes


def _region(wheel: Sided, offset: float) -> Region:
    """The section, moved ``offset`` mm out of the material.

    Raises
    ------
    GeometryError
        A slot closes, a tip or a wall does not survive.
    """
    from geometry.plane.profile import Label, Region, circle

    outline, holes = wheel.profile(offset), wheel.holes.profiles(offset)
    if not wheel.internal:
        if wheel.holes.number and wheel.root_radius + offset <= wheel.holes.reach - offset:
            raise OffsetError(offset, "leaves_no_rim")
        return Region(outline, holes)
    if -2 * offset >= wheel.outer_radius - max(wheel.root_radius, wheel.holes.reach):
        raise OffsetError(offset, "leaves_no_rim")
    return Region(circle(wheel.outer_radius + offset, Label.BODY), (outline, *holes))
