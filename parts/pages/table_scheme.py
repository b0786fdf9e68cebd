"""The scheme of a two-disk table (thesis, fig. 2.2) over its workspace: arms of both elbows, or a path."""

from __future__ import annotations

import math
from collections.abc import Iterator

from geometry.base.record import Record
from geometry.curves.curve import Complex
from parts.base.texts import N_, Text, Words
from parts.pages.svg import chain, circle, document, written

_SIZE, _EDGE, _KEY = 560.0, 30.0, 330.0
_PITCH, _PATH = "#9fb0c0", "#c2185b"
_COLOURS = ("#1f4e8c", "#c2410c")
_ELBOWS = (N_("First elbow, beta > 0"), N_("Second elbow, beta < 0"))


class TableScheme(Record):
    """Radii (mm) of the singular circles and of the pitch circles of ring and pinion.

    ``arms``: O2 and O3 of each elbow; ``path``: points of O3, with O2 at its start and end.
    """

    reach: tuple[float, float]
    pitch: tuple[float, float]
    arms: tuple[tuple[complex, complex], ...]
    path: Complex | None = None

    def svg(self, words: Words) -> str:
        """The picture in a language."""
        far = max(self.reach[1], self.pitch[0]) * 1.03
        scale, middle = _SIZE / 2 / far, _EDGE + _SIZE / 2
        lines = list(self._drawn(scale, middle))
        left, y = _SIZE + 2 * _EDGE, _EDGE + 20.0
        told: list[tuple[str, str, Text]] = [
            ("#eef4ea", "#7a9a6a", N_("workspace, between the singular circles")),
            ("none", _PITCH, N_("pitch circles of ring and pinion")),
        ]
        if self.path is None:
            told += [("none", colour, elbow) for colour, elbow in zip(_COLOURS, _ELBOWS, strict=True)]
        else:
            told += [("none", _PATH, N_("path")), ("none", _COLOURS[0], N_("arms at its start and end"))]
        for fill, stroke, text in told:
            style = f"fill:{fill};stroke:{stroke};stroke-width:2"
            lines.append(f'<rect x="{left:.1f}" y="{y - 11:.1f}" width="26" height="12" style="{style}"/>')
            lines.append(written(left + 34, y, words.say(text)))
            y += 24
        return document(_SIZE + 2 * _EDGE + _KEY, _SIZE + 2 * _EDGE, lines)

    def _drawn(self, scale: float, middle: float) -> Iterator[str]:
        def at(point: complex) -> tuple[float, float]:
            return middle + point.real * scale, middle - point.imag * scale

        yield circle(middle, middle, self.reach[1] * scale, "fill:#eef4ea;stroke:#7a9a6a;stroke-width:1.5")
        if self.reach[0]:
            yield circle(middle, middle, self.reach[0] * scale, "fill:#ffffff;stroke:#7a9a6a;stroke-width:1.5")
        pitch = f"fill:none;stroke:{_PITCH};stroke-width:1.2;stroke-dasharray:8 3 2 3"
        yield circle(middle, middle, self.pitch[0] * scale, pitch)
        for axis in (1 + 0j, 1j):
            yield chain((at(k * axis * 1.02 * self.pitch[0]) for k in (-1, 1)), "stroke:#c8ccd0;stroke-width:0.8")
        if self.path is not None:
            yield chain(map(at, map(complex, self.path)), f"fill:none;stroke:{_PATH};stroke-width:2")
        for number, (second, third) in enumerate(self.arms):
            colour = _COLOURS[0 if self.path is not None else number]
            yield circle(*at(second), self.pitch[1] * scale, pitch)
            yield chain(map(at, (0j, second, third)), f"fill:none;stroke:{colour};stroke-width:3")
            for point, name in ((0j, "O1"), (second, "O2"), (third, "O3")):
                x, y = at(point)
                yield circle(x, y, 4, f"fill:#ffffff;stroke:{colour};stroke-width:2", "g")
                if number == 0 or name == "O2":
                    yield written(x + 7, y - 6, name)


def scheme(arms: tuple[float, float], ratio: float, joints: tuple[tuple[complex, complex], ...]) -> TableScheme:
    """The scheme without a path: of the arms L1, L2 (mm) and what the ring has more teeth than the pinion."""
    pinion = arms[0] / (ratio - 1)
    return TableScheme((abs(arms[0] - arms[1]), math.fsum(arms)), (pinion * ratio, pinion), joints)
