"""A calculation as text for a terminal, Markdown, a page of HTML, or JSON with all digits."""

from __future__ import annotations

import html
import json
import re
from typing import Any

from exporters.calculations.sheet import Section, Sheet, Step, formula_text, number, numbers_text, unit_text
from exporters.calculations.symbols import symbol_text
from exporters.calculations.tables import html_table, markdown_table, plain_table, table_data
from exporters.calculations.words import TERMS

_GEARS = {1: "first", 2: "second"}
FORMATS = ("text", "md", "html", "json")
_WORDS = {
    "practicum": ("practicum", "практикум"),
    "guidelines": ("guidelines", "методичні вказівки"),
    "Savvin": ("Savvin", "Саввін"),
    "thesis": ("thesis", "дипломна робота"),
    "GOST": ("GOST", "ГОСТ"),
    "table": ("table", "табл."),
    "fig": ("fig", "рис"),
    "lesson": ("lesson", "заняття"),
}
_LABELS = {
    "printed": ("printed in the source", "у джерелі надруковано"),
    "note": ("note", "зауваження"),
    "gear": ("gear", "колесо"),
    "quantity": ("quantity", "параметр"),
    "formula": ("formula and numbers", "формули і підрахунки"),
    "result": ("result", "результат"),
    "source": ("source", "джерело"),
}


def render(sheet: Sheet, form: str, language: str) -> str:
    """The calculation in one of ``FORMATS`` and a language ("en" or "uk"), ending in a line feed."""
    return {"text": _text, "md": _markdown, "html": _html, "json": _json}[form](sheet, language)


def _pick(pair: tuple[str, str], language: str) -> str:
    return pair[1 if language == "uk" else 0]


def source_text(source: str, language: str) -> str:
    """A source as printed; "practicum (3.4)" reads "практикум (3.4)" in Ukrainian."""
    for word, pair in _WORDS.items():
        source = re.sub(rf"\b{word}\b", _pick(pair, language), source)
    return source


def step_name(step: Step, language: str) -> str:
    """The quantity in words, with the gear it belongs to."""
    term = TERMS[step.name]
    name = term.uk if language == "uk" else term.en
    more = f"{_pick(_LABELS['gear'], language)} {step.gear}" if step.gear else _pick(step.of, language)
    return f"{name}, {more}" if more else name


def result_text(step: Step, language: str) -> str:
    """Value and unit."""
    unit = unit_text(step.unit, language)
    gap = "" if unit in ("°", "%") or not unit else " "
    return f"{number(step.value, step.unit)}{gap}{unit}"


def equation(step: Step, language: str) -> str:
    """Symbol = formula = numbers = result, as far as the step has them."""
    parts = [symbol_text(step.symbol, language)]
    if step.formula:
        parts += [formula_text(step, language), numbers_text(step, language)]
    if len(parts) > 1 and parts[-1] == number(step.value, step.unit, enclosed=True):
        parts.pop()
    return " = ".join([*dict.fromkeys(parts), result_text(step, language)])


def printed_text(step: Step, language: str) -> str:
    """What a wrong source prints, and why it is wrong; empty where it is right."""
    if step.printed is None:
        return ""
    why = step.printed.uk if language == "uk" else step.printed.en
    return f"{_pick(_LABELS['printed'], language)}: {step.printed.text} ({why})"


def _text(sheet: Sheet, language: str) -> str:
    lines = [_pick(sheet.title, language), ""]
    for section in sheet.sections:
        lines += [_pick(section.title, language), "-" * len(_pick(section.title, language))]
        for step in section.steps:
            source = f"  [{source_text(step.source, language)}]" if step.source else ""
            lines.append(f"{step_name(step, language)}{source}")
            lines.append(f"    {equation(step, language)}")
            if step.printed is not None:
                lines.append(f"    ! {printed_text(step, language)}")
        lines.append("")
    for table in sheet.tables:
        lines += [*plain_table(table, language), ""]
    if sheet.plain_picture:
        lines += [sheet.plain_picture, ""]
    lines += [f"{_pick(_LABELS['note'], language)}: {_pick(note, language)}" for note in sheet.notes]
    return "\n".join(lines).rstrip("\n") + "\n"


def _markdown(sheet: Sheet, language: str) -> str:
    lines = [f"# {_pick(sheet.title, language)}", ""]
    head = [_pick(_LABELS[key], language) for key in ("quantity", "formula", "result", "source")]
    for section in sheet.sections:
        lines += [f"## {_pick(section.title, language)}", "", _row(head), _row(["---"] * 4)]
        lines += [_row([_escaped_md(cell) for cell in _cells(step, language)]) for step in section.steps]
        lines.append("")
    for table in sheet.tables:
        lines += [*markdown_table(table, language), ""]
    if sheet.plain_picture:
        lines += ["```", sheet.plain_picture, "```", ""]
    lines += [f"- {_escaped_md(_pick(note, language))}" for note in sheet.notes]
    return "\n".join(lines).rstrip("\n") + "\n"


def _cells(step: Step, language: str) -> list[str]:
    """Name, formula with numbers, result, source with what is misprinted there."""
    parts = [symbol_text(step.symbol, language), formula_text(step, language), numbers_text(step, language)]
    if parts[-1] == number(step.value, step.unit, enclosed=True):
        parts.pop()
    working = " = ".join(dict.fromkeys(filter(None, parts)))
    source = source_text(step.source, language)
    remark = "; ".join(filter(None, (source, printed_text(step, language))))
    return [step_name(step, language), working, result_text(step, language), remark]


def _row(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _escaped_md(text: str) -> str:
    return re.sub(r"([\\|*_<>`\[\]])", r"\\\1", text)


_STYLE = """body{font:16px/1.5 Georgia,serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}
table{border-collapse:collapse;width:100%;margin-bottom:1.5rem}td,th{border-bottom:1px solid #ddd;padding:.3rem .6rem;
text-align:left;vertical-align:top}td.r{white-space:nowrap;font-weight:bold}td.f{font-style:italic}
td.f{width:46%}sub{line-height:0;font-size:.7em}tr{page-break-inside:avoid}
span.w{color:#a00}h2{font-size:1.15rem;margin:1.5rem 0 .4rem}svg{max-width:100%;height:auto}
@page{margin:12mm}@media print{body{margin:0;max-width:none;font-size:11px}}"""


def _html(sheet: Sheet, language: str) -> str:
    title = html.escape(_pick(sheet.title, language))
    lines = [
        f'<!DOCTYPE html>\n<html lang="{language}">\n<head>\n<meta charset="utf-8">',
        f"<title>{title}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>",
    ]
    for section in sheet.sections:
        lines.append(_html_section(section, language))
    lines += [html_table(table, language) for table in sheet.tables]
    if language in sheet.pictures:
        lines.append(f"<figure>{sheet.pictures[language]}</figure>")
    if sheet.notes:
        items = "".join(f"<li>{html.escape(_pick(note, language))}</li>" for note in sheet.notes)
        lines.append(f"<ul>{items}</ul>")
    return "\n".join([*lines, "</body>\n</html>"]) + "\n"


def _html_section(section: Section, language: str) -> str:
    head = "".join(f"<th>{_pick(_LABELS[k], language)}</th>" for k in ("quantity", "formula", "result", "source"))
    rows = [f"<tr>{head}</tr>"]
    for step in section.steps:
        name, working, result, _ = _cells(step, language)
        source = html.escape(source_text(step.source, language))
        if step.printed is not None:
            source += f' <span class="w">{html.escape(printed_text(step, language))}</span>'
        cells = [
            f"<td>{html.escape(name)}</td>",
            f'<td class="f">{_subscripts(working)}</td>',
            f'<td class="r">{html.escape(result)}</td>',
            f"<td>{source}</td>",
        ]
        rows.append(f"<tr>{''.join(cells)}</tr>")
    return f"<h2>{html.escape(_pick(section.title, language))}</h2>\n<table>\n" + "\n".join(rows) + "\n</table>"


def _subscripts(text: str) -> str:
    """r_b1 as r with a lowered b1, z1 as z with a lowered 1."""
    text = re.sub(r"_([0-9A-Za-zΑ-ωΣа-яіїєґ.]+)", r"<sub>\1</sub>", html.escape(text))
    return re.sub(r"(?<![\w&;#>])([A-Za-zα-ω])([12])(?![\w.])", r"\1<sub>\2</sub>", text)


def _json(sheet: Sheet, language: str) -> str:
    values: dict[str, Any] = {}
    steps = []
    for section in sheet.sections:
        for step in section.steps:
            _keep(values, step)
            steps.append({"section": _pick(section.title, language), **_json_step(step, language)})
    notes = [_pick(note, language) for note in sheet.notes]
    data = {"topic": sheet.topic, "values": values, "steps": steps, "notes": notes, **sheet.data}
    data |= {table.name: table_data(table) for table in sheet.tables}
    return json.dumps(data, ensure_ascii=False, indent=1, allow_nan=False) + "\n"


def _keep(values: dict[str, Any], step: Step) -> None:
    """The value under its name, and under first or second where it belongs to a gear; the first one stays."""
    if step.gear:
        values.setdefault(step.name, {}).setdefault(_GEARS[step.gear], _finite(step.value))
    else:
        values.setdefault(step.name, _finite(step.value))


def _json_step(step: Step, language: str) -> dict[str, Any]:
    return {
        "name": step.name,
        **({"gear": _GEARS[step.gear]} if step.gear else {}),
        "text": step_name(step, language),
        "symbol": symbol_text(step.symbol, language),
        "formula": formula_text(step, language),
        "numbers": numbers_text(step, language),
        "value": _finite(step.value),
        "unit": step.unit,
        "source": source_text(step.source, language),
        **({"misprint": printed_text(step, language)} if step.printed else {}),
    }


def _finite(value: Any) -> Any:
    """JSON has no infinity."""
    return None if isinstance(value, float) and value in (float("inf"), float("-inf")) else value
