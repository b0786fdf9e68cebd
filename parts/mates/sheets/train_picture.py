"""A train of gears as its sheets need it: axes unfolded into one plane, teeth, meshes, how fast every link turns."""

from __future__ import annotations

from fractions import Fraction

from geometry.base.record import Record


class Link(Record):
    """A rigid body: how often it turns for one turn of the driver, and the height of its axis in the side view, mm.

    ``carrier``: the link that carries its axis, by number; None: the frame.
    """

    name: str
    axis: float
    rate: Fraction
    carrier: int | None = None


class Rim(Record):
    """A toothed rim of a link, at a ``level`` along the axes; ``internal``: its teeth point inwards."""

    name: str
    link: int
    teeth: int
    level: int = 0
    internal: bool = False


class TrainPicture(Record):
    """Links, rims, and the ``meshes`` of rims by number. Satellites that do the same stand here once."""

    links: tuple[Link, ...]
    rims: tuple[Rim, ...]
    meshes: tuple[tuple[int, int], ...]
    driver: int = 0

    def velocity(self, link: int, height: float) -> float:
        """Velocity of the point of a link at a height, mm per radian of the driver: one plane holds all axes."""
        body = self.links[link]
        own = 0.0 if body.carrier is None else self.velocity(body.carrier, body.axis)
        return own + float(body.rate) * (height - body.axis)

    def pitch_height(self, mesh: tuple[int, int]) -> float:
        """Where two rims roll on each other, mm: the axes are apart in the ratio of the teeth."""
        one, two = (self.rims[k] for k in mesh)
        low, high = (self.links[rim.link].axis for rim in (one, two))
        sign = -1 if one.internal or two.internal else 1
        return low + (high - low) * one.teeth / (one.teeth + sign * two.teeth)

    def radius(self, rim: int) -> float:
        """The least working radius of a rim, mm."""
        axis = self.links[self.rims[rim].link].axis
        return min(abs(self.pitch_height(mesh) - axis) for mesh in self.meshes if rim in mesh)

    def heights(self, link: int) -> list[float]:
        """Where a link has its axis, carries one, or meshes, mm, from below: the points of its velocities."""
        found = {self.links[link].axis, *(other.axis for other in self.links if other.carrier == link)}
        found |= {self.pitch_height(m) for m in self.meshes if link in (self.rims[k].link for k in m)}
        return sorted(found)

    def reach(self) -> tuple[float, float]:
        """The lowest and the highest point of all rims, mm."""
        ends = [self.links[r.link].axis + s * self.radius(k) for k, r in enumerate(self.rims) for s in (1, -1)]
        return min(ends), max(ends)
