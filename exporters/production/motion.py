"""The motion of a scene as an animated SVG: its loop, what moves how, and the file held against exact poses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from exporters.formats.motion_svg import Track, even_values, write_motion_svg
from exporters.formats.read_motion import ReadTrack, read_motion
from exporters.production.jobs import Made
from exporters.verification.outlines import verify_loops
from exporters.verification.verdict import Verdict
from geometry.approximation.chords import approximate_profile
from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.base.part import Part
from parts.base.readback import ReadError
from parts.base.refusal import SceneError
from parts.scene.load import ExportSpec, SceneFile
from parts.scene.placing import Instance, Placing
from parts.scene.relative_path import Course, common_period, course_of
from parts.scene.shapes import Shape

# seconds for a turn of the first drive, and for a loop at least and at most; turns of the fastest in a loop at most
_SECONDS, _LEAST, _MOST, _MOST_TURNS = 4.0, 4.0, 60.0, 20
# values of a way at first, and at most; of the tolerance what outlines and ways may take
_VALUES, _MOST_VALUES, _SHARE = 60, 16_000, 0.5
# of numbers in the file, mm
_ROUNDING = 2e-6
_FILLS = ("#b8c4d0", "#d9c39a", "#b5cfae", "#d3b3b3", "#bdb6d6")
# times at which a file is held against exact poses
_TIMES = np.concatenate([[0.0, 1.0], np.arange(1, 48) * (math.sqrt(5) - 1) / 2 % 1.0])


class MotionJob(Record):
    """The animated SVG of a scene; ``loop``: how much of the drives' run it shows (1: all), and whether it closes."""

    export: ExportSpec
    title: str
    parts: dict[str, Part]
    instances: tuple[Instance, ...]
    course: Course
    loop: Fraction
    closes: bool
    turns: float
    path: str
    place: str
    members: tuple[()] = ()

    @property
    def label(self) -> str:
        """The file."""
        return self.path

    @property
    def seconds(self) -> float:
        """How long a loop takes."""
        return min(max(_SECONDS * abs(self.turns), _LEAST), _MOST)

    @property
    def told(self) -> dict[str, Any]:
        """What is in it: the turns (or the mm) of the first drive in one loop, and whether it ends as it begins."""
        names = [instance.id for instance in self.instances]
        return {"part": None, "instances": names, "drive": self.turns, "closes": self.closes, "seconds": self.seconds}

    @property
    def offset(self) -> float:
        """None."""
        return 0.0

    def tracks(self) -> tuple[list[Track], float]:
        """What moves how, the lowest first, and the greatest deviation, mm."""
        tolerance = float(self.export.tolerance or 0.0)
        made, worst = [], 0.0
        outlines = {
            name: tuple(
                approximate_profile(p, _SHARE * tolerance, arcs=True) for p in part.section(0.0).region.profiles()
            )
            for name, part in self.parts.items()
        }
        for index, instance in enumerate(sorted(self.instances, key=lambda i: i.at[2])):
            part = self.parts[instance.part]
            reach, count = part.section(0.0).region.outer.reach(), _VALUES
            while True:
                shares = np.linspace(0, 1, 2 * count + 1)
                places, angles = self.poses(instance, shares)
                # an even way is off the most in the middle between its ends
                ways = [x[1::2] - (x[:-1:2] + x[2::2]) / 2 for x in (places, angles)]
                off = float((np.abs(ways[0]) + reach * np.abs(ways[1])).max())
                if off <= _SHARE * tolerance / 2 or count >= _MOST_VALUES:
                    break
                count *= 2
            worst = max(worst, 2 * off)
            colour = part.colour or _FILLS[index % len(_FILLS)]
            turned = even_values(angles[::2] + 0j).real
            made.append(Track(instance.id, outlines[instance.part], colour, even_values(places[::2]), turned))
        return made, worst + max(x.max_error for row in outlines.values() for x in row)

    def poses(self, instance: Instance, shares: Real) -> tuple[Any, Any]:
        """Exact places and angles of an instance at shares of the loop."""
        times = shares * float(self.loop)
        if instance.id not in self.course.rates:
            return np.full(len(times), instance.centre), np.full(len(times), instance.rotation)
        # angles are told within a turn
        order = np.argsort(times)
        places, angles = self.course.pose(instance.id, times)
        unwrapped = np.empty_like(angles)
        unwrapped[order] = np.unwrap(angles[order])
        return places, unwrapped

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

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """None."""
        return ()

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back: outlines, and where they stand at many times, against exact poses."""
        try:
            found = read_motion(file)
        except ReadError as error:
            return Verdict({}, (str(error),))
        failures: list[str] = []
        if list(found.tracks) != [i.id for i in sorted(self.instances, key=lambda i: i.at[2])]:
            return Verdict({}, (f"holds {', '.join(found.tracks)}",))
        if found.seconds not in (0.0, self.seconds):
            failures.append(f"a loop takes {found.seconds:g} s instead of {self.seconds:g} s")
        tolerance, worst, outline = float(self.export.tolerance or 0.0), 0.0, 0.0
        for part in dict.fromkeys(i.part for i in self.instances):
            same = [found.tracks[i.id] for i in self.instances if i.part == part]
            profiles = self.parts[part].section(0.0).region.profiles()
            verdict = verify_loops(same[0].loops, profiles, [""] * len(profiles), declared, tolerance)
            failures += [f"{part}: {text}" for text in verdict.failures]
            outline = max(outline, verdict.measured.get("max_deviation", 0.0))
            if not all(_is_same(track, same[0]) for track in same):
                failures.append(f"{part}: its instances differ")
        for instance in self.instances:
            reach = self.parts[instance.part].section(0.0).region.outer.reach()
            for exact, read in zip(self._points(instance, reach), _read(found.tracks[instance.id], reach), strict=True):
                worst = max(worst, float(np.abs(exact - read).max()))
        if not worst + outline <= declared:
            failures.append(f"an instance is {worst:.3g} mm off its place; {declared:.3g} mm is declared")
        return Verdict(
            {"max_deviation": outline, "pose_deviation": worst, "loop_seconds": found.seconds}, tuple(failures)
        )

    def _points(self, instance: Instance, reach: float) -> list[Any]:
        places, angles = self.poses(instance, _TIMES)
        return [places, places + reach * np.exp(1j * angles)]


def _read(track: ReadTrack, reach: float) -> list[Any]:
    places, angles = track.pose(_TIMES)
    return [places, places + reach * np.exp(1j * angles)]


def _is_same(one: ReadTrack, two: ReadTrack) -> bool:
    return len(one.loops) == len(two.loops) and all(
        np.array_equal(a.vertices, b.vertices) and np.array_equal(a.bulges, b.bulges)
        for a, b in zip(one.loops, two.loops, strict=True)
    )


def motion_job(
    scene: SceneFile, placing: Placing, parts: dict[str, Part], export: ExportSpec, where: str, source: str
) -> MotionJob:
    """The animated SVG of one export.

    Raises
    ------
    SceneError
        Nothing is driven.
    """
    if placing.train is None:
        raise SceneError(source, f"{where}.format", export.format, "shows_what_moves")
    instances = tuple(i for i in placing.instances if export.parts is None or i.part in export.parts)
    used = {name: parts[name] for name in dict.fromkeys(i.part for i in instances)}
    course = course_of(placing.train, [i.id for i in instances])
    loop, closes = _loop(course, instances, used)
    drive = scene.drives[0]
    asked = drive.turns if drive.travel is None else drive.travel
    title = scene.scene.title or scene.name
    path = f"{scene.name}.{export.name or export.format}.svg"
    return MotionJob(export, title, used, instances, course, loop, closes, float(loop) * asked, path, where)


def _loop(course: Course, instances: Sequence[Instance], parts: dict[str, Part]) -> tuple[Fraction, bool]:
    """The share of the drives' run after which the picture is as it was; no more than a viewer will watch."""
    if course.once & {i.id for i in instances}:
        return Fraction(1), False
    rates, fastest = set(), Fraction(0)
    for instance in instances:
        chain = course.rates.get(instance.id, ())
        shape = Shape(parts[instance.part])
        fastest = max([fastest, *map(abs, chain)])
        # what is round, or looks alike in parts of a turn, comes again the sooner
        rates |= {*chain[1:], *(rate * shape.count(0.0, shape.reach) for rate in chain[:1])}
    period = common_period(rates)
    most = _MOST_TURNS / fastest if fastest else period
    return (period, True) if period <= most else (most, False)
