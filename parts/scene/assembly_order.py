"""Whether each part reaches its place in the order of assembly: straight on its way, past all that stands by then.

Both stand at the end of the way as the scene has them. What boxes do not part is decided by sections: about the axes,
where the way goes along them, or layer by layer; gears slide into each other along their teeth as their contact is,
a worm is turned in by its thread. Only what is left is held by solids, what comes in by the hull of its way.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from geometry.base.errors import GeometryError
from geometry.base.placement import Vector
from geometry.base.record import Draft, Record, field, replace
from geometry.curves.curve import Complex, Real
from geometry.gears.worms.body import WormBody
from parts.base.part import Part
from parts.keys.helix import helix_of
from parts.scene.half_sections import FAR, TOUCH, Sections, drawn_along
from parts.scene.interference import by_contact, common_volume, inner_solid, placed_solid
from parts.scene.placing import Placing
from parts.scene.shapes import shape_of
from parts.scene.standing import UPWARDS, Instance
from parts.scene.steps import Stage, StepSpec, stages

# what is no way, and of what two ways have in common: digits
_NONE, _DIGITS = 1e-9, 6
# of a turn, or of what it is parted into: what stands on the border is beyond it
_NEAR = 1e-6
# sides of what is turned and drawn out
_ROUND = 256
# triangles of solids in their places that are kept, of some 180 bytes each
_MOST_PLACED = 1_000_000
# how ways are decided, in the order in which it is asked
HOWS = ("boxes", "mesh", "sections", "layers", "solids")


class Leg(Record):
    """A straight piece of a way: its direction, how long it is, mm, and what is still to go after it."""

    way: Vector
    length: float
    left: Vector = (0.0, 0.0, 0.0)


class Hindrance(Record):
    """What comes in by a step (from 1) is not clear of what stands.

    ``volume``: mm^3 in common with what it passes, or with the hull of that; None: a wall too thin to tell.
    """

    step: int
    coming: str
    standing: str
    volume: float | None


class OrderFound(Draft):
    """What holding an order of assembly shows: pairs by how they were decided, and what does not pass."""

    steps: int
    pairs: dict[str, int] = field(default_factory=lambda: dict.fromkeys(HOWS, 0))
    hindered: list[Hindrance] = field(default_factory=list)


def order_found(steps: Sequence[StepSpec], placing: Placing, parts: Mapping[str, Part]) -> OrderFound:
    """Every step of an order, each part that it moves against each that stands."""
    return _Order(placing, parts).held(steps)


def legs(step: StepSpec, coming: Instance, to: Instance) -> tuple[Leg, ...]:
    """The way of what a step brings, from outside to its place; ``to``: about whose axis it goes in or out."""
    about = coming.centre - to.centre
    out = about / abs(about) if abs(about) > _NONE else 1 + 0j
    if step.along is None:
        return (Leg((-out.real, -out.imag, 0.0), FAR),)
    size = math.hypot(*step.along)
    x, y, z = (w / size for w in step.along)
    if step.outwards is None:
        return (Leg((x, y, z), FAR),)
    left, side = out * step.outwards, math.copysign(1.0, step.outwards)
    return (
        Leg((x, y, z), FAR, (left.real, left.imag, 0.0)),
        Leg((side * out.real, side * out.imag, 0.0), abs(step.outwards)),
    )


class _Order:
    def __init__(self, placing: Placing, parts: Mapping[str, Part]) -> None:
        self.parts = dict(parts)
        self.sections = Sections(self.parts)
        self.contact = by_contact(placing, dict(parts))
        self.home = {i.id: i for i in placing.instances}
        self.number = {key: k for k, key in enumerate(self.home)}
        self.boxes = np.array([_box(i, parts[i.part]) for i in placing.instances])
        self.done: dict[object, tuple[str, float | None]] = {}
        self.solids: dict[str, Any] = {}
        self.laid: dict[object, tuple[Real, Any]] = {}

    def held(self, steps: Sequence[StepSpec]) -> OrderFound:
        found = OrderFound(len(steps))
        for number, stage in enumerate(stages(steps, self.home), 1):
            rows = self._rows(stage)
            for coming, leg, others in rows:
                near = self._near(coming, leg, others)
                found.pairs["boxes"] += len(others) - len(near)
                for key in near:
                    how, volume = self._passes(coming, self.home[key], leg, screwed=stage.step.screwed)
                    found.pairs[how] += 1
                    if volume != 0:
                        found.hindered.append(Hindrance(number, coming.id, key, volume))
            for coming, key in self._turning(stage):
                volume = self._turns(coming, self.home[stage.step.to], self.home[key])
                found.pairs["sections"] += 1
                if volume != 0:
                    found.hindered.append(Hindrance(number, coming.id, key, volume))
        return found

    def _turning(self, stage: Stage) -> Iterator[tuple[Instance, str]]:
        """What turns on with the row of a step through one hole, and what stands about that at its height."""
        if not stage.step.one_hole:
            return
        row = dict.fromkeys((stage.step.to, *stage.moved))
        heights = self.boxes[:, :, 2]
        for coming in (self.home[key] for key in row):
            low, high = heights[self.number[coming.id]]
            for key in stage.standing:
                near, far = heights[self.number[key]]
                if key not in row and near < high - TOUCH and far > low + TOUCH:
                    yield coming, key

    def _turns(self, coming: Instance, to: Instance, standing: Instance) -> float | None:
        """What is hit, mm^3, where something goes all round the axis of ``to``."""
        upright = coming.axis == UPWARDS == standing.axis
        at = (to.centre - standing.centre) * cmath.rect(1.0, -standing.rotation)
        round_, lift = abs(coming.centre - to.centre), coming.at[2] - standing.at[2]
        key = coming.part, standing.part, *(round(x, _DIGITS) + 0.0 for x in (at.real, at.imag, round_, lift))
        if key not in self.done:
            free = upright and self.sections.pass_each_other(standing.part, at, coming.part, round_, round_, lift)
            self.done[key] = "sections", 0.0 if free else None
        return self.done[key][1]

    def _rows(self, stage: Stage) -> Iterator[tuple[Instance, Leg, Sequence[str]]]:
        """What moves, each of its legs, and what stands in its way."""
        step, to = stage.step, self.home[stage.step.to]
        for number, key in enumerate(stage.moved):
            # of what comes in one by one the rest may stand
            rest = [one for one in stage.moved if one != key] if step.one_by_one else []
            # in one hole only what is turned on stands otherwise to a later one than to the first
            stand = [step.to] if step.one_hole and number else stage.standing
            coming = self.home[key]
            if step.opened is not None:
                coming = replace(coming, part=self._opened(coming.part, step.opened))
            for leg in legs(step, coming, to):
                yield coming, leg, [*stand, *rest]

    def _opened(self, part: str, wider: float) -> str:
        """A turned part as it is on its way, so much wider in radius, under a name of its own."""
        thing, name = self.parts[part].thing, f"{part} + {wider}"
        pieces = (replace(p, start=p.start + wider, end=p.end + wider, centre=p.centre and p.centre + wider)
                  for p in thing.pieces)  # fmt: skip
        self.parts[name] = replace(self.parts[part], thing=replace(thing, pieces=tuple(pieces)))
        return name

    def _near(self, coming: Instance, leg: Leg, others: Sequence[str]) -> list[str]:
        """What the box of a part meets on its way."""
        stand = self.boxes[[self.number[key] for key in others]].reshape(-1, 2, 3)
        low, high = _box(coming, self.parts[coming.part]) - np.array(leg.left)
        way = np.array(leg.way)
        # it comes from - way t: between which t both boxes have a coordinate in common
        first, last = np.zeros(len(stand)), np.full(len(stand), leg.length)
        for k in range(3):
            near, far = low[k] - stand[:, 1, k] + TOUCH, high[k] - stand[:, 0, k] - TOUCH
            if abs(way[k]) < _NONE:
                last = np.where((near < 0) & (far > 0), last, -1.0)
                continue
            ends = np.sort([near / way[k], far / way[k]], axis=0)
            first, last = np.maximum(first, ends[0]), np.minimum(last, ends[1])
        return [key for key, meets in zip(others, first < last, strict=True) if meets]

    def _passes(self, coming: Instance, standing: Instance, leg: Leg, *, screwed: bool) -> tuple[str, float | None]:
        """How it is decided, and what is hit, mm^3; as often as both stand alike."""
        x, y, z = (a - b for a, b in zip(coming.at, leg.left, strict=True))
        coming = replace(coming, at=(x, y, z))
        if frozenset((coming.id, standing.id)) in self.contact and self._slides(coming, standing, leg, screwed):
            return "mesh", 0.0
        key = self._alike(coming, standing, leg)
        if key not in self.done:
            self.done[key] = self._decided(coming, standing, leg)
        return self.done[key]

    def _alike(self, coming: Instance, standing: Instance, leg: Leg) -> object:
        """What tells a pair on its way from others."""
        if coming.axis != UPWARDS or standing.axis != UPWARDS:
            return coming.id, standing.id, leg
        turn = cmath.rect(1.0, -standing.rotation)
        offset, way = (coming.centre - standing.centre) * turn, complex(leg.way[0], leg.way[1]) * turn
        rotation = coming.rotation - standing.rotation
        # as seen from what stands, which looks alike so often in a turn
        alike, seen = self._count(standing.part), cmath.phase(offset) if abs(offset) > _NONE else 0.0
        about = -seen if not alike else -math.tau / alike * math.floor(seen / math.tau * alike + _NEAR)
        offset, way, rotation = offset * cmath.rect(1.0, about), way * cmath.rect(1.0, about), rotation + about
        own = self._count(coming.part)
        turned = math.remainder(rotation, math.tau / own) if own else 0.0
        lift = coming.at[2] - standing.at[2]
        numbers = (offset.real, offset.imag, way.real, way.imag, leg.way[2], leg.length, lift, turned)
        return coming.part, standing.part, *(round(x, _DIGITS) + 0.0 for x in numbers)

    def _count(self, part: str) -> int:
        """How often it looks alike in a turn; 0: it is round."""
        return shape_of(self.parts[part]).count(0.0, math.inf)

    def _slides(self, coming: Instance, standing: Instance, leg: Leg, screwed: bool) -> bool:
        """Whether gears in contact slide along their teeth, helical ones as they are screwed, no herringbones; a worm
        by its thread: what goes before it is no thicker.
        """
        if all(self.parts[i.part].is_plate for i in (coming, standing)):
            helix = helix_of(self.parts[coming.part].keys)
            return abs(abs(leg.way[2]) - 1) < _NONE and (not helix.angle or (screwed and not helix.double))
        made = self.sections.made(coming.part)
        if not screwed or not isinstance(made.thing, WormBody) or made.half is None:
            return False
        ahead = math.fsum(a * b for a, b in zip(coming.axis, leg.way, strict=True))
        root, end = made.thing.thread.worm.root_radius, made.thing.length / 2
        before = made.half.real[made.half.imag * ahead > end + TOUCH]
        if abs(abs(ahead) - 1) > _NONE or (len(before) and before.max() > root + TOUCH):
            return False
        # what follows the thread stays on its side of the wheel
        behind = made.half[made.half.imag * ahead < -end - TOUCH]
        thick = behind[behind.real > root + TOUCH]
        if not len(thick):
            return True
        nearest = float((-thick.imag * ahead).min())
        # from the wheel's axis, whatever the height at which its frame stands
        away = [a - b for a, b in zip(coming.at, standing.at, strict=True)]
        up = math.fsum(a * b for a, b in zip(away, standing.axis, strict=True))
        beside = math.dist(away, [up * x for x in standing.axis])
        reach = self.parts[standing.part].body(0.0).section_reach()
        return math.hypot(max(beside - float(thick.real.max()), 0.0), nearest) > reach

    def _decided(self, coming: Instance, standing: Instance, leg: Leg) -> tuple[str, float | None]:
        upright = coming.axis == UPWARDS == standing.axis
        along = math.fsum(a * b for a, b in zip(coming.axis, leg.way, strict=True))
        straight = abs(abs(along) - 1) < _NONE
        same = max(abs(a - b) for a, b in zip(coming.axis, standing.axis, strict=True)) < _NONE
        if straight and same and self.sections.lets_in(coming, standing, round(along)):
            return "sections", 0.0
        if upright and abs(along) < _NONE and self._goes_in(coming, standing, leg):
            return "sections", 0.0
        if upright and (straight or abs(along) < _NONE) and self._by_layers(coming, standing, leg):
            return "layers", 0.0
        try:
            return "solids", common_volume((self._way(coming, leg), self._solid(standing)))
        except GeometryError:
            return "solids", None

    def _goes_in(self, coming: Instance, standing: Instance, leg: Leg) -> bool:
        """Whether what goes straight to or from the axis of the other is clear of it at any turn."""
        offset, way = coming.centre - standing.centre, complex(leg.way[0], leg.way[1])
        if abs((offset * way.conjugate()).imag) > _NONE * max(abs(offset), 1.0):
            return False
        inner, outer = abs(offset), abs(offset - way * leg.length)
        if (offset * way.conjugate()).real > 0 and outer > inner:
            return False
        near, far = sorted((inner, outer))
        lift = coming.at[2] - standing.at[2]
        return self.sections.pass_each_other(standing.part, 0j, coming.part, near, far, lift)

    def _by_layers(self, coming: Instance, standing: Instance, leg: Leg) -> bool:
        import shapely

        if not all(self.sections.made(i.part).known for i in (coming, standing)):
            return False
        (ends, own), (levels, others) = self._laid(coming), self._laid(standing)
        back = -complex(leg.way[0], leg.way[1]) * min(leg.length, self._span)
        for (low, high), piece in zip(ends, own, strict=True):
            if leg.way[2]:
                # from above all that ends above its lower face is in its way
                low, high = (low, math.inf) if leg.way[2] < 0 else (-math.inf, high)
            meets = others[(levels[:, 1] > low + TOUCH) & (levels[:, 0] < high - TOUCH)]
            if len(meets) and shapely.intersects(piece if leg.way[2] else drawn_along(piece, back), meets).any():
                return False
        return True

    def _laid(self, instance: Instance) -> tuple[Real, Any]:
        """Levels (n, 2) of the sections of an upright instance in its place, and these, a touch within it."""
        import shapely

        key = instance.id, instance.at
        if key not in self.laid:
            levels, pieces = zip(*((row[:2], row[2]) for row in self.sections.made(instance.part).plan), strict=True)
            turn, centre = cmath.rect(1.0, instance.rotation), instance.centre

            def moved(xy: Real) -> Real:
                points: Complex = (xy[:, 0] + 1j * xy[:, 1]) * turn + centre
                return np.column_stack([points.real, points.imag])

            within = shapely.buffer(shapely.transform(np.array(pieces), moved), -TOUCH, join_style="mitre")
            self.laid[key] = np.array(levels) + instance.at[2], within
        return self.laid[key]

    def _way(self, coming: Instance, leg: Leg) -> Any:
        """A solid about all that a part passes, its boundaries within it: turned and drawn out, or a hull."""
        import manifold3d
        import shapely
        from shapely.geometry.polygon import orient

        made = self.sections.made(coming.part)
        far = min(leg.length, self._span)
        along = math.fsum(a * b for a, b in zip(coming.axis, leg.way, strict=True))
        if made.half is not None and abs(abs(along) - 1) < _NONE:
            half = shapely.make_valid(shapely.Polygon(np.column_stack([made.half.real, made.half.imag])))
            drawn = drawn_along(half.buffer(-TOUCH, join_style="mitre"), -1j * along * far)
            # counter-clockwise, else they enclose nothing
            rings = [np.asarray(orient(p).exterior.coords)[:-1].tolist() for p in shapely.get_parts(drawn)]
            solid = manifold3d.Manifold.revolve(manifold3d.CrossSection(rings), _ROUND)
            if solid.is_empty():
                raise GeometryError(f"no solid lies about the way of {coming.id}")
            return placed_solid(coming, solid)
        inner = inner_solid(self.parts[coming.part])
        if abs(abs(along) - 1) < _NONE:
            *_, low, _, _, high = inner.bounding_box()
            drawn = manifold3d.Manifold.extrude(inner.project(), high - low + far)
            return placed_solid(coming, drawn.translate([0.0, 0.0, low - (far if along > 0 else 0.0)]))
        stands = placed_solid(coming, inner)
        back = stands.translate([-x * far for x in leg.way])
        return manifold3d.Manifold.batch_hull([stands, back])

    @property
    def _span(self) -> float:
        """Across all that there is, mm."""
        return float(np.linalg.norm(self.boxes[:, 1].max(axis=0) - self.boxes[:, 0].min(axis=0)))

    def _solid(self, standing: Instance) -> Any:
        """What stands, in its place; a worm by its hull. What was asked for long ago makes room."""
        found = self.solids.pop(standing.id, None)
        if found is None:
            hull = self.sections.made(standing.part).hull
            found = placed_solid(standing, hull or inner_solid(self.parts[standing.part]))
        self.solids[standing.id] = found
        kept = [solid.num_tri() for solid in self.solids.values()]
        while sum(kept) > _MOST_PLACED and len(kept) > 1:
            del self.solids[next(iter(self.solids))], kept[0]
        return found


def _box(instance: Instance, part: Part) -> Real:
    """Between which corners an instance lies, (2, 3), mm."""
    body = part.blank(0.0)
    low, high, reach = body.levels()[0], body.levels()[-1], body.section_reach()
    axis, at = np.array(instance.axis), np.array(instance.at)
    wide = reach * np.sqrt(np.maximum(1 - axis**2, 0.0))
    ends = np.array([at + low * axis, at + high * axis])
    return np.array([ends.min(axis=0) - wide, ends.max(axis=0) + wide])
