"""Why a scene is refused: numbers and words that any key may get wrong."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "before_first_row": N_("lies before first_deg"),
    "either_key": N_("give either {one} or {other}"),
    "knots_not_clamped": N_("must rise, with degree + 1 equal knots at each end"),
    "leaves_no_outline": N_("leaves no outline"),
    "missing": N_("is missing"),
    "missing_key": N_("is missing: {what}"),
    "no_such_letter_on_paper": N_("the font of a PDF has no letters {letters}"),
    "no_such_letter": N_("cannot be engraved: there are no letters {letters} to engrave"),
    "not_a_list": N_("write it as [[{key}]]"),
    "not_a_named_table": N_("its keys stand under a name, like [{key}.{example}]"),
    "not_a_table": N_("write it as a table, [{key}]"),
    "not_above_zero": N_("must be above 0"),
    "not_allowed": N_("is not allowed; {allowed}"),
    "not_below_right_angle": N_("must be above 0 and below 90 degrees"),
    "control_character": N_("has a character that no file can show"),
    "not_finite": N_("must be a finite number below 1e308"),
    "not_finite_above_zero": N_("must be a finite number above 0"),
    "not_finite_or_negative": N_("must be a finite number, at least 0"),
    "not_one_of": N_("must be one of {known}"),
    "not_within": N_("must be above {low} and below {high}"),
    "out_of_range": N_("must be from {least} to {most}"),
    "too_few": N_("is too few"),
    "unknown_key": N_("unknown key; known keys: {known}"),
    "wrong_number_of_knots": N_("there must be {wanted}: poles + degree + 1"),
    "wrong_type": N_("must be {type}"),
    "wrong_type_of": N_("must be {type}; {allowed}"),
}
