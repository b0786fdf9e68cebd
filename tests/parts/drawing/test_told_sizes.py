"""What drawings of every kind tell, before any file is written: all sizes, radii at arcs, signs at lines."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc, Line
from parts.drawing.working import PartDrawing, View
from tests.exporters.production.test_part_drawings import PARTS, SIZES
from tests.parts.drawing.test_sections import drawing_of
from tests.parts.drawing.test_views import PARTS as MORE
from tests.parts.drawing.test_views import off

NEAR = 1e-6
DRAWN = {**PARTS, **{name: keys for name, keys in MORE.items() if name.removeprefix("drawn ") not in PARTS}}


@cache
def drawn(name: str) -> PartDrawing:
    return drawing_of(DRAWN[name])


@pytest.mark.parametrize("name", PARTS)
def test_every_size_of_the_keys_is_told_and_no_other(name: str) -> None:
    told = [one.value for view in drawn(name).views for one in (*view.sizes, *view.rounds, *view.slants)]
    assert sorted(told) == pytest.approx(sorted(SIZES[name]), abs=NEAR)


def pieces(curves: list[Curve]) -> np.ndarray:
    points = [c.point(np.linspace(*c.domain, 2 if isinstance(c, Line) else 257)) for c in curves]
    return np.concatenate([np.stack([p[:-1], p[1:]], axis=1) for p in points])


def astray(view: View) -> list[str]:
    """Radii and diameters that are no arc's or point beside it, signs that stand at no line."""
    found = list[str]()
    arcs = [curve for _, curve in view.strokes if isinstance(curve, Arc)]
    for one in view.rounds:
        for centre, angles in ((one.centre, one.angles), *one.also):
            same: list[Curve] = [a for a in arcs if abs(a.centre - centre) < NEAR and abs(a.radius - one.radius) < NEAR]
            ends = centre + one.radius * np.exp(1j * np.radians(angles))
            if not same or (one.is_radius and off(pieces(same), ends).max() > 1e-3 * one.radius):
                found.append(f"{one.name} at no arc")
    axes = [end for axis in view.axes for end in (axis.start, axis.end)]
    lines = pieces([curve for _, curve in view.strokes])
    for note in view.notes:
        for at in (note.at, *(other for other, _ in note.also)):
            # a number about a hole stands beside its circle
            stands = at if note.about is None else at + note.about
            gap = min(abs(stands - end) for end in axes) if note.goes_on else off(lines, np.array([stands]))[0]
            if gap > 1e-3:
                found.append(f"{note.text} at no line")
    return found


@pytest.mark.parametrize("name", DRAWN)
def test_radii_stand_at_their_arcs_and_signs_at_lines(name: str) -> None:
    assert [astray(view) for view in drawn(name).views] == [[] for _ in drawn(name).views]


def test_a_radius_and_a_sign_that_are_moved_are_seen() -> None:
    view = next(view for view in drawn("plate").views if view.rounds and view.notes)
    (one, *rounds), (note, *notes) = view.rounds, view.notes
    assert astray(replace(view, rounds=(replace(one, centre=one.centre + 0.01), *rounds)))
    assert astray(replace(view, rounds=(replace(one, radius=one.radius * 1.01), *rounds)))
    assert astray(replace(view, notes=(replace(note, at=note.at + 0.1 + 0.1j), *notes)))
    rounded = next(one for one in view.rounds if one.is_radius)
    turned = replace(rounded, angles=tuple(angle + 90.0 for angle in rounded.angles))
    assert astray(replace(view, rounds=(turned,)))


@pytest.mark.parametrize("shift", [0.0, -0.4])
def test_the_outer_diameter_of_a_flat_bevel_wheel_is_told_once(shift: float) -> None:
    """Its tip cone looks inwards past the corner: d_ae = m z + 2 m (1 + x) cos delta was told twice (GOST 2.307)."""
    wheel = {"kind": "bevel_gear", "module": 10.0, "number_of_teeth": 60, "mate_number_of_teeth": 6,
             "bore_diameter": 60.0, "profile_shift_coefficient": shift}  # fmt: skip
    (view,) = drawing_of(wheel).views
    tip = 600 + 20 * (1 + shift) / np.hypot(1, 10)
    across = sorted(size.value for size in view.sizes if size.side in ("left", "right"))
    assert across == pytest.approx([60.0, tip], abs=NEAR)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", PARTS)
def test_a_bore_that_has_a_fit_has_its_roughness_too(name: str) -> None:
    """Cylindrical cams told H7 with the Ra 6.3 of all other surfaces; the slots of a Geneva ring run on pins."""
    made = drawing_of(DRAWN[name], bore_roughness=0.4, flank_roughness=0.2)
    signs = [note.text for view in made.views for note in view.notes if note.is_rough]
    fits = [one.after for view in made.views for one in view.sizes if one.name.startswith("bore")]
    assert signs.count("Ra 0.4") >= ("H7" in fits)
    if DRAWN[name]["kind"].startswith("geneva"):
        assert "Ra 0.2" in signs
