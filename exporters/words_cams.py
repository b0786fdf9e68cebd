"""Findings of cams in English and Ukrainian, beside those of exporters/words.py."""

from __future__ import annotations

CAM_FINDINGS: dict[str, tuple[str, str]] = {
    "curvature_radius_not_kept": (
        "least convex radius {value:.4g} mm, asked {limit:.4g} mm: base_circle_radius is given and too small for it",
        "найменший радіус опуклого профілю {value:.4g} мм замість заданих {limit:.4g} мм: замале base_circle_radius",
    ),
}
