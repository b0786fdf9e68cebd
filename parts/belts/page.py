"""``higherpair calc pulley``: circles and grooves of a pulley for a timing belt by its standard."""

from __future__ import annotations

from parts.base.texts import N_
from parts.belts.pulley import TIMING_PULLEY, TimingPulleySpec
from parts.belts.steps import belt_steps, circle_steps, groove_steps
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "pulley"
table_from = part_of_kind("timing_pulley")


class PulleyKeys(TimingPulleySpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the pulley."""


@calculation(TOPIC, PulleyKeys)
def sheet(keys: PulleyKeys) -> Sheet:
    """The calculation of a pulley."""
    pulley = TIMING_PULLEY.thing(keys, {})
    page = Sheet(TOPIC, N_("Pulley for a timing belt"))
    page.section("Given")
    page.add("number_of_teeth", pulley.number_of_teeth)
    belt_steps(page, pulley.belt)
    page.section("Sizes")
    circle_steps(page, pulley)
    page.section(N_("Grooves"))
    groove_steps(page, pulley)
    page.notes += [finding_message(f) for f in TIMING_PULLEY.report(keys, pulley).findings]
    return page
