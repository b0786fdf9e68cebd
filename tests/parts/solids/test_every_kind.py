"""Solids and sections of every kind: meshes close and hold what exact integrals say, outlines move by their offset."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely

from geometry.approximation.chords import approximate_profile
from geometry.base.errors import GeometryError
from parts.base.part import Part
from parts.gears.worm_wheel.part import WormWheelKind
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.mesh import Mesh, body_mesh, mesh_outlines
from tests import brute
from tests.exporters.production.test_dimensioned import PARTS as TURNED
from tests.exporters.production.test_part_drawings import PARTS as DRAWN
from tests.offered import scenes
from tests.parts.bodies.test_turned import BALL, COVER, GROOVED

# so near that a tooth that is lost weighs more than all that meshes leave out
NEAR = 0.01
_SPUR: dict[str, Any] = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 24}
_WORM: dict[str, Any] = {"kind": "worm", "module": 3.0, "thread_length": 45.0, "number_of_starts": 2}
_RING: dict[str, Any] = {"kind": "pin_ring", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0}
_PLATE: dict[str, Any] = {"kind": "output_plate", "number_of_pins": 6, "pin_diameter": 6.0, "pin_circle_diameter": 56.0,
                          "outer_diameter": 70.0, "bore_diameter": 10.0}  # fmt: skip
MADE: dict[str, dict[str, Any]] = {
    **{f"drawn {name}": keys for name, keys in DRAWN.items() if name not in ("thin", "long")},
    **{f"turned {name}": keys for name, keys in TURNED.items()},
    "ball": BALL, "grooved": GROOVED, "cover": COVER,
    "double": _SPUR | {"helix_angle_deg": 25.0, "double_helical": True,
                       "bore": {"shape": "double_D", "diameter": 10.0, "across_flats": 8.0}},
    "square": _SPUR | {"bore": {"shape": "square", "across_flats": 10.0}, "tip_rounding": 0.3},
    "spoked": _SPUR | {"number_of_teeth": 50, "bore": {"shape": "D", "diameter": 10.0, "flat": 8.0},
                       "spokes": {"count": 5, "width": 8.0, "inner_diameter": 30.0, "outer_diameter": 84.0}},
    "helical ring": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 50, "helix_angle_deg": 15.0},
    "holes with a wall": _RING | {"pins": "holes", "inner_diameter": 50.0},
    "half round": _RING | {"pins": "half_round"},
    "plate of pins": _PLATE, "plate with seats": _PLATE | {"pins": "holes"},
    "worm of two starts": _WORM, "left worm": _WORM | {"hand": "left"},
}  # fmt: skip
_MORE = ("wedge", "groove", "cam with holes", "barrel")
SCENES = [name for name in scenes() if name.startswith("new ") or name in _MORE]


@cache
def parts_of(name: str) -> dict[str, Part]:
    raw = {"parts": {"p": MADE[name]}} if name in MADE else scenes()[name]
    return make_parts(scene_from_dict(raw, name, name), name)[0]


def is_closed(triangles: np.ndarray) -> bool:
    """Whether each edge is run along once in either direction."""
    starts, ends = (np.concatenate([triangles[:, k - j] for k in range(3)]).astype(np.int64) for j in (0, 2))
    there, back = np.sort(starts << 32 | ends), np.sort(ends << 32 | starts)
    return bool((np.diff(there) > 0).all() and (there == back).all())


def integrals(mesh: Mesh) -> tuple[float, np.ndarray, np.ndarray, float]:
    """Volume, volume times centre, second moments and area of a mesh: by the tetrahedra over its triangles."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    total = a + b + c
    squares = sum(np.einsum("i,ij,ik->jk", volumes, x, x) for x in (a, b, c, total)) / 20
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    return float(volumes.sum()), volumes @ total / 4, np.asarray(squares), area


@pytest.mark.sampled(9)
@pytest.mark.parametrize("name", [*MADE, *SCENES])
def test_a_mesh_is_closed_and_holds_what_exact_integrals_say(name: str) -> None:
    for part in parts_of(name).values():
        body = part.body(0.0)
        mesh = body_mesh(body, mesh_outlines(body, NEAR, 0.0))
        assert is_closed(mesh.triangles)
        volume, first, second, area = integrals(mesh)
        exact = part.made_by.moments(body)
        assert volume == pytest.approx(exact.volume, abs=NEAR * area)
        reach = float(np.abs(mesh.vertices).max())
        assert first == pytest.approx(exact.volume * exact.centre, abs=NEAR * area * reach)
        inertia = np.eye(3) * np.trace(second) - second
        assert inertia == pytest.approx(exact.inertia, abs=2 * NEAR * area * reach**2)
        low, high = mesh.vertices[:, 2].min(), mesh.vertices[:, 2].max()
        if part.is_plate and len(np.unique(mesh.vertices[:, 2])) == 2:
            assert high - low == pytest.approx(part.face_width, abs=1e-6)
            assert exact.volume == pytest.approx(outline(part, 0.0).area * part.face_width, abs=NEAR * area)


def outline(part: Part, offset: float) -> shapely.Polygon:
    region = part.section(offset).region
    outer, *holes = (
        approximate_profile(p, NEAR / 20, arcs=False).geometry.expanded()[0] for p in (region.outer, *region.holes)
    )
    return shapely.Polygon([(p.real, p.imag) for p in outer], [[(p.real, p.imag) for p in hole] for hole in holes])


@pytest.mark.sampled(12)
@pytest.mark.parametrize(
    # of a barrel the jackets are developed, which takes as long as all others together
    "name",
    [pytest.param(name, marks=[pytest.mark.heavy] * (name == "barrel")) for name in [*MADE, *SCENES]],
)
@pytest.mark.parametrize("offset", [0.05, -0.05])
def test_every_boundary_of_a_section_moves_by_the_offset(name: str, offset: float) -> None:
    """Each point of the moved outline stands that far from the plain one, or farther at a corner, on the right side."""
    judged = 0
    for part in parts_of(name).values():
        # its section is a picture
        if isinstance(part.made_by, WormWheelKind):
            continue
        try:
            plain, moved = outline(part, 0.0), outline(part, offset)
        except GeometryError:
            continue
        judged += 1
        assert len(plain.interiors) == len(moved.interiors)
        points = shapely.points(shapely.get_coordinates(moved))
        away = brute.distance_to_polygon(plain, points)
        shapely.prepare(plain)
        inside = shapely.contains(plain, points)
        assert (inside == (offset < 0)).all()
        assert away.min() > abs(offset) - 2 * NEAR / 20 - 1e-6
        assert np.median(away) < abs(offset) + 2 * NEAR / 20 + 1e-6
        assert away.max() < abs(offset) * 5
        grown = plain.area + offset * plain.length
        assert moved.area == pytest.approx(
            grown, abs=20 * offset**2 * math.sqrt(len(points)) + NEAR / 10 * plain.length
        )
    # worms, their wheels, bevel and face gears are not drawn in: only they are not judged
    kinds = {part.kind for part in parts_of(name).values()}
    assert judged or kinds <= {"worm", "worm_wheel", "bevel_gear", "face_gear"}


def test_a_lost_triangle_and_an_outline_that_stays_are_seen() -> None:
    part = parts_of("square")["p"]
    body = part.body(0.0)
    mesh = body_mesh(body, mesh_outlines(body, NEAR, 0.0))
    assert is_closed(mesh.triangles)
    assert not is_closed(mesh.triangles[1:])
    assert not is_closed(np.vstack([mesh.triangles, mesh.triangles[:1]]))
    # about half a pitch wide, 2.25 modules high
    tooth = math.pi * 2.0 / 2 * 4.5 * part.face_width
    assert tooth > 1.5 * NEAR * integrals(mesh)[3]
    still = shapely.points(shapely.get_coordinates(outline(part, 0.0)))
    assert brute.distance_to_polygon(outline(part, 0.0), still).max() < 1e-9
