"""What a file says when it is read again, whatever its format, and the probes that a kind of part puts it to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from geometry.base.findings import Finding
from geometry.base.record import Record, field
from geometry.curves.curve import Complex, Real

if TYPE_CHECKING:
    from geometry.cams.contact.rolled import Outline

# points along an edge of a file, and along all of them at most
_ALONG, _MOST = 129, 40_000


class ReadError(ValueError):
    """A file is not what its ending says, or holds something that its receivers refuse."""


def refuse_if(wrong: object, why: str) -> None:
    """A file in which something is wrong.

    Raises
    ------
    ReadError
        That is so: it says why.
    """
    if wrong:
        raise ReadError(why)


class ReadLoop(Protocol):
    """A closed outline as a file has it."""

    @property
    def points(self) -> Complex:
        """Where each of its edges begins, mm."""

    @property
    def size(self) -> float:
        """By which the outermost of several is told."""

    def outline(self, turn: complex = 1.0, *, clockwise: bool = False) -> Outline:
        """It, turned about the axis, for a follower to touch; ``clockwise``: about a hole."""


class ReadBack(Protocol):
    """A file of one part. Each question may raise ``ReadError``."""

    @property
    def has_arcs(self) -> bool:
        """Whether its curves are lines and arcs, whose curvature jumps."""

    @property
    def is_flat(self) -> bool:
        """Whether it holds outlines, and no solid."""

    @property
    def colour(self) -> str | None:
        """The colour of its part, #rrggbb; None where it has none."""

    def names(self) -> tuple[str, ...] | None:
        """What its parts are called; None where the format has no names."""

    def section(self, z: float) -> Sequence[ReadLoop]:
        """The closed outlines at a height, mm; of a flat file all of its outlines."""

    def faces(self) -> Real:
        """Corners (n, 3, 3) of its triangles, mm; n = 0 where it has none."""


def outline_at(file: ReadBack, height: float, missing: str, number: int = 1) -> Complex:
    """Points along the outermost outline at a height, mm, or the ``number``-th; ``missing``: what is wrong without."""
    loops = sorted(file.section(height), key=lambda loop: loop.size)
    refuse_if(len(loops) < number, missing)
    return outline_points(loops[-number])


def outline_points(loop: ReadLoop) -> Complex:
    """Points along an outline, mm."""
    import numpy as np

    found = []
    families = loop.outline().edges
    count = max(3, min(_ALONG, _MOST // max(sum(map(len, families)), 1)))
    for family in families:
        edges = np.repeat(np.arange(len(family)), count)
        found.append(family.at(edges, np.tile(np.linspace(0, 1, count), len(family)))[0])
    return np.concatenate(found)


class Probed(Record):
    """What a probe has measured, what it finds wrong, and what is worth a remark."""

    measured: dict[str, float] = field(default_factory=dict)
    failures: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()


class Probe(Record, kw_only=True):
    """What a part's files must also do, beside agreeing with its exact section or solid.

    ``name``: what the names of its measured values begin with; empty where the part has only this probe.
    """

    name: str = ""
    # whether it is left out where an offset has trimmed the outline
    needs_whole = False

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """Put a file to it whose outlines are ``offset`` mm out of the material and ``declared`` mm off at most.

        Raises
        ------
        ReadError
            The file holds nothing that it could be put to.
        """
        raise NotImplementedError
