"""Why a scene is refused: chains and their sprockets."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "beyond_the_standard": N_("is beyond the limits of its standard, {least} to {most} mm"),
    "chain_too_long": N_("hangs loose: {links} links go round at this centre distance"),
    "chain_too_short": N_("is more than {links} links span"),
    "chain_too_short_for_sprockets": N_("is too short to go round sprockets whose tips do not meet"),
    "leaves_no_core": N_("leaves no body between the rows of teeth"),
    "leaves_no_tooth_between_plates": N_("leaves no width for the teeth"),
    "leaves_no_tooth_between_rollers": N_("leaves no tooth between two rollers"),
    "needed_for_strands": N_("is missing: rows of teeth for {strands} strands need it"),
    "no_height_of_tooth": N_("GOST 591 has teeth for pitches of 1.4 to 2 roller diameters"),
    "no_such_chain": N_("is no chain of ISO 606 (04C to 48B) or GOST 13568 (PR-8-4.6 to PR-63.5-354)"),
    "not_of_the_chain": N_("must be that of the first sprocket's chain"),
    "of_another_tooth_form": N_('is not for tooth_form = "{form}"'),
    "of_plain_teeth": N_("is for one row of teeth without tooth_bevel"),
    "sprockets_meet": N_("lets the tips of both sprockets meet"),
    "wider_than_chain": N_("does not go between the inner plates of the chain, {width} mm apart"),
    "wider_than_strands": N_("leaves no gap between the rows of teeth, {width} mm from one to the next"),
}
