"""The one decoder of DXF entities: lines, arcs, circles, splines and words as ezdxf reads them.

Splines are evaluated by the library that reads them, never by ours.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from exporters.formats.chains import chained, nodes, smooth_loops
from exporters.formats.readback import ReadFlat, SmoothLoop
from geometry.base.distinct import distinct
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from parts.base.readback import ReadError, refuse_if
from parts.drawing.readback import ReadDimension

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities import Arc, Circle, Dimension, DXFGraphic, Line, Spline, Text
    from ezdxf.layouts import BlockLayout
    from ezdxf.math import BSpline, Vec3

_LAYER, _PITCH = "OUTLINE", "PITCH_CURVE"
_MILLIMETRES = 4
_PER_CURVE = 25
# what a dimension's own number may be off by, part of it
_SAME = 1e-6
# the type of a dimension between two lines
_ANGULAR = 2
# what an entity may say of its looks: no more than its absence
_PLAIN = {
    "invisible": 0, "color": 256, "linetype": "BYLAYER", "lineweight": -1, "ltscale": 1.0, "thickness": 0.0,
    "extrusion": (0.0, 0.0, 1.0), "paperspace": 0, "true_color": None, "color_name": None, "transparency": None,
    "rotation": 0.0, "oblique": 0.0, "text_generation_flag": 0,
}  # fmt: skip
# what a spline on a sheet may say beside, and only it
_DASH = "CONTINUOUS"
# colour, line type and width of the layers of a drawing, the width in hundredths of a mm
_LOOKS = {_LAYER: (7, "CONTINUOUS", 50), _PITCH: (8, "CONTINUOUS", 25)}
# curves that turn so far get ten times as many samples, and arcs are smooth for so long, degrees
_LONG, _SPAN = 90.0, 5.0


def _shares(sweep: float) -> Real:
    """Shares of a curve that turns so far, degrees, at which it is sampled."""
    return np.linspace(0, 1, _PER_CURVE if sweep < _LONG else 10 * _PER_CURVE)


class DrawnLine(Record):
    """A straight line, mm."""

    layer: str
    start: complex
    end: complex

    def samples(self) -> Complex:
        """Points from end to end."""
        return self.spans(np.linspace(0, 1, _PER_CURVE))[0]

    def spans(self, share: Real) -> Complex:
        """Points at shares of each smooth span, (spans, n)."""
        return np.asarray([self.start + share * (self.end - self.start)], dtype=np.complex128)


class DrawnArc(Record):
    """An arc that turns left from one angle to another, degrees; a circle from 0 to 360."""

    layer: str
    centre: complex
    radius: float
    first: float
    last: float

    @property
    def sweep(self) -> float:
        """Degrees, above 0."""
        return (self.last - self.first) % 360 or 360.0

    def samples(self) -> Complex:
        """Points from end to end."""
        return self._at(self.first + _shares(self.sweep) * self.sweep)

    def spans(self, share: Real) -> Complex:
        """Points at shares of each smooth span, (spans, n)."""
        edges = np.linspace(self.first, self.first + self.sweep, max(2, math.ceil(self.sweep / _SPAN)) + 1)
        return self._at(edges[:-1, None] + share * np.diff(edges)[:, None])

    def _at(self, angle: Real) -> Complex:
        return np.asarray(self.centre + self.radius * np.exp(1j * np.radians(angle)), dtype=np.complex128)


class DrawnSpline(Record):
    """A spline with ezdxf's own evaluation; ``dash``: one dash of a line, drawn solid whatever its layer is."""

    layer: str
    tool: BSpline
    dash: bool

    def samples(self) -> Complex:
        """Points from end to end."""
        knots = np.asarray(self.tool.knots())
        sides = np.diff([_plane(pole) for pole in self.tool.control_points])
        # a spline turns no farther than its poles
        turned = np.abs(np.angle(sides[1:] * np.conj(sides[:-1]))).sum()
        return self._at(knots[0] + _shares(float(np.degrees(turned))) * (knots[-1] - knots[0]))

    def spans(self, share: Real) -> Complex:
        """Points at shares of each smooth span, (spans, n)."""
        knots = distinct(np.asarray(self.tool.knots()))
        places = knots[:-1, None] + share * np.diff(knots)[:, None]
        return self._at(places.ravel()).reshape(places.shape)

    def _at(self, places: Real) -> Complex:
        return np.array([complex(p.x, p.y) for p in self.tool.points(places)])


class DrawnText(Record):
    """Words fitted between two points; height of capitals, mm."""

    layer: str
    text: str
    left: complex
    right: complex
    height: float


DrawnCurve = DrawnLine | DrawnArc | DrawnSpline


def _plane(point: Vec3) -> complex:
    return complex(point.x, point.y)


def _line(entity: Line) -> DrawnLine:
    return DrawnLine(entity.dxf.layer, _plane(entity.dxf.start), _plane(entity.dxf.end))


def _arc(entity: Arc) -> DrawnArc:
    dxf = entity.dxf
    return DrawnArc(dxf.layer, _plane(dxf.center), dxf.radius, dxf.start_angle, dxf.end_angle)


def _circle(entity: Circle) -> DrawnArc:
    return DrawnArc(entity.dxf.layer, _plane(entity.dxf.center), entity.dxf.radius, 0.0, 360.0)


def _spline(entity: Spline) -> DrawnSpline:
    if any(point[2] for point in entity.control_points):
        raise ReadError(f"a SPLINE on layer {entity.dxf.layer} is lifted out of its plane")
    return DrawnSpline(entity.dxf.layer, entity.construction_tool(), entity.dxf.linetype == _DASH)


def _text(entity: Text) -> DrawnText:
    dxf = entity.dxf
    return DrawnText(dxf.layer, dxf.text, _plane(dxf.insert), _plane(dxf.align_point), dxf.height)


_CURVES: dict[str, Callable[[Any], DrawnCurve]] = {"LINE": _line, "ARC": _arc, "CIRCLE": _circle, "SPLINE": _spline}


def drawn(document: Drawing, what: str = "drawing") -> tuple[list[DrawnCurve], list[DrawnText]]:
    """The curves and, on a sheet (``what``), the words of a drawing, in the order of the file.

    Raises
    ------
    ReadError
        Something else stands in it.
    """
    from ezdxf.entities import Text

    curves, words = [], []
    entities = [*document.modelspace()]
    if what == "sheet":
        entities = [*(e for e in entities if e.dxftype() != "DIMENSION"), *_of_dimensions(document)]
    for name in {entity.dxf.layer for entity in entities}:
        _check_layer(document, name)
    for entity in entities:
        kind = entity.dxftype()
        _check_plain(entity, dashes=what == "sheet" and kind == "SPLINE")
        if kind in _CURVES:
            curves.append(_CURVES[kind](entity))
        elif isinstance(entity, Text) and what == "sheet":
            words.append(_text(entity))
        else:
            raise ReadError(f"a {kind} stands in the {what}; only lines, arcs, circles and splines belong there")
    return curves, words


def _dimensions_in(document: Drawing) -> list[Dimension]:
    from ezdxf.entities import Dimension

    return [entity for entity in document.modelspace() if isinstance(entity, Dimension)]


def _of_dimensions(document: Drawing) -> Iterator[DXFGraphic]:
    """What the dimensions of a drawing consist of."""
    for entity in _dimensions_in(document):
        _check_plain(entity, dashes=False)
        yield from _block_of(document, entity)


def _block_of(document: Drawing, entity: Dimension) -> BlockLayout:
    """What a dimension consists of."""
    refuse_if(entity.dxf.geometry not in document.blocks, "a DIMENSION has no block of lines")
    return document.blocks.get(entity.dxf.geometry)


def dimensions(document: Drawing) -> list[ReadDimension]:
    """The dimensions of a drawing, each measured by its own points."""
    found = []
    for entity in _dimensions_in(document):
        if entity.dxf.dimstyle not in document.dimstyles:
            raise ReadError(f"a DIMENSION has the style {entity.dxf.dimstyle}, which is not in the file")
        factor = document.dimstyles.get(entity.dxf.dimstyle).dxf.dimlfac
        if entity.dimtype == _ANGULAR:
            found.append(_angle(document, entity))
            continue
        value = float(entity.get_measurement()) * factor
        if abs(value - entity.dxf.get("actual_measurement", math.nan)) > _SAME * max(1.0, abs(value)):
            raise ReadError(f"a DIMENSION of {value:g} mm says that it measures otherwise")
        ends = (point for line in _block_of(document, entity).query("LINE") for point in (line.dxf.start, line.dxf.end))
        if min((entity.dxf.defpoint.distance(end) for end in ends), default=math.inf) > _SAME:
            raise ReadError(f"a DIMENSION of {value:g} mm is told elsewhere than it is drawn")
        found.append(ReadDimension(value, entity.dxf.text))
    return found


def _angle(document: Drawing, entity: Dimension) -> ReadDimension:
    """An angle between two lines from one place, in degrees by its own points, with its arc."""
    dxf = entity.dxf
    at, other, on_arc = (_plane(place) for place in (dxf.defpoint2, dxf.defpoint4, dxf.defpoint5))
    refuse_if(abs(at - other) > _SAME, "an angular DIMENSION has lines that begin at two places")
    first, second, middle = (place - at for place in (_plane(dxf.defpoint3), _plane(dxf.defpoint), on_arc))
    turn, within = (math.degrees(cmath.phase(way / first)) % 360.0 for way in (second, middle))
    refuse_if(not 0.0 < within < turn, f"an angular DIMENSION of {turn:g} degrees has its arc on the other side")
    if abs(turn - math.degrees(dxf.get("actual_measurement", math.nan))) > _SAME * max(1.0, turn):
        raise ReadError(f"a DIMENSION of {turn:g} degrees says that it measures otherwise")
    arcs = (one.dxf for one in _block_of(document, entity).query("ARC"))
    if not any(abs(_plane(a.center) - at) <= _SAME and abs(a.radius - abs(middle)) <= _SAME for a in arcs):
        raise ReadError(f"a DIMENSION of {turn:g} degrees is told elsewhere than it is drawn")
    return ReadDimension(turn, dxf.text)


def _check_plain(entity: DXFGraphic, *, dashes: bool) -> None:
    """Nothing hides an entity, lifts or thickens it, or gives it another look than its layer's, unless it is a dash."""
    for name, value in entity.dxfattribs().items():
        if dashes and (name, value) == ("linetype", _DASH):
            continue
        if name in _PLAIN and value != _PLAIN[name]:
            raise ReadError(f"a {entity.dxftype()} on layer {entity.dxf.layer} has {name} = {value}")
        if getattr(value, "z", 0.0) and name not in _PLAIN:
            raise ReadError(f"a {entity.dxftype()} on layer {entity.dxf.layer} is lifted out of its plane")


def _check_layer(document: Drawing, name: str) -> None:
    """A layer is seen and plotted."""
    refuse_if(name not in document.layers, f"layer {name} is not in the layer table")
    layer = document.layers.get(name)
    for is_so, what in (
        (layer.is_off(), "is off"), (layer.is_frozen(), "is frozen"), (not layer.dxf.plot, "is not plotted"),
        (layer.dxf.hasattr("true_color"), "has a colour beside its own"), (layer.transparency, "is transparent"),
    ):  # fmt: skip
        refuse_if(is_so, f"layer {name} {what}")


def opened(file: Path, *, audit: bool = True) -> Drawing:
    """A DXF as ezdxf reads it; what its ``audit`` finds wrong is an error."""
    import ezdxf

    try:
        document = ezdxf.readfile(str(file))
        auditor = document.audit() if audit else None
    except (ezdxf.DXFError, OSError, ValueError, LookupError, StopIteration, TypeError, AttributeError) as error:
        raise ReadError(f"not a readable DXF: {error or 'it ends too early'}") from error
    if auditor is not None and (auditor.errors or auditor.fixes):
        raise ReadError(f"the DXF audit finds fault: {(auditor.errors + auditor.fixes)[0].message}")
    return document


class ReadDrawing(ReadFlat):
    """A drawing of true curves: the outlines on one layer, ``paths`` of a follower's centre on another."""

    curves: tuple[DrawnCurve, ...]
    paths: tuple[DrawnCurve, ...] = ()
    has_arcs = False

    def loops(self) -> list[Complex]:
        """The closed outlines, densely sampled."""
        return chained([curve.samples() for curve in self.curves])

    def path_loops(self) -> list[Complex]:
        """The closed paths of a follower's centre, densely sampled."""
        return chained([curve.samples() for curve in self.paths]) if self.paths else []

    def section(self, z: float) -> tuple[SmoothLoop, ...]:
        """The closed outlines as polynomials."""
        share = nodes()
        return smooth_loops([span for curve in self.curves for span in curve.spans(share)])


def read_drawing(file: Path) -> ReadDrawing:
    """A drawing DXF in mm.

    Raises
    ------
    ReadError
        The file is no sound DXF, not in mm, or holds something else, or on another layer.
    """
    document = opened(file)
    refuse_if(document.header.get("$INSUNITS") != _MILLIMETRES, "the DXF is not in mm ($INSUNITS is not 4)")
    for entity in document.modelspace():
        if entity.dxf.layer.upper() not in _LOOKS:
            raise ReadError(f"a {entity.dxftype()} stands on layer {entity.dxf.layer} instead of {_LAYER}")
    found: dict[str, list[DrawnCurve]] = {name: [] for name in _LOOKS}
    for curve in drawn(document)[0]:
        found[curve.layer.upper()].append(curve)
    for name, curves in found.items():
        if curves and (*look_of(document, name), document.layers.get(name).dxf.lineweight) != _LOOKS[name]:
            raise ReadError(f"layer {name} looks otherwise than it should")
    return ReadDrawing(tuple(found[_LAYER]), tuple(found[_PITCH]))


def look_of(document: Drawing, name: str) -> tuple[int, str]:
    """The colour and the line type of a layer."""
    layer = document.layers.get(name)
    return layer.color, layer.dxf.linetype.upper()
