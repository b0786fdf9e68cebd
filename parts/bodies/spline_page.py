"""``higherpair calc spline``: sizes of a straight-sided spline, and the bearing stress on its sides."""

from __future__ import annotations

from geometry.solids.splines import SplineBore
from geometry.solids.zones import side_symmetry
from parts.base.texts import N_
from parts.bodies.spline_steps import Length, LoadShare, Sides, Torque, bearing_steps, fit_tables, spline_of
from parts.keys.base import check_not_in_vain
from parts.keys.splines import StraightSplineTable
from parts.pages.inputs import calculation
from parts.pages.page import Sheet

TOPIC = "spline"
table_from = spline_of("spline", StraightSplineTable)


class SplineKeys(StraightSplineTable, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the spline, and its load."""

    torque: Torque = None
    length: Length = None
    load_share: LoadShare = 0.75


@calculation(TOPIC, SplineKeys)
def sheet(keys: SplineKeys) -> Sheet:
    """The calculation of a straight-sided spline."""
    bore: SplineBore = keys.checked("")
    joint = keys.joint()
    page = Sheet(TOPIC, N_("Straight-sided spline"))
    page.section("Given")
    page.told(spline_designation=joint.named(), number_of_teeth=joint.teeth)
    page.told(spline_inner_diameter=joint.inner, spline_outer_diameter=joint.outer)
    page.told(spline_width=joint.width, spline_chamfer=joint.chamfer)
    page.section("Sizes")
    shaft = joint.shaft()
    page.told(spline_root_diameter=2 * shaft.inner, spline_rounding=joint.rounding)
    if joint.standard:
        page.add("spline_symmetry", side_symmetry(joint.width), source=joint.standard)
    height = (joint.outer - joint.inner) / 2 - 2 * joint.chamfer
    sides = Sides(joint.teeth, (joint.outer + joint.inner) / 2, height)
    page.add("spline_mean_diameter", sides.mean_diameter, "({D} + {d}) / 2")
    page.add("spline_height", sides.height, "({D} - {d}) / 2 - 2 * {c}")
    page.add("spline_clearance", bore.clearance)
    if keys.torque is None:
        check_not_in_vain(keys, ("load_share",), "torque")
    bearing_steps(page, sides, keys.torque, keys.length, keys.load_share)
    fit_tables(page, joint.fits)
    return page
