"""Closing tables: plain columns of at most 80 letters where they fit, drawn ones on a terminal."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from exporters.command.converge import converge_tables
from exporters.command.tables import _show_rich
from exporters.command.verify import verify_table
from exporters.production.converge import METHODS, Order, Rung
from parts.base.texts import words

NAMES = ["a.svg", "b" * 13 + ".svg", "c" * 14 + ".svg"]
RUNGS = [Rung(name, "svg", 0.01, 0.00912345, 0.0081, 120 + k, 12_340, 0.0123, 0.0004) for k, name in enumerate(NAMES)]
ORDERS = [
    Order("g", "flank", "arcs", 3.0, 2.98765, (16, 32, 64), (1e-3, 1e-4, 1.25e-5)),
    Order("g", "fillet", "chords", 2.0, None, (16,), (3e-9,)),
    Order("g", "root", "splines", 8.0, None, (), ()),
]


def told(capsys: pytest.CaptureFixture[str]) -> list[str]:
    return capsys.readouterr().out.splitlines()


def test_errors_and_orders_are_told_in_columns(capsys: pytest.CaptureFixture[str]) -> None:
    converge_tables(RUNGS, ORDERS, [Path("p.svg"), Path("q.svg")], words("en"))
    lines = told(capsys)
    assert lines[0] == "error against run time"
    second = lines.index("orders of convergence")
    head, *rows = lines[1:second]
    # columns end where their names do
    values = ["0.01", "0.00912", "0.0081", "120", "12.3", "12.30", "0.40"]
    ends = [m.end() for m in re.finditer(r"\S+(?: \S+)*", head)][1:]
    # so many columns leave no room for a name beside them
    assert rows[::2] == NAMES
    assert [m.end() for m in re.finditer(r"\S+", rows[1])] == ends
    assert rows[1].split() == values
    assert len({len(row) for row in rows if re.search(r"\d$", row)} | {len(head)}) == 1
    head, *rows = lines[second + 1 :]
    assert [re.split(r"  +", row.strip()) for row in rows[:-2]] == [
        ["g flank"], ["arcs", "3", "2.988", "16 to 64", "1.25e-05"],
        ["g fillet"], ["chords", "2", "-", "16 to 16", "3e-09"],
        ["g root"], ["splines", "8", "-", "below rounding at 16", "-"],
    ]  # fmt: skip
    assert rows[-2:] == ["p.svg", "q.svg"]


def test_a_table_of_nothing_is_not_shown(capsys: pytest.CaptureFixture[str]) -> None:
    """Of a disk, which has no curve to come near, a heading of orders stood over nothing."""
    converge_tables(RUNGS, [], [Path("p.svg")], words("en"))
    lines = told(capsys)
    assert "orders of convergence" not in lines
    assert not any(line.startswith("curve") for line in lines)
    assert lines[-1] == "p.svg"


def checked(file: str, **changes: Any) -> Any:
    verdict = SimpleNamespace(measured={"max_deviation": 1.23456e-3}, failures=())
    return SimpleNamespace(**{"file": Path(file), "verdict": verdict, "same_bytes": True, "declared": 2e-3,
                              "tolerance": 5e-3} | changes)  # fmt: skip


@pytest.mark.parametrize("length", [1, 4, 6, 7, 8, 9, 60, 120])
def test_a_name_without_room_stands_on_a_line_of_its_own(length: int, capsys: pytest.CaptureFixture[str]) -> None:
    """Beside columns of 18, 12, 13, 11 and 9 letters a page of 80 has room for 7."""
    verify_table([checked("x" * length), checked("short")], words("en"))
    head, *rows = told(capsys)
    numbers = ["0.00123", "0.002", "0.005", "as reported", "ok"]
    assert (rows[0] == "x" * length) == (len(rows) == 3) == (length > 7)
    assert [re.split(r"  +", row.strip()) for row in rows[-2:]] == [
        numbers if length > 7 else ["x" * length, *numbers], ["short", *numbers]]  # fmt: skip
    first = max(5, length) if length <= 7 else 5
    assert {len(row) for row in (head, *rows[-2:])} == {73 + first}


def test_what_was_verified_is_told_with_its_faults(capsys: pytest.CaptureFixture[str]) -> None:
    bad = SimpleNamespace(measured={}, failures=("is wrong", "is short"))
    results = [checked("a"), checked("b", verdict=bad, same_bytes=False), checked("p", tolerance=0.0, declared=0.0)]
    verify_table(results, words("en"))
    head, *rows = told(capsys)
    assert re.split(r"  +", head) == [
        "file",
        "measured error, mm",
        "declared, mm",
        "tolerance, mm",
        "bytes",
        "read back",
    ]
    assert [re.split(r"  +", row) for row in rows[:3]] == [
        ["a", "0.00123", "0.002", "0.005", "as reported", "ok"],
        ["b", "-", "0.002", "0.005", "changed", "FAILED"],
        ["p", "0.00123", "-", "-", "as reported", "ok"],
    ]
    assert rows[3:] == ["FAILED: b: is wrong", "FAILED: b: is short"]


def test_methods_are_told_in_the_language(capsys: pytest.CaptureFixture[str]) -> None:
    converge_tables([], [Order("g", "flank", name, 2.0, None, (16,), (1e-3,)) for name in METHODS], [], words("uk"))
    lines = "\n".join(told(capsys))
    assert "сплайни 7-го степеня" in lines
    assert not any(name in lines for name in METHODS)


def test_a_terminal_has_the_same_table_drawn(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    converge_tables(RUNGS, ORDERS, [], words("en"))
    text = capsys.readouterr().out
    plain = re.sub(r"\x1b\[[\d;]*m", "", text)
    for word in (*NAMES, "error against run time", "orders of convergence", "order of the method", "2.988", "0.00912"):
        assert word in plain
    rows = [re.split(r"\s*[│┃|]\s*", line.strip("│┃| ")) for line in plain.splitlines() if "a.svg" in line]
    assert rows == [["a.svg", "0.01", "0.00912", "0.0081", "120", "12.3", "12.30", "0.40"]]


def test_a_drawn_table_has_words_as_they_are(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Names of pictures and numbers are words like others, on a terminal with colours too."""
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm-256color")
    _show_rich("of :gear: [red]", ["a", "b"], [[":key:", "[bold]12"]])
    shown = capsys.readouterr().out
    plain = re.sub(r"\x1b\[[\d;]*m", "", shown)
    assert [word in plain for word in (":gear: [red]", ":key:", "[bold]12")] == [True] * 3
    # a number of a row has no colour of its own
    assert not re.search(r"\x1b\[[\d;]*m12", shown)


def test_a_narrow_terminal_has_every_digit(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "24")
    _show_rich("", ["file", "error, mm", "kB"], [["wheel.step", "9.76e-07 (certified)", "8306.2"]])
    cells = [re.split("[│┃]", line)[1:4] for line in capsys.readouterr().out.splitlines() if line[:1] in "│┃"]
    told = ["".join(column).replace(" ", "") for column in zip(*cells, strict=True)]
    assert told == ["filewheel.step", "error,mm9.76e-07(certified)", "kB8306.2"]
