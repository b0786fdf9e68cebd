"""What a sheet carries of a blocking contour: pictures in both languages, letters, json, the file to write."""

from __future__ import annotations

import math
from typing import Any

from exporters.calculations.inputs import PLACE
from exporters.calculations.sheet import Sheet
from geometry.gears.blocking_contour import BlockingContour
from geometry.gears.shift_finder import Proposal
from parts.schema import SceneError

Mark = tuple[str, str, tuple[float, float]]
ENDINGS = (".svg", ".dxf")


def checked_picture(topic: str, name: str | None) -> None:
    """Refuse a picture file that would be no picture.

    Raises
    ------
    SceneError
        The name ends in neither .svg nor .dxf, or its folder does not exist; names one that works.
    """
    from pathlib import Path

    if name is None:
        return
    file = Path(name)
    if file.suffix.lower() not in ENDINGS:
        stem = file.with_suffix("") if file.suffix else file
        works = stem.with_name(f"{stem.name or 'contour'}.svg")
        raise SceneError(
            PLACE, f"{topic}.picture", name, f"pictures end in {' or '.join(ENDINGS)}; {works.as_posix()} works"
        )
    if not file.parent.is_dir():
        raise SceneError(PLACE, f"{topic}.picture", name, f"there is no such folder; {file.name} works")


def contour_pictures(page: Sheet, contour: BlockingContour, marks: list[Mark], picture: str | None) -> None:
    """Put the contour on a sheet; ``marks`` are points x1, x2 with their words in both languages."""
    from exporters.contour_picture import contour_svg, contour_text

    box = contour.box
    for index, language in enumerate(("en", "uk")):
        shown = {
            f"{n}: {mark[index]}": mark[2]
            for n, mark in enumerate(marks, 1)
            if box.left <= mark[2][0] <= box.right and box.bottom <= mark[2][1] <= box.top
        }
        page.pictures[language] = contour_svg(contour, shown, language)
        if picture is not None and picture.lower().endswith(".dxf"):
            page.drawings[language] = _drawing(contour, shown, language)
    page.plain_picture = contour_text(contour, {f"{n}": mark[2] for n, mark in enumerate(marks, 1)})
    page.data["blocking_contour"] = [
        {"name": line.name, "level": line.level, "points": [[p.real, p.imag] for p in line.points]}
        for line in contour.lines
    ]
    page.picture_file = picture


def _drawing(contour: BlockingContour, shown: dict[str, tuple[float, float]], language: str) -> Any:
    def write(file: Any) -> None:
        from exporters.contour_dxf import write_contour_dxf

        write_contour_dxf(file, contour, shown, language)

    return write


def contour_data(name: str, source: str, found: Proposal) -> dict[str, Any]:
    """A choice as json has it."""
    return {
        "name": name,
        "source": source,
        "profile_shift_coefficient": {"first": found.first, "second": found.second},
        "contact_ratio": _number(found.contact_ratio),
        "root_sliding": dict(zip(("first", "second"), map(_number, found.root_sliding), strict=True)),
        "margin": found.margin,
    }


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None
