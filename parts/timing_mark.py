"""The key ``timing_mark``: a small hole that shows where the follower stands at cam angle 0."""

from __future__ import annotations

import cmath
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

from msgspec import Struct

from geometry.errors import ParameterError, at_most
from geometry.hub_holes import HubHoles, encloses, least_wall
from geometry.windows import RoundHoles
from parts.keys import mm

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam

# places along the ray that are tried where one is refused
_TRIALS = 200


class TimingMarkTable(Struct, forbid_unknown_fields=True):
    """A hole from the axis towards the follower at cam angle 0: the roller's centre, the point, or a flat's normal."""

    diameter: Annotated[float, mm("of the mark", above=0, most=1000)]
    distance: (
        Annotated[float, mm("from the axis to its centre; default: between bore and base circle", above=0, most=1e5)]
        | None
    ) = None


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

    def room(distance: float) -> float:
        """Least material about a mark of no size, mm."""
        return _room(holes, cmath.rect(distance, direction), inside)

    trials = [inside * (k + 0.5) / _TRIALS for k in range(_TRIALS)]
    best = max(trials, key=room)
    if table.distance is None and room(best) < radius + least:
        remedy = f"finds no room inside the base circle; at most {at_most(2 * (room(best) - least), 4)} mm works"
        if not room(best) > least:
            remedy = "finds no room between the holes and the base circle; a larger base_circle_radius works"
        raise ParameterError("timing_mark.diameter", table.diameter, remedy)
    distance = best if table.distance is None else table.distance
    if room(distance) < radius + least:
        fitting = [t for t in trials if room(t) >= radius + least]
        if not fitting:
            # refused for its size
            return with_timing_mark(holes, TimingMarkTable(table.diameter), cam, inside)
        nearest = float(f"{min(fitting, key=lambda t: abs(t - distance)):.4f}")
        remedy = f"the mark meets the edge or another hole; {nearest if room(nearest) >= radius + least else best} mm"
        raise ParameterError("timing_mark.distance", distance, f"{remedy} works")
    mark = RoundHoles(1, table.diameter, 2 * distance, direction)
    return replace(holes, round_holes=(*holes.round_holes, mark))


def _room(holes: HubHoles, centre: complex, inside: float) -> float:
    """Distance from a place to the nearest hole or to the circle ``inside``; not above 0 within a hole."""
    import numpy as np

    from geometry.measure import distance_to_profile

    found = inside - abs(centre)
    for profile in holes.profiles():
        distance = float(distance_to_profile(np.array([centre]), profile)[0])
        found = min(found, -distance if encloses(profile, centre) else distance)
    return found
