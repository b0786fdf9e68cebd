"""Names, findings and quantities of cams in English and Ukrainian, beside those of exporters/words.py."""

from __future__ import annotations

CAM_WORDS: dict[str, tuple[str, str]] = {
    "contact_pressure_angle_deg": (
        "pressure angle at the contact, deg",
        "кут тиску в точці дотику, град",
    ),
    "coupler_swing_deg": ("the connecting rod turns by, deg", "розмах кутів шатуна, град"),
    "least_transmission_angle_deg": (
        "least transmission angle at joint B, deg",
        "найменший кут передачі в шарнірі B, град",
    ),
    "mate_linkage_member": (
        "{second}: {member} of the linkage of {first}, turns by {swing_deg:.6g} deg",
        "{second}: ланка ({member}) механізму {first}, розмах {swing_deg:.6g} град",
    ),
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
    "greatest_sliding_velocity": ("greatest sliding velocity, mm per rad", "найбільша швидкість ковзання, мм/рад"),
}
CAM_FINDINGS: dict[str, tuple[str, str]] = {
    "curvature_radius_not_kept": (
        "least convex radius {value:.4g} mm, asked {limit:.4g} mm: base_circle_radius is given and too small for it",
        "найменший радіус опуклого профілю {value:.4g} мм замість заданих {limit:.4g} мм: замале base_circle_radius",
    ),
    "flat_offset": (
        "follower_offset = {value:.6g} mm changes nothing of a flat follower's cam: only the stem stands beside the "
        "axis, so the plate has to be {limit:.6g} mm wide",
        "follower_offset = {value:.6g} мм не змінює кулачка з плоским штовхачем: лише стержень стоїть збоку від осі, "
        "тож тарілка має бути завширшки {limit:.6g} мм",
    ),
    "pivot_within_cam": (
        "the follower's pivot, {limit:.6g} mm from the axis, stands within the cam's outline: the cam reaches "
        "{value:.4g} mm over it, so arm and pivot need a place above or below the cam",
        "опора коромисла за {limit:.6g} мм від осі стоїть у межах контуру кулачка: кулачок заходить за неї на "
        "{value:.4g} мм, тож коромисло й опора мають стояти над кулачком або під ним",
    ),
    "linkage_curvature_radius": (
        "least convex radius {value:.4g} mm, asked {limit:.4g} mm",
        "найменший радіус опуклого профілю {value:.4g} мм замість заданих {limit:.4g} мм",
    ),
    "small_transmission_angle": (
        "transmission angle {value:.2f} deg between connecting rod and guide, usual is at least {limit:.0f} deg",
        "кут передачі {value:.2f} град між шатуном і напрямною ланкою, допустимо від {limit:.0f} град",
    ),
}

BARREL_WORDS: dict[str, tuple[str, str]] = {
    "floor_diameter": ("diameter of the groove's floor, mm", "діаметр дна паза, мм"),
    "pivot_height": ("height of the pivot, mm", "висота осі коромисла, мм"),
    "cone_angle_deg": ("cone angle of the roller, deg", "кут конуса ролика, град"),
    "roller_floor_diameter": ("roller diameter at the floor, mm", "діаметр ролика біля дна паза, мм"),
    "roller_sliding": ("roller's sliding, share of its rolling", "ковзання ролика, частка кочення"),
}
