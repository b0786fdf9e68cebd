"""The part kind ``wedge_cam``: a sliding plate whose upper edge moves a follower."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct
from msgspec.structs import replace

from geometry.base.errors import GeometryError, LateError, Nearest, OffsetError, ParameterError, UndercutError, limit
from geometry.base.findings import Finding
from geometry.base.nearest import Suspect, blamed, nearest
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, circle
from parts.base.kind import Kind, Others, Report
from parts.base.schema import nearest_key, replaced
from parts.keys.base import MOST_LENGTH, MadeKeys, check_idle, part_mm, start
from parts.keys.cam import (
    LAW_AT_REST,
    USUAL_PRESSURE_ANGLE,
    Move,
    Swing,
    check_dwell,
    idle_stroke,
    rough_law,
    steep,
    stroke_key,
    stroke_quantity,
)
from parts.keys.law import LawTable, PhaseLaw, law_of, with_own_laws

if TYPE_CHECKING:
    from geometry.cams.motion.follower_motion import Phase
    from geometry.cams.plane.wedge import Swinging, Upright, WedgeCam, WedgeMotion
    from geometry.curves.curve import Complex
    from geometry.plane.distance import Flags
    from parts.base.readback import Probe

# places along the plate that are tried for a hole
_PLACES = 400
# least wall below the profile and about holes, mm
_LEAST_WALL = 0.05
# shares of a lift, and lengths over a least one, that are tried
_SMALLER = (0.9, 0.75, 0.5, 0.25, 0.1, 0.03, 0.01, 0.001)
_LONGER = (1.0001, 1.001, 1.01, 1.05, 1.2, 1.5, 2.0, 4.0)
# jumps below this part of lift / travel^k are rounding
_JUMP = 1e-9


_START = [{"move": "rise", "travel": 60.0, "law": "sine"}, {"move": "dwell", "travel": 20.0}]


class WedgePhaseTable(Struct, forbid_unknown_fields=True):
    """A phase of the motion over a part of the travel; the follower need not come back."""

    move: Move
    travel: Annotated[float, part_mm("way of the plate in this phase", above=0)]
    law: PhaseLaw | LawTable | None = None
    share: Annotated[float, Meta(gt=0, le=1, description="of the lift, in this phase")] = 1.0


_PIVOT_HEIGHT = part_mm("of the pivot over the plate's lower edge", least=-MOST_LENGTH, example=50.0)
_SIDE = Meta(description="the plate's friction pulls the arm, or pushes it")


class WedgeArmTable(Struct, forbid_unknown_fields=True):
    """A follower that swings about a pivot in the frame."""

    arm_length: Annotated[float, part_mm("from the pivot to the roller's centre", above=0, example=80.0)]
    pivot_height: Annotated[float, _PIVOT_HEIGHT]
    side: Annotated[Literal["trailing", "leading"], _SIDE] = "trailing"


_X = part_mm("along the travel from the follower's starting place", least=-MOST_LENGTH, example=20.0)


class WedgeHoleTable(Struct, forbid_unknown_fields=True):
    """A round hole of the plate."""

    diameter: Annotated[float, part_mm("of the hole", above=0, example=5.0)]
    x: Annotated[float, _X]
    y: Annotated[float, part_mm("above the plate's lower edge", above=0, example=8.0)]


_FOLLOWER = Meta(description="shape of the follower's end; flat cannot", examples=["roller"])


class WedgeCamSpec(MadeKeys, forbid_unknown_fields=True, tag_field="kind", tag="wedge_cam"):
    """Keys of ``wedge_cam``."""

    follower: Annotated[Literal["pointed", "roller", "mushroom", "flat"], _FOLLOWER]
    phases: Annotated[list[WedgePhaseTable], Meta(min_length=1, max_length=100), with_own_laws(_START)]
    base_height: Annotated[float, part_mm("of the plate under the follower at S = 0", above=0, example=15.0)]
    lift: Annotated[float, part_mm("lift H of a sliding follower", least=0), start(20.0)] = 0.0
    swing_deg: Swing = 0.0
    follower_radius: Annotated[float, part_mm("radius of the roller or mushroom", least=0), start(6.0)] = 0.0
    oscillating: WedgeArmTable | None = None
    run_in: Annotated[float, part_mm("straight edge before the travel", above=0)] = 10.0
    run_out: Annotated[float, part_mm("straight edge after the travel", above=0)] = 10.0
    corner_radius: Annotated[float, part_mm("of the plate's corners", least=0)] = 0.0
    holes: WedgeHoleTable | list[WedgeHoleTable] | None = None


def _spare(cam: WedgeCam) -> float:
    """Height of the plate at its lowest place over the least that is left, mm."""
    lowest = min(float(cam.centre(p.extremes(0)).imag.min()) for p in cam.motion.pieces) - cam.radius
    return lowest - _LEAST_WALL - 2 * cam.corner


def _too_low(keys: WedgeCamSpec, cam: WedgeCam) -> ParameterError:
    """The refusal of a plate that is too low for its corners, or for its follower."""
    spare, corner, height = _spare(cam), keys.corner_radius, keys.base_height
    roundings = Suspect("corner_radius", corner, 0.0, lambda value: spare + 2 * (corner - value) > 0)
    if blamed([roundings], "corner_radius") is not None:
        return ParameterError("corner_radius", corner, "no_room_in_plate", limit(corner + spare / 2 - 1e-6, corner))

    # the arm turns with the height
    ends = [height - spare * share for share in _LONGER]

    def is_left(value: float) -> bool:
        return _spare(_wedge_of(replace(keys, base_height=value))) > 0

    def fits(value: float) -> bool:
        return is_left(value) and _fits(replace(keys, base_height=value))

    def cure() -> Nearest | None:
        found = nearest(is_left, height, ends)
        # only where the holes ask for more is the whole plate tried
        if found is not None and isinstance(found.value, float):
            with suppress(GeometryError):
                if fits(found.value):
                    return found
        return nearest(fits, height, ends)

    return ParameterError("base_height", height, "no_plate_under_follower", cure)


def _wedge_of(keys: WedgeCamSpec) -> WedgeCam:
    """The wedge cam of the keys, not yet checked to be whole."""
    from geometry.cams.plane.disk import FollowerKind, check_radius
    from geometry.cams.plane.wedge import WedgeCam, wedge_motion

    if keys.follower == "flat":
        raise ParameterError("follower", keys.follower, "flat_on_wedge")
    swings, radius = keys.oscillating is not None, keys.follower_radius
    check_idle(idle_stroke(keys, swings, tabled=False))
    key, unit = stroke_key(swings)
    lift = getattr(keys, key)
    if not lift > 0:
        raise ParameterError(key, lift, "no_lift")
    kind = FollowerKind(keys.follower)
    try:
        check_radius(kind, radius)
    except ParameterError as refusal:
        raise refusal.renamed("follower_radius") from refusal
    motion = wedge_motion(wedge_phases(keys, lift * unit))
    return WedgeCam(motion, _mount(keys, motion), radius, kind, (keys.run_in, keys.run_out), keys.corner_radius)


def _fits(keys: WedgeCamSpec) -> bool:
    """Whether the profile is whole and leaves a plate below it, with room for the holes."""
    from geometry.cams.plane.wedge import wedge_fault

    cam = _wedge_of(keys)
    if wedge_fault(cam) is not None or not _spare(cam) > 0:
        return False
    _check_holes(keys, cam)
    return True


def wedge_phases(keys: WedgeCamSpec, lift: float) -> list[Phase]:
    """The phases of the keys over the travel, mm; ``lift`` in mm, or rad of an arm.

    Raises
    ------
    ParameterError
        A dwell with a law or a share, or two phases side by side that join.
    """
    from geometry.cams.motion.follower_motion import Phase
    from geometry.cams.motion.joins import with_joins

    made = []
    for index, phase in enumerate(keys.phases):
        place = f"phases[{index + 1}]"
        if phase.move == "dwell":
            check_dwell(phase, index)
            made.append(Phase(phase.travel))
            continue
        change = phase.share * lift if phase.move == "rise" else -phase.share * lift
        made.append(Phase(phase.travel, change, law_of(phase.law, f"{place}.law")))
    return with_joins(made, closed=False)


def _mount(keys: WedgeCamSpec, motion: WedgeMotion) -> Upright | Swinging:
    from geometry.cams.plane.wedge import Swinging, Upright

    height, arm = keys.base_height + keys.follower_radius, keys.oscillating
    if arm is None:
        return Upright(height)
    drop, length = height - arm.pivot_height, arm.arm_length
    if not abs(drop) < length:
        ends = [abs(drop) * share for share in _LONGER]
        cure = partial(nearest_key, keys, "oscillating.arm_length", length, ends, _fits)
        raise ParameterError("oscillating.arm_length", length, "arm_does_not_reach_plate", cure)
    side, start = 1 if arm.side == "trailing" else -1, math.asin(drop / length)
    low, high = motion.extremes()
    if not (start + high < math.pi / 2 and start + low > -math.pi / 2):
        raise ParameterError("swing_deg", keys.swing_deg, "arm_beyond_upright", lambda: _most(keys, "swing_deg"))
    return Swinging(complex(side * length * math.cos(start), arm.pivot_height), length, start, side)


def _most(keys: WedgeCamSpec, key: str) -> Nearest | None:
    """The greatest lift or swing that leaves a whole profile."""
    value: float = getattr(keys, key)
    return nearest_key(keys, key, value, [value * share for share in _SMALLER], _fits)


def _refusal(keys: WedgeCamSpec, cam: WedgeCam, fault: str, travel: float) -> UndercutError:
    """A profile that is not whole, in the scene's keys."""
    from geometry.cams.plane.wedge import sharpest_crest, wedge_fault

    key, unit = stroke_key(keys.oscillating is not None)
    if fault == "corner":

        def calm(place: str) -> bool:
            found = wedge_fault(_wedge_of(replaced(keys, place, LAW_AT_REST)))
            return found is None or found[0] != "corner"

        phases, code = wedge_phases(keys, getattr(keys, key) * unit), "velocity_jumps_at_crest"
        rough = rough_law(keys.phases, phases, calm)
        if rough is None:
            return UndercutError("follower", keys.follower, code, Nearest("pointed"), travel=travel)
        cure = rough.cure(lambda law: _fits(replaced(keys, rough.key, law)))
        return UndercutError(rough.key, rough.law, code, cure, travel=travel)
    if fault == "crest" and keys.oscillating is None:
        most = limit(sharpest_crest(cam) * (1 - 1e-6), cam.radius)
        return UndercutError("follower_radius", cam.radius, "crest_undercut", most, travel=travel)
    code = "runs_with_plate" if fault == "steep" else "plate_undercut"
    return UndercutError(key, getattr(keys, key), code, lambda: _most(keys, key), travel=travel)


def _holes_of(keys: WedgeCamSpec) -> list[WedgeHoleTable]:
    return [keys.holes] if isinstance(keys.holes, WedgeHoleTable) else list(keys.holes or [])


def _check_holes(keys: WedgeCamSpec, cam: WedgeCam) -> None:
    """Every hole stays in the plate and clear of the others."""
    import numpy as np

    from geometry.cams.plane.wedge import wedge_profile
    from geometry.plane.measure import distance_to_profile

    holes, outline = _holes_of(keys), wedge_profile(cam)
    lone = isinstance(keys.holes, WedgeHoleTable)
    for index, hole in enumerate(holes):
        at = complex(hole.x, hole.y)
        room = float(distance_to_profile(np.array([at]), outline)[0])
        key = "holes" if lone else f"holes[{index + 1}]"
        others = [abs(at - complex(h.x, h.y)) - h.diameter / 2 for h in holes[:index]]
        most = 2 * (min([room, *others]) - _LEAST_WALL)
        outside = not _inside(cam, at)
        if outside or (most <= 0 and hole.diameter > most):
            code = "hole_outside_plate" if outside else "no_room_there"
            raise LateError(code, partial(_misplaced, cam, holes[: index + 1], key, outline, code))
        if hole.diameter > most:
            raise ParameterError(f"{key}.diameter", hole.diameter, "hole_reaches_edge", limit(most, hole.diameter))


def _misplaced(cam: WedgeCam, holes: list[WedgeHoleTable], key: str, outline: Profile, code: str) -> ParameterError:
    """The refusal of the last of some holes, which has no room where it is: its place, else its size."""
    *others, hole = holes
    place = _nearest_place(cam, hole, others, outline)
    if code == "hole_outside_plate" or place is not None:
        return ParameterError(f"{key}.x", hole.x, code, None if place is None else Nearest(place), y=hole.y)
    return ParameterError(f"{key}.diameter", hole.diameter, code)


def _nearest_place(cam: WedgeCam, hole: WedgeHoleTable, others: list[WedgeHoleTable], outline: Profile) -> float | None:
    """The x nearest to a hole's at which it has room at its height, mm; None where there is none."""
    import numpy as np

    from geometry.plane.measure import distance_to_profile

    ends = cam.ends
    places = (np.round(np.linspace(*ends, _PLACES), 4) + 1j * hole.y).astype(np.complex128)

    def fit(at: Complex) -> Flags:
        """Where there is room about such places (n,)."""
        room = distance_to_profile(at, outline)
        for other in others:
            room = np.minimum(room, np.abs(at - complex(other.x, other.y)) - other.diameter / 2)
        return room >= hole.diameter / 2 + _LEAST_WALL

    def fits(x: float) -> bool:
        at = complex(x, hole.y)
        return bool(fit(np.array([at]))[0]) and _inside(cam, at)

    near = sorted(places[fit(places)].real, key=lambda x: abs(float(x) - hole.x))
    place = next((float(x) for x in near if _inside(cam, complex(float(x), hole.y))), None)
    if place is None:
        return None
    # between it and the next one, which has none
    step = (ends[1] - ends[0]) / (_PLACES - 1)
    found = nearest(fits, place + math.copysign(min(step, abs(hole.x - place)), hole.x - place), place)
    return place if found is None or not isinstance(found.value, float) else found.value


def _inside(cam: WedgeCam, at: complex) -> bool:
    """Whether a place lies in the plate: between the ends, above the lower edge, below the profile."""
    import numpy as np

    ends = cam.ends
    if not (ends[0] < at.real < ends[1] and at.imag > 0):
        return False
    travel = np.linspace(0, cam.motion.travel, 2049)
    centres = cam.centre(travel)
    normal = 1j * cam.rate(travel)
    edge = centres - cam.radius * normal / np.abs(normal)
    return at.imag < float(np.interp(at.real, edge.real, edge.imag))


def _region(keys: WedgeCamSpec, cam: WedgeCam, offset: float) -> Region:
    """The plate's section, every boundary moved ``offset`` mm out of the material."""
    from geometry.cams.plane.wedge import wedge_profile

    holes = []
    for hole in _holes_of(keys):
        if not hole.diameter / 2 > offset:
            raise OffsetError(offset, "hole_closed", hole.diameter / 2 * (1 - 1e-6))
        holes.append(circle(hole.diameter / 2 - offset, Label.HOLE, hole=True, centre=complex(hole.x, hole.y)))
    return Region(wedge_profile(cam, offset), tuple(holes))


def wedge_quantities(keys: WedgeCamSpec, cam: WedgeCam) -> dict[str, float]:
    """Named results of a wedge: sizes in mm, angles in degrees."""
    import numpy as np

    from geometry.cams.plane.wedge import sharpest_crest

    found = stroke_quantity(cam.motion.lift, swings=keys.oscillating is not None)
    found["travel"] = cam.motion.travel
    if cam.radius > 0:
        found["follower_radius"] = cam.radius
    found["pressure_angle_deg"] = math.degrees(_greatest_pressure_angle(cam))
    crest = sharpest_crest(cam)
    if np.isfinite(crest):
        found["least_curvature_radius"] = crest - cam.radius
    return found


def _greatest_pressure_angle(cam: WedgeCam) -> float:
    from geometry.cams.plane.wedge import steepest

    return max(steepest(cam, sense) or 0.0 for sense in (1, -1))


def wedge_findings(keys: WedgeCamSpec, cam: WedgeCam) -> tuple[Finding, ...]:
    """Impacts where the velocity or the acceleration jumps, and a steep pressure angle."""
    found, pieces, swings = [], cam.motion.pieces, keys.oscillating is not None
    for order, name in ((1, "rigid"), (2, "soft")):
        # the follower rests before and after the travel
        sides = [(float(p.value(p.start, order)), float(p.value(p.end, order))) for p in pieces]
        ends = [0.0, *(end for _, end in sides)]
        starts = [*(start for start, _ in sides), 0.0]
        places = [*(p.start for p in pieces), cam.motion.travel]
        jumps = [(abs(b - a), at) for a, b, at in zip(ends, starts, places, strict=True)]
        size, at = max(jumps)
        if size > _JUMP * cam.motion.lift / cam.motion.travel**order:
            code, unit = ("wedge_swung", math.degrees(1.0)) if swings else ("wedge", 1.0)
            found.append(Finding(f"{code}_{name}_impact", size * unit, at))
            break
    found += steep(math.degrees(_greatest_pressure_angle(cam)), USUAL_PRESSURE_ANGLE[swings])
    return tuple(found)


class Wedge(Kind[WedgeCamSpec, "WedgeCam"]):
    """A plate that slides under its follower."""

    name, keys = "wedge_cam", WedgeCamSpec
    drawing = "parts.cams.drawings"
    data_table = "parts.cams.data_tables"

    def idle(self, keys: WedgeCamSpec, others: Others) -> Iterator[ParameterError]:
        """The travel of another follower."""
        return idle_stroke(keys, keys.oscillating is not None, tabled=False)

    def thing(self, keys: WedgeCamSpec, others: Others) -> WedgeCam:
        """The cam, checked to move its follower all the way, and the plate about it."""
        from geometry.cams.plane.wedge import wedge_fault

        cam = _wedge_of(keys)
        fault = wedge_fault(cam)
        if fault is not None:
            raise _refusal(keys, cam, *fault)
        if not _spare(cam) > 0:
            raise _too_low(keys, cam)
        least = keys.corner_radius + _LEAST_WALL
        for name in ("run_in", "run_out"):
            if not (run := getattr(keys, name)) > least:
                raise ParameterError(name, run, "no_room_for_corner", limit(least * (1 + 1e-6), run))
        _check_holes(keys, cam)
        return cam

    def section(self, keys: WedgeCamSpec, thing: WedgeCam, offset: float) -> OffsetRegion:
        """The plate with its holes."""
        return OffsetRegion(_region(keys, thing, offset), offset, ())

    def report(self, keys: WedgeCamSpec, thing: WedgeCam) -> Report:
        """Sizes and angles, impacts and a steep pressure angle."""
        return Report(wedge_findings(keys, thing), quantities=wedge_quantities(keys, thing))

    def probes(self, keys: WedgeCamSpec, thing: WedgeCam) -> tuple[Probe, ...]:
        """The follower, slid over every file."""
        from parts.cams.probes import SlidingProbe

        return (SlidingProbe(thing, self.height(keys, thing) / 2),)


WEDGE_CAM = Wedge()
