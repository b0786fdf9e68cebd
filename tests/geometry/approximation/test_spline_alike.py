"""Splines that start from the one of a neighbouring tooth: as good as those made alone, and never worse than told."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from geometry.approximation.outline import spline_outline
from geometry.approximation.splines import SplineFit, _fit, fit_spline
from geometry.curves.bounds import BoundedSpan
from geometry.curves.bspline import BSpline
from geometry.gears.noncircular.curves import RolledFillet, RolledFlank
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.faces import solid_curves

TOLERANCE = 1e-5


@cache
def outline() -> Any:
    gear = {"kind": "noncircular_gear", "centrode": "focal_ellipse", "eccentricity": 0.7, "module": 2.0,
            "number_of_teeth": 15}  # fmt: skip
    part = make_parts(scene_from_dict({"parts": {"gear": gear}}, "s", "s"), "s")[0]["gear"]
    return part.section(0.0).region.outer


def away(curve: Any, spline: Any) -> float:
    """Greatest distance of points of a spline from a polyline of the curve that is finer than what is measured."""
    points = spline.point(np.linspace(*spline.domain, 61))
    fine = curve.point(np.linspace(*curve.domain, 20_001))
    edge = np.diff(fine)
    found = []
    for p in points:
        near = int(np.clip(np.argmin(np.abs(fine - p)), 1, len(edge) - 1))
        found.append(min(abs((np.conj(edge[k]) * (p - fine[k])).imag) / abs(edge[k]) for k in (near - 1, near)))
    return max(found)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("degree", "continuity"), [(3, 2), (7, 6)])
def test_every_curve_of_an_outline_keeps_its_tolerance(degree: int, continuity: int) -> None:
    profile = outline()
    made = spline_outline(profile, TOLERANCE, degree=degree, continuity=continuity)
    assert made.bound == "certified"
    assert made.max_error <= TOLERANCE
    poles = alone = 0
    for segment, spline in list(zip(profile.period, made.period, strict=True))[::26]:
        assert away(segment.curve, spline) <= made.max_error + 1e-9
        assert isinstance(spline, BSpline)
        poles += len(spline.poles)
        alone += len(fit_spline(segment.curve, TOLERANCE, degree=degree, continuity=continuity).spline.poles)
    assert poles <= 1.1 * alone


def test_a_curve_that_is_not_alike_is_made_alone() -> None:
    """The knots of a short flank are too few for a fillet: the fit starts anew and still keeps its word."""
    curves = [s.curve for s in outline().period]
    flank = next(c for c in curves if isinstance(c, RolledFlank))
    fillet = next(c for c in curves if isinstance(c, RolledFillet))
    model = fit_spline(flank, 1e-2, degree=3, continuity=2)
    found = fit_spline(fillet, 1e-7, degree=3, continuity=2, like=model)
    assert found.pieces > model.pieces
    assert away(fillet, found.spline) <= found.max_error + 1e-9 <= 1.02e-7
    bare = SplineFit(model.spline, model.max_error, model.bound, model.pieces)
    assert fit_spline(fillet, 1e-3, degree=3, continuity=2, like=bare).max_error <= 1e-3


def test_bounds_of_all_parts_at_once_hold() -> None:
    for curve in [s.curve for s in outline().period if isinstance(s.curve, BoundedSpan)][:12]:
        edges = np.linspace(*curve.domain, 6)
        found = curve.derivative_bounds(edges, (2, 3, 4))
        for k in range(5):
            t = np.linspace(edges[k], edges[k + 1], 41)
            for row, order in enumerate((2, 3, 4)):
                most = float(np.abs(curve.derivative(t, order)).max())
                assert most <= found[row, k] < np.inf


def test_lands_of_mirrored_teeth_are_made_once() -> None:
    profile = outline()
    made = {id(s.curve) for s in profile.period if type(s.curve).__name__.startswith("Mirrored")}
    assert len(made) == pytest.approx(len(profile.period) / 2, abs=4)


def test_poles_stand_where_the_noise_of_machines_moves_none() -> None:
    """Along a curve poles are known to 1e-11 mm: on steps of 1e-9 mm numpy 1.26 and 2.4 put 3 parts of 219 apart."""
    keys = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 17, "face_width": 8.0, "face_chamfer": 0.4}
    part = make_parts(scene_from_dict({"parts": {"gear": keys}}, "s", "s"), "s")[0]["gear"]
    tolerance = 1e-6
    step = 2.0 ** (math.frexp(tolerance)[1] - 8)
    assert step > tolerance / 256
    outlines = solid_curves(part.body(0.0), tolerance)
    splines = [curve for outline in outlines for curve in outline.period if isinstance(curve, BSpline)]
    assert len(splines) >= 4
    for spline in splines:
        inner = spline.poles[2:-2] / step
        assert np.array_equal(inner, np.round(inner))


def test_equal_phases_of_a_cam_are_fitted_once() -> None:
    """Each was sought anew, 0.04 s a span: sheets of a cam with forty phases took 11 s."""
    phases = [{"move": move, "angle_deg": 30.0, "law": "sine"} for move in ("rise", "return")] * 6
    cam = {"kind": "cam", "follower": "roller", "follower_radius": 4.0, "base_circle_radius": 60.0, "lift": 2.0,
           "phases": phases}  # fmt: skip
    profile = make_parts(scene_from_dict({"parts": {"cam": cam}}, "s", "s"), "s")[0]["cam"].section(0.0).region.outer
    _fit.cache_clear()
    made = spline_outline(profile, TOLERANCE, degree=3, continuity=2)
    assert 6 * _fit.cache_info().misses <= len(made.period)
    assert made.bound == "certified"
    for segment, spline in list(zip(profile.period, made.period, strict=True))[::7]:
        assert away(segment.curve, spline) <= made.max_error + 1e-9
