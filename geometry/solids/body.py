"""Solids of upright, twisted and chamfered walls between plane caps: exact boundary loops at given heights.

A body knows its boundary as a kernel does: loops (a closed profile at a height), walls between two loops,
and caps bounded by loops. Meshes, B-reps, read-back and mass integrals all go through this one description.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.placement import Placement2
from geometry.base.record import Draft, Record, field, replace
from geometry.base.tolerance import PRECISION
from geometry.curves.curve import Complex, Real
from geometry.plane.measure import profile_area
from geometry.plane.profile import Profile, Region

# height, mm, turn, rad, and shift, mm, of a section
Station = tuple[float, float, complex]


class Twist(Record):
    """How a toothed wall moves along the axis: it turns by ``rate`` rad/mm and is sheared by ``slope`` mm/mm.

    Right-hand screws turn positively. ``double``: back from the middle of the height on.
    """

    rate: float = 0.0
    double: bool = False
    slope: complex = 0j

    def stations(self, low: float, high: float, cuts: tuple[float, float] = (0.0, 0.0)) -> tuple[Station, ...]:
        """Stations between which the wall is one screw surface; neither turned nor moved at its lower end.

        ``cuts``: how far, mm, it begins above that end and ends below the upper one.
        """
        begin, end, middle = low + cuts[0], high - cuts[1], (low + high) / 2
        places = (begin, middle, end) if self.double and begin < middle < end else (begin, end)
        moved = [min(z - low, high - z) if self.double else z - low for z in places]
        return tuple((z, self.rate * by, self.slope * by) for z, by in zip(places, moved, strict=True))


class Loop(Record):
    """A closed profile (index into ``Body.profiles``) at height z, turned by ``turn`` rad, moved by ``shift``; mm."""

    profile: int
    z: float
    turn: float = 0.0
    shift: complex = 0j

    @property
    def placement(self) -> Placement2:
        """How the profile lies in its plane."""
        return Placement2(self.turn, self.shift)


class Wall(Record):
    """The wall between two loops (indices): upright where both have one profile in one placement.

    One profile with two turns makes a screw surface: its section at any height is the profile, turned in proportion to
    the height; one with two shifts is sheared. Two profiles make a chamfer, and both are in one placement: in its plane
    ``section(z)`` is the exact profile at a height from the lower to the upper loop, mm, segment for segment that of
    both.
    """

    lower: int
    upper: int
    section: Callable[[float], Profile] | None = None


class Cap(Record):
    """A plane face looking up or down: its outer loop and its holes (indices)."""

    outer: int
    holes: tuple[int, ...]
    up: bool


class Body(Record, dict=True):
    """A solid. Every profile runs with the material of its wall on the left; loops are distinct."""

    profiles: tuple[Profile, ...]
    loops: tuple[Loop, ...]
    walls: tuple[Wall, ...]
    caps: tuple[Cap, ...]
    is_faced: ClassVar[Literal[False]] = False
    precision: ClassVar[float] = PRECISION

    def loop_profile(self, loop: int) -> Profile:
        """The exact boundary of a loop."""
        return self.profiles[self.loops[loop].profile]

    def is_upright(self, wall: Wall) -> bool:
        """Whether a wall stands upright on one profile."""
        return not self.is_chamfer(wall) and self.twist(wall) == 0 and self.shear(wall) == 0

    def is_screw(self, wall: Wall) -> bool:
        """Whether a wall has one profile that turns or moves along its height."""
        return not self.is_chamfer(wall) and not self.is_upright(wall)

    def is_chamfer(self, wall: Wall) -> bool:
        """Whether a wall runs from one profile to another."""
        return self.loops[wall.lower].profile != self.loops[wall.upper].profile

    def chamfers(self) -> Iterator[tuple[Wall, int, int]]:
        """The chamfers, each with its loop of the whole boundary and that of its end, which has less material."""
        for wall in self.walls:
            if self.is_chamfer(wall):
                ends = wall.lower, wall.upper
                upwards = profile_area(self.loop_profile(wall.lower)) > profile_area(self.loop_profile(wall.upper))
                yield (wall, *(ends if upwards else ends[::-1]))

    def section_at(self, wall: Wall, whole: int, end: int, share: float) -> Profile:
        """The section of a chamfer at a share of its depth between its loops."""
        return self.section(wall, (1 - share) * self.loops[whole].z + share * self.loops[end].z)

    def section(self, wall: Wall, z: float) -> Profile:
        """The exact section of an upright wall or a chamfer at a height within it, mm."""
        return self.loop_profile(wall.lower) if wall.section is None else wall.section(z)

    def standing(self, wall: Wall, z: float) -> Profile:
        """The same in the place of the wall."""
        place, profile = self.loops[wall.lower], self.section(wall, z)
        return profile.placed(place.placement) if place.turn or place.shift else profile

    def twist(self, wall: Wall) -> float:
        """Angle by which a wall turns from its lower to its upper loop, rad."""
        return self.loops[wall.upper].turn - self.loops[wall.lower].turn

    def shear(self, wall: Wall) -> complex:
        """By how much a wall's profile moves from its lower to its upper loop, mm."""
        return self.loops[wall.upper].shift - self.loops[wall.lower].shift

    def has_screws(self) -> bool:
        """Whether some wall is a screw surface or sheared."""
        return any(self.is_screw(w) for w in self.walls)

    def twisted_profiles(self) -> frozenset[int]:
        """The profiles (indices) that some wall twists."""
        return frozenset(self.loops[w.lower].profile for w in self.walls if self.is_screw(w) and self.twist(w))

    def steepness(self) -> float:
        """How far a boundary moves sideways for a step along the axis on screw surfaces: their tan(beta)."""
        found = [0.0]
        for wall in self.walls:
            low, high = self.height(wall)
            moved = abs(self.twist(wall)) * self.loop_profile(wall.lower).reach() + abs(self.shear(wall))
            found.append(0.0 if self.is_chamfer(wall) else moved / (high - low))
        return max(found)

    def turn_at(self, wall: Wall, z: ArrayLike) -> Real:
        """Turn of a wall's section at heights z, rad."""
        return self.loops[wall.lower].turn + self._share(wall, z) * self.twist(wall)

    def shift_at(self, wall: Wall, z: ArrayLike) -> Complex:
        """Shift of a wall's section at heights z, mm."""
        return np.asarray(self.loops[wall.lower].shift + self._share(wall, z) * self.shear(wall))

    def moved_back(self, wall: Wall, points: Real) -> Complex:
        """Points (n, 3) of a wall in the plane of its profile, (n,): each by the placement at its own height."""
        z = points[:, 2]
        places = points[:, 0] + 1j * points[:, 1] - self.shift_at(wall, z)
        return np.asarray(places * np.exp(-1j * self.turn_at(wall, z)))

    def _share(self, wall: Wall, z: ArrayLike) -> Real:
        low, high = self.height(wall)
        return np.asarray((np.asarray(z, dtype=float) - low) / (high - low))

    def section_reach(self) -> float:
        """Greatest distance of a boundary from the axis, mm."""
        return max(self.profiles[loop.profile].reach() + abs(loop.shift) for loop in self.loops)

    def height(self, wall: Wall) -> tuple[float, float]:
        """Lower and upper z of a wall, mm."""
        return self.loops[wall.lower].z, self.loops[wall.upper].z

    def raised(self, height: float) -> Body:
        """The same, which has no chamfers, so much higher, mm."""
        return replace(self, loops=tuple(replace(loop, z=loop.z + height) for loop in self.loops))

    def levels(self) -> tuple[float, ...]:
        """All heights at which loops stand, ascending, mm."""
        return tuple(sorted({loop.z for loop in self.loops}))

    def reach(self) -> float:
        """Greatest coordinate, mm: what the rounding of a file's numbers goes by."""
        return max(self.section_reach(), *(abs(loop.z) for loop in self.loops))

    def groups(self) -> Iterator[tuple[int, ...]]:
        """Profiles that chamfers join, each group once; their approximations need equal vertices."""
        leader = list(range(len(self.profiles)))
        for wall in self.walls:
            a, b = sorted((leader[self.loops[wall.lower].profile], leader[self.loops[wall.upper].profile]))
            if a != b:
                leader = [a if x == b else x for x in leader]
        groups: dict[int, list[int]] = {}
        for index, first in enumerate(leader):
            groups.setdefault(first, []).append(index)
        yield from map(tuple, groups.values())


class BodyBuilder(Draft):
    """Collects the walls and caps of a body; equal profiles and equal loops are kept once."""

    profiles: list[Profile] = field(default_factory=list)
    loops: dict[Loop, int] = field(default_factory=dict)
    walls: list[Wall] = field(default_factory=list)
    caps: list[Cap] = field(default_factory=list)
    # numbers of the profiles by what they are, not by what they equal
    numbers: dict[int, int] = field(default_factory=dict)

    def loop(self, profile: Profile, z: float, turn: float = 0.0, shift: complex = 0j) -> int:
        """Index of the loop of a profile at a height, mm, turned (rad) and moved (mm)."""
        place = self.numbers.setdefault(id(profile), len(self.profiles))
        if place == len(self.profiles):
            self.profiles.append(profile)
        return self.loops.setdefault(Loop(place, z, turn, shift), len(self.loops))

    def wall(self, lower: int, upper: int, section: Callable[[float], Profile] | None = None) -> None:
        """A wall between two loops; a chamfer has its ``section``."""
        self.walls.append(Wall(lower, upper, section))

    def run(self, profile: Profile, stations: Sequence[Station]) -> tuple[int, int]:
        """Walls of one profile through heights, turns and shifts; returns the loops at both ends."""
        loops = [self.loop(profile, *station) for station in stations]
        for lower, upper in pairwise(loops):
            self.wall(lower, upper)
        return loops[0], loops[-1]

    def upright(self, profile: Profile, low: float, high: float) -> tuple[int, int]:
        """An upright wall of one profile; returns its loops."""
        return self.run(profile, ((low, 0.0, 0j), (high, 0.0, 0j)))

    def cap(self, outer: int, holes: list[int], *, up: bool) -> None:
        """A plane face."""
        self.caps.append(Cap(outer, tuple(holes), up))

    def body(self) -> Body:
        """What was collected."""
        return Body(tuple(self.profiles), tuple(self.loops), tuple(self.walls), tuple(self.caps))


def opened(body: Body, top: float) -> tuple[BodyBuilder, Cap]:
    """A body to go on with, without its largest upper face at z = ``top`` mm, and that face.

    Raises
    ------
    ValueError
        The body has no face there.
    """
    faces = [c for c in body.caps if c.up and body.loops[c.outer].z == top]
    if not faces:
        raise ValueError(f"there is no upper face at {top} mm")
    face = max(faces, key=lambda c: body.loop_profile(c.outer).reach())
    caps = [c for c in body.caps if c is not face]
    loops, numbers = {x: i for i, x in enumerate(body.loops)}, {id(p): i for i, p in enumerate(body.profiles)}
    return BodyBuilder(list(body.profiles), loops, list(body.walls), caps, numbers), face


def plate(
    region: Region, bottom: float, top: float, twist: Twist | None = None, *, toothed: Profile | None = None
) -> Body:
    """A region extruded from z = ``bottom`` to ``top`` mm; its ``toothed`` boundary follows a twist."""
    if twist is not None and not any(p is toothed for p in (region.outer, *region.holes)):
        raise ValueError("the toothed boundary is none of the region's")
    made = BodyBuilder()
    ends = [
        made.run(p, twist.stations(bottom, top)) if twist is not None and p is toothed else made.upright(p, bottom, top)
        for p in (region.outer, *region.holes)
    ]
    made.cap(ends[0][0], [lower for lower, _ in ends[1:]], up=False)
    made.cap(ends[0][1], [upper for _, upper in ends[1:]], up=True)
    return made.body()
