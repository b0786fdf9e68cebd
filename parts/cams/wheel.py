"""What disk cams and rollers share: the keys of their bodies, and solids that are wheels."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Literal, TypeVar

from geometry.base.errors import OffsetError
from geometry.base.findings import Finding
from geometry.base.nearest import moved
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Profile, Region
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelShape, check_wheel, wheel_body, wheel_sections
from parts.base.kind import Kind
from parts.base.part_keys import MaterialKeys
from parts.base.schema import replaced
from parts.keys.holes import check_holes, check_shape, holes_of, wide_bore, wide_holes
from parts.keys.timing_mark import TimingMarkTable, with_timing_mark
from parts.keys.wheel import HubbedKeys, cross_holes, shape_of

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam
    from geometry.solids.body import Body
    from geometry.solids.cross_holes import CrossHole


Within = Literal["base_circle", "groove"]
# why a bore and why holes do not stay within
_WITHIN: dict[Within, tuple[str, str]] = {
    "base_circle": ("no_wall_to_base_circle", "holes_beyond_base_circle"),
    "groove": ("no_wall_to_groove", "holes_beyond_groove"),
}


class DiskKeys(HubbedKeys, kw_only=True):
    """Keys of the body of a cam."""

    timing_mark: TimingMarkTable | None = None


def inner_radius(cam: DiskCam) -> float:
    """The largest circle about the axis inside the cam, mm: that of the lowest follower."""
    import numpy as np

    angles = cam.motion.stack.extremes(0)[1]
    # both sides of every joint are the same in S
    return float(np.abs(cam.reference_point(angles)).min()) - cam.radius


def marked_holes(keys: DiskKeys, cam: DiskCam) -> HubHoles:
    """Bore, holes and timing mark of a cam."""
    return with_timing_mark(holes_of(keys), keys.timing_mark, cam, inner_radius(cam))


def check_disk(keys: DiskKeys, cam: DiskCam, within: Within = "base_circle") -> HubHoles:
    """The holes with the mark, which stay ``within`` the circle that is surely material; the body can be."""
    holes, inside = holes_of(keys), inner_radius(cam)
    wall, beyond = _WITHIN[within]
    check_shape(keys, holes_of, inside)
    if not holes.bore_reach < inside:

        def beside(path: str, size: float) -> bool:
            return bool(check_disk(replaced(keys, path, size), cam, within).number)

        raise wide_bore(keys, inside, wall, beside)
    if holes.reach > inside:
        raise wide_holes(keys, holes_of, inside, beyond, lambda k: bool(check_disk(k, cam, within).number))
    check_holes(keys, holes_of, inside)
    marked = with_timing_mark(holes, keys.timing_mark, cam, inside)
    check_wheel(shape_of(keys), 2 * inside, marked)
    return marked


K = TypeVar("K", bound=MaterialKeys)
T = TypeVar("T")


class Turned(Kind[K, T]):
    """A kind whose solid is a wheel: outline, holes, hub and chamfers."""

    drawing = "parts.cams.drawings"

    def body(self, keys: K, thing: T) -> WheelShape:
        """Thickness, hub and chamfers."""
        raise NotImplementedError

    def holes(self, keys: K, thing: T) -> HubHoles:
        """Bore and other holes."""
        raise NotImplementedError

    def inside(self, thing: T) -> float:
        """Radius of a circle about the axis that is surely material, mm."""
        raise NotImplementedError

    def outline(self, thing: T, offset: float) -> tuple[Profile, tuple[object, ...]]:
        """The outer boundary moved ``offset`` mm out of the material, and places where it is trimmed."""
        raise NotImplementedError

    def section(self, keys: K, thing: T, offset: float) -> OffsetRegion:
        """The exact section with every boundary moved out of the material."""
        holes, inside = self.holes(keys, thing), self.inside(thing)
        if not inside + offset > (holes.reach - offset if holes.number else 0.0):
            least = (holes.reach - inside) / 2 if holes.number else -inside
            raise OffsetError(offset, "leaves_no_rim", least * (1 - 1e-9))
        outer, gaps = moved(partial(self.outline, thing), offset, "leaves_no_outline")
        found = (Finding("outline_trimmed", float(len(gaps)), offset),) if gaps else ()
        return OffsetRegion(Region(outer, holes.profiles(offset)), offset, found)

    def cross_holes(self, keys: K, thing: T) -> tuple[CrossHole, ...]:
        """For set screws."""
        return cross_holes(self.body(keys, thing))

    def solid(self, keys: K, thing: T, offset: float) -> Body:
        """The wheel."""
        whole = self.section(keys, thing, offset).region.outer

        def outline(moved: float, depth: float) -> Profile:
            return whole if depth == 0 else self.outline(thing, moved - depth)[0]

        sections = wheel_sections(outline, self.inside(thing), self.holes(keys, thing))
        return wheel_body(self.body(keys, thing), sections, offset)

    def height(self, keys: K, thing: T) -> float:
        """Of the rim."""
        return self.body(keys, thing).face_width

    def middle(self, keys: K, thing: T) -> float:
        """The height in the middle of what the chamfers leave of the face, mm."""
        body = self.body(keys, thing)
        return (body.chamfer_below + body.face_width - body.chamfer_above) / 2

    def is_plate(self, keys: K, thing: T) -> bool:
        """Without hub and chamfers."""
        return self.body(keys, thing).is_plate
