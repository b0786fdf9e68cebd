"""Findings of cams and quantities of cylindrical ones in English and Ukrainian, beside those of exporters/words.py."""

from __future__ import annotations

CAM_FINDINGS: dict[str, tuple[str, str]] = {
    "curvature_radius_not_kept": (
        "least convex radius {value:.4g} mm, asked {limit:.4g} mm: base_circle_radius is given and too small for it",
        "найменший радіус опуклого профілю {value:.4g} мм замість заданих {limit:.4g} мм: замале base_circle_radius",
    ),
}

BARREL_WORDS: dict[str, tuple[str, str]] = {
    "floor_diameter": ("diameter of the groove's floor, mm", "діаметр дна паза, мм"),
    "pivot_height": ("height of the pivot, mm", "висота осі коромисла, мм"),
    "cone_angle_deg": ("cone angle of the roller, deg", "кут конуса ролика, град"),
    "roller_floor_diameter": ("roller diameter at the floor, mm", "діаметр ролика біля дна паза, мм"),
    "roller_sliding": ("roller's sliding, share of its rolling", "ковзання ролика, частка кочення"),
}
