"""Smirnov's plans of a train (guidelines, figure 5): velocities over the height, and angular velocities from a pole."""

from __future__ import annotations

from collections.abc import Callable

from geometry.base.record import Record
from parts.base.texts import N_
from parts.drawing.canvas import Box, Canvas, standard_scale
from parts.drawing.labels import Labeller
from parts.drawing.readback import ReadSheet, Taken, lines_missing
from parts.mates.sheets.train_picture import TrainPicture

# a link that turns less than this share of the fastest is a point on the pole line, which no divider measures, and so
# is a velocity of fewer mm on paper
_LEAST = 1e-9
_ARROW = 2.5


class Plans(Record):
    """Both plans on paper: where the pole lines run and the scales; lengths in mm on paper.

    ``velocity``: mm/s of a point for 1 mm where the driver turns with 1 rad/s; ``angular``: 1/s for 1 mm. ``pole`` is
    O_1, ``foot`` its foot on the line of angular velocities.
    """

    train: TrainPicture
    y: Callable[[float], float]
    line: float
    velocity: float
    angular: float
    pole: complex
    foot: complex

    def at(self, link: int, height: float) -> complex:
        """The end of the velocity of a link's point."""
        return complex(self.line + self.train.velocity(link, height) / self.velocity, self.y(height))

    def spans(self) -> list[tuple[int, complex, complex]]:
        """The line of every link that moves: between its lowest and its highest point."""
        found = []
        for link in range(len(self.train.links)):
            heights = self.train.heights(link)
            if self.train.links[link].rate and heights[0] < heights[-1]:
                found.append((link, self.at(link, heights[0]), self.at(link, heights[-1])))
        return found

    def rays(self) -> list[tuple[int, complex, complex]]:
        """From O_1 parallel to each of these."""
        return [
            (link, self.pole, self.foot + float(self.train.links[link].rate) / self.angular)
            for link, _, _ in self.spans()
        ]


def plans_of(train: TrainPicture, y: Callable[[float], float], scale: float, plan: Box, angles: Box) -> Plans:
    """The plans of a train in the areas that they have on paper; ``scale``: of the heights."""
    speeds = [train.velocity(k, h) for k in range(len(train.links)) for h in train.heights(k)]
    low, high = min(*speeds, 0.0), max(*speeds, 0.0)
    velocity = standard_scale((high - low) / plan.wide)
    line = (plan.left + plan.right - (low + high) / velocity) / 2
    rates = [float(link.rate) for link in train.links]
    least, most = min(*rates, 0.0), max(*rates, 0.0)
    # rays are parallel to the lines of the links: the pole's distance follows from the scale
    needed = max((most - least) / angles.wide, velocity * scale / angles.tall)
    angular = standard_scale(needed)
    foot = complex((angles.left + angles.right - (least + most) / angular) / 2, angles.high)
    return Plans(train, y, line, velocity, angular, foot - 1j * velocity * scale / angular, foot)


def draw_plans(canvas: Canvas, plans: Plans, plan: Box, angles: Box, *, by_hand: bool) -> None:
    """Pole lines, the line of every link, the velocities of its points, and the rays; by hand the pole lines alone."""
    canvas.line("AXIS", complex(plans.line, plan.low), complex(plans.line, plan.high))
    canvas.line("AXIS", complex(angles.left, plans.foot.imag), complex(angles.right, plans.foot.imag))
    canvas.line("CENTRE", plans.pole, plans.foot)
    if by_hand:
        return
    for layer, lines in (("VELOCITY", plans.spans()), ("ANGULAR_VELOCITY", plans.rays())):
        for _, start, end in lines:
            canvas.line(layer, start, end)
    for _, end in points_of(plans):
        _vector(canvas, complex(plans.line, end.imag), end)


def points_of(plans: Plans) -> list[tuple[str, complex]]:
    """The points that have a name, with the ends of their velocities: pitch points, then axes that move."""
    train = plans.train
    found: list[tuple[int, float]] = []
    for mesh in train.meshes:
        found.append((train.rims[mesh[0]].link, train.pitch_height(mesh)))
    found += [(k, link.axis) for k, link in enumerate(train.links) if link.carrier is not None]
    return [(chr(ord("a") + k), plans.at(link, height)) for k, (link, height) in enumerate(found)]


def name_plans(labels: Labeller, plans: Plans, plan: Box, angles: Box, *, by_hand: bool) -> None:
    """Names of points, links and pole lines; by hand of the pole lines alone."""
    names = [link.name for link in plans.train.links]
    labels.name("p", complex(plans.line, plan.high), prefer=1 + 0j)
    labels.name("p", complex(plans.line, plan.low), prefer=1 + 0j)
    for name, end in [] if by_hand else points_of(plans):
        labels.name(name, end, prefer=1 + 0.4j)
    for link, start, end in [] if by_hand else plans.spans():
        labels.name(f"({names[link]})", start + 0.62 * (end - start), prefer=1 + 0j)
    for axis in dict.fromkeys(link.axis for link in plans.train.links if link.carrier is None):
        labels.name("o", complex(plans.line, plans.y(axis)), prefer=-1 + 0.5j)
    labels.name("O_{1}", plans.pole, prefer=-1j)
    labels.name("O", plans.foot, prefer=1j)
    for link, _, end in [] if by_hand else plans.rays():
        labels.name(names[link], end, prefer=1j)
    for x in (angles.left, angles.right):
        labels.name("ω", complex(x, plans.foot.imag), prefer=-1j)


def _vector(canvas: Canvas, start: complex, end: complex) -> None:
    """A velocity with its arrow, where there is room for one; none of a point that stands still."""
    if abs(end - start) < _LEAST:
        return
    canvas.line("DIMENSION", start, end)
    if abs(end - start) > 2 * _ARROW:
        back = _ARROW * (end - start) / abs(end - start)
        for side in (0.2j, -0.2j):
            canvas.line("DIMENSION", end, end - back * (1 + side))


class PlanMeasures(Record):
    """What must be measured off both plans: slopes against the driver's, and lengths on the line of velocities."""

    plans: Plans

    def check(self, sheet: ReadSheet, taken: Taken) -> None:
        """The ratio of every link by both plans; each line where it belongs."""
        links, driver = self.plans.train.links, self.plans.train.driver
        for layer, wanted in (("VELOCITY", self.plans.spans()), ("ANGULAR_VELOCITY", self.plans.rays())):
            found = [x for x in sheet.lines if x.layer == layer]
            if len(found) != len(wanted):
                taken.failures.append(lines_missing(layer, found, wanted))
                continue
            off = max(max(abs(x.start - a), abs(x.end - b)) for x, (_, a, b) in zip(found, wanted, strict=True))
            taken.measured[f"{layer.lower()}_deviation"] = off
            taken.unless(off <= taken.room, "{layer}: a line is {off:.3g} mm off", layer=layer, off=off)
            ways = [x.end - x.start for x in found]
            slopes = {link: way.real / way.imag for way, (link, _, _) in zip(ways, wanted, strict=True)}
            for link, slope in slopes.items():
                if link == driver or not abs(slope) > _LEAST * max(map(abs, slopes.values())):
                    continue
                name = f"ratio_{links[driver].name}_{links[link].name}_by_{layer.lower()}"
                ratio, right = slopes[driver] / slope, float(1 / links[link].rate)
                taken.measured[name] = ratio
                # the guidelines read it off a drawing: within a thousandth, where the dividers' points allow it
                least = min(abs(way.real) for way in ways)
                near = abs(ratio / right - 1) <= max(1e-3, 8 * taken.room / max(least, 1e-300))
                told = N_("{name} measures {ratio:.6g} instead of {right:.6g}")
                taken.unless(near, told, name=name, ratio=ratio, right=right)
