"""Turned solids in STEP files measured by their edges, against formulas of Archimedes and Pappus; faces turned over."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from exporters.formats.read_step import read_step
from parts.base.readback import ReadError
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.step_text import StepForm, StepPart, step_text
from tests.exporters.making import run, table

PI = math.pi
Point = dict[str, float]


def point(r: float, z: float, arc: float = 0.0) -> Point:
    return {"r": r, "z": z} | ({"arc": arc} if arc else {})


def cone(r1: float, r2: float, h: float) -> tuple[float, float]:
    """Volume and side of a frustum."""
    return PI * h * (r1 * r1 + r1 * r2 + r2 * r2) / 3, PI * (r1 + r2) * math.hypot(r1 - r2, h)


ROOT = math.sqrt(12)
SHAPES: dict[str, tuple[list[Point], float, float]] = {
    "ball": ([point(0, -4, 4), point(0, 4)], 4 / 3 * PI * 64, 4 * PI * 16),
    "dome": ([point(0, 0), point(4, 0, 4), point(0, 4)], 2 / 3 * PI * 64, 3 * PI * 16),
    "bowl": ([point(0, 1), point(4, 1), point(4, 6), point(0, 6)], PI * 16 * 5, 2 * PI * 16 + 2 * PI * 4 * 5),
    "belt": ([point(0, -2), point(ROOT, -2, 4), point(ROOT, 2), point(0, 2)], PI * 4 * (36 + 36 + 16) / 6,
             2 * PI * 4 * 4 + 2 * PI * 12),
    "tube": ([point(6, -2, 2), point(6, 2, 2)], 2 * PI**2 * 6 * 4, 4 * PI**2 * 6 * 2),
    "cone": ([point(0, 0), point(5, 0), point(0, 7)], cone(5, 0, 7)[0], PI * 25 + cone(5, 0, 7)[1]),
    "spike": ([point(0, 0), point(5, 7), point(0, 7)], cone(5, 0, 7)[0], PI * 25 + cone(5, 0, 7)[1]),
    "frustum": ([point(2, 0), point(5, 0), point(4, 3), point(2, 3)], cone(5, 4, 3)[0] - PI * 4 * 3,
                cone(5, 4, 3)[1] + 2 * PI * 2 * 3 + PI * (25 - 4) + PI * (16 - 4)),
    "lid": ([point(1, 0), point(8, 0), point(2, 0.5), point(1, 0.5)], cone(8, 2, 0.5)[0] - PI * 0.5,
            cone(8, 2, 0.5)[1] + 2 * PI * 0.5 + PI * (64 - 1) + PI * (4 - 1)),
    # a groove of half a ring round a drum: Pappus with the centroid of half a disc, 4 r / 3 pi from its side
    "groove": ([point(0, -3), point(6, -3), point(6, -1, -1), point(6, 1), point(6, 3), point(0, 3)],
               PI * 36 * 6 - 2 * PI * (6 - 4 / (3 * PI)) * PI / 2,
               2 * PI * 36 + 2 * PI * 6 * 4 + 2 * PI * (6 - 2 / PI) * PI),
}  # fmt: skip


@cache
def text_of(name: str) -> str:
    keys = {"kind": "turned", "points": SHAPES[name][0]}
    body: Any = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0)
    return step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm())


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", SHAPES)
def test_volume_and_area_are_those_of_the_formula(name: str, tmp_path: Path) -> None:
    (file := tmp_path / "p.step").write_text(text_of(name), "ascii")
    model = read_step(file).model
    _, volume, area = SHAPES[name]
    assert float(model.flux.sum()) == pytest.approx(volume, rel=1e-9)
    assert float(model.area.sum()) == pytest.approx(area, rel=1e-9)
    assert (model.area > 0).all()
    assert model.gap.max() < 1e-9
    assert model.bounds > 0


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", SHAPES)
def test_no_face_may_be_turned_over(name: str, tmp_path: Path) -> None:
    """Each one has its bounds run round it the other way then; round a pole it is the rest of a ball."""
    text, file = text_of(name), tmp_path / "p.step"
    faces = list(re.finditer(r"=ADVANCED_FACE\([^;]*,\.([TF])\.\);", text))
    assert len(faces) >= 1
    for found in faces:
        other = "F" if found[1] == "T" else "T"
        file.write_text(text[: found.start(1)] + other + text[found.end(1) :], "ascii")
        if "SPHERICAL" in text and name != "belt" and model_of(file) is not None:
            assert model_of(file) == pytest.approx(-SHAPES[name][1], rel=1e-9)
        else:
            with pytest.raises(ReadError, match=r"is a face turned inside out|go round it the same way"):
                read_step(file)


def model_of(file: Path) -> float | None:
    """The volume of a file that is read."""
    try:
        return float(read_step(file).model.flux.sum())
    except ReadError:
        return None


def test_a_solid_without_one_of_its_faces_is_caught(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A chamfer of 0.2 um that a file does not have: too small for its volume, and no other face is off by it."""
    sharp = [point(0, 0), point(10, 0), point(10, 5), point(0, 5)]
    broken = [*sharp[:2], point(10, 5 - 2e-4), point(10 - 2e-4, 5), sharp[3]]
    for name, points in (("sharp", sharp), ("broken", broken)):
        text = table("[parts.p]", {"kind": "turned", "points": points}) + table("[[exports]]", {"format": "step"})
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
        assert run("build", tmp_path / f"{name}.toml", "--out", tmp_path) == 0
    file = tmp_path / "broken" / "p.step"
    file.write_bytes((tmp_path / "sharp" / "p.step").read_bytes())
    capsys.readouterr()
    assert run("verify", file) == 1
    assert "a cone of the part is missing" in capsys.readouterr().out
