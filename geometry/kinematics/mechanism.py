"""Links, the joints between them and their gear equations, exact in fractions; no part, no scene.

A link stands on another one by one joint: ``Fixed``, ``Revolute`` or ``Prismatic``, or it belongs to a ``Group`` whose
poses follow from those of other links (a cam's follower by its law, a dyad of levers). ``Rolling`` joins two links
whose axes stand on one carrier. Places and directions are those at the start, in the fixed frame.

A James reducer, its ring held (001, example 7 with the satellite that fits), and a differential::

    james = Mechanism(
        (Revolute("1"), Revolute("H"), Revolute("2", on="H"), Revolute("3"),
         Rolling("external", "1", "2", (40, 40), on="H"), Rolling("internal", "2", "3", (40, 120), on="H")),
        held=("3",),
    )
    turns(james, ("1",)).of("H")                 # {"1": Fraction(1, 4)}
    turns(james, ("1",)).of("2")                 # {"1": Fraction(-1, 2)}
    mobility(james)                              # n 3, p5 3, p4 2; Chebyshev 1, exact 1, redundant ()
    turns(replace(james, held=()), ("1", "H"))   # two drives: .of("3") == {"1": -1/3, "H": 4/3}
    equations(james)                             # rows for statics: torques are what works against them

One quantity a link: its turns (counter-clockwise about its own axis; absolute where the axis is parallel to its
carrier's, pointing either way, else against the carrier), or the travel of a slide in units of pi mm, which a rack of
rational module keeps rational. ``geometry/kinematics/moving.py`` moves such a mechanism.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Literal

from geometry.base.errors import ParameterError
from geometry.base.record import Record, field
from geometry.base.tolerance import PLACED_MM
from geometry.kinematics.elimination import Row, eliminated, follows_from

if TYPE_CHECKING:
    from geometry.base.placement import Placement3, Vector
    from geometry.base.series import Series
    from geometry.kinematics.motion import Pose

# no name of an instance
FRAME = "@"
Z = (0.0, 0.0, 1.0)
# sine of the angle between what is parallel
_PARALLEL = 1e-9
# parallel: two links that turn alike, as cranks of a parallelogram do, or what is hung on them and what it hangs on
Kind = Literal["external", "internal", "bevel", "worm", "crossed", "rack", "parallel"]
# turns of the second for those of the first where that is not 1: the guidelines count bevels and worms as positive
_SENSES: Mapping[str, int] = {"external": -1}


class Fixed(Record):
    """A link that is one body with another; ``sense`` -1: its own axis points against that one's, and so it turns."""

    link: str
    on: str = FRAME
    sense: int = 1


class Revolute(Record):
    """A link that turns about an axis through ``at`` (mm, at the height ``z``) which stands on another link."""

    link: str
    on: str = FRAME
    at: complex = 0j
    z: float = 0.0
    axis: Vector = Z


class Prismatic(Record):
    """A link that slides on another one along a unit ``direction``, with a ``rise`` along z where it is not level."""

    link: str
    on: str = FRAME
    direction: complex = 1 + 0j
    rise: float = 0.0


class Uneven(Record):
    """How far (rad) a wheel is ahead of the ratio of whole turns, by the turn (rad) of the ``driver``, its partner."""

    driver: str
    ahead: Callable[[Series], Series]


class Rolling(Record):
    """Two toothed links without slip; ``on``: the link that carries both axes.

    ``teeth``: those of the first (of a worm its starts) and of the second. ``sense``: +1 where both turn the same way,
    0: as the kind has it. A rack is the second, its ``module`` in mm; sense +1 where it moves along its direction as
    the wheel turns counter-clockwise. ``uneven``: of noncircular wheels, whose teeth give the ratio of whole turns.
    """

    kind: Kind
    first: str
    second: str
    teeth: tuple[int, int]
    on: str = FRAME
    sense: int = 0
    module: Fraction = Fraction(1)
    uneven: Uneven | None = None

    @property
    def ratio(self) -> Fraction:
        """What the second turns (or travels, in pi mm) for one turn of the first, both against the carrier."""
        sense = self.sense or _SENSES.get(self.kind, 1)
        return sense * (self.module * self.teeth[0] if self.kind == "rack" else Fraction(*self.teeth))


class Group(Record):
    """Links whose poses follow from those of the links ``on`` which they stand: of mobility 0 (Assur).

    ``poses`` gives the links' poses in the order of ``links`` from the others' in that of ``on``. ``pairs``: numbers of
    its lower and higher kinematic pairs, of a dyad 3 and 0, of a cam and its follower's guide 1 and 1.

    ``plane``: the frame in whose x, y plane these poses are, where that is not the fixed frame's: all links' frames
    then coincide with it at the start. ``counts``: whether how often the first of the others has turned makes a
    difference: its angle is told with all whole turns.
    """

    links: tuple[str, ...]
    on: tuple[str, ...]
    poses: Callable[[list[Pose]], list[Pose]]
    pairs: tuple[int, int]
    plane: Placement3 | None = None
    counts: bool = False

    @property
    def axis(self) -> Vector:
        """The normal of its plane."""
        return Z if self.plane is None else self.plane.z


Support = Fixed | Revolute | Prismatic
Joint = Support | Rolling | Group


class Mechanism(Record):
    """Joints, and the links that are ``held``; ``starts``: origin (mm) and angle (rad) of a link's frame at the start.

    A frame that is not given stands on its link's axis, its x axis along +x.
    """

    joints: tuple[Joint, ...]
    held: tuple[str, ...] = ()
    starts: Mapping[str, tuple[complex, float]] = field(default_factory=dict)


def lead(joint: Rolling) -> str:
    """The quantity by which an uneven wheel is ahead, as equations name it."""
    return f"{joint.first}{FRAME}{joint.second}"


class Equation(Record):
    """What ``source`` asks of the links' turns (travels): the sum of the terms is 0. A held link is its own source."""

    source: Rolling | str
    terms: Row[str]


class Redundant(Record):
    """A constraint that follows from others."""

    source: Rolling | str
    follows_from: tuple[Rolling | str, ...]


class Mobility(Record):
    """n moving links, p5 lower and p4 higher pairs as guidelines count: what is held is the frame, what is fixed
    together one link, equal satellites in parallel are one. ``degrees``: unknowns less the rank, exactly.
    """

    links: int
    lower_pairs: int
    higher_pairs: int
    degrees: int
    redundant: tuple[Redundant, ...]

    @property
    def chebyshev(self) -> int:
        """W = 3 n - 2 p5 - p4."""
        return 3 * self.links - 2 * self.lower_pairs - self.higher_pairs


class Turns(Record):
    """Turns (travels) of every link by those of the inputs: drives, and links of groups.

    ``free``: links that the inputs do not determine.
    """

    shares: Mapping[str, Row[str]]
    free: tuple[str, ...]

    def of(self, link: str) -> Row[str]:
        """By input; what is not named is 0.

        Raises
        ------
        ParameterError
            The inputs leave this link free.
        """
        if link in self.free:
            raise ParameterError("drives", link, "left_free", None, free=list(self.free))
        return self.shares[link]

    def ratio(self, first: str, second: str) -> Fraction:
        """u_12: turns of the first for one of the second, with one drive.

        Raises
        ------
        ParameterError
            The second stands still, or a link is free.
        """
        one, two = (sum(self.of(link).values(), Fraction()) for link in (first, second))
        if not two:
            raise ParameterError("drives", second, "stands_still")
        return one / two


class Tree(Record):
    """How links stand on each other, told in a list in which each comes after what it stands on."""

    mechanism: Mechanism
    supports: Mapping[str, Support | Group]
    order: tuple[str, ...]

    def body(self, link: str) -> str:
        """The link that tells how a link's rigid body moves."""
        while isinstance(joint := self.supports.get(link), Fixed):
            link = joint.on
        return link

    def turning(self, link: str) -> str:
        """The link that tells how a link turns: a slide turns with what it stands on."""
        while isinstance(joint := self.supports.get(link), Fixed | Prismatic):
            link = joint.on
        return link

    def sense(self, link: str) -> int:
        """-1 where a link's own axis points against that of its body."""
        found = 1
        while isinstance(joint := self.supports.get(link), Fixed):
            found, link = found * joint.sense, joint.on
        return found

    def base(self, link: str) -> str:
        """What a link's turns are counted against: the first below it on an axis of another direction, or the frame."""
        here = self.turning(link)
        while isinstance(joint := self.supports.get(here), Revolute):
            below = self.turning(joint.on)
            if below == FRAME or not parallel(self.axis(below), joint.axis):
                return below
            here = below
        return FRAME

    def axis(self, link: str) -> Vector:
        """Direction of the axis about which a link turns."""
        joint = self.supports.get(self.turning(link))
        return joint.axis if isinstance(joint, Revolute | Group) else Z

    def keeps(self, link: str, axis: Vector) -> bool:
        """Whether a link moves in planes across a direction alone."""
        while not self.still(link):
            joint = self.supports[link]
            if isinstance(joint, Group):
                return bool(parallel(joint.axis, axis)) and all(self.keeps(name, axis) for name in joint.on)
            if isinstance(joint, Revolute) and not parallel(joint.axis, axis):
                return False
            if isinstance(joint, Prismatic):
                way = (joint.direction.real, joint.direction.imag, joint.rise)
                if abs(math.fsum(a * b for a, b in zip(way, axis, strict=True))) > _PARALLEL:
                    return False
            link = joint.on
        return True

    def still(self, link: str) -> bool:
        """Whether a link is the frame, or fixed to a held one."""
        while link != FRAME and link not in self.mechanism.held:
            joint = self.supports[link]
            if not isinstance(joint, Fixed):
                return False
            link = joint.on
        return True

    def together(self, one: str, two: str) -> bool:
        """Whether two links are one body, or both stand still."""
        return self.body(one) == self.body(two) or (self.still(one) and self.still(two))

    def carries(self, carrier: str, link: str) -> bool:
        """Whether the axis of a link stands still as seen from another one: on it, or on its own axis."""
        joint, own = self.supports.get(self.body(link)), self.supports.get(self.body(carrier))
        if isinstance(joint, Group) or isinstance(own, Group):
            # where its pairs are is the group's own matter
            pairs = [(carrier, other) for other in _on(joint)] + [(link, other) for other in _on(own)]
            return any(self.together(one, two) for one, two in (*pairs, (carrier, link)))
        if self.together(carrier, FRAME if joint is None else joint.on):
            return True
        if own is None or not self.together(own.on, FRAME if joint is None else joint.on):
            return False
        if isinstance(own, Revolute) and isinstance(joint, Revolute):
            return one_line(own, joint)
        # what is fixed to the frame has no axis of its own
        return joint is None or (
            isinstance(own, Prismatic)
            and isinstance(joint, Prismatic)
            and (own.direction, own.rise) == (joint.direction, joint.rise)
        )

    def common_carrier(self, first: str, second: str) -> str | None:
        """The link on which both axes stand: the frame before others; None where there is none."""
        candidates = [FRAME]
        for link in (first, second):
            joint = self.supports.get(self.body(link))
            candidates += [joint.on] if isinstance(joint, Revolute | Prismatic) else []
        return next((c for c in candidates if self.carries(c, first) and self.carries(c, second)), None)

    def turn(self, link: str, carrier: str) -> Row[str]:
        """Turns of a link against its carrier, by the links' own quantities."""
        one, two = self.turning(link), self.turning(carrier)
        if one == two:
            return {}
        sense = self.sense(link)
        terms: Row[str] = {} if one == FRAME else {one: Fraction(sense)}
        if two not in (FRAME, self.base(one)):
            terms[two] = Fraction(-sense * parallel(self.axis(one), self.axis(two)))
        return terms

    def travel(self, link: str, carrier: str) -> Row[str]:
        """Travel of a slide against its carrier, which may slide itself."""
        one, two = self.body(link), self.body(carrier)
        terms: Row[str] = {}
        if isinstance(joint := self.supports.get(one), Prismatic):
            terms[one] = Fraction(1)
            if self.body(joint.on) == two:
                return terms
        if isinstance(self.supports.get(two), Prismatic):
            terms[two] = Fraction(-1)
        return terms

    def quantities(self) -> list[str]:
        """The links that have a turn or a travel of their own."""
        return [name for name in self.order if isinstance(self.supports[name], Revolute | Prismatic)]

    def given(self) -> list[str]:
        """The links of groups."""
        return [name for name in self.order if isinstance(self.supports[name], Group)]


def parallel(one: Vector, two: Vector) -> int:
    """1 where two unit vectors point the same way, -1 where they point against each other, else 0."""
    (a, b, c), (x, y, z) = one, two
    across = math.hypot(b * z - c * y, c * x - a * z, a * y - b * x)
    return 0 if across > _PARALLEL else 1 if a * x + b * y + c * z > 0 else -1


def one_line(one: Revolute, two: Revolute) -> bool:
    """Whether two links turn about one line."""
    way = two.at.real - one.at.real, two.at.imag - one.at.imag, two.z - one.z
    along = math.fsum(a * b for a, b in zip(way, one.axis, strict=True))
    return bool(parallel(one.axis, two.axis)) and math.dist(way, [along * a for a in one.axis]) <= PLACED_MM


def tree(mechanism: Mechanism) -> Tree:
    """What stands on what.

    Raises
    ------
    ParameterError
        A link stands on two others, on nothing, or on itself; named ``joints[k].KEY``, k from 1.
    """
    supports: dict[str, Support | Group] = {}
    for number, joint in enumerate(mechanism.joints, 1):
        if isinstance(joint, Rolling):
            continue
        for link in joint.links if isinstance(joint, Group) else [joint.link]:
            if link in supports or link == FRAME:
                raise ParameterError(f"joints[{number}].link", link, "stands_on_two", None, on=_on(supports.get(link)))
            supports[link] = joint
    order: list[str] = []
    for name in supports:
        _append(name, supports, order, mechanism)
    for link in mechanism.held:
        if link not in supports:
            raise ParameterError("held", link, "no_such_link", None, known=order)
    return Tree(mechanism, supports, tuple(order))


def _on(joint: Support | Group | None) -> list[str]:
    return [FRAME] if joint is None else list(joint.on) if isinstance(joint, Group) else [joint.on]


def _append(name: str, supports: Mapping[str, Support | Group], order: list[str], mechanism: Mechanism) -> None:
    """Put a link into the order after all on which it stands, without recursion: chains are long."""
    done, path = set(order), [name]
    while path:
        here = path[-1]
        waiting = [link for link in _on(supports[here]) if link != FRAME and link not in done]
        if not waiting:
            path.pop()
            if here not in done:
                done.add(here)
                order.append(here)
            continue
        below = waiting[0]
        number = mechanism.joints.index(supports[here]) + 1
        if below not in supports:
            raise ParameterError(f"joints[{number}].on", below, "stands_on_nothing")
        if below in path:
            raise ParameterError(f"joints[{number}].on", below, "stands_on_itself")
        path.append(below)


def equations(mechanism: Mechanism) -> tuple[Equation, ...]:
    """The gear equations, those of held links after them.

    Raises
    ------
    ParameterError
        A joint or a held link does not fit the others; named ``joints[k].KEY``, k from 1, or ``held``.
    """
    return _equations(tree(mechanism))


def _equations(stands: Tree) -> tuple[Equation, ...]:
    found = []
    for number, joint in enumerate(stands.mechanism.joints, 1):
        if isinstance(joint, Rolling):
            _check_rolling(joint, stands, f"joints[{number}]")
            one = stands.turn(joint.first, joint.on)
            two = (stands.travel if joint.kind == "rack" else stands.turn)(joint.second, joint.on)
            terms = {link: joint.ratio.numerator * value for link, value in one.items()}
            for link, value in two.items():
                terms[link] = terms.get(link, Fraction()) - joint.ratio.denominator * value
            terms = {link: value for link, value in terms.items() if value}
            if joint.uneven is not None:
                forward = joint.uneven.driver == joint.first
                terms[lead(joint)] = Fraction(joint.ratio.denominator if forward else -joint.ratio.numerator)
            found.append(Equation(joint, terms))
    for link in stands.mechanism.held:
        own = stands.body(link)
        found.append(Equation(link, {} if own == FRAME else {own: Fraction(1)}))
    return tuple(found)


def _check_rolling(joint: Rolling, stands: Tree, place: str) -> None:
    for key, link in (("first", joint.first), ("second", joint.second), ("on", joint.on)):
        if link not in stands.supports and link != FRAME:
            raise ParameterError(f"{place}.{key}", link, "no_such_link", None, known=list(stands.order))
    if stands.body(joint.first) == stands.body(joint.second):
        raise ParameterError(f"{place}.second", joint.second, "rolls_on_itself")
    if min(joint.teeth) < 1 or joint.module <= 0:
        raise ParameterError(f"{place}.teeth", list(joint.teeth), "not_of_teeth")
    for key, link in (("first", joint.first), ("second", joint.second)):
        if not stands.carries(joint.on, link):
            raise ParameterError(f"{place}.{key}", link, "axis_not_on_carrier", None, carrier=joint.on)
    bodies = [stands.body(link) for link in (joint.first, joint.second)]
    own = [_on(stands.supports.get(body)) for body in bodies]
    if not stands.still(joint.on) and not any(
        stands.body(joint.on) in {stands.body(name) for name in names} for names in own
    ):
        raise ParameterError(f"{place}.on", joint.on, "carries_nothing")


def turns(mechanism: Mechanism, drives: Iterable[str] = ()) -> Turns:
    """How often each link turns (how far it travels) for one turn (pi mm) of each drive and of each group's link.

    Raises
    ------
    ParameterError
        A joint does not fit; drives or held links contradict each other: named ``drives``, ``by`` what holds it.
    """
    stands = tree(mechanism)
    rows = list(_equations(stands))
    given = stands.given()
    for drive in dict.fromkeys(drives):
        body = stands.body(drive)
        if drive not in stands.supports:
            raise ParameterError("drives", drive, "no_such_link", None, known=list(stands.order))
        if body in given:
            raise ParameterError("drives", drive, "moves_by_law")
        own = {} if body == FRAME else {body: Fraction(stands.sense(drive))}
        rows.append(Equation(drive, {**own, _known(drive): Fraction(-1)}))
    leads = {lead(joint) for joint in mechanism.joints if isinstance(joint, Rolling) and joint.uneven}
    known = {_known(drive) for drive in drives}.union(given, leads)
    table = [row.terms for row in rows]
    found = eliminated(table, known)
    for index, rest in found.left.items():
        if not leads.issuperset(rest):
            # other drives and held links; else the meshes
            sources = [rows[k].source for k in follows_from(table, index, known)]
            causes = [s for s in sources if isinstance(s, str)] or [_name(s) for s in sources]
            raise ParameterError("drives", _name(rows[index].source), "contradicts", None, by=causes)
    values: dict[str, Row[str]] = {name: {name: Fraction(1)} for name in given} | dict(found.solved)
    shares: dict[str, Row[str]] = {FRAME: {}}
    free = []
    for name in stands.order:
        own = values.get(stands.body(name), {} if stands.body(name) == FRAME else {name: Fraction(1)})
        if known.issuperset(own):
            sense = stands.sense(name)
            shares[name] = {key.removeprefix(FRAME): sense * value for key, value in own.items()}
        else:
            free.append(name)
    return Turns(shares, tuple(free))


def _known(drive: str) -> str:
    """The turns that a drive gives, apart from those of its link."""
    return FRAME + drive


def _name(source: Rolling | str) -> str:
    return source if isinstance(source, str) else f"{source.first}-{source.second}"


# ratios that stand for the law of a group, which no teeth give
_GENERIC = (Fraction(7919, 7907), Fraction(7901, 7883))


def mobility(mechanism: Mechanism) -> Mobility:
    """How many drives it wants, by Chebyshev's formula and by the exact rank of its equations.

    Raises
    ------
    ParameterError
        A joint does not fit; named ``joints[k].KEY``, k from 1.
    """
    stands = tree(mechanism)
    rows = _equations(stands)
    given = stands.given()
    table = [row.terms for row in rows]
    for name in given:
        on = [stands.turning(link) for link in _on(stands.supports[name])]
        law = {link: -share for link, share in zip(on, _GENERIC, strict=False) if link != FRAME}
        table.append({**law, name: Fraction(1)})
    leads = {lead(joint) for joint in mechanism.joints if isinstance(joint, Rolling) and joint.uneven}
    found = eliminated(table, leads)
    redundant = [
        Redundant(rows[k].source, tuple(rows[j].source for j in follows_from(table, k, leads)))
        for k in found.left
        if k < len(rows)
    ]
    own = stands.quantities()
    twins = _twins(stands)
    counted = len([name for name in own if not stands.still(name) and name not in twins])
    meshes = 0
    for row in rows:
        if isinstance(row.source, Rolling):
            ends = [row.source.first, row.source.second]
            meshes += not twins.intersection(map(stands.body, ends)) and not all(map(stands.still, ends))
    groups = dict.fromkeys(joint for joint in stands.supports.values() if isinstance(joint, Group))
    return Mobility(
        counted + len(given),
        counted + sum(group.pairs[0] for group in groups),
        meshes + sum(group.pairs[1] for group in groups),
        len(own) + len(given) - found.rank,
        tuple(redundant),
    )


def _twins(stands: Tree) -> set[str]:
    """Satellites (links that another link than the frame carries) beside equal ones: sets of them that mesh alike."""
    carrier: dict[str, str] = {}
    for name in stands.quantities():
        support = stands.supports[name]
        if isinstance(support, Revolute) and stands.body(support.on) != FRAME:
            carrier[name] = stands.body(support.on)
    sides: dict[str, list[tuple[str, str]]] = {name: [] for name in carrier}
    for joint in stands.mechanism.joints:
        if isinstance(joint, Rolling):
            ends = stands.body(joint.first), stands.body(joint.second)
            for place, (own, other) in enumerate((ends, ends[::-1])):
                if own in sides:
                    sides[own].append((other, f"{joint.kind} {joint.teeth} {joint.ratio} {place}"))
    # what a satellite is told by: its carrier and meshes, then those of its neighbours, and so on
    told: dict[str, str] = dict.fromkeys(carrier, "")
    for _ in carrier:
        seen = {
            name: (on, tuple(sorted((told.get(other, other), how) for other, how in sides[name])))
            for name, on in carrier.items()
        }
        numbers = {what: f"{FRAME}{k}" for k, what in enumerate(dict.fromkeys(seen.values()))}
        settled = len(numbers) == len(set(told.values()))
        told = {name: numbers[what] for name, what in seen.items()}
        if settled:
            break
    twins: set[str] = set()
    left, known = dict.fromkeys(carrier), set()
    while left:
        members = [next(iter(left))]
        for name in members:
            del left[name]
            members += dict.fromkeys(other for other, _ in sides[name] if other in left and other not in members)
        what = tuple(sorted(told[name] for name in members))
        if what in known:
            twins.update(members)
        known.add(what)
    return twins
