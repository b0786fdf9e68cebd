"""What a writer gets and what it leaves behind."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from geometry.approximate import approximate_profile
from geometry.body import Body
from geometry.contour import Approximation
from geometry.errors import ParameterError, at_least
from geometry.findings import Finding
from geometry.offset_region import OffsetRegion
from geometry.profile import Region
from geometry.tolerance import LEAST_SEGMENT_MM
from parts.part import Part
from parts.scene import ExportSpec

SOLID_FORMATS = ("stl", "3mf", "step")
# more edges than any receiving program opens; one file of them is some 300 MB
_MOST_EDGES = 4_000_000
# a float32 coordinate is good to 2^-24 of its size, both of them together to sqrt(2) of that
_FLOAT32 = 2.0**-24 * 1.5
# SVG coordinates are written to 1e-9 mm; radii too, which moves an arc's crown by less
_SVG_ROUNDING = 2e-9
# DXF coordinates are written with 16 digits
_DXF_ROUNDING = 2e-15
# the kernel writes 15 digits and turns every curve once more when it reads them
_STEP_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class Job:
    """One part in one format: the exact section it must match, its file, and where the scene asks for it."""

    part: Part
    export: ExportSpec
    section: OffsetRegion
    path: str
    place: str

    @property
    def members(self) -> tuple[Job, ...]:
        """The jobs of the parts in the file: itself; an assembly has more."""
        return (self,)

    @property
    def body(self) -> Body:
        """The exact solid, moved like the section."""
        return self.part.body(self.section.offset)

    @property
    def is_solid(self) -> bool:
        """Whether the format holds a solid, not a flat outline."""
        return self.export.format in SOLID_FORMATS

    @property
    def exact(self) -> Region | Body:
        """What the file must agree with."""
        return self.body if self.is_solid else self.section.region

    @property
    def is_mesh(self) -> bool:
        """Whether the format holds triangles, with coordinates as float32."""
        return self.export.format in ("stl", "3mf")

    @property
    def kind(self) -> str:
        """What the read-back must expect: the format, or "drawing" for a DXF of splines."""
        return "drawing" if self.export.format == "dxf" and self.is_cad else self.export.format

    @property
    def is_cad(self) -> bool:
        """Whether the format holds splines."""
        return self.export.format == "step" or self.export.purpose == "drawing"

    @property
    def layer_order(self) -> tuple[str, ...]:
        """Layer of each boundary in ``approximations``: inner ones are cut first."""
        return self.section.region.layers()


@dataclass(frozen=True, slots=True)
class Written:
    """A file that was written and read back, with what was measured on it."""

    job: Job | AssemblyJob | SheetJob
    file: Path
    max_error: float
    bound: str
    entities: dict[str, int]
    measured: dict[str, float]
    findings: tuple[Finding, ...]
    failures: tuple[str, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)


if TYPE_CHECKING:
    from exporters.assembly import AssemblyJob
    from exporters.sheets.job import SheetJob
    from geometry.outline import Outline

Shape: TypeAlias = "tuple[Approximation, ...] | tuple[Outline, ...]"


def shape_of(job: Job) -> Shape:
    """The boundaries of a job's section, holes first, or of its solid: splines for CAD, else lines and arcs.

    Raises
    ------
    ParameterError, ConvergenceError
        The tolerance asks for more than the format can carry.
    """
    if not job.is_cad:
        return approximations(job)
    from geometry.outline import spline_outline

    tolerance = float(job.export.tolerance or 0.0) - number_rounding(job)
    if job.is_solid:
        from parts.brep import body_outlines

        return body_outlines(job.body, tolerance)
    # cubics are what drawings read everywhere
    return tuple(spline_outline(p, tolerance, degree=3, continuity=2) for p in job.section.region.profiles())


def approximations(job: Job) -> tuple[Approximation, ...]:
    """The boundaries of a job's section, holes first, or of its mesh, as its format and tolerance want them.

    Raises
    ------
    ParameterError
        The tolerance asks for more edges than a file can carry, or is below what a mesh file's numbers resolve.
    """
    tolerance, rounding = float(job.export.tolerance or 0.0), number_rounding(job)
    arcs = job.export.curves == "arcs" and not job.is_mesh
    # the rounding of the file's numbers takes its share of the tolerance first
    if job.is_mesh:
        from parts.solids import count_edges, mesh_outlines

        if tolerance < 8 * rounding:
            remedy = f"a mesh file stores 7 digits, at this size at least {at_least(8 * rounding)} mm works"
            raise ParameterError("tolerance", tolerance, remedy)
        made = mesh_outlines(job.body, tolerance - rounding, 64 * rounding)
        edges = count_edges(job.body, made)
    else:
        made = tuple(
            approximate_profile(p, tolerance - rounding, arcs=arcs, least_edge=LEAST_SEGMENT_MM)
            for p in job.section.region.profiles()
        )
        edges = sum(len(a.geometry) for a in made)
    if edges > _MOST_EDGES:
        factor = (edges / _MOST_EDGES) ** (3 if arcs else 2)
        remedy = f"would need {edges} edges; {at_least(tolerance * factor)} mm works"
        raise ParameterError("tolerance", tolerance, remedy)
    return made


def number_rounding(job: Job) -> float:
    """How far the rounding of a file's numbers may move an outline, mm."""
    reach = job.body.section_reach() if job.is_solid else job.section.region.outer.reach()
    if job.is_mesh:
        # 3MF writes its float32 numbers as text, which rounds them once more
        reach += job.body.steepness() * max(map(abs, job.body.levels()))
        return _FLOAT32 * reach * (2 if job.export.format == "3mf" else 1)
    if job.export.format == "step":
        return _STEP_ROUNDING * reach
    return _SVG_ROUNDING if job.export.format == "svg" else _DXF_ROUNDING * reach


def declared_error(job: Job, made: Shape) -> tuple[float, str]:
    """The bound of a whole file, mm: the worst boundary plus the rounding of its numbers."""
    worst, rounding = max(a.max_error for a in made), number_rounding(job)
    kinds = {a.bound for a in made}
    bound = "sampled" if "sampled" in kinds else "certified" if "certified" in kinds else "exact"
    return worst + rounding, bound
