"""Which teeth of all a sector gear, or a mutilated one, keeps, and what the rest of its rim is."""

from __future__ import annotations

from geometry.base.record import Record


class Sector(Record):
    """The teeth that are kept: so many in each of ``runs`` equal runs, evenly spaced; lengths in mm.

    ``first``: number of the first tooth of a run, counter-clockwise from the tooth on +x, which is 0; in a ring from
    the one that follows the space on +x. ``blank_diameter`` None: the root circle. ``hub_diameter``: the rest is cut
    away but for a hub of that size; None: it is a blank. ``corner_radius`` rounds the corners of the rest.
    """

    teeth: int
    first: int
    runs: int = 1
    blank_diameter: float | None = None
    hub_diameter: float | None = None
    corner_radius: float = 0.0

    @property
    def is_cut(self) -> bool:
        """Whether the rest of the rim is cut away."""
        return self.hub_diameter is not None

    @property
    def stands_off(self) -> bool:
        """Whether the rest has corners of its own."""
        return self.is_cut or self.blank_diameter is not None

    def has_opposite_spaces(self, number_of_teeth: int) -> bool:
        """Whether two whole spaces stand as nearly opposite as those of a gear with all of its teeth."""
        pitches = number_of_teeth // self.runs
        spaces = {(run * pitches + k) % number_of_teeth for run in range(self.runs) for k in range(self.teeth - 1)}
        return any((space + number_of_teeth // 2) % number_of_teeth in spaces for space in spaces)

    def core_radius(self, root_radius: float) -> float:
        """Radius of the circle of the rest about the axis, mm."""
        rest = self.hub_diameter if self.is_cut else self.blank_diameter
        return root_radius if rest is None else rest / 2

    def centre(self, number: int, pitch: float, sign: int) -> float:
        """Direction of the centre line of tooth ``number`` of the first run, rad."""
        return (self.first + number + (0.0 if sign > 0 else 0.5)) * pitch


def centred(teeth: int, sign: int = 1) -> int:
    """The first of so many teeth about +x: one of an odd number of a gear's is on it, others are half a pitch off."""
    return -(teeth // 2) if sign < 0 else -((teeth - 1) // 2)
