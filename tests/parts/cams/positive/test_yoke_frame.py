"""Yokes of cams of constant breadth: both faces, or both rollers, touch at every angle; refusals with what works."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.plane.measure import distance_to_profile
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import ROLLER, SWING, Keys, parts_of

LAW = {"diagram": [{"shape": "half_sine", "width": 1.0, "peak": 2.0},
                   {"shape": "constant", "width": 2.0, "ordinate": -1.0}], "balance": True}  # fmt: skip
EVEN = [
    {"move": "rise", "angle_deg": 130.0, "law": LAW},
    {"move": "dwell", "angle_deg": 50.0},
    {"move": "return_", "angle_deg": 130.0, "law": LAW},
    {"move": "dwell", "angle_deg": 50.0},
]
FLAT: Keys = ROLLER | {"follower": "flat", "follower_radius": 0.0, "base_circle_radius": 60.0, "phases": EVEN}
ROLLERS: Keys = ROLLER | {"phases": EVEN}
YOKE: Keys = {"kind": "yoke_frame", "of": "cam"}
ANGLES = np.linspace(0, 2 * math.pi, 121)


def test_both_faces_touch_the_cam_at_every_angle() -> None:
    """The window of the frame, lifted by S, against the cam's own outline turned by phi."""
    made = parts_of({"cam": FLAT | {"follower_offset": 4.0}, "yoke": YOKE})
    assert made["cam"].thing is not None
    window = made["yoke"].section(0.0).region.holes[0]
    corners = np.array([complex(s.curve.point(s.curve.domain[0])) for s in window.segments()])
    profile = made["cam"].section(0.0).region.outer
    cam = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 4000)) for s in profile.segments()])
    lift = made["cam"].thing.motion.value(ANGLES)
    for angle, s in zip(ANGLES, lift, strict=True):
        turned = cam * np.exp(1j * angle)
        assert turned.imag.max() == pytest.approx(corners.imag.max() + s, abs=1e-5)
        assert turned.imag.min() == pytest.approx(corners.imag.min() + s, abs=1e-5)
        assert np.abs(turned.real).max() < corners.real.max() - 1.99


def test_both_rollers_touch_the_cam_at_every_angle() -> None:
    made = parts_of({"cam": ROLLERS, "yoke": YOKE | {"corner_radius": 3.0}})
    assert made["cam"].thing is not None
    holes = made["yoke"].section(0.0).region.holes
    points = [np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 9)) for s in h.segments()]) for h in holes]
    slot, *pins = [complex((p.real.max() + p.real.min()) + 1j * (p.imag.max() + p.imag.min())) / 2 for p in points]
    lift = made["cam"].thing.motion.value(ANGLES)
    outer = made["cam"].section(0.0).region.outer
    for pin in pins:
        centres = (pin + 1j * lift) * np.exp(-1j * ANGLES)
        assert np.abs(distance_to_profile(centres, outer) - 8.0).max() < 1e-9
    # the shaft stays within its slot from one end to the other
    assert slot == pytest.approx(-10j)
    assert abs(pins[0] - pins[1]) == pytest.approx(2 * 43 + 20)


def test_play_stands_half_on_either_side() -> None:
    plain, wide = (parts_of({"cam": FLAT, "yoke": YOKE | {"clearance": c}})["yoke"] for c in (0.0, 0.3))
    heights = [np.array([complex(s.curve.point(s.curve.domain[0])).imag for s in p.section(0.0).region.holes[0].period])
               for p in (plain, wide)]  # fmt: skip
    assert heights[1].max() - heights[0].max() == pytest.approx(0.15)
    assert heights[0].min() - heights[1].min() == pytest.approx(0.15)


def test_solids_and_offsets() -> None:
    for cam in (FLAT, ROLLERS):
        part = parts_of({"cam": cam, "yoke": YOKE | {"stem_below": 20.0, "corner_radius": 4.0}})["yoke"]
        for offset in (-0.3, 0.0, 0.2):
            assert part.to_trimesh(0.01, offset).is_watertight


def test_a_stem_below_alone_has_its_width() -> None:
    yoke = YOKE | {"stem_above": 0.0, "stem_below": 20.0, "stem_width": 9.0}
    outer = parts_of({"cam": ROLLERS, "yoke": yoke})["yoke"].section(0.0).region.outer
    ends = np.array([s.curve.point(s.curve.domain[0]) for s in outer.segments()])
    assert np.ptp(ends[ends.imag < ends.imag.min() + 1e-9].real) == pytest.approx(9.0)


# the cam, keys of the yoke, the key that is blamed, why
WRONG: dict[str, tuple[Keys, Keys, str, str]] = {
    "uneven": (FLAT | {"phases": [EVEN[0] | {"angle_deg": 110.0}, *EVEN[1:3], EVEN[3] | {"angle_deg": 70.0}]}, {},
               "of", "breadth_not_constant"),
    "offset rollers": (ROLLERS | {"follower_offset": 3.0}, {}, "of", "yoke_without_offset"),
    "pointed": (ROLLERS | {"follower": "pointed", "follower_radius": 0.0}, {}, "of", "yoke_of_faces_or_rollers"),
    "swinging": (ROLLERS | {"lift": 0.0, "swing_deg": 18.0, "oscillating": SWING}, {}, "of", "yoke_slides"),
    "wide stem": (ROLLERS, {"stem_width": 40.0}, "stem_width", "wider_than_frame"),
    "round corners": (ROLLERS, {"corner_radius": 12.0, "stem_width": 12.0}, "corner_radius", "cuts_into_stem"),
    "rounder corners": (ROLLERS, {"corner_radius": 14.0}, "corner_radius", "cuts_into_stem"),
    "round ends": (ROLLERS, {"corner_radius": 14.0, "stem_above": 0.0}, "corner_radius", "no_bar_at_corner"),
    "thin corner": (FLAT, {"corner_radius": 12.0}, "corner_radius", "no_bar_at_corner"),
    "wide shaft": (ROLLERS, {"shaft_diameter": 90.0}, "shaft_diameter", "slot_meets_pin"),
    "wide pins": (ROLLERS, {"pin_diameter": 90.0}, "pin_diameter", "pin_fills_roller"),
    # before: without effect
    "pins of faces": (FLAT, {"pin_diameter": 5.0}, "pin_diameter", "needs_other"),
    "side of rollers": (ROLLERS, {"side_clearance": 3.0}, "side_clearance", "needs_other"),
    "no stem": (ROLLERS, {"stem_width": 40.0, "stem_above": 0.0}, "stem_width", "needs_other"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_wrong_keys_are_refused_with_what_works(name: str) -> None:
    cam, keys, blamed, code = WRONG[name]
    parts = {"cam": cam, "yoke": YOKE | keys}
    refusal = refused(parts)
    assert (refusal.key, refusal.code) == (f"parts.yoke.{blamed}", code)
    # another cam is what cures the first four
    if blamed != "of":
        assert parts_of(cured(parts, refusal))["yoke"].to_trimesh(0.05).is_watertight


SMALL: Keys = ROLLERS | {"base_circle_radius": 4.0, "lift": 2.0, "follower_radius": 1.5, "bore_diameter": 2.0}


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("cam", "keys"),
    [
        (SMALL, {"wall": 1.0}),
        (SMALL, {"wall": 0.05}),
        (SMALL, {"wall": 1.0, "corner_radius": 1.5}),
        (SMALL | {"follower_radius": 0.3, "base_circle_radius": 1.5, "lift": 0.4, "bore_diameter": 1.0}, {}),
        (SMALL | {"base_circle_radius": 1.5, "lift": 0.4, "bore_diameter": 1.0}, {"pin_diameter": 2.8, "wall": 0.5}),
        (SMALL | {"follower": "flat", "follower_radius": 0.0, "lift": 0.5}, {"wall": 0.5, "side_clearance": 0.5}),
        (FLAT | {"base_circle_radius": 4.0, "lift": 0.5, "follower_offset": 1.5, "bore_diameter": 2.0}, {"wall": 1.0}),
        (ROLLERS, {"corner_radius": 12.0}),
        # what is not there needs no room
        (ROLLERS, {"wall": 0.1, "stem_above": 0.0}),
    ],
)  # fmt: skip
def test_sizes_that_are_left_out_suit_any_frame(cam: Keys, keys: Keys) -> None:
    """A stem of 12, pins of 4 and a shaft of 10 mm were refused by keys that nobody had typed."""
    part = parts_of({"cam": cam, "yoke": YOKE | keys})["yoke"]
    assert part.to_trimesh(0.01).is_watertight
    told, region = part.quantities, part.section(0.0).region
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 200)) for s in region.outer.period])
    if told.get("stem_width"):
        tip = points[np.abs(points.imag - points.imag.max()) < 1e-9].real
        assert np.ptp(tip) == pytest.approx(told["stem_width"])
        # its edges and the frame's own stand half a millimetre apart, or what its corners take more
        assert np.ptp(points.real) - np.ptp(tip) > 1 - 1e-9
    if cam["follower"] == "roller":
        holes = [np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 201)) for s in h.segments()])
                 for h in region.holes]  # fmt: skip
        widths = [told["shaft_diameter"], told["pin_diameter"], told["pin_diameter"]]
        assert [np.ptp(hole.real) for hole in holes] == pytest.approx(widths, rel=1e-3)
        assert told["pin_diameter"] < 2 * cam["follower_radius"]
        low, slot, high = sorted((hole.imag.min(), hole.imag.max()) for hole in holes)
        assert low[1] < slot[0] < slot[1] < high[0]


def test_a_stem_is_as_wide_as_the_drawn_frame_but_for_its_ledges() -> None:
    outline = parts_of({"cam": FLAT, "yoke": YOKE})["yoke"].section(0.0).region.outer
    across = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 5)).real for s in outline.period])
    widest = refused({"cam": FLAT, "yoke": YOKE | {"stem_width": 400.0}}).nearest
    assert widest is not None
    # half a millimetre on either side
    assert widest.value == pytest.approx(np.ptp(across) - 1.0)


def test_the_departure_is_told_in_numbers() -> None:
    """A rise of 110 and a return of 130 degrees: the greatest departure by a dense table of the lift."""
    cam = WRONG["uneven"][0]
    told = refused({"cam": cam, "yoke": YOKE}).numbers["error"]
    motion = parts_of({"cam": cam})["cam"].thing.motion
    dense = np.linspace(0, math.pi, 20001)
    assert told == pytest.approx(np.abs(motion.value(dense) + motion.value(dense + math.pi) - 20).max(), rel=1e-3)
