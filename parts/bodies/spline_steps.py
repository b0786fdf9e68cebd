"""What the pages of both sorts of splines have in common: their load, and the bearing stress on their sides."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Annotated, Any, NamedTuple

from msgspec import Meta, Struct

from geometry.base.errors import ParameterError
from geometry.solids.splines import Fit
from geometry.solids.zones import zone_limits
from parts.base.texts import N_
from parts.bodies.turned import ShaftSpec
from parts.keys.base import mm, size
from parts.keys.splines import InvoluteSplineTable, SplineTable, StraightSplineTable
from parts.pages.inputs import SceneKeys, chosen_part, given
from parts.pages.page import Sheet

Torque = Annotated[float, size("N*m", "torque that it carries", above=0, most=1e9, example=100.0)] | None
Length = Annotated[float, mm("length on which hub and shaft meet", above=0, most=1e5, example=30.0)] | None
LoadShare = Annotated[float, Meta(gt=0, le=1, description="part of the sides that carries; 0.7 to 0.8 in textbooks")]


def spline_of(kind: str, shape: type[SplineTable]) -> Callable[[SceneKeys, str, dict[str, Any]], dict[str, Any]]:
    """How a scene gives a page the keys of its splines of a shape: those of one joint, or in what ``part`` names."""
    return partial(_of_scene, kind, shape)


def _of_scene(
    kind: str, shape: type[SplineTable], scene: SceneKeys, source: str, table: dict[str, Any]
) -> dict[str, Any]:
    found = {key: spline for key, spec in scene.parts.items() for spline in _splines(spec) if isinstance(spline, shape)}
    # hub and shaft of one joint have the same
    alone = {spline.joint(): key for key, spline in reversed(found.items())}
    chosen = found[chosen_part(kind, [*found], [*alone.values()], source, table)]
    return {key: value for key, value in given(chosen).items() if key != "shape"} | table


def _splines(spec: Struct) -> Iterator[SplineTable]:
    """In the bore of a part, or on a shaft, the last first: of several the first is the one that is left."""
    if isinstance(spec, ShaftSpec):
        yield from (step.spline for step in reversed(spec.steps) if step.spline is not None)
    elif isinstance(bore := getattr(spec, "bore", None), StraightSplineTable | InvoluteSplineTable):
        yield bore


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


def fit_tables(page: Sheet, fits: Sequence[Fit]) -> None:
    """Deviations and limits of all sizes that have a zone of tolerance, and the clearances of those that have two."""
    rows, clearances = list[tuple[str | float, ...]](), list[tuple[str | float, ...]]()
    for fit in fits:
        found = []
        for part, zone in ((N_("hub"), fit.hub), (N_("shaft"), fit.shaft)):
            if zone:
                lower, upper = zone_limits(zone, fit.size)
                rows.append((fit.symbol, part, zone, 1000 * upper, 1000 * lower, fit.size + upper, fit.size + lower))
                found.append((1000 * lower, 1000 * upper))
        if len(found) == 2:
            hub, shaft = found
            clearances.append((fit.symbol, fit.zone(None), hub[0] - shaft[1], hub[1] - shaft[0]))
    if rows:
        heads = [(N_("size"), ""), (N_("part"), ""), (N_("zone"), ""), (N_("upper deviation"), "um")]
        heads += [(N_("lower deviation"), "um"), (N_("greatest"), "mm"), (N_("least"), "mm")]
        page.table("limits", N_("Limits by zones of tolerance, ISO 286-1"), heads, rows)
    if clearances:
        heads = [(N_("size"), ""), (N_("zone"), ""), (N_("least"), "um"), (N_("greatest"), "um")]
        page.table("clearances", N_("Clearances; what is below 0 is interference"), heads, clearances)
