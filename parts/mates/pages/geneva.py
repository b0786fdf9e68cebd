"""``higherpair calc geneva``: steps and rests of a Geneva drive, velocity and acceleration of its wheel."""

from __future__ import annotations

import math
from typing import Annotated, Any

import numpy as np
from msgspec import Meta

from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.gears.pins.geneva import Geneva, GenevaDisc, GenevaWheel, checked_disc
from parts.base.texts import N_, Words, in_context
from parts.keys.base import size
from parts.mates.pages.contour_marks import checked_picture
from parts.mates.pages.lever_picture import paneled, together
from parts.pages.inputs import SceneKeys, calculation, chosen_part, given
from parts.pages.page import Sheet
from parts.pins.geneva_driver import GenevaDriverSpec
from parts.pins.geneva_wheel import GENEVA_WHEEL, GenevaWheelSpec

TOPIC = "geneva"
_ARTOBOLEVSKY, _BICKFORD = "Artobolevsky", "Bickford"
# places of a diagram
_PLACES = 3601


class GenevaKeys(GenevaWheelSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the wheel, the driver's pins and speed, and how fine its table is."""

    number_of_pins: Annotated[int, Meta(ge=1, le=5, description="even pins: steps of the wheel in a turn")] = 1
    speed_rpm: Annotated[float, size("rpm", "speed of the driver", above=0, most=1e6, example=60.0)] | None = None
    rows: Annotated[int, Meta(ge=3, le=2000, description="rows of the table of a motion")] = 25
    picture: Annotated[str, Meta(description="SVG file of the diagrams to write")] | None = None


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of the one wheel of a scene, or of the one that ``part`` names, with the pins of its driver."""
    fitting = [key for key, spec in scene.parts.items() if isinstance(spec, GenevaWheelSpec)]
    name = chosen_part("geneva_wheel", fitting, fitting, source, table)
    drivers = [spec for spec in scene.parts.values() if isinstance(spec, GenevaDriverSpec) and spec.of == name]
    pins = {"number_of_pins": max(spec.number_of_pins for spec in drivers)} if drivers else {}
    return given(scene.parts[name]) | pins | table


@calculation(TOPIC, GenevaKeys)
def sheet(keys: GenevaKeys) -> Sheet:
    """The calculation of a drive."""
    checked_picture(TOPIC, keys.picture, (".svg",))
    wheel = GENEVA_WHEEL.thing(keys, {})
    drive = checked_disc(GenevaDisc(wheel, keys.number_of_pins)).drive
    page = Sheet(TOPIC, N_("Geneva drive"), picture_file=keys.picture)
    _given(page, wheel, drive)
    _sizes(page, wheel)
    _time(page, drive)
    _motion(page, drive)
    if keys.speed_rpm is not None:
        _speed(page, drive, keys.speed_rpm)
    _table(page, drive, keys.rows)
    page.picture = GenevaPicture(drive)
    page.note(N_("the pin enters along the slot: the velocity does not jump; the acceleration jumps to ε_0"))
    return page


def _given(page: Sheet, wheel: GenevaWheel, drive: Geneva) -> None:
    page.section(N_("Given"))
    page.add("number_of_slots", drive.number_of_slots)
    page.add("number_of_pins", drive.number_of_pins, called=in_context("geneva", "number of pins"))
    page.add("working_centre_distance", drive.centre_distance)
    radius = in_context("geneva", "radius of a pin")
    page.add("pin_radius", wheel.pin_diameter / 2, symbol="r_p", key="r_p", called=radius)
    page.told(
        slot_clearance=wheel.slot_clearance, end_clearance=wheel.end_clearance,
        locking_radius=wheel.locking_radius, locking_clearance=wheel.locking_clearance,
        tip_rounding_radius=wheel.tip_rounding,
    )  # fmt: skip


def _sizes(page: Sheet, wheel: GenevaWheel) -> None:
    drive, sign = wheel.drive, "+" if wheel.drive.internal else "-"
    page.section(N_("Sizes"))
    page.add("half_slot_angle_deg", math.degrees(drive.half_slot_angle), "pi / {n}", _ARTOBOLEVSKY)
    page.add("crank_radius", drive.crank_radius, "{a_w} * sin({beta})", _ARTOBOLEVSKY)
    page.add("mouth_radius", drive.mouth_radius, "{a_w} * cos({beta})", _ARTOBOLEVSKY)
    page.add("deepest_radius", drive.deepest_radius, f"{{a_w}} {sign} {{r}}")
    page.add("slot_width", 2 * wheel.half_width, "2 * {r_p} + {c_s}")
    page.add("slot_end_radius", wheel.slot_end + drive.sense * wheel.half_width, f"{{e}} {sign} ({{r_p}} + {{c_e}})")
    corner = "sqrt({b}**2 + ({w} / 2 + {f})**2)"
    page.add("tip_radius", wheel.tip_radius, f"{corner} {'-' if drive.internal else '+'} {{f}}")
    page.add("locking_arc_radius", wheel.arc_radius, "{s} + {c_l}")


def _time(page: Sheet, drive: Geneva) -> None:
    sign = "+" if drive.internal else "-"
    page.section(N_("Motion and rest"))
    page.add("half_motion_angle_deg", math.degrees(drive.half_motion_angle), f"pi / 2 {sign} {{beta}}", _ARTOBOLEVSKY)
    page.add("dwell_angle_deg", math.degrees(drive.dwell_angle), "2 * pi / {N} - 2 * {alpha_0}")
    share = drive.motion_share
    page.add("motion_share", share, f"{{N}} * ({{n}} {sign} 2) / (2 * {{n}})", _ARTOBOLEVSKY)
    page.add("motion_to_dwell", share / (1 - share), "{k} / (1 - {k})")
    page.add("pin_limit", math.pi / drive.half_motion_angle, f"2 * {{n}} / ({{n}} {sign} 2)", _ARTOBOLEVSKY)


def _motion(page: Sheet, drive: Geneva) -> None:
    sign = "+" if drive.internal else "-"
    page.section(N_("Velocity and acceleration of the wheel, for one of the driver"))
    ratio = abs(drive.ratio)
    page.add("geneva_ratio", ratio, "{r} / {a_w}")
    page.add("greatest_velocity_ratio", abs(float(drive.motion(0.0)[1])), f"{{lam}} / (1 {sign} {{lam}})", _BICKFORD)
    entry = abs(float(drive.motion(drive.half_motion_angle)[2]))
    page.add("entry_acceleration_ratio", entry, "tan({beta})", _BICKFORD)
    if drive.internal:
        page.note(N_("the acceleration is the greatest where the pin enters and leaves"))
        return
    alpha = drive.acceleration_angle
    square = "(1 + {lam}**2) / (4 * {lam})"
    page.add("acceleration_angle_deg", math.degrees(alpha), f"arccos(sqrt(({square})**2 + 2) - {square})", _BICKFORD)
    formula = "{lam} * (1 - {lam}**2) * sin({alpha_e}) / (1 - 2 * {lam} * cos({alpha_e}) + {lam}**2)**2"
    page.add("greatest_acceleration_ratio", abs(float(drive.motion(alpha)[2])), formula, _BICKFORD)


def _speed(page: Sheet, drive: Geneva, speed_rpm: float) -> None:
    page.section(N_("At this speed"))
    omega, turn = math.pi * speed_rpm / 30, 60 / speed_rpm
    page.add("crank_speed_rpm", speed_rpm)
    page.add("angular_velocity", omega, "pi * {n_1} / 30", symbol="ω_1", key="omega")
    share = drive.motion_share
    page.add("motion_time", share * turn / drive.number_of_pins, "60 * {k} / ({n_1} * {N})")
    page.add("dwell_time", (1 - share) * turn / drive.number_of_pins, "60 * (1 - {k}) / ({n_1} * {N})")
    fastest = abs(float(drive.motion(0.0)[1])) * omega
    called = in_context("geneva", "greatest angular velocity"), in_context("geneva", "greatest angular acceleration")
    page.add("greatest_angular_velocity", fastest, "{i_w} * {omega}", called=called[0])
    most, key = drive.greatest_acceleration, "i_e0" if drive.internal else "i_e"
    page.add("greatest_angular_acceleration", most * omega**2, f"{{{key}}} * {{omega}}**2", called=called[1])


def _table(page: Sheet, drive: Geneva, rows: int) -> None:
    alpha = np.linspace(-drive.half_motion_angle, drive.half_motion_angle, rows)
    turned, velocity, acceleration, jerk = drive.motion(alpha)
    columns = [np.degrees(alpha), np.degrees(turned), velocity, acceleration, jerk]
    heads = (("α", "deg"), ("φ_2", "deg"), ("ω_2/ω_1", ""), ("ε_2/ω_1²", ""), ("ε_2'/ω_1³", ""))
    title = N_("A motion: crank angle, turn of the wheel in its sense, its velocity, acceleration and jerk")
    page.table("motion", title, heads, zip(*columns, strict=True))


class GenevaPicture(Record):
    """Turn, velocity and acceleration of the wheel over a turn of the driver, rests included."""

    drive: Geneva

    def svg(self, words: Words) -> str:
        """The diagrams in a language."""
        angle, turned, velocity, acceleration = self.curves()
        fields = (
            (N_("Turn of the wheel, deg"), "φ_2", np.degrees(turned)),
            (N_("Its velocity over the driver's"), "ω_2/ω_1", velocity),
            (N_("Its acceleration over the square of that velocity"), "ε_2/ω_1²", acceleration),
        )
        degrees = np.degrees(angle)
        return paneled(
            [(title, list(together(degrees, ((name, values),), words))) for title, name, values in fields], words
        )

    def curves(self) -> tuple[Real, Real, Real, Real]:
        """Angle of the driver from where pin 1 is deepest, rad; turn of the wheel, velocity and acceleration."""
        drive = self.drive
        angle: Real = np.linspace(-math.pi, math.pi, _PLACES)
        step = 2 * math.pi / drive.number_of_pins
        alpha = angle - step * np.round(angle / step)
        _, velocity, acceleration, _ = drive.motion(alpha)
        moves = np.abs(alpha) <= drive.half_motion_angle
        return angle, drive.wheel_turn(angle), np.where(moves, velocity, 0.0), np.where(moves, acceleration, 0.0)
