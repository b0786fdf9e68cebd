"""Contact of a Geneva drive through a whole cycle: pins in slots, locking arcs on the disc, tips in its reliefs.

Bodies of lines and arcs come nearest at a corner of one of them, at the middle of a round tip, or where the disc stands
in a locking arc; so the signed distances of these places from the other's exact outline tell all of the gap.
"""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.gears.mesh.search import ContactPlace, PairContact, first_least, told_contact, verdict_of
from geometry.gears.pins.contact import PIN_CONTACT_TOLERANCE
from geometry.gears.pins.geneva import GenevaDisc
from geometry.plane.distance import Boundary, Indices
from geometry.plane.profile import Label, joint_turn

# turns of the driver in a cycle, rounds of finer ones beside the least gap, places on a locking arc of the disc
_TURNS, _ROUNDS, _PLACES = 720, 8, 17
_NEAR = 9


class GenevaContact(Record, dict=True):
    """A driver and its wheel, that ``turn`` (rad) and ``shift`` (mm) off the exact phase and centre distance."""

    disc: GenevaDisc
    turn: float = 0.0
    shift: float = 0.0

    def result(self, tolerance: float | None = None) -> PairContact:
        """The verdict; the drive angle is that of pin 1 from where it is deepest."""
        pin = self.disc.wheel.pin_diameter / 2
        allowed = PIN_CONTACT_TOLERANCE * pin if tolerance is None else tolerance
        drive = self.disc.drive
        half = math.pi / drive.number_of_pins
        # where a motion ends, and beside it
        ends = [way * drive.half_motion_angle * part for way in (-1, 1) for part in (1.0, 1 - 1e-6)]
        turns: Real = np.unique(np.concatenate([np.linspace(-half, half, _TURNS + 1), [0.0, *ends]]))
        found = self.gaps(turns)
        worst, step = _least(turns, *found), 2 * half / _TURNS
        for _ in range(_ROUNDS):
            more = np.clip(worst.drive_angle + step * np.linspace(-1, 1, _NEAR), -half, half)
            worst = min(worst, _least(more, *self.gaps(more)), key=lambda place: place.gap)
            step *= 2 / (_NEAR - 1)
        gaps = np.stack([found[0]] * 2, axis=1)
        return told_contact(verdict_of(gaps, allowed, worst.gap), allowed, turns, gaps, worst)

    def gaps(self, turns: Real) -> tuple[Real, Complex, Indices]:
        """At turns (n,) the least gap, mm, its place from the driver's axis, the line of centres along +x, and what it
        is of: 0 a pin, 1 the disc, 2 a tip."""
        wheel, drive = self.disc.wheel, self.disc.drive
        driver = turns + (math.pi if drive.internal else 0.0)
        rotation = math.pi + drive.sense * drive.wheel_turn(turns) + self.turn
        apart = drive.centre_distance + self.shift
        pins = np.array(self.disc.pin_centres())
        pins = pins[None, :] * np.exp(1j * driver)[:, None]
        on_disc = self._on_disc(driver)
        rows = [
            (self._of_wheel(pins, rotation, apart) - wheel.pin_diameter / 2, pins),
            (self._of_wheel(on_disc, rotation, apart), on_disc),
            self._of_disc(driver, rotation, apart),
        ]
        best = [(np.argmin(gap, axis=1), gap, seen) for gap, seen in rows]
        every = np.arange(len(turns))
        gaps = np.stack([gap[every, k] for k, gap, _ in best])
        seen = np.stack([at[every, k] for k, _, at in best])
        kind = np.argmin(gaps, axis=0)
        return gaps[kind, every], seen[kind, every], kind

    def _on_disc(self, driver: Real) -> Complex:
        """Places on the disc's locking arcs, their ends, and where the line of centres meets them."""
        radius = self.disc.wheel.locking_radius
        arcs = [edge for edge in self.disc.outline() if isinstance(edge, Arc) and edge.centre == 0]
        own = np.concatenate([arc.point(np.linspace(*arc.domain, _PLACES)) for arc in arcs])
        fixed = own[None, :] * np.exp(1j * driver)[:, None]
        line = np.full(len(driver), complex(radius))
        turned = np.mod(-driver[:, None] - np.array([arc.start_angle for arc in arcs]), 2 * math.pi)
        on_arc = (turned <= np.array([arc.sweep for arc in arcs])).any(axis=1)
        # where that place is relieved an end stands for it
        return np.column_stack([fixed, np.where(on_arc, line, fixed[:, 0])])

    def _of_wheel(self, places: Complex, rotation: Real, apart: float) -> Real:
        """Signed distances of places (n, k) from the wheel."""
        seen = (places - apart) * np.exp(-1j * rotation)[:, None]
        pitch = 2 * self.disc.drive.half_slot_angle
        # into the sector from locking arc to locking arc
        seen = seen * np.exp(-1j * pitch * np.round(np.angle(seen) / pitch))
        return self._sector.feet(seen.ravel()).distance.reshape(seen.shape)

    @cached_property
    def _sector(self) -> Boundary:
        half = self.disc.wheel.half_period()
        edges = (*(edge.mirrored() for edge in reversed(half)), *half)
        if self.disc.drive.internal:
            edges = tuple(edge.reversed() for edge in reversed(edges))
        return Boundary(edges)

    def _of_disc(self, driver: Real, rotation: Real, apart: float) -> tuple[Real, Complex]:
        """Signed distances of the wheel's tips about the nearest slots from the disc."""
        wheel, pitch = self.disc.wheel, 2 * self.disc.drive.half_slot_angle
        half = wheel.half_period()
        corners = [complex(b.point(b.domain[0])) for a, b in pairwise(half) if abs(joint_turn(a, b)) > 1e-9]
        tips = [(corner, 0.0) for corner in corners]
        if wheel.tip_rounding > 0:
            tips.append((complex(wheel.drive.mouth_radius, wheel.half_width + wheel.tip_rounding), wheel.tip_rounding))
        tips += [(place.conjugate(), radius) for place, radius in tips]
        own = np.array([place for place, _ in tips])
        nearest = np.round((math.pi - rotation) / pitch)
        slots = [own * np.exp(1j * (rotation + (nearest + k) * pitch))[:, None] for k in (-1, 0, 1)]
        places = apart + np.concatenate(slots, axis=1)
        seen = places * np.exp(-1j * driver)[:, None]
        disc = Boundary(tuple(self.disc.outline()), closed=True)
        distance = disc.feet(seen.ravel()).distance.reshape(seen.shape)
        return np.asarray(distance - np.tile([radius for _, radius in tips], 3)), np.asarray(places)


def _least(turns: Real, gaps: Real, places: Complex, kinds: Indices) -> ContactPlace:
    """The least gap of several turns."""
    k = first_least(gaps)
    labels = (Label.PIN, Label.FLANK) if kinds[k] == 0 else (Label.DWELL, Label.TIP_LAND)
    return ContactPlace(float(gaps.min()), float(turns[k]), complex(places[k]), labels)
