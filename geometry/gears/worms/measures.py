"""What is measured on a worm: over balls in its spaces, and its thread by chord and height; exact for every flank."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.gears.worms.thread import Thread

# GOST 19650 takes balls, or wires, of so many modules
BALL = 1.67


class Chord(Record):
    """The shortest chord across the thread on the reference cylinder, and its depth below the tip, mm."""

    thickness: float
    height: float


def over_balls(thread: Thread, diameter: float) -> float | None:
    """Over balls of a diameter (mm) in spaces on opposite sides, mm: two on one side, one on the other.

    A ball stands in the middle of a space; its centre lies on the normals of both flanks, which are images of each
    other. None: it touches no flank.
    """
    worm, line, radius = thread.worm, dict(thread.lines)["flank"], diameter / 2

    def centre(t: float) -> tuple[float, float]:
        """Distance of the centre from the axis, and how far it stands above the middle of the space, mm."""
        plane, way = line.point(np.array([t])), line.tangent(np.array([t]))
        normal = thread.normals(plane, way, 0.0)[0]
        out, beside = float(plane.real[0]) + radius * normal[0], worm.sign * radius * normal[1]
        turned = -math.atan2(beside, out)
        z = float(plane.imag[0]) + worm.parameter * turned + radius * float(normal[2])
        return math.hypot(out, beside), z - math.pi * worm.module / 2

    low, high = line.domain
    try:
        t = bracketed_root(lambda x: centre(x)[1], low + 1e-9 * (high - low), high).value
    except ConvergenceError:
        return None
    return 2 * (centre(t)[0] + radius)


def reference_chord(thread: Thread) -> Chord:
    """The chord between both flanks on the reference cylinder, across the thread.

    Its ends are images under half a turn about x; the shortest is where r^2 sin f cos f + p (h + p f) = 0.
    """
    worm = thread.worm
    r, p, half = worm.reference_radius, worm.parameter, worm.screw.half_thickness

    def slope(turn: float) -> float:
        return r * r * math.sin(turn) * math.cos(turn) + p * (half + p * turn)

    turn = bracketed_root(slope, -min(half / p, math.pi / 4), 0.0).value
    return Chord(2 * math.hypot(r * math.sin(turn), half + p * turn), worm.tip_radius - r * math.cos(turn))
