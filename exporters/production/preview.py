"""Pictures for people: every part with its circles, and the scene with all its instances in their places."""

from __future__ import annotations

import cmath
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from textwrap import wrap
from typing import Any, TypeAlias

import numpy as np

from exporters.formats.svg import GROUND, fills, number, page_head, path_data, save, stroke_data, text_line
from exporters.production.flat_pins import solid_pins
from exporters.production.plan import Plan
from geometry.approximation.chords import approximate_profile
from geometry.base.errors import GeometryError
from geometry.base.tolerance import DRAWN_DECIMALS
from geometry.curves.curve import Complex
from geometry.plane.contour import Approximation, Contour
from geometry.plane.profile import Profile, Region
from parts.base.part import Part
from parts.base.texts import Words, words
from parts.drawing.names import caption_name
from parts.scene.scene_file import SceneFile
from parts.scene.standing import UPWARDS, Instance
from parts.texts.checks import in_rows
from parts.texts.findings import finding_text
from parts.texts.quantities import QUANTITIES, quantity_name

# letters of a line of the caption that fit beside a part, and above a scene
_CAPTION_LETTERS, _WIDE_LETTERS = 42, 95
# of a scene's checks, half of that of what its picture covers: it is to remain a picture
_MOST_LETTERS = 500
# room about a part, of half of its longer side; width of a letter, of its size
_ROOM, _LETTER = 0.08, 0.62
# last word of what a number is called, with its unit; what has a unit; what is not broken in captions
_NO_BREAK = "\u00a0"
_LAST_WORD, _UNIT = re.compile(r"(?:\d )?\S+(?:, [^,]{1,12})?$"), re.compile(", (?:mm|deg|modules)")
_EQUATION = re.compile(r" (?==)|(?<==) |(?<=\d) (?=[^\W\d_]{2,4}\b)")
# of pins of one piece, which stand out of their plate
_PIN_STYLE = "fill:#7f8c99;stroke:#202830"
# outlines of more curves than this are drawn by so many points of each: arcs take seconds to fit
_MOST_ARCS, _POINTS = 300, 8
# points of an edge by which its place is seen
PER_EDGE = 8
# points about a roller of a chain
_ROUND = np.exp(1j * np.linspace(0, 2 * np.pi, 16, endpoint=False))
# what chords may leave of what lies, part of its reach
_NEAR = 2e-3
# of more alike than this one is named for all, by its name without its number
_MANY, _LAST_NUMBER = 6, re.compile(r"[ _]\d+$")
# the boundaries of a part, the outer one last
Outlines: TypeAlias = tuple[Approximation, ...]


def part_preview(part: Part, boundaries: Outlines, folder: Path, language: str) -> Path:
    """The filled part in the middle, its circles with their diameters, and what was noticed."""
    remarks = [finding_text(language, f) for f in part.findings]
    outer = boundaries[-1].geometry.sampled(PER_EDGE)
    wheel = max(part.circles.values(), default=0.0) / 2
    ends = np.concatenate([outer, wheel * np.array([1 + 1j, -1 - 1j])]) if wheel else outer
    left, right = float(ends.real.min()), float(ends.real.max())
    low, high = float(ends.imag.min()), float(ends.imag.max())
    reach = max(right - left, high - low) / 2
    room = _ROOM * reach
    # what is turned is known by its axial section, which lies below the view along its axis
    half = part.made_by.axial_section(part.thing, reach / 1000)
    across, length = (0.0, 0.0) if half is None else (2 * float(half.real.max()), float(np.ptp(half.imag)))
    text = max(reach / 22, length / 70)
    told = words(language)
    rows = [caption_name(part), *(_number(told, *row) for row in (part.circles | part.quantities).items()), *remarks]
    caption = [line for row in rows for line in wrap(_unbroken(told.decimal(row)), _CAPTION_LETTERS)]
    beside = right - left + 2 * room
    wide = max(beside + (2 + _LETTER * max(map(len, caption))) * text, length + 2 * room)
    deep = max(high - low + 2 * room, text * 1.7 * (len(caption) + 1))
    # alone it stands in the middle of the height of what is written beside it
    corner = complex(room - left, room + high + (deep - high + low - 2 * room) / 2 * (half is None))
    lines = [page_head(wide, deep + (across + room if across else 0.0), whole=True), GROUND]
    cut, plain = part.cut(0.0).region, part.section(0.0).region
    tags = [approximate_profile(p, reach / 1000, arcs=True) for p in cut.apart[len(plain.apart) :]]
    data = " ".join(path_data(b.geometry, corner) for b in reversed((*tags, *boundaries)))
    shade = fills({part.id: part})[part.id]
    lines.append(
        f'<path d="{data}" style="fill:{shade};fill-rule:evenodd;stroke:#202830;stroke-width:{reach / 400:.4g}"/>'
    )
    if cut.strokes:
        name = " ".join(stroke_data(np.round(np.array(stroke), 3), corner) for stroke in cut.strokes)
        lines.append(f'<path d="{name}" style="fill:none;stroke:#0000ff;stroke-width:0.25;stroke-linecap:round"/>')
    pins = " ".join(path_data(c, corner) for c in solid_pins(part, [b.geometry for b in boundaries]))
    if pins:
        lines.append(f'<path d="{pins}" style="{_PIN_STYLE};stroke-width:{reach / 400:.4g}"/>')
    dash = f"{reach / 25:.4g} {reach / 90:.4g} {reach / 150:.4g} {reach / 90:.4g}"
    for name, diameter in part.circles.items():
        colour = _CIRCLE_COLOURS.get(name, "#404850")
        line = f"fill:none;stroke:{colour};stroke-width:{reach / 300:.4g};stroke-dasharray:{dash}"
        place = f'cx="{number(corner.real)}" cy="{number(corner.imag)}"'
        lines.append(f'<circle {place} r="{number(diameter / 2)}" style="{line}"/>')
    lines += _cross(corner, complex(left, low), complex(right, high))
    if half is not None:
        lines += _axial(half, complex(room, deep + across / 2), shade, reach)
    lines += _caption(caption, beside + text / 2, text)
    file = folder / f"{part.id}.preview.svg"
    save(file, lines)
    return file


def _number(told: Words, name: str, value: float) -> str:
    """A circle or quantity in words, its sign, unit and value on one line; what is counted without decimals."""
    row, counted = quantity_name(told, name), value == int(value) and not _UNIT.search(QUANTITIES.get(name, ""))
    last = _LAST_WORD.search(row)
    at = last.start() if last else 0
    return row[:at] + f"{row[at:]}  {value:.{0 if counted or isinstance(value, int) else 4}f}".replace(" ", _NO_BREAK)


def _unbroken(row: str) -> str:
    """A row of a caption in which equations and values with their units stay on one line."""
    return _EQUATION.sub(_NO_BREAK, row)


def scene_preview(plan: Plan, outlines: Mapping[str, Outlines], checks: dict[str, Any], folder: Path) -> Path:
    """All instances in their places, the upper ones last, and what the checks found."""
    from exporters.production.check_lines import picture_names
    from exporters.production.preview_labels import Label, Tops, spread_labels

    stand = sorted(plan.placing.instances, key=lambda i: i.at[2])
    every = picture_names(plan.scene.instances, plan.parts)
    names = _together(every, stand)
    lying = {i.id: _seen_lying(i, plan.parts[i.part]) for i in stand if not i.is_upright}
    outers = [
        np.concatenate(lying[i.id]) if i.id in lying else _outer(i, outlines[i.part][-1].geometry.sampled(PER_EDGE))
        for i in stand
    ]
    chains = [found for mate in plan.placing.mates if (found := mate.rollers()) is not None]
    idlers = [one for mate in plan.placing.mates for one in mate.idlers()]
    # what runs about others may reach beyond them
    rounds = [*((at, r) for row, r in chains for at in row), *idlers]
    low, high = _corners([*outers, *(at + r * _ROUND for at, r in rounds)])
    reach = max((high - low).real, (high - low).imag) / 2
    middle, shift = reach * 1.08, -(low + high) / 2
    corner = complex(middle, middle)
    size = reach / 30
    body: list[str] = []
    labels, loops, colours = list[Label](), list[list[Complex]](), fills(plan.parts)
    for index, instance in enumerate(stand):
        place, own = instance.centre + shift, outlines[instance.part]
        placed = [_placed(b.geometry, instance, place) for b in reversed(own)]
        if instance.id in lying:
            placed = [Contour(loop + shift, np.zeros(len(loop))) for loop in lying[instance.id]]
        # last digits, which differ from processor to processor, choose no place of a name
        places = [contour.sampled(PER_EDGE) for contour in placed]
        loops.append([(corner + points.conj()).round(DRAWN_DECIMALS) for points in places])
        part, flat = plan.parts[instance.part], [b.geometry for b in own] if instance.axis == UPWARDS else []
        pins = [_placed(contour, instance, place) for contour in solid_pins(part, flat)]
        lines_on = _lines_on(part, instance, place, corner)
        body += _instance(placed, lines_on, pins, colours[instance.part], corner, reach)
        height = _label_height(own, outers[index] - instance.centre)
        if instance.axis != UPWARDS:
            ends = outers[index].real, outers[index].imag
            place, height = complex(*((x.min() + x.max()) / 2 for x in ends)) + shift, 0.0
        x, y = middle + place.real, middle - place.imag - height
        labels.append(Label(names[instance.id], round(x, DRAWN_DECIMALS), round(y, DRAWN_DECIMALS), size))
    body += [_round(at + shift, radius, "fill:#c9ced6", corner, reach) for at, radius in idlers]
    body += [line for row, radius in chains for line in _chain(row + shift, radius, corner, reach)]
    # no name stands on idlers and rollers
    loops += [[(corner + (at + shift + r * _ROUND).conj()).round(DRAWN_DECIMALS)] for at, r in idlers]
    loops += [[corner + (at + shift).conj() + r * _ROUND for at in row] for row, r in chains]
    # a wide scene is drawn wide: what is above and below it is cut off
    spare = max(0.0, 2 * (middle - (high - low).imag / 2 - 0.08 * reach))
    seen = (1j * spare / 2, complex(2 * middle, 2 * middle - spare / 2))
    named = [one for one in spread_labels(labels, Tops(loops, picture=seen)) if one]
    body += [_leader(one.line, one.size) for one in named if one.line]
    body += [text_line(one.text, one.x, one.y, one.size, "text-anchor:middle;") for one in named]
    written = {one.text for one in named}
    covered = [label.text for label in labels if label.text not in written]
    rows = _caption_rows(plan.scene, checks, every, covered)
    caption = size * 1.7 * (len(rows) + 1)
    file = folder / scene_preview_name(plan)
    lines = [page_head(2 * middle, 2 * middle + caption - spare, whole=True), GROUND]
    lines.append(f'<g transform="translate(0 {number(caption - spare / 2)})">')
    save(file, [*lines, *body, "</g>", *_caption(rows, size, size)])
    return file


def _corners(outlines: Sequence[Complex]) -> tuple[complex, complex]:
    """Of the upright rectangle about them, the lower left one and the upper right one."""
    points = np.concatenate(outlines)
    return complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())


def _instance(
    placed: Sequence[Contour], lines_on: str, pins: Sequence[Contour], shade: str, corner: complex, reach: float
) -> Iterator[str]:
    """An instance in its place and shade: its boundaries, the path of the lines on it, and its pins."""
    width = f"stroke-width:{reach / 600:.4g}"
    data = " ".join(path_data(contour, corner) for contour in placed)
    yield f'<path d="{data}" style="fill:{shade};fill-opacity:0.85;fill-rule:evenodd;stroke:#202830;{width}"/>'
    if lines_on:
        yield f'<path d="{lines_on}" style="fill:none;stroke:#202830;{width}"/>'
    if pins:
        data = " ".join(path_data(pin, corner) for pin in pins)
        yield f'<path d="{data}" style="{_PIN_STYLE};{width}"/>'


def _caption_rows(
    scene: SceneFile, checks: dict[str, Any], names: Mapping[str, str], covered: Sequence[str]
) -> list[str]:
    """The scene's title, what the checks found, and which names the picture has no room for."""
    from exporters.production.check_lines import caption_lines

    told = words(scene.scene.language)
    # no name is broken in the caption
    whole = {key: name.replace(" ", _NO_BREAK) for key, name in names.items()}
    rows = [scene.scene.title or scene.name, *caption_lines(checks, scene.scene.language, whole, _MOST_LETTERS)]
    if covered:
        left = dict.fromkeys(name.replace(" ", _NO_BREAK) for name in covered)
        row = told.text("without its name in the picture: {names}", names=", ".join(in_rows(left)))
        count = len(covered)
        less = told.plural(
            "without its name in the picture: {parts} part", "without its name in the picture: {parts} parts", count,
            parts=count,
        )  # fmt: skip
        rows.append(row if len(row) <= _MOST_LETTERS // 2 else less)
    return [line for row in rows for line in wrap(_unbroken(told.decimal(row)), _WIDE_LETTERS)]


def _chain(centres: Complex, radius: float, corner: complex, reach: float) -> list[str]:
    """The rollers of a chain that runs upright, and the line through their centres."""
    line = f"stroke-width:{reach / 600:.4g}"
    data = path_data(Contour(centres, np.zeros(len(centres))), corner)
    return [
        f'<path d="{data}" style="fill:none;stroke:#c03020;{line}"/>',
        *(_round(at, radius, "fill:#7f8c99;fill-opacity:0.5", corner, reach) for at in centres.tolist()),
    ]


def _round(at: complex, radius: float, shade: str, corner: complex, reach: float) -> str:
    """A circle in a shade."""
    place = f'cx="{number(at.real + corner.real)}" cy="{number(corner.imag - at.imag)}" r="{number(radius)}"'
    return f'<circle {place} style="{shade};stroke:#202830;stroke-width:{reach / 600:.4g}"/>'


def _leader(line: tuple[complex, complex], size: float) -> str:
    """The line from a word, whose letters have a size, to what it names."""
    start, end = line
    ends = f'x1="{start.real:.4g}" y1="{start.imag:.4g}" x2="{end.real:.4g}" y2="{end.imag:.4g}"'
    dot = f'<circle cx="{end.real:.4g}" cy="{end.imag:.4g}" r="{size / 8:.4g}" style="fill:#202830"/>'
    return f'<line {ends} style="stroke:#202830;stroke-width:{size / 20:.4g}"/>{dot}'


def _together(names: Mapping[str, str], stand: Sequence[Instance]) -> dict[str, str]:
    """Names by id, those of many of one part that differ by their last number alone as one with how many they are."""
    stems = {i.id: (_LAST_NUMBER.sub("", names[i.id]), i.part) for i in stand}
    many = Counter(stems.values())
    return {key: f"{row[0]} × {many[row]}" if many[row] > _MANY else names[key] for key, row in stems.items()}


def _outer(instance: Instance, points: Complex) -> Complex:
    """The outer boundary of an instance that stands, seen from above."""
    if instance.is_over:
        return np.asarray(points.conj() * cmath.exp(-1j * instance.rotation) + instance.centre)
    return points * cmath.exp(1j * instance.rotation) + instance.centre


def _seen_lying(instance: Instance, part: Part) -> list[Complex]:
    """The boundaries of the shadow of an instance that lies, from above, teeth and all, near enough for the eye."""
    from parts.scene.interference import meshed_solid
    from parts.solids.mesh import body_mesh, mesh_outlines

    body = part.body(0.0)
    near = _NEAR * body.section_reach()
    try:
        mesh = body_mesh(body, mesh_outlines(body, near, 0.0))
        solid = meshed_solid(mesh).transform(instance.scene_from_part.matrix())
    except GeometryError:
        # a wall is too thin for a mesh: what it sweeps
        from exporters.production.seen_above import seen_lying

        period = seen_lying(part, instance, near, spins=True)[0].period
        return [np.array([complex(s.curve.point(0.0)) for s in period]) + instance.centre]
    return [np.asarray(loop @ (1, 1j)) for loop in solid.project().simplify(near).to_polygons()]


def scene_preview_name(plan: Plan) -> str:
    """``<scene>.preview.svg``; with a word in between where a part has the scene's name."""
    alike = plan.scene.name.lower() in {p.lower() for p in plan.parts}
    return f"{plan.scene.name}{'.assembly' if alike else ''}.preview.svg"


def outlines_of(region: Region) -> Outlines:
    """The boundaries of a section, near enough for the eye."""
    tolerance = max(2e-4 * region.outer.reach(), 1e-6)
    return tuple(
        approximate_profile(p, tolerance, arcs=True) if len(p.period) <= _MOST_ARCS else _sampled(p, tolerance)
        for p in region.profiles()
    )


def _sampled(profile: Profile, tolerance: float) -> Approximation:
    """An outline of very many curves by points of theirs, for the eye."""
    points = [s.curve.point(np.linspace(*s.curve.domain, _POINTS + 1)[:-1]) for s in profile.period]
    plane = np.concatenate(points)
    contour = Contour(plane, np.zeros(len(plane)), profile.count, profile.clockwise)
    return Approximation(contour, tolerance, "sampled", tolerance)


def _lines_on(part: Part, instance: Instance, place: complex, corner: complex) -> str:
    """What is not cut through an upright part, such as the locking disc on its crank plate, as data of a path."""
    strokes = part.section(0.0).region.strokes if instance.axis == UPWARDS else ()
    turned = (np.array(stroke) * cmath.exp(1j * instance.rotation) + place for stroke in strokes)
    return " ".join(stroke_data(points.round(DRAWN_DECIMALS), corner) for points in turned)


def _label_height(outlines: Outlines, outer: Complex) -> float:
    """Height over the axis at which a name stands on material: half way from the largest hole about it to the teeth."""
    inner = max((float(np.abs(a.geometry.vertices).max()) for a in outlines[:-1]), default=0.0)
    if not outlines[:-1] and outlines[-1].geometry.count == 1:
        # no wheel: just above its lowest edge
        return float(outer.imag.min()) + 0.03 * float(np.ptp(outer.real))
    if inner >= float(np.abs(outer).min()):
        inner = 0.0
    return -(inner + float(np.abs(outer).min())) / 2


def _placed(contour: Contour, instance: Instance, place: complex) -> Contour:
    """An outline of an instance that stands at a place, or is turned over there."""
    vertices, bulges = contour.expanded()
    turn = cmath.exp(1j * instance.rotation)
    if instance.is_over:
        vertices, bulges, turn = vertices.conj(), -bulges, turn.conjugate()
    return Contour(vertices * turn + place, bulges)


_CIRCLE_COLOURS = {"reference_diameter": "#c03020", "base_diameter": "#2060c0", "root_form_diameter": "#209050"}


def _axial(half: Complex, at: complex, shade: str, reach: float) -> list[str]:
    """The axial section of what is turned, by half of it; ``at``: the lower end of its axis, which lies."""
    along, width = half.imag - half.imag.min(), f"stroke-width:{reach / 400:.4g}"
    sides = [along + 1j * side * half.real for side in (1, -1)]
    data = " ".join(path_data(Contour(points, np.zeros(len(points))), at) for points in sides)
    ends = number(at.real), number(at.real + float(along.max())), number(at.imag)
    return [
        f'<path d="{data}" style="fill:{shade};stroke:#202830;{width}"/>',
        f'<line x1="{ends[0]}" y1="{ends[2]}" x2="{ends[1]}" y2="{ends[2]}" style="stroke:#c03020;{width}"/>',
    ]


def _cross(origin: complex, low: complex, high: complex) -> list[str]:
    """Centre lines through the origin of a part with these corners, y upwards about it, where they run over it."""
    reach = max(high.real - low.real, high.imag - low.imag) / 2
    style, over = f'style="stroke:#c03020;stroke-width:{reach / 400:.4g}"', 0.05 * reach
    x, y = number(origin.real), number(origin.imag)
    ends = [number(at) for at in (origin.real + low.real - over, origin.real + high.real + over)]
    sides = [number(at) for at in (origin.imag - high.imag - over, origin.imag - low.imag + over)]
    lines = []
    if low.imag <= 0 <= high.imag:
        lines.append(f'<line x1="{ends[0]}" y1="{y}" x2="{ends[1]}" y2="{y}" {style}/>')
    if low.real <= 0 <= high.real:
        lines.append(f'<line x1="{x}" y1="{sides[0]}" x2="{x}" y2="{sides[1]}" {style}/>')
    return lines


def _caption(rows: list[str], left: float, size: float) -> list[str]:
    """The first one is the title."""
    return [
        text_line(row, left, (i + 1.5) * size * 1.7, size, "" if i else "font-weight:bold;")
        for i, row in enumerate(rows)
    ]
