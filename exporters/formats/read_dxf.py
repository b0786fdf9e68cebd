"""Read-back of laser DXF: the pairs of the file, its sections, handles and layers, and its polylines.

Shares no code with the writer, nor with ezdxf, whose import takes longer than making the file.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from exporters.formats.readback import Loop, ReadOutlines
from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.base.readback import ReadError, refuse_if

_MILLIMETRES = "4"
# groups that point at a handle, and those that are one
_POINTERS = (*range(320, 370), *range(390, 400))
_HANDLE, _DIMSTYLE_HANDLE = 5, 105
_OWNER, _ON_LAYER, _EXTENDED = 330, 8, 1000
# bits of a layer's flags: frozen, frozen in new viewports
_FROZEN = 1 | 2
# by its colour a laser program knows what to do along a contour
_COLOURS = {"ENGRAVE": 5, "CUT_INNER": 3, "CUT_OUTER": 1}
# groups of a polyline that give its shape and structure; others must say no more than their absence
_SHAPE = {0, 5, 8, 10, 20, 42, 66, 70, 90, 91, 100, 102, 210, 220, 230, 330, 360}
_PLAIN_NUMBERS = {30: 0.0, 38: 0.0, 39: 0.0, 40: 0.0, 41: 0.0, 43: 0.0, 48: 1.0, 60: 0.0, 62: 256.0, 67: 0.0,
                  71: 0.0, 72: 0.0, 73: 0.0, 74: 0.0, 75: 0.0, 370: -1.0}  # fmt: skip
# lines of a cut are thin, in hundredths of a mm; below 0: as programs draw them
_WIDEST = 25
_PLAIN_WORDS = {6: {"BYLAYER"}, 410: {"MODEL"}}
_EXTRUSION = (210, 220, 230)


class Pairs(Record):
    """Group codes (n,) and the values that stand with them."""

    codes: NDArray[np.int64]
    values: list[str]

    def part(self, start: int, end: int) -> Pairs:
        """The pairs from one place to another."""
        return Pairs(self.codes[start:end], self.values[start:end])

    def starts(self) -> NDArray[np.int64]:
        """Where a record begins."""
        return np.flatnonzero(self.codes == 0)

    def records(self) -> Iterator[Pairs]:
        """What stands from each group 0 to the next."""
        edges = [*self.starts().tolist(), len(self.values)]
        return (self.part(a, b) for a, b in pairwise(edges))

    def first(self, code: int, default: str = "") -> str:
        """The first value with a group code."""
        found = np.flatnonzero(self.codes == code)
        return self.values[found[0]] if len(found) else default

    def numbers(self, code: int) -> Real:
        """All values with a group code, as numbers."""
        return np.array([self.values[i] for i in np.flatnonzero(self.codes == code)], dtype=np.float64)


def read_dxf(file: Path) -> ReadOutlines:
    """The closed polylines of a laser DXF in mm, and open ones that are engraved; everything else is an error.

    Raises
    ------
    ReadError
        The file is no whole DXF, not in mm, its handles or layers contradict each other, or it holds something else.
    """
    try:
        sections = _sections(_pairs(file))
        header = _header(sections)
        if header.get("$ACADVER", "AC1009") > "AC1009" and header.get("$INSUNITS") != _MILLIMETRES:
            raise ReadError("the DXF is not in mm ($INSUNITS is not 4)")
        _check_handles(sections, int(header.get("$HANDSEED", "0"), 16))
        chains = tuple(_chains(sections["ENTITIES"], _model_space(sections)))
        layers = _layers(sections)
    except (ValueError, LookupError, OSError) as error:
        if isinstance(error, ReadError):
            raise
        raise ReadError(f"not a readable DXF: {error}") from error
    if strange := {loop.layer for loop, _ in chains} - layers:
        raise ReadError(f"the DXF has no layer {strange.pop()}, on which a contour stands")
    order = [closed for _, closed in chains]
    refuse_if(order != sorted(order), "an engraved line comes after a closed contour")
    return ReadOutlines(
        tuple(loop for loop, closed in chains if closed), tuple(loop.vertices for loop, closed in chains if not closed)
    )


def _pairs(file: Path) -> Pairs:
    lines = file.read_text(encoding="latin-1").splitlines()
    refuse_if(len(lines) % 2, "not a readable DXF: it ends within a pair of lines")
    pairs = Pairs(np.array(list(map(int, lines[::2])), dtype=np.int64), [v.strip() for v in lines[1::2]])
    refuse_if(not lines or (pairs.codes[-1], pairs.values[-1]) != (0, "EOF"), "not a readable DXF: it ends too early")
    return pairs


def _sections(pairs: Pairs) -> dict[str, Pairs]:
    """What stands between each SECTION and its ENDSEC."""
    sections, name, begin = {}, "", 0
    for at in pairs.starts().tolist():
        word = pairs.values[at]
        if word == "SECTION" and not name and pairs.codes[at + 1] == 2:
            name, begin = pairs.values[at + 1], at + 2
        elif word == "ENDSEC" and name:
            sections[name], name = pairs.part(begin, at), ""
        elif word in ("SECTION", "ENDSEC", "EOF") and (name or word != "EOF"):
            raise ReadError(f"not a readable DXF: {word} in the wrong place")
    if missing := {"HEADER", "TABLES", "ENTITIES"} - sections.keys():
        raise ReadError(f"not a readable DXF: it has no section {missing.pop()}")
    return sections


def _header(sections: dict[str, Pairs]) -> dict[str, str]:
    """The first value of every variable."""
    header = sections["HEADER"]
    names = np.flatnonzero(header.codes == 9)
    return {header.values[i]: header.values[i + 1] for i in names.tolist()}


def _layers(sections: dict[str, Pairs]) -> set[str]:
    """The layers; those of a laser must be seen and plotted, in the colour by which it knows what to do."""
    found: set[str] = set()
    for record in sections["TABLES"].records():
        name = record.first(2)
        if record.values[0] != "LAYER":
            continue
        refuse_if(name.upper() in {known.upper() for known in found}, f"the DXF has two layers {name}")
        found.add(name)
        if name.upper() not in _COLOURS:
            continue
        colour, own = int(record.first(62, "7")), _COLOURS[name.upper()]
        for is_so, what in (
            (int(record.first(70, "0")) & _FROZEN, "is frozen"),
            (colour < 0, "is off"),
            (record.first(290, "1") == "0", "is not plotted"),
            (colour != own or len(record.numbers(420)), f"has another colour than {own}"),
            ("AcCmTransparency" in record.values, "is transparent"),
            (record.first(6, "Continuous").upper() != "CONTINUOUS", "is not drawn through"),
            (int(record.first(370, "-3")) > _WIDEST, f"is drawn wider than {_WIDEST / 100} mm"),
        ):
            refuse_if(is_so, f"layer {name} {what}")
    return found


def _model_space(sections: dict[str, Pairs]) -> str:
    """The handle of what owns the entities of the model; empty in a DXF without such records."""
    records = [r for r in sections["TABLES"].records() if r.values[0] == "BLOCK_RECORD"]
    return next((r.first(_HANDLE) for r in records if r.first(2).upper() == "*MODEL_SPACE"), "")


def _check_handles(sections: dict[str, Pairs], seed: int) -> None:
    """Every handle is there once and below the seed, and every pointer finds one."""
    handles: list[str] = []
    pointers: set[str] = set()
    for name, pairs in sections.items():
        if name not in ("TABLES", "BLOCKS", "ENTITIES", "OBJECTS"):
            continue
        marks = np.flatnonzero(np.isin(pairs.codes, (0, _HANDLE, _DIMSTYLE_HANDLE)))
        kind = ""
        for at in marks.tolist():
            if pairs.codes[at] == 0:
                kind, code = pairs.values[at], _DIMSTYLE_HANDLE if pairs.values[at] == "DIMSTYLE" else _HANDLE
            elif pairs.codes[at] == code and kind:
                handles.append(pairs.values[at])
                kind = ""
        pointers |= {pairs.values[i] for i in np.flatnonzero(np.isin(pairs.codes, _POINTERS)).tolist()}
    known = set(handles)
    refuse_if(len(known) < len(handles), "the DXF uses a handle twice")
    if lost := pointers - known - {"0"}:
        raise ReadError(f"the DXF points at a handle {min(lost)} that is not there")
    if handles and max(int(h, 16) for h in handles) >= seed:
        raise ReadError("the DXF has a handle that its header ($HANDSEED) calls free")


def _chains(entities: Pairs, space: str) -> Iterator[tuple[Loop, bool]]:
    """The polylines, old style or new, of the model, whose handle is ``space``, and whether each is closed."""
    starts = entities.starts()
    heads = [i for i in starts.tolist() if entities.values[i] not in ("VERTEX", "SEQEND")]
    for start, end in zip(heads, [*heads[1:], len(entities.values)], strict=True):
        entity = entities.part(start, end)
        kind, layer = entity.values[0], entity.first(8)
        if kind not in ("LWPOLYLINE", "POLYLINE"):
            raise ReadError(f"a {kind} stands on layer {layer}; only closed polylines belong there")
        if space and entity.first(_OWNER, space) != space:
            raise ReadError(f"a {kind} on layer {layer} does not stand in the model")
        _check_plain(entity, kind, layer)
        closed = int(entity.first(70, "0")) & 1 == 1
        loop = _loop(entity, kind, layer)
        if not closed and (layer.upper() != "ENGRAVE" or np.any(loop.bulges) or len(loop.vertices) < 2):
            raise ReadError(f"an open or bent polyline on layer {layer}")
        yield loop, closed


def _check_plain(entity: Pairs, kind: str, layer: str) -> None:
    """Nothing hides an entity, lifts or broadens it, or gives it another look than its layer's."""
    # np.unique would load numpy.ma, which costs as much as a tenth of reading
    for code in sorted(set(entity.codes.tolist())):
        if code in _SHAPE or code >= _EXTENDED:
            continue
        values = {entity.values[i].upper() for i in np.flatnonzero(entity.codes == code)}
        if code in _PLAIN_NUMBERS:
            strange = {v for v in values if float(v) != _PLAIN_NUMBERS[code]}
        else:
            strange = values - _PLAIN_WORDS.get(code, set())
        if strange:
            raise ReadError(f"a {kind} on layer {layer} has {strange.pop()} for group {code}")
    if len({entity.values[i].upper() for i in np.flatnonzero(entity.codes == _ON_LAYER)}) > 1:
        raise ReadError(f"a {kind} on layer {layer} has vertices on another one")


def _loop(entity: Pairs, kind: str, layer: str) -> Loop:
    refuse_if(int(entity.first(70, "0")) & ~0x81, f"an open or bent polyline on layer {layer}")
    if any(np.any(entity.numbers(code) != (code == _EXTRUSION[-1])) for code in _EXTRUSION):
        raise ReadError(f"a polyline on layer {layer} lies in a plane of its own")
    if kind == "POLYLINE":
        begins = entity.starts()
        refuse_if(entity.values[begins[-1]] != "SEQEND", f"a polyline on layer {layer} has no SEQEND")
        # its own point comes before the vertices
        entity, told = entity.part(int(begins[1]), int(begins[-1])), len(begins) - 2
    else:
        told = int(entity.first(90))
    places = entity.codes == 10
    x, y = entity.numbers(10), entity.numbers(20)
    refuse_if(not len(x) == len(y) == told, f"a polyline on layer {layer} has {len(x)} vertices where {told} are told")
    bulges = np.zeros(told)
    bulges[(np.cumsum(places) - 1)[entity.codes == 42]] = entity.numbers(42)
    return Loop(x + 1j * y, bulges, layer)
