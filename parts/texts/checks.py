"""What the checks of a scene say: who is joined and how, which conditions hold, what stands in what."""

from __future__ import annotations

from collections.abc import Mapping

from parts.base.texts import N_, Message, Text, counted, filled

# by the kind of mate, with the numbers that its mating tells
MATES: dict[str, Text] = {
    "cam_follower": N_("{first} moves {second} by {travel:.6g} {unit}"),
    "conjugate_cams": N_("{first} - {second}: conjugate cams, rollers {between_rollers:.9g} {unit} from each other"),
    "cam_yoke": N_("{first} moves the yoke {second} by {lift:.6g} mm, breadth {yoke_breadth:.9g} mm"),
    "noncircular_gear_pair": N_(
        "pair {first} - {second}: a = {centre_distance:.5f} mm, ratio {least_ratio:.4f} to "
        "{greatest_ratio:.4f}, least contact ratio {least_contact_ratio:.4f}"
    ),
    "fixed": N_("{first} - {second}: fixed to each other"),
    "cycloidal_pair": counted(
        "{second} in {first}: reduction {reduction:.6g}, e = {eccentricity:.6g} mm, {pins_in_contact} pin touches, "
        "lost motion {lost_motion_deg:.4g} deg",
        "{second} in {first}: reduction {reduction:.6g}, e = {eccentricity:.6g} mm, {pins_in_contact} pins touch, "
        "lost motion {lost_motion_deg:.4g} deg",
        by="pins_in_contact",
    ),
    "eccentric_bearing": N_("{second} on {first}: e = {eccentricity:.6g} mm, bearing play {bearing_play:.4g} mm"),
    "output_pins": counted(
        "{second} in the holes of {first}: {output_pins} pin of {pin_diameter:.6g} mm in holes of "
        "{hole_diameter:.6g} mm",
        "{second} in the holes of {first}: {output_pins} pins of {pin_diameter:.6g} mm in holes of "
        "{hole_diameter:.6g} mm",
        by="output_pins",
    ),
    "coaxial": N_("{first} - {second}: on one axis"),
    "carried": N_("{second}: its axis goes round on {first}"),
    "parallel": N_("{second} turns as {first} does"),
    "pin_seat": N_("seated in {first}: {second}"),
    "bevel_pair": N_("{first} and {second}: ratio {ratio:.6g}, contact ratio {transverse_contact_ratio:.4f}"),
    "face_gear_pair": N_("{first} and {second}: axes at 90 deg, ratio {ratio:.6g}, contact ratio {contact_ratio:.4f}"),
    "crossed_helical_pair": N_(
        "{first} and {second}: a_w = {working_centre_distance:.5f} mm, shaft angle {shaft_angle_deg:.6g} deg, "
        "ratio {ratio:.6g}, contact ratio {contact_ratio:.4f}"
    ),
    "worm_pair": N_("{second} in {first}: centre distance {centre_distance:.6g} mm, ratio {ratio:.6g}"),
    "lantern_pair": N_(
        "lantern pair {first} - {second}: a_w = {working_centre_distance:.5f} mm, ratio {gear_ratio:.6g}, "
        "contact ratio {lantern_contact_ratio:.4f}"
    ),
    "chain_drive": counted(
        "chain drive {first} - {second}: {number_of_links} link, a = {working_centre_distance:.5f} mm, "
        "ratio {gear_ratio:.6g}, wrap {wrap_deg:.5g} deg, chain {chain_slack:.3g} mm longer than taut",
        "chain drive {first} - {second}: {number_of_links} links, a = {working_centre_distance:.5f} mm, "
        "ratio {gear_ratio:.6g}, wrap {wrap_deg:.5g} deg, chain {chain_slack:.3g} mm longer than taut",
        by="number_of_links",
    ),
    "geneva_pair": N_(
        "{first} turns {second} by {step_deg:.6g} deg at a time, in {motion_share:.6g} of its turn: "
        "a = {working_centre_distance:.5f} mm, r = {crank_radius:.5f} mm"
    ),
    "cycloidal_gear_pair": N_(
        "cycloidal pair {first} - {second}: a_w = {working_centre_distance:.5f} mm, ratio {gear_ratio:.6g}, "
        "contact ratio {contact_ratio:.4f}: where {first} drives, {approach_ratio:.4f} before the line of centres, "
        "{recess_ratio:.4f} beyond"
    ),
    "linkage_member": N_("{second}: {member} of the linkage of {first}, turns by {swing_deg:.6g} deg"),
    "wedge_follower": N_("{first}, slid {plate_travel:.6g} mm, moves {second} by {travel:.6g} {unit} in all"),
}
# a pair of involute gears, of whatever kind
GEAR_PAIR = N_("pair {first} - {second}: a_w = {a_w:.5f} mm, α_w = {alpha_w:.4f} deg, contact ratio {ratio:.4f}")
OFF_CENTRE = N_(
    "the axle of {axle} passes {frame} {distance:.6g} mm off the centre of a hole, its clearance is {clearance:.6g} mm"
)
# by the code of a condition, with its value, what is required, and its tolerance
CONDITIONS: dict[str, str] = {
    "height": N_("{second} stands {value:.9g} mm above {first}, {required:.9g} mm is required"),
    "centre_distance": N_(
        "the centres of {first} and {second} stand {value:.9g} mm apart, {required:.9g} mm is required "
        "(within {tolerance:.2g} mm)"
    ),
    "apex_distance": N_(
        "the apexes of {first} and {second} stand {value:.6g} mm apart, they must be one (within {tolerance:.2g} mm)"
    ),
    "shaft_angle": N_(
        "the axes of {first} and {second} stand at {value:.9g} deg, {required:.9g} deg is required "
        "(within {tolerance:.2g} deg)"
    ),
    "rack_phase": N_(
        "{second} stands {value:.10g} mm along its way from where it meets {first} (within {tolerance:.2g} mm)"
    ),
    "phase": N_(
        "{second} stands turned by {value:.10g} deg, rotation_deg = {required:.10g} brings it into the "
        "spaces of {first} (within {tolerance:.2g} deg)"
    ),
    "common_face_width": N_(
        "{first} and {second} share {value:.6g} mm of their face width, more than {required:g} mm is required"
    ),
    "herringbone_height": N_(
        "the points of the herringbones of {second} stand {value:.6g} mm above those of {first} (within "
        "{tolerance:.2g} mm)"
    ),
    "train": N_(
        "the other mates turn {second} {value} for one turn of {first}, this one {required}: unlike numbers lock the "
        "train"
    ),
}
VERDICTS = {
    "clear": N_("CLEAR"),
    "contact": N_("CONTACT"),
    "overlap": N_("OVERLAP"),
    "undecided": N_("UNDECIDED"),
}


def add_mates(table: Mapping[str, Text]) -> None:
    """How mates that are registered from outside are told, with the numbers of their matings."""
    MATES.update(table)


def called(row: Mapping[str, object], names: Mapping[str, str]) -> dict[str, object]:
    """What a sentence tells, instances by their names."""
    return {key: names.get(told, told) if isinstance(told, str) else told for key, told in row.items()}


def pairs_counted(count: int) -> Message:
    """So many pairs."""
    return counted("{pairs} pair", "{pairs} pairs", by="pairs", pairs=count)


def condition_message(code: str, first: str, second: str, value: float, required: float, tolerance: float) -> Message:
    """A condition of a mate as a sentence."""
    if code == "train":
        turns = (counted("{n:.9g} time", "{n:.9g} times", by="n", n=n) for n in (value, required))
        return filled(
            CONDITIONS[code], first=first, second=second, **dict(zip(("value", "required"), turns, strict=True))
        )
    numbers = {"value": value, "required": required, "tolerance": tolerance}
    return filled(CONDITIONS[code], first=first, second=second, **numbers)
