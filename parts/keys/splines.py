"""Keys of splines, the same for a bore and for a step of a shaft: by designation, or of your own sizes."""

from __future__ import annotations

import math
import re
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct
from msgspec.structs import replace as changed

from geometry.base.errors import Cure, Nearest, ParameterError
from geometry.base.nearest import kept, nearest
from geometry.base.record import replace
from parts.base.lookalikes import in_latin
from parts.keys.base import degrees, either, part_mm

if TYPE_CHECKING:
    from geometry.solids.splines import Centring, Fit, InvoluteJoint, SplineBore, StraightJoint
    from parts.base.readback import Probe

_OWN = ("teeth", "inner_diameter", "outer_diameter", "width")
# sizes of a spline that may be less, down to 0
_SMALL = ("chamfer", "root_rounding", "clearance")
# a number with or without zones of tolerance after it, and a class of tolerance alone
_FIT = r"[A-WYZa-wyz]{1,2}[1-9]\d?"
_NUMBER = re.compile(rf"(\d+(?:\.\d+)?)({_FIT}(?:/{_FIT})?)?")
_CLASS = r"[1-9]\d?(?:js|[A-WYZa-wyz])"
_CLASSES = re.compile(rf"x({_CLASS})(?:/?({_CLASS}))?$")
# behind a blank alone, as DIN 5480 has them: 120 x 3 x 38 9H/8f; 24z of ISO 4156 are teeth
_BLANK = re.compile(rf"(?<=[\dRP])\s+(?={_CLASS}(?<!z)(?:\s*/?\s*{_CLASS})?(?:\s|$))", re.IGNORECASE)
_ALONE = re.compile(rf"{_CLASS}(?:/?{_CLASS})?")
# zones with a sign before them, as GOST 6033 has them
_APART = re.compile(rf"x(?={_FIT})")
# what stands before z x d x D and d_B x m x z: the surface that centres, shaft (W) or hub (N)
_PREFIX = re.compile(r"(?:[dDb]-?|[WN])?")
# only 30 degrees has two forms of the root: 37.5 and 45 are whole without a letter
_ISO = re.compile(
    rf"(?:INT|EXT|INT/EXT)?(\d+)zx(\d+(?:\.\d+)?)mx(30(?=[PR])|37\.5|45)([PR]?)(?:x{_CLASS}(?:/{_CLASS})?)?",
    re.IGNORECASE,
)
# signs of multiplication, decimal commas, minus and dashes
_SIGNS = str.maketrans("X\u00d7*,\u2212\u2013\u2014", "xxx.---")
_EXAMPLES = {"GOST 6033": "50x2", "DIN 5480": "50x2x24", "ISO 4156": "24z x 2m x 30R"}
# what the standards have, and a shaft
_LEAST_TEETH, _MOST_TEETH = 6, 200
_CENTRING: dict[str, Centring] = {"D": "outer", "b": "sides"}
Clearance = Annotated[float, part_mm("how far every surface stands off that of the mate, along its normal", least=0)]
Direction = Annotated[float, degrees("direction of the first slot or tooth", least=-360, most=360)]
Standard = Literal["GOST 6033", "DIN 5480", "ISO 4156"]


def _plain(size: str, *standards: str) -> str:
    """A designation without blanks and without the name of its standard before or after it.

    Cyrillic letters become the Latin ones that look like them, signs between sizes x, decimal marks points.
    """
    plain = "".join(_BLANK.sub("x", in_latin(size)).split()).translate(_SIGNS).replace("\u0413OCT", "GOST")
    named = "|".join(standard.replace(" ", "") for standard in standards)
    return re.sub(rf"^(?:{named})-?|(?:{named})(?:-\d+)?$", "", plain)


def _sizes(plain: str) -> list[tuple[float, str]]:
    """The numbers of a plain designation, each with the zones beside it; nothing where it is none."""
    parts = [part for part in _APART.sub("", _PREFIX.sub("", plain, 1)).split("x") if not _ALONE.fullmatch(part)]
    found = [_NUMBER.fullmatch(part) for part in parts]
    return [] if None in found else [(float(match[1]), match[2] or "") for match in found if match]


def _fit(table: StraightSplineTable | InvoluteSplineTable, symbol: str, size: float, zones: str) -> Fit:
    """The zones beside a size of its designation, that of the hub first."""
    from geometry.solids.splines import Fit
    from geometry.solids.zones import GRADES, HOLES, MOST_SIZE, SHAFTS, split_zone

    designation, told = table.size or "", dict[str, str]()
    if size > MOST_SIZE:
        raise ParameterError("bore.size", designation, "spline_zones_end", most=MOST_SIZE)
    for zone in zones.split("/"):
        letter, grade = split_zone(zone)
        part = "hub" if letter in HOLES else "shaft"
        if part == "hub" and "shaft" in told:
            right = f"{zone}/{told['shaft']}"
            cure = _if_made(table, designation.replace(zones, right))
            raise ParameterError("bore.size", designation, "spline_hub_first", cure, right=right)
        if letter not in HOLES + SHAFTS or grade not in GRADES or part in told:
            raise ParameterError(
                "bore.size", designation, "no_such_spline_zone", zone=zone, least=GRADES[0], most=GRADES[-1],
                hubs=", ".join(HOLES), shafts=", ".join(SHAFTS),
            )  # fmt: skip
        told[part] = zone
    return Fit(symbol, size, **told)


def _if_made(table: StraightSplineTable | InvoluteSplineTable, size: str) -> Cure:
    """Another designation, where that has a joint."""
    return lambda: Nearest(size) if size != table.size and kept(_has_joint, changed(table, size=size)) else None


def _has_joint(table: _SplineTable) -> bool:
    return table.joint() is not None


def _check_clearance(clearance: float) -> None:
    """Refuse one beside tolerances, which tell how far the sides stand off."""
    if clearance > 0:
        raise ParameterError("bore.clearance", clearance, "clearance_of_class", Nearest(0.0))


class _SplineTable(Struct, forbid_unknown_fields=True, tag_field="shape"):
    """What both sorts of splines do."""

    def joint(self) -> StraightJoint | InvoluteJoint:
        """The joint of its keys; ParameterError with the key below ``bore``."""
        raise NotImplementedError

    def bore(self) -> SplineBore:
        """The slots of its hub; ParameterError with the key below ``bore``."""
        raise NotImplementedError

    def checked(self, place: str) -> SplineBore:
        """What its shaft goes into, checked; ParameterError with the key below a ``place``."""
        try:
            made = self.bore()
            made.check()
        except ParameterError as refusal:
            key = refusal.name.removeprefix("bore.")
            # of small sizes that are typed the one that alone is too much
            small = [one for one in dict.fromkeys((key, *_SMALL)) if one in _SMALL and getattr(self, one, None)]
            ways = [(one, 0.0) for one in small]
            if "chamfer" in small and kept(_has_joint, self):
                # a mouth as wide as the rounding lets it in
                ways.append(("chamfer", getattr(self.joint(), "rounding", 0.0)))
            told = refusal
            for one, works in ways:
                if kept(partial(self._fits, one), works):
                    key, given = one, getattr(self, one)
                    told = refusal.told_of(key, given, partial(nearest, partial(self._fits, key), given, works))
                    break
            raise told.renamed(".".join(filter(None, (place, key)))) from refusal
        return made

    def _fits(self, key: str, value: float) -> bool:
        """Whether there is an outline with another size."""
        changed(self, **{key: value}).bore().check()
        return True

    def probes(self, height: float) -> tuple[Probe, ...]:
        """What files of a part with such a bore must do where they are cut, mm."""
        from parts.keys.spline_probe import SplineProbe

        return (SplineProbe(self.bore(), height, name="spline"),)


_SIZE = Meta(
    description="designation z x d x D, with d-, D- or b- before it where that centres; with zones of"
    " tolerance (d-8x36H7/f7x40H12/a11x7D9/f8) where limits are wanted; or give the sizes",
    examples=["6x11x14"],
)
_TEETH = Meta(ge=2, le=200, description="number of teeth z", examples=[6], extra={"aside": True})
_CHAMFER = part_mm("of the tips of a shaft and the mouths of slots; default: the standard's", least=0, example=0.3)
_ROOT_ROUNDING = part_mm("at the root of a shaft; default: the standard's", least=0, example=0.2)


class StraightSplineTable(_SplineTable, tag="spline"):
    """Straight-sided spline by GOST 1139 or ISO 14, or by teeth, inner_diameter, outer_diameter and width."""

    size: Annotated[str, _SIZE] | None = None
    teeth: Annotated[int, _TEETH] | None = None
    inner_diameter: Annotated[float, part_mm("between the teeth, d", above=0, example=11.0, aside=True)] | None = None
    outer_diameter: Annotated[float, part_mm("over the teeth, D", above=0, example=14.0, aside=True)] | None = None
    width: Annotated[float, part_mm("width of a tooth, b", above=0, example=3.0, aside=True)] | None = None
    chamfer: Annotated[float, _CHAMFER] | None = None
    root_rounding: Annotated[float, _ROOT_ROUNDING] | None = None
    clearance: Clearance = 0.0
    angle_deg: Direction = 90.0

    def joint(self) -> StraightJoint:
        """The joint of the designation, or of the sizes.

        Raises
        ------
        ParameterError
            No such joint, one that is told twice, or a size that is missing; the key below ``bore``.
        """
        from geometry.solids.spline_standards import STRAIGHT_JOINTS
        from geometry.solids.splines import StraightJoint

        given = self.teeth, self.inner_diameter, self.outer_diameter, self.width
        for key, value in zip(_OWN, given, strict=True):
            if self.size is None and value is None:
                raise ParameterError(f"bore.{key}", None, "one_of_two_is_missing", other="size")
            if self.size is not None and value is not None:
                raise either(f"bore.{key}", value, "size")
        if self.size is None:
            teeth, inner, outer, width = (value or 0 for value in given)
            found = StraightJoint(int(teeth), inner, outer, width, inner)
        else:
            plain = _plain(self.size, "GOST 1139", "ISO 14")
            sizes = _sizes(plain)
            numbers = [number for number, _ in sizes]
            like = [j for j in STRAIGHT_JOINTS if numbers in ([j.teeth, j.inner, j.outer], [*j.sizes])]
            if not like or sizes[0][1]:
                meant = min(
                    STRAIGHT_JOINTS, key=lambda j: sum(abs(a - b) for a, b in zip(j.sizes, numbers, strict=False))
                )
                cure = Nearest(meant.name.replace("×", "x"), "meant") if len(numbers) > 2 else None
                raise ParameterError(
                    "bore.size", self.size, "no_such_spline", cure, standard="GOST 1139, ISO 14", example="6x23x26"
                )
            beside = zip(("d", "D", "b"), sizes[1:], strict=False)
            fits = tuple(_fit(self, symbol, size, zones) for symbol, (size, zones) in beside if zones)
            found = replace(like[0], centring=_CENTRING.get(plain[0], "inner"), fits=fits)
            if found.centring != "inner" and fits and fits[0].symbol == "d" and fits[0].shaft:
                raise ParameterError("bore.size", self.size, "zone_of_free_root", zone=fits[0].shaft)
            if fits:
                _check_clearance(self.clearance)
        chamfer = found.chamfer if self.chamfer is None else self.chamfer
        rounding = found.rounding if self.root_rounding is None else self.root_rounding
        return replace(found, chamfer=chamfer, rounding=rounding)

    def bore(self) -> SplineBore:
        """Its slots; refuses as ``joint`` does."""
        size = ("bore.size", self.size) if self.size else ("bore.outer_diameter", self.outer_diameter)
        return _bored(self, size)


_INVOLUTE_SPLINE_SIZE = Meta(
    description="D x m of GOST 6033, d_B x m x z of DIN 5480, or 24z x 2m x 30R (P: flat root) of ISO 4156;"
    " with a class of tolerance at the end (9H/9g, 9H/8f, 5H/5f) where limits of the teeth are wanted",
    examples=["8x0.5"],
)


class InvoluteSplineTable(_SplineTable, tag="involute_spline"):
    """Involute spline by GOST 6033, DIN 5480 or ISO 4156."""

    size: Annotated[str, _INVOLUTE_SPLINE_SIZE]
    standard: Standard = "GOST 6033"
    centring: Annotated[Literal["sides", "outer"], Meta(description="GOST 6033: what centres")] = "sides"
    root: Annotated[Literal["flat", "fillet"], Meta(description="GOST 6033: bottom of the spaces")] = "flat"
    clearance: Clearance = 0.0
    angle_deg: Direction = 90.0

    def joint(self) -> InvoluteJoint:
        """The joint of the designation.

        Raises
        ------
        ParameterError
            None has it, or a key is that of another standard; the key below ``bore``.
        """
        try:
            return self._made()
        except ParameterError as refusal:
            others = (changed(self, standard=other) for other in _EXAMPLES if refusal.code == "no_such_spline")
            meant = next((other.standard for other in others if kept(InvoluteSplineTable._is_made, other)), None)
            if meant is None:
                raise
            told = {"size": self.size, "other": meant}
            raise ParameterError(
                "bore.standard", self.standard, "size_of_other_standard", Nearest(meant), **told
            ) from None

    def _is_made(self) -> bool:
        return self._made() is not None

    def _made(self) -> InvoluteJoint:
        """The same, of its own standard."""
        from geometry.solids import spline_standards as standards

        gost = self.standard == "GOST 6033"
        for key, value, usual in (("centring", self.centring, "sides"), ("root", self.root, "flat")):
            if value != usual and not gost:
                raise ParameterError(f"bore.{key}", value, "of_another_spline", Nearest(usual), standard=self.standard)
        plain = _plain(self.size, self.standard)
        if self.standard == "ISO 4156":
            return self._iso_4156(plain)
        sizes = _sizes(plain)
        numbers, zones = [number for number, _ in sizes], [zone for _, zone in sizes]
        outer = gost and (self.centring == "outer" or any(zones[:1]))
        if outer and self.root == "fillet":
            raise ParameterError("bore.root", self.root, "centred_by_flat_roots", Nearest("flat"))
        if gost and plain[:1] in ("i", "I"):
            raise ParameterError("bore.size", self.size, "spline_centred_inside")
        if not gost and len(numbers) == 4 and numbers[2] == 30:
            # the pressure angle, which DIN 5480 had before z until 2006
            del numbers[2]
        if (
            len(numbers) != (2 if gost else 3)
            or any(zones[1 if gost else 0 :])
            or not min(numbers) > 0
            or numbers[0] / numbers[1] > _MOST_TEETH
        ):
            raise self._none_such()
        teeth = [z for z in standards.teeth_of(numbers[0], numbers[1]) if gost or z == numbers[2]]
        if not teeth or teeth[0] < _LEAST_TEETH:
            raise self._none_such()
        if not gost:
            return self._classed(standards.din_5480(numbers[0], numbers[1], teeth[0]), plain)
        made = standards.gost_6033(numbers[0], numbers[1], teeth[0], outer=outer, root=self.root)
        if zones[0]:
            _check_clearance(self.clearance)
            made = replace(made, fits=(_fit(self, "D", numbers[0], zones[0]),))
        return self._classed(made, plain)

    def _iso_4156(self, plain: str) -> InvoluteJoint:
        from geometry.solids import spline_standards as standards

        found = _ISO.fullmatch(plain)
        root: Literal["flat", "fillet"] = "flat" if found and found[4] in ("P", "p") else "fillet"
        if found is None or (float(found[3]), root) not in standards.ISO_4156 or not float(found[2]) > 0:
            raise self._none_such()
        if not _LEAST_TEETH <= int(found[1]) <= _MOST_TEETH:
            raise self._none_such()
        return self._classed(
            standards.iso_4156(int(found[1]), float(found[2]), float(found[3]), root), plain, found.end(4)
        )

    def _none_such(self) -> ParameterError:
        told = {"standard": self.standard, "example": _EXAMPLES[self.standard]}
        return ParameterError("bore.size", self.size, "no_such_spline", None, **told)

    def _classed(self, joint: InvoluteJoint, plain: str, begin: int = 0) -> InvoluteJoint:
        """A joint with the classes that end its plain designation, that of the hub first; after ``begin`` letters."""
        from geometry.solids.spline_fits import CLASSES, MOST_REFERENCE, UNHELD

        found = _CLASSES.search(plain, begin)
        if found is None:
            return joint
        grades, hubs, shafts = CLASSES[joint.standard]
        unheld = UNHELD.get(joint.standard, ())
        told, before = {"hub_class": "", "shaft_class": ""}, plain[: found.start(1)]
        for one in filter(None, found.groups()):
            letter = one.lstrip("0123456789")
            key = "hub_class" if letter in hubs else "shaft_class"
            if key == "hub_class" and told["shaft_class"]:
                right = f"{one}/{told['shaft_class']}"
                cure = _if_made(self, before + right)
                raise ParameterError("bore.size", self.size, "spline_hub_first", cure, right=right)
            if int(one.removesuffix(letter)) not in grades or letter not in hubs + shafts + unheld or told[key]:
                raise ParameterError(
                    "bore.size", self.size, "no_such_spline_class", least=grades[0], most=grades[-1],
                    hubs=", ".join(hubs), shafts=", ".join(sorted(shafts + unheld)), standard=joint.standard,
                    example=f"{grades[2]}H/{grades[2]}h",
                )  # fmt: skip
            if letter in unheld:
                numbers = {"unheld": one, "standard": joint.standard, "shafts": ", ".join(shafts)}
                raise ParameterError(
                    "bore.size", self.size, "spline_class_unheld", _if_made(self, before[:-1]), **numbers
                )
            told[key] = one
        if joint.standard == "ISO 4156" and 2 * joint.reference_radius > MOST_REFERENCE:
            raise ParameterError("bore.size", self.size, "spline_classes_end", most=MOST_REFERENCE)
        _check_clearance(self.clearance)
        return replace(joint, hub_class=told["hub_class"], shaft_class=told["shaft_class"])

    def bore(self) -> SplineBore:
        """Its slots; refuses as ``joint`` does."""
        return _bored(self, ("bore.size", self.size))


def _bored(table: StraightSplineTable | InvoluteSplineTable, size: tuple[str, object]) -> SplineBore:
    from geometry.solids.splines import SplineBore

    return SplineBore(table.joint(), size, table.clearance, math.radians(table.angle_deg))


SplineTable = StraightSplineTable | InvoluteSplineTable
