"""The part kind ``wedge_cam``: a sliding plate whose upper edge moves a follower."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct
from msgspec.structs import replace

from geometry.body import plate
from geometry.errors import GeometryError, OffsetError, ParameterError, UndercutError, at_least, at_most
from geometry.offset_region import OffsetRegion
from geometry.profile import Label, Profile, Region, circle
from geometry.trial import is_trial
from parts.cam_keys import Swing, check_dwell, check_stroke
from parts.keys import Colour, Density, FaceWidth, Material, mm
from parts.law_keys import LawName, LawTable, law_of
from parts.materials import density_of
from parts.part import Part
from parts.wedge_report import wedge_findings, wedge_quantities

if TYPE_CHECKING:
    from geometry.cams.follower_motion import Phase
    from geometry.cams.wedge import Swinging, Upright, WedgeCam, WedgeMotion

_MOST = 100_000.0
_BISECTIONS = 40
_RAISES = 12
# a lift or swing below this, mm or degrees, is none
_LEAST_MOTION = 1e-3
# places along the plate that are tried for a hole
_PLACES = 400
# least wall below the profile and about holes, mm
_LEAST_WALL = 0.05


class WedgePhaseTable(Struct, forbid_unknown_fields=True):
    """A phase of the motion over a part of the travel; the follower need not come back."""

    move: Annotated[Literal["rise", "dwell", "return_"], Meta(description="what the follower does")]
    travel: Annotated[float, mm("way of the plate in this phase", above=0, most=_MOST)]
    law: LawName | LawTable | None = None
    share: Annotated[float, Meta(gt=0, le=1, description="of the lift, in this phase")] = 1.0


class WedgeArmTable(Struct, forbid_unknown_fields=True):
    """A follower that swings about a pivot in the frame."""

    arm_length: Annotated[float, mm("from the pivot to the roller's centre", above=0, most=_MOST)]
    pivot_height: Annotated[float, mm("of the pivot over the plate's lower edge", least=-_MOST, most=_MOST)]
    side: Annotated[
        Literal["trailing", "leading"], Meta(description="the plate's friction pulls the arm, or pushes it")
    ] = "trailing"


class WedgeHoleTable(Struct, forbid_unknown_fields=True):
    """A round hole of the plate."""

    diameter: Annotated[float, mm("of the hole", above=0, most=_MOST)]
    x: Annotated[float, mm("along the travel from the follower's starting place", least=-_MOST, most=_MOST)]
    y: Annotated[float, mm("above the plate's lower edge", above=0, most=_MOST)]


class WedgeCamSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="wedge_cam"):
    """Translating cam plate; it slides along -x, the follower starts over x = 0."""

    follower: Annotated[
        Literal["pointed", "roller", "mushroom", "flat"], Meta(description="shape of the follower's end; flat cannot")
    ]
    phases: Annotated[list[WedgePhaseTable], Meta(min_length=1, max_length=100)]
    base_height: Annotated[float, mm("of the plate under the follower at S = 0", above=0, most=_MOST)]
    lift: Annotated[float, mm("lift H of a sliding follower", least=0, most=_MOST)] = 0.0
    swing_deg: Swing = 0.0
    follower_radius: Annotated[float, mm("radius of the roller or mushroom", least=0, most=_MOST)] = 0.0
    oscillating: WedgeArmTable | None = None
    run_in: Annotated[float, mm("straight edge before the travel", above=0, most=_MOST)] = 10.0
    run_out: Annotated[float, mm("straight edge after the travel", above=0, most=_MOST)] = 10.0
    corner_radius: Annotated[float, mm("of the plate's corners", least=0, most=_MOST)] = 0.0
    holes: WedgeHoleTable | list[WedgeHoleTable] | None = None
    face_width: FaceWidth = 10.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_wedge(spec: WedgeCamSpec) -> WedgeCam:
    """The wedge cam of a part, checked to exist and to move its follower all the way.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    from geometry.cams.wedge import wedge_fault

    cam = _wedge_of(spec)
    fault = wedge_fault(cam)
    if fault is not None:
        raise _refusal(spec, cam, *fault)
    if not _spare(spec, cam) > 0:
        found = _high_enough(spec, cam)
        remedy = "less swing works" if found is None else f"at least {at_least(found, 4)} mm works"
        text = f"leaves no plate under the lowest follower; {remedy}"
        raise ParameterError("base_height", spec.base_height, text)
    for name in ("run_in", "run_out"):
        if not getattr(spec, name) > spec.corner_radius + _LEAST_WALL:
            text = f"has no room for corner_radius; at least {at_least(spec.corner_radius + 2 * _LEAST_WALL)} mm works"
            raise ParameterError(name, getattr(spec, name), text)
    _check_holes(spec, cam)
    return cam


def _spare(spec: WedgeCamSpec, cam: WedgeCam) -> float:
    """Height of the plate at its lowest place over the least that is left, mm."""
    lowest = min(float(cam.centre(p.extremes(0)).imag.min()) for p in cam.motion.pieces) - cam.radius
    return lowest - _LEAST_WALL - 2 * spec.corner_radius


def _high_enough(spec: WedgeCamSpec, cam: WedgeCam) -> float | None:
    """A height of the plate that leaves enough of it, by raising it as far as it lacks: the arm turns with it."""
    from geometry.cams.wedge import wedge_fault

    height = spec.base_height
    for _ in range(0 if is_trial() else _RAISES):
        height += 1e-4 - _spare(spec, cam)
        try:
            cam = _wedge_of(replace(spec, base_height=height), told=False)
        except GeometryError:
            return None
        if _spare(spec, cam) > 0:
            return height if wedge_fault(cam) is None else None
    return None


def wedge_part(part_id: str, spec: WedgeCamSpec, cam: WedgeCam) -> Part:
    """The part of a wedge cam; sections are computed when an export asks."""
    section = lru_cache(maxsize=8)(lambda offset: OffsetRegion(_region(spec, cam, offset), offset, ()))
    return Part(
        part_id,
        "wedge_cam",
        section,
        lru_cache(maxsize=2)(lambda offset: plate(section(offset).region, 0.0, spec.face_width)),
        spec.face_width,
        findings=wedge_findings(spec, cam),
        quantities=wedge_quantities(spec, cam),
        material=spec.material,
        colour=spec.colour,
        density=spec.density or density_of(spec.material),
        wedge=cam,
    )


def _wedge_of(spec: WedgeCamSpec, *, told: bool = True) -> WedgeCam:
    """The wedge cam of the keys; not ``told``: a refusal seeks no swing that works, as a search's trial."""
    from geometry.cams.disk import FollowerKind
    from geometry.cams.wedge import WedgeCam

    swing = spec.oscillating
    if spec.follower == "flat":
        text = "rests on a sliding plate by its edge only; roller, mushroom or pointed works"
        raise ParameterError("follower", spec.follower, text)
    check_stroke(spec, swing is not None)
    key, lift = ("swing_deg", spec.swing_deg) if swing else ("lift", spec.lift)
    if not lift > 0:
        raise ParameterError(key, lift, "phases need one above 0")
    if spec.follower == "pointed" and spec.follower_radius != 0:
        raise ParameterError("follower_radius", spec.follower_radius, "a pointed follower has none; 0 works")
    if spec.follower != "pointed" and not spec.follower_radius > 0:
        raise ParameterError("follower_radius", spec.follower_radius, f"a {spec.follower} has a radius above 0")
    motion = _motion(spec, math.radians(lift) if swing else lift)
    mount, runs = _mount(spec, motion, told), (spec.run_in, spec.run_out)
    return WedgeCam(motion, mount, spec.follower_radius, FollowerKind(spec.follower), runs, spec.corner_radius)


def _motion(spec: WedgeCamSpec, lift: float) -> WedgeMotion:
    from geometry.cams.wedge import wedge_motion

    return wedge_motion(wedge_phases(spec, lift))


def wedge_phases(spec: WedgeCamSpec, lift: float) -> list[Phase]:
    """The phases of the keys over the travel, mm; ``lift`` in mm, or rad of an arm.

    Raises
    ------
    ParameterError
        A dwell with a law or a share.
    """
    from geometry.cams.follower_motion import Phase

    made = []
    for index, phase in enumerate(spec.phases):
        place = f"phases.item {index + 1}"
        if phase.move == "dwell":
            check_dwell(phase, index)
            made.append(Phase(phase.travel))
            continue
        change = phase.share * lift if phase.move == "rise" else -phase.share * lift
        made.append(Phase(phase.travel, change, law_of(phase.law, f"{place}.law")))
    return made


def _mount(spec: WedgeCamSpec, motion: WedgeMotion, told: bool) -> Upright | Swinging:
    from geometry.cams.wedge import Swinging, Upright

    height = spec.base_height + spec.follower_radius
    arm = spec.oscillating
    if arm is None:
        return Upright(height)
    drop = height - arm.pivot_height
    if not abs(drop) < arm.arm_length:
        text = f"the arm does not reach the plate; above {at_least(abs(drop))} mm works"
        raise ParameterError("oscillating.arm_length", arm.arm_length, text)
    side, start = 1 if arm.side == "trailing" else -1, math.asin(drop / arm.arm_length)
    low, high = motion.extremes()
    if not (start + high < math.pi / 2 and start + low > -math.pi / 2):
        most = _most(spec, "swing_deg") if told else 0.0
        works = f"at most {at_most(most, 4)} degrees" if most >= _LEAST_MOTION else "another pivot_height or arm_length"
        text = f"the arm swings beyond the upright; {works} works"
        raise ParameterError("swing_deg", spec.swing_deg, text)
    pivot = complex(side * arm.arm_length * math.cos(start), arm.pivot_height)
    return Swinging(pivot, arm.arm_length, start, side)


def _refusal(spec: WedgeCamSpec, cam: WedgeCam, fault: str, travel: float) -> ParameterError:
    """A profile that is not whole, in the scene's keys with what works."""
    from geometry.cams.wedge import sharpest_crest

    if fault == "corner":
        text = (
            f"the velocity jumps at a crest at {travel:.4g} mm of travel; a law without such jumps, or pointed, works"
        )
        return UndercutError("follower", spec.follower, text)
    if fault == "crest":
        most = sharpest_crest(cam)
        if spec.oscillating is None:
            text = f"undercuts the crest at {travel:.4g} mm of travel; at most {at_most(most * (1 - 1e-6), 4)} mm works"
            return UndercutError("follower_radius", cam.radius, text)

    key = "swing_deg" if spec.oscillating else "lift"
    why = "the follower runs along with the plate" if fault == "steep" else "the follower undercuts the plate"
    unit, most = "degrees" if spec.oscillating else "mm", _most(spec, key)
    remedy = f"at most {at_most(most, 4)} {unit} works"
    if most < _LEAST_MOTION:
        remedy = "with this law none is small enough; one without jumps of velocity, or pointed, works"
    text = f"{why} at {travel:.4g} mm of travel; {remedy}"
    return UndercutError(key, getattr(spec, key), text)


def _most(spec: WedgeCamSpec, key: str) -> float:
    """The greatest lift or swing that leaves a whole profile."""
    from geometry.cams.wedge import wedge_fault

    def works(value: float) -> bool:
        try:
            return wedge_fault(_wedge_of(replace(spec, **{key: value}), told=False)) is None
        except GeometryError:
            return False

    low, high = 0.0, float(getattr(spec, key))
    for _ in range(0 if is_trial() else _BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if works(middle) else (low, middle)
    return low


def _holes_of(spec: WedgeCamSpec) -> list[WedgeHoleTable]:
    return [spec.holes] if isinstance(spec.holes, WedgeHoleTable) else list(spec.holes or [])


def _check_holes(spec: WedgeCamSpec, cam: WedgeCam) -> None:
    """Every hole stays in the plate and clear of the others."""
    import numpy as np

    from geometry.measure import distance_to_profile

    holes = _holes_of(spec)
    lone = isinstance(spec.holes, WedgeHoleTable)
    outline = _outline(spec, cam, 0.0)
    for index, hole in enumerate(holes):
        at = complex(hole.x, hole.y)
        room = float(distance_to_profile(np.array([at]), outline)[0])
        key = "holes" if lone else f"holes.item {index + 1}"
        if not _inside(cam, spec, at):
            place = _nearest_place(cam, spec, hole, holes[:index], outline)
            works = "another y works" if place is None else f"{place:.4f} works"
            text = f"the hole's centre at y = {hole.y:g} lies outside the plate; {works}"
            raise ParameterError(f"{key}.x", hole.x, text)
        others = [abs(at - complex(h.x, h.y)) - h.diameter / 2 for k, h in enumerate(holes) if k < index]
        most = 2 * (min([room, *others]) - _LEAST_WALL)
        if hole.diameter > most:
            text = f"meets the edge or another hole; at most {at_most(most, 4)} mm works"
            if most <= 0:
                place = _nearest_place(cam, spec, hole, holes[:index], outline)
                text = "has no room there; a smaller one elsewhere works"
                if place is not None:
                    raise ParameterError(f"{key}.x", hole.x, f"the hole has no room there; {place:.4f} works")
            raise ParameterError(f"{key}.diameter", hole.diameter, text)


def _nearest_place(
    cam: WedgeCam, spec: WedgeCamSpec, hole: WedgeHoleTable, others: list[WedgeHoleTable], outline: Profile
) -> float | None:
    """The x nearest to a hole's at which it has room at its height, mm; None where there is none."""
    import numpy as np

    from geometry.measure import distance_to_profile

    if is_trial():
        return None
    ends = float(cam.centre(0.0).real) - spec.run_in, float(cam.centre(cam.motion.travel).real) + spec.run_out
    places = (np.round(np.linspace(*ends, _PLACES), 4) + 1j * hole.y).astype(np.complex128)
    room = distance_to_profile(places, outline)
    for other in others:
        room = np.minimum(room, np.abs(places - complex(other.x, other.y)) - other.diameter / 2)
    fitting = places[room > hole.diameter / 2 + 1.01 * _LEAST_WALL]
    near = sorted(fitting.real, key=lambda x: abs(float(x) - hole.x))
    return next((float(x) for x in near if _inside(cam, spec, complex(float(x), hole.y))), None)


def _inside(cam: WedgeCam, spec: WedgeCamSpec, at: complex) -> bool:
    """Whether a place lies in the plate: between the ends, above the lower edge, below the profile."""
    import numpy as np

    ends = float(cam.centre(0.0).real) - spec.run_in, float(cam.centre(cam.motion.travel).real) + spec.run_out
    if not (ends[0] < at.real < ends[1] and at.imag > 0):
        return False
    travel = np.linspace(0, cam.motion.travel, 2049)
    centres = cam.centre(travel)
    normal = 1j * cam.rate(travel)
    edge = centres - cam.radius * normal / np.abs(normal)
    return at.imag < float(np.interp(at.real, edge.real, edge.imag))


def _outline(spec: WedgeCamSpec, cam: WedgeCam, offset: float) -> Profile:
    from geometry.cams.wedge import wedge_profile

    return wedge_profile(cam, (spec.run_in, spec.run_out), spec.corner_radius, offset)


def _region(spec: WedgeCamSpec, cam: WedgeCam, offset: float) -> Region:
    """The plate's section, every boundary moved ``offset`` mm out of the material."""
    holes = []
    for hole in _holes_of(spec):
        if not hole.diameter / 2 > offset:
            raise OffsetError(offset, "closes a hole", hole.diameter / 2 * (1 - 1e-6))
        holes.append(circle(hole.diameter / 2 - offset, Label.HOLE, hole=True, centre=complex(hole.x, hole.y)))
    return Region(_outline(spec, cam, offset), tuple(holes))
