"""``higherpair stress``: what its verdict rests on, and that it sees digits lost."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path

import mpmath
import numpy as np
import pytest

from exporters.production import atlas, stress
from exporters.production.atlas import CASES, MP, Case
from exporters.production.stress import Row, row_of
from geometry.base.record import replace
from tests.exporters.making import run

# half a second and more for each of their values: quadratures and roots at 50 digits
SLOW = (
    "area of a gear",
    "modified trapezoid with steep ramps, s at u = 0.3",
    "stiffness of two bodies pressed together",
)
QUICK = [(case, value) for case in CASES if case.name not in SLOW for value in case.values]
REST = [(case, value) for case in CASES if case.name in SLOW for value in case.values]


def test_every_quick_case_is_stable() -> None:
    rows = [row_of(case, value) for case, value in QUICK]
    assert [(r.case, r.value) for r in rows if not r.is_stable] == []
    # each case is driven to where its own digits are lost, or its numbers grow: none is there to be passed
    for case in {case.name: case for case, _ in QUICK}.values():
        assert max(case.values) > 30 * min(v for v in case.values if v > 0) or case.name.startswith(("acc", "per"))


@pytest.mark.heavy
@pytest.mark.parametrize(("case", "value"), REST)
def test_the_others_are_stable(case: Case, value: float) -> None:
    assert row_of(case, value).is_stable


def test_the_slowest_ones_are_stable_at_one_value() -> None:
    firsts = {case.name: (case, value) for case, value in REST}
    assert all(row_of(case, value).is_stable for case, value in firsts.values())


def _with(case: str, ours: Callable[..., complex]) -> list[Row]:
    """The rows of a case whose computation is another one."""
    real = next(c for c in CASES if c.name == case)
    return [row_of(replace(real, ours=ours), value) for value in real.values]


def test_textbook_formulas_that_lose_digits_are_found() -> None:
    """inv as a difference, the law of cosines as the thesis prints it, and Bernstein's polynomial by its powers."""
    naive = _with("involute function", lambda a: math.tan(a) - a)
    assert [r.is_stable for r in naive] == [False] * 4 + [True] * 4
    printed = _with(
        "angles of the two-disk table by its centre, equal arms",
        lambda x, y, one, two: complex(
            math.atan2(x, y) - math.acos(math.hypot(x, y) / (2 * one)),
            math.acos((one**2 + two**2 - x * x - y * y) / (2 * one * two)),
        ),
    )
    # beta itself is lost, and told so: its condition number at the centre is that of the radius
    assert printed[-1].error > 1e-14 > printed[0].error

    def by_powers(u: float, order: int) -> float:
        n = order - 1
        rate = np.polynomial.Polynomial([0.0, 1.0, -1.0]) ** n / float(mpmath.beta(order, order))
        return float(rate.deriv()(u))

    powers = _with("acceleration of a polynomial law by the end of its phase, u = 0.999", by_powers)
    assert not powers[-1].is_stable
    assert powers[0].is_stable


@pytest.mark.parametrize("share", [0.0, 1.0, 30.0])
def test_a_result_that_is_off_by_more_than_ten_roundings_is_found(share: float) -> None:
    """At the start, in the middle and at the end of a case."""
    case = next(c for c in CASES if c.name == "span over teeth")
    for value in (case.values[0], case.values[2], case.values[-1]):
        off = 1 + share * 2.0**-52
        wrong = Case("w", "z", (value,), case.inputs, lambda *x, o=off: complex(case.ours(*x)) * o, case.truth)
        assert row_of(wrong, value).is_stable == (share < 10)


def test_condition_numbers_are_those_of_calculus() -> None:
    """d inv / d alpha = tan^2 alpha; the inverse has the inverse of it; a product of powers has their sum."""
    for alpha in (0.01, 0.35, 1.3):
        row = row_of(CASES[0], alpha)
        expected = alpha * math.tan(alpha) ** 2 / (math.tan(alpha) - alpha)
        assert row.condition == pytest.approx(expected, rel=1e-9)
    cube = Case("x", "x", (1.5,), lambda v: (v, 3), lambda x, n: x**n, lambda x, n: x**n)
    row = row_of(cube, 1.5)
    assert row.condition == pytest.approx(3.0, rel=1e-12)
    # 1.5^3 is exact in both; whole numbers have no rounding
    assert row.error == 0
    assert row.bound == pytest.approx(10 * 2.0**-53 * 4 * 1.5**3)


def test_truths_are_those_of_other_sources() -> None:
    """Tables and integrals that share nothing with them."""
    # DIN 3960: inv 20 degrees
    assert float(atlas._inv(MP.pi / 9)) == pytest.approx(0.0149043838673, abs=1e-13)
    assert float(atlas._angle(atlas._inv(MP.mpf("0.4")))) == pytest.approx(0.4, rel=1e-15)
    # practicum, lesson 3: z 13 + 21, x 0.694 + 0.384
    angle = atlas._working(34, MP.mpf("1.078"), MP.pi / 9)
    assert float(170 * MP.cos(MP.pi / 9) / MP.cos(angle)) == pytest.approx(179.18264, abs=1e-5)
    # KHK: W of z 25, m 1, x 0 over 3 teeth
    assert float(atlas._span(MP.mpf(1), 25, MP.mpf(0), 3, MP.pi / 9)) == pytest.approx(7.7305, abs=5e-5)
    # a sphere on a plane, R 100, E* 115 GPa: F = 4/3 E* sqrt(R) delta^1.5
    assert float(atlas._stiffness(MP.mpf(0.01), MP.mpf(0.01 * (1 + 1e-9)))) == pytest.approx(4 / 3 * 115e3 * 10)
    # Ferguson's 100 / 101 - 100 / 99
    assert abs(atlas._carrier(100, 101, 100, 99) - 10_000) < MP.mpf(10) ** -40


@pytest.mark.heavy
def test_the_command_tells_all_and_writes_it(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    assert run("stress", "--out", tmp_path, "--json") == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    told = list(csv.DictReader((tmp_path / "stress" / "stress.csv").read_text("utf-8").splitlines()))
    assert len(rows) == len(told) == sum(len(case.values) for case in CASES)
    assert (tmp_path / "stress" / "stress.svg").is_file()


def test_a_folder_that_cannot_be_made_is_told_before_all_is_computed(
    tmp_path: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def computed() -> list[Row]:
        raise AssertionError

    monkeypatch.setattr("exporters.command.stress.atlas", computed)
    (tmp_path / "file").write_text("", "utf-8")
    assert run("stress", "--out", tmp_path / "file") == 2
    assert capsys.readouterr().err == (
        f"higherpair: {tmp_path / 'file' / 'stress'}: Not a directory; choose another place with --out\n"
    )


def _rows(error: float) -> list[Row]:
    return [Row("involute function", "α, rad", v, 0.5, error, 3.0, 1e-15) for v in (1e-8, 1.0)]


@pytest.mark.parametrize(("error", "code", "word"), [(1e-16, 0, "stable"), (2e-15, 1, "UNSTABLE")])
def test_a_lost_digit_is_the_exit_code(
    error: float, code: int, word: str, tmp_path: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("exporters.command.stress.atlas", lambda: _rows(error))
    assert run("stress", "--out", tmp_path) == code
    shown = capsys.readouterr().out
    assert shown.split()[-3] == word
    assert shown.splitlines()[-1] == str(tmp_path / "stress" / "stress.svg")
    row = next(csv.DictReader((tmp_path / "stress" / "stress.csv").read_text("utf-8").splitlines()))
    assert row == {
        "case": "involute function", "varied": "α, rad", "value": "1e-08", "result": "0.5", "error": repr(error),
        "condition": "3.0", "allowed": "1e-15", "stable": str(code == 0),
    }  # fmt: skip
    assert run("stress", "--out", tmp_path, "--quiet") == code
    assert bool(capsys.readouterr().out) == bool(code)


def test_without_mpmath_it_is_refused_by_what_installs_it(
    tmp_path: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stress, "find_spec", lambda name: None)
    assert run("stress", "--out", tmp_path / "out") == 2
    assert 'pip install ".[stress]"' in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
