"""A picture of what a power table makes of the play in its drives, over its workspace: SVG."""

from __future__ import annotations

from geometry.base.record import Record
from geometry.curves.curve import Complex
from parts.base.texts import Text, Words
from parts.pages.svg import chain, circle, document, written

_SIZE, _EDGE, _KEY = 560.0, 30.0, 250.0
_COLOURS = ("#1f4e8c", "#c2410c")


class ErrorMap(Record):
    """Bands of equal colour by the distance from O1, and at some points what each elbow's play reaches.

    ``radii`` (n + 1) bound the bands, ``values`` (n) are their greatest, in ``unit``; ``reached``: at a place (mm) the
    corners (mm) of what either elbow reaches, drawn larger by ``magnified``.
    """

    title: Text
    unit: str
    radii: tuple[float, ...]
    values: tuple[float, ...]
    reached: tuple[tuple[complex, tuple[Complex, Complex]], ...] = ()
    elbows: tuple[Text, Text] = ("", "")
    magnified: float = 1.0

    def svg(self, words: Words) -> str:
        """The picture in a language."""
        scale = _SIZE / 2 / self.radii[-1]
        centre = _EDGE + _SIZE / 2, _EDGE + _SIZE / 2 + 20
        low, high = min(self.values), max(self.values)

        def at(point: complex) -> tuple[float, float]:
            return centre[0] + point.real * scale, centre[1] - point.imag * scale

        lines = [written(_EDGE, 26, words.say(self.title), size=15)]
        for outer, value in reversed(list(zip(self.radii[1:], self.values, strict=True))):
            lines.append(circle(*centre, outer * scale, f"fill:{_shade(value, low, high)}"))
        if self.radii[0]:
            lines.append(circle(*centre, self.radii[0] * scale, "fill:#ffffff"))
        for place, both in self.reached:
            for corners, colour in zip(both, _COLOURS, strict=True):
                style = f"fill:{colour};fill-opacity:0.25;stroke:{colour};stroke-width:1"
                lines.append(chain((at(place + self.magnified * complex(c)) for c in corners), style, closed=True))
        lines += self._key(words, low, high)
        return document(_SIZE + 2 * _EDGE + _KEY, _SIZE + 2 * _EDGE + 20, lines)

    def _key(self, words: Words, low: float, high: float) -> list[str]:
        """Colours and their values, the elbows, how long the reach is."""
        left, top, lines = _SIZE + 2 * _EDGE + 10, _EDGE + 40.0, []
        for k in range(9):
            value = low + (high - low) * (8 - k) / 8
            y = top + 22 * k
            lines.append(
                f'<rect x="{left:.1f}" y="{y:.1f}" width="28" height="22" style="fill:{_shade(value, low, high)}"/>'
            )
            lines.append(written(left + 36, y + 15, words.decimal(f"{value:.4g} {words.text(self.unit)}")))
        y = top + 22 * 9 + 24
        for name, colour in zip(self.elbows, _COLOURS, strict=True):
            if self.reached:
                style = f"fill:{colour};fill-opacity:0.25;stroke:{colour}"
                lines.append(f'<rect x="{left:.1f}" y="{y - 11:.1f}" width="28" height="13" style="{style}"/>')
                lines.append(written(left + 36, y, words.say(name)))
                y += 22
        if self.reached:
            lines.append(written(left, y, words.decimal(f"{self.magnified:g} : 1")))
            y += 22
        reach = f"r = {self.radii[0]:g} … {self.radii[-1]:g} {words.text('mm')}"
        lines.append(written(left, y, words.decimal(reach)))
        return lines


def _shade(value: float, low: float, high: float) -> str:
    """From pale green to red."""
    share = 0.0 if high - low < 1e-12 * abs(high) else (value - low) / (high - low)
    stops = ((232, 245, 233), (255, 236, 179), (229, 115, 115))
    first, second, rest = (stops[0], stops[1], 2 * share) if share < 0.5 else (stops[1], stops[2], 2 * share - 1)
    mixed = (round(a + (b - a) * rest) for a, b in zip(first, second, strict=True))
    return "#" + "".join(f"{c:02x}" for c in mixed)
