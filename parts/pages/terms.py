"""The terms of the calculations: ISO 1122-1 and the practicum's own words.

A term is known by its DESIGN name; ``key`` stands for it in formulas, with 1 or 2 behind it where it belongs to a gear.
"""

from __future__ import annotations

from geometry.base.record import Record


class Term(Record):
    """A quantity: its key in formulas, its printed symbol, its unit, its name."""

    key: str
    symbol: str
    unit: str
    name: str


TERMS: dict[str, Term] = {}


def add_terms(text: str) -> None:
    """One term a line: DESIGN name | key | symbol | unit | name.

    Raises
    ------
    ValueError
        A name that is taken.
    """
    rows = [[cell.strip() for cell in line.split("|")] for line in text.strip().splitlines()]
    if taken := {name for name, *_ in rows} & TERMS.keys():
        raise ValueError(f"terms that are there already: {taken}")
    TERMS.update({name: Term(*cells) for name, *cells in rows})


add_terms("""
number_of_teeth|z|z||number of teeth
module|m|m|mm|module
transverse_module|m|m_t|mm|transverse module
helix_angle_deg|beta|β|deg|helix angle
base_helix_angle_deg|beta_b|β_b|deg|base helix angle
pressure_angle_deg|alpha|α|deg|pressure angle of the rack
transverse_pressure_angle_deg|alpha|α_t|deg|transverse pressure angle of the rack
transverse_profile_shift_coefficient|x|x_t||transverse profile shift coefficient
addendum_coefficient|h_a|h_a*||addendum coefficient
tip_clearance_coefficient|c|c*||tip clearance coefficient
tip_radius_coefficient|rho_f|ρ_f*||rounding of the rack's tip, in modules
profile_shift_coefficient|x|x||profile shift coefficient (xi)
generating_shift_coefficient|x_E|x_E||generating shift coefficient
profile_shift|X|X|mm|shift of the rack
circumferential_thinning|A|A_s|mm|thinning of the tooth, arc
gear_ratio|u|u||gear ratio
involute_of_working_pressure_angle|inv_alpha_w|inv α_w||involute of the working pressure angle
working_pressure_angle_deg|alpha_w|α_w|deg|working pressure angle
tangent_of_pressure_angle|tan_alpha|tg α||tangent of the pressure angle
involute_of_pressure_angle|inv_alpha|inv α||involute of the pressure angle
cosine_of_working_pressure_angle|cos_alpha_w|cos α_w||cosine of the working pressure angle
reference_centre_distance|a|a|mm|reference centre distance
working_centre_distance|a_w|a_w|mm|centre distance
centre_distance_coefficient|y|y||centre distance coefficient
tip_shortening_coefficient|dy|Δy||tip shortening coefficient
exact_tip_shortening_coefficient|dy_0|Δy_0||tip shortening coefficient, exactly
profile_shift_sum|x_sum|x_Σ||sum of the profile shift coefficients
tight_profile_shift_sum|x_0|x_Σ0||sum of the shifts without backlash there
working_radius|r_w|r_w|mm|working radius
reference_radius|r|r|mm|reference radius
base_radius|r_b|r_b|mm|base radius
tip_radius|r_a|r_a|mm|tip radius
root_radius|r_f|r_f|mm|root radius
reference_diameter|d|d|mm|reference diameter
base_diameter|d_b|d_b|mm|base diameter
tip_diameter|d_a|d_a|mm|tip diameter
root_diameter|d_f|d_f|mm|root diameter
root_form_diameter|d_Ff|d_Ff|mm|root form diameter
tip_form_diameter|d_Fa|d_Fa|mm|tip form diameter
start_of_active_profile_diameter|d_Nf|d_Nf|mm|start of active profile diameter
active_tip_diameter|d_Na|d_Na|mm|active tip diameter
pitch|p|p_t|mm|pitch
rack_pitch|p|p_t|mm|pitch of the rack
rack_thickness|S|S|mm|tooth thickness on the datum line
rack_space_width|e|e|mm|space width on the datum line
rack_tip_thickness|S_a|S_a|mm|tooth thickness on the tip line
rack_chord|S_ch|S_x|mm|tooth thickness on the datum line, across the tooth
least_rack_pin|D_min|D_min|mm|least pin that touches the flanks
greatest_rack_pin|D_max|D_max|mm|greatest pin that touches the flanks
base_pitch|p_b|p_b|mm|base pitch
working_pitch|p_w|p_w|mm|pitch on the working circle
reference_thickness|S|S|mm|tooth thickness on the reference circle
space_width|e|e|mm|space width on the reference circle
base_thickness|S_b|S_b|mm|tooth thickness on the base circle
base_space_width|e_b|e_b|mm|space width on the base circle
working_thickness|S_w|S_w|mm|tooth thickness on the working circle
tip_thickness|S_a|S_a|mm|tooth thickness on the tip circle
diameter|d_y|d_y|mm|diameter of any circle
pressure_angle_at_diameter_deg|alpha_y|α_y|deg|pressure angle on that circle
thickness_at_diameter|S_y|S_y|mm|tooth thickness on that circle
tip_pressure_angle_deg|alpha_a|α_a|deg|pressure angle at the tip circle
contact_ratio|eps|ε_α||contact ratio
arc_of_action|dd|dd'|mm|arc of action
contact_ratio_by_arc|eps_arc|ε'_α||contact ratio by the arc of action
contact_ratio_difference_percent|delta|Δ|%|difference of both contact ratios
measured_arc_of_action|dd_m|dd'|mm|arc of action on the drawing
measured_working_pitch|p_wm|p_w|mm|pitch on the working circle on the drawing
measured_contact_ratio|eps_m|ε'_α||contact ratio from the drawing
measured_difference_percent|delta_m|Δ|%|difference from the formula
effective_contact_ratio|eps_eff|ε_eff||contact ratio of the flanks that are there
overlap_ratio|eps_beta|ε_β||overlap ratio
total_contact_ratio|eps_gamma|ε_γ||total contact ratio
face_width|b|b|mm|face width
line_of_action_length|L|N_1N_2|mm|theoretical line of action
active_line_length|g|ab|mm|active line of action
approach_length|g_f|aP|mm|length of approach
recess_length|g_a|Pb|mm|length of recess
root_sliding|zeta_f|ζ_f||specific sliding at the root
tip_sliding|zeta_a|ζ_a||specific sliding at the tip
sliding_factor_at_start|K_gf|K_gf||sliding speed at the start of contact, part of the pitch speed
sliding_factor_at_end|K_ga|K_ga||sliding speed at the end of contact, part of the pitch speed
normal_backlash|j_bn|j_n|mm|normal backlash
circumferential_backlash|j_wt|j_t|mm|circumferential backlash
bottom_clearance_at_root|c_tip|c|mm|bottom clearance at the root, below the mate's tip
least_shift_practicum|xi_min|ξ_min||least shift without undercut by the rule
least_shift_without_undercut|x_min|x_min||least shift without undercut, exactly
least_number_of_teeth|z_min|z_min||least number of teeth without undercut at x = 0
greatest_shift_for_tip_thickness|x_max|x_0.3||greatest shift with a tip of 0.3 m
pointed_diameter|d_p|d_p|mm|diameter at which the tooth is pointed
least_tip_thickness|S_min|S_min|mm|least tip thickness
required_contact_ratio|eps_0|[ε]||contact ratio to keep
required_tip_thickness|s_0|[S_a/m]||tip thickness to keep, in modules
required_tip_clearance|c_0|[c/m]||bottom clearance to keep, in modules
cutter_teeth|z_0|z_0||teeth of the ring's cutter
cutter_shift|x_0|x_0||profile shift of the cutter
cutter_addendum|h_a0|h_a0*||addendum of the cutter
cutter_tip_rounding|rho_0|ρ_0*||rounding of the cutter's corner, in modules
dedendum_coefficient|h_f|h_f*||dedendum coefficient
generating_angle_deg|alpha_w0|α_w0|deg|working pressure angle with the cutter
generating_distance|a_w0|a_w0|mm|centre distance with the cutter
teeth_spanned|k|k||teeth in the span
teeth_to_span|k_t|k_t||teeth to span, before rounding
spaces_spanned|k|k||spaces in the span
spaces_to_span|k_t|k_t||spaces to span, before rounding
span|W|W|mm|span over k teeth
span_over_spaces|W|W|mm|span over k spaces
span_nominal|W_0|W_0|mm|span of the gear without thinning
kerf|kerf|k_c|mm|kerf that the cut was not corrected for
span_after_kerf|W_c|W_c|mm|span of the part cut so
over_pins_after_kerf|M_c|M_c|mm|size over pins of the part cut so
measured_span|W_m|W_m|mm|span measured on the part
normal_allowance|E|E_W|mm|lack of both flanks along their normal
thinning_from_span|A_m|A_m|mm|thinning that the measured span tells, arc
measured_over_pins|M_m|M_m|mm|size over pins measured on the part
measured_over_balls|M_m|M_m|mm|size over balls measured on the part
measured_between_pins|M_m|M_m|mm|size between pins measured on the part
measured_between_balls|M_m|M_m|mm|size between balls measured on the part
thinning_from_size|A_M|A_M|mm|thinning that the measured size tells, arc
span_contact_diameter|d_W|d_W|mm|diameter where the faces touch
best_pin_diameter|D_M|D_M|mm|pin that touches at d + 2 x m
least_pin_diameter|D_min|D_min|mm|least pin that touches the involute
greatest_pin_diameter|D_max|D_max|mm|greatest pin that touches the involute
pin_diameter|D|D|mm|pin
pin_centre_angle_deg|alpha_D|α_D|deg|pressure angle at the pin's centre
pin_centre_diameter|d_D|d_D|mm|diameter of the pins' centres
over_pins|M|M|mm|size over pins
over_pins_nominal|M_0|M_0|mm|size over pins of the gear without thinning
between_pins|M|M|mm|size between pins
between_pins_nominal|M_0|M_0|mm|size between pins of the ring without thinning
between_pins_after_kerf|M_c|M_c|mm|size between pins of the ring cut so
pin_contact_diameter|d_DM|d_DM|mm|diameter where the pins touch
best_ball_diameter|D_M|D_M|mm|ball that touches at d + 2 x m
least_ball_diameter|D_min|D_min|mm|least ball that touches the involute
greatest_ball_diameter|D_max|D_max|mm|greatest ball that touches the involute
ball_diameter|D|D|mm|ball
ball_centre_angle_deg|alpha_D|α_D|deg|transverse angle at the ball's centre
ball_centre_diameter|d_D|d_D|mm|diameter of the balls' centres
over_balls|M|M|mm|size over balls
over_balls_nominal|M_0|M_0|mm|size over balls of the gear without thinning
over_balls_after_kerf|M_c|M_c|mm|size over balls of the part cut so
between_balls|M|M|mm|size between balls
between_balls_nominal|M_0|M_0|mm|size between balls of the ring without thinning
between_balls_after_kerf|M_c|M_c|mm|size between balls of the ring cut so
ball_contact_diameter|d_DM|d_DM|mm|diameter where the balls touch
chordal_thickness|S_ch|S_x|mm|chordal thickness at the reference circle
chordal_height|h_ch|h_x|mm|height to the chord
constant_chord|S_c|S_c|mm|constant chord
constant_chord_height|h_c|h_c|mm|height to the constant chord
measured_thickness|S_t|S_t|mm|measured: thickness on the reference circle
measured_space_width|e_t|e_t|mm|measured: space on the reference circle
measured_pitch|P_t|P_t|mm|measured: pitch on the reference circle
measured_base_thickness|S_bm|S_b|mm|measured: thickness on the base circle
measured_tip_thickness|S_am|S_a|mm|measured: tooth thickness on the tip circle
measured_form_diameter|d_Fm|d_Ff|mm|measured: where the involute begins
disk_diameter|d_disk|d_0|mm|diameter of the paper disk
rack_distance|a_w|a_w|mm|from the axis to the rack's datum line
travel_per_turn|L_1|L_1|mm|way of the rack for one turn
rack_addendum|h_aR|h_a2|mm|addendum of the rack
rack_dedendum|h_fR|h_f|mm|dedendum of the rack
rack_length|L_R|L|mm|length of the rack
rack_back_distance|H|H|mm|from the rack's back to its datum line
over_pin|M|M|mm|size from the rack's back over a pin
over_pin_nominal|M_0|M_0|mm|size over a pin of the rack without thinning
over_pin_after_kerf|M_c|M_c|mm|size over a pin of the rack cut so
pin_at_datum_line|D_M|D_M|mm|pin that touches at the datum line
pin_contact_height|h_D|h_D|mm|height over the datum line where the pin touches
profile_shift_difference|x_diff|x_2-x_1||difference of the profile shift coefficients
involute_interference_margin|q_1|q_1|mm|no involute interference: margin
trochoid_interference_margin|q_2|q_2|mm|no tip interference: margin
radial_assembly_margin|q_3|q_3|mm|radial assembly: margin
fillet_interference_margin|q_f|q_f|mm|no fillet interference: margin
greatest_tip_diameter_pinion|d_a1max|d_a1max|mm|largest tip diameter of the pinion
least_tip_diameter_ring|d_a2min|d_a2min|mm|least tip diameter of the ring
least_face_width|b_min|b_min|mm|face width that the span needs
secure_face_width|b_s|b_s|mm|face width that makes the span secure
lift|H|H|mm|lift
swing_deg|H|Ψ|deg|swing
rise_angle_deg|phi_r|φ_від|deg|cam angle of the rise
far_dwell_angle_deg|phi_f|φ_д.в.|deg|cam angle of the far dwell
return_angle_deg|phi_b|φ_наб|deg|cam angle of the return
near_dwell_angle_deg|phi_n|φ_б.в.|deg|cam angle of the near dwell
lift_of_phase|h|h|mm|lift of the phase
swing_of_phase_deg|h|ψ|deg|swing of the phase
velocity_coefficient|c_v|C_v||peak velocity coefficient
acceleration_coefficient|c_a|C_a||peak acceleration coefficient
peak_velocity|S1|S'_max|mm/rad|peak of the velocity's analogue
peak_acceleration|S2|S''_max|mm/rad2|peak of the acceleration's analogue
follower_offset|E|E|mm|offset of the follower
least_transmission_angle_deg|gamma|γ_min|deg|least transmission angle
transmission_angle_reached_deg|gamma_r|γ|deg|transmission angle reached, rise
pressure_angle_rise_deg|nu_r|ν_від|deg|greatest pressure angle, rise
pressure_angle_return_deg|nu_b|ν_наб|deg|greatest pressure angle, return
least_prime_circle_radius|r_0|r_0|mm|least prime circle radius by the condition
least_rise_radius|r_0r|r_від|mm|least prime circle radius by the condition on the rise alone
best_centre_distance|d_0|d_0|mm|centre distance of the smallest cam of this arm
smallest_prime_circle_radius|r_0d|r_0d|mm|prime circle radius of that cam
curvature_reserve|rho|ρ|mm|least convex radius of curvature asked
least_base_circle_radius|R_min|R_min|mm|least radius of the cam (base circle)
least_cam_radius|R_min|R_min|mm|least radius of the cam
follower_radius|r|r|mm|radius of the roller or mushroom
initial_height|s_0|s_0|mm|initial height of the follower
least_curvature_radius|rho_min|ρ_min|mm|least convex radius of curvature
least_pitch_radius|rho_p|ρ_p|mm|least convex radius of the pitch curve
largest_roller_radius|r_lim|r_гр|mm|largest roller radius by the pitch curve, with a reserve
least_plate_diameter|D_pl|D_т|mm|least diameter of the plate
speed_rpm|n_rpm|n|rpm|speed of the cam
angular_speed|omega|ω|rad/s|angular speed of the cam
time_of_phase|t|t|s|time of the phase
greatest_velocity|v_max|v_max|mm/s|greatest velocity of the follower
greatest_acceleration|a_max|a_max|m/s2|greatest acceleration of the follower
greatest_angular_velocity|v_max|ω_max|rad/s|greatest angular velocity
greatest_angular_acceleration|a_max|ε_max|rad/s2|greatest angular acceleration
graphical_intervals|n|n||intervals of each phase
graphical_factor|k|k||stretch of scales by y_max, (4.2)
graphical_lift_error|dS|ΔS|mm|greatest error of S by the drawing
graphical_swing_error_deg|dS|Δψ|deg|greatest error of the swing by the drawing
graphical_velocity_error|dS1|ΔS'|mm/rad|greatest error of S' by the drawing
graphical_prime_circle_radius|r_0g|r_0g|mm|least prime circle radius by the drawing
graphical_radius_error|dr_0|Δr_0|mm|its error
graphical_profile_error|dn|Δn|mm|greatest error of the drawn profile
""")
# other cams, round pins and noncircular gears
add_terms("""
rise_travel|l_r|l_від|mm|travel of the rise
far_dwell_travel|l_f|l_д.в.|mm|travel of the far dwell
return_travel|l_b|l_наб|mm|travel of the return
near_dwell_travel|l_n|l_б.в.|mm|travel of the near dwell
peak_slope|S1|S'_max||peak of S' over the travel
peak_bend|S2|S''_max|1/mm|peak of S'' over the travel
whole_travel|L|L|mm|whole travel of the plate
base_height|h_0|h_0|mm|height of the plate under the follower at S = 0
plate_velocity|c|c|mm/s|velocity of the plate
arm_length|l_arm|L|mm|length of the arm
centre_distance|d|d|mm|from the axis of the cam to the pivot
start_angle_deg|psi_0|ψ_0|deg|angle of the arm at S = 0
clearance|c_r|c|mm|play of the roller in its groove
groove_width|b|b|mm|width of the groove
groove_depth|t|t|mm|depth of the groove
outer_wall_radius|R_out|R_out|mm|greatest radius of the outer wall
least_path_radius|R_1|R_1|mm|least distance of the roller's centre from the axis
greatest_path_radius|R_2|R_2|mm|greatest distance of the roller from the axis
least_hollow_radius|rho_h|ρ_вг|mm|least hollow radius of the roller's path
least_radius_both_ways|r_0|r_0|mm|least radius by the condition, both ways
outer_diameter|D|D|mm|outer diameter
floor_diameter|D_f|D_дна|mm|diameter of the groove's floor
barrel_length|L|L|mm|length of the barrel
roller_diameter|d|d|mm|diameter of the roller
largest_roller_diameter|d_lim|d_гр|mm|largest roller that undercuts no wall
roller_height|z_0|z_0|mm|height of the roller's axis at S = 0
pivot_height|z_p|z_п|mm|height of the arm's pivot
pivot_offset|y_p|y_п|mm|from the cam's axis to the pivot
outer_pressure_angle_rise_deg|nu_m|ν_від|deg|greatest angle at the outside, rise
outer_pressure_angle_return_deg|nu_n|ν_наб|deg|greatest angle at the outside, return
roller_distance|a_r|a|mm|distance of both rollers' centres
roller_angle_deg|a_r|θ|deg|angle between both arms
second_follower_radius|r_2|r_2|mm|radius of the second roller
second_least_radius|R_min2|R_min2|mm|least radius of the second disk
second_pressure_angle_deg|nu_2|ν_2|deg|greatest pressure angle of the second roller
second_curvature_radius|rho_2|ρ_min2|mm|least convex radius of the second disk
breadth|B|B|mm|breadth of the cam, the same at every angle
breadth_error|dB|ΔB|mm|departure of S(phi) + S(phi + 180) from H
yoke_play|c_y|c|mm|play of the cam in the yoke
yoke_opening|B_y|B_р|mm|between the faces or the rollers' centres of the yoke
yoke_middle|h_y|h_р|mm|middle of the yoke over the axis at S = 0
window_width|w_y|w_р|mm|width of the yoke's window
number_of_lobes|z|z_1||lobes of the disc
number_of_pins|N|N||number of pins
pin_circle_radius|R|R|mm|radius of the pins' circle
pin_radius|r_p|r_ц|mm|radius of a pin
eccentricity|e|e|mm|eccentricity
pin_clearance|c_p|c|mm|clearance between flank and pin, normal
pin_circle_shift|dR|ΔR|mm|the generating pin circle is smaller by
generating_radius|R_g|R_т|mm|radius of the generating circle of pins
generating_pin_radius|rho|ρ|mm|radius of the generating pin
reduction|i|i||ratio of eccentric to disc, the pins held
reduction_of_pins|i_n|i_N||ratio to the pins if the disc cannot turn
shortening_coefficient|lam|λ||shortening coefficient
greatest_shortening|lam_max|λ_max||greatest shortening without undercut
greatest_eccentricity|e_max|e_max|mm|greatest eccentricity without undercut
disc_centrode_radius|r_1|r_1|mm|centrode of the disc
pin_centrode_radius|r_2|r_2|mm|centrode of the pins
cycloidal_tip_radius|R_a|R_a|mm|radius of the lobes' tops
cycloidal_root_radius|R_f|R_f|mm|radius of the valleys' bottoms
lobe_height|h|h|mm|height of the lobes
least_path_curvature_radius|rho_0|ρ_0|mm|least convex radius of a pin centre's path
least_profile_radius|rho_min|ρ_min|mm|least convex radius of the profile
least_disc_pressure_angle_deg|alpha_min|α_min|deg|least pressure angle of a pin
best_pin_angle_deg|psi_b|ψ_α|deg|angle of that pin from the eccentric
greatest_force_arm|l_max|l_max|mm|greatest arm of a pin's normal about the disc's axis
greatest_arm_angle_deg|psi_l|ψ_l|deg|angle of the pin with the greatest arm
driving_pins|n_d|n||pins that can drive in one sense, at most
output_hole_diameter|d_h|d_отв|mm|holes of the output pins
output_pin_diameter|d_o|d_п|mm|output pins
output_hole_clearance|c_o|c_п|mm|clearance of a hole beyond pin and 2 e
lantern_pitch_radius|r_2|r_2|mm|pitch radius of the lantern: its circle of pins
lantern_gear_pitch_radius|r_1|r_1|mm|pitch radius of the gear
lantern_pitch|p|p|mm|pitch on both pitch circles
epicycloid_order|m_e|m||turning of the generating circle over that of the gear
root_arc_radius|rho_f|ρ_f|mm|radius of the roots' arcs
root_clearance|c_f|c_f|mm|clearance between a pin and the root
flank_start_radius|R_s|R_п|mm|radius at which the flank begins
pointed_radius|R_p|R_з|mm|radius at which the tooth is pointed
neck_width|s_n|s_ш|mm|tooth between its root arcs on the pitch circle
flank_start_angle_deg|u_1|u_1|deg|gear's angle at which the flank begins
flank_end_angle_deg|u_2|u_2|deg|gear's angle at which the flank ends
pitch_angle_deg|tau|τ|deg|angular pitch of the gear
lantern_contact_ratio|eps|ε||contact ratio of one flank
end_pressure_angle_deg|alpha_max|α_max|deg|pressure angle at the end of contact
greatest_pin_radius|r_lim|r_гр|mm|half of the distance of neighbouring pins
gear_teeth|z_1|z_1||teeth of this gear, driver
mate_teeth|z_2|z_2||teeth of its mate
centrode_parameter|p_c|p_e|mm|parameter of the centrode r = p/(1 - e cos n phi)
centrode_eccentricity|e_c|e||eccentricity of the centrode
centrode_lobes|n_c|n||lobes of the driver's centrode
mate_lobes|n_2|n_2||lobes of the mate's centrode
greatest_convex_eccentricity|e_max|e_max||greatest eccentricity of a convex centrode
perimeter|P|P|mm|perimeter of this gear's centrode
mate_perimeter|P_2|P_2|mm|perimeter of the mate's centrode
centrode_pitch|p|p|mm|pitch along the centrode
least_centrode_radius|r_min|r_min|mm|least radius of the driver's centrode
greatest_centrode_radius|r_max|r_max|mm|greatest radius of the driver's centrode
noncircular_distance|a|a|mm|centre distance
least_ratio|i_min|i_min||least ratio d phi_2 / d phi_1
greatest_ratio|i_max|i_max||greatest ratio d phi_2 / d phi_1
mean_ratio|i_m|i_ср||ratio of whole turns
mate_turns|Phi_2|Φ_2|deg|turn of the mate for one of the driver
closure_error_deg|dPhi|ΔΦ|deg|departure from the whole number of lobes
least_centrode_bend|rho_c|ρ_min|mm|least radius of curvature of this centrode
greatest_centrode_bend|rho_g|ρ_max|mm|greatest radius of curvature of it
equivalent_teeth|z_e|z_екв||teeth of a round gear as much curved
least_equivalent_teeth|z_min|z_min||least teeth of it without undercut
undercut_sides|n_u|n_підр||undercut tooth sides of a lobe
least_tip_land|S_a|S_a|mm|least tip land
tip_height|h_tip|h_a|mm|height of the tips over the centrode
root_depth|h_root|h_f|mm|depth of the roots below the centrode
noncircular_contact_ratio|eps|ε||least contact ratio of the pair
""")
# a cam whose follower sits on a connecting rod, in Savvin's symbols
add_terms("""
driven_pivot_x|x_O|x_O1|mm|pivot of the driven rocker, x
driven_pivot_y|y_O|y_O1|mm|pivot of the driven rocker, y
driven_length|l_1|l_1|mm|length of the driven rocker
driven_start_angle_deg|psi_0|ψ_0|deg|angle of the driven rocker at S = 0
driven_start_x|x_O|x_A0|mm|joint A at S = 0, x
driven_start_y|y_O|y_A0|mm|joint A at S = 0, y
driven_direction_deg|delta_1|δ_1|deg|direction of the driven slider
coupler_length|b|b|mm|length of the connecting rod AB
guide_pivot_x|x_C|x_C|mm|pivot of the guiding rocker, x
guide_pivot_y|y_C|y_C|mm|pivot of the guiding rocker, y
guide_length|c|c|mm|length of the guiding rocker CB
guide_through_x|x_C|x_C|mm|point of the guide's line, x
guide_through_y|y_C|y_C|mm|point of the guide's line, y
guide_direction_deg|delta|δ|deg|direction of the guide
coupler_point_x|xi_p|ξ_p|mm|follower on the rod, from A towards B
coupler_point_y|eta_p|η_p|mm|follower on the rod, across AB
follower_direction_deg|tau|τ|deg|direction of stem or face normal from AB
contact_pressure_angle_deg|nu_m|ν_max|deg|greatest pressure angle at the contact
coupler_swing_deg|theta_m|Δθ|deg|the connecting rod turns by
joint_transmission_angle_deg|mu_m|μ_min|deg|least transmission angle at joint B
greatest_sliding_velocity|v_m|v_max|mm/rad|greatest sliding velocity
face_from|e_1|e_1|mm|contact on the face, from
face_to|e_2|e_2|mm|contact on the face, to
greatest_cam_radius|R_max|R_max|mm|greatest radius of the cam
position_deg|alpha_1|α_1|deg|cam angle of the position
position_lift|S|S|mm|motion of the driven slider
position_swing_deg|S|S|deg|motion of the driven rocker
position_velocity|S1|S'|mm/rad|its velocity's analogue
position_acceleration|S2|S''|mm/rad2|its acceleration's analogue
position_angular_velocity|S1|S'||its velocity's analogue, rad/rad
position_angular_acceleration|S2|S''||its acceleration's analogue, rad/rad2
driven_angle_deg|psi|ψ|deg|angle of the driven rocker
joint_a_x|x_A|x_A|mm|joint A, x
joint_a_y|y_A|y_A|mm|joint A, y
joint_a_x1|x_A1|x_A'|mm/rad|velocity of A, x
joint_a_y1|y_A1|y_A'|mm/rad|velocity of A, y
joint_a_x2|x_A2|x_A''|mm/rad2|acceleration of A, x
joint_a_y2|y_A2|y_A''|mm/rad2|acceleration of A, y
guide_distance|q|q|mm|from A to the pivot C
guide_line_angle_deg|chi|χ|deg|direction of AC
rod_angle_deg|beta|β|deg|angle BAC, law of cosines
guide_height|h|h|mm|A to the left of the guide's line
rod_lean_deg|lam|λ|deg|lean of the rod to the guide
coupler_angle_deg|theta|θ|deg|angle of the connecting rod AB
transmission_angle_deg|mu|μ|deg|transmission angle at joint B
joint_b_x|x_B|x_B|mm|joint B, x
joint_b_y|y_B|y_B|mm|joint B, y
coupler_velocity|omega_2|ω_2||turning of the rod, rad/rad
joint_b_x1|x_B1|x_B'|mm/rad|velocity of B, x
joint_b_y1|y_B1|y_B'|mm/rad|velocity of B, y
coupler_acceleration|eps_2|ε_2||change of that turning, rad/rad2
reference_x|x_02|x_02|mm|reference point of the follower, x
reference_y|y_02|y_02|mm|reference point of the follower, y
reference_x1|x_021|x_02'|mm/rad|velocity of that point, x
reference_y1|y_021|y_02'|mm/rad|velocity of that point, y
reference_x2|x_022|x_02''|mm/rad2|acceleration of that point, x
reference_y2|y_022|y_02''|mm/rad2|acceleration of that point, y
follower_angle_deg|alpha_2|α_2|deg|angle of the follower's axes
relative_turning|W|Ω||turning against the cam: omega_2 - omega_1
savvin_a|A|A|mm|O_2 in the cam's frame, x
savvin_b|B|B|mm|O_2 in the cam's frame, y
savvin_a1|A1|A'|mm/rad|derivative of A
savvin_b1|B1|B'|mm/rad|derivative of B
savvin_a2|A2|A''|mm/rad2|second derivative of A
savvin_b2|B2|B''|mm/rad2|second derivative of B
savvin_f|F|F_ω|mm/rad|F times the relative turning
savvin_r|R|R_ω|mm/rad|R times the relative turning
path_speed|w|w|mm/rad|velocity of O_2 against the cam
contact_x2|xi_2|ξ_2|mm|contact in the follower's frame, x
contact_y2|eta_2|η_2|mm|contact in the follower's frame, y
contact_x1|xi_1|ξ_1|mm|profile of the cam, x
contact_y1|eta_1|η_1|mm|profile of the cam, y
relative_x1|xi_21|ξ_21'|mm/rad|velocity against the cam at the contact, x
relative_y1|eta_21|η_21'|mm/rad|velocity against the cam at the contact, y
sliding_velocity|v_s|v_s|mm/rad|sliding velocity
rolling_velocity|v_s|v_k|mm/rad|velocity at which the roller rolls on the cam
contact_velocity_x|x_t1|x_A2'|mm/rad|velocity of the follower at the contact, x
contact_velocity_y|y_t1|y_A2'|mm/rad|velocity of the follower at the contact, y
velocity_angle_deg|gamma_2|γ_2|deg|direction of that velocity
frame_normal_angle_deg|gamma_11|γ_11|deg|direction of the normal in the cam's frame
normal_angle_deg|gamma_1|γ_1|deg|direction of the normal
position_contact_pressure_angle_deg|nu_c|ν|deg|pressure angle at the contact, acute
centre_velocity_angle_deg|gamma_0|γ_0|deg|direction of the velocity of O_2
position_pressure_angle_deg|nu_0|ν_0|deg|pressure angle at the centre O_2
position_curvature_radius|rho_1|ρ|mm|radius of curvature of the cam, convex above 0
""")
add_terms("""
wanted_ratio|u|u||wanted ratio
ratio_tolerance_percent|du|δu|%|how far the ratio may be off
number_of_satellites|n|n||number of satellites
least_teeth|z_min|z_min||least number of teeth
most_teeth|z_max|z_max||greatest number of teeth
sets_found|N_s|N_s||sets found
carried_ratio|p|u_13^H||ratio with the carrier held
planetary_ratio|u|u||ratio of the planetary set
exact_ratio|u_exact|u||the same, exactly
greatest_common_divisor|g|g||greatest common divisor of the teeth of both rims
satellite_places|N|N||places for one and the same satellite
least_satellite_angle_deg|theta_s|θ_s|deg|least angle between satellites
rim_tip_diameter|d_a|d_a|mm|tip diameter of the larger rim
neighbour_distance|l_s|l_s|mm|distance between axes of neighbours
most_satellites|n_max|n_max||most satellites that fit
ring_tip_addendum|h_a3|h_a3||ring tips inside its reference circle, in modules
satellite_gap|g_s|g_s|mm|gap between tips of neighbours
set_diameter|D|D|mm|what the whole set takes across
""")
# worm drives, GOST 18498 and GOST 19650
add_terms("""
axial_module|m|m|mm|axial module
diameter_quotient|q|q||diameter quotient of the worm
number_of_starts|z1|z_1||number of starts of the worm
worm_wheel_teeth|z2|z_2||number of teeth of the wheel
worm_form|form|Z||form of the worm
worm_pressure_angle_deg|alpha|α|deg|pressure angle of the worm
worm_fillet_coefficient|rho_f|ρ_f*||fillet at the worm's root, in modules
worm_ratio|u|u||gear ratio
worm_centre_distance|a_w|a_w|mm|centre distance
worm_reference_diameter|d1|d_1|mm|reference diameter of the worm
wheel_reference_diameter|d2|d_2|mm|reference diameter of the wheel
worm_pitch_diameter|d_w1|d_w1|mm|pitch diameter of the worm
lead_angle_deg|gamma|γ|deg|lead angle
pitch_lead_angle_deg|gamma_w|γ_w|deg|lead angle on the pitch cylinder
base_lead_angle_deg|gamma_b|γ_b|deg|base lead angle
worm_base_diameter|d_b|d_b|mm|base diameter of the worm
lead|p_z|p_z|mm|lead of the thread
thread_height|h1|h_1|mm|height of the thread
thread_addendum|h_a1|h_a1|mm|addendum of the thread
worm_tip_diameter|d_a1|d_a1|mm|tip diameter of the worm
worm_root_diameter|d_f1|d_f1|mm|root diameter of the worm
worm_fillet_radius|rho_f1|ρ_f1|mm|fillet radius at the worm's root
throat_diameter|d_a2|d_a2|mm|tip diameter of the wheel in its mid plane
wheel_root_diameter|d_f2|d_f2|mm|root diameter of the wheel in its mid plane
most_outer_diameter|d_ae2|d_ae2|mm|greatest outer diameter of the wheel
least_worm_length|b1_min|b_1min|mm|least threaded length of the worm
most_face_width|b2_max|b_2max|mm|greatest width of the wheel's rim
axial_pressure_angle_deg|alpha_x|α_x|deg|pressure angle in the axial section
axial_thickness|s_x|s_x|mm|axial thickness of the thread
normal_thickness|s_n|s_n|mm|thickness of the thread across its helix
thread_tip_thickness|s_a|s_xa|mm|axial thickness of the thread at its tip
worm_length_used|b1_used|b_1u|mm|length of the worm that the wheel touches
worm_length|b1|b_1|mm|threaded length of the worm
worm_torque|T1|T_1|N*m|torque on the worm
wheel_torque|T2|T_2|N*m|torque on the wheel
friction_coefficient|f|f||coefficient of friction
friction_angle_deg|rho_v|ρ'|deg|angle of friction
worm_efficiency|eta|η||efficiency, the worm drives
back_driving_efficiency|eta_b|η_2||efficiency, the wheel drives
worm_axial_force|F_a1|F_a1|N|axial force on the worm, along the wheel
worm_tangential_force|F_t1|F_t1|N|force along the worm's circle
worm_radial_force|F_r|F_r|N|radial force
width_share|psi|ψ_b||width of the rim in parts of the full one
form_factor|Y_F|Y_F2||form factor of the wheel's teeth
width_factor|K_b|K_β||factor of load along the teeth
speed_factor|K_v|K_v||factor of dynamic load
tensile_strength|sigma_b|σ_b|MPa|tensile strength of the rim
bending_life_factor|K_FL|K_FL||factor of life in bending
contact_life_factor|K_HL|K_HL||factor of life in contact
allowed_bending_stress|sigma_FP|σ_FP2|MPa|allowed bending stress
thesis_least_module|m_0|m|mm|module by the thesis's formula for half the width
least_module|m_min|m_min|mm|least module by bending
allowed_contact_stress|sigma_HP|σ_HP2|MPa|allowed contact stress
thesis_contact_stress|sigma_H0|σ_H|MPa|contact stress by the thesis's formula for half the width
contact_stress|sigma_H|σ_H|MPa|contact stress
least_rim_width|b2_min|b_2min|mm|least width of the rim by contact
rim_width|b2|b_2|mm|width of the wheel's rim
""")
add_terms("""
number_of_stages|k|k||number of stages
moving_links|n|n||moving links
lower_pairs|p_5|p_5||lower kinematic pairs (bearing and shaft)
higher_pairs|p_4|p_4||higher kinematic pairs (meshes)
degree_of_freedom|W|W||degree of freedom
exact_degree_of_freedom|W_r|W_r||degree of freedom by the rank of all equations
mesh_ratio|u_m|u||ratio of the pair
stage_ratio|u_s|u||ratio of the stage
row_ratio|u_r|u||the same by the outer wheels: those between are idlers
total_ratio|u_whole|u||ratio of the whole mechanism
angular_velocity|omega|ω|rad/s|angular velocity
mesh_efficiency|eta_z|η_z||efficiency of a mesh
efficiency|eta|η||efficiency of the whole
torque|T|T|N*m|torque from outside
power_in|P|P|W|power put in
circulation|c_P|c_P||greatest power of a mesh by that put in
turns_of_driven|n|n||turns of the driven link for one turn of the driver
turns_counted|n_counted|n||turns of it that were counted
""")
add_terms("""
first_arm|L1|L_1|mm|distance O1O2 of the disks' axes
second_arm|L2|L_2|mm|distance O2O3 of the platform's axis
point_x|x|x|mm|x of the platform's axis O3
point_y|y|y|mm|y of the platform's axis O3
point_distance|r|r|mm|distance O1O3
point_direction_deg|chi|χ|deg|direction of O1O3 from +y towards +x
angle_at_o1_deg|mu|μ|deg|angle between O1O2 and O1O3
beta_deg|beta|β|deg|angle between O2O1 and O2O3
delta_deg|delta|δ|deg|angle of O1O2 from +y towards +x
ring_angle_deg|theta|θ|deg|angle of the ring, drive II
pair_ratio|u|u||ratio of the ring and the pinion of disk 3
worm_turns|n|n||turns of the worm
platform_turn_deg|phi_6|φ_6|deg|turn of the platform by the wheels 6, 7, 8, counter-clockwise
path_length|s|s|mm|length of the path
path_error|e|e|mm|the platform leaves the path by no more than
load_arm|l|l|mm|greatest arm of a force on the platform about the drive
load_held|F_max|F_max|N|force on the platform that the worms hold anywhere
load|F|F|N|force on the platform
load_torque|T_F|T_F|N*m|torque that the load asks of the wheel, at most
worm_torque_asked|T_1F|T_1|N*m|torque on the worm there, by statics of the mechanism
pinion_torque|T_11F|T_11|N*m|torque on the pinion of disk 3 there
disk_3_bearing_force|F_O2|F_O2|N|radial force of load and mesh on the bearing of disk 3, and with it of disk 2, at most
ring_bearing_force|F_12|F_12|N|radial force of the mesh on the bearing of the ring, at most
worst_beta_deg|beta_F|β|deg|there, angle between O2O1 and O2O3
pair_torque|T_11|T_11|N*m|torque on the pinion of disk 3
fatigue_limit_bending|sigma_Flim|σ_Flim|MPa|endurance limit in bending
life_factor|Y_N|Y_N||factor of life
roughness_factor|Y_R|Y_R||factor of the fillet's roughness
size_factor|Y_X|Y_X||factor of size
gradient_factor|Y_d|Y_δ||factor of the stress gradient
bending_safety|S_F|S_F||safety in bending
reversing_factor|K_R|K_R||factor of load in both senses
pair_allowed_bending|sigma_FP1|σ_FP1|MPa|allowed bending stress of the pair
module_factor|K_m|K_m||factor of the module
pair_width_factor|K_Fb|K_Fβ||factor of load along the teeth
pair_form_factor|Y_FS|Y_FS1||form factor of the tooth
width_ratio|psi_bd|ψ_bd||width of the teeth by the diameter
pair_least_module|m_0|m||least module of the pair by bending
circumferential_force|F_t|F_t|N|force along the pitch circle
elasticity_factor|Z_E|Z_E||factor of the materials
zone_factor|Z_H|Z_H||factor of the flanks' form
exact_zone_factor|Z_H0|Z_H||factor of the flanks' form, exactly
overlap_factor|Z_eps|Z_ε||factor of the length of contact
outer_load_factor|K_A|K_A||factor of outer dynamic load
pair_speed_factor|K_Hv|K_Hv||factor of dynamic load
pair_contact_stress|sigma_Hp|σ_H|MPa|contact stress of the pair
contact_limit|sigma_Hlim|σ_Hlim|MPa|endurance limit in contact
contact_safety|S_H|S_H||safety in contact
contact_roughness_factor|Z_R|Z_R||factor of the flanks' roughness
circumferential_speed_factor|Z_v|Z_v||factor of speed
pair_allowed_contact|sigma_HPp|σ_HP|MPa|allowed contact stress of the pair
pair_least_width|b_min|b_min|mm|least width of the pair by contact
pair_radial_force|F_RZ|F_RZ|N|radial force of the pair
thesis_worm_radial_force|F_RC|F_RC|N|radial force of the worm by the thesis
loaded_turns|i_2|i_2||turns of balls that work against the first
preload|F_H|F_H|N|preload
balls|z_b|z||balls in one turn
guide_ball_diameter|d_b|d_k|mm|diameter of a ball
radial_factor|k4|k_4||share of the balls that carry the radial load
bearing_radial_force|F_R|F_R|N|radial load
contact_angle_deg|alpha_b|α|deg|angle of contact
turn_capacity|C|C||load of the turn for its approach, N/mm^(3/2)
axial_stiffness|j_a|j_a||axial stiffness, N/mm
radial_stiffness|j_r|j_r||radial stiffness, N/mm
least_ball_circle|D_b|D_0|mm|least circle of so many balls
ring_root_diameter|d_f12|d_f12|mm|root diameter of the ring
ball_wall|w_b|w|mm|wall between the ring's root and the groove
groove_radius|r_g|r_g|mm|radius of the groove
ball_stiffness|K_0|K||load of a ball for its approach by the thesis, N/mm^(3/2)
hertz_stiffness|K_1|K||load of a ball for its approach by Hertz, N/mm^(3/2)
wheel_backlash|j_6|j_6|mm|backlash of each mesh that turns the platform
platform_play_deg|phi_p|φ_p|deg|play of the platform's turn
crank_pin_clearance|c_p|c_p|mm|clearance of each pin of a crank
pivot_circle|r_p|r_p|mm|radius of the circle of the cranks' pivots
""")
