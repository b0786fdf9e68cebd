"""The closing tables of the command: drawn by rich on a terminal, plain columns anywhere else."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from exporters.job import Job, Written
from exporters.plan import Plan
from exporters.words import finding_text, words

if TYPE_CHECKING:
    from exporters.converge import Order, Rung
    from exporters.recheck import Recheck


def build_table(plan: Plan, folder: Path, written: list[Written], previews: list[Path], checks: dict[str, Any]) -> None:
    """What a build has made, how far each file is from the exact curve, and what was noticed."""
    language = plan.scene.scene.language
    header = [words(language, key) for key in ("file", "error", "tolerance", "entities", "size", "check")]
    rows = [_row(item, folder, language) for item in written]
    remarks = [f"{words(language, 'preview')}: {preview}" for preview in previews]
    if any(item.failures for item in written):
        from exporters.kept import kept_lines
        from exporters.report import read_report

        kept = kept_lines(read_report(folder), language)
        remarks += [f"{words(language, 'bad')}: {line}" for line in kept]
    remarks += dict.fromkeys(_remarks(written, language))
    remarks += check_lines(checks, language)
    remarks += [f"{words(language, 'left_out')}: {what}: {why}" for what, why in plan.left_out]
    _show(plan.scene.scene.title or plan.scene.name, header, rows, remarks)


def _row(item: Written, folder: Path, language: str) -> list[str]:
    path = folder / item.job.path
    size = f"{path.stat().st_size / 1000:.1f}" if not item.failures else "-"
    count = ", ".join(f"{value} {name}" for name, value in item.entities.items())
    state = "bad" if item.failures else "good" if item.measured else "skipped"
    error = f"{item.max_error:.3g} ({words(language, item.bound)})"
    return [str(path), error, f"{item.job.export.tolerance:g}", count, size, words(language, state)]


def _remarks(written: list[Written], language: str) -> list[str]:
    lines = []
    for item in written:
        lines += [f"{words(language, 'bad')}: {item.job.path}: {failure}" for failure in item.failures]
    for item in written:
        part = item.job.part.id if isinstance(item.job, Job) else item.job.path
        lines += [f"{words(language, 'finding')}: {part}: {finding_text(language, f)}" for f in item.findings]
    return lines


def check_lines(checks: dict[str, Any], language: str) -> list[str]:
    """What the checks of a scene found, a line each."""
    lines = []
    for mate in _without_repeats(checks.get("mates", [])):
        text = _mate_head(mate, language)
        if "total_contact_ratio" in mate:
            text += words(language, "total_ratio").format(total=mate["total_contact_ratio"])
        if "verdict" in mate:
            text += f": {words(language, mate['verdict'])}, {words(language, 'gap').format(gap=mate['gap'])}"
            if mate["verdict"] == "clear" and mate["gap"] <= mate["tolerance"]:
                text += f"; {words(language, 'interrupted')}"
        if "walls" in mate:
            told = words(language, "groove_walls").format(**mate["walls"], clearance=mate["roller_clearance"])
            text += f"; {told}"
        lines.append(text)
        lines += _transmission(mate, language)
        lines += [f"{words(language, 'finding')}: {f['text']}" for f in mate.get("findings", [])]
        lines += [f"{words(language, 'broken')}: {c['text']}" for c in mate.get("conditions", []) if not c["met"]]
    for close in (*checks.get("neighbours", []), *checks.get("solids", [])):
        head = words(language, close.get("verdict", "finding"))
        lines.append(f"{head}: {close['text']}")
    for drive in checks.get("drives", []):
        train = ", ".join(f"{name} {turns:.6g}" for name, turns in drive["train"].items())
        lines.append(words(language, "drive").format(instance=drive["instance"], train=train))
    return lines


def _without_repeats(mates: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Mates of one kind and first one behind the other, of which there is no more to tell, as one with all seconds."""
    shown: list[dict[str, Any]] = []
    for mate in mates:
        last = shown[-1] if shown else {}
        told = "verdict" in mate or mate.get("findings") or not all(c["met"] for c in mate.get("conditions", []))
        if not told and mate["kind"] == "pin_seat" and all(last.get(k) == mate[k] for k in ("kind", "first")):
            shown[-1] = {**last, "second": f"{last['second']}, {mate['second']}"}
        else:
            shown.append(mate)
    return shown


def _transmission(mate: dict[str, Any], language: str) -> list[str]:
    """The transmission error of a mate, a line for each sense."""
    lines = []
    if mate.get("transmission_error", {}) is None:
        return [words(language, "transmission_of_involutes")]
    # helical teeth that bridge the gap along their face run on: only their section has no error of its own
    if mate.get("transmission_error") == {} and mate.get("total_contact_ratio", 0.0) < 1:
        lines.append(words(language, "no_transmission"))
    for sense, found in mate.get("transmission_error", {}).items():
        unit = "second_arcsec" if "second_arcsec" in found else "second_travel"
        motion = words(language, unit).format(value=found[unit], second=mate["second"])
        text = words(language, "transmission_error")
        lines.append(text.format(sense=words(language, sense), value=found["line_of_action"], motion=motion))
    return lines


def _mate_head(mate: dict[str, Any], language: str) -> str:
    """Who is joined and how: gear pairs with their numbers, other kinds in the words of their own."""
    if "contact_ratio" not in mate:
        return words(language, f"mate_{mate['kind']}").format(**mate)
    return words(language, "pair").format(
        first=mate["first"],
        second=mate["second"],
        a_w=mate["working_centre_distance"],
        alpha_w=mate["working_pressure_angle_deg"],
        # what undercut and fillets leave of it
        ratio=min(mate["contact_ratio"], mate["effective_contact_ratio"]),
    )


def has_bad_verdict(checks: dict[str, Any]) -> bool:
    """Whether something overlaps, could not be decided, or breaks a condition."""
    mates = checks.get("mates", [])
    bad = any(found.get("verdict") in ("overlap", "undecided") for found in (*mates, *checks.get("solids", [])))
    return bad or any(not condition["met"] for mate in mates for condition in mate.get("conditions", []))


def verify_table(results: list[Recheck]) -> None:
    """What was measured on files that lay on disk."""
    header = ["file", "measured error, mm", "declared, mm", "tolerance, mm", "bytes", "read back"]
    rows, remarks = [], []
    for r in results:
        deviation = r.verdict.measured.get("max_deviation")
        measured = "-" if deviation is None else f"{deviation:.3g}"
        state, same = "FAILED" if r.verdict.failures else "ok", "as reported" if r.same_bytes else "changed"
        rows.append([str(r.file), measured, f"{r.declared:.3g}", f"{r.tolerance:g}", same, state])
        remarks += [f"FAILED: {r.file}: {failure}" for failure in r.verdict.failures]
    _show("", header, rows, remarks)


def converge_tables(rungs: list[Rung], found: list[Order], files: list[Path]) -> None:
    """Error against run time of every file, and the order of every method on every curve."""
    header = ["file", "tolerance, mm", "declared, mm", "measured, mm", "edges", "kB", "ms (median)", "spread, ms"]
    rows = [
        [
            r.file,
            f"{r.tolerance:g}",
            f"{r.max_error:.3g}",
            f"{r.measured:.3g}",
            str(r.entities),
            f"{r.bytes / 1000:.1f}",
            f"{1000 * r.seconds:.2f}",
            f"{1000 * r.spread:.2f}",
        ]
        for r in rungs
    ]
    _show("error against run time", header, rows, [])
    from exporters.converge import LEAST_PIECES

    header = ["curve", "method", "order of the method", "observed order", "pieces", "error there, mm"]
    rows = [
        [
            f"{o.part} {o.curve}",
            o.method,
            f"{o.theory:g}",
            "-" if o.observed is None else f"{o.observed:.3f}",
            f"{o.counts[0]} to {o.counts[-1]}" if o.counts else f"below rounding at {LEAST_PIECES}",
            f"{o.errors[-1]:.3g}" if o.errors else "-",
        ]
        for o in found
    ]
    _show("orders of convergence", header, rows, [str(file) for file in files])


def _show(title: str, header: Sequence[str], rows: list[list[str]], remarks: list[str]) -> None:
    """One table and the lines below it. rich is loaded for a terminal only: it costs as much as a build."""
    if sys.stdout.isatty():
        _show_rich(title, header, rows)
    else:
        columns = list(zip(header, *rows, strict=True))
        widths = [max(map(len, column)) for column in columns]
        lines = [_printable(title)] if title else []
        for row in (header, *rows):
            cells = [row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:], widths[1:], strict=True))]
            lines.append("  ".join(cells))
        sys.stdout.write("\n".join(lines) + "\n")
    sys.stdout.write("".join(line + "\n" for line in remarks))


def _show_rich(title: str, header: Sequence[str], rows: list[list[str]]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    table = Table(title=escape(_printable(title)), title_justify="left")
    table.add_column(header[0], overflow="fold")
    for name in header[1:]:
        table.add_column(name, justify="right")
    for row in rows:
        table.add_row(*map(escape, row))
    Console(highlight=False, emoji=False).print(table)


def _printable(text: str) -> str:
    """A text without the characters that steer a terminal."""
    return "".join(c if c.isprintable() else " " for c in text)
