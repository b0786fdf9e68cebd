"""The motion that a cam of arcs and lines gives: base circle, flanks tangent to it, a nose tangent to both.

Khurmi and Gupta, Theory of Machines, chapter 20, "cams with specified contours". The follower slides on a line
through the axis; theta is the cam angle from where it leaves the base circle, alpha that of the whole rise. With k the
curvature of the flank (above 0 convex, 0 straight, below 0 hollow), r_1, r_2 the radii of base circle and nose, d from
the axis to the nose's centre P = d exp(i alpha), and r of a roller: the flank's circle has its centre at -(1/k - r_1),
so it meets the nose tangentially where |1 - k r_1 + k P| = 1 - k r_2, along the normal
u = (1 - k r_1 + k P) / (1 - k r_2). All that follows is written so that k = 0 is no case of its own.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.base.series import FACTORIALS, Series, power, product, quotient, taylor
from geometry.laws.law import Law
from geometry.laws.piece import LawPiece, Wave
from geometry.laws.splines import hermite_coefficients

# most derivatives that a piece meets at both ends: of degree 2 m - 1 it leaves its formula by x^(2 m), x being half of
# it by the way to where the formula ends, and so by less than a rounding
_MOST_MET, _ROUNDING = 16, 1e-16
# sizes closer than this share of each other are equal
_EQUAL = 1e-9
# rad: at a greater pressure angle no follower slides
_STEEPEST = math.radians(80)


# names of the laws
STRAIGHT, ARCS, ECCENTRIC = "straight flanks and nose", "arc flanks and nose", "eccentric circle"
# of an angle, so many terms of a series
Formula = Callable[[float, int], Series]


class Contour(Record):
    """Radii of base circle and nose, mm, lift, mm, curvature of the flanks, 1/mm, cam angle of the rise, rad."""

    base_radius: float
    nose_radius: float
    lift: float
    curvature: float
    rise_angle: float

    @property
    def centre_distance(self) -> float:
        """From the axis to the nose's centre, mm."""
        return self.base_radius + self.lift - self.nose_radius

    @property
    def is_eccentric(self) -> bool:
        """Whether the nose is the whole outline: a circle about a point beside the axis."""
        return self.rise_angle == math.pi

    @property
    def nose_normal(self) -> float:
        """Direction of the normal where the flank meets the nose, rad from where it leaves the base circle."""
        if self.is_eccentric:
            return 0.0
        k = self.curvature
        return cmath.phase(1 - k * self.base_radius + k * cmath.rect(self.centre_distance, self.rise_angle))

    def change(self, radius: float) -> float:
        """The cam angle at which a roller of this radius goes from the flank to the nose, rad."""
        if self.is_eccentric:
            return 0.0
        meets = cmath.rect(self.nose_radius + radius, self.nose_normal)
        return cmath.phase(cmath.rect(self.centre_distance, self.rise_angle) + meets)


def contour(
    base: float,
    lift: float | None = None,
    nose: float | None = None,
    rise_angle: float | None = None,
    curvature: float | None = None,
) -> Contour:
    """The contour on a base circle, mm, of three of the other sizes; without a curvature two are for straight flanks.

    A nose of half the greatest diameter is a circle about a point beside the axis: it needs neither flank nor angle.

    Raises
    ------
    ParameterError
        ``contour``: too few sizes, or ones that no outline has.
    """
    if lift is not None and nose is not None and abs(lift - 2 * (nose - base)) <= _EQUAL * lift:
        if curvature is None and rise_angle in (None, math.pi):
            return Contour(base, nose, lift, 0.0, math.pi)
        raise ParameterError("contour", None, "eccentric_has_no_flank")
    if curvature is None and (lift, nose, rise_angle).count(None) == 1:
        curvature = 0.0
    if (lift, nose, rise_angle, curvature).count(None) > 1:
        raise ParameterError("contour", None, "contour_too_few")
    if lift is not None and nose is not None and rise_angle is not None and curvature is not None:
        raise ParameterError("contour", None, "contour_overdetermined")
    try:
        found = _solved(base, lift, nose, rise_angle, curvature)
    except (ValueError, ZeroDivisionError) as error:
        raise ParameterError("contour", None, "no_such_contour") from error
    r, k = found.base_radius, found.curvature
    whole = min(found.lift, found.nose_radius, found.centre_distance, 1 - k * r, 1 - k * found.nose_radius) > 0
    if not whole or not 0 < found.rise_angle < math.pi:
        raise ParameterError("contour", None, "no_such_contour")
    return found


def _solved(
    base: float, lift: float | None, nose: float | None, rise_angle: float | None, curvature: float | None
) -> Contour:
    """The one missing size, from 2 (r_1 - r_2 - d cos alpha) = k (r_1^2 + d^2 - 2 r_1 d cos alpha - r_2^2)."""
    if lift is None:
        assert nose is not None
        assert rise_angle is not None
        assert curvature is not None
        # a square in d: of its roots the one that stays where k = 0, unless that lies beyond the axis
        half = (curvature * base - 1) * math.cos(rise_angle)
        rest = (base - nose) * (curvature * (base + nose) - 2)
        whole = half + math.copysign(math.sqrt(half**2 - curvature * rest), half)
        d = rest / whole
        lift = (d if d > 0 else whole / curvature) - base + nose
        return Contour(base, nose, lift, curvature, rise_angle)
    if nose is None:
        assert rise_angle is not None
        assert curvature is not None
        c, most = math.cos(rise_angle), base + lift
        above = 2 * (base - most * c) - curvature * (base**2 + most**2 - 2 * base * most * c)
        nose = above / (2 * (1 - c) - 2 * curvature * (most - base * c))
        return Contour(base, nose, lift, curvature, rise_angle)
    d = base + lift - nose
    if rise_angle is None:
        assert curvature is not None
        above = 2 * (base - nose) - curvature * (base**2 + d**2 - nose**2)
        return Contour(base, nose, lift, curvature, math.acos(above / (2 * d * (1 - curvature * base))))
    c = math.cos(rise_angle)
    k = 2 * (base - nose - d * c) / (base**2 + d**2 - 2 * base * d * c - nose**2)
    return Contour(base, nose, lift, k, rise_angle)


def flat_law(shape: Contour) -> Law:
    """The rise of a flat face: (1/k - r_1)(1 - cos theta), then d cos(alpha - theta) + r_2 - r_1.

    Raises
    ------
    ParameterError
        ``contour``: flanks that are not convex: the face would strike the nose.
    """
    alpha, d, change = shape.rise_angle, shape.centre_distance, shape.nose_normal
    low = shape.nose_radius - shape.base_radius
    nose = LawPiece(change, alpha, (low,), (Wave(d, 1.0, math.pi / 2 - alpha + change),))
    if shape.is_eccentric:
        return _law(shape, [nose])
    if not shape.curvature > 0:
        raise ParameterError("contour", None, "face_needs_convex_flank")
    away = 1 / shape.curvature - shape.base_radius
    return _law(shape, [LawPiece(0.0, change, (away,), (Wave(-away, 1.0, math.pi / 2),)), nose])


def roller_law(shape: Contour, radius: float) -> Law:
    """The rise of a roller, a mushroom or (radius 0) a point: rho(theta) - r_1 - r by its centre's distance rho.

    On the flank k rho^2 + 2 (1 - k r_1) cos theta rho = (r_1 + r)(2 + k (r - r_1)), on the nose
    rho = d cos(alpha - theta) + sqrt((r_2 + r)^2 - d^2 sin^2(alpha - theta)).

    Raises
    ------
    ParameterError
        ``contour``: the roller does not fit into a hollow flank, or is pushed across.
    """
    k, base, alpha, d = shape.curvature, shape.base_radius, shape.rise_angle, shape.centre_distance
    reach, change = shape.nose_radius + radius, shape.change(radius)
    if not 1 + k * radius > 0:
        raise ParameterError("contour", None, "roller_above_hollow", radius=-1 / k)
    # the pressure angle is greatest where the contact changes, of an eccentric circle where its centre stands aside
    steep = math.asin(min(d / reach, 1.0)) if shape.is_eccentric else abs(shape.nose_normal - change)
    if not steep < _STEEPEST or not change < alpha:
        raise ParameterError("contour", None, "contour_too_steep", most=math.degrees(_STEEPEST))

    constant = (base + radius) * (2 + k * (radius - base))

    def on_flank(at: float, met: int) -> Series:
        cosine = [(1 - k * base) * x for x in _cosine(at, met)]
        root = _root(cosine, k * constant)
        return quotient([constant, *[0.0] * (met - 1)], [a + b for a, b in zip(cosine, root, strict=True)])

    def on_nose(at: float, met: int) -> Series:
        cosine = [d * x for x in _cosine(at - alpha, met)]
        return [a + b for a, b in zip(cosine, _root(cosine, reach**2 - d**2), strict=True)]

    pieces: list[LawPiece] = []
    if not shape.is_eccentric:
        pieces += _pieces(on_flank, 0.0, change, _ends(0.0, (1 + k * radius) / (1 - k * base)), base + radius)
    pieces += _pieces(on_nose, change, alpha, _ends(alpha, reach / d), base + radius)
    return _law(shape, pieces)


def _law(shape: Contour, pieces: list[LawPiece]) -> Law:
    """The law of pieces over rad and mm."""
    name = ECCENTRIC if shape.is_eccentric else ARCS if shape.curvature else STRAIGHT
    placed = [p.placed(0.0, 1 / shape.rise_angle, 0.0, 1 / shape.lift) for p in pieces]
    edges = [0.0, *(p.start for p in placed[1:]), 1.0]
    return Law(name, tuple(p.spanning(a, b) for p, a, b in zip(placed, edges, edges[1:], strict=False)))


def _cosine(at: float, met: int) -> Series:
    """The series of cos about ``at``."""
    c, s = math.cos(at), math.sin(at)
    return taylor([(c, -s, -c, s)[k % 4] for k in range(met)])


def _root(cosine: Series, constant: float) -> Series:
    """The series of sqrt(c^2 + constant)."""
    square = product(cosine, cosine)
    return power([square[0] + constant, *square[1:]], 0.5)


def _ends(about: float, sine: float) -> list[complex]:
    """The next places in the complex plane where sin(theta - about) = +-``sine``: there a formula ends."""
    side = complex(math.pi / 2, math.acosh(sine)) if sine > 1 else complex(math.asin(sine))
    return [about + side, about - side]


def _pieces(formula: Formula, start: float, end: float, ends: list[complex], low: float) -> list[LawPiece]:
    """Polynomials that meet the derivatives of a formula at both ends, less ``low``: one, or as many as it takes."""
    middle = (start + end) / 2
    share = (end - start) / 2 / min(abs(middle - z) for z in ends)
    met = math.ceil(math.log(_ROUNDING) / (2 * math.log(share))) if share < 1 else _MOST_MET + 1
    if met > _MOST_MET:
        return [
            *_pieces(formula, start, middle, ends, low),
            *_pieces(formula, middle, end, ends, low),
        ]
    left, right = ([x * FACTORIALS[k] for k, x in enumerate(formula(at, met))] for at in (start, end))
    left[0], right[0] = left[0] - low, right[0] - low
    return [LawPiece(start, end, hermite_coefficients(left, right, end - start))]
