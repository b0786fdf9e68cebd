"""Terms of the calculation of a cam whose follower sits on a connecting rod, in Savvin's symbols; as in ``words``."""

from __future__ import annotations

# name | key | symbol | unit | English | Ukrainian
TERMS_OF_LINKAGES = """
driven_pivot_x|x_O|x_O1|mm|pivot of the driven rocker, x|вісь ведучого коромисла, x
driven_pivot_y|y_O|y_O1|mm|pivot of the driven rocker, y|вісь ведучого коромисла, y
driven_length|l_1|l_1|mm|length of the driven rocker|довжина ведучого коромисла
driven_start_angle_deg|psi_0|ψ_0|deg|angle of the driven rocker at S = 0|кут ведучого коромисла при S = 0
driven_start_x|x_O|x_A0|mm|joint A at S = 0, x|шарнір A при S = 0, x
driven_start_y|y_O|y_A0|mm|joint A at S = 0, y|шарнір A при S = 0, y
driven_direction_deg|delta_1|δ_1|deg|direction of the driven slider|напрям ведучого повзуна
coupler_length|b|b|mm|length of the connecting rod AB|довжина шатуна AB
guide_pivot_x|x_C|x_C|mm|pivot of the guiding rocker, x|вісь напрямного коромисла, x
guide_pivot_y|y_C|y_C|mm|pivot of the guiding rocker, y|вісь напрямного коромисла, y
guide_length|c|c|mm|length of the guiding rocker CB|довжина напрямного коромисла CB
guide_through_x|x_C|x_C|mm|point of the guide's line, x|точка напрямної лінії, x
guide_through_y|y_C|y_C|mm|point of the guide's line, y|точка напрямної лінії, y
guide_direction_deg|delta|δ|deg|direction of the guide|напрям напрямної
coupler_point_x|xi_p|ξ_p|mm|follower on the rod, from A towards B|місце штовхача на шатуні, від A до B
coupler_point_y|eta_p|η_p|mm|follower on the rod, across AB|місце штовхача на шатуні, впоперек AB
follower_direction_deg|tau|τ|deg|direction of stem or face normal from AB|напрям штока або нормалі грані від AB
contact_pressure_angle_deg|nu_m|ν_max|deg|greatest pressure angle at the contact|найбільший кут тиску в точці дотику
coupler_swing_deg|theta_m|Δθ|deg|the connecting rod turns by|розмах кутів шатуна
joint_transmission_angle_deg|mu_m|μ_min|deg|least transmission angle at joint B|найменший кут передачі в шарнірі B
greatest_sliding_velocity|v_m|v_max|mm/rad|greatest sliding velocity|найбільша швидкість ковзання
face_from|e_1|e_1|mm|contact on the face, from|точка дотику на грані, від
face_to|e_2|e_2|mm|contact on the face, to|точка дотику на грані, до
greatest_cam_radius|R_max|R_max|mm|greatest radius of the cam|найбільший радіус кулачка
position_deg|alpha_1|α_1|deg|cam angle of the position|кут повороту кулачка в цьому положенні
position_lift|S|S|mm|motion of the driven slider|переміщення ведучого повзуна
position_swing_deg|S|S|deg|motion of the driven rocker|кут повороту ведучого коромисла
position_velocity|S1|S'|mm/rad|its velocity's analogue|аналог швидкості ведучого повзуна
position_acceleration|S2|S''|mm/rad2|its acceleration's analogue|аналог прискорення ведучого повзуна
position_angular_velocity|S1|S'||its velocity's analogue, rad/rad|аналог кутової швидкості коромисла, рад/рад
position_angular_acceleration|S2|S''||its acceleration's analogue, rad/rad2|аналог кутового прискорення, рад/рад²
driven_angle_deg|psi|ψ|deg|angle of the driven rocker|кут ведучого коромисла
joint_a_x|x_A|x_A|mm|joint A, x|шарнір A, x
joint_a_y|y_A|y_A|mm|joint A, y|шарнір A, y
joint_a_x1|x_A1|x_A'|mm/rad|velocity of A, x|аналог швидкості A, x
joint_a_y1|y_A1|y_A'|mm/rad|velocity of A, y|аналог швидкості A, y
joint_a_x2|x_A2|x_A''|mm/rad2|acceleration of A, x|аналог прискорення A, x
joint_a_y2|y_A2|y_A''|mm/rad2|acceleration of A, y|аналог прискорення A, y
guide_distance|q|q|mm|from A to the pivot C|відстань від A до осі C
guide_line_angle_deg|chi|χ|deg|direction of AC|напрям AC
rod_angle_deg|beta|β|deg|angle BAC, law of cosines|кут BAC за теоремою косинусів
guide_height|h|h|mm|A to the left of the guide's line|відстань A вліво від напрямної лінії
rod_lean_deg|lam|λ|deg|lean of the rod to the guide|нахил шатуна до напрямної
coupler_angle_deg|theta|θ|deg|angle of the connecting rod AB|кут шатуна AB
transmission_angle_deg|mu|μ|deg|transmission angle at joint B|кут передачі в шарнірі B
joint_b_x|x_B|x_B|mm|joint B, x|шарнір B, x
joint_b_y|y_B|y_B|mm|joint B, y|шарнір B, y
coupler_velocity|omega_2|ω_2||turning of the rod, rad/rad|аналог кутової швидкості шатуна, рад/рад
joint_b_x1|x_B1|x_B'|mm/rad|velocity of B, x|аналог швидкості B, x
joint_b_y1|y_B1|y_B'|mm/rad|velocity of B, y|аналог швидкості B, y
coupler_acceleration|eps_2|ε_2||change of that turning, rad/rad2|аналог кутового прискорення шатуна, рад/рад²
reference_x|x_02|x_02|mm|reference point of the follower, x|початок O_2 системи штовхача, x
reference_y|y_02|y_02|mm|reference point of the follower, y|початок O_2 системи штовхача, y
reference_x1|x_021|x_02'|mm/rad|velocity of that point, x|аналог швидкості O_2, x
reference_y1|y_021|y_02'|mm/rad|velocity of that point, y|аналог швидкості O_2, y
reference_x2|x_022|x_02''|mm/rad2|acceleration of that point, x|аналог прискорення O_2, x
reference_y2|y_022|y_02''|mm/rad2|acceleration of that point, y|аналог прискорення O_2, y
follower_angle_deg|alpha_2|α_2|deg|angle of the follower's axes|кут нахилу системи штовхача
relative_turning|W|Ω||turning against the cam: omega_2 - omega_1|відносна кутова швидкість ω_2 - ω_1, ω_1 = 1
savvin_a|A|A|mm|O_2 in the cam's frame, x|O_2 у системі кулачка, x
savvin_b|B|B|mm|O_2 in the cam's frame, y|O_2 у системі кулачка, y
savvin_a1|A1|A'|mm/rad|its derivative|похідна від A
savvin_b1|B1|B'|mm/rad|its derivative|похідна від B
savvin_a2|A2|A''|mm/rad2|its second derivative|друга похідна від A
savvin_b2|B2|B''|mm/rad2|its second derivative|друга похідна від B
savvin_f|F|F_ω|mm/rad|F times the relative turning|F, помножене на відносну кутову швидкість
savvin_r|R|R_ω|mm/rad|R times the relative turning|R, помножене на відносну кутову швидкість
path_speed|w|w|mm/rad|velocity of O_2 against the cam|аналог швидкості O_2 відносно кулачка
contact_x2|xi_2|ξ_2|mm|contact in the follower's frame, x|точка дотику в системі штовхача, ξ
contact_y2|eta_2|η_2|mm|contact in the follower's frame, y|точка дотику в системі штовхача, η
contact_x1|xi_1|ξ_1|mm|profile of the cam, x|координата профілю кулачка ξ
contact_y1|eta_1|η_1|mm|profile of the cam, y|координата профілю кулачка η
relative_x1|xi_21|ξ_21'|mm/rad|velocity against the cam at the contact, x|відносна швидкість у точці дотику, ξ
relative_y1|eta_21|η_21'|mm/rad|velocity against the cam at the contact, y|відносна швидкість у точці дотику, η
sliding_velocity|v_s|v_s|mm/rad|sliding velocity|аналог швидкості ковзання
rolling_velocity|v_s|v_k|mm/rad|velocity at which the roller rolls on the cam|аналог швидкості кочення ролика
contact_velocity_x|x_t1|x_A2'|mm/rad|velocity of the follower at the contact, x|швидкість точки дотику штовхача, x
contact_velocity_y|y_t1|y_A2'|mm/rad|velocity of the follower at the contact, y|швидкість точки дотику штовхача, y
velocity_angle_deg|gamma_2|γ_2|deg|direction of that velocity|кут нахилу вектора швидкості
frame_normal_angle_deg|gamma_11|γ_11|deg|direction of the normal in the cam's frame|кут нахилу нормалі в системі кулачка
normal_angle_deg|gamma_1|γ_1|deg|direction of the normal|кут нахилу нормалі до профілю
position_contact_pressure_angle_deg|nu_c|ν|deg|pressure angle at the contact, acute|гострий кут тиску в точці дотику
centre_velocity_angle_deg|gamma_0|γ_0|deg|direction of the velocity of O_2|кут нахилу швидкості точки O_2
position_pressure_angle_deg|nu_0|ν_0|deg|pressure angle at the centre O_2|кут тиску в центрі O_2
position_curvature_radius|rho_1|ρ|mm|radius of curvature of the cam, convex above 0|радіус кривини профілю, опуклий > 0
"""
