"""The part kind ``noncircular_gear``: teeth on an oval, an ellipse about a focus, or the centrode of a given ratio."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Literal

import msgspec
import numpy as np
from msgspec import Meta, Struct

from geometry.errors import ConvergenceError, GeometryError, ParameterError, at_least, at_most, format_value
from geometry.profile import Profile
from geometry.wheel import WheelShape, check_wheel, wheel_body, wheel_sections
from parts.cutter_keys import RackName
from parts.hole_keys import BoreTable, HolesTable, SpokesTable, hub_holes, with_remedy
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, in_modules, mm
from parts.materials import density_of
from parts.part import Part
from parts.spur_gear import RackTable, basic_rack_of
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, WebTable, as_typed, wheel_shape

if TYPE_CHECKING:
    from geometry.gears.noncircular import NoncircularGear
    from geometry.gears.noncircular_pairing import Centrode

_Amplitude = Annotated[float, Meta(ge=-10, le=10)]
_MOST_TEETH = 2000
_SAMPLES = 1025
_BISECTIONS = 24
_NOT_CLOSED = "the mate closes where it has a whole number of lobes"
# numbers of teeth that are tried for a mate
_OFFERS = 6
# of ellipses that the table of the pitch line still holds (the ratio of axes 20 is at 0.99875)
_MOST_ECCENTRICITY = 0.999


class NoncircularGearSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="noncircular_gear"):
    """Noncircular gear, one of a pair: the keys tell the driver's centrode, ``role`` which of both this part is."""

    centrode: Annotated[
        Literal["oval", "focal_ellipse", "ratio"],
        Meta(description="driver's centrode: oval about its middle, ellipse about a focus, or by its ratio"),
    ]
    number_of_teeth: Annotated[int, Meta(ge=3, le=_MOST_TEETH, description="number of teeth of this gear")]
    module: Annotated[float, mm("module m; or give centre_distance", least=0.01, most=1000)] | None = None
    centre_distance: Annotated[float, mm("of the pair, in place of the module", above=0, most=100_000)] | None = None
    role: Annotated[
        Literal["driver", "mate"], Meta(description="driver: tooth 1 on +x; mate: the gear that rolls on the driver")
    ] = "driver"
    mate_number_of_teeth: (
        Annotated[int, Meta(ge=3, le=_MOST_TEETH, description="of the other gear; default: as many")] | None
    ) = None
    axis_ratio: (
        Annotated[float, Meta(ge=1, le=20, description="oval: long over short radius; ellipse: of its axes")] | None
    ) = None
    eccentricity: (
        Annotated[float, Meta(ge=0, lt=1, description="e of r = p/(1 - e cos n phi), in place of axis_ratio")] | None
    ) = None
    lobes: (
        Annotated[int, Meta(ge=1, le=20, description="lobes n; default: oval 2, else 1; for oval and ratio")] | None
    ) = None
    ratio_cosines: (
        Annotated[
            list[_Amplitude], Meta(max_length=20, description="ratio: a_k of 1 + sum a_k cos k n phi + b_k sin k n phi")
        ]
        | None
    ) = None
    ratio_sines: Annotated[list[_Amplitude], Meta(max_length=20, description="ratio: b_k")] | None = None
    profile_shift_coefficient: Annotated[
        float, in_modules("shift x of the rack's datum line; its mate has -x", least=-1, most=1)
    ] = 0.0
    pressure_angle_deg: Annotated[
        float, Meta(ge=5, le=45, description="pressure angle of the rack", extra={"unit": "degrees"})
    ] = 20.0
    basic_rack: RackName | RackTable = "ISO 53 A"
    circumferential_thinning: Annotated[
        float, mm("thinning of each tooth for backlash, arc of the centrode", least=0, most=1000)
    ] = 0.0
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    spokes: SpokesTable | None = None
    web: WebTable | None = None
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_noncircular_gear(spec: NoncircularGearSpec) -> NoncircularGear:
    """The gear of a part, checked to exist.

    Raises
    ------
    ParameterError
        The gear cannot exist; names the key and the nearest value that works.
    """
    _check_slender(spec)
    try:
        gear = gear_of(spec)
        gear.outline  # noqa: B018
    except ConvergenceError as refusal:
        key = "axis_ratio" if spec.eccentricity is None else "eccentricity"
        text = f"too slender to compute; at most {20 if key == 'axis_ratio' else _MOST_ECCENTRICITY} works"
        raise ParameterError(key, getattr(spec, key), text) from refusal
    except ParameterError as refusal:
        if refusal.allowed.startswith(_NOT_CLOSED):
            raise _with_closing_mate(spec, refusal) from refusal
        if refusal.name not in ("centrode", "undercut", "number_of_teeth", "profile_shift_coefficient"):
            raise
        raise _with_remedy(spec, refusal) from refusal
    try:
        gear.holes.check(gear.root_radius)
    except ParameterError as refusal:
        if spec.bore_diameter > 0 and refusal.name == "bore.diameter":
            text = f"leaves no rim to the roots; at most {at_most(2 * gear.root_radius * (1 - 1e-6), 4)} mm works"
            raise ParameterError("bore_diameter", spec.bore_diameter, text) from refusal
        raise with_remedy(refusal, spec, _holes_fit) from refusal
    try:
        check_wheel(_shape_of(spec), 2 * gear.root_radius, gear.holes)
    except ParameterError as refusal:
        raise as_typed(spec, refusal) from refusal
    return gear


def _check_slender(spec: NoncircularGearSpec) -> None:
    """An ellipse about its focus whose roots reach the axis by far, told before its long table is made.

    Only where twice the teeth would not help: nearer ones are offered more teeth.
    """
    if spec.centrode == "ratio" or (spec.axis_ratio is None) == (spec.eccentricity is None):
        return
    key = "axis_ratio" if spec.eccentricity is None else "eccentricity"
    rack = basic_rack_of(spec.basic_rack, math.radians(spec.pressure_angle_deg))
    depth = rack.dedendum - spec.profile_shift_coefficient
    other = spec.mate_number_of_teeth or spec.number_of_teeth
    teeth = other if spec.role == "mate" else spec.number_of_teeth

    def stands(value: float, number: int) -> bool:
        """Whether the least radius, a (1 - e) of an ellipse of perimeter 4 a E(e), exceeds the dedendum."""
        e = centrode_of(msgspec.structs.replace(spec, **{key: value}), (teeth, other)).eccentricity  # type: ignore[union-attr]
        quarter = np.sqrt(1 - (e * np.sin((np.arange(_SAMPLES) + 0.5) * math.pi / _SAMPLES)) ** 2).mean() * math.pi / 2
        return bool(number * math.pi / (4 * quarter) * (1 - e) > depth)

    asked = getattr(spec, key)
    if (spec.lobes or (2 if spec.centrode == "oval" else 1)) > 1 or stands(asked, 2 * teeth):
        return
    round_one = 1.0 if key == "axis_ratio" else 0.0
    high = round_one + _largest(lambda v: stands(round_one + v, teeth), asked - round_one)
    for step in range(16):
        value = float(at_most(round_one + (high - round_one) * (1 - step / 16), 4))
        if _builds(msgspec.structs.replace(spec, **{key: value})):
            raise ParameterError(key, asked, f"the roots reach the axis; at most {format_value(value)} works")


def gear_of(spec: NoncircularGearSpec) -> NoncircularGear:
    """The gear of a part as its keys say, not checked to exist.

    Raises
    ------
    ParameterError
        Its rack or its pair cannot exist, or two keys exclude each other.
    """
    from geometry.gears.noncircular import NoncircularGear
    from geometry.gears.noncircular_pairing import paired

    _check_keys(spec)
    other = spec.mate_number_of_teeth or spec.number_of_teeth
    mate = spec.role == "mate"
    teeth = (other, spec.number_of_teeth) if mate else (spec.number_of_teeth, other)
    try:
        pairing = paired(centrode_of(spec, teeth), teeth, spec.module, spec.centre_distance)
    except ParameterError as refusal:
        if mate and refusal.name == "mate_number_of_teeth":
            # of the pair it is the mate's
            raise ParameterError("number_of_teeth", refusal.value, refusal.allowed) from refusal
        raise
    return NoncircularGear(
        line=pairing.lines[1 if mate else 0],
        number_of_teeth=spec.number_of_teeth,
        rack=basic_rack_of(spec.basic_rack, math.radians(spec.pressure_angle_deg)),
        first_tooth=0.5 if mate else 0.0,
        profile_shift_coefficient=spec.profile_shift_coefficient,
        circumferential_thinning=spec.circumferential_thinning,
        bore_diameter=spec.bore_diameter,
        hub=hub_holes(spec.bore, spec.holes, spec.spokes),
        pairing=pairing,
    )


def _check_keys(spec: NoncircularGearSpec) -> None:
    """Keys that exclude each other, or need each other."""
    if spec.bore is not None and spec.bore_diameter > 0:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    if (spec.module is None) == (spec.centre_distance is None):
        text = "is missing; give it, or" if spec.module is None else "give either it or"
        raise ParameterError("module", spec.module, f"{text} centre_distance")
    ratio = spec.centrode == "ratio"
    for key in ("axis_ratio", "eccentricity"):
        if ratio and getattr(spec, key) is not None:
            raise ParameterError(key, getattr(spec, key), "is for oval and focal_ellipse; remove it")
    for key in ("ratio_cosines", "ratio_sines"):
        if not ratio and getattr(spec, key):
            raise ParameterError(key, getattr(spec, key), f"is for ratio, not {spec.centrode}; remove it")
    if spec.centrode == "focal_ellipse" and spec.lobes not in (None, 1):
        raise ParameterError("lobes", spec.lobes, 'an ellipse about its focus has one; "oval" takes more')
    if not ratio and (spec.axis_ratio is None) == (spec.eccentricity is None):
        text = "is missing; give it, or eccentricity" if spec.axis_ratio is None else "give either it or eccentricity"
        raise ParameterError("axis_ratio", spec.axis_ratio, text)


def centrode_of(spec: NoncircularGearSpec, teeth: tuple[int, int]) -> Centrode:
    """The driver's centrode, of no particular size.

    Raises
    ------
    ParameterError
        It is concave, which no rack rolls on, or its ratio is not positive.
    """
    from geometry.centrodes import FourierRatio, LobedEllipse, RatioCentrode

    if spec.centrode == "ratio":
        lobes = spec.lobes or 1
        ratio = FourierRatio(teeth[0] / teeth[1], tuple(spec.ratio_cosines or ()), tuple(spec.ratio_sines or ()), lobes)
        if not float(ratio(np.linspace(0, 2 * math.pi, _SAMPLES), 0)[0].min()) > 0:
            raise ParameterError("centrode", spec.centrode, "the ratio is not positive all round")
        return RatioCentrode(ratio, 1.0)
    lobes = spec.lobes or (2 if spec.centrode == "oval" else 1)
    e = spec.eccentricity
    if e is None:
        q = float(spec.axis_ratio or 1.0)
        e = math.sqrt(1 - 1 / q**2) if spec.centrode == "focal_ellipse" else (q - 1) / (q + 1)
    most = 1 / (lobes**2 - 1) if lobes > 1 else 1.0
    if e > most * (1 + 1e-12):
        text = "the centrode is concave, and no rack rolls on it"
        if spec.axis_ratio is not None:
            limit = at_most((1 + most) / (1 - most))
            raise ParameterError("axis_ratio", spec.axis_ratio, f"{text}; at most {limit} works")
        raise ParameterError("eccentricity", e, f"{text}; at most {at_most(most)} works")
    return LobedEllipse(1.0, min(e, most), lobes)


def _with_remedy(spec: NoncircularGearSpec, refusal: ParameterError) -> ParameterError:
    """A refused gear in the key to change: amplitudes of a concave ratio, thinning, or the number of teeth."""
    if "works" in refusal.allowed:
        return refusal
    reason = refusal.allowed
    if spec.centrode == "ratio" and refusal.name == "centrode":
        share = _largest(lambda v: _builds(_with_amplitudes(spec, v)), 1.0)
        key = "ratio_cosines" if spec.ratio_cosines else "ratio_sines"
        smaller = _with_amplitudes(spec, math.floor(share * 1e4) / 1e4)
        if spec.ratio_cosines and spec.ratio_sines:
            # both lists shrink together
            lists = ", ".join(f"{k} = {_listed(getattr(smaller, k))}" for k in ("ratio_cosines", "ratio_sines"))
            return ParameterError(key, getattr(spec, key), f"{reason}; with {lists} it works")
        return ParameterError(key, getattr(spec, key), f"{reason}; {_listed(getattr(smaller, key))} works")
    if spec.circumferential_thinning > 0 and _builds(msgspec.structs.replace(spec, circumferential_thinning=0.0)):
        most = _largest(
            lambda v: _builds(msgspec.structs.replace(spec, circumferential_thinning=v)), spec.circumferential_thinning
        )
        text = f"{reason}; at most {at_most(most, 4)} mm works"
        return ParameterError("circumferential_thinning", spec.circumferential_thinning, text)
    if spec.profile_shift_coefficient and _builds(msgspec.structs.replace(spec, profile_shift_coefficient=0.0)):
        x = spec.profile_shift_coefficient
        most = _largest(lambda v: _builds(msgspec.structs.replace(spec, profile_shift_coefficient=v)), x)
        told = f"at most {at_most(most, 4)}" if x > 0 else f"at least {at_least(most, 4)}"
        return ParameterError("profile_shift_coefficient", x, f"{reason}; {told} works")
    z = spec.number_of_teeth
    other = spec.mate_number_of_teeth or z
    for times in range(2, 40):
        more = _teeth(spec, math.ceil(z * (1 + times / 8)), other / z)
        if more is not None and _builds(more):
            text = f"{reason}; {more.number_of_teeth} teeth of the same centrode work"
            if spec.mate_number_of_teeth is not None:
                text += f" with mate_number_of_teeth = {more.mate_number_of_teeth}"
            return ParameterError("number_of_teeth", z, text)
    return ParameterError("number_of_teeth", z, f"{reason}; a rounder centrode works")


def _listed(values: list[float]) -> str:
    return f"[{', '.join(f'{v:.9g}' for v in values)}]"


def _with_closing_mate(spec: NoncircularGearSpec, refusal: ParameterError) -> ParameterError:
    """A mate that does not close: the nearest number of teeth with which it does, and both gears can be cut."""
    mate = spec.role == "mate"
    other = spec.mate_number_of_teeth or spec.number_of_teeth
    asked, driver = (spec.number_of_teeth, other) if mate else (other, spec.number_of_teeth)
    lobes = spec.lobes or (2 if spec.centrode == "oval" else 1)
    step = driver // math.gcd(driver, lobes)
    offers = sorted((k * step for k in range(1, _MOST_TEETH // step + 1)), key=lambda z: abs(z - asked))
    for teeth in (z for z in offers[:_OFFERS] if z >= 3):
        pair = (("driver", driver, teeth), ("mate", teeth, driver))
        keys = ({"role": r, "number_of_teeth": a, "mate_number_of_teeth": b} for r, a, b in pair)
        # a shift of one gear is the other's with its sign turned
        signs = (-1 if mate else 1, 1 if mate else -1)
        shifts = (sign * spec.profile_shift_coefficient for sign in signs)
        if all(
            _builds(msgspec.structs.replace(spec, **k, profile_shift_coefficient=x))
            for k, x in zip(keys, shifts, strict=True)
        ):
            return ParameterError(refusal.name, refusal.value, f"{_NOT_CLOSED}; {teeth} works")
    return ParameterError(refusal.name, refusal.value, f"{_NOT_CLOSED}; a rounder centrode has one")


def _teeth(spec: NoncircularGearSpec, teeth: int, ratio: float) -> NoncircularGearSpec | None:
    """The same gear with more teeth, its mate's in proportion, and of the same kind for two equal ones."""
    if spec.mate_number_of_teeth is None:
        lobes = spec.lobes or (2 if spec.centrode == "oval" else 1)
        fitting = lobes * (2 * math.ceil((teeth / lobes - 1) / 2) + 1)
        return msgspec.structs.replace(spec, number_of_teeth=min(fitting, _MOST_TEETH))
    step = spec.number_of_teeth // math.gcd(spec.number_of_teeth, spec.mate_number_of_teeth)
    teeth = math.ceil(teeth / step) * step
    mate = round(teeth * ratio)
    if max(teeth, mate) > _MOST_TEETH:
        return None
    return msgspec.structs.replace(spec, number_of_teeth=teeth, mate_number_of_teeth=mate)


def _with_amplitudes(spec: NoncircularGearSpec, share: float) -> NoncircularGearSpec:
    return msgspec.structs.replace(
        spec,
        ratio_cosines=[share * x for x in spec.ratio_cosines or ()],
        ratio_sines=[share * x for x in spec.ratio_sines or ()],
    )


def _largest(works: object, refused: float) -> float:
    """The value between 0, which is hoped to work, and a refused one that still works."""
    low, high = 0.0, refused
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if works(middle) else (low, middle)  # type: ignore[operator]
    return low


def _builds(spec: NoncircularGearSpec) -> bool:
    try:
        gear_of(spec).outline  # noqa: B018
    except GeometryError:
        return False
    return True


def _holes_fit(spec: NoncircularGearSpec) -> bool:
    try:
        gear = gear_of(spec)
    except GeometryError:
        return False
    return gear.holes.fits(gear.root_radius)


def _shape_of(spec: NoncircularGearSpec) -> WheelShape:
    return wheel_shape(spec.face_width, spec.web, spec.hub, spec.face_chamfer)


def noncircular_gear_part(part_id: str, spec: NoncircularGearSpec, gear: NoncircularGear) -> Part:
    """The part of a gear, whose teeth a mate may have thinned; sections are computed when an export asks."""
    from geometry.gears.noncircular_offset import findings_of, moved_outline, noncircular_region

    shape = _shape_of(spec)
    section = lru_cache(maxsize=8)(lambda offset: noncircular_region(gear, offset))

    def outline(offset: float, depth: float) -> Profile:
        return section(offset).region.outer if depth == 0 else moved_outline(gear, offset - depth)

    sections = wheel_sections(outline, gear.root_radius, gear.holes)
    return Part(
        part_id,
        "noncircular_gear",
        section,
        lru_cache(maxsize=2)(lambda offset: wheel_body(shape, sections, offset)),
        spec.face_width,
        shape.is_plate,
        findings_of(gear),
        {"inner_root_diameter": 2 * gear.root_radius, "outer_tip_diameter": 2 * gear.tip_radius},
        _quantities(gear),
        spec.material,
        spec.colour,
        spec.density or density_of(spec.material),
    )


def _quantities(gear: NoncircularGear) -> dict[str, float]:
    least, greatest = gear.radii
    pairing = gear.pairing
    found = {
        "module": gear.module,
        "pitch": gear.pitch,
        "centrode_perimeter": gear.line.length,
        "least_centrode_radius": least,
        "greatest_centrode_radius": greatest,
        "least_curvature_radius_of_centrode": 1 / gear.curvatures[1],
        "tip_tooth_thickness": gear.outline.tip_thickness,
    }
    return found if pairing is None else {"centre_distance_of_pair": pairing.centre_distance, **found}
