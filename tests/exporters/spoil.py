"""Ways to spoil a good file. Each does one thing, at a place given as a share of the file's length."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
from ezdxf.document import Drawing
from numpy.typing import NDArray

Rows = list[tuple[float, float, float]]
Records = NDArray[np.void]
STEP = 0.01  # twice the tolerance of 0.005 mm
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def moved(rows: Rows, at: int) -> Rows:
    """A vertex moved across the outline by twice the tolerance."""
    (x, y, bulge), before, after = rows[at], rows[at - 1], rows[(at + 1) % len(rows)]
    along = complex(after[0] - before[0], after[1] - before[1])
    across = 1j * along / abs(along) * STEP
    return [*rows[:at], (x + across.real, y + across.imag, bulge), *rows[at + 1 :]]


def flattened_or_bent(rows: Rows, at: int) -> Rows:
    """The longest edge near a place gets another bulge: half as much sagitta again, or some where there was none."""

    def length(i: int) -> float:
        return abs(complex(rows[i][0] - rows[i - 1][0], rows[i][1] - rows[i - 1][1]))

    at = max(range(max(1, at - 12), min(len(rows), at + 12)), key=length)
    x, y, bulge = rows[at - 1]
    # a bulge b lifts the middle of a chord c by b c / 2
    return [*rows[: at - 1], (x, y, bulge + 4 * STEP / length(at)), *rows[at:]]


def dropped(rows: Rows, at: int) -> Rows:
    """A vertex left out: of those near the place the one that bends the outline most."""

    def lift(i: int) -> float:
        a, b, c = (complex(*rows[j % len(rows)][:2]) for j in (i - 1, i, i + 1))
        return abs(((c - a).conjugate() * (b - a)).imag) / abs(c - a)

    at = max(range(max(0, at - 9), min(len(rows), at + 9)), key=lift)
    return [*rows[:at], *rows[at + 1 :]]


def duplicated(rows: Rows, at: int) -> Rows:
    """A vertex twice."""
    return [*rows[:at], (*rows[at][:2], 0.0), *rows[at:]]


def swapped(rows: Rows, at: int) -> Rows:
    """Two neighbours in each other's place."""
    at = min(at, len(rows) - 2)
    return [*rows[:at], rows[at + 1], rows[at], *rows[at + 2 :]]


def tooth_left_out(rows: Rows, at: int) -> Rows:
    """A whole tooth's vertices gone: all that is left stands on the outline."""
    tooth = len(rows) // 23
    at = min(at, len(rows) - tooth)
    return [*rows[:at], *rows[at + tooth :]]


def scaled(rows: Rows, at: int) -> Rows:
    """Everything a thousandth larger."""
    return [(1.001 * x, 1.001 * y, bulge) for x, y, bulge in rows]


def turned(rows: Rows, at: int) -> Rows:
    """Everything turned by a twentieth of a degree."""
    turn = np.exp(1j * np.radians(0.05))
    places = [complex(x, y) * turn for x, y, _ in rows]
    return [(p.real, p.imag, row[2]) for p, row in zip(places, rows, strict=True)]


ROW_CHANGES = [moved, flattened_or_bent, dropped, duplicated, swapped, tooth_left_out]
WHOLE_CHANGES = [scaled, turned]


def change_dxf(file: Path, which: int, change: Callable[[Rows, int], Rows], share: float) -> None:
    """Apply a change to one polyline of a DXF and save it."""
    drawing = ezdxf.readfile(file)
    entity = list(drawing.modelspace())[which]
    if entity.dxftype() == "LWPOLYLINE":
        rows = [tuple(map(float, p)) for p in entity.get_points("xyb")]
        entity.set_points(change(rows, round(share * (len(rows) - 1))), format="xyb")
    else:
        rows = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0.0)) for v in entity.vertices]
        rows = change(rows, round(share * (len(rows) - 1)))
        layer = entity.dxf.layer
        drawing.modelspace().delete_entity(entity)
        drawing.modelspace().add_polyline2d(rows, format="xyb", close=True, dxfattribs={"layer": layer})
    drawing.saveas(file)


def change_svg(file: Path, which: int, change: Callable[[Rows, int], Rows], share: float) -> None:
    """Apply a change to one path of an SVG; its bulges go through radius and flags."""
    tree = ElementTree.parse(file)
    ElementTree.register_namespace("", "http://www.w3.org/2000/svg")
    shape = list(tree.getroot())[which]
    middle = float(tree.getroot().attrib["viewBox"].split()[2]) / 2
    tokens = re.findall(r"[MLA][^MLAZ]*", shape.attrib["d"])
    ends = [complex(*map(float, re.split(r"[ ,]+", t[1:].strip())[-2:])) for t in tokens]
    rows = []
    for here, token, there in zip(ends, tokens[1:], ends[1:], strict=False):
        bulge = 0.0
        if token[0] == "A":
            radius, *_, clockwise = map(float, re.split(r"[ ,]+", token[1:].strip())[:5])
            bulge = np.tan(np.arcsin(min(1.0, abs(there - here) / 2 / radius)) / 2) * (-1 if clockwise else 1)
        rows.append((here.real - middle, middle - here.imag, float(bulge)))
    rows = change(rows, round(share * (len(rows) - 1)))
    parts = []
    for (x, y, _), (_, _, bulge), before in zip([*rows, rows[0]], [(0, 0, 0), *rows], [(0, 0, 0), *rows], strict=True):
        place = f"{middle + x:.9f},{middle - y:.9f}"
        chord = np.hypot(x - before[0], y - before[1])
        radius = chord * (1 + bulge**2) / 4 / abs(bulge) if bulge else 0.0
        parts.append(f"A{radius:.9f},{radius:.9f} 0 0 {int(bulge < 0)} {place}" if bulge and parts else f"L{place}")
    shape.attrib["d"] = "M" + " ".join(parts)[1:] + " Z"
    tree.write(file, encoding="utf-8")


def bore_grown_dxf(file: Path, step: float) -> None:
    """The bore's radius larger by ``step``."""
    change_dxf(file, 0, lambda rows, at: [(x * (4 + step) / 4, y * (4 + step) / 4, b) for x, y, b in rows], 0)


def bore_grown_svg(file: Path, step: float) -> None:
    """The bore's radius larger by ``step``, be it a circle or a path."""
    root = ElementTree.parse(file).getroot()
    if next(iter(root)).tag.endswith("circle"):
        text = file.read_text(encoding="utf-8")
        file.write_text(re.sub(r'\br="([\d.]+)"', lambda m: f'r="{float(m[1]) + step}"', text), encoding="utf-8")
    else:
        change_svg(file, 0, lambda rows, at: [(x * (4 + step) / 4, y * (4 + step) / 4, b) for x, y, b in rows], 0)


def opened(drawing: Drawing) -> None:
    """The outer polyline without its closed flag."""
    list(drawing.modelspace())[-1].close(False)


def with_a_stray_line(drawing: Drawing) -> None:
    """A line across the gear."""
    drawing.modelspace().add_line((0, 0), (5, 5))


def with_a_point(drawing: Drawing) -> None:
    """Something that is no outline, on a cut layer."""
    drawing.modelspace().add_point((1, 1), dxfattribs={"layer": "CUT_OUTER"})


def with_a_second_copy(drawing: Drawing) -> None:
    """The outline twice: a laser would cut twice."""
    space = drawing.modelspace()
    space.add_entity(list(space)[-1].copy())


def without_the_bore(drawing: Drawing) -> None:
    """The inner contour gone."""
    space = drawing.modelspace()
    space.delete_entity(next(iter(space)))


def without_the_outline(drawing: Drawing) -> None:
    """The outer contour gone."""
    space = drawing.modelspace()
    space.delete_entity(list(space)[-1])


def on_one_layer(drawing: Drawing) -> None:
    """Bore and outline on one layer: the part falls before its bore is cut."""
    for entity in drawing.modelspace():
        entity.dxf.layer = "CUT_OUTER"


DXF_CHANGES = [
    opened,
    with_a_stray_line,
    with_a_point,
    with_a_second_copy,
    without_the_bore,
    without_the_outline,
    on_one_layer,
]


def in_inches(text: str) -> str:
    """Width and height in another unit."""
    return re.sub(r'(width|height)="([\d.]+)mm"', r'\1="\2in"', text)


def without_unit(text: str) -> str:
    """Width and height in pixels."""
    return re.sub(r'(width|height)="([\d.]+)mm"', r'\1="\2"', text)


def larger_page(text: str) -> str:
    """One unit no longer one mm."""
    return re.sub(r'(width|height)="([\d.]+)mm"', lambda m: f'{m[1]}="{1.001 * float(m[2])}mm"', text)


def lower_page(text: str) -> str:
    """Only the height halved: viewers keep the proportions and shrink the drawing."""
    return re.sub(r'height="([\d.]+)mm"', lambda m: f'height="{float(m[1]) / 2}mm"', text)


def not_closed(text: str) -> str:
    """A path without its Z."""
    head, tail = text.rsplit(" Z", 1)
    return head + tail


def with_a_transform(text: str) -> str:
    """The outline scaled by an attribute."""
    return text.replace('id="cut_outer"', 'id="cut_outer" transform="scale(1.001)"')


def with_another_shape(text: str) -> str:
    """A stray line."""
    return text.replace("</svg>", '<line x1="0" y1="0" x2="9" y2="9" style="stroke:#ff0000"/></svg>')


def with_an_oval_arc(text: str) -> str:
    """One arc with two radii."""
    places = list(re.finditer(r"A([\d.]+),[\d.]+ ", text))
    place = max(places, key=lambda m: float(m[1]))
    return text[: place.start()] + f"A{place[1]},{2 * float(place[1])} " + text[place.end() :]


SVG_CHANGES = [
    in_inches,
    without_unit,
    larger_page,
    lower_page,
    not_closed,
    with_a_transform,
    with_another_shape,
    with_an_oval_arc,
]


def change_stl(file: Path, change: Callable[[Records, int, float], Records], share: float, tolerance: float) -> None:
    """Apply a change to the triangles of an STL and write the count anew."""
    data = file.read_bytes()
    records = np.frombuffer(data, dtype=_RECORD, offset=84).copy()
    records = change(records, round(share * (len(records) - 1)), 2 * tolerance)
    file.write_bytes(data[:80] + np.uint32(len(records)).tobytes() + records.tobytes())


def triangle_flipped(records: Records, at: int, step: float) -> Records:
    """One triangle turned inside out."""
    records["corners"][at] = records["corners"][at][::-1].copy()
    return records


def triangle_removed(records: Records, at: int, step: float) -> Records:
    """A hole."""
    return np.delete(records, at)


def triangle_doubled(records: Records, at: int, step: float) -> Records:
    """One triangle twice."""
    return np.insert(records, at, records[at])


def corner_shifted(records: Records, at: int, step: float) -> Records:
    """One corner of one triangle moved away from its neighbours'."""
    records["corners"][at, 1, 0] += np.float32(step)
    return records


def _vertex_moved(records: Records, at: int, move: Any, height: float) -> Records:
    """One vertex of a face moved in every triangle that shares it: the mesh stays closed."""
    corners = records["corners"]
    flat = corners.reshape(-1, 3)
    outer = (flat[:, 2] == height) & (np.hypot(flat[:, 0], flat[:, 1]) > 15)
    chosen = flat[np.flatnonzero(outer)[int(at / len(records) * (np.count_nonzero(outer) - 1))]].copy()
    corners[np.all(corners == chosen, axis=2)] = chosen + np.asarray(move(chosen), dtype=np.float32)
    return records


def _inwards(step: float) -> Callable[[Any], Any]:
    # flanks stand steeply: a move of 10 steps towards the axis is some 3 across a flank
    return lambda p: np.array([*(-10 * step * p[:2] / np.hypot(*p[:2])), 0.0])


def lower_vertex_moved(records: Records, at: int, step: float) -> Records:
    """A vertex of the lower face off the outline, in all its triangles."""
    return _vertex_moved(records, at, _inwards(step), 0.0)


def upper_vertex_moved(records: Records, at: int, step: float) -> Records:
    """A vertex of the upper face off the outline, in all its triangles."""
    return _vertex_moved(records, at, _inwards(step), float(records["corners"][:, :, 2].max()))


def upper_vertex_lowered(records: Records, at: int, step: float) -> Records:
    """A vertex of the upper face below it, in all its triangles."""
    return _vertex_moved(records, at, lambda p: [0, 0, -step], float(records["corners"][:, :, 2].max()))


def upper_face_turned(records: Records, at: int, step: float) -> Records:
    """A helical gear instead of a spur gear: the upper face turned, the mesh closed, the volume near the same."""
    upper = records["corners"][:, :, 2] > 0
    places = records["corners"][upper]
    turned_by = (places[:, 0] + 1j * places[:, 1]) * np.exp(1j * 20 * step / 25)
    places[:, 0], places[:, 1] = turned_by.real, turned_by.imag
    records["corners"][upper] = places
    return records


def stretched(records: Records, at: int, step: float) -> Records:
    """A thousandth larger along one axis."""
    records["corners"][:, :, 0] *= np.float32(1.001)
    return records


def thicker(records: Records, at: int, step: float) -> Records:
    """A thousandth thicker."""
    records["corners"][:, :, 2] *= np.float32(1.001)
    return records


def in_metres(records: Records, at: int, step: float) -> Records:
    """Another unit."""
    records["corners"] /= np.float32(1000)
    return records


def inside_out(records: Records, at: int, step: float) -> Records:
    """Every triangle turned."""
    records["corners"] = records["corners"][:, ::-1].copy()
    return records


def not_a_number(records: Records, at: int, step: float) -> Records:
    """A coordinate that is not a number."""
    records["corners"][at, 0, 0] = np.nan
    return records


def normal_turned(records: Records, at: int, step: float) -> Records:
    """A normal that points into the material."""
    records["normal"][at] *= -1
    return records


STL_CHANGES = [
    triangle_flipped,
    triangle_removed,
    triangle_doubled,
    corner_shifted,
    lower_vertex_moved,
    upper_vertex_moved,
    upper_vertex_lowered,
    upper_face_turned,
    stretched,
    thicker,
    in_metres,
    inside_out,
    not_a_number,
    normal_turned,
]


def in_model(change: Callable[[str], str]) -> Callable[[Path], None]:
    """A spoiler of the XML in a 3MF."""

    def spoil(file: Path) -> None:
        with zipfile.ZipFile(file) as package:
            content = {n: package.read(n) for n in package.namelist()}
        changed = change(content["3D/3dmodel.model"].decode()).encode()
        assert changed != content["3D/3dmodel.model"]
        with zipfile.ZipFile(file, "w") as package:
            for name, data in (content | {"3D/3dmodel.model": changed}).items():
                package.writestr(name, data)

    return spoil
