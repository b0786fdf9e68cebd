"""Why a scene is refused: noncircular gears."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "centre_within_centrode": N_("must be above the largest radius, {radius} mm"),
    "centres_would_meet": N_("the centres would meet"),
    "centrode_concave": N_("the centrode is concave somewhere, and no rack rolls on it"),
    "closes_spaces_or_fillets": N_("closes the tooth spaces or is larger than the fillets"),
    "mate_does_not_close": N_("does not close the mate, which must have a whole number of lobes"),
    "no_flank_below_tip": N_("no flank is left below the tip"),
    "not_of_this_centrode": N_('is not for centrode = "{centrode}"'),
    "not_whole_turns": N_("must be above 0, and a whole number or 1 divided by one"),
    "one_lobe_about_focus": N_('must be 1 for an ellipse about its focus; centrode = "oval" takes more'),
    "one_of_two_is_missing": N_("is missing; give it, or {other}"),
    "ratio_not_positive": N_("the ratio is not positive all round"),
    "roots_reach_axis": N_("the roots reach the axis"),
    "rounding_leaves_no_fillet": N_("the rack's rounding leaves no fillet"),
    "teeth_of_lobe_pointed": N_("{number} teeth of a lobe are pointed"),
    "too_slender": N_("too slender to compute"),
    "undercut_leaves_no_flank": N_("undercut leaves no flank below the tip"),
    "undercut_leaves_no_flank_to_fillet": N_("undercut leaves no flank that its fillet reaches"),
}
