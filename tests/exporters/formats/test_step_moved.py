"""Poles and knots of spline surfaces moved in a file: what our reader passes moves nothing beyond the declared error.

A pole that is moved along its surface, or the last knot of a patch, may change no more than how the surface is run
through. The kernel is the judge: points of the moved surface are projected onto that of the good file.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.production.recheck import recheck
from parts.solids.kernel import faces_of, solids_of
from tests.exporters.making import read_report, run

TOLERANCE = 1e-6
MOVES, SAMPLES = 12, 13


@pytest.fixture(scope="module")
def barrel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("barrel")
    assert run("build", "barrel_cam", "--part", "barrel", "--format", "step", "--out", folder) == 0
    return folder / "barrel_cam"


def surfaces(text: str) -> list[Any]:
    """The spline surfaces of a file's faces, by the kernel."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    faces = (face for solid in solids_of(text) for face in faces_of(solid))
    splines = (f for f in faces if BRepAdaptor_Surface(f).GetType() == GeomAbs_SurfaceType.GeomAbs_BSplineSurface)
    return [BRep_Tool.Surface_s(face) for face in splines]


def way_moved(number: int, before: str, after: str) -> float:
    """How far the points of a surface lie off the same one of another file, mm."""
    from OCP.GeomAPI import GeomAPI_ProjectPointOnSurf

    old, new = (surfaces(text)[number] for text in (before, after))
    u0, u1, v0, v1 = new.Bounds()
    places = (new.Value(u, v) for u in np.linspace(u0, u1, SAMPLES) for v in np.linspace(v0, v1, SAMPLES))
    return max(GeomAPI_ProjectPointOnSurf(place, old).LowerDistance() for place in places)


def moved(text: str, draw: random.Random) -> Iterator[tuple[int, str]]:
    """Texts with one pole moved by two tolerances any way, or one knot by 2 % of its span, and which surface it is."""
    splines = list(re.finditer(r"=B_SPLINE_SURFACE_WITH_KNOTS\('',\d,\d,(.*?),\.UNSPECIFIED\..*?;", text, re.DOTALL))
    for turn in range(MOVES):
        number = draw.randrange(len(splines))
        spline = splines[number]
        if turn % 4 == 3:
            listed = list(re.finditer(r"\(([-+.\dE]+(?:,[-+.\dE]+)+)\)", spline[0]))[-1 - draw.randrange(2)]
            knots = [float(x) for x in listed[1].split(",")]
            place = draw.randrange(1, len(knots))
            knots[place] -= 0.02 * (knots[place] - knots[place - 1])
            start = spline.start()
            told = ",".join(f"{x:.12f}" for x in knots)
            yield number, f"{text[: start + listed.start(1)]}{told}{text[start + listed.end(1) :]}"
            continue
        pole = draw.choice(re.findall(r"#\d+", spline[1]))
        point = re.search(rf"\n{pole}=CARTESIAN_POINT\('',\(([^)]*)\)", text)
        assert point is not None
        way = np.array([draw.gauss(0.0, 1.0) for _ in range(3)])
        at = np.array([float(x) for x in point[1].split(",")]) + 2 * TOLERANCE * way / np.linalg.norm(way)
        yield number, f"{text[: point.start(1)]}{','.join(f'{x:.12f}' for x in at)}{text[point.end(1) :]}"


@pytest.mark.heavy
def test_a_spoil_that_passes_moves_nothing_beyond_the_error(barrel: Path, tmp_path: Path) -> None:
    file, text = tmp_path / "barrel.step", (barrel / "barrel.step").read_text(encoding="ascii")
    (tmp_path / "report.json").write_bytes((barrel / "report.json").read_bytes())
    (entry,) = read_report(barrel)["files"]
    passed = []
    for number, spoiled in moved(text, random.Random(5)):
        file.write_text(spoiled, encoding="ascii", newline="\n")
        if not recheck(file).verdict.failures:
            passed.append(way_moved(number, text, spoiled))
    # most are caught, some are none
    assert 0 < len(passed) < MOVES / 2
    assert max(passed) < entry["max_error"]
