"""Why the files of a scene are not made, checked or measured."""

from __future__ import annotations

from parts.base.texts import N_

REASONS = {
    "cell_holds_letters": N_("is longer than its cell on the sheet; letters that fit: {most}"),
    "chords_cross_wall": N_("is too coarse: the chords of its file cut through a thin wall of {part}"),
    "damaged_report": N_("is damaged ({why}); build the scene again"),
    "device_cuts_straight_teeth": N_("the device cuts straight teeth; name other gears in parts of the export"),
    "device_cuts_with_rack": N_(
        "the device cuts with a rack: leave cutter out, or name other gears in parts of the export"
    ),
    "device_draws_external_gears": N_("the device draws external gears; name a spur_gear"),
    "disk_holds_two_wheels": N_("a disk holds two wheels"),
    "drawing_of_part": N_("the drawing of {part}: {why}"),
    "draws_only": N_("draws only {kinds}; here: {known}"),
    "draws_only_what_is_not_here": N_("draws only {kinds}; add one or remove the export"),
    "finer_than_pdf": N_("is finer than a PDF can tell places"),
    "corners_fit_no_paper": N_("are more corners than the table of a working drawing can hold"),
    "fits_no_paper": N_("fits no paper at any scale"),
    "fits_no_paper_so_large": N_("no paper is large enough at this scale"),
    "finer_than_mesh_digits": N_("is too small for a mesh file, whose 7 digits do not hold it at this size of part"),
    "folder_of_files": N_("no such file: it is a folder; name the files in it"),
    "last_build_failed": N_(
        "its last build failed ({why}); what lies here is of an earlier build of the same scene; build the scene again"
    ),
    "last_build_failed_otherwise": N_(
        "its last build failed ({why}); what lies here is of an earlier build and need not fit the scene; "
        "build the scene again"
    ),
    "mate_of_no_gears": N_("is a {kind} mate; name a pair of gears"),
    "needs_kernel": N_('needs the CAD kernel: pip install ".[cad]" in the folder of higherpair'),
    "needs_mpmath": N_('needs what computes with 50 digits: pip install ".[stress]" in the folder of higherpair'),
    "needs_pdf": N_('needs what writes PDF: pip install ".[pdf]" in the folder of higherpair'),
    "no_exports": N_(
        'the scene has no exports; add [[exports]] with format = "dxf" (or svg, stl, 3mf, step), or use --format'
    ),
    "no_flat_outline": N_("has no flat outline; write it to STEP, STL or 3MF"),
    "no_outline": N_("gives no whole outline: {why}"),
    "no_pitch_curve": N_("none of its parts has a pitch curve, along which the centre of a roller or mushroom runs"),
    "no_report": N_("is damaged (it is not the JSON of a report); build the scene again"),
    "no_report_beside": N_("no {name} beside it; build the scene again to get one"),
    "no_assembly_view": N_("an assembly drawing has no view of a {kind} ({part}); leave it out by parts = [...]"),
    "assembly_axis_oblique": N_(
        "the axis of {instance} is oblique to the views of an assembly drawing; leave its part out by parts = [...]"
    ),
    "no_working_drawing": N_("a {kind} has no working drawing"),
    "zone_not_at_size": N_(
        "this tolerance zone exists for sizes above {above} up to {most} mm (ISO 286-1), not for {size} mm"
    ),
    "no_such_file": N_("no such file"),
    "no_such_mate": N_("the scene has no such mate"),
    "not_in_empty_report": N_("is not listed in {name}, which lists no file"),
    "not_in_report": N_("is not listed in {name}, which lists: {known}"),
    "nothing_to_check": N_('nothing to check; add [[mates]] kind = "{mate}"'),
    "nothing_to_measure": N_("hold no file of a single part to measure; add an export of one"),
    "not_a_file_to_read": N_("is not a file but a pipe or a device; give the names of files"),
    "of_part": N_("{part}: {why}"),
    "one_disk_one_size": N_("one disk needs module {module} and {teeth} teeth for both wheels"),
    "outline_crosses_itself": N_("is too coarse: a small piece of an outline of {part} crosses itself"),
    "paper_too_small": N_("the paper is too small"),
    "paper_too_small_for_scale": N_("the paper is too small at the scale {scale}"),
    "same_file": N_("writes the same file as {other}; give one of them another name"),
    "shows_external_gears": N_("needs external gears; add one or remove the export"),
    "worm_touches_at_points": N_(
        "a wheel that a larger hob cut touches its worm at points: it has no lines of contact to draw"
    ),
    "worm_contact_turns": N_("the contact turns back on the flanks of this pair: its lines are not drawn"),
    "shows_gear_pairs": N_("shows pairs of involute gears or worms only; remove the export or change its purpose"),
    "shows_driven_gears": N_(
        "shows gears on parallel axes that a drive turns; add mates of such gears and [[drives]] or remove the export"
    ),
    "workspace_of_turns": N_(
        "is only for drives that turn everything evenly, which {free} does not do; without this key the "
        "motion is checked along the drives"
    ),
    "workspace_of_upright": N_(
        "is not for axes that lie and go round, as that of {lying} does; without this key the motion is checked along "
        "the drives"
    ),
    "workspace_needs_drives": N_("needs drives that move something; add [[drives]] or remove the key"),
    "shows_from_above": N_("shows motion as it is seen from above; {lying} tilts"),
    "shows_what_moves": N_("shows what a drive moves; add [[drives]] or remove the export"),
    "shows_gear_pairs_of_mates": N_("shows pairs of involute gears or worms only; add [[mates]] or remove the export"),
    "stopped_while_moving": N_(
        "a build moves its files into this folder, or was stopped while it did; build the scene again"
    ),
    "tolerance_not_met": N_("cannot be met: a residual of {residual} stays after {steps} steps; make it larger"),
    "too_many_edges": N_("is too fine: the file would need {edges} edges"),
    "too_large_to_read_back": N_("is larger than {most} bytes, the most that is read back"),
    "unknown_format": N_("unknown format; formats: {known}"),
    "wall_too_thin_for_mesh": N_(
        "the chords of its file cut through a wall of {part} that is too thin for the digits of a mesh "
        "file; make the wall thicker, or write STEP"
    ),
}
