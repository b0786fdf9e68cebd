"""Half a section made again from the dimensions of a drawing in DXF, by nothing but ezdxf and the corners of its keys.

Corners say which edges are drawn. Every number is taken off the DIMENSION entities: places along the axis
that a chain of dimensions joins, diameters, chamfers, radii. What no dimension tells is named, and what two tell.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

from ezdxf.document import Drawing

# mm, by which places in a file are off at most; digits of numbers that are compared
NEAR, DIGITS = 1e-5, 4
Corner = dict[str, float]
_ENLARGED = re.compile(r"A \(\d")
_RADIUS = re.compile(r"R(<>|\d)")


class Told:
    """What the dimensions of the view of one axis tell, in mm of the part."""

    def __init__(self, document: Drawing, corners: list[Corner]) -> None:
        self.corners = corners
        self.spans: list[tuple[float, float, float]] = []
        self.diameters: Counter[float] = Counter()
        self.chamfers: Counter[float] = Counter()
        self.radii: Counter[float] = Counter()
        low, high = min(c["z"] for c in corners), max(c["z"] for c in corners)
        most = max(c["r"] for c in corners) + max(abs(c.get("arc", 0.0)) for c in corners)
        scale = 1 / document.header["$DIMLFAC"]
        axes = [
            (e.dxf.start.x + 4.0, e.dxf.start.y) for e in document.modelspace().query("LINE[layer=='CENTRE']")
            if abs(e.dxf.start.y - e.dxf.end.y) < NEAR
            and abs(e.dxf.end.x - e.dxf.start.x - 8.0 - scale * (high - low)) < NEAR
        ]  # fmt: skip
        # of two views the first; its axis lies in the middle of the greatest diameter, those of holes beside it
        left = min(x for x, _ in axes)
        widest = max(
            (sorted((e.dxf.defpoint2.y, e.dxf.defpoint3.y)) for e in document.modelspace().query("DIMENSION")
             if abs(e.dxf.angle - 90.0) < NEAR and "%%c" in e.dxf.text),
            key=lambda ends: ends[1] - ends[0],
        )  # fmt: skip
        zero, axis = left - scale * low, sum(widest) / 2
        assert any(abs(y - axis) < NEAR for x, y in axes if x < left + NEAR)
        # what is enlarged stands on the right, and has numbers for words
        beside = [min(e.dxf.start.x, e.dxf.end.x) for e in document.modelspace().query("LINE[layer=='OUTLINE']")]
        enlarged = min((x for x in beside if x > zero + scale * high + NEAR), default=math.inf)
        if not any(_ENLARGED.match(text.dxf.text) for text in document.modelspace().query("TEXT")):
            enlarged = math.inf
        for entity in document.modelspace().query("DIMENSION"):
            factor = document.dimstyles.get(entity.dxf.dimstyle).dxf.dimlfac
            ends = [entity.dxf.defpoint2, entity.dxf.defpoint3]
            places = [((p.x - zero) / scale, (p.y - axis) / scale) for p in ends]
            if abs(factor * scale - 1) > NEAR:
                places = [(low + (p.x - enlarged) * factor, 0.0) for p in ends]
            # a radius is told from its centre, which may lie anywhere, to its arc
            seen = places[1:] if _RADIUS.search(entity.dxf.text) else places
            if all(low - 10 * NEAR < z < high + 10 * NEAR and abs(r) < most + NEAR for z, r in seen):
                self._read(entity, float(entity.get_measurement()) * factor, places)

    def _read(self, entity: Any, value: float, places: list[tuple[float, float]]) -> None:
        text, (first, second) = entity.dxf.text, places
        number = re.match(r"(\d+) chamfers? |.*\((\d+) places?\)$", text)
        count = int(number[1] or number[2]) if number else 1
        if "×45°" in text:
            self.chamfers[round(value, DIGITS)] += count
        elif _RADIUS.search(text):
            self.radii[round(value, DIGITS)] += count
        elif "%%c" in text:
            assert abs(first[1] + second[1]) < NEAR
            self.diameters[round(value, DIGITS)] += count
        elif abs(entity.dxf.angle - 90.0) < NEAR:
            # how far a hole that stands alone lies off the axis
            assert abs(first[1]) < NEAR
            self.diameters[round(2 * value, DIGITS)] += 1
        else:
            assert abs(entity.dxf.angle) < NEAR
            self.spans.append((first[0], second[0], value))

    def faults(self, circles: Iterable[float] = (), places: Iterable[float] = ()) -> list[str]:
        """What is not told, what is told twice, what is told of no corner.

        Pitch ``circles`` of holes by their diameter and ``places`` of keyways must be told too.
        """
        edges = list(pairwise([*self.corners, self.corners[0]]))
        found = [*self._features(edges)]
        bound = dict(self._bound(edges))
        slants = [(a, b) for a, b in edges if not a.get("arc") and _leg(a, b) in self.chamfers]
        # radii are told, or follow from their chamfer or arc
        radii = {round(2 * c["r"], DIGITS) for c in self.corners if c["r"]}
        radii |= {round(d, DIGITS) for d in circles}
        pairs = [{round(2 * p["r"], DIGITS) for p in slant} for slant in slants]
        follow = {d for pair in pairs for d in pair if (pair - {d}) & set(self.diameters)}
        found += [f"diameter {d:g} is not told" for d in sorted(radii - set(self.diameters) - follow)]
        found += [f"diameter {d:g} is no corner's" for d in set(self.diameters) - radii - set(bound.values())]
        found += [f"diameter {d:g} is told though its chamfer is" for d in follow & set(self.diameters)]
        found += [
            f"diameter {d:g} is told of {self.diameters[d]} places, not of {count}"
            for d, count in _cylinders(edges).items() if self.diameters[d] not in (0, count)
        ]  # fmt: skip
        # places along the axis: a tree of spans
        levels = sorted({round(z, DIGITS) for z in (*(c["z"] for c in self.corners), *places)})
        roots = {z: z for z in levels}

        def root(z: float) -> float:
            return z if roots[z] == z else root(roots[z])

        for a, b in [*bound, *((round(a["z"], DIGITS), round(b["z"], DIGITS)) for a, b in slants)]:
            roots[root(a)] = root(b)
        for start, end, value in self.spans:
            pair = [min(levels, key=lambda z, at=at: abs(z - at)) for at in (start, end)]  # type: ignore[misc]
            if max(abs(pair[0] - start), abs(pair[1] - end)) > 10 * NEAR:
                found.append(f"length {value:g} ends at no corner")
            elif abs(abs(pair[1] - pair[0]) - value) > 2 * 10**-DIGITS:
                found.append(f"length {value:g} is not that of its corners")
            elif root(pair[0]) == root(pair[1]):
                found.append(f"length {value:g} is told twice")
            else:
                roots[root(pair[0])] = root(pair[1])
        found += [f"z = {z:g} is not told" for z in levels if root(z) != root(levels[0])]
        return found

    def _features(self, edges: list[tuple[Corner, Corner]]) -> Iterator[str]:
        """Chamfers, fillets and arcs, each as often as it is there."""
        chamfers = Counter(round(c["chamfer"], DIGITS) for c in self.corners if c.get("chamfer"))
        # a line of 45 degrees between one along the axis and one across it is one too
        size = len(edges)
        for k, (a, b) in enumerate(edges):
            beside = {_turn(*edges[k - 1]), _turn(*edges[(k + 1) % size])}
            if not a.get("arc") and _leg(a, b) and beside == {0.0, 90.0}:
                chamfers[_leg(a, b)] += 1
        arcs = Counter(round(c["fillet"], DIGITS) for c in self.corners if c.get("fillet"))
        balls = Counter[float]()
        for a, b in edges:
            if radius := round(abs(a.get("arc", 0.0)), DIGITS):
                (balls if a["r"] == b["r"] == 0 else arcs)[radius] += 1
        for name, wanted, told in (("chamfer", chamfers, self.chamfers), ("radius", arcs, self.radii)):
            for value in {*wanted, *told}:
                if wanted[value] != told[value]:
                    yield f"{name} {value:g} is told of {told[value]} places, not of {wanted[value]}"
        for radius in balls:
            if round(2 * radius, DIGITS) not in self.diameters:
                yield f"sphere {2 * radius:g} is not told"

    def _bound(self, edges: list[tuple[Corner, Corner]]) -> Iterator[tuple[tuple[float, float], float]]:
        """Places whose distance an arc's radius tells: about the axis or half a circle, with its diameter; smooth."""
        for a, b in edges:
            radius, chord = abs(a.get("arc", 0.0)), math.dist((a["r"], a["z"]), (b["r"], b["z"]))
            if not radius or a["z"] == b["z"]:
                continue
            middle, lift = ((a["r"] + b["r"]) / 2, (a["z"] + b["z"]) / 2), math.sqrt(max(radius**2 - chord**2 / 4, 0))
            centres = [middle[0] + way * lift * (b["z"] - a["z"]) / chord for way in (1, -1)]
            if min(map(abs, centres)) < NEAR or lift < NEAR * radius:
                yield (round(a["z"], DIGITS), round(b["z"], DIGITS)), round(2 * radius, DIGITS)
                continue
            # one that goes on smoothly from a cylinder ends where its radius meets the next diameter
            heights = [middle[1] - way * lift * (b["r"] - a["r"]) / chord for way in (1, -1)]
            if any(abs(z - end["z"]) < NEAR for z in heights for end in (a, b)):
                yield (round(a["z"], DIGITS), round(b["z"], DIGITS)), 0.0


def _cylinders(edges: list[tuple[Corner, Corner]]) -> Counter[float]:
    """How many cylinders have a diameter; one that a groove shorter than either half parts is one."""
    area = sum(a["z"] * b["r"] - b["z"] * a["r"] for a, b in edges)
    rows: dict[tuple[float, bool], list[tuple[int, float]]] = {}
    for k, (a, b) in enumerate(edges):
        if a["r"] == b["r"] > 0 and not a.get("arc"):
            rows.setdefault((a["r"], (b["z"] - a["z"]) * area < 0), []).append((k, abs(b["z"] - a["z"])))
    found: Counter[float] = Counter()
    for (r, is_outside), places in rows.items():
        found[round(2 * r, DIGITS)] += 1
        for (k, one), (n, two) in pairwise(places):
            between, gap = [a["r"] for a, _ in edges[k + 1 : n + 1]], abs(edges[n][0]["z"] - edges[k][1]["z"])
            parted = all(x <= r if is_outside else x >= r for x in between)
            found[round(2 * r, DIGITS)] += not (parted and gap < min(one, two))
    return found


def _leg(a: Corner, b: Corner) -> float:
    """Of a line of 45 degrees, else 0."""
    dz, dr = abs(a["z"] - b["z"]), abs(a["r"] - b["r"])
    return round(dz, DIGITS) if dz and math.isclose(dz, dr, rel_tol=1e-9) else 0.0


def _turn(a: Corner, b: Corner) -> float:
    return round(math.degrees(math.atan2(abs(b["r"] - a["r"]), abs(b["z"] - a["z"]))), 6)
