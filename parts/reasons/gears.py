"""Why a scene is refused: gears, rings and racks."""

from __future__ import annotations

from parts.base.texts import N_, counted

# fmt: off
REASONS = {
    "above_nominal": N_("is more than the nominal one"),
    "below_nominal": N_("is less than the nominal one"),
    "chamfer_misses_flank": N_("does not reach the flank"),
    "chamfers_overlap": N_("both chamfers of a tooth would overlap"),
    "circle_all_but_straight": N_("is more than 500 pitch diameters: a line would roll as it does"),
    "classes_end_at_distance": N_(
        "the classes end at a centre distance of {distance} mm; give normal_backlash instead"
    ),
    "closes_tooth_spaces": N_("closes the tooth spaces"),
    "cutter_involute_ends_below_tip": N_("the cutter's involute ends at its base circle, below the gear's tips"),
    "cutter_involute_interference": N_("the cutter's teeth begin above the ring's tips, which it would trim"),
    "cutter_radial_assembly": N_("the cutter cannot be fed in radially without trimming the ring's tips"),
    "cutter_rounding_does_not_fit": N_("the rounding of the tip does not fit the cutter's tooth"),
    "cutter_tip_below_base": N_("the cutter's tip circle lies below its base circle"),
    "cutter_tooth_pointed": N_("the cutter's tooth is pointed below its tip circle"),
    "cutter_trochoid_interference": N_("the cutter's tips would trim the ring's on their way out"),
    "double_helical_without_angle": N_("needs helix_angle_deg above 0"),
    "fillets_meet": N_("the fillets of both sides meet inside the tooth"),
    "flanks_do_not_reach": N_("the flanks do not reach each other: there is no active line"),
    "flanks_meet_below_form": N_("the flanks meet below the root form circle"),
    "hands_not_opposite": N_("must be opposite to the hand of its mate"),
    "hole_as_high_as_body": N_("must be less than the height of the body"),
    "holes_reach_bottom": N_("the holes reach the bottom"),
    "holes_reach_ends": N_("the holes reach the ends"),
    "holes_reach_root_line": N_("the holes reach the root line"),
    "inside_base_circle": N_("there is no involute inside the base circle"),
    "involute_ends_at_base_circle": N_("the involute ends at the base circle"),
    "leaves_no_body": N_("leaves no body"),
    "leaves_no_flank": N_("leaves no flank"),
    "leaves_no_tooth": N_("leaves no tooth"),
    "made_by_cutter": N_("must be left out: the cutter makes the root, by its own addendum and tip rounding"),
    "mates_root_flanks_undercut": N_(
        "is more than half the mate's pitch diameter: the mate's root flanks would be undercut"
    ),
    "no_chamfer_on_helix": N_("is not for helical teeth"),
    "no_holes_in_helical_rack": N_("helical racks have none; remove holes"),
    "no_involute_below_tip": N_("no part of the involute is left below the tip circle"),
    "no_pin_touches_there": N_("no pin touches the flanks of this space at that diameter"),
    "no_recommendation": N_("has no recommended shift in the table"),
    "no_recommendation_with": N_("has no recommended shift in the table beside {first}"),
    "no_relief_by_cutter": N_("must be 0: a pinion cutter cuts no tip relief"),
    "no_span_of_helical_ring": N_(
        "a helical ring has no span, since no plane faces find its flanks; measure between balls"
    ),
    "no_such_cutter_teeth": N_("is more than pinion cutters have; a rack takes the place of larger ones"),
    "no_working_angle": N_("no working pressure angle exists"),
    "no_working_angle_with_cutter": N_("no pressure angle with the cutter exists"),
    "no_working_angle_with_first": N_("no working pressure angle with the first gear: inv(alpha_w) = {involute} < 0"),
    "no_working_angle_with_pinion": N_("no working pressure angle with the pinion: inv(alpha_w) = {involute} < 0"),
    "not_above_pinion_teeth": N_("must be more than the pinion has"),
    "not_below_ring_teeth": N_("the cutter must have fewer teeth than the ring"),
    "not_between_root_and_tip": N_("must be between root and tip circle"),
    "not_hand_of_pinion": N_("must be the hand of its pinion"),
    "not_in_table": N_("{pair} is not in table {table}; the nearest pair there is {known}"),
    "not_the_mates_root_circle": N_("must be the mate's root_rolling_diameter"),
    "not_the_mates_tip_circle": N_("must be the mate's tip_rolling_diameter"),
    "not_that_of_first": N_("must be that of the first gear of the pair"),
    "not_that_of_gear": N_("must be that of the gear"),
    "not_that_of_mate": N_("must be that of its mate"),
    "not_that_of_pinion": N_("must be that of the pinion"),
    "one_double_helix": N_("a double helical gear meshes with another one only"),
    "passes_base_circle_at_tips": N_("brings the ring's tips past the base circle"),
    "pin_beyond_base_circle": N_("does not go into the space: its centre does not come to the base circle"),
    "pin_falls_through": N_("is too small: the pin falls between the flanks"),
    "rack_pointed": N_("the rack tooth is pointed at {angle} degrees before it reaches its tip line"),
    "rack_rounding_does_not_fit": N_("does not fit the rack tooth; the largest is the full round"),
    "rack_tooth_pointed": N_("the tooth is pointed below its tip line"),
    "reaches_root_circle": N_("reaches the root circle, {diameter} mm"),
    "relief_beyond_addendum": N_("must be above 0 and at most {addendum}, the addendum"),
    "relief_leaves_no_flank": N_("the relief leaves no main flank"),
    "relieved_flanks_meet": N_("the relieved flanks of the rack meet below its tip line ({customary} is customary)"),
    "ring_flanks_meet_at_root": N_("the flanks of a ring tooth meet at its root"),
    "ring_tooth_pointed": N_("the ring's tooth is pointed"),
    "root_flanks_undercut": N_("is more than half the pitch diameter: the root flanks would be undercut"),
    "root_reaches_axis": N_("the roots reach the axis"),
    "roots_have_no_room": N_("the roots have no room: they reach the axis, the end of their flanks, or each other"),
    "rounding_does_not_fit": N_("does not fit between flank and tip land"),
    "space_rounding_does_not_fit": N_("does not fit the space"),
    "span_beyond_teeth": N_("must be from 1 to {teeth}, the number of teeth"),
    "standard_rack_pointed": N_("the tooth of rack {profile} is pointed before it reaches its tip line"),
    "step_above_half_pitch": N_("shows no profile: it is more than half of the pitch"),
    "tables_take_smaller_first": N_(
        "must not be more than the teeth of the second gear, since the tables take the smaller gear first"
    ),
    "teeth_overlap": N_("the teeth would overlap"),
    "thinning_leaves_no_tip": N_("leaves no tip"),
    "too_many_positions": N_("gives more positions than a sheet can show"),
    "tooth_pointed": N_("the tooth is pointed at a diameter of {diameter} mm"),
    "turns_fillets_back": N_("bends the elliptic fillets back on themselves"),
    "above_most_teeth": N_("is above most_teeth"),
    "driver_is_held": N_("is held and cannot be the driver"),
    "frame_holds_the_ring": N_("is only for a set whose ring is held: the frame is fixed to it"),
    "frame_needs_ring_and_sun": N_("is only for a set with a sun and a ring, which the frame holds"),
    "no_planetary_set": N_("no set within these limits has that ratio"),
    "no_shifts_fit": N_(

            "no shifts up to 1 bring both meshes, which need {first} and {second} mm, to one centre distance "
            "with all conditions kept; see `higherpair calc planetary`, or give shifts"

    ),
    "one_rim_one_module": N_("satellites with one rim have one module"),
    "one_shift_a_wheel": N_("must have one shift for each of the {wheels} wheels"),
    "ratio_not_zero": N_(
        "must not be 0: it is the ratio from driver to driven, below 0 where they turn in opposite senses"
    ),
    "ring_not_above_rim": N_("the ring of {ring} teeth must have more than its satellite, {rim}"),
    "satellites_collide": N_("the tips of neighbours would overlap"),
    "satellites_do_not_divide": counted(
        "satellites fit at {places} place, which this number does not divide",
        "satellites fit at {places} places, which this number does not divide",
        by="places",
    ),
    "satellites_not_assembled": counted(
        'satellites fit at {places} place, which this number does not divide: teeth {teeth} take so many, '
        'or spacing = "unequal" at {spacing} degrees',
        'satellites fit at {places} places, which this number does not divide: teeth {teeth} take so many, '
        'or spacing = "unequal" at {spacing} degrees',
        by="places",
    ),
    "satellites_take_other_teeth": counted(
        "satellites fit at {places} place, which this number does not divide: teeth {teeth} take so many",
        "satellites fit at {places} places, which this number does not divide: teeth {teeth} take so many",
        by="places",
    ),
    "shifts_leave_no_angle": N_("leave a mesh without a working pressure angle"),
    "shifts_not_coaxial": N_(
        "give the meshes two centre distances, {first} and {second} mm: give working_centre_distance, or other "
        "shifts"
    ),
    "too_few_places": counted(
        "there is {places} place for one and the same satellite",
        "there are {places} places for one and the same satellite",
        by="places",
    ),
    "transmits_nothing": N_("wheels 1 and 3 turn alike: the carrier transmits nothing"),
    "worm_flank_above_reference": N_("the flanks begin above the reference cylinder; take fewer starts or more q"),
    "worm_fillet_too_large": N_(
        "the fillet at the root has no room between two threads, or reaches the middle of the flank"
    ),
    "worm_flank_above_root": N_("the flanks begin above the root, and not radially; take fewer starts or more q"),
    "worm_wheel_missing": N_("is missing: {key} is given, which belongs to a worm drive with its wheel"),
    "worm_pointed": N_("the thread is pointed below its tip"),
    "worm_rounding_too_large": N_("the rounding has no room on the tip of the thread"),
    "hob_pointed": N_("the hob's thread is pointed before it reaches the root of the wheel"),
    "hob_rounding_too_large": N_("the roundings of the hob's tip leave no land between them"),
    "hob_smaller_than_worm": N_("must not be less than the worm's, which would not fit into the teeth of its wheel"),
    "within_throat": N_("the throat, {diameter} mm, lies outside of outer_diameter"),
    "worm_wheel_not_moved": N_("is not for a worm wheel: thin its teeth by axial_thinning"),
    "worm_wheel_faces_break": N_("the hob's tip breaks the faces of the teeth: a narrower rim or fewer starts"),
    "worm_wheel_all_fillet": N_("the fillet of the hob's tip reaches the tip of the teeth at the ends of the face"),
    "worm_wheel_below_base": N_(
        "the teeth reach below the base circle of the worm's involute, where its flank is radial: "
        "more q or fewer starts"
    ),
    "worm_wheel_flank_ends": N_("the worm leaves no flank up to the tip of the teeth at the ends of the face"),
    "worm_wheel_not_reached": N_("the hob does not reach the rim at the ends of the face: it leaves no space there"),
    "worm_wheel_pointed": N_("the teeth are pointed at the ends of the face"),
    "worm_wheel_undercut": N_("undercut leaves no flank at the ends of the face"),
    "bevel_below_crown": N_("the root lies deeper than the flanks of the crown gear that cuts it can reach"),
    "bevel_cutter_without_arc": N_("is for teeth along an arc: spiral_angle_deg (0 is zerol), tooth_line = arc"),
    "bevel_line_too_steep": N_("the tooth line leans by {angle} degrees at an end of the face, more than {most}"),
    "bevel_crown_pointed": N_("the tooth of the crown gear that cuts it is pointed before it reaches the root"),
    "bevel_face_to_apex": N_("reaches the apex of the cones: the outer cone distance is {distance} mm"),
    "bevel_hub_half_told": N_("a hub needs its diameter and its length, or mounting_distance"),
    "bevel_hub_over_rim": N_("the hub is wider than the rim where it begins, {rim} mm"),
    "bevel_mounted_in_teeth": N_("the back face would lie within the teeth: they end {least} mm from the apex"),
    "bevel_no_root": N_("the root cone would reach the axis: more teeth"),
    "bevel_not_moved": N_("is not for a bevel gear, whose flanks would leave the apex: thin its teeth"),
    "bevel_pointed": N_("the tooth is pointed below its tip cone"),
    "bevel_rim_over_axis": N_("the back cone would run into the axis"),
    "bevel_rounding_too_large": N_("does not fit on the tip of the crown gear's teeth"),
    "bevel_shift_leaves_no_tooth": N_("leaves no addendum or no dedendum"),
    "bevel_tips_run_out": N_("the tip cone, parallel to the root cone of the mate, leaves no flank at the inner end"),
    "bevel_too_flat": N_("the tip cone would be wider than {most} degrees from the axis: a face gear"),
    "face_gear_below_base": N_(
        "below {diameter} mm tips would reach below the base circle of the shaper, where it has no flank"
    ),
    "face_gear_narrow": N_("leaves the teeth no width: they begin at {diameter} mm"),
    "face_gear_no_flank": N_("below {diameter} mm fillets would reach the tips: the shaper leaves no flank there"),
    "face_gear_no_width": N_(
        "leaves the teeth no width: they would begin at {inner} mm, and are pointed from {outer} mm on"
    ),
    "face_gear_no_tip": N_("the tips would stand above the shaper's base circle wherever they are"),
    "face_gear_not_moved": N_("is not for a face gear, whose flanks would be conjugate no more: thin its teeth"),
    "face_gear_pointed": N_("the teeth are pointed from {diameter} mm on"),
    "face_gear_pointed_inside": N_("leaves the teeth no width: they are pointed from {diameter} mm on"),
    "face_gear_undercut": N_("below {diameter} mm the shaper's tip cuts the flanks off: undercut"),
    "worm_not_moved": N_(
        "is not for a worm, which would lose the form of its flanks: thin the thread by axial_thinning"
    ),
    "worm_root_under_axis": N_("leaves no core: the spaces of the thread reach the axis"),
    "worm_run_out_in_wheel": N_("the teeth of the wheel run into the worm where its tool leaves"),
    "worm_shaft_in_wheel": N_("the teeth of the wheel run into this step of the shaft"),
    "worm_shaft_over_root": N_(
        "is thicker than the root of the thread, {root} mm, which would end in it; thread_ends = 'run_out' lets the "
        "tool leave into a shaft of any diameter"
    ),
    "worm_spaces_closed": N_("the spaces between the threads close above the root; take more q or fewer starts"),
    "only_of_thread_ends": N_("is for thread_ends = '{ends}'"),
    "worm_step_groove": N_("would be a groove before the next step of the shaft, which is thicker than what it leaves"),
    "worm_thread_too_short": N_("leaves no whole thread between its ends"),
    "wheels_of_scheme": N_("this scheme has {wheels} wheels, in the order z1, z2, (z2',) z3"),
}
# fmt: on
