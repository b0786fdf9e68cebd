"""The teeth of a worm wheel as its hob leaves them, over heights above the mid plane of its rim.

Frame: the wheel's axis is z, tooth 1 is centred on +x. Across the axis stand, from the middle of a space: the root that
the hob's tip leaves, the fillet of its rounding, the flank of its thread, and the tip: a throat about the worm's axis
within an outer cylinder. The lower side is described; half a turn about the middle of tooth 1
makes the upper one of it.
"""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.errors import ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_roots
from geometry.curves.line_arc import Line
from geometry.gears.worms.hob import Cut, Hob
from geometry.plane.profile import Label, Profile, Segment

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]

# radii of the thread and angles of its rounding at which a side is looked for
_RADII, _ANGLES, _FIRST_STEP = 257, 129, 1e-7
# of a fillet that cuts a flank: radii from which their crossing is sought, Newton's steps, the step of slopes (mm and
# rad), how near both end, and what undercut is only beginning, part of the hob's size
_CROSSINGS, _NEWTON_STEPS, _SLOPE, _MET, _BARELY = 65, 8, 1e-6, 1e-10, 3e-4
# steps of the golden section
_GOLDEN, _GOLDEN_STEPS = (math.sqrt(5) - 1) / 2, 40
# a thread's point that near the plane of its axis is not asked for, part of its radius
_LEAST_SHARE = 1e-9
# heights at which a face is looked at, and how well places between them are known, part of the width
_LEVELS, _SETTLED = 97, 1e-9
# shares of a fillet at which it is looked whether it folds
_FOLD = np.linspace(0.0, 1.0, 17)[:, None]
# how far beside an end of undercut it is looked at, part of the width
_BESIDE = (-1e-2, -1e-3, 1e-3, 1e-2)
# of pictures: points of which a few are drawn, and how near their chords are, part of the size
_DRAWN, _SEEN = 33, 2e-4
# the least width that is offered, part of the asked one
_LEAST_WIDTH = 2e-2


class NoTooth(Exception):
    """No tooth stands at some height, and by what: a code."""

    def __init__(self, code: str) -> None:
        self.code = code
        super().__init__(code)


class Side(Record, eq=False):
    """Where the parts of a tooth's lower side begin and end at heights (n,).

    ``inner``: radius of the thread where the flank leaves the fillet, ``normal``: of the rounding there, rad;
    ``outer``: radius of the thread at the tip, mm; ``undercut``: the fillet cuts the flank there; ``hurry``: how many
    times as steep fillet and flank are where they begin as where they end.
    """

    heights: Real
    inner: Real
    normal: Real
    outer: Real
    undercut: NDArray[np.bool_]
    hurry: tuple[Real, Real]


class WormTeeth(Record, dict=True):
    """Teeth that ``hob`` cuts about a worm at ``centre_distance``; ``throat_radius`` about the worm's axis, mm.

    ``outer_radius`` of the wheel and ``width`` of its rim, mm.
    """

    hob: Hob
    centre_distance: float
    throat_radius: float
    outer_radius: float
    width: float

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
        return tuple(sorted({*found, *(h for t in self.undercut_ends for h in (t, -t))}))

    def tip_radius(self, heights: ArrayLike) -> Real:
        """Of the wheel at heights, mm."""
        y = np.minimum(np.abs(np.asarray(heights, float)), self.throat_radius)
        throat = self.centre_distance - np.sqrt((self.throat_radius - y) * (self.throat_radius + y))
        return np.where(np.abs(heights) >= self.throat_height, np.minimum(throat, self.outer_radius), throat)

    def root_radius(self, heights: ArrayLike) -> Real:
        """Of what the land of the hob's tip leaves at heights, mm."""
        land = self.hob.cut(self.hob.land(np.full(np.shape(heights), 0.5)), heights)
        return np.abs(land.plane)

    def side(self, heights: ArrayLike) -> Side:
        """Where fillet and flank of the lower side begin and end.

        Raises
        ------
        NoTooth
            At one of the heights the hob leaves no flank up to the tip.
        """
        z = np.atleast_1d(np.asarray(heights, float))
        hob, tip = self.hob, self.tip_radius(z)
        form, column = hob.form_radius, np.arange(len(z))
        radii, reach, first, at = self._search(z)
        if not (reach[0] < tip).all():
            # the rounding of the hob's tip reaches as far as the tooth
            raise NoTooth("worm_wheel_all_fillet")
        if not (at < _RADII).all():
            raise NoTooth("worm_wheel_flank_ends")

        def past(radius: Real) -> Real:
            return self._reach(radius, z) - tip

        ends = radii[at - 1, column], radii[at, column]
        outer = bracketed_roots(past, *ends, past(ends[0]), past(ends[1]))
        undercut = first > 0
        inner, normal = np.full(len(z), form), np.full(len(z), hob.least_normal)
        if undercut.any():
            column, first = column[undercut], first[undercut]
            turning = self._turning(radii[first + 1, column], radii[first - 1, column], z[undercut])
            # where undercut is just beginning both end where they touch
            deep = form - turning > _BARELY * hob.tip_radius
            cut = np.flatnonzero(undercut)[deep]
            if cut.size:
                inner[cut], normal[cut] = self._crossing(z[cut], turning[deep], outer[cut])
        root, end = hob.cut(hob.round(np.full(len(z), np.pi / 2)), z), hob.cut(hob.round(normal), z)
        begin, last = hob.cut(hob.flank(inner), z), hob.cut(hob.flank(outer), z)
        way = np.abs(self.hob.cut(hob.round(math.pi / 2 + (normal - math.pi / 2) * _FOLD), z).plane)
        if not (np.diff(way, axis=0) > 0).all():
            raise NoTooth("worm_wheel_undercut")
        if not ((root.steepness * end.steepness > 0) & (begin.slid < last.slid)).all():
            # the contact has run off to infinity on the other side, where the hob cuts from behind
            raise NoTooth("worm_wheel_flank_ends")
        return Side(
            z, inner, normal, outer, undercut,
            (np.sqrt(root.steepness / end.steepness), begin.steepness / last.steepness),
        )  # fmt: skip

    def _search(self, heights: Real) -> tuple[Real, Real, NDArray[np.intp], NDArray[np.intp]]:
        """Radii of the thread from its tip on, how far they reach, (m, n), and between which the flank grows, (n,).

        The last of these is the first beyond the tip of the tooth. Where it is undercut the flank turns back before.
        """
        form = self.hob.form_radius
        least = np.maximum(np.abs(heights) / math.cos(self.hob.swivel) * (1 + _LEAST_SHARE), self._least_radius)
        # the first step is a small one: it tells whether the flank turns back at once
        shares = np.linspace(0.0, 1.0, _RADII)
        shares[1] = _FIRST_STEP
        radii = form + (least - form) * shares[:, None]
        reach = self._reach(radii, heights)
        with np.errstate(invalid="ignore"):
            falls = ~(np.diff(reach, axis=0) > 0)
        number = np.arange(_RADII)[:, None]
        beyond = (reach >= self.tip_radius(heights)) & (number > 0)
        beyond[1:] &= ~falls
        at = np.where(beyond.any(axis=0), beyond.argmax(axis=0), _RADII)
        first = np.where(falls & (number[1:] <= at), number[1:], 0).max(axis=0)
        return radii, reach, first, at

    @property
    def _least_radius(self) -> float:
        """Down to which a thread has its form, mm; an involute one goes on as a radial screw surface."""
        flank = self.hob.worm.flank
        return max(flank.least_radius if self.hob.worm.form != "ZI" else 0.0, 1e-3 * self.hob.tip_radius)

    def _reach(self, radius: Real, heights: Real) -> Real:
        """Distance from the wheel's axis of what the flank leaves, mm; infinite from where it stands upright on."""
        cut = self.hob.cut(self.hob.flank(radius), heights)
        return np.where(cut.steepness < 0, np.abs(cut.plane), np.inf)

    def _turning(self, low: Real, high: Real, heights: Real) -> Real:
        """Radii of the thread at which the flank turns back between others, by the golden section, mm."""
        for _ in range(_GOLDEN_STEPS):
            one, two = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
            left = self._reach(one, heights) < self._reach(two, heights)
            low, high = np.where(left, low, one), np.where(left, two, high)
        return np.asarray((low + high) / 2)

    def _crossing(self, heights: Real, low: Real, high: Real) -> tuple[Real, Real]:
        """Radii of the thread and normals of its rounding at which the fillets of undercut teeth meet the flanks.

        ``low``: where the flank turns back, ``high``: at the tip.
        """
        hob = self.hob

        def fillet(normal: Real) -> Complex:
            return hob.cut(hob.round(normal), heights).plane

        # from the root outwards the fillet's distance grows, up to its own turning back
        normals = hob.least_normal + (math.pi / 2 - hob.least_normal) * np.linspace(1.0, 0.0, _ANGLES) ** 3
        reach = np.abs(fillet(normals[:, None]))
        falls = np.diff(reach, axis=0) < 0
        top = np.where(falls.any(axis=0), falls.argmax(axis=0), _ANGLES - 1)

        def flank(radius: Real) -> Complex:
            return hob.cut(hob.flank(radius), heights).plane

        # about where both are at one angle at one distance, column by column; then Newton's steps, slopes by difference
        radii = low + (high - low) * np.linspace(0.0, 1.0, _CROSSINGS)[:, None] ** 3
        lines, curves = flank(radii), fillet(normals[:, None])
        radius, normal = np.empty(len(heights)), np.empty(len(heights))
        for k, last in enumerate((top + 1).tolist()):
            own = np.interp(np.abs(lines[:, k]), reach[:last, k], np.angle(curves[:last, k]), right=np.nan)
            ahead = np.angle(lines[:, k]) - own
            change = np.flatnonzero(ahead[1:] * ahead[:-1] <= 0)
            if not change.size:
                raise NoTooth("worm_wheel_undercut")
            at = int(change[0])
            share = ahead[at] / (ahead[at] - ahead[at + 1]) if ahead[at] != ahead[at + 1] else 0.0
            radius[k] = radii[at, k] + share * (radii[at + 1, k] - radii[at, k])
            size = np.abs(lines[at, k]) + share * (np.abs(lines[at + 1, k]) - np.abs(lines[at, k]))
            normal[k] = np.interp(size, reach[:last, k], normals[:last])
        for _ in range(_NEWTON_STEPS):
            off = flank(radius) - fillet(normal)
            one = (flank(radius + _SLOPE) - flank(radius - _SLOPE)) / (2 * _SLOPE)
            two = (fillet(normal + _SLOPE) - fillet(normal - _SLOPE)) / (2 * _SLOPE)
            cross = (np.conj(one) * two).imag
            radius = radius - (np.conj(off) * two).imag / cross
            normal = normal - (np.conj(off) * one).imag / cross
        if not float(np.abs(flank(radius) - fillet(normal)).max()) <= _MET * hob.tip_radius:
            raise NoTooth("worm_wheel_undercut")
        return radius, normal

    def flank(self, side: Side, share: Real | float) -> Cut:
        """The lower flank at shares (m, 1) from fillet (0) to tip (1), at the side's heights: (m, n)."""
        share = _hurried(share, side.hurry[1])
        return self.hob.cut(self.hob.flank(side.inner + (side.outer - side.inner) * share), side.heights)

    def fillet(self, side: Side, share: Real | float) -> Cut:
        """The lower fillet at shares (m, 1) from root (0) to flank (1), at the side's heights: (m, n)."""
        normal = math.pi / 2 + (side.normal - math.pi / 2) * _hurried(share, side.hurry[0])
        return self.hob.cut(self.hob.round(normal), side.heights)

    def thickness(self, heights: ArrayLike) -> Real:
        """Angle of the teeth at their tip at heights, rad."""
        z = np.atleast_1d(np.asarray(heights, float))
        lower, upper = (self.flank(self.side(h), 1.0).plane for h in (z, -z))
        return -np.angle(lower) - np.angle(upper)

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

    def narrowed(self) -> WormTeeth:
        """The teeth with as much of the width as has some at every height; themselves where none has."""
        if self.ended is None:
            return self
        found = nearest(lambda width: replace(self, width=width).ended is None, self.width, _LEAST_WIDTH * self.width)
        return replace(self, width=found.value) if found and isinstance(found.value, float) else self

    def checked(self) -> WormTeeth:
        """The teeth themselves, where some of them is left at every height.

        Raises
        ------
        ParameterError
            The face is wider than teeth stand: the flank ends below the tip, undercut leaves none, or it is pointed.
        """
        if self.ended is None:
            return self

        def stands(width: float) -> bool:
            return replace(self, width=width).ended is None

        raise ParameterError(
            "face_width", self.width, self.ended, lambda: nearest(stands, self.width, _LEAST_WIDTH * self.width)
        )

    @cached_property
    def ended(self) -> str | None:
        """What leaves no tooth at some height: a code."""
        # just beside where undercut begins the flank may fold between fillet and tip
        beside = [end + step * self.width for end in self.undercut_ends for step in _BESIDE]
        heights = self.width / 2 * np.sin(np.linspace(-math.pi / 2, math.pi / 2, _LEVELS))
        heights = np.concatenate([heights, np.clip([*beside, *np.negative(beside)], heights[0], heights[-1])])
        try:
            ends = np.angle(self.flank(self.side(heights), 1.0).plane)
        except NoTooth as ended:
            return ended.code
        # the upper side is the lower one at the opposite height
        whole = slice(0, _LEVELS)
        thickness = -ends[whole] - ends[whole][::-1]
        # beyond the hob's side its flanks turn round it
        if thickness.max() >= 2 * math.pi / self.number_of_teeth:
            return "worm_wheel_flank_ends"
        return None if thickness.min() > 0 else "worm_wheel_pointed"

    @cached_property
    def undercut_ends(self) -> tuple[float, ...]:
        """Heights at which undercut begins on the lower side, mm."""
        z = np.linspace(-self.width / 2, self.width / 2, _LEVELS)
        cut = self._search(z)[2] > 0
        found = []
        for k in np.flatnonzero(cut[1:] != cut[:-1]).tolist():
            low, high = float(z[k]), float(z[k + 1])
            while high - low > _SETTLED * self.width:
                middle = (low + high) / 2
                is_cut = self._search(np.array([middle]))[2][0] > 0
                low, high = (middle, high) if is_cut == cut[k] else (low, middle)
            found.append((low + high) / 2)
        return tuple(found)


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
