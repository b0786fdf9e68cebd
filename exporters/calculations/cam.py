"""``higherpair calc cam``: phases, coefficients, least sizes, and the table of motion and profile of a disk cam."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

import numpy as np
from msgspec import Meta

from exporters.calculations.cam_graphical import graphical_section
from exporters.calculations.cam_speed import speed_section
from exporters.calculations.inputs import checked, given, keys_of, refusal
from exporters.calculations.sheet import Sheet, Table
from exporters.calculations.words import TERMS
from geometry.cams.disk import DiskCam
from geometry.cams.follower_motion import Phase, PhaseKind
from geometry.cams.graphical import INTERVALS, LEAST_INTERVALS, MOST_INTERVALS
from geometry.cams.mounts import Translating
from geometry.cams.synthesis import (
    flat_base_radius,
    greatest_pressure_angle,
    least_convex_radius,
    roller_prime_radius,
)
from geometry.errors import ParameterError
from parts.cam import CamSpec, base_radius, checked_cam
from parts.schema import SceneError, near

TOPIC = "cam"
_LAWS = {
    "constant velocity": "стала швидкість",
    "constant acceleration": "стале прискорення",
    "linearly decreasing acceleration": "лінійно спадне прискорення",
    "cosine acceleration": "косинусоїдальне прискорення",
    "sine acceleration": "синусоїдальне прискорення",
    "trapezoidal acceleration": "трапецеїдальне прискорення",
    "triangular acceleration": "трикутне прискорення",
    "modified trapezoid": "модифікована трапеція",
    "modified sine": "модифікована синусоїда",
    "3-4-5 polynomial": "поліном 3-4-5",
    "4-5-6-7 polynomial": "поліном 4-5-6-7",
    "Gutman 1-3": "закон Гутмана 1-3",
}
_ANGLES = {
    "rise": "rise_angle_deg",
    "far": "far_dwell_angle_deg",
    "return": "return_angle_deg",
    "near": "near_dwell_angle_deg",
}
_LESSON_4, _LESSON_5 = "practicum, lesson 4", "practicum, lesson 5"


class CamKeys(CamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the topic: those of a cam, and the step of its table."""

    step: Annotated[
        float, Meta(ge=0.1, le=90, description="step of the table over the cam angle", extra={"unit": "degrees"})
    ] = 10.0
    intervals: Annotated[
        int, Meta(ge=LEAST_INTERVALS, le=MOST_INTERVALS, description="of each phase in the graphical method")
    ] = INTERVALS
    drawing: Annotated[
        Literal["smooth", "chords"], Meta(description="S' of the graphical method: a smooth curve or a broken line")
    ] = "smooth"
    speed_rpm: (
        Annotated[float, Meta(gt=0, le=1e6, description="of the cam: adds velocities", extra={"unit": "rpm"})] | None
    ) = None


def table_from(scene: Any, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a cam of a scene, changed by those of the command line."""
    cams = [key for key, spec in scene.parts.items() if isinstance(spec, CamSpec)]
    part = table.pop("part", None)
    if part is None and len(cams) != 1:
        raise SceneError(source, "parts", None, f"has {len(cams)} cams: {', '.join(cams)}; add part=ID")
    if part is not None and part not in cams:
        raise SceneError(source, "part", part, f"no such cam{near(part, cams)}; cams: {', '.join(cams)}")
    return given(scene.parts[part or cams[0]]) | table


def sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of one cam."""
    if "part" in table:
        raise SceneError(
            "calc", "part", table["part"], f"names a part of a scene{near('part', keys_of(CamKeys))}; remove it"
        )
    keys: CamKeys = checked(table, CamKeys, TOPIC)
    try:
        cam = checked_cam(keys)
    except ParameterError as error:
        raise refusal(TOPIC, error) from error
    page = Sheet(TOPIC, ("Disk cam", "Плоский кулачок"))
    _characteristics(page, keys, cam)
    _coefficients(page, cam)
    _sizes(page, keys, cam)
    page.data["phases"] = [
        {"move": name, "angle_deg": math.degrees(phase.angle), "law": phase.law.name if phase.law else None}
        for name, phase in _phase_names(cam)
    ]
    page.tables.append(_positions(cam, keys.step))
    graphical_section(page, cam, keys.least_transmission_angle_deg, keys.intervals, keys.drawing)
    if keys.speed_rpm is not None:
        speed_section(page, cam, keys.speed_rpm)
    _impacts(page, cam)
    return page


def _characteristics(page: Sheet, keys: CamKeys, cam: DiskCam) -> None:
    """The characteristics table of the sheets: H, phases, E, gamma_min."""
    page.section("Characteristics", "Характеристика кулачка")
    swings = keys.oscillating is not None
    if swings:
        page.add("swing_deg", math.degrees(cam.motion.lift))
    else:
        page.add("lift", cam.motion.lift)
    index = {"rise": 0, "far": 0, "return": 0, "near": 0}
    counts = _phase_names(cam)
    for name, phase in counts:
        index[name] += 1
        many = sum(other == name for other, _ in counts) > 1
        term = _ANGLES[name]
        symbol = f"{TERMS[term].symbol}{index[name]}" if many else ""
        page.add(term, math.degrees(phase.angle), symbol=symbol)
    if not swings:
        page.add("follower_offset", keys.follower_offset)
    if keys.least_transmission_angle_deg is not None:
        page.add("least_transmission_angle_deg", keys.least_transmission_angle_deg)
    if cam.radius:
        page.add("follower_radius", cam.radius)


def _phase_names(cam: DiskCam) -> list[tuple[str, Phase]]:
    """Every phase as rise, far, return or near; a dwell is far above half of the lift."""
    found, height = [], 0.0
    for phase in cam.motion.phases:
        if phase.kind is PhaseKind.DWELL:
            found.append(("far" if height > cam.motion.lift / 2 else "near", phase))
        else:
            found.append(("rise" if phase.kind is PhaseKind.RISE else "return", phase))
        height += phase.lift
    return found


def _coefficients(page: Sheet, cam: DiskCam) -> None:
    """Law, h and the peaks of each moving phase: S'_max = C_v h / phi, S''_max = C_a h / phi^2."""
    swings = not isinstance(cam.mount, Translating)
    titles = {"rise": ("Rise", "Віддалення"), "return": ("Return", "Наближення")}
    for name, phase in _phase_names(cam):
        if phase.law is None:
            continue
        en, uk = titles[name]
        law = phase.law.name
        page.section(f"{en}: {law}", f"{uk}: {_LAWS.get(law, 'власна діаграма прискорення')}")
        angle, h = math.degrees(phase.angle), abs(phase.lift)
        page.add(_ANGLES[name], angle, key="phi")
        if swings:
            page.add("swing_of_phase_deg", math.degrees(h))
        else:
            page.add("lift_of_phase", h)
        speed = max(map(abs, phase.law.peak(1)))
        bend = max(map(abs, phase.law.peak(2)))
        page.add("velocity_coefficient", speed)
        page.add("acceleration_coefficient", bend)
        if not swings:
            page.add("peak_velocity", speed * h / phase.angle, "{c_v} * {h} / {phi}", _LESSON_4)
            page.add("peak_acceleration", bend * h / phase.angle**2, "{c_a} * {h} / {phi}**2", _LESSON_4)


def _sizes(page: Sheet, keys: CamKeys, cam: DiskCam) -> None:
    """Least radius by the pressure angle or the curvature, and what the cam has."""
    page.section("Sizes", "Розміри")
    asked = keys.least_transmission_angle_deg
    if isinstance(cam.mount, Translating):
        if cam.is_flat:
            page.add("least_base_radius", flat_base_radius(cam.motion).value, "", _LESSON_4)
        elif asked is not None:
            least = roller_prime_radius(cam.motion, keys.follower_offset, math.radians(90 - asked))
            page.add("least_base_radius", least, "", _LESSON_5)
    if keys.least_curvature_radius:
        page.add("curvature_reserve", keys.least_curvature_radius)
    base = base_radius(cam)
    derived = cam.is_flat and keys.base_circle_radius is None and keys.least_curvature_radius > 0
    exact = derived and abs(base - flat_base_radius(cam.motion).value - keys.least_curvature_radius) < 1e-12 * base
    page.add("least_cam_radius", base, "{r_0} + {rho}" if exact else "", _LESSON_4 if exact else "")
    if isinstance(cam.mount, Translating):
        page.add("initial_height", cam.mount.start_height)
    for kind, name in ((PhaseKind.RISE, "rise"), (PhaseKind.RETURN, "return")):
        if cam.motion.moving_pieces(kind):
            page.add(f"pressure_angle_{name}_deg", math.degrees(greatest_pressure_angle(cam, kind).value))
    if not cam.is_flat and cam.motion.moving_pieces(PhaseKind.RISE):
        steep = math.degrees(greatest_pressure_angle(cam, PhaseKind.RISE).value)
        page.add("transmission_angle_reached_deg", 90 - steep, "", _LESSON_5)
    page.add("least_curvature_radius", least_convex_radius(cam).value)
    if isinstance(cam.mount, Translating) and cam.kind in ("flat", "mushroom"):
        page.add("least_plate_diameter", cam.least_plate_diameter())


def _positions(cam: DiskCam, step: float) -> Table:
    """phi, S, S', S'', pressure angle, radius of curvature, profile: at every step and where a phase begins."""
    joints = [math.degrees(piece.start) for piece in cam.motion.pieces]
    grid = np.arange(math.ceil(360 / step - 1e-9)) * step
    own = [a for a in joints if np.abs(grid - a).min() > 1e-9]
    degrees = np.sort(np.concatenate([grid, own]))
    angle = np.radians(degrees)
    # a step that meets a joint but for rounding stands on it, and reads what follows
    starts = np.array([piece.start for piece in cam.motion.pieces])
    close = np.abs(angle[:, None] - starts).argmin(axis=1)
    angle = np.where(np.abs(angle - starts[close]) < 1e-12, starts[close], angle)
    swings = not isinstance(cam.mount, Translating)
    unit = 180 / math.pi if swings else 1.0
    u = "deg" if swings else "mm"
    profile = cam.profile_point(angle)
    motion = [cam.motion.value(angle, k) * unit for k in range(3)]
    slope, bend = np.degrees(cam.pressure_angle(angle)), cam.curvature_radius(angle)
    columns = [degrees, *motion, slope, bend, profile.real, profile.imag]
    heads = (("phi", "deg"), ("S", u), ("S'", f"{u}/rad"), ("S''", f"{u}/rad2"), ("nu", "deg"), ("rho", "mm"),
             ("x", "mm"), ("y", "mm"))  # fmt: skip
    rows = tuple(tuple(float(x) for x in row) for row in zip(*columns, strict=True))
    title = ("Positions: cam angle, motion, pressure angle, radius of curvature, profile",
             "Положення: кут повороту, рух штовхача, кут тиску, радіус кривини, координати профілю")  # fmt: skip
    return Table("positions", title, heads, rows)


def _impacts(page: Sheet, cam: DiskCam) -> None:
    page.notes.append(
        ("at the joint of two phases the table holds the values of the one that begins",
         "на межі двох фаз у таблиці подано значення тієї, що починається")
    )  # fmt: skip
    names = {"rigid": ("rigid", "жорсткий"), "soft": ("soft", "м'який")}
    for joint in cam.motion.impacts():
        if joint.impact is not None:
            en, uk = names[joint.impact]
            angle = f"{math.degrees(joint.angle):.6g}"
            page.notes.append((f"{en} impact at cam angle {angle} degrees", f"{uk} удар при куті повороту {angle}°"))
