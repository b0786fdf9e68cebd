"""The only builder of solids, faces half: the finished curves of a body, and its closed shell over them."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias, cast

from geometry.solids.body import Body
from geometry.solids.faces import Solid

if TYPE_CHECKING:
    from geometry.approximation.outline import Outline
    from geometry.cams.barrel.body import BarrelBody
    from geometry.cams.barrel.splines import BarrelSplines

# of each profile, or of a cylindrical cam its walls
Curves: TypeAlias = "tuple[Outline, ...] | tuple[BarrelSplines]"

_BARREL = 1e-6


def solid_curves(body: Body | BarrelBody, tolerance: float) -> Curves:
    """The curves of a body within ``tolerance`` mm."""
    if body.is_faced:
        from geometry.cams.barrel.splines import barrel_splines

        # with fewer poles the edges leave the walls by more than solids allow
        return (barrel_splines(body.cam, min(tolerance, _BARREL), body.bore),)
    from geometry.solids.body_faces import body_outlines

    return body_outlines(body, tolerance)


def solid_faces(body: Body | BarrelBody, curves: Curves) -> Solid:
    """The closed shell of a body over its curves."""
    if body.is_faced:
        from geometry.cams.barrel.faces import barrel_solid

        return barrel_solid(body, cast("BarrelSplines", curves[0]))
    from geometry.solids.body_faces import body_solid

    return body_solid(body, cast("tuple[Outline, ...]", curves))
