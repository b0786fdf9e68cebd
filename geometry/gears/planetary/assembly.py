"""Whether the satellites of a given set can be put in, and what would work where they cannot."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Literal

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record, replace
from geometry.gears.planetary.sets import SCHEMES, PlanetarySet, Scheme

# by how much teeth are changed for a set that can be assembled, and how many of these are tried
_NEARBY, _TRIED = 4, 10
# whether a set can be made with satellites so far apart, parts of a turn
Works = Callable[[PlanetarySet, Fraction], bool]


def given_set(
    scheme: Scheme, teeth: Sequence[int], modules: tuple[Fraction, Fraction], cosine: Fraction = Fraction(1)
) -> PlanetarySet:
    """The set of teeth z1, z2, z3, or z1, z2, z2', z3 of a scheme; ``cosine``: of the helix angle.

    Raises
    ------
    ParameterError
        ``teeth``: another number of wheels, a ring that is not larger than its satellite's rim.
    """
    wanted = 4 if scheme.double else 3
    if len(teeth) != wanted:
        name = next(name for name, known in SCHEMES.items() if known == scheme)
        raise ParameterError("teeth", list(teeth), "wheels_of_scheme", wheels=wanted, scheme=name)
    z1, z2, *rest = teeth
    one = PlanetarySet(scheme, (z1, z2, rest[0] if scheme.double else z2, rest[-1]), modules, cosine)
    for span, ring, rim in zip(one.spans, (z1, one.teeth[3]), one.teeth[1:3], strict=True):
        if span <= 0:
            raise ParameterError("teeth", list(teeth), "ring_not_above_rim", ring=ring, rim=rim)
    return one


def least_angle(places: Sequence[Fraction]) -> Fraction | None:
    """The least angle between neighbours, parts of a turn; None of one satellite."""
    if len(places) == 1:
        return None
    return min((b - a) % 1 for a, b in zip(places, (*places[1:], places[0]), strict=True))


class Satellites(Record):
    """Wanted satellites: equally spaced or as equally as alike ones can be, both rims clocked alike or not.

    ``gap``: what their tips keep, mm.
    """

    number: int
    spacing: Literal["equal", "unequal"] = "equal"
    identical: bool = True
    gap: Fraction = Fraction(0)

    def places(self, one: PlanetarySet, works: Works | None = None) -> tuple[Fraction, ...]:
        """Where they stand, parts of a turn; ``works``: of this set and of others that are offered, else by the teeth.

        Raises
        ------
        ParameterError
            ``satellites``: their tips overlap, or they do not go in; names what would work.
        """
        n = self.number
        works = works or (lambda other, apart: other.fits(apart, self.gap))
        equal = tuple(Fraction(k, n) for k in range(n))
        alike = one.spacing(n)
        free = one.scheme.double and not self.identical
        places = alike if self.spacing == "unequal" and alike is not None else equal
        apart = least_angle(places)
        if apart is not None and not works(one, apart):
            raise ParameterError("satellites", n, "satellites_collide", lambda: self._fewer(one, works))
        if alike is None and (self.spacing == "unequal" or not free):
            raise ParameterError("satellites", n, "too_few_places", Nearest(one.places, "at_most"), places=one.places)
        if alike is not None and self.spacing == "equal" and not free and alike != equal:
            degrees, teeth = ", ".join(f"{360 * float(p):.6g}" for p in alike), self._other_teeth(one, works)
            code = "satellites_do_not_divide"
            if teeth:
                beside = least_angle(alike)
                room = beside is None or works(one, beside)
                code = "satellites_not_assembled" if room else "satellites_take_other_teeth"
            raise ParameterError("satellites", n, code, lambda: self._other_number(one, works), places=one.places,
                                 teeth=teeth, spacing=degrees)  # fmt: skip
        return places

    def _most(self, one: PlanetarySet, works: Works, limit: int) -> int:
        """The most satellites up to a limit that keep apart where they are equally spaced."""
        good, bad = 1, limit + 1
        while bad - good > 1:
            between = (good + bad) // 2
            good, bad = (between, bad) if works(one, Fraction(1, between)) else (good, between)
        return good

    def _fewer(self, one: PlanetarySet, works: Works) -> Nearest:
        """The most satellites below the wanted number that fit."""

        def fit(number: int) -> bool:
            if self.spacing == "equal":
                return (one.scheme.double and not self.identical) or one.places % number == 0
            apart = least_angle(one.spacing(number) or (Fraction(0), Fraction(0)))
            return apart is None or works(one, apart)

        return Nearest(next(k for k in range(self._most(one, works, self.number - 1), 0, -1) if fit(k)), "at_most")

    def _other_number(self, one: PlanetarySet, works: Works) -> Nearest:
        """The number of satellites nearest to the wanted one that fits."""
        fitting = [k for k in range(1, self._most(one, works, 2 * self.number) + 1) if one.places % k == 0]
        return Nearest(min(fitting, key=lambda k: (abs(k - self.number), -k)))

    def _other_teeth(self, one: PlanetarySet, works: Works) -> str:
        """The teeth nearby, coaxial without shifts, that take so many satellites, by ratio, then by change; or ""."""
        apart = Fraction(1, self.number)
        found = []
        changes = range(-_NEARBY, _NEARBY + 1)
        for z1 in (one.teeth[0] + k for k in changes):
            for z2 in (one.teeth[1] + k for k in changes):
                for z2p in [one.teeth[2] + k for k in changes] if one.scheme.double else [z2]:
                    other = _coaxial(one, z1, z2, z2p) if min(z1, z2, z2p) >= 3 else None
                    if other is None or other.places % self.number or other.spans[0] <= 0 or not other.fits(apart):
                        continue
                    change = sum(abs(a - b) for a, b in zip(other.teeth, one.teeth, strict=True))
                    found.append((abs(other.carried_ratio - one.carried_ratio), change, other))
        nearby = (other for _, _, other in sorted(found, key=lambda item: item[:2])[:_TRIED])
        return next((other.name for other in nearby if works(other, apart)), "")


def _coaxial(one: PlanetarySet, z1: int, z2: int, z2p: int) -> PlanetarySet | None:
    """A set of the same scheme whose z3 makes it coaxial without shifts."""
    (m1, m2), (inside1, inside2) = one.modules, one.scheme.internal
    span = m1 * (z1 - z2 if inside1 else z1 + z2) / m2
    z3 = span + z2p if inside2 else span - z2p
    return replace(one, teeth=(z1, z2, z2p, int(z3))) if z3.denominator == 1 and z3 >= 3 else None
