"""Bevel teeth that are not straight: their lines by the cutter's circle, their flanks by a crown gear that rolls."""

from __future__ import annotations

import math
from functools import cache

import mpmath
import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.curves.curve import Real
from geometry.gears.bevel.gear import BevelGear, Blank
from geometry.gears.bevel.pair import BevelPair
from geometry.gears.bevel.sphere import SphericalInvolute
from geometry.gears.bevel.tooth_line import ToothLine
from geometry.gears.bevel.walls import wall_distance
from geometry.plane.distance import Verdict

SHARE, ALONG = np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, 5)
# spiral angle at the mean cone distance, cutter radius, tips that meet the apex: spiral, zerol, skew
LINES = {
    "spiral": (35.0, 40.0, False), "zerol": (0.0, 30.0, False), "skew": (25.0, math.inf, False),
    "apex": (35.0, 60.0, True),
}  # fmt: skip


@cache
def pair(name: str, thinning: float = 0.0) -> BevelPair:
    """20 and 31 teeth of 2 mm at 80 degrees, the first with left-hand teeth."""
    spiral, cutter, apex = LINES[name]
    section = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(spiral)))
    first = BevelGear(2.0, 20, 31, 11.0, Blank(1.5), math.radians(80), section, profile_shift_coefficient=0.2,
                      circumferential_thinning=thinning, tip_to_apex=apex, spiral_angle=math.radians(spiral),
                      cutter_radius=cutter, hand="left")  # fmt: skip
    second = replace(first, number_of_teeth=31, mate_number_of_teeth=20, profile_shift_coefficient=-0.2, hand="right")
    return BevelPair(first.checked(), second.checked())


def on_cutter(gear: BevelGear | ToothLine, distance: float) -> float:
    """Polar angle at which the cutter's circle through (R_m, 0) crosses a circle about the apex, at 40 digits."""
    with mpmath.workdps(40):
        mean, beta = mpmath.mpf(gear.mean_distance), mpmath.mpf(gear.spiral_angle)
        way = mpmath.mpc(mpmath.cos(beta), mpmath.sin(beta))
        if math.isinf(gear.cutter_radius):

            def place(t: float) -> mpmath.mpc:
                return mean + t * way
        else:
            radius = mpmath.mpf(gear.cutter_radius)
            centre = mean + 1j * way * radius

            def place(t: float) -> mpmath.mpc:
                return centre + (mean - centre) * mpmath.expj(t / radius)

        found = mpmath.findroot(lambda t: abs(place(t)) - mpmath.mpf(distance), mpmath.mpf(distance) - mean)
        return float(mpmath.arg(place(found)))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", LINES)
def test_the_section_turns_along_the_circle_of_the_cutter(name: str) -> None:
    """Right-hand teeth run off clockwise outwards, and the crown gear's turn is that of the circle about the apex."""
    for gear in pair(name).gears:
        for distance in np.linspace(gear.inner_distance, 1.02 * gear.cone_distance, 7):
            turned = on_cutter(gear, float(distance)) / math.sin(gear.pitch_angle)
            expected = turned if gear.hand == "left" else -turned
            assert float(gear.spin(distance)) == pytest.approx(expected, abs=1e-14)
            step = 1e-4
            slope = (on_cutter(gear, distance + step) - on_cutter(gear, distance - step)) / (2 * step)
            assert math.tan(float(gear.line.spiral(distance))) == pytest.approx(distance * slope, abs=1e-7)


def test_a_line_is_told_as_steep_as_it_is_until_it_turns_back() -> None:
    line, step = ToothLine(30.0, math.radians(60.0), 20.0), 1e-4
    slope = (on_cutter(line, 36.0 + step) - on_cutter(line, 36.0 - step)) / (2 * step)
    found = math.degrees(float(line.spiral(36.0)))
    assert found == pytest.approx(math.degrees(math.atan(36.0 * slope)), abs=1e-6)
    assert found > 85.0
    # its circle's farthest place from the apex
    turns = abs(30.0 + 20j * np.exp(1j * line.spiral_angle)) + 20.0
    assert float(line.spiral(turns)) == pytest.approx(math.pi / 2, abs=1e-7)
    assert float(line.spiral(turns + 1.0)) == math.pi / 2


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", LINES)
def test_flanks_are_what_a_crown_gear_with_these_lines_touches(name: str) -> None:
    """Rolled step by step, its flank on the sphere of a point comes as near as the point and never beyond it."""
    for gear in pair(name).gears:
        delta, alpha = gear.pitch_angle, gear.pressure_angle
        for way, own in ((1, gear), (-1, gear.opposite())):
            points = own.wall_points("flank", SHARE, ALONG).reshape(-1, 3) * [1, way, 1]
            points = (points - [0, 0, gear.mounting_distance]) * [1, 1, -1]
            size = np.linalg.norm(points, axis=1)
            lines = np.array([on_cutter(gear, float(s)) for s in size]) * (1 if gear.hand == "left" else -1)
            assert touched(points / size[:, None], delta, alpha, gear, way, lines) == pytest.approx(0.0, abs=3e-7)


def touched(points: Real, delta: float, alpha: float, gear: BevelGear, way: int, lines: Real) -> Real:
    """Least distance of each point from the crown gear's flank over the roll, rad; its tooth fills the gear's space."""
    inv = SphericalInvolute(math.pi / 2 - alpha)
    space = (math.pi / gear.number_of_teeth - gear.half_pitch_angle) * math.sin(delta)
    # the flank's side of the tooth, turned so far as the gear's pitch point would pass it
    rolls = np.linspace(-0.7, 0.7, 6001)[:, None]
    azimuth = np.arctan2(points[:, 1], points[:, 0]) - rolls / math.sin(delta)
    radius, high = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    # about the crown's axis, which is (cos delta, 0, -sin delta) where the pitch line is (sin delta, 0, cos delta)
    x, y = radius * np.cos(azimuth), radius * np.sin(azimuth)
    along, out = x * math.sin(delta) + high * math.cos(delta), x * math.cos(delta) - high * math.sin(delta)
    turned = np.arctan2(y, along) + rolls
    angle = np.arccos(np.clip(out, -1, 1))
    # middle of the crown's tooth: the next space of the gear on that side
    middle = way * math.pi / gear.number_of_teeth * math.sin(delta) + lines
    aside = way * (middle - turned)
    half = space + inv.involute_at(math.pi / 2) - inv.involute_at(angle)
    off = (aside - half) * math.sin(inv.base)
    # the crown gear's tooth ends where the gear's root and tip do
    high, low = gear.tip_angle - delta, delta - gear.root_angle
    there = (angle > math.pi / 2 - high - 1e-9) & (angle < math.pi / 2 + low + 1e-9)
    return np.asarray(np.where(there, off, np.inf).min(axis=0))


@pytest.mark.parametrize("name", LINES)
def test_distances_of_leaning_walls_are_those_of_points_moved_along_normals(name: str) -> None:
    gear = pair(name).first
    step = 1e-6
    for wall in ("fillet", "flank"):
        for way, own in ((1, gear), (-1, gear.opposite())):
            inner = SHARE[1:-1], ALONG[1:-1]
            points = own.wall_points(wall, *inner)
            up = own.wall_points(wall, inner[0] + step, inner[1]) - own.wall_points(wall, inner[0] - step, inner[1])
            on = own.wall_points(wall, inner[0], inner[1] + step) - own.wall_points(wall, inner[0], inner[1] - step)
            normal = np.cross(up, on)
            normal /= np.linalg.norm(normal, axis=-1)[..., None]
            for off in (0.0, 1e-3, -1e-3):
                moved = (points + off * normal).reshape(-1, 3) * [1, way, 1]
                assert wall_distance(gear, wall, way, moved) == pytest.approx(abs(off), abs=1e-6)


def test_a_fillet_goes_on_beyond_the_middle_of_its_space() -> None:
    """Chords of roots without a land bow over it: they were measured from the next tooth, and refused."""
    section = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(50)))
    gear = BevelGear(2.0, 30, 30, 12.7, Blank(5.0), math.pi / 2, section, circumferential_thinning=0.04,
                     spiral_angle=math.radians(50), cutter_radius=36.0, hand="left").checked()  # fmt: skip
    ends = gear.wall_points("fillet", np.zeros(1), ALONG).reshape(-1, 3)
    for turn in (-2e-4, 2e-4):
        turned = (ends[:, 0] + 1j * ends[:, 1]) * np.exp(1j * turn)
        moved = np.column_stack([turned.real, turned.imag, ends[:, 2]])
        assert wall_distance(gear, "fillet", 1, moved).max() < 2e-4 * np.abs(turned).max()


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", LINES)
def test_mates_touch_wherever_they_stand_and_backlash_is_measured_along_the_normal(name: str) -> None:
    both = pair(name)
    found = both.contact()
    assert found.verdict is Verdict.CONTACT
    assert np.abs(np.array(found.side_gaps)).max() < 1e-12
    thin = pair(name, 0.05)
    # j_n = j_t cos alpha_n cos beta at the outer end, alpha_n by tan alpha_n = tan alpha_t cos beta
    beta = float(both.first.line.spiral(both.first.cone_distance))
    normal = math.atan(math.tan(both.first.pressure_angle) * math.cos(beta))
    assert thin.normal_backlash == pytest.approx(0.1 * math.cos(normal) * math.cos(beta), rel=1e-12)
    # where the flanks lean most or are nearest to the apex it is least
    places = np.linspace(both.first.inner_distance, both.first.cone_distance, 9)
    leaning = np.hypot(1.0, np.tan(both.first.line.spiral(places)) * math.cos(both.first.pressure_angle))
    least = float((places / leaning).min() * leaning[-1] / places[-1])
    assert np.array(thin.contact().side_gaps) == pytest.approx(thin.normal_backlash / 2 * least, rel=1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", LINES)
def test_the_total_contact_ratio_is_counted_off_a_pitch_of_turning(name: str) -> None:
    """How many teeth touch anywhere along the face, mean over a pitch; less on one side's teeth."""
    both = pair(name)
    first, second = both.gears
    pitch, base = math.tau / first.number_of_teeth, math.sin(first.involute.base)
    spheres = np.linspace(first.inner_distance, first.cone_distance, 400)
    rolled = float(first.involute.arc(first.pitch_angle)), float(second.involute.arc(second.pitch_angle))
    tips = [g.involute.arc(g.tip_angle_at(spheres)) for g in both.gears]
    spun = first.spin(spheres)
    counts = []
    for way in (-1, 1):
        touching, steps = 0, 1000
        for k in range(steps):
            for tooth in range(-5, 6):
                arc = rolled[0] + base * (pitch * (k / steps + tooth) + way * spun)
                other = sum(rolled) - arc
                met = (first.joint[1] <= arc) & (arc <= tips[0]) & (second.joint[1] <= other) & (other <= tips[1])
                touching += bool(met.any())
        counts.append(touching / steps)
    assert both.total_contact_ratio == pytest.approx(min(counts), abs=3e-3)
    turned = abs(on_cutter(first, first.cone_distance) - on_cutter(first, first.inner_distance))
    assert both.face_contact_ratio == pytest.approx(turned / math.sin(first.pitch_angle) / pitch, rel=1e-12)


@pytest.mark.parametrize(
    ("keys", "name"),
    [({"cutter_radius": 6.0}, "cutter_radius"), ({"spiral_angle": math.radians(59)}, "spiral_angle"),
     ({"spiral_angle": math.radians(50), "cutter_radius": math.inf, "face_width": 20.0}, "spiral_angle")],
)  # fmt: skip
def test_lines_that_lean_too_far_are_refused_with_a_value_that_works(keys: dict[str, float], name: str) -> None:
    with pytest.raises(ParameterError) as caught:
        replace(pair("spiral").first, **keys).checked()
    assert (caught.value.name, caught.value.code) == (name, "bevel_line_too_steep")
    assert caught.value.nearest is not None
    cured = replace(pair("spiral").first, **(keys | {name: caught.value.nearest.value})).checked()
    assert float(np.abs(cured.line.spiral([cured.inner_distance, cured.cone_distance])).max()) < math.radians(60)
