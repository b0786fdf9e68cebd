"""The closing tables of the command."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from exporters.job import Written
from exporters.plan import Plan
from exporters.recheck import Recheck
from exporters.words import finding_text, words


def build_table(console: Console, plan: Plan, folder: Path, written: list[Written], previews: list[Path]) -> None:
    """What a build has made, how far each file is from the exact curve, and what was noticed."""
    language = plan.scene.scene.language
    table = Table(title=plan.scene.scene.title or plan.scene.name, title_justify="left")
    table.add_column(words(language, "file"), overflow="fold")
    for key in ("error", "tolerance", "entities", "size", "check"):
        table.add_column(words(language, key), justify="right")
    for item in written:
        table.add_row(*_row(item, folder, language))
    console.print(table)
    for preview in previews:
        console.print(f"{words(language, 'preview')}: {preview}", markup=False)
    for line in dict.fromkeys(_remarks(written, language)):
        console.print(line, markup=False)
    for what, why in plan.left_out:
        console.print(f"{words(language, 'left_out')}: {what}: {why}", markup=False)


def _row(item: Written, folder: Path, language: str) -> tuple[str, ...]:
    path = folder / item.job.path
    state = "good" if item.measured else "skipped"
    size = f"{path.stat().st_size / 1000:.1f}" if not item.failures else "-"
    count = " ".join(f"{value} {name}" for name, value in item.entities.items())
    check = words(language, "bad" if item.failures else state)
    return escape(str(path)), f"{item.max_error:.3g} ({item.bound})", f"{item.job.export.tolerance:g}", count, size, check


def _remarks(written: list[Written], language: str) -> list[str]:
    lines = []
    for item in written:
        lines += [f"{words(language, 'bad')}: {item.job.path}: {failure}" for failure in item.failures]
    for item in written:
        lines += [f"{words(language, 'finding')}: {item.job.part.id}: {finding_text(language, f)}" for f in item.findings]
    return lines


def verify_table(console: Console, results: list[Recheck]) -> None:
    """What was measured on files that lay on disk."""
    table = Table()
    table.add_column("file", overflow="fold")
    for name in ("measured error, mm", "declared, mm", "tolerance, mm", "bytes", "read back"):
        table.add_column(name, justify="right")
    for r in results:
        deviation = r.verdict.measured.get("max_deviation")
        table.add_row(
            escape(str(r.file)), "-" if deviation is None else f"{deviation:.3g}", f"{r.declared:.3g}",
            f"{r.tolerance:g}", "as reported" if r.same_bytes else "changed", "FAILED" if r.verdict.failures else "ok",
        )
    console.print(table)
    for r in results:
        for failure in r.verdict.failures:
            console.print(f"FAILED: {r.file}: {failure}", markup=False)
