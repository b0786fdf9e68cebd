"""The exploded view of a scene that tells its order of assembly: isometric, with the numbers of its parts list."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from exporters.formats.svg import escaped, fills, save
from exporters.production.plan import Plan
from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Real
from geometry.solids.sketch import Layer, Sketch, round_ring, sketch_of_body
from parts.base.part import Part
from parts.base.texts import words
from parts.drawing.parts_list import ListRow
from parts.scene.exploded import apart
from parts.scene.parts_list import list_rows
from parts.scene.standing import Instance
from parts.scene.steps import stages
from parts.solids.axonometry import TOWARDS, Picture, loops_of, pictured, seen

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# the longer side of the picture of all parts, and the height of its letters; lines, all in its units
_SIZE, _TEXT, _EDGE, _OUTLINE = 1200.0, 13.0, 0.3, 0.6
_COLUMN = 4 * _TEXT
# width of a letter in parts of its height, of Cyrillic and bold ones too
_LETTER = 0.62
# of arcs and outlines; instances that are tried for a leader's end; how much lighter what faces the viewer is
_TOLERANCE, _TRIED, _LIGHT = 0.2, 6, 1.08
_STYLE = (
    "path{fill-rule:evenodd;stroke-width:0.5}"
    f".e{{fill:none;stroke:#202830;stroke-width:{_EDGE};stroke-linejoin:round}}"
    f".f{{stroke:#202830;stroke-width:{_EDGE};stroke-linejoin:round}}"
    f".o{{fill:none;stroke:#202830;stroke-width:{_OUTLINE};stroke-linejoin:round}}"
    f"text{{font-family:sans-serif;font-size:{_TEXT}px;fill:#202830}}"
    ".l{fill:none;stroke:#303840;stroke-width:0.8}"
)


class _Thing(Record):
    """An instance in the picture: its drawing, shared by those that look alike, and where it stands."""

    instance: Instance
    drawing: int
    shift: Real
    box: Real


def exploded_preview(plan: Plan, folder: Path) -> Path:
    """All instances apart on the ways on which they come, numbers on leaders, and what these are."""
    parts, placing = plan.parts, plan.placing
    sketches = {key: _sketch(parts[key]) for key in dict.fromkeys(i.part for i in placing.instances)}
    drawings: list[tuple[str, Picture]] = []
    known: dict[object, int] = {}
    # how fine arcs are goes by how large all of it will be
    rough = sum(np.ptp([layer.low for layer in s.layers] + [s.layers[-1].high]) for s in sketches.values())
    scale = _SIZE / max(float(rough), 1e-9)
    things = []
    for instance in placing.instances:
        sketch, laid = sketches[instance.part], instance.scene_from_part
        number = known.setdefault(_alike(instance, sketch), len(drawings))
        if number == len(drawings):
            drawings.append((instance.part, pictured(sketch, type(laid)(laid.rotation), _TOLERANCE / scale)))
        at = np.array(instance.at)
        things.append(_Thing(instance, number, at, drawings[number][1].corners + at))
    moved = apart(stages(plan.scene.steps, [i.id for i in placing.instances]), {t.instance.id: t.box for t in things})
    ways = ((thing, moved[thing.instance.id]) for thing in things)
    stand = [replace(thing, shift=thing.shift + way, box=thing.box + way) for thing, way in ways]
    ordered = [stand[k] for k in from_behind(np.array([t.box for t in stand]))]
    ends = np.concatenate([_corners(t.box) for t in ordered])
    wide, high = float(np.ptp(ends.real)), float(np.ptp(ends.imag))
    scale = _SIZE / max(wide, high)
    origin = complex(float(ends.real.min()), float(ends.imag.max()))
    rows = list_rows(placing.instances, parts, plan.scene.scene.language, weighed=False)
    lines = list(_drawn(ordered, drawings, parts, origin, scale))
    width, numbered, leaders = _leaders(ordered, drawings, rows, origin, scale, scale * complex(wide, high))
    covered = {row.position for row in rows} - set(numbered)
    caption, reach = _caption(plan, rows, covered, complex(width, high * scale))
    width = max(width, reach)
    deep = high * scale + _TEXT * (3 + max(map(len, caption))) * 1.4
    file = folder / f"{plan.scene.name}.exploded.preview.svg"
    margin = 4 * _TEXT
    head = (
        '<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" '
        # programs of before SVG 2 know no plain href
        'xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'viewBox="{-margin:g} {-margin:g} {width + 2 * margin:.0f} {deep + 2 * margin:.0f}">'
    )
    back = f'<rect x="{-margin:g}" y="{-margin:g}" width="100%" height="100%" style="fill:#ffffff"/>'
    told = [line for column in caption for line in column]
    save(file, [head, f"<style>{_STYLE}</style>", back, *lines, *leaders, *told])
    return file


def _sketch(part: Part) -> Sketch:
    """What is drawn of a part: with its teeth, where they are walls; else as in assembly drawings, or its hull."""
    body = part.body(0.0)
    if not body.is_faced:
        return sketch_of_body(body)
    sketch = part.made_by.sketch(part.keys, part.thing)
    if sketch is not None:
        return sketch
    low, high, ring = body.levels()[0], body.levels()[-1], (round_ring(body.section_reach()),)
    return Sketch((Layer(low, high, ring, ring),))


def _alike(instance: Instance, sketch: Sketch) -> object:
    """What tells how an instance looks: what is round about its axis looks alike however it is turned."""
    rings = [ring for layer in sketch.layers for ring in (*layer.lower, *layer.upper)]
    round_ = all(ring.circle is not None and abs(ring.circle[0]) < 1e-9 for ring in rings)
    return instance.part, instance.axis, None if round_ else round(instance.rotation, 9)


def _corners(box: Real) -> Complex:
    """The corners of a box in the picture."""
    x, y, z = (box[:, k] for k in range(3))
    return seen(np.array([[a, b, c] for a in x for b in y for c in z]))


def from_behind(boxes: Real) -> list[int]:
    """An order of boxes (n, 2, 3) in which none is drawn over what stands before it: told by planes between them."""
    flat = np.array([[p.real.min(), p.imag.min(), p.real.max(), p.imag.max()] for p in map(_corners, boxes)])
    before: list[list[int]] = [[] for _ in boxes]
    waiting = [0] * len(boxes)
    for a, b in combinations(range(len(boxes)), 2):
        if (flat[a, :2] >= flat[b, 2:]).any() or (flat[b, :2] >= flat[a, 2:]).any():
            continue
        first = _first(boxes[a], boxes[b])
        if first:
            one, two = (a, b) if first > 0 else (b, a)
            before[one].append(two)
            waiting[two] += 1
    depth = boxes.mean(axis=1) @ TOWARDS
    left = set(range(len(boxes)))
    order = []
    while left:
        free = [k for k in left if waiting[k] == 0] or list(left)
        one = min(free, key=lambda k: (depth[k], k))
        left.remove(one)
        order.append(one)
        for other in before[one]:
            waiting[other] -= 1
    return order


def _first(one: Real, two: Real) -> int:
    """1: the first box is drawn first, -1: the second, 0: all the same."""
    ways = set()
    for k in range(3):
        towards = 1 if TOWARDS[k] > 0 else -1
        if one[1, k] <= two[0, k] + 1e-6:
            ways.add(towards)
        elif two[1, k] <= one[0, k] + 1e-6:
            ways.add(-towards)
    if len(ways) == 1:
        return ways.pop()
    if ways:
        return 0
    # one within the other
    return 1 if np.ptp(one, axis=0).prod() > np.ptp(two, axis=0).prod() else -1


def _drawn(
    things: Sequence[_Thing], drawings: Sequence[tuple[str, Picture]], parts: Mapping[str, Part], origin: complex,
    scale: float,
) -> Iterator[str]:  # fmt: skip
    """Each drawing once, and every instance by it."""
    own = fills(parts)
    colours = [own[part] for part, _ in drawings]
    shades = dict.fromkeys(colours)
    yield "<defs>"
    for number, colour in enumerate(shades):
        shades[colour] = number
        stops = "".join(
            f'<stop offset="{at}" stop-color="{_toned(colour, tone)}"/>'
            for at, tone in ((0, 0.62), (0.35, 0.98), (0.6, 0.88), (1, 0.5))
        )
        yield f'<linearGradient id="g{number}">{stops}</linearGradient>'
    for number, (_, picture) in enumerate(drawings):
        colour = colours[number]
        yield f'<g id="d{number}">'
        for patch in picture.patches:
            data = "".join(_data(loop, scale, closed=patch.kind != "edge") for loop in patch.loops)
            look = {
                "edge": 'class="e"',
                "wall": f'fill="url(#g{shades[colour]})" stroke="url(#g{shades[colour]})"',
                "end": f'fill="{_toned(colour, _LIGHT)}"',
                "face": f'class="f" fill="{_toned(colour, _LIGHT)}"',
            }[patch.kind]
            yield f'<path {look} d="{data}"/>'
        outline = "".join(_data(loop, scale) for loop in loops_of(picture.outline, (_TOLERANCE / scale) ** 2))
        yield f'<path class="o" d="{outline}"/></g>'
    yield f'</defs><g transform="translate({_COLUMN:g} 0)">'
    for thing in things:
        at = _on_paper(complex(seen(thing.shift[None])[0]), origin, scale)
        yield f'<use id="{thing.instance.id}" xlink:href="#d{thing.drawing}" x="{at.real:.1f}" y="{at.imag:.1f}"/>'
    yield "</g>"


def _toned(colour: str, tone: float) -> str:
    """A colour that is lighter or darker."""
    parts = [min(255, round(int(colour[k : k + 2], 16) * tone)) for k in (1, 3, 5)]
    return "#" + "".join(f"{part:02x}" for part in parts)


def _on_paper(place: complex, origin: complex, scale: float) -> complex:
    """A place of the picture in its units, y downwards."""
    return complex(place.real - origin.real, origin.imag - place.imag) * scale


def _data(loop: Complex, scale: float, *, closed: bool = True) -> str:
    """A path about the instance's own origin, from place to place; what the eye does not see is left out."""
    import shapely

    places = np.column_stack([loop.real * scale, -loop.imag * scale])
    line = shapely.LinearRing(places) if closed else shapely.LineString(places)
    places = np.round(10 * np.asarray(shapely.simplify(line, _TOLERANCE, preserve_topology=False).coords)).astype(int)
    steps = np.diff(places[:-1] if closed else places, axis=0)
    told = [f"M{_tenths(places[0, 0])},{_tenths(places[0, 1])}l"]
    told += [f"{_tenths(x)},{_tenths(y)} " for x, y in steps.tolist() if x or y]
    return "".join(told).rstrip("l ") + "z" * closed


def _tenths(count: int) -> str:
    """So many tenths as text."""
    return f"{count / 10:g}".replace("0.", ".", 1) if abs(count) < 10 else f"{count / 10:g}"


def _leaders(
    things: Sequence[_Thing], drawings: Sequence[tuple[str, Picture]], rows: Sequence[ListRow], origin: complex,
    scale: float, size: complex,
) -> tuple[float, list[int], list[str]]:  # fmt: skip
    """The whole width, the numbers that have a leader to what is seen of their part, and these, in two columns."""
    shown, shapes = [t.instance.part for t in things], [_placed(t, drawings) for t in things]
    ends = {row.position: end for row in rows if (end := seen_at(shown, shapes, row.parts)) is not None}
    placed = {number: _on_paper(end, origin, scale) + _COLUMN for number, end in ends.items()}
    middle = float(np.median([p.real for p in placed.values()])) if placed else 0.0
    lines = []
    for side, at in ((0, 0.0), (1, size.real + 2 * _COLUMN)):
        own = sorted((n for n, p in placed.items() if (p.real > middle) == bool(side)), key=lambda n: placed[n].imag)
        heights = spread([placed[n].imag for n in own], 1.5 * _TEXT, size.imag)
        for number, y in zip(own, heights, strict=True):
            end, shelf = placed[number], 2 * _TEXT * (1 - 2 * side)
            lines.append(f'<path class="l" d="M{at:.0f},{y:.1f}h{shelf:g}L{end.real:.1f},{end.imag:.1f}"/>')
            lines.append(f'<circle cx="{end.real:.1f}" cy="{end.imag:.1f}" r="2.2"/>')
            lines.append(f'<text x="{at + shelf / 2:.0f}" y="{y - 3:.1f}" text-anchor="middle">{number}</text>')
    return size.real + 2 * _COLUMN, list(ends), lines


def seen_at(shown: Sequence[str], shapes: Sequence[BaseGeometry], parts: Sequence[str]) -> complex | None:
    """A place well within what is seen of an instance of some parts; ``shown``: all parts from behind, and shapes."""
    import shapely

    best: tuple[float, complex] | None = None
    own = [k for k, part in enumerate(shown) if part in parts]
    for k in own[:: max(1, len(own) // _TRIED)]:
        over = [shape for shape in shapes[k + 1 :] if shapely.intersects(shape.envelope, shapes[k].envelope)]
        shape = shapely.difference(shapes[k], shapely.union_all(over))
        pieces = [p for p in shapely.get_parts(shape) if p.area > 0]
        if not pieces:
            continue
        largest = max(pieces, key=lambda p: p.area)
        if best is None or largest.area > best[0]:
            point = shapely.maximum_inscribed_circle(largest, tolerance=largest.length / 500).coords[0]
            best = largest.area, complex(*point)
    return None if best is None else best[1]


def _placed(thing: _Thing, drawings: Sequence[tuple[str, Picture]]) -> BaseGeometry:
    import shapely

    at = complex(seen(thing.shift[None])[0])
    return shapely.transform(drawings[thing.drawing][1].outline, lambda xy: xy + np.array([at.real, at.imag]))


def spread(wanted: Sequence[float], step: float, most: float) -> list[float]:
    """Heights in their order, at least a step apart, as near to where they are wanted as may be."""
    found: list[float] = []
    for y in wanted:
        found.append(max(y, found[-1] + step) if found else y)
    if found and found[-1] > most:
        found[-1] = most
    for k in range(len(found) - 2, -1, -1):
        found[k] = min(found[k], found[k + 1] - step)
    return found


def _caption(plan: Plan, rows: Sequence[ListRow], covered: set[int], size: complex) -> tuple[list[list[str]], float]:
    """The title, and under the picture what the numbers are, in columns; and how far to the right that goes."""
    title = plan.scene.scene.title or plan.scene.name
    top = size.imag + 2.5 * _TEXT
    told = [f"{row.position}  {row.name}" + (f" × {row.count}" if row.count > 1 else "") for row in rows]
    if covered:
        names = ", ".join(map(str, sorted(covered)))
        told.append(words(plan.scene.scene.language).text("without its name in the picture: {names}", names=names))
    wide = _LETTER * _TEXT * (max(map(len, told)) + 2)
    columns = max(1, round(size.real / wide))
    deep = -(-len(told) // columns)
    found = [[f'<text x="0" y="{-1.6 * _TEXT:g}" style="font-weight:bold">{escaped(title)}</text>']]
    for k in range(columns):
        found.append([
            f'<text x="{k * wide:.0f}" y="{top + 1.4 * _TEXT * n:.0f}">{escaped(text)}</text>'
            for n, text in enumerate(told[k * deep : (k + 1) * deep])
        ])  # fmt: skip
    return found, max(columns * wide, _LETTER * _TEXT * len(title))
