"""The load on the platform of the power module: what both worms hold, and the most that it asks of all that carries it.

What is sought the most of is that over the whole workspace and over every direction of the force that is free.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Annotated, Literal

from msgspec import Meta

from geometry.base import hertz
from geometry.base.errors import ParameterError
from geometry.base.record import Record, replace
from geometry.gears.worms import strength
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.worm import Worm
from geometry.kinematics.statics import statics
from geometry.kinematics.two_disk import TwoDisk
from geometry.kinematics.two_disk_load import (
    Amount,
    Bearing,
    Force,
    Heights,
    LoadedTable,
    WormForces,
    Worst,
    along_axis,
    at_edge,
    ball_load,
    crank_force,
    lift,
    mesh_force,
    radial,
    tilting,
    worm_torque,
    worst,
)
from parts.base.texts import N_, message
from parts.keys.base import mm, size
from parts.mates.pages.power_table import DRIVES, TwoDiskKeys, check_reach
from parts.pages.page import Sheet, Table, table_of

_WORM = "thesis, 2.2"
# steel: Young's modulus, MPa, and Poisson's ratio
STEEL = 206_000.0, 0.3
MODULUS = STEEL[0] / (2 * (1 - STEEL[1] ** 2))
_Length = Annotated[float, mm("length", above=0, most=10_000)]
_Force = Annotated[float, size("N", "force", least=-1e9, most=1e9)]
_Place = Annotated[float, mm("coordinate of the platform's axis O3", least=-10_000, most=10_000)]
_NAMES: Mapping[Bearing, str] = {
    "disk_3": N_("disk 3 in disk 2"),
    "ring": N_("ring on disk 2"),
    "disk_2": N_("disk 2 in the body"),
}
_ACROSS, _LIFT = (N_("force across the axis, N"), N_("force and moment that lift a ball most, times all balls, N"))

_GROOVE_RADIUS = mm("radius of the grooves; default: r_groove of the assembly", above=0, most=1000, example=4.16)
_BALL_PRESSURE_LIMIT = size("MPa", "greatest pressure on a ball at rest, ISO 76", above=0, most=100_000)


class LoadKeys(TwoDiskKeys, kw_only=True):
    """Keys of the load, and of what holds it."""

    worm_torque: Annotated[float, size("N*m", "torque on either worm", above=0, most=1e6)] = 3.5
    worm_module: Annotated[_Length, Meta(description="module of both worms")] = 5.0
    diameter_quotient: Annotated[float, Meta(gt=0, le=1000, description="q of both worms")] = 10.0
    friction_coefficient: Annotated[
        float, Meta(ge=0, le=1, description="friction of the worms' flanks; without it no losses, as in the thesis")
    ] = 0.0
    load: Annotated[float, size("N", "force on the platform's axis; default: what both worms hold anywhere",
                                above=0, most=1e9, example=2000.0)] | None = None  # fmt: skip
    force_x: Annotated[_Force, Meta(description="force on the platform along x, in place of load")] | None = None
    force_y: Annotated[_Force, Meta(description="force on the platform along y, in place of load")] | None = None
    force_z: Annotated[_Force, Meta(description="force on the platform along its axis, up")] = 0.0
    moment: Annotated[float, size("N*m", "moment on the platform about its axis", least=-1e9, most=1e9)] = 0.0
    load_height: Annotated[float, mm("where the force acts, over the platform's face", least=-1e4, most=1e4)] = 0.0
    x: _Place | None = None
    y: _Place | None = None
    elbow: Annotated[Literal[1, -1], Meta(description="sign of beta at the place x, y; default: 1")] | None = None
    groove_radius: Annotated[float, _GROOVE_RADIUS] | None = None
    ball_diameter: Annotated[_Length, Meta(description="diameter of a ball")] = 8.0
    ball_pressure_limit: Annotated[float, _BALL_PRESSURE_LIMIT] = 4200.0

    @property
    def given(self) -> tuple[float, float] | None:
        """Size (N) and direction (rad) of the force that is given by its components; none: of every direction."""
        if self.force_x is None and self.force_y is None:
            return None
        if self.load is not None:
            raise ParameterError("load", self.load, "either_of", None, other="force_x, force_y")
        across = complex(self.force_x or 0.0, self.force_y or 0.0)
        return abs(across), math.atan2(across.imag, across.real)

    @property
    def held(self) -> bool:
        """Whether sheets have the full torque of both worms, since no force is told."""
        return self.load is None and (self.given is None or not self.given[0])

    @property
    def place(self) -> tuple[float, float] | None:
        """delta and beta (rad) where the platform is told to stand."""
        if (self.x is None) != (self.y is None):
            raise ParameterError(
                "x" if self.x is None else "y", None, "missing_key", None, what=message("x and y of a point")
            )
        if self.x is None or self.y is None:
            if self.elbow is not None:
                raise ParameterError("elbow", self.elbow, "needs_other", None, other="x, y")
            return None
        check_reach(self.table, at := complex(self.x, self.y))
        delta, beta = self.table.inverse(at, self.elbow or 1)
        return float(delta), float(beta)

    @property
    def drives(self) -> tuple[WormDrive, WormDrive]:
        """Both worms, of one start, with their wheels."""
        worm = Worm(self.worm_module, 1, self.diameter_quotient)
        one, two = (WormDrive(worm, teeth) for teeth in self.worm_ratios)
        return one, two

    @property
    def friction_angle(self) -> float:
        """rho', rad."""
        return math.atan(self.friction_coefficient / math.cos(self.drives[0].worm.pressure_angle))

    @property
    def efficiency(self) -> float:
        """Of both worm drives, the worms driving."""
        return strength.efficiency(self.drives[0], self.friction_angle)


class Carried(Record):
    """What sheets go on with: torques on both worm wheels, N m, of the ring's row of balls its force across the axis
    and what lifts one of its balls, N.
    """

    torques: tuple[float, float]
    ring_radial: float
    ring_lift: float


def load_sections(page: Sheet, keys: LoadKeys, found: Mapping[str, float]) -> Carried:
    """The load, what it asks of both drives by virtual work and by statics of the train, and tables of the most of all.

    ``found``: the module's sizes.
    """
    across, torques = _load(page, keys)
    given, at = keys.given, keys.place
    force = Force(across, keys.force_z, 1000 * keys.moment, None if given is None else given[1])
    loaded = _loaded(keys, found)
    rows = list(_amounts(loaded, keys, found))
    most = _found(loaded, force, rows)
    title = N_("Most of the load over all places, and over all directions of a force that has none given")
    page.tables.append(_table("load_worst", title, keys.table, rows, most))
    if at is not None:
        here = _found(loaded, force, rows, at)
        title = N_("The load at the place x, y, and over all directions of a force that has none given")
        page.tables.append(_table("load_here", title, keys.table, rows, here))
    share = max((found.bound / found.value - 1 for found in most if found.value), default=0.0)
    page.note(
        "load: no other place or direction asks for more than {share:.2g} % beyond these; of several that "
        "ask for as much one is named; directions count from +x, counter-clockwise",
        share=100 * share,
    )
    pressure = max(row.share * found.value**row.power for row, found in zip(rows, most, strict=True) if row.power != 1)
    if pressure > keys.ball_pressure_limit:
        limit = keys.ball_pressure_limit
        page.note("the balls are pressed by {most:.4g} MPa, more than {limit:g}", most=pressure, limit=limit)
    by_name = {(row.who, row.what): found.value for row, found in zip(rows, most, strict=True)}
    return Carried(torques, by_name[_NAMES["ring"], _ACROSS], by_name[_NAMES["ring"], _LIFT])


def _load(page: Sheet, keys: LoadKeys) -> tuple[float, tuple[float, float]]:
    """The force across the axis, N, and the torques on both worm wheels, N m, where they are greatest."""
    table, given = keys.table, keys.given
    worth = keys.efficiency
    held = keys.worm_torque * keys.worm_ratios[0] * worth, keys.worm_torque * keys.worm_ratios[1] * worth
    # the Jacobian of drive I is longest at beta = 0, that of drive II is as long everywhere
    first, second = table.arms[0] + (table.ratio - 1) * table.arms[1], table.ratio * table.arms[1]
    page.section("Load on the platform")
    page.told(worm_torque=keys.worm_torque, diameter_quotient=keys.diameter_quotient)
    page.add("self_locking_friction", math.cos(keys.drives[0].worm.pressure_angle) / keys.diameter_quotient,
             "cos(20 * pi / 180) / {q}")  # fmt: skip
    losses = ""
    if keys.friction_coefficient:
        page.told(friction_coefficient=keys.friction_coefficient, worm_efficiency=worth)
        losses = " * {eta}"
    for name, torque in zip(DRIVES, held, strict=True):
        formula = f"{{T1}} * {{u_{name}}}{losses}"
        page.add("wheel_torque", torque, formula, _WORM, symbol=f"T_2{name}", of=DRIVES[name])
    page.add("load_arm", first, "{L1} + ({u} - 1) * {L2}", symbol="l_I", of=DRIVES["I"])
    page.add("load_arm", second, "{u} * {L2}", symbol="l_II", of=DRIVES["II"])
    most = [1000 * torque / arm for torque, arm in zip(held, (first, second), strict=True)]
    worse = "I" if most[0] < most[1] else "II"
    page.add("load_held", min(most), f"1000 * {{T_2{worse}}} / {{l_{worse}}}", of=DRIVES[worse])
    load = min(most) if keys.load is None else keys.load
    if given is not None:
        load = given[0]
    page.told(load=load, axial_load=keys.force_z, load_moment=keys.moment)
    # wheels turn the platform by 1 + r8 / r6 of disk 3's turn against disk 2
    turned = keys.table.platform_turn(table.ratio, keys.orientation_teeth) if keys.orientation == "thesis" else 0.0
    more = abs(keys.moment) * float(turned)
    asked = load * first / 1000 + more, load * second / 1000 + more
    for name, torque in zip(DRIVES, asked, strict=True):
        formula = "" if more else f"{{F}} * {{l_{name}}} / 1000"
        page.add("load_torque", torque, formula, symbol=f"T_F{name}", of=DRIVES[name])
    page.note(
        "the worst place for drive I is where beta is 0, for drive II all are alike; the worst direction is that in "
        "which the drive moves the platform: for II across O2O3"
    )
    if load or more:
        _statics(page, keys, load, more / table.ratio)
    page.note("friction of the worms' flanks from f_s on locks them; the thesis has neither friction nor losses")
    if max(a - h for a, h in zip(asked, held, strict=True)) > 1e-12 * max(held):
        page.note("the worms do not hold this load everywhere: at most {limit:.6g} N", limit=min(most))
    return load, held if keys.held else asked


def _statics(page: Sheet, keys: LoadKeys, load: float, turning: float) -> None:
    """At the worst place, beta = 0, in the worst direction: what the layer's statics of trains gives for the worms.

    ``turning``: what a moment on the platform asks of disk 3 against disk 2, N m, in the worse sense.
    """
    table = keys.table
    one, _ = (complex(way) for way in table.drive_jacobian(0.0, 0.0))
    force = load * one / abs(one)
    first, second = 1j * table.arms[0], complex(table.forward(0.0, 0.0)) - 1j * table.arms[0]
    # turning disk 2 moves O2, turning disk 3 moves O3 about it
    on_2, on_3 = ((force.conjugate() * 1j * arm).real / 1000 for arm in (first, second))
    turning = math.copysign(turning, on_3)
    loads = {"disk_2": Fraction(on_2 - turning), "disk_3": Fraction(on_3 + turning)}
    state = statics(table.mechanism("idlers"), {"worm_1": Fraction(1), "worm_2": Fraction(1)}, loads)[0]
    for name, worm in (("I", "worm_1"), ("II", "worm_2")):
        asked = abs(float(state.torques[worm])) / keys.efficiency
        page.add("worm_torque_asked", asked, symbol=f"T_1{name}", of=DRIVES[name])
    mesh = next(flow for flow in state.flows if flow.mesh.kind == "internal")
    page.add("pinion_torque", abs(float(mesh.torques[0])), symbol="T_11")


def _loaded(keys: LoadKeys, found: Mapping[str, float]) -> LoadedTable:
    """The table with the heights of its module."""
    one, two = (
        WormForces(
            drive.reference_radius, found[f"z_{k}"], math.tan(drive.worm.axial_pressure_angle),
            math.tan(drive.pitch_lead_angle + keys.friction_angle),
        )
        for k, drive in enumerate(keys.drives, 1)
    )  # fmt: skip
    width = found["wheel_width"] / 2
    heights = Heights(
        load=found["z_4"] + found["h_4"] + keys.load_height,
        bore=(-found["h_24"], found["disk_thickness"] - 0.5),
        disk_3=(found["z_upper"] + found["z_lower"]) / 2,
        mesh=found["face_width"] / 2 - found["h_24"],
        ring=found["z_20"],
        disk_2=found["z_ball"],
        wheels=(found["z_16"] + width, found["z_11"] + width),
    )
    pivots = found.get("r_pivots", 1.0), (0.0, math.pi / 3)
    return LoadedTable(keys.table, (one, two), heights, keys.orientation, keys.orientation_teeth, pivots)


class _Row(Record):
    """An amount, who carries it, what it is, and how it is told: ``share`` times its ``power``."""

    who: str
    what: str
    amount: Amount
    share: float = 1.0
    power: float = 1.0


def _amounts(loaded: LoadedTable, keys: LoadKeys, found: Mapping[str, float]) -> Iterator[_Row]:
    """Torques of the worms, forces of mesh, axle and cranks, and what each bearing carries, with its fullest ball."""
    for k, (name, ratio) in enumerate(zip(DRIVES.values(), keys.worm_ratios, strict=True)):
        yield _Row(name, N_("torque on the worm, N·m"), worm_torque(k), 1e-3 / ratio / keys.efficiency)
    yield _Row(N_("pair 11-12"), N_("force along the line of action, N"), mesh_force())
    for upper, what in enumerate(
        (N_("force on the lower end of its bore, N"), N_("force on the upper end of its bore, N"))
    ):
        yield _Row(N_("platform axle"), what, at_edge(loaded.heights.bore, upper))
    if keys.moment and keys.orientation == "cranks":
        for stage, who in enumerate((N_("crank on the body"), N_("crank on the platform"))):
            yield _Row(who, N_("force along it, N"), crank_force(stage))
    ball, groove, large = 2 / keys.ball_diameter, 1 / found["r_groove"], found["r_large"]
    grooves = ball - groove, ball + 1 / (large - 1 / ball)
    # disk 3's balls run on the plain bore of disk 2, the others in grooves
    rows = {
        "disk_3": (2 * found["small_balls"], found["r_small"], (ball, ball)),
        "ring": (found["large_balls"], large, grooves),
        "disk_2": (found["large_balls"], large, grooves),
    }
    for bearing, who in _NAMES.items():
        balls, radius, curvatures = rows[bearing]
        one = ball_load(bearing, max(int(balls), 1), radius)
        yield _Row(who, _ACROSS, radial(bearing))
        yield _Row(who, N_("force along the axis, N"), along_axis(bearing))
        yield _Row(who, N_("tilting moment, N·m"), tilting(bearing), 1e-3)
        yield _Row(who, N_("load of one ball, N"), one)
        # of Hertz: as the cube root of the load
        yield _Row(who, N_("pressure on a ball, MPa"), one, hertz.pressure(1.0, curvatures, MODULUS), 1 / 3)
        if bearing == "ring":
            yield _Row(who, _LIFT, lift(bearing, radius))


def _found(loaded: LoadedTable, force: Force, rows: list[_Row], at: tuple[float, float] | None = None) -> list[Worst]:
    """Row by row; what stands in two rows is sought once."""
    known: dict[Amount, Worst] = {}
    return [known.get(r.amount) or known.setdefault(r.amount, worst(loaded, force, r.amount, at)) for r in rows]


def _table(name: str, title: str, table: TwoDisk, rows: list[_Row], most: list[Worst]) -> Table:
    heads = (
        (N_("carried by"), ""), (N_("quantity"), ""), (N_("at most"), ""), ("x", "mm"), ("y", "mm"), ("δ", "deg"),
        ("β", "deg"), ("φ_F", "deg"), (N_("nowhere more than"), ""),
    )  # fmt: skip
    told = []
    for row, found in zip(rows, most, strict=True):
        at = complex(table.forward(found.place.delta, found.place.beta))
        angles = map(math.degrees, (found.place.delta, found.place.beta, found.place.direction))
        value, bound = (row.share * value**row.power for value in (found.value, found.bound))
        told.append((row.who, row.what, value, at.real, at.imag, *angles, bound))
    return replace(table_of(name, title, heads, told), shown=8)
