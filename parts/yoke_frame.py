"""The part kind ``yoke_frame``: the follower of a cam of constant breadth, which touches it from both sides."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from geometry.body import plate
from geometry.errors import OffsetError, ParameterError, at_most
from geometry.offset_region import OffsetRegion
from geometry.plate_outline import PlateSlot, moved_profile, rounded
from geometry.profile import Label, Profile, Region, circle
from parts.cam import CamSpec, checked_cam
from parts.keys import Colour, Density, Material, mm
from parts.links import owner_of
from parts.materials import density_of
from parts.part import Part

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam

_MOST = 100_000.0
# straight ledge beside the stem, mm: what a cutter's width takes off it must not use it up
_LEDGE = 0.5
# thinnest wall of a frame, mm
_LEAST_WALL = 0.05


class YokeFrameSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="yoke_frame"):
    """Frame about a cam, drawn as it stands at cam angle 0: two flat faces, or a plate with pins for two rollers."""

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
    thickness: Annotated[float, mm("of the plate; default: face_width of the cam", least=0.01, most=10_000)] | None = (
        None
    )
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


@dataclass(frozen=True, slots=True)
class YokeFrame:
    """A frame that exists: breadth between faces or roller centres with the play, and its place at cam angle 0, mm.

    ``middle``: height of the frame's middle over the cam's axis at cam angle 0; ``half_width`` of the window.
    """

    cam: DiskCam
    breadth: float
    middle: float
    half_width: float
    thickness: float
    play: float = 0.0


def checked_yoke(spec: YokeFrameSpec, parts: dict[str, Struct]) -> YokeFrame:
    """The frame of another part's cam.

    Raises
    ------
    ParameterError
        The cam is not of constant breadth, or the frame's sizes do not fit; names the key and what would work.
    """
    from geometry.cams.positive import breadth_error, yoke_breadth
    from geometry.cams.walls import path_reach

    owner = owner_of(spec.of, parts, CamSpec)
    cam = checked_cam(owner)
    try:
        breadth = yoke_breadth(cam)
    except ParameterError as refusal:
        if refusal.name == "motion":
            told = f"S(phi) + S(phi + 180) departs from H by {breadth_error(cam.motion):.6g} mm"
            remedy = "phases rise a, dwell 180 - a, return_ a, dwell 180 - a degrees with one law for both works"
        else:
            swings = refusal.name == "mount"
            told = "its follower oscillates" if swings else f"its {refusal.name} is {refusal.value}"
            remedy = "a translating cam, flat, or roller with follower_offset = 0, works"
        raise ParameterError("of", spec.of, f"is no cam of constant breadth: {told}; {remedy}") from refusal
    low, high = cam.motion.extremes()
    # the upper face or roller follows S, the lower one stands a breadth below it
    middle = cam.slide.start_height - (breadth / 2)
    # the cam turns through every direction: all of it must pass beside
    reach = path_reach(cam) - cam.radius if not cam.is_flat else _flat_reach(cam)
    thickness = spec.thickness or owner.face_width
    frame = YokeFrame(cam, breadth + spec.clearance, middle, reach + spec.side_clearance, thickness, spec.clearance)
    _check_sizes(spec, frame, high - low)
    return frame


def yoke_part(part_id: str, spec: YokeFrameSpec, frame: YokeFrame) -> Part:
    """The part of a frame."""
    from geometry.cams.positive import breadth_error

    section = lru_cache(maxsize=8)(lambda offset: OffsetRegion(_region(spec, frame, offset), offset, ()))
    return Part(
        part_id,
        "yoke_frame",
        section,
        lru_cache(maxsize=2)(lambda offset: plate(section(offset).region, 0.0, frame.thickness)),
        frame.thickness,
        quantities={
            "yoke_breadth": frame.breadth,
            "yoke_breadth_error": breadth_error(frame.cam.motion),
            "lift": frame.cam.motion.lift,
        },
        material=spec.material,
        colour=spec.colour,
        density=spec.density or density_of(spec.material),
    )


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


def _check_sizes(spec: YokeFrameSpec, frame: YokeFrame, lift: float) -> None:
    width = 2 * (frame.half_width + spec.wall) if frame.cam.is_flat else _plate_width(spec)
    # the stem stands at x = e of a flat follower
    width -= 2 * _LEDGE + 2 * abs(frame.cam.slide.offset)
    most = width - 2 * spec.corner_radius
    if spec.stem_width > most:
        if spec.corner_radius > 0 and spec.stem_width <= width:
            remedy = f"cuts into the stem; at most {at_most((width - spec.stem_width) / 2, 4)} mm works"
            raise ParameterError("corner_radius", spec.corner_radius, remedy)
        raise ParameterError(
            "stem_width", spec.stem_width, f"is wider than the frame; at most {at_most(max(most, 0.01), 4)} mm works"
        )
    if frame.cam.is_flat:
        # of a square corner of the bars the middle is left
        if spec.corner_radius > spec.wall:
            text = f"leaves no bar at the window's corner; at most {at_most(spec.wall)} mm works"
            raise ParameterError("corner_radius", spec.corner_radius, text)
        return
    # the pin goes through the roller
    if spec.pin_diameter > (most := 2 * max(frame.cam.radius - _LEAST_WALL, frame.cam.radius / 2)):
        text = f"leaves nothing of the roller; at most {at_most(most, 4)} mm works"
        raise ParameterError("pin_diameter", spec.pin_diameter, text)
    # the slot's end and a pin's hole, one above the other
    room = frame.breadth / 2 - (lift + spec.shaft_diameter + spec.pin_diameter) / 2 - _LEAST_WALL
    if room < -1e-9:
        least = spec.shaft_diameter + 2 * room
        if least > 0:
            raise ParameterError(
                "shaft_diameter", spec.shaft_diameter, f"meets a pin; at most {at_most(least, 4)} mm works"
            )
        raise ParameterError("pin_diameter", spec.pin_diameter, "meets the slot; a larger base circle of the cam works")


def _plate_width(spec: YokeFrameSpec) -> float:
    """Of the plate with the pins, mm."""
    return max(spec.shaft_diameter, spec.pin_diameter) + 2 * spec.wall


def _region(spec: YokeFrameSpec, frame: YokeFrame, offset: float) -> Region:
    """Frame with its window, or plate with pin holes and slot, moved ``offset`` mm out of the material."""
    middle = 1j * frame.middle
    if -2 * offset >= spec.wall:
        raise OffsetError(offset, "leaves no bar", -spec.wall / 2 * (1 - 1e-6))
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
        raise OffsetError(offset, "closes the pin holes", spec.pin_diameter / 2 * (1 - 1e-6))
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
