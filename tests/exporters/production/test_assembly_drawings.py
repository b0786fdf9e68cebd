"""Assembly drawings: sizes off the files, a number for every position, nothing covered is drawn, refusals by key."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely

from exporters.command.cli import main
from exporters.production import assembly_drawings
from exporters.production.plan import plan_build
from exporters.production.sheets import SheetJob
from geometry.base.placement import Placement3
from geometry.base.record import replace
from geometry.curves.line_arc import Arc, Line
from geometry.solids.sketch import Layer, Sketch, round_ring, sketch_of_turned
from geometry.solids.turned import HalfSection, Piece
from parts.base.refusal import SceneError
from parts.drawing.assembly_views import Shown, along_axes, cut
from parts.scene.files import built_in_scenes
from parts.scene.load import scene_from_dict, tomllib
from tests.exporters.production.test_part_drawings import sizes
from tests.exporters.production.test_sheet_words import faults

DISC = {"kind": "pin", "diameter": 40.0, "length": 5.0}


def scene(address: str, language: str = "en", **changed: Any) -> dict[str, Any]:
    """A built-in scene with assembly drawings alone."""
    raw = tomllib.loads(built_in_scenes()[address].read_text(encoding="utf-8"))
    raw["scene"] = {**raw.get("scene", {}), "language": language}
    exports = [{"format": f, "purpose": "assembly"} for f in ("dxf", "svg")]
    return {**raw, "exports": exports, "checks": {}, **changed}


def written(folder: Path, raw: dict[str, Any]) -> dict[str, Path]:
    """The files of a scene, each read back."""
    found = {}
    for job in plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets:
        file = folder / job.path
        job.write({}, file)
        assert job.verify(file, 0.0).failures == ()
        found[file.suffix[1:]] = file
    return found


def numbers(dxf: Path) -> list[tuple[str, complex]]:
    """The numbers on shelves, 5 mm high, and where they stand."""
    words = ezdxf.readfile(dxf).modelspace().query("TEXT")
    return sorted(
        (e.dxf.text, complex(*e.dxf.insert.vec2)) for e in words if e.dxf.text.isdigit() and e.dxf.height == 5.0
    )


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("address", "language", "measured", "positions"),
    [
        # the centre distance of (3.4), the face width, tips: (d_a1 + d_a2) / 2 + a_w
        ("practicum_pair", "en", {"179.183": 179.182637406, "40": 40.0}, 2),
        pytest.param("practicum_pair", "uk", {"179,183": 179.182637406, "40": 40.0}, 2, marks=pytest.mark.heavy),
        # m (z + z) / 2; the ring's outside
        pytest.param("james", "en", {"80": 80.0, "270": 270.0}, 5, marks=pytest.mark.heavy),
        # d_ae of the wheel, m (z + 2 (1 - x) cos(delta))
        ("bevel_pair", "en", {"81.252": 2 * (40 + 2 * 0.7 * math.cos(math.atan(2)))}, 2),
        ("worm_set_print", "uk", {"40": 40.0, "24": 24.0}, 2),
        ("crossed_helical_pair", "en", {"56.569": 40 * math.sqrt(2)}, 2),
    ],
)
def test_sizes_measure_the_scene_and_every_position_has_its_number(
    tmp_path: Path, address: str, language: str, measured: dict[str, float], positions: int
) -> None:
    files = written(tmp_path, scene(address, language))
    assert faults(files["svg"]) == []
    found = sorted(sizes(files["dxf"]).values())
    for value in measured.values():
        assert min(abs(value - other) for other in found) < 1e-6
    shown = numbers(files["dxf"])
    assert [int(text) for text, _ in shown] == list(range(1, positions + 1))
    # in columns: of each side of each view all numbers begin at one place
    assert len({round(at.real, 1) for _, at in shown}) <= 4
    audit = ezdxf.readfile(files["dxf"]).audit()
    assert not audit.errors
    assert not audit.fixes


@pytest.mark.heavy
def test_a_rack_stands_off_the_gear_by_its_datum_line_wherever_its_middle_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The middle tooth of an odd rack lies beside a space of the gear: drawing and check went from the gear's axis to
    that middle, and told directions of 27 and of -43 degrees. The other gear stands ten pitches further along.
    """
    file = tmp_path / "s.toml"
    file.write_text(
        '[parts.gear]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 20\n'
        '[parts.rack]\nkind = "rack"\nmodule = 2.0\nnumber_of_teeth = 41\n[instances.gear]\n'
        '[instances.other]\npart = "gear"\n'
        f"at = [{-20 * math.pi * math.sin(math.pi / 6)}, {20 * math.pi * math.cos(math.pi / 6)}, 0.0]\n"
        '[[mates]]\nkind = "rack_pair"\nfirst = "gear"\nsecond = "rack"\ndirection_deg = 30.0\n'
        '[[mates]]\nkind = "rack_pair"\nfirst = "other"\nsecond = "rack"\n'
        '[[exports]]\nformat = "dxf"\npurpose = "assembly"\n[[exports]]\nformat = "svg"\npurpose = "assembly"\n',
        "utf-8",
    )
    main(["check", str(file), "--json"])
    told = json.loads(capsys.readouterr().out)["mates"]
    assert [mate["direction_deg"] for mate in told] == pytest.approx([30.0, 30.0])
    assert [mate["verdict"] for mate in told] == ["contact", "contact"]
    (dxf,) = (path for name, path in written(tmp_path, tomllib.loads(file.read_text("utf-8"))).items() if name == "dxf")
    found = sorted(sizes(dxf).values())
    assert min(abs(20.0 - size) for size in found) < 1e-6


def test_a_position_that_no_view_shows_is_told() -> None:
    """A disc between two larger ones is covered from above, and beside the plane of the section."""
    parts = {"top": DISC, "low": DISC, "hidden": {"kind": "pin", "diameter": 4.0, "length": 5.0}}
    places = {"top": [0.0, 0.0, 10.0], "low": [0.0, 0.0, 0.0], "hidden": [0.0, 12.0, 5.0]}
    raw = {"parts": parts, "instances": {k: {"part": k, "at": at} for k, at in places.items()},
           "exports": [{"format": "svg", "purpose": "assembly"}]}  # fmt: skip
    job = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets[0]
    row = next(p for p in job.findings({}))
    assert row.code == "position_not_shown"
    numbered = {text.text for text in job.canvas.texts if text.runs and text.runs[0].height == 5.0}
    assert f"{row.value:.0f}" not in numbered


@pytest.mark.parametrize(("density", "told"), [({"density": 4.0}, True), ({}, False)])
def test_the_title_block_has_the_mass_of_all_or_none(density: dict[str, float], told: bool) -> None:
    """pi 20^2 5 mm^3 of 8 g/cm^3 once and of 4 g/cm^3 twice."""
    parts = {"one": DISC | {"density": 8.0}, "two": DISC | density}
    places = {"one": ("one", [0.0, 0.0, 0.0]), "a": ("two", [60.0, 0.0, 0.0]), "b": ("two", [120.0, 0.0, 0.0])}
    raw = {"parts": parts, "instances": {k: {"part": part, "at": at} for k, (part, at) in places.items()},
           "exports": [{"format": "svg", "purpose": "assembly"}]}  # fmt: skip
    job = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets[0]
    whole = f"{math.pi * 20**2 * 5 * (8 + 2 * 4) / 1e6:.3g}"
    assert (whole in {text.text for text in job.canvas.texts}) == told


@pytest.mark.heavy
def test_the_same_bytes_twice(tmp_path: Path) -> None:
    once = {ending: file.read_bytes() for ending, file in written(tmp_path, scene("practicum_pair")).items()}
    again = {ending: file.read_bytes() for ending, file in written(tmp_path, scene("practicum_pair")).items()}
    assert once == again


def disc(name: str, centre: complex, height: float, *, over: bool = False) -> Shown:
    ring = (round_ring(20.0),)
    place = Placement3.towards((0.0, 0.0, -1.0 if over else 1.0), 0.3, (centre.real, centre.imag, height))
    return Shown(name, name, Sketch((Layer(0.0, 5.0, ring, ring),)), place)


@pytest.mark.parametrize("distance", [5.0, 20.0, 39.0, 41.0])
def test_what_is_covered_is_not_drawn(distance: float) -> None:
    # two circles of one radius: the lower one shows 2 r (pi - acos(d / 2 r))
    drawn = along_axes([disc("low", 0j, 0.0), disc("high", distance + 0j, 20.0, over=True)])
    lengths: dict[bool, float] = {}
    for layer, curve in drawn.strokes:
        points = curve.point(np.linspace(*curve.domain, 20001))
        high = bool(abs(np.abs(points - distance).max() - 20.0) < 1e-9)
        lengths[high] = lengths.get(high, 0.0) + float(np.abs(np.diff(points)).sum()) * (layer == "OUTLINE")
    covered = math.acos(distance / 40.0) if distance < 40 else 0.0
    assert lengths[True] == pytest.approx(40 * math.pi, abs=1e-5)
    assert lengths[False] == pytest.approx(40 * (math.pi - covered), abs=1e-5)


def test_a_ball_that_is_cut_is_not_hatched() -> None:
    sketch = sketch_of_turned(HalfSection((Piece(-5j, 5j, 0j), Piece(5j, -5j))))
    shown = Shown("ball", "ball", sketch, Placement3(translation=(0.0, 0.0, 1.0)))
    assert cut([shown]).hatched == ()
    assert cut([replace(shown, sketch=replace(sketch, is_ball=False))]).hatched


def refused(parts: dict[str, Any], **raw: Any) -> SceneError:
    whole = {"parts": parts, "exports": [{"format": "svg", "purpose": "assembly"}], **raw}
    with pytest.raises(SceneError) as caught:
        plan_build(scene_from_dict(whole, "t", "t"), "t", [], [])
    return caught.value


def test_what_cannot_be_drawn_is_told_by_key() -> None:
    barrel = tomllib.loads(built_in_scenes()["barrel_cam"].read_text(encoding="utf-8"))["parts"]["barrel"]
    assert (refused({"p": barrel}).key, refused({"p": barrel}).code) == ("exports[1].purpose", "no_assembly_view")
    tilted = {"p": {"at": [0.0, 0.0, 0.0]}, "q": {"at": [60.0, 0.0, 0.0], "axis": [0.6, 0.0, 0.8]}}
    found = refused({"p": DISC, "q": DISC}, instances=tilted)
    assert (found.key, found.code) == ("exports[1].purpose", "assembly_axis_oblique")
    small = refused({"p": DISC}, exports=[{"format": "svg", "purpose": "assembly", "paper": "A4", "scale": "10:1"}])
    assert small.key == "exports[1].paper"


@pytest.mark.sampled(1)
@pytest.mark.parametrize("at", [[50.0, 0.0, 0.0], [30.0, -40.0, 0.0]])
def test_an_assembly_is_drawn_alike_wherever_it_stands(at: list[float]) -> None:
    def drawn(at: list[float]) -> tuple[Counter[str], list[str]]:
        gear = {"kind": "spur_gear", "module": 2.0, "face_width": 8.0, "bore_diameter": 8.0}
        raw = {
            "parts": {"a": gear | {"number_of_teeth": 20}, "b": gear | {"number_of_teeth": 31}},
            "instances": {"a": {"part": "a", "at": at}, "b": {"part": "b"}},
            "mates": [{"kind": "external_gear_pair", "first": "a", "second": "b", "direction_deg": 30.0}],
            "exports": [{"format": "dxf", "purpose": "assembly"}],
        }
        (job,) = plan_build(scene_from_dict(raw, "s", "s"), "s", [], []).sheets
        assert isinstance(job, SheetJob)
        rows = Counter[str]()
        for stroke in job.canvas.strokes:
            ends = stroke.curve.point(np.array(stroke.curve.domain))
            rows[f"{stroke.layer} {sorted((round(p.real, 2) + 0.0, round(p.imag, 2) + 0.0) for p in ends)}"] += 1
        return rows, [text.text for text in job.canvas.texts]

    plain, moved = drawn([0.0, 0.0, 0.0]), drawn(at)
    assert moved == plain
    assert plain[0].total() > 50


def leaders(job: SheetJob) -> list[Line]:
    """The lines that begin in a dot, as numbers' leaders do."""
    thin = [stroke.curve for stroke in job.canvas.strokes if stroke.layer == "THIN"]
    dots = {curve.centre for curve in thin if isinstance(curve, Arc) and curve.radius == 0.5}
    return [curve for curve in thin if isinstance(curve, Line) and curve.start in dots]


def test_no_leader_is_chosen_by_last_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Both gears have many places with as much room about: another machine takes the same ones."""
    raw = scene("practicum_pair", exports=[{"format": "svg", "purpose": "assembly"}])
    draw, plain = np.random.default_rng(37), assembly_drawings.seen

    def moved(shown: Sequence[Shown], view: Placement3) -> list[Shown]:
        def off(place: Placement3) -> Placement3:
            x, y, z = (float(w + draw.integers(-3, 4) * 1e-15 * max(abs(w), 1.0)) for w in place.translation)
            return replace(place, translation=(x, y, z))

        return [replace(one, place=off(one.place)) for one in plain(shown, view)]

    found = []
    for number in range(4):
        monkeypatch.setattr(assembly_drawings, "seen", moved if number else plain)
        (job,) = plan_build(scene_from_dict(raw, "s", "s"), "s", [], []).sheets
        assert isinstance(job, SheetJob)
        found.append(np.array([end for line in leaders(job) for end in (line.start, line.end)]))
    for other in found[1:]:
        assert other == pytest.approx(found[0], abs=1e-6)


def test_no_leader_goes_along_an_axis_or_the_mark_of_a_section() -> None:
    """GOST 2.316; the most room in a worm wheel is on its axis, level with the shelf: both lay on one another."""
    raw = scene("worm_set_print", exports=[{"format": "svg", "purpose": "assembly"}])
    (job,) = plan_build(scene_from_dict(raw, "s", "s"), "s", [], []).sheets
    assert isinstance(job, SheetJob)
    others = (stroke.curve for stroke in job.canvas.strokes if stroke.layer in ("CENTRE", "FRAME", "HATCH"))
    ends = [[(p.real, p.imag) for p in (c.start, c.end)] for c in others if isinstance(c, Line)]
    found = leaders(job)
    for line in found:
        beside = shapely.LineString([(p.real, p.imag) for p in (line.start, line.end)]).buffer(1.0, cap_style="flat")
        assert all(shapely.LineString(both).intersection(beside).length < 9 for both in ends)
    assert len(found) == 2


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    "address", ["chain_drive", "belt_drive", "helical_pair", "cycloidal_reducer", "practicum_pair"]
)
def test_no_leader_crosses_the_mark_of_a_section(address: str) -> None:
    """A stroke 7 mm long and its arrow: the leader of a sprocket ran through both, 3 degrees off the stroke."""
    raw = scene(address, exports=[{"format": "svg", "purpose": "assembly"}])
    raw.get("defaults", {}).pop("kerf", None)
    (job,) = plan_build(scene_from_dict(raw, "s", "s"), "s", [], []).sheets
    assert isinstance(job, SheetJob)
    frame = [s.curve for s in job.canvas.strokes if s.layer == "FRAME" and isinstance(s.curve, Line)]
    strokes = [c for c in frame if abs(abs(c.end - c.start) - 7.0) < 1e-6 and abs((c.end - c.start).imag) < 1e-9
               and any(t.text == "A" and abs(t.box.middle - c.start) < 15.0 for t in job.canvas.texts)]  # fmt: skip
    assert len(strokes) == 2
    for line in leaders(job):
        way = shapely.LineString([(p.real, p.imag) for p in (line.start, line.end)])
        for c in strokes:
            left, right = sorted((c.start.real, c.end.real))
            assert not way.intersects(shapely.box(left, c.start.imag - 5.0, right, c.start.imag))


def test_a_leader_comes_from_the_side_on_which_its_part_stands() -> None:
    """A height stands on the right: a leader from the left crosses the other part, one from the right the height."""
    parts = {"left": DISC, "right": DISC | {"diameter": 60.0}}
    places = {"left": [0.0, 0.0, 0.0], "right": [200.0, 5.0, 0.0]}
    raw = {"parts": parts, "instances": {k: {"part": k, "at": at} for k, at in places.items()},
           "exports": [{"format": "svg", "purpose": "assembly"}]}  # fmt: skip
    (job,) = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets
    assert isinstance(job, SheetJob)
    one, two = sorted(leaders(job), key=lambda line: line.start.real)
    assert one.end.real < one.start.real
    assert two.end.real > two.start.real


@pytest.mark.parametrize("way", [0.0, 40.0])
def test_the_section_goes_through_the_axes_of_gears_not_through_that_of_a_key(tmp_path: Path, way: float) -> None:
    """A key lies 8.5 mm beside its shaft's axis and is mated first: the section went through both, not by the wheel.

    In the plane of the axes the scene is m (z + z) / 2 + m (z + z + 4) / 2 = 246 long, across it as the wheel: 186. To
    a plane at 40 degrees the key is oblique: the section goes through it and the shaft.
    """
    gear = {"kind": "spur_gear", "module": 3.0, "face_width": 30.0, "bore_diameter": 25.0}
    parts = {
        "shaft": {"kind": "shaft", "steps": [{"diameter": 25.0, "length": 89.0}]},
        "key": {"kind": "key", "shaft_diameter": 25.0, "length": 28.0},
        "pinion": {**gear, "number_of_teeth": 20},
        "wheel": {**gear, "number_of_teeth": 60},
    }
    on_shaft = {"kind": "fixed", "first": "shaft"}
    mates = [
        {**on_shaft, "second": "key", "offset": [0.0, 8.5, 43.0], "axis": [0.0, 1.0, 0.0], "rotation_deg": 90.0},
        {**on_shaft, "second": "pinion", "offset": [0.0, 0.0, 26.0]},
        {"kind": "external_gear_pair", "first": "pinion", "second": "wheel", "direction_deg": way},
    ]
    raw = {"parts": parts, "mates": mates,
           "exports": [{"format": "dxf", "purpose": "assembly"}]}  # fmt: skip
    document = ezdxf.readfile(written(tmp_path, raw)["dxf"])
    found: dict[int, list[float]] = {0: [], 90: []}
    for size in document.modelspace().query("DIMENSION"):
        found[round(size.dxf.angle) % 180].append(size.get_measurement() * document.header["$DIMLFAC"])
    if way:
        both = [120 * math.sin(math.radians(way)), 120 * math.cos(math.radians(way))]
        assert [
            min(told, key=lambda d, a=a: abs(d - a)) for told, a in zip(found.values(), both, strict=True)
        ] == pytest.approx(both)
    else:
        assert (sorted(found[0]), sorted(found[90])) == (pytest.approx([120.0, 246.0]), pytest.approx([89.0, 186.0]))


@pytest.mark.parametrize(
    ("scale", "offered", "side", "code"),
    [("1:1", "2:1", "at_least", "fits_no_scale_so_small"), ("100:1", "20:1", "at_most", "fits_no_paper_so_large")],
)
def test_a_scale_at_which_words_find_no_room_is_told_with_one_at_which_they_do(
    scale: str, offered: str, side: str, code: str
) -> None:
    """Words do not shrink: at 2:1 they stand about the roller, at 1:1 they meet. Before: a traceback."""
    roller = {
        "kind": "roller", "diameter": 16.48, "hub": {"diameter": 14.0, "below": 1.9, "above": 0.9},
        "bore": {"shape": "square", "across_flats": 6.6, "corner_radius": 0.1, "clearance": 1.9, "angle_deg": 138.4},
    }  # fmt: skip
    export = {"format": "svg", "purpose": "assembly"}
    found = refused({"roller": roller}, exports=[export | {"scale": scale}])
    assert found.nearest is not None
    told = found.key, found.code, found.nearest.value, found.nearest.side
    assert told == ("exports[1].scale", code, offered, side)
    raw = {"parts": {"roller": roller}, "exports": [export | {"scale": offered}]}
    assert plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets
