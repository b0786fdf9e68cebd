"""The part kind ``geneva_driver``: crank plate, locking disc and pins that move a Geneva wheel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.base.record import replace
from geometry.solids.hub_holes import HubHoles, least_wall
from parts.base.kind import Others, Report
from parts.base.links import owner_of
from parts.keys.base import MOST_LENGTH, mm
from parts.keys.holes import HoledKeys, holes_of, wide_bore
from parts.keys.pins import MARGIN, RoundPinKind, check_holes, least_of
from parts.keys.splines import InvoluteSplineTable
from parts.pins.geneva_wheel import GENEVA_WHEEL, GenevaWheelSpec

if TYPE_CHECKING:
    from geometry.gears.pins.geneva_driver import GenevaDriver
    from geometry.solids.body import Body

# of the pin's diameter, where no key tells it
_GAP = 0.1
_GENEVA_WHEEL: dict[str, object] = {
    "kind": "geneva_wheel", "number_of_slots": 6, "centre_distance": 60.0, "pin_diameter": 6.0,
}  # fmt: skip

_RELIEF_CLEARANCE = mm(
    "gap to the wheel's tips at the bottom of a relief; default: a tenth of the pin, at most half the room",
    least=0,
    most=100,
    example=0.6,
)
_PLATE_DIAMETER = mm(
    "of the crank plate; default: half a pin beyond the pins", above=0, most=2 * MOST_LENGTH, example=72.0
)
_PIN_LENGTH = mm("of pins of one piece; default: that of the disc", least=0.01, most=10_000, example=10.0)
_PIECE = Meta(description="all of one piece, or cut from boards: the crank plate with holes for pins, the locking disc")


class GenevaDriverSpec(HoledKeys, kw_only=True, tag_field="kind", tag="geneva_driver"):
    """Keys of ``geneva_driver``."""

    of: Annotated[str, Meta(description="the part of kind geneva_wheel that it drives")]
    number_of_pins: Annotated[int, Meta(ge=1, le=5, description="even pins: steps of the wheel in a turn")] = 1
    piece: Annotated[Literal["whole", "plate", "disc"], _PIECE] = "whole"
    relief_clearance: Annotated[float, _RELIEF_CLEARANCE] | None = None
    plate_thickness: Annotated[float, mm("thickness of the crank plate", least=0.01, most=10_000)] = 3.0
    plate_diameter: Annotated[float, _PLATE_DIAMETER] | None = None
    face_width: Annotated[float, mm("thickness of the locking disc", least=0.01, most=10_000)] = 10.0
    pin_length: Annotated[float, _PIN_LENGTH] | None = None
    seat_clearance: Annotated[float, mm("radius of a hole for a pin beyond the pin's", least=-10, most=100)] = 0.0


class GenevaDriverKind(RoundPinKind[GenevaDriverSpec, "GenevaDriver"]):
    """A crank with its locking disc."""

    name, keys, made_from = "geneva_driver", GenevaDriverSpec, _GENEVA_WHEEL
    drawing = "parts.pins.geneva_drawing"

    def thing(self, keys: GenevaDriverSpec, others: Others) -> GenevaDriver:
        """The driver of another part's wheel, checked to hold its pins and its bore."""
        from geometry.gears.pins.geneva import GenevaDisc, checked_disc
        from geometry.gears.pins.geneva_driver import GenevaDriver

        wheel = GENEVA_WHEEL.thing(owner_of(keys.of, others, GenevaWheelSpec), others)
        pin = wheel.pin_diameter
        holes = holes_of(keys)
        disc = GenevaDisc(wheel, keys.number_of_pins)
        gap = keys.relief_clearance
        if gap is None:
            gap = min(_GAP * pin, disc.room(holes.bore_reach) / 2)
        disc = checked_disc(replace(disc, relief_clearance=gap), holes.bore_reach)
        reach = disc.drive.crank_radius + pin / 2 + max(keys.seat_clearance, 0.0)
        usual = reach + max(pin / 2, least_wall(2 * reach) * (1 + 2 * MARGIN))
        driver = GenevaDriver(
            disc,
            keys.piece,
            holes,
            usual if keys.plate_diameter is None else keys.plate_diameter / 2,
            keys.plate_thickness,
            keys.face_width,
            keys.face_width if keys.pin_length is None else keys.pin_length,
            keys.seat_clearance,
        )
        _check(keys, driver)
        return driver

    def solid(self, keys: GenevaDriverSpec, thing: GenevaDriver, offset: float) -> Body:
        """The piece, or all of it."""
        return thing.body(offset)

    def is_plate(self, keys: GenevaDriverSpec, thing: GenevaDriver) -> bool:
        """Whether it is a flat piece."""
        return thing.piece != "whole"

    def height(self, keys: GenevaDriverSpec, thing: GenevaDriver) -> float:
        """Of all that stands on the plate."""
        return thing.height

    def report(self, keys: GenevaDriverSpec, thing: GenevaDriver) -> Report:
        """Its sizes."""
        circles = {} if thing.piece == "disc" else {"pin_circle_diameter": 2 * thing.disc.drive.crank_radius}
        quantities = {
            "number_of_pins": float(keys.number_of_pins),
            "pin_diameter": 2 * thing.pin_radius,
            "locking_diameter": 2 * thing.disc.wheel.locking_radius,
            "relief_apex": thing.disc.apex,
        }
        axle = thing.disc.wheel.holes.bore_reach
        room = thing.disc.drive.centre_distance - axle
        reaches = axle > 0 and thing.piece != "disc" and thing.plate_radius > room
        findings = (Finding("plate_reaches_axle", 2 * thing.plate_radius, 2 * room),) if reaches else ()
        flat = (Finding("flat_pins", 0.0, 0.0),) if thing.piece == "whole" else ()
        return Report(circles=circles, quantities=quantities, findings=findings, flat_findings=flat)


def _check(keys: GenevaDriverSpec, driver: GenevaDriver) -> None:
    """Pins within the plate, a bore beside the reliefs, holes that only a plate has."""
    disc, seats = driver.disc, driver.seats
    for key, given, piece in (("pin_length", keys.pin_length, "whole"), ("plate_diameter", keys.plate_diameter, "")):
        if given is not None and (driver.piece == "disc" or (piece and driver.piece != piece)):
            raise ParameterError(key, given, "not_of_this_piece", Nearest(None))
    if keys.holes is not None and driver.piece != "plate":
        raise ParameterError("holes", None, "not_of_this_piece", Nearest(None))
    smallest = -driver.pin_radius / 2
    if keys.seat_clearance < smallest:
        raise ParameterError("seat_clearance", keys.seat_clearance, "leaves_no_hole", least_of(smallest, 0.0))
    least = least_wall(2 * seats.reach) * (1 + MARGIN)
    if driver.piece != "disc" and driver.plate_radius < seats.reach + least:
        wide = least_of(2 * (seats.reach + least), 2 * driver.plate_radius)
        raise ParameterError("plate_diameter", keys.plate_diameter, "pins_reach_edge", wide, diameter=2 * seats.reach)
    bored = driver.piece == "whole" or (driver.piece == "disc" and driver.has_bored_disc)
    if not bored and driver.piece == "disc" and driver.holes.bore is not None:
        key = "bore_diameter" if keys.bore_diameter else "bore"
        raise ParameterError(key, keys.bore_diameter or None, "not_of_this_piece", Nearest(None))
    # its layers are bounded by lines and arcs
    if driver.piece == "whole" and isinstance(keys.bore, InvoluteSplineTable):
        raise ParameterError("bore.shape", "involute_spline", "not_of_this_piece")
    wall = least_wall(disc.wheel.locking_radius) * (1 + MARGIN)
    room = abs(disc.apex) - wall
    if bored and driver.holes.bore_reach > room:
        if keys.relief_clearance is None:
            # by default half of what a wide bore leaves
            room = max(room, disc.swept_apex - wall)
        raise wide_bore(keys, max(room, 0.0), "bore_reaches_relief")
    if driver.piece != "disc":
        every = HubHoles(driver.holes.bore, (seats, *driver.holes.round_holes))
        check_holes(keys, every, driver.plate_radius, own=1)
