"""Curves of a file that lie in no order, put one behind the other into closed loops."""

from __future__ import annotations

import numpy as np

from exporters.formats.readback import SmoothLoop
from geometry.base.tolerance import DRAWN_ROUNDING
from geometry.curves.curve import Complex, Real
from parts.base.readback import refuse_if

# samples of each span: polynomials up to this degree less one come back exactly,
# arcs of a right angle to 1e-12 of their radius
_SAMPLES = 12
# ends of neighbouring curves in one file meet this well: mm, and a part of its size (files carry 15 digits)
_JOINT, _DIGITS = 2 * DRAWN_ROUNDING, 1e-9


def chained(pieces: list[Complex]) -> list[Complex]:
    """Sampled curves (each from its first to its last point) chained by their ends into closed loops."""
    return [np.concatenate([piece[:-1] for piece in chain]) for chain in _chains(pieces)]


def smooth_loops(spans: list[Complex]) -> tuple[SmoothLoop, ...]:
    """Smooth spans, sampled at ``nodes()`` each, as closed loops of polynomials."""
    powers = np.vander(nodes(), increasing=True)
    return tuple(SmoothLoop(np.asarray(np.linalg.solve(powers, np.array(chain).T).T)) for chain in _chains(spans))


def nodes() -> Real:
    """Places on 0 .. 1 with both ends, dense there: Chebyshev's."""
    return np.asarray((1 - np.cos(np.linspace(0, np.pi, _SAMPLES))) / 2)


def _chains(pieces: list[Complex]) -> list[list[Complex]]:
    """Pieces turned and put one behind the other, in closed chains.

    Raises
    ------
    ReadError
        An end lies by no other.
    """
    if not pieces:
        return []
    joint = _JOINT + _DIGITS * max(float(np.abs(piece).max()) for piece in pieces)
    ends = np.array([[piece[0], piece[-1]] for piece in pieces]).ravel()
    order = np.argsort(ends.real)
    places = ends.real[order]
    left = dict.fromkeys(range(len(pieces)))
    chains = []
    while left:
        index = next(iter(left))
        del left[index]
        chain = [pieces[index]]
        while abs(chain[-1][-1] - chain[0][0]) > joint:
            last = chain[-1][-1]
            low, high = np.searchsorted(places, (last.real - joint, last.real + joint))
            near = [int(i) for i in order[low:high] if int(i) // 2 in left and abs(ends[i] - last) <= joint]
            refuse_if(not near, f"a contour is open at ({last.real:.6g}, {last.imag:.6g})")
            index, side = divmod(min(near, key=lambda i: abs(ends[i] - last)), 2)
            del left[index]
            chain.append(pieces[index] if side == 0 else pieces[index][::-1])
        chains.append(chain)
    return chains
