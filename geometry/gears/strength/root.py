"""The section of a tooth at its root that ISO 6336-3 rates, on the exact fillet that the cutter leaves.

It lies where a line at 30 degrees to the tooth's centre line, 60 degrees in a ring, touches the fillet; the load acts
at the outer end of single contact. Both are those of the virtual spur gear whose teeth are the normal section's.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

from geometry.base.angles import involute_function, tangent_length
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Curve
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.joints import fillet_flank_joint
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_tooth import RingCurves
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import base_helix_angle, normal_angle

Gear = SpurGear | RingGear
# between the tooth's centre line and the tangent, rad
TANGENT_ANGLE, RING_TANGENT_ANGLE = math.pi / 6, math.pi / 3


class RootSection(Record):
    """Where the tangent touches, in mm: ``thickness`` s_Fn of the tooth, ``radius`` rho_F of the fillet, ``distance``
    from the axis along the tooth's centre line; ``parameter``: of the fillet, the angle theta of one that a rack cuts,
    rad.
    """

    thickness: float
    radius: float
    distance: float
    parameter: float

    @property
    def notch(self) -> float:
        """q_s = s_Fn / (2 rho_F), the notch parameter."""
        return self.thickness / (2 * self.radius)


class RootLoad(Record):
    """Where the load acts on a tooth of the virtual gear: ``radius`` r_en, mm, its pressure angle alpha_en, half of
    the tooth's angle there gamma_e, and alpha_Fen between the load and the normal of the centre line, rad;
    ``distance`` from the axis at which it crosses that line, mm.
    """

    radius: float
    pressure_angle: float
    half_angle: float
    angle: float
    distance: float


def virtual_share(transverse_pressure_angle: float, helix_angle: float) -> float:
    """z_n / z = 1 / (cos^2 beta_b cos beta), angles in rad; ISO 6336-3, 6."""
    if helix_angle == 0:
        return 1.0
    return 1 / (math.cos(base_helix_angle(transverse_pressure_angle, helix_angle)) ** 2 * math.cos(helix_angle))


def virtual_gear(section: Gear, helix_angle: float) -> Gear:
    """The spur gear of z_n teeth, no whole number, that has the teeth of a helical gear's normal section.

    ``section``: the transverse one; its thinning and what its tip circle stands off the reference circle are kept.
    """
    cosine = math.cos(helix_angle)
    teeth = section.number_of_teeth * virtual_share(section.pressure_angle, helix_angle)
    # radii and angles follow from a number that is not whole as from one that is
    changed: dict[str, Any] = {
        "module": section.module * cosine,
        "number_of_teeth": teeth,
        "profile_shift_coefficient": section.profile_shift_coefficient / cosine,
        "circumferential_thinning": section.circumferential_thinning * cosine,
        "given_tip_diameter": section.module * cosine * teeth + 2 * (section.tip_radius - section.reference_radius),
    }
    angle = normal_angle(section.pressure_angle, helix_angle)
    if isinstance(section, RingGear):
        return replace(section, pressure_angle=angle, root=_virtual_root(section.root, helix_angle), **changed)
    rack = section.rack
    values = (rack.addendum / cosine, rack.tip_clearance / cosine, rack.tip_radius / cosine)
    normal = BasicRack(angle, *values, None, rack.stretch * cosine)
    cutter = None if section.cutter is None else _virtual_cutter(section.cutter, helix_angle)
    return replace(section, rack=normal, cutter=cutter, **changed)


def _virtual_root(root: PinionCutter | RoundedRoot, helix_angle: float) -> PinionCutter | RoundedRoot:
    if isinstance(root, PinionCutter):
        return _virtual_cutter(root, helix_angle)
    cosine = math.cos(helix_angle)
    return RoundedRoot(root.dedendum / cosine, None if root.radius is None else root.radius / cosine)


def _virtual_cutter(cutter: PinionCutter, helix_angle: float) -> PinionCutter:
    cosine = math.cos(helix_angle)
    teeth: Any = cutter.number_of_teeth * virtual_share(cutter.pressure_angle, helix_angle)
    return replace(
        cutter,
        module=cutter.module * cosine,
        number_of_teeth=teeth,
        pressure_angle=normal_angle(cutter.pressure_angle, helix_angle),
        profile_shift_coefficient=cutter.profile_shift_coefficient / cosine,
        addendum=cutter.addendum / cosine,
        tip_rounding=cutter.tip_rounding / cosine,
    )


def root_section(virtual: Gear) -> RootSection | None:
    """The critical section of a virtual gear's tooth; None where no such tangent touches the fillet that is left.

    Raises
    ------
    ParameterError
        The cutter leaves no flank.
    """
    ring = isinstance(virtual, RingGear)
    fillet = _fillet(virtual)
    if fillet is None:
        return None
    # a ring is described from the middle of a space
    turn = cmath.exp(1j * virtual.pitch_angle / 2) if ring else 1 + 0j
    slope = turn * cmath.exp(-1j * (RING_TANGENT_ANGLE if ring else TANGENT_ANGLE))

    def lean(at: float) -> float:
        return (slope * complex(fillet.tangent(at))).imag

    low, high = fillet.domain
    ends = lean(low), lean(high)
    if not ends[0] * ends[1] < 0:
        return None
    at = bracketed_root(lean, low, high, at_ends=ends).value
    point = complex(fillet.point(at)) * turn
    return RootSection(2 * abs(point.imag), 1 / abs(float(fillet.curvature(at))), point.real, at)


def _fillet(virtual: Gear) -> Curve | None:
    """What is left of the fillet; None of a sharp corner, which has no tangent."""
    if isinstance(virtual, RingGear):
        return RingCurves.of(virtual).fillet
    return fillet_flank_joint(virtual.fillet(), virtual.flank())[0]


def root_load(virtual: Gear, active_tip_radius: float, contact_ratio: float) -> RootLoad:
    """Where the load acts: one base pitch from the end of contact that is the farther from the tip; ISO 6336-3, 6.

    ``active_tip_radius``: of the virtual gear, mm; ``contact_ratio``: eps_alpha_n of its pair.
    """
    base, sign = virtual.base_radius, virtual.sign
    pitch = math.pi * virtual.module * math.cos(virtual.pressure_angle)
    along = tangent_length(active_tip_radius, base) - sign * (contact_ratio - 1) * pitch
    angle = math.atan2(along, base)
    half = sign * (virtual.base_half_angle - involute_function(angle)) + (0 if sign > 0 else virtual.pitch_angle / 2)
    force = angle - sign * half
    return RootLoad(math.hypot(base, along), angle, half, force, base / math.cos(force))


def lever_arm(virtual: Gear, section: RootSection, load: RootLoad) -> float:
    """h_Fe: the bending lever arm of the load about the critical section, mm."""
    return virtual.sign * (load.distance - section.distance)


def form_factor(virtual: Gear, section: RootSection, load: RootLoad) -> float:
    """Y_F = 6 (h_Fe / m_n) cos(alpha_Fen) / ((s_Fn / m_n)^2 cos(alpha_n)); ISO 6336-3, 6."""
    arm = lever_arm(virtual, section, load)
    bent = 6 * arm * virtual.module * math.cos(load.angle)
    return bent / (section.thickness**2 * math.cos(virtual.pressure_angle))


def stress_correction(thickness: float, arm: float, notch: float) -> float:
    """Y_S = (1.2 + 0.13 L) q_s^(1 / (1.21 + 2.3 / L)), L = s_Fn / h_Fe; ISO 6336-3, 7, for q_s from 1 to 8."""
    slender = thickness / arm
    return float((1.2 + 0.13 * slender) * notch ** (1 / (1.21 + 2.3 / slender)))
