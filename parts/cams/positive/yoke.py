"""The part kind ``yoke_frame``: the follower of a cam of constant breadth, which touches it from both sides."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from msgspec import Meta

from geometry.base.errors import OffsetError, ParameterError, limit
from geometry.base.record import Record
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, circle
from geometry.solids.body import plate
from geometry.solids.plate import PlateSlot, moved_profile, rounded
from parts.base.kind import Kind, Others, Report
from parts.base.links import owner_of
from parts.base.part_keys import MaterialKeys
from parts.cams.disk_cam.part import CAM, EVEN_CAM, CamSpec
from parts.keys.base import mm

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam
    from geometry.solids.body import Body

_MOST = 100_000.0
# straight ledge beside the stem, mm: what a cutter's width takes off it must not use it up
_LEDGE = 0.5
# thinnest wall of a frame, mm
_LEAST_WALL = 0.05


class YokeFrameSpec(MaterialKeys, forbid_unknown_fields=True, tag_field="kind", tag="yoke_frame"):
    """Keys of ``yoke_frame``."""

    of: Annotated[str, Meta(description="the cam: a part of kind cam, flat or roller, of constant breadth")]
    clearance: Annotated[float, mm("play of the cam between faces or rollers", least=0, most=10)] = 0.0
    wall: Annotated[float, mm("width of the frame's bars, or about pins and slot", least=_LEAST_WALL, most=_MOST)] = 8.0
    side_clearance: Annotated[float, mm("flat: beside the cam in the window", least=0.01, most=_MOST)] = 2.0
    corner_radius: Annotated[float, mm("of the frame's outer corners", least=0, most=_MOST)] = 0.0
    stem_width: Annotated[float, mm("of the guided stem", above=0, most=_MOST)] = 12.0
    stem_above: Annotated[float, mm("length of the stem above the frame; 0 is none", least=0, most=_MOST)] = 60.0
    stem_below: Annotated[float, mm("length of the stem below the frame; 0 is none", least=0, most=_MOST)] = 0.0
    pin_diameter: Annotated[float, mm("rollers: holes of their pins", above=0, most=_MOST)] = 4.0
    shaft_diameter: Annotated[float, mm("rollers: width of the slot for the cam's shaft", above=0, most=_MOST)] = 10.0
    thickness: (
        Annotated[float, mm("of the plate; default: face_width of the cam", least=0.01, most=10_000, example=3.0)]
        | None
    ) = None


class YokeFrame(Record):
    """A frame that exists: breadth between faces or roller centres with the play, and its place at cam angle 0, mm.

    ``middle``: height of the frame's middle over the cam's axis at cam angle 0; ``half_width`` of the window.
    """

    cam: DiskCam
    breadth: float
    middle: float
    half_width: float
    thickness: float
    play: float = 0.0


def _flat_reach(cam: DiskCam) -> float:
    """Greatest distance of a flat follower's cam from the axis, mm.

    (R_b + S)^2 + S'^2 changes by 2 S' (R_b + S + S''): it is greatest where S' = 0, or at a joint where S' jumps.
    """
    import numpy as np

    found = []
    for piece in cam.motion.pieces:
        places = piece.extremes(0)
        found.append(np.hypot(cam.slide.start_height + piece.value(places, 0), piece.value(places, 1)).max())
    return float(max(found))


def _check_sizes(keys: YokeFrameSpec, frame: YokeFrame, lift: float) -> None:
    width = 2 * (frame.half_width + keys.wall) if frame.cam.is_flat else _plate_width(keys)
    # the stem stands at x = e of a flat follower
    width -= 2 * _LEDGE + 2 * abs(frame.cam.slide.offset)
    stem, corner = keys.stem_width, keys.corner_radius
    if stem > width - 2 * corner:
        if corner > 0 and stem <= width:
            raise ParameterError("corner_radius", corner, "cuts_into_stem", limit((width - stem) / 2, corner))
        most = width - 2 * corner
        raise ParameterError("stem_width", stem, "wider_than_frame", limit(most, stem) if most > 0 else None)
    if frame.cam.is_flat:
        # of a square corner of the bars the middle is left
        if corner > keys.wall:
            raise ParameterError("corner_radius", corner, "no_bar_at_corner", limit(keys.wall, corner))
        return
    # the pin goes through the roller
    pin, shaft = keys.pin_diameter, keys.shaft_diameter
    if pin > (most := 2 * max(frame.cam.radius - _LEAST_WALL, frame.cam.radius / 2)):
        raise ParameterError("pin_diameter", pin, "pin_fills_roller", limit(most, pin))
    # the slot's end and a pin's hole, one above the other
    room = frame.breadth / 2 - (lift + shaft + pin) / 2 - _LEAST_WALL
    if room < -1e-9:
        if shaft + 2 * room > 0:
            raise ParameterError("shaft_diameter", shaft, "slot_meets_pin", limit(shaft + 2 * room, shaft))
        raise ParameterError("pin_diameter", pin, "pin_meets_slot")


def _plate_width(spec: YokeFrameSpec) -> float:
    """Of the plate with the pins, mm."""
    return max(spec.shaft_diameter, spec.pin_diameter) + 2 * spec.wall


def _region(spec: YokeFrameSpec, frame: YokeFrame, offset: float) -> Region:
    """Frame with its window, or plate with pin holes and slot, moved ``offset`` mm out of the material."""
    middle = 1j * frame.middle
    if -2 * offset >= spec.wall:
        raise OffsetError(offset, "no_bar", -spec.wall / 2 * (1 - 1e-6))
    if frame.cam.is_flat:
        half, height = frame.half_width, frame.breadth / 2
        # clockwise: the material is on the left
        window = [middle + complex(x * half, y * height) for x, y in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
        holes: tuple[Profile, ...] = (moved_profile(rounded([(corner, 0.0) for corner in window]), offset),)
        stem = frame.cam.slide.offset
        outer = _outline(spec, half + spec.wall, height + spec.wall, middle, offset, stem)
        return Region(outer, holes)
    lift, pin = frame.cam.motion.lift, spec.pin_diameter / 2 - offset
    if not pin > 0:
        raise OffsetError(offset, "pin_holes_closed", spec.pin_diameter / 2 * (1 - 1e-6))
    pins = [middle + side * 0.5j * frame.breadth for side in (1, -1)]
    ends = [_slot_middle(frame) + side * 0.5j * lift for side in (-1, 1)]
    slot = PlateSlot(ends[0], ends[1], spec.shaft_diameter).profile(offset)
    round_holes = tuple(circle(pin, Label.HOLE, hole=True, centre=at) for at in pins)
    half = _plate_width(spec) / 2
    outer = _outline(spec, half, frame.breadth / 2 + spec.pin_diameter / 2 + spec.wall, middle, offset, 0.0)
    return Region(outer, (slot, *round_holes))


def _slot_middle(frame: YokeFrame) -> complex:
    """The shaft goes from the slot's end to the other as the frame rises: its place in the frame is -S."""
    low, high = frame.cam.motion.extremes()
    return -0.5j * (low + high)


def _outline(
    spec: YokeFrameSpec, half_width: float, half_height: float, middle: complex, offset: float, stem: float
) -> Profile:
    """The outer boundary: a rectangle with a stem above, below, or both."""
    x, r, s = half_width, spec.corner_radius, spec.stem_width / 2
    top, bottom = (middle + side * 1j * half_height for side in (1, -1))
    corners: list[tuple[complex, float]] = [(bottom + x, r), (top + x, r)]
    for length, edge, side in ((spec.stem_above, top, 1), (spec.stem_below, bottom, -1)):
        if side < 0:
            corners += [(top - x, r), (bottom - x, r)]
        if length > 0:
            tip = edge + 1j * side * length
            corners += [(at + stem, 0.0) for at in (edge + side * s, tip + side * s, tip - side * s, edge - side * s)]
    return moved_profile(rounded(corners), offset)


class Yoke(Kind[YokeFrameSpec, YokeFrame]):
    """The frame about a cam of constant breadth."""

    name, keys, made_from = "yoke_frame", YokeFrameSpec, EVEN_CAM
    drawing = "parts.cams.drawings"

    def thing(self, keys: YokeFrameSpec, others: Others) -> YokeFrame:
        """The frame of another part's cam, which must be of constant breadth; its sizes fit."""
        from geometry.cams.plane.positive import yoke_breadth
        from geometry.cams.plane.walls import path_reach

        owner = owner_of(keys.of, others, CamSpec)
        cam = CAM.thing(owner, others)
        try:
            breadth = yoke_breadth(cam)
        except ParameterError as refusal:
            raise ParameterError("of", keys.of, refusal.code, **refusal.numbers) from refusal
        low, high = cam.motion.extremes()
        # the upper face or roller follows S, the lower one stands a breadth below it
        middle = cam.slide.start_height - (breadth / 2)
        # the cam turns through every direction: all of it must pass beside
        reach = path_reach(cam) - cam.radius if not cam.is_flat else _flat_reach(cam)
        thickness = keys.thickness or owner.face_width
        frame = YokeFrame(cam, breadth + keys.clearance, middle, reach + keys.side_clearance, thickness, keys.clearance)
        _check_sizes(keys, frame, high - low)
        return frame

    def section(self, keys: YokeFrameSpec, thing: YokeFrame, offset: float) -> OffsetRegion:
        """Frame with its window, or plate with pin holes and slot."""
        return OffsetRegion(_region(keys, thing, offset), offset, ())

    def solid(self, keys: YokeFrameSpec, thing: YokeFrame, offset: float) -> Body:
        """The section, extruded."""
        return plate(_region(keys, thing, offset), 0.0, thing.thickness)

    def height(self, keys: YokeFrameSpec, thing: YokeFrame) -> float:
        """The plate's thickness."""
        return thing.thickness

    def report(self, keys: YokeFrameSpec, thing: YokeFrame) -> Report:
        """Breadth and lift."""
        from geometry.cams.plane.positive import breadth_error

        motion = thing.cam.motion
        return Report(
            quantities={
                "yoke_breadth": thing.breadth,
                "yoke_breadth_error": breadth_error(motion),
                "lift": motion.lift,
            }
        )


YOKE_FRAME = Yoke()
