"""Contact of round pins on a circle with the body that they cut: cycloidal disc or lantern gear, on exact outlines.

All pins pass the same places one after another, so one pin over one whole turn of its phase tells of every pin at every
drive angle: a pin's gap is the signed distance of its centre from the exact outline, less its radius.
"""

from __future__ import annotations

import math

import numpy as np

from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import ContactPlace, PairContact, first_least, gear_outline, told_contact, verdict_of
from geometry.gears.pins.cycloidal import CycloidalDisc
from geometry.gears.pins.lantern import LanternGear
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.distance import Indices, least_in_brackets
from geometry.plane.profile import Label

# |gap| up to this part of the pin's radius is contact
PIN_CONTACT_TOLERANCE = 1e-8
# drive angles in a pitch of the pins; fewer where there are many pins
_DRIVE_ANGLES, _MOST_PLACES = 96, 6000
_LEAST_ANGLES = 4
# least gaps are found to this part of the pin's radius
_ACCURACY = 1e-13
# rounds of finer drive angles beside the greatest gaps, and how many in a round beside each
_ROUNDS, _NEAR = 10, 9
# steps to where a turned body stops; levers below this part of a pin's distance from its axis are none
_STEPS, _SLIDES = 8, 1e-6


class PinMotion(Record):
    """One pin's way past the body that it cuts, over its phase: 0 on the line of centres.

    ``turn`` (rad) and ``shift`` (mm): how far the body is turned, and its axis off the exact distance from theirs.
    """

    body: CycloidalDisc | LanternGear
    turn: float = 0.0
    shift: float = 0.0

    @property
    def number_of_pins(self) -> int:
        """N."""
        return self.body.number_of_pins

    @property
    def pin_radius(self) -> float:
        """rho, mm."""
        return self.body.pin_diameter / 2

    def centre(self, phase: Real) -> tuple[Complex, Complex]:
        """The pin's centre in the frame of the cut body, mm, and its rate by the phase."""
        raise NotImplementedError

    def placement(self, phase: float) -> Placement2:
        """Frame of the line of centres (origin: the axis of the pins) from that of the body."""
        raise NotImplementedError


class DiscMotion(PinMotion):
    """A fixed pin seen from a cycloidal disc. The phase is the eccentric's angle less the pin's."""

    body: CycloidalDisc

    def centre(self, phase: Real) -> tuple[Complex, Complex]:
        """The pin in the disc's frame, mm, and its rate."""
        z, big = self.body.number_of_lobes, self.body.pin_circle_diameter / 2
        arm = (self.body.eccentricity + self.shift) * np.exp(1j * phase)
        turned = np.exp(1j * (phase / z - math.pi / z - self.turn))
        return (big - arm) * turned, (1j / z * (big - arm) - 1j * arm) * turned

    def placement(self, phase: float) -> Placement2:
        """Frame of the line of centres from the disc's."""
        turned = self.body.rotation(phase) + self.turn - phase
        return Placement2(turned, complex(self.body.eccentricity + self.shift))


class LanternMotion(PinMotion):
    """A pin of the lantern seen from the gear. The phase is the pin's angle from the line of centres."""

    body: LanternGear

    def _rotation(self, phase: Real | float) -> Real | float:
        """Rotation of the gear, a space towards the lantern at phase 0, the line of centres along +x."""
        ratio = self.body.number_of_pins / self.body.number_of_teeth
        return math.pi - self.body.pitch_angle / 2 - phase * ratio + self.turn

    def centre(self, phase: Real) -> tuple[Complex, Complex]:
        """The pin in the gear's frame, mm, and its rate."""
        ratio = self.body.number_of_pins / self.body.number_of_teeth
        pin = self.body.lantern_radius * np.exp(1j * phase)
        spoke = pin - (self.body.centre_distance + self.shift)
        turned = np.exp(-1j * self._rotation(phase))
        return spoke * turned, (1j * pin + 1j * ratio * spoke) * turned

    def placement(self, phase: float) -> Placement2:
        """Frame of the line of centres from the gear's."""
        return Placement2(float(self._rotation(phase)), complex(self.body.centre_distance + self.shift))


class _Gap:
    """The gap of one pin over its phase."""

    def __init__(self, side: ToothSide, motion: PinMotion) -> None:
        self.outline, self.pitch, self.motion = gear_outline(side), side.pitch_angle, motion
        self.labels = [s.label for s in side.segments]

    def __call__(self, phase: Real) -> tuple[Real, Real, Indices, Complex]:
        """Gap and its rate, the outline's curve, and the outward normal in the body's frame."""
        return self.at(*self.motion.centre(phase))

    def at(self, points: Complex, rates: Complex) -> tuple[Real, Real, Indices, Complex]:
        """The same of pins at points of the body's frame that move there at rates."""
        turn = np.exp(-1j * self.pitch * np.round(np.angle(points) / self.pitch))
        points, rates = points * turn, rates * turn
        upper = points.imag > 0
        feet = self.outline.feet(np.where(upper, np.conj(points), points))
        normal = np.where(upper, np.conj(feet.normal), feet.normal)
        slope = (np.conj(normal) * rates).real
        return feet.distance - self.motion.pin_radius, slope, feet.curve_index, normal * np.conj(turn)


def pin_gaps(side: ToothSide, motion: PinMotion) -> tuple[Real, Real]:
    """Phases (n,) over a whole turn from -pi on, rad, n a multiple of the pins, and the gap at each, mm."""
    pins = motion.number_of_pins
    number = min(_DRIVE_ANGLES, max(_LEAST_ANGLES, _MOST_PLACES // pins))
    # no phase is 0: there both sides of a tooth would have the same pin
    phases: Real = (np.arange(number * pins, dtype=float) + 0.5) * (2 * math.pi / (number * pins)) - math.pi
    return phases, _Gap(side, motion)(phases)[0]


def pin_contact(
    side: ToothSide, motion: PinMotion, tolerance: float | None = None, others: tuple[ContactPlace, ...] = ()
) -> PairContact:
    """The exact gap of all pins over one pitch of the drive; ``tolerance``: |gap| in mm that is contact.

    ``others``: gaps beside the pins' own, as between lobes and the ring that holds the pins. The verdict is that of
    every pair (mesh_search.PairContact); its sides are the phases below and above 0.
    """
    allowed = PIN_CONTACT_TOLERANCE * motion.pin_radius if tolerance is None else tolerance
    gap, pins = _Gap(side, motion), motion.number_of_pins
    phases, _ = pin_gaps(side, motion)
    values, slopes, *_ = gap(phases)
    step = 2 * math.pi / len(phases)
    low = np.flatnonzero((slopes <= 0) & (np.roll(slopes, -1) >= 0))
    high = (low + 1) % len(phases)
    near = np.flatnonzero(np.minimum(values[low], values[high]) < values.min() + np.abs(slopes).max() * step)
    low, high = low[near], high[near]
    start = phases[low]
    where, least = least_in_brackets(
        lambda t, rows: gap(t)[:2], start, start + step, (slopes[low], slopes[high]), _ACCURACY * motion.pin_radius
    )
    place = _worst(gap, np.append(where, phases), np.append(least, values), others)
    # phase = drive + 2 pi k / N: sorted phases fall into N runs of the same drive angles
    sides = _sides(phases.reshape(pins, -1), values.reshape(pins, -1))
    drives = phases[: len(sides)] + math.pi
    beside = np.linspace(-step, step, _NEAR)
    for _ in range(_ROUNDS):
        # between pins that part and pins that come
        tops = np.unique(np.argmax(np.column_stack([sides, sides.min(axis=1)]), axis=0))
        more = np.mod((drives[tops, None] + beside).ravel(), 2 * math.pi / pins)
        seen = more - math.pi + (2 * math.pi / pins * np.arange(pins))[:, None]
        drives = np.append(drives, more)
        sides = np.concatenate([sides, _sides(seen, gap(seen.ravel())[0].reshape(seen.shape))])
        beside *= 2 / (_NEAR - 1)
    order = np.argsort(drives)
    drives, sides = drives[order], sides[order]
    return told_contact(verdict_of(sides, allowed, place.gap), allowed, drives, sides, place)


def _sides(phases: Real, gaps: Real) -> Real:
    """Least gaps (n, 2) of the pins below and above the line of centres, from those (N, n) of every pin."""
    return np.stack([np.where(side, gaps, np.inf).min(axis=0) for side in (phases < 0, phases >= 0)], axis=1)


def _worst(gap: _Gap, phases: Real, values: Real, others: tuple[ContactPlace, ...]) -> ContactPlace:
    """The least gap of all, with its place on the body's outline."""
    at = float(phases[first_least(values)])
    distance, _, index, normal = gap(np.array([at]))
    centre, _ = gap.motion.centre(np.array([at]))
    foot = complex(centre[0] - (distance[0] + gap.motion.pin_radius) * normal[0])
    label = gap.labels[int(index[0])]
    found = ContactPlace(
        float(distance[0]), at % (2 * math.pi), complex(gap.motion.placement(at).apply(foot)), (Label.PIN, label)
    )
    return min((found, *others), key=lambda place: place.gap)


def lost_motion(side: ToothSide, motion: PinMotion) -> float:
    """How far the body turns from one stop to the other while the drive stands still, rad: the most over its angles.

    To each stop by Newton's steps: the least that one of the pins leaves, its gap over how fast turning closes it.
    """
    phases, _ = pin_gaps(side, motion)
    gap, (centres, _) = _Gap(side, motion), motion.centre(phases)
    drives = len(phases) // motion.number_of_pins
    between: Real = np.zeros(drives)
    for way in (1, -1):
        turn: Real = np.zeros(drives)
        for _ in range(_STEPS):
            seen = centres * np.exp(-1j * way * np.tile(turn, motion.number_of_pins))
            gaps, opening, *_ = gap.at(seen, -1j * way * seen)
            # a pin past which the body slides stops nothing
            stops = opening < -_SLIDES * np.abs(seen)
            left = np.where(stops, gaps, np.inf) / np.where(stops, -opening, 1.0)
            turn += left.reshape(motion.number_of_pins, drives).min(axis=0)
        between += np.maximum(turn, 0.0)
    return float(between.max())


def pins_in_contact(side: ToothSide, motion: PinMotion) -> int:
    """How many pins touch at every drive angle."""
    _, gaps = pin_gaps(side, motion)
    touching = np.abs(gaps) <= PIN_CONTACT_TOLERANCE * motion.pin_radius
    return int(touching.reshape(motion.number_of_pins, -1).sum(axis=0).min())


def stated_contact(gap: float, allowed: float, labels: tuple[Label, Label], point: complex) -> PairContact:
    """The verdict on a gap (mm) that is the same at every drive angle."""
    gaps, place = np.full((1, 2), gap), ContactPlace(gap, 0.0, point, labels)
    return told_contact(verdict_of(gaps, allowed), allowed, np.zeros(1), gaps, place)
