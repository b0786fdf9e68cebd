"""Terms of the calculations of other cams, of round pins and of noncircular gears; one a line as in ``words``."""

from __future__ import annotations

# name | key | symbol | unit | English | Ukrainian
TERMS_OF_KINDS = """
rise_travel|l_r|l_від|mm|travel of the rise|хід плити при віддаленні
far_dwell_travel|l_f|l_д.в.|mm|travel of the far dwell|хід плити при далекому відстої
return_travel|l_b|l_наб|mm|travel of the return|хід плити при наближенні
near_dwell_travel|l_n|l_б.в.|mm|travel of the near dwell|хід плити при ближньому відстої
peak_slope|S1|S'_max||peak of S' over the travel|найбільше S' за ходом плити
peak_bend|S2|S''_max|1/mm|peak of S'' over the travel|найбільше S'' за ходом плити
whole_travel|L|L|mm|whole travel of the plate|повний хід плити
base_height|h_0|h_0|mm|height of the plate under the follower at S = 0|висота плити під штовхачем при S = 0
plate_velocity|c|c|mm/s|velocity of the plate|швидкість плити
arm_length|l_arm|L|mm|length of the arm|довжина коромисла
centre_distance|d|d|mm|from the axis of the cam to the pivot|відстань від осі кулачка до осі коромисла
start_angle_deg|psi_0|ψ_0|deg|angle of the arm at S = 0|початковий кут коромисла
clearance|c_r|c|mm|play of the roller in its groove|зазор між роликом і пазом
groove_width|b|b|mm|width of the groove|ширина паза
groove_depth|t|t|mm|depth of the groove|глибина паза
outer_wall_radius|R_out|R_out|mm|greatest radius of the outer wall|найбільший радіус зовнішньої стінки
least_path_radius|R_1|R_1|mm|least distance of the roller's centre from the axis|найменша відстань центра ролика від осі
greatest_path_radius|R_2|R_2|mm|greatest distance of the roller from the axis|найбільша відстань центра ролика від осі
least_hollow_radius|rho_h|ρ_вг|mm|least hollow radius of the roller's path|найменший радіус вгнутої дуги центра ролика
least_radius_both_ways|r_0|r_0|mm|least radius by the condition, both ways|найменший радіус за умовою в обидва боки
outer_diameter|D|D|mm|outer diameter|зовнішній діаметр
floor_diameter|D_f|D_дна|mm|diameter of the groove's floor|діаметр дна паза
barrel_length|L|L|mm|length of the barrel|довжина барабана
roller_diameter|d|d|mm|diameter of the roller|діаметр ролика
largest_roller_diameter|d_lim|d_гр|mm|largest roller that undercuts no wall|найбільший ролик без підрізу стінок
roller_height|z_0|z_0|mm|height of the roller's axis at S = 0|висота осі ролика при S = 0
pivot_height|z_p|z_п|mm|height of the arm's pivot|висота осі коромисла
pivot_offset|y_p|y_п|mm|from the cam's axis to the pivot|відстань від осі кулачка до осі коромисла
outer_pressure_angle_rise_deg|nu_m|ν_від|deg|greatest angle at the outside, rise|кут тиску зовні, віддалення
outer_pressure_angle_return_deg|nu_n|ν_наб|deg|greatest angle at the outside, return|кут тиску зовні, наближення
roller_distance|a_r|a|mm|distance of both rollers' centres|відстань між центрами роликів
roller_angle_deg|a_r|θ|deg|angle between both arms|кут між плечима коромисла
second_follower_radius|r_2|r_2|mm|radius of the second roller|радіус другого ролика
second_least_radius|R_min2|R_min2|mm|least radius of the second disk|найменший радіус другого диска
second_pressure_angle_deg|nu_2|ν_2|deg|greatest pressure angle of the second roller|найбільший кут тиску другого ролика
second_curvature_radius|rho_2|ρ_min2|mm|least convex radius of the second disk|найменший радіус опуклості другого диска
breadth|B|B|mm|breadth of the cam, the same at every angle|ширина кулачка, однакова за будь-якого кута
breadth_error|dB|ΔB|mm|departure of S(phi) + S(phi + 180) from H|відхилення S(φ) + S(φ + 180°) від H
yoke_play|c_y|c|mm|play of the cam in the yoke|зазор кулачка в рамці
yoke_opening|B_y|B_р|mm|between the faces or the rollers' centres of the yoke|між гранями або центрами роликів рамки
yoke_middle|h_y|h_р|mm|middle of the yoke over the axis at S = 0|середина рамки над віссю при S = 0
window_width|w_y|w_р|mm|width of the yoke's window|ширина вікна рамки
number_of_lobes|z|z_1||lobes of the disc|число виступів диска
number_of_pins|N|N||number of pins|число цівок
pin_circle_radius|R|R|mm|radius of the pins' circle|радіус кола центрів цівок
pin_radius|r_p|r_ц|mm|radius of a pin|радіус цівки
eccentricity|e|e|mm|eccentricity|ексцентриситет
pin_clearance|c_p|c|mm|clearance between flank and pin, normal|зазор між профілем і цівкою по нормалі
pin_circle_shift|dR|ΔR|mm|the generating pin circle is smaller by|зменшення твірного кола цівок
generating_radius|R_g|R_т|mm|radius of the generating circle of pins|радіус твірного кола центрів цівок
generating_pin_radius|rho|ρ|mm|radius of the generating pin|радіус твірної цівки
reduction|i|i||ratio of eccentric to disc, the pins held|передаточне відношення від ексцентрика до диска
reduction_of_pins|i_n|i_N||ratio to the pins if the disc cannot turn|передаточне відношення до кола цівок
shortening_coefficient|lam|λ||shortening coefficient|коефіцієнт укорочення епіциклоїди
greatest_shortening|lam_max|λ_max||greatest shortening without undercut|найбільший коефіцієнт укорочення без підрізу
greatest_eccentricity|e_max|e_max|mm|greatest eccentricity without undercut|найбільший ексцентриситет без підрізу
disc_centrode_radius|r_1|r_1|mm|centrode of the disc|радіус центроїди диска
pin_centrode_radius|r_2|r_2|mm|centrode of the pins|радіус центроїди кола цівок
cycloidal_tip_radius|R_a|R_a|mm|radius of the lobes' tops|радіус вершин виступів
cycloidal_root_radius|R_f|R_f|mm|radius of the valleys' bottoms|радіус западин
lobe_height|h|h|mm|height of the lobes|висота виступів
least_path_curvature_radius|rho_0|ρ_0|mm|least convex radius of a pin centre's path|найменший радіус шляху центра цівки
least_profile_radius|rho_min|ρ_min|mm|least convex radius of the profile|найменший радіус кривини опуклого профілю
least_disc_pressure_angle_deg|alpha_min|α_min|deg|least pressure angle of a pin|найменший кут тиску цівки
best_pin_angle_deg|psi_b|ψ_α|deg|angle of that pin from the eccentric|кут цієї цівки від ексцентрика
greatest_force_arm|l_max|l_max|mm|greatest arm of a pin's normal about the disc's axis|найбільше плече нормалі цівки
greatest_arm_angle_deg|psi_l|ψ_l|deg|angle of that pin from the eccentric|кут цівки з найбільшим плечем
driving_pins|n_d|n||pins that can drive in one sense, at most|найбільше число цівок, що передають зусилля
output_hole_diameter|d_h|d_отв|mm|holes of the output pins|діаметр отворів вихідних пальців
output_pin_diameter|d_o|d_п|mm|output pins|діаметр вихідних пальців
output_hole_clearance|c_o|c_п|mm|clearance of a hole beyond pin and 2 e|зазор отвору понад палець і 2 e
lantern_pitch_radius|r_2|r_2|mm|pitch radius of the lantern: its circle of pins|радіус початкового кола цівкового колеса
lantern_gear_pitch_radius|r_1|r_1|mm|pitch radius of the gear|радіус початкового кола зубчастого колеса
lantern_pitch|p|p|mm|pitch on both pitch circles|крок по початкових колах
epicycloid_order|m_e|m||turning of the generating circle over that of the gear|відношення кутів при твірній епіциклоїді
root_arc_radius|rho_f|ρ_f|mm|radius of the roots' arcs|радіус дуг западин
root_clearance|c_f|c_f|mm|clearance between a pin and the root|зазор між цівкою і западиною
flank_start_radius|R_s|R_п|mm|radius at which the flank begins|радіус початку бічного профілю
pointed_radius|R_p|R_з|mm|radius at which the tooth is pointed|радіус загострення зуба
neck_width|s_n|s_ш|mm|tooth between its root arcs on the pitch circle|ширина зуба між дугами западин
flank_start_angle_deg|u_1|u_1|deg|gear's angle at which the flank begins|кут колеса на початку профілю
flank_end_angle_deg|u_2|u_2|deg|gear's angle at which the flank ends|кут колеса в кінці профілю
pitch_angle_deg|tau|τ|deg|angular pitch of the gear|кутовий крок колеса
lantern_contact_ratio|eps|ε||contact ratio of one flank|коефіцієнт перекриття одного профілю
end_pressure_angle_deg|alpha_max|α_max|deg|pressure angle at the end of contact|найбільший кут тиску в кінці зачеплення
greatest_pin_radius|r_lim|r_гр|mm|half of the distance of neighbouring pins|половина відстані між сусідніми цівками
gear_teeth|z_1|z_1||teeth of this gear, driver|число зубців ведучого колеса
mate_teeth|z_2|z_2||teeth of its mate|число зубців веденого колеса
centrode_parameter|p_c|p_e|mm|parameter of the centrode r = p/(1 - e cos n phi)|параметр центроїди r = p/(1 - e cos nφ)
centrode_eccentricity|e_c|e||eccentricity of the centrode|ексцентриситет центроїди
centrode_lobes|n_c|n||lobes of the driver's centrode|число хвиль центроїди ведучого
mate_lobes|n_2|n_2||lobes of the mate's centrode|число хвиль центроїди веденого
greatest_convex_eccentricity|e_max|e_max||greatest eccentricity of a convex centrode|найбільше e опуклої центроїди
perimeter|P|P|mm|perimeter of this gear's centrode|периметр центроїди колеса
mate_perimeter|P_2|P_2|mm|perimeter of the mate's centrode|периметр центроїди веденого колеса
centrode_pitch|p|p|mm|pitch along the centrode|крок по центроїді
least_centrode_radius|r_min|r_min|mm|least radius of the driver's centrode|найменший радіус центроїди ведучого
greatest_centrode_radius|r_max|r_max|mm|greatest radius of the driver's centrode|найбільший радіус центроїди ведучого
noncircular_distance|a|a|mm|centre distance|міжосьова відстань
least_ratio|i_min|i_min||least ratio d phi_2 / d phi_1|найменше передаточне відношення dφ_2/dφ_1
greatest_ratio|i_max|i_max||greatest ratio d phi_2 / d phi_1|найбільше передаточне відношення dφ_2/dφ_1
mean_ratio|i_m|i_ср||ratio of whole turns|середнє передаточне відношення
mate_turns|Phi_2|Φ_2|deg|turn of the mate for one of the driver|кут повороту веденого за оберт ведучого
closure_error_deg|dPhi|ΔΦ|deg|departure from the whole number of lobes|відхилення від замикання
least_centrode_bend|rho_c|ρ_min|mm|least radius of curvature of this centrode|найменший радіус кривини центроїди
greatest_centrode_bend|rho_g|ρ_max|mm|greatest radius of curvature of it|найбільший радіус кривини центроїди
equivalent_teeth|z_e|z_екв||teeth of a round gear as much curved|число зубців еквівалентного колеса
least_equivalent_teeth|z_min|z_min||least teeth of it without undercut|найменше z без підрізу за цього x
undercut_sides|n_u|n_підр||undercut tooth sides of a lobe|підрізаних сторін зубців на хвилю
least_tip_land|S_a|S_a|mm|least tip land|найменша товщина зуба на вершині
tip_height|h_tip|h_a|mm|height of the tips over the centrode|висота головки зуба над центроїдою
root_depth|h_root|h_f|mm|depth of the roots below the centrode|висота ніжки зуба під центроїдою
noncircular_contact_ratio|eps|ε||least contact ratio of the pair|найменший коефіцієнт перекриття пари
"""
