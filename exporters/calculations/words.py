"""The terms of the calculations in English and Ukrainian: ISO 1122-1 and the practicum's own words.

A term is known by its DESIGN name; ``key`` stands for it in formulas, with 1 or 2 behind it where it belongs to a gear.
"""

from __future__ import annotations

from dataclasses import dataclass

from exporters.calculations.words_kinds import TERMS_OF_KINDS
from exporters.calculations.words_linkage import TERMS_OF_LINKAGES


@dataclass(frozen=True, slots=True)
class Term:
    """A quantity: its key in formulas, its printed symbol, its unit, its name in both languages."""

    key: str
    symbol: str
    unit: str
    en: str
    uk: str


def _terms(text: str) -> dict[str, Term]:
    """One term a line: name | key | symbol | unit | English | Ukrainian."""
    rows = ([cell.strip() for cell in line.split("|")] for line in text.strip().splitlines())
    return {name: Term(key, symbol, unit, en, uk) for name, key, symbol, unit, en, uk in rows}


TERMS = _terms("""
number_of_teeth|z|z||number of teeth|число зубців колеса
module|m|m|mm|module|модуль
transverse_module|m|m_t|mm|transverse module|торцевий модуль
helix_angle_deg|beta|β|deg|helix angle|кут нахилу лінії зуба
base_helix_angle_deg|beta_b|β_b|deg|base helix angle|основний кут нахилу
pressure_angle_deg|alpha|α|deg|pressure angle of the rack|кут профілю рейки
transverse_pressure_angle_deg|alpha|α_t|deg|transverse pressure angle of the rack|торцевий кут профілю рейки
transverse_profile_shift_coefficient|x|x_t||transverse profile shift coefficient|торцевий коефіцієнт зміщення
addendum_coefficient|h_a|h_a*||addendum coefficient|коефіцієнт висоти головки зуба
tip_clearance_coefficient|c|c*||tip clearance coefficient|коефіцієнт радіального зазору
tip_radius_coefficient|rho_f|ρ_f*||rounding of the rack's tip, in modules|радіус округлення рейки в модулях
profile_shift_coefficient|x|x||profile shift coefficient (xi)|коефіцієнт зміщення (ξ)
generating_shift_coefficient|x_E|x_E||generating shift coefficient|коефіцієнт зміщення при нарізанні
profile_shift|X|X|mm|shift of the rack|зміщення рейки
circumferential_thinning|A|A_s|mm|thinning of the tooth, arc|стоншення зуба по дузі
gear_ratio|u|u||gear ratio|передаточне відношення
involute_of_working_pressure_angle|inv_alpha_w|inv α_w||involute of the working pressure angle|інволюта кута зачеплення
working_pressure_angle_deg|alpha_w|α_w|deg|working pressure angle|кут зачеплення
tangent_of_pressure_angle|tan_alpha|tg α||tangent of the pressure angle|тангенс кута профілю рейки
involute_of_pressure_angle|inv_alpha|inv α||involute of the pressure angle|евольвентна функція кута профілю рейки
cosine_of_working_pressure_angle|cos_alpha_w|cos α_w||cosine of the working pressure angle|косинус кута зачеплення
reference_centre_distance|a|a|mm|reference centre distance|ділильна міжосьова відстань
working_centre_distance|a_w|a_w|mm|centre distance|міжосьова відстань
centre_distance_coefficient|y|y||centre distance coefficient|коефіцієнт сприйманого зміщення
tip_shortening_coefficient|dy|Δy||tip shortening coefficient|коефіцієнт зрівняльного зміщення
exact_tip_shortening_coefficient|dy_0|Δy_0||tip shortening coefficient, exactly|коефіцієнт зрівняльного зміщення, точно
profile_shift_sum|x_sum|x_Σ||sum of the profile shift coefficients|сума коефіцієнтів зміщення
tight_profile_shift_sum|x_0|x_Σ0||sum of the shifts without backlash there|сума коефіцієнтів зміщення без зазору
working_radius|r_w|r_w|mm|working radius|радіус початкового кола
reference_radius|r|r|mm|reference radius|радіус ділильного кола
base_radius|r_b|r_b|mm|base radius|радіус основного кола
tip_radius|r_a|r_a|mm|tip radius|радіус кола вершин
root_radius|r_f|r_f|mm|root radius|радіус кола западин
reference_diameter|d|d|mm|reference diameter|діаметр ділильного кола
base_diameter|d_b|d_b|mm|base diameter|діаметр основного кола
tip_diameter|d_a|d_a|mm|tip diameter|діаметр кола вершин
root_diameter|d_f|d_f|mm|root diameter|діаметр кола западин
root_form_diameter|d_Ff|d_Ff|mm|root form diameter|діаметр початку евольвенти
tip_form_diameter|d_Fa|d_Fa|mm|tip form diameter|діаметр кінця профілю біля вершини
start_of_active_profile_diameter|d_Nf|d_Nf|mm|start of active profile diameter|діаметр початку робочої ділянки профілю
active_tip_diameter|d_Na|d_Na|mm|active tip diameter|діаметр кінця робочої ділянки профілю
pitch|p|p_t|mm|pitch|крок по ділильному колу
base_pitch|p_b|p_b|mm|base pitch|крок по основному колу
working_pitch|p_w|p_w|mm|pitch on the working circle|крок зачеплення за початковим колом
reference_thickness|S|S|mm|tooth thickness on the reference circle|товщина зуба по ділильному колу
space_width|e|e|mm|space width on the reference circle|ширина западини по ділильному колу
base_thickness|S_b|S_b|mm|tooth thickness on the base circle|товщина зуба по основному колу
working_thickness|S_w|S_w|mm|tooth thickness on the working circle|товщина зуба по початковому колу
tip_thickness|S_a|S_a|mm|tooth thickness on the tip circle|товщина зуба на колі вершин
diameter|d_y|d_y|mm|diameter of any circle|діаметр довільного кола
pressure_angle_at_diameter_deg|alpha_y|α_y|deg|pressure angle on that circle|кут профілю на цьому колі
thickness_at_diameter|S_y|S_y|mm|tooth thickness on that circle|товщина зуба на цьому колі
tip_pressure_angle_deg|alpha_a|α_a|deg|pressure angle at the tip circle|кут профілю зуба по колу вершин
contact_ratio|eps|ε_α||contact ratio|коефіцієнт перекриття
arc_of_action|dd|dd'|mm|arc of action|дуга зачеплення
contact_ratio_by_arc|eps_arc|ε'_α||contact ratio by the arc of action|коефіцієнт перекриття за дугою зачеплення
contact_ratio_difference_percent|delta|Δ|%|difference of both contact ratios|різниця коефіцієнтів перекриття
measured_arc_of_action|dd_m|dd'|mm|arc of action on the drawing|дуга зачеплення на кресленні
measured_working_pitch|p_wm|p_w|mm|pitch on the working circle on the drawing|крок за початковим колом на кресленні
measured_contact_ratio|eps_m|ε'_α||contact ratio from the drawing|коефіцієнт перекриття за кресленням
measured_difference_percent|delta_m|Δ|%|difference from the formula|різниця з формулою
effective_contact_ratio|eps_eff|ε_eff||contact ratio of the flanks that are there|коефіцієнт перекриття наявних профілів
overlap_ratio|eps_beta|ε_β||overlap ratio|коефіцієнт осьового перекриття
total_contact_ratio|eps_gamma|ε_γ||total contact ratio|сумарний коефіцієнт перекриття
face_width|b|b|mm|face width|ширина вінця
line_of_action_length|L|N_1N_2|mm|theoretical line of action|теоретична лінія зачеплення
active_line_length|g|ab|mm|active line of action|практична лінія зачеплення
approach_length|g_f|aP|mm|length of approach|довжина дополюсної частини лінії зачеплення
recess_length|g_a|Pb|mm|length of recess|довжина заполюсної частини лінії зачеплення
root_sliding|zeta_f|ζ_f||specific sliding at the root|питоме ковзання біля ніжки
tip_sliding|zeta_a|ζ_a||specific sliding at the tip|питоме ковзання біля вершини
sliding_factor|K_g|K_g||sliding speed at the end, part of the pitch speed|швидкість ковзання, частка колової швидкості
normal_backlash|j_bn|j_n|mm|normal backlash|нормальний бічний зазор
circumferential_backlash|j_wt|j_t|mm|circumferential backlash|коловий бічний зазор
tip_clearance|c_tip|c|mm|tip clearance at the root|радіальний зазор
least_shift_practicum|xi_min|ξ_min||least shift without undercut by the rule|найменше ξ без підрізу за правилом
least_shift_without_undercut|x_min|x_min||least shift without undercut, exactly|найменше x без підрізу, точно
least_number_of_teeth|z_min|z_min||least number of teeth without undercut at x = 0|найменше z без підрізу при x = 0
greatest_shift_for_tip_thickness|x_max|x_0.3||greatest shift with a tip of 0.3 m|найбільше x при S_a = 0,3 m
pointed_diameter|d_p|d_p|mm|diameter at which the tooth is pointed|діаметр загострення зуба
least_tip_thickness|S_min|S_min|mm|least tip thickness|найменша товщина зуба на колі вершин
required_contact_ratio|eps_0|[ε]||contact ratio to keep|найменший допустимий коефіцієнт перекриття
required_tip_thickness|s_0|[S_a/m]||tip thickness to keep, in modules|найменша товщина вершини в модулях
required_tip_clearance|c_0|[c/m]||bottom clearance to keep, in modules|найменший радіальний зазор у модулях
cutter_teeth|z_0|z_0||teeth of the ring's cutter|число зубців довбача
cutter_shift|x_0|x_0||profile shift of the cutter|коефіцієнт зміщення довбача
cutter_addendum|h_a0|h_a0*||addendum of the cutter|коефіцієнт висоти головки довбача
cutter_tip_rounding|rho_0|ρ_0*||rounding of the cutter's corner, in modules|радіус округлення довбача в модулях
teeth_spanned|k|k||teeth in the span|число зубців у довжині загальної нормалі
teeth_to_span|k_t|k_t||teeth to span, before rounding|число зубців у нормалі до округлення
span|W|W|mm|span over k teeth|довжина загальної нормалі
span_nominal|W_0|W_0|mm|span of the gear without thinning|довжина загальної нормалі без стоншення
kerf|kerf|k_c|mm|kerf that the cut was not corrected for|ширина різу, не врахована в контурі
span_after_kerf|W_c|W_c|mm|span of the part cut so|довжина загальної нормалі вирізаного колеса
over_pins_after_kerf|M_c|M_c|mm|size over pins of the part cut so|розмір по роликах вирізаного колеса
measured_span|W_m|W_m|mm|span measured on the part|виміряна довжина загальної нормалі
normal_allowance|E|E_W|mm|lack of both flanks along their normal|нестача по нормалі на обох профілях
thinning_from_span|A_m|A_m|mm|thinning that the measured span tells, arc|стоншення зуба за виміряною нормаллю
span_contact_diameter|d_W|d_W|mm|diameter where the faces touch|діаметр дотику вимірювальних площин
best_pin_diameter|D_M|D_M|mm|pin that touches at d + 2 x m|ролик, що торкається на колі d + 2 x m
least_pin_diameter|D_min|D_min|mm|least pin that touches the involute|найменший ролик, що торкається евольвенти
greatest_pin_diameter|D_max|D_max|mm|greatest pin that touches the involute|найбільший ролик, що торкається евольвенти
pin_diameter|D|D|mm|pin|ролик
pin_centre_angle_deg|alpha_D|α_D|deg|pressure angle at the pin's centre|кут профілю в центрі ролика
pin_centre_diameter|d_D|d_D|mm|diameter of the pins' centres|діаметр кола центрів роликів
over_pins|M|M|mm|size over pins|розмір по роликах
over_pins_nominal|M_0|M_0|mm|size over pins of the gear without thinning|розмір по роликах без стоншення
pin_contact_diameter|d_DM|d_DM|mm|diameter where the pins touch|діаметр дотику роликів
best_ball_diameter|D_M|D_M|mm|ball that touches at d + 2 x m|кулька, що торкається на колі d + 2 x m
least_ball_diameter|D_min|D_min|mm|least ball that touches the involute|найменша кулька, що торкається евольвенти
greatest_ball_diameter|D_max|D_max|mm|greatest ball that touches the involute|найбільша кулька, що торкається евольвенти
ball_diameter|D|D|mm|ball|кулька
ball_centre_angle_deg|alpha_D|α_D|deg|transverse angle at the ball's centre|торцевий кут профілю в центрі кульки
ball_centre_diameter|d_D|d_D|mm|diameter of the balls' centres|діаметр кола центрів кульок
over_balls|M|M|mm|size over balls|розмір по кульках
over_balls_nominal|M_0|M_0|mm|size over balls of the gear without thinning|розмір по кульках без стоншення
over_balls_after_kerf|M_c|M_c|mm|size over balls of the part cut so|розмір по кульках вирізаного колеса
ball_contact_diameter|d_DM|d_DM|mm|diameter where the balls touch|діаметр дотику кульок
chordal_thickness|S_ch|S_x|mm|chordal thickness at the reference circle|товщина зуба по хорді ділильного кола
chordal_height|h_ch|h_x|mm|height to the chord|висота до хорди
constant_chord|S_c|S_c|mm|constant chord|товщина по постійній хорді
constant_chord_height|h_c|h_c|mm|height to the constant chord|висота до постійної хорди
measured_thickness|S_t|S_t|mm|measured: thickness on the reference circle|виміряно: товщина зуба по ділильному колу
measured_space_width|e_t|e_t|mm|measured: space on the reference circle|виміряно: ширина западини по ділильному колу
measured_pitch|P_t|P_t|mm|measured: pitch on the reference circle|виміряно: крок по ділильному колу
measured_base_thickness|S_bm|S_b|mm|measured: thickness on the base circle|виміряно: товщина зуба по основному колу
measured_tip_thickness|S_am|S_a|mm|measured: tooth thickness on the tip circle|виміряно: товщина зуба на колі вершин
measured_form_diameter|d_Fm|d_Ff|mm|measured: where the involute begins|виміряно: діаметр початку евольвенти
disk_diameter|d_disk|d_0|mm|diameter of the paper disk|діаметр паперового диска
rack_distance|a_w|a_w|mm|from the axis to the rack's datum line|від осі колеса до ділильної прямої рейки
travel_per_turn|L_1|L_1|mm|way of the rack for one turn|хід рейки за один оберт
rack_addendum|h_aR|h_a2|mm|addendum of the rack|висота головки зуба рейки
profile_shift_difference|x_diff|x_2-x_1||difference of the profile shift coefficients|різниця коефіцієнтів зміщення
involute_interference_margin|q_1|q_1|mm|no involute interference: margin|інтерференція евольвент відсутня: запас
trochoid_interference_margin|q_2|q_2|mm|no tip interference: margin|інтерференція вершин відсутня: запас
radial_assembly_margin|q_3|q_3|mm|radial assembly: margin|радіальне складання: запас
fillet_interference_margin|q_f|q_f|mm|no fillet interference: margin|інтерференція з перехідною кривою відсутня: запас
greatest_tip_diameter_pinion|d_a1max|d_a1max|mm|largest tip diameter of the pinion|найбільший діаметр вершин шестірні
least_tip_diameter_ring|d_a2min|d_a2min|mm|least tip diameter of the ring|найменший діаметр вершин вінця
least_face_width|b_min|b_min|mm|face width that the span needs|ширина вінця, потрібна для виміру нормалі
secure_face_width|b_s|b_s|mm|face width that makes the span secure|ширина вінця для певного виміру нормалі
lift|H|H|mm|lift|найбільше переміщення штовхача
swing_deg|H|Ψ|deg|swing|кут розмаху коромисла
rise_angle_deg|phi_r|φ_від|deg|cam angle of the rise|кут віддалення
far_dwell_angle_deg|phi_f|φ_д.в.|deg|cam angle of the far dwell|кут далекого відстою
return_angle_deg|phi_b|φ_наб|deg|cam angle of the return|кут наближення
near_dwell_angle_deg|phi_n|φ_б.в.|deg|cam angle of the near dwell|кут ближнього відстою
lift_of_phase|h|h|mm|lift of the phase|переміщення на фазі
swing_of_phase_deg|h|ψ|deg|swing of the phase|кут повороту на фазі
velocity_coefficient|c_v|C_v||peak velocity coefficient|коефіцієнт найбільшої швидкості
acceleration_coefficient|c_a|C_a||peak acceleration coefficient|коефіцієнт найбільшого прискорення
peak_velocity|S1|S'_max|mm/rad|peak of the velocity's analogue|найбільший аналог швидкості
peak_acceleration|S2|S''_max|mm/rad2|peak of the acceleration's analogue|найбільший аналог прискорення
follower_offset|E|E|mm|offset of the follower|ексцентриситет штовхача
least_transmission_angle_deg|gamma|γ_min|deg|least transmission angle|найменший кут передачі руху
transmission_angle_reached_deg|gamma_r|γ|deg|transmission angle reached, rise|досягнутий кут передачі при віддаленні
pressure_angle_rise_deg|nu_r|ν_від|deg|greatest pressure angle, rise|найбільший кут тиску при віддаленні
pressure_angle_return_deg|nu_b|ν_наб|deg|greatest pressure angle, return|найбільший кут тиску при наближенні
least_prime_circle_radius|r_0|r_0|mm|least prime circle radius by the condition|найменший радіус за умовою
curvature_reserve|rho|ρ|mm|least convex radius of curvature asked|заданий запас на радіус кривини профілю
least_base_circle_radius|R_min|R_min|mm|least radius of the cam (base circle)|найменший радіус кулачка
least_cam_radius|R_min|R_min|mm|least radius of the cam|найменший радіус кулачка
follower_radius|r|r|mm|radius of the roller or mushroom|радіус ролика або грибка
initial_height|s_0|s_0|mm|initial height of the follower|початкова відстань штовхача від осі
least_curvature_radius|rho_min|ρ_min|mm|least convex radius of curvature|найменший радіус кривини опуклого профілю
least_plate_diameter|D_pl|D_т|mm|least diameter of the plate|найменший діаметр тарілки штовхача
speed_rpm|n_rpm|n|rpm|speed of the cam|частота обертання кулачка
angular_speed|omega|ω|rad/s|angular speed of the cam|кутова швидкість кулачка
time_of_phase|t|t|s|time of the phase|тривалість фази
greatest_velocity|v_max|v_max|mm/s|greatest velocity of the follower|найбільша швидкість штовхача
greatest_acceleration|a_max|a_max|m/s2|greatest acceleration of the follower|найбільше прискорення штовхача
greatest_angular_velocity|v_max|ω_max|rad/s|greatest angular velocity|найбільша кутова швидкість коромисла
greatest_angular_acceleration|a_max|ε_max|rad/s2|greatest angular acceleration|найбільше кутове прискорення коромисла
graphical_intervals|n|n||intervals of each phase|кількість інтервалів фази
graphical_factor|k|k||stretch of scales by y_max, (4.2)|поправка масштабів за y_max, (4.2)
graphical_lift_error|dS|ΔS|mm|greatest error of S by the drawing|найбільша похибка побудови S
graphical_swing_error_deg|dS|Δψ|deg|greatest error of the swing by the drawing|найбільша похибка побудови кута коромисла
graphical_velocity_error|dS1|ΔS'|mm/rad|greatest error of S' by the drawing|найбільша похибка побудови S'
graphical_prime_circle_radius|r_0g|r_0g|mm|least prime circle radius by the drawing|найменший радіус за побудовою
graphical_radius_error|dr_0|Δr_0|mm|its error|похибка радіуса за побудовою
graphical_profile_error|dn|Δn|mm|greatest error of the drawn profile|найбільша похибка профілю за побудовою
""")
TERMS |= _terms(TERMS_OF_KINDS) | _terms(TERMS_OF_LINKAGES)
