"""What a build remarks on, by the codes of the findings: sentences with ``value`` and ``limit``."""

from __future__ import annotations

from collections.abc import Mapping

from geometry.base.findings import Finding
from parts.base.texts import N_, Message, Text, counted, filled, message, words

FINDINGS: dict[str, Text] = {
    "undercut": N_("the tooth is undercut: profile shift {value:.4f} is below x_min = {limit:.4f}"),
    "undercut_on_centrode": N_(
        "teeth are undercut where the centrode's radius of curvature, {value:.4f} mm at least, is below {limit:.4f} mm"
    ),
    "bevel_undercut": N_(
        "the tooth is undercut: its involute begins on a diameter of {value:.4f} mm at the outer end, where the root "
        "has {limit:.4f} mm"
    ),
    "bevel_wide_face": N_("face width {value:.4g} mm is more than the usual {limit:.4g} mm: 0.3 R_e and 10 m"),
    "thin_tip": N_("thin tip: s_a = {value:.3f} mm is below 0.3 m = {limit:.3f} mm"),
    "thin_rim": N_("thin rim: {value:.3f} mm between bore and root circle, less than one module ({limit:.3f} mm)"),
    "thin_sprocket_tip": N_("thin tip: {value:.3f} mm is below a fiftieth of the pitch, {limit:.3f} mm"),
    "few_sprocket_teeth": N_("ISO 606 has gaps for {limit:.0f} teeth and more: {value:.0f} may be in the rollers' way"),
    "many_sprocket_teeth": N_("ISO 606 has gaps for {limit:.0f} teeth and fewer, not for {value:.0f}"),
    "odd_number_of_links": N_("{value:.0f} links are an odd number: the chain needs a cranked link"),
    "small_wrap": N_("the chain wraps {value:.5g} deg of the smaller sprocket, less than {limit:.0f} deg"),
    "chain_hangs_loose": N_("the chain is {value:.4g} mm longer than taut, more than a pitch of {limit:.5g} mm"),
    "hub_in_way_of_plates": N_("the hub, {value:.4g} mm, is in the way of the chain's plates: at most {limit:.5g} mm"),
    "relief_not_reached": N_("the tip circle, {value:.3f} mm, lies below the tip relief: this tooth has none"),
    "tip_lost": N_("the offset makes the teeth pointed: {value:.4f} mm of the tip is lost"),
    "fillet_cusp_trimmed": N_(
        "the offset {value:.4f} mm is more than the fillet radius {limit:.4f} mm: its corner is trimmed"
    ),
    "space_shallowed": N_(
        "after the offset the flanks meet at radius {value:.4f} mm: the space ends above its root, {limit:.4f} mm"
    ),
    "fillet_interference_first": N_(
        "the mate's tip reaches the fillet of the first gear: "
        "{value:.4f} mm, the involute begins at {limit:.4f} mm on the line of action"
    ),
    "active_flank_cut_away_first": N_(
        "undercut has cut away active flank of the first gear: "
        "the mate asks for it from {value:.4f} mm, it begins at {limit:.4f} mm on the line of action"
    ),
    "tip_clearance_first": N_("the mate's tip strikes the root of the first gear: clearance {value:.4f} mm"),
    "fillet_interference_second": N_(
        "the mate's tip reaches the fillet of the second gear: "
        "{value:.4f} mm, the involute begins at {limit:.4f} mm on the line of action"
    ),
    "active_flank_cut_away_second": N_(
        "undercut has cut away active flank of the second gear: "
        "the mate asks for it from {value:.4f} mm, it begins at {limit:.4f} mm on the line of action"
    ),
    "tip_clearance_second": N_("the mate's tip strikes the root of the second gear: clearance {value:.4f} mm"),
    "hub_clearance_first": N_("the second gear strikes the hub of the first one: clearance {value:.4f} mm"),
    "contact_below_flank_first": N_(
        "the mate's tip runs into the fillet of the first gear: it reaches a radius of {value:.4f} mm, the flank "
        "begins at {limit:.4f} mm"
    ),
    "contact_below_flank_second": N_(
        "the mate's tip runs into the fillet of the second gear: it reaches a radius of {value:.4f} mm, the flank "
        "begins at {limit:.4f} mm"
    ),
    "crossed_face_first": N_(
        "the face of the first gear, {value:.4g} mm, is narrower than the path of contact, which takes {limit:.4g} mm"
    ),
    "crossed_face_second": N_(
        "the face of the second gear, {value:.4g} mm, is narrower than the path of contact, which takes {limit:.4g} mm"
    ),
    "contact_ratio": N_("contact ratio {value:.4f} is below {limit:.1f}: the drive is interrupted"),
    "transverse_contact_ratio": N_(
        "transverse contact ratio {value:.4f} is below 1: only the overlap along the face keeps the drive "
        "going, total contact ratio {limit:.4f}"
    ),
    "total_contact_ratio": N_("total contact ratio {value:.4f} is below {limit:.1f}: the drive is interrupted"),
    "normal_backlash": N_("the flanks overlap: normal backlash {value:.6f} mm"),
    "fillet_interference_pinion": N_(
        "the mate's tip reaches the fillet of the pinion: "
        "{value:.4f} mm, the involute ends at {limit:.4f} mm on the line of action"
    ),
    "tip_clearance_pinion": N_("the mate's tip strikes the root of the pinion: clearance {value:.4f} mm"),
    "fillet_interference_ring": N_(
        "the mate's tip reaches the fillet of the ring: "
        "{value:.4f} mm, the involute ends at {limit:.4f} mm on the line of action"
    ),
    "tip_clearance_ring": N_("the mate's tip strikes the root of the ring: clearance {value:.4f} mm"),
    "fillet_interference_gear": N_(
        "the mate's tip reaches the fillet of the gear: "
        "{value:.4f} mm, the involute ends at {limit:.4f} mm on the line of action"
    ),
    "tip_clearance_gear": N_("the mate's tip strikes the root of the gear: clearance {value:.4f} mm"),
    "fillet_interference_rack": N_(
        "the mate's tip reaches the fillet of the rack: "
        "{value:.4f} mm, the involute ends at {limit:.4f} mm on the line of action"
    ),
    "tip_clearance_rack": N_("the mate's tip strikes the root of the rack: clearance {value:.4f} mm"),
    "involute_interference": N_(
        "involute interference: "
        "the ring's flank begins at {value:.4f} mm, the pinion's involute at {limit:.4f} mm on the line of action"
    ),
    "trochoid_interference": N_(
        "the tips of pinion and ring strike each other on their way out: {lack:.3g} mm of room is lacking"
    ),
    "radial_assembly": N_("the pinion goes into the ring only along its axis: {lack:.3g} mm of room is lacking"),
    "thin_ring_rim": N_("thin rim: {value:.3f} mm outside the root circle, less than one module ({limit:.3f} mm)"),
    "tip_rounding_kept": N_(
        "a face chamfer of {value:.4g} mm is deeper than three quarters of the tip rounding ({limit:.4g} mm): "
        "a quarter of that rounding is kept at the end face, where a plain chamfer would leave less"
    ),
    "rack_rounding_reduced": N_(
        "the tip of the basic rack is rounded by {value:.4f} m: the standard's {limit:.2f} m, which is for 20 degrees, "
        "does not fit at this pressure angle"
    ),
    "cutter_makes_root": N_(
        "basic_rack gives only the addendum ({value:.4g} m): the cutter makes the root, diameter "
        "{limit:.4f} mm, and the fillet"
    ),
    "ring_tip_limited": N_(
        "the ring's tips are made shallower: addendum {value:.4f} m in place of {limit:.4f} m, which would "
        "lie below the base circle or be trimmed by every cutter; tip_diameter overrides"
    ),
    "short_rack": counted(
        "the rack has {value:.0f} tooth: fewer than {limit:.0f}; the check knows nothing of its ends",
        "the rack has {value:.0f} teeth: fewer than {limit:.0f}; the check knows nothing of its ends",
        by="value",
    ),
    "offset_in_mesh": N_(
        "the outlines are moved out by {value:.4g} mm: gears in mesh lose {limit:.4g} mm of backlash, "
        "which the check does not see"
    ),
    "label_on_tag": N_(
        "its name, at least {limit:.1f} mm high, has no room in the clear material, {value:.1f} mm: it "
        "stands on a tag beside the part"
    ),
    "cut_several_times": N_("boards like this one to be cut: {value:.0f}"),
    "printed_several_times": N_("beds like this one to be printed: {value:.0f}"),
    "title_not_engraved": counted(
        "its title has {value:.0f} letter that cannot be engraved: its numbers or its id stand there; "
        "`label` can give other words",
        "its title has {value:.0f} letters that cannot be engraved: its numbers or its id stand there; "
        "`label` can give other words",
        by="value",
    ),
    "flat_outline": N_("a flat outline holds only the section; STL, 3MF and STEP have the whole solid"),
    "never_moves": N_("the follower never moves: all phases are dwells, the cam is a round disk"),
    "rigid_impact": N_("rigid impact: S' jumps by {value:.4g} mm/rad at cam angle {limit:.4g} deg"),
    "soft_impact": N_("soft impact: S'' jumps by {value:.4g} mm/rad^2 at cam angle {limit:.4g} deg"),
    "swung_rigid_impact": N_("rigid impact: S' jumps by {value:.4g} deg/rad at cam angle {limit:.4g} deg"),
    "swung_soft_impact": N_("soft impact: S'' jumps by {value:.4g} deg/rad^2 at cam angle {limit:.4g} deg"),
    "steep_pressure_angle": N_("pressure angle {value:.2f} deg on the rise, usual is at most {limit:.0f} deg"),
    "transmission_angle_not_kept": N_(
        "the transmission angle falls to {value:.4g} deg, below the {limit:.4g} deg asked for, since the "
        "base circle is given"
    ),
    "label_tells_z": N_("its label says z {value:.6g}, it has {limit:.6g} teeth"),
    "label_tells_m": N_("its label says m {value:.6g}, its module is {limit:.6g} mm"),
    "label_tells_x": N_("its label says x {value:.6g}, its profile shift is {limit:.6g}"),
    "steep_return_pressure_angle": N_(
        "pressure angle {value:.2f} deg on the return, which the cam drives too; usual is at most {limit:.0f} deg"
    ),
    "roller_play": N_(
        "the roller's play in its groove is {value:.4g} mm; with none it jams, above {limit:.4g} mm it knocks"
    ),
    "engraved_groove": N_(
        "the groove is {value:.4g} mm deep in a thickness of {limit:.4g} mm: its walls stand on layer "
        "ENGRAVE, not cut through; groove_piece gives plates to glue"
    ),
    "wedge_rigid_impact": N_("rigid impact: S' jumps by {value:.4g} at {limit:.4g} mm of travel"),
    "wedge_soft_impact": N_("soft impact: S'' jumps by {value:.4g} 1/mm at {limit:.4g} mm of travel"),
    "wedge_swung_rigid_impact": N_("rigid impact: S' jumps by {value:.4g} deg/mm at {limit:.4g} mm of travel"),
    "wedge_swung_soft_impact": N_("soft impact: S'' jumps by {value:.4g} deg/mm^2 at {limit:.4g} mm of travel"),
    "large_roller": N_(
        "roller radius {value:.4g} mm is above 0.8 of the least radius of the pitch curve ({limit:.4g} mm)"
    ),
    "steep_groove": N_("pressure angle {value:.2f} deg at the groove's floor, usual is at most {limit:.0f} deg"),
    "steep_track": N_(
        "pressure angle {value:.2f} deg at the inner edge of the track, usual is at most {limit:.0f} deg"
    ),
    "large_groove_roller": N_(
        "half the groove's width {value:.4g} mm is above 0.8 of the one that undercuts ({limit:.4g} mm)"
    ),
    "development": N_(
        "flat outline: the outer cylinder of {limit:.9g} mm unrolled, seen from outside, {value:.9g} mm around"
    ),
    "outline_trimmed": counted(
        "the outline moved by {limit:.4g} mm crosses itself in {value:.0f} place: it is trimmed there",
        "the outline moved by {limit:.4g} mm crosses itself in {value:.0f} places: it is trimmed there",
        by="value",
    ),
    "worm_not_long_enough": N_("the thread is {value:.5g} mm long, the wheel touches it over {limit:.5g} mm"),
    "worm_slanted_not_long_enough": N_(
        "the thread is {value:.5g} mm long at its foot, with slanted ends: to cover all that the wheel "
        "touches it must be {limit:.5g} mm long"
    ),
    "worm_wheel_hob_overlap": N_(
        "the hob of hob_diameter_quotient leaves teeth that run {value:.2g} mm into the worm; a wheel with "
        "axial_thinning of {limit:.6g} mm clears it"
    ),
    "worm_wheel_narrow": N_(
        "without face_width the rim is {value:.4g} mm wide: there are no whole teeth on more of the {limit:.4g} mm of "
        "GOST 19650"
    ),
    "worm_wheel_no_flank": N_(
        "from {value:.5g} mm beside the mid plane to the end of the face, {limit:.5g} mm, the fillet of the hob's tip "
        "reaches the tip of the teeth: there is no flank"
    ),
    "worm_wheel_outer_not_reached": N_(
        "outer_diameter {limit:.6g} mm is not reached: the throat ends in the end faces at {value:.6g} mm"
    ),
    "worm_wheel_sharp_corner": N_(
        "the throat meets the end faces in corners of {value:.2g} deg; an outer_diameter of at most {limit:.6g} mm "
        "leaves 30 deg"
    ),
    "worm_wheel_ridge": N_(
        "beyond {value:.5g} mm from the mid plane the teeth are pointed: they end in a ridge, up to "
        "{limit:.5g} mm lower than the tip"
    ),
    "worm_section": N_(
        "flat outline: the section across the worm's axis, {value:.6g} mm; STL, 3MF and STEP have the screw surfaces"
    ),
    "transverse_section": N_(
        "helical teeth, {value:.6g} degrees: a flat outline is their transverse section; STL, 3MF and "
        "STEP have the screw surfaces"
    ),
    "rolled_jumps": N_(
        "on this outline the follower's acceleration S'' jumps by {value:.3g} at joints of arcs or lines, "
        "its peak is {limit:.3g}: a drawing DXF or STEP has splines; a smaller tolerance makes the jumps "
        "smaller"
    ),
    "follower_may_slip": N_(
        "from cam angle {value:.6g} degrees on, the pressure angle is so near to 90 degrees that an "
        "outline good to {limit:.3g} mm does not hold the follower: its lift is not measured"
    ),
    "coarse_tolerance": N_(
        "tolerance {value:.4g} mm is more than 5 % of the module ({limit:.4g} mm): the teeth lose their shape"
    ),
    "short_edges": counted(
        "{value:.0f} edge is shorter than {limit:.3g} mm; merging it would break the tolerance",
        "{value:.0f} edges are shorter than {limit:.3g} mm; merging them would break the tolerance",
        by="value",
    ),
    "many_faces": N_(
        "STEP with more than {value:.0f} faces: programs that read it through Open CASCADE, like FreeCAD, take some "
        "10 s for {limit:.0f} of them and four times as long for twice as many"
    ),
    "position_not_shown": N_("position {value:.0f} of the parts list is hidden in every view: it has no number there"),
    "flat_pins": N_(
        "the pins of one piece are not in a flat outline, which has holes in their place; STL, 3MF and STEP have them"
    ),
    "plate_reaches_axle": N_(
        "the crank plate of {value:.6g} mm reaches under the wheel's bore: above {limit:.6g} mm no axle passes it"
    ),
    "cycloidal_near_cusp": N_(
        "the lobes are nearly sharp: least radius {value:.4f} mm is below a tenth of the pin's, "
        "{limit:.4f} mm; a smaller eccentricity or thinner pins round them"
    ),
    "lobes_reach_ring": N_(
        "the lobes reach the inside of the ring: inner_diameter is {value:.6g} mm, at least {limit:.6g} mm clears them"
    ),
    "output_holes_small": N_(
        "the output pins jam in holes of {value:.6g} mm: pin + 2 e is {limit:.6g} mm; set the table's pin_diameter"
    ),
    "thin_roller_wall": N_("thin wall: {value:.3g} mm about its bore, less than {limit:.3g} mm"),
    "cycloidal_thin_wall": N_(
        "thin wall: {value:.3f} mm between holes and valleys, less than half of a pin's radius ({limit:.3f} mm)"
    ),
    "curvature_radius_not_kept": N_(
        "least convex radius {value:.4g} mm, less than the {limit:.4g} mm asked for: the "
        "base_circle_radius given is too small for it"
    ),
    "flat_offset": N_(
        "follower_offset = {value:.6g} mm does not change the cam of a flat follower: only the stem stands "
        "beside the axis, so the plate has to be {limit:.6g} mm wide"
    ),
    "pivot_within_cam": N_(
        "the follower's pivot, {limit:.6g} mm from the axis, stands within the cam's outline: the cam "
        "reaches {value:.4g} mm over it, so arm and pivot need a place above or below the cam"
    ),
    "linkage_curvature_radius": N_("least convex radius {value:.4g} mm, less than the {limit:.4g} mm asked for"),
    "small_transmission_angle": N_(
        "transmission angle {value:.2f} deg between connecting rod and guide, usual is at least {limit:.0f} deg"
    ),
}


def add_findings(table: Mapping[str, Text]) -> None:
    """The sentences of a kind that is registered from outside, with ``value`` and ``limit``."""
    FINDINGS.update(table)


def finding_message(finding: Finding) -> Message:
    """A finding as a sentence that waits for its language."""
    value, limit = finding.value, finding.limit
    return filled(FINDINGS[finding.code], value=value, limit=limit, lack=limit - value)


def finding_of(gear: int, finding: Finding) -> Message:
    """A finding of gear 1 or 2; of the pair where the number is 0."""
    told = finding_message(finding)
    return message("gear {number}: {finding}", number=gear, finding=told) if gear else told


def finding_text(language: str, finding: Finding) -> str:
    """A finding as a sentence."""
    return words(language).say(finding_message(finding))
