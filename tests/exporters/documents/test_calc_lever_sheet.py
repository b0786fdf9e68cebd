"""The sheets of ``calc lever``: everything on them is measured off the DXF, by the scale that is told beside it."""

from __future__ import annotations

import json
import math
import re
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import ezdxf
import pytest

from exporters.command.cli import main
from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
from tests.exporters.documents.test_calc_lever import value
from tests.sampling import some_of

Lines = dict[str, list[tuple[complex, complex]]]
LOADS = ("masses.1=5", "centres.1=20", "masses.2=8", "masses.3=20", "masses.4=10", "masses.5=40", "resistance=2000")


class Read:
    """A DXF as any reader has it: straight lines by layer, words in one string, paper."""

    def __init__(self, file: Path) -> None:
        space = ezdxf.readfile(file).modelspace()
        self.lines: Lines = {}
        for line in space.query("LINE"):
            ends = (complex(*line.dxf.start.xyz[:2]), complex(*line.dxf.end.xyz[:2]))
            self.lines.setdefault(line.dxf.layer, []).append(ends)
        self.words = [(t.dxf.text, complex(*t.dxf.insert.xyz[:2])) for t in space.query("TEXT")]

    def sizes(self, *layers: str) -> list[float]:
        return [abs(end - start) for layer in layers for start, end in self.lines.get(layer, [])]

    def scale(self, index: str) -> float:
        """The first scale with this index: its pieces stand in one line, behind each other."""
        marks = (at for text, at in self.words if text == index and self._before(at).endswith("μ"))
        # formulas have it too
        told = next(found for mark in marks if (found := re.findall(r"= ([\d.,e+-]+) ", self._after(mark))))
        return float(told[0].replace(",", "."))

    def _before(self, at: complex) -> str:
        row = [(p.real, t) for t, p in self.words if abs(p.imag - at.imag) < 1.5 and 0 < at.real - p.real < 120]
        return max(row)[1] if row else ""

    def _after(self, at: complex) -> str:
        row = [(p.real, t) for t, p in self.words if abs(p.imag - at.imag) < 1.5 and p.real > at.real]
        return min(row)[1] if row else ""


def has(sizes: list[float], size: float, within: float = 1e-5) -> bool:
    return any(abs(one - size) <= within for one in sizes)


@cache
def data(*keys: str) -> dict[str, Any]:
    return json.loads(calculate("lever", keys, "json", "en"))


def drawn(folder: Path, *keys: str, language: str = "en", name: str = "lever.dxf") -> Read:
    calculate("lever", [*keys, f"sheet={(folder / name).as_posix()}"], "text", language)
    return Read(folder / name)


def test_the_worked_example_stands_on_paper_as_the_guidelines_draw_it(tmp_path: Path) -> None:
    """3.4: AO1 30, O3B 108, CO3 27, CD 75.6 mm; pa 120, πa 160 mm, and all others by the told scales."""
    read = drawn(tmp_path, "code=1071")
    assert (read.scale("l"), read.scale("v"), read.scale("a")) == (0.01, 0.1, 3)
    assert sorted(read.sizes("SCHEME")) == pytest.approx([27, 30, 75.6, 108], abs=1e-6)
    page = data("code=1071")
    speeds, changes = read.sizes("VELOCITY"), read.sizes("ACCELERATION")
    assert has(speeds, 120)
    assert has(changes, 160)
    for symbol in ("V_A", "V_A3", "V_B", "V_C", "V_D"):
        assert has(speeds, value(page, symbol) / 0.1), symbol
    for symbol in ("a_B", "a_C", "a_3n"):
        assert has(changes, value(page, symbol) / 3, 1e-4), symbol
    thin = read.sizes("RELATIVE")
    for symbol, scale in (("V_A3A2", 0.1), ("V_DC", 0.1), ("a_A3A2_k", 3), ("a_3t", 3), ("a_4t", 3)):
        assert has(thin, value(page, symbol) / scale, 1e-4), symbol
    assert not has(speeds, value(page, "V_B") / 0.2)


def test_the_crank_stands_in_all_positions_of_a_turn(tmp_path: Path) -> None:
    read = drawn(tmp_path, "assignment=4", "variant=2", "second_position=5")
    crank = 200 / (1000 * read.scale("l"))
    layers = ("SCHEME", "OUTLINE", "POSITION")
    cranks = {layer: [(a, b) for a, b in read.lines[layer] if abs(abs(b - a) - crank) < 1e-5] for layer in layers}
    assert {layer: len(found) for layer, found in cranks.items()} == {"SCHEME": 1, "OUTLINE": 1, "POSITION": 10}
    every = [pair for found in cranks.values() for pair in found]
    assert len({(round(a.real, 4), round(a.imag, 4)) for a, _ in every}) == 1
    angles = sorted(round(math.degrees(math.atan2((b - a).imag, (b - a).real)) % 360, 4) for a, b in every)
    assert angles == pytest.approx([(50 + 30 * k) % 360 for k in (11, *range(11))], abs=1e-3)
    ((start, end),) = cranks["OUTLINE"]
    assert math.degrees(math.atan2((end - start).imag, (end - start).real)) == pytest.approx(200 - 360, abs=1e-3)
    # both positions have their plans: V_A twice, by scales of their own
    assert sum(text == "Plan of velocities, position 5" or "position 5" in text for text, _ in read.words) == 2


@cache
def loaded() -> tuple[Read, dict[str, Any]]:
    """The sheet of loaded links and its page."""
    keys = ("assignment=4", "variant=2", "force_scale=25", *LOADS)
    with TemporaryDirectory() as folder:
        return drawn(Path(folder), *keys), data(*keys)


def test_zhukovskys_lever_on_paper_gives_the_balancing_moment() -> None:
    """Moments of forces about the pole, with dividers: their sum is -M_b ω_1."""
    read, page = loaded()
    tips = [(pole, tip) for pole, tip in read.lines["VELOCITY"]]
    total, count = 0.0, 0
    title = next(at for text, at in read.words if text == "Zhukovsky's lever")
    scale = min(
        (abs(at - title), float(found[0])) for text, at in read.words if (found := re.findall(r"= ([\d.]+) N/mm", text))
    )[1]
    for start, end in read.lines["FORCE"]:
        pole = next((p for p, tip in tips if abs(tip - start) < 1e-5), None)
        if pole is not None and abs(end - start) > 0.01:
            total += ((start - pole).conjugate() * (end - start)).imag * scale * read.scale("v")
            count += 1
    assert count >= 7
    assert -total / value(page, "ω_1") == pytest.approx(value(page, "M_b"), rel=1e-4)


def test_plans_of_forces_close_on_paper() -> None:
    read, page = loaded()
    assert read.scale("F") == 25
    # the last one is what link 4 passes on to link 5, across the polygon
    *sizes, across = [row["value"] / 25 for row in page["force_plan_45"]]
    lines = read.lines["FORCE"]
    assert has([abs(b - a) for a, b in lines], across)
    start, at = next(pair for pair in lines if abs(abs(pair[1] - pair[0]) - sizes[0]) < 1e-5)
    for size in sizes[1:]:
        at = next(b for a, b in lines if abs(a - at) < 1e-5 and abs(abs(b - a) - size) < 1e-5)
    assert abs(at - start) < 1e-5


def test_works_and_energies_stand_on_a_sheet_of_their_own(tmp_path: Path) -> None:
    keys = ("code=1071", "resistance=1000", "unevenness=0.02", "point_masses.D=20")
    drawn(tmp_path, *keys)
    read = Read(tmp_path / "lever.2.dxf")
    wheel = value(data(*keys), "ΔT_m")
    (segment,) = [abs(b - a) for a, b in read.lines["DIMENSION"] if abs((b - a).real) < 1e-9 and abs(b - a) > 4]
    assert segment * read.scale("ΔT") == pytest.approx(wheel, rel=1e-4)
    assert {text for text, _ in read.words} >= {"KK"}


def test_it_is_written_as_svg_and_pdf_in_the_language(tmp_path: Path) -> None:
    for name in ("lever.svg", "lever.pdf"):
        keys = ["code=1071", "title_block.designation=КР.15.0107.К6", f"sheet={(tmp_path / name).as_posix()}"]
        calculate("lever", keys, "text", "uk")
    text = (tmp_path / "lever.svg").read_text(encoding="utf-8")
    for told in ("Схема", "= 0,01 м/мм", "План швидкостей", "КР.15.0107.К6", 'width="594mm" height="420mm"'):
        assert told in text
    assert (tmp_path / "lever.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.sampled(1)
@pytest.mark.parametrize("assignment", range(1, 11))
def test_every_assignment_has_its_sheet(assignment: int, tmp_path: Path) -> None:
    """Each is read back before it is left there: no word stands over another, all within the frame."""
    loads = LOADS if assignment < 8 else ("masses.2=8", "masses.3=20", "resistance=2000")
    if assignment == 10:
        loads = (*LOADS[:-1], "resisting_moment=100")
    read = drawn(tmp_path, f"assignment={assignment}", f"variant={assignment % 5 + 3}", *loads)
    assert len(read.lines["SCHEME"]) >= 2
    assert {"VELOCITY", "ACCELERATION", "FORCE", "POSITION"} <= {*read.lines}
    # round scales, the scheme by them
    assert f"{read.scale('l'):e}"[:3] in {"1.0", "2.0", "2.5", "4.0", "5.0"}


def test_drawings_that_one_sheet_holds_in_another_order_stand_on_one(tmp_path: Path) -> None:
    """In the order of the guidelines Zhukovsky's lever stood on a sheet of its own, with half of the first one free."""
    read = drawn(tmp_path, "assignment=1", "variant=3", *LOADS)
    assert [file.name for file in tmp_path.iterdir()] == ["lever.dxf"]
    texts = {text for text, _ in read.words}
    assert {"Output over a turn", "Zhukovsky's lever", "Plan of velocities", "Plan of accelerations"} <= texts


def refused(*keys: str) -> SceneError:
    with pytest.raises(SceneError) as caught:
        calculate("lever", keys, "text", "en")
    return caught.value


@pytest.mark.parametrize(("keys", "width"), [((), 594), (("drawn_crank=100",), 841), (("paper=A1",), 841)])
def test_the_paper_is_the_smallest_that_holds_all_on_one_sheet(
    tmp_path: Path, keys: tuple[str, ...], width: int
) -> None:
    """Those of the worked example took a quarter of an A1."""
    calculate("lever", ["code=1071", *keys, f"sheet={(tmp_path / 'lever.svg').as_posix()}"], "text", "en")
    assert f'width="{width}mm"' in (tmp_path / "lever.svg").read_text(encoding="utf-8")


def test_what_fits_no_sheet_is_refused_by_its_key_with_what_works(tmp_path: Path) -> None:
    sheet = f"sheet={(tmp_path / 'lever.dxf').as_posix()}"
    for key, bad in some_of((("drawn_crank", "900"), ("velocity_scale", "0.005"), ("paper", "A4"))):
        told = refused("code=1071", f"{key}={bad}", sheet)
        assert told.key == f"lever.{key}"
        assert told.nearest is not None
        assert not (tmp_path / "lever.dxf").exists()
        calculate("lever", ["code=1071", f"{key}={told.nearest.value}", sheet], "text", "en")
        (tmp_path / "lever.dxf").unlink()


@pytest.mark.parametrize(
    ("keys", "key", "code"),
    [
        (("sheet=lever.txt",), "lever.sheet", "file_ends_in"),
        (("sheet=nowhere/lever.dxf",), "lever.sheet", "no_such_folder"),
        (("paper=A2",), "lever.paper", "needs_other"),
        (("second_position=12", "sheet=lever.dxf"), "lever.second_position", "no_such_position"),
    ],
)
def test_keys_of_the_sheet_are_refused_by_name(keys: tuple[str, ...], key: str, code: str) -> None:
    told = refused("code=1071", *keys)
    assert (told.key, told.code) == (key, code)


def test_words_that_the_title_block_does_not_hold_are_refused(tmp_path: Path) -> None:
    told = refused("code=1071", f"title_block.drawn={'K' * 110}", f"sheet={(tmp_path / 'a.dxf').as_posix()}")
    assert (told.key, told.code) == ("lever.title_block.drawn", "cell_holds_letters")


def test_a_sheet_that_is_not_what_it_should_be_is_not_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Negative control: a writer that loses a line is caught. What stands there already is never replaced."""
    from exporters.drawings import sheets

    def lose(file: Path, canvas: Any) -> dict[str, int]:
        from exporters.drawings.write import write_sheet_dxf

        kept = canvas.strokes.pop()
        try:
            return write_sheet_dxf(file, canvas)
        finally:
            canvas.strokes.append(kept)

    monkeypatch.setattr(sheets, "write_sheet_dxf", lose)
    file = tmp_path / "lever.dxf"
    assert main(["calc", "lever", "code=1071", f"sheet={file.as_posix()}"]) == 1
    told = capsys.readouterr().err
    assert "no line from" in told
    assert file.as_posix() in told
    assert [*tmp_path.iterdir()] == []
    monkeypatch.undo()
    file.write_text("mine", "utf-8")
    for key in ("sheet", "picture"):
        asked = file if key == "sheet" else file.rename(tmp_path / "lever.svg")
        assert main(["calc", "lever", "code=1071", f"{key}={asked.as_posix()}"]) == 2
        told = capsys.readouterr().err
        assert f"{asked.as_posix()}: exists already" in told
    assert [one.read_text("utf-8") for one in tmp_path.iterdir()] == ["mine"]
    for key in ("picture", "sheet"):
        assert main(["calc", "lever", "code=1071", "--force", f"{key}={asked.as_posix()}"]) == 0
        assert "<svg" in asked.read_text("utf-8")
