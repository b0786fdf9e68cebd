"""The only builder of solids, faces half: the finished curves of a body, and its closed shell over them."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias, cast

from geometry.solids.body import Body
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import Solid

if TYPE_CHECKING:
    from geometry.approximation.outline import Outline
    from geometry.solids.measured import Faced

_BARREL = 1e-6
# of each profile, or the faces of a body that is told by them
Curves: TypeAlias = "tuple[Outline, ...] | tuple[FacedSolid]"


def solid_curves(body: Body | Faced, tolerance: float) -> Curves:
    """The curves of a body within ``tolerance`` mm."""
    if body.is_faced:
        return (_within(body, tolerance),)
    from geometry.solids.body_faces import body_outlines

    return body_outlines(body, tolerance)


def _within(body: Faced, tolerance: float) -> FacedSolid:
    if isinstance(body, FacedBody):
        return body.within(tolerance)
    from geometry.cams.barrel.body import BarrelBody
    from geometry.cams.barrel.faces import barrel_solid
    from geometry.cams.barrel.splines import barrel_splines

    assert isinstance(body, BarrelBody)
    # with fewer poles the edges leave the walls by more than solids allow
    made = barrel_splines(body.cam, min(tolerance, _BARREL), body.bore)
    return FacedSolid(barrel_solid(body, made), made.max_error, made.bound)


def solid_faces(body: Body | Faced, curves: Curves) -> Solid:
    """The closed shell of a body over its curves."""
    if body.is_faced:
        return cast("FacedSolid", curves[0]).geometry
    from geometry.solids.body_faces import body_solid

    return body_solid(body, cast("tuple[Outline, ...]", curves))
