"""Written files of assemblies hold together by foreign readers: STL (trimesh), STEP (OCCT), DXF (ezdxf), manifold3d.

The meshes are put where the STEP has its instances; what is deeper in each other than meshes may be is an overlap.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import ezdxf
import ezdxf.path
import manifold3d
import numpy as np
import pytest
import shapely

from exporters.command.cli import main
from parts.scene.load import load_scene

if TYPE_CHECKING:
    import trimesh

TOLERANCE = 0.02
_HEAD = '[[assemblies]]\nkind = "{kind}"\n'
_EXPORTS = f"""
[[exports]]
format = "step"
assembly = true
tolerance = 1e-3

[[exports]]
format = "stl"
tolerance = {TOLERANCE}

[[exports]]
format = "dxf"
tolerance = 0.005
"""


class Files:
    """A built assembly as others read it: ``instances`` (id, part, matrix), and by part what its solid measures."""

    def __init__(self, kind: str, folder: Path) -> None:
        from OCP.BRepGProp import BRepGProp
        from OCP.GProp import GProp_GProps
        from OCP.STEPCAFControl import STEPCAFControl_Reader
        from OCP.TCollection import TCollection_ExtendedString
        from OCP.TDataStd import TDataStd_Name
        from OCP.TDF import TDF_Label, TDF_LabelSequence
        from OCP.TDocStd import TDocStd_Document
        from OCP.TopLoc import TopLoc_Location
        from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

        scene = folder / f"{kind}.toml"
        scene.write_text(_HEAD.format(kind=kind) + _EXPORTS, "utf-8")
        assert main(["build", str(scene), "--no-verify", "--quiet", "--out", str(folder)]) == 0
        self.folder = folder / kind
        self.scene = load_scene(str(scene))
        document = TDocStd_Document(TCollection_ExtendedString("d"))
        reader = STEPCAFControl_Reader()
        reader.SetNameMode(True)
        assert reader.ReadFile(str(self.folder / f"{kind}.step")) == 1
        reader.Transfer(document)
        self.instances: list[tuple[str, str, np.ndarray]] = []
        self.measured: dict[str, tuple[float, float, np.ndarray]] = {}

        def called(label: Any) -> str:
            name = TDataStd_Name()
            assert label.FindAttribute(TDataStd_Name.GetID_s(), name)
            return str(name.Get().ToExtString())

        def walk(label: Any, place: Any, own: str) -> None:
            if XCAFDoc_ShapeTool.IsAssembly_s(label):
                rows = TDF_LabelSequence()
                XCAFDoc_ShapeTool.GetComponents_s(label, rows)
                for k in range(1, rows.Length() + 1):
                    row, meant = rows.Value(k), TDF_Label()
                    XCAFDoc_ShapeTool.GetReferredShape_s(row, meant)
                    walk(meant, place.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(row)), called(row))
                return
            way, part = place.Transformation(), str(self.scene.instances[own].part)
            matrix = np.array([[way.Value(i, j) for j in (1, 2, 3, 4)] for i in (1, 2, 3)])
            self.instances.append((own, part, matrix))
            if part not in self.measured:
                shape = XCAFDoc_ShapeTool.GetShape_s(label)
                volume, area = GProp_GProps(), GProp_GProps()
                BRepGProp.VolumeProperties_s(shape, volume)
                BRepGProp.SurfaceProperties_s(shape, area)
                middle = volume.CentreOfMass()
                centre = np.array([middle.X(), middle.Y(), middle.Z()])
                self.measured[part] = volume.Mass(), area.Mass(), centre

        whole = TDF_LabelSequence()
        XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).GetFreeShapes(whole)
        for k in range(1, whole.Length() + 1):
            walk(whole.Value(k), TopLoc_Location(), called(whole.Value(k)))

    def mesh(self, part: str) -> trimesh.Trimesh:
        import trimesh

        found: Any = trimesh.load(self.folder / f"{part}.stl")
        assert found.is_watertight, part
        return found

    def outline(self, part: str) -> float | None:
        """Area within the contours of a DXF, mm^2, if there is one."""
        path = self.folder / f"{part}.dxf"
        if not path.is_file():
            return None
        drawing = ezdxf.readfile(path)
        loops = [
            shapely.Polygon([(p.x, p.y) for p in ezdxf.path.make_path(e).flattening(1e-3)])
            for e in drawing.modelspace().query("LWPOLYLINE[layer!='ENGRAVE']")
        ]
        # what lies within an odd number of contours
        area = 0.0
        for loop in loops:
            inner = loop.representative_point()
            depth = sum(other is not loop and other.contains(inner) and other.area > loop.area for other in loops)
            area += loop.area * (-1) ** depth
        return area

    def overlaps(self, spoiled: dict[str, Callable[[trimesh.Trimesh], Any]] | None = None) -> dict[Any, float]:
        """Pairs of parts that are deeper in each other than meshes may be, mm; some meshes spoiled before."""
        made: dict[str, Any] = {}
        for _, part, _ in self.instances:
            if part not in made:
                mesh = self.mesh(part)
                if spoiled and part in spoiled:
                    spoiled[part](mesh)
                made[part] = manifold3d.Manifold(
                    manifold3d.Mesh64(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.uint64))
                )
        stand = [(own, part, made[part].transform(matrix)) for own, part, matrix in self.instances]
        boxes = np.array([solid.bounding_box() for *_, solid in stand])
        only, found = set(spoiled or made), {}
        for i, (_, part, solid) in enumerate(stand):
            low, high = boxes[i + 1 :, :3], boxes[i + 1 :, 3:]
            for j in i + 1 + np.flatnonzero((low < boxes[i, 3:]).all(1) & (high > boxes[i, :3]).all(1)):
                _, other, two = stand[j]
                if not {part, other} & only:
                    continue
                common = solid ^ two
                depth = 2 * common.volume() / max(common.surface_area(), 1e-9)
                if depth > 2 * TOLERANCE:
                    key = frozenset((part, other))
                    found[key] = max(found.get(key, 0.0), depth)
        return found


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Files]:
    made: dict[str, Files] = {}

    def of(kind: str) -> Files:
        if kind not in made:
            made[kind] = Files(kind, tmp_path_factory.mktemp(kind))
        return made[kind]

    return of


@pytest.mark.heavy
@pytest.mark.parametrize("kind", ["power_table", "power_module"])
def test_dxf_step_and_stl_agree_in_area_volume_and_place(kind: str, files: Callable[[str], Files]) -> None:
    made = files(kind)
    assert len(made.instances) == len(made.scene.instances)
    assert set(made.measured) == set(made.scene.parts)
    flat = 0
    for part, (volume, area, centre) in made.measured.items():
        mesh = made.mesh(part)
        # chords leave no more than the tolerance all over the surface
        assert abs(mesh.volume - volume) <= TOLERANCE * area, part
        assert mesh.area == pytest.approx(area, rel=0.02), part
        assert np.abs(mesh.center_mass - centre).max() <= 2 * TOLERANCE, part
        if (outline := made.outline(part)) is not None:
            flat += 1
            solid = manifold3d.Manifold(
                manifold3d.Mesh64(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.uint64))
            )
            levels = np.unique(np.round(mesh.vertices[:, 2], 6))
            slices = [solid.slice(float(z)).area() for z in (levels[1:] + levels[:-1]) / 2]
            around = solid.project()
            around = min(abs(a - outline) for a in [*slices, around.area()])
            assert around <= TOLERANCE * area, part
    assert flat


def _moved(x: float) -> Callable[[trimesh.Trimesh], Any]:
    return lambda mesh: mesh.apply_translation([x, 0.0, 0.0])


def _longer(by: float) -> Callable[[trimesh.Trimesh], Any]:
    """What is above the middle goes up."""

    def stretch(mesh: trimesh.Trimesh) -> None:
        z = mesh.vertices[:, 2]
        mesh.vertices[z > (z.min() + z.max()) / 2, 2] += by

    return stretch


def _turned(angle: float) -> Callable[[trimesh.Trimesh], Any]:
    def turn(mesh: trimesh.Trimesh) -> None:
        from trimesh.transformations import rotation_matrix

        mesh.apply_transform(rotation_matrix(angle, [0, 0, 1]))

    return turn


def _wider(by: float) -> Callable[[trimesh.Trimesh], Any]:
    return lambda mesh: mesh.apply_scale(by)


@pytest.mark.heavy
def test_nothing_overlaps_in_the_written_module_and_a_spoiled_file_is_found(files: Callable[[str], Files]) -> None:
    made = files("power_module")
    assert made.overlaps() == {}
    for part, spoil, other in (
        ("disk_2", _moved(0.5), "protective_ring"), ("bolt_41", _longer(2.0), "spacer_24"),
        ("ball", _wider(8.1 / 8.0), "bearing_ring"), ("pinion", _turned(2 * np.pi / 96 / 4), "ring"),
        ("worm", _moved(0.5), "worm_wheel_23"),
    ):  # fmt: skip
        assert frozenset((part, other)) in made.overlaps({part: spoil}), part


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("part", "spoil", "other"),
    [("hub", _moved(0.5), "axle"), ("post", _longer(9.0), "flange"), ("pinion", _turned(np.pi / 64), "ring")],
)
def test_a_spoiled_file_of_the_table_is_found(
    part: str, spoil: Callable[[trimesh.Trimesh], Any], other: str, files: Callable[[str], Files]
) -> None:
    made = files("power_table")
    assert made.overlaps() == {}
    assert frozenset((part, other)) in made.overlaps({part: spoil})
