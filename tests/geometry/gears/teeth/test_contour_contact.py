"""What the contour's interference lines say, seen in the contact of the exact outlines on either side of them."""

from __future__ import annotations

import math

import pytest

from geometry.gears.mesh.gears import GearMesh
from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.shifts.external import (
    ContourLine,
    Requirements,
    ShiftPair,
    blocking_contour,
    conditions,
    state_of,
    usual_box,
)
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_rack
from geometry.plane.distance import Verdict

# how far beside a line the two sides are compared, in x: violations grow with the square of the distance
BAND = 1e-3
# rounding of a gap, in modules
NOTHING = 2e-12
FEW = [(13, 21, "A")]
MANY = [(z1, z2, rack) for rack in "ABCD" for z1, z2 in ((10, 10), (13, 21), (17, 40), (20, 30), (25, 60), (12, 80))]


def built(pair: ShiftPair, point: complex) -> ExternalPair:
    """The pair at two shifts, module 1; of helical teeth the transverse section."""
    point *= math.cos(pair.helix_angle)
    one, two = (SpurGear(1.0, z, pair.rack, x)
                for z, x in zip(pair.teeth, (point.real, point.imag), strict=True))  # fmt: skip
    return external_pair(one, two)


def sides(pair: ShiftPair, line: ContourLine, index: int) -> tuple[complex, complex]:
    """Points ``BAND`` inside and outside of a line, across it."""
    who = line.name.rsplit("_", 1)[1]
    margin = conditions(pair)[f"active_flank_{who}"].margin
    point = line.points[index]
    along = line.points[index + 1] - line.points[index - 1]
    step = 1j * BAND * along / abs(along)
    inside, outside = point + step, point - step
    if margin(inside.real, inside.imag) < 0:
        inside, outside = outside, inside
    assert margin(inside.real, inside.imag) > 0 > margin(outside.real, outside.imag)
    return inside, outside


def clear_of_the_rest(pair: ShiftPair, line: ContourLine, point: complex) -> bool:
    """Whether the pair works but for the line's own condition: only then its contact tells of that line alone."""
    state = state_of(pair, point.real, point.imag)
    other = "second" if line.name.endswith("first") else "first"
    flank = conditions(pair)[f"active_flank_{other}"].margin(point.real, point.imag)
    return min(state.tip_thicknesses) > 0.05 and state.contact_ratio - pair.overlap_ratio > 1.05 and flank > 0.01


def compare(pair: ShiftPair, most: int) -> dict[str, int]:
    """How many points of each kind of line told the two sides apart."""
    box = usual_box(pair, 24)
    assert box is not None
    names = ["active_flank_first", "active_flank_second"]
    contour = blocking_contour(pair, Requirements(), box, 1e-2, names)
    seen: dict[str, int] = {}
    for line in contour.lines:
        kind = line.name.rsplit("_", 1)[0]
        inner = range(1, len(line.points) - 1)
        usable = [k for k in inner if clear_of_the_rest(pair, line, line.points[k])]
        for k in usable[:: max(1, len(usable) // most)][:most]:
            inside, outside = (built(pair, p) for p in sides(pair, line, k))
            assert inside.effective_contact_ratio == pytest.approx(inside.contact_ratio, abs=1e-9)
            touching = GearMesh(inside).contact()
            assert touching.verdict is Verdict.CONTACT
            assert touching.worst.gap > -NOTHING
            # flank that is missing costs contact ratio; a fillet in its place is struck
            assert outside.effective_contact_ratio < outside.contact_ratio - 1e-7
            if kind == "fillet_interference":
                # second order: with a flat margin the overlap may be less than a verdict's tolerance
                assert GearMesh(outside).contact().worst.gap < -NOTHING
            seen[kind] = seen.get(kind, 0) + 1
    return seen


def test_an_overlap_a_little_farther_out_has_the_verdict() -> None:
    pair = ShiftPair(13, 21, iso_53())
    assert GearMesh(built(pair, 0.4 + 1.38j)).contact().verdict is Verdict.CONTACT
    assert GearMesh(built(pair, 0.0 + 1.45j)).contact().verdict is Verdict.OVERLAP


@pytest.mark.parametrize(("teeth", "helix"), [pytest.param((13, 21), 12.0, marks=pytest.mark.heavy), ((9, 21), 35.0)])
def test_both_sides_of_the_interference_lines_of_helical_teeth(teeth: tuple[int, int], helix: float) -> None:
    """In the transverse section, whose fillet an ellipse leaves."""
    angle = math.radians(helix)
    seen = compare(ShiftPair(*teeth, transverse_rack(iso_53(), angle), helix_angle=angle, overlap_ratio=0.4), 1)
    assert {"fillet_interference", "undercut_to_active_flank"} <= set(seen)


@pytest.mark.heavy
def test_both_sides_of_the_interference_lines() -> None:
    seen: dict[str, int] = {}
    for z1, z2, rack in FEW:
        for kind, count in compare(ShiftPair(z1, z2, iso_53(rack)), 2).items():
            seen[kind] = seen.get(kind, 0) + count
    assert seen["fillet_interference"] >= 2
    assert seen["undercut_to_active_flank"] >= 1


@pytest.mark.heavy
@pytest.mark.parametrize(("z1", "z2", "rack"), MANY)
def test_both_sides_of_the_interference_lines_of_many_pairs(z1: int, z2: int, rack: str) -> None:
    assert sum(compare(ShiftPair(z1, z2, iso_53(rack)), 12).values()) >= 12
