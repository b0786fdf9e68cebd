"""STEP AP214 in mm as text, without a CAD kernel: faces between shared edges, names, colours, places of instances.

Entities and their forms are those that OCCT 7.9 writes, and no others. Coordinates have as many decimals as the
tolerance needs. What stands on every tooth is one template of text, filled in for each place.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import count, groupby

import numpy as np

from geometry.base.distinct import distinct
from geometry.base.placement import Placement3
from geometry.base.record import Record
from geometry.base.tolerance import PRECISION
from geometry.curves.curve import Real
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Extrusion,
    Faces,
    Frame,
    Index,
    Plane,
    Solid,
    Sphere,
    Spline,
    SplineSurface,
    Straight,
    Torus,
)  # fmt: skip
from parts.solids.decimals import point_lines

_HEAD = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('%s','2000-01-01T00:00:00',('%s'),('%s'),'higherpair','higherpair','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
"""
_TAIL = "ENDSEC;\nEND-ISO-10303-21;\n"
# coordinates are rounded to this part of the tolerance or finer, and to 9 decimals at least: so files made with
# other versions of numpy, whose last bits differ, are equal to 1e-9 mm
_SHARE, _LEAST_DECIMALS = 0.01, 9
# what surfaces are called, and which of their sizes are told
_ELEMENTARY = {
    Plane: ("PLANE",), Cylinder: ("CYLINDRICAL_SURFACE", "radius"), Cone: ("CONICAL_SURFACE", "radius", "slant"),
    Torus: ("TOROIDAL_SURFACE", "radius", "tube"), Sphere: ("SPHERICAL_SURFACE", "radius"),
}  # fmt: skip
# references on one line
_PER_LINE = 16


class StepPart(Record, eq=False):
    """A named solid with its colour, like "#c08040", material, density, g/cm^3, volume, mm^3, and area, mm^2.

    ``title``: what people call it, which CAD shows in place of the name; ``description``: what lists say of it;
    ``precision``: within which its points are one, mm.
    """

    name: str
    solid: Solid
    colour: str | None = None
    material: str | None = None
    density: float | None = None
    volume: float | None = None
    area: float | None = None
    title: str | None = None
    description: str = ""
    precision: float = PRECISION


class StepForm(Record):
    """How a file is written: ``digits``: decimals of coordinates; ``shared``: faces that are alike have one surface."""

    digits: int = _LEAST_DECIMALS
    shared: bool = True
    author: str = ""
    organisation: str = ""


def decimals(tolerance: float) -> int:
    """Decimals of the coordinates of a file within a tolerance, mm."""
    return max(_LEAST_DECIMALS, math.ceil(-math.log10(_SHARE * tolerance)))


class StepGroup(Record, eq=False):
    """A named assembly: name, product and place of each occurrence; a product that comes twice is written once."""

    name: str
    members: tuple[tuple[str, StepPart | StepGroup, Placement3], ...]


def step_text(product: StepPart | StepGroup, form: StepForm) -> str:
    """The file of a solid or of an assembly."""
    text = _Text(form)
    text.product(product)
    return text.whole(product.name)


class _Text:
    """The entities of a file, numbered as they come; small ones that are alike are written once."""

    def __init__(self, form: StepForm) -> None:
        self.form = form
        self.lines: list[str] = []
        self.numbers = count(1)
        self.known: dict[str, int] = {}
        self.ways: dict[tuple[float, ...], int] = {}
        self.products: dict[int, tuple[int, int]] = {}
        self.occurrences = count(1)
        # the shape of each product definition
        self.wholes: dict[int, int] = {}
        self.application = self.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')")
        self.add(
            f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#{self.application})"
        )

    def whole(self, name: str) -> str:
        """The file, all of it ASCII."""
        words = (string(word) for word in (f"{name}.step", self.form.author, self.form.organisation))
        return "".join([_HEAD % tuple(words), *self.lines, _TAIL])

    def add(self, text: str) -> int:
        """A new entity."""
        number = next(self.numbers)
        self.lines.append(f"#{number}={text};\n")
        return number

    def once(self, text: str) -> int:
        """An entity that may be shared."""
        if text not in self.known:
            self.known[text] = self.add(text)
        return self.known[text]

    def many(self, template: str, *columns: Index) -> Index:
        """An entity for each row of columns (n,), filled into a template."""
        own = self._numbered(len(columns[0]))
        rows = np.array((own, *columns)).T
        self.lines.append(f"#%d={template};\n" * len(rows) % tuple(rows.ravel().tolist()))
        return own

    def points(self, places: Real) -> Index:
        """Points (n, 3), mm."""
        own = self._numbered(len(places))
        self.lines.append(point_lines(int(own[0]), places, self.form.digits))
        return own

    def _numbered(self, size: int) -> Index:
        """The numbers of so many new entities."""
        first = next(self.numbers)
        self.numbers = count(first + size)
        return np.arange(first, first + size)

    def direction(self, way: Sequence[float]) -> int:
        """A direction, rounded as points a metre away are: those that are alike are one, whatever their last bits."""
        key = tuple(round(x, self.form.digits + 3) for x in way)
        if key not in self.ways:
            self.ways[key] = self.add(f"DIRECTION('',({','.join(real(x) for x in key)}))")
        return self.ways[key]

    def point(self, place: Sequence[float]) -> int:
        """A point of its own, to 15 digits."""
        return self.once(f"CARTESIAN_POINT('',({','.join(real(x) for x in place)}))")

    def place(self, origin: int, axis: Sequence[float], zero: Sequence[float]) -> int:
        """A frame at a point."""
        return self.once(f"AXIS2_PLACEMENT_3D('',#{origin},#{self.direction(axis)},#{self.direction(zero)})")

    def product(self, product: StepPart | StepGroup) -> tuple[int, int]:
        """Definition and representation of a product, made once."""
        if id(product) not in self.products:
            own = self._group(product) if isinstance(product, StepGroup) else self._part(product)
            self.products[id(product)] = own
        return self.products[id(product)]

    def _part(self, part: StepPart) -> tuple[int, int]:
        """A product with its solid, colour and properties."""
        definition, shape = self._named(
            part.name, "ADVANCED_BREP_SHAPE_REPRESENTATION", [self._solid(part)], part.title, part.description,
            part.precision,
        )  # fmt: skip
        if part.material is not None:
            words = f"DESCRIPTIVE_REPRESENTATION_ITEM('{string(part.material)}','{string(part.material)}')"
            self._property(definition, "material property", "material name", self.add(words))
        if part.density is not None:
            unit = self._derived((self.once("(MASS_UNIT()NAMED_UNIT(*)SI_UNIT($,.GRAM.))"), 1),
                                 (self.once("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.))"), -3))  # fmt: skip
            value = f"MEASURE_REPRESENTATION_ITEM('g/cm3',POSITIVE_RATIO_MEASURE({real(part.density)}),#{unit})"
            self._property(definition, "material property", "density", self.add(value))
        for name, kind, size, power in (("volume", "volume", part.volume, 3), ("surface area", "area", part.area, 2)):
            if size is not None:
                unit = self._derived((self.once("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))"), power))
                value = f"MEASURE_REPRESENTATION_ITEM('{name} measure',{kind.upper()}_MEASURE({real(size)}),#{unit})"
                self._property(self.wholes[definition], "geometric validation property", name, self.add(value))
        return definition, shape

    def _property(self, of: int, kind: str, name: str, item: int) -> None:
        """A property of a product, or of its shape."""
        found = self.add(f"PROPERTY_DEFINITION('{kind}','{name}',#{of})")
        value = self.add(f"REPRESENTATION('{name}',(#{item}),#{self._context()})")
        self.add(f"PROPERTY_DEFINITION_REPRESENTATION(#{found},#{value})")

    def _derived(self, *powers: tuple[int, int]) -> int:
        """A product of units, each to a power."""
        elements = [self.once(f"DERIVED_UNIT_ELEMENT(#{unit},{power}.)") for unit, power in powers]
        return self.once(f"DERIVED_UNIT(({_list(elements)}))")

    def _group(self, group: StepGroup) -> tuple[int, int]:
        """A product of occurrences of others."""
        made = [self.product(product) for _, product, _ in group.members]
        places = []
        for _, _, group_from_member in group.members:
            matrix = group_from_member.matrix()
            origin = self.point(matrix[:, 3].tolist())
            # each has its own: readers look it up by its number
            axis, zero = self.direction(matrix[:, 2].tolist()), self.direction(matrix[:, 0].tolist())
            places.append(self.add(f"AXIS2_PLACEMENT_3D('',#{origin},#{axis},#{zero})"))
        definition, shape = self._named(group.name, "SHAPE_REPRESENTATION", places)
        for (name, _, _), (own, own_shape), place in zip(group.members, made, places, strict=True):
            number = next(self.occurrences)
            used = self.add(f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{number}','{string(name)}','',#{definition},#{own},$)")
            moved = self.add(f"ITEM_DEFINED_TRANSFORMATION('','',#{self._home()},#{place})")
            relation = self.add(
                f"(REPRESENTATION_RELATIONSHIP('','',#{own_shape},#{shape})"
                f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{moved})SHAPE_REPRESENTATION_RELATIONSHIP())"
            )
            placed = self.add(f"PRODUCT_DEFINITION_SHAPE('Placement','Placement of an item',#{used})")
            self.add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{relation},#{placed})")
        return definition, shape

    def _home(self) -> int:
        return self.place(self.point((0.0, 0.0, 0.0)), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))

    def _named(
        self, name: str, kind: str, items: Sequence[int], title: str | None = None, description: str = "",
        precision: float = PRECISION,
    ) -> tuple[int, int]:  # fmt: skip
        """A product and its shape of items: the numbers of definition and representation."""
        scope = self.once(f"PRODUCT_CONTEXT('',#{self.application},'mechanical')")
        stage = self.once(f"PRODUCT_DEFINITION_CONTEXT('part definition',#{self.application},'design')")
        product = self.add(f"PRODUCT('{string(name)}','{string(title or name)}','{string(description)}',(#{scope}))")
        self.add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#{product}))")
        formation = self.add(f"PRODUCT_DEFINITION_FORMATION('','',#{product})")
        definition = self.add(f"PRODUCT_DEFINITION('design','',#{formation},#{stage})")
        whole = self.wholes[definition] = self.add(f"PRODUCT_DEFINITION_SHAPE('','',#{definition})")
        shape = self.add(f"{kind}('',({_list([self._home(), *items])}),#{self._context(precision)})")
        self.add(f"SHAPE_DEFINITION_REPRESENTATION(#{whole},#{shape})")
        return definition, shape

    def _context(self, precision: float = PRECISION) -> int:
        """Millimetres and radians, and within what points are one, mm."""
        length = self.once("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
        angle = self.once("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        solid_angle = self.once("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        within = self.once(
            f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({real(precision)}),#{length},"
            "'distance_accuracy_value','confusion accuracy')"
        )
        return self.once(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{within}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid_angle}))"
            "REPRESENTATION_CONTEXT('Context #1','3D Context with UNIT and UNCERTAINTY'))"
        )

    def _solid(self, part: StepPart) -> int:
        faces = _Shell(self, part.solid).faces()
        shell = self.add(f"CLOSED_SHELL('',({_list(faces)}))")
        solid = self.add(f"MANIFOLD_SOLID_BREP('',#{shell})")
        if part.colour is not None:
            self._colour(solid, part.colour)
        return solid

    def _colour(self, solid: int, colour: str) -> None:
        shade = ",".join(real(round(int(colour[i : i + 2], 16) / 255, 12)) for i in (1, 3, 5))
        rgb = self.once(f"COLOUR_RGB('',{shade})")
        fill = self.once(f"FILL_AREA_STYLE_COLOUR('',#{rgb})")
        filled = self.once(f"FILL_AREA_STYLE('',(#{fill}))")
        area = self.once(f"SURFACE_STYLE_FILL_AREA(#{filled})")
        sides = self.once(f"SURFACE_SIDE_STYLE('',(#{area}))")
        side = self.once(f"SURFACE_STYLE_USAGE(.BOTH.,#{sides})")
        font = self.once("DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous')")
        line = self.once(f"CURVE_STYLE('',#{font},POSITIVE_LENGTH_MEASURE(0.1),#{rgb})")
        style = self.once(f"PRESENTATION_STYLE_ASSIGNMENT((#{side},#{line}))")
        item = self.add(f"STYLED_ITEM('color',(#{style}),#{solid})")
        self.add(f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#{item}),#{self._context()})")


class _Shell:
    """The points, edges and faces of one solid as entities."""

    def __init__(self, text: _Text, solid: Solid) -> None:
        self.text = text
        self.points = text.points(solid.points)
        self.vertices = text.many("VERTEX_POINT('',#%d)", self.points[solid.vertices])
        self.solid = solid
        curves, edges = [], []
        for bundle in solid.edges:
            own = _spread(self._curves(bundle.curve, bundle.start), bundle.start.shape)
            ends = self.vertices[bundle.start], self.vertices[bundle.end]
            curves.append(own)
            edges.append(text.many("EDGE_CURVE('',#%d,#%d,#%d,.T.)", *ends, own))
        self.curves, self.edges = np.concatenate(curves), np.concatenate(edges)

    def _curves(self, curve: Straight | Circular | Spline, starts: Index) -> Index:
        """Curves of a bundle of edges, one for each or one for all."""
        text = self.text
        if isinstance(curve, Straight):
            ways = np.array([text.once(f"VECTOR('',#{text.direction(way)},1.)") for way in curve.direction.tolist()])
            origins = self.points[self.solid.vertices[starts]]
            return text.many("LINE('',#%d,#%d)", origins, _spread(ways, origins.shape))
        if isinstance(curve, Circular):
            return np.array([text.once(f"CIRCLE('',#{p},{real(curve.radius)})") for p in self._frames(curve.frame)])
        poles = self.points[curve.poles]
        listed = ",".join(["#%d"] * poles.shape[1])
        knots, times = _knots(curve.knots)
        return text.many(
            f"B_SPLINE_CURVE_WITH_KNOTS('',{curve.degree},({listed}),.UNSPECIFIED.,.F.,.F.,({times}),({knots}),"
            ".UNSPECIFIED.)",
            *poles.T,
        )

    def _frames(self, frame: Frame) -> Iterator[int]:
        columns = self.points[frame.origin].tolist(), frame.axis.tolist(), frame.zero.tolist()
        size = max(map(len, columns))
        for origin, axis, zero in zip(*(column * (size // len(column)) for column in columns), strict=True):
            yield self.text.place(origin, axis, zero)

    def faces(self) -> list[int]:
        """All faces."""
        return [number for faces in self.solid.faces for number in self._faces(faces)]

    def _faces(self, faces: Faces) -> list[int]:
        text = self.text
        bounds: list[Index] = []
        for edges, senses in faces.loops:
            words = _spread(np.where(senses, *map(ord, "TF")), edges.shape)
            uses = text.many("ORIENTED_EDGE('',*,*,#%d,.%c.)", self.edges[edges].ravel(), words.ravel())
            listed = _list(["%d"] * edges.shape[1])
            loops = text.many(f"EDGE_LOOP('',({listed}))", *uses.reshape(edges.shape).T)
            bounds.append(text.many("FACE_BOUND('',#%d,.T.)", loops))
        surfaces = self._surfaces(faces, len(bounds[0]))
        listed = ",".join(["#%d"] * len(bounds))
        sense = "FT"[faces.along]
        return text.many(f"ADVANCED_FACE('',({listed}),#%d,.{sense}.)", *bounds, surfaces).tolist()

    def _surfaces(self, faces: Faces, size: int) -> Index:
        """The surfaces of a bundle of faces (size,)."""
        text, surface = self.text, faces.surface
        if isinstance(surface, Extrusion):
            vector = text.once(f"VECTOR('',#{text.direction(surface.direction[0].tolist())},1.)")
            return text.many(f"SURFACE_OF_LINEAR_EXTRUSION('',#%d,#{vector})", self.curves[surface.edges])
        if isinstance(surface, SplineSurface):
            poles = self.points[surface.poles]
            row = "(" + ",".join(["#%d"] * poles.shape[2]) + ")"
            (u, u_times), (v, v_times) = _knots(surface.u_knots), _knots(surface.v_knots)
            degrees, rows = ",".join(map(str, surface.degrees)), _lines([row] * poles.shape[1], poles.shape[2])
            return text.many(
                f"B_SPLINE_SURFACE_WITH_KNOTS('',{degrees},({rows}),.UNSPECIFIED.,"
                f".F.,.F.,.F.,({u_times}),({v_times}),({u}),({v}),.UNSPECIFIED.)",
                *poles.reshape(len(poles), -1).T,
            )
        name, *sizes = _ELEMENTARY[type(surface)]
        told = "".join(f",{real(getattr(surface, size))}" for size in sizes)
        words = [f"{name}('',#{place}{told})" for place in self._frames(surface.frame)]
        if text.form.shared:
            return _spread(np.array([text.once(w) for w in words]), (size,))
        return np.array([text.add(w) for w in (words * size)[:size]])


def real(value: float) -> str:
    """A number as Part 21 has it, to 15 digits, the shortest that has them."""
    text = f"{value + 0.0:.15g}".upper()
    mantissa, e, exponent = text.partition("E")
    return f"{mantissa if '.' in mantissa else mantissa + '.'}{e}{exponent}"


def string(text: str) -> str:
    """Words as Part 21 has them: what is not ASCII in hexadecimal, quotes and backslashes doubled."""
    found = []
    for is_plain, letters in groupby(text, lambda c: " " <= c <= "~"):
        run = "".join(letters)
        if is_plain:
            found.append(run.replace("\\", "\\\\").replace("'", "''"))
        elif max(map(ord, run)) < 0x10000:
            found.append("\\X2\\" + "".join(f"{ord(c):04X}" for c in run) + "\\X0\\")
        else:
            found.append("\\X4\\" + "".join(f"{ord(c):08X}" for c in run) + "\\X0\\")
    return "".join(found)


def _list(items: Sequence[object]) -> str:
    """References, a few on each line."""
    return _lines([f"#{x}" for x in items], 1)


def _lines(items: Sequence[str], references: int) -> str:
    """Items of so many references, a few on each line."""
    few = max(_PER_LINE // references, 1)
    return ",\n".join(",".join(items[k : k + few]) for k in range(0, len(items), few))


def _spread(values: Index, shape: tuple[int, ...]) -> Index:
    """Values that are the same in every row."""
    found = np.empty(shape, np.intp)
    found[...] = values
    return found


def _knots(knots: Real) -> tuple[str, str]:
    """The different knots, and how often each stands there."""
    found = distinct(knots)
    times = (knots[None, :] == found[:, None]).sum(axis=1)
    return ",".join(real(x) for x in found.tolist()), ",".join(map(str, times.tolist()))
