"""Phases that go on with the motion of their neighbours: from rest or motion to rest or motion, VDI 2143."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.cams.motion.follower_motion import Phase
from geometry.laws.law import Law
from geometry.laws.named import polynomial_law

# stands for the law of a phase that its neighbours decide
JOIN = Law("join", ())


def with_joins(phases: Sequence[Phase], *, closed: bool) -> list[Phase]:
    """The phases, each ``JOIN`` made the polynomial of degree 5 with its neighbours' S' and S'' at its ends.

    ``closed``: the last phase stands before the first one; else there is rest around them.

    Raises
    ------
    ParameterError
        Two of them side by side: nothing says how fast the follower is between them.
    """
    around = [phases[-1], *phases, phases[0]] if closed else [Phase(1.0), *phases, Phase(1.0)]
    return [
        replace(phase, law=_joined(phase, around[k], around[k + 2], k)) if phase.law is JOIN else phase
        for k, phase in enumerate(phases)
    ]


def _joined(phase: Phase, before: Phase, after: Phase, index: int) -> Law:
    conditions = [(0.0, 0, 0.0), (1.0, 0, 1.0)]
    for end, neighbour in ((0.0, before), (1.0, after)):
        if neighbour.law is JOIN:
            raise ParameterError(f"phases[{index + 1}].law", "join", "joins_side_by_side", Nearest("sine"))
        for order in (1, 2):
            rate = 0.0
            if neighbour.law is not None:
                piece, at = (neighbour.law.pieces[-1], 1.0) if end == 0 else (neighbour.law.pieces[0], 0.0)
                rate = float(piece.value(at, order)) * neighbour.lift / neighbour.angle**order
            conditions.append((end, order, rate * phase.angle**order / phase.lift))
    return polynomial_law(conditions)
