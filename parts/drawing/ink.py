"""What is on paper while words look for their places: pieces of lines, boxes of words, and what crosses what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, get_args

import numpy as np

from geometry.approximation.outline import CadCurve
from geometry.base.record import Draft, field
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Line
from parts.drawing.canvas import Box

# what a straight line is on a drawing: of the part, or of a size
Role = Literal["edge", "extension", "dimension", "leader"]
_ROLES = get_args(Role)
# what words keep off lines, mm
FREE = 0.4
_SAMPLES = 33
# what a crossing of two of them costs, in rows of dimension lines, and a line that lies on another, or so near it, mm,
# over such a length: GOST 2.307 forbids the first where it can be avoided, leaders never cross each other
_CROSSING = np.array([[0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.5, 1.5], [0.3, 1.5, 6.0, 18.0], [1.5, 1.5, 18.0, 20.0]])
_LYING, _BESIDE, _ALONG = np.array([0.0, 0.0, 10.0, 10.0]), 1.0, 0.5
# so far, mm, a leader goes beside another line at most
_FOLLOWED = 8.0
# what ends within another line does not cross it, mm, but leaders keep off the ends of dimension lines and of leaders;
# sine of directions that are one
_TOUCH, _PARALLEL = 0.3, 1e-4
_MARGINS = np.where(_CROSSING >= 6.0, -_TOUCH, _TOUCH)
_MARGINS[_ROLES.index("dimension"), _ROLES.index("dimension")] = _TOUCH


def chords(curve: Curve | CadCurve) -> Complex:
    """The ends of a chain of chords along a curve, (2, n); of a line itself."""
    points = curve.point(np.array(curve.domain) if isinstance(curve, Line) else np.linspace(*curve.domain, _SAMPLES))
    return np.stack([points[:-1], points[1:]])


class Ink(Draft):
    """What is on paper."""

    pieces: list[Complex] = field(default_factory=list)
    boxes: list[Box] = field(default_factory=list)
    straight: Complex = field(default_factory=lambda: np.zeros((3, 0), dtype=complex))
    spans: Real = field(default_factory=lambda: np.zeros((4, 0)))
    sides: Real = field(default_factory=lambda: np.zeros((0, 4)))

    def add(self, curve: Curve | CadCurve, role: Role | None = None) -> None:
        """A curve as a chain of chords."""
        piece = chords(curve)
        self.pieces.append(piece)
        if role is not None and isinstance(curve, Line):
            self.note({role: [Line(complex(piece[0, 0]), complex(piece[1, 0]))]})

    def holds(self, lines: Sequence[Line], words: Box) -> bool:
        """Whether words and their lines have room: neither words over any line, nor over words."""
        words = words.grown(FREE)
        if len(self.sides) != len(self.boxes):
            self.sides = np.array([[b.left, b.low, b.right, b.high] for b in self.boxes])
        left, low, right, high = self.sides.T
        if ((left < words.right) & (words.left < right) & (low < words.high) & (words.low < high)).any():
            return False
        all_lines = self.lines
        left, right, low, high = self.spans
        near = (left < words.right) & (words.left < right) & (low < words.high) & (words.low < high)
        own = np.array([[words.left, words.low, words.right, words.high]])
        if near.any() and _held(own, all_lines[:, near]).any():
            return False
        ends = np.array([[line.start for line in lines], [line.end for line in lines]])
        grown = self.sides + np.array([-FREE, -FREE, FREE, FREE])
        return not _held(np.concatenate([grown, own]), ends).any()

    def under(self, line: Line) -> bool:
        """Whether a level line lies on another, or so near it that both seem one."""
        (start, end), at = self.lines, np.sort([line.start.real, line.end.real])
        left, right = np.minimum(start.real, end.real), np.maximum(start.real, end.real)
        shared = np.minimum(right, at[1]) - np.maximum(left, at[0])
        near = (np.abs(start.imag - line.start.imag) < _BESIDE) & (np.abs(end.imag - start.imag) < _TOUCH)
        return bool((near & (shared > _ALONG)).any())

    def follows(self, line: Line) -> bool:
        """Whether a line goes so far so near to another that both seem one, or parallel to hatching (GOST 2.316)."""
        way = line.end - line.start
        own = (self.lines - line.start) * (way.conjugate() / abs(way))
        within = _shares(np.array([[0.0, -_BESIDE, abs(way), _BESIDE]]), own)[0]
        return bool((within * np.abs(own[1] - own[0]) > _FOLLOWED).any())

    def beside(self, at: complex) -> bool:
        """Whether a straight line passes a point so near that it seems to touch it."""
        start, end, _ = self.straight
        way = end - start
        share = np.clip(((at - start) * way.conj()).real / np.maximum(np.abs(way) ** 2, 1e-12), 0.0, 1.0)
        return bool((np.abs(start + share * way - at) < _BESIDE).any())

    @property
    def lines(self) -> Complex:
        """Ends of all pieces, (2, n)."""
        if len(self.pieces) > 1:
            self.pieces[:] = [np.concatenate(self.pieces, axis=1)]
        if not self.pieces:
            return np.zeros((2, 0), dtype=complex)
        found = self.pieces[0]
        if self.spans.shape[1] != found.shape[1]:
            x, y = found.real, found.imag
            # upright and level pieces have no width: what lies within a box is found all the same
            self.spans = np.array([x.min(axis=0) - FREE, x.max(axis=0) + FREE, y.min(axis=0) - FREE,
                                   y.max(axis=0) + FREE])  # fmt: skip
        return found

    def note(self, new: Mapping[Role, Sequence[Line]]) -> None:
        """Remember straight lines by what they are."""
        rows = [(line.start, line.end, _ROLES.index(role)) for role, lines in new.items() for line in lines]
        self.straight = np.concatenate([self.straight, np.array(rows, dtype=complex).reshape(-1, 3).T], axis=1)

    def run_over(self) -> tuple[int, int]:
        """How many leaders cross leaders, and how many dimension lines are crossed by some."""
        sizes, leaders = (self.straight[:, self.straight[2] == _ROLES.index(role)] for role in ("dimension", "leader"))
        # those of one leader only end in each other
        over = np.triu(_crossings(leaders, leaders, np.full_like(_MARGINS, _TOUCH)))
        return int(np.count_nonzero(over)), int(np.count_nonzero(_costs(sizes, leaders)))

    def costs(self, places: Sequence[Mapping[Role, Sequence[Line]]]) -> list[float]:
        """What new lines of a size cost by what they cross and lie on, for each of its places."""
        rows = [
            (line.start, line.end, _ROLES.index(role), place)
            for place, new in enumerate(places)
            for role, lines in new.items()
            for line in lines
        ]
        if not rows:
            return [0.0] * len(places)
        own, (start, end, _) = np.array(rows, dtype=complex).T, self.straight
        ends = own[:2]
        near = np.ones(start.size, dtype=bool)
        for one, two, here in ((start.real, end.real, ends.real), (start.imag, end.imag, ends.imag)):
            near &= (np.minimum(one, two) < here.max() + _BESIDE) & (np.maximum(one, two) > here.min() - _BESIDE)
        each = _costs(own, self.straight[:, near])
        return np.bincount(own[3].real.astype(int), each, len(places)).tolist()


def _held(boxes: Real, lines: Complex) -> np.ndarray:
    """Which of boxes holds a piece of which line."""
    return _shares(boxes, lines) > 0.0


def _shares(boxes: Real, lines: Complex) -> Real:
    """The part of each line in each of boxes, (m, 4), below 0 of none; ends of lines: (2, n) (Liang and Barsky)."""
    start, way = lines[0], lines[1] - lines[0]
    # across and upwards at once, (2, m, n)
    at, step = (np.array([x.real, x.imag])[:, None] for x in (start, way))
    least, most = boxes.T[:2, :, None], boxes.T[2:, :, None]
    flat = np.abs(step) < 1e-12
    safe = np.where(flat, 1.0, step)
    one, two = (least - at) / safe, (most - at) / safe
    inside = (at > least) & (at < most)
    first = np.where(flat, np.where(inside, 0.0, 2.0), np.minimum(one, two)).max(axis=0)
    last = np.where(flat, 1.0, np.maximum(one, two)).min(axis=0)
    return np.asarray(np.minimum(last, 1.0) - np.maximum(first, 0.0))


def _turned(lines: Complex, others: Complex) -> tuple[Complex, Complex, Complex, Real, np.ndarray]:
    """Of lines, down, and others, across: both ways, what is between their starts, the ways' product, what is parallel.

    Rows of either: both ends, what it is.
    """
    (a, u), (b, v) = ((group[0], group[1] - group[0]) for group in (lines, others))
    u, between = u[:, None], b[None, :] - a[:, None]
    turn = (np.conj(u) * v).imag
    return u, v[None, :], between, turn, np.abs(turn) <= _PARALLEL * np.abs(u) * np.abs(v)


def _crossings(lines: Complex, others: Complex, margins: Real) -> np.ndarray:
    """Which of lines, (n,), cross which of others within both; rows: both ends, what it is."""
    u, v, between, turn, parallel = _turned(lines, others)
    long, other, safe = np.abs(u), np.abs(v), np.where(parallel, 1.0, turn)
    # places of the crossing along both, mm
    s, t = (np.conj(between) * v).imag / safe * long, (np.conj(between) * u).imag / safe * other
    margin = margins[lines[2].real.astype(int)][:, others[2].real.astype(int)]
    return np.asarray(~parallel & (s > margin) & (s < long - margin) & (t > margin) & (t < other - margin))


def _costs(lines: Complex, others: Complex) -> Real:
    """Of lines, (n,), that cross others, and that lie on others; rows: both ends, what it is."""
    u, v, between, _, parallel = _turned(lines, others)
    here, there = lines[2].real.astype(int), others[2].real.astype(int)
    crossed, long = _crossings(lines, others, _MARGINS), np.abs(u)
    way = u / long
    off = np.abs((np.conj(way) * between).imag)
    ends = (np.conj(way) * between).real, (np.conj(way) * (between + v)).real
    shared = np.minimum(np.maximum(*ends), long) - np.maximum(np.minimum(*ends), 0.0)
    lying = parallel & (off < _BESIDE) & (shared > _ALONG)
    return np.asarray((crossed * _CROSSING[here][:, there]).sum(axis=1) + lying.sum(axis=1) * _LYING[here])
