"""What a kind of mate has to say, in one place: keys, what it joins, what it wants of both parts, how they then stand.

A kind is an instance of a subclass, registered by one row of ``parts/mates/kinds.psv`` (or by ``add_mate``).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Generic, TypeVar

from msgspec import Meta, Struct

from geometry.base.record import Record, replace
from geometry.gears.pairs.common_face import STRAIGHT, CommonFace
from parts.base.texts import Text

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from geometry.base.findings import Finding
    from geometry.base.placement import Placement3, Vector
    from geometry.curves.curve import Complex
    from geometry.gears.mesh.search import PairContact
    from geometry.gears.pairs.external import ExternalPair
    from geometry.gears.pairs.internal import InternalPair
    from geometry.gears.pairs.rack import RackPair
    from geometry.kinematics.mechanism import Joint, Kind
    from parts.base.part_keys import MaterialKeys

    # turns (..., 3, 3) and places (..., 3), mm, of an instance's frame in the scene
    Frames = tuple[NDArray[np.float64], NDArray[np.float64]]


class MateKeys(Struct, forbid_unknown_fields=True, tag_field="kind", kw_only=True):
    """The two instances that a mate joins: the keys of every mate."""

    first: Annotated[str, Meta(description="instance that is already placed")]
    second: Annotated[str, Meta(description="instance that is placed by this mate")]


K = TypeVar("K", bound=MateKeys)
A = TypeVar("A")
B = TypeVar("B")
# axis (mm) and rotation (rad) of an instance
Pose = tuple[complex, float]


class Standing(Record):
    """How two placed instances stand to each other against what their mate asks for.

    The phase is ``phase_off`` from the middle of the backlash, ``play`` is half of it; both in rad at the arm (mm) of a
    base radius, or in mm along the way of a second that ``slides``.
    """

    distance: float
    phase_off: float
    play: float
    arm: float = 1.0
    slides: bool = False

    def slack(self, allowed: float) -> float:
        """What ``allowed`` mm along the flanks is in the unit of the phase."""
        return allowed / self.arm


class LaidStanding(Record):
    """The same of two whose axes make an ``angle``, rad: how far their apexes, or axes, are ``apart``, mm.

    ``required``: that angle as the mate has it; ``reach``: from the apex to the teeth, mm. ``code``: of the condition
    of how far they are apart, ``distance`` as the mate has it, mm.
    """

    apart: float
    angle: float
    required: float
    phase_off: float
    play: float
    arm: float
    reach: float
    code: str = "apex_distance"
    distance: float = 0.0


class End(Record, Generic[A]):
    """One of the two parts that a mate joins: its keys in the scene and its exact thing."""

    keys: MaterialKeys
    thing: A

    @property
    def kind(self) -> str:
        """Its kind's name."""
        return str(self.keys.__struct_config__.tag)


class Joined(Record):
    """Which mate it is, and the two instances; ``direction_deg``: from the first to the second as the scene has it."""

    kind: str
    first: str
    second: str
    direction_deg: float


class Mating(Joined, kw_only=True):
    """Two instances, the ``second`` placed by the ``first``; what most mates answer stands here.

    ``height``: of the second's lower face above the first's, mm. ``distance``: between the axes, or from the axis to a
    rack's datum line, mm. ``rolls``: as what pair both roll on each other, if they do, with so many ``teeth``;
    ``sense``: -1, 1, 0: as that pair has it.
    """

    height: float = 0.0
    distance: float = 0.0
    rolls: Kind | None = None
    # of which the first's tell too in how many steps a turn of it comes again
    teeth: tuple[int, int] = (1, 1)
    sense: int = 0
    # whether ``contact`` decides how the outlines of two plates stand to each other; else their solids do
    has_contact = False
    # whether ``contact`` decides for solids that are no plates too
    decides_solids = False
    # whether the second stands wherever the first puts it: a follower on its cam
    follows = False
    # and elsewhere after a whole turn of the first than before
    counts_turns = False
    # whether a second that stands already must stand at ``height``
    asks_height = True
    # whether the first may lie on any axis, and the second stand already: ``laid_standing`` holds them together
    lies = False
    # whether ``second_axis`` is told in the frame of the first as it is turned
    turns_axis = False
    # the code where both roll on each other and nothing carries both axes
    without_carrier = "mesh_parts"
    # how the second hangs on the first: "fixed" to it, "turning" about an axis of it; "": it rolls, or ``joints`` tells
    bond = ""

    @property
    def joints(self) -> tuple[Joint, ...]:
        """How both move: joints of the kinematic layer between instances, their places left to the scene."""
        from geometry.kinematics.mechanism import Fixed, Revolute, Rolling

        if self.rolls is not None:
            return (Rolling(self.rolls, self.first, self.second, self.teeth, sense=self.sense),)
        if not self.bond:
            return ()
        return ((Fixed if self.bond == "fixed" else Revolute)(self.second, on=self.first),)

    @property
    def uneven(self) -> bool:
        """Whether the ratio of its joints is only that of whole turns."""
        return False

    @property
    def only_first_drives(self) -> bool:
        """Whether the second of an ``uneven`` pair drives nothing: it is locked, or left, while it stands."""
        return False

    @property
    def asked_turn(self) -> float | None:
        """Turn of the second in the first's frame that a key of the mate asks for, rad; None: no key does."""
        return None

    @property
    def placed_turn(self) -> float | None:
        """Turn that a key of the mate gives a second that it places, rad; None: no key does."""
        return self.asked_turn

    @property
    def holds(self) -> tuple[str, ...]:
        """Instances that stand still by this mate."""
        return ()

    def followed(self, start: Pose, now: Pose) -> Pose:
        """Where a second that ``follows`` stands when the first has moved from its start."""
        return self.second_pose(*now, math.radians(self.direction_deg))

    def partner(self, driver: str, rotation: float, direction: float) -> float:
        """Rotation of the other one of an ``uneven`` pair where the driver stands so, rad, continuous."""
        raise NotImplementedError

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """Axis (mm) and rotation (rad) of the second where the first stands so: at the distance, turned as it must."""
        return centre + cmath.rect(self.distance, direction), self.second_rotation(rotation, direction)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Rotation (rad) of the second where the first stands so, in the middle of any play."""
        raise NotImplementedError

    def second_axis(self, direction: float) -> Vector:
        """Along which the second's z is laid."""
        return 0.0, 0.0, 1.0

    def standing(self, first: Pose, second: Pose) -> Standing | None:
        """How two placed instances stand to each other; None: the mate asks nothing of it, or ``lies``."""
        return None

    def off_place(
        self, first: Pose, second: Pose, direction: float = 0.0, arm: float = 1.0, *, free: bool = False
    ) -> Standing:
        """How far a second that the first carries is from its place, mm (added to the distance), and its turn off it.

        ``free``: any turn of it fits.
        """
        place, turned = self.second_pose(*first, direction)
        off = 0.0 if free else math.remainder(second[1] - turned, math.tau)
        return Standing(self.distance + abs(second[0] - place), off, 0.0, arm)

    def laid_standing(self, first: Placement3, second: Placement3) -> LaidStanding:
        """How two placed instances of what ``lies`` stand to each other."""
        raise NotImplementedError

    def laid(self, first: Placement3, second: Placement3) -> Mating:
        """The mating with what it has of where both of what ``lies`` stand."""
        return self

    def centres_direction(self, offset: complex, stand: Placement3) -> float:
        """Of the line of centres, rad, where the second's frame stands so, its origin that far off the first's."""
        return cmath.phase(offset)

    def rollers(self, first: Pose, second: Pose) -> tuple[Complex, float] | None:
        """Centres of a chain's rollers in order and their radius, mm, where both stand so; None: it has none."""
        return None

    def about(self, first: Pose, second: Pose) -> list[tuple[complex, float]]:
        """Axes and radii, mm, of what such a chain goes about, clockwise in its order, below 0 of what is outside."""
        return []

    def idlers(self, first: Pose, second: Pose) -> list[tuple[complex, float]]:
        """Axes and radii, mm, of what guides such a chain and is no instance."""
        return []

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """Verdict over one pitch or turn, the second that far off its exact place; None: nothing moves here."""
        return None

    def transmission_error(self, distance_off: float) -> dict[str, Any] | None:
        """Peak to peak for both senses of the first's rotation; None of what has no involute teeth."""
        return None

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of both together that are not kept."""
        return ()

    def broken(self, direction: float) -> Mapping[str, dict[str, float]]:
        """What both do not keep in any phase, the second in that direction, rad: codes with their numbers."""
        return {}

    @property
    def stands_in_mesh(self) -> bool:
        """Whether ``driven`` asks for all of the way, and for both as they stand where nothing drives them."""
        return False

    def driven(self, first: Frames, second: Frames) -> tuple[Finding, ...]:
        """What is poor where both stand as drives begin and end, or on their way."""
        return ()

    def blocked(self, first: Frames, second: Frames) -> Mapping[str, dict[str, float]]:
        """Conditions that both do not keep on the way of the drives: codes with their numbers."""
        return {}

    def quantities(self) -> dict[str, Any]:
        """What the calculation says, for reports."""
        return {}


class Touching(Mating, kw_only=True):
    """Two instances that touch. ``module``: the length that tolerances go by, mm. ``normal_backlash``: j_bn, mm."""

    module: float = 1.0
    normal_backlash: float = 0.0
    has_contact: bool = True

    def tolerated(self, share: float, tolerance: float | None) -> float:
        """The gap that counts as contact, mm: as asked, else a share of the length that tolerances go by."""
        return share * self.module if tolerance is None else tolerance


class Toothed(Touching, kw_only=True):
    """Two toothed parts. ``pair``: the calculated pair of involute gears, ``face``: what both have in common."""

    pair: ExternalPair | InternalPair | RackPair | None = None
    face: CommonFace = STRAIGHT

    @property
    def in_scheme(self) -> bool:
        """Whether the scheme of a train shows it: gears of one ratio all round."""
        return self.pair is not None

    def turned_off(
        self, first: Pose, second: Pose, pitch: float, arm: float, backlash: float | None = None
    ) -> Standing:
        """Centre distance, and the second's turn off the middle of the backlash, where it fits at every ``pitch``.

        ``arm``: from the second's axis to the line of action at most, mm; ``backlash`` along that, j_bn by default, mm.
        """
        spoke = second[0] - first[0]
        _, right = self.second_pose(*first, cmath.phase(spoke))
        play = max(self.normal_backlash if backlash is None else backlash, 0.0) / (2 * arm)
        return Standing(abs(spoke), math.remainder(second[1] - right, pitch), play, arm)


# why a tooth is refused alone whose limit is that of its own tip: with what its mates leave of that it goes farther
TIP_ALONE = ("tooth_pointed", "flanks_meet_below_form", "no_involute_below_tip", "fillets_meet")


class MateKind(Generic[K, A, B]):
    """A kind of mate. ``K``: its keys (a msgspec struct, tagged with its name), ``A``, ``B``: things of both parts.

    Refusals are ``ParameterError`` named ``mate.KEY``, or ``first.KEY`` by a key of the first part, else the second's.
    """

    name: str
    keys: type[K]
    # the kinds of parts it joins, first and second in every order that works; None: any
    joins: tuple[tuple[str, str], ...] | None = None
    # whether its gears run in each other on involutes: they have a picture of meshing and a transmission error
    meshes = False
    # whether an instance takes one mate of this kind alone, as a row of teeth takes one chain
    alone = False
    # where it comes from outside: sentences of its own refusals by code, and how a mating of it is told
    reasons: ClassVar[Mapping[str, Text]] = {}
    told: Text = ""

    def check(self, keys: K, first: Struct, second: Struct) -> None:
        """Hold the keys of both parts against each other."""

    def thinning(self, keys: K, first: End[A], second: End[B]) -> tuple[float, float]:
        """Thinning (mm along the reference circle) that it wants of each; the largest of all mates wins."""
        return 0.0, 0.0

    def tips(self, keys: K, first: End[A], second: End[B]) -> tuple[float | None, float | None]:
        """Tip radius (mm) that it wants of each after thinning, none longer; the shortest wins, None: as it is."""
        return None, None

    def shortened(self, thing: Any, radius: float) -> Any:
        """What a part is made from with the tip that ``tips`` asks for."""
        return replace(thing, given_tip_diameter=2 * radius)

    def tip_beside(self, keys: K, part: Struct, other: Struct) -> tuple[float, ...]:
        """Tip diameter (mm) that a part which is pointed alone keeps beside the other one, where it leaves it any."""
        return ()

    def joined(self, keys: K) -> tuple[str, str, str, float]:
        """What a mating of it begins with: its name, both instances, and their direction, where its keys have one."""
        return self.name, keys.first, keys.second, getattr(keys, "direction_deg", 0.0)

    def mating(self, keys: K, first: End[A], second: End[B]) -> Mating:
        """How both stand to each other, with the parts as they are built at last."""
        raise NotImplementedError
