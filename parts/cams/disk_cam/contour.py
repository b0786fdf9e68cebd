"""The key ``contour`` of a disk cam: an outline of arcs and lines, from which the follower's motion comes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Protocol

from msgspec import Struct

from geometry.base.errors import Nearest, ParameterError
from parts.base.schema import nearest_key
from parts.keys.base import MOST_LENGTH, check_idle, degrees, either, in_vain, part_mm

if TYPE_CHECKING:
    from geometry.cams.motion.follower_motion import FollowerMotion
    from geometry.laws.contour import Contour

# shares of a size at which another one is tried
_TRIED = (0.9, 1.1, 0.75, 4 / 3, 0.5, 2.0, 0.25, 4.0, 0.1, 10.0, -1.0)
_FLANK_RADIUS = part_mm(
    "above 0 convex, below 0 hollow; default: straight flanks, or the arcs of lift, nose radius and angle",
    least=-MOST_LENGTH,
    example=80.0,
)
_RISE_ANGLE = degrees("cam angle of the rise, half of the whole action", above=0, most=180, example=75.0)


class ContourTable(Struct, forbid_unknown_fields=True):
    """Base circle, flanks and a nose that touch: of lift, nose, angle and flank three, or two for straight flanks."""

    nose_radius: Annotated[float, part_mm("radius of the nose", above=0, example=8.0)] | None = None
    rise_angle_deg: Annotated[float, _RISE_ANGLE] | None = None
    flank_radius: Annotated[float, _FLANK_RADIUS] | None = None


class ContourKeys(Protocol):
    """Keys of a cam that has a contour."""

    lift: float
    table_tolerance: float
    follower_radius: float
    follower_offset: float
    base_circle_radius: float | None
    contour: ContourTable | None

    @property
    def follower(self) -> str:
        """Shape of the follower's end."""

    @property
    def phases(self) -> object:
        """Phases of a motion."""

    @property
    def motion_table(self) -> object:
        """A table of a motion."""

    @property
    def oscillating(self) -> object:
        """The arm of a follower that swings."""


def contour_of(keys: ContourKeys) -> Contour:
    """The contour of the keys; refusals name ``contour``."""
    from geometry.laws.contour import contour

    table, base = keys.contour, keys.base_circle_radius
    assert table is not None
    assert base is not None
    angle, flank = table.rise_angle_deg, table.flank_radius
    if flank == 0:
        raise ParameterError("contour.flank_radius", 0.0, "no_flank_radius", Nearest(None))
    return contour(
        base,
        keys.lift or None,
        table.nose_radius,
        None if angle is None else math.radians(angle),
        None if flank is None else 1 / flank,
    )


def _motion(keys: ContourKeys) -> FollowerMotion:
    """Rise, the same backwards, and rest on the base circle."""
    from geometry.cams.motion.follower_motion import TURN, dwell, follower_motion, return_, rise
    from geometry.cams.plane.disk import FollowerKind, check_radius
    from geometry.laws.contour import flat_law, roller_law

    check_radius(FollowerKind(keys.follower), keys.follower_radius)
    shape = contour_of(keys)
    law = flat_law(shape) if keys.follower == "flat" else roller_law(shape, keys.follower_radius)
    back = law.reversed_in_time()
    moving = [rise(shape.rise_angle, shape.lift, law), return_(shape.rise_angle, shape.lift, back)]
    return follower_motion(moving if shape.is_eccentric else [*moving, dwell(TURN - 2 * shape.rise_angle)])


def contour_motion(keys: ContourKeys) -> FollowerMotion:
    """The motion that the contour gives.

    Raises
    ------
    ParameterError
        What has no place beside a contour, or sizes that no outline has.
    """
    assert keys.contour is not None
    if keys.phases is not None:
        raise either("phases", None, "contour")
    if keys.motion_table is not None:
        raise either("motion_table", None, "contour")
    check_idle(in_vain(keys, ("table_tolerance",), "tolerance_without_table"))
    if keys.oscillating is not None:
        raise ParameterError("contour", None, "contour_needs_slide")
    if keys.base_circle_radius is None:
        raise ParameterError("base_circle_radius", None, "contour_needs_base")
    try:
        return _motion(keys)
    except ParameterError as refusal:
        if refusal.name == "radius":
            raise refusal.renamed("follower_radius") from refusal
        if refusal.name != "contour":
            raise
        raise _told(keys, refusal) from refusal


def _told(keys: ContourKeys, refusal: ParameterError) -> ParameterError:
    """The refusal told of the first size that alone can cure it."""
    table = keys.contour
    assert table is not None
    if refusal.code == "contour_overdetermined":
        return ParameterError("contour.flank_radius", table.flank_radius, refusal.code, Nearest(None))
    if refusal.code == "eccentric_has_no_flank":
        key = "flank_radius" if table.flank_radius is not None else "rise_angle_deg"
        return ParameterError(f"contour.{key}", getattr(table, key), refusal.code, Nearest(None))
    if refusal.code == "contour_too_few":
        return refusal
    given = {f"contour.{key}": getattr(table, key) for key in ("rise_angle_deg", "nose_radius", "flank_radius")}
    given |= {"lift": keys.lift or None, "base_circle_radius": keys.base_circle_radius}
    for key, value in given.items():
        if value is not None and (found := _working(keys, key, value)) is not None:
            return refusal.told_of(key, value, found)
    return refusal


def _working(keys: ContourKeys, key: str, value: float) -> Nearest | None:
    """The nearest value of a key with which the follower moves."""
    ways = [value * share for share in _TRIED]
    if key == "contour.rise_angle_deg":
        ways = [way for way in ways if 0 < way < 180]
    return nearest_key(keys, key, value, ways, lambda changed: _motion(changed).pieces)
