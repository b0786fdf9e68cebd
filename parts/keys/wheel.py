"""Scene keys that give a wheel its body: web, hub, face chamfers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Protocol, TypeVar

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.solids.hub_holes import Holed
from geometry.solids.wheel import Hub, Rim, Web, WheelShape, wheel_body, wheel_sections
from parts.base.kind import Kind
from parts.keys.base import degrees, mm, part_mm
from parts.keys.holes import Direction, HoledKeys, SpokesTable

if TYPE_CHECKING:
    from geometry.gears.teeth.tooth import ToothSide
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile
    from geometry.solids.body import Body
    from geometry.solids.cross_holes import CrossHole


class WebTable(Struct, forbid_unknown_fields=True):
    """The thin disk between rim and hub; without a hub, at one face, the floor of a bearing's seat."""

    thickness: Annotated[float, mm("thickness of the web along the axis", above=0, most=10_000, example=3.0)]
    rim_diameter: Annotated[float, part_mm("inner diameter of the rim", above=0, example=36.0)]
    shift: Annotated[float, mm("how far the web stands above the middle", least=-10_000, most=10_000)] = 0.0


class HubTable(Struct, forbid_unknown_fields=True):
    """The hub about the bore."""

    diameter: Annotated[float, part_mm("outer diameter of the hub", above=0, example=14.0)]
    below: Annotated[float, mm("how far the hub stands out below", least=0, most=10_000)] = 0.0
    above: Annotated[float, mm("how far the hub stands out above", least=0, most=10_000)] = 0.0


_FROM_END = part_mm(
    "from the end of the hub to their axes; default: the middle of what stands out, less its chamfer",
    above=0,
    example=4.0,
)


class SetScrewsTable(Struct, forbid_unknown_fields=True):
    """Round holes across the hub, where it stands out, through to the bore: to be tapped, or for pins."""

    diameter: Annotated[float, part_mm("diameter of each hole: 2.5 for M3, 3.3 for M4", above=0, example=2.5)]
    count: Annotated[int, Meta(ge=1, le=12, description="number of holes")] = 1
    angle_deg: Direction = 90.0
    spacing_deg: Annotated[float, degrees("from each to the next", least=-360, most=360)] = 90.0
    from_end: Annotated[float, _FROM_END] | None = None


class ScrewedHubTable(HubTable, forbid_unknown_fields=True):
    """The hub about the bore, with holes for set screws."""

    set_screws: SetScrewsTable | None = None


class FaceChamferTable(Struct, forbid_unknown_fields=True):
    """45 degree chamfers along every edge of the end faces."""

    below: Annotated[float, mm("chamfer of the lower face: against the elephant foot", least=0, most=100)] = 0.0
    above: Annotated[float, mm("chamfer of the upper face", least=0, most=100)] = 0.0


FaceChamfer = Annotated[float, mm("45 degree chamfer along every edge of both end faces", least=0, most=100)]


class HubbedKeys(HoledKeys, kw_only=True):
    """Keys of a disk: and with a hub and chamfers."""

    hub: ScrewedHubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0


class WheelKeys(HubbedKeys, kw_only=True):
    """Keys of a wheel: and with spokes or a web."""

    spokes: SpokesTable | None = None
    web: WebTable | None = None


class Bodied(Protocol):
    """Keys of a part with a hub and chamfers; those of wheels have a ``web`` too."""

    face_width: float
    face_chamfer: float | FaceChamferTable

    @property
    def hub(self) -> HubTable | None:
        """The hub about the bore."""


def shape_of(keys: Bodied) -> WheelShape:
    """Thickness, web, hub and chamfers."""
    return wheel_shape(keys.face_width, getattr(keys, "web", None), keys.hub, keys.face_chamfer)


def both_faces(chamfer: float | FaceChamferTable) -> FaceChamferTable:
    """The chamfers of both faces, where one number may stand for both."""
    return chamfer if isinstance(chamfer, FaceChamferTable) else FaceChamferTable(chamfer, chamfer)


def wheel_shape(
    face_width: float, web: WebTable | None, hub: HubTable | None, chamfer: float | FaceChamferTable
) -> WheelShape:
    """The keys of a wheel as its exact shape."""
    both = both_faces(chamfer)
    return WheelShape(
        face_width,
        None if web is None else Web(web.thickness, web.rim_diameter, web.shift),
        None if hub is None else Hub(hub.diameter, hub.below, hub.above, _set_screws(face_width, hub, both)),
        both.below,
        both.above,
    )


def cross_holes(shape: WheelShape) -> tuple[CrossHole, ...]:
    """Those across the hub of a wheel."""
    return () if shape.hub is None else shape.hub.set_screws


def _set_screws(face_width: float, hub: HubTable, chamfers: FaceChamferTable) -> tuple[CrossHole, ...]:
    """The holes across a hub, where it stands out farther."""
    table = hub.set_screws if isinstance(hub, ScrewedHubTable) else None
    if table is None:
        return ()
    from geometry.solids.cross_holes import CrossHole

    length, chamfer = (hub.above, chamfers.above) if hub.above >= hub.below else (hub.below, chamfers.below)
    if not length:
        raise ParameterError("hub.set_screws", None, "set_screws_in_no_hub", Nearest(None))
    inset = (length + chamfer) / 2 if table.from_end is None else table.from_end
    height = face_width + length - inset if hub.above >= hub.below else inset - length
    angles = (math.radians(table.angle_deg + k * table.spacing_deg) for k in range(table.count))
    return tuple(CrossHole(height, table.diameter / 2, angle) for angle in angles)


K = TypeVar("K", bound=HubbedKeys)
T = TypeVar("T", bound=Holed)


class WheelKind(Kind[K, T]):
    """A kind of wheel: its section with web, hub and chamfers."""

    def side(self, thing: T, offset: float) -> ToothSide:
        """The lower side of tooth 1 moved ``offset`` mm out of the material, where every tooth has the same."""
        raise NotImplementedError

    def section(self, keys: K, thing: T, offset: float) -> OffsetRegion:
        """The exact section, moved."""
        from geometry.gears.teeth.offset import toothed_region

        return toothed_region(self.side, thing, offset)

    def outline(self, thing: T, offset: float) -> Profile:
        """The outer boundary moved ``offset`` mm out of the material."""
        return self.side(thing, offset).profile()

    def shape(self, keys: K, thing: T) -> WheelShape:
        """Thickness, web, hub and chamfers."""
        return wheel_shape(self.height(keys, thing), getattr(keys, "web", None), keys.hub, keys.face_chamfer)

    def core(self, keys: K, thing: T) -> float:
        """Radius within which web and hub stand, mm."""
        return thing.root_radius

    def rim(self, thing: T) -> Rim | None:
        """Teeth that are no one section from face to face; None: they are."""
        return None

    def cross_holes(self, keys: K, thing: T) -> tuple[CrossHole, ...]:
        """For set screws."""
        return cross_holes(self.shape(keys, thing))

    def solid(self, keys: K, thing: T, offset: float) -> Body:
        """The wheel with its web, hub and chamfers."""

        def outline(moved: float, depth: float) -> Profile:
            return self.outline(thing, moved - depth)

        sections = wheel_sections(outline, self.core(keys, thing), thing.holes)
        return wheel_body(self.shape(keys, thing), replace(sections, rim=self.rim(thing)), offset)

    def is_plate(self, keys: K, thing: T) -> bool:
        """Whether there is nothing but the section."""
        return self.rim(thing) is None and self.shape(keys, thing).is_plate
