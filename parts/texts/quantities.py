"""What the named numbers of a part are called, with their units."""

from __future__ import annotations

from collections.abc import Mapping

from parts.base.texts import N_, Words

QUANTITIES: dict[str, str] = {
    "tip_diameter": N_("tip diameter d_a, mm"),
    "reference_diameter": N_("reference diameter d, mm"),
    "base_diameter": N_("base diameter d_b, mm"),
    "root_form_diameter": N_("root form diameter d_Ff, mm"),
    "root_diameter": N_("root diameter d_f, mm"),
    "pitch": N_("pitch p, mm"),
    "tooth_thickness": N_("tooth thickness s, mm"),
    "tip_tooth_thickness": N_("tip tooth thickness s_a, mm"),
    "base_circle_diameter": N_("base circle diameter 2 R_b, mm"),
    "prime_circle_diameter": N_("prime circle diameter 2 r_0, mm"),
    "lift": N_("lift H, mm"),
    "swing_deg": N_("swing, deg"),
    "start_angle_deg": N_("lowest angle from the line of centres, deg"),
    "follower_radius": N_("follower radius, mm"),
    "yoke_breadth": N_("breadth between faces or roller centres, mm"),
    "yoke_breadth_error": N_("greatest departure of S(phi) + S(phi + 180) from H, mm"),
    "travel": N_("travel of the plate, mm"),
    "pressure_angle_deg": N_("greatest pressure angle, deg"),
    "roller_distance": N_("distance of both rollers, mm"),
    "roller_angle_deg": N_("angle between both arms, deg"),
    "outer_diameter": N_("outer diameter, mm"),
    "floor_diameter": N_("diameter of the groove's floor, mm"),
    "pivot_height": N_("height of the pivot, mm"),
    "cone_angle_deg": N_("cone angle of the roller, deg"),
    "roller_floor_diameter": N_("roller diameter at the floor, mm"),
    "roller_sliding": N_("roller's sliding, share of its rolling"),
    "groove_width": N_("groove width, mm"),
    "groove_depth": N_("groove depth, mm"),
    "follower_offset": N_("follower offset E, mm"),
    "pressure_angle_rise_deg": N_("greatest pressure angle, rise, deg"),
    "pressure_angle_return_deg": N_("greatest pressure angle, return, deg"),
    "least_curvature_radius": N_("least convex radius rho, mm"),
    "largest_roller_radius": N_("largest roller radius by the pitch curve, mm"),
    "face_from": N_("face contact from, mm"),
    "least_plate_diameter": N_("least plate diameter, mm"),
    "face_to": N_("face contact to, mm"),
    "length": N_("length, mm"),
    "roller_diameter": N_("roller diameter, mm"),
    "arm_length": N_("arm length, mm"),
    "pivot_offset": N_("pivot beside the cam's axis, mm"),
    "start_height": N_("height of the roller at 0 deg, mm"),
    "largest_roller_diameter": N_("largest roller (no undercut), mm"),
    "inner_root_diameter": N_("least root diameter, mm"),
    "outer_tip_diameter": N_("greatest tip diameter, mm"),
    "module": N_("module m, mm"),
    "centre_distance_of_pair": N_("centre distance a, mm"),
    "centrode_perimeter": N_("perimeter of the centrode, mm"),
    "least_centrode_radius": N_("least radius of the centrode, mm"),
    "greatest_centrode_radius": N_("greatest radius of the centrode, mm"),
    "least_curvature_radius_of_centrode": N_("its least radius of curvature, mm"),
    "normal_pitch": N_("normal pitch p_n, mm"),
    "lead": N_("lead of the helix p_z, mm"),
    "cutter_number_of_teeth": N_("teeth of the cutter z_0"),
    "cutter_addendum_coefficient": N_("addendum of the cutter h_a0, modules"),
    "cutter_tip_rounding_coefficient": N_("tip rounding of the cutter, modules"),
    "pin_circle_diameter": N_("pin circle diameter, mm"),
    "pitch_diameter": N_("pitch diameter d_w, mm"),
    "inner_diameter": N_("inner diameter, mm"),
    "number_of_pins": N_("number of pins N"),
    "pin_diameter": N_("pin diameter, mm"),
    "diameter": N_("diameter, mm"),
    "eccentricity": N_("eccentricity e, mm"),
    "reduction": N_("reduction, ring held"),
    "shortening_coefficient": N_("shortening coefficient e N / R"),
    "least_path_radius": N_("least radius of the pins' path, mm"),
    "least_convex_curvature_radius": N_("least convex radius of the lobes, mm"),
    "pointed_tip_diameter": N_("diameter at which the tip is pointed, mm"),
    "flank_start_diameter": N_("diameter at which the flank begins, mm"),
    "lantern_contact_ratio": N_("contact ratio"),
    "contact_pressure_angle_deg": N_("pressure angle at the contact, deg"),
    "coupler_swing_deg": N_("the connecting rod turns by, deg"),
    "least_transmission_angle_deg": N_("least transmission angle at joint B, deg"),
    "lead_angle_deg": N_("lead angle gamma, deg"),
    "axial_pressure_angle_deg": N_("axial pressure angle alpha_x, deg"),
    "axial_thickness": N_("axial thickness of the thread s_x, mm"),
    "axial_tip_land": N_("axial width of the thread's tip, mm"),
    "thread_chord": N_("chord across the thread, mm"),
    "thread_chord_height": N_("depth of that chord below the tip, mm"),
    "ball_diameter": N_("diameter of measuring balls, mm"),
    "over_balls": N_("dimension over three balls M, mm"),
    "greatest_sliding_velocity": N_("greatest sliding velocity, mm per rad"),
}


def add_quantities(table: Mapping[str, str]) -> None:
    """The names of a kind that is registered from outside, with their units."""
    QUANTITIES.update(table)


def quantity_name(words: Words, name: str) -> str:
    """A circle or quantity of a part in words; one that nobody named by its key."""
    return words.text(QUANTITIES.get(name, name))
