"""The kinematic scheme of a train in side view, in the symbols of GOST 2.770: heights to scale, columns apart."""

from __future__ import annotations

from collections.abc import Callable

from geometry.base.record import Draft, field
from parts.drawing.canvas import Canvas
from parts.mates.sheets.train_picture import TrainPicture

# between columns of wheels, from a wheel to the arm beside it, to a ring's disc on either side; mm on paper
_COLUMN, _ARM, _DISC, _LEFT_DISC = 38.0, 22.0, 28.0, 9.0
# rims: half of their width, what they keep off the pitch point, how far a ring's goes on outwards
_RIM, _OFF, _BACK = 2.5, 0.5, 4.0
# a shaft beyond its last wheel, half of a bearing's length, what it keeps off its shaft, shafts in each other
_END, _HALF, _PLAY, _SLEEVE = 12.0, 2.5, 1.4, 2.0
_CROSS, _HATCH = 1.2, 1.6


def scheme_width(train: TrainPicture) -> float:
    """What a scheme takes of the paper's width, mm."""
    nested = sum(link.carrier is None for link in train.links)
    return _LEFT_DISC + _COLUMN * max(r.level for r in train.rims) + _DISC + _END * (1 + min(nested, 3))


class Scheme(Draft):
    """A scheme that is being drawn: ``y`` gives the height on paper of a height of the train, ``left`` its edge, mm."""

    canvas: Canvas
    train: TrainPicture
    y: Callable[[float], float]
    left: float
    # where each rim and each carrier may be named
    marks: dict[str, complex] = field(default_factory=dict)

    def draw(self) -> None:
        """Wheels, arms and shafts."""
        train = self.train
        discs: list[list[float]] = [[] for _ in train.links]
        for index in range(len(train.rims)):
            discs[train.rims[index].link] += self._rim(index)
        for link in range(len(train.links)):
            carried = [k for k, other in enumerate(train.links) if other.carrier == link]
            if carried:
                discs[link].append(self._arm(link, carried))
        axes = dict.fromkeys((link.axis, link.carrier) for link in train.links)
        for axis, carrier in axes:
            mine = [k for k, link in enumerate(train.links) if (link.axis, link.carrier) == (axis, carrier)]
            if carrier is None:
                self._shafts(axis, [(k, discs[k]) for k in mine if discs[k]])
                continue
            for k in mine:
                self._line(min(discs[k]) - _HALF, axis, self._arm_at(carrier) + _HALF, axis)

    def _column(self, level: int) -> float:
        return self.left + _END + _LEFT_DISC + _COLUMN * level

    def _line(self, x1: float, h1: float, x2: float, h2: float, rise1: float = 0.0, rise2: float = 0.0) -> None:
        """A line of the scheme between heights of the train, both ends raised on paper, mm."""
        self.canvas.line("SCHEME", complex(x1, self.y(h1) + rise1), complex(x2, self.y(h2) + rise2))

    def _rim(self, index: int) -> list[float]:
        """A wheel seen from the side, and where it stands on a shaft: a ring that is held on none."""
        rim, axis = self.train.rims[index], self.train.links[self.train.rims[index].link].axis
        held = self.train.links[rim.link].rate == 0
        x, radius = self._column(rim.level), self.train.radius(index)
        for sign in (1, -1):
            edge, off = axis + sign * radius, sign * (_OFF if rim.internal else -_OFF)
            self._line(x - _RIM, edge, x + _RIM, edge, off, off)
        top, low = axis + radius, axis - radius
        self.marks[rim.name] = complex(x, self.y(axis + 0.6 * radius))
        if not rim.internal:
            self._line(x, low, x, top, _OFF, -_OFF)
            if held:
                self._line(x, low, x, low, _OFF, -_BACK)
                self._ground(complex(x, self.y(low) - _BACK), -1)
                return []
            # fast on its shaft
            at = complex(x, self.y(axis))
            for way in (1 + 1j, 1 - 1j):
                self.canvas.line("SCHEME", at - _CROSS * way, at + _CROSS * way)
            return [x]
        self.marks[rim.name] = complex(x, self.y(top) + _BACK)
        for sign, edge in ((1, top), (-1, low)):
            self._line(x, edge, x, edge, sign * _OFF, sign * _BACK)
            if held:
                self._ground(complex(x, self.y(edge) + sign * _BACK), sign)
        if held:
            return []
        last = rim.level == max(r.level for r in self.train.rims)
        disc = x + (_DISC if last else -_LEFT_DISC)
        for sign, edge in ((1, top), (-1, low)):
            self._line(x, edge, disc, edge, sign * _BACK, sign * _BACK)
        self._line(disc, low, disc, top, -_BACK, _BACK)
        return [disc]

    def _arm_at(self, link: int) -> float:
        """Where the arm of a carrier stands: beside its satellites."""
        carried = [k for k, other in enumerate(self.train.links) if other.carrier == link]
        return self._column(max(r.level for r in self.train.rims if r.link in carried)) + _ARM

    def _arm(self, link: int, carried: list[int]) -> float:
        """The arm of a carrier, with a bearing for every satellite's axis."""
        x, axis = self._arm_at(link), self.train.links[link].axis
        heights = [self.train.links[k].axis for k in carried]
        for height in dict.fromkeys(heights):
            self._bearing(complex(x, self.y(height)), _PLAY)
        far = max(heights, key=lambda h: abs(h - axis))
        self._line(x, axis, x, far, 0.0, -_PLAY if far > axis else _PLAY)
        self.marks[self.train.links[link].name] = complex(x, self.y(axis + 0.45 * (far - axis)))
        return x

    def _shafts(self, axis: float, links: list[tuple[int, list[float]]]) -> None:
        """Shafts about one axis: the first goes out to the left, all others to the right, in each other."""
        links = sorted(links, key=lambda item: min(item[1]))
        # a link between others has its bearing within, the rest turn in each other
        ends = [k for k, (_, xs) in enumerate(links) if k and max(xs) - min(xs) < 2 * _ARM]
        far = max((max(xs) for _, xs in links), default=0.0) + _END * max(len(ends), 1)
        for number, (link, xs) in enumerate(links):
            low, high, inner = min(xs), max(xs), 0
            place = (low + high) / 2
            if number == 0 and (len(links) > 1 or link == self.train.driver):
                low -= _END
                place = low + _HALF
            elif number in ends or not number:
                inner = ends.index(number) if number else 0
                high = far - _END * inner
                place = high - _HALF
            at, reach = complex(0, self.y(axis)), _SLEEVE * inner
            for side in (1, -1) if inner else (0,):
                self.canvas.line("SCHEME", at + complex(low, side * reach), at + complex(high, side * reach))
            self._bearing(at + place, reach + _PLAY, ground=True)

    def _bearing(self, at: complex, off: float, *, ground: bool = False) -> None:
        """A revolute pair: lines on both sides of a shaft, hatched where the frame holds them."""
        for sign in (1, -1):
            if ground:
                self._ground(at + 1j * sign * off, sign)
            else:
                self.canvas.line("SCHEME", at + complex(-_HALF, sign * off), at + complex(_HALF, sign * off))

    def _ground(self, at: complex, way: int) -> None:
        """A line of the frame, hatched on its upper (1) or lower (-1) side."""
        self.canvas.line("SCHEME", at - _HALF, at + _HALF)
        for k in range(4):
            foot = at + complex(-_HALF + (k + 0.3) * 2 * _HALF / 4, 0)
            self.canvas.line("DIMENSION", foot, foot + complex(_HATCH * 0.7, way * _HATCH))
