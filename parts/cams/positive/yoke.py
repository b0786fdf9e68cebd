"""The part kind ``yoke_frame``: the follower of a cam of constant breadth, which touches it from both sides."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta

from geometry.base.errors import OffsetError, ParameterError, limit
from geometry.base.record import Record, replace
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, circle
from geometry.solids.plate import PlateSlot, moved_profile, rounded
from parts.base.kind import Kind, Others, Report
from parts.base.links import owner_of
from parts.base.part_keys import MaterialKeys
from parts.cams.disk_cam.part import CAM, EVEN_CAM, CamSpec
from parts.keys.base import check_idle, in_vain, mm, part_mm

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam

# straight ledge beside the stem, mm: what a cutter's width takes off it must not use it up
_LEDGE = 0.5
# thinnest wall of a frame, mm
_LEAST_WALL = 0.05
# usual sizes where there is room, mm
_STEM, _PIN, _SHAFT = 12.0, 4.0, 10.0

_STEM_WIDTH = part_mm(f"of the guided stem; default: {_STEM:g}, or what a frame has", above=0, example=_STEM)
_PIN_DIAMETER = part_mm(f"rollers: holes of their pins; default: {_PIN:g}, or half of a roller", above=0, example=_PIN)
_SHAFT_DIAMETER = part_mm(
    f"rollers: width of the slot for the cam's shaft; default: {_SHAFT:g}, or half of a base circle",
    above=0,
    example=_SHAFT,
)
_THICKNESS = mm("of the plate; default: face_width of the cam", least=0.01, most=10_000, example=3.0)


class YokeFrameSpec(MaterialKeys, forbid_unknown_fields=True, tag_field="kind", tag="yoke_frame"):
    """Keys of ``yoke_frame``."""

    of: Annotated[str, Meta(description="the cam: a part of kind cam, flat or roller, of constant breadth")]
    clearance: Annotated[float, mm("play of the cam between faces or rollers", least=0, most=10)] = 0.0
    wall: Annotated[float, part_mm("width of the frame's bars, or about pins and slot", least=_LEAST_WALL)] = 8.0
    side_clearance: Annotated[float, part_mm("flat: beside the cam in the window", least=0.01)] = 2.0
    corner_radius: Annotated[float, part_mm("of the frame's outer corners", least=0)] = 0.0
    stem_width: Annotated[float, _STEM_WIDTH] | None = None
    stem_above: Annotated[float, part_mm("length of the stem above the frame; 0 is none", least=0)] = 60.0
    stem_below: Annotated[float, part_mm("length of the stem below the frame; 0 is none", least=0)] = 0.0
    pin_diameter: Annotated[float, _PIN_DIAMETER] | None = None
    shaft_diameter: Annotated[float, _SHAFT_DIAMETER] | None = None
    thickness: Annotated[float, _THICKNESS] | None = None


class YokeFrame(Record):
    """A frame that exists: breadth between faces or roller centres with the play, and its place at cam angle 0, mm.

    ``middle``: height of the frame's middle over the cam's axis at cam angle 0; ``half_width`` of the window. Stem,
    pins and shaft: as the keys say, or as wide as there is room; 0 where there are none.
    """

    cam: DiskCam
    breadth: float
    middle: float
    half_width: float
    thickness: float
    play: float = 0.0
    stem: float = 0.0
    pin: float = 0.0
    shaft: float = 0.0


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


def _with_pins(keys: YokeFrameSpec, frame: YokeFrame, lift: float) -> YokeFrame:
    """The frame of rollers with their pins and the shaft's slot."""
    radius, between = frame.cam.radius, frame.breadth - lift - 2 * _LEAST_WALL
    # the pin goes through the roller
    widest = 2 * max(radius - _LEAST_WALL, radius / 2)
    pin = keys.pin_diameter or (_PIN if widest >= _PIN else radius)
    if pin > widest:
        raise ParameterError("pin_diameter", pin, "pin_fills_roller", limit(widest, pin))
    # the slot's end and a pin's hole, one above the other
    room = between - pin
    shaft = keys.shaft_diameter or (_SHAFT if room >= _SHAFT else frame.cam.base_radius)
    if room - shaft < -2e-9:
        if room > 0:
            raise ParameterError("shaft_diameter", shaft, "slot_meets_pin", limit(room, shaft))
        raise ParameterError("pin_diameter", pin, "pin_meets_slot")
    return replace(frame, pin=pin, shaft=shaft)


def _with_stem(keys: YokeFrameSpec, frame: YokeFrame) -> YokeFrame:
    """The frame with its stem, where it has one, and corners that leave it its root."""
    corner, flat = keys.corner_radius, frame.cam.is_flat
    whole = _width(keys, frame) - 2 * _LEDGE
    if keys.stem_above > 0 or keys.stem_below > 0:
        # it stands at x = e of a flat follower
        width = whole - 2 * abs(frame.cam.slide.offset)
        most = width - 2 * corner
        stem = keys.stem_width or (min(_STEM, max(most, _LEAST_WALL)) if width > 0 else _STEM)
        if stem > most:
            if corner > 0 and stem <= width:
                raise ParameterError("corner_radius", corner, "cuts_into_stem", limit((width - stem) / 2, corner))
            raise ParameterError("stem_width", stem, "wider_than_frame", limit(most, stem) if most > 0 else None)
        frame = replace(frame, stem=stem)
    elif not flat and corner > whole / 2:
        raise ParameterError("corner_radius", corner, "no_bar_at_corner", limit(whole / 2, corner))
    # of a square corner of the bars the middle is left
    if flat and corner > keys.wall:
        raise ParameterError("corner_radius", corner, "no_bar_at_corner", limit(keys.wall, corner))
    return frame


def _width(keys: YokeFrameSpec, frame: YokeFrame) -> float:
    """Of the frame, or of the plate with the pins, mm."""
    return 2 * ((frame.half_width if frame.cam.is_flat else max(frame.shaft, frame.pin) / 2) + keys.wall)


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
        outer = _outline(spec, frame, half + spec.wall, height + spec.wall, offset, stem)
        return Region(outer, holes)
    lift, pin = frame.cam.motion.lift, frame.pin / 2 - offset
    if not pin > 0:
        raise OffsetError(offset, "pin_holes_closed", frame.pin / 2 * (1 - 1e-6))
    pins = [middle + side * 0.5j * frame.breadth for side in (1, -1)]
    # the shaft goes from the slot's end to the other as the frame rises: its place in the frame is -S
    low, high = frame.cam.motion.extremes()
    ends = [-0.5j * (low + high) + side * 0.5j * lift for side in (-1, 1)]
    slot = PlateSlot(ends[0], ends[1], frame.shaft).profile(offset)
    round_holes = tuple(circle(pin, Label.HOLE, hole=True, centre=at) for at in pins)
    half_height = (frame.breadth + frame.pin) / 2 + spec.wall
    outer = _outline(spec, frame, _width(spec, frame) / 2, half_height, offset, 0.0)
    return Region(outer, (slot, *round_holes))


def _outline(
    spec: YokeFrameSpec, frame: YokeFrame, half_width: float, half_height: float, offset: float, stem: float
) -> Profile:
    """The outer boundary: a rectangle with a stem above, below, or both."""
    x, r, s, middle = half_width, spec.corner_radius, frame.stem / 2, 1j * frame.middle
    top, bottom = (middle + side * 1j * half_height for side in (1, -1))
    corners: list[tuple[complex, float]] = [(bottom + x, r), (top + x, r)]
    for far, edge, side in ((spec.stem_above, top, 1), (spec.stem_below, bottom, -1)):
        if side < 0:
            corners += [(top - x, r), (bottom - x, r)]
        if far > 0:
            tip = edge + 1j * side * far
            corners += [(at + stem, 0.0) for at in (edge + side * s, tip + side * s, tip - side * s, edge - side * s)]
    return moved_profile(rounded(corners), offset)


class Yoke(Kind[YokeFrameSpec, YokeFrame]):
    """The frame about a cam of constant breadth."""

    name, keys, made_from = "yoke_frame", YokeFrameSpec, EVEN_CAM
    drawing = "parts.cams.drawings"

    def idle(self, keys: YokeFrameSpec, others: Others) -> Iterator[ParameterError]:
        """Sizes of a stem that is not there, or of what a frame of the other follower has."""
        if owner_of(keys.of, others, CamSpec).follower == "flat":
            yield from in_vain(keys, ("pin_diameter", "shaft_diameter"), other='follower = "roller"')
        else:
            yield from in_vain(keys, ("side_clearance",), other='follower = "flat"')
        if not (keys.stem_above or keys.stem_below):
            yield from in_vain(keys, ("stem_width",), other="stem_above")

    def thing(self, keys: YokeFrameSpec, others: Others) -> YokeFrame:
        """The frame of another part's cam, which must be of constant breadth; its sizes fit."""
        from geometry.cams.plane.positive import yoke_breadth
        from geometry.cams.plane.walls import path_reach

        owner = owner_of(keys.of, others, CamSpec)
        cam = CAM.thing(owner, others)
        check_idle(self.idle(keys, others))
        try:
            breadth = yoke_breadth(cam)
        except ParameterError as refusal:
            raise ParameterError("of", keys.of, refusal.code, **refusal.numbers) from refusal
        # the upper face or roller follows S, the lower one stands a breadth below it
        middle = cam.slide.start_height - (breadth / 2)
        # the cam turns through every direction: all of it must pass beside
        reach = path_reach(cam) - cam.radius if not cam.is_flat else _flat_reach(cam)
        thickness = keys.thickness or owner.face_width
        frame = YokeFrame(cam, breadth + keys.clearance, middle, reach + keys.side_clearance, thickness, keys.clearance)
        return _with_stem(keys, frame if cam.is_flat else _with_pins(keys, frame, cam.motion.lift))

    def section(self, keys: YokeFrameSpec, thing: YokeFrame, offset: float) -> OffsetRegion:
        """Frame with its window, or plate with pin holes and slot."""
        return OffsetRegion(_region(keys, thing, offset), offset, ())

    def height(self, keys: YokeFrameSpec, thing: YokeFrame) -> float:
        """The plate's thickness."""
        return thing.thickness

    def report(self, keys: YokeFrameSpec, thing: YokeFrame) -> Report:
        """Breadth and lift."""
        from geometry.cams.plane.positive import breadth_error

        motion = thing.cam.motion
        found = {
            "yoke_breadth": thing.breadth,
            "yoke_breadth_error": breadth_error(motion),
            "lift": motion.lift,
        }
        sizes = {"stem_width": thing.stem, "pin_diameter": thing.pin, "shaft_diameter": thing.shaft}
        return Report(quantities=found | {key: size for key, size in sizes.items() if size > 0})


YOKE_FRAME = Yoke()
