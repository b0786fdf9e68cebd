"""Where a worm touches the wheel that it envelops: the field of action on both, and its lines of contact.

A point of the lower flank at a height above the mid plane and at a radius of the thread is touched where the worm has
slid by ``Cut.slid``, in closed form (``hob.py``): a line of contact is a line of equal slide. A pitch on, the next
tooth is touched along it. The upper flank is the lower one after half a turn about the line of centres.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from geometry.base.record import Record
from geometry.base.roots import bracketed_roots, halved
from geometry.curves.curve import Flags, Real
from geometry.gears.worms.hob import Cut
from geometry.gears.worms.wheel import WormTeeth

# heights at which lines begin or end is looked for, radii at which the way of the contact is looked at, halvings
_HEIGHTS, _RADII, _HALVINGS = 129, 33, 52


class Field(Record):
    """The field of action on the lower flank of ``teeth`` left by the worm itself.

    ``least`` and ``most``: radii between which the thread of the worm has its flank, mm.
    """

    teeth: WormTeeth
    least: float
    most: float

    def edges(self, heights: Real) -> tuple[Real, Real]:
        """Radii of the thread at heights (n,) where the field ends: towards the wheel's root and at its tip, mm.

        Both are one where the worm does not reach down to the wheel's tip.
        """
        side = self.teeth.side(heights)
        return np.minimum(side.inner, self.most), np.clip(side.outer, self.least, self.most)

    def touching(self, heights: Real, radii: Real) -> Cut:
        """What the worm touches at radii of its thread (.., n)."""
        return self.teeth.hob.cut(self.teeth.hob.flank(radii), heights)

    def line(self, heights: Real, slide: float | Real) -> Real:
        """Radii of the thread at which it touches the wheel when it has slid so far, at heights (n,), mm.

        Where the line does not reach that height, the end of the field that is nearer.
        """
        low, high = self.edges(heights)
        at_low, at_high = (self.touching(heights, radii).slid - slide for radii in (low, high))
        found, between = np.where(at_low < 0, high, low), (at_low < 0) & (at_high > 0)
        mine, wanted = heights[between], np.broadcast_to(slide, heights.shape)[between]
        found[between] = bracketed_roots(
            lambda radii: self.touching(mine, radii).slid - wanted,
            low[between], high[between], at_low[between], at_high[between],
        )  # fmt: skip
        return found

    def lines(self, slides: Real) -> list[tuple[int, float, float]]:
        """Lines of contact at slides (m,): which of them, and the heights between which each goes on, mm."""

        def reached(heights: Real, slide: Real) -> Flags:
            first, last = (self.touching(heights, radii).slid for radii in self.edges(heights))
            return np.asarray((first <= slide) & (slide <= last))

        half = self.teeth.width / 2
        heights = np.linspace(-half, half, _HEIGHTS)
        inside = reached(heights, slides[:, None])
        which, at = np.nonzero(inside[:, 1:] != inside[:, :-1])
        low, high, was = heights[at], heights[at + 1], inside[which, at]
        low, _ = halved(lambda middle: reached(middle, slides[which]) == was, low, high, _HALVINGS)
        found = []
        for k in range(len(slides)):
            ends = [-half] * bool(inside[k, 0]) + low[which == k].tolist() + [half] * bool(inside[k, -1])
            found += [(k, a, b) for a, b in zip(ends[::2], ends[1::2], strict=True)]
        return found

    def spans(self) -> list[tuple[float, float]]:
        """Heights between which the field is there and its borders are smooth, mm."""
        ends = list(self.teeth.breaks)
        heights = np.linspace(ends[0], ends[-1], _HEIGHTS)
        there = np.greater(*self.edges(heights))
        at = np.flatnonzero(there[1:] != there[:-1])
        low, high, was = heights[at], heights[at + 1], there[at]
        if at.size:
            low, _ = halved(lambda middle: np.greater(*self.edges(middle)) == was, low, high, _HALVINGS)
        ends = sorted({*ends, *low.tolist()})
        there = np.greater(*self.edges(np.array([(a + b) / 2 for a, b in pairwise(ends)])))
        return [span for span, is_there in zip(pairwise(ends), there.tolist(), strict=True) if is_there]

    def slides(self) -> tuple[float, float]:
        """The first and the last slide at which the flank is touched, mm."""
        slid = self._sampled()[1].slid
        return float(slid.min()), float(slid.max())

    def length_used(self, slope: float = 0.0) -> float:
        """Twice how far from its middle the worm is touched, mm; 0 where teeth too low touch it nowhere.

        ``slope``: by how much a thread ends earlier for each mm above its foot: the tangent of its end's cone.
        """
        radii, cut = self._sampled()
        return 2 * float(
            (np.abs(cut.touching.imag) + slope * (radii - self.teeth.hob.worm.root_radius)).max(initial=0.0)
        )

    def goes_on(self) -> bool:
        """Whether the contact moves from root to tip at every height, so that every line is found."""
        return bool((np.diff(self._sampled()[1].slid, axis=0) > 0).all())

    def is_empty(self) -> bool:
        """Whether the flanks touch nowhere: teeth too low, whose contact lies beyond the threads."""
        return self._sampled()[0].size == 0

    def _sampled(self) -> tuple[Real, Cut]:
        """Radii (m, n) over the field, both ends of every height among them."""
        heights = np.unique([*np.linspace(-self.teeth.width / 2, self.teeth.width / 2, _HEIGHTS), *self.teeth.breaks])
        low, high = self.edges(heights)
        touched = low > high
        heights, low, high = heights[touched], low[touched], high[touched]
        radii = low + (high - low) * np.linspace(0.0, 1.0, _RADII)[:, None]
        return radii, self.touching(heights, radii)
