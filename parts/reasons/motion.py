"""Why a mechanism is refused: its links, joints and drives."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "axis_not_on_carrier": N_("its axis moves as seen from {carrier}, on which both axes of a mesh must stand"),
    "carrier_without_satellites": N_("a carrier holds satellites, and at least one of them is in mesh"),
    "carries_nothing": N_("carries neither of the two wheels"),
    "contradicts": N_("is turned already by {by}; remove one of them"),
    "driven_is_driver": N_("is fixed to the driver and cannot be the driven link"),
    "driver_without_speed": N_("drives, but speeds names {known}; name the driver there, or leave it out"),
    "held_too_many": N_("nothing can move while all of these are held; hold one less"),
    "left_free": N_("is left free by the drives, as are {free}; hold one of them or drive it"),
    "load_on_given_link": N_("is driven or held: its torque is a result; load other links"),
    "moment_on_idlers": N_("is taken up by cranks or by the thesis's wheels: give orientation"),
    "moves_by_law": N_("moves by a law of its own; drive what moves it"),
    "moves_itself": N_("would move itself: its law must not depend on what it drives"),
    "no_such_link": N_("no such link; links: {known}"),
    "no_such_mesh": N_("no such kind of mesh, nor a module; kinds: {known}"),
    "no_such_wheel": N_("wheel {wheel} has no number of teeth; wheels: {known}"),
    "no_whole_teeth": N_("would give wheel {wheel} {teeth} teeth, which is not whole"),
    "not_an_efficiency": N_("must be above 0 and at most 1"),
    "not_of_teeth": N_("numbers of teeth must be whole and at least 1, modules above 0"),
    "of_no_link": N_("belongs to no link of this mechanism, or to no load that it has"),
    "out_of_reach": N_("is {distance} mm from O1, outside of {least} to {most} mm"),
    "path_too_near_centre": N_("passes the centre too near for this tolerance; {least} mm is reached"),
    "pieces_part": N_("begins at ({x}, {y}), where no piece before it ends"),
    "ring_as_its_wheel": N_("a ring has more teeth than the wheel in it"),
    "lever_needed": N_("is driven by a lever, which a slider on the crank's rod has not"),
    "no_work_over_cycle": N_("does no work over a turn: there is nothing to be evened out"),
    "does_not_turn": N_("is of a slider, which does not turn: a moment of inertia changes nothing there"),
    "needs_rocker": N_("turns a lever or rocker, but this mechanism's output slides: resistance acts on it"),
    "needs_slider": N_("acts on a slider, but this mechanism's output turns: resisting_moment acts on it"),
    "no_such_point": N_("no such point of this mechanism; points: {known}"),
    "not_among_ten": N_("the guidelines have ten"),
    "not_four_digits": N_("must be the last four digits of a record-book number, like 1071"),
    "rod_does_not_reach": N_("does not reach its guide all the way round: {least} mm from it at most"),
    "rods_do_not_close": N_(
        "does not close with its rocker all the way round: what they join is {nearest} to {farthest} mm apart"
    ),
    "stone_through_pivot": N_("is the length of the crank: the stone would pass through the pivot of its lever"),
    "rolls_on_itself": N_("is fixed to the other wheel: wheels of one body do not mesh"),
    "singular_point": N_("is on a singular circle or at the centre, where the platform moves along one line only"),
    "stands_on_itself": N_("is carried by what it carries"),
    "stands_on_nothing": N_("is carried by nothing; give it a joint on another link or on the frame"),
    "stands_on_two": N_("is already carried by {on}; a link is carried by one other link only"),
    "stands_still": N_("stands still: there is no ratio to it"),
    "train_is_locked": N_("nothing can move: the equations of the meshes leave W = {w}"),
    "write_mesh": N_("write wheels in mesh as 1-2, with internal, bevel, worm or crossed behind it where it is that"),
    "write_shaft": N_("write what stands on one shaft as 2-3"),
}
