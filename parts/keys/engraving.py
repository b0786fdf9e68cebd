"""What is engraved in an upper face: a mark at tooth 1 and the number of teeth, so that turns can be counted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

from msgspec import Struct

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.nearest import nearest
from geometry.base.record import replace
from geometry.curves.line_arc import Arc
from parts.keys.base import mm

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile

Depth = Annotated[float, mm("depth of the engraving", least=0.01, most=100)]
# clockwise boundaries of what is engraved, and their depths, mm
Marks = Sequence["tuple[Profile, float]"]
# of the room between a wheel's inner and outer circle: the mark, and what is left clear at its ends
_MARK, _CLEAR = 0.3, 0.08
# of digits, mm, the least and the most where no key says it; of that height, the width of the mark
_LEAST_HEIGHT, _MOST_HEIGHT, _WIDE = 0.1, 8.0, 1 / 8

_HEIGHT = mm("height of the digits; default: as the room allows", least=_LEAST_HEIGHT, most=1000, example=2.0)


class ToothMarkTable(Struct, forbid_unknown_fields=True):
    """A mark at tooth 1 (of a ring: at space 1) and the number of teeth, engraved in the upper face."""

    depth: Depth = 0.4
    height: Annotated[float, _HEIGHT] | None = None


def check_depth(key: str, depth: float, thickness: float) -> None:
    """Half of the thickness is left under what is engraved."""
    if depth > thickness / 2:
        raise ParameterError(f"{key}.depth", depth, "engraved_too_deep", limit(thickness / 2, depth))


def tooth_mark(
    table: ToothMarkTable | None, number: int, room: tuple[float, float], thickness: float, *, inside: bool = False
) -> Marks:
    """Slots along +x between two radii, mm, that are material all around; ``inside``: the teeth stand there.

    Raises
    ------
    ParameterError
        The digits are too high for the room, or the slots too deep.
    """
    if table is None:
        return ()
    from geometry.solids.engraving import digits, half_size
    from geometry.solids.plate import PlateSlot

    check_depth("tooth_mark", table.depth, thickness)
    low, high = room
    wide, clear = high - low, _CLEAR * (high - low)
    length = _MARK * wide

    def fits(height: float) -> bool:
        half = half_size(number, height)
        foot = low + (length + 2 * clear if inside else clear)
        top = abs(complex(foot + 2 * half.imag, half.real))
        return top <= high - clear and 2 * half.imag <= wide - length - 3 * clear

    if not fits(_LEAST_HEIGHT):
        raise ParameterError("tooth_mark.depth", table.depth, "no_room_for_digits", Nearest(None))
    height = table.height
    if height is None:
        height = next(h for k in range(99) if fits(h := min(wide, _MOST_HEIGHT) * 0.9**k))
    elif not fits(height):
        given = height
        raise ParameterError(
            "tooth_mark.height", given, "no_room_for_digits", lambda: nearest(fits, given, _LEAST_HEIGHT)
        )
    half, stroke = half_size(number, height).imag, _WIDE * height
    # the mark at the teeth, the digits on the other side of it
    start = low + clear if inside else high - clear - length
    middle = start + length + clear + half if inside else start - clear - half
    mark = PlateSlot(complex(start + stroke / 2), complex(start + length - stroke / 2), stroke)
    return tuple((slot.profile(0.0), table.depth) for slot in (mark, *digits(number, height, complex(middle), 1 + 0j)))


def digits_height(section: OffsetRegion) -> float:
    """How high the digits of a section's mark are, mm."""
    mark = section.region.marks[0]
    return min(2 * s.curve.radius for s in mark.period if isinstance(s.curve, Arc)) / _WIDE


def marked(section: OffsetRegion, marks: Marks) -> OffsetRegion:
    """A section with what is engraved in it, which no offset moves."""
    return replace(section, region=replace(section.region, marks=tuple(profile for profile, _ in marks)))
