"""Why a scene is refused: scenes, exports, instances and drives."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "no_place_of_hole": N_(
        "is missing; give x and y of its centre, or axis_of = the instance whose axle passes through it"
    ),
    "own_axis": N_("is an instance of this part itself; name an instance of another part"),
    "axle_not_upright": N_("the axis of {instance} is not upright, along z"),
    "nothing_takes_it": N_(
        "no part, mate, board or export of this scene has this key; keys that one of them has: {known}"
    ),
    "about_needs_at": N_("needs `at`: without it the mates place each member"),
    "groups_differ": N_("must have as many members as {first}, which has {count}"),
    "is_a_member": N_("the group {group} already has a member with this id; rename one of them"),
    "only_of_a_count": N_("only with `count`, which makes several of it"),
    "a_folder": N_("is a folder; give a scene file (.toml) or one of: {known}"),
    "assemblies_share": N_("another assembly has a part {part} already; give each a name of its own"),
    "axis_needs_at": N_("is only for an instance that `at` places; give at too"),
    "cannot_turn": N_("cannot turn: held by {by}"),
    "device_name": N_("is a name that Windows reserves for a device; choose another name"),
    "driven_already": N_("the drive of {other} turns it already; remove one of them"),
    "drive_slides": N_("it slides and does not turn; give travel, in mm"),
    "drive_turns": N_("it turns and does not slide; give turns"),
    "drives_held_ring": N_("turns the ring {ring}, which is held; drive {disc} or its eccentric, or remove this drive"),
    "has_true_splines": N_("is not for drawings, which have true splines"),
    "held_ring_is_joined": N_(
        "is held, but other mates join it to {disc}, which turns in it; remove the one that does"
    ),
    "itself_a_part": N_("{id} is itself a part: name that one, or give the instance another id"),
    "kerf_and_offset": N_("give either kerf or offset: an offset of half the kerf is the same"),
    "kerf_of_a_print": N_("a print has no kerf: offset = {offset} moves every outline by as much"),
    "leaves_free": N_("leaves {free} free to turn; hold one of them (instances.ID.held = true) or drive it too"),
    "listed_twice": N_("is listed twice: once is enough"),
    "mate_in_itself": N_("a part has no mate in itself; name another one"),
    "missing_kind": N_("is missing; known kinds: {known}"),
    "nameless_file": N_("the file's name names the folder of the results; rename it, like gear.toml"),
    "joined_before": N_("is already joined to {to}; each step must bring in something new"),
    "never_brought": N_("leave {left} apart; add a step that brings it in"),
    "opened_turned": N_(
        "is only for turned parts, such as a snap ring; one of the parts of this step is of another kind"
    ),
    "hole_for_one_by_one": N_(
        "is only for parts that come in one by one through a hole and then move outwards or inwards; add `outwards`"
    ),
    "nowhere_outwards": N_("must not be 0: above 0 leads away from the axis, below 0 towards it"),
    "outwards_after_along": N_("needs `along`, the direction in which the part first comes in from outside"),
    "no_direction": N_("has no direction; [1.0, 0.0, 0.0] lays the part along x"),
    "no_parts": N_('a scene needs at least one part, like [parts.gear] kind = "spur_gear"'),
    "no_scene": N_("is no scene; give a scene file (.toml) or one of: {known}"),
    "no_instances": N_("no such instance, and no other fits here; add its part, or [instances.ID]"),
    "no_such_instance": N_("no such instance; instances: {known}"),
    "no_such_part": N_("no such part; parts: {known}"),
    "no_such_scene": N_("no such file or built-in scene; built-in: {known}"),
    "not_a_file": N_("is not a file but a pipe or a device; give a scene file (.toml) of at most {most} bytes"),
    "not_a_name": N_("a name is made of letters, digits, _ and - (A to Z, at most 64)"),
    "not_a_path": N_("is not a path: {why}"),
    "not_for_r12": N_("R12 has no splines"),
    "not_placed": N_("is not placed yet; start its train at {standing}, which is, or give instances.{first}.at"),
    "not_toml": N_("is not TOML: {why}; see `higherpair new spur_gear` for a start"),
    "decimal_comma": N_("line {line}: a number has a comma; write {number} with a point"),
    "no_quotes": N_('line {line}: words stand in straight quotes: {key} = "{value}"'),
    "no_brackets": N_("line {line}: a list stands in brackets: {key} = [{value}]"),
    "number_with_unit": N_("line {line}: numbers stand without units: {key} = {value}"),
    "key_not_latin": N_("line {line}: {key} is no key: keys are Latin, as `higherpair new` writes them"),
    "blank_title": N_("must not be blank"),
    "small_letters": N_("line {line}: write {key} = {value}"),
    "quote_not_closed": N_("line {line}: the quotes of {key} are not closed"),
    "backslash": N_(r"line {line}: a \ within double quotes begins a code: write \\, or single quotes: 'D:\x'"),
    "comma_in_number": N_("write {whole}.{part} with a point, or a list in brackets, [{whole}, {part}]"),
    "not_utf8": N_("is not UTF-8 text (byte {byte}); save it as UTF-8"),
    "of_another_kind": N_("is a {found}, not a {kind}"),
    "only_for_format": N_("only for format = {formats}, not {format}"),
    "model_is_full_size": N_("is not for a paper model, which is always in full size, on bare sheets"),
    "list_has_its_form": N_("is not for a parts list, which has its own form on A4"),
    "only_for_purpose": N_('only for purpose = "{purpose}"'),
    "position_of_another": N_(
        "is also the position of {other}, which has another title, designation, standard or material"
    ),
    "placed_is_the_second": N_(
        "is not placed yet, but {second} is; swap first and second (direction_deg = {angle}), or give "
        "instances.{first}.at"
    ),
    "placed_later": N_("is not placed yet; put this mate after {mate}, which places it"),
    "same_but_for_case": N_("differs from {twin} only in case: one file for both; rename it"),
    "sheet_shows_a_pair": N_("a picture of meshing shows one pair: choose it by its number, mate = 1, 2, …"),
    "sheet_shows_exact_profile": N_("is not for sheets, pictures in motion and lists, which show the exact profile"),
    "shows_the_part": N_("is not for drawings, sheets and solids, which show the part and not the cut"),
    "stands_as": N_("is a part, not an instance; its instances: {known}"),
    "leaves_its_plane": N_("goes out of the plane in which it moves what follows it: its axis must keep its direction"),
    "too_deep": N_("tables are nested too deeply: a scene needs three levels"),
    "file_exists": N_("exists already, and what it holds may be your work; give another file name"),
    "same_scene_name": N_("has the name of {other}: both would be made in one folder; build one of them with --out"),
    "too_large_file": N_("is larger than {most} bytes: not a scene file"),
    "travels_nowhere": N_("must not be 0: give the travel in mm"),
    "too_small_for_part": N_(
        "the part {part} needs {width} x {height} mm within a margin of {margin} mm: give a larger board"
    ),
    "too_many_pieces": N_("makes {pieces} pieces, more than the {most} that are laid out at once"),
    "nothing_is_laid": N_("leaves no piece to lay"),
    "too_small_for_parts": N_(
        "is too small for parts, each told with the scale at which it would fit: {parts}; a bed of {width} "
        "x {depth} x {height} mm holds all"
    ),
    "gap_above_board": N_("must be less than the shorter side of the board, {side} mm"),
    "margins_leave_nothing": N_("leaves nothing of the side of {side} mm"),
    "part_not_so_thick": N_("the part {part} is {thickness} mm thick"),
    "no_part_so_thick": N_("no flat part has this thickness; the flat parts and their thickness in mm: {found}"),
    "no_flat_part": N_("there is no flat part to cut from it; pins are cut from rods"),
    "no_boards": N_("needs a table {table}, which says how large it is"),
    "key_of_board": N_("is not for boards: give boards.NAME.kerf, one kerf for the whole board"),
    "not_of_boards": N_("is not for boards and beds, on which parts are laid as they are"),
    "turned_into_mesh": N_("is set by {mate}, which turns the part into mesh; give `at` too, and the mate only checks"),
    "turns_nothing": N_("must not be 0: 1.0 is one turn"),
    "unknown_kind": N_("unknown kind; known kinds: {known}"),
    "unknown_mate": N_("unknown kind of mate; known: {known}"),
    "unknown_material": N_("no such material: {known}; or give its `density`, g/cm^3, too"),
    "unknown_table": N_("unknown table; known: {known}"),
    "unreadable": N_("cannot be read: {why}"),
    "needs_cluster": N_('needs Dask: pip install ".[cluster]" in the folder of higherpair'),
    "no_cluster": N_("no cluster answers there: {why}"),
    "no_range": N_(
        "a range is FIRST:LAST or FIRST:LAST:STEP: FIRST not above LAST, STEP above 0, at most {most} values"
    ),
    "no_variation": N_("write PART.KEY=1,2,5 or PART.KEY=8:200 or PART.KEY=0.5:2:0.25"),
    "too_many_variants": N_("makes {count} variants, more than {most}"),
    "worker_lost": N_(
        "a worker process was ended from outside, usually for lack of memory; what is finished is kept: start again"
    ),
    "which_part": N_("is missing: which part stands here? parts: {known}"),
    "wrong_purpose": N_("{format} is for {known}"),
}
