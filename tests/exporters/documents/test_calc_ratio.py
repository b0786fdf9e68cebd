"""Numbers of teeth for a ratio, against all numbers there are, each set judged by exact fractions."""

from __future__ import annotations

import itertools
import json
import math
from fractions import Fraction

import pytest

from geometry.gears.pairs.ratios import teeth_for
from tests.exporters.making import run

LEAST, MOST = 6, 21


def front(ratio: Fraction, stages: int, share: Fraction, *, coaxial: bool) -> set[tuple[int, ...]]:
    """Of all numbers those that no set with fewer teeth, or as few, is nearer than."""
    judged = []
    up = max(ratio, 1 / ratio)
    for head in itertools.product(range(LEAST, MOST + 1), repeat=2 * stages - 1):
        # the other wheels leave the last one of a coaxial set no choice, nor does the ratio that of another
        asked = up * math.prod(head[::2]) / math.prod(head[1::2])
        last = head[0] + head[1] - head[2] if coaxial else min(max(math.floor(asked + Fraction(1, 2)), LEAST), MOST)
        teeth = (*head, last)
        parts = [Fraction(b, a) for a, b in zip(teeth[::2], teeth[1::2], strict=True)]
        off = abs(math.prod(parts) / up - 1)
        ordered = sorted(parts) == parts and (stages == 1 or parts[0] >= 1)
        if ordered and off <= share and LEAST <= last <= MOST:
            judged.append((sum(teeth), off, teeth))
    kept, nearest = set[tuple[int, ...]](), Fraction(10)
    for _, group in itertools.groupby(sorted(judged), key=lambda one: one[0]):
        of_size = [*group]
        best = of_size[0][1]
        if best < nearest:
            nearest = best
            kept |= {teeth for _, off, teeth in of_size if off == best}
    if ratio >= 1:
        return kept
    return {tuple(z for a, b in zip(t[::2], t[1::2], strict=True) for z in (b, a)) for t in kept}


@pytest.mark.sampled(3)
@pytest.mark.parametrize("ratio", ["3.2", "1", "2.718281828", "0.31", "3.5"])
@pytest.mark.parametrize("share", ["0", "0.002", "0.05"])
def test_one_pair_has_the_fewest_teeth_of_all(ratio: str, share: str) -> None:
    found = teeth_for(Fraction(ratio), 1, LEAST, MOST, float(share))
    assert {*found} == front(Fraction(ratio), 1, Fraction(share), coaxial=False)
    assert len({*found}) == len(found)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("coaxial", [False, True])
@pytest.mark.parametrize(
    ("ratio", "share"),
    [("7.389", "0.01"), ("9", "0"), ("1.6", "0.002"), ("0.125", "0.01"), ("5", "0.1"), ("18/13", "0")],
)
def test_two_pairs_have_the_fewest_teeth_of_all(ratio: str, share: str, coaxial: bool) -> None:
    found = teeth_for(Fraction(ratio), 2, LEAST, MOST, float(share), coaxial=coaxial)
    wanted = front(Fraction(ratio), 2, Fraction(share), coaxial=coaxial)
    # both orders of stages of one ratio are one set and its like
    assert {*found} <= wanted
    assert {tuple(sorted(s)) for s in found} == {tuple(sorted(s)) for s in wanted}


def test_the_page_tells_the_fewest_teeth_and_355_of_113(capsys: pytest.CaptureFixture[str]) -> None:
    words = ("ratio=3.14159265", "most_teeth=300", "ratio_tolerance_percent=0.1", "module=2")
    assert run("calc", "ratio", *words, "--format", "json") == 0
    page = json.loads(capsys.readouterr().out)
    # 22/7, the nearest of small numbers
    assert page["values"]["number_of_teeth"] == {"first": 14, "second": 44}
    assert page["values"]["reference_centre_distance"] == 58.0
    assert run("calc", "ratio", "ratio=3.14159265", "least_teeth=113", "most_teeth=300", "--format", "json") == 2
    assert "2.65486725664 works" in capsys.readouterr().err
    # the teeth of the second pair ended in a traceback
    assert run("calc", "ratio", "ratio=12.368266", "stages=2", "--format", "json") == 0
    teeth = json.loads(capsys.readouterr().out)["values"]["number_of_teeth"]
    assert [*teeth] == ["first", "second", "third", "fourth"]
    ratio = teeth["second"] * teeth["fourth"] / (teeth["first"] * teeth["third"])
    assert abs(ratio / 12.368266 - 1) <= 0.005
    assert run("calc", "ratio", "ratio=12.368266", "stages=2", "--format", "csv") == 0
    assert any(line.startswith("19.0,47.0,12.0,60.0,") for line in capsys.readouterr().out.splitlines())


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("ratio=30",), "stages = 2 has more of them; 10 works"), (("ratio=300", "stages=2"), "that ratio; 100 works"),
        (("ratio=1000",), "ratio = 1000.0: no numbers of teeth within these limits have that ratio"),
        (("ratio=3", "coaxial=true"), "coaxial = true: is for two stages; false works"),
        (("ratio=1", "least_teeth=50", "most_teeth=20"), "at most 20 works"), ((), "ratio.ratio: is missing"),
        (("ratio=3", 'ratio_tolerance_percent="1 %"'), "did you mean 1?"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused(capsys: pytest.CaptureFixture[str], words: tuple[str, ...], told: str) -> None:
    assert run("calc", "ratio", *words) == 2
    assert told in capsys.readouterr().err
