"""Checks of a scene: pairs on exact curves through one whole pitch, and what instances placed by hand must satisfy."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from msgspec.structs import asdict

from geometry.base.record import Record, replace
from geometry.base.tolerance import PLACED_MM
from parts.base.mate import Mating, Toothed, Touching
from parts.base.part import Part
from parts.base.texts import words
from parts.scene.instances import DriveSpec
from parts.scene.placing import Closeness, PlacedMate, Placing
from parts.scene.standing import Instance
from parts.texts.checks import CLOSE, OFF_CENTRE, called, condition_message, overlap_told
from parts.texts.findings import findings_told

if TYPE_CHECKING:
    from geometry.gears.mesh.search import PairContact
    from parts.base.mate import Frames
    from parts.scene.steps import StepSpec
    from parts.scene.train import Train
    from parts.scene.workspace import Struck


class _Teller(Record):
    """Tells of instances in a language, by what sentences call them."""

    language: str
    names: Mapping[str, str]

    def text(self, msgid: str, **numbers: object) -> str:
        """A sentence; instances among its numbers by their names."""
        return words(self.language).text(msgid, **called(numbers, self.names))


# what is farther apart is no fit, mm
_FIT = 0.5
# of a sector on its way, poses in a turn
_STEPS_A_TURN = 16
# mates that run no gears in each other: of these transmission error is not asked
_WITHOUT_TEETH = ("fixed", "coaxial", "carried", "parallel", "pin_seat", "eccentric_bearing")


def scene_checks(
    placing: Placing,
    parts: dict[str, Part],
    drives: Sequence[DriveSpec],
    language: str,
    *,
    contact: bool,
    transmission: bool = False,
    workspace: int | None = None,
    steps: Sequence[StepSpec] = (),
    names: Mapping[str, str] = MappingProxyType({}),
) -> dict[str, Any]:
    """All that is known of how a scene's instances stand to each other.

    ``contact``: interference of the pairs too; ``transmission``: and their transmission error; ``workspace``: solids
    wherever the drives may stand, each pair in so many poses at most; ``steps``: the order of assembly to be held;
    ``names`` of instances that sentences call otherwise than by their ids.
    """
    checks: dict[str, Any] = {}
    told = _Teller(language, names)
    if placing.mates:
        checks["mates"] = [_mate(m, told, contact=contact) for m in placing.mates]
        for found, mate in zip(checks["mates"], placing.mates, strict=True):
            if transmission:
                _add_transmission(found, mate)
            _add_driven(found, mate, placing.train, told)
    if placing.mates and (alone := [i.id for i in placing.instances if i.placed_by == "row"]):
        checks["in_a_row"] = alone
    if placing.close:
        checks["neighbours"] = [_neighbours(c, told) for c in placing.close]
    if placing.off_centre:
        rows = [asdict(one) for one in placing.off_centre]
        checks["axles"] = [{**row, "text": told.text(OFF_CENTRE, **row)} for row in rows]
    if contact and len(placing.instances) > 1:
        checks |= _solids(placing, parts, drives, told, workspace)
    if steps:
        from exporters.production.order import order_checks

        checks["order"] = order_checks(steps, placing, parts, language)
    if placing.train is not None:
        checks["drives"] = [
            {"instance": d.instance, "turns": d.turns, "train": train, **({"travel": slid} if slid else {})}
            for d, train, slid in zip(drives, placing.turns, placing.train.slid, strict=True)
        ]
    return checks


def _add_driven(found: dict[str, Any], mate: PlacedMate, train: Train | None, told: _Teller) -> None:
    """What a pair does on the way that its drive goes, or as it stands."""
    turns = [abs(turned) for turned in train.rolled(mate.mating) if turned] if train is not None else []
    if turns and isinstance(mate.mating, Touching):
        # contact is held against a whole pitch, whatever part of it the drive runs through
        found["driven_pitches"] = turns[0] * mate.mating.teeth[0]
    if way := _way(mate, train, max(turns, default=0.0)):
        if left := mate.mating.driven(*way):
            found["findings"] = [*found.get("findings", ()), *findings_told(told.language, left)]
        for code, numbers in mate.mating.blocked(*way).items():
            found.setdefault("conditions", []).append(_condition(code, False, numbers, mate, told))


def pair_quantities(mating: Mating) -> dict[str, Any]:
    """What the calculation of a pair says, lengths in mm."""
    return {
        "kind": mating.kind,
        "first": mating.first,
        "second": mating.second,
        "direction_deg": mating.direction_deg,
        **mating.quantities(),
    }


def check_pair(
    mating: Mating,
    language: str,
    *,
    second_turn: float = 0.0,
    centre_shift: float = 0.0,
    tolerance: float | None = None,
) -> dict[str, Any]:
    """The quantities of a pair and its verdict: least gap, where, at which drive angle.

    ``second_turn`` (rad) and ``centre_shift`` (mm): how far the pair stands off the exact one; ``tolerance`` in mm.
    """
    found = _contact(mating, second_turn, centre_shift, tolerance)
    if found is None:
        return _told_alone(mating, language)
    worst, told = found.worst, pair_quantities(mating)
    if "roller_clearance" in told:
        # a groove holds its roller from both sides
        told["walls"] = {k: [min(g), max(g)] for k, g in zip(("inner", "outer"), found.side_gaps, strict=True)}
    return {
        **told,
        "verdict": found.verdict.value,
        "tolerance": found.tolerance,
        "gap": worst.gap,
        "greatest_gap": found.greatest_gap,
        **_where(mating, worst.drive_angle),
        "point": [worst.point.real, worst.point.imag],
        "labels": [label.value for label in worst.labels],
        "findings": findings_told(language, mating.findings()),
    }


def _told_alone(mating: Mating, language: str) -> dict[str, Any]:
    """A pair whose contact is not sought."""
    findings = findings_told(language, mating.findings())
    return pair_quantities(mating) | ({"findings": findings} if findings else {})


def _contact(mating: Mating, phase: float, shift: float, tolerance: float | None) -> PairContact | None:
    """The contact of a pair; one of gears that stands as another one did is held once."""
    if not (isinstance(mating, Toothed) and mating.pair):
        return mating.contact(phase, shift, tolerance)
    alike = replace(mating, first="", second="", direction_deg=0.0)
    # what rounding leaves is no difference
    return gear_contact(alike, round(phase, 13), round(shift, 10), tolerance)


@lru_cache(maxsize=16)
def gear_contact(mating: Mating, phase: float, shift: float, tolerance: float | None) -> PairContact | None:
    """The contact of a pair, which equal ones share."""
    return mating.contact(phase, shift, tolerance)


def _where(mating: Mating, drive: float) -> dict[str, float]:
    """Where the first one stands: its turn, or the travel of a plate that slides."""
    return {"drive_travel": drive} if mating.kind == "wedge_follower" else {"drive_angle_deg": math.degrees(drive)}


def _mate(mate: PlacedMate, told: _Teller, *, contact: bool) -> dict[str, Any]:
    """A mate as its instances stand; contact is sought where its conditions hold."""
    if not (contact and all(c.met for c in mate.conditions)):
        found = _told_alone(mate.mating, told.language)
    elif mate.only_checks:
        module = mate.mating.module if isinstance(mate.mating, Touching) else 0.0
        allowed = max(PLACED_MM, 1e-8 * module)
        off = {"second_turn": mate.second_turn, "centre_shift": mate.centre_shift}
        found = check_pair(mate.mating, told.language, tolerance=allowed, **off)
    else:
        found = check_pair(mate.mating, told.language)
    found["direction_deg"] = math.degrees(mate.direction)
    found["second_rotation_deg"] = math.degrees(mate.second.rotation)
    asked = [
        (one.code, one.met, {key: getattr(one, key) for key in ("value", "required", "tolerance")})
        for one in mate.conditions
    ]
    asked += [(code, False, numbers) for code, numbers in mate.mating.broken(mate.direction).items()]
    if asked:
        found["conditions"] = [_condition(*one, mate, told) for one in asked]
    return found


def _way(mate: PlacedMate, train: Train | None, turns: float) -> tuple[Frames, Frames] | None:
    """The frames of two that touch where the drives run as far as the scene asks, or as they stand; None: nobody asks.

    ``turns`` of the first: so fine are the steps on the way that each tells how it has turned.
    """
    if not isinstance(mate.mating, Touching) or (train is None and not mate.mating.stands_in_mesh):
        return None
    import numpy as np

    if train is None:
        frames = (one.scene_from_part for one in (mate.first, mate.second))
        first, second = ((np.array([f.rotation]), np.array([f.translation])) for f in frames)
        return first, second
    t = np.linspace(0.0, 1.0, 2 + math.ceil(_STEPS_A_TURN * turns) * mate.mating.stands_in_mesh)
    first, second = (train.placed(one.id, t) for one in (mate.first, mate.second))
    return first, second


def _add_transmission(found: dict[str, Any], mate: PlacedMate) -> None:
    """The transmission error of gears in mesh: nothing where the conditions are broken."""
    if not (isinstance(mate.mating, Toothed) and mate.mating.pair):
        if mate.mating.kind not in _WITHOUT_TEETH:
            found["transmission_error"] = None
    elif all(c.met for c in mate.conditions):
        found["transmission_error"] = mate.mating.transmission_error(mate.centre_shift)


def _condition(code: str, met: bool, numbers: Mapping[str, float], mate: PlacedMate, told: _Teller) -> dict[str, Any]:
    first, second = (told.names.get(one.id, one.id) for one in (mate.first, mate.second))
    text = words(told.language).say(condition_message(code, first, second, **numbers))
    return {"code": code, "met": met, **numbers, "text": text}


def _neighbours(close: Closeness, told: _Teller) -> dict[str, Any]:
    both, distance, limit = {"first": close.first, "second": close.second}, close.distance, close.tip_sum
    text = told.text(CLOSE, **both, value=distance, limit=limit)
    return {**both, "distance": distance, "sum_of_tip_radii": limit, "text": text}


def _solids(
    placing: Placing, parts: dict[str, Part], drives: Sequence[DriveSpec], told: _Teller, workspace: int | None
) -> dict[str, Any]:
    """Solids as they stand, then on the way that the drives move them, or wherever these may stand."""
    from parts.scene.interference import by_contact, has_solid_pairs, solid_overlaps
    from parts.scene.shapes import shape_of

    shapes = {name: shape_of(parts[name]) for name in dict.fromkeys(i.part for i in placing.instances)}
    fits: list[tuple[Instance, Instance, float]] = []
    overlaps = solid_overlaps(placing, parts, fits)
    solids = [_overlap(o.first, o.second, o.volume, told) for o in overlaps]
    checks: dict[str, Any] = {}
    known = {frozenset((o.first, o.second)) for o in overlaps}
    if placing.train is not None and workspace is not None:
        from parts.scene.workspace import workspace_found

        all_over = workspace_found(placing, shapes, by_contact(placing, parts), known, workspace)
        solids += [_struck(x, drives, told) for x in all_over.struck]
        checks["workspace"] = {
            "rest": all_over.rest,
            "tested": all_over.tested,
            "poses": all_over.motion.poses,
            "uncovered": [asdict(x) for x in all_over.motion.uncovered],
            "fits": _fits(fits),
        }
    elif placing.train is not None:
        from parts.scene.moving_solids import motion_found
        from parts.scene.relative_path import course_of
        from parts.scene.workspace import never_meeting

        course = course_of(placing.train, [i.id for i in placing.instances])
        apart = never_meeting(placing, shapes, by_contact(placing, parts))
        found = motion_found(placing, shapes, course, known, apart)
        solids += [_overlap(x.first, x.second, x.volume, told, drives[0], x.time) for x in found.struck]
        checks["motion"] = {
            "pairs": found.pairs,
            "tested": found.tested,
            "poses": found.poses,
            "uncovered": [asdict(x) for x in found.uncovered],
        }
    elif has_solid_pairs(placing, parts):
        checks["motion"] = {"one_pose": True}
    return {"solids": solids, **checks} if solids else checks


def _fits(found: Sequence[tuple[Instance, Instance, float]]) -> list[dict[str, Any]]:
    """What half sections tell of seats and balls in grooves: by two parts, how many pairs, and their clearances, mm."""
    rows: dict[tuple[str, str], list[float]] = {}
    for one, two, gap in found:
        if gap <= _FIT:
            rows.setdefault((one.part, two.part), []).append(gap)
    return [
        {"parts": list(key), "pairs": len(gaps), "touching": gaps.count(0.0), "least": min(gaps), "greatest": max(gaps)}
        for key, gaps in rows.items()
    ]


def _struck(struck: Struck, drives: Sequence[DriveSpec], told: _Teller) -> dict[str, Any]:
    """Two solids in each other where the drives have turned so far."""
    found = _overlap(struck.first, struck.second, struck.volume, told)
    if struck.volume is None:
        return found
    turns = {drive.instance: 360.0 * turned for drive, turned in zip(drives, struck.turns, strict=True)}
    found["drive_turns_deg"] = turns
    return found | {"text": overlap_told(found, words(told.language), told.names)}


def _overlap(
    first: str, second: str, volume: float | None, told: _Teller, drive: DriveSpec | None = None, share: float = 0.0
) -> dict[str, Any]:
    """Two solids in each other, as they stand or where a drive has run a share of what it is asked for."""
    found: dict[str, Any] = {"first": first, "second": second, "volume": volume}
    if volume is not None and drive is not None and drive.travel is not None:
        found["drive_travel"] = share * drive.travel
    elif volume is not None and drive is not None:
        found["drive_turn_deg"] = 360.0 * share * drive.turns
    found["verdict"] = "undecided" if volume is None else "overlap"
    driven = "" if drive is None else drive.instance
    return found | {"text": overlap_told(found, words(told.language), told.names, driven)}
