"""The tables of gears, rings and racks (GOST 2.403, 2.404), and of worms and their wheels (GOST 2.406)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from geometry.base.record import replace
from parts.base.part import Part
from parts.base.texts import N_, Text, in_context
from parts.gears.rack import page as rack_page
from parts.gears.rack.part import RackSpec
from parts.gears.ring_gear import page as ring_page
from parts.gears.spur_gear import page as spur_page
from parts.gears.spur_gear.part import SpurGearSpec
from parts.gears.worm import page as worm_page
from parts.gears.worm.part import WormSpec
from parts.gears.worm_wheel.part import WormWheelSpec
from parts.keys.accuracy import AccuracyTable
from parts.keys.helix import ToothedKeys, helix_of
from parts.pages.data_table import DataRow, DataTable, Mated, rows_of
from parts.pages.inputs import SceneKeys, given
from parts.pages.page import Sheet

_PAGES: Mapping[str, Callable[[dict[str, object]], Sheet]] = {
    "spur_gear": spur_page.sheet,
    "ring_gear": ring_page.sheet,
    "rack": rack_page.sheet,
}
# steps of the calculation: of teeth, of what a rack or a cutter of one's own has
_TEETH = ("module", "number_of_teeth", "helix_angle_deg")
_OWN = ("pressure_angle_deg", "addendum_coefficient", "tip_clearance_coefficient", "tip_radius_coefficient",
        "cutter_teeth", "cutter_shift", "cutter_addendum", "cutter_tip_rounding", "dedendum_coefficient")  # fmt: skip
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
_WORM = ("worm_pressure_angle_deg", "addendum_coefficient", "tip_clearance_coefficient", "worm_fillet_coefficient")
_HANDS = {
    "right": in_context("direction of teeth", "right"),
    "left": in_context("direction of teeth", "left"),
    "double": in_context("direction of teeth", "herringbone"),
}


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of a toothed part, as the scene's mates have left it; ``mates``: what meshes with it."""
    return (_gear if part.kind in _PAGES else _worm)(part, mates)


def _gear(part: Part, mates: Sequence[Mated]) -> DataTable:
    keys = part.keys
    assert isinstance(keys, ToothedKeys)
    made = {"circumferential_thinning": part.thing.circumferential_thinning}
    if part.kind != "rack" and part.thing.given_tip_diameter is not None:
        made["tip_diameter"] = part.thing.given_tip_diameter
    page = _PAGES[part.kind](given(keys) | made)
    helix = helix_of(keys)
    hand = [_hand("double" if helix.double else helix.hand)] if helix.angle else []
    basic, own = _basic_rack(keys)
    shift = rows_of(page, (*own, "profile_shift_coefficient"))
    first = (*rows_of(page, _TEETH), *hand, *basic, *shift, *_grade(keys.accuracy))
    beside = [m for m in mates if m.part.kind != "rack" and part.kind != "rack"]
    distances = {round(m.distance, 9): DataRow(N_("centre distance"), "a_w", m.distance, "mm") for m in beside}
    return DataTable((first, _control(page, keys.accuracy),
                      (*rows_of(page, _REFERENCE), *distances.values(), *_mates(mates))))  # fmt: skip


def _basic_rack(keys: ToothedKeys) -> tuple[tuple[DataRow, ...], tuple[str, ...]]:
    """The basic rack by its standard, and the steps that tell what no standard does."""
    if not isinstance(keys, SpurGearSpec | RackSpec) or not isinstance(keys.basic_rack, str):
        return (), _OWN
    if isinstance(keys, SpurGearSpec) and keys.cutter is not None:
        return (), _OWN
    angle = () if keys.pressure_angle_deg == _STANDARD_ANGLE else _OWN[:1]
    return (DataRow(N_("basic rack"), "", keys.basic_rack),), angle


def _worm(part: Part, mates: Sequence[Mated]) -> DataTable:
    specs = [part.keys, *(m.part.keys for m in mates)]
    table = worm_page.drive_table(specs)
    for one in (part, *(m.part for m in mates)):
        if isinstance(one.keys, WormSpec):
            table["axial_thinning"] = one.thing.thread.worm.thinning
    page = worm_page.sheet(table)
    keys = part.keys
    assert isinstance(keys, WormSpec | WormWheelSpec)
    hand, grade = _hand(keys.hand), _grade(keys.accuracy)
    if isinstance(keys, WormSpec):
        first = rows_of(page, ("axial_module", "number_of_starts", "worm_form", "lead_angle_deg"))
        own = rows_of(page, _WORM)
        last = rows_of(page, ("worm_reference_diameter", "diameter_quotient", "lead", "worm_centre_distance"))
        return DataTable(((*first, hand, *own, *grade), _control(page, keys.accuracy), (*last, *_mates(mates))))
    first = rows_of(page, ("axial_module", "worm_wheel_teeth"))
    own = rows_of(page, ("profile_shift_coefficient", *_WORM))
    last = rows_of(page, ("worm_centre_distance", "wheel_reference_diameter", "worm_form", "number_of_starts"))
    return DataTable(((*first, hand, *own, *grade), (), (*last, *_mates(mates)[1:])))


def _hand(hand: str) -> DataRow:
    return DataRow(N_("direction of the tooth line"), "", _HANDS[hand])


def _grade(accuracy: AccuracyTable | None) -> tuple[DataRow, ...]:
    """The accuracy grade, where one is given."""
    if accuracy is None:
        return ()
    return (DataRow(N_("accuracy grade"), "", f"{accuracy.grade} {accuracy.source}"),)


def _control(page: Sheet, accuracy: AccuracyTable | None) -> tuple[DataRow, ...]:
    """What is measured on the teeth: the first of the ways that the calculation has and the face is wide enough for."""
    steps = {step.name: step.value for step in page.steps()}
    wide = float(steps.get("face_width", 0.0)) >= float(steps.get("secure_face_width", 0.0))
    for names in _CONTROLS:
        rows = rows_of(page, names)
        if len(rows) == len(names) and (wide or names[-1] not in _SPANS):
            limits = None if accuracy is None else accuracy.deviations
            return (*rows[:-1], replace(rows[-1], deviations=limits and (max(limits), min(limits))))
    return ()


def _mates(mates: Sequence[Mated]) -> list[DataRow]:
    """Teeth and drawing of each mate; alike ones once."""
    rows: dict[tuple[object, ...], DataRow] = {}
    for mate in mates:
        keys = mate.part.keys
        teeth = getattr(keys, "number_of_starts" if isinstance(keys, WormSpec) else "number_of_teeth")
        name: Text = N_("number of starts of the worm") if isinstance(keys, WormSpec) else N_("teeth of the mate")
        rows["teeth", teeth] = DataRow(name, "z", teeth)
        drawing = getattr(keys, "designation", None) or mate.part.title or mate.part.id
        rows["drawing", drawing] = DataRow(N_("drawing of the mate"), "", drawing)
    return list(rows.values())
