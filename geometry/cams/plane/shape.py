"""From a disk cam to its closed profile: whole where the follower leaves no undercut, trimmed where it does."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np

from geometry.base.errors import UndercutError
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.cams.motion.follower_motion import TURN
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.undercut import Gap, kept_arcs
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.laws.piece import LawPiece
from geometry.plane.profile import Label, Profile, Segment

# rows of a table in one segment: those who sample a segment see each row
_BLOCK_ROWS = 32
_SLIVER = 1e-12
# points of a curve at which it is looked at, how near they are to a line or an arc, by the cam's size, and the turning
# that is none
_PLAIN_SAMPLES, _PLAIN, _PLAIN_BEND = 33, 1e-13, 1e-8


class CamShape(Record):
    """The exact outline of a cam, counter-clockwise, and what undercut took from the follower's motion."""

    profile: Profile
    gaps: tuple[Gap, ...]

    @property
    def lost_lift(self) -> float:
        """The most by which the follower stays below its motion, mm (rad if oscillating); 0 of a whole cam."""
        return max((g.lost_lift for g in self.gaps), default=0.0)


@lru_cache(maxsize=16)
def cam_shape(cam: DiskCam, grow: float = 0.0) -> CamShape:
    """The profile of a disk cam moved ``grow`` mm out of the material, loops and cusps trimmed.

    One segment a piece of the law, split at inflections; dwells are circular arcs.

    Raises
    ------
    UndercutError
        What is left does not hang together.
    """
    kept = kept_arcs(cam, grow)
    arcs = _within_turn(kept.arcs)
    chain = [segment for arc in arcs for segment in _run(cam, *arc, grow)]
    if arcs[-1][1] - arcs[0][0] == TURN:
        chain += _filling(cam, grow, chain[-1].curve, chain[0].curve, 0.0)
    # against the cam angle: counter-clockwise about the axis
    ordered = [Segment(s.curve.reversed(), s.label) for s in reversed(chain)]
    return CamShape(Profile(tuple(ordered)), kept.gaps)


def whole_profile(cam: DiskCam) -> Profile:
    """The profile of a cam that is nowhere undercut.

    Raises
    ------
    UndercutError
        The follower cuts parts of the profile away; names the lift that is lost.
    """
    shape = cam_shape(cam)
    if shape.gaps:
        worst = max(shape.gaps, key=lambda g: g.lost_lift)
        at = float(np.degrees((worst.start + worst.end) / 2))
        raise UndercutError("base_circle_radius", cam.base_radius, "undercut_at", at=at, lost=worst.lost_lift)
    return shape.profile


def _within_turn(arcs: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Arcs of cam angle, of which the last may end beyond one turn, from angle 0 on, as every section begins."""
    cut = [(a - shift, b - shift) for a, b in arcs for shift in (0.0, TURN)]
    # a sliver of rounding is no arc
    return sorted((max(a, 0.0), min(b, TURN)) for a, b in cut if min(b, TURN) - max(a, 0.0) > _SLIVER)


def _run(cam: DiskCam, start: float, end: float, grow: float) -> list[Segment]:
    """The exact curves over an arc of cam angle, over growing angle."""
    if cam.motion.tabled:
        return _table_segments(cam, start, end, grow)
    run: list[Segment] = []
    for piece in cam.motion.pieces:
        low, high = max(start, piece.start), min(end, piece.end)
        # a sliver of rounding is no piece
        if high - low > _SLIVER:
            fresh = _segments(cam, piece, low, high, grow)
            if run:
                run += _filling(cam, grow, run[-1].curve, fresh[0].curve, low)
            run += fresh
    return run


def _segments(cam: DiskCam, piece: LawPiece, low: float, high: float, grow: float) -> list[Segment]:
    """The exact curves over a part of a piece, over growing cam angle, split where their curvature changes sign."""
    curve = cam.curve(piece, grow)
    if piece.is_constant:
        first = complex(curve.point(low))
        return [Segment(Arc(0j, abs(first), cmath.phase(first), low - high), Label.DWELL)]
    if (low, high) != piece.domain:
        curve = curve.trimmed(low, high)
    if (plain := _plain(curve)) is not None:
        return [Segment(plain, Label.CAM)]
    return [Segment(curve.trimmed(a, b), Label.CAM) for a, b in pairwise(curve.quiet_edges())]


def _plain(curve: Curve) -> Line | Arc | None:
    """The line or the arc that a curve is but for rounding."""
    t = np.linspace(*curve.domain, _PLAIN_SAMPLES)
    points, bends = curve.point(t), curve.curvature(t)
    # a curve with a cusp is neither
    if not np.isfinite(bends).all():
        return None
    first, last, bend = complex(points[0]), complex(points[-1]), float(bends.mean())
    near, chord = _PLAIN * float(np.abs(points).max()), last - first
    if not np.abs(bends - bend).max() * abs(chord) < _PLAIN_BEND or not abs(chord) > near:
        return None
    if abs(bend * chord) < _PLAIN_BEND:
        off = ((points - first) * np.conj(chord)).imag / abs(chord)
        return Line(first, last) if np.abs(off).max() < near else None
    centre = complex((points[[0, -1]] + 1j * curve.tangent(t[[0, -1]]) / bend).mean())
    turned = np.unwrap(np.angle(points - centre))
    arc = Arc(centre, abs(first - centre), float(turned[0]), float(turned[-1] - turned[0]))
    return arc if np.abs(np.abs(points - centre) - arc.radius).max() < near else None


def _table_segments(cam: DiskCam, start: float, end: float, grow: float) -> list[Segment]:
    """The exact curve over rows of a table, some in a segment."""
    inner = cam.motion.stack.starts[::_BLOCK_ROWS]
    cuts = [start, *inner[(inner > start + _SLIVER) & (inner < end - _SLIVER)].tolist(), end]
    return [Segment(cam.table_curve(a, b, grow), Label.CAM) for a, b in pairwise(cuts)]


def _filling(cam: DiskCam, grow: float, before: Curve, after: Curve, angle: float) -> list[Segment]:
    """What closes the gap at a jump of velocity: the follower rolls over its own corner, or slides along its face."""
    if not cam.is_flat and grow == cam.radius:
        # both go through the centre, whatever they are off by beside a base circle that is next to nothing
        return []
    start, end = end_point(before), start_point(after)
    # the base circle may be next to nothing beside the roller
    if abs(end - start) <= TOLERANCES.relative_join * (abs(start) + cam.radius):
        return []
    if cam.is_flat:
        return [Segment(Line(start, end), Label.CORNER)]
    centre = complex(cam.reference_point(angle)) * cmath.exp(-1j * angle)
    sweep = cmath.phase((end - centre) / (start - centre))
    return [Segment(Arc(centre, abs(grow - cam.radius), cmath.phase(start - centre), sweep), Label.CORNER)]
