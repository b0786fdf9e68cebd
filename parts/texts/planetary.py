"""What the meshes of a planetary set do not keep, in words."""

from __future__ import annotations

from geometry.gears.planetary.fitting import Fitting
from geometry.gears.planetary.sets import PlanetarySet, Scheme
from parts.base.psv import sentences_of
from parts.base.texts import N_, Message, filled, listed, message

# what a mesh may not keep
FAULTS = sentences_of(__file__, "planetary_faults")


def fault_told(name: str) -> Message:
    """A condition that is not kept, in words: the rim is the first of a mesh."""
    condition, _, who = name.rpartition("_")
    if who not in ("first", "second"):
        return filled(FAULTS[name])
    owner = N_("{fault} of the satellite") if who == "first" else N_("{fault} of the central wheel")
    return message(owner, fault=filled(FAULTS[condition]))


def broken_told(fitting: Fitting, one: PlanetarySet) -> list[Message]:
    """What each mesh of a set breaks without shifts of the rims; none of one that breaks nothing."""
    meshes = zip(meshes_of(one.scheme), fitting.plain(one).broken(), strict=True)
    text = N_("mesh {wheels} without shifts of the rims: {names}")
    return [
        message(text, wheels=wheels, names=listed([fault_told(m.name) for m in broken]))
        for wheels, broken in meshes
        if broken
    ]


def meshes_of(scheme: Scheme) -> tuple[str, str]:
    """The wheels of both meshes, as they are told."""
    return "1-2", "2'-3" if scheme.double else "2-3"
