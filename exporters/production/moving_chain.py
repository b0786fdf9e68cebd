"""The chain of a drive as a film shows it: its links as one band, which over a pitch comes to look as it did."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex
from parts.scene.placing import PlacedMate
from parts.scene.relative_path import Course

# half of the width of a link between its ends, by that at its ends; stands in a pitch
_WAIST, _STANDS = 0.6, 16


class MovingChain(Record, dict=True):
    """A chain, and how many pitches it goes on in a loop, below 0: clockwise.

    Slack strands bow with the root of their slack, which a few stands do not follow: it is a picture of these.
    """

    mate: PlacedMate
    pitches: int

    @property
    def name(self) -> str:
        """No instance's: theirs have no dot."""
        return f"chain.{self.mate.first.id}.{self.mate.second.id}"

    def _pins(self) -> tuple[Complex, float]:
        """Pins (t, links) in order at even shares of a pitch, and half of the width of a link, mm."""
        rows, half = list[Complex](), 0.0
        step = math.copysign(2 * math.pi / self.mate.mating.teeth[0], self.pitches)
        for share in np.linspace(0, 1, _STANDS + 1).tolist():
            found = self.mate.rollers(share * step)
            assert found is not None
            pins, half = found
            rows.append(pins if not rows else np.roll(pins, -int(np.abs(pins - rows[-1][0]).argmin())))
        return np.array(rows), half

    @cached_property
    def forms(self) -> Complex:
        """Corners (t, n) of the band: round the outer edges of all links, and back along the inner ones, mm."""
        pins, half = self._pins()
        after, before = np.roll(pins, -1, axis=1), np.roll(pins, 1, axis=1)
        ends, middles = 1j * (after - before), 1j * (after - pins)
        beside = half * np.stack([ends / np.abs(ends), _WAIST * middles / np.abs(middles)], axis=-1)
        along = np.stack([pins, (pins + after) / 2], axis=-1)
        outer, inner = ((along + side * beside).reshape(len(pins), -1) for side in (1, -1))
        return np.concatenate([outer, outer[:, :1], inner[:, :1], inner[:, ::-1]], axis=1)


def moving_chains(mates: Sequence[PlacedMate], course: Course, loop: float) -> Iterator[MovingChain]:
    """The chains that run upright about axes that stay, through whole pitches in a loop."""
    for mate in mates:
        rates = course.rates.get(mate.first.id, ())
        if len(rates) != 1 or mate.first.id in course.once or mate.rollers() is None:
            continue
        pitches = loop * float(rates[0]) * mate.mating.teeth[0]
        if round(pitches) and math.isclose(pitches, round(pitches), rel_tol=1e-9):
            yield MovingChain(mate, round(pitches))
