"""What the pages of both sorts of splines have in common: their load, and the bearing stress on their sides."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from msgspec import Meta

from geometry.base.errors import ParameterError
from parts.keys.base import mm, size
from parts.pages.page import Sheet

Torque = Annotated[float, size("N*m", "torque that it carries", above=0, most=1e9, example=100.0)] | None
Length = Annotated[float, mm("length on which hub and shaft meet", above=0, most=1e5, example=30.0)] | None
LoadShare = Annotated[float, Meta(gt=0, le=1, description="part of the sides that carries; 0.7 to 0.8 in textbooks")]


class Sides(NamedTuple):
    """What carries: number of teeth, mean diameter and height of the sides, mm."""

    teeth: int
    mean_diameter: float
    height: float


def bearing_steps(page: Sheet, sides: Sides, torque: float | None, length: float | None, load_share: float) -> None:
    """sigma = 2 T / (psi z d_m h l), with the mean diameter and the height that the page has told.

    Raises
    ------
    ParameterError
        Of torque and length one is given alone.
    """
    if torque is None and length is None:
        return
    if torque is None or length is None:
        key, value, other = ("length", length, "torque") if torque is None else ("torque", torque, "length")
        raise ParameterError(key, value, "needs_other", other=other)
    page.section("Bearing stress on the sides")
    page.add("spline_torque", torque, given=True)
    page.add("spline_length", length, given=True)
    page.add("load_share", load_share, given=True)
    stress = 2000 * torque / (load_share * sides.teeth * sides.mean_diameter * sides.height * length)
    page.add("spline_bearing_stress", stress, "2000 * {T} / ({psi} * {z} * {d_m} * {h} * {l})")
