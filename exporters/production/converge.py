"""``higherpair converge``: error against run time, entities and bytes, and the order that each method really has."""

from __future__ import annotations

import csv
import math
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from msgspec.structs import astuple

from exporters.formats.registry import REGISTRY, declared_error, shape_of
from exporters.production.jobs import Job
from exporters.production.plan import Plan
from exporters.production.plot import Series, write_loglog
from exporters.verification.judge import verify_file
from geometry.approximation.arcs import arc_spline_of
from geometry.approximation.chords import chords_of
from geometry.approximation.splines import spline_of_spans
from geometry.base.errors import ConvergenceError, ParameterError
from geometry.base.record import Record
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label
from parts.base.texts import N_, Words

# making and measuring a rung may take this long, s; the next one would take longer
_MOST_SECONDS = 15.0
CAD_LADDER = (0.01, 0.001, 1e-4, 1e-5, 1e-6, 1e-7)
LADDER = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002, 0.0001)
_REPEATS = 3
# orders are fitted over doubled piece counts, from here down to this many times the rounding floor
LEAST_PIECES, _MOST_PIECES, _FLOORS = 16, 1024, 100.0
_ROUNDING = 4e-15


class Rung(Record):
    """One file at one tolerance: what was declared, what was measured, and what it cost."""

    file: str
    format: str
    tolerance: float
    max_error: float
    measured: float
    entities: int
    bytes: int
    seconds: float
    spread: float


class Order(Record):
    """Observed order of a method on one exact curve: error ~ pieces^-order; None where one rung or none stands above
    the rounding floor.
    """

    part: str
    curve: str
    method: str
    theory: float
    observed: float | None
    counts: tuple[int, ...]
    errors: tuple[float, ...]


def _bare_spline(curve: Curve, count: int, degree: int) -> float:
    """Error of a spline before the exporter's refinement of its knots, which only lessens it."""
    return spline_of_spans(curve, count, degree=degree, continuity=degree - 1, refined=False).max_error


METHODS: dict[str, tuple[float, Callable[[Curve, int], float]]] = {
    N_("chords"): (2.0, lambda curve, count: chords_of(curve, count)[1]),
    N_("arcs"): (3.0, lambda curve, count: arc_spline_of(curve, count).max_error),
    N_("cubic splines"): (4.0, lambda curve, count: _bare_spline(curve, count, 3)),
    N_("degree 7 splines"): (8.0, lambda curve, count: _bare_spline(curve, count, 7)),
}


# names of curves for people; the tables for programs have their labels
_CURVES: dict[str, str] = {
    Label.FLANK: N_("flank"),
    Label.ROOT_FILLET: N_("root fillet"),
    Label.RELIEF: N_("tip relief"),
    Label.CAM: N_("profile of the cam"),
}


def curve_name(order: Order, told: Words) -> str:
    """A part and its curve."""
    return f"{order.part} {told.text(_CURVES.get(order.curve, order.curve))}"


def ladder(plan: Plan, folder: Path, progress: Callable[[str], None] = lambda path: None) -> list[Rung]:
    """Every job of a plan over the ladder of tolerances; files are made in ``folder`` and removed again.

    The ladder of a file ends where the format cannot carry a finer tolerance, or where a rung takes too long.
    """
    rungs = []
    for job in plan.jobs:
        progress(job.path)
        for tolerance in CAD_LADDER if job.kind.is_cad else LADDER:
            start = time.perf_counter()
            try:
                rungs.append(_rung(job.at(tolerance), folder / job.path))
            except (ParameterError, ConvergenceError):
                # this format cannot carry so fine a tolerance: the ladder ends here
                break
            if time.perf_counter() - start > _MOST_SECONDS:
                break
    return rungs


def _rung(job: Job, file: Path) -> Rung:
    seconds = []
    for _ in range(_REPEATS):
        start = time.perf_counter()
        made = shape_of(job)
        entities = REGISTRY[job.kind.name].write(job, made, file)
        seconds.append(time.perf_counter() - start)
    max_error, _ = declared_error(job, made)
    tolerance = job.tolerance
    verdict = verify_file(file, job.kind, job.exact, max_error, tolerance)
    size = file.stat().st_size
    file.unlink()
    made_of, measured = sum(entities.values()), verdict.measured.get("max_deviation", math.nan)
    # what else the machine does only lengthens a run: the shortest one tells the file's own cost
    least, spread = min(seconds), max(seconds) - min(seconds)
    return Rung(job.path, job.export.format, tolerance, max_error, measured, made_of, size, least, spread)


def orders(plan: Plan) -> list[Order]:
    """Observed orders of every method on every curve that is not a circle or a line."""
    found = []
    for part_id in dict.fromkeys(job.part.id for job in plan.jobs):
        region = plan.parts[part_id].section(0.0).region
        seen = set()
        for segment in (s for profile in region.profiles() for s in profile.period):
            if isinstance(segment.curve, Arc | Line) or segment.label in seen:
                continue
            seen.add(segment.label)
            for method, (theory, error_of) in METHODS.items():
                found.append(_order(part_id, segment.label.value, segment.curve, method, theory, error_of))
    return found


def _order(
    part: str, label: str, curve: Curve, method: str, theory: float, error_of: Callable[[Curve, int], float]
) -> Order:
    floor = _FLOORS * _ROUNDING * float(np.max(np.abs(curve.point(np.array(curve.domain)))))
    counts, errors, count = [], [], LEAST_PIECES
    while count <= _MOST_PIECES:
        error = error_of(curve, count)
        if error < floor:
            break
        counts.append(count)
        errors.append(error)
        count *= 2
    observed = -float(np.polyfit(np.log(counts), np.log(errors), 1)[0]) if len(counts) > 1 else None
    return Order(part, label, method, theory, observed, tuple(counts), tuple(errors))


def write_csv(folder: Path, rungs: list[Rung], found: list[Order]) -> list[str]:
    """A table beside each picture: of the files and, where there are any, of the curves."""
    heads = "file,format,tolerance_mm,declared_mm,measured_mm,edges,bytes,s,spread_s"
    tables: dict[str, list[tuple[object, ...]]] = {"time": [tuple(heads.split(",")), *map(astuple, rungs)]}
    if found:
        heads = "part,curve,method,order_of_method,observed_order,pieces,error_mm"
        tables["pieces"] = [tuple(heads.split(","))]
        for o in found:
            same = o.part, o.curve, o.method, o.theory, o.observed
            tables["pieces"] += [(*same, *point) for point in zip(o.counts, o.errors, strict=True)]
    for name, rows in tables.items():
        with (folder / f"converge.{name}.csv").open("w", encoding="utf-8", newline="") as stream:
            csv.writer(stream, lineterminator="\n").writerows(rows)
    return [f"converge.{name}.csv" for name in tables]


def write_pictures(folder: Path, rungs: list[Rung], found: list[Order], told: Words) -> list[str]:
    """Log-log pictures: error against run time of the files, error against pieces of the curves."""
    files = {r.file: [x for x in rungs if x.file == r.file] for r in rungs}
    runs: list[Series] = [(name, [r.seconds for r in row], [r.measured for r in row]) for name, row in files.items()]
    names = ["converge.time.svg", "converge.pieces.svg"]
    axes = told.text("time to write, s"), told.text("error, mm")
    write_loglog(folder / names[0], told.text("measured error against run time"), axes, runs)
    curves: list[Series] = [
        (f"{curve_name(o, told)} {told.text(o.method)}{_order_text(o)}", [float(c) for c in o.counts], list(o.errors))
        for o in found
    ]
    if not curves:
        return names[:1]
    axes = told.text("pieces of a curve"), told.text("error, mm")
    write_loglog(folder / names[1], told.text("error against pieces; order in the key"), axes, curves)
    return names


def _order_text(order: Order) -> str:
    return "" if order.observed is None else f" {order.observed:.2f}"
