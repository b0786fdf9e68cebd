"""The rack that cuts: ISO 53 / GOST 13755 profiles and any other straight-sided one.

Coefficients are in modules. The cutting rack's tip reaches the dedendum h_f = addendum + clearance
below its datum line; its tip corner is rounded, which leaves the root fillet.
"""

from __future__ import annotations

import math

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import Record

# (addendum, tip clearance, tip radius) of ISO 53:1998 and GOST 13755-2015, all at 20 degrees
ISO_53 = {"A": (1.0, 0.25, 0.38), "B": (1.0, 0.25, 0.30), "C": (1.0, 0.25, 0.25), "D": (1.0, 0.40, 0.39)}
ISO_53_ANGLE = math.radians(20.0)


class TipRelief(Record):
    """Flanking of the basic rack: its last ``height`` modules below the tip line fall back by ``depth``.

    ``depth`` is measured along the normal of the main flank at the tip line. Practicum, figure 1.4:
    h_c = 0.45 m; GOST 13755: depth at most 0.02.
    """

    depth: float
    height: float = 0.45


class BasicRack(Record):
    """A cutting rack: pressure angle in rad, the rest in modules.

    ``stretch``: how much longer the tip rounding is along the pitch line than along the depth, ``tip_radius``; 1 is the
    circle of a rack in its own section, 1 / cos(beta) the ellipse in the transverse section of a helical one.
    """

    pressure_angle: float
    addendum: float
    tip_clearance: float
    tip_radius: float
    relief: TipRelief | None = None
    stretch: float = 1.0

    @property
    def dedendum(self) -> float:
        """h_f: depth of the rack's tip line below the datum line."""
        return self.addendum + self.tip_clearance

    @property
    def _support(self) -> float:
        """Distance of the flank from the rounding's centre, in tip radii; 1 for a circle."""
        return math.hypot(math.sin(self.pressure_angle), self.stretch * math.cos(self.pressure_angle))

    @property
    def form_dedendum(self) -> float:
        """h_Ff: depth at which the straight flank ends and the rounding begins."""
        sine = math.sin(self.pressure_angle)
        return self.dedendum - self.tip_radius * (1 - sine / self._support)

    @property
    def rounding_depth(self) -> float:
        """Depth of the rounding centre below the datum line."""
        return self.dedendum - self.tip_radius

    @property
    def rounding_half_distance(self) -> float:
        """Distance of the rounding centre from the centre line of the rack tooth; 0 is the full round."""
        alpha = self.pressure_angle
        reach = math.pi / 4 - self.rounding_depth * math.tan(alpha) - self.tip_radius * self._support / math.cos(alpha)
        return max(reach, 0.0)

    @property
    def relief_angle(self) -> float:
        """Profile angle of the relieved part, rad."""
        if self.relief is None:
            return self.pressure_angle
        alpha = self.pressure_angle
        return alpha + math.atan2(self.relief.depth * math.cos(alpha), self.relief.height)


def full_round_radius(pressure_angle: float, dedendum: float) -> float:
    """The tip radius, in modules, at which both roundings of the rack tooth meet; negative: pointed."""
    half_tip = math.pi / 4 - dedendum * math.tan(pressure_angle)
    return half_tip * math.cos(pressure_angle) / (1 - math.sin(pressure_angle))


def default_tip_radius(pressure_angle: float, addendum: float, clearance: float, table: float) -> float:
    """Least of the table's radius, c/(1 - sin alpha) (keeps the mate's tip off) and the full round."""
    at_clearance = clearance / (1 - math.sin(pressure_angle))
    return max(min(table, at_clearance, full_round_radius(pressure_angle, addendum + clearance)), 0.0)


def iso_53(profile: str = "A", pressure_angle: float = ISO_53_ANGLE, relief: TipRelief | None = None) -> BasicRack:
    """ISO 53 profile A to D; away from 20 degrees its kin with the default tip radius."""
    addendum, clearance, table = ISO_53[profile]
    radius = table
    if pressure_angle != ISO_53_ANGLE:
        radius = default_tip_radius(pressure_angle, addendum, clearance, table)
    return checked_rack(BasicRack(pressure_angle, addendum, clearance, radius, relief))


def checked_rack(rack: BasicRack) -> BasicRack:
    """The rack itself, or a refusal that names the largest value that fits its tooth.

    Raises
    ------
    ParameterError
        The rack tooth is pointed above its tip line, its rounding does not fit, or the relief leaves
        no main flank.
    """
    alpha = rack.pressure_angle
    if not 0 < alpha < math.pi / 2:
        raise ParameterError("pressure_angle", alpha, "not_below_right_angle")
    for name, value in (
        ("addendum", rack.addendum),
        ("tip_clearance", rack.tip_clearance),
        ("tip_radius", rack.tip_radius),
    ):
        if not 0 <= value < math.inf:
            raise ParameterError(f"rack.{name}", value, "not_finite_or_negative", Nearest(0.0))
    largest = full_round_radius(alpha, rack.dedendum)
    if largest < 0:
        depth = math.pi / 4 / math.tan(alpha)
        name = "tip_clearance" if depth > rack.addendum else "addendum"
        value = getattr(rack, name)
        most = limit(depth - rack.dedendum + value, value)
        raise ParameterError(f"rack.{name}", value, "rack_pointed", most, angle=math.degrees(alpha))
    if rack.tip_radius > largest * (1 + 1e-12):
        raise ParameterError("rack.tip_radius", rack.tip_radius, "rack_rounding_does_not_fit", limit(largest, math.inf))
    if rack.relief is not None:
        _check_relief(rack, rack.relief)
    return rack


def _check_relief(rack: BasicRack, relief: TipRelief) -> None:
    if not 0 < relief.height <= rack.addendum:
        most = Nearest(rack.addendum, "at_most") if relief.height > 0 else None
        raise ParameterError("relief.height", relief.height, "relief_beyond_addendum", most, addendum=rack.addendum)
    # the relieved flanks of the basic rack tooth must not meet below its tip line
    half_tip = math.pi / 4 - rack.addendum * math.tan(rack.pressure_angle)
    largest = half_tip * math.cos(rack.pressure_angle)
    if not 0 <= relief.depth < largest:
        most = limit(largest, math.inf)
        raise ParameterError("relief.depth", relief.depth, "relieved_flanks_meet", most, customary=0.02)
