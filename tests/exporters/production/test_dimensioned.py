"""From the dimensions of its drawing alone each turned part can be made again, and none of them is one too many."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import ezdxf
import msgspec
import pytest
from ezdxf.document import Drawing

from parts.base.refusal import SceneError
from parts.scene.load import load_scene
from tests.exporters.production.test_part_drawings import jobs
from tests.oracles.half_section_told import Corner, Told
from tests.sampling import some_of


def ring(*rows: tuple[float, ...], **more: Any) -> dict[str, Any]:
    """A turned part by r, z, arc, chamfer, fillet of its corners."""
    return {"kind": "turned", **more, "points": [
        dict(zip(("r", "z", "arc", "chamfer", "fillet"), row, strict=False)) for row in rows]}  # fmt: skip


PARTS: dict[str, dict[str, Any]] = {
    "recesses": ring((10, 0), (40, 0, 0, 1), (40, 12), (30, 20, 0, 0, 1), (30, 35, 0, 1), (25, 35), (25, 28),
                     (14, 28, 0, 0, 1), (14, 8), (10, 6)),
    "grooves": ring((8, 0), (30, 0), (30, 5), (24, 9), (24, 11), (30, 15), (30, 20), (8, 20), (8, 14), (10, 14),
                    (10, 11), (8, 11)),
    "countersink": ring((5, 3), (8, 0), (20, 0), (20, 10), (9, 10), (5, 7)),
    "raceway": ring((20, 0), (31, 0, 0, 1), (31, 16), (20, 16), (20, 11, -3.5), (20, 5)),
    "bull_nose": ring((10, 0), (30, 0, 5), (30, 10), (10, 10)),
    "ball": ring((0, -12, 12), (0, 12)),
    "both_sides": ring((10, 0), (30, 0), (30, 4), (20, 4), (20, 9), (40, 9), (40, 14), (35, 14), (35, 18), (25, 18),
                       (25, 30), (15, 30), (15, 22), (10, 22)),
    "spindle": {"kind": "shaft", "centre_holes": {"diameter": 3.15}, "steps": [
        {"diameter": 20, "length": 25, "chamfer": 1, "fillet": 0.5,
         "grooves": [{"at": 20, "width": 1.3, "diameter": 19}]},
        {"diameter": 30, "length": 40, "chamfer": 1.6, "fillet": 1, "keyways": [{"at": 5, "length": 28}]},
        {"diameter": 38, "length": 8},
        {"diameter": 28, "length": 30, "fillet": 1, "chamfer": 1}]},
    # as high as they are: walls of no length
    "fillets": {"kind": "shaft", "steps": [
        {"diameter": 30, "length": 60, "fillet": 5, "grooves": [{"at": 45, "width": 3, "diameter": 28, "fillet": 1}]},
        {"diameter": 40, "length": 10}]},
    "flats": {"kind": "shaft", "steps": [
        {"diameter": 10, "length": 20, "chamfer": 1, "flats": {"shape": "D", "flat": 9, "length": 12}},
        {"diameter": 16, "length": 8},
        {"diameter": 12, "length": 18, "chamfer": 2,
         "flats": {"shape": "double_D", "across_flats": 9, "length": 10, "end": "upper", "angle_deg": 0}}]},
    "tube": {"kind": "shaft", "bore_diameter": 6.0, "steps": [
        {"diameter": 10.0, "length": 20.0, "chamfer": 1.0}, {"diameter": 16.0, "length": 20.0, "chamfer": 1.0}]},
}  # fmt: skip


def corners_of(part: dict[str, Any]) -> list[Corner]:
    """Those of its keys, of a shaft from outside; those on one line left out."""
    if part["kind"] == "turned":
        found = [{key: float(value or 0) for key, value in row.items()} for row in part["points"]]
    else:
        found = [*_shaft(part["steps"], part.get("bore_diameter") or 0.0)]
    return [c for k, c in enumerate(found) if not _straight(found[k - 1], c, found[(k + 1) % len(found)])]


def _straight(a: Corner, b: Corner, c: Corner) -> bool:
    on_line = abs((b["r"] - a["r"]) * (c["z"] - b["z"]) - (b["z"] - a["z"]) * (c["r"] - b["r"])) < 1e-9
    return on_line and not a.get("arc") and not b.get("arc") and len({(p["r"], p["z"]) for p in (a, b, c)}) == 3


def _shaft(steps: list[dict[str, Any]], bore: float) -> Iterator[Corner]:
    yield {"r": bore / 2, "z": 0.0}
    z = 0.0
    for k, step in enumerate(steps):
        before = steps[k - 1]["diameter"] if k else 0.0
        after = steps[k + 1]["diameter"] if k + 1 < len(steps) else 0.0
        own, cut = step["diameter"] / 2, step.get("chamfer", 0.0)
        fillet = step.get("fillet", 0.0)
        yield {"r": own, "z": z, **({"chamfer": cut} if own > before / 2 else {"fillet": fillet})}
        for groove in step.get("grooves", []):
            low, high = z + groove["at"], z + groove["at"] + groove["width"]
            floor, rounded = groove["diameter"] / 2, groove.get("fillet", 0.0)
            yield from ({"r": r, "z": at, "fillet": fillet} for r, at, fillet in (
                (own, low, 0.0), (floor, low, rounded), (floor, high, rounded), (own, high, 0.0)))  # fmt: skip
        z += step["length"]
        yield {"r": own, "z": z, **({"chamfer": cut} if own > after / 2 else {"fillet": fillet})}
    yield {"r": bore / 2, "z": z}


@cache
def power_module() -> dict[str, dict[str, Any]]:
    """Its turned parts, those of one form once."""
    forms = {}
    for name, part in load_scene("power_module").parts.items():
        keys = {key: value for key, value in msgspec.to_builtins(part).items() if value is not None}
        if keys["kind"] == "turned":
            forms[str(keys["points"])] = name, {key: keys[key] for key in ("kind", "points", "holes") if key in keys}
    return dict(forms.values())


def drawn(folder: Path, part: dict[str, Any], **export: Any) -> Drawing:
    (job,) = jobs(part, formats=("dxf",), **export)
    job.write({}, folder / job.path)
    return ezdxf.readfile(folder / job.path)


def faults(document: Drawing, part: dict[str, Any]) -> list[str]:
    holes, z, places = part.get("holes") or [], 0.0, []
    circles = [group["pitch_circle_diameter"] for group in (holes if isinstance(holes, list) else [holes])]
    for step in part.get("steps", []):
        for way in step.get("keyways", []):
            places += [z + way["at"], z + way["at"] + way["length"]]
        if flats := step.get("flats"):
            places.append(z + (flats["length"] if flats.get("end") != "upper" else step["length"] - flats["length"]))
        z += step["length"]
    return Told(document, corners_of(part)).faults(circles, places)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", PARTS)
def test_turned_parts_can_be_made_again_from_their_dimensions(tmp_path: Path, name: str) -> None:
    assert faults(drawn(tmp_path, PARTS[name]), PARTS[name]) == []


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    "name", ["guide_6", "body_plate", "crank_pin", "ball", "guide_5", "bearing_ring", "spacer_22", "disk_3",
             "ring_guide", "free_ring", "platform_plate", "platform_axle", "end_cover", "snap_ring", "screw_49"]
)  # fmt: skip
def test_positions_of_the_power_module_can_be_made_again(tmp_path: Path, name: str) -> None:
    part = power_module()[name]
    assert faults(drawn(tmp_path, part), part) == []


def test_each_dimension_that_is_left_out_is_missed_and_one_too_many_is_seen(tmp_path: Path) -> None:
    part = PARTS["recesses"]
    document = drawn(tmp_path, part)
    space = document.modelspace()
    told = list(space.query("DIMENSION"))
    assert len(told) == 13
    for one in told:
        space.unlink_entity(one)
        assert faults(document, part), one.dxf.text
        space.add_entity(one)
    assert faults(document, part) == []
    first, last = (next(d for d in told if d.dxf.actual_measurement == value) for value in (12, 35))
    twice = first.copy()
    twice.dxf.defpoint2, twice.dxf.defpoint3 = first.dxf.defpoint3, last.dxf.defpoint3
    space.add_entity(twice)
    assert any("twice" in fault for fault in faults(document, part))


def test_a_dimension_that_shows_nothing_is_refused(tmp_path: Path) -> None:
    (job,) = jobs(PARTS["recesses"], formats=("dxf",))
    file = tmp_path / job.path
    job.write({}, file)
    assert job.verify(file, 0.0).failures == ()
    text = file.read_text(encoding="utf-8")
    name = re.search(r"AcDbDimension\n.*?\n  2\n(\*D\d+)\n", text, re.DOTALL)
    assert name is not None
    file.write_text(text[: name.start(1)] + "*D999" + text[name.end(1) :], encoding="utf-8")
    assert job.verify(file, 0.0).failures


def many(count: int) -> list[tuple[float, ...]]:
    """Corners of a bobbin, each 1 mm on, the last but one the beginning of an arc."""
    rows = [(20 + 0.5 * (k * k % 13), float(k)) for k in range(count - 1)]
    return [(5, 0), *rows[:-1], (*rows[-1], -30.0), (18, count + 5.0), (5, count + 5.0)]


def test_more_corners_than_sizes_can_tell_stand_in_a_table(tmp_path: Path) -> None:
    corners = many(24)
    document = drawn(tmp_path, ring(*corners))
    assert len(document.modelspace().query("DIMENSION")) == 0
    cells = [(round(-t.dxf.insert.y, 3), t.dxf.insert.x, t.dxf.text) for t in document.modelspace().query("TEXT")]
    rows: dict[float, list[str]] = {}
    for y, _, text in sorted(cells):
        rows.setdefault(y, []).append(text)
    # two tables side by side
    told = {tuple(row[k : k + 4]) for row in rows.values() for k in range(0, len(row), 4)}
    arcs = [f"{row[2] if len(row) > 2 else 0.0:.3f}".replace("-", "\N{MINUS SIGN}") for row in corners]
    assert told >= {
        (f"{k}", f"{row[1]:.3f}", f"{2 * row[0]:.3f}", arc)
        for k, (row, arc) in enumerate(zip(corners, arcs, strict=True), 1)
    }


def test_more_corners_than_paper_has_room_for_are_refused_by_their_key() -> None:
    with pytest.raises(SceneError) as caught:
        jobs(ring(*many(450)), formats=("dxf",))
    assert (caught.value.key, caught.value.value) == ("parts.p.points", 452)


def test_circles_of_holes_that_stand_off_each_other_tell_their_directions(tmp_path: Path) -> None:
    circles = [{"count": 21, "diameter": 4, "pitch_circle_diameter": 100},
               {"count": 5, "diameter": 5, "pitch_circle_diameter": 70, "start_deg": 10},
               {"count": 1, "diameter": 6, "pitch_circle_diameter": 40, "start_deg": 25}]  # fmt: skip
    plate = ring((10, 0), (60, 0), (60, 10), (10, 10))

    def told(holes: list[dict[str, Any]]) -> list[tuple[str, ...]]:
        texts = " ".join(t.dxf.text for t in drawn(tmp_path, plate | {"holes": holes}).modelspace().query("TEXT"))
        return sorted(
            re.findall(r"Holes? Ø(\d+): (?:the first )?at (\d+)° from the first one on the circle Ø(\d+)", texts)
        )

    assert told(circles) == [("5", "10", "100"), ("6", "25", "100")]
    assert told([circles[0], circles[1] | {"start_deg": 72.0}]) == told(circles[:1]) == []


def test_spokes_tell_their_direction_from_a_turned_keyway(tmp_path: Path) -> None:
    gear = {"kind": "spur_gear", "module": 3.0, "number_of_teeth": 48, "face_width": 10.0,
            "bore": {"shape": "keyway", "diameter": 20.0, "angle_deg": 30.0},
            "spokes": {"count": 5, "inner_diameter": 36.0, "outer_diameter": 120.0, "width": 10.0, "start_deg": 50.0},
            }  # fmt: skip
    words = " ".join(t.dxf.text for t in drawn(tmp_path, gear).modelspace().query("TEXT"))
    assert "Spokes: the first at 20° from" in words


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "part",
    [
        ring((10, 0), (60, 0), (60, 10), (10, 10)),
        {"kind": "spur_gear", "module": 3.0, "number_of_teeth": 48, "face_width": 10.0, "bore_diameter": 20.0},
        {"kind": "ring_gear", "module": 1.0, "number_of_teeth": 60, "face_width": 10.0, "outer_diameter": 130.0},
    ],
)
def test_equal_holes_on_circles_of_their_own_are_told_once_by_their_places(
    tmp_path: Path, part: dict[str, Any]
) -> None:
    """As it was: four equal holes beside an opening were four diameters, four circles and four lines of words."""
    places = [(38.0, 20.0), (38.0, -20.0), (50.0, 20.0), (50.0, -20.0)]
    holes = [{"count": 1, "diameter": 8, "pitch_circle_diameter": 2 * math.hypot(x, y),
              "start_deg": math.degrees(math.atan2(y, x))} for x, y in places]  # fmt: skip
    document = drawn(tmp_path, part | {"holes": holes})
    assert diameters(document).count("4 holes Ø8") == 1
    assert not any(text == "Ø8" for text in diameters(document))
    told = [round(d.get_measurement(), 6) for d in document.modelspace().query("DIMENSION")]
    assert [told.count(value) for value in (38.0, 50.0, 40.0)] == [1, 1, 1]
    assert not any("Hole" in text.dxf.text for text in document.modelspace().query("TEXT"))


def diameters(document: Drawing) -> list[str]:
    """Words of all diameters, their zones with them."""
    found = (
        d.dxf.text.replace("<>", f"{d.dxf.actual_measurement:g}") for d in document.modelspace().query("DIMENSION")
    )
    return sorted(text.replace("%%c", "Ø") for text in found if "%%c" in text)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("journal", [(30, 25, 20), (25, 30, 20)])
def test_a_groove_as_wide_as_a_step_takes_no_zone_from_it_and_gives_none(
    tmp_path: Path, journal: tuple[int, ...]
) -> None:
    steps: list[dict[str, Any]] = [{"diameter": d, "length": 20} for d in journal]
    steps[journal.index(30)]["grooves"] = [{"at": 4, "width": 2, "diameter": 25}]
    told = diameters(drawn(tmp_path, {"kind": "shaft", "steps": steps}, drawing={"shaft": "k6"}))
    assert told == ["Ø20k6", "Ø25", "Ø25k6", "Ø30k6"]


def test_a_groove_whose_fillets_leave_nothing_of_its_walls_is_told_from_wall_to_wall(tmp_path: Path) -> None:
    told = {d.get_measurement() for d in drawn(tmp_path, PARTS["fillets"]).modelspace().query("DIMENSION")}
    assert {round(value, 6) for value in told} >= {3.0, 45.0, 60.0, 70.0}
    assert not any(abs(value - end) < 1e-6 for value in told for end in (47.0, 55.0))


def test_zones_of_holes_stand_at_what_has_material_about_it_alone(tmp_path: Path) -> None:
    groove = ring((6, 0), (15, 0), (15, 3), (18, 3), (18, 0), (45, 0), (45, 6), (6, 6))
    boss = ring((6, 0), (12, 0), (12, 6), (30, 6), (30, 0), (40, 0), (40, 10), (6, 10))
    for part, told in ((groove, ["Ø12H7", "Ø30", "Ø36H7", "Ø90h11"]), (boss, ["Ø12H7", "Ø24", "Ø60H7", "Ø80h11"])):
        assert diameters(drawn(tmp_path, part)) == told
        # the other way round it is the same part
        assert diameters(drawn(tmp_path, part | {"points": part["points"][::-1]})) == told


def test_standard_keyways_have_the_deviations_of_their_depths_and_others_none(tmp_path: Path) -> None:
    """Depths +0.1 up to a shaft of 22, +0.2 up to 130 (GB/T 1563-1979); d - t1 has that of t1 with a minus."""
    ways: list[dict[str, Any]] = [{"at": 5.0, "length": 20.0}]
    for diameter, deviation, height in some_of(((20.0, "0.1", 16.5), (30.0, "0.2", 26.0))):
        shaft = {"kind": "shaft", "steps": [{"diameter": diameter, "length": 40.0, "keyways": ways}]}
        assert f"{height:g} -{deviation}" in words_of(drawn(tmp_path, shaft))
        assert not any(" -0." in text for text in words_of(drawn(tmp_path, shaft | {"steps": [
            {"diameter": diameter, "length": 40.0, "keyways": [ways[0] | {"depth": 3.1}]}]})))  # fmt: skip
    wheel = {"kind": "spur_gear", "module": 3.0, "number_of_teeth": 40, "face_width": 10.0}
    told = words_of(drawn(tmp_path, wheel | {"bore": {"shape": "keyway", "diameter": 40.0}}))
    assert any(text.endswith("43.3 +0.2") for text in told)


def words_of(document: Drawing) -> list[str]:
    """Words of all dimensions with their numbers."""
    return [d.dxf.text.replace("<>", f"{d.dxf.actual_measurement:g}") for d in document.modelspace().query("DIMENSION")]


def test_each_step_of_a_shaft_has_its_sign_of_roughness_where_one_is_wished(tmp_path: Path) -> None:
    steps = [{"diameter": d, "length": 30.0} for d in (20.0, 28.0, 24.0)]
    for wishes, count in (({}, 0), ({"shaft_roughness": 0.4}, 3)):
        texts = drawn(tmp_path, {"kind": "shaft", "steps": steps}, drawing=wishes).modelspace().query("TEXT")
        assert sum(text.dxf.text == "Ra 0.4" for text in texts) == count


def test_a_thread_has_no_sign_of_the_seats(tmp_path: Path) -> None:
    """Of two steps of one diameter the plain one has it, though the thread is longer."""
    steps = [{"diameter": 20.0, "length": 40.0, "thread": "M20"}, {"diameter": 28.0, "length": 30.0}]
    for more, count in (([], 1), ([{"diameter": 20.0, "length": 30.0}], 2)):
        shaft = {"kind": "shaft", "steps": [*steps, *more]}
        texts = drawn(tmp_path, shaft, drawing={"shaft_roughness": 0.4}).modelspace().query("TEXT")
        assert sum(text.dxf.text == "Ra 0.4" for text in texts) == count


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("part", "count"),
    [
        (ring((8, 0), (25, 0), (25, 40), (12, 40), (12, 22), (8, 22)), 2),
        (ring((8, 0, 0, 1), (25, 0), (25, 40), (14, 40), (12, 38), (12, 22), (8, 22)), 2),
        # a bore with a groove in it, one with a recess about a boss, a blind one
        (ring((8, 0), (30, 0), (30, 20), (8, 20), (8, 14), (10, 14), (10, 11), (8, 11)), 1),
        (ring((6, 0), (12, 0), (12, 6), (30, 6), (30, 0), (40, 0), (40, 10), (6, 10)), 1),
        (ring((0, 0), (20, 0), (20, 30), (6, 30), (6, 12), (0, 10)), 1),
        # centre holes are no bores
        ({"kind": "shaft", "centre_holes": {"diameter": 2.0}, "steps": [{"diameter": 20.0, "length": 30.0}]}, 0),
    ],
)
def test_each_bore_has_its_sign_of_roughness(tmp_path: Path, part: dict[str, Any], count: int) -> None:
    document = drawn(tmp_path, part, drawing={"bore_roughness": 0.8})
    assert [t.dxf.text for t in document.modelspace().query("TEXT")].count("Ra 0.8") == count
