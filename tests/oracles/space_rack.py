"""Brute-force oracle of a helical gear: the normal rack as a prism in space, rolled over the gear.

The rack's teeth are straight prisms inclined by the helix angle; their normal section is ``rack_sweep.RackTool``,
whose signed distance is elementary. A point of the gear at height z meets the prism where its lateral coordinate,
measured across the teeth, says. Nothing here knows a transverse module, an ellipse or an involute.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.oracles.rack_sweep import RackTool

Floats = NDArray[np.float64]

_NODES, _ZOOMS = 1601, 9


def space_penetration(points: NDArray[np.complex128], z: Floats, tool: RackTool, teeth: int, helix: float) -> Floats:
    """Greatest signed depth of points (n,) at heights (n,) in the rack over all rolling positions, mm.

    ``tool``: the normal section in normal modules; ``helix`` in rad, positive for a right-hand gear. The gear rolls on
    the pitch cylinder round which ``teeth`` normal pitches, each pi m_n / cos(helix) wide, lie.
    """
    radius, angle = np.abs(points)[:, None], np.angle(points)[:, None]
    pitch_radius = teeth * tool.m / np.cos(helix) / 2
    pitch = np.pi * tool.m

    def depth(psi: Floats) -> Floats:
        """At the polar angle psi; the rack has then moved by r (psi - angle) along its pitch plane."""
        height = radius * np.cos(psi) - pitch_radius - tool.x * tool.m
        along = radius * np.sin(psi) - pitch_radius * (psi - angle)
        across = along * np.cos(helix) - z[:, None] * np.sin(helix) - pitch / 2
        across = across - pitch * np.round(across / pitch)
        return tool.signed_depth(height + 1j * across)

    floor = pitch_radius + tool.x * tool.m - tool.depth_mm - 1e-2 * tool.m
    span = np.arccos(np.clip(floor / radius, -1, 1)) + 0.02
    psi = span * np.linspace(-1, 1, _NODES)
    best = np.full(len(points), -np.inf)
    # every local maximum that may be the greatest is looked at more closely
    values = depth(psi)
    for start in np.argsort(values, axis=1)[:, -3:].T:
        middle = np.take_along_axis(psi, start[:, None], axis=1)
        width = 2 * span / (_NODES - 1)
        for _ in range(_ZOOMS):
            near = middle + width * np.linspace(-1, 1, 41)
            found = depth(near)
            place = found.argmax(axis=1)[:, None]
            middle = np.take_along_axis(near, place, axis=1)
            width = width / 12
        best = np.maximum(best, found.max(axis=1))
    return best
