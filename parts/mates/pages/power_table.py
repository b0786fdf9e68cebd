"""``higherpair calc power-table``: the angles and worm turns of the two-disk power module for points or for a path."""

from __future__ import annotations

import cmath
import math
from typing import Annotated, Literal

import numpy as np
from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.kinematics.two_disk import Orientation, TwoDisk
from geometry.kinematics.two_disk_path import Piece, followed
from parts.base.refusal import REMOVED
from parts.base.texts import N_, Text, message
from parts.keys.base import check_not_in_vain, degrees, mm
from parts.mates.pages.contour_marks import checked_picture
from parts.pages.inputs import calculation
from parts.pages.misprints import printed_for_delta
from parts.pages.page import Sheet
from parts.pages.table_scheme import scheme

TOPIC = "power-table"
_THESIS = "thesis, 2.1"
# the keys of a point, together
_PLACES = "x, y"
_MOST = 10_000.0
# I turns disk 2, II the ring
DRIVES = {"I": N_("drive I"), "II": N_("drive II")}
_Teeth = Annotated[int, Meta(ge=1, le=10_000)]
_Arm = Annotated[float, mm("length", above=0, most=_MOST)]
_Place = Annotated[float, mm("coordinate", least=-_MOST, most=_MOST)]

_PAIR_TEETH = Meta(description="teeth of disk 3's pinion and of the ring")
_WORM_RATIOS = Meta(description="teeth of the worm wheels for one start")
_WHEELS = (36, 36)
_ORIENTATION_TEETH = Meta(description="teeth of the wheels 6 (and 7) and 8 of the thesis")


class TwoDiskKeys(Struct, kw_only=True, forbid_unknown_fields=True):
    """Keys of the mechanism."""

    arms: Annotated[tuple[_Arm, _Arm], mm("L1 = O1O2 and L2 = O2O3", example=[72.0, 72.0])] | None = None
    pair_teeth: Annotated[tuple[_Teeth, _Teeth], _PAIR_TEETH] = (96, 144)
    worm_ratios: Annotated[tuple[_Teeth, _Teeth], _WORM_RATIOS] = (128, 106)
    orientation: Annotated[Orientation, Meta(description="what turns the platform")] = "cranks"
    orientation_teeth: Annotated[tuple[_Teeth, _Teeth], _ORIENTATION_TEETH] = _WHEELS

    @property
    def lengths(self) -> tuple[float, float]:
        """L1 and L2, mm; the thesis's where none are given."""
        return self.arms or TwoDisk().arms

    @property
    def table(self) -> TwoDisk:
        """The mechanism; its ring is larger than the pinion, and the thesis alone turns the platform by wheels."""
        if self.orientation != "thesis" and self.orientation_teeth != _WHEELS:
            raise ParameterError("orientation_teeth", list(self.orientation_teeth), "for_thesis_only", REMOVED)
        if self.pair_teeth[0] >= self.pair_teeth[1]:
            raise ParameterError("pair_teeth", list(self.pair_teeth), "ring_as_its_wheel")
        return TwoDisk(arms=self.lengths, teeth=self.pair_teeth, worm_ratios=self.worm_ratios)


# all but a whole turn has less
_Bulge = Annotated[float, Meta(ge=-1e6, le=1e6)]
_PATH = Meta(description="a DXF file of lines, arcs and polylines, or pieces x1, y1, x2, y2, bulge")


class PowerTableKeys(TwoDiskKeys, kw_only=True):
    """Keys of the topic."""

    x: Annotated[_Place | list[_Place], mm("x of a point, or of several")] | None = None
    y: Annotated[_Place | list[_Place], mm("y of a point, or of several")] | None = None
    path: Annotated[list[tuple[_Place, _Place, _Place, _Place, _Bulge]], _PATH] | None = None
    tolerance: Annotated[float, mm("how far the platform may leave the path", least=1e-6, most=10)] = 0.01
    elbow: Annotated[Literal[1, -1], Meta(description="with which sign of beta the path begins")] | None = None
    picture: Annotated[str, Meta(description="SVG file of the scheme to write")] | None = None
    start_deg: Annotated[float, degrees("delta before the path begins", least=-36_000, most=36_000)] | None = None


@calculation(TOPIC, PowerTableKeys)
def sheet(keys: PowerTableKeys) -> Sheet:
    """The table of points or of a path."""
    checked_picture(TOPIC, keys.picture, (".svg",))
    page = Sheet(TOPIC, N_("Two-disk power table"), picture_file=keys.picture)
    if keys.path is None:
        _points(page, keys)
        return page
    for name, given_too in (("x", keys.x), ("y", keys.y)):
        if given_too is not None:
            raise ParameterError(name, given_too, "either_of", None, other="path")
    _path(page, keys)
    return page


def given(page: Sheet, keys: TwoDiskKeys) -> None:
    """The mechanism's own sizes."""
    page.section("Given")
    page.told(first_arm=keys.lengths[0], second_arm=keys.lengths[1])
    page.add("number_of_teeth", keys.pair_teeth[0], symbol="z_11")
    page.add("number_of_teeth", keys.pair_teeth[1], symbol="z_12")
    page.add("pair_ratio", keys.table.ratio, "{z_12} / {z_11}", _THESIS)
    for drive, ratio in zip(DRIVES, keys.worm_ratios, strict=True):
        page.add("worm_ratio", ratio, symbol=f"u_{drive}", key=f"u_{drive}", of=DRIVES[drive])
    page.add("disk_3_ratio", keys.worm_ratios[1] / keys.table.ratio, "{u_II} / {u}", _THESIS)
    if keys.orientation == "thesis":
        page.add("number_of_teeth", keys.orientation_teeth[0], symbol="z_6")
        page.add("number_of_teeth", keys.orientation_teeth[1], symbol="z_8")


def check_reach(table: TwoDisk, points: Complex | complex) -> None:
    """Refuse points out of reach, with what is typed for the nearest that is in it.

    Raises
    ------
    ParameterError
        Of the first such point.
    """
    try:
        table.inverse(points)
    except ParameterError as refusal:
        near = refusal.nearest.value if refusal.nearest is not None else None
        typed = Nearest("x={:.12g} y={:.12g}".format(*near), "meant") if isinstance(near, list) else None
        raise refusal.told_of(_PLACES, refusal.value, typed) from refusal


def _points(page: Sheet, keys: PowerTableKeys) -> None:
    """One point step by step, for both elbows; and the table."""
    if keys.x is None or keys.y is None:
        missing = "x" if keys.x is None else "y"
        raise ParameterError(missing, None, "missing_key", None, what=message("x and y of a point, or path=FILE"))
    check_not_in_vain(keys, ("elbow", "tolerance"), "path")
    x, y = np.atleast_1d(keys.x), np.atleast_1d(keys.y)
    if len(x) != len(y) or not len(x):
        raise ParameterError("y", keys.y, "as_many_as_x")
    points, table = x + 1j * y, keys.table
    check_reach(table, points)
    given(page, keys)
    if len(points) == 1:
        _steps(page, keys, complex(points[0]))
    rows, joints = [], list[tuple[complex, complex]]()
    for elbow in (1, -1):
        delta, beta = table.inverse(points, elbow, math.radians(keys.start_deg or 0.0))
        delta = np.unwrap(delta)
        joints.append((_second(table, delta[0]), complex(points[0])))
        # what the coupling turns disk 3 by, and what is left for its own drive: from row to row
        moved = np.diff(delta, prepend=delta[:1])
        coupled = table.ratio * moved
        own = np.diff(beta, prepend=beta[:1]) - coupled
        columns = (*_columns(keys, table, points, delta, beta), np.degrees(coupled), np.degrees(own))
        rows += [(elbow, *row) for row in zip(*columns, strict=True)]
    page.picture = scheme(table.arms, table.ratio, tuple(joints))
    heads = ((N_("elbow"), ""), *_heads(), ("γ", "deg"), ("Δβ'", "deg"))
    page.table("points", N_("Points, both elbows"), heads, rows)
    if table.reach[0] == 0 and not points.all():
        page.note("at the centre every angle delta is right; it is kept at start_deg")
    _notes(page, keys)


def _columns(keys: TwoDiskKeys, table: TwoDisk, points: Complex, delta: Real, beta: Real) -> tuple[Real, ...]:
    one, two = table.drives(delta, beta)
    ring = delta - beta / table.ratio
    turn = table.platform_turn(beta, keys.orientation_teeth) if keys.orientation == "thesis" else 0 * beta
    angles = (np.degrees(a) for a in (delta, beta, ring))
    return points.real, points.imag, *angles, one, two, np.degrees(turn)


def _heads() -> tuple[tuple[str, str], ...]:
    angles = (("δ", "deg"), ("β", "deg"), ("θ", "deg"))
    return (("x", "mm"), ("y", "mm"), *angles, ("n_I", ""), ("n_II", ""), ("φ_6", "deg"))


def _steps(page: Sheet, keys: PowerTableKeys, point: complex) -> None:
    table = keys.table
    page.section("Point")
    page.told(point_x=point.real, point_y=point.imag)
    far = abs(point)
    page.add("point_distance", far, "sqrt({x}**2 + {y}**2)")
    chi = math.degrees(math.atan2(point.real, point.imag))
    half = "2 * arctan({x} / ({r} + {y}))" if far + point.imag > 1e-6 * far else ""
    page.add("point_direction_deg", chi, half)
    for elbow, title in ((1, N_("First elbow, beta > 0")), (-1, N_("Second elbow, beta < 0"))):
        delta, beta = (float(a) for a in table.inverse(point, elbow, math.radians(keys.start_deg or 0.0)))
        page.section(title)
        sign, formula = "" if elbow > 0 else "-", "arccos(({L1}**2 + {L2}**2 - {r}**2) / (2 * {L1} * {L2}))"
        # where the argument is near 1 the formula has lost its digits
        plain = 0.05 < abs(beta) < math.pi - 0.05
        page.add("beta_deg", math.degrees(beta), sign + formula if plain else "", _THESIS)
        lean = elbow * (math.radians(chi) - delta)
        formula = "arccos(({L1}**2 + {r}**2 - {L2}**2) / (2 * {L1} * {r}))"
        page.add("angle_at_o1_deg", math.degrees(lean), formula if plain and 0.05 < lean < math.pi - 0.05 else "")
        page.add("delta_deg", math.degrees(delta), f"{{chi}} {'-' if elbow > 0 else '+'} {{mu}}", _THESIS)
        printed = printed_for_delta(point, table.arms, delta) if elbow > 0 else None
        if printed is not None:
            page.mark_misprint(printed)
        one, two = (float(n) for n in table.drives(delta, beta))
        page.add("worm_turns", one, "{u_I} * {delta} / (2 * pi)", symbol="n_I", of=DRIVES["I"])
        page.add("ring_angle_deg", math.degrees(delta - beta / table.ratio), "{delta} - {beta} / {u}")
        page.add("worm_turns", two, "{u_II} * {theta} / (2 * pi)", symbol="n_II", of=DRIVES["II"])
        if keys.orientation == "thesis":
            turn = float(table.platform_turn(beta, keys.orientation_teeth))
            page.add("platform_turn_deg", math.degrees(turn), "(1 + {z_8} / {z_6}) * {beta}")


def _path(page: Sheet, keys: PowerTableKeys) -> None:
    table, pieces = keys.table, [_piece(*piece) for piece in keys.path or []]
    if not pieces:
        raise ParameterError("path", None, "no_path")
    start = None if keys.start_deg is None else math.radians(keys.start_deg)
    try:
        rows = followed(table, pieces, keys.tolerance, keys.elbow or 1, start)
    except ParameterError as refusal:
        # x and y are no keys beside a path
        raise (refusal.told_of("path", refusal.value, None) if refusal.name == _PLACES else refusal) from refusal
    given(page, keys)
    page.section("Path")
    page.told(path_length=float(rows.way[-1]), path_error=rows.error)
    found = zip(rows.way, *_columns(keys, table, rows.place, rows.delta, rows.beta), strict=True)
    joints = tuple((_second(table, rows.delta[k]), complex(rows.place[k])) for k in (0, -1))
    path = [piece.point(np.linspace(*piece.domain, 2 if isinstance(piece, Line) else 65)) for piece in pieces]
    page.picture = replace(scheme(table.arms, table.ratio, joints), path=np.concatenate(path))
    heads = (("s", "mm"), *_heads())
    page.table("path", N_("Path, row by row: both worms run evenly in between"), heads, found)
    _notes(page, keys)


def _second(table: TwoDisk, delta: float) -> complex:
    """O2."""
    return table.arms[0] * cmath.rect(1.0, math.pi / 2 - delta)


def _piece(x1: float, y1: float, x2: float, y2: float, bulge: float) -> Piece:
    start, end = complex(x1, y1), complex(x2, y2)
    if start == end:
        raise ParameterError("path", [x1, y1, x2, y2, bulge], "piece_is_a_point")
    if bulge == 0:
        return Line(start, end)
    centre = (start + end) / 2 + 1j * (end - start) * (1 - bulge**2) / (4 * bulge)
    return Arc(centre, abs(start - centre), cmath.phase(start - centre), 4 * math.atan(bulge))


def _notes(page: Sheet, keys: TwoDiskKeys) -> None:
    """From where is counted, and what the platform does."""
    told: list[Text] = [N_("angles and turns count from +y towards +x; beta and turns of the platform the other way")]
    if keys.orientation == "thesis":
        text = N_(
            "the thesis's wheels 6, 7, 8 do not keep the platform parallel: from beta = 0 to 180° it turns by {turn:g}°"
        )
        turn = math.degrees(float(keys.table.platform_turn(math.pi, keys.orientation_teeth)))
        told.append(message(text, turn=turn))
    page.notes += told
