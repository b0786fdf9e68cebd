"""``higherpair verify``: files read back and compared with the part in their report."""

from __future__ import annotations

from argparse import Namespace

from exporters.command.asked import DONE, FAILED, WRONG_INPUT, check_language, each, print_json
from exporters.command.tables import Columns, show
from exporters.production.recheck import Recheck, recheck
from exporters.production.report import NAME, report_language
from parts.base.texts import N_, Words, words


def run(options: Namespace) -> int:
    """The exit code."""
    check_language(options)
    language = options.language or report_language(options.files[0])
    # of all that lies in a folder the report is none that is held against it
    files = [file for file in options.files if file.name != NAME] or options.files
    results, refused = each(files, recheck, lambda: language)
    failed = any(r.verdict.failures for r in results)
    if options.json:
        print_json(files, [r.told for r in results])
    elif results and not (options.quiet and not failed):
        verify_table(results, words(language))
    return FAILED if failed else WRONG_INPUT if refused else DONE


def verify_table(results: list[Recheck], told: Words) -> None:
    """What was measured on files that lay on disk."""

    def deviation(r: Recheck) -> str:
        found = r.verdict.measured.get("max_deviation")
        return "-" if found is None else f"{found:.3g}"

    columns: Columns[Recheck] = (
        (N_("file"), lambda r: str(r.file)),
        (N_("measured error, mm"), deviation),
        # a preview has neither: it is compared byte by byte
        (N_("declared, mm"), lambda r: f"{r.declared:.3g}" if r.tolerance else "-"),
        (N_("tolerance, mm"), lambda r: f"{r.tolerance:g}" if r.tolerance else "-"),
        (N_("bytes"), lambda r: told.text("as reported") if r.same_bytes else told.text("changed")),
        (N_("read back"), lambda r: told.text("FAILED") if r.verdict.failures else told.text("ok")),
    )
    failed = [(r.file, failure) for r in results for failure in r.verdict.failures]
    remarks = [told.text("FAILED: {why}", why=f"{file}: {told.say(failure)}") for file, failure in failed]
    show("", columns, results, told, remarks)
