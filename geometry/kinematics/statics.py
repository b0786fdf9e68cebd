"""Statics of gear trains, exact in fractions: torques, power through every mesh, efficiency, self-locking.

In every mesh the power that goes in, as its carrier sees it, comes out times the mesh's efficiency. Which wheel drives
there follows from the torques, and these from which wheels drive: an assignment of the losses is valid where both
agree. None is: the train is self-locking under that load. Several may be: each is a state in which it can run.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import product

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.kinematics.elimination import Row, eliminated
from geometry.kinematics.mechanism import Mechanism, Rolling, Tree, equations, mobility, tree, turns

# beyond so many meshes that carry power, assignments are not tried one by one but followed from that without losses
_MOST_TRIED = 10
_FOLLOWED = 50
# what is known of the equations: 1
_ONE = ("", 1)
_Unknown = tuple[str, int]


class MeshFlow(Record):
    """What one mesh carries: torques on both wheels about their own axes; ``power`` from first to second.

    The power is that which goes into the mesh as the carrier of both axes sees it, below 0 where the second wheel
    drives; ``loss`` what stays there.
    """

    mesh: Rolling
    torques: tuple[Fraction, Fraction]
    power: Fraction
    loss: Fraction


class Statics(Record):
    """A state of a train at constant speeds: torques from outside on drives, loads and held links, flows in meshes.

    ``idle``: meshes that follow from the others (equal satellites, closed loops), of which statics alone says nothing:
    here they carry nothing, the others all.
    """

    torques: Mapping[str, Fraction]
    powers: Mapping[str, Fraction]
    flows: tuple[MeshFlow, ...]
    idle: tuple[Rolling, ...]

    @property
    def power_in(self) -> Fraction:
        """What drives and loads put in."""
        return sum((p for p in self.powers.values() if p > 0), Fraction())

    @property
    def efficiency(self) -> Fraction | None:
        """What comes out of what goes in; None where nothing goes in."""
        out = -sum((p for p in self.powers.values() if p < 0), Fraction())
        return out / self.power_in if self.power_in else None

    @property
    def circulation(self) -> Fraction:
        """The greatest power of a mesh, as its carrier sees it, by the power put in: above 1 power goes round.

        0 where nothing goes in.
        """
        most = max((abs(flow.power) for flow in self.flows), default=Fraction())
        return most / self.power_in if self.power_in else Fraction()


def statics(
    mechanism: Mechanism,
    speeds: Mapping[str, Fraction],
    loads: Mapping[str, Fraction],
    efficiency: Fraction = Fraction(1),
) -> tuple[Statics, ...]:
    """The states in which a train runs at the speeds of its drives against loads; none: it is self-locking.

    ``speeds``: rad/s of each drive, whose torque is sought; ``loads``: torques from outside, N m, on other links;
    ``efficiency`` of every mesh. Torques count counter-clockwise, power as what goes into the train.

    Raises
    ------
    ParameterError
        The drives leave a link free or contradict each other, a load stands on a drive or a held link, or efficiency
        is not within 0 (left out) and 1.
    """
    if not 0 < efficiency <= 1:
        raise ParameterError("mesh_efficiency", float(efficiency), "not_an_efficiency")
    stands, moved = tree(mechanism), turns(mechanism, speeds)
    redundant = [r.source for r in mobility(mechanism).redundant if isinstance(r.source, Rolling)]
    meshes = [e.source for e in equations(mechanism) if isinstance(e.source, Rolling) and e.source not in redundant]
    omega = {
        link: sum((share * speeds[drive] for drive, share in moved.of(link).items()), Fraction())
        for link in stands.quantities()
    }
    for link in loads:
        if any(stands.together(link, other) for other in (*speeds, *mechanism.held)):
            raise ParameterError("torques", link, "load_on_given_link")
    train = _Train(stands, meshes, omega, speeds, loads)
    if efficiency == 1:
        return (train.state([1] * len(meshes), efficiency, redundant),)
    found: list[Statics] = []
    for drives in train.assignments(efficiency):
        state = train.state(drives, efficiency, redundant)
        agrees = all(flow.power * way >= 0 for flow, way in zip(state.flows, drives, strict=True))
        if agrees and all(state.flows != other.flows for other in found):
            found.append(state)
    return tuple(found)


class _Train(Record):
    """The equations of a train: one balance for every link's turn."""

    stands: Tree
    meshes: list[Rolling]
    omega: Mapping[str, Fraction]
    speeds: Mapping[str, Fraction]
    loads: Mapping[str, Fraction]

    def _sides(self, mesh: Rolling) -> tuple[Row[str], Row[str]]:
        """The turns of both wheels against their carrier, by links."""
        second = (self.stands.travel if mesh.kind == "rack" else self.stands.turn)(mesh.second, mesh.on)
        return self.stands.turn(mesh.first, mesh.on), second

    def _speed(self, terms: Row[str]) -> Fraction:
        return sum((share * self.omega[link] for link, share in terms.items()), Fraction())

    def assignments(self, efficiency: Fraction) -> Iterator[list[int]]:
        """Which wheel drives in each mesh, 1 the first, -1 the second: all that may be, or the one that is followed."""
        ideal = self.state([1] * len(self.meshes), Fraction(1), [])
        running = [k for k, flow in enumerate(ideal.flows) if self._speed(self._sides(flow.mesh)[0])]
        if len(running) <= _MOST_TRIED:
            for ways in product((1, -1), repeat=len(running)):
                chosen = dict(zip(running, ways, strict=True))
                yield [chosen.get(k, 1) for k in range(len(self.meshes))]
            return
        drives = [1 if flow.power >= 0 else -1 for flow in ideal.flows]
        for _ in range(_FOLLOWED):
            state = self.state(drives, efficiency, [])
            after = [1 if flow.power >= 0 else -1 for flow in state.flows]
            if after == drives:
                yield drives
                return
            drives = after

    def state(self, drives: list[int], efficiency: Fraction, idle: list[Rolling]) -> Statics:
        """Torques where the first (1) or the second wheel (-1) of each mesh drives."""
        balance: dict[str, Row[_Unknown]] = {link: {} for link in self.omega}
        passed = [efficiency**way for way in drives]
        for number, (mesh, share) in enumerate(zip(self.meshes, passed, strict=True)):
            one, two = self._sides(mesh)
            ratio = mesh.ratio
            for terms, scale in ((one, Fraction(ratio.numerator)), (two, -ratio.denominator * share)):
                for link, part in terms.items():
                    row = balance[link]
                    row[("mesh", number)] = row.get(("mesh", number), Fraction()) + scale * part
        outside = [*self.speeds, *self.stands.mechanism.held]
        for number, link in enumerate(outside):
            if (body := self.stands.body(link)) in balance:
                balance[body][("torque", number)] = Fraction(1)
        for link, torque in self.loads.items():
            row = balance[self.stands.body(link)]
            row[_ONE] = row.get(_ONE, Fraction()) + torque
        rows = [{key: value for key, value in row.items() if value} for row in balance.values()]
        solved = eliminated(rows, {_ONE}).solved

        def value(unknown: _Unknown) -> Fraction:
            told = solved.get(unknown, {})
            return told.get(_ONE, Fraction()) if set(told) <= {_ONE} else Fraction()

        torques = {link: value(("torque", number)) for number, link in enumerate(outside)} | dict(self.loads)
        powers = {link: torque * self.omega.get(self.stands.body(link), Fraction()) for link, torque in torques.items()}
        flows = []
        for number, (mesh, share) in enumerate(zip(self.meshes, passed, strict=True)):
            pull, ratio = value(("mesh", number)), mesh.ratio
            on_first, on_second = pull * ratio.numerator, -pull * ratio.denominator * share
            one, two = self._sides(mesh)
            power, out = -on_first * self._speed(one), on_second * self._speed(two)
            flows.append(MeshFlow(mesh, (on_first, on_second), power, power - out))
        return Statics(torques, powers, tuple(flows), tuple(idle))
