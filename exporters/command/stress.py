"""``higherpair stress``: how many digits stiff and extreme cases leave."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from exporters.command.asked import DONE, FAILED, check_language, language_of_command, print_json
from exporters.command.tables import Columns, show
from exporters.production.moving import alone_in, move_into, staging_folder
from exporters.production.stress import Row, atlas, write_stress
from parts.base.texts import N_, Words, words


def run(options: Namespace) -> int:
    """The exit code."""
    check_language(options)
    told, folder = words(language_of_command(options)), options.out / "stress"
    # a folder that cannot be written is told before all is computed
    with staging_folder(folder) as staging:
        rows = atlas()
        names = write_stress(staging, rows, told)
        with alone_in(folder):
            move_into(folder, staging, names)
    lost = not all(row.is_stable for row in rows)
    if options.json:
        print_json([""], [{"rows": [row.told for row in rows]}])
    elif lost or not options.quiet:
        stress_table(rows, [folder / name for name in names], told)
    return FAILED if lost else DONE


def stress_table(rows: list[Row], files: list[Path], told: Words) -> None:
    """Every case from its easiest to its stiffest: condition numbers, errors, and what rounding allows."""
    columns: Columns[list[Row]] = (
        (N_("case"), lambda own: f"{told.text(own[0].case)}: {told.text(own[0].varied)}"),
        (N_("from"), lambda own: f"{own[0].value:g}"),
        (N_("to"), lambda own: f"{own[-1].value:g}"),
        (N_("condition"), lambda own: f"{max(r.condition for r in own):.2g}"),
        (N_("relative error"), lambda own: f"{max(r.relative for r in own):.2g}"),
        (N_("of what is allowed"), lambda own: f"{max(r.error / r.bound for r in own):.2g}"),
        (N_("verdict"), lambda own: told.text("stable") if all(r.is_stable for r in own) else told.text("UNSTABLE")),
    )
    cases = [[r for r in rows if r.case == case] for case in dict.fromkeys(r.case for r in rows)]
    title = told.text("stiff and extreme cases against 50 digits")
    show(title, columns, cases, told, [str(file) for file in files])
