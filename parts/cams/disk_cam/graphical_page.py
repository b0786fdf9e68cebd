"""The section "graphical method" of ``higherpair calc cam``: what a student's drawing gives, and how far it is off."""

from __future__ import annotations

import math

import numpy as np

from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.graphical import (
    Drawing,
    GraphicalMotion,
    graphical_hindrance,
    graphical_motion,
    graphical_profile_error,
    graphical_radius,
)
from parts.base.texts import N_, Text, filled
from parts.pages.cam_steps import law_text
from parts.pages.page import Sheet, Table

_SOURCES = {
    False: ("practicum, lesson 5, 3.1, fig. 5.1 - 5.4", "practicum, lesson 5, 3.2, fig. 5.6",
            "practicum, lesson 5, 3.3, fig. 5.7"),
    True: ("practicum, lesson 4, 3.1, fig. 4.5 - 4.8", "practicum, lesson 4, 3.2, fig. 4.9",
           "practicum, lesson 4, 3.3, fig. 4.11"),
}  # fmt: skip
_PHASES = {PhaseKind.RISE: N_("rise"), PhaseKind.RETURN: N_("return")}
_PHASES_COUNTED = {PhaseKind.RISE: N_("rise {number}"), PhaseKind.RETURN: N_("return {number}")}
_HINDRANCES = {
    "table": N_("no graphical method: a motion table has no acceleration diagram of phases"),
    "rests": N_("no graphical method: the follower rests all the turn"),
    "rigid": N_(
        "no graphical method: {law} does not begin at rest, or its velocity jumps; the method integrates from rest"
    ),
}


def graphical_section(
    page: Sheet, cam: DiskCam, limits: tuple[float | None, float | None], intervals: int, drawing: str = "smooth"
) -> None:
    """Both integrations by mid-ordinates, the least radius and the profile that follow, each with its error.

    ``limits``: the greatest pressure angles of rises and returns by which the radius is drawn, rad; None: any.
    """
    hindered = graphical_hindrance(cam.motion)
    if hindered is not None:
        page.note(_HINDRANCES[hindered[0]], law=law_text(hindered[1]))
        return
    drawn = graphical_motion(cam.motion, intervals, Drawing(drawing))
    swings = cam.swings
    integration, radius, profile = _SOURCES[cam.is_flat]
    page.section("Graphical method")
    page.add("graphical_intervals", intervals, "", integration)
    for index, phase in enumerate(drawn.phases, 1):
        symbol = f"k_{index}" if len(drawn.phases) > 1 else ""
        alike = [other.first for other in drawn.phases if other.kind is phase.kind]
        which: Text = _PHASES[phase.kind]
        if len(alike) > 1:
            which = filled(_PHASES_COUNTED[phase.kind], number=alike.index(phase.first) + 1)
        page.add("graphical_factor", phase.factor, "", integration, symbol=symbol, of=which)
    worst = float(np.abs(drawn.errors(0)).max())
    if swings:
        page.add("graphical_swing_error_deg", math.degrees(worst), "", integration)
    else:
        page.add("graphical_lift_error", worst, "", integration)
        page.add("graphical_velocity_error", float(np.abs(drawn.errors(1)).max()), "", integration)
    found = graphical_radius(cam, drawn, *limits)
    if found is not None:
        page.add("graphical_prime_circle_radius", found[0], "", radius)
        page.add("graphical_radius_error", found[0] - found[1], "{r_0g} - {r_0}", radius)
    page.add("graphical_profile_error", graphical_profile_error(cam, drawn), "", profile)
    page.tables.append(graphical_table(drawn, swings=swings))


def graphical_table(drawn: GraphicalMotion, *, swings: bool) -> Table:
    """Position, cam angle, S'', S' and S by the drawing, the exact S' and S, of all ends of intervals."""
    unit, u = (180 / math.pi, "deg") if swings else (1.0, "mm")
    heads = (("n", ""), ("phi", "deg"), ("S''g", f"{u}/rad2"), ("S'g", f"{u}/rad"), ("S'", f"{u}/rad"), ("Sg", u),
             ("S", u))  # fmt: skip
    rates, lifts = drawn.errors(1), drawn.errors(0)
    rows, at = [], 0
    for phase in drawn.phases:
        # the first position sees S'' on its right, all others on their left
        bend = np.concatenate([[phase.bend[0, 0]], phase.bend[:, 1]])
        for k, angle in enumerate(phase.angles.tolist()):
            rate, lift = float(phase.rate[k]), float(phase.lift[k])
            motion = (float(bend[k]), rate, rate - float(rates[at]), lift, lift - float(lifts[at]))
            rows.append((float(phase.first + k), math.degrees(angle), *(x * unit for x in motion)))
            at += 1
    title = N_("Graphical method (g): ends of intervals, by the drawing and exactly")
    return Table("graphical", title, heads, tuple(rows))
