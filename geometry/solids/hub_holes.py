"""All holes of a wheel inside its root circle: bore, round holes, windows between spokes; what is left between them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from geometry.base.errors import OffsetError, ParameterError
from geometry.base.nearest import kept
from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Arc
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile
from geometry.solids.bores import Bore, RoundBore

if TYPE_CHECKING:
    from geometry.plane.distance import Flags
    from geometry.solids.windows import RoundHoles, Spokes

_INSIDE = 1 - 1e-6
# mm, and for the smallest wheels as a part of their radius
_LEAST_WALL, _LEAST_WALL_SHARE = 0.05, 0.005


def least_wall(root_radius: float) -> float:
    """Thinnest wall between two boundaries of a wheel, mm: thinner ones neither cut nor print."""
    return min(_LEAST_WALL, _LEAST_WALL_SHARE * root_radius)


class Wall(NamedTuple):
    """Material between two boundaries: its least thickness, mm, the key to blame where there is none, and why."""

    thickness: float
    key: str
    value: object
    code: str
    numbers: Mapping[str, float] = MappingProxyType({})

    def refusal(self, least: float = 0.0) -> ParameterError:
        """Of the key, where the wall is not above ``least`` mm."""
        if self.thickness <= 0:
            return ParameterError(self.key, self.value, self.code, **self.numbers)
        return ParameterError(self.key, self.value, f"{self.code}_nearly", **self.numbers, least=least)


class HubHoles(Record):
    """Holes of a wheel; a bore about the axis, groups of round holes, and spokes."""

    bore: Bore | None = None
    round_holes: tuple[RoundHoles, ...] = ()
    spokes: Spokes | None = None

    @property
    def bore_reach(self) -> float:
        """Greatest distance of the bore from the axis, mm; 0 where there is none."""
        return 0.0 if self.bore is None else self.bore.reach

    @property
    def reach(self) -> float:
        """Greatest distance of any hole from the axis, mm."""
        windows = 0.0 if self.spokes is None else self.spokes.reach
        return max(self.bore_reach, windows, *(group.reach for group in self.round_holes))

    def profiles(self, offset: float = 0.0) -> tuple[Profile, ...]:
        """Clockwise boundaries of all holes, moved ``offset`` mm out of the material, the bore first.

        Raises
        ------
        OffsetError
            A hole closes, loses a curve, or meets its neighbour.
        """
        made: list[Profile] = []
        refusals: list[OffsetError] = []
        for of_part in self._makers():
            try:
                made += of_part(offset)
            except OffsetError as refusal:
                refusals.append(refusal)
        if offset < 0:
            thinnest = min((w.thickness for w in self._walls_between()), default=math.inf)
            if -2 * offset >= thinnest:
                refusals.append(OffsetError(offset, "no_wall_between_holes", -thinnest / 2 * _INSIDE))
        if refusals:
            raise min(refusals, key=lambda r: abs(r.nearest_offset))
        return tuple(made)

    def beside_bore(self) -> tuple[float, float]:
        """Least and greatest distance from the axis of the holes beside the bore, mm; (inf, 0) where there are none."""
        spans = [(group.pitch_circle_diameter / 2 - group.diameter / 2, group.reach) for group in self.round_holes]
        if self.spokes is not None:
            spans.append((self.spokes.inner_diameter / 2, self.spokes.reach))
        return min((s[0] for s in spans), default=math.inf), max((s[1] for s in spans), default=0.0)

    @property
    def number(self) -> int:
        """How many holes there are."""
        windows = 0 if self.spokes is None else self.spokes.count
        return (self.bore is not None) + sum(group.count for group in self.round_holes) + windows

    def widened(self, depth: float) -> HubHoles:
        """Every hole ``depth`` mm larger on all sides; sharp corners stay sharp: the edges of a chamfer.

        Raises
        ------
        OffsetError
            No wall is left between two holes.
        """
        if 2 * depth >= min((w.thickness for w in self._walls_between()), default=math.inf):
            raise OffsetError(-depth, "no_wall_between_holes")
        return HubHoles(
            None if self.bore is None else self.bore.widened(depth),
            tuple(replace(group, diameter=group.diameter + 2 * depth) for group in self.round_holes),
            None if self.spokes is None else self.spokes.widened(depth),
        )

    def _makers(self) -> list[Callable[[float], tuple[Profile, ...]]]:
        """What makes the profiles of each group, the bore first."""
        makers: list[Callable[[float], tuple[Profile, ...]]] = []
        if (bore := self.bore) is not None:
            makers.append(lambda offset: (bore.profile(offset),))
        makers += [group.profiles for group in self.round_holes]
        if (spokes := self.spokes) is not None:
            makers.append(spokes.profiles)
        return makers

    def check(self, root_radius: float) -> None:
        """Refuse holes that cannot exist, meet one another or the root circle (mm).

        Raises
        ------
        ParameterError
            With the key, its value and why; what would work is for the caller to find.
        """
        if self.bore is not None:
            self.bore.check()
        for key, group in self.groups():
            group.check(key)
        if self.spokes is not None:
            self.spokes.check("spokes")
        least = least_wall(root_radius)
        for wall in itertools.chain(self._rims(root_radius), self._walls_between()):
            # a round bore may leave as thin a rim as it likes
            plain = wall.code == "bore_reaches_root_circle" and isinstance(self.bore, RoundBore)
            if not wall.thickness > (0.0 if plain else least):
                raise wall.refusal(least)

    def fits(self, root_radius: float) -> bool:
        """Whether ``check`` finds no fault."""
        return kept(self.check, root_radius)

    def groups(self) -> list[tuple[str, RoundHoles]]:
        """Groups of round holes with the names of their tables."""
        lone = len(self.round_holes) == 1
        return [("holes" if lone else f"holes[{i + 1}]", g) for i, g in enumerate(self.round_holes)]

    def _rims(self, root_radius: float) -> list[Wall]:
        """What is left below the root circle."""
        root = {"diameter": 2 * root_radius}
        walls = []
        if self.bore is not None:
            walls.append(Wall(root_radius - self.bore.reach, *self.bore.size, "bore_reaches_root_circle", root))
        for key, group in self.groups():
            size = group.pitch_circle_diameter
            blamed = f"{key}.pitch_circle_diameter", size
            walls.append(Wall(root_radius - group.reach, *blamed, "holes_reach_root_circle", root))
        if (spokes := self.spokes) is not None:
            blamed = "spokes.outer_diameter", spokes.outer_diameter
            walls.append(Wall(root_radius - spokes.reach, *blamed, "windows_reach_root_circle", root))
        return walls

    def _walls_between(self) -> Iterator[Wall]:
        """What is left between holes, one by one: of many groups the first that meet are enough."""
        groups = self.groups()
        for key, group in groups:
            here = f"{key}.diameter", group.diameter
            yield Wall(group.wall_between(), *here, "holes_touch_each_other")
            if self.bore is not None:
                yield Wall(_wall(group, group.centres(), self.bore.profile()), *here, "holes_touch_bore")
            if (spokes := self.spokes) is not None:
                # of all windows the one in whose sector a centre stands is nearest to it
                folded = [spokes.folded(c) for c in group.centres()]
                yield Wall(_wall(group, folded, spokes.profiles()[0]), *here, "holes_touch_window")
        placed = [(key, group, np.array(group.centres())) for key, group in groups]
        for (_, first, theirs), (key, second, own) in itertools.combinations(placed, 2):
            thickness = float(np.abs(theirs[:, None] - own).min()) - (first.diameter + second.diameter) / 2
            yield Wall(thickness, f"{key}.diameter", second.diameter, "holes_touch_another_group")
        if (spokes := self.spokes) is not None:
            yield Wall(spokes.width, "spokes.width", spokes.width, "leaves_no_spoke")
            if self.bore is not None:
                hub = spokes.inner_diameter / 2 - self.bore.reach
                yield Wall(hub, "spokes.inner_diameter", spokes.inner_diameter, "windows_touch_bore")


def _wall(group: RoundHoles, centres: list[complex], other: Profile) -> float:
    """Least material between round holes about ``centres`` and another hole, mm; not positive where they meet."""
    radius = group.diameter / 2
    places = np.array(centres)
    distances = distance_to_profile(places, other)
    swallowed = (distances > radius) & encloses(other, places)
    return float(np.where(swallowed, -distances, distances).min()) - radius


def encloses(profile: Profile, points: Complex) -> Flags:
    """Whether a closed profile of lines and arcs runs round each of points (n,) that are not on it."""
    turns = np.add.reduce([_seen_turn(s.curve, points) for s in profile.segments()])
    return np.asarray(np.abs(turns) > math.pi)


def _seen_turn(curve: Curve, points: Complex) -> Real:
    """Angles by which a line or arc turns about points, rad."""
    pieces = 1 + int(abs(curve.sweep) / (math.pi / 2)) if isinstance(curve, Arc) else 1
    joints = curve.point(np.linspace(*curve.domain, pieces + 1))
    spokes = joints - points[:, None]
    total = np.angle(spokes[:, 1:] * np.conj(spokes[:, :-1]))
    if isinstance(curve, Arc):
        # between chord and arc the chord is on the wrong side of the point
        sense = math.copysign(1.0, curve.sweep)
        beyond = sense * (-spokes[:, :-1] * np.conj(np.diff(joints))).imag < 0
        within = np.abs(points - curve.centre) < curve.radius
        total = total + sense * 2 * math.pi * (beyond & within[:, None])
    return np.asarray(total.sum(axis=1))


class Holed(Protocol):
    """A wheel that exists: what lies within its roots, mm."""

    @property
    def root_radius(self) -> float:
        """Of the largest circle within its outline, mm."""

    @property
    def holes(self) -> HubHoles:
        """Bore and holes."""
