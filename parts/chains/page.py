"""``higherpair calc sprocket``: circles, gap, widths and measurement of a sprocket by its standard."""

from __future__ import annotations

from parts.base.texts import N_
from parts.chains.sprocket import SPROCKET, SprocketSpec
from parts.chains.steps import chain_steps, circle_steps, gap_steps, measured_steps, width_steps
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "sprocket"
table_from = part_of_kind("sprocket")


class SprocketKeys(SprocketSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the sprocket."""


@calculation(TOPIC, SprocketKeys)
def sheet(keys: SprocketKeys) -> Sheet:
    """The calculation of a sprocket."""
    sprocket = SPROCKET.thing(keys, {})
    page = Sheet(TOPIC, N_("Sprocket for a roller chain"))
    page.section("Given")
    page.add("number_of_teeth", sprocket.number_of_teeth)
    chain_steps(page, sprocket.chain)
    page.section("Sizes")
    circle_steps(page, sprocket)
    page.section("Tooth gap")
    gap_steps(page, sprocket)
    page.section("Across the chain")
    width_steps(page, sprocket)
    page.section("Measurement")
    measured_steps(page, sprocket)
    page.notes += [finding_message(f) for f in SPROCKET.report(keys, sprocket).findings]
    return page
