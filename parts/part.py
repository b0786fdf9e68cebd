"""A part: parameters turned into exact sections and solids, ready for every exporter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from geometry.findings import Finding
from geometry.offset_region import OffsetRegion

if TYPE_CHECKING:
    from geometry.cams.barrel_body import BarrelBody
    from geometry.cams.disk import DiskCam
    from geometry.cams.walls import CamWall
    from geometry.cams.wedge import WedgeCam


@dataclass(frozen=True, slots=True)
class Part:
    """A part with one flat section for plane formats and one solid, lower face of its rim at z = 0.

    ``section(offset)`` and ``body(offset)`` (a Body; a BarrelBody of a cylindrical cam) give the exact geometry with
    every boundary moved ``offset`` mm out of the material; both are computed when an export asks.
    ``face_width``: height of the toothed rim, mm.
    ``circles`` are named diameters in mm for drawings and
    reports, ``quantities`` all other named results. ``density`` in g/cm^3, None where the material is not known.
    ``flat_findings``: remarks on each flat outline of the part.
    ``cam``: of a disk cam, whose follower is rolled over every file; over the ``walls`` where there are some.
    ``wedge``: of a sliding cam, and ``barrel``: of a cylindrical one, likewise.
    """

    id: str
    kind: str
    section: Callable[[float], OffsetRegion]
    body: Callable[[float], Any]
    face_width: float
    is_plate: bool = True
    findings: tuple[Finding, ...] = ()
    circles: dict[str, float] = field(default_factory=dict)
    quantities: dict[str, float] = field(default_factory=dict)
    material: str | None = None
    colour: str | None = None
    density: float | None = None
    flat_findings: tuple[Finding, ...] = ()
    cam: DiskCam | None = None
    walls: tuple[CamWall, ...] = ()
    wedge: WedgeCam | None = None
    barrel: BarrelBody | None = None

    @property
    def is_cam(self) -> bool:
        """Whether a follower is rolled over every file of the part."""
        return self.cam is not None or self.wedge is not None or self.barrel is not None

    def to_trimesh(self, tolerance: float = 0.01, offset: float = 0.0) -> Any:
        """A ``trimesh.Trimesh`` within ``tolerance`` mm of the exact solid."""
        import trimesh

        from parts.solids import body_mesh, mesh_outlines

        body = self.body(offset)
        mesh = body_mesh(body, mesh_outlines(body, tolerance, 0.0))
        return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)

    def to_cadquery(self, tolerance: float = 1e-6, offset: float = 0.0) -> Any:
        """A ``cadquery.Workplane`` that holds the solid, splines within ``tolerance`` mm; needs cadquery."""
        try:
            import cadquery
        except ImportError as error:
            text = 'to_cadquery needs cadquery: pip install "cadquery" in place of cadquery-ocp-novtk'
            raise ImportError(text) from error
        from parts.brep import body_outlines, body_solid

        body = self.body(offset)
        solid = cadquery.Solid(body_solid(body, body_outlines(body, tolerance)))
        return cadquery.Workplane("XY").newObject([solid])
