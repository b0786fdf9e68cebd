"""The part kind ``timing_pulley``: a wheel for a timing belt, with the grooves of the belt's standard."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.solids.wheel import Rim, check_wheel
from parts.base.kind import Others, Report
from parts.base.lookalikes import in_latin
from parts.keys.base import MOST_LENGTH, check_idle, degrees, in_vain, mm, part_mm, start
from parts.keys.holes import holes_of, spoked
from parts.keys.pins import check_holes
from parts.keys.wheel import WheelKeys, WheelKind

if TYPE_CHECKING:
    from geometry.gears.belts.belt import Belt
    from geometry.gears.belts.pulley import Pulley
    from geometry.gears.teeth.tooth import ToothSide
    from parts.base.readback import Probe


_LINE_OFFSET = mm("pitch line of the belt over the outer circle of the pulley", least=0, most=100, example=0.5)
_GROOVE_WIDTH = mm("their width between the corners on the outer circle", above=0, most=1000, example=3.32)


class BeltTable(Struct, forbid_unknown_fields=True):
    """A belt of your own, its grooves with straight flanks."""

    pitch: Annotated[float, mm("pitch", above=0, most=1000, example=5.0)]
    line_offset: Annotated[float, _LINE_OFFSET]
    groove_depth: Annotated[float, mm("depth of the grooves", above=0, most=1000, example=1.95)]
    groove_width: Annotated[float, _GROOVE_WIDTH]
    groove_angle_deg: Annotated[float, degrees("angle between their flanks", least=1, most=120)] = 50.0
    root_radius: Annotated[float, mm("their root radius at most", least=0, most=1000, example=0.4)] = 0.0
    tip_radius: Annotated[float, mm("rounding of the tips", least=0, most=1000, example=0.6)] = 0.0


class FlangesTable(Struct, forbid_unknown_fields=True):
    """Discs at the faces that keep the belt on."""

    diameter: Annotated[float, part_mm("their diameter", above=0, example=42.0)]
    thickness: Annotated[float, mm("thickness of each", least=0.01, most=1000)] = 1.0
    below: Annotated[bool, Meta(description="one at the lower face")] = True
    above: Annotated[bool, Meta(description="one at the upper face")] = True


_OUTER_DIAMETER = mm(
    "outer diameter; default: that of the belt's pitch line", above=0, most=2 * MOST_LENGTH, example=31.0
)
_CLEARANCE = mm("how far the walls of the grooves stand off those of the standard, for printing", least=0, most=100)


class TimingPulleySpec(WheelKeys, kw_only=True, tag_field="kind", tag="timing_pulley"):
    """Keys of ``timing_pulley``."""

    number_of_teeth: Annotated[int, Meta(ge=6, le=500, description="number of teeth z", examples=[20])]
    belt: (
        Annotated[str, Meta(description="designation of the belt: MXL to XXH, T2.5 to T20, AT5, 5M (HTD), GT2"),
                  start("T5")]
        | BeltTable
    )  # fmt: skip
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None
    clearance: Annotated[float, _CLEARANCE] = 0.0
    flanges: FlangesTable | None = None
    face_width: Annotated[float, mm("width of the teeth between the flanges", least=0.01, most=10_000)] = 10.0


class TimingPulleyKind(WheelKind[TimingPulleySpec, "Pulley"]):
    """A pulley for a timing belt."""

    name, keys = "timing_pulley", TimingPulleySpec
    drawing = data_table = "parts.belts.drawing"

    def idle(self, keys: TimingPulleySpec, others: Others) -> Iterator[ParameterError]:
        """Chamfers of faces that flanges cover."""
        if keys.flanges is not None:
            yield from in_vain(keys, ("face_chamfer",), "of_no_flanges")

    def thing(self, keys: TimingPulleySpec, others: Others) -> Pulley:
        """The pulley, checked to have lands between its grooves, and holes within them."""
        from geometry.gears.belts.pulley import Flanges, Pulley, check_flanges, checked_pulley

        table, flanges = keys.flanges, None
        if table is not None:
            if not (table.below or table.above):
                raise ParameterError("flanges.above", False, "flanges_at_no_face", Nearest(True))
            check_idle(self.idle(keys, others))
            flanges = Flanges(table.diameter, table.thickness, table.below, table.above)
        pulley = checked_pulley(
            Pulley(keys.number_of_teeth, belt_of_keys(keys), keys.clearance, keys.outer_diameter)
        )  # fmt: skip
        pulley = replace(pulley, toothed_width=keys.face_width, flanges=flanges)
        check_flanges(pulley)
        keys = spoked(keys, pulley.root_radius)
        holes = holes_of(keys)
        check_holes(keys, holes, pulley.root_radius)
        radius = self.core(keys, pulley)
        edge = "root_circle" if radius == pulley.root_radius else "flanges"
        check_wheel(self.shape(keys, pulley), 2 * radius, holes, edge)
        return replace(pulley, holes=holes)

    def side(self, thing: Pulley, offset: float) -> ToothSide:
        """Of its teeth."""
        from geometry.gears.belts.pulley import pulley_side

        return pulley_side(thing, offset)

    def core(self, keys: TimingPulleySpec, thing: Pulley) -> float:
        """Of the roots, or of the flanges where these are at every face with a hub, mm."""
        flanges, hub = thing.flanges, keys.hub
        if flanges is None or hub is None or keys.web is not None:
            return thing.root_radius
        stands = (flanges.below or not hub.below) and (flanges.above or not hub.above)
        return flanges.diameter / 2 if stands else thing.root_radius

    def rim(self, thing: Pulley) -> Rim | None:
        """Teeth between flanges."""
        if thing.flanges is None:
            return None
        from geometry.gears.belts.flanges import flanged_teeth

        return partial(flanged_teeth, thing)

    def height(self, keys: TimingPulleySpec, thing: Pulley) -> float:
        """Width of teeth and flanges, mm."""
        return thing.total_width

    def numbers(self, keys: TimingPulleySpec) -> str:
        """Teeth, and the belt."""
        belt = keys.belt if isinstance(keys.belt, str) else f"p\u00a0{keys.belt.pitch:.6g}"
        return f"{super().numbers(keys)} {belt}"

    def report(self, keys: TimingPulleySpec, thing: Pulley) -> Report:
        """Diameters, grooves and lands, and what is poor."""
        from geometry.gears.belts.pulley import pulley_findings

        circles = {
            "outer_diameter": 2 * thing.outer_radius,
            "pitch_diameter": 2 * thing.pitch_radius,
            "root_diameter": 2 * thing.root_radius,
        }
        quantities = {
            "pitch": thing.belt.pitch,
            "pitch_line_offset": thing.pitch_radius - thing.outer_radius,
            "pulley_groove_depth": thing.depth,
            "land_width": thing.land,
        }
        return Report(pulley_findings(thing), circles, quantities)

    def probes(self, keys: TimingPulleySpec, thing: Pulley) -> tuple[Probe, ...]:
        """A pin fits every groove as it fits the exact one."""
        from parts.belts.probe import GrooveProbe

        return (GrooveProbe(thing, thing.middle),)


TIMING_PULLEY = TimingPulleyKind()


def belt_of_keys(keys: TimingPulleySpec) -> Belt:
    """The belt of the keys, by its designation or by its sizes.

    Raises
    ------
    ParameterError
        No such belt.
    """
    from geometry.gears.belts.belt import Belt, StraightGroove, belt_of, like_belt

    own = keys.belt
    if isinstance(own, BeltTable):
        half = math.radians(own.groove_angle_deg / 2)
        groove = StraightGroove(own.groove_width, own.groove_depth, half, own.root_radius, own.tip_radius)
        return Belt(own.pitch, own.line_offset, groove)
    # of letters of both alphabets that look the same the Latin ones are meant
    name = in_latin(own.upper())
    found = belt_of(name)
    if found is None:
        like = like_belt(name)
        raise ParameterError("belt", own, "no_such_belt", Nearest(like, "meant") if like else None)
    return found
