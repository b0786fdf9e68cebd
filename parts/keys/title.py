"""Scene keys of the title block of a sheet (main inscription, form 1 of GOST 2.104)."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct


def _text(meaning: str) -> Meta:
    return Meta(max_length=120, description=meaning)


class TitleBlockTable(Struct, forbid_unknown_fields=True):
    """What the title block of a sheet says; what is left out stays empty for a pen."""

    name: Annotated[str, _text("name of what is drawn; default: the scene's title")] = ""
    designation: Annotated[str, _text("designation of the document")] = ""
    organisation: Annotated[str, _text("school, group or firm")] = ""
    material: Annotated[str, _text("material of a part; default: that of the part shown")] = ""
    mass: Annotated[str, _text("mass in the title block, kg; default: that of the part shown")] = ""
    letter: Annotated[str, Meta(max_length=3, description="stage of the document")] = ""
    date: Annotated[str, Meta(max_length=20, description="date beside every name")] = ""
    drawn: Annotated[str, _text("who drew it")] = ""
    checked: Annotated[str, _text("who checked it")] = ""
    technical_check: Annotated[str, _text("who checked it for the workshop")] = ""
    standards_check: Annotated[str, _text("who checked it against the standards")] = ""
    approved: Annotated[str, _text("who approved it")] = ""


TitleBlockKey = (
    Annotated[bool, Meta(description="sheet: title block of GOST 2.104, form 1; or a table of its words")]
    | TitleBlockTable
)
