"""The part kind ``sprocket``: a wheel for a roller chain, with the teeth of ISO 606, GOST 591-69 or ANSI B29.1."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal, Protocol

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import replace
from geometry.solids.wheel import Rim, check_wheel
from parts.base.kind import Others, Report, diameters
from parts.keys.accuracy import AccuracyKey
from parts.keys.base import MOST_LENGTH, check_idle, either, in_vain, mm, start
from parts.keys.holes import holes_of, spoked
from parts.keys.pins import MARGIN, check_holes, most_of
from parts.keys.wheel import WheelKeys, WheelKind

if TYPE_CHECKING:
    from geometry.gears.chains.chain import Chain
    from geometry.gears.chains.sprocket import IsoForm, SeatedForm, Sprocket
    from geometry.gears.teeth.tooth import ToothSide
    from parts.base.readback import Probe

# sizes of a chain that is told by its designation or by these
_SIZES = ("pitch", "roller_diameter", "inner_width", "plate_height", "transverse_pitch", "strands")
_Length = float | None
# of the pitch: flatter bevels are so near to the faces that the last digits of heights in files move their edges
_LEAST_BEVEL = 0.01

_CHAIN = Meta(
    description="designation of ISO 606 (08B-1, 16A-2, 081), ANSI (ANSI 40, 60-2), of motorcycles (428) or of "
    "GOST 13568 (PR-12.7-18.2), or give pitch"
)
_ROLLER_DIAMETER = mm("diameter of its rollers, or of bushes without them", above=0, most=1000, example=8.51)
_INNER_WIDTH = mm("width between its inner plates", above=0, most=1000, example=7.75)
_TRANSVERSE_PITCH = mm("from strand to strand of it", above=0, most=1000, example=13.92)
_TIP_DIAMETER = mm(
    "tip diameter; default: midway between the limits of ISO 606, or that of GOST 591 or ANSI B29.1",
    above=0,
    most=2 * MOST_LENGTH,
    example=74.0,
)
ToothForm = Literal["ISO 606", "GOST 591", "ANSI B29.1"]
_TOOTH_FORM = Meta(description="standard of the tooth form")
_FORM = Meta(ge=0, le=1, description="ISO 606: 0 is the minimum tooth gap, 1 the maximum one")
_TOOTH_BEVEL = mm("bevel of the teeth at both faces, along the axis at their tips; ISO 606: 0.13 p", least=0, most=1000)
_FACE_WIDTH = mm("of a row of teeth; 0: by the inner width of the chain", least=0, most=10_000)


class SprocketSpec(WheelKeys, kw_only=True, tag_field="kind", tag="sprocket"):
    """Keys of ``sprocket``."""

    number_of_teeth: Annotated[int, Meta(ge=6, le=200, description="number of teeth z", examples=[17])]
    chain: Annotated[str, _CHAIN, start("08B-1")] | None = None
    pitch: Annotated[float, mm("pitch of a chain of your own", above=0, most=1000, example=12.7)] | None = None
    roller_diameter: Annotated[float, _ROLLER_DIAMETER] | None = None
    inner_width: Annotated[float, _INNER_WIDTH] | None = None
    plate_height: Annotated[float, mm("height of its plates", above=0, most=1000, example=11.81)] | None = None
    transverse_pitch: Annotated[float, _TRANSVERSE_PITCH] | None = None
    strands: Annotated[int, Meta(ge=1, le=3, description="strands of it: rows of teeth", examples=[1])] | None = None
    tooth_form: Annotated[ToothForm, _TOOTH_FORM] = "ISO 606"
    form: Annotated[float, _FORM] = 0.0
    displaced: Annotated[bool, Meta(description="GOST 591: with displaced centres of the seats, e = 0.03 t")] = False
    tip_diameter: Annotated[float, _TIP_DIAMETER] | None = None
    tooth_bevel: Annotated[float, _TOOTH_BEVEL] = 0.0
    face_width: Annotated[float, _FACE_WIDTH] = 0.0
    accuracy: AccuracyKey = None


class Gapped(Protocol):
    """Keys that tell the form of the gaps."""

    tooth_form: ToothForm
    form: float
    displaced: bool


def _idle(keys: Gapped) -> Iterator[ParameterError]:
    """What is of another standard's form."""
    for name, standard in (("form", "ISO 606"), ("displaced", "GOST 591")):
        if keys.tooth_form != standard:
            yield from in_vain(keys, (name,), "of_another_tooth_form", form=keys.tooth_form)


def tooth_gap(keys: Gapped) -> IsoForm | SeatedForm:
    """The form of the gaps by a standard; refused where it has no such form or displaced seats."""
    from geometry.gears.chains.sprocket import AnsiForm, GostForm, IsoForm

    check_idle(_idle(keys))
    forms: dict[str, IsoForm | SeatedForm]
    forms = {"ISO 606": IsoForm(keys.form), "GOST 591": GostForm(keys.displaced), "ANSI B29.1": AnsiForm()}
    return forms[keys.tooth_form]


class SprocketKind(WheelKind[SprocketSpec, "Sprocket"]):
    """A sprocket for a roller chain."""

    name, keys = "sprocket", SprocketSpec
    drawing = data_table = "parts.chains.drawing"

    def idle(self, keys: SprocketSpec, others: Others) -> Iterator[ParameterError]:
        """What is of another standard's form."""
        return _idle(keys)

    def thing(self, keys: SprocketSpec, others: Others) -> Sprocket:
        """The sprocket, checked to have teeth that enter the chain, and holes within them."""
        from geometry.gears.chains.sprocket import Sprocket, checked_sprocket

        chain, gap = chain_of_keys(keys), tooth_gap(keys)
        sprocket = checked_sprocket(Sprocket(keys.number_of_teeth, chain, gap, keys.tip_diameter))
        sprocket = replace(sprocket, face_width=_face_width(keys, sprocket))
        if keys.tooth_bevel > (most := 0.5 * sprocket.face_width * (1 - MARGIN) if keys.tooth_bevel else 0.0):
            raise ParameterError("tooth_bevel", keys.tooth_bevel, "chamfers_meet", most_of(most, keys.tooth_bevel))
        if 0 < keys.tooth_bevel < (least := _LEAST_BEVEL * chain.pitch):
            raise ParameterError("tooth_bevel", keys.tooth_bevel, "bevel_of_no_height", limit(least, keys.tooth_bevel))
        sprocket = replace(sprocket, bevel=keys.tooth_bevel)
        if self.rim(sprocket) is not None and keys.face_chamfer:
            raise ParameterError("face_chamfer", None, "of_plain_teeth", Nearest(None))
        if chain.strands > 1:
            _check_rows(sprocket)
        core = sprocket.core_radius
        keys = spoked(keys, core)
        holes = holes_of(keys)
        check_holes(keys, holes, core)
        check_wheel(self.shape(keys, sprocket), 2 * core, holes)
        return replace(sprocket, holes=holes)

    def side(self, thing: Sprocket, offset: float) -> ToothSide:
        """Of its teeth."""
        from geometry.gears.chains.sprocket import sprocket_side

        return sprocket_side(thing, offset)

    def core(self, keys: SprocketSpec, thing: Sprocket) -> float:
        """Of the round body within all teeth, mm."""
        return thing.core_radius

    def rim(self, thing: Sprocket) -> Rim | None:
        """Rows of teeth, or bevelled ones."""
        if thing.strands == 1 and not thing.bevel:
            return None
        from geometry.gears.chains.rows import rows_of_teeth

        return partial(rows_of_teeth, thing)

    def height(self, keys: SprocketSpec, thing: Sprocket) -> float:
        """Width of all rows, mm."""
        return thing.total_width

    def numbers(self, keys: SprocketSpec) -> str:
        """Teeth, and the chain."""
        pitch = f"p\u00a0{keys.pitch:.6g}" if keys.pitch else keys.chain
        return f"{super().numbers(keys)} {pitch}"

    def report(self, keys: SprocketSpec, thing: Sprocket) -> Report:
        """Diameters, the measurement over pins, and what is poor."""
        from geometry.base.findings import Finding
        from geometry.gears.chains.sprocket import sprocket_findings

        circles = diameters(thing, "tip", "pitch", "root")
        quantities = {
            "pitch": thing.chain.pitch,
            "roller_diameter": thing.chain.roller_diameter,
            "tooth_row_width": thing.face_width,
            "tip_tooth_thickness": thing.tip_thickness,
            "sprocket_over_pins": thing.over_pins,
        }
        found, room = sprocket_findings(thing), thing.plate_room
        if room:
            quantities["plate_room_diameter"] = room
        if keys.hub is not None and 0 < room < keys.hub.diameter:
            found += (Finding("hub_in_way_of_plates", keys.hub.diameter, room),)
        return Report(found, circles, quantities)

    def probes(self, keys: SprocketSpec, thing: Sprocket) -> tuple[Probe, ...]:
        """Rollers sit in every gap."""
        from parts.chains.probe import RollerProbe

        return (RollerProbe(thing, thing.face_width / 2),)


SPROCKET = SprocketKind()


def chain_of_keys(keys: SprocketSpec) -> Chain:
    """The chain of the keys, by its designation or by its sizes.

    Raises
    ------
    ParameterError
        No such chain, one that is told twice, or a size that is missing.
    """
    from geometry.gears.chains.chain import Chain, chain_of, like_chain

    if keys.chain is not None:
        for key in _SIZES:
            if (value := getattr(keys, key)) is not None:
                raise either(key, value, "chain")
        found = chain_of(keys.chain)
        if found is None:
            like = like_chain(keys.chain)
            raise ParameterError("chain", keys.chain, "no_such_chain", Nearest(like, "meant") if like else None)
        return found
    for key in ("pitch", "roller_diameter"):
        if getattr(keys, key) is None:
            raise ParameterError(key, None, "one_of_two_is_missing", other="chain")
    pitch, roller = keys.pitch or 0.0, keys.roller_diameter or 0.0
    sizes = keys.inner_width or 0.0, keys.plate_height or 0.0, keys.transverse_pitch or 0.0
    return Chain(pitch, roller, *sizes, strands=keys.strands or 1)


def _face_width(keys: SprocketSpec, sprocket: Sprocket) -> float:
    """Width of a row of teeth, which enters the chain, mm."""
    from geometry.gears.chains.sprocket import face_width

    inner = sprocket.chain.inner_width
    if keys.face_width == 0:
        if not inner:
            raise ParameterError("inner_width", None, "one_of_two_is_missing", other="face_width")
        width = face_width(sprocket.chain, sprocket.form)
        if not width > 0:
            raise ParameterError("inner_width", inner, "leaves_no_tooth_between_plates")
        return width
    if inner and keys.face_width >= inner:
        raise ParameterError(
            "face_width", keys.face_width, "wider_than_chain", most_of(inner, keys.face_width), width=inner
        )
    return keys.face_width


def _check_rows(sprocket: Sprocket) -> None:
    """Rows of teeth stand apart, and their chain's plates go between them."""
    chain = sprocket.chain
    for key in ("transverse_pitch", "plate_height"):
        if not getattr(chain, key):
            raise ParameterError(key, None, "needed_for_strands", strands=chain.strands)
    if sprocket.face_width >= chain.transverse_pitch:
        most, apart = most_of(chain.transverse_pitch, sprocket.face_width), chain.transverse_pitch
        raise ParameterError("face_width", sprocket.face_width, "wider_than_strands", most, width=apart)
    if not sprocket.core_radius > 0:
        raise ParameterError("plate_height", chain.plate_height, "leaves_no_core")
