"""What a kind of part has to say, in one place: keys, exact thing, solid, report, probes, page, sheet, drawing.

A kind is an instance of a subclass, registered by one row of ``parts/base/kinds.psv`` (or by ``add_kind``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar, Generic, TypeVar

from geometry.base.errors import Nearest, OffsetError, ParameterError
from geometry.base.record import Record, field
from parts.base.refusal import SceneError
from parts.base.schema import value_at
from parts.base.texts import Text, Words

if TYPE_CHECKING:
    from pathlib import Path

    from geometry.base.findings import Finding
    from geometry.curves.curve import Complex
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile
    from geometry.solids.body import Body
    from geometry.solids.cross_holes import CrossHole
    from geometry.solids.faced import FacedBody
    from geometry.solids.mass import Moments
    from geometry.solids.sketch import Sketch
    from parts.base.part_keys import MaterialKeys
    from parts.base.readback import Probe

K = TypeVar("K", bound="MaterialKeys")
T = TypeVar("T")
# the keys of every part of a scene, for what is made from another part's
Others = Mapping[str, "MaterialKeys"]

# symbols of what tells wheels apart, and their keys
_NUMBERS = (("z", "number_of_teeth"), ("m", "module"), ("x", "profile_shift_coefficient"))


class HoleAt(Record):
    """A round hole: its centre (None: not known yet), its diameter, mm, and the instance whose axle it takes.

    ``beside``: one of a grid about that axle.
    """

    centre: complex | None
    diameter: float
    axle: str | None = None
    beside: bool = False


class Stock(Record):
    """A length of a round rod, or of a tube where there is a bore, mm."""

    diameter: float
    bore: float
    length: float

    def told(self, language: Words) -> str:
        """Its sizes as parts lists have them."""
        sizes = [f"Ø{size:.6g}" for size in (self.diameter, self.bore) if size]
        return language.decimal(" × ".join(["/".join(sizes), f"{self.length:.6g}"]))


class Report(Record):
    """What a part says of itself: remarks, named diameters (mm) and all other named results.

    ``flat_findings``: remarks on each flat outline of the part.
    """

    findings: tuple[Finding, ...] = ()
    circles: dict[str, float] = field(default_factory=dict)
    quantities: dict[str, float] = field(default_factory=dict)
    flat_findings: tuple[Finding, ...] = ()


def diameters(thing: object, *names: str) -> dict[str, float]:
    """The circles of a thing by the names of its radii, tip or root, mm."""
    return {f"{name}_diameter": 2 * getattr(thing, f"{name}_radius") for name in names}


class Kind(Generic[K, T]):
    """A kind of part. ``K``: its keys (a msgspec struct, tagged with the kind's name), ``T``: its exact thing."""

    name: str
    keys: type[K]
    # whether flat files can hold it: its section is what its solid is made of
    has_outline = True
    # code of the refusal to move its faces, of a solid that is made as it is alone
    unmoved = ""
    # where it comes from outside: sentences of its own refusals and remarks by code, names of its quantities
    reasons: ClassVar[Mapping[str, Text]] = {}
    findings: ClassVar[Mapping[str, Text]] = {}
    quantities: ClassVar[Mapping[str, str]] = {}
    # modules with its calculation page and its working drawing, loaded when one is asked for
    page: str | None = None
    drawing: str | None = None
    # module with the table of its working drawing: data_table(part, scene, mates)
    data_table: str | None = None
    # what ``new`` shows: keys of the part that its key ``of`` names; the purpose of a sheet that shows one part of it
    made_from: Mapping[str, object] | None = None
    sheet_shown: tuple[str, str] | None = None
    # the mate that it shows; None: the first that joins the kind
    mate_shown: str | None = None

    def thing(self, keys: K, others: Others) -> T:
        """The exact thing, checked to exist.

        Raises
        ------
        ParameterError
            It cannot exist: the key (``tip_relief.depth_coefficient``), its value in the key's unit, and why.
        """
        raise NotImplementedError

    def idle(self, keys: K, others: Others) -> Iterable[ParameterError]:
        """The refusals of keys that do nothing beside the others: sizes of a tail, without its length.

        What a part has of them from ``[defaults]`` is passed over.
        """
        return ()

    def gathered(self, keys: K, folder: Path) -> K:
        """The keys with what they need of files; ``folder``: that of the scene's file."""
        return keys

    def section(self, keys: K, thing: T, offset: float) -> OffsetRegion:
        """The flat section, every boundary moved ``offset`` mm out of the material."""
        raise NotImplementedError

    def solid(self, keys: K, thing: T, offset: float) -> Body | FacedBody:
        """The solid, its lower face at z = 0, every boundary moved ``offset`` mm: its section, extruded."""
        from geometry.solids.body import plate

        return plate(self.section(keys, thing, offset).region, 0.0, self.height(keys, thing))

    def cross_holes(self, keys: K, thing: T) -> tuple[CrossHole, ...]:
        """Holes across the hub of its solid, which the solid itself, drawings and checks do without."""
        return ()

    def stays(self, offset: float) -> None:
        """Refuse an offset of what is made as it is alone."""
        if offset and self.unmoved:
            raise OffsetError(offset, self.unmoved, alone=True)

    def sketch(self, keys: K, thing: T) -> Sketch | None:
        """What assembly drawings show of it; None: they cannot."""
        solid = self.solid(keys, thing, 0.0)
        if solid.is_faced:
            return None
        from geometry.solids.sketch import sketch_of_body

        return sketch_of_body(solid)

    def axial_section(self, thing: T, chord: float) -> Complex | None:
        """Half of what is turned, r + iz, by chords at most so many mm off its arcs; None: it is not turned."""
        return None

    def moments(self, solid: Body | FacedBody) -> Moments:
        """Volume, centre and inertia of a solid of the kind, by exact integrals."""
        if solid.is_faced:
            return solid.moments
        from geometry.solids.mass import body_moments

        return body_moments(solid)

    def stock(self, keys: K) -> Stock | None:
        """The rod or tube that it is a length of; None: it is no such length."""
        return None

    def height(self, keys: K, thing: T) -> float:
        """Height along the axis, of the rim where there is one, mm."""
        match keys:
            case object(face_width=float(width)):
                return width
            case _:
                raise TypeError(type(keys))

    def middle(self, keys: K, thing: T) -> float:
        """A height at which its bore is whole, mm: the middle of a face, else of all of it."""
        return (getattr(keys, "face_width", 0.0) or self.height(keys, thing)) / 2

    def is_plate(self, keys: K, thing: T) -> bool:
        """Whether the solid is its section, extruded."""
        return self.has_outline and not self.unmoved

    def numbers(self, keys: K) -> str:
        """The numbers by which people know one from another; no-break spaces hold each to its symbol."""
        found = ((symbol, getattr(keys, key, None)) for symbol, key in _NUMBERS)
        return " ".join(f"{symbol}\u00a0{value:.4g}" for symbol, value in found if value)

    def wrong_numbers(self, keys: K, label: str) -> Sequence[Finding]:
        """Numbers that a label tells of a part which has others: z 21 on a gear of 22 teeth."""
        from geometry.base.findings import Finding

        found = []
        for symbol, key in _NUMBERS:
            own = getattr(keys, key, None)
            told = re.search(rf"(?<!\w){symbol}\s*=?\s*(-?\d+(?:[.,]\d+)?)", label)
            if own is not None and told and (said := float(told[1].replace(",", "."))) != float(f"{own:.4g}"):
                found.append(Finding(f"label_tells_{symbol}", said, own))
        return found

    def holes_at(self, keys: K) -> Sequence[HoleAt]:
        """Round holes that an axle may go through."""
        return ()

    def axle_diameter(self, keys: K) -> float:
        """Diameter of the axle that it turns on, mm; 0 where no key tells it."""
        return float(getattr(keys, "bore_diameter", 0.0) or 0.0)

    def report(self, keys: K, thing: T) -> Report:
        """Remarks and named results."""
        return Report()

    def pitch_curve(self, keys: K, thing: T) -> Profile | None:
        """The closed path of a round follower's centre, in the frame of the part; None: it has none."""
        return None

    def probes(self, keys: K, thing: T) -> tuple[Probe, ...]:
        """What its files must also do: a follower rolled over them, a pin that fits."""
        return ()

    def refused(
        self,
        keys: K,
        refusal: ParameterError,
        source: str,
        place: str,
        make: Callable[[K], T],
        fits: Callable[[K, T], Iterable[str]] = lambda keys, thing: (),
    ) -> SceneError:
        """The refusal under the scene's key; what it offers has been tried once, and goes where it does not build.

        ``make``: its thing as it is in its scene; ``fits`` refuses keys and their thing where what hangs on the part
        does not take them: what it offers for the same key is tried then; it names the parts that must change too.
        """
        from parts.base.offers import Trial

        trial = Trial(keys, make, fits, self.solid if getattr(keys, "face_chamfer", 0.0) else None)
        told = trial.told(refusal, source, place)
        if refusal.code != "either_key" or told.nearest is not None:
            return told
        # what cannot be left out stands beside what can
        owner, dot, own = refusal.name.rpartition(".")
        name = owner + dot + next(str(key) for key in refusal.numbers.values() if key != own)
        other = ParameterError(name, value_at(keys, name), refusal.code, Nearest(None), **refusal.numbers)
        turned = trial.told(other, source, place)
        return told if turned.nearest is None else turned
