"""The part kinds ``pin`` (a round pin or its sleeve) and ``eccentric`` (the disc that moves a cycloidal disc)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from geometry.base.errors import ParameterError, limit
from geometry.base.record import replace
from geometry.solids.hub_holes import HubHoles, least_wall
from parts.base.kind import Others, Report, Stock
from parts.base.part_keys import MaterialKeys
from parts.keys.base import BoreDiameter, mm, part_mm
from parts.keys.holes import BoredKeys, holes_of, thin_wall
from parts.keys.pins import RoundPinKind, check_holes, most_of

if TYPE_CHECKING:
    from geometry.solids.pin_plates import RoundDisc
    from geometry.solids.sketch import Sketch


class PinSpec(MaterialKeys, forbid_unknown_fields=True, tag_field="kind", tag="pin"):
    """Keys of ``pin``."""

    diameter: Annotated[float, part_mm("outer diameter", least=0.01, example=8.0)]
    length: Annotated[float, mm("length along the axis", least=0.01, most=10_000, example=60.0)]
    bore_diameter: BoreDiameter = 0.0


class EccentricSpec(BoredKeys, kw_only=True, tag_field="kind", tag="eccentric"):
    """Keys of ``eccentric``."""

    diameter: Annotated[float, part_mm("diameter of the disc", least=0.01, example=22.0)]
    eccentricity: Annotated[float, part_mm("from the axis to the disc's centre", least=0, example=2.5)]


class Pin(RoundPinKind[PinSpec, "RoundDisc"]):
    """A pin."""

    name, keys = "pin", PinSpec

    def thing(self, keys: PinSpec, others: Others) -> RoundDisc:
        """A disc whose bore leaves a wall."""
        from geometry.solids.bores import RoundBore
        from geometry.solids.pin_plates import RoundDisc

        most = keys.diameter - 2 * least_wall(keys.diameter / 2)
        if keys.bore_diameter > most:
            cure = limit(most, keys.bore_diameter, digits=6)
            raise ParameterError("bore_diameter", keys.bore_diameter, "leaves_no_wall", cure)
        holes = HubHoles(RoundBore(keys.bore_diameter)) if keys.bore_diameter > 0 else HubHoles()
        return RoundDisc(keys.diameter / 2, 0.0, holes)

    def sketch(self, keys: PinSpec, thing: RoundDisc) -> Sketch | None:
        """A pin is not hatched along its axis."""
        sketch = super().sketch(keys, thing)
        return sketch and replace(sketch, is_shaft=True)

    def stock(self, keys: PinSpec) -> Stock:
        """A length of a rod or a tube."""
        return Stock(keys.diameter, keys.bore_diameter, keys.length)

    def height(self, keys: PinSpec, thing: RoundDisc) -> float:
        """Its length."""
        return keys.length

    def report(self, keys: PinSpec, thing: RoundDisc) -> Report:
        """Its diameter."""
        return Report(quantities={"diameter": keys.diameter})


class Eccentric(RoundPinKind[EccentricSpec, "RoundDisc"]):
    """An eccentric."""

    name, keys = "eccentric", EccentricSpec

    def thing(self, keys: EccentricSpec, others: Others) -> RoundDisc:
        """A disc whose bore stays in it."""
        from geometry.solids.pin_plates import RoundDisc

        radius, holes = keys.diameter / 2, holes_of(keys)
        if holes.bore is not None:
            if keys.eccentricity >= radius - 2 * least_wall(radius):
                cure = most_of(radius - least_wall(radius) - holes.bore_reach, keys.eccentricity)
                raise ParameterError("eccentricity", keys.eccentricity, "bore_axis_leaves_disc", cure)
            check_holes(keys, holes, radius, centre=keys.eccentricity)
        return RoundDisc(radius, keys.eccentricity, holes)

    def report(self, keys: EccentricSpec, thing: RoundDisc) -> Report:
        """Its sizes, and a wall about its bore that breaks."""
        found = thin_wall(keys.diameter / 2 - keys.eccentricity, thing.holes)
        return Report(quantities={"diameter": keys.diameter, "eccentricity": keys.eccentricity}, findings=found)
