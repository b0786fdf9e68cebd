"""Annotated types of scene keys: unit, range and meaning stand beside each key, once.

The annotations are the schema: validation, error texts and ``higherpair new`` all read them.
"""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta


def mm(text: str, *, above: float | None = None, least: float | None = None, most: float | None = None) -> Meta:
    """A length in mm."""
    unit = {"unit": "mm"}
    if above is not None:
        return Meta(gt=above, le=most, description=text, extra=unit)
    return Meta(ge=least, le=most, description=text, extra=unit)


def in_modules(text: str, *, least: float, most: float) -> Meta:
    """A coefficient in modules."""
    return Meta(ge=least, le=most, description=text, extra={"unit": "modules"})


# names become parts of file names; Windows keeps some for devices
IDENTIFIER = r"^[A-Za-z0-9][A-Za-z0-9_-]{0,63}\Z"
DEVICE_NAMES = {"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(1, 10))}
Identifier = Annotated[
    str,
    Meta(
        pattern=IDENTIFIER,
        description="part of the file's name where two exports share an ending; letters, digits, _, -",
    ),
]
Colour = Annotated[str, Meta(pattern=r"^#[0-9a-fA-F]{6}$", description="colour in pictures, like #c08040")]
Material = Annotated[str, Meta(max_length=200, description="material; names like steel, PLA, plywood give the mass")]
Density = Annotated[float, Meta(gt=0, le=30, description="density for the mass", extra={"unit": "g/cm^3"})]
FaceWidth = Annotated[float, mm("thickness of the part along its axis", least=0.01, most=10_000)]
BoreDiameter = Annotated[float, mm("round bore; 0 is none", least=0, most=100_000)]
