"""STEP files read back by our own reader: names, colours, places and units around the solids of read_brep.py.

Products, occurrences and styles are those of ISO 10303-214 in the form that kernels write: a representation of a
solid, or of an assembly, for each product, and a placed relation between two for each occurrence.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from exporters.formats.chains import nodes, smooth_loops
from exporters.formats.read_assembly import Occurrence, Prototype, ReadAssembly
from exporters.formats.read_brep import Followed, read_model
from exporters.formats.read_part21 import (
    ASSEMBLY,
    CENTIMETRE,
    GRAM,
    MILLIMETRE,
    PART,
    Entities,
    Item,
    Real,
    read_part21,
)
from exporters.formats.read_solid import GAP, LOOSEST, Model
from exporters.formats.readback import SmoothLoop
from geometry.base.record import Record, replace
from parts.base.readback import ReadError, refuse_if

_SHADES = {
    "red": "#ff0000", "green": "#00ff00", "blue": "#0000ff", "yellow": "#ffff00", "magenta": "#ff00ff",
    "cyan": "#00ffff", "black": "#000000", "white": "#ffffff",
}  # fmt: skip
# what is said of a part: its kind, what its value is called (None: as it is), what it measures, and powers of its units
_SAID: dict[str, tuple[str, str | None, tuple[str, ...], dict[str, float]]] = {
    "material name": ("material property", None, (), {}),
    "density": ("material property", "g/cm3", ("POSITIVE_RATIO",), {GRAM: 1.0, CENTIMETRE: -3.0}),
    "volume": ("geometric validation property", "volume measure", ("VOLUME",), {MILLIMETRE: 3.0}),
    "surface area": ("geometric validation property", "surface area measure", ("AREA",), {MILLIMETRE: 2.0}),
}
# how wide edges are drawn, mm
_THIN = 0.1
# what stands at the origin is off it by no more, mm and rad
_HOME = 1e-12
Place = NDArray[np.float64]


class ReadSolid(Record, eq=False):
    """One solid, the names of the products in its file, its colour and what it says of itself, where it does.

    ``said``: words or numbers under "title", "material name", "density" (g/cm^3), "volume" (mm^3),
    "surface area" (mm^2); ``precision``: within which it calls points one, mm.
    """

    model: Model
    products: tuple[str, ...]
    colour: str | None = None
    said: Mapping[str, str | float] = {}
    precision: float = GAP
    has_arcs: ClassVar[bool] = False
    is_flat: ClassVar[bool] = False

    def names(self) -> tuple[str, ...]:
        """The products."""
        return self.products

    def section(self, z: float) -> tuple[SmoothLoop, ...]:
        """The upright walls at a height: the edges at their feet."""
        model = self.model
        low, high = model.heights
        walls = np.flatnonzero(model.is_upright & (low < z) & (z < high))
        points = model.curves.at(nodes())[0][model.feet(walls)[0]]
        return smooth_loops(list(points[..., 0] + 1j * points[..., 1]))

    def faces(self) -> Real:
        """None: its faces are not triangles."""
        return np.zeros((0, 3, 3))


def read_step(file: Path) -> ReadSolid:
    """The single solid of a STEP file."""
    products = _Products(read_part21(file))
    refuse_if(len(products.model.solids) != 1, f"{len(products.model.solids)} solids instead of 1")
    found = products.prototype(next(iter(products.shapes))).part if len(products.names) == 1 else None
    names = tuple(products.names.values())
    return replace(found, products=names) if isinstance(found, ReadSolid) else ReadSolid(products.model, names)


def read_step_assembly(file: Path) -> ReadAssembly:
    """The parts of a STEP file in their places, or a single one in its own."""
    products = _Products(read_part21(file))
    top = [definition for definition in products.names if definition not in products.used]
    refuse_if(len(top) != 1, f"{len(top)} products stand alone in the STEP file instead of 1")
    found = list(products.parts(top[0], np.eye(3, 4), ()))
    kinds = list(dict.fromkeys(definition for _, definition, _, _ in found))
    return ReadAssembly(
        products.names[top[0]],
        [products.prototype(definition) for definition in kinds],
        [Occurrence(name, kinds.index(definition), place, within) for name, definition, place, within in found],
    )


class _Products:
    """Products, their solids and colours, and where others stand in them."""

    def __init__(self, entities: Entities) -> None:
        self.items = entities.items
        self.of_kind = defaultdict[str, list[tuple[int, Item]]](list)
        for number, item in self.items.items():
            self.of_kind[item.kind].append((number, item))
        read = Followed(entities)
        self.model = read_model(read)
        self.axes = self._axes(read)
        # definitions of products: their names, what represents them, and how they are used in others
        self.titles: dict[str, str] = {}
        self.descriptions: dict[str, str] = {}
        self.names = {n: self._name(item) for n, item in self.of_kind["PRODUCT_DEFINITION"]}
        self.shapes: dict[int, Item] = {}
        self.representations: dict[int, int] = {}
        for number, item in self.of_kind["SHAPE_DEFINITION_REPRESENTATION"]:
            whole, shape = item.references
            (definition,) = self.items[whole].references
            if definition in self.shapes or definition not in self.names:
                raise ReadError(f"#{number} of the STEP file represents no product, or one that is represented")
            self.shapes[definition], self.representations[definition] = self.items[shape], shape
            self._check_axes(shape)
        self.used = {item.references[1] for _, item in self.of_kind["NEXT_ASSEMBLY_USAGE_OCCURRENCE"]}
        for definition, item in self.shapes.items():
            own = self.names[definition]
            if item.kind == ASSEMBLY and (own in self.titles or own in self.descriptions):
                raise ReadError(f"{own} in the STEP file is an assembly with another title, or with a description")
        self.inside: dict[int, list[tuple[str, int, Place]]] = {}
        self._place()
        self.colours: dict[int, str] = {}
        for number, item in self.of_kind["STYLED_ITEM"]:
            *styles, solid = item.references
            refuse_if(solid in self.colours, f"#{number} of the STEP file colours a solid that has a colour")
            self.colours[solid] = self._shade(styles)
        self.said: dict[int, dict[str, str | float]] = {}
        for number, item in self.of_kind["PROPERTY_DEFINITION_REPRESENTATION"]:
            self._say(number, *(self.items[n] for n in item.references))
        held = Counter(solid for shape in self.shapes.values() for solid in shape.references)
        if any(held[solid] != 1 for solid in self.model.solids.tolist()):
            raise ReadError("a solid of the STEP file is not that of one product")
        for number, item in self.of_kind["UNCERTAINTY_MEASURE_WITH_UNIT"]:
            if not 0 < item.numbers[0] <= LOOSEST:
                raise ReadError(f"#{number} of the STEP file does not call points one within {LOOSEST:g} mm")

    def parts(self, definition: int, place: Place, above: tuple[int, ...]) -> Iterator[tuple[str, int, Place, str]]:
        """What stands in a product, and in what stands there: name, product, place and what it stands in; or itself."""
        refuse_if(definition in above, "a product of the STEP file stands in itself")
        if definition not in self.inside:
            yield self.names[definition], definition, place, ""
        own = self.names[definition] if above else ""
        for name, product, where in self.inside.get(definition, []):
            moved = np.column_stack([place[:, :3] @ where[:, :3], place[:, :3] @ where[:, 3] + place[:, 3]])
            for inner, part, its, within in self.parts(product, moved, (*above, definition)):
                yield (name, part, its, own) if part == product else (inner, part, its, within)

    def prototype(self, definition: int) -> Prototype:
        """A product that is a part."""
        name, shape = self.names[definition], self.shapes.get(definition)
        solids = [n for n in shape.references if n in self.model.solids] if shape else []
        if shape is None or len(solids) != 1:
            raise ReadError(f"{name} has {len(solids)} solids instead of 1")
        colour = self.colours.get(solids[0])
        model = self.model.only(self.model.solids.tolist().index(solids[0]))
        told = {"title": self.titles.get(name), "description": self.descriptions.get(name)}
        said = {**self.said.get(definition, {}), **{key: text for key, text in told.items() if text}}
        (precision,) = self.items[self.items[shape.references[-1]].references[0]].numbers
        return Prototype(name, ReadSolid(model, (name,), colour, said, precision), colour)

    def _name(self, definition: Item) -> str:
        (product,) = self.items[definition.references[0]].references
        identity, name, description = self.items[product].strings
        if description:
            self.descriptions[identity] = description
        if identity != name:
            self.titles[identity] = name
        return identity

    def _axes(self, read: Followed) -> dict[int, tuple[Real, Real]]:
        """Origin (3,) and axes (3, 3) of each place that products name, all looked up at once."""
        known = set(read.ids("AXIS2_PLACEMENT_3D").tolist())
        named = {n for item in self.items.values() for n in item.references if n in known}
        found = read.placed(ids := np.array(sorted(named), np.int64), ids)
        return dict(zip(sorted(named), zip(found.origins, found.axes, strict=True), strict=True))

    def _check_axes(self, number: int) -> None:
        """A part stands at its own origin."""
        shape = self.items[number]
        if shape.kind == ASSEMBLY:
            return
        homes = (self.axes[n] for n in shape.references[:-1] if n in self.axes)
        if not all(np.abs(x).max() <= _HOME for origin, axes in homes for x in (origin, axes - np.eye(3))):
            raise ReadError(f"#{number} of the STEP file has another origin than its part")

    def _place(self) -> None:
        """What stands in each product: the place's axes in it, after those in what stands there."""
        uses = {n: item for n, item in self.of_kind["NEXT_ASSEMBLY_USAGE_OCCURRENCE"]}
        if {use.strings[0] for use in uses.values()} != {str(k + 1) for k in range(len(uses))}:
            raise ReadError("the components of the STEP file are not numbered one by one")
        assemblies = {definition for definition, item in self.shapes.items() if item.kind == ASSEMBLY}
        for number, item in self.of_kind["CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"]:
            relation, (occurrence,) = (self.items[n].references for n in item.references)
            refuse_if(occurrence not in uses, f"#{number} of the STEP file places nothing, or something twice")
            use = uses.pop(occurrence)
            outer, inner = use.references
            if inner in assemblies and use.strings[1] != self.names[inner]:
                raise ReadError(f"{self.names[inner]} in the STEP file stands there as {use.strings[1]}")
            own, whole, move = relation
            if (self.representations.get(inner), self.representations.get(outer)) != (own, whole):
                raise ReadError(f"#{number} of the STEP file places another product than it names")
            axes = self.items[move].references
            if any(n not in self.items[shape].references for n, shape in zip(axes, (own, whole), strict=True)):
                raise ReadError(f"#{move} of the STEP file moves between axes that are none of its products'")
            (origin, inside), (moved, outside) = (self.axes[n] for n in axes)
            turn = outside.T @ inside
            place = np.column_stack([turn, moved - turn @ origin])
            self.inside.setdefault(outer, []).append((use.strings[1], inner, place))
        if uses:
            raise ReadError(f"#{min(uses)} of the STEP file is a component without a place")

    def _say(self, number: int, what: Item, value: Item) -> None:
        """A property of a product, or of its shape."""
        kind, name = what.strings
        of, item = self.items[what.references[0]], self.items[value.references[0]]
        product = of.references[0] if of.kind == "PRODUCT_DEFINITION_SHAPE" else what.references[0]
        units: dict[str, float] = {}
        for element in self.items[item.references[0]].references if item.references else ():
            (unit,), (power,) = self.items[element].references, self.items[element].numbers
            units[self.items[unit].kind] = units.get(self.items[unit].kind, 0.0) + power
        said = self.said.setdefault(product, {})
        told = (kind, item.strings[0] if item.numbers else None, item.measures, units)
        is_part = product in self.shapes and self.shapes[product].kind == PART
        if name in said or not is_part or told != _SAID.get(name) or value.strings[0] != name:
            raise ReadError(f"#{number} of the STEP file says something of no part, twice, or in other words or units")
        if not item.numbers and len(set(item.strings)) > 1:
            raise ReadError(f"#{number} of the STEP file says {' and '.join(item.strings)} of its {name}")
        said[name] = item.numbers[0] if item.numbers else item.strings[1]

    def _shade(self, styles: list[int]) -> str:
        """The one colour that styles lead to."""
        found, left, kinds = set[str](), list(styles), set[str]()
        while left:
            item = self.items[left.pop()]
            kinds.add(item.kind)
            left += item.references
            if item.kind == "COLOUR_RGB":
                found.add("#" + "".join(f"{round(255 * x):02x}" for x in item.numbers))
            elif item.kind == "DRAUGHTING_PRE_DEFINED_COLOUR":
                found.add(_SHADES.get(item.strings[0], ""))
            elif item.kind == "CURVE_STYLE" and item.numbers != (_THIN,):
                raise ReadError(f"edges in the STEP file are lines of {item.numbers[0]} mm")
        if len(found) != 1 or "FILL_AREA_STYLE_COLOUR" not in kinds:
            raise ReadError(f"{len(found)} colours of one solid in the STEP file")
        return found.pop()
