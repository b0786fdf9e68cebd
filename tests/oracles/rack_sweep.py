"""Brute-force oracle of a rack-cut spur gear: sweep the rack tooth, measure the depth of a point in it.

Nothing here knows an involute or a trochoid. The tool is a polygon with rounded tips whose signed
distance is elementary; the gear is what is left when the tool has taken every rolling position.

Frames. Gear frame: complex x + iy in mm, axis at 0, tooth 1 centred on +x. Rack frame of one tooth:
``q = h + i t``, h = height above the datum line (away from the gear axis), t = distance along the rack
from the tooth's centre line. Gear and rack roll with r = m z/2: rack + s, gear + s/r. At s = 0 a rack
SPACE is centred on +x, so that the rack teeth stand at t = (k + 1/2) pi m.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Points = NDArray[np.complex128]

GRID = 513  # rolling positions in the first, dense scan of each point
_GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0
_STEPS = 82  # golden-section steps: 0.618**82 < 1e-17 of the bracket
_CHUNK = 2048  # points per block, bounds the memory of the scan


@dataclass(frozen=True)
class RackTool:
    """One tooth of the cutting rack, unbounded away from the gear.

    alpha in radians, m and thinning in mm; ha, c, rho, x, relief_depth (Delta), relief_height (h_g) in
    modules. The tooth is pi m/2 + thinning thick on the datum line and reaches (ha + c) m below it. With
    relief_depth > 0 its flank runs from height (ha - h_g) m outwards along a line of the larger angle
    alpha + atan(Delta cos(alpha)/h_g).
    """

    m: float
    alpha: float
    ha: float
    c: float
    rho: float
    x: float
    thinning: float = 0.0
    relief_depth: float = 0.0
    relief_height: float = 0.45

    def __post_init__(self) -> None:
        """Refuse a tool whose two tip roundings overlap or whose relief starts on the rounding."""
        if self.centre[1] < -1e-12 * self.m:
            raise ValueError("tip rounding does not fit the rack tooth")
        if self.relief_depth < 0 or (self.relief_depth and self.relief_corner[0] < self.straight_from):
            raise ValueError("relief must have a depth >= 0 and start on the straight flank")

    @cached_property
    def depth_mm(self) -> float:
        """Reach of the tooth below its datum line."""
        return (self.ha + self.c) * self.m

    @cached_property
    def half(self) -> float:
        """Half thickness on the datum line."""
        return (np.pi * self.m / 2 + self.thinning) / 2

    @cached_property
    def centre(self) -> tuple[float, float]:
        """Centre (h, |t|) of the tip rounding: rho inside the flank and rho inside the tip line."""
        radius = self.rho * self.m
        h = radius - self.depth_mm
        return h, self.half + (h * np.sin(self.alpha) - radius) / np.cos(self.alpha)

    @cached_property
    def straight_from(self) -> float:
        """Height at which the rounding touches the straight flank."""
        return self.centre[0] - self.rho * self.m * np.sin(self.alpha)

    @cached_property
    def relief_angle(self) -> float:
        """Angle of the relieved part of the flank."""
        return self.alpha + np.arctan(self.relief_depth * np.cos(self.alpha) / self.relief_height)

    @cached_property
    def relief_corner(self) -> tuple[float, float]:
        """Corner (h, |t|) at which the relieved part begins."""
        h = (self.ha - self.relief_height) * self.m
        return h, self.half + h * np.tan(self.alpha)

    def signed_depth(self, q: Points) -> Floats:
        """Signed distance of q = h + i t from the tooth's boundary, > 0 inside the tool.

        Exact outside, on and near the boundary; deep inside it is the exact distance or, above the relief
        corner far from the flank, a lower bound. Elementary: a rounded wedge is the inner sharp wedge
        grown by the disc rho; the relieved flank bounds a convex outside.
        """
        h, u = q.real, np.abs(q.imag)
        sin, cos = np.sin(self.alpha), np.cos(self.alpha)
        tip = h + self.depth_mm
        flank = (self.half - u) * cos + h * sin
        hc, uc = self.centre
        along_flank_normal = (u - uc) / cos
        along_tip_normal = hc - h - along_flank_normal * sin
        in_cone = (along_flank_normal >= 0) & (along_tip_normal >= 0)
        corner = self.rho * self.m - np.hypot(h - hc, u - uc)
        if self.relief_depth == 0:
            return np.where(in_cone, corner, np.minimum(flank, tip))
        poly, relief = self._relieved(h, u, flank)
        return np.where(in_cone, np.maximum(corner, relief), np.minimum(poly, tip))

    def _relieved(self, h: Floats, u: Floats, flank: Floats) -> tuple[Floats, Floats]:
        """Depths behind the bent flank, and (outside only) behind its relieved part alone."""
        h0, u0 = self.relief_corner
        sin, cos = np.sin(self.relief_angle), np.cos(self.relief_angle)
        relief = (u0 - u) * cos + (h - h0) * sin
        to_corner = np.hypot(h - h0, u - u0)
        behind_main = (h - h0) * np.cos(self.alpha) + (u - u0) * np.sin(self.alpha)
        behind_relief = (h - h0) * cos + (u - u0) * sin
        nearest_is_corner = (behind_main >= 0) & (behind_relief <= 0) & (flank > 0)
        poly = np.where(nearest_is_corner, to_corner, np.maximum(flank, relief))
        alone = np.where(behind_relief >= 0, np.minimum(relief, 0.0), -to_corner)
        return poly, alone


def _depth_at(psi: Floats, radius: Floats, angle: Floats, tool: RackTool, z: int) -> Floats:
    """Depth in the whole rack when the rolling has brought the point to the polar angle psi.

    The rack has then moved by s = r (psi - angle). Depth falls with |t|, so that the nearest tooth decides
    and t may be wrapped to one pitch: this covers all teeth, and psi in [-pi, pi] all rolling positions.
    """
    r = tool.m * z / 2
    pitch = np.pi * tool.m
    h = radius * np.cos(psi) - r - tool.x * tool.m
    t = radius * np.sin(psi) - r * (psi - angle) - pitch / 2
    t = t - pitch * np.round(t / pitch)
    return tool.signed_depth(h + 1j * t)


def _range(radius: Floats, least: Floats, tool: RackTool, z: int) -> Floats:
    """Half range of psi outside which the depth is certainly below `least`.

    The depth never exceeds the height above the tip line: radius cos(psi) - (r + x m - hf).
    """
    floor = tool.m * z / 2 + tool.x * tool.m - tool.depth_mm + least - 1e-3 * tool.m
    return np.arccos(np.clip(floor / np.maximum(radius, 1e-300), -1.0, 1.0))


def _scan(radius: Floats, angle: Floats, tool: RackTool, z: int, grid: int) -> Floats:
    """Greatest depth over all rolling positions: dense grid, then golden section in each local maximum."""
    nodes = np.linspace(-1.0, 1.0, grid)
    best = _depth_at(np.zeros_like(radius), radius, angle, tool, z)
    for _ in range(2):  # the second scan uses the first one's value to bound the range
        # two cells more at each end: a maximum in an end cell must have nodes on both sides of it
        span = _range(radius, best, tool, z) * (1 + 8 / grid)
        psi = span[:, None] * nodes
        depth = _depth_at(psi, radius[:, None], angle[:, None], tool, z)
        best = np.maximum(best, depth.max(axis=1))
    inner = depth[:, 1:-1]
    # Lipschitz: |d depth/d psi| <= |p exp(i psi) - r|, the distance from the pitch point
    speed = np.abs(radius[:, None] * np.exp(1j * psi[:, 1:-1]) - tool.m * z / 2)
    hope = inner + (speed + radius[:, None] * psi[:, -1:] * 4 / grid) * span[:, None] * 4 / grid
    peak = (inner >= depth[:, :-2]) & (inner >= depth[:, 2:]) & (hope >= best[:, None])
    row, column = np.nonzero(peak)
    value = _golden(psi[row, column], psi[row, column + 2], radius[row], angle[row], tool, z)
    np.maximum.at(best, row, value)
    return best


def _golden(lo: Floats, hi: Floats, radius: Floats, angle: Floats, tool: RackTool, z: int) -> Floats:
    """Greatest depth found by golden section in the brackets [lo, hi], all at once."""
    lo, hi = lo.copy(), hi.copy()
    a, b = hi - _GOLDEN * (hi - lo), lo + _GOLDEN * (hi - lo)
    fa, fb = (_depth_at(v, radius, angle, tool, z) for v in (a, b))
    best = np.maximum(fa, fb)
    for _ in range(_STEPS):
        left = fa > fb
        hi, lo = np.where(left, b, hi), np.where(left, lo, a)
        new = np.where(left, hi - _GOLDEN * (hi - lo), lo + _GOLDEN * (hi - lo))
        value = _depth_at(new, radius, angle, tool, z)
        a, b = np.where(left, new, b), np.where(left, a, new)
        fa, fb = np.where(left, value, fb), np.where(left, fa, value)
        best = np.maximum(best, value)
    return best


def penetration(points: ArrayLike, tool: RackTool, z: int, grid: int = GRID) -> Floats:
    """Greatest signed depth of gear-frame points in the rack over ALL rolling positions and rack teeth.

    0 on the generated outline (root, fillet, flank), < 0 in the metal (there it is minus the distance from
    the cut space, exactly), > 0 in the space (there at most the distance from the metal, see
    `clearance_error`). The tip circle plays no part. Accuracy a few 1e-15 of the radius.
    """
    p = np.atleast_1d(np.asarray(points, dtype=np.complex128)).ravel()
    radius, angle = np.abs(p), np.angle(p)
    blocks = [slice(i, i + _CHUNK) for i in range(0, len(p), _CHUNK)]
    parts = [_scan(radius[b], angle[b], tool, z, grid) for b in blocks]
    return np.concatenate(parts) if parts else np.zeros(0)


def outline_error(points: ArrayLike, tool: RackTool, z: int, tip_radius: float) -> Floats:
    """Distance-like error of points that should lie on the finished outline, tip circle included.

    The blank |p| <= ra less the swept tool is {max(penetration, |p| - ra) <= 0}; its boundary is where this
    is 0. So a point below the tip circle must have penetration 0, a point on it penetration <= 0.
    """
    p = np.atleast_1d(np.asarray(points, dtype=np.complex128)).ravel()
    return np.abs(np.maximum(penetration(p, tool, z), np.abs(p) - tip_radius))


def clearance_error(points: ArrayLike, distance: float, tool: RackTool, z: int) -> Floats:
    """|penetration - distance| of points that should lie `distance` off the generated outline.

    distance < 0 (into the metal): valid everywhere, away from the tip circle. distance > 0 (kerf path, in the
    space): valid for SMOOTH parts and distance <= rho m only. The tool position that made the foot point
    must contain the disc of that radius which touches the foot; every boundary point of the tool has such a
    disc of radius rho, no larger one near the rounding. Not valid about convex corners of the metal (tip,
    undercut junction, relief corner), where the parallel curve is an arc about the corner: use
    `exact_gear.normal_distance` there and for distance > rho m.
    """
    return np.abs(penetration(points, tool, z) - distance)
