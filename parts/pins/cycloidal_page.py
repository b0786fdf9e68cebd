"""``higherpair calc cycloidal``: the disc of a cycloidal reducer, its limits, and how its pins push it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated

import numpy as np

from geometry.curves.curve import Complex, Real
from geometry.gears.pins.cycloidal import CycloidalDisc, disc_findings, eccentricities
from parts.base.texts import N_
from parts.keys.base import degrees
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet, Table, table_of
from parts.pins.cycloidal_disc import CYCLOIDAL_DISC, CycloidalDiscSpec
from parts.texts.findings import finding_message

TOPIC = "cycloidal"
table_from = part_of_kind("cycloidal_disc")
_CURVE = "Shin, Kwon, Mech. Mach. Theory 41 (2006)"
_ZOOMS, _SAMPLES = 8, 65

_STEP = degrees("step of the table, eccentric's angle from a pin", least=0.1, most=90)


class DiscKeys(CycloidalDiscSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a disc, and the step of its table."""

    step: Annotated[float, _STEP] = 10.0


@calculation(TOPIC, DiscKeys)
def sheet(keys: DiscKeys) -> Sheet:
    """The calculation of one disc."""
    disc = CYCLOIDAL_DISC.thing(keys, {})
    page = Sheet(TOPIC, N_("Cycloidal disc and its pins"))
    _given(page, disc)
    _sizes(page, disc)
    _limits(page, disc)
    _pushing(page, disc)
    if keys.output_holes is not None:
        output = keys.output_holes
        page.section("Output holes")
        page.told(output_pin_diameter=output.pin_diameter, output_hole_clearance=output.clearance)
        hole = output.pin_diameter + 2 * keys.eccentricity + output.clearance
        page.add("output_hole_diameter", hole, "{d_o} + 2 * {e} + {c_o}")
    page.tables.append(_table(disc, keys.step))
    page.note("the disc turns against its eccentric; ψ: from the eccentric to a pin, about the pins' axis")
    page.note("pressure angle: between a pin's normal and the way of the touched point about the disc")
    page.notes += [finding_message(f) for f in disc_findings(disc)]
    return page


def _given(page: Sheet, disc: CycloidalDisc) -> None:
    page.section("Given")
    page.add("number_of_lobes", disc.number_of_lobes)
    page.add("number_of_pins", disc.number_of_pins, "{z} + 1")
    page.told(pin_circle_radius=disc.pin_circle_diameter / 2, pin_radius=disc.pin_diameter / 2)
    page.told(eccentricity=disc.eccentricity, pin_clearance=disc.pin_clearance)
    page.add("pin_circle_shift", disc.pin_circle_shift)
    page.add("generating_radius", disc.generating_radius, "{R} - {dR}")
    page.add("generating_pin_radius", disc.generating_pin_radius, "{r_p} + {c_p}")


def _sizes(page: Sheet, disc: CycloidalDisc) -> None:
    page.section("Ratio and sizes")
    page.add("reduction", disc.number_of_lobes, "{z}")
    page.add("reduction_of_pins", disc.number_of_pins, "{N}")
    page.add("disc_centrode_radius", disc.pitch_radius, "{e} * {z}")
    page.add("pin_centrode_radius", disc.eccentricity * disc.number_of_pins, "{e} * {N}")
    page.add("cycloidal_tip_radius", disc.tip_radius, "{R_g} + {e} - {rho}")
    page.add("cycloidal_root_radius", disc.root_radius, "{R_g} - {e} - {rho}")
    page.add("lobe_height", disc.tip_radius - disc.root_radius, "2 * {e}")


def _limits(page: Sheet, disc: CycloidalDisc) -> None:
    page.section("Limits")
    lam, pins = disc.shortening, disc.number_of_pins
    page.add("shortening_coefficient", lam, "{e} * {N} / {R_g}", _CURVE)
    # a hundredth of the pin's radius is left to the sharpest place
    most = eccentricities(disc)[1]
    page.add("greatest_shortening", most * pins / disc.generating_radius)
    page.add("greatest_eccentricity", most, "{lam_max} * {R_g} / {N}")
    formula = "{R_g} * (1 + {lam})**2 / (1 + {N} * {lam})"
    if lam > (pins - 2) / (2 * pins - 1):
        formula = "{R_g} * sqrt(27 * ({N} - 1) * (1 - {lam}**2) / ({N} + 1)**3)"
    page.add("least_path_curvature_radius", disc.least_path_radius, formula)
    page.add("least_profile_radius", disc.least_curvature_radius, "{rho_0} - {rho}")


def _pushing(page: Sheet, disc: CycloidalDisc) -> None:
    page.section("Transmission")
    page.add("driving_pins", math.ceil(disc.number_of_pins / 2))
    # the arm is that of the line from the pole, r_2 from the pins' axis, to the pin's centre
    page.add("greatest_force_arm", disc.pitch_radius, "{r_1}")
    page.add("greatest_arm_angle_deg", math.degrees(math.acos(disc.shortening)), "arccos({lam})")
    least, at = _least(lambda psi: pressure_angles(disc, psi), 0.0, math.pi)
    page.told(least_disc_pressure_angle_deg=math.degrees(least), best_pin_angle_deg=math.degrees(at))


def contacts(disc: CycloidalDisc, psi: Real) -> Complex:
    """Where pins at the angles psi from the eccentric (along +x) touch the disc, from the disc's axis, mm.

    The normal goes through the pole: the centrodes' common point, e N from the pins' axis (Savvin).
    """
    pin = disc.generating_radius * np.exp(1j * psi)
    to_pole = disc.eccentricity * disc.number_of_pins - pin
    return np.asarray(pin + disc.generating_pin_radius * to_pole / np.abs(to_pole) - disc.eccentricity)


def arms(disc: CycloidalDisc, psi: Real) -> Real:
    """Arms of the pins' normals about the disc's axis, mm: r_1 sin psi / sqrt(1 + lambda^2 - 2 lambda cos psi)."""
    lam = disc.shortening
    return np.asarray(disc.pitch_radius * np.sin(psi) / np.sqrt(1 + lam**2 - 2 * lam * np.cos(psi)))


def pressure_angles(disc: CycloidalDisc, psi: Real) -> Real:
    """Between a pin's normal and the way of the touched point about the disc's axis, rad."""
    return np.arccos(np.clip(arms(disc, psi) / np.abs(contacts(disc, psi)), -1.0, 1.0))


def _least(function: Callable[[Real], Real], low: float, high: float) -> tuple[float, float]:
    """Least value and its place: samples, then ever finer ones about the least."""
    best = (math.inf, low)
    for _ in range(_ZOOMS):
        t = np.linspace(low, high, _SAMPLES)
        values = function(t)
        k = int(np.argmin(values))
        best = float(values[k]), float(t[k])
        low, high = float(t[max(k - 1, 0)]), float(t[min(k + 1, _SAMPLES - 1)])
    return best


def _table(disc: CycloidalDisc, step: float) -> Table:
    """psi, radius, profile of half a lobe from the valley to the top, radius of curvature, arm, pressure angle."""
    degrees = np.append(np.arange(math.ceil(180 / step - 1e-9)) * step, 180.0)
    psi = np.radians(degrees)
    curve = disc.half_lobe()
    point = curve.point(psi / disc.number_of_lobes)
    with np.errstate(divide="ignore"):
        bend = 1 / curve.curvature(psi / disc.number_of_lobes)
    columns = [degrees, np.abs(point), point.real, point.imag, bend, arms(disc, psi),
               np.degrees(pressure_angles(disc, psi))]  # fmt: skip
    heads = (("psi", "deg"), ("r", "mm"), ("x", "mm"), ("y", "mm"), ("rho", "mm"), ("l", "mm"), ("alpha", "deg"))
    title = N_("Half a lobe from valley to top: profile, radius of curvature, arm and pressure angle of a pin")
    return table_of("profile", title, heads, zip(*columns, strict=True))
