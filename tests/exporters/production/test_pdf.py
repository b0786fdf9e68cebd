"""PDF, measured by pdfium: full size on tiles that fit each other, words to search for, the same bytes, damage seen."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.drawings import pdf as writer
from exporters.drawings.sheets import write_sheets
from exporters.production.plan import plan_build
from exporters.production.sheets import SheetJob
from geometry.base.record import replace
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import distance_to_curves
from parts.base.refusal import SceneError
from parts.drawing.canvas import STYLES, Box, Stroke
from parts.drawing.tiles import clipped
from parts.scene.load import scene_from_dict
from tests.exporters.making import write_scene

pdfium = pytest.importorskip("pypdfium2")
pytestmark = pytest.mark.skipif(find_spec("fpdf") is None, reason="fpdf2 is an extra")
raw = pdfium.raw
MM = 25.4 / 72
GEAR = {"kind": "spur_gear", "module": 10.0, "number_of_teeth": 21, "bore_diameter": 50.0}
Paths = list[tuple[str, np.ndarray]]


def scene_of(language: str = "en", **export: Any) -> Any:
    raw_scene = {
        "scene": {"title": "Зубчаста пара", "language": language},
        "parts": {"one": {**GEAR, "number_of_teeth": 13}, "two": GEAR},
        "mates": [{"kind": "external_gear_pair", "first": "one", "second": "two"}],
        "exports": [{"format": "pdf", **export}],
    }
    return scene_from_dict(raw_scene, "t", "t")


def job_of(**export: Any) -> SheetJob:
    (job,) = plan_build(scene_of(**export), "t", [], []).sheets
    assert isinstance(job, SheetJob)
    return job


def paths_of(page: Any) -> Paths:
    """Every piece of every path, with its colour: ends of lines, points of cubics, mm."""
    found: Paths = []
    for item in page.get_objects(filter=[raw.FPDF_PAGEOBJ_PATH]):
        matrix, shades = raw.FS_MATRIX(), [ctypes.c_uint() for _ in range(4)]
        raw.FPDFPageObj_GetMatrix(item, matrix)
        raw.FPDFPageObj_GetStrokeColor(item, *shades)
        colour = "#" + "".join(f"{one.value:02x}" for one in shades[:3])
        poles: list[complex] = []
        for k in range(raw.FPDFPath_CountSegments(item)):
            segment, x, y = raw.FPDFPath_GetPathSegment(item, k), ctypes.c_float(), ctypes.c_float()
            raw.FPDFPathSegment_GetPoint(segment, x, y)
            point = complex(matrix.a * x.value + matrix.c * y.value + matrix.e,
                            matrix.b * x.value + matrix.d * y.value + matrix.f) * MM  # fmt: skip
            kind = raw.FPDFPathSegment_GetType(segment)
            poles = [point] if kind == raw.FPDF_SEGMENT_MOVETO else [*poles, point]
            if kind == raw.FPDF_SEGMENT_LINETO or len(poles) == 4:
                degree, t = len(poles) - 1, np.linspace(0, 1, 33)
                weights = {1: (1 - t, t), 3: ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)}[degree]
                found.append((colour, sum(w * p for w, p in zip(weights, poles, strict=True))))
                poles = [point]
    return found


def test_tiles_fit_each_other_and_make_the_exact_outline(tmp_path: Path) -> None:
    """The wheel of 230 mm on two sheets of A4: their crosses coincide, and all that is on them is its outline."""
    job = job_of(parts=["two"], tolerance=2e-4)
    job.write({}, tmp_path / job.path)
    assert job.verify(tmp_path / job.path, 0.0).failures == ()
    document = pdfium.PdfDocument(tmp_path / job.path)
    pages = [paths_of(page) for page in document]
    assert [round(x * MM) for x in document[0].get_size()] == [210, 297]
    square = np.concatenate([points for _, points in pages[0]][-4:])
    assert np.ptp(square.real) == pytest.approx(100.0, abs=1e-3)
    assert np.ptp(square.imag) == pytest.approx(100.0, abs=1e-3)
    assert len(pages) == 3
    marks = [distinct(np.array([p.mean() for c, p in page if c == STYLES["REGISTER"].colour])) for page in pages[1:]]
    # the axis has one too, in the strip that is on both
    axes, corners = ([m[(np.abs(m.imag - 148.5) < 50) == inner] for m in marks] for inner in (True, False))
    assert [len(m) for m in corners] == [4, 4]
    left, right = corners
    step = left[2] - right[0]
    assert left[3] - right[1] == pytest.approx(step, abs=1e-4)
    assert axes[0] - axes[1] == pytest.approx(step, abs=1e-4)
    cuts = [np.concatenate([p for c, p in page if c == STYLES["CUT"].colour]) for page in pages[1:]]
    drawn = np.concatenate([cuts[0], cuts[1] + step])
    # a strip about the crosses is on both sheets
    near = [points[np.abs(points.real - at.real) < 4.9] for points, at in ((cuts[0], left[2]), (cuts[1], right[0]))]
    assert min(map(len, near)) > 100
    assert np.abs(near[0][:, None] - (near[1] + step)).min(axis=1).max() < 0.3
    # the wheel's axis is the middle of its bore, of 50 mm
    middle = complex(drawn.real.min() + drawn.real.max(), drawn.imag.min() + drawn.imag.max()) / 2
    bore = drawn[np.abs(drawn - middle) < 30]
    rows = np.column_stack([2 * bore.real, 2 * bore.imag, np.ones(len(bore))])
    x, y, _ = np.linalg.lstsq(rows, np.abs(bore) ** 2, rcond=None)[0]
    assert axes[0] == pytest.approx(complex(x, y), abs=1e-3)
    drawn = drawn - complex(x, y)
    part = plan_build(scene_of(), "t", [], []).parts["two"]
    exact = [
        curve.placed(place) for profile in part.section(0.0).region.profiles() for curve, place in all_curves(profile)
    ]
    points = np.concatenate([curve.point(np.linspace(*curve.domain, 60)) for curve in exact])
    worst = distance_to_curves(drawn[::5], exact).max()
    assert worst < 1e-3
    assert max(np.abs(drawn - p).min() for p in points[::7]) < 0.5


def distinct(points: np.ndarray) -> np.ndarray:
    """Points of crosses, both lines of which have one middle, from left to right and upwards."""
    ordered = sorted(points, key=lambda z: (round(z.real, 2), round(z.imag, 2)))
    return np.array(ordered).reshape(-1, 2).mean(axis=1)


def all_curves(profile: Any) -> Any:
    from geometry.base.placement import Placement2

    turn = (-2 if profile.clockwise else 2) * np.pi / profile.count
    return [(s.curve, Placement2(k * turn)) for k in range(profile.count) for s in profile.period]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("purpose", ["meshing", "model"])
def test_words_are_found_in_cyrillic_and_the_bytes_are_the_same(tmp_path: Path, purpose: str) -> None:
    job = job_of(language="uk", purpose=purpose)
    files = [tmp_path / f"{k}.pdf" for k in range(2)]
    for file in files:
        job.write({}, file)
        assert job.verify(file, 0.0).failures == ()
    assert files[0].read_bytes() == files[1].read_bytes()
    document = pdfium.PdfDocument(files[0])
    said = " ".join(page.get_textpage().get_text_range() for page in document)
    for word in {
        "meshing": ("Картина зовнішнього", "коефіцієнт зміщення", "αw"),
        "model": ("Зубчаста пара", "квадрата"),
    }[purpose]:
        assert word in said
    assert b"/FontFile2" in files[0].read_bytes()


def test_what_is_off_or_missing_in_a_pdf_is_seen(tmp_path: Path) -> None:
    job = job_of(purpose="meshing", tolerance=2e-4)
    canvas, file = job.canvas, tmp_path / "spoilt.pdf"
    write_sheets(file, [canvas], "t")
    assert job.verify(file, 0.0).failures == ()
    base = next(k for k, s in enumerate(canvas.strokes) if s.layer == "CIRCLE_BASE")
    for number, moved, wanted in (
        (base, replace(canvas.strokes[base].curve, radius=canvas.strokes[base].curve.radius + 1e-3), "no circle of"),
        (-1, None, "paths on a page"),
    ):
        strokes = list(canvas.strokes)
        if moved is not None:
            strokes[number] = Stroke(strokes[number].layer, moved)
        else:
            strokes = [s for s in strokes if s.layer != "ACTIVE_FLANK"]
        spoilt = type(canvas)(canvas.width, canvas.height, canvas.paper, strokes, canvas.texts)
        write_sheets(file, [spoilt], "t")
        assert any(wanted in text for text in job.verify(file, 0.0).failures)
    less = type(canvas)(canvas.width, canvas.height, canvas.paper, canvas.strokes, canvas.texts[1:])
    write_sheets(file, [less], "t")
    assert any("words are missing" in text for text in job.verify(file, 0.0).failures)
    file.write_bytes(file.read_bytes()[:-400])
    assert job.verify(file, 0.0).failures


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("good", "bad", "wanted"),
    [
        (b"/MediaBox [0 0 ", b"/MediaBox [9 0 ", "from 3.175, 0 mm on"),
        (b"/MediaBox [0 0 5", b"/MediaBox [0 0 4", "has paper of"),
        (b"/Type /Page\n", b"/Type /Page /Rotate 90\n", "with Rotate"),
        (b"/Type /Page\n", b"/Type /Page /CropBox [50 50 300 300]\n", "with CropBox"),
        (b"/Type /Pages\n", b"/Type /Pages /UserUnit 2\n", "with UserUnit"),
        (b"/Type /ExtGState", b"/Type /ExtGState /CA 0", "with CA"),
    ],
)
def test_a_page_that_is_cut_turned_or_scaled_is_seen(tmp_path: Path, good: bytes, bad: bytes, wanted: str) -> None:
    job = job_of(parts=["one"])
    file = tmp_path / job.path
    job.write({}, file)
    whole = file.read_bytes()
    assert good in whole
    file.write_bytes(whole.replace(good, bad))
    assert [failure for failure in job.verify(file, 0.0).failures if wanted in failure]


@pytest.mark.parametrize(
    ("export", "key"),
    [
        ({"scale": "1:1"}, "scale"),
        ({"title_block": True}, "title_block"),
        ({"kerf": 0.1}, "kerf"),
        ({"tolerance": 1e-5}, "tolerance"),
        (
            {"purpose": "meshing", "paper": "A4", "scale": "2:1"},
            'paper = "A4": the paper is too small at the scale 2:1',
        ),
        ({"purpose": "meshing", "scale": "100:1"}, "scale"),
        ({"paper": "A5"}, "paper"),
    ],
)
def test_refusals_name_the_key(export: dict[str, Any], key: str) -> None:
    with pytest.raises(SceneError) as caught:
        plan_build(scene_of(**export), "t", [], [])
    assert f"exports[1].{key}" in str(caught.value)


def test_what_is_not_installed_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(writer, "find_spec", lambda name: None)
    with pytest.raises(SceneError, match=r"\.\[pdf\]"):
        plan_build(scene_of(), "t", [], [])


def test_a_scene_without_pdf_imports_nothing_of_it(tmp_path: Path) -> None:
    export = {"format": "sheet", "purpose": "generating", "tolerance": 0.01}
    scene = write_scene(tmp_path / "s.toml", {"one": GEAR}, [export])
    code = (
        "import sys; from exporters.command.cli import main; "
        f"assert main(['build', {str(scene)!r}, '--no-verify', '--out', {str(tmp_path)!r}]) == 0; "
        "assert 'ezdxf' in sys.modules and not {'fpdf', 'PIL'} & set(sys.modules), 'loaded'"
    )
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


def test_an_edge_is_cut_at_the_sides_of_a_tile() -> None:
    box = Box(-1.0, -1.0, 1.0, 1.0)
    assert clipped(Line(-2 + 0j, 2 + 0j), box) == [Line(-1 + 0j, 1 + 0j)]
    assert clipped(Line(-2 + 2j, 2 + 2j), box) == []
    circle = Arc(0j, 1.2, 0.3, 2 * np.pi)
    pieces = clipped(circle, box)
    # four pieces in the corners, one of them cut where the circle begins or not
    length = sum(abs(p.sweep) for p in pieces if isinstance(p, Arc))
    assert length == pytest.approx(2 * np.pi - 8 * np.arccos(1 / 1.2), abs=1e-12)


def test_straight_walls_of_a_development_are_drawn_straight(tmp_path: Path) -> None:
    """Their arcs have bulges of 1e-17: by its centre such an arc ran 64 mm beside them."""
    moves = [("rise", 30.0, "join", 0.25), ("rise", 60.0, "constant_velocity", 0.5), ("rise", 30.0, "join", 0.25)]
    phases: list[dict[str, Any]] = [dict(zip(("move", "angle_deg", "law", "share"), m, strict=True)) for m in moves]
    phases += [{"move": "dwell", "angle_deg": 60.0}, {"move": "return_", "angle_deg": 180.0, "law": "polynomial_345"}]
    sizes = {"outer_diameter": 60.0, "roller_diameter": 10.0, "groove_depth": 8.0, "lift": 20.0}
    cam = {"kind": "barrel_cam", "form": "groove", **sizes, "phases": phases}
    scene = {"parts": {"cam": cam}, "exports": [{"format": "pdf", "purpose": "model"}]}
    (job,) = plan_build(scene_from_dict(scene, "t", "t"), "t", [], []).sheets
    file = tmp_path / "cam.pdf"
    job.write({}, file)
    verdict = job.verify(file, job.declared({})[0])
    assert not verdict.failures
    # by pdfium: nothing is bent far away
    document = pdfium.PdfDocument(file)
    try:
        reach = max(abs(p - 148) for page in document for _, points in paths_of(page) for p in points)
    finally:
        document.close()
    assert reach < 300
