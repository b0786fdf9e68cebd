"""``higherpair converge``: error against run time, over a ladder of tolerances."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from exporters.command.asked import DONE, FAILED, scene_of
from exporters.command.tables import Columns, show
from exporters.production.converge import (
    LEAST_PIECES,
    Order,
    Rung,
    curve_name,
    ladder,
    orders,
    write_csv,
    write_pictures,
)
from exporters.production.moving import alone_in, move_into, staging_folder
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.base.texts import N_, Words, words


def run(options: Namespace) -> int:
    """The exit code."""
    scene = scene_of(options.scene, options)
    plan = plan_build(scene, options.scene, options.part, options.format)
    if not plan.jobs:
        raise SceneError(options.scene, "exports", None, "nothing_to_measure")
    folder = options.out / scene.name
    told = words(scene.scene.language)
    with staging_folder(folder) as staging:
        rungs, found = ladder(plan, staging), orders(plan)
        names = [*write_csv(staging, rungs, found), *write_pictures(staging, rungs, found, told)]
        with alone_in(folder):
            move_into(folder, staging, names)
    converge_tables(rungs, found, [folder / name for name in names], told)
    return FAILED if any(r.measured > r.max_error for r in rungs) else DONE


def converge_tables(rungs: list[Rung], found: list[Order], files: list[Path], told: Words) -> None:
    """Error against run time of every file, and the order of every method on every curve."""
    columns: Columns[Rung] = (
        (N_("file"), lambda r: r.file),
        (N_("tolerance, mm"), lambda r: f"{r.tolerance:g}"),
        (N_("declared, mm"), lambda r: f"{r.max_error:.3g}"),
        (N_("measured, mm"), lambda r: f"{r.measured:.3g}"),
        (N_("edges"), lambda r: str(r.entities)),
        (N_("kB"), lambda r: f"{r.bytes / 1000:.1f}"),
        (N_("ms (least)"), lambda r: f"{1000 * r.seconds:.2f}"),
        (N_("spread, ms"), lambda r: f"{1000 * r.spread:.2f}"),
    )
    show(told.text("error against run time"), columns, rungs, told, [])

    def pieces(o: Order) -> str:
        if not o.counts:
            return told.text("below rounding at {pieces}", pieces=LEAST_PIECES)
        return told.text("{first} to {last}", first=o.counts[0], last=o.counts[-1])

    of_orders: Columns[Order] = (
        (N_("curve"), lambda o: curve_name(o, told)),
        (N_("method"), lambda o: told.text(o.method)),
        (N_("order of the method"), lambda o: f"{o.theory:g}"),
        (N_("observed order"), lambda o: "-" if o.observed is None else f"{o.observed:.3f}"),
        (N_("pieces"), pieces),
        (N_("error there, mm"), lambda o: f"{o.errors[-1]:.3g}" if o.errors else "-"),
    )
    show(told.text("orders of convergence"), of_orders, found, told, [str(file) for file in files])
