"""The only builder of solids, B-rep half: exact bodies for the kernel, finished curves in, nothing interpolated there.

Arcs become true circles (so tip, root and bore are cylinders), splines keep our poles and knots. Only the
modules of OCP that are needed are imported, and only here and in exporters/formats/step.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

from geometry.approximation.chamfered import Sections, chamfered_outlines, pieces_needed
from geometry.approximation.outline import Outline, spline_outline
from geometry.base.errors import GeometryError
from geometry.base.placement import Placement2
from geometry.plane.measure import profile_area
from geometry.solids.body import Body, Cap, Wall
from geometry.solids.chamfer import cut_chamfers
from geometry.solids.screw import cut_twists, turn_error, with_turn_error
from parts.solids.brep_chamfer import chamfer_faces
from parts.solids.brep_curves import closed_edges, wire_of
from parts.solids.brep_screw import ScrewFaces
from parts.solids.kernel import faces_of

_DEGREE = 7


def body_outlines(body: Body, tolerance: float) -> tuple[Outline, ...]:
    """Every profile of a body as finished curves within ``tolerance`` mm, on screw surfaces over them too.

    Degree 7: the kernel's files pay by the pole.
    """
    if body.is_faced:
        from geometry.cams.barrel.splines import barrel_splines

        return (barrel_splines(body.cam, tolerance),)
    body = _cut(body)
    twisted, made = body.twisted_profiles(), _chamfered_outlines(body, tolerance)
    for index, profile in enumerate(body.profiles):
        if index in made:
            continue
        turned = index in twisted
        own = tolerance - 2 * turn_error(profile.reach()) if turned else tolerance
        outline = spline_outline(profile, own, degree=_DEGREE, continuity=_DEGREE - 1, turned=turned)
        made[index] = with_turn_error(outline, profile.reach()) if turned else outline
    return tuple(made[i] for i in range(len(body.profiles)))


def _chamfered_outlines(body: Body, tolerance: float) -> dict[int, Outline]:
    """The outlines of profiles that chamfers join, each whole one with its ends."""
    # the pieces of a chamfer by the profiles where they begin and end
    pieces: dict[int, dict[int, Sections]] = {}
    for wall, whole, end in body.chamfers():
        own = partial(body.section_at, wall, whole, end)
        pieces.setdefault(body.loops[whole].profile, {}).setdefault(body.loops[end].profile, own)
    ends = {end for found in pieces.values() for end in found}
    made: dict[int, Outline] = {}
    for index in sorted(pieces.keys() - ends):
        indices, chamfers = [index], []
        for end, sections in pieces[index].items():
            chamfers.append([sections])
            indices.append(end)
            while indices[-1] in pieces:
                ((end, sections),) = pieces[indices[-1]].items()
                chamfers[-1].append(sections)
                indices.append(end)
        outlines = chamfered_outlines(body.profiles[index], chamfers, tolerance, degree=_DEGREE)
        made |= dict(zip(indices, outlines, strict=True))
    return made


def _cut(body: Body) -> Body:
    """The body with pieces of chamfers and of screw surfaces that one face each can follow."""
    body = cut_chamfers(body, lambda *chamfer: pieces_needed(partial(body.section_at, *chamfer)))
    return cut_twists(body)


def body_solid(body: Body, outlines: Sequence[Outline]) -> Any:
    """A TopoDS_Solid from the finished curves of a body's profiles.

    Walls that meet in a loop share its edges, so the shell is closed by construction: nothing is sewn, no boolean.

    Raises
    ------
    GeometryError
        The kernel refuses a face or the solid.
    """
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid
    from OCP.BRepLib import BRepLib
    from OCP.ShapeFix import ShapeFix_Shell
    from OCP.TopoDS import TopoDS_Shell

    if body.is_faced:
        from parts.solids.barrel_brep import barrel_solid

        return barrel_solid(body, outlines[0])
    body = _cut(body)
    wires: dict[int, Any] = {}
    edges: dict[int, list[Any]] = {}
    screws = ScrewFaces(body, outlines, wires)
    builder, shell = BRep_Builder(), TopoDS_Shell()
    builder.MakeShell(shell)
    for wall in body.walls:
        if body.is_screw(wall) and body.twist(wall):
            faces = screws.faces(wall)
        elif body.is_chamfer(wall):
            continue
        else:
            faces = _upright_faces(body, wall, outlines, wires, edges)
        for face in faces:
            builder.Add(shell, face)
    # chamfers take the edges of upright walls
    for wall, whole, end in body.chamfers():
        for face in chamfer_faces(body, wall, (whole, end), outlines, edges):
            builder.Add(shell, face)
    wires |= {loop: wire_of(made) for loop, made in edges.items()}
    for cap in body.caps:
        builder.Add(shell, _cap_face(body, cap, wires))
    shell.Closed(True)
    fixer = ShapeFix_Shell()
    fixer.FixFaceOrientation(shell)
    solid = BRepBuilderAPI_MakeSolid(fixer.Shell())
    if not solid.IsDone():
        raise GeometryError("the kernel makes no solid of this body")
    result = solid.Solid()
    BRepLib.OrientClosedSolid_s(result)
    return result


def _upright_faces(
    body: Body, wall: Wall, outlines: Sequence[Outline], wires: dict[int, Any], edges: dict[int, list[Any]]
) -> list[Any]:
    """Faces of a wall swept upwards or slantwise; its two wires are kept for caps, their edges for chamfers."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Vec
    from OCP.TopoDS import TopoDS

    low, high = body.height(wall)
    place, shear = body.loops[wall.lower], body.shear(wall)
    if wall.lower not in edges:
        curves = outlines[place.profile].curves()
        moved = place.placement != Placement2()
        edges[wall.lower] = closed_edges([c.placed(place.placement) if moved else c for c in curves], low)[0]
    prism = BRepPrimAPI_MakePrism(wire_of(edges[wall.lower]), gp_Vec(shear.real, shear.imag, high - low))
    if not prism.IsDone():
        raise GeometryError("the kernel makes no wall of this outline")
    edges[wall.upper] = [TopoDS.Edge_s(prism.LastShape(edge)) for edge in edges[wall.lower]]
    return list(faces_of(prism.Shape()))


def _cap_face(body: Body, cap: Cap, wires: dict[int, Any]) -> Any:
    """A plane face within the wires of its loops."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt

    plane = gp_Pln(gp_Pnt(0, 0, body.loops[cap.outer].z), gp_Dir(0, 0, 1))
    counter_clockwise = profile_area(body.loop_profile(cap.outer)) > 0
    outer = wires[cap.outer] if counter_clockwise else wires[cap.outer].Reversed()
    face = BRepBuilderAPI_MakeFace(plane, _as_wire(outer), True)
    for hole in cap.holes:
        clockwise = profile_area(body.loop_profile(hole)) < 0
        face.Add(_as_wire(wires[hole] if clockwise else wires[hole].Reversed()))
    if not face.IsDone():
        raise GeometryError("the kernel makes no face of this section")
    return face.Face() if cap.up else face.Face().Reversed()


def _as_wire(shape: object) -> Any:
    from OCP.TopoDS import TopoDS

    return TopoDS.Wire_s(shape)
