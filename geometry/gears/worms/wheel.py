"""The teeth of a worm wheel as its hob leaves them, over heights above the mid plane of its rim.

Frame: the wheel's axis is z, tooth 1 is centred on +x. Across the axis stand, from the middle of a space: the root that
the hob's tip leaves, the fillet of its rounding, the flank of its thread, and the tip: a throat about the worm's axis
within an outer cylinder. The lower side is described; half a turn about the middle of tooth 1
makes the upper one of it. Far from the mid plane a fillet may reach the tip, so that there is no flank, and both sides
may meet below it: the tooth then ends in a ridge.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import cached_property, lru_cache, partial
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.nearest import nearest
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_roots
from geometry.curves.curve import Complex, Flags, Indices, Real
from geometry.curves.line_arc import Line
from geometry.gears.worms.hob import Cut, Hob, Meridian
from geometry.plane.profile import Label, Profile, Segment

# of a search
_Looked = tuple[Real, Real, Indices, Indices]

# radii of the thread, where few heights are looked at too, and angles of its rounding at which a side is looked for
_RADII, _FEW_RADII, _ANGLES, _FIRST_STEP = 257, 97, 129, 1e-7
# of a fillet that cuts a flank: radii from which their crossing is sought, Newton's steps, the step of slopes (mm and
# rad), how near both end at least and when that is enough; up to which depth, of the hob's size, undercut is none, and
# to which so shallow that its crossing lies by the first terms of both curves half as far again as the turning
_CROSSINGS, _NEWTON_STEPS, _SLOPE, _MET, _SURE, _BARELY, _SHALLOW, _CROSSED = 65, 8, 1e-6, 1e-10, 1e-14, 1e-6, 3e-4, 1.5
_ABOUT_IT = np.array([-_SLOPE, 0.0, _SLOPE])[:, None]
# how deep a flank cuts a side that is a fillet before it is seen, part of the pitch; how little of the hob leaves
# none, part of it
_DEEP, _THIN = 1e-2, 1e-5
# how near a flank gets to the tip, and for a search, part of the hob's size
_AT_TIP, _LOOSELY = 1e-8, 1e-10
# shares of each part of both sides between which a ridge is sought
_RIDGE = np.linspace(0.0, 1.0, 65)[:, None]
# shares of a bracket at which a least distance is looked for, and how often: each time a sixteenth is left
_LEAST, _LEAST_TIMES = np.linspace(0.0, 1.0, 33)[:, None], 7
# of the radius at which a thread's form begins, where no spline follows it: from there on it is asked for
_ABOVE = 1.01
# a thread's point that near the plane of its axis is not asked for, part of its radius
_LEAST_SHARE = 1e-9
# a space between two teeth is no shallower, a whole tooth's flank no narrower, modules
_LEAST_DEPTH = 0.04
# heights at which a face is looked at, fewer for trials, some of them for a glance; how well places between them are
# known, those at which a face comes to a point, these for a search, how far two are apart at least, part of the width
_LEVELS, _FEW_LEVELS, _GLANCE, _SETTLED, _CLOSE, _NEARLY, _SAME = 97, 49, 7, 1e-9, 1e-14, 1e-10, 4e-9
# how far beyond the ends of a part the foot of a perpendicular may lie, and how far the contact has to run on beyond
# the tip, as shares of it
BEYOND, _RUNS_ON = 0.02, 0.002
# shares of a part at which it is looked whether it folds, and what a flank's least step is of its mean one: of those
# that are not about to fold it is 0.07 and more
_FOLD, _STILL = np.linspace(0.0, 1.0, 17)[:, None], 2e-2
# shares of a bracket of such an end at which it is looked for
_PARTS = np.linspace(0.0, 1.0, 17)[:, None]
# how far beside an end of undercut it is looked at, and how well that end is known then, part of the width
_BESIDE, _ABOUT = (-1e-2, -1e-3, 1e-3, 1e-2), 1e-5
# of pictures: points of which a few are drawn, and how near their chords are, part of the size
_DRAWN, _SEEN = 33, 2e-4
# the least width that is one, part of the hob's radius; how near to the widest one is found, part of it, and parts of
# one that all but stands
_LEAST_WIDTH, NEAR_WIDTH = 3e-2, 8e-4
_LESS = (0.995, 0.98, 0.9, 0.7, 0.3, 0.1, 0.03)


class NoTooth(Exception):
    """No tooth stands at some height, and by what: a code."""

    def __init__(self, code: str) -> None:
        self.code = code
        super().__init__(code)


class Side(Record, eq=False):
    """Where the parts of a tooth's lower side begin and end at heights (n,).

    ``inner``: radius of the thread where the flank leaves the fillet, ``normal``: of the rounding there, rad;
    ``outer``: radius of the thread at the tip, mm; ``undercut``: the fillet cuts the flank there; ``hurry``: how many
    times as steep fillet and flank are where they begin as where they end; ``all_fillet``: it reaches the tip, the
    flank is that one point.
    """

    heights: Real
    inner: Real
    normal: Real
    outer: Real
    undercut: Flags
    hurry: tuple[Real, Real]
    all_fillet: Flags

    def only(self, which: Flags | Indices) -> Side:
        """The same at some of the heights."""
        flags = (self.undercut[which], (self.hurry[0][which], self.hurry[1][which]), self.all_fillet[which])
        return Side(self.heights[which], self.inner[which], self.normal[which], self.outer[which], *flags)


class WormTeeth(Record, dict=True):
    """Teeth that ``hob`` cuts about a worm at ``centre_distance``; ``throat_radius`` about the worm's axis, mm.

    ``outer_radius`` of the wheel and ``width`` of its rim, mm; ``levels``: at how many heights the face is looked at;
    ``loose``: for a search, to which the last digits are nothing.
    """

    hob: Hob
    centre_distance: float
    throat_radius: float
    outer_radius: float
    width: float
    levels: int = _LEVELS
    loose: bool = False

    @property
    def number_of_teeth(self) -> int:
        """z_2."""
        return self.hob.number_of_teeth

    @property
    def throat_height(self) -> float:
        """Where the throat meets the outer cylinder, above and below the middle, mm; at most half the width."""
        out = self.centre_distance - self.outer_radius
        if out >= self.throat_radius:
            return 0.0
        if out <= -self.throat_radius:
            return self.width / 2
        return min(math.sqrt((self.throat_radius - out) * (self.throat_radius + out)), self.width / 2)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Heights between which every face is smooth, ascending, mm."""
        half, throat = self.width / 2, self.throat_height
        found = {-half, half, *((-throat, throat) if 0 < throat < half else ())}
        ends = (*self.undercut_ends, *self.flank_ends, *(end for ridge in self.ridges for end in ridge))
        # no face ends in a point on both sides
        middle = {0.0} if len(ends) > len(self.undercut_ends) else set()
        heights = sorted({*found, *middle, *(h for t in ends for h in (t, -t) if abs(h) < half)}, key=abs, reverse=True)
        # where fillets reach the tip a ridge may end too: rounding tells such heights apart
        kept: list[float] = []
        for height in heights:
            if all(abs(height - other) > _SAME * self.width for other in kept):
                kept.append(height)
        return tuple(sorted(kept))

    def tip_radius(self, heights: ArrayLike) -> Real:
        """Of the wheel at heights, mm."""
        y = np.minimum(np.abs(np.asarray(heights, float)), self.throat_radius)
        throat = self.centre_distance - np.sqrt((self.throat_radius - y) * (self.throat_radius + y))
        return np.where(np.abs(heights) >= self.throat_height, np.minimum(throat, self.outer_radius), throat)

    def room(self, along: float, centre_distance: float) -> float:
        """How thick a shaft may be ``along`` mm from the middle of the worm, in radius: so near come the tips, mm."""
        heights = np.linspace(0.0, self.width / 2, _LEVELS)
        tips = self.tip_radius(heights)
        inside = tips > abs(along)
        out = centre_distance - np.sqrt(np.maximum(tips**2 - along**2, 0.0))
        return float(np.hypot(out, heights)[inside].min(initial=math.inf))

    def reach(self) -> float:
        """Greatest distance of the teeth from the axis, mm."""
        if self.lessened is None:
            return float(self.tip_radius(self.width / 2))
        return float(self.top(self.breaks).max())

    def top(self, heights: ArrayLike) -> Real:
        """Distance from the axis of the tip, or of the ridge, at heights, mm."""
        return self.flank(self.side(heights), 1.0).distance

    def root_radius(self, heights: ArrayLike) -> Real:
        """Of what the land of the hob's tip leaves at heights, mm."""
        return self.hob.cut(self.hob.land(np.full(np.shape(heights), 0.5)), heights).distance

    def side(self, heights: ArrayLike) -> Side:
        """Where fillet and flank of the lower side begin and end.

        Raises
        ------
        NoTooth
            At one of the heights the hob leaves no tooth.
        """
        z = np.atleast_1d(np.asarray(heights, float))
        key = z.tobytes()
        if key not in self._known:
            self._known[key] = self._side(z)
        return self._known[key]

    def seek(self, runs: Iterable[Real]) -> None:
        """Find sides at runs of heights, which are asked for one after the other, all together."""
        new = {z.tobytes(): z for z in runs}
        new = {key: z for key, z in new.items() if key not in self._known}
        if new:
            side, end = self._side(np.concatenate([*new.values()])), 0
            for key, z in new.items():
                self._known[key] = side.only(np.arange(end, end := end + len(z)))

    @cached_property
    def _known(self) -> dict[bytes, Side]:
        """Sides by their heights: faces are fitted part by part at the same ones."""
        return {}

    def _side(self, z: Real) -> Side:
        return self._topped(self._plain(z))

    def _topped(self, plain: Side) -> Side:
        """A side up to the tip, or as far as the upper side leaves it."""
        z, pointed = plain.heights, np.zeros(len(plain.heights), dtype=bool)
        for low, high in self.ridges:
            pointed |= (z >= low) & (z <= high)
        if not pointed.any():
            return plain
        side = plain.only(np.arange(len(z)))
        ridge = self._ridge(z[pointed], side.only(pointed))
        for whole, part in zip((side.normal, side.outer, side.all_fillet, *side.hurry), ridge, strict=True):
            whole[pointed] = part
        side.inner[side.all_fillet] = side.outer[side.all_fillet]
        return side

    def _plain(self, z: Real, looked: _Looked | None = None) -> Side:
        """The lower side at heights up to the tip, though the upper one may cut it off below.

        ``looked``: what a search there has found.
        """
        hob, tip = self.hob, self.tip_radius(z)
        if not (tip - self.root_radius(z) > _LEAST_DEPTH * hob.worm.module).all():
            raise NoTooth("worm_wheel_not_reached")
        form, column = hob.form_radius, np.arange(len(z))
        radii, reach, first, at = looked or self._search(z)
        # a flank that turns back below the tip cuts the fillet there, though it began beyond; it may turn between radii
        turns = np.flatnonzero((first > 0) & (at < len(radii)))
        turning = np.full(len(z), np.nan)
        back = np.zeros(len(z), dtype=bool)
        if turns.size:
            number = first[turns]
            turning[turns] = self._turning(radii[number + 1, turns], radii[number - 1, turns], z[turns])
            back[turns] = self._reach(turning[turns], z[turns]) < tip[turns]
        beyond = reach[0] >= tip
        all_fillet = beyond & ~back
        at = np.where(all_fillet, 1, at)
        if not (at < len(radii)).all():
            raise NoTooth("worm_wheel_flank_ends")

        whole, outer = ~all_fillet, np.full(len(z), form)

        def past(radius: Real) -> Real:
            return self._reach(radius, z[whole]) - tip[whole]

        if whole.any():
            low = np.where(beyond, turning, radii[at - 1, column])
            ends = low[whole], radii[at[whole], column[whole]]
            outer[whole] = bracketed_roots(past, *ends, *map(past, ends), enough=self._enough)
            if not (np.abs(past(outer[whole])) <= _AT_TIP * hob.tip_radius).all():
                # the contact of a swivelled hob leaves the plane before its flank gets to the tip
                raise NoTooth("worm_wheel_flank_ends")
        undercut = (first > 0) & ~all_fillet
        inner, normal = np.full(len(z), form), np.full(len(z), hob.least_normal)
        # where undercut is just beginning both end where they touch
        cut = np.flatnonzero(undercut & (form - turning > _BARELY * hob.tip_radius))
        if cut.size:
            inner[cut], normal[cut] = self._crossing(z[cut], turning[cut], outer[cut])
        # beyond the tip
        uncrossed = np.isnan(inner)
        if not beyond[uncrossed].all():
            raise NoTooth("worm_wheel_undercut")
        all_fillet, undercut = all_fillet | uncrossed, undercut & ~uncrossed
        if all_fillet.any():
            inner[uncrossed] = outer[uncrossed] = form
            normal[all_fillet] = self._fillet_end(z[all_fillet])
            if self._is_cut(radii[:, all_fillet], normal[all_fillet], z[all_fillet]):
                raise NoTooth("worm_wheel_undercut")
        hurry, goes_on = self._hurry(z, inner, normal, outer)
        side = Side(z, inner, normal, outer, undercut, hurry, all_fillet)
        self._check(side, goes_on)
        return side

    def _check(self, side: Side, goes_on: Flags) -> None:
        """Refuse sides that fold, or whose contact does not go on to their ends."""
        z, normal, all_fillet = side.heights, side.normal, side.all_fillet
        way = self.hob.cut(self.hob.round(math.pi / 2 + (normal - math.pi / 2) * _FOLD), z).distance
        if not (np.diff(way, axis=0) > 0).all():
            raise NoTooth("worm_wheel_undercut")
        if not (goes_on | all_fillet).all():
            # the contact has run off to infinity on the other side, where the hob cuts from behind
            raise NoTooth("worm_wheel_flank_ends")
        run = np.diff(self.flank(side, _FOLD).distance, axis=0)
        short = all_fillet | (run.sum(axis=0) < _LEAST_DEPTH * self.hob.worm.module)
        if not ((run > _STILL * run.mean(axis=0)) | short).all():
            # about to fold within the flank
            raise NoTooth("worm_wheel_undercut")

    def _hurry(self, z: Real, inner: Real, normal: Real, outer: Real) -> tuple[tuple[Real, Real], Flags]:
        """How fast both parts go at their beginnings beside their ends, and whether the contact goes on there."""
        hob = self.hob
        root, end = hob.cut(hob.round(np.full(len(z), np.pi / 2)), z), hob.cut(hob.round(normal), z)
        begin, last = hob.cut(hob.flank(inner), z), hob.cut(hob.flank(outer), z)
        goes_on = (root.steepness * end.steepness > 0) & (begin.slid <= last.slid)
        # what has no side in its plane does not go on
        with np.errstate(invalid="ignore", divide="ignore"):
            rounded, straight = root.steepness / end.steepness, begin.steepness / last.steepness
        return (np.sqrt(np.abs(rounded)), np.abs(straight)), goes_on

    def _fillet_end(self, z: Real) -> Real:
        """Normals of the rounding, rad, at which fillets reach the tip."""
        hob, tip = self.hob, self.tip_radius(z)

        def past(normal: Real) -> Real:
            return self._left_at(hob.round(normal), z) - tip

        low, high = np.full(len(z), hob.least_normal), np.full(len(z), math.pi / 2)
        # where flank and fillet both end at the tip there is nothing between
        return bracketed_roots(past, low, high, np.maximum(past(low), 0.0), past(high), enough=self._enough)

    @property
    def _enough(self) -> float:
        """How near ends of flanks and fillets get to the tip, mm."""
        return _LOOSELY * self.hob.tip_radius if self.loose else 0.0

    def _is_cut(self, radii: Real, normal: Real, z: Real) -> bool:
        """Whether flanks, (m, n), whose contact comes back from infinity, cut sides that are fillets up to the tip."""
        own, ends = self.hob.cut(self.hob.flank(radii), z), np.linspace(math.pi / 2, normal, _ANGLES)
        below = own.found & (own.distance < self.tip_radius(z))
        if not below.any():
            return False
        fillet, deep = self.hob.cut(self.hob.round(ends), z).plane, _DEEP * math.tau / self.number_of_teeth
        below &= np.angle(own.plane) < 0
        return any(
            bool((np.angle(flank[at]) > np.interp(np.abs(flank[at]), np.abs(side), np.angle(side)) + deep).any())
            for flank, side, at in zip(own.plane.T, fillet.T, below.T, strict=True)
        )

    def _ridge(self, z: Real, lower: Side) -> tuple[Real, Real, Flags, Real, Real]:
        """Where lower sides meet the upper ones below the tip: as in ``Side`` normals, ends, and which parts meet."""
        sides = lower, self._plain(-z)
        rows = [np.concatenate([part(side, _RIDGE).plane for part in (self.fillet, self.flank)]) for side in sides]
        shares = np.concatenate([_RIDGE, 1 + _RIDGE])[:, 0]
        at = np.empty((2, len(z)))
        for k, (one, two) in enumerate(zip(rows[0].T, rows[1].T, strict=True)):
            own, other = np.abs(one), np.abs(two)
            left = -np.angle(one) - np.interp(own, other, np.angle(two))
            if not left[0] > 0:
                raise NoTooth("worm_wheel_pointed")
            gone = np.flatnonzero(left <= 0)
            if gone.size:
                i = int(gone[0])
                share = left[i - 1] / (left[i - 1] - left[i])
                at[0, k] = shares[i - 1] + share * (shares[i] - shares[i - 1])
                at[1, k] = np.interp(own[i - 1] + share * (own[i] - own[i - 1]), other, shares)
            else:
                at[:, k] = shares[-1]
        # parameters of the hob: a normal on fillets, a radius on flanks
        fillets = [(share < 1) | side.all_fillet for share, side in zip(at, sides, strict=True)]
        places = [
            np.where(
                on,
                math.pi / 2 + (side.normal - math.pi / 2) * _hurried(np.minimum(share, 1.0), side.hurry[0]),
                side.inner + (side.outer - side.inner) * _hurried(np.maximum(share, 1.0) - 1, side.hurry[1]),
            )
            for on, share, side in zip(fillets, at, sides, strict=True)
        ]

        def point(k: int, place: Real) -> Complex:
            heights, on, plane = (z, -z)[k], fillets[k], np.empty(len(z), dtype=complex)
            for own, part in ((on, self.hob.round), (~on, self.hob.flank)):
                if own.any():
                    plane[own] = self.hob.cut(part(place[own]), heights[own]).plane
            return plane if k == 0 else np.conj(plane)

        form = self.hob.form_radius
        for _ in range(_NEWTON_STEPS):
            off = point(0, places[0]) - point(1, places[1])
            if float(np.abs(off).max()) <= _SURE * self.hob.tip_radius:
                break
            ways = [(point(k, places[k] + _SLOPE) - point(k, places[k] - _SLOPE)) / (2 * _SLOPE) for k in (0, 1)]
            cross = (np.conj(ways[0]) * ways[1]).imag
            places = [places[k] - (np.conj(off) * ways[1 - k]).imag / cross for k in (0, 1)]
        if not float(np.abs(point(0, places[0]) - point(1, places[1])).max()) <= _MET * self.hob.tip_radius:
            raise NoTooth("worm_wheel_pointed")
        on = fillets[0]
        normal, outer = np.where(on, places[0], sides[0].normal), np.where(on, form, places[0])
        hurry, _ = self._hurry(z, np.where(on, outer, sides[0].inner), normal, outer)
        return normal, outer, on, *hurry

    def _search(self, heights: Real) -> _Looked:
        """Radii of the thread from its tip on, how far they reach, (m, n), and between which the flank grows, (n,).

        The last of these is the first beyond the tip of the tooth. Where it is undercut the flank turns back before.
        """
        form = self.hob.form_radius
        least = np.maximum(np.abs(heights) / math.cos(self.hob.swivel) * (1 + _LEAST_SHARE), self._least_radius)
        # the first step is a small one: it tells whether the flank turns back at once
        shares = np.linspace(0.0, 1.0, count := _FEW_RADII if self.levels < _LEVELS else _RADII)
        shares[1] = _FIRST_STEP
        radii = form + (least - form) * shares[:, None]
        reach = self._reach(radii, heights)
        with np.errstate(invalid="ignore"):
            falls = ~(np.diff(reach, axis=0) > 0)
        number = np.arange(count)[:, None]
        beyond = (reach >= self.tip_radius(heights)) & (number > 0)
        beyond[1:] &= ~falls
        at = np.where(beyond.any(axis=0), beyond.argmax(axis=0), count)
        first = np.where(falls & (number[1:] <= at), number[1:], 0).max(axis=0)
        return radii, reach, first, at

    @property
    def _least_radius(self) -> float:
        """Down to which a thread has its form, mm; an involute one goes on as a radial screw surface."""
        flank = self.hob.worm.flank
        return max(_ABOVE * flank.least_radius if self.hob.worm.form != "ZI" else 0.0, 1e-3 * self.hob.tip_radius)

    def _reach(self, radius: Real, heights: Real) -> Real:
        """Distance from the wheel's axis of what the flank leaves, mm; infinite from where its contact runs off on."""
        return self._left_at(self.hob.flank(radius), heights)

    def _left_at(self, points: Meridian, heights: Real) -> Real:
        """The same of what points of the thread leave, mm."""
        cut = self.hob.cut(points, heights)
        return np.where(cut.found & ~cut.runs_off, cut.distance, np.inf)

    def _turning(self, low: Real, high: Real, heights: Real) -> Real:
        """Radii of the thread at which the flank turns back between others, mm."""
        column = np.arange(len(low))
        for _ in range(_LEAST_TIMES):
            radii = low + (high - low) * _LEAST
            least = self._reach(radii, heights).argmin(axis=0)
            low, high = radii[np.maximum(least - 1, 0), column], radii[np.minimum(least + 1, len(radii) - 1), column]
        return np.asarray((low + high) / 2)

    def _crossing(self, heights: Real, low: Real, high: Real) -> tuple[Real, Real]:
        """Radii of the thread and normals of its rounding at which the fillets of undercut teeth meet the flanks.

        ``low``: where the flank turns back, ``high``: at the tip; nan where they meet beyond it.
        """
        hob = self.hob

        def fillet(normal: Real) -> Complex:
            return hob.cut(hob.round(normal), heights).plane

        # from the root outwards the fillet's distance grows, up to its own turning back
        normals = hob.least_normal + (math.pi / 2 - hob.least_normal) * np.linspace(1.0, 0.0, _ANGLES) ** 3
        curves = fillet(normals[:, None])
        reach, angles = np.abs(curves), np.angle(curves)
        falls = np.diff(reach, axis=0) < 0
        top = np.where(falls.any(axis=0), falls.argmax(axis=0), _ANGLES - 1)

        def flank(radius: Real) -> Complex:
            return hob.cut(hob.flank(radius), heights).plane

        # about where both are at one angle at one distance, column by column; then Newton's steps, slopes by difference
        radii = low + (high - low) * np.linspace(0.0, 1.0, _CROSSINGS)[:, None] ** 3
        lines = flank(radii)
        run, turned = np.abs(lines), np.angle(lines)
        radius, normal = hob.form_radius + _CROSSED * (low - hob.form_radius), np.empty(len(heights))
        shallow, sizes = hob.form_radius - low < _SHALLOW * hob.tip_radius, np.abs(flank(radius))
        for k, last in enumerate((top + 1).tolist()):
            if shallow[k]:
                normal[k] = np.interp(sizes[k], reach[:last, k], normals[:last])
                continue
            own = np.interp(run[:, k], reach[:last, k], angles[:last, k], right=np.nan)
            ahead = turned[:, k] - own
            change = np.flatnonzero(ahead[1:] * ahead[:-1] <= 0)
            if not change.size or low[k] - high[k] < _THIN * hob.tip_radius:
                radius[k] = normal[k] = np.nan
                continue
            at = int(change[0])
            share = ahead[at] / (ahead[at] - ahead[at + 1]) if ahead[at] != ahead[at + 1] else 0.0
            radius[k] = radii[at, k] + share * (radii[at + 1, k] - radii[at, k])
            size = run[at, k] + share * (run[at + 1, k] - run[at, k])
            normal[k] = np.interp(size, reach[:last, k], normals[:last])
        crosses = ~np.isnan(radius)
        # the shallowest meet as they are: a step of theirs would be rounding
        goes = np.ones(len(heights), dtype=bool)
        for left in range(_NEWTON_STEPS, -1, -1):
            lines, curves = flank(radius + _ABOUT_IT), fillet(normal + _ABOUT_IT)
            off = lines[1] - curves[1]
            goes &= ~(shallow & (np.abs(off) <= _SURE * hob.tip_radius))
            if not left or not float(np.abs(off)[crosses].max(initial=0.0)) > _SURE * hob.tip_radius:
                break
            one, two = ((part[2] - part[0]) / (2 * _SLOPE) for part in (lines, curves))
            cross = np.where(goes, (np.conj(one) * two).imag, np.inf)
            radius = radius - (np.conj(off) * two).imag / cross
            normal = normal - (np.conj(off) * one).imag / cross
        if not float(np.abs(off)[crosses].max(initial=0.0)) <= _MET * hob.tip_radius:
            raise NoTooth("worm_wheel_undercut")
        # few radii tell of a crossing just beyond the tip that it is before it
        return np.where(radius < high, np.nan, radius), normal

    def flank(self, side: Side, share: Real | float) -> Cut:
        """The lower flank at shares (m, 1) from fillet (0) to tip (1), at the side's heights: (m, n)."""
        share = _hurried(share, side.hurry[1])
        # feet of perpendiculars are sought beyond the tip too
        own = self.hob.flank(np.maximum(side.inner + (side.outer - side.inner) * share, self._least_radius))
        if side.all_fillet.any():
            # the end of the fillet
            end = self.hob.round(side.normal + 0 * share)
            pairs = (end.radius, own.radius), (end.z, own.z), (end.outwards, own.outwards), (end.upwards, own.upwards)
            radius, z, outwards, upwards = (np.where(side.all_fillet, one, other) for one, other in pairs)
            own = Meridian(radius, lambda: z, outwards, upwards)
        return self.hob.cut(own, side.heights)

    def fillet(self, side: Side, share: Real | float) -> Cut:
        """The lower fillet at shares (m, 1) from root (0) to flank (1), at the side's heights: (m, n)."""
        normal = math.pi / 2 + (side.normal - math.pi / 2) * _hurried(share, side.hurry[0])
        return self.hob.cut(self.hob.round(normal), side.heights)

    def thickness(self, heights: ArrayLike) -> Real:
        """Angle of the teeth at their tip at heights, rad."""
        z = np.atleast_1d(np.asarray(heights, float))
        lower, upper = (np.angle(self.flank(self.side(heights), 1.0).plane) for heights in (z, -z))
        return -lower - upper

    def outline(self, height: float) -> Profile:
        """The section at a height as a polygon through few points of each flank and fillet, for the eye."""
        shares, near = np.linspace(0.0, 1.0, _DRAWN)[:, None], _SEEN * self.outer_radius
        lower, upper = (
            np.concatenate(
                [
                    chords_near(self.fillet(side, shares).plane[:, 0], near)[:-1],
                    chords_near(self.flank(side, shares).plane[:, 0], near),
                ]
            )
            for side in (self.side(h) for h in (height, -height))
        )
        around = [*lower, *np.conj(upper[::-1]), lower[0] * np.exp(2j * math.pi / self.number_of_teeth)]
        way = [*(Label.FLANK for _ in lower[1:]), Label.TIP_LAND, *(Label.FLANK for _ in upper[1:]), Label.ROOT_LAND]
        lines = [Line(complex(a), complex(b)) for a, b in pairwise(around)]
        return Profile(tuple(map(Segment, lines, way)), self.number_of_teeth)

    @property
    def glanced(self) -> WormTeeth:
        """The same for a search, which looks at few heights of many wheels."""
        return _once(replace(self, levels=_GLANCE, loose=True))

    @property
    def tried(self) -> WormTeeth:
        """The same for a search that asks whether splines follow, of what is looked at in full before it is made."""
        return _once(replace(self, levels=_FEW_LEVELS, loose=True))

    @property
    def sliver(self) -> WormTeeth:
        """The same of the least width, or of their own."""
        return _once(replace(self, width=min(self.width, _LEAST_WIDTH * self.hob.tip_radius)))

    def narrowed(self) -> WormTeeth:
        """The teeth with as much of the width as has whole ones at every height; themselves where none has."""
        return self.widest(lambda teeth: teeth.glanced.is_whole(), WormTeeth.is_whole) or self

    def widest(self, *looks: Callable[[WormTeeth], bool], share: float = NEAR_WIDTH) -> WormTeeth | None:
        """The same of the greatest width that looks find well, or None.

        Each look is a closer one than that before it, and the last decides. ``share``: of it, how near it is found.
        """
        width, least = self.width, self.sliver.width

        def does(look: Callable[[WormTeeth], bool], width: float) -> bool:
            return look(_once(replace(self, width=width)))

        for look in looks:
            if not does(look, width):
                ends = [*(less for part in _LESS if (less := part * width) > least), least]
                found = nearest(partial(does, look), width, ends, share=share)
                if found is None or not isinstance(found.value, float):
                    return None
                width = found.value
        return _once(replace(self, width=width))

    @cached_property
    def ended(self) -> str | None:
        """What leaves no tooth at some height: a code."""
        if self._torn is not None:
            return self._torn
        pointed = self._plain_thickness <= 0
        if pointed.any():
            try:
                self._ridge(self._levels[pointed], self._plain_levels.only(pointed))
            except NoTooth as ended:
                return ended.code
        return None

    @cached_property
    def lessened(self) -> str | None:
        """What leaves no whole tooth at some height, with a flank up to a tip of its own: a code."""
        if self._torn is not None:
            return self._torn
        if bool((self._plain_thickness <= 0).any()):
            return "worm_wheel_pointed"
        return "worm_wheel_all_fillet" if bool(self._plain_levels.all_fillet.any()) else None

    def stands(self) -> bool:
        """Whether some of every tooth is left at every height."""
        return self.ended is None

    def is_whole(self) -> bool:
        """Whether every tooth has a tip and a flank at every height, the flank not of next to nothing."""
        try:
            side = self._plain_levels
        except NoTooth:
            return False
        # what is known already first
        if side.all_fillet.any() or self.lessened is not None:
            return False
        flank = np.abs(self.flank(side, 1.0).plane - self.fillet(side, 1.0).plane)
        return bool(flank.min() > _LEAST_DEPTH * self.hob.worm.module)

    @cached_property
    def is_creased(self) -> bool:
        """Whether flanks run over the base circle of an involute worm, below which it is radial: they bend there."""
        return self._torn is None and bool(self._plain_levels.outer.min() < self.hob.worm.flank.least_radius)

    def is_smooth(self) -> bool:
        """Whether some of every tooth is left and its flanks bend nowhere."""
        return self.stands() and not self.is_creased

    def is_even(self) -> bool:
        """Whether every tooth is whole and its flanks bend nowhere."""
        return self.is_whole() and not self.is_creased

    @cached_property
    def _torn(self) -> str | None:
        """What leaves no side up to the tip at some height: a code."""
        # just beside where undercut begins the flank may fold between fillet and tip
        beside = [end + step * self.width for end in self._undercut_from(_ABOUT) for step in _BESIDE]
        half = self.width / 2
        try:
            # beyond the hob's side its flanks turn round it
            wide = float(self._plain_thickness.max()) >= 2 * math.pi / self.number_of_teeth
            if beside:
                self._plain(np.clip([*beside, *np.negative(beside)], -half, half))
        except NoTooth as ended:
            return ended.code
        return "worm_wheel_flank_ends" if wide or not self._runs_on else None

    @property
    def _runs_on(self) -> bool:
        """Whether the contact of a swivelled hob runs on beyond the tip at the levels.

        Just short of where it turns back in the plane no spline follows it, and no perpendicular has a foot.
        """
        if self.hob.swivel == 0:
            return True
        side = self._plain_levels
        on = self._reach(side.inner + (side.outer - side.inner) * _hurried(1 + _RUNS_ON, side.hurry[1]), self._levels)
        return bool(((np.isfinite(on) & (on > self.tip_radius(self._levels))) | side.all_fillet).all())

    @property
    def _levels(self) -> Real:
        """Heights at which a face is looked at, closer at its ends, and where the throat ends: teeth are thin there."""
        half, throat = self.width / 2, self.throat_height
        even = half * np.sin(np.linspace(-math.pi / 2, math.pi / 2, self.levels))
        return np.unique([*even, -throat, throat]) if 0 < throat < half else np.asarray(even)

    @cached_property
    def _looked(self) -> _Looked:
        """A search at the levels."""
        return self._search(self._levels)

    @cached_property
    def _plain_levels(self) -> Side:
        """The lower side at the levels, up to the tip."""
        return self._plain(self._levels, self._looked)

    @cached_property
    def _plain_thickness(self) -> Real:
        """Angles between both sides at the tip at the levels, rad; below 0 they have met."""
        ends = np.angle(self.flank(self._plain_levels, 1.0).plane)
        # the upper side is the lower one at the opposite height
        return np.asarray(-ends - ends[::-1])

    @cached_property
    def ridges(self) -> tuple[tuple[float, float], ...]:
        """Heights between which both sides meet below the tip, mm."""
        pointed = self._plain_thickness <= 0
        if not pointed.any():
            return ()

        def left(heights: Real) -> Real:
            ends = np.angle(self.flank(self._plain(np.concatenate([heights, -heights])), 1.0).plane)
            return np.asarray(-ends[: len(heights)] - ends[len(heights) :])

        # half a turn about the middle of a tooth makes one end of the face the other
        upper = slice(len(pointed) // 2, None)
        ends = [*self._turns(lambda z: left(z) <= 0, self._levels[upper], pointed[upper])]
        ends += [self.width / 2] if pointed[-1] else []
        ends = [*(-z for z in reversed(ends)), *ends]
        return tuple(zip(ends[::2], ends[1::2], strict=True))

    @cached_property
    def flank_ends(self) -> tuple[float, ...]:
        """Heights at which the fillet begins to reach the tip of the lower side, mm."""
        if self.lessened is None:
            return ()

        def beyond(plain: Side) -> Real:
            form = self.hob.cut(self.hob.flank(np.full(len(plain.heights), self.hob.form_radius)), plain.heights)
            border = np.where(plain.all_fillet, form.distance, self.fillet(plain, 1.0).distance)
            return border - self.flank(self._topped(plain), 1.0).distance

        held = beyond(self._plain_levels) > 0
        return self._turns(lambda z: beyond(self._plain(z)) > 0, self._levels, held)

    @cached_property
    def undercut_ends(self) -> tuple[float, ...]:
        """Heights at which undercut begins on the lower side, mm."""
        return self._undercut_from(_SETTLED)

    @property
    def undercut_width(self) -> float:
        """On how much of the face width the lower side is undercut, and the upper side as much, mm."""
        half, held = self.width / 2, self._looked[2] > 0
        ends = [*([-half] if held[0] else []), *self.undercut_ends, *([half] if held[-1] else [])]
        return math.fsum(high - low for low, high in zip(ends[::2], ends[1::2], strict=True))

    def _undercut_from(self, settled: float) -> tuple[float, ...]:
        """The same known that well, part of the width."""
        return self._turns(lambda z: self._search(z)[2] > 0, self._levels, self._looked[2] > 0, settled)

    def _turns(
        self, holds: Callable[[Real], Flags], levels: Real, held: Flags, settled: float = 0.0
    ) -> tuple[float, ...]:
        """Heights at which what is ``held`` at some turns over, known to a part of the width, mm."""
        settled = settled or (_NEARLY if self.loose else _CLOSE)
        at = np.flatnonzero(held[1:] != held[:-1])
        low, high, column = levels[at], levels[at + 1], np.arange(len(at))
        while (high - low > settled * self.width).any():
            places = low + (high - low) * _PARTS
            same = holds(places.ravel()).reshape(places.shape) == held[at]
            # the first that is otherwise, and the one before it
            k = np.where(same.all(axis=0), len(_PARTS) - 1, np.maximum(same.argmin(axis=0), 1))
            low, high = places[k - 1, column], places[k, column]
        return tuple(((low + high) / 2).tolist())


# searches ask for the same teeth again and again
@lru_cache(maxsize=64)
def _once(teeth: WormTeeth) -> WormTeeth:
    """Such teeth with all that has been found of them."""
    return teeth


def chords_near(points: Complex, near: float) -> Complex:
    """As few of a run of points (n,) as stand evenly along it and leave it by less than that, its ends among them."""
    run = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    for count in range(1, len(points)):
        at = np.unique(np.searchsorted(run, np.linspace(0.0, run[-1], count + 1) * (1 - 1e-9)))
        kept = points[at]
        seen = np.interp(run, run[at], kept.real) + 1j * np.interp(run, run[at], kept.imag)
        if float(np.abs(seen - points).max()) < near:
            return kept
    return points


def _hurried(share: Real | float, hurry: Real) -> Real:
    """Shares of a part's way over the hob for shares along the wheel.

    The contact runs as 1 / steepness: were that linear on the hob, shares would be those of the run.
    """
    return np.asarray(share * hurry / (1 - share + share * hurry))
