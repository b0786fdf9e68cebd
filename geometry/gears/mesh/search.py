"""The search for the least gap of two meshing bodies over one pitch of motion, on their exact outlines.

The gap at a drive angle is the least signed distance of all points of the second body's outline from the first
gear's, and of the first gear's convex corners from the second's: flank on flank, tip corners on flanks and fillets,
tip on root. Teeth near the line of centres are measured first, others as they matter. Each drive angle has two
groups, 2 k + side: 0 at the lower sides of the first gear's teeth, 1 at the upper ones. A gear is symmetric about
every tooth and space, so the outline point nearest to any point lies in the point's own half pitch: distances cost the
same for 10 and for 10 000 teeth. What the second body is (external gear, ring, rack) and how it moves is told by the
subclasses of ``MeshSearch``.

Frame: the first gear's axis is the origin, it turns by the drive angle, and the mesh lies towards +x.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from geometry.base.record import Record
from geometry.base.tolerance import CONTACT_TOLERANCE
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.far_teeth import Measured, promising_places
from geometry.gears.mesh.least_gap import Copies, Gaps, LeastGap
from geometry.gears.pairs.face_overlap import is_bridged
from geometry.gears.teeth.ring_tooth import RingSide
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.distance import Boundary, Flags, Indices, Verdict, folded, least_in_brackets
from geometry.plane.profile import Label, Segment

# drive angles in a pitch; positions of a corner on its way through the mesh
_DRIVE_ANGLES, _CORNER_POSITIONS = 24, 49
# corners that pass farther away than this, in modules, set no drive angle of interest
_CORNER_REACH = 0.05
# least distances of passing corners, which set drive angles, are found to this part of the module
_EVENT = 1e-9
# closed form and search are compared below this part of the module
_COMPARED = 0.02
# teeth on either side of the line of centres that are measured at once where there are more than _MOST_NEAR
_NEAR_TEETH, _MOST_NEAR = 2, 4
# parts of the way from the drive angles of the least and of the greatest gap to their neighbours, and how often
_PARTS, _ROUNDS, _LEAST_ROUNDS = 4, 8, 2
# mm that gaps differ by for rounding
_SAME = 1e-11
# far teeth are excluded by gaps that are known to this part of the module
_ROUGH = 5e-4


class ContactPlace(Record):
    """Where the gap is ``gap`` mm: at the first gear's rotation ``drive_angle`` (rad), at ``point`` (mm).

    The point lies on the second gear, or on the first where its corner is the nearest; origin at the first
    gear's axis, line of centres along +x. ``labels`` name the parts of the outlines of the first and second gear.
    """

    gap: float
    drive_angle: float
    point: complex
    labels: tuple[Label, Label]


class PairContact(Record):
    """What a mesh cycle showed; lengths in mm, angles in rad.

    OVERLAP: a gap below -tolerance at some drive angle. CONTACT: no overlap, and on one side of the teeth at least
    a gap within +-tolerance at every drive angle, so that the drive is never interrupted; of helical teeth somewhere
    along their face. CLEAR: otherwise, with ``touches`` telling whether there is contact at some drive angles.
    UNDECIDED: the search missed what the closed form for two involutes finds, or a number is not finite.

    Gaps are at right angles to the flanks, of helical teeth too. ``side_gaps`` are the gap curves at the lower and the
    upper sides of the first gear's teeth, ``gaps`` the lesser of both.
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


def _bridged(mesh: MeshSearch, angles: Real, sides: Real, allowed: float, overlap_ratio: float) -> bool:
    """Whether one side of helical teeth is in contact somewhere along the face at every drive angle."""

    def touches(side: int) -> Callable[[Real], Flags]:
        return lambda more: np.abs(least_gaps(mesh, more).gap.reshape(-1, 2)[:, side]) <= allowed

    pitch = mesh.pitches[0]
    flags = np.abs(sides) <= allowed
    return any(is_bridged(angles, flags[:, k], pitch, overlap_ratio * pitch, touches(k)) for k in (0, 1))


def _decided(gap: Real, allowed: float) -> bool:
    return bool(np.all(np.abs(gap) <= allowed)) or not np.all(np.isfinite(gap))


def verdict_of(gap: Real, allowed: float, beside: float = math.inf) -> Verdict:
    """The verdict on gaps (n, 2) of both sides at n positions; ``allowed``: |gap| that is contact, mm.

    ``beside``: the least gap of anything else, mm.
    """
    if not np.isfinite(gap).all() or math.isnan(beside):
        return Verdict.UNDECIDED
    if min(gap.min(), beside) < -allowed:
        return Verdict.OVERLAP
    return Verdict.CONTACT if gap.max(axis=0).min() <= allowed else Verdict.CLEAR


def told_contact(verdict: Verdict, allowed: float, drive: Real, gaps: Real, worst: ContactPlace) -> PairContact:
    """A verdict with the gaps (n, 2), mm, of both sides at n drive angles."""
    least, (lower, upper) = gaps.min(axis=1), (tuple(side) for side in gaps.T.tolist())
    angles = tuple(drive.tolist())
    return PairContact(verdict, allowed, angles, tuple(least.tolist()), (lower, upper), worst, float(least.max()))


def first_least(gaps: Real) -> int:
    """Where the least of the flattened gaps, mm, is: the first of those that differ by rounding alone.

    Teeth that touch all the way have the same gap at every drive angle, and every processor rounds otherwise.
    """
    found = np.flatnonzero(gaps <= gaps.min() + _SAME)
    return int(found[0]) if found.size else int(gaps.argmin())


def flanks_contact(gaps: Real, drive: Real, at: complex, allowed: float) -> PairContact:
    """The verdict on gaps (2, n), mm, of lower and upper flanks at n drive angles; ``at``: where they are told."""
    least = gaps.min(axis=0)
    worst = ContactPlace(float(least.min()), float(drive[first_least(least)]), at, (Label.FLANK, Label.FLANK))
    return told_contact(verdict_of(gaps.T, allowed), allowed, drive, gaps.T, worst)


class MeshSearch:
    """Both half-pitch outlines and the motion. Subclasses tell what the second body is.

    ``pitches``: the first gear's in rad, the second body's in the unit of its own motion (rad, or mm for a rack);
    ``rate``: that motion over the first gear's rotation; ``start``: where it stands at drive angle 0; ``facing``: where
    the line of centres is for it. ``radii``: root and tip radius of the first gear, mm. ``arm``: how far flanks that
    touch move along their normal for one unit of the second body's motion, mm; ``closing``: sign of that motion that
    closes the gap at the upper flanks of the first gear's teeth; ``reach``: mm that a point of the second body moves at
    most for one unit; ``relative_turning``: how fast the bodies turn against each other, rad per rad of the first.
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
        start: float,
        facing: float,
        arm: float,
        closing: int,
        reach: float,
        relative_turning: float,
    ) -> None:
        self.outlines, self.first_segments, self.segments = outlines, *segments
        self.module, self.radii, self.pitches, self.rate = module, radii, pitches, rate
        self.start, self.facing, self.arm, self.closing, self.reach = start, facing, arm, closing, reach
        self.relative_turning = relative_turning
        self.half = LeastGap(outlines[0], pitches[0], self.segments, module)
        self.first_teeth, self.second_teeth = self.teeth_in_reach()

    def contact(
        self, tolerance: float | None = None, overlap_ratio: float = 0.0, normal_share: float = 1.0
    ) -> PairContact:
        """The exact gap over one pitch of the first gear; ``tolerance``: |gap| in mm that is contact, 1e-8 module.

        Of helical teeth, whose transverse section the mesh is: ``overlap_ratio``, pitches that the face covers, and
        ``normal_share``, cos(beta_b), of a gap of flanks in the section that is left at right angles to them.
        """
        allowed = CONTACT_TOLERANCE * self.module if tolerance is None else tolerance
        angles = self.drive_angles()
        far = FarTeeth.unknown()
        found = least_gaps(self, angles, far=far)
        for k in range(_ROUNDS):
            if _decided(found.gap, allowed):
                break
            gaps = found.gap.reshape(-1, 2).min(axis=1)
            places = [first_least(gaps)] if k < _LEAST_ROUNDS else []
            # where teeth part that others do not follow yet, no angle of before need stand
            top = int(gaps.argmax())
            parted = gaps[top] - min(gaps[top - 1], gaps[(top + 1) % len(gaps)]) > allowed
            places += [top] if parted and gaps.min() >= -allowed else []
            if not places:
                break
            extra = np.unique(np.concatenate([between(angles, at, self.pitches[0], _PARTS) for at in places]))
            angles, found = _merged(angles, found, extra, least_gaps(self, extra, far=far))
        sides = found.gap.reshape(-1, 2)
        closed = self.closed_form(angles)
        missed = (np.abs(closed) < _COMPARED * self.module) & (closed < sides - allowed)
        verdict = Verdict.UNDECIDED if missed.any() else verdict_of(sides, allowed)
        if verdict is Verdict.CLEAR and overlap_ratio and _bridged(self, angles, sides, allowed, overlap_ratio):
            verdict = Verdict.CONTACT
        if normal_share < 1:
            sides = self._in_space(found, closed, normal_share)
        return told_contact(verdict, allowed, angles, sides, self.place(angles, found._replace(gap=sides.ravel())))

    def _in_space(self, found: Gaps, closed: Real, normal_share: float) -> Real:
        """(n, 2) gaps of helical teeth, mm: helicoids lean out of the section by the arm of their normals.

        Of flanks by tan(beta_b); these may be nearest where in the section something else is.
        """
        lean = math.sqrt(1 / normal_share**2 - 1) * found.arm / (self.arm * abs(self.rate))
        flanks = np.where(closed > 0, normal_share * closed, np.inf)
        return np.minimum((found.gap / np.hypot(1.0, lean)).reshape(-1, 2), flanks)

    def teeth_in_reach(self) -> tuple[int, int]:
        """Teeth of both bodies on either side of the line of centres that are looked at."""
        raise NotImplementedError

    def second_position(self, drive: Real) -> Real:
        """The second body's rotation (rad) or displacement (mm) for each drive angle."""
        return self.start + self.rate * drive

    def facing_copy(self, position: Real) -> Real:
        """Number of the second body's tooth or space that is nearest to the line of centres."""
        return np.round((self.facing - position) / self.pitches[1])

    def placing(self, position: Real, copy: Real) -> tuple[Complex, Complex]:
        """Turn and shift that bring a copy of the half-pitch outline into the fixed frame."""
        raise NotImplementedError

    def to_fixed(self, points: Complex, drive: Real) -> tuple[Complex, Complex]:
        """Points of the second body in the fixed frame, and their rates by the drive angle."""
        raise NotImplementedError

    def to_second(self, points: Complex, drive: Real, turn: Real | float = 0.0) -> tuple[Complex, Complex]:
        """Points that turn with the first gear, given in its frame, in the second body's; and their rates there.

        ``turn``: what the second body stands beyond ``second_position``, rad or mm.
        """
        raise NotImplementedError

    def second_folded(self, points: Complex, vectors: Complex) -> tuple[Complex, Complex]:
        """Points of the second body's frame, and directions, carried into its half pitch."""
        return folded(points, vectors, self.pitches[1])

    def corner_window(self, which: int, corners: Complex) -> tuple[Real, float]:
        """Drive angles that bring corners of a body onto the line of centres, and how far around to look, rad."""
        raise NotImplementedError

    def closed_form(self, drive: Real, shift: float = 0.0) -> Real:
        """(n, 2) gaps of the main flanks by closed form, mm; inf where none applies."""
        raise NotImplementedError

    def drive_angles(self) -> Real:
        """Even steps through one pitch, the angles at which corners and flank ends come closest, and those between."""
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
        """Drive angles at which a convex corner or a flank's end at a round tip is closest to the mate, locally."""
        corners = self.outlines[which].convex_corners
        # with a round tip contact ends without a corner
        ends = _round_flank_ends(self.segments if which else self.first_segments)
        corners += tuple(p for p in ends if all(abs(p - c) > _EVENT * self.module for c in corners))
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
            grid[row, k], grid[row, k + 1], (slope[row, k], slope[row, k + 1]), _EVENT * self.module,
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

    def place(self, drive: Real, found: Gaps) -> ContactPlace:
        """The place of the least gap in the frame of the line of centres."""
        gap = np.where(np.isfinite(found.gap), found.gap, math.inf)
        group = first_least(gap)
        labels = self.first_segments[found.first_index[group]].label, self.segments[found.second_index[group]].label
        angle = float(drive[group // 2])
        return ContactPlace(float(gap.min()), angle, complex(found.point[group]) * cmath.exp(1j * angle), labels)


class FarTeeth(NamedTuple):
    """What earlier searches of a mesh, at one turn of its second body, have learned of far teeth."""

    second: Measured
    corners: Measured

    @classmethod
    def unknown(cls) -> FarTeeth:
        """Nothing yet."""
        return cls(Measured(), Measured())


def least_gaps(mesh: MeshSearch, drive: Real, turn: Real | float = 0.0, far: FarTeeth | None = None) -> Gaps:
    """Least gaps at drive angles (n,), rad, for both sides: groups 2 k + side.

    ``turn``: the second body's motion beyond ``mesh.second_position``, rad or mm: (n,) or one number for all.
    ``far``: what is known of far teeth at that turn, and learns more.
    """
    offset = np.broadcast_to(np.asarray(turn, dtype=float), drive.shape)
    found, far = Gaps.unknown(2 * len(drive)), far or FarTeeth.unknown()
    _Second(mesh, drive, offset, mesh.second_position(drive) + offset, found, far.second).search()
    if mesh.outlines[0].convex_corners:
        _Corners(mesh, drive, offset, found, far.corners).search()
    return found


def _near(teeth: int) -> int:
    return teeth if teeth <= _MOST_NEAR else _NEAR_TEETH


def _slack(mesh: MeshSearch, offset: Real) -> float:
    """mm that teeth at one drive angle stand off the way that they take at another."""
    return float(np.ptp(offset)) * mesh.reach


class _Second(Record):
    """The second body's teeth at the drive angles, measured on the first gear's outline."""

    mesh: MeshSearch
    drive: Real
    offset: Real
    position: Real
    found: Gaps
    known: Measured

    def search(self) -> None:
        """Teeth near the line of centres first: they tell how little a far one must have to matter."""
        mesh, half = self.mesh, self.mesh.half
        number = np.arange(-mesh.second_teeth, mesh.second_teeth + 1)
        inner = np.abs(number) <= _near(mesh.second_teeth)
        angle, copy = self._teeth(number[inner])
        copies = self._copies(np.repeat(angle, 2), np.repeat(copy, 2), np.tile([0, 1], len(angle)))
        radii = half.radii(copies)
        # the outline lies between root and tip circle: what is farther out than this cannot hold the least
        closest = np.full(len(self.drive), mesh.radii[0])
        nearest = np.min(radii, axis=0).reshape(len(self.drive), -1).min(axis=1)
        closest = np.maximum(closest, nearest)
        limit = closest + (mesh.radii[1] - mesh.radii[0]) + half.longest
        half.search(copies, [r <= limit[copies.group // 2] for r in radii], self.found)
        if not inner.all():
            self._far(*self._teeth(number[~inner]), closest, limit)

    def _teeth(self, number: Indices) -> tuple[Indices, Real]:
        """Index of the drive angle and number of the tooth for each tooth that many places from the facing one."""
        facing = self.mesh.facing_copy(self.position)
        return np.repeat(np.arange(len(self.drive)), len(number)), (facing[:, None] + number).ravel()

    def _far(self, angle: Indices, copy: Real, closest: Real, limit: Real) -> None:
        mesh, half = self.mesh, self.mesh.half
        way = self.drive[angle] + copy * mesh.pitches[1] / mesh.rate
        order = np.argsort(way, kind="stable")
        way, angle, copy = way[order], angle[order], copy[order]

        def placed(rows: Indices, sides: Indices) -> tuple[Copies, list[Flags]]:
            own = self._copies(angle[rows], copy[rows], sides)
            return own, [r <= limit[angle[rows]] for r in half.radii(own)]

        def measure(rows: Indices, sides: Indices) -> Real:
            (own, within), single = placed(rows, sides), Gaps.unknown(len(rows))
            half.search(own._replace(group=np.arange(len(rows))), within, single, _ROUGH)
            return np.minimum(single.gap - _ROUGH * mesh.module, closest[angle[rows]] - mesh.radii[0])

        least = self.found.gap.reshape(-1, 2)[angle]
        slack = _slack(mesh, self.offset)
        rows, sides = promising_places(way, self._speed, mesh.module, measure, least, self.known, slack)
        half.search(*placed(rows, sides), self.found)

    def _copies(self, angle: Indices, copy: Real, side: Indices) -> Copies:
        """Halves of the second body's teeth in the first gear's frame."""
        turn, shift = self.mesh.placing(self.position[angle], copy)
        back = np.exp(-1j * self.drive[angle])
        return Copies(2 * angle + side, turn * back, shift * back, side == 1)

    def _speed(self, way: Real) -> Real:
        """No point of a tooth at ``way`` moves faster against the first gear, mm per rad of the drive."""
        points = np.concatenate([s.points for s in self.mesh.half.samples])
        middle = complex(points.real.mean())
        centre, rate = self.mesh.to_fixed(np.full(way.shape, middle), way)
        return np.abs(rate - 1j * centre) + self.mesh.relative_turning * float(np.abs(points - middle).max())


class _Corners(Record):
    """The first gear's convex corners at the drive angles, measured on the second body's outline."""

    mesh: MeshSearch
    drive: Real
    offset: Real
    found: Gaps
    known: Measured

    @property
    def _points(self) -> Complex:
        """Corners and their mirror images in turn: the sides of a tooth."""
        return np.array([p for c in self.mesh.outlines[0].convex_corners for p in (c, c.conjugate())])

    def search(self) -> None:
        """All corners near the line of centres, and those of the rest that may matter."""
        mesh, columns = self.mesh, len(self._points)
        facing = np.round(-self.drive / mesh.pitches[0])
        number = np.arange(-mesh.first_teeth, mesh.first_teeth + 1)
        inner = np.abs(number) <= _near(mesh.first_teeth)
        for chosen in (inner, ~inner):
            angle = np.repeat(np.arange(len(self.drive)), int(chosen.sum()))
            tooth = (facing[:, None] + number[chosen]).ravel()
            if chosen is inner:
                which = np.tile(np.arange(columns), len(angle))
                self._measured(np.repeat(angle, columns), np.repeat(tooth, columns), which)
            elif angle.size:
                self._far(angle, tooth)

    def _far(self, angle: Indices, tooth: Real) -> None:
        way = self.drive[angle] + tooth * self.mesh.pitches[0]
        order = np.argsort(way, kind="stable")
        way, angle, tooth = way[order], angle[order], tooth[order]
        points = self._points
        least = self.found.gap[2 * angle[:, None] + np.arange(len(points)) % 2]
        slack = _slack(self.mesh, self.offset)

        def speed(at: Real) -> Real:
            return np.asarray(
                np.max([np.abs(self.mesh.to_second(np.full(at.shape, p), at)[1]) for p in points], axis=0)
            )

        def measure(rows: Indices, columns: Indices) -> Real:
            return self._measured(angle[rows], tooth[rows], columns)

        measure(*promising_places(way, speed, self.mesh.module, measure, least, self.known, slack))

    def _measured(self, angle: Indices, tooth: Real, column: Indices) -> Real:
        """Gaps of corners, mm, entered into what is found."""
        mesh = self.mesh
        local = self._points[column] * np.exp(1j * tooth * mesh.pitches[0])
        at, off = self.drive[angle], self.offset[angle]
        point = mesh.to_second(local, at, off)[0]
        # how the first gear's turning moves it
        inner, moved = mesh.second_folded(point, mesh.to_second((1 + 1j) * local, at, off)[0] - point)
        feet = mesh.outlines[1].feet(inner)
        arm = np.abs((np.conj(feet.normal) * moved).real)
        segment = np.repeat([self._segment(c) for c in mesh.outlines[0].convex_corners], 2)
        self.found.keep(2 * angle + column % 2, feet.distance, arm, local, segment[column], feet.curve_index)
        return feet.distance

    def _segment(self, corner: complex) -> int:
        """The segment of the first gear that a corner ends."""
        ends = [abs(complex(s.curve.point(s.curve.domain[1])) - corner) for s in self.mesh.first_segments]
        return int(np.argmin(ends))


def _round_flank_ends(segments: tuple[Segment, ...]) -> tuple[complex, ...]:
    """Where flank and tip break meet, mm, from whichever side the outline comes."""
    found = []
    for one, two in pairwise(segments):
        if Label.TIP_BREAK in (one.label, two.label) and {one.label, two.label} & {Label.FLANK, Label.RELIEF}:
            found.append(complex(two.curve.point(two.curve.domain[0])))
    return tuple(found)


def gear_outline(side: ToothSide | RingSide) -> Boundary:
    """Half a pitch of a gear's outline or of a ring's hole; beyond its ends it goes on as its mirror image."""
    ends = cmath.exp(-0.5j * side.pitch_angle), 1 + 0j
    ends = (-ends[1], -ends[0]) if isinstance(side, RingSide) else ends
    return Boundary(tuple(s.curve for s in side.segments), end_normals=ends)


def between(angles: Real, index: int, pitch: float, parts: int) -> Real:
    """Drive angles that part the way from one to either of its neighbours within a pitch, which may lie beyond it."""
    here = angles[index]
    before = angles[index - 1] - (pitch if index == 0 else 0.0)
    after = angles[(index + 1) % len(angles)] + (pitch if index == len(angles) - 1 else 0.0)
    shares = np.arange(1, parts) / parts
    return np.concatenate([before + shares * (here - before), here + shares * (after - here)])


def _merged(angles: Real, found: Gaps, extra: Real, more: Gaps) -> tuple[Real, Gaps]:
    together = np.concatenate([angles, extra])
    order = np.argsort(together)
    groups = np.stack([2 * order, 2 * order + 1], axis=1).ravel()
    return together[order], Gaps(*(np.concatenate([a, b])[groups] for a, b in zip(found, more, strict=True)))
