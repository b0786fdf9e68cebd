"""The mate ``chain_drive``: two sprockets and the roller chain about them."""

from __future__ import annotations

import cmath
import math
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, field

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.tolerance import PLACED_MM
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing
from parts.keys.base import mm
from parts.keys.mate import Direction, height
from parts.mates.sizes import same_size, same_sizes
from parts.mates.wrapped import Idlers, IdlerTable, Wrapped, check_idlers, gap_away, idler_quantities, idler_wheels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geometry.base.findings import Finding
    from geometry.curves.curve import Complex
    from geometry.gears.chains.drive import ChainMesh
    from geometry.gears.chains.sprocket import Sprocket
    from geometry.gears.mesh.search import PairContact
    from geometry.plane.loop import Loop

# numbers of links that are tried where one is too small
_TRIED = 4096
# links of a chain at most
_MOST_LINKS = 10_000
# links that are too many: two fewer go round as well
_TOO_MANY = 2

_NUMBER_OF_LINKS = Meta(ge=6, le=_MOST_LINKS, description="links of the chain, even at best", examples=[100])
_CENTRE_DISTANCE = mm(
    "centre distance; default: the greatest for number_of_links, with the chain taut", above=0, most=1e6, example=458.0
)


class ChainDriveSpec(MateKeys, tag="chain_drive", kw_only=True):
    """Keys of ``chain_drive``."""

    second: Annotated[str, Meta(description="instance that the chain drives, or that drives it")]
    number_of_links: Annotated[int, _NUMBER_OF_LINKS] | None = None
    centre_distance: Annotated[float, _CENTRE_DISTANCE] | None = None
    idlers: Idlers = field(default_factory=list)
    direction_deg: Direction = 0.0
    height: Annotated[float, height("second above the first; default: the rows of teeth face each other")] | None = None


class ChainMating(Wrapped):
    """Two sprockets of one chain."""

    mesh: ChainMesh

    @property
    def loop(self) -> Loop:
        """About the pitch circles, in pitches."""
        return self.mesh.drive.loop

    def _second(self, rotation: float, direction: float) -> tuple[float, float]:
        """Rotation of the second in the middle of its play, and half of that, rad."""
        play = self.mesh.drive.play(self._seat(rotation, direction), self.mesh.links)
        return direction + play.middle - self.mesh.sprockets[1].pitch_angle / 2, play.half

    def _seat(self, rotation: float, direction: float) -> float:
        return gap_away(rotation, direction, self.mesh.sprockets[0].pitch_angle)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Where its seats take the rollers."""
        return self._second(rotation, direction)[0]

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the second's turn off the middle of its play."""
        spoke = second[0] - first[0]
        direction = cmath.phase(spoke)
        right, play = self._second(first[1], direction)
        sprocket = self.mesh.sprockets[1]
        off = math.remainder(second[1] - right, sprocket.pitch_angle)
        return Standing(abs(spoke), off, play, sprocket.pitch_radius)

    def rollers(self, first: Pose, second: Pose) -> tuple[Complex, float]:
        """Of the chain in the seats of both: the strands are as slack as the second is turned within its play."""
        from geometry.base.record import replace

        direction, one = cmath.phase(second[0] - first[0]), self.mesh.sprockets[0]
        mesh = replace(self.mesh, turn=self.standing(first, second).phase_off)
        places = mesh.rollers(self._seat(first[1], direction))[1]
        return first[0] + places * cmath.rect(1.0, direction), one.chain.roller_diameter / 2

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict of all rollers and the teeth of both over one pitch."""
        from geometry.base.record import replace

        return replace(self.mesh, turn=phase_off, shift=distance_off).contact(tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """An odd number of links, little wrap, a loose chain."""
        return self.mesh.findings()

    def quantities(self) -> dict[str, Any]:
        """Links, distance, ratio, wrap, what the chain is longer than a taut one, and what is between the tips, mm."""
        mesh = self.mesh
        teeth = mesh.teeth
        about = idler_quantities(mesh.drive.loop.idler_wraps, mesh.taut_idler) if mesh.idlers else {}
        return {
            "number_of_links": self.mesh.links,
            "working_centre_distance": self.distance,
            "gear_ratio": teeth[1] / teeth[0],
            "wrap_deg": math.degrees(min(self.mesh.drive.loop.both_wraps)),
            # a taut chain is none but for rounding
            "chain_slack": max(round(self.mesh.slack, 9), 0.0),
            "tip_gap": self.mesh.tip_gap,
            **about,
        }


class ChainDriveKind(MateKind[ChainDriveSpec, "Sprocket", "Sprocket"]):
    """Two sprockets of one chain."""

    name, keys = "chain_drive", ChainDriveSpec
    joins = (("sprocket", "sprocket"),)
    alone = True

    def mating(self, keys: ChainDriveSpec, first: End[Sprocket], second: End[Sprocket]) -> ChainMating:
        """Both take the same chain, which goes round them."""
        one, two = first.thing, second.thing
        same_sizes(("pitch", "roller_diameter"), two.chain, one.chain, "not_of_the_chain")
        same_size("strands", two.strands, one.strands, "not_of_the_chain")
        if one.strands > 1:
            same_sizes(("transverse_pitch",), two.chain, one.chain, "not_of_the_chain")
        mesh = chain_mesh((one, two), keys.number_of_links, keys.centre_distance, keys.idlers)
        return ChainMating(
            *self.joined(keys),
            height=(one.face_width - two.face_width) / 2 if keys.height is None else keys.height,
            distance=mesh.centre_distance,
            module=one.chain.pitch / math.pi,
            teeth=mesh.teeth,
            mesh=mesh,
            unit=mesh.pitch,
        )


def chain_mesh(
    sprockets: tuple[Sprocket, Sprocket],
    links: int | None,
    distance: float | None,
    idlers: Sequence[IdlerTable] = (),
    prefix: str = "mate.",
) -> ChainMesh:
    """The drive of two sprockets by its links, its centre distance (mm), or both; ``prefix``: of their keys.

    With idlers, which stand where they do, by the distance, and the links if they are told.

    Raises
    ------
    ParameterError
        None of both is given, the tips meet, the chain is too short or much too long, or does not come to an idler;
        names the key and what works.
    """
    from geometry.gears.chains.drive import ChainMesh, exact_distance, links_for

    pitch, teeth = sprockets[0].chain.pitch, (sprockets[0].number_of_teeth, sprockets[1].number_of_teeth)
    least = sum(s.tip_radius for s in sprockets) / pitch
    keys = f"{prefix}number_of_links", f"{prefix}centre_distance"
    if links is None and distance is None:
        raise ParameterError(keys[0], None, "one_of_two_is_missing", other="centre_distance")
    if distance is not None and distance <= least * pitch:
        raise ParameterError(keys[1], distance, "sprockets_meet", limit(least * pitch * (1 + 1e-9), distance))
    if idlers:
        return _with_idlers(sprockets, links, distance, idlers, prefix)
    far = exact_distance(teeth, _MOST_LINKS, least)
    if distance is not None and far is not None and distance > far * pitch:
        raise ParameterError(keys[1], distance, "chain_too_short", limit(far * pitch, distance), links=_MOST_LINKS)
    if links is None:
        assert distance is not None
        links = links_for(teeth, (distance - PLACED_MM) / pitch, least)
    found = exact_distance(teeth, links, least)
    if found is None:
        more = (k for k in range(links + 1, links + _TRIED) if k % 2 == 0)
        cure = partial(next, (Nearest(k) for k in more if exact_distance(teeth, k, least)), None)
        raise ParameterError(keys[0], links, "chain_too_short_for_sprockets", cure)
    if distance is None:
        return ChainMesh(sprockets, found * pitch, links)
    # as it is told, with five decimals, a distance may be beyond the taut one
    if distance > found * pitch + PLACED_MM:
        raise ParameterError(
            keys[1], distance, "chain_too_short", limit(found * pitch, distance, digits=6), links=links
        )
    needed = links_for(teeth, (distance - PLACED_MM) / pitch, least)
    if links >= needed + _TOO_MANY:
        raise ParameterError(keys[0], links, "chain_too_long", Nearest(needed), links=needed)
    return ChainMesh(sprockets, min(distance, found * pitch), links)


def _with_idlers(
    sprockets: tuple[Sprocket, Sprocket],
    links: int | None,
    distance: float | None,
    idlers: Sequence[IdlerTable],
    prefix: str,
) -> ChainMesh:
    """The drive about idlers: with so many links as go round there, or two more, or one."""
    from geometry.base.record import replace
    from geometry.gears.chains.drive import ChainMesh, pitch_radius

    chain = sprockets[0].chain
    if distance is None:
        raise ParameterError(f"{prefix}centre_distance", None, "missing_beside_idlers")
    told = idler_wheels(idlers, prefix, lambda teeth: pitch_radius(teeth) * chain.pitch, chain.roller_diameter / 2)
    wheels = tuple(
        replace(w, centre=w.centre / chain.pitch, radius=w.radius / chain.pitch, rim=w.rim / chain.pitch) for w in told
    )
    mesh = ChainMesh(sprockets, distance, 0, idlers=wheels)
    check_idlers(mesh.drive.loop, wheels, idlers, prefix, chain.pitch)
    needed = mesh.drive.longest() - PLACED_MM / chain.pitch
    fewest = 2 * math.ceil(needed / 2)
    if links is not None and not needed <= links < fewest + _TOO_MANY:
        numbers = {"length": round(mesh.drive.longest() * chain.pitch, 3), "links": fewest}
        raise ParameterError(f"{prefix}number_of_links", links, "chain_does_not_fit", Nearest(fewest), **numbers)
    return replace(mesh, links=links or fewest)
