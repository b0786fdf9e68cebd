"""How a worm and its wheel stand to each other over one pitch: least gaps of their exact surfaces, in sections.

In every plane across the wheel's axis the wheel's flank is held against the worm where it is, along the worm's normal;
the least gap of a flank is sought from a grid by the golden section.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from geometry.curves.curve import Real
from geometry.gears.mesh.search import CONTACT_TOLERANCE, ContactPlace, PairContact
from geometry.gears.worms.wheel import Side, WormTeeth
from geometry.gears.worms.worm import Worm
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label

# places of the worm in a pitch, planes, shares of a flank, teeth on either side, steps of the golden section
_PLACES, _PLANES, _SHARES, _TEETH, _STEPS = 24, 15, 33, 4, 45
_GOLDEN = (math.sqrt(5) - 1) / 2


class _Flanks:
    """The lower flanks of the wheel's teeth near the worm, in planes, and the worm at a centre distance, mm."""

    def __init__(self, worm: Worm, teeth: WormTeeth, centre_distance: float, side: Side) -> None:
        self.worm, self.teeth, self.distance, self.side = worm, teeth, centre_distance, side
        # a tooth on is a pitch of the worm on
        self.pitches = math.pi * worm.module * np.arange(-_TEETH, _TEETH + 1)[:, None]

    def gap(self, share: Real, slid: Real, off: float) -> Real:
        """Of points at shares (.., teeth, planes) of the flanks from the worm that has slid so far, mm."""
        worm, count = self.worm, self.teeth.number_of_teeth
        cut = self.teeth.flank(self.side, share)
        slid = slid + self.pitches
        angle = math.pi / count - worm.number_of_starts / (worm.parameter * count) * slid
        turned = cut.plane * np.exp(1j * angle)
        x, y, z = self.distance - turned.real, -self.side.heights, -turned.imag
        radius = np.hypot(x, y)
        thread = worm.sign * worm.parameter * np.arctan2(y, x) + slid + off - worm.half_thickness(radius)
        away = thread - z
        slope = worm.flank.slope(radius)
        normal = 1 / np.sqrt(1 + slope**2 + (worm.parameter / radius) ** 2)
        # past its tip there is no thread
        return np.where(radius <= worm.tip_radius, away * normal, np.inf)

    def least(self, slid: Real, off: float) -> tuple[Real, NDArray[np.complex128]]:
        """Least gaps at slides (n,), and where, x + iy of the wheel's axis's frame."""
        s = slid[:, None, None]
        shares = np.linspace(0.0, 1.0, _SHARES)
        table = np.stack([self.gap(np.full((len(slid), len(self.pitches), _PLANES), x), s, off) for x in shares])
        at = np.clip(table.argmin(axis=0), 1, _SHARES - 2)
        low, high = shares[at - 1], shares[at + 1]
        for _ in range(_STEPS):
            one, two = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
            left = self.gap(one, s, off) < self.gap(two, s, off)
            low, high = np.where(left, low, one), np.where(left, two, high)
        share = (low + high) / 2
        gaps = np.minimum(self.gap(share, s, off), table.min(axis=0)).reshape(len(slid), -1)
        best = gaps.argmin(axis=1)
        tooth, plane = best // _PLANES, best % _PLANES
        points = self.teeth.flank(self.side, share).plane[np.arange(len(slid)), tooth, plane]
        return gaps.min(axis=1), points


def worm_contact(
    worm: Worm, teeth: WormTeeth, phase_off: float, distance_off: float, tolerance: float | None
) -> PairContact:
    """Verdict over one pitch of the worm, which stands ``phase_off`` rad about its axis and ``distance_off`` mm off.

    The wheel is the first body, its lower sides stand first in ``side_gaps``.
    """
    allowed = CONTACT_TOLERANCE * worm.module if tolerance is None else tolerance
    distance = teeth.centre_distance + distance_off
    slid = np.linspace(0.0, math.pi * worm.module, _PLACES, endpoint=False)
    off = -worm.sign * worm.parameter * phase_off
    heights = np.linspace(-teeth.width / 2, teeth.width / 2, _PLANES)
    flanks = _Flanks(worm, teeth, distance, teeth.side(heights))
    # the upper sides are the lower ones after half a turn about the line of centres
    found = [flanks.least(way * slid, way * off) for way in (1.0, -1.0)]
    gaps = np.stack([gap for gap, _ in found])
    clearance = min(
        distance - float(teeth.root_radius(0.0)) - worm.tip_radius,
        distance - float(teeth.tip_radius(0.0)) - worm.root_radius,
    )
    rate = worm.number_of_starts / (worm.parameter * teeth.number_of_teeth)
    side, place = np.unravel_index(int(gaps.argmin()), gaps.shape)
    labels = (Label.FLANK, Label.FLANK)
    worst = ContactPlace(float(gaps.min()), float(rate * slid[place]), complex(found[side][1][place]), labels)
    if clearance < worst.gap:
        worst = ContactPlace(clearance, 0.0, complex(distance - worm.tip_radius), (Label.ROOT_LAND, Label.TIP_LAND))
    if not np.all(np.isfinite(gaps)):
        verdict = Verdict.UNDECIDED
    elif worst.gap < -allowed:
        verdict = Verdict.OVERLAP
    else:
        verdict = Verdict.CONTACT if float(gaps.max(axis=1).min()) <= allowed else Verdict.CLEAR
    least = np.minimum(*gaps)
    return PairContact(
        verdict, allowed, tuple((rate * slid).tolist()), tuple(least.tolist()),
        (tuple(gaps[0].tolist()), tuple(gaps[1].tolist())), worst, float(least.max()),
    )  # fmt: skip
