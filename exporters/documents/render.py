"""A calculation as text for a terminal, Markdown, a page of HTML, JSON with all digits, or its tables as CSV."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from geometry.base.errors import Nearest
from parts.base.refusal import SceneError
from parts.base.texts import N_, Text, Words, words
from parts.pages.inputs import PLACE
from parts.pages.page import Section, Sheet, Step, formula_text, number, numbers_text
from parts.pages.symbols import subscripts, symbol_text
from parts.pages.tables import csv_table, html_table, markdown_table, plain_table, table_data
from parts.pages.text import printed_text, result_text, source_text, step_name

_GEARS = "", "first", "second", "third", "fourth"
# what speaks a language, and what is numbers alone
SPOKEN = ("text", "md", "html", "json")
FORMATS = (*SPOKEN, "csv")
_ENDINGS = {"": "text", ".txt": "text"} | {f".{form}": form for form in FORMATS[1:]} | {".htm": "html"}
# the heads of a page's columns
_HEADS = (N_("quantity"), N_("formula and numbers"), N_("result"), N_("source"))


def form_of(file: Path | None) -> str:
    """The one of ``FORMATS`` that a file's ending tells, text where it has none.

    Raises
    ------
    SceneError
        It ends as files of other programs do, which would not open it.
    """
    form = _ENDINGS.get("" if file is None else file.suffix.lower())
    if file is None or form is not None:
        return form or "text"
    known = [ending for ending in _ENDINGS if ending]
    raise SceneError(PLACE, "--out", file.name, "file_ends_in", Nearest(file.with_suffix(".html").name), known=known)


def render(sheet: Sheet, form: str, language: str) -> str:
    """The calculation in one of ``FORMATS`` and a language, ending in a line feed."""
    return {"text": _text, "md": _markdown, "html": _html, "json": _json, "csv": _csv}[form](sheet, words(language))


def _text(sheet: Sheet, told: Words) -> str:
    lines = [_phrase(sheet.title, told), ""]
    for section in sheet.sections:
        title = _phrase(section.title, told)
        lines += [title, "-" * len(title)]
        for step in section.steps:
            name, working, result, source, misprint = _cells(step, told)
            lines.append(f"{name}  [{source}]" if source else name)
            lines.append(f"    {working} = {result}" if working else f"    {result}")
            if misprint:
                lines.append(f"    ! {misprint}")
        lines.append("")
    for table in sheet.tables:
        lines += [*plain_table(table, told), ""]
    if sheet.plain_picture:
        lines += [sheet.plain_picture(told), ""]
    lines += [told.text("note: {text}", text=_phrase(note, told)) for note in sheet.notes]
    lines += ["", _phrase(sheet.signed, told)] if sheet.signed else []
    return "\n".join(lines).rstrip("\n") + "\n"


def _markdown(sheet: Sheet, told: Words) -> str:
    lines = [f"# {_phrase(sheet.title, told)}", ""]
    head = [told.text(head) for head in _HEADS]
    for section in sheet.sections:
        lines += [f"## {_phrase(section.title, told)}", "", _row(head), _row(["---"] * 4)]
        for step in section.steps:
            *cells, source, misprint = _cells(step, told)
            remark = "; ".join(filter(None, (source, misprint)))
            lines.append(_row([_escaped_md(cell) for cell in (*cells, remark)]))
        lines.append("")
    for table in sheet.tables:
        lines += [*markdown_table(table, told), ""]
    if sheet.plain_picture:
        lines += ["```", sheet.plain_picture(told), "```", ""]
    lines += [f"- {_escaped_md(_phrase(note, told))}" for note in sheet.notes]
    lines += ["", _escaped_md(_phrase(sheet.signed, told))] if sheet.signed else []
    return "\n".join(lines).rstrip("\n") + "\n"


def _phrase(text: Text, told: Words) -> str:
    """A text with its numbers as the language prints them."""
    return told.phrase(told.say(text))


def _cells(step: Step, told: Words) -> tuple[str, str, str, str, str]:
    """Name, formula with numbers, result, source, what is misprinted there; numbers as the language prints them."""
    parts = [symbol_text(step.symbol, told), formula_text(step, told), numbers_text(step, told)]
    if parts[-1] == number(step.value, step.unit, enclosed=True):
        parts.pop()
    working = " = ".join(dict.fromkeys(filter(None, parts)))
    result = result_text(step, told)
    return (
        told.phrase(step_name(step, told)), told.printed(working), told.printed(result) if _is_number(step) else result,
        source_text(step.source, told), told.phrase(printed_text(step, told)),
    )  # fmt: skip


def _row(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _escaped_md(text: str) -> str:
    return re.sub(r"([\\|*_<>`\[\]])", r"\\\1", text)


_STYLE = """body{font:16px/1.5 Georgia,serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}
table{border-collapse:collapse;width:100%;margin-bottom:1.5rem}td,th{border-bottom:1px solid #ddd;padding:.3rem .6rem;
text-align:left;vertical-align:top}td.r{white-space:nowrap;font-weight:bold}td.f{font-style:italic}
td.f{width:46%}sub{line-height:0;font-size:.7em}tr{page-break-inside:avoid}
span.w{color:#a00}h2{font-size:1.15rem;margin:1.5rem 0 .4rem}svg{max-width:100%;height:auto}
@media screen and (max-width:40rem){body{font-size:13px;margin:.5rem auto;padding:0 .4rem}
td,th{padding:.2rem .25rem}td.r{white-space:normal}td.f{width:auto;overflow-wrap:anywhere}}
@page{margin:12mm}@media print{body{margin:0;max-width:none;font-size:11px}figure{margin:0;page-break-inside:avoid}
svg{max-height:250mm}}"""


def _html(sheet: Sheet, told: Words) -> str:
    title = html.escape(_phrase(sheet.title, told))
    lines = [
        f'<!DOCTYPE html>\n<html lang="{told.language}">\n<head>\n<meta charset="utf-8">',
        # a phone takes a page for 980 px wide unless told
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{title}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>",
    ]
    for section in sheet.sections:
        lines.append(_html_section(section, told))
    lines += [html_table(table, told) for table in sheet.tables]
    if sheet.picture is not None:
        lines.append(f"<figure>{sheet.picture.svg(told)}</figure>")
    if sheet.notes:
        items = "".join(f"<li>{html.escape(_phrase(note, told))}</li>" for note in sheet.notes)
        lines.append(f"<ul>{items}</ul>")
    if sheet.signed:
        lines.append(f"<p>{html.escape(_phrase(sheet.signed, told))}</p>")
    return "\n".join([*lines, "</body>\n</html>"]) + "\n"


def _html_section(section: Section, told: Words) -> str:
    head = "".join(f"<th>{told.text(head)}</th>" for head in _HEADS)
    rows = [f"<tr>{head}</tr>"]
    for step in section.steps:
        name, working, result, source, misprint = _cells(step, told)
        remark = f' <span class="w">{html.escape(misprint)}</span>' if misprint else ""
        cells = [
            f"<td>{html.escape(name)}</td>",
            f'<td class="f">{subscripts(working)}</td>',
            f'<td class="r">{html.escape(result)}</td>',
            f"<td>{html.escape(source)}{remark}</td>",
        ]
        rows.append(f"<tr>{''.join(cells)}</tr>")
    return f"<h2>{html.escape(_phrase(section.title, told))}</h2>\n<table>\n" + "\n".join(rows) + "\n</table>"


def _is_number(step: Step) -> bool:
    """Whether a step's value is a number or a fraction, no words."""
    return not isinstance(step.value, str) or re.fullmatch(r"-?\d+(/\d+)?", step.value) is not None


def _json(sheet: Sheet, told: Words) -> str:
    every: dict[str, Any] = {}
    steps = []
    for section in sheet.sections:
        for step in section.steps:
            _keep(every, step)
            steps.append({"section": told.say(section.title), **_json_step(step, told)})
    notes = [told.say(note) for note in sheet.notes]
    values = {name: _each(found, lambda row: row[0]) for name, found in every.items()}
    again = {name: _each(found, list) for name, found in every.items() if _repeats(found)}
    data = {"topic": sheet.topic, "values": values, "repeated": again, "steps": steps, "notes": notes, **sheet.data}
    data |= {table.name: table_data(table) for table in sheet.tables}
    # with an indent json leaves its encoder in C for one in Python
    plain = json.dumps(data, ensure_ascii=False, allow_nan=False)
    return msgspec.json.format(plain, indent=1) + "\n"


def _csv(sheet: Sheet, told: Words) -> str:
    """The tables one after another, an empty line between them; the same in every language."""
    return "\n".join(map(csv_table, sheet.tables))


# those of a name, those of each gear under first and second
_Values = list[object] | dict[str, list[object]]


def _keep(every: dict[str, Any], step: Step) -> None:
    """The value beside others of its name, and under first or second where it belongs to a gear."""
    if step.gear:
        every.setdefault(step.name, {}).setdefault(_GEARS[step.gear], []).append(_finite(step.value))
    else:
        every.setdefault(step.name, []).append(_finite(step.value))


def _each(found: _Values, told: Callable[[list[object]], object]) -> object:
    """What is told of the values of a name, of each gear's where they are its."""
    return {gear: told(row) for gear, row in found.items()} if isinstance(found, dict) else told(found)


def _repeats(found: _Values) -> bool:
    return any(len(row) > 1 for row in (found.values() if isinstance(found, dict) else [found]))


def _json_step(step: Step, told: Words) -> dict[str, Any]:
    return {
        "name": step.name,
        **({"gear": _GEARS[step.gear]} if step.gear else {}),
        "text": step_name(step, told),
        "symbol": symbol_text(step.symbol, told),
        "formula": formula_text(step, told),
        "numbers": numbers_text(step, told),
        "value": _finite(step.value),
        "unit": step.unit,
        "source": source_text(step.source, told),
        **({"misprint": printed_text(step, told)} if step.printed else {}),
    }


def _finite(value: object) -> object:
    """JSON has no infinity."""
    return None if isinstance(value, float) and value in (float("inf"), float("-inf")) else value
