"""What a sheet carries of a blocking contour: a picture, letters, json, the file to write."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from geometry.base.errors import Nearest
from geometry.base.record import Record
from geometry.gears.shifts.external import BlockingContour
from geometry.gears.shifts.finder import AnyShiftPair, Proposal
from geometry.gears.shifts.internal_shifts import InternalShiftPair
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.limits import Margin
from parts.base.refusal import SceneError
from parts.base.texts import ENGLISH, Message, listed, message, words
from parts.gears.spur_gear.page import section_data
from parts.mates.pages.pair_keys import ChoiceKeys
from parts.pages.contact_steps import face_steps
from parts.pages.contour_picture import ContourPicture, line_name
from parts.pages.inputs import PLACE
from parts.pages.page import Printed, Sheet

ENDINGS = (".svg", ".dxf")


def checked_picture(topic: str, name: str | None, endings: tuple[str, ...] = ENDINGS, key: str = "picture") -> None:
    """Refuse the file of a ``key`` that would be no picture, or no sheet.

    Raises
    ------
    SceneError
        The name ends in none of ``endings``, or its folder does not exist; names one that works.
    """
    if name is None:
        return
    file = Path(name)
    if file.suffix.lower() not in endings:
        stem = file.with_suffix("") if file.suffix else file
        works = Nearest((stem.parent / f"{stem.name or 'contour'}{endings[0]}").as_posix())
        raise SceneError(PLACE, f"{topic}.{key}", name, "file_ends_in", works, known=endings)
    if not file.parent.is_dir():
        raise SceneError(PLACE, f"{topic}.{key}", name, "no_such_folder", Nearest(file.name))


def margins_told(broken: Sequence[Margin]) -> Message:
    """The lines of a contour, or conditions, that are not kept; how far, where that is a number."""
    return listed(
        [
            line_name(m.name)
            if math.isnan(m.margin)
            else message("{line} ({margin:.4g})", line=line_name(m.name), margin=m.margin)
            for m in broken
        ]
    )


def show_given(page: Sheet, keys: ChoiceKeys, pair: AnyShiftPair, rack: BasicRack) -> str:
    """Teeth, section, ``rack`` of the normal section, face; the formula of the least shift without undercut."""
    page.section("Given")
    page.both("number_of_teeth", pair.teeth)
    page.add("gear_ratio", pair.gear_ratio, "{z2} / {z1}", "practicum (3.2)")
    section_data(page, keys.module, rack.pressure_angle, pair.helix_angle)
    if isinstance(pair, InternalShiftPair):
        page.both("addendum_coefficient", (rack.addendum, pair.ring_addendum))
    else:
        page.add("addendum_coefficient", rack.addendum)
    page.told(tip_clearance_coefficient=rack.tip_clearance, tip_radius_coefficient=rack.tip_radius)
    square = "sin({alpha})**2"
    if pair.helix_angle:
        face_steps(page, keys.face)
        square += " / cos({beta})"
    return f"({{h_a}} + {{c}} - {{rho_f}} * (1 - sin({{alpha_n}}))) - {{z#}} * {square} / 2"


class Choice(Record):
    """Shifts of one rule: its name, its source, and a misprint that was mended."""

    name: Message
    found: Proposal
    source: str = ""
    printed: Printed | None = None


def show_choices(page: Sheet, contour: BlockingContour | None, choices: Sequence[Choice], picture: str | None) -> None:
    """Put the contour with its choices on a sheet, as a picture and for json; ``picture``: the file to write."""
    if contour is None:
        page.note("no shifts give a pair that turns")
        return
    page.picture = ContourPicture(contour, tuple((c.name, (c.found.first, c.found.second)) for c in choices))
    page.plain_picture = page.picture.letters
    page.data["blocking_contour"] = [
        {"name": line.name, "level": line.level, "points": [[p.real, p.imag] for p in line.points]}
        for line in contour.lines
    ]
    page.picture_file = picture
    page.data["choices"] = [_told(choice) for choice in choices]


def _told(choice: Choice) -> dict[str, Any]:
    """A choice as json has it."""
    found = choice.found
    return {
        "name": words(ENGLISH).say(choice.name),
        "source": choice.source,
        "profile_shift_coefficient": {"first": found.first, "second": found.second},
        "contact_ratio": _number(found.contact_ratio),
        "root_sliding": dict(zip(("first", "second"), map(_number, found.root_sliding), strict=True)),
        "margin": found.margin,
    }


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None
