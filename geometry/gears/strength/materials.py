"""Groups of gear materials by ISO 6336-5: allowable stress numbers by hardness, life, notches, surfaces and sizes.

sigma = A x + B, MPa, x the hardness in its own scale. From memory of ISO 6336-5:2016, table 1; those of 18CrNiMo7-6 and
34CrNiMo6 stand in a report by KISSsoft too. Numbers of one's own go before them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from geometry.base.record import Record

Quality = Literal["ML", "MQ", "ME"]
Knots = tuple[tuple[float, float], ...]
# cycles and factors of lives, ISO 6336-2, table 2, and 6336-3, table 1; pits that are allowed ask for another line
_CONTACT: dict[str, Knots] = {
    "hard": ((1e5, 1.6), (5e7, 1.0)),
    "pitted": ((6e5, 1.6), (1e7, 1.3), (1e9, 1.0)),
    "brittle": ((1e5, 1.3), (2e6, 1.0)),
    "nitrocarburized": ((1e5, 1.1), (2e6, 1.0)),
}
_BENDING: dict[str, Knots] = {
    "tough": ((1e4, 2.5), (3e6, 1.0)),
    "hard": ((1e3, 2.5), (3e6, 1.0)),
    "brittle": ((1e3, 1.6), (3e6, 1.0)),
    "nitrocarburized": ((1e3, 1.1), (3e6, 1.0)),
}


class Line(Record):
    """sigma = A x + B between two hardnesses; A = 0 is one number."""

    slope: float
    base: float
    low: float
    high: float

    def at(self, hardness: float) -> float:
        """The stress number, MPa."""
        return self.slope * hardness + self.base


class Group(Record):
    """A group of materials: lines of contact and bending by quality, and which families of factors it goes with.

    ``scale``: of its hardness; ``slip``: rho' by the yield strength, (MPa, mm), or alone.
    """

    name: str
    scale: str
    contact: dict[str, Line]
    bending: dict[str, Line]
    contact_life: str
    bending_life: str
    surface: str
    size: str
    slip: Sequence[tuple[float, float]]

    @property
    def is_hard(self) -> bool:
        """Whether its flanks are hardened."""
        return self.name in ("Eh", "IF", "NT", "NV", "NV nitrocarburized")

    @property
    def is_soft_steel(self) -> bool:
        """Whether its flanks grow harder on a hard mate: of structural or through hardened steel; ISO 6336-2, 13."""
        return self.name in ("St", "V", "V alloy")

    def contact_knots(self, *, pits: bool) -> Knots:
        """Life in contact; ``pits``: some may be."""
        return _CONTACT["pitted" if pits and self.contact_life == "hard" else self.contact_life]

    @property
    def bending_knots(self) -> Knots:
        """Life in bending."""
        return _BENDING[self.bending_life]

    def slip_layer(self, strength: float | None) -> float | None:
        """rho', mm, between those of the table by the yield strength; None where that is not given; ISO 6336-3, 13."""
        if len(self.slip) == 1:
            return self.slip[0][1]
        if strength is None:
            return None
        if strength <= self.slip[0][0]:
            return self.slip[0][1]
        for (a, x), (b, y) in zip(self.slip, self.slip[1:], strict=False):
            if strength <= b:
                return x + (y - x) * (strength - a) / (b - a)
        return self.slip[-1][1]


def _lines(*numbers: tuple[float, float, float, float]) -> dict[str, Line]:
    """Those of ML, MQ and ME; the last goes on where there are fewer."""
    made = [Line(*row) for row in numbers]
    return dict(zip(("ML", "MQ", "ME"), made, strict=True))


_ST, _V = ((300.0, 0.0833), (400.0, 0.0445)), ((500.0, 0.0281), (600.0, 0.0194), (800.0, 0.0064), (1000.0, 0.0014))
_CASE, _NITRIDED, _IRON = ((0.0, 0.0030),), ((0.0, 0.1005),), ((0.0, 0.3095),)
_NODULAR = (
    _lines((1.434, 211, 175, 300), (1.434, 211, 175, 300), (1.5, 250, 200, 300)),
    _lines((0.35, 119, 175, 300), (0.35, 119, 175, 300), (0.38, 134, 200, 300)),
)
GROUPS = {
    group.name: group
    for group in (
        Group("St", "HBW", _lines((1, 190, 110, 210), (1, 190, 110, 210), (1.52, 250, 110, 210)),
              _lines((0.455, 69, 110, 210), (0.455, 69, 110, 210), (0.386, 147, 110, 210)),
              "hard", "tough", "soft", "tough", _ST),
        Group("V", "HV", _lines((0.963, 283, 135, 210), (0.925, 360, 135, 210), (0.838, 432, 135, 210)),
              _lines((0.25, 108, 115, 215), (0.24, 163, 115, 215), (0.283, 202, 115, 215)),
              "hard", "tough", "hard", "tough", _V),
        Group("V alloy", "HV", _lines((1.313, 188, 200, 360), (1.313, 373, 200, 360), (2.213, 260, 200, 390)),
              _lines((0.423, 104, 200, 360), (0.425, 187, 200, 360), (0.358, 231, 200, 390)),
              "hard", "tough", "hard", "tough", _V),
        Group("Eh", "HV", _lines((0, 1300, 600, 800), (0, 1500, 660, 800), (0, 1650, 660, 800)),
              _lines((0, 312, 600, 800), (0, 425, 660, 800), (0, 525, 660, 800)),
              "hard", "hard", "hard", "hard", _CASE),
        Group("IF", "HV", _lines((0.74, 602, 485, 615), (0.541, 882, 500, 615), (0.505, 1013, 500, 615)),
              _lines((0.305, 76, 485, 615), (0.138, 290, 500, 570), (0.271, 237, 500, 615)),
              "hard", "hard", "hard", "hard", _CASE),
        Group("NT", "HV", _lines((0, 1125, 650, 900), (0, 1250, 650, 900), (0, 1450, 650, 900)),
              _lines((0, 270, 650, 900), (0, 420, 650, 900), (0, 468, 650, 900)),
              "brittle", "brittle", "brittle", "hard", _NITRIDED),
        Group("NV", "HV", _lines((0, 788, 450, 650), (0, 998, 450, 650), (0, 1217, 450, 650)),
              _lines((0, 258, 450, 650), (0, 363, 450, 650), (0, 432, 450, 650)),
              "brittle", "brittle", "brittle", "hard", _NITRIDED),
        Group("NV nitrocarburized", "HV", _lines((0, 650, 300, 650), (0, 760, 450, 650), (0, 760, 450, 650)),
              _lines((0, 224, 300, 650), (0, 290, 450, 650), (0, 290, 450, 650)),
              "nitrocarburized", "nitrocarburized", "brittle", "hard", _NITRIDED),
        Group("GTS", "HBW", _lines((1.371, 143, 135, 250), (1.371, 143, 135, 250), (1.333, 267, 175, 250)),
              _lines((0.345, 77, 135, 250), (0.345, 77, 135, 250), (0.403, 128, 175, 250)),
              "hard", "tough", "hard", "tough", _V),
        Group("GGG", "HBW", *_NODULAR, "hard", "tough", "hard", "tough", _V),
        Group("GGG ferritic", "HBW", *_NODULAR, "brittle", "brittle", "brittle", "iron", _IRON),
        Group("GG", "HBW", _lines((1.033, 132, 150, 240), (1.033, 132, 150, 240), (1.465, 122, 175, 275)),
              _lines((0.256, 8, 150, 240), (0.256, 8, 150, 240), (0.2, 53, 175, 275)),
              "brittle", "brittle", "brittle", "iron", _IRON),
    )
}  # fmt: skip
