"""Why a mechanism is refused: its links, joints and drives."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "axis_not_on_carrier": N_("its axis moves as seen from {carrier}, on which both axes of a mesh must stand"),
    "carries_nothing": N_("carries neither of the two wheels"),
    "contradicts": N_("is turned already by {by}; remove one of them"),
    "left_free": N_("is left free by the drives, as are {free}; hold one of them or drive it"),
    "moves_by_law": N_("moves by a law of its own; drive what moves it"),
    "moves_itself": N_("would move itself; its law must hang on what it does not drive"),
    "no_such_link": N_("no such link; links: {known}"),
    "not_of_teeth": N_("numbers of teeth are whole, from 1 on, and a module is above 0"),
    "rolls_on_itself": N_("is one body with the other wheel; a wheel has no mesh in itself"),
    "stands_on_itself": N_("is carried by what it carries"),
    "stands_on_nothing": N_("is carried by nothing; give it a joint on another link or on the frame"),
    "stands_on_two": N_("is carried by {on} already; a link stands on one other"),
    "stands_still": N_("stands still: there is no ratio to it"),
}
