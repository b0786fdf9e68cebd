"""Densities of the materials that gears and cams are made of, g/cm^3, and the mass of a part."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geometry.solids.mass import Moments

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


def mass_properties(moments: Moments, density: float | None) -> dict[str, Any]:
    """Volume (mm^3) and centre (mm) of a solid; with its density (g/cm^3) also mass (g) and inertia (g mm^2).

    ``axial_inertia`` is about the part's own axis, ``inertia_tensor`` (3, 3) about its centre of mass.
    """
    import numpy as np

    found: dict[str, Any] = {"volume": moments.volume, "centre_of_mass": moments.centre.tolist()}
    if density is not None:
        # g/mm^3
        grams, c = density / 1000, moments.centre
        about_centre = moments.inertia - moments.volume * (np.dot(c, c) * np.eye(3) - np.outer(c, c))
        found |= {
            "density": density,
            "mass": grams * moments.volume,
            "axial_inertia": grams * float(moments.inertia[2, 2]),
            "inertia_tensor": (grams * about_centre).tolist(),
        }
    return found
