"""The mate ``drawing_cams``: two cams on one shaft whose followers, along x and along y, draw a picture together."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import ParameterError
from geometry.base.findings import Finding
from parts.base.mate import End, MateKeys, MateKind, Mating, Pose, Standing
from parts.keys.base import mm
from parts.keys.mate import height
from parts.keys.picture import MOST_POINTS, Picture

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam

# places that are held against the picture, and of a line what rounding may add
_PLACES, _ROUNDING = 3600, 1e-6
_LINE = "the closed line that both lifts should draw: [lift of the first, lift of the second], in order"
_LEAVES = "how far the line that is drawn and that of the picture may leave each other"
_TOLERANCE = mm(_LEAVES, above=0, most=1000, example=0.2)


class DrawingCamsSpec(MateKeys, tag="drawing_cams", kw_only=True):
    """Keys of ``drawing_cams``."""

    first: Annotated[str, Meta(description="instance of the cam whose follower moves along x (direction_deg = 0)")]
    second: Annotated[str, Meta(description="that of the cam whose follower moves along y (direction_deg = 90)")]
    height: Annotated[float, height("how far the second's lower face stands above the first's", 10_000)] = 0.0
    line: Annotated[Picture, Meta(max_length=MOST_POINTS, description=_LINE)]
    tolerance: Annotated[float, _TOLERANCE] | None = None


class DrawingCamsMating(Mating, dict=True):
    """Both cams turn together, at one cam angle: the second a quarter of a turn ahead, as its follower is."""

    along_x: DiskCam
    along_y: DiskCam
    line: tuple[complex, ...]
    tolerance: float | None = None

    bond = "fixed"

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """On the same axis, a quarter of a turn ahead."""
        return centre, rotation + math.pi / 2

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the axes stand apart, mm, and the second's turn off its place, rad."""
        return self.off_place(first, second)

    def findings(self) -> tuple[Finding, ...]:
        """Whether one line leaves the other by more than it may."""
        if self.tolerance is None:
            return ()
        worst = max(self._off)
        return (Finding("picture_missed", worst, self.tolerance),) if worst > self.tolerance + _ROUNDING else ()

    @cached_property
    def _off(self) -> tuple[float, float]:
        """The greatest distance of what is drawn from the picture, and of the picture from what is drawn, mm."""
        import numpy as np

        from geometry.cams.picture import along, drawn, farthest

        corners = np.array(self.line)
        pen = drawn(self.along_x.motion, self.along_y.motion, np.linspace(0, 2 * math.pi, _PLACES, endpoint=False))
        return farthest(pen, corners), farthest(along(corners, _PLACES // 4)[1], pen)

    def quantities(self) -> dict[str, Any]:
        """How near the picture is, mm, and the greatest velocity, mm/rad, and acceleration, mm/rad^2, of the pen."""
        import numpy as np

        from geometry.cams.picture import drawn

        off, cut = self._off
        angles = np.linspace(0, 2 * math.pi, _PLACES, endpoint=False)
        fastest, hardest = (
            float(np.abs(drawn(self.along_x.motion, self.along_y.motion, angles, order)).max()) for order in (1, 2)
        )
        return {"picture_error": off, "corner_cut": cut, "pen_velocity": fastest, "pen_acceleration": hardest}


class DrawingCams(MateKind[DrawingCamsSpec, "DiskCam", "DiskCam"]):
    """Two disk cams that draw."""

    name, keys = "drawing_cams", DrawingCamsSpec
    joins = (("cam", "cam"),)

    def mating(self, keys: DrawingCamsSpec, first: End[DiskCam], second: End[DiskCam]) -> DrawingCamsMating:
        """Both followers slide."""
        for key, cam in (("mate.first", first), ("mate.second", second)):
            if cam.thing.swings:
                raise ParameterError(key, getattr(keys, key[5:]), "draws_by_sliding")
        return DrawingCamsMating(
            *self.joined(keys),
            height=keys.height,
            along_x=first.thing,
            along_y=second.thing,
            line=tuple(complex(*corner) for corner in keys.line),
            tolerance=keys.tolerance,
        )
