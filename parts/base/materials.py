"""Densities of the materials that gears and cams are made of, g/cm^3, and the mass of a part."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from parts.base.texts import N_, Words

if TYPE_CHECKING:
    from geometry.solids.mass import Moments

# a thickness in a material's name
_MM = re.compile(r"(\d) ?mm\b")
# typical values of makers' data sheets; a part's own key `density` goes before them
DENSITIES = {
    N_("steel"): 7.85,
    N_("stainless steel"): 7.93,
    N_("cast iron"): 7.2,
    N_("brass"): 8.5,
    N_("bronze"): 8.8,
    N_("copper"): 8.96,
    N_("aluminium"): 2.7,
    "aluminum": 2.7,
    N_("titanium"): 4.5,
    "pom": 1.41,
    "acetal": 1.41,
    "delrin": 1.42,
    N_("nylon"): 1.14,
    "pa6": 1.14,
    "pa12": 1.01,
    "pla": 1.24,
    "petg": 1.27,
    "abs": 1.05,
    "asa": 1.07,
    "tpu": 1.21,
    "pc": 1.2,
    "resin": 1.15,
    N_("acrylic"): 1.19,
    N_("plexiglass"): 1.19,
    N_("plywood"): 0.65,
    N_("mdf"): 0.75,
    N_("beech"): 0.72,
    N_("birch"): 0.65,
    N_("oak"): 0.7,
    N_("cardboard"): 0.7,
    N_("textolite"): 1.35,
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
    found = _known(material)
    return DENSITIES[found[0].casefold()] if found else None


def material_told(material: str | None, told: Words) -> str:
    """A material in the words of a language, where it has a known name: plywood 3 mm, фанера 3 mm."""
    material = _MM.sub(rf"\1 {told.text('mm')}", material or "")
    found = _known(material)
    if not found or told.text(found[0].casefold()) == found[0].casefold():
        return material
    return f"{found.string[: found.start()]}{told.text(found[0].casefold())}{found.string[found.end() :]}"


def _known(material: str) -> re.Match[str] | None:
    """The longest known name in a text."""
    found = (re.search(rf"(?<!\w){re.escape(name)}(?!\w)", material, re.IGNORECASE) for name in DENSITIES)
    return max(filter(None, found), key=lambda match: len(match[0]), default=None)


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
