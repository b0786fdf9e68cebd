"""Geneva drives: how a wheel of n radial slots is moved by the pin of a crank, and the outlines of wheel and disc.

The pin enters a slot along its centre line, so without a shock: at right angles to the crank, r = a sin(pi / n).
Where the crank stands ``alpha`` from the pin's deepest place in the slot, an external wheel stands at
atan2(r sin alpha, a - r cos alpha) against its sense of turning; with -r for r it is the law of an internal wheel,
about which the crank turns inside and in the same sense (Artobolevsky, Theory of mechanisms and machines; Bickford,
Mechanisms for intermittent motion). While no pin is in a slot the driver's disc stands in an arc of the wheel.

Frames: slot 1 of the wheel and pin 1 of the driver are centred on +x.
"""

from __future__ import annotations

import cmath
import math
from functools import lru_cache, partial

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import Nearest, ParameterError
from geometry.base.nearest import nearest
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.hub_holes import HubHoles, least_wall
from geometry.solids.plate import Edge, PlateOutline, moved_edges

_NO_HOLES = HubHoles()
# places along a curve, turns of the driver and rounds of both by which the deepest is sought; a part that is rounding
_SHARES, _TURNS, _ROUNDS = 33, 361, 6
_ROUNDING = 1e-12
# what is kept from a limit, as a part of it
_MARGIN = 1e-6


class Geneva(Record):
    """The law of motion of n slots at a centre distance, mm, by ``number_of_pins`` even pins of one crank."""

    number_of_slots: int
    centre_distance: float
    number_of_pins: int = 1
    internal: bool = False

    @property
    def sense(self) -> int:
        """-1 where the wheel turns against the driver: an external one."""
        return 1 if self.internal else -1

    @property
    def half_slot_angle(self) -> float:
        """pi / n, rad: half of what the wheel turns at a time."""
        return math.pi / self.number_of_slots

    @property
    def half_motion_angle(self) -> float:
        """How far the crank turns from the pin's deepest place to where it leaves the slot, rad."""
        return math.pi / 2 + self.sense * self.half_slot_angle

    @property
    def motion_share(self) -> float:
        """In which part of the driver's turn the wheel turns."""
        return self.number_of_pins * self.half_motion_angle / math.pi

    @property
    def dwell_angle(self) -> float:
        """How far the driver turns while the wheel stands, between two pins, rad."""
        return 2 * math.pi / self.number_of_pins - 2 * self.half_motion_angle

    @property
    def crank_radius(self) -> float:
        """r = a sin(pi / n), mm."""
        return self.centre_distance * math.sin(self.half_slot_angle)

    @property
    def mouth_radius(self) -> float:
        """Distance from the wheel's axis at which the pin enters a slot, mm."""
        return self.centre_distance * math.cos(self.half_slot_angle)

    @property
    def deepest_radius(self) -> float:
        """The pin's least distance from an external wheel's axis, its greatest from an internal one's, mm."""
        return self.centre_distance + self.sense * self.crank_radius

    @property
    def ratio(self) -> float:
        """lambda = r / a, below 0 where the wheel is internal: so one law holds for both."""
        return -self.sense * math.sin(self.half_slot_angle)

    def motion(self, alpha: ArrayLike) -> tuple[Real, Real, Real, Real]:
        """Turn (rad) of the wheel in its sense, within a motion, and its first three derivatives over the crank's."""
        alpha = np.asarray(alpha, dtype=float)
        x, c, s = self.ratio, np.cos(alpha), np.sin(alpha)
        square = 1 - 2 * x * c + x * x
        own = -self.sense * x
        bend = own * (1 - x * x)
        return (
            -self.sense * np.arctan2(x * s, 1 - x * c),
            own * (c - x) / square,
            -bend * s / square**2,
            -bend * (square * c - 4 * x * s * s) / square**3,
        )

    @property
    def acceleration_angle(self) -> float:
        """Crank angle of the wheel's greatest acceleration, rad: in an internal wheel that at which a pin enters.

        The third derivative vanishes at 2 x c^2 + (1 + x^2) c - 4 x = 0, c = cos(alpha), x the ratio (Bickford).
        """
        if self.internal:
            return self.half_motion_angle
        part = (1 + self.ratio**2) / (4 * self.ratio)
        return math.acos(math.sqrt(part * part + 2) - part)

    @property
    def greatest_acceleration(self) -> float:
        """Of the wheel, for an even driver's velocity of 1."""
        return abs(float(self.motion(self.acceleration_angle)[2]))

    def wheel_turn(self, turn: ArrayLike) -> Real:
        """How far the wheel has turned in its sense when the driver has, both since pin 1 was deepest; rad."""
        turn = np.asarray(turn, dtype=float)
        step = 2 * math.pi / self.number_of_pins
        whole = np.round(turn / step)
        alpha = np.clip(turn - whole * step, -self.half_motion_angle, self.half_motion_angle)
        return 2 * self.half_slot_angle * whole + self.motion(alpha)[0]

    def wheel_rotation(self, rotation: float, direction: float) -> float:
        """Rotation of the frame of the wheel, which stands in a direction from the driver, continuous, rad."""
        turn = float(self.wheel_turn(rotation - direction - (math.pi if self.internal else 0.0)))
        return direction + math.pi + self.sense * turn


def most_pins(slots: int, *, internal: bool) -> int:
    """Even pins between which some dwell is left: fewer than 2 n / (n - 2), in an internal wheel one."""
    return 1 if internal else math.ceil(2 * slots / (slots - 2)) - 1


class GenevaWheel(Record):
    """A wheel with its slots; mm.

    ``locking_radius`` is that of the driver's disc, ``locking_clearance`` the gap between it and the wheel's arc,
    ``slot_clearance`` what a slot is wider than the pin, ``end_clearance`` the gap beyond the pin at its deepest.
    ``outer_radius``: of an internal wheel.
    """

    drive: Geneva
    pin_diameter: float
    locking_radius: float
    slot_clearance: float = 0.0
    end_clearance: float = 0.0
    locking_clearance: float = 0.0
    tip_rounding: float = 0.0
    outer_radius: float = 0.0
    holes: HubHoles = _NO_HOLES

    @property
    def internal(self) -> bool:
        """Whether it is a ring."""
        return self.drive.internal

    @property
    def half_width(self) -> float:
        """Of a slot, mm."""
        return (self.pin_diameter + self.slot_clearance) / 2

    @property
    def arc_radius(self) -> float:
        """Of a locking arc about the driver's axis, mm."""
        return self.locking_radius + self.locking_clearance

    @property
    def slot_end(self) -> float:
        """Distance from the axis of the middle of a slot's round end, mm."""
        beyond = self.pin_diameter / 2 + self.end_clearance - self.half_width
        return self.drive.deepest_radius + self.drive.sense * beyond

    @property
    def tip_radius(self) -> float:
        """Of the circle through the tips, mm: the slots' walls begin where the pin enters, beyond their rounding."""
        corner = math.hypot(self.drive.mouth_radius, self.half_width + self.tip_rounding)
        return corner - self.drive.sense * self.tip_rounding

    @property
    def root_radius(self) -> float:
        """An external wheel is whole within it, an internal one beyond it, mm."""
        end = self.slot_end + self.drive.sense * self.half_width
        arc = self.drive.centre_distance + self.drive.sense * self.arc_radius
        return max(end, arc) if self.drive.internal else min(end, arc)

    @property
    def locks(self) -> bool:
        """Whether the locking arcs reach into the wheel."""
        return self.locking_radius > 0 and self.arc_radius > abs(self.drive.centre_distance - self.tip_radius)

    @property
    def horn_angle(self) -> float:
        """Between the middle of a slot and the corner of its tip at the locking arc, about the axis, rad."""
        a, tip, arc = self.drive.centre_distance, self.tip_radius, self.arc_radius
        cosine = (a * a + tip * tip - arc * arc) / (2 * a * tip)
        return self.drive.half_slot_angle - math.acos(max(min(cosine, 1.0), -1.0))

    @property
    def land_angle(self) -> float:
        """Between the middle of a slot and where its rounding, or its wall, meets the tip circle, rad."""
        return math.atan2(self.half_width + self.tip_rounding, self.drive.mouth_radius)

    @property
    def room_of_disc(self) -> float:
        """Radius of the disc that would leave nothing of the tips, measured along the wall where the pin enters, mm."""
        return self.drive.crank_radius - self.half_width - self.locking_clearance

    @property
    def tip_width(self) -> float:
        """Of the land between a slot and a locking arc, mm; not above 0 where the tip is pointed."""
        return self.tip_radius * (self.horn_angle - self.land_angle)

    @property
    def neck_width(self) -> float:
        """Between the round ends of two neighbouring slots of an external wheel, mm."""
        return 2 * (self.slot_end * math.sin(self.drive.half_slot_angle) - self.half_width)

    def half_period(self) -> tuple[Edge, ...]:
        """From the end of slot 1 along its upper side to the middle of the next locking arc."""
        sense, half, mouth = self.drive.sense, self.half_width, self.drive.mouth_radius
        wall = Line(complex(self.slot_end, half), complex(mouth, half))
        # round ends in halves: those of a half turn do not tell a file where its middle is
        end = Arc(complex(self.slot_end), half, 0.0 if sense > 0 else math.pi, math.copysign(math.pi / 2, sense))
        edges: list[Edge] = [end, wall]
        rounded = complex(mouth, half + self.tip_rounding)
        land = cmath.rect(self.tip_radius, self.land_angle)
        if self.tip_rounding > 0:
            edges.append(arc_between(rounded, wall.end, land, sense < 0))
        corner = cmath.rect(self.tip_radius, self.horn_angle)
        edges.append(arc_between(0j, land, corner, True))
        axis = cmath.rect(1.0, self.drive.half_slot_angle)
        middle = (self.drive.centre_distance + sense * self.arc_radius) * axis
        edges.append(arc_between(self.drive.centre_distance * axis, corner, middle, sense > 0))
        return tuple(edges)

    def period(self) -> tuple[Edge, ...]:
        """From one slot's end to the next one's, counter-clockwise."""
        half = self.half_period()
        axis = Placement2(2 * self.drive.half_slot_angle)
        return (*half, *(edge.mirrored().placed(axis) for edge in reversed(half)))

    def outline(self) -> tuple[Edge, ...]:
        """All slots and arcs: counter-clockwise the outside of an external wheel, clockwise the inside of a ring."""
        turns = [Placement2(2 * self.drive.half_slot_angle * k) for k in range(self.drive.number_of_slots)]
        edges = tuple(edge.placed(turn) for turn in turns for edge in self.period())
        return tuple(e.reversed() for e in reversed(edges)) if self.drive.internal else edges

    def profile(self, offset: float) -> Profile:
        """The outline by its periods, moved ``offset`` mm out of the material.

        Raises
        ------
        GeometryError
            A slot closes, or a tip does not survive.
        """
        edges, slots = moved_edges(self.outline(), offset), self.drive.number_of_slots
        period = tuple(Segment(edge, Label.BODY) for edge in edges[: len(edges) // slots])
        return Profile(period, slots, self.drive.internal)


def checked_wheel(wheel: GenevaWheel) -> GenevaWheel:
    """The same wheel, if its slots and tips exist, and leave something of the driver's disc as they come by.

    Raises
    ------
    ParameterError
        Names ``pin_diameter`` or ``locking_diameter``.
    """
    radius, least = wheel.locking_radius, least_wall(wheel.drive.centre_distance)
    between = min(wheel.neck_width, wheel.slot_end - wheel.half_width)
    if not wheel.drive.internal and between < least:
        raise ParameterError("pin_diameter", wheel.pin_diameter, "slots_meet")
    for holds, code in (
        (lambda: wheel.locks, "leaves_no_arcs"),
        (lambda: wheel.tip_width >= least, "leaves_no_tip"),
        # and something of its clearance
        (lambda: GenevaDisc(wheel).room() >= _MARGIN * radius, "tips_leave_no_disc"),
    ):
        if not holds():
            raise ParameterError("locking_diameter", 2 * radius, code)
    return wheel


@lru_cache(maxsize=64)
def _swept_apex(wheel: GenevaWheel) -> float:
    """Of the disc of a driver: the same for any relief and any number of pins.

    All circles through both ends of the arcs make one family: of each place that the wheel comes to within the disc
    the one through it counts, and the least of all is sought.
    """
    angle = wheel.drive.half_motion_angle
    shares, turns = np.linspace(0, 1, _SHARES), np.linspace(-angle, angle, _TURNS)
    found = wheel.locking_radius
    for curve in _near_mouth(wheel):
        low, high = curve.domain
        centre, span = (0.5, 0.0), (0.5, angle)
        for _ in range(_ROUNDS):
            u = np.clip(centre[0] + span[0] * (2 * shares - 1), 0, 1)
            t = np.clip(centre[1] + span[1] * turns / angle, -angle, angle)
            apexes = _apexes(wheel, np.asarray(curve.point(low + (high - low) * u))[:, None], t)
            row, column = np.unravel_index(int(np.argmin(apexes)), apexes.shape)
            centre = float(u[row]), float(t[column])
            span = 4 * span[0] / _SHARES, 4 * span[1] / _TURNS
            found = min(found, float(apexes[row, column]))
    return found


def _apexes(wheel: GenevaWheel, places: Complex, alpha: Real) -> Real:
    """Of places on the wheel (n, 1), at turns of the driver (m,); the disc's radius where they stay outside."""
    drive, radius = wheel.drive, wheel.locking_radius
    turned = math.pi + drive.sense * drive.motion(alpha)[0]
    middle = -drive.sense * drive.centre_distance
    if drive.internal:
        # pin 1 points away from the wheel's axis
        turned = turned - math.pi
    seen = (middle + places * np.exp(1j * turned)) * np.exp(-1j * alpha)
    chord = radius * math.cos(drive.half_motion_angle)
    within = radius**2 - np.abs(seen) ** 2
    off = chord - seen.real
    # the circle |x|^2 - s^2 - 2 d (x - chord) = 0 through the place; it crosses the axis between disc and place
    with np.errstate(divide="ignore", invalid="ignore"):
        double = within / off
        apex = double / 2 - np.sign(off) * np.sqrt(np.maximum(double**2 / 4 - double * chord + radius**2, 0.0))
    return np.where(within > _ROUNDING * radius**2, np.where(off == 0, chord, apex), radius)


class GenevaDisc(Record):
    """The locking disc of a driver and the circles of its pins, mm; ``number_of_pins``: even ones.

    Between two locking arcs a circle through their ends relieves it: the one that passes whatever the ``wheel`` sweeps
    of the disc by ``relief_clearance`` at its apex.
    """

    wheel: GenevaWheel
    number_of_pins: int = 1
    relief_clearance: float = 0.0

    @property
    def drive(self) -> Geneva:
        """The law with all pins."""
        return replace(self.wheel.drive, number_of_pins=self.number_of_pins)

    @property
    def swept_apex(self) -> float:
        """Where the shallowest relief that the wheel leaves alone crosses the line to its pin, mm from the axis.

        Negative in an internal drive, whose disc is a piece beyond the axis.
        """
        return _swept_apex(self.wheel)

    def room(self, core: float = 0.0) -> float:
        """The most of ``relief_clearance``, mm: to the axis, or to a bore that reaches so far (``core``) and fits."""
        room = self.swept_apex - least_wall(self.wheel.locking_radius)
        if self.drive.internal:
            return room + self.wheel.locking_radius
        return room - core if room >= core else room

    @property
    def apex(self) -> float:
        """Of the relief of pin 1, on x, mm."""
        return self.swept_apex - self.relief_clearance

    def pin_centres(self) -> list[complex]:
        """Where the pins stand, mm."""
        return [cmath.rect(self.drive.crank_radius, turn.angle) for turn in self._turns()]

    def _turns(self) -> list[Placement2]:
        return [Placement2(2 * math.pi * k / self.number_of_pins) for k in range(self.number_of_pins)]

    def relief(self) -> Edge:
        """That of pin 1, counter-clockwise about the disc."""
        angle, radius, apex = self.drive.half_motion_angle, self.wheel.locking_radius, self.apex
        start, end = cmath.rect(radius, -angle), cmath.rect(radius, angle)
        bulge = apex - start.real
        if abs(bulge) < _ROUNDING * radius:
            return Line(start, end)
        half = (radius * radius - apex * apex) / 2 / -bulge
        return arc_between(complex(half), start, end, bulge > 0)

    def outline(self) -> tuple[Edge, ...]:
        """Reliefs and locking arcs, counter-clockwise; an arc in halves."""
        angle, radius, half = self.drive.half_motion_angle, self.wheel.locking_radius, self.drive.dwell_angle / 2
        one = (self.relief(), Arc(0j, radius, angle, half), Arc(0j, radius, angle + half, half))
        return tuple(edge.placed(turn) for turn in self._turns() for edge in one)


def _near_mouth(wheel: GenevaWheel) -> list[Edge]:
    """What of the wheel may come into the disc: tips and locking arcs on both sides of slot 1."""
    upper = wheel.half_period()[2:]
    return [*upper, *(edge.mirrored() for edge in upper)]


def checked_disc(disc: GenevaDisc, core: float = 0.0) -> GenevaDisc:
    """The same disc of a checked wheel, if there is some dwell, and room for its reliefs; ``core``: see ``room``.

    Raises
    ------
    ParameterError
        Names ``number_of_pins`` or ``relief_clearance`` and what works.
    """
    drive = disc.drive
    if drive.number_of_pins > (most := most_pins(drive.number_of_slots, internal=drive.internal)):
        raise ParameterError("number_of_pins", drive.number_of_pins, "leaves_no_dwell", Nearest(most, "at_most"))
    room = disc.room(core)

    def fits(clearance: float) -> bool:
        return clearance <= room and PlateOutline(replace(disc, relief_clearance=clearance).outline()).exists()

    if not fits(disc.relief_clearance):
        cure = partial(nearest, fits, disc.relief_clearance, 0.0, digits=6)
        raise ParameterError("relief_clearance", disc.relief_clearance, "leaves_no_disc", cure)
    return disc
