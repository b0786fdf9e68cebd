"""How a worm and its wheel stand to each other over one pitch: least gaps of their exact surfaces, in sections.

In every plane across the wheel's axis the wheel's flank is held against the worm where it is, along the worm's normal;
the least gap of a flank is sought from a grid by the golden section. Where the axes stand off their places flanks and
fillets are held, the worm in the middle of its play; the places about the least gap of a side are then narrowed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from geometry.base.errors import rounded
from geometry.base.record import Record, replace
from geometry.base.tolerance import CONTACT_TOLERANCE
from geometry.curves.curve import Complex, Indices, Real
from geometry.curves.line_arc import Arc
from geometry.gears.mesh.search import ContactPlace, PairContact, first_least, told_contact, verdict_of
from geometry.gears.worms.hob import Cut
from geometry.gears.worms.thread import Thread
from geometry.gears.worms.wheel import Side, WormTeeth
from geometry.gears.worms.worm import Worm
from geometry.plane.profile import Label

# places of the worm in a pitch, planes, shares of a flank, teeth on either side, steps of the golden section
_PLACES, _PLANES, _SHARES, _TEETH, _STEPS = 24, 15, 33, 4, 45
_GOLDEN = (math.sqrt(5) - 1) / 2
# how often the places about a least gap are narrowed, and to how many; how often the middle of the play is sought, and
# how near in modules; angles and heights of lands
_NARROWED, _FEW, _ROUNDS, _MIDDLE, _LANDS = 4, 7, 8, 1e-9, 101
# how often a thicker hob is tried
_THICKENED = 4


class AxisErrors(Record):
    """How far the axes stand off their places: ``centre_distance`` mm too large; ``angle``, rad, by which the worm's
    axis rises about the line of centres; ``axial``, mm, by which the wheel's middle stands above the worm's axis.
    """

    centre_distance: float = 0.0
    angle: float = 0.0
    axial: float = 0.0

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return self != AxisErrors()


_RIGHT = AxisErrors()


class _Flanks:
    """The lower flanks, or fillets, of the wheel's teeth near the worm, in planes, and the worm in its place.

    ``fillet``: the worm's, where it counts too.
    """

    def __init__(
        self, worm: Worm, teeth: WormTeeth, distance: float, side: Side, errors: AxisErrors = _RIGHT,
        part: Callable[[Side, Real], Cut] | None = None, fillet: Arc | None = None,
    ) -> None:  # fmt: skip
        self.worm, self.teeth, self.side, self.fillet = worm, teeth, side, fillet
        self.distance, self.errors = distance + errors.centre_distance, errors
        self.part = teeth.flank if part is None else part
        # a tooth on is a pitch of the worm on
        self.pitches = math.pi * worm.module * np.arange(-_TEETH, _TEETH + 1)[:, None]

    def placed(self, share: Real, slid: Real) -> Complex:
        """Points at shares (.., teeth, planes) where the wheel stands with the worm slid so far, worm along +x, mm."""
        worm, count = self.worm, self.teeth.number_of_teeth
        angle = math.pi / count - worm.number_of_starts / (worm.parameter * count) * (slid + self.pitches)
        return np.asarray(self.part(self.side, share).plane * np.exp(1j * angle))

    def gap(self, share: Real, slid: Real, off: float) -> Real:
        """Of points at shares (.., teeth, planes) of the flanks from the worm that has slid so far, mm."""
        worm, turned = self.worm, self.placed(share, slid)
        slid = slid + self.pitches
        x, y, z = _of_worm(turned, self.side.heights, self.distance, self.errors)
        radius = np.hypot(x, y)
        thread = worm.sign * worm.parameter * np.arctan2(y, x) + slid + off - worm.half_thickness(radius)
        away = thread - z
        slope = worm.flank.slope(radius)
        normal = 1 / np.sqrt(1 + slope**2 + (worm.parameter / radius) ** 2)
        # past its tip there is no thread
        gap = np.where(radius <= worm.tip_radius, away * normal, np.inf)
        if self.fillet is not None:
            spoke = radius + 1j * (away + worm.half_thickness(radius)) - self.fillet.centre
            lean = np.hypot(1.0, spoke.imag / np.abs(spoke) * worm.parameter / radius)
            low = complex(self.fillet.point(self.fillet.domain[1])).real
            free = np.where(spoke.imag < 0, (self.fillet.radius - np.abs(spoke)) / lean, radius - worm.root_radius)
            gap = np.where(radius < low, np.minimum(gap, free), gap)
        return np.asarray(gap)

    def least(self, slid: Real, off: float) -> tuple[Real, Complex, Indices]:
        """Least gaps at slides (n,), where, x + iy about the wheel's axis, and in which planes."""
        planes = len(self.side.heights)
        s = slid[:, None, None]
        shares = np.linspace(0.0, 1.0, _SHARES)
        table = np.stack([self.gap(np.full((len(slid), len(self.pitches), planes), x), s, off) for x in shares])
        at = np.clip(table.argmin(axis=0), 1, _SHARES - 2)
        low, high = shares[at - 1], shares[at + 1]
        one, two = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        gap_one, gap_two = self.gap(one, s, off), self.gap(two, s, off)
        for _ in range(_STEPS):
            left = gap_one < gap_two
            low, high = np.where(left, low, one), np.where(left, two, high)
            # the nearer of both places is one of the next two
            near, gap_near = np.where(left, one, two), np.where(left, gap_one, gap_two)
            new = np.where(left, high - _GOLDEN * (high - low), low + _GOLDEN * (high - low))
            gap_new = self.gap(new, s, off)
            one, two = np.where(left, new, near), np.where(left, near, new)
            gap_one, gap_two = np.where(left, gap_new, gap_near), np.where(left, gap_near, gap_new)
        share = (low + high) / 2
        gaps = np.minimum(self.gap(share, s, off), table.min(axis=0)).reshape(len(slid), -1)
        best = gaps.argmin(axis=1)
        tooth, plane = best // planes, best % planes
        points = self.placed(share, s)[np.arange(len(slid)), tooth, plane]
        return gaps.min(axis=1), points, plane


def _of_worm(turned: Complex, heights: Real, distance: float, errors: AxisErrors) -> tuple[Real, Real, Real]:
    """Places in planes across the wheel's axis, which faces the worm, in the frame of the worm, mm."""
    x, y, z = distance - turned.real, -(heights + errors.axial), -turned.imag
    sine, cosine = math.sin(errors.angle), math.cos(errors.angle)
    return (x, y * cosine + z * sine, z * cosine - y * sine) if sine else (x, y, z)


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
    clearance = min(
        distance - float(teeth.root_radius(0.0)) - worm.tip_radius,
        distance - float(teeth.tip_radius(0.0)) - worm.root_radius,
    )
    gaps, points = np.stack([side[0] for side in found]), np.stack([side[1] for side in found])
    return _told(worm, teeth, allowed, slid, gaps, points, clearance, distance)


def _told(
    worm: Worm, teeth: WormTeeth, allowed: float, slid: Real, gaps: Real, points: Complex, clearance: float,
    distance: float,
) -> PairContact:  # fmt: skip
    """The verdict on gaps of both sides (2, n) at slides and the points where they are, and on that of the lands.

    Points of the second side are those of its image under half a turn about the line of centres.
    """
    rate = worm.number_of_starts / (worm.parameter * teeth.number_of_teeth)
    side, place = np.unravel_index(first_least(gaps), gaps.shape)
    labels = (Label.FLANK, Label.FLANK)
    worst = ContactPlace(float(gaps.min()), float(rate * slid[place]), complex(points[side, place]), labels)
    if side == 1:
        worst = replace(worst, point=worst.point.conjugate())
    if clearance < worst.gap:
        worst = ContactPlace(clearance, 0.0, complex(distance - worm.tip_radius), (Label.ROOT_LAND, Label.TIP_LAND))
    return told_contact(verdict_of(gaps.T, allowed, worst.gap), allowed, rate * slid, gaps.T, worst)


@lru_cache(maxsize=4)
def contact_under(thread: Thread, teeth: WormTeeth, errors: AxisErrors, tolerance: float | None) -> PairContact:
    """Verdict over one pitch where the axes stand off their places, the worm turned into the middle of its play."""
    worm = thread.worm
    allowed = CONTACT_TOLERANCE * worm.module if tolerance is None else tolerance
    slid = np.linspace(0.0, math.pi * worm.module, _PLACES, endpoint=False)
    # the teeth lead a wheel that stands too high round by so much
    off = turn_for(teeth, errors) * -worm.sign * worm.parameter
    steep = math.cos(worm.lead_angle) * math.cos(worm.pressure_angle)
    before = math.inf
    for _ in range(_ROUNDS):
        # the upper sides are the lower ones after half a turn about the line of centres
        found = [_side(thread, teeth, replace(errors, axial=way * errors.axial), way * slid, way * off)
                 for way in (1.0, -1.0)]  # fmt: skip
        gaps, points = np.stack([gap for gap, _ in found]), np.stack([at for _, at in found])
        # of Python's numbers two that are infinite differ by nan in silence
        ahead = float(gaps[1].min()) - float(gaps[0].min())
        # what stands in the worm's core comes no nearer to its middle by a turn
        if not min(abs(ahead), abs(ahead - before)) > _MIDDLE * worm.module or not math.isfinite(ahead):
            break
        before = ahead
        off += ahead / (2 * steep)
    distance = teeth.centre_distance + errors.centre_distance
    return _told(worm, teeth, allowed, slid, gaps, points, _lands(worm, teeth, errors), distance)


def clearing_thinning(thread: Thread, teeth: WormTeeth) -> tuple[float, float] | None:
    """How deep teeth of a larger hob run into the worm, and how much thicker threads of the hob clear it, mm.

    None: they do not, or no thicker hob clears them.
    """
    worm, allowed = thread.worm, CONTACT_TOLERANCE * thread.worm.module
    deep, radii = -contact_under(thread, teeth, _RIGHT, None).worst.gap, np.array([worm.form_radius, worm.tip_radius])
    # how much less than along the axis a gap grows along the normal
    lean = float(np.sqrt(1 + worm.flank.slope(radii) ** 2 + (worm.parameter / radii) ** 2).max())
    thinning, gap = -teeth.hob.worm.thinning, -deep
    for _ in range(_THICKENED):
        if gap >= -allowed:
            break
        thinning = rounded(thinning - 2 * lean * gap, up=True)
        thinner = replace(teeth, hob=replace(teeth.hob, worm=replace(teeth.hob.worm, thinning=-thinning)))
        thinner = thinner if thinner.ended is None else thinner.narrowed()
        gap = contact_under(thread, thinner, _RIGHT, None).worst.gap
    return (deep, thinning) if deep > allowed and gap >= -allowed else None


def turn_for(teeth: WormTeeth, errors: AxisErrors) -> float:
    """By how much the worm is turned for its wheel's height, rad."""
    pitch_radius = teeth.centre_distance - teeth.hob.worm.module * teeth.number_of_teeth / 2
    return -errors.axial / pitch_radius


def _side(thread: Thread, teeth: WormTeeth, errors: AxisErrors, slid: Real, off: float) -> tuple[Real, Complex]:
    """Least gaps of the lower side at slides, flanks and fillets, and where; about the least of all narrowed."""
    arc = next((line for name, line in thread.lines if name == "fillet" and isinstance(line, Arc)), None)
    found = list[tuple[Real, Complex]]()
    for part in (teeth.flank, teeth.fillet):
        places, heights = slid, np.linspace(-teeth.width / 2, teeth.width / 2, _PLANES)
        whole: tuple[Real, Complex] | None = None
        for _ in range(_NARROWED):
            flanks = _Flanks(thread.worm, teeth, teeth.centre_distance, teeth.side(heights), errors, part, arc)
            gaps, points, planes = flanks.least(places, off)
            at = first_least(gaps)
            if whole is None:
                whole, place = (gaps, points), at
            elif gaps[at] < whole[0][place]:
                whole[0][place], whole[1][place] = gaps[at], points[at]
            # slides come again after a pitch: those about the first lie before it
            step, plane = abs(places[1] - places[0]), int(planes[at])
            places = np.linspace(places[at] - step, places[at] + step, _FEW)
            heights = np.linspace(heights[max(plane - 1, 0)], heights[min(plane + 1, len(heights) - 1)], _FEW)
        assert whole is not None
        found.append(whole)
    (gaps, points), (others, beside) = found
    nearer = others < gaps
    return np.where(nearer, others, gaps), np.where(nearer, beside, points)


def _lands(worm: Worm, teeth: WormTeeth, errors: AxisErrors) -> float:
    """The least gap of the worm's tips from the wheel's roots, and of the wheel's tips from its root, mm."""
    heights = np.linspace(-teeth.width / 2, teeth.width / 2, _LANDS)
    reach = math.acos(min((teeth.centre_distance - worm.tip_radius) / teeth.outer_radius, 1.0))
    turns = np.exp(1j * np.linspace(-reach, reach, _LANDS))[:, None]
    gaps = []
    for radius, beside in (
        (teeth.root_radius(heights), worm.tip_radius),
        (teeth.tip_radius(heights), worm.root_radius),
    ):
        distance = teeth.centre_distance + errors.centre_distance
        x, y, _ = _of_worm(radius * turns, heights, distance, errors)
        gaps.append(float(np.hypot(x, y).min()) - beside)
    return min(gaps)
