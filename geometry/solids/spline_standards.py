"""Splines by their standards: rows of GOST 1139-80 (ISO 14), relations of GOST 6033-80, DIN 5480 and ISO 4156; mm.

All sizes are nominal: those of shaft and hub that meet are the same, what a fit leaves between them is a clearance.
"""

from __future__ import annotations

import math

from geometry.solids.splines import InvoluteJoint, Root, StraightJoint

_THIRTY = math.radians(30)
# of a number of teeth, to what it is rounded
_SAME = 1e-9
# z, d, D, b, d1, c and r of tables 1 (light), 2 (medium) and 3 (heavy): d1 not less, r not more
_ROWS: tuple[tuple[int, float, float, float, float, float, float], ...] = (
    (6, 23, 26, 6, 22.1, 0.3, 0.2), (6, 26, 30, 6, 24.6, 0.3, 0.2), (6, 28, 32, 7, 26.7, 0.3, 0.2),
    (8, 32, 36, 6, 30.4, 0.4, 0.3), (8, 36, 40, 7, 34.5, 0.4, 0.3), (8, 42, 46, 8, 40.4, 0.4, 0.3),
    (8, 46, 50, 9, 44.6, 0.4, 0.3), (8, 52, 58, 10, 49.7, 0.5, 0.5), (8, 56, 62, 10, 53.6, 0.5, 0.5),
    (8, 62, 68, 12, 59.8, 0.5, 0.5), (10, 72, 78, 12, 69.6, 0.5, 0.5), (10, 82, 88, 12, 79.3, 0.5, 0.5),
    (10, 92, 98, 14, 89.4, 0.5, 0.5), (10, 102, 108, 16, 99.9, 0.5, 0.5), (10, 112, 120, 18, 108.8, 0.5, 0.5),
    (6, 11, 14, 3, 9.9, 0.3, 0.2), (6, 13, 16, 3.5, 12, 0.3, 0.2), (6, 16, 20, 4, 14.5, 0.3, 0.2),
    (6, 18, 22, 5, 16.7, 0.3, 0.2), (6, 21, 25, 5, 19.5, 0.3, 0.2), (6, 23, 28, 6, 21.3, 0.3, 0.2),
    (6, 26, 32, 6, 23.4, 0.4, 0.3), (6, 28, 34, 7, 25.9, 0.4, 0.3), (8, 32, 38, 6, 29.4, 0.4, 0.3),
    (8, 36, 42, 7, 33.5, 0.4, 0.3), (8, 42, 48, 8, 39.5, 0.4, 0.3), (8, 46, 54, 9, 42.7, 0.5, 0.5),
    (8, 52, 60, 10, 48.7, 0.5, 0.5), (8, 56, 65, 10, 52.2, 0.5, 0.5), (8, 62, 72, 12, 57.8, 0.5, 0.5),
    (10, 72, 82, 12, 67.4, 0.5, 0.5), (10, 82, 92, 12, 77.1, 0.5, 0.5), (10, 92, 102, 14, 87.3, 0.5, 0.5),
    (10, 102, 112, 16, 97.7, 0.5, 0.5), (10, 112, 125, 18, 106.3, 0.5, 0.5),
    (10, 16, 20, 2.5, 14.1, 0.3, 0.2), (10, 18, 23, 3, 15.6, 0.3, 0.2), (10, 21, 26, 3, 18.5, 0.3, 0.2),
    (10, 23, 29, 4, 20.3, 0.3, 0.2), (10, 26, 32, 4, 23, 0.4, 0.3), (10, 28, 35, 4, 24.4, 0.4, 0.3),
    (10, 32, 40, 5, 28, 0.4, 0.3), (10, 36, 45, 5, 31.3, 0.4, 0.3), (10, 42, 52, 6, 36.9, 0.4, 0.3),
    (10, 46, 56, 7, 40.9, 0.5, 0.5), (16, 52, 60, 5, 47, 0.5, 0.5), (16, 56, 65, 5, 50.6, 0.5, 0.5),
    (16, 62, 72, 6, 56.1, 0.5, 0.5), (16, 72, 82, 7, 65.9, 0.5, 0.5), (20, 82, 92, 6, 75.6, 0.5, 0.5),
    (20, 92, 102, 7, 85.5, 0.5, 0.5), (20, 102, 115, 8, 94, 0.5, 0.5), (20, 112, 125, 9, 104, 0.5, 0.5),
)  # fmt: skip


STRAIGHT_JOINTS = tuple(StraightJoint(*row, "inner", "GOST 1139") for row in _ROWS)


def teeth_of(diameter: float, module: float) -> tuple[int, ...]:
    """The numbers of teeth that give a shift of -0.05 to 0.45 modules, one or two; the even one of two comes first."""
    least, most = math.ceil(diameter / module - 2 - _SAME), math.floor(diameter / module - 1 + _SAME)
    return tuple(sorted(range(least, most + 1), key=lambda teeth: teeth % 2))


def _by_diameter(
    module: float, teeth: int, diameter: float, outer: bool, root: Root, rho: float, standard: str, name: str
) -> InvoluteJoint:
    """What GOST 6033-80 and DIN 5480 have in common: d = m z, D = m z + 2 x m + 1.1 m, alpha = 30 degrees."""
    shift = (diameter - module * (teeth + 1.1)) / 2
    thickness = module * math.pi / 2 + 2 * shift * math.tan(_THIRTY)
    deeper, wider, bed = (2.76, 0.44, math.inf) if root == "fillet" else (2.2, 0.0, rho * module)
    shaft = diameter - deeper * module, diameter - (0.0 if outer else 0.2 * module)
    hub = diameter - 2 * module, diameter + wider * module
    return InvoluteJoint(
        module, teeth, _THIRTY, thickness, shaft, hub, (bed, bed if outer else 0.0, bed), standard, name
    )


def gost_6033(diameter: float, module: float, teeth: int, *, outer: bool, root: Root) -> InvoluteJoint:
    """D x m of GOST 6033-80: centred by the sides, or by the ``outer`` diameter, with the corners there rounded by K.

    rho and K are its 0.15 m. A round root does not centre.
    """
    return _by_diameter(module, teeth, diameter, outer, root, 0.15, "GOST 6033", f"{diameter:g}×{module:g}")


def din_5480(diameter: float, module: float, teeth: int) -> InvoluteJoint:
    """d_B x m x z of DIN 5480-1: h_fP = 0.55 m, rho_fP = 0.16 m."""
    return _by_diameter(module, teeth, diameter, False, "flat", 0.16, "DIN 5480", f"{diameter:g}×{module:g}×{teeth}")


# in modules h_s, by how much D_ee, D_ie and D_ei differ from m z, rho
ISO_4156: dict[tuple[float, Root], tuple[float, float, float, float]] = {
    (30.0, "flat"): (0.6, 1.0, 1.5, 0.2),
    (30.0, "fillet"): (0.6, 1.0, 1.8, 0.4),
    (37.5, "fillet"): (0.55, 0.9, 1.4, 0.3),
    (45.0, "fillet"): (0.5, 0.8, 1.2, 0.25),
}


def iso_4156(teeth: int, module: float, angle: float, root: Root) -> InvoluteJoint:
    """z, m and the pressure ``angle`` (degrees) of ISO 4156-1, side fit H/h: c_F = 0.1 m."""
    height, tip, bed, rho = ISO_4156[angle, root]
    alpha, reference = math.radians(angle), module * teeth
    base, along = reference * math.cos(alpha), reference * math.sin(alpha) - 2 * height * module / math.sin(alpha)
    form, clear = math.hypot(base, along), 0.1 * module
    shaft, hub = (reference - bed * module, reference + tip * module), (form + 2 * clear, reference + bed * module)
    rounding, name = rho * module, f"{teeth}z×{module:g}m×{angle:g}{'R' if root == 'fillet' else 'P'}"
    return InvoluteJoint(
        module, teeth, alpha, module * math.pi / 2, shaft, hub, (rounding, 0.0, rounding), "ISO 4156", name, clear
    )
