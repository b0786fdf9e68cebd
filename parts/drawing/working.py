"""What a kind says for its working drawing: views in model mm with their sizes, requirements.

A kind names a module, ``Kind.drawing``, whose ``part_drawing(subject)`` makes a ``PartDrawing``.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable
from functools import cached_property
from typing import Literal

from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Curve
from geometry.curves.line_arc import Arc, Line
from parts.base.part import Part
from parts.drawing.canvas import decimal
from parts.drawing.ink import chords
from parts.keys.working import WorkingTable
from parts.texts.sheets import sheet_words, view_letter

Side = Literal["left", "right", "above", "below"]
# lines of GOST 2.303 by what they show
VISIBLE, AXIS, THIN, HIDDEN = "OUTLINE", "CENTRE", "THIN", "HIDDEN"
_DECIMALS = 3
# in a title the sign of GOST 2.305 for a view that is turned; the font has none, so it is drawn
TURNED = "\u21bb"


Stroke = tuple[str, Curve]
# a place and the way out of the material there
Spot = tuple[complex, complex]


class Size(Record):
    """A linear size: between two points along x (its line above or below the view) or along y (left or right).

    ``before`` and ``after`` the number stand a sign and a fit: Ø, h11, ×45°; then at how many ``places`` it is.
    ``name``: of what it is, for readers of the file's dimensions in programs; ``datum``: its letter, where its axis
    or plane is one; ``whole``: what it is, over a break of the view, mm.
    """

    name: str
    start: complex
    end: complex
    side: Side
    before: str = ""
    after: str = ""
    places: str = ""
    datum: str = ""
    whole: float | None = None

    @property
    def drawn(self) -> float:
        """How far apart its ends are, mm."""
        way = self.end - self.start
        return abs(way.imag if self.side in ("left", "right") else way.real)

    @property
    def value(self) -> float:
        """The number, mm."""
        return self.drawn if self.whole is None else self.whole


class Slant(Record):
    """A size along a unit vector ``way``, between two points, its line beside them on the side of ``out``."""

    name: str
    start: complex
    end: complex
    way: complex
    out: complex
    before: str = ""
    after: str = ""
    places: str = ""

    @property
    def value(self) -> float:
        """The number, mm."""
        return abs(((self.end - self.start) * self.way.conjugate()).real)


class Angle(Record):
    """An angle at a place, between unit vectors ``first`` and ``second``; along them edges reach so far, mm.

    The older importer of FreeCAD takes its dimension in a DXF for a length, the radius of its arc.
    """

    at: complex
    first: complex
    second: complex
    words: str
    reaches: tuple[float, float] = (0.0, 0.0)

    @property
    def value(self) -> float:
        """The number, degrees."""
        return math.degrees(abs(cmath.phase(self.second / self.first)))


class Round(Record):
    """The diameter, or the radius where ``is_radius``, of a circle or arc, on a leader; ``angles``: where it may stand.

    Angles in degrees, the best first. ``inward``: its leader runs towards the centre. ``also``: centres and angles of
    other arcs that are of this size. ``datum``: its letter, where its axis is one.
    """

    name: str
    centre: complex
    radius: float
    before: str = "Ø"
    after: str = ""
    is_radius: bool = False
    inward: bool = False
    angles: tuple[float, ...] = (45.0, 135.0, -45.0, -135.0)
    also: tuple[tuple[complex, tuple[float, ...]], ...] = ()
    places: str = ""
    datum: str = ""

    @property
    def value(self) -> float:
        """The number, mm."""
        return self.radius if self.is_radius else 2 * self.radius


def arc_angles(arc: Arc) -> tuple[float, ...]:
    """Where on an arc the arrow of its radius may stand, degrees, the middle first."""
    middle = math.degrees(cmath.phase(complex(arc.point(abs(arc.sweep) / 2)) - arc.centre))
    spread = math.degrees(abs(arc.sweep)) / 2
    return tuple(middle + share * spread for share in (0.0, 0.5, -0.5, 0.9, -0.9))


class Note(Record):
    """Words on a leader to a point; ``is_rough``: in the sign of GOST 2.309 for a surface that is cut.

    ``goes_on``: the point is the right end of a pitch line, and the sign stands on its extension where there is room.
    ``free``: the way out of the material there, from which its leader comes; 0: from anywhere. ``also``: other points
    that serve as well, with theirs.
    ``looks``: the text is the letter of a view, and an arrow points that way: -1 from the right, -1j from above.
    ``is_letter``: it names a view, and is as large as titles are. ``about``: mm, the words stand without a leader
    beside a circle of this radius about the point. ``datum``: the text is the runout about that, in a frame.
    """

    at: complex
    text: str
    is_rough: bool = False
    goes_on: bool = False
    looks: complex = 0
    is_letter: bool = False
    free: complex = 0j
    also: tuple[Spot, ...] = ()
    about: float | None = None
    datum: str = ""


class Cut(Record):
    """Marks of a section across the axis at x = ``at``, seen from the left: strokes, arrows, letters; GOST 2.305."""

    at: float
    letter: str
    from_right: bool = False


class View(Record, dict=True):
    """A view in model mm, its x axis the axis that it shares with its neighbours.

    ``strokes``: curves by the layer of their line; ``hatched``: closed loops of lines and arcs, material between them.
    ``length``: axes reach so far beyond their ends on paper, mm. ``title``: stands above it, ``TURNED`` in it for that
    sign; ``least``: mm that it is high on paper at least, a view with a scale of its own. ``from_right``: it is seen
    from the right of the main view, on whose left it stands (GOST 2.305). ``in_row``: it stands in projection, although
    it has letters. ``rim`` and ``face``: places on what is round about the axis and on an end face, with the ways out
    of the material there.
    """

    strokes: tuple[Stroke, ...]
    hatched: tuple[tuple[Line | Arc, ...], ...] = ()
    axes: tuple[Line, ...] = ()
    sizes: tuple[Size, ...] = ()
    rounds: tuple[Round, ...] = ()
    notes: tuple[Note, ...] = ()
    title: str = ""
    least: float = 0.0
    cuts: tuple[Cut, ...] = ()
    from_right: bool = False
    in_row: bool = False
    slants: tuple[Slant, ...] = ()
    angles: tuple[Angle, ...] = ()
    rim: tuple[Spot, ...] = ()
    face: tuple[Spot, ...] = ()

    @cached_property
    def chords(self) -> tuple[Complex, ...]:
        """Chords along each of its strokes, (2, n), model mm."""
        return tuple(chords(curve) for _, curve in self.strokes)

    def plus(
        self, strokes: Iterable[Stroke] = (), hatched: Iterable[tuple[Line | Arc, ...]] = (), axes: Iterable[Line] = (),
        sizes: Iterable[Size] = (), rounds: Iterable[Round] = (), notes: Iterable[Note] = (),
    ) -> View:  # fmt: skip
        """The same with more of these behind its own."""
        return replace(
            self, strokes=(*self.strokes, *strokes), hatched=(*self.hatched, *hatched), axes=(*self.axes, *axes),
            sizes=(*self.sizes, *sizes), rounds=(*self.rounds, *rounds), notes=(*self.notes, *notes),
        )  # fmt: skip


class PartDrawing(Record):
    """All that a kind draws of a part: views, the main one first, lines of technical requirements."""

    views: tuple[View, ...]
    requirements: tuple[str, ...] = ()


class Subject(Record):
    """What a drawing is made of: the part, and what the export wishes."""

    part: Part
    wishes: WorkingTable
    language: str

    def say(self, value: float, digits: int = _DECIMALS) -> str:
        """A number in the language, without zeros that say nothing."""
        return number_text(value, self.language, digits)

    def rough(self, value: float) -> str:
        """A roughness as signs have it."""
        return f"Ra {self.say(value)}"

    def worked(self, at: complex, *, goes_on: bool = False, free: complex = 0j, also: tuple[Spot, ...] = ()) -> Note:
        """The sign of a working surface at a place of it, as ``Note`` has it."""
        text = self.rough(self.wishes.flank_roughness)
        return Note(at, text, is_rough=True, goes_on=goes_on, free=free, also=also)

    def words(self, key: str, **numbers: object) -> str:
        """A term of sheets."""
        return sheet_words(self.language, key, **numbers)

    def letter(self, number: int = 0) -> str:
        """The name of a view or section, 0 the first."""
        return view_letter(self.language, number)


def number_text(value: float, language: str, digits: int = _DECIMALS) -> str:
    """A number as drawings have it: so many decimals at most, none that are zero."""
    text = f"{value:.{digits}f}"
    return decimal(text.rstrip("0").rstrip(".") if "." in text else text, language)


def requirements(subject: Subject, *more: str) -> tuple[str, ...]:
    """What the export says of material and treatment, which stand first (GOST 2.316), then what holds for all sizes,
    and ``more`` that no size tells.
    """
    return (*subject.wishes.requirements, subject.words("unspecified_limits"), *more)
