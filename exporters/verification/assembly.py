"""Assembly files read back: the names, every prototype as a part file is, every occurrence in its place."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from exporters.formats.read_assembly import ReadAssembly
from exporters.formats.reading import ASSEMBLY_READERS
from exporters.verification.judge import held, probed, said_failures, same_shade
from exporters.verification.verdict import Verdict, of_readable
from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.base.part import Part
from parts.base.readback import ReadBack
from parts.base.texts import N_, fault, fault_of, unless
from parts.keys.boards import BedSpec
from parts.scene.formats import FileKind
from parts.scene.standing import Instance

# a place is kept to this, mm, and to the digits of a file's numbers as a part of its distance
_PLACE, _DIGITS = 1e-9, 1e-13


class ExpectedAssembly(Record):
    """What an assembly file must hold: its title, parts by name, instances of them; the ``bed`` that it must lie on.

    The boundaries of the parts are moved ``offset`` mm out of the material.
    """

    title: str
    parts: dict[str, Part]
    offset: float
    instances: Sequence[Instance]
    bed: BedSpec | None = None


@of_readable
def verify_assembly(
    file: Path, kind: FileKind, expected: ExpectedAssembly, declared: float, tolerance: float
) -> Verdict:
    """Read an assembly file back and hold it against what it must be; see ``exporters.verification.judge``."""
    found = ASSEMBLY_READERS[kind.name](file)
    verdict = _judged(found, kind, expected, declared, tolerance)
    if expected.bed is None or verdict.failures:
        return verdict
    from exporters.verification.plate import on_bed

    return on_bed(found, expected.bed, declared, verdict)


def _judged(
    found: ReadAssembly, kind: FileKind, expected: ExpectedAssembly, declared: float, tolerance: float
) -> Verdict:
    stand = {instance.id: instance for instance in expected.instances}
    named = N_('it is named "{title}" instead of "{wanted}"')
    failures = unless(found.title == expected.title, named, title=found.title, wanted=expected.title)
    failures += _name_failures(fault("part"), [p.name for p in found.prototypes], list(expected.parts))
    failures += _name_failures(fault("instance"), [o.name for o in found.occurrences], list(stand))
    measured: dict[str, float] = {"parts": len(found.prototypes), "instances": len(found.occurrences)}
    reach = {name: part.body(expected.offset).reach() for name, part in expected.parts.items()}
    worst_place = 0.0
    for name, index, placed, within in found.occurrences:
        if name not in stand:
            continue
        part, place = stand[name].part, stand[name].scene_from_part.matrix()
        wanted = stand[name].subassembly or ""
        prototype = found.prototypes[index].name
        told = N_("instance {name} is {prototype} instead of {part}")
        failures += unless(prototype == part, told, name=name, prototype=prototype, part=part)
        told = N_('instance {name} stands in "{within}" instead of "{wanted}"')
        failures += unless(within in (None, wanted), told, name=name, within=within, wanted=wanted)
        off = _displacement(placed, place, reach[part])
        worst_place = max(worst_place, off)
        least = _PLACE + _DIGITS * (reach[part] + float(np.abs(place[:, 3]).max()))
        failures += unless(off <= least, "instance {name} stands {off:.6g} mm off its place", name=name, off=off)
    measured["max_displacement"] = worst_place
    volume = bound = 0.0
    for index, (name, shape, colour) in enumerate(found.prototypes):
        if name not in expected.parts:
            continue
        verdict = _of_part(shape, kind, expected.parts[name], expected.offset, declared, tolerance)
        share = verdict.measured.get("volume", 0.0) * sum(o.prototype == index for o in found.occurrences)
        volume, bound = volume + share, bound + share * verdict.measured.get("volume_bound", 0.0)
        failures += [fault_of(name, failure) for failure in verdict.failures]
        shade, told = expected.parts[name].colour, N_("{name} is coloured {colour} instead of {wanted}")
        failures += unless(same_shade(colour, shade), told, name=name, colour=colour, wanted=shade)
        deviation = verdict.measured.get("max_deviation", float("inf"))
        measured["max_deviation"] = max(measured.get("max_deviation", 0.0), deviation)
        # what the probes say, under the part's name
        measured |= {key: value for key, value in verdict.measured.items() if key.startswith(f"{name}.")}
    return Verdict(measured | ({"volume_bound": bound / volume} if bound else {}), tuple(failures))


def _of_part(shape: ReadBack, kind: FileKind, part: Part, offset: float, declared: float, tolerance: float) -> Verdict:
    """A part of the file as a file of its own; what its probes say stands under its name."""
    verdict = held(shape, kind, part.body(offset), declared, tolerance)
    said = probed(shape, part, offset, declared, verdict)
    more = {f"{part.id}.{k}": v for k, v in said.measured.items() if k not in verdict.measured}
    return Verdict(verdict.measured | more, (*said.failures, *said_failures(shape, kind, part)))


def _name_failures(what: str, found: list[str], expected: list[str]) -> list[str]:
    """Names that are missing, strange or there more than once."""
    failures = []
    for name in dict.fromkeys((*expected, *found)):
        times = found.count(name)
        failures += unless(times, "{what} {name} is missing", what=what, name=name)
        failures += unless(name in expected, '{what} "{name}" does not belong there', what=what, name=name)
        many = times > 1 and name in expected
        failures += unless(not many, "{what} {name} is there {times} times", what=what, name=name, times=times)
    return failures


def _displacement(placed: Real, place: Real, reach: float) -> float:
    """How far a point of the part may be off its place at most, mm."""
    off = placed - place
    return float(np.linalg.norm(off[:, 3]) + np.linalg.norm(off[:, :3], 2) * reach)
