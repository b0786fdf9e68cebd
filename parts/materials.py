"""Densities of the materials that gears and cams are made of, g/cm^3, and the mass of a part."""

from __future__ import annotations

import re

# typical values of makers' data sheets; a part's own key `density` goes before them
DENSITIES = {
    "steel": 7.85,
    "stainless steel": 7.93,
    "cast iron": 7.2,
    "brass": 8.5,
    "bronze": 8.8,
    "copper": 8.96,
    "aluminium": 2.7,
    "aluminum": 2.7,
    "titanium": 4.5,
    "pom": 1.41,
    "acetal": 1.41,
    "delrin": 1.42,
    "nylon": 1.14,
    "pa6": 1.14,
    "pa12": 1.01,
    "pla": 1.24,
    "petg": 1.27,
    "abs": 1.05,
    "asa": 1.07,
    "tpu": 1.21,
    "pc": 1.2,
    "resin": 1.15,
    "acrylic": 1.19,
    "plexiglass": 1.19,
    "plywood": 0.65,
    "mdf": 0.75,
    "beech": 0.72,
    "birch": 0.65,
    "oak": 0.7,
    "cardboard": 0.7,
    "textolite": 1.35,
    "сталь": 7.85,
    "чавун": 7.2,
    "латунь": 8.5,
    "бронза": 8.8,
    "мідь": 8.96,
    "алюміній": 2.7,
    "фанера": 0.65,
    "оргскло": 1.19,
    "текстоліт": 1.35,
    "капрон": 1.14,
}


def density_of(material: str | None) -> float | None:
    """Density of a material by its name anywhere in the text ("plywood 3 mm"), g/cm^3; None where unknown.

    The longest known name wins: "stainless steel" before "steel".
    """
    if material is None:
        return None
    text = material.casefold()
    found = [name for name in DENSITIES if re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text)]
    return DENSITIES[max(found, key=len)] if found else None
