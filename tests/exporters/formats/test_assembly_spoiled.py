"""Spoiled assembly files are caught: places, instances, names, colours; and single parts of the wrong name."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from exporters.production.recheck import recheck
from exporters.verification.assembly import ExpectedAssembly, verify_assembly
from geometry.base.record import replace
from parts.base.part import Part
from parts.base.readback import Probe, Probed, ReadBack
from parts.scene.formats import file_kind
from parts.scene.load import make_parts, scene_from_toml
from parts.scene.placing import place
from parts.scene.standing import Instance
from tests.exporters.making import read_report, run
from tests.exporters.spoil import in_model
from tests.exporters.train import TRAIN


def in_text(change: Callable[[str], str]) -> Callable[[Path], None]:
    """A spoiler of a STEP file."""

    def spoil(file: Path) -> None:
        text = file.read_text(encoding="ascii")
        assert change(text) != text
        file.write_text(change(text), encoding="ascii", newline="\n")

    return spoil


SPOIL_3MF = {
    "place": (in_model(lambda t: t.replace(" 0.0 60.0 1.0", " 0.0 60.000001 1.0")), "free stands"),
    "turn": (in_model(lambda t: t.replace('transform="0.8386705679454', 'transform="0.8386715679454')), "free stands"),
    "missing": (in_model(lambda t: re.sub(r'<item [^>]*partnumber="left"[^>]*>', "", t)), "left is missing"),
    "twice": (in_model(lambda t: re.sub(r'(<item [^>]*partnumber="left"[^>]*>)', r"\1\1", t)), "left is there 2"),
    "stranger": (in_model(lambda t: t.replace('partnumber="left"', 'partnumber="lift"')), '"lift" does not belong'),
    "other part": (in_model(lambda t: re.sub(r'objectid="\d+" partnumber="sun"', 'objectid="3" partnumber="sun"', t)),
                   "sun is planet"),
    "name": (in_model(lambda t: t.replace('name="planet" type', 'name="plant" type')), '"plant" does not belong'),
    "title": (in_model(lambda t: t.replace(">train<", ">tram<")), '"tram"'),
    "colour": (in_model(lambda t: t.replace("#C08040FF", "#C08240FF")), "coloured"),
    "no colour": (in_model(lambda t: re.sub(r' pid="\d+" pindex="\d+"', "", t)), "coloured"),
    "unit": (in_model(lambda t: t.replace('"millimeter"', '"inch"')), "not in mm"),
    "vertex": (in_model(lambda t: re.sub(r'<vertex x="(\d+)\.', r'<vertex x="\g<1>1.', t, count=1)), ""),
    "cut short": (lambda file: file.write_bytes(file.read_bytes()[:-200]), "not a readable 3MF"),
}  # fmt: skip
SWAPPED = {"left": "'right'", "right": "'left'"}
# where a component stands, and what says that it does
PLACED = r"#\d+=\(REPRESENTATION_RELATIONSHIP[^;]*;\s*(#\d+=PRODUCT_DEFINITION_SHAPE[^;]*;\s*)#\d+=CONTEXT_DEPEND[^;]*;"
SPOIL_STEP = {
    "place": (in_text(lambda t: t.replace("(0.,60.,1.)", "(0.,60.000001,1.)")), "free stands"),
    "missing": (in_text(lambda t: re.sub(PLACED, r"\g<1>", t, count=1)), "a component without a place"),
    "stranger": (in_text(lambda t: t.replace("'left'", "'lift'")), '"lift" does not belong'),
    "swapped names": (in_text(lambda t: re.sub("'(left|right)'", lambda m: str(SWAPPED[m[1]]), t)), "left stands"),
    "name": (in_text(lambda t: t.replace("PRODUCT('planet','planet'", "PRODUCT('plant','plant'")), "planet is missing"),
    "title": (in_text(lambda t: t.replace("PRODUCT('train','train'", "PRODUCT('tram','tram'")), '"tram"'),
    "colour": (in_text(lambda t: re.sub(r"COLOUR_RGB\('',0\.\d+", "COLOUR_RGB('',0.9", t)), "coloured"),
    "cut short": (in_text(lambda t: t[: len(t) // 2]), ""),
}  # fmt: skip


def caught(
    file: Path, spoiler: tuple[Callable[[Path], None], str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A copy of the file and its report, spoiled: verify says so, and by that word."""
    for name in (file.name, "report.json"):
        (folder / name).write_bytes((file.parent / name).read_bytes())
    change, word = spoiler
    change(folder / file.name)
    capsys.readouterr()
    assert run("verify", folder / file.name) == 1
    assert word in capsys.readouterr().out


@pytest.mark.sampled(7)
@pytest.mark.parametrize("spoil", SPOIL_3MF)
def test_a_spoiled_3mf_is_caught(
    spoil: str, tmp_path: Path, train_3mf: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    caught(train_3mf, SPOIL_3MF[spoil], tmp_path, capsys)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("spoil", SPOIL_STEP)
def test_a_spoiled_step_is_caught(
    spoil: str, tmp_path: Path, train_step: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    caught(train_step, SPOIL_STEP[spoil], tmp_path, capsys)


def test_copies_of_a_solid_are_no_instances(train_step: Path, tmp_path: Path) -> None:
    """An occurrence whose product is a copy: the same picture, but not one part in two places."""
    from exporters.formats.read_step import read_step_assembly
    from exporters.formats.step import write_step
    from exporters.production.recheck import recheck
    from geometry.base.placement import Placement3
    from parts.solids.faces import solid_curves, solid_faces
    from parts.solids.step_text import StepForm, StepGroup, StepPart

    found, made = read_step_assembly(train_step), train()[0]
    bodies = {name: made[name].body(0.0) for name, *_ in found.prototypes}
    solids = {name: solid_faces(body, solid_curves(body, 9e-7)) for name, body in bodies.items()}
    parts = {n: StepPart(n, s, "#c08040") for n, s in solids.items()}
    parts["copy"] = StepPart("copy", solids["planet"])
    rows = []
    for name, index, matrix, _ in found.occurrences:
        turned, (x, y, z) = [(a, b, c) for a, b, c in matrix[:, :3].tolist()], matrix[:, 3].tolist()
        part = "copy" if name == "free" else found.prototypes[index][0]
        rows.append((name, parts[part], Placement3((turned[0], turned[1], turned[2]), (x, y, z))))
    write_step(tmp_path / "train.step", StepGroup("train", tuple(rows)), StepForm())
    text = (tmp_path / "train.step").read_text(encoding="ascii").replace("'copy','copy'", "'planet','planet'")
    (tmp_path / "train.step").write_text(text, encoding="ascii")
    (tmp_path / "report.json").write_bytes((train_step.parent / "report.json").read_bytes())
    assert "part planet is there 2 times" in recheck(tmp_path / "train.step").verdict.failures


@pytest.mark.parametrize("kind", ["step", "3mf"])
def test_a_file_of_one_part_must_have_its_name(
    kind: str, tmp_path: Path, request: pytest.FixtureRequest, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = request.getfixturevalue("train_step" if kind == "step" else "train_3mf").parent
    file = tmp_path / f"sun.{kind}"
    for name in (file.name, "report.json"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    assert run("verify", file) == 0
    if kind == "step":
        in_text(lambda t: t.replace("PRODUCT('sun','sun'", "PRODUCT('son','son'"))(file)
    else:
        in_model(lambda t: t.replace('name="sun" type', 'name="son" type'))(file)
    assert run("verify", file) == 1
    assert "son" in capsys.readouterr().out


def train() -> tuple[dict[str, Part], tuple[Instance, ...]]:
    """Its parts, and where they stand."""
    scene = scene_from_toml(TRAIN.encode(), "train.toml", "train")
    parts, matings = make_parts(scene, "train.toml")
    return parts, place(scene.instances, scene.drives, parts, matings, "train.toml").instances


def test_an_assembly_is_measured_at_its_worst_part_and_its_worst_place(train_3mf: Path, tmp_path: Path) -> None:
    """Its deviation is the greatest of the part files beside it; a place is off by what its text was changed by."""
    report = read_report(train_3mf.parent)
    measured = {entry["part"]: entry["measured"] for entry in report["files"]}
    whole = measured.pop(None)
    assert (whole["parts"], whole["instances"]) == (2, 4)
    assert whole["max_deviation"] == pytest.approx(max(m["max_deviation"] for m in measured.values()), rel=1e-9)
    assert whole["max_deviation"] > 1e-4
    (tmp_path / "report.json").write_bytes((train_3mf.parent / "report.json").read_bytes())
    file = tmp_path / train_3mf.name
    rim = train()[0]["planet"].circles["tip_diameter"] / 2
    # the first and the last of all instances: less than their last digits count for, and more; a turn counts at the rim
    for old, new, off in (
        (" -2.0 0.25", " -2.0 0.2500000004", 4e-10),
        (" 60.0 1.0", " 60.0 1.000000003", 3e-9),
        ('"0.8386705679454', '"0.8386706679454', 1e-7 * rim),
    ):
        file.write_bytes(train_3mf.read_bytes())
        in_model(lambda text, old=old, new=new: text.replace(old, new))(file)
        found = recheck(file).verdict
        assert found.measured["max_displacement"] == pytest.approx(off, rel=1e-3)
        assert bool(found.failures) is (off > 1e-9)


class Fits:
    """A probe that finds a gap and refuses it."""

    name, needs_whole = "pin", False

    def run(self, found: ReadBack, offset: float, declared: float) -> Probed:
        return Probed({"gap": 0.25}, ("it does not fit",))


def test_what_the_probes_of_its_parts_say_counts_for_an_assembly(train_3mf: Path) -> None:
    parts, stand = train()
    planet = parts["planet"]

    class Asking(type(planet.made_by)):  # type: ignore[misc]
        def probes(self, keys: Any, thing: Any) -> tuple[Probe, ...]:
            return (Fits(),)

    asked = parts | {"planet": replace(planet, made_by=Asking())}
    kind = file_kind("3mf", None)
    good, found = (
        verify_assembly(train_3mf, kind, ExpectedAssembly("train", p, 0.0, stand), 0.1, 0.1) for p in (parts, asked)
    )
    assert not good.failures
    assert found.failures == ("planet: it does not fit",)
    assert found.measured == good.measured | {"planet.pin_gap": 0.25}
