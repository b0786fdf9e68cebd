"""STEP files read back by our own reader: names, colours, places and units around the solids of read_brep.py.

Products, occurrences and styles are those of ISO 10303-214 in the form that kernels write: a representation of a
solid, or of an assembly, for each product, and a placed relation between two for each occurrence.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from exporters.formats.chains import nodes, smooth_loops
from exporters.formats.read_assembly import Occurrence, Prototype, ReadAssembly
from exporters.formats.read_brep import frames_of, read_model
from exporters.formats.read_part21 import CONTEXT, MILLIMETRE, PLACED, RADIAN, Entities, Item, Real, read_part21
from exporters.formats.read_solid import Model
from exporters.formats.readback import SmoothLoop
from geometry.base.record import Record, replace
from parts.base.readback import ReadError

_SHADES = {
    "red": "#ff0000", "green": "#00ff00", "blue": "#0000ff", "yellow": "#ffff00", "magenta": "#ff00ff",
    "cyan": "#00ffff", "black": "#000000", "white": "#ffffff",
}  # fmt: skip
# what stands at the origin is off it by no more, mm and rad
_HOME = 1e-12
Place = NDArray[np.float64]


class ReadSolid(Record, eq=False):
    """One solid, the names of the products in its file, its colour and what it says of itself, where it does.

    ``said``: words or numbers under "material name", "density" (g/cm^3), "volume" (mm^3).
    """

    model: Model
    products: tuple[str, ...]
    colour: str | None = None
    said: Mapping[str, str | float] = {}
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
    if len(products.model.solids) != 1:
        raise ReadError(f"{len(products.model.solids)} solids instead of 1")
    found = products.prototype(next(iter(products.shapes))).part if len(products.names) == 1 else None
    names = tuple(products.names.values())
    return replace(found, products=names) if isinstance(found, ReadSolid) else ReadSolid(products.model, names)


def read_step_assembly(file: Path) -> ReadAssembly:
    """The parts of a STEP file in their places, or a single one in its own."""
    products = _Products(read_part21(file))
    top = [definition for definition in products.names if definition not in products.used]
    if len(top) != 1:
        raise ReadError(f"{len(top)} products stand alone in the STEP file instead of 1")
    found = list(products.parts(top[0], np.eye(3, 4), ()))
    kinds = list(dict.fromkeys(definition for _, definition, _ in found))
    return ReadAssembly(
        products.names[top[0]],
        [products.prototype(definition) for definition in kinds],
        [Occurrence(name, kinds.index(definition), place) for name, definition, place in found],
    )


class _Products:
    """Products, their solids and colours, and where others stand in them."""

    def __init__(self, entities: Entities) -> None:
        self.items, self.entities = entities.items, entities
        self.model = read_model(entities)
        # definitions of products: their names, what represents them, and how they are used in others
        self.names = {n: self._product(item) for n, item in self._of("PRODUCT_DEFINITION")}
        self.shapes: dict[int, Item] = {}
        self.representations: dict[int, int] = {}
        for number, item in self._of("SHAPE_DEFINITION_REPRESENTATION"):
            definition = self._at(number, item.references[0], "PRODUCT_DEFINITION_SHAPE").references[0]
            shape = self._at(number, item.references[1], "ADVANCED_BREP_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION")
            self._check_context(item.references[1], shape)
            if definition in self.shapes or definition not in self.names:
                raise ReadError(f"#{number} of the STEP file represents no product, or one that is represented")
            self.shapes[definition], self.representations[definition] = shape, item.references[1]
        self.used = {item.references[1] for _, item in self._of("NEXT_ASSEMBLY_USAGE_OCCURRENCE")}
        self.inside: dict[int, list[tuple[str, int, Place]]] = {}
        self._place()
        self.colours: dict[int, str] = {}
        for number, item in self._of("STYLED_ITEM"):
            *styles, solid = item.references
            if solid not in self.model.solids or solid in self.colours:
                raise ReadError(f"#{number} of the STEP file colours something else than a solid, or one twice")
            self.colours[solid] = self._shade(styles)
        self.said: dict[int, dict[str, str | float]] = {}
        for number, item in self._of("PROPERTY_DEFINITION_REPRESENTATION"):
            self._say(number, *item.references)
        held = Counter(solid for shape in self.shapes.values() for solid in shape.references)
        if any(held[solid] != 1 for solid in self.model.solids.tolist()):
            raise ReadError("a solid of the STEP file is not that of one product")

    def parts(self, definition: int, place: Place, above: tuple[int, ...]) -> Iterator[tuple[str, int, Place]]:
        """What stands in a product, and in what stands there: name, product and place of each; or itself."""
        if definition in above:
            raise ReadError("a product of the STEP file stands in itself")
        if definition not in self.inside:
            yield self.names[definition], definition, place
        for name, product, where in self.inside.get(definition, []):
            moved = np.column_stack([place[:, :3] @ where[:, :3], place[:, :3] @ where[:, 3] + place[:, 3]])
            for inner, part, its in self.parts(product, moved, (*above, definition)):
                yield name if part == product else inner, part, its

    def prototype(self, definition: int) -> Prototype:
        """A product that is a part."""
        name, shape = self.names[definition], self.shapes.get(definition)
        solids = [n for n in shape.references if n in self.model.solids] if shape else []
        if len(solids) != 1:
            raise ReadError(f"{name} has {len(solids)} solids instead of 1")
        colour = self.colours.get(solids[0])
        model = self.model.only(self.model.solids.tolist().index(solids[0]))
        return Prototype(name, ReadSolid(model, (name,), colour, self.said.get(definition, {})), colour)

    def _of(self, kind: str) -> list[tuple[int, Item]]:
        return [(number, item) for number, item in self.items.items() if item.kind == kind]

    def _at(self, who: int, reference: int, *kinds: str) -> Item:
        item = self.items.get(reference)
        if item is None or item.kind not in kinds:
            raise ReadError(f"#{who} of the STEP file refers to #{reference}, which is no {' or '.join(kinds)}")
        return item

    def _product(self, definition: Item) -> str:
        formation = self._only(definition, "PRODUCT_DEFINITION_FORMATION")
        return self._only(formation, "PRODUCT").strings[1]

    def _only(self, item: Item, kind: str) -> Item:
        """The one thing of a kind that an item refers to."""
        found = self._at_all(item, kind)
        if len(found) != 1:
            raise ReadError(f"a {item.kind} of the STEP file refers to no {kind}, or to several")
        return found[0]

    def _at_all(self, item: Item, kind: str) -> list[Item]:
        """What an item refers to of a kind."""
        return [self.items[n] for n in item.references if n in self.items and self.items[n].kind == kind]

    def _check_context(self, number: int, shape: Item) -> None:
        """A shape consists of solids and axes, those of a part at its origin, in millimetres."""
        axes = np.array([n for n in shape.references[:-1] if n not in self.model.solids])
        frames = frames_of(self.entities, axes, np.full(len(axes), number))
        home = np.abs(frames.origins).max() <= _HOME and np.abs(frames.axes - np.eye(3)).max() <= _HOME
        if shape.kind == "ADVANCED_BREP_SHAPE_REPRESENTATION" and not home:
            raise ReadError(f"#{number} of the STEP file has another origin than its part")
        context = self._at(number, shape.references[-1], CONTEXT)
        if not (self._at_all(context, MILLIMETRE) and self._at_all(context, RADIAN)):
            raise ReadError(f"#{number} of the STEP file is not in mm and rad")

    def _place(self) -> None:
        """What stands in each product: the place's axes in it, after those in what stands there."""
        uses = {n: item for n, item in self._of("NEXT_ASSEMBLY_USAGE_OCCURRENCE")}
        for number, item in self._of("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"):
            relation = self._at(number, item.references[0], PLACED)
            occurrence = self._at(number, item.references[1], "PRODUCT_DEFINITION_SHAPE").references[0]
            if occurrence not in uses:
                raise ReadError(f"#{number} of the STEP file places nothing, or something twice")
            use = uses.pop(occurrence)
            outer, inner = use.references
            own, whole, move = relation.references
            if (self.representations.get(inner), self.representations.get(outer)) != (own, whole):
                raise ReadError(f"#{number} of the STEP file places another product than it names")
            axes = np.array(self._at(number, move, "ITEM_DEFINED_TRANSFORMATION").references)
            frames = frames_of(self.entities, axes, np.full(2, move))
            turn = frames.axes[1].T @ frames.axes[0]
            place = np.column_stack([turn, frames.origins[1] - turn @ frames.origins[0]])
            self.inside.setdefault(outer, []).append((use.strings[1], inner, place))
        if uses:
            raise ReadError(f"#{min(uses)} of the STEP file is a component without a place")

    def _say(self, number: int, definition: int, representation: int) -> None:
        """A property of a product, or of its shape."""
        what = self._at(number, definition, "PROPERTY_DEFINITION")
        value = self._at(number, representation, "REPRESENTATION").references[0]
        item = self._at(representation, value, "DESCRIPTIVE_REPRESENTATION_ITEM", "MEASURE_REPRESENTATION_ITEM")
        of = self.items.get(what.references[0])
        product = of.references[0] if of is not None and of.kind == "PRODUCT_DEFINITION_SHAPE" else what.references[0]
        said = self.said.setdefault(product, {})
        if what.strings[1] in said or product not in self.names:
            raise ReadError(f"#{number} of the STEP file says something of no product, or twice")
        said[what.strings[1]] = item.numbers[0] if item.numbers else item.strings[1]

    def _shade(self, styles: list[int]) -> str:
        """The one colour that styles lead to."""
        found, left, seen = set[str](), list(styles), set[int]()
        while left:
            number = left.pop()
            item = self.items.get(number)
            if item is None or number in seen:
                continue
            seen.add(number)
            left += item.references
            if item.kind == "COLOUR_RGB":
                found.add("#" + "".join(f"{round(255 * x):02x}" for x in item.numbers))
            elif item.kind == "DRAUGHTING_PRE_DEFINED_COLOUR":
                found.add(_SHADES.get(item.strings[0], ""))
        if len(found) != 1:
            raise ReadError(f"{len(found)} colours of one solid in the STEP file")
        return found.pop()
