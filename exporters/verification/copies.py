"""Teeth of a STEP file held against each other: a profile that is repeated about the axis gives nets of poles that are.

A pole that is moved along its surface, or that sways it by less than is declared, is found so, and by its place.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from exporters.formats.read_part21 import Index
from exporters.formats.read_solid import GAP, Model
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.solids.body import Body
from parts.base.texts import N_, unless

# nets that are no copies of each other differ by more in one of so many measures, mm
_APART, _MEASURES = 1e-4, 3


def copy_failures(model: Model, body: Body) -> list[str]:
    """Splines that are off their copies, where all teeth are repeated about the axis alike."""
    walls = [(body.loop_profile(wall.lower), body.is_screw(wall)) for wall in body.walls]
    counts = {p.count for p, screw in walls if screw or not all(isinstance(s.curve, Line | Arc) for s in p.period)}
    if len(counts) != 1 or (count := counts.pop()) == 1:
        return []
    failures: list[str] = []
    for poles, who in _nets(model):
        own, places = _turned_home(poles, count)
        heights = own[:, -poles.shape[1] :].mean(axis=1)
        for alike in _alike(own, places):
            # others are edges of chamfers on bores; thin slices of a chamfer stand one over the other
            ordered = alike[np.argsort(heights[alike])].reshape(-1, count) if len(alike) % count == 0 else ()
            for members in ordered:
                off = np.abs(own[members] - np.median(own[members], axis=0)).max(axis=1)
                worst, told = off.max(), N_("#{entity} of the STEP file is {off:.3g} mm off its copies")
                failures += unless(not worst > GAP, told, entity=who[members[off.argmax()]], off=worst)
    return failures


def _alike(own: Real, places: Complex) -> list[Index]:
    """The rows of each class of copies: in one measure after the other, and in their places, they lie together."""
    classes = [np.arange(len(own))]
    sines = (np.sin(number * np.arange(1.0, own.shape[1] + 1)) for number in range(1, _MEASURES + 1))
    for told in (places.real, places.imag, *(own @ weights for weights in sines)):
        ordered = [rows[np.argsort(told[rows])] for rows in classes]
        classes = [c for rows in ordered for c in np.split(rows, np.flatnonzero(np.diff(told[rows]) > _APART) + 1)]
    return classes


def _nets(model: Model) -> Iterator[tuple[Real, Index]]:
    """Poles (n, k, 3) of surfaces and edges with the same knots, and whose they are."""
    for patches in model.patches:
        yield patches.poles.reshape(len(patches.faces), -1, 3), model.faces[patches.faces]
    for _, numbers, _, poles in model.curves.splines:
        # behind the edges stand curves that are only moved
        if (edges := numbers < len(model.edges)).any():
            yield poles[edges], model.edges[numbers[edges]]


def _turned_home(poles: Real, count: int) -> tuple[Real, Complex]:
    """Nets turned about the axis until their middles stand on +x, (n, 3 k); where in its period each stood."""
    flat = poles[..., 0] + 1j * poles[..., 1]
    angles = np.angle(flat.mean(axis=1))
    flat *= np.exp(-1j * angles)[:, None]
    # teeth of one period may be alike but for the fit of their splines
    return np.concatenate([flat.real, flat.imag, poles[..., 2]], axis=1), np.exp(1j * count * angles)
