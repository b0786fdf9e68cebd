"""The section "scales" of ``calc cam``: practicum (4.1) to (4.5), (5.1) to (5.5) by lengths on a student's drawing."""

from __future__ import annotations

from typing import Annotated

from msgspec import Struct

from geometry.base.errors import ParameterError
from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.plane.disk import DiskCam
from parts.base.refusal import REMOVED
from parts.keys.base import mm
from parts.pages.page import Sheet


class DrawnTable(Struct, forbid_unknown_fields=True):
    """Lengths on the drawing of the diagrams."""

    length: Annotated[float, mm("L: the rise along the axis of the cam angle", above=0, most=10_000, example=120.0)]
    greatest_ordinate: Annotated[float, mm("y_max of S", above=0, most=10_000, example=76.0)]
    pole_1: Annotated[float, mm("H_1, with which S is drawn from S'", above=0, most=10_000, example=40.0)]
    pole_2: Annotated[float, mm("H_2, with which S' is drawn from S''", above=0, most=10_000, example=40.0)]
    axis: Annotated[float, mm("O O_1' of the joint diagram", above=0, most=10_000, example=40.5)] | None = None


def scale_section(page: Sheet, cam: DiskCam, drawn: DrawnTable) -> None:
    """The scales of the diagrams of the rise, what carries them to the joint diagram, and r_0 off it.

    Raises
    ------
    ParameterError
        ``drawn.length``: the follower swings, or has another number of rises than one.
    """
    rises = [p for p in cam.motion.phases if p.kind is PhaseKind.RISE]
    if cam.swings or len(rises) != 1:
        raise ParameterError("drawn.length", drawn.length, "drawn_is_one_translating_rise", REMOVED)
    (phase,) = rises
    lesson = 4 if cam.is_flat else 5
    page.section("Scales of the drawing")
    page.given(diagram_length=drawn.length, greatest_ordinate=drawn.greatest_ordinate)
    page.given(drawn_pole_1=drawn.pole_1, drawn_pole_2=drawn.pole_2)
    angle, way = phase.angle / drawn.length, phase.lift / drawn.greatest_ordinate
    rate = way / (drawn.pole_1 * angle)
    bend = rate / (drawn.pole_2 * angle)
    page.add("angle_scale", angle, "{phi_r} / {L}", f"practicum ({lesson}.1)")
    page.add("way_scale", way, "{H} / {y_max}", f"practicum ({lesson}.2)")
    page.add("rate_scale", rate, "{mu_S} / ({H_1} * {mu_phi})", f"practicum ({lesson}.3)")
    page.add("bend_scale", bend, "{mu_S1} / ({H_2} * {mu_phi})", f"practicum ({lesson}.4)")
    used, key = (bend, "mu_S2") if cam.is_flat else (rate, "mu_S1")
    page.add("joint_factor", used / way, f"{{{key}}} / {{mu_S}}", f"practicum ({lesson}.5)")
    source = f"practicum, lesson {lesson}, 3.2"
    page.add("drawn_offset", float(page.value_of("E").value) / way, "{E} / {mu_S}", source)
    if drawn.axis is not None:
        page.add("drawn_axis", drawn.axis, given=True)
        page.add("drawn_radius", drawn.axis * way, "{O_d} * {mu_S}", source)
        if "r_0" in page.known:
            error = drawn.axis * way - float(page.value_of("r_0").value)
            page.add("drawn_radius_error", error, "{r_0p} - {r_0}", source)
    page.note(
        "the practicum has its scales of S, S' and S'' in metres, a thousandth of these, and their units without rad"
    )
    page.note(
        "the practicum's words to ({n}.3) name H_2 and those to ({n}.4) H_1; the formulas are used here", n=lesson
    )
