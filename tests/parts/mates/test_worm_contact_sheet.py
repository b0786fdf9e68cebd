"""The sheet of a worm in its wheel on paper: teeth and thread by hand, turned images of one flank, words, damage."""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.documents.topics import calculate
from exporters.production.plan import plan_build
from geometry.curves.line_arc import Line
from parts.drawing.labels import nearest
from parts.drawing.readback import ReadSheet, Taken
from parts.mates.sheets.worm_contact import WormMeasures
from parts.scene.load import scene_from_toml
from tests.exporters.making import run
from tests.exporters.production.test_worm_sheet import PAIR

# m 5, q 10, one start on 128 teeth: thread from 19 to 30, wheel from 345 away, its face 26 wide, 660 over its tips
AWAY, HALF, ROOT, TIP = 345.0, 13.0, 19.0, 30.0
# a wheel's tooth stands between the worm's tip and root, each a clearance of 1 further
DEEP, HIGH = (AWAY - math.sqrt(r * r - HALF * HALF) for r in (31.0, 20.0))
BOTTOM = AWAY - 31.0


@cache
def job() -> Any:
    text = PAIR.format(language="en", length=120.0, hob="")
    return plan_build(scene_from_toml(text.encode(), "t", "t"), "t", [], []).sheets[0]


def lines(layer: str) -> list[tuple[complex, complex]]:
    strokes = (s.curve for s in job().canvas.strokes if s.layer == layer)
    return [(c.start, c.end) for c in strokes if isinstance(c, Line)]


def curves(*layers: str) -> list[tuple[str, np.ndarray]]:
    """Splines in the order in which they are drawn."""
    strokes = [s for s in job().canvas.strokes if s.layer in layers and not isinstance(s.curve, Line)]
    return [(s.layer, s.curve.point(np.linspace(*s.curve.domain, 33))) for s in strokes]


def test_the_worm_lies_over_both_flanks_of_a_tooth() -> None:
    canvas, paper = job().canvas, job().expected.paper
    scale, origin = paper.scale, paper.origin
    sides, worm = lines("OUTLINE")[:4], lines("OUTLINE")[4:]
    # 120 long, a corner where its end faces meet the root cylinder
    chain = [(start - origin) / scale for start, _ in worm]
    wanted = [60 + 19j, 60 + 30j, -60 + 30j, -60 + 19j, -60 - 19j, -60 - 30j, 60 - 30j, 60 - 19j]
    assert chain == pytest.approx(wanted, abs=1e-9)
    assert [end for _, end in worm] == [*(start for start, _ in worm[1:]), worm[0][0]]
    roots = [((a - origin) / scale, (b - origin) / scale) for a, b in lines("CIRCLE_ROOT")]
    assert np.array(roots) == pytest.approx(np.array([(-60 + 19j, 60 + 19j), (-60 - 19j, 60 - 19j)]), abs=1e-9)
    (axis,) = lines("CENTRE")
    assert axis == pytest.approx((origin - 60 * scale - 4, origin + 60 * scale + 4), abs=1e-9)
    # the teeth stand symmetrically below it, their sides from root to tip
    feet, _tops = [a for a, _ in sides], [b for _, b in sides]
    middles = [(feet[0] + feet[1]) / 2, (feet[2] + feet[3]) / 2]
    assert (middles[0] + middles[1]).real / 2 == pytest.approx(origin.real, abs=1e-9)
    assert [abs(feet[k + 1] - feet[k]) for k in (0, 2)] == pytest.approx([2 * HALF * scale] * 2, rel=1e-9)
    assert feet[0].real < feet[1].real < feet[3].real < feet[2].real
    assert [b - a for a, b in sides] == pytest.approx([1j * scale * (HIGH - DEEP)] * 4, rel=1e-9)
    base = feet[0].imag - scale * (DEEP - BOTTOM)
    # room is left over evenly: below the teeth, between, and over the worm
    gap = origin.imag - TIP * scale - (base + scale * (HIGH - BOTTOM))
    room = canvas.content.high - 14.0 - 8.0
    assert room - (origin.imag + TIP * scale) == pytest.approx(gap, abs=1e-9)
    # the tooth's root and tip between its sides, over the heights
    for k, (_, points) in enumerate(curves("OUTLINE")):
        heights = (points.real - middles[k // 2].real) / scale
        radii = BOTTOM + (points.imag - base) / scale
        limit = 31.0 if k % 2 == 0 else 20.0
        assert radii == pytest.approx(np.minimum(AWAY - np.sqrt(limit**2 - heights**2), 330.0), abs=2e-3)


def test_the_other_flank_is_the_first_after_half_a_turn_about_the_line_of_centres() -> None:
    """On the wheel heights change sign; along the worm both do."""
    origin = job().expected.paper.origin
    found = curves("ACTIVE_LINE", "CONSTRUCTION")
    assert len(found) % 4 == 0
    half = len(found) // 2
    sides = lines("OUTLINE")[:4]
    middles = [(sides[0][0] + sides[1][0]).real / 2, (sides[2][0] + sides[3][0]).real / 2]
    for (layer, one), (other_layer, other) in zip(found[:half], found[half:], strict=True):
        assert layer == other_layer
        if one.imag.max() < origin.imag - 35 * job().expected.paper.scale:
            assert other - middles[1] == pytest.approx(-(one - middles[0]).conjugate(), abs=1e-9)
        else:
            assert other - origin == pytest.approx(-(one - origin), abs=1e-9)
    for one_layer, other_layer in (("TOOTH_START", "TOOTH_END"),):
        ends = [((a - origin), (b - origin)) for a, b in lines(one_layer)[:2]]
        turned = [((origin - a), (origin - b)) for a, b in lines(other_layer)[:2]]
        assert np.array(ends) == pytest.approx(np.array(turned), abs=1e-9)
        # at the ends of the face
        assert sorted(p.imag for p, _ in ends) == pytest.approx([-HALF * 2, HALF * 2], abs=1e-9)
        assert all(a.imag == pytest.approx(b.imag, abs=1e-9) for a, b in ends)
    # of six places in a pitch the first is drawn strong: those stand a pitch apart along the worm
    strong = len([1 for layer, _ in found if layer == "ACTIVE_LINE"])
    assert strong * 6 == pytest.approx(len(found), abs=6 * 4)


def test_what_the_worm_is_used_over_is_told_between_its_ends() -> None:
    canvas, paper = job().canvas, job().expected.paper
    first, second, across = lines("DIMENSION")[:3]
    used = (second[0] - first[0]).real / paper.scale
    farthest = max(np.abs((p - paper.origin).real).max() for layer, p in curves("TOOTH_START", "TOOTH_END")
                   if np.abs(p.imag - paper.origin.imag).max() < (HALF + 0.1) * paper.scale)  # fmt: skip
    assert used == pytest.approx(2 * farthest / paper.scale, abs=0.02)
    assert (first[0] + second[0]) / 2 == pytest.approx(paper.origin, abs=1e-9)
    for line in (first, second):
        assert line[0].real == line[1].real
        assert line[1].imag > across[0].imag > paper.origin.imag + TIP * paper.scale
    assert [p.real for p in across] == pytest.approx([first[0].real, second[0].real], abs=1e-9)
    texts = {t.text: t.box for t in canvas.texts}
    told = f"b1u = {used:.2f}"
    middle = (across[0] + across[1]) / 2
    assert abs(nearest(texts[told], middle) - middle) <= 3
    sides = lines("OUTLINE")[:4]
    for name, k in (("1", 0), ("2", 2)):
        over = complex((sides[k][0] + sides[k + 1][0]).real / 2, sides[k][1].imag)
        box = next(t.box for t in canvas.texts if t.text == name and t.box.high > sides[0][0].imag)
        assert abs(nearest(box, over) - over) <= 3
        assert box.low > over.imag
    # the table, by hand
    words = [t.text for t in canvas.texts]
    for name, symbol, value in (("module", "m", "5"), ("diameter quotient of the worm", "q", "10"),
                                ("centre distance", "aw", "345.000"), ("width of the wheel's rim", "b2", "26"),
                                ("threaded length of the worm", "b1", "120"), ("number of teeth", "z2", "128"),
                                ("number of starts of the worm", "z1", "1")):  # fmt: skip
        at = words.index(name)
        assert words[at + 1 : at + 3] == [symbol, value]
    at = words.index("contact ratio")
    # lines of one moment on both flanks, in the wheel's view and the worm's: 4 for each that touches
    strong = len([1 for layer, _ in curves("ACTIVE_LINE")]) / 4
    assert abs(float(words[at + 2]) - strong) < 1
    assert words[words.index("length of the worm that the wheel touches") + 2] == f"{used:.2f}"


def test_damage_is_told() -> None:
    """Lines as they are drawn lie within the tolerance; moved by half a millimetre, or left out, they are told."""
    made = job()
    sheet, wanted = ReadSheet(), []
    for layer in ("ACTIVE_LINE", "CONSTRUCTION", "TOOTH_START", "TOOTH_END", "OUTLINE"):
        wanted.append(next(curve for curve in made.expected.measures.curves if curve.layer == layer))
        sheet.samples.append((layer, curves(layer)[0][1]))
    measures = WormMeasures(tuple(wanted))

    def told() -> tuple[float, list[str]]:
        taken = Taken(1e-3)
        measures.check(sheet, taken)
        return taken.measured["contact_line_deviation"], taken.failures

    off, failures = told()
    assert off < 1e-3
    assert failures == []
    for k, layer in enumerate(curve.layer for curve in wanted):
        kept = sheet.samples[k]
        # across its heights: those of the wheel's views run to the right
        for by in (0.5j, 0.5):
            sheet.samples[k] = layer, kept[1] + by
            off, failures = told()
            assert 0.1 < off < 2.5
            assert len(failures) == 1
        del sheet.samples[k]
        off, failures = told()
        assert off < 1e-3
        assert failures == [f"{layer}: 0 lines instead of 1"]
        sheet.samples.insert(k, kept)


def test_flanks_too_low_to_touch_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An addendum of 0.001 m beside a shift of 0.14 m: in the mid plane, where a rack meets an involute, the thread
    ends 0.139 m on the wheel's side, and the line of action is there beyond the wheel's tip. A traceback before.
    """
    module, teeth, shift, addendum = 3.0, 30, 0.14, 0.001
    off = (shift - addendum) * module
    met = math.hypot(module * teeth / 2 + off, off / math.tan(math.radians(20.2)))
    assert met > module * teeth / 2 + (addendum + shift) * module
    keys = f"module = {module}\ndiameter_quotient = 14\nnumber_of_starts = 2\naddendum_coefficient = {addendum}\n"
    wheel = f'[parts.g]\nkind = "worm_wheel"\nnumber_of_teeth = {teeth}\nprofile_shift_coefficient = {shift}\n{keys}'
    worm = f'[parts.w]\nkind = "worm"\nthread_length = 40\n{keys}'
    file = tmp_path / "w.toml"
    file.write_text(f'{wheel}{worm}[[mates]]\nkind = "worm_pair"\nfirst = "g"\nsecond = "w"\n', encoding="utf-8")
    assert run("build", file, "--out", tmp_path, "--format", "sheet") == 2
    assert "touch nowhere" in capsys.readouterr().err
    typed = [f"{key}={value}" for key, value in (("number_of_teeth", teeth), ("profile_shift_coefficient", shift))]
    page = calculate("worm", [*typed, *keys.replace(" ", "").split()], "json", "en")
    assert json.loads(page)["values"]["worm_ratio"] == 15


def test_a_field_that_ends_within_the_face_has_no_side_at_the_end_of_it() -> None:
    """A course work's drive, a_w 100, u 20, q 8: its shift of 1 m leaves no flank from 13.5 mm beside the mid plane on,
    and the line across a field that is not there ran out of the sheet, which was refused.
    """
    keys = "module = 4.0\nnumber_of_starts = 2\ndiameter_quotient = 8.0\n"
    text = (
        f'[parts.g]\nkind = "worm_wheel"\nnumber_of_teeth = 40\nworking_centre_distance = 100.0\n'
        f'face_width = 30.0\n{keys}'
        f'[parts.w]\nkind = "worm"\nthread_length = 80.0\n{keys}[[mates]]\nkind = "worm_pair"\nfirst = "g"\n'
        'second = "w"\n[[exports]]\nformat = "sheet"\npurpose = "meshing"\ntolerance = 1e-3\n'
    )  # fmt: skip
    canvas = plan_build(scene_from_toml(text.encode(), "w", "w"), "w", [], []).sheets[0].canvas
    straight = [s.layer for s in canvas.strokes if isinstance(s.curve, Line)]
    # the side at the other end of the face, and the legend's sample
    assert [straight.count(layer) for layer in ("TOOTH_START", "TOOTH_END")] == [2, 2]
    fields = [s.curve for s in canvas.strokes if s.layer in ("TOOTH_START", "TOOTH_END")]
    assert all(canvas.content.holds(curve.point(np.array(curve.domain))) == 2 for curve in fields)
