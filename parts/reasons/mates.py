"""Why a scene is refused: mates."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "axes_would_be_parallel": N_(
        "the axes would be parallel: the shaft angle is the sum of both helix angles of one hand, or the difference "
        "of those of opposite hands; external_gear_pair joins gears on parallel axes"
    ),
    "backlash_already_more": N_(
        "is less than the backlash that the gears already have by their own thinning and distance"
    ),
    "backlash_is_of_own_thinning": N_(
        "both gears have a circumferential_thinning of their own, by which it is {own} mm"
    ),
    "backlash_leaves_no_teeth": N_("leaves no whole teeth"),
    "cam_has_another": N_("must be what the cam is made for"),
    "cam_wants": N_("the cam is made for a {wanted}"),
    "contact_over_bar": N_("the contact runs over the bar's end"),
    "contact_over_plate": N_("the contact runs over the plate's edge"),
    "eccentric_needs_round_bore": N_("the disc needs a round bore for the eccentric"),
    "face_gear_beside": N_("the pinion would stand beside the teeth of the face gear"),
    "fewer_seats": N_("is more than the number of seats"),
    "has_its_pins": N_("has its pins already; give it seats or holes"),
    "linkage_carries_follower": N_("the linkage carries the follower, which is no arm"),
    "linkage_has_another": N_("must be that of the linkage"),
    "made_for_another_wheel": N_("is made for another wheel than the mate's second; name that one"),
    "made_from_another_cam": N_("is made from another cam than the mate's first; name that one"),
    "mate_is_straight": N_("must be 0: the mate's teeth are straight, and straight teeth mesh only with straight ones"),
    "mate_joins": N_("is a {found}; {mate} joins {joins}"),
    "mate_joins_other": N_('is a {found}; {mate} joins {joins}; kind = "{other}" joins these two'),
    "member_is_a_slider": N_("this member is a slider; a plate can be one, an arm cannot"),
    "no_common_normal": N_("at this angle flanks of these helices have no common normal"),
    "no_herringbone_on_crossed_axes": N_("double helical teeth mesh on parallel axes only"),
    "no_output_holes": N_("has no output_holes; add that table to the disc"),
    "mesh_parts": N_(
        "no instance carries its axis and that of {first}; join a satellite to its carrier by a mate of kind carried"
    ),
    "not_between_the_plates": N_("does not go between the plates of the lantern"),
    "not_of_its_mate": N_("must fit its mate"),
    "not_of_the_eccentric": N_("must be that of the eccentric"),
    "not_of_the_holes": N_("must be that of the disc's holes"),
    "not_of_the_lantern": N_("must be that of the lantern"),
    "not_of_the_pair": N_("is not of the first gear's pair"),
    "not_of_the_pair_at_all": N_(
        "is not of the same pair: centrode, its shape, module and numbers of teeth must be the first one's, {pair}"
    ),
    "not_of_the_ring": N_("must be that of the ring"),
    "not_of_the_seats": N_("must be that of the seats"),
    "one_lobe_fewer_than_pins": N_("must be one less than the number of pins, {pins}"),
    "one_role_does_not_mesh": N_(
        "two gears of one role mesh only where a tooth on the long radius meets a space on the short one"
    ),
    "one_role_meshes_with_teeth": N_(
        "two gears of one role mesh only where a tooth on the long radius meets a space on the short one, "
        "as with {teeth} teeth"
    ),
    "other_centrode_shape": N_("the centrodes differ in shape (axis_ratio or eccentricity)"),
    "place_on_carrier": N_("is missing; give the place on the carrier, or put this mate after those that place it"),
    "plate_slides_less": N_("is more than the whole travel of the plate"),
    "shortened_tips_keep_no_involute": N_("tips shortened for this pair keep no involute"),
    "teeth_do_not_reach": N_("the teeth do not reach each other"),
}
