"""Every kind of file in one row: how far its numbers are rounded, the shape that it holds, how it is written.

Purposes, tolerances and what it holds stand in the row of parts/scene/formats.py. Writers are imported when a file of
their kind is written; readers (exporters/formats/reading.py) when one is read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar, cast

import numpy as np
from msgspec import structs

from geometry.approximation.chords import approximate_profile
from geometry.base.errors import Nearest, ParameterError, limit, rounded
from geometry.base.nearest import nearest
from geometry.base.placement import Placement3
from geometry.base.record import Record, replace
from geometry.base.tolerance import DRAWN_ROUNDING, LEAST_SEGMENT_MM, written_decimals
from geometry.curves.curve import Complex
from geometry.plane.contour import Approximation
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Profile, Region
from parts.base.part import Part
from parts.base.part_keys import USUAL_COLOUR
from parts.scene.formats import FileKind
from parts.scene.scene_file import ExportSpec

if TYPE_CHECKING:
    from exporters.formats.threemf import MeshPart
    from geometry.approximation.outline import Outline
    from geometry.solids.body import Body
    from geometry.solids.faced import FacedBody
    from parts.solids.faces import Curves as SolidCurves
    from parts.solids.step_text import StepForm, StepPart

Chords: TypeAlias = tuple[Approximation, ...]
Curves: TypeAlias = "tuple[Outline, ...]"
Shape: TypeAlias = "Chords | Curves | SolidCurves"
# from the strongest to the weakest
BOUNDS = ("exact", "certified", "sampled")
# of an instance: its id, its part, its place, and the sub-assembly that it belongs to, if any
Places = Sequence[tuple[str, str, Placement3, str | None]]
# more edges than any receiving program opens; one file of them is some 300 MB
_MOST_EDGES = 4_000_000
# where slices and chords are counted, so far above their estimate a tolerance is tried, and sought so near
_ABOVE, _NEAR = 1.05, 0.05
# how often the tolerance that digits hold is tried; at how many of it triangles of bent faces are counted, and by how
# much more of them there may be, which come in steps and with finer splines
_DOUBLINGS, _COARSE, _SPARE = 6, 16.0, 1.75
# so many times fewer triangles are offered of a mesh that is proven, and proven again where it is read back
_PROVEN = 3.0
# of these so many times fewer: writing and reading back takes up to 1.1 kB of memory an edge
_HEAVIER = {"stl": 2, "3mf": 4}
# a float32 coordinate is good to 2^-24 of its size, both of them together to sqrt(2) of that; the rest is for the grid
# on which vertices stand before
_FLOAT32 = 2.0**-24 * 1.6
# 3MF writes its float32 numbers as text, which rounds them once more
_TEXT_ROUNDINGS = 2
# by how much an outline moves, in last decimals: by vertices and bulges 1.25, by SVG's radii and quartered ends 1.6
_ROUNDINGS = 3.0
# coordinates have 16 digits at most
_DIGITS = 2e-15
# a coordinate is moved by half of its last decimal: a place by sqrt(1/2) of one, the section of a slant of 45 degrees
# by half of one more, for its height
_STEP_PLACE = 1.21
# STEP's directions and radii have 15 digits
_STEP_ROUNDING = 1e-12


class Content(Record):
    """What a writer gets: one part as an export wants it, and the exact section that its file must match."""

    part: Part
    export: ExportSpec
    section: OffsetRegion

    @property
    def tolerance(self) -> float:
        """Largest deviation from the exact curve, mm."""
        return float(self.export.tolerance or 0.0)

    @property
    def kind(self) -> FileKind:
        """The kind of file."""
        return self.export.kind

    @property
    def decimals(self) -> int:
        """Decimals of the numbers of a flat file, mm."""
        return written_decimals(self.tolerance)

    @property
    def body(self) -> Body | FacedBody:
        """The exact solid, moved like the section."""
        return self.part.body(self.section.offset)

    @property
    def pitch_curve(self) -> Profile | None:
        """The path of the follower's centre, where the export asks for it and the part has one."""
        return self.part.pitch_curve if self.export.pitch_curve else None

    @property
    def outlines(self) -> tuple[Profile, ...]:
        """What a drawing holds: the boundaries of the section, holes first, then the pitch curve."""
        path = self.pitch_curve
        return (*self.section.region.profiles(), *([] if path is None else [path]))

    @property
    def exact(self) -> Region | Body | FacedBody:
        """What the file must agree with."""
        return self.body if self.kind.is_solid else self.section.region


S = TypeVar("S")


class FileFormat(Record, Generic[S]):
    """A row; ``rounding``: how far the rounding of a file's numbers may move an outline, mm.

    ``shape``: the boundaries, approximated within a tolerance of which the rounding has taken its share already.
    """

    rounding: Callable[[Content], float]
    shape: Callable[[Content, float], S]
    write: Callable[[Content, S, Path], dict[str, int]]
    write_assembly: Callable[[str, Sequence[Content], dict[str, S], Places, Path], dict[str, int]] | None = None


def shape_of(content: Content) -> Shape:
    """The boundaries of a section, holes first, or of a solid, as format and tolerance want them.

    Raises
    ------
    ParameterError, ConvergenceError
        The tolerance asks for more than the format can carry.
    """
    row = REGISTRY[content.kind.name]
    # the rounding of the file's numbers takes its share of the tolerance first
    left = content.tolerance - (rounding := row.rounding(content))
    if left <= 0 and row.shape is not _chords:
        # of meshes more is asked
        found = limit(2 * rounding, content.tolerance, digits=6)
        raise ParameterError("tolerance", content.tolerance, "finer_than_digits", found)
    made: Shape = row.shape(content, left)
    return made


def number_rounding(content: Content) -> float:
    """How far the rounding of a file's numbers may move an outline, mm."""
    return REGISTRY[content.kind.name].rounding(content)


def least_tolerance(content: Content) -> float:
    """The finest tolerance that the digits of a mesh file hold, mm."""
    return 8 * number_rounding(content)


def mesh_tolerance(contents: Sequence[tuple[Content, float]], least: float, given: float) -> Nearest | None:
    """From the ``least`` that digits hold on, by doubling, one with which mesh files are made, each at its share, mm.

    Not all that digits hold is made: of some the file would need too many edges.
    """
    faced = [(content, share) for content, share in contents if content.body.is_faced]
    if math.isinf(least := max([least, *(_carried(content) / share for content, share in faced)])):
        return None

    def fits(tolerance: float) -> bool:
        return all(content.body.is_faced or _fits(content, share * tolerance) for content, share in contents)

    ends = [rounded(least * 2.0**k, up=True, digits=6) for k in range(_DOUBLINGS)]
    return nearest(fits, given, ends, digits=6, share=1.0)


def _other(content: Content, tolerance: float) -> Shape:
    """The boundaries at another tolerance, mm."""
    return shape_of(replace(content, export=structs.replace(content.export, tolerance=tolerance)))


def _fits(content: Content, tolerance: float) -> bool:
    return bool(_other(content, tolerance))


def _carried(content: Content) -> float:
    """A tolerance that the mesh of a body told by its faces can keep, mm, by the triangles of a coarse one.

    On surfaces bent both ways, of which there are most, their number goes by 1 / tolerance; on others by less.
    """
    for coarse in (least_tolerance(content) * _COARSE**k for k in (1, 2)):
        with suppress(ParameterError):
            triangles = len(cast("Chords", _other(content, coarse))[0].geometry)
            proven = 1.0 if cast("FacedBody", content.body).proof is None else _PROVEN
            return coarse * _SPARE * proven * triangles / _most_edges(content)
    return math.inf


def declared_error(content: Content, made: Shape) -> tuple[float, str]:
    """The bound of a whole file, mm: the worst boundary plus the rounding of its numbers."""
    worst, kinds = max(a.max_error for a in made), {a.bound for a in made}
    return worst + number_rounding(content), max(kinds, key=BOUNDS.index)


def _arcs(content: Content, tolerance: float) -> Chords:
    """Lines and arcs of the section, or lines alone."""
    arcs = content.export.curves == "arcs"
    made = tuple(
        approximate_profile(p, tolerance, arcs=arcs, least_edge=LEAST_SEGMENT_MM)
        for p in content.section.region.profiles()
    )
    _check_count(content, sum(len(a.geometry) for a in made), 3 if arcs else 2)
    return tuple(replace(a, geometry=a.geometry.written(content.decimals)) for a in made)


def _splines(content: Content, tolerance: float) -> Curves:
    """Cubics, which drawings read everywhere."""
    from geometry.approximation.outline import spline_outline

    return tuple(spline_outline(p, tolerance, degree=3, continuity=2) for p in content.outlines)


def _chords(content: Content, tolerance: float) -> Chords:
    """Chords of the solid's profiles."""
    from parts.solids.mesh import count_edges, mesh_outlines

    rounding = number_rounding(content)
    if content.tolerance < (least := least_tolerance(content)):
        found = partial(mesh_tolerance, [(content, 1.0)], least, content.tolerance)
        raise ParameterError("tolerance", content.tolerance, "finer_than_mesh_digits", found)
    if content.body.is_faced:
        # one mesh for every format: it takes its time
        tolerance = content.tolerance - _TEXT_ROUNDINGS * _mesh_rounding(content)
    try:
        made = mesh_outlines(content.body, tolerance, 64 * rounding)
    except ParameterError as refusal:
        raise refusal.told_of("tolerance", content.tolerance, _coarser(content)) from None
    _check_count(content, count_edges(content.body, made), 2)
    return made


def _most_edges(content: Content) -> float:
    return _MOST_EDGES / _HEAVIER.get(content.kind.name, 1)


def _coarser(content: Content) -> Callable[[], Nearest | None]:
    """How a coarser mesh is found."""
    return partial(mesh_tolerance, [(content, 1.0)], _ABOVE * content.tolerance, content.tolerance)


def _check_count(content: Content, edges: int, order: int) -> None:
    """Refuse more edges than a file can carry, whose number goes by the tolerance's root of an ``order``."""
    if edges > (most := _most_edges(content)):
        far = rounded(content.tolerance * (edges / most) ** order, up=True, digits=6)
        works: Nearest | Callable[[], Nearest | None] = Nearest(far)
        if content.kind.is_solid:
            body = content.body
            if body.is_faced:
                works = _coarser(content)
            elif body.twisted_profiles():
                # slices and chords are fewer at once
                ends = [_ABOVE * content.tolerance * edges / most, far]
                works = partial(nearest, partial(_fits, content), content.tolerance, ends, digits=8, share=_NEAR)
        raise ParameterError("tolerance", content.tolerance, "too_many_edges", works, edges=edges)


def _solid_curves(content: Content, tolerance: float) -> SolidCurves:
    """Splines of the solid's profiles."""
    from parts.solids.faces import solid_curves

    return solid_curves(content.body, tolerance)


def _flat_rounding(content: Content) -> float:
    return _ROUNDINGS * 10.0**-content.decimals + _DIGITS * content.section.region.outer.reach()


def _drawing_rounding(content: Content) -> float:
    return DRAWN_ROUNDING + _DIGITS * max(profile.reach() for profile in content.outlines)


def _mesh_rounding(content: Content) -> float:
    body = content.body
    return _FLOAT32 * (body.section_reach() + body.steepness() * max(map(abs, body.levels())))


def _step_rounding(content: Content) -> float:
    from parts.solids.step_text import decimals

    return _STEP_PLACE * 10.0 ** -decimals(content.tolerance) + _STEP_ROUNDING * content.body.section_reach()


def write_outlines(
    file: Path, export: ExportSpec, layers: tuple[str, ...], made: Chords, strokes: Sequence[Complex],
    board: complex | None = None,
) -> dict[str, int]:  # fmt: skip
    """Write outlines for a laser as an export wants them, ``board``: on one of this size; counts of what is in it."""
    if export.format == "dxf":
        from exporters.formats.laser_dxf import write_laser_dxf

        return write_laser_dxf(file, layers, made, version=export.dxf_version, strokes=strokes)
    from exporters.formats.svg import write_laser_svg

    return write_laser_svg(file, layers, made, strokes, board)


def _write_laser(content: Content, made: Chords, file: Path) -> dict[str, int]:
    return write_outlines(file, content.export, content.section.region.layers(), made, strokes_of(content))


def _write_drawing_dxf(content: Content, made: Curves, file: Path) -> dict[str, int]:
    from exporters.formats.drawing_dxf import write_drawing_dxf

    count = len(content.section.region.profiles())
    return write_drawing_dxf(file, made[:count], made[count:])


def strokes_of(content: Content) -> tuple[Complex, ...]:
    """What is engraved in single strokes, in the decimals of the file."""
    strokes = [np.array(stroke, dtype=np.complex128) for stroke in content.section.region.strokes]
    return tuple(np.asarray(np.round(stroke, content.decimals) + 0.0) for stroke in strokes)


def _write_stl(content: Content, made: Chords, file: Path) -> dict[str, int]:
    from exporters.formats.stl import write_stl
    from parts.solids.mesh import body_mesh

    return write_stl(file, body_mesh(content.body, made))


def _mesh_part(content: Content, made: Chords) -> MeshPart:
    from exporters.formats.threemf import MeshPart
    from parts.solids.mesh import body_mesh

    part = content.part
    mesh = body_mesh(content.body, made)
    return MeshPart(part.id, mesh, part.colour, part.title or "", part.material, part.language)


def _write_3mf(content: Content, made: Chords, file: Path) -> dict[str, int]:
    from exporters.formats.threemf import write_3mf

    return write_3mf(file, _mesh_part(content, made))


def _write_3mf_assembly(
    title: str, contents: Sequence[Content], made: dict[str, Chords], places: Places, file: Path
) -> dict[str, int]:
    from exporters.formats.threemf import write_3mf_assembly

    meshes = [_mesh_part(c, made[c.part.id]) for c in contents]
    return write_3mf_assembly(file, title, meshes, [place[:3] for place in places])


def _step_part(content: Content, made: SolidCurves) -> StepPart:
    from geometry.solids.area import surface_area
    from parts.solids.faces import solid_faces
    from parts.solids.step_text import StepPart

    part, body = content.part, content.body
    volume, faces = part.made_by.moments(body).volume, solid_faces(body, made)
    weighed = part.material, part.density, volume, surface_area(faces)
    colour = part.colour or USUAL_COLOUR
    return StepPart(part.id, faces, colour, *weighed, part.product_name, part.description, body.precision)


def _step_form(content: Content) -> StepForm:
    from parts.solids.step_text import StepForm, decimals

    export = content.export
    return StepForm(decimals(content.tolerance), export.shared, export.author, export.organisation)


def _write_step(content: Content, made: SolidCurves, file: Path) -> dict[str, int]:
    from exporters.formats.step import write_step

    return write_step(file, _step_part(content, made), _step_form(content))


def _write_step_assembly(
    title: str, contents: Sequence[Content], made: dict[str, SolidCurves], places: Places, file: Path
) -> dict[str, int]:
    from exporters.formats.step import write_step
    from parts.solids.step_text import StepGroup

    solids = {c.part.id: _step_part(c, made[c.part.id]) for c in contents}
    home, tree = Placement3.towards((0.0, 0.0, 1.0), 0.0, (0.0, 0.0, 0.0)), dict.fromkeys(p[3] for p in places)
    members: list[tuple[str, StepPart | StepGroup, Placement3]] = []
    for group in tree:
        own = tuple((name, solids[part], place) for name, part, place, within in places if within == group)
        members += own if group is None else [(group, StepGroup(group, own), home)]
    return write_step(file, StepGroup(title, tuple(members)), _step_form(contents[0]))


REGISTRY: dict[str, FileFormat[Any]] = {
    "dxf": FileFormat(_flat_rounding, _arcs, _write_laser),
    "drawing": FileFormat(_drawing_rounding, _splines, _write_drawing_dxf),
    "svg": FileFormat(_flat_rounding, _arcs, _write_laser),
    "stl": FileFormat(_mesh_rounding, _chords, _write_stl),
    "3mf": FileFormat(lambda c: _TEXT_ROUNDINGS * _mesh_rounding(c), _chords, _write_3mf, _write_3mf_assembly),
    "step": FileFormat(_step_rounding, _solid_curves, _write_step, _write_step_assembly),
}
