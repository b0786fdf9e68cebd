"""The motion of a scene as an animated SVG, and the file held against exact outlines and poses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from exporters.formats.motion_svg import CORNERS, Track, even_way, write_motion_svg
from exporters.formats.read_motion import ReadTrack, read_motion
from exporters.formats.readback import Loop
from exporters.formats.svg import fills
from exporters.production.film import SHARE, TIMES, Film
from exporters.production.flat_pins import solid_pins
from exporters.production.jobs import Made
from exporters.production.moving_chain import MovingChain, moving_chains
from exporters.production.seen_above import is_round, seen_lying
from exporters.production.turning_silhouette import Ends, ends_of, thinned
from exporters.verification.outlines import verify_loops
from exporters.verification.verdict import Verdict, of_readable
from geometry.approximation.chords import approximate_profile
from geometry.base.placement import Placement3
from geometry.base.record import replace
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Contour
from geometry.plane.profile import Label, Profile, circle
from parts.base.texts import fault, fault_of, unless
from parts.scene.relative_path import Course
from parts.scene.standing import UPWARDS, Instance

# of numbers in the file, mm
_ROUNDING = 2e-6
# mm, half of it for outlines and ways
LEAST_TOLERANCE = 2 * _ROUNDING
# of a direction that stays; mm: what chords of silhouettes leave at most; poses of what changes at most
_LEVEL, _CHORD, _MOST_FORMS = 1e-9, 1e-3, 1920
# of chains
_CHAIN, _IDLER = "#7f8c99", "#c9ced6"


class MotionJob(Film, dict=True):
    """The animated SVG of a scene."""

    ending = ".motion", ".svg"

    @classmethod
    def shows(cls, instance: Instance, course: Course, times: Real) -> bool:
        """Whether what lies keeps its lean."""
        if instance.is_upright and instance.id not in course.in_space:
            return True
        ways = course.placed(instance.id, times, own=instance.id not in course.spins)[0][:, 2, 2]
        return bool(np.abs(ways - ways[0]).max() <= _LEVEL)

    @cached_property
    def _changing(self) -> dict[str, Ends]:
        """What turns on an axis that lies without being round."""
        lying = (i for i in self.instances if i.id in self.course.spins and not i.is_upright)
        return {i.id: ends_of(self.parts[i.part], self._chord) for i in lying if not is_round(self.parts[i.part])}

    @property
    def _chord(self) -> float:
        """What chords of silhouettes may leave, mm."""
        return min(_CHORD, SHARE * self.tolerance / 4)

    @cached_property
    def _shown(self) -> list[Instance]:
        """The instances, the lowest first."""
        return sorted(self.instances, key=lambda i: i.at[2])

    @cached_property
    def _chains(self) -> tuple[MovingChain, ...]:
        """The chains that run in it."""
        return tuple(moving_chains(self.mates, self.course, float(self.loop)))

    @cached_property
    def _idlers(self) -> dict[str, tuple[complex, float]]:
        """Axes and radii, mm, of what guides chains and is no instance, by names that none has."""
        return {
            f"idler.{mate.first.id}.{mate.second.id}.{k}": rim
            for mate in self.mates
            for k, rim in enumerate(mate.idlers(), 1)
        }

    def _forms(self, instance: Instance) -> tuple[Complex, float]:
        """Outlines of what changes at even shares of the loop, and how far they are off, mm."""
        ends = self._changing[instance.id]

        def at(shares: Real) -> tuple[tuple[Real, Complex], Real]:
            turned, _ = self.frames(instance, shares)
            forms = ends.outlines(turned[::2])
            # as one: they stay even
            return (turned[::2], forms), np.full(len(forms) - 1, ends.off_between(turned[1::2], forms))

        _, (turned, forms), off = self.near_enough(at, _MOST_FORMS)
        made = thinned(forms, self._chord)
        return made, off + ends.off_outlines(turned, made) + ends.off + 10.0**-CORNERS

    def poses(self, instance: Instance, shares: Real) -> tuple[Any, Any]:
        """As seen from above; of what is turned over the turn of its mirror image."""
        if instance.is_upright and instance.id not in self.course.in_space:
            places, angles = super().poses(instance, shares)
            return places, -angles if instance.axis[2] < 0 else angles
        if instance.id in self._changing:
            _, places = self.course.placed(instance.id, shares * float(self.loop), own=True)
            return places[:, 0] + 1j * places[:, 1], np.zeros(len(shares))
        own = instance.id not in self.course.spins
        turned, places = self.course.placed(instance.id, shares * float(self.loop), own=own)
        if not instance.is_upright:
            turned = turned @ np.array(self._start(instance).rotation).T
        order = np.argsort(shares)
        angles = np.empty(len(shares))
        angles[order] = np.unwrap(np.arctan2(turned[order, 1, 0], turned[order, 0, 0]))
        return places[:, 0] + 1j * places[:, 1], angles

    def _start(self, instance: Instance) -> Placement3:
        """How an instance is laid at the start, at the origin."""
        return Placement3.towards(instance.axis, math.remainder(instance.rotation, 2 * math.pi))

    @cached_property
    def _profiles(self) -> dict[object, tuple[Profile, ...]]:
        """Exact outlines: of parts as they stand, and of instances that lie as these do."""
        found: dict[object, tuple[Profile, ...]] = {}
        for instance in self.instances:
            part, key = self.parts[instance.part], self._look(instance)
            if key not in found and instance.id not in self._changing:
                found[key] = (
                    part.section(0.0).region.profiles() if instance.is_upright else (self._silhouette(instance)[0],)
                )
        return found

    def _look(self, instance: Instance) -> object:
        """By what its outline is told: its part, and how it lies."""
        if instance.is_upright:
            return instance.part
        return instance.part, instance.axis, instance.rotation, instance.id in self.course.spins

    def _silhouette(self, instance: Instance) -> tuple[Profile, float]:
        spins = instance.id in self.course.spins
        return seen_lying(self.parts[instance.part], instance, self._chord, spins=spins)

    @cached_property
    def tracks(self) -> tuple[list[Track], float]:
        """What moves how, the lowest first, and the greatest deviation, mm."""
        made, worst = [], 0.0
        outlines = {
            look: tuple(approximate_profile(p, SHARE * self.tolerance, arcs=True) for p in profiles)
            for look, profiles in self._profiles.items()
        }
        colours = fills(self.parts)
        for instance in self._shown:
            part = self.parts[instance.part]
            shares, places, angles, off = self.ways(instance, self._reach(instance))
            ways = even_way(shares, places), even_way(shares, angles + 0j)
            colour = colours[part.id]
            if instance.id in self._changing:
                forms, beside = self._forms(instance)
                worst = max(worst, off + beside)
                made.append(Track(instance.id, (), colour, *ways, forms))
                continue
            worst = max(worst, off if instance.is_upright else off + self._silhouette(instance)[1])
            own = outlines[self._look(instance)]
            if instance.is_over:
                own = tuple(replace(o, geometry=_over(o.geometry)) for o in own)
            on = self._on(instance, [o.geometry for o in own])
            made.append(Track(instance.id, own, colour, *ways, pins=on[0], lines=on[1]))
        stays = np.zeros(1), np.zeros(1, complex)
        for name, rim in self._idlers.items():
            own = (approximate_profile(_rim(*rim), SHARE * self.tolerance, arcs=True),)
            made.append(Track(name, own, _IDLER, stays, stays))
        for chain in self._chains:
            seconds = self.seconds / abs(chain.pitches)
            made.append(Track(chain.name, (), _CHAIN, stays, stays, chain.forms, seconds))
        return made, worst + max((x.max_error for row in outlines.values() for x in row), default=0.0)

    def _on(self, instance: Instance, contours: Sequence[Contour]) -> tuple[tuple[Contour, ...], tuple[Contour, ...]]:
        """What stands on an upright part, which its outlines do not show: pins of one piece, and where discs lie."""
        if instance.axis != UPWARDS:
            return (), ()
        part = self.parts[instance.part]
        rings = [np.array(stroke[:-1]) for stroke in part.section(0.0).region.strokes if stroke[0] == stroke[-1]]
        return tuple(solid_pins(part, contours)), tuple(Contour(ring, np.zeros(len(ring))) for ring in rings)

    def _stands_on(self, track: ReadTrack, instance: Instance) -> bool:
        """Whether what a file shows on an outline is all that stands there."""
        pins, lines = self._on(instance, [Contour(loop.vertices, loop.bulges) for loop in track.loops])
        read = [(*pins, *lines), (*track.pins, *track.lines)]
        return [len(pins), len(lines)] == [len(track.pins), len(track.lines)] and all(
            a.vertices.shape == b.vertices.shape
            and float(np.abs(a.vertices - b.vertices).max()) <= _ROUNDING
            and np.array_equal(a.bulges, b.bulges)
            for a, b in zip(*read, strict=True)
        )

    def _reach(self, instance: Instance) -> float:
        if instance.id in self._changing:
            return 0.0
        return max(profile.reach() for profile in self._profiles[self._look(instance)])

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write it; counts of what is in it."""
        tracks, _ = self.tracks
        spans = []
        for track, instance in zip(tracks, self._shown, strict=False):
            places, angles = self.poses(instance, np.linspace(0, 1, 721))
            if not (instance.is_upright or track.forms is not None):
                # its origin may be far from its middle
                corners = track.outlines[0].geometry.vertices
                places = (places[:, None] + 1.03 * corners * np.exp(1j * angles)[:, None]).ravel()
                spans.append([places.real.min(), places.imag.min(), -places.real.max(), -places.imag.max()])
                continue
            seen = [o.geometry.vertices for o in track.outlines] if track.forms is None else [track.forms]
            reach = max(float(np.abs(one).max()) for one in seen) * 1.03
            spans.append([places.real.min() - reach, places.imag.min() - reach, -places.real.max() - reach,
                          -places.imag.max() - reach])  # fmt: skip
        for axis, radius in self._idlers.values():
            spans.append([axis.real - radius, axis.imag - radius, -axis.real - radius, -axis.imag - radius])
        for chain in self._chains:
            x, y = chain.forms.real, chain.forms.imag
            spans.append([x.min(), y.min(), -x.max(), -y.max()])
        left, low, right, high = np.min(spans, axis=0).tolist()
        write_motion_svg(file, self.title, tracks, (left, low, -right, -high), self.seconds)
        values = sum(len(t.places[0]) + len(t.angles[0]) for t in tracks)
        return {"instances": len(self._shown), "values": values}

    def declared(self, made: Made) -> tuple[float, str]:
        """The worst outline and the worst way together, mm; ways are sampled."""
        return self.tracks[1] + _ROUNDING, "sampled"

    @of_readable
    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back: outlines, and where they stand at many times, against exact poses."""
        found = read_motion(file)
        if list(found) != [*(i.id for i in self._shown), *self._idlers, *(chain.name for chain in self._chains)]:
            return Verdict({}, (fault("holds {tracks}", tracks=", ".join(found)),))
        told = {found[i.id].seconds for i in self.instances} - {0.0}
        failures = unless(len(told) <= 1, "instances take unlike times for their loop")
        seconds = max(told, default=0.0)
        failures += self.late(seconds)
        worst, outline = 0.0, 0.0
        for look, profiles in self._profiles.items():
            lying = [i for i in self.instances if self._look(i) == look and i.id not in self._changing]
            same = [_loops(found[i.id], i) for i in lying]
            verdict = verify_loops(same[0], profiles, [""] * len(profiles), declared, self.tolerance)
            failures += [fault_of(lying[0].part, text) for text in verdict.failures]
            outline = max(outline, verdict.measured.get("max_deviation", 0.0))
            equal = all(_is_same(loops, same[0]) for loops in same)
            failures += unless(equal, "{part}: its instances differ", part=lying[0].part)
        for instance in self.instances:
            reach = self._reach(instance)
            track = found[instance.id]
            # every value that the file has, too
            times = np.unique(np.concatenate([TIMES, track.places[0], track.angles[0]]))
            (place, angle), (read, turn) = self.poses(instance, times), track.pose(times)
            ends = place + reach * np.exp(1j * angle), read + reach * np.exp(1j * turn)
            worst = max(worst, float(np.abs(place - read).max()), float(np.abs(ends[0] - ends[1]).max()))
            changing, forms = self._changing.get(instance.id), track.formed(TIMES)
            alike = (changing is None) == (forms is None) and self._stands_on(track, instance)
            failures += unless(alike, "{part}: its outline is that of another", part=instance.part)
            if changing is not None and forms is not None:
                outline = max(outline, changing.off_outlines(self.frames(instance, TIMES)[0], forms))
        for name, rim in self._idlers.items():
            verdict = verify_loops(found[name].loops, (_rim(*rim),), [""], declared, self.tolerance)
            failures += [fault_of(name, text) for text in verdict.failures]
            failures += unless(_stays(found[name]), "{part}: its outline is that of another", part=name)
        for chain in self._chains:
            track = found[chain.name]
            failures += self.late(track.seconds * abs(chain.pitches))
            # a picture, held at the stands that it has
            forms = np.zeros(0, complex) if track.forms is None else track.forms
            well = forms.shape == chain.forms.shape and float(np.abs(forms - chain.forms).max()) <= 10.0**-CORNERS
            well = well and _stays(track)
            failures += unless(well, "{part}: its outline is that of another", part=chain.name)
        failures += self.off_place(worst, outline, declared)
        return Verdict({"max_deviation": outline, "pose_deviation": worst, "loop_seconds": seconds}, tuple(failures))


def _rim(axis: complex, radius: float) -> Profile:
    return circle(radius, Label.RIM, centre=axis)


def _stays(track: ReadTrack) -> bool:
    """Whether a track stands where it is drawn."""
    return float(np.abs(np.concatenate([track.places[1], track.angles[1]])).max()) == 0.0


def _over(contour: Contour) -> Contour:
    """An outline turned over about x."""
    return replace(contour, vertices=contour.vertices.conj(), bulges=-contour.bulges, clockwise=not contour.clockwise)


def _loops(track: ReadTrack, instance: Instance) -> tuple[Loop, ...]:
    """The outlines of a track, turned back where its instance is turned over."""
    if not instance.is_over:
        return track.loops
    return tuple(replace(loop, vertices=loop.vertices.conj(), bulges=-loop.bulges) for loop in track.loops)


def _is_same(one: Sequence[Loop], two: Sequence[Loop]) -> bool:
    return len(one) == len(two) and all(
        np.array_equal(a.vertices, b.vertices) and np.array_equal(a.bulges, b.bulges)
        for a, b in zip(one, two, strict=True)
    )
