"""The flywheel that keeps a machine even over a cycle, by Mertsalov: guidelines on coursework, 2.2.5.

Everything is reduced to the crank: the moment of the resistance M_c = F V / omega and the inertia
J = sum m (V / omega)^2, V the velocities at the mean speed omega. The driving moment is the mean of M_c, so that a
cycle ends as it began. What the flywheel has to take up is the change of the whole kinetic energy less that of the
links; both are taken at the mean speed, which is right for small unevenness.
"""

from __future__ import annotations

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.curves.curve import Real


class Cycle(Record, eq=False):
    """Over one turn of the crank, both ends included: angle (rad), work of the resistance since the start (J), and
    inertia of the links (kg m^2).
    """

    angle: Real
    work: Real
    inertia: Real


class Flywheel(Record, eq=False):
    """``moment``: of the flywheel, kg m^2; ``driving`` moment, N m; energies over the cycle, J, from its start.

    ``gained``: of the whole machine, ``of_links``, and ``of_flywheel``: what is left of it.
    """

    moment: float
    driving: float
    gained: Real
    of_links: Real
    of_flywheel: Real

    @property
    def swing(self) -> float:
        """Greatest less least energy of the flywheel, J: the segment KK1."""
        return float(np.ptp(self.of_flywheel))


def mertsalov(cycle: Cycle, speed: float, unevenness: float) -> Flywheel:
    """J = (T_max - T_min) / (omega^2 delta), delta = (omega_max - omega_min) / omega.

    Raises
    ------
    ParameterError
        The resistance does no work over the cycle, or drives the machine.
    """
    work = cycle.work
    if not work[-1] > 0:
        raise ParameterError("resistance", float(work[-1]), "no_work_over_cycle")
    turned = cycle.angle - cycle.angle[0]
    driving = float(work[-1] / turned[-1])
    gained = driving * turned - work
    of_links = (cycle.inertia - cycle.inertia[0]) * speed**2 / 2
    rest = gained - of_links
    return Flywheel(float(np.ptp(rest)) / (speed**2 * unevenness), driving, gained, of_links, rest)


def travelled(place: Real, *, forward: bool) -> Real:
    """How far a slider has gone one way since the start, at places between which it does not turn round."""
    return np.concatenate([[0.0], np.cumsum(np.maximum(np.diff(place if forward else -place), 0.0))])
