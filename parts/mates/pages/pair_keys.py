"""What a calculation of a pair is given, as the keys of its two bodies and of what is wanted of both."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, TypeVar

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.gears.pairs.common_face import CommonFace
from geometry.gears.teeth.helix import Helix
from parts.base.counted_over import counted_over
from parts.base.fields import fields_of
from parts.base.mate import End, MateKeys, Mating
from parts.base.refusal import SceneError, meant
from parts.gears.spur_gear.part import RackTable
from parts.keys.base import in_modules, mm
from parts.keys.cutter import PressureAngle, RackName
from parts.keys.helix import Double, HelixAngle
from parts.mates.pairing import mated
from parts.pages.inputs import GEARS, PLACE, keys_of

M = TypeVar("M", bound=MateKeys)
# the second body of each kind of pair that it tells
_SECOND = {"external_gear_pair": "spur_gear", "internal_gear_pair": "ring_gear", "rack_pair": "rack"}

ShortenedTips = Annotated[bool, Meta(description="tips off the mate's fillet, as a scene has them")]
_FACE_WIDTH = mm("helical: common face width, for the overlap ratio; 0 is none of it", least=0, most=10_000)
_LEAST_CONTACT_RATIO = Meta(ge=0.5, le=3, description="contact ratio to keep, of helical teeth the total one")


class ChoiceKeys(Struct, forbid_unknown_fields=True, kw_only=True):
    """What a choice of shifts is asked of any pair of gears."""

    module: Annotated[float, mm("module, for a centre distance", least=0.01, most=1000)] = 1.0
    pressure_angle_deg: PressureAngle = 20.0
    basic_rack: RackName | RackTable = "ISO 53 A"
    helix_angle_deg: HelixAngle = 0.0
    double_helical: Double = False
    face_width: Annotated[float, _FACE_WIDTH] = 0.0
    working_centre_distance: Annotated[float, mm("wanted centre distance", above=0, most=100_000)] | None = None
    least_contact_ratio: Annotated[float, _LEAST_CONTACT_RATIO] = 1.1
    least_tip_thickness: Annotated[float, in_modules("transverse tip thickness to keep", least=0, most=1)] = 0.3
    allow_undercut: Annotated[bool, Meta(description="undercut that stays below the active flank is legal")] = False
    pole_inside: Annotated[bool, Meta(description="the pole must lie inside the active line of action")] = False
    picture: Annotated[str, Meta(description="SVG or DXF file of the contour to write")] | None = None

    @property
    def kept(self) -> tuple[float, float, bool, bool]:
        """What every choice must keep, as ``Requirements`` begin."""
        return self.least_tip_thickness, self.least_contact_ratio, self.allow_undercut, self.pole_inside

    @property
    def face(self) -> CommonFace:
        """The face that both gears have in common.

        Raises
        ------
        ParameterError
            Keys of helical gears, without a helix angle.
        """
        angle = math.radians(abs(self.helix_angle_deg))
        if not angle:
            for name, none in (("double_helical", False), ("face_width", 0.0)):
                if (value := getattr(self, name)) != none:
                    raise ParameterError(name, value, "of_helical_gears_alone", Nearest(none))
        return CommonFace(Helix(angle, double=self.double_helical), self.module, self.face_width)


def mate_of(kind: type[M], keys: Struct) -> M:
    """The mate that the keys of a pair ask for."""
    wishes = {key: getattr(keys, key) for key in keys_of(kind) if key not in GEARS and key in keys_of(type(keys))}
    return kind(first="first", second="second", **wishes)


def pair_mated(mate: MateKeys, first: End[Any], second: End[Any], *, shortened: bool = True) -> Mating:
    """How both bodies of a pair stand to each other, as their mate wants them; ``shortened``: in their tips too."""
    return mated({"first": first, "second": second}, [mate], {name: name for name in GEARS}, shortened=shortened)[1][0]


def section_table(pair: Mapping[str, Any], table: Mapping[str, Any]) -> dict[str, Any]:
    """What the keys of a scene's pair say of its section and face; ``table``: what is typed over them."""
    first = pair["first"]
    known = {k: first[k] for k in ("module", "pressure_angle_deg", "basic_rack", "helix_angle_deg") if k in first}
    if table.get("helix_angle_deg", known.get("helix_angle_deg")):
        known["face_width"] = min(pair[name]["face_width"] for name in GEARS)
        known["double_helical"] = first.get("double_helical", False)
    return known


def kind_of_pair(table: Mapping[str, Any], topic: str, known: Sequence[str]) -> tuple[str, dict[str, Any]]:
    """The kind of a pair, told by ``kind`` or by what its second body is, ``second.kind``; and the other keys.

    Raises
    ------
    SceneError
        A kind that is none of the ``known``.
    """
    rest = {key: value for key, value in table.items() if key != "kind"}
    second = rest.get("second")
    if "kind" in table or not isinstance(second, dict) or "kind" not in second:
        key, kind = f"{topic}.kind", table.get("kind", known[0])
        if kind not in known:
            raise SceneError(PLACE, key, kind, "unknown_pair", meant(kind, known), known=known)
        return kind, rest
    bodies = {_SECOND[kind]: kind for kind in known if kind in _SECOND}
    if (body := second["kind"]) not in bodies:
        raise SceneError(PLACE, f"{topic}.second.kind", body, "not_one_of", meant(body, bodies), known=list(bodies))
    return bodies[body], rest | {"second": {key: value for key, value in second.items() if key != "kind"}}


def merged(under: Mapping[str, Any], over: Mapping[str, Any], pair: type[Struct]) -> dict[str, Any]:
    """Tables laid over each other; a key of the bodies without first. or second. goes to every one that has it."""
    result = {key: dict(value) if isinstance(value, dict) else value for key, value in under.items()}
    owners = {field.name: keys_of(field.type) for field in fields_of(pair) if field.name in GEARS}
    for key, value in over.items():
        having = [name for name, known in owners.items() if key in known]
        if key in GEARS and isinstance(value, dict):
            result[key] = result.get(key, {}) | value
        elif key in keys_of(pair) or not having:
            result[key] = value
        else:
            for name in having:
                mine = over.get(name)
                if not (isinstance(mine, dict) and key in mine):
                    result[name] = {**result.get(name, {}), key: value}
    return result


def pair_table(table: Mapping[str, Any], pair: type[Struct], topic: str) -> dict[str, Any]:
    """What was typed as the keys of both bodies and of the pair.

    Raises
    ------
    SceneError
        A key that neither has, or a body of which nothing is told.
    """
    made, bodies = merged({}, table, pair), [f.type for f in fields_of(pair) if f.name in GEARS]
    known = list(dict.fromkeys([*keys_of(pair), *(key for kind in bodies for key in keys_of(kind)), "kind"]))
    for key in made:
        if key not in keys_of(pair):
            like = counted_over(key, made[key], known, made) or meant(key, known)
            raise SceneError(PLACE, f"{topic}.{key}", made[key], "unknown_key", like, known=known)
    for name, body in zip(GEARS, bodies, strict=True):
        if name not in made:
            raise SceneError(PLACE, f"{topic}.{name}", None, "gear_missing", None, name=name)
        own = made[name] if isinstance(made[name], dict) else {}
        for key in own:
            if key in keys_of(pair) and key not in keys_of(body):
                raise SceneError(PLACE, f"{topic}.{name}.{key}", own[key], "of_the_pair", None, gear=name)
    return made
