"""``higherpair calc thread``: sizes of an external metric thread, and the limits of its diameters."""

from __future__ import annotations

import math

from msgspec import Struct

from parts.base.texts import N_
from parts.keys.threads import Thread, thread_of, thread_words
from parts.pages.inputs import calculation
from parts.pages.page import Sheet

TOPIC = "thread"


class ThreadKeys(Struct, kw_only=True, forbid_unknown_fields=True):
    """Keys of the thread."""

    thread: Thread


@calculation(TOPIC, ThreadKeys)
def sheet(keys: ThreadKeys) -> Sheet:
    """The calculation of an external metric thread."""
    thread = thread_of(keys.thread)
    page = Sheet(TOPIC, N_("External metric thread"))
    page.section("Given")
    page.add("thread_designation", f"M{thread.diameter:g}{thread_words(thread, f'{thread.pitch:g}')}")
    page.add("thread_diameter", thread.diameter)
    page.add("thread_pitch", thread.pitch, source="ISO 261")
    page.section("Sizes")
    page.add("thread_triangle", thread.height, "sqrt(3) / 2 * {P}", "ISO 68-1")
    page.add("thread_pitch_diameter", thread.pitch_diameter, "{d} - 3 / 4 * {H}", "ISO 724")
    page.add("thread_minor_diameter", thread.minor_diameter, "{d} - 5 / 4 * {H}", "ISO 724")
    page.add("thread_root_diameter", thread.root_diameter, "{d} - 17 / 12 * {H}", "ISO 68-1")
    page.add("thread_lead_angle_deg", math.degrees(thread.lead_angle), "arctan({P} / (pi * {d_2}))")
    page.add("thread_stress_area", thread.stress_area, "pi / 16 * ({d_2} + {d_3})**2", "ISO 898-1")
    page.add("thread_root_area", thread.root_area, "pi / 4 * {d_3}**2")
    if (limits := thread.limits()) is None:
        return page
    page.section(N_("Limits of the thread"))
    page.add("thread_class", thread.tolerance)
    page.add("thread_deviation", limits.deviation, source="ISO 965-1")
    page.add("thread_major_tolerance", limits.tolerances[0], source="ISO 965-1")
    page.add("thread_pitch_tolerance", limits.tolerances[1], source="ISO 965-1")
    page.add("greatest_major_diameter", limits.major[1], "{d} + {es} / 1000")
    page.add("least_major_diameter", limits.major[0], "{d} + ({es} - {T_d}) / 1000")
    page.add("greatest_pitch_diameter", limits.pitch[1], "{d_2} + {es} / 1000")
    page.add("least_pitch_diameter", limits.pitch[0], "{d_2} + ({es} - {T_d2}) / 1000")
    return page
