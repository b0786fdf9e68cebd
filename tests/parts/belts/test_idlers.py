"""Belt drives with idlers: length, wraps, teeth in mesh, where the tensioner makes the belt taut, refusals."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest

from exporters.documents.topics import calculate
from exporters.formats.read_motion import read_motion
from parts.base.refusal import SceneError
from parts.mates.wrapped import idler_quantities
from tests.exporters.making import run, table, write_scene
from tests.parts.belts.test_timing_pulleys import LARGE, MATE, PLATE, Keys, placed

SVG = "{http://www.w3.org/2000/svg}"
# a ball bearing of 10 mm on the back of a belt GT2, whose pitch line is 0.38 mm off it
ROLLER: Keys = {"at": [30.0, 15.5], "diameter": 10.0, "pitch_line_offset": 0.38, "outside": True}


def told(idlers: list[Keys], two: Keys = PLATE, **mate: Any) -> dict[str, Any]:
    (found,) = placed({"centre_distance": 60.0, "idlers": idlers} | mate, PLATE, two)[1]["mates"]
    return dict(found)


def test_a_tensioner_from_outside_takes_up_the_belt() -> None:
    """Two pulleys of 20 teeth, the roller above the middle between them: right triangles of the inner tangents."""
    radius, roller, height = 20.0 / math.pi, 5.38, 11.0
    far = math.hypot(30.0, height)
    lean = math.asin((radius + roller) / far) - math.atan2(height, 30.0)
    length = 2 * math.sqrt(far**2 - (radius + roller) ** 2) + 2 * lean * roller + 2 * (math.pi + lean) * radius + 60.0
    found = told([ROLLER | {"at": [30.0, height]}])
    assert found["number_of_belt_teeth"] == math.ceil(length / 2)
    assert found["belt_slack"] == pytest.approx(2 * math.ceil(length / 2) - length, abs=1e-9)
    assert found["idler_wrap_deg"] == pytest.approx(math.degrees(2 * lean))
    assert found["teeth_in_mesh"] == pytest.approx(20 * (math.pi + lean) / (2 * math.pi))
    # moved to where it is told to be, it makes the belt taut
    place = [found["taut_idler_x"], found["taut_idler_y"]]
    assert place[0] == pytest.approx(30.0, abs=1e-9)
    assert place[1] < height
    moved = told([ROLLER | {"at": [30.0, round(place[1], 4)]}], number_of_belt_teeth=found["number_of_belt_teeth"])
    assert moved["belt_slack"] < 1e-3
    assert "belt_hangs_loose" in json.dumps(found)
    assert "belt_hangs_loose" not in json.dumps(moved)


def test_an_idler_inside_turns_the_second_on_by_the_longer_strand() -> None:
    """Its pulley stands where its grooves take the belt's teeth, and the belt goes about the idler too."""
    idlers = [{"at": [25.0, 22.0], "number_of_teeth": 16}, ROLLER | {"at": [28.0, -17.5]}]
    placing = placed({"centre_distance": 60.0, "idlers": idlers}, PLATE, LARGE)[0]
    (mate,) = placing.mates
    rollers = mate.rollers()
    assert rollers is not None
    seated = [p for p in (rollers[0] - 60.0).tolist() if abs(abs(p) - 60 / math.pi) < 1e-9]
    assert len(seated) >= 25
    for at in seated:
        # grooves stand half a pitch beside tooth 1
        off = math.remainder(math.atan2(at.imag, at.real) - mate.second.rotation + math.pi / 60, math.pi / 30)
        assert abs(off) < 1e-9
    idler = [p for p in rollers[0].tolist() if abs(abs(p - (25 + 22j)) - 16 / math.pi) < 1e-9]
    assert len(idler) >= 2


def test_calc_takes_the_drive_and_its_idlers_from_a_scene(tmp_path: Path) -> None:
    mate = MATE | {"centre_distance": 60.0, "idlers": [ROLLER]}
    scene = write_scene(tmp_path / "s.toml", {"a": PLATE, "b": LARGE}, [{"format": "stl"}], table("[[mates]]", mate))
    values = json.loads(calculate("belt", [str(scene)], "json", "en"))["values"]
    found = told([ROLLER], LARGE)
    assert values["belt_slack"] == pytest.approx(found["belt_slack"])
    assert values["taut_loop_length"] == pytest.approx(found["belt_length"] - found["belt_slack"])
    assert values["loop_wrap_deg"]["first"] == pytest.approx(found["wrap_deg"])
    # without it the belt is shorter
    assert json.loads(calculate("belt", ["belt_drive"], "json", "en"))["values"]["belt_length"] == 200.0
    assert "textbook_belt_length" not in values


@pytest.mark.parametrize(
    ("mate", "words"),
    [
        ({"idlers": [ROLLER | {"at": [30.0, 25.0]}]}, r"\.at = \[30.0, 25.0\]: is not where .* outside = false"),
        ({"idlers": [{"at": [30.0, 1.0], "diameter": 4.0}]}, r"\.at = \[30.0, 1.0\]: .* outside = true"),
        # behind the first pulley neither side goes round it
        ({"idlers": [ROLLER | {"at": [-30.0, 0.0]}]}, r"\.at = \[-30.0, 0.0\]: is not where .* idler$"),
        (
            {"idlers": [ROLLER | {"at": [-30.0, 0.0], "outside": False}]},
            r"\.at = \[-30.0, 0.0\]: is not where .* idler$",
        ),
        # 3-4-5: 11.25 off the second's axis, the sum of the radii 60 / pi + 5.38
        ({"idlers": [ROLLER | {"at": [51.0, 6.75]}]}, r"\.at = .*: is 11\.25 mm off .*: at least 24\.4786 mm"),
        ({"idlers": [{"at": [30.0, 0.0], "diameter": 4.0}]}, r"idlers\[1\].at"),
        ({"idlers": [ROLLER], "centre_distance": None, "number_of_belt_teeth": 100}, r"centre_distance.*missing"),
        ({"idlers": [{"at": [30.0, 15.0]}]}, r"idlers\[1\].number_of_teeth.*diameter"),
        ({"idlers": [ROLLER | {"number_of_teeth": 20}]}, r"idlers\[1\].diameter"),
        ({"idlers": [ROLLER | {"pitch_line_offset": -5.0}]}, r"idlers\[1\].pitch_line_offset"),
        ({"idlers": [ROLLER], "number_of_belt_teeth": 80}, r"number_of_belt_teeth = 80: .*; 10\d works"),
    ],
)
def test_idlers_that_do_not_go_are_refused_by_their_key(mate: Keys, words: str) -> None:
    keys = {k: v for k, v in ({"centre_distance": 60.0} | mate).items() if v is not None}
    with pytest.raises(SceneError, match=words):
        placed(keys)


@pytest.mark.parametrize("typed", ["[{at=[30,11],diameter=10,outside=True}]", "[{at=[30,11],diameter=ten}]"])
def test_a_list_that_is_none_of_toml_is_told_so(typed: str) -> None:
    """It had to be a list in brackets, which it seems to be."""
    keys = ["belt=GT2", "number_of_teeth=20", "mate_number_of_teeth=36", "centre_distance=60", f"idlers={typed}"]
    with pytest.raises(SceneError) as refused:
        calculate("belt", keys, "text", "en")
    assert (refused.value.key, refused.value.code) == ("belt.idlers", "brackets_read_as_text")


def test_what_is_offered_where_the_belt_passes_an_idler_goes_round_it() -> None:
    for idler in (ROLLER | {"at": [30.0, 25.0]}, {"at": [30.0, 1.0], "diameter": 4.0}):
        other = {"outside": not idler.get("outside", False)}
        assert told([idler | other])["idler_wrap_deg"] > 0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ["belt", "chain"])
def test_pictures_have_the_idlers_and_all_that_runs_about_them(tmp_path: Path, kind: str) -> None:
    """No part is an idler: none was in a picture, which was cut off where the loop leaves the two wheels' rectangle."""
    two: list[Keys] = [ROLLER, {"at": [28.0, -30.0], "diameter": 9.0}]
    parts: Keys = {"a": PLATE, "b": LARGE}
    mate: Keys = {"kind": "belt_drive", "first": "a", "second": "b", "centre_distance": 60.0, "idlers": two}
    if kind == "chain":
        two = [{"at": [110.0, 62.0], "diameter": 10.0, "outside": True}, {"at": [90.0, -95.0], "diameter": 9.0}]
        parts = {"a": {"kind": "sprocket", "chain": "08B-1", "number_of_teeth": 17}}
        parts["b"] = parts["a"] | {"number_of_teeth": 38}
        mate |= {"kind": "chain_drive", "centre_distance": 200.0, "idlers": two}
    exports: list[Keys] = [
        {"format": "svg"},
        {"format": "motion"},
        {"format": "dxf", "purpose": "assembly", "paper": "A3"},
    ]
    head = table("[[mates]]", mate) + table("[[drives]]", {"instance": "a", "turns": 2.0})
    assert run("build", write_scene(tmp_path / "s.toml", parts, exports, head), "--out", tmp_path) == 0
    preview, film = tmp_path / "s" / "s.preview.svg", tmp_path / "s" / "s.motion.svg"
    root = ElementTree.parse(preview).getroot()
    wide, high = (float(x) for x in root.attrib["viewBox"].split()[2:])
    (group,) = (g for g in root.iter(f"{SVG}g") if "transform" in g.attrib)
    down = float(group.attrib["transform"].split()[1].rstrip(")"))
    circles = [tuple(float(c.attrib[k]) for k in ("cx", "cy", "r")) for c in group.iter(f"{SVG}circle")]
    assert all(r <= x <= wide - r and r <= y + down <= high - r for x, y, r in circles)
    wheels = [c for c in circles if c[2] in (5.0, 4.5)]
    assert [c[2] for c in wheels] == [5.0, 4.5]
    apart = complex(*wheels[1][:2]) - complex(*wheels[0][:2])
    (x, y), (to_x, to_y) = two[0]["at"], two[1]["at"]
    assert apart == pytest.approx(complex(to_x - x, y - to_y), abs=1e-3)
    tracks = read_motion(film)
    for k, (idler, radius) in enumerate(zip(two, (5.0, 4.5), strict=True), 1):
        corners = tracks[f"idler.a.b.{k}"].loops[0].vertices
        assert np.abs(corners - complex(*idler["at"])) == pytest.approx(radius, abs=1e-5)
    drawn = ezdxf.readfile(tmp_path / "s" / "s.assembly.dxf").modelspace()
    radii = {c.dxf.radius for c in drawn.query("CIRCLE ARC")}
    assert any(
        {round(5.0 * s, 6), round(4.5 * s, 6)} <= {round(r, 6) for r in radii} for s in (0.4, 0.5, 1.0, 2.0, 2.5)
    )
    # one that stands elsewhere is seen
    assert run("verify", film) == 0
    text = film.read_text(encoding="utf-8")
    spoiled = text.replace('idler.a.b.2" transform="translate(0,0)', 'idler.a.b.2" transform="translate(0.1,0)')
    assert spoiled != text
    film.write_text(spoiled, encoding="utf-8")
    assert run("verify", film) == 1


def test_the_least_wrap_of_all_idlers_is_told() -> None:
    assert idler_quantities([1.0, math.pi / 6, 2.0], None) == {"idler_wrap_deg": pytest.approx(30.0)}
    assert idler_quantities([1.0], 3 - 4j).keys() == {"idler_wrap_deg", "taut_idler_x", "taut_idler_y"}
