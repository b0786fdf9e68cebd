"""The rim of a sprocket for several strands: rows of teeth, and the round core between them."""

from __future__ import annotations

from itertools import pairwise

from geometry.base.errors import OffsetError
from geometry.gears.chains.sprocket import Sprocket, sprocket_side
from geometry.plane.profile import Label, circle
from geometry.solids.body import BodyBuilder


def rows_of_teeth(sprocket: Sprocket, made: BodyBuilder, offset: float) -> tuple[int, int]:
    """The walls of all rows and of the core, moved ``offset`` mm, and the faces between them; the loops at both ends.

    Raises
    ------
    GeometryError
        The offset leaves no teeth above the core.
    """
    teeth = sprocket_side(sprocket, offset).profile()
    radius, pitch, width = sprocket.core_radius + offset, sprocket.chain.transverse_pitch, sprocket.face_width
    if not radius <= sprocket.root_radius + offset:
        raise OffsetError(offset, "leaves_no_tooth")
    core = circle(radius, Label.HUB)
    ends = [made.upright(teeth, k * pitch, k * pitch + width) for k in range(sprocket.strands)]
    for k, ((_, upper), (lower, _)) in enumerate(pairwise(ends)):
        foot, head = made.upright(core, k * pitch + width, (k + 1) * pitch)
        made.cap(upper, [foot], up=True)
        made.cap(lower, [head], up=False)
    return ends[0][0], ends[-1][1]
