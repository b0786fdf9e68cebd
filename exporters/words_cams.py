"""Findings of cams in English and Ukrainian, beside those of exporters/words.py."""

from __future__ import annotations

CAM_FINDINGS: dict[str, tuple[str, str]] = {
    "curvature_radius_not_kept": (
        "least convex radius {value:.4g} mm, asked {limit:.4g} mm: base_circle_radius is given and too small for it",
        "найменший радіус опуклого профілю {value:.4g} мм замість заданих {limit:.4g} мм: замале base_circle_radius",
    ),
}

CAM_WORDS: dict[str, tuple[str, str]] = {
    "mate_wedge_follower": (
        "{first}, slid {plate_travel:.6g} mm, moves {second} by {travel:.6g} {unit} in all",
        "{first}, зсунута на {plate_travel:.6g} мм, рухає {second} загалом на {travel:.6g} {unit}",
    ),
    "groove_walls": (
        "gaps at the inner wall {inner[0]:.3g} to {inner[1]:.3g} mm, at the outer wall {outer[0]:.3g} to "
        "{outer[1]:.3g} mm, clearance {clearance:.6g} mm",
        "зазори: внутрішня стінка {inner[0]:.3g} ... {inner[1]:.3g} мм, зовнішня {outer[0]:.3g} ... "
        "{outer[1]:.3g} мм, зазор паза {clearance:.6g} мм",
    ),
}
