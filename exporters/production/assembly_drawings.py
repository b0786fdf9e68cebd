"""The assembly drawing of a scene: its instances in two views, the parts list, sizes between axes and over all."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from exporters.production.request import Request
from geometry.base.errors import ParameterError
from geometry.base.placement import Placement3
from geometry.base.record import replace
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Line, arc_between
from parts.base.mate import Touching
from parts.drawing.assembly_sheet import AssemblyView, assembly_sheet
from parts.drawing.assembly_views import Drawn, Shown, along_axes, cut, seen
from parts.drawing.choice import Asked
from parts.drawing.expected import Expected
from parts.drawing.extent import farthest
from parts.drawing.wheel_views import circle_of
from parts.drawing.working import AXIS, VISIBLE, Size
from parts.scene.parts_list import list_rows
from parts.scene.placing import PlacedMate, Placing

# what is one place, mm
_SAME = 1e-6
# of the radius of an idler, to which its axes reach
_BEYOND = 1.25
# of their pitch circle, within which pins stand on it
_SEATED = 1e-9
_TITLE = "A-A"


def assembly_drawings(request: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The drawing of all instances of the parts that the export names.

    Raises
    ------
    SceneError
        A part whose kind has no view in an assembly, or an axis that is oblique to the views.
    """
    placing, wanted = request.placing, {key: request.parts[key] for key in request.wanted}
    sketches = {}
    for part in (wanted[key] for key in dict.fromkeys(i.part for i in placing.instances) if key in wanted):
        sketch = part.made_by.sketch(part.keys, part.thing)
        if sketch is None:
            raise request.refused("purpose", request.export.purpose, "no_assembly_view", kind=part.kind, part=part.id)
        sketches[part.id] = sketch
    shown = [Shown(i.id, i.part, sketches[i.part], i.scene_from_part) for i in placing.instances if i.part in wanted]
    centre, way, front, section = _seen(shown, placing, set(wanted))
    main, across = along_axes(front), cut(section)
    main = replace(main, strokes=(*main.strokes, *_pitch_lines(placing, set(wanted), centre, way)))
    views = [
        AssemblyView(across, (*_between(front, across, placing), *_over_all(across, across=False)), title=_TITLE),
        AssemblyView(main, (*_beside(front, placing), *_over_all(main, across=True)), marked=True),
    ]
    return [("", assembly_sheet(views, list_rows(placing.instances, wanted, asked.language), asked))]


def _seen(
    shown: Sequence[Shown], placing: Placing, wanted: set[str]
) -> tuple[complex, complex, list[Shown], list[Shown]]:
    """A point of the section's plane, its direction, and the instances in both views: of the first plane, of those
    through the axes of mates, to which no axis is oblique.
    """
    refusal = None
    for centre, way in _planes(placing, wanted):
        back, (x, y) = Placement3(translation=(-centre.real, -centre.imag, 0.0)), (way.real, way.imag)
        turns = ((x, y, 0.0), (-y, x, 0.0), (0.0, 0.0, 1.0)), ((x, y, 0.0), (0.0, 0.0, 1.0), (y, -x, 0.0))
        try:
            front, section = (seen(shown, Placement3(turn) @ back) for turn in turns)
        except ParameterError as error:
            refusal = refusal or error
        else:
            return centre, way, front, section
    assert refusal is not None
    raise refusal


def _planes(placing: Placing, wanted: set[str]) -> Iterator[tuple[complex, complex]]:
    """A point and the direction of each plane through the axes of a mate that has two: of what meshes or touches before
    any other, like a key beside its shaft's axis.
    """
    alone = True
    for mate in sorted(placing.mates, key=lambda mate: not isinstance(mate.mating, Touching)):
        step = _foot(mate, mate.first.centre, mate.second.scene_from_part) - mate.first.centre
        if {mate.first.part, mate.second.part} <= wanted and abs(step) > _SAME:
            alone = False
            yield mate.first.centre, step / abs(step)
    if alone:
        yield next(i for i in placing.instances if i.part in wanted).centre, 1.0


def _pitch_lines(placing: Placing, wanted: set[str], centre: complex, way: complex) -> Iterator[tuple[str, Curve]]:
    """The pitch lines of chains that run upright: arcs through their seated pins, and straight strands between."""
    for mate in placing.mates:
        if not {mate.first.part, mate.second.part} <= wanted or (found := mate.rollers()) is None:
            continue
        pins, ends = (found[0] - centre) / way, list[complex]()
        about = mate.mating.about((mate.first.centre, mate.first.rotation), (mate.second.centre, mate.second.rotation))
        for axis, radius in (((one - centre) / way, radius) for one, radius in about):
            seated = np.abs(np.abs(pins - axis) - abs(radius)) <= abs(radius) * _SEATED
            if not seated.any():
                continue
            # the first of them follows one that is not, clockwise
            start = int(np.flatnonzero(seated & ~np.roll(seated, 1))[0])
            last = (start + int(seated.sum()) - 1) % len(pins)
            if start != last:
                yield AXIS, arc_between(axis, complex(pins[start]), complex(pins[last]), turns_left=radius < 0)
            ends += [complex(pins[start]), complex(pins[last])]
        for one, two in zip(ends[1::2], [*ends[2::2], ends[0]], strict=True):
            yield AXIS, Line(one, two)
        for axis, rim in mate.idlers():
            at = (axis - centre) / way
            yield VISIBLE, circle_of(rim, at)
            yield from ((AXIS, Line(at - _BEYOND * rim * along, at + _BEYOND * rim * along)) for along in (1.0, 1j))


def _foot(mate: PlacedMate, first: complex, second: Placement3) -> complex:
    """Where a mate's line of centres meets its second's axis, by where both stand in a view, mm."""
    offset = complex(*second.translation[:2]) - first
    way = cmath.rect(1.0, mate.mating.centres_direction(offset, second))
    return first + way * (way.conjugate() * offset).real


def _meshes(front: Sequence[Shown], placing: Placing) -> list[tuple[str, complex, complex]]:
    """The axes of what meshes or touches, by the names of both, in the view."""
    places = {one.id: one for one in front}
    found = []
    for mate in placing.mates:
        if isinstance(mate.mating, Touching) and {mate.first.id, mate.second.id} <= places.keys():
            one, two = places[mate.first.id], places[mate.second.id]
            foot = _foot(mate, one.centre, two.place)
            found.append((f"axes.{one.id}.{two.id}", one.centre, foot))
    return found


def _between(front: Sequence[Shown], across: Drawn, placing: Placing) -> list[Size]:
    """From axis to axis in the plane of the section."""
    low = min(float(c.point(np.array(c.domain)).imag.min()) for _, c in across.strokes)
    places = sorted({round(p.real, 9) for _, *both in _meshes(front, placing) for p in both if abs(p.imag) < _SAME})
    return [
        Size(f"axes.{number}", complex(a, low), complex(b, low), "below")
        for number, (a, b) in enumerate(pairwise(places), 1)
    ]


def _beside(front: Sequence[Shown], placing: Placing) -> list[Size]:
    """From axis to axis of mates beside that plane, along x and y; a distance that is told is not told again."""
    told = set()
    found = []
    for name, one, two in _meshes(front, placing):
        distance = round(abs(two - one), 6)
        if distance > _SAME and max(abs(one.imag), abs(two.imag)) > _SAME and distance not in told:
            if abs((two - one).real) > _SAME:
                found.append(Size(f"{name}.x", one, two, "above"))
            if abs((two - one).imag) > _SAME:
                found.append(Size(f"{name}.y", one, two, "left"))
        told.add(distance)
    return found


def _over_all(drawn: Drawn, *, across: bool) -> list[Size]:
    """Height of a view, and its width where ``across``."""
    outline = [curve for layer, curve in drawn.strokes if layer == VISIBLE]
    left, right, low, high = (farthest(outline, way) for way in (-1, 1, -1j, 1j))
    found = [Size("height", complex(low), complex(high), "right")]
    return [*found, Size("width", complex(left), complex(right), "below")] if across else found
