"""The assembly ``cam_model``: a disk cam and its sliding follower out of flat parts and dowels, to be cut and turned.

From the back, in boards: frame; cam on its axle, with the roller or the flat follower; over a roller a washer and the
follower, which lies on two spacers about each guide pin too and cannot tip. Two pins of the frame guide the follower by
its slot, on its line of motion: the slot is as long as the lift and the pins' spacing together, and slack at both ends.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.solids.hub_holes import least_wall
from parts.cams.disk_cam.part import CamSpec, cam_of, greatest_radius
from parts.cams.wheel import inner_radius
from parts.keys.base import degrees, mm
from parts.keys.cam import (
    BaseCircle,
    FollowerOffset,
    FollowerRadius,
    LeastCurvature,
    LeastReturn,
    LeastTransmission,
    Lift,
    MotionTable,
    Phases,
    TableTolerance,
    turn,
)
from parts.keys.law import with_own_laws
from parts.keys.timing_mark import PLACES
from parts.recipes.making import Making, check_play, hole, place
from parts.recipes.recipe import Expansion, ModelKeys, Recipe

# mm: slack of the slot at each end; frame below the cam, about its axle and above the pins; wall about holes; of a flat
# plate beyond its contact; how much shorter the roller's pin is than what it holds
_SLACK, _BELOW, _BESIDE, _ABOVE, _WALL, _EDGE, _SHORT = 1.0, 3.0, 13.0, 15.0, 3.0, 5.0, 1.0
# mm: least width of a spacer's ring
_LEAST_RING = 1.0
# mm: diameter of the mark at cam angle 0, and its least; least of the axle
_MARK, _LEAST_MARK, _LEAST_AXLE = 2.0, 0.5, 0.5
# mm: thickness and rounding of a flat follower's plate; of the frame, corners and least width
_PLATE, _ROUNDING, _CORNER, _FRAME_WIDTH = 8.0, 3.0, 6.0, 60.0
_CAM_KEYS = (
    "follower", "lift", "phases", "motion_table", "table_tolerance", "follower_radius", "follower_offset",
    "base_circle_radius", "least_transmission_angle_deg",
    "least_return_transmission_angle_deg", "least_curvature_radius",
)  # fmt: skip

_SLOT_START = mm(
    "of the slot, above the roller's centre or the flat face; default: as near as the parts allow",
    above=0,
    most=10_000,
    example=36.0,
)
_CLEARANCE = mm("of the slot on its pins and of holes on the dowels that turn in them", least=0, most=5)


class CamModelKeys(ModelKeys, kw_only=True, tag="cam_model"):
    """Keys of ``cam_model``."""

    follower: Annotated[Literal["roller", "flat"], Meta(description="shape of the follower's end", examples=["roller"])]
    lift: Lift = 0.0
    phases: Annotated[Phases, with_own_laws(turn("polynomial_345"))] | None = None
    motion_table: MotionTable | None = None
    table_tolerance: TableTolerance = 0.0
    follower_radius: FollowerRadius = 0.0
    follower_offset: FollowerOffset = 0.0
    base_circle_radius: BaseCircle | None = None
    least_transmission_angle_deg: LeastTransmission | None = None
    least_return_transmission_angle_deg: LeastReturn | None = None
    least_curvature_radius: LeastCurvature = 0.0
    plate_thickness: Annotated[float, mm("of all flat parts", least=0.5, most=100)] = 3.0
    clearance: Annotated[float, _CLEARANCE] = 0.2
    axle_diameter: Annotated[float, mm("of the cam's axle", least=_LEAST_AXLE, most=200)] = 6.0
    guide_pin_diameter: Annotated[float, mm("of the two pins in the follower's slot", least=0.5, most=100)] = 4.0
    guide_pin_spacing: Annotated[float, mm("between the axes of these pins", above=0, most=1000)] = 10.0
    roller_pin_diameter: Annotated[float, mm("of the roller's pin", least=0.5, most=100)] = 3.0
    stem_width: Annotated[float, mm("width of the follower's stem", above=0, most=1000)] = 12.0
    slot_start: Annotated[float, _SLOT_START] | None = None
    cam_angle_deg: Annotated[float, degrees("cam angle at which it is drawn", least=-360, most=360)] = 0.0


class _Making(Making):
    """The tables as they grow; the axle is at 0, the cam's lower face at height 0."""

    def __init__(self, keys: CamModelKeys) -> None:
        super().__init__("cam_model", keys.plate_thickness, keys)
        self.keys, self.rolls = keys, keys.follower == "roller"
        pins = [keys.roller_pin_diameter] if self.rolls else []
        check_play(keys.clearance, keys.axle_diameter, keys.guide_pin_diameter, *pins)
        given = {key: getattr(keys, key) for key in _CAM_KEYS}
        self.given = {key: value for key, value in given.items() if value is not None}
        self.cam = cam_of(CamSpec(**self.given))
        start, (low, high) = self.cam.slide.start_height, self.cam.motion.extremes()
        self.low, self.high = start + low, start + high
        self.travel = high - low
        least = self._least_start()
        if keys.slot_start is not None and keys.slot_start < least:
            raise ParameterError("slot_start", keys.slot_start, "pin_meets_cam", Nearest(least, "at_least"))
        self.slot_start = keys.slot_start or least
        # in whole mm; the lower pin is in the slot where the follower is highest, the upper one where it is lowest
        lower = math.ceil(round(self.high + self.slot_start + _SLACK, 6))
        self.pins = [lower, lower + keys.guide_pin_spacing]
        self.slot_end = self.pins[1] - self.low + _SLACK

    def _least_start(self) -> float:
        """Start of the slot for which the lower pin is clear of cam and roller, and the end before it is solid, mm."""
        keys = self.keys
        before = max(keys.follower_radius + _WALL, keys.stem_width) if self.rolls else _PLATE + _ROUNDING
        return float(math.ceil(before + (keys.guide_pin_diameter + keys.clearance) / 2))

    def _mark(self) -> float:
        """Diameter of the mark at cam angle 0, where bore and edge are near each other a third of that wall, mm."""
        keys, inside = self.keys, inner_radius(self.cam)
        # the mark's place is found among so many
        solid = inside - 2 * least_wall(inside) - inside / PLACES
        bore = (keys.axle_diameter + keys.clearance) / 2
        if solid - bore < _LEAST_MARK:
            axle = 2 * (solid - _LEAST_MARK) - keys.clearance
            cure = limit(axle, keys.axle_diameter) if axle >= _LEAST_AXLE else Nearest(None)
            raise ParameterError("axle_diameter", keys.axle_diameter, "no_wall_to_base_circle", cure, inside=inside)
        return min(_MARK, max(math.floor(10 * (inside - bore) / 3) / 10, _LEAST_MARK))

    def all(self) -> Expansion:
        """Every part, as it stands on what is made before, and one turn of the cam."""
        keys, thick = self.keys, self.thickness
        self._frame()
        offset = keys.follower_offset
        label = f"S {self.travel:.6g}" + (f" e {offset:.6g}" if offset else "")
        self.part(
            "cam", kind="cam", face_width=thick, bore_diameter=keys.axle_diameter + keys.clearance, label=label,
            timing_mark={"diameter": self._mark()}, **self.given,
        )  # fmt: skip
        self.told("cam", **{key: key for key in _CAM_KEYS})
        self.put("coaxial", "frame", "cam", height=thick, rotation_deg=keys.cam_angle_deg)
        stem = self._stem()
        if self.rolls:
            stem["pin_diameter"] = keys.roller_pin_diameter
            self._roller()
        else:
            width = math.ceil(self.cam.least_plate_diameter() + 2 * _EDGE)
            stem |= {"plate_diameter": max(float(width), keys.stem_width + 4 * _ROUNDING),
                     "plate_thickness": _PLATE, "corner_radius": _ROUNDING}  # fmt: skip
            self.put("cam_follower", "cam", "follower")
        self.part("follower", kind="follower", end=keys.follower, face_width=thick, **stem)
        self.found.drives.append({"instance": "cam", "turns": 1.0})
        self.order("spaced" if "spacer_1" in self.found.instances else keys.follower)
        self.name_all()
        return self.found

    def _frame(self) -> None:
        """The frame with the cam's axle and the guide's pins in it; they stand out two boards beyond the cam.

        It ends below the cam, which does not scrape the table on which the frame stands.
        """
        keys, thick, offset = self.keys, self.thickness, self.keys.follower_offset
        below = max(_BESIDE, math.ceil(round(greatest_radius(self.cam) + _BELOW, 6)))
        top, at = self.pins[1] + _ABOVE, [complex(offset, height) for height in self.pins]
        self.part(
            "frame", kind="plate", face_width=thick, corner_radius=_CORNER,
            width=max(_FRAME_WIDTH, 2 * abs(offset) + keys.axle_diameter + 2 * _BESIDE), height=round(top + below, 6),
            centre=place(complex(offset, (top - below) / 2), 0.0)[:2],
            holes=[hole(0j, keys.axle_diameter), *(hole(one, keys.guide_pin_diameter) for one in at)],
        )  # fmt: skip
        self.found.instances["frame"] = {"part": "frame", "at": [0.0, 0.0, -thick], "held": True}
        self.pin("axle", keys.axle_diameter, 4 * thick)
        self.fix("frame", "axle", 0j, 0.0)
        self.pin("guide_pin", keys.guide_pin_diameter, 4 * thick)
        self.fix_each("frame", "guide_pin", [(one, 0.0) for one in at])
        if self.rolls:
            self._spacers(at)

    def _spacers(self, at: list[complex]) -> None:
        """Two about each guide pin, on the frame: the follower lies on them as high as on roller and washer."""
        keys, thick = self.keys, self.thickness
        bore = keys.guide_pin_diameter + keys.clearance
        outside = min(keys.guide_pin_diameter + 2 * _WALL, keys.guide_pin_spacing - _SHORT, keys.stem_width)
        # pins too near each other leave none room
        if outside < bore + 2 * _LEAST_RING:
            return
        self.plate("spacer", outside, [hole(0j, bore)], label=False)
        self.fix_each("frame", "spacer", [(one, layer * thick) for one in at for layer in (1, 2)])

    def _stem(self) -> dict[str, object]:
        """The follower's stem: its slot, and as much beyond it as the stem is wide."""
        keys = self.keys
        slot = {"start": [0.0, self.slot_start], "end": [0.0, round(self.slot_end, 2)],
                "width": keys.guide_pin_diameter + keys.clearance}  # fmt: skip
        return {
            "stem_width": keys.stem_width, "stem_length": round(self.slot_end + keys.stem_width, 2), "slots": [slot]
        }  # fmt: skip

    def _roller(self) -> None:
        """The roller on its pin, which is glued into the follower, a board's thickness over it."""
        keys, thick = self.keys, self.thickness
        bore = keys.roller_pin_diameter + keys.clearance
        self.part("roller", kind="roller", face_width=thick, diameter=2 * keys.follower_radius, bore_diameter=bore)
        self.put("cam_follower", "cam", "roller")
        outside = min(keys.roller_pin_diameter + 2 * _WALL, keys.stem_width)
        self.plate("washer", outside, [hole(0j, bore)], label=False)
        self.fix("roller", "washer", 0j, thick)
        self.fix("roller", "follower", 0j, 2 * thick)
        self.pin("roller_pin", keys.roller_pin_diameter, 3 * thick - _SHORT)
        self.fix("follower", "roller_pin", 0j, _SHORT - 2 * thick)


CAM_MODEL = Recipe(CamModelKeys, lambda keys: _Making(keys).all())
