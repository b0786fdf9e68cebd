"""The reading of files: crossings of walls are seen, loops are chained whatever their order."""

from __future__ import annotations

import random
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from exporters.formats.chains import chained
from exporters.verification.judge import verify_file
from parts.base.readback import ReadError
from parts.scene.formats import FILE_KINDS
from parts.scene.load import load_scene, make_parts
from tests.exporters.making import build_gear
from tests.exporters.outside import Gear

GEAR = Gear(2.0, 12, bore=8.0)


def ring(centre: complex, radius: float, pieces: int) -> list[np.ndarray]:
    """Arcs of a circle, each from its first to its last point."""
    turns = np.linspace(0, 2 * np.pi, pieces + 1)
    return [centre + radius * np.exp(1j * np.linspace(a, b, 9)) for a, b in pairwise(turns)]


def test_loops_are_chained_from_pieces_in_any_order_and_sense() -> None:
    draw = random.Random(5)
    rings = [(0j, 30.0, 700), (0j, 20.0, 300), (3 + 0j, 2.0, 1), (-3 + 0j, 2.0, 1)]
    pieces = [p[::-1] if draw.random() < 0.5 else p for centre, r, n in rings for p in ring(centre, r, n)]
    draw.shuffle(pieces)
    loops = chained(pieces)
    assert sorted(len(loop) for loop in loops) == [8, 8, 2400, 5600]
    for loop in loops:
        steps = np.abs(loop - np.roll(loop, 1))
        # every step is as long as the next: no jump at a joint
        assert steps.max() < 1.001 * steps.min()
    assert chained([]) == []


@pytest.mark.sampled(1)
@pytest.mark.parametrize("lost", [0, 350, 699])
def test_an_open_loop_is_told(lost: int) -> None:
    pieces = ring(0j, 30.0, 700)
    del pieces[lost]
    with pytest.raises(ReadError, match="open"):
        chained(pieces)
    gap = ring(0j, 30.0, 700)
    gap[lost] = gap[lost] + 1e-7
    with pytest.raises(ReadError, match="open"):
        chained(gap)


@pytest.fixture(scope="module")
def step_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("step")
    build_gear(folder, GEAR, {"format": "step"})
    return folder / "out" / "s" / "g.step"


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("flank", "turn"), [(0, -0.9), (20, 0.9)])
def test_a_wall_that_crosses_another_is_seen(step_file: Path, tmp_path: Path, flank: int, turn: float) -> None:
    text = step_file.read_text()
    splines = re.findall(r"B_SPLINE_CURVE_WITH_KNOTS\('',7,\((.*?)\)", text, re.DOTALL)
    for number in (3, 4):
        pole = splines[flank].split(",")[number].strip()
        line = re.search(rf"{pole}=CARTESIAN_POINT\('',\(([-+.E\d]+),([-+.E\d]+)", text)
        assert line is not None
        # the middle of a flank swings across the tooth, at both ends of the wall
        away = complex(float(line[1]), float(line[2])) * np.exp(1j * turn)
        text = text.replace(f"({line[1]},{line[2]},", f"({away.real:.8f},{away.imag:.8f},")
    file = tmp_path / "g.step"
    file.write_text(text)
    body = make_parts(load_scene(str(step_file.parents[2] / "s.toml")), "s")[0]["g"].body(0.0)
    assert "a contour crosses itself" in verify_file(file, FILE_KINDS["step"], body, 1e-6, 1e-6).failures
