"""Every file is read back and held against the exact section or solid, and then put to the probes of its part.

A check that fails names what was found.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, cast

from exporters.formats.reading import READERS
from exporters.verification.verdict import Verdict, of_readable
from geometry.base.findings import Finding
from geometry.base.record import replace
from parts.base.lazy import Registry
from parts.base.part import Part
from parts.base.readback import Probe, ReadBack, ReadError
from parts.base.texts import N_, fault_of, unless
from parts.scene.formats import FileKind, Form

if TYPE_CHECKING:
    from exporters.formats.read_drawing import ReadDrawing
    from exporters.formats.read_step import ReadSolid
    from exporters.formats.readback import ReadMesh, ReadOutlines
    from geometry.plane.profile import Profile, Region
    from geometry.solids.body import Body
    from geometry.solids.measured import Faced

Exact: TypeAlias = "Region | Body | Faced"


@of_readable
def verify_part(
    file: Path,
    kind: FileKind,
    part: Part,
    offset: float,
    declared: float,
    tolerance: float,
    also: Callable[[Path], None] | None = None,
    pitch_curve: Profile | None = None,
) -> Verdict:
    """Read a part's file back, hold it against the part moved ``offset`` mm out of its material, and probe it.

    ``declared``: the error that its report states, mm; the measured one must not exceed it or ``tolerance``.
    ``also``: what else is asked of a file that is good so far; it raises ``ReadError``. ``pitch_curve``: what a drawing
    must hold beside the part, and nothing else.
    """
    flat = part.cut if kind.form is Form.ARCS else part.section
    exact = part.body(offset) if kind.is_solid else flat(offset).region
    found = READERS[kind.name](file)
    verdict = held(found, kind, exact, declared, tolerance, part.id)
    if kind.form is Form.SPLINES:
        verdict = _with_paths(cast("ReadDrawing", found), pitch_curve, declared, tolerance, verdict)
    if found.names() is not None and not same_shade(found.colour, part.colour):
        raise ReadError(f"{part.id} is coloured {found.colour} instead of {part.colour}")
    verdict = verdict.also(said_failures(found, kind, part))
    if also is not None and not verdict.failures:
        try:
            also(file)
        except ReadError as refusal:
            return verdict.also([str(refusal)])
    if kind.form is Form.ARCS and len(flat(offset).region.apart) > len(part.section(offset).region.apart):
        found = _without_tag(cast("ReadOutlines", found))
    return probed(found, part, offset, declared, verdict)


def _without_tag(found: ReadOutlines) -> ReadOutlines:
    """The outlines of a part alone: the tag with its name stands to the right of all of them."""
    tag = max(found.loops, key=lambda loop: float(loop.points.real.min()))
    return replace(found, loops=tuple(loop for loop in found.loops if loop is not tag))


@of_readable
def verify_file(
    file: Path, kind: FileKind, exact: Exact, declared: float, tolerance: float, name: str | None = None
) -> Verdict:
    """Read a file back and hold it against an exact section or, for STL, 3MF and STEP, an exact solid; see ``held``."""
    return held(READERS[kind.name](file), kind, exact, declared, tolerance, name)


def held(
    found: ReadBack, kind: FileKind, exact: Exact, declared: float, tolerance: float, name: str | None = None
) -> Verdict:
    """A file that was read against its exact section or solid; ``name``: what the part must be called.

    Raises
    ------
    ReadError
        The file holds no closed outlines, or its part has another name.
    """
    if name is not None and (names := found.names()) is not None and names != (name,):
        raise ReadError(f"the file names its parts {', '.join(names) or 'nothing'} instead of {name}")
    is_faced = kind.is_solid and cast("Body | Faced", exact).is_faced
    return _HELD["faced " * is_faced + kind.form.name](found, exact, declared, tolerance)


def said_failures(found: ReadBack, kind: FileKind, part: Part) -> list[str]:
    """What is wrong with what a STEP or 3MF file says of a part; volume and area are held elsewhere."""
    wrong, told = list[str](), N_("says of its {key}: {said} instead of {wanted}")
    if kind.form is not Form.FACES:
        if found.names() is None:
            return wrong
        mesh = cast("ReadMesh", found)
        pairs = {"title": (mesh.title, part.title), "material name": (mesh.material, part.material or part.id)}
        for key, (own, meant) in pairs.items():
            wrong += unless(own == meant, told, key=key, said=own, wanted=meant)
        return wrong
    said = cast("ReadSolid", found).said
    expected = {
        "title": None if part.product_name == part.id else part.product_name,
        "description": part.description or None,
        "material name": part.material,
        "density": part.density,
    }
    for key, wanted in expected.items():
        wrong += unless(said.get(key) == wanted, told, key=key, said=said.get(key), wanted=wanted)
    for what in ("volume", "surface area"):
        wrong += unless(what in said, "does not say its {what}", what=what)
    return wrong


def signed(file: Path, kind: FileKind, author: str, organisation: str, verdict: Verdict) -> Verdict:
    """A verdict on a file, which fails too where a STEP header names another author or organisation."""
    if kind.form is not Form.FACES or verdict.failures:
        return verdict
    from exporters.formats.read_part21 import read_signature

    try:
        found = read_signature(file)
    except (ReadError, OSError) as error:
        return verdict.also([str(error)])
    wrong = list[str]()
    for what, own, told in zip(("author", "organisation"), found, (author, organisation), strict=True):
        wrong += unless(own == told, 'its {what} is "{own}" instead of "{told}"', what=what, own=own, told=told)
    return verdict.also(wrong)


def same_shade(found: str | None, expected: str | None) -> bool:
    """Whether a colour is the one asked for; a part that asks for none may have any."""
    return expected is None or (found is not None and found[:7].lower() == expected.lower())


def _with_paths(
    found: ReadDrawing, pitch_curve: Profile | None, declared: float, tolerance: float, verdict: Verdict
) -> Verdict:
    """A verdict that counts the pitch curve of a drawing too."""
    from exporters.verification.outlines import verify_samples

    if pitch_curve is None and not found.paths:
        return verdict
    wanted = [] if pitch_curve is None else [pitch_curve]
    own = verify_samples(found.path_loops(), wanted, declared, tolerance)
    measured = {}
    if "max_deviation" in own.measured and wanted:
        measured["max_deviation"] = max(verdict.measured["max_deviation"], own.measured["max_deviation"])
    return verdict.also((fault_of(N_("pitch curve"), failure) for failure in own.failures), measured)


_HERE = "exporters.verification"
# by the form of the file, and whether its part is told by faces: each is loaded when a file asks for it
_HELD: Registry[Callable[..., Verdict]] = Registry(
    {
        "ARCS": f"{_HERE}.outlines:verify_outlines",
        "SPLINES": f"{_HERE}.outlines:verify_drawing",
        "TRIANGLES": f"{_HERE}.mesh:verify_mesh",
        "FACES": f"{_HERE}.solid:verify_solid",
        "faced TRIANGLES": f"{_HERE}.faces:verify_faced_mesh",
        "faced FACES": f"{_HERE}.faces:verify_faced_solid",
    }
)


def probed(found: ReadBack, part: Part, offset: float, declared: float, verdict: Verdict) -> Verdict:
    """Add to a verdict what the probes of a part say. Files that are broken already are not put to them."""
    if verdict.failures or not part.probes:
        return verdict
    trimmed = bool(part.section(offset).findings)
    return with_probes(found, (p for p in part.probes if not (trimmed and p.needs_whole)), offset, declared, verdict)


def with_probes(found: ReadBack, probes: Iterable[Probe], offset: float, declared: float, verdict: Verdict) -> Verdict:
    """What some probes say, measured under their names where they have some; of remarks of a kind the worst one."""
    worst: dict[str, Finding] = {}
    for probe in probes:
        mark = f"{probe.name}_" if probe.name else ""
        try:
            said = probe.run(found, offset, declared)
        except ReadError as refusal:
            wrong = fault_of(probe.name, str(refusal)) if probe.name else str(refusal)
            verdict = verdict.also([wrong])
            continue
        verdict = verdict.also(said.failures, {f"{mark}{key}": value for key, value in said.measured.items()})
        for finding in said.findings:
            known = worst.get(finding.code)
            if known is None or finding.value / finding.limit > known.value / known.limit:
                worst[finding.code] = finding
    return replace(verdict, findings=tuple(worst.values()))
