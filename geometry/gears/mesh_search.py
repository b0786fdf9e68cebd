"""The search for the least gap of two meshing bodies over one pitch of motion, on their exact outlines.

The gap at a drive angle is the least signed distance of all points of the second body's outline from the first
gear's, and of the first gear's convex corners from the second's: flank on flank, tip corners on flanks and fillets,
tip on root. A gear is symmetric about every tooth and space, so the outline point nearest to any point lies in the
point's own half pitch: distances cost the same for 10 and for 10 000 teeth. What the second body is (external gear,
ring, rack) and how it moves is told by the subclasses of ``MeshSearch``.

Frame: the first gear's axis is the origin, it turns by the drive angle, and the mesh lies towards +x.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from geometry.contact import Boundary, Indices, Verdict, folded, least_in_brackets, promising, sampled
from geometry.curve import Complex, Real
from geometry.gears.tooth import ToothSide
from geometry.profile import Label, Segment

# |gap| up to this part of the module is contact: rounding of 1e4 teeth's coordinates and rack A's own 1.6e-9
CONTACT_TOLERANCE = 1e-8
# samples along curves, in modules; drive angles in a pitch; positions of a corner on its way through the mesh
_SAMPLE_STEP, _DRIVE_ANGLES, _CORNER_POSITIONS = 0.2, 24, 49
# corners that pass farther away than this, in modules, set no drive angle of interest
_CORNER_REACH = 0.05
# least distances are found to this part of the module
_ACCURACY = 1e-12
# closed form and search are compared below this part of the module
_COMPARED = 0.02


@dataclass(frozen=True, slots=True)
class ContactPlace:
    """Where the gap is ``gap`` mm: at the first gear's rotation ``drive_angle`` (rad), at ``point`` (mm).

    The point lies on the second gear, or on the first where its corner is the nearest; origin at the first
    gear's axis, line of centres along +x. ``labels`` name the parts of the outlines of the first and second gear.
    """

    gap: float
    drive_angle: float
    point: complex
    labels: tuple[Label, Label]


@dataclass(frozen=True, slots=True)
class PairContact:
    """What a mesh cycle showed; lengths in mm, angles in rad.

    OVERLAP: a gap below -tolerance at some drive angle. CONTACT: no overlap, and on one side of the teeth at least
    a gap within +-tolerance at every drive angle, so that the drive is never interrupted. CLEAR: otherwise, with
    ``touches`` telling whether there is contact at some drive angles. UNDECIDED: the search missed what the closed form
    for two involutes finds, or a number is not finite.

    ``side_gaps`` are the gap curves at the lower and the upper sides of the first gear's teeth, ``gaps`` the
    lesser of both.
    """

    verdict: Verdict
    tolerance: float
    drive_angles: tuple[float, ...]
    gaps: tuple[float, ...]
    side_gaps: tuple[tuple[float, ...], tuple[float, ...]]
    worst: ContactPlace
    greatest_gap: float

    @property
    def touches(self) -> bool:
        """Whether the gears touch at some drive angle without overlap."""
        return self.verdict is Verdict.CONTACT or (self.verdict is Verdict.CLEAR and self.worst.gap <= self.tolerance)


def searched(mesh: MeshSearch, allowed: float) -> PairContact:
    """The exact gap of a mesh over one pitch of the first gear; ``allowed``: |gap| in mm that is contact."""
    angles = mesh.drive_angles()
    found = mesh.gaps(angles)
    for _ in range(2):
        if _decided(found.gap, allowed):
            break
        extra = _around_the_least(angles, found.gap.min(axis=1), mesh.pitches[0])
        angles, found = _merged(angles, found, extra, mesh.gaps(extra))
    finite = np.isfinite(found.gap)
    closed = mesh.closed_form(angles)
    missed = (np.abs(closed) < _COMPARED * mesh.module) & (closed < found.gap - allowed)
    gaps = found.gap.min(axis=1)
    return PairContact(
        _verdict(found.gap, allowed) if finite.all() and not missed.any() else Verdict.UNDECIDED,
        allowed,
        tuple(angles.tolist()),
        tuple(gaps.tolist()),
        (tuple(found.gap[:, 0].tolist()), tuple(found.gap[:, 1].tolist())),
        mesh.place(angles, found),
        float(gaps.max()),
    )


def _decided(gap: Real, allowed: float) -> bool:
    return bool(np.all(np.abs(gap) <= allowed)) or not np.all(np.isfinite(gap))


def _verdict(gap: Real, allowed: float) -> Verdict:
    if gap.min() < -allowed:
        return Verdict.OVERLAP
    return Verdict.CONTACT if gap.max(axis=0).min() <= allowed else Verdict.CLEAR


class _Gaps(NamedTuple):
    """Least gap per drive angle and side (n, 2), the point it was found at, turned back with the first gear, and
    the indices of both curves."""

    gap: Real
    point: Complex
    first_index: Indices
    second_index: Indices

    def keep(self, group: Indices, distance: Real, point: Complex, first: Indices, second: int | Indices) -> None:
        """Take the least candidate of each group, 2 * drive angle + side, where it is less than what is held."""
        order = np.lexsort((distance, group))
        chosen = order[np.append(True, np.diff(group[order]) > 0)] if order.size else order
        chosen = chosen[distance[chosen] < self.gap.ravel()[group[chosen]]]
        at = group[chosen]
        values = distance, point, first, np.broadcast_to(second, distance.shape)
        for table, value in zip(self, values, strict=True):
            table.reshape(-1)[at] = value[chosen]


class _Lane(NamedTuple):
    """Sampled pieces: one row for each placed copy of one curve of the second body's half pitch."""

    curve: int
    parameters: Real
    angle: Indices
    turn: Complex
    shift: Complex
    mirrored: Indices
    values: Real
    slopes: Real
    lengths: Real

    @property
    def group(self) -> Indices:
        return 2 * self.angle + self.mirrored


class MeshSearch:
    """Both half-pitch outlines and the motion. Subclasses tell what the second body is.

    ``pitches``: the first gear's in rad, the second body's in the unit of its own motion (rad, or mm for a rack);
    ``rate``: that motion over the first gear's rotation; ``radii``: root and tip radius of the first gear;
    ``first_teeth`` and ``second_teeth``: copies that are looked at on either side of the line of centres.
    """

    def __init__(
        self,
        outlines: tuple[Boundary, Boundary],
        segments: tuple[tuple[Segment, ...], tuple[Segment, ...]],
        module: float,
        radii: tuple[float, float],
        pitches: tuple[float, float],
        rate: float,
    ) -> None:
        self.outlines, self.first_segments, self.segments = outlines, *segments
        self.module, self.radii, self.pitches, self.rate = module, radii, pitches, rate
        self.samples = [sampled(s.curve, _SAMPLE_STEP * module) for s in self.segments]
        self.first_teeth, self.second_teeth = self.teeth_in_reach()

    def teeth_in_reach(self) -> tuple[int, int]:
        """Teeth of both bodies on either side of the line of centres that are looked at."""
        raise NotImplementedError

    def second_position(self, drive: Real) -> Real:
        """The second body's rotation (rad) or displacement (mm) for each drive angle."""
        raise NotImplementedError

    def facing_copy(self, position: Real) -> Real:
        """Number of the second body's tooth or space that is nearest to the line of centres."""
        raise NotImplementedError

    def placing(self, position: Real, copy: Real) -> tuple[Complex, Complex]:
        """Turn and shift that bring a copy of the half-pitch outline into the fixed frame."""
        raise NotImplementedError

    def to_fixed(self, points: Complex, drive: Real) -> tuple[Complex, Complex]:
        """Points of the second body in the fixed frame, and their rates by the drive angle."""
        raise NotImplementedError

    def to_second(self, points: Complex, drive: Real) -> tuple[Complex, Complex]:
        """Points that turn with the first gear, given in its frame, in the second body's; and their rates there."""
        raise NotImplementedError

    def second_folded(self, points: Complex, vectors: Complex) -> tuple[Complex, Complex]:
        """Points of the second body's frame, and directions, carried into its half pitch."""
        return folded(points, vectors, self.pitches[1])

    def corner_window(self, which: int, corners: Complex) -> tuple[Real, float]:
        """Drive angles that bring corners of a body onto the line of centres, and how far around to look, rad."""
        raise NotImplementedError

    def closed_form(self, drive: Real) -> Real:
        """(n, 2) gaps of the main flanks by closed form, mm; inf where none applies."""
        raise NotImplementedError

    def drive_angles(self) -> Real:
        """Even steps through one pitch, the angles at which corners come closest, and those half-way between."""
        pitch = self.pitches[0]
        even = np.arange(_DRIVE_ANGLES) * pitch / _DRIVE_ANGLES
        events = np.sort(np.mod(np.concatenate([self._corner_angles(0), self._corner_angles(1)]), pitch))
        if not events.size:
            return even
        following = np.append(events[1:], events[0] + pitch)
        halves = np.mod((events + following) / 2, pitch)
        angles = np.sort(np.concatenate([even, events, halves]))
        return angles[np.append(True, np.diff(angles) > 1e-9 * pitch)]

    def _corner_angles(self, which: int) -> Real:
        """Drive angles at which a convex corner of a body is closest to the mate's outline, locally."""
        corners = self.outlines[which].convex_corners
        if not corners:
            return np.zeros(0)
        both = np.array([*corners, *np.conj(corners)])
        drive, spread = self.corner_window(which, both)
        if spread == 0:
            return np.zeros(0)
        grid = drive[:, None] + np.linspace(-spread, spread, _CORNER_POSITIONS)
        rows = np.repeat(np.arange(len(both)), _CORNER_POSITIONS)
        _, slope = (a.reshape(grid.shape) for a in self._corner_gap(which, both[rows], grid.ravel()))
        row, k = np.nonzero((slope[:, :-1] < 0) & (slope[:, 1:] >= 0))
        found, least = least_in_brackets(
            lambda t, lanes: self._corner_gap(which, both[row[lanes]], t),
            grid[row, k], grid[row, k + 1], (slope[row, k], slope[row, k + 1]), _ACCURACY * self.module,
        )  # fmt: skip
        return found[least < _CORNER_REACH * self.module]

    def _corner_gap(self, which: int, corner: Complex, drive: Real) -> tuple[Real, Real]:
        """Distance of moving corners of one body from the other's outline and its rate, mm and mm/rad."""
        if which:
            points, rates = self.to_fixed(corner, drive)
            back = np.exp(-1j * drive)
            points, rates = folded(back * points, back * (rates - 1j * points), self.pitches[0])
        else:
            points, rates = self.second_folded(*self.to_second(corner, drive))
        feet = self.outlines[1 - which].feet(points)
        return feet.distance, (np.conj(feet.normal) * rates).real

    def gaps(self, drive: Real) -> _Gaps:
        """Least gap at each drive angle (n,) and side."""
        shape = len(drive), 2
        lanes, best = self._lanes(drive), np.full(2 * len(drive), np.inf)
        for lane in lanes:
            np.minimum.at(best, lane.group, lane.values.min(axis=1, initial=np.inf))
        result = _Gaps(np.full(shape, np.inf), np.zeros(shape, complex), np.zeros(shape, int), np.zeros(shape, int))
        for lane in lanes:
            self._refine(lane, best, drive, result)
        self._first_corners(drive, result)
        return result

    def _lanes(self, drive: Real) -> list[_Lane]:
        """Copies of the second body's curves that may be nearest, with distances at their samples."""
        position = self.second_position(drive)
        copies = self.facing_copy(position)[:, None] + np.arange(-self.second_teeth, self.second_teeth + 1)
        turn, shift = self.placing(position[:, None], copies)
        back = np.exp(-1j * drive)
        radii = [np.abs(shift[:, :, None, None] + turn[:, :, None, None] * _both_sides(s.points)) for s in self.samples]
        # the outline lies between root and tip circle: what is farther out than this cannot hold the least
        root = self.radii[0]
        closest = np.maximum(np.min([r.min(axis=(1, 3)) for r in radii], axis=0), root)
        room = self.radii[1] - root
        pieces = []
        for number, (sample, radius) in enumerate(zip(self.samples, radii, strict=True)):
            margin = room + float(sample.lengths.max())
            angle, tooth, mirrored = np.nonzero(radius.min(axis=3) <= (closest + margin)[:, None])
            pieces.append(
                (number, angle, turn[angle, tooth] * back[angle], shift[angle, tooth] * back[angle], mirrored)
            )
        return self._measured(pieces)

    def _measured(self, pieces: list[tuple[int, Indices, Complex, Complex, Indices]]) -> list[_Lane]:
        """Distances and slopes at all samples of all pieces, in one go."""
        points, rates = [], []
        for number, angle, turn, shift, mirrored in pieces:
            t = np.tile(self.samples[number].parameters, len(angle))
            rows = np.repeat(np.arange(len(angle)), len(self.samples[number].parameters))
            p, v = self._in_first(*self._placed(number, t, turn[rows], shift[rows], mirrored[rows]))
            points.append(p)
            rates.append(v)
        p, v = np.concatenate(points), np.concatenate(rates)
        feet = self.outlines[0].feet(p)
        slopes = (np.conj(feet.normal) * v).real
        lanes, start = [], 0
        for (number, angle, turn, shift, mirrored), block in zip(pieces, points, strict=True):
            shape = len(angle), len(self.samples[number].parameters)
            part = slice(start, start + len(block))
            start += len(block)
            values, slope = feet.distance[part].reshape(shape), slopes[part].reshape(shape)
            sample = self.samples[number]
            lanes.append(_Lane(number, sample.parameters, angle, turn, shift, mirrored, values, slope, sample.lengths))
        return lanes

    def _placed(
        self, number: int, t: Real, turn: Complex, shift: Complex, mirrored: Indices
    ) -> tuple[Complex, Complex]:
        """Points and derivatives of copies of a curve of the second body in the first gear's frame."""
        curve = self.segments[number].curve
        points, rates = curve.point(t), curve.derivative(t)
        points, rates = np.where(mirrored, np.conj(points), points), np.where(mirrored, np.conj(rates), rates)
        return shift + turn * points, turn * rates

    def _in_first(self, points: Complex, rates: Complex) -> tuple[Complex, Complex]:
        return folded(points, rates, self.pitches[0])

    def _refine(self, lane: _Lane, best: Real, drive: Real, result: _Gaps) -> None:
        """The least sample of each copy of one curve, and the minima between samples that may be less than ``best``."""
        values, slopes, t = lane.values, lane.slopes, lane.parameters
        limit = best[lane.group][:, None]
        row, k = np.nonzero(
            promising(values[:, :-1], values[:, 1:], slopes[:, :-1], slopes[:, 1:], lane.lengths, limit)
        )

        def placed(at: Real, r: Indices) -> tuple[Complex, Complex]:
            return self._placed(lane.curve, at, lane.turn[r], lane.shift[r], lane.mirrored[r])

        def evaluate(at: Real, lanes: Indices) -> tuple[Real, Real]:
            p, v = self._in_first(*placed(at, row[lanes]))
            feet = self.outlines[0].feet(p)
            return feet.distance, (np.conj(feet.normal) * v).real

        ends = slopes[row, k], slopes[row, k + 1]
        where, _ = least_in_brackets(evaluate, t[k], t[k + 1], ends, _ACCURACY * self.module)
        at = np.concatenate([where, t[np.argmin(values, axis=1)]])
        row = np.concatenate([row, np.arange(len(lane.angle))])
        points, rates = placed(at, row)
        feet = self.outlines[0].feet(self._in_first(points, rates)[0])
        result.keep(lane.group[row], feet.distance, points, feet.curve_index, lane.curve)

    def _first_corners(self, drive: Real, result: _Gaps) -> None:
        """The first gear's convex corners against the second body's outline."""
        pitch = self.pitches[0]
        teeth = np.round(-drive / pitch)[:, None] + np.arange(-self.first_teeth, self.first_teeth + 1)
        for corner in self.outlines[0].convex_corners:
            for side, point in enumerate((corner, corner.conjugate())):
                local = (point * np.exp(1j * teeth * pitch)).ravel()
                angle = np.repeat(np.arange(len(drive)), teeth.shape[1])
                relative = self.to_second(local, drive[angle])
                feet = self.outlines[1].feet(self.second_folded(*relative)[0])
                index = np.full(local.shape, _corner_index(self.first_segments, corner))
                result.keep(2 * angle + side, feet.distance, local, index, feet.curve_index)

    def place(self, drive: Real, found: _Gaps) -> ContactPlace:
        """The place of the least gap in the frame of the line of centres."""
        gap = np.where(np.isfinite(found.gap), found.gap, math.inf)
        k, side = divmod(int(np.argmin(gap)), 2)
        labels = (
            self.first_segments[found.first_index[k, side]].label,
            self.segments[found.second_index[k, side]].label,
        )
        at = complex(found.point[k, side]) * cmath.exp(1j * drive[k])
        return ContactPlace(float(found.gap[k, side]), float(drive[k]), at, labels)


def _both_sides(points: Complex) -> Complex:
    return np.stack([points, np.conj(points)])


def gear_outline(side: ToothSide) -> Boundary:
    """Half a pitch of a gear's outline; beyond its ends it goes on as its mirror image."""
    return Boundary(tuple(s.curve for s in side.segments), end_normals=(cmath.exp(-0.5j * side.pitch_angle), 1 + 0j))


def _corner_index(segments: tuple[Segment, ...], corner: complex) -> int:
    """The segment that a corner ends."""
    return int(np.argmin([abs(complex(s.curve.point(s.curve.domain[1])) - corner) for s in segments]))


def _around_the_least(angles: Real, gap: Real, pitch: float) -> Real:
    """Drive angles between the one of the least gap and its neighbours."""
    i = int(np.argmin(gap))
    before = angles[i - 1] - (pitch if i == 0 else 0.0)
    after = angles[(i + 1) % len(angles)] + (pitch if i == len(angles) - 1 else 0.0)
    shares = np.array([0.25, 0.5, 0.75])
    return np.concatenate([before + shares * (angles[i] - before), angles[i] + shares * (after - angles[i])])


def _merged(angles: Real, found: _Gaps, extra: Real, more: _Gaps) -> tuple[Real, _Gaps]:
    together = np.concatenate([angles, extra])
    order = np.argsort(together)
    parts = [np.concatenate([a, b])[order] for a, b in zip(found, more, strict=True)]
    return together[order], _Gaps(*parts)
