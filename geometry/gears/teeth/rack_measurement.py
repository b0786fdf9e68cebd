"""What is measured on a rack: the height over a pin, and chords of its teeth; spur and helical.

``rack`` is the transverse section (``rack.checked_part_rack``), ``helix_angle`` in rad; what is measured stands in the
normal one. A helical rack's spaces are straight, so that pins lie in them as they do in a spur rack. Lengths in mm.
Source: a pin between two lines; the chords are those of a gear of infinitely many teeth, GOST 16532-70.
"""

from __future__ import annotations

import math

from geometry.base.both import both
from geometry.base.errors import ParameterError
from geometry.base.record import Record, replace
from geometry.curves.curve import end_point, start_point
from geometry.gears.teeth.measurement import Chord
from geometry.gears.teeth.rack import Rack
from geometry.gears.teeth.transverse import normal_angle
from geometry.plane.profile import Label


class OverPin(Record):
    """M from the rack's back to the top of a pin, mm, and where the pin touches, above the datum line, mm.

    ``touches_flanks``: between fillet and tip; ``stands_out``: above the tips, off the root line.
    """

    pin_diameter: float
    length: float
    contact_height: float
    touches_flanks: bool
    stands_out: bool


def flank_heights(rack: Rack) -> tuple[float, float]:
    """Heights above the datum line at which the flank begins over its fillet and ends at the tip or its break, mm."""
    flank = next(s.curve for s in rack.side.segments if s.label is Label.FLANK)
    return -end_point(flank).real, -start_point(flank).real


def space_width(rack: Rack, helix_angle: float = 0.0) -> float:
    """e_n on the datum line, mm."""
    return (rack.pitch - rack.tooth_thickness) * math.cos(helix_angle)


def pin_touching_at(rack: Rack, height: float, helix_angle: float = 0.0) -> float:
    """The pin that touches both flanks of a space at a height above the datum line, mm: width / cos(alpha)."""
    alpha = normal_angle(rack.rack.pressure_angle, helix_angle)
    return (space_width(rack, helix_angle) + 2 * height * math.tan(alpha)) / math.cos(alpha)


def pin_limits(rack: Rack, helix_angle: float = 0.0) -> tuple[float, float]:
    """The least and greatest pins that touch the flank itself, from its fillet to its tip, mm."""
    return both(pin_touching_at(rack, h, helix_angle) for h in flank_heights(rack))


def over_pin(rack: Rack, pin_diameter: float, helix_angle: float = 0.0) -> OverPin:
    """M = H - e_n / (2 tan(alpha_n)) + (1 + 1 / sin(alpha_n)) D / 2, H from the back to the datum line."""
    alpha = normal_angle(rack.rack.pressure_angle, helix_angle)
    centre = pin_diameter / 2 / math.sin(alpha) - space_width(rack, helix_angle) / 2 / math.tan(alpha)
    contact = centre - pin_diameter / 2 * math.sin(alpha)
    low, high = flank_heights(rack)
    stands_out = centre + pin_diameter / 2 > rack.addendum and centre - pin_diameter / 2 > -rack.dedendum
    length = rack.body_height + rack.dedendum + centre + pin_diameter / 2
    return OverPin(pin_diameter, length, contact, low <= contact <= high, stands_out)


def rack_with_size(rack: Rack, pin_diameter: float, length: float, helix_angle: float = 0.0) -> Rack:
    """The rack thinned so that its size over a pin is ``length``, mm.

    By ``over_pin`` M falls by A cos(beta) / (2 tan(alpha_n)).

    Raises
    ------
    ParameterError
        The size is that of a thicker tooth, or so small that the pin would lie on the root.
    """
    nominal = replace(rack, circumferential_thinning=0.0)
    whole = over_pin(nominal, pin_diameter, helix_angle).length
    if length > whole:
        raise ParameterError.beyond("measured_over_pin", length, "above_nominal", whole)
    if length < (least := rack.body_height + pin_diameter):
        raise ParameterError.beyond("measured_over_pin", length, "pin_falls_through", least)
    alpha = normal_angle(rack.rack.pressure_angle, helix_angle)
    thinning = 2 * math.tan(alpha) * (whole - length) / math.cos(helix_angle)
    return replace(rack, circumferential_thinning=thinning)


def reference_chord(rack: Rack, helix_angle: float = 0.0) -> Chord:
    """s_n on the datum line, and the addendum above it, mm."""
    return Chord(rack.tooth_thickness * math.cos(helix_angle), rack.addendum)


def constant_chord(rack: Rack, helix_angle: float = 0.0) -> Chord:
    """s_c = s_n cos^2(alpha_n), at a height h_a - s_c tan(alpha_n) / 2 from the tip; GOST 16532-70."""
    alpha = normal_angle(rack.rack.pressure_angle, helix_angle)
    thickness = rack.tooth_thickness * math.cos(helix_angle) * math.cos(alpha) ** 2
    return Chord(thickness, rack.addendum - thickness * math.tan(alpha) / 2)
