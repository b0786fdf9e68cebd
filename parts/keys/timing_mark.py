"""The key ``timing_mark``: a small hole that shows where the follower stands at cam angle 0."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

from msgspec import Struct

from geometry.base.errors import ParameterError, limit
from geometry.base.nearest import nearest
from geometry.base.record import replace
from geometry.solids.hub_holes import HubHoles, encloses, least_wall
from geometry.solids.windows import RoundHoles
from parts.keys.base import mm, part_mm

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam

# places along the ray that are tried where one is refused
PLACES = 200

_DISTANCE = part_mm("from the axis to its centre; default: between bore and base circle", above=0, example=22.0)


class TimingMarkTable(Struct, forbid_unknown_fields=True):
    """A hole from the axis towards the follower at cam angle 0: the roller's centre, the point, or a flat's normal."""

    diameter: Annotated[float, mm("of the mark", above=0, most=1000, example=3.0)]
    distance: Annotated[float, _DISTANCE] | None = None


def with_timing_mark(holes: HubHoles, table: TimingMarkTable | None, cam: DiskCam, inside: float) -> HubHoles:
    """The holes of a cam and its mark; ``inside``: radius of the circle that is surely material, mm.

    Raises
    ------
    ParameterError
        The mark meets another hole or the edge of the cam; names a distance, or a diameter, that works.
    """
    if table is None:
        return holes
    direction, radius, least = cmath.phase(complex(cam.reference_point(0.0))), table.diameter / 2, least_wall(inside)

    def rooms(distances: Sequence[float]) -> list[float]:
        """Least material about a mark of no size at each distance, mm."""
        return _rooms(holes, [cmath.rect(distance, direction) for distance in distances], inside)

    def room(distance: float) -> float:
        return rooms([distance])[0]

    trials = [inside * (k + 0.5) / PLACES for k in range(PLACES)]
    found = dict(zip(trials, rooms(trials), strict=True))
    best = max(trials, key=lambda distance: found[distance])
    distance = best if table.distance is None else table.distance
    if room(distance) < radius + least:
        fitting = [t for t in trials if found[t] >= radius + least]
        if not fitting:
            # nowhere: refused for its size
            most = limit(2 * (room(distance) - least), table.diameter) if room(distance) > least else None
            raise ParameterError("timing_mark.diameter", table.diameter, "no_room_for_mark", most)
        end = min(fitting, key=lambda t: abs(t - distance))
        cure = lambda: nearest(lambda value: room(value) >= radius + least, distance, end)  # noqa: E731
        raise ParameterError("timing_mark.distance", distance, "mark_meets_hole", cure)
    mark = RoundHoles(1, table.diameter, 2 * distance, direction)
    return replace(holes, round_holes=(*holes.round_holes, mark))


def _rooms(holes: HubHoles, centres: Sequence[complex], inside: float) -> list[float]:
    """Distance from places to the nearest hole or to the circle ``inside``; not above 0 within a hole."""
    import numpy as np

    from geometry.plane.measure import distance_to_profile

    places = np.array(centres)
    found = inside - np.abs(places)
    for profile in holes.profiles():
        distances = distance_to_profile(places, profile)
        found = np.minimum(found, np.where(encloses(profile, places), -distances, distances))
    return found.tolist()
