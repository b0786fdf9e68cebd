"""Wedge cams: a plate that slides along -x moves its follower by the profile of its upper edge.

Frame of the plate: x along the travel, y up, y = 0 the plate's lower edge; at travel t the plate's point x = t stands
under the follower's starting place. Seen from the plate the follower slides by t along +x, so its centre runs along
z(t) = t + m(t), m its path in the fixed frame, and the profile is z + i d z'/|z'| with d = -r: the envelope of Savvin's
method for a translation, in closed form (tests hold it against tests/oracles/envelope.py). A flat face has no place
here: wherever the follower rests, the common normal would have to pass through an instant centre at infinity.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import OffsetError, ParameterError
from geometry.base.nearest import last_that_holds
from geometry.base.record import Record
from geometry.base.series import Series, affine, derived, exponential, taylor
from geometry.cams.motion.follower_motion import Phase, PieceMotion, pieces_of
from geometry.cams.plane.curves import CentreEnvelope, Lift
from geometry.cams.plane.disk import FollowerKind
from geometry.cams.plane.undercut import least_stretch
from geometry.curves.curve import Complex, Curve, Real, Reversed, end_point, start_point, vertex_sign
from geometry.curves.line_arc import Arc, Line
from geometry.laws.piece import LawPiece
from geometry.plane.profile import Label, Profile, Segment

_SAMPLES, _STEEP_SAMPLES = 513, 257
# a crest whose radius of curvature is less than this part of the path's is a corner
_SHARP = 1e-7
# a step of the envelope below this part of its size is none
_JOINT = 1e-12


class Upright(Record):
    """A follower that slides along +y at x = 0; its centre stands at ``start_height`` mm at S = 0."""

    start_height: float

    @property
    def lever(self) -> float:
        """Way of its centre for each unit of S."""
        return 1.0

    def centre(self, s: Series) -> Series:
        """Path of its centre in the fixed frame."""
        return [1j * (self.start_height + s[0]), *(1j * x for x in s[1:])]

    def centre_bound(self, s: Series, about: object = None) -> Series:
        """Bounds of the moduli of that series from those of S."""
        return [abs(self.start_height) + s[0], *s[1:]]

    def place(self, centre: Complex) -> tuple[Real, Real]:
        """Where the follower must start for its centre to stand there in the plate's frame, and its S: t and S."""
        return centre.real, centre.imag - self.start_height


class Swinging(Record):
    """An arm about a pivot in the fixed frame, mm; its end stands at x = 0 where S = 0, S in rad rises it.

    ``side`` +1: the pivot stands at +x, so that the plate's friction pulls the arm; -1: at -x.
    """

    pivot: complex
    arm_length: float
    start_angle: float
    side: int = 1

    @property
    def lever(self) -> float:
        """Way of its centre for each unit of S, mm/rad."""
        return self.arm_length

    def centre(self, s: Series) -> Series:
        """Path of the arm's end: pivot - side L exp(-i side psi)."""
        turn = exponential([-1j * self.side * x for x in (self.start_angle + s[0], *s[1:])])
        return affine(self.pivot, -self.side * self.arm_length, turn)

    def centre_bound(self, s: Series, about: object = None) -> Series:
        """Bounds of the moduli of that series from those of S."""
        turn = exponential([0.0 * s[0], *s[1:]])
        return affine(abs(self.pivot), self.arm_length, turn)

    def place(self, centre: Complex) -> tuple[Real, Real]:
        """The travel t and S at which the arm's end stands there in the plate's frame; not a number: nowhere."""
        with np.errstate(invalid="ignore"):
            psi = np.arcsin((centre.imag - self.pivot.imag) / self.arm_length)
        at = centre.real - self.pivot.real + self.side * self.arm_length * np.cos(psi)
        return at, psi - self.start_angle


class SlideEnvelope(CentreEnvelope):
    """The path of a follower's centre in the sliding plate's frame over the travel t, mm, or a parallel of it."""

    def _fixed(self, t: Real, order: int) -> tuple[Series, Series]:
        """Taylor coefficients of z = t + m and of z'."""
        centre = self.mount.centre(taylor(self.lift.values(t, order + 1)))
        centre = [centre[0] + t, centre[1] + 1.0, *centre[2:]]
        return centre, derived(centre)

    def _fixed_bound(self, order: int, a: Real, b: Real) -> tuple[Series, Series]:
        whole = self.mount.centre_bound(taylor(self.lift.bounds(order, a, b)))
        whole = [whole[0] + np.maximum(np.abs(a), np.abs(b)), whole[1] + 1.0, *whole[2:]]
        return whole, derived(whole)

    def _in_cam(self, fixed: Series, t: Real | None) -> Series:
        """The plate does not turn."""
        return fixed

    def pitch_curvature(self, t: ArrayLike) -> Real:
        """Curvature of the centre's path, 1/mm: positive in a valley, which the follower must fit into."""
        _, (first, second) = self._fixed(np.asarray(t, dtype=float), 1)
        return (np.conj(first) * second).imag / np.abs(first) ** 3

    def vertex_function(self, t: ArrayLike) -> Real:
        """Changes its sign where the curvature is greatest or least."""
        _, (v, a, half) = self._fixed(np.asarray(t, dtype=float), 2)
        return vertex_sign(v, a, 2 * half)

    def tangent(self, t: ArrayLike) -> Complex:
        at = np.asarray(t, dtype=float)
        first = self._fixed(at, 0)[1][0]
        sense = np.where(self.stretch(at) < 0, -1.0, 1.0) if self.distance else 1.0
        return sense * first / np.abs(first)


class WedgeMotion(PieceMotion, Record):
    """S over the travel t from 0 to the whole travel, mm: analytic pieces one behind the other."""

    pieces: tuple[LawPiece, ...]

    @property
    def travel(self) -> float:
        """The whole travel, mm."""
        return self.pieces[-1].end


def wedge_motion(phases: Sequence[Phase]) -> WedgeMotion:
    """The motion of phases that follow each other; the ``angle`` of each is its travel, mm.

    Raises
    ------
    ParameterError
        No phase, or one without travel.
    """
    if not phases:
        raise ParameterError("phases", 0, "no_phases")
    for index, phase in enumerate(phases):
        if not phase.angle > 0:
            raise ParameterError(f"phases[{index + 1}].travel", phase.angle, "not_above_zero")
    return WedgeMotion(tuple(pieces_of(phases)))


class WedgeCam(Record):
    """The motion, how the follower is guided, its radius, mm (0 of a point), and its shape.

    ``runs``: straight ends of the plate before and after the profile, ``corner``: rounding of its corners, mm.
    """

    motion: WedgeMotion
    mount: Upright | Swinging
    radius: float = 0.0
    kind: FollowerKind = FollowerKind.ROLLER
    runs: tuple[float, float] = (10.0, 10.0)
    corner: float = 0.0

    def curve(self, piece: Lift, start: float, end: float, grow: float = 0.0) -> SlideEnvelope:
        """The exact profile over one piece of the motion, ``grow`` mm out of the material."""
        return SlideEnvelope(piece, self.mount, start, end, grow - self.radius)

    def centre(self, travel: ArrayLike) -> Complex:
        """The follower's centre in the plate's frame, mm."""
        at = np.asarray(travel, dtype=float)
        return at + self.mount.centre([self.motion.value(at)])[0]

    def rate(self, travel: ArrayLike) -> Complex:
        """Its derivative over the travel."""
        at = np.asarray(travel, dtype=float)
        return 1.0 + self.mount.centre([self.motion.value(at), self.motion.value(at, 1)])[1]

    def pressure_angle(self, travel: ArrayLike) -> Real:
        """Signed, rad: between the normal and the velocity of the rising follower's centre; upright tan nu = S'."""
        normal = 1j * self.rate(travel)
        at = np.asarray(travel, dtype=float)
        way = self.mount.centre([self.motion.value(at), np.ones(np.shape(at))])[1]
        return -np.angle(way / normal)

    def pitch_curvature(self, travel: ArrayLike) -> Real:
        """Curvature of the centre's path, 1/mm: negative at crests."""
        return self.curve(self.motion, 0.0, self.motion.travel, self.radius).pitch_curvature(travel)

    @property
    def swings(self) -> bool:
        """Whether the follower swings about a pivot."""
        return isinstance(self.mount, Swinging)

    @property
    def is_flat(self) -> bool:
        """A flat face is no follower of a wedge."""
        return False

    def stop(self, point: Complex, normal: Complex, offset: float) -> tuple[Real, Real]:
        """Where an edge's point with its outward normal stops the follower: the travel as an angle, and S there.

        The whole travel is half a turn; what lies far beyond its ends, or looks down, is not a number.
        """
        at, lift = self.mount.place(point + (self.radius - offset) * normal)
        angle = at * (math.pi / self.motion.travel)
        held = (normal.imag > 0) & (np.abs(angle - math.pi / 2) < 0.6 * math.pi)
        return np.where(held, angle, np.nan), lift

    @property
    def ends(self) -> tuple[float, float]:
        """x of the plate's ends, mm: its profile ends where the arm has carried the follower."""
        first, last = (float(self.centre(at).real) for at in (0.0, self.motion.travel))
        return first - self.runs[0], last + self.runs[1]

    def height_at(self, travel: float) -> float:
        """y of the profile under the resting follower, mm."""
        return float(self.centre(travel).imag) - self.radius


def wedge_fault(cam: WedgeCam, grow: float = 0.0) -> tuple[str, float] | None:
    """Why a profile is not whole, and where along the travel, mm: None where it is.

    "steep": the follower runs along with the plate; "crest": one of the path is sharper than the follower; "corner": a
    jump of velocity makes such a crest. A path that always goes on in x, with a parallel that does so too, has no
    double point.
    """
    before: complex | None = None
    for piece in _with_runs(cam, (1.0, 1.0)):
        curve, path = (cam.curve(piece, *piece.domain, g) for g in (grow, cam.radius))
        t = np.linspace(*piece.domain, _SAMPLES)
        rate = path.derivative(t)
        if not np.all(rate.real > 0):
            return "steep", float(t[int(np.argmin(rate.real))])
        if least_stretch(curve, t) <= _SHARP:
            return "crest", float(t[int(np.argmin(curve.stretch(t)))])
        start = complex(curve.point(piece.start))
        # a valley opens a gap, which the follower's own arc fills; at a crest both sides step back and cross
        if before is not None and (start - before).real < -_JOINT * (1 + abs(start)):
            return "corner", piece.start
        before = complex(curve.point(piece.end))
    return None


def steepest(cam: WedgeCam, sense: int) -> float | None:
    """Greatest pressure angle while the follower rises (``sense`` 1) or sinks (-1), rad; None where it never does."""
    worst = None
    for piece in cam.motion.pieces:
        if piece.is_constant:
            continue
        t = np.union1d(np.linspace(*piece.domain, _STEEP_SAMPLES), piece.extremes(1))
        rate = sense * piece.value(t, 1)
        if not rate.max() > 0:
            continue
        # the piece's end as it is seen from the left
        nu = np.abs(cam.pressure_angle(np.minimum(t, np.nextafter(piece.end, 0))))
        found = float(np.where(rate >= 0, nu, 0.0).max())
        worst = found if worst is None else max(worst, found)
    return worst


def sharpest_crest(cam: WedgeCam) -> float:
    """Least radius of curvature of the path's crests, mm: a roller must be smaller; inf without crests."""
    worst = 0.0
    for piece in cam.motion.pieces:
        path = cam.curve(piece, *piece.domain, cam.radius)
        t = np.linspace(*piece.domain, _SAMPLES)
        lowest = int(np.argmin(path.pitch_curvature(t)))
        near = np.linspace(t[max(lowest - 1, 0)], t[min(lowest + 1, len(t) - 1)], _SAMPLES)
        worst = min(worst, float(path.pitch_curvature(near).min()))
    return math.inf if worst >= 0 else -1 / worst


def wedge_profile(cam: WedgeCam, grow: float = 0.0) -> Profile:
    """The plate's outline, counter-clockwise, moved ``grow`` mm out of the material.

    Raises
    ------
    OffsetError
        The profile is not whole any more, or an end vanishes; names the nearest offset that works.
    """
    made = _outline(cam, grow)
    if made is not None:
        return made
    works = last_that_holds(lambda offset: _outline(cam, offset) is not None, grow)
    raise OffsetError(grow, "no_whole_profile", works)


def _outline(cam: WedgeCam, grow: float) -> Profile | None:
    """The outline, or None where it is not whole."""
    radius, (start, end) = max(0.0, cam.corner + grow), cam.ends
    first, last = (cam.height_at(at) + grow for at in (0.0, cam.motion.travel))
    left, right = start - grow, end + grow
    least = min(first, last, *(_lowest(cam, p) + grow for p in cam.motion.pieces))
    if wedge_fault(cam, grow) is not None or not least + grow > 2 * radius or not least + grow > 0:
        return None
    top = _top(cam, grow)
    # the straight ends are cut or made longer as far as the corners' roundings
    left_end, right_end = end_point(top[0]), start_point(top[-1])
    if not (left + radius < left_end.real and right_end.real < right - radius):
        return None
    top = [Line(complex(left + radius, first), left_end), *top[1:-1], Line(right_end, complex(right - radius, last))]
    made: list[Curve] = [Line(complex(left + radius, -grow), complex(right - radius, -grow))]
    made += _corner(complex(right, -grow), radius, -math.pi / 2)
    made.append(Line(complex(right, -grow + radius), complex(right, last - radius)))
    made += _corner(complex(right, last), radius, 0.0)
    made += [c.reversed() for c in reversed(top)]
    made += _corner(complex(left, first), radius, math.pi / 2)
    made.append(Line(complex(left, first - radius), complex(left, -grow + radius)))
    made += _corner(complex(left, -grow), radius, math.pi)
    return Profile(tuple(Segment(c, Label.CAM if isinstance(c, Reversed) else Label.BODY) for c in made))


def _corner(tip: complex, radius: float, start: float) -> list[Curve]:
    """The rounding of a square corner, counter-clockwise from a direction, rad."""
    if radius == 0:
        return []
    return [
        Arc(tip - radius * (cmath.exp(1j * start) + cmath.exp(1j * (start + math.pi / 2))), radius, start, math.pi / 2)
    ]


def _lowest(cam: WedgeCam, piece: LawPiece) -> float:
    """Lowest height of the profile over a piece, mm: no lower than its lowest follower."""
    return float((cam.centre(np.minimum(piece.extremes(0), piece.end)).imag - cam.radius).min())


def _with_runs(cam: WedgeCam, runs: tuple[float, float]) -> list[LawPiece]:
    """The motion with a rest before and one after it, mm of travel."""
    pieces, travel = cam.motion.pieces, cam.motion.travel
    before, after = (float(cam.motion.value(at)) for at in (0.0, travel))
    return [LawPiece(-runs[0], 0.0, (before,)), *pieces, LawPiece(travel, travel + runs[1], (after,))]


def _top(cam: WedgeCam, grow: float) -> list[Curve]:
    """The profile along the travel: exact curves split at inflections and vertices, arcs where velocity jumps."""
    made: list[Curve] = []
    for piece in _with_runs(cam, cam.runs):
        curve = cam.curve(piece, *piece.domain, grow)
        if made:
            start, end = end_point(made[-1]), complex(curve.point(piece.start))
            if abs(end - start) > _JOINT * (1 + abs(start)):
                centre = complex(cam.curve(piece, *piece.domain, cam.radius).point(piece.start))
                sweep = cmath.phase((end - centre) / (start - centre))
                made.append(Arc(centre, abs(grow - cam.radius), cmath.phase(start - centre), sweep))
        if piece.is_constant:
            made.append(Line(complex(curve.point(piece.start)), complex(curve.point(piece.end))))
            continue
        made += [curve.trimmed(a, b) for a, b in pairwise(curve.quiet_edges())]
    return made
