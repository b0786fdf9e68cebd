"""The motion of a scene as an animated SVG, and the file held against exact outlines and poses."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from exporters.formats.motion_svg import Track, even_values, write_motion_svg
from exporters.formats.read_motion import ReadTrack, read_motion
from exporters.production.film import SHARE, TIMES, Film, fill
from exporters.production.jobs import Made
from exporters.verification.outlines import verify_loops
from exporters.verification.verdict import Verdict
from geometry.approximation.chords import approximate_profile
from geometry.curves.curve import Real
from parts.base.readback import ReadError
from parts.base.texts import fault, fault_of
from parts.scene.placing import Instance

# of numbers in the file, mm
_ROUNDING = 2e-6


class MotionJob(Film):
    """The animated SVG of a scene."""

    ending = ".motion", ".svg"

    def tracks(self) -> tuple[list[Track], float]:
        """What moves how, the lowest first, and the greatest deviation, mm."""
        made, worst = [], 0.0
        outlines = {
            name: tuple(
                approximate_profile(p, SHARE * self.tolerance, arcs=True) for p in part.section(0.0).region.profiles()
            )
            for name, part in self.parts.items()
        }
        for index, instance in enumerate(sorted(self.instances, key=lambda i: i.at[2])):
            part = self.parts[instance.part]
            places, angles, off = self.ways(instance, part.section(0.0).region.outer.reach())
            worst = max(worst, off)
            turned = even_values(angles + 0j).real
            colour = part.colour or fill(index)
            made.append(Track(instance.id, outlines[instance.part], colour, even_values(places), turned))
        return made, worst + max(x.max_error for row in outlines.values() for x in row)

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write it; counts of what is in it."""
        tracks, _ = self.tracks()
        spans = []
        for track, instance in zip(tracks, sorted(self.instances, key=lambda i: i.at[2]), strict=True):
            places, _ = self.poses(instance, np.linspace(0, 1, 721))
            reach = max(float(np.abs(o.geometry.vertices).max()) for o in track.outlines) * 1.03
            spans.append([places.real.min() - reach, places.imag.min() - reach, -places.real.max() - reach,
                          -places.imag.max() - reach])  # fmt: skip
        left, low, right, high = np.min(spans, axis=0).tolist()
        write_motion_svg(file, self.title, tracks, (left, low, -right, -high), self.seconds)
        values = sum(len(t.places) + len(t.angles) for t in tracks)
        return {"instances": len(tracks), "values": values}

    def declared(self, made: Made) -> tuple[float, str]:
        """The worst outline and the worst way together, mm; ways are sampled."""
        return self.tracks()[1] + _ROUNDING, "sampled"

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back: outlines, and where they stand at many times, against exact poses."""
        try:
            found = read_motion(file)
        except ReadError as error:
            return Verdict({}, (str(error),))
        failures: list[str] = []
        if list(found.tracks) != [i.id for i in sorted(self.instances, key=lambda i: i.at[2])]:
            return Verdict({}, (fault("holds {tracks}", tracks=", ".join(found.tracks)),))
        if found.seconds and not math.isclose(found.seconds, self.seconds, rel_tol=1e-6):
            failures.append(
                fault(
                    "a loop takes {seconds:g} s instead of {wanted:g} s",
                    seconds=found.seconds,
                    wanted=self.seconds,
                )
            )
        worst, outline = 0.0, 0.0
        for part in dict.fromkeys(i.part for i in self.instances):
            same = [found.tracks[i.id] for i in self.instances if i.part == part]
            profiles = self.parts[part].section(0.0).region.profiles()
            verdict = verify_loops(same[0].loops, profiles, [""] * len(profiles), declared, self.tolerance)
            failures += [fault_of(part, text) for text in verdict.failures]
            outline = max(outline, verdict.measured.get("max_deviation", 0.0))
            if not all(_is_same(track, same[0]) for track in same):
                failures.append(fault("{part}: its instances differ", part=part))
        for instance in self.instances:
            reach = self.parts[instance.part].section(0.0).region.outer.reach()
            track = found.tracks[instance.id]
            # every value that the file has, too
            values = [np.linspace(0, 1, len(way)) for way in (track.places, track.angles)]
            times = np.unique(np.concatenate([TIMES, *values]))
            for exact, read in zip(self._points(instance, reach, times), _read(track, reach, times), strict=True):
                worst = max(worst, float(np.abs(exact - read).max()))
        if not worst + outline <= declared:
            failures.append(
                fault(
                    "an instance is {worst:.3g} mm off its place; {declared:.3g} mm is declared",
                    worst=worst,
                    declared=declared,
                )
            )
        return Verdict(
            {"max_deviation": outline, "pose_deviation": worst, "loop_seconds": found.seconds}, tuple(failures)
        )

    def _points(self, instance: Instance, reach: float, times: Real) -> list[Any]:
        places, angles = self.poses(instance, times)
        return [places, places + reach * np.exp(1j * angles)]


def _read(track: ReadTrack, reach: float, times: Real) -> list[Any]:
    places, angles = track.pose(times)
    return [places, places + reach * np.exp(1j * angles)]


def _is_same(one: ReadTrack, two: ReadTrack) -> bool:
    return len(one.loops) == len(two.loops) and all(
        np.array_equal(a.vertices, b.vertices) and np.array_equal(a.bulges, b.bulges)
        for a, b in zip(one.loops, two.loops, strict=True)
    )
