"""The steps of a timing belt and of its pulleys, as pages and tables of drawings have them."""

from __future__ import annotations

import math

from geometry.gears.belts.belt import ArcGroove, Belt
from geometry.gears.belts.pulley import Pulley
from parts.pages.page import Sheet


def belt_steps(page: Sheet, belt: Belt) -> None:
    """What is known of the belt."""
    page.told(belt_pitch=belt.pitch, pitch_line_offset=belt.line_offset)


def circle_steps(page: Sheet, pulley: Pulley, gear: int = 0) -> None:
    """Its circles."""
    page.add("belt_pitch_diameter", 2 * pulley.pitch_radius, "{p} * {z#} / pi", "", gear)
    outer = "" if pulley.given_outer_diameter is not None else "{d#} - 2 * {a_p}"
    page.add("pulley_outer_diameter", 2 * pulley.outer_radius, outer, "", gear)


def groove_steps(page: Sheet, pulley: Pulley) -> None:
    """A groove, and the land between two."""
    groove = pulley.belt.groove_of(pulley.number_of_teeth)
    walls = pulley.clearance
    page.told(groove_clearance=walls or None, pulley_groove_depth=pulley.depth)
    page.add("pulley_root_diameter", 2 * pulley.root_radius, "{d_a} - 2 * {h_g}")
    if isinstance(groove, ArcGroove):
        page.told(groove_floor_radius=groove.floor_radius + walls, groove_flank_radius=groove.flank_radius + walls)
        page.add("flank_centre_offset", groove.flank_offset)
    else:
        width = groove.width_of(pulley.outer_radius, walls)
        page.add("groove_floor_width" if groove.at_floor else "groove_corner_width", width)
        page.told(groove_angle_deg=math.degrees(2 * groove.half_angle), greatest_root_radius=groove.root_radius + walls)
    page.told(groove_tip_radius=groove.tip_radius, land_width=pulley.land)
