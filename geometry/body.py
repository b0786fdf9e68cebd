"""Solids of upright and chamfered walls between plane caps: exact boundary loops at given heights.

A body knows its boundary as a kernel does: loops (a closed profile at a height), walls between two loops,
and caps bounded by loops. Meshes, B-reps, read-back and mass integrals all go through this one description.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from geometry.profile import Profile, Region


@dataclass(frozen=True, slots=True)
class Loop:
    """A closed profile (index into ``Body.profiles``) at height z, mm."""

    profile: int
    z: float


@dataclass(frozen=True, slots=True)
class Wall:
    """The wall between two loops (indices): upright where both have one profile, else ruled.

    A ruled wall joins points of equal share of matching segments; its profiles have equal segments.
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
        return self.loops[wall.lower].profile == self.loops[wall.upper].profile

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

    def loop(self, profile: Profile, z: float) -> int:
        """Index of the loop of a profile at a height, mm."""
        place = next((i for i, p in enumerate(self.profiles) if p is profile), len(self.profiles))
        if place == len(self.profiles):
            self.profiles.append(profile)
        return self.loops.setdefault(Loop(place, z), len(self.loops))

    def wall(self, lower: int, upper: int) -> None:
        """A wall between two loops."""
        self.walls.append(Wall(lower, upper))

    def cap(self, outer: int, holes: list[int], *, up: bool) -> None:
        """A plane face."""
        self.caps.append(Cap(outer, tuple(holes), up))

    def body(self) -> Body:
        """What was collected."""
        return Body(tuple(self.profiles), tuple(self.loops), tuple(self.walls), tuple(self.caps))


def plate(region: Region, bottom: float, top: float) -> Body:
    """A region extruded from z = ``bottom`` to ``top`` mm."""
    made = BodyBuilder()
    ends = [(made.loop(p, bottom), made.loop(p, top)) for p in (region.outer, *region.holes)]
    for lower, upper in ends:
        made.wall(lower, upper)
    made.cap(ends[0][0], [lower for lower, _ in ends[1:]], up=False)
    made.cap(ends[0][1], [upper for _, upper in ends[1:]], up=True)
    return made.body()
