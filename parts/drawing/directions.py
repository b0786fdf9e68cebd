"""Words on where holes, spokes and keyways stand about the axis: what the sizes of a drawing do not tell."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry.solids.bores import KeywayBore, RoundBore
from geometry.solids.hub_holes import HubHoles
from geometry.solids.spline_fits import greatest_tip, side_limits
from geometry.solids.splines import InvoluteJoint, SplineBore, StraightJoint
from geometry.solids.zones import side_symmetry, zone_limits
from parts.drawing.places import apart, circled
from parts.drawing.working import Subject

# rad: what is one direction
_SAME = 1e-9
# um: what a limit that is told in um is off by
_ROUNDED = 1e-6
# of a bore where no key turns it
_USUAL = math.pi / 2
# words for what stands in the very direction
_ALONG = {"keyway_at": "keyway_along", "flat_at": "flat_along", "spline_at": "spline_along", "axis_at": "axis_along"}


def directions(
    holes: HubHoles, subject: Subject, zero: str, teeth: int = 0, *, all_circled: bool = False
) -> tuple[str, ...]:
    """Lines of requirements; nothing of what stands where it would without a word.

    ``zero``: the key of the words for +x of the part, empty where it is round; ``teeth``: how many stand about it, any
    of which is as good as the first; ``all_circled``: the views tell no hole by its distances from their axes.
    """
    bore, found = holes.bore, list[str]()
    if isinstance(bore, SplineBore):
        found += spline_data(bore, subject, is_shaft=False)

    def tell(key: str, angle: float, count: int, start: str, **sizes: object) -> None:
        step = math.tau / max(count, 1)
        turn = math.degrees(angle % step if step - angle % step > _SAME else 0.0)
        begins, told = subject.words(start, size=first), subject.say(turn)
        words = _ALONG.get(key, key) if told == "0" else key
        found.append(subject.words(words, angle=told, zero=begins, **sizes))

    groups, alone = (holes.round_holes, ()) if all_circled else (circled(holes), apart(holes))
    first = subject.say(groups[0].pitch_circle_diameter) if groups else ""

    begin, start = 0.0, zero
    if bore is not None and not isinstance(bore, RoundBore):
        turn = bore.angle
        kind = "keyway" if isinstance(bore, KeywayBore) else "spline" if isinstance(bore, SplineBore) else "flat"
        if zero and (not teeth or abs(turn - _USUAL) > _SAME):
            tell(f"{kind}_at", turn, teeth, zero)
        if teeth or not zero:
            begin, start = turn, f"zero_{kind}"
    if not start and groups:
        begin, start = groups[0].start, "zero_group"
    # the axes of a view stand about its bore as they are drawn
    if alone and start not in ("", "zero_x", "zero_keyway", "zero_flat", "zero_spline"):
        tell("axis_at", -begin, teeth if start == zero else groups[0].count, start)
    for group in groups if start else ():
        if _turned(group.start - begin, group.count):
            key = "holes_at" if group.count > 1 else "hole_at"
            size = subject.say(group.diameter)
            if sum(other.diameter == group.diameter for other in groups) > 1:
                circle = subject.say(group.pitch_circle_diameter)
                size = subject.words("on_circle", size=size, circle=circle)
            tell(key, group.start - begin, group.count, start, size=size)
    if start and holes.spokes is not None and _turned(holes.spokes.start - begin, holes.spokes.count):
        tell("spokes_at", holes.spokes.start - begin, holes.spokes.count, start)
    return tuple(found)


def _turned(angle: float, count: int) -> bool:
    """Whether the first of so many stands off the direction in which they would without a word."""
    step = math.tau / count
    return min(angle % step, step - angle % step) > _SAME


def spline_data(bore: SplineBore, subject: Subject, *, is_shaft: bool) -> tuple[str, ...]:
    """What an involute spline is made by, and the limits of sizes with a zone of tolerance."""
    joint = bore.joint
    zones = [(fit.symbol, fit.size, zone) for fit in joint.fits if (zone := fit.zone(is_shaft))]
    sizes = [f"{symbol} {_span(subject, [size + x for x in zone_limits(zone, size)])}" for symbol, size, zone in zones]
    lines = (subject.words("spline_limits", sizes="; ".join(sizes)),) if sizes else ()
    if isinstance(joint, InvoluteJoint):
        return *_involute(joint, bore, subject, is_shaft=is_shaft), *lines
    symmetry = subject.words("spline_symmetry", size=subject.say(side_symmetry(joint.width)))
    return (*lines, symmetry) if joint.fits else ()


def tip_zone(joint: StraightJoint | InvoluteJoint, usual: str) -> str:
    """The zone of D of a shaft, by its designation, or as usual of teeth that it centres; none of other ones."""
    for fit in joint.fits:
        if fit.symbol == "D" and fit.shaft:
            return fit.shaft
    return usual if isinstance(joint, StraightJoint) and joint.centring == "outer" else ""


def _involute(joint: InvoluteJoint, bore: SplineBore, subject: Subject, *, is_shaft: bool) -> tuple[str, ...]:
    """What an involute spline is made by."""
    measured = joint.measured(-bore.clearance if is_shaft else bore.clearance, is_shaft=is_shaft)
    pin = measured.pin_diameter
    limits = side_limits(joint, is_shaft=is_shaft)
    thickness, size = subject.say(measured.thickness), subject.say(measured.over_pins)
    if limits is not None:
        pinned = [joint.of_width(width, is_shaft=is_shaft, pin_diameter=pin).over_pins for width in limits.actual]
        thickness, size = _span(subject, limits.actual), _span(subject, pinned)
    line = subject.words(
        "involute_shaft" if is_shaft else "involute_hub",
        name=subject.words(f"spline_{joint.standard}", name=joint.named(is_shaft=is_shaft)),
        module=subject.say(joint.module),
        teeth=joint.teeth,
        angle=subject.say(math.degrees(joint.pressure_angle)),
        thickness=thickness,
        pin=subject.say(pin),
        size=size,
    )
    if limits is None:
        return (line,)
    near = subject.say(_inwards(limits.effective)[1 if is_shaft else 0])
    told = line, subject.words("effective_tooth" if is_shaft else "effective_space", thickness=near)
    if (tip := greatest_tip(joint, limits)) is None:
        return told
    return *told, subject.words("greatest_tip", size=subject.say(_inwards((tip, tip))[1]))


def _inwards(limits: Sequence[float]) -> tuple[float, float]:
    """Both limits in whole um, none of them wider than it is."""
    return math.ceil(limits[0] * 1000 - _ROUNDED) / 1000, math.floor(limits[1] * 1000 + _ROUNDED) / 1000


def _span(subject: Subject, limits: Sequence[float]) -> str:
    """Both limits of a size."""
    return "…".join(map(subject.say, _inwards(limits)))
