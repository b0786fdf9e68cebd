"""From a disk cam to its closed profile: whole where the follower leaves no undercut, trimmed where it does."""

from __future__ import annotations

import cmath
from itertools import pairwise

import numpy as np

from geometry.base.errors import UndercutError
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.cams.motion.follower_motion import TURN
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.undercut import Gap, kept_arcs
from geometry.curves.curve import Curve, Reversed, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.laws.piece import LawPiece
from geometry.plane.profile import Label, Profile, Segment

# rows of a table in one segment: those who sample a segment see each row
_BLOCK_ROWS = 32
_SLIVER = 1e-12


class CamShape(Record):
    """The exact outline of a cam, counter-clockwise, and what undercut took from the follower's motion."""

    profile: Profile
    gaps: tuple[Gap, ...]

    @property
    def lost_lift(self) -> float:
        """The most by which the follower stays below its motion, mm (rad if oscillating); 0 of a whole cam."""
        return max((g.lost_lift for g in self.gaps), default=0.0)


def cam_shape(cam: DiskCam, grow: float = 0.0) -> CamShape:
    """The profile of a disk cam moved ``grow`` mm out of the material, loops and cusps trimmed.

    One segment a piece of the law, split at inflections; dwells are circular arcs.

    Raises
    ------
    UndercutError
        What is left does not hang together.
    """
    kept = kept_arcs(cam, grow)
    chain: list[Segment] = []
    for start, end in kept.arcs:
        if cam.motion.tabled:
            chain += _table_segments(cam, start, end, grow)
            continue
        run: list[Segment] = []
        for piece in _pieces_between(cam, start, end):
            fresh = _segments(cam, piece, grow)
            if run:
                run += _filling(cam, grow, run[-1].curve, fresh[0].curve, piece.start)
            run += fresh
        chain += run
    if not kept.gaps:
        chain += _filling(cam, grow, chain[-1].curve, chain[0].curve, 0.0)
    ordered = [Segment(_backwards(s.curve), s.label) for s in reversed(chain)]
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
        raise UndercutError("base_circle_radius", _base_radius(cam), "undercut_at", at=at, lost=worst.lost_lift)
    return shape.profile


def _base_radius(cam: DiskCam) -> float:
    return float(abs(cam.reference_point(0.0))) - cam.radius


def _pieces_between(cam: DiskCam, start: float, end: float) -> list[LawPiece | _Cut]:
    """The pieces of the motion between two cam angles (the second may lie beyond one turn), cut at both."""
    turn = 2 * np.pi
    found = []
    for shift in (0.0, turn):
        for piece in cam.motion.pieces:
            low, high = max(start, piece.start + shift), min(end, piece.end + shift)
            # a sliver of rounding is no piece
            if high - low > _SLIVER:
                found.append((piece, low - shift, high - shift))
    return [_Cut(piece, low, high) if (low, high) != piece.domain else piece for piece, low, high in found]


class _Cut(Record):
    """A part of a piece of a motion."""

    piece: LawPiece
    start: float
    end: float

    @property
    def domain(self) -> tuple[float, float]:
        return self.start, self.end

    @property
    def is_constant(self) -> bool:
        return self.piece.is_constant


def _segments(cam: DiskCam, piece: LawPiece | _Cut, grow: float) -> list[Segment]:
    """The exact curves over one piece, over growing cam angle, split where their curvature changes sign."""
    whole = piece.piece if isinstance(piece, _Cut) else piece
    curve = cam.curve(whole, grow)
    if piece.is_constant:
        first = complex(curve.point(piece.start))
        return [Segment(Arc(0j, abs(first), cmath.phase(first), piece.start - piece.end), Label.DWELL)]
    if isinstance(piece, _Cut):
        curve = curve.trimmed(piece.start, piece.end)
    return [Segment(curve.trimmed(a, b), Label.CAM) for a, b in pairwise(curve.quiet_edges())]


def _table_segments(cam: DiskCam, start: float, end: float, grow: float) -> list[Segment]:
    """The exact curve over rows of a table, some in a segment; ``end`` may lie beyond one turn."""
    inner, found = cam.motion.stack.starts[::_BLOCK_ROWS], []
    for low, high in ((start, min(end, TURN)), (0.0, end - TURN)):
        # a sliver of rounding is no segment
        cuts = [low, *inner[(inner > low + _SLIVER) & (inner < high - _SLIVER)].tolist(), high]
        found += [Segment(cam.table_curve(a, b, grow), Label.CAM) for a, b in pairwise(cuts) if b - a > _SLIVER]
    return found


def _filling(cam: DiskCam, grow: float, before: Curve, after: Curve, angle: float) -> list[Segment]:
    """What closes the gap at a jump of velocity: the follower rolls over its own corner, or slides along its face."""
    start, end = end_point(before), start_point(after)
    # the base circle may be next to nothing beside the roller
    if abs(end - start) <= TOLERANCES.relative_join * (abs(start) + cam.radius):
        return []
    if cam.is_flat:
        return [Segment(Line(start, end), Label.CORNER)]
    centre = complex(cam.reference_point(angle)) * cmath.exp(-1j * angle)
    sweep = cmath.phase((end - centre) / (start - centre))
    return [Segment(Arc(centre, abs(grow - cam.radius), cmath.phase(start - centre), sweep), Label.CORNER)]


def _backwards(curve: Curve) -> Curve:
    """The curve against the cam angle: counter-clockwise about the axis."""
    return curve.reversed() if isinstance(curve, Arc | Line) else Reversed(curve)
