"""The motion of a scene as an animated glTF of its solids, and the file held against exact solids and poses."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from exporters.formats.glb import SolidTrack, write_glb
from exporters.formats.motion_svg import even_way
from exporters.formats.read_glb import read_glb
from exporters.formats.svg import fills
from exporters.production.film import MOST_VALUES, SHARE, TIMES, Film
from exporters.production.jobs import Job, Made
from exporters.verification.judge import held
from exporters.verification.verdict import Verdict, of_readable
from geometry.base.placement import Placement3
from geometry.base.record import replace
from geometry.curves.curve import Real
from parts.base.texts import fault, fault_of, unless
from parts.scene.formats import file_kind
from parts.scene.standing import Instance
from parts.solids.mesh import body_mesh

# of a turn between two values: the shorter way round is the right one
_STEP = 2 * math.pi / 3
# float32: of a number, and of a turn by its quaternion
_FLOAT32, _TURNED = 2.0**-24, 2.0**-22


class SolidFilm(Film):
    """The animated glTF of a scene."""

    ending = "", ".glb"

    @property
    def members(self) -> tuple[Job, ...]:
        """The mesh of each part."""
        asked = replace(self.export, format="stl", purpose="print", tolerance=SHARE * self.tolerance)
        return tuple(Job(p, asked, p.section(0.0), self.path, self.place, SHARE) for p in self.parts.values())

    def reach(self, instance: Instance) -> float:
        """How far a solid reaches from its origin, mm."""
        body = self.parts[instance.part].body(0.0)
        return math.hypot(body.section_reach(), *map(abs, (body.levels()[0], body.levels()[-1])))

    def tracks(self) -> tuple[list[SolidTrack], float]:
        """What moves how, and how far it is off its way, mm."""
        made, worst = [], 0.0
        for instance in self.instances:
            reach = self.reach(instance)
            if instance.id in self.course.in_space:
                track, off = self._in_space(instance, reach)
                made.append(track)
                worst = max(worst, off)
                continue
            shares, places, angles, off = self.ways(instance, reach)
            when, turned = even_way(shares, angles + 0j)
            if len(turned) == 2:
                # values of an even turn stand near enough for the shorter way round to be the right one
                when = np.linspace(0, 1, 1 + max(1, math.ceil(abs(turned[1] - turned[0]) / _STEP)))
                turned = turned[0] + (turned[1] - turned[0]) * when
            at, way = even_way(shares, places)
            heights = np.full(len(way), instance.at[2])
            turns = np.array([_quaternion(instance.axis, angle) for angle in turned.real.tolist()])
            laid = np.column_stack([way.real, way.imag, heights])
            made.append(SolidTrack(instance.id, instance.part, (at, laid), (when, turns)))
            # numbers, and the times of what moves, have 24 bits
            far = float(np.abs(places).max()) + abs(instance.at[2])
            rate = ((np.abs(np.diff(places)) + reach * np.abs(np.diff(angles))) / np.diff(shares)).max()
            worst = max(worst, off + 2 * _FLOAT32 * (far + float(rate)) + _TURNED * reach)
        return made, worst

    def _in_space(self, instance: Instance, reach: float) -> tuple[SolidTrack, float]:
        """The track of what lies and goes round, and how far it is off its way between its values, mm."""

        def at(shares: Real) -> tuple[tuple[Real, Real], Real]:
            turned, places = self.frames(instance, shares)
            turns = _quaternions(turned)
            # between two values a viewer takes the shorter way round, evenly: half way it is their sum
            middle = turns[:-1:2] + turns[2::2]
            middle /= np.linalg.norm(middle, axis=1)[:, None]
            angles = 2 * np.arccos(np.clip(np.abs(np.einsum("nj,nj->n", middle, turns[1::2])), 0.0, 1.0))
            aside = np.linalg.norm(places[1::2] - (places[:-1:2] + places[2::2]) / 2, axis=1)
            return (places[::2], turns[::2]), aside + reach * angles

        shares, (places, turns), off = self.near_enough(at, MOST_VALUES)
        rate = ((np.abs(np.diff(places, axis=0)).sum(axis=1) + reach * _angles(turns)) / np.diff(shares)).max()
        far = float(np.abs(places).max())
        track = SolidTrack(instance.id, instance.part, (shares, places), (shares, turns))
        return track, off + 2 * _FLOAT32 * (far + float(rate)) + _TURNED * reach

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write it; counts of what is in it."""
        colours = fills(self.parts)
        solids = {m.part.id: (body_mesh(m.body, m.chords(made)), colours[m.part.id]) for m in self.members}
        write_glb(file, self.title, solids, self.tracks()[0], self.seconds)
        return {"instances": len(self.instances), "triangles": sum(len(m.triangles) for m, _ in solids.values())}

    def declared(self, made: Made) -> tuple[float, str]:
        """The worst solid and the worst way together, mm; ways are sampled."""
        return max(m.declared(made)[0] for m in self.members) + self.tracks()[1], "sampled"

    @of_readable
    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back: every solid, and where instances stand at many times, against exact ones."""
        found = read_glb(file)
        if list(found.tracks) != [i.id for i in self.instances] or list(found.solids) != list(self.parts):
            held_of = fault(
                "holds {tracks} of {solids}", tracks=", ".join(found.tracks), solids=", ".join(found.solids)
            )
            return Verdict({}, (held_of,))
        failures = self.late(found.seconds)
        solid = 0.0
        for name, part in self.parts.items():
            verdict = held(found.solids[name], file_kind("stl", None), part.body(0.0), declared, self.tolerance)
            failures += [fault_of(name, text) for text in verdict.failures]
            solid = max(solid, verdict.measured.get("max_deviation", 0.0))
        worst = 0.0
        for instance in self.instances:
            track = found.tracks[instance.id]
            right = track.solid == instance.part
            failures += unless(right, "{id} is shown as {solid}", id=instance.id, solid=track.solid)
            probes = np.vstack([np.zeros(3), self.reach(instance) * np.eye(3)])
            # every value that the file has, too
            values = np.concatenate([way[0] for way in (track.places, track.turns)])
            times = np.unique(np.concatenate([TIMES * self.seconds, np.minimum(values, self.seconds)]))
            exact = self._stands(instance, times / self.seconds, probes)
            worst = max(worst, float(np.abs(track.stand(times, probes) - exact).max()))
        failures += self.off_place(worst, solid, declared)
        measured = {"max_deviation": solid, "pose_deviation": worst, "loop_seconds": found.seconds}
        return Verdict(measured, tuple(failures))

    def _stands(self, instance: Instance, shares: Real, probes: Real) -> Real:
        """Points of an instance (n, 3) where it is at shares (t,) of the loop, (t, n, 3)."""
        if instance.id in self.course.in_space:
            frames, there = self.frames(instance, shares)
            return np.asarray(np.einsum("tij,nj->tni", frames, probes) + there[:, None])
        places, angles = self.poses(instance, shares)
        laid = np.array(Placement3.towards(instance.axis, 0.0).rotation)
        turned = np.stack([np.cos(angles), -np.sin(angles), np.sin(angles), np.cos(angles)], axis=-1).reshape(-1, 2, 2)
        heights = np.broadcast_to(probes[None, :, 2:], (len(shares), len(probes), 1))
        own = np.concatenate([np.einsum("tij,nj->tni", turned, probes[:, :2]), heights], axis=-1)
        at = np.column_stack([places.real, places.imag, np.full(len(shares), instance.at[2])])
        return np.asarray(own @ laid.T + at[:, None])


def _quaternions(turned: Real) -> Real:
    """(n, 4), x y z w, of turns (n, 3, 3), each as near to the one before it as it can be."""
    # four times the products of its parts with each other
    a, b, c = (turned[:, k] for k in range(3))
    xx, yy, zz = a[:, 0], b[:, 1], c[:, 2]
    xy, xz, yz = b[:, 0] + a[:, 1], a[:, 2] + c[:, 0], c[:, 1] + b[:, 2]
    xw, yw, zw = c[:, 1] - b[:, 2], a[:, 2] - c[:, 0], b[:, 0] - a[:, 1]
    rows = np.stack([
        np.stack([1 + xx - yy - zz, xy, xz, xw], axis=-1), np.stack([xy, 1 - xx + yy - zz, yz, yw], axis=-1),
        np.stack([xz, yz, 1 - xx - yy + zz, zw], axis=-1), np.stack([xw, yw, zw, 1 + xx + yy + zz], axis=-1),
    ], axis=1)  # fmt: skip
    # the row of the greatest part is told best
    found = rows[np.arange(len(rows)), np.einsum("nkk->nk", rows).argmax(axis=1)]
    found /= np.linalg.norm(found, axis=1)[:, None]
    flips = np.where(np.einsum("nj,nj->n", found[1:], found[:-1]) < 0, -1.0, 1.0)
    return np.asarray(found * np.cumprod([1.0, *flips])[:, None])


def _angles(turns: Real) -> Real:
    """By how much each quaternion is turned from the one before it, rad."""
    return np.asarray(2 * np.arccos(np.clip(np.abs(np.einsum("nj,nj->n", turns[1:], turns[:-1])), 0.0, 1.0)))


def _quaternion(axis: tuple[float, float, float], angle: float) -> list[float]:
    """Turned about z, then z laid on an axis by the shortest way, as ``Placement3.towards`` has it."""
    x, y, z = axis
    # half way between z and the axis; what points down is turned over about x
    laid = np.array([-y, x, 1 + z]) if z > -1 else np.array([1.0, 0.0, 0.0])
    a, b, d = (laid / np.linalg.norm(laid)).tolist()
    r, s = math.sin(angle / 2), math.cos(angle / 2)
    # (a, b, 0, d) after (0, 0, r, s)
    return [a * s + b * r, b * s - a * r, d * r, d * s]
