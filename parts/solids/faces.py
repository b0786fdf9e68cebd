"""The only builder of solids, faces half: the finished curves of a body, and its closed shell over them."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias, cast

from geometry.solids.body import Body
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import Solid

if TYPE_CHECKING:
    from geometry.approximation.outline import Outline

# of each profile, or the faces of a body that is told by them
Curves: TypeAlias = "tuple[Outline, ...] | tuple[FacedSolid]"


def solid_curves(body: Body | FacedBody, tolerance: float) -> Curves:
    """The curves of a body within ``tolerance`` mm."""
    if body.is_faced:
        return (body.within(tolerance),)
    from geometry.solids.body_faces import body_outlines

    return body_outlines(body, tolerance)


def solid_faces(body: Body | FacedBody, curves: Curves) -> Solid:
    """The closed shell of a body over its curves."""
    if body.is_faced:
        return cast("FacedSolid", curves[0]).geometry
    from geometry.solids.body_faces import body_solid

    return body_solid(body, cast("tuple[Outline, ...]", curves))
