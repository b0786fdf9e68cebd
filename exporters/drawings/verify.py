"""A sheet that was written, measured as one would with dividers: circles, tangents, arcs, words, outlines."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np

from exporters.drawings.read import read_sheets
from exporters.drawings.sheets import sheet_rounding
from exporters.verification.verdict import Verdict, of_readable
from geometry.approximation.outline import CadCurve
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import distance_to_curve, distance_to_curves
from parts.base.texts import N_, fault
from parts.drawing.canvas import Box, Canvas
from parts.drawing.expected import Expected, Meshing
from parts.drawing.font import Run
from parts.drawing.readback import PER_CURVE, ReadSheet, Taken

# share of the paper's size that numbers of a file may be off
_ROUNDING = 1e-11
# mm: the size of a page is told in hundredths of a point
_PAPER = 0.01
# mm of words that are off by no more than a place's rounding
_PER_PLACE = 20.0
# mm: a line whose ends are so near to each other and whose points are so near to a circle is one
_SHUT = 1e-4


@of_readable
def verify_sheets(file: Path, pages: Sequence[Expected], tolerance: float) -> Verdict:
    """Measure a file; ``tolerance`` in mm on paper bounds every deviation beside the rounding of the file's numbers."""
    sheets = read_sheets(file, [page.canvas.layers for page in pages])
    measured: dict[str, float] = {}
    failures: list[str] = []
    for sheet, expected in zip(sheets, pages, strict=True):
        taken = _taken(sheet, expected, tolerance + sheet_rounding(file))
        failures += taken.failures
        measured |= {name: max(value, measured.get(name, value)) for name, value in taken.measured.items()}
    return Verdict(measured, tuple(failures))


def _taken(sheet: ReadSheet, expected: Expected, tolerance: float) -> Taken:
    canvas = expected.canvas
    reach = max([canvas.width, canvas.height, *(c.radius for c in expected.circles)])
    taken = Taken(tolerance + _ROUNDING * reach)
    off = max(abs(sheet.width - canvas.width), abs(sheet.height - canvas.height))
    told = N_("has paper of {width:g} x {height:g} mm instead of {paper}")
    taken.unless(off <= _PAPER, told, width=sheet.width, height=sheet.height, paper=canvas.paper)
    _check_circles(sheet, expected, taken)
    _check_curves(sheet, expected, taken)
    if expected.meshing is not None:
        _check_meshing(sheet, expected.meshing, taken)
    if expected.measures is not None:
        expected.measures.check(sheet, taken)
    _check_words(sheet, canvas, taken)
    _check_strokes(sheet, canvas, taken)
    _check_frame(sheet, canvas.reach.grown(taken.room), taken)
    return taken


def _check_circles(sheet: ReadSheet, expected: Expected, taken: Taken) -> None:
    worst = 0.0
    for circle in expected.circles:
        if circle.centre is None:
            rows = [line for line in sheet.lines if line.layer == circle.layer]
            off = min(
                (max(abs(x.start.imag - circle.radius), abs(x.end.imag - circle.radius)) for x in rows),
                default=math.inf,
            )
        else:
            spokes = [np.abs(points - circle.centre) for layer, points in sheet.samples if layer == circle.layer]
            off = min((float(np.abs(r - circle.radius).max()) for r in spokes), default=math.inf)
        worst = max(worst, off)
        told = N_("{layer}: no circle of {radius:.6f} mm within {off:.3g} mm")
        taken.unless(off <= taken.room, told, layer=circle.layer, radius=circle.radius, off=off)
    taken.measured["circles"] = float(len(expected.circles))
    taken.measured["circle_deviation"] = worst


def _check_curves(sheet: ReadSheet, expected: Expected, taken: Taken) -> None:
    """Every curve of an outline lies on its exact one and reaches both of its ends; missing ones are missed strokes."""
    worst, paper = 0.0, expected.paper
    for layer, curves in expected.curves.items():
        found = [points for name, points in sheet.samples if name == layer]
        # files keep the order of drawing within a layer
        for points, curve in zip(found, curves, strict=False):
            model = (points - paper.origin) / paper.scale
            off = float(distance_to_curves(model, [curve]).max())
            ends = np.abs(curve.point(np.array(curve.domain))[:, None] - model).min(1).max()
            worst = max(worst, off * paper.scale, float(ends) * paper.scale)
    taken.measured["max_deviation"] = worst
    taken.unless(worst <= taken.room, "outlines deviate by {worst:.3g} mm from the exact ones", worst=worst)


def _check_meshing(sheet: ReadSheet, wanted: Meshing, taken: Taken) -> None:
    """The line of action touches the base circles; the contact ratio by both ways of measuring."""
    actions, actives = ([x for x in sheet.lines if x.layer == name] for name in ("LINE_OF_ACTION", "ACTIVE_LINE"))
    arcs = [a for a in sheet.arcs if a.layer == "ARC_OF_ACTION"]
    pitches = [a.radius * a.sweep for a in sheet.arcs if a.layer == "WORKING_PITCH"]
    pitches += [abs(x.end - x.start) for x in sheet.lines if x.layer == "WORKING_PITCH"]
    if not (actions and actives and arcs and pitches):
        taken.failures.append(fault("the line of action, its active part, the arc of action or the pitch is missing"))
        return
    action, active = actions[0], actives[0]
    way = (action.end - action.start) / abs(action.end - action.start)
    for centre, radius in wanted.tangents:
        foot = (centre - action.start) / way
        off = abs(abs(foot.imag) - radius)
        # what its ends are off, so far beyond them
        share = foot.real / abs(action.end - action.start)
        beyond = abs(share) + abs(1 - share)
        told = N_("the line of action misses the base circle of {radius:.6f} mm by {off:.3g} mm")
        taken.unless(off <= 2 * taken.room * beyond + 1e-9 * radius, told, radius=radius, off=off)
    for point in (active.start, active.end):
        off = abs(((point - action.start) / way).imag)
        taken.unless(off <= 2 * taken.room, "the active line leaves the line of action by {off:.3g} mm", off=off)
    base_pitch = 2 * math.pi * wanted.tangents[0][1] / wanted.teeth
    length, arc = abs(active.end - active.start), arcs[0].radius * arcs[0].sweep
    taken.measured["contact_ratio_by_line"] = length / base_pitch
    taken.measured["contact_ratio_by_arc"] = arc / pitches[0]
    for name, value, right in (
        ("active line of action", length, wanted.active_length),
        ("arc of action", arc, wanted.arc_length),
        ("working pitch", pitches[0], wanted.pitch_length),
    ):
        told = N_("the {name} measures {value:.6f} mm instead of {right:.6f} mm")
        taken.unless(abs(value - right) <= 2 * taken.room, told, name=name, value=value, right=right)
    for name in ("contact_ratio_by_line", "contact_ratio_by_arc"):
        found, told = taken.measured[name], N_("{name} measures {found:.7f} instead of {wanted:.7f}")
        near = abs(found - wanted.contact_ratio) <= max(1e-6, 4 * taken.room / wanted.pitch_length)
        taken.unless(near, told, name=name, found=found, wanted=wanted.contact_ratio)


def _check_words(sheet: ReadSheet, canvas: Canvas, taken: Taken) -> None:
    """All words stand where they should and none beside, none over another, all in the frame."""
    _check_places(sheet, canvas, taken)
    # a rounding less than each: neighbours may touch
    boxes = [_box(t).grown(-sheet.rounding) for t in sheet.texts]
    for index, (box, one) in enumerate(zip(boxes, sheet.texts, strict=True)):
        taken.unless(box.within(canvas.reach), "{text} leaves the frame", text=one.text)
        over = (other.text for place, other in zip(boxes[:index], sheet.texts, strict=False) if box.overlaps(place))
        taken.failures += [fault("{text} stands over {other}", text=one.text, other=other) for other in over]
    taken.measured["words"] = float(len(boxes))


def _check_places(sheet: ReadSheet, canvas: Canvas, taken: Taken) -> None:
    """Every word is at its place, as long, as high and turned as it should be."""
    runs = [run for text in canvas.texts for run in text.runs]
    missing = Counter(run.text for run in runs) - Counter(t.text for t in sheet.texts)
    taken.unless(not missing, "words are missing: {missing}", missing=", ".join(sorted(missing)))
    for text in sorted({run.text for run in runs if run.text not in missing} | {t.text for t in sheet.texts}):
        wanted = _rows(_marks(run) for run in runs if run.text == text)
        found = _rows(_marks(t) for t in sheet.texts if t.text == text)
        # lengths are as exact as the widths of all letters together
        longest = max((run.width for run in runs if run.text == text), default=0.0)
        away, strange = _unmatched(wanted, found, sheet.rounding * max(1.0, longest / _PER_PLACE))
        lost = N_("{text} does not stand at {at} mm as it should")
        more = N_("{text} stands at {at} mm where it should not")
        taken.failures += [fault(lost, text=text, at=_told(wanted[k, 0])) for k in away]
        taken.failures += [fault(more, text=text, at=_told(found[k, 0])) for k in strange]


def _marks(words: Run) -> tuple[complex, complex, complex]:
    """Both ends of the base line, and the top above its beginning."""
    return words.at, words.at + words.width * words.way, words.at + 1j * words.height * words.way


def _check_strokes(sheet: ReadSheet, canvas: Canvas, taken: Taken) -> None:
    """Every line of every layer is there, and none beside; they are held all along, by what is known of them first."""
    for layer in {s.layer: None for s in canvas.strokes} | {name: None for name, _ in sheet.samples}:
        curves = [s.curve for s in canvas.strokes if s.layer == layer]
        samples = [points for name, points in sheet.samples if name == layer]
        wanted, found = _rows(_trace(*_sampled(c)) for c in curves), _rows(map(_trace, samples))

        def follows(k: int, n: int, curves: list[CadCurve] = curves, samples: list[Complex] = samples) -> bool:
            return _follows(samples[n], curves[k], taken.room)

        away, strange = _unmatched(wanted, found, taken.room, follows)
        lost = N_("{layer}: no line from {start} to {end} mm")
        more = N_("{layer}: a line too many from {start} to {end} mm")
        for text, row in (*((lost, wanted[k]) for k in away), *((more, found[k]) for k in strange)):
            taken.failures.append(fault(text, layer=layer, start=_told(row[0]), end=_told(row[2])))


def _sampled(curve: CadCurve) -> tuple[Complex, bool]:
    """Points of a curve, and whether files have its middle at the middle of their own."""
    return curve.point(np.linspace(*curve.domain, PER_CURVE)), isinstance(curve, Line | Arc)


def _trace(points: Complex, even: bool = True) -> tuple[complex, complex, complex]:
    """What a line is known by: its ends and its middle (nan: any); of a full circle centre, right end and centre."""
    third = len(points) // 3
    centre = complex((points[0] + points[third] + points[2 * third]) / 3)
    radii = np.abs(points - centre)
    if abs(points[-1] - points[0]) < _SHUT and np.ptp(radii) < _SHUT:
        return centre, centre + float(radii.mean()), centre
    return complex(points[0]), complex(points[len(points) // 2]) if even else complex("nan"), complex(points[-1])


def _rows(rows: Iterable[tuple[complex, complex, complex]]) -> Complex:
    return np.array([*rows], dtype=np.complex128).reshape(-1, 3)


def _follows(points: Complex, curve: CadCurve, allowed: float) -> bool:
    """Whether a file's points lie on a curve all along it, where three of them do not tell."""
    if not isinstance(curve, Line | Arc):
        breaks = curve.breaks
        own = curve.point((breaks[:-1, None] + np.linspace(0, 1, PER_CURVE) * np.diff(breaks)[:, None]).ravel())
        if own.shape == points.shape and min(np.abs(own - points).max(), np.abs(own[::-1] - points).max()) <= allowed:
            return True
    # a file may cut it elsewhere, and a PDF has arcs in pieces
    return float(distance_to_curve(points, curve).max()) <= allowed


def _unmatched(
    wanted: Complex, found: Complex, allowed: float, follows: Callable[[int, int], bool] = lambda k, n: True
) -> tuple[list[int], list[int]]:
    """Which rows of three points have no partner: either way round, each partner taken once, mostly in order.

    ``follows``: whether a row and a partner, by their places, are one curve between these points too.
    """
    left, free = [], np.ones(len(found), dtype=np.bool_)
    for k, row in enumerate(wanted):
        if k < len(found) and free[k] and _off(row, found[k : k + 1])[0] <= allowed and follows(k, k):
            free[k] = False
        else:
            left.append(k)
    away = []
    for k in left:
        off = np.where(free, _off(wanted[k], found), np.inf)
        near = (int(n) for n in np.argsort(off) if off[n] <= allowed and follows(k, int(n)))
        if (best := next(near, None)) is not None:
            free[best] = False
        else:
            away.append(k)
    return away, [int(k) for k in np.flatnonzero(free)]


def _off(row: Complex, others: Complex) -> Real:
    """How far three points are from those of other rows, read forwards or backwards; (n,)."""
    ways = np.stack([np.abs(others - row), np.abs(others[:, ::-1] - row)])
    return np.asarray(np.fmax.reduce(ways, axis=2).min(axis=0))


def _told(at: complex) -> str:
    return f"{at.real:.3f}, {at.imag:.3f}"


def _box(text: Run) -> Box:
    far = text.at + text.way * complex(text.width, text.height)
    return Box.of((text.at, far))


def _check_frame(sheet: ReadSheet, frame: Box, taken: Taken) -> None:
    """Nothing is drawn beyond the frame."""
    for layer, points in sheet.samples:
        held = len(points) == frame.grown(1e-9).holds(points)
        taken.unless(held, "{layer}: a curve leaves the frame", layer=layer)
