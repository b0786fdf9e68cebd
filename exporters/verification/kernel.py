"""STEP files held against the CAD kernel too, where it is installed: it shares no code with our writer and reader."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from exporters.verification.verdict import Verdict
from geometry.solids.mass import body_moments
from parts.base.texts import N_, unless
from parts.solids.kernel import solids_of, volume_of

if TYPE_CHECKING:
    from geometry.solids.body import Body
    from geometry.solids.measured import Faced

# by which the kernel may call two points one, mm
_TOLERANCE = 1e-6
# to which it is to integrate, part of the volume
_VOLUME = 1e-8


def judged_by_kernel(file: Path, bodies: Sequence[Body | Faced], verdict: Verdict) -> Verdict:
    """A verdict on a good file with what the kernel says: of a solid for each body closed, valid, and its volume."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.ShapeAnalysis import ShapeAnalysis_ShapeTolerance

    solids = solids_of(file.read_text(encoding="ascii"))
    count, wanted = len(solids), len(bodies)
    told = N_("the kernel finds {count} solids instead of {wanted}")
    failures = unless(count == wanted, told, count=count, wanted=wanted)
    valid = all(BRepCheck_Analyzer(solid).IsValid() for solid in solids)
    failures += unless(valid, "the kernel calls a solid invalid")
    loose = max((ShapeAnalysis_ShapeTolerance().Tolerance(solid, 1) for solid in solids), default=0.0)
    failures += unless(loose <= _TOLERANCE, "the kernel joins what stands {loose:.3g} mm apart", loose=loose)
    exact = sum(b.moments.volume if b.is_faced else body_moments(b).volume for b in bodies)
    found = volume_of(solids, exact, _VOLUME)
    near = abs(found / exact - 1) <= _VOLUME + verdict.measured["volume_bound"]
    told = N_("the kernel finds {found:.12g} mm^3 instead of {exact:.12g} mm^3")
    failures += unless(near, told, found=found, exact=exact)
    return verdict.also(failures, {"kernel_volume_error": found / exact - 1, "kernel_tolerance": loose})
