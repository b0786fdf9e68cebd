"""Tables of parts and mates as a recipe's hand writes them: plates, rods, cranks, and how they stand on each other."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import TypeVar

from msgspec.structs import replace

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.nearest import kept, nearest
from parts.base.psv import rows_of
from parts.recipes.names import NAMES
from parts.recipes.recipe import Expansion, RecipeKeys, Table

K = TypeVar("K", bound=RecipeKeys)
# directions in which things come to their place; from any other side, each goes straight to the axis
WAYS: Mapping[str, tuple[float, float, float]] = {
    "front": (0.0, 0.0, -1.0), "behind": (0.0, 0.0, 1.0), "right": (-1.0, 0.0, 0.0), "left": (1.0, 0.0, 0.0),
    "back": (0.0, -1.0, 0.0), "fore": (0.0, 1.0, 0.0),
}  # fmt: skip
# orders of assembly, a step or some a row; what keys of parts are keys of their recipe
_ORDERS, _ORIGINS = rows_of(__file__, "orders"), rows_of(__file__, "origins")
# of gears whose module is sought, mm
_LEAST_MODULE = 0.1
# of a pin's diameter: the most play that it may have in its hole
LOOSE = 0.25
# rounding of a square plate's corners; depth of marks where what has them is thick enough, mm
_CORNER, _MARK = 10.0, 0.4


def refused_by(
    keys: K,
    names: Sequence[str],
    checked: Callable[[K], object],
    code: str,
    ends: Mapping[str, tuple[object, object]] | None = None,
    **told: float,
) -> ParameterError:
    """A refusal by the first of some keys that is changed and alone to blame, with its nearest value that works.

    ``checked`` refuses keys that do not work; ``ends``: what keys are and what is usual, where a default follows.
    """

    def works(name: str, value: object) -> bool:
        return kept(lambda value: checked(replace(keys, **{name: value})) is not None, value)

    usual = type(keys)()
    changed = [name for name in names if getattr(keys, name) != getattr(usual, name)]
    name = next((name for name in changed if works(name, getattr(usual, name))), (changed or names)[0])
    given, end = (ends or {}).get(name, (getattr(keys, name), getattr(usual, name)))
    if not isinstance(given, float) or not isinstance(end, float):
        return ParameterError(name, list(given) if isinstance(given, tuple) else given, code, None, **told)
    return ParameterError(name, given, code, partial(nearest, partial(works, name), given, end), **told)


def check_play(clearance: float, *diameters: float) -> None:
    """Refuse a clearance with which the thinnest of some pins, mm, lies loose in its hole."""
    if clearance > (most := min(diameters) * LOOSE):
        told = {"most": most, "diameter": min(diameters)}
        raise ParameterError("clearance", clearance, "pins_lie_loose", limit(most, clearance), **told)


def module_to_span(given: float, span: float, step: int = 1) -> Nearest | None:
    """The nearest module of three digits by which whole numbers from 12 on, each a multiple of ``step``, span mm."""
    modules = [span / n for n in range(12, round(span / _LEAST_MODULE) + 1, step)]
    told = [short for module in modules if abs((short := round(module, 3)) - module) < 1e-12]
    return Nearest(min(told, key=lambda module: abs(module - given))) if told else None


def mark(thickness: float) -> Table:
    """What a mark says of its depth, mm: half of what is thin is left under it."""
    return {"depth": thickness / 2} if thickness < 2 * _MARK else {}


class Making:
    """An expansion that grows; ``recipe``: whose names its parts have, ``keys``: that may say what all are made of."""

    def __init__(self, recipe: str, thickness: float, keys: RecipeKeys) -> None:
        self.found, self.recipe, self.names, self.thickness = Expansion(), recipe, NAMES[recipe], thickness
        for parts, key, own in (row for name, *row in _ORIGINS if name == recipe):
            self.told(*parts.split(), **{key: own})
        given = {key: getattr(keys, key, None) for key in ("material", "density")}
        self.material = {key: value for key, value in given.items() if value is not None}

    def part(self, name: str, colour: str = "", /, **keys: object) -> None:
        """A part of the material."""
        self.found.parts[name] = keys | self.material | {"colour": self.names[colour or name].colour}

    def name_all(self) -> None:
        """Give parts their titles and positions, and instances their titles."""
        for part, table in self.found.parts.items():
            known = self.names[part]
            table |= {"title": known.title}
            if known.position:
                table["position"] = int(known.position)
        self.found.name_instances(self.names)

    def told(self, *parts: str, **keys: str) -> None:
        """Which key of the recipe each of these keys of some parts is."""
        self.found.origins |= {f"parts.{part}.{key}": own for part in parts for key, own in keys.items()}

    def drive(self, keys: RecipeKeys, **instances: str) -> None:
        """Drives of instances, each by as many turns as a key of the recipe says."""
        for instance, key in instances.items():
            self.found.drives.append({"instance": instance, "turns": getattr(keys, key)})
            self.found.origins[f"drives[{len(self.found.drives)}].turns"] = key

    def plate(self, name: str, size: float, holes: Sequence[Table], *, square: bool = False, **more: object) -> None:
        """A disk of a diameter, or a square plate of a side."""
        radius = min(_CORNER, size / 8) if square else size / 2
        keys = {"width": size, "height": size, "corner_radius": radius, "face_width": self.thickness}
        self.part(name, kind="plate", **(keys | {"holes": list(holes)} | more))

    def pin(self, name: str, diameter: float, length: float, bore: float = 0.0) -> None:
        """A rod or a tube."""
        table = {"kind": "pin", "diameter": diameter, "length": length, "bore_diameter": bore}
        self.found.parts[name] = table | {"colour": self.names["pin"].colour}

    def crank(self, name: str, length: float, holes: tuple[float, float], ends: tuple[float, float]) -> None:
        """A link: diameters of its holes and of the round ends about them, that of the pivot first."""
        self.part(
            name, "crank", kind="follower_arm", end="roller", arm_length=length, boss_diameter=ends[0], width=ends[1],
            pivot_diameter=holes[0], pin_diameter=holes[1], face_width=self.thickness,
        )  # fmt: skip

    def hang_flange(self, pin: float, posts: float, pivots: float, boss: float, bore: float) -> None:
        """Hung by three cranks on ``posts``, what three hang on at ``pivots`` between them: radii, a pin's diameter."""
        self.part(
            "flange", kind="carrier_plate", number_of_pins=3, pin_circle_diameter=2 * posts, pin_diameter=pin,
            boss_diameter=2 * boss, face_width=self.thickness, hub_diameter=2 * (pivots + boss), bore_diameter=2 * bore,
            spacers={"count": 3, "pitch_circle_diameter": 2 * pivots, "diameter": pin, "boss_diameter": 2 * boss,
                     "start_deg": 60.0},
        )  # fmt: skip

    def hang_cranks(
        self, name: str, part: str, on: str, places: Sequence[complex], height: float,
        pins: Sequence[tuple[str, str, float]], carried: str = "",
    ) -> None:  # fmt: skip
        """Parallel cranks about places of what they turn on, at a height of that, and ``carried`` by another.

        ``pins``: of each crank what they are fixed to, which, and how high there.
        """
        for k, at in enumerate(places, 1):
            self.put("parallel", on, f"{name}_{k}", part, offset=place(at, height))
            if carried:
                self.mate("carried", carried, f"{name}_{k}")
            for holder, pin, low in pins:
                self.fix(holder, f"{pin}_{k}", at, low, pin)

    def put(self, kind: str, first: str, second: str, part: str = "", **keys: object) -> None:
        """An instance by its first mate."""
        self.found.instances[second] = {"part": part or second}
        self.mate(kind, first, second, **keys)

    def mate(self, kind: str, first: str, second: str, **keys: object) -> None:
        """One more mate of what stands."""
        self.found.mates.append({"kind": kind, "first": first, "second": second, **keys})

    def order(self, choice: str, **ways: Table) -> None:
        """The order of assembly in ``orders.psv``, for a choice of the recipe; ``ways``: what is said of its steps.

        What there is none of is left out.
        """
        for recipe, choices, to, steps, how in _ORDERS:
            if recipe != self.recipe or (choices and choice not in choices.split()) or not self._all_of(to):
                continue
            for way, things in (part.split(maxsplit=1) for part in steps.split(";")):
                along = {"along": list(WAYS[way])} if way in WAYS else {}
                more = along | ways.get(how, {how: True} if how else {})
                brought = ([key for name in one.split() for key in self._all_of(name)] for one in things.split(","))
                self.found.steps += [{"bring": bring, "to": to, **more} for bring in brought if bring]

    def _all_of(self, name: str) -> list[str]:
        """An instance or a group of them, else those of a part that are numbered one by one, else the part itself."""
        instances, parts = self.found.instances, self.found.parts
        numbered = [key for key in instances if key.rpartition("_")[0] == name]
        return [name] if name in instances else numbered or [name] * (name in parts)

    def fix(self, first: str, second: str, at: complex, height: float, part: str = "") -> None:
        """One body with the first; ``height`` above its lower face."""
        self.put("fixed", first, second, part, offset=place(at, height))

    def fix_each(self, first: str, part: str, places: Iterable[tuple[complex, float]]) -> None:
        """Ones of a part, numbered, of one body with the first: the place and the height of each."""
        for k, (at, height) in enumerate(places, 1):
            self.fix(first, f"{part}_{k}", at, height, part)


def place(at: complex, height: float) -> list[float]:
    """An offset as scenes have it, its rounding taken off."""
    return [round(at.real, 6), round(at.imag, 6), round(height, 6)]


def hole(at: complex, diameter: float) -> Table:
    """A round hole of a plate."""
    return {"at": place(at, 0.0)[:2], "diameter": diameter}


def on_circle(count: int, radius: float, start: float = 0.0) -> list[complex]:
    """Places about an axis; ``start``: the direction of the first, degrees."""
    return [cmath.rect(radius, math.radians(start) + 2 * math.pi * k / count) for k in range(count)]


def holes_on(count: int, diameter: float, radius: float, start: float = 0.0) -> Table:
    """Holes there."""
    return {"count": count, "diameter": diameter, "pitch_circle_diameter": 2 * radius, "start_deg": round(start, 9)}
