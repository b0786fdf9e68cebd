"""A cam's sheet that was read back: its diagrams, construction lines, the stroke and the least radius as measured."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex, Curve, Real
from parts.base.texts import N_, fault
from parts.drawing.canvas import Paper
from parts.drawing.readback import ReadLine, ReadSheet, Taken

_SAMPLES = 257
_SECTIONS = 64
_GOLDEN = (math.sqrt(5) - 1) / 2


class CamMeasures(Record):
    """What must be measured off a cam's sheet.

    ``curves``: exact curves of each layer and ``lines`` (layer, both ends) on paper, mm; ``lift_scale`` and ``lift``:
    mu_S and H. ``joint``: where the joint diagram lies; the first tangents meet the line x = ``offset`` in the axis,
    ``least_radius`` (model mm) from S_0.
    """

    curves: dict[str, list[Curve]]
    lines: tuple[tuple[str, complex, complex], ...]
    lift_scale: float
    lift: float
    joint: Paper | None = None
    offset: float = 0.0
    least_radius: float = 0.0

    def check(self, sheet: ReadSheet, taken: Taken) -> None:
        """Add what is measured, and what is wrong."""
        worst = 0.0
        for layer, curves in self.curves.items():
            found = [points for name, points in sheet.samples if name == layer]
            # names and points of the picture stand behind the curves; a curve that is lost is a lost stroke
            for points, curve in zip(found, curves, strict=False):
                ends = curve.point(np.array(curve.domain))
                worst = max(worst, float(distance_by_sections(points, curve).max()))
                worst = max(worst, float(np.abs(ends[:, None] - points).min(axis=1).max()))
        taken.measured["diagram_deviation"] = worst
        taken.unless(worst <= taken.room, "diagrams deviate by {worst:.3g} mm from the exact ones", worst=worst)
        self._check_lines(sheet, taken)
        self._check_lift(sheet, taken)
        if self.joint is not None:
            self._check_radius(sheet, taken)

    def _check_lines(self, sheet: ReadSheet, taken: Taken) -> None:
        """Every line of the construction is there, whichever way it runs."""
        worst = 0.0
        rows: dict[str, tuple[Complex, Complex]] = {}
        for layer in {layer for layer, _, _ in self.lines}:
            mine = [x for x in sheet.lines if x.layer == layer]
            rows[layer] = np.array([x.start for x in mine]), np.array([x.end for x in mine])
        for layer, start, end in self.lines:
            starts, ends = rows[layer]
            off = math.inf
            if len(starts):
                along = np.maximum(np.abs(starts - start), np.abs(ends - end))
                back = np.maximum(np.abs(starts - end), np.abs(ends - start))
                off = float(np.minimum(along, back).min())
            worst = max(worst, off)
            at = f"({start.real:.3f}, {start.imag:.3f}) - ({end.real:.3f}, {end.imag:.3f})"
            taken.unless(off <= taken.room, "{layer}: no line {at} within {off:.3g} mm", layer=layer, at=at, off=off)
        taken.measured["lines"] = float(len(self.lines))
        taken.measured["line_deviation"] = worst

    def _check_lift(self, sheet: ReadSheet, taken: Taken) -> None:
        """The highest ordinate of S times mu_S is the stroke."""
        heights = [points.imag for name, points in sheet.samples if name == "DIAGRAM_LIFT"]
        if not heights:
            return
        every = np.concatenate(heights)
        taken.measured["lift_by_diagram"] = lift = float(every.max() - every.min()) * self.lift_scale
        # an extreme within a curve lies between its samples: of a table of points only
        near = lift <= self.lift + 2 * taken.room * self.lift_scale
        told = N_("the diagram of S measures {measured:.6f} instead of {lift:.6f}")
        taken.unless(near, told, measured=lift, lift=self.lift)

    def _check_radius(self, sheet: ReadSheet, taken: Taken) -> None:
        """The lowest point in which a tangent at gamma_min meets the line of the offset is the nearest axis."""
        assert self.joint is not None
        tangents = [x for x in sheet.lines if x.layer == "GAMMA_TANGENT"]
        if not tangents:
            taken.failures.append(fault("the tangents of the joint diagram are missing"))
            return
        model = [self._height(x) for x in tangents]
        height = min(*model, 0.0)
        taken.measured["least_radius_by_diagram"] = found = math.hypot(self.offset, height)
        off = abs(found - self.least_radius) * self.joint.scale
        text = f"{found:.6f} mm instead of {self.least_radius:.6f} mm"
        # the ends of a line carry its middle
        taken.unless(off <= 8 * taken.room, "the tangents give the least radius {text}", text=text)

    def _height(self, line: ReadLine) -> float:
        assert self.joint is not None
        start, end = ((x - self.joint.origin) / self.joint.scale for x in (line.start, line.end))
        share = (self.offset - start.real) / (end.real - start.real)
        return start.imag + share * (end.imag - start.imag)


def distance_by_sections(points: Complex, curve: Curve) -> Real:
    """Distance of points from a curve that may stand still at its ends: golden sections about the nearest samples.

    About two of them that are nearer than those beside: a curve that turns back passes a point twice.
    """
    t = np.linspace(*curve.domain, _SAMPLES)
    away = np.pad(np.abs(points[:, None] - curve.point(t)), ((0, 0), (1, 1)), constant_values=np.inf)
    dips = (away[:, 1:-1] <= away[:, :-2]) & (away[:, 1:-1] <= away[:, 2:])
    nearest = np.where(dips, away[:, 1:-1], np.inf).argsort(axis=1, kind="stable")[:, :2].ravel()
    low, high = t[np.maximum(nearest - 1, 0)], t[np.minimum(nearest + 1, _SAMPLES - 1)]
    twice = np.repeat(points, 2)

    def off(at: Real) -> Real:
        return np.abs(curve.point(at) - twice)

    left, right = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    a, b = off(left), off(right)
    for _ in range(_SECTIONS):
        lower = a < b
        high, low = np.where(lower, right, high), np.where(lower, low, left)
        # the place that is kept stands where the other one would be looked for
        new = np.where(lower, high - _GOLDEN * (high - low), low + _GOLDEN * (high - low))
        found = off(new)
        left, right = np.where(lower, new, right), np.where(lower, left, new)
        a, b = np.where(lower, found, b), np.where(lower, a, found)
    found = np.minimum(np.minimum(a, b), np.minimum(off(t[0] + 0 * low), off(t[-1] + 0 * low)))
    return np.asarray(found.reshape(-1, 2).min(axis=1))
