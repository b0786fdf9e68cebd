"""The rim of a sprocket that is no plate: rows of teeth, bevelled at their tips, and the round core between them."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

from geometry.base.errors import OffsetError
from geometry.base.record import replace
from geometry.curves.curve import Reversed
from geometry.gears.chains.sprocket import Sprocket, sprocket_side
from geometry.plane.profile import Label, Profile, circle
from geometry.solids.body import BodyBuilder

# heights that differ by rounding only have one section, mm
_DIGITS = 12


def rows_of_teeth(sprocket: Sprocket, made: BodyBuilder, offset: float) -> tuple[int, int]:
    """The walls of all rows and of the core, moved ``offset`` mm, and the faces between them; the loops at both ends.

    Raises
    ------
    GeometryError
        The offset leaves no teeth above the core, or rounds the edges of bevelled ones.
    """
    radius, pitch, width = sprocket.core_radius + offset, sprocket.chain.transverse_pitch, sprocket.face_width
    if not radius <= sprocket.root_radius + offset:
        raise OffsetError(offset, "leaves_no_tooth")
    core = circle(radius, Label.HUB)
    row = _bevelled if sprocket.bevel else _upright
    ends = [row(sprocket, made, offset, k * pitch) for k in range(sprocket.strands)]
    for k, ((_, upper), (lower, _)) in enumerate(pairwise(ends)):
        foot, head = made.upright(core, k * pitch + width, (k + 1) * pitch)
        made.cap(upper, [foot], up=True)
        made.cap(lower, [head], up=False)
    return ends[0][0], ends[-1][1]


def _upright(sprocket: Sprocket, made: BodyBuilder, offset: float, low: float) -> tuple[int, int]:
    """A row of teeth from a height on."""
    return made.upright(sprocket_side(sprocket, offset).profile(), low, low + sprocket.face_width)


def _bevelled(sprocket: Sprocket, made: BodyBuilder, offset: float, low: float) -> tuple[int, int]:
    """The same, whose tips are cut by cones at both faces: the sections there are those of lower tips."""
    if offset > 0:
        raise OffsetError(offset, "offset_rounds_chamfered_edges")
    width, bevel = sprocket.face_width, sprocket.bevel
    foot, tip = sprocket.bevel_radius, sprocket.tip_radius

    @cache
    def section(inside: float) -> Profile:
        """So far within a face, mm."""
        profile = sprocket_side(sprocket, offset, foot + (tip - foot) * inside / bevel).profile()
        # arcs about one centre that end elsewhere are no cone: as curves of any kind they are followed by splines
        period = (
            s if s.label is Label.TIP_LAND else replace(s, curve=Reversed(s.curve.reversed())) for s in profile.period
        )
        return Profile(tuple(period), profile.count)

    ends, whole = section(0.0), section(bevel)
    loops = [
        made.loop(profile, low + z)
        for profile, z in ((ends, 0.0), (whole, bevel), (whole, width - bevel), (ends, width))
    ]
    made.wall(loops[0], loops[1], lambda z: section(round(z - low, _DIGITS)))
    made.wall(loops[1], loops[2])
    made.wall(loops[2], loops[3], lambda z: section(round(low + width - z, _DIGITS)))
    return loops[0], loops[3]
