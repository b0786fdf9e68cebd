"""Why a scene is refused: round pins, cycloidal discs and lanterns."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "bore_axis_leaves_disc": N_("the bore's axis leaves the disc"),
    "bore_reaches_output_holes": N_("reaches the output holes"),
    "bore_reaches_pins": N_("reaches the pins"),
    "bore_reaches_relief": N_("reaches the disc's reliefs"),
    "closes_ring": N_("closes the ring"),
    "closes_ring_between_pins": N_("closes the ring between its pins"),
    "closes_seats": N_("closes the seats of the pins"),
    "closes_valleys": N_("closes the valleys"),
    "fixed_pins_have_no_seats": N_("pins of one piece have no seats"),
    "flank_begins_at": N_("the flank begins at {diameter} mm"),
    "holes_reach_pins": N_("the holes reach the pins"),
    "inside_beyond_pins": N_("lies beyond the pins"),
    "inside_buries_pins": N_("buries the pins"),
    "inside_reaches_pin_holes": N_("reaches the holes of the pins"),
    "leaves_no_arcs": N_("leaves no locking arcs"),
    "leaves_no_disc": N_("leaves no disc"),
    "holes_reach_slots": N_("the holes reach the slots"),
    "leaves_no_dwell": N_("leaves no dwell between two pins"),
    "leaves_no_hole": N_("leaves no hole"),
    "leaves_no_lobes": N_("leaves no lobes"),
    "leaves_no_lobes_or_rim": N_("leaves no lobes or no rim"),
    "leaves_no_pin": N_("leaves no pin"),
    "leaves_no_pins": N_("leaves no pins"),
    "leaves_no_seat": N_("leaves no seat"),
    "leaves_no_tip": N_("leaves no tips between slots and locking arcs"),
    "leaves_no_tooth_between_pins": N_("leaves no tooth between two pins"),
    "leaves_no_tooth_with_clearances": N_(
        "leaves no tooth between two pins; thinner ones need pin_clearance and root_clearance to be less too"
    ),
    "leaves_no_wall": N_("leaves no wall"),
    "leaves_no_wall_about_bore": N_("leaves no wall about the bore"),
    "needs_distance_or_crank": N_("is missing; give centre_distance or crank_radius"),
    "not_of_this_piece": N_("is not for this piece"),
    "only_of_external": N_("is for external wheels"),
    "only_of_internal": N_("is for internal wheels"),
    "only_of_solid_pins": N_('is for pins = "solid"'),
    "output_holes_do_not_fit": N_("holes of {diameter} mm (pin + 2 e + clearance) do not fit"),
    "output_holes_fit_elsewhere": N_(
        "holes of {diameter} mm (pin + 2 e + clearance) do not fit; thinner pins do on a circle of {circle} mm"
    ),
    "output_holes_have_no_room": N_(
        "holes of {diameter} mm (pin + 2 e + clearance) have no room between bore and valleys; leave output_holes out"
    ),
    "pin_holes_touch": N_("the holes touch each other"),
    "pin_paths_have_loops": N_("the pins' paths have loops (e N / R must stay below 1)"),
    "pins_reach_edge": N_("the pins reach the edge: they end at {diameter} mm"),
    "pins_touch": N_("{pins} pins on a circle of {circle} mm touch each other"),
    "pins_undercut_lobes": N_(
        "the pins undercut the lobes or leave them sharp: the path's least radius {path} mm is not above {least} mm, "
        "a hundredth more than the pin's"
    ),
    "seats_touch": N_("the seats touch each other"),
    "slots_meet": N_("the slots meet each other"),
    "tips_leave_no_disc": N_("the tips leave nothing of the driver's disc as they come by"),
    "tooth_pointed_at": N_("the tooth is pointed at {diameter} mm"),
}
