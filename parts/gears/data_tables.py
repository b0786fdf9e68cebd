"""The tables of gears, rings and racks (GOST 2.403, 2.404), and of worms and their wheels (GOST 2.406)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from geometry.base.record import replace
from parts.base.part import Part
from parts.base.texts import N_, Message, Text, in_context, standard_told
from parts.gears.noncircular_gear import page as noncircular_page
from parts.gears.noncircular_gear.part import NoncircularGearSpec
from parts.gears.rack import page as rack_page
from parts.gears.rack.part import RackSpec
from parts.gears.ring_gear import page as ring_page
from parts.gears.ring_gear.part import RingGearSpec
from parts.gears.spur_gear import page as spur_page
from parts.gears.spur_gear.part import SpurGearSpec
from parts.gears.worm import page as worm_page
from parts.gears.worm.part import WormSpec
from parts.gears.worm_wheel.part import WormWheelSpec
from parts.keys.accuracy import AccuracyTable
from parts.keys.helix import ToothedKeys, helix_of
from parts.pages.data_table import DataRow, DataTable, Mated, chosen_columns, grade_rows, rows_of, with_limits
from parts.pages.inputs import SceneKeys, given
from parts.pages.page import Sheet

_PAGES: Mapping[str, Callable[[dict[str, object]], Sheet]] = {
    "spur_gear": spur_page.sheet,
    "ring_gear": ring_page.sheet,
    "rack": rack_page.sheet,
}
# steps of the calculation: of teeth, of what a rack or a cutter of one's own has
_TEETH = ("module", "number_of_teeth", "sector_teeth", "sector_runs", "helix_angle_deg")
_OWN = ("pressure_angle_deg", "addendum_coefficient", "tip_clearance_coefficient", "tip_radius_coefficient")
_CUTTER = ("pressure_angle_deg", "addendum_coefficient", "cutter_teeth", "cutter_shift", "cutter_addendum",
           "cutter_tip_rounding", "dedendum_coefficient", "root_rounding_coefficient")  # fmt: skip
_RELIEF = ("relief_depth_coefficient", "relief_height_coefficient")
_SHIFT = ("profile_shift_coefficient", "generating_shift_coefficient")
_STANDARD_ANGLE = 20.0
# what is measured, the last of each is the size with deviations; the first that the part has is taken
_CONTROLS = (
    ("thread_chord_height", "thread_chord"),
    ("teeth_spanned", "span"),
    ("spaces_spanned", "span_over_spaces"),
    ("pin_diameter", "over_pins"),
    ("pin_diameter", "between_pins"),
    ("ball_diameter", "over_balls"),
    ("ball_diameter", "between_balls"),
    ("constant_chord_height", "constant_chord"),
)
_SPANS = ("span", "span_over_spaces")
_REFERENCE = ("reference_diameter", "rack_pitch")
_WORM = ("worm_pressure_angle_deg", "grinding_wheel_diameter", "addendum_coefficient", "tip_clearance_coefficient")
_HOB = ("hob_rounding_coefficient", "hob_diameter_quotient", "hob_thickening")
# what tells the centrode of a noncircular gear
_CENTRODE = ("centrode_eccentricity", "centrode_lobes", "mean_ratio", "perimeter", "mate_perimeter",
             "least_centrode_radius", "greatest_centrode_radius")  # fmt: skip
_CENTRODES: Mapping[str, Text] = {
    "oval": N_("oval about its middle"),
    "focal_ellipse": N_("ellipse about its focus"),
    "ratio": N_("by the ratio"),
}
_HANDS = {
    "right": in_context("direction of teeth", "right"),
    "left": in_context("direction of teeth", "left"),
    "double": in_context("direction of teeth", "herringbone"),
}


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of a toothed part, as the scene's mates have left it; ``mates``: what meshes with it."""
    if isinstance(part.keys, NoncircularGearSpec):
        return _noncircular(part, part.keys)
    return (_gear if part.kind in _PAGES else _worm)(part, mates)


def _gear(part: Part, mates: Sequence[Mated]) -> DataTable:
    keys = part.keys
    assert isinstance(keys, ToothedKeys)
    made = {"circumferential_thinning": part.thing.circumferential_thinning}
    if part.kind != "rack" and part.thing.given_tip_diameter is not None:
        made["tip_diameter"] = part.thing.given_tip_diameter
    if (helix := helix_of(keys)).angle:
        # the hand tells its sense
        made["helix_angle_deg"] = abs(keys.helix_angle_deg)
    page = _PAGES[part.kind](given(keys) | made)
    hand = [hand_row("double" if helix.double else helix.hand)] if helix.angle else []
    basic, own = _basic_rack(keys)
    shift = rows_of(page, (*own, *_RELIEF, *_SHIFT))
    crowned = getattr(keys, "crowning", 0.0)
    crown = (DataRow(N_("crowning of each flank"), "C_β", crowned, "mm"),) if crowned else ()
    first = (*rows_of(page, _TEETH), *hand, *basic, *shift, *crown, *grade_rows(keys.accuracy))
    beside = _at_distances(mates, DataRow(N_("centre distance"), "a_w", 0.0, "mm"))
    others = mate_rows([m for m in mates if m.distance is None])
    return DataTable((first, _control(page, keys.accuracy), (*rows_of(page, _REFERENCE), *beside, *others)))


def _noncircular(part: Part, keys: NoncircularGearSpec) -> DataTable:
    """The rack that rolls on the centrode, that centrode, and its place and radius by the driver's angle."""
    gear, drives = part.thing, keys.role == "driver"
    thinning = gear.circumferential_thinning
    page = noncircular_page.sheet(given(keys) | {"circumferential_thinning": thinning})
    basic, own = _basic_rack(keys)
    own_teeth, mate_teeth = ("gear_teeth", "mate_teeth") if drives else ("mate_teeth", "gear_teeth")
    rack = (*rows_of(page, ("module", own_teeth)), *basic)
    waves = [DataRow(N_("amplitudes of the ratio"), symbol, "; ".join(f"{value:.10g}" for value in page.data[name]))
             for name, symbol in (("ratio_cosines", "a_k"), ("ratio_sines", "b_k")) if page.data.get(name)]  # fmt: skip
    role = DataRow(N_("role in the pair"), "", N_("driver") if drives else N_("driven gear"))
    middle = N_("middle of a tooth") if drives else N_("middle of a space")
    datum = DataRow(N_("on the radius r at φ = 0"), "", middle)
    centrode = DataRow(N_("centrode of the driver"), "", _CENTRODES[keys.centrode])
    positions = next(table for table in page.tables if table.name == "centrodes")
    columns = ("phi_1", "r_1", "i") if drives else ("phi_2", "r_2", "i")
    return DataTable(
        ((*rack, *rows_of(page, (*own, *_SHIFT[:1], "circumferential_thinning"))),
         (role, datum, centrode, *rows_of(page, _CENTRODE), *waves),
         rows_of(page, (mate_teeth, "noncircular_distance"))),
        chosen_columns(positions, columns),
    )  # fmt: skip


def _basic_rack(keys: ToothedKeys | NoncircularGearSpec) -> tuple[tuple[DataRow, ...], tuple[str, ...]]:
    """The basic rack by its standard, and the steps that tell what no standard does."""
    if isinstance(keys, RingGearSpec) or (isinstance(keys, SpurGearSpec) and keys.cutter is not None):
        return (), _CUTTER
    if not isinstance(keys, SpurGearSpec | RackSpec | NoncircularGearSpec) or not isinstance(keys.basic_rack, str):
        return (), _OWN
    angle = () if keys.pressure_angle_deg == _STANDARD_ANGLE else _OWN[:1]
    return (DataRow(N_("basic rack"), "", standard_told(keys.basic_rack)),), angle


def _worm(part: Part, mates: Sequence[Mated]) -> DataTable:
    specs = [part.keys, *(m.part.keys for m in mates)]
    table = worm_page.drive_table(specs)
    for one in (part, *(m.part for m in mates)):
        if isinstance(one.keys, WormSpec):
            table["axial_thinning"] = one.thing.thread.worm.thinning
    page = worm_page.sheet(table)
    keys = part.keys
    assert isinstance(keys, WormSpec | WormWheelSpec)
    hand, grade = hand_row(keys.hand), grade_rows(keys.accuracy)
    if isinstance(keys, WormSpec):
        # an involute one is ground by the lines of its base cylinder
        named = "axial_module", "number_of_starts", "worm_form", "lead_angle_deg", "base_lead_angle_deg"
        first = _form_bare(rows_of(page, named))
        own = rows_of(page, (*_WORM, "worm_fillet_coefficient"))
        last = rows_of(page, ("worm_reference_diameter", "diameter_quotient", "worm_base_diameter", "lead"))
        distance = rows_of(page, ("worm_centre_distance",))
        beside = _at_distances(mates, *distance) if mates else distance
        hand = replace(hand, name=N_("direction of the thread"))
        return DataTable(((*first, hand, *own, *grade), _control(page, keys.accuracy), (*last, *beside)))
    first = rows_of(page, ("axial_module", "worm_wheel_teeth"))
    own = rows_of(page, ("profile_shift_coefficient", *_WORM, *_HOB))
    last = rows_of(page, ("worm_centre_distance", "wheel_reference_diameter", "worm_form", "number_of_starts",
                          "diameter_quotient", "lead_angle_deg"))  # fmt: skip
    return DataTable(((*first, hand, *own, *grade), (), (*_form_bare(last), *mate_rows(mates)[1:])))


def _form_bare(rows: Sequence[DataRow]) -> tuple[DataRow, ...]:
    """The form of a worm tells its symbol itself: ZA."""
    return tuple(replace(row, symbol="") if row.symbol == "Z" else row for row in rows)


def hand_row(hand: str) -> DataRow:
    """Which way teeth, or a thread, run."""
    return DataRow(N_("direction of the tooth line"), "", _HANDS[hand])


def _control(page: Sheet, accuracy: AccuracyTable | None) -> tuple[DataRow, ...]:
    """What is measured on the teeth: the first of the ways that the calculation has and the face is wide enough for."""
    steps = {step.name: step.value for step in page.steps()}
    width = steps.get("helix_face_width", steps.get("face_width", 0.0))
    wide = float(width) >= float(steps.get("secure_face_width", 0.0))
    for names in _CONTROLS:
        rows = rows_of(page, names)
        if len(rows) == len(names) and (wide or names[-1] not in _SPANS):
            return with_limits(rows, accuracy)
    return ()


def _at_distances(mates: Sequence[Mated], distance: DataRow) -> list[DataRow]:
    """Each centre distance, and below it what meshes there."""
    groups: dict[float, list[Mated]] = {}
    for mate in mates:
        if mate.distance is not None:
            groups.setdefault(round(mate.distance, 9), []).append(mate)
    return [row for group in groups.values()
            for row in (replace(distance, value=group[0].distance or 0.0), *mate_rows(group))]  # fmt: skip


def mate_rows(mates: Sequence[Mated]) -> list[DataRow]:
    """Teeth and drawing of each mate; alike ones once."""
    rows: dict[tuple[object, ...], DataRow] = {}
    for mate in mates:
        keys = mate.part.keys
        teeth = getattr(keys, "number_of_starts" if isinstance(keys, WormSpec) else "number_of_teeth")
        name: Text = N_("number of starts of the worm") if isinstance(keys, WormSpec) else N_("teeth of the mate")
        rows["teeth", teeth] = DataRow(name, "z", teeth)
        drawing = getattr(keys, "designation", None) or mate.part.title or mate.part.id
        # as it stands: an id may be a word of a catalogue
        rows["drawing", drawing] = DataRow(N_("drawing of the mate"), "", Message("{name}", {"name": drawing}))
    return list(rows.values())
