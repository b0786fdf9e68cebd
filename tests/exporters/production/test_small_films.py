"""Films of a few plates: what they show by formula, and every fault told by its own words."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.production.build import build
from exporters.production.film import Film
from exporters.production.jobs import Written
from exporters.production.plan import Plan, plan_build
from parts.scene.load import load_scene, resolved, scene_from_resolved, scene_from_toml
from tests.exporters.production.test_motion_solids import moved, opened, shrunk

PLATE = '[parts.{}]\nkind = "plate"\nwidth = {}\nheight = {}\nface_width = 3.0\n'
# an arm turns about the origin and carries a tip 12 mm out, by its corner: no turn but a whole one looks alike
SCENE = (
    PLATE.format("base", 30.0, 20.0) + PLATE.format("arm", 10.0, 4.0) + PLATE.format("tip", 6.0, 3.0)
    + "holes = [{ at = [1.5, 0.0], diameter = 1.0 }]\n"
    "[instances]\nbase = { part = 'base', at = [-40, 5, 0] }\narm = { part = 'arm', at = [0, 0, 4] }\n"
    "tip = { part = 'tip' }\nother = { part = 'tip', at = [-40, 5, 4] }\n"
    '[[mates]]\nkind = "fixed"\nfirst = "arm"\nsecond = "tip"\noffset = [12.0, 0.0, 3.0]\n'
    '[[drives]]\ninstance = "arm"\nturns = {turns}\n[[exports]]\nformat = "{form}"\n'
)  # fmt: skip


def planned(form: str, turns: float = 1.5) -> Plan:
    text = SCENE.replace("{turns}", str(turns)).replace("{form}", form)
    return plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s", [], [])


@cache
def made(form: str) -> tuple[Written, bytes]:
    """A film and its bytes."""
    import tempfile

    with tempfile.TemporaryDirectory() as place:
        (written,) = build(planned(form), Path(place)).written
        assert written.failures == ()
        return written, (Path(place) / written.job.path).read_bytes()


@pytest.mark.parametrize("form", ["motion", "glb"])
@pytest.mark.parametrize(("turns", "loop", "shown", "seconds"), [
    (1.5, Fraction(2, 3), 1.0, 4.0), (-3.0, Fraction(1, 3), -1.0, 4.0), (0.25, Fraction(4), 1.0, 4.0),
])  # fmt: skip
def test_a_film_shows_one_turn_in_four_seconds(
    form: str, turns: float, loop: Fraction, shown: float, seconds: float
) -> None:
    """The tip looks alike after a whole turn only, however far the drive goes."""
    (film,) = planned(form, turns).sheets
    assert isinstance(film, Film)
    assert (film.loop, film.closes, film.turns, film.seconds) == (loop, True, pytest.approx(shown), seconds)
    assert film.told == {
        "part": None, "instances": ["base", "arm", "tip", "other"], "drive": film.turns, "closes": True, "seconds": 4.0
    }  # fmt: skip
    assert film.path == {"motion": "s.motion.svg", "glb": "s.glb"}[form]
    tip = next(i for i in film.instances if i.id == "tip")
    places, angles = film.poses(tip, np.array([0.0, 0.25, 0.5, 0.75]))
    way = np.exp(1j * math.copysign(math.tau, turns) * np.array([0, 0.25, 0.5, 0.75]))
    assert places == pytest.approx(12 * way, abs=1e-9)
    assert angles == pytest.approx(np.unwrap(np.angle(way)), abs=1e-9)
    other = next(i for i in film.instances if i.id == "other")
    places, angles = film.poses(other, np.array([0.0, 0.7]))
    assert list(places) == [-40 + 5j] * 2
    assert not angles.any()


def test_a_slide_that_goes_there_only_is_shown_once() -> None:
    """A wedge cam does not come back by itself: all of its run, in mm, and no loop that closes."""
    kept = resolved(load_scene("wedge_cam"))
    drive = {"instance": "wedge", "travel": 7.0}
    scene = scene_from_resolved(kept | {"drives": [drive], "exports": [{"format": "motion"}]}, "w")
    (film,) = plan_build(scene, "w", [], []).sheets
    assert isinstance(film, Film)
    assert (film.loop, film.closes, film.turns, film.seconds) == (1, False, 7.0, 28.0)


def test_of_a_slide_no_more_is_shown_than_can_be_followed() -> None:
    """The first hundred turns of the pinion, whichever the drive."""
    kept = resolved(load_scene("rack_and_pinion"))
    for turns, shown in ((99.5, 99.5), (-400.0, -100.0)):
        drive = {"instance": "pinion", "turns": turns}
        scene = scene_from_resolved(kept | {"drives": [drive], "exports": [{"format": "motion"}]}, "r")
        (film,) = plan_build(scene, "r", [], []).sheets
        assert isinstance(film, Film)
        assert (film.closes, film.turns, film.seconds) == (False, pytest.approx(shown), 60.0)


def test_the_page_holds_all_that_moves_and_no_more() -> None:
    """About each place a circle of what is drawn there and 3 hundredths: the base to the left, the tip all round."""
    text = made("motion")[1].decode()
    left, top, width, height = map(float, re.findall(r'viewBox="([^"]+)"', text)[0].split())
    base, tip = 1.03 * math.hypot(15, 10), 1.03 * math.hypot(3, 1.5)
    edges = -40 - base, -max(12 + tip, 5 + base), 12 + tip, max(12 + tip, base - 5)
    assert (left, top, left + width, top + height) == pytest.approx(edges, abs=1e-3)
    assert f'width="{width:g}mm"' in text or f'width="{width}mm"' in text
    drawn = re.findall(r'<g id="(\w+)"', text)
    # the lowest first
    assert drawn == ["base", "arm", "other", "tip"]


def failures(form: str, data: bytes, folder: Path) -> tuple[str, ...]:
    written, _ = made(form)
    file = folder / written.job.path
    file.write_bytes(data)
    return written.job.verify(file, written.max_error).failures


NUMBER = r"[-\d.]+"
SVG_SPOILED = {
    "first value": (rf'values="{NUMBER}', 'values="1.5', "its motion starts at"),
    "one place": (rf'(type="translate".*?values="(?:{NUMBER},{NUMBER};){{7}}){NUMBER}', r"\g<1>1.5", "off its place"),
    "once": ('repeatCount="indefinite"', 'repeatCount="1"', "that goes on for ever"),
    "name": ('<g id="other"', '<g id="another"', "holds base, arm, another, tip"),
    "a value less": (rf"(;{NUMBER},{NUMBER}){{3}}", "", "off its place"),
    "place": (rf'id="other" transform="translate\({NUMBER}', 'id="other" transform="translate(-40.1', "0.1 mm off"),
    "turn": (rf'(id="other".*?\n<g transform="rotate\(){NUMBER}', r"\g<1>1.5", "off its place"),
    "scale": (r'transform="rotate\(', 'transform="scale(1)rotate(', "a group is placed by scale"),
    "style": ("<title>", "<style>path{display:none}</style><title>", "holds <style>"),
    "corner": (rf"L{NUMBER},", "L1,", "base: "),
    "two times": ('dur="4s"', 'dur="8s"', "take unlike times for their loop"),
    "a hole": (r'(id="other"(?:.|\n)*? d="M[^"]*?Z) ?M[^"]*?Z', r"\1", "tip: its instances differ"),
}


@pytest.mark.parametrize("name", SVG_SPOILED)
def test_each_fault_of_an_animated_svg_is_told(name: str, tmp_path: Path) -> None:
    old, new, said = SVG_SPOILED[name]
    text = made("motion")[1].decode()
    spoiled = re.sub(old, new, text, count=1, flags=re.DOTALL if "\\n" in old or "hole" in name else 0)
    assert spoiled != text
    assert any(re.search(said, one) for one in failures("motion", spoiled.encode(), tmp_path)), name


def test_a_loop_is_as_long_as_it_says_to_a_millionth(tmp_path: Path) -> None:
    text = made("motion")[1].decode()
    assert failures("motion", text.replace('dur="4s"', 'dur="4.000002s"').encode(), tmp_path) == ()
    late = failures("motion", text.replace('dur="4s"', 'dur="4.00001s"').encode(), tmp_path)
    assert late == ("a loop takes 4.00001 s instead of 4 s",)
    assert failures("motion", text.encode(), tmp_path) == ()


def slower(scene: dict[str, Any], blob: bytearray) -> None:
    """All times half as long again."""
    for accessor in {sampler["input"] for sampler in scene["animations"][0]["samplers"]}:
        told = scene["accessors"][accessor]
        view = scene["bufferViews"][told["bufferView"]]
        part = slice(view["byteOffset"], view["byteOffset"] + view["byteLength"])
        times = np.frombuffer(blob[part], "<f4") * np.float32(1.5)
        blob[part] = times.tobytes()
        told |= {"min": [float(times.min())], "max": [float(times.max())]}


def turned(scene: dict[str, Any], blob: bytearray) -> None:
    """The second of the arm's turns, a quaternion about z, half a degree on."""
    animation = scene["animations"][0]
    sampler = next(c["sampler"] for c in animation["channels"] if c["target"]["path"] == "rotation")
    told = scene["accessors"][animation["samplers"][sampler]["output"]]
    start = scene["bufferViews"][told["bufferView"]]["byteOffset"] + 16
    x, y, z, w = np.frombuffer(blob[start : start + 16], "<f4").tolist()
    assert x == y == 0.0
    half = math.atan2(z, w) + math.radians(0.25)
    blob[start : start + 16] = np.array([0.0, 0.0, math.sin(half), math.cos(half)], "<f4").tobytes()


Change = Callable[[dict[str, Any], bytearray], object]
GLB_SPOILED: dict[str, tuple[Change, str]] = {
    "a place": (lambda s, b: moved(s, b, "translation", 0.1), "an instance is 0.1 mm off its place"),
    "a turn": (turned, "an instance is 0.0.* mm off its place"),
    "a solid": (shrunk, "base: "),
    "another solid": (lambda s, b: s["nodes"][1].update(mesh=1), "base is shown as arm"),
    "an instance": (lambda s, b: s["nodes"][2].update(name="x"), "holds base, x, tip, other of base, arm, tip"),
    "a mesh": (lambda s, b: s["meshes"][1].update(name="x"), "of base, x, tip"),
    "times": (slower, "a loop takes 6 s instead of 4 s"),
    "height": (lambda s, b: s["nodes"][4].update(translation=[-40.0, 5.0, 4.2]), "0.2 mm off its place"),
    "end": (lambda s, b: s.update(scene=1), "which our files do not"),
}


@pytest.mark.parametrize("name", GLB_SPOILED)
def test_each_fault_of_an_animated_gltf_is_told(name: str, tmp_path: Path) -> None:
    change, said = GLB_SPOILED[name]
    _, data = made("glb")
    (tmp_path / "good.glb").write_bytes(data)
    scene, blob = opened(tmp_path / "good.glb")
    change(scene, blob)
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    words = [n.to_bytes(4, "little") for n in (2, 28 + len(text) + len(blob), len(text), len(blob))]
    spoiled = b"glTF" + words[0] + words[1] + words[2] + b"JSON" + text + words[3] + b"BIN\0" + bytes(blob)
    found = failures("glb", spoiled, tmp_path)
    assert any(re.search(said, one) for one in found), found
    assert failures("glb", data, tmp_path) == ()
