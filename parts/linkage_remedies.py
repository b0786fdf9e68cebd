"""What helps a linkage cam that cannot be: the nearest value of a key with which it was tried and works."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from geometry.errors import GeometryError, ParameterError, UndercutError, format_value
from geometry.trial import is_trial
from parts.linkage_keys import DrivenRocker

if TYPE_CHECKING:
    from parts.linkage_cam import LinkageCamSpec

# steps away from a value that are tried, part of a length or of 180 degrees
_STEPS = (0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12, 0.18, 0.25, 0.35, 0.5, 0.7, 0.9, 0.98)
_LONGER = (1.5, 2.5, 4.0)
_MUCH_LONGER = (7.0, 12.0, 20.0, 35.0, 60.0, 100.0)
_DIRECTIONS, _BISECTIONS = 8, 14
Build = Callable[["LinkageCamSpec"], Any]
Check = Callable[["LinkageCamSpec", Any], None]


@dataclass(frozen=True, slots=True)
class Knob:
    """A key that may be turned: its name and value, the scene with another one, which ones to try, and its unit."""

    name: str
    value: Any
    turned: Callable[[Any], LinkageCamSpec]
    trials: Callable[[], Iterator[Any]]
    unit: str = ""
    # whether what lies between may be nearer
    halved: bool = True


def refusal_of(spec: LinkageCamSpec, refusal: ParameterError, build: Build, check: Check) -> ParameterError:
    """A refusal under the key that cures it, with the nearest value found; others are as they are.

    ``build`` makes the cam, ``check`` holds the rest of the part against it.
    """
    from geometry.cams.linkage_cam import LinkageError

    if not isinstance(refusal, LinkageError | UndercutError):
        name = {"radius": "follower_radius"}.get(refusal.name, refusal.name)
        return ParameterError(name, refusal.value, refusal.allowed)
    undercut = isinstance(refusal, UndercutError)
    knobs = _knobs(spec)["undercut" if undercut else refusal.name]
    reason = refusal.allowed.split(";")[0]
    kind = UndercutError if undercut else ParameterError
    partly: ParameterError | None = None
    if is_trial():
        return kind(knobs[0].name, knobs[0].value, reason)
    for knob in knobs:
        if (found := _nearest(knob, build, check)) is None:
            continue
        text, other = found
        if other is None:
            return kind(knob.name, knob.value, f"{reason}; {text} works")
        partly = partly or kind(knob.name, knob.value, f"{reason}; {text} works with another {other}")
    if partly is not None:
        return partly
    both = _together(spec, knobs, build, check)
    return kind(knobs[0].name, knobs[0].value, f"{reason}; {both or 'no other value near it helps'}")


def _together(spec: LinkageCamSpec, knobs: list[Knob], build: Build, check: Check) -> str | None:
    """The direction or the first key that may be turned, along with a smaller travel, where neither helps alone."""
    first = next((k for k in knobs if k.name == "follower_direction_deg"), knobs[0])
    for second in _travel(spec):
        for travel in [*second.trials()][3::3]:
            less = second.turned(travel)
            turned = {k.name: k for found in _knobs(less).values() for k in found}[first.name]
            for value in turned.trials():
                try:
                    changed = turned.turned(value)
                    check(changed, build(changed))
                except (GeometryError, ArithmeticError):
                    continue
                told = f"{first.name} = {_shown(value)}, {second.name} = {_shown(travel)}"
                return f"with {told} it works"
    return None


def _shown(value: Any) -> str:
    return format_value(list(value) if isinstance(value, tuple) else value)


def _knobs(spec: LinkageCamSpec) -> dict[str, list[Knob]]:
    """Which keys are turned for which refusal of the mathematics, the most natural one first."""
    travel, point = _travel(spec), _point(spec)
    start = [_start_angle(spec)] if isinstance(spec.driven, DrivenRocker) else []
    radius = [_radius(spec)] if spec.follower_radius else []
    turn = [_direction(spec)] if spec.follower == "flat" else []
    return {
        "coupler_length": [_length(spec), *travel, _sense(spec), *start, point],
        "direction": [_direction(spec)],
        "sense": [*turn, _sense(spec)],
        "point": [*radius, *turn, *start, point],
        "lift": [*travel, *turn, *start, point],
        "near": [_length(spec), *travel, *turn, *start, point],
        "undercut": [*radius, *travel, *turn, *start, point],
    }


def _nearest(knob: Knob, build: Build, check: Check) -> tuple[str, str | None] | None:
    """The first trial that works, numbers brought nearer by halving; as it is printed, and the key that it breaks.

    A cam that its bore or its plate does not fit still is one, where no trial gives a whole part.
    """

    def works(value: Any, *, all_of_it: bool) -> bool:
        try:
            spec = knob.turned(value)
            cam = build(spec)
            if all_of_it:
                check(spec, cam)
        except (GeometryError, ArithmeticError):
            return False
        return True

    good, whole = None, False
    for trial in knob.trials():
        if works(trial, all_of_it=False):
            whole = works(trial, all_of_it=True)
            good = trial if whole or good is None else good
            if whole:
                break
    if good is None:
        return None
    other = None if whole else _broken(knob.turned(good), build, check)
    if isinstance(good, str):
        return f'"{good}"', other
    if not isinstance(good, float):
        return str([round(x, 6) for x in good]), other
    bad = knob.value
    for _ in range(_BISECTIONS if knob.halved else 0):
        middle = (bad + good) / 2
        bad, good = (bad, middle) if works(middle, all_of_it=whole) else (middle, good)
    # rounded away from what fails
    digits = 4
    shown = (math.floor if good < knob.value else math.ceil)(good * 10**digits) / 10**digits
    return f"{shown if works(shown, all_of_it=whole) else good:.12g}{knob.unit}", other


def _broken(spec: LinkageCamSpec, build: Build, check: Check) -> str:
    """The key of the part that a cam has no room for."""
    try:
        check(spec, build(spec))
    except ParameterError as refusal:
        return refusal.name
    return "bore_diameter"


def _around(value: float, scale: float) -> Iterator[float]:
    for step in _STEPS:
        yield value - step * scale
        yield value + step * scale


def _length(spec: LinkageCamSpec) -> Knob:
    def trials() -> Iterator[float]:
        yield from _around(spec.coupler_length, spec.coupler_length)
        yield from (spec.coupler_length * k for k in (*_LONGER, *_MUCH_LONGER))

    return Knob("coupler_length", spec.coupler_length, lambda v: replace(spec, coupler_length=v), trials, " mm")


def _travel(spec: LinkageCamSpec) -> list[Knob]:
    if spec.motion_table is not None:
        return []
    name = "swing_deg" if isinstance(spec.driven, DrivenRocker) else "lift"
    value: float = getattr(spec, name)
    unit = " degrees" if name == "swing_deg" else " mm"
    return [Knob(name, value, lambda v: replace(spec, **{name: v}), lambda: (value * (1 - k) for k in _STEPS), unit)]


def _radius(spec: LinkageCamSpec) -> Knob:
    value = spec.follower_radius
    return Knob(
        "follower_radius",
        value,
        lambda v: replace(spec, follower_radius=v),
        lambda: (value * (1 - k) for k in _STEPS),
        " mm",
    )


def _start_angle(spec: LinkageCamSpec) -> Knob:
    driven: Any = spec.driven
    value: float = driven.start_angle_deg
    return Knob(
        "driven.start_angle_deg",
        value,
        lambda v: replace(spec, driven=replace(driven, start_angle_deg=v)),
        lambda: (v for v in _around(value, 180.0) if -360 <= v <= 360),
        " degrees",
    )


def _point(spec: LinkageCamSpec) -> Knob:
    """The coupler point, moved in every direction."""
    at = complex(*spec.coupler_point)
    size = max(spec.coupler_length, abs(at))

    def trials() -> Iterator[tuple[float, float]]:
        for step in (*_STEPS[1::2], *_LONGER):
            for k in range(_DIRECTIONS):
                moved = at + cmath.rect(step * size, 2 * math.pi * k / _DIRECTIONS)
                yield round(moved.real, 4), round(moved.imag, 4)

    return Knob("coupler_point", list(spec.coupler_point), lambda v: replace(spec, coupler_point=v), trials)


def _direction(spec: LinkageCamSpec) -> Knob:
    value = spec.follower_direction_deg
    return Knob(
        "follower_direction_deg",
        value,
        lambda v: replace(spec, follower_direction_deg=v),
        lambda: (v for v in _around(value, 180.0) if -360 <= v <= 360),
        " degrees",
    )


def _sense(spec: LinkageCamSpec) -> Knob:
    """The other way round."""
    driven: Any = spec.driven
    if isinstance(driven, DrivenRocker):
        other = "clockwise" if driven.sense == "counter_clockwise" else "counter_clockwise"
        turned: Callable[[Any], LinkageCamSpec] = lambda v: replace(spec, driven=replace(driven, sense=v))  # noqa: E731
        return Knob("driven.sense", driven.sense, turned, lambda: iter((other,)))
    value = driven.direction_deg
    opposite = value - 180 if value > 0 else value + 180
    return Knob(
        "driven.direction_deg",
        value,
        lambda v: replace(spec, driven=replace(driven, direction_deg=v)),
        lambda: (v for k in (0.0, *_STEPS[:8]) for v in (opposite - 180 * k, opposite + 180 * k) if abs(v) <= 360),
        " degrees",
        halved=False,
    )
