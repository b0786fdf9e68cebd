"""Why a calculation is refused."""

from __future__ import annotations

from parts.base.texts import N_, counted

REASONS = {
    "as_many_as_x": N_("must have as many values as x"),
    "choose_a_part": N_("there are several: {known}; add part=ID"),
    "either_of": N_("is given together with {other}: one of the two is enough"),
    "first_cam_under_it": N_(
        "give the first cam's keys under it, as of.follower=roller of.lift=20, or name a scene with the part"
    ),
    "gear_missing": N_("is missing: give {name}.number_of_teeth=…, and the same for the other one"),
    "give_it_or": N_("is missing: give it or {other}"),
    "given_twice": N_("is given twice: once is enough"),
    "groove_below_ball": N_("must be wider than the ball: above {least} mm"),
    "has_a_value": N_("{key} has a value already; remove one of them"),
    "kerf_drops_pin": N_("leaves spaces so wide that a pin of {pin} mm falls between the flanks"),
    "keys_not_a_scene": N_("takes keys only, no scene"),
    "needs_other": N_("needs {other} too"),
    "of_helical_gears_alone": N_("is for helical gears only; give helix_angle_deg"),
    "no_dxf": N_("is not a DXF that can be read"),
    "no_gear_pair": N_('has no pair of gears; add [[mates]] kind = "external_gear_pair"'),
    "no_path": N_("has no path to follow; draw lines, arcs, circles or polylines"),
    "no_path_entity": N_("has a {kind}; a path is made of lines, arcs, circles and polylines"),
    "no_such_folder": N_("there is no such folder"),
    "no_such_pair": N_("the scene has no such pair"),
    "no_tables": N_("this calculation has no tables"),
    "no_whole_modules": N_("must be a whole number of modules, at least 3"),
    "none_of_kind": N_("the scene has no {kind}; name another one, or type its keys"),
    "one_scene_only": N_("one scene is enough; {other} is given already"),
    "other_is_given": N_("{other} is given already"),
    "part_without_scene": N_("names a part of a scene, but no scene is given"),
    "path_is_open": counted(
        "is not one path: {left} piece is left, which neither begins nor ends at ({x}, {y})",
        "is not one path: {left} pieces are left, of which none begins or ends at ({x}, {y})",
        by="left",
    ),
    "picture_ends_in": N_("pictures end in one of {known}"),
    "piece_is_a_point": N_("begins where it ends; a circle is two pieces with bulge 1"),
    "reference_circle_leaves_teeth": N_("the reference circle lies outside the teeth"),
    "shifts_of_gear_pairs": N_("shifts are chosen for external and internal pairs only; give mate = the number of one"),
    "teeth_of_disk": N_("{other} gives {teeth}; one of the two keys is enough"),
    "too_many_rows": N_("makes too many rows"),
    "unknown_pair": N_("unknown kind of pair; known: {known}"),
    "unknown_topic": N_("unknown topic; topics: {known}"),
    "wish_not_met": N_("{place}: {why}"),
    "write_key_value": N_("write key=value, like number_of_teeth=23"),
    "write_teeth": N_("write {name}.number_of_teeth=…"),
}
