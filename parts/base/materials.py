"""A material by the name that a scene gives it: its density, g/cm^3, its words, and the mass of a part."""

from __future__ import annotations

import re
from collections.abc import Container, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from geometry.base.errors import Nearest
from geometry.base.record import Record
from parts.base.lookalikes import in_latin
from parts.base.refusal import SceneError, meant
from parts.base.texts import Words

if TYPE_CHECKING:
    from geometry.solids.mass import Moments

# a steel told by its carbon alone (GOST 1050), in hundredths of a percent
_CARBON = re.compile(r"[0-8]\d")
# a thickness in a material's name
_MM = re.compile(r"(\d) ?mm\b")
# and the one size of a sheet, in capitals: of a rod or a bar there is a sign before it
_SHEET = re.compile(r"(?<![\w.,])(\d+(?:[.,]\d+)?) ?MM\b")
_SECTION = re.compile(r"[Ø⌀×*]|\d ?X ?\d")


def density_of(material: str | None) -> float | None:
    """Density of a material by its mark or name anywhere in the text ("plywood 3 mm"), g/cm^3; None where unknown.

    Marks with digits go before names, and the longest goes first: "stainless steel" before "steel". Letters of any
    case that look alike are one.
    """
    if material is None:
        return None
    # a table that a scene without materials does not pay for
    from parts.base.densities import DENSITIES

    found = _known(material, DENSITIES)
    return None if found is None else DENSITIES[found.name]


def check_material(material: str, source: str, place: str) -> None:
    """That a material for which no density is given is a known one.

    Raises
    ------
    SceneError
        It is not; with the known name that was probably meant.
    """
    if density_of(material) is None:
        from parts.base.densities import DENSITIES

        # of the many marks that begin with it none is meant
        by_carbon = _CARBON.fullmatch(material) is not None
        near = None if by_carbon else meant(_fold(material), _by_letters())
        known = f"steel {material}" if by_carbon else near and _by_letters()[str(near.value)]
        cure = Nearest(known, "meant") if known else None
        raise SceneError(source, place, material, "unknown_material", cure, known=list(DENSITIES))


def material_told(material: str | None, told: Words) -> str:
    """A material in the words of a language, where it has a known name: its thickness too."""
    material = _MM.sub(rf"\1 {told.text('mm')}", material or "")
    if not material:
        return material
    from parts.base.densities import NAMES

    found = _known(material, NAMES)
    if found is None or told.text(found.name) == found.name:
        return material
    return f"{material[: found.start]}{told.text(found.name)}{material[found.end :]}"


def thickness_told(material: str) -> float | None:
    """The thickness that a material's name tells ("plywood 3 mm"), mm; None: none, or the section of a rod."""
    folded = _fold(material)
    found = _SHEET.search(folded)
    return None if found is None or _SECTION.search(folded) else float(found[1].replace(",", "."))


class _Found(Record):
    """A known name, and where it begins and ends in the text."""

    name: str
    start: int
    end: int


def _known(text: str, names: Container[str]) -> _Found | None:
    """That of ``names`` which stands in a text as whole words: with digits before without, the longest, the last."""
    folded = _fold(text)
    words = list(re.finditer(r"\w+", folded))
    spans = ((first.start(), last.end()) for k, first in enumerate(words) for last in words[k:])
    found = [(_by_letters().get(folded[slice(*span)]), span) for span in spans]
    fit = [_Found(name, *span) for name, span in found if name is not None and name in names]
    return max(fit, key=lambda f: (any(map(str.isdigit, f.name)), f.end - f.start, f.start), default=None)


@cache
def _by_letters() -> Mapping[str, str]:
    """Every known name by the letters that no eye tells apart."""
    from parts.base.densities import DENSITIES

    return {_fold(name): name for name in DENSITIES}


def _fold(text: str) -> str:
    """Capitals, in Latin where they look so; as long as the text."""
    return in_latin("".join(letter.upper()[:1] for letter in text))


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
