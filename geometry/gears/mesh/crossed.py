"""Contact of two helical gears on crossed axes over one pitch: flanks by closed form, whole teeth by search.

Places of one gear's teeth, flank, fillet, lands and both ends of the face, are held against the sections of the other
one, each way round; the least distances are narrowed. Upper sides are lower sides after half a turn about the line of
centres.
"""

from __future__ import annotations

import math
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from geometry.base.record import replace
from geometry.base.tolerance import CONTACT_TOLERANCE
from geometry.curves.curve import Complex, Real
from geometry.curves.involute import Involute
from geometry.gears.mesh.search import ContactPlace, PairContact, first_least, gear_outline, told_contact, verdict_of
from geometry.gears.pairs.crossed import CrossedPair
from geometry.plane.distance import Boundary, Feet, Flags, Indices, Verdict, folded
from geometry.plane.profile import Label

# drive angles in a pitch; heights, and places along a curve, of the first look; how often the grid about the least is
# halved; its steps (2, k), and the parabola of least squares through it
_DRIVE_ANGLES, _HEIGHTS, _PLACES, _ROUNDS = 24, 33, 9, 30
_GRID = np.stack([a.ravel() for a in np.meshgrid(*[np.linspace(-1.0, 1.0, 5)] * 2)])
_PARABOLA = np.linalg.pinv(np.stack([np.ones(25), *_GRID, _GRID[0] ** 2, _GRID[0] * _GRID[1], _GRID[1] ** 2], axis=1))
# steps to its bottom: at most, and those that are few enough to halve them
_FAR, _NEAR = 4.0, 0.99
# a grid so much smaller than the first has found the least
_ENOUGH = 2.0**-10
# of the module: what may be the least is narrowed; closed form and search are compared, to so much
_HOPEFUL, _COMPARED, _FOUND = 0.3, 0.02, 1e-3


class _Found(NamedTuple):
    """Least gaps (n,), mm; of the least of all its point about the gear's axis and its label on gear and mate."""

    gaps: Real
    point: complex
    labels: tuple[Label, Label]


class _Places(NamedTuple):
    """Places of the mate's teeth (n,): drive, curve and share of it, height, turns of mate and gear, and their gaps."""

    drive: Indices
    curve: Indices
    share: Real
    height: Real
    turned: Real
    own: Real
    gap: Real

    def take(self, rows: Indices | Flags) -> _Places:
        """Some of them."""
        return _Places(*map(itemgetter(rows), self))


class _Teeth:
    """Lower sides of a gear's mate's teeth beside its own sections; +x of its frame leads to the mate's axis.

    ``own``: the number of the gear that has the sections; ``way`` -1: both after half a turn about the line of centres.
    """

    def __init__(self, pair: CrossedPair, own: int, way: int) -> None:
        self.gear, self.mate = pair.gears[own], pair.gears[1 - own]
        self.side, self.outline = pair.sides[1 - own], gear_outline(pair.sides[own])
        self.labels = [segment.label for segment in pair.sides[own].segments]
        # the flank alone: beside a tip's edge the tip may be nearer in the section and is not in space; on beyond the
        # edge, since of the places within a wedge the nearer plane decides
        self.flank_at = self.labels.index(Label.FLANK)
        flank = self.outline.curves[self.flank_at]
        assert isinstance(flank, Involute)
        self.end_roll = flank.end_roll
        self.flank = Boundary((replace(flank, end_roll=flank.end_roll + self.gear.pitch_angle),))
        self.twist, self.mate_twist = pair.twists[own], pair.twists[1 - own]
        self.distance, angle = pair.working_centre_distance, pair.shaft_angle
        self.sine, self.cosine = math.sin(angle), math.cos(angle)
        ends = [(-f, b - f) if way > 0 else (f - b, f) for f, b in zip(pair.feet, pair.face_widths, strict=True)]
        self.face, (low, high) = ends[own], ends[1 - own]
        # where both tip cylinders are
        reach, beside = (self._lens(a.tip_radius, b.tip_radius) for a, b in (pair.gears, pair.gears[::-1]))
        reach, beside = (reach, beside) if own == 0 else (beside, reach)
        far = (reach + beside * abs(self.cosine)) / abs(self.sine)
        self.heights = np.linspace(max(low, -far), min(high, far), _HEIGHTS)
        turn = math.asin(min(beside / self.mate.tip_radius, 1.0)) / self.mate.pitch_angle
        self.teeth = np.arange(-math.ceil(turn + 0.5), math.ceil(turn + 0.5) + 1)

    def _lens(self, radius: float, mate: float) -> float:
        """Half the width of a tip cylinder where the mate's reaches into it, mm."""
        inner = min(max(self.distance - mate, 0.0), radius)
        return math.sqrt((radius - inner) * (radius + inner))

    def seen(self, at: _Places) -> tuple[Real, Complex, Real]:
        """How far places are beyond the gear's tip cylinder, mm, inf off its face; where; how its section is turned."""
        points = np.empty(at.share.shape, complex)
        for number, segment in enumerate(self.side.segments):
            mine = at.curve == number
            low, high = segment.curve.domain
            points[mine] = segment.curve.point(low + (high - low) * at.share[mine])
        placed = points * np.exp(1j * (at.turned + self.mate_twist * at.height))
        y = placed.imag * self.cosine + at.height * self.sine
        z = at.height * self.cosine - placed.imag * self.sine
        spoke = self.distance + placed.real + 1j * y
        inside = (z >= self.face[0]) & (z <= self.face[1])
        return np.where(inside, np.abs(spoke) - self.gear.tip_radius, np.inf), spoke, at.own + self.twist * z

    def feet(self, spoke: Complex, turned: Real) -> tuple[Feet, Real]:
        """The nearest of the gear's surfaces in its section, and how much nearer along the screw's normal that is."""
        inner, _ = folded(spoke * np.exp(-1j * turned), spoke, self.gear.pitch_angle)
        feet, flank = self.outline.feet(inner), self.flank.feet(inner)
        share, leaning = (1 / np.hypot(1.0, self.twist * (np.conj(inner) * f.normal).imag) for f in (feet, flank))
        low, high = self.flank.curves[0].domain
        within = np.where(feet.distance < 0, high, self.end_roll)
        nearer = (flank.parameter > low) & (flank.parameter < within) & (flank.distance * feet.distance > 0)
        nearer &= np.abs(flank.distance * leaning) < np.abs(feet.distance * share)
        index = np.where(nearer, self.flank_at, feet.curve_index)
        chosen = (np.where(nearer, a, b) for a, b in ((flank.parameter, feet.parameter), (flank.normal, feet.normal)))
        return Feet(np.where(nearer, flank.distance, feet.distance), index, *chosen), np.where(nearer, leaning, share)

    def measured(self, at: _Places) -> _Places:
        """The same places with their gaps, mm: those well beyond the tip cylinder only by that."""
        gaps, spoke, turned = self.seen(at)
        near = np.flatnonzero(gaps < _HOPEFUL * self.gear.module)
        feet, share = self.feet(spoke[near], turned[near])
        gaps[near] = feet.distance * share
        return at._replace(gap=gaps)

    def least(self, own: Real, turned: Real) -> _Found:
        """At turns (n,) of the gear and of its mate on the line of centres, rad."""
        pitch, count, margin = self.mate.pitch_angle, len(own), _HOPEFUL * self.gear.module
        # the mate sees the mesh at -x
        facing = np.round((math.pi - turned[:, None] - self.mate_twist * self.heights) / pitch)
        turns = turned[:, None, None] + pitch * (facing[:, None] + self.teeth[:, None])
        grid = np.broadcast_arrays(
            np.arange(count)[:, None, None, None, None], np.arange(len(self.side.segments))[:, None, None],
            np.linspace(0.0, 1.0, _PLACES), self.heights[:, None], turns[:, :, None, :, None],
            own[:, None, None, None, None], 0.0,
        )  # fmt: skip
        lane = count * len(self.teeth) * len(self.side.segments)
        places = self.measured(_Places(*(a.ravel() for a in grid)))
        best = places.gap.reshape(lane, -1).argmin(axis=1)
        places = places.take(best + np.arange(lane) * (len(places.gap) // lane))
        size, found = np.ones(lane), np.full(count, np.inf)
        for _ in range(_ROUNDS):
            np.minimum.at(found, places.drive, places.gap)
            kept = (size > _ENOUGH) & (places.gap < found[places.drive] + margin)
            if not kept.any():
                break
            nearer, size[kept] = self._nearer(places.take(kept), size[kept])
            for column, new in zip(places, nearer, strict=True):
                column[kept] = new
            margin /= 2
        np.minimum.at(found, places.drive, places.gap)
        worst = places.take(np.array([first_least(places.gap)]))
        _, spoke, at = self.seen(worst)
        nearest = self.labels[int(self.feet(spoke, at)[0].curve_index[0])]
        return _Found(found, complex(spoke[0]), (nearest, self.side.segments[int(worst.curve[0])].label))

    def _nearer(self, places: _Places, size: Real) -> tuple[_Places, Real]:
        """The least of a grid about each place and at the bottom of the parabola through it; the next grid's size."""
        steps, rows = (1 / (_PLACES - 1), (self.heights[-1] - self.heights[0]) / (_HEIGHTS - 1)), np.arange(len(size))

        def tried(ways: Real) -> _Places:
            """At so many steps (2, n, k) from each place, place by place."""
            count = ways.shape[2]
            share = places.share[:, None] + steps[0] * size[:, None] * ways[0]
            height = places.height[:, None] + steps[1] * size[:, None] * ways[1]
            around = places.take(np.repeat(rows, count))._replace(
                share=np.clip(share, 0.0, 1.0).ravel(),
                height=np.clip(height, self.heights[0], self.heights[-1]).ravel(),
            )
            return self.measured(around)

        around = tried(np.broadcast_to(_GRID[:, None], (2, len(size), _GRID.shape[1])))
        gaps = around.gap.reshape(len(size), -1)
        nearest = around.take(gaps.argmin(axis=1) + rows * gaps.shape[1])
        bottom = tried(_bottom(gaps)[..., None])
        lower = bottom.gap < nearest.gap
        nearest = _Places(*(np.where(lower, a, b) for a, b in zip(bottom, nearest, strict=True)))
        moved = np.maximum(
            np.abs(nearest.share - places.share) / steps[0], np.abs(nearest.height - places.height) / steps[1]
        )
        # along a narrow valley it goes on as it is
        return nearest, np.where(moved > _NEAR * size, size, size / 2)


def _bottom(gaps: Real) -> Real:
    """Steps (2, n) from the middle of grids to the bottoms of the parabolas through their gaps (n, k); 0: none."""
    with np.errstate(invalid="ignore", divide="ignore"):
        _, u, v, uu, uv, vv = _PARABOLA @ gaps.T
        steps = np.stack([uv * v - 2 * vv * u, uv * u - 2 * uu * v]) / (4 * uu * vv - uv**2)
    return np.clip(np.nan_to_num(steps, nan=0.0), -_FAR, _FAR)


def crossed_contact(pair: CrossedPair, phase_off: float = 0.0, tolerance: float | None = None) -> PairContact:
    """Verdict over one pitch; the second is ``phase_off`` rad further round than in the middle of its backlash.

    ``side_gaps``: at the lower and upper sides of the first gear's teeth.
    """
    allowed = CONTACT_TOLERANCE * pair.normal_module if tolerance is None else tolerance
    drive = np.linspace(0.0, pair.first.pitch_angle, _DRIVE_ANGLES, endpoint=False)
    one = drive + pair.twists[0] * pair.feet[0]
    two = np.array([pair.second_rotation(turn) for turn in drive]) + pair.twists[1] * pair.feet[1] + phase_off
    closed = np.stack([_closed_form(pair, one, way, phase_off) for way in (1, -1)])
    sides, worst = [], None
    for way in (1, -1):
        found = [
            _Teeth(pair, 0, way).least(way * one, way * two),
            _Teeth(pair, 1, way).least(way * (two - math.pi), way * (one - math.pi)),
        ]
        sides.append(np.minimum(found[0].gaps, found[1].gaps))
        for number, least in enumerate(found):
            gap = float(least.gaps.min())
            if worst is None or gap < worst.gap:
                # from the second's axis, which looks the other way, and after half a turn: where it is about
                x = least.point if number == 0 else pair.working_centre_distance - least.point.real
                labels = least.labels if number == 0 else least.labels[::-1]
                point = complex(x) if way > 0 else complex(x).conjugate()
                worst = ContactPlace(gap, float(drive[first_least(least.gaps)]), point, labels)
    assert worst is not None
    searched = np.stack(sides)
    gaps = np.minimum(searched, closed)
    missed = (closed < _COMPARED * pair.normal_module) & (closed < searched - _FOUND * pair.normal_module)
    verdict = Verdict.UNDECIDED if missed.any() else verdict_of(gaps.T, allowed)
    return told_contact(verdict, allowed, drive, gaps.T, replace(worst, gap=float(gaps.min())))


def _closed_form(pair: CrossedPair, turned: Real, way: int, phase_off: float) -> Real:
    """Gaps (n,) of the flanks that face each other on one side, mm; inf where none is on its path."""
    action, pitch = pair.action, pair.base_pitch
    reached = action.angles[0] - way * turned + pair.first.base_half_angle - pair.twists[0] * action.touches[0]
    low, high = pair.used(way)
    there = low + np.mod(pair.arms[0] * reached - low, pitch) <= high
    return np.where(there, pair.normal_backlash / 2 + way * pair.arms[1] * phase_off, np.inf)
