"""The assembly ``drawing_machine``: two cams on one shaft draw a picture in one turn of a crank, of flat parts.

The upper cam moves the pen along y, the lower one the table with the paper along x, the other way round: so each slide
is guided by itself, and nothing need slide in two slots at once. From below, in boards: frame; table; washer of its
roller; its roller and cam; those of the pen's slide; its washer; that slide; above all a hand crank. Two pins of the
frame guide each slide by its slot; rubber bands from a peg of the slide to the nearer one hold the rollers on their
cams. A key through both cams holds them a quarter of a turn apart, as their slides stand.
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta
from msgspec.structs import replace

from geometry.base.errors import ConvergenceError, Nearest, ParameterError, limit
from geometry.base.nearest import kept, nearest
from parts.cams.disk_cam.part import USUAL_ROLLER_SHARE, CamSpec, cam_of, greatest_radius
from parts.cams.wheel import inner_radius
from parts.keys.base import degrees, mm
from parts.keys.cam import LeastCurvature
from parts.keys.picture import MOST_POINTS, Picture
from parts.recipes.making import Making, check_play, hole, place
from parts.recipes.recipe import Expansion, ModelKeys, Recipe, Table, Turns

if TYPE_CHECKING:
    from collections.abc import Callable

    from geometry.cams.motion.follower_motion import FollowerMotion
    from geometry.curves.curve import Complex

# mm: walls about holes; between what moves; of slots beyond the way of a pin; how much shorter dowels are than what
# they go through; of the table about the picture; of the frame about its pins; roundings
_WALL, _APART, _SLACK, _SHORT, _ABOUT, _BESIDE, _CORNER = 3.0, 1.0, 1.0, 0.5, 8.0, 12.0, 5.0
# mm: wall of a roller about its bore
_RIM = 1.0
# even places of the picture's line, beside its corners
_ROWS = 720
# mm: a larger prime circle is none to be made; the handle above its crank, and that where nobody says it
_MOST_PRIME, _HANDLE, _CRANK_LENGTH = 500.0, 25.0, 30.0
# of the smoothing, and of the pressure angle, tried where they ask for such cams; of one that works, how near to the
# least the search ends, as each trial makes both motions
_SMOOTHER, _STEEPER, _NEAR = (1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0), (1.5, 2.0, 3.0, 4.0, 6.0), 0.02

_PICTURE = 'closed line by its corners x, y, y upwards, in any unit; or { file = "heart.svg" }, a path of an SVG'
_SIZE = mm("of the drawing: the greater one of its width and height", above=0, most=500)
_SMOOTHING = mm(
    "how far the drawn line may leave the picture: it rounds corners, so that the pen need not jerk",
    least=0.01,
    most=50,
)
_START = Meta(ge=1, le=MOST_POINTS, description="corner of the picture at which the pen begins")
_PRESSURE = degrees("greatest pressure angle of both cams, rise and return", least=5, most=60)
_PRIME = mm("of both cams; default: the least, by pressure angle, curvature and room", above=0, most=_MOST_PRIME)
_ROLLER = mm("radius of both rollers", least=1, most=100)
_CLEARANCE = mm("of slots and holes on the dowels that run in them", least=0, most=5)
_CRANK = mm("of the hand crank, to its handle; default: 30, or what clears the pen", above=0, most=1000, example=30.0)
_SLIDE = mm("of the pen's slide, and of the table about its slot", above=0, most=200)


class DrawingMachineKeys(ModelKeys, kw_only=True, tag="drawing_machine"):
    """Keys of ``drawing_machine``."""

    picture: Annotated[Picture, Meta(max_length=MOST_POINTS, description=_PICTURE)]
    size: Annotated[float, _SIZE] = 40.0
    smoothing: Annotated[float, _SMOOTHING] = 0.5
    start_point: Annotated[int, _START] = 1
    backwards: Annotated[bool, Meta(description="the pen goes through the corners in the other order")] = False
    greatest_pressure_angle_deg: Annotated[float, _PRESSURE] = 30.0
    least_curvature_radius: LeastCurvature = 0.0
    prime_circle_radius: Annotated[float, _PRIME] | None = None
    follower_radius: Annotated[float, _ROLLER] = 6.0
    turns: Annotated[Turns, Meta(description="of the crank")] = 1.0
    plate_thickness: Annotated[float, mm("of all flat parts", least=0.5, most=100)] = 3.0
    clearance: Annotated[float, _CLEARANCE] = 0.2
    axle_diameter: Annotated[float, mm("of the shaft", least=1, most=200)] = 8.0
    guide_pin_diameter: Annotated[float, mm("of guide pins, pegs and key", least=0.5, most=100)] = 4.0
    guide_pin_spacing: Annotated[float, mm("between the axes of both pins of a slide", above=0, most=1000)] = 40.0
    roller_pin_diameter: Annotated[float, mm("of the rollers' pins", least=0.5, most=100)] = 3.0
    slide_width: Annotated[float, _SLIDE] = 16.0
    pen_diameter: Annotated[float, mm("of the pen, and of its hole", least=1, most=50)] = 8.0
    pen_length: Annotated[float, mm("of the pen", least=10, most=500)] = 100.0
    crank_length: Annotated[float, _CRANK] | None = None


class _Making(Making):
    """The tables as they grow; the shaft is at 0, the table's lower face at height 0."""

    def __init__(self, keys: DrawingMachineKeys) -> None:
        super().__init__("drawing_machine", keys.plate_thickness, keys)
        self.keys = keys
        check_play(keys.clearance, keys.axle_diameter, keys.guide_pin_diameter, keys.roller_pin_diameter)
        self.slot = keys.guide_pin_diameter + keys.clearance
        self.half, self.ring = keys.slide_width / 2, keys.guide_pin_diameter / 2 + _WALL
        if keys.follower_radius < (least := (keys.roller_pin_diameter + keys.clearance) / 2 + _RIM):
            raise ParameterError.beyond("follower_radius", keys.follower_radius, "no_wall_beside_holes", least)
        holes = max(self.slot, keys.roller_pin_diameter, keys.pen_diameter)
        if keys.slide_width < (least := holes + 2 * _WALL):
            raise ParameterError.beyond("slide_width", keys.slide_width, "no_wall_beside_holes", least)
        # the spacers about both pins of a slide stand beside each other
        if keys.guide_pin_spacing < (least := 2 * self.ring + _APART):
            raise ParameterError.beyond("guide_pin_spacing", keys.guide_pin_spacing, "no_wall_beside_holes", least)
        self.line = self._line()
        self.cams = self._cams()
        self._lay_out()

    def _line(self) -> Complex:
        """The corners of the drawing as both lifts go through them, mm: the table goes to the left under the pen."""
        import numpy as np

        keys = self.keys
        corners = np.array([complex(*corner) for corner in keys.picture])
        if keys.start_point > len(corners):
            last = Nearest(len(corners), "at_most")
            raise ParameterError("start_point", keys.start_point, "fewer_corners", last, number=len(corners))
        corners = np.roll(corners, 1 - keys.start_point)
        if keys.backwards:
            corners = np.roll(corners[::-1], 1)
        width, height = float(np.ptp(corners.real)), float(np.ptp(corners.imag))
        if min(width, height) < 1e-3 * max(width, height) or not max(width, height) > 0:
            raise ParameterError("picture", len(corners), "picture_is_flat")
        corners = corners - complex(corners.real.max(), corners.imag.min())
        corners = -keys.size / max(width, height) * corners.conj()
        # what stands twice is one corner
        return corners[np.abs(corners - np.roll(corners, 1)) > 1e-6]

    def _cams(self) -> list[Table]:
        """The keys of both cams, the lower one's first."""
        from geometry.cams.picture import along

        keys = self.keys
        shares, places = along(self.line, min(_ROWS, 2000 - len(self.line)))
        degs = (360 * shares).tolist()
        tables = [[(a, s) for a, s in zip(degs, part.tolist(), strict=True)] for part in (places.real, places.imag)]

        def tabled(smoothing: float) -> list[Table]:
            return [
                {"follower": "roller", "follower_radius": keys.follower_radius, "motion_table": table,
                 "table_tolerance": smoothing / math.sqrt(2), "base_circle_radius": 2 * keys.size}
                for table in tables
            ]  # fmt: skip

        def smoothed(smoothing: float) -> list[FollowerMotion]:
            return [cam_of(CamSpec(**one)).motion for one in tabled(smoothing)]

        found = tabled(keys.smoothing)
        try:
            motions = smoothed(keys.smoothing)
        except ParameterError as refusal:
            if refusal.name != "table_tolerance":
                raise
            raise refusal.renamed("smoothing", math.sqrt(2)) from refusal
        self.low = [float(motion.extremes()[0]) for motion in motions]
        self.high = [float(motion.extremes()[1]) for motion in motions]
        least = self._least_prime(motions, smoothed)
        self.prime = least if keys.prime_circle_radius is None else keys.prime_circle_radius
        if self.prime < least:
            raise ParameterError(
                "prime_circle_radius", self.prime, "prime_circle_too_small", Nearest(least, "at_least")
            )
        for one in found:
            one["base_circle_radius"] = self.prime - keys.follower_radius
        self.made = [cam_of(CamSpec(**one)) for one in found]
        self.reach = max(greatest_radius(cam) for cam in self.made)
        return found

    def _least_prime(self, motions: list[FollowerMotion], smoothed: Callable[[float], list[FollowerMotion]]) -> float:
        """The prime circle, whole mm, that keeps pressure angle, curvature, and slides off the shaft.

        ``smoothed``: the motions of both cams by another smoothing.
        """
        from geometry.cams.plane.synthesis import convex_roller_base_radius, keeps_convex_radius, roller_prime_radius

        keys, r = self.keys, self.keys.follower_radius
        convex = max(keys.least_curvature_radius, r / USUAL_ROLLER_SHARE - r)
        room = max(self.half + max(self.ring, keys.axle_diameter / 2 + _WALL), r + keys.pen_diameter / 2)
        # the key goes through both cams between the shaft and their base circles
        room = max(room, r + keys.axle_diameter / 2 + keys.guide_pin_diameter + 2 * _RIM - _APART)

        def pressed(greatest_deg: float) -> float:
            steep = math.radians(greatest_deg)
            return max(roller_prime_radius(motion, 0.0, steep, steep) for motion in motions)

        def is_blunt(smoothing: float) -> bool:
            return all(keeps_convex_radius(motion, r, convex, _MOST_PRIME - r) for motion in smoothed(smoothing))

        pressure = pressed(keys.greatest_pressure_angle_deg)
        if pressure > _MOST_PRIME:
            raise self._too_large("greatest_pressure_angle_deg", _STEEPER, lambda deg: pressed(deg) <= _MOST_PRIME)
        try:
            curved = r + max(convex_roller_base_radius(motion, r, convex) for motion in motions)
        except ConvergenceError:
            curved = math.inf
        if curved > _MOST_PRIME:
            raise self._too_large("smoothing", _SMOOTHER, is_blunt)
        return float(math.ceil(round(max(room + _APART - min(self.low), pressure, curved), 6)))

    def _too_large(self, name: str, shares: tuple[float, ...], holds: Callable[[float], bool]) -> ParameterError:
        """The refusal of a key that asks for cams that are none to be made; what it offers makes a whole machine."""
        given = getattr(self.keys, name)

        def cure() -> Nearest | None:
            found = nearest(holds, given, [given * share for share in shares], share=_NEAR)
            return found if found is not None and kept(partial(self._works, name), found.value) else None

        return ParameterError(name, given, "cams_too_large", cure, most=_MOST_PRIME)

    def _works(self, name: str, value: object) -> bool:
        """Whether a machine of another value of a key can be made."""
        return bool(_Making(replace(self.keys, **{name: value})))

    def _lay_out(self) -> None:
        """Where guide pins, pen and handle stand, in whole mm."""
        keys, far = self.keys, [self.prime + high for high in self.high]
        # a slide's slot begins beyond its roller's pin; rings about the pins of the pen's slide clear cams and roller
        slots = [x + self.half + self.slot / 2 + _WALL + _SLACK for x in far]
        clear = max(self.reach, far[1] + keys.follower_radius) + self.ring + _APART
        first = [math.ceil(round(x, 6)) for x in (slots[0], max(slots[1], clear))]
        self.pins = [(float(x), x + keys.guide_pin_spacing) for x in first]
        # from the rollers' centres
        self.slots = [(pins[0] - x - _SLACK, pins[1] - self.prime - low + _SLACK)
                      for pins, x, low in zip(self.pins, far, self.low, strict=True)]  # fmt: skip
        self.pegs = [math.ceil(end + self.slot / 2 + keys.guide_pin_diameter / 2 + _WALL) for _, end in self.slots]
        pen = keys.pen_diameter / 2
        left = max(self.high[0] + _ABOUT, float(self.line.real.max()) + _WALL)
        self.pen = float(math.ceil(max(self.prime + left - self.half, self.reach + pen + 2 * _APART)))
        ends = self._crank_end()
        most = math.hypot(self.pen, self.prime + self.low[1]) - pen - _APART - ends
        least = (keys.axle_diameter + keys.guide_pin_diameter) / 2 + _WALL
        usual = max(min(_CRANK_LENGTH, float(math.floor(most))), float(math.ceil(least)))
        self.crank_length = usual if keys.crank_length is None else keys.crank_length
        if self.crank_length < least:
            raise ParameterError.beyond("crank_length", self.crank_length, "no_wall_beside_holes", least)
        if self.crank_length > most:
            raise ParameterError("crank_length", self.crank_length, "crank_meets_pen", limit(most, self.crank_length))

    def _crank_end(self) -> float:
        """Radius of both round ends of the crank, mm."""
        return max(self.keys.axle_diameter, self.keys.guide_pin_diameter) / 2 + 2 * _WALL

    def all(self) -> Expansion:
        """Every part, as it stands on what is made before, and the turn of the crank."""
        keys, thick = self.keys, self.thickness
        self._frame()
        self._shaft()
        self._slide("x", "table", 2, -1, 0.0)
        self._slide("y", "slide", 3, 1, 90.0)
        self.pin("pen", keys.pen_diameter, keys.pen_length)
        self.fix("slide", "pen", complex(self.pen), -4 * thick)
        self.drive(keys, shaft="turns")
        self.order("")
        self.name_all()
        return self.found

    def _frame(self) -> None:
        """The frame with the guides' pins; rings about those of the pen's slide carry it."""
        keys, thick = self.keys, self.thickness
        ends = self._table()
        # it reaches below cams, pins and the table where that is nearest
        low = -(self.reach + _BESIDE)
        right = max(self.pins[0][1] + _BESIDE, self.prime + self.low[0] + ends[0])
        top = max(self.pins[1][1] + _BESIDE, ends[1])
        box = [math.floor(low), math.ceil(right), math.ceil(top)]
        pins = [complex(x) for x in self.pins[0]] + [1j * y for y in self.pins[1]]
        self.part(
            "frame", kind="plate", face_width=thick, corner_radius=_CORNER, width=float(box[1] - box[0]),
            height=float(box[2] - box[0]), centre=[(box[0] + box[1]) / 2, (box[0] + box[2]) / 2],
            holes=[hole(0j, keys.axle_diameter + keys.clearance), *(hole(at, keys.guide_pin_diameter) for at in pins)],
        )  # fmt: skip
        self.found.instances["frame"] = {"part": "frame", "at": [0.0, 0.0, -thick], "held": True}
        for name, boards, ats in (("x", 3, pins[:2]), ("y", 8, pins[2:])):
            self.pin(f"guide_pin_{name}", keys.guide_pin_diameter, boards * thick - _SHORT)
            self.fix_each("frame", f"guide_pin_{name}", [(at, 0.0) for at in ats])
        self.plate("spacer", 2 * self.ring, [hole(0j, self.slot)], label=False)
        self.fix_each("frame", "spacer", [(at, layer * thick) for at in pins[2:] for layer in range(1, 6)])

    def _shaft(self) -> None:
        """The shaft with both cams, their key and the crank with its handle; washers under the cams carry them."""
        keys, thick = self.keys, self.thickness
        self.pin("shaft", keys.axle_diameter, 9 * thick)
        self.put("coaxial", "frame", "shaft")
        bore = hole(0j, keys.axle_diameter + keys.clearance)
        self.plate("shaft_ring", keys.axle_diameter + 2 * _WALL, [bore], label=False)
        for k in (1, 2):
            self.put("coaxial", "frame", f"shaft_ring_{k}", "shaft_ring", height=k * thick)
        inside = min(inner_radius(cam) for cam in self.made)
        at = round((keys.axle_diameter / 2 + inside) / 2, 3)
        for name, own, start in (("x", self.cams[0], 90.0), ("y", self.cams[1], 0.0)):
            keyed = {"count": 1, "diameter": keys.guide_pin_diameter, "pitch_circle_diameter": 2 * at,
                     "start_deg": start}  # fmt: skip
            self.part(
                f"cam_{name}", kind="cam", face_width=thick, bore_diameter=keys.axle_diameter, holes=keyed,
                label=name.upper(), **own,
            )  # fmt: skip
            self.told(
                f"cam_{name}", motion_table="picture", table_tolerance="smoothing", follower_radius="follower_radius",
                base_circle_radius="prime_circle_radius",
            )  # fmt: skip
        self.put("fixed", "shaft", "cam_x", offset=place(0j, 3 * thick), rotation_deg=-90.0)
        line = [(z.real, z.imag) for z in self.line.tolist()]
        self.put("drawing_cams", "cam_x", "cam_y", height=thick, line=line, tolerance=keys.smoothing)
        self.pin("key", keys.guide_pin_diameter, 2 * thick - _SHORT)
        self.put("fixed", "cam_x", "key", offset=place(complex(0, at), 0.0))
        end = self._crank_end()
        self.crank("crank", self.crank_length, (keys.axle_diameter, keys.guide_pin_diameter), (2 * end, 2 * end))
        self.put("fixed", "shaft", "crank", offset=place(0j, 8 * thick), rotation_deg=225.0)
        self.pin("handle", keys.guide_pin_diameter, thick + _HANDLE)
        self.put("fixed", "crank", "handle", offset=place(complex(self.crank_length), 0.0))

    def _table(self) -> tuple[float, float]:
        """How far the table reaches to the right and upwards from its roller's centre, mm."""
        # corners of the picture may stand farther off than the line that is drawn
        wide = max(_ABOUT - self.low[0], _WALL - float(self.line.real.min()))
        high = max(self.high[1] + _ABOUT, float(self.line.imag.max()) + _WALL)
        right = max(self.pegs[0] + self.half, self.pen - self.prime + wide)
        return float(math.ceil(right)), float(math.ceil(self.prime + high))

    def _slide(self, name: str, slide: str, layer: int, way: int, direction: float) -> None:
        """A roller in the layer of its cam, and what it moves, two layers below or above it."""
        keys, thick = self.keys, self.thickness
        bore = hole(0j, keys.roller_pin_diameter + keys.clearance)
        if "roller" not in self.found.parts:
            self.part(
                "roller", kind="roller", face_width=thick, diameter=2 * keys.follower_radius,
                bore_diameter=bore["diameter"], label=False,
            )  # fmt: skip
            self.told("roller", diameter="follower_radius")
            self.plate("washer", keys.roller_pin_diameter + 2 * _WALL, [bore], label=False)
            self.pin("roller_pin", keys.roller_pin_diameter, 3 * thick - _SHORT)
            self.pin("peg", keys.guide_pin_diameter, 2 * thick - _SHORT)
            self._flat()
        self.put("cam_follower", f"cam_{name}", f"roller_{name}", "roller", direction_deg=direction)
        self.fix(f"roller_{name}", f"washer_{name}", 0j, way * thick, "washer")
        self.put("fixed", f"roller_{name}", slide, offset=place(0j, 2 * way * thick), rotation_deg=90.0 - direction)
        self.fix(slide, f"roller_pin_{name}", 0j, 0.0 if way < 0 else _SHORT - 2 * thick, "roller_pin")
        self.fix(slide, f"peg_{name}", self.pegs[way > 0] * (1j if way > 0 else 1), 0.0, "peg")

    def _flat(self) -> None:
        """The table with the picture, as the pen goes over it, and the pen's slide, an angle of two arms."""
        keys, thick, half = self.keys, self.thickness, self.half
        right, top = self._table()
        # under the pen, from the roller's centre
        picture = complex(self.pen - self.prime, self.prime) - self.line.conj()
        drawn = [place(complex(z), 0.0)[:2] for z in picture.tolist()]
        start, end = self.slots[0]
        self.part(
            "table", kind="plate", face_width=thick, corner_radius=min(_CORNER, half), width=right + half,
            height=top + half, centre=[(right - half) / 2, (top - half) / 2], label=False,
            holes=[hole(0j, keys.roller_pin_diameter), hole(complex(self.pegs[0]), keys.guide_pin_diameter)],
            slots=[{"start": [start, 0.0], "end": [end, 0.0], "width": self.slot}], strokes=[[*drawn, drawn[0]]],
        )  # fmt: skip
        start, end = self.slots[1]
        x, y = self.pen + half, self.pegs[1] + half
        corners = [[-half, -half], [x, -half], [x, half], [half, half], [half, y], [-half, y]]
        circles = [(0j, keys.roller_pin_diameter), (complex(self.pen), keys.pen_diameter),
                   (1j * self.pegs[1], keys.guide_pin_diameter)]  # fmt: skip
        layer = {
            "thickness": thick, "polygons": [{"points": corners, "corner_radius": min(_CORNER, half * 0.9)}],
            "circles": [hole(at, diameter) for at, diameter in circles],
            "slots": [{"start": [0.0, start], "end": [0.0, end], "width": self.slot}],
        }  # fmt: skip
        self.part("slide", kind="layered", layers=[layer])


DRAWING_MACHINE = Recipe(DrawingMachineKeys, lambda keys: _Making(keys).all())
