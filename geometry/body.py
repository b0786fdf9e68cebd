"""Solids of upright, twisted and chamfered walls between plane caps: exact boundary loops at given heights.

A body knows its boundary as a kernel does: loops (a closed profile at a height), walls between two loops,
and caps bounded by loops. Meshes, B-reps, read-back and mass integrals all go through this one description.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from geometry.curve import Real
from geometry.profile import Profile, Region


@dataclass(frozen=True, slots=True)
class Twist:
    """How a toothed wall turns: ``rate`` rad/mm, right-hand screws positive; ``double``: back from the middle on."""

    rate: float
    double: bool = False

    def stations(self, low: float, high: float) -> tuple[tuple[float, float], ...]:
        """Heights and turns between which the wall is one screw surface, mm and rad; not turned at its lower end."""
        if not self.double:
            return (low, 0.0), (high, self.rate * (high - low))
        return (low, 0.0), ((low + high) / 2, self.rate * (high - low) / 2), (high, 0.0)


@dataclass(frozen=True, slots=True)
class Loop:
    """A closed profile (index into ``Body.profiles``) at height z, mm, turned by ``turn`` rad about the axis."""

    profile: int
    z: float
    turn: float = 0.0


@dataclass(frozen=True, slots=True)
class Wall:
    """The wall between two loops (indices): upright where both have one profile and one turn.

    One profile with two turns makes a screw surface: its section at any height is the profile, turned in proportion to
    the height. Two profiles make a ruled wall, which joins points of equal share of matching segments; its profiles
    have equal segments, and neither is turned.
    """

    lower: int
    upper: int


@dataclass(frozen=True, slots=True)
class Cap:
    """A plane face looking up or down: its outer loop and its holes (indices)."""

    outer: int
    holes: tuple[int, ...]
    up: bool


@dataclass(frozen=True, slots=True)
class Body:
    """A solid. Every profile runs with the material of its wall on the left; loops are distinct."""

    profiles: tuple[Profile, ...]
    loops: tuple[Loop, ...]
    walls: tuple[Wall, ...]
    caps: tuple[Cap, ...]

    def loop_profile(self, loop: int) -> Profile:
        """The exact boundary of a loop."""
        return self.profiles[self.loops[loop].profile]

    def is_upright(self, wall: Wall) -> bool:
        """Whether a wall stands upright on one profile."""
        return not self.is_ruled(wall) and self.twist(wall) == 0

    def is_ruled(self, wall: Wall) -> bool:
        """Whether a wall is ruled between two profiles."""
        return self.loops[wall.lower].profile != self.loops[wall.upper].profile

    def twist(self, wall: Wall) -> float:
        """Angle by which a wall turns from its lower to its upper loop, rad."""
        return self.loops[wall.upper].turn - self.loops[wall.lower].turn

    def twisted_profiles(self) -> frozenset[int]:
        """The profiles (indices) that some wall twists."""
        return frozenset(self.loops[w.lower].profile for w in self.walls if not self.is_ruled(w) and self.twist(w))

    def steepness(self) -> float:
        """How far a boundary may move sideways for a step along the axis on screw surfaces: their tan(beta)."""
        rates = [abs(self.twist(w)) / (b - a) for w in self.walls for a, b in [self.height(w)] if not self.is_ruled(w)]
        return max(rates, default=0.0) * max(p.reach() for p in self.profiles)

    def turn_at(self, wall: Wall, z: ArrayLike) -> Real:
        """Turn of a wall's section at heights z, rad; a ruled wall is not turned."""
        low, high = self.height(wall)
        share = (np.asarray(z, dtype=float) - low) / (high - low)
        return self.loops[wall.lower].turn + share * self.twist(wall)

    def height(self, wall: Wall) -> tuple[float, float]:
        """Lower and upper z of a wall, mm."""
        return self.loops[wall.lower].z, self.loops[wall.upper].z

    def levels(self) -> tuple[float, ...]:
        """All heights at which loops stand, ascending, mm."""
        return tuple(sorted({loop.z for loop in self.loops}))

    def reach(self) -> float:
        """Greatest coordinate, mm: what the rounding of a file's numbers goes by."""
        return max(*(p.reach() for p in self.profiles), *(abs(loop.z) for loop in self.loops))

    def groups(self) -> Iterator[tuple[int, ...]]:
        """Profiles that ruled walls join, each group once; their approximations need equal vertices."""
        leader = list(range(len(self.profiles)))
        for wall in self.walls:
            a, b = sorted((leader[self.loops[wall.lower].profile], leader[self.loops[wall.upper].profile]))
            leader = [a if x == b else x for x in leader]
        for first in sorted(set(leader)):
            yield tuple(i for i, x in enumerate(leader) if x == first)


@dataclass(slots=True)
class BodyBuilder:
    """Collects the walls and caps of a body; equal profiles and equal loops are kept once."""

    profiles: list[Profile] = field(default_factory=list)
    loops: dict[Loop, int] = field(default_factory=dict)
    walls: list[Wall] = field(default_factory=list)
    caps: list[Cap] = field(default_factory=list)

    def loop(self, profile: Profile, z: float, turn: float = 0.0) -> int:
        """Index of the loop of a profile at a height, mm, and a turn, rad."""
        place = next((i for i, p in enumerate(self.profiles) if p is profile), len(self.profiles))
        if place == len(self.profiles):
            self.profiles.append(profile)
        return self.loops.setdefault(Loop(place, z, turn), len(self.loops))

    def wall(self, lower: int, upper: int) -> None:
        """A wall between two loops."""
        self.walls.append(Wall(lower, upper))

    def run(self, profile: Profile, stations: Sequence[tuple[float, float]]) -> tuple[int, int]:
        """Walls of one profile through heights and turns, mm and rad; returns the loops at both ends."""
        loops = [self.loop(profile, z, turn) for z, turn in stations]
        for lower, upper in pairwise(loops):
            self.wall(lower, upper)
        return loops[0], loops[-1]

    def cap(self, outer: int, holes: list[int], *, up: bool) -> None:
        """A plane face."""
        self.caps.append(Cap(outer, tuple(holes), up))

    def body(self) -> Body:
        """What was collected."""
        return Body(tuple(self.profiles), tuple(self.loops), tuple(self.walls), tuple(self.caps))


def plate(
    region: Region, bottom: float, top: float, twist: Twist | None = None, *, toothed: Profile | None = None
) -> Body:
    """A region extruded from z = ``bottom`` to ``top`` mm; its ``toothed`` boundary follows a twist."""
    made = BodyBuilder()
    upright = (bottom, 0.0), (top, 0.0)
    ends = [
        made.run(p, twist.stations(bottom, top) if twist is not None and p is toothed else upright)
        for p in (region.outer, *region.holes)
    ]
    made.cap(ends[0][0], [lower for lower, _ in ends[1:]], up=False)
    made.cap(ends[0][1], [upper for _, upper in ends[1:]], up=True)
    return made.body()
