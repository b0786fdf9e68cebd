"""How far triangles leave the walls of a cylindrical cam: a proven bound out of samples.

F_t(X) is the distance of a point from the roller at the cam angle t, D the least of them: 0 on a wall. In X, F_t is
convex, and bends by no more than 1 / |X - axis| across the axis. So on a small triangle D is at most the greatest
F_t of its corners for any t that one likes; and no F_t is less than D at the corners by more than e^2 / 8 |X - axis|,
e the edges across the roller's axis. As the walls are not undercut, no F_t of a point that lies d off them is below -d.
Which t may count is found by samples again: F_t changes by no more than the relative speed, which the bounds of the law
give. Derivation: DERIVATIONS.md.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from geometry.cams.barrel.cam import BarrelCam, SwingGuide
from geometry.curves.curve import Real

# parts of a triangle's edges that are tried, and what the samples' gaps may add to the tolerance
_PARTS, _GAP_SHARE, _MOST_SAMPLES = (4, 6, 8, 12, 16, 24, 32), 0.08, 2_000_000
# angles from a triangle's own at which the roller is put far from it: a geometric series up to a half turn, rad
_FIRST_TURN, _TURN_RATIO = 0.01, 1.12
_CHUNK = 200_000


def triangle_bound(cam: BarrelCam, corners: Real, near: Real, width: float, tolerance: float) -> float:
    """Bound of the distance of triangles (n, 3, 3), their corners on one wall, from it, mm.

    ``near`` (n, 3): the corners' cam angles, without jumps, rad; ``width``: how far they may be off. At most about a
    tenth of the tolerance above the greatest distance of its own samples, where edges are short against the roller; inf
    where they are so long that nothing near the tolerance is proven.
    """
    window = _windows(cam, corners, near)
    for parts in _PARTS:
        if parts > _PARTS[0] and len(corners) * parts**2 / 2 > _MOST_SAMPLES:
            break
        tried, rest = parts, _gaps(cam, corners, near, window, parts)
        if float(rest.max()) <= _GAP_SHARE * tolerance:
            break
    if not float(rest.max()) <= tolerance:
        # nothing near the tolerance can be proven
        return math.inf
    lattice, small = _lattice(tried)
    step, worst = max(1, _CHUNK // len(lattice)), 0.0
    for first in range(0, len(corners), step):
        rows = slice(first, first + step)
        found = _bounds(cam, corners[rows], near[rows], width, lattice, small)
        worst = max(worst, found[0], float((found[1] + rest[rows]).max()))
    return worst


def _lattice(parts: int) -> tuple[Real, NDArray[np.int64]]:
    """Barycentric places that cut each edge in so many parts, and the corners of the small triangles."""
    places = [(i, j) for i in range(parts + 1) for j in range(parts + 1 - i)]
    number = {place: k for k, place in enumerate(places)}
    small = []
    for i, j in places:
        if i + j < parts:
            small.append((number[i, j], number[i + 1, j], number[i, j + 1]))
        if i + j < parts - 1:
            small.append((number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]))
    shares = np.array([(parts - i - j, i, j) for i, j in places], dtype=float) / parts
    return shares, np.array(small)


def _bounds(
    cam: BarrelCam, corners: Real, near: Real, width: float, lattice: Real, small: NDArray[np.int64]
) -> tuple[float, Real]:
    """The greatest D that the small triangles may have, and the greatest |D| of each triangle's samples, mm."""
    samples = np.einsum("sk,nkc->nsc", lattice, corners)
    away, at = cam.foot(samples.reshape(-1, 3), (near @ lattice.T).ravel(), width)
    shape = samples.shape[:2]
    away, at = away.reshape(shape), at.reshape(shape)
    axis, turn = cam.place(at, 0)[0], np.exp(1j * at)
    plane, z = samples[..., 0] + 1j * samples[..., 1], samples[..., 2]
    least = np.full((shape[0], len(small)), np.inf)
    for own in range(3):
        mine = small[:, own]
        greatest = away[:, mine]
        for other in ((own + 1) % 3, (own + 2) % 3):
            there = small[:, other]
            fixed = plane[:, there] * turn[:, mine]
            gap = np.abs(fixed.imag + 1j * z[:, there] - axis[:, mine]) - cam.radius_at(fixed.real)
            greatest = np.maximum(greatest, cam.upright * gap)
        least = np.minimum(least, greatest)
    return float(least.max()), np.abs(away).max(axis=1)


def _gaps(cam: BarrelCam, corners: Real, near: Real, window: Real, parts: int) -> Real:
    """What F_t may fall below its least corner on a small triangle, each (n,), mm."""
    edges = np.roll(corners, -1, axis=1) - corners
    whole = np.linalg.norm(edges, axis=2)
    along = np.abs(((edges[..., 0] + 1j * edges[..., 1]) * np.exp(1j * near.mean(axis=1))[:, None]).real)
    across = np.sqrt(np.maximum(0.0, whole**2 - along**2)) + along * np.sin(np.minimum(window, math.pi / 2))[:, None]
    across = np.minimum(across, whole).max(axis=1) / parts
    # the thinnest part of the roller that a triangle meets in the window, less what may reach into it
    plane = (corners[..., 0] + 1j * corners[..., 1]) * np.exp(1j * near)
    aside = max(map(abs, cam.side_range())) + float(cam.radius_at(cam.outer))
    thin = cam.radius_at(plane.real.min(axis=1) - aside * window)
    with np.errstate(divide="ignore", invalid="ignore"):
        gap = cam.upright * across**2 / (8 * thin)
        return np.where((thin > 0) & (4 * gap < thin), gap / (1 - 2 * gap / thin), np.inf)


def _windows(cam: BarrelCam, corners: Real, near: Real) -> Real:
    """How far t may be from a triangle's own angles while its roller touches it, (n,), rad."""
    middle, own = corners.mean(axis=1), near.mean(axis=1)
    size = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    plane = middle[:, 0] + 1j * middle[:, 1]
    # no point of the cam goes past the roller faster
    fastest = math.hypot(cam.outer * 1.01 + _greatest_rate(cam), cam.outer)
    count = math.ceil(math.log(math.pi / _FIRST_TURN) / math.log(_TURN_RATIO)) + 1
    steps = np.minimum(_FIRST_TURN * _TURN_RATIO ** np.arange(count), math.pi)
    window = np.zeros(len(middle))
    for sense in (1, -1):
        clear = np.ones(len(middle), dtype=bool)
        for k in range(count - 2, -1, -1):
            at = own + sense * steps[k]
            fixed = plane * np.exp(1j * at)
            away = np.abs(fixed.imag + 1j * middle[:, 2] - cam.place(at, 0)[0]) - cam.radius_at(fixed.real)
            far = (cam.upright * away - fastest * (steps[k + 1] - steps[k]) > size) | (fixed.real <= 0)
            window = np.where(clear & ~far, np.maximum(window, steps[k + 1]), window)
            clear &= far
            if not clear.any():
                break
    return np.maximum(window, steps[0]) + np.ptp(near, axis=1)


def _greatest_rate(cam: BarrelCam) -> float:
    """Proven bound of |p'|, mm/rad."""
    rates = [
        float(piece.bounds(1, edges[:-1], edges[1:])[1].max())
        for piece in cam.motion.pieces
        for edges in (np.linspace(*piece.domain, 65),)
    ]
    return max(rates) * (cam.guide.arm_length if isinstance(cam.guide, SwingGuide) else 1.0)
