"""Why a scene is refused: scenes, exports, instances and drives."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "nothing_takes_it": N_("nothing in the scene takes it; what some part, mate, board or export takes: {known}"),
    "about_needs_at": N_("without `at` mates say where each of them stands"),
    "groups_differ": N_("are not as many as those of {first}, which are {count}"),
    "is_a_member": N_("{group} has one of this id already; rename one of them"),
    "only_of_a_count": N_("only with `count`, which makes several of it"),
    "a_folder": N_("is a folder; give a scene file (.toml) or one of: {known}"),
    "assemblies_share": N_("another assembly has a part {part} already; give each a name of its own"),
    "axis_needs_at": N_("only of an instance that stands where `at` says; give at too"),
    "cannot_turn": N_("cannot turn: {by} hold it"),
    "device_name": N_("is a name that Windows keeps for a device"),
    "driven_already": N_("the drive of {other} turns it already; remove one of them"),
    "drive_slides": N_("it slides and does not turn; give travel, in mm"),
    "drive_turns": N_("it turns and does not slide; give turns"),
    "drives_held_ring": N_("turns the ring {ring}, which is held; drive {disc} or its eccentric, or remove this drive"),
    "has_true_splines": N_("what is drawn has true splines"),
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
    "no_direction": N_("has no direction; [1.0, 0.0, 0.0] lays the part along x"),
    "no_parts": N_('a scene needs at least one part, like [parts.gear] kind = "spur_gear"'),
    "no_scene": N_("is no scene; give a scene file (.toml) or one of: {known}"),
    "no_such_instance": N_("no such instance; instances: {known}"),
    "no_such_part": N_("no such part; parts: {known}"),
    "no_such_scene": N_("no such file or built-in scene; built-in: {known}"),
    "not_a_file": N_("is a pipe or a device; give a scene file (.toml) of at most {most} bytes"),
    "not_a_name": N_("a name is made of letters, digits, _ and - (A to Z, at most 64)"),
    "not_a_path": N_("is not a path: {why}"),
    "not_for_r12": N_("R12 has no splines"),
    "not_placed": N_("is not placed; begin its train at {standing}, which is, or give instances.{first}.at"),
    "not_toml": N_("is not TOML: {why}; see `higherpair new spur_gear` for a start"),
    "not_utf8": N_("is not UTF-8 text (byte {byte}); save it as UTF-8"),
    "of_another_kind": N_("is a {found}, not a {kind}"),
    "only_for_format": N_("only for format = {formats}, not {format}"),
    "only_for_purpose": N_('only for purpose = "{purpose}"'),
    "placed_is_the_second": N_(
        "is not placed, but {second} is; swap first and second (direction_deg = {angle}), or give instances.{first}.at"
    ),
    "placed_later": N_("is not placed yet; put this mate after {mate}, which places it"),
    "same_but_for_case": N_("differs from {twin} only in case: one file for both; rename it"),
    "sheet_shows_a_pair": N_("a picture of meshing shows a pair: mate = 1, 2, … chooses one"),
    "sheet_shows_exact_profile": N_("a sheet shows the exact profile"),
    "shows_the_part": N_("a drawing, a sheet or a solid shows the part, not the cut"),
    "stands_as": N_("the part stands as {known}; name one of them"),
    "tilted_mate": N_("mates[{mate}] joins parts whose axes are upright"),
    "too_deep": N_("tables are nested too deeply: a scene needs three levels"),
    "file_exists": N_("exists already, and what stands in it may be yours; name another file"),
    "same_scene_name": N_("has the name of {other}: both would be made in one folder; build one of them with --out"),
    "too_large_file": N_("is larger than {most} bytes: not a scene file"),
    "travels_nowhere": N_("moves nothing: give a way in mm"),
    "too_small_for_part": N_(
        "the part {part} needs {width} x {height} mm within a margin of {margin} mm: give a larger board"
    ),
    "too_small_for_parts": N_("parts that are too large for it, and the scale at which each would do: {parts}"),
    "gap_above_board": N_("is larger than the board, of which the shorter side is {side} mm"),
    "margins_leave_nothing": N_("leaves nothing of a side of {side} mm"),
    "part_not_so_thick": N_("the part {part} is {thickness} mm thick"),
    "no_part_so_thick": N_("no flat part is as thick; flat parts have {found} mm"),
    "no_boards": N_("needs a table {table}, which says how large it is"),
    "key_of_board": N_("boards.NAME.kerf says it: a board is cut with one kerf"),
    "not_of_boards": N_("parts are laid out as they are"),
    "turned_into_mesh": N_("{mate} turns it into mesh; give `at` too, and the mate only checks"),
    "turns_nothing": N_("turns nothing: 1.0 is one turn"),
    "unknown_kind": N_("unknown kind; known kinds: {known}"),
    "unknown_mate": N_("unknown kind of mate; known: {known}"),
    "unknown_table": N_("unknown table; known: {known}"),
    "unreadable": N_("cannot be read: {why}"),
    "needs_cluster": N_('needs Dask: pip install "higherpair[cluster]"'),
    "no_cluster": N_("no cluster answers there: {why}"),
    "no_range": N_(
        "a range is FIRST:LAST or FIRST:LAST:STEP, FIRST to LAST by a STEP above 0, of at most {most} values"
    ),
    "no_variation": N_("write PART.KEY=1,2,5 or PART.KEY=8:200 or PART.KEY=0.5:2:0.25"),
    "too_many_variants": N_("makes {count} variants, more than {most}"),
    "worker_lost": N_(
        "a worker was ended from outside, mostly for want of memory; what is finished is kept: start again"
    ),
    "which_part": N_("is missing: which part stands here? parts: {known}"),
    "wrong_purpose": N_("{format} is for {known}"),
}
